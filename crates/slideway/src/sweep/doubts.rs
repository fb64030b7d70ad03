//! Numbers without a unit on the axes of a sweep.

use super::options::{GridValues, SampledValues, SweepPoints};
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::Varied;
use crate::model::{Model, Value};

impl SweepPoints {
    /// A warning for each value without a unit of what the model has in another unit than that of the SI.
    pub fn warnings(&self, model: &Model) -> Faults {
        let mut found = Faults::default();
        match self {
            Self::Grid(axes) => axes.iter().for_each(|axis| {
                found.append(of_axis(model, (&axis.name, &axis.to_string()), &on_grid(&axis.values)));
            }),
            Self::Samples(_, axes) => axes.iter().for_each(|axis| {
                found.append(of_axis(model, (&axis.name, &axis.to_string()), &of_samples(&axis.values)));
            }),
        }
        found
    }
}

/// The values of a grid as they were given, in the order of their text.
fn on_grid(values: &GridValues) -> Vec<&Value> {
    match values {
        GridValues::Linear { from, to, .. } | GridValues::Logarithmic { from, to, .. } => vec![from, to],
        GridValues::Listed(list) => list.iter().collect(),
    }
}

/// The values of a distribution, likewise.
fn of_samples(values: &SampledValues) -> Vec<&Value> {
    match values {
        SampledValues::Range { from, to } | SampledValues::Uniform { from, to } => vec![from, to],
        SampledValues::Normal { mean, deviation } => vec![mean, deviation],
        SampledValues::LogNormal { median, .. } => vec![median],
    }
}

fn of_axis(model: &Model, (name, text): (&str, &str), values: &[&Value]) -> Faults {
    let mut found = Faults::default();
    let unit = Varied::new(model, name).ok().and_then(|varied| varied.typed_unit());
    let mut end = name.len() + 1;
    for value in values {
        let written = value.to_string();
        let start = text[end..].find(&written).map_or(end, |place| end + place);
        end = start + written.len();
        let doubt = value.without_unit(name, unit.clone());
        found.extend(doubt.map(|doubt| Fault::of_argument(FaultKind::Doubt(doubt), text, start..end)));
    }
    found
}
