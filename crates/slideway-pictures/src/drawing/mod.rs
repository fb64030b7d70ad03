//! Drawings of mechanisms, to scale, with their contact modes exaggerated.
//!
//! [`scene`] turns a mechanism in a configuration into a list of shapes; [`sheet`] puts a drawing of the
//! mechanism and one of each solution side by side; [`svg`] writes either.
//!
//! Real guides have hardly any play, so that a tipped block looks like any other. A drawing of a contact mode
//! widens the guides by a few units and moves the whole mechanism so that each block lies on the faces that
//! it touches ([`slideway::configuration::Configuration::displaced`]). Guides that share a load are drawn with
//! their own play, misalignment and deflections, all magnified alike.

mod bodies;
mod dimensions;
mod faces;
mod forces;
mod hidden;
mod hinges;
mod jam;
mod labels;
mod loads;
mod looks;
mod obstacles;
mod outline;
mod panels;
mod paragraph;
mod play;
mod scene;
mod section;
mod sheet;
mod slide;
mod sliders;
mod stops;
pub mod svg;
mod units;
mod view;

pub use hinges::PinForce;
pub use panels::{Caption, Panel, Shown};
pub use scene::{Anchor, Bounds, Class, Element, Point, Scene, Shape, Text};
pub use sheet::{Forces, Held, Sheet, asks_for_rest, pieces, sheet, title};
pub use view::View;

pub(crate) use forces::forces_on;
pub(crate) use loads::sample;
pub(crate) use panels::{EXAGGERATED, scale_of_circles};
pub(crate) use sheet::{answer, nice};

use labels::Label;
use looks::{Look, looks};
use play::Play;
use slide::Slide;
use slideway::configuration::Configuration;
use slideway::ids::JointId;
use slideway::mechanism::{Contact, Mechanism};
use slideway::report::{Rejection, Solution};
use slideway::solve::Locking;
use slideway::standstill::{AtRest, Range};
use slideway::units::Unit;

/// Size of names.
pub(crate) const NAME_SIZE: f64 = 15.0;
/// Size of values.
pub(crate) const VALUE_SIZE: f64 = 14.0;

/// The state of the contacts that is drawn, and the efforts of the drives.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactStates {
    /// One for each contact, in the order of the mechanism.
    pub(crate) contacts: Vec<ContactState>,
    /// The effort of each drive (N or N m).
    pub(crate) efforts: Vec<f64>,
    /// The forces of hinges with friction.
    pub(crate) pins: Vec<PinForce>,
}

/// How a contact is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactState {
    /// Where the block lies in its play: 1 if the normal force is positive, -1 if it is negative, 0 in the
    /// middle.
    pub(crate) side: f64,
    /// Its forces, if they are known.
    pub(crate) forces: Option<ContactForces>,
    /// By how much the block is displaced against its guide, towards +n (m), if that is known: where redundant
    /// contacts share a load.
    pub(crate) deflection: Option<f64>,
    /// The acceleration of its gap (m/s^2), if it lifts off.
    pub(crate) gap_acceleration: Option<f64>,
    /// Whether such a contact touches neither face.
    pub(crate) is_open: bool,
}

/// Forces of a contact on its block; signs as in theory, section 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForces {
    /// Normal force along n (N).
    pub(crate) normal: f64,
    /// Friction force, positive against positive sliding (N).
    pub(crate) friction: f64,
    /// Couple of a guided slider about the middle of the pressed face (N m).
    pub(crate) couple: f64,
    /// By how much normal force and friction may differ from these to either side (N), as at rest; else 0.
    pub(crate) spread: [f64; 2],
}

impl ContactStates {
    /// Returns the states of the contacts and drives in a solution.
    pub fn of(solution: &Solution) -> Self {
        let state = |(contact, sign): (&slideway::report::Contact, char)| ContactState {
            side: f64::from(contact.side),
            forces: Some(ContactForces {
                normal: contact.normal_force,
                friction: contact.friction_force,
                couple: contact.couple.unwrap_or(0.0),
                spread: [0.0; 2],
            }),
            deflection: contact.deflection,
            gap_acceleration: contact.gap_acceleration,
            is_open: contact.deflection.is_some() && sign == '0',
        };
        Self {
            contacts: solution.contacts.iter().zip(solution.pattern.chars()).map(state).collect(),
            efforts: solution.drives.iter().map(|drive| drive.effort).collect(),
            pins: PinForce::of(solution),
        }
    }

    /// Returns the states that lock a mechanism: forces of which only the proportions are known.
    pub fn locked(locking: &Locking) -> Self {
        let Locking { normal_forces, friction_forces, couples, efforts, .. } = locking;
        let contacts = contacts([normal_forces, friction_forces, couples]).collect();
        Self { contacts, efforts: efforts.clone(), pins: Vec::new() }
    }

    /// A solution of the equations in which a guided slider would tip.
    pub fn tipping(rejection: &Rejection) -> Self {
        let Rejection { normal_forces, friction_forces, couples, efforts, .. } = rejection;
        let contacts = contacts([normal_forces, friction_forces, couples]).collect();
        Self { contacts, efforts: efforts.clone(), pins: Vec::new() }
    }

    /// Returns the states at rest: the middle of each range of forces. One that may act either way, or is without bound, is left
    /// out.
    pub fn at_rest(mechanism: &Mechanism, rest: &AtRest) -> Self {
        let state = |contact: &Contact| {
            let found = rest.reactions.contacts.iter().find(|one| *one.name == *contact.name);
            let one_way = |range: Range| one_way(range).unwrap_or_default();
            let [normal, friction] =
                found.map_or([[0.0; 2]; 2], |one| [one.normal_force, one.friction_force].map(one_way));
            let spread = [normal[1], friction[1]];
            let forces = ContactForces { normal: normal[0], friction: friction[0], couple: 0.0, spread };
            let side = if forces.normal == 0.0 { 0.0 } else { forces.normal.signum() };
            ContactState { side, forces: Some(forces), ..ContactState::default() }
        };
        Self { contacts: mechanism.contacts.iter().map(state).collect(), ..Self::default() }
    }

    fn side(&self, contact: usize) -> f64 {
        self.contacts.get(contact).map_or(0.0, |state| state.side.clamp(-1.0, 1.0))
    }
}

/// The middle of a range of one sign, and half its width.
fn one_way(range: Range) -> Option<[f64; 2]> {
    let (least, greatest) = range.least.zip(range.greatest)?;
    (least * greatest >= 0.0).then_some([f64::midpoint(least, greatest), 0.5 * (greatest - least)])
}

/// Contacts with these normal forces, friction forces and couples.
fn contacts([normal, friction, couples]: [&Vec<f64>; 3]) -> impl Iterator<Item = ContactState> {
    normal.iter().zip(friction).zip(couples).map(|((&normal, &friction), &couple)| ContactState {
        side: if normal == 0.0 { 0.0 } else { normal.signum() },
        forces: Some(ContactForces { normal, friction, couple, spread: [0.0; 2] }),
        ..ContactState::default()
    })
}

/// Options of a scene: the things that it shows beside the mechanism itself.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each stands for one kind of thing, whatever the others are"
)]
#[derive(Debug, Clone, PartialEq)]
pub struct SceneOptions {
    /// Guides are widened, and blocks lie on the faces that their contacts touch.
    pub play: bool,
    /// Names of joints; one that slides has its name at its velocity.
    pub names: bool,
    /// Values of forces, velocities and dimensions.
    pub values: bool,
    /// Lengths and heights of blocks.
    pub dimensions: bool,
    /// Drawing units for a newton: forces of contacts, loads and drives are drawn to this scale. Without it
    /// loads are arrows of one length.
    pub force_scale: Option<f64>,
    /// Greatest length of an arrow that is to scale; a longer one is drawn so long, with two strokes.
    pub longest_arrow: f64,
    /// Sliding velocities.
    pub velocities: bool,
    /// The forces of contacts and drives alone, without values, as what locks the mechanism: those of contacts within
    /// their friction cones.
    pub locking: bool,
    /// Labels are kept within these bounds, and left out if they find no place.
    pub within: Option<Bounds>,
}

/// A mechanism in a configuration, as shapes around the middle of the view.
///
/// ```
/// use slideway::{configuration::Configuration, mechanism::Mechanism, model::Model};
/// use slideway_pictures::drawing::{ContactStates, SceneOptions, View, scene};
///
/// let text = slideway::gallery::find("drawer").expect("in the gallery").text;
/// let mechanism = Mechanism::new(&Model::parse(text)?)?;
/// let configuration = Configuration::new(&mechanism)?;
/// let view = View::fitting(&mechanism, &[&configuration], [400.0, 300.0]);
/// let scene = scene(&mechanism, &configuration, &ContactStates::default(), &view, &SceneOptions::overview());
/// assert!(scene.texts().any(|(_, text)| text.text.starts_with("guide")));
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn scene(
    mechanism: &Mechanism,
    configuration: &Configuration,
    states: &ContactStates,
    view: &View,
    options: &SceneOptions,
) -> Scene {
    let looks = looks(mechanism, states);
    let play = Play { mechanism, configuration, states, view, looks: &looks };
    let played = if options.play { play.displaced() } else { None };
    let is_exaggerated = played.is_some() && play.gaps().any(|gap| gap > 0.0);
    let magnification = played.as_ref().and_then(|played| played.magnification);
    let mut painter = Painter {
        mechanism,
        actual: configuration,
        configuration: played.as_ref().map_or(configuration, |played| &played.configuration),
        play: played.as_ref().map(|played| played.part),
        magnification,
        states,
        view,
        options,
        looks,
        sliders: Vec::new(),
        scene: Scene { is_exaggerated, magnification, ..Scene::default() },
        labels: Vec::new(),
    };
    painter.sliders = painter.slides();
    painter.bodies();
    painter.joints();
    painter.connections();
    if options.locking {
        painter.jam();
    } else if options.force_scale.is_some() {
        painter.contact_forces();
        painter.pin_forces();
        painter.open_contacts();
        painter.openings();
    }
    painter.gaps();
    painter.loads();
    if options.dimensions {
        painter.dimensions();
    }
    if options.velocities {
        painter.velocities();
    }
    let Painter { scene, labels, .. } = painter;
    labels::labelled(scene, labels, options.within)
}

impl SceneOptions {
    /// The mechanism with its names, dimensions and loads.
    pub fn overview() -> Self {
        Self {
            play: false,
            names: true,
            values: true,
            dimensions: true,
            force_scale: None,
            longest_arrow: loads::LONGEST_ARROW,
            velocities: true,
            locking: false,
            within: None,
        }
    }

    /// The forces of contacts and drives that lock a mechanism, so many drawing units for a newton.
    pub fn locking(force_scale: f64) -> Self {
        Self { locking: true, velocities: false, ..Self::contact_mode(force_scale) }
    }

    /// A contact mode with its forces, `force_scale` drawing units for a newton.
    pub fn contact_mode(force_scale: f64) -> Self {
        Self {
            play: true,
            names: false,
            dimensions: false,
            force_scale: Some(force_scale),
            ..Self::overview()
        }
    }
}

/// A scene that is being drawn.
struct Painter<'a> {
    mechanism: &'a Mechanism,
    /// The state itself, and with the play of a contact mode.
    actual: &'a Configuration,
    configuration: &'a Configuration,
    /// Part of the full play; nothing where no contact mode is shown.
    play: Option<f64>,
    /// By how much guides that share a load have their play, misalignment and deflections magnified.
    magnification: Option<f64>,
    states: &'a ContactStates,
    view: &'a View,
    options: &'a SceneOptions,
    /// The appearances of the joints.
    looks: Vec<Look>,
    /// The sliding joints, by the index of the joint.
    sliders: Vec<Option<Slide>>,
    scene: Scene,
    labels: Vec<Label>,
}

impl Painter<'_> {
    fn line(&mut self, class: Class, places: Vec<Point>) {
        self.scene.add(class, Shape::Line(places));
    }

    fn area(&mut self, class: Class, places: Vec<Point>) {
        self.scene.add(class, Shape::Area(places));
    }

    fn circle(&mut self, class: Class, centre: Point, radius: f64) {
        self.scene.add(class, Shape::Circle(centre, radius));
    }

    /// A name beside a place.
    fn name(&mut self, text: &str, anchor: Point, towards: Point) {
        if self.options.names {
            let (class, text, reach) = (Class::Words, text.to_owned(), Point::zeros());
            self.labels.push(Label { class, text, size: NAME_SIZE, anchor, reach, towards });
        }
    }

    /// A value beside a place.
    fn value(&mut self, class: Class, text: String, anchor: Point, towards: Point) {
        self.value_along(class, text, [anchor, anchor], towards);
    }

    /// A value beside an arrow or a dimension.
    fn value_along(&mut self, class: Class, text: String, [from, to]: [Point; 2], towards: Point) {
        if self.options.values {
            let (anchor, reach) = (0.5 * (from + to), 0.5 * (to - from));
            self.labels.push(Label { class, text, size: VALUE_SIZE, anchor, reach, towards });
        }
    }

    /// Lines across the outer side of a straight line of ground, which is to the left of the way from `from`
    /// to `to` as one looks at the drawing.
    fn hatching(&mut self, from: Point, to: Point) {
        const SPACING: f64 = 7.0;
        const DEPTH: f64 = 7.0;
        let along = outline::unit(to - from, Point::x());
        let out = Point::new(along.y, -along.x);
        // Feet are at places of the drawing, whatever line they belong to: where lines overlap they are the same.
        let [start, end] = [from, to].map(|place| place.dot(&along) / SPACING);
        let first = (start - 0.5).ceil() + 0.5;
        let count = (end - first).floor().clamp(-1.0, 400.0) + 1.0;
        let mut feet: Vec<f64> = std::iter::successors(Some(0.0), |index| Some(index + 1.0))
            .take_while(|index| *index < count)
            .map(|index| (first + index - start) * SPACING)
            .collect();
        if feet.is_empty() {
            feet.push(0.5 * (to - from).norm());
        }
        for foot in feet {
            let foot = from + along * foot;
            let line = Shape::Line(vec![foot, foot + (out - along) * DEPTH]);
            self.scene.add(Class::Hatch, line);
        }
    }

    /// A value in the unit of the model for quantities with this SI unit; a force, which stands alone, in another one that was
    /// typed, or the SI unit, where it reads better.
    fn shown(&self, value: f64, si: &str) -> String {
        let units = &self.mechanism.units;
        let unit = if si == "N" { units.clone().suited_to_most(si, &[value]).of(si) } else { units.of(si) };
        quantity(value, &unit)
    }

    /// The sign of a force out of the drawing, a dot in a ring, or into it, a cross, and its value.
    fn out_of_drawing(&mut self, class: Class, place: Point, is_out: bool, text: String) {
        for shape in loads::sign_of_z(class, place, is_out) {
            self.scene.elements.push(shape);
        }
        let reach = Point::new(loads::RING, 0.0);
        self.value_along(class, text, [place - reach, place + reach], Point::new(0.0, -1.0));
    }

    fn slide(&self, joint: JointId) -> Option<Slide> {
        self.sliders.get(joint.index()).cloned().flatten()
    }
}

/// An SI value in a unit, with four significant digits.
pub(crate) fn quantity(value: f64, unit: &Unit) -> String {
    let number = number(unit.number_of(value));
    if unit.name().is_empty() { number } else { format!("{number} {}", unit.name()) }
}

/// Two SI values in a unit: "716.2 to 791.5 N", "716.2 N" where they do not differ.
fn between(ends: [f64; 2], unit: &Unit) -> String {
    let [least, greatest] = ends.map(|end| number(unit.number_of(end)));
    if least == greatest {
        quantity(ends[0], unit)
    } else {
        format!("{least} to {}", quantity(ends[1], unit))
    }
}

/// The signs of a pattern one by one, with true minus signs.
pub(crate) fn signs(pattern: &str) -> String {
    let signs: Vec<String> = pattern.chars().map(String::from).collect();
    signs.join(" ").replace('-', "\u{2212}")
}

/// Four significant digits, with a true minus sign.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    let text = if size == 0.0 || !size.is_finite() {
        slideway::report::precise(value)
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.3e}")
    } else {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 6")]
        let decimals = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    text.replace('-', "\u{2212}")
}
