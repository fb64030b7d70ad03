//! Quantity and range of a sweep over one quantity, for plots.

use super::{Sweep, Values};
use crate::limits::Varied;
use crate::units::{Unit, Units};

/// The quantity of a sweep over one, and its ascending values.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// The least and the greatest value, in SI units.
    pub range: [f64; 2],
    /// Its value in the model, if it is known.
    pub value: Option<f64>,
    /// The unit in which values are to be shown: that of both ends of the range, as written, else that of the
    /// model.
    pub shown_in: Unit,
    /// The units in which other quantities are to be shown.
    pub units: Units,
    /// Whether the logarithms of its values are evenly spaced.
    pub logarithmic: bool,
}

impl Sweep {
    /// Returns the quantity and the range of a sweep over one quantity. Returns `None` with samples, several
    /// quantities, a single value, or values in another order than the ascending one: what lies between two
    /// points is then not the line between them.
    pub fn line(&self) -> Option<Line> {
        let ([axis], None) = (&self.axes[..], self.samples) else { return None };
        let range = match &axis.values {
            Values::Listed(values) if values.is_sorted() => [*values.first()?, *values.last()?],
            Values::Listed(_) => return None,
            values => values.range()?,
        };
        let model = &self.plan.model;
        let varied = Varied::new(model, &axis.quantity.name).ok();
        let value = varied.as_ref().and_then(|varied| varied.present().ok());
        let shown_in = varied.map(|varied| varied.typed_as(axis.given.as_ref()).shown_in);
        let shown_in = shown_in.unwrap_or_else(|| model.units.of(axis.quantity.unit(model)));
        let logarithmic = matches!(axis.values, Values::Logarithmic { .. });
        let (name, units) = (axis.quantity.name.clone(), model.units.clone());
        (range[0] < range[1]).then_some(Line { name, range, value, shown_in, units, logarithmic })
    }
}
