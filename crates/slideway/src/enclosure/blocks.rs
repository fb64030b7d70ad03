//! The numbers of the block mode problem of a mechanism with friction in hinges, rounded or within intervals.

use super::coefficients::Coefficients;
use super::{EnclosedOutputs, NotEnclosed, UncertainParameters, with_coefficients};
use crate::configuration::Configuration;
use crate::ids::{ContactId, Frame, JointId};
use crate::interval::{Interval, Real, Sign};
use crate::kinetics::Reaction;
use crate::mechanism::{FrictionCircle, JointKind, Mechanism};
use crate::model::Model;
use crate::modes::blocks::BlockProblem;
use crate::modes::certificate::{IntervalInfluence, IntervalMatrix};
use crate::modes::{BySide, OpenContacts, SharedLoad, Side};
use crate::progress::Work;
use crate::sharing::shared_load;
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
    /// Which contacts may be open, and together.
    pub(crate) open: OpenContacts,
    /// The coefficients of its numbers.
    coefficients: BlockCoefficients<Interval>,
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
        bounded_problem(&self.coefficients.rougher(&factors)).ok()
    }
}

/// What the block mode problem `x = b + d^sigma + H^sigma w` is made of: rows are the normal forces, then both
/// components of the force of each hinge that turns.
#[derive(Debug, Clone)]
pub(crate) struct BlockCoefficients<T: Real> {
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
    /// How redundant guides share their load; its self-stresses have all rows.
    pub(crate) shared: Option<SharedLoad<T>>,
}

/// The numbers of a block mode problem.
#[derive(Debug, Clone)]
pub(crate) struct BlockNumbers<T: Real> {
    /// `H^sigma`, a column for each contact and hinge.
    pub(crate) response: BySide<DMatrix<T>>,
    /// `d^sigma`, a column for each contact.
    pub(crate) jumps: BySide<DMatrix<T>>,
    /// `b`.
    pub(crate) load: DVector<T>,
}

impl<T: Real> BlockCoefficients<T> {
    /// The numbers of the problem.
    pub(crate) fn numbers(&self) -> BlockNumbers<T> {
        self.with_friction(&|_, friction| friction)
    }

    /// The numbers with the friction of each contact, then of each hinge, multiplied by its factor.
    pub(crate) fn rougher(&self, factors: &[T]) -> BlockNumbers<T> {
        self.with_friction(&|block, friction| friction * factors[block])
    }

    fn with_friction(&self, rougher: &dyn Fn(usize, T) -> T) -> BlockNumbers<T> {
        let by_side = |part: &dyn Fn(Side) -> DMatrix<T>| BySide {
            positive: part(Side::Positive),
            negative: part(Side::Negative),
        };
        let load = self.frictionless.iter().enumerate();
        let load = load.map(|(row, &given)| self.shared.as_ref().map_or(given, |all| all.load(row, given)));
        BlockNumbers {
            response: by_side(&|side| self.response(side, rougher)),
            jumps: by_side(&|side| self.jumps(side)),
            load: DVector::from_iterator(self.frictionless.len(), load),
        }
    }

    /// `H^sigma`: columns `mu_k s_k eta_k^sigma` of the contacts, `-r_j sgn(omega_j)` times the answer to a unit couple of
    /// the hinges. Those of contacts that share a load hold what their stiffness adds, too.
    fn response(&self, side: Side, rougher: &dyn Fn(usize, T) -> T) -> DMatrix<T> {
        let (eta, mu) = (self.eta.get(side), self.mu.get(side));
        let contacts = mu.len();
        DMatrix::from_fn(eta.nrows(), contacts + self.leverage.len(), |row, block| {
            let Some(hinge) = block.checked_sub(contacts) else {
                let sense = T::exactly(self.velocity_signs[block]);
                let friction = rougher(block, eta[(row, block)] * mu[block] * sense);
                return match &self.shared {
                    Some(shared) => shared.response(side, row, block, friction),
                    None => friction,
                };
            };
            // Compatibility of deflections knows no couples.
            let is_cut = self.shared.as_ref().is_some_and(|shared| shared.cut.contains(&row));
            if is_cut { T::zero() } else { rougher(block, self.couples[(row, hinge)] * self.leverage[hinge]) }
        })
    }

    /// `d_k^sigma = F_k0 s_k eta_k^sigma`, a column for each contact; of compatibility the play of one that shares a load.
    fn jumps(&self, side: Side) -> DMatrix<T> {
        let (eta, preload) = (self.eta_preload.get(side), self.preload.get(side));
        DMatrix::from_fn(eta.nrows(), preload.len(), |row, k| {
            let friction = eta[(row, k)] * preload[k] * T::exactly(self.velocity_signs[k]);
            self.shared.as_ref().map_or(friction, |shared| shared.jump(side, row, k, friction))
        })
    }
}

/// The problem of numbers within bounds.
fn bounded_problem(numbers: &BlockNumbers<Interval>) -> Result<BlockProblem, NotEnclosed> {
    let bounded =
        |matrix: &DMatrix<Interval>| IntervalMatrix::from_intervals(matrix).ok_or(NotEnclosed::Equations);
    let both = |sides: &BySide<DMatrix<Interval>>| {
        Ok::<_, NotEnclosed>(BySide {
            positive: bounded(&sides.positive)?,
            negative: bounded(&sides.negative)?,
        })
    };
    let load = DMatrix::from_column_slice(numbers.load.len(), 1, numbers.load.as_slice());
    BlockProblem::within_bounds(both(&numbers.response)?, both(&numbers.jumps)?, bounded(&load)?)
        .map_err(|_| NotEnclosed::Equations)
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
        let circle = |hinge: &TurningHinge| coefficients.mechanism.friction_circles[hinge.circle];
        let circles = hinges.iter().map(circle).collect();
        Ok(EnclosedBlockProblem {
            problem: bounded_problem(&numbers.numbers())?,
            outputs: coefficients.outputs(influence, &unknowns, &rubbing),
            open: coefficients.mechanism.excess.open.clone(),
            coefficients: numbers,
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
        let stresses = self.stresses_with(unknowns, &rows);
        let shared = shared_load(self.mechanism, stresses.clone()).map_err(NotEnclosed::Values)?;
        let [eta, eta_preload] = self.answers_of_hinges(unknowns, &rows, &stresses);
        let extended = |of_contacts: &IntervalMatrix, of_hinges: &DMatrix<Interval>| {
            DMatrix::from_fn(contacts + rows.len(), contacts, |row, k| match row.checked_sub(contacts) {
                None => of_contacts.entry(row, k),
                Some(_) => of_hinges[(row, k)],
            })
        };
        let both =
            |of_contacts: &BySide<IntervalMatrix>, [positive, negative]: [DMatrix<Interval>; 2]| BySide {
                positive: extended(&of_contacts.positive, &positive),
                negative: extended(&of_contacts.negative, &negative),
            };
        let column = |vector: &IntervalMatrix| DVector::from_fn(contacts, |k, _| vector.entry(k, 0));
        let normals =
            (0..contacts).filter_map(|k| self.equations.layout.reaction(Reaction::Normal(ContactId(k))));
        let all: Vec<usize> = normals.chain(rows.iter().copied()).collect();
        let frictionless = DVector::from_fn(all.len(), |row, _| match row.checked_sub(contacts) {
            None => without.frictionless.entry(row, 0),
            Some(hinge) => {
                let answers = |k: usize| eta_preload[0][(row, k)].hull(eta_preload[1][(row, k)]);
                unknowns[(rows[hinge], 0)] + shared_jumps([influence, &without], &answers)
            }
        });
        Ok(BlockCoefficients {
            eta: both(&influence.eta, eta),
            eta_preload: both(&influence.eta_preload, eta_preload),
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
            shared,
        })
    }

    /// The self-stresses in the rows of the contacts, then in those of hinges.
    fn stresses_with(&self, unknowns: &DMatrix<Interval>, rows: &[usize]) -> DMatrix<Interval> {
        let of_contacts = self.self_stresses(unknowns);
        let (contacts, stresses) = of_contacts.shape();
        DMatrix::from_fn(contacts + rows.len(), stresses, |row, stress| match row.checked_sub(contacts) {
            None => of_contacts[(row, stress)],
            Some(hinge) => unknowns[(rows[hinge], 1 + contacts + stress)],
        })
    }

    /// The contributions of a unit friction of each contact to these rows of hinge forces, below those of the contacts, at
    /// either face; and the same of its preload.
    ///
    /// A couple between both faces of a contact changes them only if a self-stress hands it on.
    fn answers_of_hinges(
        &self,
        unknowns: &DMatrix<Interval>,
        rows: &[usize],
        stresses: &DMatrix<Interval>,
    ) -> [[DMatrix<Interval>; 2]; 2] {
        let contacts = self.mechanism.contacts.len();
        let positive = DMatrix::from_fn(stresses.nrows(), contacts, |row, k| {
            row.checked_sub(contacts).map_or(Interval::ZERO, |hinge| unknowns[(rows[hinge], 1 + k)])
        });
        let eta = [positive.clone(), self.negative_versions(positive, stresses)];
        let preload = self.preload_columns(&eta);
        [eta, preload]
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
