//! Axes in numbers: round values for ticks, ranges that fit curves, and from values to places.

use super::figure::{Branch, Curve, End, Panel, Stroke};

/// Share of a curve's extent along x that is not fitted before an end at which it grows without bound, and
/// the same at each end if both grow: of what a mechanism settles on, which is read close to where it locks.
const LEFT_OUT: [f64; 2] = [0.15, 0.12];
/// Shares like those of [`LEFT_OUT`] for all other curves, which would dwarf those.
const LEFT_OUT_OF_THRESHOLDS: [f64; 2] = [0.4, 0.3];
/// The edge of an axis beyond which curves go on is a round number: that of so many ticks.
const TICKS: usize = 6;
/// Space above and below the curves, as a share of their range.
const MARGIN: f64 = 0.06;
/// Zero is shown where it is no farther from the curves than this share of their range.
const NEAR_ZERO: f64 = 1.0;

/// From values to places in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    /// Values at the beginning and the end.
    pub(super) values: [f64; 2],
    /// Their places.
    pub(super) places: [f64; 2],
    /// Whether equal distances are equal ratios.
    pub(super) logarithmic: bool,
}

impl Scale {
    pub(super) fn place(&self, value: f64) -> f64 {
        let [value, from, to] = [value, self.values[0], self.values[1]]
            .map(|value| if self.logarithmic { value.ln() } else { value });
        let share = (value - from) / (to - from);
        self.places[0] + share * (self.places[1] - self.places[0])
    }

    /// The value at a place.
    pub(super) fn value(&self, place: f64) -> f64 {
        let share = (place - self.places[0]) / (self.places[1] - self.places[0]);
        let [from, to] = self.values;
        if self.logarithmic { from * (to / from).powf(share) } else { from + share * (to - from) }
    }
}

/// The distance between ticks at 1, 2 or 5 times a power of ten that gives about `wanted` of them.
pub(super) fn tick_step([from, to]: [f64; 2], wanted: usize) -> f64 {
    let rough = (to - from).abs() / wanted.max(1) as f64;
    let power = 10_f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= rough * 0.999_999);
    factor.unwrap_or(10.0) * power
}

/// Ticks at 1, 2 and 5 times powers of ten, at 1 and 3 times them, or at powers of ten: as many as there is
/// room for, at even distances. None where the positive range is too narrow for three of them.
pub(super) fn logarithmic_ticks([from, to]: [f64; 2], wanted: usize) -> Option<Vec<f64>> {
    let slack = 1e-9;
    #[expect(clippy::cast_possible_truncation, reason = "exponents of floating-point numbers")]
    let [first, last] = [from.log10().floor(), to.log10().ceil()].map(|exponent| exponent as i32);
    let inside = |tick: &f64| from * (1.0 - slack) <= *tick && *tick <= to * (1.0 + slack);
    let at = |factors: &'static [f64], every: u32| -> Vec<f64> {
        let powers = (first..=last).filter(|exponent| exponent.unsigned_abs().is_multiple_of(every));
        let ticks =
            powers.flat_map(|exponent| factors.iter().map(move |factor| factor * 10_f64.powi(exponent)));
        ticks.filter(inside).collect()
    };
    let fine: [&'static [f64]; 2] = [&[1.0, 2.0, 5.0], &[1.0, 3.0]];
    let coarse = (1..=100).map(|every| at(&[1.0], every));
    let ticks =
        fine.into_iter().map(|factors| at(factors, 1)).chain(coarse).find(|ticks| ticks.len() <= wanted)?;
    (ticks.len() >= 3).then_some(ticks)
}

/// Returns the distance between ticks in degrees, as [`tick_step`]; parts of a turn where the range is wide.
pub(super) fn angle_step(range: [f64; 2], wanted: usize) -> f64 {
    let rough = (range[1] - range[0]).abs() / wanted.max(1) as f64;
    let parts = [10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0];
    let step = parts.into_iter().find(|&part| part >= rough * 0.8);
    step.filter(|_| rough > 5.0).unwrap_or_else(|| tick_step(range, wanted))
}

/// Multiples of a step within a range.
pub(super) fn ticks([from, to]: [f64; 2], step: f64) -> Vec<f64> {
    let slack = 1e-9;
    let (first, last) = ((from / step - slack).ceil(), (to / step + slack).floor());
    if !(first.is_finite() && last.is_finite() && last - first < 1000.0) {
        return Vec::new();
    }
    // Of a range far from zero beside its width, neighbouring multiples may be one number; adding zero turns -0 into 0.
    let indices = (0..1000).map(|number| first + f64::from(number)).take_while(|index| *index <= last);
    let mut ticks: Vec<f64> = indices.map(|index| index * step + 0.0).collect();
    ticks.dedup();
    ticks
}

/// A tick's value with as many decimals as its step needs; powers of ten where numbers would be long.
pub(super) fn tick_text(value: f64, step: f64, greatest: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if greatest >= 1e6 || step < 1e-5 {
        let text = format!("{value:.6e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
        return format!("{}e{exponent}", mantissa.replace('-', "\u{2212}"));
    }
    let decimals = (0..12).find(|&decimals| {
        let scaled = step * 10_f64.powi(decimals);
        (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0) && scaled.round() > 0.0
    });
    let decimals = usize::try_from(decimals.unwrap_or(0)).unwrap_or(0);
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// The range of a panel's vertical axis that its curves ask for: all of them, but for what lies near values
/// at which they grow without bound; with zero if it is not far away.
pub(super) fn fitting_range(panel: &Panel, branches: &[Branch]) -> [f64; 2] {
    let bars = || panel.bars.iter().flat_map(|bar| bar.ends);
    let all = panel.curves.iter().flat_map(|curve| curve.points.iter().map(|point| point[1]));
    let shown = panel.curves.iter().flat_map(|curve| {
        let stroke = branches.get(curve.branch).map_or(Stroke::Solid, |branch| branch.stroke);
        visible(curve, if stroke == Stroke::Solid { LEFT_OUT } else { LEFT_OUT_OF_THRESHOLDS })
    });
    match (extent(shown.chain(bars())), extent(all.chain(bars()))) {
        (Some(shown), Some(all)) => range_that_shows(shown, all),
        _ => [0.0, 1.0],
    }
}

/// The least and the greatest of the finite values.
pub(crate) fn extent(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.filter(|value| value.is_finite()).fold(None, |range: Option<[f64; 2]>, value| {
        Some(range.map_or([value; 2], |[least, greatest]| [least.min(value), greatest.max(value)]))
    })
}

/// A range with some room around the values that are to be seen, and with zero if it is not far away. Edges
/// beyond which there are other values are round, so that they can be named.
pub(crate) fn range_that_shows([least, greatest]: [f64; 2], all: [f64; 2]) -> [f64; 2] {
    let size = greatest - least;
    let (mut least, mut greatest) = (least, greatest);
    if least > 0.0 && least <= NEAR_ZERO * size {
        least = 0.0;
    }
    if greatest < 0.0 && -greatest <= NEAR_ZERO * size {
        greatest = 0.0;
    }
    let size = greatest - least;
    // A constant: room of its own size around it.
    let margin = if size > 1e-9 * least.abs().max(greatest.abs()) {
        MARGIN * size
    } else if greatest == 0.0 {
        1.0
    } else {
        0.5 * greatest.abs()
    };
    let step = tick_step([least, greatest + 2.0 * margin], TICKS);
    [
        if all[0] < least - margin { (least / step).floor() * step } else { least - margin },
        if all[1] > greatest + margin { (greatest / step).ceil() * step } else { greatest + margin },
    ]
}

/// The values of a curve that are to be seen; of its extent along x these shares are left out before one end
/// at which it grows without bound, and before each of two.
fn visible(curve: &Curve, [once, twice]: [f64; 2]) -> impl Iterator<Item = f64> + '_ {
    let diverges = curve.ends.map(|end| end == End::Diverges);
    let share = if diverges == [true; 2] { twice } else { once };
    let along = |point: Option<&[f64; 2]>| point.map_or(0.0, |point| point[0]);
    let (from, to) = (along(curve.points.first()), along(curve.points.last()));
    let first = if diverges[0] { from + share * (to - from) } else { f64::NEG_INFINITY };
    let last = if diverges[1] { to - share * (to - from) } else { f64::INFINITY };
    curve.points.iter().filter(move |[x, _]| first <= *x && *x <= last).map(|point| point[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_at_the_place_of_a_value_is_that_value() {
        for logarithmic in [false, true] {
            let scale = Scale { values: [0.1, 50.0], places: [20.0, 300.0], logarithmic };
            for value in [0.1, 0.7, 12.0, 50.0] {
                let found = scale.value(scale.place(value));
                assert!((found - value).abs() < 1e-12 * value.max(1.0), "{found} for {value}");
            }
        }
    }

    #[test]
    fn ticks_are_round() {
        let table =
            [([0.0, 0.8], 8, 0.1), ([0.0, 1.0], 5, 0.2), ([-37.0, 41.0], 6, 20.0), ([0.0, 3e-3], 6, 5e-4)];
        for (range, wanted, step) in table {
            let found = tick_step(range, wanted);
            assert!((found - step).abs() < 1e-9 * step, "{range:?}: {found}");
        }
        assert_eq!(ticks([1e16, 1e16 + 4.0], 0.5), [1e16, 1e16 + 2.0, 1e16 + 4.0]);
        assert_eq!(angle_step([-180.0, 180.0], 5), 60.0);
        assert_eq!(angle_step([-180.0, 180.0], 8), 45.0);
        assert_eq!(angle_step([60.0, 88.0], 8), 5.0);
        let texts: Vec<String> =
            ticks([-0.35, 0.4], 0.2).iter().map(|&tick| tick_text(tick, 0.2, 0.4)).collect();
        assert_eq!(texts, ["\u{2212}0.2", "0", "0.2", "0.4"]);
        assert_eq!(tick_text(2.5e7, 5e6, 3e7), "2.5e7");
        assert!(ticks([0.0, f64::NAN], 0.1).is_empty());
    }

    #[test]
    fn ticks_of_logarithmic_axes_are_round_and_not_too_many() {
        let table: [([f64; 2], usize, &[f64]); 5] = [
            ([0.001, 1.0], 10, &[0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0]),
            ([0.001, 1.0], 9, &[0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0]),
            ([0.001, 1.0], 4, &[0.001, 0.01, 0.1, 1.0]),
            ([1e-6, 1e6], 7, &[1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6]),
            ([3.0, 40.0], 8, &[5.0, 10.0, 20.0]),
        ];
        for (range, wanted, ticks) in table {
            let found = logarithmic_ticks(range, wanted).unwrap_or_default();
            assert_eq!(found.len(), ticks.len(), "{range:?}: {found:?}");
            assert!(
                found.iter().zip(ticks).all(|(a, b)| (a / b - 1.0).abs() < 1e-12),
                "{range:?}: {found:?}"
            );
        }
        assert_eq!(logarithmic_ticks([2.1, 4.9], 8), None);
    }

    #[test]
    fn equal_ratios_are_equal_distances_on_a_logarithmic_axis() {
        let scale = Scale { values: [0.01, 100.0], places: [0.0, 400.0], logarithmic: true };
        for (value, place) in [(0.01, 0.0), (0.1, 100.0), (1.0, 200.0), (10.0, 300.0), (100.0, 400.0)] {
            assert!((scale.place(value) - place).abs() < 1e-9, "{value}");
        }
    }

    #[test]
    fn what_grows_without_bound_does_not_squash_the_rest() {
        // y = 1/(1 - x): beyond 85 % of the way it is not fitted, where it is 6.67; of a threshold beyond 60 %,
        // where it is 2.5. The next multiples of 2 and 0.5 end the axis.
        let points = (0..1000).map(|step| f64::from(step) / 1000.0).map(|x| [x, 1.0 / (1.0 - x)]).collect();
        let curve = Curve { branch: 0, quantity: 0, points, ends: [End::Plain, End::Diverges] };
        let panel = Panel { curves: vec![curve], ..Panel::default() };
        let of = |stroke| fitting_range(&panel, &[Branch { name: String::new(), colour: 0, stroke }]);
        assert_eq!([of(Stroke::Solid)[1], of(Stroke::Dashed)[1]], [8.0, 2.5]);
        assert!(of(Stroke::Solid)[0] < 0.0, "zero is near");
        assert_eq!(fitting_range(&Panel::default(), &[]), [0.0, 1.0]);
        // All of a curve that ends is shown, with room around it.
        let bounded = Curve { ends: [End::Plain; 2], ..panel.curves[0].clone() };
        let range = fitting_range(&Panel { curves: vec![bounded], ..Panel::default() }, &[]);
        assert!(range[1] > 1000.0, "{range:?}");
    }
}
