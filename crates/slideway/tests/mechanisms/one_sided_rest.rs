//! Contacts that may lift off, at rest: the cases of `reference/one-sided-rest.toml`, closed forms, and what gives way.

use crate::one_sided_systems::System;
use rstest::rstest;
use serde::Deserialize;
use slideway::limits::{Vary, rest_limits};
use slideway::model::{Model, Settings};
use slideway::report::Report;
use slideway::standstill::{
    ContactRange, HoldOptions, HoldReport, HoldVerdict, Range, Reactions, Release, hold,
};

const REFERENCE: &str = include_str!("../../../../reference/one-sided-rest.toml");
const BOX: &str = include_str!("../../models/box-on-incline.toml");
const LADDER: &str = include_str!("../../models/ladder.toml");
const GRAVITY: f64 = 9.81;

#[derive(Deserialize)]
struct Reference {
    rest: Vec<RestCase>,
    ladder: Ladder,
    boxes: Vec<BoxCase>,
    peg: Peg,
}

/// All states in which a mechanism begins to move.
#[derive(Deserialize)]
struct RestCase {
    name: String,
    #[serde(flatten)]
    system: System,
    states: Vec<RestState>,
}

#[derive(Deserialize)]
struct RestState {
    #[serde(rename = "N")]
    normal: Vec<f64>,
    gap: Vec<f64>,
    slip: Vec<f64>,
}

#[derive(Deserialize)]
#[expect(non_snake_case, reason = "names of the reference")]
struct Ladder {
    N_floor: [f64; 2],
    T_floor: [f64; 2],
    N_wall: [f64; 2],
    T_wall: [f64; 2],
}

#[derive(Deserialize)]
struct BoxCase {
    beta_deg: f64,
    b: f64,
    h: f64,
    mu_static: f64,
    holds: bool,
}

#[derive(Deserialize)]
struct Peg {
    diameter: f64,
    depth: f64,
    mu: f64,
    points: Vec<PegPoint>,
}

#[derive(Deserialize)]
#[expect(non_snake_case, reason = "names of the reference")]
struct PegPoint {
    Fx_over_Fz: f64,
    M_over_rFz: f64,
    jams: bool,
}

fn reference() -> Reference {
    toml::from_str(REFERENCE).unwrap()
}

fn held(text: &str, list: &[(&str, &str)], options: &HoldOptions) -> HoldReport {
    let settings = list.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    hold(&Model::parse(text).unwrap().with(&settings).unwrap(), options).unwrap()
}

fn contact<'r>(reactions: &'r Reactions, name: &str) -> &'r ContactRange {
    reactions.contacts.iter().find(|contact| contact.name == name).expect("a contact of this name")
}

fn assert_range(range: Range, expected: [f64; 2], name: &str) {
    let [least, greatest] = [range.least.unwrap(), range.greatest.unwrap()];
    for (found, expected) in [(least, expected[0]), (greatest, expected[1])] {
        assert!((found - expected).abs() < 1e-8 * expected.abs().max(1.0), "{name}: {range:?}, {expected}");
    }
}

fn value(range: Range) -> f64 {
    let (least, greatest) = (range.least.unwrap(), range.greatest.unwrap());
    assert!(greatest - least <= 1e-7 * greatest.abs().max(1.0), "{range:?}");
    f64::midpoint(least, greatest)
}

/// Every state in which something begins to move, and no other.
#[test]
fn the_reference_begins_to_move_in_these_states() {
    // At rest drives are absent, and so are velocities.
    let rests = |case: &RestCase| {
        case.system.drives.is_empty() && case.system.bodies.iter().all(|body| body.velocity == [0.0; 3])
    };
    for RestCase { name, system, states } in reference().rest.into_iter().filter(rests) {
        let found = held(&system.text(), &[], &HoldOptions::default());
        assert!(found.undecided == 0 && !found.holds, "{name}");
        assert_eq!(found.releases.len(), states.len(), "{name}: {:#?}", found.releases);
        for state in &states {
            let is = |release: &&Release| state.is(release, &system);
            assert_eq!(found.releases.iter().filter(is).count(), 1, "{name}: {:#?}", found.releases);
        }
    }
}

impl RestState {
    fn is(&self, release: &Release, system: &System) -> bool {
        let near = |one: f64, other: f64| (one - other).abs() < 1e-7 * other.abs().max(1.0);
        let of_contact = |(k, one): (usize, &crate::one_sided_systems::Contact)| {
            let gap = release.gaps.iter().find(|gap| gap.contact == one.name);
            let joint = release.joints.iter().find(|joint| joint.name == one.name).expect("its joint");
            let opens = gap.map_or(0.0, |gap| value(gap.acceleration));
            near(value(contact(&release.reactions, &one.name).normal_force), self.normal[k])
                && near(opens, self.gap[k])
                && (gap.is_some() || near(value(joint.acceleration), self.slip[k]))
        };
        system.contacts.iter().enumerate().all(of_contact)
    }
}

/// Reactions at rest are ranges: four forces, three equations.
#[test]
fn the_ladder_holds() {
    let expected = reference().ladder;
    let found = held(LADDER, &[], &HoldOptions::default());
    assert_eq!(found.verdict, HoldVerdict::Holds);
    assert_eq!(
        (found.answer().as_str(), found.rest_patterns),
        ("It holds with a safety factor of 1.815.", 1)
    );
    let reactions = &found.at_rest.as_ref().unwrap().reactions;
    let [foot, head] = ["foot", "head"].map(|name| contact(reactions, name));
    // Friction is counted against the direction of sliding.
    let friction = |contact: &ContactRange| {
        let Range { least, greatest } = contact.friction_force;
        Range { least: greatest.map(|end| -end), greatest: least.map(|end| -end) }
    };
    assert_range(foot.normal_force, expected.N_floor, "N_floor");
    assert_range(head.normal_force, expected.N_wall, "N_wall");
    assert_range(friction(foot), expected.T_floor, "T_floor");
    assert_range(friction(head), expected.T_wall, "T_wall");
}

/// Against a smooth wall `tan(lean) mu >= (m/2 + c M)/(m + M)`, where the person of mass M has climbed the part c.
#[rstest]
#[case(0.2)]
#[case(0.5)]
#[case(1.0)]
fn a_ladder_slips_at_the_friction_of_the_closed_form(#[case] climbed: f64) {
    let least = (5.0 + 80.0 * climbed) / 90.0 / 60_f64.to_radians().tan();
    for (part, holds) in [(1.0 - 1e-6, false), (1.0 + 1e-6, true)] {
        let list = [("mu", (part * least).to_string()), ("climbed", climbed.to_string())];
        let list: Vec<(&str, &str)> = list.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let text = LADDER.replace("mu = 0.3", "mu = 0").replace("mu = 0.5", "mu = \"mu\"");
        let text = text.replace("[parameters]", "[parameters]\nmu = 0.5");
        assert_eq!(held(&text, &list, &HoldOptions::default()).holds, holds, "{least}");
    }
}

/// With both of its ends about to slip: `N_head = mu_foot W/(1 + mu_foot mu_head)`, `m/2 + c M = N_head (tan(lean) + mu_head)/g`.
#[test]
fn a_person_climbs_as_far_as_the_closed_form_says() {
    let vary = Vary::between("climbed", "0", "1");
    let found = rest_limits(&Model::parse(LADDER).unwrap(), &vary, &HoldOptions::default()).unwrap();
    let [holds, slips] = found.spans.as_slice() else { panic!("{:?}", found.spans) };
    assert_eq!((holds.holds, slips.holds), (Some(true), Some(false)));
    let climbed = (0.5 * 90.0 / 1.15 * (60_f64.to_radians().tan() + 0.3) - 5.0) / 80.0;
    assert!((holds.to - climbed).abs() < 1e-8, "{}, {climbed}", holds.to);
}

/// A lever on a rough pin, its end on the floor (and a cart beside it that gives the model a freedom): the couple of the pin, `|M| <= r R`, adds `M/L` to half of the weight.
#[test]
fn hinges_with_friction_beside_them_widen_the_ranges() {
    let found = held(LEVER, &[], &HoldOptions::default());
    let force = contact(&found.at_rest.as_ref().unwrap().reactions, "tip").normal_force;
    // N = m g/2 + M/L, R = m g - N, M = +- r R.
    let end = |sign: f64| GRAVITY * (0.5 + sign * 0.02) / (1.0 + sign * 0.02);
    assert_range(force, [end(-1.0), end(1.0)], "tip");
    assert_eq!(found.verdict, HoldVerdict::Holds);
}

const LEVER: &str = r#"
gravity = "9.81 m/s^2"
[points]
O = [0, 0]
C = [0.5, 0]
tip = [1, 0]
K = [3, 0]
[bodies.lever]
points = ["O", "C", "tip"]
mass = 1
moment_of_inertia = 0.1
centre_of_mass = "C"
[joints.pin]
type = "hinge"
between = ["ground.O", "lever.O"]
friction_radius = 0.02
[joints.tip]
type = "corner_on_face"
block = "lever"
at = "tip"
along = "0 deg"
mu = 0
[bodies.cart]
points = ["K"]
mass = 1
moment_of_inertia = 0.1
centre_of_mass = "K"
[joints.rail]
type = "guided_slider"
block = "cart"
at = "K"
along = "0 deg"
length = 0.1
mu = 0
[coordinates.x]
slide = "rail"
"#;

/// A disc between two walls is wedged without any load from `mu = tan(alpha)` on, with half of their angle `alpha`: the line through
/// both contacts lies in both cones then.
#[rstest]
#[case(20.0)]
#[case(30.0)]
#[case(45.0)]
fn a_disc_is_wedged_from_the_tangent_of_the_half_angle_on(#[case] alpha: f64) {
    let text = include_str!("../../models/shaft-in-v-block.toml");
    for (part, wedged) in [(1.0 - 1e-6, false), (1.0 + 1e-6, true)] {
        let mu = (part * alpha.to_radians().tan()).to_string();
        let beta = format!("{} deg", 90.0 - alpha);
        let list = [("mu", mu.as_str()), ("beta", beta.as_str()), ("speed", "0")];
        let found = held(text, &list, &HoldOptions::default());
        let wedging = &found.at_rest.as_ref().unwrap().wedging;
        assert_eq!(!wedging.is_empty(), wedged, "{alpha} {wedging:?}");
    }
}

/// Nothing pulls a ladder to its wall.
#[test]
fn a_ladder_is_pulled_off_its_wall() {
    let pull = "[loads.pull]\ntype = \"force\"\nat = \"ladder.head\"\ncomponents = [\"-2 kN\", 0]\n[coordinates.slide_out]";
    let text = LADDER.replace("[coordinates.slide_out]", pull);
    let found = held(&text, &[], &HoldOptions::default());
    assert_eq!(found.verdict, HoldVerdict::Moves);
    assert!(found.answer().starts_with("It does not hold: head lifts off"), "{}", found.answer());
    let held = held(&text, &[], &HoldOptions::default().load("pull")).load.unwrap().held;
    // Loads are held from one end to the other: the program is convex.
    assert_eq!(held.len(), 1);
    // Pushed against the wall it holds however hard.
    assert!(held[0].least.is_none() && held[0].greatest.unwrap() < 1.0, "{held:?}");
}

/// A box holds iff `tan(beta) <= min(mu_static, b/h)`.
#[test]
fn a_box_holds_or_slides_or_tips() {
    for BoxCase { beta_deg, b, h, mu_static, holds } in reference().boxes {
        let list = [("b", b), ("h", h)].map(|(name, value)| (name, format!("{value} m")));
        let list =
            list.into_iter().chain([("slope", format!("{beta_deg} deg")), ("mu", mu_static.to_string())]);
        let list: Vec<(&str, String)> = list.collect();
        let list: Vec<(&str, &str)> = list.iter().map(|(name, value)| (*name, value.as_str())).collect();
        assert_eq!(held(BOX, &list, &HoldOptions::default()).holds, holds, "{list:?}");
    }
}

/// From `mu = tan(beta)` on its weight is held, however great, if it does not tip.
#[test]
fn the_friction_that_holds_a_box_is_the_tangent_of_its_slope() {
    let gravity = HoldOptions::default().load("gravity");
    let load = held(BOX, &[], &gravity).load.unwrap();
    let tangent = 20_f64.to_radians().tan();
    assert!((load.threshold.value.unwrap() * 0.6 - tangent).abs() < 1e-12, "{:?}", load.threshold);
    assert!(load.certain_from.is_some());
    let upright = held(BOX, &[], &gravity);
    let expected = "It holds. It holds any `gravity`. By itself `gravity` is held, however great, from mu = 0.364 (now 0.6).";
    assert_eq!(upright.answer(), expected);
    let tipping = held(BOX, &[("b", "140 mm")], &gravity);
    assert_eq!(tipping.load.unwrap().threshold.value, None);
}

/// Over the lower edge, with `(h/2 sin - b/2 cos) m g = (J + m (b^2 + h^2)/4) alpha`; the upper corner rises by `b alpha`.
#[test]
fn a_box_tips_over_its_lower_edge() {
    let found = held(BOX, &[("b", "100 mm"), ("slope", "25 deg"), ("mu", "0.8")], &HoldOptions::default());
    assert_eq!(found.answer(), "It does not hold: it tips over base.rear. More friction would not hold it.");
    let (sin, cos) = 25_f64.to_radians().sin_cos();
    let alpha = 1.5 * GRAVITY * (0.4 * sin - 0.1 * cos) / (0.1_f64.powi(2) + 0.4_f64.powi(2));
    let [release] = found.releases.as_slice() else { panic!("{:?}", found.releases) };
    assert_eq!((release.joints[0].slip, release.joints[0].words.as_str()), (0, "tips over base.rear"));
    assert_eq!(release.joints[0].open, ["base.front"]);
    assert!((value(release.gaps[0].acceleration) - 0.1 * alpha).abs() < 1e-9);
    // The box of the reference at 40 deg with mu = 0.3.
    let both = held(BOX, &[("b", "100 mm"), ("slope", "40 deg"), ("mu", "0.3")], &HoldOptions::default());
    let tips = "It does not hold: it tips over base.rear and slides. More friction would not hold it.";
    assert_eq!(both.answer(), tips);
    let [release] = both.releases.as_slice() else { panic!("{:?}", both.releases) };
    assert!((value(release.gaps[0].acceleration) - 0.549_870_438_1).abs() < 1e-9);
    assert!((value(release.joints[0].acceleration) + 2.869_056_213).abs() < 1e-8);
}

/// A third corner in the middle of the base: of level weight it carries any part, and the others the rest.
#[test]
fn three_corners_on_a_line_share_their_load_in_ranges() {
    let third = "[joints.third]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = \"M\"\nalong = \"slope\"\nmu = \"mu\"\n[coordinates.x]";
    let found = held(&BOX.replace("[coordinates.x]", third), &[("slope", "0 deg")], &HoldOptions::default());
    assert_eq!(found.verdict, HoldVerdict::Holds);
    let reactions = &found.at_rest.as_ref().unwrap().reactions;
    assert_range(contact(reactions, "third").normal_force, [0.0, GRAVITY], "third");
    assert_range(contact(reactions, "base.front").normal_force, [0.0, GRAVITY / 2.0], "front");
    assert!(found.at_rest.unwrap().wedging.is_empty());
}

/// Whitney's diagram: the peg slides in inside his parallelogram. Corners that can touch together are tried in pairs.
#[test]
fn a_peg_jams_outside_the_parallelogram() {
    let Peg { diameter, depth, mu, points } = reference().peg;
    let radius = diameter / 2.0;
    for PegPoint { Fx_over_Fz: across, M_over_rFz: moment, jams } in points {
        assert_eq!(peg_is_held([radius, depth, mu], [across, moment]), jams, "{across} {moment}");
    }
}

/// Whether a peg of this radius and depth is held under the loads (across, -1) and a moment (parts of the radius) at the centre
/// of its tip, by some pair of corners that can touch together.
fn peg_is_held([radius, depth, mu]: [f64; 3], [across, moment]: [f64; 2]) -> bool {
    let text = |pair: [&str; 2]| {
        let joint = |name: &str| {
            let (x, along) = if name.ends_with("left") { (-radius, -90) } else { (radius, 90) };
            if name.starts_with("tip") {
                format!(
                    "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"peg\"\nat = [{x}, {}]\nalong = \"{along} deg\"\nmu = {mu}\n",
                    -depth
                )
            } else {
                format!(
                    "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"ground\"\nguide = \"peg\"\nat = [{x}, 0]\nalong = \"{} deg\"\nmu = {mu}\n",
                    -along
                )
            }
        };
        format!(
            "[points]\nT = [0, {}]\n[bodies.peg]\npoints = [\"T\"]\nmass = 1\nmoment_of_inertia = 1e-4\ncentre_of_mass = \"T\"\n\
             {}{}[loads.F]\ntype = \"force\"\nat = \"peg.T\"\ncomponents = [{across}, -1]\n\
             [loads.M]\ntype = \"torque\"\nbody = \"peg\"\nmoment = {}\n[coordinates.depth]\ny = \"peg.T\"\n",
            -depth,
            joint(pair[0]),
            joint(pair[1]),
            moment * radius
        )
    };
    let pairs = [
        ["tip_left", "mouth_right"],
        ["tip_right", "mouth_left"],
        ["tip_left", "mouth_left"],
        ["tip_right", "mouth_right"],
    ];
    pairs.iter().any(|pair| held(&text(*pair), &[], &HoldOptions::default()).holds)
}

/// Over 1,000 loads it jams exactly outside the parallelogram `|F_x/F_z| < 1/mu`, `|M/(r F_z) + mu (1 + lambda) F_x/F_z| < lambda`
/// with `lambda = depth/(2 r mu)` (Whitney 1982).
#[test]
fn a_peg_jams_exactly_outside_the_parallelogram_over_many_loads() {
    let Peg { diameter, depth, mu, .. } = reference().peg;
    let lambda = depth / (diameter * mu);
    let mut jams = 0;
    for number in 0..1000 {
        // Spread evenly over a rectangle around the parallelogram.
        let [u, v] = [0.754_877_666, 0.569_840_291].map(|step| (f64::from(number) * step).fract());
        let (across, moment) = ((2.0 * u - 1.0) * 1.3 / mu, (2.0 * v - 1.0) * 2.4 * lambda);
        let slacks = [1.0 / mu - across.abs(), lambda - (moment + mu * (1.0 + lambda) * across).abs()];
        let is_inside = slacks.iter().all(|slack| *slack > 0.0);
        if slacks.iter().all(|slack| slack.abs() > 1e-6) {
            let is_held = peg_is_held([diameter / 2.0, depth, mu], [across, moment]);
            assert_eq!(is_held, !is_inside, "{across} {moment}");
            jams += usize::from(is_held);
        }
    }
    assert!((400..900).contains(&jams), "{jams}");
}

/// A peg is wedged iff the line through both of its corners is within both friction cones.
#[test]
fn a_peg_wedges_where_its_corners_are_in_both_cones() {
    for tilt in [0.4, 0.8, 1.0, 1.5, 2.0_f64] {
        let (sin, cos) = tilt.to_radians().sin_cos();
        let (r, a) = (10.0, 10.05);
        let tip = r * sin + (r * (1.0 + cos * cos) - 2.0 * a * cos) / sin;
        let line = (-tip / (2.0 * a)).atan();
        let least = (line.max(line + tilt.to_radians())).tan();
        for (part, wedges) in [(1.0 - 1e-6, false), (1.0 + 1e-6, true)] {
            let list = [("tilt", format!("{tilt} deg")), ("mu", (part * least).to_string())];
            let list: Vec<(&str, &str)> = list.iter().map(|(name, value)| (*name, value.as_str())).collect();
            let found = held(PEG, &list, &HoldOptions::default());
            let wedged = !found.at_rest.as_ref().unwrap().wedging.is_empty();
            assert_eq!((found.holds, wedged), (true, wedges), "{tilt}: {least}");
        }
    }
}

const PEG: &str = r#"
[parameters]
r = "10 mm"
a = "10.05 mm"
tilt = "1 deg"
mu = 0.15
x_t = "a - r*cos(tilt)"
y_t = "(r*(1 + cos(tilt)^2) - 2*a*cos(tilt))/sin(tilt)"
[points]
T = ["x_t", "y_t"]
tip = ["x_t + r*cos(tilt)", "y_t + r*sin(tilt)"]
mouth = ["-a", 0]
[bodies.peg]
points = ["T", "tip"]
mass = "0.2 kg"
moment_of_inertia = "1.1 kg cm^2"
centre_of_mass = "T"
[joints.tip]
type = "corner_on_face"
block = "peg"
at = "tip"
along = "90 deg"
mu = "mu"
[joints.mouth]
type = "corner_on_face"
block = "ground"
guide = "peg"
at = "mouth"
along = "90 deg + tilt"
mu = "mu"
[coordinates.depth]
y = "peg.T"
"#;
