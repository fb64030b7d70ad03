//! The corners of a pointed polyhedron, and the directions in which it has no end.

use super::super::distinct::{SAME_STATE, agree};
use nalgebra::{DMatrix, DVector};

/// All `t` with `row . (1, t) >= 0` for all rows.
pub(in crate::solve) struct Polyhedron {
    /// Of greatest entry one.
    rows: Vec<DVector<f64>>,
    dimension: usize,
}

/// What a polyhedron is made of: mixtures of the corners, and any amount of the growths beside them.
#[derive(Default)]
pub(in crate::solve) struct Extremes {
    pub(in crate::solve) corners: Vec<DVector<f64>>,
    pub(in crate::solve) growths: Vec<DVector<f64>>,
}

impl Polyhedron {
    pub(in crate::solve) fn new(dimension: usize, rows: impl Iterator<Item = DVector<f64>>) -> Self {
        let first = DVector::from_fn(dimension + 1, |entry, _| f64::from(u8::from(entry == 0)));
        let rows = rows.chain(std::iter::once(first)).filter(|row| row.amax() > 0.0);
        Self { rows: rows.map(|row| &row / row.amax()).collect(), dimension }
    }

    /// Whether a point, or a direction with a first entry of zero, is in it within rounding.
    pub(in crate::solve) fn contains(&self, point: &DVector<f64>) -> bool {
        self.rows.iter().all(|row| row.dot(point) >= -SAME_STATE * point.amax())
    }

    /// The extreme rays of `{x : row . x >= 0}`: along each, as many independent rows vanish as `t` has components.
    pub(in crate::solve) fn extremes(&self) -> Extremes {
        let mut rays: Vec<DVector<f64>> = Vec::new();
        for chosen in choices(self.rows.len(), self.dimension) {
            let chosen: Vec<_> = chosen.iter().map(|&row| self.rows[row].transpose()).collect();
            let along = common_zero(&DMatrix::from_rows(&chosen));
            if along.amax() <= SAME_STATE {
                continue;
            }
            let along = &along / along.amax();
            let within = [along.clone(), -along].into_iter().filter(|ray| self.contains(ray));
            for ray in within {
                if !rays.iter().any(|other| agree(other.as_slice(), ray.as_slice())) {
                    rays.push(ray);
                }
            }
        }
        let mut extremes = Extremes::default();
        for ray in rays {
            let rest = ray.rows(1, self.dimension).into_owned();
            if ray[0] > SAME_STATE {
                extremes.corners.push(rest / ray[0]);
            } else {
                extremes.growths.push(&rest / rest.amax());
            }
        }
        extremes
    }
}

/// The vector that is orthogonal to all rows, one fewer than it has entries; zero if the rows are dependent.
fn common_zero(rows: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_fn(rows.ncols(), |column, _| {
        let sign = if column % 2 == 0 { 1.0 } else { -1.0 };
        sign * rows.clone().remove_column(column).determinant()
    })
}

/// All choices of some of so many indices.
fn choices(count: usize, chosen: usize) -> Vec<Vec<usize>> {
    if chosen == 0 {
        return vec![Vec::new()];
    }
    let with_last = |last: usize| {
        choices(last, chosen - 1).into_iter().map(move |mut choice| {
            choice.push(last);
            choice
        })
    };
    (chosen - 1..count).flat_map(with_last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    /// `0 <= t <= 2`; `t >= 1`; `t <= -1` and `t >= 1`; `t = 3`.
    #[test]
    fn intervals_have_their_ends() {
        let of = |rows: &[[f64; 2]]| {
            let rows = rows.iter().map(|row| dvector![row[0], row[1]]);
            let Extremes { corners, growths } = Polyhedron::new(1, rows).extremes();
            let mut corners: Vec<f64> = corners.iter().map(|corner| corner[0]).collect();
            corners.sort_by(f64::total_cmp);
            (corners, growths.iter().map(|growth| growth[0]).collect::<Vec<_>>())
        };
        assert_eq!(of(&[[0.0, 1.0], [2.0, -1.0]]), (vec![0.0, 2.0], vec![]));
        assert_eq!(of(&[[-1.0, 1.0]]), (vec![1.0], vec![1.0]));
        assert_eq!(of(&[[-1.0, 1.0], [-1.0, -1.0]]), (vec![], vec![]));
        assert_eq!(of(&[[-3.0, 1.0], [3.0, -1.0]]), (vec![3.0], vec![]));
    }

    /// `|s| <= t`, `t <= 1`: a triangle; without the last one it has no end along (1, 1) and (-1, 1).
    #[test]
    fn a_triangle_has_three_corners() {
        let cone = [dvector![0.0, 1.0, 1.0], dvector![0.0, -1.0, 1.0]];
        let triangle = cone.iter().cloned().chain([dvector![1.0, 0.0, -1.0]]);
        let Extremes { corners, growths } = Polyhedron::new(2, triangle).extremes();
        assert_eq!((corners.len(), growths.len()), (3, 0));
        for corner in [dvector![0.0, 0.0], dvector![1.0, 1.0], dvector![-1.0, 1.0]] {
            assert!(corners.iter().any(|other| (other - &corner).amax() < 1e-12), "{corner}");
        }
        let Extremes { corners, growths } = Polyhedron::new(2, cone.into_iter()).extremes();
        assert_eq!((corners.len(), growths.len()), (1, 2));
    }
}
