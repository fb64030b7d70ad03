//! One state of the sliding joints and contacts as linear equations and inequalities.

use super::affine::AffineSet;
use super::region::{Affine, Region};
use super::setup::Setup;
use crate::ids::{ContactId, DriveId};
use crate::kinetics::Reaction;
use crate::mechanism::{Contact, Effort};
use crate::model::PreloadLine;
use nalgebra::{DMatrix, DVector};

/// Which face of a contact is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Side {
    /// The normal force is positive or zero.
    Positive,
    /// The normal force is negative or zero.
    Negative,
    /// There is no normal force, and the preload is shared between both faces.
    Gap,
}

impl Side {
    /// The sign as it is printed.
    pub(super) fn symbol(self) -> char {
        match self {
            Self::Positive => '+',
            Self::Negative => '-',
            Self::Gap => '0',
        }
    }

    fn sign(self) -> f64 {
        if self == Self::Negative { -1.0 } else { 1.0 }
    }

    fn index(self) -> usize {
        usize::from(self == Self::Negative)
    }
}

/// What a sliding joint does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sliding {
    /// It does not begin to slide.
    Stick,
    /// The block begins to slide along u (1) or against it (-1).
    Slip(i8),
}

/// What is asked of a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Question {
    /// Whether bodies may accelerate; else the equations are those of statics.
    pub(super) moving: bool,
    /// The factor of the varied load; nothing where it is an unknown.
    pub(super) factor: Option<f64>,
}

/// A state of every sliding joint and contact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pattern {
    /// Of each sliding joint.
    pub(super) sliding: Vec<Sliding>,
    /// Of each contact.
    pub(super) sides: Vec<Side>,
}

/// A linear expression of the unknowns in the units of the programs.
#[derive(Debug, Clone, Default)]
pub(super) struct Expression {
    terms: Vec<(usize, f64)>,
    constant: f64,
}

impl Expression {
    fn unknown(column: usize, factor: f64) -> Self {
        Self { terms: vec![(column, factor)], constant: 0.0 }
    }

    pub(super) fn plus(mut self, factor: f64, other: &Self) -> Self {
        self.terms.extend(other.terms.iter().map(|(column, value)| (*column, factor * value)));
        self.constant += factor * other.constant;
        self
    }

    pub(super) fn shifted(mut self, constant: f64) -> Self {
        self.constant += constant;
        self
    }
}

/// Friction of a contact that is an unknown: where it acts, and its column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Face(usize),
    Centre,
    /// Share of the positive face in the preload of a contact that slips in its gap.
    Share,
}

/// A pattern with its equations solved as far as they go.
pub(super) struct State<'s> {
    setup: &'s Setup,
    pattern: &'s Pattern,
    question: Question,
    /// Columns of the unknown frictions of each contact.
    friction: Vec<Vec<(Place, usize)>>,
    columns: usize,
    solutions: AffineSet,
}

impl<'s> State<'s> {
    /// The state with its equations; nothing where they contradict each other.
    pub(super) fn new(setup: &'s Setup, pattern: &'s Pattern, question: Question) -> Option<Self> {
        let mut state = Self {
            setup,
            pattern,
            question,
            friction: Vec::new(),
            columns: 0,
            solutions: AffineSet { particular: DVector::zeros(0), directions: DMatrix::zeros(0, 0) },
        };
        state.columns = state.first_force() + setup.assembled.layout.len() - setup.equations_of_motion();
        state.friction = (0..setup.mechanism.contacts.len()).map(|k| state.unknown_friction(k)).collect();
        state.columns += usize::from(question.factor.is_none());
        let (matrix, right_hand_side) = state.equations();
        state.solutions = AffineSet::of(matrix, right_hand_side)?;
        Some(state)
    }

    /// Dimension of what the equations leave open.
    pub(super) fn dimension(&self) -> usize {
        self.solutions.directions.ncols()
    }

    /// An expression as a function of what the equations leave open.
    pub(super) fn function(&self, expression: &Expression) -> Affine {
        let mut coefficients = vec![0.0; self.dimension()];
        let mut constant = expression.constant;
        for &(column, factor) in &expression.terms {
            constant += factor * self.solutions.particular[column];
            for (index, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient += factor * self.solutions.directions[(column, index)];
            }
        }
        Affine { coefficients, constant }
    }

    fn first_force(&self) -> usize {
        if self.question.moving { self.setup.equations_of_motion() } else { 0 }
    }

    /// Column of a reaction or effort from its place in the layout of the kinetic equations.
    fn force(&self, place: usize) -> usize {
        self.first_force() + place - self.setup.equations_of_motion()
    }

    fn sliding(&self, contact: usize) -> Sliding {
        let found = self.setup.sliders.iter().position(|slider| slider.contacts.contains(&contact));
        found.map_or(Sliding::Stick, |index| self.pattern.sliding[index])
    }

    fn contact(&self, k: usize) -> &'s Contact {
        &self.setup.mechanism.contacts[k]
    }

    fn unknown_friction(&mut self, k: usize) -> Vec<(Place, usize)> {
        let contact = self.contact(k);
        let side = self.pattern.sides[k];
        let places = match (self.sliding(k), side) {
            (Sliding::Stick, Side::Gap) if self.setup.mechanism.preload_changes_face(ContactId(k)) => {
                vec![Place::Face(0), Place::Face(1)]
            }
            (Sliding::Stick, Side::Gap) => vec![Place::Centre],
            (Sliding::Slip(_), Side::Gap) => vec![Place::Share],
            (Sliding::Stick, _) if contact.preload_line == PreloadLine::Centre => {
                vec![Place::Face(side.index()), Place::Centre]
            }
            (Sliding::Stick, _) => vec![Place::Face(side.index())],
            (Sliding::Slip(_), _) => Vec::new(),
        };
        let first = self.columns;
        self.columns += places.len();
        places.into_iter().zip(first..).collect()
    }

    /// Unit friction of a contact in the equations of motion.
    fn friction_column(&self, k: usize, place: Place) -> DVector<f64> {
        let columns = &self.setup.assembled.friction[k];
        let rows = self.setup.equations_of_motion();
        let face = |side: usize| columns[side].rows(0, rows).into_owned();
        match place {
            Place::Face(side) => face(side),
            Place::Centre => (face(0) + face(1)) / 2.0,
            Place::Share => {
                let [plus, minus] = [0, 1].map(|side| self.preload_friction(k, side));
                (plus - minus) * (self.slip_sign(k) / self.setup.units.force)
            }
        }
    }

    /// F_k0^side W_k^side, the friction of a preload in the equations of motion.
    fn preload_friction(&self, k: usize, side: usize) -> DVector<f64> {
        let contact = self.contact(k);
        let place = match contact.preload_line {
            PreloadLine::Pressed => Place::Face(side),
            PreloadLine::Centre => Place::Centre,
        };
        self.friction_column(k, place) * contact.preload[side]
    }

    fn slip_sign(&self, k: usize) -> f64 {
        match self.sliding(k) {
            Sliding::Slip(sign) => f64::from(sign),
            Sliding::Stick => 0.0,
        }
    }

    /// Equations of motion (or of statics), of the joints' accelerations, and of the joints that stick:
    ///
    /// ```text
    /// M a - G^T lambda - B u - sum_k W_k F_k = f      G a = 0      C a = 0      S_j a = 0
    /// ```
    fn equations(&self) -> (DMatrix<f64>, DVector<f64>) {
        let (mut matrix, mut right_hand_side) = self.motion();
        let scale = self.row_scale();
        for (row, factor) in scale.iter().enumerate() {
            matrix.row_mut(row).scale_mut(*factor);
            right_hand_side[row] *= factor;
        }
        let mut further: Vec<DVector<f64>> = Vec::new();
        if self.question.moving {
            further.extend(self.kinematics());
        }
        let sides = self.pattern.sides.iter().enumerate();
        let in_gap = sides.filter(|(_, side)| **side == Side::Gap);
        further.extend(in_gap.map(|(k, _)| self.dense(&self.normal_force(k))));
        let first = matrix.nrows();
        let mut matrix = matrix.resize_vertically(first + further.len(), 0.0);
        let right_hand_side = right_hand_side.resize_vertically(first + further.len(), 0.0);
        for (index, row) in further.iter().enumerate() {
            matrix.row_mut(first + index).copy_from(&row.transpose());
        }
        (matrix, right_hand_side)
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
        for (k, unknown) in self.friction.iter().enumerate() {
            for &(place, column) in unknown {
                matrix.column_mut(column).copy_from(&(self.friction_column(k, place) * -unit));
            }
            self.slip(k, &mut matrix, &mut right_hand_side);
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

    /// Kinetic friction F_k = (mu_k |N_k| + F_k0) s_k of a contact that slips, eq. (2), put into the equations.
    fn slip(&self, k: usize, matrix: &mut DMatrix<f64>, right_hand_side: &mut DVector<f64>) {
        let Sliding::Slip(sign) = self.sliding(k) else { return };
        let (contact, side, sign) = (self.contact(k), self.pattern.sides[k], f64::from(sign));
        if side == Side::Gap {
            // (share F_k0^+ W^+ + (1 - share) F_k0^- W^-) s_k: the part without the share.
            *right_hand_side += self.preload_friction(k, 1) * sign;
            return;
        }
        let face = self.friction_column(k, Place::Face(side.index()));
        let pressure = contact.mu[side.index()] * side.sign() * sign * self.setup.units.force;
        matrix.column_mut(self.normal_column(k)).axpy(-pressure, &face, 1.0);
        *right_hand_side += self.preload_friction(k, side.index()) * sign;
    }

    /// G a = 0, C a = 0 and, for joints that stick, S_j a = 0.
    fn kinematics(&self) -> Vec<DVector<f64>> {
        let setup = self.setup;
        let rows = setup.equations_of_motion();
        let mut found = Vec::new();
        for row in rows..setup.assembled.layout.len() {
            let entries = (0..rows).map(|column| (column, setup.assembled.matrix[(row, column)]));
            let row = self.dense(&self.of_accelerations(entries, 1.0));
            let size = row.amax();
            found.push(if size > 0.0 { row / size } else { row });
        }
        for (index, sliding) in self.pattern.sliding.iter().enumerate() {
            if *sliding == Sliding::Stick {
                found.push(self.dense(&self.sliding_acceleration(index)));
            }
        }
        found
    }

    fn dense(&self, expression: &Expression) -> DVector<f64> {
        let mut row = DVector::zeros(self.columns);
        for &(column, factor) in &expression.terms {
            row[column] += factor;
        }
        row
    }

    fn row_scale(&self) -> Vec<f64> {
        let units = &self.setup.units;
        let one = |row: usize| if row % 3 == 2 { units.force * units.length } else { units.force };
        (0..self.setup.equations_of_motion()).map(|row| 1.0 / one(row)).collect()
    }

    fn acceleration_unit(&self, column: usize) -> f64 {
        let units = &self.setup.units;
        if column % 3 == 2 { units.acceleration / units.length } else { units.acceleration }
    }

    /// Unit of a reaction or effort: N, or N m for a couple or torque.
    pub(super) fn force_unit(&self, place: usize) -> f64 {
        let (setup, units) = (self.setup, &self.setup.units);
        let index = place - setup.equations_of_motion();
        let reactions = setup.assembled.layout.reactions();
        let is_couple = match reactions.get(index) {
            Some(reaction) => matches!(reaction, Reaction::Couple(_)),
            None => matches!(setup.mechanism.drives[index - reactions.len()].effort, Effort::Torque { .. }),
        };
        if is_couple { units.force * units.length } else { units.force }
    }

    /// Unit of the load factor.
    pub(super) fn factor_unit(&self) -> f64 {
        let units = &self.setup.units;
        let load =
            self.setup.load.as_ref().map(|load| super::setup::greatest_force(&load.forces, units.length));
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
    pub(super) fn factor(&self) -> Expression {
        match self.question.factor {
            Some(factor) => Expression::default().shifted(factor / self.factor_unit()),
            None => Expression::unknown(self.columns - 1, 1.0),
        }
    }

    /// The normal force of a contact.
    pub(super) fn normal_force(&self, k: usize) -> Expression {
        Expression::unknown(self.normal_column(k), 1.0)
    }

    /// A reaction or an effort by its place in the layout of the kinetic equations.
    pub(super) fn reaction(&self, place: usize) -> Expression {
        Expression::unknown(self.force(place), 1.0)
    }

    /// Effort of a drive.
    pub(super) fn effort(&self, drive: DriveId) -> Expression {
        self.reaction(self.setup.assembled.layout.effort(drive))
    }

    /// |N_k|, given the side.
    fn pressure(&self, k: usize) -> Expression {
        Expression::default().plus(self.pattern.sides[k].sign(), &self.normal_force(k))
    }

    /// The friction force of a contact, at all its faces together.
    pub(super) fn friction_force(&self, k: usize) -> Expression {
        let (contact, side, sign) = (self.contact(k), self.pattern.sides[k], self.slip_sign(k));
        let unit = self.setup.units.force;
        let mut force = Expression::default();
        for &(place, column) in &self.friction[k] {
            let factor = if place == Place::Share {
                (contact.preload[0] - contact.preload[1]) * sign / unit
            } else {
                1.0
            };
            force = force.plus(factor, &Expression::unknown(column, 1.0));
        }
        let pressure = if side == Side::Gap { 0.0 } else { sign * contact.mu[side.index()] };
        let preload = contact.preload[if side == Side::Gap { 1 } else { side.index() }];
        force.plus(pressure, &self.pressure(k)).shifted(sign * preload / unit)
    }

    /// Acceleration of sliding of the block of a joint against its guide: along u in the middle between the faces,
    /// which is -(W^+ + W^-)/2 . a.
    pub(super) fn sliding_acceleration(&self, slider: usize) -> Expression {
        let Some(&k) = self.setup.sliders[slider].contacts.first() else { return Expression::default() };
        let column = self.friction_column(k, Place::Centre);
        self.of_accelerations(column.iter().map(|entry| -entry).enumerate(), self.setup.units.acceleration)
    }

    /// A linear form of the accelerations, in this unit.
    pub(super) fn of_accelerations(
        &self,
        entries: impl IntoIterator<Item = (usize, f64)>,
        unit: f64,
    ) -> Expression {
        let mut expression = Expression::default();
        if self.question.moving {
            let entries = entries.into_iter().filter(|(_, value)| *value != 0.0);
            let scaled =
                entries.map(|(column, value)| (column, value * self.acceleration_unit(column) / unit));
            expression.terms.extend(scaled);
        }
        expression
    }
}

/// Inequalities of a state.
impl State<'_> {
    /// What the equations leave open within every inequality of the state, with these coefficients of static
    /// friction.
    pub(super) fn region(&self, mu_static: &[[f64; 2]]) -> Region {
        let mut constraints = Vec::new();
        for (k, mu) in mu_static.iter().enumerate() {
            constraints.extend(self.contact_constraints(k, *mu));
        }
        for slider in &self.setup.sliders {
            constraints.extend(self.couple_constraints(slider));
        }
        for (index, sliding) in self.pattern.sliding.iter().enumerate() {
            if let Sliding::Slip(sign) = sliding {
                constraints
                    .push(Expression::default().plus(-f64::from(*sign), &self.sliding_acceleration(index)));
            }
        }
        let functions = constraints.iter().map(|expression| self.function(expression)).collect();
        Region::new(self.dimension(), functions)
    }

    /// |N_k| >= 0, and for a contact that sticks |F_k| <= mu_static |N_k| + F_k0.
    fn contact_constraints(&self, k: usize, mu_static: [f64; 2]) -> Vec<Expression> {
        let side = self.pattern.sides[k];
        if side == Side::Gap {
            return self.gap_constraints(k);
        }
        let mut constraints = vec![Expression::default().plus(-1.0, &self.pressure(k))];
        let preload = self.contact(k).preload[side.index()] / self.setup.units.force;
        let at_centre = self.contact(k).preload_line == PreloadLine::Centre;
        for &(place, column) in &self.friction[k] {
            let (mu, preload) = match place {
                Place::Face(_) => (mu_static[side.index()], if at_centre { 0.0 } else { preload }),
                Place::Centre | Place::Share => (0.0, preload),
            };
            for sign in [1.0, -1.0] {
                let excess = Expression::unknown(column, sign).plus(-mu, &self.pressure(k));
                constraints.push(excess.shifted(-preload));
            }
        }
        constraints
    }

    /// |F_k^+| <= share F_k0^+ and |F_k^-| <= (1 - share) F_k0^- for some share from 0 to 1; where both act in the middle
    /// between the faces |F_k| is at most the greater preload.
    fn gap_constraints(&self, k: usize) -> Vec<Expression> {
        let preload = self.contact(k).preload.map(|preload| preload / self.setup.units.force);
        match self.friction[k][..] {
            [(Place::Share, column)] => {
                vec![Expression::unknown(column, -1.0), Expression::unknown(column, 1.0).shifted(-1.0)]
            }
            [(Place::Centre, column)] => {
                let most = preload[0].max(preload[1]);
                [1.0, -1.0].map(|sign| Expression::unknown(column, sign).shifted(-most)).to_vec()
            }
            [(_, plus), (_, minus)] => {
                let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
                // F^+/F_0^+ + F^-/F_0^- <= 1, multiplied by both preloads.
                let corner = |(first, second): (f64, f64)| {
                    let sum = Expression::unknown(plus, first * preload[1])
                        .plus(second * preload[0], &Expression::unknown(minus, 1.0));
                    sum.shifted(-preload[0] * preload[1])
                };
                signs.into_iter().map(corner).chain(self.within_preloads(k, preload)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// No face carries more than its preload.
    fn within_preloads(&self, k: usize, preload: [f64; 2]) -> Vec<Expression> {
        let one = |(&(_, column), preload): (&(Place, usize), f64)| {
            [1.0, -1.0].map(|sign| Expression::unknown(column, sign).shifted(-preload))
        };
        self.friction[k].iter().zip(preload).flat_map(one).collect()
    }

    /// |C| <= |N| L/2 of a guided slider.
    fn couple_constraints(&self, slider: &super::setup::SlidingJoint) -> Vec<Expression> {
        let (Some((place, half)), [k]) = (slider.couple, &slider.contacts[..]) else { return Vec::new() };
        let half = half / self.setup.units.length;
        let one = |sign: f64| {
            Expression::default().plus(sign, &self.reaction(place)).plus(-half, &self.pressure(*k))
        };
        vec![one(1.0), one(-1.0)]
    }
}

/// All combinations of sides of the contacts; a gap only where the friction of the preload jumps.
pub(super) fn sides(setup: &Setup) -> Vec<Vec<Side>> {
    let mut all = vec![Vec::new()];
    for options in side_options(setup) {
        let extended = |sides: Vec<Side>| {
            options.iter().map(move |side| sides.iter().copied().chain([*side]).collect::<Vec<_>>())
        };
        all = all.into_iter().flat_map(extended).collect();
    }
    all
}

/// The sides that each contact may take.
pub(super) fn side_options(setup: &Setup) -> Vec<&'static [Side]> {
    let one = |k: usize| -> &'static [Side] {
        let jumps = setup.mechanism.preload_jumps(ContactId(k));
        if jumps { &[Side::Positive, Side::Negative, Side::Gap] } else { &[Side::Positive, Side::Negative] }
    };
    (0..setup.mechanism.contacts.len()).map(one).collect()
}
