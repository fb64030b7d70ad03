//! Numbers of Klepp (2002), sections 6 and 7: the only place where tests read them.
#![allow(dead_code, reason = "each test uses a part of it")]

use std::error::Error;

use serde::Deserialize;

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
    pub(crate) n: [f64; 3],
    pub(crate) f: [f64; 3],
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
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/klepp-2002.toml");
    Ok(toml::from_str(&std::fs::read_to_string(path)?)?)
}
