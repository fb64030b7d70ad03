//! Models that are there already: the gallery and the templates.

use crate::arguments::value;
use crate::fault::Texts;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use slideway::fault::nearest;
use slideway::gallery;
use slideway::model::Settings;
use slideway::template::{self, TEMPLATES};

/// The text of a model of the gallery.
pub(crate) fn text(name: &str) -> PyResult<&'static str> {
    let names = gallery::MODELS.iter().map(|model| model.name);
    let unknown = || unknown(&format!("there is no model {name:?} in the gallery"), nearest(name, names));
    Ok(gallery::find(name).ok_or_else(unknown)?.text)
}

/// The text of a template with sizes of one's own.
pub(crate) fn filled_in(py: Python<'_>, name: &str, sizes: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
    let names = TEMPLATES.iter().map(|template| template.name);
    let unknown = || unknown(&format!("there is no template {name:?}"), nearest(name, names));
    let template = template::find(name).ok_or_else(unknown)?;
    let mut settings = Settings::default();
    for (name, given) in sizes.into_iter().flatten() {
        let name: String = name.extract()?;
        settings = settings.parameter(&name, value(&name, &given)?);
    }
    let refused = |faults| Texts { model: template.text, settings: &settings }.error(py, &faults);
    template.model(&settings, &format!("{name}.toml")).map_err(refused)
}

/// Builds the `KeyError` for a name of which there is nothing, with the one that is perhaps meant.
fn unknown(message: &str, nearest: Option<String>) -> PyErr {
    let meant = nearest.map(|near| format!("; did you mean {near:?}?"));
    PyKeyError::new_err(format!("{message}{}", meant.unwrap_or_default()))
}

#[doc = include_str!("../docs/templates.txt")]
#[pyfunction]
#[pyo3(signature = () -> "dict[str, str]")]
pub(crate) fn templates(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let templates = PyDict::new(py);
    for template in TEMPLATES {
        templates.set_item(template.name, template.summary())?;
    }
    Ok(templates)
}

#[doc = include_str!("../docs/gallery_models.txt")]
#[pyfunction]
#[pyo3(signature = () -> "dict[str, str]")]
pub(crate) fn gallery_models(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let models = PyDict::new(py);
    for model in gallery::MODELS {
        models.set_item(model.name, model.summary())?;
    }
    Ok(models)
}
