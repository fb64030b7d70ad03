//! The units a number in an expression may carry.

use std::f64::consts::PI;

use super::dimension::Dimension;
use super::fault::ExpressionFaultKind;
use crate::interval::{Interval, Real};

/// A unit: its value in SI is `numerator / denominator`.
///
/// The two are kept apart because both are exact for decimal units: `35 mm` is then the number nearest to
/// 0.035.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) name: &'static str,
    pub(super) numerator: f64,
    pub(super) denominator: f64,
    pub(super) dimension: Dimension,
}

const fn unit(name: &'static str, numerator: f64, denominator: f64, dimension: Dimension) -> Unit {
    Unit { name, numerator, denominator, dimension }
}

/// No tonne: `t` is time in every expression. `µ` is in Unicode twice, as micro sign and as Greek letter.
///
/// US customary units are exact, too (NIST SP 811, appendix B): the inch is 25.4 mm and the international avoirdupois
/// pound 0.45359237 kg by the agreement of 1959, an ounce 1/16 pound; the pound-force, the kilogram-force and the
/// ounce-force are the weights of their masses at the standard acceleration of free fall, 9.80665 m/s^2 (3rd CGPM, 1901);
/// the mechanical horsepower is 550 ft lbf/s, whose 17 digits are the only ones here that are rounded.
pub(super) const UNITS: &[Unit] = &[
    unit("m", 1.0, 1.0, Dimension::LENGTH),
    unit("dm", 1.0, 10.0, Dimension::LENGTH),
    unit("cm", 1.0, 100.0, Dimension::LENGTH),
    unit("mm", 1.0, 1e3, Dimension::LENGTH),
    unit("um", 1.0, 1e6, Dimension::LENGTH),
    unit("\u{b5}m", 1.0, 1e6, Dimension::LENGTH),
    unit("\u{3bc}m", 1.0, 1e6, Dimension::LENGTH),
    unit("km", 1e3, 1.0, Dimension::LENGTH),
    unit("in", 127.0, 5000.0, Dimension::LENGTH),
    unit("ft", 381.0, 1250.0, Dimension::LENGTH),
    unit("kg", 1.0, 1.0, Dimension::MASS),
    unit("g", 1.0, 1e3, Dimension::MASS),
    unit("mg", 1.0, 1e6, Dimension::MASS),
    unit("Mg", 1e3, 1.0, Dimension::MASS),
    unit("lb", 45_359_237.0, 1e8, Dimension::MASS),
    unit("oz", 45_359_237.0, 16e8, Dimension::MASS),
    unit("s", 1.0, 1.0, Dimension::TIME),
    unit("ms", 1.0, 1e3, Dimension::TIME),
    unit("min", 60.0, 1.0, Dimension::TIME),
    unit("N", 1.0, 1.0, Dimension::FORCE),
    unit("mN", 1.0, 1e3, Dimension::FORCE),
    unit("kN", 1e3, 1.0, Dimension::FORCE),
    unit("MN", 1e6, 1.0, Dimension::FORCE),
    unit("lbf", 44_482_216_152_605.0, 1e13, Dimension::FORCE),
    unit("ozf", 44_482_216_152_605.0, 16e13, Dimension::FORCE),
    unit("kgf", 980_665.0, 1e5, Dimension::FORCE),
    unit("Nm", 1.0, 1.0, Dimension::TORQUE),
    unit("kNm", 1e3, 1.0, Dimension::TORQUE),
    unit("J", 1.0, 1.0, Dimension::TORQUE),
    unit("kJ", 1e3, 1.0, Dimension::TORQUE),
    unit("W", 1.0, 1.0, Dimension::POWER),
    unit("kW", 1e3, 1.0, Dimension::POWER),
    unit("hp", 745.699_871_582_270_2, 1.0, Dimension::POWER),
    unit("Pa", 1.0, 1.0, Dimension::PRESSURE),
    unit("kPa", 1e3, 1.0, Dimension::PRESSURE),
    unit("MPa", 1e6, 1.0, Dimension::PRESSURE),
    unit("GPa", 1e9, 1.0, Dimension::PRESSURE),
    unit("psi", 44_482_216_152_605.0, 6_451_600_000.0, Dimension::PRESSURE),
    unit("rad", 1.0, 1.0, Dimension::ANGLE),
    unit("mrad", 1.0, 1e3, Dimension::ANGLE),
    unit("deg", PI / 180.0, 1.0, Dimension::ANGLE),
    unit("\u{b0}", PI / 180.0, 1.0, Dimension::ANGLE),
    unit("%", 1.0, 100.0, Dimension::NONE),
    unit("Hz", 1.0, 1.0, Dimension::FREQUENCY),
    unit("rpm", PI / 30.0, 1.0, Dimension::ANGULAR_VELOCITY),
];

impl Unit {
    /// Where the numerator lies: it is a whole number, a fraction of pi that is rounded twice, or rounded once.
    fn enclosed_numerator(&self) -> Interval {
        let value = self.numerator;
        if value.fract() == 0.0 {
            return Interval::point(value);
        }
        Interval::around(value, 2.0 * f64::EPSILON * value)
    }
}

pub(super) fn find(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.name == name)
}

/// A product of powers of units, built factor by factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    numerator: f64,
    denominator: f64,
    /// Where numerator and denominator lie.
    enclosures: [Interval; 2],
    dimension: Dimension,
}

impl Scale {
    pub(super) const ONE: Self =
        Self { numerator: 1.0, denominator: 1.0, enclosures: [Interval::ONE; 2], dimension: Dimension::NONE };

    /// This scale times `unit^exponent`; the fault is that the dimension or the factor leaves its range.
    pub(super) fn times(self, unit: &Unit, exponent: i8) -> Result<Self, ExpressionFaultKind> {
        let power = i32::from(exponent).abs();
        let (over, under) = (unit.numerator.powi(power), unit.denominator.powi(power));
        let (over, under) = if exponent < 0 { (under, over) } else { (over, under) };
        let mut enclosed = [unit.enclosed_numerator(), Interval::point(unit.denominator)]
            .map(|part| part.power(Interval::point(f64::from(power))));
        if exponent < 0 {
            enclosed.swap(0, 1);
        }
        let factor = unit.dimension.power(exponent);
        let dimension = factor.and_then(|factor| self.dimension.times(factor));
        let scale = Self {
            numerator: self.numerator * over,
            denominator: self.denominator * under,
            enclosures: [self.enclosures[0] * enclosed[0], self.enclosures[1] * enclosed[1]],
            dimension: dimension.ok_or(ExpressionFaultKind::DimensionTooLarge)?,
        };
        if scale.numerator.is_finite() && scale.denominator.is_finite() {
            Ok(scale)
        } else {
            Err(ExpressionFaultKind::NumberTooLarge)
        }
    }

    /// The SI value of `number` in this unit, possibly infinite.
    pub(super) fn in_si(self, number: f64) -> f64 {
        number * self.numerator / self.denominator
    }

    /// Where the SI value lies of a number in this unit that lies in `number`.
    pub(super) fn enclosed_in_si(self, number: Interval) -> Interval {
        number * self.enclosures[0] / self.enclosures[1]
    }

    pub(super) fn dimension(self) -> Dimension {
        self.dimension
    }
}

/// A unit as it stands behind a number: a product of powers of units.
#[derive(Clone, Debug)]
pub(crate) struct WrittenUnit {
    pub(super) scale: Scale,
    factors: Vec<(&'static Unit, i8)>,
}

impl WrittenUnit {
    /// The unit of a pure number.
    pub(super) const NONE: Self = Self { scale: Scale::ONE, factors: Vec::new() };

    /// Whether there is no unit.
    pub(super) fn is_none(&self) -> bool {
        self.factors.is_empty()
    }

    /// This unit times `unit^exponent`; faults as those of [`Scale::times`].
    pub(super) fn times(mut self, unit: &'static Unit, exponent: i8) -> Result<Self, ExpressionFaultKind> {
        self.factors.push((unit, exponent));
        Ok(Self { scale: self.scale.times(unit, exponent)?, ..self })
    }

    /// Its name in one way of writing: "N m", "m/s^2".
    pub(crate) fn name(&self) -> String {
        let mut name = String::new();
        for (unit, exponent) in &self.factors {
            let joint = match (name.is_empty(), *exponent < 0) {
                (true, false) => "",
                (true, true) => "1/",
                (false, false) => " ",
                (false, true) => "/",
            };
            let power = match exponent.unsigned_abs() {
                1 => String::new(),
                power => format!("^{power}"),
            };
            let unit = if unit.name == "\u{b0}" { "deg" } else { unit.name };
            name.extend([joint, unit, &power]);
        }
        name
    }

    /// Its value in SI units, as a quotient of numbers that are exact for decimal units.
    pub(crate) fn in_si(&self) -> [f64; 2] {
        [self.scale.numerator, self.scale.denominator]
    }

    /// Returns the dimension of the quantities that it measures.
    pub(crate) fn dimension(&self) -> Dimension {
        self.scale.dimension
    }

    /// Returns the SI unit of which it is a multiple. Angles, which have no dimension, are distinguished from
    /// pure numbers, and energies from torques.
    pub(crate) fn si(&self) -> String {
        let exponent = |is: fn(&Unit) -> bool| -> i8 {
            self.factors.iter().filter(|(unit, _)| is(unit)).map(|(_, exponent)| *exponent).sum()
        };
        let angle = exponent(|unit| matches!(unit.name, "rad" | "mrad" | "deg" | "\u{b0}" | "rpm"));
        let energy = exponent(|unit| matches!(unit.name, "J" | "kJ"));
        let name = match (self.dimension(), angle) {
            (Dimension::ANGLE, 1) => "rad",
            (Dimension::ANGULAR_VELOCITY, 1) => "rad/s",
            (Dimension::ANGULAR_ACCELERATION, 1) => "rad/s^2",
            (Dimension::TORSIONAL_STIFFNESS, -1) => "N m/rad",
            (Dimension::TORSIONAL_DAMPING, -1) => "N m s/rad",
            (Dimension::TORQUE, 0) if energy == 1 => "J",
            (dimension, _) => return dimension.unit(),
        };
        name.to_owned()
    }
}
