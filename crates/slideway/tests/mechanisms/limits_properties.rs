//! Limits of random mechanisms against dense scanning, and as the physics demands under changes of units, mirror images
//! and reversal.

use crate::answers::assert_close;
use crate::drawing::{Drawing, Kind, Units};
use crate::random_mechanisms::{cases, mechanisms};
use proptest::prelude::*;
use slideway::limits::{LimitsOptions, LimitsReport, ModeLimits, limits};
use slideway::model::Model;
use slideway::solve::solve;

/// The greatest factor of friction.
const GREATEST: f64 = 3.0;
/// Factors at which the mechanism is solved.
const SCANNED: usize = 16;

fn found(drawing: &Drawing, both_directions: bool) -> Result<LimitsReport, TestCaseError> {
    let model = Model::parse(&drawing.text()).expect("sound");
    let options = LimitsOptions { both_directions, ..LimitsOptions::of("friction=0..3") };
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
        let mut list: Vec<(Vec<i8>, [f64; 2], &str)> = modes
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
