//! A moving picture as data, for pages that have a player of their own.

use super::animation::Animation;
use super::page::{force_scale, speed, view_box};
use crate::coordinate::{NotFinite, finished, finished_parts};
use serde::Serialize;

/// The frames of a moving picture. Its shapes are SVG with the classes of [`crate::drawing::svg::rules`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Film<'a> {
    /// Its title.
    pub(crate) title: &'a str,
    /// The part of the plane that is shown: left, top, width and height.
    pub(crate) view_box: String,
    /// The shapes that occur, each once.
    pub shapes: &'a [String],
    /// The frames, each with the shapes that it shows.
    pub frames: Vec<FilmFrame<'a>>,
    /// The modes that occur, in words, each once.
    pub(crate) words: &'a [String],
    /// The events: time (s) and words of each.
    pub(crate) events: &'a [(f64, String)],
    /// Seconds on the clock between two frames.
    pub(crate) frame_time: f64,
    /// How fast it is shown, in words.
    pub(crate) speed: String,
    /// An arrow of a round force with its value, as SVG.
    pub(crate) force_scale: String,
    /// Whether the play of guides is drawn greater than it is.
    pub(crate) is_exaggerated: bool,
    /// How large friction circles of hinges are drawn, in words; absent without them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_circles: Option<&'a str>,
}

/// One frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FilmFrame<'a> {
    /// s
    pub(crate) time: f64,
    /// The contact mode.
    pub(crate) mode: &'a str,
    /// Index of its words.
    pub(crate) words: usize,
    /// Indices of its shapes, in the order in which they are drawn.
    pub shapes: &'a [usize],
}

impl Animation {
    /// Its frames as data.
    ///
    /// # Errors
    /// If a place or a size is infinite or undefined.
    pub fn film(&self) -> Result<Film<'_>, NotFinite> {
        finished_parts(&self.shapes)?;
        let frames = self.frames.iter().map(|frame| FilmFrame {
            time: frame.time,
            mode: &frame.mode,
            words: frame.words,
            shapes: &frame.shapes,
        });
        Ok(Film {
            title: &self.title,
            view_box: finished(view_box(self, 0.0))?,
            shapes: &self.shapes,
            frames: frames.collect(),
            words: &self.words,
            events: &self.events,
            frame_time: self.frame_time,
            speed: speed(self),
            force_scale: finished(force_scale(self))?,
            is_exaggerated: self.is_exaggerated,
            friction_circles: self.friction_circles.as_deref(),
        })
    }
}
