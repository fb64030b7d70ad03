//! Why a contact with friction does not slide: the advice that follows differs.

use crate::answers::{assert_close, model, try_report_on};
use slideway::fault::{FaultKind, NoSliding};
use slideway::gallery;
use slideway::model::Settings;
use slideway::report::{OpenRange, SolveReport, Status};
use slideway::solve::solve;

fn why(name: &str, settings: &Settings) -> NoSliding {
    let faults = solve(&model(name).with(settings).unwrap()).unwrap_err();
    reason(&faults)
}

fn reason(faults: &slideway::fault::Faults) -> NoSliding {
    let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
    let FaultKind::ZeroSlidingVelocity { why, .. } = &fault.kind else { panic!("{faults}") };
    assert_eq!(fault.kind.hint().unwrap().contains("`slideway hold`"), *why != NoSliding::Here);
    why.clone()
}

#[test]
fn a_mechanism_at_rest_is_told_from_a_joint_without_motion() {
    let at_rest = Settings::default().rate("x", 0);
    assert_eq!(why("drawer", &at_rest), NoSliding::AtRest(vec!["x".to_owned()]));
    // The second stage slides in the first one with s_2 alone.
    let one = Settings::default().rate("s_2", 0);
    assert_eq!(why("telescopic-boom", &one), NoSliding::WithoutRate(vec!["s_2".to_owned()]));
}

/// At its dead centre (phi = 0) the piston stands still while the crank turns.
#[test]
fn at_a_dead_centre_sliding_just_reverses() {
    assert_eq!(why("slider-crank", &Settings::default().position("phi", "0 deg")), NoSliding::Here);
}

/// A flap hinged to the drawer, with a pin in a slot of the drawer that points to the hinge: the pin stays at its
/// distance from the hinge, so it never slides: it stands while the drawer moves.
#[test]
fn a_pin_that_no_motion_moves_in_its_slot_never_slides() {
    let text = gallery::find("drawer").unwrap().text;
    let flap = r#"
[bodies.flap]
points = ["handle", "latch"]
mass = "1 kg"
shape = { bar = ["handle", "latch"] }

[joints.hinge]
type = "hinge"
between = ["flap.handle", "drawer.handle"]

[joints.latch]
type = "pin_in_slot"
block = "flap"
guide = "drawer"
at = "latch"
along = "0 deg"
mu = 0.2
"#;
    let text = text
        .replace("mouth = [", "latch = [\"L/2\", \"a\"]\nmouth = [")
        .replace("[loads.", &format!("{flap}\n[loads."));
    // Nothing presses it there, so that its friction holds nothing, and the drawer moves as without.
    let report = try_report_on(&text).unwrap();
    assert_eq!((report.status, report.solutions.len()), (Status::One, 1));
    let smooth = try_report_on(&text.replace("mu = 0.2", "mu = 0")).unwrap();
    let effort = |report: &SolveReport| report.solutions[0].drives[0].effort;
    assert_close(effort(&report), effort(&smooth), 1.0, 1e-12);
    // Pressed by 10 N it may carry up to 2 N, which no other joint feels but the hinge.
    let pressed =
        format!("{text}\n[loads.press]\ntype = \"force\"\nat = \"flap.latch\"\ncomponents = [0, 10]\n");
    let report = try_report_on(&pressed).unwrap();
    let open = report.undetermined.unwrap();
    let [friction] = open.friction.as_slice() else { panic!("one slot") };
    assert_eq!((report.status, &*friction.name), (Status::Continuum, "latch"));
    assert_close(friction.to.unwrap(), 2.0, 1.0, 1e-9);
    assert!(open.efforts.iter().all(OpenRange::is_one_value));
}
