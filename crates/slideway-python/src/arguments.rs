//! Arguments of methods: numbers or texts, names with ranges.

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};
use slideway::Model;
use slideway::choice::Choice;
use slideway::drawing::Quantity;
use slideway::limits::Vary;
use slideway::model::{Setting, SettingKind, Settings, Value};

/// A number in SI units, or a text with a unit or an expression, such as `"75 deg"`.
pub(crate) fn value(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(Value::from(text.to_string_lossy().as_ref()));
    }
    let wanted = || format!("{name} must be a number in SI units or a text such as \"75 deg\"");
    if object.is_instance_of::<PyBool>() {
        return Err(PyTypeError::new_err(format!("{}, not {}", wanted(), object.repr()?)));
    }
    // NumPy would drop the imaginary part with a warning.
    let is_complex = object.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.eq("c"));
    let number = if is_complex.unwrap_or(false) { None } else { object.extract::<f64>().ok() };
    match number {
        Some(number) if number.is_finite() => Ok(Value::from(number)),
        Some(number) => Err(PyValueError::new_err(format!("{}, not {number}", wanted()))),
        None => {
            let kind = object.get_type().name()?;
            Err(PyTypeError::new_err(format!("{}, not of type {kind}", wanted())))
        }
    }
}

/// Reads such a value as a quantity of a drawing: a number in SI units, or a text.
pub(crate) fn quantity(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Quantity> {
    Ok(match value(name, object)? {
        Value::Number(number) => number.into(),
        text => text.to_string().into(),
    })
}

/// A pair of them, such as a place.
pub(crate) fn pair(name: &str, object: &Bound<'_, PyAny>) -> PyResult<[Quantity; 2]> {
    let [first, second] = two(name, object, "values")?;
    Ok([quantity(name, &first)?, quantity(name, &second)?])
}

/// A pair of anything.
pub(crate) fn two<'py>(
    name: &str,
    object: &Bound<'py, PyAny>,
    what: &str,
) -> PyResult<[Bound<'py, PyAny>; 2]> {
    let items = sequence(name, object, what)?;
    let count = items.len();
    items.try_into().map_err(|_| PyValueError::new_err(format!("{name} must be two {what}, not {count}")))
}

/// A list, tuple or array as its items.
pub(crate) fn sequence<'py>(
    name: &str,
    object: &Bound<'py, PyAny>,
    what: &str,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let kind = object.get_type().name()?;
    let refused =
        |_| PyTypeError::new_err(format!("{name} must be a sequence of {what}, not of type {kind}"));
    object.extract().map_err(refused)
}

/// The sizes of an array, or of what can become one, and its entries row by row.
pub(crate) fn numbers(name: &str, given: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<f64>)> {
    let refused = |error: PyErr| {
        let message = format!("{name} must be an array of real numbers: {}", error.value(given.py()));
        if error.is_instance_of::<PyTypeError>(given.py()) {
            PyTypeError::new_err(message)
        } else {
            PyValueError::new_err(message)
        }
    };
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given,)).map_err(refused)?;
    let dtype = array.getattr("dtype")?;
    if !"fiu".contains(&dtype.getattr("kind")?.extract::<String>()?) {
        return Err(refused(PyTypeError::new_err(format!("its dtype is {dtype}"))));
    }
    // Where Dask or a file has put it, an array may be neither contiguous nor aligned.
    let array = numpy.call_method1("require", (array, "f8", "CA")).map_err(refused)?;
    let array = array.cast_into::<PyArrayDyn<f64>>()?;
    Ok((array.shape().to_vec(), array.to_vec()?))
}

/// Returns the settings of `with_`: parameters and coordinates by their names, rates, the time.
pub(crate) fn settings(
    model: &Model,
    named: Option<&Bound<'_, PyDict>>,
    [at, rate]: [Option<&Bound<'_, PyDict>>; 2],
    time: Option<&Bound<'_, PyAny>>,
) -> PyResult<Settings> {
    let mut settings = Settings::default();
    let is_coordinate = |name: &str| model.coordinates.iter().any(|known| *known.name == *name);
    let is_parameter = |name: &str| model.parameters.iter().any(|known| *known.name == *name);
    let kinds = [(named, None), (at, Some(SettingKind::Position)), (rate, Some(SettingKind::Rate))];
    for (given, kind) in kinds {
        for (name, given) in given.into_iter().flatten() {
            let name: String = name.extract().map_err(|_| PyTypeError::new_err("names must be texts"))?;
            let is_position = is_coordinate(&name) && !is_parameter(&name);
            let usual = if is_position { SettingKind::Position } else { SettingKind::Parameter };
            let kind = kind.unwrap_or(usual);
            settings = settings.with(Setting::new(kind, &name, value(&name, &given)?));
        }
    }
    match time {
        Some(time) => Ok(settings.time(value("time", time)?)),
        None => Ok(settings),
    }
}

/// A count, which Python may give as any whole number.
pub(crate) fn count<T: TryFrom<i128>>(name: &str, given: impl Into<i128>) -> PyResult<T> {
    let given = given.into();
    let refused = |_| PyValueError::new_err(format!("{name} must be a whole number from 0 on, not {given}"));
    T::try_from(given).map_err(refused)
}

/// A count, if there is one.
pub(crate) fn optional_count<T: TryFrom<i128>>(name: &str, given: Option<i64>) -> PyResult<Option<T>> {
    given.map(|given| count(name, given)).transpose()
}

/// The one quantity that is varied, and over which range: its name with its ends, apart or as a pair, or a range by its
/// name. None if nothing is given.
pub(crate) fn varied_one(
    name: Option<&str>,
    ends: [Option<&Bound<'_, PyAny>>; 2],
    ranges: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Vary>> {
    let mut named = varied(ranges)?;
    match (name, ends, named.len()) {
        (None, [None, None], 0) => Ok(None),
        (None, [None, None], 1) => Ok(named.pop()),
        (Some(name), [None, None], 0) => Ok(Some(Vary::usual(name))),
        (Some(name), [Some(from), Some(to)], 0) => {
            Ok(Some(Vary::between(name, value("start", from)?, value("stop", to)?)))
        }
        (Some(name), [Some(range), None], 0) => vary_between(name, Some(range)).map(Some),
        (Some(_), _, 0) => Err(PyTypeError::new_err("start and stop must be given together")),
        _ => Err(PyTypeError::new_err("one quantity can be varied, such as mu=(0, 1)")),
    }
}

/// Returns the one quantity that is varied, as [`varied_one`], where one is needed.
pub(crate) fn vary(
    name: Option<&str>,
    ends: [Option<&Bound<'_, PyAny>>; 2],
    ranges: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vary> {
    let needed = || PyTypeError::new_err("give what is varied and its range, such as mu=(0, 1)");
    varied_one(name, ends, ranges)?.ok_or_else(needed)
}

/// A quantity that is varied between a pair of ends.
fn vary_between(name: &str, range: Option<&Bound<'_, PyAny>>) -> PyResult<Vary> {
    let Some(range) = range else { return Ok(Vary::usual(name)) };
    let wanted = || {
        PyTypeError::new_err(format!(
            "the range of {name} must be a pair of its ends, such as {name}=(0, 1); nothing else has this name"
        ))
    };
    let ends: Vec<Bound<'_, PyAny>> = range.extract().map_err(|_| wanted())?;
    let [from, to] = &*ends else { return Err(wanted()) };
    let end = |which: &str, given| value(&format!("the {which} of {name}"), given);
    Ok(Vary::between(name, end("start", from)?, end("end", to)?))
}

/// Returns the quantities that are varied, each over the pair of its ends, or over its usual range if that is
/// None.
pub(crate) fn varied(ranges: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<Vary>> {
    let mut varied = Vec::new();
    for (name, range) in ranges.into_iter().flatten() {
        varied.push(vary_between(&name.extract::<String>()?, (!range.is_none()).then_some(&range))?);
    }
    Ok(varied)
}

/// One of a few by its word.
pub(crate) fn choice<C: Choice>(argument: &str, word: &str) -> PyResult<C> {
    let known = || {
        let words: Vec<String> = C::CHOICES.iter().map(|(_, word, _)| format!("'{word}'")).collect();
        match &*words {
            [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            _ => words.concat(),
        }
    };
    C::of_word(word)
        .ok_or_else(|| PyValueError::new_err(format!("{argument} must be {}, not {word:?}", known())))
}
