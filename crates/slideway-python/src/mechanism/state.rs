//! A mechanism that is put together, and the names in it.

use super::Mechanism;
use super::values::End;
use crate::fault::Texts;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use slideway::drawing::{Quantity, Slider};
use slideway::fault::{Fault, FaultKind, nearest};
use slideway::ids::{BodyId, CoordinateId, Frame, JointId};
use slideway::model::Settings;
use slideway::{Drawing, Faults};
use std::borrow::Cow;
use std::sync::PoisonError;

/// The name of the fixed frame.
pub(crate) const GROUND: &str = "ground";

/// A mechanism that is put together: its drawing, and the names of what others refer to.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) drawing: Drawing,
    /// The kind and the name of everything.
    pub(super) names: Vec<(Cow<'static, str>, String)>,
    pub(super) bodies: Vec<(String, BodyId)>,
    pub(super) sliders: Vec<(String, JointId)>,
    pub(super) coordinates: Vec<(String, CoordinateId)>,
}

/// Why something cannot be added.
pub(super) enum Refused {
    /// The name of something that is not there.
    Unknown(Faults),
    /// A name that another has.
    Taken { what: &'static str, name: String },
}

impl State {
    /// Returns the state as the text that is pickled.
    pub(super) fn kept(&self) -> PyResult<String> {
        serde_json::to_string(self).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Restores a state from the text that was pickled.
    pub(super) fn restored(kept: &str) -> PyResult<Self> {
        let other =
            |error| format!("this is no mechanism that this version of slideway has pickled: {error}");
        serde_json::from_str(kept).map_err(|error| PyValueError::new_err(other(error)))
    }

    /// Takes a name for a thing of its kind.
    pub(super) fn claim(&mut self, what: &'static str, name: &str) -> Result<(), Refused> {
        if self.names.iter().any(|(kind, taken)| *kind == what && taken == name) {
            return Err(Refused::Taken { what, name: name.to_owned() });
        }
        self.names.push((what.into(), name.to_owned()));
        Ok(())
    }

    pub(super) fn frame(&self, argument: &str, name: &str) -> Result<Frame, Refused> {
        if name == GROUND {
            return Ok(Frame::Ground);
        }
        found(&self.bodies, ("body", argument), name).map(Frame::Body)
    }

    pub(super) fn frames(&self, arguments: [&str; 2], names: [&str; 2]) -> Result<[Frame; 2], Refused> {
        Ok([self.frame(arguments[0], names[0])?, self.frame(arguments[1], names[1])?])
    }

    /// The ends of a spring or damper.
    pub(super) fn ends(&self, [first, second]: [End; 2]) -> Result<[(Frame, [Quantity; 2]); 2], Refused> {
        Ok([
            (self.frame("first", &first.body)?, first.place),
            (self.frame("second", &second.body)?, second.place),
        ])
    }

    /// The body that a reaction acts on, if there is one.
    pub(super) fn reaction(&self, name: Option<&str>) -> Result<Option<Frame>, Refused> {
        name.map(|name| self.frame("reaction", name)).transpose()
    }
}

impl Mechanism {
    pub(super) fn state(&self) -> State {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Adds a thing of this name. Nothing of Python may run in `add`: the mechanism is locked meanwhile.
    pub(super) fn add(
        &self,
        py: Python<'_>,
        (what, name): (&'static str, &str),
        add: impl FnOnce(&mut State) -> Result<(), Refused>,
    ) -> PyResult<String> {
        let added = {
            let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
            let mut next = state.clone();
            next.claim(what, name).and_then(|()| add(&mut next)).map(|()| *state = next)
        };
        match added {
            Ok(()) => Ok(name.to_owned()),
            Err(Refused::Unknown(faults)) => {
                Err(Texts { model: "", settings: &Settings::default() }.error(py, &faults))
            }
            Err(Refused::Taken { what, name }) => {
                Err(PyValueError::new_err(format!("name: there is a {what} named {name:?} already")))
            }
        }
    }

    /// Adds a sliding joint.
    pub(super) fn add_slider<K>(
        &self,
        py: Python<'_>,
        (name, arguments, frames): (&str, [&str; 2], [&str; 2]),
        slider: impl FnOnce(&mut Drawing, [Frame; 2]) -> Slider<K>,
    ) -> PyResult<String> {
        self.add(py, ("joint", name), |state| {
            let frames = state.frames(arguments, frames)?;
            let joint = slider(&mut state.drawing, frames).into();
            state.sliders.push((name.to_owned(), joint));
            Ok(())
        })
    }
}

/// Finds the id for this name; refuses one that is not known.
pub(super) fn found<I: Copy>(
    all: &[(String, I)],
    (what, argument): (&'static str, &str),
    name: &str,
) -> Result<I, Refused> {
    if let Some((_, id)) = all.iter().find(|(known, _)| known == name) {
        return Ok(*id);
    }
    let known = || all.iter().map(|(name, _)| name.as_str());
    let kind = FaultKind::UnknownName {
        what,
        name: name.to_owned(),
        nearest: nearest(name, known()),
        known: known().map(str::to_owned).collect(),
    };
    let text = format!("{argument}={name}");
    let place = argument.len() + 1..text.len();
    Err(Refused::Unknown(Fault::of_argument(kind, &text, place).into()))
}
