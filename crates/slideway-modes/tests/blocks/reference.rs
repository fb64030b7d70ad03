//! Problems whose solutions were computed by other means.

use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use slideway_modes::blocks::BlockSolution;
use slideway_modes::certificate::Sign;

use crate::support::{Plain, assert_proven};

#[derive(Deserialize)]
struct Reference {
    problem: Vec<Problem>,
}

#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Problem {
    #[serde(rename = "name")]
    name: String,
    #[serde(rename = "s")]
    contacts: usize,
    #[serde(rename = "b")]
    load: Vec<f64>,
    #[serde(rename = "H")]
    response: Vec<Vec<f64>>,
    #[serde(rename = "solutions")]
    solutions: Vec<Solution>,
}

#[derive(Deserialize)]
struct Solution {
    w: Vec<f64>,
    det: f64,
}

#[test]
fn all_solutions_are_those_of_resultants() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/block-problems.toml");
    let reference: Reference = toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for problem in reference.problem {
        let (rows, columns) = (problem.load.len(), problem.response[0].len());
        let response = DMatrix::from_fn(rows, columns, |row, column| problem.response[row][column]);
        let plain = Plain::same(problem.contacts, response, DVector::from_vec(problem.load));
        let result = plain.solve();
        assert_proven(&result);
        assert_eq!(result.solutions.len(), problem.solutions.len(), "{}", problem.name);
        for expected in &problem.solutions {
            let is_it = |found: &&BlockSolution| {
                let pairs = found.magnitudes.iter().zip(&expected.w);
                pairs
                    .into_iter()
                    .all(|(found, expected)| (found - expected).abs() <= 1e-9 * expected.max(1.0))
            };
            let found = result.solutions.iter().find(is_it).unwrap_or_else(|| panic!("{:?}", expected.w));
            assert_eq!(found.orientation == Some(Sign::Positive), expected.det > 0.0);
        }
    }
}
