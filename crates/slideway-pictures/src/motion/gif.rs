//! A moving picture as GIF.

use super::animation::{Animation, FrameOf};
use super::page::{still, still_size};
use super::palette::{Colour, Palette};
use crate::raster::{RasterFault, pixels};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;
use resvg::tiny_skia::Pixmap;
use slideway::progress::{Callback, Progress};
use std::borrow::Cow;
use std::collections::HashMap;
use thiserror::Error;

/// The greatest width and height (pixels).
const GREATEST_SIDE: f64 = 1200.0;
/// Pixels for each unit of the drawing: letters of 13 units are as large as those of a text.
const PIXELS: f64 = 1.5;
/// One of so many frames is asked for its colours.
const SAMPLED: usize = 8;
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
    #[error("each frame would last {frame_time:.0} s, but a GIF allows at most 655 s; use less slow motion")]
    Slow {
        /// Seconds between two frames.
        frame_time: f64,
    },
    /// A frame has no pixels.
    #[error(transparent)]
    Raster(#[from] RasterFault),
    /// The callback broke.
    #[error("it was interrupted before it was finished")]
    Ended,
    /// The frames cannot be packed.
    #[error("the frames cannot be packed as GIF: {0}")]
    Packing(#[from] gif::EncodingError),
}

impl Animation {
    /// Writes a GIF that runs in a loop: the frames of [`Animation::to_svg`] in their time, 1.5 pixels for
    /// each unit of the drawing and at most 1200 on each side. The callback receives the number of frames
    /// that are done, and ends the work when it breaks. The bytes do not depend on the number of threads.
    ///
    /// Delays are hundredths of a second; they are shared out so that all frames together take the time that
    /// the SVG takes, to half a hundredth.
    ///
    /// # Errors
    /// If there is no frame, or one would stand for longer than a GIF can say, 655.35 s, or the callback
    /// broke.
    pub fn to_gif(&self, callback: &mut Callback<'_>) -> Result<Vec<u8>, GifFault> {
        write(self, callback)
    }
}

/// The bytes of the file.
fn write(animation: &Animation, callback: &mut Callback<'_>) -> Result<Vec<u8>, GifFault> {
    if animation.frames.is_empty() {
        return Err(GifFault::NoFrame);
    }
    let delays = delays(animation)?;
    let scale = scale(animation);
    // Each thread draws one frame, and then it is asked whether to go on.
    let at_once = rayon::current_num_threads();
    let mut told = |done: usize| {
        let progress = Progress::of("frames", done as u64, animation.frames.len() as u64);
        if callback(&progress).is_break() { Err(GifFault::Ended) } else { Ok(()) }
    };
    let sampled = animation.frames.iter().step_by(SAMPLED).collect::<Vec<_>>();
    let mut counted = Vec::new();
    for frames in sampled.chunks(at_once) {
        told(0)?;
        let colours = frames.par_iter().map(|frame| Ok(counts(&drawn(animation, frame, scale)?)));
        counted.extend(colours.collect::<Result<Vec<_>, GifFault>>()?);
    }
    let palette = Palette::of(&flat_colours(animation), &together(counted));

    let size = drawn(animation, &animation.frames[0], scale)?;
    let size = [size.width() as usize, size.height() as usize];
    let [width, height] = size.map(small);
    let mut encoder = Encoder::new(Vec::new(), width, height, &palette.table())?;
    encoder.set_repeat(Repeat::Infinite)?;
    // The last frame of the chunk before, as indices of colours.
    let mut before: Option<Vec<u8>> = None;
    let mut done = 0;
    for (frames, delays) in animation.frames.chunks(at_once).zip(delays.chunks(at_once)) {
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
        told(done)?;
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
    still_size(animation).into_iter().fold(PIXELS, |scale, side| scale.min(GREATEST_SIDE / side))
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

/// A frame, packed: the least rectangle with all pixels that differ from the frame before; those in it that
/// do not are see-through.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{AnimationOptions, animation};
    use crate::theme::{DARK, LIGHT, Theme};
    use gif::{ColorOutput, DecodeOptions, Decoder};
    use slideway::gallery;
    use slideway::model::Model;
    use slideway::motion::{SimulateOptions, simulate};
    use std::collections::HashSet;
    use std::ops::ControlFlow;

    /// 0.25 s of the bar on its spring, shown in 0.75 s: 19 steps of at most 0.04 s.
    fn bar(theme: &Theme) -> Animation {
        let text = gallery::find("klepp-2002-spring").expect("in the gallery").text;
        let history = simulate(&Model::parse(text).expect("a model"), &SimulateOptions::new(0.25));
        animation(&history.expect("a motion"), &AnimationOptions { slow_motion: Some(3.0) }, theme)
    }

    /// The same motion with these frames alone.
    fn with_frames(animation: Animation, numbers: &[usize]) -> Animation {
        let frames = numbers.iter().map(|number| animation.frames[*number].clone()).collect();
        Animation { frames, ..animation }
    }

    fn gif_of(animation: &Animation) -> Vec<u8> {
        animation.to_gif(&mut |_| ControlFlow::Continue(())).expect("a GIF")
    }

    fn opened(bytes: &[u8]) -> Decoder<&[u8]> {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        options.read_info(bytes).expect("a GIF")
    }

    /// What a viewer shows: every frame over those before it.
    fn shown(bytes: &[u8]) -> Vec<Vec<Colour>> {
        let mut decoder = opened(bytes);
        let width = usize::from(decoder.width());
        let mut canvas: Vec<Option<Colour>> = vec![None; width * usize::from(decoder.height())];
        let mut pictures = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("a frame") {
            let rows = frame.buffer.chunks(4 * usize::from(frame.width));
            for (row, pixels) in (usize::from(frame.top)..).zip(rows) {
                for (column, pixel) in (usize::from(frame.left)..).zip(pixels.chunks(4)) {
                    if pixel[3] == 255 {
                        canvas[row * width + column] = Some([pixel[0], pixel[1], pixel[2]]);
                    }
                }
            }
            pictures.push(canvas.iter().map(|pixel| pixel.expect("the first frame is whole")).collect());
        }
        pictures
    }

    #[test]
    fn frames_stand_as_long_as_in_the_svg() {
        let animation = bar(&LIGHT);
        let bytes = gif_of(&animation);
        let mut decoder = opened(&bytes);
        assert_eq!(decoder.repeat(), Repeat::Infinite);
        let [width, height] = still_size(&animation).map(|side| format!("{}", (PIXELS * side).ceil()));
        assert_eq!([decoder.width().to_string(), decoder.height().to_string()], [width, height]);
        let mut delays = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("a frame") {
            delays.push(frame.delay);
        }
        assert_eq!(delays.len(), 20, "19 steps and the end");
        assert!(delays.iter().all(|delay| [3, 4].contains(delay)), "{delays:?}");
        // 20 * 0.75 s / 19 = 0.789 s
        assert_eq!(delays.iter().sum::<u16>(), 79);
    }

    /// Every pixel of every frame has the nearest of the colours that the GIF shows: the flat ones exactly,
    /// and but for some edges it is as it was drawn.
    #[test]
    fn frames_show_what_was_drawn() {
        let animation = bar(&LIGHT);
        let pictures = shown(&gif_of(&animation));
        let mut pairs: HashMap<(Colour, Colour), usize> = HashMap::new();
        for (frame, picture) in animation.frames.iter().zip(&pictures) {
            let drawn = drawn(&animation, frame, PIXELS).expect("pixels");
            assert!(drawn.pixels().iter().all(|pixel| pixel.alpha() == 255));
            colours(&drawn)
                .zip(picture)
                .for_each(|(wanted, got)| *pairs.entry((wanted, *got)).or_insert(0) += 1);
        }
        let all: HashSet<Colour> = pairs.keys().map(|(_, got)| *got).collect();
        assert!(all.len() <= 255, "{}", all.len());
        let distance = |one: Colour, other: Colour| -> i32 {
            (0..3).map(|channel| (i32::from(one[channel]) - i32::from(other[channel])).pow(2)).sum()
        };
        let flat = flat_colours(&animation);
        for (wanted, got) in pairs.keys() {
            let least = all.iter().map(|colour| distance(*wanted, *colour)).min();
            assert_eq!(Some(distance(*wanted, *got)), least, "{wanted:?}: {got:?}");
            assert!(wanted == got || !flat.contains(wanted), "{wanted:?}: {got:?}");
        }
        let differing: usize =
            pairs.iter().filter(|((wanted, got), _)| wanted != got).map(|(_, count)| count).sum();
        assert!(50 * differing < pairs.values().sum(), "{differing} of {}", pairs.values().sum::<usize>());
    }

    #[test]
    fn the_bar_moves_between_any_two_frames() {
        let animation = bar(&LIGHT);
        let pictures = shown(&gif_of(&animation));
        // Without the words below.
        let drawing = pictures[0].len() * 7 / 10;
        for pair in pictures.windows(2) {
            let moved =
                pair[0][..drawing].iter().zip(&pair[1][..drawing]).filter(|(one, other)| one != other);
            assert!(moved.count() > 100);
        }
    }

    #[test]
    fn bytes_do_not_depend_on_the_number_of_threads() {
        let animation = bar(&LIGHT);
        let with_threads = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| gif_of(&animation))
        };
        assert!(with_threads(1) == with_threads(3));
    }

    #[test]
    fn it_is_told_of_every_frame_of_a_thread_and_can_end_there() {
        let animation = bar(&LIGHT);
        let (mut told, mut left) = (Vec::new(), usize::MAX);
        let gif = |left: &mut usize, told: &mut Vec<u64>| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads");
            let mut tell = |progress: &Progress| {
                told.push(progress.done);
                *left -= 1;
                if *left > 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            pool.install(|| animation.to_gif(&mut tell))
        };
        assert!(gif(&mut left, &mut told).is_ok());
        // Frames 0, 8 and 16 are asked for their colours, two at once.
        assert_eq!(told, [0, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20]);
        for calls in [1, 2, 7] {
            (left, told) = (calls, Vec::new());
            assert!(matches!(gif(&mut left, &mut told), Err(GifFault::Ended)));
            assert_eq!(told.len(), calls);
        }
    }

    #[test]
    fn a_wide_drawing_is_scaled_down_and_has_its_background_to_the_edge() {
        let mut animation = with_frames(bar(&DARK), &[0]);
        let least = animation.bounds.least;
        animation.bounds.greatest = least + nalgebra::Vector2::new(1612.3, 500.7);
        let bytes = gif_of(&animation);
        let decoder = opened(&bytes);
        // 1613 x ceil(500.7 + 38 + 90) units: title; a line for the mode, one for the event, the key
        assert_eq!([decoder.width(), decoder.height()], [1200, 468]);
        let picture = &shown(&bytes)[0];
        let background = parsed(DARK.background).expect("a colour");
        let last_row = &picture[picture.len() - 1200..];
        let last_column = picture.chunks(1200).map(|row| &row[1199]);
        assert!(last_row.iter().chain(last_column).all(|colour| *colour == background));
    }

    #[test]
    fn a_frame_like_the_one_before_is_one_pixel_that_does_not_change() {
        let animation = with_frames(bar(&LIGHT), &[3, 3]);
        let bytes = gif_of(&animation);
        let mut decoder = opened(&bytes);
        decoder.read_next_frame().expect("a frame").expect("the first");
        let second = decoder.read_next_frame().expect("a frame").expect("the second");
        assert_eq!([second.width, second.height], [1, 1]);
        assert_eq!(second.buffer[3], 0, "see-through");
        let [one, other] = &shown(&bytes)[..] else { panic!("two frames") };
        assert_eq!(one, other);
    }

    #[test]
    fn what_a_gif_cannot_show_is_a_fault() {
        let animation = with_frames(bar(&LIGHT), &[0]);
        let slow = Animation { frame_time: 700.0, ..animation.clone() };
        assert!(
            slow.to_gif(&mut |_| ControlFlow::Continue(()))
                .expect_err("too slow")
                .to_string()
                .contains("last 700 s")
        );
        let endless = Animation { frame_time: f64::INFINITY, ..animation.clone() };
        assert!(matches!(endless.to_gif(&mut |_| ControlFlow::Continue(())), Err(GifFault::Slow { .. })));
        let none = Animation { frames: Vec::new(), ..animation };
        assert!(matches!(none.to_gif(&mut |_| ControlFlow::Continue(())), Err(GifFault::NoFrame)));
    }
}
