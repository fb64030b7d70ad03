//! A mechanism at one instant: how normal forces, sliding accelerations and couples answer to friction.

use super::assessment::Assessment;
use super::bounds::possible_sides;
use super::scale::{Scale, Share, rounding, scale};
use super::system::Question;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{BodyId, ContactId, Frame, JointId};
use crate::influence::Influence;
use crate::kinetics::{KineticEquations, Reaction, SlidingRow};
use crate::mechanism::{Contact, JointKind, Mechanism, Slider};
use crate::model::SliderKind;
use crate::motion::{ContactPhase, JointPhase, Phase};
use crate::pattern::Law;
use nalgebra::{DMatrix, DVector};
use std::borrow::Cow;

/// Influence coefficients (force for force) below this are rounding: the friction has no influence there.
const NO_INFLUENCE: f64 = 1e-13;
/// Versions of an influence column that differ by less than this multiple of it are the same.
const SAME: f64 = 1e-12;
/// Mobilities that cancel to within this multiple of themselves are zero.
const DEPENDENT: f64 = 1e-10;
/// Accelerations below this, in units, are zero.
const NO_ACCELERATION: f64 = 1e-10;

/// A joint nearer to its end stop than this, in sizes of the mechanism, touches it: rounding of places.
pub(in crate::motion) const TOUCHES: f64 = 1e-11;
/// A joint that only a force greater than this, in units, could keep from sliding cannot stick.
const GREATEST_FORCE: f64 = 1e8;
/// What is left of a normal force, in units, or of a share, where an event has found it to be zero; it is greater only where it
/// has no bounds.
const NEARLY_ZERO: f64 = 1e-4;

/// Units in which the numbers of a decision are of order one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    /// N, or N s for impulses.
    pub(super) force: f64,
    /// m
    pub(super) length: f64,
    /// m/s^2, or m/s for impulses.
    pub(super) acceleration: f64,
}

/// A sliding joint at the instant.
#[derive(Debug, Clone)]
pub(super) struct SlidingJoint {
    /// Which joint it is.
    pub(super) id: JointId,
    /// Its contacts.
    pub(super) contacts: Vec<usize>,
    /// Half the length of the pressed face of a guided slider, and the place of its couple among the unknowns.
    pub(super) couple: Option<(f64, usize)>,
    /// Its acceleration of sliding.
    pub(super) row: SlidingRow,
    /// Its sliding velocity (m/s).
    pub(super) velocity: f64,
    /// Whether any friction, or an end stop, could hold it.
    pub(super) has_friction: bool,
    /// The end stop that it touches: 1 at its greatest displacement, -1 at its least one, else 0.
    pub(super) stop: f64,
    /// Units of the bodies that joints connect with it.
    pub(super) units: Units,
}

/// Sliding joints that act on one another; no friction of another joint has any influence on them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Group {
    /// The joints.
    pub(super) joints: Vec<usize>,
    /// Their contacts.
    pub(super) contacts: Vec<usize>,
}

/// What is asked of all unknowns, as it answers to the friction forces: normal forces of the contacts, accelerations
/// of the sliding joints, couples of the guided sliders, in units.
#[derive(Debug, Clone)]
pub(super) struct Outputs {
    /// Without friction.
    pub(super) base: DVector<f64>,
    /// Added by a unit of friction at the faces of positive and of negative normal force; a column for each contact.
    pub(super) columns: [DMatrix<f64>; 2],
}

/// A mechanism at one instant.
#[derive(Debug, Clone)]
pub(super) struct Instant<'m> {
    /// The mechanism.
    pub(super) mechanism: &'m Mechanism,
    /// Its contacts, with the friction of their sliding speeds.
    contacts: Cow<'m, [Contact]>,
    /// Its kinetic equations.
    pub(super) equations: KineticEquations,
    /// How its unknowns answer to friction.
    pub(super) influence: Influence,
    /// Its sliding joints.
    pub(super) joints: Vec<SlidingJoint>,
    /// Units of the whole.
    pub(super) units: Units,
    /// The least units of force (N), of the whole and of what is connected with each joint.
    least_forces: Vec<f64>,
    /// What is asked of forces and accelerations.
    pub(super) outputs: Outputs,
    /// By how much these differ from the loads, see [`Self::vanish`].
    pub(super) shift: DVector<f64>,
    /// The sliding joints in groups that are decided separately.
    pub(super) groups: Vec<Group>,
}

impl<'m> Instant<'m> {
    /// A mechanism in a configuration, in units of its forces there.
    ///
    /// # Errors
    /// Whatever [`KineticEquations::new`] refuses, friction without a value.
    pub(super) fn new(mechanism: &'m Mechanism, configuration: &Configuration) -> Result<Self, Faults> {
        Self::of(mechanism, configuration, rounding)
    }

    /// The same in units of what the forces come to: those of the instant may vanish, and what they do next decides.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn looking_ahead(
        mechanism: &'m Mechanism,
        configuration: &Configuration,
    ) -> Result<Self, Faults> {
        Self::of(mechanism, configuration, scale)
    }

    fn of(mechanism: &'m Mechanism, configuration: &Configuration, least: Scale) -> Result<Self, Faults> {
        let equations = KineticEquations::new(mechanism, configuration)?;
        let influence = Influence::new(&equations);
        let mut joints = sliding_joints(mechanism, configuration, &equations);
        let mut least_forces = Vec::new();
        let now = Some((configuration, least));
        let units = set_units(mechanism, (&influence, &equations), now, (&mut joints, &mut least_forces));
        let outputs = outputs(mechanism, &influence, &joints);
        let groups = groups(&joints, &outputs);
        let shift = DVector::zeros(outputs.base.len());
        let contacts = contacts(mechanism, configuration, &equations)?;
        Ok(Self {
            mechanism,
            contacts,
            equations,
            influence,
            joints,
            units,
            least_forces,
            outputs,
            shift,
            groups,
        })
    }

    /// Takes over the loads at another time, where nothing has moved.
    ///
    /// # Errors
    /// Loads without a value.
    pub(super) fn change_loads(&mut self, configuration: &Configuration) -> Result<(), Faults> {
        self.equations.change_loads(self.mechanism, configuration)?;
        self.influence.frictionless = self.equations.without_noise(&self.equations.frictionless());
        let forces = (&self.influence, &self.equations);
        self.units = set_units(self.mechanism, forces, None, (&mut self.joints, &mut self.least_forces));
        self.outputs = outputs(self.mechanism, &self.influence, &self.joints);
        Ok(())
    }

    /// The question for accelerations, with joints whose velocity is zero: about all phases, or one, in which sides are open only if a joint
    /// sticks.
    pub(super) fn question<'q>(&'q self, stopped: &'q [bool], phase: Option<&Phase>) -> Question<'q> {
        let slides = phase.filter(|phase| !phase.joints.contains(&JointPhase::Sticking));
        Question {
            outputs: &self.outputs,
            wanted: vec![0.0; self.joints.len()],
            has_preload: true,
            sides: match slides {
                Some(phase) => phase.contacts.iter().map(|contact| vec![*contact]).collect(),
                None => possible_sides(self),
            },
            stopped,
            opposes: None,
        }
    }

    /// # Errors
    /// A fault if a list does not have one entry for each sliding joint.
    pub(super) fn check_joints(&self, found: usize) -> Result<(), Faults> {
        wrong_count("sliding joints", self.joints.len(), found)
    }

    /// # Errors
    /// A fault if a phase is not one of this mechanism.
    pub(super) fn check(&self, phase: &Phase) -> Result<(), Faults> {
        self.check_joints(phase.joints.len())?;
        wrong_count("contacts", self.mechanism.contacts.len(), phase.contacts.len())
    }

    /// The answer to friction impulses alone, without loads.
    pub(super) fn impulse_outputs(&self) -> Outputs {
        Outputs { base: DVector::zeros(self.outputs.base.len()), columns: self.outputs.columns.clone() }
    }

    /// The units of a contact.
    pub(super) fn units_of(&self, k: usize) -> Units {
        self.joint_of(k).map_or(self.units, |joint| self.joints[joint].units)
    }

    /// The sign of the acceleration of a joint that has no sliding velocity but passes: near a dead centre its acceleration comes
    /// from the geometry of the motion (or from a drive), and no force along its guide that could occur would change it.
    pub(super) fn passes(&self, joint: usize) -> Option<f64> {
        let acceleration = self.outputs.base[self.sliding_output(joint)];
        let holding_force = acceleration.abs() / self.mobility(joint, joint).abs();
        (acceleration.abs() > NO_ACCELERATION && holding_force > GREATEST_FORCE)
            .then(|| acceleration.signum())
    }

    /// Makes normal forces, or what is left of preload gaps, exactly zero in a state: its equations hold again with loads that
    /// differ by no more than what is left of them, and so do those of its neighbours, in which the contacts press on the other
    /// side.
    pub(super) fn vanish(&mut self, contacts: &[usize], state: &Assessment) {
        let mut shift = DVector::zeros(self.outputs.base.len());
        for &k in contacts {
            let Some(JointPhase::Sliding(sign)) = self.joint_of(k).map(|joint| state.phase.joints[joint])
            else {
                continue;
            };
            let law = self.law(k, true);
            let mut add = |amount: f64, faces: [[f64; 2]; 2]| {
                for (column, [factor, _]) in self.outputs.columns.iter().zip(faces) {
                    shift.axpy(amount * factor, &column.column(k), 1.0);
                }
            };
            match (state.phase.contacts[k], state.forces.shares[k]) {
                (ContactPhase::Pressed(side), _) if state.forces.normal[k].abs() <= NEARLY_ZERO => {
                    add(side.sign() * state.forces.normal[k], law.kinetic(side, sign));
                    shift[k] -= state.forces.normal[k];
                }
                (ContactPhase::PreloadGap, Some(share)) if (share - share.round()).abs() <= NEARLY_ZERO => {
                    add(share - share.round(), law.in_gap(sign));
                }
                _ => {}
            }
        }
        self.change_base(&shift);
    }

    /// Adds to what there is without friction, in units.
    pub(super) fn change_base(&mut self, shift: &DVector<f64>) {
        self.outputs.base += shift;
        self.shift += shift;
    }

    /// Whether a joint does not accelerate while others are held, whatever forces act.
    ///
    /// With `A_ij` the acceleration of joint i under a unit force along the guide of joint j (in the middle of the block)
    /// and `a` those without friction this is `A_jj - A_jH A_HH^-1 A_Hj = 0` and `a_j - A_jH A_HH^-1 a_H = 0`, by elimination
    /// with complete pivoting among the held joints H.
    pub(super) fn is_held(&self, joint: usize, held: &[usize]) -> bool {
        let joints: Vec<usize> = held.iter().copied().chain([joint]).collect();
        let last = held.len();
        let mut matrix = self.mobilities(&joints);
        let greatest = matrix.columns(0, joints.len()).amax();
        let own = matrix[(last, last)].abs();
        eliminate(&mut matrix, held.len(), DEPENDENT * greatest);
        let rest = matrix[(last, last)].abs();
        rest <= DEPENDENT * own.max(DEPENDENT * greatest) && matrix[(last, last + 1)].abs() <= NO_ACCELERATION
    }

    /// The number of joints whose motion depends on that of the others among them.
    pub(super) fn dependent(&self, joints: &[usize]) -> usize {
        let mut matrix = self.mobilities(joints);
        let greatest = matrix.columns(0, joints.len()).amax();
        joints.len() - eliminate(&mut matrix, joints.len(), DEPENDENT * greatest)
    }

    /// Whether two joints that begin to slide can do so with these signs: where the motion of one depends on that of the
    /// other the signs must agree.
    pub(super) fn can_begin_together(&self, [one, other]: [(usize, f64); 2]) -> bool {
        let ratio = self.mobility(other.0, one.0) * self.mobility(one.0, one.0);
        !self.is_held(other.0, &[one.0]) || ratio * one.1 * other.1 >= 0.0
    }

    /// Mobilities between joints, and in the last column their accelerations without friction.
    fn mobilities(&self, joints: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(joints.len(), joints.len() + 1, |i, j| match joints.get(j) {
            Some(pushed) => self.mobility(joints[i], *pushed),
            None => self.outputs.base[self.sliding_output(joints[i])],
        })
    }

    /// Acceleration of a sliding joint under a unit force along the guide of another one, in units.
    fn mobility(&self, joint: usize, pushed: usize) -> f64 {
        let Some(&k) = self.joints[pushed].contacts.first() else { return 0.0 };
        let row = self.sliding_output(joint);
        let [plus, minus] = [0, 1].map(|face| self.outputs.columns[face][(row, k)]);
        -f64::midpoint(plus, minus)
    }

    /// A contact by its number.
    pub(super) fn contact(&self, k: usize) -> &Contact {
        &self.contacts[k]
    }

    /// Coulomb's law of a contact, in units.
    pub(super) fn law(&self, k: usize, has_preload: bool) -> Law {
        let contact = self.contact(k);
        let holds = contact.mu_static.map(|mu| mu > 0.0);
        Law::new(self.mechanism, (k, contact), (self.units_of(k).force, has_preload), holds)
    }

    /// The mechanism with the friction of the sliding speeds.
    pub(super) fn mechanism_at_speeds(&self) -> Mechanism {
        let mut mechanism = self.mechanism.clone();
        mechanism.contacts = self.contacts.to_vec();
        mechanism
    }

    /// The sliding joint of a contact.
    pub(super) fn joint_of(&self, k: usize) -> Option<usize> {
        self.joints.iter().position(|joint| joint.contacts.contains(&k))
    }

    /// Where the acceleration of a sliding joint stands among the outputs.
    pub(super) fn sliding_output(&self, joint: usize) -> usize {
        self.mechanism.contacts.len() + joint
    }

    /// Where the couple of each guided slider stands among the outputs.
    pub(super) fn couple_outputs(&self) -> impl Iterator<Item = (usize, &SlidingJoint)> {
        let first = self.mechanism.contacts.len() + self.joints.len();
        let guided = self.joints.iter().filter(|joint| joint.couple.is_some());
        guided.enumerate().map(move |(index, joint)| (first + index, joint))
    }
}

/// Eliminates the leading square block of so many rows from all rows, with complete pivoting; its rank.
fn eliminate(matrix: &mut DMatrix<f64>, block: usize, zero: f64) -> usize {
    for step in 0..block {
        let rest = matrix.view((step, step), (block - step, block - step));
        let (row, column) = rest.iamax_full();
        if rest[(row, column)].abs() <= zero {
            return step;
        }
        matrix.swap_rows(step, step + row);
        matrix.swap_columns(step, step + column);
        for other in step + 1..matrix.nrows() {
            let factor = matrix[(other, step)] / matrix[(step, step)];
            for k in step..matrix.ncols() {
                matrix[(other, k)] -= factor * matrix[(step, k)];
            }
        }
    }
    block
}

fn wrong_count(what: &'static str, expected: usize, found: usize) -> Result<(), Faults> {
    if found == expected {
        return Ok(());
    }
    Err(Fault::general(FaultKind::WrongCount { what, expected, found }).into())
}

/// The contacts with the friction of their sliding speeds.
fn contacts<'m>(
    mechanism: &'m Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
) -> Result<Cow<'m, [Contact]>, Faults> {
    let mut contacts = Cow::Borrowed(&mechanism.contacts[..]);
    for k in (0..contacts.len()).filter(|&k| mechanism.contacts[k].depends_on_speed()) {
        let speed = equations.contacts[k].sliding_velocity.abs();
        contacts.to_mut()[k].mu =
            mechanism.friction_of(ContactId(k), speed, configuration.pieces.as_deref())?;
    }
    Ok(contacts)
}

/// The sliding joints of a mechanism, in the order of its joints.
fn sliding_joints(
    mechanism: &Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
) -> Vec<SlidingJoint> {
    let one = |(index, joint): (usize, &crate::mechanism::Joint)| {
        let JointKind::Slider(slider) = &joint.kind else { return None };
        let id = JointId(index);
        let contacts: Vec<usize> =
            slider.contacts.iter().map(|contact: &ContactId| contact.index()).collect();
        let place = equations.layout.reaction(Reaction::Couple(id));
        let first = contacts.first().map(|&k| equations.contacts[k].sliding_velocity);
        let has_friction = contacts.iter().any(|&k| {
            let contact = &mechanism.contacts[k];
            !contact.is_frictionless() || contact.mu_static != [0.0; 2]
        });
        let stop = touched_stop(mechanism, configuration, slider);
        Some(SlidingJoint {
            id,
            contacts,
            couple: place.map(|place| (slider.greatest_couple(1.0), place)),
            row: SlidingRow::new(mechanism, configuration, slider),
            velocity: first.unwrap_or(0.0),
            has_friction: has_friction || stop != 0.0,
            stop,
            units: Units { force: 1.0, length: mechanism.size, acceleration: 1.0 },
        })
    };
    mechanism.joints.iter().enumerate().filter_map(one).collect()
}

/// The end stop that a joint touches: 1 at its greatest displacement, -1 at its least one, else 0.
fn touched_stop(mechanism: &Mechanism, configuration: &Configuration, slider: &Slider) -> f64 {
    let Some([least, greatest]) = slider.travel.filter(|_| slider.restitution != [None; 2]) else {
        return 0.0;
    };
    let displacement = configuration.slide(mechanism, slider).displacement;
    let touches = |end: usize, limit: f64| {
        slider.restitution[end].is_some() && (displacement - limit).abs() <= TOUCHES * mechanism.size
    };
    if touches(1, greatest) {
        1.0
    } else if touches(0, least) {
        -1.0
    } else {
        0.0
    }
}

/// Gives the joints the units of the bodies that joints connect with them, so that nothing far away has a part in what is
/// small; the units of the whole. Their least forces are found anew or remain.
fn set_units(
    mechanism: &Mechanism,
    (influence, equations): (&Influence, &KineticEquations),
    least: Option<(&Configuration, Scale)>,
    (joints, least_forces): (&mut [SlidingJoint], &mut Vec<f64>),
) -> Units {
    let connected = connected(mechanism);
    let mut one = |counts: &dyn Fn(BodyId) -> bool, place: usize, otherwise: f64| {
        let (force, mass) = greatest(mechanism, (influence, equations), counts);
        if let Some((configuration, least)) = least {
            least_forces.push(least(mechanism, configuration, Share { counts, mass, force }));
        }
        units(mechanism.size, (force.max(least_forces[place]), mass), otherwise)
    };
    let whole = one(&|_| true, 0, 1.0);
    for (index, joint) in joints.iter_mut().enumerate() {
        let slider = mechanism.slider(joint.id);
        let body = slider.and_then(|slider| slider.block.body().or(slider.guide.body()));
        let part = body.map(|body| connected[body.index()]);
        joint.units = one(&|other| Some(connected[other.index()]) == part, index + 1, whole.force);
    }
    whole
}

/// The scale of the forces of a mechanism where those of the instant may vanish (N), see [`scale`]; 1 N where there never is any.
pub(in crate::motion) fn scale_of_forces(mechanism: &Mechanism, configuration: &Configuration) -> f64 {
    let length = mechanism.size;
    let masses = mechanism.bodies.iter();
    let masses = masses.map(|body| body.mass.max(body.moment_of_inertia / length.powi(2)));
    let mass = masses.fold(0.0, f64::max);
    let force = scale(mechanism, configuration, Share { counts: &|_| true, mass, force: 0.0 });
    units(length, (force, mass), 1.0).force
}

/// For each body a number that it shares with the bodies that are connected with it by joints.
fn connected(mechanism: &Mechanism) -> Vec<usize> {
    let mut parts: Vec<usize> = (0..mechanism.bodies.len()).collect();
    for joint in &mechanism.joints {
        let [one, other] = match &joint.kind {
            JointKind::Hinge([first, second]) => [first.frame, second.frame],
            JointKind::Slider(slider) => [slider.block, slider.guide],
        };
        if let (Some(one), Some(other)) = (one.body(), other.body()) {
            join(&mut parts, one.index(), other.index());
        }
    }
    parts
}

/// Puts what two members belong to together.
fn join(parts: &mut [usize], one: usize, other: usize) {
    let (kept, dissolved) = (parts[one], parts[other]);
    parts.iter_mut().filter(|part| **part == dissolved).for_each(|part| *part = kept);
}

/// The sliding joints in groups without influence on one another.
fn groups(joints: &[SlidingJoint], outputs: &Outputs) -> Vec<Group> {
    let mut parts: Vec<usize> = (0..joints.len()).collect();
    let contacts = outputs.columns[0].ncols();
    let mut couples = contacts + joints.len()..;
    for (index, joint) in joints.iter().enumerate() {
        let couple = joint.couple.and_then(|_| couples.next());
        let rows: Vec<usize> =
            joint.contacts.iter().copied().chain([contacts + index]).chain(couple).collect();
        for (other, rubbing) in joints.iter().enumerate() {
            let acts = |k: &usize| {
                outputs.columns.iter().any(|column| rows.iter().any(|row| column[(*row, *k)] != 0.0))
            };
            if parts[index] != parts[other] && rubbing.contacts.iter().any(acts) {
                join(&mut parts, index, other);
            }
        }
    }
    let mut groups: Vec<Group> = Vec::new();
    let mut place = vec![None; joints.len()];
    for (index, joint) in joints.iter().enumerate() {
        let group = *place[parts[index]].get_or_insert_with(|| {
            groups.push(Group { joints: Vec::new(), contacts: Vec::new() });
            groups.len() - 1
        });
        groups[group].joints.push(index);
        groups[group].contacts.extend(&joint.contacts);
    }
    groups
}

/// The greatest of the loads, preloads and forces of inertia of some bodies (N), and the greatest of their masses (kg).
fn greatest(
    mechanism: &Mechanism,
    (influence, equations): (&Influence, &KineticEquations),
    counts: &dyn Fn(BodyId) -> bool,
) -> (f64, f64) {
    let length = mechanism.size;
    let bodies = || mechanism.bodies.iter().enumerate().filter(|(index, _)| counts(BodyId(*index)));
    let masses = bodies().map(|(_, body)| body.mass.max(body.moment_of_inertia / length.powi(2)));
    let mass = masses.fold(0.0, f64::max);
    let belongs = |frame: Frame| frame.body().is_some_and(counts);
    let loads = equations.applied.iter().filter(|wrench| belongs(wrench.frame));
    let loads = loads.map(|wrench| wrench.force.norm().max(wrench.couple.abs() / length));
    let preloads = mechanism.contacts.iter().filter(|contact| {
        mechanism.slider(contact.joint).is_some_and(|slider| belongs(slider.block) || belongs(slider.guide))
    });
    let preloads = preloads.flat_map(|contact| contact.preload);
    let inertia = bodies().flat_map(|(index, body)| {
        let [x, y, turn] = [0, 1, 2].map(|part| influence.frictionless[3 * index + part]);
        [body.mass * x, body.mass * y, body.moment_of_inertia * turn / length]
    });
    (loads.chain(preloads).chain(inertia).map(f64::abs).fold(0.0, f64::max), mass)
}

/// Units in which the given force is one; where there is none, the other one.
fn units(length: f64, (force, mass): (f64, f64), otherwise: f64) -> Units {
    let force = if force > 0.0 && force.is_finite() { force } else { otherwise };
    Units { force, length, acceleration: if mass > 0.0 { force / mass } else { 1.0 } }
}

fn outputs(mechanism: &Mechanism, influence: &Influence, joints: &[SlidingJoint]) -> Outputs {
    let contacts = mechanism.contacts.len();
    let couples: Vec<(usize, f64)> = joints
        .iter()
        .filter_map(|joint| joint.couple.map(|(_, place)| (place, joint.units.force * joint.units.length)))
        .collect();
    let mut force = vec![1.0; contacts];
    for joint in joints {
        joint.contacts.iter().for_each(|&k| force[k] = joint.units.force);
    }
    let rows = contacts + joints.len() + couples.len();
    let unit = |row: usize| match row.checked_sub(contacts) {
        None => force[row],
        Some(joint) if joint < joints.len() => joints[joint].units.acceleration,
        Some(other) => couples[other - joints.len()].1,
    };
    let of = |unknowns: &DVector<f64>, normals: &DVector<f64>, row: usize| match row.checked_sub(contacts) {
        None => normals[row],
        Some(joint) if joint < joints.len() => joints[joint].row.change(unknowns),
        Some(other) => unknowns[couples[other - joints.len()].0],
    };
    let normals = influence.normal_forces();
    let base = DVector::from_fn(rows, |row, _| {
        let value = match row.checked_sub(contacts) {
            Some(joint) if joint < joints.len() => joints[joint].row.acceleration(&influence.frictionless),
            _ => of(&influence.frictionless, &normals, row),
        };
        value / unit(row)
    });
    let mut columns = [0, 1].map(|side| {
        let mut columns = DMatrix::zeros(rows, contacts);
        for (k, column) in influence.columns.iter().enumerate() {
            let normals = influence.normal_part(&column[side]);
            for row in 0..rows {
                let value = of(&column[side], &normals, row) * (force[k] / unit(row));
                columns[(row, k)] = if value.abs() <= NO_INFLUENCE { 0.0 } else { value };
            }
        }
        columns
    });
    make_equal(mechanism, &mut columns);
    Outputs { base, columns }
}

/// Makes both versions of a column equal where they are so in theory: for guided sliders, whose couple takes up the
/// moment of friction, and wherever that has no influence.
fn make_equal(mechanism: &Mechanism, columns: &mut [DMatrix<f64>; 2]) {
    let [positive, negative] = columns;
    for (k, contact) in mechanism.contacts.iter().enumerate() {
        let guided = mechanism.slider(contact.joint).is_some_and(|slider| slider.kind == SliderKind::Guided);
        let contacts = mechanism.contacts.len();
        let [plus, minus] = [&*positive, &*negative].map(|matrix| matrix.column(k).into_owned());
        let all = (&plus - &minus).amax() <= SAME * plus.amax();
        for row in 0..plus.len() {
            if all || (guided && row < contacts) {
                negative[(row, k)] = positive[(row, k)];
            }
        }
    }
}
