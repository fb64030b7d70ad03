//! Accelerations and reactions within a phase against those of `solve`, which factors other matrices with
//! full pivoting.

use crate::check::check;
use crate::configuration::Configuration;
use crate::gallery;
use crate::ids::DriveId;
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::modes::Side;
use crate::motion::moving::equations::Equations;
use crate::motion::{ContactPhase, HingePhase, JointPhase, Phase};
use crate::report::{Hinge, Solution};
use crate::solve::solve;

/// A sequence of numbers between -1 and 1 (D. E. Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn phase_of(equations: &Equations<'_>, solution: &Solution) -> Phase {
    let contact = |(k, sign): (usize, &i8)| match sign {
        0 => ContactPhase::PreloadGap,
        1 => ContactPhase::Pressed(Side::Positive),
        _ if equations.mechanism.contacts[k].opens => ContactPhase::PreloadGap,
        _ => ContactPhase::Pressed(Side::Negative),
    };
    let joint = |joint: &crate::ids::JointId| {
        let slider = equations.mechanism.slider(*joint).unwrap();
        let first = slider.contacts.first();
        JointPhase::Sliding(first.map_or(1.0, |k| solution.contacts[k.index()].sliding_velocity.signum()))
    };
    let hinge = |hinge: &Hinge| {
        let turning = hinge.friction?.angular_velocity;
        Some(HingePhase { state: JointPhase::Sliding(turning.signum()), force: hinge.force })
    };
    Phase {
        joints: equations.sliders.iter().map(joint).collect(),
        contacts: solution.signs.iter().enumerate().map(contact).collect(),
        hinges: solution.hinges.iter().filter_map(hinge).collect(),
    }
}

/// All numbers of one kind agree to 1e-10 of the greatest, or of what the greatest force would cause.
fn assert_agree(name: &str, [found, expected]: [&[f64]; 2], least_scale: f64) {
    let scale = expected.iter().fold(least_scale, |scale: f64, value| scale.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-10 * scale, "{name}: {found} {expected}, of {scale}");
    }
}

fn compare(name: &str, model: &Model) -> usize {
    let Ok(report) = solve(model) else { return 0 };
    let mechanism = Mechanism::new(model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let mut equations = Equations::new(&mechanism, &configuration);
    let state = equations.state_of(&configuration);
    let mut compared = 0;
    for solution in report.solutions.iter().chain(&report.preload_gap_states) {
        if solution.on_boundary {
            continue;
        }
        let phase = phase_of(&equations, solution);
        equations.follow(phase.hinges.iter().map(|hinge| hinge.force));
        equations.enter(&phase, configuration.time, &state).unwrap();
        let expected: Vec<f64> = solution
            .bodies
            .iter()
            .flat_map(|b| [b.acceleration[0], b.acceleration[1], b.angular_acceleration])
            .collect();
        let force = equations.greatest_force();
        let mass: f64 = mechanism.bodies.iter().map(|body| body.mass).sum();
        let of_force = if mass > 0.0 { force / mass } else { 0.0 };
        assert_agree(name, [equations.accelerations(), &expected], of_force);
        let contacts = solution.contacts.iter();
        let normal: Vec<f64> = contacts.clone().map(|contact| contact.normal_force).collect();
        let friction: Vec<f64> = contacts.clone().map(|contact| contact.friction_force).collect();
        let found: Vec<f64> = (0..normal.len()).map(|k| equations.normal_force(k)).collect();
        assert_agree(name, [&found, &normal], force);
        let found: Vec<f64> = (0..normal.len()).map(|k| equations.friction_force(k).unwrap()).collect();
        assert_agree(name, [&found, &friction], force);
        for (k, contact) in contacts.enumerate() {
            assert_eq!(equations.share(k).is_some(), contact.preload_share.is_some());
            if let (Some(found), Some(expected)) = (equations.share(k), contact.preload_share) {
                assert!((found - expected).abs() < 1e-10, "{name}: share {found} {expected}");
            }
        }
        let efforts: Vec<f64> = solution.drives.iter().map(|drive| drive.effort).collect();
        let found: Vec<f64> = (0..efforts.len()).map(|d| equations.effort(DriveId(d))).collect();
        assert_agree(name, [&found, &efforts], force);
        for (index, hinge) in solution.hinges.iter().filter(|hinge| hinge.friction.is_some()).enumerate() {
            let [couple, spin] =
                hinge.friction.map(|friction| [friction.couple, friction.angular_velocity]).unwrap();
            assert_agree(name, [&equations.hinge_force(index).unwrap(), &hinge.force], force);
            assert_agree(
                name,
                [&[equations.hinge_couple(index).unwrap()], &[couple]],
                force * mechanism.size,
            );
            assert_agree(name, [&[equations.spin(index)], &[spin]], 0.0);
        }
        compared += 1;
    }
    compared
}

#[test]
fn all_gallery_models_at_random_states() {
    let mut numbers = Numbers(20_261_121);
    for gallery_model in gallery::MODELS {
        let model = Model::parse(gallery_model.text).unwrap();
        if !check(&model).unwrap().is_ready_for("simulate") {
            continue;
        }
        let mechanism = Mechanism::new(&model).unwrap();
        // What sticks in the state does not slide in its phase.
        if mechanism.sticking().next().is_some() {
            continue;
        }
        let mut compared = 0;
        for _ in 0..8 {
            let mut settings = Settings::default();
            for coordinate in &mechanism.coordinates {
                let (unit, scale) =
                    if coordinate.kind.is_angle() { ("rad", 1.0) } else { ("m", mechanism.size) };
                let value = coordinate.value + 0.05 * scale * numbers.next();
                let rate = (coordinate.rate.abs() + 0.1 * scale) * numbers.next();
                settings = settings.position(&coordinate.name, format!("{value} {unit}"));
                settings = settings.rate(&coordinate.name, format!("{rate} {unit}/s"));
            }
            if let Ok(model) = model.with(&settings) {
                compared += compare(gallery_model.name, &model);
            }
        }
        assert!(compared >= 5, "{}: {compared}", gallery_model.name);
    }
}

/// The preload gap of the example: mu_1 = 0.24, F_30 = 0.5 m g, qd > 0 (theory, section 3).
#[test]
fn a_preload_gap() {
    let model = Model::parse(gallery::find("klepp-2002").unwrap().text).unwrap();
    let settings = Settings::default().parameter("F_20", "0").parameter("F_30", "0.5*m*g");
    assert!(compare("gap", &model.with(&settings.parameter("mu_1", "0.24")).unwrap()) > 0);
}
