//! Block problems of a parameter.

use crate::blocks::{BlockProblem, times};
use crate::existence::OutputBound;
use crate::problem::{BlockNumbers, ModeProblemError};

/// The block problem at each value of a parameter, or why there is none. All of them have the same contacts and
/// hinges.
pub type Family<'f> = dyn Fn(f64) -> Result<Instance, NoInstance> + 'f;

/// The problem at one value.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// The problem.
    pub problem: BlockProblem,
    /// Further unknowns, such as the couples of guided sliders.
    pub outputs: BlockNumbers,
    /// Bounds of them, which a solution has to keep.
    pub bounds: Vec<OutputBound>,
    /// The senses of all motions with friction. Where they change the problem jumps, and every branch ends.
    pub senses: Vec<i8>,
}

impl Instance {
    /// A unit of the forces.
    pub(super) fn unit(&self) -> f64 {
        let load = self.problem.load().centre().amax();
        if load > 0.0 { load } else { 1.0 }
    }

    /// The same with what each block adds multiplied by its factor, where the numbers are exact.
    ///
    /// # Errors
    /// Entries that are not finite then.
    pub fn with_response_times(&self, factors: &[f64]) -> Result<Self, ModeProblemError> {
        let mut scaled = self.clone();
        scaled.problem = self.problem.with_response_times(factors)?;
        scaled.outputs.response = self.outputs.response.map(|given| times(given.clone(), factors));
        Ok(scaled)
    }
}

/// Why there is no problem at a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoInstance {
    /// A motion with friction has no sense: it reverses, or there is none.
    NoSense,
    /// Anything else.
    Other,
}
