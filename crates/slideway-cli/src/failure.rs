//! Why a command could not do what it was asked to do.

use crate::diagnostics::{self, Note, listing};
use crate::faulty_input::FaultyInput;
use crate::halt::Halt;
use crate::outcome::Outcome;
use slideway::fault::CommandLine;
use slideway::import::ImportFault;
use slideway::limits::{FRICTION, Variable};
use slideway::printable;
use slideway::raw_problem::RawFaults;
use slideway::template::TEMPLATES;
use slideway_pictures::NotFinite;
use slideway_tables::{Reason, TableError};
use std::fmt;
use std::io;
use std::path::PathBuf;

/// Hint for a file that is in the way.
const OVERWRITE: &str = "choose another name, or overwrite it with --force";

/// Why a command could not do what it was asked to do.
#[derive(Debug)]
pub(crate) enum Failure {
    /// There is no such model file.
    NotFound { path: PathBuf, nearest: Option<String>, gallery_name: Option<&'static str> },
    /// The path is a directory.
    IsDirectory { path: PathBuf },
    /// The model file cannot be read.
    CannotRead { path: PathBuf, error: io::Error },
    /// The model or the settings make no sense.
    Input(Box<FaultyInput>),
    /// There is no such file with a problem.
    NoProblem { path: PathBuf },
    /// The problem makes no sense.
    Problem { name: String, faults: RawFaults },
    /// The drawing makes no sense.
    Drawing { name: String, fault: ImportFault },
    /// No template is named, and nobody can be asked.
    NoTemplate,
    /// There is no such template.
    UnknownTemplate { name: String, nearest: Option<String>, model: Option<&'static str> },
    /// No quantity is named that is to be varied, by this option.
    NothingVaried { option: &'static str, variables: Vec<Variable> },
    /// Standard output cannot be opened.
    NothingToOpen,
    /// No program opens a file.
    CannotOpen { path: PathBuf, program: String },
    /// There is no such model in the gallery.
    UnknownModel { name: String, nearest: Option<String> },
    /// Only the telescopic boom has stages.
    NoStages { name: String },
    /// A number of stages that makes no sense.
    StageCount { stages: usize, most: usize },
    /// The output file exists.
    OutputExists { path: PathBuf },
    /// The folder for several files exists.
    FolderExists { path: PathBuf },
    /// There is an answer, but no proof file.
    NoProof { reason: String },
    /// A picture or page could not be made.
    Picture { reason: String },
    /// Two outputs would go to the same file.
    SameOutput { path: PathBuf },
    /// The ending of a picture's file says nothing of its format.
    FileFormat { path: PathBuf, known: &'static [&'static str] },
    /// A table cannot be written or continued.
    Table(TableError),
    /// The ending of a table says nothing.
    UnknownEnding { path: PathBuf, known: Vec<String> },
    /// A table that is not written from beginning to end.
    NoStream,
    /// Shards go into a folder.
    #[cfg(feature = "parquet")]
    NoFolder,
    /// Shards without what the strokes of a plot tell of.
    #[cfg(feature = "parquet")]
    WithoutAttainability,
    /// Shards need a feature that the program was built without.
    #[cfg(not(feature = "parquet"))]
    WithoutShards,
    /// A plot of what does not go along a line.
    NoLine,
    /// A plot of a quantity that the model has none of.
    NothingToPlot,
    /// The work was ended before there was an answer, or this file.
    Halted { halt: Halt, path: Option<PathBuf> },
    /// A sweep was ended before it was done; what is done is kept if it goes to a file.
    Unswept { halt: Halt, done: u64, points: u64, path: Option<PathBuf>, of_shard: bool },
    /// A motion was interrupted, and its table so far is kept.
    MotionInterrupted { path: PathBuf },
    /// An output, or what is kept beside it while it is unfinished, would take the place of the input.
    OverwritesInput { name: String },
    /// The output file cannot be written.
    CannotWrite { path: PathBuf, error: io::Error },
    /// Parquet files need a feature that the program was built without.
    #[cfg(not(feature = "parquet"))]
    WithoutParquet,
    /// Pictures of pixels need a feature that the program was built without.
    WithoutPixels,
    /// There is no solution of the wanted number.
    NoSuchSolution { count: usize },
    /// An answer that is no text would go to a terminal.
    BinaryOnTerminal,
    /// The ending of a file names no form of a time series.
    SeriesFormat { path: PathBuf, known: &'static [&'static str] },
    /// A table with absurdly many rows.
    TooManyRows { rows: f64, most: f64 },
    /// Files hold one motion.
    SeveralMotions,
    /// Standard output cannot be written.
    StandardOutput { error: io::Error },
}

impl From<NotFinite> for Failure {
    fn from(fault: NotFinite) -> Self {
        Self::Picture { reason: fault.to_string() }
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        Self::Table(error)
    }
}

impl Failure {
    /// The exit code.
    pub(crate) fn outcome(&self) -> Outcome {
        match self {
            Self::Halted { halt, .. } | Self::Unswept { halt, .. } => halt.outcome(),
            Self::MotionInterrupted { .. } => Outcome::Interrupted,
            Self::NoProof { .. } => Outcome::Unknown,
            _ => Outcome::Refused,
        }
    }

    /// Returns in words what is wrong; empty if it is the model or the problem itself.
    fn message(&self) -> String {
        match self {
            Self::NotFound { path, .. } | Self::NoProblem { path } => {
                format!("there is no file `{}`", path.display())
            }
            Self::IsDirectory { path } => format!("`{}` is a directory, not a file", path.display()),
            Self::CannotRead { path, error } => {
                format!("`{}` cannot be read: {}", path.display(), Reason(error))
            }
            Self::Input(_) | Self::Problem { .. } => String::new(),
            Self::Drawing { name, fault } => format!("`{name}` cannot be imported: {fault}"),
            Self::NoTemplate => "which template? None is named".to_owned(),
            Self::UnknownTemplate { name, .. } => format!("there is no template `{name}`"),
            Self::NothingVaried { .. } => "what is to be varied?".to_owned(),
            Self::NothingToOpen => "only a file can be opened".to_owned(),
            Self::CannotOpen { path, .. } => {
                format!("`{}` is written, but cannot be opened from here", path.display())
            }
            Self::UnknownModel { name, .. } => format!("the gallery has no model `{name}`"),
            Self::NoStages { name } => format!("`{name}` has no stages"),
            Self::StageCount { stages, most } => {
                format!("a telescopic boom can have 1 to {most} stages, not {stages}")
            }
            Self::OutputExists { path } => format!("`{}` already exists", path.display()),
            Self::FolderExists { path } => format!("`{}` already exists", path.display()),
            Self::NoProof { reason } => format!("the proof file could not be written: {reason}"),
            Self::Picture { reason } => format!("the picture could not be made: {reason}"),
            Self::SameOutput { path } => format!("two outputs would go to `{}`", path.display()),
            Self::FileFormat { path, .. } => {
                format!("the extension of `{}` is not a known format", path.display())
            }
            Self::Table(error) => error.to_string(),
            Self::UnknownEnding { path, .. } => {
                format!("the extension of `{}` does not determine the form of the table", path.display())
            }
            Self::NoStream => "this form of table can only be written to a file".to_owned(),
            #[cfg(feature = "parquet")]
            Self::NoFolder => "a shard can only be written into a folder".to_owned(),
            #[cfg(feature = "parquet")]
            Self::WithoutAttainability => {
                "the shards lack the attainability of solutions, which a plot shows".to_owned()
            }
            #[cfg(not(feature = "parquet"))]
            Self::WithoutShards => {
                "this program was built without support for Parquet files, which shards are".to_owned()
            }
            Self::NoLine => {
                "a plot needs one varied quantity with ascending values, or random samples".to_owned()
            }
            Self::NothingToPlot => "the model has no such quantity to plot".to_owned(),
            Self::Halted { halt, path: None } => {
                format!("{} before there was an answer; nothing is written", halt.in_words())
            }
            Self::Halted { halt, path: Some(path) } => {
                format!("{} before `{}` was done; it is not written", halt.in_words(), path.display())
            }
            Self::Unswept { halt, done, points, path: Some(path), .. } => format!(
                "{} after {done} of {points} points; they are kept in `{}`",
                halt.in_words(),
                path.display()
            ),
            Self::Unswept { halt, done, points, path: None, .. } => {
                format!("{} after {done} of {points} points", halt.in_words())
            }
            Self::MotionInterrupted { path } => {
                format!("interrupted; the table of the motion so far is in `{}`", path.display())
            }
            Self::OverwritesInput { name } => format!("the output would overwrite its input `{name}`"),
            Self::CannotWrite { path, error } => {
                format!("`{}` cannot be written: {}", path.display(), Reason(error))
            }
            #[cfg(not(feature = "parquet"))]
            Self::WithoutParquet => "this program was built without support for Parquet files".to_owned(),
            Self::WithoutPixels => "this program was built without support for PNG and GIF".to_owned(),
            Self::NoSuchSolution { count: 0 } => "there is no solution in this state".to_owned(),
            Self::NoSuchSolution { count: 1 } => "there is only one solution in this state".to_owned(),
            Self::NoSuchSolution { count } => format!("there are only {count} solutions in this state"),
            Self::BinaryOnTerminal => "an .npz archive cannot be written to a terminal".to_owned(),
            Self::SeriesFormat { path, .. } => {
                format!("`{}` is not the name of a time series", path.display())
            }
            Self::TooManyRows { rows, most } => {
                format!("the table would have {rows:.1e} rows; at most {most:.0e} are written")
            }
            Self::SeveralMotions => "files hold one motion, not all branches".to_owned(),
            Self::StandardOutput { error } => format!("the answer cannot be written: {}", Reason(error)),
        }
    }

    /// Returns what to do about it, if there is anything to say.
    fn hint(&self) -> Option<String> {
        match self {
            Self::NotFound { gallery_name: Some(name), .. }
            | Self::UnknownTemplate { model: Some(name), .. } => Some(format!(
                "`{name}` is a model of the gallery: `slideway models {name} > {name}.toml` writes it to a file"
            )),
            Self::NoProblem { .. } => {
                Some("`slideway modes --help` shows what a problem looks like".to_owned())
            }
            Self::NoSuchSolution { .. } => {
                Some("`slideway solve` lists them; `--solution none` draws the mechanism alone".to_owned())
            }
            Self::BinaryOnTerminal => Some("write it to a file with --output".to_owned()),
            #[cfg(not(feature = "parquet"))]
            Self::WithoutParquet => Some(
                "build it with `cargo build --release --features parquet`, or use .csv or .npz".to_owned(),
            ),
            #[cfg(not(feature = "parquet"))]
            Self::WithoutShards => {
                Some("build it with `cargo build --release --features parquet`".to_owned())
            }
            #[cfg(feature = "parquet")]
            Self::WithoutAttainability => {
                Some("omit --plot, or compute the shards with --attainability".to_owned())
            }
            #[cfg(feature = "parquet")]
            Self::NoFolder => Some("name a folder with --output".to_owned()),
            Self::WithoutPixels => {
                Some("build it with its default features, or use .svg or .html".to_owned())
            }
            Self::TooManyRows { .. } => Some("choose a longer --step".to_owned()),
            Self::SeveralMotions => Some("choose one of them with --branch".to_owned()),
            Self::NotFound { nearest: Some(nearest), .. }
            | Self::UnknownModel { nearest: Some(nearest), .. }
            | Self::UnknownTemplate { nearest: Some(nearest), .. } => {
                Some(format!("did you mean `{nearest}`?"))
            }
            Self::NoTemplate | Self::UnknownTemplate { .. } => {
                Some("`slideway new NAME` writes one of these".to_owned())
            }
            Self::NothingVaried { option, .. } => {
                Some(format!("name one of these with `{option}`; they have these values now"))
            }
            Self::NotFound { .. } => Some("`slideway models` lists models to start from".to_owned()),
            Self::NothingToOpen => Some("name it with --output, or omit --output".to_owned()),
            Self::CannotOpen { program, .. } => Some(format!("the program `{program}` would do it")),
            Self::UnknownModel { nearest: None, .. } => Some("`slideway models` lists them".to_owned()),
            Self::NoStages { .. } => Some("--stages is for `slideway models telescopic-boom`".to_owned()),
            Self::FileFormat { known, .. } | Self::SeriesFormat { known, .. } => {
                Some(format!("possible extensions: {}", known.join(", ")))
            }
            Self::Drawing { fault, .. } => fault.hint_for(&CommandLine),
            Self::OutputExists { .. } => Some(OVERWRITE.to_owned()),
            Self::FolderExists { .. } => Some("name a folder that does not exist yet".to_owned()),
            Self::Table(error) => hint_on(error).map(str::to_owned),
            Self::UnknownEnding { known, .. } => {
                Some(format!("possible extensions: {}; or use --format", known.join(", ")))
            }
            Self::NoLine => {
                Some("vary one quantity, or omit --plot; `slideway map` shows two quantities".to_owned())
            }
            Self::NoStream => Some("name a file with --output, or use --format csv".to_owned()),
            Self::MotionInterrupted { .. } => Some(
                "--time-limit also ends a motion early, but writes its files under their own names"
                    .to_owned(),
            ),
            Self::Halted { halt: Halt::TimeLimit(_), .. } => {
                Some("allow more time with --time-limit, or ask for less, such as a smaller range".to_owned())
            }
            Self::Unswept { path: Some(_), of_shard: true, .. } => {
                Some("the same command continues from there".to_owned())
            }
            Self::Unswept { path: Some(_), .. } => {
                Some("the same command with --resume continues from there".to_owned())
            }
            _ => None,
        }
    }
}

impl Failure {
    /// All that there is, where none of it is named.
    fn all(&self) -> Vec<(String, String)> {
        match self {
            Self::NoTemplate | Self::UnknownTemplate { .. } => {
                TEMPLATES.iter().map(|one| (one.name.to_owned(), one.summary().to_owned())).collect()
            }
            Self::NothingVaried { variables, .. } => {
                let meaning = |name: &str| {
                    if name == FRICTION { ", the factor on all coefficients of friction" } else { "" }
                };
                let one = |one: &Variable| (one.name.clone(), format!("{}{}", one.value, meaning(&one.name)));
                variables.iter().map(one).collect()
            }
            _ => Vec::new(),
        }
    }

    /// It and what to do about it, as a sentence.
    pub(crate) fn in_one_line(&self) -> String {
        let hint = self.hint().map_or_else(String::new, |hint| format!("; {hint}"));
        printable::line(&format!("{}{hint}", self.message())).into_owned()
    }
}

/// Returns what to do about a table that cannot be written, if there is anything to say.
fn hint_on(error: &TableError) -> Option<&'static str> {
    match error {
        TableError::Exists { .. } => Some(OVERWRITE),
        TableError::Unfinished { .. } => Some("continue it with --resume, or start over with --force"),
        TableError::NoFile { .. } => Some("remove it, or choose another name for the table"),
        TableError::InUse { .. } => Some("wait until it ends, or choose another name"),
        TableError::Damaged { .. } => Some("start over with --force"),
        TableError::NothingToResume { .. } => Some("omit --resume"),
        TableError::AnotherSweep { .. } => {
            Some("repeat that command with --resume and the same model, or start over with --force")
        }
        TableError::CannotGoOn { .. } => {
            Some("the finished part is kept: make room, then repeat the command with --resume")
        }
        TableError::ShardDamaged { .. } => Some("compute this shard again, with --shard K/N --force"),
        TableError::ShardOfVersion { .. } => {
            Some("compute this shard again, with --shard K/N --force, or use the version that wrote it")
        }
        TableError::ShardOfAnotherSweep { .. } => {
            Some("name another folder with --output, or overwrite the shard with --force")
        }
        TableError::ShardsDiffer { .. } => {
            Some("remove the shards that do not belong there, and compute theirs again with --shard K/N")
        }
        TableError::NoShards { .. } => {
            Some("`slideway sweep MODEL --vary NAME=VALUES --shard K/N --output FOLDER` writes one")
        }
        TableError::ShardsMissing { .. } => Some("compute them with --shard K/N, then merge again"),
        _ => None,
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Input(input) => diagnostics::faults(input),
            Self::Problem { name, faults } => diagnostics::raw_faults(name, faults),
            other => {
                let note = Note { message: other.message(), hint: other.hint() };
                let all = other.all();
                if all.is_empty() { diagnostics::note(&note) } else { listing(&note, all) }
            }
        };
        formatter.write_str(&text)
    }
}

impl std::error::Error for Failure {}
