//! Points of a sweep: the axes of a grid, or quantities with their distributions.

use super::Sampling;
use crate::expression::{TO, ends_of_range};
use crate::fault::{AxisProblem, Fault, FaultKind, Faults};
use crate::model::Value;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Options of a sweep: its points, and what is computed at each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SweepOptions {
    /// The points.
    pub points: SweepPoints,
    /// Whether exact ends of modes are inserted into grids over one quantity.
    pub breakpoints: bool,
    /// Whether the attainability of each solution is examined.
    pub attainability: bool,
    /// Whether accelerations of bodies and hinge forces have columns, too.
    pub all_columns: bool,
}

impl SweepOptions {
    /// A grid over these axes, the last one varying fastest, with the exact ends of modes if there is one
    /// axis.
    pub fn grid(axes: impl IntoIterator<Item = GridAxis>) -> Self {
        Self::over(SweepPoints::Grid(axes.into_iter().collect()))
    }

    /// Random samples of these quantities.
    pub fn samples(sampling: Sampling, axes: impl IntoIterator<Item = SampledAxis>) -> Self {
        Self::over(SweepPoints::Samples(sampling, axes.into_iter().collect()))
    }

    /// These points.
    pub fn over(points: SweepPoints) -> Self {
        Self { breakpoints: points.is_line(), points, attainability: false, all_columns: false }
    }

    /// Whether exact ends of modes are inserted between the points of a grid over one quantity; into others they never
    /// are.
    #[must_use]
    pub fn breakpoints(mut self, breakpoints: bool) -> Self {
        self.breakpoints = breakpoints && self.points.is_line();
        self
    }

    /// Whether the attainability of each solution is examined.
    #[must_use]
    pub fn attainability(mut self, attainability: bool) -> Self {
        self.attainability = attainability;
        self
    }

    /// Whether accelerations of bodies and hinge forces have columns, too.
    #[must_use]
    pub fn all_columns(mut self, all: bool) -> Self {
        self.all_columns = all;
        self
    }
}

/// The points of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SweepPoints {
    /// Every combination of the values on these axes.
    Grid(Vec<GridAxis>),
    /// Samples of these quantities.
    Samples(Sampling, Vec<SampledAxis>),
}

impl SweepPoints {
    /// How many quantities vary.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Grid(axes) => axes.len(),
            Self::Samples(_, axes) => axes.len(),
        }
    }

    /// The names of the quantities that vary.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Grid(axes) => axes.iter().map(|axis| axis.name.clone()).collect(),
            Self::Samples(_, axes) => axes.iter().map(|axis| axis.name.clone()).collect(),
        }
    }

    /// Whether they are a grid over one quantity.
    pub fn is_line(&self) -> bool {
        matches!(self, Self::Grid(axes) if axes.len() == 1)
    }
}

/// A quantity and its values on a grid.
///
/// ```
/// use slideway::sweep::GridAxis;
///
/// assert_eq!("mu=0..0.8:801".parse(), Ok(GridAxis::linear("mu", "0", "0.8", 801)));
/// assert_eq!(GridAxis::listed("l", ["25 mm", "35 mm"]).to_string(), "l=25 mm,35 mm");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct GridAxis {
    /// The name of a parameter or coordinate, `COORDINATE.rate`, `friction` for the common factor of all
    /// coefficients, or `time`.
    pub name: String,
    /// Its values.
    pub values: GridValues,
}

/// The values of a quantity on a grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "each variant says what its values mean")]
pub enum GridValues {
    /// So many evenly spaced values, at least 2, both ends included.
    Linear { from: Value, to: Value, count: u64 },
    /// So many values with evenly spaced logarithms, at least 2, both ends included.
    Logarithmic { from: Value, to: Value, count: u64 },
    /// As they are listed.
    Listed(Vec<Value>),
}

impl GridAxis {
    /// Evenly spaced values, at least 2, both ends included.
    pub fn linear(name: &str, from: impl Into<Value>, to: impl Into<Value>, count: u64) -> Self {
        Self { name: name.to_owned(), values: GridValues::Linear { from: from.into(), to: to.into(), count } }
    }

    /// Values with evenly spaced logarithms, at least 2, both ends included.
    pub fn logarithmic(name: &str, from: impl Into<Value>, to: impl Into<Value>, count: u64) -> Self {
        let (from, to) = (from.into(), to.into());
        Self { name: name.to_owned(), values: GridValues::Logarithmic { from, to, count } }
    }

    /// These values.
    pub fn listed<V: Into<Value>>(name: &str, values: impl IntoIterator<Item = V>) -> Self {
        let values = values.into_iter().map(Into::into).collect();
        Self { name: name.to_owned(), values: GridValues::Listed(values) }
    }
}

impl fmt::Display for GridAxis {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}=", self.name)?;
        match &self.values {
            GridValues::Linear { from, to, count } => write!(formatter, "{from}..{to}:{count}"),
            GridValues::Logarithmic { from, to, count } => write!(formatter, "{from}..{to}:{count}:log"),
            GridValues::Listed(values) => {
                let values: Vec<String> = values.iter().map(ToString::to_string).collect();
                formatter.write_str(&values.join(","))
            }
        }
    }
}

/// From "NAME=FROM..TO:COUNT", "NAME=FROM..TO:COUNT:log" or "NAME=VALUE,VALUE,...".
impl FromStr for GridAxis {
    type Err = Faults;

    fn from_str(text: &str) -> Result<Self, Faults> {
        let read = || {
            let (name, values) = name_and_values(text)?;
            Ok(Self { name: name.to_owned(), values: grid_values(values)? })
        };
        read().map_err(|problem| fault(text, problem))
    }
}

fn grid_values(text: &str) -> Result<GridValues, AxisProblem> {
    if distribution(text).is_some() {
        return Err(AxisProblem::WithoutSamples);
    }
    if !text.contains("..") {
        return Ok(GridValues::Listed(parts(text).into_iter().map(Value::from).collect()));
    }
    let mut fields = text.split(':').map(str::trim);
    let Some((from, to)) = range(fields.next().unwrap_or_default()) else {
        return Err(AxisProblem::Malformed);
    };
    let count = fields.next().ok_or(AxisProblem::NoCount)?;
    let count = count.parse().map_err(|_| AxisProblem::Count { text: count.to_owned() })?;
    match (fields.next(), fields.next()) {
        (None, _) => Ok(GridValues::Linear { from, to, count }),
        (Some("log"), None) => Ok(GridValues::Logarithmic { from, to, count }),
        (Some(spacing), other) => Err(AxisProblem::Spacing { text: other.unwrap_or(spacing).to_owned() }),
    }
}

/// A quantity and its distribution. That of friction is cut off at zero.
///
/// ```
/// use slideway::sweep::SampledAxis;
///
/// assert_eq!("mu=normal(0.3, 0.05)".parse(), Ok(SampledAxis::normal("mu", "0.3", "0.05")));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SampledAxis {
    /// The name of a quantity, as on a grid.
    pub name: String,
    /// Its distribution.
    pub values: SampledValues,
}

/// The distribution of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "each variant says what its values mean")]
pub enum SampledValues {
    /// Uniform over a range; one of coefficients of friction must not begin below zero.
    Range { from: Value, to: Value },
    /// Uniform between two ends.
    Uniform { from: Value, to: Value },
    /// Normal.
    Normal { mean: Value, deviation: Value },
    /// The logarithm is normal, with this standard deviation, a pure number.
    LogNormal { median: Value, deviation: f64 },
}

impl SampledAxis {
    /// Uniform over a range; one of coefficients of friction must not begin below zero.
    pub fn range(name: &str, from: impl Into<Value>, to: impl Into<Value>) -> Self {
        Self { name: name.to_owned(), values: SampledValues::Range { from: from.into(), to: to.into() } }
    }

    /// Uniform between two ends.
    pub fn uniform(name: &str, from: impl Into<Value>, to: impl Into<Value>) -> Self {
        Self { name: name.to_owned(), values: SampledValues::Uniform { from: from.into(), to: to.into() } }
    }

    /// Normal.
    pub fn normal(name: &str, mean: impl Into<Value>, deviation: impl Into<Value>) -> Self {
        let (mean, deviation) = (mean.into(), deviation.into());
        Self { name: name.to_owned(), values: SampledValues::Normal { mean, deviation } }
    }

    /// The logarithm is normal, with this standard deviation.
    pub fn log_normal(name: &str, median: impl Into<Value>, deviation: f64) -> Self {
        Self { name: name.to_owned(), values: SampledValues::LogNormal { median: median.into(), deviation } }
    }
}

impl fmt::Display for SampledAxis {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}=", self.name)?;
        match &self.values {
            SampledValues::Range { from, to } => write!(formatter, "{from}..{to}"),
            SampledValues::Uniform { from, to } => write!(formatter, "{UNIFORM}({from}, {to})"),
            SampledValues::Normal { mean, deviation } => write!(formatter, "{NORMAL}({mean}, {deviation})"),
            SampledValues::LogNormal { median, deviation } => {
                write!(formatter, "{LOGNORMAL}({median}, {deviation})")
            }
        }
    }
}

/// From "NAME=FROM..TO", "NAME=uniform(FROM, TO)", "NAME=normal(MEAN, DEVIATION)" or "NAME=lognormal(MEDIAN,
/// DEVIATION OF THE LOGARITHM)".
impl FromStr for SampledAxis {
    type Err = Faults;

    fn from_str(text: &str) -> Result<Self, Faults> {
        let read = || {
            let (name, values) = name_and_values(text)?;
            Ok(Self { name: name.to_owned(), values: sampled_values(values)? })
        };
        read().map_err(|problem| fault(text, problem))
    }
}

fn sampled_values(text: &str) -> Result<SampledValues, AxisProblem> {
    let Some((name, arguments)) = distribution(text) else {
        return match range(text) {
            Some((from, to)) if !text.contains(':') => Ok(SampledValues::Range { from, to }),
            _ => Err(AxisProblem::GridWithSamples),
        };
    };
    let words = match name {
        NORMAL => "its mean and its standard deviation",
        LOGNORMAL => "its median and the standard deviation of its logarithm",
        _ => "its ends",
    };
    let [first, second] = parts(arguments)[..] else {
        return Err(AxisProblem::Arguments { distribution: name, arguments: words });
    };
    Ok(match name {
        NORMAL => SampledValues::Normal { mean: first.into(), deviation: second.into() },
        LOGNORMAL => {
            // What is no number is refused as one that is not positive.
            let refused = |_| AxisProblem::Parameter { what: LOGARITHM, value: f64::NAN };
            SampledValues::LogNormal { median: first.into(), deviation: second.parse().map_err(refused)? }
        }
        _ => SampledValues::Uniform { from: first.into(), to: second.into() },
    })
}

const NORMAL: &str = "normal";
const LOGNORMAL: &str = "lognormal";
const UNIFORM: &str = "uniform";
/// Name of the second number of a lognormal distribution.
pub(super) const LOGARITHM: &str = "the standard deviation of the logarithm";

/// Returns the fault of the axis that was written as `text`.
pub(super) fn fault(text: &str, problem: AxisProblem) -> Faults {
    let kind = FaultKind::Axis { text: text.to_owned(), problem };
    Fault::of_argument(kind, text, 0..text.len()).into()
}

fn name_and_values(text: &str) -> Result<(&str, &str), AxisProblem> {
    let (name, values) = text.split_once('=').ok_or(AxisProblem::Malformed)?;
    let (name, values) = (name.trim(), values.trim());
    ends_of_range(values).map_err(|_| AxisProblem::ThreeDots)?;
    if name.is_empty() || values.is_empty() { Err(AxisProblem::Malformed) } else { Ok((name, values)) }
}

/// Both ends of `FROM..TO`.
fn range(text: &str) -> Option<(Value, Value)> {
    let (from, to) = text.split_once(TO)?;
    Some((from.trim().into(), to.trim().into()))
}

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
