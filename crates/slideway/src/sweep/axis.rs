//! The values that a varied quantity takes, in SI units.

use super::distribution::Distribution;
use super::options::{GridAxis, GridValues, LOGARITHM, SampledAxis, SampledValues, fault};
use super::quantity::Quantity;
use crate::fault::{AxisProblem, Faults};
use crate::model::{Model, Value};

/// A varied quantity and its values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) quantity: Quantity,
    pub(super) values: Values,
    /// The ends of a range as they were given.
    pub(super) given: Option<[Value; 2]>,
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
    /// # Errors
    /// An unknown name, or what is wrong with the values.
    pub(super) fn of_grid(model: &Model, axis: &GridAxis) -> Result<Self, Faults> {
        let quantity = Quantity::find(model, &axis.name)?;
        let given = match &axis.values {
            GridValues::Linear { from, to, .. } | GridValues::Logarithmic { from, to, .. } => {
                Some([from.clone(), to.clone()])
            }
            GridValues::Listed(_) => None,
        };
        let reader = Reader { model, quantity: &quantity };
        let values = reader.grid(&axis.values).map_err(|problem| fault(&axis.to_string(), problem))?;
        Ok(Self { quantity, values, given })
    }

    /// # Errors
    /// An unknown name, or what is wrong with the distribution.
    pub(super) fn of_samples(model: &Model, axis: &SampledAxis) -> Result<Self, Faults> {
        let quantity = Quantity::find(model, &axis.name)?;
        let reader = Reader { model, quantity: &quantity };
        let values = reader.drawn(&axis.values).map_err(|problem| fault(&axis.to_string(), problem))?;
        Ok(Self { quantity, values, given: None })
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
    fn value(&self, value: &Value) -> Result<f64, AxisProblem> {
        self.quantity.value_of(self.model, value)
    }

    fn ends(&self, [from, to]: [&Value; 2]) -> Result<[f64; 2], AxisProblem> {
        let given = from;
        let (from, to) = (self.value(from)?, self.value(to)?);
        if from == to {
            return Err(AxisProblem::Empty { from: given.to_string() });
        }
        // Whoever begins with the greater end means the same range.
        Ok([from.min(to), from.max(to)])
    }

    fn range(&self, ends: [&Value; 2]) -> Result<[f64; 2], AxisProblem> {
        let [from, to] = self.ends(ends)?;
        if from < 0.0 && self.quantity.is_itself_friction(self.model) {
            return Err(AxisProblem::NegativeCoefficients { from, to: to.min(0.0) });
        }
        Ok([from, to])
    }

    fn grid(&self, values: &GridValues) -> Result<Values, AxisProblem> {
        let (given, number) = match values {
            GridValues::Listed(list) => return self.listed(list),
            GridValues::Linear { from, to, count } | GridValues::Logarithmic { from, to, count } => {
                ([from, to], *count)
            }
        };
        let ([from, to], count) = (self.range(given)?, number);
        if count < 2 {
            return Err(AxisProblem::Count { text: count.to_string() });
        }
        match values {
            GridValues::Logarithmic { .. } if from <= 0.0 => Err(AxisProblem::NotPositive { from }),
            GridValues::Logarithmic { .. } => Ok(Values::Logarithmic { from, to, count }),
            _ => Ok(Values::Linear { from, to, count }),
        }
    }

    fn listed(&self, list: &[Value]) -> Result<Values, AxisProblem> {
        let values = list.iter().map(|value| self.value(value)).collect::<Result<Vec<f64>, _>>()?;
        match values.iter().find(|value| **value < 0.0) {
            Some(&value) if self.quantity.is_itself_friction(self.model) => {
                Err(AxisProblem::NegativeCoefficient { value })
            }
            _ if values.is_empty() => Err(AxisProblem::Malformed),
            _ => Ok(Values::Listed(values)),
        }
    }

    fn drawn(&self, values: &SampledValues) -> Result<Values, AxisProblem> {
        let drawn = self.distribution(values)?;
        if !self.quantity.is_friction(self.model) {
            return Ok(Values::Drawn(drawn));
        }
        drawn.not_negative().map(Values::Drawn).ok_or(AxisProblem::NoSupport)
    }

    fn distribution(&self, values: &SampledValues) -> Result<Distribution, AxisProblem> {
        let positive = |what, value: f64| {
            if value > 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err(AxisProblem::Parameter { what, value })
            }
        };
        match values {
            SampledValues::Range { from, to } => {
                self.range([from, to]).map(|[from, to]| Distribution::uniform(from, to))
            }
            SampledValues::Uniform { from, to } => {
                self.ends([from, to]).map(|[from, to]| Distribution::uniform(from, to))
            }
            SampledValues::Normal { mean, deviation } => {
                let mean = self.value(mean)?;
                let deviation = positive("the standard deviation", self.value(deviation)?)?;
                Ok(Distribution::normal(mean, deviation))
            }
            SampledValues::LogNormal { median, deviation } => {
                let median = positive("the median", self.value(median)?)?;
                Ok(Distribution::lognormal(median, positive(LOGARITHM, *deviation)?))
            }
        }
    }
}
