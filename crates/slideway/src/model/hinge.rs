//! Hinges and their friction: what the radius of a friction circle follows from.

use super::{Attachment, Joint, JointKind, Model, PinLaw};
use crate::ids::FormulaId;
use crate::interval::Real;

/// A hinge between two points.
#[derive(Debug, Clone)]
pub struct Hinge {
    /// The hinged points; the hinge force is counted on the first body.
    pub between: [Attachment; 2],
    /// Its friction, if the file gives it.
    pub friction: Option<HingeFriction>,
    /// How many times which length it is above its points, if it is one of two bearings.
    pub raised: Option<(f64, FormulaId)>,
    /// The friction of the collar by which it carries along z, if it has one.
    pub collar: Option<HingeFriction>,
}

/// Friction of a hinge.
#[derive(Debug, Clone, Copy)]
pub enum HingeFriction {
    /// Friction of a pin.
    Pin {
        /// Kinetic and static friction coefficient.
        mu: [FormulaId; 2],
        /// Radius of the pin (m).
        radius: FormulaId,
        /// How the radius of the friction circle follows from them.
        law: PinLaw,
    },
    /// The radii of the friction circle (m): kinetic and static.
    Circle([FormulaId; 2]),
    /// The friction coefficients of a round end of a block: kinetic and static.
    End([FormulaId; 2]),
    /// The couples of a collar by its force along z (m): kinetic and static.
    Collar([FormulaId; 2]),
}

impl PinLaw {
    /// The radius of the friction circle of a pin (m).
    ///
    /// With the total reaction `R` tangent to the circle, `|M| = r |R|`: a loose pin touches along a line, where
    /// the reaction leans by `atan mu` against the normal, so that `r = rho sin(atan mu) = rho mu / sqrt(1 +
    /// mu^2)`. Textbooks put the total reaction in place of the normal part: `r = mu rho`.
    pub(crate) fn friction_radius<T: Real>(self, mu: T, radius: T) -> T {
        match self {
            Self::MuRho => mu * radius,
            Self::TotalReaction => mu * radius / (T::exactly(1.0) + mu.square()).sqrt(),
        }
    }
}

impl HingeFriction {
    /// The radii of the friction circle (m), kinetic and static; of a round end its coefficients.
    pub(crate) fn radii<T: Real>(&self, value: impl Fn(FormulaId) -> T) -> [T; 2] {
        match *self {
            Self::Circle(radii) | Self::End(radii) | Self::Collar(radii) => radii.map(value),
            Self::Pin { mu, radius, law } => mu.map(|mu| law.friction_radius(value(mu), value(radius))),
        }
    }

    /// Its coefficients, or its radii: kinetic and static.
    pub(crate) fn kinetic_and_static(&self) -> [FormulaId; 2] {
        match *self {
            Self::Circle(values)
            | Self::End(values)
            | Self::Collar(values)
            | Self::Pin { mu: values, .. } => values,
        }
    }

    /// Everything that the friction circles follow from.
    pub(crate) fn formulas(self) -> impl Iterator<Item = FormulaId> {
        let pin = match self {
            Self::Circle(_) | Self::End(_) | Self::Collar(_) => None,
            Self::Pin { radius, .. } => Some(radius),
        };
        self.kinetic_and_static().into_iter().chain(pin)
    }

    /// Its friction coefficients, kinetic and static, unless its radii are given.
    pub(crate) fn coefficients(&self) -> Option<[FormulaId; 2]> {
        match *self {
            Self::Circle(_) | Self::Collar(_) => None,
            Self::Pin { mu, .. } | Self::End(mu) => Some(mu),
        }
    }
}

impl Model {
    /// The friction of all hinges and collars that have it, and of all round ends, in the order of the joints.
    pub(crate) fn hinge_friction(&self) -> impl Iterator<Item = HingeFriction> {
        self.joints.iter().flat_map(Joint::friction_of_blocks)
    }
}

impl Joint {
    /// The friction of a hinge and of its collar, or of each round end.
    pub(crate) fn friction_of_blocks(&self) -> Vec<HingeFriction> {
        match &self.kind {
            JointKind::Hinge(hinge) => hinge.friction.into_iter().chain(hinge.collar).collect(),
            JointKind::Slider(slider) => slider.ends.iter().map(|end| end.friction).collect(),
        }
    }
}
