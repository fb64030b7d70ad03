//! Hinges with friction at rest: a friction circle is no convex set, so that what is held may be disconnected.
//!
//! Numbers named `reference` are those of `reference/hinges.toml`: closed forms, and sequential quadratic programs from
//! many starts for the toggle and the bar.

use rstest::rstest;
use slideway::report::{Report, Style};
use slideway::standstill::{HoldOptions, HoldReport, HoldVerdict, Range, hold, hold_with};
use slideway::{Model, Settings, gallery};
use std::ops::ControlFlow;

fn held(text: &str, options: &HoldOptions) -> HoldReport {
    let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    hold(&model, options).unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

fn factors(text: &str, load: &str) -> Vec<Range> {
    let report = held(text, &HoldOptions::default().load(load));
    assert_eq!(report.undecided, 0);
    report.load.unwrap().held
}

#[track_caller]
fn assert_ranges(found: &[Range], expected: &[[Option<f64>; 2]]) {
    let near = |found: Option<f64>, expected: Option<f64>| match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() <= 1e-9 * expected.abs(),
        (found, expected) => found == expected,
    };
    let all = found.iter().zip(expected);
    let same = all
        .clone()
        .all(|(range, [least, greatest])| near(range.least, *least) && near(range.greatest, *greatest));
    assert!(same && found.len() == expected.len(), "{found:?} instead of {expected:?}");
}

/// A pulley of radius 2 on a shaft of radius 1, mu = 0.2, from which 500 N hang on the left; the rope is pulled on the
/// right with P, straight down or horizontally (Beer and Johnston, Vector Mechanics: Statics, "axle friction").
fn pulley(law: &str, at: &str, pull: &str) -> String {
    format!(
        "[points]\nO = [0, 0]\nleft = [-2, 0]\nright = {at}\n\
         [bodies.pulley]\npoints = [\"O\", \"left\", \"right\"]\nmassless = true\n\
         [joints.shaft]\ntype = \"hinge\"\nbetween = [\"pulley.O\", \"ground.O\"]\nmu = 0.2\nradius = 1\nlaw = \"{law}\"\n\
         [loads.weight]\ntype = \"force\"\nat = \"pulley.left\"\ncomponents = [0, -500]\n\
         [loads.P]\ntype = \"force\"\nat = \"pulley.right\"\ncomponents = {pull}\n\
         [coordinates.phi]\nrotation = \"pulley\"\n"
    )
}

#[rstest]
#[case("total_reaction", [410.698_650_221, 608.718_825_507])]
#[case("mu_rho", [409.090_909_091, 611.111_111_111])]
fn a_pulley_is_held_between_lowering_and_raising(#[case] law: &str, #[case] reference: [f64; 2]) {
    let found = factors(&pulley(law, "[2, 0]", "[0, -1]"), "P");
    assert_ranges(&found, &[reference.map(Some)]);
}

#[rstest]
#[case("total_reaction", 574.696_575_582)]
#[case("mu_rho", 576.296_646_362)]
fn a_pulley_whose_rope_leaves_horizontally(#[case] law: &str, #[case] reference: f64) {
    let found = factors(&pulley(law, "[0, 2]", "[1, 0]"), "P");
    assert!((found[0].greatest.unwrap() - reference).abs() <= 1e-9 * reference, "{found:?}");
}

/// A lever with its centre of mass in its hinge: a force at `p_a`, and a factor times another at `p_b`.
fn lever(friction: &str, [p_a, f_a, p_b, f_b]: [&str; 4]) -> String {
    format!(
        "[points]\nO = [0, 0]\na = {p_a}\nb = {p_b}\n\
         [bodies.lever]\npoints = [\"O\", \"a\", \"b\"]\nmass = 1\ncentre_of_mass = \"O\"\nmoment_of_inertia = 0.02\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"lever.O\", \"ground.O\"]\n{friction}\n\
         [loads.F]\ntype = \"force\"\nat = \"lever.a\"\ncomponents = {f_a}\n\
         [loads.Q]\ntype = \"force\"\nat = \"lever.b\"\ncomponents = {f_b}\n\
         [coordinates.phi]\nrotation = \"lever\"\n"
    )
}

const BELL_CRANK: [&str; 4] = ["[0.1, 0]", "[0, -100]", "[0, 0.06]", "[-1, 0]"];

/// `M^2 <= r^2 |R|^2` is a quadratic in the factor: between its roots (reference), or outside them where the load acts
/// within the friction circle.
#[test]
fn a_lever_is_held_between_two_factors_or_outside_them() {
    let found = factors(&lever("friction_radius = 0.004", BELL_CRANK), "Q");
    assert_ranges(&found, &[[154.402_855_103, 180.418_573_468].map(Some)]);
    let eccentric = ["[0.1, 0]", "[0, -100]", "[0.015, 0]", "[0, 1]"];
    let found = factors(&lever("friction_radius = 0.02", eccentric), "Q");
    assert_ranges(&found, &[[None, Some(-1600.0)], [Some(2400.0 / 7.0), None]]);
}

/// By hand: R = (200, 100) N whatever the acceleration is, M = 12 - 10 N m, and 0.02 alpha = M - r |R|.
#[test]
fn a_lever_begins_to_turn_against_its_friction() {
    let crank = ["[0.1, 0]", "[0, -100]", "[0, 0.06]", "[-200, 0]"];
    let report = held(&lever("friction_radius = 0.004", crank), &HoldOptions::default());
    assert_eq!((report.verdict, report.undecided), (HoldVerdict::Moves, 0));
    let [release] = &report.releases[..] else { panic!("{:?}", report.releases) };
    let expected = (2.0 - 0.004 * 50_000.0_f64.sqrt()) / 0.02;
    let Range { least, greatest } = release.coordinates[0].acceleration;
    for end in [least.unwrap(), greatest.unwrap()] {
        assert!((end - expected).abs() <= 1e-9 * expected, "{end} instead of {expected}");
    }
    let couple = release.reactions.hinges[0].couple.unwrap();
    assert!((couple.least.unwrap() + 0.004 * 50_000.0_f64.sqrt()).abs() <= 1e-9, "{couple:?}");
}

/// A load alone is held where its line of action meets the friction circle: r = 0.06 m, which is sin(atan mu) = 0.6 of a
/// pin of 0.1 m, or mu = 0.6 in the textbooks' approximation.
#[rstest]
#[case("mu = 0.3\nradius = 0.1", 0.75 / 0.3)]
#[case("mu = 0.3\nradius = 0.1\nlaw = \"mu_rho\"", 2.0)]
#[case("friction_radius = 0.01", 6.0)]
fn from_a_certain_friction_on_a_lever_is_self_locking(#[case] friction: &str, #[case] expected: f64) {
    let report = held(&lever(friction, BELL_CRANK), &HoldOptions::default().load("Q"));
    let value = report.load.unwrap().threshold.value.unwrap();
    assert!((value - expected).abs() <= 1e-9 * expected, "{value} instead of {expected}");
}

/// Coefficients at the threshold are those of contacts: nothing is said without any, and what they are beside hinges.
#[test]
fn coefficients_of_hinges_are_not_taken_for_those_of_contacts() {
    let options = HoldOptions::default().load("Q");
    let pins = held(&lever("mu = 0.3\nradius = 0.1", BELL_CRANK), &options)
        .text(Style::PLAIN.verbose(true).width(400));
    assert!(
        pins.contains("It would be self-locking from 2.5 times this static friction.")
            && !pins.contains("mu_static"),
        "{pins}"
    );
    let press = Model::parse(gallery::find("toggle-press").unwrap().text).unwrap();
    let at = Settings::default().position("alpha", "1 deg");
    let press = hold(&press.with(&at).unwrap(), &HoldOptions::default().load("work")).unwrap();
    let both = press.text(Style::PLAIN.verbose(true).width(400));
    assert!(both.contains("mu_static of the sliding joints = 0.060759."), "{both}");
}

/// A block that a couple presses against both faces wedges in its guide from `mu_static = length / height` on, whatever the
/// hinges do: 60 mm / 80 mm = 7.5 times 0.1, and 80 mm / 40 mm = 20 times 0.1. Beside it the reactions grow without bound.
#[rstest]
#[case("slider-crank-with-pins", ["phi", "60 deg"], "gas", 7.5)]
#[case("slider-crank-with-pins", ["phi", "100 deg"], "gas", 7.5)]
#[case("slider-crank-with-pins", ["phi", "60 deg"], "torque", 7.5)]
#[case("toggle-press", ["alpha", "5 deg"], "knee", 20.0)]
fn a_block_beside_hinges_wedges_from_its_own_friction_on(
    #[case] name: &str,
    #[case] at: [&str; 2],
    #[case] load: &str,
    #[case] expected: f64,
) {
    let model = Model::parse(gallery::find(name).unwrap().text).unwrap();
    let model = model.with(&Settings::default().position(at[0], at[1])).unwrap();
    let report = hold(&model, &HoldOptions::default().load(load)).unwrap();
    let value = report.load.unwrap().threshold.value.unwrap();
    assert!((value / expected - 1.0).abs() <= 1e-8 && report.undecided == 0, "{value}");
}

/// The sign of what is missed is sought no nearer to the threshold than the secant needs: nearer to it friction circles are
/// divided into ever more sectors, up to 100,000 for one sign.
#[test]
fn a_threshold_takes_few_sectors() {
    let model = Model::parse(gallery::find("quick-return").unwrap().text).unwrap();
    let mut asked = 0;
    let report = hold_with(&model, &HoldOptions::default().load("cut"), &mut |_| {
        asked += 1;
        ControlFlow::Continue(())
    });
    let value = report.unwrap().unwrap().load.unwrap().threshold.value.unwrap();
    // By the bisection to machine precision that this replaces: 10.295405848991.
    assert!((value - 10.295_405_848_991).abs() <= 1e-9 && asked < 20_000, "{value}, {asked}");
}

/// Two links and a block (reference `toggle_hold_0.1`): the knee is pressed down with a factor times 1 N against 500 N.
#[test]
fn a_toggle_is_held_in_a_range_of_forces() {
    let text = "gravity = 9.81\n\
        [points]\nO = [0, 0]\nK = [\"0.1*cos(0.1)\", \"0.1*sin(0.1)\"]\nB = [\"0.2*cos(0.1)\", 0]\n\
        L = [\"0.05*cos(0.1)\", \"0.05*sin(0.1)\"]\nM = [\"0.15*cos(0.1)\", \"0.05*sin(0.1)\"]\n\
        [bodies.first]\npoints = [\"O\", \"K\"]\nmass = 0.2\ncentre_of_mass = \"L\"\nmoment_of_inertia = 1.6666666666666667e-4\n\
        [bodies.second]\npoints = [\"K\", \"B\"]\nmass = 0.2\ncentre_of_mass = \"M\"\nmoment_of_inertia = 1.6666666666666667e-4\n\
        [bodies.block]\npoints = [\"B\"]\nmassless = true\n\
        [joints.O]\ntype = \"hinge\"\nbetween = [\"first.O\", \"ground.O\"]\nfriction_radius = 0.0015\n\
        [joints.K]\ntype = \"hinge\"\nbetween = [\"first.K\", \"second.K\"]\nfriction_radius = 0.0015\n\
        [joints.B]\ntype = \"hinge\"\nbetween = [\"second.B\", \"block.B\"]\nfriction_radius = 0.0015\n\
        [joints.slide]\ntype = \"block_slider\"\nblock = \"block\"\nguide = \"ground\"\nat = \"B\"\nalong = \"0 deg\"\n\
        length = 0.04\nheight = 0.02\nmu = 0.15\n\
        [loads.Q]\ntype = \"force\"\nat = \"block.B\"\ncomponents = [-500, 0]\n\
        [loads.P]\ntype = \"force\"\nat = \"first.K\"\ncomponents = [0, -1]\n\
        [coordinates.phi]\nrotation = \"first\"\ndrawn_at = 0.1\n";
    assert_ranges(&factors(text, "P"), &[[67.397_918_493_4, 131.434_506_629].map(Some)]);
}

/// A bar on a block and in an upright slot (reference `bar_block_hold`), pushed at its lower end.
#[rstest]
#[case("friction_radius = 0.02", [1.665_254_801_66, 4.962_829_082_17])]
#[case("friction_radius = 0", [1.865_863_553_523_1, 4.666_775_400_513_47])]
fn a_bar_is_held_in_a_range_of_forces(#[case] friction: &str, #[case] reference: [f64; 2]) {
    let text = format!(
        "gravity = 9.81\n\
         [points]\nA = [\"-cos(1)\", 0]\nB = [0, \"sin(1)\"]\n\
         [bodies.bar]\npoints = [\"A\", \"B\"]\nmass = 1\nshape = {{ bar = [\"A\", \"B\"] }}\n\
         [bodies.block]\npoints = [\"A\"]\nmassless = true\n\
         [joints.A]\ntype = \"hinge\"\nbetween = [\"block.A\", \"bar.A\"]\n{friction}\n\
         [joints.upper]\ntype = \"pin_in_slot\"\nblock = \"bar\"\nguide = \"ground\"\nat = \"B\"\nalong = \"90 deg\"\nmu = 0.2\n\
         [joints.lower]\ntype = \"block_slider\"\nblock = \"block\"\nguide = \"ground\"\nat = \"A\"\nalong = \"0 deg\"\n\
         length = 0.2\nheight = 0.1\nmu = 0.1\n\
         [loads.P]\ntype = \"force\"\nat = \"bar.A\"\ncomponents = [1, 0]\n\
         [coordinates.x]\nslide = \"lower\"\n"
    );
    assert_ranges(&factors(&text, "P"), &[reference.map(Some)]);
}

/// The threshold of a load is found by some fifty programs, each of which divides directions into sectors.
#[test]
fn a_threshold_over_directions_can_be_ended_at_any_sector() {
    let model = Model::parse(gallery::find("toggle-press").unwrap().text).unwrap();
    let options = HoldOptions::default().load("knee");
    for most in [100, 2_000] {
        let mut asked = 0;
        let report = hold_with(&model, &options, &mut |_| {
            asked += 1;
            if asked == most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(report.unwrap().is_none() && asked == most, "{asked}");
    }
}

/// A mechanism of an independent review with three sliding contacts on one block. Where both contacts of one face are in their
/// gaps, their columns are the same whatever the directions of the hinge, so that the equations of every sector are singular:
/// `hold` took minutes. The search for the states in which the hinge begins to turn takes few nodes, and ends where the
/// callback says so.
#[test]
fn states_that_begin_to_turn_are_sought_in_few_nodes() {
    let model = Model::parse(include_str!("../findings/hold_with_a_curve.toml")).unwrap();
    let nodes_until = |most: usize| {
        let mut nodes = 0;
        let report = hold_with(&model, &HoldOptions::default(), &mut |progress| {
            nodes += usize::from(progress.counted == "nodes");
            if nodes >= most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        (report.unwrap(), nodes)
    };
    let (whole, nodes) = nodes_until(usize::MAX);
    assert_eq!(whole.map(|report| report.undecided), Some(0));
    assert!((50..50_000).contains(&nodes), "{nodes}");
    let (ended, nodes) = nodes_until(1);
    assert!(ended.is_none() && nodes < 100, "{nodes}");
}

/// A slider-crank of a random campaign whose block wedges, so that its normal forces are unbounded on one side: all of it is
/// decided, and each end of a range by the sectors of the pins that bound it.
#[test]
fn ranges_without_an_end_on_one_side_are_decided() {
    let text = include_str!("../findings/hold_of_three_pins.toml").replace("f = 1.0", "f = 1.75");
    let report = held(&text, &HoldOptions::default());
    assert_eq!(report.undecided, 0);
    let forces = report.at_rest.expect("it rests").reactions.contacts;
    let ends: Vec<[bool; 2]> = forces
        .iter()
        .map(|contact| [contact.normal_force.least, contact.normal_force.greatest].map(|end| end.is_some()))
        .collect();
    assert_eq!(ends, [[false; 2], [false; 2]]);
}
