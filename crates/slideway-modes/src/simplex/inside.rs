//! The inside of the face of all solutions of a linear program.

use super::{Basis, Bounds, FEASIBLE, LinearOutcome, LinearProgram, variable_bounds};

/// Directions that are not blocked are 1 in size, others 0.
const HALF: f64 = 0.5;

impl Basis {
    /// Which variables are away from their lower bound, and which from their upper bound, in most solutions
    /// of a program that was solved: in those inside the face of all solutions. `None` if that was not found.
    ///
    /// A variable away from its bounds at the vertex is so nearby, too. The others can leave their bounds
    /// along directions that keep the basic variables that are at a bound within it. The largest number of
    /// variables that can do so together are those of `max sum min(1, d)` over these directions `d`.
    pub(crate) fn inside(
        &self,
        program: &LinearProgram,
        bounds: &Bounds,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<[bool; 2]>> {
        let size = self.value.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        let near = |value: f64, bound: f64| (value - bound).abs() <= FEASIBLE * size;
        let mut inside = vec![[false; 2]; program.columns];
        // The rows of basic variables at a bound, with the sign of the step that leaves it.
        let mut blocked: Vec<(usize, f64)> = Vec::new();
        for (row, (&variable, &value)) in self.basic.iter().zip(&self.value).enumerate() {
            let (lower, upper) = variable_bounds(program, bounds, variable);
            let at = [near(value, lower), near(value, upper)];
            if let Some(inside) = inside.get_mut(variable) {
                *inside = at.map(|at| !at);
            }
            match at {
                [true, true] => blocked.push((row, 0.0)),
                [true, false] => blocked.push((row, 1.0)),
                [false, true] => blocked.push((row, -1.0)),
                [false, false] => {}
            }
        }
        let movable: Vec<usize> = (0..self.nonbasic.len()).filter(|&at| self.way[at] != 0.0).collect();
        for nonbasic in self.nonbasic.iter().filter(|nonbasic| nonbasic.variable < program.columns) {
            let (lower, upper) = variable_bounds(program, bounds, nonbasic.variable);
            let value = nonbasic.value(program, bounds);
            inside[nonbasic.variable] = [value != lower, value != upper];
        }
        let moved = self.free_directions(&blocked, &movable, proceed)?;
        for (&at, _) in movable.iter().zip(&moved).filter(|(_, moved)| **moved) {
            inside[self.nonbasic[at].variable] = [true; 2];
        }
        for (&(row, sign), &moved) in blocked.iter().zip(&moved[movable.len()..]) {
            if moved && sign != 0.0 {
                inside[self.basic[row]] = [true; 2];
            }
        }
        Some(inside)
    }

    /// Which of the given columns, and then which of the given rows, can move together: `d >= 0` of the
    /// columns and `r >= 0` of the rows with `r = -sign T d`, as large as possible up to 1.
    fn free_directions(
        &self,
        blocked: &[(usize, f64)],
        movable: &[usize],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<bool>> {
        if blocked.is_empty() {
            return Some(vec![true; movable.len()]);
        }
        let all = movable.len() + blocked.len();
        // With x = 1 - u + e, u and e from 0 on, u up to 1: the least sum of u.
        let column = |at: usize| -> Vec<f64> {
            let entry = |(row, &(blocked, sign)): (usize, &(usize, f64))| match movable.get(at) {
                Some(&column) if sign == 0.0 => self.row(blocked)[column] * self.way[column],
                Some(&column) => sign * self.row(blocked)[column] * self.way[column],
                None => f64::from(u8::from(sign != 0.0 && row == at - movable.len())),
            };
            blocked.iter().enumerate().map(entry).collect()
        };
        let plain: Vec<Vec<f64>> = (0..all).map(column).collect();
        let negative = plain.iter().map(|column| column.iter().map(|entry| -entry).collect());
        let columns: Vec<Vec<f64>> = negative.chain(plain.iter().cloned()).collect();
        let right = (0..blocked.len()).map(|row| -plain.iter().map(|column| column[row]).sum::<f64>());
        let cost = (0..2 * all).map(|at| f64::from(u8::from(at < all))).collect();
        let program = LinearProgram::new(&columns, right.collect(), cost);
        let upper = (0..2 * all).map(|at| if at < all { 1.0 } else { f64::INFINITY }).collect();
        let bounds = Bounds { lower: vec![0.0; 2 * all], upper };
        let mut basis = program.artificial_basis();
        match program.solve(&mut basis, &bounds, &mut 0, proceed) {
            LinearOutcome::Feasible(values) => {
                Some((0..all).map(|at| 1.0 - values[at] + values[all + at] > HALF).collect())
            }
            LinearOutcome::Infeasible(_) | LinearOutcome::Undecided => None,
        }
    }
}
