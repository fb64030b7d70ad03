//! Which joint equations say nothing new: sliding joints that share their load (theory of redundant guides).
//!
//! A mechanism with `n` coordinates has `rows + n - 3 b` equations more than determine it, `rows + n - 6 b` in space. In the drawing, so
//! many are chosen that follow from the others: the positions are found without these rows of the joints, and
//! as many contacts are *cut*, whose normal forces become unknowns of their own (force method). The choice is
//! the same in every position, so that all numbers that are made with it change continuously. The two faces of a
//! press fit have one row, so that one of them is cut.

use super::{Attachment, Joint, JointKind, Mechanism, Slider, rot90, tilting};
use crate::ids::{ContactId, Frame};
use crate::model::SliderKind;
use crate::modes::OpenContacts;
use nalgebra::{DMatrix, DVector, Vector2};

/// A row that differs from combinations of others by less than this part of its length is one of them.
const DEPENDENT: f64 = 1e-9;
/// The first row is taken that is independent of the others by this part of the most independent one.
const INDEPENDENT_ENOUGH: f64 = 0.3;

/// The joint equations in excess, and the contacts that are cut for them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Excess {
    /// The contacts that are cut, as many as there are self-stresses.
    pub contacts: Vec<ContactId>,
    /// The rows of the joint equations that are left out of those that determine the positions.
    pub(crate) rows: Vec<usize>,
    /// Which contacts may be open, and together.
    pub open: OpenContacts,
    /// Of these, how many belong to self-stresses of hinges and rotation locks alone.
    pub(crate) of_hinges: usize,
}

impl Excess {
    /// Whether a contact takes part in a self-stress.
    pub fn shares(&self, contact: ContactId) -> bool {
        self.open.shares(contact.index())
    }

    /// Whether every joint equation says something new.
    pub fn is_empty(&self) -> bool {
        self.contacts.is_empty() && self.rows.is_empty()
    }
}

/// A row of the drawing.
pub(super) struct Row {
    entries: DVector<f64>,
    /// Rows of lower rank are taken first.
    rank: u8,
}

impl Row {
    /// Its first columns alone.
    pub(super) fn within(&self, columns: usize) -> Self {
        Self { entries: self.entries.rows(0, columns).into_owned(), rank: self.rank }
    }

    pub(super) fn entries(&self) -> &DVector<f64> {
        &self.entries
    }
}

/// How many of these rows say something new.
pub(super) fn rank(rows: &[Row]) -> usize {
    rows.len() - dependent(rows).len()
}

impl Mechanism {
    /// The excess in the drawing; nothing if the coordinates leave none, or the rows are independent.
    pub(super) fn found_excess(&self) -> Excess {
        let (reactions, contacts): (Vec<Row>, Vec<Option<ContactId>>) =
            self.reaction_rows().into_iter().unzip();
        let excess =
            |rows: &[Row], columns: usize| (rows.len() + self.coordinates.len()).saturating_sub(columns);
        let of_reactions = excess(&reactions, self.accelerations());
        // In space what is too much for the plane may carry out of it.
        if of_reactions == 0 && self.space.is_none() {
            return Excess::default();
        }
        let positions = self.position_rows();
        let of_positions = excess(&positions, 3 * self.bodies.len());
        let left_out = dependent(&positions).into_iter().map(|(row, _)| row).take(of_positions).collect();
        // Of both faces of a press fit one is always in excess, while other rows may be so in the drawing alone.
        let is_second_face = |row: usize| {
            contacts[row].is_some_and(|contact: ContactId| self.contacts[contact.index()].is_second_face())
        };
        let mut stresses = dependent(&reactions);
        stresses.sort_by_key(|(row, _)| !is_second_face(*row));
        stresses.truncate(of_reactions);
        let cut: Vec<Option<ContactId>> = stresses.iter().map(|(row, _)| contacts[*row]).collect();
        let mut forces = DMatrix::zeros(self.contacts.len(), stresses.len());
        for (row, contact) in contacts.iter().enumerate() {
            if let Some(contact) = contact {
                let of_contact = stresses.iter().map(|(_, stress)| stress[row]);
                of_contact.enumerate().for_each(|(stress, force)| forces[(contact.index(), stress)] = force);
            }
        }
        Excess {
            of_hinges: cut.iter().filter(|contact| contact.is_none()).count(),
            contacts: cut.into_iter().flatten().collect(),
            rows: left_out,
            open: OpenContacts::new(forces),
        }
    }

    /// The rows of the joint equations in the drawing, in their order, those of what sticks last. Rotations are taken first: they
    /// are the same in every position.
    fn position_rows(&self) -> Vec<Row> {
        let mut rows = Vec::new();
        for joint in &self.joints {
            match &joint.kind {
                JointKind::Hinge(ends) => rows.extend(self.hinge_rows(ends, 1)),
                JointKind::Slider(slider) if slider.contacts.is_empty() => {}
                JointKind::Slider(slider) => {
                    rows.push(self.normal_row(slider, (slider.at, rot90(slider.tangent)), 2));
                    if slider.kind != SliderKind::Pin {
                        rows.push(self.rotation_row(slider));
                    }
                }
            }
        }
        rows.extend(self.sticking().map(|(_, slider)| self.sticking_row(slider)));
        rows.iter().map(|row| row.within(3 * self.bodies.len())).collect()
    }

    /// The rows of hinges and rotation locks, which are taken first, and of the contacts.
    pub(super) fn reaction_rows(&self) -> Vec<(Row, Option<ContactId>)> {
        let mut rows = Vec::new();
        for joint in &self.joints {
            match &joint.kind {
                JointKind::Hinge(ends) => rows.extend(self.hinge_rows(ends, 0).map(|row| (row, None))),
                JointKind::Slider(slider) => {
                    let normal = |id: &ContactId| {
                        let contact = &self.contacts[id.index()];
                        let normal = rot90(slider.tangent);
                        let [cos, sin] = contact.normal_across();
                        let mut row = self.normal_row(slider, (contact.position(slider), normal * cos), 1);
                        let place = (contact.position(slider), slider.z + contact.aside[1]);
                        self.displace_out(&mut row, slider.block, place, (normal * cos, sin));
                        self.displace_out(&mut row, slider.guide, place, (-normal * cos, -sin));
                        (row, Some(*id))
                    };
                    rows.extend(slider.contacts.iter().map(normal));
                    if slider.kind == SliderKind::Guided {
                        rows.push((self.rotation_row(slider), None));
                    }
                }
            }
            let carried = (0..3).filter(|&component| self.carries(joint, component));
            rows.extend(carried.map(|component| (self.carried_row(joint, component), None)));
        }
        rows
    }

    /// What a joint carries out of the drawing without friction: a force along z, or a couple.
    fn carried_row(&self, joint: &Joint, component: usize) -> Row {
        let mut row = self.row(0);
        let joined = joint.joined();
        for (frame, sign) in joined.frames.into_iter().zip([1.0, -1.0]) {
            if component == 0 {
                self.displace_out(&mut row, frame, joined.place, (Vector2::zeros(), sign));
            } else if let Some((first, _)) = self.out_of_plane(frame) {
                let axis = joined.axes[component - 1] * sign;
                row.entries[first + 1] += axis.x;
                row.entries[first + 2] += axis.y;
            }
        }
        row
    }

    /// Both ends of a hinge move alike.
    fn hinge_rows(&self, ends: &[Attachment; 2], rank: u8) -> [Row; 2] {
        [Vector2::x(), Vector2::y()].map(|axis| {
            let mut row = self.row(rank);
            for (end, axis) in ends.iter().zip([axis, -axis]) {
                self.displace(&mut row, end.frame, end.position, axis);
                self.displace_out(&mut row, end.frame, (end.position, end.z), (axis, 0.0));
            }
            row
        })
    }

    fn row(&self, rank: u8) -> Row {
        Row { entries: DVector::zeros(self.accelerations()), rank }
    }

    /// The block stays on the line of the guide at a place, in the direction of a normal.
    fn normal_row(&self, slider: &Slider, (place, normal): (Vector2<f64>, Vector2<f64>), rank: u8) -> Row {
        let mut row = self.row(rank);
        self.displace(&mut row, slider.block, place, normal);
        self.displace(&mut row, slider.guide, place, -normal);
        row
    }

    /// Block and guide do not slip where they touch.
    fn sticking_row(&self, slider: &Slider) -> Row {
        let mut row = self.row(2);
        let place = slider.at - rot90(slider.tangent) * slider.rim();
        self.displace(&mut row, slider.block, place, slider.tangent);
        self.displace(&mut row, slider.guide, place, -slider.tangent);
        row
    }

    /// Block and guide turn together.
    fn rotation_row(&self, slider: &Slider) -> Row {
        let mut row = self.row(0);
        for (frame, sign) in [(slider.block, 1.0), (slider.guide, -1.0)] {
            if let Some(body) = frame.body() {
                row.entries[3 * body.index() + 2] += sign;
            }
        }
        row
    }

    /// Adds what the displacement of a frame's point in space has by its motion out of the plane.
    fn displace_out(
        &self,
        row: &mut Row,
        frame: Frame,
        (place, z): (Vector2<f64>, f64),
        (axis, along_z): (Vector2<f64>, f64),
    ) {
        let (Some((first, z_of_body)), Some(body)) = (self.out_of_plane(frame), frame.body()) else { return };
        let arm = (place - self.bodies[body.index()].centre_of_mass, z - z_of_body);
        let about = tilting(arm, (axis, along_z)) / self.size;
        row.entries[first] += along_z;
        row.entries[first + 1] += about.x;
        row.entries[first + 2] += about.y;
    }

    /// Adds the displacement of a frame's point along an axis; lengths count in sizes of the mechanism.
    fn displace(&self, row: &mut Row, frame: Frame, place: Vector2<f64>, axis: Vector2<f64>) {
        let Some(body) = frame.body() else { return };
        let (first, arm) = (3 * body.index(), place - self.bodies[body.index()].centre_of_mass);
        row.entries[first] += axis.x;
        row.entries[first + 1] += axis.y;
        row.entries[first + 2] += axis.dot(&rot90(arm)) / self.size;
    }
}

/// The rows that are combinations of others, each with the combination of all rows that vanishes: those of the
/// lowest rank, and of these the first that are independent enough, are kept (Gram and Schmidt with pivoting).
fn dependent(rows: &[Row]) -> Vec<(usize, DVector<f64>)> {
    let mut left: Vec<usize> = (0..rows.len()).collect();
    // What is left of each row, and of which rows it is made.
    let mut rest: Vec<DVector<f64>> = rows.iter().map(|row| row.entries.clone()).collect();
    let unit = |row: usize| DVector::from_fn(rows.len(), |entry, _| f64::from(u8::from(entry == row)));
    let mut made_of: Vec<DVector<f64>> = (0..rows.len()).map(unit).collect();
    for rank in 0..=2 {
        loop {
            let size = |row: usize| {
                let length = rest[row].norm();
                if length > DEPENDENT * rows[row].entries.norm() { length } else { 0.0 }
            };
            let of_rank: Vec<usize> = left.iter().copied().filter(|&row| rows[row].rank == rank).collect();
            let greatest = of_rank.iter().map(|&row| size(row)).fold(0.0, f64::max);
            let next = of_rank.iter().copied().find(|&row| size(row) >= INDEPENDENT_ENOUGH * greatest);
            let Some(next) = next.filter(|_| greatest > 0.0) else { break };
            let length = rest[next].norm();
            let [direction, combination] = [&rest[next] / length, &made_of[next] / length];
            left.retain(|&row| row != next);
            // Twice is enough (Gram and Schmidt).
            for _ in 0..2 {
                for &row in &left {
                    let part = rest[row].dot(&direction);
                    rest[row].axpy(-part, &direction, 1.0);
                    made_of[row].axpy(-part, &combination, 1.0);
                }
            }
        }
    }
    left.into_iter().map(|row| (row, made_of[row].clone())).collect()
}
