//! What stands still while other parts of the mechanism may move.

use super::Equations;
use crate::configuration::Velocity;
use crate::expression::Symbol;
use crate::ids::{BodyId, Frame, JointId};
use crate::mechanism::{
    CoordinateKind, Effort, JointKind, LoadKind, Mechanism, Quantity, loaded_bodies, quantities,
};
use crate::motion::moving::connected::connected;

impl Equations<'_> {
    /// For each body whether it stands still as long as the joints that stick in the phase do: together with
    /// what joints connect with it no motion is left to it, nothing drives it, nothing is faster than this
    /// (m/s), and what acts on it depends on the time and on bodies of this kind alone.
    pub(in crate::motion) fn resting(&self, velocity: f64) -> Vec<bool> {
        let bodies = self.mechanism.bodies.len();
        if self.stuck.is_empty() {
            return vec![false; bodies];
        }
        let parts = connected(self.mechanism);
        let mut moves = vec![false; bodies];
        let mut freedoms = vec![0_usize; bodies];
        parts.iter().for_each(|part| freedoms[*part] += 3);
        for row in 0..self.row_ends.len() {
            let first = if row == 0 { 0 } else { self.row_ends[row - 1] };
            if let Some((column, _)) = self.rows[first..self.row_ends[row]].first() {
                let part = parts[column / 3];
                freedoms[part] = freedoms[part].saturating_sub(1);
            }
        }
        let is_fast =
            |v: &Velocity| v.linear.amax() > velocity || v.angular.abs() * self.mechanism.size > velocity;
        for (body, rate) in self.configuration.velocities.iter().enumerate() {
            moves[parts[body]] |= is_fast(rate) || freedoms[parts[body]] > 0;
        }
        for driven in driven(self.mechanism) {
            moves[parts[driven.index()]] = true;
        }
        let loads: Vec<[Vec<BodyId>; 2]> =
            self.mechanism.loads.iter().map(|load| bodies_of_load(self.mechanism, &load.kind)).collect();
        // What moves takes along what its loads act on.
        loop {
            let before = moves.clone();
            for [on, of] in &loads {
                if on.iter().chain(of).any(|body| moves[parts[body.index()]]) {
                    on.iter().for_each(|body| moves[parts[body.index()]] = true);
                }
            }
            if moves == before {
                return parts.iter().map(|part| !moves[*part]).collect();
            }
        }
    }
}

/// Whether both sides of a joint stand still.
pub(in crate::motion) fn joint_rests(mechanism: &Mechanism, joint: JointId, rests: &[bool]) -> bool {
    let frames = match &mechanism.joints[joint.index()].kind {
        JointKind::Slider(slider) => [slider.block, slider.guide],
        JointKind::Hinge(ends) => ends.each_ref().map(|end| end.frame),
    };
    frames.into_iter().filter_map(Frame::body).all(|body| rests[body.index()])
}

/// The bodies on which drives act, and those whose motion they prescribe.
fn driven(mechanism: &Mechanism) -> impl Iterator<Item = BodyId> + '_ {
    mechanism.drives.iter().flat_map(|drive| {
        let (frame, reaction) = match &drive.effort {
            Effort::Force { at, reaction, .. } => (at.frame, *reaction),
            Effort::Torque { body, reaction } => (*body, *reaction),
        };
        let prescribed = bodies_of(mechanism, &mechanism.coordinates[drive.coordinate.index()].kind);
        [Some(frame), reaction].into_iter().flatten().filter_map(Frame::body).chain(prescribed)
    })
}

/// The bodies on which a load acts, and those on whose motion its formulas depend.
fn bodies_of_load(mechanism: &Mechanism, load: &LoadKind) -> [Vec<BodyId>; 2] {
    let of = |quantity: Quantity| {
        let Quantity::Varying(formula) = quantity else { return Vec::new() };
        let symbols = mechanism.expression(formula).symbols();
        let coordinates = symbols.filter_map(|(symbol, _)| match symbol {
            Symbol::Coordinate(index) | Symbol::Rate(index) => Some(&mechanism.coordinates[index].kind),
            _ => None,
        });
        coordinates.flat_map(|kind| bodies_of(mechanism, kind)).collect()
    };
    [loaded_bodies(mechanism, load), quantities(load).into_iter().flat_map(of).collect()]
}

/// The bodies on which a coordinate depends.
fn bodies_of(mechanism: &Mechanism, coordinate: &CoordinateKind) -> Vec<BodyId> {
    let frames = match coordinate {
        CoordinateKind::Slide(joint) => match &mechanism.joints[joint.index()].kind {
            JointKind::Slider(slider) => vec![slider.block, slider.guide],
            JointKind::Hinge(ends) => ends.each_ref().map(|end| end.frame).to_vec(),
        },
        CoordinateKind::Rotation(body, frame) => vec![Frame::Body(*body), *frame],
        CoordinateKind::Displacement(attachment, _) => vec![attachment.frame],
    };
    frames.into_iter().filter_map(Frame::body).collect()
}
