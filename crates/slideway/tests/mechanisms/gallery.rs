//! Every model of the gallery shows what its opening comment says.

use crate::answers::{
    acceleration, contact, coordinate_acceleration, mode, model, normal_forces, only, parameters, report,
    report_with,
};
use rstest::rstest;
use slideway::check;
use slideway::fault::FaultKind;
use slideway::gallery::{self, MODELS};
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Setting, SettingKind, Settings};
use slideway::motion::{SimulateOptions, simulate};
use slideway::report::{Proof, Status};
use slideway::solve::solve;
use std::collections::BTreeSet;

#[test]
fn every_model_is_sound_and_says_what_it_shows() {
    for entry in MODELS {
        assert!(entry.text.starts_with("# "), "{}", entry.name);
        assert!(!entry.summary().is_empty() && !entry.shows().is_empty(), "{}", entry.name);
        let model = Model::parse(entry.text).unwrap_or_else(|faults| panic!("{}: {faults}", entry.name));
        let ready = check(&model).unwrap();
        assert!(ready.is_ready_for("hold") || ready.is_ready_for("solve"), "{}", entry.name);
        if !ready.is_ready_for("solve") {
            continue;
        }
        let report = solve(&model).unwrap_or_else(|faults| panic!("{}: {faults}", entry.name));
        // How contacts at rest start is computed, and the forces of the ladder are open.
        assert!(report.complete == Proof::Proven || !report.at_rest.is_empty(), "{}", entry.name);
        assert!(report.solutions.len() + report.continua.len() > 0, "{}", entry.name);
        assert!(report.solutions.iter().all(|solution| solution.residual < 1e-12), "{}", entry.name);
    }
}

/// Motions of redundant guides and of what has no mass are refused, the joints named, and no others.
#[test]
fn motions_that_are_not_computed_are_refused() {
    for entry in MODELS {
        let model = Model::parse(entry.text).unwrap();
        let mechanism = Mechanism::new(&model).unwrap();
        let motion = simulate(&model, &SimulateOptions::new(1e-3));
        assert_eq!(motion.is_ok(), check(&model).unwrap().is_ready_for("simulate"), "{}", entry.name);
        let Err(faults) = motion else {
            assert!(mechanism.excess.is_empty(), "{}", entry.name);
            continue;
        };
        let kinds: Vec<&FaultKind> = faults.sorted().iter().map(|fault| &fault.kind).collect();
        let is_named = match kinds.as_slice() {
            [FaultKind::SharedLoad { .. }] => !mechanism.excess.is_empty(),
            [FaultKind::MotionWithoutInertia { .. }] => entry.name == "bracket-on-pole",
            _ => false,
        };
        assert!(is_named, "{}: {faults}", entry.name);
    }
}

#[test]
fn every_command_of_the_comments_runs() {
    let mut commands = 0;
    for entry in MODELS {
        for line in entry.text.lines() {
            let Some(command) = line.strip_prefix("#   slideway solve models/") else { continue };
            let (file, arguments) = command.split_once(".toml").expect("a model file");
            assert_eq!(file, entry.name);
            let mut settings = Settings::default();
            let words = words(arguments);
            for pair in words.chunks(2) {
                let kind = match pair[0].as_str() {
                    "--set" => SettingKind::Parameter,
                    "--at" => SettingKind::Position,
                    "--rate" => SettingKind::Rate,
                    other => panic!("{other} in {line}"),
                };
                let (name, value) = pair[1].split_once('=').unwrap();
                settings = settings.with(Setting::new(kind, name, value));
            }
            report_with(&model(entry.name), &settings);
            commands += 1;
        }
    }
    assert!(commands >= 30, "{commands}");
}

/// Words of a command line, with quotes.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for character in text.trim().chars() {
        match character {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            other => words.last_mut().unwrap().push(other),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[rstest]
#[case(&[], 3)]
#[case(&[("F_20", "0"), ("mu_1", "0.6")], 2)]
#[case(&[("F_20", "0"), ("mu_1", "0.45265395")], 1)]
#[case(&[("F_20", "0"), ("mu_1", "0.45265397")], 2)]
#[case(&[("F_20", "0"), ("direction", "-1")], 0)]
#[case(&[("F_20", "0"), ("direction", "-1"), ("mu_1", "0.45265395")], 1)]
fn klepp_2002(#[case] list: &[(&str, &str)], #[case] solutions: usize) {
    assert_eq!(report("klepp-2002", list).solutions.len(), solutions);
}

#[test]
fn painleve_klein_has_one_none_or_two() {
    let count = |list: &[(&str, &str)]| report("painleve-klein", list).solutions.len();
    for direction in ["1", "-1"] {
        for mu in ["0", "0.5", "3.4641"] {
            assert_eq!(count(&[("direction", direction), ("mu", mu)]), 1);
        }
    }
    for mu in ["3.4642", "4", "20"] {
        // The pull on the lower slider, as in the file.
        assert_eq!(count(&[("mu", mu)]), 0);
        assert_eq!(count(&[("mu", mu), ("direction", "-1")]), 2);
        // With the pull on the upper slider it is the other way round.
        let upper = [("mu", mu), ("P_1", "10 N"), ("P_2", "0 N")];
        assert_eq!(count(&upper), 2);
        assert_eq!(count(&[upper[0], upper[1], upper[2], ("direction", "-1")]), 0);
    }
    // (1 + m_1/m_2) cot(phi) for other masses.
    let heavy = [("m_1", "2 kg"), ("mu", "5.196"), ("phi", "30 deg")];
    assert_eq!(count(&heavy), 1);
    assert_eq!(count(&[heavy[0], ("mu", "5.197")]), 0);
}

#[test]
fn painleve_klein_to_the_left_beyond_the_limit() {
    // N = K/[(m_1 + m_2) cot(phi) +- m_2 mu s], a = (P_2 + N cot(phi))/m_2 (reference/README.md).
    let report = report("painleve-klein", &[("mu", "4"), ("direction", "-1")]);
    assert_eq!(report.status, Status::Several);
    for (normal_force, along) in [(-1.339_745_96, 7.679_491_92), (18.660_254_04, 42.320_508_08)] {
        let is_this = |solution: &&slideway::report::Solution| {
            (contact(solution, "upper").normal_force - normal_force).abs() < 1e-8
        };
        let solution = report.solutions.iter().find(is_this).expect("this solution");
        assert!((coordinate_acceleration(solution, "x") - along).abs() < 1e-8);
    }
}

#[test]
fn drawer_jams_beyond_its_limit_whatever_its_height() {
    for h in ["0 m", "0.1 m", "0.7 m", "2 m"] {
        assert_eq!(report("drawer", &[("mu", "0.6666"), ("h", h)]).status, Status::One);
        assert_eq!(report("drawer", &[("mu", "0.6667"), ("h", h)]).status, Status::None);
    }
    // The supported length grows as the drawer goes in: the limit is (L + x)/(2 a).
    let drawer = model("drawer");
    for (x, mu, status) in
        [("0.1", "0.833", Status::One), ("0.1", "0.834", Status::None), ("-0.1", "0.501", Status::None)]
    {
        let settings = parameters(&[("mu", mu)]).position("x", x);
        assert_eq!(report_with(&drawer, &settings).status, status);
    }
    // "The answer is the force that the push needs."
    assert!(only(&report("drawer", &[])).drives[0].effort > 20.0);
}

#[test]
fn cam_follower_jams_as_its_comment_says() {
    assert_eq!(report("cam-follower", &[]).status, Status::One);
    assert_eq!(report("cam-follower", &[("mu", "0.9"), ("d", "0")]).status, Status::None);
    assert_eq!(report("cam-follower", &[("mu", "0.7698"), ("d", "0")]).status, Status::One);
    assert_eq!(report("cam-follower", &[("mu", "0.7699"), ("d", "0")]).status, Status::None);
    // The lower edge of the bushing bears on the side to which the cam pushes.
    assert_eq!(mode(only(&report("cam-follower", &[])), "bushing"), "touching at upper left and lower right");
}

#[test]
fn bracket_on_pole_says_which_motion_lacks_inertia() {
    let faults = solve(&model("bracket-on-pole")).unwrap_err();
    let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
    let FaultKind::MotionWithoutInertia { motion } = &fault.kind else { panic!("{faults}") };
    assert!(motion == "bracket moves along (0, -1)", "{motion}");
}

/// The modes of a joint over a full turn of a coordinate.
fn modes_over_a_turn(name: &str, list: &[(&str, &str)], coordinate: &str, joint: &str) -> BTreeSet<String> {
    let model = model(name).with(&parameters(list)).unwrap();
    let mut modes = BTreeSet::new();
    for step in 0..72 {
        let settings =
            Settings::default().position(coordinate, format!("{} deg", 5.0 * f64::from(step) + 1.0));
        let report = report_with(&model, &settings);
        modes.extend(report.solutions.iter().map(|solution| mode(solution, joint).to_owned()));
    }
    modes
}

#[test]
fn the_piston_lies_flat_or_tips() {
    // The rod is hinged to the middle of the piston, so flat on one side (N_f - N_r) L/2 = mu (N_f + N_r) h/2
    // up to sign: both ends press the same side for mu < L/h (skirt/bore = 0.75), opposite ones beyond.
    let modes = |mu| modes_over_a_turn("slider-crank", &[("mu", mu)], "phi", "cylinder");
    for mu in ["0.1", "0.749"] {
        assert_eq!(Vec::from_iter(modes(mu)), ["flat on the lower guide", "flat on the upper guide"]);
    }
    let tipped = ["touching at lower right and upper left", "touching at upper right and lower left"];
    assert_eq!(Vec::from_iter(modes("0.751")), tipped);
}

#[test]
fn the_pins_friction_tips_the_yoke() {
    // Somewhere in the turn the yoke lies flat with a smooth pin and tips with the rough one.
    let tipped_by_friction = (0..360).filter(|degrees| {
        let at = |mu: &str| {
            let settings = parameters(&[("mu_pin", mu)]).position("phi", format!("{degrees}.5 deg"));
            let report = report_with(&model("scotch-yoke"), &settings);
            mode(only(&report), "yoke").to_owned()
        };
        at("0") == "flat on the lower guide" && at("0.1").starts_with("touching at")
    });
    assert!(tipped_by_friction.count() > 0);
}

#[test]
fn trammel_contacts_load_each_other() {
    let report = report("elliptic-trammel", &[]);
    let eta = &report.influence.eta_positive;
    assert!(eta[0][1].abs() > 1e-3 && eta[1][0].abs() > 1e-3);
    only(&report);
}

#[test]
fn the_sleeve_has_two_freedoms_and_presses_the_opposite_faces() {
    let report = report("sleeve-on-arm", &[]);
    assert_eq!(report.model.degrees_of_freedom, 2);
    let solution = only(&report);
    // Its weight pushes the sleeve down, so the arm pushes it up, with its upper face.
    assert!(normal_forces(solution).iter().all(|n| *n > 0.0));
    assert_eq!(mode(solution, "sleeve"), "flat on the upper face of the guide");
    // Centripetal and Coriolis terms: twice the velocities change the accelerations.
    let faster = report_with(&model("sleeve-on-arm"), &Settings::default().rate("phi", "6").rate("s", "0.5"));
    let (slow, fast) = (acceleration(solution, "sleeve"), acceleration(only(&faster), "sleeve"));
    assert!((slow[0] - fast[0]).hypot(slow[1] - fast[1]) > 1.0);
}

#[test]
fn the_booms_patterns_grow_as_four_to_the_stages() {
    let report = report("telescopic-boom", &[]);
    assert_eq!(report.model.contacts, 6);
    assert_eq!(report.patterns.unwrap().total, 4_u64.pow(3));
    assert!(only(&report).joints.iter().all(|joint| joint.mode.starts_with("touching at ")));
    let retracting = report_with(&model("telescopic-boom"), &parameters(&[("mu", "0.4"), ("v", "-0.1 m/s")]));
    assert_eq!(retracting.complete, Proof::Proven);
}

/// `M = mu R W/((1 + mu^2) cos(beta))`; from `mu = tan(beta)` on the right flank opens, and the left one carries
/// `W cos(beta)`: derived in the book.
#[test]
fn a_shaft_rubs_in_its_v_or_climbs_out() {
    let weight = 3.0 * 9.81;
    for (beta, mu) in [(60.0_f64, 0.2_f64), (60.0, 1.7), (30.0, 0.57), (60.0, 1.8), (30.0, 0.6)] {
        let report = report("shaft-in-v-block", &[("beta", &format!("{beta} deg")), ("mu", &mu.to_string())]);
        let solution = only(&report);
        let (sin, cos) = beta.to_radians().sin_cos();
        let climbs = mu > sin / cos;
        let presses = if climbs { weight * cos } else { weight / ((1.0 + mu * mu) * cos) };
        assert!((solution.drives[0].effort - mu * 0.02 * presses).abs() < 1e-12, "{beta} {mu}");
        assert_eq!(contact(solution, "right").normal_force == 0.0, climbs, "{beta} {mu}");
    }
}

/// Forces of the pads and the acceleration: a prototype with rows of Newton and Euler written by hand, compared with simulations in
/// six degrees of freedom. Without wind and offset `m s'' = F - (W + m g) sin(beta) - mu (N_f + N_r)` in the plane.
#[test]
fn wind_stops_a_boom() {
    let report = report("boom-in-wind", &[]);
    let solution = only(&report);
    let forces = [
        ("front", 1016.1155),
        ("front_right", 546.2692),
        ("rear", -911.7415),
        ("side_front", -271.7995),
        ("side_rear", 121.7995),
    ];
    for (pad, expected) in forces {
        let found = contact(solution, &format!("slide.{pad}")).normal_force;
        assert!((found - expected).abs() < 5e-5, "{pad}: {found}");
    }
    assert!((solution.coordinates[0].acceleration + 0.0897).abs() < 5e-5);
    let calm = report_with(&model("boom-in-wind"), &parameters(&[("wind", "0 N"), ("offset", "0 mm")]));
    assert!((only(&calm).coordinates[0].acceleration - 0.8943).abs() < 5e-5);
}

/// `P = mu_runner W (1 - k y_W)/(1 - k a)` with `k = 2 mu/L`; the rear corner carries `W (1/2 - x_W/L) - P c/L`.
#[test]
fn a_drawer_on_runners_needs_its_pull_and_tips() {
    let weight = 6.116 * 9.81;
    for (a, mu) in [(0.2_f64, 0.3_f64), (0.1, 0.5), (0.25, 0.2)] {
        let k = 2.0 * mu / 0.4;
        let pull = 0.25 * weight * (1.0 - k * 0.07) / (1.0 - k * a);
        let at = |c: f64| {
            let [a, mu, c] = [a, mu, c].map(|value| value.to_string());
            report("drawer-on-runners", &[("a", &a), ("mu", &mu), ("c", &c)])
        };
        let lies = at(0.03);
        assert!((only(&lies).drives[0].effort - pull).abs() < 1e-9, "{a} {mu}");
        let rear = contact(only(&lies), "guide.rear_middle").normal_force;
        assert!((rear - (weight * 0.55 - pull * 0.03 / 0.4)).abs() < 1e-9, "{a} {mu}: {rear}");
        let tips = weight * 0.55 * 0.4 / pull;
        assert!(contact(only(&at(tips * 0.999)), "guide.rear_middle").normal_force > 0.0);
        assert_eq!(contact(only(&at(tips * 1.001)), "guide.rear_middle").normal_force, 0.0);
    }
}

#[test]
fn names_are_unique_and_found() {
    let names: BTreeSet<&str> = MODELS.iter().map(|entry| entry.name).collect();
    assert_eq!(names.len(), MODELS.len());
    assert!(MODELS.iter().all(|entry| gallery::find(entry.name) == Some(entry)));
}
