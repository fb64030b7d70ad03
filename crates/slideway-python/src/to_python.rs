//! Serializable values as objects of Python: a struct becomes an instance of the class of its name in
//! `slideway.reports`, a sequence a tuple (or an array where the class says so), a unit variant its word.

use numpy::PyArray1;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyString, PyTuple, PyType};
use serde::ser::{self, Serialize};
use std::collections::HashMap;
use std::fmt;

/// The classes of `slideway.reports` by their names, and what they say of their fields.
struct Classes {
    by_name: HashMap<String, Py<PyAny>>,
    hints: Py<PyDict>,
    /// `object.__new__` and `object.__setattr__`: the classes have constructors, and are frozen.
    new: Py<PyAny>,
    set_attribute: Py<PyAny>,
}

static CLASSES: PyOnceLock<Classes> = PyOnceLock::new();

impl Classes {
    fn get(py: Python<'_>) -> PyResult<&'static Self> {
        CLASSES.get_or_try_init(py, || {
            let module = py.import("slideway.reports")?;
            let hints = module.getattr("HINTS")?.cast_into::<PyDict>()?.unbind();
            let by_name = module.dict().iter().filter(|(_, value)| value.is_instance_of::<PyType>());
            let by_name = by_name.map(|(name, class)| Ok((name.extract()?, class.unbind())));
            let object = py.import("builtins")?.getattr("object")?;
            let (new, set_attribute) = (object.getattr("__new__")?, object.getattr("__setattr__")?);
            let (new, set_attribute) = (new.unbind(), set_attribute.unbind());
            Ok(Self { by_name: by_name.collect::<PyResult<_>>()?, hints, new, set_attribute })
        })
    }
}

/// An instance of a class of `slideway.reports` with these attributes, without its constructor.
pub(crate) fn instance<'py>(
    py: Python<'py>,
    class: &str,
    attributes: Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyAny>> {
    let classes = Classes::get(py)?;
    let unknown = || PyTypeError::new_err(format!("slideway.reports has no class {class}"));
    let object = classes.new.bind(py).call1((classes.by_name.get(class).ok_or_else(unknown)?,))?;
    classes.set_attribute.bind(py).call1((&object, intern!(py, "__dict__"), attributes))?;
    Ok(object)
}

/// A value as an object of Python.
pub(crate) fn to_python<'py, T: Serialize + ?Sized>(
    py: Python<'py>,
    value: &T,
) -> PyResult<Bound<'py, PyAny>> {
    value.serialize(Serializer { py, hint: None }).map_err(|error| error.0)
}

/// The fields of a struct as a dictionary.
pub(crate) fn fields<'py, T: Serialize + ?Sized>(py: Python<'py>, value: &T) -> PyResult<Bound<'py, PyDict>> {
    let object = to_python(py, value)?;
    Ok(object.getattr("__dict__")?.cast_into::<PyDict>()?)
}

/// An exception within serialization.
#[derive(Debug)]
struct Error(PyErr);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Error {}

impl ser::Error for Error {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(PyTypeError::new_err(message.to_string()))
    }
}

impl From<PyErr> for Error {
    fn from(error: PyErr) -> Self {
        Self(error)
    }
}

type Made<'py> = Result<Bound<'py, PyAny>, Error>;

#[derive(Clone)]
struct Serializer<'py> {
    py: Python<'py>,
    /// The hint that the class with this value in a field gives of it.
    hint: Option<String>,
}

impl<'py> Serializer<'py> {
    fn made<T: IntoPyObject<'py>>(&self, value: T) -> Made<'py> {
        Ok(value.into_bound_py_any(self.py)?)
    }
}

macro_rules! numbers {
    ($($name:ident: $type:ty),*) => {
        $(fn $name(self, value: $type) -> Made<'py> {
            self.made(value)
        })*
    };
}

impl<'py> ser::Serializer for Serializer<'py> {
    type Ok = Bound<'py, PyAny>;
    type Error = Error;
    type SerializeSeq = Sequence<'py>;
    type SerializeTuple = Sequence<'py>;
    type SerializeTupleStruct = Sequence<'py>;
    type SerializeTupleVariant = ser::Impossible<Self::Ok, Error>;
    type SerializeMap = Fields<'py>;
    type SerializeStruct = Fields<'py>;
    type SerializeStructVariant = ser::Impossible<Self::Ok, Error>;

    numbers! {
        serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64,
        serialize_f32: f32, serialize_f64: f64
    }

    fn serialize_bool(self, value: bool) -> Made<'py> {
        Ok(pyo3::types::PyBool::new(self.py, value).to_owned().into_any())
    }

    fn serialize_char(self, value: char) -> Made<'py> {
        self.serialize_str(value.encode_utf8(&mut [0; 4]))
    }

    fn serialize_str(self, value: &str) -> Made<'py> {
        Ok(PyString::new(self.py, value).into_any())
    }

    fn serialize_bytes(self, value: &[u8]) -> Made<'py> {
        Ok(pyo3::types::PyBytes::new(self.py, value).into_any())
    }

    fn serialize_none(self) -> Made<'py> {
        self.serialize_unit()
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Made<'py> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Made<'py> {
        Ok(self.py.None().into_bound(self.py))
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Made<'py> {
        self.serialize_unit()
    }

    fn serialize_unit_variant(self, _name: &'static str, _index: u32, variant: &'static str) -> Made<'py> {
        self.serialize_str(variant)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _name: &'static str, value: &T) -> Made<'py> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        value: &T,
    ) -> Made<'py> {
        let dict = PyDict::new(self.py);
        dict.set_item(variant, value.serialize(Self { py: self.py, hint: None })?)?;
        Ok(dict.into_any())
    }

    fn serialize_seq(self, length: Option<usize>) -> Result<Sequence<'py>, Error> {
        Ok(Sequence { items: Vec::with_capacity(length.unwrap_or(0)), of: self })
    }

    fn serialize_tuple(self, length: usize) -> Result<Sequence<'py>, Error> {
        self.serialize_seq(Some(length))
    }

    fn serialize_tuple_struct(self, _name: &'static str, length: usize) -> Result<Sequence<'py>, Error> {
        self.serialize_seq(Some(length))
    }

    fn serialize_tuple_variant(
        self,
        name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Self::SerializeTupleVariant, Error> {
        Err(no_report(name, variant))
    }

    fn serialize_map(self, _length: Option<usize>) -> Result<Fields<'py>, Error> {
        let class = self.hint.clone();
        Fields::new(self.py, class.as_deref())
    }

    fn serialize_struct(self, name: &'static str, _length: usize) -> Result<Fields<'py>, Error> {
        // Variants of enums that are no words have the name of the enum, and no class.
        let has_class = Classes::get(self.py)?.by_name.contains_key(name);
        Fields::new(self.py, has_class.then_some(name))
    }

    fn serialize_struct_variant(
        self,
        name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Self::SerializeStructVariant, Error> {
        Err(no_report(name, variant))
    }
}

/// Variants of several values have a tag in reports, which makes structs of them.
fn no_report(name: &str, variant: &str) -> Error {
    ser::Error::custom(format!("the variant {variant} of {name} has no tag"))
}

struct Sequence<'py> {
    items: Vec<Bound<'py, PyAny>>,
    of: Serializer<'py>,
}

impl<'py> Sequence<'py> {
    fn push<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Error> {
        // What a class says of a field holds for the items of a list, but for arrays.
        let hint = match self.of.hint.as_deref() {
            Some("array" | "pairs") => None,
            Some("arrays") => Some("array".to_owned()),
            other => other.map(str::to_owned),
        };
        self.items.push(value.serialize(Serializer { py: self.of.py, hint })?);
        Ok(())
    }

    fn done(self) -> Made<'py> {
        let py = self.of.py;
        let number = |item: &Bound<'py, PyAny>| item.extract::<f64>().unwrap_or(f64::NAN);
        match self.of.hint.as_deref() {
            Some("array") => Ok(frozen_array(py, self.items.iter().map(number).collect())?),
            Some("pairs") => {
                let pair = |item: &Bound<'py, PyAny>| item.extract::<[f64; 2]>().unwrap_or([f64::NAN; 2]);
                let flat = frozen_array(py, self.items.iter().flat_map(pair).collect())?;
                Ok(flat.call_method1("reshape", (-1, 2))?)
            }
            _ => Ok(PyTuple::new(py, self.items)?.into_any()),
        }
    }
}

/// A NumPy array that cannot be written to.
#[pyfunction]
#[pyo3(signature = (numbers: "Sequence[float]") -> "NDArray[np.float64]")]
pub(crate) fn frozen_array(py: Python<'_>, numbers: Vec<f64>) -> PyResult<Bound<'_, PyAny>> {
    let array = PyArray1::from_vec(py, numbers).into_any();
    array.call_method1("setflags", (false,))?;
    Ok(array)
}

macro_rules! sequences {
    ($($trait:ident: $method:ident),*) => {
        $(impl<'py> ser::$trait for Sequence<'py> {
            type Ok = Bound<'py, PyAny>;
            type Error = Error;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Error> {
                self.push(value)
            }

            fn end(self) -> Made<'py> {
                self.done()
            }
        })*
    };
}

sequences! {
    SerializeSeq: serialize_element, SerializeTuple: serialize_element, SerializeTupleStruct: serialize_field
}

/// The attribute for a field: words that Python keeps for itself get an underscore.
fn attribute(field: &str) -> &str {
    match field {
        "from" => "from_",
        "is" => "is_",
        "lambda" => "lambda_",
        other => other,
    }
}

/// The fields of a struct, or the entries of a map.
struct Fields<'py> {
    dict: Bound<'py, PyDict>,
    class: Option<String>,
    hints: Option<Bound<'py, PyDict>>,
    key: Option<Bound<'py, PyAny>>,
}

impl<'py> Fields<'py> {
    fn new(py: Python<'py>, class: Option<&str>) -> Result<Self, Error> {
        let hints = match class {
            Some(class) => Classes::get(py)?.hints.bind(py).get_item(class)?,
            None => None,
        };
        let hints = hints.map(Bound::cast_into::<PyDict>).transpose().map_err(PyErr::from)?;
        Ok(Self { dict: PyDict::new(py), class: class.map(str::to_owned), hints, key: None })
    }

    fn set<T: Serialize + ?Sized>(&mut self, key: &Bound<'py, PyAny>, value: &T) -> Result<(), Error> {
        let hint = match &self.hints {
            Some(hints) => hints.get_item(key)?.map(|hint| hint.extract()).transpose()?,
            None => None,
        };
        self.dict.set_item(key, value.serialize(Serializer { py: key.py(), hint })?)?;
        Ok(())
    }

    fn done(self) -> Made<'py> {
        match self.class {
            Some(class) => Ok(instance(self.dict.py(), &class, self.dict)?),
            None => Ok(self.dict.into_any()),
        }
    }
}

impl<'py> ser::SerializeStruct for Fields<'py> {
    type Ok = Bound<'py, PyAny>;
    type Error = Error;

    fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, value: &T) -> Result<(), Error> {
        let key = PyString::intern(self.dict.py(), attribute(key)).into_any();
        self.set(&key, value)
    }

    fn end(self) -> Made<'py> {
        self.done()
    }
}

impl<'py> ser::SerializeMap for Fields<'py> {
    type Ok = Bound<'py, PyAny>;
    type Error = Error;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Error> {
        self.key = Some(to_python(self.dict.py(), key)?);
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Error> {
        let key = self.key.take().ok_or_else(|| Error(PyTypeError::new_err("a value without a key")))?;
        self.set(&key, value)
    }

    fn end(self) -> Made<'py> {
        self.done()
    }
}
