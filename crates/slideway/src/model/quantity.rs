//! The kinds of value that a model file holds: names, quantities, places, directions, each with its place.

use super::Value;
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::ops::Range;
use toml::Spanned;

/// Byte range in the text of a model file.
pub(super) type Span = Range<usize>;

/// A name or other text, with its place.
#[derive(Debug, Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) span: Span,
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = Spanned::<String>::deserialize(deserializer)?;
        Ok(Self { span: spanned.span(), text: spanned.into_inner() })
    }
}

/// A quantity as it is written, with its place.
#[derive(Debug, Clone)]
pub(super) struct Quantity {
    pub(super) written: Value,
    pub(super) span: Span,
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ValueVisitor;
        impl Visitor<'_> for ValueVisitor {
            type Value = Value;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a number or a text with a unit or an expression")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Value, E> {
                Ok(Value::Number(value))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Value, E> {
                Ok(Value::Number(value as f64))
            }
            fn visit_str<E: de::Error>(self, value: &str) -> Result<Value, E> {
                Ok(Value::Text(value.to_owned()))
            }
        }
        deserializer.deserialize_any(ValueVisitor)
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = Spanned::<Value>::deserialize(deserializer)?;
        Ok(Self { span: spanned.span(), written: spanned.into_inner() })
    }
}

/// Two quantities [x, y].
pub(super) type Components = [Quantity; 2];

/// Quantities [x, y], or [x, y, z] with what points out of the drawing.
#[derive(Debug, Clone)]
pub(super) struct InSpace {
    /// In the drawing.
    pub(super) components: Components,
    /// Out of it.
    pub(super) z: Option<Quantity>,
}

impl<'de> Deserialize<'de> for InSpace {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InSpaceVisitor;
        impl<'de> Visitor<'de> for InSpaceVisitor {
            type Value = InSpace;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("[x, y] or [x, y, z]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<InSpace, A::Error> {
                in_space(sequence, "[x, y] or [x, y, z]")
            }
        }
        deserializer.deserialize_seq(InSpaceVisitor)
    }
}

/// A place in the drawing.
#[derive(Debug, Clone)]
pub(super) enum Place {
    /// The name of a point.
    Point(Name),
    /// Its coordinates.
    Coordinates(Box<InSpace>),
}

/// A place of an outline.
#[derive(Debug, Clone)]
pub(super) enum OutlinePlace {
    /// A corner.
    Corner(Place),
    /// A place on the arc from the corner before it to the one behind it.
    Through(Through),
}

/// A place that an arc passes.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct Through {
    /// A place on the arc between two corners: a point's name or [x, y].
    pub(super) through: Place,
}

/// A direction in the drawing.
#[derive(Debug, Clone)]
pub(super) enum Direction {
    /// Angle from the x axis, counter-clockwise.
    Angle(Quantity),
    /// From one point to another.
    Points([Name; 2]),
}

/// A value for both sides of contact, or one for each.
#[derive(Debug, Clone)]
pub(super) enum PerSide {
    /// One value for both sides.
    Both(Quantity),
    /// One for each sign of the normal force.
    Each(Box<Sides>),
}

/// The values of the two sides of contact.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(deny_unknown_fields))]
pub(super) struct Sides {
    /// Value where the normal force is positive.
    pub(super) plus: Quantity,
    /// Value where the normal force is negative.
    pub(super) minus: Quantity,
}

/// Gravity: downward magnitude or components.
#[derive(Debug, Clone)]
pub(super) enum Gravity {
    /// Magnitude, along -y.
    Down(Quantity),
    /// Components [x, y], or [x, y, z].
    Components(Box<InSpace>),
}

/// Deserializes a value that is written either as one thing or as a list or table of them; `visit_any` keeps
/// the places of the parts, which serde's untagged enums lose.
struct EitherVisitor<T>(std::marker::PhantomData<T>);

/// Conversion of a value from each of its written forms.
trait Either<'de>: Sized {
    const EXPECTED: &'static str;
    fn from_quantity(quantity: Quantity) -> Option<Self>;
    fn from_sequence<A: SeqAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(de::Error::custom(Self::EXPECTED))
    }
    fn from_map<A: MapAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(de::Error::custom(Self::EXPECTED))
    }
}

impl<'de, T: Either<'de>> Visitor<'de> for EitherVisitor<T> {
    type Value = Form<T>;
    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(T::EXPECTED)
    }
    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Form<T>, E> {
        Ok(Form::Scalar(Value::Number(value)))
    }
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Form<T>, E> {
        Ok(Form::Scalar(Value::Number(value as f64)))
    }
    fn visit_str<E: de::Error>(self, value: &str) -> Result<Form<T>, E> {
        Ok(Form::Scalar(Value::Text(value.to_owned())))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Form<T>, A::Error> {
        T::from_sequence(sequence).map(Form::Whole)
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Form<T>, A::Error> {
        T::from_map(map).map(Form::Whole)
    }
}

/// A value read from a single scalar, or whole from a list or table.
enum Form<T> {
    Scalar(Value),
    Whole(T),
}

impl<'de, T: Either<'de>> Deserialize<'de> for Form<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EitherVisitor(std::marker::PhantomData))
    }
}

fn deserialize_either<'de, T: Either<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let spanned = Spanned::<Form<T>>::deserialize(deserializer)?;
    let span = spanned.span();
    match spanned.into_inner() {
        Form::Whole(value) => Ok(value),
        Form::Scalar(written) => {
            T::from_quantity(Quantity { written, span }).ok_or_else(|| de::Error::custom(T::EXPECTED))
        }
    }
}

fn pair<'de, T: Deserialize<'de>, A: SeqAccess<'de>>(
    mut sequence: A,
    expected: &str,
) -> Result<[T; 2], A::Error> {
    let first = sequence.next_element()?.ok_or_else(|| de::Error::custom(expected))?;
    let second = sequence.next_element()?.ok_or_else(|| de::Error::custom(expected))?;
    Ok([first, second])
}

fn in_space<'de, A: SeqAccess<'de>>(mut sequence: A, expected: &str) -> Result<InSpace, A::Error> {
    let components = pair(&mut sequence, expected)?;
    Ok(InSpace { components, z: sequence.next_element()? })
}

impl<'de> Either<'de> for Place {
    const EXPECTED: &'static str = "the name of a point, or its coordinates [x, y] or [x, y, z]";
    fn from_quantity(quantity: Quantity) -> Option<Self> {
        match quantity.written {
            Value::Text(text) => Some(Self::Point(Name { text, span: quantity.span })),
            Value::Number(_) => None,
        }
    }
    fn from_sequence<A: SeqAccess<'de>>(sequence: A) -> Result<Self, A::Error> {
        Ok(Self::Coordinates(Box::new(in_space(sequence, Self::EXPECTED)?)))
    }
}

impl<'de> Either<'de> for OutlinePlace {
    const EXPECTED: &'static str =
        "the name of a point, its coordinates [x, y], or { through = .. } for an arc";
    fn from_quantity(quantity: Quantity) -> Option<Self> {
        Place::from_quantity(quantity).map(Self::Corner)
    }
    fn from_sequence<A: SeqAccess<'de>>(sequence: A) -> Result<Self, A::Error> {
        Place::from_sequence(sequence).map(Self::Corner)
    }
    fn from_map<A: MapAccess<'de>>(map: A) -> Result<Self, A::Error> {
        Through::deserialize(de::value::MapAccessDeserializer::new(map)).map(Self::Through)
    }
}

impl<'de> Either<'de> for Direction {
    const EXPECTED: &'static str = "an angle, or two points [\"from\", \"to\"]";
    fn from_quantity(quantity: Quantity) -> Option<Self> {
        Some(Self::Angle(quantity))
    }
    fn from_sequence<A: SeqAccess<'de>>(sequence: A) -> Result<Self, A::Error> {
        Ok(Self::Points(pair(sequence, Self::EXPECTED)?))
    }
}

impl<'de> Either<'de> for PerSide {
    const EXPECTED: &'static str = "a quantity, or { plus = .., minus = .. }";
    fn from_quantity(quantity: Quantity) -> Option<Self> {
        Some(Self::Both(quantity))
    }
    fn from_map<A: MapAccess<'de>>(map: A) -> Result<Self, A::Error> {
        Sides::deserialize(de::value::MapAccessDeserializer::new(map))
            .map(|sides| Self::Each(Box::new(sides)))
    }
}

impl<'de> Either<'de> for Gravity {
    const EXPECTED: &'static str = "a quantity, or its components [x, y] or [x, y, z]";
    fn from_quantity(quantity: Quantity) -> Option<Self> {
        Some(Self::Down(quantity))
    }
    fn from_sequence<A: SeqAccess<'de>>(sequence: A) -> Result<Self, A::Error> {
        Ok(Self::Components(Box::new(in_space(sequence, Self::EXPECTED)?)))
    }
}

macro_rules! either_of_its_forms {
    ($($name:ty),+) => {
        $(impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserialize_either(deserializer)
            }
        })+
    };
}

either_of_its_forms!(Place, OutlinePlace, Direction, PerSide, Gravity);
