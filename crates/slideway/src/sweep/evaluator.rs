//! All states of one point after another.

use super::friction::Friction;
use super::plan::{Plan, Point};
use super::quantity::Kind;
use super::rows::{Breakpoint, PointStatus, Refusal, Rows};
use super::stages::Stages;
use super::told;
use super::writer::{Writer, head};
use crate::attainability::ElasticGuides;
use crate::fault::{FaultKind, Faults};
use crate::influence::HingeState;
use crate::kinetics::KineticEquations;
use crate::mechanism::{FrictionCircle, Mechanism};
use crate::modes::ContactState;
use crate::modes::screen::{MOST_CONTACTS, Screen, SmallProblem, SmallState};
use crate::progress::{Callback, Progress};
use crate::solve::{
    BlockState, LastSolution, ProblemData, Sliding, SolveOptions, Trail, block_states, mode_problem,
    solve_with,
};
use std::borrow::Cow;
use std::ops::ControlFlow;

/// Evaluates points that lie near one another, in memory that is used again.
pub(super) struct Evaluator<'p> {
    plan: &'p Plan,
    mechanism: Mechanism,
    friction: Vec<Friction>,
    /// The friction circles before the common factor.
    circles: Vec<FrictionCircle>,
    parameters: Vec<f64>,
    trail: Trail,
    stages: Option<Cow<'p, Stages>>,
    small: Option<(Screen, SmallProblem)>,
    /// With friction in hinges.
    last: LastSolution,
}

impl<'p> Evaluator<'p> {
    /// Nothing is known of any point yet.
    pub(super) fn new(plan: &'p Plan) -> Self {
        let contacts = plan.mechanism.contacts.len();
        Self {
            plan,
            mechanism: plan.mechanism.clone(),
            friction: Friction::of(&plan.mechanism),
            circles: plan.mechanism.friction_circles.clone(),
            parameters: plan.friction.as_ref().map_or_else(Vec::new, |formulas| formulas.parameters.clone()),
            trail: Trail::default(),
            stages: plan.stages.as_ref().map(Cow::Borrowed),
            small: (contacts <= MOST_CONTACTS).then(|| {
                let screen = Screen::new(contacts).with_open(plan.mechanism.excess.open.clone());
                (screen, SmallProblem::new(contacts))
            }),
            last: LastSolution::default(),
        }
    }

    /// Adds the rows of a point; breaks, with rows that mean nothing, if `goes_on` said no within it.
    pub(super) fn evaluate(
        &mut self,
        point: Point<'_>,
        rows: &mut Rows,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> ControlFlow<()> {
        let first = rows.len();
        // The equations may still be solved there, but to numbers without meaning.
        if point.breakpoint == Breakpoint::NotSolved {
            rows.push_empty(head(point, PointStatus::Refused), point.values);
            return ControlFlow::Continue(());
        }
        let mut flow = ControlFlow::Continue(());
        let mut look = |_: &Progress| {
            if !goes_on() {
                flow = ControlFlow::Break(());
            }
            flow
        };
        let found = self.prepare(point.values).and_then(|()| self.solve(point, rows, &mut look));
        if let Err(faults) = found {
            rows.truncate(first);
            let status = refusal(&faults);
            rows.push_empty(head(point, status), point.values);
            rows.refusals.push(Refusal { point: point.number, status, reason: faults.to_string() });
        }
        flow
    }

    /// Puts the values of a point into the mechanism, and brings its stages up to date.
    fn prepare(&mut self, values: &[f64]) -> Result<(), Faults> {
        let plan = self.plan;
        if plan.friction.is_none() {
            let given = plan.varied.iter().zip(values).filter_map(|(kind, value)| match kind {
                Kind::Parameter(index) => Some((*index, *value)),
                _ => None,
            });
            self.mechanism = Mechanism::with_parameters(&plan.model, &given.collect::<Vec<_>>())?;
            self.mechanism.multiply_friction(plan.factor(values));
        }
        for (kind, value) in plan.varied.iter().zip(values) {
            match *kind {
                Kind::Parameter(_) | Kind::Friction => {}
                Kind::Coordinate(index) => self.mechanism.coordinates[index].value = *value,
                Kind::Rate(index) => self.mechanism.coordinates[index].rate = *value,
                Kind::Time => self.mechanism.time = *value,
            }
        }
        if plan.friction.is_some() {
            self.put_friction(values)?;
        }
        if self.stages.is_none() || !plan.same_state() {
            self.stages = None;
            let stages = Stages::along(&mut self.trail, &self.mechanism, &plan.columns)?;
            stages.configuration.put_misalignments(&mut self.mechanism)?;
            if plan.friction.is_none() {
                stages.configuration.put_friction(&mut self.mechanism)?;
            }
            self.stages = Some(Cow::Owned(stages));
        }
        Ok(())
    }

    /// Puts the friction of a point into the mechanism.
    fn put_friction(&mut self, values: &[f64]) -> Result<(), Faults> {
        let plan = self.plan;
        if let Some(formulas) = &plan.friction {
            formulas.apply(&plan.model, values, &mut self.parameters, &mut self.friction)?;
            formulas.put_circles(&plan.model, &self.parameters, &self.mechanism, &mut self.circles)?;
        }
        let factor = plan.factor(values);
        for (contact, friction) in self.mechanism.contacts.iter_mut().zip(&self.friction) {
            contact.mu = friction.mu.map(|mu| mu * factor);
            contact.preload = friction.preload;
        }
        for (circle, friction) in self.mechanism.friction_circles.iter_mut().zip(&self.circles) {
            *circle = if factor == 1.0 { *friction } else { friction.times(factor) };
        }
        Ok(())
    }

    fn solve(&mut self, point: Point<'_>, rows: &mut Rows, look: &mut Callback<'_>) -> Result<(), Faults> {
        let Some(stages) = &self.stages else { return Ok(()) };
        let mut contacts = self.mechanism.contacts.iter().zip(&stages.signs);
        let does_not_slide = contacts.any(|(contact, sign)| *sign == 0.0 && contact.may_hold());
        // The friction of what stands still is a range.
        let stands =
            does_not_slide && !Sliding::of(&self.mechanism, &stages.configuration)?.standing.is_empty();
        if stands {
            self.last = LastSolution::default();
        } else if self.mechanism.rough_hinges().next().is_some() {
            if write_with_hinges(self.plan, &self.mechanism, stages, (&mut self.last, point), rows, look)? {
                return Ok(());
            }
        } else if let Some((screen, problem)) = &mut self.small {
            fill(problem, &self.mechanism, stages);
            problem.load = if self.plan.columns.may_be_between_faces(&self.mechanism) {
                stages.accuracy.of_load
            } else {
                0.0
            };
            if let Ok(states) = screen.states(problem, stages.accuracy.part)
                && write(self.plan, &self.mechanism, stages, (states, point), rows)?
            {
                return Ok(());
            }
        }
        let model = self.plan.model_at(point.values)?;
        let report = solve_with(&model, &SolveOptions::default().margins(false), look)?;
        told::write(&report, self.plan, point, rows);
        Ok(())
    }
}

/// Adds the rows of the states of a point, with their attainability if that is asked for; nothing, and
/// `false`, if a guided slider is about to tip, or a number overflows.
fn write(
    plan: &Plan,
    mechanism: &Mechanism,
    stages: &Stages,
    (states, point): (&[SmallState], Point<'_>),
    rows: &mut Rows,
) -> Result<bool, Faults> {
    if !plan.attainability || states.is_empty() {
        return Ok(Writer { plan, mechanism, stages, guides: None, hinges: &[] }.write(states, point, rows));
    }
    // What lifts off is not there, in each state something else.
    if mechanism.has_one_sided() {
        return Ok(false);
    }
    let problem = mode_problem(mechanism, &stages.influence, &stages.signs)?;
    let equations = KineticEquations::new(mechanism, &stages.configuration)?;
    let guides = Some(ElasticGuides::new(mechanism, &equations, &problem));
    Ok(Writer { plan, mechanism, stages, guides, hinges: &[] }.write(states, point, rows))
}

/// Adds the rows of a point with friction in hinges. Adds nothing and returns `false` as `write` does, and
/// also where a careful answer is needed, or attainability is asked for.
fn write_with_hinges(
    plan: &Plan,
    mechanism: &Mechanism,
    stages: &Stages,
    (last, point): (&mut LastSolution, Point<'_>),
    rows: &mut Rows,
    look: &mut Callback<'_>,
) -> Result<bool, Faults> {
    if plan.attainability || mechanism.contacts.len() > MOST_CONTACTS {
        return Ok(false);
    }
    let data = ProblemData { mechanism, influence: &stages.influence, velocity_signs: &stages.signs };
    let state = (data, &stages.configuration);
    let Some(found) = block_states(state, stages.accuracy, last, look)? else { return Ok(false) };
    let states: Vec<SmallState> = found.iter().map(small).collect();
    let hinges: Vec<Vec<HingeState>> = found.into_iter().map(|state| state.hinges).collect();
    Ok(Writer { plan, mechanism, stages, guides: None, hinges: &hinges }.write(&states, point, rows))
}

/// A state of few contacts.
fn small(state: &BlockState) -> SmallState {
    let mut small = SmallState {
        pattern: [ContactState::Positive; MOST_CONTACTS],
        unknowns: [0.0; MOST_CONTACTS],
        negative_determinant: state.negative_determinant,
    };
    for (k, force) in state.normal_forces.iter().enumerate() {
        (small.pattern[k], small.unknowns[k]) = (state.pattern[k], force.abs());
    }
    small
}

/// The columns and jumps of eq. (6).
fn fill(problem: &mut SmallProblem, mechanism: &Mechanism, stages: &Stages) {
    let count = mechanism.contacts.len();
    problem.right_hand_side = stages.right_hand_side;
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        let sign = stages.signs[k];
        for side in 0..2 {
            let (mu, preload) = (contact.mu[side] * sign, contact.preload[side] * sign);
            let (columns, jumps) = (&stages.columns[side][k], &stages.jumps[side][k]);
            let (eta, eta_preload) = (&stages.eta[side][k], &stages.eta_preload[side][k]);
            for row in 0..count {
                // c_k^{sigma} = sigma e_k - mu_k s_k eta_k^{sigma}, d_k^{sigma} = s_k F_k0 eta_k^{sigma}
                problem.columns[side][k][row] = columns[row] - mu * eta[row];
                problem.jumps[side][k][row] = jumps[row] + preload * eta_preload[row];
            }
        }
    }
}

/// Whether there is no position, or another reason why a point is not solved.
fn refusal(faults: &Faults) -> PointStatus {
    let no_position = faults.sorted().iter().any(|fault| {
        matches!(
            fault.kind,
            FaultKind::NotAssembled { .. }
                | FaultKind::TooFar { .. }
                | FaultKind::NotFollowed { .. }
                | FaultKind::OverlapVanished { .. }
                | FaultKind::TravelExceeded { .. }
                | FaultKind::SingularPosition { .. }
                | FaultKind::DependentCoordinates { .. }
        )
    });
    if no_position { PointStatus::NoPosition } else { PointStatus::Refused }
}
