//! Arguments of methods, converted before they go into a drawing.

use crate::arguments::{pair, quantity, sequence, two};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyMapping, PyString};
use slideway::drawing::{
    BodyBuilder, ContactBuilder, CoordinateBuilder, OnLine, Quantity, SliderBuilder, kind,
};
use slideway::fault::nearest;

/// An argument that may be left out.
type Given<'g, 'py> = Option<&'g Bound<'py, PyAny>>;

/// Says of a thing what was given of it, and nothing of what was not.
pub(super) trait Said: Sized {
    fn with<T>(self, given: Option<T>, say: impl FnOnce(Self, T) -> Self) -> Self {
        match given {
            Some(value) => say(self, value),
            None => self,
        }
    }

    fn when(self, holds: bool, say: impl FnOnce(Self) -> Self) -> Self {
        if holds { say(self) } else { self }
    }
}

impl<T> Said for T {}

pub(super) fn optional(name: &str, given: Given<'_, '_>) -> PyResult<Option<Quantity>> {
    given.map(|given| quantity(name, given)).transpose()
}

pub(super) fn optional_pair(name: &str, given: Given<'_, '_>) -> PyResult<Option<[Quantity; 2]>> {
    given.map(|given| pair(name, given)).transpose()
}

/// The properties that a body can have.
pub(super) struct BodyValues {
    mass: Option<Quantity>,
    inertia: Option<Quantity>,
    centre: Option<[Quantity; 2]>,
    rectangle: Option<[Quantity; 2]>,
    disc: Option<Quantity>,
    bar: Option<[[Quantity; 2]; 2]>,
    outline: Option<Vec<[Quantity; 2]>>,
}

impl BodyValues {
    /// `mass`, `inertia` and `disc`, `centre` and `rectangle`, `bar` and `outline`.
    pub(super) fn new(
        [mass, inertia, disc]: [Given<'_, '_>; 3],
        [centre, rectangle]: [Given<'_, '_>; 2],
        [bar, outline]: [Given<'_, '_>; 2],
    ) -> PyResult<Self> {
        let ends = |bar: &Bound<'_, PyAny>| {
            let [one, other] = two("bar", bar, "places")?;
            Ok::<_, PyErr>([pair("bar", &one)?, pair("bar", &other)?])
        };
        let corners = |outline: &Bound<'_, PyAny>| {
            let corners = sequence("outline", outline, "places")?;
            corners.iter().map(|corner| pair("outline", corner)).collect::<PyResult<Vec<_>>>()
        };
        Ok(Self {
            mass: optional("mass", mass)?,
            inertia: optional("inertia", inertia)?,
            centre: optional_pair("centre", centre)?,
            rectangle: optional_pair("rectangle", rectangle)?,
            disc: optional("disc", disc)?,
            bar: bar.map(ends).transpose()?,
            outline: outline.map(corners).transpose()?,
        })
    }

    pub(super) fn say(self, body: BodyBuilder<'_>) -> BodyBuilder<'_> {
        body.with(self.mass, BodyBuilder::mass)
            .with(self.inertia, BodyBuilder::inertia)
            .with(self.centre, BodyBuilder::centre)
            .with(self.rectangle, BodyBuilder::rectangle)
            .with(self.disc, BodyBuilder::disc)
            .with(self.bar, BodyBuilder::bar)
            .with(self.outline, BodyBuilder::outline)
    }
}

/// An end of a spring or damper: a body, and a place of the drawing that moves with it.
pub(super) struct End {
    pub(super) body: String,
    pub(super) place: [Quantity; 2],
}

impl End {
    pub(super) fn new(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let [body, place] = two(name, given, "things, the name of a body and a place")?;
        let wanted = |_| PyTypeError::new_err(format!("{name} must begin with the name of a body"));
        Ok(Self { body: body.extract().map_err(wanted)?, place: pair(name, &place)? })
    }
}

/// A coefficient of friction or a preload: one, or one for either sign of the normal force.
pub(super) enum BySide {
    Both(Quantity),
    Each([Quantity; 2]),
}

impl BySide {
    pub(super) fn new(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Ok(sides) = given.cast::<PyMapping>() else { return quantity(name, given).map(Self::Both) };
        let wanted =
            || PyValueError::new_err(format!("{name} by side must have \"plus\" and \"minus\", no more"));
        if sides.len()? != 2 || !sides.contains("plus")? || !sides.contains("minus")? {
            return Err(wanted());
        }
        let side = |key: &str| quantity(&format!("{name}[{key:?}]"), &sides.get_item(key)?);
        Ok(Self::Each([side("plus")?, side("minus")?]))
    }
}

/// The properties of all contacts of a joint, or of one contact of a block.
#[derive(Default)]
pub(super) struct ContactValues {
    mu: Option<BySide>,
    mu_static: Option<Quantity>,
    preload: Option<BySide>,
    stiffness: Option<Quantity>,
    play: Option<Quantity>,
    misalignment: Option<Quantity>,
    pad: Option<[Quantity; 2]>,
}

impl ContactValues {
    /// `mu`, `mu_static`, `preload`, `stiffness`, `play`, `misalignment` and `pad`, in this order, of an argument
    /// with these names.
    pub(super) fn new(of: impl Fn(&str) -> String, given: [Given<'_, '_>; 7]) -> PyResult<Self> {
        let [mu, mu_static, preload, stiffness, play, misalignment, pad] = given;
        let by_side =
            |name: &str, given: Given<'_, '_>| given.map(|given| BySide::new(&of(name), given)).transpose();
        Ok(Self {
            mu: by_side("mu", mu)?,
            mu_static: optional(&of("mu_static"), mu_static)?,
            preload: by_side("preload", preload)?,
            stiffness: optional(&of("stiffness"), stiffness)?,
            play: optional(&of("play"), play)?,
            misalignment: optional(&of("misalignment"), misalignment)?,
            pad: optional_pair(&of("pad"), pad)?,
        })
    }
}

/// The names of the properties of one contact of a block; a further support has its place, too.
const OF_A_SUPPORT: [&str; 10] = [
    "mu",
    "mu_static",
    "preload",
    "stiffness",
    "play",
    "misalignment",
    "pad",
    "carried_by_guide",
    "centred_preload",
    "at",
];
const OF_AN_END: &[&str] = OF_A_SUPPORT.split_at(9).0;

/// One contact of a block.
pub(super) struct BlockEnd {
    values: ContactValues,
    carried_by_guide: bool,
    centred_preload: bool,
}

impl BlockEnd {
    /// Reads the properties that differ at an end.
    pub(super) fn new(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = given.cast::<PyMapping>().map_err(|_| {
            PyTypeError::new_err(format!("{name} must be a mapping, such as {name}={{\"mu\": 0.2}}"))
        })?;
        Self::of_keys(name, given, OF_AN_END)
    }

    fn of_keys(name: &str, given: &Bound<'_, PyMapping>, known: &[&str]) -> PyResult<Self> {
        for key in given.keys()? {
            let key: String = key
                .extract()
                .map_err(|_| PyTypeError::new_err(format!("the keys of {name} must be texts")))?;
            if !known.contains(&key.as_str()) {
                let meant = nearest(&key, known.iter().copied());
                let meant = meant.map_or_else(
                    || format!("it has {}", known.join(", ")),
                    |near| format!("did you mean {near:?}?"),
                );
                return Err(PyValueError::new_err(format!("{name} has no {key:?}; {meant}")));
            }
        }
        let of = |key: &str| if given.contains(key)? { given.get_item(key).map(Some) } else { Ok(None) };
        let flag = |key: &str| match of(key)? {
            None => Ok(false),
            Some(value) => match value.cast::<PyBool>() {
                Ok(value) => Ok(value.is_true()),
                Err(_) => Err(PyTypeError::new_err(format!("{name}[{key:?}] must be True or False"))),
            },
        };
        let [mu, mu_static, preload] = [of("mu")?, of("mu_static")?, of("preload")?];
        let [stiffness, play, misalignment] = [of("stiffness")?, of("play")?, of("misalignment")?];
        let values = [mu, mu_static, preload, stiffness, play, misalignment, of("pad")?];
        let values = values.each_ref().map(Option::as_ref);
        Ok(Self {
            values: ContactValues::new(|key| format!("{name}[{key:?}]"), values)?,
            carried_by_guide: flag("carried_by_guide")?,
            centred_preload: flag("centred_preload")?,
        })
    }

    pub(super) fn say(self, contact: &mut ContactBuilder<'_>) {
        let ContactValues { mu, mu_static, preload, stiffness, play, misalignment, pad } = self.values;
        match mu {
            Some(BySide::Both(mu)) => contact.mu(mu),
            Some(BySide::Each([plus, minus])) => contact.mu_by_side(plus, minus),
            None => contact,
        }
        .with(mu_static, ContactBuilder::mu_static)
        .with(stiffness, ContactBuilder::stiffness)
        .with(play, ContactBuilder::play)
        .with(misalignment, ContactBuilder::misalignment)
        .with(pad, ContactBuilder::pad)
        .when(self.carried_by_guide, ContactBuilder::carried_by_guide)
        .when(self.centred_preload, ContactBuilder::centred_preload);
        match preload {
            Some(BySide::Both(force)) => contact.preload(force),
            Some(BySide::Each([plus, minus])) => contact.preload_by_side(plus, minus),
            None => contact,
        };
    }
}

/// A further support of a block.
pub(super) struct Support {
    pub(super) name: String,
    pub(super) at: Quantity,
    pub(super) contact: BlockEnd,
}

impl Support {
    /// Those of the argument `supports`: a mapping for each name.
    pub(super) fn all(given: Given<'_, '_>) -> PyResult<Vec<Self>> {
        let Some(given) = given else { return Ok(Vec::new()) };
        let wanted = || {
            let example = "supports={\"middle\": {\"at\": 0.1}}";
            PyTypeError::new_err(format!("supports must be a mapping of mappings, such as {example}"))
        };
        let given = given.cast::<PyMapping>().map_err(|_| wanted())?;
        let mut supports = Vec::new();
        for entry in given.items()? {
            let (name, values): (String, Bound<'_, PyAny>) = entry.extract().map_err(|_| wanted())?;
            let values = values.cast::<PyMapping>().map_err(|_| wanted())?;
            let of = format!("supports[{name:?}]");
            if !values.contains("at")? {
                return Err(PyValueError::new_err(format!(
                    "{of} must have \"at\", its distance from the middle"
                )));
            }
            let at = quantity(&format!("{of}[\"at\"]"), &values.get_item("at")?)?;
            let contact = BlockEnd::of_keys(&of, values, &OF_A_SUPPORT)?;
            supports.push(Self { name, at, contact });
        }
        Ok(supports)
    }

    pub(super) fn say(self, slider: SliderBuilder<'_, kind::Block>) -> SliderBuilder<'_, kind::Block> {
        slider.support(&self.name, self.at, |contact| self.contact.say(contact))
    }
}

/// The properties that every sliding joint has.
pub(super) struct SliderValues {
    at: [Quantity; 2],
    along: Option<Quantity>,
    travel: Option<[Quantity; 2]>,
    restitution: Option<Quantity>,
    contacts: ContactValues,
}

impl SliderValues {
    /// `along`, `travel` and `restitution`, in this order.
    pub(super) fn new(
        at: &Bound<'_, PyAny>,
        given: [Given<'_, '_>; 3],
        contacts: [Given<'_, '_>; 7],
    ) -> PyResult<Self> {
        let [along, travel, restitution] = given;
        Ok(Self {
            at: pair("at", at)?,
            along: optional("along", along)?,
            travel: optional_pair("travel", travel)?,
            restitution: optional("restitution", restitution)?,
            contacts: ContactValues::new(str::to_owned, contacts)?,
        })
    }

    pub(super) fn say<K: OnLine>(self, slider: SliderBuilder<'_, K>) -> SliderBuilder<'_, K> {
        let ContactValues { mu, mu_static, preload, stiffness, play, misalignment, pad } = self.contacts;
        slider
            .at(self.at)
            .with(self.along, SliderBuilder::along)
            .with(self.travel, SliderBuilder::travel)
            .with(self.restitution, SliderBuilder::restitution)
            .with(mu, |slider, mu| match mu {
                BySide::Both(mu) => slider.mu(mu),
                BySide::Each([plus, minus]) => slider.mu_by_side(plus, minus),
            })
            .with(mu_static, SliderBuilder::mu_static)
            .with(preload, |slider, preload| match preload {
                BySide::Both(force) => slider.preload(force),
                BySide::Each([plus, minus]) => slider.preload_by_side(plus, minus),
            })
            .with(stiffness, SliderBuilder::stiffness)
            .with(play, SliderBuilder::play)
            .with(misalignment, SliderBuilder::misalignment)
            .with(pad, SliderBuilder::pad)
    }
}

/// The properties that every coordinate has.
pub(super) struct CoordinateValues {
    drawn_at: Option<Quantity>,
    value: Option<Quantity>,
    rate: Option<Quantity>,
}

impl CoordinateValues {
    pub(super) fn new(drawn_at: Given<'_, '_>, value: Given<'_, '_>, rate: Given<'_, '_>) -> PyResult<Self> {
        Ok(Self {
            drawn_at: optional("drawn_at", drawn_at)?,
            value: optional("value", value)?,
            rate: optional("rate", rate)?,
        })
    }

    pub(super) fn say(self, coordinate: CoordinateBuilder<'_>) -> CoordinateBuilder<'_> {
        coordinate
            .with(self.drawn_at, CoordinateBuilder::drawn_at)
            .with(self.value, CoordinateBuilder::value)
            .with(self.rate, CoordinateBuilder::rate)
    }
}

/// The acceleration of free fall.
pub(super) enum Gravity {
    /// Along -y.
    Down(Quantity),
    Components([Quantity; 2]),
}

impl Gravity {
    pub(super) fn new(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let is_one = given.is_instance_of::<PyString>() || given.len().is_err();
        if is_one {
            quantity("gravity", given).map(Self::Down)
        } else {
            pair("gravity", given).map(Self::Components)
        }
    }
}
