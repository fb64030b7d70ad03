//! Friction of hinges: `M = -r |R| sgn(omega)` on the first body, where `R` is the force of the hinge (theory of hinges,
//! section 1).
//!
//! `|R| = t.R` with the direction `t` of R, so that the equations are linear once the directions are known. Each solution
//! gives the directions of the next one: Newton's method, since `t` is the gradient of `|R|`. It begins with the
//! directions of the last evaluation, so that it follows one of several solutions; where the determinant of the equations
//! has another sign than at the beginning of the phase it has left that one (theory of hinges, section 4).

use super::{Equations, Failure, Sticks};
use crate::ids::{Frame, JointId};
use crate::kinetics::Layout;
use crate::mechanism::{CoordinateKind, FrictionCircle, Mechanism};
use crate::pattern::Phase;

/// More steps of Newton's method are not taken.
const MOST_STEPS: usize = 12;
/// `|R| - t.R` below this part of the greatest force at a hinge is rounding.
const ROUNDING: f64 = 1e-15;

/// A hinge with friction.
#[derive(Debug, Clone)]
pub(super) struct RoughHinge {
    pub(super) joint: JointId,
    /// Where its force stands among the unknowns.
    force: [usize; 2],
    /// The equations of rotation of its bodies, and the sign of its couple there.
    couple: Vec<(usize, f64)>,
    /// Radius of the friction circle while it turns, times the sign with which it does; zero where it sticks.
    leverage: f64,
    /// The direction of its force.
    direction: [f64; 2],
}

/// The hinges with friction, not yet in a phase.
pub(super) fn rough_hinges(mechanism: &Mechanism, layout: &Layout) -> Vec<RoughHinge> {
    let one = |circle: &FrictionCircle| {
        let place = |force| layout.reaction(force).expect("every hinge has its force");
        let joint = circle.joint;
        RoughHinge {
            joint,
            force: circle.reactions().map(place),
            couple: signed_rotations(mechanism, joint)
                .filter_map(|(frame, sign)| Some((3 * frame.body()?.index() + 2, sign)))
                .collect(),
            leverage: 0.0,
            direction: [0.0; 2],
        }
    };
    mechanism.friction_circles.iter().map(one).collect()
}

/// The bodies of a hinge, with the sign with which their rotation counts.
fn signed_rotations(mechanism: &Mechanism, joint: JointId) -> impl Iterator<Item = (Frame, f64)> {
    let ends = mechanism.hinge(joint).map(|[first, second]| [(first.frame, 1.0), (second.frame, -1.0)]);
    ends.into_iter().flatten()
}

impl Equations<'_> {
    /// Chooses which hinges turn with friction, and in which direction their forces are looked for if that is not known.
    pub(super) fn choose_turning(&mut self, phase: &Phase) {
        let circles = self.mechanism.friction_circles.iter().zip(&phase.hinges);
        for (hinge, (circle, phase)) in self.hinges.iter_mut().zip(circles) {
            hinge.leverage = circle.radius * phase.state.sign();
            if hinge.direction == [0.0; 2] {
                hinge.direction = unit(phase.force).unwrap_or_default();
            }
        }
    }

    /// Follows the solution with these forces of the hinges with friction from now on.
    pub(in crate::motion) fn follow(&mut self, forces: impl IntoIterator<Item = [f64; 2]>) {
        for (hinge, force) in self.hinges.iter_mut().zip(forces) {
            hinge.direction = unit(force).unwrap_or(hinge.direction);
        }
    }

    /// A phase with the forces of the hinges with friction at the last evaluation.
    pub(in crate::motion) fn with_present_forces(&self, phase: &Phase) -> Phase {
        let mut phase = phase.clone();
        for (index, hinge) in phase.hinges.iter_mut().enumerate() {
            hinge.force = self.hinge_force(index).unwrap_or(hinge.force);
        }
        phase
    }

    /// The directions of the forces of the hinges with friction at the last evaluation.
    pub(in crate::motion) fn directions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.hinges.iter().map(|hinge| hinge.direction)
    }

    /// Whether hinges turn with friction.
    pub(in crate::motion) fn turns(&self) -> bool {
        self.hinges.iter().any(|hinge| hinge.leverage != 0.0)
    }

    /// Their couples, as columns of their forces.
    pub(super) fn assemble_turning(&mut self) {
        for hinge in self.hinges.iter().filter(|hinge| hinge.leverage != 0.0) {
            for (column, direction) in hinge.force.into_iter().zip(hinge.direction) {
                for (row, sign) in &hinge.couple {
                    self.system.add(*row, column, sign * hinge.leverage * direction);
                }
            }
        }
    }

    /// Newton's method for the directions, from the solution of the first step. Where it fails the directions stay what they
    /// were.
    ///
    /// # Errors
    /// It does not converge, or to a solution of the other orientation.
    pub(super) fn turn_friction(&mut self) -> Result<(), Failure> {
        if !self.turns() {
            return Ok(());
        }
        let before: Vec<[f64; 2]> = self.directions().collect();
        let found = self.converged();
        if found.is_err() {
            self.hinges.iter_mut().zip(before).for_each(|(hinge, direction)| hinge.direction = direction);
        }
        found
    }

    fn converged(&mut self) -> Result<(), Failure> {
        for _ in 0..MOST_STEPS {
            if self.take_directions() <= ROUNDING {
                let left = self.orientation.is_some_and(|sign| sign != self.system.determinant().sign());
                return if left { Err(Failure::Fold) } else { Ok(()) };
            }
            self.assemble()?;
            self.solve_once()?;
        }
        Err(Failure::Fold)
    }

    /// Takes the directions of the last solution; returns the greatest `|R| - t.R` with those before, as a part of the
    /// greatest force.
    fn take_directions(&mut self) -> f64 {
        let (mut error, mut greatest) = (0.0_f64, 0.0_f64);
        for hinge in self.hinges.iter_mut().filter(|hinge| hinge.leverage != 0.0) {
            let force = hinge.force.map(|place| self.unknowns[place]);
            let length = norm(force);
            let along = hinge.direction[0] * force[0] + hinge.direction[1] * force[1];
            error = error.max(length - along);
            greatest = greatest.max(length);
            hinge.direction = unit(force).unwrap_or(hinge.direction);
        }
        if greatest > 0.0 { error / greatest } else { 0.0 }
    }

    /// The force of a hinge with friction on its first body at the last evaluation (N).
    pub(in crate::motion) fn hinge_force(&self, hinge: usize) -> Option<[f64; 2]> {
        let places = self.hinges[hinge].force;
        Some([*self.unknowns.get(places[0])?, *self.unknowns.get(places[1])?])
    }

    /// The couple of a hinge with friction on its first body at the last evaluation (N m): the kinetic one, or that of a
    /// hinge that sticks by an equation of its own.
    pub(in crate::motion) fn hinge_couple(&self, hinge: usize) -> Option<f64> {
        if self.hinges[hinge].leverage != 0.0 {
            return self.hinge_force(hinge).map(|force| -self.hinges[hinge].leverage * norm(force));
        }
        let index = self.stuck.iter().position(|stuck| stuck.what == Sticks::Hinge(hinge))?;
        let (_, sign) = self.rotation_of(hinge)?;
        Some(sign * self.unknowns[self.layout.len() + index])
    }

    /// The rotation that a hinge with friction is: that of its first body against the second, or minus that of the second
    /// against the first, which then is no body.
    pub(super) fn rotation_of(&self, hinge: usize) -> Option<(CoordinateKind, f64)> {
        let [first, second] = self.mechanism.hinge(self.hinges[hinge].joint)?.each_ref().map(|end| end.frame);
        let rotation = |one: Frame, other, sign| Some((CoordinateKind::Rotation(one.body()?, other), sign));
        rotation(first, second, 1.0).or_else(|| rotation(second, first, -1.0))
    }

    /// The angular velocity of the first body of a hinge with friction against the second (rad/s).
    pub(in crate::motion) fn spin(&self, hinge: usize) -> f64 {
        let rotations = signed_rotations(self.mechanism, self.hinges[hinge].joint);
        rotations.map(|(frame, sign)| sign * self.configuration.angular_velocity(frame)).sum()
    }

    /// Power that the friction of a hinge dissipates (W).
    pub(in crate::motion) fn power_of_hinge(&self, hinge: usize) -> f64 {
        let turning = self.hinges[hinge].leverage != 0.0;
        if turning { -self.hinge_couple(hinge).unwrap_or(0.0) * self.spin(hinge) } else { 0.0 }
    }

    /// The joints of the hinges with friction.
    pub(in crate::motion) fn hinge_joints(&self) -> impl Iterator<Item = JointId> + '_ {
        self.hinges.iter().map(|hinge| hinge.joint)
    }
}

pub(super) fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// The direction of a force, if it has one.
fn unit(force: [f64; 2]) -> Option<[f64; 2]> {
    let length = norm(force);
    (length > 0.0).then(|| force.map(|component| component / length))
}
