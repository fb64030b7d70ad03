//! The example of Klepp (2002), sections 6 and 7, and its reference numbers, in the paper's convention (reactions in
//! units of m g, `N_3` positive downwards).
#![allow(dead_code, reason = "each test uses a part of it")]

use std::error::Error;

use nalgebra::{DMatrix, DVector, dvector};
use serde::Deserialize;
use slideway_modes::{BySide, InfluenceCoefficients, ModeProblem, Side};

#[derive(Deserialize)]
pub(crate) struct Reference {
    pub(crate) parameters: Parameters,
    pub(crate) printed: Vec<Printed>,
    pub(crate) intervals: Vec<Intervals>,
}

#[derive(Deserialize)]
pub(crate) struct Parameters {
    pub(crate) alpha_deg: f64,
    pub(crate) b_over_l: f64,
    pub(crate) h_over_l: f64,
    pub(crate) mu_2: f64,
    pub(crate) mu_3: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
pub(crate) struct PrintedSolution {
    pub(crate) n: Vec<f64>,
    pub(crate) f: Vec<f64>,
    #[serde(rename = "F_total")]
    pub(crate) f_total: f64,
}

#[derive(Deserialize)]
pub(crate) struct Printed {
    pub(crate) mu_1: f64,
    #[serde(rename = "F0")]
    pub(crate) preload: [f64; 3],
    pub(crate) velocity: f64,
    pub(crate) solutions: Vec<PrintedSolution>,
}

#[derive(Deserialize)]
pub(crate) struct Intervals {
    #[serde(rename = "F0")]
    pub(crate) preload: [f64; 3],
    pub(crate) velocity: f64,
    pub(crate) modes: Vec<Interval>,
}

#[derive(Deserialize)]
pub(crate) struct Interval {
    pub(crate) signs: String,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

pub(crate) fn reference() -> Result<Reference, Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reference/klepp-2002.toml");
    Ok(toml::from_str(&std::fs::read_to_string(path)?)?)
}

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
    })
    .expect("the example's data are finite and of one size")
}
