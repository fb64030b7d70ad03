//! Contacts that may lift off and reach their faces along a motion, and sliding joints that reach their end stops.

use super::run::{Run, stop_at};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::mechanism::{EndStop, Mechanism};
use crate::motion::decision::{FaceBlow, Landing, landing};
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

    /// The impact of contacts on their faces and of sliding joints on their stops, if the causes tell of one.
    ///
    /// # Errors
    /// As [`landing`].
    pub(super) fn land(&mut self, causes: &mut Vec<Cause>) -> Result<bool, Faults> {
        let mechanism = self.smooth.equations.mechanism;
        let touching = |cause: &Cause| match cause {
            Cause::Touches(contact) => Some(*contact),
            _ => None,
        };
        let stop = |cause: &Cause| match *cause {
            Cause::TravelLimit { joint, greatest } => Some(EndStop { joint, greatest }),
            _ => None,
        };
        let contacts: Vec<ContactId> = causes.iter().filter_map(touching).collect();
        let stops: Vec<EndStop> = causes.iter().filter_map(stop).collect();
        let (Some(phase), false) = (self.phase.clone(), contacts.is_empty() && stops.is_empty()) else {
            return Ok(false);
        };
        if !contacts.is_empty() {
            self.smooth.put_on_face(&phase, &contacts);
        }
        for stop in &stops {
            let displacement = stop_at(mechanism, *stop);
            displacement.into_iter().for_each(|place| self.smooth.put_at(&phase, stop.joint, place));
        }
        self.smooth.equations.place(self.smooth.time, &self.smooth.state);
        let before = self.smooth.equations.configuration.clone();
        let (whole, ends) = mechanism.with_faces_of_stops();
        let Landing { after, blows } =
            landing((&whole, mechanism.contacts.len()), &before, self.options.impacts, self.work)?;
        self.smooth.set_velocities(&after.velocities);
        causes.retain(|cause| {
            !matches!(
                cause,
                Cause::Touches(_) | Cause::TravelLimit { .. } | Cause::Stops(_) | Cause::StopsTurning(_)
            )
        });
        let told = Told { mechanism, before: &before, after: &after };
        for blow in &blows {
            self.note_impulse(blow.energy_lost);
            causes.extend(told.causes(blow, &ends));
        }
        let others = contacts.into_iter().map(|contact| told.lands(contact, None));
        let others = others.chain(stops.into_iter().map(|stop| told.hits(stop, Some(0.0))));
        let missing: Vec<Cause> =
            others.filter(|cause| !causes.iter().any(|told| is_same(told, cause))).collect();
        causes.extend(missing);
        Ok(true)
    }
}

/// Returns whether two causes tell of one contact or stop.
fn is_same(one: &Cause, other: &Cause) -> bool {
    match (one, other) {
        (Cause::Lands { contact: one, .. }, Cause::Lands { contact: other, .. }) => one == other,
        (Cause::Hits { joint: one, .. }, Cause::Hits { joint: other, .. }) => one == other,
        _ => false,
    }
}

/// What is told of an impact.
struct Told<'t> {
    mechanism: &'t Mechanism,
    before: &'t Configuration,
    after: &'t Configuration,
}

impl Told<'_> {
    /// The causes of a blow, the first with the energy that all lose.
    fn causes(&self, blow: &FaceBlow, stops: &[EndStop]) -> Vec<Cause> {
        let own = self.mechanism.contacts.len();
        let one = |(index, (contact, _)): (usize, &(ContactId, f64))| {
            let energy_lost = (index == 0).then_some(blow.energy_lost);
            match contact.index().checked_sub(own) {
                None => self.lands(*contact, energy_lost),
                Some(stop) => self.hits(stops[stop], energy_lost),
            }
        };
        blow.contacts.iter().enumerate().map(one).collect()
    }

    fn lands(&self, contact: ContactId, energy_lost: Option<f64>) -> Cause {
        Cause::Lands { contact, speed: -self.before.gap(self.mechanism, contact)[1], energy_lost }
    }

    fn hits(&self, EndStop { joint, greatest }: EndStop, energy_lost: Option<f64>) -> Cause {
        let speeds = [self.before, self.after].map(|at| self.speed(joint, at));
        Cause::Hits { joint, greatest, speeds, energy_lost }
    }

    fn speed(&self, joint: JointId, at: &Configuration) -> f64 {
        let slider = self.mechanism.slider(joint);
        slider.map_or(0.0, |slider| at.sliding(self.mechanism, slider).1.abs())
    }
}
