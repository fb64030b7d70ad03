//! The classes of efforts: as many points in each, between round numbers.

use super::class::ClassMeaning;
use crate::model::{Effort, Model};
use crate::units::Unit;

/// The most classes.
const CLASSES: usize = 7;
/// Round numbers: the series R 10 of ISO 3, rounded as R"10.
const ROUND: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
/// An effort this close to a bound, as a part of it, is on it: one that is the same everywhere has one class.
const ON_BOUND: f64 = 1e-9;
/// An effort below this part of the greatest one is rounding.
const ROUNDING: f64 = 1e-12;

/// Returns the unit in which efforts of the first drive are shown; of a model without drives that of a force.
pub(super) fn unit(model: &Model) -> Unit {
    let is_torque = model.drives.first().is_some_and(|drive| !matches!(drive.effort, Effort::Force { .. }));
    model.units.of(if is_torque { "N m" } else { "N" })
}

/// Bounds of the classes of efforts.
#[derive(Debug, Clone, Default)]
pub(super) struct Bounds {
    /// In ascending order.
    list: Vec<f64>,
    /// Efforts up to this magnitude are none.
    nothing: f64,
}

/// Returns bounds between which equally many of these efforts lie, rounded in this unit; none if there are no efforts but 0.
pub(super) fn bounds(mut efforts: Vec<f64>, unit: &Unit) -> Bounds {
    let greatest = efforts.iter().fold(0.0_f64, |greatest, effort| greatest.max(effort.abs()));
    if greatest == 0.0 {
        return Bounds::default();
    }
    let nothing = ROUNDING * greatest;
    for effort in efforts.iter_mut().filter(|effort| effort.abs() <= nothing) {
        *effort = 0.0;
    }
    efforts.sort_by(f64::total_cmp);
    let quantile = |part: usize| efforts.get(efforts.len() * part / CLASSES).copied();
    let rounded = |effort: f64| round(effort / unit.scale()) * unit.scale();
    let mut list: Vec<f64> = (1..CLASSES).filter_map(quantile).map(rounded).collect();
    list.dedup();
    Bounds { list, nothing }
}

/// Returns the round number that is nearest in ratio; 0 of 0.
fn round(value: f64) -> f64 {
    let size = value.abs();
    if size < f64::MIN_POSITIVE {
        return 0.0;
    }
    let decade = size.log10().floor();
    // Whole powers of ten are exact up to 1e22, so that round numbers stay what they are in print.
    let scaled =
        |step: f64| if decade < 0.0 { step / 10_f64.powf(-decade) } else { step * 10_f64.powf(decade) };
    let distance = |step: &f64| (size / scaled(*step)).ln().abs();
    let nearest = ROUND.into_iter().min_by(|one, other| distance(one).total_cmp(&distance(other)));
    scaled(nearest.unwrap_or(1.0)).copysign(value)
}

/// Returns the class of an effort.
pub(super) fn class(effort: f64, Bounds { list: bounds, nothing }: &Bounds) -> ClassMeaning {
    let effort = if effort.abs() <= *nothing { 0.0 } else { effort };
    let place = bounds.partition_point(|bound| *bound <= effort + ON_BOUND * bound.abs());
    let from = place.checked_sub(1).map(|below| bounds[below]);
    ClassMeaning::Effort { from, to: bounds.get(place).copied() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_round_and_leave_equally_many_on_each_side() {
        let efforts = (1..=700).map(|effort| 0.1 * f64::from(effort)).collect();
        assert_eq!(bounds(efforts, &Unit::si_unit("N")).list, [10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        let mixed = (-350..350).map(|effort| 0.1 * f64::from(effort)).collect();
        assert_eq!(bounds(mixed, &Unit::si_unit("N")).list, [-25.0, -15.0, -5.0, 5.0, 15.0, 25.0]);
    }

    #[test]
    fn what_is_the_same_everywhere_has_one_class() {
        let bounds = bounds(vec![20.0; 9], &Unit::si_unit("N"));
        assert_eq!(bounds.list, [20.0]);
        let above = ClassMeaning::Effort { from: Some(20.0), to: None };
        for effort in [20.0_f64.next_down(), 20.0, 20.0_f64.next_up()] {
            assert_eq!(class(effort, &bounds), above);
        }
        assert_eq!(class(19.0, &bounds), ClassMeaning::Effort { from: None, to: Some(20.0) });
    }

    #[test]
    fn numbers_are_rounded_by_their_ratio() {
        for (value, expected) in [(0.0, 0.0), (0.0317, 0.03), (-13.3, -12.0), (9.4, 10.0)] {
            assert_eq!(round(value), expected, "{value}");
        }
    }
}
