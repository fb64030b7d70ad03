//! Motions in time: plots of a history, and the mechanism moving.
//!
//! # Files
//! In `slideway-pictures` `motion/` makes figures (`figure.rs`) and moving pictures (`animation.rs` collects
//! the shapes of all frames, `page.rs` writes SVG, `html.rs` a page, `film.rs` has the frames as data, `gif.rs` a GIF with
//! the colours of `palette.rs`) of a history.

mod animation;
mod figure;
mod film;
#[cfg(feature = "png")]
mod gif;
mod html;
mod page;
#[cfg(feature = "png")]
mod palette;

pub use animation::{Animation, AnimationOptions, animation, animation_with};
pub use figure::{motion_figure, portrait_figure};
pub use film::{Film, FilmFrame};
#[cfg(feature = "png")]
pub use gif::GifFault;
