//! Where modes exist: the parameters of a line of mode problems for which each pattern has a solution.
//!
//! Along a line, every number of the problem is affine in one parameter `t`: one friction coefficient,
//! several that are scaled together, a preload, or a load. The equations of a pattern are then
//! `A(t) z = b(t)` with `A(t) = A_0 + t A_1`, `b(t) = b_0 + t b_1`, and where their solution begins or ceases
//! to exist is found without scanning (theory, section 6): `det A(t)` vanishes where `-1/t` is an eigenvalue
//! of `A_0^-1 A_1`, and the same holds for Cramer's numerators of the unknowns with a bordered pencil. Only
//! the `m` columns that vary count, so the pencils have size `m` and `m + 1`; for `m = 1` the zeros are those
//! of a linear or quadratic function:
//!
//! ```text
//! D(mu) = det(A) (1 + mu v_k),       y_j(mu) = y0_j - mu v_j y0_k / (1 + mu v_k)
//! ```
//!
//! Every end that is a simple zero is then polished to machine precision.
//!
//! Outputs are further unknowns that are affine in the `y_k`, such as the couples of guided sliders, with
//! bounds `|output| <= factor * y_k` that a solution must satisfy.

mod counts;
mod extent;
mod line;
mod roots;
mod signs;

use nalgebra::{DMatrix, DVector};
use std::ops::ControlFlow;

use crate::interval::Sign;
use crate::problem::{BySide, ContactState, ModeProblem, OpenContacts, Side, patterns};
use crate::progress::{Callback, Progress};
use extent::Extent;
use line::{Cause, Condition, End, Line, Part, Value};

pub use counts::{CountInterval, cells, counts, counts_in, ends, is_same_end, nothing_is_left};
pub use line::Limit;

/// Mode problems whose numbers are affine in a parameter `t`: index 0 contains the values at `t = 0`, and
/// index 1 the change per unit of `t`. With `r` contacts and `o` outputs, matrices are `(r + o) x r`, and the
/// right-hand side has `r + o` entries.
#[derive(Debug, Clone)]
pub struct ModeProblemLine {
    /// Columns `c_k` of each side; below them, minus the contribution of one unit of `y_k` to each output.
    pub columns: [BySide<DMatrix<f64>>; 2],
    /// Jumps `d_k` of each side; below them, the contribution of the preload friction to each output.
    pub jumps: [BySide<DMatrix<f64>>; 2],
    /// `N(0)`; below it, the outputs without friction.
    pub right_hand_side: [DVector<f64>; 2],
    /// Bounds of the outputs.
    pub bounds: Vec<OutputBound>,
    /// Whether the right-hand side jumps at a contact, so that it has preload-gap states.
    pub has_jump: Vec<bool>,
    /// Whether the two sides of a contact are different states even where `y_k = 0`, because of something
    /// that the problem does not contain.
    pub sides_differ: Vec<bool>,
    /// Which contacts may be open, and together, which counts as a solution. Patterns that cannot hold are left
    /// out.
    pub open: OpenContacts,
}

/// `|output| <= factor * y_contact`: the couple of a guided slider with `factor` half its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputBound {
    /// The output, from 0.
    pub output: usize,
    /// The contact, from 0.
    pub contact: usize,
    /// The factor, positive.
    pub factor: f64,
}

/// The range and the limits of a search for modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExistenceOptions {
    /// The range of the parameter. The end may be infinite if the start is positive.
    pub range: [f64; 2],
    /// Modes count only where no `y_k` exceeds this value.
    pub greatest_normal_force: Option<f64>,
    /// The maximum number of patterns that are tried, gap states included.
    pub patterns: u64,
}

/// Why a mode ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EndCause {
    /// The range of the parameter ends.
    Range,
    /// Its determinant vanishes: normal forces grow without bound.
    Singular,
    /// These contacts have `y_k = 0`: they change sides.
    SideChange(Vec<usize>),
    /// The preload friction of these contacts has moved to one face: the gap closes.
    GapCloses(Vec<usize>),
    /// These bounds of outputs are reached: guided sliders tip.
    OutputBound(Vec<usize>),
    /// These contacts reach [`ExistenceOptions::greatest_normal_force`].
    GreatestNormalForce(Vec<usize>),
    /// A sliding velocity vanishes, so its friction has no direction and reverses beyond; only if the numbers
    /// do not depend linearly on the parameter.
    Reversal,
    /// Two solutions of opposite orientation merge; only with friction in hinges.
    Fold,
    /// The forces of these hinges with friction vanish.
    HingeUnloaded(Vec<usize>),
    /// It was not followed any further; only with friction in hinges.
    NotFollowed,
    /// Beyond it, there is no mode problem; only if the numbers do not depend linearly on the parameter.
    NoProblem,
}

impl EndCause {
    /// Whether everything that this cause names is also named by another cause of the same kind.
    fn is_part_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::SideChange(part), Self::SideChange(all))
            | (Self::GapCloses(part), Self::GapCloses(all))
            | (Self::OutputBound(part), Self::OutputBound(all))
            | (Self::GreatestNormalForce(part), Self::GreatestNormalForce(all)) => {
                part.iter().all(|one| all.contains(one))
            }
            _ => false,
        }
    }
}

/// An end of an interval in which a mode exists.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeEnd {
    /// The parameter.
    pub at: f64,
    /// Why the mode ends there.
    pub cause: EndCause,
    /// The behaviour of each normal force `N_k` towards this end; `None` if the limit could not be computed.
    pub normal_force: Option<Vec<Limit>>,
}

/// An interval of the parameter in which a pattern has a solution.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeInterval {
    /// The pattern.
    pub pattern: Vec<ContactState>,
    /// Where it begins.
    pub from: ModeEnd,
    /// Where it ends.
    pub to: ModeEnd,
}

/// Where the modes of a line of problems exist.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Existence {
    /// The intervals, by pattern and then by parameter.
    pub modes: Vec<ModeInterval>,
    /// Patterns whose determinant vanishes for every value of the parameter.
    pub singular_throughout: Vec<Vec<ContactState>>,
    /// Patterns for which eigenvalues could not be computed.
    pub not_computed: Vec<Vec<ContactState>>,
    /// As in [`ModeProblemLine::open`].
    pub open: OpenContacts,
}

/// More patterns than the options allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{contacts} contacts, {with_jump} of them with preload gaps, have more than {limit} patterns")]
pub struct TooManyModes {
    /// Number of contacts.
    pub contacts: usize,
    /// How many of them have gap states.
    pub with_jump: usize,
    /// The limit.
    pub limit: u64,
}

impl ModeProblemLine {
    /// The line from one problem at `t = 0` to another at `t = 1`.
    pub fn between(start: &ModeProblem, end: &ModeProblem) -> Self {
        let by_side = |part: fn(&ModeProblem, Side) -> &DMatrix<f64>| {
            let slope = BySide::of(|side| part(end, side) - part(start, side));
            [BySide::of(|side| part(start, side).clone()), slope]
        };
        let contacts = 0..start.contacts();
        Self {
            columns: by_side(ModeProblem::columns),
            jumps: by_side(ModeProblem::jumps),
            right_hand_side: [
                start.right_hand_side().clone(),
                end.right_hand_side() - start.right_hand_side(),
            ],
            bounds: Vec::new(),
            has_jump: contacts.map(|contact| start.has_jump(contact) || end.has_jump(contact)).collect(),
            sides_differ: vec![false; start.contacts()],
            open: OpenContacts::default(),
        }
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.columns[0].positive.ncols()
    }

    /// The exact intervals in which each pattern has a solution.
    ///
    /// Patterns are in the order of enumeration, including those with preload gaps. Isolated values of the
    /// parameter at which a pattern has a solution are omitted.
    ///
    /// # Errors
    /// [`TooManyModes`] if there are more patterns than the options allow.
    ///
    /// # Panics
    /// If the range is not increasing, or infinite without a positive start.
    ///
    /// ```
    /// use nalgebra::{dmatrix, dvector};
    /// use slideway_modes::existence::{EndCause, ExistenceOptions, ModeProblemLine};
    /// use slideway_modes::{ContactState, ModeProblem};
    /// // One slider with eta = 0.5 that moves forwards: it locks at mu = 1/eta, paper eq. (9).
    /// let at = |mu: f64| ModeProblem::new(
    ///     dmatrix![1.0 - 0.5 * mu], dmatrix![-1.0 - 0.5 * mu], dmatrix![0.0], dmatrix![0.0], dvector![4.0]);
    /// let line = ModeProblemLine::between(&at(0.0)?, &at(1.0)?);
    /// let options = ExistenceOptions { range: [0.0, 5.0], greatest_normal_force: None, patterns: 100 };
    /// let existence = line.existence(&options)?;
    /// assert_eq!(existence.modes.len(), 1);
    /// assert_eq!(existence.modes[0].pattern, [ContactState::Positive]);
    /// assert_eq!(existence.modes[0].to.at, 2.0);
    /// assert_eq!(existence.modes[0].to.cause, EndCause::Singular);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn existence(&self, options: &ExistenceOptions) -> Result<Existence, TooManyModes> {
        Ok(self.existence_with(options, &mut |_| ControlFlow::Continue(()))?.unwrap_or_default())
    }

    /// [`Self::existence`] with a callback that is called for every pattern; `None` if it breaks.
    ///
    /// # Errors
    /// As [`Self::existence`].
    ///
    /// # Panics
    /// As [`Self::existence`].
    pub fn existence_with(
        &self,
        options: &ExistenceOptions,
        callback: &mut Callback<'_>,
    ) -> Result<Option<Existence>, TooManyModes> {
        let [from, to] = options.range;
        assert!(from < to && (to.is_finite() || from > 0.0), "an increasing range");
        let mut existence = Existence { open: self.open.clone(), ..Existence::default() };
        let patterns = self.patterns(options.patterns)?;
        let all = patterns.len() as u64;
        for (done, pattern) in (0..).zip(patterns) {
            if callback(&Progress::of("patterns", done, all)).is_break() {
                return Ok(None);
            }
            if !self.open.holds(&pattern) {
                continue;
            }
            let mode = self.mode(&pattern, options);
            match mode.extent(options.range) {
                Extent::Parts(parts) => {
                    existence.modes.extend(parts.iter().map(|part| mode.interval(part)));
                }
                Extent::SingularThroughout => existence.singular_throughout.push(pattern),
                Extent::NotComputed => existence.not_computed.push(pattern),
            }
        }
        Ok(Some(existence))
    }

    /// The smallest positive parameter at which the determinant of some pattern without gaps changes its sign,
    /// and the pattern; `None` if no change is certain. Without jumps, every load has exactly one solution up
    /// to that parameter, if all determinants have the same orientation at `t = 0` (theory, section 5).
    ///
    /// Where contacts share a load, the patterns are those of its determinate parts, each with as many open contacts
    /// as there are self-stresses: up to that parameter every load has exactly one solution whatever the play, the
    /// misalignment and the stiffness of the contacts (theory, eq. (R4)).
    ///
    /// `sign_at` returns the sign of the determinant of a pattern at a parameter if it is certain. A zero
    /// counts only between two signs that are certain and opposite: zeros at infinity, which the rounding of
    /// the numbers along the line moves to great parameters, have no such sign beyond them.
    ///
    /// # Errors
    /// [`TooManyModes`] if there are more patterns than `limit`.
    pub fn first_locking(
        &self,
        limit: u64,
        sign_at: &dyn Fn(f64, &[ContactState]) -> Option<Sign>,
    ) -> Result<Option<(f64, Vec<ContactState>)>, TooManyModes> {
        let mut first: Option<(f64, Vec<ContactState>)> = None;
        let is_determinate = |pattern: &Vec<ContactState>| self.open.is_determinate(pattern);
        for pattern in self.patterns(limit)?.into_iter().filter(is_determinate) {
            let known = first.as_ref().map_or(f64::INFINITY, |(known, _)| *known);
            let mut zeros = self.line(&pattern).determinant_zeros([0.0, 1.0]);
            zeros.retain(|&zero| zero > 0.0 && zero < known);
            if let Some(at) = first_change(&zeros, &|at| sign_at(at, &pattern)) {
                first = Some((at, pattern));
            }
        }
        Ok(first)
    }

    /// The patterns that have a solution at one parameter, in the order of enumeration. Only those for which
    /// `goes_on`, called before each, returns `true` are tried.
    ///
    /// # Errors
    /// [`TooManyModes`] if there are more patterns than the options allow.
    pub fn present(
        &self,
        at: f64,
        options: &ExistenceOptions,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Vec<ContactState>>, TooManyModes> {
        let mut patterns = self.patterns(options.patterns)?;
        patterns.retain(|pattern| goes_on() && self.exists(pattern, at, options));
        Ok(patterns)
    }

    /// Whether a pattern has a solution at one parameter; boundaries count.
    pub fn exists(&self, pattern: &[ContactState], at: f64, options: &ExistenceOptions) -> bool {
        let mode = self.mode(pattern, options);
        mode.line.solution(at).is_some_and(|unknowns| mode.violated(&unknowns).is_empty())
    }

    /// Where an output may vanish in the solution of a pattern inside a range, in increasing order; each place
    /// to machine precision where it changes its sign. None if eigenvalues could not be computed, or the
    /// determinant of the pattern vanishes throughout.
    pub fn output_zeros(&self, pattern: &[ContactState], output: usize, range: [f64; 2]) -> Option<Vec<f64>> {
        let condition = Condition { weights: [(pattern.len() + output, 1.0), NONE], offset: 0.0 };
        self.line(pattern).zeros(condition, range)
    }

    /// The sign of an output in the solution of a pattern at a parameter, 0 where it is zero within rounding;
    /// none where the determinant vanishes.
    pub fn output_sign(&self, pattern: &[ContactState], output: usize, at: f64) -> Option<i8> {
        let line = self.line(pattern);
        let unknown = pattern.len() + output;
        if line.vanishes(at)?[unknown] {
            return Some(0);
        }
        Some(if line.solution(at)?[unknown] > 0.0 { 1 } else { -1 })
    }

    /// Finds what vanishes within rounding in the solution of a pattern at a parameter, as the cause by which
    /// it would end there. Returns [`EndCause::Range`] if nothing vanishes, or if the determinant of the
    /// pattern does.
    pub fn cause_at(&self, pattern: &[ContactState], at: f64, options: &ExistenceOptions) -> EndCause {
        let mode = self.mode(pattern, options);
        let Some(unknowns) = mode.line.solution(at) else { return EndCause::Range };
        let vanishing = mode.vanishing(&unknowns);
        if vanishing.is_empty() { EndCause::Range } else { mode.cause(&Cause::Conditions(vanishing)) }
    }

    /// Why a pattern that has a solution here has none in a nearby problem, both at `t = 0`; `None` if its
    /// determinant changes sign between them.
    pub fn cause(
        &self,
        beyond: &Self,
        pattern: &[ContactState],
        options: &ExistenceOptions,
    ) -> Option<EndCause> {
        let (here, there) = (self.mode(pattern, options), beyond.mode(pattern, options));
        let determinant = |mode: &Mode<'_>| mode.line.matrix_at(0.0).determinant();
        if determinant(&here) * determinant(&there) <= 0.0 {
            return None;
        }
        let violated = there.violated(&there.line.solution(0.0)?);
        (!violated.is_empty()).then(|| there.cause(&Cause::Conditions(violated)))
    }

    /// The quantity that vanishes where a mode ends for this reason, positive where the mode exists, apart
    /// from the sign of a determinant; `None` if its equations are singular.
    pub fn slack(
        &self,
        pattern: &[ContactState],
        cause: &EndCause,
        options: &ExistenceOptions,
    ) -> Option<f64> {
        let mode = self.mode(pattern, options);
        if *cause == EndCause::Singular {
            return Some(mode.line.matrix_at(0.0).determinant());
        }
        let unknowns = mode.line.solution(0.0)?;
        let concerned = (0..mode.conditions.len())
            .filter(|&index| mode.cause(&Cause::Conditions(vec![index])).is_part_of(cause));
        let value = |index: usize| {
            let condition = &mode.conditions[index];
            condition.times(unknowns.as_slice()) + condition.offset
        };
        concerned.map(value).reduce(f64::min)
    }

    /// All patterns in the order of enumeration, with the first contact varying slowest.
    fn patterns(&self, limit: u64) -> Result<Vec<Vec<ContactState>>, TooManyModes> {
        let with_jump = self.has_jump.iter().filter(|&&jump| jump).count();
        let contacts = self.contacts();
        patterns(&self.has_jump, limit).ok_or(TooManyModes { contacts, with_jump, limit })
    }

    /// The equations of one pattern. Unknowns: `y_k`, or the share `lambda_k` for a contact in its gap, then
    /// the outputs.
    fn line(&self, pattern: &[ContactState]) -> Line {
        let size = self.right_hand_side[0].len();
        let part = |power: usize| {
            let mut matrix = DMatrix::zeros(size, size);
            let mut load = self.right_hand_side[power].clone();
            for (contact, state) in pattern.iter().enumerate() {
                let jumps = [Side::Positive, Side::Negative].map(|side| self.jumps[power].get(side));
                let [plus, minus] = jumps.map(|jumps| jumps.column(contact));
                if let Some(side) = state.side() {
                    let column = self.columns[power].get(side).column(contact);
                    matrix.column_mut(contact).copy_from(&column);
                    load += self.jumps[power].get(side).column(contact);
                } else {
                    matrix.column_mut(contact).copy_from(&(minus - plus));
                    load += minus;
                }
            }
            if power == 0 {
                matrix
                    .view_mut((pattern.len(), pattern.len()), (size - pattern.len(), size - pattern.len()))
                    .fill_with_identity();
            }
            (matrix, load)
        };
        let ((m0, b0), (m1, b1)) = (part(0), part(1));
        Line { matrix: [m0, m1], right_hand_side: [b0, b1] }
    }

    fn mode<'p>(&self, pattern: &'p [ContactState], options: &ExistenceOptions) -> Mode<'p> {
        let mut mode =
            Mode { pattern, line: self.line(pattern), conditions: Vec::new(), meanings: Vec::new() };
        for (contact, &state) in pattern.iter().enumerate() {
            if state == ContactState::Gap {
                mode.require([(contact, 1.0), NONE], 0.0, Meaning::Gap(contact));
                mode.require([(contact, -1.0), NONE], 1.0, Meaning::Gap(contact));
            } else {
                mode.require([(contact, 1.0), NONE], 0.0, Meaning::Side(contact));
                if let Some(greatest) = options.greatest_normal_force {
                    mode.require([(contact, -1.0), NONE], greatest, Meaning::Greatest(contact));
                }
            }
        }
        for (index, bound) in self.bounds.iter().enumerate() {
            let pressure = if pattern[bound.contact] == ContactState::Gap { 0.0 } else { bound.factor };
            for sign in [1.0, -1.0] {
                let weights = [(bound.contact, pressure), (pattern.len() + bound.output, sign)];
                mode.require(weights, 0.0, Meaning::Bound(index));
            }
        }
        mode
    }
}

/// The first of these increasing positive zeros beyond which a sign is certain and differs from the one before
/// it; the first of several between which no sign is certain.
fn first_change(zeros: &[f64], sign_at: &dyn Fn(f64) -> Option<Sign>) -> Option<f64> {
    let &nearest = zeros.first()?;
    let before = sign_at(0.0)?;
    let mut since_certain = nearest;
    for (index, &zero) in zeros.iter().enumerate() {
        let next = zeros.get(index + 1).copied().unwrap_or(f64::INFINITY);
        match sign_at(f64::midpoint(zero, next).min(2.0 * zero)) {
            Some(sign) if sign != before => return Some(since_certain),
            Some(_) => since_certain = next,
            None => {}
        }
    }
    None
}

/// In an unbounded range, places farther out than the inverse of this, relative to its start, count as
/// infinite.
const INFINITY: f64 = 1e-6;

/// The meaning of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// The solution is finite.
    Finite,
    /// `y_k >= 0`.
    Side(usize),
    /// `0 <= lambda_k <= 1`.
    Gap(usize),
    /// `|output| <= factor y_k`.
    Bound(usize),
    /// `y_k <= greatest normal force`.
    Greatest(usize),
}

/// Why a mode ends where it leaves these conditions and those vanish; none if it leaves none. Tipping and changes of side
/// take precedence over merely reaching a limit.
pub(crate) fn cause_of(left: &[Meaning], vanishing: &[Meaning]) -> Option<EndCause> {
    let concerned = |wanted: fn(Meaning) -> Option<usize>| {
        left.iter().any(|&meaning| wanted(meaning).is_some()).then(|| {
            let mut list: Vec<usize> = vanishing.iter().filter_map(|&meaning| wanted(meaning)).collect();
            list.dedup();
            list
        })
    };
    let sides = concerned(|meaning| if let Meaning::Side(contact) = meaning { Some(contact) } else { None });
    let gaps = concerned(|meaning| if let Meaning::Gap(contact) = meaning { Some(contact) } else { None });
    let bounds = concerned(|meaning| if let Meaning::Bound(bound) = meaning { Some(bound) } else { None });
    let greatest =
        concerned(|meaning| if let Meaning::Greatest(contact) = meaning { Some(contact) } else { None });
    if left.contains(&Meaning::Finite) {
        return Some(EndCause::Singular);
    }
    sides
        .map(EndCause::SideChange)
        .or(gaps.map(EndCause::GapCloses))
        .or(bounds.map(EndCause::OutputBound))
        .or(greatest.map(EndCause::GreatestNormalForce))
}

/// One pattern along the line.
struct Mode<'p> {
    pattern: &'p [ContactState],
    line: Line,
    conditions: Vec<Condition>,
    meanings: Vec<Meaning>,
}

/// Stands for no second unknown in a condition.
const NONE: (usize, f64) = (0, 0.0);

impl Mode<'_> {
    /// The conditions that a solution violates.
    fn violated(&self, unknowns: &DVector<f64>) -> Vec<usize> {
        self.conditions_where(unknowns, |value| !value.is_met())
    }

    /// The conditions that are equalities within rounding.
    fn vanishing(&self, unknowns: &DVector<f64>) -> Vec<usize> {
        self.conditions_where(unknowns, Value::vanishes)
    }

    fn conditions_where(&self, unknowns: &DVector<f64>, holds: impl Fn(Value) -> bool) -> Vec<usize> {
        let value = |condition: &Condition| Value {
            value: condition.times(unknowns.as_slice()) + condition.offset,
            magnitude: (condition.magnitude(unknowns.as_slice()) + condition.offset.abs())
                .max(unknowns.amax()),
        };
        (0..self.conditions.len()).filter(|&index| holds(value(&self.conditions[index]))).collect()
    }

    /// Adds the condition `weights . z + offset >= 0`.
    fn require(&mut self, weights: [(usize, f64); 2], offset: f64, meaning: Meaning) {
        self.conditions.push(Condition { weights, offset });
        self.meanings.push(meaning);
    }

    /// Where the mode exists. Up to infinity, the equations are expressed in the parameter `u = 1/t`.
    fn extent(&self, range: [f64; 2]) -> Extent {
        if range[1].is_finite() {
            return self.line.extent(&self.conditions, range);
        }
        let reciprocal = range[0].recip();
        let extent = self.line.reciprocal(&self.conditions).extent(&self.conditions, [0.0, reciprocal]);
        let Extent::Parts(mut parts) = extent else { return extent };
        // Forces that tend to zero have double zeros at infinity, which rounding moves.
        let infinity = INFINITY * reciprocal;
        parts.retain(|part| part.to.at > infinity);
        for part in parts.iter_mut().filter(|part| part.from.at <= infinity) {
            part.from = End { at: 0.0, cause: Cause::Range };
        }
        let back = |end: End| End { at: end.at.recip(), ..end };
        parts.reverse();
        Extent::Parts(
            parts.into_iter().map(|part| Part { from: back(part.to), to: back(part.from) }).collect(),
        )
    }

    fn interval(&self, part: &Part) -> ModeInterval {
        ModeInterval {
            pattern: self.pattern.to_vec(),
            from: self.end(&part.from, part.to.at),
            to: self.end(&part.to, part.from.at),
        }
    }

    fn end(&self, end: &End, other: f64) -> ModeEnd {
        let limits = self.line.limits(end, other);
        let normal_force = limits.map(|limits| {
            self.pattern.iter().zip(limits).map(|(state, limit)| limit.times(state.sign())).collect()
        });
        ModeEnd { at: end.at, cause: self.cause(&end.cause), normal_force }
    }

    /// The cause in terms of contacts.
    fn cause(&self, cause: &Cause) -> EndCause {
        let conditions = match cause {
            Cause::Range => return EndCause::Range,
            Cause::Singular => return EndCause::Singular,
            Cause::Conditions(conditions) => conditions,
        };
        let meanings: Vec<Meaning> = conditions.iter().map(|&condition| self.meanings[condition]).collect();
        cause_of(&meanings, &meanings).unwrap_or(EndCause::GreatestNormalForce(Vec::new()))
    }
}
