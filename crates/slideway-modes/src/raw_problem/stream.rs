//! Answers state by state, as soon as each is certain.

use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

use super::answer::{Teller, without_lists};
use super::correspondence::Correspondence;
use super::listing::Counts;
use super::report::{RawConclusion, RawLine, RawReport};
use super::{RawProblem, block_answer, free, nearby};
use crate::problem::ModeProblemError;
use crate::progress::{Callback, Progress};
use crate::search::{CombinedState, SearchOptions, SolutionProduct, search_telling};
use crate::solutions::Support;
use crate::status::Status;

/// All solutions of a raw problem, one after the other, and at last how many there are.
///
/// `write` receives each solution, gap state and continuum as soon as it is proven, and ends the work by breaking.
/// What it receives stays true, whatever ends the search. Nothing is received twice, but a set may contain what was
/// received before it: [`RawConclusion::part_of_others`] tells which. If the unknowns are searched in several groups,
/// the states are combinations of theirs: they come after the search, only those that are not part of others, and
/// are not held in memory. Once `progress` has broken, at most `most` more follow. Of each part of a
/// continuum there are up to `most` vertices and directions.
///
/// # Errors
/// As [`solve`](super::solve).
///
/// ```
/// use slideway_modes::SearchOptions;
/// use slideway_modes::raw_problem::{RawLine, RawProblem, solve_streaming};
/// use std::ops::ControlFlow;
///
/// let problem = RawProblem::from_json(br#"{"type": "lcp", "M": [[1, 2], [2, 1]], "q": [-1, -1]}"#)?;
/// let mut solutions = 0;
/// let conclusion = solve_streaming(
///     &problem,
///     &SearchOptions::default(),
///     10,
///     &mut |_| ControlFlow::Continue(()),
///     &mut |line| {
///         solutions += usize::from(matches!(line, RawLine::Solution(_)));
///         ControlFlow::Continue(())
///     },
/// )?;
/// assert_eq!((solutions, conclusion.report.count.as_str(), conclusion.lines), (3, "3", 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve_streaming(
    raw: &RawProblem,
    options: &SearchOptions,
    most: usize,
    progress: &mut Callback<'_>,
    write: &mut dyn FnMut(&RawLine) -> ControlFlow<()>,
) -> Result<RawConclusion, ModeProblemError> {
    if let RawProblem::BlockAbsoluteValue(equation) = raw {
        return Ok(told_at_last(block_answer::solve(equation, options, usize::MAX, progress), write));
    }
    let problem = raw.mode_problem()?;
    let correspondence = Correspondence::of(raw);
    let teller = Teller::new(raw, &correspondence, &problem);
    let mut stream =
        Stream { teller, size: problem.contacts(), most, write, lines: 0, places: HashMap::new() };
    let result = search_telling(&problem, options, progress, &mut |state| stream.tell_new(state));
    let result = free::with_whole_continua(result, &correspondence);
    let all_written = stream.tell_rest(&result.product, progress);
    let (lines, part_of_others) = (stream.lines, stream.part_of_others(&result.product));
    let counts = Counts::of(&result.product);
    let mut report = without_lists(raw, &correspondence, (&result, &counts), options);
    if report.status == Status::None {
        let spent = (options, report.nodes);
        report.within_rounding = nearby::within_rounding((raw, &correspondence), &problem, spent, progress);
    }
    Ok(RawConclusion { report, lines, all_written, part_of_others, seconds: None })
}

/// Writes the solutions of a search that has ended.
fn told_at_last(mut report: RawReport, write: &mut dyn FnMut(&RawLine) -> ControlFlow<()>) -> RawConclusion {
    let mut lines = 0;
    let mut all_written = true;
    for solution in std::mem::take(&mut report.solutions) {
        lines += 1;
        all_written = write(&RawLine::Solution(solution)).is_continue();
        if !all_written {
            break;
        }
    }
    RawConclusion { report, lines, all_written, part_of_others: Vec::new(), seconds: None }
}

/// The lines that are written.
struct Stream<'a, 'w> {
    teller: Teller<'a>,
    size: usize,
    most: usize,
    write: &'w mut dyn FnMut(&RawLine) -> ControlFlow<()>,
    lines: u64,
    /// The lines of states that were written during the search, by what is positive in them: equal sets have
    /// the same positive unknowns.
    places: HashMap<Support, u64>,
}

impl Stream<'_, '_> {
    /// Writes a state that the search tells, unless it is written already.
    fn tell_new(&mut self, state: &CombinedState<'_>) -> ControlFlow<()> {
        let support = state.support(self.size);
        if self.places.contains_key(&support) {
            return ControlFlow::Continue(());
        }
        self.places.insert(support, self.lines + 1);
        self.tell(state)
    }

    fn tell(&mut self, state: &CombinedState<'_>) -> ControlFlow<()> {
        let line = self.teller.told(state, usize::try_from(self.lines).unwrap_or(usize::MAX), self.most);
        self.lines += 1;
        (self.write)(&line)
    }

    /// Writes the states that are not part of others and not written yet; whether these are all.
    fn tell_rest(&mut self, product: &SolutionProduct, progress: &mut Callback<'_>) -> bool {
        let mut late = 0;
        for state in product.states().filter(CombinedState::is_maximal) {
            if !self.places.is_empty() && self.places.contains_key(&state.support(self.size)) {
                continue;
            }
            let told = Progress { counted: "lines", done: self.lines, fraction: None, found: None };
            late += usize::from(progress(&told).is_break());
            if late > self.most || self.tell(&state).is_break() {
                return false;
            }
        }
        true
    }

    /// The lines, from 1, of states that are part of others.
    fn part_of_others(&self, product: &SolutionProduct) -> Vec<u64> {
        if self.places.is_empty() {
            return Vec::new();
        }
        let maximal = product.states().filter(CombinedState::is_maximal);
        let maximal: HashSet<Support> = maximal.map(|state| state.support(self.size)).collect();
        let parts = self.places.iter().filter(|(support, _)| !maximal.contains(*support));
        let mut lines: Vec<u64> = parts.map(|(_, &line)| line).collect();
        lines.sort_unstable();
        lines
    }
}
