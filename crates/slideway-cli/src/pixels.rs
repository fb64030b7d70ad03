//! Pictures of pixels, if the program was built with them (feature `png`).

use crate::failure::Failure;
use slideway::progress::Callback;
use slideway_pictures::motion::Animation;

/// Whether there are any, asked before the work begins.
///
/// # Errors
/// If the program was built without them.
pub(crate) fn are_there() -> Result<(), Failure> {
    if cfg!(feature = "png") { Ok(()) } else { Err(Failure::WithoutPixels) }
}

#[cfg(feature = "png")]
pub(crate) use with_pixels::{gif, png};
#[cfg(not(feature = "png"))]
pub(crate) use without_pixels::{gif, png};

#[cfg(feature = "png")]
mod with_pixels {
    use super::{Animation, Callback, Failure};
    use slideway_pictures::motion::GifFault;
    use slideway_pictures::raster;

    /// A picture that was made as SVG, with so many pixels for each of its units, as PNG.
    ///
    /// # Errors
    /// If it would be too large.
    pub(crate) fn png(svg: &str, scale: f64) -> Result<Vec<u8>, Failure> {
        raster::png(svg, scale).map_err(|fault| Failure::Picture { reason: fault.to_string() })
    }

    /// A moving picture as GIF; nothing if it was ended.
    ///
    /// # Errors
    /// If it would stand for too long.
    pub(crate) fn gif(
        animation: &Animation,
        callback: &mut Callback<'_>,
    ) -> Result<Option<Vec<u8>>, Failure> {
        match animation.to_gif(callback) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(GifFault::Ended) => Ok(None),
            Err(fault) => Err(Failure::Picture { reason: fault.to_string() }),
        }
    }
}

#[cfg(not(feature = "png"))]
mod without_pixels {
    use super::{Animation, Callback, Failure};

    pub(crate) fn png(_: &str, _: f64) -> Result<Vec<u8>, Failure> {
        Err(Failure::WithoutPixels)
    }

    pub(crate) fn gif(_: &Animation, _: &mut Callback<'_>) -> Result<Option<Vec<u8>>, Failure> {
        Err(Failure::WithoutPixels)
    }
}
