//! A moving picture as GIF.

use super::animation::{Animation, FrameOf};
use super::page::{still, still_size};
use super::palette::{Colour, Palette};
use crate::raster::{RasterFault, pixels};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;
use resvg::tiny_skia::Pixmap;
use std::borrow::Cow;
use std::collections::HashMap;
use thiserror::Error;

/// The greatest width and height (pixels).
const GREATEST_SIDE: f64 = 1000.0;
/// One of so many frames is asked for its colours.
const SAMPLED: usize = 8;
/// So many frames are drawn before they are packed.
const CHUNK: usize = 32;
/// Delays are counted in these (1/s).
const TICKS: f64 = 100.0;
/// Viewers show frames with a shorter delay for a tenth of a second.
const LEAST_DELAY: u16 = 2;

/// Why a motion has no GIF.
#[derive(Debug, Error)]
pub enum GifFault {
    /// The motion has no frame.
    #[error("there is nothing to show")]
    NoFrame,
    /// A frame would stand too long.
    #[error(
        "each frame would stand for {frame_time:.0} s, and a GIF can say 655 s at most; less slow motion helps"
    )]
    Slow {
        /// Seconds between two frames.
        frame_time: f64,
    },
    /// A frame has no pixels.
    #[error(transparent)]
    Raster(#[from] RasterFault),
    /// The frames cannot be packed.
    #[error("the frames cannot be packed as GIF: {0}")]
    Packing(#[from] gif::EncodingError),
}

/// The bytes of the file.
pub(super) fn write(animation: &Animation, progress: &mut dyn FnMut(f64)) -> Result<Vec<u8>, GifFault> {
    if animation.frames.is_empty() {
        return Err(GifFault::NoFrame);
    }
    let delays = delays(animation)?;
    let scale = scale(animation);
    let sampled = animation.frames.iter().step_by(SAMPLED).collect::<Vec<_>>();
    let counted = sampled.par_iter().map(|frame| Ok(counts(&drawn(animation, frame, scale)?)));
    let counted = counted.collect::<Result<Vec<_>, GifFault>>()?;
    let palette = Palette::of(&flat_colours(animation), &together(counted));

    let size = drawn(animation, &animation.frames[0], scale)?;
    let size = [size.width() as usize, size.height() as usize];
    let [width, height] = size.map(small);
    let mut encoder = Encoder::new(Vec::new(), width, height, &palette.table())?;
    encoder.set_repeat(Repeat::Infinite)?;
    // The last frame of the chunk before, as indices of colours.
    let mut before: Option<Vec<u8>> = None;
    let mut done = 0;
    for (frames, delays) in animation.frames.chunks(CHUNK).zip(delays.chunks(CHUNK)) {
        let indexed = frames.par_iter().map(|frame| Ok(indexed(&drawn(animation, frame, scale)?, &palette)));
        let indexed = indexed.collect::<Result<Vec<_>, GifFault>>()?;
        let packed = (0..frames.len()).into_par_iter().map(|number| {
            let earlier = if number == 0 { before.as_ref() } else { Some(&indexed[number - 1]) };
            packed((earlier, &indexed[number]), size, delays[number], palette.unchanged())
        });
        for frame in packed.collect::<Vec<_>>() {
            encoder.write_lzw_pre_encoded_frame(&frame)?;
        }
        before = indexed.into_iter().next_back();
        done += frames.len();
        progress(done as f64 / animation.frames.len() as f64);
    }
    Ok(encoder.into_inner()?)
}

/// How long each frame stands (1/100 s): until the hundredth that is nearest to the time of the next one.
fn delays(animation: &Animation) -> Result<Vec<u16>, GifFault> {
    let frame_time = animation.frame_time;
    if frame_time * TICKS > f64::from(u16::MAX) - 1.0 {
        return Err(GifFault::Slow { frame_time });
    }
    let tick = |number: usize| (TICKS * frame_time * number as f64).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within 0 and u16::MAX")]
    let delay = |number: usize| ((tick(number + 1) - tick(number)) as u16).max(LEAST_DELAY);
    Ok((0..animation.frames.len()).map(delay).collect())
}

/// Pixels for each unit of the drawing.
fn scale(animation: &Animation) -> f64 {
    still_size(animation).into_iter().fold(1.0, |scale, side| scale.min(GREATEST_SIDE / side))
}

fn drawn(animation: &Animation, frame: &FrameOf, scale: f64) -> Result<Pixmap, RasterFault> {
    pixels(&still(animation, frame), scale)
}

/// The colours of a picture, row by row; it has a background.
fn colours(picture: &Pixmap) -> impl Iterator<Item = Colour> {
    picture.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
}

/// How many pixels have each colour.
fn counts(picture: &Pixmap) -> HashMap<Colour, u64> {
    let mut counts = HashMap::new();
    colours(picture).for_each(|colour| *counts.entry(colour).or_insert(0) += 1);
    counts
}

fn together(counted: Vec<HashMap<Colour, u64>>) -> HashMap<Colour, u64> {
    let mut all = HashMap::new();
    for (colour, count) in counted.into_iter().flatten() {
        *all.entry(colour).or_insert(0) += count;
    }
    all
}

/// The colours of the theme; one that only a frame between the sampled ones shows has its place, too.
fn flat_colours(animation: &Animation) -> Vec<Colour> {
    let theme = &animation.theme;
    let named = [theme.background, theme.ink, theme.muted, theme.body, theme.reaction, theme.friction];
    named.into_iter().chain(theme.series).filter_map(parsed).collect()
}

/// A colour such as `#0072b2`.
fn parsed(text: &str) -> Option<Colour> {
    let number = u32::from_str_radix(text.strip_prefix('#')?, 16).ok()?;
    let [_, red, green, blue] = number.to_be_bytes();
    Some([red, green, blue])
}

/// A picture as indices of colours.
fn indexed(picture: &Pixmap, palette: &Palette) -> Vec<u8> {
    let mut known = HashMap::new();
    colours(picture).map(|colour| *known.entry(colour).or_insert_with(|| palette.nearest(colour))).collect()
}

/// A frame, packed: the least rectangle with all pixels that differ from the frame before; those in it that do not
/// are see-through.
fn packed(
    (earlier, now): (Option<&Vec<u8>>, &[u8]),
    [width, height]: [usize; 2],
    delay: u16,
    unchanged: u8,
) -> Frame<'static> {
    let differs = |place: usize| earlier.is_none_or(|earlier| earlier[place] != now[place]);
    let row_differs = |row: usize| (0..width).any(|column| differs(row * width + column));
    let rows = span(height, row_differs);
    let columns = span(width, |column| rows.clone().any(|row| differs(row * width + column)));
    let mut buffer = Vec::with_capacity(rows.len() * columns.len());
    for row in rows.clone() {
        let places = columns.clone().map(|column| row * width + column);
        buffer.extend(places.map(|place| if differs(place) { now[place] } else { unchanged }));
    }
    let mut frame = Frame {
        delay,
        dispose: DisposalMethod::Keep,
        transparent: earlier.map(|_| unchanged),
        left: small(columns.start),
        top: small(rows.start),
        width: small(columns.len()),
        height: small(rows.len()),
        buffer: Cow::Owned(buffer),
        ..Frame::default()
    };
    frame.make_lzw_pre_encoded();
    frame
}

/// From the first to the last place below `end` that is wanted; the first place alone if none is.
fn span(end: usize, is_wanted: impl Fn(usize) -> bool) -> std::ops::Range<usize> {
    let first = (0..end).find(|place| is_wanted(*place));
    let last = (0..end).rev().find(|place| is_wanted(*place));
    first.zip(last).map_or(0..1, |(first, last)| first..last + 1)
}

/// Sides and places, which are at most the greatest side.
#[expect(clippy::cast_possible_truncation, reason = "at most the greatest side")]
fn small(side: usize) -> u16 {
    side as u16
}
