//! How much friction is left to what sticks, where the equations determine its forces.

use super::hinges::norm;
use super::{Equations, Sticks};
use crate::ids::JointId;
use crate::pattern::{JointPhase, Phase};

impl Equations<'_> {
    /// By how much what sticks does so (N m), where the equations determine its forces; nothing where they leave some open, or
    /// friction acts at a face beside the line of the force that holds a joint. It is the least of `r_static |R| - |M|` of the
    /// hinges, and, times the size of the mechanism, of `N_k` and `sum_k mu_static_k N_k - |T|` of the joints that may lift off:
    /// all of their contacts rub along one line.
    pub(in crate::motion) fn room_of_sticking(&self, phase: &Phase) -> Option<f64> {
        let mut least = f64::INFINITY;
        let sliders = self.sliders.iter().zip(&phase.joints);
        for (joint, _) in sliders.filter(|(_, state)| **state == JointPhase::Sticking) {
            least = least.min(self.room_of_slider(*joint)? * self.mechanism.size);
        }
        for (index, circle) in self.mechanism.friction_circles.iter().enumerate() {
            if phase.hinges[index].state == JointPhase::Sticking {
                let room =
                    circle.static_radius * norm(self.hinge_force(index)?) - self.hinge_couple(index)?.abs();
                least = least.min(room);
            }
        }
        Some(least)
    }

    fn room_of_slider(&self, joint: JointId) -> Option<f64> {
        let slider = self.mechanism.slider(joint)?;
        let stuck = self.stuck.iter().position(|stuck| stuck.what == Sticks::Slider(joint))?;
        let held = self.unknowns[self.layout.len() + stuck].abs();
        let (mut least, mut friction) = (f64::INFINITY, 0.0);
        for contact in slider.contacts.iter().map(|contact| contact.index()).filter(|&k| !self.is_open(k)) {
            let law = &self.mechanism.contacts[contact];
            if !law.opens {
                return None;
            }
            let force = self.normal_force(contact);
            least = least.min(force);
            friction += law.mu_static[0] * force;
        }
        Some(least.min(friction - held))
    }
}
