//! A model file and the settings of the command line, as texts in which faults have their places.

use crate::arguments::ModelArguments;
use crate::diagnostics;
use crate::failure::Failure;
use crate::faulty_input::FaultyInput;
use crate::output::complain;
use anstream::ColorChoice;
use slideway::fault::{Doubt, Fault, FaultKind, Faults, nearest};
use slideway::gallery;
use slideway::limits::{Vary, variables};
use slideway::model::{Model, SIZE_LIMIT, Setting, Settings};
use slideway::units::UnitSystem;
use slideway::warning::{ranges_at_middle, warnings};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// The texts of a run.
#[derive(Debug, Clone)]
pub(crate) struct Input {
    /// Name of the model file, for messages.
    pub(crate) name: String,
    /// Its bytes.
    bytes: Vec<u8>,
    /// The changes of the model by the command line.
    pub(crate) settings: Settings,
    /// What is going to be varied, so that its own value does not matter.
    varied: Vec<String>,
    /// Settings that could not be read.
    malformed: Vec<Fault>,
    /// In which units numbers are to be shown, if not as the model says.
    units: Option<UnitSystem>,
    /// Whether warnings are errors.
    strict: bool,
    /// When warnings are coloured.
    color: ColorChoice,
}

impl Input {
    /// Reads the model file; no more of it than a model may have.
    ///
    /// # Errors
    /// If it cannot be read, or is too large.
    pub(crate) fn read(arguments: &ModelArguments, color: ColorChoice) -> Result<Self, Failure> {
        let path = arguments.file.as_path();
        let (settings, malformed) = arguments.settings();
        let (units, strict) = (arguments.units(), arguments.strict);
        let input = Self {
            name: name(path),
            bytes: Vec::new(),
            settings,
            varied: Vec::new(),
            malformed,
            units,
            strict,
            color,
        };
        match read_bytes(path, SIZE_LIMIT)? {
            Some(bytes) => Ok(Self { bytes, ..input }),
            None => Err(input.refused(Fault::general(FaultKind::TooLarge { limit: SIZE_LIMIT }).into())),
        }
    }

    /// It for a question that varies what these texts begin with, as in `mu=0..1`.
    pub(crate) fn varying<'a>(mut self, texts: impl IntoIterator<Item = &'a String>) -> Self {
        let names = texts.into_iter().map(|text| text.split('=').next().unwrap_or(text).trim());
        self.varied.extend(names.map(str::to_owned));
        self
    }

    /// Returns the model with its settings, and writes its warnings to standard error.
    ///
    /// # Errors
    /// All faults of both; the warnings if they are to be errors.
    pub(crate) fn model(&self) -> Result<Model, Failure> {
        let model = self.model_without_warnings()?;
        let mut all = self.doubts(&model);
        all.append(ranges_at_middle(&model));
        self.warn(all)?;
        Ok(model)
    }

    /// Returns the model with its settings for questions on rest: [`Input::model`] without the warning that nothing presses
    /// a guide in motion, where a jam is looked for.
    ///
    /// # Errors
    /// As [`Input::model`].
    pub(crate) fn model_at_rest(&self) -> Result<Model, Failure> {
        let model = self.model_without_warnings()?;
        let mut all = ranges_at_middle(&model);
        let concerns_rest = |fault: &&Fault| fault.kind != FaultKind::Doubt(Doubt::NothingPresses);
        all.extend(self.doubts(&model).sorted().into_iter().filter(concerns_rest).cloned());
        self.warn(all)?;
        Ok(model)
    }

    /// Returns the model with its settings for questions that cover whole ranges of parameters:
    /// [`Input::model`] without the warnings of ranges that are taken at their middle.
    ///
    /// # Errors
    /// As [`Input::model`].
    pub(crate) fn model_within_bounds(&self) -> Result<Model, Failure> {
        let model = self.model_without_warnings()?;
        self.warn(self.doubts(&model))?;
        Ok(model)
    }

    /// The warnings of a question; what the drawing alone leaves in doubt is for `check`, unless warnings are errors.
    fn doubts(&self, model: &Model) -> Faults {
        let concerns_drawing =
            |fault: &Fault| matches!(&fault.kind, FaultKind::Doubt(doubt) if doubt.concerns_drawing());
        let mut found = Faults::default();
        found.extend(
            warnings(model)
                .sorted()
                .into_iter()
                .filter(|&one| self.strict || !concerns_drawing(one))
                .cloned(),
        );
        found
    }

    /// A quantity that is to be varied in the model, with its warnings likewise.
    ///
    /// # Errors
    /// A text that is none; the warnings if they are to be errors.
    pub(crate) fn vary(&self, model: &Model, text: &str) -> Result<Vary, Failure> {
        let vary: Vary = text.parse().map_err(|faults| self.refused(faults))?;
        self.warn(vary.warnings(model))?;
        Ok(vary)
    }

    /// [`Input::vary`] of what a question needs.
    ///
    /// # Errors
    /// As there, and if nothing is named.
    pub(crate) fn wanted(&self, model: &Model, text: Option<&str>) -> Result<Vary, Failure> {
        match text {
            Some(text) => self.vary(model, text),
            None => Err(self.nothing_varied(model, "--vary NAME` or `--vary NAME=FROM..TO")),
        }
    }

    /// Builds the failure that this option names no quantity, with a list of those that there are.
    pub(crate) fn nothing_varied(&self, model: &Model, option: &'static str) -> Failure {
        match variables(model) {
            Ok(variables) => Failure::NothingVaried { option, variables },
            Err(faults) => self.refused(faults),
        }
    }

    /// [`Input::vary`] of two quantities, with the faults of both.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn vary_both(&self, model: &Model, texts: [&str; 2]) -> Result<[Vary; 2], Failure> {
        let mut faults = Faults::default();
        let read = texts.map(|text| text.parse::<Vary>().map_err(|found| faults.append(found)).ok());
        let [Some(x), Some(y)] = read else { return Err(self.refused(faults)) };
        let mut warnings = x.warnings(model);
        warnings.append(y.warnings(model));
        self.warn(warnings)?;
        Ok([x, y])
    }

    /// Tells of warnings.
    ///
    /// # Errors
    /// The warnings if they are to be errors.
    pub(crate) fn warn(&self, warnings: Faults) -> Result<(), Failure> {
        if warnings.is_empty() {
            return Ok(());
        }
        if self.strict {
            return Err(self.refused(warnings));
        }
        complain(&diagnostics::warnings(&self.faulty(self.settings.clone(), warnings)), self.color);
        Ok(())
    }

    /// The model with its settings, for who tells of its warnings.
    ///
    /// # Errors
    /// All faults of both.
    pub(crate) fn model_without_warnings(&self) -> Result<Model, Failure> {
        let model = Model::parse_bytes(&self.bytes);
        let with_settings = match model {
            Ok(model) => model.with_varied(&self.settings, &self.varied).map_err(|mut faults| {
                faults.append(model.warnings_of(&self.settings));
                faults
            }),
            Err(faults) => Err(faults),
        };
        match with_settings {
            Ok(model) if self.malformed.is_empty() => Ok(match self.units {
                Some(system) => model.with_units(system),
                None => model,
            }),
            found => {
                let mut faults = found.err().unwrap_or_default();
                self.malformed.iter().for_each(|fault| faults.push(fault.clone()));
                Err(self.refused(faults))
            }
        }
    }

    /// The failure that these faults are.
    pub(crate) fn refused(&self, faults: Faults) -> Failure {
        self.refused_with(self.settings.clone(), faults)
    }

    /// The failure that these faults of another option of the command line are.
    pub(crate) fn refused_option(&self, option: Setting, faults: Faults) -> Failure {
        self.refused_with(Settings::default().with(option), faults)
    }

    fn refused_with(&self, settings: Settings, faults: Faults) -> Failure {
        Failure::Input(Box::new(self.faulty(settings, faults)))
    }

    fn faulty(&self, settings: Settings, faults: Faults) -> FaultyInput {
        FaultyInput {
            name: self.name.clone(),
            text: self.text(),
            settings,
            parameter_option: "--set ",
            faults,
        }
    }

    /// Refuses warnings if they are to be errors.
    ///
    /// # Errors
    /// The warnings.
    pub(crate) fn be_strict(&self, model: &Model) -> Result<(), Failure> {
        if self.strict { self.warn(warnings(model)) } else { Ok(()) }
    }

    /// The text of the model; what is no UTF-8 is replaced by U+FFFD, which keeps everything before it in
    /// place.
    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.bytes).into_owned()
    }
}

/// The name of an input in messages.
pub(crate) fn name(path: &Path) -> String {
    if path == Path::new("-") { "standard input".to_owned() } else { path.display().to_string() }
}

/// The bytes of a file, or of standard input for `-`; none if there are more than `limit`, and no more
/// than that are read.
///
/// # Errors
/// If it cannot be read.
pub(crate) fn read_bytes(path: &Path, limit: u64) -> Result<Option<Vec<u8>>, Failure> {
    let (source, size) = open(path)?;
    let mut bytes = Vec::new();
    if size <= limit {
        source.take(limit + 1).read_to_end(&mut bytes).map_err(|error| cannot_read(path, error))?;
    }
    let size = size.max(bytes.len() as u64);
    Ok((size <= limit).then_some(bytes))
}

/// A file, or standard input for `-`, and its size as far as it is known.
///
/// # Errors
/// If it cannot be read.
pub(crate) fn open(path: &Path) -> Result<(Box<dyn Read>, u64), Failure> {
    if path == Path::new("-") {
        return Ok((Box::new(io::stdin().lock()), 0));
    }
    let file = File::open(path).map_err(|error| cannot_read(path, error))?;
    let metadata = file.metadata().map_err(|error| cannot_read(path, error))?;
    if metadata.is_dir() {
        return Err(Failure::IsDirectory { path: path.to_owned() });
    }
    Ok((Box::new(file), metadata.len()))
}

/// Builds the failure of a file that cannot be read.
pub(crate) fn cannot_read(path: &Path, error: io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::NotFound => {
            let (nearest, gallery_name) = (nearest_file(path), gallery_name(path));
            Failure::NotFound { path: path.to_owned(), nearest, gallery_name }
        }
        io::ErrorKind::IsADirectory => Failure::IsDirectory { path: path.to_owned() },
        _ => Failure::CannotRead { path: path.to_owned(), error },
    }
}

/// The file of the same kind in the same folder whose name is most like that of one that does not exist.
fn nearest_file(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?.flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut alike: Vec<String> =
        names.filter(|name| Path::new(name).extension() == path.extension()).collect();
    alike.sort();
    let name = nearest(path.file_name()?.to_str()?, alike.iter().map(String::as_str))?;
    Some(path.with_file_name(name).display().to_string())
}

/// The model of the gallery that was meant by the path of a file that does not exist.
fn gallery_name(path: &Path) -> Option<&'static str> {
    let name = path.file_name()?.to_str()?;
    gallery::find(name.strip_suffix(".toml").unwrap_or(name)).map(|model| model.name)
}
