//! What is zero at an event is exactly zero.

use super::assessment::{Assessment, assess};
use super::instant::Instant;
use super::rules;
use super::sticking::ENOUGH;
use crate::pattern::{ContactPhase, JointPhase, Phase};
use nalgebra::DVector;

/// What may be left of a normal force, in units, or of a share, that an event has found to be zero; more is
/// left only if the value has no bounds.
const NEARLY_ZERO: f64 = 1e-4;

/// Sets to exactly zero in the previous phase what the event has found to be zero.
pub(super) fn vanish(instant: &mut Instant<'_>, event: &rules::EventInstant<'_>, previous: &Phase) {
    if event.zero.is_empty() {
        return;
    }
    let stopped = vec![false; instant.rubbing()];
    let before = assess(instant, &instant.question(&stopped, Some(previous)), previous, ENOUGH);
    if let Ok(Some(before)) = before {
        let contacts: Vec<usize> = event.zero.iter().map(|contact| contact.index()).collect();
        instant.vanish(&contacts, &before);
    }
}

impl Instant<'_> {
    /// Sets normal forces, or what is left of preload gaps, to exactly zero in a state: its equations hold
    /// again with loads changed by no more than this remainder, and so do those of its neighbours, in which
    /// the contacts press on the other side.
    fn vanish(&mut self, contacts: &[usize], state: &Assessment) {
        let mut shift = DVector::zeros(self.outputs.base.len());
        for &k in contacts {
            let Some(JointPhase::Sliding(sign)) = self.joint_of(k).map(|joint| state.phase.joints[joint])
            else {
                continue;
            };
            let law = self.law(k, true);
            let mut add = |amount: f64, faces: [[f64; 2]; 2]| {
                for (column, [factor, _]) in self.outputs.columns.iter().zip(faces) {
                    shift.axpy(amount * factor, &column.column(k), 1.0);
                }
            };
            match (state.phase.contacts[k], state.forces.shares[k]) {
                (ContactPhase::Pressed(side), _) if state.forces.normal[k].abs() <= NEARLY_ZERO => {
                    add(side.sign() * state.forces.normal[k], law.kinetic(side, sign));
                    shift[k] -= state.forces.normal[k];
                }
                (ContactPhase::PreloadGap, Some(share)) if (share - share.round()).abs() <= NEARLY_ZERO => {
                    add(share - share.round(), law.in_gap(sign));
                }
                _ => {}
            }
        }
        self.change_base(&shift);
    }
}
