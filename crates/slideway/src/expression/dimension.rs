//! Physical dimensions: what a quantity measures, whatever its unit.

use std::fmt;

/// Exponents of length, mass and time of a quantity; an angle has none of them.
///
/// Displayed with the name a person would use, or in SI base units where there is none.
///
/// ```
/// use slideway::expression::Dimension;
///
/// assert_eq!(Dimension::FORCE.to_string(), "a force");
/// assert_eq!(Dimension { length: 3, mass: 0, time: -1 }.to_string(), "m^3/s");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of length (metre).
    pub length: i8,
    /// Exponent of mass (kilogram).
    pub mass: i8,
    /// Exponent of time (second).
    pub time: i8,
}

impl Dimension {
    /// A pure number.
    pub const NONE: Self = Self::of(0, 0, 0);
    /// An angle, measured in radian: a pure number.
    pub const ANGLE: Self = Self::NONE;
    /// m
    pub const LENGTH: Self = Self::of(1, 0, 0);
    /// m²
    pub const AREA: Self = Self::of(2, 0, 0);
    /// kg
    pub const MASS: Self = Self::of(0, 1, 0);
    /// s
    pub const TIME: Self = Self::of(0, 0, 1);
    /// 1/s
    pub const FREQUENCY: Self = Self::of(0, 0, -1);
    /// rad/s
    pub const ANGULAR_VELOCITY: Self = Self::FREQUENCY;
    /// rad/s²
    pub const ANGULAR_ACCELERATION: Self = Self::of(0, 0, -2);
    /// m/s
    pub const VELOCITY: Self = Self::of(1, 0, -1);
    /// m/s²
    pub const ACCELERATION: Self = Self::of(1, 0, -2);
    /// N = kg m/s²
    pub const FORCE: Self = Self::of(1, 1, -2);
    /// N m; an energy has the same dimension.
    pub const TORQUE: Self = Self::of(2, 1, -2);
    /// kg m²
    pub const MOMENT_OF_INERTIA: Self = Self::of(2, 1, 0);
    /// Pa = N/m²
    pub const PRESSURE: Self = Self::of(-1, 1, -2);
    /// W = N m/s
    pub const POWER: Self = Self::of(2, 1, -3);
    /// N/m
    pub const STIFFNESS: Self = Self::of(0, 1, -2);
    /// N s/m
    pub const DAMPING: Self = Self::of(0, 1, -1);
    /// N m/rad
    pub const TORSIONAL_STIFFNESS: Self = Self::TORQUE;
    /// N m s/rad
    pub const TORSIONAL_DAMPING: Self = Self::of(2, 1, -1);

    const fn of(length: i8, mass: i8, time: i8) -> Self {
        Self { length, mass, time }
    }

    /// The dimension of a product of two quantities; `None` when an exponent leaves the range of `i8`.
    ///
    /// ```
    /// use slideway::expression::Dimension;
    ///
    /// assert_eq!(Dimension::STIFFNESS.times(Dimension::LENGTH), Some(Dimension::FORCE));
    /// ```
    pub fn times(self, other: Self) -> Option<Self> {
        self.combine(other, i8::checked_add)
    }

    /// The dimension of a quotient of two quantities; `None` when an exponent leaves the range of `i8`.
    ///
    /// ```
    /// use slideway::expression::Dimension;
    ///
    /// assert_eq!(Dimension::LENGTH.per(Dimension::TIME), Some(Dimension::VELOCITY));
    /// ```
    pub fn per(self, other: Self) -> Option<Self> {
        self.combine(other, i8::checked_sub)
    }

    /// The dimension of the power `exponent`; `None` when an exponent leaves the range of `i8`.
    ///
    /// ```
    /// use slideway::expression::Dimension;
    ///
    /// assert_eq!(Dimension::TIME.power(-1), Some(Dimension::FREQUENCY));
    /// ```
    pub fn power(self, exponent: i8) -> Option<Self> {
        self.combine(Self::of(exponent, exponent, exponent), i8::checked_mul)
    }

    /// The dimension of the square root; `None` when an exponent is odd.
    ///
    /// ```
    /// use slideway::expression::Dimension;
    ///
    /// assert_eq!(Dimension::AREA.root(), Some(Dimension::LENGTH));
    /// assert_eq!(Dimension::LENGTH.root(), None);
    /// ```
    pub fn root(self) -> Option<Self> {
        let even = [self.length, self.mass, self.time].iter().all(|exponent| exponent % 2 == 0);
        even.then(|| Self::of(self.length / 2, self.mass / 2, self.time / 2))
    }

    fn combine(self, other: Self, exponent: impl Fn(i8, i8) -> Option<i8>) -> Option<Self> {
        Some(Self {
            length: exponent(self.length, other.length)?,
            mass: exponent(self.mass, other.mass)?,
            time: exponent(self.time, other.time)?,
        })
    }

    /// The product of powers of kg, m and s.
    fn powers(self) -> String {
        let powers = [("kg", self.mass), ("m", self.length), ("s", self.time)];
        let above: Vec<String> = powers.iter().filter(|power| power.1 > 0).map(written).collect();
        let below: Vec<String> = powers.iter().filter(|power| power.1 < 0).map(written).collect();
        let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
        match below.as_slice() {
            [] => above,
            [factor] => format!("{above}/{factor}"),
            factors => format!("{above}/({})", factors.join(" ")),
        }
    }

    /// The coherent SI unit, empty for pure numbers and angles.
    ///
    /// ```
    /// use slideway::expression::Dimension;
    /// assert_eq!(Dimension::TORQUE.unit(), "N m");
    /// assert_eq!(Dimension::ACCELERATION.unit(), "m/s^2");
    /// ```
    pub fn unit(self) -> String {
        let named = match self {
            Self::NONE => "",
            Self::FORCE => "N",
            Self::TORQUE => "N m",
            Self::STIFFNESS => "N/m",
            Self::DAMPING => "N s/m",
            Self::PRESSURE => "Pa",
            Self::POWER => "W",
            _ => return self.powers(),
        };
        named.to_owned()
    }

    fn common_name(self) -> Option<&'static str> {
        Some(match self {
            Self::NONE => "an angle or pure number",
            Self::LENGTH => "a length",
            Self::AREA => "an area",
            Self::MASS => "a mass",
            Self::TIME => "a time",
            Self::FREQUENCY => "an angular velocity or frequency",
            Self::ANGULAR_ACCELERATION => "an angular acceleration",
            Self::VELOCITY => "a velocity",
            Self::ACCELERATION => "an acceleration",
            Self::FORCE => "a force",
            Self::TORQUE => "a torque or energy",
            Self::MOMENT_OF_INERTIA => "a moment of inertia",
            Self::PRESSURE => "a pressure",
            Self::POWER => "a power",
            Self::STIFFNESS => "a stiffness",
            Self::DAMPING => "a damping coefficient",
            _ => return None,
        })
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = self.common_name() {
            return formatter.write_str(name);
        }
        formatter.write_str(&self.powers())
    }
}

fn written((unit, exponent): &(&str, i8)) -> String {
    match exponent.unsigned_abs() {
        1 => (*unit).to_owned(),
        size => format!("{unit}^{size}"),
    }
}

/// Dimension of an expression or of a name in it, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inferred {
    /// Nothing: whatever a name given as a bare number takes part in could be meant in any dimension.
    Any,
    /// A number written without a unit: neutral in products, takes the dimension of the other side in sums.
    Number,
    /// This dimension.
    Known(Dimension),
}

impl Inferred {
    /// Whether a value so inferred can stand where `wanted` is asked for.
    ///
    /// Numbers without a unit are SI values and fit everywhere; a known dimension fits only itself.
    ///
    /// ```
    /// use slideway::expression::{Dimension, Inferred};
    ///
    /// assert!(Inferred::Number.fits(Dimension::LENGTH));
    /// assert!(!Inferred::Known(Dimension::MASS).fits(Dimension::LENGTH));
    /// ```
    pub fn fits(self, wanted: Dimension) -> bool {
        match self {
            Self::Any | Self::Number => true,
            Self::Known(dimension) => dimension == wanted,
        }
    }
}
