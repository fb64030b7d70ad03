//! Forces with which joints stick while loads change: how long they are admissible.
//!
//! At rest, and with given sides of the contacts, all slacks are affine in the amounts of the loads and in
//! what statics leaves open. The linear program of the greatest least slack has one solution at each amount,
//! and near it what is open goes affinely with the amounts, as the slacks that are least there stay equal.
//! With this *plan* every slack is an affine function of the amounts, so a function of time alone, whose sign
//! interval arithmetic decides over spans of time: by the bounds of the amounts, by the mean value theorem,
//! and by monotony where it falls. Where one of them falls below zero another plan is asked for; where no
//! plan is admissible something slips.

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

/// A plan ends where a slack falls to this below zero: so what is admissible at the boundary where it begins
/// lasts.
const ENDS: f64 = 2.0 * BOUNDARY;
/// Slacks that are so near to the least one are equal.
const EQUAL: f64 = 1e-9;
/// So many cells of time are looked at in one go.
const MOST_CELLS: usize = 1000;

/// A pattern of a group of joints.
pub(super) struct GroupPattern<'s> {
    /// With the sides of the contacts.
    pub(super) phase: &'s Phase,
    /// The joints.
    pub(super) group: &'s Group,
    /// Joints whose velocity is zero and that slide from then on.
    pub(super) stopped: &'s [bool],
}

/// An affine function of the amounts of the loads.
#[derive(Debug, Clone)]
struct AffineInAmounts {
    /// Its value where the plan was made.
    value: f64,
    slopes: Vec<f64>,
}

/// Forces that go affinely with the amounts of the loads.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    /// The amounts where it was made.
    at: Vec<f64>,
    /// The slacks of what concerns the joints that stick.
    slacks: Vec<AffineInAmounts>,
    /// The greatest least of them.
    margin: AffineInAmounts,
}

/// Where the least slack of a plan falls below zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fall {
    /// Nowhere in the span.
    None,
    /// At this time.
    At(f64),
    /// Not before this time; what follows was not decided.
    Unknown(f64),
}

impl Plan {
    /// The plan of a pattern with these amounts, of each of which one unit adds a response to the outputs;
    /// nothing where its equations contradict each other, or a linear program was not solved.
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

    /// The plan for slacks, and what a unit of each amount adds to each of them.
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

    /// The least slack where the plan was made.
    pub(super) fn margin(&self) -> f64 {
        self.margin.value
    }

    /// Where in a span, at whose start it is admissible, the first slack falls below zero; cells of time that
    /// are looked at are counted.
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

    /// The same in a cell; nothing where it has to be divided.
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

    /// Where the margin, which is negative at the end of a span, was zero last; at the start if nowhere.
    ///
    /// # Errors
    /// Loads without a value.
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

/// The slacks of what concerns the joints that stick in a pattern, and of all that hangs together with them;
/// nothing where the equations contradict each other.
fn slacks(instant: &Instant<'_>, system: &GroupPattern<'_>) -> Option<Vec<Affine>> {
    let question = Question {
        outputs: &instant.outputs,
        wanted: vec![0.0; instant.joints.len()],
        has_preload: true,
        sides: Vec::new(),
        stopped: system.stopped,
        opposes: None,
        pushed: Vec::new(),
    };
    let equations = System::new(instant, &question, system.phase, system.group)?;
    let counts = |inequality: &Inequality| {
        inequality.slack.coefficients.iter().any(|a| *a != 0.0)
            || concerns_sticking((instant, system.phase), inequality.subject)
    };
    Some(equations.inequalities().into_iter().filter(counts).map(|inequality| inequality.slack).collect())
}

/// How what is open goes with an amount so that the least slacks stay equal, and their common slope behind
/// it:
///
/// ```text
/// a_i z' + slope_i = t'
/// ```
///
/// of as many of them as do not contradict each other; nothing moves where none is least.
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
