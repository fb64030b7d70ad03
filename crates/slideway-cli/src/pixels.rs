//! Pictures of pixels, if the program was built with them (feature `png`).

use crate::failure::Failure;
use crate::output::Output;
use crate::watch::Watch;
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
    use super::{Animation, Failure, Output, Watch};
    use crate::halt::Halt;
    use slideway::progress::Progress;
    use slideway_pictures::motion::GifFault;
    use slideway_pictures::raster;
    use std::ops::ControlFlow;

    /// A picture that was made as SVG, with so many pixels for each of its units, as PNG.
    ///
    /// # Errors
    /// If it would be too large.
    pub(crate) fn png(svg: &str, scale: f64) -> Result<Vec<u8>, Failure> {
        raster::png(svg, scale).map_err(|fault| Failure::Picture { reason: fault.to_string() })
    }

    /// A moving picture as GIF. What was simulated until the time was up is shown whole, unless someone
    /// interrupts.
    ///
    /// # Errors
    /// If it was interrupted, or would stand for too long.
    pub(crate) fn gif(animation: &Animation, watch: &mut Watch, output: &Output) -> Result<Vec<u8>, Failure> {
        let time_was_up = watch.halt().is_some();
        let mut progress = |progress: &Progress| match watch.look(progress) {
            ControlFlow::Break(()) if time_was_up && watch.halt() != Some(Halt::Interrupted) => {
                ControlFlow::Continue(())
            }
            flow => flow,
        };
        let bytes = animation.to_gif(&mut progress);
        bytes.map_err(|fault| match fault {
            GifFault::Ended => {
                Failure::Halted { halt: watch.halt().unwrap_or(Halt::Interrupted), path: output.path() }
            }
            fault => Failure::Picture { reason: fault.to_string() },
        })
    }
}

#[cfg(not(feature = "png"))]
mod without_pixels {
    use super::{Animation, Failure, Output, Watch};

    pub(crate) fn png(_: &str, _: f64) -> Result<Vec<u8>, Failure> {
        Err(Failure::WithoutPixels)
    }

    pub(crate) fn gif(_: &Animation, _: &mut Watch, _: &Output) -> Result<Vec<u8>, Failure> {
        Err(Failure::WithoutPixels)
    }
}
