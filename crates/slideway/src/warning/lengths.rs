//! Lengths that are perhaps typed in a wrong unit: numbers without one among others that have one, and lengths that
//! tower above all others.

use super::warning;
use crate::expression::{Dimension, Symbol};
use crate::fault::{Doubt, Fault, Place};
use crate::ids::FormulaId;
use crate::model::{BareNumber, Hinge, JointKind, Model};
use crate::report::number::number;
use crate::units::Unit;
use std::collections::BTreeSet;

/// Lengths of one model that differ by more than this factor hint at a wrong unit.
const FAR_APART: f64 = 1e4;
/// Lengths that exceed all others by this factor are, a thousandth of them, within a factor of ten of the greatest
/// other one: millimetres typed as metres.
const TOWERING: f64 = 1e3 / 10.0;

/// A length that was typed.
struct Length {
    /// Its magnitude (m).
    size: f64,
    formula: FormulaId,
    place: Place,
    /// Whether it has no unit.
    bare: bool,
}

/// Everything about the lengths of a model that is perhaps not meant.
pub(super) fn doubtful_lengths(model: &Model) -> Vec<Fault> {
    let bare = model.bare_numbers(Dimension::LENGTH);
    let unit = model.units.typed("m").filter(|unit| unit.scale() != 1.0);
    let mut found: Vec<Fault> = unit
        .iter()
        .flat_map(|unit| bare.iter().filter_map(|number| without_unit(model, number, unit)))
        .collect();
    let told: Vec<Place> =
        found.iter().chain(&model.doubts).filter_map(|fault| fault.place.clone()).collect();
    let lengths: Vec<Length> =
        typed(model, &bare).into_iter().filter(|length| !told.contains(&length.place)).collect();
    found.retain(|fault| !model.doubts.iter().any(|doubt| doubt.place == fault.place));
    let towering = towering(model, &lengths);
    if towering.is_empty() {
        found.extend(far_apart(model, &lengths));
    }
    found.extend(towering);
    found
}

/// A number without a unit among lengths that have one. A parameter has its own unit.
fn without_unit(model: &Model, number: &BareNumber, unit: &Unit) -> Option<Fault> {
    let parameter = model.parameters.iter().find(|parameter| parameter.value == number.formula);
    let unit = match parameter.and_then(|parameter| model.units.typed_parameter(&parameter.name)) {
        Some(own) => Some(own).filter(|own| own.scale() != 1.0)?,
        None => unit,
    };
    let what = name(model, number.formula);
    let what = if number.is_all { what } else { format!("the number in {what}") };
    let doubt = Doubt::BareNumber {
        what,
        value: number.value,
        si: unit.si().to_owned(),
        unit: unit.name().to_owned(),
    };
    Some(warning(doubt, number.place.clone()))
}

/// A formula by the name of its parameter, or by what it is.
fn name(model: &Model, formula: FormulaId) -> String {
    let parameter = model.parameters.iter().find(|parameter| parameter.value == formula);
    parameter.map_or_else(|| model.formula(formula).what.to_string(), |parameter| parameter.name.to_string())
}

/// The lengths that were typed, in ascending order. Corners of outlines may be as near to an axis as they like.
fn typed(model: &Model, bare: &[BareNumber]) -> Vec<Length> {
    let one = |id: FormulaId| {
        let formula = model.formula(id);
        let is_bare = bare.iter().any(|number| number.formula == id && number.is_all);
        let wanted = if is_bare { Some(Dimension::LENGTH) } else { formula.wanted };
        let size = formula.expression.only_number(Dimension::LENGTH, wanted)?.abs();
        (size > 0.0).then(|| Length { size, formula: id, place: formula.origin.place(), bare: is_bare })
    };
    let ids = (0..model.formulas.len()).map(FormulaId).filter(|id| model.looks.binary_search(id).is_err());
    let mut lengths: Vec<Length> = ids.filter_map(one).collect();
    lengths.sort_by(|one, other| one.size.total_cmp(&other.size));
    lengths
}

/// The few lengths that tower above all others, or those without a unit that tower above all that have one. Clearances
/// and pins are small by nature, ways that are travelled may be long.
fn towering(model: &Model, lengths: &[Length]) -> Vec<Fault> {
    let others = no_dimensions(model);
    let sizes: Vec<&Length> = lengths.iter().filter(|length| !others.contains(&length.formula)).collect();
    let factor = |at: usize| sizes[at].size / sizes[at - 1].size;
    let Some(gap) = (1..sizes.len()).max_by(|one, other| factor(*one).total_cmp(&factor(*other))) else {
        return Vec::new();
    };
    let (below, above) = sizes.split_at(gap);
    let all_bare = above.iter().all(|length| length.bare) && !below.iter().any(|length| length.bare);
    if factor(gap) <= TOWERING || !(above.len() < below.len() || all_bare) {
        return Vec::new();
    }
    let next = below[gap - 1];
    let one = |length: &&Length| {
        let doubt = Doubt::LengthTowers {
            what: name(model, length.formula),
            length: as_typed(model, length),
            factor: number(length.size / next.size),
            next: as_typed(model, next),
        };
        warning(doubt, length.place.clone())
    };
    above.iter().map(one).collect()
}

/// A length in the unit that it was typed in, as far as that is known.
fn as_typed(model: &Model, length: &Length) -> String {
    let parameter = model.parameters.iter().find(|parameter| parameter.value == length.formula);
    let own = parameter.and_then(|parameter| model.units.typed_parameter(&parameter.name));
    match own {
        _ if length.bare => Unit::si_unit("m").show(length.size),
        Some(unit) => unit.show(length.size),
        None => model.units.of("m").show(length.size),
    }
}

/// The formulas of lengths that are no dimensions of parts, with the parameters that they use: clearances, pins, ways
/// and positions.
fn no_dimensions(model: &Model) -> BTreeSet<FormulaId> {
    let of_contacts =
        model.contacts().flat_map(|contact| contact.play.into_iter().chain(contact.misalignment));
    let of_joints = model.joints.iter().flat_map(|joint| match &joint.kind {
        JointKind::Slider(slider) => slider.travel.into_iter().flatten().collect(),
        JointKind::Hinge(hinge) => of_pin(hinge),
    });
    let of_coordinates = model.coordinates.iter().flat_map(|one| one.value.into_iter().chain(one.drawn_at));
    let mut left: Vec<FormulaId> = of_contacts.chain(of_joints).chain(of_coordinates).collect();
    let mut found = BTreeSet::new();
    while let Some(id) = left.pop() {
        if !found.insert(id) {
            continue;
        }
        left.extend(model.formula(id).expression.symbols().filter_map(|(symbol, _)| match symbol {
            Symbol::Parameter(index) => Some(model.parameters[index].value),
            _ => None,
        }));
    }
    found
}

fn of_pin(hinge: &Hinge) -> Vec<FormulaId> {
    hinge.friction.iter().flat_map(|friction| friction.formulas()).collect()
}

/// Lengths of which the greatest is very many times the least; the place is that of the one which is out of line.
fn far_apart(model: &Model, lengths: &[Length]) -> Option<Fault> {
    let (least, greatest) = (lengths.first()?, lengths.last()?);
    let factor = greatest.size / least.size;
    if factor <= FAR_APART {
        return None;
    }
    let middle = lengths[lengths.len() / 2].size;
    let place = if middle / least.size > greatest.size / middle { &least.place } else { &greatest.place };
    let unit = model.units.of("m");
    let doubt = Doubt::LengthsFarApart {
        factor: number(factor),
        least: unit.show(least.size),
        greatest: unit.show(greatest.size),
    };
    Some(warning(doubt, place.clone()))
}
