//! Places that labels keep clear of, in cells: only those nearby are looked at.

use super::scene::{Bounds, Point};

/// Side of a cell (drawing units): about the height of a label.
const CELL: f64 = 20.0;
/// At most so many cells in a row or column.
const MOST: f64 = 256.0;

/// A place with what it costs to cover it.
pub(super) type Obstacle = (Point, f64);

/// Obstacles by the cell in which they lie; those beyond the outermost cells belong to the nearest of them.
pub(super) struct Obstacles {
    corner: Point,
    /// Width and height of a cell.
    cell: Point,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<Obstacle>>,
}

impl Obstacles {
    pub(super) fn new(all: Vec<Obstacle>) -> Self {
        let bounds = Bounds::around(all.iter().map(|(place, _)| *place));
        let bounds = bounds.unwrap_or(Bounds { least: Point::zeros(), greatest: Point::zeros() });
        let count = bounds.size().map(|size| (size / CELL).ceil().clamp(1.0, MOST));
        let cell = bounds.size().component_div(&count).map(|size| size.max(CELL));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to MOST")]
        let [columns, rows] = [count.x as usize, count.y as usize];
        let cells = vec![Vec::new(); columns * rows];
        let mut obstacles = Self { corner: bounds.least, cell, columns, rows, cells };
        obstacles.extend(all);
        obstacles
    }

    pub(super) fn extend(&mut self, more: Vec<Obstacle>) {
        for obstacle in more {
            let [column, row] = self.cell_of(&obstacle.0);
            self.cells[row * self.columns + column].push(obstacle);
        }
    }

    /// Those within these bounds, edges included.
    pub(super) fn within(&self, bounds: &Bounds) -> impl Iterator<Item = &Obstacle> {
        let bounds = *bounds;
        let [[left, top], [right, bottom]] =
            [bounds.least, bounds.greatest].map(|corner| self.cell_of(&corner));
        let rows = (top..=bottom).map(move |row| row * self.columns);
        let cells = rows.flat_map(move |row| &self.cells[row + left..=row + right]);
        cells.flatten().filter(move |(place, _)| bounds.contains(place))
    }

    /// Column and row of a place.
    fn cell_of(&self, place: &Point) -> [usize; 2] {
        let index = (place - self.corner).component_div(&self.cell);
        // What is beyond the range of an integer becomes its end, and what is undefined zero.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let [column, row] = [index.x as usize, index.y as usize];
        [column.min(self.columns - 1), row.min(self.rows - 1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As if every obstacle were looked at, whatever the bounds, those beyond the outermost cells among them.
    #[test]
    fn nothing_nearby_is_missed() {
        let place = |index: u32| Point::new(f64::from(index * 37 % 211), f64::from(index * 53 % 97));
        let all: Vec<Obstacle> = (0..500).map(|index| (place(index), 1.0)).collect();
        let mut obstacles = Obstacles::new(all.clone());
        let far: Vec<Obstacle> = vec![(Point::new(-400.0, 50.0), 1.0), (Point::new(900.0, 900.0), 1.0)];
        obstacles.extend(far.clone());
        for index in 0..200 {
            let least = place(7 * index) - Point::new(30.0, 20.0);
            let bounds = Bounds { least, greatest: least + Point::new(f64::from(index), 25.0) };
            for bounds in [bounds, bounds.widened(500.0)] {
                let expected = all.iter().chain(&far).filter(|(place, _)| bounds.contains(place)).count();
                assert_eq!(obstacles.within(&bounds).count(), expected);
            }
        }
    }
}
