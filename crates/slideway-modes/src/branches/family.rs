//! Block problems of a parameter.

use nalgebra::{DMatrix, DVector};

use crate::blocks::BlockProblem;
use crate::existence::OutputBound;
use crate::problem::{BySide, Side};

/// The block problem at each value of a parameter, or why there is none. All of them have the same contacts and
/// hinges.
pub type Family<'f> = dyn Fn(f64) -> Result<Instance, NoInstance> + 'f;

/// The problem at one value.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// The problem.
    pub problem: BlockProblem,
    /// Further unknowns, such as the couples of guided sliders.
    pub outputs: Outputs,
    /// Bounds of them, which a solution has to keep.
    pub bounds: Vec<OutputBound>,
    /// The senses of all motions with friction. Where they change the problem jumps, and every branch ends.
    pub senses: Vec<i8>,
}

impl Instance {
    /// The same with what the hinges add multiplied by a factor.
    pub(super) fn with_hinges_times(&self, factor: f64) -> Self {
        let contacts = self.problem.contacts();
        let scaled = |matrix: &DMatrix<f64>| {
            let mut matrix = matrix.clone();
            matrix.columns_range_mut(contacts..).scale_mut(factor);
            matrix
        };
        let of_sides = |response: &BySide<DMatrix<f64>>| BySide {
            positive: scaled(&response.positive),
            negative: scaled(&response.negative),
        };
        let centre = |side: Side| self.problem.response(side).centre().clone();
        let jumps = |side: Side| self.problem.jumps(side).centre().clone();
        let both = |part: &dyn Fn(Side) -> DMatrix<f64>| BySide {
            positive: part(Side::Positive),
            negative: part(Side::Negative),
        };
        let load = self.problem.load().centre().column(0).into_owned();
        let problem = BlockProblem::new(of_sides(&both(&centre)), both(&jumps), load);
        Self {
            problem: problem.unwrap_or_else(|_| self.problem.clone()),
            outputs: Outputs { response: of_sides(&self.outputs.response), ..self.outputs.clone() },
            ..self.clone()
        }
    }
}

/// Outputs `o + d_o^sigma + H_o^sigma w`, with one row each and columns as those of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// What the magnitudes of the blocks add.
    pub response: BySide<DMatrix<f64>>,
    /// What the jumps of the contacts add.
    pub jumps: BySide<DMatrix<f64>>,
    /// Without friction.
    pub load: DVector<f64>,
}

/// Why there is no problem at a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoInstance {
    /// A motion with friction has no sense: it reverses, or there is none.
    NoSense,
    /// Anything else.
    Other,
}

impl Outputs {
    /// No outputs, for a problem of so many contacts and blocks.
    pub fn none(contacts: usize, blocks: usize) -> Self {
        Self {
            response: BySide::same(DMatrix::zeros(0, blocks)),
            jumps: BySide::same(DMatrix::zeros(0, contacts)),
            load: DVector::zeros(0),
        }
    }
}
