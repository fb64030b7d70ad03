//! One pattern of sticking and slipping joints and of sides, as linear equations and inequalities.

use super::instant::Instant;
use super::joints::SlidingJoint;
use super::outputs::{Group, Outputs};
use crate::influence::ContactFriction;
use crate::pattern::{
    Affine, AffineExpression, AffineSet, Bound, ContactPhase, Friction, JointPhase, Phase, Pin, direction,
    without_tipping,
};
use nalgebra::{DMatrix, DVector};

/// Directions that differ by less are the same.
const SAME_DIRECTION: f64 = 1e-13;
/// More steps of Newton's method for the directions of the forces of turning hinges are not taken.
const MOST_STEPS: usize = 12;

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
    /// |C_j| <= r_static_j |R_j| of a hinge that sticks.
    Circle(usize),
    /// A joint or hinge that begins to move, by its number among both, does so against its friction.
    Slip(usize),
    /// A gap of a joint that is zero does not close.
    Gap(usize),
}

/// An inequality `slack >= 0`.
#[derive(Debug, Clone)]
pub(super) struct Inequality {
    /// What it is about.
    pub(super) subject: Subject,
    /// Its slack, in units, as a function of what the equations leave open.
    pub(super) slack: Affine,
}

/// The question: accelerations, or the impulses that stop a joint.
#[derive(Debug, Clone)]
pub(super) struct Question<'q> {
    /// How normal forces, sliding accelerations and couples respond to friction.
    pub(super) outputs: &'q Outputs,
    /// The required acceleration (or jump of the velocity) of every sticking joint, then hinge, in units.
    pub(super) wanted: Vec<f64>,
    /// Whether preloads count.
    pub(super) has_preload: bool,
    /// The sides that each contact may take.
    pub(super) sides: Vec<Vec<ContactPhase>>,
    /// Joints, then hinges with friction, whose velocity is zero; those of them that move have just begun to.
    pub(super) stopped: &'q [bool],
    /// A joint or hinge that sticks only at the end, with the sign of the sliding velocity that its friction opposes.
    pub(super) opposes: Option<(usize, f64)>,
}

/// A pattern with its equations solved as far as possible.
pub(super) struct System<'s> {
    pub(super) instant: &'s Instant<'s>,
    question: &'s Question<'s>,
    pub(super) phase: &'s Phase,
    pub(super) group: &'s Group,
    /// Friction of each contact of the group.
    friction: Vec<Option<Friction>>,
    /// Forces of the end stops at which joints rest: each joint, with its unknown.
    stops: Vec<(usize, usize)>,
    /// Couples of the hinges with friction: each hinge, with its unknown.
    couples: Vec<(usize, usize)>,
    /// The directions of the forces of the hinges that turn, by the numbers of the hinges.
    directions: Vec<[f64; 2]>,
    unknowns: usize,
    solutions: AffineSet,
}

impl<'s> System<'s> {
    /// The pattern of a group of joints in a phase, with its equations; `None` if they contradict each other.
    pub(super) fn new(
        instant: &'s Instant<'s>,
        question: &'s Question<'s>,
        phase: &'s Phase,
        group: &'s Group,
    ) -> Option<Self> {
        let mut system = Self {
            instant,
            question,
            phase,
            group,
            friction: vec![None; phase.contacts.len()],
            stops: Vec::new(),
            couples: Vec::new(),
            directions: phase.hinges.iter().map(|hinge| direction(hinge.force)).collect(),
            unknowns: 0,
            solutions: AffineSet::empty(),
        };
        for &k in &group.contacts {
            system.friction[k] = Some(system.new_friction(k));
        }
        let touches = |joint: &usize| instant.joints.get(*joint).is_some_and(|joint| joint.stop != 0.0);
        for joint in system.bound_joints().into_iter().filter(touches) {
            let unknown = system.new_unknown();
            system.stops.push((joint, unknown));
        }
        for &hinge in &group.hinges {
            let unknown = system.new_unknown();
            system.couples.push((hinge, unknown));
        }
        system.solve()?;
        for _ in 0..MOST_STEPS {
            if !system.turn() {
                break;
            }
            system.solve()?;
        }
        Some(system)
    }

    fn solve(&mut self) -> Option<()> {
        let (matrix, right_hand_side) = self.equations();
        self.solutions = AffineSet::of(matrix, right_hand_side)?;
        Some(())
    }

    /// Takes the directions of the forces of hinges that turn from the solution, as far as the equations determine them;
    /// returns whether that has changed any: a step of Newton's method, since `|R| = t.R` has the gradient `t`.
    fn turn(&mut self) -> bool {
        let mut changes = false;
        for index in 0..self.couples.len() {
            let (hinge, _) = self.couples[index];
            if self.phase.hinges[hinge].state == JointPhase::Sticking {
                continue;
            }
            let force = self.force(hinge).map(|component| self.solutions.function(&component));
            if force.iter().any(Affine::varies) {
                continue;
            }
            let found = direction(force.map(|component| component.constant));
            let change = found.iter().zip(self.directions[hinge]).map(|(new, old)| (new - old).abs());
            changes |= change.fold(0.0, f64::max) > SAME_DIRECTION;
            self.directions[hinge] = found;
        }
        changes
    }

    /// Dimension of what the equations leave open.
    pub(super) fn dimension(&self) -> usize {
        self.solutions.dimension()
    }

    /// Whether some equations follow from others by coincidence, so that they could contradict each other at
    /// another instant: not because sticking joints depend on one another.
    pub(super) fn is_redundant(&self) -> bool {
        let bound = self.bound_joints();
        let equations = self.group.contacts.len() + bound.len() + self.turning().count();
        let excess = equations - (self.unknowns - self.dimension());
        excess > 0 && excess > self.instant.dependent(&bound)
    }

    fn joint(&self, k: usize) -> JointPhase {
        self.instant.joint_of(k).map_or(JointPhase::Sticking, |joint| self.phase.joints[joint])
    }

    fn new_unknown(&mut self) -> usize {
        self.unknowns += 1;
        self.unknowns - 1
    }

    fn new_friction(&mut self, k: usize) -> Friction {
        let (joint, contact) = (self.joint(k), self.phase.contacts[k]);
        let pressure = match contact {
            ContactPhase::Pressed(_) => AffineExpression::unknown(self.new_unknown(), 1.0),
            ContactPhase::PreloadGap => AffineExpression::default(),
        };
        let law = self.instant.law(k, self.question.has_preload);
        Friction::new(law, (joint, contact), pressure, || self.new_unknown())
    }

    /// The contacts of the group, with their friction.
    fn contacts(&self) -> impl Iterator<Item = (usize, &Friction)> {
        self.group.contacts.iter().filter_map(|&k| Some((k, self.friction[k].as_ref()?)))
    }

    /// An output as an expression of the unknowns.
    fn output(&self, row: usize) -> AffineExpression {
        let outputs = self.question.outputs;
        let mut expression = AffineExpression::constant(outputs.base[row]);
        for (k, friction) in self.contacts() {
            for (face, friction) in friction.faces.iter().enumerate() {
                let factor = outputs.columns[face][(row, k)];
                if factor != 0.0 {
                    expression = expression.plus(factor, friction);
                }
            }
        }
        for &(joint, force) in &self.stops {
            // The stop pushes the block away along the centre line, like friction midway between both faces.
            let SlidingJoint { contacts, stop, .. } = &self.instant.joints[joint];
            let [plus, minus] = [0, 1].map(|face| outputs.columns[face][(row, contacts[0])]);
            expression =
                expression.plus(stop * f64::midpoint(plus, minus), &AffineExpression::unknown(force, 1.0));
        }
        for &(hinge, couple) in &self.couples {
            let factor = outputs.couples[(row, hinge)];
            if factor != 0.0 {
                expression = expression.plus(factor, &AffineExpression::unknown(couple, 1.0));
            }
        }
        expression
    }

    /// The force of a hinge with friction on its first body.
    fn force(&self, hinge: usize) -> [AffineExpression; 2] {
        let first = self.instant.turning_output(hinge);
        [1, 2].map(|component| self.output(first + component))
    }

    /// The hinges that turn, each with its couple and the sign of its velocity.
    fn turning(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let turning = self.couples.iter().map(|&(hinge, couple)| (hinge, couple, self.turns(hinge)));
        turning.filter(|(.., sign)| *sign != 0.0)
    }

    fn turns(&self, hinge: usize) -> f64 {
        self.phase.hinges[hinge].state.sign()
    }

    /// The acceleration of a joint or hinge by its number among both.
    fn acceleration(&self, rubbing: usize) -> AffineExpression {
        match rubbing.checked_sub(self.instant.joints.len()) {
            None => self.output(self.instant.sliding_output(rubbing)),
            Some(hinge) => self.output(self.instant.turning_output(hinge)),
        }
    }

    /// N_j = N_j(0) + sum_k eta_jk F_k for every contact, the acceleration of every joint and hinge for which it is
    /// prescribed, and C_j = -r_j s_j t_j.R_j of every hinge that turns.
    fn equations(&self) -> (DMatrix<f64>, DVector<f64>) {
        let bound = self.bound_joints();
        let contacts = self.group.contacts.len();
        let rows = contacts + bound.len() + self.turning().count();
        let mut matrix = DMatrix::zeros(rows, self.unknowns);
        let mut right_hand_side = DVector::zeros(rows);
        for (row, (k, friction)) in self.contacts().enumerate() {
            let equation = self.output(k).plus(-1.0, &friction.normal_force());
            write(row, &equation, &mut matrix, &mut right_hand_side);
        }
        for (index, &joint) in bound.iter().enumerate() {
            let equation = self.acceleration(joint).shifted(-self.question.wanted[joint]);
            write(contacts + index, &equation, &mut matrix, &mut right_hand_side);
        }
        for (index, (hinge, couple, sign)) in self.turning().enumerate() {
            let lever = sign * self.radius(hinge, 0);
            let along = self.force(hinge).into_iter().zip(self.directions[hinge]);
            let equation = along.fold(AffineExpression::unknown(couple, 1.0), |equation, (component, t)| {
                equation.plus(lever * t, &component)
            });
            write(contacts + bound.len() + index, &equation, &mut matrix, &mut right_hand_side);
        }
        (matrix, right_hand_side)
    }

    /// The radius of the friction circle of a hinge in units: while it turns (0), or the static one (1).
    fn radius(&self, hinge: usize, which: usize) -> f64 {
        let hinge = &self.instant.hinges[hinge];
        hinge.radii[which] / hinge.units.length
    }

    /// The joints and hinges whose acceleration is prescribed: those that stick.
    fn bound_joints(&self) -> Vec<usize> {
        let is_bound = |joint: &usize| self.phase.joints[*joint] == JointPhase::Sticking;
        let hinges = self.group.hinges.iter().filter(|hinge| self.turns(**hinge) == 0.0);
        let hinges = hinges.map(|hinge| self.instant.number_of(*hinge));
        self.group.joints.iter().copied().filter(is_bound).chain(hinges).collect()
    }

    /// The hinges that stick: each with what bounds its couple.
    fn pins(&self) -> impl Iterator<Item = (usize, Pin)> {
        let sticking = self.couples.iter().filter(|(hinge, _)| self.turns(*hinge) == 0.0);
        sticking.map(|&(hinge, couple)| {
            let pin = Pin {
                reaction: self.force(hinge).map(|component| self.solutions.function(&component)),
                couple: self.solutions.function(&AffineExpression::unknown(couple, 1.0)),
                radius: self.radius(hinge, 1),
                turning: None,
                allowance: 0.0,
            };
            (hinge, pin)
        })
    }

    /// What bounds the couples of hinges that stick where that is no inequality: where the equations leave it open.
    pub(super) fn open_pins(&self) -> Vec<Pin> {
        self.pins().map(|(_, pin)| pin).filter(Pin::varies).collect()
    }

    /// The normal force and the friction of a contact, in units; `None` if the equations leave it open.
    pub(super) fn determined_forces(&self, k: usize) -> [Option<f64>; 2] {
        let Some(friction) = &self.friction[k] else { return [None; 2] };
        let both = friction.faces[0].clone().plus(1.0, &friction.faces[1]);
        [friction.normal_force(), both].map(|force| {
            let force = self.solutions.function(&force);
            (!force.varies()).then_some(force.constant)
        })
    }

    /// Both components of the force of a hinge of the group on its first body, and its friction couple, in units; `None` if
    /// the equations leave it open.
    pub(super) fn determined_forces_of_hinge(&self, hinge: usize) -> [Option<f64>; 3] {
        let Some(&(_, couple)) = self.couples.iter().find(|(other, _)| *other == hinge) else {
            return [None; 3];
        };
        let [x, y] = self.force(hinge);
        [x, y, AffineExpression::unknown(couple, 1.0)].map(|force| {
            let force = self.solutions.function(&force);
            (!force.varies()).then_some(force.constant)
        })
    }

    /// Every inequality of the pattern.
    pub(super) fn inequalities(&self) -> Vec<Inequality> {
        let mut all = Vec::new();
        let mut add = |subject: Subject, slack: AffineExpression| {
            all.push(Inequality { subject, slack: self.solutions.function(&slack) });
        };
        for (k, friction) in self.contacts() {
            let of_joint = |(joint, _): &(usize, f64)| self.instant.joint_of(k) == Some(*joint);
            let opposes = self.question.opposes.filter(of_joint).map(|(_, sign)| sign);
            for (bound, slack) in friction.bounds(self.instant.contact(k).mu_static, opposes) {
                let subject = match bound {
                    Bound::Pressure => Subject::Pressure(k),
                    Bound::Share => Subject::Share(k),
                    Bound::Friction => Subject::Friction(k),
                };
                add(subject, slack);
            }
        }
        for &(joint, force) in &self.stops {
            add(
                Subject::Friction(self.instant.joints[joint].contacts[0]),
                AffineExpression::unknown(force, 1.0),
            );
        }
        for (row, joint) in self.instant.couple_outputs() {
            let (Some(couple), [k]) = (joint.couple, &joint.contacts[..]) else { continue };
            let Some(friction) = &self.friction[*k] else { continue };
            let half = couple.half_length / self.instant.units.length;
            if half.is_infinite() {
                continue;
            }
            for slack in without_tipping(&friction.pressure, &self.output(row), half) {
                add(Subject::Couple(*k), slack);
            }
        }
        for &joint in &self.group.joints {
            for row in self.instant.gap_outputs(joint) {
                add(Subject::Gap(joint), self.output(row));
            }
            if let JointPhase::Sliding(sign) = self.phase.joints[joint]
                && self.question.stopped[joint]
                && self.instant.joints[joint].has_friction
            {
                add(Subject::Slip(joint), self.acceleration(joint).times(sign));
                if sign == self.instant.joints[joint].stop {
                    // Nothing slides into its stop.
                    add(Subject::Slip(joint), AffineExpression::constant(-1.0));
                }
            }
        }
        for (hinge, _, sign) in self.turning() {
            let number = self.instant.number_of(hinge);
            if self.question.stopped[number] {
                add(Subject::Slip(number), self.acceleration(number).times(sign));
            }
        }
        for &(hinge, couple) in &self.couples {
            if let Some((_, sign)) =
                self.question.opposes.filter(|(number, _)| *number == self.instant.number_of(hinge))
            {
                add(Subject::Circle(hinge), AffineExpression::unknown(couple, -sign));
            }
        }
        for (hinge, pin) in self.pins().filter(|(_, pin)| !pin.varies()) {
            add(Subject::Circle(hinge), AffineExpression::constant(pin.slack_of_constants()));
        }
        all
    }

    fn value(&self, expression: &AffineExpression, z: &[f64]) -> f64 {
        self.solutions.function(expression).at(z)
    }

    /// Adds the forces of this group to those of all contacts and hinges.
    pub(super) fn write_forces(&self, z: &[f64], forces: &mut Forces, phase: &mut Phase) {
        for (k, friction) in self.contacts() {
            let [positive_face, negative_face] = friction.faces.each_ref().map(|face| self.value(face, z));
            forces.frictions[k] = ContactFriction { positive_face, negative_face };
            forces.normal[k] = self.value(&friction.normal_force(), z);
            forces.shares[k] =
                friction.share.map(|share| self.value(&AffineExpression::unknown(share, 1.0), z));
        }
        for &(joint, force) in &self.stops {
            let SlidingJoint { contacts, stop, .. } = &self.instant.joints[joint];
            let half = stop * self.value(&AffineExpression::unknown(force, 1.0), z) / 2.0;
            forces.frictions[contacts[0]].positive_face += half;
            forces.frictions[contacts[0]].negative_face += half;
        }
        for &(hinge, couple) in &self.couples {
            forces.couples[hinge] = self.value(&AffineExpression::unknown(couple, 1.0), z);
            let unit = self.instant.hinges[hinge].units.force;
            phase.hinges[hinge].force = self.force(hinge).map(|component| self.value(&component, z) * unit);
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
    /// Shares of the positive faces, for contacts that slide in their preload gaps.
    pub(super) shares: Vec<Option<f64>>,
    /// Friction couples of the hinges on their first bodies.
    pub(super) couples: Vec<f64>,
}

/// Writes the equation `expression = 0` into a row, scaled so that its greatest coefficient is one.
fn write(
    row: usize,
    expression: &AffineExpression,
    matrix: &mut DMatrix<f64>,
    right_hand_side: &mut DVector<f64>,
) {
    for &(column, value) in &expression.terms {
        matrix[(row, column)] += value;
    }
    let greatest = matrix.row(row).amax();
    let factor = if greatest > 0.0 { 1.0 / greatest } else { 1.0 };
    matrix.row_mut(row).scale_mut(factor);
    right_hand_side[row] = -expression.constant * factor;
}
