//! Faults of a quantity that is varied.

use super::{Face, FaultKind, Faults};

/// Kind of fault of a quantity that is varied.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message above each variant says what it and its values mean")]
pub enum AxisProblem {
    #[error("it is not of the form NAME=VALUES")]
    Malformed,
    #[error("there are three dots in its range")]
    ThreeDots,
    #[error("it does not say how many values there are")]
    NoCount,
    #[error("`{text}` is not a number of values (2 or more)")]
    Count { text: String },
    #[error("`{text}` is not a spacing")]
    Spacing { text: String },
    #[error("the range is empty: it begins and ends at {from}")]
    Empty { from: String },
    #[error("logarithmic spacing needs a range above zero, but it begins at {from}")]
    NotPositive { from: f64 },
    #[error("{message}")]
    Value { message: String, hint: Option<Box<FaultKind>> },
    #[error("the factor of friction cannot be negative, but it is {value}")]
    NegativeFriction { value: f64 },
    #[error("coefficients of friction cannot be negative, but from {from} to {to} they are")]
    NegativeCoefficients { from: f64, to: f64 },
    #[error("coefficients of friction cannot be negative, but {value} is")]
    NegativeCoefficient { value: f64 },
    #[error("it is a distribution, but there are no samples")]
    WithoutSamples,
    #[error("samples are drawn from a distribution or from a plain range")]
    GridWithSamples,
    #[error("{distribution} takes two values, {arguments}")]
    Arguments { distribution: &'static str, arguments: &'static str },
    #[error("{what} must be positive, but is {value}")]
    Parameter { what: &'static str, value: f64 },
    #[error("all of it lies below zero, where there is no friction")]
    NoSupport,
    #[error("{name} is varied twice")]
    Twice { name: String },
    #[error("with it there are more than {limit} points")]
    TooMany { limit: u64 },
}

impl AxisProblem {
    /// The first fault of a value, without its place: the text that is meant is no text of a setting.
    pub(crate) fn of(faults: &Faults) -> Self {
        let hint = faults.sorted().first().map(|fault| Box::new(fault.kind.clone()));
        Self::Value { message: hint.as_ref().map_or_else(String::new, ToString::to_string), hint }
    }

    /// Returns a hint in the words of an interface, or `None` if there is nothing better to say than the
    /// message itself.
    pub fn hint_for(&self, face: &dyn Face) -> Option<String> {
        let hint = match self {
            Self::Malformed => "for instance `mu=0..0.8:801`, `mu=0.1,0.2,0.5` or `mu=normal(0.3, 0.05)`",
            Self::ThreeDots => "two dots stand between the ends of a range: FROM..TO",
            Self::NoCount => "write it after the range, for instance `mu=0..0.8:801`",
            Self::Spacing { .. } => "evenly spaced values are usual; `:log` spaces them logarithmically",
            Self::Empty { .. } => "for one value write NAME=VALUE",
            Self::NotPositive { .. } => "omit `:log`, or begin above zero",
            Self::WithoutSamples => {
                return Some(format!(
                    "say how many, for instance `{}`",
                    face.option_with("samples", "10000")
                ));
            }
            Self::GridWithSamples => {
                return Some(format!(
                    "omit the number of values: FROM..TO; without {} it is a grid",
                    face.option("samples")
                ));
            }
            Self::Value { hint, .. } => return hint.as_ref()?.hint_for(face),
            _ => return None,
        };
        Some(hint.to_owned())
    }
}
