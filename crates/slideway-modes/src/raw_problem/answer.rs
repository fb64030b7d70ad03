//! From a problem to its report: the search, and what is reported.

use super::correspondence::Correspondence;
use super::listing::{Counts, Sort, list};
use super::range::{ExactUnknowns, in_range};
use super::report::{RawContinuum, RawGroup, RawLine, RawReport, RawShares, RawSolution, SCHEMA};
use super::residual::{Equations, exact};
use super::values::Values;
use super::{RawProblem, block_answer, continuum, free, nearby};
use crate::certificate::{Decision, decide};
use crate::interval::Interval;
use crate::problem::{ContactState, ModeProblem, ModeProblemError};
use crate::progress::Callback;
use crate::search::{
    CombinedState, Completeness, GroupReport, GroupState, SearchOptions, SearchResult, SolutionProduct,
    StopReason, search,
};
use crate::status::{Proof, Status};

/// Enclosures are computed as long as the sum of n^3 over the solutions is below this, ...
const ENCLOSURE_WORK: f64 = 3e7;
/// ... and for the first solution with up to this many unknowns.
const ENCLOSED_UNKNOWNS: usize = 500;
/// Solutions on a boundary are decided in rational numbers only for up to this many unknowns.
const EXACT_UNKNOWNS: usize = 24;
/// Values of so few unknowns are exact ones, rounded, if error bounds are wider than this part of the largest value.
const WIDE: f64 = 1e-9;

/// All solutions of a raw problem.
///
/// Searches with `options` and lists up to `most` solutions, gap states and continua each, and up to as many
/// vertices and directions of each part of a continuum; the counts include all of them. What is part of a
/// larger continuum is neither listed nor counted. `progress` is called at every node and during long steps,
/// and ends the search by breaking.
///
/// # Errors
/// [`ModeProblemError::NotFinite`] if `A + B` of an absolute value equation overflows.
pub fn solve(
    raw: &RawProblem,
    options: &SearchOptions,
    most: usize,
    progress: &mut Callback<'_>,
) -> Result<RawReport, ModeProblemError> {
    if let RawProblem::BlockAbsoluteValue(equation) = raw {
        return Ok(block_answer::solve(equation, options, most, progress));
    }
    let problem = raw.mode_problem()?;
    let correspondence = Correspondence::of(raw);
    let result = free::with_whole_continua(search(&problem, options, progress), &correspondence);
    let counts = Counts::of(&result.product);
    let mut report = without_lists(raw, &correspondence, (&result, &counts), options);
    Teller::new(raw, &correspondence, &problem).list(&result.product, &counts, most, &mut report);
    if report.status == Status::None && most > 0 {
        let spent = (options, report.nodes);
        report.within_rounding = nearby::within_rounding((raw, &correspondence), &problem, spent, progress);
    }
    Ok(report)
}

/// The report of a search without its solutions.
pub(super) fn without_lists(
    raw: &RawProblem,
    correspondence: &Correspondence,
    (result, counts): (&SearchResult, &Counts),
    options: &SearchOptions,
) -> RawReport {
    let open = open(result, options);
    RawReport {
        schema: SCHEMA,
        kind: raw.kind(),
        size: correspondence.size(),
        first: correspondence.first(),
        status: status(result, counts),
        complete: if open.is_empty() { Proof::Proven } else { Proof::NotProven },
        partial: is_partial(result.completeness),
        open,
        count: counts.points.to_string(),
        gap_state_count: counts.gaps.to_string(),
        continuum_count: counts.continua.to_string(),
        within_rounding: None,
        every_right_hand_side: None,
        solutions: Vec::new(),
        gap_states: Vec::new(),
        continua: Vec::new(),
        // Users who supply matrices have unknowns, not contacts.
        strategy: result.strategy().replace("contacts", "unknowns"),
        nodes: result.nodes(),
        groups: result.groups.iter().map(group).collect(),
    }
}

fn is_partial(completeness: Completeness) -> bool {
    matches!(completeness, Completeness::Partial(_) | Completeness::Unexamined)
}

fn status(result: &SearchResult, counts: &Counts) -> Status {
    if !counts.continua.is_zero() {
        return Status::Continuum;
    }
    match counts.points.to_u64() {
        Some(1) => Status::One,
        Some(0) if !counts.gaps.is_zero() => Status::PreloadGap,
        Some(0) if result.completeness == Completeness::Proven => Status::None,
        Some(0) => Status::Unknown,
        _ => Status::Several,
    }
}

/// Returns the reasons, in words, why the list is not proven complete; empty if it is.
fn open(result: &SearchResult, options: &SearchOptions) -> Vec<String> {
    match result.completeness {
        Completeness::Proven => Vec::new(),
        Completeness::NotProven => vec![not_proven(&result.groups)],
        Completeness::Unexamined => {
            vec![format!(
                "singular patterns were not examined: more than {} in a group of unknowns",
                options.limits.singular
            )]
        }
        Completeness::Partial(reason) => {
            let groups = result.groups.iter().filter(|group| group.shares.unexplored > 0.0).count();
            vec![format!("{}; {}", stopped(reason, options), unexplored(groups))]
        }
    }
}

/// Why a search ended early.
pub(super) fn stopped(reason: StopReason, options: &SearchOptions) -> String {
    match reason {
        StopReason::Cancelled => "the search was stopped by a time limit or on request".to_owned(),
        StopReason::SolutionLimit if options.limits.solutions == 1 => {
            "the search ended when it had a solution (--any)".to_owned()
        }
        StopReason::SolutionLimit => {
            format!("the limit of {} solutions of a group of unknowns", options.limits.solutions)
                + " was reached (--max-found)"
        }
        StopReason::NodeLimit => format!("the limit of {} nodes was reached (--max-nodes)", options.nodes),
    }
}

fn unexplored(groups: usize) -> String {
    match groups {
        0 => "some groups of unknowns were not searched for every solution of others".to_owned(),
        1 => "a group of unknowns was not searched to its end".to_owned(),
        groups => format!("{groups} groups of unknowns were not searched to their end"),
    }
}

fn not_proven(groups: &[GroupReport]) -> String {
    let patterns: u64 = groups.iter().map(|group| group.unproven_patterns).sum();
    match patterns {
        0 => "the search was complete, but exclusions or solutions that others depend on are not proven"
            .to_owned(),
        1 => "the search was complete, but the outcome of 1 pattern is not proven".to_owned(),
        patterns => {
            format!("the search was complete, but the outcomes of {patterns} patterns are not proven")
        }
    }
}

fn group(report: &GroupReport) -> RawGroup {
    let shares = &report.shares;
    RawGroup {
        indices: report.contacts.clone(),
        method: report.method.to_string(),
        nodes: report.nodes,
        patterns: RawShares {
            uniqueness: shares.uniqueness,
            cells: shares.cells,
            propagation: shares.propagation,
            relaxation: shares.relaxation,
            faces: shares.faces,
            examined: shares.examined,
            // An empty sum is -0.
            unexplored: shares.unexplored + 0.0,
        },
        proven: report.proven,
    }
}

/// Describes states of the search in the terms of the problem.
pub(super) struct Teller<'a> {
    correspondence: &'a Correspondence,
    problem: &'a ModeProblem,
    equations: Equations<'a>,
}

impl<'a> Teller<'a> {
    pub(super) fn new(
        raw: &'a RawProblem,
        correspondence: &'a Correspondence,
        problem: &'a ModeProblem,
    ) -> Self {
        Self { correspondence, problem, equations: Equations::of(raw, problem) }
    }

    /// Returns a state as a line of a stream, given how many solutions were written before.
    pub(super) fn told(&self, state: &CombinedState<'_>, number: usize, most: usize) -> RawLine {
        match Sort::of(state) {
            Sort::Point => RawLine::Solution(self.point(state, number)),
            Sort::Gap => RawLine::GapState(self.point(state, number)),
            Sort::Continuum => RawLine::Continuum(self.continuum(state, most)),
        }
    }

    /// Fills the lists of the report.
    fn list(&self, product: &SolutionProduct, counts: &Counts, most: usize, report: &mut RawReport) {
        list(product, (counts, Sort::Point), most, &mut |state| {
            let number = report.solutions.len();
            report.solutions.push(self.point(state, number));
        });
        list(product, (counts, Sort::Gap), most, &mut |state| {
            report.gap_states.push(self.point(state, 0));
        });
        list(product, (counts, Sort::Continuum), most, &mut |state| {
            report.continua.push(self.continuum(state, most));
        });
    }

    fn continuum(&self, state: &CombinedState<'_>, most: usize) -> RawContinuum {
        continuum::told(state, self.correspondence, self.problem, most)
    }

    fn point(&self, state: &CombinedState<'_>, number: usize) -> RawSolution {
        let size = self.problem.contacts();
        let pattern = state.pattern(size);
        let mut values = Values::new(state, size);
        let signs = self.correspondence.signs(&values.signed);
        let is_on_boundary = |(at, &value): (usize, &f64)| {
            value == 0.0 && pattern[at] != ContactState::Gap && self.correspondence.has_boundary(at)
        };
        let on_boundary = values.signed.iter().enumerate().any(is_on_boundary);
        let is_degenerate = on_boundary || values.signed.contains(&0.0);
        let mut exact_unknowns = ExactUnknowns::new(self.problem, &pattern, &values.signed);
        let beyond_range = values.settle(self.correspondence, &mut exact_unknowns);
        let singular = state.parts.iter().any(|(_, part)| matches!(part, GroupState::Singular(_)));
        let work = (number as f64 + 1.0) * (size as f64).powi(3);
        let exactly = singular || is_degenerate || !beyond_range.is_empty();
        let affordable = (work <= ENCLOSURE_WORK || (number == 0 && size <= ENCLOSED_UNKNOWNS))
            && (!exactly || size <= EXACT_UNKNOWNS);
        // Where sums lose digits, so do bounds on what they are computed with.
        let is_exact = singular || !values.sums.is_empty();
        let mut radius = |values: &mut Values| {
            let exact = is_exact.then(|| self.exact_radius(&mut exact_unknowns, values)).flatten();
            let within = exact.or_else(|| (!singular).then(|| self.radius(state, values)).flatten());
            let is_doubtful =
                size <= EXACT_UNKNOWNS && within.is_none_or(|radius| self.is_wide(values, radius));
            if singular || !is_doubtful {
                return within;
            }
            values.round_exactly(&mut exact_unknowns);
            self.exact_radius(&mut exact_unknowns, values)
        };
        let enclosure_radius = (affordable && values.gaps.is_empty())
            .then(|| radius(&mut values))
            .flatten()
            .map(|radius| match self.correspondence.rounding(&values.signed, &values.sums) {
                0.0 => radius,
                rounding => (radius + rounding).next_up(),
            })
            .map(|radius| radius.max(values.sums.error()));
        RawSolution {
            unknowns: self.correspondence.unknowns(&values.signed, &values.sums),
            signs,
            on_boundary,
            enclosure_radius,
            residual: values.residual(&self.equations, &pattern),
            beyond_range,
            gaps: values.gaps,
            shares_vary: state.shares_vary(),
        }
    }

    /// Returns the maximum distance of a pattern's values from those of its exact solution; `None` if
    /// unknown. Sums, values without a floating-point number, and those that are not reported, are ignored.
    fn radius(&self, state: &CombinedState<'_>, values: &Values) -> Option<f64> {
        let of_all = match state.parts.as_slice() {
            [(_, part)] => part.unknowns().map(<[Interval]>::to_vec),
            // Bounds of a group cover what is not known of the groups before.
            _ => None,
        };
        let decided = || match decide(self.problem, &state.pattern(values.signed.len())).decision {
            Decision::Solution { unknowns, .. } | Decision::Boundary { unknowns, .. } => Some(unknowns),
            _ => None,
        };
        let unknowns = of_all.or_else(decided)?;
        let distance = |at: usize| {
            let (bounds, value) = (unknowns[at], values.signed[at].abs());
            let largest = (bounds.upper() - value).max(value - bounds.lower());
            if largest > 0.0 { largest.next_up() } else { 0.0 }
        };
        let radius = self.told_values(values).map(distance).fold(0.0, f64::max);
        radius.is_finite().then_some(radius)
    }

    /// Returns the maximum distance of the values from those of a point that is known exactly; `None` if
    /// unknown. It ignores the values that `radius` ignores.
    fn exact_radius(&self, exact_unknowns: &mut ExactUnknowns<'_>, values: &Values) -> Option<f64> {
        let mut distance = |at: usize| {
            let error = exact_unknowns.of(at)? - exact(values.signed[at].abs())?;
            Some(Interval::around_ratio(&error).magnitude())
        };
        self.told_values(values).try_fold(0.0, |most: f64, at| Some(most.max(distance(at)?)))
    }

    /// Whether errors of this size are wide, relative to the largest value.
    fn is_wide(&self, values: &Values, error: f64) -> bool {
        let sizes = self.told_values(values).map(|at| values.signed[at].abs());
        error > WIDE * sizes.fold(0.0, f64::max)
    }

    /// Finds the unknowns of the mode problem whose values are reported as they are.
    fn told_values(&self, values: &Values) -> impl Iterator<Item = usize> {
        let is_told = |&at: &usize| {
            let value = values.signed[at];
            in_range(value) && self.correspondence.tells(at, value) && values.sums.value(at).is_none()
        };
        (0..values.signed.len()).filter(is_told)
    }
}

#[cfg(test)]
mod tests {
    use super::super::report::Unknowns;
    use super::*;
    use std::ops::ControlFlow;

    #[test]
    fn a_ray_is_told_with_its_end_and_direction() {
        let raw = RawProblem::from_json(br#"{"type": "lcp", "M": [[1, -1], [-1, 1]], "q": [-1, 1]}"#)
            .expect("a problem");
        let report =
            solve(&raw, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(())).expect("finite");
        assert_eq!(report.status, Status::Continuum);
        let [ray] = report.continua.as_slice() else { panic!("one ray") };
        let [ray] = ray.parts.as_slice() else { panic!("one part") };
        assert_eq!(ray.vertices, [Unknowns::Complementary { z: vec![1.0, 0.0], w: vec![0.0, 0.0] }]);
        assert_eq!(ray.directions, [Unknowns::Complementary { z: vec![1.0, 1.0], w: vec![0.0, 0.0] }]);
    }
}
