//! Motions in time: plots of a history, and the mechanism moving.

mod animation;
mod figure;
mod page;

pub use animation::{Animation, AnimationOptions, animation};
pub use figure::{motion_figure, portrait_figure};
