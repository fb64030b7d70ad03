//! Tally of a sweep, and the probabilities that follow from it.

use super::rows::{PointStatus, Refusal, RowKind, Rows};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The quantile of the normal distribution for a confidence of 95 %.
const CONFIDENCE: f64 = 1.959_963_984_540_054;

/// Numbers of points, rows and kinds of outcome, so far.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Points, inserted ones included.
    pub points: u64,
    /// Inserted points.
    pub breakpoints: u64,
    /// Rows.
    pub rows: u64,
    /// Points by what became of them; inserted ones are left out.
    pub statuses: BTreeMap<PointStatus, u64>,
    /// Points by their number of solutions; inserted ones are left out, and those of `rests`.
    pub solutions: BTreeMap<u32, u64>,
    /// Points at which it stays at rest in every state, by what became of them; inserted ones are left out.
    #[serde(default)]
    pub rests: BTreeMap<PointStatus, u64>,
    /// Points without a solution because a guided slider tips; inserted ones are left out.
    #[serde(default)]
    pub tipping: u64,
    /// Points at which a block tips in every state; inserted ones are left out.
    #[serde(default)]
    pub tips: u64,
    /// Rows on the boundary between modes.
    pub boundary_rows: u64,
    /// The first point of each kind that was not solved, and why.
    pub refusals: BTreeMap<PointStatus, (u64, String)>,
}

/// What became of a point.
#[derive(Clone, Copy, PartialEq)]
struct Outcome {
    status: PointStatus,
    solutions: u32,
    rests: bool,
}

/// A share of samples, with an interval that holds the probability with a confidence of 95 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probability {
    /// The share.
    pub share: f64,
    /// Lower and upper end of the interval.
    pub interval: [f64; 2],
}

impl Tally {
    /// Adds rows.
    pub fn add(&mut self, rows: &Rows) {
        self.rows += rows.len() as u64;
        let mut last = None;
        // Points that follow one another and came to the same are counted together.
        let mut alike: Option<Outcome> = None;
        let mut count = 0;
        for (row, head) in rows.heads.iter().enumerate() {
            self.boundary_rows += u64::from(head.kind == RowKind::Boundary);
            if last == Some(head.point) {
                continue;
            }
            last = Some(head.point);
            self.points += 1;
            if head.inserted {
                self.breakpoints += 1;
                continue;
            }
            self.tipping += u64::from(head.status == PointStatus::None && head.rejected > 0);
            let states = || rows.heads[row..].iter().take_while(|other| other.point == head.point);
            self.tips += u64::from(states().all(|state| state.tips));
            let rests = states().all(|state| state.kind.rests());
            let outcome = Some(Outcome { status: head.status, solutions: head.solutions, rests });
            if outcome != alike {
                self.count(alike, count);
                (alike, count) = (outcome, 0);
            }
            count += 1;
        }
        self.count(alike, count);
        for Refusal { point, status, reason } in &rows.refusals {
            self.refusals.entry(*status).or_insert_with(|| (*point, reason.clone()));
        }
    }

    /// Counts points that came to the same.
    fn count(&mut self, outcome: Option<Outcome>, count: u64) {
        let Some(Outcome { status, solutions, rests }) = outcome else { return };
        *self.statuses.entry(status).or_default() += count;
        if rests {
            *self.rests.entry(status).or_default() += count;
        } else if status.is_solved() {
            *self.solutions.entry(solutions).or_default() += count;
        }
    }

    /// How many points have this status.
    pub fn with_status(&self, status: PointStatus) -> u64 {
        self.statuses.get(&status).copied().unwrap_or(0)
    }

    /// How many points were solved.
    pub fn solved(&self) -> u64 {
        self.statuses.iter().filter(|(status, _)| status.is_solved()).map(|(_, count)| count).sum()
    }

    /// The probability that friction locks the mechanism, among the points that were solved, if these are
    /// independent samples: the interval is that of E. B. Wilson (Journal of the American Statistical
    /// Association 22, 1927). None without points.
    pub fn probability_of_jamming(&self) -> Option<Probability> {
        let count = self.solved();
        (count > 0).then(|| wilson(self.with_status(PointStatus::None), count))
    }
}

fn wilson(hits: u64, count: u64) -> Probability {
    let (hits, n) = (hits as f64, count as f64);
    let share = hits / n;
    let z2 = CONFIDENCE * CONFIDENCE;
    let middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = CONFIDENCE / (1.0 + z2 / n) * (share * (1.0 - share) / n + z2 / (4.0 * n * n)).sqrt();
    // Without hits, or with hits alone, an end is the share itself, but for rounding.
    let lower = if share == 0.0 { 0.0 } else { middle - half };
    let upper = if share == 1.0 { 1.0 } else { middle + half };
    Probability { share, interval: [lower, upper] }
}

#[cfg(test)]
mod tests {
    use super::wilson;

    #[test]
    fn an_interval_ends_where_nothing_is_left() {
        for count in 1..2000 {
            assert_eq!(wilson(0, count).interval[0], 0.0);
            assert_eq!(wilson(count, count).interval[1], 1.0);
        }
    }

    /// R. G. Newcombe, Statistics in Medicine 17 (1998), table I, method 3: 81/263, 15/148, 0/20, 1/29.
    #[test]
    fn intervals_are_those_of_newcombe() {
        for (hits, count, lower, upper) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let [from, to] = wilson(hits, count).interval;
            assert!((from - lower).abs() < 5e-5 && (to - upper).abs() < 5e-5, "{hits}/{count}: {from} {to}");
        }
    }
}
