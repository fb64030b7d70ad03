//! Linear programs in a few unknowns of either sign, by the simplex method.
//!
//! ```text
//! minimise cost . x   subject to   slack_i(x) = a_i . x + c_i >= 0
//! ```
//!
//! from a point at which every slack is at least zero. A vertex is where as many slacks are zero as there are
//! unknowns; unknowns and the other slacks are kept as functions of these. So the table has as many columns
//! as unknowns, however many slacks there are.

use super::{Affine, Unsolved};

/// Slopes below this are rounding errors; coefficients are of order one.
const FLAT: f64 = 1e-11;
/// A slack may be missed by this part of its largest term (or of 1).
const MISSED: f64 = 1e-12;

/// Where the cost is least.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Optimum {
    /// At this point.
    At(Vec<f64>),
    /// It falls without end.
    Unbounded,
}

/// What a column stands for: an unknown that is still as it was, or a slack that is zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Unknown,
    Slack(usize),
}

/// Which of several slacks that become zero together leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Choice {
    /// The one that falls most (Harris, 1973): dividing by what falls little magnifies rounding.
    Steepest,
    /// The first one (Bland, 1977): no vertex comes twice.
    First,
}

/// Slacks, unknowns and the cost as functions of what the columns stand for.
struct Table<'a> {
    slacks: &'a [Affine],
    columns: Vec<Column>,
    /// What each slack is, and how it grows with each column; those that are columns are zero and grow with
    /// themselves.
    rows: Vec<Affine>,
    /// The unknowns likewise.
    point: Vec<Affine>,
    /// How the cost grows with each column.
    cost: Vec<f64>,
}

/// The point where `cost . x` is least, from a point at which no slack is negative.
///
/// # Errors
/// If rounding kept it from an end, or the end misses a slack.
pub(super) fn least(cost: &[f64], slacks: &[Affine], start: &[f64]) -> Result<Optimum, Unsolved> {
    [Choice::Steepest, Choice::First]
        .into_iter()
        .map(|choice| least_by(choice, (cost, slacks), start))
        .find(Result::is_ok)
        .unwrap_or(Err(Unsolved))
}

fn least_by(choice: Choice, (cost, slacks): (&[f64], &[Affine]), start: &[f64]) -> Result<Optimum, Unsolved> {
    let mut table = Table::new(cost, slacks, start);
    // By the rule of the first index no vertex comes twice; there is no telling how many there are, and they
    // are few.
    let most = 50 * (slacks.len() + cost.len());
    for _ in 0..most {
        let Some((column, direction)) = table.entering() else { return table.end().map(Optimum::At) };
        match table.leaving(column, direction, choice) {
            Some(row) => table.exchange(row, column),
            None => return Ok(Optimum::Unbounded),
        }
    }
    Err(Unsolved)
}

impl<'a> Table<'a> {
    fn new(cost: &[f64], slacks: &'a [Affine], start: &[f64]) -> Self {
        let unit = |index: usize| (0..start.len()).map(|at| f64::from(u8::from(at == index))).collect();
        let there =
            |slack: &Affine| Affine { coefficients: slack.coefficients.clone(), constant: slack.at(start) };
        Self {
            slacks,
            columns: vec![Column::Unknown; start.len()],
            rows: slacks.iter().map(there).collect(),
            point: (0..start.len()).map(|i| Affine { coefficients: unit(i), constant: start[i] }).collect(),
            cost: cost.to_vec(),
        }
    }

    /// The column along which the cost falls, and in which direction: unknowns first, then the first slack
    /// (Bland).
    fn entering(&self) -> Option<(usize, f64)> {
        let falls = |&at: &usize| match self.columns[at] {
            Column::Unknown => self.cost[at].abs() > FLAT,
            Column::Slack(_) => self.cost[at] < -FLAT,
        };
        let order = |at: &usize| match self.columns[*at] {
            Column::Unknown => None,
            Column::Slack(slack) => Some(slack),
        };
        let column = (0..self.columns.len()).filter(falls).min_by_key(order)?;
        Some((column, -self.cost[column].signum()))
    }

    /// The slack that becomes zero first along a column.
    fn leaving(&self, column: usize, direction: f64, choice: Choice) -> Option<usize> {
        let falls = |slack: &Affine| -direction * slack.coefficients[column];
        let falling = || self.rows.iter().enumerate().filter(|(_, slack)| falls(slack) > FLAT);
        let step = |slack: &Affine, allowed: f64| (slack.constant.max(0.0) + allowed) / falls(slack);
        match choice {
            Choice::First => falling().min_by(|one, other| step(one.1, 0.0).total_cmp(&step(other.1, 0.0))),
            Choice::Steepest => {
                let least = falling().map(|(_, slack)| step(slack, MISSED)).fold(f64::INFINITY, f64::min);
                falling()
                    .filter(|(_, slack)| step(slack, 0.0) <= least)
                    .max_by(|one, other| falls(one.1).total_cmp(&falls(other.1)))
            }
        }
        .map(|(row, _)| row)
    }

    /// Makes a slack a column, in place of what the column stood for.
    fn exchange(&mut self, row: usize, column: usize) {
        let slack = self.rows[row].clone();
        let pivot = slack.coefficients[column];
        // The column's own value as a function of the slack and the other columns.
        let mut entered = Affine {
            coefficients: slack.coefficients.iter().map(|slope| -slope / pivot).collect(),
            constant: -slack.constant / pivot,
        };
        entered.coefficients[column] = 1.0 / pivot;
        let substitute = |function: &mut Affine| {
            let slope = std::mem::take(&mut function.coefficients[column]);
            function.constant += slope * entered.constant;
            for (value, entered) in function.coefficients.iter_mut().zip(&entered.coefficients) {
                *value += slope * entered;
            }
        };
        self.rows.iter_mut().chain(&mut self.point).for_each(substitute);
        let slope = std::mem::take(&mut self.cost[column]);
        self.cost.iter_mut().zip(&entered.coefficients).for_each(|(cost, entered)| *cost += slope * entered);
        if let Column::Slack(before) = self.columns[column] {
            self.rows[before] = entered;
        }
        self.columns[column] = Column::Slack(row);
    }

    /// The point, corrected by what the slacks that should be zero there are.
    fn end(&self) -> Result<Vec<f64>, Unsolved> {
        let mut point: Vec<f64> = self.point.iter().map(|unknown| unknown.constant).collect();
        for _ in 0..2 {
            let rest = |column: &Column| match column {
                Column::Unknown => 0.0,
                Column::Slack(slack) => self.slacks[*slack].at(&point),
            };
            let rests: Vec<f64> = self.columns.iter().map(rest).collect();
            for (value, unknown) in point.iter_mut().zip(&self.point) {
                *value -= unknown.coefficients.iter().zip(&rests).map(|(a, rest)| a * rest).sum::<f64>();
            }
        }
        let holds = |slack: &Affine| slack.at(&point) >= -MISSED * slack.greatest_term(&point).max(1.0);
        if self.slacks.iter().all(holds) { Ok(point) } else { Err(Unsolved) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn affine(coefficients: &[f64], constant: f64) -> Affine {
        Affine { coefficients: coefficients.to_vec(), constant }
    }

    /// Beale's example (1955), on which the rule of the greatest fall goes round for ever; its least cost is
    /// -1/20, at x_1 = 1/25, x_3 = 1 (Chvatal, Linear Programming, 1983, chapter 3).
    #[test]
    fn it_does_not_go_round() {
        let cost = [-0.75, 150.0, -0.02, 6.0];
        let slacks = [
            affine(&[-0.25, 60.0, 0.04, -9.0], 0.0),
            affine(&[-0.5, 90.0, 0.02, -3.0], 0.0),
            affine(&[0.0, 0.0, -1.0, 0.0], 1.0),
            affine(&[1.0, 0.0, 0.0, 0.0], 0.0),
            affine(&[0.0, 1.0, 0.0, 0.0], 0.0),
            affine(&[0.0, 0.0, 1.0, 0.0], 0.0),
            affine(&[0.0, 0.0, 0.0, 1.0], 0.0),
        ];
        let Ok(Optimum::At(point)) = least(&cost, &slacks, &[0.0; 4]) else { panic!("it has an optimum") };
        for (value, expected) in point.iter().zip([0.04, 0.0, 1.0, 0.0]) {
            assert!((value - expected).abs() < 1e-15, "{point:?}");
        }
    }

    /// The cube that Klee and Minty (1972) squeezed, three unknowns: the greatest x_3 is 125, at (0, 0, 125).
    #[test]
    fn unknowns_of_either_sign_come_to_the_vertex_of_a_squeezed_cube() {
        let slacks = [
            affine(&[-1.0, 0.0, 0.0], 5.0),
            affine(&[-4.0, -1.0, 0.0], 25.0),
            affine(&[-8.0, -4.0, -1.0], 125.0),
            affine(&[1.0, 0.0, 0.0], 0.0),
            affine(&[0.0, 1.0, 0.0], 0.0),
            affine(&[0.0, 0.0, 1.0], 0.0),
        ];
        let found = least(&[-4.0, -2.0, -1.0], &slacks, &[1.0, 2.0, 3.0]);
        assert_eq!(found, Ok(Optimum::At(vec![0.0, 0.0, 125.0])));
    }

    #[test]
    fn without_an_end_there_is_no_point() {
        let slacks = [affine(&[1.0, -1.0], 0.0), affine(&[0.0, 1.0], 3.0)];
        assert_eq!(least(&[0.0, -1.0], &slacks, &[1.0, 0.0]), Ok(Optimum::Unbounded));
        assert_eq!(least(&[1.0, 0.0], &slacks, &[1.0, 0.0]), Ok(Optimum::At(vec![-3.0, -3.0])));
    }
}
