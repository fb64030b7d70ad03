//! Limits of random mechanisms against dense scanning, and as the physics demands under changes of units,
//! mirror images and reversal.

use crate::answers::assert_close;
use crate::drawing::{Drawing, Kind, Units};
use crate::random_mechanisms::{cases, mechanisms};
use proptest::prelude::*;
use slideway::limits::{LimitsOptions, LimitsReport, ModeLimits, Vary, limits};
use slideway::model::{Model, Settings};
use slideway::report::ModeEndCause;
use slideway::report::Status;
use slideway::solve::{SolveOptions, solve, solve_with};
use std::ops::ControlFlow;
use toml::Value;

/// The greatest factor of friction.
const GREATEST: f64 = 3.0;
/// Factors at which the mechanism is solved.
const SCANNED: usize = 16;

fn found(drawing: &Drawing, both_directions: bool) -> Result<LimitsReport, TestCaseError> {
    let model = Model::parse(&drawing.text()).expect("sound");
    let options =
        LimitsOptions::new(Vary::between("friction", 0.0, 3.0)).both_directions(both_directions).effort(0);
    limits(&model, &options).map_err(|_| TestCaseError::reject("cannot be solved, or no friction"))
}

/// The drawing with every coefficient of friction multiplied.
fn rougher(drawing: &Drawing, factor: f64) -> Drawing {
    let mut drawing = drawing.clone();
    for joint in &mut drawing.joints {
        if let Kind::Slider(slider) = &mut joint.kind {
            for contact in &mut slider.contacts {
                contact.mu = contact.mu.map(|mu| mu * factor);
            }
        }
    }
    drawing
}

fn ends(mode: &ModeLimits) -> [f64; 2] {
    [mode.from.expect("finite"), mode.to.expect("finite")]
}

/// The same intervals, each pattern's signs multiplied by a factor.
fn same(one: &[ModeLimits], other: &[ModeLimits], factor: i8) -> Result<(), TestCaseError> {
    let list = |modes: &[ModeLimits], factor: i8| {
        let mut list: Vec<(Vec<i8>, [f64; 2], ModeEndCause)> = modes
            .iter()
            .map(|mode| (mode.signs.iter().map(|sign| factor * sign).collect(), ends(mode), mode.to_is))
            .collect();
        list.sort_by(|a, b| a.0.cmp(&b.0).then(a.1[0].total_cmp(&b.1[0])));
        list
    };
    let (one, other) = (list(one, factor), list(other, 1));
    prop_assert_eq!(one.len(), other.len(), "{:?} {:?}", one, other);
    for ((signs, ends, cause), (other_signs, other_ends, other_cause)) in one.iter().zip(&other) {
        prop_assert_eq!((signs, cause), (other_signs, other_cause));
        for (end, other) in ends.iter().zip(other_ends) {
            assert_close(*end, *other, 1.0, 1e-7);
        }
    }
    Ok(())
}

/// Whether intervals so short, or ends so close to each other, that rounding decides about them.
fn is_delicate(report: &LimitsReport) -> bool {
    report.modes.iter().map(ends).any(|[from, to]| to - from < 1e-6)
}

proptest! {
    #![proptest_config(cases(16))]

    #[test]
    fn dense_scanning_finds_the_same_intervals(drawing in mechanisms()) {
        let report = found(&drawing, false)?;
        for step in 0..SCANNED {
            let factor = GREATEST * (step as f64 + 0.413) / SCANNED as f64;
            let near = |mode: &ModeLimits| ends(mode).iter().any(|end| (end - factor).abs() < 1e-6);
            if report.modes.iter().any(near) {
                continue;
            }
            let model = Model::parse(&rougher(&drawing, factor).text()).expect("sound");
            let solved = solve(&model).expect("it could be solved with other friction");
            let all = solved.solutions.iter().chain(&solved.preload_gap_states);
            if all.clone().any(|solution| solution.on_boundary || solution.patterns.len() > 1) {
                continue;
            }
            let mut solved: Vec<&str> = all.map(|solution| solution.pattern.as_str()).collect();
            let present = report.modes.iter().filter(|mode| ends(mode)[0] < factor && factor < ends(mode)[1]);
            let mut present: Vec<&str> = present.map(|mode| mode.pattern.as_str()).collect();
            solved.sort_unstable();
            present.sort_unstable();
            prop_assert_eq!(solved, present, "at {} times the friction", factor);
        }
    }

}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn limits_do_not_depend_on_units(drawing in mechanisms(), powers in prop::array::uniform3(-2.0..2.0_f64)) {
        let report = found(&drawing, false)?;
        prop_assume!(!is_delicate(&report));
        let [length, mass, time] = powers.map(|power| 10_f64.powf(power));
        same(&report.modes, &found(&drawing.scaled(Units { length, mass, time }), false)?.modes, 1)?;
    }

    #[test]
    fn a_mirror_image_has_the_same_limits(drawing in mechanisms()) {
        let report = found(&drawing, false)?;
        prop_assume!(!is_delicate(&report));
        same(&report.modes, &found(&drawing.mirrored(), false)?.modes, -1)?;
    }

    #[test]
    fn reversed_motion_is_the_motion_with_opposite_rates(drawing in mechanisms()) {
        let report = found(&drawing, true)?;
        prop_assume!(!is_delicate(&report));
        let mut backwards = drawing.clone();
        backwards.coordinates.iter_mut().for_each(|coordinate| coordinate.rate = -coordinate.rate);
        same(&report.reversed.expect("asked for").modes, &found(&backwards, false)?.modes, 1)?;
    }
}

/// Everything that is a number in a model file, by its path; the parameter `p` takes the place of one.
fn numbers<'v>(value: &'v mut Value, found: &mut Vec<&'v mut Value>) {
    match value {
        Value::Float(_) => found.push(value),
        Value::Array(list) => list.iter_mut().for_each(|value| numbers(value, found)),
        Value::Table(table) => table.iter_mut().for_each(|(_, value)| numbers(value, found)),
        _ => {}
    }
}

/// A value as TOML on one line.
fn inline(value: &Value) -> String {
    match value {
        Value::Table(table) => {
            let entries = table.iter().map(|(key, value)| format!("{key} = {}", inline(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
        Value::Array(list) => format!("[{}]", list.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::String(text) => format!("{text:?}"),
        Value::Float(number) => format!("{number:?}"),
        Value::Integer(number) => number.to_string(),
        Value::Boolean(truth) => truth.to_string(),
        Value::Datetime(_) => panic!("no model has a date"),
    }
}

/// A mechanism, what is varied in it, and over which range: any number of the file, the value of a
/// coordinate, or all friction.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn varied(drawing: &Drawing, choice: f64) -> Option<(Model, String)> {
    let mut file: Value = toml::from_str(&drawing.text()).expect("TOML");
    let mut places = Vec::new();
    numbers(&mut file, &mut places);
    let (count, coordinates) = (places.len(), drawing.coordinates.len());
    let index = (choice * (count + coordinates + 1) as f64) as usize;
    if index >= count {
        let model = Model::parse(&drawing.text()).expect("sound");
        let vary = match drawing.coordinates.get(index - count) {
            Some(coordinate) => {
                format!("{}={:e}..{:e}", coordinate.name, coordinate.value - 0.1, coordinate.value + 0.1)
            }
            None => "friction=0..3".to_owned(),
        };
        return Some((model, vary));
    }
    let place = places.into_iter().nth(index)?;
    let number = place.as_float().filter(|number| *number != 0.0)?;
    *place = Value::String("p".to_owned());
    let ends = [0.6 * number, 1.5 * number];
    let [from, to] = if number > 0.0 { ends } else { [ends[1], ends[0]] };
    let sections =
        file.as_table().expect("sections").iter().map(|(key, value)| format!("{key} = {}", inline(value)));
    let text = format!("parameters = {{ p = {number:?} }}\n{}", sections.collect::<Vec<_>>().join("\n"));
    Some((Model::parse(&text).expect("sound"), format!("p={from:e}..{to:e}")))
}

/// Solutions and preload-gap states at a value; none where rounding decides about them.
fn solved(model: &Model, vary: &str, value: f64) -> Option<[usize; 2]> {
    let name = vary.split('=').next().expect("a name");
    let value = format!("{value:e}");
    let settings = match name {
        "p" => Settings::default().parameter("p", &value),
        _ => Settings::default().position(name, &value),
    };
    let there = model.with(&settings).expect("allowed");
    let options = SolveOptions::default().margins(false);
    let report = solve_with(&there, &options, &mut |_| ControlFlow::Continue(())).expect("solvable");
    let states = || report.solutions.iter().chain(&report.preload_gap_states);
    let is_open = report.status == Status::Unknown || states().any(|state| state.on_boundary);
    (!is_open).then_some([report.solutions.len(), report.preload_gap_states.len()])
}

/// Compares limits with `solve` at random values of each interval; returns how many were compared.
fn agrees(drawing: &Drawing, choice: f64, shares: &[f64], effort: u64) -> Result<usize, TestCaseError> {
    let Some((model, vary)) = varied(drawing, choice) else {
        return Err(TestCaseError::reject("a zero"));
    };
    prop_assume!(!vary.starts_with("friction"));
    let report = limits(&model, &LimitsOptions::new(vary.parse().expect("a range")).effort(effort))
        .map_err(|_| TestCaseError::reject("cannot be solved"))?;
    let mut compared = 0;
    for count in &report.counts {
        prop_assert!(count.known != slideway::limits::Known::Undecided, "{vary}: {count:?}");
        for share in shares {
            let value = count.from + share * (count.to - count.from);
            let room = 1e-6 * (count.to - count.from).max(value.abs());
            let near = |mode: &ModeLimits| ends(mode).iter().any(|end| (end - value).abs() < room);
            if report.modes.iter().any(near) {
                continue;
            }
            let Some(solved) = solved(&model, &vary, value) else { continue };
            prop_assert_eq!(
                solved,
                [count.solutions, count.preload_gap_states],
                "{} at {:e}: {:?}",
                vary,
                value,
                count
            );
            compared += 1;
        }
    }
    Ok(compared)
}

proptest! {
    #![proptest_config(cases(8))]

    #[test]
    fn every_kind_of_parameter_agrees_with_single_solutions(
        drawing in mechanisms(), choice in 0.0..1.0_f64, shares in prop::collection::vec(0.0..1.0_f64, 20),
    ) {
        agrees(&drawing, choice, &shares, 0)?;
    }
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    #[ignore = "takes minutes"]
    fn every_kind_of_parameter_agrees_with_single_solutions_many_times(
        drawing in mechanisms(), choice in 0.0..1.0_f64, shares in prop::collection::vec(0.0..1.0_f64, 20),
    ) {
        agrees(&drawing, choice, &shares, 100)?;
    }
}
