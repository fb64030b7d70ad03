//! Following the assembly branch of the drawing: near folds and dead centres, up to them, and not beyond.

use crate::answers::{assert_close, normal_forces, report_with};
use crate::random_mechanisms::{cases, mechanisms};
use nalgebra::Vector2;
use proptest::prelude::*;
use rstest::rstest;
use slideway::configuration::{Configuration, Follower};
use slideway::fault::{FaultKind, Faults};
use slideway::ids::{BodyId, Frame};
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::mechanism::{Attachment, Mechanism};
use slideway::model::{Model, Settings};
use slideway::report::{ModeEndCause, Proof, Status};

/// Two more solutions of its joints pass near the way from the drawing, and folds are at q0 = -0.2518 and
/// 0.0091.
const BRANCH: &str = include_str!("branch.toml");

fn at(model: &Model, values: &[(&str, f64)]) -> Mechanism {
    let settings = values
        .iter()
        .fold(Settings::default(), |settings, (name, value)| settings.position(name, format!("{value:e}")));
    Mechanism::new(&model.with(&settings).unwrap()).unwrap()
}

fn configured(model: &Model, name: &str, value: f64) -> Result<Configuration, Faults> {
    Configuration::new(&at(model, &[(name, value)]))
}

fn kind(result: Result<Configuration, Faults>) -> FaultKind {
    result.unwrap_err().sorted()[0].kind.clone()
}

/// The number behind the first " = " of a state in words.
fn first_value(state: &str) -> f64 {
    state.split_whitespace().nth(2).unwrap().parse().unwrap()
}

/// Centre of mass and angle of both bodies at q0: `reference/branch_positions.py`, 20,000 steps of Newton's
/// method.
#[rstest]
#[case(-0.0265, [0.415_464_128_621, 0.126_495_451_375, 0.369_495_206_304], [-0.457_614_639_629, 0.293_979_642_401, 0.339_142_259_041])]
#[case(-0.0615, [0.218_444_536_198, 0.281_986_694_098, 0.699_097_841_393], [-0.689_759_368_463, 0.151_793_922_568, 0.627_921_609_177])]
#[case(-0.1170, [-0.109_766_738_954, 0.413_214_139_742, 1.137_017_395_033], [-0.912_319_714_878, -0.117_170_217_777, 0.999_094_709_639])]
#[case(-0.1217, [-0.139_877_945_209, 0.418_960_324_444, 1.172_907_594_027], [-0.925_739_277_113, -0.142_291_283_772, 1.029_203_361_184])]
#[case(-0.1256, [-0.165_220_967_507, 0.423_048_078_883, 1.202_725_238_754], [-0.936_304_534_613, -0.163_452_223_895, 1.054_206_818_438])]
fn the_branch_of_the_drawing_is_kept_beside_others(
    #[case] q0: f64,
    #[case] first: [f64; 3],
    #[case] second: [f64; 3],
) {
    let model = Model::parse(BRANCH).unwrap();
    let state = configured(&model, "q0", q0).unwrap();
    for (pose, expected) in state.poses.iter().zip([first, second]) {
        for (found, expected) in [pose.position.x, pose.position.y, pose.angle()].iter().zip(expected) {
            assert_close(*found, expected, 1.0, 1e-11);
        }
    }
    let report = report_with(&model, &Settings::default().position("q0", q0.to_string()));
    assert_eq!(report.steps_from_drawing, Some(state.steps));
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
}

/// The normal forces are those of an independent review program, which found the positions by another way.
#[test]
fn beside_other_branches_forces_are_those_of_an_independent_program() {
    let model = Model::parse(BRANCH).unwrap();
    let report = report_with(&model, &Settings::default().position("q0", "-0.1217"));
    assert_eq!(report.solutions[0].pattern, "+-+");
    for (found, expected) in normal_forces(&report.solutions[0]).iter().zip([2.245, -73.30, 66.18]) {
        assert_close(*found, expected, expected, 3e-4);
    }
}

#[test]
fn in_the_drawing_nothing_is_followed() {
    let model = Model::parse(BRANCH).unwrap();
    assert_eq!(report_with(&model, &Settings::default()).steps_from_drawing, None);
}

/// A slider-crank with the stroke as coordinate, drawn at this angle of the crank; dead centres are at 0.06 m
/// and 0.26 m.
fn driven_by_its_slide(degrees: f64) -> Model {
    let text = format!(
        r#"
        [parameters]
        phi = "{degrees} deg"
        r = "0.1 m"
        l = "0.16 m"
        s = "r*cos(phi) + sqrt(l^2 - (r*sin(phi))^2)"
        [points]
        O = [0, 0]
        A = ["r*cos(phi)", "r*sin(phi)"]
        B = ["s", 0]
        [bodies]
        crank = {{ points = ["O", "A"], mass = 1, shape = {{ bar = ["O", "A"] }} }}
        rod = {{ points = ["A", "B"], mass = 1, shape = {{ bar = ["A", "B"] }} }}
        piston = {{ points = ["B"], mass = 1, centre_of_mass = "B", moment_of_inertia = 1e-3 }}
        [joints]
        O = {{ type = "hinge", between = ["crank.O", "ground.O"] }}
        A = {{ type = "hinge", between = ["crank.A", "rod.A"] }}
        B = {{ type = "hinge", between = ["rod.B", "piston.B"] }}
        cylinder = {{ type = "block_slider", block = "piston", at = "B", along = 0, length = 0.1, mu = 0.1 }}
        [coordinates]
        x = {{ slide = "cylinder", drawn_at = "s", rate = -0.1 }}
        "#
    );
    Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The law of cosines: cos(phi) = (x^2 + r^2 - l^2)/(2 r x); the sign of phi is that of the drawing.
#[rstest]
fn a_crank_driven_by_its_slide_stays_on_its_side(
    #[values(0.05, 6.0, 90.0, 179.9, -0.05, -120.0)] drawn: f64,
) {
    let model = driven_by_its_slide(drawn);
    for x in [0.26 - 1e-10, 0.259_997, 0.25, 0.16, 0.08, 0.0601, 0.06 + 1e-10] {
        let state = configured(&model, "x", x).unwrap();
        let cos = (x * x + 0.01 - 0.0256) / (0.2 * x);
        let phi = cos.acos().copysign(drawn);
        // Beside the dead centre the angle is the root of a small difference.
        let sine = phi.sin().abs();
        assert!((state.poses[0].angle() + drawn.to_radians() - phi).abs() < 1e-12 + 1e-14 / sine, "{x}");
    }
    for x in [0.06, 0.26] {
        assert!(matches!(kind(configured(&model, "x", x)), FaultKind::DependentCoordinates { .. }), "{x}");
    }
    for (beyond, limit) in [(0.05, 0.06), (0.27, 0.26)] {
        let fault = kind(configured(&model, "x", beyond));
        let FaultKind::NotAssembled { reached: Some(reached), .. } = &fault else { panic!("{fault:?}") };
        assert_close(first_value(reached), limit, 1.0, 1e-9);
    }
}

/// A linkage of three bars between O and C: crank OA, coupler AB, rocker CB; the coordinate turns one of the
/// bars.
fn linkage(places: [Vector2<f64>; 4], bar: &str) -> Model {
    let [o, a, b, c] = places.map(|place| format!("[{:e}, {:e}]", place.x, place.y));
    let text = format!(
        r#"
        points = {{ O = {o}, A = {a}, B = {b}, C = {c} }}
        [bodies]
        crank = {{ points = ["O", "A"], mass = 1, shape = {{ bar = ["O", "A"] }} }}
        coupler = {{ points = ["A", "B"], mass = 1, shape = {{ bar = ["A", "B"] }} }}
        rocker = {{ points = ["B", "C"], mass = 1, shape = {{ bar = ["B", "C"] }} }}
        [joints]
        O = {{ type = "hinge", between = ["crank.O", "ground.O"] }}
        A = {{ type = "hinge", between = ["coupler.A", "crank.A"] }}
        B = {{ type = "hinge", between = ["rocker.B", "coupler.B"] }}
        C = {{ type = "hinge", between = ["rocker.C", "ground.C"] }}
        [coordinates]
        turn = {{ rotation = "{bar}", rate = 1 }}
        "#
    );
    Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

fn polar(radius: f64, angle: f64) -> Vector2<f64> {
    Vector2::new(radius * angle.cos(), radius * angle.sin())
}

/// Where circles about two points meet, on the left of the way from the first to the second (`side` 1) or
/// right.
fn meeting([one, other]: [Vector2<f64>; 2], radii: [f64; 2], side: f64) -> Vector2<f64> {
    let between = other - one;
    let distance = between.norm();
    let along = (radii[0].powi(2) - radii[1].powi(2) + distance * distance) / (2.0 * distance);
    let across = side * (radii[0].powi(2) - along * along).max(0.0).sqrt();
    let unit = between / distance;
    one + unit * along + Vector2::new(-unit.y, unit.x) * across
}

/// A rocker that turns its crank, drawn near its limit position, where crank and coupler are in line (|OB| =
/// 0.38). The crank is found as the meeting of two circles.
#[rstest]
fn a_four_bar_linkage_near_its_limit_position(
    #[values(1.0, -1.0)] side: f64,
    #[values(1e-2, 1e-5)] before: f64,
) {
    let (o, c) = (Vector2::zeros(), Vector2::new(0.3, 0.0));
    // |OB|^2 = 0.3^2 + 0.2^2 + 2 0.3 0.2 cos(psi)
    let limit = ((0.38_f64.powi(2) - 0.13) / 0.12).acos();
    let drawn = limit + before;
    let pins = |psi: f64| {
        let b = c + polar(0.2, psi);
        [meeting([o, b], [0.1, 0.28], side), b]
    };
    let [a, b] = pins(drawn);
    let model = linkage([o, a, b, c], "rocker");
    for psi in [limit + 1e-11, limit + 1e-6, limit + 0.1, limit + 0.6] {
        let mechanism = at(&model, &[("turn", psi - drawn)]);
        let state = Configuration::new(&mechanism).unwrap();
        let found = state.position(&mechanism, &Attachment::new(Frame::Body(BodyId(0)), a));
        let far = (psi - limit).sqrt();
        assert!((found - pins(psi)[0]).norm() < 1e-12 + 1e-14 / far, "{psi}");
    }
    let fault = kind(configured(&model, "turn", -2.0 * before));
    let FaultKind::NotAssembled { reached: Some(reached), .. } = &fault else { panic!("{fault:?}") };
    // The state is told with five decimals.
    assert!((first_value(reached) + before).abs() < 1e-5, "{reached}");
}

/// Where its bars are in line a parallelogram may become an antiparallelogram: nothing says which.
#[test]
fn where_branches_meet_the_way_ends() {
    let (o, c) = (Vector2::zeros(), Vector2::new(0.3, 0.0));
    let a = polar(0.1, 50_f64.to_radians());
    let model = linkage([o, a, a + c, c], "crank");
    let state = configured(&model, "turn", 129_f64.to_radians()).unwrap();
    assert!(state.poses[1].angle().abs() < 1e-14);
    let fault = kind(configured(&model, "turn", 150_f64.to_radians()));
    let FaultKind::NotFollowed { reached, .. } = &fault else { panic!("{fault:?}") };
    assert_close(first_value(reached), 130_f64.to_radians(), 1.0, 1e-5);
    let fault = kind(configured(&model, "turn", 130_f64.to_radians()));
    assert!(matches!(fault, FaultKind::SingularPosition { .. }), "{fault:?}");
    // Nor can a way begin there.
    let flat = linkage([o, polar(0.1, 0.0), polar(0.1, 0.0) + c, c], "crank");
    let fault = kind(configured(&flat, "turn", 0.5));
    assert!(matches!(fault, FaultKind::SingularPosition { .. }), "{fault:?}");
}

/// Two cranks whose ends two rods join: a grid of both angles, from point to point and each from the drawing,
/// against the meeting of two circles.
#[test]
fn a_grid_of_two_coordinates_is_what_each_way_gives() {
    let (o, c) = (Vector2::zeros(), Vector2::new(0.3, 0.0));
    let pins = |[phi, psi]: [f64; 2]| {
        let (a, e) = (o + polar(0.1, phi), c + polar(0.12, psi));
        [a, e, meeting([a, e], [0.25, 0.22], 1.0)]
    };
    let drawn = [1.0, 2.0];
    let [a, e, b] = pins(drawn);
    let [a_text, e_text, b_text] = [a, e, b].map(|place| format!("[{:e}, {:e}]", place.x, place.y));
    let text = format!(
        r#"
        points = {{ O = [0, 0], C = [0.3, 0], A = {a_text}, E = {e_text}, B = {b_text} }}
        [bodies]
        left = {{ points = ["O", "A"], mass = 1, shape = {{ bar = ["O", "A"] }} }}
        right = {{ points = ["C", "E"], mass = 1, shape = {{ bar = ["C", "E"] }} }}
        long = {{ points = ["A", "B"], mass = 1, shape = {{ bar = ["A", "B"] }} }}
        short = {{ points = ["E", "B"], mass = 1, shape = {{ bar = ["E", "B"] }} }}
        [joints]
        O = {{ type = "hinge", between = ["left.O", "ground.O"] }}
        C = {{ type = "hinge", between = ["right.C", "ground.C"] }}
        A = {{ type = "hinge", between = ["left.A", "long.A"] }}
        E = {{ type = "hinge", between = ["right.E", "short.E"] }}
        B = {{ type = "hinge", between = ["long.B", "short.B"] }}
        [coordinates]
        phi = {{ rotation = "left", drawn_at = {}, rate = 1 }}
        psi = {{ rotation = "right", drawn_at = {}, rate = 1 }}
        "#,
        drawn[0], drawn[1]
    );
    let model = Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut follower = Follower::default();
    for row in 0..6 {
        for column in 0..30 {
            let values = [0.4 + 0.4 * f64::from(row), 1.2 + 0.03 * f64::from(column)];
            let mechanism = at(&model, &[("phi", values[0]), ("psi", values[1])]);
            let along = follower.configuration(&mechanism).unwrap();
            let direct = Configuration::new(&mechanism).unwrap();
            let point = Attachment::new(Frame::Body(BodyId(2)), b);
            for state in [&along, &direct] {
                assert!((state.position(&mechanism, &point) - pins(values)[2]).norm() < 1e-12, "{values:?}");
            }
        }
    }
}

/// Around both folds of the branch, in an order that jumps: a follower refuses what the way from the drawing
/// does not reach, and no more, whatever it has seen before. (Folds from `limits`, at -0.2518411567 and
/// 0.0090867515.)
#[test]
fn a_follower_ends_where_the_way_from_the_drawing_does() {
    let model = Model::parse(BRANCH).unwrap();
    let mut follower = Follower::default();
    let mut reached = 0;
    let places = [
        0.3,
        -0.2518,
        0.009_086,
        0.0091,
        -0.2519,
        -0.1,
        0.009_086_75,
        -0.251_841_15,
        -0.251_841_157,
        0.0,
        -0.4,
    ];
    for offset in [0.0, 3e-9, -4e-7, 1e-5] {
        for place in places {
            let mechanism = at(&model, &[("q0", place + offset)]);
            let (along, direct) = (follower.configuration(&mechanism), Configuration::new(&mechanism));
            assert_eq!(along.is_ok(), direct.is_ok(), "{place} + {offset}");
            let (Ok(along), Ok(direct)) = (along, direct) else { continue };
            reached += 1;
            // Rounding is magnified by |J^-1|, some 1e4 next to a fold.
            for (one, other) in along.poses.iter().zip(&direct.poses) {
                assert!(
                    (one.position - other.position).norm() < 1e-10
                        && (one.angle() - other.angle()).abs() < 1e-10
                );
            }
        }
    }
    assert!((16..40).contains(&reached), "{reached}");
}

/// The sentence of `solve` in every report on a state that was reached by following.
#[test]
fn every_report_says_that_a_state_was_followed() {
    use slideway::limits::LimitsOptions;
    use slideway::motion::{SimulateOptions, simulate};
    use slideway::report::{Style, followed};
    use slideway::standstill::HoldOptions;
    use slideway::{Report, check, limits, motion, standstill};
    let drawer = crate::answers::model("drawer");
    let moved = drawer.with(&Settings::default().position("x", "0.05")).unwrap();
    let told = |model: &Model| {
        let checked = check::check(model).unwrap();
        let held = standstill::hold(model, &HoldOptions::default()).unwrap();
        let options = SimulateOptions::new(0.01);
        let simulated = motion::report(&simulate(model, &options).unwrap(), &options);
        let found =
            limits::limits(model, &LimitsOptions::new(Vary::between("mu", 0.0, 1.0)).effort(0)).unwrap();
        let along =
            limits::limits(model, &LimitsOptions::new(Vary::between("x", 0.0, 0.1)).effort(0)).unwrap();
        assert!(
            along.guarantee.contains("Each position was followed from the drawing"),
            "{}",
            along.guarantee
        );
        let style = Style::PLAIN.verbose(true);
        [
            (checked.steps_from_drawing, checked.text(style)),
            (held.steps_from_drawing, held.text(style)),
            (simulated.steps_from_drawing, simulated.text(style)),
            (found.steps_from_drawing, found.text(style)),
        ]
    };
    for (steps, text) in told(&moved) {
        let sentence = followed(steps.expect("it was followed"));
        assert!(text.contains(&sentence), "{sentence}: {text}");
    }
    for (steps, text) in told(&drawer) {
        assert!(steps.is_none() && !text.contains("followed from the drawing in"), "{text}");
    }
}

/// Steps of the finer way.
const STEPS: u32 = 100;

proptest! {
    #![proptest_config(cases(60))]

    /// A path of fine steps is continuous: neighbouring states differ as their velocities say. It ends where
    /// the way in as few steps as can be shown ends, and back in the drawing.
    #[test]
    fn random_mechanisms_go_forth_and_back(drawing in mechanisms(), share in 0.2..1.5_f64) {
        let model = Model::parse(&drawing.text()).unwrap();
        let drawn = Mechanism::new(&model).unwrap();
        let size = drawn.size;
        let target: Vec<f64> = drawn.coordinates.iter().map(|coordinate| {
            coordinate.drawn_at + share * (coordinate.value - coordinate.drawn_at)
        }).collect();
        let at = |part: f64| {
            let mut mechanism = drawn.clone();
            for (coordinate, to) in mechanism.coordinates.iter_mut().zip(&target) {
                coordinate.rate = to - coordinate.drawn_at;
                coordinate.value = coordinate.drawn_at + part * coordinate.rate;
            }
            mechanism
        };
        let direct = Configuration::new(&at(1.0));
        prop_assume!(direct.is_ok());
        let direct = direct.unwrap();
        let mut follower = Follower::default();
        let mut last: Option<Configuration> = None;
        for step in (0..=STEPS).chain((0..STEPS).rev()) {
            let state = follower.configuration(&at(f64::from(step) / f64::from(STEPS))).unwrap();
            if let Some(last) = &last {
                let way = 0.5 / f64::from(STEPS);
                let bodies = state.poses.iter().zip(&last.poses).zip(state.velocities.iter().zip(&last.velocities));
                for ((to, from), (v, w)) in bodies {
                    let moved = (to.position - from.position).norm() / size;
                    let speed = (v.linear + w.linear).norm() * way / size;
                    prop_assert!((moved - speed).abs() < 1e-3 * (1.0 + speed) * speed.max(1e-3), "{moved} {speed}");
                }
            }
            if step == STEPS {
                for (one, other) in state.poses.iter().zip(&direct.poses) {
                    prop_assert!((one.position - other.position).norm() < 1e-9 * size);
                    prop_assert!((one.angle() - other.angle()).abs() < 1e-9);
                }
            }
            last = Some(state);
        }
        let start = Configuration::new(&at(0.0)).unwrap();
        for (one, other) in last.unwrap().poses.iter().zip(&start.poses) {
            prop_assert!((one.position - other.position).norm() < 1e-12 * size);
            prop_assert!((one.angle() - other.angle()).abs() < 1e-12);
        }
    }
}

/// Where a block turns round in its guide while the mechanism moves on, modes end because friction turns
/// round, not for want of a position.
#[test]
fn modes_end_where_sliding_reverses() {
    let model = Model::parse(BRANCH).unwrap();
    let options = LimitsOptions::new(Vary::between("q0", -0.103, -0.1)).effort(0);
    let modes = limits(&model, &options).unwrap().modes;
    let [ends, begins]: [_; 2] = modes.try_into().unwrap();
    assert_eq!(
        (&*ends.pattern, ends.to_is, &*begins.pattern, begins.from_is),
        ("+-+", ModeEndCause::Reversal, "+--", ModeEndCause::Reversal)
    );
    let place = ends.to.unwrap();
    assert_close(begins.from.unwrap(), place, place, 1e-7);
    let sliding = |q0: f64| {
        let report = report_with(&model, &Settings::default().position("q0", q0.to_string()));
        report.solutions[0].contacts[0].sliding_velocity
    };
    assert!(sliding(place - 1e-6) > 0.0 && sliding(place + 1e-6) < 0.0);
}
