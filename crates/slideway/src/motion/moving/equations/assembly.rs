//! The matrix and the right-hand side, written anew at each evaluation.

use super::{Equations, Failure, Rubbing};
use crate::ids::{ContactId, DriveId};
use crate::kinetics::{ConstraintRow, each_inertia, each_spin, effort_forces, friction_forces};
use crate::modes::Side;
use crate::motion::moving::linear::LinearSystem;
use crate::pattern::face;

impl Equations<'_> {
    /// Writes the matrix, and the right-hand side in place of the unknowns.
    pub(super) fn assemble(&mut self) -> Result<(), Failure> {
        self.applied.fill(self.mechanism, &self.configuration).map_err(Failure::Loads)?;
        self.system.clear();
        self.unknowns.fill(0.0);
        each_inertia(self.mechanism, &self.configuration, |row, column, value| {
            self.system.add(row, column, value);
        });
        for wrench in &self.applied.wrenches {
            wrench.add_to(self.mechanism, &self.configuration, |row, value| self.unknowns[row] += value);
        }
        each_spin(self.mechanism, &self.configuration, |row, value| self.unknowns[row] += value);
        self.assemble_constraints();
        self.update_friction()?;
        self.assemble_friction();
        self.assemble_turning();
        self.assemble_drives()
    }

    /// G and -G^T, and the rows and columns of the sticking joints.
    fn assemble_constraints(&mut self) {
        self.rows.clear();
        self.row_ends.clear();
        let first = self.layout.accelerations();
        for (index, reaction) in self.layout.reactions().iter().enumerate() {
            if self.is_without(*reaction) {
                self.system.add(first + index, first + index, 1.0);
            } else {
                self.row.set_constraint(self.mechanism, &self.configuration, &self.contacts, *reaction);
                put_row(&mut self.system, &mut self.unknowns, &self.row, first + index);
                self.rows.extend_from_slice(&self.row.entries);
            }
            self.row_ends.push(self.rows.len());
        }
        let first = self.layout.len();
        for index in 0..self.stuck.len() {
            if !self.set_stuck_row(self.stuck[index].what) {
                continue;
            }
            put_row(&mut self.system, &mut self.unknowns, &self.row, first + index);
            self.rows.extend_from_slice(&self.row.entries);
            self.row_ends.push(self.rows.len());
        }
    }

    /// Friction that depends on the sliding speed, at that of the present state. Beyond the instant at which
    /// the joint stops, where a step may look before it is cut, the formula goes on smoothly with a negative
    /// number if it has a value there.
    fn update_friction(&mut self) -> Result<(), Failure> {
        for (k, rubbing) in self.rubbing.iter_mut().enumerate() {
            if let Rubbing::Pressed { side, sign, faces } = rubbing
                && self.mechanism.contacts[k].depends_on_speed()
            {
                let forwards = *sign * self.contacts[k].sliding_velocity;
                let at = |speed: f64| {
                    self.mechanism.friction_of(ContactId(k), speed, self.configuration.pieces.as_deref())
                };
                let mut found = at(forwards);
                if forwards < 0.0 && found.is_err() {
                    found = at(-forwards);
                }
                let mu = found.map_err(|fault| Failure::Loads(fault.into()))?;
                faces[face(*side)][0] = mu[face(*side)] * *sign;
            }
        }
        Ok(())
    }

    fn assemble_friction(&mut self) {
        for (k, rubbing) in self.rubbing.iter().enumerate() {
            let (column, sigma, faces) = match rubbing {
                Rubbing::Sticking | Rubbing::Open => continue,
                Rubbing::Pressed { side, faces, .. } => (self.normal[k], side.sign(), faces),
                Rubbing::Gap { faces, share } => {
                    self.system.clear_column(*share);
                    (*share, 1.0, faces)
                }
            };
            for (side, [factor, constant]) in Side::BOTH.into_iter().zip(*faces) {
                if [factor, constant] == [0.0; 2] {
                    continue;
                }
                let contact = &self.contacts[k];
                for wrench in friction_forces(self.mechanism, ContactId(k), contact, side.sign(), 1.0) {
                    wrench.add_to(self.mechanism, &self.configuration, |row, value| {
                        self.system.add(row, column, -value * factor * sigma);
                        self.unknowns[row] += value * constant;
                    });
                }
            }
        }
    }

    fn assemble_drives(&mut self) -> Result<(), Failure> {
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            let effort = self.layout.effort(DriveId(index));
            let kind = self.mechanism.coordinates[drive.coordinate.index()].kind;
            self.row.set_coordinate(self.mechanism, &self.configuration, kind);
            for &(column, value) in &self.row.entries {
                self.system.add(effort, column, value);
            }
            for wrench in effort_forces(self.mechanism, &self.configuration, &drive.effort) {
                wrench.add_to(self.mechanism, &self.configuration, |row, value| {
                    self.system.add(row, effort, -value);
                });
            }
            let prescribed = self.configuration.quantity(self.mechanism, drive.acceleration);
            self.unknowns[effort] =
                prescribed.map_err(|fault| Failure::Loads(fault.into()))? + self.row.right_hand_side;
        }
        Ok(())
    }
}

/// A row of constraints, its force as a column, and its right-hand side.
fn put_row(system: &mut LinearSystem, right_hand_side: &mut [f64], row: &ConstraintRow, place: usize) {
    for &(column, value) in &row.entries {
        system.add(place, column, value);
        system.add(column, place, -value);
    }
    right_hand_side[place] = row.right_hand_side;
}
