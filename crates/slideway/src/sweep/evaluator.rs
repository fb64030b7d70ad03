//! All states of one point after another.

use super::columns::Columns;
use super::friction::{Friction, FrictionFormulas};
use super::quantity::Kind;
use super::rows::{Breakpoint, PointStatus, RowHead, RowKind, RowVerdict, Rows};
use super::stages::{Stages, Trail};
use super::told;
use crate::attainability::ElasticGuides;
use crate::fault::{FaultKind, Faults};
use crate::kinetics::KineticEquations;
use crate::mechanism::{JointKind, Mechanism};
use crate::model::{Model, PreloadLine, Settings};
use crate::modes::screen::{MOST_CONTACTS, Screen, SmallProblem, SmallState};
use crate::modes::{ContactState, Side};
use crate::report::{Report, Verdict};
use crate::solve::{SolveOptions, careful_report, mode_problem, solve_with, velocity_signs};
use std::ops::ControlFlow;

/// A couple may exceed |N| L / 2 by this multiple of the greatest one before the slider counts as tipping, as in `solve`.
const COUPLE_TOLERANCE: f64 = 1e-9;

/// What a sweep varies, and what has to be computed anew at every point.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    pub(super) model: Model,
    pub(super) mechanism: Mechanism,
    pub(super) varied: Vec<Kind>,
    pub(super) columns: Columns,
    /// If parameters change nothing but friction: how.
    pub(super) friction: Option<FrictionFormulas>,
    pub(super) attainability: bool,
}

impl Plan {
    /// Whether position, velocities and loads are the same at all points.
    fn same_state(&self) -> bool {
        let keeps = |kind: &Kind| matches!(kind, Kind::Parameter(_) | Kind::Friction);
        self.friction.is_some() && self.varied.iter().all(keeps)
    }

    /// What makes of the model that of a point; none if friction has a factor.
    fn settings(&self, values: &[f64]) -> Option<Settings> {
        let mut settings = Settings::default();
        for (kind, value) in self.varied.iter().zip(values) {
            let text = format!("{value:e}");
            settings = match *kind {
                Kind::Parameter(index) => settings.parameter(&self.model.parameters[index].name, &text),
                Kind::Coordinate(index) => settings.position(&self.model.coordinates[index].name, &text),
                Kind::Rate(index) => settings.rate(&self.model.coordinates[index].name, &text),
                Kind::Time => settings.time(&text),
                Kind::Friction => return None,
            };
        }
        Some(settings)
    }
}

/// A point that is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point<'v> {
    pub(super) number: u64,
    pub(super) breakpoint: Breakpoint,
    pub(super) inserted: bool,
    pub(super) values: &'v [f64],
}

/// Evaluates points that lie near one another, in memory that is used again.
pub(super) struct Evaluator<'p> {
    plan: &'p Plan,
    mechanism: Mechanism,
    friction: Vec<Friction>,
    parameters: Vec<f64>,
    trail: Trail,
    stages: Option<Stages>,
    small: Option<(Screen, SmallProblem)>,
    outputs: Vec<f64>,
}

/// States of a point, by kind.
#[derive(Debug, Clone, Copy, Default)]
struct Counts {
    solutions: u32,
    gap_states: u32,
    rejected: u32,
}

impl<'p> Evaluator<'p> {
    /// Nothing is known of any point yet.
    pub(super) fn new(plan: &'p Plan) -> Self {
        let contacts = plan.mechanism.contacts.len();
        Self {
            plan,
            mechanism: plan.mechanism.clone(),
            friction: Friction::of(&plan.mechanism),
            parameters: Vec::new(),
            trail: Trail::default(),
            stages: None,
            small: (contacts <= MOST_CONTACTS).then(|| (Screen::new(contacts), SmallProblem::new(contacts))),
            outputs: Vec::new(),
        }
    }

    /// Adds the rows of a point.
    pub(super) fn evaluate(&mut self, point: Point<'_>, rows: &mut Rows) {
        rows.points += 1;
        let first = rows.len();
        let found = self.prepare(point.values).and_then(|()| self.solve(point, rows));
        if let Err(faults) = found {
            rows.heads.truncate(first);
            rows.numbers.truncate(first * rows.width);
            rows.patterns.truncate(first * rows.contacts);
            let status = refusal(&faults);
            rows.push_empty(head(point, status), point.values);
            rows.refusals.push((point.number, status, faults.to_string()));
        }
    }

    /// Puts the values of a point into the mechanism, and brings its stages up to date.
    fn prepare(&mut self, values: &[f64]) -> Result<(), Faults> {
        let plan = self.plan;
        if let Some(formulas) = &plan.friction {
            formulas.apply(&plan.model, values, &mut self.parameters, &mut self.friction)?;
        } else {
            let given = plan.varied.iter().zip(values).filter_map(|(kind, value)| match kind {
                Kind::Parameter(index) => Some((*index, *value)),
                _ => None,
            });
            self.mechanism = Mechanism::with_parameters(&plan.model, &given.collect::<Vec<_>>())?;
            self.friction = Friction::of(&self.mechanism);
        }
        let mut factor = 1.0;
        for (kind, value) in plan.varied.iter().zip(values) {
            match *kind {
                Kind::Parameter(_) => {}
                Kind::Coordinate(index) => self.mechanism.coordinates[index].value = *value,
                Kind::Rate(index) => self.mechanism.coordinates[index].rate = *value,
                Kind::Time => self.mechanism.time = *value,
                Kind::Friction => factor = *value,
            }
        }
        for (contact, friction) in self.mechanism.contacts.iter_mut().zip(&self.friction) {
            contact.mu = friction.mu.map(|mu| mu * factor);
            contact.preload = friction.preload;
        }
        if self.stages.is_none() || !plan.same_state() {
            self.stages = None;
            self.stages = Some(self.trail.stages(&self.mechanism, &plan.columns)?);
        }
        Ok(())
    }

    fn solve(&mut self, point: Point<'_>, rows: &mut Rows) -> Result<(), Faults> {
        let Some(stages) = &self.stages else { return Ok(()) };
        let mut contacts = self.mechanism.contacts.iter().zip(&stages.signs);
        if contacts.any(|(contact, sign)| *sign == 0.0 && !contact.is_frictionless()) {
            velocity_signs(&self.mechanism, &stages.configuration)?;
        }
        if let Some((screen, problem)) = &mut self.small {
            fill(problem, &self.mechanism, stages);
            if let Ok(states) = screen.states(problem, stages.accuracy) {
                let problem = if self.plan.attainability && !states.is_empty() {
                    Some(mode_problem(&self.mechanism, &stages.influence, &stages.signs)?)
                } else {
                    None
                };
                let equations = match &problem {
                    Some(_) => Some(KineticEquations::new(&self.mechanism, &stages.configuration)?),
                    None => None,
                };
                let guides = problem.as_ref().zip(equations.as_ref());
                let mut writer = Writer {
                    plan: self.plan,
                    mechanism: &self.mechanism,
                    stages,
                    guides: guides
                        .map(|(problem, equations)| ElasticGuides::new(&self.mechanism, equations, problem)),
                    outputs: &mut self.outputs,
                    counts: Counts::default(),
                };
                if let Some(status) = writer.write(states, point, rows) {
                    writer.finish(status, point, rows);
                    return Ok(());
                }
            }
        }
        let report = match self.plan.settings(point.values) {
            Some(settings) => {
                let model = self.plan.model.with(&settings)?;
                let options = SolveOptions { margins: false, ..SolveOptions::default() };
                solve_with(&model, &options, &mut |_| ControlFlow::Continue(()))?
            }
            None => self.careful(stages)?,
        };
        told::write(&report, self.plan, point, rows);
        Ok(())
    }
}

impl Evaluator<'_> {
    /// The answer for a state that no model describes: with friction multiplied by a factor.
    fn careful(&self, stages: &Stages) -> Result<Report, Faults> {
        let equations = KineticEquations::new(&self.mechanism, &stages.configuration)?;
        let Stages { configuration, influence, signs, .. } = stages;
        careful_report(&self.mechanism, configuration, &equations, influence, signs)
    }
}

/// The columns and jumps of eq. (6).
fn fill(problem: &mut SmallProblem, mechanism: &Mechanism, stages: &Stages) {
    let count = mechanism.contacts.len();
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        let sign = stages.signs[k];
        for (side, orientation) in [1.0, -1.0].into_iter().enumerate() {
            let (mu, preload) = (contact.mu[side] * sign, contact.preload[side] * sign);
            let eta = &stages.eta[side][k][..count];
            let column = &mut problem.columns[side][k][..count];
            // c_k^{sigma} = sigma e_k - mu_k s_k eta_k^{sigma}
            column.iter_mut().zip(eta).for_each(|(entry, eta)| *entry = -mu * eta);
            column[k] += orientation;
            // d_k^{sigma} = s_k F_k0 eta_k^{sigma}
            let eta = &stages.eta_preload[side][k][..count];
            let jump = &mut problem.jumps[side][k][..count];
            jump.iter_mut().zip(eta).for_each(|(entry, eta)| *entry = preload * eta);
        }
        problem.right_hand_side[k] = stages.normal_forces[k];
    }
}

/// Writes the states that elimination has found.
struct Writer<'w> {
    plan: &'w Plan,
    mechanism: &'w Mechanism,
    stages: &'w Stages,
    /// If attainability is asked for.
    guides: Option<ElasticGuides<'w>>,
    outputs: &'w mut Vec<f64>,
    counts: Counts,
}

impl Writer<'_> {
    /// The status of the point; none if a guided slider is about to tip.
    fn write(&mut self, states: &[SmallState], point: Point<'_>, rows: &mut Rows) -> Option<PointStatus> {
        let first = rows.len();
        let contacts = self.plan.columns.contacts;
        for with_gap in [false, true] {
            for state in states {
                let in_gap = state.pattern[..contacts].contains(&ContactState::Gap);
                if in_gap == with_gap && self.row(state, in_gap, point, rows).is_none() {
                    rows.heads.truncate(first);
                    rows.numbers.truncate(first * rows.width);
                    rows.patterns.truncate(first * rows.contacts);
                    return None;
                }
            }
        }
        Some(match (self.counts.solutions, self.counts.gap_states) {
            (0, 0) => PointStatus::None,
            (0, _) => PointStatus::PreloadGap,
            (1, _) => PointStatus::One,
            _ => PointStatus::Several,
        })
    }

    /// Writes the row of a state unless a guided slider rejects it; none if that cannot be told.
    fn row(&mut self, state: &SmallState, in_gap: bool, point: Point<'_>, rows: &mut Rows) -> Option<()> {
        let columns = &self.plan.columns;
        let contacts = columns.contacts;
        let start = rows.numbers.len();
        rows.numbers.extend_from_slice(point.values);
        rows.numbers.extend((0..contacts).map(|k| state.normal_force(k)));
        self.outputs.clear();
        self.outputs.extend_from_slice(&self.stages.frictionless);
        for k in 0..contacts {
            let faces = self.friction(state, k);
            // Adding zero turns -0 into 0.
            rows.numbers.push(faces[0] + faces[1] + 0.0);
            for (force, influence) in faces.into_iter().zip(&self.stages.influences[k]) {
                if force != 0.0 {
                    self.outputs
                        .iter_mut()
                        .zip(influence)
                        .for_each(|(sum, per_force)| *sum += force * per_force);
                }
            }
        }
        for &k in &columns.shares {
            let share = state.pattern[k] == ContactState::Gap;
            rows.numbers.push(if share { state.unknowns[k] } else { f64::NAN });
        }
        rows.numbers.extend_from_slice(self.outputs);
        let keep = self.keeps(state);
        if keep != Some(true) {
            rows.numbers.truncate(start);
            self.counts.rejected += 1;
            return keep.map(|_| ());
        }
        rows.patterns.extend(state.pattern[..contacts].iter().map(|state| match state {
            ContactState::Positive => b'+',
            ContactState::Negative => b'-',
            ContactState::Gap => b'0',
        }));
        let kind = if in_gap { RowKind::PreloadGap } else { RowKind::Solution };
        let negative_determinant = Some(state.negative_determinant);
        let verdict = self.verdict(&state.pattern[..contacts]);
        rows.heads.push(RowHead { kind, verdict, negative_determinant, ..head(point, PointStatus::None) });
        if in_gap {
            self.counts.gap_states += 1;
        } else {
            self.counts.solutions += 1;
        }
        Some(())
    }

    /// Friction at both faces of a contact, eq. (2) with F_k = (mu_k |N_k| + F_k0) s_k.
    fn friction(&self, state: &SmallState, k: usize) -> [f64; 2] {
        let contact = &self.mechanism.contacts[k];
        let sign = self.stages.signs[k];
        // Share of the positive face.
        let (share, pressure) = match state.pattern[k] {
            ContactState::Positive => (1.0, contact.mu[0] * state.unknowns[k] * sign),
            ContactState::Negative => (0.0, contact.mu[1] * state.unknowns[k] * sign),
            ContactState::Gap => (state.unknowns[k], 0.0),
        };
        let preload = [share * contact.preload[0] * sign, (1.0 - share) * contact.preload[1] * sign];
        let preload = match contact.preload_line {
            PreloadLine::Pressed => preload,
            PreloadLine::Centre => [f64::midpoint(preload[0], preload[1]); 2],
        };
        [share * pressure + preload[0], (1.0 - share) * pressure + preload[1]]
    }

    /// Whether all guided sliders stay flat: |C| <= |N| L / 2 (theory, section 1); none if one is about to tip.
    fn keeps(&self, state: &SmallState) -> Option<bool> {
        let contacts = self.plan.columns.contacts;
        let forces = (0..contacts).map(|k| state.normal_force(k).abs());
        let greatest = forces.fold(self.stages.greatest_load, f64::max);
        let mut keeps = true;
        for &(joint, contact, output) in &self.plan.columns.couples {
            let JointKind::Slider(slider) = &self.mechanism.joints[joint.index()].kind else { continue };
            let limit = state.normal_force(contact).abs() * slider.length / 2.0;
            let excess = self.outputs[output].abs() - limit;
            let tolerance = COUPLE_TOLERANCE * greatest * slider.length;
            if excess.abs() <= 4.0 * tolerance {
                return None;
            }
            keeps &= excess < 0.0;
        }
        Some(keeps)
    }

    /// The verdict on a solution, if it was asked for; states with gaps have none.
    fn verdict(&self, pattern: &[ContactState]) -> RowVerdict {
        let sides: Option<Vec<Side>> = pattern.iter().map(|state| state.side()).collect();
        match (&self.guides, sides) {
            (Some(guides), Some(sides)) => verdict(guides.verdict_on(&sides)),
            _ => RowVerdict::NotComputed,
        }
    }

    /// Puts what is known of the whole point into its rows.
    fn finish(&self, status: PointStatus, point: Point<'_>, rows: &mut Rows) {
        let states = (self.counts.solutions + self.counts.gap_states) as usize;
        if states == 0 {
            rows.push_empty(head(point, status), point.values);
        }
        let first = rows.len() - states.max(1);
        for head in &mut rows.heads[first..] {
            head.status = status;
            head.solutions = self.counts.solutions;
            head.gap_states = self.counts.gap_states;
            head.rejected = self.counts.rejected;
        }
    }
}

/// The row of a point of which nothing else is known.
pub(super) fn head(point: Point<'_>, status: PointStatus) -> RowHead {
    RowHead {
        point: point.number,
        breakpoint: point.breakpoint,
        inserted: point.inserted,
        status,
        solutions: 0,
        gap_states: 0,
        rejected: 0,
        kind: RowKind::Nothing,
        branch: 0,
        verdict: RowVerdict::NotComputed,
        negative_determinant: None,
    }
}

pub(super) fn verdict(verdict: Verdict) -> RowVerdict {
    match verdict {
        Verdict::Attainable => RowVerdict::Attainable,
        Verdict::Unattainable => RowVerdict::Unattainable,
        Verdict::Flutter => RowVerdict::Flutter,
        Verdict::Undecided => RowVerdict::Undecided,
        Verdict::NotComputed => RowVerdict::NotComputed,
    }
}

/// Whether there is no position, or another reason why a point is not solved.
fn refusal(faults: &Faults) -> PointStatus {
    let no_position = faults.sorted().iter().any(|fault| {
        matches!(
            fault.kind,
            FaultKind::NotAssembled { .. }
                | FaultKind::TooFar { .. }
                | FaultKind::OverlapVanished { .. }
                | FaultKind::TravelExceeded { .. }
                | FaultKind::SingularPosition { .. }
                | FaultKind::DependentCoordinates { .. }
        )
    });
    if no_position { PointStatus::NoPosition } else { PointStatus::Refused }
}
