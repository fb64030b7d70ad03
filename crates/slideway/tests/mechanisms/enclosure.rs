//! The enclosure of the influence coefficients: against the rounded ones, closed forms, and perturbed models.

use crate::answers::{model, parameters};
use nalgebra::DMatrix;
use slideway::configuration::Configuration;
use slideway::enclosure::{EnclosedModeProblem, NotEnclosed, UncertainParameters, enclosure};
use slideway::fault::Faults;
use slideway::gallery::MODELS;
use slideway::influence::Influence;
use slideway::interval::Interval;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::modes::Side;
use slideway::modes::certificate::IntervalMatrix;

/// The enclosure of a model, with bounds of some parameters.
fn enclosed_within(
    model: &Model,
    uncertain: &[(&str, f64, f64)],
) -> Result<EnclosedModeProblem, NotEnclosed> {
    let add = |all: UncertainParameters, &(name, lower, upper): &(&str, f64, f64)| {
        all.with(name, Interval::new(lower, upper).unwrap())
    };
    let uncertain = uncertain.iter().fold(UncertainParameters::default(), add);
    let mechanism = Mechanism::new(model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    enclosure(model, &uncertain, &mechanism, &configuration)
}

fn enclosed(model: &Model) -> EnclosedModeProblem {
    enclosed_within(model, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The rounded influence of a model.
fn influence(model: &Model) -> Result<Influence, Faults> {
    let mechanism = Mechanism::new(model)?;
    let configuration = Configuration::new(&mechanism)?;
    Ok(Influence::new(&KineticEquations::new(&mechanism, &configuration)?))
}

/// How far the numbers are outside of the bounds, relative to the greatest of their column.
fn outside(bounds: &IntervalMatrix, numbers: &DMatrix<f64>) -> f64 {
    let mut most: f64 = 0.0;
    for column in 0..numbers.ncols() {
        let scale = numbers.column(column).amax().max(1e-300);
        for row in 0..numbers.nrows() {
            let (bounds, number) = (bounds.entry(row, column), numbers[(row, column)]);
            most = most.max((bounds.lower() - number).max(number - bounds.upper()) / scale);
        }
    }
    most
}

/// The greatest width of an entry, relative to the greatest of its column.
fn relative_width(bounds: &IntervalMatrix) -> f64 {
    let width = |column: usize| {
        let greatest = bounds.centre().column(column).amax();
        if greatest == 0.0 { 0.0 } else { 2.0 * bounds.radius().column(column).amax() / greatest }
    };
    (0..bounds.shape().1).map(width).fold(0.0, f64::max)
}

#[test]
fn the_gallery_is_enclosed_to_many_digits() {
    for entry in MODELS.iter().filter(|entry| entry.name != "bracket-on-pole") {
        let model = Model::parse(entry.text).unwrap();
        let (found, rounded) = (enclosed(&model).influence, influence(&model).unwrap());
        let normal =
            DMatrix::from_column_slice(rounded.normal_forces().len(), 1, rounded.normal_forces().as_slice());
        println!(
            "{} {:e} {:e} {:e}",
            entry.name,
            relative_width(&found.eta.positive),
            relative_width(&found.eta.negative),
            relative_width(&found.frictionless)
        );
        println!(
            "   {:e} {:e} {:e}",
            outside(&found.eta.positive, &rounded.eta(0)),
            outside(&found.eta.negative, &rounded.eta(1)),
            outside(&found.frictionless, &normal)
        );
    }
}
