//! Self-stresses of redundant guides from statics alone, so that no motion needs inertia.

use super::{Assembled, INCONSISTENT, Reaction};
use crate::dense::singular_values;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::ContactId;
use crate::mechanism::Mechanism;
use nalgebra::DMatrix;

impl Assembled<f64> {
    /// The normal forces of the self-stresses: a row for each contact, a column for each cut one, whose own normal
    /// force is 1 there and that of the other cut contacts 0.
    ///
    /// ```text
    /// G^T lambda = 0
    /// ```
    ///
    /// # Errors
    /// The position is singular: a cut contact has no self-stress here.
    pub(crate) fn self_stresses(&self, mechanism: &Mechanism) -> Result<DMatrix<f64>, Faults> {
        let bodies = self.layout.accelerations;
        let place =
            |contact: ContactId| self.layout.reaction(Reaction::Normal(contact)).map(|at| at - bodies);
        let cut: Vec<usize> = self.layout.cut.iter().filter_map(|contact| place(*contact)).collect();
        // Moments count in forces times the size of the mechanism.
        let mut balance = self.matrix.view((0, bodies), (bodies, self.layout.reactions.len())).into_owned();
        let rotations = (0..bodies).filter(|row| self.layout.is_rotation(*row));
        rotations.for_each(|row| balance.row_mut(row).scale_mut(1.0 / mechanism.size));
        let kept: Vec<usize> = (0..balance.ncols()).filter(|column| !cut.contains(column)).collect();
        let of_kept = balance.select_columns(&kept);
        let of_cut = balance.select_columns(&cut);
        let greatest = of_kept.amax();
        let found = singular_values(&of_kept, [true; 2]);
        let answer = found.and_then(|found| found.solve(&-&of_cut, f64::EPSILON * greatest).ok());
        let answer = answer.unwrap_or_else(|| DMatrix::zeros(kept.len(), cut.len()));
        let left = &of_kept * &answer + &of_cut;
        let lost = self.layout.cut.iter().zip(left.column_iter().zip(of_cut.column_iter()));
        let lost: Vec<ContactId> = lost
            .filter(|(_, (left, own))| left.amax() > INCONSISTENT * own.amax())
            .map(|(contact, _)| *contact)
            .collect();
        if !lost.is_empty() {
            return Err(singular_position(mechanism, &lost));
        }
        let force = |k: usize, stress: usize| {
            let at = place(ContactId(k))?;
            if at == cut[stress] {
                return Some(1.0);
            }
            kept.iter().position(|column| *column == at).map(|row| answer[(row, stress)])
        };
        Ok(DMatrix::from_fn(mechanism.contacts.len(), cut.len(), |k, stress| force(k, stress).unwrap_or(0.0)))
    }
}

/// The fault of contacts whose excess does not persist.
pub(super) fn singular_position(mechanism: &Mechanism, contacts: &[ContactId]) -> Faults {
    let joint = |contact: &ContactId| &mechanism.joints[mechanism.contacts[contact.index()].joint.index()];
    let joints = contacts.iter().map(|contact| joint(contact).name.to_string()).collect();
    let kind = FaultKind::SingularPosition { lost: contacts.len(), joints };
    let place = contacts.first().map(|contact| joint(contact).place.clone());
    match place {
        Some(place) => Fault::new(kind, place).into(),
        None => Fault::general(kind).into(),
    }
}
