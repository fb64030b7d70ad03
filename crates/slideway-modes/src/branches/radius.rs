//! The branches of one hinge over the radius of its friction circle, in closed form (theory of hinges, section 2).
//!
//! In a mode all forces are affine in the magnitude `c` of the friction couple, `R = b + e c` with the answer `e` to a
//! unit couple, and `r(c) = c / |R(c)|`. So each mode exists in an interval of `c`, whose ends are zeros of linear functions.
//! In it `r` grows up to
//!
//! ```text
//! c = -|b|^2 / (b.e),   r = |b| / |b x e|
//! ```
//!
//! if `b.e < 0`, the fold, and then falls to `1/|e|` as `c` goes to infinity; else it grows throughout.

use nalgebra::{DMatrix, DVector};

use super::branch::{Branch, BranchEnd, Branches};
use super::conditions::rules;
use super::curve::Curve;
use super::family::{Instance, NoInstance};
use super::place::{Equations, Place};
use crate::existence::{EndCause, Meaning, cause_of};
use crate::interval::Sign;
use crate::problem::{ContactState, patterns};

/// The most modes that are examined.
const MODES: u64 = 1 << 12;
/// Modes whose determinant is below this are singular within rounding.
const SINGULAR: f64 = 1e-12;
/// Values below this, relative to what they are sums of, vanish.
const VANISHES: f64 = 1e-13;
/// Ends nearer to each other than this, relative to their size, are one.
const SAME: f64 = 1e-12;
/// Places along a branch.
const PLACES: usize = 64;
/// Halvings of a part of a branch.
const HALVINGS: usize = 80;

/// The branches in a range of radii of a problem with one hinge, which is given for one radius above zero; none
/// if there is no closed form: a mode is singular, a normal force vanishes throughout, or there is no load.
pub fn over_radius(
    instance: &Instance,
    radius: f64,
    range: [f64; 2],
    greatest: Option<f64>,
) -> Option<Branches> {
    let problem = &instance.problem;
    let unit = problem.load().centre().amax();
    if problem.hinges() != 1 || unit == 0.0 || radius <= 0.0 {
        return None;
    }
    let mut branches = Vec::new();
    let has_jump: Vec<bool> = (0..problem.contacts()).map(|contact| problem.has_jump(contact)).collect();
    for states in patterns(&has_jump, MODES)? {
        let mode = Mode::new(instance, radius, (&states, unit))?;
        for part in mode.parts(greatest)? {
            branches.extend(mode.branch(&part, range, greatest));
        }
    }
    branches.sort_by(Branch::order);
    Some(Branches { branches, tried: range.to_vec(), gaps: Vec::new() })
}

/// A mode, with its unknowns as affine functions of the couple.
struct Mode<'i> {
    instance: &'i Instance,
    /// The radius of the instance.
    radius: f64,
    equations: Equations,
    states: Vec<ContactState>,
    determinant: f64,
    /// Homogeneous unknowns without the couple, and what a unit of it adds.
    start: DVector<f64>,
    slope: DVector<f64>,
}

/// A part of a mode in which the radius grows, or falls, with the couple.
struct Part {
    /// The couples at both ends; the second may be infinite.
    couples: [f64; 2],
    causes: [EndCause; 2],
    grows: bool,
}

impl<'i> Mode<'i> {
    /// None if the mode is singular.
    fn new(instance: &'i Instance, radius: f64, (states, unit): (&[ContactState], f64)) -> Option<Self> {
        let equations = Equations { states: states.iter().copied().map(Some).collect(), unit };
        let rows = states.len() + 2;
        let whole = equations.matrix(instance, &DVector::zeros(rows + 1));
        let square: DMatrix<f64> = whole.columns(0, rows).into_owned();
        let determinant = square.determinant();
        if determinant.abs() <= SINGULAR {
            return None;
        }
        let factors = square.lu();
        let couple = instance.problem.response(crate::problem::Side::Positive).centre().column(states.len());
        let extended = |part: DVector<f64>, load: f64| part.insert_row(rows, load);
        let start = extended(factors.solve(&-whole.column(rows).into_owned())?, 1.0);
        let slope = extended(factors.solve(&(couple.into_owned() / (radius * unit)))?, 0.0);
        Some(Self { instance, radius, equations, states: states.to_vec(), determinant, start, slope })
    }

    fn unknowns(&self, couple: f64) -> DVector<f64> {
        if couple.is_infinite() { self.slope.clone() } else { &self.start + &self.slope * couple }
    }

    /// The radius at which the couple has a value.
    fn radius(&self, couple: f64) -> f64 {
        let contacts = self.states.len();
        let unknowns = self.unknowns(couple);
        let force = self.equations.unit * unknowns[contacts].hypot(unknowns[contacts + 1]);
        if couple.is_infinite() { force.recip() } else { couple / force }
    }

    /// The couple of the fold; none if there is none.
    fn fold(&self) -> Option<f64> {
        let (b, e) = (self.start.rows(self.states.len(), 2), self.slope.rows(self.states.len(), 2));
        (b.dot(&e) < 0.0).then(|| -b.norm_squared() / b.dot(&e))
    }

    /// The parts in which the mode exists; the outer `None` if something vanishes throughout.
    fn parts(&self, greatest: Option<f64>) -> Option<Vec<Part>> {
        let mut ends = [(0.0, Vec::new()), (f64::INFINITY, vec![Meaning::Finite])];
        for rule in rules(&self.equations, self.instance, greatest) {
            if rule.meaning == Meaning::Finite {
                continue;
            }
            let lengths = rule.lengths[0] / (self.radius * self.equations.unit);
            let (value, slope) = (rule.weights.dot(&self.start), rule.weights.dot(&self.slope) + lengths);
            let size = |part: &DVector<f64>| VANISHES * rule.weights.abs().dot(&part.abs());
            let vanishes = [value.abs() <= size(&self.start), slope.abs() <= size(&self.slope)];
            if vanishes == [true, true] {
                return None;
            }
            if vanishes[1] && value < 0.0 {
                return Some(Vec::new());
            }
            if vanishes[1] {
                continue;
            }
            let at = if vanishes[0] { 0.0 } else { -value / slope };
            let side = usize::from(slope < 0.0);
            let (end, meanings) = &mut ends[side];
            if (at - *end).abs() <= SAME * at.abs() {
                meanings.push(rule.meaning);
            } else if (at > *end) == (side == 0) {
                (*end, *meanings) = (at, vec![rule.meaning]);
            }
        }
        let couples = [ends[0].0, ends[1].0];
        if couples[0] >= couples[1] {
            return Some(Vec::new());
        }
        let causes = ends.map(|(_, meanings)| cause_of(&meanings, &meanings).unwrap_or(EndCause::Range));
        Some(self.cut(couples, causes))
    }

    fn cut(&self, couples: [f64; 2], causes: [EndCause; 2]) -> Vec<Part> {
        let [from, to] = couples;
        match self.fold() {
            Some(fold) if from < fold && fold < to => {
                let [first, last] = causes;
                vec![
                    Part { couples: [from, fold], causes: [first, EndCause::Fold], grows: true },
                    Part { couples: [fold, to], causes: [EndCause::Fold, last], grows: false },
                ]
            }
            fold => vec![Part { couples, causes, grows: fold.is_none_or(|fold| to <= fold) }],
        }
    }

    /// A couple in a part, at a share of the way.
    fn couple(&self, part: &Part, share: f64) -> f64 {
        let [from, to] = part.couples;
        if share == 1.0 {
            return to;
        }
        if to.is_finite() {
            return from + share * (to - from);
        }
        let scale = self.start.amax() / self.slope.amax();
        from + scale * share / (1.0 - share)
    }

    /// The branch of a part within a range of radii; none if it has no extent there.
    fn branch(&self, part: &Part, range: [f64; 2], greatest: Option<f64>) -> Option<Branch> {
        let radius = |share: f64| self.radius(self.couple(part, share));
        // Shares in the order of growing radii.
        let ordered = |share: f64| if part.grows { share } else { 1.0 - share };
        let mut shares = [0.0, 1.0];
        let mut causes = part.causes.clone();
        if !part.grows {
            causes.reverse();
        }
        let extent = shares.map(|share| radius(ordered(share)));
        if extent[0].max(range[0]) >= extent[1].min(range[1]) {
            return None;
        }
        for (side, limit) in range.into_iter().enumerate() {
            if (side == 0 && extent[0] < limit) || (side == 1 && extent[1] > limit) {
                shares[side] = bisect(&|share| radius(ordered(share)) < limit);
                causes[side] = EndCause::Range;
            }
        }
        let place = |step: usize| {
            let share = shares[0] + (shares[1] - shares[0]) * step as f64 / PLACES as f64;
            let couple = self.couple(part, ordered(if step == PLACES { shares[1] } else { share }));
            Place { at: self.radius(couple), z: self.unknowns(couple).normalize() }
        };
        let trail: Vec<Place> = (0..=PLACES).map(place).collect();
        Some(self.finished(part, trail, causes, greatest))
    }

    fn finished(
        &self,
        part: &Part,
        mut trail: Vec<Place>,
        [first, last]: [EndCause; 2],
        greatest: Option<f64>,
    ) -> Branch {
        let orientation = if (self.determinant > 0.0) == part.grows { 1 } else { -1 };
        let family = |radius: f64| {
            let mut factors = vec![1.0; self.states.len()];
            factors.push(radius / self.radius);
            self.instance.with_response_times(&factors).map_err(|_| NoInstance::Other)
        };
        let curve = Curve {
            family: &family,
            equations: self.equations.clone(),
            greatest,
            orientation: if orientation < 0 { Sign::Negative } else { Sign::Positive },
        };
        trail.sort_by(|one, other| one.at.total_cmp(&other.at));
        let (begin, end) = (&trail[0], &trail[trail.len() - 1]);
        Branch {
            states: self.states.clone(),
            orientation,
            from: BranchEnd::new(&curve, begin, first, end.at),
            to: BranchEnd::new(&curve, end, last, begin.at),
            equations: self.equations.clone(),
            trail,
        }
    }
}

/// The last share, from 0 to 1, that is below a limit.
fn bisect(is_below: &dyn Fn(f64) -> bool) -> f64 {
    let [mut below, mut above] = [0.0, 1.0];
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(below, above);
        if is_below(middle) { below = middle } else { above = middle }
    }
    below
}
