//! `reference/space.toml` as a whole: every case is compared here, with faces or on rods, or is out of reach for a reason.

use crate::answers::{contact, report_on};
use crate::{space, space_rods};
use serde::Deserialize;
use slideway::report::{Proof, Report, Solution, Style};

#[derive(Deserialize)]
struct Reference {
    case: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    labels: Vec<String>,
    count: usize,
    #[serde(default)]
    solution: Vec<Expected>,
}

#[derive(Deserialize)]
struct Expected {
    #[serde(rename = "N")]
    normal: Vec<f64>,
    #[serde(default)]
    effort: Vec<f64>,
    acceleration: Vec<f64>,
    p: f64,
}

/// What is out of reach, and what it would need.
const OUT_OF_REACH: [(&str, &str); 8] = [
    ("turning_rod", "a rod that turns about its axis"),
    ("two_rods_weight", "friction at the diameter of a rod, with a load across it"),
    ("disc_on_three_feet", "feet of a body that turns"),
    ("random_107", "friction at the diameter of a rod"),
    ("random_156", "a rod that turns about its axis"),
    ("random_209", "a rod that turns about its axis"),
    ("random_108", "feet of a body that turns"),
    ("random_100", "a rod that turns about its axis"),
];

/// A block of 2 kg on a guide without friction that is drawn along x, with these supports, a weight at (x, y) and the pull at a
/// height: feet that slide along a guide are supports of its block.
fn on_feet((length, weight): (f64, f64), at: [f64; 2], pull: f64, feet: &[(&str, [f64; 2], &str)]) -> String {
    let [x, y] = at;
    let foot = |(name, [along, aside], more): &(&str, [f64; 2], &str)| {
        format!("supports.{name} = {{ at = {along}, aside = {aside}, normal = \"90 deg\", {more} }}\n")
    };
    let feet: String = feet.iter().map(foot).collect();
    format!(
        "[points]\nC = [0, 0]\nL = [{x}, {y}, 0]\nP = [0, 0, {pull}]\n[bodies.c]\npoints = [\"C\", \"L\", \"P\"]\nmass = 2\n\
         centre_of_mass = \"C\"\nshape = {{ box = [0.1, 0.1, 0.1] }}\n[joints.guide]\ntype = \"block_slider\"\nblock = \"c\"\n\
         at = [0, 0, 0]\nalong = 0\nlength = {length}\nmu = 0\n{feet}[loads.w]\ntype = \"force\"\nat = \"c.L\"\n\
         components = [0, 0, {weight}]\n[drives.d]\ncoordinate = \"x\"\nforce = {{ at = \"c.P\", direction = 0 }}\n\
         [coordinates.x]\nslide = \"guide\"\nrate = 0.1\n",
        weight = -weight,
    )
}

/// Four feet under 40 N at (x, y), the last of them with a stiffness of its own.
fn on_four_feet(at: [f64; 2], last: f64, more: &str) -> String {
    let foot = |stiffness: f64| format!("mu = 0.2, stiffness = {stiffness}{more}");
    let (stiff, last) = (foot(1e6), foot(last));
    let feet = [
        ("FL", [0.1, 0.15], &*stiff),
        ("FR", [0.1, -0.15], &*stiff),
        ("RL", [-0.1, 0.15], &*stiff),
        ("RR", [-0.1, -0.15], &*last),
    ];
    on_feet((0.2, 40.0), at, 0.0, &feet)
}

/// A sledge on three feet under 50 N, pulled at a height.
fn sledge(height: f64) -> String {
    let foot = "mu = 0.3, one_sided = true";
    let feet = [("fl", [0.2, 0.15], foot), ("fr", [0.2, -0.15], foot), ("r", [-0.2, 0.0], foot)];
    on_feet((0.3, 50.0), [0.0; 2], height, &feet)
}

/// A sleeve on a rod that turns with 4 rad/s under it.
fn sleeve(mu: f64) -> String {
    format!(
        "gravity = [0, 0, -9.81]\n[points]\nO = [0, 0]\nC = [0.3, 0, 0.06]\n[bodies.arm]\npoints = [\"O\"]\nmass = 1\n\
         moment_of_inertia = 0.1\ncentre_of_mass = [0, 0]\n[bodies.s]\npoints = [\"C\"]\nmass = 1.5\nmoment_of_inertia = 0.003\n\
         centre_of_mass = \"C\"\nproducts_of_inertia = [0.001, -0.0008]\n[joints.O]\ntype = \"hinge\"\n\
         between = [\"arm.O\", \"ground.O\"]\n[joints.rod]\ntype = \"block_slider\"\nsection = \"round\"\nblock = \"s\"\n\
         guide = \"arm\"\nat = [0.3, 0, 0]\nalong = 0\nlength = 0.08\nmu = {mu}\n\
         supports.key = {{ at = 0, aside = -0.05, normal = \"90 deg\", mu = 0 }}\n[drives.d]\ncoordinate = \"phi\"\n\
         torque = {{ body = \"arm\" }}\n[coordinates.phi]\nrotation = \"arm\"\nrate = 4\n[coordinates.s]\nslide = \"rod\"\n\
         rate = 0.5\n"
    )
}

/// The model of a case that is compared here.
fn model(name: &str) -> Option<String> {
    // A foot of which nothing holds the upper face: its play is beyond what the others yield, with the foot on its lower face.
    let lifts = ", play = 0.01, misalignment = -0.005";
    Some(match name {
        "four_feet" => on_four_feet([0.03, 0.05], 1e6, ""),
        "four_feet_one_lifts" => on_four_feet([0.06, 0.1], 1e6, lifts),
        "four_feet_unequal" => on_four_feet([0.01, 0.02], 1e5, ""),
        "sledge_on_three_feet" => sledge(0.5),
        "sledge_tips" => sledge(0.7),
        "sleeve_on_turning_rod" => sleeve(0.0),
        "sleeve_on_turning_rod_rough" => sleeve(0.25),
        "gate_on_a_pin" => {
            let collar = "carries = \"z\"\ncollar = { friction_radius = 0.0015 }";
            crate::space_pins::GATE.replace("carries = \"z\"", collar)
        }
        _ => return None,
    })
}

/// The forces of a solution by the labels of a case.
fn forces(case: &Case, solution: &Solution) -> Vec<f64> {
    let hinge = |name: &str| solution.hinges.iter().find(|hinge| hinge.name == name).unwrap().force;
    let normal = |name: &str| contact(solution, name).normal_force;
    let of_label = |label: &String| match label.split_once('.').unwrap() {
        ("pin", "collar") => vec![solution.carried[0].value],
        ("pin", bearing) => hinge(bearing).to_vec(),
        ("rod", end) => vec![normal(&format!("rod.{end}")), normal(&format!("rod.{end}.z"))],
        ("key", _) => vec![normal("rod.key")],
        (_, foot) => vec![normal(&format!("guide.{foot}"))],
    };
    case.labels.iter().flat_map(of_label).collect()
}

fn compare(case: &Case, text: &str) {
    let report = report_on(text);
    let lifts = |solution: &&Solution| {
        solution.contacts.iter().any(|contact| contact.gap_acceleration.is_some_and(|gap| gap != 0.0))
    };
    let stays: Vec<&Solution> = report.solutions.iter().filter(|solution| !lifts(solution)).collect();
    assert_eq!(stays.len(), case.count, "{}\n{}", case.name, report.text(Style::PLAIN));
    assert_eq!(report.complete, Proof::Proven, "{}: {:?}", case.name, report.open);
    for (expected, solution) in case.solution.iter().zip(stays) {
        let scale = expected.normal.iter().map(|force| force.abs()).fold(1.0, f64::max);
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-9 * scale;
        for (found, expected) in forces(case, solution).into_iter().zip(&expected.normal) {
            assert!(close(found, *expected), "{}: {found} {expected}", case.name);
        }
        assert!(close(solution.drives[0].effort, expected.effort[0]), "{}", case.name);
        let of_bodies = solution
            .bodies
            .iter()
            .flat_map(|body| [body.acceleration[0], body.acceleration[1], body.angular_acceleration]);
        for (found, expected) in of_bodies.zip(&expected.acceleration) {
            assert!(close(found, *expected), "{}: {found} {expected}", case.name);
        }
        assert!((solution.oriented_determinant - expected.p).abs() < 1e-9, "{}", case.name);
        assert!(solution.residual < 1e-12, "{}: {}", case.name, solution.residual);
    }
}

#[test]
fn every_case_is_compared_or_out_of_reach_for_a_reason() {
    let reference: Reference = toml::from_str(space::REFERENCE).unwrap();
    let elsewhere = [space::compared(), space_rods::compared()].concat();
    let mut here = 0;
    for case in &reference.case {
        let name = case.name.as_str();
        let is_out = OUT_OF_REACH.iter().any(|(out, _)| *out == name);
        match model(name) {
            Some(text) => {
                compare(case, &text);
                here += 1;
            }
            None => assert!(is_out != elsewhere.iter().any(|other| other == name), "{name}"),
        }
    }
    assert_eq!([reference.case.len(), elsewhere.len(), here, OUT_OF_REACH.len()], [44, 28, 8, 8]);
}
