//! Any text as what is varied and its range, in a model of the gallery: no panic, and no number that is not
//! finite.

use slideway::Report;
use slideway::gallery;
use slideway::limits::{LimitsOptions, Vary, limits_with};
use slideway::model::Model;
use slideway::report::Style;
use std::ops::ControlFlow;

/// The callback ends what takes long.
const PIECES: usize = 600;

/// Checks any text as what is varied and its range.
pub fn limits((number, both_directions, vary): (u8, bool, &str)) {
    let models = gallery::MODELS;
    let model = Model::parse(models[usize::from(number) % models.len()].text).expect("the gallery is sound");
    let vary: Vary = match vary.parse() {
        Ok(vary) => vary,
        Err(faults) => return assert!(!faults.to_string().is_empty()),
    };
    let options = LimitsOptions::new(vary.clone()).both_directions(both_directions);
    let mut pieces = 0;
    let mut callback = |_: &_| {
        pieces += 1;
        if pieces < PIECES { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    match limits_with(&model, &options, &mut callback) {
        Ok(Some(report)) => {
            let [from, to] = [report.vary.from, report.vary.to];
            assert!(from < to && (to - from).is_finite(), "{vary}: {from} to {to}");
            let text = report.text(Style::default());
            assert!(!crate::has_no_number(&text), "{text}");
            assert!(!report.json().is_empty());
        }
        Ok(None) => {}
        Err(faults) => assert!(!faults.to_string().is_empty()),
    }
}
