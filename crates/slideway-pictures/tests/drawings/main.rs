//! Structure of drawings: what is in them, and where.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

#[allow(dead_code, reason = "the tests of the library use more of it")]
#[path = "../../../slideway/tests/mechanisms/drawing.rs"]
mod drawing;
#[path = "../../../slideway/tests/mechanisms/random_mechanisms.rs"]
mod random_mechanisms;

mod gallery;
mod held;
mod jam;
mod looks;
mod overlaps;
mod random;
mod raster;
mod redundant;
mod space;
mod stops;

use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::report::SolveReport;
use slideway::solve::solve;
use slideway_pictures::drawing::{Forces, Sheet, Shown, sheet};

/// A model in a state, with its solutions if it has any.
struct Case {
    mechanism: Mechanism,
    configuration: Configuration,
    report: Option<SolveReport>,
}

impl Case {
    fn new(text: &str, settings: &Settings) -> Self {
        let model = Model::parse(text).unwrap().with(settings).unwrap();
        let mechanism = Mechanism::new(&model).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap();
        Self { mechanism, configuration, report: solve(&model).ok() }
    }

    fn gallery(name: &str) -> Self {
        Self::new(slideway::gallery::find(name).unwrap().text, &Settings::default())
    }

    /// The drawings of its solutions in motion.
    fn sheet(&self, shown: Shown) -> Option<Sheet> {
        sheet(&self.mechanism, &self.configuration, self.report.as_ref().map(Forces::InMotion), shown)
    }
}
