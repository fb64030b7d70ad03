//! Impacts on several stops, and with friction at several joints, against impulses by hand.

use super::mechanism_of;
use super::models::{block, stacked, with_stop};
use crate::configuration::Configuration;
use crate::ids::JointId;
use crate::model::Model;
use crate::motion::decision::{Impact, impact};
use crate::motion::{Cause, End, History, SimulateOptions, simulate};
use std::fmt::Write as _;

fn run(text: &str, duration: f64) -> History {
    simulate(&Model::parse(text).unwrap(), &SimulateOptions::new(duration)).unwrap()
}

/// The impact of joints, by their names, with these coefficients of restitution, in the state of a model.
pub(super) fn impact_of(text: &str, stops: &[(&str, f64)]) -> Impact {
    let mechanism = mechanism_of(text);
    let configuration = Configuration::new(&mechanism).unwrap();
    let joint = |name: &str| mechanism.joints.iter().position(|joint| &*joint.name == name).map(JointId);
    let stops: Vec<(JointId, f64)> = stops.iter().map(|(name, e)| (joint(name).unwrap(), *e)).collect();
    impact(&mechanism, &configuration, &stops).unwrap()
}

pub(super) fn impulses(impact: &Impact) -> Vec<f64> {
    impact.blows.iter().flat_map(|blow| blow.stops.iter().map(|(_, impulse)| *impulse)).collect()
}

pub(super) fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (one, other) in found.iter().zip(expected) {
        assert!((one - other).abs() <= tolerance, "{found:?} {expected:?}");
    }
}

/// Two blocks that do not know of each other and reach their stops at the same instant: each as if alone.
#[test]
fn independent_joints_reach_their_stops_together() {
    let one = with_stop(&block("0.1", "value = 0.1\nrate = 2", ""), "{ restitution = 0.5 }");
    let other = one[one.find("[bodies.block]").unwrap()..]
        .replace("bodies.block", "bodies.other")
        .replace("joints.guide", "joints.rail")
        .replace("block = \"block\"", "block = \"other\"")
        .replace("coordinates.x", "coordinates.y")
        .replace("slide = \"guide\"", "slide = \"rail\"")
        .replace("restitution = 0.5", "restitution = 0.8");
    let both = run(&(one.clone() + &other), 1.5);
    assert_eq!(both.end, End::Finished);
    let hits = |history: &History| -> Vec<(f64, f64)> {
        let energy = |cause: &Cause| match cause {
            Cause::Hits { energy_lost, .. } => *energy_lost,
            _ => None,
        };
        let events = history.events.iter();
        events
            .flat_map(|event| event.causes.iter().filter_map(energy).map(|lost| (event.time, lost)))
            .collect()
    };
    let found = both.reader().at(1.5).unwrap().configuration.clone();
    for (index, restitution) in [0.5, 0.8].into_iter().enumerate() {
        let alone = run(&one.replace("restitution = 0.5", &format!("restitution = {restitution}")), 1.5);
        let expected = alone.reader().at(1.5).unwrap().configuration.clone();
        assert!((found.coordinates[index] - expected.coordinates[0]).abs() < 1e-9);
        assert!((found.rates[index] - expected.rates[0]).abs() < 1e-9);
        let ((time, lost), (when, energy)) = (hits(&both)[index], hits(&alone)[0]);
        assert!((time - when).abs() < 1e-9 && (lost - energy).abs() < 1e-9, "{lost} {energy}");
    }
    assert!(both.energy_error < 1e-8, "{:e}", both.energy_error);
}

/// A slab of 3 kg reaches its stop at 2 m/s and in the same instant a block of 2 kg on it, 1 m/s faster,
/// reaches the stop on the slab. With e = 0.5 for both the slab goes on with -1 m/s, the block against it
/// with -0.5 m/s: the block's velocity changes by -4.5 m/s, so that its stop gives 9 N s, and that of the
/// slab 9 + 3*3 = 18 N s. With other coefficients likewise.
#[test]
fn stops_of_joints_in_a_row_act_together() {
    let stop = "mu = 0.2\ntravel = [\"-3 m\", \"0 m\"]\nstop = { restitution = 0.5 }";
    let text = stacked([stop, stop], ["2 m/s", "1 m/s"], "");
    for [e, d] in [[0.5, 0.5], [0.0, 0.5], [0.5, 0.0], [0.0, 0.0], [1.0, 0.25]] {
        let found = impact_of(&text, &[("below", e), ("between", d)]);
        close(&found.after.rates, &[-2.0 * e, -d], 1e-12);
        let upper = 2.0 * (2.0 * (1.0 + e) + 1.0 + d);
        close(&impulses(&found), &[upper + 3.0 * 2.0 * (1.0 + e), upper], 1e-9);
        let energy = |[x, s]: [f64; 2]| 1.5 * x * x + (x + s) * (x + s);
        let lost = energy([2.0, 1.0]) - energy([-2.0 * e, -d]);
        assert!((found.blows[0].energy_lost - lost).abs() < 1e-9);
    }
    let history = run(&text.replace("rate = \"2 m/s\"", "rate = \"2 m/s\"\nvalue = \"0 m\""), 0.2);
    assert_eq!(history.end, End::Finished);
}

/// The block comes the other way, -1 m/s against the slab, to a stop at its rear: when the slab is thrown
/// back it goes away from that stop by itself, which therefore gives no impulse: the slab has -1 m/s, the
/// block keeps 2 - 1 = 1 m/s, 2 m/s against the slab.
#[test]
fn a_stop_from_which_a_joint_is_taken_gives_no_impulse() {
    let below = "mu = 0.2\ntravel = [\"-3 m\", \"0 m\"]\nstop = { restitution = 0.5 }";
    let between = "mu = 0.2\ntravel = [\"0 m\", \"3 m\"]\nstop = { restitution = 0.5 }";
    let found =
        impact_of(&stacked([below, between], ["2 m/s", "-1 m/s"], ""), &[("below", 0.5), ("between", 0.5)]);
    close(&found.after.rates, &[-1.0, 2.0], 1e-12);
    close(&impulses(&found), &[9.0, 0.0], 1e-9);
}

/// A bar of 4 kg that slides along x on two pins and reaches two stops at once: it comes back at the greater
/// of both restitutions, whose stop then gives all of the impulse; with equal ones only the sum of both is
/// determined.
#[test]
fn a_body_reaches_two_parallel_stops() {
    let text = r#"
[points]
A = [1, 1]
B = [-1, -1]
[bodies.bar]
points = ["A", "B"]
mass = "4 kg"
centre_of_mass = [0, 0]
moment_of_inertia = "1 kg m^2"
[joints.upper]
type = "pin_in_slot"
block = "bar"
at = "A"
along = 0
mu = 0.3
travel = ["-1 m", "0.5 m"]
stop = { restitution = 0.25 }
[joints.lower]
type = "pin_in_slot"
block = "bar"
at = "B"
along = 0
mu = 0.3
travel = ["-1 m", "0.5 m"]
stop = { restitution = 0.25 }
[coordinates.x]
slide = "lower"
rate = "2 m/s"
"#;
    let history = run(text, 0.5);
    assert_eq!(history.end, End::Finished, "{:#?}", history.events);
    let hits = history.events[1].causes.iter().filter(|cause| matches!(cause, Cause::Hits { .. })).count();
    assert_eq!(hits, 2, "{:#?}", history.events);
    assert!((history.reader().at(0.5).unwrap().configuration.rates[0] + 0.5).abs() < 1e-9);
    assert!((history.impulses[0].energy - 8.0 * (1.0 - 0.0625)).abs() < 1e-9);
    let at_the_stops =
        text.replace("rate = \"2 m/s\"", "rate = \"2 m/s\"\nvalue = \"0.5 m\"").replace("mu = 0.3", "mu = 0");
    let found = impact_of(&at_the_stops, &[("upper", 0.25), ("lower", 0.25)]);
    assert!((impulses(&found).iter().sum::<f64>() - 4.0 * 2.0 * 1.25).abs() < 1e-9, "{found:?}");
    let found = impact_of(&at_the_stops, &[("upper", 0.25), ("lower", 0.75)]);
    close(&found.after.rates, &[-1.5], 1e-12);
    close(&impulses(&found), &[0.0, 4.0 * 2.0 * 1.75], 1e-9);
}

/// Two sliders joined by a massless rod, as in a trammel; more of the upright one.
pub(super) fn trammel(mu: f64, upright: &str) -> String {
    format!(
        r#"
[points]
A = [0.8, 0]
B = [0, 0.6]
[bodies.a]
points = ["A"]
mass = "1 kg"
centre_of_mass = "A"
moment_of_inertia = "1 kg m^2"
[bodies.b]
points = ["B"]
mass = "2 kg"
centre_of_mass = "B"
moment_of_inertia = "1 kg m^2"
[bodies.rod]
points = ["A", "B"]
massless = true
[joints.level]
type = "guided_slider"
block = "a"
at = "A"
along = 0
length = "0.1 m"
mu = {mu:?}
travel = ["-0.5 m", "0 m"]
stop = {{ restitution = 0.5 }}
[joints.upright]
type = "guided_slider"
block = "b"
at = "B"
along = "90 deg"
length = "0.1 m"
mu = {mu:?}
{upright}
[joints.to_a]
type = "hinge"
between = ["rod.A", "a.A"]
[joints.to_b]
type = "hinge"
between = ["rod.B", "b.B"]
[coordinates.x]
slide = "level"
rate = "3 m/s"
"#
    )
}

/// Two sliders joined by a massless rod, as in a trammel: a of 1 kg at (L c, 0) on a level guide, b of 2 kg
/// at (0, L s) on an upright one, friction mu at both. Compression S of the rod presses a down with S s and b
/// to the left with S c. While a moves outwards and b down friction at b helps S and friction at a helps the
/// stop; with v' = -1 for a and c/s for b
///
/// ```text
/// m_b c/s = S (s + mu c)      P_1 = m_a + S (c - mu s)
/// ```
///
/// for each m/s until a stands, and afterwards, both moving the other way, with the opposite sign of mu. P =
/// v P_1(mu) + e v P_1(-mu). The stop takes the work v^2 P_1(mu)/2 and returns e^2 v^2 P_1(-mu)/2, which is no more if
/// e^2 <= P_1(mu)/P_1(-mu): with mu = 0.6 the way back ends earlier.
#[test]
fn friction_acts_at_both_ends_of_a_rod() {
    let (c, s, v, greatest) = (0.8, 0.6, 3.0, 0.5);
    for mu in [0.0, 0.1, 0.3, 0.6] {
        let of_unit = |mu: f64| 1.0 + 2.0 * (c / s) * (c - mu * s) / (s + mu * c);
        let bound = (of_unit(mu) / of_unit(-mu)).sqrt();
        assert_eq!(bound < greatest, mu == 0.6);
        let e = bound.min(greatest);
        let found = impact_of(&trammel(mu, ""), &[("level", greatest)]);
        close(&impulses(&found), &[v * of_unit(mu) + e * v * of_unit(-mu)], 1e-9);
        close(&found.after.rates, &[-e * v], 1e-12);
        let kinetic = 0.5 * (1.0 + 2.0 * (c / s) * (c / s)) * v * v;
        assert!((found.blows[0].energy_lost - kinetic * (1.0 - e * e)).abs() < 1e-9);
    }
    // With mu > s/c friction at b holds the rod: it is strut enough that a cannot come back, and stops.
    let found = impact_of(&trammel(0.8, ""), &[("level", greatest)]);
    close(&found.after.rates, &[0.0], 1e-12);
    close(&impulses(&found), &[v * (1.0 + 2.0 * (c / s) * (c - 0.8 * s) / (s + 0.8 * c))], 1e-9);
}

/// The same with a stop for b, too, reached at the same instant. Both velocities hang together, so that the
/// greater restitution wins and the other stop gives no impulse. While b is stopped the rod pulls with T at
/// a, which friction helps until a stands:
///
/// ```text
/// m_a = T (c + mu s)      P_1 = m_b c/s + T (s - mu c)      P = v P_1(mu) + e v P_1(-mu)
/// ```
#[test]
fn of_two_coupled_stops_the_one_with_the_greater_restitution_pushes() {
    let (c, s, v, e) = (0.8, 0.6, 3.0, 0.5);
    for mu in [0.0, 0.1, 0.3] {
        let text = trammel(mu, "travel = [\"0 m\", \"0.5 m\"]\nstop = { restitution = 0.5 }");
        let of_unit = |mu: f64| 2.0 * c / s + (s - mu * c) / (c + mu * s);
        let found = impact_of(&text, &[("level", 0.2), ("upright", e)]);
        close(&impulses(&found), &[0.0, v * of_unit(mu) + e * v * of_unit(-mu)], 1e-9);
        close(&found.after.rates, &[-e * v], 1e-12);
        // With the same restitution only the motion is determined.
        close(&impact_of(&text, &[("level", e), ("upright", e)]).after.rates, &[-e * v], 1e-12);
    }
}

/// A carriage of mass M on a level guide and two drawers of mass m on it, one upside down above the other,
/// with these keys of their joints; their mass centres are `c` away from their rails, on opposite sides.
fn carriage(masses: [f64; 2], c: f64, drawers: [&str; 2], rates: [f64; 3]) -> String {
    let mut text = format!(
        r#"
[points]
C = [0, 0]
R_1 = [0, 0.5]
R_2 = [0, -0.5]
S_1 = [0, {}]
S_2 = [0, {}]
[bodies.carriage]
mass = {}
centre_of_mass = "C"
moment_of_inertia = 1
[joints.wheels]
type = "block_slider"
block = "carriage"
at = "C"
along = 0
length = 4
mu = 0
[coordinates.x]
slide = "wheels"
rate = {}
"#,
        0.5 + c,
        -0.5 - c,
        masses[0],
        rates[0]
    );
    for (index, joint) in drawers.iter().enumerate() {
        let number = index + 1;
        write!(
            text,
            r#"
[bodies.drawer_{number}]
mass = {}
centre_of_mass = "S_{number}"
moment_of_inertia = 1
[joints.rail_{number}]
type = "block_slider"
block = "drawer_{number}"
guide = "carriage"
at = "R_{number}"
along = 0
length = 0.5
{joint}
[coordinates.s_{number}]
slide = "rail_{number}"
rate = {}
"#,
            masses[1], rates[number]
        )
        .unwrap();
    }
    text
}

/// Two drawers of mass m reach stops on their carriage of mass M at the same instant. Without friction the
/// impulses P_1, P_2 push the drawers back and the carriage on; with v_i the velocities of the drawers
/// against it
///
/// ```text
/// -dv_1 = (1/m + 1/M) P_1 + 1/M P_2        -dv_2 = 1/M P_1 + (1/m + 1/M) P_2
/// 0 <= P_i    complementary to    -v_i' - e_i v_i >= 0        v_i' = v_i + dv_i
/// ```
///
/// With both pushing P_1 = m ((1 + m/M) a_1 - m/M a_2)/(1 + 2 m/M), a_i = (1 + e_i) v_i, and likewise P_2.
/// Where that is negative for the second, the carriage is taken away from it fast enough by the first: P_1 =
/// a_1/(1/m + 1/M), P_2 = 0.
#[test]
fn two_drawers_on_a_carriage_reach_their_stops_together() {
    let stop = "mu = 0\ntravel = [-3, 0]\nstop = { restitution = 0 }";
    let mut alone = 0;
    for (large, m) in [(1.0, 4.0), (5.0, 2.0), (0.5, 8.0)] {
        for (v, e) in [([2.0, 2.0], [0.5, 0.5]), ([2.0, 2.0], [1.0, 0.0]), ([1.0, 3.0], [0.2, 0.9])] {
            let found = impact_of(
                &carriage([large, m], 0.0, [stop, stop], [0.7, v[0], v[1]]),
                &[("rail_1", e[0]), ("rail_2", e[1])],
            );
            let a = [0, 1].map(|i: usize| (1.0 + e[i]) * v[i]);
            let together = |own: f64, other: f64| {
                m * ((1.0 + m / large) * own - m / large * other) / (1.0 + 2.0 * m / large)
            };
            let mut expected = [together(a[0], a[1]), together(a[1], a[0])];
            for i in 0..2 {
                if expected[1 - i] < 0.0 {
                    alone += 1;
                    expected[1 - i] = 0.0;
                    expected[i] = a[i] / (1.0 / m + 1.0 / large);
                    assert!(expected[i] / large - v[1 - i] >= e[1 - i] * v[1 - i]);
                    break;
                }
            }
            let pushed = (expected[0] + expected[1]) / large;
            let after = [0, 1].map(|i: usize| v[i] - expected[i] / m - pushed);
            close(&impulses(&found), &expected, 1e-9);
            close(&found.after.rates, &[0.7 + pushed, after[0], after[1]], 1e-9);
        }
    }
    assert!(alone >= 3, "{alone}");
}

/// The same with friction: the mass centres of the drawers are c from their rails, so that the front and rear
/// contacts, L apart, are pressed by m |dv| c/L each while a drawer is slowed down by dv. With kappa = 2 mu
/// c/L friction kappa m |dv| helps the stop until the drawer stands, and works against it while it comes
/// back:
///
/// ```text
/// P = m v/(1 + 2 m/M) ((1 - kappa) + e (1 + kappa))
/// ```
///
/// because with equal drawers (and by symmetry no moment on the carriage) m dv = -m v/(1 + 2 m/M) until they
/// stand. The stops take work in proportion to 1 - kappa and return e^2 (1 + kappa), which is no more if e^2 <= (1 - kappa)/(1 +
/// kappa): with mu = 1 the way back ends earlier.
#[test]
fn friction_acts_while_two_equal_drawers_are_stopped() {
    let (large, m, c, v, e) = (3.0, 2.0, 0.2, 1.5, 0.6);
    for mu in [0.0, 0.2, 0.5, 1.0] {
        let stop = format!("mu = {mu:?}\ntravel = [-3, 0]\nstop = {{ restitution = {e} }}");
        let text = carriage([large, m], c, [&stop, &stop], [0.0, v, v]);
        let found = impact_of(&text, &[("rail_1", e), ("rail_2", e)]);
        let kappa = 2.0 * mu * c / 0.5;
        let bound = ((1.0 - kappa) / (1.0 + kappa)).sqrt();
        assert_eq!(bound < e, mu == 1.0);
        let e = bound.min(e);
        let reduced = m / (1.0 + 2.0 * m / large);
        let impulse = reduced * v * ((1.0 - kappa) + e * (1.0 + kappa));
        close(&impulses(&found), &[impulse, impulse], 1e-9);
        let carriage_after = 2.0 * reduced * v * (1.0 + e) / large;
        close(&found.after.rates, &[carriage_after, -e * v, -e * v], 1e-9);
        assert!((found.blows[0].energy_lost - reduced * v * v * (1.0 - e * e)).abs() < 1e-9);
    }
    // In motion: both are hit in one event, 0.3 m further on.
    let stop = "mu = 0.2\ntravel = [-3, 0.3]\nstop = { restitution = 0.6 }";
    let history = run(&carriage([large, m], c, [stop, stop], [0.0, v, v]), 0.4);
    assert_eq!(history.end, End::Finished);
    let told: Vec<&Cause> = history.events.iter().flat_map(|event| &event.causes).collect();
    let hits = told.iter().filter(|cause| matches!(cause, Cause::Hits { .. })).count();
    assert_eq!(hits, 2, "{told:?}");
    assert!((history.events[1].time - 0.3 / v).abs() < 1e-9, "{}", history.events[1].time);
    let rates = &history.reader().at(0.4).unwrap().configuration.rates;
    let reduced = m / (1.0 + 2.0 * m / large);
    close(rates, &[2.0 * reduced * v * (1.0 + e) / large, -e * v, -e * v], 1e-8);
}
