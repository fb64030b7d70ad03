//! The gallery without friction against Lagrange's equations in minimal coordinates (reference/README.md).

use crate::answers::{model, only, report_with};
use serde::Deserialize;
use slideway::model::Settings;
use std::collections::BTreeMap;

const REFERENCE: &str = include_str!("../../../../reference/gallery-frictionless.toml");

#[derive(Deserialize)]
struct Reference {
    case: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    model: String,
    #[serde(default)]
    set: BTreeMap<String, String>,
    #[serde(default)]
    at: BTreeMap<String, String>,
    #[serde(default)]
    rate: BTreeMap<String, String>,
    coordinates: BTreeMap<String, f64>,
    bodies: BTreeMap<String, [f64; 3]>,
    normal_forces: BTreeMap<String, f64>,
    couples: BTreeMap<String, f64>,
    hinges: BTreeMap<String, [f64; 2]>,
    drives: BTreeMap<String, f64>,
}

type Values = BTreeMap<String, f64>;

/// The values agree to 1e-10 of the greatest of their kind.
fn assert_same(found: &Values, expected: &Values, case: &str) {
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>(), "{case}");
    let scale = expected.values().fold(0.0, |scale: f64, value| scale.max(value.abs())).max(1e-2);
    for (name, expected) in expected {
        let difference = (found[name] - expected).abs();
        let small = expected.abs().max(1e-3 * scale);
        assert!(difference <= 1e-9 * small, "{case}: {name} is {}, not {expected}", found[name]);
    }
}

fn flat<const N: usize>(vectors: &BTreeMap<String, [f64; N]>) -> Values {
    let entries = vectors.iter().flat_map(|(name, vector)| {
        vector.iter().enumerate().map(move |(index, value)| (format!("{name}[{index}]"), *value))
    });
    entries.collect()
}

#[test]
fn every_case_agrees_with_lagrange() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    assert_eq!(reference.case.len(), 33);
    for case in reference.case {
        let mut settings = Settings::default();
        for (name, value) in &case.set {
            settings = settings.parameter(name, value);
        }
        for (name, value) in &case.at {
            settings = settings.position(name, value);
        }
        for (name, value) in &case.rate {
            settings = settings.rate(name, value);
        }
        let label = format!("{} {settings:?}", case.model);
        let report = report_with(&model(&case.model), &settings);
        let solution = only(&report);
        let contacts = &solution.contacts;

        let found = solution.coordinates.iter().map(|c| (c.name.clone(), c.acceleration)).collect();
        assert_same(&found, &case.coordinates, &label);
        let found = solution
            .bodies
            .iter()
            .map(|b| (b.name.clone(), [b.acceleration[0], b.acceleration[1], b.angular_acceleration]));
        // Accelerations and angular accelerations are of different kinds.
        let (found, expected) = (flat(&found.collect()), flat(&case.bodies));
        for turning in [false, true] {
            let kind = |values: &Values| -> Values {
                let of_kind = values.iter().filter(|(name, _)| name.ends_with("[2]") == turning);
                of_kind.map(|(name, value)| (name.clone(), *value)).collect()
            };
            assert_same(&kind(&found), &kind(&expected), &label);
        }
        let found = contacts.iter().map(|c| (c.name.clone(), c.normal_force)).collect();
        assert_same(&found, &case.normal_forces, &label);
        let found = contacts.iter().filter_map(|c| Some((c.name.clone(), c.couple?))).collect();
        assert_same(&found, &case.couples, &label);
        let found = solution.hinges.iter().map(|hinge| (hinge.name.clone(), hinge.force)).collect();
        assert_same(&flat(&found), &flat(&case.hinges), &label);
        let found = solution.drives.iter().map(|drive| (drive.name.clone(), drive.effort)).collect();
        assert_same(&found, &case.drives, &label);
        assert!(solution.residual < 1e-12, "{label}");
    }
}
