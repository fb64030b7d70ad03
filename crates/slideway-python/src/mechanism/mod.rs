//! The class `slideway.Mechanism`: a mechanism that is put together in code, over [`Drawing`].
//!
//! Arguments are converted before anything is added, and what is added is added as a whole: after an exception
//! the mechanism is as it was before.
//!
//! # Files
//! `values.rs` is what the methods take, `state.rs` the mechanism with its names.

mod state;
mod values;

use crate::arguments::{pair, quantity, sequence, two};
use crate::fault::Texts;
use crate::model::Model;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use slideway::Drawing;
use slideway::drawing::{
    BlockSlider, BodyBuilder, CoordinateBuilder, DriveBuilder, ForceBuilder, LoadBuilder, SingleSlider,
    SliderBuilder, SliderHandle,
};
use slideway::ids::{Frame, JointId};
use slideway::model::Settings;
pub(crate) use state::GROUND;
use state::{Refused, State, found};
use std::sync::{Mutex, PoisonError};
use values::{BlockEnd, CoordinateValues, End, Gravity, Said, SliderValues, optional, optional_pair};

/// A mechanism that is put together in code.
///
/// It says what a model file says, with the same defaults and meaning, and `build` gives the `Model`. Bodies,
/// joints and coordinates are added before others refer to them by their names, which the methods return.
/// Values are numbers in SI units, or texts with a unit or an expression of parameters. Places are those of the
/// drawing, in its fixed axes (m).
///
/// Parameters
/// ----------
/// title : str, optional
///     One line that says what the mechanism is.
/// gravity : float or str or pair, optional
///     Acceleration of free fall along -y, or its two components (m/s^2). Default: none.
/// time : float or str, optional
///     Time of the state, `t` in expressions (s). Default: 0.
///
/// Examples
/// --------
/// A drawer of 2 kg in a rail, pushed beside its middle:
///
/// >>> from slideway import GROUND, Mechanism
/// >>> m = Mechanism("Drawer")
/// >>> mu = m.parameter("mu", 0.3)
/// >>> drawer = m.body("drawer", mass=2.0, centre=(0, 0.1), inertia=0.05)
/// >>> rail = m.block_slider("rail", drawer, GROUND, at=(0, 0), length="400 mm", mu=mu)
/// >>> push = m.force("push", drawer, at=(-0.2, 0.15), components=(20, 0))
/// >>> x = m.slide("x", rail, rate=1.0)
/// >>> model = m.build()
/// >>> model.solve().status
/// 'one'
/// >>> model.with_(mu=3).solve().status
/// 'none'
#[pyclass(frozen, module = "slideway", name = "Mechanism")]
pub(crate) struct Mechanism {
    state: Mutex<State>,
}

impl Mechanism {
    fn state(&self) -> State {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Adds a thing of this name. Nothing of Python may run in `add`: the mechanism is locked meanwhile.
    fn add(
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
    fn add_slider<S: SliderHandle + Into<JointId>>(
        &self,
        py: Python<'_>,
        (name, arguments, frames): (&str, [&str; 2], [&str; 2]),
        slider: impl FnOnce(&mut Drawing, [Frame; 2]) -> S,
    ) -> PyResult<String> {
        self.add(py, ("joint", name), |state| {
            let frames = state.frames(arguments, frames)?;
            let joint = slider(&mut state.drawing, frames).into();
            state.sliders.push((name.to_owned(), joint));
            Ok(())
        })
    }
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

    /// Adds a named number, for expressions and for `Model.with_`.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// value : float or str
    ///     Such as `0.3` or `"25 mm"`.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
    ///
    /// Examples
    /// --------
    /// >>> import slideway
    /// >>> m = slideway.Mechanism()
    /// >>> m.parameter("L", "400 mm")
    /// 'L'
    #[pyo3(signature = (name: "str", value: "Value") -> "str")]
    fn parameter(&self, py: Python<'_>, name: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
        let value = quantity("value", value)?;
        self.add(py, ("parameter", name), |state| {
            state.drawing.parameter(name, value);
            Ok(())
        })
    }

    /// Adds a rigid body.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// mass : float or str
    ///     Greater than zero (kg).
    /// inertia : float or str
    ///     Moment of inertia about the centre of mass (kg m^2). In its place a homogeneous shape can be given:
    ///     `rectangle`, `disc` or `bar`.
    /// centre : pair
    ///     Centre of mass in the drawing (m).
    /// rectangle : pair
    ///     Width and height of a homogeneous rectangle about the centre of mass (m).
    /// disc : float or str
    ///     Radius of a homogeneous disc about the centre of mass (m).
    /// bar : pair of pairs
    ///     The ends of a thin bar in the drawing (m), in place of a centre of mass, too.
    /// outline : sequence of pairs
    ///     The corners of a polygon in the drawing (m), at least three: what it looks like.
    /// massless : bool
    ///     A body without mass.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
    ///
    /// Examples
    /// --------
    /// >>> import slideway
    /// >>> m = slideway.Mechanism()
    /// >>> m.body("rod", mass="0.5 kg", bar=((0, 0), (0, "200 mm")))
    /// 'rod'
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
        let (mass, inertia) = (optional("mass", mass)?, optional("inertia", inertia)?);
        let (centre, rectangle) = (optional_pair("centre", centre)?, optional_pair("rectangle", rectangle)?);
        let disc = optional("disc", disc)?;
        let bar = bar.map(|ends| two("bar", ends, "places")).transpose()?;
        let bar =
            bar.map(|[one, other]| Ok::<_, PyErr>([pair("bar", &one)?, pair("bar", &other)?])).transpose()?;
        let corner = |corner: &Bound<'_, PyAny>| pair("outline", corner);
        let corners = outline.map(|corners| sequence("outline", corners, "places")).transpose()?;
        let corners =
            corners.map(|corners| corners.iter().map(corner).collect::<PyResult<Vec<_>>>()).transpose()?;
        self.add(py, ("body", name), |state| {
            let body = state.drawing.body(name);
            let body = body.with(mass, BodyBuilder::mass).with(inertia, BodyBuilder::inertia);
            let body = body.with(centre, BodyBuilder::centre).with(rectangle, BodyBuilder::rectangle);
            let body = body.with(disc, BodyBuilder::disc).with(bar, BodyBuilder::bar);
            let body = body.with(corners, BodyBuilder::outline).when(massless, BodyBuilder::massless);
            let id = body.id();
            state.bodies.push((name.to_owned(), id));
            Ok(())
        })
    }

    /// Adds a frictionless hinge between two bodies, or a body and `GROUND`.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// first, second : str
    ///     Its bodies. The hinge force is counted on the first.
    /// at : pair
    ///     Its place in the drawing (m).
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a block slider: a carriage, sledge or bushing with a contact at each end.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// block, guide : str
    ///     Its bodies; either can be `GROUND`.
    /// at : pair
    ///     Middle of the block in the drawing (m).
    /// length : float or str
    ///     Distance of its contacts (m).
    /// along : float or str
    ///     Direction of positive sliding: the angle from the x axis (rad). Default: 0.
    /// height : float or str
    ///     Distance of the two rubbing faces (m). Default: 0.
    /// around : bool
    ///     The block surrounds the guide, as a sleeve its rod. Default: it is inside.
    /// travel : pair
    ///     Limits of the displacement (m).
    /// restitution : float or str
    ///     Stops at both ends of the travel, with this coefficient of restitution from 0 to 1.
    /// mu : float or str or mapping
    ///     Coefficient of kinetic friction; `{"plus": 0.2, "minus": 0.3}` for positive and for negative normal
    ///     force. Every contact needs one, here or in `front` and `rear`.
    /// mu_static : float or str
    ///     Coefficient of static friction. Default: that of kinetic friction.
    /// preload : float or str or mapping
    ///     Friction at zero normal force (N), by side as for `mu`. Default: 0.
    /// centred_preload : bool
    ///     The preload's friction acts on the centre line. Default: at the pressed face.
    /// stiffness : float or str
    ///     Stiffness of the guide at a contact (N/m), for attainability.
    /// pad : pair
    ///     Length and width of the area in contact at a contact (m), for the bearing pressure.
    /// front, rear : mapping
    ///     What differs at the end in the direction of `along`, or at the other: `mu`, `mu_static`, `preload`,
    ///     `stiffness`, `pad`, `centred_preload`, and `carried_by_guide`, for a contact that stays at a place of
    ///     the guide.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
    ///
    /// Raises
    /// ------
    /// ModelError
    ///     There is no such body.
    ///
    /// Examples
    /// --------
    /// >>> import slideway
    /// >>> m = slideway.Mechanism()
    /// >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0.1))
    /// >>> m.block_slider("rail", drawer, slideway.GROUND, at=(0, 0), length=0.4, mu=0.2, front={"mu": 0.3})
    /// 'rail'
    /// >>> m.block_slider("other", "drawr", slideway.GROUND, at=(0, 0), length=0.4, mu=0.2)
    /// Traceback (most recent call last):
    ///     ...
    /// slideway._errors.ModelError: argument block: there is no body named `drawr`
    ///     hint: did you mean `drawer`?
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", block: "str", guide: "str", *, at: "Pair", length: "Value",
        along: "Value | None" = None, height: "Value | None" = None, around: "bool" = false,
        travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu: "Value | BySide | None" = None, mu_static: "Value | None" = None,
        preload: "Value | BySide | None" = None, centred_preload: "bool" = false,
        stiffness: "Value | None" = None, pad: "Pair | None" = None,
        front: "ContactValues | None" = None, rear: "ContactValues | None" = None) -> "str")]
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
        pad: Option<&Bound<'_, PyAny>>,
        front: Option<&Bound<'_, PyAny>>,
        rear: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [mu, mu_static, preload, stiffness, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        let (length, height) = (quantity("length", length)?, optional("height", height)?);
        let front = front.map(|front| BlockEnd::new("front", front)).transpose()?;
        let rear = rear.map(|rear| BlockEnd::new("rear", rear)).transpose()?;
        self.add_slider(py, (name, ["block", "guide"], [block, guide]), |drawing, [block, guide]| {
            let slider = values.say(drawing.block_slider(name, block, guide)).length(length);
            slider
                .with(height, SliderBuilder::<BlockSlider>::height)
                .when(around, SliderBuilder::<BlockSlider>::around)
                .when(centred_preload, SliderBuilder::<BlockSlider>::centred_preload)
                .with(front, |slider, front| slider.front(|contact| front.say(contact)))
                .with(rear, |slider, rear| slider.rear(|contact| rear.say(contact)))
                .id()
        })
    }

    /// Adds a guided slider: it is pressed on one side along its whole length, with one normal force and a couple.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// block, guide : str
    ///     Its bodies; either can be `GROUND`.
    /// at, length, along, height, around, travel, restitution, mu, mu_static, preload, centred_preload, stiffness, pad
    ///     As for `block_slider`; `length` is that of the pressed face.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", block: "str", guide: "str", *, at: "Pair", length: "Value",
        mu: "Value | BySide", along: "Value | None" = None, height: "Value | None" = None,
        around: "bool" = false, travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu_static: "Value | None" = None, preload: "Value | BySide | None" = None,
        centred_preload: "bool" = false, stiffness: "Value | None" = None,
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
        pad: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [Some(mu), mu_static, preload, stiffness, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        let (length, height) = (quantity("length", length)?, optional("height", height)?);
        self.add_slider(py, (name, ["block", "guide"], [block, guide]), |drawing, [block, guide]| {
            let slider = values.say(drawing.guided_slider(name, block, guide)).length(length);
            slider
                .with(height, SliderBuilder::<SingleSlider<true>>::height)
                .when(around, SliderBuilder::<SingleSlider<true>>::around)
                .when(centred_preload, SliderBuilder::<SingleSlider<true>>::centred_preload)
                .id()
        })
    }

    /// Adds a pin of the first body in a slot of the second: one contact.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// pin, slot : str
    ///     Its bodies; either can be `GROUND`.
    /// at : pair
    ///     The pin in the drawing (m).
    /// along, travel, restitution, mu, mu_static, preload, stiffness, pad
    ///     As for `block_slider`; `along` is the direction of the slot.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
    #[expect(clippy::too_many_arguments, reason = "arguments of Python, by name")]
    #[pyo3(signature = (name: "str", pin: "str", slot: "str", *, at: "Pair", mu: "Value | BySide",
        along: "Value | None" = None, travel: "Pair | None" = None, restitution: "Value | None" = None,
        mu_static: "Value | None" = None, preload: "Value | BySide | None" = None,
        stiffness: "Value | None" = None, pad: "Pair | None" = None) -> "str")]
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
        pad: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let contacts = [Some(mu), mu_static, preload, stiffness, pad];
        let values = SliderValues::new(at, [along, travel, restitution], contacts)?;
        self.add_slider(py, (name, ["pin", "slot"], [pin, slot]), |drawing, [pin, slot]| {
            values.say(drawing.pin_in_slot(name, pin, slot)).id()
        })
    }

    /// Adds a force on a body.
    ///
    /// Parameters
    /// ----------
    /// name, body : str
    /// at : pair
    ///     Where it acts, as a place of the drawing that moves with the body (m).
    /// components : pair
    ///     Its components (N), or else:
    /// magnitude, direction : float or str
    ///     Its magnitude (N), and its angle from the x axis (rad).
    /// turning : bool
    ///     It turns with the body. Default: its direction is fixed in space.
    /// reaction : str
    ///     The opposite force acts on this body at the same place. Default: on none.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a torque on a body.
    ///
    /// Parameters
    /// ----------
    /// name, body : str
    /// moment : float or str
    ///     Counter-clockwise positive (N m).
    /// reaction : str
    ///     The opposite torque acts on this body. Default: on none.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a linear spring.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// first, second : pair
    ///     Its ends, each a body and a place of the drawing that moves with it: `("drawer", (0, 0.1))`.
    /// stiffness : float or str
    ///     In N/m.
    /// free_length : float or str
    ///     Its length without force (m). Default: that in the drawing.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a linear damper.
    ///
    /// Parameters
    /// ----------
    /// name : str
    /// first, second : pair
    ///     Its ends, each a body and a place of the drawing that moves with it.
    /// damping : float or str
    ///     In N s/m.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a torsional spring between two bodies.
    ///
    /// Parameters
    /// ----------
    /// name, first, second : str
    /// stiffness : float or str
    ///     In N m per rad.
    /// free_angle : float or str
    ///     The rotation of the first body against the second at which it has no torque, from the drawing (rad).
    ///     Default: 0.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Adds a torsional damper between two bodies.
    ///
    /// Parameters
    /// ----------
    /// name, first, second : str
    /// damping : float or str
    ///     In N m s per rad.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Chooses the displacement of a block against its guide as a coordinate.
    ///
    /// Parameters
    /// ----------
    /// name, slider : str
    /// drawn_at : float or str
    ///     Its value in the drawing (m). Default: 0.
    /// value : float or str
    ///     Its value in the state (m). Default: that in the drawing.
    /// rate : float or str
    ///     Its rate of change in the state (m/s). Default: 0.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Chooses the rotation of a body as a coordinate.
    ///
    /// Parameters
    /// ----------
    /// name, body : str
    /// relative_to : str
    ///     The body against which it is counted. Default: ground.
    /// drawn_at, value : float or str
    ///     Its values in the drawing and in the state (rad), as for `slide`.
    /// rate : float or str
    ///     Its rate of change in the state (rad/s). Default: 0.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Prescribes the motion of a coordinate by an unknown force on a body.
    ///
    /// Parameters
    /// ----------
    /// name, coordinate, body : str
    /// at : pair
    ///     Where the force acts, as a place of the drawing that moves with the body (m).
    /// direction : float or str
    ///     Its angle from the x axis (rad).
    /// acceleration : float or str
    ///     The prescribed acceleration of the coordinate (m/s^2 or rad/s^2). Default: 0.
    /// turning : bool
    ///     The direction turns with the body. Default: it is fixed in space.
    /// reaction : str
    ///     The opposite force acts on this body. Default: on none.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// Prescribes the motion of a coordinate by an unknown torque on a body.
    ///
    /// Parameters
    /// ----------
    /// name, coordinate, body : str
    /// acceleration : float or str
    ///     The prescribed acceleration of the coordinate (m/s^2 or rad/s^2). Default: 0.
    /// reaction : str
    ///     The opposite torque acts on this body. Default: on none.
    ///
    /// Returns
    /// -------
    /// str
    ///     The name.
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

    /// The model file that says the same.
    ///
    /// Returns
    /// -------
    /// str
    ///     TOML, which `Model.parse` and the command line read.
    ///
    /// Examples
    /// --------
    /// >>> import slideway
    /// >>> m = slideway.Mechanism("Nothing yet", gravity=9.81)
    /// >>> print(m.to_toml(), end="")
    /// title = "Nothing yet"
    /// gravity = 9.81
    fn to_toml(&self) -> String {
        self.state().drawing.to_toml()
    }

    /// The model.
    ///
    /// Returns
    /// -------
    /// Model
    ///
    /// Raises
    /// ------
    /// ModelError
    ///     With everything that is wrong; lines and columns are those of `to_toml()`.
    fn build(&self, py: Python<'_>) -> PyResult<Model> {
        Model::new(py, &self.to_toml())
    }

    fn __repr__(&self) -> String {
        let state = self.state();
        let told = |(what, name): &(&str, String)| format!("{what} {name}");
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
}
