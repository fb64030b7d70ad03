//! The example of Klepp (2002), sections 6 and 7, and its reference numbers, in the paper's convention
//! (reactions in units of m g, `N_3` positive downwards).
#![allow(dead_code, reason = "each test uses a part of it")]

use nalgebra::{DMatrix, DVector, dvector};
use slideway_modes::{BySide, InfluenceCoefficients, ModeProblem, Side};

mod reference;

pub(crate) use reference::{Parameters, reference};

/// The problem from the closed forms of the paper's section 6.
pub(crate) fn example(parameters: &Parameters, mu_1: f64, preload: [f64; 3], velocity: f64) -> ModeProblem {
    let tangent = parameters.alpha_deg.to_radians().tan();
    let arm = parameters.h_over_l / (2.0 * parameters.b_over_l);
    let eta = |side: Side| {
        let (two, three) = (arm * side.sign(), -arm * side.sign());
        #[rustfmt::skip]
        let entries = [
            -tangent / 2.0, tangent / 2.0, tangent / 2.0,
            tangent / 4.0, two - tangent / 4.0, three - tangent / 4.0,
            -tangent / 4.0, two + tangent / 4.0, three + tangent / 4.0,
        ];
        DMatrix::from_row_slice(3, 3, &entries)
    };
    let eta = BySide { positive: eta(Side::Positive), negative: eta(Side::Negative) };
    ModeProblem::from_influence(&InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![mu_1, parameters.mu_2, parameters.mu_3]),
        preload: BySide::same(DVector::from_row_slice(&preload)),
        velocity_signs: DVector::repeat(3, velocity),
        frictionless: dvector![0.5, 0.25, -0.25],
        shared: None,
        one_sided: vec![],
        turning: vec![],
    })
    .expect("the example's data are finite and of one size")
}
