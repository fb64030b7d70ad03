//! No number that leaves is infinite or undefined: JSON would write `null` for it, and text `inf`.

use crate::fault::{Fault, FaultKind, Faults};
use serde::ser::{
    Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};
use std::fmt;

/// A report all of whose numbers are finite.
///
/// # Errors
/// A fault that names the first number that is not.
pub fn finite<T: Serialize>(report: T) -> Result<T, Faults> {
    match report.serialize(&mut Reader { place: String::new() }) {
        Ok(()) => Ok(report),
        Err(NotFinite { place }) => {
            Err(Fault::general(FaultKind::Overflow { quantity: format!("`{place}` of the answer") }).into())
        }
    }
}

/// The number of a cell of a table; nothing where it is not defined, which is an empty cell (CSV), null
/// (Parquet) or NaN (NumPy). An infinite number is none.
pub fn defined(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// A number that is not finite.
#[derive(Debug)]
struct NotFinite {
    place: String,
}

impl fmt::Display for NotFinite {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} is not finite", self.place)
    }
}

impl std::error::Error for NotFinite {}

impl serde::ser::Error for NotFinite {
    fn custom<M: fmt::Display>(message: M) -> Self {
        Self { place: message.to_string() }
    }
}

/// Reads a report as a serializer does, and keeps nothing but the place.
struct Reader {
    place: String,
}

impl Reader {
    /// Reads what lies at a further place, such as `.from` or `[2]`.
    fn at<T: Serialize + ?Sized>(&mut self, further: fmt::Arguments<'_>, value: &T) -> Result<(), NotFinite> {
        let length = self.place.len();
        let dot = if length == 0 { "" } else { "." };
        let further = further.to_string();
        self.place.push_str(if further.starts_with('[') { "" } else { dot });
        self.place.push_str(&further);
        value.serialize(&mut *self)?;
        self.place.truncate(length);
        Ok(())
    }
}

/// The parts of something, counted.
struct Parts<'r> {
    reader: &'r mut Reader,
    count: usize,
}

impl Parts<'_> {
    fn next<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
        self.count += 1;
        self.reader.at(format_args!("[{}]", self.count - 1), value)
    }
}

macro_rules! plain {
    ($($method:ident: $kind:ty),*) => {
        $(fn $method(self, _: $kind) -> Result<(), NotFinite> { Ok(()) })*
    };
}

macro_rules! parts {
    ($($method:ident($($name:ident: $kind:ty),*) -> $part:ident),*) => {
        $(
            type $part = Parts<'r>;
            fn $method(self, $($name: $kind),*) -> Result<Parts<'r>, NotFinite> {
                $(let _ = $name;)*
                Ok(Parts { reader: self, count: 0 })
            }
        )*
    };
}

impl<'r> Serializer for &'r mut Reader {
    type Ok = ();
    type Error = NotFinite;

    plain!(
        serialize_bool: bool, serialize_char: char, serialize_str: &str, serialize_bytes: &[u8],
        serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64,
        serialize_unit_struct: &'static str
    );

    parts!(
        serialize_seq(length: Option<usize>) -> SerializeSeq,
        serialize_tuple(length: usize) -> SerializeTuple,
        serialize_tuple_struct(name: &'static str, length: usize) -> SerializeTupleStruct,
        serialize_tuple_variant(name: &'static str, index: u32, variant: &'static str, length: usize)
            -> SerializeTupleVariant,
        serialize_map(length: Option<usize>) -> SerializeMap,
        serialize_struct(name: &'static str, length: usize) -> SerializeStruct,
        serialize_struct_variant(name: &'static str, index: u32, variant: &'static str, length: usize)
            -> SerializeStructVariant
    );

    fn serialize_f64(self, value: f64) -> Result<(), NotFinite> {
        if value.is_finite() { Ok(()) } else { Err(NotFinite { place: self.place.clone() }) }
    }

    fn serialize_f32(self, value: f32) -> Result<(), NotFinite> {
        self.serialize_f64(f64::from(value))
    }

    fn serialize_none(self) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_unit(self) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), NotFinite> {
        value.serialize(self)
    }
}

macro_rules! elements {
    ($($part:ident::$method:ident),*) => {
        $(impl $part for Parts<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
                self.next(value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

elements!(
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field
);

macro_rules! fields {
    ($($part:ident),*) => {
        $(impl $part for Parts<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), NotFinite> {
                self.reader.at(format_args!("{name}"), value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

fields!(SerializeStruct, SerializeStructVariant);

impl SerializeMap for Parts<'_> {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
        self.next(value)
    }

    fn end(self) -> Result<(), NotFinite> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{defined, finite};
    use crate::report::indented;
    use serde::Serialize;
    use std::collections::BTreeMap;

    #[derive(Serialize, Clone)]
    enum Kind {
        Tuple(f64, f64),
        Struct { value: Option<f64> },
    }

    #[derive(Serialize, Clone)]
    struct Whole {
        name: &'static str,
        parts: Vec<(u8, f64)>,
        kinds: Vec<Kind>,
        map: BTreeMap<u8, f64>,
    }

    type Spoil = fn(&mut Whole);

    fn whole() -> Whole {
        let kinds = vec![Kind::Tuple(1.0, 2.0), Kind::Struct { value: None }];
        Whole { name: "inf", parts: vec![(1, f64::MAX), (2, -0.0)], kinds, map: BTreeMap::from([(1, 1.0)]) }
    }

    #[test]
    fn every_number_is_looked_at_and_the_first_that_is_not_finite_is_named() {
        assert!(finite(whole()).is_ok());
        let spoilt: [(&str, Spoil); 4] = [
            ("`parts[1][1]`", |whole| whole.parts[1].1 = f64::NAN),
            ("`kinds[0][1]`", |whole| whole.kinds[0] = Kind::Tuple(1.0, f64::NEG_INFINITY)),
            ("`kinds[1].value`", |whole| whole.kinds[1] = Kind::Struct { value: Some(f64::INFINITY) }),
            ("`map[0]`", |whole| *whole.map.entry(1).or_default() = f64::INFINITY),
        ];
        for (place, spoil) in spoilt {
            let mut whole = whole();
            spoil(&mut whole);
            let told = finite(whole).map(|whole| whole.name).expect_err("not finite").to_string();
            assert!(told.contains(place), "{told}");
        }
    }

    #[test]
    #[should_panic(expected = "`parts[0][1]`")]
    fn json_has_no_null_for_a_number() {
        let _ = indented(&Whole { parts: vec![(1, f64::NAN)], ..whole() });
    }

    #[test]
    fn cells_of_tables_are_finite_or_empty() {
        assert_eq!([0.0, f64::MAX].map(defined), [Some(0.0), Some(f64::MAX)]);
        assert_eq!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(defined), [None; 3]);
    }
}
