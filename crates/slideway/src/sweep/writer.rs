//! Writes the states of a point that elimination has found.

use super::columns::CoupleColumn;
use super::plan::{Plan, Point};
use super::rows::{PointStatus, RowHead, RowKind, Rows};
use super::stages::Stages;
use crate::attainability::ElasticGuides;
use crate::influence::HingeState;
use crate::law::{COUPLE_TOLERANCE, positive_share};
use crate::mechanism::{JointKind, Mechanism};
use crate::modes::ContactState;
use crate::modes::screen::SmallState;
use crate::report::Verdict;
use crate::units::number::beside;

/// Data from which the rows of a point are written.
pub(super) struct Writer<'w> {
    pub(super) plan: &'w Plan,
    /// With the friction of the point.
    pub(super) mechanism: &'w Mechanism,
    pub(super) stages: &'w Stages,
    /// If attainability is asked for.
    pub(super) guides: Option<ElasticGuides<'w>>,
    /// For each state the hinges that rub; nothing if none does.
    pub(super) hinges: &'w [Vec<HingeState>],
}

/// States of a point, by kind.
#[derive(Debug, Clone, Copy, Default)]
struct Counts {
    solutions: u32,
    gap_states: u32,
    rejected: u32,
}

impl Counts {
    fn status(self) -> PointStatus {
        match (self.solutions, self.gap_states) {
            (0, 0) => PointStatus::None,
            (0, _) => PointStatus::PreloadGap,
            (1, _) => PointStatus::One,
            _ => PointStatus::Several,
        }
    }
}

impl Writer<'_> {
    /// Adds the rows of a point, solutions before gap states; nothing, and `false`, if a guided slider is
    /// about to tip or a number overflows: `solve` then says so.
    pub(super) fn write(&self, states: &[SmallState], point: Point<'_>, rows: &mut Rows) -> bool {
        let first = rows.len();
        let contacts = self.plan.columns.contacts;
        let mut counts = Counts::default();
        for with_gap in [false, true] {
            for (index, state) in states.iter().enumerate() {
                let in_gap = state.pattern[..contacts].contains(&ContactState::Gap);
                let hinges = self.hinges.get(index).map_or(&[][..], Vec::as_slice);
                if in_gap == with_gap && self.row((state, hinges), point, rows, &mut counts).is_none() {
                    rows.truncate(first);
                    return false;
                }
            }
        }
        if rows.len() == first {
            rows.push_empty(head(point, counts.status()), point.values);
        }
        number_in_modes(self.plan, first, rows);
        for head in &mut rows.heads[first..] {
            head.status = counts.status();
            head.solutions = counts.solutions;
            head.gap_states = counts.gap_states;
            head.rejected = counts.rejected;
        }
        true
    }

    /// Writes the row of a state unless a guided slider rejects it. Returns `None` if that cannot be decided,
    /// or a number overflows.
    fn row(
        &self,
        (state, hinges): (&SmallState, &[HingeState]),
        point: Point<'_>,
        rows: &mut Rows,
        counts: &mut Counts,
    ) -> Option<()> {
        let columns = &self.plan.columns;
        let contacts = columns.contacts;
        let pattern = &state.pattern[..contacts];
        let start = rows.numbers.len();
        rows.numbers.resize(start + rows.width, f64::NAN);
        let (varied, numbers) = rows.numbers[start..].split_at_mut(point.values.len());
        varied.copy_from_slice(point.values);
        let (forces, numbers) = numbers.split_at_mut(2 * contacts);
        let (shares, outputs) = numbers.split_at_mut(columns.shares.len());
        for (share, &k) in shares.iter_mut().zip(&columns.shares) {
            if pattern[k] == ContactState::Gap {
                *share = state.unknowns[k];
            }
        }
        outputs.copy_from_slice(&self.stages.frictionless);
        for k in 0..contacts {
            let faces = self.friction(state, k);
            forces[k] = state.normal_force(k);
            // Adding zero turns -0 into 0.
            forces[contacts + k] = faces[0] + faces[1] + 0.0;
            for (force, influence) in faces.iter().zip(&self.stages.influences[k]) {
                if *force != 0.0 {
                    add_multiple(outputs, *force, influence);
                }
            }
        }
        for (contact, force) in self.mechanism.friction_of_ends(hinges) {
            forces[contacts + contact] += force;
        }
        for (contact, per_force) in self.mechanism.excess.contacts.iter().zip(&self.stages.self_stresses) {
            add_multiple(outputs, forces[contact.index()], per_force);
        }
        for (contact, per_force) in &self.stages.openings {
            if pattern[*contact] == ContactState::Negative {
                add_multiple(outputs, state.unknowns[*contact], per_force);
            }
        }
        self.add_couples(hinges, outputs);
        for forces in forces.chunks_mut(contacts.max(1)) {
            self.mechanism.put_at_faces(pattern, forces, 0.0, |one, other| one + other);
        }
        if !forces.iter().chain(&*outputs).all(|number| number.is_finite()) {
            return None;
        }
        if !self.keeps(state, outputs)? {
            rows.numbers.truncate(start);
            counts.rejected += 1;
            return Some(());
        }
        rows.patterns.extend(pattern.iter().map(|state| match state {
            ContactState::Positive => b'+',
            ContactState::Negative => b'-',
            ContactState::Gap => b'0',
        }));
        let in_gap = !self.mechanism.excess.open.is_solution(pattern);
        let kind = if in_gap { RowKind::PreloadGap } else { RowKind::Solution };
        let negative_determinant = Some(state.negative_determinant);
        let verdict = self.verdict(pattern);
        let tips = !self.stages.openings.is_empty() && !self.mechanism.tipped(pattern).is_empty();
        rows.heads.push(RowHead {
            tips,
            kind,
            verdict,
            negative_determinant,
            ..head(point, PointStatus::None)
        });
        *if in_gap { &mut counts.gap_states } else { &mut counts.solutions } += 1;
        Some(())
    }

    /// Adds the friction couples of hinges to the outputs.
    fn add_couples(&self, hinges: &[HingeState], outputs: &mut [f64]) {
        for hinge in hinges {
            add_multiple(outputs, hinge.couple, &self.stages.couples[hinge.circle]);
        }
        for columns in &self.plan.columns.hinges {
            let own = hinges.iter().find(|hinge| hinge.circle == columns.circle);
            outputs[columns.output + 2] = own.map_or(0.0, |hinge| columns.sign * hinge.couple);
        }
    }

    /// Friction at both faces of a contact, eq. (2) with F_k = (mu_k |N_k| + F_k0) s_k.
    fn friction(&self, state: &SmallState, k: usize) -> [f64; 2] {
        let (in_gap, pressure) = match state.pattern[k] {
            ContactState::Gap => (Some(state.unknowns[k]), 0.0),
            _ => (None, state.unknowns[k]),
        };
        let share = positive_share(state.pattern[k], in_gap);
        self.mechanism.contacts[k].sliding(self.stages.signs[k], share, pressure)
    }

    /// Whether all guided sliders stay flat: |C| <= |N| L / 2 (theory, section 1); none if one is about to
    /// tip.
    fn keeps(&self, state: &SmallState, outputs: &[f64]) -> Option<bool> {
        let columns = &self.plan.columns;
        if columns.couples.is_empty() {
            return Some(true);
        }
        let forces = (0..columns.contacts).map(|k| state.normal_force(k).abs());
        let greatest = forces.fold(self.stages.greatest_load, f64::max);
        let mut keeps = true;
        for &CoupleColumn { joint, contact, output } in &columns.couples {
            let JointKind::Slider(slider) = &self.mechanism.joints[joint.index()].kind else { continue };
            let limit = slider.greatest_couple(state.normal_force(contact));
            let excess = outputs[output].abs() - limit;
            let tolerance = COUPLE_TOLERANCE * greatest * slider.length;
            if excess.abs() <= 4.0 * tolerance {
                return None;
            }
            keeps &= excess < 0.0;
        }
        Some(keeps)
    }

    /// The verdict on a solution, if it was asked for; states between the faces of determinate guides have none.
    fn verdict(&self, pattern: &[ContactState]) -> Verdict {
        let Some(guides) = &self.guides else { return Verdict::NotComputed };
        guides.verdict_on(pattern)
    }
}

/// Adds the contribution of a force or couple to outputs; what cancels is 0, not its rounding error.
fn add_multiple(outputs: &mut [f64], factor: f64, per_unit: &[f64]) {
    for (sum, per_unit) in outputs.iter_mut().zip(per_unit) {
        *sum = beside(*sum + factor * per_unit, sum.abs());
    }
}

/// With friction in hinges: numbers the states of each mode among the rows of a point, which begin with `first`.
pub(super) fn number_in_modes(plan: &Plan, first: usize, rows: &mut Rows) {
    if plan.columns.hinges.is_empty() {
        return;
    }
    for row in first..rows.len() {
        let has_state = !matches!(rows.heads[row].kind, RowKind::Nothing | RowKind::Undecided);
        let before = (first..row).filter(|&other| rows.pattern(other) == rows.pattern(row)).count();
        let place = (row + 1) * rows.width - 1;
        rows.numbers[place] = if has_state { (before + 1) as f64 } else { f64::NAN };
    }
}

/// The row of a point of which nothing else is known.
pub(super) fn head(point: Point<'_>, status: PointStatus) -> RowHead {
    let Point { number, breakpoint, inserted, .. } = point;
    RowHead { breakpoint, inserted, ..RowHead::of_point(number, status) }
}
