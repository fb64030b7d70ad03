//! What a simulation asks of decisions, with less work, against the same with all of it.

use super::models::block;
use super::{mechanism_of, model_of};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::model::Settings;
use crate::modes::Side;
use crate::motion::decision::holding::Holding;
use crate::motion::decision::{Successor, Successors, continuations, sticking_margin, successors};
use crate::motion::moving::equations::sliding_joints;
use crate::motion::{ContactPhase, EventInstant, JointPhase, Phase, Resting};

/// A sequence of numbers between 0 and 1 (D. E. Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Models with the number of random states of each: fewer where there are more joints and contacts.
const NAMES: [(&str, usize); 10] = [
    ("klepp-2002", 40),
    ("klepp-2002-spring", 40),
    ("painleve-klein", 40),
    ("slider-crank", 40),
    ("elliptic-trammel", 40),
    ("wedge", 15),
    ("stick-slip", 15),
    ("scotch-yoke", 15),
    ("sleeve-on-arm", 15),
    ("telescopic-boom", 4),
];

fn state(name: &str, numbers: &mut Numbers) -> Option<(Mechanism, Configuration)> {
    let mut mechanism = Mechanism::new(&model_of(name)).unwrap();
    for coordinate in &mut mechanism.coordinates {
        let rate = numbers.next();
        coordinate.rate = if rate < 0.5 { 0.0 } else { 4.0 * rate - 3.0 };
    }
    for contact in &mut mechanism.contacts {
        let mu = 1.2 * numbers.next();
        (contact.mu, contact.mu_static) = ([mu; 2], [1.1 * mu; 2]);
        contact.preload = [0.0, 0.0].map(|_: f64| (8.0 * numbers.next() - 6.0).max(0.0));
    }
    let configuration = Configuration::new(&mechanism).ok()?;
    Some((mechanism, configuration))
}

/// Which sliding joints have no velocity.
fn at_rest(mechanism: &Mechanism, configuration: &Configuration) -> Vec<bool> {
    let velocity = |joint: &JointId| {
        let contact = mechanism.slider(*joint).unwrap().contacts[0];
        configuration.contact(mechanism, contact).sliding_velocity
    };
    sliding_joints(mechanism).iter().map(|joint| velocity(joint).abs() < 1e-12).collect()
}

/// What a simulation asks.
fn fast(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stopped: &[bool],
    previous: Option<&Phase>,
) -> Result<Successors, Faults> {
    let sign = |(joint, stopped): (&JointId, &bool)| {
        let contact = mechanism.slider(*joint).unwrap().contacts[0];
        let velocity = configuration.contact(mechanism, contact).sliding_velocity;
        if *stopped { 0.0 } else { velocity.signum() }
    };
    let signs: Vec<f64> = sliding_joints(mechanism).iter().zip(stopped).map(sign).collect();
    continuations(&EventInstant::new((mechanism, configuration), &signs, previous))
}

/// What the states came to that were compared.
#[derive(Debug, Default)]
struct Covered {
    phases: usize,
    several: usize,
    none: usize,
    tipping: usize,
    preload_gaps: usize,
    several_stopped: usize,
    refused: usize,
}

impl Covered {
    /// Compares the two at a state, without and with a previous phase.
    fn compare(&mut self, name: &str, mechanism: &Mechanism, configuration: &Configuration) {
        let stopped = at_rest(mechanism, configuration);
        let Ok(first) = successors(mechanism, configuration, &stopped, None) else {
            assert!(fast(mechanism, configuration, &stopped, None).is_err(), "{name}");
            self.refused += 1;
            return;
        };
        let last = first.list.last().map(|successor| successor.phase.clone());
        for previous in [None, last.as_ref()] {
            let all = successors(mechanism, configuration, &stopped, previous).unwrap();
            let fast = fast(mechanism, configuration, &stopped, previous).unwrap();
            assert_eq!(phases(mechanism, &all), phases(mechanism, &fast), "{name}");
            let tipping = |found: &Successors| -> Vec<(Vec<JointPhase>, Vec<JointId>)> {
                found.tipping.iter().map(|one| (one.phase.joints.clone(), one.joints.clone())).collect()
            };
            assert_eq!(tipping(&all), tipping(&fast), "{name}");
            for (one, other) in all.list.iter().zip(&fast.list).filter(|_| all.list.len() > 1) {
                assert_eq!(one.attainability.verdict, other.attainability.verdict, "{name}");
                assert_eq!((one.is_present, one.continues), (other.is_present, other.continues), "{name}");
            }
        }
        let gap = |one: &Successor| one.phase.contacts.contains(&ContactPhase::PreloadGap);
        self.phases += first.list.len();
        self.several += usize::from(first.list.len() > 1);
        self.none += usize::from(first.list.is_empty() && first.tipping.is_empty());
        self.tipping += usize::from(!first.tipping.is_empty());
        self.preload_gaps += usize::from(first.list.iter().any(gap));
        self.several_stopped += usize::from(stopped.iter().filter(|stopped| **stopped).count() > 1);
    }
}

/// Joints and the sides of contacts that slide.
fn phases(mechanism: &Mechanism, found: &Successors) -> Vec<(Vec<JointPhase>, Vec<Option<ContactPhase>>)> {
    let sliders = sliding_joints(mechanism);
    let one = |phase: &Phase| {
        let side = |(k, side): (usize, &ContactPhase)| {
            let joint = sliders.iter().position(|joint| *joint == mechanism.contacts[k].joint).unwrap();
            (phase.joints[joint] != JointPhase::Sticking).then_some(*side)
        };
        (phase.joints.clone(), phase.contacts.iter().enumerate().map(side).collect())
    };
    found.list.iter().map(|successor| one(&successor.phase)).collect()
}

#[test]
fn the_same_phases_follow_in_the_same_order() {
    let mut numbers = Numbers(1781);
    let mut covered = Covered::default();
    for (name, count) in NAMES {
        for _ in 0..count {
            let Some((mechanism, configuration)) = state(name, &mut numbers) else { continue };
            covered.compare(name, &mechanism, &configuration);
        }
    }
    assert!(covered.phases > 200 && covered.several > 40 && covered.several_stopped > 60, "{covered:?}");
    assert!(covered.none > 0 && covered.preload_gaps > 0, "{covered:?}");
}

/// Klepp (2002): beyond mu_1* = 0.45265396 nothing follows a motion to the left. Painleve's rods
/// (reference/README.md): beyond mu* = 2 cot(30 deg) = 3.4641 nothing follows a motion to the right with the
/// pull on the lower slider.
#[test]
fn both_say_when_nothing_follows() {
    let mut covered = Covered::default();
    let cases = [
        ("klepp-2002", "mu_1", "-1", [0.452_65, 0.452_66]),
        ("painleve-klein", "mu", "1", [3.464_101, 3.464_102]),
    ];
    for (name, coefficient, direction, around) in cases {
        let compare = |covered: &mut Covered, mu: f64| {
            let settings = Settings::default().parameter(coefficient, mu.to_string());
            let settings = settings.parameter("direction", direction);
            let settings = if name == "klepp-2002" { settings.parameter("F_20", "0") } else { settings };
            let mechanism = Mechanism::new(&model_of(name).with(&settings).unwrap()).unwrap();
            covered.compare(name, &mechanism, &Configuration::new(&mechanism).unwrap());
        };
        let (none, phases) = (covered.none, covered.phases);
        compare(&mut covered, around[0]);
        assert_eq!((covered.none, covered.phases), (none, phases + 1), "{name}");
        for mu in [around[1], 1.01 * around[1], 1.5 * around[1], 4.0 * around[1]] {
            compare(&mut covered, mu);
        }
        assert_eq!((covered.none, covered.phases), (none + 4, phases + 1), "{name}");
    }
}

/// A guided block of 2 kg, 0.2 m long: its weight of 20 N takes up a couple of 2 N m, a force 0.5 m above it
/// of 4 N. Beyond that it would tip, sliding or at rest.
#[test]
fn both_tell_sliders_that_tip() {
    let mut covered = Covered::default();
    let mut force = |force: f64, rate: &str| {
        let load =
            format!("[loads.force]\ntype = \"force\"\nat = \"block.H\"\ncomponents = [\"{force} N\", 0]\n");
        let text = block("0.3", rate, &load).replace("block_slider", "guided_slider");
        let text =
            text.replace("C = [0, 0]", "C = [0, 0]\nH = [0, 0.5]").replace("[\"C\"]", "[\"C\", \"H\"]");
        let mechanism = mechanism_of(&text);
        let before = covered.tipping;
        covered.compare("tips", &mechanism, &Configuration::new(&mechanism).unwrap());
        covered.tipping > before
    };
    for rate in ["rate = 1", ""] {
        for part in [1e-1, 1e-3, 1e-6] {
            assert!(!force(4.0 * (1.0 - part), rate), "{rate} {part:e}");
            assert!(force(4.0 * (1.0 + part), rate), "{rate} {part:e}");
        }
    }
}

/// The example with mu_1 = 0.24 and F_30 = m g/2 (theory, section 3) and around it: the only state is a
/// preload gap.
#[test]
fn both_find_preload_gaps() {
    let mut covered = Covered::default();
    for mu in ["0.2", "0.22", "0.23", "0.24", "0.25", "0.3"] {
        let settings = Settings::default().parameter("F_20", "0").parameter("F_30", "0.5*m*g");
        let model = model_of("klepp-2002").with(&settings.parameter("mu_1", mu)).unwrap();
        let mechanism = Mechanism::new(&model).unwrap();
        covered.compare("gap", &mechanism, &Configuration::new(&mechanism).unwrap());
    }
    assert!(covered.preload_gaps >= 1 && covered.phases >= 6, "{covered:?}");
}

/// The margin of a mechanism that stands still, with other loads than those with which it was prepared.
#[test]
fn a_margin_at_a_later_time_is_that_of_a_new_start() {
    let mut numbers = Numbers(1736);
    let (mut compared, mut little) = (0, 0);
    for _ in 0..30 {
        let Some((mut mechanism, _)) = state("klepp-2002-spring", &mut numbers) else { continue };
        mechanism.coordinates[0].rate = 0.0;
        let mut configuration = Configuration::new(&mechanism).unwrap();
        let phase = Phase {
            joints: vec![JointPhase::Sticking; 2],
            contacts: vec![ContactPhase::Pressed(Side::Positive); 3],
            hinges: Vec::new(),
        };
        let mut holding = Holding::new(
            &mechanism,
            &configuration,
            Resting { phase: &phase, bodies: &vec![true; mechanism.bodies.len()] },
        )
        .unwrap();
        for _ in 0..8 {
            configuration.time = numbers.next();
            let margin = sticking_margin(&mechanism, &configuration, &phase).unwrap();
            let mut anew = Holding::new(
                &mechanism,
                &configuration,
                Resting { phase: &phase, bodies: &vec![true; mechanism.bodies.len()] },
            )
            .unwrap();
            let unit = anew.unit();
            let anew = anew.margin(configuration.time).unwrap();
            // From 0.01 on either may have taken other sides.
            assert!((margin - anew).abs() < 1e-11 || margin.min(anew) >= 0.01, "{margin} {anew}");
            // In units of the forces at the start.
            let held = holding.margin(configuration.time).unwrap();
            let difference = held * holding.unit() - anew * unit;
            assert!(
                difference.abs() < 1e-11 * unit.max(holding.unit()) || held.min(anew) >= 0.01,
                "{held} {anew} {difference:e}"
            );
            compared += 1;
            little += usize::from(margin < 0.01);
        }
    }
    assert!(compared > 200 && little > 5, "{compared} {little}");
}

/// The time at which the force that swings begins to move the mechanism at rest, by bisection.
fn release(mechanism: &Mechanism, configuration: &mut Configuration, phase: &Phase) -> f64 {
    let (mut holds, mut slips) = (0.0, 0.04);
    let mut margin = |time| {
        configuration.time = time;
        sticking_margin(mechanism, configuration, phase).unwrap()
    };
    assert!(margin(holds) > 0.0 && margin(slips) < 0.0, "{} {}", margin(holds), margin(slips));
    while slips - holds > 1e-14 {
        let middle = f64::midpoint(holds, slips);
        if margin(middle) > 0.0 { holds = middle } else { slips = middle }
    }
    holds
}

/// Just before and just after a force has grown enough to move what stands still, the margin has the same
/// small value on both ways and the sign that says so, and the phases that follow are the same on both.
#[test]
fn margins_near_the_boundary() {
    let mut compared = 0;
    for mu in ["0.05", "0.1", "0.15", "0.2", "0.24"] {
        let model = model_of("klepp-2002-spring").with(&Settings::default().parameter("mu_1", mu)).unwrap();
        let mut mechanism = Mechanism::new(&model).unwrap();
        mechanism.coordinates[0].rate = 0.0;
        let mut configuration = Configuration::new(&mechanism).unwrap();
        let phase = Phase {
            joints: vec![JointPhase::Sticking; 2],
            contacts: vec![ContactPhase::Pressed(Side::Positive); 3],
            hinges: Vec::new(),
        };
        let release = release(&mechanism, &mut configuration, &phase);
        configuration.time = 0.0;
        let mut holding = Holding::new(
            &mechanism,
            &configuration,
            Resting { phase: &phase, bodies: &vec![true; mechanism.bodies.len()] },
        )
        .unwrap();
        for part in [-1e-3, -1e-6, 1e-6, 1e-3] {
            configuration.time = release * (1.0 + part);
            let margin = sticking_margin(&mechanism, &configuration, &phase).unwrap();
            // In units of the forces at the start.
            let held = holding.margin(configuration.time).unwrap() * holding.unit();
            let rests = vec![true; mechanism.bodies.len()];
            let unit = Holding::new(&mechanism, &configuration, Resting { phase: &phase, bodies: &rests })
                .unwrap()
                .unit();
            assert!((held - margin * unit).abs() < 1e-11 * unit, "{part:e}: {margin:e} {held} {unit}");
            assert!(margin * part < 0.0 && margin.abs() < 10.0 * part.abs(), "{part:e}: {margin:e}");
            Covered::default().compare("near", &mechanism, &configuration);
            let all = successors(&mechanism, &configuration, &[true, true], None).unwrap();
            let sticks = all.list.iter().any(|one| one.phase.joints == phase.joints);
            // Slacks down to -1e-8 count as zero.
            assert!(sticks == (part < 0.0) || margin.abs() < 1e-8, "{part:e}: {margin:e}");
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
}
