//! The efforts of the drives at one value of what is varied.

use super::report::{Efficiency, EfficiencyKind};
use crate::fault::Faults;
use crate::kinetics::velocity_of_effort;
use crate::limits::Varied;
use crate::mechanism::{Drive, Mechanism};
use crate::modes::ContactState;
use crate::modes::existence::{EndCause, ExistenceOptions, ModeProblemLine, TooManyModes};
use crate::solve::Stages;

/// Powers below this share of what the single drives do are rounding.
const NO_POWER: f64 = 1e-12;
/// How near to an end growth is judged, as a fraction of the interval.
const NEAR: [f64; 2] = [1e-5, 1e-7];
/// Growth between these two places beyond which an unknown grows without bound; towards a change of sign it
/// then leads through infinity.
pub(super) const GROWTH: f64 = 30.0;

/// The most patterns whose locking is sought.
pub(super) const PATTERNS: u64 = 1 << 12;
/// For a mode problem alone.
const OPTIONS: ExistenceOptions =
    ExistenceOptions { range: [0.0, 1.0], greatest_normal_force: None, patterns: PATTERNS };

/// Everything that is known at one value.
pub(crate) struct Efforts {
    line: ModeProblemLine,
    drives: usize,
    /// The mechanism there.
    pub(crate) mechanism: Mechanism,
    /// Without friction (N or N m).
    pub(super) frictionless: Vec<f64>,
    /// The velocity at which each effort works (m/s or rad/s).
    pub(super) velocities: Vec<f64>,
}

impl Efforts {
    /// # Errors
    /// A fault if a number is beyond the range of floating point.
    pub(super) fn new(stages: &Stages) -> Result<Self, Faults> {
        let parts = stages.parts_with_efforts()?;
        Ok(Self {
            line: parts.line_to(&parts),
            drives: stages.mechanism.drives.len(),
            mechanism: stages.mechanism.clone(),
            frictionless: stages.influence.efforts(&stages.data().without_friction()),
            velocities: velocities(stages),
        })
    }

    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn at(varied: &Varied, value: f64) -> Result<Self, Faults> {
        varied.at(value, Self::new)
    }

    /// [`Efforts::at`], where contacts may stand still, whose friction no pattern tells; and whether some do.
    ///
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn at_any(varied: &Varied, value: f64) -> Result<(Self, bool), Faults> {
        varied.at_any(value, |stages| Ok((Self::new(stages)?, !stages.standing.is_empty())))
    }

    /// The efforts in the solution of a pattern; none where its determinant vanishes.
    pub(crate) fn of(&self, pattern: &[ContactState]) -> Option<Vec<f64>> {
        let unknowns = self.line.unknowns(pattern, 0.0)?;
        // The efforts stand at the end. Adding zero turns -0 into 0.
        Some(unknowns.iter().skip(unknowns.len() - self.drives).map(|effort| effort + 0.0).collect())
    }

    /// How many drives there are.
    pub(super) fn drives(&self) -> usize {
        self.drives
    }

    /// The patterns that have a solution, preload-gap states among them, as long as `goes_on`.
    ///
    /// # Errors
    /// More patterns than are tried.
    pub(crate) fn present(&self, goes_on: &dyn Fn() -> bool) -> Result<Vec<Vec<ContactState>>, TooManyModes> {
        self.line.present(0.0, &OPTIONS, goes_on)
    }

    /// True if the solution of a pattern is on its boundary within rounding.
    pub(crate) fn is_on_boundary(&self, pattern: &[ContactState]) -> bool {
        self.line.cause_at(pattern, 0.0, &OPTIONS) != EndCause::Range
    }

    /// The normal forces in the solution of a pattern; none where its determinant vanishes.
    pub(crate) fn normal_forces(&self, pattern: &[ContactState]) -> Option<Vec<f64>> {
        let forces = self.line.normal_force(pattern, 0.0)?;
        Some(self.mechanism.forces_at_faces(pattern, forces.as_slice().to_vec()))
    }

    /// The power of efforts, and their efficiency.
    pub(crate) fn power(&self, efforts: &[f64]) -> (f64, Efficiency) {
        (power(efforts, &self.velocities), efficiency(efforts, &self.frictionless, &self.velocities))
    }
}

/// The velocity at which a unit effort of each drive works.
pub(super) fn velocities(stages: &Stages) -> Vec<f64> {
    let Stages { mechanism, configuration, .. } = stages;
    let of = |drive: &Drive| velocity_of_effort(mechanism, configuration, &drive.effort);
    mechanism.drives.iter().map(of).collect()
}

/// P = sum_i u_i w_i
pub(super) fn power(efforts: &[f64], velocities: &[f64]) -> f64 {
    efforts.iter().zip(velocities).map(|(effort, velocity)| effort * velocity).sum::<f64>() + 0.0
}

/// The share of power that is not lost to friction.
pub(super) fn efficiency(efforts: &[f64], frictionless: &[f64], velocities: &[f64]) -> Efficiency {
    let scale = |efforts: &[f64]| -> f64 {
        efforts.iter().zip(velocities).map(|(effort, velocity)| (effort * velocity).abs()).sum()
    };
    let negligible = NO_POWER * scale(efforts).max(scale(frictionless));
    let of = |efforts: &[f64]| {
        let power = power(efforts, velocities);
        if power.abs() <= negligible { 0.0 } else { power }
    };
    let (with, without) = (of(efforts), of(frictionless));
    let (is, value) = if without == 0.0 {
        (EfficiencyKind::NoPower, None)
    } else if without > 0.0 && with > 0.0 {
        (EfficiencyKind::Driving, Some(without / with))
    } else if without < 0.0 && with < 0.0 {
        (EfficiencyKind::Braking, Some(with / without))
    } else if without < 0.0 {
        (EfficiencyKind::HeldByFriction, None)
    } else {
        (EfficiencyKind::Undefined, None)
    };
    Efficiency { is, value }
}

/// The efforts and contacts that grow without bound in a mode towards an end.
pub(super) struct Growing {
    /// 1 or -1 for each drive whose effort does, with this sign, else 0.
    pub(super) efforts: Vec<i8>,
    /// The contacts whose normal forces do.
    pub(super) contacts: Vec<usize>,
}

/// All that grows without bound in a mode towards `end`, whose other end is `other`; none if no effort does.
pub(super) fn growing(
    pattern: &[ContactState],
    [end, other]: [f64; 2],
    at: impl Fn(f64) -> Option<Efforts>,
) -> Option<Growing> {
    let other = if other.is_finite() { other } else { 2.0 * end };
    let [far, close] = NEAR.map(|fraction| at(end + fraction * (other - end)));
    let (far, close) = (far?, close?);
    let efforts = grows(&far.of(pattern)?, &close.of(pattern)?);
    let normal = grows(&far.normal_forces(pattern)?, &close.normal_forces(pattern)?);
    let contacts = (0..normal.len()).filter(|&contact| normal[contact] != 0).collect();
    efforts.iter().any(|&sign| sign != 0).then_some(Growing { efforts, contacts })
}

/// The sign of each value that has grown beyond all bounds between two places, else 0.
pub(super) fn grows(far: &[f64], close: &[f64]) -> Vec<i8> {
    let one = |(far, close): (&f64, &f64)| match close.abs() > GROWTH * far.abs() {
        true if *close > 0.0 => 1,
        true => -1,
        false => 0,
    };
    far.iter().zip(close).map(one).collect()
}
