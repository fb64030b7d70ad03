//! From kinetic equations within intervals to bounds of the influence coefficients.

use super::outputs::EnclosedCouple;
use super::{EnclosedOutputs, NotEnclosed, solution};
use crate::configuration::Configuration;
use crate::ids::{ContactId, JointId};
use crate::interval::{Interval, Sign};
use crate::kinetics::{Assembled, ConstraintRow, Reaction, Wrench, equilibration, scaled, sliding_row};
use crate::mechanism::{Contact, Mechanism, Slider};
use crate::model::{self, JointKind, Model, SliderKind};
use crate::modes::{BySide, InfluenceCoefficients, Side};
use crate::problem::{TurningHinge, friction_of_contacts, preload_columns};
use crate::progress::Work;
use crate::sharing::{NO_STRESS, shared_load};
use nalgebra::{DMatrix, DVector, RowDVector};

/// Where parameters are uncertain, forces below this multiple of the greatest are taken for nothing but
/// rounding. It is a convention, which decides only what is called a solution in the middle of the bounds,
/// not the bounds.
const ROUNDING: f64 = 1e-12;

/// A hinge that turns with friction, within bounds.
pub(super) struct RubbingHinge {
    /// The column of the answers to a unit couple on its first body among all unknowns.
    column: usize,
    /// The couple on its first body by a unit of its force.
    leverage: Interval,
}

/// A mechanism in its configuration, all within intervals.
pub(super) struct Coefficients<'a> {
    pub(super) model: &'a Model,
    pub(super) mechanism: &'a Mechanism<Interval>,
    pub(super) configuration: &'a Configuration<Interval>,
    pub(super) equations: &'a Assembled<Interval>,
    /// Whether every parameter is one number. Then all widths come from rounding, and bounds that hold zero
    /// mean that nothing but zero can be told; else they mean that zero is one of many values.
    pub(super) are_numbers: bool,
    /// The joints that do not slide.
    pub(super) at_rest: &'a [JointId],
}

impl Coefficients<'_> {
    /// Returns the coefficients of the problem of the contacts and of these hinges, and what follows from its forces.
    pub(super) fn problem(
        &self,
        unknowns: &DMatrix<Interval>,
        hinges: &[TurningHinge],
        rubbing: &[RubbingHinge],
    ) -> Result<(InfluenceCoefficients<Interval>, EnclosedOutputs), NotEnclosed> {
        let layout = &self.equations.layout;
        let normals = (0..self.mechanism.contacts.len()).map(|k| Reaction::Normal(ContactId(k)));
        let forces =
            hinges.iter().flat_map(|hinge| self.mechanism.friction_circles[hinge.circle].reactions());
        let rows: Option<Vec<usize>> = normals.chain(forces).map(|force| layout.reaction(force)).collect();
        let rows = rows.ok_or(NotEnclosed::Equations)?;
        let (couples, places): (Vec<EnclosedCouple>, Vec<usize>) = self.couples().into_iter().unzip();
        let of_unknowns = rows.iter().chain(&places).map(|&row| unknowns.row(row).into_owned());
        let outputs = self.accelerations(unknowns).into_iter().chain([self.power(unknowns.ncols())]);
        let answers = DMatrix::from_rows(&of_unknowns.chain(outputs).collect::<Vec<_>>());
        let scale = self.greatest_force(&|row| unknowns[(row, 0)]);
        let forces = answers.rows(0, rows.len()).into_owned();
        let influence = self.influence(&forces, (rows.len(), scale), &couples, rubbing)?;
        let all = self.influence(&answers, (rows.len(), scale), &couples, rubbing)?;
        let numbers = all.numbers().rows(rows.len()..answers.nrows());
        Ok((self.without_shared_jumps(&influence), EnclosedOutputs { influence, numbers, couples }))
    }

    /// Returns the coefficients of the problem of the contacts, with the accelerations of the joints at rest as further rows.
    pub(super) fn problem_at_rest(
        &self,
        unknowns: &DMatrix<Interval>,
    ) -> Result<InfluenceCoefficients<Interval>, NotEnclosed> {
        let normals = (0..self.mechanism.contacts.len()).map(|k| Reaction::Normal(ContactId(k)));
        let rows: Option<Vec<usize>> = normals.map(|force| self.equations.layout.reaction(force)).collect();
        let rows = rows.ok_or(NotEnclosed::Equations)?;
        let sliders = self.at_rest.iter().filter_map(|joint| self.mechanism.slider(*joint));
        let sliding = sliders.map(|slider| {
            self.acceleration(unknowns, &sliding_row(self.mechanism, self.configuration, slider))
        });
        let forces = rows.iter().map(|&row| unknowns.row(row).into_owned());
        let answers = DMatrix::from_rows(&forces.chain(sliding).collect::<Vec<_>>());
        let scale = self.greatest_force(&|row| unknowns[(row, 0)]);
        Ok(self.without_shared_jumps(&self.influence(&answers, (rows.len(), scale), &[], &[])?))
    }

    /// Bounds of the influence coefficients of the contacts and hinges, from the rows of all answers: first those of so many
    /// forces, whose scale this is, then those of the couples of guided sliders, and of other outputs.
    fn influence(
        &self,
        answers: &DMatrix<Interval>,
        (forces, scale): (usize, f64),
        couples: &[EnclosedCouple],
        rubbing: &[RubbingHinge],
    ) -> Result<InfluenceCoefficients<Interval>, NotEnclosed> {
        let (rows, contacts) = (answers.nrows(), self.mechanism.contacts.len());
        let entry = |row: usize, column: usize, scale: f64| match answers[(row, column)] {
            value if row < forces => self.without_rounding(value, scale),
            value => value,
        };
        let column = |at: usize| DVector::from_fn(rows, |row, _| entry(row, at, 1.0));
        let self_stress = self.self_stresses(answers, forces);
        let positive = DMatrix::from_fn(rows, contacts, |row, k| entry(row, 1 + k, 1.0));
        let negative = if self.mechanism.space.is_some() {
            let first = self.first_other_face();
            DMatrix::from_fn(rows, contacts, |row, k| entry(row, first + k, 1.0))
        } else {
            let mut negative = self.negative_versions(positive.clone(), &self_stress);
            for (row, couple) in (forces..rows).zip(couples) {
                // At the other face the slider's own friction turns by h more the one way, and its couple the other way.
                negative[(row, couple.contact)] -= couple.height;
            }
            negative
        };
        let eta = BySide { positive, negative };
        let [mu, preload] = friction_of_contacts(self.mechanism, &|_| true);
        let couple = |hinge: &RubbingHinge| (answers.column(hinge.column).into_owned(), hinge.leverage);
        Ok(InfluenceCoefficients {
            eta_preload: preload_columns(self.mechanism, &eta),
            eta,
            mu,
            preload,
            velocity_signs: self.velocity_signs()?,
            frictionless: DVector::from_fn(rows, |row, _| entry(row, 0, scale)),
            shared: shared_load(self.mechanism, self_stress).map_err(NotEnclosed::Values)?,
            one_sided: self.openings().map(|(contact, at)| (contact.index(), column(at))).collect(),
            turning: rubbing.iter().map(couple).collect(),
        })
    }

    /// The contacts that may lift off, each with the column of its opening among all answers.
    fn openings(&self) -> impl Iterator<Item = (ContactId, usize)> {
        let layout = &self.equations.layout;
        layout.one_sided().iter().copied().zip(self.first_couple() + self.equations.couples.len()..)
    }

    /// The first column of the answers to a unit friction at the other face of each contact, in space alone: there the couple
    /// between both faces of a contact leans with its normal, and anything may take it up.
    fn first_other_face(&self) -> usize {
        self.first_couple() + self.equations.couples.len() + self.equations.layout.one_sided().len()
    }

    /// The first column of the answers to a unit couple.
    fn first_couple(&self) -> usize {
        1 + self.mechanism.contacts.len() + self.equations.layout.cut().len()
    }

    /// All unknowns without friction (column 0), and what a unit friction of each contact adds to them at the
    /// face that is pressed when its normal force is positive, then what a unit normal force of each cut contact
    /// adds, then a unit couple of each friction circle, then the opening of each contact that may lift off, and in space a
    /// unit friction of each contact at its other face; none if the equations are not proven to be regular.
    pub(super) fn unknowns(&self, work: Work<'_>) -> Option<DMatrix<Interval>> {
        let Assembled { layout, matrix, load, friction, couples, .. } = self.equations;
        let (rows, columns) = equilibration(&matrix.map(Interval::middle));
        let (units, openings) = (layout.cut_units(), layout.opening_units());
        let sides: Vec<&DVector<Interval>> = std::iter::once(load)
            .chain(friction.iter().map(|faces| &faces[0]))
            .chain(&units)
            .chain(couples)
            .chain(&openings)
            .chain(friction.iter().filter(|_| self.mechanism.space.is_some()).map(|faces| &faces[1]))
            .collect();
        let right = DMatrix::from_fn(load.len(), sides.len(), |row, column| {
            sides[column][row] * Interval::point(rows[row])
        });
        let solution = solution(&scaled(matrix, &rows, &columns), &right, work)?;
        let mut unknowns = DMatrix::from_fn(load.len(), sides.len(), |row, column| {
            solution.entry(row, column) * Interval::point(columns[row])
        });
        let first = self.first_couple() + couples.len();
        let answers =
            (first..first + openings.len()).map(|column| unknowns.column(column).into_owned()).collect();
        for (column, opening) in (first..).zip(layout.openings(answers)) {
            unknowns.set_column(column, &opening.answer);
        }
        Some(unknowns)
    }

    /// The self-stresses in the rows of all answers, of which the first are forces. That nothing but rounding stands where a
    /// contact takes no part is known from the rank of the joint equations, which is decided in the drawing.
    fn self_stresses(&self, answers: &DMatrix<Interval>, forces: usize) -> DMatrix<Interval> {
        let first = 1 + self.mechanism.contacts.len();
        DMatrix::from_fn(answers.nrows(), self.equations.layout.cut().len(), |row, stress| {
            let value = answers[(row, first + stress)];
            let is_rounding = value.contains(0.0) && (self.are_numbers || value.magnitude() <= NO_STRESS);
            if is_rounding && row < forces { Interval::ZERO } else { value }
        })
    }

    /// Bounds that hold zero for rounding alone, with zero in their middle, so that what belongs on a
    /// boundary is found there.
    fn without_rounding(&self, value: Interval, scale: f64) -> Interval {
        let is_rounding = value.contains(0.0) && (self.are_numbers || value.magnitude() <= ROUNDING * scale);
        if is_rounding { Interval::around(0.0, value.magnitude()) } else { value }
    }

    /// The guided sliders, with the places of their couples among the unknowns.
    fn couples(&self) -> Vec<(EnclosedCouple, usize)> {
        let couple = |(joint, slider): (JointId, &Slider<Interval>)| {
            let row = self.equations.layout.reaction(Reaction::Couple(joint))?;
            let contact = slider.contacts.first()?.index();
            let half_length = slider.length * Interval::point(0.5);
            Some((EnclosedCouple { contact, height: slider.height, half_length }, row))
        };
        self.mechanism.sliders().filter_map(couple).collect()
    }

    /// The accelerations of the coordinates, a column for each of the unknowns. Self-stresses change none, and neither does a
    /// couple between the two faces of a joint, as [`Self::negative_versions`] says.
    fn accelerations(&self, unknowns: &DMatrix<Interval>) -> Vec<RowDVector<Interval>> {
        self.equations.coordinate_rows.iter().map(|row| self.acceleration(unknowns, row)).collect()
    }

    fn acceleration(
        &self,
        unknowns: &DMatrix<Interval>,
        row: &ConstraintRow<Interval>,
    ) -> RowDVector<Interval> {
        let first = 1 + self.mechanism.contacts.len();
        let cut = first..first + self.equations.layout.cut().len();
        RowDVector::from_fn(unknowns.ncols(), |_, column| {
            let terms = row.entries.iter().map(|&(index, value)| value * unknowns[(index, column)]);
            match column {
                0 => terms.fold(Interval::ZERO, |sum, term| sum + term) - row.right_hand_side,
                column if cut.contains(&column) => Interval::ZERO,
                _ => terms.fold(Interval::ZERO, |sum, term| sum + term),
            }
        })
    }

    /// The power of loads and weights, from which each friction force takes its own times the sliding
    /// velocity, and each friction couple its own times the angular velocity of its hinge; of so many columns.
    fn power(&self, columns: usize) -> RowDVector<Interval> {
        let of_load = |wrench: &Wrench<Interval>| {
            let velocity = self.configuration.velocity_at(wrench.frame, wrench.place);
            wrench.force.dot(&velocity) + wrench.couple * self.configuration.angular_velocity(wrench.frame)
        };
        let mut power = RowDVector::from_element(columns, Interval::ZERO);
        power[0] = self.equations.applied.iter().map(of_load).fold(Interval::ZERO, |sum, power| sum + power);
        for (k, contact) in self.equations.contacts.iter().enumerate() {
            power[1 + k] = -contact.sliding_velocity;
            if self.mechanism.space.is_some() {
                power[self.first_other_face() + k] = -contact.sliding_velocity;
            }
        }
        for (index, circle) in self.mechanism.friction_circles.iter().enumerate() {
            power[self.first_couple() + index] = self.configuration.rubbing(self.mechanism, circle);
        }
        power
    }

    /// The greatest sum of sizes of forces in an equation of motion, for given unknowns (N).
    fn greatest_force(&self, unknown: &dyn Fn(usize) -> Interval) -> f64 {
        let Assembled { matrix, load, .. } = self.equations;
        let forces = |row: usize| {
            let terms = matrix.row(row).into_iter().enumerate();
            let sum: f64 = terms.map(|(column, entry)| (*entry * unknown(column)).magnitude()).sum();
            sum + load[row].magnitude()
        };
        let in_plane = (0..self.mechanism.bodies.len()).flat_map(|body| [3 * body, 3 * body + 1]);
        let along_z = (3 * self.mechanism.bodies.len()..self.equations.layout.accelerations()).step_by(3);
        in_plane.chain(along_z).map(forces).fold(0.0, f64::max)
    }

    /// The influence of friction at the other faces.
    ///
    /// Between both faces friction differs by a couple `h` on the block and its opposite on the guide. These
    /// do not turn against each other, so that the couple changes no acceleration and no other joint: the
    /// couple of a guided slider takes it up, or the two contacts of a block slider with their distance `o`,
    ///
    /// ```text
    /// eta_jk^- = eta_jk^+ - h/o (front), + h/o (rear),      eta_jk^- = eta_jk^+ else
    /// ```
    ///
    /// A contact that is cut takes up nothing: what it would, a self-stress hands to the others.
    fn negative_versions(
        &self,
        mut eta: DMatrix<Interval>,
        self_stress: &DMatrix<Interval>,
    ) -> DMatrix<Interval> {
        let cut = self.equations.layout.cut();
        for k in 0..eta.ncols() {
            for (contact, force) in self.taken_up_between_faces(k) {
                match cut.iter().position(|cut| cut.index() == contact) {
                    None => eta[(contact, k)] += force,
                    Some(stress) => (0..eta.nrows())
                        .filter(|row| *row != contact)
                        .for_each(|row| eta[(row, k)] -= force * self_stress[(row, stress)]),
                }
            }
        }
        eta
    }

    /// The normal forces by which the contacts of a block slider take up the couple between both faces of a
    /// contact, -h/o at the front and h/o at the rear; nothing for other sliders.
    fn taken_up_between_faces(&self, contact: usize) -> Vec<(usize, Interval)> {
        let has_two_faces =
            |slider: &&Slider<Interval>| slider.kind == SliderKind::Block && slider.height != Interval::ZERO;
        let Some(slider) = self.slider(contact).filter(has_two_faces) else { return Vec::new() };
        let [front, rear, ..] = slider.contacts[..] else { return Vec::new() };
        let overlap = self.configuration.overlap(self.mechanism, slider);
        let force = slider.height / overlap.unwrap_or(Interval::REAL_LINE);
        vec![(front.index(), -force), (rear.index(), force)]
    }

    /// The signs s_k of the sliding velocities; where there is no friction one that is not known is 0.
    fn velocity_signs(&self) -> Result<DVector<f64>, NotEnclosed> {
        let contacts = self.mechanism.contacts.iter().zip(&self.equations.contacts);
        let sign =
            |(contact, geometry): (&Contact<Interval>, &crate::configuration::ContactGeometry<Interval>)| {
                let velocity = geometry.sliding_velocity;
                match velocity.sign() {
                    _ if self.at_rest.contains(&contact.joint) => Ok(0.0),
                    Some(Sign::Positive) => Ok(1.0),
                    Some(Sign::Negative) => Ok(-1.0),
                    _ if contact.is_frictionless() => Ok(0.0),
                    _ => Err(NotEnclosed::SlidingDirection { contact: contact.name.to_string(), velocity }),
                }
            };
        let signs: Vec<f64> = contacts.map(sign).collect::<Result<_, _>>()?;
        Ok(DVector::from_vec(signs))
    }

    /// Moves `d_k` to the right-hand side wherever it is the same on both sides, or all
    /// but the same: `N(0) + d_k`, `d_k = s_k F_k0 eta_k`.
    fn without_shared_jumps(
        &self,
        influence: &InfluenceCoefficients<Interval>,
    ) -> InfluenceCoefficients<Interval> {
        let contacts = self.mechanism.contacts.len();
        let mut without = influence.clone();
        for k in 0..contacts {
            let jumps = |row: usize| Side::BOTH.map(|side| influence.preload_friction(side, row, k));
            let jumps: Vec<[Interval; 2]> = (0..influence.frictionless.len()).map(jumps).collect();
            if self.has_shared_jump(k) || self.may_be_shared(&jumps) {
                for (right, [positive, negative]) in without.frictionless.iter_mut().zip(jumps) {
                    *right += positive.hull(negative);
                }
                (without.preload.positive[k], without.preload.negative[k]) = (Interval::ZERO, Interval::ZERO);
            }
        }
        without
    }

    /// Whether `d_k^+` and `d_k^-` are the same number: one formula of the preload, and one line of its
    /// friction.
    fn has_shared_jump(&self, contact: usize) -> bool {
        let joint = self.mechanism.contacts[contact].joint;
        let Some(slider) = self.mechanism.slider(joint) else { return false };
        // The couple of a guided slider takes up the moment of friction.
        let one_line =
            slider.kind == SliderKind::Guided || !self.mechanism.preload_changes_face(ContactId(contact));
        let JointKind::Slider(written) = &self.model.joints[joint.index()].kind else { return false };
        let at = slider.contacts.iter().position(|id| id.index() == contact);
        let formulas =
            at.and_then(|at| written.contacts.get(at)).map(|contact: &model::Contact| contact.preload);
        one_line && formulas.is_some_and(|[positive, negative]| positive == negative)
    }

    /// Whether nothing tells `d_k^+` from `d_k^-` but rounding. A gap between them is the boundary between
    /// both sides then, and the hull of both holds every share of them. Of exact numbers (raw problems) this
    /// is never asked.
    fn may_be_shared(&self, jumps: &[[Interval; 2]]) -> bool {
        jumps.iter().all(|&[positive, negative]| {
            let difference = positive - negative;
            difference == Interval::ZERO || self.are_numbers && difference.contains(0.0)
        })
    }

    /// The hinges, with a certain sense of every one.
    pub(super) fn rubbing(&self, hinges: &[TurningHinge]) -> Result<Vec<RubbingHinge>, NotEnclosed> {
        let one = |hinge: &TurningHinge| {
            let circle = &self.mechanism.friction_circles[hinge.circle];
            let spin = self.configuration.rubbing(self.mechanism, circle);
            let wanted = if hinge.sense > 0.0 { Sign::Positive } else { Sign::Negative };
            if spin.sign() == Some(wanted) {
                let leverage = hinge.leverage(circle);
                Ok(RubbingHinge { column: self.first_couple() + hinge.circle, leverage })
            } else {
                Err(match circle.end {
                    None => {
                        let hinge = self.mechanism.joints[hinge.joint.index()].name.to_string();
                        NotEnclosed::SenseOfRotation { hinge, spin }
                    }
                    Some([along_n, _]) => {
                        let contact = self.mechanism.contacts[along_n.index()].name.to_string();
                        NotEnclosed::SlidingDirection { contact, velocity: spin }
                    }
                })
            }
        };
        hinges.iter().map(one).collect()
    }

    fn slider(&self, contact: usize) -> Option<&Slider<Interval>> {
        self.mechanism.slider(self.mechanism.contacts[contact].joint)
    }
}
