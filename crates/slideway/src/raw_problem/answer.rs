//! From a problem to its report: the search, and what is told of it.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::range::in_range;
use super::report::{RawContinuum, RawGroup, RawReport, RawShares, RawSolution, SCHEMA, Unknowns};
use super::residual::Equations;
use super::values::Values;
use super::{RawKind, RawProblem};
use crate::modes::certificate::{Decision, Interval, decide};
use crate::modes::{
    BigCount, CombinedState, Completeness, ContactState, GroupReport, GroupState, ModeProblem,
    ModeProblemError, Progress, SearchOptions, SearchResult, SolutionProduct, StopReason, search,
};
use crate::report::Status;

/// The most vertices of one continuum that are told.
const VERTICES: usize = 1024;
/// Enclosures are computed as long as the sum of n^3 over the solutions is below this, ...
const ENCLOSURE_WORK: f64 = 3e7;
/// ... and of the first solution for up to so many unknowns.
const ENCLOSED_UNKNOWNS: usize = 500;
/// Solutions on a boundary are decided in rational numbers: only for so many unknowns.
const EXACT_UNKNOWNS: usize = 24;
/// Solutions that differ by less than this, relative to the largest unknown, are the same.
const SAME: f64 = 1e-9;

/// All solutions of a raw problem.
///
/// Searches with `options` and lists up to `listed` solutions, gap states and continua each; the
/// counts are those of all. `progress` is called at every node and ends the search when it breaks.
///
/// # Errors
/// [`ModeProblemError::NotFinite`] if `A + B` of an absolute value equation overflows.
pub fn solve(
    raw: &RawProblem,
    options: &SearchOptions,
    listed: usize,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<RawReport, ModeProblemError> {
    let problem = raw.mode_problem()?;
    let result = search(&problem, options, progress)?;
    let counts = Counts::of(&result.product);
    let open = open(&result);
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
        solutions: Vec::new(),
        gap_states: Vec::new(),
        continua: Vec::new(),
        // Whoever has matrices has unknowns, no contacts.
        strategy: result.strategy().replace("contacts", "unknowns"),
        nodes: result.nodes(),
        groups: result.groups.iter().map(group).collect(),
    };
    let teller = Teller { raw, problem: &problem, equations: Equations::of(raw) };
    teller.list(&result.product, &counts, listed, &mut report);
    Ok(report)
}

/// What a combination of groups' states is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sort {
    Point,
    Gap,
    Continuum,
}

impl Sort {
    fn of(state: &GroupState) -> Self {
        match state {
            GroupState::Singular(mode) if mode.set.is_continuum() => Self::Continuum,
            // Raw problems are exact: every pattern is decided.
            GroupState::Undecided(_) => Self::Continuum,
            GroupState::Gap(_) => Self::Gap,
            GroupState::Singular(mode) if mode.pattern.contains(&ContactState::Gap) => Self::Gap,
            GroupState::Solution(_) | GroupState::Singular(_) => Self::Point,
        }
    }
}

struct Counts {
    points: BigCount,
    gaps: BigCount,
    continua: BigCount,
}

impl Counts {
    fn of(product: &SolutionProduct) -> Self {
        let [points, with_gaps, all] = cumulated(product);
        Self { gaps: with_gaps.minus(&points), continua: all.minus(&with_gaps), points }
    }
}

/// Numbers of combinations: of points; with gap states; with continua.
fn cumulated(product: &SolutionProduct) -> [BigCount; 3] {
    let mut total = [1, 1, 1].map(BigCount::from);
    for factor in &product.factors {
        let mut sums = <[BigCount; 3]>::default();
        for alternative in &factor.alternatives {
            let dependents = cumulated(&alternative.dependents);
            for sort in Sort::of(&alternative.state) as usize..3 {
                sums[sort] = sums[sort].plus(&dependents[sort]);
            }
        }
        total = [0, 1, 2].map(|sort| total[sort].times(&sums[sort]));
    }
    total
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

/// What keeps the list from being proven complete.
fn open(result: &SearchResult) -> Vec<String> {
    match result.completeness {
        Completeness::Proven => Vec::new(),
        Completeness::NotProven => vec![not_proven(&result.groups)],
        Completeness::Unexamined => {
            vec!["singular patterns were not examined, because there are too many of them".to_owned()]
        }
        Completeness::Partial(reason) => {
            let groups = result.groups.iter().filter(|group| group.shares.unexplored > 0.0).count();
            let reason = match reason {
                StopReason::Cancelled => "the search was ended by a time limit or on request".to_owned(),
                limit => limit.to_string(),
            };
            vec![format!("{reason}; {}", unexplored(groups))]
        }
    }
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
    equations: Equations<'a>,
}

impl Teller<'_> {
    /// Fills the lists of the report, `most` in each.
    fn list(&self, product: &SolutionProduct, counts: &Counts, most: usize, report: &mut RawReport) {
        let wanted = |count: &BigCount| {
            count.to_u64().and_then(|count| usize::try_from(count).ok()).map_or(most, |count| count.min(most))
        };
        let (points, gaps, continua) =
            (wanted(&counts.points), wanted(&counts.gaps), wanted(&counts.continua));
        // Combinations of one sort first, so that none has to be sought among many of the others.
        let list = |wanted: Sort, count: usize, take: &mut dyn FnMut(&CombinedState<'_>)| {
            if count > 0 {
                let product = of_sort(product, wanted);
                product
                    .states()
                    .filter(|state| sort(state) == wanted)
                    .take(count)
                    .for_each(|state| take(&state));
            }
        };
        list(Sort::Point, points, &mut |state| {
            let number = report.solutions.len();
            report.solutions.push(self.point(state, number));
        });
        list(Sort::Gap, gaps, &mut |state| report.gap_states.push(self.point(state, 0)));
        list(Sort::Continuum, continua, &mut |state| report.continua.push(self.continuum(state)));
        for solution in &mut report.solutions {
            let ends_it =
                |continuum: &RawContinuum| continuum.vertices.iter().any(|end| same(end, &solution.unknowns));
            solution.end_of_continuum = report.continua.iter().position(ends_it);
        }
    }

    fn kind(&self) -> RawKind {
        self.raw.kind()
    }

    fn point(&self, state: &CombinedState<'_>, number: usize) -> RawSolution {
        let size = self.problem.contacts();
        let pattern = state.pattern(size);
        let mut values = Values::new(state, size);
        let signs: Vec<i8> = values.signed.iter().map(|value| sign(*value)).collect();
        let in_gap = |at: usize| pattern[at] == ContactState::Gap;
        let on_boundary = signs.iter().enumerate().any(|(at, &sign)| sign == 0 && !in_gap(at));
        let beyond_range = values.settle(self.kind(), self.problem, &pattern);
        let singular = state.parts.iter().any(|(_, part)| matches!(part, GroupState::Singular(_)));
        let work = (number as f64 + 1.0) * (size as f64).powi(3);
        let exactly = on_boundary || !beyond_range.is_empty();
        let affordable = (work <= ENCLOSURE_WORK || (number == 0 && size <= ENCLOSED_UNKNOWNS))
            && (!exactly || size <= EXACT_UNKNOWNS);
        let enclosure_radius = (affordable && !singular && values.gaps.is_empty())
            .then(|| radius(self.problem, &pattern, &values.signed))
            .flatten();
        RawSolution {
            unknowns: Unknowns::new(self.kind(), &values.signed),
            signs,
            on_boundary,
            enclosure_radius,
            residual: values.residual(&self.equations, &pattern),
            beyond_range,
            gaps: values.gaps,
            end_of_continuum: None,
        }
    }

    fn continuum(&self, state: &CombinedState<'_>) -> RawContinuum {
        let size = self.problem.contacts();
        let mut vertices = vec![DVector::zeros(size)];
        let mut directions = Vec::new();
        let mut all_vertices = true;
        for (indices, part) in &state.parts {
            let placed = |values: &DVector<f64>, base: &DVector<f64>| {
                let mut placed = base.clone();
                indices.iter().zip(values).for_each(|(&index, &value)| placed[index] = value);
                placed
            };
            let ends = match part {
                GroupState::Singular(mode) => mode.set.vertices(),
                part => part.normal_force().into_iter().collect(),
            };
            if vertices.len() * ends.len() > VERTICES {
                all_vertices = false;
            }
            vertices = ends
                .iter()
                .flat_map(|end| vertices.iter().map(|base| placed(end, base)))
                .take(VERTICES)
                .collect();
            if let GroupState::Singular(mode) = part {
                directions
                    .extend(mode.set.directions().into_iter().map(|d| placed(d, &DVector::zeros(size))));
            }
        }
        let unknowns = |signed: &DVector<f64>| Unknowns::new(self.kind(), signed.as_slice());
        RawContinuum {
            pattern: state.pattern(size).into_iter().map(character).collect(),
            vertices: vertices.iter().map(unknowns).collect(),
            directions: directions.iter().map(unknowns).collect(),
            all_vertices,
        }
    }
}

/// The combinations of a product that are at most of a sort; those of that sort come early.
fn of_sort(product: &SolutionProduct, most: Sort) -> SolutionProduct {
    let mut product = product.clone();
    restrict(&mut product, most);
    product
}

/// Drops what is beyond a sort, and returns the greatest sort of the combinations that are left; none
/// if there are no combinations.
fn restrict(product: &mut SolutionProduct, most: Sort) -> Option<Sort> {
    let mut greatest = Some(Sort::Point);
    for factor in &mut product.factors {
        let mut sorted = Vec::new();
        for mut alternative in std::mem::take(&mut factor.alternatives) {
            let own = Sort::of(&alternative.state);
            if own <= most
                && let Some(dependents) = restrict(&mut alternative.dependents, most)
            {
                sorted.push((own.max(dependents), alternative));
            }
        }
        sorted.sort_by_key(|(sort, _)| std::cmp::Reverse(*sort));
        let first = sorted.first().map(|(sort, _)| *sort);
        greatest = greatest.zip(first).map(|(one, other)| one.max(other));
        factor.alternatives = sorted.into_iter().map(|(_, alternative)| alternative).collect();
    }
    greatest
}

fn sort(state: &CombinedState<'_>) -> Sort {
    state.parts.iter().map(|(_, part)| Sort::of(part)).max().unwrap_or(Sort::Point)
}

/// How far values of a pattern may be from those of its exact solution; none if that is not known. Values that have
/// no floating-point number are left out.
fn radius(problem: &ModeProblem, pattern: &[ContactState], values: &[f64]) -> Option<f64> {
    let (Decision::Solution { unknowns, .. } | Decision::Boundary { unknowns, .. }) =
        decide(problem, pattern).decision
    else {
        return None;
    };
    let distance = |(bounds, value): (&Interval, &f64)| {
        let largest = (bounds.upper() - value.abs()).max(value.abs() - bounds.lower());
        if largest > 0.0 { largest.next_up() } else { 0.0 }
    };
    let known = unknowns.iter().zip(values).filter(|(_, value)| in_range(**value));
    let radius = known.map(distance).fold(0.0, f64::max);
    radius.is_finite().then_some(radius)
}

/// Whether two solutions are the same but for rounding.
fn same(one: &Unknowns, other: &Unknowns) -> bool {
    one.named().iter().zip(other.named()).all(|((_, one), (_, other))| {
        let scale = one.iter().fold(0.0, |scale: f64, value| scale.max(value.abs()));
        one.iter().zip(other).all(|(one, other)| (one - other).abs() <= SAME * scale)
    })
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

fn character(state: ContactState) -> char {
    match state {
        ContactState::Positive => '+',
        ContactState::Negative => '-',
        ContactState::Gap => '0',
    }
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
        assert_eq!(ray.vertices, [Unknowns::Complementary { z: vec![1.0, 0.0], w: vec![0.0, 0.0] }]);
        assert_eq!(ray.directions, [Unknowns::Complementary { z: vec![1.0, 1.0], w: vec![0.0, 0.0] }]);
    }
}
