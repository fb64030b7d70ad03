//! The greatest magnitudes so far, for tolerances: each part of a mechanism has its own, so that nothing that happens in one
//! part changes what counts in another.

use super::equations::{Equations, independent};
use crate::ids::{BodyId, JointId};
use crate::mechanism::{Mechanism, body_of};

/// Velocities below this part of what the greatest force gives a part on the size of the mechanism do not count.
const LITTLE_VELOCITY: f64 = 1e-2;

/// The greatest component of a velocity or acceleration of a body, rotations times the size of the mechanism (m/s or m/s^2).
pub(in crate::motion) fn in_metres(of_body: &[f64], size: f64) -> f64 {
    of_body[0].abs().max(of_body[1].abs()).max(of_body[2].abs() * size)
}

/// The greatest magnitudes of a part so far.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::motion) struct Magnitude {
    /// Force (N).
    pub(in crate::motion) force: f64,
    /// Velocity (m/s), rotations times the size of the mechanism.
    pub(in crate::motion) velocity: f64,
    /// The greatest force where the phase begins (N).
    pub(in crate::motion) first_force: f64,
}

impl Magnitude {
    fn max(self, other: Self) -> Self {
        Self {
            force: self.force.max(other.force),
            velocity: self.velocity.max(other.velocity),
            first_force: self.first_force.max(other.first_force),
        }
    }
}

/// The greatest magnitudes so far of bodies that have nothing to do with one another.
#[derive(Debug, Clone, Default)]
pub(in crate::motion) struct Magnitudes {
    /// For each body the number of its part, ...
    parts: Vec<usize>,
    /// ... and by that number: the magnitudes, ...
    list: Vec<Magnitude>,
    /// ... and the mass (kg).
    masses: Vec<f64>,
    size: f64,
}

impl Magnitudes {
    /// Those of a mechanism; the least force of some bodies is given (N).
    pub(in crate::motion) fn new(
        mechanism: &Mechanism,
        least: impl Fn(&dyn Fn(BodyId) -> bool) -> f64,
    ) -> Self {
        let parts = independent(mechanism);
        let mut masses = vec![0.0; parts.len()];
        parts.iter().zip(&mechanism.bodies).for_each(|(part, body)| masses[*part] += body.mass);
        let mut list = vec![Magnitude::default(); parts.len()];
        for (part, magnitude) in list.iter_mut().enumerate().filter(|(part, _)| parts.contains(part)) {
            magnitude.force = least(&|body| parts[body.index()] == part);
        }
        Self { parts, list, masses, size: mechanism.size }
    }

    /// Those of the part of a body.
    pub(in crate::motion) fn of_body(&self, body: usize) -> Magnitude {
        self.list[self.parts[body]]
    }

    /// Those of the part of a joint.
    pub(in crate::motion) fn of_joint(&self, mechanism: &Mechanism, joint: JointId) -> Magnitude {
        body_of(mechanism, joint).map_or_else(|| self.greatest(), |body| self.of_body(body.index()))
    }

    /// The greatest of all parts.
    pub(in crate::motion) fn greatest(&self) -> Magnitude {
        self.list.iter().copied().fold(Magnitude::default(), Magnitude::max)
    }

    /// For each body the number of its part.
    pub(in crate::motion) fn parts(&self) -> &[usize] {
        &self.parts
    }

    /// Takes note of the velocities in a state: positions and angles of all bodies, then their rates.
    pub(in crate::motion) fn notice_velocities(&mut self, state: &[f64]) {
        let bodies = self.parts.len();
        let rates = state[3 * bodies..6 * bodies].chunks_exact(3);
        for (part, rate) in self.parts.iter().zip(rates) {
            self.list[*part].velocity = self.list[*part].velocity.max(in_metres(rate, self.size));
        }
    }

    /// Takes note of accelerations: of the velocities that a part gets from rest on the size of the mechanism.
    ///
    /// Returns the shortest of the times in which a part goes through that size, or its velocity changes (s).
    pub(in crate::motion) fn notice_accelerations(&mut self, accelerations: &[f64]) -> f64 {
        let mut greatest = vec![0.0_f64; self.list.len()];
        for (part, of_body) in self.parts.iter().zip(accelerations.chunks_exact(3)) {
            greatest[*part] = greatest[*part].max(in_metres(of_body, self.size));
        }
        let mut shortest = f64::INFINITY;
        for (magnitude, acceleration) in self.list.iter_mut().zip(greatest) {
            magnitude.velocity = magnitude.velocity.max((acceleration * self.size).sqrt());
            let times = [self.size / magnitude.velocity, magnitude.velocity / acceleration];
            shortest = times.into_iter().filter(|time| *time > 0.0).fold(shortest, f64::min);
        }
        shortest
    }

    /// Takes note of the forces at the last evaluation, and of velocities that they could cause: at rest there is no
    /// other scale.
    pub(in crate::motion) fn notice_forces(&mut self, equations: &Equations<'_>) {
        for (part, force) in self.forces(equations).into_iter().enumerate() {
            let magnitude = &mut self.list[part];
            magnitude.force = magnitude.force.max(force);
            if self.masses[part] > 0.0 {
                let velocity = (magnitude.force * self.size / self.masses[part]).sqrt();
                magnitude.velocity = magnitude.velocity.max(LITTLE_VELOCITY * velocity);
            }
        }
    }

    /// Takes note of the forces where a phase begins.
    pub(in crate::motion) fn begin(&mut self, equations: &Equations<'_>) {
        for (part, force) in self.forces(equations).into_iter().enumerate() {
            self.list[part].first_force = force;
        }
        self.notice_forces(equations);
    }

    /// True if the forces of a part have grown by more than a factor since the phase has begun.
    pub(in crate::motion) fn has_grown(&self, factor: f64) -> bool {
        self.list.iter().any(|one| one.first_force > 0.0 && one.force > factor * one.first_force)
    }

    /// The greatest force of each part at the last evaluation (N).
    fn forces(&self, equations: &Equations<'_>) -> Vec<f64> {
        let mut greatest = vec![0.0_f64; self.list.len()];
        equations.each_force(|body, force| {
            let part = self.parts[body.index()];
            greatest[part] = greatest[part].max(force);
        });
        greatest
    }
}
