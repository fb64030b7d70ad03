//! Files of pictures, in the format that their ending names.

use crate::arguments::{Destination, ModelArguments, PlotArguments};
use crate::failure::Failure;
use crate::output::Output;
use std::path::Path;

/// Format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PictureFormat {
    /// Vectors and text.
    Svg,
}

const ENDINGS: [&str; 1] = [".svg"];

impl PictureFormat {
    /// The format of a file.
    ///
    /// # Errors
    /// If its ending names none.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        match ending.to_ascii_lowercase().as_str() {
            "svg" => Ok(Self::Svg),
            _ => Err(Failure::PictureFormat { path: path.to_owned(), known: &ENDINGS }),
        }
    }
}

/// A file for a picture, whose path was found to be in order before the work began.
pub(crate) struct Picture {
    format: PictureFormat,
    output: Output,
}

impl Picture {
    /// The plot beside an answer, if there is to be one.
    ///
    /// # Errors
    /// If its file exists, is the model, is that of the answer, or has an ending that names no format.
    pub(crate) fn beside(
        plot: &PlotArguments,
        answer: &Destination,
        model: &ModelArguments,
        output: &Output,
    ) -> Result<Option<Self>, Failure> {
        let Some(path) = &plot.plot else { return Ok(None) };
        if answer.output.as_ref() == Some(path) {
            return Err(Failure::SameOutput { path: path.clone() });
        }
        let format = PictureFormat::of(path)?;
        let destination = Destination { output: Some(path.clone()), force: answer.force };
        model.spare(&destination)?;
        Ok(Some(Self { format, output: output.to(&destination)? }))
    }

    /// Writes a picture that is given as SVG.
    ///
    /// # Errors
    /// If it cannot be converted or written.
    pub(crate) fn write(&self, svg: String) -> Result<(), Failure> {
        match self.format {
            PictureFormat::Svg => self.output.write_bytes(svg.as_bytes()),
        }
    }
}
