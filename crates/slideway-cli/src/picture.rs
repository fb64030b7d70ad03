//! Files of pictures, in the format that their ending names.

use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::output::Output;
use crate::pixels;
use slideway_pictures::NotFinite;
use std::path::Path;

/// Format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Picture {
    /// Vectors and text.
    Svg,
    /// Pixels.
    Png,
}

const ENDINGS: [&str; 2] = [".svg", ".png"];
const ENDINGS_WITH_JSON: [&str; 3] = [".svg", ".png", ".json"];
/// Pixels for each unit of a picture, unless its width is given.
pub(crate) const SHARPNESS: f64 = 2.0;

impl Picture {
    /// The format of a file.
    ///
    /// # Errors
    /// If its ending names none, or one that this program was built without.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        match ending.to_ascii_lowercase().as_str() {
            "svg" => Ok(Self::Svg),
            "png" => pixels::are_there().map(|()| Self::Png),
            _ => Err(Failure::FileFormat { path: path.to_owned(), known: &ENDINGS }),
        }
    }

    /// The format of a file that may also hold numbers; none for these.
    ///
    /// # Errors
    /// If its ending names none.
    pub(crate) fn unless_json(path: &Path) -> Result<Option<Self>, Failure> {
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
            return Ok(None);
        }
        let known = &ENDINGS_WITH_JSON;
        Self::of(path).map(Some).map_err(|failure| match failure {
            Failure::FileFormat { path, .. } => Failure::FileFormat { path, known },
            other => other,
        })
    }

    /// Writes a picture that was made as SVG, with two pixels for each of its units if it is to have pixels, and says so.
    ///
    /// # Errors
    /// If it could not be made, or cannot be converted or written.
    pub(crate) fn write(self, svg: Result<String, NotFinite>, output: &Output) -> Result<(), Failure> {
        self.write_scaled(svg, SHARPNESS, output)?;
        output.announce()
    }

    /// Writes a picture that was made as SVG, with so many pixels for each of its units if it is to have
    /// pixels.
    ///
    /// # Errors
    /// As [`Picture::write`].
    pub(crate) fn write_scaled(
        self,
        svg: Result<String, NotFinite>,
        scale: f64,
        output: &Output,
    ) -> Result<(), Failure> {
        let svg = svg?;
        match self {
            Self::Svg => output.write_bytes(svg.as_bytes()),
            Self::Png => output.write_bytes(&pixels::png(&svg, scale)?),
        }
    }
}

/// The format and the file of a plot beside an answer, if there is to be one; the file is in order before the
/// work begins.
///
/// # Errors
/// As [`Files::beside`], and if its ending names no format.
pub(crate) fn beside(
    plot: &PlotArguments,
    files: &mut Files<'_>,
) -> Result<Option<(Picture, Output)>, Failure> {
    let Some(path) = &plot.plot else { return Ok(None) };
    let file = files.beside(path)?;
    Ok(Some((Picture::of(path)?, file)))
}
