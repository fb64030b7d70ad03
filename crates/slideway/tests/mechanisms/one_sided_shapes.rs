//! Contacts that may lift off, while they slide: discs on faces, on discs and in holes, contacts that are apart, and the examples of
//! the book.

use crate::answers::{assert_close, contact, only, parameters, report_on, report_with};
use crate::one_sided::{BOX, GRAVITY, fault, gap};
use slideway::check::check;
use slideway::fault::FaultKind;
use slideway::limits::{LimitsOptions, limits};
use slideway::model::{Model, Settings};
use slideway::report::{Persistence, Proof, SolveReport, Status, Uncertainty, Verdict};

const PEG: &str = include_str!("../../models/peg-in-hole.toml");
const CAM: &str = include_str!("../../models/cam-and-spring.toml");
const NIP: &str = include_str!("../../models/nip-of-rolls.toml");

/// The numbers of case `peg_two_points` of `reference/one-sided.toml`.
#[test]
fn the_peg_of_the_book_is_that_of_the_reference() {
    let report = report_on(PEG);
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
    let solution = only(&report);
    for (name, expected) in [("tip", 36.316_862_56), ("mouth", 36.365_743_14)] {
        assert_close(contact(solution, name).normal_force, expected, 40.0, 2e-3);
    }
    let model = Model::parse(PEG).unwrap();
    let report = limits(&model, &LimitsOptions::new("mu=0..0.4".parse().unwrap())).unwrap();
    let counts: Vec<usize> = report.counts.iter().map(|count| count.solutions).collect();
    assert_eq!(counts, [1, 0]);
    assert_close(report.counts[0].to, 0.218_901_978_5, 1.0, 1e-8);
}

/// Of an independent derivation and two programs: the forces of bushing and foot at 30 rad/s; at 60 rad/s the foot opens.
#[test]
fn the_foot_floats_where_the_cam_turns_fast() {
    let at = |speed: &str| report_with(&Model::parse(CAM).unwrap(), &parameters(&[("speed", speed)]));
    for (speed, expected) in [
        ("30 rad/s", [0.336_211_006_4, -0.069_649_951_02, 2.665_610_553, 0.0]),
        ("60 rad/s", [0.2, -0.2, 0.0, 14.500_247_87]),
    ] {
        let report = at(speed);
        assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
        let solution = only(&report);
        for (name, expected) in ["bushing.rear", "bushing.front", "foot"].into_iter().zip(expected) {
            assert_close(contact(solution, name).normal_force, expected, 1.0, 1e-8);
        }
        assert_close(gap(solution, "foot"), expected[3], 1.0, 1e-7);
        assert_eq!(solution.attainability.verdict, Verdict::Attainable);
    }
    // It opens where e omega^2 sin(phi) is what weight, spring and the friction of the bushing give: 2 mu N, N = 2 N 4 mm/40 mm.
    let model = Model::parse(CAM).unwrap();
    let options = LimitsOptions::new("speed=10 rad/s..80 rad/s".parse().unwrap());
    let report = limits(&model, &options).unwrap();
    let follows = GRAVITY + 2.0 / 0.3 + 2.0 * 0.15 * 0.2 / 0.3;
    let speed = (follows / (0.01 * 60_f64.to_radians().sin())).sqrt();
    let opens = report.modes.iter().filter_map(|mode| mode.from).filter(|from| *from > 40.0 && *from < 45.0);
    assert_close(opens.fold(0.0, f64::max), speed, 1.0, 1e-6);
}

/// Two discs that turn inwards grip at `mu = tan(alpha)`.
#[test]
fn rolls_grip_from_the_tangent_of_their_angle_on() {
    let model = Model::parse(NIP).unwrap();
    let report = limits(&model, &LimitsOptions::new("mu=0..1".parse().unwrap())).unwrap();
    let counts: Vec<usize> = report.counts.iter().map(|count| count.solutions).collect();
    assert_eq!(counts, [1, 0]);
    assert_close(report.counts[0].to, (0.11_f64.powi(2) - 0.102_f64.powi(2)).sqrt() / 0.102, 1.0, 1e-9);
    assert_eq!(report_with(&model, &Settings::default().parameter("mu", 0.45)).status, Status::None);
}

/// What the positions are away from the drawing: the centre of the disc on its circle around the roll.
#[test]
fn a_disc_goes_around_a_disc() {
    // A disc of 50 mm on a cylinder of 200 mm, drawn at the top and led aside by 25 deg: N = m (g cos - v^2/(R + r)).
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        O = [0, 0]
        C = [0, "250 mm"]
        [bodies.disc]
        points = ["C"]
        mass = "1 kg"
        centre_of_mass = "C"
        shape = { disc = "50 mm" }
        [joints.top]
        type = "disc_on_disc"
        centres = ["disc.C", "ground.O"]
        radii = ["50 mm", "200 mm"]
        mu = 0.2
        [coordinates.x]
        x = "disc.C"
        value = "250 mm*sin(25 deg)"
        rate = "0.6 m/s*cos(25 deg)"
        [coordinates.turn]
        rotation = "disc"
        rate = "3 rad/s"
    "#;
    let report = report_on(text);
    let solution = only(&report);
    let (sin, cos) = 25_f64.to_radians().sin_cos();
    let top = contact(solution, "top");
    let normal = GRAVITY * cos - 0.36 / 0.25;
    assert_close(top.normal_force, normal, 1.0, 1e-10);
    // It slides against the tangent, which is to the right at the top: the rim goes with v + r omega.
    assert_close(top.sliding_velocity, 0.6 + 0.05 * 3.0, 1.0, 1e-10);
    let along = GRAVITY * sin - 0.2 * normal;
    let [x, y] = solution.bodies[0].acceleration;
    assert_close(x * cos - y * sin, along, 1.0, 1e-9);
    assert_close(x * sin + y * cos, -0.36 / 0.25, 1.0, 1e-9);
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
}

/// A disc of radius R on an incline slides with `v_t = x' + R omega`: `N = m g cos`, and friction turns it.
#[test]
fn a_disc_slides_on_an_incline() {
    let text = BOX
        .replace("type = \"block_on_face\"", "type = \"disc_on_face\"\nradius = \"h/2\"")
        .replace("at = \"M\"", "centre = \"C\"")
        .replace("length = \"b\"\n", "")
        .replace("shape = { rectangle = [\"b\", \"h\"] }", "shape = { disc = \"h/2\" }")
        + "[coordinates.turn]\nrotation = \"box\"\nrate = \"-2 rad/s\"\n";
    let report = report_on(&text);
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let base = contact(only(&report), "base");
    assert_close(base.normal_force, GRAVITY * cos, 1.0, 1e-12);
    assert_close(base.sliding_velocity, -1.0 - 2.0 * 0.2, 1.0, 1e-12);
    let [x, turn] = [0, 1].map(|index| only(&report).coordinates[index].acceleration);
    assert_close(x, GRAVITY * (0.3 * cos - sin), 1.0, 1e-12);
    // Friction acts at the rim: its arm is R, m R^2/2 the moment of inertia.
    assert_close(turn, 0.3 * GRAVITY * cos * 0.2 / (0.5 * 0.04), 1.0, 1e-12);
}

/// What is apart is not there, as long as it is apart.
#[test]
fn what_is_apart_does_not_press() {
    let apart = |closed: &str, more: &str| {
        BOX.replace("mu = \"mu\"\n", &format!("mu = \"mu\"\nclosed = {closed}\n")) + more
    };
    let turn = "[coordinates.turn]\nrotation = \"box\"\nvalue = \"5 deg\"\n";
    // On its rear corner, as it is in the corner's own words.
    let report = report_on(&apart("[\"rear\"]", turn));
    let corner = BOX
        .replace("block_on_face", "corner_on_face")
        .replace("at = \"M\"", "at = [\"-b/2*cos(slope)\", \"-b/2*sin(slope)\"]")
        .replace("length = \"b\"\n", "")
        + turn;
    let other = report_on(&corner);
    assert_close(
        contact(only(&report), "base.rear").normal_force,
        contact(only(&other), "base").normal_force,
        1.0,
        1e-12,
    );
    // Turned the other way the front corner is in the face, by b sin(5 deg).
    let kind = fault(&apart("[\"rear\"]", &turn.replace("5 deg", "-5 deg")));
    let FaultKind::Penetration { joint, depth } = kind else { panic!("{kind}") };
    assert_eq!((joint.as_str(), depth.as_str()), ("base", "0.017431 m"));
    let flat = fault(&apart("[\"rear\"]", "[coordinates.turn]\nrotation = \"box\"\n"));
    assert!(matches!(flat, FaultKind::TouchesThoughApart { .. }), "{flat}");
    // Apart as a whole it falls.
    let free = "[coordinates.y]\ny = \"box.C\"\nvalue = \"0.5 m\"\n[coordinates.turn]\nrotation = \"box\"\n";
    let report = report_on(&apart("false", free));
    let solution = only(&report);
    assert_close(solution.bodies[0].acceleration[1], -GRAVITY, 1.0, 1e-12);
    assert_eq!((solution.contacts.len(), solution.joints.len()), (0, 0));
    let gaps = check(&Model::parse(&apart("false", free)).unwrap()).unwrap().joints[0].gaps.clone();
    assert_eq!(gaps.len(), 2);
}

/// The box slides flat up to `mu = b/h` = 0.5, and tips beyond: one state for each value.
#[test]
fn friction_within_bounds() {
    let model = Model::parse(BOX).unwrap();
    let found = |mu: &str| report_with(&model, &parameters(&[("mu", mu)])).uncertainty.unwrap();
    let persistence = |uncertainty: &Uncertainty, pattern: &str| {
        uncertainty.modes.iter().find(|mode| mode.pattern == pattern).map(|mode| mode.persistence)
    };
    let flat = found("0.3..0.4");
    assert_eq!((flat.least_solutions, flat.most_solutions), (1, Some(1)));
    assert_eq!(persistence(&flat, "++"), Some(Persistence::AllValues));
    let across = found("0.45..0.55");
    assert_eq!((across.least_solutions, across.most_solutions), (1, Some(1)));
    assert_eq!(persistence(&across, "++"), Some(Persistence::SomeValues));
    assert_eq!(persistence(&across, "-+"), Some(Persistence::SomeValues));
}

/// A corner beyond the end of its face is apart whatever its height: the box moves as without it, and a motion that begins so ends
/// at once, as what it meets there is not in the model.
#[test]
fn a_corner_beyond_the_end_of_its_face_is_apart() {
    let text = |front: &str| {
        format!(
            "gravity = \"9.81 m/s^2\"\n[points]\nC = [0, 0.2]\nA = [-0.1, 0]\nB = [0.1, 0]\nfrom = [-1, 0]\nto = [0.05, 0]\n\
             [bodies.box]\npoints = [\"C\", \"A\", \"B\"]\nmass = 1\nmoment_of_inertia = 0.02\ncentre_of_mass = \"C\"\n\
             [joints.a]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = \"A\"\nface = [\"from\", \"to\"]\nmu = 0.3\n{front}\
             [coordinates.x]\nslide = \"a\"\nrate = -1\n[coordinates.turn]\nrotation = \"box\"\n"
        )
    };
    let corner = "[joints.b]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = \"B\"\nface = [\"from\", \"to\"]\nmu = 0.3\nclosed = false\n";
    let alone = report_on(&text(""));
    for turn in ["0 deg", "-5 deg", "5 deg"] {
        let settings = Settings::default().position("turn", turn);
        let model = |front: &str| Model::parse(&text(front)).unwrap();
        let [with, without] = [corner, ""].map(|front| report_with(&model(front), &settings));
        assert_eq!(with.solutions.len(), alone.solutions.len());
        let acceleration = |report: &SolveReport| only(report).bodies[0].acceleration;
        assert_eq!(acceleration(&with), acceleration(&without), "{turn}");
    }
    // It lies on its face as soon as that is long enough, and is in it if it is turned.
    let long = |text: &str| text.replace("to = [0.05, 0]", "to = [0.5, 0]");
    assert!(matches!(fault(&long(&text(corner))), FaultKind::TouchesThoughApart { .. }));
    let turned = text(corner).replace("rotation = \"box\"", "rotation = \"box\"\nvalue = -0.1");
    assert!(matches!(fault(&long(&turned)), FaultKind::Penetration { .. }));
    // A block stands on its rear corner, and its front one is beyond the end.
    let turn = "[coordinates.turn]\nrotation = \"box\"\n";
    let block = |face: &str| {
        let rear = BOX.replace("mu = \"mu\"\n", "mu = \"mu\"\nclosed = [\"rear\"]\n") + turn;
        rear.replace(
            "to = [\"1 m*cos(slope)\", \"1 m*sin(slope)\"]",
            "to = [\"50 mm*cos(slope)\", \"50 mm*sin(slope)\"]",
        )
        .replace("along = \"slope\"", face)
    };
    assert!(matches!(fault(&block("along = \"slope\"")), FaultKind::TouchesThoughApart { .. }));
    let report = report_on(&block("face = [\"from\", \"to\"]"));
    assert_eq!(only(&report).contacts.len(), 1);
}
