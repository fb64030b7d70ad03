//! `slideway simulate`

use crate::arguments::{CheckFormat, Preference, SimulateArguments};
use crate::failure::Failure;
use crate::files::Files;
use crate::halt::Halt;
use crate::input::Input;
use crate::metadata::metadata;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture::{Picture, beside};
use crate::pixels;
#[cfg(feature = "parquet")]
use crate::time_series::to_parquet;
use crate::time_series::{SeriesFormat, to_npz};
use crate::watch::{self, Watch};
use slideway::Report;
use slideway::configuration::Configuration;
use slideway::fault::{Fault, FaultKind, Faults};
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Setting, SettingKind};
use slideway::motion::{self, End, History, SimulateOptions, Thorough};
use slideway::printable;
use slideway::progress::{Callback, Progress};
use slideway::report::finite;
use slideway_pictures::motion::{AnimationOptions, animation_with, motion_figure, portrait_figure};
use slideway_pictures::plot::to_svg;
use slideway_pictures::theme::Theme;
use slideway_tables::{TableError, unfinished};
use std::path::{Path, PathBuf};

/// Rows of a table that are too many to be meant.
const MOST_ROWS: f64 = 1e7;

/// Follows a mechanism in time.
pub(crate) fn simulate(arguments: &SimulateArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Written::new(arguments, output)?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let mechanism = Mechanism::new(&model).map_err(|faults| input.refused(faults))?;
    let question = Question { arguments, input: &input, model: &model, mechanism: &mechanism };
    let options = question.options()?;
    let step = question.step(&options)?;
    let configuration = Configuration::new(&mechanism).map_err(|faults| input.refused(faults))?;

    let mut watch = Watch::new(arguments.time.time_limit);
    let mut progress = |progress: &Progress| watch.look(progress);
    let told = if arguments.all_branches {
        let most = (&mut Thorough as &mut dyn motion::Decisions, arguments.max_motions);
        let tree = motion::simulate_all(&mechanism, &configuration, &options, most, &mut progress);
        let tree = tree.map_err(|faults| input.refused(faults))?;
        Told::all(arguments, &tree, &options, output)
    } else {
        let history =
            motion::simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut progress);
        let history = history.map_err(|faults| input.refused(faults))?;
        if history.end == End::Interrupted && watch.halt() == Some(Halt::Interrupted) {
            files.interrupt();
        }
        files.write(&history, &options, (step, &input), &mut watch)?;
        Told::one(arguments, &history, &options, output)
    };
    let told = told.map_err(|faults| input.refused(faults))?;
    let halt = watch.finish();
    output.write(&told.text)?;
    match files.interrupted {
        Some(path) => Err(Failure::MotionInterrupted { path }),
        None => Ok(watch::outcome(halt, told.outcome)),
    }
}

/// The answer on standard output.
struct Told {
    text: String,
    outcome: Outcome,
}

impl Told {
    fn one(
        arguments: &SimulateArguments,
        history: &History,
        options: &SimulateOptions,
        output: &Output,
    ) -> Result<Self, Faults> {
        let report = finite(motion::report(history, options))?;
        let text = match arguments.format {
            CheckFormat::Text if arguments.all_events => report.text_with_all_events(output.style()),
            CheckFormat::Text => report.text(output.style()),
            CheckFormat::Json => report.json(),
        };
        Ok(Self { text, outcome: outcome(&history.end) })
    }

    fn all(
        arguments: &SimulateArguments,
        tree: &motion::Tree,
        options: &SimulateOptions,
        output: &Output,
    ) -> Result<Self, Faults> {
        let report = finite(motion::tree_report(tree, options))?;
        let text = match arguments.format {
            CheckFormat::Text if arguments.all_events => report.text_with_all_events(output.style()),
            CheckFormat::Text => report.text(output.style()),
            CheckFormat::Json => report.json(),
        };
        // The best that any motion comes to.
        let outcomes = tree.histories.iter().map(|branching| outcome(&branching.history.end));
        let outcome = outcomes.min_by_key(|outcome| *outcome as u8).unwrap_or(Outcome::Unknown);
        Ok(Self { text, outcome })
    }
}

fn outcome(end: &End) -> Outcome {
    match end {
        End::NoContinuation | End::Jammed | End::Tips(_) | End::ReactionLimit(_) => Outcome::NoSolution,
        End::NoValue(_) | End::NoSuchBranch { .. } => Outcome::Refused,
        End::Accumulation | End::StepLimit | End::EventLimit | End::Undecided(_) | End::Interrupted => {
            Outcome::Unknown
        }
        _ => Outcome::Done,
    }
}

/// A simulation that is asked for, with the model that it is asked of.
struct Question<'q> {
    arguments: &'q SimulateArguments,
    input: &'q Input,
    model: &'q Model,
    mechanism: &'q Mechanism,
}

impl Question<'_> {
    fn options(&self) -> Result<SimulateOptions, Failure> {
        let arguments = self.arguments;
        let (start, end) = (self.mechanism.time, self.time("until", &arguments.until)?);
        if end <= start {
            return Err(self.refused(FaultKind::NothingToSimulate { start, end }));
        }
        let longest_step = self.positive_time("longest-step", arguments.longest_step.as_deref())?;
        let options = SimulateOptions::new(end - start)
            .tolerance(arguments.tolerance)
            .longest_step(longest_step)
            .most_steps(arguments.max_steps)
            .most_events(arguments.max_events)
            .reaction_limit(arguments.max_reaction)
            .branches(arguments.branch.iter().copied())
            .prefers_sliding(arguments.prefer == Preference::Sliding)
            .impacts(arguments.impacts)
            .with_events_of(self.mechanism);
        match &arguments.mode {
            Some(mode) => {
                options.initial_of(mode, self.mechanism).map_err(|faults| self.input.refused(faults))
            }
            None => Ok(options),
        }
    }

    /// The step of the table.
    fn step(&self, options: &SimulateOptions) -> Result<Option<f64>, Failure> {
        let step = self.positive_time("step", self.arguments.step.as_deref())?;
        match step.map(|step| options.duration / step) {
            Some(rows) if rows > MOST_ROWS => Err(Failure::TooManyRows { rows, most: MOST_ROWS }),
            _ => Ok(step),
        }
    }

    fn positive_time(&self, name: &str, text: Option<&str>) -> Result<Option<f64>, Failure> {
        let Some(text) = text else { return Ok(None) };
        let time = self.time(name, text)?;
        if time > 0.0 {
            return Ok(Some(time));
        }
        let (wanted, value) = ("greater than zero", printable::line(text).into_owned());
        Err(self.refused(FaultKind::OutOfRange { what: format!("--{name}"), wanted, value }))
    }

    /// A time of the command line (s).
    fn time(&self, name: &str, text: &str) -> Result<f64, Failure> {
        let setting = Setting::new(SettingKind::Time, name, text.trim());
        let value = self.model.setting_value(&setting);
        value.map_err(|faults| self.input.refused_option(setting, faults))
    }

    fn refused(&self, kind: FaultKind) -> Failure {
        self.input.refused(Fault::general(kind).into())
    }
}

/// The files that are written beside the answer.
struct Written<'a> {
    arguments: &'a SimulateArguments,
    table: Option<(SeriesFormat, Output)>,
    plot: Option<(Picture, Output)>,
    animation: Option<(AnimationFormat, Output)>,
    /// Where the table of an interrupted motion is.
    interrupted: Option<PathBuf>,
}

impl<'a> Written<'a> {
    /// Before the work it is seen whether they can be written.
    fn new(arguments: &'a SimulateArguments, output: &Output) -> Result<Self, Failure> {
        let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
        let table = match arguments.destination.output.as_deref() {
            Some(path) => Some((SeriesFormat::of(path)?, files.beside(path)?)),
            None => None,
        };
        let file = table.as_ref().and_then(|(_, output)| output.path());
        if let Some(path) = file.and_then(|file| unfinished(&file)).filter(|_| !arguments.destination.force) {
            return Err(TableError::Unfinished { path }.into());
        }
        let animation = match arguments.animate.as_deref() {
            Some(path) => Some((AnimationFormat::of(path)?, files.beside(path)?)),
            None => None,
        };
        let plot = beside(&arguments.plot, &mut files)?;
        files.standard()?;
        if arguments.all_branches && (table.is_some() || plot.is_some() || animation.is_some()) {
            return Err(Failure::SeveralMotions);
        }
        Ok(Self { arguments, table, plot, animation, interrupted: None })
    }

    /// Nothing unfinished gets a final name: the table goes beside it, and there are no pictures.
    fn interrupt(&mut self) {
        (self.plot, self.animation) = (None, None);
        if let Some((_, output)) = &mut self.table {
            self.interrupted = output.be_partial();
        }
    }

    fn write(
        &self,
        history: &History,
        options: &SimulateOptions,
        (step, input): (Option<f64>, &Input),
        watch: &mut Watch,
    ) -> Result<(), Failure> {
        if let Some((format, output)) = &self.table {
            let times = match step {
                Some(step) => history.times_in_steps(step),
                None => history.times().collect(),
            };
            let series = finite(history.series(&times)).map_err(|faults| input.refused(faults))?;
            let metadata = &metadata(input);
            match format {
                SeriesFormat::Csv => output.write(&series.csv())?,
                SeriesFormat::Npz => output.write_bytes(&to_npz(&series, metadata))?,
                #[cfg(feature = "parquet")]
                SeriesFormat::Parquet => {
                    let table = to_parquet(&series, metadata).map_err(|error| output.failure(error))?;
                    output.write_bytes(&table)?;
                }
                SeriesFormat::Json => {
                    let mut report = motion::report(history, options);
                    report.samples = Some(series);
                    let report = finite(report).map_err(|faults| input.refused(faults))?;
                    output.write(&report.json())?;
                }
            }
        }
        let theme = self.arguments.plot.theme.colours();
        if let Some((picture, output)) = &self.plot {
            let portrait = self.arguments.phase_portrait;
            let figure = if portrait { portrait_figure(history) } else { motion_figure(history) };
            picture.write(to_svg(&figure.changed_by(&input.settings), theme), output)?;
        }
        if let Some((format, output)) = &self.animation {
            let options = AnimationOptions { slow_motion: self.arguments.slow_motion };
            let Some(bytes) = format.bytes(history, (&options, theme), &mut watch.drawing())? else {
                let halt = watch.halt().unwrap_or(Halt::Interrupted);
                return Err(Failure::Halted { halt, path: output.path() });
            };
            output.write_bytes(&bytes)?;
            output.announce()?;
        }
        Ok(())
    }
}

/// The form of a moving picture, by the ending of its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AnimationFormat {
    Html,
    Svg,
    Gif,
}

impl AnimationFormat {
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase).as_deref() {
            Some("html" | "htm") => Ok(Self::Html),
            Some("svg") => Ok(Self::Svg),
            Some("gif") => pixels::are_there().map(|()| Self::Gif),
            _ => Err(Failure::FileFormat { path: path.to_owned(), known: &[".html", ".svg", ".gif"] }),
        }
    }

    /// The file; nothing if the work was ended.
    fn bytes(
        self,
        history: &History,
        (options, theme): (&AnimationOptions, &Theme),
        callback: &mut Callback<'_>,
    ) -> Result<Option<Vec<u8>>, Failure> {
        let Some(animation) = animation_with(history, options, theme, callback) else { return Ok(None) };
        match self {
            Self::Html => Ok(Some(animation.to_html()?.into_bytes())),
            Self::Svg => Ok(Some(animation.to_svg()?.into_bytes())),
            Self::Gif => pixels::gif(&animation, callback),
        }
    }
}
