//! The proven outcome of one pattern.

use nalgebra::DVector;

use super::elimination::IntegerSystem;
use super::enclosure::ApproximateInverse;
use super::exact::ExactSolution;
use super::polyhedron::ExactSet;
use super::system::{BoundedVector, PatternSystem};
use crate::interval::{Interval, Sign};
use crate::problem::{ContactState, ProblemView};

/// Maximum number of vertices and extreme directions that describe what a singular pattern admits.
const CORNERS: usize = 4096;

/// The outcome of one pattern: the solutions that it admits. `unknowns` has one entry per contact: `y_k`, or
/// the share `lambda_k` for a contact in its gap.
#[derive(Debug, Clone, PartialEq)]
pub enum Decision {
    /// `D != 0` and one solution, with all `y_k > 0` and `0 < lambda_k < 1`.
    Solution {
        /// Encloses the solution (for every value within the bounds of the data).
        unknowns: Vec<Interval>,
        /// The sign of `D`: `Negative` or `Positive`.
        determinant: Sign,
    },
    /// `D != 0`, and this contact has `y_k < 0`, or `lambda_k` outside 0 to 1.
    NoSolution {
        /// The contact, from 0.
        contact: usize,
    },
    /// `D != 0` and one solution, some of whose `y_k` are exactly 0, or `lambda_k` exactly 0 or 1.
    Boundary {
        /// Encloses the solution.
        unknowns: Vec<Interval>,
        /// Contacts with `y_k = 0` or `lambda_k = 0`.
        zero: Vec<usize>,
        /// Contacts with `lambda_k = 1`.
        full_share: Vec<usize>,
        /// The sign of `D`: `Negative` or `Positive`.
        determinant: Sign,
    },
    /// `D = 0`.
    Singular {
        /// The admissible solutions.
        set: ExactSet,
    },
    /// For data within bounds only: the outcome differs between values within them, or that could not be
    /// ruled out. The pattern is on the boundary within the enclosure.
    Undecided {
        /// Encloses the solution for every value within the bounds; `None` if `D = 0` could not be ruled out.
        unknowns: Option<Vec<Interval>>,
        /// Contacts whose `y_k` may be negative, or whose `lambda_k` may be outside 0 to 1; empty if
        /// `unknowns` is `None`.
        in_doubt: Vec<usize>,
    },
}

/// The arithmetic used for a decision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Precision {
    /// `f64` with bounds on rounding errors.
    Double,
    /// Residuals with twice the digits.
    DoubleDouble,
    /// Rational numbers.
    Rational,
}

/// The outcome of one pattern, as returned by [`decide`], with the arithmetic that led to it.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvenDecision {
    /// The outcome.
    pub decision: Decision,
    /// The arithmetic that led to it.
    pub precision: Precision,
}

/// Proves what one pattern of a mode problem admits.
///
/// Solves `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}` for the states of `pattern`, one per contact
/// (theory, section 3), and encloses the solution rigorously (see [`enclose_solution`]). If a sign stays in
/// doubt, the residual is computed with twice the digits; after that, an exact problem is solved in rational
/// numbers, so it is never left undecided. Units are those of the problem. For an exact problem, the
/// enclosure of a solution is about as narrow as `f64` allows, unless the pattern is close to singular.
///
/// [`enclose_solution`]: super::enclose_solution
///
/// # Panics
/// If `pattern` does not have one state per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::{decide, Decision};
/// use slideway_modes::{ContactState, ModeProblem};
/// // 0.1 + 0.2 is not 0.3 in f64: the problem for these very numbers has y_1 < 0, not y_1 = 0.
/// let problem = ModeProblem::from_linear_complementarity(&dmatrix![1.0], dvector![0.1 + 0.2 - 0.3])?;
/// let verdict = decide(&problem, &[ContactState::Positive]);
/// assert_eq!(verdict.decision, Decision::NoSolution { contact: 0 });
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn decide<'a>(problem: impl Into<ProblemView<'a>>, pattern: &[ContactState]) -> ProvenDecision {
    let Some(verdict) = decide_while(problem.into(), pattern, &mut || true) else {
        unreachable!("nothing stops it")
    };
    verdict
}

/// [`decide`]; `None` once `proceed` is `false`, which is called now and then, because large matrices and
/// rational numbers may take long.
pub(crate) fn decide_while(
    problem: ProblemView<'_>,
    pattern: &[ContactState],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<ProvenDecision> {
    assert_eq!(pattern.len(), problem.contacts(), "one state per contact");
    let mut enclosure = None;
    if let Some(system) = PatternSystem::new(problem, pattern)
        && let Some(mut approximation) = Approximation::new(&system, proceed)
    {
        for precision in [Precision::Double, Precision::DoubleDouble] {
            enclosure = approximation.improve(precision).or(enclosure);
            match enclosure.as_ref().and_then(|found| found.decide(pattern)) {
                Some(decision @ Decision::Solution { .. }) => {
                    return Some(ProvenDecision { decision: approximation.sharpened(decision), precision });
                }
                Some(decision) => return Some(ProvenDecision { decision, precision }),
                None => {}
            }
        }
    }
    if !proceed() {
        return None;
    }
    if problem.exact {
        let decision = decide_exactly(problem, pattern, proceed)?;
        return Some(ProvenDecision { decision, precision: Precision::Rational });
    }
    let in_doubt = enclosure.as_ref().map_or_else(Vec::new, |found| found.in_doubt(pattern));
    let unknowns = enclosure.map(|found| found.unknowns);
    Some(ProvenDecision {
        decision: Decision::Undecided { unknowns, in_doubt },
        precision: Precision::DoubleDouble,
    })
}

/// A solution that is improved step by step.
struct Approximation<'a> {
    system: &'a PatternSystem<'a>,
    inverse: ApproximateInverse,
    unknowns: DVector<f64>,
}

impl<'a> Approximation<'a> {
    /// `None` if the matrix has no approximate inverse, or once `proceed` is `false`.
    fn new(system: &'a PatternSystem<'a>, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let inverse = ApproximateInverse::new(&system.matrix, proceed)?;
        let unknowns = inverse.apply(system.right_hand_side());
        Some(Self { system, inverse, unknowns })
    }

    /// One step of iterative refinement, with the resulting enclosure.
    fn improve(&mut self, precision: Precision) -> Option<SolutionBounds> {
        let residual = match precision {
            Precision::Double => self.system.residual(&self.unknowns),
            Precision::DoubleDouble | Precision::Rational => self.system.accurate_residual(&self.unknowns),
        };
        let BoundedVector { centre, bound } = self.inverse.correction(&residual)?;
        let terms = self.unknowns.iter().zip(&centre).zip(&bound);
        let unknowns = terms.map(|((&value, &correction), &bound)| {
            Interval::point(value) + Interval::around(correction, bound)
        });
        let enclosure =
            SolutionBounds { unknowns: unknowns.collect(), determinant: self.inverse.determinant_sign() };
        self.unknowns += centre;
        Some(enclosure)
    }
}

impl Approximation<'_> {
    /// Narrows the bounds of a solution: residuals with twice the digits are used as long as they halve a
    /// bound. Returns other decisions as they are.
    fn sharpened(&mut self, solution: Decision) -> Decision {
        let Decision::Solution { mut unknowns, determinant } = solution else { return solution };
        let mut is_first = true;
        while let Some(sharper) = self.improve(Precision::DoubleDouble) {
            let both = |(one, other): (&Interval, &Interval)| one.intersection(*other).unwrap_or(*one);
            let narrower: Vec<Interval> = unknowns.iter().zip(&sharper.unknowns).map(both).collect();
            let gains = narrower.iter().zip(&unknowns).any(|(new, old)| new.width() < 0.5 * old.width());
            if is_first || gains {
                unknowns = narrower;
            }
            if !gains {
                break;
            }
            is_first = false;
        }
        Decision::Solution { unknowns, determinant }
    }
}

/// Bounds on the solution of a regular pattern's equations.
struct SolutionBounds {
    unknowns: Vec<Interval>,
    determinant: Sign,
}

impl SolutionBounds {
    /// The decision, if no sign is in doubt.
    fn decide(&self, pattern: &[ContactState]) -> Option<Decision> {
        let outside = |(contact, value): (usize, &Interval)| {
            let beyond = pattern[contact] == ContactState::Gap && value.lower() > 1.0;
            value.upper() < 0.0 || beyond
        };
        if let Some(contact) = self.unknowns.iter().enumerate().position(outside) {
            return Some(Decision::NoSolution { contact });
        }
        let strictly_inside = |(contact, value): (usize, &Interval)| {
            value.lower() > 0.0 && (pattern[contact] != ContactState::Gap || value.upper() < 1.0)
        };
        self.unknowns
            .iter()
            .enumerate()
            .all(strictly_inside)
            .then(|| Decision::Solution { unknowns: self.unknowns.clone(), determinant: self.determinant })
    }

    fn in_doubt(&self, pattern: &[ContactState]) -> Vec<usize> {
        let doubtful = |&contact: &usize| {
            let value = self.unknowns[contact];
            value.lower() <= 0.0 || pattern[contact] == ContactState::Gap && value.upper() >= 1.0
        };
        (0..pattern.len()).filter(doubtful).collect()
    }
}

fn decide_exactly(
    problem: ProblemView<'_>,
    pattern: &[ContactState],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Decision> {
    if let Some(solution) = ExactSolution::of_pattern(problem.centre, pattern, proceed) {
        return Some(solution.decide(pattern));
    }
    let system = IntegerSystem::new(problem.centre, pattern);
    let set = proceed().then(|| ExactSet::of_system(&system, pattern, CORNERS, proceed)).flatten()?;
    Some(Decision::Singular { set })
}

impl ExactSolution {
    /// What the pattern of the solved equations admits.
    pub(crate) fn decide(&self, pattern: &[ContactState]) -> Decision {
        let contacts = pattern.len();
        let in_gap = |contact: usize| pattern[contact] == ContactState::Gap;
        let outside = |&contact: &usize| {
            self.sign(contact) == Sign::Negative
                || in_gap(contact) && self.sign_above_one(contact) == Sign::Positive
        };
        if let Some(contact) = (0..contacts).find(outside) {
            return Decision::NoSolution { contact };
        }
        let zero: Vec<usize> = (0..contacts).filter(|&k| self.sign(k) == Sign::Zero).collect();
        let full_share: Vec<usize> =
            (0..contacts).filter(|&k| in_gap(k) && self.sign_above_one(k) == Sign::Zero).collect();
        let (unknowns, determinant) = (self.enclosures(), self.determinant());
        if zero.is_empty() && full_share.is_empty() {
            Decision::Solution { unknowns, determinant }
        } else {
            Decision::Boundary { unknowns, zero, full_share, determinant }
        }
    }
}
