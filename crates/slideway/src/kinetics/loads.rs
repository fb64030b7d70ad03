//! Weights, loads and the lines of action of the drives, as forces and couples on the bodies.

use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{BodyId, Frame};
use crate::interval::Real;
use crate::mechanism::{
    Attachment, Effort, Load, LoadKind, Mechanism, Pad, Quantity, length, length_in_space, rot90, tilting,
};
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
    /// How far the place is out of the drawing (m).
    pub z: T,
    /// The component of the force along z (N).
    pub along_z: T,
    /// The couples about x and y (N m).
    pub tilt: Vector2<T>,
}

impl<T: Real> Wrench<T> {
    /// A force in the plane at a place of the drawing.
    pub(crate) fn force(frame: Frame, place: Vector2<T>, force: Vector2<T>) -> Self {
        let (couple, z, along_z) = (T::zero(), T::zero(), T::zero());
        Self { frame, place, force, couple, z, along_z, tilt: Vector2::zeros() }
    }

    /// The same at a height, with a component along z.
    pub(crate) fn in_space(self, z: T, along_z: T) -> Self {
        Self { z, along_z, ..self }
    }

    pub(super) fn couple(frame: Frame, couple: T) -> Self {
        Self { couple, ..Self::force(frame, Vector2::zeros(), Vector2::zeros()) }
    }

    /// Adds it to the equations of the body on which it acts: three, six in space.
    pub(crate) fn add_to(
        &self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        mut add: impl FnMut(usize, T),
    ) {
        if let Some((first, z)) = mechanism.out_of_plane(self.frame) {
            let arm = (configuration.arm(self.frame, self.place), self.z - z);
            let about = tilting(arm, (self.force, self.along_z)) + self.tilt;
            add(first, self.along_z);
            add(first + 1, about.x);
            add(first + 2, about.y);
        }
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
                let Wrench { force, couple, along_z, tilt, .. } = wrench;
                [force.x, force.y, *couple, *along_z, tilt.x, tilt.y]
                    .iter()
                    .all(|part| part.magnitude() < GREATEST)
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

impl Wrench {
    /// Its power (W).
    pub(crate) fn power(&self, configuration: &Configuration) -> f64 {
        let velocity = configuration.velocity_at(self.frame, self.place);
        self.force.dot(&velocity) + self.couple * configuration.angular_velocity(self.frame)
    }
}

/// The velocity at which a unit effort of a drive works: force times velocity of its point, against its reaction.
pub(crate) fn velocity_of_effort(
    mechanism: &Mechanism,
    configuration: &Configuration,
    effort: &Effort,
) -> f64 {
    unit_effort(mechanism, configuration, effort).map(|wrench| wrench.power(configuration)).sum::<f64>() + 0.0
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
            let on = |frame: Frame, force: Vector2<T>| {
                Wrench::force(frame, place, force).in_space(at.z, T::zero())
            };
            [Some(on(at.frame, direction)), reaction.map(|frame| on(frame, -direction))]
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
            let weight = Wrench::force(Frame::Body(BodyId(index)), place, weight);
            self.wrenches.push(match &self.mechanism.space {
                None => weight,
                Some(space) => weight.in_space(space.bodies[index].z, space.gravity * body.mass),
            });
        }
    }

    fn quantity(&self, quantity: Quantity<T>) -> Result<T, Fault> {
        self.configuration.quantity(self.mechanism, quantity)
    }

    fn load(&mut self, load: &Load<T>) -> Result<(), Fault> {
        match &load.kind {
            LoadKind::Force { at, components, axes, along_z, turns, reaction } => {
                let mut force = Vector2::zeros();
                for (component, axis) in components.iter().zip(axes) {
                    let axis = if *turns { self.configuration.direction(at.frame, *axis) } else { *axis };
                    force += axis * self.quantity(*component)?;
                }
                let place = self.configuration.position(self.mechanism, at);
                let along_z = self.quantity(*along_z)?;
                self.wrenches.push(Wrench::force(at.frame, place, force).in_space(at.z, along_z));
                if let Some(reaction) = reaction {
                    self.wrenches.push(Wrench::force(*reaction, place, -force).in_space(at.z, -along_z));
                }
            }
            LoadKind::Torque { body, moment, tilt: [x, y], reaction } => {
                let moment = self.quantity(*moment)?;
                let tilt = Vector2::new(self.quantity(*x)?, self.quantity(*y)?);
                self.wrenches.push(Wrench { tilt, ..Wrench::couple(*body, moment) });
                let opposite = |frame| Wrench { tilt: -tilt, ..Wrench::couple(frame, -moment) };
                self.wrenches.extend(reaction.map(opposite));
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
        let rise = between[1].z - between[0].z;
        let (pull, along_z) = if free_length.is_zero() {
            (axis * stiffness, rise * stiffness)
        } else {
            let whole = length_in_space(axis, rise);
            let tension = stiffness * (whole - free_length);
            if tension.is_zero() {
                (Vector2::zeros(), T::zero())
            } else {
                let of_length = |part: T| part / whole * tension;
                check_length(load, whole)?;
                if rise.is_zero() {
                    (direction(load, axis)? * tension, T::zero())
                } else {
                    (axis.map(of_length), of_length(rise))
                }
            }
        };
        self.pull(between, [first, second], (pull, along_z));
        Ok(())
    }

    /// Pulls its ends together with c times the rate of its length.
    fn damper(&mut self, load: &Load<T>, between: &[Attachment<T>; 2], damping: T) -> Result<(), Fault> {
        if damping.is_zero() {
            return Ok(());
        }
        let [first, second] = self.places(between);
        let rise = between[1].z - between[0].z;
        let (axis, along_z) = if rise.is_zero() {
            (direction(load, second - first)?, T::zero())
        } else {
            let whole = length_in_space(second - first, rise);
            check_length(load, whole)?;
            ((second - first) / whole, rise / whole)
        };
        let relative = self.configuration.velocity_at(between[1].frame, second)
            - self.configuration.velocity_at(between[0].frame, first);
        let tension = damping * axis.dot(&relative);
        self.pull(between, [first, second], (axis * tension, along_z * tension));
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
        let middle = Attachment { frame: slider.block, position: slider.at, z: slider.z };
        let place = self.configuration.position(self.mechanism, &middle);
        for (frame, push) in [(slider.block, push), (slider.guide, -push)] {
            self.wrenches.push(Wrench::force(frame, place, push).in_space(slider.z, T::zero()));
        }
        Ok(())
    }

    fn places(&self, between: &[Attachment<T>; 2]) -> [Vector2<T>; 2] {
        between.each_ref().map(|end| self.configuration.position(self.mechanism, end))
    }

    fn pull(
        &mut self,
        between: &[Attachment<T>; 2],
        places: [Vector2<T>; 2],
        (pull, along_z): (Vector2<T>, T),
    ) {
        let [first, second] = between;
        self.wrenches.push(Wrench::force(first.frame, places[0], pull).in_space(first.z, along_z));
        self.wrenches.push(Wrench::force(second.frame, places[1], -pull).in_space(second.z, -along_z));
    }
}

fn direction<T: Real>(load: &Load<T>, axis: Vector2<T>) -> Result<Vector2<T>, Fault> {
    let length = length(axis);
    check_length(load, length)?;
    Ok(axis / length)
}

fn check_length<T: Real>(load: &Load<T>, length: T) -> Result<(), Fault> {
    if length.lower() > 0.0 {
        return Ok(());
    }
    Err(Fault::new(FaultKind::ZeroLength { load: load.name.to_string() }, load.place.clone()))
}
