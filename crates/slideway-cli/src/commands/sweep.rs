//! `slideway sweep`

use crate::arguments::{SweepArguments, table_endings};
use crate::failure::Failure;
use crate::halt::Halt;
use crate::input::Input;
use crate::metadata::metadata;
use crate::outcome::Outcome;
use crate::output::{Output, complain};
use crate::picture::{self, Picture};
use crate::watch::{Alarm, Watch};
use slideway::model::Settings;
use slideway::progress::Progress;
use slideway::sweep::{Rows, Sweep, SweepState};
use slideway_pictures::plot::{Extract, Extractor, SamplesPart, SamplesPlot, SweepPlot, to_svg};
use slideway_pictures::theme::Theme;
use slideway_tables::{Continued, Encoder, Layout, PartialFile, TableFormat};
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Computes all solutions at every point of a grid or sample, and writes them to a table.
pub(crate) fn sweep(arguments: &SweepArguments, output: &Output) -> Result<Outcome, Failure> {
    let format = format(arguments)?;
    let picture = picture::beside(&arguments.plot, &arguments.destination, &arguments.model, output)?;
    let destination = output.to(&arguments.destination, Some(&arguments.model.file))?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let options = arguments.options().map_err(|faults| input.refused(faults))?;
    input.warn(options.points.warnings(&model))?;
    let path = destination.path().filter(|path| !is_special(path));
    let limit = arguments.time.time_limit;
    let mut watch = if path.is_some() { Watch::new(limit) } else { Watch::beside_rows(limit) };
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
    let work = Work { sweep: &sweep, encoder, plot };
    match path {
        Some(path) => to_file(arguments, work, (&path, &destination), watch),
        None if format == TableFormat::Csv => stream(work, &destination, watch),
        None => Err(Failure::NoStream),
    }
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

/// Whether a path exists and is no regular file: a device or a pipe, which cannot be renamed to.
fn is_special(path: &Path) -> bool {
    path.exists() && !path.is_file()
}

/// What is computed, and what becomes of it.
struct Work<'w> {
    sweep: &'w Sweep,
    encoder: Encoder,
    plot: Option<Plotting>,
}

/// A plot beside the table.
struct Plotting {
    plot: Plotted,
    taker: Taker,
    title: Option<String>,
    settings: Settings,
    theme: &'static Theme,
    picture: Picture,
    file: Output,
}

/// What is plotted.
enum Plotted {
    /// Curves over one quantity.
    Line(SweepPlot),
    /// Histograms of samples.
    Samples(SamplesPlot),
}

/// Takes of rows what is plotted; to be used in parallel.
#[derive(Clone)]
enum Taker {
    Line(Extractor),
    Samples(SamplesPlot),
}

/// What was taken of some rows.
enum Taken {
    Line(Extract),
    Samples(SamplesPart),
}

impl Taker {
    fn rows(&self, rows: &Rows) -> Taken {
        match self {
            Self::Line(extractor) => Taken::Line(extractor.rows(rows)),
            Self::Samples(plot) => Taken::Samples(plot.rows(rows)),
        }
    }
}

impl Plotted {
    fn add(&mut self, taken: Taken) {
        match (self, taken) {
            (Self::Line(plot), Taken::Line(extract)) => plot.add(extract),
            (Self::Samples(plot), Taken::Samples(part)) => plot.add(&part),
            _ => unreachable!("what is taken is of the kind of the plot"),
        }
    }
}

impl Plotting {
    fn new(
        sweep: &Sweep,
        arguments: &SweepArguments,
        (picture, file): (Picture, Output),
        (title, settings): (Option<&str>, &Settings),
    ) -> Result<Self, Failure> {
        if sweep.line().is_none() && sweep.has_branches() {
            return Err(Failure::NoLine);
        }
        let quantity = arguments.quantity.into();
        let (plot, taker) = if sweep.has_branches() {
            let plot = SweepPlot::new(sweep, quantity).ok_or(Failure::NothingToPlot)?;
            let taker = Taker::Line(plot.extractor());
            (Plotted::Line(plot), taker)
        } else {
            let plot = SamplesPlot::new(sweep, quantity).ok_or(Failure::NothingToPlot)?;
            (Plotted::Samples(plot.clone()), Taker::Samples(plot))
        };
        let theme = arguments.plot.theme.colours();
        let (title, settings) = (title.map(str::to_owned), settings.clone());
        Ok(Self { plot, taker, title, settings, theme, picture, file })
    }

    /// Computes again what an interrupted run has done: the table does not hold all that a plot needs. Where
    /// the time is up before, it is up for the table, too.
    fn repeat(&mut self, sweep: &Sweep, done: u64, watch: &mut Watch) {
        if done == 0 {
            return;
        }
        let Self { plot, taker, .. } = self;
        let mut state = sweep.start();
        let alarm = watch.alarm();
        sweep.run_while(
            &|| !alarm.rings(),
            &mut state,
            &|rows| (rows.heads.first().map(|head| head.point), taker.rows(rows)),
            &mut |parts, state| {
                let wanted = parts.into_iter().filter(|(first, _)| first.is_some_and(|first| first < done));
                wanted.for_each(|(_, part)| plot.add(part));
                let flow = watch.look(&Progress::of("points", state.done, sweep.points()));
                if state.done < done { flow } else { ControlFlow::Break(()) }
            },
        );
    }

    fn write(mut self, state: &SweepState) -> Result<(), Failure> {
        let title = self.title.as_deref();
        let figure = match &mut self.plot {
            Plotted::Line(plot) => {
                plot.set_branches(state.branches());
                plot.figure(title)
            }
            Plotted::Samples(plot) => plot.figure(title, state),
        };
        let figure = figure.changed_by(&self.settings);
        self.picture.write(to_svg(&figure, self.theme), &self.file)
    }
}

/// Takes rows as bytes, with the state behind them, and says whether to go on.
type Take<'t> = dyn FnMut(Vec<Vec<u8>>, &SweepState) -> ControlFlow<()> + Send + 't;

impl Work<'_> {
    /// Computes what is not done yet; `take` gets the rows as bytes and says whether to go on.
    fn run(&mut self, alarm: Alarm, state: &mut SweepState, take: &mut Take<'_>) {
        let Self { sweep, encoder, plot } = self;
        let (taker, mut plot) = match plot {
            Some(Plotting { taker, plot, .. }) => (Some(taker.clone()), Some(plot)),
            None => (None, None),
        };
        let encode = |rows: &Rows| {
            let part = taker.as_ref().map(|taker| taker.rows(rows));
            (encoder.rows(rows), part)
        };
        sweep.run_while(&|| !alarm.rings(), state, &encode, &mut |parts, state| {
            let (rows, parts): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
            if let Some(plot) = &mut plot {
                parts.into_iter().flatten().for_each(|part| plot.add(part));
            }
            take(rows, state)
        });
    }
}

fn to_file(
    arguments: &SweepArguments,
    mut work: Work<'_>,
    (path, output): (&Path, &Output),
    mut watch: Watch,
) -> Result<Outcome, Failure> {
    let sweep = work.sweep;
    let how = (arguments.resume, arguments.destination.force);
    let Continued { mut file, mut state } =
        PartialFile::open(path, work.encoder.clone(), how, sweep.start())?;
    let mut failure = None;
    if let Some(plot) = &mut work.plot {
        plot.repeat(sweep, state.done, &mut watch);
    }
    work.run(watch.alarm(), &mut state, &mut |rows, state| {
        if let Err(error) = file.add(&rows, state) {
            failure = Some(error);
            return ControlFlow::Break(());
        }
        watch.look(&Progress::of("points", state.done, sweep.points()))
    });
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    let is_computed = state.done == sweep.points();
    let mut follow = |part: f64| {
        let done = Progress::of("points", sweep.points(), sweep.points());
        watch.look(&Progress { fraction: Some(part), ..done })
    };
    if !is_computed || file.complete(&mut follow)?.is_break() {
        file.keep(&state)?;
        return Err(unswept(watch, &state, sweep, Some(file.path())));
    }
    watch.finish();
    if let Some(plot) = work.plot {
        plot.write(&state)?;
    }
    Output::standard(output.color()).write(&sweep.text(&state, output.style_of_text()))?;
    Ok(Outcome::Done)
}

/// That the sweep was ended before it was done.
fn unswept(mut watch: Watch, state: &SweepState, sweep: &Sweep, path: Option<PathBuf>) -> Failure {
    // The alarm may have ended it.
    let _ = watch.look(&Progress::of("points", state.done, sweep.points()));
    let halt = watch.finish().unwrap_or(Halt::Interrupted);
    Failure::Unswept { halt, done: state.done, points: sweep.points(), path }
}

/// Writes the table to standard output, or to a device or a pipe; what it comes to goes to standard error.
fn stream(mut work: Work<'_>, output: &Output, mut watch: Watch) -> Result<Outcome, Failure> {
    let mut target = output.stream()?;
    let mut result = target.write_all(&work.encoder.head());
    let mut state = work.sweep.start();
    let points = work.sweep.points();
    if result.is_ok() {
        work.run(watch.alarm(), &mut state, &mut |rows, state| {
            result = rows.iter().try_for_each(|rows| target.write_all(rows));
            if result.is_err() {
                return ControlFlow::Break(());
            }
            watch.look(&Progress::of("points", state.done, points))
        });
    }
    match result.and_then(|()| target.flush()) {
        // A reader that goes away early has seen all it wanted.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => return Ok(Outcome::Done),
        Err(error) => return Err(output.failure(error)),
        Ok(()) if state.done < points => return Err(unswept(watch, &state, work.sweep, None)),
        Ok(()) => {
            watch.finish();
        }
    }
    if !io::stdout().is_terminal() || output.path().is_some() {
        complain(work.sweep.text(&state, output.style_of_text()).trim_end(), output.color());
    }
    if let Some(plot) = work.plot {
        plot.write(&state)?;
    }
    Ok(Outcome::Done)
}
