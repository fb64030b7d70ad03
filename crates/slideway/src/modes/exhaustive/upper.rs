//! The upper part of the tree: few nodes, double-double arithmetic.

use super::double_double::{DoubleDouble, UNIT};
use super::kernel::{Kernel, LEAF_LEVELS, PivotRow};
use super::{ModeProblem, PatternBits};
use crate::modes::Side;

/// The equations that remain when the contacts from `contacts` on have been decided.
///
/// A row holds the right-hand side and then `c_k^+, c_k^-` of contact 0, 1, ...
#[derive(Clone)]
pub(super) struct Node {
    contacts: usize,
    rows: Vec<Vec<DoubleDouble>>,
    /// Bound on the error of every entry.
    bound: f64,
    /// The pivot rows of the decided contacts, the one decided first at the front.
    pivots: Vec<PivotRow>,
    pattern: PatternBits,
    /// Whether some pivot on the way was too small to go on: nothing below can be excluded.
    irregular: bool,
}

impl Node {
    /// The whole problem. Rows are scaled by powers of two, which leaves their solutions as they are.
    pub(super) fn root(problem: &ModeProblem) -> Self {
        let contacts = problem.contacts();
        let [positive, negative] = Side::BOTH.map(|side| problem.columns(side));
        let row = |i: usize| {
            let scale = power_of_two_near(positive.row(i).amax().max(negative.row(i).amax())).recip();
            let columns = (0..contacts).flat_map(|k| [positive[(i, k)], negative[(i, k)]]);
            std::iter::once(problem.right_hand_side()[i])
                .chain(columns)
                .map(|entry| DoubleDouble::from(entry * scale))
                .collect()
        };
        Self {
            contacts,
            rows: (0..contacts).map(row).collect(),
            // Scaling may round numbers near the least ones.
            bound: f64::MIN_POSITIVE,
            pivots: Vec::new(),
            pattern: 0,
            irregular: false,
        }
    }

    /// All nodes that many levels below.
    pub(super) fn expand(self, levels: usize) -> Vec<Self> {
        let mut nodes = vec![self];
        for _ in 0..levels {
            nodes = nodes.iter().flat_map(|node| [node.decide(0), node.decide(1)]).collect();
        }
        nodes
    }

    /// The node below, with the last undecided contact on its positive (0) or negative (1) side.
    fn decide(&self, side: usize) -> Self {
        let contact = self.contacts - 1;
        let column = 1 + 2 * contact + side;
        let mut child = Self {
            contacts: contact,
            rows: Vec::with_capacity(contact),
            bound: self.bound,
            pivots: self.pivots.clone(),
            pattern: self.pattern | (side as u64) << contact,
            irregular: self.irregular,
        };
        if child.irregular {
            return child;
        }
        let at = (0..self.contacts)
            .max_by(|a, b| self.rows[*a][column].abs().total_cmp(&self.rows[*b][column].abs()))
            .unwrap_or_default();
        let pivot_row = &self.rows[at];
        let pivot = pivot_row[column];
        if pivot.abs() <= 2.0 * self.bound || pivot.abs() == 0.0 {
            child.irregular = true;
            return child;
        }
        for row in self.rows.iter().enumerate().filter(|(index, _)| *index != at).map(|(_, row)| row) {
            let factor = row[column] / pivot;
            child.rows.push((0..column - side).map(|j| row[j] - factor * pivot_row[j]).collect());
        }
        let largest = |row: &[DoubleDouble]| row.iter().map(|entry| entry.abs()).fold(0.0, f64::max);
        let node = self.rows.iter().map(|row| largest(row)).fold(0.0, f64::max);
        child.bound = bound_below(self.bound, pivot.abs(), largest(pivot_row), node, UNIT);
        child.pivots.push(PivotRow::new(
            pivot_row[..column - side].iter().map(|entry| entry.high).collect(),
            pivot.high,
            // What is lost by keeping the leading parts only.
            self.bound + f64::EPSILON * largest(pivot_row),
        ));
        child
    }

    /// Bound on the largest entry.
    fn largest(&self) -> f64 {
        self.rows.iter().flatten().map(|entry| entry.abs()).fold(0.0, f64::max)
    }
}

/// The patterns below a node that cannot be excluded.
pub(super) fn screen_subtree(node: &Node) -> Vec<PatternBits> {
    let mut kernel = Kernel::new(node.contacts + node.pivots.len());
    descend(node, &mut kernel);
    kernel.into_remaining()
}

fn descend(node: &Node, kernel: &mut Kernel) {
    if node.irregular {
        kernel.keep_all_below(node.contacts, node.pattern);
    } else if node.contacts > LEAF_LEVELS {
        for side in 0..2 {
            descend(&node.decide(side), kernel);
        }
    } else {
        let rows: Vec<Vec<f64>> =
            node.rows.iter().map(|row| row.iter().map(|entry| entry.high).collect()).collect();
        let bound = node.bound + f64::EPSILON * node.largest();
        kernel.screen(&rows, bound, &node.pivots, node.pattern);
    }
}

/// The bound of the module documentation.
pub(super) fn bound_below(bound: f64, pivot: f64, row: f64, node: f64, unit: f64) -> f64 {
    2.0 * bound + (row + bound) * (2.0 * bound / (pivot - bound) + unit) + 4.0 * unit * (node + row)
}

fn power_of_two_near(size: f64) -> f64 {
    if size == 0.0 { 1.0 } else { size.log2().round().clamp(-1000.0, 1000.0).exp2() }
}
