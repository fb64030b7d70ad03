//! How normal forces, sliding accelerations and couples respond to friction, and which joints act on one
//! another.

use super::joints::SlidingJoint;
use crate::influence::Influence;
use crate::mechanism::Mechanism;
use crate::model::SliderKind;
use crate::motion::moving::connected::join;
use crate::solve::{NO_INFLUENCE, SAME_COLUMN};
use nalgebra::{DMatrix, DVector};

/// Sliding joints that act on one another; friction of other joints has no influence on them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Group {
    /// The joints.
    pub(super) joints: Vec<usize>,
    /// Their contacts.
    pub(super) contacts: Vec<usize>,
}

/// The outputs on which decisions are based, as functions of the friction forces: normal forces of the
/// contacts, accelerations of the sliding joints, couples of the guided sliders, in units.
#[derive(Debug, Clone)]
pub(super) struct Outputs {
    /// Without friction.
    pub(super) base: DVector<f64>,
    /// The change caused by one unit of friction at the face of positive and at the face of negative normal
    /// force; one column for each contact.
    pub(super) columns: [DMatrix<f64>; 2],
}

/// The sliding joints in groups without influence on one another.
pub(super) fn groups(joints: &[SlidingJoint], outputs: &Outputs) -> Vec<Group> {
    let mut parts: Vec<usize> = (0..joints.len()).collect();
    let contacts = outputs.columns[0].ncols();
    let mut couples = contacts + joints.len()..;
    for (index, joint) in joints.iter().enumerate() {
        let couple = joint.couple.and_then(|_| couples.next());
        let rows: Vec<usize> =
            joint.contacts.iter().copied().chain([contacts + index]).chain(couple).collect();
        for (other, rubbing) in joints.iter().enumerate() {
            let acts = |k: &usize| {
                outputs.columns.iter().any(|column| rows.iter().any(|row| column[(*row, *k)] != 0.0))
            };
            if parts[index] != parts[other] && rubbing.contacts.iter().any(acts) {
                join(&mut parts, index, other);
            }
        }
    }
    let mut groups: Vec<Group> = Vec::new();
    let mut place = vec![None; joints.len()];
    for (index, joint) in joints.iter().enumerate() {
        let group = *place[parts[index]].get_or_insert_with(|| {
            groups.push(Group { joints: Vec::new(), contacts: Vec::new() });
            groups.len() - 1
        });
        groups[group].joints.push(index);
        groups[group].contacts.extend(&joint.contacts);
    }
    groups
}

pub(super) fn outputs(mechanism: &Mechanism, influence: &Influence, joints: &[SlidingJoint]) -> Outputs {
    let contacts = mechanism.contacts.len();
    let couples: Vec<(usize, f64)> = joints
        .iter()
        .filter_map(|joint| {
            joint.couple.map(|couple| (couple.unknown, joint.units.force * joint.units.length))
        })
        .collect();
    let mut force = vec![1.0; contacts];
    for joint in joints {
        joint.contacts.iter().for_each(|&k| force[k] = joint.units.force);
    }
    let rows = contacts + joints.len() + couples.len();
    let unit = |row: usize| match row.checked_sub(contacts) {
        None => force[row],
        Some(joint) if joint < joints.len() => joints[joint].units.acceleration,
        Some(other) => couples[other - joints.len()].1,
    };
    let of = |unknowns: &DVector<f64>, normals: &DVector<f64>, row: usize| match row.checked_sub(contacts) {
        None => normals[row],
        Some(joint) if joint < joints.len() => joints[joint].row.change(unknowns),
        Some(other) => unknowns[couples[other - joints.len()].0],
    };
    let normals = influence.normal_forces();
    let base = DVector::from_fn(rows, |row, _| {
        let value = match row.checked_sub(contacts) {
            Some(joint) if joint < joints.len() => joints[joint].row.acceleration(&influence.frictionless),
            _ => of(&influence.frictionless, &normals, row),
        };
        value / unit(row)
    });
    let mut columns = [0, 1].map(|side| {
        let mut columns = DMatrix::zeros(rows, contacts);
        for (k, column) in influence.columns.iter().enumerate() {
            let normals = influence.normal_part(&column[side]);
            for row in 0..rows {
                let value = of(&column[side], &normals, row) * (force[k] / unit(row));
                columns[(row, k)] = if value.abs() <= NO_INFLUENCE { 0.0 } else { value };
            }
        }
        columns
    });
    make_equal(mechanism, &mut columns);
    Outputs { base, columns }
}

/// Makes both versions of a column equal where they are equal in theory: for guided sliders, whose couple
/// takes up the moment of friction, and wherever that moment has no influence.
fn make_equal(mechanism: &Mechanism, columns: &mut [DMatrix<f64>; 2]) {
    let [positive, negative] = columns;
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        let guided = mechanism.slider(contact.joint).is_some_and(|slider| slider.kind == SliderKind::Guided);
        let contacts = mechanism.contacts.len();
        let [plus, minus] = [&*positive, &*negative].map(|matrix| matrix.column(k).into_owned());
        let all = (&plus - &minus).amax() <= SAME_COLUMN * plus.amax();
        for row in 0..plus.len() {
            if all || (guided && row < contacts) {
                negative[(row, k)] = positive[(row, k)];
            }
        }
    }
}
