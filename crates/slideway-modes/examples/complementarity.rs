//! All solutions of a linear complementarity problem and of an absolute value equation.
//! `cargo run -p slideway-modes --example complementarity`
#![allow(clippy::print_stdout)]

use nalgebra::{dmatrix, dvector};
use slideway_modes::raw_problem::{RawProblem, solve};
use slideway_modes::{ModeProblemError, SearchOptions};
use std::ops::ControlFlow;

fn main() -> Result<(), ModeProblemError> {
    let problems = [
        // w = M z + q, w >= 0, z >= 0, w_k z_k = 0
        RawProblem::LinearComplementarity { m: dmatrix![1.0, 2.0; 2.0, 1.0], q: dvector![-1.0, -1.0] },
        // A x + B |x| = b
        RawProblem::AbsoluteValue {
            a: dmatrix![1.0, 0.5; -0.5, 1.0],
            b: dmatrix![-2.0, 0.0; 0.0, -2.0],
            right_hand_side: dvector![-1.0, -1.0],
        },
    ];
    for problem in &problems {
        let answer = solve(problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(()))?;
        println!("{}: {} solutions, {}", answer.kind.title(), answer.count, answer.complete);
        for solution in &answer.solutions {
            println!("  {:?}", solution.unknowns.named());
        }
    }
    Ok(())
}
