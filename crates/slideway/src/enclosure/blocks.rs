//! The numbers of the block mode problem of a mechanism with friction in hinges, rounded or within intervals.

use super::coefficients::Coefficients;
use super::{EnclosedOutputs, NotEnclosed, UncertainParameters, with_coefficients};
use crate::configuration::Configuration;
use crate::ids::{ContactId, Frame, JointId};
use crate::interval::{Interval, Real, Sign};
use crate::kinetics::Reaction;
use crate::mechanism::{FrictionCircle, JointKind, Mechanism};
use crate::model::Model;
use crate::modes::BySide;
use crate::modes::blocks::BlockProblem;
use crate::modes::certificate::{IntervalInfluence, IntervalMatrix};
use crate::progress::Work;
use nalgebra::{DMatrix, DVector};

/// A hinge with friction that turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurningHinge {
    /// Its friction circle among those of the mechanism.
    pub(crate) circle: usize,
    /// The hinge.
    pub(crate) joint: JointId,
    /// Sense in which its first body turns against the second: 1 or -1.
    pub(crate) sense: f64,
}

/// A hinge that turns with friction, within bounds.
pub(super) struct RubbingHinge {
    /// The column of the answers to a unit couple on its first body among all unknowns.
    pub(super) column: usize,
    /// The couple on its first body by its force: -r sgn(omega).
    pub(super) leverage: Interval,
    /// The angular velocity of its first body against the second (rad/s).
    pub(super) spin: Interval,
}

/// What is known of the block mode problem of an exact mechanism, or of one with uncertain parameters.
pub(crate) struct EnclosedBlockProblem {
    /// Its numbers.
    pub(crate) problem: BlockProblem,
    /// What follows from the forces.
    pub(crate) outputs: EnclosedOutputs,
    /// The friction circles of its hinges.
    circles: Vec<FrictionCircle<Interval>>,
}

impl EnclosedBlockProblem {
    /// The problem with all friction multiplied by a factor; none if numbers overflow.
    pub(crate) fn rougher(&self, factor: f64) -> Option<BlockProblem> {
        let factor = Interval::point(factor);
        let hinges = self.circles.iter().map(|circle| circle.growth(factor));
        let factors: Vec<Interval> =
            std::iter::repeat_n(factor, self.problem.contacts()).chain(hinges).collect();
        self.problem.with_response_within(&factors)
    }
}

/// What the block mode problem `x = b + d^sigma + H^sigma w` is made of: rows are the normal forces, then both
/// components of the force of each hinge that turns.
#[derive(Debug, Clone)]
pub(crate) struct BlockCoefficients<T> {
    /// What a unit friction force of each contact adds at either face, and where the preload's friction acts.
    pub(crate) eta: BySide<DMatrix<T>>,
    pub(crate) eta_preload: BySide<DMatrix<T>>,
    /// Friction coefficients and preloads.
    pub(crate) mu: BySide<DVector<T>>,
    pub(crate) preload: BySide<DVector<T>>,
    /// The signs of the sliding velocities.
    pub(crate) velocity_signs: DVector<f64>,
    /// What a unit couple on the first body of each hinge adds.
    pub(crate) couples: DMatrix<T>,
    /// The couple on the first body of each hinge by its force: -r sgn(omega) (theory of hinges, section 1).
    pub(crate) leverage: DVector<T>,
    /// Everything without friction.
    pub(crate) frictionless: DVector<T>,
}

impl<T: Real> BlockCoefficients<T> {
    /// `H^sigma`: columns `mu_k s_k eta_k^sigma` of the contacts, `-r_j sgn(omega_j)` times the answer to a unit couple of
    /// the hinges.
    pub(crate) fn response(&self) -> BySide<DMatrix<T>> {
        let side = |eta: &DMatrix<T>, mu: &DVector<T>| {
            let contacts = mu.len();
            DMatrix::from_fn(eta.nrows(), contacts + self.leverage.len(), |row, column| {
                match column.checked_sub(contacts) {
                    None => eta[(row, column)] * mu[column] * T::exactly(self.velocity_signs[column]),
                    Some(hinge) => self.couples[(row, hinge)] * self.leverage[hinge],
                }
            })
        };
        BySide {
            positive: side(&self.eta.positive, &self.mu.positive),
            negative: side(&self.eta.negative, &self.mu.negative),
        }
    }

    /// `d_k^sigma = F_k0 s_k eta_k^sigma`, a column for each contact.
    pub(crate) fn jumps(&self) -> BySide<DMatrix<T>> {
        let side = |eta: &DMatrix<T>, preload: &DVector<T>| {
            DMatrix::from_fn(eta.nrows(), preload.len(), |row, k| {
                eta[(row, k)] * preload[k] * T::exactly(self.velocity_signs[k])
            })
        };
        BySide {
            positive: side(&self.eta_preload.positive, &self.preload.positive),
            negative: side(&self.eta_preload.negative, &self.preload.negative),
        }
    }
}

/// Bounds of the block mode problem of the mechanism that `model` describes, for all values of the parameters in
/// `uncertain`; `hinges` are those with friction, with the sense in which they turn.
///
/// # Errors
/// [`NotEnclosed`] if it could not be proven; nothing is known then.
pub(crate) fn enclosed_block_problem(
    model: &Model,
    uncertain: &UncertainParameters,
    state: (&Mechanism, &Configuration),
    hinges: &[TurningHinge],
    work: Work<'_>,
) -> Result<EnclosedBlockProblem, NotEnclosed> {
    with_coefficients(model, uncertain, state, work, |coefficients| {
        let rubbing = coefficients.rubbing(hinges)?;
        let unknowns = coefficients.unknowns(work).ok_or(NotEnclosed::Equations)?;
        let influence = coefficients.influence(&unknowns)?;
        let numbers = coefficients.block_coefficients(&unknowns, &influence, (hinges, &rubbing))?;
        let bounded =
            |matrix: &DMatrix<Interval>| IntervalMatrix::from_intervals(matrix).ok_or(NotEnclosed::Equations);
        let both = |sides: BySide<DMatrix<Interval>>| {
            Ok::<_, NotEnclosed>(BySide {
                positive: bounded(&sides.positive)?,
                negative: bounded(&sides.negative)?,
            })
        };
        let load = DMatrix::from_column_slice(numbers.frictionless.len(), 1, numbers.frictionless.as_slice());
        let [response, jumps] = [both(numbers.response())?, both(numbers.jumps())?];
        let problem = BlockProblem::within_bounds(response, jumps, bounded(&load)?)
            .map_err(|_| NotEnclosed::Equations)?;
        let circle = |hinge: &TurningHinge| coefficients.mechanism.friction_circles[hinge.circle];
        let circles = hinges.iter().map(circle).collect();
        Ok(EnclosedBlockProblem {
            problem,
            outputs: coefficients.outputs(influence, &unknowns, &rubbing),
            circles,
        })
    })
}

impl Coefficients<'_> {
    fn block_coefficients(
        &self,
        unknowns: &DMatrix<Interval>,
        influence: &IntervalInfluence,
        (hinges, rubbing): (&[TurningHinge], &[RubbingHinge]),
    ) -> Result<BlockCoefficients<Interval>, NotEnclosed> {
        let without = self.without_shared_jumps(influence)?;
        let contacts = self.mechanism.contacts.len();
        let rows = self.hinge_rows(hinges);
        // Rows of hinge forces: a couple between both faces of a contact changes no other joint.
        let extended = |of_contacts: &IntervalMatrix| {
            DMatrix::from_fn(contacts + rows.len(), contacts, |row, k| match row.checked_sub(contacts) {
                None => of_contacts.entry(row, k),
                Some(hinge) => unknowns[(rows[hinge], 1 + k)],
            })
        };
        let column = |vector: &IntervalMatrix| DVector::from_fn(contacts, |k, _| vector.entry(k, 0));
        let normals =
            (0..contacts).filter_map(|k| self.equations.layout.reaction(Reaction::Normal(ContactId(k))));
        let all: Vec<usize> = normals.chain(rows.iter().copied()).collect();
        let frictionless = DVector::from_fn(all.len(), |row, _| match row.checked_sub(contacts) {
            None => without.frictionless.entry(row, 0),
            Some(hinge) => {
                let answers = |k: usize| unknowns[(rows[hinge], 1 + k)];
                unknowns[(rows[hinge], 0)] + shared_jumps([influence, &without], &answers)
            }
        });
        Ok(BlockCoefficients {
            eta: BySide {
                positive: extended(&influence.eta.positive),
                negative: extended(&influence.eta.negative),
            },
            eta_preload: BySide {
                positive: extended(&influence.eta_preload.positive),
                negative: extended(&influence.eta_preload.negative),
            },
            mu: BySide { positive: column(&influence.mu.positive), negative: column(&influence.mu.negative) },
            preload: BySide {
                positive: column(&without.preload.positive),
                negative: column(&without.preload.negative),
            },
            velocity_signs: influence.velocity_signs.clone(),
            couples: DMatrix::from_fn(all.len(), rubbing.len(), |row, hinge| {
                unknowns[(all[row], rubbing[hinge].column)]
            }),
            leverage: DVector::from_fn(rubbing.len(), |hinge, _| rubbing[hinge].leverage),
            frictionless,
        })
    }

    fn hinge_rows(&self, hinges: &[TurningHinge]) -> Vec<usize> {
        let components = |hinge: &TurningHinge| {
            [0, 1].map(|axis| self.equations.layout.reaction(Reaction::Hinge(hinge.joint, axis)))
        };
        hinges.iter().flat_map(components).flatten().collect()
    }

    /// The hinges, with a certain sense of every one.
    fn rubbing(&self, hinges: &[TurningHinge]) -> Result<Vec<RubbingHinge>, NotEnclosed> {
        let first_couple = 1 + self.mechanism.contacts.len() + self.equations.layout.cut().len();
        let one = |hinge: &TurningHinge| {
            let spin = spin(self.mechanism, self.configuration, hinge.joint);
            let wanted = if hinge.sense > 0.0 { Sign::Positive } else { Sign::Negative };
            if spin.sign() == Some(wanted) {
                let radius = self.mechanism.friction_circles[hinge.circle].radius;
                let leverage = -radius * Interval::point(hinge.sense);
                Ok(RubbingHinge { column: first_couple + hinge.circle, leverage, spin })
            } else {
                let hinge = self.mechanism.joints[hinge.joint.index()].name.to_string();
                Err(NotEnclosed::SenseOfRotation { hinge, spin })
            }
        };
        hinges.iter().map(one).collect()
    }
}

/// What `without_shared_jumps` has moved to the right-hand side, in a row with these answers to friction.
fn shared_jumps([before, after]: [&IntervalInfluence; 2], answers: &dyn Fn(usize) -> Interval) -> Interval {
    let moved = |k: usize| {
        let [positive, negative] = [
            (&before.preload.positive, &after.preload.positive),
            (&before.preload.negative, &after.preload.negative),
        ]
        .map(|(before, after)| {
            let is_moved = after.entry(k, 0) == Interval::ZERO;
            if is_moved { before.entry(k, 0) } else { Interval::ZERO }
        });
        positive.hull(negative) * Interval::point(before.velocity_signs[k]) * answers(k)
    };
    (0..before.velocity_signs.len()).map(moved).fold(Interval::ZERO, |sum, jump| sum + jump)
}

/// The angular velocity of the first body of a hinge against the second (rad/s).
pub(crate) fn spin<T: Real>(mechanism: &Mechanism<T>, configuration: &Configuration<T>, joint: JointId) -> T {
    let of = |frame: Frame| configuration.angular_velocity(frame);
    match &mechanism.joints[joint.index()].kind {
        JointKind::Hinge([first, second]) => of(first.frame) - of(second.frame),
        JointKind::Slider(_) => T::zero(),
    }
}
