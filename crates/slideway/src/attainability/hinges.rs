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
use super::shared::SharedGaps;
use super::spectrum::{Pencil, Stability};
use super::{MOST_CONTACTS, ROUNDING, equal_masses, mean, other_stiffnesses, reversed};
use crate::ids::JointId;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::modes::ContactState;
use crate::report::{Attainability, FlutterDamping, Verdict};
use nalgebra::DMatrix;

/// A mechanism in its state whose guides and hinges with friction are slightly elastic: all of them equally, but for
/// redundant guides with other ratios of stiffnesses.
pub(crate) struct ElasticHinges {
    inertia: Result<Inertia, (Verdict, String)>,
    /// Of the contacts, then of both components of the hinges, in units of the mean of the contacts.
    stiffness: Vec<f64>,
    /// Of redundant guides: how their gaps hang together.
    shared: Option<SharedGaps>,
}

impl ElasticHinges {
    /// Those of a mechanism with these equations, and with friction in these hinges.
    pub(crate) fn new(mechanism: &Mechanism, equations: &KineticEquations, hinges: &[JointId]) -> Self {
        let size = mechanism.contacts.len() + 2 * hinges.len();
        let shared = SharedGaps::of(mechanism, equations, hinges);
        let mut stiffness = vec![1.0; size];
        let known: Vec<f64> = mechanism.contacts.iter().filter_map(|contact| contact.stiffness).collect();
        if shared.is_some() && !known.is_empty() {
            let unit = mean(&known);
            for (stiffness, contact) in stiffness.iter_mut().zip(&mechanism.contacts) {
                *stiffness = contact.stiffness.map_or(1.0, |known| known / unit);
            }
        }
        if size > MOST_CONTACTS {
            let reason = format!("more than {MOST_CONTACTS} components of normal and hinge forces");
            return Self { inertia: Err((Verdict::NotComputed, reason)), stiffness, shared };
        }
        let frictionless =
            shared.as_ref().map_or_else(|| DMatrix::identity(size, size), |shared| shared.gaps.transpose());
        let inertia = Inertia::new(equations, hinges, mechanism.size).filter(|inertia| {
            let spectrum = Pencil::new(inertia, frictionless, shared.as_ref())
                .and_then(|pencil| pencil.spectrum(&stiffness, &equal_masses(inertia)));
            spectrum.is_some_and(|spectrum| spectrum.stability == Stability::Attainable)
        });
        let inertia = inertia.ok_or_else(|| (Verdict::Undecided, reversed(mechanism)));
        Self { inertia, stiffness, shared }
    }

    /// The attainability of a solution with this matrix `I - H D` and these states of the contacts; nothing is said of what
    /// an unattainable one separates.
    pub(crate) fn of(&self, mode: DMatrix<f64>, states: &[ContactState]) -> Attainability {
        let none = |verdict: Verdict, reason: &str| Attainability::without_eigenvalues(verdict, reason);
        let inertia = match &self.inertia {
            Ok(inertia) => inertia,
            Err((verdict, reason)) => return none(*verdict, reason),
        };
        let (mode, oriented) = self.fast(mode, states);
        let Some(pencil) = Pencil::new(inertia, mode, self.shared.as_ref()) else {
            return none(Verdict::Undecided, ROUNDING);
        };
        let Some(spectrum) = pencil.spectrum(&self.stiffness, &equal_masses(inertia)) else {
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
        // An odd number of negative eigenvalues stays odd, but for redundant guides.
        let may_vary = !is_odd || self.shared.is_some();
        let mut others = other_stiffnesses(&self.stiffness, self.shared.as_ref());
        Attainability {
            reason: (verdict == Verdict::Undecided).then(|| ROUNDING.to_owned()),
            // Adding zero turns -0 into 0.
            eigenvalues: spectrum.finite.iter().map(|lambda| [lambda.re, lambda.im + 0.0]).collect(),
            massless_motions: inertia.massless_gaps(),
            depends_on_stiffness: depends.then(|| may_vary && others.any(varies)),
            flutter_damping,
            ..none(verdict, "")
        }
    }

    /// The matrix of the fast motion, `C S` of the gaps that are kept, and its oriented determinant.
    fn fast(&self, mut mode: DMatrix<f64>, states: &[ContactState]) -> (DMatrix<f64>, f64) {
        let Some(shared) = &self.shared else {
            let oriented = mode.determinant();
            return (mode, oriented);
        };
        let states = shared.closed(states);
        for (contact, _) in states.iter().enumerate().filter(|(_, state)| state.side().is_none()) {
            mode.column_mut(contact).fill(0.0);
        }
        let kept = mode.select_rows(&shared.kept);
        let oriented = shared.oriented(&kept, &states, &self.stiffness);
        (kept, oriented)
    }
}
