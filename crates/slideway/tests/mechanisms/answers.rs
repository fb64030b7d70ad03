//! Asking for reports and reading them.

use slideway::fault::Faults;
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::report::{Contact, Solution, SolveReport};
use slideway::solve::solve;

/// A model of the gallery.
pub(crate) fn model(name: &str) -> Model {
    Model::parse(gallery::find(name).expect("in the gallery").text).expect("a sound model")
}

/// Settings of parameters.
pub(crate) fn parameters(list: &[(&str, &str)]) -> Settings {
    list.iter().fold(Settings::default(), |settings, (name, value)| settings.parameter(name, value))
}

/// The report on a model of the gallery with some parameters set.
pub(crate) fn report(name: &str, list: &[(&str, &str)]) -> SolveReport {
    report_with(&model(name), &parameters(list))
}

/// The report on a model with settings.
pub(crate) fn report_with(model: &Model, settings: &Settings) -> SolveReport {
    solve(&model.with(settings).expect("sound settings")).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The report on the text of a model file.
pub(crate) fn report_on(text: &str) -> SolveReport {
    try_report_on(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

/// The report on the text of a model file, or its faults.
pub(crate) fn try_report_on(text: &str) -> Result<SolveReport, Faults> {
    solve(&Model::parse(text)?)
}

/// A contact of a solution.
pub(crate) fn contact<'a>(solution: &'a Solution, name: &str) -> &'a Contact {
    solution.contacts.iter().find(|contact| contact.name == name).expect("a contact of this name")
}

/// Normal forces of a solution in the order of its contacts (N).
pub(crate) fn normal_forces(solution: &Solution) -> Vec<f64> {
    solution.contacts.iter().map(|contact| contact.normal_force).collect()
}

/// The mode of a joint in words.
pub(crate) fn mode<'a>(solution: &'a Solution, joint: &str) -> &'a str {
    &solution.joints.iter().find(|mode| mode.name == joint).expect("a joint of this name").mode
}

/// Acceleration of the centre of mass of a body (m/s^2).
pub(crate) fn acceleration(solution: &Solution, body: &str) -> [f64; 2] {
    solution.bodies.iter().find(|other| other.name == body).expect("a body of this name").acceleration
}

/// Acceleration of a coordinate.
pub(crate) fn coordinate_acceleration(solution: &Solution, name: &str) -> f64 {
    let found = solution.coordinates.iter().find(|coordinate| coordinate.name == name);
    found.expect("a coordinate of this name").acceleration
}

/// Fails unless the numbers agree to a tolerance relative to the greater of them and `scale`.
#[track_caller]
pub(crate) fn assert_close(found: f64, expected: f64, scale: f64, tolerance: f64) {
    let scale = scale.abs().max(found.abs()).max(expected.abs());
    assert!((found - expected).abs() <= tolerance * scale, "{found} is not {expected} (scale {scale})");
}

/// The only solution of a report.
#[track_caller]
pub(crate) fn only(report: &SolveReport) -> &Solution {
    assert_eq!(report.solutions.len(), 1, "status {:?}", report.status);
    assert_eq!(report.status, slideway::report::Status::One);
    &report.solutions[0]
}
