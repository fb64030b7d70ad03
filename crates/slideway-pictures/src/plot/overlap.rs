//! Curves that cannot be told apart: they are drawn as one line in the colours of all.

use super::clip::{self, simplified};
use super::figure::Curve;
use std::collections::HashMap;

/// Curves are compared piece by piece; the length of a piece (px).
const STEP: f64 = 6.0;
/// Curves that are close together for a shorter way merely cross (px).
const SHORT: f64 = 48.0;

/// A line that is drawn, for one curve or for several.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// Index of the curve whose places it has.
    pub(super) curve: usize,
    /// The branches that it stands for: the curve's own, and those of curves that cannot be told from it.
    pub(super) branches: Vec<usize>,
    /// Places (px).
    pub(super) path: Vec<[f64; 2]>,
}

/// All curves of one quantity of a branch, piece by piece.
struct Track {
    branch: usize,
    quantity: usize,
    pieces: Vec<Piece>,
}

struct Piece {
    ends: [[f64; 2]; 2],
    /// Index of its curve, and of the part of that.
    of: [usize; 2],
    /// The track that is drawn in its place.
    drawn_by: Option<usize>,
}

impl Piece {
    fn middle(&self) -> [f64; 2] {
        [0, 1].map(|axis| f64::midpoint(self.ends[0][axis], self.ends[1][axis]))
    }

    fn length(&self) -> f64 {
        (self.ends[1][0] - self.ends[0][0]).hypot(self.ends[1][1] - self.ends[0][1])
    }
}

/// The lines that show curves, given by their visible parts: where a curve of another branch, but of the same
/// quantity, comes within a distance of one before it for more than a crossing, that one stands for both.
pub(super) fn lines(curves: &[Curve], parts: &[Vec<Vec<[f64; 2]>>], distance: f64) -> Vec<Line> {
    let mut tracks = tracks(curves, parts);
    let mut drawn = Neighbours::default();
    for index in 0..tracks.len() {
        let track = &tracks[index];
        let mut leaders: Vec<Option<usize>> = (track.pieces.iter())
            .map(|piece| {
                let same = |other: usize| {
                    tracks[other].quantity == track.quantity && tracks[other].branch != track.branch
                };
                let near = drawn.near(&tracks, piece.middle(), distance).map(|(other, _)| other);
                near.filter(|other| same(*other)).min()
            })
            .collect();
        let lengths: Vec<f64> = track.pieces.iter().map(Piece::length).collect();
        without_crossings(&mut leaders, &lengths);
        for (piece, leader) in leaders.into_iter().enumerate() {
            tracks[index].pieces[piece].drawn_by = leader;
            if leader.is_none() {
                drawn.add(&tracks, index, piece);
            }
        }
    }
    let mut hidden = Neighbours::default();
    for (index, track) in tracks.iter().enumerate() {
        let pieces = track.pieces.iter().enumerate().filter(|(_, piece)| piece.drawn_by.is_some());
        pieces.for_each(|(piece, _)| hidden.add(&tracks, index, piece));
    }
    let of_track = |index: usize| lines_of(&tracks, index, (&hidden, distance), parts);
    (0..tracks.len()).flat_map(of_track).collect()
}

fn tracks(curves: &[Curve], parts: &[Vec<Vec<[f64; 2]>>]) -> Vec<Track> {
    let mut tracks: Vec<Track> = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        let is_same = |track: &&mut Track| (track.branch, track.quantity) == (curve.branch, curve.quantity);
        let track = match tracks.iter_mut().find(is_same) {
            Some(track) => track,
            None => {
                tracks.push_mut(Track { branch: curve.branch, quantity: curve.quantity, pieces: Vec::new() })
            }
        };
        for (number, part) in parts[index].iter().enumerate() {
            let pieces = part.windows(2).flat_map(|pair| cut([pair[0], pair[1]]));
            track.pieces.extend(pieces.map(|ends| Piece { ends, of: [index, number], drawn_by: None }));
        }
    }
    tracks
}

/// A segment in pieces of equal length.
fn cut([from, to]: [[f64; 2]; 2]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP).ceil().clamp(1.0, 1000.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 1000")]
    let count = steps as usize;
    let at = move |step: usize| {
        let share = step as f64 / steps;
        if step == count { to } else { [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])) }
    };
    (0..count).map(move |step| [at(step), at(step + 1)])
}

/// The lines of a track where it is drawn, each with the branches of those that are hidden there.
fn lines_of(
    tracks: &[Track],
    index: usize,
    (hidden, distance): (&Neighbours, f64),
    parts: &[Vec<Vec<[f64; 2]>>],
) -> Vec<Line> {
    let track = &tracks[index];
    let branches: Vec<Vec<usize>> = (track.pieces.iter())
        .map(|piece| {
            let near = hidden.near(tracks, piece.middle(), distance);
            let by_this = near.filter(|(_, piece)| piece.drawn_by == Some(index));
            let mut others: Vec<usize> = by_this.map(|(other, _)| tracks[other].branch).collect();
            others.sort_unstable();
            others.dedup();
            others
        })
        .collect();
    let mut lines: Vec<Line> = Vec::new();
    let mut before: Option<(usize, [usize; 2])> = None;
    // A line that leaves another one begins on it.
    let is_drawn = |number: usize, of: [usize; 2]| {
        let range = number.saturating_sub(1)..(number + 2).min(track.pieces.len());
        track.pieces[range].iter().any(|piece| piece.of == of && piece.drawn_by.is_none())
    };
    for (number, (piece, others)) in track.pieces.iter().zip(branches).enumerate() {
        if !is_drawn(number, piece.of) {
            continue;
        }
        let goes_on = before == number.checked_sub(1).map(|last| (last, piece.of));
        match lines.last_mut() {
            Some(line) if goes_on && line.branches[1..] == others => line.path.push(piece.ends[1]),
            _ => {
                let branches = [vec![track.branch], others].concat();
                lines.push(Line { curve: piece.of[0], branches, path: piece.ends.to_vec() });
            }
        }
        before = Some((number, piece.of));
    }
    // A part in one piece keeps its own places; else the cuts within segments go.
    for line in &mut lines {
        let is_whole =
            |part: &&Vec<[f64; 2]>| part.first() == line.path.first() && part.last() == line.path.last();
        line.path = match parts[line.curve].iter().find(is_whole) {
            Some(part) => part.clone(),
            None => simplified(&line.path, 1e-3),
        };
    }
    lines
}

/// Runs of equal values, and their lengths.
fn runs<T: PartialEq>(values: &[T], lengths: &[f64]) -> Vec<(std::ops::Range<usize>, f64)> {
    let mut start = 0;
    let run = |values: &[T]| {
        let range = start..start + values.len();
        start = range.end;
        (range.clone(), lengths[range].iter().sum())
    };
    values.chunk_by(|one, other| one == other).map(run).collect()
}

/// Lets curves stay where others merely cross them; a whole curve may be short.
fn without_crossings(leaders: &mut [Option<usize>], lengths: &[f64]) {
    let whole: f64 = lengths.iter().sum();
    for (run, length) in runs(leaders, lengths) {
        if length < SHORT.min(whole) {
            leaders[run].fill(None);
        }
    }
}

/// Pieces by the cell of the plane in which their middle lies.
#[derive(Default)]
struct Neighbours {
    cells: HashMap<[i64; 2], Vec<(usize, usize)>>,
}

impl Neighbours {
    #[expect(clippy::cast_possible_truncation, reason = "places of a picture")]
    fn cell(place: [f64; 2]) -> [i64; 2] {
        place.map(|coordinate| (coordinate / STEP).floor() as i64)
    }

    fn add(&mut self, tracks: &[Track], track: usize, piece: usize) {
        let cell = Self::cell(tracks[track].pieces[piece].middle());
        self.cells.entry(cell).or_default().push((track, piece));
    }

    /// The pieces within a distance of a place, which is less than half of a cell, and their tracks.
    fn near<'t>(
        &self,
        tracks: &'t [Track],
        place: [f64; 2],
        distance: f64,
    ) -> impl Iterator<Item = (usize, &'t Piece)> {
        let [i, j] = Self::cell(place);
        let cells = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [i + dx, j + dy]));
        let found = cells.filter_map(|cell| self.cells.get(&cell)).flatten();
        let pieces = found.map(move |(track, piece)| (*track, &tracks[*track].pieces[*piece]));
        pieces
            .filter(move |(_, Piece { ends: [from, to], .. })| clip::distance(place, *from, *to) <= distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(branch: usize) -> Curve {
        Curve { branch, quantity: 0, points: Vec::new(), ends: Default::default() }
    }

    /// A line at y = 10 from 0 to 120, and another at this height from `from` to `to`.
    fn beside(y: f64, from: f64, to: f64) -> Vec<Line> {
        let parts = [vec![vec![[0.0, 10.0], [120.0, 10.0]]], vec![vec![[from, y], [to, y]]]];
        lines(&[curve(0), curve(1)], &parts, 2.0)
    }

    #[test]
    fn what_runs_along_is_one_line_of_both() {
        let [line] = &beside(11.0, 0.0, 120.0)[..] else { panic!("one line") };
        assert_eq!((line.curve, &*line.branches, line.path.len()), (0, &[0, 1][..], 2));
        // Apart they are two.
        let apart = beside(13.0, 0.0, 120.0);
        assert_eq!(apart.iter().map(|line| &*line.branches).collect::<Vec<_>>(), [&[0][..], &[1]]);
        // Where only one is, it has its own colour alone.
        let [alone, both] = &beside(10.0, 60.0, 120.0)[..] else { panic!("two lines") };
        assert_eq!((&*alone.branches, &*both.branches), (&[0][..], &[0, 1][..]));
        assert_eq!((alone.path.first(), both.path.last()), (Some(&[0.0, 10.0]), Some(&[120.0, 10.0])));
        assert_eq!(alone.path.last(), both.path.first());
        assert!((alone.path[1][0] - 60.0).abs() < 2.0 * STEP, "{alone:?}");
    }

    #[test]
    fn crossings_and_other_quantities_stay_apart() {
        let level = vec![vec![[0.0, 10.0], [120.0, 10.0]]];
        let steep = vec![vec![[50.0, -40.0], [50.0, 60.0]]];
        let crossing = lines(&[curve(0), curve(1)], &[level.clone(), steep], 2.0);
        assert!(crossing.iter().all(|line| line.branches.len() == 1), "{crossing:?}");
        assert_eq!(crossing.len(), 2);
        let other = Curve { quantity: 1, ..curve(1) };
        assert_eq!(lines(&[curve(0), other], &[level.clone(), level], 2.0).len(), 2);
    }
}
