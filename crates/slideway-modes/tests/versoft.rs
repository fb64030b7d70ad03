//! The examples printed in the help texts of VERSOFT (`reference/versoft.toml`): the number of solutions, and
//! the printed enclosures of each.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use slideway_modes::certificate::{Interval, IntervalMatrix, IntervalModeProblem};
use slideway_modes::raw_problem::{RawProblem, Unknowns, solve};
use slideway_modes::{BySide, Certificate, Completeness, ModeSolution, Proof, SearchOptions, Side, search};

/// Half a unit of the last printed decimal, and a little for the rounding of the decimals to `f64`.
const PRINTED: f64 = 5.000_000_1e-5;

#[derive(Deserialize)]
struct Reference {
    example: Vec<Example>,
}

#[derive(Deserialize)]
#[allow(non_snake_case, reason = "the names of the arrays")]
struct Example {
    function: String,
    name: String,
    solutions: usize,
    M: Option<Vec<Vec<f64>>>,
    q: Option<Vec<f64>>,
    A: Option<Vec<Vec<f64>>>,
    B: Option<Vec<Vec<f64>>>,
    b: Option<Vec<f64>>,
    #[serde(default)]
    enclosures: Vec<Vec<[f64; 2]>>,
}

fn examples() -> Vec<Example> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/versoft.toml");
    let reference: Reference = toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(reference.example.len(), 4);
    reference.example
}

impl Example {
    /// The problem of the printed numbers.
    fn problem(&self) -> RawProblem {
        let matrix = |rows: &Option<Vec<Vec<f64>>>| {
            let rows = rows.as_ref().unwrap();
            DMatrix::from_fn(rows.len(), rows.len(), |row, column| rows[row][column])
        };
        let vector = |values: &Option<Vec<f64>>| DVector::from_vec(values.clone().unwrap());
        match self.function.as_str() {
            "verlcpall" => RawProblem::LinearComplementarity { m: matrix(&self.M), q: vector(&self.q) },
            _ => RawProblem::AbsoluteValue {
                a: matrix(&self.A),
                b: matrix(&self.B),
                right_hand_side: vector(&self.b),
            },
        }
    }

    /// All problems of numbers that are printed so.
    fn within_print(&self) -> IntervalModeProblem {
        let problem = self.problem().mode_problem().unwrap();
        let n = problem.contacts();
        let sum = usize::from(self.function == "verabsvaleqnall") + 1;
        let matrix = |side: Side| {
            let centre = problem.columns(side).clone();
            // The identity of w is exact.
            let exact = sum == 1 && side == Side::Negative;
            // Sums of two printed numbers are rounded by much less than the last printed decimal.
            let radius = if exact { 0.0 } else { PRINTED * sum as f64 * 1.000_000_1 };
            IntervalMatrix::around(centre, DMatrix::from_element(n, n, radius)).unwrap()
        };
        let columns = BySide { positive: matrix(Side::Positive), negative: matrix(Side::Negative) };
        let none = BySide::same(IntervalMatrix::exact(DMatrix::zeros(n, n)));
        let load = DMatrix::from_column_slice(n, 1, problem.right_hand_side().as_slice());
        let load = IntervalMatrix::around(load, DMatrix::from_element(n, 1, PRINTED)).unwrap();
        IntervalModeProblem::new(&columns, &none, &load).unwrap()
    }

    /// `x` in the notation of the function.
    fn sign_of_x(&self) -> f64 {
        if self.function == "verlcpall" { -1.0 } else { 1.0 }
    }
}

#[test]
fn as_many_solutions_as_printed() {
    for example in examples() {
        let raw = example.problem();
        let report =
            solve(&raw, &SearchOptions::default(), 2000, &mut |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(report.complete, Proof::Proven, "{}, {}", example.function, example.name);
        assert_eq!(report.count, example.solutions.to_string(), "{}, {}", example.function, example.name);
        // The numbers of the example were rounded when they were printed: its solutions are near those of the
        // print.
        let told: Vec<Vec<f64>> = report
            .solutions
            .iter()
            .map(|solution| match &solution.unknowns {
                Unknowns::Complementary { z, w } => w.iter().zip(z).map(|(w, z)| w - z).collect(),
                Unknowns::AbsoluteValue { x } => x.clone(),
                _ => unreachable!("an equation or a complementarity problem"),
            })
            .collect();
        for printed in &example.enclosures {
            let near = |x: &&Vec<f64>| {
                x.iter().zip(printed).all(|(x, [low, high])| (low - 5e-3..high + 5e-3).contains(x))
            };
            assert_eq!(told.iter().filter(near).count(), 1, "{printed:?}");
        }
    }
}

/// What is proven for all numbers that are printed so holds for those of the example: there are as many
/// solutions, and every printed enclosure meets one of the enclosures found.
#[test]
fn printed_enclosures_meet_those_of_all_numbers_that_are_printed_so() {
    for example in examples().into_iter().filter(|example| !example.enclosures.is_empty()) {
        let problem = example.within_print();
        let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
        assert_eq!(result.completeness, Completeness::Proven);
        let lists = result.lists(100, 100);
        assert_eq!((lists.solutions.len(), lists.undecided.len()), (example.solutions, 0));
        let proven = |solution: &ModeSolution| matches!(solution.certificate, Certificate::Proven { .. });
        assert!(lists.solutions.iter().all(proven));
        for printed in &example.enclosures {
            let meets = lists.solutions.iter().any(|solution| {
                let unknowns = solution.certificate.unknowns().unwrap();
                let signed = unknowns.iter().zip(&solution.pattern).map(|(y, side)| {
                    let sign = side.sign() * example.sign_of_x();
                    if sign > 0.0 { *y } else { -*y }
                });
                signed.zip(printed).all(|(found, [low, high])| {
                    found.intersection(Interval::new(*low, *high).unwrap()).is_some()
                })
            });
            assert!(meets, "{printed:?}");
        }
    }
}
