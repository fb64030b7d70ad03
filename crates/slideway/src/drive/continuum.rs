//! The efforts of infinitely many solutions.

use super::efforts::{efficiency, power};
use super::report::{EfficiencyKind, EffortRange};
use crate::report::{DrivenMotion, SolveReport};

/// The efforts over all continua of a report, with those without friction and the velocities at which they work; none
/// without a continuum, and where its efforts are not known.
pub(super) fn effort_range(
    report: &SolveReport,
    frictionless: &[f64],
    velocities: &[f64],
) -> Option<EffortRange> {
    let undetermined = report.undetermined.clone()?;
    let corners: Vec<&DrivenMotion> = report.continua.iter().flat_map(|one| &one.motion).collect();
    let growths: Vec<f64> = report
        .continua
        .iter()
        .flat_map(|one| &one.motion_along)
        .map(|motion| power(&motion.efforts, velocities))
        .collect();
    let powers = ends(corners.iter().map(|motion| power(&motion.efforts, velocities)))?;
    let is_bounded = |sense: f64| growths.iter().all(|growth| sense * growth <= 0.0);
    let bounded = [-1.0, 1.0].map(is_bounded);
    let of_corner = |motion: &&DrivenMotion| efficiency(&motion.efforts, frictionless, velocities);
    let shares = corners.iter().map(of_corner).map(|one| Some((one.is, one.value?)));
    let shares: Option<Vec<(EfficiencyKind, f64)>> = shares.collect();
    let pushes = shares.iter().flatten().all(|(kind, _)| *kind == EfficiencyKind::Driving);
    // Without bound the efforts of drives that push leave nothing of their power to the load.
    let without_bound = match bounded {
        [true, true] => Some(None),
        [true, false] if pushes => Some(Some(0.0)),
        _ => None,
    };
    let efficiency = shares.zip(without_bound).and_then(|(shares, without_bound)| {
        let is_one_kind = shares.windows(2).all(|pair| pair[0].0 == pair[1].0);
        let all = shares.iter().map(|(_, value)| *value).chain(without_bound);
        ends(all).filter(|_| is_one_kind)
    });
    Some(EffortRange {
        undetermined,
        power: [0, 1].map(|end| bounded[end].then_some(powers[end])),
        efficiency,
    })
}

/// The least and the greatest of some values; none of none.
fn ends(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.map(|value| [value, value]).reduce(|one, other| [one[0].min(other[0]), one[1].max(other[1])])
}
