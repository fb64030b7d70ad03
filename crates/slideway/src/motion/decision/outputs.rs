//! How normal forces, accelerations, also of gaps, couples and the forces of hinges respond to friction, and which joints act on
//! one another.

use super::joints::{RoughHinge, SlidingJoint};
use crate::influence::Influence;
use crate::kinetics::SlidingRow;
use crate::mechanism::Mechanism;
use crate::model::SliderKind;
use crate::motion::moving::connected::join;
use crate::pattern::{JointPhase, Phase};
use crate::problem::{NO_INFLUENCE, SAME_COLUMN};
use nalgebra::{DMatrix, DVector, DVectorView};

/// Sliding joints and hinges with friction that act on one another; friction elsewhere has no influence on them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Group {
    /// The joints.
    pub(super) joints: Vec<usize>,
    /// Their contacts.
    pub(super) contacts: Vec<usize>,
    /// The hinges with friction.
    pub(super) hinges: Vec<usize>,
}

impl Group {
    /// Whether hinges of it turn with friction.
    pub(super) fn turns(&self, phase: &Phase) -> bool {
        self.hinges.iter().any(|hinge| phase.hinges[*hinge].state != JointPhase::Sticking)
    }

    /// Its members, by their numbers among the sliding joints, of which there are so many, and hinges.
    pub(super) fn members(&self, joints: usize) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().copied().chain(self.hinges.iter().map(move |hinge| joints + hinge))
    }
}

/// The outputs on which decisions are based, as functions of the friction forces and of the friction couples of
/// hinges: normal forces of the contacts, accelerations of the sliding joints, couples of the guided sliders, accelerations
/// of the gaps of the joints that are zero, then of each hinge with friction its angular acceleration and its force, in units.
#[derive(Debug, Clone)]
pub(super) struct Outputs {
    /// Without friction.
    pub(super) base: DVector<f64>,
    /// The change caused by one unit of friction at the face of positive and at the face of negative normal
    /// force; one column for each contact.
    pub(super) columns: [DMatrix<f64>; 2],
    /// The change caused by one unit of the friction couple of each hinge.
    pub(super) couples: DMatrix<f64>,
}

/// What has friction: the sliding joints, their contacts and the hinges with friction.
#[derive(Clone, Copy)]
pub(super) struct Rubbing<'r> {
    pub(super) contacts: usize,
    pub(super) joints: &'r [SlidingJoint],
    pub(super) hinges: &'r [RoughHinge],
}

/// One of the outputs.
enum Output<'r> {
    Normal(usize),
    /// The acceleration of sliding, or of a gap.
    Slide(&'r SlidingRow),
    /// The couple of a guided slider, by its place among the unknowns.
    Couple(usize),
    Turn(&'r RoughHinge),
    /// A component of the force of a hinge, by its place among the unknowns.
    Force(usize),
}

impl<'r> Rubbing<'r> {
    /// The units of the force of each contact (N).
    fn units_of_contacts(self) -> Vec<f64> {
        let mut force = vec![1.0; self.contacts];
        for joint in self.joints {
            joint.contacts.iter().for_each(|&k| force[k] = joint.units.force);
        }
        force
    }

    /// The outputs in order, with their units.
    fn outputs(self) -> Vec<(Output<'r>, f64)> {
        let normals = self.units_of_contacts().into_iter().enumerate();
        let normals = normals.map(|(k, unit)| (Output::Normal(k), unit));
        let slides = self.joints.iter().map(|joint| (Output::Slide(&joint.row), joint.units.acceleration));
        let gaps = self.joints.iter().flat_map(|joint| {
            joint.gaps.iter().map(|(_, row)| (Output::Slide(row), joint.units.acceleration))
        });
        let couples = self.joints.iter().filter_map(|joint| {
            Some((Output::Couple(joint.couple?.unknown), joint.units.force * joint.units.length))
        });
        let of_hinge = |hinge: &'r RoughHinge| {
            let [x, y] = hinge.force.map(|place| (Output::Force(place), hinge.units.force));
            [(Output::Turn(hinge), hinge.units.acceleration / hinge.units.length), x, y]
        };
        let hinges = self.hinges.iter().flat_map(of_hinge);
        normals.chain(slides).chain(couples).chain(gaps).chain(hinges).collect()
    }

    /// The outputs for changes of all unknowns.
    pub(super) fn response(self, influence: &Influence, unknowns: &DVector<f64>) -> DVector<f64> {
        let normals = influence.normal_part(unknowns);
        let outputs =
            self.outputs().into_iter().map(|(output, unit)| output.change(unknowns, &normals) / unit);
        DVector::from_vec(outputs.collect())
    }
}

impl Output<'_> {
    fn change(&self, unknowns: &DVector<f64>, normals: &DVector<f64>) -> f64 {
        match self {
            Self::Normal(k) => normals[*k],
            Self::Slide(row) => row.change(unknowns),
            Self::Couple(place) | Self::Force(place) => unknowns[*place],
            Self::Turn(hinge) => hinge.acceleration(unknowns),
        }
    }
}

/// The sliding joints and hinges with friction in groups without influence on one another.
pub(super) fn groups(rubbing: Rubbing<'_>, outputs: &Outputs) -> Vec<Group> {
    let Rubbing { contacts, joints, hinges } = rubbing;
    let all = joints.len() + hinges.len();
    let mut parts: Vec<usize> = (0..all).collect();
    let mut couples = contacts + joints.len()..;
    let guided = joints.iter().filter(|joint| joint.couple.is_some()).count();
    let mut gaps = contacts + joints.len() + guided..;
    let first = outputs.base.len() - 3 * hinges.len();
    let of_joints = joints.iter().enumerate().map(|(index, joint)| {
        let couple = joint.couple.and_then(|_| couples.next());
        let gaps = gaps.by_ref().take(joint.gaps.len());
        joint.contacts.iter().copied().chain([contacts + index]).chain(couple).chain(gaps).collect()
    });
    let of_hinges = (0..hinges.len()).map(|hinge| (first + 3 * hinge..first + 3 * hinge + 3).collect());
    let rows: Vec<Vec<usize>> = of_joints.chain(of_hinges).collect();
    for (index, rows) in rows.iter().enumerate() {
        for other in 0..all {
            let acts = |column: DVectorView<'_, f64>| rows.iter().any(|row| column[*row] != 0.0);
            let acts = || match joints.get(other) {
                Some(joint) => {
                    let mut rubbing = joint.contacts.iter();
                    rubbing.any(|k| outputs.columns.iter().any(|columns| acts(columns.column(*k))))
                }
                None => acts(outputs.couples.column(other - joints.len())),
            };
            if parts[index] != parts[other] && acts() {
                join(&mut parts, index, other);
            }
        }
    }
    let mut groups: Vec<Group> = Vec::new();
    let mut place = vec![None; all];
    for index in 0..all {
        let group = *place[parts[index]].get_or_insert_with(|| {
            groups.push(Group { joints: Vec::new(), contacts: Vec::new(), hinges: Vec::new() });
            groups.len() - 1
        });
        match joints.get(index) {
            Some(joint) => {
                groups[group].joints.push(index);
                groups[group].contacts.extend(&joint.contacts);
            }
            None => groups[group].hinges.push(index - joints.len()),
        }
    }
    groups
}

pub(super) fn outputs(mechanism: &Mechanism, influence: &Influence, rubbing: Rubbing<'_>) -> Outputs {
    let rows = rubbing.outputs();
    let without_influence = |value: f64| if value.abs() <= NO_INFLUENCE { 0.0 } else { value };
    let changes = |unknowns: &[&DVector<f64>], forces: &[f64]| {
        let mut columns = DMatrix::zeros(rows.len(), forces.len());
        for (k, (unknowns, force)) in unknowns.iter().zip(forces).enumerate() {
            let normals = influence.normal_part(unknowns);
            for (row, (output, unit)) in rows.iter().enumerate() {
                columns[(row, k)] = without_influence(output.change(unknowns, &normals) * (force / unit));
            }
        }
        columns
    };
    let normals = influence.normal_forces();
    let without_friction = |(output, unit): &(Output<'_>, f64)| match output {
        Output::Slide(row) => row.acceleration(&influence.frictionless) / unit,
        _ => output.change(&influence.frictionless, &normals) / unit,
    };
    let base = DVector::from_iterator(rows.len(), rows.iter().map(without_friction));
    let forces = rubbing.units_of_contacts();
    let mut columns = [0, 1].map(|side| {
        let unknowns: Vec<&DVector<f64>> = influence.columns.iter().map(|column| &column[side]).collect();
        changes(&unknowns, &forces)
    });
    make_equal(mechanism, &mut columns);
    let unit = |hinge: &RoughHinge| hinge.units.force * hinge.units.length;
    let forces: Vec<f64> = rubbing.hinges.iter().map(unit).collect();
    let couples = changes(&influence.couples.iter().collect::<Vec<_>>(), &forces);
    Outputs { base, columns, couples }
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
