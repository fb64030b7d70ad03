//! Motions that are known in closed form.
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod closed_forms;
mod simple;

use super::{History, SimulateOptions, simulate_with};
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::model::Model;
use std::ops::ControlFlow;

fn run(text: &str, options: &SimulateOptions) -> History {
    let mechanism = Mechanism::new(&Model::parse(text).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    simulate_with(&mechanism, &configuration, options, &mut simple::TryAll, &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap()
}
