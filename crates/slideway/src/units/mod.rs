//! The units in which numbers are shown to people: as they were typed, SI, or those of drawings in
//! millimetres.
//!
//! Everything is computed, and every report, JSON and table holds its numbers, in SI units. [`Units`] is made
//! once from what a model file says, travels with the mechanism and its reports, and gives the [`Unit`] in
//! which a quantity is shown: that in which most quantities of its kind were typed (of as many, the first);
//! of a parameter the one in which itself was typed; that of the SI where none was. Forces, moments and powers
//! that a report has computed may be of another size than what was typed: it shows them in another unit of
//! their kind that was typed, or in the SI unit, where they read better in it.
//!
//! ```
//! use slideway::{Model, gallery, units::UnitSystem};
//!
//! let model = Model::parse(&gallery::find("drawer").expect("in the gallery").text.replace("0.4 m", "400 mm"))?;
//! assert_eq!(model.units.parameter("L", "m").show(0.4), "400 mm");
//! assert_eq!(model.units.of("m").show(0.4), "0.4 m");
//! assert_eq!(model.with_units(UnitSystem::Millimetres).units.of("N m").show(0.4), "400 N mm");
//! # Ok::<(), slideway::Faults>(())
//! ```

pub(crate) mod number;
mod unit;

pub(crate) use number::brief;
pub use number::precise;
pub use unit::Unit;

use crate::choice::Choice;
use crate::expression::WrittenUnit;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// In which units numbers are shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum UnitSystem {
    /// As the model has them.
    #[default]
    #[serde(rename = "as-typed")]
    AsTyped,
    /// Those of the SI.
    #[serde(rename = "SI")]
    Si,
    /// Millimetres, degrees, newtons, and what follows from them.
    #[serde(rename = "mm")]
    Millimetres,
    /// Inches, degrees, pounds-force, pounds, and what follows from them.
    #[serde(rename = "in")]
    Inches,
}

impl Choice for UnitSystem {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (
            Self::AsTyped,
            "as-typed",
            "As the quantities of the model were typed; computed forces, moments and powers in a unit that suits them",
        ),
        (Self::Si, "SI", "Those of the SI"),
        (Self::Millimetres, "mm", "Millimetres, degrees, newtons, and what follows from them"),
        (Self::Inches, "in", "Inches, degrees, pounds-force, pounds, and what follows from them"),
    ];
}

/// The units in which numbers of a model are shown. A copy costs little.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Units {
    system: UnitSystem,
    typed: Arc<TypedUnits>,
    /// Instead of the unit in which most were typed, those that suit the values of a report.
    suited: Vec<Unit>,
}

/// Numbers from here on ...
const LEAST: f64 = 0.1;
/// ... to here read well: the range in which ISO 80000-1, clause 7.2 (and NIST SP 811, section 7.9) recommends to
/// choose prefixes.
const GREATEST: f64 = 1000.0;

/// The units that the quantities of a model were typed in.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct TypedUnits {
    /// Each with how many quantities were typed in it, in the order of their first use.
    counts: Vec<(Unit, usize)>,
    /// Those of the parameters that have one of their own.
    parameters: BTreeMap<String, Unit>,
}

impl TypedUnits {
    /// One more quantity was typed in this unit.
    pub(crate) fn add(&mut self, unit: Unit) {
        match self.counts.iter_mut().find(|(other, _)| *other == unit) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((unit, 1)),
        }
    }

    /// A parameter was typed in this unit.
    pub(crate) fn parameter(&mut self, name: &str, unit: Unit) {
        self.parameters.insert(name.to_owned(), unit);
    }

    /// The unit in which most quantities were typed that have this SI unit.
    fn most(&self, si: &str) -> Option<&Unit> {
        let of_kind = self.counts.iter().filter(|(unit, _)| unit.si() == si && !si.is_empty());
        // Of as many the first: `max_by_key` would give the last.
        of_kind.rev().max_by_key(|(_, count)| *count).map(|(unit, _)| unit)
    }

    /// The unit in place of that in which most were typed, if the greatest value does not read well in that one
    /// but does in this: another that was typed, or the SI unit if it is a smaller one.
    fn suiting(&self, si: &str, greatest: f64) -> Option<Unit> {
        let most = self.most(si).filter(|most| !reads_well(most, greatest))?;
        let typed = self.counts.iter().map(|(unit, _)| unit.clone()).filter(|unit| unit.si() == si);
        let smaller = (most.scale() > 1.0).then(|| Unit::si_unit(si));
        typed.chain(smaller).find(|unit| reads_well(unit, greatest))
    }
}

fn reads_well(unit: &Unit, size: f64) -> bool {
    (LEAST..=GREATEST).contains(&unit.number_of(size))
}

impl Units {
    pub(crate) fn new(system: UnitSystem, typed: TypedUnits) -> Self {
        Self { system, typed: Arc::new(typed), suited: Vec::new() }
    }

    /// Suits the units to a report in which these values stand, each with its SI unit: of each kind the
    /// greatest decides whether they read well in the unit that was typed.
    #[must_use]
    pub(crate) fn suited_to(mut self, values: impl IntoIterator<Item = (&'static str, f64)>) -> Self {
        let mut greatest: BTreeMap<&str, f64> = BTreeMap::new();
        for (si, value) in values {
            let known = greatest.entry(si).or_default();
            *known = known.max(value.abs());
        }
        self.suited = greatest.into_iter().filter_map(|(si, value)| self.typed.suiting(si, value)).collect();
        self
    }

    /// Suits the units to a picture that shows these values of one kind: takes the unit in which most of them
    /// read well, of the present one, the others that were typed and, if it is smaller, the SI unit; of as
    /// many the first of these.
    #[must_use]
    pub fn suited_to_most(mut self, si: &str, values: &[f64]) -> Self {
        let present = self.of(si);
        let typed = self.typed.counts.iter().map(|(unit, _)| unit.clone()).filter(|unit| unit.si() == si);
        let smaller = (present.scale() > 1.0).then(|| Unit::si_unit(si));
        let count = |unit: &Unit| values.iter().filter(|value| reads_well(unit, value.abs())).count();
        let units: Vec<Unit> = std::iter::once(present).chain(typed).chain(smaller).collect();
        // Of as many the first: `max_by_key` would give the last.
        if let Some(best) = units.into_iter().rev().max_by_key(count) {
            self.suited.retain(|unit| unit.si() != si);
            self.suited.push(best);
        }
        self
    }

    /// Returns the units in another system.
    #[must_use]
    pub fn in_system(&self, system: UnitSystem) -> Self {
        Self { system, ..self.clone() }
    }

    /// Returns the units with a parameter typed anew.
    #[must_use]
    pub(crate) fn with_parameter(mut self, name: &str, unit: Unit) -> Self {
        Arc::make_mut(&mut self.typed).parameter(name, unit);
        self
    }

    /// The unit in which quantities are shown whose SI unit has this name: "m", "rad", "N", "N m", "m/s", ...
    pub fn of(&self, si: &str) -> Unit {
        match self.system {
            UnitSystem::AsTyped => {
                let suited = self.suited.iter().find(|unit| unit.si() == si);
                suited.or_else(|| self.typed.most(si)).cloned().unwrap_or_else(|| Unit::si_unit(si))
            }
            UnitSystem::Si => Unit::si_unit(si),
            UnitSystem::Millimetres => millimetres(si),
            UnitSystem::Inches => inches(si),
        }
    }

    /// The unit in which rates are shown of quantities with this SI unit.
    pub fn of_rate(&self, si: &str) -> Unit {
        self.of(&format!("{si}/s"))
    }

    /// The unit in which a parameter is shown that has this SI unit.
    pub fn parameter(&self, name: &str, si: &str) -> Unit {
        match (self.typed.parameters.get(name), self.system) {
            (Some(unit), UnitSystem::AsTyped) => unit.clone(),
            (Some(unit), _) => self.of(unit.si()),
            (None, _) => self.of(si),
        }
    }

    /// The unit in which a quantity is shown that was typed in this one.
    pub(crate) fn typed_as(&self, unit: Unit) -> Unit {
        if self.system == UnitSystem::AsTyped { unit } else { self.of(unit.si()) }
    }

    /// The unit that a parameter was typed in.
    pub(crate) fn typed_parameter(&self, name: &str) -> Option<&Unit> {
        self.typed.parameters.get(name)
    }

    /// The unit in which most quantities with this SI unit were typed.
    pub(crate) fn typed(&self, si: &str) -> Option<Unit> {
        self.typed.most(si).cloned()
    }
}

/// The units that go with drawings in millimetres: a coherent system of mm, N and s, but angles in degrees.
fn millimetres(si: &str) -> Unit {
    let (name, numerator, denominator) = match si {
        "m" => ("mm", 1.0, 1e3),
        "rad" => return Unit::of_text("deg").expect("a unit of expressions"),
        "N m" => ("N mm", 1.0, 1e3),
        "m/s" => ("mm/s", 1.0, 1e3),
        "m/s^2" => ("mm/s^2", 1.0, 1e3),
        "kg m^2" => ("kg mm^2", 1.0, 1e6),
        "N/m" => ("N/mm", 1e3, 1.0),
        "N s/m" => ("N s/mm", 1e3, 1.0),
        "N m/rad" => ("N mm/rad", 1.0, 1e3),
        "N m s/rad" => ("N mm s/rad", 1.0, 1e3),
        "Pa" => ("MPa", 1e6, 1.0),
        _ => return Unit::si_unit(si),
    };
    Unit::new(name, si, [numerator, denominator])
}

/// The units of drawings in inches: in, lbf, lb and s, but angles in degrees, pressures in psi, powers in hp.
fn inches(si: &str) -> Unit {
    let name = match si {
        "m" => "in",
        "rad" => "deg",
        "kg" => "lb",
        "kg m^2" => "lb in^2",
        "N" => "lbf",
        "N m" | "J" => "lbf in",
        "m/s" => "in/s",
        "m/s^2" => "in/s^2",
        "N/m" => "lbf/in",
        "N s/m" => "lbf s/in",
        "N m/rad" => "lbf in/rad",
        "N m s/rad" => "lbf in s/rad",
        "Pa" => "psi",
        "W" => "hp",
        _ => return Unit::si_unit(si),
    };
    // Of a torque and an energy the unit is the same.
    Unit::of_text(name).map_or_else(|| Unit::si_unit(si), |unit| Unit::new(name, si, unit.in_si()))
}

impl From<&WrittenUnit> for Unit {
    fn from(written: &WrittenUnit) -> Self {
        let si = written.si();
        let in_si = written.in_si();
        // One of several names of an SI unit.
        let name = if in_si == [1.0, 1.0] && si != "1/s" { si.clone() } else { written.name() };
        Self::new(&name, &si, in_si)
    }
}

#[cfg(test)]
mod tests {
    use super::{TypedUnits, Unit, UnitSystem, Units};

    fn units(typed: &[&str]) -> Units {
        let mut list = TypedUnits::default();
        typed.iter().for_each(|text| list.add(Unit::of_text(text).expect("a unit")));
        Units::new(UnitSystem::AsTyped, list)
    }

    #[test]
    fn most_decide_and_of_as_many_the_first() {
        assert_eq!(units(&["mm", "m", "m"]).of("m").name(), "m");
        assert_eq!(units(&["cm", "m", "mm"]).of("m").name(), "cm");
        assert_eq!(units(&["cm", "mm", "mm", "cm"]).of("m").name(), "cm");
        assert_eq!(units(&[]).of("m").name(), "m");
    }

    #[test]
    fn computed_values_are_shown_where_they_read_well() {
        let shown = |typed: &[&str], value: f64| units(typed).suited_to([("N", value)]).of("N").show(value);
        // Within 0.1 and 1000 as most were typed.
        assert_eq!(shown(&["kN"], 100.0), "0.1 kN");
        assert_eq!(shown(&["kN"], -1e6), "-1000 kN");
        // Too small in it: the SI unit. Too great: a greater one only if it was typed.
        assert_eq!(shown(&["kN"], 5.9), "5.9 N");
        assert_eq!(shown(&["N"], 5900.0), "5900 N");
        assert_eq!(shown(&["N", "N", "kN"], -5900.0), "-5.9 kN");
        assert_eq!(shown(&["kN", "mN"], 0.0059), "5.9 mN");
        // Nowhere well, zero, and another system.
        assert_eq!(shown(&["kN"], 0.05), "5e-5 kN");
        assert_eq!(shown(&["kN"], 0.0), "0 kN");
        let si = units(&["kN"]).in_system(UnitSystem::Si).suited_to([("N", 5e3)]);
        assert_eq!(si.of("N").show(5e3), "5000 N");
        // Other kinds and parameters stay as they were typed.
        assert_eq!(units(&["kN", "mm"]).suited_to([("N", 5.9)]).of("m").name(), "mm");
    }

    #[test]
    fn pictures_have_the_unit_in_which_most_values_read_well() {
        let unit = |typed: &[&str], values: &[f64]| {
            units(typed).suited_to_most("N", values).of("N").name().to_owned()
        };
        assert_eq!(unit(&["kN"], &[1000.0, 52.3, 40.0, 7.8]), "N");
        assert_eq!(unit(&["kN"], &[12e3, 15e3, 7.8]), "kN");
        assert_eq!(unit(&["kN"], &[120.0, 150.0]), "kN", "of as many the present one");
        assert_eq!(unit(&["N", "N", "kN"], &[12e3, 15e3, 7.8]), "kN");
        assert_eq!(unit(&["N"], &[12e3]), "N", "what was not typed is no choice");
        assert_eq!(unit(&["kN"], &[]), "kN");
        let system = units(&["kN"]).in_system(UnitSystem::Millimetres).suited_to_most("N", &[12e3]);
        assert_eq!(system.of("N").name(), "N");
    }

    #[test]
    fn each_kind_has_its_own_unit() {
        let units = units(&["mm", "deg", "kN", "J", "N mm", "deg/s", "%", "rpm"]);
        let kinds = ["m", "rad", "N", "N m", "m/s", "rad/s", "rad/s^2", "", "1/s"];
        let shown = kinds.map(|si| units.of(si).name().to_owned());
        assert_eq!(shown, ["mm", "deg", "kN", "N mm", "m/s", "deg/s", "rad/s^2", "", "1/s"]);
    }

    #[test]
    fn several_names_of_an_si_unit_are_one() {
        assert_eq!(units(&["Nm", "N*m", "N mm"]).of("N m").name(), "N m");
    }

    #[test]
    fn systems_take_the_place_of_what_was_typed() {
        let typed = units(&["cm", "deg", "kN"]);
        let shown = |system| ["m", "rad", "N"].map(|si| typed.in_system(system).of(si).name().to_owned());
        assert_eq!(shown(UnitSystem::Inches), ["in", "deg", "lbf"]);
        assert_eq!(shown(UnitSystem::AsTyped), ["cm", "deg", "kN"]);
        assert_eq!(shown(UnitSystem::Si), ["m", "rad", "N"]);
        assert_eq!(shown(UnitSystem::Millimetres), ["mm", "deg", "N"]);
    }

    #[test]
    fn a_parameter_has_the_unit_it_was_typed_in() {
        let mut list = TypedUnits::default();
        list.add(Unit::of_text("m").expect("a unit"));
        list.parameter("l", Unit::of_text("mm").expect("a unit"));
        list.parameter("phi", Unit::of_text("deg").expect("a unit"));
        let units = Units::new(UnitSystem::AsTyped, list);
        assert_eq!(units.parameter("l", "m").show(0.4), "400 mm");
        assert_eq!(units.parameter("phi", "").name(), "deg");
        assert_eq!(units.parameter("other", "m").show(0.4), "0.4 m");
        assert_eq!(units.in_system(UnitSystem::Si).parameter("phi", "").name(), "rad");
    }

    #[test]
    fn decimal_units_are_exact() {
        let millimetre = Unit::of_text("mm").expect("a unit");
        for thousandths in 1..2000 {
            let value = f64::from(thousandths) / 1000.0;
            assert_eq!(millimetre.show(value), format!("{thousandths} mm"));
            assert_eq!(millimetre.precise(value), format!("{thousandths} mm"));
        }
    }
}
