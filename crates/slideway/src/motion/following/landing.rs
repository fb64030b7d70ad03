//! Contacts that may lift off and reach their faces along a motion.

use super::run::Run;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::motion::decision::{Landing, landing};
use crate::motion::moving::cause::Cause;

/// Within this part of the size of the mechanism beyond its end a contact still meets its face: what the drawing puts at the end is
/// off by rounding.
const ON_END: f64 = 1e-9;

impl Run<'_, '_> {
    /// Returns whether a contact reaches the line of its face beyond its ends.
    pub(super) fn is_beside(&self, contact: ContactId) -> bool {
        let equations = &self.smooth.equations;
        let slider = equations.mechanism.slider(equations.mechanism.contacts[contact.index()].joint);
        let room = |end| slider.map_or(0.0, |slider| equations.room_on_face(slider, contact, end));
        room(-1.0).min(room(1.0)) < -ON_END * equations.mechanism.size
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
        let Landing { after, energy_lost } = landing(mechanism, &configuration, self.options.impacts, self.work)?;
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
