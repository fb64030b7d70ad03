//! Weights, loads and the lines of action of the drives, as forces and couples on the bodies.

use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{BodyId, Frame};
use crate::interval::Real;
use crate::mechanism::{Attachment, Effort, Load, LoadKind, Mechanism, Pad, Quantity, length, rot90};
use nalgebra::Vector2;

/// A force at a place, or a couple, on a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench<T = f64> {
    /// Frame on which it acts.
    pub frame: Frame,
    /// Where the force acts (m).
    pub place: Vector2<T>,
    /// The force (N).
    pub force: Vector2<T>,
    /// The couple (N m), counter-clockwise positive.
    pub couple: T,
}

impl<T: Real> Wrench<T> {
    fn force(frame: Frame, place: Vector2<T>, force: Vector2<T>) -> Self {
        Self { frame, place, force, couple: T::zero() }
    }

    pub(super) fn couple(frame: Frame, couple: T) -> Self {
        Self { frame, place: Vector2::zeros(), force: Vector2::zeros(), couple }
    }

    /// Adds it to the three equations of the body on which it acts.
    pub(crate) fn add_to(&self, configuration: &Configuration<T>, mut add: impl FnMut(usize, T)) {
        let Some(body) = self.frame.body() else { return };
        let row = 3 * body.index();
        let arm = configuration.arm(self.frame, self.place);
        add(row, self.force.x);
        add(row + 1, self.force.y);
        add(row + 2, rot90(arm).dot(&self.force) + self.couple);
    }
}

/// Forces (N) and couples (N m) with which every product of the equations stays within the range of floating
/// point.
const GREATEST: f64 = 1e100;

/// Weights and loads in a configuration; it can be filled again and again without new memory.
#[derive(Debug, Clone)]
pub(crate) struct Applied<T = f64> {
    /// The weight of each body, then the loads in their order.
    pub(crate) wrenches: Vec<Wrench<T>>,
    /// For each load, how many wrenches there are up to its end.
    ends: Vec<usize>,
    weights: usize,
}

impl<T: Real> Applied<T> {
    /// Nothing yet.
    pub(crate) fn new() -> Self {
        Self { wrenches: Vec::new(), ends: Vec::new(), weights: 0 }
    }

    /// Replaces what it holds by the weights and loads of a mechanism in a configuration.
    ///
    /// # Errors
    /// Loads without a value or direction.
    pub(crate) fn fill(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
    ) -> Result<(), Faults> {
        self.wrenches.clear();
        self.ends.clear();
        let mut loads = Loads { mechanism, configuration, wrenches: &mut self.wrenches };
        loads.weights();
        self.weights = loads.wrenches.len();
        let mut faults = Faults::default();
        for load in &mechanism.loads {
            let first = loads.wrenches.len();
            if let Err(fault) = loads.load(load) {
                faults.push(fault);
            }
            let is_usual = |wrench: &Wrench<T>| {
                [wrench.force.x, wrench.force.y, wrench.couple].iter().all(|part| part.magnitude() < GREATEST)
            };
            if !loads.wrenches[first..].iter().all(is_usual) {
                let kind = FaultKind::Overflow { quantity: format!("the load {}", load.name) };
                faults.push(Fault::new(kind, load.place.clone()));
            }
            self.ends.push(loads.wrenches.len());
        }
        faults.or(())
    }

    /// Returns the forces and couples of a load, counted from 0, on the bodies.
    pub(crate) fn of_load(&self, load: usize) -> &[Wrench<T>] {
        let first = if load == 0 { self.weights } else { self.ends[load - 1] };
        &self.wrenches[first..self.ends[load]]
    }
}

/// Returns the forces and couples of a single load on the bodies and on ground, in the order in which the
/// model names its ends.
///
/// # Errors
/// A load without a value or direction.
pub fn load_wrenches<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    load: &Load<T>,
) -> Result<Vec<Wrench<T>>, Fault> {
    let mut wrenches = Vec::new();
    Loads { mechanism, configuration, wrenches: &mut wrenches }.load(load)?;
    Ok(wrenches)
}

/// A unit effort of a drive and its reaction.
pub(crate) fn unit_effort<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    effort: &Effort<T>,
) -> impl Iterator<Item = Wrench<T>> {
    let both = match *effort {
        Effort::Force { at, direction, turns, reaction } => {
            let direction = if turns { configuration.direction(at.frame, direction) } else { direction };
            let place = configuration.position(mechanism, &at);
            let opposite = reaction.map(|frame| Wrench::force(frame, place, -direction));
            [Some(Wrench::force(at.frame, place, direction)), opposite]
        }
        Effort::Torque { body, reaction } => {
            let opposite = reaction.map(|frame| Wrench::couple(frame, -T::one()));
            [Some(Wrench::couple(body, T::one())), opposite]
        }
    };
    both.into_iter().flatten()
}

struct Loads<'m, T> {
    mechanism: &'m Mechanism<T>,
    configuration: &'m Configuration<T>,
    wrenches: &'m mut Vec<Wrench<T>>,
}

impl<T: Real> Loads<'_, T> {
    fn weights(&mut self) {
        for (index, body) in self.mechanism.bodies.iter().enumerate() {
            let weight = self.mechanism.gravity * body.mass;
            let place = self.configuration.poses[index].position;
            self.wrenches.push(Wrench::force(Frame::Body(BodyId(index)), place, weight));
        }
    }

    fn quantity(&self, quantity: Quantity<T>) -> Result<T, Fault> {
        self.configuration.quantity(self.mechanism, quantity)
    }

    fn load(&mut self, load: &Load<T>) -> Result<(), Fault> {
        match &load.kind {
            LoadKind::Force { at, components, axes, turns, reaction } => {
                let mut force = Vector2::zeros();
                for (component, axis) in components.iter().zip(axes) {
                    let axis = if *turns { self.configuration.direction(at.frame, *axis) } else { *axis };
                    force += axis * self.quantity(*component)?;
                }
                let place = self.configuration.position(self.mechanism, at);
                self.wrenches.push(Wrench::force(at.frame, place, force));
                if let Some(reaction) = reaction {
                    self.wrenches.push(Wrench::force(*reaction, place, -force));
                }
            }
            LoadKind::Torque { body, moment, reaction } => {
                let moment = self.quantity(*moment)?;
                self.couples(*body, *reaction, moment);
            }
            LoadKind::Spring { between, stiffness, free_length } => {
                let (stiffness, free_length) = (self.quantity(*stiffness)?, self.quantity(*free_length)?);
                self.spring(load, between, stiffness, free_length)?;
            }
            LoadKind::Damper { between, damping } => {
                let damping = self.quantity(*damping)?;
                self.damper(load, between, damping)?;
            }
            LoadKind::TorsionalSpring { between: [first, second], stiffness, free_angle } => {
                let angle = self.configuration.angle(*first) - self.configuration.angle(*second);
                let moment = -self.quantity(*stiffness)? * (angle - self.quantity(*free_angle)?);
                self.couples(*first, Some(*second), moment);
            }
            LoadKind::TorsionalDamper { between: [first, second], damping } => {
                let relative = self.configuration.angular_velocity(*first)
                    - self.configuration.angular_velocity(*second);
                let moment = -self.quantity(*damping)? * relative;
                self.couples(*first, Some(*second), moment);
            }
            LoadKind::Pad(pad) => self.pad(load, pad)?,
        }
        Ok(())
    }

    fn couples(&mut self, body: Frame, reaction: Option<Frame>, moment: T) {
        self.wrenches.push(Wrench::couple(body, moment));
        if let Some(reaction) = reaction {
            self.wrenches.push(Wrench::couple(reaction, -moment));
        }
    }

    /// Pulls its ends together with k (length - free length).
    fn spring(
        &mut self,
        load: &Load<T>,
        between: &[Attachment<T>; 2],
        stiffness: T,
        free_length: T,
    ) -> Result<(), Fault> {
        let [first, second] = self.places(between);
        let axis = second - first;
        let pull = if free_length.is_zero() {
            axis * stiffness
        } else {
            let tension = stiffness * (length(axis) - free_length);
            if tension.is_zero() { Vector2::zeros() } else { direction(load, axis)? * tension }
        };
        self.pull(between, [first, second], pull);
        Ok(())
    }

    /// Pulls its ends together with c times the rate of its length.
    fn damper(&mut self, load: &Load<T>, between: &[Attachment<T>; 2], damping: T) -> Result<(), Fault> {
        if damping.is_zero() {
            return Ok(());
        }
        let [first, second] = self.places(between);
        let axis = direction(load, second - first)?;
        let relative = self.configuration.velocity_at(between[1].frame, second)
            - self.configuration.velocity_at(between[0].frame, first);
        self.pull(between, [first, second], axis * (damping * axis.dot(&relative)));
        Ok(())
    }

    /// Pushes the block away from the end of its travel, and the guide the other way.
    fn pad(&mut self, load: &Load<T>, pad: &Pad<T>) -> Result<(), Fault> {
        let Some(slider) = self.mechanism.slider(pad.joint) else { return Ok(()) };
        let force = self.configuration.pad_force(self.mechanism, pad).ok_or_else(|| {
            let kind = FaultKind::Overflow { quantity: format!("the load {}", load.name) };
            Fault::new(kind, load.place.clone())
        })?;
        let push = self.configuration.direction(slider.guide, slider.tangent) * (-pad.sense() * force);
        let middle = Attachment { frame: slider.block, position: slider.at };
        let place = self.configuration.position(self.mechanism, &middle);
        self.wrenches.push(Wrench::force(slider.block, place, push));
        self.wrenches.push(Wrench::force(slider.guide, place, -push));
        Ok(())
    }

    fn places(&self, between: &[Attachment<T>; 2]) -> [Vector2<T>; 2] {
        between.each_ref().map(|end| self.configuration.position(self.mechanism, end))
    }

    fn pull(&mut self, between: &[Attachment<T>; 2], places: [Vector2<T>; 2], pull: Vector2<T>) {
        self.wrenches.push(Wrench::force(between[0].frame, places[0], pull));
        self.wrenches.push(Wrench::force(between[1].frame, places[1], -pull));
    }
}

fn direction<T: Real>(load: &Load<T>, axis: Vector2<T>) -> Result<Vector2<T>, Fault> {
    let length = length(axis);
    if length.lower() > 0.0 {
        return Ok(axis / length);
    }
    Err(Fault::new(FaultKind::ZeroLength { load: load.name.to_string() }, load.place.clone()))
}
