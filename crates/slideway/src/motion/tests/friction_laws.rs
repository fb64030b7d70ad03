//! Friction that depends on the sliding velocity, against closed forms.

use super::models::block;
use super::run;
use crate::model::Model;
use crate::motion::{Cause, End, JointPhase, SimulateOptions, simulate};

/// A block of 2 kg on an incline of 30 deg, g = 10 m/s^2.
fn incline(mu: &str, start: &str) -> String {
    block(mu, start, "").replace("along = \"0 deg\"", "along = \"30 deg\"")
}

/// mu = mu_0 + c v makes v' = -g (sin + mu_0 cos) - c g cos v upwards, and v' = -g (sin - mu_0 cos) - c g cos
/// v downwards: with T = 1/(c g cos) and w = (tan +- mu_0)/c the velocity is (v_0 + w) e^(-t/T) - w, and the
/// way T (v_0 + w)(1 - e^(-t/T)) - w t. Upwards it stops at T ln(1 + v_0/w).
#[test]
fn viscous_friction_on_an_incline_leads_to_a_terminal_speed() {
    let (mu, c, start) = (0.2, 0.5, 3.0);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let time = 1.0 / (c * 10.0 * cos);
    let options = SimulateOptions::new(4.0);
    let history = run(&incline("\"0.2 + 0.5*sliding_speed/(1 m/s)\"", "rate = 3"), &options);
    assert_eq!(history.end, End::Finished);
    let [up, down] = [mu, -mu].map(|mu| (sin / cos + mu) / c);
    let stop = time * (1.0 + start / up).ln();
    let top = start * time - up * stop;
    assert_eq!(history.events.len(), 2, "{:#?}", history.events);
    let late = history.events[1].time - stop;
    assert!(late.abs() < 1e-9, "{late:e}");
    assert!(history.events[1].words.starts_with("block reverses"), "{}", history.events[1].words);
    let mut reader = history.reader();
    for at in [0.1, 0.2, 0.35, 1.0, 2.0, 4.0] {
        let (from, v, w, x) = if at < stop { (0.0, start, up, 0.0) } else { (stop, 0.0, down, top) };
        let decay = (-(at - from) / time).exp();
        let velocity = (v + w) * decay - w;
        let place = x + time * (v + w) * (1.0 - decay) - w * (at - from);
        let configuration = reader.at(at).unwrap().configuration;
        assert!(
            (configuration.rates[0] - velocity).abs() < 1e-8,
            "{at} {} {velocity}",
            configuration.rates[0]
        );
        assert!((configuration.coordinates[0] - place).abs() < 1e-8, "{at} {place}");
    }
    assert!(history.energy_error < 1e-8 * history.energy_scale, "{:e}", history.energy_error);
}

/// With mu_0 above tan(30 deg) it stays where it stops, though friction grows with the speed.
#[test]
fn what_stops_under_friction_at_speed_zero_stays() {
    let history =
        run(&incline("\"0.7 + 0.5*sliding_speed/(1 m/s)\"", "rate = 3"), &SimulateOptions::new(2.0));
    assert_eq!(history.phases.last().unwrap().phase.joints, [JointPhase::Sticking]);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let stop = (1.0 + 3.0 / ((sin / cos + 0.7) / 0.5)).ln() / (0.5 * 10.0 * cos);
    let late = history.events[1].time - stop;
    assert!(late.abs() < 1e-9, "{late:e}");
}

/// Without friction at the speed zero nothing ever sticks or stops: v = v_0 e^(-c g t).
#[test]
fn purely_viscous_friction_never_stops_a_block() {
    let history = run(&block("\"0.1*sliding_speed/(1 m/s)\"", "rate = 2", ""), &SimulateOptions::new(3.0));
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.events.len(), 1);
    let velocity = history.reader().at(3.0).unwrap().configuration.rates[0];
    assert!((velocity - 2.0 * (-3.0_f64).exp()).abs() < 1e-9, "{velocity}");
}

/// The law knows the absolute velocity alone: the mirrored motion is the same one.
#[test]
fn friction_is_the_same_in_both_directions() {
    let mu = "\"0.1 + 0.2*exp(-(sliding_speed/(0.3 m/s))^2) + 0.03*sliding_speed/(1 m/s)\"";
    let [there, back] =
        ["rate = 2", "rate = -2"].map(|start| run(&block(mu, start, ""), &SimulateOptions::new(3.0)));
    assert_eq!(there.events.len(), 2);
    assert_eq!(there.events[1].time, back.events[1].time);
    let [there, back] = [there, back].map(|history| history.reader().at(1.0).unwrap().configuration);
    assert_eq!(there.rates[0], -back.rates[0]);
    assert_eq!(there.coordinates[0], -back.coordinates[0]);
}

/// A coefficient that falls below zero at 2 m/s ends the motion there, with the speed in the words.
#[test]
fn negative_friction_ends_a_motion_with_its_speed() {
    let text = block("\"0.3 - 0.15*sliding_speed/(1 m/s)\"", "rate = 1", "")
        + "[loads.push]\ntype = \"force\"\nat = \"block.C\"\ncomponents = [20, 0]\n";
    let history = simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(2.0)).unwrap();
    let End::NoValue(faults) = &history.end else { panic!("{:?}", history.end) };
    let text = faults.to_string();
    assert!(text.contains("at the sliding speed 2.") && text.contains("friction coefficient"), "{text}");
    // v' = 10 - 10 (0.3 - 0.15 v) = 7 + 1.5 v from 1 m/s on reaches 2 m/s after ln(10/8.5)/1.5 s.
    let end = history.phases.last().unwrap().to;
    assert!((end - (10.0_f64 / 8.5).ln() / 1.5).abs() < 1e-3, "{end}");
}

/// A table, and `max`: kinks of friction over velocity. From 3 m/s the block is braked with mu = 0.2, below 1
/// m/s with mu = 0.2 + 0.1 (1 - v): v = 1 after 1 s, then v' = -3 + v, so v = 3 - 2 e^(t - 1), and it stops
/// after 1 + ln 1.5 s.
#[test]
fn kinks_of_friction_are_followed() {
    let table = "[tables.mu]\nargument = [\"0 m/s\", \"1 m/s\", \"5 m/s\"]\nvalue = [0.3, 0.2, 0.2]\n";
    for (mu, more) in
        [("\"mu(sliding_speed)\"", table), ("\"0.2 + 0.1*max(0, 1 - sliding_speed/(1 m/s))\"", "")]
    {
        let history = run(&block(mu, "rate = 3", more), &SimulateOptions::new(2.0));
        let stops = history.events.iter().find(|event| matches!(event.causes[..], [Cause::Stops(_)]));
        let time = stops.unwrap().time;
        assert!((time - 1.0 - 1.5_f64.ln()).abs() < 1e-8, "{mu} {time}");
    }
}
