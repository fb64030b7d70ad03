//! Where over a range an effort is greatest.

use super::efforts::Efforts;
use super::report::{BlowUp, CourseRow, PeakEffort};
use crate::limits::ModesFound;
use crate::modes::ContactState;
use crate::modes::existence::ModeInterval;
use crate::report::Verdict;
use crate::scan::golden_section;

/// Rows nearer to a blow-up than this share of the range give way to it.
pub(super) const SAME_ROW: f64 = 1e-9;

/// Steps of the golden section search: the last bracket is within rounding of the first.
const STEPS: usize = 75;

/// The greatest magnitude of each drive's effort in any mode: of the evenly spaced `places` the best, then refined between its
/// neighbours. Nothing where an effort grows without bound, or where there is not one state everywhere that a mechanism settles
/// on: the greatest of several would be that of none in particular.
pub(super) fn peaks(
    places: &[(f64, Option<Efforts>)],
    (found, rows, blow_ups): (&ModesFound, &[CourseRow], &[BlowUp]),
    at: impl Fn(f64) -> Option<Efforts>,
) -> Vec<PeakEffort> {
    let settles = |row: &CourseRow| {
        row.range.is_none() && !matches!(row.attainability, Some(Verdict::Unattainable | Verdict::Flutter))
    };
    let ([(start, _), ..], [.., (stop, _)]) = (places, places) else { return Vec::new() };
    let modes = &found.existence.modes;
    // Where one mode ends and the next begins, both have the same state.
    let overlap = |one: &ModeInterval, other: &ModeInterval| {
        one.to.at.min(other.to.at) - one.from.at.max(other.from.at) > SAME_ROW * (stop - start)
    };
    let are_apart = (1..modes.len()).all(|next| modes[..next].iter().all(|one| !overlap(one, &modes[next])));
    let is_one = rows.windows(2).all(|pair| pair[0].at < pair[1].at) && rows.iter().all(settles);
    let drives = places.iter().find_map(|(_, efforts)| efforts.as_ref().map(Efforts::drives));
    if !blow_ups.is_empty() || !is_one || !are_apart {
        return Vec::new();
    }
    let effort = |efforts: &Efforts, pattern: &[ContactState], drive: usize| {
        efforts.of(pattern).map_or(f64::NEG_INFINITY, |all| all[drive].abs())
    };
    let peak = |drive: usize| {
        let of_mode = modes.iter().filter_map(|mode| {
            let [from, to] = [mode.from.at.max(*start), mode.to.at.min(*stop)];
            let inside = places.iter().filter(|(value, _)| from <= *value && *value <= to);
            let known = inside.filter_map(|(value, efforts)| {
                Some((*value, effort(efforts.as_ref()?, &mode.pattern, drive)))
            });
            let known: Vec<(f64, f64)> = known.collect();
            let best = (0..known.len()).max_by(|one, other| known[*one].1.total_cmp(&known[*other].1))?;
            let ends = [
                best.checked_sub(1).map_or(from, |before| known[before].0),
                known.get(best + 1).map_or(to, |(value, _)| *value),
            ];
            let value =
                |value: f64| at(value).map_or(f64::NEG_INFINITY, |all| effort(&all, &mode.pattern, drive));
            let place = greatest(ends, known[best].0, value);
            let effort = at(place)?.of(&mode.pattern)?[drive];
            Some(PeakEffort { drive, at: place, effort })
        });
        of_mode.max_by(|one, other| one.effort.abs().total_cmp(&other.effort.abs()))
    };
    (0..drives.unwrap_or(0)).filter_map(peak).collect()
}

/// Where between these ends a function with one hump is greatest: by golden section, or `known` if nothing exceeds the value there.
fn greatest([mut low, mut high]: [f64; 2], known: f64, value: impl Fn(f64) -> f64) -> f64 {
    let found = |at: f64| (at, value(at));
    let mut pair = golden_section([low, high]).map(found);
    for _ in 0..STEPS {
        if pair[0].1 > pair[1].1 {
            high = pair[1].0;
            pair = [found(golden_section([low, high])[0]), pair[0]];
        } else {
            low = pair[0].0;
            pair = [pair[1], found(golden_section([low, high])[1])];
        }
    }
    pair.into_iter().fold(found(known), |best, one| if one.1 > best.1 { one } else { best }).0
}

#[cfg(test)]
mod tests {
    use super::greatest;

    #[test]
    fn humps_and_ends_are_found() {
        let hump = greatest([0.0, 2.0], 1.0, |at| 3.0 - (at - 1.3) * (at - 1.3));
        assert!((hump - 1.3).abs() < 1e-7, "{hump}");
        assert_eq!(greatest([0.0, 2.0], 2.0, |at| at), 2.0);
        assert_eq!(greatest([0.0, 2.0], 0.0, |at| -at), 0.0);
    }
}
