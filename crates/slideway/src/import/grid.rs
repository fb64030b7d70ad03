//! Which of many places are near one.

use nalgebra::Vector2;
use std::collections::{BTreeMap, BTreeSet};

/// Numbered places in the cells of a grid that are as wide as what counts as one place.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    corner: Vector2<f64>,
    near: f64,
    cells: BTreeMap<[i64; 2], BTreeSet<usize>>,
}

impl Grid {
    /// Without places; from the least corner of a drawing on.
    pub(super) fn new(corner: Vector2<f64>, near: f64) -> Self {
        Self { corner, near, cells: BTreeMap::new() }
    }

    /// How far apart two places are at most that count as one.
    pub(super) fn near(&self) -> f64 {
        self.near
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most some 1e6 cells along the drawing, or saturated"
    )]
    fn cell(&self, place: Vector2<f64>) -> [i64; 2] {
        let [x, y] = (place - self.corner).into();
        [x, y].map(|part: f64| (part / self.near.max(f64::MIN_POSITIVE)).floor() as i64)
    }

    pub(super) fn add(&mut self, at: Vector2<f64>, number: usize) {
        self.cells.entry(self.cell(at)).or_default().insert(number);
    }

    /// Takes away what was added.
    pub(super) fn remove(&mut self, at: Vector2<f64>, number: usize) {
        if let Some(numbers) = self.cells.get_mut(&self.cell(at)) {
            numbers.remove(&number);
        }
    }

    /// The least number of those whose place is near one.
    pub(super) fn first_near(
        &self,
        at: Vector2<f64>,
        place: impl Fn(usize) -> Vector2<f64>,
    ) -> Option<usize> {
        let [x, y] = self.cell(at);
        let beside = |part: i64| [part.saturating_sub(1), part, part.saturating_add(1)];
        let around = beside(x).into_iter().flat_map(|x| beside(y).map(|y| [x, y]));
        let numbers = around.filter_map(|cell| self.cells.get(&cell));
        let first = |numbers: &BTreeSet<usize>| {
            numbers.iter().copied().find(|number| (place(*number) - at).norm() <= self.near)
        };
        numbers.filter_map(first).min()
    }
}
