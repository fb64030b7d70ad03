//! Sides that contacts take in every admissible state.

use super::BOUNDARY;
use super::assessment::side_options;
use super::instant::Instant;
use crate::motion::ContactPhase;

/// Rounds of the iteration for the greatest pressures.
const ROUNDS: usize = 30;
/// Its result is enlarged by this factor, and counts if it then bounds itself.
const ENLARGED: f64 = 1.01;

/// The sides that each contact can take: one alone where friction cannot turn the normal force, however joints stick or slide.
///
/// ```text
/// |N_j - N_j(0)| <= sum_k |eta_jk| (mu_k |N_k| + F_k0)     with the greater mu and the greater |eta| of both faces
/// ```
///
/// so that `y` with `|N_j(0)| + sum_k |eta_jk| (mu_k y_k + F_k0) <= y_j` bounds all `|N_j|` (theory, section 4).
pub(super) fn possible_sides(instant: &Instant<'_>) -> Vec<Vec<ContactPhase>> {
    let contacts = 0..instant.mechanism.contacts.len();
    // A stop pushes with any force.
    let is_free = instant.joints.iter().all(|joint| joint.stop == 0.0);
    let change = if is_free { greatest_changes(instant) } else { None };
    contacts
        .map(|j| {
            let all = side_options(instant, j);
            let normal = instant.outputs.base[j];
            match &change {
                Some(change) if normal.abs() > change[j] + BOUNDARY => vec![all[usize::from(normal < 0.0)]],
                _ => all.to_vec(),
            }
        })
        .collect()
}

/// By how much friction changes each normal force at most, in units; nothing where no bound was found.
fn greatest_changes(instant: &Instant<'_>) -> Option<Vec<f64>> {
    let [plus, minus] = &instant.outputs.columns;
    let contacts = plus.ncols();
    let change = |pressures: &[f64]| -> Vec<f64> {
        let friction = |k: usize| {
            let contact = instant.contact(k);
            let greatest = |list: [f64; 2]| list[0].max(list[1]);
            let mu = greatest(contact.mu).max(greatest(contact.mu_static));
            mu * pressures[k] + greatest(contact.preload) / instant.units_of(k).force
        };
        let frictions: Vec<f64> = (0..contacts).map(friction).collect();
        let one = |j: usize| -> f64 {
            (0..contacts).map(|k| plus[(j, k)].abs().max(minus[(j, k)].abs()) * frictions[k]).sum()
        };
        (0..contacts).map(one).collect()
    };
    let bound = |pressures: &[f64]| -> Vec<f64> {
        let changes = change(pressures).into_iter().zip(instant.outputs.base.iter());
        changes.map(|(change, normal)| change + normal.abs()).collect()
    };
    let mut pressures = vec![0.0; contacts];
    for _ in 0..ROUNDS {
        pressures = bound(&pressures);
    }
    pressures.iter_mut().for_each(|pressure| *pressure *= ENLARGED);
    let holds = bound(&pressures).iter().zip(&pressures).all(|(again, pressure)| again <= pressure);
    holds.then(|| change(&pressures))
}
