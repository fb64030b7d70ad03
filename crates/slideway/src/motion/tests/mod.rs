//! Motions that are known in closed form.
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod agreement;
mod closed_forms;
mod continuations;
mod end_stops;
mod energy_of_impacts;
mod friction_laws;
mod impacts;
mod impacts_with_hinges;
mod layers;
mod limits;
mod mechanisms;
mod models;
mod pads;
mod rest;
mod simple;
mod stops;

use super::{Decisions, History, SimulateOptions, Thorough, simulate_with};
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::model::Model;
use std::ops::ControlFlow;

fn model_of(name: &str) -> Model {
    Model::parse(crate::gallery::find(name).unwrap().text).unwrap()
}

fn mechanism_of(text: &str) -> Mechanism {
    Mechanism::new(&Model::parse(text).unwrap()).unwrap()
}

/// A motion, decided in two ways.
fn both(text: &str, options: &SimulateOptions) -> [History; 2] {
    let mechanism = mechanism_of(text);
    let configuration = Configuration::new(&mechanism).unwrap();
    let with = |decisions: &mut dyn Decisions| {
        simulate_with(&mechanism, &configuration, options, decisions, &mut |_| ControlFlow::Continue(()))
            .unwrap()
    };
    [with(&mut Thorough), with(&mut simple::TryAll)]
}

/// A motion; two ways to decide lead to it.
fn run(text: &str, options: &SimulateOptions) -> History {
    let [history, other] = both(text, options);
    assert_eq!(history.end, other.end);
    assert_eq!(history.events.len(), other.events.len());
    for (one, other) in history.events.iter().zip(&other.events) {
        assert!((one.time - other.time).abs() < 1e-9, "{} {}", one.time, other.time);
    }
    history
}
