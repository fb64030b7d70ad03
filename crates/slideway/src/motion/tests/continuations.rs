//! What a simulation asks of decisions, with less work, against the same with all of it.

use super::model_of;
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::decision::{Holding, Successors, continuations, sticking_margin, successors};
use crate::motion::equations::sliding_joints;
use crate::motion::{ContactPhase, JointPhase, Phase};

/// A sequence of numbers between 0 and 1 (D. E. Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Models whose states take no long time: up to three sliding joints.
const NAMES: [&str; 5] =
    ["klepp-2002", "klepp-2002-spring", "painleve-klein", "slider-crank", "elliptic-trammel"];

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
    let (mut found, mut several) = (0, 0);
    for name in NAMES {
        for _ in 0..40 {
            let Some((mechanism, configuration)) = state(name, &mut numbers) else { continue };
            let velocity = |joint: &crate::ids::JointId| {
                configuration
                    .contact(&mechanism, mechanism.slider(*joint).unwrap().contacts[0])
                    .sliding_velocity
            };
            let stopped: Vec<bool> =
                sliding_joints(&mechanism).iter().map(|joint| velocity(joint).abs() < 1e-12).collect();
            let Ok(all) = successors(&mechanism, &configuration, &stopped, None) else { continue };
            let previous = all.list.last().map(|successor| &successor.phase);
            let all = successors(&mechanism, &configuration, &stopped, previous).unwrap();
            let fast = continuations(&mechanism, &configuration, &stopped, previous).unwrap();
            assert_eq!(phases(&mechanism, &all), phases(&mechanism, &fast), "{name}");
            assert_eq!(all.tipping.len(), fast.tipping.len(), "{name}");
            if all.list.len() > 1 {
                several += 1;
                for (one, other) in all.list.iter().zip(&fast.list) {
                    assert_eq!(one.attainability.verdict, other.attainability.verdict, "{name}");
                    assert_eq!(
                        (one.is_present, one.continues),
                        (other.is_present, other.continues),
                        "{name}"
                    );
                }
            }
            found += all.list.len();
        }
    }
    assert!(found > 100 && several > 20, "{found} {several}");
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
        };
        let mut holding = Holding::new(&mechanism, &configuration, &phase).unwrap();
        for _ in 0..8 {
            configuration.time = numbers.next();
            let margin = sticking_margin(&mechanism, &configuration, &phase).unwrap();
            let held = holding.margin(&configuration).unwrap();
            // From 0.01 on either may have taken other sides.
            assert!((margin - held).abs() < 1e-11 || margin.min(held) >= 0.01, "{margin} {held}");
            compared += 1;
            little += usize::from(margin < 0.01);
        }
    }
    assert!(compared > 200 && little > 5, "{compared} {little}");
}
