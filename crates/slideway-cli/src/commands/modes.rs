//! `slideway modes`

use crate::Outcome;
use crate::arguments::{ModesArguments, ModesFormat};
use crate::failure::Failure;
use crate::input;
use crate::output::{Output, ProgressLine};
use slideway::modes::{Progress, SearchOptions};
use slideway::raw_problem::{RawFault, RawProblem, SIZE_LIMIT, solve, to_json, to_npz, to_text};
use slideway::report::Status;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Searches that take less time show no progress.
const QUIET: Duration = Duration::from_secs(1);
/// Time between two lines of progress.
const BETWEEN: Duration = Duration::from_millis(200);

/// Finds and writes all solutions of a problem given by its matrices.
pub(crate) fn modes(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination)?;
    let problem = read(arguments)?;
    let defaults = SearchOptions::default();
    let options = SearchOptions { nodes: arguments.max_nodes.unwrap_or(defaults.nodes), ..defaults };
    let mut watch = Watch::new(arguments.time_limit);
    let report = solve(&problem, &options, arguments.max_solutions, &mut |progress| watch.look(progress))
        .map_err(|_| Failure::Overflow { name: input::name(&arguments.file) })?;
    drop(watch);
    match arguments.format() {
        ModesFormat::Text => output.write(&to_text(&report, output.style()))?,
        ModesFormat::Json => output.write(&to_json(&report))?,
        ModesFormat::Npz => output.write_bytes(&to_npz(&report))?,
    }
    Ok(match report.status {
        Status::One | Status::Several | Status::Continuum | Status::PreloadGap => Outcome::Done,
        Status::None => Outcome::NoSolution,
        Status::Unknown => Outcome::Unknown,
    })
}

fn read(arguments: &ModesArguments) -> Result<RawProblem, Failure> {
    let path = arguments.file.as_path();
    let bytes = input::read_bytes(path, SIZE_LIMIT).map_err(|failure| match failure {
        Failure::NotFound { path, .. } => Failure::NoProblem { path },
        other => other,
    })?;
    let problem = match bytes {
        Some(bytes) => RawProblem::from_bytes(&bytes),
        None => Err(RawFault::TooLarge { limit: SIZE_LIMIT }.into()),
    };
    problem.map_err(|faults| Failure::Problem { name: input::name(path), faults })
}

/// Ends a search in time, and tells of its progress.
struct Watch {
    start: Instant,
    limit: Option<Duration>,
    shown: Duration,
    line: ProgressLine,
}

impl Watch {
    fn new(limit: Option<Duration>) -> Self {
        Self { start: Instant::now(), limit, shown: Duration::ZERO, line: ProgressLine::new() }
    }

    fn look(&mut self, progress: &Progress) -> ControlFlow<()> {
        let elapsed = self.start.elapsed();
        if self.limit.is_some_and(|limit| elapsed >= limit) {
            return ControlFlow::Break(());
        }
        if elapsed >= QUIET && elapsed >= self.shown + BETWEEN {
            self.shown = elapsed;
            self.line.show(&format!(
                "{:.1} % of the patterns, {} nodes, {} found, {} s",
                100.0 * progress.fraction,
                progress.nodes,
                progress.states_found,
                elapsed.as_secs()
            ));
        }
        ControlFlow::Continue(())
    }
}
