//! What is to be varied, and over which range.

use super::varied::{ShownIn, Varied};
use crate::fault::{AxisProblem, Fault, FaultKind, Faults};
use crate::mechanism::MAGNITUDES;
use crate::model::{Model, Value};
use std::fmt;
use std::str::FromStr;

/// Without a range a parameter goes from its value divided by this to its value multiplied by it.
const FACTOR_AROUND: f64 = 5.0;

/// What is to be varied, and over which range: a parameter, a coordinate, or all coefficients of friction
/// together ([`FRICTION`](super::FRICTION)).
///
/// ```
/// use slideway::limits::Vary;
///
/// let friction = Vary::between("mu", 0.0, 0.8);
/// let angle = Vary::between("phi", "-80 deg", "80 deg");
/// assert_eq!("phi=-80 deg..80 deg".parse(), Ok(angle));
/// assert_eq!(friction.to_string(), "mu=0..0.8");
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Vary {
    /// Its name.
    pub name: String,
    /// From where to where. Without it the usual range, which each question has for some quantities.
    pub range: Option<[Value; 2]>,
}

impl Vary {
    /// What bears this name, over its usual range.
    pub fn usual(name: &str) -> Self {
        Self { name: name.to_owned(), range: None }
    }

    /// What bears this name, from one value to another.
    pub fn between(name: &str, from: impl Into<Value>, to: impl Into<Value>) -> Self {
        Self { name: name.to_owned(), range: Some([from.into(), to.into()]) }
    }

    /// The ends of the range in SI units.
    ///
    /// # Errors
    /// A range that is reversed, empty, too great to compute with, or one of coefficients of friction that
    /// begins below zero; whatever `usual` refuses where there is no range.
    pub(crate) fn ends(
        &self,
        varied: &Varied,
        usual: impl FnOnce() -> Result<[f64; 2], Faults>,
    ) -> Result<[f64; 2], Faults> {
        let Some([from, to]) = &self.range else { return usual() };
        let (what, fault) = (varied.in_words(), |kind| Faults::from(Fault::general(kind)));
        let (from, to) = (varied.value_of(from)?, varied.value_of(to)?);
        if from.abs().max(to.abs()) > *MAGNITUDES.end() {
            return Err(fault(FaultKind::Overflow { quantity: format!("the range of {}", varied.name) }));
        }
        if from > to {
            return Err(fault(FaultKind::ReversedRange { what, from, to }));
        }
        if from == to {
            return Err(fault(FaultKind::EmptyRange { what, from }));
        }
        if from < 0.0 && varied.is_itself_friction() {
            let problem = AxisProblem::NegativeCoefficients { from, to: to.min(0.0) };
            return Err(fault(FaultKind::Axis { text: self.to_string(), problem }));
        }
        Ok([from, to])
    }

    /// The unit in which its values are shown.
    pub(crate) fn shown_in(&self, varied: &Varied) -> ShownIn {
        varied.shown_in(self.range.as_ref().map(|[from, to]| [from, to]))
    }
}

/// From "NAME" or "NAME=FROM..TO".
impl FromStr for Vary {
    type Err = Faults;

    fn from_str(text: &str) -> Result<Self, Faults> {
        let Some((name, range)) = text.split_once('=') else { return Ok(Self::usual(text.trim())) };
        let name = name.trim();
        let Some((from, to)) = range.split_once("..") else {
            let kind = FaultKind::MalformedRange { text: range.to_owned(), name: name.to_owned() };
            return Err(Fault::general(kind).into());
        };
        Ok(Self::between(name, from.trim(), to.trim()))
    }
}

impl fmt::Display for Vary {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.range {
            None => formatter.write_str(&self.name),
            Some([from, to]) => write!(formatter, "{}={from}..{to}", self.name),
        }
    }
}

/// A range around the value in the model; coordinates and values of zero need one.
///
/// # Errors
/// A fault if a range is needed.
pub(crate) fn range_around(model: &Model, varied: &Varied) -> Result<[f64; 2], Faults> {
    if varied.is_friction_factor() {
        return Ok([0.0, 2.0 * FACTOR_AROUND]);
    }
    let present = varied.present()?;
    if model.is_friction_coefficient(&varied.name) {
        Ok([0.0, (2.0 * present).max(1.0)])
    } else if varied.is_coordinate() || present == 0.0 {
        let kind = FaultKind::RangeNeeded { what: varied.in_words(), name: varied.name.clone() };
        Err(Fault::general(kind).into())
    } else {
        let ends = [present / FACTOR_AROUND, present * FACTOR_AROUND];
        Ok(if present > 0.0 { ends } else { [ends[1], ends[0]] })
    }
}
