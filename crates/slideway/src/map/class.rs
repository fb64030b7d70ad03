//! The classes into which the points of a map fall.

use super::{ColourBy, effort};
use crate::fault::{FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::modes::existence::{ExistenceOptions, counts};
use crate::progress::Work;
use crate::report::{HOLDS, SpeedChange};
use crate::solve::{AT_ONCE, Parts, StateWithinTolerances, Upright, pattern, states as sides_of};
use serde::Serialize;

/// Bounds of the classes of margins.
pub(super) const MARGINS: [f64; 8] = [1.0, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0, f64::INFINITY];
/// The most patterns for which margins are computed.
const PATTERNS: u64 = 1 << 12;

/// Property that the points of a class have in common.
#[derive(Debug, Clone, PartialEq, PartialOrd, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum ClassMeaning {
    /// There is neither a solution nor a state in a preload gap: friction locks it.
    Locked,
    /// There is neither a solution nor a state in a preload gap, because a guided slider tips.
    Tips,
    /// So many solutions, and states with the preload between the faces.
    Solutions {
        /// Number of solutions.
        solutions: usize,
        /// Number of preload-gap states.
        preload_gap_states: usize,
        /// In how many of the solutions a block tips over one of its corners.
        #[serde(skip_serializing_if = "is_zero")]
        tipping: usize,
    },
    /// The solutions have these patterns of signs, "0" in a preload gap.
    Modes {
        /// The patterns, in the order of enumeration.
        patterns: Vec<String>,
    },
    /// How its states start, where contacts that may lift off are at rest.
    Starts {
        /// Words for the joints at rest in each state.
        starts: Vec<String>,
    },
    /// There is one solution, and there are none or several from a factor of friction on that lies in this
    /// range.
    Margin {
        /// The least factor.
        from: f64,
        /// The greatest; null where there is none.
        to: Option<f64>,
    },
    /// The least effort of the first drive (N or N m) lies in this range.
    Effort {
        /// Its lower end; null where there is none.
        from: Option<f64>,
        /// Its upper end; null where there is none.
        to: Option<f64>,
    },
    /// In which directions there is a solution or a preload-gap state.
    Moves {
        /// As in the model.
        as_in_model: bool,
        /// The other way.
        opposite: bool,
        /// Whether a guided slider tips where there is none as in the model.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        tips_as_in_model: bool,
        /// The other way.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        tips_opposite: bool,
    },
    /// Changes of the speeds in each solution.
    Motion {
        /// For each solution, for each coordinate that no drive moves.
        solutions: Vec<Vec<SpeedChange>>,
        /// In how many of them a block tips over one of its corners.
        #[serde(skip_serializing_if = "is_zero")]
        tipping: usize,
    },
    /// Whether it can stay at rest.
    Rest {
        /// Whether it can; null where that was not decided.
        holds: Option<bool>,
        /// Whether it can also begin to slide: it rests only where something wedged it before.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        may_slip: bool,
    },
    /// Not decided: rounding hides whether there is a solution.
    Undecided,
    /// Infinitely many solutions, none of them at rest.
    Continuum,
    /// Too many patterns or solutions to find all of them.
    TooLarge,
    /// There is no mode problem, for this reason.
    NotSolved {
        /// The reason.
        reason: &'static str,
    },
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "what serde asks for")]
fn is_zero(number: &usize) -> bool {
    *number == 0
}

/// A class, with an order: what is found first does not matter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ClassKey(pub(super) ClassMeaning);

/// Answer for one direction of motion at a point.
pub(super) enum Answer {
    /// Its mode problem.
    Problem(Box<Point>),
    /// Where each point is solved by itself: its states; none if the search did not come to its end.
    States(Option<States>),
}

impl Answer {
    /// The states; none if the search did not come to its end.
    fn states(&self) -> Option<&States> {
        match self {
            Self::Problem(point) => point.states.as_ref(),
            Self::States(states) => states.as_ref(),
        }
    }

    /// Returns the least effort of the first drive by magnitude; none without a solution or without a drive.
    pub(super) fn least_effort(&self) -> Option<f64> {
        let efforts = match self {
            Self::Problem(point) => {
                point.states.as_ref().map_or_else(Vec::new, |states| efforts(point, states))
            }
            Self::States(states) => states.as_ref().map_or_else(Vec::new, |states| states.efforts.clone()),
        };
        efforts.into_iter().min_by(|one, other| one.abs().total_cmp(&other.abs()))
    }
}

/// A mode problem.
pub(super) struct Point {
    /// Its mode problem; for `Motion` with the accelerations of the coordinates as outputs, for `Effort` with the
    /// efforts of the drives.
    parts: Parts,
    /// The coordinates that no drive moves, with their rates.
    free: Vec<(usize, f64)>,
    /// Its states; none if the search did not come to its end.
    states: Option<States>,
}

impl Point {
    /// Finds the states of a mode problem; `between_faces` are the patterns of those with a guided slider between its
    /// faces, which the mode problem does not tell.
    pub(super) fn new(
        parts: Parts,
        free: Vec<(usize, f64)>,
        between_faces: Vec<String>,
        work: Work<'_>,
    ) -> Self {
        let states = states(&parts, between_faces, work);
        Self { parts, free, states }
    }

    /// Returns whether nothing was found, though a pattern is so near to a boundary that a solution may be hidden.
    pub(super) fn is_undecided(&self) -> bool {
        self.states.as_ref().is_some_and(|states| states.undecided)
    }
}

/// The patterns of all states of a point.
#[derive(Debug, Clone, Default)]
pub(super) struct States {
    pub(super) solutions: Vec<String>,
    /// The sides of the solutions; none with friction in hinges.
    pub(super) sides: Vec<Vec<ContactState>>,
    pub(super) gaps: Vec<String>,
    /// Where there are infinitely many: whether some of them is a state of rest.
    pub(super) continuum: Option<bool>,
    /// Whether a guided slider tips in a solution of the equations.
    pub(super) tips: bool,
    /// Whether it is open how many there are.
    pub(super) undecided: bool,
    /// With friction in hinges and for `Motion`: what becomes of the speeds in each solution.
    pub(super) changes: Vec<Vec<SpeedChange>>,
    /// How each of the solutions starts, where contacts that may lift off are at rest.
    pub(super) starts: Option<Vec<String>>,
    /// With friction in hinges: the effort of the first drive in each solution, if there is one.
    pub(super) efforts: Vec<f64>,
    /// With friction in hinges and for `Margin`: that of an only solution, if it is decided.
    pub(super) margin: Option<ClassMeaning>,
}

impl States {
    /// Whether it stays at rest: in its only solution, or in some of infinitely many.
    fn rests(&self) -> bool {
        let is_at_rest = |starts: &Vec<String>| *starts == [HOLDS];
        self.continuum == Some(true) || self.starts.as_ref().is_some_and(is_at_rest)
    }
}

/// The class of a point in both directions, of which the opposite one is looked at by `Jam` alone; `bounds` are those
/// of the classes of `Effort`.
pub(super) fn class(
    (colour_by, bounds, mechanism): (ColourBy, &effort::Bounds, Option<&Mechanism>),
    forwards: Result<&Answer, &'static str>,
    opposite: Option<Result<&Answer, &'static str>>,
) -> ClassMeaning {
    let answer = match forwards {
        Ok(answer) => answer,
        Err(reason) => return ClassMeaning::NotSolved { reason },
    };
    let Some(states) = answer.states() else { return ClassMeaning::TooLarge };
    if states.undecided {
        return ClassMeaning::Undecided;
    }
    let moves = |states: &States| {
        states.continuum.is_some() || !(states.solutions.is_empty() && states.gaps.is_empty())
    };
    if colour_by == ColourBy::Jam {
        let as_in_model = moves(states);
        return match opposite.map(|opposite| opposite.map(Answer::states)) {
            None | Some(Ok(None)) => ClassMeaning::TooLarge,
            Some(Err(reason)) => ClassMeaning::NotSolved { reason },
            Some(Ok(Some(other))) if other.undecided => ClassMeaning::Undecided,
            Some(Ok(Some(other))) => {
                let opposite = moves(other);
                ClassMeaning::Moves {
                    as_in_model,
                    opposite,
                    tips_as_in_model: !as_in_model && states.tips,
                    tips_opposite: !opposite && other.tips,
                }
            }
        };
    }
    // What a drive needs for rest is told by its effort, if that is one value.
    if states.rests() && (colour_by != ColourBy::Effort || answer.least_effort().is_none()) {
        return ClassMeaning::Rest { holds: Some(true), may_slip: false };
    }
    if states.continuum.is_some() {
        return ClassMeaning::Continuum;
    }
    if !moves(states) {
        return if states.tips { ClassMeaning::Tips } else { ClassMeaning::Locked };
    }
    let tips = |pattern: &&String| {
        mechanism.is_some_and(|mechanism| !mechanism.tipped(&sides_of(pattern)).is_empty())
    };
    let tipping = states.solutions.iter().filter(tips).count();
    let number = ClassMeaning::Solutions {
        solutions: states.solutions.len(),
        preload_gap_states: states.gaps.len(),
        tipping,
    };
    match (colour_by, answer) {
        (ColourBy::Margin, Answer::Problem(point)) if states.solutions.len() == 1 => {
            margin(&point.parts, mechanism).unwrap_or(ClassMeaning::TooLarge)
        }
        (ColourBy::Margin, Answer::States(_)) if states.solutions.len() == 1 => {
            states.margin.clone().unwrap_or(ClassMeaning::NotSolved { reason: "margin not decided" })
        }
        (ColourBy::Motion, Answer::Problem(point))
            if !(point.free.is_empty() || states.solutions.is_empty()) =>
        {
            motion(speeds(point, states), tipping)
        }
        // What tips or lifts off is not told by coordinates that stand still.
        (ColourBy::Modes | ColourBy::Motion, _) if let Some(starts) = &states.starts => {
            let mut starts = starts.clone();
            starts.sort_unstable();
            ClassMeaning::Starts { starts }
        }
        (ColourBy::Motion, Answer::States(_)) if states.changes.iter().any(|changes| !changes.is_empty()) => {
            motion(states.changes.clone(), tipping)
        }
        (ColourBy::Motion, _) if tipping > 0 => motion(vec![Vec::new(); states.solutions.len()], tipping),
        (ColourBy::Effort, answer) => {
            answer.least_effort().map_or(number, |effort| effort::class(effort, bounds))
        }
        // Whoever asks whether it holds asks no mode problem.
        (ColourBy::Solutions | ColourBy::Margin | ColourBy::Jam | ColourBy::Motion | ColourBy::Hold, _) => {
            number
        }
        (ColourBy::Modes, _) => {
            let mut patterns = [&states.solutions[..], &states.gaps[..]].concat();
            // '+' comes before '-', and '-' before '0', as the states do in an enumeration.
            patterns.sort_unstable();
            ClassMeaning::Modes { patterns }
        }
    }
}

/// Builds the class of these changes of the speeds, with the solutions sorted: their order does not count.
fn motion(mut solutions: Vec<Vec<SpeedChange>>, tipping: usize) -> ClassMeaning {
    solutions.sort_unstable();
    ClassMeaning::Motion { solutions, tipping }
}

/// Returns the changes of the speeds in each solution.
fn speeds(point: &Point, states: &States) -> Vec<Vec<SpeedChange>> {
    let line = point.parts.line_to(&point.parts);
    let of_solution = |sides: &Vec<ContactState>| {
        let change = |&(coordinate, rate): &(usize, f64)| {
            let sign = line.output_sign(sides, point.parts.couples() + coordinate, 0.0);
            SpeedChange::of_sign(rate, sign)
        };
        point.free.iter().map(change).collect()
    };
    states.sides.iter().map(of_solution).collect()
}

/// Returns the effort of the first drive in each solution; nothing without drives.
fn efforts(point: &Point, states: &States) -> Vec<f64> {
    let line = point.parts.line_to(&point.parts);
    let of_solution = |sides: &Vec<ContactState>| {
        line.unknowns(sides, 0.0)?.get(sides.len() + point.parts.couples()).copied()
    };
    states.sides.iter().filter_map(of_solution).collect()
}

/// All states in which no guided slider tips; none if the search did not come to its end.
fn states(parts: &Parts, between_faces: Vec<String>, work: Work<'_>) -> Option<States> {
    let found = parts.states_within_tolerances(&mut |_| work.flow())?;
    let mut told: Vec<&StateWithinTolerances> = Vec::new();
    let mut states =
        States { gaps: between_faces, continuum: found.continuum.then_some(false), ..States::default() };
    for state in &found.states {
        let StateWithinTolerances { sides, force, zero, shares } = state;
        let is_solution = parts.is_solution(sides);
        // The same solution of several patterns counts once.
        if is_solution {
            if told.iter().any(|known| parts.is_same((&known.sides, &known.force), (sides, force))) {
                continue;
            }
            told.push(state);
        }
        // Those of a state without tipping, by the faces at which preloads rub.
        let faces = parts.faces(sides, zero).into_iter();
        let (tipping, standing): (Vec<_>, Vec<_>) = faces.partition(|sides| parts.tips(sides, force, shares));
        states.tips |= !tipping.is_empty();
        let stand = standing.into_iter().map(|sides| pattern(&sides));
        if !is_solution {
            states.gaps.extend(stand);
            continue;
        }
        for name in stand {
            states.solutions.push(name);
            if !sides.contains(&ContactState::Gap) {
                // Preloads at one face or the other change no acceleration.
                states.sides.push(sides.clone());
            }
        }
    }
    let is_empty = states.solutions.is_empty() && states.gaps.is_empty();
    states.undecided = found.in_doubt && is_empty && !states.tips && states.continuum.is_none();
    Some(states)
}

/// The margin of a point with one solution, as a range of factors; none if there are too many patterns. A block that tips
/// ends it, too.
fn margin(parts: &Parts, mechanism: Option<&Mechanism>) -> Option<ClassMeaning> {
    // Changes beyond the last finite bound are of one class.
    let range = [1.0, MARGINS[MARGINS.len() - 2]];
    let line = parts.without_pressure_friction().line_to(parts);
    let options = ExistenceOptions { range, greatest_normal_force: None, patterns: PATTERNS };
    let existence = line.existence(&options).ok()?;
    let counts = counts(&line, &existence, range);
    let changes = counts.iter().find(|count| count.to > 1.0 + AT_ONCE && count.solutions != 1);
    let upright = mechanism.and_then(|mechanism| Upright::of(&existence, mechanism));
    let tips =
        upright.filter(|upright| !upright.tips.is_empty()).map_or(f64::INFINITY, |upright| upright.until);
    let factor = changes.map_or(f64::INFINITY, |count| count.from.max(1.0)).min(tips);
    Some(margin_up_to(MARGINS.iter().position(|&bound| factor < bound).unwrap_or(MARGINS.len() - 1)))
}

/// The margin that reaches beyond so many of the bounds.
pub(super) fn margin_up_to(bounds: usize) -> ClassMeaning {
    let [from, to] = [MARGINS[bounds.max(1) - 1], MARGINS[bounds.max(1)]];
    ClassMeaning::Margin { from, to: to.is_finite().then_some(to) }
}

/// Why there is no mode problem, in few words, so that neighbouring points agree.
pub(super) fn reason(faults: &Faults) -> &'static str {
    match faults.sorted().first().map(|fault| &fault.kind) {
        Some(FaultKind::NotAssembled { .. }) => "cannot be assembled",
        Some(FaultKind::NotFollowed { .. } | FaultKind::TooFar { .. }) => "not reached from the drawing",
        Some(FaultKind::TravelExceeded { .. } | FaultKind::OverlapVanished { .. }) => {
            "beyond the travel of a joint"
        }
        Some(FaultKind::MotionWithoutInertia { .. }) => {
            "massless: a question for `hold`, or for a model with a drive"
        }
        Some(FaultKind::ZeroSlidingVelocity { .. }) => "a contact with friction does not slide",
        Some(FaultKind::HingeDoesNotTurn { .. }) => "a hinge with friction does not turn",
        Some(
            FaultKind::OutOfRange { .. }
            | FaultKind::StaticBelowKinetic { .. }
            | FaultKind::StaticRadiusBelowKinetic { .. }
            | FaultKind::AtSlidingSpeed { .. },
        ) => "values that the model does not allow",
        _ => "cannot be solved",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery;
    use crate::model::{Model, Settings};
    use crate::solve::Stages;

    /// The oracle follows the number of solutions to infinite friction.
    #[test]
    fn margins_are_those_of_the_whole_ray() {
        let models: [(&str, &[&str]); 2] = [("klepp-2002", &["mu_1", "mu_2"]), ("drawer", &["mu"])];
        let mut finite = 0;
        for (name, coefficients) in models {
            let model = Model::parse(gallery::find(name).expect("in the gallery").text).expect("sound");
            for step in 0..60_u32 {
                let mu = 0.01 + 0.0131 * f64::from(step);
                let values = [mu, 0.3 - 0.004 * f64::from(step)];
                let set = |settings: Settings, (name, value): (&&str, f64)| {
                    settings.parameter(name, value.to_string())
                };
                let settings = coefficients.iter().zip(values).fold(Settings::default(), set);
                let stages = Stages::new(&model.with(&settings).expect("sound")).expect("solvable");
                let parts = stages.parts().expect("finite numbers");
                let range = [1.0, f64::INFINITY];
                let line = parts.without_pressure_friction().line_to(&parts);
                let options = ExistenceOptions { range, greatest_normal_force: None, patterns: PATTERNS };
                let existence = line.existence(&options).expect("few patterns");
                let counts = counts(&line, &existence, range);
                if counts[0].solutions != 1 {
                    continue;
                }
                let factor = counts.iter().find(|count| count.solutions != 1).map(|count| count.from);
                let Some(ClassMeaning::Margin { from, to }) = margin(&parts, None) else {
                    panic!("a margin")
                };
                let factor = factor.unwrap_or(f64::INFINITY);
                finite += usize::from(factor < 5.0);
                let is_within = from <= factor && factor < to.unwrap_or(f64::INFINITY);
                assert!(is_within || to.is_none() && factor.is_infinite(), "{name}, {mu}: {factor}");
            }
        }
        assert!(finite > 10, "{finite} finite margins");
    }

    /// A drawer on two rails with equal runners, pulled a = 0.25 m beside its middle, contacts L = 0.4 m apart, locks
    /// at mu = L / (2 a) = 0.8 (theory of redundant guides, closed forms): its margin is 0.8/mu.
    #[test]
    fn margins_of_a_drawer_on_two_rails_are_those_of_the_closed_form() {
        let rail = |name: &str, y: &str| {
            format!(
                "[joints.{name}]\ntype = \"block_slider\"\nblock = \"drawer\"\nat = [0, \"{y} m\"]\nalong = 0\n\
                 length = \"0.4 m\"\nmu = \"mu\"\n"
            )
        };
        let text = format!(
            "[parameters]\nmu = 0.3\n[bodies.drawer]\nmass = 8\nmoment_of_inertia = 1\ncentre_of_mass = \"middle\"\n\
             points = [\"handle\", \"middle\"]\n[points]\nmiddle = [0, 0]\n\
             handle = [\"0.2 m\", \"0.25 m\"]\n{}{}[loads.resistance]\n\
             type = \"force\"\nat = \"drawer.middle\"\ncomponents = [\"-10 N\", 0]\n[coordinates.x]\n\
             slide = \"left\"\nrate = 0.3\n[drives.pull]\ncoordinate = \"x\"\n\
             force = {{ at = \"drawer.handle\", direction = 0 }}\n",
            rail("left", "0.3"),
            rail("right", "-0.3")
        );
        let model = Model::parse(&text).expect("sound");
        for mu in [0.1, 0.2, 0.35, 0.5, 0.6, 0.7, 0.78] {
            let settings = Settings::default().parameter("mu", mu.to_string());
            let stages = Stages::new(&model.with(&settings).expect("sound")).expect("solvable");
            let parts = stages.parts().expect("finite numbers");
            let Some(ClassMeaning::Margin { from, to }) = margin(&parts, None) else {
                panic!("a margin at {mu}")
            };
            let factor = 0.8 / mu;
            assert!(from <= factor && factor < to.unwrap_or(f64::INFINITY), "{mu}: {from} {to:?}");
        }
    }
}
