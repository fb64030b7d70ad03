//! The mode problem of a model in numbers, with the couples of its guided sliders.

use super::distinct::agree;
use super::faces::{FreeFace, with_either_side};
use super::mode_problem::self_stresses;
use super::stages::ProblemData;
use super::tolerant::{StatesWithinTolerances, screened};
use crate::ids::{ContactId, JointId};
use crate::influence::Influence;
use crate::kinetics::{Accuracy, ConstraintRow, Reaction};
use crate::law::{positive_share, tips};
use crate::mechanism::{JointKind, Mechanism};
use crate::model::SliderKind;
use crate::modes::existence::{ModeProblemLine, OutputBound};
use crate::modes::{BySide, ContactState, ModeProblem, ModeProblemError, OpenContacts, Side};
use crate::pattern::face;
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
    pub(super) fn new(data: ProblemData<'_>, problem: &ModeProblem, others: Vec<ConstraintRow>) -> Self {
        let ProblemData { mechanism, influence, velocity_signs } = data;
        let contacts = problem.contacts();
        let couples = couples(mechanism, influence);
        let of_couples = couples.iter().map(|(_, row)| ConstraintRow::unknown(*row));
        let outputs: Vec<ConstraintRow> = of_couples.chain(others).collect();
        let rows = contacts + outputs.len();
        let extended = |upper: &DMatrix<f64>, below: &dyn Fn(&ConstraintRow, usize) -> f64| {
            DMatrix::from_fn(rows, contacts, |row, k| {
                if row < contacts { upper[(row, k)] } else { below(&outputs[row - contacts], k) }
            })
        };
        // C = C(0) + sum_k gamma_k F_k with F_k = (mu_k y_k + F_k0) s_k
        let cut = influence.layout().cut();
        let stress_of = |k: usize| cut.iter().position(|contact| contact.index() == k);
        let stresses = self_stresses(influence);
        // c_k^sigma = sigma e_k - sigma Z_k of a cut contact; the rows of self-stresses know no friction.
        let frictionless = |side: Side| {
            let upper = DMatrix::from_fn(contacts, contacts, |row, k| match (stress_of(row), stress_of(k)) {
                (Some(_), _) => problem.columns(side)[(row, k)],
                (None, stress) => {
                    let own = f64::from(u8::from(row == k));
                    side.sign() * stress.map_or(own, |stress| own - stresses[(row, stress)])
                }
            });
            extended(&upper, &|row, k| {
                stress_of(k).map_or(0.0, |stress| -side.sign() * row.times(&influence.self_stresses[stress]))
            })
        };
        let side = |side: Side| {
            let face = face(side);
            let gamma = |row: &ConstraintRow, k: usize| row.times(&influence.columns[k][face]);
            let columns = extended(problem.columns(side), &|row, k| {
                let friction = -gamma(row, k) * mechanism.contacts[k].mu[face] * velocity_signs[k];
                stress_of(k).map_or(friction, |stress| {
                    friction - side.sign() * row.times(&influence.self_stresses[stress])
                })
            });
            let jumps = extended(problem.jumps(side), &|row, k| {
                let contact = &mechanism.contacts[k];
                let of_faces = influence.columns[k].each_ref().map(|column| row.times(column));
                contact.preload_line.of_faces(of_faces)[face] * contact.preload[face] * velocity_signs[k]
            });
            (columns, jumps)
        };
        let ((cp, dp), (cn, dn)) = (side(Side::Positive), side(Side::Negative));
        let right_hand_side = DVector::from_fn(rows, |row, _| {
            if row < contacts {
                problem.right_hand_side()[row]
            } else {
                let output = &outputs[row - contacts];
                output.times(&influence.frictionless) - output.right_hand_side
            }
        });
        let has_jump = problem.jumps_of_contacts();
        Self {
            columns: BySide { positive: cp, negative: cn },
            frictionless: BySide {
                positive: frictionless(Side::Positive),
                negative: frictionless(Side::Negative),
            },
            jumps: BySide { positive: dp, negative: dn },
            right_hand_side,
            bounds: couples.into_iter().map(|(bound, _)| bound).collect(),
            free_faces: (0..contacts).map(|contact| data.free_face(&has_jump, contact)).collect(),
            has_jump,
            preload_jumps: (0..contacts).map(|k| mechanism.preload_jumps(ContactId(k))).collect(),
            open: mechanism.excess.open.clone(),
        }
    }

    /// The line of problems from this one at `t = 0` to another one at `t = 1`.
    pub(crate) fn line_to(&self, end: &Self) -> ModeProblemLine {
        let between = |one: &BySide<DMatrix<f64>>, other: &BySide<DMatrix<f64>>| {
            let slope = BySide {
                positive: &other.positive - &one.positive,
                negative: &other.negative - &one.negative,
            };
            [one.clone(), slope]
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
    for (index, joint) in mechanism.joints.iter().enumerate() {
        let JointKind::Slider(slider) = &joint.kind else { continue };
        let row = influence.layout().reaction(Reaction::Couple(JointId(index)));
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
