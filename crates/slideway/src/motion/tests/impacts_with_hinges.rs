//! Impacts on end stops beside hinges with friction, against impulses by hand.

use super::impacts::{close, impact_of, impulses, trammel};
use super::mechanism_of;
use crate::configuration::Configuration;
use crate::fault::{FaultKind, Faults};
use crate::ids::JointId;
use crate::model::Model;
use crate::motion::decision::{Impact, impact, impact_within};
use crate::motion::moving::energy::kinetic;
use crate::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};
use crate::progress::{Progress, as_far_as_wanted};
use std::ops::ControlFlow;

/// The trammel whose rod turns in rough pins, both with the same friction circle.
fn rough_trammel(mu: f64, radius: f64, upright: &str) -> String {
    let rough = format!("type = \"hinge\"\nfriction_radius = {radius:?}");
    trammel(mu, upright).replace("type = \"hinge\"", &rough)
}

/// `P_1` for each m/s by which a is slowed down, with friction mu of the sliders and the rod's force leaning by delta.
fn trammel_push(mu: f64, delta: f64) -> f64 {
    let angle = 0.6_f64.atan2(0.8);
    let (s, c) = (angle + delta).sin_cos();
    1.0 + 2.0 * (0.8 / 0.6) * (c - mu * s) / (s + mu * c)
}

/// One rod, two rough pins, two sliders. The rod is massless, so that its force is tangent to both friction circles: the
/// couples -r S sgn(omega) of both pins on the rod and that of its force S at the angle theta' to the guide balance,
///
/// ```text
/// L S sin(theta' - theta) = 2 r S sgn(omega)        theta' = theta + delta,    sin(delta) = 2 r/L
/// ```
///
/// while a moves outwards (the rod turns counter-clockwise), and theta' = theta - delta on the way back. With that angle the
/// rest is as without friction in the pins, s' = sin(theta'), c' = cos(theta'):
///
/// ```text
/// m_b c/s = S (s' + mu c')      P_1 = m_a + S (c' - mu s')      P = v P_1(mu, delta) + e v P_1(-mu, -delta)
/// ```
///
/// where the work returned, `e^2 P_1(-mu, -delta)`, is no more than that taken, `P_1(mu, delta)`; else with e so that it is equal.
#[test]
fn a_rod_in_rough_pins_pushes_along_the_tangent_of_its_friction_circles() {
    let (v, e) = (3.0, 0.5);
    for mu in [0.0, 0.1, 0.3, 0.6] {
        for radius in [0.002_f64, 0.01, 0.02] {
            let delta = (2.0 * radius).asin();
            let found = impact_of(&rough_trammel(mu, radius, ""), &[("level", e)]);
            let [to, fro] = [trammel_push(mu, delta), trammel_push(-mu, -delta)];
            let e = (to / fro).sqrt().min(e);
            let expected = v * to + e * v * fro;
            close(&impulses(&found), &[expected], 1e-8);
            close(&found.after.rates, &[-e * v], 1e-12);
            let energy = 0.5 * (1.0 + 2.0 * (0.8_f64 / 0.6).powi(2)) * v * v;
            assert!((found.blows[0].energy_lost - energy * (1.0 - e * e)).abs() < 1e-9);
        }
    }
}

/// As the radius vanishes the answers become those without friction in the hinges.
#[test]
fn small_friction_circles_change_little() {
    for mu in [0.0, 0.3] {
        for upright in ["", "travel = [\"0 m\", \"0.5 m\"]\nstop = { restitution = 0.5 }"] {
            let stops: &[(&str, f64)] =
                if upright.is_empty() { &[("level", 0.2)] } else { &[("level", 0.2), ("upright", 0.5)] };
            let smooth = impact_of(&trammel(mu, upright), stops);
            let rough = impact_of(&rough_trammel(mu, 1e-9, upright), stops);
            close(&impulses(&rough), &impulses(&smooth), 1e-6);
            close(&rough.after.rates, &smooth.after.rates, 1e-9);
        }
        // With the same restitution of coupled joints only the motion is determined.
        let upright = "travel = [\"0 m\", \"0.5 m\"]\nstop = { restitution = 0.2 }";
        let rough = impact_of(&rough_trammel(mu, 0.01, upright), &[("level", 0.2), ("upright", 0.2)]);
        close(&rough.after.rates, &[-0.6], 1e-12);
    }
}

fn refused(text: &str, joint: usize, restitution: f64) -> Faults {
    let mechanism = mechanism_of(text);
    let configuration = Configuration::new(&mechanism).unwrap();
    impact(&mechanism, &configuration, &[(JointId(joint), restitution)]).unwrap_err()
}

/// On the way back friction at b holds the rod if mu > tan(theta'): with rough pins at 0.73 already, not 0.75.
#[test]
fn rough_pins_help_friction_to_wedge_what_moves() {
    let delta = 0.04_f64.asin();
    assert!((0.6_f64.atan2(0.8) - delta).tan() < 0.73);
    // Without, it comes back with the work that its stop has taken.
    let e = (trammel_push(0.73, 0.0) / trammel_push(-0.73, 0.0)).sqrt();
    close(&impact_of(&trammel(0.73, ""), &[("level", 0.5)]).after.rates, &[-3.0 * e], 1e-12);
    close(&impact_of(&rough_trammel(0.73, 0.02, ""), &[("level", 0.5)]).after.rates, &[0.0], 1e-12);
}

#[test]
fn an_impact_comes_to_nothing_once_its_work_ends() {
    let mechanism = mechanism_of(&rough_trammel(0.3, 0.01, ""));
    let configuration = Configuration::new(&mechanism).unwrap();
    let level = mechanism.joints.iter().position(|joint| &*joint.name == "level").unwrap();
    let stops = [(JointId(level), 0.5)];
    assert!(impact(&mechanism, &configuration, &stops).is_ok());
    let mut end = |_: &Progress| ControlFlow::Break(());
    let (found, has_ended) =
        as_far_as_wanted(&mut end, |work| impact_within(&mechanism, &configuration, &stops, work));
    assert!(has_ended && found.is_err(), "{found:?}");
}

const CARRIAGE: f64 = 3.0;
const BODY: f64 = 1.0;
const INERTIA: f64 = 0.02;
const ARM: f64 = 0.1;
const GUIDE: f64 = 0.8;

/// A carriage on a level guide and a body on a rough pin of it, on the line of the guide; its mass centre at this angle, 1 kg,
/// 0.1 m from the pin. The stop is at the end that the carriage reaches, where it is.
fn carriage(angle: f64, [radius, static_radius]: [f64; 2], mu: f64, [v, omega]: [f64; 2]) -> String {
    let (y, x) = angle.to_radians().sin_cos();
    let travel = if v > 0.0 { "[\"-3 m\", \"0 m\"]" } else { "[\"0 m\", \"3 m\"]" };
    format!(
        r#"
[points]
C = [0, 0]
S = [{}, {}]
[bodies.carriage]
points = ["C"]
mass = {CARRIAGE}
centre_of_mass = "C"
moment_of_inertia = 1
[bodies.body]
points = ["C"]
mass = {BODY}
centre_of_mass = "S"
moment_of_inertia = {INERTIA}
[joints.wheels]
type = "block_slider"
block = "carriage"
at = "C"
along = 0
length = {GUIDE}
mu = {mu:?}
travel = {travel}
stop = {{ restitution = 0.5 }}
[joints.pin]
type = "hinge"
between = ["body.C", "carriage.C"]
friction_radius = {radius:?}
static_friction_radius = {static_radius:?}
[coordinates.x]
slide = "wheels"
rate = {v:?}
[coordinates.phi]
rotation = "body"
relative_to = "carriage"
rate = {omega:?}
"#,
        ARM * x,
        ARM * y
    )
}

fn of_carriage(angle: f64, radii: [f64; 2], mu: f64, rates: [f64; 2], e: f64) -> Impact {
    impact_of(&carriage(angle, radii, mu, rates), &[("wheels", e)])
}

/// One slider and one rough hinge. The body hangs straight down, c below its pin. Per m/s by which the carriage is slowed down
/// the pin gives it a level impulse R, at the spin's sign s with the couple -s r R:
///
/// ```text
/// R = m (1 - c w)      I w = m c - s r R,  I = J + m c^2      w = m (c - s r)/(I - s r m c)
/// ```
///
/// for the change w of its spin. The carriage gets R and the couple s r R, which presses the ends of its block, L apart, by r
/// R/L each, up and down; so with the sign t = 1 of its velocity, and t = -1 on its way back,
///
/// ```text
/// P = M + R - t 2 mu r R/L
/// ```
///
/// With e = 1 the stop would return more work than it has taken by P(-1)/P(1): there `e^2 = P(1)/P(-1)`.
#[test]
fn a_body_hangs_on_a_carriage_that_hits_its_stop() {
    let inertia = INERTIA + BODY * ARM * ARM;
    for (mu, r, e) in [(0.0, 0.01, 0.5), (0.3, 0.02, 0.5), (0.9, 0.05, 0.2), (0.3, 0.0999, 1.0)] {
        for (v, omega) in [(2.0, 30.0), (0.5, 3.0), (2.0, 1e-3)] {
            let change = BODY * (ARM - r) / (inertia - r * BODY * ARM);
            let force = BODY * (1.0 - ARM * change);
            let rubs = 2.0 * mu * r * force / GUIDE;
            let [to, fro] = [-rubs, rubs].map(|rubs| CARRIAGE + force + rubs);
            let bounded = (to / fro).sqrt().min(e);
            assert_eq!(bounded < e, e == 1.0);
            let expected = v * to + bounded * v * fro;
            let found = of_carriage(-90.0, [r, r], mu, [v, omega], e);
            close(&impulses(&found), &[expected], 1e-9);
            close(&found.after.rates, &[-bounded * v, omega + change * (1.0 + bounded) * v], 1e-9);
            assert!(found.blows[0].energy_lost > 0.0);
        }
    }
}

/// The same while it swings backwards: it is stopped first, with s = -1, and goes on with s = 1, all within the impact.
#[test]
fn the_friction_of_a_hinge_turns_round_within_an_impact() {
    let inertia = INERTIA + BODY * ARM * ARM;
    let (v, e, r, mu) = (2.0, 0.5, 0.03, 0.2);
    let change = |s: f64| BODY * (ARM - s * r) / (inertia - s * r * BODY * ARM);
    let push = |s: f64, t: f64| {
        let force = BODY * (1.0 - ARM * change(s));
        CARRIAGE + force - t * 2.0 * mu * r * force / GUIDE
    };
    // The spin reaches zero before the carriage does (up to 2 m/s), and after it.
    for part in [0.5, 2.0, 2.4] {
        let found = of_carriage(-90.0, [r, r], mu, [v, -part * change(-1.0)], e);
        let reversed = (1.0 + e) * v - part;
        let [to, fro] = [part.min(v), part - part.min(v)];
        let expected = to * push(-1.0, 1.0)
            + (v - to) * push(1.0, 1.0)
            + fro * push(-1.0, -1.0)
            + (e * v - fro) * push(1.0, -1.0);
        close(&impulses(&found), &[expected], 1e-8);
        close(&found.after.rates, &[-e * v, change(1.0) * reversed], 1e-9);
    }
}

/// A hinge at rest is held in the impact if `m c <= r_static m`: the body goes with the carriage. Else it begins to turn.
#[test]
fn static_friction_holds_a_hinge_through_an_impact() {
    let (v, e, r) = (2.0, 0.5, 0.02);
    let held = of_carriage(-90.0, [r, 0.101], 0.0, [v, 0.0], e);
    close(&held.after.rates, &[-e * v, 0.0], 1e-12);
    close(&impulses(&held), &[(CARRIAGE + BODY) * v * (1.0 + e)], 1e-9);
    let turns = of_carriage(-90.0, [r, 0.099], 0.0, [v, 0.0], e);
    let change = BODY * (ARM - r) / (INERTIA + BODY * ARM * ARM - r * BODY * ARM);
    close(&turns.after.rates, &[-e * v, change * (1.0 + e) * v], 1e-9);
}

/// The body at any angle, d = (x, y) from its pin: `R = m (-1 - w y, w x)`, `I w = -m y - s r |R|`, by iteration, which
/// converges where r m c < I.
fn change_at(angle: f64, r: f64, s: f64) -> f64 {
    let (y, x) = angle.to_radians().sin_cos();
    let (x, y, inertia) = (ARM * x, ARM * y, INERTIA + BODY * ARM * ARM);
    let next = |w: f64| BODY * (-y - s * r * (1.0 + w * y).hypot(w * x)) / inertia;
    (0..200).fold(0.0, |w, _| next(w))
}

/// Newton's coefficient is a law of velocities: where friction turns round within an impact, energy would grow with e = 1 (T.
/// R. Kane found that of a double pendulum that slides). The body at 15 degrees swings forward at 2 rad/s and is turned back
/// before the carriage stands, so that friction first helps to stop it, and then with all of the way back. The stop takes the
/// impulse `P_s = M + m (1 + w_s y)` for each m/s at the spin's sign s, and so the work `W = P_+ (v t - t^2/2) + P_- (v - t)^2/2`
/// when the spin turns after t; the way back ends at u, `P_- u^2/2 = W`, at latest.
#[test]
fn with_restitution_one_a_stop_returns_no_more_work_than_it_has_taken() {
    let (v, omega, r, angle) = (2.0, 2.0, 0.01, 15.0);
    for (e, is_bounded) in [(1.0, true), (0.99, false)] {
        let found = of_carriage(angle, [r, r], 0.0, [v, omega], e);
        let [forward, back] = [1.0, -1.0].map(|s| change_at(angle, r, s));
        let turned = -omega / forward;
        assert!(turned > 0.0 && turned < v && back < 0.0);
        let (y, x) = f64::sin_cos(f64::to_radians(angle));
        let [to, fro] = [forward, back].map(|w| CARRIAGE + BODY * (1.0 + w * ARM * y));
        let work = to * (v - turned / 2.0) * turned + fro * (v - turned).powi(2) / 2.0;
        let greatest = (2.0 * work / fro).sqrt();
        assert_eq!(greatest < e * v, is_bounded, "{greatest}");
        let returned = greatest.min(e * v);
        let spin = back * (v + returned - turned);
        close(&found.after.rates, &[-returned, spin], 1e-9);
        let energy = |[v, w]: [f64; 2]| {
            let body = [v - w * ARM * y, w * ARM * x];
            0.5 * (CARRIAGE * v * v + BODY * (body[0] * body[0] + body[1] * body[1]) + INERTIA * w * w)
        };
        let lost = energy([v, omega]) - energy([-returned, spin]);
        assert!((found.blows[0].energy_lost - lost).abs() < 1e-9);
        assert!(lost > 0.0, "{lost}");
    }
}

/// Seen in a mirror everything goes the other way; and no impact gains energy.
#[test]
fn the_mirror_image_of_an_impact() {
    for angle in [-90.0, -40.0, 15.0, 100.0, 170.0] {
        for (r, mu, e) in [(0.0, 0.2, 0.3), (0.01, 0.0, 1.0), (0.03, 0.4, 0.98), (0.08, 0.2, 0.0)] {
            for omega in [-25.0, -2.0, 0.0, 2.0, 25.0] {
                let one = of_carriage(angle, [r, r], mu, [2.0, omega], e);
                let mirrored = of_carriage(180.0 - angle, [r, r], mu, [-2.0, -omega], e);
                let rates: Vec<f64> = mirrored.after.rates.iter().map(|rate| -rate).collect();
                close(&one.after.rates, &rates, 1e-9);
                close(&impulses(&one), &impulses(&mirrored), 1e-9);
                let lost = one.blows[0].energy_lost;
                assert!(lost >= -1e-12, "{angle} {r} {mu} {e} {omega}: {lost}");
                let mechanism = mechanism_of(&carriage(angle, [r, r], mu, [2.0, omega]));
                let before = kinetic(&mechanism, &Configuration::new(&mechanism).unwrap());
                assert!((before - kinetic(&mechanism, &one.after) - lost).abs() < 1e-12);
            }
        }
    }
}

/// With `r m c > I` the equation of the hinge alone, `|b + e w| = w` with `|e| = r m c/I > 1`, has no solution where the body
/// hangs and swings forward, `b.e > 0`. So the hinge wedges: it stops at once, within its static friction, and with the level
/// momentum `M v + m (v + c omega)` both go on to the stop and back as one.
#[test]
fn a_hinge_that_wedges_stops_before_the_stop_pushes() {
    let (v, omega, e) = (2.0, 5.0, 0.5);
    let found = of_carriage(-90.0, [0.45, 0.45], 0.0, [v, omega], e);
    let together = v + BODY * ARM * omega / (CARRIAGE + BODY);
    close(&found.after.rates, &[-e * v, 0.0], 1e-9);
    close(&impulses(&found), &[(CARRIAGE + BODY) * (together + e * v)], 1e-8);
    assert!(found.blows[0].energy_lost > 0.0);
}

/// Where the body stands upright, `b.e < 0`, `b x e = 0`, that equation has two solutions. Neither is taken for the outcome.
#[test]
fn several_outcomes_are_refused() {
    let several = refused(&carriage(90.0, [0.45, 0.45], 0.0, [2.0, 5.0]), 0, 0.5);
    let is_named = matches!(several.sorted()[0].kind, FaultKind::SeveralImpacts { .. });
    assert!(is_named, "{several:?}");
}

fn moved(text: &str, duration: f64) -> History {
    simulate(&Model::parse(text).unwrap(), &SimulateOptions::new(duration).tolerance(1e-10)).unwrap()
}

fn hits(history: &History) -> usize {
    let causes = history.events.iter().flat_map(|event| &event.causes);
    causes.filter(|cause| matches!(cause, Cause::Hits { .. })).count()
}

/// A force F pushes a carriage against its stop, from d before it; on it a balanced wheel spins. The acceleration is a = F/(M +
/// m), the stop is reached at `v = sqrt(2 a d)`, and it bounces until `v/a + 2 v/a e/(1 - e)`. Meanwhile the pin carries m
/// sqrt(g^2 + a^2), at the impacts `m (1 + e) v` in all `1/(1 - e)`, at rest m g: with the couple r of each the wheel slows
/// down. When the force turns round, at T, the carriage leaves its stop.
#[test]
fn a_wheel_goes_on_spinning_while_its_carriage_comes_to_rest_at_a_stop() {
    let (r, e, d, force, g, turns, until) = (0.004, 0.5, 0.5, 24.0, 10.0_f64, 1.7, 2.1);
    let load = format!(
        "gravity = {g}\n[loads.push]\ntype = \"force\"\nat = \"carriage.C\"\ncomponents = [\"{force} N * sign({turns} s - t)\", 0]\n"
    );
    for mu in ["0.0", "0.02"] {
        let text = carriage(-90.0, [r, r], 0.0, [2.0, 100.0])
            .replace("centre_of_mass = \"S\"", "centre_of_mass = \"C\"")
            .replace("rate = 2.0", "rate = 0")
            .replace("\"0 m\"]", &format!("\"{d} m\"]"))
            .replace("mu = 0.0", &format!("mu = {mu}"));
        let history = moved(&(load.clone() + &text), until);
        assert_eq!(history.end, End::Finished, "{:#?}", history.events);
        assert!(hits(&history) > 10);
        let rests = history.phases.iter().find(|interval| interval.phase.joints[0] == JointPhase::Sticking);
        let rests = rests.unwrap();
        assert_ne!(rests.phase.hinges[0].state, JointPhase::Sticking);
        assert!((rests.to - turns).abs() < 1e-9);
        if mu != "0.0" {
            continue;
        }
        let a = force / (CARRIAGE + BODY);
        let v = (2.0 * a * d).sqrt();
        let bounces = v / a * (1.0 + 2.0 * e / (1.0 - e));
        assert!((rests.from - bounces).abs() < 1e-4);
        let pressed = BODY
            * (g.hypot(a) * (bounces + until - turns) + (1.0 + e) * v / (1.0 - e) + g * (turns - bounces));
        let last = history.reader().at(until).unwrap().configuration.clone();
        assert!((last.rates[1] - (100.0 - r * pressed / INERTIA)).abs() < 1e-5, "{:?}", last.rates);
        assert!((last.coordinates[0] - (d - a * (until - turns).powi(2) / 2.0)).abs() < 1e-8);
        assert!(history.energy_error < 1e-8 * history.energy_scale, "{:e}", history.energy_error);
    }
}

/// The gallery's slider-crank, its piston before a stop: with pins that hardly rub it moves as with smooth ones, with rough
/// ones its energy is accounted for.
#[test]
fn a_piston_of_a_slider_crank_with_rough_pins_bounces() {
    let text = crate::gallery::find("slider-crank-with-pins").unwrap().text;
    let stop = "type = \"block_slider\"\ntravel = [\"-30 mm\", \"25 mm\"]\nstop = { restitution = 0.6 }";
    let text = text.replacen("type = \"block_slider\"", stop, 1);
    let with = |pin: &str| moved(&text.replace("mu_pin = 0.1 ", &format!("mu_pin = {pin} ")), 0.03);
    let [smooth, hardly, rough] = ["0", "1e-9", "0.1"].map(with);
    for history in [&smooth, &hardly, &rough] {
        assert_eq!(history.end, End::Finished, "{:#?}", history.events);
        assert!(hits(history) >= 1);
        assert!(history.energy_error < 1e-7 * history.energy_scale, "{:e}", history.energy_error);
        assert!(history.impulses.windows(2).all(|pair| pair[1].energy >= pair[0].energy));
    }
    let end = |history: &History| history.reader().at(0.03).unwrap().configuration.rates[0];
    assert!((end(&smooth) - end(&hardly)).abs() < 1e-4, "{} {}", end(&smooth), end(&hardly));
    assert!((end(&smooth) - end(&rough)).abs() > 1e-2);
}
