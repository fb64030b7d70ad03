//! Classes of pixels, solved only where neighbours differ.

use crate::progress::{Callback, Progress};
use rayon::prelude::*;

/// Points that are solved between two calls of the callback.
const AT_ONCE: usize = 512;
/// Points that are solved one after another.
const RUN: usize = 32;
/// Points or cells that are looked through between two calls of the callback.
const UNTOLD: usize = 1024;
/// Points are solved in rows of so many pixels' height, from left to right, so that successive ones are
/// neighbours.
const BAND: usize = 16;

/// A plane of pixels, counted from the lower left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Grid {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Pixels between probes.
    pub(super) probe: usize,
}

/// The class of every pixel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Raster<K> {
    pub(super) grid: Grid,
    /// The classes that were found, in the order in which they were.
    pub(super) classes: Vec<K>,
    /// Index of the class of every pixel, row by row from the bottom.
    pub(super) pixels: Vec<u32>,
    /// Points that were solved.
    pub(super) solved: usize,
}

/// A rectangle between pixels whose classes are known: left, right, bottom, top, all four included.
type Cell = [usize; 4];

/// No class yet.
const OPEN: u32 = u32::MAX;

/// Function that returns the classes of points that lie near one another.
type Classes<'c, K> = &'c (dyn Fn(&[[usize; 2]]) -> Vec<K> + Sync);

struct Work<'w, K> {
    grid: Grid,
    classes_of: Classes<'w, K>,
    progress: &'w mut Callback<'w>,
    classes: Vec<K>,
    pixels: Vec<u32>,
    /// Whether the class of a pixel is its own, not that of what lies around it.
    is_solved: Vec<bool>,
    solved: usize,
}

impl<K: PartialEq + Send> Raster<K> {
    /// The classes of all pixels; none if the callback broke. The same for any number of threads.
    pub(super) fn new(grid: Grid, classes_of: Classes<'_, K>, progress: &mut Callback<'_>) -> Option<Self> {
        let pixels = grid.width * grid.height;
        let mut work = Work {
            grid,
            classes_of,
            progress,
            classes: Vec::new(),
            pixels: vec![OPEN; pixels],
            is_solved: vec![false; pixels],
            solved: 0,
        };
        work.divide()?;
        work.follow()?;
        Some(Self { grid, classes: work.classes, pixels: work.pixels, solved: work.solved })
    }
}

impl<K: PartialEq + Send> Work<'_, K> {
    fn index(&self, [i, j]: [usize; 2]) -> usize {
        j * self.grid.width + i
    }

    /// Tells how many points are solved; none if the work is to end.
    fn tell(&mut self) -> Option<()> {
        // How many points a boundary takes is not known before.
        let progress = Progress { counted: "points", done: self.solved as u64, fraction: None, found: None };
        (self.progress)(&progress).is_continue().then_some(())
    }

    /// Solves the points among these that are not solved yet, band by band.
    fn solve(&mut self, points: impl Iterator<Item = [usize; 2]>) -> Option<()> {
        let mut bands = vec![Vec::new(); self.grid.height.div_ceil(BAND)];
        for (number, point) in points.enumerate() {
            bands[point[1] / BAND].push(point);
            if number % UNTOLD == 0 {
                self.tell()?;
            }
        }
        bands.into_iter().try_for_each(|points| self.solve_band(points))
    }

    /// Solves the points of a band that are not solved yet, in parallel, and enters them in their order.
    fn solve_band(&mut self, mut points: Vec<[usize; 2]>) -> Option<()> {
        points.sort_unstable();
        points.dedup();
        points.retain(|&point| !self.is_solved[self.index(point)]);
        for chunk in points.chunks(AT_ONCE) {
            let found: Vec<Vec<K>> = chunk.par_chunks(RUN).map(self.classes_of).collect();
            for (&point, class) in chunk.iter().zip(found.into_iter().flatten()) {
                let known = self.classes.iter().position(|other| *other == class);
                let number = known.unwrap_or_else(|| {
                    self.classes.push(class);
                    self.classes.len() - 1
                });
                let index = self.index(point);
                self.pixels[index] = u32::try_from(number).unwrap_or(OPEN);
                self.is_solved[index] = true;
            }
            self.solved += chunk.len();
            self.tell()?;
        }
        Some(())
    }

    /// Solves the probes, fills between those that agree, and divides the rest down to pixels.
    fn divide(&mut self) -> Option<()> {
        let stops = |size: usize| {
            let mut stops: Vec<usize> = (0..size).step_by(self.grid.probe).collect();
            if stops.last() != Some(&(size - 1)) {
                stops.push(size - 1);
            }
            stops
        };
        let (columns, rows) = (stops(self.grid.width), stops(self.grid.height));
        let mut cells: Vec<Cell> = Vec::new();
        for pair in spans(&rows) {
            cells.extend(spans(&columns).into_iter().map(|[left, right]| [left, right, pair[0], pair[1]]));
            self.tell()?;
        }
        let probes = rows.iter().flat_map(|&j| columns.iter().map(move |&i| [i, j]));
        self.solve(probes.chain(cells.iter().map(middle)))?;
        while !cells.is_empty() {
            let mut mixed = Vec::new();
            for (number, cell) in cells.iter().enumerate() {
                if self.is_alike(cell) {
                    self.fill(cell);
                } else {
                    mixed.extend(parts(cell));
                }
                if number % UNTOLD == 0 {
                    self.tell()?;
                }
            }
            cells = mixed;
            self.solve(cells.iter().flat_map(corners))?;
        }
        Some(())
    }

    /// Whether the corners of a cell agree, and its middle if it is solved.
    fn is_alike(&self, cell: &Cell) -> bool {
        let first = self.pixels[self.index([cell[0], cell[2]])];
        let middle = self.index(middle(cell));
        corners(cell).iter().all(|&corner| self.pixels[self.index(corner)] == first)
            && (!self.is_solved[middle] || self.pixels[middle] == first)
    }

    fn fill(&mut self, &[left, right, bottom, top]: &Cell) {
        let class = self.pixels[self.index([left, bottom])];
        for j in bottom..=top {
            for i in left..=right {
                let index = self.index([i, j]);
                if !self.is_solved[index] {
                    self.pixels[index] = class;
                }
            }
        }
    }

    /// Solves filled pixels beside solved ones of another class, until there are none: boundaries are
    /// followed into cells whose corners agree.
    fn follow(&mut self) -> Option<()> {
        let mut suspects: Vec<[usize; 2]> = Vec::new();
        for j in 0..self.grid.height {
            suspects.extend((0..self.grid.width).map(|i| [i, j]).filter(|&point| self.is_suspect(point)));
            self.tell()?;
        }
        while !suspects.is_empty() {
            self.solve(suspects.iter().copied())?;
            let grid = self.grid;
            suspects = suspects.iter().flat_map(|&point| neighbours(grid, point)).collect();
            suspects.sort_unstable();
            suspects.dedup();
            suspects.retain(|&point| self.is_suspect(point));
        }
        Some(())
    }

    fn is_suspect(&self, point: [usize; 2]) -> bool {
        let index = self.index(point);
        !self.is_solved[index]
            && neighbours(self.grid, point).any(|next| {
                let next = self.index(next);
                self.is_solved[next] && self.pixels[next] != self.pixels[index]
            })
    }
}

/// Neighbouring stops; a single one twice.
fn spans(stops: &[usize]) -> Vec<[usize; 2]> {
    if let [only] = stops {
        return vec![[*only; 2]];
    }
    stops.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

fn corners(&[left, right, bottom, top]: &Cell) -> [[usize; 2]; 4] {
    [[left, bottom], [right, bottom], [left, top], [right, top]]
}

fn middle(&[left, right, bottom, top]: &Cell) -> [usize; 2] {
    [left.midpoint(right), bottom.midpoint(top)]
}

/// The cell in up to four parts; none of a cell without pixels between its corners.
fn parts(&[left, right, bottom, top]: &Cell) -> Vec<Cell> {
    let halves = |from: usize, to: usize| {
        if to - from > 1 {
            vec![[from, from.midpoint(to)], [from.midpoint(to), to]]
        } else {
            vec![[from, to]]
        }
    };
    let (columns, rows) = (halves(left, right), halves(bottom, top));
    if columns.len() == 1 && rows.len() == 1 {
        return Vec::new();
    }
    rows.iter().flat_map(|row| columns.iter().map(|column| [column[0], column[1], row[0], row[1]])).collect()
}

/// The up to eight pixels around one: narrow regions may go on across a corner.
fn neighbours(grid: Grid, [i, j]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    let around = |at: usize, size: usize| at.saturating_sub(1)..(at + 2).min(size);
    let rows = around(j, grid.height);
    rows.flat_map(move |row| around(i, grid.width).map(move |column| [column, row]))
        .filter(move |&other| other != [i, j])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    fn raster(
        width: usize,
        height: usize,
        probe: usize,
        class: impl Fn([usize; 2]) -> u8 + Sync,
    ) -> Raster<u8> {
        let grid = Grid { width, height, probe };
        let classes = |points: &[[usize; 2]]| points.iter().map(|&point| class(point)).collect();
        Raster::new(grid, &classes, &mut |_| ControlFlow::Continue(())).expect("nothing breaks")
    }

    fn is_exact(raster: &Raster<u8>, class: impl Fn([usize; 2]) -> u8) -> bool {
        let Grid { width, height, .. } = raster.grid;
        let pixels = (0..height).flat_map(|j| (0..width).map(move |i| [i, j]));
        pixels.zip(&raster.pixels).all(|(point, &found)| raster.classes[found as usize] == class(point))
    }

    #[test]
    fn boundaries_are_exact_to_the_pixel() {
        // A disc, a line, and a wedge thinner than a cell that starts in the disc.
        let class = |[i, j]: [usize; 2]| {
            let (x, y) = (i as f64, j as f64);
            let wedge = x > 130.0 && (y - 60.0).abs() < 0.05 * (200.0 - x);
            u8::from((x - 100.0).hypot(y - 60.0) < 35.0)
                + 2 * u8::from(3.0 * y > x + 200.0)
                + 4 * u8::from(wedge)
        };
        for (width, height) in [(200, 150), (201, 97), (1, 150), (200, 1), (1, 1), (7, 5)] {
            let found = raster(width, height, 8, class);
            assert!(is_exact(&found, class), "{width} x {height}");
        }
        let found = raster(200, 150, 8, class);
        assert!(found.solved < 200 * 150 / 4, "{} points", found.solved);
    }

    #[test]
    fn what_lies_between_probes_is_missed_unless_every_pixel_is_probed() {
        let dot = |point: [usize; 2]| u8::from(point == [2, 1]);
        assert!(!is_exact(&raster(40, 40, 8, dot), dot));
        assert!(is_exact(&raster(40, 40, 1, dot), dot));
    }

    /// Indices of pixels of one class that touch at a side or a corner, for all such regions.
    fn regions(grid: Grid, class: impl Fn([usize; 2]) -> u8) -> Vec<Vec<[usize; 2]>> {
        let mut is_seen = vec![false; grid.width * grid.height];
        let mut regions = Vec::new();
        for start in (0..grid.height).flat_map(|j| (0..grid.width).map(move |i| [i, j])) {
            let mut region = Vec::new();
            let mut open = vec![start];
            while let Some(point) = open.pop() {
                let index = point[1] * grid.width + point[0];
                if class(point) == class(start) && !is_seen[index] {
                    is_seen[index] = true;
                    region.push(point);
                    open.extend(neighbours(grid, point));
                }
            }
            regions.push(region);
        }
        regions
    }

    /// What the documentation promises: a region that a probe meets is complete, also one that is narrower
    /// than a pixel.
    #[test]
    fn regions_that_a_probe_meets_are_exact() {
        let mut missed = 0;
        for turn in 0_u8..40 {
            let (sin, cos) = (0.1 + 0.16 * f64::from(turn)).sin_cos();
            // Rings and a line, from a third of a pixel to three pixels wide.
            let width = 0.15 + 0.035 * f64::from(turn);
            let class = |[i, j]: [usize; 2]| {
                let (x, y) = (i as f64 - 45.0 - 9.0 * cos, j as f64 - 35.0 - 7.0 * sin);
                let is_on_ring = [6.0, 19.0, 28.5].iter().any(|radius| (x.hypot(y) - radius).abs() < width);
                u8::from(is_on_ring) + 2 * u8::from((x * sin - y * cos).abs() < width)
            };
            let grid = Grid { width: 90, height: 70, probe: 8 };
            let found = raster(grid.width, grid.height, grid.probe, class);
            for region in regions(grid, class) {
                let is_right =
                    |&[i, j]: &[usize; 2]| found.classes[found.pixels[j * 90 + i] as usize] == class([i, j]);
                let has_probe = region.iter().any(|[i, j]| i % grid.probe == 0 && j % grid.probe == 0);
                let wrong = region.iter().filter(|point| !is_right(point)).count();
                assert!(wrong == 0 || !has_probe, "turn {turn}: {wrong} pixels of a region with a probe");
                missed += wrong;
            }
        }
        assert!(missed > 0, "no region is too narrow for the probes");
    }

    #[test]
    fn the_callback_ends_the_work() {
        let grid = Grid { width: 100, height: 100, probe: 1 };
        let classes = |points: &[[usize; 2]]| points.iter().map(|[i, _]| i % 2).collect();
        let ended = Raster::new(grid, &classes, &mut |_| ControlFlow::Break(()));
        assert!(ended.is_none());
    }
}
