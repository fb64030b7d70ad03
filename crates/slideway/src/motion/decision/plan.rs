//! Forces with which joints stick while loads change, and how long these forces are admissible.
//!
//! At rest, and with given sides of the contacts, all slacks are affine in the amounts of the loads and in
//! what statics leaves open. The linear program that maximizes the least slack has one solution for each
//! amount; near it, the open quantities are affine in the amounts, because the slacks that are least there
//! stay equal. With this *plan*, every slack is an affine function of the amounts, and thus a function of
//! time alone. Interval arithmetic decides its sign over spans of time: by the bounds of the amounts, by the
//! mean value theorem, and by monotonicity where it falls. Where a slack falls below zero, a new plan is
//! requested; where no plan is admissible, something slips.

use super::BOUNDARY;
use super::assessment::concerns_sticking;
use super::instant::Instant;
use super::outputs::Group;
use super::system::{Inequality, Question, System};
use crate::fault::Fault;
use crate::interval::{Interval, Sloped};
use crate::motion::moving::amounts::Amounts;
use crate::motion::moving::root::{NARROWEST, falling_root};
use crate::pattern::{Affine, AffineSet, Phase, Region};
use nalgebra::{DMatrix, DVector};

/// A plan ends where a slack falls this far below zero, so that whatever is admissible at the boundary where
/// it begins lasts.
const ENDS: f64 = 2.0 * BOUNDARY;
/// Slacks this close to the least one count as equal.
const EQUAL: f64 = 1e-9;
/// At most this many cells of time are examined at once.
const MOST_CELLS: usize = 1000;

/// A pattern of a group of joints.
pub(super) struct GroupPattern<'s> {
    /// The phase, with the sides of the contacts.
    pub(super) phase: &'s Phase,
    /// The joints.
    pub(super) group: &'s Group,
    /// Joints whose velocity is zero; those of them that slide have just begun to.
    pub(super) stopped: &'s [bool],
}

/// An affine function of the amounts of the loads.
#[derive(Debug, Clone)]
struct AffineInAmounts {
    /// Its value where the plan was computed.
    value: f64,
    slopes: Vec<f64>,
}

/// Forces that are affine in the amounts of the loads.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    /// The amounts for which it was computed.
    at: Vec<f64>,
    /// The slacks of the inequalities that concern sticking joints.
    slacks: Vec<AffineInAmounts>,
    /// The maximized least slack.
    margin: AffineInAmounts,
}

/// Where the least slack of a plan falls below zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fall {
    /// Nowhere in the span.
    None,
    /// At this time.
    At(f64),
    /// Not before this time; after it, nothing was decided.
    Unknown(f64),
}

impl Plan {
    /// The plan of a pattern with these amounts, one unit of each of which adds a response to the outputs;
    /// `None` if its equations contradict each other, or if a linear program was not solved.
    pub(super) fn new(
        instant: &mut Instant<'_>,
        system: &GroupPattern<'_>,
        (amounts, responses): (&[f64], &[DVector<f64>]),
    ) -> Option<Self> {
        let now = slacks(instant, system)?;
        let mut slopes = vec![Vec::with_capacity(amounts.len()); now.len()];
        for response in responses {
            let unit = response.amax();
            let base = instant.outputs.base.clone();
            if unit > 0.0 {
                instant.outputs.base.axpy(1.0 / unit, response, 1.0);
            }
            let then = slacks(instant, system);
            instant.outputs.base = base;
            let changes =
                then?.into_iter().zip(&now).map(|(then, now)| (then.constant - now.constant) * unit);
            slopes.iter_mut().zip(changes).for_each(|(slopes, change)| slopes.push(change));
        }
        Self::of(amounts.to_vec(), &now, &slopes)
    }

    /// The plan for slacks, given what a unit of each amount adds to each of them.
    fn of(at: Vec<f64>, now: &[Affine], slopes: &[Vec<f64>]) -> Option<Self> {
        let dimension = now.first().map_or(0, |slack| slack.coefficients.len());
        let open = |slack: &Affine| slack.coefficients.iter().any(|a| *a != 0.0);
        let together: Vec<Affine> = now.iter().filter(|slack| open(slack)).cloned().collect();
        let (best, z) = if together.is_empty() {
            (f64::INFINITY, vec![0.0; dimension])
        } else {
            Region::new(dimension, together).highest().ok()?
        };
        let least: Vec<usize> =
            (0..now.len()).filter(|&i| open(&now[i]) && now[i].at(&z) <= best + EQUAL).collect();
        let moves: Vec<DVector<f64>> =
            (0..at.len()).map(|amount| direction(now, slopes, (&least, amount))).collect();
        let line = |index: usize| {
            let Affine { coefficients, .. } = &now[index];
            let with_open = |amount: usize| {
                let opens = coefficients.iter().zip(moves[amount].iter()).map(|(a, z)| a * z);
                slopes[index][amount] + opens.sum::<f64>()
            };
            AffineInAmounts { value: now[index].at(&z), slopes: (0..at.len()).map(with_open).collect() }
        };
        let slacks: Vec<AffineInAmounts> = (0..now.len()).map(line).collect();
        let lowest = slacks.iter().min_by(|one, other| one.value.total_cmp(&other.value));
        let nothing = AffineInAmounts { value: f64::INFINITY, slopes: vec![0.0; at.len()] };
        let margin = match lowest {
            Some(lowest) if lowest.value < best - EQUAL || least.is_empty() => lowest.clone(),
            Some(lowest) => {
                // The equal ones stay equal: each has their common slope, which is the last of the unknowns.
                let slopes = moves.iter().map(|moves| moves[dimension]).collect();
                AffineInAmounts { value: lowest.value, slopes }
            }
            None => nothing,
        };
        Some(Self { at, slacks, margin })
    }

    /// The least slack where the plan was computed.
    pub(super) fn margin(&self) -> f64 {
        self.margin.value
    }

    /// Where the first slack falls below zero in a span at whose start the plan is admissible; counts the
    /// cells of time that are examined.
    pub(super) fn first_fall(
        &self,
        amounts: &Amounts<'_>,
        [from, until]: [f64; 2],
        cells: &mut usize,
    ) -> Fall {
        let (mut time, mut cell) = (from, until - from);
        while time < until {
            let end = if cell < until - time { time + cell } else { until };
            *cells += 1;
            if *cells > MOST_CELLS {
                return Fall::Unknown(time);
            }
            match self.within(amounts, [time, end]) {
                Some(Fall::None) => (time, cell) = (end, 2.0 * (end - time)),
                Some(fall) => return fall,
                None if end - time > NARROWEST * f64::EPSILON * end.abs() => cell = (end - time) / 2.0,
                None => return Fall::Unknown(time),
            }
        }
        Fall::None
    }

    /// The same in a cell; `None` if the cell must be divided.
    fn within(&self, amounts: &Amounts<'_>, [from, until]: [f64; 2]) -> Option<Fall> {
        let span = Interval::new(from, until)?;
        let middle = Interval::point(span.middle());
        let over = amounts.over(span)?;
        let centre = amounts.over(middle)?;
        let mut falling = Vec::new();
        for slack in &self.slacks {
            let whole = self.over(slack, &over);
            if whole.value.lower() > -ENDS {
                continue;
            }
            // The mean value theorem.
            let near = self.over(slack, &centre).value + whole.slope * (span - middle);
            if near.lower() > -ENDS || whole.slope.lower() >= 0.0 {
                continue;
            }
            if whole.slope.upper() > 0.0 {
                return None;
            }
            falling.push(slack);
        }
        let mut first = Fall::None;
        for slack in falling {
            let end = if let Fall::At(end) = first { end } else { until };
            let value = |time: f64| Ok::<_, Fault>(self.value(slack, &amounts.at(time)?) + ENDS);
            let values = [value(from).ok()?, value(end).ok()?];
            if values[0] <= 0.0 {
                first = Fall::At(from);
            } else if values[1] <= 0.0 {
                first = Fall::At(falling_root([from, end], values, 0.0, value).ok()?);
            }
        }
        Some(first)
    }

    /// Where the margin, which is negative at the end of a span, was last zero; the start if nowhere.
    ///
    /// # Errors
    /// Loads have no value.
    pub(super) fn zero_before(&self, amounts: &Amounts<'_>, [from, until]: [f64; 2]) -> Result<f64, Fault> {
        let value = |time: f64| Ok::<_, Fault>(self.value(&self.margin, &amounts.at(time)?));
        let (mut end, mut at_end) = (until, value(until)?);
        let mut step = NARROWEST * f64::EPSILON * until.abs().max(f64::MIN_POSITIVE);
        while end > from && at_end < 0.0 {
            let start = (until - step).max(from);
            let at_start = value(start)?;
            if at_start >= 0.0 {
                return falling_root([start, end], [at_start, at_end], 0.0, value);
            }
            (end, at_end) = (start, at_start);
            step *= NARROWEST;
        }
        Ok(end)
    }

    fn value(&self, line: &AffineInAmounts, amounts: &[f64]) -> f64 {
        let changes = amounts.iter().zip(&self.at).zip(&line.slopes);
        line.value + changes.map(|((amount, at), slope)| slope * (amount - at)).sum::<f64>()
    }

    fn over(&self, line: &AffineInAmounts, amounts: &[Sloped]) -> Sloped {
        let changes = amounts.iter().zip(&self.at).zip(&line.slopes).filter(|(_, slope)| **slope != 0.0);
        let point = |value: f64| Sloped::constant(Interval::point(value));
        changes.fold(point(line.value), |sum, ((amount, at), slope)| {
            sum + (*amount - point(*at)) * point(*slope)
        })
    }
}

/// The slacks of the inequalities of a pattern that concern sticking joints, and of all inequalities linked
/// with them; `None` if the equations contradict each other.
fn slacks(instant: &Instant<'_>, system: &GroupPattern<'_>) -> Option<Vec<Affine>> {
    let question = Question {
        outputs: &instant.outputs,
        wanted: vec![0.0; instant.rubbing()],
        has_preload: true,
        sides: Vec::new(),
        stopped: system.stopped,
        opposes: None,
    };
    let equations = System::new(instant, &question, system.phase, system.group)?;
    let counts = |inequality: &Inequality| {
        inequality.slack.coefficients.iter().any(|a| *a != 0.0)
            || concerns_sticking((instant, system.phase), inequality.subject)
    };
    Some(equations.inequalities().into_iter().filter(counts).map(|inequality| inequality.slack).collect())
}

/// How the open quantities vary with an amount so that the least slacks stay equal, followed by their common
/// slope:
///
/// ```text
/// a_i z' + slope_i = t'
/// ```
///
/// for as many of them as do not contradict each other; zero if no slack is least.
fn direction(now: &[Affine], slopes: &[Vec<f64>], (least, amount): (&[usize], usize)) -> DVector<f64> {
    let dimension = now.first().map_or(0, |slack| slack.coefficients.len());
    for count in (1..=least.len()).rev() {
        let rows = &least[..count];
        let matrix = DMatrix::from_fn(count, dimension + 1, |row, column| {
            now[rows[row]].coefficients.get(column).copied().unwrap_or(-1.0)
        });
        let unit = rows.iter().fold(0.0_f64, |unit, row| unit.max(slopes[*row][amount].abs()));
        let scale = if unit > 0.0 { unit } else { 1.0 };
        let right_hand_side = DVector::from_fn(count, |row, _| -slopes[rows[row]][amount] / scale);
        if let Some(solutions) = AffineSet::of(matrix, right_hand_side) {
            return solutions.particular() * scale;
        }
    }
    DVector::zeros(dimension + 1)
}
