//! The figure of random samples: a histogram of a quantity for each contact, coordinate or drive.

use super::figure::{Axis, Bar, Figure, Panel, headline};
use super::limits;
use super::sweep::Series;
use crate::drawing::number;
use slideway::limits::Quantity;
use slideway::sweep::{Rows, Sweep, SweepState};
use slideway::units::Units;
use std::collections::BTreeMap;

/// The most bins of a tally that are not empty.
const MOST_BINS: usize = 4096;
/// The finest bins are this power of two wide.
const FINEST: i32 = -60;
/// About so many bars of a histogram.
const BARS: f64 = 40.0;
/// This share of the values is left out at either end: near locking a few are very large.
const LEFT_OUT: f64 = 0.025;

/// A sweep over random samples on its way into a figure. What is kept does not grow with the number of samples,
/// and does not depend on the order in which they come.
#[derive(Debug, Clone)]
pub struct SamplesPlot {
    quantity: Quantity,
    units: Units,
    series: Vec<Series>,
    /// For each series, from samples with one solution and from those with several.
    counts: Vec<[Counts; 2]>,
}

/// The counts of some rows for the histograms.
#[derive(Debug, Clone)]
pub struct SamplesPart {
    counts: Vec<[Counts; 2]>,
}

impl SamplesPlot {
    /// None if the sweep is not one of samples, or the model has nothing of this quantity.
    pub fn new(sweep: &Sweep, quantity: Quantity) -> Option<Self> {
        let series = Series::of(sweep, quantity);
        let is_drawn = !sweep.has_branches() && !series.is_empty();
        is_drawn.then(|| Self {
            quantity,
            units: sweep.units().clone(),
            counts: vec![Default::default(); series.len()],
            series,
        })
    }

    /// Counts the values of rows for the histograms; to be used in parallel.
    pub fn rows(&self, rows: &Rows) -> SamplesPart {
        let mut counts: Vec<[Counts; 2]> = vec![Default::default(); self.series.len()];
        for (row, head) in rows.heads.iter().enumerate() {
            let several = usize::from(head.solutions > 1);
            for (counts, series) in counts.iter_mut().zip(&self.series) {
                counts[several].add(rows.numbers(row)[series.column]);
            }
        }
        SamplesPart { counts }
    }

    /// Adds what was taken of other rows.
    pub fn add(&mut self, part: &SamplesPart) {
        for (counts, others) in self.counts.iter_mut().zip(&part.counts) {
            counts.iter_mut().zip(others).for_each(|(counts, other)| counts.merge(other));
        }
    }

    /// The figure: a histogram of each series over the samples that have a solution, and in words which share
    /// has none. A sample with several solutions counts with each of them.
    pub fn figure(&self, title: Option<&str>, state: &SweepState) -> Figure {
        let tally = &state.tally;
        let samples = tally.points - tally.breakpoints;
        let jamming = tally.probability_of_jamming().map(|jamming| {
            let percent = |share: f64| number(100.0 * share);
            let [from, to] = jamming.interval.map(percent);
            format!("; no solution in {} % ({from} to {to} %, confidence 95 %)", percent(jamming.share))
        });
        let subtitle = format!("{samples} samples{}", jamming.unwrap_or_default());
        let panels = self.series.iter().zip(&self.counts);
        Figure {
            title: headline(title, &format!("distribution of the {}", limits::name(self.quantity))),
            subtitle,
            panels: panels.map(|(series, counts)| self.panel(series, counts, samples)).collect(),
            branches: Vec::new(),
            quantities: vec![String::new()],
            one_legend: false,
        }
    }

    fn panel(&self, series: &Series, counts: &[Counts; 2], samples: u64) -> Panel {
        let mut all = counts[0].clone();
        all.merge(&counts[1]);
        let y = Axis { name: "share of samples".to_owned(), unit: "%".to_owned(), ..Axis::default() };
        let name = format!("{} of {}", limits::name(self.quantity), series.name);
        let shown_in = self.units.of(series.unit);
        let x = Axis { name, unit: shown_in.name().to_owned(), ..Axis::default() };
        let Some((exponent, shown)) = all.shown() else { return Panel { x, y, ..Panel::default() } };
        let left_out =
            all.total() - all.at(exponent).range(shown[0]..=shown[1]).map(|(_, count)| count).sum::<u64>();
        let percent = |count: u64| 100.0 * count as f64 / samples.max(1) as f64;
        let beyond = match left_out {
            0 => String::new(),
            count => format!(" ({} % lie beyond what is shown)", number(percent(count))),
        };
        let width = 2.0_f64.powi(exponent);
        let mut bars: Vec<Bar> = Vec::new();
        let mut base: BTreeMap<i128, f64> = BTreeMap::new();
        let words = ["samples with one solution", "samples with several solutions, each counted"];
        for (colour, (counts, words)) in counts.iter().zip(words).enumerate() {
            for (&bin, &count) in counts.at(exponent).range(shown[0]..=shown[1]) {
                let from = base.get(&bin).copied().unwrap_or(0.0);
                let to = from + percent(count);
                base.insert(bin, to);
                let sides = [bin, bin + 1].map(|side| shown_in.number_of(side as f64 * width));
                bars.push(Bar { sides, ends: [from, to], colour, meaning: format!("{words}{beyond}") });
            }
        }
        Panel { x, y, bars, ..Panel::default() }
    }
}

/// How many values lie in each bin, whose width is a power of two. It is the least at which no more than
/// [`MOST_BINS`] are used, so that it does not depend on the order of the values.
#[derive(Debug, Clone, PartialEq)]
struct Counts {
    exponent: i32,
    bins: BTreeMap<i128, u64>,
}

impl Default for Counts {
    fn default() -> Self {
        Self { exponent: FINEST, bins: BTreeMap::new() }
    }
}

impl Counts {
    fn add(&mut self, value: f64) {
        if value.is_finite() {
            #[expect(clippy::cast_possible_truncation, reason = "saturates")]
            let bin = (value / 2.0_f64.powi(self.exponent)).floor() as i128;
            *self.bins.entry(bin).or_default() += 1;
            self.coarsen();
        }
    }

    fn merge(&mut self, other: &Self) {
        let exponent = self.exponent.max(other.exponent);
        let mut bins = self.at(exponent);
        other.at(exponent).into_iter().for_each(|(bin, count)| *bins.entry(bin).or_default() += count);
        *self = Self { exponent, bins };
        self.coarsen();
    }

    fn coarsen(&mut self) {
        while self.bins.len() > MOST_BINS {
            self.bins = self.at(self.exponent + 1);
            self.exponent += 1;
        }
    }

    /// Returns the counts in bins of another width that is not less.
    fn at(&self, exponent: i32) -> BTreeMap<i128, u64> {
        let mut bins = BTreeMap::new();
        for (bin, count) in &self.bins {
            *bins.entry(bin >> (exponent - self.exponent)).or_default() += count;
        }
        bins
    }

    fn total(&self) -> u64 {
        self.bins.values().sum()
    }

    /// The width of bars, as a power of two, and the first and the last of them, without the few values that
    /// lie outermost; none without values.
    fn shown(&self) -> Option<(i32, [i128; 2])> {
        let few = LEFT_OUT * self.total() as f64;
        let outermost = |mut bins: Box<dyn Iterator<Item = (&i128, &u64)> + '_>| {
            let mut passed = 0.0;
            bins.find(|(_, count)| {
                passed += **count as f64;
                passed > few
            })
            .map(|(bin, _)| *bin)
        };
        let (first, last) =
            (outermost(Box::new(self.bins.iter()))?, outermost(Box::new(self.bins.iter().rev()))?);
        let wider = (0..i128::BITS.cast_signed())
            .find(|wider| ((last >> wider) - (first >> wider)) as f64 <= BARS)?;
        Some((self.exponent + wider, [first >> wider, last >> wider]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 20,000 values of a generator with a known period (D. Lehmer's, modulus 2^31 - 1, factor 16807), squared:
    /// below x lies the share sqrt(x).
    fn values() -> Vec<f64> {
        let mut state = 1_u64;
        let next = || {
            state = state * 16807 % 2_147_483_647;
            (state as f64 / 2_147_483_647.0).powi(2)
        };
        std::iter::repeat_with(next).take(20_000).collect()
    }

    fn counts(values: &[f64]) -> Counts {
        let mut counts = Counts::default();
        values.iter().for_each(|value| counts.add(*value));
        counts
    }

    #[test]
    fn bins_do_not_depend_on_the_order() {
        let values = values();
        let all = counts(&values);
        let reversed: Vec<f64> = values.iter().rev().copied().collect();
        assert_eq!(counts(&reversed), all);
        let mut merged = counts(&values[..300]);
        merged.merge(&counts(&values[300..]));
        assert_eq!(merged, all);
        assert!(all.bins.len() <= MOST_BINS && all.total() == 20_000);
    }

    #[test]
    fn bins_hold_the_shares_of_their_distribution() {
        let (exponent, [first, last]) = counts(&values()).shown().expect("values");
        let width = 2.0_f64.powi(exponent);
        assert!(last - first >= 15 && last - first <= 40, "{first} {last}");
        for (bin, count) in counts(&values()).at(exponent) {
            let share = ((bin + 1) as f64 * width).min(1.0).sqrt() - (bin as f64 * width).sqrt();
            // Five standard deviations of a binomial distribution.
            let deviation = (share * (1.0 - share) * 20_000.0).sqrt();
            assert!((count as f64 - share * 20_000.0).abs() < 5.0 * deviation + 1.0, "{bin}: {count}");
        }
        assert_eq!(Counts::default().shown(), None);
    }
}
