//! The patterns of states of contacts at rest: their equations and inequalities.

use super::{Pattern, Resting, RestingJoint, Start, TOLERANCE};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, Frame, JointId};
use crate::kinetics::Reaction;
use crate::mechanism::{Contact, Mechanism};
use crate::modes::ContactState;
use crate::pattern::{Affine, AffineExpression, AffineSet};
use crate::solve::friction::friction;
use nalgebra::{DMatrix, DVector};

/// The equations of a pattern, and its inequalities as functions of their unknowns: of the contacts, then of the friction of the
/// joints that stick.
pub(super) struct System {
    pub(super) pattern: Pattern,
    pub(super) base: DVector<f64>,
    pub(super) columns: Vec<DVector<f64>>,
    pub(super) sticking: Vec<Stuck>,
}

/// An unknown friction: of a joint that sticks, at one of its faces.
pub(super) struct Stuck {
    pub(super) joint: usize,
    /// The contacts that press there.
    pub(super) contacts: Vec<usize>,
    /// Whether it is the first of its joint, with whose row that no sliding begins stands.
    pub(super) is_first: bool,
}

/// The face that a contact presses: 0 where its normal force is positive.
pub(super) fn face_of(state: ContactState) -> usize {
    usize::from(state == ContactState::Negative)
}

impl Resting<'_> {
    /// All patterns of states, of which at most so many are tried.
    ///
    /// # Errors
    /// There are more.
    pub(super) fn patterns(&self, most: u64) -> Result<Vec<Pattern>, Faults> {
        use ContactState::{Negative, Positive};
        let contacts = self.answer.mechanism.contacts.len();
        let at_rest: Vec<usize> = self.joints.iter().flat_map(|joint| joint.contacts.clone()).collect();
        let of_joint = |joint: &RestingJoint| {
            let of_sides = 1_u64 << joint.contacts.len();
            if self.lifts_off(joint) { 3 * (of_sides - 1) + 1 } else { 3 * of_sides }
        };
        let sliding = u32::try_from(contacts - at_rest.len()).ok().and_then(|count| 2_u64.checked_pow(count));
        let states = self.joints.iter().map(of_joint).fold(sliding.unwrap_or(u64::MAX), u64::saturating_mul);
        if states > most {
            return Err(Fault::general(FaultKind::TooManyStates { states, limit: most }).into());
        }
        let first = Pattern { states: vec![Positive; contacts], starts: Vec::new() };
        let mut all = vec![first];
        for k in (0..contacts).filter(|k| !at_rest.contains(k)) {
            all = with_state(all, k, &[Positive, Negative]);
        }
        for joint in &self.joints {
            let mut next = Vec::new();
            for pattern in
                joint.contacts.iter().fold(all, |all, &k| with_state(all, k, &[Positive, Negative]))
            {
                let touches = joint.contacts.iter().any(|&k| !self.is_open(&pattern, k));
                let starts: &[Option<Start>] = if touches {
                    &[Some(Start::Sticks), Some(Start::Slips(1.0)), Some(Start::Slips(-1.0))]
                } else {
                    &[None]
                };
                next.extend(starts.iter().map(|start| {
                    let mut pattern = pattern.clone();
                    pattern.starts.push(*start);
                    pattern
                }));
            }
            all = next;
        }
        Ok(all)
    }

    /// The signs of the velocities with which contacts slide or begin to.
    pub(super) fn signs(&self, pattern: &Pattern) -> DVector<f64> {
        let mut signs = self.answer.velocity_signs.clone();
        for (joint, start) in self.joints.iter().zip(&pattern.starts) {
            let sign = if let Some(Start::Slips(sign)) = start { *sign } else { 0.0 };
            joint.contacts.iter().for_each(|&k| signs[k] = sign);
        }
        signs
    }

    /// The unknowns of the kinetic equations without the forces of a pattern, and what a unit of each adds.
    pub(super) fn system(&self, pattern: Pattern, mechanism: &Mechanism) -> System {
        let (influence, signs) = (self.answer.influence, self.signs(&pattern));
        let contacts = pattern.states.len();
        let shares = vec![None; contacts];
        let unknowns = |forces: &DVector<f64>| {
            influence.unknowns(&friction(mechanism, &signs, &pattern.states, forces, &shares), forces)
        };
        let base = unknowns(&DVector::zeros(contacts));
        let mut columns: Vec<DVector<f64>> = (0..contacts)
            .map(|k| {
                let mut forces = DVector::zeros(contacts);
                forces[k] = pattern.states[k].sign();
                unknowns(&forces) - &base
            })
            .collect();
        let sticking = self.sticking(&pattern);
        let of_friction = |Stuck { contacts, .. }: &Stuck| {
            influence.columns[contacts[0]][face_of(pattern.states[contacts[0]])].clone()
        };
        columns.extend(sticking.iter().map(of_friction));
        System { pattern, base, columns, sticking }
    }

    /// The unknown frictions of a pattern: one of each joint that sticks, two where both of its faces press at different heights.
    fn sticking(&self, pattern: &Pattern) -> Vec<Stuck> {
        let mut all = Vec::new();
        let starts = pattern.starts.iter().enumerate();
        for (joint, _) in starts.filter(|(_, start)| **start == Some(Start::Sticks)) {
            let RestingJoint { contacts, joint: id, .. } = &self.joints[joint];
            let closed = contacts.iter().copied().filter(|&k| !self.is_open(pattern, k));
            let is_flat = self.answer.mechanism.slider(*id).is_none_or(|slider| slider.height == 0.0);
            let (one, other): (Vec<usize>, Vec<usize>) =
                closed.partition(|&k| is_flat || face_of(pattern.states[k]) == 0);
            let faces = [one, other].into_iter().filter(|contacts| !contacts.is_empty()).enumerate();
            all.extend(faces.map(|(index, contacts)| Stuck { joint, contacts, is_first: index == 0 }));
        }
        all
    }

    /// The greatest friction of a contact at rest that presses with a force.
    pub(super) fn limit(&self, pattern: &Pattern, k: usize, force: f64) -> f64 {
        let (contact, face) = (&self.answer.mechanism.contacts[k], face_of(pattern.states[k]));
        contact.mu_static[face] * force + contact.preload[face]
    }

    /// Returns whether a joint at rest may lift off; others have two faces.
    fn lifts_off(&self, joint: &RestingJoint) -> bool {
        joint.contacts.iter().any(|&k| self.answer.mechanism.contacts[k].opens)
    }

    /// The equations of a pattern in units of force; none if they contradict each other.
    pub(super) fn equations(&self, system: &System) -> Option<AffineSet> {
        let force = self.force;
        let matrix = self.matrix(system);
        let contacts = system.pattern.states.len();
        let right = DVector::from_fn(matrix.nrows(), |row, _| match row.checked_sub(contacts) {
            None => -system.base[self.place(row)] / force,
            Some(stuck) => match system.sticking[stuck] {
                Stuck { joint, is_first: true, .. } => {
                    -self.joints[joint].rate(&system.base) / self.acceleration(joint)
                }
                Stuck { .. } => 0.0,
            },
        });
        AffineSet::of(matrix, right)
    }

    /// Rows of the normal forces, then of what sticks; a column for each unknown.
    pub(super) fn matrix(&self, system: &System) -> DMatrix<f64> {
        let contacts = system.pattern.states.len();
        let size = system.columns.len();
        DMatrix::from_fn(size, size, |row, column| match row.checked_sub(contacts) {
            None => {
                let of_itself = if row == column && !self.is_open(&system.pattern, row) {
                    system.pattern.states[row].sign()
                } else {
                    0.0
                };
                system.columns[column][self.place(row)] - of_itself
            }
            Some(stuck) => match system.sticking[stuck] {
                Stuck { joint, is_first: true, .. } => {
                    let change = self.joints[joint].row.change(&system.columns[column]);
                    change * self.force / self.acceleration(joint)
                }
                // Nothing says how both faces share it.
                Stuck { .. } => 0.0,
            },
        })
    }

    /// `slack >= 0` of a pattern, as functions of what its equations leave open; in units of force or of the joint's
    /// acceleration. Those that must not vanish are the first of the pair: what slips or opens without an acceleration sticks or
    /// touches.
    pub(super) fn slacks(&self, system: &System, set: &AffineSet) -> [Vec<Affine>; 2] {
        let contacts = system.pattern.states.len();
        let (open, closed): (Vec<usize>, Vec<usize>) =
            (0..contacts).partition(|&k| self.is_open(&system.pattern, k));
        let own = |list: Vec<usize>| -> Vec<AffineExpression> {
            list.into_iter().map(|k| AffineExpression::unknown(k, 1.0)).collect()
        };
        let (mut beginning, mut all) = (own(open), own(closed));
        for (unknown, stuck) in (contacts..).zip(&system.sticking) {
            let limit = stuck.contacts.iter().fold(AffineExpression::default(), |limit, &k| {
                let of_preload = self.limit(&system.pattern, k, 0.0);
                let of_force = self.limit(&system.pattern, k, 1.0) - of_preload;
                limit
                    .plus(of_force, &AffineExpression::unknown(k, 1.0))
                    .plus(1.0 / self.force, &AffineExpression::constant(of_preload))
            });
            all.extend(
                [1.0, -1.0].map(|sign| limit.clone().plus(sign, &AffineExpression::unknown(unknown, 1.0))),
            );
        }
        for (joint, start) in system.pattern.starts.iter().enumerate() {
            let Some(Start::Slips(sign)) = start else { continue };
            let unit = self.acceleration(joint);
            let row = &self.joints[joint].row;
            let at_zero = AffineExpression::constant(sign * self.joints[joint].rate(&system.base) / unit);
            beginning.push(system.columns.iter().enumerate().fold(at_zero, |slack, (unknown, column)| {
                slack.plus(
                    sign * row.change(column) * self.force / unit,
                    &AffineExpression::unknown(unknown, 1.0),
                )
            }));
        }
        [beginning, all].map(|slacks| slacks.iter().map(|slack| set.function(slack)).collect())
    }

    /// The determinant of a pattern over that without friction; none where the latter vanishes, as rows are dependent.
    pub(super) fn oriented(&self, system: &System) -> Option<f64> {
        let smooth = self.smooth.get_or_init(|| {
            let mut smooth = self.answer.mechanism.clone();
            smooth.multiply_friction_of_contacts(|_| 0.0);
            smooth
        });
        let smooth = self.system(system.pattern.clone(), smooth);
        let (matrix, without) = (self.matrix(system), self.matrix(&smooth));
        let of_smooth = without.determinant();
        if without.row_iter().any(|row| row.norm() <= TOLERANCE) {
            return None;
        }
        let size: f64 = without.row_iter().map(|row| row.norm()).product();
        let factor = self.scale(system) / self.scale(&smooth);
        (of_smooth.abs() > TOLERANCE * size).then(|| matrix.determinant() / of_smooth * factor)
    }

    /// Returns whether the signs of the oriented determinants tell if every load has exactly one state, which it has where those of all
    /// patterns are positive (Kuhn and Loewen 1987): nothing slides, static friction is kinetic friction, and no joint at rest has
    /// two faces, whose six states meet where it presses neither, more than that theorem allows.
    pub(super) fn may_be_unique(&self) -> bool {
        let has_one_law = |contact: &Contact| contact.mu == contact.mu_static;
        let slides =
            |k: usize| self.answer.velocity_signs[k] != 0.0 && self.answer.mechanism.contacts[k].may_hold();
        let contacts = &self.answer.mechanism.contacts;
        contacts.iter().all(has_one_law)
            && !(0..contacts.len()).any(slides)
            && self.joints.iter().all(|joint| self.lifts_off(joint))
    }

    /// By what the rows of a matrix are divided.
    pub(super) fn scale(&self, system: &System) -> f64 {
        system.sticking.iter().map(|stuck| self.acceleration(stuck.joint)).product()
    }

    pub(super) fn is_open(&self, pattern: &Pattern, k: usize) -> bool {
        self.answer.mechanism.contacts[k].opens && pattern.states[k] == ContactState::Negative
    }

    pub(super) fn place(&self, k: usize) -> usize {
        let place = self.answer.influence.layout().reaction(Reaction::Normal(ContactId(k)));
        place.expect("every contact has a normal force")
    }

    /// What the unit of force would do to the lighter body of a joint alone, beside which accelerations of sliding are
    /// rounding: what other joints hold moves by nothing else.
    pub(super) fn acceleration(&self, joint: usize) -> f64 {
        self.force / lighter_mass(self.answer.mechanism, self.joints[joint].joint)
    }
}

/// The mass of the lighter body of a joint; of other bodies where it has none, 1 kg if nothing has mass.
pub(super) fn lighter_mass(mechanism: &Mechanism, joint: JointId) -> f64 {
    let own = mechanism.slider(joint);
    let own = own.into_iter().flat_map(|slider| [slider.block, slider.guide]).filter_map(Frame::body);
    let least =
        |masses: &mut dyn Iterator<Item = f64>| masses.filter(|mass| *mass > 0.0).min_by(f64::total_cmp);
    least(&mut own.map(|body| mechanism.bodies[body.index()].mass))
        .or_else(|| least(&mut mechanism.bodies.iter().map(|body| body.mass)))
        .unwrap_or(1.0)
}

/// Each pattern with each of these states of a contact.
fn with_state(all: Vec<Pattern>, k: usize, states: &[ContactState]) -> Vec<Pattern> {
    let each = |pattern: Pattern| {
        states.iter().map(move |state| {
            let mut pattern = pattern.clone();
            pattern.states[k] = *state;
            pattern
        })
    };
    all.into_iter().flat_map(each).collect()
}
