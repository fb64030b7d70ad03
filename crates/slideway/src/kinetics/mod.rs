//! The kinetic equations in descriptor form, eq. (1), and their factorization.
//!
//! Fourth stage of the pipeline: [`Mechanism`] and [`Configuration`] in, [`KineticEquations`] out.
//!
//! ```text
//! M a - G^T lambda - B u - sum_k W_k^side F_k = f(q, qd, t)      three equations for each body, six in space
//! G a                                         = gamma(q, qd)     one for each scalar constraint
//! C a                                         = prescribed       one for each drive
//! ```
//!
//! Unknown are the accelerations `a` of the bodies, the reactions `lambda` (hinge forces, normal forces,
//! couples) and the efforts `u` of the drives; the friction forces `F` are the parameters.
//!
//! In space the three accelerations out of the plane of each body, along z and about x and y, stand behind those in the plane.
//! They vanish, and their equations say what the joints carry:
//!
//! ```text
//! m a_z = F_z,     -D_x alpha + D_y omega^2 = M_x,     -D_y alpha - D_x omega^2 = M_y                          (S1)
//! ```
//!
//! Redundant guides leave as many reactions open as they have equations in excess. So many contacts are *cut*:
//! their rows of `G a = gamma`, which follow from the others, say `N = 0` instead, and what a unit of such a
//! normal force adds to all unknowns is a self-stress (force method).

mod elastic;
mod influences;
mod loads;
mod rows;
mod self_stress;
mod system;

pub(crate) use elastic::MasslessMotions;
pub(crate) use influences::{Accuracy, Elimination, Influences};
pub(crate) use loads::{Applied, unit_effort as effort_forces, velocity_of_effort};
pub use loads::{Wrench, load_wrenches};
pub(crate) use rows::{ConstraintRow, coordinates as coordinate_rows, sliding as sliding_row};

use crate::configuration::{Configuration, ContactGeometry, motion_in_words, moved_by};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{BodyId, ContactId, DriveId, Frame, JointId};
use crate::interval::Real;
use crate::mechanism::{CircleLaw, Contact, FrictionCircle, JointKind, Load, Mechanism, Slider};
use crate::model::SliderKind;
use nalgebra::{DMatrix, DVector, RowDVector, Vector2};
use self_stress::singular_position;
use system::{Factorization, Singular, Unfactored, without_noise};
pub(crate) use system::{equilibration, inverse_root, scaled};

/// Accelerations that violate the row of a cut contact by more than this part of its terms do not satisfy it.
const INCONSISTENT: f64 = 1e-9;

/// Meaning of a component of the vector of reactions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reaction {
    /// Component of a hinge force on the first body: 0 along x, 1 along y (N).
    Hinge(JointId, usize),
    /// Normal force of a contact on the block, along n (N).
    Normal(ContactId),
    /// Couple of a guided slider on the block about the middle of the pressed face (N m).
    Couple(JointId),
    /// What a joint carries out of the drawing without friction, on its first body or the block: 0 a force along z (N), 1 and
    /// 2 a couple about the direction of sliding and about the normal, for hinges about x and y (N m).
    Carried(JointId, usize),
}

/// What the acceleration of the gap of a contact that lifts off does, per unit of the force that it takes there. Drives that
/// act elsewhere than they move may reverse this force.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Opening<T = f64> {
    /// The contact.
    pub(crate) contact: usize,
    /// What is added to all unknowns; 1 or -1 to its own normal force.
    pub(crate) answer: DVector<T>,
    /// The acceleration itself (m/s^2 per N).
    pub(crate) acceleration: T,
}

/// Where the unknowns stand in their vector: accelerations, reactions, efforts of the drives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    bodies: usize,
    accelerations: usize,
    reactions: Vec<Reaction>,
    drives: usize,
    /// The contacts that are cut: their normal forces are given, not found.
    cut: Vec<ContactId>,
    /// The contacts that may lift off.
    one_sided: Vec<ContactId>,
}

impl Layout {
    /// The unknowns of a mechanism.
    pub(crate) fn of<T: Real>(mechanism: &Mechanism<T>) -> Self {
        let mut reactions = Vec::new();
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let id = JointId(index);
            match &joint.kind {
                JointKind::Hinge(_) => reactions.extend([Reaction::Hinge(id, 0), Reaction::Hinge(id, 1)]),
                JointKind::Slider(slider) => {
                    reactions.extend(slider.contacts.iter().map(|contact| Reaction::Normal(*contact)));
                    if slider.kind == SliderKind::Guided {
                        reactions.push(Reaction::Couple(id));
                    }
                }
            }
            let carried = (0..3).filter(|&component| mechanism.carries(joint, component));
            reactions.extend(carried.map(|component| Reaction::Carried(id, component)));
        }
        let accelerations = mechanism.accelerations();
        let (cut, one_sided) = (mechanism.excess.contacts.clone(), mechanism.one_sided().collect());
        let (bodies, drives) = (mechanism.bodies.len(), mechanism.drives.len());
        Self { bodies, accelerations, reactions, drives, cut, one_sided }
    }

    /// Contacts that are cut because redundant guides share a load, one for each self-stress.
    pub fn cut(&self) -> &[ContactId] {
        &self.cut
    }

    fn is_cut(&self, reaction: Reaction) -> bool {
        matches!(reaction, Reaction::Normal(contact) if self.cut.contains(&contact))
    }

    /// Indices of the efforts of all drives.
    pub(crate) fn efforts(&self) -> std::ops::Range<usize> {
        self.len() - self.drives..self.len()
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.accelerations + self.reactions.len() + self.drives
    }

    /// Whether there are no unknowns.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The reactions in their order.
    pub fn reactions(&self) -> &[Reaction] {
        &self.reactions
    }

    /// Index of a body's acceleration along x; those along y and of rotation follow.
    pub fn acceleration(&self, body: BodyId) -> usize {
        3 * body.index()
    }

    /// Number of accelerations, which are the first of the unknowns: those in the plane, then those out of it.
    pub fn accelerations(&self) -> usize {
        self.accelerations
    }

    /// Whether an acceleration is one of rotation.
    pub(crate) fn is_rotation(&self, acceleration: usize) -> bool {
        if acceleration < 3 * self.bodies { acceleration % 3 == 2 } else { !acceleration.is_multiple_of(3) }
    }

    /// Index of a reaction, if the mechanism has it.
    pub fn reaction(&self, reaction: Reaction) -> Option<usize> {
        let index = self.reactions.iter().position(|other| *other == reaction)?;
        Some(self.accelerations + index)
    }

    /// The right-hand sides with one cut normal force of one each.
    pub(crate) fn cut_units<T: Real>(&self) -> Vec<DVector<T>> {
        self.units(&self.cut)
    }

    /// The right-hand sides with one acceleration of the gap of a contact that may lift off each, of one.
    pub(crate) fn opening_units<T: Real>(&self) -> Vec<DVector<T>> {
        self.units(&self.one_sided)
    }

    fn units<T: Real>(&self, contacts: &[ContactId]) -> Vec<DVector<T>> {
        let unit = |contact: &ContactId| {
            let mut unit = DVector::zeros(self.len());
            unit[self.reaction(Reaction::Normal(*contact))?] = T::one();
            Some(unit)
        };
        contacts.iter().filter_map(unit).collect()
    }

    /// The contacts that may lift off.
    pub(crate) fn one_sided(&self) -> &[ContactId] {
        &self.one_sided
    }

    /// The openings of the contacts that may lift off, from what a unit acceleration of the gap of each adds to all unknowns.
    pub(crate) fn openings<T: Real>(&self, answers: Vec<DVector<T>>) -> Vec<Opening<T>> {
        let of_contact = |(contact, answer): (&ContactId, DVector<T>)| {
            let at = self.reaction(Reaction::Normal(*contact))?;
            let (size, sign) = (answer[at].abs(), answer[at].sign_value());
            let mut answer = answer.map(|value| value / size);
            answer[at] = sign;
            Some(Opening { contact: contact.index(), acceleration: T::one() / size, answer })
        };
        self.one_sided.iter().zip(answers).filter_map(of_contact).collect()
    }

    /// Index of a drive's effort.
    pub fn effort(&self, drive: DriveId) -> usize {
        self.accelerations + self.reactions.len() + drive.index()
    }
}

/// The kinetic equations of a mechanism in a configuration, factored.
#[derive(Debug, Clone)]
pub struct KineticEquations {
    /// Where the unknowns stand.
    pub(crate) layout: Layout,
    /// The contacts in this configuration.
    pub contacts: Vec<ContactGeometry>,
    /// All that acts on the bodies besides reactions and friction: weights and loads.
    pub applied: Vec<Wrench>,
    /// Right-hand side without friction: f, gamma, prescribed accelerations.
    load: DVector<f64>,
    /// Unit friction of each contact at its face where the normal force is positive, and where it is
    /// negative.
    friction: Vec<[DVector<f64>; 2]>,
    /// Unit friction couple of each friction circle.
    couples: Vec<DVector<f64>>,
    factorization: Factorization,
    coordinate_rows: Vec<ConstraintRow>,
}

impl KineticEquations {
    /// The equations of a mechanism in a configuration.
    ///
    /// # Errors
    /// Loads without a value or direction; a motion without inertia; drives that cannot produce their motion;
    /// equations too ill-conditioned to be solved.
    pub fn new(mechanism: &Mechanism, configuration: &Configuration) -> Result<Self, Faults> {
        Self::new_while(mechanism, configuration, &mut || true)
    }

    /// [`Self::new`]; a fault once `proceed`, which is asked during the elimination of many bodies, is `false`.
    ///
    /// # Errors
    /// As [`Self::new`], or [`FaultKind::WorkEnded`].
    pub(crate) fn new_while(
        mechanism: &Mechanism,
        configuration: &Configuration,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Faults> {
        Self::factored(mechanism, configuration, |matrix| Factorization::new(matrix, proceed))
    }

    /// The equations of the same mechanism in a configuration close to this one, in the same scales.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn near(&self, mechanism: &Mechanism, configuration: &Configuration) -> Result<Self, Faults> {
        Self::factored(mechanism, configuration, |matrix| self.factorization.near(matrix))
    }

    fn factored(
        mechanism: &Mechanism,
        configuration: &Configuration,
        factor: impl FnOnce(DMatrix<f64>) -> Result<Factorization, Unfactored>,
    ) -> Result<Self, Faults> {
        let assembled = Assembled::new(mechanism, configuration)?;
        let Assembled {
            layout,
            contacts,
            applied,
            matrix,
            load,
            friction,
            couples,
            coordinate_rows,
            cut_rows,
        } = assembled;
        let factorization = factor(matrix).map_err(|unfactored| match unfactored {
            Unfactored::Singular(singular) => {
                Builder { mechanism, configuration, layout: &layout }.singular_fault(&singular, &load)
            }
            Unfactored::Ended => Fault::general(FaultKind::WorkEnded),
        })?;
        let equations =
            Self { layout, contacts, applied, load, friction, couples, factorization, coordinate_rows };
        equations.check_cut_rows(mechanism, &cut_rows)?;
        equations.check_open(mechanism, configuration)?;
        Ok(equations)
    }

    /// Returns whether what moves once all contacts that may lift off are open has inertia.
    fn check_open(&self, mechanism: &Mechanism, configuration: &Configuration) -> Result<(), Faults> {
        let contacts: Vec<usize> = self.layout.one_sided.iter().map(|contact| contact.index()).collect();
        let Some(first) = contacts.first() else { return Ok(()) };
        let Err(faults) = Self::new(&mechanism.without_contacts(&contacts), configuration) else {
            return Ok(());
        };
        let without_inertia = faults.sorted().into_iter().find_map(|fault| match &fault.kind {
            FaultKind::MotionWithoutInertia { motion } => Some(motion.clone()),
            _ => None,
        });
        let Some(motion) = without_inertia else { return Err(faults) };
        let contacts = contacts.iter().map(|&k| mechanism.contacts[k].name.to_string()).collect();
        let place = mechanism.joints[mechanism.contacts[*first].joint.index()].place.clone();
        Err(Fault::new(FaultKind::LiftsWithoutInertia { contacts, motion }, place).into())
    }

    /// Whether the motion satisfies the rows of the contacts that are cut, too: their excess persists.
    fn check_cut_rows(&self, mechanism: &Mechanism, cut_rows: &[ConstraintRow]) -> Result<(), Faults> {
        if cut_rows.is_empty() {
            return Ok(());
        }
        let motion = self.without_noise(&self.frictionless());
        // As an acceleration, of which rows are sums: components of unit vectors, and lengths times rotations.
        let in_metres = |index: usize| if index % 3 == 2 { mechanism.size } else { 1.0 };
        let greatest = (0..3 * mechanism.bodies.len())
            .map(|index| (motion[index] * in_metres(index)).abs())
            .fold(0.0, f64::max);
        let violated = |row: &&ConstraintRow| {
            let error = (row.times(&motion) - row.right_hand_side).abs();
            error > INCONSISTENT * (greatest + row.right_hand_side.abs())
        };
        let cut = self.layout.cut.iter().zip(cut_rows);
        let violated: Vec<ContactId> =
            cut.filter(|(_, row)| violated(row)).map(|(contact, _)| *contact).collect();
        if violated.is_empty() { Ok(()) } else { Err(singular_position(mechanism, &violated)) }
    }

    /// Returns the self-stresses: the contribution of a unit normal force of each cut contact to all
    /// unknowns.
    pub fn self_stresses(&self) -> Vec<DVector<f64>> {
        self.answers(&self.layout.cut_units())
    }

    /// Returns the contribution of a unit acceleration of the gap of each contact that may lift off to all unknowns.
    pub(crate) fn gap_accelerations(&self) -> Vec<DVector<f64>> {
        self.answers(&self.layout.opening_units())
    }

    /// The unknowns for each of these right-hand sides, without their rounding.
    fn answers(&self, units: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let solutions = self.factorization.solve(&units.iter().collect::<Vec<_>>());
        solutions.iter().map(|solution| self.without_noise(solution)).collect()
    }

    /// Returns the contribution of a load alone to the unknowns.
    ///
    /// # Errors
    /// A load without a value or direction.
    pub(crate) fn answer_to(
        &self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        load: &Load,
    ) -> Result<DVector<f64>, Fault> {
        let mut forces = DVector::zeros(self.load.len());
        for wrench in &load_wrenches(mechanism, configuration, load)? {
            wrench.add_to(mechanism, configuration, |row, value| forces[row] += value);
        }
        Ok(self.without_noise(&self.factorization.solve(&[&forces])[0]))
    }

    /// The unknowns without friction.
    pub fn frictionless(&self) -> DVector<f64> {
        self.factorization.solve(&[&self.load]).remove(0)
    }

    /// The unknowns with these friction forces at both faces of each contact, these couples of friction circles and these
    /// accelerations of gaps, after a step of iterative refinement. It takes out what rounding has left of great forces that cancel where contacts are open.
    pub(crate) fn refined(
        &self,
        unknowns: &DVector<f64>,
        frictions: impl Iterator<Item = [f64; 2]>,
        couples: impl Iterator<Item = (usize, f64)>,
        gaps: impl Iterator<Item = (ContactId, f64)>,
    ) -> DVector<f64> {
        let mut left = self.load.clone();
        for (columns, faces) in self.friction.iter().zip(frictions) {
            columns.iter().zip(faces).for_each(|(column, friction)| left.axpy(friction, column, 1.0));
        }
        couples.for_each(|(circle, couple)| left.axpy(couple, &self.couples[circle], 1.0));
        for (contact, acceleration) in gaps {
            if let Some(place) = self.layout.reaction(Reaction::Normal(contact)) {
                left[place] += acceleration;
            }
        }
        left.gemv(-1.0, self.factorization.matrix(), unknowns, 1.0);
        unknowns + self.factorization.solve(&[&left]).remove(0)
    }

    /// The unknowns with every component set to zero that is below the rounding errors of the solution.
    pub fn without_noise(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        without_noise(unknowns, self.factorization.column_scale())
    }

    /// Estimate of how much rounding is amplified: ratio of the greatest to the least pivot.
    pub fn condition(&self) -> f64 {
        self.factorization.condition()
    }

    /// Accelerations of the chosen coordinates that belong to accelerations of the bodies.
    pub fn coordinate_accelerations(&self, unknowns: &DVector<f64>) -> Vec<f64> {
        self.coordinate_rows.iter().map(|row| row.acceleration(unknowns, false)).collect()
    }

    /// Jumps of the rates of the chosen coordinates that belong to jumps of the bodies' velocities.
    pub(crate) fn coordinate_jumps(&self, unknowns: &DVector<f64>) -> Vec<f64> {
        self.coordinate_rows.iter().map(|row| row.times(unknowns)).collect()
    }
}

/// Returns the acceleration of the gap of a contact that belongs to the unknowns (m/s^2).
pub(crate) fn gap_acceleration(
    mechanism: &Mechanism,
    configuration: &Configuration,
    contacts: &[ContactGeometry],
    (contact, unknowns): (ContactId, &DVector<f64>),
) -> f64 {
    let mut row = ConstraintRow::empty();
    row.set_constraint(mechanism, configuration, contacts, Reaction::Normal(contact));
    row.times(unknowns) - row.right_hand_side
}

/// The row that gives the acceleration of sliding of a joint, the block's material point against the guide's
/// along u.
#[derive(Debug, Clone)]
pub(crate) struct SlidingRow(ConstraintRow);

impl SlidingRow {
    /// The row of a sliding joint in a configuration.
    pub(crate) fn new(mechanism: &Mechanism, configuration: &Configuration, slider: &Slider) -> Self {
        Self(rows::sliding(mechanism, configuration, slider))
    }

    /// The row of the acceleration of the gap of a contact that is apart from its face.
    pub(crate) fn of_gap(
        mechanism: &Mechanism,
        configuration: &Configuration,
        (slider, contact): (&Slider, &Contact),
    ) -> Self {
        let mut row = ConstraintRow::empty();
        let geometry = configuration.geometry(mechanism, slider, contact);
        row.normal(mechanism, configuration, contact.joint, &geometry);
        Self(row)
    }

    /// Returns the contribution of these changes of the unknowns to the acceleration (m/s^2), or to the
    /// velocity (m/s) if they are impulses.
    pub(crate) fn change(&self, unknowns: &DVector<f64>) -> f64 {
        self.0.times(unknowns)
    }

    /// The part of the velocities in the acceleration of sliding (m/s^2).
    pub(crate) fn of_velocities(&self) -> f64 {
        -self.0.right_hand_side
    }

    /// The row with its right-hand side.
    pub(crate) fn into_equation(self) -> ConstraintRow {
        self.0
    }

    /// The acceleration of sliding that belongs to the unknowns (m/s^2), the velocities' part included.
    pub(crate) fn acceleration(&self, unknowns: &DVector<f64>) -> f64 {
        self.change(unknowns) + self.of_velocities()
    }
}

/// The kinetic equations of a mechanism in a configuration, not factored: rounded, or within intervals.
#[derive(Debug, Clone)]
pub(crate) struct Assembled<T> {
    /// Where the unknowns stand.
    pub(crate) layout: Layout,
    /// The contacts in this configuration.
    pub(crate) contacts: Vec<ContactGeometry<T>>,
    /// Weights and loads.
    pub(crate) applied: Vec<Wrench<T>>,
    /// [[M, -G^T, -B], [G, 0, 0], [C, 0, 0]]
    pub(crate) matrix: DMatrix<T>,
    /// Right-hand side without friction: f, gamma, prescribed accelerations.
    pub(crate) load: DVector<T>,
    /// Unit friction of each contact at its face where the normal force is positive, and where it is
    /// negative.
    pub(crate) friction: Vec<[DVector<T>; 2]>,
    /// Unit friction couple of each friction circle, on the first body of its hinge; the opposite one is on the second.
    pub(crate) couples: Vec<DVector<T>>,
    /// The rows that give the accelerations of the chosen coordinates: C a - right-hand side.
    pub(crate) coordinate_rows: Vec<ConstraintRow<T>>,
    /// The rows of the contacts that are cut, which are not in the matrix.
    pub(crate) cut_rows: Vec<ConstraintRow<T>>,
}

impl<T: Real> Assembled<T> {
    /// The equations of a mechanism in a configuration.
    ///
    /// # Errors
    /// Loads without a value or direction.
    pub(crate) fn new(mechanism: &Mechanism<T>, configuration: &Configuration<T>) -> Result<Self, Faults> {
        mechanism.check_one_sided_in_excess()?;
        Self::at_rest(mechanism, configuration)
    }

    /// The same where contacts that may lift off may carry each other, whose forces at rest are ranges.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn at_rest(
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
    ) -> Result<Self, Faults> {
        let layout = Layout::of(mechanism);
        let contacts: Vec<ContactGeometry<T>> =
            (0..mechanism.contacts.len()).map(|k| configuration.contact(mechanism, ContactId(k))).collect();
        let mut applied = Applied::new();
        applied.fill(mechanism, configuration)?;
        let applied = applied.wrenches;
        let mut constraints = rows::constraints(mechanism, configuration, &contacts, &layout);
        let coordinate_rows = rows::coordinates(mechanism, configuration);
        let builder = Builder { mechanism, configuration, layout: &layout };
        let mut matrix = builder.matrix(&constraints, &coordinate_rows);
        let cut_rows = builder.cut(&mut matrix, &mut constraints);
        let load = builder.load(&applied, &constraints, &coordinate_rows)?;
        let friction = (0..contacts.len()).map(|k| builder.friction(ContactId(k), &contacts[k])).collect();
        let couples = mechanism
            .friction_circles
            .iter()
            .map(|circle| builder.friction_couple(circle, &contacts))
            .collect();
        Ok(Self { layout, contacts, applied, matrix, load, friction, couples, coordinate_rows, cut_rows })
    }

    /// The row of a contact: the acceleration of its gap is this row times all unknowns, less its right-hand side. The row of
    /// one that is cut, too.
    pub(crate) fn gap(&self, contact: ContactId) -> Option<(RowDVector<T>, T)> {
        let place = self.layout.reaction(Reaction::Normal(contact))?;
        let Some(cut) = self.layout.cut.iter().position(|cut| *cut == contact) else {
            return Some((self.matrix.row(place).into_owned(), self.load[place]));
        };
        let row = &self.cut_rows[cut];
        let mut entries = RowDVector::zeros(self.layout.len());
        row.entries.iter().for_each(|&(column, value)| entries[column] += value);
        Some((entries, row.right_hand_side))
    }

    /// The rows that give the accelerations of the chosen coordinates, where every velocity is zero.
    pub(crate) fn coordinate_rows(&self) -> impl Iterator<Item = &[(usize, T)]> {
        self.coordinate_rows.iter().map(|row| row.entries.as_slice())
    }
}

struct Builder<'a, T = f64> {
    mechanism: &'a Mechanism<T>,
    configuration: &'a Configuration<T>,
    layout: &'a Layout,
}

impl<T: Real> Builder<'_, T> {
    /// [[M, -G^T, -B], [G, 0, 0], [C, 0, 0]]
    fn matrix(&self, constraints: &[ConstraintRow<T>], coordinates: &[ConstraintRow<T>]) -> DMatrix<T> {
        let size = self.layout.len();
        let mut matrix = DMatrix::zeros(size, size);
        each_inertia(self.mechanism, self.configuration, |row, column, value| matrix[(row, column)] += value);
        let first = self.layout.accelerations;
        for (index, row) in constraints.iter().enumerate() {
            for &(column, value) in &row.entries {
                matrix[(first + index, column)] += value;
                matrix[(column, first + index)] -= value;
            }
        }
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            let effort = self.layout.effort(DriveId(index));
            for &(column, value) in &coordinates[drive.coordinate.index()].entries {
                matrix[(effort, column)] += value;
            }
            for wrench in loads::unit_effort(self.mechanism, self.configuration, &drive.effort) {
                wrench
                    .add_to(self.mechanism, self.configuration, |row, value| matrix[(row, effort)] -= value);
            }
        }
        matrix
    }

    /// Replaces the rows of the contacts that are cut by N = 0, and gives them.
    fn cut(&self, matrix: &mut DMatrix<T>, constraints: &mut [ConstraintRow<T>]) -> Vec<ConstraintRow<T>> {
        let first = self.layout.accelerations;
        let cut = |contact: &ContactId| {
            let place = self.layout.reaction(Reaction::Normal(*contact))?;
            let row = std::mem::replace(&mut constraints[place - first], ConstraintRow::empty());
            for &(column, _) in &row.entries {
                matrix[(place, column)] = T::zero();
            }
            matrix[(place, place)] = T::one();
            Some(row)
        };
        self.layout.cut.iter().filter_map(cut).collect()
    }

    fn load(
        &self,
        applied: &[Wrench<T>],
        constraints: &[ConstraintRow<T>],
        coordinates: &[ConstraintRow<T>],
    ) -> Result<DVector<T>, Faults> {
        let mut load = DVector::zeros(self.layout.len());
        for wrench in applied {
            wrench.add_to(self.mechanism, self.configuration, |row, value| load[row] += value);
        }
        each_spin(self.mechanism, self.configuration, |row, value| load[row] += value);
        let first = self.layout.accelerations;
        for (index, row) in constraints.iter().enumerate() {
            load[first + index] = row.right_hand_side;
        }
        let mut faults = Faults::default();
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            match self.configuration.quantity(self.mechanism, drive.acceleration) {
                Ok(prescribed) => {
                    let bias = coordinates[drive.coordinate.index()].right_hand_side;
                    load[self.layout.effort(DriveId(index))] = prescribed + bias;
                }
                Err(fault) => faults.push(fault),
            }
        }
        faults.or(load)
    }

    /// W_k^{+} and W_k^{-}: a unit friction force, -u on the block and u on the guide, at the pressed face
    /// P - sign(N) (h/2) n.
    fn friction(&self, id: ContactId, contact: &ContactGeometry<T>) -> [DVector<T>; 2] {
        [T::one(), -T::one()].map(|sign| {
            let mut column = DVector::zeros(self.layout.len());
            for wrench in friction_forces(self.mechanism, id, contact, sign, T::one()) {
                wrench.add_to(self.mechanism, self.configuration, |row, value| column[row] += value);
            }
            column
        })
    }

    /// A unit couple on the first body of a hinge, and its opposite on the second; of a round end a unit force.
    fn friction_couple(&self, circle: &FrictionCircle<T>, contacts: &[ContactGeometry<T>]) -> DVector<T> {
        let mut column = DVector::zeros(self.layout.len());
        for wrench in self.mechanism.friction_couple(circle, contacts, T::one()) {
            wrench.add_to(self.mechanism, self.configuration, |row, value| column[row] += value);
        }
        column
    }
}

impl Builder<'_> {
    /// Names the motion or drive that makes the equations singular, read off a vector that they map to zero.
    /// The motion is named in the sense in which the loads move it.
    fn singular_fault(&self, singular: &Singular, load: &DVector<f64>) -> Fault {
        let Singular { null_vector, weights, condition } = singular;
        let bodies = 3 * self.mechanism.bodies.len();
        let efforts = self.layout.len() - self.layout.drives;
        let accelerations = null_vector.rows(0, bodies).into_owned();
        let significant = |part: f64| part > 1e-6;
        let driven = weights.rows(efforts, self.layout.drives);
        if self.layout.drives > 0 && significant(driven.amax()) {
            let drives: Vec<_> =
                (0..self.layout.drives).filter(|&drive| significant(driven[drive].abs())).collect();
            let names = drives.iter().map(|&drive| self.mechanism.drives[drive].name.to_string()).collect();
            let place = self.mechanism.drives[drives[0]].place.clone();
            let freedom = self.layout.accelerations.saturating_sub(self.layout.reactions.len());
            if freedom < self.layout.drives {
                let coordinate = |&drive: &usize| self.mechanism.drives[drive].coordinate.index();
                let names_of = |index: usize| self.mechanism.coordinates[index].name.to_string();
                let coordinates = drives.iter().map(coordinate).map(names_of).collect();
                return Fault::new(FaultKind::DriveBlocked { drives: names, coordinates }, place);
            }
            let motion = self.prescribed_motion(&drives);
            return Fault::new(FaultKind::DriveCannotMove { drives: names, motion }, place);
        }
        let out_of_plane = (bodies..self.layout.accelerations).find(|&index| significant(weights[index]));
        let in_plane = (0..self.mechanism.bodies.len()).find(|b| significant(weights.rows(3 * b, 3).amax()));
        if let (None, Some(index)) = (in_plane, out_of_plane) {
            let body = &self.mechanism.bodies[(index - bodies) / 3];
            let motion = format!("{} moves out of the drawing", body.name);
            return Fault::new(FaultKind::MotionWithoutInertia { motion }, body.place.clone());
        }
        let Some(first) = in_plane else {
            let quantity = "a coefficient of the kinetic equations".to_owned();
            return Fault::general(if condition.is_finite() {
                FaultKind::IllConditioned { condition: *condition }
            } else {
                FaultKind::Overflow { quantity }
            });
        };
        let motion = moved_by(accelerations, &load.rows(0, bodies).into_owned());
        let motion = motion_in_words(self.mechanism, self.configuration, &motion);
        Fault::new(FaultKind::MotionWithoutInertia { motion }, self.mechanism.bodies[first].place.clone())
    }

    fn prescribed_motion(&self, drives: &[usize]) -> String {
        let names: Vec<String> = drives
            .iter()
            .map(|&drive| {
                let drive = &self.mechanism.drives[drive];
                let coordinate = &self.mechanism.coordinates[drive.coordinate.index()].name;
                format!("{} does no work when {coordinate} changes", drive.name)
            })
            .collect();
        names.join(", ")
    }
}

impl<T: Real> Mechanism<T> {
    /// A friction couple on the first body of a hinge, and its opposite on the second; of a round end a force along the rod
    /// on the block, and its opposite on the guide.
    pub(crate) fn friction_couple(
        &self,
        circle: &FrictionCircle<T>,
        contacts: &[ContactGeometry<T>],
        couple: T,
    ) -> Vec<Wrench<T>> {
        match (&self.joints[circle.joint.index()].kind, circle.end) {
            (JointKind::Hinge([first, second]), _) => {
                vec![Wrench::couple(first.frame, couple), Wrench::couple(second.frame, -couple)]
            }
            (JointKind::Slider(slider), Some([along_n, _])) => {
                let contact = &contacts[along_n.index()];
                along_guide(slider, (contact.point, contact.z), contact.tangent * couple).into()
            }
            (JointKind::Slider(_), None) => Vec::new(),
        }
    }
}

impl<T> FrictionCircle<T> {
    /// The two reactions of whose magnitude together its friction follows: both components of the force of a hinge, or the
    /// normal forces of a round end along n and along z; of a collar the force along z, twice.
    pub(crate) fn reactions(&self) -> [Reaction; 2] {
        match self.end {
            Some(contacts) => contacts.map(Reaction::Normal),
            None if matches!(self.law, CircleLaw::Collar) => [Reaction::Carried(self.joint, 0); 2],
            None => [0, 1].map(|axis| Reaction::Hinge(self.joint, axis)),
        }
    }
}

/// Tells the inertia of all bodies by rows and columns: masses and moments of inertia, and in space those of accelerations out of
/// the plane and what couples them to those in it (S1). Moments of inertia that are not known are left out: no answer but
/// attainability depends on them.
pub(crate) fn each_inertia<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    mut tell: impl FnMut(usize, usize, T),
) {
    for (index, body) in mechanism.bodies.iter().enumerate() {
        for (axis, inertia) in [body.mass, body.mass, body.moment_of_inertia].into_iter().enumerate() {
            tell(3 * index + axis, 3 * index + axis, inertia);
        }
        let Some((first, products)) = products(mechanism, configuration, index) else { continue };
        tell(first, first, body.mass);
        for (axis, product) in products.iter().enumerate() {
            tell(first + 1 + axis, 3 * index + 2, -*product);
            tell(3 * index + 2, first + 1 + axis, -*product);
        }
        let tilt = mechanism.space.as_ref().and_then(|space| space.bodies[index].tilt);
        let Some([about_x, about_y]) = tilt else { continue };
        // In the axes of the drawing: turned with the body.
        let [x, y] = [Vector2::x(), Vector2::y()].map(|axis| configuration.poses[index].turned(axis));
        for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let value = about_x * x[row] * x[column] + about_y * y[row] * y[column];
            tell(first + 1 + row, first + 1 + column, value);
        }
    }
}

/// Tells the couples by which bodies that spin pull out of the plane (S1).
pub(crate) fn each_spin<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    mut tell: impl FnMut(usize, T),
) {
    for (index, velocity) in configuration.velocities.iter().enumerate() {
        let Some((first, products)) = products(mechanism, configuration, index) else { return };
        let spin = velocity.angular.square();
        tell(first + 1, -products.y * spin);
        tell(first + 2, products.x * spin);
    }
}

/// The index of a body's acceleration along z, and its products of inertia in its pose.
fn products<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    body: usize,
) -> Option<(usize, Vector2<T>)> {
    let (first, _) = mechanism.out_of_plane(Frame::Body(BodyId(body)))?;
    let products = mechanism.space.as_ref()?.bodies[body].products;
    Some((first, configuration.poses[body].turned(products.into())))
}

/// The friction force `friction` of a contact as forces on block and guide, acting at the face that is
/// pressed when the normal force has this sign (theory, section 1).
pub(crate) fn friction_forces<T: Real>(
    mechanism: &Mechanism<T>,
    id: ContactId,
    contact: &ContactGeometry<T>,
    sign: T,
    friction: T,
) -> [Wrench<T>; 2] {
    let Contact { joint, height, .. } = &mechanism.contacts[id.index()];
    let slider = mechanism.slider(*joint).expect("contacts belong to sliding joints");
    let half = sign * (height.unwrap_or(slider.height) / T::exactly(2.0));
    let place = contact.point - contact.normal * half;
    let z = contact.lean.map_or(contact.z, |[_, sin]| contact.z - sin * half);
    along_guide(slider, (place, z), contact.tangent * -friction)
}

/// A force in the drawing on the block at a place, and its opposite on the guide.
fn along_guide<T: Real>(
    slider: &Slider<T>,
    (place, z): (Vector2<T>, T),
    force: Vector2<T>,
) -> [Wrench<T>; 2] {
    let on = |frame: Frame, force: Vector2<T>| Wrench::force(frame, place, force).in_space(z, T::zero());
    [on(slider.block, force), on(slider.guide, -force)]
}
