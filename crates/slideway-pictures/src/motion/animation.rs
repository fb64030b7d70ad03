//! The mechanism moving: one drawing for each frame, contact modes exaggerated.

use crate::drawing::svg::markup;
use crate::drawing::{
    Bounds, ContactForces, ContactState, ContactStates, PinForce, Scene, SceneOptions, View,
};
use crate::drawing::{forces_on, scale_of_circles, scene, signs};
use crate::theme::Theme;
use slideway::configuration::Configuration;
use slideway::motion::{History, Sample, phase_in_words};
use slideway::progress::{Callback, Progress};
use slideway::units::Unit;
use std::ops::ControlFlow;

/// Frames for a second on the clock.
const FRAMES_PER_SECOND: f64 = 25.0;
/// At most so many frames.
const MOST_FRAMES: usize = 400;
/// Without a wish a motion is shown as fast as it is if that takes between these times (s), else in this
/// time.
const USUAL: [f64; 3] = [3.0, 16.0, 8.0];
/// Width and height of the part of the drawing that the mechanism takes (drawing units).
const SIZE: [f64; 2] = [560.0, 300.0];
/// Length of the arrow of the greatest force (drawing units).
const LONGEST_ARROW: f64 = 80.0;
/// The greatest force is that which only this part of the frames exceeds: forces may grow very large before a
/// jam.
const RARE: f64 = 0.05;
/// Around the drawing (drawing units).
const MARGIN: f64 = 24.0;
/// The drawing is at least as wide as this, for the words below it (drawing units).
const LEAST_WIDTH: f64 = 600.0;

/// How a motion is shown.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AnimationOptions {
    /// How many seconds one second of the motion takes.
    pub slow_motion: Option<f64>,
}

/// A moving picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Animation {
    pub(super) title: String,
    pub(super) bounds: Bounds,
    /// The shapes that occur, each once, as SVG.
    pub(super) shapes: Vec<String>,
    pub(super) frames: Vec<FrameOf>,
    /// The words for each event, and the time (s) from which they are shown.
    pub(super) events: Vec<(f64, String)>,
    /// Start and end of the motion (s).
    pub(super) times: [f64; 2],
    /// Seconds on the clock between two frames.
    pub(super) frame_time: f64,
    pub(super) slow_motion: f64,
    /// Drawing units for a newton; none without forces.
    pub(super) force_scale: Option<f64>,
    /// The unit of forces.
    pub(super) force_unit: Unit,
    /// The modes that occur, in words, each once.
    pub(super) words: Vec<String>,
    /// Whether the play of guides is drawn greater than it is.
    pub(super) is_exaggerated: bool,
    /// How large friction circles of hinges are drawn, in words; none without them.
    pub(super) friction_circles: Option<String>,
    /// On what the forces of contacts act.
    pub(super) forces_on: &'static str,
    pub(super) theme: Theme,
}

/// One frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FrameOf {
    /// s
    pub(super) time: f64,
    /// The mode, spaced.
    pub(super) mode: String,
    /// Index of its words.
    pub(super) words: usize,
    /// Indices of shapes, in the order in which they are drawn.
    pub(super) shapes: Vec<usize>,
}

/// A motion as a moving picture.
pub fn animation(history: &History, options: &AnimationOptions, theme: &Theme) -> Animation {
    animation_with(history, options, theme, &mut |_| ControlFlow::Continue(())).expect("nothing ends it")
}

/// Draws a motion as a moving picture. Returns `None` if the callback, which receives the number of frames
/// that are drawn, ended the work.
pub fn animation_with(
    history: &History,
    options: &AnimationOptions,
    theme: &Theme,
    callback: &mut Callback<'_>,
) -> Option<Animation> {
    let times = [history.start(), history.stop()];
    let duration = times[1] - times[0];
    let slow_motion = options.slow_motion.unwrap_or_else(|| {
        if (USUAL[0]..=USUAL[1]).contains(&duration) || duration <= 0.0 { 1.0 } else { USUAL[2] / duration }
    });
    let shown = duration * slow_motion;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let count = (shown * FRAMES_PER_SECOND).ceil().clamp(1.0, MOST_FRAMES as f64) as usize;
    let mut reader = history.reader();
    let samples: Vec<Sample> = (0..=count)
        .filter_map(|index| reader.at(times[0] + duration * index as f64 / count as f64))
        .collect();
    let painted = Painted::new(history, &samples);
    let force_scale = painted.force_scale;
    let Painting { shapes, frames, bounds, words, is_exaggerated, friction_circles } =
        painted.frames(callback)?;
    Some(Animation {
        title: history.mechanism.title.clone().unwrap_or_else(|| "A mechanism".to_owned()),
        bounds,
        shapes,
        frames,
        events: history.events.iter().map(|event| (event.time, event.words.clone())).collect(),
        times,
        frame_time: shown / count as f64,
        slow_motion,
        force_scale,
        force_unit: history.mechanism.units.of("N"),
        words,
        is_exaggerated,
        friction_circles: friction_circles.map(scale_of_circles),
        forces_on: forces_on(&history.mechanism),
        theme: *theme,
    })
}

/// All that is painted of a motion.
struct Painting {
    /// The shapes that occur.
    shapes: Vec<String>,
    /// The frames made of them.
    frames: Vec<FrameOf>,
    /// The part of the drawing that they need.
    bounds: Bounds,
    /// Words of the modes.
    words: Vec<String>,
    /// Whether any frame shows more play than there is.
    is_exaggerated: bool,
    /// By how much friction circles of hinges are magnified.
    friction_circles: Option<f64>,
}

struct Painted<'h> {
    history: &'h History,
    samples: &'h [Sample],
    view: View,
    options: SceneOptions,
    force_scale: Option<f64>,
}

impl<'h> Painted<'h> {
    fn new(history: &'h History, samples: &'h [Sample]) -> Self {
        let configurations: Vec<&Configuration> =
            samples.iter().map(|sample| &sample.configuration).collect();
        let view = View::fitting(&history.mechanism, &configurations, SIZE);
        let mut forces: Vec<f64> = samples
            .iter()
            .flat_map(|sample| {
                let contacts = sample.contacts.iter().map(|contact| contact.normal_force.abs());
                contacts
                    .chain(PinForce::in_motion(&history.mechanism, sample).iter().map(PinForce::size))
                    .collect::<Vec<_>>()
            })
            .collect();
        forces.sort_by(f64::total_cmp);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of the length")]
        let rare = (forces.len() as f64 * (1.0 - RARE)) as usize;
        let greatest = forces.get(rare).or(forces.last()).copied().unwrap_or(0.0);
        let force_scale = (greatest > 0.0).then_some(LONGEST_ARROW / greatest);
        let scale = force_scale.unwrap_or(1.0);
        // Words would flicker.
        let options = SceneOptions { values: false, ..SceneOptions::contact_mode(scale) };
        Self { history, samples, view, options, force_scale }
    }

    fn frames(&self, callback: &mut Callback<'_>) -> Option<Painting> {
        let mut words: Vec<String> = Vec::new();
        let mut shapes: Vec<String> = Vec::new();
        let mut known = std::collections::HashMap::new();
        let mut frames = Vec::with_capacity(self.samples.len());
        let mut bounds: Option<Bounds> = None;
        let (mut is_exaggerated, mut friction_circles) = (false, None);
        for (done, sample) in self.samples.iter().enumerate() {
            if callback(&Progress::of("drawings", done as u64, self.samples.len() as u64)).is_break() {
                return None;
            }
            let scene = self.scene(sample);
            is_exaggerated |= scene.is_exaggerated;
            friction_circles = friction_circles.or(scene.friction_circles);
            bounds = bounds.into_iter().chain(scene.bounds()).reduce(Bounds::with);
            let mut indices = Vec::with_capacity(scene.elements.len());
            for element in &scene.elements {
                let text = markup(element);
                let index = *known.entry(text).or_insert_with_key(|text| {
                    shapes.push(text.clone());
                    shapes.len() - 1
                });
                indices.push(index);
            }
            let mode = self.mode(sample);
            let time = sample.configuration.time;
            let told = self.words(sample);
            let place = words.iter().position(|known| *known == told).unwrap_or_else(|| {
                words.push(told);
                words.len() - 1
            });
            frames.push(FrameOf { time, mode: signs(&mode), words: place, shapes: indices });
        }
        let empty = Bounds { least: nalgebra::Vector2::zeros(), greatest: nalgebra::Vector2::zeros() };
        let bounds = bounds.unwrap_or(empty).widened(MARGIN).at_least_as_wide_as(LEAST_WIDTH);
        Some(Painting { shapes, frames, bounds, words, is_exaggerated, friction_circles })
    }

    fn words(&self, sample: &Sample) -> String {
        let phase = self.history.phases.get(sample.phase);
        phase.map_or_else(String::new, |interval| {
            phase_in_words(&self.history.mechanism, &sample.configuration, &interval.phase)
        })
    }

    fn mode(&self, sample: &Sample) -> String {
        let phase = self.history.phases.get(sample.phase);
        phase.map_or_else(String::new, |interval| interval.phase.pattern(&self.history.mechanism))
    }

    /// The drawing at a time.
    fn scene(&self, sample: &Sample) -> Scene {
        let mode = self.mode(sample);
        let forces = self.history.forces(sample);
        let contacts = sample.contacts.iter().zip(forces).zip(mode.chars());
        // Where joints stick, what statics leaves open has no arrow.
        let contacts = contacts.map(|((contact, [normal, friction]), sign)| ContactState {
            side: match sign {
                '+' => 1.0,
                '-' => -1.0,
                '0' => 0.0,
                _ if contact.normal_force == 0.0 => 0.0,
                _ => contact.normal_force.signum(),
            },
            forces: Some(ContactForces {
                normal: normal.unwrap_or(0.0),
                friction: friction.unwrap_or(0.0),
                couple: 0.0,
                spread: [0.0; 2],
            }),
            ..ContactState::default()
        });
        let (contacts, efforts) = (contacts.collect(), sample.efforts.clone());
        let pins = PinForce::in_motion(&self.history.mechanism, sample);
        let states = ContactStates { contacts, efforts, pins };
        scene(&self.history.mechanism, &sample.configuration, &states, &self.view, &self.options)
    }
}
