//! Time of every stage from a model file to its report.

use divan::Bencher;
use slideway::configuration::Configuration;
use slideway::enclosure::{UncertainParameters, enclosure};
use slideway::gallery;
use slideway::influence::Influence;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::solve::{SolveOptions, solve, solve_with};
use std::ops::ControlFlow;

/// A few bodies with three contacts, a closed loop, and a chain with six contacts.
const NAMES: [&str; 3] = ["klepp-2002", "slider-crank", "telescopic-boom"];

fn main() {
    divan::main();
}

fn text(name: &str) -> &'static str {
    gallery::find(name).expect("in the gallery").text
}

fn model(name: &str) -> Model {
    Model::parse(text(name)).expect("a sound model")
}

fn mechanism(name: &str) -> Mechanism {
    Mechanism::new(&model(name)).expect("allowed values")
}

fn configuration(mechanism: &Mechanism) -> Configuration {
    Configuration::new(mechanism).expect("a state within reach")
}

fn equations(mechanism: &Mechanism) -> KineticEquations {
    KineticEquations::new(mechanism, &configuration(mechanism)).expect("regular equations")
}

#[divan::bench(args = NAMES)]
fn parse_model(bencher: Bencher<'_, '_>, name: &str) {
    let text = text(name);
    bencher.bench_local(|| Model::parse(text));
}

#[divan::bench(args = NAMES)]
fn evaluate_mechanism(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    bencher.bench_local(|| Mechanism::new(&model));
}

#[divan::bench(args = NAMES)]
fn assemble_configuration(bencher: Bencher<'_, '_>, name: &str) {
    let mechanism = mechanism(name);
    bencher.bench_local(|| Configuration::new(&mechanism));
}

/// Includes the factorization.
#[divan::bench(args = NAMES)]
fn kinetic_equations(bencher: Bencher<'_, '_>, name: &str) {
    let mechanism = mechanism(name);
    let configuration = configuration(&mechanism);
    bencher.bench_local(|| KineticEquations::new(&mechanism, &configuration));
}

#[divan::bench(args = NAMES)]
fn influence_coefficients(bencher: Bencher<'_, '_>, name: &str) {
    let equations = equations(&mechanism(name));
    bencher.bench_local(|| Influence::new(&equations));
}

/// Rigorous bounds of the mode problem.
#[divan::bench(args = NAMES)]
fn enclosed_mode_problem(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    let mechanism = mechanism(name);
    let configuration = configuration(&mechanism);
    let certain = UncertainParameters::default();
    bencher.bench_local(|| enclosure(&model, &certain, &mechanism, &configuration));
}

/// From the parsed model to the report.
#[divan::bench(args = NAMES)]
fn whole_solve(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    bencher.bench_local(|| solve(&model));
}

/// Contacts that may lift off, beside the drawer with which theirs is compared.
#[divan::bench(args = ["drawer", "rod-on-floor", "peg-in-hole"])]
fn solve_what_may_lift_off(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    bencher.bench_local(|| solve(&model));
}

/// Mechanisms with friction in all hinges.
const HINGED: [&str; 6] =
    ["bell-crank", "four-bar", "over-centre-clamp", "quick-return", "slider-crank-with-pins", "toggle-press"];

fn solve_with_pins(bencher: Bencher<'_, '_>, name: &str, has_friction: bool, margins: bool) {
    let mut model = model(name);
    if !has_friction {
        model = model.with(&Settings::default().parameter("mu_pin", 0)).expect("a parameter of all");
    }
    let options = SolveOptions::default().margins(margins);
    bencher.bench_local(|| solve_with(&model, &options, &mut |_| ControlFlow::Continue(())));
}

#[divan::bench(args = HINGED)]
fn rough_pins(bencher: Bencher<'_, '_>, name: &str) {
    solve_with_pins(bencher, name, true, true);
}

#[divan::bench(args = HINGED)]
fn smooth_pins(bencher: Bencher<'_, '_>, name: &str) {
    solve_with_pins(bencher, name, false, true);
}

#[divan::bench(args = HINGED)]
fn rough_pins_without_margins(bencher: Bencher<'_, '_>, name: &str) {
    solve_with_pins(bencher, name, true, false);
}

#[divan::bench(args = HINGED)]
fn smooth_pins_without_margins(bencher: Bencher<'_, '_>, name: &str) {
    solve_with_pins(bencher, name, false, false);
}
