//! Ranges that infinitely many solutions leave open.

use super::effort::kind;
use crate::units::{Unit, Units};
use serde::Serialize;

/// The least and the greatest value of a quantity over infinitely many solutions, each of which some solution has.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OpenRange {
    /// The contact, drive or coordinate.
    pub name: String,
    /// The unit of both values.
    pub unit: &'static str,
    /// The least value; null if it is unbounded.
    pub from: Option<f64>,
    /// The greatest value; null if it is unbounded.
    pub to: Option<f64>,
}

impl OpenRange {
    /// True if all solutions have the same value.
    pub fn is_one_value(&self) -> bool {
        self.from.is_some() && self.from == self.to
    }

    /// "25 to 50 N", "25 N or more", "any force".
    pub(crate) fn in_words(&self, units: &Units) -> String {
        let unit = units.of(self.unit);
        self.between(&unit, &|value| unit.number(value))
    }

    /// [`OpenRange::in_words`] with four significant digits, unless both ends then look alike.
    pub(crate) fn in_brief(&self, units: &Units) -> String {
        let unit = units.of(self.unit);
        let is_alike =
            self.from.map(|end| unit.brief_number(end)) == self.to.map(|end| unit.brief_number(end));
        if is_alike { self.in_words(units) } else { self.between(&unit, &|value| unit.brief_number(value)) }
    }

    fn between(&self, unit: &Unit, number: &dyn Fn(f64) -> String) -> String {
        match (self.from, self.to) {
            (Some(from), Some(to)) if from == to => unit.with(&number(from)),
            (Some(from), Some(to)) => format!("{} to {}", number(from), unit.with(&number(to))),
            (Some(from), None) => format!("{} or more", unit.with(&number(from))),
            (None, Some(to)) => format!("{} or less", unit.with(&number(to))),
            (None, None) => format!("any {}", kind(self.unit).unwrap_or("value")),
        }
    }
}

/// The quantities that infinitely many solutions leave open, and their ranges.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Undetermined {
    /// The joints whose share of a load is open.
    pub sharing: Vec<String>,
    /// The friction of contacts and hinges that stand still while the rest moves.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub friction: Vec<OpenRange>,
    /// The efforts of the drives.
    pub efforts: Vec<OpenRange>,
    /// The accelerations of the coordinates.
    pub accelerations: Vec<OpenRange>,
    /// The normal forces of the contacts.
    pub normal_forces: Vec<OpenRange>,
}

impl Undetermined {
    /// The cause in a few words: "how left, right share the load is undetermined".
    pub(crate) fn cause(&self) -> String {
        match self.sharing.as_slice() {
            [] if !self.friction.is_empty() => self.standing_in_words(),
            [] if self.normal_forces.iter().any(|range| range.from.is_none() || range.to.is_none()) => {
                "on the verge of jamming the forces are undetermined".to_owned()
            }
            [] => "forces are undetermined, since equations of this contact mode are dependent".to_owned(),
            joints => format!("how {} share the load is undetermined", joints.join(", ")),
        }
    }

    /// "friction at top, which does not slide, can have any value within its limits"
    fn standing_in_words(&self) -> String {
        let names: Vec<&str> = self.friction.iter().map(|range| range.name.as_str()).collect();
        let names = names.join(", ");
        let what = match self.friction.as_slice() {
            [only] if only.unit == "N m" => {
                format!("the friction couple of the hinge {names}, which does not turn,")
            }
            [_] => format!("friction at {names}, which does not slide,"),
            _ => format!("friction at {names}, which do not slide,"),
        };
        format!("{what} can have any value within its limits")
    }

    /// Advice that leads to one value; none if it is not known.
    pub(crate) fn advice(&self) -> Option<&'static str> {
        (!self.sharing.is_empty()).then_some("Give `stiffness` for one value.")
    }

    /// The ranges of what is open, a line for each kind of quantity.
    pub(crate) fn in_words(&self, units: &Units) -> Vec<String> {
        let line = |(what, ranges): (&str, &Vec<OpenRange>)| {
            let one = |range: &OpenRange| format!("{} {}", range.name, range.in_words(units));
            let open: Vec<String> = ranges.iter().filter(|range| !range.is_one_value()).map(one).collect();
            (!open.is_empty()).then(|| format!("{what}: {}.", open.join(", ")))
        };
        let kinds = [
            ("Friction", &self.friction),
            ("Efforts", &self.efforts),
            ("Accelerations", &self.accelerations),
            ("Normal forces", &self.normal_forces),
        ];
        kinds.into_iter().filter_map(line).collect()
    }
}
