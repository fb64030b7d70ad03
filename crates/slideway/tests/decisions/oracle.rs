//! Every phase that is told satisfies the laws of mechanics and of friction, computed from forces at their
//! points; and where friction is small there is exactly one.

use crate::agreement::Random;
use crate::set_up::{State, may_lift_off};
use nalgebra::Vector2;
use slideway::configuration::{Configuration, Pose};
use slideway::gallery::MODELS;
use slideway::ids::{BodyId, Frame, JointId};
use slideway::kinetics::{KineticEquations, Reaction};
use slideway::mechanism::{JointKind, Mechanism};
use slideway::model::Model;
use slideway::motion::decision::{Standing, Successor, successors};
use slideway::motion::{ContactPhase, JointPhase};

/// Forces and moments about the mass centre of each body.
struct Balance<'s> {
    state: &'s State,
    sums: Vec<[f64; 3]>,
}

impl Balance<'_> {
    fn add(&mut self, frame: Frame, place: Vector2<f64>, force: Vector2<f64>, couple: f64) {
        let Some(BodyId(body)) = frame.body() else { return };
        let arm = place - self.state.configuration.poses[body].position;
        let sum = &mut self.sums[body];
        sum[0] += force.x;
        sum[1] += force.y;
        sum[2] += arm.x * force.y - arm.y * force.x + couple;
    }
}

/// What is left over of the equations of motion of every body, in units of the greatest force.
fn imbalance(state: &State, one: &Successor) -> f64 {
    let equations = KineticEquations::new(&state.mechanism, &state.configuration).unwrap();
    let mut balance = Balance { state, sums: vec![[0.0; 3]; state.mechanism.bodies.len()] };
    let mut scale = 0.0_f64;
    for wrench in &equations.applied {
        balance.add(wrench.frame, wrench.place, wrench.force, wrench.couple);
        scale = scale.max(wrench.force.norm());
    }
    for (k, contact) in equations.contacts.iter().enumerate() {
        let slider = state.mechanism.slider(state.mechanism.contacts[k].joint).unwrap();
        let normal = contact.normal * one.state.normal_forces[k];
        let friction = one.state.frictions[k];
        let mut both = vec![(contact.point, normal)];
        for (side, force) in [(1.0, friction.positive_face), (-1.0, friction.negative_face)] {
            both.push((
                contact.point - contact.normal * (side * slider.height / 2.0),
                contact.tangent * -force,
            ));
        }
        for (place, force) in both {
            balance.add(slider.block, place, force, 0.0);
            balance.add(slider.guide, place, -force, 0.0);
            scale = scale.max(force.norm());
        }
    }
    for reaction in one.state.layout.reactions() {
        let value = one.state.unknowns[one.state.layout.reaction(*reaction).unwrap()];
        match reaction {
            Reaction::Hinge(JointId(joint), axis) => {
                let JointKind::Hinge([first, second]) = &state.mechanism.joints[*joint].kind else {
                    panic!("a hinge")
                };
                let force = if *axis == 0 { Vector2::x() } else { Vector2::y() } * value;
                let place = state.configuration.position(&state.mechanism, first);
                balance.add(first.frame, place, force, 0.0);
                balance.add(second.frame, place, -force, 0.0);
            }
            Reaction::Couple(joint) => {
                let slider = state.mechanism.slider(*joint).unwrap();
                balance.add(slider.block, Vector2::zeros(), Vector2::zeros(), value);
                balance.add(slider.guide, Vector2::zeros(), Vector2::zeros(), -value);
            }
            Reaction::Carried(..) => panic!("of a planar model there is none"),
            Reaction::Normal(_) => {}
        }
    }
    let mut worst = 0.0_f64;
    for (index, (sum, body)) in balance.sums.iter().zip(&state.mechanism.bodies).enumerate() {
        for (axis, inertia) in [body.mass, body.mass, body.moment_of_inertia].into_iter().enumerate() {
            let length = if axis == 2 { state.mechanism.size } else { 1.0 };
            worst = worst.max((sum[axis] - inertia * one.state.unknowns[3 * index + axis]).abs() / length);
        }
    }
    worst / scale
}

/// Friction laws: kinetic where a joint slides, within the static limit where it sticks; pressures, couples.
fn obeys_friction(state: &State, one: &Successor, stopped: &[bool]) {
    let greatest = one.state.normal_forces.iter().map(|n| n.abs()).fold(0.0, f64::max);
    let scale = state.mechanism.contacts.iter().flat_map(|c| c.preload).fold(greatest, f64::max);
    let mut sliding = 0;
    for joint in 0..state.mechanism.joints.len() {
        let Some(slider) = state.mechanism.slider(JointId(joint)) else { continue };
        for contact in &slider.contacts {
            let k = contact.index();
            let properties = &state.mechanism.contacts[k];
            let (normal, friction) = (one.state.normal_forces[k], one.state.frictions[k].total());
            let side = match one.phase.contacts[k] {
                ContactPhase::Pressed(side) => side,
                ContactPhase::PreloadGap => continue,
            };
            assert!(side.sign() * normal >= -1e-7 * scale);
            let face = usize::from(side.sign() < 0.0);
            match one.phase.joints[sliding] {
                JointPhase::Sliding(sign) => {
                    let kinetic = properties.mu[face] * normal.abs() + properties.preload[face];
                    assert!((friction - sign * kinetic).abs() <= 1e-9 * scale);
                }
                JointPhase::Sticking => {
                    let limit = properties.mu_static[face] * normal.abs() + properties.preload[face];
                    assert!(friction.abs() <= limit + 1e-7 * scale);
                }
            }
        }
        if let (JointPhase::Sliding(sign), true) = (one.phase.joints[sliding], stopped[sliding]) {
            assert!(sign * one.state.sliding_accelerations[sliding] >= -1e-6 * one.state.unknowns.amax());
        }
        sliding += 1;
    }
}

/// Joints stay closed and sticking joints do not slide: constraints on velocity after a step, to its square.
fn keeps_joints(state: &State, one: &Successor) {
    let step = 1e-6;
    let mut next: Configuration = state.configuration.clone();
    for body in 0..next.poses.len() {
        let velocity = state.configuration.velocities[body];
        let [x, y, turn] = [0, 1, 2].map(|axis| one.state.unknowns[3 * body + axis]);
        let Pose { position, .. } = next.poses[body];
        let angle = next.poses[body].angle() + velocity.angular * step;
        next.poses[body] = Pose::new(position + velocity.linear * step, angle);
        next.velocities[body].linear += Vector2::new(x, y) * step;
        next.velocities[body].angular += turn * step;
    }
    let speed = state.configuration.velocities.iter().map(|v| v.linear.norm()).fold(1.0, f64::max);
    let spin = state.configuration.velocities.iter().map(|v| v.angular.abs()).fold(1.0, f64::max);
    let limit =
        10.0 * step * step * speed * spin * (spin + one.state.unknowns.rows(0, 3).amax()) + 1e-12 * speed;
    let mut sliding = 0;
    for (index, joint) in state.mechanism.joints.iter().enumerate() {
        match &joint.kind {
            JointKind::Hinge([first, second]) => {
                let velocity = |end: &slideway::mechanism::Attachment| {
                    next.velocity_at(end.frame, next.position(&state.mechanism, end))
                };
                assert!((velocity(first) - velocity(second)).norm() <= limit, "{index}");
            }
            JointKind::Slider(slider) => {
                let after = next.contact(&state.mechanism, slider.contacts[0]).sliding_velocity;
                let before =
                    state.configuration.contact(&state.mechanism, slider.contacts[0]).sliding_velocity;
                let gained = (after - before) / step;
                let told = one.state.sliding_accelerations[sliding];
                assert!((gained - told).abs() * step <= limit, "{index}: {gained} is not {told}");
                sliding += 1;
            }
        }
    }
}

fn stopped(mechanism: &Mechanism, configuration: &Configuration) -> Vec<bool> {
    let joints = (0..mechanism.joints.len()).filter_map(|joint| mechanism.slider(JointId(joint)));
    joints
        .map(|slider| configuration.contact(mechanism, slider.contacts[0]).sliding_velocity.abs() < 1e-12)
        .collect()
}

/// A gallery model or another one with its own loads and random rates, some of them zero.
fn random_state(text: &str, random: &mut Random, mu: &mut dyn FnMut(&mut Random) -> f64) -> Option<State> {
    let mut mechanism = Mechanism::new(&Model::parse(text).unwrap()).ok()?;
    for coordinate in &mut mechanism.coordinates {
        coordinate.rate = match random.next() {
            low if low < 0.5 => 0.0,
            high => 4.0 * high - 3.0,
        };
    }
    for contact in &mut mechanism.contacts {
        let mu = mu(random);
        (contact.mu, contact.mu_static) = ([mu; 2], [mu; 2]);
    }
    let configuration = Configuration::new(&mechanism).ok()?;
    Some(State { mechanism, configuration })
}

const STACKED: &str = r#"
gravity = 10
[points]
c = [0.1, 0.5]
[bodies.slab]
mass = 3
centre_of_mass = [0, 0.1]
moment_of_inertia = 0.1
[bodies.block]
mass = 2
centre_of_mass = [0, 0.3]
moment_of_inertia = 0.1
[bodies.top]
mass = 1
centre_of_mass = [0.1, 0.5]
moment_of_inertia = 0.1
points = ["c"]
[joints.below]
type = "block_slider"
block = "slab"
at = [0, 0.1]
along = "3 deg"
length = 4
height = 0.2
mu = 0.1
[joints.between]
type = "block_slider"
block = "block"
guide = "slab"
at = [0, 0.3]
along = "0 deg"
length = 1
height = 0.2
mu = 0.1
[joints.above]
type = "guided_slider"
block = "top"
guide = "block"
at = [0.1, 0.5]
along = "-2 deg"
length = 3
height = 0.1
mu = 0.1
[loads.P]
type = "force"
at = "top.c"
components = [0.4, -3]
[coordinates.x]
slide = "below"
[coordinates.s]
slide = "between"
[coordinates.r]
slide = "above"
"#;

fn texts() -> impl Iterator<Item = (&'static str, &'static str)> {
    let gallery = MODELS
        .iter()
        .map(|entry| (entry.name, entry.text))
        .filter(|(_, text)| !text.contains("[drives.") && !may_lift_off(text));
    gallery.chain([("stacked", STACKED)])
}

#[test]
fn small_friction_leaves_exactly_one_phase() {
    let mut random = Random(1699);
    let (mut seen, mut mixed, mut sticking) = (0, 0, 0);
    for (name, text) in texts() {
        for _ in 0..if name == "stacked" { 120 } else { 15 } {
            let mut small = |random: &mut Random| 0.01 + 0.06 * random.next();
            let Some(state) = random_state(text, &mut random, &mut small) else { continue };
            let stopped = stopped(&state.mechanism, &state.configuration);
            let Ok(found) = successors(&state.mechanism, &state.configuration, &stopped, None) else {
                continue;
            };
            if found.list.iter().any(|one| matches!(one.standing, Standing::Undecided(_)))
                || !found.tipping.is_empty()
            {
                continue;
            }
            let [one] = &found.list[..] else {
                panic!("{name}: {} {stopped:?} {:?}", found.list.len(), state.configuration.rates)
            };
            assert!(imbalance(&state, one) < 1e-9, "{name}: {}", imbalance(&state, one));
            obeys_friction(&state, one, &stopped);
            keeps_joints(&state, one);
            seen += 1;
            let sticks = one.phase.joints.iter().filter(|joint| **joint == JointPhase::Sticking).count();
            sticking += usize::from(sticks > 0);
            mixed += usize::from(sticks > 0 && sticks < one.phase.joints.len());
        }
    }
    assert!(seen > 120 && mixed > 20 && sticking > 30, "{seen} {sticking} {mixed}");
}

#[test]
fn every_phase_obeys_mechanics_and_friction() {
    let mut random = Random(1785);
    let (mut seen, mut sticking) = (0, 0);
    for (name, text) in texts() {
        for _ in 0..12 {
            let mut great = |random: &mut Random| 1.2 * random.next();
            let Some(state) = random_state(text, &mut random, &mut great) else { continue };
            let stopped = stopped(&state.mechanism, &state.configuration);
            let Ok(found) = successors(&state.mechanism, &state.configuration, &stopped, None) else {
                continue;
            };
            for one in &found.list {
                assert!(imbalance(&state, one) < 1e-9, "{name}: {}", imbalance(&state, one));
                obeys_friction(&state, one, &stopped);
                keeps_joints(&state, one);
                seen += 1;
                sticking += usize::from(one.phase.joints.contains(&JointPhase::Sticking));
            }
        }
    }
    assert!(seen > 80 && sticking > 20, "{seen} {sticking}");
}
