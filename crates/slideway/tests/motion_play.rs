//! A guide with play as its faces that may lift off: rattling, and the guide without play that it becomes.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use crate::motion_impacts::{history, impacts};
use slideway::model::Model;
use slideway::motion::{End, SimulateOptions, simulate};

/// A block of 200 x 100 mm and 2 kg that slides with 0.5 m/s on the lower of two faces, `play` apart beyond its height, and is
/// pulled by 30 N at a height above its middle (m).
fn block_with_play(play: f64, height: f64) -> String {
    let face = |name: &str, [from, to]: [&str; 2], y: f64, closed: bool| {
        format!(
            "[joints.{name}]\ntype = \"block_on_face\"\nblock = \"block\"\nat = [0, \"{y} m\"]\nface = [\"{from}\", \"{to}\"]\n\
             length = \"0.2 m\"\nmu = 0.3\nclosed = {closed}\n"
        )
    };
    let points = format!(
        "LA = [\"-0.2 m\", \"-0.05 m\"]\nLB = [\"0.7 m\", \"-0.05 m\"]\n\
         UA = [\"-0.2 m\", \"0.05 m + {play} m\"]\nUB = [\"0.7 m\", \"0.05 m + {play} m\"]"
    );
    let faces = face("lower", ["LA", "LB"], -0.05, true) + &face("upper", ["UB", "UA"], 0.05, false);
    pulled_block(height, &points, &faces, "x = \"block.C\"")
}

/// A block of 2 kg with these further points and these joints, which begins with 0.5 m/s along this coordinate and is pulled by
/// 30 N at a height above its middle (m).
fn pulled_block(height: f64, points: &str, joints: &str, coordinate: &str) -> String {
    format!(
        r#"
        gravity = "9.81 m/s^2"
        [points]
        C = [0, 0]
        H = [0, "{height} m"]
        {points}
        [bodies.block]
        points = ["C", "H"]
        mass = "2 kg"
        moment_of_inertia = "0.012 kg m^2"
        centre_of_mass = "C"
        {joints}
        [coordinates.x]
        {coordinate}
        rate = "0.5 m/s"
        [loads.pull]
        type = "force"
        at = "block.H"
        magnitude = "30 N"
        direction = "0 deg"
        "#
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

/// A block slider with play between the same faces, from the middle of its play; `faces` are further keys of the joint.
fn loose_block(play: f64, height: f64, faces: &str) -> String {
    let guide = format!(
        r#"
        [joints.guide]
        type = "block_slider"
        block = "block"
        at = "C"
        along = "0 deg"
        length = "0.2 m"
        height = "0.1 m"
        mu = 0.3
        play = "{play} m"
        loose = true
        {faces}"#
    );
    pulled_block(height, "", &guide, "slide = \"guide\"")
}

/// What a loose guide does is what its two faces do that are written by hand, in the middle of whose play the block begins.
#[test]
fn a_loose_guide_is_its_two_faces() {
    for (key, faces) in [("", ""), ("restitution = 0.4", "restitution = 0.4\n")] {
        let loose = history(&loose_block(2e-3, 0.12, key), 0.2);
        let middle = block_with_play(2e-3, 0.12)
            .replace(" m\", \"-0.05 m\"]", " m\", \"-0.05 m - 1 mm\"]")
            .replace("0.05 m + 0.002 m", "0.05 m + 1 mm")
            .replace("closed = true", "closed = false")
            .replace("closed = false\n", &format!("closed = false\n{faces}"))
            + "[coordinates.y]\ny = \"block.C\"\n[coordinates.turn]\nrotation = \"block\"\n";
        let written = history(&middle, 0.2);
        // The flights that are left out at the end are in proportion to the size of the drawing, which has other points.
        assert!(loose.events.len().abs_diff(written.events.len()) <= 1 && loose.events.len() > 5);
        for (one, other) in loose.events.iter().zip(&written.events).take(30) {
            assert!((one.time - other.time).abs() < 1e-12, "{} {}", one.words, other.words);
        }
        let names = loose.mechanism.contacts.iter().map(|contact| contact.name.to_string());
        assert_eq!(
            names.collect::<Vec<_>>(),
            ["guide.front.plus", "guide.rear.plus", "guide.front.minus", "guide.rear.minus"]
        );
        let ends =
            [loose, written].map(|history| history.reader().configuration(0.2).unwrap().poses[0].position);
        assert!((ends[0] - ends[1]).norm() < 1e-9, "{ends:?}");
    }
}

/// A loose guide whose front corners are the guide's is four corners that are written by hand, of which those two are corners of
/// the ground on faces of the block.
#[test]
fn corners_of_a_loose_guide_touch_faces_of_the_block() {
    let loose = loose_block(2e-3, 0.12, "front = { carried_by = \"guide\" }");
    let corner = |name: &str, [block, guide]: [&str; 2], at: [&str; 2], [from, to]: [&str; 2]| {
        format!(
            "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"{block}\"\nguide = \"{guide}\"\nat = [\"{}\", \"{}\"]\n\
             face = [\"{from}\", \"{to}\"]\nmu = 0.3\nclosed = false\n",
            at[0], at[1]
        )
    };
    let points = "LA = [\"-0.15 m\", \"-0.051 m\"]\nLB = [\"0.2 m\", \"-0.051 m\"]\n\
                  UA = [\"-0.15 m\", \"0.051 m\"]\nUB = [\"0.2 m\", \"0.051 m\"]\n\
                  la = [\"-0.5 m\", \"-0.05 m\"]\nlb = [\"0.5 m\", \"-0.05 m\"]\n\
                  ua = [\"-0.5 m\", \"0.05 m\"]\nub = [\"0.5 m\", \"0.05 m\"]";
    let (on_ground, on_block) = (["block", "ground"], ["ground", "block"]);
    let joints = corner("front_plus", on_block, ["0.1 m", "-0.051 m"], ["lb", "la"])
        + &corner("rear_plus", on_ground, ["-0.1 m", "-0.05 m"], ["LA", "LB"])
        + &corner("front_minus", on_block, ["0.1 m", "0.051 m"], ["ua", "ub"])
        + &corner("rear_minus", on_ground, ["-0.1 m", "0.05 m"], ["UB", "UA"]);
    let written = pulled_block(0.12, points, &joints, "x = \"block.C\"")
        .replace("points = [\"C\", \"H\"]", "points = [\"C\", \"H\", \"la\", \"lb\", \"ua\", \"ub\"]")
        + "[coordinates.y]\ny = \"block.C\"\n[coordinates.turn]\nrotation = \"block\"\n";
    let [loose, written] = [loose, written].map(|text| history(&text, 0.15));
    let impacts = [&loose, &written].map(impacts);
    assert!(impacts[0].len() > 5 && impacts[0].len().abs_diff(impacts[1].len()) <= 1, "{impacts:?}");
    // The flights that are left out at the end are in proportion to the size of the drawing, which has other points: they are worth
    // 7e-7 m here.
    for (one, other) in impacts[0].iter().zip(&impacts[1]).take(5) {
        assert!((one[0] - other[0]).abs() < 1e-11 && (one[1] - other[1]).abs() < 1e-9, "{one:?} {other:?}");
    }
    for history in [&loose, &written] {
        assert!(history.energy_error < 1e-9 * history.energy_scale, "{}", history.energy_error);
    }
    let ends =
        [loose, written].map(|history| history.reader().configuration(0.15).unwrap().poses[0].position);
    assert!((ends[0] - ends[1]).norm() < 1e-6, "{ends:?}");
}

/// The drawer that a spring throws open, loose in its guide: its energy is accounted for until its inner end is at the mouth of the
/// carcass, `L` from where it begins.
#[test]
fn a_loose_drawer_leaves_its_carcass() {
    let text = slideway::gallery::find("thrown-drawer").unwrap().text;
    let text = text.replace("length = \"L\"", "length = \"L\"\nplay = \"1 mm\"\nloose = true");
    let history = simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(1.0)).unwrap();
    assert!(matches!(history.end, End::TravelLimit(_)), "{:?}", history.end);
    let pose = history.reader().configuration(history.stop()).unwrap().poses[0];
    let (sin, cos) = pose.angle().sin_cos();
    let inner_end = pose.position.x - 0.2 * cos + 0.12 * sin;
    assert!((inner_end - 0.2).abs() < 2e-6, "{inner_end}");
    assert!(history.energy_error < 1e-9 * history.energy_scale, "{}", history.energy_error);
}

/// The drawer on two rails of the gallery, pulled by 40 N against 10 N. Its rails are rigid: the one with less play carries. With
/// the normal force `N` of its front corner and `-N` of its rear one, the moment about the middle is
/// `N L - a P + mu B N` where that is the left one, and `N L - a P - mu B N` where it is the right one.
#[test]
fn the_rail_with_less_play_carries() {
    let (length, distance, lever, mu, pull) = (0.4, 0.6, 0.25, 0.3, 40.0);
    for (rail, plays, sign) in [("left", ["0.2 mm", "0.6 mm"], 1.0), ("right", ["0.6 mm", "0.2 mm"], -1.0)] {
        let text = slideway::gallery::find("drawer-on-two-rails").unwrap().text;
        let (text, _) = text.split_once("[drives.pull]").unwrap();
        let text = text
            .replace("stiffness = \"k_left\"", "loose = true")
            .replace("stiffness = \"k_right\"", "loose = true")
            .replace("play_left = \"0.2 mm\"", &format!("play_left = \"{}\"", plays[0]))
            .replace("play_right = \"0.6 mm\"", &format!("play_right = \"{}\"", plays[1]))
            + &format!(
                "[loads.pull]\ntype = \"force\"\nat = \"drawer.handle\"\nmagnitude = \"{pull} N\"\ndirection = \"0 deg\"\n"
            );
        let history = history(&text, 0.5);
        let normal = lever * pull / (length + sign * mu * distance);
        let last = history.reader().at(0.5).unwrap();
        let force = |name: &str| {
            let contact =
                history.mechanism.contacts.iter().position(|contact| *contact.name == *name).unwrap();
            last.contacts[contact].normal_force
        };
        for (corner, expected) in [("front.plus", normal), ("rear.minus", normal), ("rear.plus", 0.0)] {
            let found = force(&format!("{rail}.{corner}"));
            assert!((found - expected).abs() < 0.01 * normal, "{rail}.{corner} {found} {expected}");
        }
        let acceleration = (pull - 10.0 - 2.0 * mu * normal) / 8.0;
        let expected = 0.3 + 0.5 * acceleration;
        let found = last.configuration.velocities[0].linear.x;
        assert!((found - expected).abs() < 0.01, "{found} {expected}");
        assert!(history.energy_error < 1e-9 * history.energy_scale, "{}", history.energy_error);
    }
}
