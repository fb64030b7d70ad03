//! The efforts in the state of the model.

use super::continuum::effort_range;
use super::efforts::{Efforts, PATTERNS, efficiency, growing, power, velocities};
use super::report::{Approach, BlowUp, DriveDirection, DriveSolution, EffortRange, Frictionless, Sense};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::mechanism::{Contact, Mechanism};
use crate::model::Model;
use crate::modes::existence::{Existence, ExistenceOptions, ModeInterval};
use crate::progress::{Progress, Work};
use crate::report::{CoordinateState, Solution, SolveReport, Status};
use crate::solve::{SolveOptions, Stages, common_coefficient, pattern, solve_with};

/// Less and more friction than in the model, as factors.
const FACTORS: [[f64; 2]; 2] = [[0.0, 1.0], [1.0, f64::INFINITY]];
/// Blow-ups of a mode at the same factor count once.
const SAME: f64 = 1e-12;

/// A model in its state.
pub(super) struct State {
    pub(super) coordinates: Vec<CoordinateState>,
    /// The efforts in its direction of motion.
    pub(super) direction: DriveDirection,
    /// True if it is at rest on contacts that may lift off.
    pub(super) is_at_rest: bool,
}

/// The efforts in one direction of motion, and the state.
///
/// # Errors
/// Whatever `solve` refuses.
pub(super) fn direction(model: &Model, direction: Sense, work: Work<'_>) -> Result<State, Faults> {
    let mechanism = Mechanism::new(model)?;
    let mut goes_on = |progress: &Progress| work.part(0, 2).tell(progress);
    let configuration = Configuration::with_progress(&mechanism, &mut goes_on)?;
    let options = SolveOptions::default();
    let report = solve_with(model, &options, &mut goes_on)?;
    let (stages, _) = Stages::with_standing(mechanism, configuration)?;
    let AllEfforts { solutions, range, frictionless, .. } = efforts(&report, &velocities(&stages));
    let margins = report.margins.as_ref();
    let found = DriveDirection {
        tips: report.tipping_in_the_end(),
        tipping: margins.and_then(|margins| margins.tipping.clone()),
        below: margins.and_then(|margins| margins.below.clone()),
        direction,
        status: report.status,
        complete: report.complete,
        solutions,
        range,
        no_solution: margins.and_then(|margins| margins.no_solution),
        never_jams: margins.is_some_and(|margins| margins.no_solution.is_none()),
        unique_at_least: report.unique_at_least,
        another_count: margins
            .and_then(|margins| margins.another_count.filter(|other| Some(*other) != margins.no_solution)),
        moves_below: margins.and_then(|margins| margins.moves_below),
        mu: only_mu(&stages.mechanism),
        blow_ups: blow_ups(&stages, work.part(1, 2))?,
        frictionless,
    };
    Ok(State { coordinates: report.state, direction: found, is_at_rest: stages.is_at_rest() })
}

/// The coefficient of friction, if there is one.
fn only_mu(mechanism: &Mechanism) -> Option<f64> {
    let mut rough = mechanism.contacts.iter().filter(|contact| contact.mu != [0.0; 2]);
    let is_one = !rough.any(Contact::depends_on_speed) && mechanism.rough_hinges().next().is_none();
    is_one.then(|| common_coefficient(mechanism)).flatten()
}

/// The efforts of all solutions.
pub(super) struct AllEfforts {
    pub(super) solutions: Vec<DriveSolution>,
    /// Those of infinitely many solutions, if they are known.
    pub(super) range: Option<EffortRange>,
    /// Whether there are infinitely many solutions whose efforts are not known, or it is not known whether there are any.
    pub(super) are_unknown: bool,
    pub(super) frictionless: Frictionless,
}

/// The efforts of all solutions, and those without friction.
pub(super) fn efforts(report: &SolveReport, velocities: &[f64]) -> AllEfforts {
    let frictionless: Vec<f64> = report.influence.drives.iter().map(|drive| drive.effort).collect();
    let solution = |solution: &Solution, preload_gap: bool| {
        let efforts: Vec<f64> = solution.drives.iter().map(|drive| drive.effort + 0.0).collect();
        DriveSolution {
            pattern: solution.pattern.clone(),
            preload_gap,
            joints: solution.joints.clone(),
            floats: !solution.floating.is_empty(),
            attainability: solution.attainability.verdict,
            power: power(&efforts, velocities),
            efficiency: efficiency(&efforts, &frictionless, velocities),
            efforts,
        }
    };
    let pressed = report.solutions.iter().map(|one| solution(one, false));
    let gaps = report.preload_gap_states.iter().map(|one| solution(one, true));
    let range = effort_range(report, &frictionless, velocities);
    AllEfforts {
        solutions: pressed.chain(gaps).collect(),
        are_unknown: report.status == Status::Unknown
            || report.status == Status::Continuum && range.is_none(),
        range,
        frictionless: Frictionless { power: power(&frictionless, velocities), efforts: frictionless },
    }
}

/// The factors of friction at which efforts grow without bound; none if there are too many modes, friction in
/// hinges, or contacts that stand still.
fn blow_ups(stages: &Stages, work: Work<'_>) -> Result<Option<Vec<BlowUp>>, Faults> {
    if stages.mechanism.rough_hinges().next().is_some() || !stages.standing.is_empty() {
        return Ok(None);
    }
    let line = stages.data().growing_friction(&|_| true)?;
    let mut all = Vec::new();
    for range in FACTORS {
        let options = ExistenceOptions { range, greatest_normal_force: None, patterns: PATTERNS };
        let found = line.existence_with(&options, &mut |progress| work.tell(progress));
        let Ok(Some(existence)) = found else { return Ok(None) };
        all.extend(growing_ends(&existence, stages, |factor| {
            Efforts::new(&stages.with_friction(factor)).ok()
        }));
    }
    all.sort_by(|one, other| one.at.total_cmp(&other.at));
    all.dedup_by(|next, kept| {
        next.pattern == kept.pattern && next.side == kept.side && next.at - kept.at <= SAME * next.at
    });
    Ok(Some(all))
}

/// The ends of modes at which efforts grow without bound, in ascending order.
pub(super) fn growing_ends(
    existence: &Existence,
    stages: &Stages,
    at: impl Fn(f64) -> Option<Efforts>,
) -> Vec<BlowUp> {
    let names = |contacts: &[usize]| {
        contacts.iter().map(|&contact| stages.mechanism.contacts[contact].name.to_string()).collect()
    };
    let ends = |mode: &ModeInterval| {
        let ends = [(mode.to.at, mode.from.at, Approach::Below), (mode.from.at, mode.to.at, Approach::Above)];
        let one = |&(end, other, side): &(f64, f64, Approach)| {
            let growing = growing(&mode.pattern, [end, other], &at).filter(|_| end.is_finite())?;
            Some(BlowUp {
                at: end,
                pattern: pattern(&mode.pattern),
                side,
                efforts: growing.efforts,
                contacts: names(&growing.contacts),
            })
        };
        ends.iter().filter_map(one).collect::<Vec<_>>()
    };
    let mut all: Vec<BlowUp> = existence.modes.iter().flat_map(ends).collect();
    all.sort_by(|one, other| one.at.total_cmp(&other.at));
    all
}
