//! Quantity to vary, and its range.

use super::varied::Varied;
use crate::expression::{TO, ends_of_range};
use crate::fault::{AxisProblem, Fault, FaultKind, Faults};
use crate::mechanism::MAGNITUDES;
use crate::model::{Model, Value};
use crate::solve::last_change;
use crate::units::Unit;
use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::str::FromStr;

/// Without a range a parameter goes from its value divided by this to its value multiplied by it.
const FACTOR_AROUND: f64 = 5.0;

/// Quantity to vary, and its range: a parameter, a coordinate, or all coefficients of friction together
/// ([`FRICTION`](super::FRICTION)).
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
    /// Varies the quantity of this name over its usual range.
    pub fn usual(name: &str) -> Self {
        Self { name: name.to_owned(), range: None }
    }

    /// Varies the quantity of this name from one value to another.
    pub fn between(name: &str, from: impl Into<Value>, to: impl Into<Value>) -> Self {
        Self { name: name.to_owned(), range: Some([from.into(), to.into()]) }
    }

    /// The ends of the range in SI units, the smaller one first in whichever order they are given.
    ///
    /// # Errors
    /// A range that is empty, too great to compute with, or one of coefficients of friction that
    /// begins below zero; whatever `usual` refuses where there is no range.
    pub(crate) fn ends(
        &self,
        varied: &Varied,
        usual: impl FnOnce() -> Result<[f64; 2], Faults>,
    ) -> Result<[f64; 2], Faults> {
        let Some([from, to]) = &self.range else {
            return usual().map_err(|faults| faults.in_argument(&self.name, |_| 0..self.name.len()));
        };
        let (what, fault) = (varied.in_words(), |kind| Faults::from(self.fault(kind)));
        let [first, second] = self.starts(from);
        let (from, to) = (self.end(varied, from, first)?, self.end(varied, to, second)?);
        if from.abs().max(to.abs()) > *MAGNITUDES.end() {
            return Err(fault(FaultKind::Overflow { quantity: format!("the range of {}", varied.name) }));
        }
        // Whoever begins with the greater end means the same range.
        let [from, to] = [from.min(to), from.max(to)];
        if from == to {
            return Err(fault(FaultKind::EmptyRange { what, from: varied.shown_in.show(from) }));
        }
        if from < 0.0 && varied.is_itself_friction() {
            let problem = AxisProblem::NegativeCoefficients { from, to: to.min(0.0) };
            return Err(fault(FaultKind::Axis { text: self.to_string(), problem }));
        }
        Ok([from, to])
    }

    /// It in a model.
    ///
    /// # Errors
    /// As [`Varied::new`].
    pub(crate) fn of(&self, model: &Model) -> Result<Varied, Faults> {
        self.placed(Varied::new(model, &self.name))
    }

    /// It in a model that is asked about rest.
    ///
    /// # Errors
    /// As [`Varied::at_rest`].
    pub(crate) fn at_rest(&self, model: &Model) -> Result<Varied, Faults> {
        self.placed(Varied::at_rest(model, &self.name))
    }

    fn placed(&self, varied: Result<Varied, Faults>) -> Result<Varied, Faults> {
        let varied =
            varied.map_err(|faults| faults.in_argument(&self.to_string(), |_| 0..self.name.len()))?;
        Ok(varied.given_by(&self.to_string()).typed_as(self.range.as_ref()))
    }

    /// A warning for each end without a unit of what the model has in another unit than that of the SI.
    pub fn warnings(&self, model: &Model) -> Faults {
        let mut found = Faults::default();
        let (Some([from, to]), Ok(varied)) = (&self.range, Varied::new(model, &self.name)) else {
            return found;
        };
        for (end, start) in [from, to].into_iter().zip(self.starts(from)) {
            let doubt = end.without_unit(&self.name, varied.typed_unit());
            let span = start..start + end.to_string().len();
            found.extend(
                doubt.map(|doubt| Fault::of_argument(FaultKind::Doubt(doubt), &self.to_string(), span)),
            );
        }
        found
    }

    /// Where both ends of the range, of which the first is this, begin in the text of the argument.
    fn starts(&self, from: &Value) -> [usize; 2] {
        let first = self.name.len() + 1;
        [first, first + from.to_string().len() + TO.len()]
    }

    /// A fault of the range.
    fn fault(&self, kind: FaultKind) -> Fault {
        let text = self.to_string();
        Fault::of_argument(kind, &text, (self.name.len() + 1).min(text.len())..text.len())
    }

    /// An end of the range, whose text begins at this byte of the argument.
    fn end(&self, varied: &Varied, value: &Value, start: usize) -> Result<f64, Faults> {
        let length = value.to_string().len();
        // The text of a setting is NAME=VALUE.
        let offset = start - (self.name.len() + 1);
        varied.value_of(value).map_err(|faults| {
            faults.in_argument(&self.to_string(), |place| match place {
                Some(place) => place.start + offset..place.end + offset,
                None => start..start + length,
            })
        })
    }
}

/// From "NAME" or "NAME=FROM..TO"; a number before an end with a unit has that unit, too.
impl FromStr for Vary {
    type Err = Faults;

    fn from_str(text: &str) -> Result<Self, Faults> {
        let Some((name, range)) = text.split_once('=') else { return Ok(Self::usual(text.trim())) };
        let name = name.trim();
        if let Ok(Some((from, to))) = ends_of_range(range)
            && !to.contains(':')
        {
            let (from, to) = (from.trim(), to.trim());
            // "200..800 mm": the unit is that of both.
            return Ok(match unit_after_number(to).filter(|_| from.parse::<f64>().is_ok()) {
                Some(unit) => Self::between(name, format!("{from} {unit}"), to),
                None => Self::between(name, from, to),
            });
        }
        let kind = FaultKind::MalformedRange { text: range.to_owned(), name: name.to_owned() };
        Err(Fault::of_argument(kind, text, text.len() - range.len()..text.len()).into())
    }
}

/// The unit behind a number: "mm" of "800 mm"; none where the text is no number with a unit.
fn unit_after_number(text: &str) -> Option<&str> {
    Unit::of_quantity(text)?;
    let begins = |&(at, _): &(usize, char)| text[..at].trim_end().parse::<f64>().is_ok();
    let (at, _) = text.char_indices().rfind(begins)?;
    Some(text[at..].trim()).filter(|unit| !unit.is_empty())
}

impl fmt::Display for Vary {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.range {
            None => formatter.write_str(&self.name),
            Some([from, to]) => write!(formatter, "{}={from}{TO}{to}", self.name),
        }
    }
}

/// A range around the value in the model; coordinates and values of zero need one. Angles, which are known by
/// their unit, have the quarter turn in which they stand: sines and cosines keep their signs there. Friction
/// has one from zero on, with the friction in it at which the number of solutions is known to change; kinetic friction
/// not beyond its static friction.
///
/// # Errors
/// A fault if a range is needed.
pub(crate) fn range_around(model: &Model, varied: &Varied) -> Result<[f64; 2], Faults> {
    let present = varied.present()?;
    if varied.is_friction_factor() {
        Ok(with_changes(model, varied, present, 2.0 * FACTOR_AROUND))
    } else if model.is_friction_coefficient(&varied.name) {
        let [least, greatest] = with_changes(model, varied, present, (2.0 * present).max(1.0));
        let most = model.friction_range(&varied.name).map_or(greatest, |[_, most]| most);
        Ok([least, greatest.min(most)])
    } else if varied.is_angle() && !varied.is_coordinate() {
        // Between two of them it has both. Adding zero turns -0 into 0.
        let quarters = present / FRAC_PI_2;
        Ok([(quarters - 1.0).ceil(), (quarters + 1.0).floor()].map(|quarters| quarters * FRAC_PI_2 + 0.0))
    } else if varied.is_coordinate() || present == 0.0 {
        Err(varied.range_needed())
    } else {
        let ends = [present / FACTOR_AROUND, present * FACTOR_AROUND];
        Ok(if present > 0.0 { ends } else { [ends[1], ends[0]] })
    }
}

/// The range from zero to this value of friction, or to twice that of the last known change if that lies
/// beyond.
fn with_changes(model: &Model, varied: &Varied, present: f64, usual: f64) -> [f64; 2] {
    let last = if varied.is_friction_factor() {
        last_change(model, None)
    } else if varied.is_itself_friction() {
        last_change(model, Some(present))
    } else {
        None
    };
    let known = last.map(|factor| factor * present).filter(|known| *known >= usual);
    [0.0, known.map_or(usual, |known| 2.0 * known)]
}
