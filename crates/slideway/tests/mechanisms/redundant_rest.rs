//! Redundant guides at rest: closed forms, limits to determinate mechanisms, and random carriages against linear
//! programs of their own for every state of every contact.
//!
//! Derivations, for the drawer of the gallery: its contacts lie at x = L/2 and -L/2 on rails a distance B apart.
//!
//! *Wedging.* Without any load, play and misalignment let the drawer be tilted by theta. The normal forces of a rail are
//! k theta L/2 at both ends, of opposite signs, so that those of each rail cancel, and their moment is `(N_L + N_R) L`
//! with `N_L / N_R = k_L / k_R`. Friction must balance it: forces along the rails that cancel, each at most
//! `2 mu min(N_L, N_R)`, at the distance B. Hence `mu >= L (k_L + k_R) / (2 B min(k_L, k_R))`.
//!
//! *Toe-in.* Rails bent inwards by eps at the rear press both rear contacts with `k (eps - delta)^+`, where `delta` is the
//! mean of half their plays, so that friction holds at most `2 mu k (eps - delta)^+` of a load along the rails.

use crate::answers::{assert_close, model, parameters};
use crate::random_mechanisms::cases;
use crate::redundant::{Carriage, Pad, carriages};
use proptest::prelude::*;
use rstest::rstest;
use slideway::fault::FaultKind;
use slideway::gallery;
use slideway::limits::rest_limits;
use slideway::model::{Model, Settings};
use slideway::report::{Elasticity, Report, Style};
use slideway::standstill::{HoldOptions, HoldReport, HoldVerdict, Range, Wedging, hold};

const DRAWER: &str = "drawer-on-two-rails";
/// Resistance of the drawer (N).
const Q: f64 = 10.0;
const TIGHT: [(&str, &str); 2] = [("play_left", "0 m"), ("play_right", "0 m")];

const RIGID_RAILS: &str = r#"
[parameters]
play = "0.1 mm"
mu = 0.01
[points]
P = [0, "60 mm"]
Q = [0, 0]
[bodies.c]
points = ["P", "Q"]
mass = 3
centre_of_mass = [0, 0]
moment_of_inertia = 0.01
[joints.l]
type = "block_slider"
block = "c"
at = [0, "100 mm"]
along = 0
length = "80 mm"
mu = "mu"
play = "0.1 mm"
[joints.r]
type = "block_slider"
block = "c"
at = [0, "-100 mm"]
along = 0
length = "80 mm"
mu = "mu"
play = "play"
[coordinates.x]
slide = "l"
[loads.Q]
type = "force"
at = "c.Q"
components = ["-20 N", 0]
[drives.belt]
coordinate = "x"
force = { at = "c.P", direction = 0 }
"#;

fn resting(model: &Model, options: &HoldOptions) -> HoldReport {
    hold(model, options).unwrap_or_else(|faults| panic!("{faults}"))
}

fn drawer(settings: &[(&str, &str)]) -> Model {
    model(DRAWER).with(&parameters(settings)).unwrap_or_else(|faults| panic!("{faults}"))
}

fn wedging(report: &HoldReport) -> &Wedging {
    report.wedging.as_ref().expect("redundant guides")
}

/// The drawer without some lines of its model.
fn without(line: &str) -> String {
    let text = gallery::find(DRAWER).unwrap().text;
    text.lines().filter(|other| !other.starts_with(line)).collect::<Vec<_>>().join("\n")
}

#[rstest]
#[case("50 kN/m", "50 kN/m", "0.4 m", 1.0)]
#[case("150 kN/m", "50 kN/m", "0.4 m", 2.0)]
#[case("50 kN/m", "80 kN/m", "0.4 m", 1.3)]
#[case("50 kN/m", "50 kN/m", "0.1 m", 1.0)]
fn rails_wedge_from_their_closed_form_on(
    #[case] left: &str,
    #[case] right: &str,
    #[case] length: &str,
    // (k_L + k_R) / (2 min(k_L, k_R))
    #[case] by_stiffness: f64,
) {
    let settings = [("k_left", left), ("k_right", right), ("L", length)];
    let length: f64 = length.trim_end_matches(" m").parse().unwrap();
    let threshold = length / 0.6 * by_stiffness;
    // Play and misalignment do not matter.
    for others in [&[][..], &TIGHT, &[("eps", "3 mm")]] {
        let model = drawer(&[&settings, others].concat());
        let report = resting(&model, &HoldOptions::default().vary("mu"));
        assert_close(wedging(&report).threshold.value.unwrap(), threshold, 0.0, 1e-11);
        let possible = |friction: f64| {
            let mu = format!("{}", friction * threshold);
            let report = hold(&model.with(&parameters(&[("mu", &mu)])).unwrap(), &HoldOptions::default());
            report.unwrap().wedging.unwrap().possible
        };
        assert!(!possible(0.9999) && possible(1.0001));
    }
}

/// Wedged, the drawer can hold any load; whether it does depends on how it came to rest, so that it may slide, too.
#[test]
fn a_wedged_drawer_can_hold_anything() {
    let model = drawer(&[("mu", "0.7")]);
    let report = resting(&model, &HoldOptions::default().load("resistance"));
    assert_eq!(report.verdict, HoldVerdict::HoldsOrSlips);
    let load = report.load.as_ref().unwrap();
    assert_eq!(load.held, [Range { least: None, greatest: None }]);
    let reactions = &report.at_rest.as_ref().unwrap().reactions;
    let unbounded = Range { least: None, greatest: None };
    assert!(reactions.contacts.iter().all(|contact| contact.normal_force == unbounded));
    let text = report.text(Style::PLAIN);
    assert!(text.contains("The guides can wedge, from mu = 0.6667 (now 0.7)."), "{text}");
    assert!(text.contains("depends on how it came to rest"), "{text}");
    let below = resting(&drawer(&[("mu", "0.6")]), &HoldOptions::default().load("resistance"));
    let held = &below.load.as_ref().unwrap().held;
    // It floats: nothing presses, and nothing is held.
    assert_eq!(held, &[Range { least: Some(0.0), greatest: Some(0.0) }]);
    assert_eq!(below.releases[0].patterns, ["0000"]);
    assert!(
        below.text(Style::PLAIN).contains("The guides cannot wedge; they could from mu = 0.6667 (now 0.6).")
    );
}

#[rstest]
#[case("0.3", "0.4 mm", "0.2 mm", 0.3e-3)]
#[case("0.6", "0.4 mm", "0.2 mm", 0.3e-3)]
// The mean of the plays counts.
#[case("0.3", "0.4 mm", "0.6 mm", 0.2e-3)]
#[case("0.3", "5 mm", "0.2 mm", 4.9e-3)]
#[case("0.3", "0.1 mm", "0.2 mm", 0.0)]
#[case("0.3", "-0.4 mm", "0.2 mm", 0.3e-3)]
fn rails_that_converge_hold_what_they_clamp(
    #[case] mu: &str,
    #[case] bend: &str,
    #[case] play: &str,
    #[case] beyond: f64,
) {
    let model = drawer(&[("mu", mu), ("eps", bend), ("play_right", play)]);
    let report = resting(&model, &HoldOptions::default().load("resistance"));
    let friction: f64 = mu.parse().unwrap();
    let greatest = 2.0 * friction * 50e3 * beyond / Q;
    let [Range { least: Some(from), greatest: Some(to) }] = report.load.as_ref().unwrap().held[..] else {
        panic!("{:?}", report.load)
    };
    assert_close(from, -greatest, 1.0, 1e-9);
    assert_close(to, greatest, 1.0, 1e-9);
    assert_eq!(report.holds, greatest > 1.0);
}

/// All four shoes of the gate are clamped from where it stays up on: `mu 2 k (lean (2 z + L) - play) = m g`.
#[test]
fn the_gate_stays_up_from_its_closed_form_on() {
    let vary = "z=0 m..3 m".parse().unwrap();
    let report = rest_limits(&model("gate-on-two-posts"), &vary, &HoldOptions::default()).unwrap();
    let [falls, stays] = report.spans.as_slice() else { panic!("{:?}", report.spans) };
    assert_eq!((falls.holds, stays.holds), (Some(false), Some(true)));
    let height = (120.0 * 9.81 / (0.25 * 2.0 * 400e3) + 4e-3) / 2e-3;
    assert_close(stays.from, (height - 1.0) / 2.0, 0.0, 1e-7);
}

/// Two rigid rails at +-B/2 with runners at +-L/2, no transverse load: only tilted does the carriage touch, on both rails if
/// their plays are equal, else on that with less. With the pull P at y = a, the resistance Q in the middle, friction F_l + F_r =
/// Q - P and the forces N_l + N_r = N of the ends, N L = a P + (F_l - F_r) B/2, |F| <= mu 2 N on each rail, so that for equal
/// plays the rail that helps tilting takes all: Q - P = mu 2/L (a P + (Q - P) B/2) below and P - Q = mu 2/L (a P + (P - Q) B/2)
/// above; with the left rail alone the latter is P - Q = mu 2/L (a P - (P - Q) B/2). Wedged, equal rails hold each other
/// from mu = L/B on, unequal ones never.
#[rstest]
#[case("0.1 mm", [19.5 / 0.99, 19.5 / 0.96], Some(0.4))]
#[case("0.4 mm", [19.5 / 0.99, 20.5 / 1.01], None)]
fn rigid_rails_hold_what_their_places_allow(
    #[case] play: &str,
    #[case] pulls: [f64; 2],
    #[case] wedged_from: Option<f64>,
) {
    let model = Model::parse(RIGID_RAILS).unwrap().with(&parameters(&[("play", play)])).unwrap();
    let report = resting(&model, &HoldOptions::default().load("belt"));
    let [Range { least: Some(from), greatest: Some(to) }] = report.load.as_ref().unwrap().held[..] else {
        panic!("{:?}", report.load)
    };
    assert_close(from, pulls[0], 0.0, 1e-9);
    assert_close(to, pulls[1], 0.0, 1e-9);
    assert!(!wedging(&report).possible);
    let threshold = &wedging(&report).threshold;
    assert_eq!(threshold.value.is_some(), wedged_from.is_some());
    if let Some(from) = wedged_from {
        assert_close(threshold.coefficients[0].mu_static[0], from, 0.0, 1e-11);
    }
}

/// Rails that are out of line by more than their play cannot be put together, at rest neither.
#[test]
fn rigid_rails_out_of_line_are_refused() {
    let bent = RIGID_RAILS.replace("play = \"play\"", "play = \"play\"\nfront = { misalignment = \"1 mm\" }");
    let faults = hold(&Model::parse(&bent).unwrap(), &HoldOptions::default()).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::OutOfLine { .. }), "{faults}");
}

/// Without stiffness, play and misalignment only ratios of stiffnesses count.
#[test]
fn equal_stiffness_is_assumed_where_none_is_given() {
    let text = without("stiffness = ");
    let lines = text.lines().filter(|line| !line.starts_with("play = ") && !line.starts_with("rear = "));
    let bare = Model::parse(&lines.collect::<Vec<_>>().join("\n")).unwrap();
    let report = resting(&bare, &HoldOptions::default());
    assert_eq!(report.sharing.as_ref().unwrap().elasticity, Elasticity::Equal);
    let mu = wedging(&report).threshold.coefficients[0].mu_static[0];
    assert_close(mu, 0.4 / 0.6, 0.0, 1e-11);
}

/// Statics needs no masses.
#[test]
fn guides_without_inertia_can_rest() {
    let bent = parameters(&[("eps", "2 mm")]);
    let text = gallery::find(DRAWER).unwrap().text;
    let light =
        ["mass = ", "centre_of_mass = ", "shape = "].into_iter().fold(text.to_owned(), |text, key| {
            text.lines().filter(|line| !line.starts_with(key)).collect::<Vec<_>>().join("\n")
        });
    let light = light.replace("[bodies.drawer]", "[bodies.drawer]\nmassless = true");
    let [heavy, light] = [text.to_owned(), light].map(|text| {
        let model = Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"));
        resting(&model.with(&bent).unwrap(), &HoldOptions::default())
    });
    assert_eq!((heavy.verdict, light.verdict), (HoldVerdict::Holds, HoldVerdict::MayHold));
    assert_eq!(heavy.at_rest, light.at_rest);
}

/// The range of the pull that holds the drawer against its resistance.
fn pulls(model: &Model) -> [f64; 2] {
    let report = resting(model, &HoldOptions::default().load("pull"));
    let [Range { least: Some(from), greatest: Some(to) }] = report.load.as_ref().unwrap().held[..] else {
        panic!("{:?}", report.load)
    };
    [from, to]
}

/// One rail alone, and what is left of the other one as it gives way: the error is of the first order in the ratio of
/// stiffnesses. With much play it is nothing.
#[test]
fn a_rail_that_yields_is_as_if_it_were_not_there() {
    let text = gallery::find(DRAWER).unwrap().text;
    let (before, rest) = text.split_once("[joints.right]").unwrap();
    let (_, after) = rest.split_once("\n\n").unwrap();
    let one = pulls(&Model::parse(&format!("{before}{after}")).unwrap());
    // Pulled at a, held at y_L by 2 mu N with N L = |a P - y_L (P - Q)|: P - Q = 2 mu N, or -2 mu N.
    let [a, y, mu, length] = [0.25, 0.3, 0.3, 0.4];
    for (pull, sign) in one.into_iter().zip([-1.0, 1.0]) {
        let share: f64 = 2.0 * mu / length * sign;
        // P - Q = share (a P - y (P - Q)) as a P > y (P - Q) here
        assert_close(pull, Q * (1.0 + share * y) / (1.0 + share * (y - a)), Q, 1e-9);
    }
    let errors = ["500 N/m", "5 N/m"].map(|stiffness| {
        let both = pulls(&drawer(&[&TIGHT[..], &[("k_right", stiffness)]].concat()));
        (both[1] - one[1]).abs()
    });
    assert!(errors[0] < 0.02 * Q && errors[0] > 0.0, "{errors:?}");
    assert_close(errors[0] / errors[1], 100.0, 1.0, 0.05);
    let far = pulls(&drawer(&[("play_right", "20 mm")]));
    for (found, expected) in far.into_iter().zip(one) {
        assert_close(found, expected, Q, 1e-12);
    }
}

/// `constant + tilt theta + force p >= 0`.
type HalfPlane = [f64; 3];

/// The faces that are pressed in a state: one, or in the third state both of a press fit and none of another fit.
fn pressed(pad: &Pad, state: f64) -> impl Iterator<Item = f64> {
    let both = state == 0.0 && pad.clearance < 0.0;
    [1.0, -1.0].into_iter().filter(move |side| both || *side == state)
}

/// The friction along x that one state of every contact can hold, as a polygon in the tilt and in that friction.
///
/// With the tilt theta, equilibrium across the rails yields the displacement, hence all normal forces. Friction `F_j` of
/// magnitude at most `c_j` acts at the height `y_j`; all `(sum F_j, sum y_j F_j)` fill a polygon with sides along
/// `(1, y_j)`, which holds `(p, a p - c)` if `|(a - y_i) p - c| <= sum_j c_j |y_j - y_i|` for all i and
/// `|p| <= sum_j c_j`.
fn polygon(carriage: &Carriage, states: &[f64]) -> Option<Vec<HalfPlane>> {
    let pads = carriage.contacts.iter().zip(states);
    let closed: f64 =
        pads.clone().map(|(pad, state)| pressed(pad, *state).count() as f64 / pad.compliance).sum();
    if closed == 0.0 {
        return None;
    }
    // sum N = -load: the displacement as a function [constant, slope] of the tilt.
    let plane = |value: [f64; 2]| [value[0], value[1], 0.0];
    let sum = |part: &dyn Fn(&Pad, f64) -> f64| -> f64 {
        pads.clone()
            .flat_map(|(pad, state)| pressed(pad, *state).map(|side| part(pad, side) / pad.compliance))
            .sum()
    };
    let displacement = [
        (carriage.load[1] + sum(&|pad, side| pad.misalignment - side * pad.clearance)) / closed,
        -sum(&|pad, _| pad.x) / closed,
    ];
    let mut sides: Vec<HalfPlane> = Vec::new();
    // Heights of friction, and its limits; the moment of all forces but friction.
    let mut friction: Vec<(f64, [f64; 2])> = Vec::new();
    let mut moment = [carriage.at[0] * carriage.load[1], 0.0];
    for (k, (pad, state)) in pads.enumerate() {
        let (height, half) = carriage.rails[k / carriage.per_rail()];
        let deflection = [displacement[0] - pad.misalignment, displacement[1] + pad.x];
        friction.push((height, [pad.preload, 0.0]));
        for side in [1.0, -1.0] {
            // What presses a face, negative where it is apart.
            let pressure = [-(side * deflection[0] + pad.clearance), -side * deflection[1]]
                .map(|part| part / pad.compliance);
            if !pressed(pad, *state).any(|other| other == side) {
                sides.push(plane(pressure.map(|part| -part)));
                continue;
            }
            sides.push(plane(pressure));
            friction.push((height - side * half, pressure.map(|part| pad.mu * part)));
            (0..2).for_each(|part| moment[part] += pad.x * side * pressure[part]);
        }
    }
    let reach = |weight: &dyn Fn(f64) -> f64| {
        friction.iter().fold([0.0; 2], |[constant, slope], (height, limit)| {
            [constant + weight(*height) * limit[0], slope + weight(*height) * limit[1]]
        })
    };
    let mut within = |factor: f64, value: [f64; 2], limit: [f64; 2]| {
        for sign in [1.0, -1.0] {
            sides.push([limit[0] - sign * value[0], limit[1] - sign * value[1], -sign * factor]);
        }
    };
    for &(height, _) in &friction {
        within(carriage.at[1] - height, moment.map(|part| -part), reach(&|other| (other - height).abs()));
    }
    within(1.0, [0.0; 2], reach(&|_| 1.0));
    Some(sides)
}

/// Least and greatest p of a polygon that is the intersection of half-planes; infinite where it is unbounded.
fn extent(sides: &[HalfPlane]) -> Option<[f64; 2]> {
    // Each in units of its own gradient, tilts in units in which they move normal forces by newtons.
    let scaled: Vec<HalfPlane> = sides
        .iter()
        .map(|[constant, tilt, force]| {
            let size = (tilt * 1e-4).hypot(*force);
            if size > 0.0 {
                [constant / size, tilt * 1e-4 / size, force / size]
            } else {
                [*constant, 0.0, 0.0]
            }
        })
        .collect();
    let holds = |theta: f64, p: f64, factor: f64| {
        scaled.iter().all(|[constant, tilt, force]| {
            let terms = [factor * constant, tilt * theta, force * p];
            let scale = terms.iter().map(|term| term.abs()).fold(1e-6, f64::max);
            terms.iter().sum::<f64>() >= -1e-10 * scale
        })
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    for (index, one) in scaled.iter().enumerate() {
        for other in &scaled[..index] {
            let determinant = one[1] * other[2] - one[2] * other[1];
            if determinant.abs() > 1e-12 {
                found.push([
                    (one[2] * other[0] - one[0] * other[2]) / determinant,
                    (one[0] * other[1] - one[1] * other[0]) / determinant,
                ]);
            }
        }
    }
    found.retain(|[theta, p]| holds(*theta, *p, 1.0));
    let (least, greatest) =
        found.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), [_, p]| {
            (least.min(*p), greatest.max(*p))
        });
    if least > greatest {
        return None;
    }
    let edges = scaled.iter().flat_map(|side| [[side[2], -side[1]], [-side[2], side[1]]]);
    let recedes = edges.filter(|[theta, p]| holds(*theta, *p, 0.0));
    let unbounded: Vec<f64> = recedes.map(|[_, p]| p).collect();
    Some([
        if unbounded.iter().any(|p| *p < -1e-9) { f64::NEG_INFINITY } else { least },
        if unbounded.iter().any(|p| *p > 1e-9) { f64::INFINITY } else { greatest },
    ])
}

/// The forces along the rails that can be held, over all states: a union of intervals.
fn held(carriage: &Carriage) -> Vec<[f64; 2]> {
    let count = carriage.contacts.len();
    let all = 3_usize.pow(u32::try_from(count).unwrap());
    let state =
        |number: usize, k: usize| [1.0, -1.0, 0.0][number / 3_usize.pow(u32::try_from(k).unwrap()) % 3];
    let states = (0..all).map(|number| (0..count).map(|k| state(number, k)).collect::<Vec<f64>>());
    let mut intervals: Vec<[f64; 2]> =
        states.filter_map(|states| extent(&polygon(carriage, &states)?)).collect();
    intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut union: Vec<[f64; 2]> = Vec::new();
    for [least, greatest] in intervals {
        match union.last_mut().filter(|last| least <= last[1] + 1e-7 * last[1].abs().clamp(1.0, 1e9)) {
            Some(last) => last[1] = last[1].max(greatest),
            None => union.push([least, greatest]),
        }
    }
    union
}

/// By how much static friction would have to grow for the guides to wedge: tilted either way without play,
/// misalignment, load and preload, friction alone must take up the moment of the normal forces.
fn wedging_factor(carriage: &Carriage) -> f64 {
    let weights = carriage.contacts.iter().map(|pad| 1.0 / pad.compliance);
    let middle =
        carriage.contacts.iter().zip(weights.clone()).map(|(pad, weight)| weight * pad.x).sum::<f64>()
            / weights.sum::<f64>();
    let tilted = |tilt: f64| {
        let normal = |pad: &Pad| -tilt * (pad.x - middle) / pad.compliance;
        let moment: f64 = carriage.contacts.iter().map(|pad| pad.x * normal(pad)).sum();
        let faces = carriage.contacts.iter().enumerate().map(|(k, pad)| {
            let (height, half) = carriage.rails[k / carriage.per_rail()];
            (height - normal(pad).signum() * half, pad.mu * normal(pad).abs())
        });
        let faces: Vec<(f64, f64)> = faces.collect();
        let reach = |at: f64| faces.iter().map(|(height, limit)| limit * (height - at).abs()).sum::<f64>();
        faces.iter().map(|(at, _)| moment.abs() / reach(*at)).fold(0.0, f64::max)
    };
    tilted(1.0).min(tilted(-1.0))
}

proptest! {
    #![proptest_config(cases(20))]

    /// Two rails or one with three pads, with a force along them that is varied. Some have press fits.
    #[test]
    fn random_carriages_hold_what_their_states_hold(mut carriage in carriages(), fits in 0..7_usize) {
        prop_assume!(carriage.load[1].abs() > 0.1);
        carriage.contacts.iter_mut().skip(fits).step_by(2).for_each(|pad| pad.clearance *= -0.3);
        let push = "[loads.push]\ntype = \"force\"\nat = \"body.load\"\ncomponents = [1, 0]\n";
        let model = Model::parse(&format!("{}{push}", carriage.text())).unwrap();
        let report = resting(&model, &HoldOptions::default().load("push"));
        prop_assert_eq!(report.undecided, 0);
        let end = |end: Option<f64>, infinite: f64| end.map_or(infinite, |end| end + carriage.load[0]);
        let found: Vec<[f64; 2]> = report.load.as_ref().unwrap().held.iter().map(|range| {
            [end(range.least, f64::NEG_INFINITY), end(range.greatest, f64::INFINITY)]
        }).collect();
        let expected = held(&carriage);
        prop_assert_eq!(found.len(), expected.len(), "{:?} {:?}", &found, &expected);
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            let close = found == expected || (found - expected).abs() <= 1e-6 * expected.abs().max(1.0);
            prop_assert!(close, "{} {}", found, expected);
        }
        let (found, expected) = (wedging(&report).threshold.value.unwrap(), wedging_factor(&carriage));
        prop_assert!((found - expected).abs() <= 1e-9 * expected, "{} {}", found, expected);
    }
}

/// The slide of the book grips at both ends with 1 MN/m times 0.02 mm at either face, so that friction at each end is
/// `mu max(|N|, 20 N)`, whatever part of W it carries: nothing tilts a slide whose faces lie in one line.
#[rstest]
#[case("0 N", 4.0)]
#[case("30 N", 4.0)]
#[case("-50 N", 5.0)]
fn a_press_fit_holds_with_its_grip(#[case] across: &str, #[case] friction: f64) {
    let text = include_str!("../../../../docs/src/examples/press-fitted-slide.toml");
    let model = Model::parse(text).unwrap().with(&parameters(&[("W", across), ("a", "0 mm")])).unwrap();
    let report = resting(&model, &HoldOptions::default().load("pull"));
    let [Range { least: Some(from), greatest: Some(to) }] = report.load.as_ref().unwrap().held[..] else {
        panic!("{:?}", report.load)
    };
    assert_close(from, 50.0 - friction, 50.0, 1e-9);
    assert_close(to, 50.0 + friction, 50.0, 1e-9);
    assert_eq!(report.undecided, 0);
}

/// What `hold` says of redundant guides, it says in every form.
#[test]
fn the_report_says_how_the_load_is_shared() {
    let report = resting(&drawer(&[("eps", "2 mm")]), &HoldOptions::default());
    let json: serde_json::Value = serde_json::from_str(&report.json()).unwrap();
    assert_eq!(json["sharing"]["self_stresses"], 2);
    assert_eq!(json["wedging"]["possible"], false);
    let determinate = hold(&model("drawer"), &HoldOptions::default()).unwrap();
    let json: serde_json::Value = serde_json::from_str(&determinate.json()).unwrap();
    assert!(json.get("sharing").is_none() && json.get("wedging").is_none());
    let settings = Settings::default().position("z", "2.5 m");
    let gate = resting(&model("gate-on-two-posts").with(&settings).unwrap(), &HoldOptions::default());
    assert_eq!(gate.at_rest.unwrap().patterns, ["--++"]);
}
