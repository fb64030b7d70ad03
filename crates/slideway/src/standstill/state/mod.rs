//! One state of the sliding joints and contacts as linear equations and inequalities: those of statics, or of
//! the first instant of a motion (the inequalities in `inequalities.rs`).

mod inequalities;

pub(super) use inequalities::{StaticFriction, side_options, sides};

use super::setup::Setup;
use crate::ids::{ContactId, DriveId};
use crate::kinetics::Reaction;
use crate::mechanism::Effort;
use crate::modes::SharedLoad;
use crate::pattern::{Affine, AffineExpression, AffineSet, ContactPhase, Friction, JointPhase, NOTHING};
use crate::sharing::is_rigid;
use nalgebra::{DMatrix, DVector};

/// What every joint and contact does.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    /// The sliding joints.
    pub(crate) joints: Vec<JointPhase>,
    /// The hinges with friction: turning, with the sign of the first body's angle against the second's, or sticking.
    pub(crate) hinges: Vec<JointPhase>,
    /// The contacts.
    pub(crate) contacts: Vec<ContactPhase>,
}

/// What is asked of a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StateQuestion {
    /// Whether bodies may accelerate; else the equations are those of statics.
    pub(super) moving: bool,
    /// The factor of the varied load; nothing where it is an unknown.
    pub(super) factor: Option<f64>,
    /// Whether guides that share a load are to be pressed against each other, with one unit of force in all.
    pub(super) wedged: bool,
}

impl StateQuestion {
    /// Rest with a factor of the varied load; nothing where it is an unknown.
    pub(super) fn rest(factor: Option<f64>) -> Self {
        Self { moving: false, factor, wedged: false }
    }
}

/// A pattern with its equations solved as far as they go.
pub(super) struct State<'s> {
    setup: &'s Setup,
    pattern: &'s Pattern,
    question: StateQuestion,
    /// The directions of the forces of the hinges with friction, where they are given for those that turn.
    directions: Option<&'s [[f64; 2]]>,
    friction: Vec<Friction>,
    /// Where an open contact is, an unknown: its share of the way from the negative to the positive face, or the distance
    /// of the open face of a press fit.
    between: Vec<Option<usize>>,
    /// The couple of each hinge with friction, an unknown.
    couples: Vec<usize>,
    columns: usize,
    solutions: AffineSet,
}

impl<'s> State<'s> {
    /// The state with its equations; nothing where they contradict each other.
    pub(super) fn new(setup: &'s Setup, pattern: &'s Pattern, question: StateQuestion) -> Option<Self> {
        Self::turning(setup, pattern, (question, None))
    }

    /// The same with given directions of the forces of the hinges that turn: then their couples are equations, too.
    pub(super) fn turning(
        setup: &'s Setup,
        pattern: &'s Pattern,
        (question, directions): (StateQuestion, Option<&'s [[f64; 2]]>),
    ) -> Option<Self> {
        let mut state = Self {
            setup,
            pattern,
            question,
            directions,
            friction: Vec::new(),
            between: Vec::new(),
            couples: Vec::new(),
            columns: 0,
            solutions: AffineSet::empty(),
        };
        state.columns = state.first_force() + setup.assembled.layout.len() - setup.equations_of_motion();
        state.friction = (0..setup.mechanism.contacts.len()).map(|k| state.new_friction(k)).collect();
        state.between = (0..setup.mechanism.contacts.len()).map(|k| state.new_place(k)).collect();
        let first_couple = state.columns;
        state.columns += setup.mechanism.friction_circles.len();
        state.couples = (first_couple..state.columns).collect();
        state.columns += usize::from(question.factor.is_none());
        let (matrix, right_hand_side) = state.equations();
        state.solutions = AffineSet::of(matrix, right_hand_side)?;
        Some(state)
    }

    /// An expression as a function of what the equations leave open.
    pub(super) fn function(&self, expression: &AffineExpression) -> Affine {
        self.solutions.function(expression)
    }

    fn new_friction(&mut self, k: usize) -> Friction {
        let slider = self.setup.sliders.iter().position(|slider| slider.contacts.contains(&k));
        let slider = slider.filter(|_| !self.lifts_off(k));
        let joint = slider.map_or(JointPhase::Sticking, |index| self.pattern.joints[index]);
        let contact = self.pattern.contacts[k];
        let pressure = match contact {
            ContactPhase::Pressed(side) => self.normal_force(k).times(side.sign()),
            ContactPhase::PreloadGap => AffineExpression::default(),
        };
        Friction::new(self.setup.law(k), (joint, contact), pressure, || {
            self.columns += 1;
            self.columns - 1
        })
    }

    /// Where an open contact is: where the friction of its preload is shared out, that share. The open face of a press
    /// fit may be at any distance.
    fn new_place(&mut self, k: usize) -> Option<usize> {
        let is_open = self.pattern.contacts[k] == ContactPhase::PreloadGap && self.setup.shares(k);
        let share = self.friction[k].share.filter(|_| self.setup.mechanism.contacts[k].face.is_none());
        is_open.then(|| {
            share.unwrap_or_else(|| {
                self.columns += 1;
                self.columns - 1
            })
        })
    }

    fn first_force(&self) -> usize {
        if self.question.moving { self.setup.equations_of_motion() } else { 0 }
    }

    /// Column of a reaction or effort from its place in the layout of the kinetic equations.
    fn force(&self, place: usize) -> usize {
        self.first_force() + place - self.setup.equations_of_motion()
    }

    /// Equations of motion (or of statics), of the joints' accelerations, of the joints that stick, and of the
    /// deflections of redundant guides:
    ///
    /// ```text
    /// M a - G^T lambda - B u - sum_k W_k F_k = f      G a = 0      C a = 0      S_j a = 0      Z^T (d + e) = 0
    /// ```
    fn equations(&self) -> (DMatrix<f64>, DVector<f64>) {
        let (mut matrix, mut right_hand_side) = self.motion();
        let scale = self.row_scale();
        for (row, factor) in scale.iter().enumerate() {
            matrix.row_mut(row).scale_mut(*factor);
            right_hand_side[row] *= factor;
        }
        let mut further: Vec<(DVector<f64>, f64)> = Vec::new();
        if self.question.moving {
            further.extend(self.kinematics());
        }
        let contacts = self.pattern.contacts.iter().enumerate();
        let in_gap = contacts.filter(|(_, contact)| **contact == ContactPhase::PreloadGap);
        further.extend(in_gap.map(|(k, _)| (self.dense(&self.normal_force(k)), 0.0)));
        further.extend(self.compatibility());
        further.extend(self.turning_couples());
        if self.question.wedged {
            further.extend(self.pressed_together());
        }
        let first = matrix.nrows();
        let mut matrix = matrix.resize_vertically(first + further.len(), 0.0);
        let mut right_hand_side = right_hand_side.resize_vertically(first + further.len(), 0.0);
        for (index, (row, value)) in further.iter().enumerate() {
            matrix.row_mut(first + index).copy_from(&row.transpose());
            right_hand_side[first + index] = *value;
        }
        (matrix, right_hand_side)
    }

    /// M = -r s t.R of the hinges that turn, where the directions t of their forces are given.
    fn turning_couples(&self) -> Vec<(DVector<f64>, f64)> {
        let circles = self.setup.mechanism.friction_circles.iter().enumerate();
        let couples = circles.zip(self.directions.unwrap_or_default()).filter_map(|((hinge, circle), t)| {
            let sign = self.pattern.hinges[hinge].sign();
            let radius = circle.radius / self.setup.lever(hinge) * sign;
            let couple = [0, 1].into_iter().fold(self.friction_couple(hinge), |couple, axis| {
                couple.plus(radius * t[axis], &self.reaction(self.setup.force_of(hinge, axis)))
            });
            (sign != 0.0).then(|| (self.dense(&couple), 0.0))
        });
        couples.collect()
    }

    /// Z^T (d + e) = 0 of redundant guides, with the law of each contact, eq. (R1).
    fn compatibility(&self) -> Vec<(DVector<f64>, f64)> {
        let Some(shared) = &self.setup.shared else { return Vec::new() };
        let stresses = shared.self_stress.column_iter();
        let equation = stresses.map(|stress| {
            let taking_part = (0..stress.len()).filter(|&k| stress[k] != 0.0);
            let sum = taking_part.fold(AffineExpression::default(), |sum, k| {
                sum.plus(stress[k], &self.deflection(shared, k).shifted(shared.misalignment[k]))
            });
            let row = self.dense(&sum);
            // Of rigid faces that are all pressed there is nothing but their places.
            let places = shared.clearance.abs() + shared.misalignment.abs();
            let scale = if is_rigid(shared) { stress.abs().dot(&places) } else { row.amax() };
            if scale > 0.0 { (row / scale, -sum.constant / scale) } else { (row, -sum.constant) }
        });
        equation.collect()
    }

    /// Deflection `d_k` of a contact that shares a load (m): `-sigma delta - f N` where it is pressed, and anything from
    /// `-delta` to `delta` where it is open. A face of a press fit that is open is at any distance.
    fn deflection(&self, shared: &SharedLoad, k: usize) -> AffineExpression {
        let clearance = shared.clearance[k];
        let yields = shared.compliance[k] * self.setup.units.force;
        match (self.pattern.contacts[k], self.between[k]) {
            (ContactPhase::Pressed(side), _) => {
                self.normal_force(k).times(-yields).shifted(-side.sign() * clearance)
            }
            (ContactPhase::PreloadGap, place) => {
                let place = place.expect("open contacts have a place");
                match self.setup.mechanism.contacts[k].face {
                    Some(face) => {
                        AffineExpression::unknown(place, if face.is_positive { yields } else { -yields })
                    }
                    None => AffineExpression::unknown(place, -2.0 * clearance).shifted(clearance),
                }
            }
        }
    }

    /// The normal forces of the contacts that share a load are one unit in all, and drives do nothing.
    fn pressed_together(&self) -> Vec<(DVector<f64>, f64)> {
        let sharing = (0..self.friction.len()).filter(|&k| self.setup.shares(k));
        let sum =
            sharing.fold(AffineExpression::default(), |sum, k| sum.plus(1.0, &self.friction[k].pressure));
        let drives = (0..self.setup.mechanism.drives.len()).map(DriveId);
        let efforts = drives.map(|drive| (self.dense(&self.effort(drive)), 0.0));
        [(self.dense(&sum), 1.0)].into_iter().chain(efforts).collect()
    }

    /// The equations of motion with unknowns in the units of the programs, and rows in N and N m.
    fn motion(&self) -> (DMatrix<f64>, DVector<f64>) {
        let setup = self.setup;
        let rows = setup.equations_of_motion();
        let mut matrix = DMatrix::zeros(rows, self.columns);
        let mut right_hand_side = setup.given.clone();
        let unit = setup.units.force;
        let source = &setup.assembled.matrix;
        for column in 0..self.first_force() {
            matrix.column_mut(column).axpy(
                self.acceleration_unit(column),
                &source.view((0, column), (rows, 1)).column(0),
                0.0,
            );
        }
        for place in rows..setup.assembled.layout.len() {
            let factor = self.force_unit(place);
            let column = source.view((0, place), (rows, 1)).column(0) * factor;
            matrix.column_mut(self.force(place)).copy_from(&column);
        }
        for (friction, columns) in self.friction.iter().zip(&setup.assembled.friction) {
            for (force, column) in friction.faces.iter().zip(columns) {
                let face = column.rows(0, rows);
                for &(unknown, factor) in &force.terms {
                    matrix.column_mut(unknown).axpy(-factor * unit, &face, 1.0);
                }
                right_hand_side.axpy(force.constant * unit, &face, 1.0);
            }
        }
        for (circle, (&unknown, column)) in self.couples.iter().zip(&setup.assembled.couples).enumerate() {
            matrix.column_mut(unknown).axpy(-unit * setup.lever(circle), &column.rows(0, rows), 1.0);
        }
        if let Some(load) = &setup.load {
            if let Some(factor) = self.question.factor {
                right_hand_side += &load.forces * factor;
            } else {
                let column = &load.forces * -self.factor_unit();
                matrix.column_mut(self.columns - 1).copy_from(&column);
            }
        }
        (matrix, right_hand_side)
    }

    /// G a = 0, C a = prescribed and, for joints and hinges that stick, S_j a = 0.
    fn kinematics(&self) -> Vec<(DVector<f64>, f64)> {
        let setup = self.setup;
        let rows = setup.equations_of_motion();
        let mut found = Vec::new();
        let gaps: Vec<usize> =
            setup.one_sided().iter().map(|&k| self.normal_column(k) + rows - self.first_force()).collect();
        for row_place in (rows..setup.assembled.layout.len()).filter(|place| !gaps.contains(place)) {
            let entries = (0..rows).map(|column| (column, setup.assembled.matrix[(row_place, column)]));
            let row = self.dense(&self.of_accelerations(entries, 1.0));
            let (size, value) = (row.amax(), setup.assembled.load[row_place]);
            found.push(if size > 0.0 { (row / size, value / size) } else { (row, value) });
        }
        for k in setup.one_sided().into_iter().filter(|&k| !self.lifts_off(k)) {
            found.push((self.dense(&self.gap_acceleration(k)), 0.0));
        }
        let sticks = |acceleration: AffineExpression| (self.dense(&acceleration), 0.0);
        for (index, joint) in self.pattern.joints.iter().enumerate() {
            let contacts = &self.setup.sliders[index].contacts;
            let touches = contacts.is_empty() || contacts.iter().any(|&k| !self.lifts_off(k));
            if *joint == JointPhase::Sticking && touches {
                found.push(sticks(self.sliding_acceleration(index)));
            }
        }
        for (index, hinge) in self.pattern.hinges.iter().enumerate() {
            if *hinge == JointPhase::Sticking {
                found.push(sticks(self.turning_acceleration(index)));
            }
        }
        found
    }

    fn dense(&self, expression: &AffineExpression) -> DVector<f64> {
        let mut row = DVector::zeros(self.columns);
        for &(column, factor) in &expression.terms {
            row[column] += factor;
        }
        row
    }

    fn row_scale(&self) -> Vec<f64> {
        let units = &self.setup.units;
        let is_rotation = |row: usize| self.setup.mechanism.is_rotation(row);
        let one = |row: usize| if is_rotation(row) { units.force * units.length } else { units.force };
        (0..self.setup.equations_of_motion()).map(|row| 1.0 / one(row)).collect()
    }

    fn acceleration_unit(&self, column: usize) -> f64 {
        let units = &self.setup.units;
        if self.setup.mechanism.is_rotation(column) {
            units.acceleration / units.length
        } else {
            units.acceleration
        }
    }

    /// Unit of a reaction or effort: N, or N m for a couple or torque.
    pub(super) fn force_unit(&self, place: usize) -> f64 {
        let (setup, units) = (self.setup, &self.setup.units);
        let index = place - setup.equations_of_motion();
        let reactions = setup.assembled.layout.reactions();
        let is_couple = match reactions.get(index) {
            Some(reaction) => matches!(reaction, Reaction::Couple(_) | Reaction::Carried(_, 1 | 2)),
            None => matches!(setup.mechanism.drives[index - reactions.len()].effort, Effort::Torque { .. }),
        };
        if is_couple { units.force * units.length } else { units.force }
    }

    /// Unit of the load factor.
    pub(super) fn factor_unit(&self) -> f64 {
        let units = &self.setup.units;
        let load = self
            .setup
            .load
            .as_ref()
            .map(|load| super::setup::greatest_force(&self.setup.mechanism, &load.forces));
        load.filter(|load| *load > 0.0).map_or(1.0, |load| units.force / load)
    }

    fn normal_column(&self, k: usize) -> usize {
        let reaction = Reaction::Normal(ContactId(k));
        self.force(self.setup.assembled.layout.reaction(reaction).expect("every contact has a normal force"))
    }
}

/// Quantities of a state, in the units of the programs.
impl State<'_> {
    /// The load factor.
    pub(super) fn factor(&self) -> AffineExpression {
        match self.question.factor {
            Some(factor) => AffineExpression::constant(factor / self.factor_unit()),
            None => AffineExpression::unknown(self.columns - 1, 1.0),
        }
    }

    /// The normal force of a contact.
    pub(super) fn normal_force(&self, k: usize) -> AffineExpression {
        AffineExpression::unknown(self.normal_column(k), 1.0)
    }

    /// A reaction or an effort by its place in the layout of the kinetic equations.
    pub(super) fn reaction(&self, place: usize) -> AffineExpression {
        AffineExpression::unknown(self.force(place), 1.0)
    }

    /// A quantity in the units of the programs, 0 where it is but rounding.
    pub(super) fn without_rounding(value: f64) -> f64 {
        if value.abs() <= NOTHING { 0.0 } else { value }
    }

    /// Effort of a drive.
    pub(super) fn effort(&self, drive: DriveId) -> AffineExpression {
        self.reaction(self.setup.assembled.layout.effort(drive))
    }

    /// The friction force of a contact, at both faces together.
    pub(super) fn friction_force(&self, k: usize) -> AffineExpression {
        let [positive, negative] = &self.friction[k].faces;
        positive.clone().plus(1.0, negative)
    }

    /// Acceleration of sliding of the block of a joint against its guide, along u.
    pub(super) fn sliding_acceleration(&self, slider: usize) -> AffineExpression {
        let row = self.setup.row(slider);
        self.of_accelerations(row.iter().copied().enumerate(), self.setup.units.acceleration)
    }

    /// Acceleration of the gap of a contact.
    pub(super) fn gap_acceleration(&self, k: usize) -> AffineExpression {
        let row = self.setup.gap_row(k);
        self.of_accelerations(row.iter().copied().enumerate(), self.setup.units.acceleration)
    }

    /// Returns whether a contact that may lift off does.
    fn lifts_off(&self, k: usize) -> bool {
        self.setup.mechanism.contacts[k].opens && self.pattern.contacts[k] == ContactPhase::PreloadGap
    }

    /// The contacts that lift off.
    pub(super) fn open(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.pattern.contacts.len()).filter(|&k| self.lifts_off(k))
    }

    /// Angular acceleration of the first body of a hinge with friction against the second.
    pub(super) fn turning_acceleration(&self, hinge: usize) -> AffineExpression {
        let row = self.setup.row(self.setup.sliders.len() + hinge);
        let unit = self.setup.units.acceleration / self.setup.lever(hinge);
        self.of_accelerations(row.iter().copied().enumerate(), unit)
    }

    /// The couple of a hinge with friction, on its first body.
    pub(super) fn friction_couple(&self, hinge: usize) -> AffineExpression {
        AffineExpression::unknown(self.couples[hinge], 1.0)
    }

    /// A linear form of the accelerations, in this unit.
    pub(super) fn of_accelerations(
        &self,
        entries: impl IntoIterator<Item = (usize, f64)>,
        unit: f64,
    ) -> AffineExpression {
        let mut expression = AffineExpression::default();
        if self.question.moving {
            let entries = entries.into_iter().filter(|(_, value)| *value != 0.0);
            let scaled =
                entries.map(|(column, value)| (column, value * self.acceleration_unit(column) / unit));
            expression.terms.extend(scaled);
        }
        expression
    }
}
