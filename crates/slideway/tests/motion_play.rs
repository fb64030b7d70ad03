//! A guide with play as its faces that may lift off: rattling, and the guide without play that it becomes.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use crate::motion_impacts::{history, impacts};

/// A block of 200 x 100 mm and 2 kg that slides with 0.5 m/s on the lower of two faces, `play` apart beyond its height, and is
/// pulled by 30 N at a height above its middle (m).
fn block_with_play(play: f64, height: f64) -> String {
    let face = |name: &str, [from, to]: [&str; 2], y: f64, closed: bool| {
        format!(
            "[joints.{name}]\ntype = \"block_on_face\"\nblock = \"block\"\nat = [0, \"{y} m\"]\nface = [\"{from}\", \"{to}\"]\n\
             length = \"0.2 m\"\nmu = 0.3\nclosed = {closed}\n"
        )
    };
    format!(
        r#"
        gravity = "9.81 m/s^2"
        [points]
        C = [0, 0]
        H = [0, "{height} m"]
        LA = ["-0.2 m", "-0.05 m"]
        LB = ["0.7 m", "-0.05 m"]
        UA = ["-0.2 m", "0.05 m + {play} m"]
        UB = ["0.7 m", "0.05 m + {play} m"]
        [bodies.block]
        points = ["C", "H"]
        mass = "2 kg"
        moment_of_inertia = "0.012 kg m^2"
        centre_of_mass = "C"
        {}
        {}
        [coordinates.x]
        x = "block.C"
        rate = "0.5 m/s"
        [loads.pull]
        type = "force"
        at = "block.H"
        magnitude = "30 N"
        direction = "0 deg"
        "#,
        face("lower", ["LA", "LB"], -0.05, true),
        face("upper", ["UB", "UA"], 0.05, false),
    )
}

/// Pulled 120 mm above its middle the block tips, its front corner below and its rear corner above hit by turns, and then both
/// slide. The way after 0.2 s is that of an event-driven program of its own (case `block_slider_with_play`), which follows
/// impacts down to 1e-7 m/s; the flights that are left out here, within 1e-11 of the size, are worth 3e-7 m. As the play goes to
/// zero this is the block slider between both faces, whose three equations give 29.2815 N, 9.6615 N and 9.15855 m/s^2.
#[test]
fn a_guide_with_little_play_is_one_without() {
    let mut errors = Vec::new();
    for (play, way) in [(2e-3, 0.282_628_759_1), (2e-4, 0.283_111_236_6), (2e-5, 0.283_164_833_4)] {
        let history = history(&block_with_play(play, 0.12), 0.2);
        assert_eq!(history.phases.last().unwrap().phase.pattern(&history.mechanism), "+0+0");
        let end = history.reader().configuration(0.2).unwrap().poses[0].position.x;
        assert!((end - way).abs() < 3e-7, "{end} {way}");
        errors.push((end - (0.5 * 0.2 + 9.158_55 * 0.2 * 0.2 / 2.0)).abs() / play);
    }
    // The error is of the order of the play.
    assert!(errors.iter().all(|error| (0.2..0.4).contains(error)), "{errors:?}");
}

/// Pulled 300 mm above its middle it rattles, and each pair of impacts leaves 0.0539 of the rate: times of an event-driven
/// program of its own (case `rattling_ends`). Then both corners stay closed.
#[test]
fn rattling_ends_in_finite_time() {
    let history = history(&block_with_play(2e-4, 0.3), 0.01);
    let times: Vec<f64> = impacts(&history).into_iter().map(|[time, _]| time).collect();
    let expected = [
        0.002_812_474_923,
        0.004_201_147_919,
        0.004_504_262_073,
        0.004_579_131_906,
        0.004_595_474_245,
        0.004_599_510_844,
    ];
    assert!(times.len() >= expected.len(), "{times:?}");
    for (time, expected) in times.iter().zip(expected) {
        assert!((time - expected).abs() < 1e-11, "{time} {expected}");
    }
    let slides = history.phases.last().unwrap();
    assert_eq!(slides.phase.pattern(&history.mechanism), "+0+0");
    assert!((slides.from - 0.004_600_7).abs() < 2e-6, "{}", slides.from);
}
