//! The quantities that can be changed in a model, and between which ends a slider moves them.
//!
//! The ends are a matter of the page, not of mechanics: a user who wants others types them, or the value
//! itself.

use serde::Serialize;
use slideway::check::CoordinateSummary;
use slideway::expression::Symbol;
use slideway::fault::{Faults, Source};
use slideway::mechanism::{JointKind, Mechanism};
use slideway::model::{Coordinate, CoordinateKind, Model};
use slideway::printable::line;
use slideway::units::Unit;
use std::f64::consts::FRAC_PI_2;

/// At most so many parameters have a slider.
pub(crate) const MOST: usize = 300;
/// A positive parameter goes from this part of its value to this multiple.
const AROUND: [f64; 2] = [0.2, 2.0];
/// A coefficient of friction goes from zero at least to this, as far as static friction beside kinetic friction allows.
const FRICTION: f64 = 1.0;
/// A displacement without limits of travel goes as far as this part of the mechanism to both sides.
const SLIDE: f64 = 0.5;

/// Something that can be changed.
#[derive(Debug, Serialize)]
pub(crate) struct Quantity {
    /// "parameter", "position" or "rate", as in settings.
    kind: &'static str,
    name: String,
    /// The comment behind it in the file, or what it means that it grows.
    meaning: Option<String>,
    /// The unit in which everything here is, and in which a value is typed; may be empty.
    unit: String,
    /// The size of that unit in SI units.
    scale: f64,
    value: f64,
    /// The ends of its slider.
    from: f64,
    to: f64,
    /// Whether it is computed from other parameters.
    is_computed: bool,
    /// Whether it is a coefficient of friction, or one is computed from it; at rest a kinetic one beside a static one is none.
    is_friction: bool,
}

/// The first parameters, the coordinates, and the rates of those that can move, in the order of the file.
///
/// Meaning, unit, and the ends of a parameter's slider are those of the model as it is in the file, whatever is set: a
/// slider that is dragged stays the same slider. `is_at_rest`: whether rest is the question.
///
/// # Errors
/// Parameters without a value that is allowed.
pub(crate) fn quantities(
    file: &Model,
    model: &Model,
    (text, is_at_rest): (&str, bool),
    mechanism: &Mechanism,
    state: &[CoordinateSummary],
) -> Result<Vec<Quantity>, Faults> {
    let values = model.parameter_values(&model.constants()?);
    let values_in_file =
        file.constants().map_or_else(|_| values.clone(), |known| file.parameter_values(&known));
    let parameters = file.parameters.iter().zip(values_in_file.into_iter().zip(values)).take(MOST);
    let mut all: Vec<Quantity> = parameters
        .map(|(parameter, values)| of_parameter(file, (text, is_at_rest), parameter, values))
        .collect();
    let size = mechanism.size;
    for (index, coordinate) in file.coordinates.iter().enumerate() {
        let Some(state) = state.get(index) else { continue };
        all.push(of_position(file, mechanism, coordinate, state, size));
        all.push(of_rate(file, state, size));
    }
    Ok(all)
}

impl Quantity {
    fn new(kind: &'static str, name: &str, unit: &Unit, value: f64, [from, to]: [f64; 2]) -> Self {
        Self {
            kind,
            name: name.to_owned(),
            meaning: None,
            unit: unit.name().to_owned(),
            scale: unit.scale(),
            value: unit.number_of(value),
            from: unit.number_of(from),
            to: unit.number_of(to),
            is_computed: false,
            is_friction: false,
        }
    }
}

/// A parameter of the model in the file, with its value there and its present one.
fn of_parameter(
    file: &Model,
    (text, is_at_rest): (&str, bool),
    parameter: &slideway::model::Parameter,
    (in_file, value): (f64, f64),
) -> Quantity {
    let si = file.parameter_unit(&parameter.name);
    let unit = file.units.parameter(&parameter.name, &si);
    let allowed = file.friction_range(&parameter.name);
    let is_friction = match allowed.filter(|_| is_at_rest) {
        Some([_, greatest]) => greatest == f64::INFINITY,
        None => file.is_friction_coefficient(&parameter.name),
    };
    let formula = &file.formulas[parameter.value.index()];
    let is_computed = formula.expression.symbols().any(|(symbol, _)| matches!(symbol, Symbol::Parameter(_)));
    let ends = if is_friction && si.is_empty() && in_file >= 0.0 {
        [0.0, FRICTION.max(AROUND[1] * in_file)]
    } else if si == "rad" {
        [in_file - FRAC_PI_2, in_file + FRAC_PI_2]
    } else if in_file == 0.0 {
        [-unit.scale(), unit.scale()]
    } else if in_file > 0.0 {
        AROUND.map(|part| part * in_file)
    } else {
        [AROUND[1] * in_file, -AROUND[1] * in_file]
    };
    let ends = allowed.map_or(ends, |[least, greatest]| [ends[0].max(least), ends[1].min(greatest)]);
    let meaning = match formula.origin.source {
        Source::Model => comment(text, formula.origin.span.end),
        _ => None,
    };
    Quantity {
        meaning,
        is_computed,
        is_friction,
        ..Quantity::new("parameter", &parameter.name, &unit, value, ends)
    }
}

/// The comment behind this byte, at the end of its line.
fn comment(text: &str, end: usize) -> Option<String> {
    let rest = text.get(end..)?.lines().next()?;
    let comment = rest.trim_start().strip_prefix('#')?.trim();
    (!comment.is_empty()).then(|| line(comment).into_owned())
}

fn of_position(
    file: &Model,
    mechanism: &Mechanism,
    coordinate: &Coordinate,
    state: &CoordinateSummary,
    size: f64,
) -> Quantity {
    let around = |reach: f64| [state.value - reach, state.value + reach];
    let ends = match coordinate.kind {
        CoordinateKind::Rotation { .. } => around(FRAC_PI_2),
        CoordinateKind::Slide(joint) => travel(mechanism, joint).unwrap_or(around(SLIDE * size)),
        _ => around(SLIDE * size),
    };
    let meaning = Some(state.positive.clone());
    Quantity {
        meaning,
        ..Quantity::new("position", &state.name, &file.units.of(state.unit), state.value, ends)
    }
}

/// The limits of travel of a sliding joint.
fn travel(mechanism: &Mechanism, joint: slideway::ids::JointId) -> Option<[f64; 2]> {
    match &mechanism.joints.get(joint.index())?.kind {
        JointKind::Slider(slider) => slider.travel,
        JointKind::Hinge(_) => None,
    }
}

fn of_rate(file: &Model, state: &CoordinateSummary, size: f64) -> Quantity {
    let usual = if state.unit == "rad" { 1.0 } else { size };
    let reach = if state.rate == 0.0 { usual } else { AROUND[1] * state.rate.abs() };
    Quantity::new("rate", &state.name, &file.units.of_rate(state.unit), state.rate, [-reach, reach])
}
