//! Jams in mid-motion, and what wedges itself at rest: histories against derivations, `limits` and `hold`.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod drawer;
mod locking;
mod wedging;

use slideway::gallery;
use slideway::model::{Model, Settings};

/// A model of the gallery with other parameters.
fn model(name: &str, parameters: &[(&str, &str)]) -> Model {
    let settings =
        parameters.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(gallery::find(name).unwrap().text).unwrap().with(&settings).unwrap()
}
