//! Rows whose signs leave a contact only one side.
//!
//! Let `i` be an equation, taken with a sign so that `b_i >= 0`, and let the column of `y_k` be the only allowed one with a
//! positive entry. Then `b_i = sum_j C_ij y_j <= C_ik y_k`. If `b_i > 0`, `y_k` is positive, and its partner vanishes. If
//! `b_i = 0` and the partner's entry is negative, a positive partner would need a positive `y_k`, so it vanishes, too. In
//! either case, all solutions have the side of `y_k`. So `w = M z + q` with `M >= 0`, `M_kk > 0` and `q >= 0` has only
//! `z = 0`. The signs are exact; no tolerance of a linear program enters, however nearly dependent the columns are.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::states::StateSet;
use crate::certificate::LiftedSystem;
use crate::problem::ContactState;
use crate::solutions::ContactSet;

/// The signs of the lifted equations, row by row, with that of the right-hand side last.
#[derive(Clone)]
pub(super) struct RowSigns {
    rows: Vec<Vec<i8>>,
}

/// A contact of which a row leaves one side.
pub(super) struct Forced {
    pub(super) contact: usize,
    pub(super) side: ContactState,
    row: usize,
    sign: i8,
}

impl RowSigns {
    pub(super) fn new(system: &LiftedSystem) -> Self {
        let row = |row: usize| {
            let entries = (0..system.width()).map(|column| &system.column(column)[row]);
            entries.chain([&system.right()[row]]).map(signum).collect()
        };
        Self { rows: (0..system.rows()).map(row).collect() }
    }

    /// A contact with both sides open of which a row leaves one.
    pub(super) fn forced(&self, states: &[StateSet], allowed: &ContactSet) -> Option<Forced> {
        let allowed: Vec<usize> = allowed.iter().collect();
        (0..self.rows.len()).find_map(|row| {
            let right = self.rows[row].last().copied().unwrap_or(0);
            let signs: &[i8] = if right == 0 { &[1, -1] } else { &[right] };
            signs.iter().find_map(|&sign| self.forced_by((row, sign), states, &allowed))
        })
    }

    /// Finds a contact with both sides open of which this row, multiplied by a sign, leaves one.
    fn forced_by(&self, (row, sign): (usize, i8), states: &[StateSet], allowed: &[usize]) -> Option<Forced> {
        let entries = &self.rows[row];
        let mut positive = allowed.iter().filter(|&&column| entries[column] == sign);
        let (Some(&only), None) = (positive.next(), positive.next()) else { return None };
        // Of a contact with a jump, shares are open as well.
        let contact = only % states.len();
        if only >= 2 * states.len() || states[contact] != StateSet::undecided(false) {
            return None;
        }
        let [side, other] = if only < states.len() { [0, 1] } else { [1, 0] };
        let partner = contact + other * states.len();
        let is_positive = entries.last().is_some_and(|&right| right == sign);
        (is_positive || entries[partner] == -sign).then(|| Forced {
            contact,
            side: ContactState::PRESSED[side],
            row,
            sign,
        })
    }

    /// The vector that proves what vanishes, or that nothing is left, where the other side is chosen.
    pub(super) fn vector(&self, forced: &Forced) -> Vec<IBig> {
        let entry = |row: usize| if row == forced.row { IBig::from(forced.sign) } else { IBig::ZERO };
        (0..self.rows.len()).map(entry).collect()
    }

    /// The states of what is left where the other side is chosen and both unknowns vanish: a part of the node with the
    /// forced side.
    pub(super) fn left(&self, forced: &Forced, states: &[StateSet]) -> Vec<StateSet> {
        let entries = &self.rows[forced.row];
        let of_contact = |(contact, &set): (usize, &StateSet)| {
            if contact == forced.contact {
                return StateSet::only(forced.side);
            }
            let vanishes = |side: usize| entries[contact + side * states.len()] == -forced.sign;
            (0..2).filter(|&side| vanishes(side)).fold(set, |set, side| {
                let without = set.without(ContactState::PRESSED[side]);
                // Where both unknowns vanish, either side will do; shares of jumps are left as they are.
                if without.is_empty() || set.contains(ContactState::Gap) { set } else { without }
            })
        };
        states.iter().enumerate().map(of_contact).collect()
    }
}

fn signum(value: &IBig) -> i8 {
    match value.cmp(&IBig::ZERO) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::ModeProblem;
    use nalgebra::{DVector, dmatrix, dvector};

    fn forced(q: DVector<f64>) -> Option<(usize, ContactState)> {
        let m = dmatrix![2.0, 1.0; -1.0, 0.0];
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        let system = LiftedSystem::new((&problem).into());
        let mut all = ContactSet::none_of(system.width());
        (0..system.width()).for_each(|column| all.insert(column));
        let states = [StateSet::undecided(false); 2];
        let found = RowSigns::new(&system).forced(&states, &all)?;
        Some((found.contact, found.side))
    }

    #[test]
    fn rows_leave_one_side() {
        // w_1 = 2 z_1 + z_2 + q_1: w_1 is positive with q_1 > 0, and z_1 vanishes with q_1 = 0.
        assert_eq!(forced(dvector![1.0, 1.0]), Some((0, ContactState::Negative)));
        assert_eq!(forced(dvector![0.0, 1.0]), Some((0, ContactState::Negative)));
        // w_2 = -z_1 + q_2: with q_2 <= 0, nothing follows for z_2; with q_1 < 0, z_1 or z_2 may be positive.
        assert_eq!(forced(dvector![-1.0, 1.0]), None);
        assert_eq!(forced(dvector![-1.0, 0.0]), None);
    }
}
