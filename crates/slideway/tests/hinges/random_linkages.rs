//! Random linkages: in motion their hinges obey the law of friction at all times, and energy is balanced; how they begin
//! to move is what `solve` finds.

use rstest::rstest;
use slideway::motion::{End, JointPhase, SimulateOptions, simulate};
use slideway::standstill::{HoldOptions, HoldVerdict, hold};
use slideway::{Model, Settings, solve};
use std::fmt::Write;

/// A linear congruential generator (Knuth, The Art of Computer Programming, 3.3.4).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn between(&mut self, [least, greatest]: [f64; 2]) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        least + (greatest - least) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

const DOUBLE_PENDULUM: &str = "gravity = 9.81\n[points]\nO = [0, 0]\nA = [0.2, 0]\nB = [0.4, 0.05]\n\
     [bodies.one]\npoints = [\"O\", \"A\"]\nmass = 1\nshape = { bar = [\"O\", \"A\"] }\n\
     [bodies.two]\npoints = [\"A\", \"B\"]\nmass = 0.7\nshape = { bar = [\"A\", \"B\"] }\n\
     [coordinates.q]\nrotation = \"two\"\n";
const FOUR_BAR: &str = "gravity = 9.81\n[points]\nO = [0, 0]\nA = [0.03, 0.04]\nB = [0.16, 0.09]\nC = [0.15, 0]\n\
     [bodies.one]\npoints = [\"O\", \"A\"]\nmass = 1\nshape = { bar = [\"O\", \"A\"] }\n\
     [bodies.two]\npoints = [\"A\", \"B\"]\nmass = 0.7\nshape = { bar = [\"A\", \"B\"] }\n\
     [bodies.three]\npoints = [\"B\", \"C\"]\nmass = 0.5\nshape = { bar = [\"B\", \"C\"] }\n\
     [loads.torque]\ntype = \"torque\"\nbody = \"one\"\nmoment = \"0.5 N m*sin(5/(1 s)*t)\"\n";

const PENDULUM_HINGES: &[&str] = &["[\"one.O\", \"ground.O\"]", "[\"two.A\", \"one.A\"]"];
const FOUR_BAR_HINGES: &[&str] = &[
    "[\"one.O\", \"ground.O\"]",
    "[\"two.A\", \"one.A\"]",
    "[\"three.B\", \"two.B\"]",
    "[\"three.C\", \"ground.C\"]",
];

/// A linkage with friction of these radii in its hinges, static friction half as great again.
fn linkage(text: &str, hinges: &[&str], radii: [f64; 2], random: &mut Random) -> Model {
    let rate = random.between([-5.0, 5.0]);
    let mut text = format!("{text}[coordinates.p]\nrotation = \"one\"\nrate = {rate}\n");
    for (index, between) in hinges.iter().enumerate() {
        let radius = random.between(radii);
        let _ = writeln!(
            text,
            "[joints.J{index}]\ntype = \"hinge\"\nbetween = {between}\nfriction_radius = {radius}\n\
             static_friction_radius = {}",
            1.5 * radius
        );
    }
    Model::parse(&text).unwrap()
}

#[rstest]
#[case(DOUBLE_PENDULUM, PENDULUM_HINGES, [0.002, 0.06])]
#[case(FOUR_BAR, FOUR_BAR_HINGES, [0.0005, 0.006])]
fn hinges_of_random_linkages_obey_the_law_of_friction(
    #[case] text: &str,
    #[case] hinges: &[&str],
    #[case] radii: [f64; 2],
) {
    let mut random = Random(2026);
    let (mut turning, mut sticking) = (0, 0);
    for _ in 0..12 {
        let model = linkage(text, hinges, radii, &mut random);
        let history = simulate(&model, &SimulateOptions::new(2.0)).unwrap();
        assert_eq!(history.end, End::Finished, "{:?}", history.events.last());
        assert!(history.energy_error <= 1e-6 * history.energy_scale);
        let mut reader = history.reader();
        let mut dissipated = 0.0;
        for index in 0..400 {
            let sample = reader.at(0.005 * f64::from(index)).unwrap();
            let phase = &history.phases[sample.phase].phase;
            for ((hinge, circle), state) in
                sample.hinges.iter().zip(&history.mechanism.friction_circles).zip(&phase.hinges)
            {
                let force = hinge.force[0].hypot(hinge.force[1]);
                match (state.state, hinge.couple) {
                    (JointPhase::Sliding(sign), Some(couple)) => {
                        turning += 1;
                        assert!(sign * hinge.spin >= -1e-6, "{hinge:?}");
                        assert!((couple + sign * circle.radius * force).abs() <= 1e-9 * force, "{hinge:?}");
                    }
                    (JointPhase::Sliding(_), None) => panic!("a couple of kinetic friction is known"),
                    (JointPhase::Sticking, couple) => {
                        sticking += 1;
                        assert!(hinge.spin.abs() <= 1e-6, "{hinge:?}");
                        let greatest = circle.static_radius * force;
                        let exceeds = couple.is_some_and(|couple| couple.abs() > greatest + 1e-6);
                        assert!(!(hinge.is_determined && exceeds), "{hinge:?}");
                    }
                }
            }
            let now: f64 = sample.energy.hinges.iter().sum();
            assert!(now >= dissipated - 1e-9, "{now} after {dissipated}");
            dissipated = now;
        }
    }
    assert!(turning > 1000 && sticking > 500, "{turning} {sticking}");
}

/// With friction circles nearly as wide as the links no motion ends: where no acceleration is possible an impulse stops the
/// linkage.
#[rstest]
#[case(DOUBLE_PENDULUM, PENDULUM_HINGES, [0.06, 0.2])]
#[case(FOUR_BAR, FOUR_BAR_HINGES, [0.006, 0.05])]
fn linkages_with_great_friction_circles_go_on(
    #[case] text: &str,
    #[case] hinges: &[&str],
    #[case] radii: [f64; 2],
) {
    let mut random = Random(2026);
    for _ in 0..36 {
        let model = linkage(text, hinges, radii, &mut random);
        let history = simulate(&model, &SimulateOptions::new(2.0)).unwrap();
        assert_eq!(history.end, End::Finished, "{:?}", history.events.last());
        assert!(history.energy_error <= 1e-6 * history.energy_scale);
    }
}

/// How a four-bar with great friction circles begins to move is what `solve` finds at a very small rate, as far as the
/// acceleration has the sense of the rate: every state is decided.
#[test]
fn linkages_with_great_friction_circles_begin_to_move_as_solved_at_small_rates() {
    let mut random = Random(2026);
    let mut moved = 0;
    let driven = FOUR_BAR.replace("0.5 N m", "50 N m");
    for _ in 0..16 {
        let model = linkage(&driven, FOUR_BAR_HINGES, [0.004, 0.03], &mut random);
        let loaded = model.with(&Settings::default().time(0.3)).unwrap();
        let report = hold(&loaded, &HoldOptions::default()).unwrap();
        assert_ne!(report.verdict, HoldVerdict::Neither);
        let mut expected = Vec::new();
        for rate in [1e-6, -1e-6] {
            let turning = solve(&loaded.with(&Settings::default().rate("p", rate)).unwrap()).unwrap();
            let accelerations = turning.solutions.iter().map(|solution| solution.coordinates[0].acceleration);
            expected.extend(accelerations.filter(|acceleration| acceleration * rate > 0.0));
        }
        let mut found: Vec<f64> = report
            .releases
            .iter()
            .map(|release| release.coordinates[0].acceleration.least.unwrap())
            .collect();
        found.sort_by(f64::total_cmp);
        expected.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len(), "{found:?} instead of {expected:?}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{found} instead of {expected}");
        }
        moved += found.len();
    }
    assert!(moved > 0);
}
