//! The question at an instant, with the sides that contacts take in every admissible state.

use super::BOUNDARY;
use super::instant::Instant;
use super::outputs::Group;
use super::system::Question;
use crate::ids::ContactId;
use crate::pattern::{ContactPhase, JointPhase, Phase};
use nalgebra::{DMatrix, DVector};

/// Number of rounds of the iteration for the greatest pressures.
const ROUNDS: usize = 30;
/// The result is enlarged by this factor, and counts if it then bounds itself.
const ENLARGED: f64 = 1.01;

impl Instant<'_> {
    /// The question for accelerations, with joints whose velocity is zero: about all phases, or about a
    /// single phase, where sides are open only if a joint sticks.
    pub(super) fn question<'q>(&'q self, stopped: &'q [bool], phase: Option<&Phase>) -> Question<'q> {
        let slides = phase.filter(|phase| !phase.joints.contains(&JointPhase::Sticking));
        Question {
            outputs: &self.outputs,
            wanted: vec![0.0; self.rubbing()],
            has_preload: true,
            sides: match slides {
                Some(phase) => phase.contacts.iter().map(|contact| vec![*contact]).collect(),
                None => possible_sides(self),
            },
            stopped,
            opposes: None,
        }
    }
}

/// The sides that each contact can take: only one if friction cannot reverse the normal force, however joints
/// stick or slide.
///
/// ```text
/// |N_j - N_j(0)| <= sum_k |eta_jk| (mu_k |N_k| + F_k0)     with the greater mu and the greater |eta| of both faces
/// ```
///
/// so that `y` with `|N_j(0)| + sum_k |eta_jk| (mu_k y_k + F_k0) <= y_j` bounds all `|N_j|` (theory, section
/// 4).
fn possible_sides(instant: &Instant<'_>) -> Vec<Vec<ContactPhase>> {
    let options = |j: usize| {
        if instant.mechanism.contacts[j].opens {
            ContactPhase::CLOSED
        } else {
            ContactPhase::options(instant.mechanism.preload_jumps(ContactId(j)))
        }
    };
    let mut sides: Vec<Vec<ContactPhase>> =
        (0..instant.mechanism.contacts.len()).map(|j| options(j).to_vec()).collect();
    // A stop can push with any force, and what is known of the forces of hinges is their couples.
    let is_free = |group: &&Group| {
        group.hinges.is_empty() && group.joints.iter().all(|joint| instant.joints[*joint].stop == 0.0)
    };
    for group in instant.groups.iter().filter(is_free) {
        let Some(changes) = greatest_changes(instant, &group.contacts) else { continue };
        for (&j, change) in group.contacts.iter().zip(&changes) {
            if instant.mechanism.contacts[j].opens {
                continue;
            }
            let normal = instant.outputs.base[j];
            if normal.abs() > change + BOUNDARY {
                sides[j] = vec![options(j)[usize::from(normal < 0.0)]];
            }
        }
    }
    sides
}

/// The greatest change of the normal force of each of a group's contacts by friction, in units; `None` if no bound was
/// found.
fn greatest_changes(instant: &Instant<'_>, group: &[usize]) -> Option<DVector<f64>> {
    let [plus, minus] = &instant.outputs.columns;
    let contacts = group.len();
    let greatest = |list: [f64; 2]| list[0].max(list[1]);
    let friction = |k: usize| greatest(instant.contact(k).mu).max(greatest(instant.contact(k).mu_static));
    let influence = |j: usize, k: usize| plus[(j, k)].abs().max(minus[(j, k)].abs());
    let by_pressures =
        DMatrix::from_fn(contacts, contacts, |j, k| influence(group[j], group[k]) * friction(group[k]));
    let preload = |k: usize| greatest(instant.contact(k).preload) / instant.units_of(k).force;
    let by_preloads =
        DVector::from_fn(contacts, |j, _| group.iter().map(|&k| influence(group[j], k) * preload(k)).sum());
    let normal = instant.outputs.base.select_rows(group).abs();
    let mut pressures = DVector::zeros(contacts);
    let mut changes = by_preloads.clone();
    let bound = |pressures: &DVector<f64>, changes: &mut DVector<f64>| {
        changes.copy_from(&by_preloads);
        changes.gemv(1.0, &by_pressures, pressures, 1.0);
    };
    for _ in 0..ROUNDS {
        pressures.copy_from(&normal);
        pressures += &changes;
        bound(&pressures, &mut changes);
    }
    pressures *= ENLARGED;
    bound(&pressures, &mut changes);
    let holds = (0..contacts).all(|k| normal[k] + changes[k] <= pressures[k]);
    holds.then_some(changes)
}
