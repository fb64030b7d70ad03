//! The same of mechanisms with friction in hinges, which are slightly elastic, too.
//!
//! A hinge with friction gives way in both directions, `R = -K gap`. With `x = (N, R)` and the directions `D_j =
//! x_j^T / |x_j|` the fast motion about a solution is
//!
//! ```text
//! lambda Y gap = (I - H D) K gap
//! ```
//!
//! so that the number of negative eigenvalues is odd if and only if `det(I - H D) < 0`, whatever the stiffness.

use super::inertia::Inertia;
use super::spectrum::{Pencil, Stability};
use super::{MOST_CONTACTS, ROUNDING, equal_masses, ratios, reversed};
use crate::ids::JointId;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::report::{Attainability, FlutterDamping, Verdict};
use nalgebra::DMatrix;

/// A mechanism in its state whose guides and hinges with friction are slightly elastic: all of them equally.
pub(crate) struct ElasticHinges {
    inertia: Result<Inertia, (Verdict, String)>,
}

impl ElasticHinges {
    /// Those of a mechanism with these equations, and with friction in these hinges.
    pub(crate) fn new(mechanism: &Mechanism, equations: &KineticEquations, hinges: &[JointId]) -> Self {
        if mechanism.contacts.len() + 2 * hinges.len() > MOST_CONTACTS {
            let reason = format!("more than {MOST_CONTACTS} components of normal and hinge forces");
            return Self { inertia: Err((Verdict::NotComputed, reason)) };
        }
        let inertia = Inertia::new(equations, hinges, mechanism.size).filter(|inertia| {
            let size = inertia.matrix.nrows();
            let spectrum = Pencil::new(inertia, DMatrix::identity(size, size), None)
                .and_then(|pencil| pencil.spectrum(&vec![1.0; size], &equal_masses(inertia)));
            spectrum.is_some_and(|spectrum| spectrum.stability == Stability::Attainable)
        });
        Self { inertia: inertia.ok_or_else(|| (Verdict::Undecided, reversed(mechanism))) }
    }

    /// The attainability of a solution with this matrix `I - H D`; nothing is said of what an unattainable one
    /// separates.
    pub(crate) fn of(&self, mode: DMatrix<f64>) -> Attainability {
        let none = |verdict: Verdict, reason: &str| Attainability::without_eigenvalues(verdict, reason);
        let inertia = match &self.inertia {
            Ok(inertia) => inertia,
            Err((verdict, reason)) => return none(*verdict, reason),
        };
        let (size, oriented) = (mode.nrows(), mode.determinant());
        let Some(pencil) = Pencil::new(inertia, mode, None) else {
            return none(Verdict::Undecided, ROUNDING);
        };
        let Some(spectrum) = pencil.spectrum(&vec![1.0; size], &equal_masses(inertia)) else {
            return none(Verdict::NotComputed, "its eigenvalues could not be computed");
        };
        let is_odd = spectrum.negative % 2 == 1;
        let (verdict, flutter_damping) = match spectrum.stability {
            _ if oriented == 0.0 || is_odd != (oriented < 0.0) => (Verdict::Undecided, None),
            Stability::Unclear => (Verdict::Undecided, None),
            Stability::Attainable => (Verdict::Attainable, None),
            Stability::Unattainable => (Verdict::Unattainable, None),
            Stability::Flutter(damping) => {
                (Verdict::Flutter, Some(FlutterDamping { ratio: damping.ratio, time: None }))
            }
        };
        let varies = |stiffness: Vec<f64>| {
            let other = pencil.spectrum(&stiffness, &equal_masses(inertia));
            other.is_some_and(|other| !other.stability.agrees(&spectrum.stability))
        };
        let depends = verdict != Verdict::Undecided;
        Attainability {
            reason: (verdict == Verdict::Undecided).then(|| ROUNDING.to_owned()),
            // Adding zero turns -0 into 0.
            eigenvalues: spectrum.finite.iter().map(|lambda| [lambda.re, lambda.im + 0.0]).collect(),
            massless_motions: inertia.massless_gaps(),
            depends_on_stiffness: depends.then(|| !is_odd && ratios(size).into_iter().any(varies)),
            flutter_damping,
            ..none(verdict, "")
        }
    }
}
