//! Mode problems of redundant contacts, which share their load by play, elasticity and misalignment.

use nalgebra::{DMatrix, DVector};

use crate::combinations::{binomial, combinations};
use crate::interval::Real;
use crate::problem::mode_problem::ModeProblemError;
use crate::problem::pattern::ContactState;
use crate::problem::scaling::power_of_two_above;
use crate::problem::side::{ProblemPart, Side};

/// How `r` contacts share a load that equilibrium alone leaves open.
///
/// With `rho` self-stresses, `rho` contacts are *cut*: their normal forces are taken for given, and influence
/// coefficients are those of the mechanism without them. What closes the cuts again is the law of the contacts,
///
/// ```text
/// N_k > 0:  d_k = -(delta_k + f_k N_k),    N_k < 0:  d_k = delta_k - f_k N_k,    N_k = 0:  |d_k| <= delta_k
/// ```
///
/// with deflections `d` that are compatible, `Z^T (d + e) = 0`.
///
/// The faces of a press fit of interference `2 i`, both pressed at once, are two contacts `p` and `m` at one place,
/// without play and with `e_p - e_m = 2 i`. Their sum is the normal force of the press fit. As long as `N_p >= 0 >= N_m`
/// these are the forces of both faces. Beyond that one face is open, and the other one yields alone:
///
/// ```text
/// d_p = -f N_p - l,    d_m = -f N_m - l,    l = f max(0, N_m) - f max(0, -N_p)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SharedLoad<T: Real = f64> {
    /// The contacts that are cut (rho).
    pub cut: Vec<usize>,
    /// `Z`: normal forces of each self-stress (r x rho, dimensionless); 1 at its own cut contact, 0 at others.
    pub self_stress: DMatrix<T>,
    /// `f`: deflection of a pressed face per unit of normal force (r, m/N).
    pub compliance: DVector<T>,
    /// `delta`: half of the play between both faces (r, m).
    pub clearance: DVector<T>,
    /// `e`: by how much the line of the guide is displaced towards `+n` (r, m).
    pub misalignment: DVector<T>,
    /// The faces `[p, m]` of each press fit.
    pub press_fits: Vec<[usize; 2]>,
}

impl<T: Real> SharedLoad<T> {
    /// Whether a contact takes part in a self-stress.
    pub fn shares(&self, contact: usize) -> bool {
        self.self_stress.row(contact).iter().any(|force| !force.is_zero())
    }

    /// Whether a contact may be open: it takes part in a self-stress and has play.
    pub fn may_be_open(&self, contact: usize) -> bool {
        self.shares(contact) && !self.clearance[contact].is_zero()
    }

    /// The self-stress of a cut contact.
    fn stress_of(&self, contact: usize) -> Option<usize> {
        self.cut.iter().position(|&cut| cut == contact)
    }

    /// By which power of two the row of a self-stress is multiplied, so that its numbers are of order one.
    fn scale(&self, stress: usize) -> T {
        let terms = self.self_stress.column(stress).into_iter().zip(self.compliance.iter());
        let greatest =
            terms.map(|(force, compliance)| (*force * *compliance).magnitude()).fold(0.0, f64::max);
        T::exactly(if greatest > 0.0 { 1.0 / power_of_two_above(greatest) } else { 1.0 })
    }

    /// The other face of a press fit, if this one is open when its normal force has this sign.
    fn other_face(&self, side: Side, contact: usize) -> Option<usize> {
        self.press_fits.iter().find_map(|&[positive, negative]| match side {
            Side::Positive => (contact == negative).then_some(positive),
            Side::Negative => (contact == positive).then_some(negative),
        })
    }

    /// `c_k^sigma` in a row, from the number that stands there without self-stresses: `-sigma Z_jl` more for a
    /// contact that is cut, and `sigma f_k Z_kl` in the row of a self-stress, to which an open face of a press fit
    /// adds `sigma f_k (Z_pl + Z_ml)`.
    pub(crate) fn column(&self, side: Side, row: usize, contact: usize, given: T) -> T {
        let sign = T::exactly(side.sign());
        match (self.stress_of(row), self.stress_of(contact)) {
            (Some(stress), _) => {
                let own = self.self_stress[(contact, stress)];
                let force = match self.other_face(side, contact) {
                    None => own,
                    Some(other) => own + (own + self.self_stress[(other, stress)]),
                };
                sign * self.compliance[contact] * force * self.scale(stress)
            }
            (None, Some(stress)) => given - sign * self.self_stress[(row, stress)],
            (None, None) => given,
        }
    }

    /// `H_k^sigma` of `x = b + d^sigma + H^sigma |x|` in a row, from the number that stands there without self-stresses:
    /// `sigma e_k - c_k^sigma` (dimensionless). Rows below those of the contacts, such as of hinge forces, are equilibrium.
    ///
    /// A linear term `A x` in place of `x` is a part of `H` that changes its sign with the side, so that this form holds
    /// all problems of redundant guides, even where `A` is singular, as it is for rigid faces.
    pub fn response(&self, side: Side, row: usize, contact: usize, given: T) -> T {
        let sign = T::exactly(side.sign());
        match (self.stress_of(row), self.stress_of(contact)) {
            (Some(_), _) if row == contact => sign - self.column(side, row, contact, given),
            (Some(_), _) => -self.column(side, row, contact, given),
            (None, Some(stress)) => given + sign * self.self_stress[(row, stress)],
            (None, None) => given,
        }
    }

    /// `d_k^sigma` in a row: `-sigma delta_k Z_kl` in that of a self-stress.
    pub fn jump(&self, side: Side, row: usize, contact: usize, given: T) -> T {
        let Some(stress) = self.stress_of(row) else { return given };
        let force = self.self_stress[(contact, stress)];
        T::exactly(-side.sign()) * self.clearance[contact] * force * self.scale(stress)
    }

    /// The right-hand side in a row: `(Z^T e)_l` in that of a self-stress.
    pub fn load(&self, row: usize, given: T) -> T {
        let Some(stress) = self.stress_of(row) else { return given };
        let terms = self.self_stress.column(stress).into_iter().zip(self.misalignment.iter());
        terms.map(|(force, misalignment)| *force * *misalignment).sum::<T>() * self.scale(stress)
    }

    pub(crate) fn check(&self, contacts: usize) -> Result<(), ModeProblemError> {
        let lengths = [self.compliance.len(), self.clearance.len(), self.misalignment.len()];
        let expected = (contacts, self.cut.len());
        let fits = self.self_stress.shape() == expected
            && lengths == [contacts; 3]
            && self.cut.iter().chain(self.press_fits.iter().flatten()).all(|&contact| contact < contacts);
        let found = self.self_stress.shape();
        let part = ProblemPart::Columns(Side::Positive);
        if fits { Ok(()) } else { Err(ModeProblemError::Shape { part, expected, found }) }
    }
}

/// The most circuits that are tried one by one.
const MOST_CIRCUITS: u64 = 20_000;

impl SharedLoad {
    /// Contacts that rigid faces cannot be put together with: those of a self-stress `z` with
    /// `|z^T e| > sum delta |z|`, so that no deflections within the play are compatible. None if there are such
    /// deflections, or too many self-stresses to try.
    ///
    /// By Farkas' lemma it is the same for all self-stresses, and each of these is a sum, without cancellation, of
    /// circuits: self-stresses of which no contact can be left out (Rockafellar, The elementary vectors of a subspace
    /// of R^N, 1969). A circuit vanishes in as many independent rows as there are self-stresses but one.
    pub fn out_of_line(&self) -> Option<Vec<usize>> {
        let sharing: Vec<usize> = (0..self.clearance.len()).filter(|&k| self.shares(k)).collect();
        let without = self.cut.len().checked_sub(1)?;
        if binomial(sharing.len(), without) > MOST_CIRCUITS {
            return None;
        }
        let rounding = sharing.len() as f64 * f64::EPSILON;
        combinations(sharing.len(), without).find_map(|zero| {
            let zero: Vec<usize> = zero.into_iter().map(|at| sharing[at]).collect();
            let weights = self.circuit(&zero);
            let (forces, terms) = (&self.self_stress * &weights, self.self_stress.abs() * weights.abs());
            let others = || sharing.iter().copied().filter(|k| !zero.contains(k));
            let offset: f64 = others().map(|k| forces[k] * self.misalignment[k]).sum();
            let room: f64 = others().map(|k| forces[k].abs() * self.clearance[k]).sum();
            let size = |k: usize| terms[k] * (self.misalignment[k].abs() + self.clearance[k]);
            let is_out = offset.abs() - room > rounding * sharing.iter().map(|&k| size(k)).sum::<f64>();
            let least = OpenContacts::ROUNDING * forces.amax();
            is_out.then(|| others().filter(|&k| forces[k].abs() > least).collect())
        })
    }

    /// The weights of the self-stresses in one that vanishes in these contacts, one fewer than there are self-stresses;
    /// zero if that leaves several.
    fn circuit(&self, zero: &[usize]) -> DVector<f64> {
        let rows = self.self_stress.select_rows(zero);
        DVector::from_fn(self.cut.len(), |stress, _| {
            let sign = if stress % 2 == 0 { 1.0 } else { -1.0 };
            sign * rows.clone().remove_column(stress).determinant()
        })
    }
}

/// Which contacts may be open, and together: those of a shared load.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OpenContacts {
    /// As [`SharedLoad::self_stress`]; empty if no load is shared.
    self_stress: Option<DMatrix<f64>>,
}

impl OpenContacts {
    /// Normal forces below this part of the greatest of a self-stress are rounding.
    const ROUNDING: f64 = 1e-9;

    /// Those with these self-stresses: a row for each contact, a column for each self-stress.
    pub fn new(self_stress: DMatrix<f64>) -> Self {
        Self { self_stress: Some(self_stress).filter(|forces| forces.ncols() > 0) }
    }

    /// Those of some contacts, in which no other one takes part.
    #[must_use]
    pub fn of_contacts(&self, contacts: &[usize]) -> Self {
        Self { self_stress: self.self_stress.as_ref().map(|forces| forces.select_rows(contacts)) }
    }

    /// Whether a contact takes part in a self-stress.
    pub fn shares(&self, contact: usize) -> bool {
        self.self_stress
            .as_ref()
            .is_some_and(|forces| forces.row(contact).amax() > Self::ROUNDING * forces.amax())
    }

    /// Whether a pattern leaves a determinate mechanism: as many contacts are open as there are self-stresses, and
    /// the others hold.
    pub fn is_determinate(&self, pattern: &[ContactState]) -> bool {
        Self::between(pattern) == self.self_stresses() && self.holds(pattern)
    }

    /// How many more contacts a pattern presses than equilibrium determines.
    pub fn excess(&self, pattern: &[ContactState]) -> usize {
        self.self_stresses().saturating_sub(Self::between(pattern))
    }

    fn self_stresses(&self) -> usize {
        self.self_stress.as_ref().map_or(0, DMatrix::ncols)
    }

    fn between(pattern: &[ContactState]) -> usize {
        pattern.iter().filter(|state| **state == ContactState::Gap).count()
    }

    /// Whether the states of a pattern are solutions: each contact is pressed, or open. Between its faces any other
    /// is in its preload gap.
    pub fn is_solution(&self, pattern: &[ContactState]) -> bool {
        let mut between = (0..pattern.len()).filter(|&k| pattern[k] == ContactState::Gap);
        between.all(|k| self.shares(k))
    }

    /// Whether the contacts that are not open hold what all of them hold: else the determinant of the pattern
    /// vanishes. The rows of the self-stresses are independent for the open ones then.
    pub fn holds(&self, pattern: &[ContactState]) -> bool {
        let Some(forces) = &self.self_stress else { return true };
        let open: Vec<usize> =
            (0..pattern.len()).filter(|&k| pattern[k] == ContactState::Gap && self.shares(k)).collect();
        if open.len() > forces.ncols() {
            return false;
        }
        // Gram and Schmidt.
        let mut rows: Vec<DVector<f64>> = open.iter().map(|&k| forces.row(k).transpose()).collect();
        for row in 0..rows.len() {
            let before = forces.row(open[row]).norm();
            let length = rows[row].norm();
            if length <= Self::ROUNDING * before {
                return false;
            }
            let direction = &rows[row] / length;
            for later in &mut rows[row + 1..] {
                let part = later.dot(&direction);
                later.axpy(-part, &direction, 1.0);
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random_numbers::random_numbers;

    fn rigid(self_stress: DMatrix<f64>, clearance: DVector<f64>, misalignment: DVector<f64>) -> SharedLoad {
        let (contacts, stresses) = self_stress.shape();
        SharedLoad {
            cut: (contacts - stresses..contacts).collect(),
            compliance: DVector::zeros(contacts),
            clearance,
            misalignment,
            self_stress,
            press_fits: Vec::new(),
        }
    }

    /// A self-stress `z` with `e_k = t delta_k sign(z_k)` has `z^T e = t sum delta |z|`; deflections `d` within the play
    /// with `e = -d` are compatible, also with the play used up in every contact of a circuit.
    #[test]
    fn what_fits_is_told_from_what_does_not() {
        let mut random = random_numbers(11);
        for round in 0..400 {
            let stresses = 1 + round % 4;
            let contacts = stresses + 2 + round % 3;
            let free = DMatrix::from_fn(contacts - stresses, stresses, |_, _| random());
            let self_stress = DMatrix::from_fn(contacts, stresses, |row, stress| {
                match row.checked_sub(contacts - stresses) {
                    None => free[(row, stress)],
                    Some(cut) => f64::from(u8::from(cut == stress)),
                }
            });
            let clearance = DVector::from_fn(contacts, |_, _| 1e-3 * (0.1 + random().abs()));
            let within = clearance.map(|clearance| clearance * random());
            assert_eq!(rigid(self_stress.clone(), clearance.clone(), -within).out_of_line(), None, "{round}");
            let force = &self_stress * DVector::from_fn(stresses, |_, _| random());
            let beyond = |factor: f64| {
                clearance.zip_map(&force, |clearance, force| factor * clearance * force.signum())
            };
            let exact = rigid(self_stress.clone(), clearance.clone(), beyond(1.0)).out_of_line();
            assert_eq!(exact, None, "{round}");
            let out = rigid(self_stress, clearance.clone(), beyond(1.0 + 1e-9)).out_of_line();
            assert!(out.is_some_and(|out| !out.is_empty()), "{round}");
        }
    }
}
