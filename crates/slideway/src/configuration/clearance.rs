//! Poses of a mechanism with play in its sliding joints: each block lies on the faces that its contacts
//! touch.

use super::{Configuration, Factors, JointEquations, Pose, advance};
use crate::ids::JointId;
use crate::mechanism::{JointKind, Mechanism, Slider};
use crate::model::{CarriedBy, SliderKind};
use nalgebra::DVector;

/// Newton steps; the equations are nearly linear in small displacements.
const STEPS: usize = 4;

impl Configuration {
    /// This state with each contact displaced by the given distance (m) along its normal n from the centre
    /// line of its guide: the poses that a mechanism with play takes. Chosen coordinates keep their values.
    ///
    /// With the displacements `d` of front and rear contact a block turns by `(d_front - d_rear)/overlap`
    /// against its guide. The positions satisfy hinges and displacements to second order at least; velocities
    /// are left as they are. None if the state is singular, so that no such poses follow.
    ///
    /// ```
    /// use slideway::{configuration::Configuration, mechanism::Mechanism, model::Model};
    ///
    /// let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
    /// let mechanism = Mechanism::new(&Model::parse(text)?)?;
    /// let state = Configuration::new(&mechanism)?;
    /// // The lower block, 0.2 m long, with its front end down by 10 mm and its rear end up by 10 mm.
    /// let tipped = state.displaced(&mechanism, &[0.0, -0.01, 0.01]).expect("a regular state");
    /// assert!((tipped.poses[1].angle() + 0.1).abs() < 1e-9);
    /// # Ok::<(), slideway::fault::Faults>(())
    /// ```
    pub fn displaced(&self, mechanism: &Mechanism, displacements: &[f64]) -> Option<Self> {
        let mut poses = self.poses.clone();
        let wanted = self.wanted(mechanism, displacements);
        for _ in 0..STEPS {
            let equations = JointEquations::with_coordinates(mechanism, &poses, &self.coordinates);
            if wanted.len() != equations.residual.len() || !equations.jacobian.is_square() {
                return None;
            }
            let step = Factors::of(&equations.jacobian).solution(&(&wanted - &equations.residual))?;
            advance(mechanism, &mut poses, &step);
        }
        let is_finite =
            |pose: &Pose| pose.position.iter().all(|part| part.is_finite()) && pose.angle.is_finite();
        poses.iter().all(is_finite).then(|| Self { poses, ..self.clone() })
    }

    /// Residuals of the joint equations with these displacements: two rows for a hinge, those of each slider,
    /// one for each coordinate.
    fn wanted(&self, mechanism: &Mechanism, displacements: &[f64]) -> DVector<f64> {
        let mut rows = Vec::new();
        for (index, joint) in mechanism.joints.iter().enumerate() {
            match &joint.kind {
                JointKind::Hinge(_) => rows.extend([0.0; 2]),
                JointKind::Slider(slider) => {
                    rows.extend(self.slider_rows(mechanism, slider, JointId(index), displacements));
                }
            }
        }
        rows.extend(mechanism.coordinates.iter().map(|_| 0.0));
        let left_out = &mechanism.excess.rows;
        let kept = rows.into_iter().enumerate().filter(|(row, _)| !left_out.contains(row));
        DVector::from_vec(kept.map(|(_, value)| value).collect())
    }

    /// Displacement of the block's middle (in sizes of the mechanism) and, unless it may rotate, its
    /// rotation.
    fn slider_rows(
        &self,
        mechanism: &Mechanism,
        slider: &Slider,
        joint: JointId,
        displacements: &[f64],
    ) -> Vec<f64> {
        let displacement = |contact: usize| displacements.get(contact).copied().unwrap_or(0.0);
        let contacts: Vec<usize> = (0..mechanism.contacts.len())
            .filter(|contact| mechanism.contacts[*contact].joint == joint)
            .filter(|contact| !mechanism.contacts[*contact].is_second_face())
            .collect();
        match contacts[..] {
            [front, rear, ..] => {
                let slide = self.slide(mechanism, slider).displacement;
                let offset = |contact: usize| {
                    let contact = &mechanism.contacts[contact];
                    match contact.carried_by {
                        CarriedBy::Block => contact.offset,
                        CarriedBy::Guide => contact.offset - slide,
                    }
                };
                let overlap = offset(front) - offset(rear);
                let rotation = (displacement(front) - displacement(rear)) / overlap;
                let middle = displacement(front) - rotation * offset(front);
                vec![middle / mechanism.size, rotation]
            }
            [only] if slider.kind == SliderKind::Pin => {
                vec![displacement(only) / mechanism.size]
            }
            [only] => vec![displacement(only) / mechanism.size, 0.0],
            _ => Vec::new(),
        }
    }
}
