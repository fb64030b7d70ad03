//! Any text as a title, a model or a raw problem: what is told of it acts neither on a terminal nor in a
//! picture or a page.

use slideway::Report;
use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::printable;
use slideway::raw_problem::RawProblem;
use slideway::report::Style;
use slideway::{check, gallery, solve};
use slideway_pictures::drawing::{Forces, Shown, sheet, svg};
use slideway_pictures::page::{Findings, Origin};
use std::ops::ControlFlow;

/// Nothing is hidden in a text; `own` are the escape sequences of the program's colours.
fn assert_inert(text: &str, own: &[&str]) {
    let plain = own.iter().fold(text.to_owned(), |plain, sequence| plain.replace(sequence, ""));
    assert_eq!(printable::lines(&plain), plain);
}

const COLOURS: [&str; 5] = ["\u{1b}[0m", "\u{1b}[1m", "\u{1b}[31m", "\u{1b}[32m", "\u{1b}[33m"];

const COLOURED: Style = Style::PLAIN.colour(true);

fn told(model: &Model) {
    let found = check::check(model).map(|found| {
        assert_inert(&found.json(), &[]);
        found.text(COLOURED)
    });
    assert_inert(&found.unwrap_or_else(|faults| faults.to_string()), &COLOURS);
    let Ok(answer) = solve::solve(model) else { return };
    let text = answer.text(COLOURED);
    assert_inert(&text, &COLOURS);
    // Colours are the program's own: without them, and in plain text, the same is told.
    let plain = COLOURS.iter().fold(text, |plain, sequence| plain.replace(sequence, ""));
    assert_eq!(plain, answer.text(Style::PLAIN));
    let json: serde_json::Value = serde_json::from_str(&answer.json()).expect("JSON");
    assert_eq!(json["model"]["title"].as_str(), model.title.as_deref());
    assert_inert(&answer.json(), &[]);
    assert_inert(&answer.csv(), &[]);
    let Ok(mechanism) = Mechanism::new(model) else { return };
    let Ok(configuration) = Configuration::new(&mechanism) else { return };
    let Some(sheet) = sheet(&mechanism, &configuration, Some(Forces::InMotion(&answer)), Shown::All) else {
        return;
    };
    let title = model.title.as_deref().unwrap_or_default();
    if let Ok(Some(findings)) = Findings::of(model, Vec::new(), &mut |_| ControlFlow::Continue(())) {
        let settings = Settings::default();
        let origin = Origin { command: title, name: title, text: title, settings: &settings };
        assert_inert(&findings.to_html(&origin).expect("a page"), &[]);
    }
    let frame = svg::Frame {
        bounds: sheet.bounds,
        title,
        description: title,
        width: None,
        colours: svg::Colours::Page,
    };
    assert_inert(&svg::write(&sheet.scene, &frame).expect("finite places"), &[]);
}

/// Checks any text as a title, a model or a raw problem.
pub fn terminal(text: &str) {
    match Model::parse(text) {
        Ok(model) => drop(model),
        Err(faults) => assert_inert(&faults.to_string(), &[]),
    }
    if let Err(faults) = RawProblem::from_json(text.as_bytes()) {
        assert_inert(&faults.to_string(), &[]);
    }
    let drawer = gallery::find("drawer").expect("a model of the gallery");
    let mut model = Model::parse(drawer.text).expect("a model of the gallery");
    model.title = Some(text.to_owned());
    told(&model);
}
