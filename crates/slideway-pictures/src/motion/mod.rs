//! Motions in time: plots of a history, and the mechanism moving.

mod animation;
mod figure;
mod gif;
mod page;
mod palette;

pub use animation::{Animation, AnimationOptions, animation};
pub use figure::{motion_figure, portrait_figure};
pub use gif::GifFault;
