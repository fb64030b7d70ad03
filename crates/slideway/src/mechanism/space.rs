//! What a mechanism has out of the plane of its motion: places, inertia, and what keeps its bodies in the plane.
//!
//! Axes: x and y in the drawing, z out of it. A contact is a point and a normal anywhere in the cross-section of its guide, so
//! that every body has six equations. The mechanism is determinate out of the plane if its joints, read as those of a mechanism
//! in space, leave nothing but the motions in the plane.

use super::excess::{Row, rank};
use super::{Body, Joint, JointKind, Mechanism, Slider, rot90};
use crate::dense::singular_values;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, Frame, JointId};
use crate::interval::Real;
use nalgebra::{DMatrix, Vector2};

/// Parts of a motion that are smaller than this part of it are rounding.
const ROUNDING: f64 = 1e-6;

/// What a mechanism has out of the plane of its motion.
#[derive(Debug, Clone)]
pub struct Space<T = f64> {
    /// Acceleration of free fall along z (m/s^2).
    pub gravity: T,
    /// What the bodies have there, in their order.
    pub bodies: Vec<BodyInSpace<T>>,
}

/// What a body has out of the plane of motion.
#[derive(Debug, Clone, Copy)]
pub struct BodyInSpace<T = f64> {
    /// How far its centre of mass is out of the drawing (m).
    pub z: T,
    /// Products of inertia `D_x = int x z dm`, `D_y = int y z dm` about the centre of mass in the drawing (kg m^2).
    pub products: [T; 2],
    /// Moments of inertia about x and y in the drawing (kg m^2), where they are known.
    pub tilt: Option<[T; 2]>,
}

impl<T: Real> Mechanism<T> {
    /// Accelerations of each body: three in the plane, and three out of it if the model says something of that.
    pub(crate) fn accelerations(&self) -> usize {
        if self.space.is_some() { 6 * self.bodies.len() } else { 3 * self.bodies.len() }
    }

    /// The index of the acceleration of a frame along z, behind which are those of its rotations about x and y, and how far
    /// its centre of mass is out of the drawing; none in a planar model.
    pub(crate) fn out_of_plane(&self, frame: Frame) -> Option<(usize, T)> {
        let (space, body) = (self.space.as_ref()?, frame.body()?);
        Some((3 * (self.bodies.len() + body.index()), space.bodies[body.index()].z))
    }

    /// The body to which an acceleration of the bodies belongs, by its number.
    pub(crate) fn body_of_acceleration(&self, acceleration: usize) -> usize {
        acceleration / 3 % self.bodies.len()
    }

    /// Whether an acceleration of the bodies is one of rotation.
    pub(crate) fn is_rotation(&self, acceleration: usize) -> bool {
        if acceleration < 3 * self.bodies.len() {
            acceleration % 3 == 2
        } else {
            !acceleration.is_multiple_of(3)
        }
    }

    /// Takes away all weights.
    pub(crate) fn put_out_gravity(&mut self) {
        self.gravity.fill(T::zero());
        if let Some(space) = &mut self.space {
            space.gravity = T::zero();
        }
    }

    /// Whether a joint carries something out of the drawing without friction: a force along z, or a couple about one of two
    /// axes in it.
    pub(crate) fn carries(&self, joint: &Joint<T>, component: usize) -> bool {
        self.space.is_some() && joint.carries[component]
    }
}

impl Mechanism {
    /// The size of the acceleration of free fall (m/s^2).
    pub(crate) fn free_fall(&self) -> f64 {
        self.space.as_ref().map_or(self.gravity.norm(), |space| self.gravity.norm().hypot(space.gravity))
    }

    /// A body whose moments of inertia about axes in the drawing are not known in space.
    pub(crate) fn unknown_tilt(&self) -> Option<&str> {
        let space = self.space.as_ref()?;
        let known = space.bodies.iter().map(|body| body.tilt.is_some());
        self.bodies.iter().zip(known).find_map(|(body, is_known)| (!is_known).then_some(&*body.name))
    }

    /// Refuses a question about these contacts, which is answered in the plane alone.
    ///
    /// # Errors
    /// A fault at the joint of the first of them that says what is asked, if the model has something out of the plane.
    pub(crate) fn check_planar(
        &self,
        question: &'static str,
        contacts: impl IntoIterator<Item = ContactId>,
    ) -> Result<(), Faults> {
        let first = self.space.as_ref().and_then(|_| contacts.into_iter().next());
        let Some(first) = first else { return Ok(()) };
        let place = self.joints[self.contacts[first.index()].joint.index()].place.clone();
        Err(Fault::new(FaultKind::InSpace { question }, place).into())
    }

    /// Refuses joints that are not known in space, and motions out of the plane that nothing prevents.
    ///
    /// # Errors
    /// A fault for each of them.
    pub(super) fn check_in_space(&self) -> Result<(), Faults> {
        if self.space.is_none() {
            return Ok(());
        }
        let mut faults = Faults::default();
        for (index, joint) in self.joints.iter().enumerate() {
            let circle = self.friction_circle(JointId(index));
            let name = joint.name.to_string();
            if let Some(what) = self.not_in_space(joint) {
                faults.push(Fault::new(FaultKind::JointInSpace { joint: name, what }, joint.place.clone()));
            } else if circle.is_some_and(|circle| circle.end.is_none() && circle.is_rough())
                && joint.carries[1..] != [false; 2]
            {
                // Couples press its bearings, each in its own way; a force along z is carried without friction.
                faults.push(Fault::new(FaultKind::RoughAndTilted { joint: name }, joint.place.clone()));
            }
        }
        faults.or(())?;
        if let Some(fault) = self.not_carried().or_else(|| self.tilts_without_inertia()) {
            return Err(fault.into());
        }
        Ok(())
    }

    /// A body that turns out of the drawing once contacts lift off, and whose moments of inertia for that are not known.
    fn tilts_without_inertia(&self) -> Option<Fault> {
        let (space, open) = (self.space.as_ref()?, self.one_sided().collect::<Vec<_>>());
        if open.is_empty() || space.bodies.iter().all(|body| body.tilt.is_some()) {
            return None;
        }
        let indices: Vec<usize> = open.iter().map(|contact| contact.index()).collect();
        let left = self.without_contacts(&indices);
        let rows: Vec<Row> = left.reaction_rows().into_iter().map(|(row, _)| row).collect();
        let motions = out_of_plane_motions(&rows, self.bodies.len());
        let tilts = |body: &usize| motions.rows(3 * body + 1, 2).amax() > ROUNDING;
        let body = (0..self.bodies.len()).find(|body| space.bodies[*body].tilt.is_none() && tilts(body))?;
        let Body { name, place, .. } = &self.bodies[body];
        let contacts = indices.iter().map(|&k| self.contacts[k].name.to_string()).collect();
        Some(Fault::new(FaultKind::UnknownTilt { body: name.to_string(), contacts }, place.clone()))
    }

    /// Refuses joints that carry more out of the plane without friction than is determined, as in a closed loop.
    ///
    /// # Errors
    /// A fault that names the joints.
    pub(crate) fn check_carried_once(&self) -> Result<(), Faults> {
        let carry = |joint: &&Joint| (0..3).any(|component| self.carries(joint, component));
        let joints: Vec<&Joint> = self.joints.iter().filter(carry).collect();
        let (Some(first), excess @ 1..) = (joints.first(), self.excess.of_hinges) else { return Ok(()) };
        let names = joints.iter().map(|joint| joint.name.to_string()).collect();
        Err(Fault::new(FaultKind::CarriedTwice { joints: names, excess }, first.place.clone()).into())
    }

    /// What of a joint is not known in space, if something is not.
    fn not_in_space(&self, joint: &Joint) -> Option<&'static str> {
        match &joint.kind {
            JointKind::Hinge(ends) => {
                (ends[0].z != ends[1].z).then_some("a hinge between points at different heights")
            }
            JointKind::Slider(slider) => self.slider_not_in_space(slider),
        }
    }

    fn slider_not_in_space(&self, slider: &Slider) -> Option<&'static str> {
        let contacts = || slider.contacts.iter().map(|contact| &self.contacts[contact.index()]);
        let leans = contacts().any(|contact| contact.lean.is_some());
        [
            (slider.is_disc() || slider.round.is_some(), "a disc"),
            (slider.loose, "a loose guide"),
            (!slider.apart.is_empty(), "a contact that is apart from its face"),
            (contacts().any(|contact| contact.face.is_some()), "a press fit"),
            (
                leans && contacts().any(|contact| contact.misalignment_law.is_some()),
                "a misalignment that varies",
            ),
        ]
        .into_iter()
        .find_map(|(is_there, what)| is_there.then_some(what))
    }

    /// The motion out of the plane that no joint prevents in the drawing, if there is one:
    /// `3 b + rank(G in the plane) > rank(G)`.
    fn not_carried(&self) -> Option<Fault> {
        let bodies = self.bodies.len();
        let rows: Vec<Row> = self.reaction_rows().into_iter().map(|(row, _)| row).collect();
        let in_plane: Vec<Row> = rows.iter().map(|row| row.within(3 * bodies)).collect();
        if 3 * bodies + rank(&in_plane) <= rank(&rows) {
            return None;
        }
        let motions = out_of_plane_motions(&rows, bodies);
        let of_body = |body: usize| motions.rows(3 * body, 3);
        let greatest = (0..bodies).map(|body| of_body(body).norm()).fold(0.0, f64::max);
        let body = (0..bodies).find(|body| of_body(*body).norm() >= 0.5 * greatest)?;
        let motion = self.motion_in_words(Frame::Body(crate::ids::BodyId(body)), &of_body(body).into_owned());
        let Body { name, place, .. } = &self.bodies[body];
        Some(Fault::new(FaultKind::NotCarried { body: name.to_string(), motion }, place.clone()))
    }

    /// Says what a body can do, from motions along z and about x and y, one in each column.
    fn motion_in_words(&self, frame: Frame, motions: &DMatrix<f64>) -> String {
        let found = singular_values(motions, [true, false]).filter(|found| {
            let values = &found.singular_values;
            values.iter().filter(|value| **value > ROUNDING * values.amax()).count() == 1
        });
        let greatest =
            found.and_then(|found| Some(found.u?.column(found.singular_values.imax()).into_owned()));
        let Some(motion) = greatest else { return "moving out of the drawing".to_owned() };
        let axis = Vector2::new(motion[1], motion[2]);
        if axis.norm() < ROUNDING {
            return "moving along z, out of the drawing".to_owned();
        }
        let axis = axis.normalize();
        let about = self.joints.iter().find_map(|joint| {
            let JointKind::Slider(slider) = &joint.kind else { return None };
            let is_near = |direction: Vector2<f64>| axis.perp(&direction).abs() < ROUNDING;
            if slider.block != frame && slider.guide != frame {
                None
            } else if is_near(slider.tangent) && self.is_on_rod(slider) {
                Some(format!("turning about the rod of {}", joint.name))
            } else if is_near(slider.tangent) {
                Some(format!("rolling about the direction of {}", joint.name))
            } else if is_near(rot90(slider.tangent)) {
                Some(format!("pitching on {}", joint.name))
            } else {
                None
            }
        });
        let angle = axis.y.atan2(axis.x).to_degrees();
        about
            .unwrap_or_else(|| format!("turning about a line in the drawing, {angle:.0} deg from the x axis"))
    }
}

/// The motions out of the plane that these rows allow, a column for each: along z and about x and y of every body.
fn out_of_plane_motions(rows: &[Row], bodies: usize) -> DMatrix<f64> {
    let columns = 6 * bodies;
    let mut matrix = DMatrix::zeros(rows.len().max(columns), columns);
    for (at, row) in rows.iter().enumerate() {
        matrix.row_mut(at).tr_copy_from(row.entries());
    }
    let nothing = DMatrix::zeros(3 * bodies, 1);
    let Some(found) = singular_values(&matrix, [false, true]) else { return nothing };
    let Some(directions) = found.v_t else { return nothing };
    let greatest = found.singular_values.amax();
    let free: Vec<_> = (0..columns)
        .filter(|&place| found.singular_values[place] <= ROUNDING * greatest)
        .map(|place| directions.row(place).transpose().rows(3 * bodies, 3 * bodies).into_owned())
        .collect();
    if free.is_empty() { nothing } else { DMatrix::from_columns(&free) }
}
