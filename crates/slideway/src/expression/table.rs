//! Functions that a table of values gives.

use super::dimension::Inferred;
use crate::interval::{Interval, Real};
use std::sync::Arc;

/// Value of a table outside its arguments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beyond {
    /// The first value before them, the last after them.
    #[default]
    Hold,
    /// The table again: it is a period.
    Repeat,
}

/// An argument or a value of a table: the nearest number to what was written, and where that lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The number.
    pub value: f64,
    /// Where it lies exactly.
    pub enclosure: Interval,
}

/// A function of one argument, linear between the rows of a table.
///
/// Where two rows have the same argument the value jumps; there it is that of the later row.
///
/// ```
/// use slideway::expression::{Beyond, Entry, Inferred, Names, Table, Values, parse};
/// use slideway::interval::Interval;
///
/// let entry = |value| Entry { value, enclosure: Interval::point(value) };
/// let rows = vec![[entry(0.0), entry(0.0)], [entry(1.0), entry(10.0)], [entry(3.0), entry(0.0)]];
/// let push = Table::new("push", rows, [Inferred::Number; 2], Beyond::Hold);
/// let mut names = Names::new();
/// names.table(push);
/// let expression = parse("2*push(t)", &names).unwrap();
/// let values = |time| Values { time, ..Values::of_parameters(&[]) };
/// assert_eq!(expression.evaluate(&values(0.5)), Ok(10.0));
/// assert_eq!(expression.evaluate(&values(2.0)), Ok(10.0));
/// assert_eq!(expression.evaluate(&values(9.0)), Ok(0.0));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub(super) name: Arc<str>,
    rows: Vec<[Entry; 2]>,
    pub(super) argument: Inferred,
    pub(super) value: Inferred,
    beyond: Beyond,
}

impl Table {
    /// The table with these rows (argument, value), and what is known of the dimensions of the two columns.
    ///
    /// Arguments must not fall from row to row. One without rows is zero everywhere.
    pub fn new(
        name: &str,
        rows: Vec<[Entry; 2]>,
        [argument, value]: [Inferred; 2],
        beyond: Beyond,
    ) -> Arc<Self> {
        Arc::new(Self { name: Arc::from(name), rows, argument, value, beyond })
    }

    /// The places where its slope or value jumps, in the first period.
    pub fn arguments(&self) -> impl Iterator<Item = f64> + '_ {
        self.rows.iter().map(|[argument, _]| argument.value)
    }

    pub(super) fn at<T: Real>(&self, argument: T) -> T {
        argument.image(|number| self.of_number(number), |interval| self.of_interval(interval))
    }

    fn of_number(&self, mut argument: f64) -> f64 {
        let (Some([first, first_value]), Some([last, last_value])) = (self.rows.first(), self.rows.last())
        else {
            return 0.0;
        };
        if self.beyond == Beyond::Repeat && last.value > first.value {
            argument = first.value + (argument - first.value).rem_euclid(last.value - first.value);
        }
        let after = self.rows.partition_point(|[place, _]| place.value <= argument);
        if argument.is_nan() {
            return argument;
        }
        match after {
            0 => first_value.value,
            _ if after == self.rows.len() => last_value.value,
            _ => {
                let ([x0, y0], [x1, y1]) = (self.rows[after - 1], self.rows[after]);
                y0.value + (argument - x0.value) / (x1.value - x0.value) * (y1.value - y0.value)
            }
        }
    }

    /// Whether two of its rows have the same argument, or its value jumps from period to period.
    pub(super) fn jumps(&self) -> bool {
        let same = self.rows.windows(2).any(|rows| rows[0][0].value >= rows[1][0].value);
        let ends = self.rows.first().zip(self.rows.last());
        same || self.period().is_some()
            && ends.is_some_and(|([_, first], [_, last])| first.value != last.value)
    }

    /// The length of a period, if it is repeated.
    fn period(&self) -> Option<f64> {
        let length = self.rows.last()?[0].value - self.rows.first()?[0].value;
        (self.beyond == Beyond::Repeat && length > 0.0).then_some(length)
    }

    /// How many rows there are before an argument, counted through all periods; of rows with the same
    /// argument all.
    #[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation)]
    pub(super) fn piece(&self, argument: f64) -> i64 {
        let before = |argument: f64| self.rows.partition_point(|[place, _]| place.value <= argument) as i64;
        let Some(period) = self.period() else { return before(argument) };
        let periods = ((argument - self.rows[0][0].value) / period).floor();
        let within = before(argument - periods * period).clamp(1, self.rows.len() as i64 - 1);
        periods as i64 * self.pieces() + within
    }

    /// Pieces of a period.
    #[allow(clippy::cast_possible_wrap)]
    fn pieces(&self) -> i64 {
        self.rows.len() as i64 - 1
    }

    /// The rows between which a piece lies and the shift of their arguments; nothing where the table holds
    /// its first or last value.
    fn rows_of(&self, piece: i64) -> Option<([[Entry; 2]; 2], f64)> {
        let (row, shift) = match self.period() {
            Some(period) => {
                let within = (piece - 1).rem_euclid(self.pieces());
                (within, period * (piece - 1 - within).div_euclid(self.pieces()) as f64)
            }
            None => (piece - 1, 0.0),
        };
        let row = usize::try_from(row).ok()?;
        Some(([*self.rows.get(row)?, *self.rows.get(row + 1)?], shift))
    }

    /// The straight line of a piece.
    pub(super) fn on_piece<T: Real>(&self, argument: T, piece: i64) -> T {
        let written = |entry: Entry| T::written(entry.value, entry.enclosure);
        if let Some(([[x0, y0], [x1, y1]], shift)) = self.rows_of(piece) {
            let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(written);
            return y0 + (argument - T::exactly(shift) - x0) / (x1 - x0) * (y1 - y0);
        }
        let held = if piece <= 0 { self.rows.first() } else { self.rows.last() };
        held.map_or(T::zero(), |[_, value]| written(*value))
    }

    /// How far an argument is from an end of a piece; nothing where it has none.
    pub(super) fn margin<T: Real>(&self, argument: T, piece: i64, end: End) -> Option<T> {
        let (first, last) = (self.rows.first()?[0], self.rows.last()?[0]);
        let (place, shift) = match (self.rows_of(piece), end) {
            (Some(([[x0, _], _], shift)), End::Lower) => (x0, shift),
            (Some(([_, [x1, _]], shift)), End::Upper) => (x1, shift),
            (None, End::Upper) if piece <= 0 => (first, 0.0),
            (None, End::Lower) if piece > 0 => (last, 0.0),
            (None, _) => return None,
        };
        let from = argument - T::exactly(shift) - T::written(place.value, place.enclosure);
        Some(if end == End::Lower { from } else { -from })
    }

    /// The next piece beyond an end that has a width.
    pub(super) fn beyond(&self, piece: i64, end: End) -> i64 {
        let step = if end == End::Lower { -1 } else { 1 };
        let mut next = piece + step;
        while let Some(([[x0, _], [x1, _]], _)) = self.rows_of(next)
            && x0.value >= x1.value
        {
            next += step;
        }
        next
    }

    /// All values on an interval of arguments.
    fn of_interval(&self, arguments: Interval) -> Interval {
        let (Some([first, first_value]), Some([last, last_value])) = (self.rows.first(), self.rows.last())
        else {
            return Interval::ZERO;
        };
        let period = last.enclosure - first.enclosure;
        if self.beyond == Beyond::Hold || period.lower() <= 0.0 {
            let before = (arguments.lower() < first.enclosure.upper()).then_some(first_value.enclosure);
            let after = (arguments.upper() >= last.enclosure.lower()).then_some(last_value.enclosure);
            let ends = before.into_iter().chain(after);
            return hull(ends.chain(self.segments(arguments)));
        }
        let periods = ((arguments.lower() - first.value) / period.middle()).floor();
        if !periods.is_finite() || arguments.width() >= period.lower() {
            return hull(self.rows.iter().map(|[_, value]| value.enclosure));
        }
        // Rounding may take the interval one period too far.
        let shifted = [-1.0, 0.0, 1.0].map(|more| arguments - period * Interval::point(periods + more));
        hull(shifted.into_iter().flat_map(|arguments| self.segments(arguments)))
    }

    /// The values on each segment that an interval of arguments meets.
    fn segments(&self, arguments: Interval) -> impl Iterator<Item = Interval> + '_ {
        self.rows.windows(2).filter_map(move |rows| {
            let [x0, y0] = rows[0].map(|entry| entry.enclosure);
            let [x1, y1] = rows[1].map(|entry| entry.enclosure);
            let inside = arguments.intersection(x0.hull(x1))?;
            // At a jump every value between is taken.
            let jump = rows[0][0].value >= rows[1][0].value;
            Some(if jump { y0.hull(y1) } else { y0 + (inside - x0) / (x1 - x0) * (y1 - y0) })
        })
    }
}

fn hull(intervals: impl Iterator<Item = Interval>) -> Interval {
    intervals.reduce(Interval::hull).unwrap_or(Interval::REAL_LINE)
}

/// An end of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Below.
    Lower,
    /// Above.
    Upper,
}

impl End {
    pub(crate) const BOTH: [Self; 2] = [Self::Lower, Self::Upper];
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[f64; 2]], beyond: Beyond) -> Arc<Table> {
        let entry = |value| Entry { value, enclosure: Interval::point(value) };
        let rows = rows.iter().map(|row| row.map(entry)).collect();
        Table::new("table", rows, [Inferred::Number; 2], beyond)
    }

    const SAW: &[[f64; 2]] = &[[1.0, 0.0], [2.0, 4.0], [2.0, -1.0], [5.0, 2.0]];

    #[test]
    fn values_are_linear_between_rows_and_jump_where_rows_meet() {
        let saw = table(SAW, Beyond::Hold);
        let expected = [(0.0, 0.0), (1.0, 0.0), (1.5, 2.0), (2.0, -1.0), (3.0, 0.0), (5.0, 2.0), (9.0, 2.0)];
        for (argument, value) in expected {
            assert_eq!(saw.at(argument), value, "at {argument}");
        }
    }

    #[test]
    fn a_period_is_repeated_on_both_sides() {
        let saw = table(SAW, Beyond::Repeat);
        for argument in [-7.5, -2.25, 1.25, 2.5, 4.5] {
            assert_eq!(saw.at(argument + 4.0), saw.at(argument), "at {argument}");
        }
        assert_eq!(saw.at(5.0), 0.0);
    }

    #[test]
    fn intervals_hold_every_value() {
        for beyond in [Beyond::Hold, Beyond::Repeat] {
            let saw = table(SAW, beyond);
            for lower in (-40..60).map(|tenth| f64::from(tenth) / 8.0) {
                for width in [0.0, 0.1, 0.9, 3.0, 7.0] {
                    let range = saw.at(Interval::new(lower, lower + width).unwrap_or(Interval::ZERO));
                    for part in 0..=8 {
                        let argument = lower + width * f64::from(part) / 8.0;
                        assert!(range.contains(saw.at(argument)), "{beyond:?}: {argument} in {range:?}");
                    }
                }
            }
            let narrow = saw.at(Interval::around(1.5, 1e-9));
            assert!(narrow.contains(2.0) && narrow.width() < 1e-8, "{narrow:?}");
        }
    }
}
