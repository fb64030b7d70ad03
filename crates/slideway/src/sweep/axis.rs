//! The values that a varied quantity takes, from their text: `mu=0..0.8:801`, `mu=0.01..1:50:log`, `mu=0.1,0.2,0.5`,
//! `mu=normal(0.3, 0.05)`.

use super::distribution::Distribution;
use super::quantity::Quantity;
use crate::fault::{AxisProblem, Fault, FaultKind, Faults};
use crate::model::Model;

/// A varied quantity and its values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) quantity: Quantity,
    pub(super) values: Values,
    /// The values as they were written.
    pub(super) written: String,
}

/// The values of an axis, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    /// Evenly spaced, both ends included.
    Linear { from: f64, to: f64, count: u64 },
    /// Evenly spaced logarithms.
    Logarithmic { from: f64, to: f64, count: u64 },
    /// As they are listed.
    Listed(Vec<f64>),
    /// Drawn from a distribution.
    Drawn(Distribution),
}

impl Axis {
    /// Reads an axis; one with samples is a distribution, or a plain range for the uniform one.
    ///
    /// # Errors
    /// An unknown name, or what is wrong with the values.
    pub(super) fn parse(model: &Model, text: &str, with_samples: bool) -> Result<Self, Faults> {
        let fault =
            |problem| Faults::from(Fault::general(FaultKind::Axis { text: text.to_owned(), problem }));
        let Some((name, values)) = text.split_once('=') else { return Err(fault(AxisProblem::Malformed)) };
        let (name, values) = (name.trim(), values.trim());
        if name.is_empty() || values.is_empty() {
            return Err(fault(AxisProblem::Malformed));
        }
        let quantity = Quantity::find(model, name)?;
        let reader = Reader { model, quantity: &quantity };
        let read = if with_samples { reader.drawn(values) } else { reader.grid(values) };
        let written = values.to_owned();
        Ok(Self { values: read.map_err(fault)?, quantity, written })
    }
}

impl Values {
    /// How many there are; 1 for a distribution.
    pub(super) fn len(&self) -> u64 {
        match self {
            Self::Linear { count, .. } | Self::Logarithmic { count, .. } => *count,
            Self::Listed(values) => values.len() as u64,
            Self::Drawn(_) => 1,
        }
    }

    /// The value with this number, both ends of a range being exact.
    pub(super) fn at(&self, index: u64) -> f64 {
        match self {
            Self::Linear { from, to, count } => between(index, *count, [*from, *to], |index, last| {
                (from * (last - index) + to * index) / last
            }),
            Self::Logarithmic { from, to, count } => between(index, *count, [*from, *to], |index, last| {
                ((from.ln() * (last - index) + to.ln() * index) / last).exp()
            }),
            Self::Listed(values) => {
                usize::try_from(index).ok().and_then(|i| values.get(i)).map_or(0.0, |v| *v)
            }
            Self::Drawn(distribution) => distribution.quantile(0.5),
        }
    }

    /// The ends of a range.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Linear { from, to, .. } | Self::Logarithmic { from, to, .. } => Some([*from, *to]),
            Self::Listed(_) | Self::Drawn(_) => None,
        }
    }
}

/// Both ends as they are, and what is computed from the number of the value and that of the last one.
fn between(index: u64, count: u64, [from, to]: [f64; 2], at: impl Fn(f64, f64) -> f64) -> f64 {
    if index == 0 {
        from
    } else if index + 1 >= count {
        to
    } else {
        at(index as f64, (count - 1) as f64)
    }
}

struct Reader<'r> {
    model: &'r Model,
    quantity: &'r Quantity,
}

impl Reader<'_> {
    fn value(&self, text: &str) -> Result<f64, AxisProblem> {
        self.quantity.value_of(self.model, text)
    }

    fn range(&self, text: &str) -> Result<Option<[f64; 2]>, AxisProblem> {
        let Some((from, to)) = text.split_once("..") else { return Ok(None) };
        let (from, to) = (self.value(from)?, self.value(to)?);
        if from > to {
            Err(AxisProblem::Reversed { from, to })
        } else if from == to {
            Err(AxisProblem::Empty { from })
        } else if from < 0.0 && self.quantity.is_itself_friction(self.model) {
            Err(AxisProblem::NegativeCoefficients { from, to: to.min(0.0) })
        } else {
            Ok(Some([from, to]))
        }
    }

    fn grid(&self, text: &str) -> Result<Values, AxisProblem> {
        if distribution(text).is_some() {
            return Err(AxisProblem::WithoutSamples);
        }
        if !text.contains("..") {
            let values =
                parts(text).into_iter().map(|part| self.value(part)).collect::<Result<Vec<f64>, _>>()?;
            return match values.iter().find(|value| **value < 0.0) {
                Some(&value) if self.quantity.is_itself_friction(self.model) => {
                    Err(AxisProblem::NegativeCoefficient { value })
                }
                _ => Ok(Values::Listed(values)),
            };
        }
        let mut fields = text.split(':').map(str::trim);
        let range = fields.next().unwrap_or_default();
        let Some([from, to]) = self.range(range)? else { return Err(AxisProblem::Malformed) };
        let count = fields.next().ok_or(AxisProblem::NoCount)?;
        let number = count.parse::<u64>().ok().filter(|count| *count >= 2);
        let count = number.ok_or_else(|| AxisProblem::Count { text: count.to_owned() })?;
        match (fields.next(), fields.next()) {
            (None, _) => Ok(Values::Linear { from, to, count }),
            (Some("log"), None) if from > 0.0 => Ok(Values::Logarithmic { from, to, count }),
            (Some("log"), None) => Err(AxisProblem::NotPositive { from }),
            (Some(spacing), other) => Err(AxisProblem::Spacing { text: other.unwrap_or(spacing).to_owned() }),
        }
    }

    fn drawn(&self, text: &str) -> Result<Values, AxisProblem> {
        let drawn = if let Some((name, arguments)) = distribution(text) {
            self.distribution(name, arguments)?
        } else if text.contains(':') || !text.contains("..") {
            return Err(AxisProblem::GridWithSamples);
        } else {
            let Some([from, to]) = self.range(text)? else { return Err(AxisProblem::GridWithSamples) };
            Distribution::uniform(from, to)
        };
        if !self.quantity.is_friction(self.model) {
            return Ok(Values::Drawn(drawn));
        }
        drawn.not_negative().map(Values::Drawn).ok_or(AxisProblem::NoSupport)
    }

    fn distribution(&self, name: &'static str, arguments: &str) -> Result<Distribution, AxisProblem> {
        let words = match name {
            NORMAL => "its mean and its standard deviation",
            LOGNORMAL => "its median and the standard deviation of its logarithm",
            _ => "its ends",
        };
        let [first, second] = parts(arguments)[..] else {
            return Err(AxisProblem::Arguments { distribution: name, arguments: words });
        };
        let first = self.value(first)?;
        let positive = |what, value: f64| {
            if value > 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err(AxisProblem::Parameter { what, value })
            }
        };
        match name {
            NORMAL => {
                let deviation = positive("the standard deviation", self.value(second)?)?;
                Ok(Distribution::normal(first, deviation))
            }
            LOGNORMAL => {
                let what = "the standard deviation of the logarithm";
                // It is a pure number, whatever the dimension of the quantity.
                let deviation = second.trim().parse().unwrap_or(f64::NAN);
                let median = positive("the median", first)?;
                Ok(Distribution::lognormal(median, positive(what, deviation)?))
            }
            _ => {
                let (from, to) = (first, self.value(second)?);
                if from > to {
                    Err(AxisProblem::Reversed { from, to })
                } else if from == to {
                    Err(AxisProblem::Empty { from })
                } else {
                    Ok(Distribution::uniform(from, to))
                }
            }
        }
    }
}

const NORMAL: &str = "normal";
const LOGNORMAL: &str = "lognormal";
const UNIFORM: &str = "uniform";

/// Name and arguments of a distribution.
fn distribution(text: &str) -> Option<(&'static str, &str)> {
    [NORMAL, LOGNORMAL, UNIFORM].into_iter().find_map(|name| {
        let arguments = text.strip_prefix(name)?.trim_start();
        Some((name, arguments.strip_prefix('(')?.strip_suffix(')')?))
    })
}

/// The parts between commas that stand in no parentheses.
fn parts(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut starts = vec![0];
    for (at, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => starts.push(at + 1),
            _ => {}
        }
    }
    let ends = starts.iter().skip(1).map(|start| start - 1).chain([text.len()]);
    starts.iter().zip(ends).map(|(&start, end)| text[start..end].trim()).collect()
}
