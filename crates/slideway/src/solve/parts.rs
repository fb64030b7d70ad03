//! The mode problem of a model in numbers, with the couples of its guided sliders.

use super::distinct::agree;
use super::faces::{FreeFace, with_either_side};
use super::mode_problem::{ProblemData, overflow};
use super::tolerant::{StatesWithinTolerances, screened};
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::influence::Influence;
use crate::kinetics::{Accuracy, ConstraintRow, Reaction};
use crate::law::{positive_share, tips};
use crate::mechanism::Mechanism;
use crate::model::SliderKind;
use crate::modes::existence::{ModeProblemLine, OutputBound};
use crate::modes::{BySide, ContactState, ModeProblem, ModeProblemError, OpenContacts};
use crate::problem::rougher;
use crate::progress::Callback;
use nalgebra::{DMatrix, DVector};

/// A load that changes by less than this share of it does not change: each of its numbers has rounding errors
/// of its own.
const SAME: f64 = 1e-13;

/// Columns, jumps and right-hand side of eq. (6); below them those of the couples of guided sliders.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parts {
    columns: BySide<DMatrix<f64>>,
    /// The columns without friction that grows with the pressure.
    frictionless: BySide<DMatrix<f64>>,
    jumps: BySide<DMatrix<f64>>,
    right_hand_side: DVector<f64>,
    bounds: Vec<OutputBound>,
    has_jump: Vec<bool>,
    free_faces: Vec<Option<FreeFace>>,
    /// Whether the preload of a contact rubs at one face or the other.
    preload_jumps: Vec<bool>,
    /// Which contacts may be open, and together.
    open: OpenContacts,
}

impl Parts {
    /// The numbers of a mode problem, with the couples and then these functions of the unknowns as outputs.
    ///
    /// # Errors
    /// A fault if a number is beyond the range of floating point, or nothing says how redundant guides share
    /// their load.
    pub(super) fn new(data: ProblemData<'_>, others: Vec<ConstraintRow>) -> Result<Self, Faults> {
        let mechanism = data.mechanism;
        let contacts = mechanism.contacts.len();
        let (bounds, rows): (Vec<OutputBound>, Vec<usize>) =
            couples(mechanism, data.influence).into_iter().unzip();
        let outputs: Vec<ConstraintRow> =
            rows.into_iter().map(ConstraintRow::unknown).chain(others).collect();
        let coefficients = data.coefficients(&[], &outputs)?;
        let mut parts = Self {
            columns: coefficients.columns(),
            frictionless: rougher(&coefficients, &[], 0.0).columns(),
            jumps: coefficients.jumps(),
            right_hand_side: coefficients.right_hand_side(),
            bounds,
            has_jump: Vec::new(),
            free_faces: Vec::new(),
            preload_jumps: (0..contacts).map(|k| mechanism.preload_jumps(ContactId(k))).collect(),
            open: mechanism.excess.open.clone(),
        };
        parts.has_jump = parts.problem().map_err(|_| overflow())?.jumps_of_contacts();
        parts.free_faces = (0..contacts).map(|contact| data.free_face(&parts.has_jump, contact)).collect();
        Ok(parts)
    }

    /// The line of problems from this one at `t = 0` to another one at `t = 1`.
    pub(crate) fn line_to(&self, end: &Self) -> ModeProblemLine {
        let between = |one: &BySide<DMatrix<f64>>, other: &BySide<DMatrix<f64>>| {
            [one.clone(), BySide::of(|side| other.get(side) - one.get(side))]
        };
        let load = &end.right_hand_side - &self.right_hand_side;
        let slope = if load.amax() <= SAME * self.right_hand_side.amax() { load * 0.0 } else { load };
        ModeProblemLine {
            columns: between(&self.columns, &end.columns),
            jumps: between(&self.jumps, &end.jumps),
            right_hand_side: [self.right_hand_side.clone(), slope],
            bounds: self.bounds.clone(),
            has_jump: self.has_jump.iter().zip(&end.has_jump).map(|(one, other)| *one || *other).collect(),
            sides_differ: (0..self.free_faces.len())
                .map(|k| free_face([self, end].into_iter(), k) == Some(FreeFace::Nothing))
                .collect(),
            open: self.open.clone(),
        }
    }

    /// The patterns of a state by the faces at which preloads rub, where nothing tells it; `zero` has its
    /// contacts without normal force.
    pub(crate) fn faces(&self, pattern: &[ContactState], zero: &[usize]) -> Vec<Vec<ContactState>> {
        let is_free =
            |&k: &usize| pattern[k] != ContactState::Gap && self.free_faces[k] == Some(FreeFace::Nothing);
        let free: Vec<usize> = zero.iter().copied().filter(is_free).collect();
        with_either_side(pattern, &free)
    }

    /// The sum of others with these weights, of which there is at least one; none if they are not of one
    /// size.
    pub(crate) fn mixture(weighted: &[(f64, &Self)]) -> Option<Self> {
        let ((weight, first), others) = weighted.split_first()?;
        let mut sum = (*first).clone();
        let each = |matrix: fn(&mut Self) -> &mut DMatrix<f64>,
                    other: fn(&Self) -> &DMatrix<f64>,
                    sum: &mut Self| {
            *matrix(sum) *= *weight;
            others.iter().for_each(|(weight, parts)| {
                matrix(sum).zip_apply(other(parts), |own, other| *own += weight * other);
            });
        };
        if others.iter().any(|(_, parts)| parts.columns.positive.shape() != first.columns.positive.shape()) {
            return None;
        }
        each(|parts| &mut parts.columns.positive, |parts| &parts.columns.positive, &mut sum);
        each(|parts| &mut parts.columns.negative, |parts| &parts.columns.negative, &mut sum);
        each(|parts| &mut parts.frictionless.positive, |parts| &parts.frictionless.positive, &mut sum);
        each(|parts| &mut parts.frictionless.negative, |parts| &parts.frictionless.negative, &mut sum);
        each(|parts| &mut parts.jumps.positive, |parts| &parts.jumps.positive, &mut sum);
        each(|parts| &mut parts.jumps.negative, |parts| &parts.jumps.negative, &mut sum);
        let all = || weighted.iter().map(|(_, parts)| *parts);
        for k in 0..sum.has_jump.len() {
            sum.has_jump[k] = all().any(|parts| parts.has_jump[k]);
            sum.preload_jumps[k] = all().any(|parts| parts.preload_jumps[k]);
            sum.free_faces[k] = free_face(all(), k);
        }
        sum.right_hand_side *= *weight;
        others
            .iter()
            .for_each(|(weight, parts)| sum.right_hand_side.axpy(*weight, &parts.right_hand_side, 1.0));
        Some(sum)
    }

    /// The same contacts without friction that grows with their pressure.
    pub(crate) fn without_pressure_friction(&self) -> Self {
        Self { columns: self.frictionless.clone(), ..self.clone() }
    }

    /// Whether the states of two patterns with these normal forces are the same solution: equal forces and motion. Where
    /// a contact is between its faces in its play is neither; at which face its preload rubs is a force.
    pub(crate) fn is_same(
        &self,
        one: (&[ContactState], &DVector<f64>),
        other: (&[ContactState], &DVector<f64>),
    ) -> bool {
        let tells = |k: usize| self.preload_jumps[k] || self.free_faces[k] == Some(FreeFace::Nothing);
        agree(one.1.as_slice(), other.1.as_slice())
            && (0..one.0.len()).all(|k| one.0[k] == other.0[k] || !tells(k))
    }

    /// Whether the states of a pattern are solutions: each contact is pressed, or open.
    pub(crate) fn is_solution(&self, pattern: &[ContactState]) -> bool {
        self.open.is_solution(pattern)
    }

    /// Number of couples among the outputs, before all others.
    pub(crate) fn couples(&self) -> usize {
        self.bounds.len()
    }

    /// The mode problem alone, without couples.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub(crate) fn problem(&self) -> Result<ModeProblem, ModeProblemError> {
        let contacts = self.columns.positive.ncols();
        let upper = |matrix: &DMatrix<f64>| matrix.rows(0, contacts).into_owned();
        ModeProblem::new(
            upper(&self.columns.positive),
            upper(&self.columns.negative),
            upper(&self.jumps.positive),
            upper(&self.jumps.negative),
            self.right_hand_side.rows(0, contacts).into_owned(),
        )
    }

    /// Whether a guided slider would tip in a state: |C| > |N| L / 2 (theory, section 1); `shares` are those
    /// of contacts in their gaps.
    pub(crate) fn tips(
        &self,
        pattern: &[ContactState],
        normal_force: &DVector<f64>,
        shares: &[Option<f64>],
    ) -> bool {
        let contacts = pattern.len();
        self.bounds.iter().any(|bound| {
            let row = contacts + bound.output;
            let of_contact = |k: usize| {
                let positive = positive_share(pattern[k], shares[k]);
                let both = |by_side: &BySide<DMatrix<f64>>| {
                    positive * by_side.positive[(row, k)] + (1.0 - positive) * by_side.negative[(row, k)]
                };
                both(&self.jumps) - both(&self.columns) * normal_force[k].abs()
            };
            let terms: Vec<f64> = (0..contacts).map(of_contact).collect();
            let couple = self.right_hand_side[row] + terms.iter().sum::<f64>();
            let size = self.right_hand_side[row].abs() + terms.iter().map(|term| term.abs()).sum::<f64>();
            tips(couple, normal_force[bound.contact].abs() * bound.factor, size)
        })
    }

    /// Whether elimination excludes that a normal force vanishes, or nearly, in a solution of some pattern:
    /// then no contact is between its faces but in a pattern that says so.
    pub(crate) fn is_off_boundaries(&self, accuracy: Accuracy) -> bool {
        self.problem().is_ok_and(|problem| screened(&problem, &self.open, accuracy, |_| ()).is_some())
    }

    /// All states of the mode problem: by elimination, or by a search within tolerances where that leaves a pattern in
    /// doubt. Returns `None` if the numbers are not finite, or the search did not come to its end.
    pub(crate) fn states_within_tolerances(
        &self,
        callback: &mut Callback<'_>,
    ) -> Option<StatesWithinTolerances> {
        StatesWithinTolerances::of(&self.problem().ok()?, &self.open, callback)
    }

    /// The contacts of guided sliders whose couple alone tells at which face their preload rubs: only with
    /// one of these may there be a state between its faces that no sign pattern tells.
    pub(crate) fn with_free_faces(&self) -> Vec<usize> {
        let is_free = |contact: &usize| self.free_faces[*contact] == Some(FreeFace::Couple);
        self.bounds.iter().map(|bound| bound.contact).filter(is_free).collect()
    }

    /// How far a line from these numbers to others leads before they are changed by as much as they are: the
    /// share of the way at which a column, or the loads and jumps together, has become as great as its
    /// change. None if nothing changes.
    pub(crate) fn scale_of_change(&self, end: &Self) -> Option<f64> {
        let share = |start: f64, change: f64| (change > 0.0).then(|| start / change);
        let columns = [
            (&self.columns.positive, &end.columns.positive),
            (&self.columns.negative, &end.columns.negative),
        ];
        let columns = columns.into_iter().flat_map(|(start, end)| {
            let size = |column: usize| start.column(column).amax();
            (0..start.ncols()).filter_map(move |k| share(size(k), (end.column(k) - start.column(k)).amax()))
        });
        let right = |parts: &Self| {
            let jumps = parts.jumps.positive.amax().max(parts.jumps.negative.amax());
            parts.right_hand_side.amax().max(jumps)
        };
        let change = (&end.jumps.positive - &self.jumps.positive)
            .amax()
            .max((&end.jumps.negative - &self.jumps.negative).amax())
            .max((&end.right_hand_side - &self.right_hand_side).amax());
        columns.chain(share(right(self), change)).reduce(f64::min)
    }
}

/// What tells the face of a contact between several problems: what one of them has, they have.
fn free_face<'p>(all: impl Iterator<Item = &'p Parts> + Clone, k: usize) -> Option<FreeFace> {
    let is_told = all.clone().any(|parts| parts.has_jump[k]);
    all.map(|parts| parts.free_faces[k]).max().flatten().filter(|_| !is_told)
}

/// The bound of each guided slider's couple, and its row among the unknowns.
pub(super) fn couples(mechanism: &Mechanism, influence: &Influence) -> Vec<(OutputBound, usize)> {
    let mut couples = Vec::new();
    for (joint, slider) in mechanism.sliders() {
        let row = influence.layout().reaction(Reaction::Couple(joint));
        if let (SliderKind::Guided, Some(row), Some(contact)) = (slider.kind, row, slider.contacts.first()) {
            let bound = OutputBound {
                output: couples.len(),
                contact: contact.index(),
                factor: slider.greatest_couple(1.0),
            };
            couples.push((bound, row));
        }
    }
    couples
}

/// The couple of each contact about the middle of its pressed face, 0 of one that has none.
pub(super) fn contact_couples(
    mechanism: &Mechanism,
    influence: &Influence,
    unknowns: &DVector<f64>,
) -> Vec<f64> {
    let mut of_contacts = vec![0.0; mechanism.contacts.len()];
    for (bound, row) in couples(mechanism, influence) {
        of_contacts[bound.contact] = unknowns[row];
    }
    of_contacts
}
