//! Contacts that may lift off and reach their faces along a motion.

use super::run::Run;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::motion::decision::{Landing, landing};
use crate::motion::moving::cause::Cause;
use crate::motion::moving::equations::Equations;

impl Run<'_, '_> {
    /// Returns whether a contact reaches the line of its face beyond its ends.
    pub(super) fn is_beside(&self, contact: ContactId) -> bool {
        let equations = &self.smooth.equations;
        let contact = &equations.mechanism.contacts[contact.index()];
        let slider = equations.mechanism.slider(contact.joint);
        let Equations { configuration, mechanism, .. } = equations;
        slider.is_some_and(|slider| configuration.is_beside_face(mechanism, slider, contact))
    }

    /// The impact of contacts on their faces, if the causes tell of one.
    ///
    /// # Errors
    /// As [`landing`].
    pub(super) fn land(&mut self, causes: &mut Vec<Cause>) -> Result<bool, Faults> {
        let of = |cause: &Cause| match cause {
            Cause::Touches(contact) => Some(*contact),
            _ => None,
        };
        let contacts: Vec<ContactId> = causes.iter().filter_map(of).collect();
        let (Some(phase), false) = (self.phase.clone(), contacts.is_empty()) else { return Ok(false) };
        self.smooth.put_on_face(&phase, &contacts);
        self.smooth.equations.place(self.smooth.time, &self.smooth.state);
        let configuration = self.smooth.equations.configuration.clone();
        let mechanism = self.smooth.equations.mechanism;
        let Landing { after, energy_lost } =
            landing(mechanism, &configuration, self.options.impacts, self.work)?;
        self.smooth.set_velocities(&after.velocities);
        self.note_impulse(energy_lost);
        causes.retain(|cause| !matches!(cause, Cause::Touches(_) | Cause::Stops(_)));
        for (index, contact) in contacts.into_iter().enumerate() {
            let speed = -configuration.gap(mechanism, contact)[1];
            let energy_lost = (index == 0).then_some(energy_lost);
            causes.push(Cause::Lands { contact, speed, energy_lost });
        }
        Ok(true)
    }
}
