//! Standstill: closed forms of statics, an independent linear program, symmetries, and input that makes no
//! sense.

use crate::answers::{assert_close, model, parameters};
use rstest::rstest;
use slideway::fault::FaultKind;
use slideway::model::{Model, Settings};
use slideway::report::{Report, Style};
use slideway::standstill::{ContactRange, HoldOptions, HoldReport, HoldVerdict, LoadReport, Range, hold};

fn options(load: &str) -> HoldOptions {
    HoldOptions::default().load(load)
}

fn held(name: &str, settings: &[(&str, &str)], options: &HoldOptions) -> HoldReport {
    let model = model(name).with(&parameters(settings)).expect("sound settings");
    hold(&model, options).unwrap_or_else(|faults| panic!("{faults}"))
}

fn held_text(text: &str, options: &HoldOptions) -> HoldReport {
    let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    hold(&model, options).unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

fn load(report: &HoldReport) -> &LoadReport {
    report.load.as_ref().expect("a load is varied")
}

/// The mu_static of the first contact at the threshold.
fn threshold(report: &HoldReport) -> f64 {
    load(report).threshold.coefficients[0].mu_static[0]
}

fn at_rest<'r>(report: &'r HoldReport, contact: &str) -> &'r ContactRange {
    let rest = report.at_rest.as_ref().expect("it holds");
    rest.reactions.contacts.iter().find(|other| other.name == contact).expect("a contact of this name")
}

#[track_caller]
fn assert_range(found: Range, least: f64, greatest: f64, tolerance: f64) {
    let scale = least.abs().max(greatest.abs());
    assert_close(found.least.expect("bounded"), least, scale, tolerance);
    assert_close(found.greatest.expect("bounded"), greatest, scale, tolerance);
}

/// Fails unless a range is `unit` times another.
#[track_caller]
fn assert_same(found: Range, expected: Range, unit: f64) {
    for (found, expected) in [(found.least, expected.least), (found.greatest, expected.greatest)] {
        assert_eq!(found.is_some(), expected.is_some(), "{found:?} {expected:?}");
        assert_close(found.unwrap_or(0.0), unit * expected.unwrap_or(0.0), unit, 1e-10);
    }
}

#[rstest]
fn a_bracket_holds_every_load_from_half_its_height_over_friction_on(
    #[values("0 mm", "30 mm", "300 mm")] d: &str,
    #[values(0.25, 0.4)] mu_static: f64,
) {
    // x = B / (2 mu_static), as long as mu_static d <= B.
    let limit = 0.1524 / (2.0 * mu_static);
    for (factor, locks) in [(0.999, false), (1.0, true), (1.001, true)] {
        let x = format!("{:e} m", limit * factor);
        let mu_static = format!("{mu_static}");
        let report =
            held("bracket-on-pole", &[("x", &x), ("mu_static", &mu_static), ("d", d)], &options("W"));
        assert_eq!((report.holds, load(&report).self_locking), (locks, locks), "x = {x}, d = {d}");
        assert_eq!(report.verdict, if locks { HoldVerdict::MayHold } else { HoldVerdict::DoesNotHold });
        let value = load(&report).threshold.value.expect("there is one");
        assert_close(value, 1.0 / factor, 1.0, 1e-12);
        let all = Range { least: None, greatest: None };
        let zero = Range { least: Some(0.0), greatest: Some(0.0) };
        assert_eq!(load(&report).held, [if locks { all } else { zero }]);
    }
}

#[test]
fn a_wide_bracket_wedges_at_any_distance() {
    // mu_static d > B
    let report = held("bracket-on-pole", &[("x", "1 mm"), ("d", "700 mm")], &options("W"));
    assert!(load(&report).self_locking);
    assert_eq!(at_rest(&report, "sleeve.front").normal_force.greatest, None);
    let value = load(&report).threshold.value.expect("there is one");
    // Where it wedges the reactions grow without bound towards the threshold, which costs a digit.
    assert_close(value, 152.4 / 700.0 / 0.25, 1.0, 1e-11);
}

#[test]
fn a_parameter_can_be_varied_instead_of_all_coefficients() {
    let vary = options("W").vary("mu_static");
    let report = held("bracket-on-pole", &[("x", "0.5 m")], &vary);
    let found = &load(&report).threshold;
    assert_eq!(found.varied, "mu_static");
    assert_close(found.present, 0.25, 0.0, 1e-12);
    assert_close(found.value.expect("there is one"), 0.1524, 0.0, 1e-12);
}

/// A block on an incline under a vertical force, its weight.
fn incline(angle: f64, mu: f64, mu_static: f64) -> String {
    format!(
        r#"
[bodies.block]
mass = 2
centre_of_mass = [0, 0]
moment_of_inertia = 0.01
points = ["c"]
[points]
c = [0, 0]
[joints.plane]
type = "block_slider"
block = "block"
at = "c"
along = "{angle} deg"
length = 0.4
height = 0.1
mu = {mu}
mu_static = {mu_static}
[loads.weight]
type = "force"
at = "block.c"
components = [0, -20]
[coordinates.s]
slide = "plane"
"#
    )
}

#[rstest]
#[case(10.0, HoldVerdict::Holds)]
#[case(13.0, HoldVerdict::HoldsUntilPushed)]
#[case(17.0, HoldVerdict::Moves)]
#[case(-10.0, HoldVerdict::Holds)]
#[case(-13.0, HoldVerdict::HoldsUntilPushed)]
#[case(-17.0, HoldVerdict::Moves)]
fn a_block_on_an_incline_holds_up_to_the_angle_of_static_friction(
    #[case] angle: f64,
    #[case] verdict: HoldVerdict,
) {
    let report = held_text(&incline(angle, 0.2, 0.3), &options("weight"));
    assert_eq!(report.verdict, verdict);
    assert_eq!(load(&report).self_locking, verdict.holds());
    let tangent = angle.to_radians().tan();
    assert_close(threshold(&report), tangent.abs(), 0.0, 1e-12);
    assert_eq!(report.releases.len(), usize::from(verdict != HoldVerdict::Holds));
    for release in &report.releases {
        let found = release.coordinates[0].acceleration;
        // 20 N / 2 kg (sin - mu cos) down the slope
        let (sin, cos) = angle.to_radians().sin_cos();
        let expected = -10.0 * (sin.abs() - 0.2 * cos) * angle.signum();
        assert_range(found, expected, expected, 1e-12);
        assert_eq!(f64::from(release.joints[0].slip), expected.signum());
    }
}

#[test]
fn the_boundary_of_the_incline_counts_as_held() {
    let report = held_text(&incline(17.0, 0.1, 17.0_f64.to_radians().tan()), &options("weight"));
    assert!(report.holds && load(&report).self_locking);
}

/// A wedge of an angle between the ground and a follower that a load presses down; its side guide is smooth.
fn wedge(angle: f64) -> String {
    format!(
        r#"
[points]
w = [0, 0]
f = [0, 0.1]
[bodies.wedge]
mass = 1
centre_of_mass = "w"
moment_of_inertia = 0.01
[bodies.follower]
mass = 1
centre_of_mass = "f"
moment_of_inertia = 0.01
points = ["f"]
[joints.floor]
type = "guided_slider"
block = "wedge"
at = "w"
along = "0 deg"
length = 10
mu = 0.2
[joints.face]
type = "guided_slider"
block = "follower"
guide = "wedge"
at = "f"
along = "{angle} deg"
length = 10
mu = 0.2
[joints.side]
type = "pin_in_slot"
block = "follower"
at = "f"
along = "90 deg"
mu = 0
[loads.press]
type = "force"
at = "follower.f"
components = [0, -100]
[coordinates.x]
slide = "floor"
"#
    )
}

#[rstest]
fn a_wedge_holds_up_to_twice_the_angle_of_friction(#[values(8.0, 20.0, 24.0, -24.0)] angle: f64) {
    let report = held_text(&wedge(angle), &options("press"));
    let limit = (angle.abs() / 2.0).to_radians().tan();
    let floor = load(&report).threshold.coefficients[0].mu_static[0];
    assert_close(floor, limit, 0.0, 1e-12);
    let held = limit <= 0.2;
    assert_eq!((report.holds, load(&report).self_locking), (held, held));
    assert_eq!(report.verdict, if held { HoldVerdict::Holds } else { HoldVerdict::Moves });
}

#[rstest]
#[case("20 deg", "0", 1.221_101_075_3, 1e-10)]
#[case("30 deg", "0", 0.769_800_358_9, 1e-10)]
#[case("30 deg", "12 mm", 0.813_97, 1e-5)]
#[case("40 deg", "0", 0.529_668_263_4, 1e-10)]
fn a_cam_cannot_move_its_follower_beyond_the_pressure_angle(
    #[case] phi: &str,
    #[case] d: &str,
    #[case] mu_lock: f64,
    #[case] tolerance: f64,
) {
    let report = held("cam-follower", &[("phi", phi), ("d", d)], &options("cam"));
    assert_close(threshold(&report), mu_lock, 0.0, tolerance);
    assert_eq!(load(&report).unit, "N");
    assert!(!report.holds, "without the cam the follower falls");
    assert_eq!(report.releases[0].joints[0].words, "stem slides along (0, -1)");
}

#[rstest]
fn a_drawer_jams_from_its_length_over_twice_the_offset_on(#[values("0 m", "0.1 m")] h: &str) {
    let report = held("drawer", &[("h", h)], &options("push"));
    assert_close(threshold(&report), 2.0 / 3.0, 0.0, 1e-12);
    // Q / (1 + 2 mu a / L) to Q / (1 - 2 mu a / L)
    assert_range(load(&report).held[0], 20.0 / 1.45, 20.0 / 0.55, 1e-12);
    // Held at the handle the same efforts are a range.
    let holding = HoldOptions::default().hold_drives(true);
    let report = held("drawer", &[("h", h)], &holding);
    let effort = report.at_rest.expect("it holds").reactions.drives[0].effort;
    assert_range(effort, 20.0 / 1.45, 20.0 / 0.55, 1e-12);
}

#[test]
fn a_crank_cannot_move_a_piston_whose_rod_lies_within_the_cone_of_friction() {
    // A skirt so long that the piston lies flat: tan(beta) = 1 / mu with sin(beta) = r sin(phi) / l.
    let report = held("slider-crank", &[("skirt", "10 m")], &options("torque"));
    let beta = (50.0 / 180.0 * 60.0_f64.to_radians().sin()).asin();
    assert_close(threshold(&report), 1.0 / beta.tan(), 0.0, 1e-11);
    // Otherwise it wedges from skirt / bore on.
    let report = held("slider-crank", &[], &options("gas"));
    assert_close(threshold(&report), 0.75, 0.0, 1e-11);
}

#[test]
fn at_a_dead_centre_the_gas_force_is_held_without_friction() {
    let settings =
        Settings::default().position("phi", "0 deg").parameter("T", "0 N m").parameter("g", "0 m/s^2");
    let model = model("slider-crank").with(&settings).expect("sound settings");
    let report = hold(&model, &options("gas")).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(load(&report).held, [Range { least: None, greatest: None }]);
    assert_eq!(load(&report).threshold.value, Some(0.0));
}

#[test]
fn friction_of_the_paper_at_rest_is_indeterminate() {
    // Theory, section 8, with mu_1 = 0.3 and P = 0.05 m g; t = tan(alpha), forces in m g:
    //   N_1 = 1/2 + (P/2 - F_1) t,   F_1 <= mu_1 N_1,   P - F_1 <= 0.1 (1 - N_1)
    let weight = 9.81;
    let settings = [("F_20", "0 N"), ("mu_1", "0.3"), ("P", "0.05*m*g")];
    let report = held("klepp-2002", &settings, &HoldOptions::default());
    assert_eq!(report.verdict, HoldVerdict::Holds);
    let t = 80.0_f64.to_radians().tan();
    let least = 0.05 * 0.05 * t / (1.0 + 0.1 * t);
    let greatest = (0.15 + 0.3 * 0.025 * t) / (1.0 + 0.3 * t);
    assert_range(at_rest(&report, "upper").friction_force, weight * least, weight * greatest, 1e-12);
    assert_eq!(((least * 1e3).round(), (greatest * 1e3).round()), (9.0, 71.0));
}

/// A block on two contacts, its middle at the origin, under a given force and a load.
#[derive(Debug, Clone, Copy)]
struct Block {
    length: f64,
    height: f64,
    mu: [f64; 2],
    /// Place, then force.
    given: [f64; 4],
    load: [f64; 4],
}

impl Block {
    fn text(&self) -> String {
        let Self { length, height, mu, given, load } = self;
        let force = |name: &str, [.., x, y]: [f64; 4]| {
            format!("[loads.{name}]\ntype = \"force\"\nat = \"b.{name}\"\ncomponents = [{x}, {y}]\n")
        };
        format!(
            "[points]\ng = [{}, {}]\nl = [{}, {}]\n[bodies.b]\nmassless = true\npoints = [\"g\", \"l\"]\n\
             [joints.j]\ntype = \"block_slider\"\nblock = \"b\"\nat = [0, 0]\nalong = \"0 deg\"\nlength = {length}\n\
             height = {height}\nfront = {{ mu = {} }}\nrear = {{ mu = {} }}\n{}{}[coordinates.x]\nslide = \"j\"\n",
            given[0],
            given[1],
            load[0],
            load[1],
            mu[0],
            mu[1],
            force("g", *given),
            force("l", *load),
        )
    }

    /// The constraints `a e + b factor <= c` of a pattern of sides, e being the difference of the frictions.
    fn constraints(&self, sides: [f64; 2]) -> Vec<[f64; 3]> {
        // Each of these is [coefficient of e, of the factor, constant].
        let moment = |[x, y, fx, fy]: [f64; 4]| x * fy - y * fx;
        let sum = [0.0, self.load[2], self.given[2]];
        let friction = [1.0, -1.0].map(|sign| [sign / 2.0, sum[1] / 2.0, sum[2] / 2.0]);
        let normals = [0.0, -self.load[3], -self.given[3]];
        // L/2 (N_1 - N_2) = -moments + sum of side h/2 F
        let difference: Vec<f64> = (0..3)
            .map(|i| {
                let loads = [0.0, moment(self.load), moment(self.given)][i];
                let arms = sides[0] * friction[0][i] + sides[1] * friction[1][i];
                2.0 / self.length * (self.height / 2.0 * arms - loads)
            })
            .collect();
        let mut constraints = Vec::new();
        for k in 0..2 {
            let sign = [1.0, -1.0][k];
            let pressure: Vec<f64> =
                (0..3).map(|i| sides[k] * (normals[i] + sign * difference[i]) / 2.0).collect();
            constraints.push([-pressure[0], -pressure[1], pressure[2]]);
            for sign in [1.0, -1.0] {
                let row: Vec<f64> =
                    (0..3).map(|i| sign * friction[k][i] - self.mu[k] * pressure[i]).collect();
                constraints.push([row[0], row[1], -row[2]]);
            }
        }
        constraints
    }

    /// Least and greatest factor in a box, over the vertices of all patterns.
    fn extent(&self, most: f64) -> Option<[f64; 2]> {
        let mut extent: Option<[f64; 2]> = None;
        for sides in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let mut rows = self.constraints(sides);
            rows.extend([[1.0, 0.0, most], [-1.0, 0.0, most], [0.0, 1.0, most], [0.0, -1.0, most]]);
            for (i, a) in rows.iter().enumerate() {
                for b in &rows[..i] {
                    let determinant = a[0] * b[1] - a[1] * b[0];
                    if determinant.abs() < 1e-12 {
                        continue;
                    }
                    let e = (a[2] * b[1] - a[1] * b[2]) / determinant;
                    let factor = (a[0] * b[2] - a[2] * b[0]) / determinant;
                    let tolerance = 1e-9 * (1.0 + e.abs() + factor.abs());
                    if rows.iter().all(|row| row[0] * e + row[1] * factor <= row[2] + tolerance) {
                        let old = extent.unwrap_or([factor; 2]);
                        extent = Some([old[0].min(factor), old[1].max(factor)]);
                    }
                }
            }
        }
        extent
    }
}

/// Numbers from -1 to 1 that look random.
fn numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

#[test]
fn held_factors_are_those_of_an_enumeration_of_vertices() {
    const MOST: f64 = 1e4;
    let mut next = numbers();
    let [mut bounded, mut unbounded] = [0; 2];
    for _ in 0..120 {
        let force = |next: &mut dyn FnMut() -> f64| [next(), next(), 10.0 * next(), 10.0 * next()];
        let block = Block {
            length: 0.5 + next().abs(),
            height: 0.5 * next().abs(),
            mu: [next().abs(), next().abs()],
            given: force(&mut next),
            load: force(&mut next),
        };
        let report = held_text(&block.text(), &options("l"));
        let found = &load(&report).held;
        assert_eq!(report.undecided, 0);
        let Some(expected) = block.extent(MOST) else {
            assert!(found.is_empty(), "{block:?}: {found:?}");
            continue;
        };
        // The hull of a union that may have gaps.
        let (first, last) = (found.first().expect("held"), found.last().expect("held"));
        for (found, expected) in [(first.least, expected[0]), (last.greatest, expected[1])] {
            match found {
                Some(found) => assert_close(found, expected, 1.0, 1e-9),
                None => assert!(expected.abs() > 0.02 * MOST, "{block:?}: {expected}"),
            }
            if found.is_some() { bounded += 1 } else { unbounded += 1 }
        }
    }
    assert!(bounded > 40 && unbounded > 40, "{bounded} {unbounded}");
}

#[test]
fn greater_forces_scale_the_reactions_and_keep_the_factors() {
    let base = held("klepp-2002", &[("P", "0.5 N")], &options("P"));
    let scaled = held("klepp-2002", &[("P", "500 N"), ("m", "1000 kg")], &options("P"));
    assert_eq!(base.verdict, scaled.verdict);
    let (one, other) = (load(&base), load(&scaled));
    assert_eq!(one.held.len(), other.held.len());
    for (one, other) in one.held.iter().zip(&other.held) {
        assert_same(*other, *one, 1.0);
    }
    for name in ["upper", "lower.front", "lower.rear"] {
        let (one, other) = (at_rest(&base, name), at_rest(&scaled, name));
        for (one, other) in
            [(one.normal_force, other.normal_force), (one.friction_force, other.friction_force)]
        {
            assert_same(other, one, 1e3);
        }
    }
}

#[test]
fn the_mirror_image_holds_the_opposite_loads() {
    let mut next = numbers();
    for _ in 0..20 {
        let block = Block {
            length: 0.6,
            height: 0.3,
            mu: [0.3, 0.5],
            given: [next(), next(), next(), 10.0 * next()],
            load: [next(), next(), 10.0 * next(), next()],
        };
        let across = |[x, y, fx, fy]: [f64; 4]| [-x, y, -fx, fy];
        let mirrored =
            Block { mu: [0.5, 0.3], given: across(block.given), load: across(block.load), ..block };
        let (one, other) =
            (held_text(&block.text(), &options("l")), held_text(&mirrored.text(), &options("l")));
        assert_eq!(load(&one).held.len(), load(&other).held.len());
        for (one, other) in load(&one).held.iter().zip(&load(&other).held) {
            assert_same(*other, *one, 1.0);
        }
    }
}

#[test]
fn the_order_of_the_joints_does_not_matter() {
    let text = wedge(24.0);
    let [floor, face, side, rest] = ["[joints.floor]", "[joints.face]", "[joints.side]", "[loads.press]"]
        .map(|at| text.find(at).unwrap());
    let swapped =
        [&text[..floor], &text[side..rest], &text[face..side], &text[floor..face], &text[rest..]].concat();
    let (one, other) = (held_text(&text, &options("press")), held_text(&swapped, &options("press")));
    assert_eq!(one.verdict, other.verdict);
    let (first, second) = (&one.releases[0], &other.releases[0]);
    let (a, b) = (first.coordinates[0].acceleration, second.coordinates[0].acceleration);
    assert_range(b, a.least.expect("bounded"), a.greatest.expect("bounded"), 1e-12);
}

#[test]
fn the_painleve_klein_apparatus_can_hold_and_slip() {
    // It slides without rotation, so that `solve` has the same accelerations at any velocity: those in the
    // direction of the velocity begin a motion from rest.
    let settings = [("mu", "4"), ("P_1", "12 N")];
    let report = held("painleve-klein", &settings, &HoldOptions::default());
    assert_eq!(report.verdict, HoldVerdict::HoldsOrSlips);
    let mut expected = Vec::new();
    for direction in ["1", "-1"] {
        let settings = [&settings[..], &[("direction", direction)]].concat();
        for solution in crate::answers::report("painleve-klein", &settings).solutions {
            let acceleration = solution.coordinates[0].acceleration;
            if acceleration * direction.parse::<f64>().unwrap() > 0.0 {
                expected.push(acceleration);
            }
        }
    }
    let mut found: Vec<f64> =
        report.releases.iter().map(|release| release.coordinates[0].acceleration.least.unwrap()).collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    assert_eq!((found.len(), expected.len()), (2, 2));
    for (found, expected) in found.into_iter().zip(expected) {
        assert_close(found, expected, 0.0, 1e-12);
    }
}

#[test]
fn a_guided_slider_that_would_tip_can_do_neither() {
    let text = include_str!("../../../../docs/src/examples/guided-tips.toml");
    let report = held_text(text, &HoldOptions::default());
    assert_eq!((report.verdict, report.holds), (HoldVerdict::Neither, false));
    let report = held_text(&text.replace("guided_slider", "block_slider"), &HoldOptions::default());
    assert_eq!(report.verdict, HoldVerdict::Moves);
}

#[test]
fn a_load_comes_before_a_drive_of_the_same_name() {
    let text = slideway::gallery::find("drawer").expect("in the gallery").text;
    let text = text.replace("[drives.push]", "[drives.resistance]");
    let holding = options("resistance").hold_drives(true);
    let report = held_text(&text, &holding);
    assert_eq!((load(&report).unit, report.holds), ("", true));
    assert_eq!(report.holding_drives, ["resistance"]);
}

#[test]
fn sticking_and_slipping_joints_coexist() {
    let report = held("telescopic-boom", &[], &HoldOptions::default());
    assert_eq!(report.verdict, HoldVerdict::Moves);
    let slips: Vec<i8> = report.releases[0].joints.iter().map(|joint| joint.slip).collect();
    assert_eq!((report.releases.len(), slips), (1, vec![0, 0, 1]));
}

#[rstest]
#[case(options("Q"), "there is no load named `Q`")]
#[case(options("spring"), "the load spring is zero at rest, so no factor changes it")]
#[case(options("P").vary("mu_9"), "there is no parameter named `mu_9`")]
#[case(options("P").vary("alpha"), "`alpha` needs a range: alpha=FROM..TO")]
fn faulty_questions_are_refused(#[case] options: HoldOptions, #[case] message: &str) {
    let model = model("klepp-2002").with(&parameters(&[("P", "1 N")])).expect("sound settings");
    let faults = hold(&model, &options).expect_err("refused");
    assert_eq!(faults.sorted()[0].kind.to_string(), message);
}

#[test]
fn too_many_states_are_refused() {
    let text = slideway::gallery::telescopic_boom(5).expect("a boom");
    let faults = hold(&Model::parse(&text).unwrap(), &HoldOptions::default()).expect_err("refused");
    assert!(matches!(faults.sorted()[0].kind, FaultKind::TooManyStates { states: 248_832, .. }));
}

/// A sash of width b and height H without cords: any couple wedges it in from mu = H/b = 2/3 on, and free of
/// contact forces it falls. So it is self-locking, and may fall nonetheless, which its load's section says.
#[test]
fn a_wedged_load_is_not_relied_on() {
    let text = include_str!("../findings/sash.toml");
    let told = |mu: &str| {
        let settings = parameters(&[("mu", mu), ("mu_s", mu), ("cord_force", "0 N")]);
        let model = Model::parse(text).expect("sound").with(&settings).expect("sound settings");
        let report = hold(&model, &options("gravity")).expect("solvable");
        let text = report.text(Style::PLAIN);
        let doubts = ["do not rely on it", "wedged by a knock"].map(|words| text.contains(words));
        (report.verdict, load(&report).self_locking, doubts)
    };
    assert_eq!(told("0.7"), (HoldVerdict::HoldsOrSlips, true, [true, true]));
    assert_eq!(told("0.6"), (HoldVerdict::Moves, false, [false, true]));
}
