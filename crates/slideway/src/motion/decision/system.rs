//! One pattern of sticking and slipping joints and of sides as linear equations and inequalities.

use super::instant::{Group, Instant, Outputs, SlidingJoint};
use super::program::Affine;
use crate::ids::ContactId;
use crate::influence::ContactFriction;
use crate::model::PreloadLine;
use crate::modes::Side;
use crate::motion::{ContactPhase, JointPhase, Phase};
use crate::standstill::affine::AffineSet;
use nalgebra::{DMatrix, DVector};

/// Coefficients below this are rounding errors of terms of order one.
const NO_COEFFICIENT: f64 = 1e-12;

/// An affine expression of the unknowns of a pattern.
#[derive(Debug, Clone, Default)]
struct Expression {
    terms: Vec<(usize, f64)>,
    constant: f64,
}

impl Expression {
    fn unknown(index: usize, factor: f64) -> Self {
        Self { terms: vec![(index, factor)], constant: 0.0 }
    }

    fn plus(mut self, factor: f64, other: &Self) -> Self {
        self.terms.extend(other.terms.iter().map(|(index, value)| (*index, factor * value)));
        self.constant += factor * other.constant;
        self
    }

    fn shifted(mut self, constant: f64) -> Self {
        self.constant += constant;
        self
    }
}

/// What an inequality of a pattern is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Subject {
    /// |N_k| >= 0.
    Pressure(usize),
    /// The share of a contact in its preload gap is at least 0 and at most 1.
    Share(usize),
    /// |C| <= |N| L/2 of a guided slider.
    Couple(usize),
    /// |F_k| <= mu_static_k |N_k| + F_k0 of a contact that sticks.
    Friction(usize),
    /// A joint that begins to slip does so in the direction against which its friction acts.
    Slip(usize),
}

/// An inequality `slack >= 0`.
#[derive(Debug, Clone)]
pub(super) struct Inequality {
    /// What it is about.
    pub(super) subject: Subject,
    /// Its slack, as a function of what the equations leave open, in units.
    pub(super) slack: Affine,
}

/// What is asked for: accelerations, or the impulses that stop a joint.
#[derive(Debug, Clone)]
pub(super) struct Question<'q> {
    /// How normal forces, sliding accelerations and couples answer to friction.
    pub(super) outputs: &'q Outputs,
    /// The sliding acceleration (or jump of the sliding velocity) of every joint that sticks, in units.
    pub(super) wanted: Vec<f64>,
    /// Whether preloads count.
    pub(super) has_preload: bool,
    /// The sides that each contact may take.
    pub(super) sides: Vec<Vec<ContactPhase>>,
    /// Joints whose velocity is zero: those of them that slide have just begun to.
    pub(super) stopped: &'q [bool],
    /// A joint that sticks only at the end, and the sign of the sliding velocity that its friction opposes.
    pub(super) opposes: Option<(usize, f64)>,
    /// Joints that slide and are pushed by the stops that they touch, so that they have the wanted acceleration, too.
    pub(super) pushed: Vec<usize>,
}

/// A pattern with its equations solved as far as they go.
pub(super) struct System<'s> {
    pub(super) instant: &'s Instant<'s>,
    question: &'s Question<'s>,
    pub(super) phase: &'s Phase,
    pub(super) group: &'s Group,
    /// Friction of each contact at both faces.
    friction: Vec<[Expression; 2]>,
    /// |N_k|, nothing in a preload gap.
    pressure: Vec<Option<usize>>,
    /// Unknown frictions of contacts that stick: at the faces, and in the middle between them.
    sticking: Vec<[Option<usize>; 3]>,
    /// Share of the positive face in a preload gap that slips.
    share: Vec<Option<usize>>,
    /// Forces of the end stops at which joints rest: the joint, and the unknown.
    stops: Vec<(usize, usize)>,
    unknowns: usize,
    solutions: AffineSet,
}

impl<'s> System<'s> {
    /// The pattern of a group of joints in a phase, with its equations; nothing where they contradict each other.
    pub(super) fn new(
        instant: &'s Instant<'s>,
        question: &'s Question<'s>,
        phase: &'s Phase,
        group: &'s Group,
    ) -> Option<Self> {
        let contacts = phase.contacts.len();
        let mut system = Self {
            instant,
            question,
            phase,
            group,
            friction: vec![Default::default(); contacts],
            pressure: vec![None; contacts],
            sticking: vec![[None; 3]; contacts],
            share: vec![None; contacts],
            stops: Vec::new(),
            unknowns: 0,
            solutions: AffineSet { particular: DVector::zeros(0), directions: DMatrix::zeros(0, 0) },
        };
        for &k in &group.contacts {
            system.friction[k] = system.friction_of(k);
        }
        for joint in system.bound_joints().into_iter().filter(|&joint| instant.joints[joint].stop != 0.0) {
            let unknown = system.new_unknown();
            system.stops.push((joint, unknown));
        }
        let (matrix, right_hand_side) = system.equations();
        system.solutions = AffineSet::of(matrix, right_hand_side)?;
        Some(system)
    }

    /// Dimension of what the equations leave open.
    pub(super) fn dimension(&self) -> usize {
        self.solutions.directions.ncols()
    }

    /// Whether some equations follow from others by chance, so that they could contradict each other at another instant:
    /// not because joints that stick depend on one another.
    pub(super) fn is_redundant(&self) -> bool {
        let bound = self.bound_joints();
        let excess = self.group.contacts.len() + bound.len() - (self.unknowns - self.dimension());
        excess > 0 && excess > self.instant.dependent(&bound)
    }

    fn joint(&self, k: usize) -> JointPhase {
        self.instant.joint_of(k).map_or(JointPhase::Sticking, |joint| self.phase.joints[joint])
    }

    fn preload(&self, k: usize) -> [f64; 2] {
        if !self.question.has_preload {
            return [0.0; 2];
        }
        self.instant.contact(k).preload.map(|preload| preload / self.instant.units_of(k).force)
    }

    fn new_unknown(&mut self) -> usize {
        self.unknowns += 1;
        self.unknowns - 1
    }

    fn friction_of(&mut self, k: usize) -> [Expression; 2] {
        match (self.joint(k), self.phase.contacts[k]) {
            (JointPhase::Sliding(sign), ContactPhase::Pressed(side)) => self.sliding(k, sign, side),
            (JointPhase::Sliding(sign), ContactPhase::PreloadGap) => {
                let share = self.new_unknown();
                self.share[k] = Some(share);
                // (share F_0^+ W^+ + (1 - share) F_0^- W^-) s
                let [plus, minus] = self.preload(k).map(|preload| preload * sign);
                let faces =
                    [Expression::unknown(share, plus), Expression::unknown(share, -minus).shifted(minus)];
                match self.instant.contact(k).preload_line {
                    PreloadLine::Pressed => faces,
                    PreloadLine::Centre => {
                        let [plus, minus] = &faces;
                        let half = Expression::default().plus(0.5, plus).plus(0.5, minus);
                        [half.clone(), half]
                    }
                }
            }
            (JointPhase::Sticking, ContactPhase::Pressed(side)) => self.held(k, side),
            (JointPhase::Sticking, ContactPhase::PreloadGap) => self.held_in_gap(k),
        }
    }

    /// The unknown friction of a contact that sticks in its preload gap: at both faces, or in the middle between them where
    /// it is the same there.
    fn held_in_gap(&mut self, k: usize) -> [Expression; 2] {
        let mut faces = [Expression::default(), Expression::default()];
        if !self.instant.mechanism.preload_changes_face(ContactId(k)) {
            let unknown = self.new_unknown();
            self.sticking[k][2] = Some(unknown);
            return faces.map(|both| both.plus(0.5, &Expression::unknown(unknown, 1.0)));
        }
        let preload = self.preload(k);
        for face in [0, 1] {
            if preload[face] > 0.0 {
                let unknown = self.new_unknown();
                self.sticking[k][face] = Some(unknown);
                faces[face] = Expression::unknown(unknown, 1.0);
            }
        }
        faces
    }

    /// F_k = (mu_k |N_k| + F_k0) s_k, eq. (2).
    fn sliding(&mut self, k: usize, sign: f64, side: Side) -> [Expression; 2] {
        let face = face(side);
        let pressure = self.new_unknown();
        self.pressure[k] = Some(pressure);
        let contact = self.instant.contact(k);
        let preload = self.preload(k)[face] * sign;
        let mut faces = [Expression::default(), Expression::default()];
        if contact.mu[face] != 0.0 {
            faces[face] = Expression::unknown(pressure, contact.mu[face] * sign);
        }
        match contact.preload_line {
            PreloadLine::Pressed => faces[face].constant += preload,
            PreloadLine::Centre => {
                for both in &mut faces {
                    both.constant += preload / 2.0;
                }
            }
        }
        faces
    }

    /// The unknown friction of a contact that sticks.
    fn held(&mut self, k: usize, side: Side) -> [Expression; 2] {
        let face = face(side);
        self.pressure[k] = Some(self.new_unknown());
        let contact = self.instant.contact(k);
        let preload = self.preload(k)[face];
        let centred = contact.preload_line == PreloadLine::Centre;
        let mut faces = [Expression::default(), Expression::default()];
        if contact.mu_static[face] > 0.0 || (preload > 0.0 && !centred) {
            let unknown = self.new_unknown();
            self.sticking[k][face] = Some(unknown);
            faces[face] = Expression::unknown(unknown, 1.0);
        }
        if preload > 0.0 && centred {
            let unknown = self.new_unknown();
            self.sticking[k][2] = Some(unknown);
            faces = faces.map(|both| both.plus(0.5, &Expression::unknown(unknown, 1.0)));
        }
        faces
    }

    /// An output as an expression of the unknowns.
    fn output(&self, row: usize) -> Expression {
        let outputs = self.question.outputs;
        let mut expression = Expression::default().shifted(outputs.base[row]);
        for &k in &self.group.contacts {
            for (face, friction) in self.friction[k].iter().enumerate() {
                let factor = outputs.columns[face][(row, k)];
                if factor != 0.0 {
                    expression = expression.plus(factor, friction);
                }
            }
        }
        for &(joint, force) in &self.stops {
            // It pushes the block away from the stop, along the centre line as friction in the middle between both faces does.
            let SlidingJoint { contacts, stop, .. } = &self.instant.joints[joint];
            let [plus, minus] = [0, 1].map(|face| outputs.columns[face][(row, contacts[0])]);
            expression = expression.plus(stop * f64::midpoint(plus, minus), &Expression::unknown(force, 1.0));
        }
        expression
    }

    /// N_j = N_j(0) + sum_k eta_jk F_k for every contact, and the sliding acceleration of every joint that is bound to one.
    fn equations(&self) -> (DMatrix<f64>, DVector<f64>) {
        let bound = self.bound_joints();
        let contacts = self.group.contacts.len();
        let mut matrix = DMatrix::zeros(contacts + bound.len(), self.unknowns);
        let mut right_hand_side = DVector::zeros(contacts + bound.len());
        for (row, &k) in self.group.contacts.iter().enumerate() {
            let normal = self.normal_force(k);
            write(row, &self.output(k).plus(-1.0, &normal), &mut matrix, &mut right_hand_side);
        }
        for (index, &joint) in bound.iter().enumerate() {
            let acceleration = self.output(self.instant.sliding_output(joint));
            let equation = acceleration.shifted(-self.question.wanted[joint]);
            write(contacts + index, &equation, &mut matrix, &mut right_hand_side);
        }
        (matrix, right_hand_side)
    }

    /// The joints whose acceleration is wanted: those that stick, and those that are pushed.
    fn bound_joints(&self) -> Vec<usize> {
        let is_bound = |joint: &usize| {
            self.phase.joints[*joint] == JointPhase::Sticking || self.question.pushed.contains(joint)
        };
        self.group.joints.iter().copied().filter(is_bound).collect()
    }

    fn normal_force(&self, k: usize) -> Expression {
        match (self.phase.contacts[k], self.pressure[k]) {
            (ContactPhase::Pressed(side), Some(pressure)) => Expression::unknown(pressure, side.sign()),
            _ => Expression::default(),
        }
    }

    /// An expression as a function of what the equations leave open.
    fn function(&self, expression: &Expression) -> Affine {
        let mut coefficients = vec![0.0; self.dimension()];
        let mut constant = expression.constant;
        for &(column, factor) in &expression.terms {
            constant += factor * self.solutions.particular[column];
            for (index, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient += factor * self.solutions.directions[(column, index)];
            }
        }
        for coefficient in &mut coefficients {
            if coefficient.abs() <= NO_COEFFICIENT {
                *coefficient = 0.0;
            }
        }
        Affine { coefficients, constant }
    }

    /// The normal force of a contact, in units; nothing where the equations leave it open.
    pub(super) fn determined_normal_force(&self, k: usize) -> Option<f64> {
        let normal = self.function(&self.normal_force(k));
        normal.coefficients.iter().all(|coefficient| *coefficient == 0.0).then_some(normal.constant)
    }

    /// Every inequality of the pattern.
    pub(super) fn inequalities(&self) -> Vec<Inequality> {
        let mut all = Vec::new();
        let mut add = |subject: Subject, slack: Expression| {
            all.push(Inequality { subject, slack: self.function(&slack) });
        };
        for &k in &self.group.contacts {
            if let Some(pressure) = self.pressure[k] {
                add(Subject::Pressure(k), Expression::unknown(pressure, 1.0));
            }
            if let Some(share) = self.share[k] {
                add(Subject::Share(k), Expression::unknown(share, 1.0));
                add(Subject::Share(k), Expression::unknown(share, -1.0).shifted(1.0));
            }
            for slack in self.cone(k) {
                add(Subject::Friction(k), slack);
            }
        }
        for &(joint, force) in &self.stops {
            add(Subject::Friction(self.instant.joints[joint].contacts[0]), Expression::unknown(force, 1.0));
        }
        for (row, joint) in self.instant.couple_outputs() {
            let (Some((half, _)), [k]) = (joint.couple, &joint.contacts[..]) else { continue };
            if !self.group.contacts.contains(k) {
                continue;
            }
            let half = half / self.instant.units.length;
            let pressure =
                self.pressure[*k].map_or_else(Expression::default, |p| Expression::unknown(p, half));
            for sign in [1.0, -1.0] {
                add(Subject::Couple(*k), pressure.clone().plus(sign, &self.output(row)));
            }
        }
        for &joint in &self.group.joints {
            if let JointPhase::Sliding(sign) = self.phase.joints[joint]
                && self.question.stopped[joint]
                && self.instant.joints[joint].has_friction
            {
                let acceleration = self.output(self.instant.sliding_output(joint));
                add(Subject::Slip(joint), Expression::default().plus(sign, &acceleration));
                if sign == self.instant.joints[joint].stop {
                    // Nothing slides into its stop.
                    add(Subject::Slip(joint), Expression::default().shifted(-1.0));
                }
            }
        }
        all
    }

    /// |F_k| <= mu_static |N_k| + F_k0 of a contact that sticks.
    fn cone(&self, k: usize) -> Vec<Expression> {
        let preload = self.preload(k);
        let opposes = self.question.opposes;
        let opposed =
            opposes.filter(|(joint, _)| self.instant.joint_of(k) == Some(*joint)).map(|(_, sign)| sign);
        let both = |unknown: usize, limit: &Expression| match opposed {
            None => [1.0, -1.0].map(|sign| limit.clone().plus(sign, &Expression::unknown(unknown, 1.0))),
            Some(sign) => [
                Expression::unknown(unknown, sign),
                limit.clone().plus(-sign, &Expression::unknown(unknown, 1.0)),
            ],
        };
        match (self.phase.contacts[k], self.sticking[k]) {
            (ContactPhase::PreloadGap, [Some(plus), Some(minus), _]) => {
                // F^+/F_0^+ + F^-/F_0^- <= 1 for all signs, in units of the lesser preload.
                let least = preload[0].min(preload[1]);
                let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
                let corner = |(first, second): (f64, f64)| {
                    Expression::unknown(plus, first * least / preload[0])
                        .plus(second * least / preload[1], &Expression::unknown(minus, 1.0))
                        .shifted(least)
                };
                signs.into_iter().map(corner).collect()
            }
            (ContactPhase::PreloadGap, faces) => {
                // In the middle between the faces share F_0^+ + (1 - share) F_0^- is at most the greater of both.
                let limits = [preload[0], preload[1], preload[0].max(preload[1])];
                let found = faces.into_iter().zip(limits);
                found
                    .filter_map(|(unknown, limit)| Some((unknown?, limit)))
                    .flat_map(|(unknown, limit)| both(unknown, &Expression::default().shifted(limit)))
                    .collect()
            }
            (ContactPhase::Pressed(side), faces) => {
                let contact = self.instant.contact(k);
                let centred = contact.preload_line == PreloadLine::Centre;
                let mu = contact.mu_static[face(side)];
                let preload = preload[face(side)];
                let pressure =
                    self.pressure[k].map_or_else(Expression::default, |p| Expression::unknown(p, mu));
                let at_face = pressure.shifted(if centred { 0.0 } else { preload });
                let at_centre = Expression::default().shifted(preload);
                let face = faces[face(side)].map(|unknown| both(unknown, &at_face));
                let centre = faces[2].map(|unknown| both(unknown, &at_centre));
                face.into_iter().chain(centre).flatten().collect()
            }
        }
    }

    fn value(&self, expression: &Expression, z: &[f64]) -> f64 {
        self.function(expression).at(z)
    }

    /// Adds the forces of this group to those of all contacts.
    pub(super) fn write_forces(&self, z: &[f64], forces: &mut Forces) {
        for &k in &self.group.contacts {
            let [positive_face, negative_face] = [0, 1].map(|face| self.value(&self.friction[k][face], z));
            forces.frictions[k] = ContactFriction { positive_face, negative_face };
            forces.normal[k] = self.value(&self.normal_force(k), z);
            forces.shares[k] = self.share[k].map(|share| self.value(&Expression::unknown(share, 1.0), z));
        }
        for &(joint, force) in &self.stops {
            let SlidingJoint { contacts, stop, .. } = &self.instant.joints[joint];
            let half = stop * self.value(&Expression::unknown(force, 1.0), z) / 2.0;
            forces.frictions[contacts[0]].positive_face += half;
            forces.frictions[contacts[0]].negative_face += half;
        }
    }
}

/// Forces of all contacts, in units.
#[derive(Debug, Clone)]
pub(super) struct Forces {
    /// Friction at both faces.
    pub(super) frictions: Vec<ContactFriction>,
    /// Normal forces, exactly zero in a preload gap.
    pub(super) normal: Vec<f64>,
    /// Shares of the positive faces of contacts in their preload gaps that slide.
    pub(super) shares: Vec<Option<f64>>,
}

/// Puts the equation `expression = 0` into a row, scaled to a greatest coefficient of one.
fn write(row: usize, expression: &Expression, matrix: &mut DMatrix<f64>, right_hand_side: &mut DVector<f64>) {
    for &(column, value) in &expression.terms {
        matrix[(row, column)] += value;
    }
    let greatest = matrix.row(row).amax();
    let factor = if greatest > 0.0 { 1.0 / greatest } else { 1.0 };
    matrix.row_mut(row).scale_mut(factor);
    right_hand_side[row] = -expression.constant * factor;
}

/// Which of two versions belongs to a side.
pub(super) fn face(side: Side) -> usize {
    usize::from(side == Side::Negative)
}
