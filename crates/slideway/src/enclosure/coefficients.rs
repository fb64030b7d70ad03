//! From kinetic equations within intervals to bounds of the influence coefficients.

use super::{EnclosedCouple, EnclosedOutput, EnclosedOutputs, NotEnclosed, solution};
use crate::configuration::Configuration;
use crate::ids::{ContactId, JointId};
use crate::interval::{Interval, Sign};
use crate::kinetics::{Assembled, ConstraintRow, Reaction, Wrench, equilibration, scaled};
use crate::mechanism::{Contact, Mechanism, Slider};
use crate::model::{self, JointKind, Model, SliderKind};
use crate::modes::{BySide, InfluenceCoefficients, Side};
use crate::problem::{ProblemCoefficients, TurningHinge, friction_of_contacts};
use crate::progress::Work;
use crate::sharing::{NO_STRESS, shared_load};
use nalgebra::{DMatrix, DVector};

/// Where parameters are uncertain, forces below this multiple of the greatest are taken for nothing but
/// rounding. It is a convention, which decides only what is called a solution in the middle of the bounds,
/// not the bounds.
const ROUNDING: f64 = 1e-12;

/// A hinge that turns with friction, within bounds.
pub(super) struct RubbingHinge {
    /// The column of the answers to a unit couple on its first body among all unknowns.
    column: usize,
    /// The couple on its first body by its force: -r sgn(omega) (theory of hinges, section 1).
    leverage: Interval,
    /// The angular velocity of its first body against the second (rad/s).
    spin: Interval,
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
}

impl Coefficients<'_> {
    /// Returns the coefficients of the problem of the contacts and of these hinges, and the influence
    /// coefficients of the contacts in its rows with all jumps.
    pub(super) fn problem(
        &self,
        unknowns: &DMatrix<Interval>,
        hinges: &[TurningHinge],
        rubbing: &[RubbingHinge],
    ) -> Result<(ProblemCoefficients<Interval>, InfluenceCoefficients<Interval>), NotEnclosed> {
        let layout = &self.equations.layout;
        let normals = (0..self.mechanism.contacts.len()).map(|k| Reaction::Normal(ContactId(k)));
        let forces = hinges.iter().flat_map(|hinge| [0, 1].map(|axis| Reaction::Hinge(hinge.joint, axis)));
        let rows: Option<Vec<usize>> = normals.chain(forces).map(|force| layout.reaction(force)).collect();
        let rows = rows.ok_or(NotEnclosed::Equations)?;
        let influence = self.influence(unknowns, &rows)?;
        let circle = |hinge: &TurningHinge| (*hinge, self.mechanism.friction_circles[hinge.circle]);
        let coefficients = ProblemCoefficients {
            contacts: self.without_shared_jumps(&influence),
            couples: DMatrix::from_fn(rows.len(), rubbing.len(), |row, hinge| {
                unknowns[(rows[row], rubbing[hinge].column)]
            }),
            hinges: hinges.iter().map(circle).collect(),
        };
        Ok((coefficients, influence))
    }

    /// Bounds of the influence coefficients of the contacts in these rows.
    fn influence(
        &self,
        unknowns: &DMatrix<Interval>,
        rows: &[usize],
    ) -> Result<InfluenceCoefficients<Interval>, NotEnclosed> {
        let contacts = self.mechanism.contacts.len();
        let scale = self.greatest_force(&|row| unknowns[(row, 0)]);
        let self_stress = self.self_stresses(unknowns, rows);
        let positive = DMatrix::from_fn(rows.len(), contacts, |row, k| {
            self.without_rounding(unknowns[(rows[row], 1 + k)], 1.0)
        });
        let negative = self.negative_versions(positive.clone(), &self_stress);
        let eta = BySide { positive, negative };
        let [mu, preload] = friction_of_contacts(self.mechanism, &|_| true);
        Ok(InfluenceCoefficients {
            eta_preload: self.preload_columns(&eta),
            eta,
            mu,
            preload,
            velocity_signs: self.velocity_signs()?,
            frictionless: DVector::from_fn(rows.len(), |row, _| {
                self.without_rounding(unknowns[(rows[row], 0)], scale)
            }),
            shared: shared_load(self.mechanism, self_stress).map_err(NotEnclosed::Values)?,
            one_sided: self.openings(|at| {
                DVector::from_fn(rows.len(), |row, _| self.without_rounding(unknowns[(rows[row], at)], 1.0))
            }),
        })
    }

    /// For each contact that may lift off what follows from the column of its opening among all unknowns.
    fn openings<R>(&self, of_column: impl Fn(usize) -> R) -> Vec<(usize, R)> {
        let layout = &self.equations.layout;
        let first = 1 + self.mechanism.contacts.len() + layout.cut().len() + self.equations.couples.len();
        let contacts = layout.one_sided().iter().zip(first..);
        contacts.map(|(contact, at)| (contact.index(), of_column(at))).collect()
    }

    /// All unknowns without friction (column 0), and what a unit friction of each contact adds to them at the
    /// face that is pressed when its normal force is positive, then what a unit normal force of each cut contact
    /// adds, then a unit couple of each friction circle, then the opening of each contact that may lift off; none if the
    /// equations are not proven to be regular.
    pub(super) fn unknowns(&self, work: Work<'_>) -> Option<DMatrix<Interval>> {
        let Assembled { layout, matrix, load, friction, couples, .. } = self.equations;
        let (rows, columns) = equilibration(&matrix.map(Interval::middle));
        let (units, openings) = (layout.cut_units(), layout.opening_units());
        let sides: Vec<&DVector<Interval>> = std::iter::once(load)
            .chain(friction.iter().map(|faces| &faces[0]))
            .chain(&units)
            .chain(couples)
            .chain(&openings)
            .collect();
        let right = DMatrix::from_fn(load.len(), sides.len(), |row, column| {
            sides[column][row] * Interval::point(rows[row])
        });
        let solution = solution(&scaled(matrix, &rows, &columns), &right, work)?;
        let mut unknowns = DMatrix::from_fn(load.len(), sides.len(), |row, column| {
            solution.entry(row, column) * Interval::point(columns[row])
        });
        let first = sides.len() - openings.len();
        let answers = (first..sides.len()).map(|column| unknowns.column(column).into_owned()).collect();
        for (column, opening) in (first..).zip(layout.openings(answers)) {
            unknowns.set_column(column, &opening.answer);
        }
        Some(unknowns)
    }

    /// The forces of the self-stresses in these rows. That nothing but rounding stands where a contact takes
    /// no part is known from the rank of the joint equations, which is decided in the drawing.
    fn self_stresses(&self, unknowns: &DMatrix<Interval>, rows: &[usize]) -> DMatrix<Interval> {
        let first = 1 + self.mechanism.contacts.len();
        DMatrix::from_fn(rows.len(), self.equations.layout.cut().len(), |row, stress| {
            let value = unknowns[(rows[row], first + stress)];
            let is_rounding = value.contains(0.0) && (self.are_numbers || value.magnitude() <= NO_STRESS);
            if is_rounding { Interval::ZERO } else { value }
        })
    }

    /// Bounds that hold zero for rounding alone, with zero in their middle, so that what belongs on a
    /// boundary is found there.
    fn without_rounding(&self, value: Interval, scale: f64) -> Interval {
        let is_rounding = value.contains(0.0) && (self.are_numbers || value.magnitude() <= ROUNDING * scale);
        if is_rounding { Interval::around(0.0, value.magnitude()) } else { value }
    }

    /// What follows from the forces.
    pub(super) fn outputs(
        &self,
        influence: InfluenceCoefficients<Interval>,
        unknowns: &DMatrix<Interval>,
        hinges: &[RubbingHinge],
    ) -> EnclosedOutputs {
        EnclosedOutputs {
            influence,
            couples: self.couples(unknowns, hinges),
            accelerations: self.accelerations(unknowns, hinges),
            power: self.power(hinges),
        }
    }

    /// The couples of the guided sliders.
    fn couples(&self, unknowns: &DMatrix<Interval>, hinges: &[RubbingHinge]) -> Vec<EnclosedCouple> {
        let joints = self.mechanism.joints.iter().enumerate();
        let couple = |(index, _)| {
            let joint = JointId(index);
            let slider = self.mechanism.slider(joint)?;
            let row = self.equations.layout.reaction(Reaction::Couple(joint))?;
            let contact = slider.contacts.first()?.index();
            let (contacts, row_of) = (self.mechanism.contacts.len(), unknowns.row(row));
            let positive: Vec<Interval> = row_of.iter().skip(1).take(contacts).copied().collect();
            let cut = self.equations.layout.cut().iter().map(|cut| cut.index());
            let self_stress: Vec<(usize, Interval)> =
                cut.zip(row_of.iter().skip(1 + contacts).copied()).collect();
            // At the other face the slider's own friction turns by h more the one way, and its couple the
            // other way.
            let mut negative = positive.clone();
            negative[contact] -= slider.height;
            for (k, other) in negative.iter_mut().enumerate() {
                let taken_up = self.taken_up_between_faces(k);
                for &(cut, stress) in &self_stress {
                    let by_cut = taken_up.iter().filter(|(by, _)| *by == cut);
                    by_cut.for_each(|(_, force)| *other -= *force * stress);
                }
            }
            let influence = BySide { positive, negative };
            Some(EnclosedCouple {
                contact,
                half_length: slider.length * Interval::point(0.5),
                couple: EnclosedOutput {
                    frictionless: unknowns[(row, 0)],
                    influence_preload: self.couple_of_preload(&influence),
                    influence,
                    self_stress,
                    openings: self.openings(|column| row_of[column]),
                    hinges: hinges.iter().map(|hinge| row_of[hinge.column] * hinge.leverage).collect(),
                },
            })
        };
        joints.filter_map(couple).collect()
    }

    /// The accelerations of the coordinates. A couple between the two faces of a joint changes none, as
    /// [`Self::negative_versions`] says.
    fn accelerations(&self, unknowns: &DMatrix<Interval>, hinges: &[RubbingHinge]) -> Vec<EnclosedOutput> {
        let output = |row: &ConstraintRow<Interval>| {
            let times = |column: usize| {
                let terms = row.entries.iter().map(|&(index, value)| value * unknowns[(index, column)]);
                terms.fold(Interval::ZERO, |sum, term| sum + term)
            };
            let influence = (1..=self.mechanism.contacts.len()).map(times).collect();
            let hinges = hinges.iter().map(|hinge| times(hinge.column) * hinge.leverage).collect();
            let output = EnclosedOutput::of_either_face(times(0) - row.right_hand_side, influence, hinges);
            EnclosedOutput { openings: self.openings(times), ..output }
        };
        self.equations.coordinate_rows.iter().map(output).collect()
    }

    /// The power of loads and weights, from which each friction force takes its own times the sliding
    /// velocity, and each friction couple its own times the angular velocity of its hinge.
    fn power(&self, hinges: &[RubbingHinge]) -> EnclosedOutput {
        let of_load = |wrench: &Wrench<Interval>| {
            let velocity = self.configuration.velocity_at(wrench.frame, wrench.place);
            wrench.force.dot(&velocity) + wrench.couple * self.configuration.angular_velocity(wrench.frame)
        };
        let loads = self.equations.applied.iter().map(of_load).fold(Interval::ZERO, |sum, power| sum + power);
        let friction = self.equations.contacts.iter().map(|contact| -contact.sliding_velocity).collect();
        let hinges = hinges.iter().map(|hinge| hinge.spin * hinge.leverage).collect();
        EnclosedOutput::of_either_face(loads, friction, hinges)
    }

    /// The influence of the preload's friction on a couple: at the pressed face, or in the middle between
    /// both.
    fn couple_of_preload(&self, influence: &BySide<Vec<Interval>>) -> BySide<Vec<Interval>> {
        let mut preload = influence.clone();
        for (k, contact) in self.mechanism.contacts.iter().enumerate() {
            let faces = [influence.positive[k], influence.negative[k]];
            [preload.positive[k], preload.negative[k]] = contact.preload_line.of_faces(faces);
        }
        preload
    }

    /// The greatest sum of sizes of forces in an equation of motion, for given unknowns (N).
    fn greatest_force(&self, unknown: &dyn Fn(usize) -> Interval) -> f64 {
        let Assembled { matrix, load, .. } = self.equations;
        let forces = |row: usize| {
            let terms = matrix.row(row).into_iter().enumerate();
            let sum: f64 = terms.map(|(column, entry)| (*entry * unknown(column)).magnitude()).sum();
            sum + load[row].magnitude()
        };
        let bodies = 0..self.mechanism.bodies.len();
        bodies.flat_map(|body| [3 * body, 3 * body + 1]).map(forces).fold(0.0, f64::max)
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
        let Some(slider) = self.slider(contact).filter(|slider| has_two_faces(slider)) else {
            return Vec::new();
        };
        let [front, rear, ..] = slider.contacts[..] else { return Vec::new() };
        let overlap = self.configuration.overlap(self.mechanism, slider);
        let force = slider.height / overlap.unwrap_or(Interval::REAL_LINE);
        vec![(front.index(), -force), (rear.index(), force)]
    }

    /// The columns of the preload's friction: at the pressed face, or in the middle between both.
    fn preload_columns(&self, eta: &BySide<DMatrix<Interval>>) -> BySide<DMatrix<Interval>> {
        let mut preload = eta.clone();
        for (k, contact) in self.mechanism.contacts.iter().enumerate() {
            if !self.slider(k).is_some_and(has_two_faces) {
                continue;
            }
            for at in (0..eta.positive.nrows()).map(|row| (row, k)) {
                let faces = contact.preload_line.of_faces([eta.positive[at], eta.negative[at]]);
                [preload.positive[at], preload.negative[at]] = faces;
            }
        }
        preload
    }

    /// The signs s_k of the sliding velocities; where there is no friction one that is not known is 0.
    fn velocity_signs(&self) -> Result<DVector<f64>, NotEnclosed> {
        let contacts = self.mechanism.contacts.iter().zip(&self.equations.contacts);
        let sign =
            |(contact, geometry): (&Contact<Interval>, &crate::configuration::ContactGeometry<Interval>)| {
                let velocity = geometry.sliding_velocity;
                match velocity.sign() {
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
        let first_couple = 1 + self.mechanism.contacts.len() + self.equations.layout.cut().len();
        let one = |hinge: &TurningHinge| {
            let spin = self.configuration.spin(self.mechanism, hinge.joint);
            let wanted = if hinge.sense > 0.0 { Sign::Positive } else { Sign::Negative };
            if spin.sign() == Some(wanted) {
                let leverage = hinge.leverage(&self.mechanism.friction_circles[hinge.circle]);
                Ok(RubbingHinge { column: first_couple + hinge.circle, leverage, spin })
            } else {
                let hinge = self.mechanism.joints[hinge.joint.index()].name.to_string();
                Err(NotEnclosed::SenseOfRotation { hinge, spin })
            }
        };
        hinges.iter().map(one).collect()
    }

    fn slider(&self, contact: usize) -> Option<&Slider<Interval>> {
        self.mechanism.slider(self.mechanism.contacts[contact].joint)
    }
}

/// Whether it makes a difference at which face friction acts.
fn has_two_faces(slider: &Slider<Interval>) -> bool {
    slider.kind == SliderKind::Block && slider.height != Interval::ZERO
}
