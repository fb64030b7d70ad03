//! Whether a hinge turns, and what is not answered for hinges with friction.

use crate::cases::reference;
use serde::Deserialize;
use slideway::fault::{FaultKind, NoSliding};
use slideway::report::{Proof, Status};
use slideway::{Faults, Model, Settings, check, gallery, solve};

/// A slider-crank, drawn with the crank at a right angle to the piston: the rod only shifts there.
fn slider_crank() -> Model {
    Model::parse(&slider_crank_text()).unwrap()
}

fn slider_crank_text() -> String {
    "[points]\nO = [0, 0]\nA = [0, 0.05]\nB = [\"sqrt(0.15^2 - 0.05^2)\", 0]\n\
         [bodies.crank]\npoints = [\"O\", \"A\"]\nmass = 1\nshape = { bar = [\"O\", \"A\"] }\n\
         [bodies.rod]\npoints = [\"A\", \"B\"]\nmass = 0.5\nshape = { bar = [\"A\", \"B\"] }\n\
         [bodies.piston]\npoints = [\"B\"]\nmass = 0.8\nmoment_of_inertia = 0.001\ncentre_of_mass = \"B\"\n\
         [joints.O]\ntype = \"hinge\"\nbetween = [\"crank.O\", \"ground.O\"]\nfriction_radius = 0.003\n\
         [joints.A]\ntype = \"hinge\"\nbetween = [\"rod.A\", \"crank.A\"]\nfriction_radius = 0.002\n\
         [joints.B]\ntype = \"hinge\"\nbetween = [\"rod.B\", \"piston.B\"]\nfriction_radius = 0.002\n\
         [joints.cylinder]\ntype = \"block_slider\"\nblock = \"piston\"\nat = \"B\"\nalong = 0\nlength = 0.06\nmu = 0.1\n\
         [loads.gas]\ntype = \"force\"\nat = \"piston.B\"\ncomponents = [-1000, 0]\n\
         [coordinates.phi]\nrotation = \"crank\"\nrate = 60\n"
        .to_owned()
}

/// Where the spin of a hinge passes through zero, friction has the sense of what follows.
#[test]
fn a_hinge_that_just_turns_back_has_the_friction_of_what_follows() {
    let at = |angle: &str| {
        let report =
            solve(&slider_crank().with(&Settings::default().position("phi", angle)).unwrap()).unwrap();
        assert_eq!(report.solutions.len(), 1);
        (report.solutions[0].hinges[2].clone(), report.complete, report.open)
    };
    let [before, here, after] = ["-1e-6", "0", "1e-6"].map(at);
    let couple = |hinge: &slideway::report::Hinge| hinge.friction.unwrap().couple;
    assert!(couple(&before.0) * couple(&after.0) < 0.0);
    assert!((couple(&here.0) / couple(&after.0) - 1.0).abs() < 1e-4);
    assert_eq!(before.1, Proof::Proven);
    // That it is zero exactly is not proven by bounds.
    assert_eq!(here.1, Proof::NotProven);
    assert!(here.2[0].contains("the sense in which B turns is not certain"), "{:?}", here.2);
}

/// A check finds whatever is refused: hinges at rest, also without any sliding joint, several hinges that never turn.
#[test]
fn a_check_finds_what_is_refused() {
    let crank = slider_crank_text();
    let four_bar = gallery::find("four-bar").unwrap().text;
    let at_rest = four_bar.replace("rate = \"10 rad/s\"", "rate = 0");
    assert_ne!(four_bar, at_rest);
    let texts = [crank.replace("rate = 60", "rate = 0"), at_rest, two_that_never_turn().to_owned()];
    for text in texts {
        let model = Model::parse(&text).unwrap();
        let refused = solve(&model).unwrap_err();
        let report = check::check(&model).unwrap();
        assert!(!report.sound);
        for fault in refused.sorted() {
            let found = |finding: &check::Finding| finding.message == fault.kind.to_string();
            assert!(report.findings.iter().any(found), "{}: {:?}", fault.kind, report.findings);
        }
    }
    // One hinge that never turns is answered.
    for model in [slider_crank(), klepp(0.3, 0.01)] {
        assert_eq!(check::check(&model).unwrap().findings, []);
        assert!(solve(&model).is_ok());
    }
}

/// What turns at rest may hold.
#[test]
fn a_hinge_at_rest_is_referred_to_standstill() {
    let at_rest = Settings::default().rate("phi", 0.0);
    let model = Model::parse(gallery::find("four-bar").unwrap().text).unwrap().with(&at_rest).unwrap();
    let faults = solve(&model).unwrap_err();
    assert!(matches!(why(&faults).1, NoSliding::AtRest(_)), "{faults}");
    let hint = faults.sorted()[0].kind.hint().unwrap();
    assert!(hint.starts_with("`slideway hold` says whether it can stay at rest"), "{hint}");
}

fn why(faults: &Faults) -> (String, NoSliding) {
    match &faults.sorted()[0].kind {
        FaultKind::HingeDoesNotTurn { hinge, why } => (hinge.clone(), why.clone()),
        other => panic!("{other:?}"),
    }
}

#[derive(Deserialize)]
struct File {
    klepp_hinge: Vec<Klepp>,
}

#[derive(Deserialize)]
struct Klepp {
    mu_1: f64,
    r: f64,
    ranges: Vec<Range>,
}

#[derive(Deserialize)]
struct Range {
    sides: Vec<i32>,
    #[serde(rename = "M")]
    couples: [f64; 2],
    #[serde(rename = "N_lo")]
    least: Vec<f64>,
    #[serde(rename = "N_hi")]
    greatest: Vec<f64>,
}

fn klepp(mu: f64, radius: f64) -> Model {
    let text = gallery::find("klepp-2002").unwrap().text;
    let rough =
        text.replacen("type = \"hinge\"", &format!("type = \"hinge\"\nfriction_radius = {radius:?}"), 1);
    assert_ne!(rough, text);
    let settings = Settings::default().parameter("F_20", 0.0).parameter("mu_1", mu).parameter("g", 1.0);
    Model::parse(&rough).unwrap().with(&settings).unwrap()
}

/// The lower hinge of Klepp's bar never turns, as the bar only shifts: the answer is a range of its couple.
#[test]
fn a_hinge_that_never_turns_leaves_a_range() {
    let File { klepp_hinge } = reference();
    for case in klepp_hinge {
        let report = solve(&klepp(case.mu_1, case.r)).unwrap();
        assert_eq!(report.status, Status::Continuum);
        assert_eq!(report.complete, Proof::NotProven);
        assert_eq!(report.continua.len(), case.ranges.len(), "{:?}", report.continua);
        for (found, expected) in report.continua.iter().zip(&case.ranges) {
            let signs: Vec<i32> =
                found.pattern.chars().map(|sign| if sign == '+' { 1 } else { -1 }).collect();
            assert_eq!(signs, expected.sides);
            let couple = found.couple.as_ref().unwrap();
            assert_eq!(couple.hinge, "A");
            let ends = [&expected.least, &expected.greatest];
            for (end, normal_forces) in ends.into_iter().enumerate() {
                assert!((couple.couples[end] - expected.couples[end]).abs() < 1e-11, "{couple:?}");
                for (found, expected) in found.vertices[end].iter().zip(normal_forces) {
                    assert!((found - expected).abs() < 1e-11, "{found} instead of {expected}");
                }
            }
        }
    }
}

/// With great friction the paper's example has two solutions; both become ranges of `N_1`, which the theory has to
/// three digits.
#[test]
fn both_solutions_of_the_paper_become_ranges() {
    let report = solve(&klepp(0.6, 0.01)).unwrap();
    let mut ranges: Vec<[f64; 2]> =
        report.continua.iter().map(|one| [one.vertices[0][0], one.vertices[1][0]]).collect();
    ranges.iter_mut().for_each(|range| range.sort_by(f64::total_cmp));
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(ranges.len(), 2, "{ranges:?}");
    let expected = [[(-2.34, 0.005), (-1.53, 0.005)], [(0.248, 0.0005), (0.277, 0.0005)]];
    for (value, (expected, half_a_digit)) in ranges.iter().flatten().zip(expected.into_iter().flatten()) {
        assert!((value - expected).abs() <= half_a_digit, "{value} instead of {expected}");
    }
}

/// Two hinges that never turn are one too many.
#[test]
fn several_hinges_that_never_turn_are_named() {
    let faults = solve(&Model::parse(two_that_never_turn()).unwrap()).unwrap_err();
    assert_eq!(why(&faults), ("C".to_owned(), NoSliding::Never));
    assert_eq!(faults.sorted().len(), 2);
    assert!(faults.sorted()[0].kind.hint().unwrap().contains("anything up to r |R|"));
}

fn two_that_never_turn() -> &'static str {
    "[points]\nA = [0, 0]\nB = [1, 0]\nC = [0, 1]\nD = [1, 1]\n\
         [bodies.one]\npoints = [\"A\", \"C\"]\nmass = 1\nshape = { bar = [\"A\", \"C\"] }\n\
         [bodies.two]\npoints = [\"C\", \"D\"]\nmass = 1\nshape = { bar = [\"C\", \"D\"] }\n\
         [bodies.three]\npoints = [\"D\", \"B\"]\nmass = 1\nshape = { bar = [\"B\", \"D\"] }\n\
         [joints.C]\ntype = \"hinge\"\nbetween = [\"one.C\", \"two.C\"]\nfriction_radius = 0.01\n\
         [joints.D]\ntype = \"hinge\"\nbetween = [\"two.D\", \"three.D\"]\nfriction_radius = 0.01\n\
         [joints.rail]\ntype = \"guided_slider\"\nblock = \"one\"\nat = \"A\"\nalong = 0\nlength = 1\nmu = 0.1\n\
         [joints.slot]\ntype = \"guided_slider\"\nblock = \"three\"\nat = \"B\"\nalong = 0\nlength = 1\nmu = 0.1\n\
         [loads.weight]\ntype = \"force\"\nat = \"two.D\"\ncomponents = [0, -1]\n\
         [coordinates.x]\nslide = \"rail\"\nrate = 1\n"
}

#[test]
fn at_rest_friction_has_no_sense() {
    let model = slider_crank().with(&Settings::default().rate("phi", "0")).unwrap();
    // The sliders say so first.
    let faults = solve(&model).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::ZeroSlidingVelocity { .. }));
    let smooth = "mu = 0\nfriction_radius";
    let pendulum = format!(
        "[points]\nO = [0, 0]\n[bodies.bar]\npoints = [\"O\"]\nmass = 1\nmoment_of_inertia = 0.02\ncentre_of_mass = [0.1, 0]\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\n{} = 0.01\n[coordinates.phi]\nrotation = \"bar\"\n",
        &smooth[7..]
    );
    let faults = solve(&Model::parse(&pendulum).unwrap()).unwrap_err();
    assert_eq!(why(&faults), ("pin".to_owned(), NoSliding::AtRest(vec!["phi".to_owned()])));
}
