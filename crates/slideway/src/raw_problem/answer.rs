//! From a problem to its report: the search, and what is told of it.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

use super::continuum;
use super::listing::{Counts, Listing, Sort, list};
use super::nearby;
use super::report::{Faces, GapShare, RawGroup, RawReport, RawShares, RawSolution, SCHEMA, Unknowns};
use super::rounding::Proved;
use super::{RawKind, RawProblem};
use crate::modes::{
    CombinedState, Completeness, ContactState, GroupReport, GroupState, ModeProblem, ModeProblemError,
    Progress, SearchOptions, SearchResult, Side, SolutionProduct, StopReason, search,
};
use crate::report::Status;

/// Enclosures are computed as long as the sum of n^3 over the solutions is below this, ...
const ENCLOSURE_WORK: f64 = 3e7;
/// ... and of the first solution for up to so many unknowns.
const ENCLOSED_UNKNOWNS: usize = 500;
/// Solutions on a boundary are decided in rational numbers: only for so many unknowns.
const EXACT_UNKNOWNS: usize = 24;

/// All solutions of a raw problem.
///
/// Searches with `options` and lists up to `listed` solutions, gap states and continua each; the
/// counts are those of all. What is part of a continuum is not listed beside it. `progress` is called at every node and ends the search when it breaks.
///
/// # Errors
/// [`ModeProblemError::NotFinite`] if numbers overflow.
pub fn solve(
    raw: &RawProblem,
    options: &SearchOptions,
    listed: usize,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<RawReport, ModeProblemError> {
    solve_with(raw, options, Listing { most: listed, all_faces: false }, progress)
}

/// [`solve`], with more to say about what is listed.
///
/// # Errors
/// [`ModeProblemError::NotFinite`] if numbers overflow.
pub fn solve_with(
    raw: &RawProblem,
    options: &SearchOptions,
    listing: Listing,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<RawReport, ModeProblemError> {
    let problem = raw.mode_problem()?;
    let result = search(&problem, options, progress)?;
    let proved = Proved::of(raw, &problem);
    let counts = Counts::of(&result.product, false);
    let all = Counts::of(&result.product, true);
    let faces = all.minus(&counts);
    let listed = if listing.all_faces { &all } else { &counts };
    let open = open((&result, options), &proved, &counts);
    let mut report = RawReport {
        schema: SCHEMA,
        kind: raw.kind(),
        size: problem.contacts(),
        status: status(&result, &counts),
        complete: if open.is_empty() { "proven" } else { "not proven" },
        partial: is_partial(result.completeness),
        open,
        count: counts.points.to_string(),
        gap_state_count: counts.gaps.to_string(),
        continuum_count: counts.continua.to_string(),
        faces: Faces {
            solutions: faces.points.to_string(),
            gap_states: faces.gaps.to_string(),
            continua: faces.continua.to_string(),
            listed: listing.all_faces,
        },
        within_rounding: None,
        totals: [&listed.points, &listed.gaps, &listed.continua].map(ToString::to_string),
        solutions: Vec::new(),
        gap_states: Vec::new(),
        continua: Vec::new(),
        // Whoever has matrices has unknowns, no contacts.
        strategy: result.strategy().replace("contacts", "unknowns"),
        nodes: result.nodes(),
        groups: result.groups.iter().map(group).collect(),
    };
    let teller = Teller { raw, problem: &problem, proved: &proved };
    teller.list(&result.product, listed, listing, &mut report);
    if report.status == Status::None {
        let spent = (options, report.nodes);
        report.within_rounding = nearby::within_rounding(raw, &problem, spent, progress);
    }
    Ok(report)
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
        Some(0) if is_partial(result.completeness) => Status::Unknown,
        Some(0) => Status::None,
        _ => Status::Several,
    }
}

/// What keeps the list from being proven complete.
fn open((result, options): (&SearchResult, &SearchOptions), proved: &Proved, counts: &Counts) -> Vec<String> {
    let mut open = Vec::new();
    match result.completeness {
        Completeness::Proven => {}
        Completeness::NotProven => open.push(not_proven(&result.groups)),
        Completeness::Unexamined => {
            open.push(format!(
                "singular patterns were not examined: more than {} of a group of unknowns, or too many corners",
                options.limits.singular
            ));
        }
        Completeness::Partial(reason) => {
            let groups = result.groups.iter().filter(|group| group.shares.unexplored > 0.0).count();
            let reason = match reason {
                StopReason::Cancelled => "the search was ended by a time limit or on request".to_owned(),
                StopReason::SolutionLimit => {
                    format!("the limit of {} solutions of a group of unknowns", options.limits.solutions)
                        + " was reached (--max-found)"
                }
                StopReason::NodeLimit => {
                    format!("the limit of {} nodes was reached (--max-nodes)", options.nodes)
                }
            };
            open.push(format!("{reason}; {}", unexplored(groups)));
        }
    }
    // A list that is not complete stays so whatever the rounding.
    let rounded = match proved {
        Proved::Exact => None,
        Proved::Within { rounded, .. } => Some(format!("rounded in {rounded} of their entries")),
        Proved::Nothing => Some("rounded".to_owned()),
    };
    if let Some(rounded) = rounded.filter(|_| !proven_within(result, proved, counts)) {
        open.push(format!(
            "A + B and A - B are {rounded}: what is proven holds for the problem with the rounded numbers"
        ));
    }
    open
}

fn unexplored(groups: usize) -> String {
    match groups {
        0 => "some groups of unknowns were not searched".to_owned(),
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

/// Whether it is proven for the numbers before rounding, too, that the list is complete.
fn proven_within(result: &SearchResult, proved: &Proved, counts: &Counts) -> bool {
    let Some(points) = counts.points.to_u64().filter(|_| counts.continua.is_zero()) else { return false };
    let only = || {
        let mut states = result.product.states();
        points == 1
            && states.next().is_some_and(|state| proved.only_solution(&state.pattern(result.contacts)))
    };
    proved.number_of_solutions() == Some(points) || only()
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
            examined: shares.examined,
            // An empty sum is -0.
            unexplored: shares.unexplored + 0.0,
        },
        proven: report.proven,
    }
}

/// Tells states of the search in the words of the problem.
struct Teller<'a> {
    raw: &'a RawProblem,
    problem: &'a ModeProblem,
    proved: &'a Proved,
}

impl Teller<'_> {
    /// Fills the lists of the report.
    fn list(&self, product: &SolutionProduct, counts: &Counts, listing: Listing, report: &mut RawReport) {
        let size = self.problem.contacts();
        let mut ends = Vec::new();
        list(product, (counts, Sort::Point), listing, &mut |state| {
            let number = report.solutions.len();
            report.solutions.push(self.point(state, number));
            ends.push(state.support(size));
        });
        list(product, (counts, Sort::Gap), listing, &mut |state| {
            report.gap_states.push(self.point(state, 0));
        });
        let mut continua = Vec::new();
        list(product, (counts, Sort::Continuum), listing, &mut |state| {
            report.continua.push(continuum::told(state, self.kind(), size, listing.most));
            continua.push(state.support(size));
        });
        for (solution, end) in report.solutions.iter_mut().zip(&ends).filter(|(one, _)| !one.maximal) {
            solution.end_of_continuum = continua.iter().position(|continuum| end.is_part_of(continuum));
        }
    }

    fn kind(&self) -> RawKind {
        self.raw.kind()
    }

    fn point(&self, state: &CombinedState<'_>, number: usize) -> RawSolution {
        let size = self.problem.contacts();
        let pattern = state.pattern(size);
        let signed = state.normal_force(size).unwrap_or_else(|| DVector::zeros(size));
        let in_gap = |at: usize| pattern[at] == ContactState::Gap;
        let gaps = gap_shares(state);
        let signs: Vec<i8> = signed.iter().map(|value| sign(*value)).collect();
        let on_boundary = signs.iter().enumerate().any(|(at, &sign)| sign == 0 && !in_gap(at));
        let singular = state.parts.iter().any(|(_, part)| matches!(part, GroupState::Singular(_)));
        let work = (number as f64 + 1.0) * (size as f64).powi(3);
        let affordable = (work <= ENCLOSURE_WORK || (number == 0 && size <= ENCLOSED_UNKNOWNS))
            && (!on_boundary || size <= EXACT_UNKNOWNS);
        let enclosure_radius = (affordable && !singular && gaps.is_empty())
            .then(|| self.proved.radius(self.problem, &pattern, signed.as_slice()))
            .flatten();
        RawSolution {
            unknowns: Unknowns::new(self.kind(), signed.as_slice()),
            signs,
            on_boundary,
            maximal: state.is_maximal(),
            enclosure_radius,
            residual: self.residual(&signed, &pattern, &gaps),
            gaps,
            end_of_continuum: None,
        }
    }

    /// What is left over in the equations as they were given, without use of the mode problem's
    /// columns for those that are not one.
    fn residual(&self, signed: &DVector<f64>, pattern: &[ContactState], gaps: &[GapShare]) -> f64 {
        let (positive, negative) = (signed.map(|v| v.max(0.0)), signed.map(|v| (-v).max(0.0)));
        let terms: Vec<(&DMatrix<f64>, DVector<f64>)>;
        let load;
        match self.raw {
            // M z - w + q = 0
            RawProblem::LinearComplementarity { m, q } => {
                let size = m.abs() * &positive + &negative + q.abs();
                return relative(&(m * &positive - &negative + q), &size);
            }
            // A x + B |x| - b = 0
            RawProblem::AbsoluteValue { a, b, right_hand_side } => {
                terms = vec![(a, signed.clone()), (b, signed.abs())];
                load = right_hand_side.clone();
            }
            // A w - B z - q = 0
            RawProblem::HorizontalComplementarity { a, b, q } => {
                terms = vec![(a, negative), (b, -positive)];
                load = q.clone();
            }
            // sum c_k y_k - N(0) - sum d_k = 0
            RawProblem::Modes(problem) => {
                terms = Side::BOTH
                    .map(|side| {
                        let y = if side == Side::Positive { positive.clone() } else { negative.clone() };
                        (problem.columns(side), y)
                    })
                    .to_vec();
                load = with_jumps(problem, pattern, gaps);
            }
        }
        let mut sum = -&load;
        let mut size = load.abs();
        for (matrix, values) in &terms {
            sum += *matrix * values;
            size += matrix.abs() * values.abs();
        }
        relative(&sum, &size)
    }
}

fn gap_shares(state: &CombinedState<'_>) -> Vec<GapShare> {
    let mut shares = Vec::new();
    for (indices, part) in &state.parts {
        if let GroupState::Gap(gap) = part {
            let share = |share: &crate::modes::GapShare| GapShare {
                index: indices[share.contact],
                lambda: share.lambda,
            };
            shares.extend(gap.shares.iter().map(share));
        }
    }
    shares.sort_by_key(|share| share.index);
    shares
}

/// `N(0) + sum_k d_k`, in a gap `lambda d_k^+ + (1 - lambda) d_k^-`.
fn with_jumps(problem: &ModeProblem, pattern: &[ContactState], gaps: &[GapShare]) -> DVector<f64> {
    let mut load = problem.right_hand_side().clone();
    for (at, state) in pattern.iter().enumerate() {
        let gap = gaps.iter().find(|gap| gap.index == at);
        let positive = match state {
            ContactState::Positive => 1.0,
            ContactState::Negative => 0.0,
            ContactState::Gap => gap.map_or(0.5, |gap| gap.lambda),
        };
        load.axpy(positive, &problem.jumps(Side::Positive).column(at), 1.0);
        load.axpy(1.0 - positive, &problem.jumps(Side::Negative).column(at), 1.0);
    }
    load
}

/// The largest entry of `sum` against the largest entry of `size`.
fn relative(sum: &DVector<f64>, size: &DVector<f64>) -> f64 {
    let scale = size.amax();
    if scale > 0.0 && scale.is_finite() { sum.amax() / scale } else { 0.0 }
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

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
