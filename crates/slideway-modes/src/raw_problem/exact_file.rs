//! Mode problems as JSON texts from which the same numbers are read again.

use nalgebra::DMatrix;

use crate::problem::{ModeProblem, Side};

/// A mode problem as JSON of type `modes`, with exactly its numbers; `None` if some column is a sum of two numbers
/// that is not a number of such a file.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::ModeProblem;
/// use slideway_modes::raw_problem::{RawProblem, exact_json};
///
/// let problem = ModeProblem::from_linear_complementarity(&dmatrix![0.1], dvector![-1.0 / 3.0])?;
/// let text = exact_json(&problem).expect("no sums");
/// assert_eq!(RawProblem::from_json(text.as_bytes())?, RawProblem::Modes(problem));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn exact_json(problem: &ModeProblem) -> Option<String> {
    if Side::BOTH.iter().any(|&side| problem.remainder(side).is_some()) {
        return None;
    }
    // As `{:?}`, the shortest digits from which the same number is read.
    let rows = |matrix: &DMatrix<f64>| {
        let row = |row: usize| format!("{:?}", matrix.row(row).iter().collect::<Vec<_>>());
        format!("[{}]", (0..matrix.nrows()).map(row).collect::<Vec<_>>().join(",\n    "))
    };
    let [positive, negative] = Side::BOTH.map(|side| rows(problem.columns(side)));
    let [jumps_positive, jumps_negative] = Side::BOTH.map(|side| rows(problem.jumps(side)));
    let right = problem.right_hand_side().as_slice();
    Some(format!(
        "{{\n  \"type\": \"modes\",\n  \"columns_positive\": {positive},\n  \"columns_negative\": {negative},\n  \
         \"jumps_positive\": {jumps_positive},\n  \"jumps_negative\": {jumps_negative},\n  \
         \"right_hand_side\": {right:?}\n}}\n"
    ))
}
