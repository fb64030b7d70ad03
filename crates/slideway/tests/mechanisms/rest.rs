//! Rest over a range and for loads by name, against statics by hand.

use crate::answers::{assert_close, model};
use slideway::fault::FaultKind;
use slideway::limits::{RestLimitsReport, Vary, rest_limits};
use slideway::model::{Model, Settings};
use slideway::report::{Report, Style};
use slideway::standstill::{HoldOptions, hold};

fn over(model: &Model, vary: &str) -> RestLimitsReport {
    let vary: Vary = vary.parse().unwrap();
    rest_limits(model, &vary, &HoldOptions::default()).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The bracket holds from x = B / (2 mu_static) on: B = 152.4 mm, mu_static = 0.25 or x = 304.8 mm.
#[test]
fn a_bracket_holds_from_its_closed_form_on() {
    let bracket = model("bracket-on-pole");
    for (vary, expected) in [("x=0.1 m..0.5 m", 0.3048), ("mu_static=0.2..1", 0.25), ("friction=0.2..3", 1.0)]
    {
        let report = over(&bracket, vary);
        let [slips, holds] = report.spans.as_slice() else { panic!("{vary}: {:?}", report.spans) };
        assert_eq!((slips.holds, holds.holds), (Some(false), Some(true)), "{vary}");
        assert_eq!((slips.to, slips.reason.as_ref()), (holds.from, None));
        assert_close(holds.from, expected, 0.0, 1e-8);
        let text = report.text(Style::PLAIN);
        assert!(text.contains("it does not hold.") && text.contains("it holds."), "{text}");
    }
}

/// Static friction below kinetic friction is not allowed: one stretch without an answer.
#[test]
fn a_stretch_without_an_answer_says_why() {
    let report = over(&model("bracket-on-pole"), "mu_static=0..1");
    let [none, slips, holds] = report.spans.as_slice() else { panic!("{:?}", report.spans) };
    assert_eq!((none.holds, slips.holds, holds.holds), (None, Some(false), Some(true)));
    assert!(none.reason.as_ref().unwrap().contains("below its kinetic one"), "{none:?}");
    assert_close(slips.from, 0.2, 0.0, 1e-12);
}

/// Values are tried 0.5 m apart, of which 0.4 m holds and -0.1 m has no answer: in between it slips from 0.2 m, where the
/// formula of the hook begins, to 0.3048 m.
#[test]
fn what_is_between_two_values_is_told() {
    let bracket = slideway::gallery::find("bracket-on-pole").unwrap().text;
    let hook = bracket.replace("hook = [\"x\", 0]", "hook = [\"x + 0*x*sqrt(x/(1 m) - 0.2)\", 0]");
    let report = over(&Model::parse(&hook).unwrap(), "x=-49.6 m..0.4 m");
    let [none, slips, holds] = report.spans.as_slice() else { panic!("{:?}", report.spans) };
    assert_eq!((none.holds, slips.holds, holds.holds), (None, Some(false), Some(true)));
    assert_eq!((none.to, slips.to), (slips.from, holds.from));
    assert_close(slips.from, 0.2, 0.0, 1e-7);
    assert_close(slips.to, 0.3048, 0.0, 1e-7);
}

/// A slab of 2 kg on an incline: it holds up to tan(beta) = mu_static.
const SLAB: &str = r#"
    gravity = 9.81
    [parameters]
    beta = "20 deg"
    mu_s = 0.5
    [points]
    M = [0, 0]
    [bodies.slab]
    points = ["M"]
    mass = 2
    centre_of_mass = "M"
    moment_of_inertia = 0.1
    [joints.incline]
    type = "block_slider"
    block = "slab"
    at = "M"
    along = "beta"
    length = 0.4
    mu = 0.1
    mu_static = "mu_s"
    [coordinates.s]
    slide = "incline"
"#;

#[test]
fn an_incline_holds_up_to_its_angle_of_friction() {
    let slab = Model::parse(SLAB).unwrap();
    let report = over(&slab, "beta=0 deg..60 deg");
    assert_close(report.spans[0].to, 0.5_f64.atan(), 0.0, 1e-8);
    assert_eq!(report.spans.iter().map(|span| span.holds).collect::<Vec<_>>(), [Some(true), Some(false)]);
}

/// Where the weight is the only load it need not be named; where it is, any multiple of it is held from
/// mu_static = tan(20 deg) on.
#[test]
fn weights_are_a_load() {
    let slab = Model::parse(SLAB).unwrap();
    let options = HoldOptions::default().vary("mu_s");
    let unnamed = hold(&slab, &options).unwrap();
    assert_eq!(unnamed, hold(&slab, &options.clone().load("gravity")).unwrap());
    let load = unnamed.load.unwrap();
    assert_eq!((&*load.name, load.self_locking), ("gravity", true));
    assert_close(load.threshold.value.unwrap(), f64::to_radians(20.0).tan(), 0.0, 1e-11);
    // Twice as steep it slides, however light it is.
    let steep = slab.with(&Settings::default().parameter("beta", "40 deg")).unwrap();
    let load = hold(&steep, &options).unwrap().load.unwrap();
    assert!(!load.self_locking && !load.held.is_empty());
    assert_close(load.held[0].greatest.unwrap(), 0.0, 1.0, 1e-9);
}

#[test]
fn one_of_several_loads_has_to_be_named() {
    let pushed = format!("{SLAB}\n[loads.push]\ntype = \"force\"\nat = \"slab.M\"\ncomponents = [1, 0]\n");
    let faults = hold(&Model::parse(&pushed).unwrap(), &HoldOptions::default().vary("mu_s")).unwrap_err();
    let known = vec!["push".to_owned(), "gravity".to_owned()];
    assert_eq!(faults.sorted()[0].kind, FaultKind::HeldLoadNeeded { known });
    let faults = hold(&model("bracket-on-pole"), &HoldOptions::default().load("gravty")).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::UnknownName { .. }), "{faults}");
}

/// A massless clamp moves the way its load pushes it, whichever way that is.
#[test]
fn what_has_no_inertia_moves_as_its_load_pushes() {
    let bracket = model("bracket-on-pole");
    let slips = |weight: &str| {
        let settings = Settings::default().parameter("x", "0.2 m").parameter("W", weight);
        hold(&bracket.with(&settings).unwrap(), &HoldOptions::default()).unwrap().motions_without_inertia
    };
    assert_eq!(slips("100 N"), ["bracket moves along (0, -1)"]);
    assert_eq!(slips("-100 N"), ["bracket moves along (0, 1)"]);
}

#[test]
fn without_any_answer_the_reason_is_told() {
    let vary: Vary = "B=-2 m..-1 m".parse().unwrap();
    let faults = rest_limits(&model("bracket-on-pole"), &vary, &HoldOptions::default()).unwrap_err();
    assert!(!faults.sorted().is_empty());
}

/// A load on the axis of the pole does not press the bracket against it. Above mu_static = B/d = 0.508 the two ends can
/// press against each other, N B = F d with F = mu_static N: then it is held, but not by its load.
#[test]
fn what_is_wedged_is_not_called_self_locking() {
    let bracket = model("bracket-on-pole");
    let told = |mu_static: &str, x: &str| {
        let settings = Settings::default().parameter("d", "0.3 m").parameter("x", x);
        let bracket = bracket.with(&settings.parameter("mu_static", mu_static)).unwrap();
        let report = hold(&bracket, &HoldOptions::default().load("W")).unwrap();
        let wedging = report.at_rest.as_ref().map(|rest| rest.wedging.join(" "));
        (report.holds, wedging, report.text(Style::PLAIN.width(200)))
    };
    assert!(!told("0.5", "0 m").0);
    let (holds, wedging, text) = told("0.52", "0 m");
    assert_eq!((holds, wedging.as_deref()), (true, Some("sleeve.front sleeve.rear")));
    for sentence in [
        "It can wedge: sleeve.front, sleeve.rear can press against each other without any load, however hard.",
        "Only wedged by a knock it holds any `W` from mu_static = 0.508 (now 0.52).",
        "The moving parts have no mass, so only the forces at rest are examined.",
    ] {
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
    assert!(!text.contains("Self-locking: ") && !text.contains("How it starts to move"), "{text}");
    // Far out the load itself presses: x = 0.4 m > B/(2 mu_static) at mu_static = 0.25.
    let (holds, wedging, text) = told("0.25", "0.4 m");
    assert_eq!((holds, wedging.as_deref()), (true, Some("")));
    assert!(text.contains("Self-locking: it holds any `W` from") && !text.contains("edge"), "{text}");
}

/// 20 N hang on a slide that a preload of 30 N brakes: without the preload it falls.
#[test]
fn what_its_preloads_hold_says_so() {
    let slide = SLAB.replace("mu_static = \"mu_s\"", "mu_static = \"mu_s\"\npreload = \"15 N\"");
    let steep = Settings::default().parameter("beta", "90 deg");
    let held = hold(&Model::parse(&slide).unwrap().with(&steep).unwrap(), &HoldOptions::default()).unwrap();
    assert_eq!(held.at_rest.as_ref().and_then(|rest| rest.without_preloads), Some(false));
    assert!(held.verdict_in_words().contains("Its preloads hold it"), "{}", held.verdict_in_words());
    // On a slope of 20 deg friction would do: tan(20 deg) = 0.36 < 0.5.
    let held = hold(&Model::parse(&slide).unwrap(), &HoldOptions::default()).unwrap();
    assert_eq!(held.at_rest.as_ref().and_then(|rest| rest.without_preloads), Some(true));
    assert!(!held.verdict_in_words().contains("Its preloads hold it"));
}

#[test]
fn the_position_at_rest_is_told() {
    let text = over(&model("bracket-on-pole"), "x=0.1 m..0.5 m").text(Style::PLAIN);
    assert!(text.contains("At rest at z = 0 mm, x from 0.1 to 0.5 m"), "{text}");
}
