//! Outlines of the regions of a raster: polygons whose boundaries are shared by neighbours, straightened and rounded
//! alike.

use crate::plot::clip::simplified;
use crate::plot::svg::coordinate;
use std::fmt::Write;

/// Boundaries keep to this distance of the middles of the edges of pixels (pixels), which lie within half a
/// pixel of them.
const TOLERANCE: f64 = 0.9;
/// How far rounding takes a corner of a boundary (pixels), and the greatest turn of what takes its place (rad).
const ROUNDING: f64 = 0.5;
const TURN: f64 = 0.07;

/// A corner of a pixel: column and row, from the lower left.
type Corner = [usize; 2];

/// For each class the path data of all its outlines; `place` takes corners of pixels to the picture.
pub(super) fn regions(classes: &[usize], width: usize, place: &dyn Fn([f64; 2]) -> [f64; 2]) -> Vec<String> {
    let raster = Raster { classes, width, height: classes.len() / width.max(1) };
    let count = classes.iter().max().map_or(0, |greatest| greatest + 1);
    let mut paths = vec![String::new(); count];
    for (class, outline) in raster.outlines() {
        let mut places: Vec<_> = rounded(&raster.straightened(&outline))
            .into_iter()
            .map(|corner| place(corner).map(coordinate))
            .collect();
        // Arcs that meet half way between their corners.
        places.dedup();
        for (index, [x, y]) in places.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            let _ = write!(paths[class], "{letter}{x} {y}");
        }
        paths[class].push('Z');
    }
    paths
}

struct Raster<'c> {
    classes: &'c [usize],
    width: usize,
    height: usize,
}

/// Directions: right, up, left, down.
const STEPS: [[isize; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Raster<'_> {
    /// The class of a pixel; none outside.
    fn class(&self, i: isize, j: isize) -> Option<usize> {
        let (i, j) = (usize::try_from(i).ok()?, usize::try_from(j).ok()?);
        (i < self.width && j < self.height).then(|| self.classes[j * self.width + i])
    }

    /// The pixels on the left and on the right of a step from a corner.
    fn beside(&self, [i, j]: Corner, direction: usize) -> [Option<usize>; 2] {
        let (i, j) = (i.cast_signed(), j.cast_signed());
        let [left, right] = match direction {
            0 => [[i, j], [i, j - 1]],
            1 => [[i - 1, j], [i, j]],
            2 => [[i - 1, j - 1], [i - 1, j]],
            _ => [[i, j - 1], [i - 1, j - 1]],
        };
        [left, right].map(|[i, j]| self.class(i, j))
    }

    /// All closed outlines, with their class on the left.
    fn outlines(&self) -> Vec<(usize, Vec<Corner>)> {
        // Steps to the right along the lower edge of each region begin outlines; each step is taken once.
        let mut taken = vec![[false; 4]; (self.width + 1) * (self.height + 1)];
        let mut outlines = Vec::new();
        for j in 0..=self.height {
            for i in 0..self.width {
                for direction in [0, 2] {
                    let start = if direction == 0 { [i, j] } else { [i + 1, j] };
                    let [left, right] = self.beside(start, direction);
                    let Some(class) = left.filter(|_| left != right) else { continue };
                    if !taken[start[1] * (self.width + 1) + start[0]][direction] {
                        outlines.push((class, self.outline(class, start, direction, &mut taken)));
                    }
                }
            }
        }
        outlines
    }

    fn outline(&self, class: usize, start: Corner, first: usize, taken: &mut [[bool; 4]]) -> Vec<Corner> {
        let mut corners = Vec::new();
        let (mut at, mut direction) = (start, first);
        loop {
            let mark = &mut taken[at[1] * (self.width + 1) + at[0]][direction];
            if *mark {
                return corners;
            }
            *mark = true;
            corners.push(at);
            let [dx, dy] = STEPS[direction];
            at = [at[0].wrapping_add_signed(dx), at[1].wrapping_add_signed(dy)];
            // Left first: pixels that touch at a corner alone belong to different outlines.
            let turns = [(direction + 1) % 4, direction, (direction + 3) % 4];
            let goes_on = |&next: &usize| {
                let [left, right] = self.beside(at, next);
                left == Some(class) && right != Some(class)
            };
            let Some(next) = turns.into_iter().find(|next| goes_on(next)) else { return corners };
            direction = next;
        }
    }

    /// Whether outlines must pass exactly: corners of the map, and where three or more boundaries meet.
    fn is_fixed(&self, corner: Corner) -> bool {
        let [i, j] = corner;
        let on_edge = [i == 0, i == self.width, j == 0, j == self.height];
        if on_edge.iter().filter(|edge| **edge).count() > 1 {
            return true;
        }
        let boundaries = (0..4).filter(|&direction| {
            let [left, right] = self.beside(corner, direction);
            left != right
        });
        boundaries.count() > 2
    }

    /// An outline whose stretches between fixed corners are straightened, in the same way from either side; and whether each
    /// of its corners is fixed.
    fn straightened(&self, outline: &[Corner]) -> Vec<([f64; 2], bool)> {
        let fixed = outline.iter().position(|&corner| self.is_fixed(corner));
        // A ring is cut at its least corner and at the one opposite.
        let least = || (0..outline.len()).min_by_key(|&index| outline[index]).unwrap_or(0);
        let start = fixed.unwrap_or_else(least);
        let mut ring: Vec<Corner> = outline[start..].iter().chain(&outline[..=start]).copied().collect();
        let mut cuts: Vec<usize> = (0..ring.len()).filter(|&index| self.is_fixed(ring[index])).collect();
        if fixed.is_none() {
            let greatest = (0..ring.len()).max_by_key(|&index| ring[index]).unwrap_or(0);
            cuts = vec![0, greatest, ring.len() - 1];
        }
        let mut smooth = Vec::new();
        for pair in cuts.windows(2) {
            let stretch = &mut ring[pair[0]..=pair[1]];
            let backwards = stretch.iter().rev().lt(stretch.iter());
            if backwards {
                stretch.reverse();
            }
            let mut points = simplified(&middles(stretch), TOLERANCE);
            if backwards {
                points.reverse();
                stretch.reverse();
            }
            points.pop();
            let ends_here = |index: usize| index == 0 && fixed.is_some();
            smooth.extend(points.into_iter().enumerate().map(|(index, point)| (point, ends_here(index))));
        }
        smooth
    }
}

/// A closed outline whose corners are rounded, but for those that are fixed. A boundary of two regions is rounded alike from
/// either side: at each corner by itself.
fn rounded(corners: &[([f64; 2], bool)]) -> Vec<[f64; 2]> {
    let count = corners.len();
    let places = |index: usize| {
        let (corner, is_fixed) = corners[index];
        let around = [(index + count - 1) % count, (index + 1) % count].map(|other| corners[other].0);
        if is_fixed { vec![corner] } else { arc(corner, around) }
    };
    (0..count).flat_map(places).collect()
}

/// The arc in the place of a corner between two others: a parabola that touches both sides, at most half way to the others,
/// and comes as near to the corner as `ROUNDING`. Its middle is `(u + v) d / 4` from the corner, where `u` and `v` are the
/// directions of the sides and `d` is how far along them it begins and ends.
fn arc(corner: [f64; 2], around: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let sides = around.map(|[x, y]| [x - corner[0], y - corner[1]]);
    let lengths = sides.map(|[x, y]| x.hypot(y));
    let [u, v] = [0, 1].map(|side| sides[side].map(|part| part / lengths[side]));
    let sum = (u[0] + v[0]).hypot(u[1] + v[1]);
    let reach = (4.0 * ROUNDING / sum).min(0.5 * lengths[0].min(lengths[1]));
    if !(reach.is_finite() && sum > 0.0) {
        return vec![corner];
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a turn of at most pi")]
    let pieces = (2.0 * (0.5 * sum).min(1.0).asin() / TURN).ceil() as usize;
    let place = |piece: usize| {
        let part = piece as f64 / pieces as f64;
        let [before, after] = [reach * (1.0 - part).powi(2), reach * part.powi(2)];
        [0, 1].map(|axis| corner[axis] + before * u[axis] + after * v[axis])
    };
    (0..=pieces).map(place).collect()
}

/// The ends of a stretch of corners, and between them the middles of its steps.
fn middles(stretch: &[Corner]) -> Vec<[f64; 2]> {
    let place = |[i, j]: Corner| [i as f64, j as f64];
    let steps = stretch.windows(2).map(|pair| {
        let ([x1, y1], [x2, y2]) = (place(pair[0]), place(pair[1]));
        [f64::midpoint(x1, x2), f64::midpoint(y1, y2)]
    });
    let ends = [stretch.first(), stretch.last()].map(|end| end.map(|&corner| place(corner)));
    ends[0].into_iter().chain(steps).chain(ends[1]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(rows: &[&str]) -> Vec<String> {
        // Written from the top; rows count from the bottom.
        let classes: Vec<usize> =
            rows.iter().rev().flat_map(|row| row.bytes().map(|byte| usize::from(byte - b'0'))).collect();
        regions(&classes, rows[0].len(), &|corner| corner)
    }

    #[test]
    fn a_single_region_is_the_frame() {
        assert_eq!(paths(&["000", "000"]), ["M0 0L3 0L3 2L0 2Z"]);
    }

    #[test]
    fn two_halves_share_their_boundary() {
        assert_eq!(paths(&["0011", "0011"]), ["M0 0L2 0L2 2L0 2Z", "M2 0L4 0L4 2L2 2Z"]);
    }

    #[test]
    fn a_stair_becomes_a_straight_line() {
        let rows = ["00000001", "00000011", "00000111", "00001111", "00011111", "00111111", "01111111"];
        let found = paths(&rows);
        assert_eq!(found[1], "M1 0L8 0L8 7L7 7Z");
        assert!(found[0].contains("L7 7") && found[0].matches('L').count() <= 4, "{}", found[0]);
    }

    #[test]
    fn an_island_is_a_hole_of_what_lies_around_it() {
        let found = paths(&["0000000", "0000000", "0011100", "0011100", "0011100", "0000000", "0000000"]);
        assert_eq!(found[0].matches('Z').count(), 2);
        assert_eq!(found[1].matches('Z').count(), 1);
    }

    /// A disc of radius 20: a polygon of straightened boundaries would turn by 30 degrees at each of its corners.
    #[test]
    fn a_disc_has_no_kinks() {
        let radius: f64 = 20.0;
        let inside = |pixel: usize| {
            let middle = |index: usize| index as f64 + 0.5 - 24.0;
            usize::from(middle(pixel % 48).hypot(middle(pixel / 48)) < radius)
        };
        let classes: Vec<usize> = (0..48 * 48).map(inside).collect();
        let path = regions(&classes, 48, &|corner| corner).swap_remove(1);
        let places: Vec<[f64; 2]> = path
            .trim_matches(['M', 'Z'])
            .split('L')
            .map(|place| {
                let (x, y) = place.split_once(' ').expect("two coordinates");
                [x, y].map(|text| text.parse::<f64>().expect("a number") - 24.0)
            })
            .collect();
        // The middles of edges of pixels lie within half a diagonal of the circle.
        let bound = 0.5_f64.sqrt() + TOLERANCE + ROUNDING;
        assert!(places.iter().all(|[x, y]| (x.hypot(*y) - radius).abs() < bound), "{path}");
        for index in 0..places.len() {
            let [one, two, three] = [0, 1, 2].map(|step| places[(index + step) % places.len()]);
            let [[a, b], [c, d]] =
                [[one, two], [two, three]].map(|[from, to]| [to[0] - from[0], to[1] - from[1]]);
            let turn = (a * d - b * c).atan2(a * c + b * d).abs();
            assert!(turn < 2.0 * TURN, "{turn} at {two:?}");
        }
    }
}
