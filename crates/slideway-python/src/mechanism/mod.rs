//! The class `slideway.Mechanism`: a mechanism that is put together in code, over [`slideway::Drawing`].
//!
//! Arguments are converted before anything is added, and what is added is added as a whole: after an exception
//! the mechanism is as it was before.
//!
//! # Files
//! `values.rs` is what the methods take, `state.rs` the mechanism with its names.

mod state;
mod values;

use crate::arguments::{pair, quantity};
use crate::model::Model;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use slideway::drawing::{
    BodyBuilder, CoordinateBuilder, DriveBuilder, ForceBuilder, LoadBuilder, SliderBuilder,
};
pub(crate) use state::GROUND;
use state::{State, found};
use std::borrow::Cow;
use std::sync::Mutex;
use values::{
    BlockEnd, BodyValues, CoordinateValues, End, Gravity, Said, SliderValues, Support, optional,
    optional_pair,
};

#[doc = include_str!("../../docs/mechanism/class.txt")]
#[pyclass(frozen, module = "slideway", name = "Mechanism")]
pub(crate) struct Mechanism {
    state: Mutex<State>,
}

#[pymethods]
impl Mechanism {
    #[new]
    #[pyo3(signature = (title: "str | None" = None, *, gravity: "Value | Pair | None" = None,
        time: "Value | None" = None))]
    fn new(
        title: Option<&str>,
        gravity: Option<&Bound<'_, PyAny>>,
        time: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut state = State::default();
        if let Some(title) = title {
            state.drawing.title(title);
        }
        match gravity.map(Gravity::new).transpose()? {
            Some(Gravity::Down(magnitude)) => state.drawing.gravity(magnitude),
            Some(Gravity::Components(components)) => state.drawing.gravity_components(components),
            None => &mut state.drawing,
        };
        if let Some(time) = optional("time", time)? {
            state.drawing.time(time);
        }
        Ok(Self { state: Mutex::new(state) })
    }

    #[doc = include_str!("../../docs/mechanism/parameter.txt")]
    #[pyo3(signature = (name: "str", value: "Value") -> "str")]
    fn parameter(&self, py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
        let value = quantity("value", value)?;
        self.add(py, ("parameter", name), |state| {
            state.drawing.parameter(name, value);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/body.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", *, mass: "Value | None" = None, inertia: "Value | None" = None,
        centre: "Pair | None" = None, rectangle: "Pair | None" = None, disc: "Value | None" = None,
        bar: "Sequence[Pair] | NDArray[np.floating] | None" = None,
        outline: "Sequence[Pair] | NDArray[np.floating] | None" = None,
        massless: "bool" = false) -> "str")]
    fn body(
        &self,
        py: Python<'_>,
        name: &str,
        mass: Option<&Bound<'_, PyAny>>,
        inertia: Option<&Bound<'_, PyAny>>,
        centre: Option<&Bound<'_, PyAny>>,
        rectangle: Option<&Bound<'_, PyAny>>,
        disc: Option<&Bound<'_, PyAny>>,
        bar: Option<&Bound<'_, PyAny>>,
        outline: Option<&Bound<'_, PyAny>>,
        massless: bool,
    ) -> PyResult<String> {
        let values = BodyValues::new([mass, inertia, disc], [centre, rectangle], [bar, outline])?;
        self.add(py, ("body", name), |state| {
            let id = values.say(state.drawing.body(name)).when(massless, BodyBuilder::massless).id();
            state.bodies.push((name.to_owned(), id));
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/hinge.txt")]
    #[pyo3(signature = (name: "str", first: "str", second: "str", at: "Pair") -> "str")]
    fn hinge(
        &self,
        py: Python<'_>,
        name: &str,
        first: &str,
        second: &str,
        at: &Bound<'_, PyAny>,
    ) -> PyResult<String> {
        let at = pair("at", at)?;
        self.add(py, ("joint", name), |state| {
            let [first, second] = state.frames(["first", "second"], [first, second])?;
            state.drawing.hinge(name, first, second).at(at);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/block_slider.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", block: "str", guide: "str", *, at: "Pair", length: "Value",
        along: "Value | None" = None, height: "Value | None" = None, around: "bool" = false,
        travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu: "Value | BySide | None" = None, mu_static: "Value | None" = None,
        preload: "Value | BySide | None" = None, centred_preload: "bool" = false,
        stiffness: "Value | None" = None, play: "Value | None" = None, loose: "Value | None" = None,
        misalignment: "Value | None" = None, pad: "Pair | None" = None,
        front: "ContactValues | None" = None, rear: "ContactValues | None" = None,
        supports: "Mapping[str, SupportValues] | None" = None) -> "str")]
    fn block_slider(
        &self,
        py: Python<'_>,
        name: &str,
        block: &str,
        guide: &str,
        at: &Bound<'_, PyAny>,
        length: &Bound<'_, PyAny>,
        along: Option<&Bound<'_, PyAny>>,
        height: Option<&Bound<'_, PyAny>>,
        around: bool,
        travel: Option<&Bound<'_, PyAny>>,
        restitution: Option<&Bound<'_, PyAny>>,
        mu: Option<&Bound<'_, PyAny>>,
        mu_static: Option<&Bound<'_, PyAny>>,
        preload: Option<&Bound<'_, PyAny>>,
        centred_preload: bool,
        stiffness: Option<&Bound<'_, PyAny>>,
        play: Option<&Bound<'_, PyAny>>,
        loose: Option<&Bound<'_, PyAny>>,
        misalignment: Option<&Bound<'_, PyAny>>,
        pad: Option<&Bound<'_, PyAny>>,
        front: Option<&Bound<'_, PyAny>>,
        rear: Option<&Bound<'_, PyAny>>,
        supports: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [mu, mu_static, preload, stiffness, play, misalignment, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        let (length, height) = (quantity("length", length)?, optional("height", height)?);
        let loose = optional("loose", loose)?;
        let front = front.map(|front| BlockEnd::new("front", front)).transpose()?;
        let rear = rear.map(|rear| BlockEnd::new("rear", rear)).transpose()?;
        let supports = Support::all(supports)?;
        self.add_slider(py, (name, ["block", "guide"], [block, guide]), |drawing, [block, guide]| {
            let slider = values.say(drawing.block_slider(name, block, guide)).length(length);
            let slider = slider
                .with(height, SliderBuilder::height)
                .with(loose, SliderBuilder::loose)
                .when(around, SliderBuilder::around)
                .when(centred_preload, SliderBuilder::centred_preload)
                .with(front, |slider, front| slider.front(|contact| front.say(contact)))
                .with(rear, |slider, rear| slider.rear(|contact| rear.say(contact)));
            supports.into_iter().fold(slider, |slider, support| support.say(slider)).id()
        })
    }

    #[doc = include_str!("../../docs/mechanism/guided_slider.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", block: "str", guide: "str", *, at: "Pair", length: "Value",
        mu: "Value | BySide", along: "Value | None" = None, height: "Value | None" = None,
        around: "bool" = false, travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu_static: "Value | None" = None, preload: "Value | BySide | None" = None,
        centred_preload: "bool" = false, stiffness: "Value | None" = None,
        play: "Value | None" = None, loose: "Value | None" = None, misalignment: "Value | None" = None,
        pad: "Pair | None" = None) -> "str")]
    fn guided_slider(
        &self,
        py: Python<'_>,
        name: &str,
        block: &str,
        guide: &str,
        at: &Bound<'_, PyAny>,
        length: &Bound<'_, PyAny>,
        mu: &Bound<'_, PyAny>,
        along: Option<&Bound<'_, PyAny>>,
        height: Option<&Bound<'_, PyAny>>,
        around: bool,
        travel: Option<&Bound<'_, PyAny>>,
        restitution: Option<&Bound<'_, PyAny>>,
        mu_static: Option<&Bound<'_, PyAny>>,
        preload: Option<&Bound<'_, PyAny>>,
        centred_preload: bool,
        stiffness: Option<&Bound<'_, PyAny>>,
        play: Option<&Bound<'_, PyAny>>,
        loose: Option<&Bound<'_, PyAny>>,
        misalignment: Option<&Bound<'_, PyAny>>,
        pad: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [Some(mu), mu_static, preload, stiffness, play, misalignment, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        let (length, height) = (quantity("length", length)?, optional("height", height)?);
        let loose = optional("loose", loose)?;
        self.add_slider(py, (name, ["block", "guide"], [block, guide]), |drawing, [block, guide]| {
            let slider = values.say(drawing.guided_slider(name, block, guide)).length(length);
            slider
                .with(height, SliderBuilder::height)
                .with(loose, SliderBuilder::loose)
                .when(around, SliderBuilder::around)
                .when(centred_preload, SliderBuilder::centred_preload)
                .id()
        })
    }

    #[doc = include_str!("../../docs/mechanism/pin_in_slot.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", pin: "str", slot: "str", *, at: "Pair", mu: "Value | BySide",
        along: "Value | None" = None, travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu_static: "Value | None" = None, preload: "Value | BySide | None" = None,
        stiffness: "Value | None" = None, play: "Value | None" = None, loose: "Value | None" = None,
        misalignment: "Value | None" = None, pad: "Pair | None" = None) -> "str")]
    fn pin_in_slot(
        &self,
        py: Python<'_>,
        name: &str,
        pin: &str,
        slot: &str,
        at: &Bound<'_, PyAny>,
        mu: &Bound<'_, PyAny>,
        along: Option<&Bound<'_, PyAny>>,
        travel: Option<&Bound<'_, PyAny>>,
        restitution: Option<&Bound<'_, PyAny>>,
        mu_static: Option<&Bound<'_, PyAny>>,
        preload: Option<&Bound<'_, PyAny>>,
        stiffness: Option<&Bound<'_, PyAny>>,
        play: Option<&Bound<'_, PyAny>>,
        loose: Option<&Bound<'_, PyAny>>,
        misalignment: Option<&Bound<'_, PyAny>>,
        pad: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [Some(mu), mu_static, preload, stiffness, play, misalignment, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        let loose = optional("loose", loose)?;
        self.add_slider(py, (name, ["pin", "slot"], [pin, slot]), |drawing, [pin, slot]| {
            values.say(drawing.pin_in_slot(name, pin, slot)).with(loose, SliderBuilder::loose).id()
        })
    }

    #[doc = include_str!("../../docs/mechanism/force.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", body: "str", *, at: "Pair", components: "Pair | None" = None,
        magnitude: "Value | None" = None, direction: "Value | None" = None, turning: "bool" = false,
        reaction: "str | None" = None) -> "str")]
    fn force(
        &self,
        py: Python<'_>,
        name: &str,
        body: &str,
        at: &Bound<'_, PyAny>,
        components: Option<&Bound<'_, PyAny>>,
        magnitude: Option<&Bound<'_, PyAny>>,
        direction: Option<&Bound<'_, PyAny>>,
        turning: bool,
        reaction: Option<&str>,
    ) -> PyResult<String> {
        let (at, components) = (pair("at", at)?, optional_pair("components", components)?);
        let (magnitude, direction) = (optional("magnitude", magnitude)?, optional("direction", direction)?);
        self.add(py, ("load", name), |state| {
            let (body, reaction) = (state.frame("body", body)?, state.reaction(reaction)?);
            let force = state.drawing.force(name, body).at(at);
            let force = force.with(components, ForceBuilder::components);
            let force =
                force.with(magnitude, ForceBuilder::magnitude).with(direction, ForceBuilder::direction);
            force.when(turning, ForceBuilder::turning).with(reaction, ForceBuilder::reaction);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/torque.txt")]
    #[pyo3(signature = (name: "str", body: "str", moment: "Value", *, reaction: "str | None" = None) -> "str")]
    fn torque(
        &self,
        py: Python<'_>,
        name: &str,
        body: &str,
        moment: &Bound<'_, PyAny>,
        reaction: Option<&str>,
    ) -> PyResult<String> {
        let moment = quantity("moment", moment)?;
        self.add(py, ("load", name), |state| {
            let (body, reaction) = (state.frame("body", body)?, state.reaction(reaction)?);
            state.drawing.torque(name, body, moment).with(reaction, LoadBuilder::reaction);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/spring.txt")]
    #[pyo3(signature = (name: "str", first: "End", second: "End", *, stiffness: "Value",
        free_length: "Value | None" = None) -> "str")]
    fn spring(
        &self,
        py: Python<'_>,
        name: &str,
        first: &Bound<'_, PyAny>,
        second: &Bound<'_, PyAny>,
        stiffness: &Bound<'_, PyAny>,
        free_length: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let ends = [End::new("first", first)?, End::new("second", second)?];
        let stiffness = quantity("stiffness", stiffness)?;
        let free_length = optional("free_length", free_length)?;
        self.add(py, ("load", name), |state| {
            let ends = state.ends(ends)?;
            state.drawing.spring(name, ends, stiffness).with(free_length, LoadBuilder::free_length);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/damper.txt")]
    #[pyo3(signature = (name: "str", first: "End", second: "End", *, damping: "Value") -> "str")]
    fn damper(
        &self,
        py: Python<'_>,
        name: &str,
        first: &Bound<'_, PyAny>,
        second: &Bound<'_, PyAny>,
        damping: &Bound<'_, PyAny>,
    ) -> PyResult<String> {
        let ends = [End::new("first", first)?, End::new("second", second)?];
        let damping = quantity("damping", damping)?;
        self.add(py, ("load", name), |state| {
            let ends = state.ends(ends)?;
            state.drawing.damper(name, ends, damping);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/torsional_spring.txt")]
    #[pyo3(signature = (name: "str", first: "str", second: "str", *, stiffness: "Value",
        free_angle: "Value | None" = None) -> "str")]
    fn torsional_spring(
        &self,
        py: Python<'_>,
        name: &str,
        first: &str,
        second: &str,
        stiffness: &Bound<'_, PyAny>,
        free_angle: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let stiffness = quantity("stiffness", stiffness)?;
        let free_angle = optional("free_angle", free_angle)?;
        self.add(py, ("load", name), |state| {
            let between = state.frames(["first", "second"], [first, second])?;
            let spring = state.drawing.torsional_spring(name, between, stiffness);
            spring.with(free_angle, LoadBuilder::free_angle);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/torsional_damper.txt")]
    #[pyo3(signature = (name: "str", first: "str", second: "str", *, damping: "Value") -> "str")]
    fn torsional_damper(
        &self,
        py: Python<'_>,
        name: &str,
        first: &str,
        second: &str,
        damping: &Bound<'_, PyAny>,
    ) -> PyResult<String> {
        let damping = quantity("damping", damping)?;
        self.add(py, ("load", name), |state| {
            let between = state.frames(["first", "second"], [first, second])?;
            state.drawing.torsional_damper(name, between, damping);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/slide.txt")]
    #[pyo3(signature = (name: "str", slider: "str", *, drawn_at: "Value | None" = None,
        value: "Value | None" = None, rate: "Value | None" = None) -> "str")]
    fn slide(
        &self,
        py: Python<'_>,
        name: &str,
        slider: &str,
        drawn_at: Option<&Bound<'_, PyAny>>,
        value: Option<&Bound<'_, PyAny>>,
        rate: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let values = CoordinateValues::new(drawn_at, value, rate)?;
        self.add(py, ("coordinate", name), |state| {
            let slider = found(&state.sliders, ("sliding joint", "slider"), slider)?;
            let id = values.say(state.drawing.slide(name, slider)).id();
            state.coordinates.push((name.to_owned(), id));
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/rotation.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", body: "str", *, relative_to: "str | None" = None,
        drawn_at: "Value | None" = None, value: "Value | None" = None, rate: "Value | None" = None) -> "str")]
    fn rotation(
        &self,
        py: Python<'_>,
        name: &str,
        body: &str,
        relative_to: Option<&str>,
        drawn_at: Option<&Bound<'_, PyAny>>,
        value: Option<&Bound<'_, PyAny>>,
        rate: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let values = CoordinateValues::new(drawn_at, value, rate)?;
        self.add(py, ("coordinate", name), |state| {
            let body = state.frame("body", body)?;
            let other = relative_to.map(|other| state.frame("relative_to", other)).transpose()?;
            let rotation = values.say(state.drawing.rotation(name, body));
            let id = rotation.with(other, CoordinateBuilder::relative_to).id();
            state.coordinates.push((name.to_owned(), id));
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/drive_by_force.txt")]
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", coordinate: "str", body: "str", *, at: "Pair", direction: "Value",
        acceleration: "Value | None" = None, turning: "bool" = false, reaction: "str | None" = None) -> "str")]
    fn drive_by_force(
        &self,
        py: Python<'_>,
        name: &str,
        coordinate: &str,
        body: &str,
        at: &Bound<'_, PyAny>,
        direction: &Bound<'_, PyAny>,
        acceleration: Option<&Bound<'_, PyAny>>,
        turning: bool,
        reaction: Option<&str>,
    ) -> PyResult<String> {
        let (at, direction) = (pair("at", at)?, quantity("direction", direction)?);
        let acceleration = optional("acceleration", acceleration)?;
        self.add(py, ("drive", name), |state| {
            let coordinate = found(&state.coordinates, ("coordinate", "coordinate"), coordinate)?;
            let (body, reaction) = (state.frame("body", body)?, state.reaction(reaction)?);
            let drive = state.drawing.drive_by_force(name, coordinate, (body, at, direction));
            let drive = drive.with(acceleration, DriveBuilder::acceleration);
            drive.when(turning, DriveBuilder::turning).with(reaction, DriveBuilder::reaction);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/drive_by_torque.txt")]
    #[pyo3(signature = (name: "str", coordinate: "str", body: "str", *, acceleration: "Value | None" = None,
        reaction: "str | None" = None) -> "str")]
    fn drive_by_torque(
        &self,
        py: Python<'_>,
        name: &str,
        coordinate: &str,
        body: &str,
        acceleration: Option<&Bound<'_, PyAny>>,
        reaction: Option<&str>,
    ) -> PyResult<String> {
        let acceleration = optional("acceleration", acceleration)?;
        self.add(py, ("drive", name), |state| {
            let coordinate = found(&state.coordinates, ("coordinate", "coordinate"), coordinate)?;
            let (body, reaction) = (state.frame("body", body)?, state.reaction(reaction)?);
            let drive = state.drawing.drive_by_torque(name, coordinate, body);
            drive.with(acceleration, DriveBuilder::acceleration).with(reaction, DriveBuilder::reaction);
            Ok(())
        })
    }

    #[doc = include_str!("../../docs/mechanism/to_toml.txt")]
    fn to_toml(&self) -> String {
        self.state().drawing.to_toml()
    }

    #[doc = include_str!("../../docs/mechanism/build.txt")]
    fn build(&self, py: Python<'_>) -> PyResult<Model> {
        Model::new(py, &self.to_toml())
    }

    fn __repr__(&self) -> String {
        let state = self.state();
        let told = |(what, name): &(Cow<'_, str>, String)| format!("{what} {name}");
        let names: Vec<String> = state.names.iter().map(told).collect();
        let names = if names.is_empty() { "empty".to_owned() } else { names.join(", ") };
        format!("<slideway.Mechanism: {names}>")
    }

    fn __copy__(&self) -> Self {
        Self { state: Mutex::new(self.state()) }
    }

    #[pyo3(signature = (_memo: "object") -> "Mechanism")]
    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.__copy__()
    }

    #[pyo3(signature = () -> "tuple[object, ...]")]
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (py.get_type::<Self>().getattr("_restore")?, (self.state().kept()?,)).into_pyobject(py)
    }

    /// The mechanism that was pickled.
    #[staticmethod]
    fn _restore(kept: &str) -> PyResult<Self> {
        Ok(Self { state: Mutex::new(State::restored(kept)?) })
    }
}
