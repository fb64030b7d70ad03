//! The questions that can be asked.

use crate::kept::Kept;
use serde::Deserialize;
use slideway::fault::Faults;
use slideway::limits::Vary;
use slideway::model::{Model, Settings};
use slideway_pictures::theme::{DARK, LIGHT, Theme};
use std::cell::RefCell;
use std::rc::Rc;

/// A question of the page.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
pub(crate) enum Question {
    /// The models to begin with.
    Library,
    /// The style sheet of the pictures, whose colours are variables of the page.
    Style,
    /// All that the page shows of a state.
    Look {
        #[serde(flatten)]
        of: Asked,
        /// Whether margins of friction are computed, too, which may take longer than everything else.
        margins: bool,
        #[serde(flatten)]
        drawn: Drawn,
    },
    /// The text of the model with what is changed in it.
    Save(Asked),
    /// `slideway check`
    Check(Asked),
    /// `slideway solve`
    Solve(Asked),
    /// `slideway hold`
    Hold {
        #[serde(flatten)]
        of: Asked,
        /// The load whose factor is asked for.
        load: Option<String>,
    },
    /// `slideway drive`
    Drive(Asked),
    /// `slideway limits`, or `slideway hold --vary` where motion has no answer
    Limits {
        #[serde(flatten)]
        of: Asked,
        /// `NAME` or `NAME=FROM..TO`.
        vary: String,
        /// Whether the curves of the normal forces are drawn, too.
        #[serde(default)]
        plot: bool,
        #[serde(default)]
        theme: ThemeName,
    },
    /// `slideway map`
    Map {
        #[serde(flatten)]
        of: Asked,
        /// `NAME=FROM..TO`
        x: String,
        y: String,
        /// A word of `--colour-by`.
        colour_by: String,
        /// Pixels from left to right and from bottom to top.
        size: [usize; 2],
        #[serde(default)]
        theme: ThemeName,
    },
    /// `slideway simulate`
    Simulate {
        #[serde(flatten)]
        of: Asked,
        until: String,
        /// Whether the frames of a moving picture are made, too.
        #[serde(default)]
        frames: bool,
        /// Whether the table of the motion is made, too, as CSV.
        #[serde(default)]
        table: bool,
    },
    /// `slideway draw`
    Draw {
        #[serde(flatten)]
        of: Asked,
        #[serde(default)]
        theme: ThemeName,
    },
}

/// A model and what is changed in it.
#[derive(Debug, Deserialize)]
pub(crate) struct Asked {
    /// The text of the model file.
    pub(crate) text: String,
    /// The changes of the model, as by `--set`, `--at`, `--rate`, `--time`.
    #[serde(default)]
    pub(crate) settings: Settings,
}

/// How the drawings of a state are laid out.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
pub(crate) struct Drawn {
    /// The scale and the place that the last answer about this model gave its drawings to keep.
    #[serde(default)]
    pub(crate) held: Option<Kept>,
    /// The greatest width (drawing units) of those that keep nothing.
    #[serde(default)]
    pub(crate) most: Option<f64>,
}

impl Asked {
    /// The model with its settings.
    ///
    /// # Errors
    /// All faults of both, with the warnings of settings that may be the reason for them.
    pub(crate) fn model(&self) -> Result<Model, Faults> {
        let file = self.file()?;
        self.set(&file)
    }

    /// The model of the text alone. One question after another is about the same text: it is read once.
    ///
    /// # Errors
    /// All faults of the text.
    pub(crate) fn file(&self) -> Result<Rc<Model>, Faults> {
        read(&self.text)
    }

    /// The model of the file with the settings.
    ///
    /// # Errors
    /// All faults of the settings, with their warnings, which may be the reason for them.
    pub(crate) fn set(&self, file: &Model) -> Result<Model, Faults> {
        file.with(&self.settings).map_err(|mut faults| {
            faults.append(file.warnings_of(&self.settings));
            faults
        })
    }
}

thread_local! {
    /// The text that was read last, and its model.
    static LAST: RefCell<Option<(String, Rc<Model>)>> = const { RefCell::new(None) };
}

fn read(text: &str) -> Result<Rc<Model>, Faults> {
    let known = LAST.with_borrow(|last| {
        let same = last.as_ref().filter(|(known, _)| known == text);
        same.map(|(_, model)| Rc::clone(model))
    });
    if let Some(model) = known {
        return Ok(model);
    }
    let model = Rc::new(Model::parse(text)?);
    LAST.set(Some((text.to_owned(), Rc::clone(&model))));
    Ok(model)
}

/// Parses a quantity that is varied, as by `--vary`.
///
/// # Errors
/// A text that is none.
pub(crate) fn vary(text: &str) -> Result<Vary, Faults> {
    text.parse()
}

/// Colours of a picture.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ThemeName {
    #[default]
    Light,
    Dark,
}

impl ThemeName {
    pub(crate) fn colours(self) -> &'static Theme {
        match self {
            Self::Light => &LIGHT,
            Self::Dark => &DARK,
        }
    }
}
