//! `slideway sweep`

mod plot;
#[cfg(feature = "parquet")]
mod shards;

use crate::arguments::{ModelArguments, SweepArguments, table_endings};
use crate::failure::Failure;
use crate::files::Files;
use crate::halt::Halt;
use crate::input::Input;
use crate::metadata::metadata;
use crate::outcome::Outcome;
use crate::output::{Output, complain};
use crate::picture;
use crate::watch::Watch;
use plot::Plotting;
use slideway::progress::Progress;
use slideway::solve::solve;
use slideway::sweep::{Rows, Sweep, SweepState};
use slideway_tables::{Control, Encoder, Layout, PartialFile, Resume, RowSource, TableFormat, Written};
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Computes all solutions at every point of a grid or sample, and writes them to a table; or a shard of it; or
/// merges shards.
pub(crate) fn sweep(arguments: &SweepArguments, output: &Output) -> Result<Outcome, Failure> {
    match (&arguments.merge, &arguments.model, arguments.shard) {
        #[cfg(feature = "parquet")]
        (Some(folder), ..) => shards::merge(folder, arguments, output),
        #[cfg(feature = "parquet")]
        (None, Some(model), Some(shard)) => shards::write(shard, (model, arguments), output),
        #[cfg(not(feature = "parquet"))]
        (Some(_), ..) | (None, Some(_), Some(_)) => Err(Failure::WithoutShards),
        (None, Some(model), None) => table(model, arguments, output),
        (None, None, _) => unreachable!("without --merge a model is required"),
    }
}

/// A sweep into a table.
fn table(model: &ModelArguments, arguments: &SweepArguments, output: &Output) -> Result<Outcome, Failure> {
    let format = format(arguments)?;
    let mut files = Files::new(output, &arguments.destination, Some(&model.file));
    let picture = picture::beside(&arguments.plot, &mut files)?;
    let destination = files.answer()?;
    let input = Input::read(model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    if arguments.vary.is_empty() {
        return Err(input.nothing_varied(&model, "--vary NAME=FROM..TO:COUNT"));
    }
    let options = arguments.options().map_err(|faults| input.refused(faults))?;
    input.warn(options.points.warnings(&model))?;
    let mut watch = watch(arguments, &destination);
    let sweep = Sweep::new_with(&model, &options, &mut |progress| watch.look(progress));
    let Some(sweep) = sweep.map_err(|faults| input.refused(faults))? else {
        return watch.whole(None);
    };
    let plot = match picture {
        Some(file) => {
            Some(Plotting::new(&sweep, arguments, file, (model.title.as_deref(), &input.settings))?)
        }
        None => None,
    };
    let layout = Layout::of(&sweep, options.points.dimensions(), options.attainability);
    let encoder = Encoder::new(format, layout, metadata(&input));
    let work = Work { source: RowSource::Sweep(&sweep), encoder, plot };
    let outcome = work.write(arguments, &destination, watch)?;
    match outcome {
        // What is refused everywhere is most often the model, and then there is advice.
        Outcome::Refused => solve(&model).map(|_| outcome).map_err(|faults| input.refused(faults)),
        outcome => Ok(outcome),
    }
}

/// Watches over the work of a sweep.
fn watch(arguments: &SweepArguments, destination: &Output) -> Watch {
    let limit = arguments.time.time_limit;
    if table_path(destination).is_some() { Watch::new(limit) } else { Watch::beside_rows(limit) }
}

/// The file of the table; none for standard output, a device or a pipe, which cannot be renamed to.
fn table_path(destination: &Output) -> Option<PathBuf> {
    destination.path().filter(|path| !path.exists() || path.is_file())
}

/// The form of the table: what is asked for, or what the ending of the output tells.
fn format(arguments: &SweepArguments) -> Result<TableFormat, Failure> {
    let path = arguments.destination.output.as_deref().filter(|path| *path != Path::new("-"));
    let Some(path) = path.filter(|path| path.extension().is_some()) else {
        return Ok(arguments.format.unwrap_or(TableFormat::Csv));
    };
    match arguments.format.or_else(|| TableFormat::of(path)) {
        Some(format) => Ok(format),
        #[cfg(not(feature = "parquet"))]
        None if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet")) => {
            Err(Failure::WithoutParquet)
        }
        None => Err(Failure::UnknownEnding { path: path.to_owned(), known: table_endings() }),
    }
}

/// Rows, and what becomes of them.
struct Work<'w> {
    source: RowSource<'w>,
    encoder: Encoder,
    plot: Option<Plotting>,
}

impl Work<'_> {
    fn write(self, arguments: &SweepArguments, output: &Output, watch: Watch) -> Result<Outcome, Failure> {
        match table_path(output) {
            Some(path) => self.into_file(arguments, (&path, output), watch),
            None if self.encoder.format() == TableFormat::Csv => self.stream(output, watch),
            None => Err(Failure::NoStream),
        }
    }

    fn into_file(
        mut self,
        arguments: &SweepArguments,
        (path, output): (&Path, &Output),
        mut watch: Watch,
    ) -> Result<Outcome, Failure> {
        let (source, sweep) = (self.source, self.source.sweep());
        let resume = if arguments.resume { Resume::Yes } else { Resume::No };
        let how = (resume, arguments.destination.force);
        let continued = PartialFile::open(path, self.encoder, how, sweep.start())?;
        if let Some(plot) = &mut self.plot {
            plot.repeat(source, continued.state.done, &mut watch)?;
        }
        let (taker, mut plot) = match &mut self.plot {
            Some(Plotting { taker, plot, .. }) => (Some(taker.clone()), Some(plot)),
            None => (None, None),
        };
        let alarm = watch.alarm();
        let mut look = |progress: &Progress| watch.look(progress);
        let mut control = Control { goes_on: &|| !alarm.rings(), callback: &mut look };
        let take_of = |rows: &Rows| taker.as_ref().map(|taker| taker.rows(rows));
        let written = continued.fill(source, &mut control, &take_of, &mut |taken| {
            if let (Some(plot), Some(taken)) = (&mut plot, taken) {
                plot.add(taken);
            }
        })?;
        match written {
            Written::Early { state, path } => Err(unswept(watch, &state, sweep, Some(path))),
            Written::Whole(state) => {
                watch.finish();
                if let Some(plot) = self.plot {
                    plot.write(&state)?;
                }
                tell(sweep, &state, output)
            }
        }
    }

    /// Writes the table to standard output, or to a device or a pipe; what it comes to goes to standard
    /// error.
    fn stream(mut self, output: &Output, mut watch: Watch) -> Result<Outcome, Failure> {
        let (encoder, sweep) = (&self.encoder, self.source.sweep());
        let is_read_here = io::stdout().is_terminal() && output.path().is_none();
        let mut target = Shown::new(output.stream()?, is_read_here);
        let mut result = target.write_all(&encoder.head());
        let mut state = sweep.start();
        let points = sweep.points();
        let (taker, mut plot) = match &mut self.plot {
            Some(Plotting { taker, plot, .. }) => (Some(taker.clone()), Some(plot)),
            None => (None, None),
        };
        if result.is_ok() {
            let alarm = watch.alarm();
            let encode = |rows: &Rows| (encoder.rows(rows), taker.as_ref().map(|taker| taker.rows(rows)));
            self.source.run_while(&|| !alarm.rings(), &mut state, &encode, &mut |parts, state| {
                for (rows, taken) in parts {
                    result = target.write_all(&rows);
                    if result.is_err() {
                        return ControlFlow::Break(());
                    }
                    if let (Some(plot), Some(taken)) = (&mut plot, taken) {
                        plot.add(taken);
                    }
                }
                watch.look(&Progress::of("points", state.done, points))
            })?;
        }
        match result.and_then(|()| target.flush()) {
            // A reader that goes away early has seen all it wanted.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => return Ok(Outcome::Done),
            Err(error) => return Err(output.failure(error)),
            Ok(()) if state.done < points => return Err(unswept(watch, &state, sweep, None)),
            Ok(()) => {
                watch.finish();
            }
        }
        let outcome = outcome(&state);
        if target.left_out > 0 {
            let more = format!("{} more rows: `--output FILE.csv` writes all of them", target.left_out);
            complain(&more, output.color());
        }
        if outcome == Outcome::Refused || !is_read_here || target.left_out > 0 {
            complain(sweep.text(&state, output.style_of_text()).trim_end(), output.color());
        }
        if let Some(plot) = self.plot {
            plot.write(&state)?;
        }
        Ok(outcome)
    }
}

/// Rows that a terminal shows.
const ROWS_SHOWN: usize = 40;

/// A table on its way to a terminal, which shows its first rows alone, or to whatever takes all of them.
struct Shown<W> {
    target: W,
    /// How many more rows are shown; none if all are.
    room: Option<usize>,
    left_out: usize,
}

impl<W: Write> Shown<W> {
    fn new(target: W, is_read_here: bool) -> Self {
        // The names of the columns are a row, too.
        Self { target, room: is_read_here.then_some(ROWS_SHOWN + 1), left_out: 0 }
    }
}

impl<W: Write> Write for Shown<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Some(room) = &mut self.room else { return self.target.write(bytes) };
        // What tells a file's reader where it comes from is known here.
        for line in bytes.split_inclusive(|byte| *byte == b'\n').filter(|line| !line.starts_with(b"#")) {
            if *room == 0 {
                self.left_out += 1;
                continue;
            }
            *room -= 1;
            self.target.write_all(line)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.target.flush()
    }
}

/// Refused if there were points, and none could be solved.
fn outcome(state: &SweepState) -> Outcome {
    if state.tally.points > 0 && state.tally.solved() == 0 { Outcome::Refused } else { Outcome::Done }
}

/// Tells what a sweep has come to.
fn tell(sweep: &Sweep, state: &SweepState, output: &Output) -> Result<Outcome, Failure> {
    Output::standard(output.look()).write(&sweep.text(state, output.style_of_text()))?;
    Ok(outcome(state))
}

/// Builds the failure of a sweep that was ended before it was done.
fn unswept(mut watch: Watch, state: &SweepState, sweep: &Sweep, path: Option<PathBuf>) -> Failure {
    // The alarm may have ended it.
    let _ = watch.look(&Progress::of("points", state.done, sweep.points()));
    let halt = watch.finish().unwrap_or(Halt::Interrupted);
    let of_shard = sweep.of_shard().is_some();
    Failure::Unswept { halt, done: state.done, points: sweep.points(), path, of_shard }
}
