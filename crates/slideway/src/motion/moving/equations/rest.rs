//! What stands still while other parts of the mechanism may move.

use super::Equations;
use crate::configuration::Velocity;
use crate::expression::Symbol;
use crate::ids::{BodyId, Frame, JointId};
use crate::mechanism::{Drive, LoadKind, Mechanism, Quantity, frames_of, loaded_bodies, quantities};
use crate::motion::moving::connected::{connected, join};

impl Equations<'_> {
    /// For each body whether it stands still as long as the joints that stick in the phase do: together with
    /// what joints connect with it no motion is left to it, nothing drives it, no body is faster than its limit
    /// (m/s), and what acts on it depends on the time and on bodies of this kind alone.
    pub(in crate::motion) fn resting(&self, limit: impl Fn(usize) -> f64) -> Vec<bool> {
        let bodies = self.mechanism.bodies.len();
        if self.stuck.is_empty() {
            return vec![false; bodies];
        }
        let parts = connected(self.mechanism);
        let mut moves = vec![false; bodies];
        let mut freedoms = vec![0_usize; bodies];
        let of_body = self.layout.accelerations() / bodies;
        parts.iter().for_each(|part| freedoms[*part] += of_body);
        for row in 0..self.row_ends.len() {
            let first = if row == 0 { 0 } else { self.row_ends[row - 1] };
            if let Some((column, _)) = self.rows[first..self.row_ends[row]].first() {
                let part = parts[self.mechanism.body_of_acceleration(*column)];
                freedoms[part] = freedoms[part].saturating_sub(1);
            }
        }
        let is_fast = |body: usize, v: &Velocity| {
            v.linear.amax().max(v.angular.abs() * self.mechanism.size) > limit(body)
        };
        for (body, rate) in self.configuration.velocities.iter().enumerate() {
            moves[parts[body]] |= is_fast(body, rate) || freedoms[parts[body]] > 0;
        }
        let drives = self.mechanism.drives.iter();
        for driven in drives.flat_map(|drive| bodies_of_drive(self.mechanism, drive)) {
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
    frames_of(mechanism, joint).into_iter().filter_map(Frame::body).all(|body| rests[body.index()])
}

/// For each body a number that it shares with all those on which its motion depends, or whose motion depends on it: through
/// joints, loads and drives, and through the coordinates in their formulas.
pub(in crate::motion) fn independent(mechanism: &Mechanism) -> Vec<usize> {
    let mut parts = connected(mechanism);
    let loads = mechanism.loads.iter().map(|load| bodies_of_load(mechanism, &load.kind).concat());
    let drives = mechanism.drives.iter().map(|drive| {
        let further = bodies_of_quantity(mechanism, drive.acceleration);
        bodies_of_drive(mechanism, drive).chain(further).collect::<Vec<BodyId>>()
    });
    for together in loads.chain(drives) {
        together.windows(2).for_each(|pair| join(&mut parts, pair[0].index(), pair[1].index()));
    }
    parts
}

/// The bodies on which a drive acts, and those whose motion it prescribes.
pub(in crate::motion) fn bodies_of_drive(
    mechanism: &Mechanism,
    drive: &Drive,
) -> impl Iterator<Item = BodyId> {
    let prescribed = mechanism.coordinates[drive.coordinate.index()].kind.frames(mechanism);
    drive.effort.frames().into_iter().chain(prescribed).filter_map(Frame::body)
}

/// The bodies on which a load acts, and those on whose motion its formulas depend.
fn bodies_of_load(mechanism: &Mechanism, load: &LoadKind) -> [Vec<BodyId>; 2] {
    let of = |quantity: Quantity| bodies_of_quantity(mechanism, quantity);
    [loaded_bodies(mechanism, load), quantities(load).into_iter().flat_map(of).collect()]
}

/// The bodies on whose motion a quantity depends.
fn bodies_of_quantity(mechanism: &Mechanism, quantity: Quantity) -> Vec<BodyId> {
    let Quantity::Varying(formula) = quantity else { return Vec::new() };
    let symbols = mechanism.expression(formula).symbols();
    let coordinates = symbols.filter_map(|(symbol, _)| match symbol {
        Symbol::Coordinate(index) | Symbol::Rate(index) => Some(&mechanism.coordinates[index].kind),
        _ => None,
    });
    coordinates.flat_map(|kind| kind.frames(mechanism)).filter_map(Frame::body).collect()
}
