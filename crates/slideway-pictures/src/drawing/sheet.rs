//! A sheet: the mechanism, and beside it each of its solutions.

use super::forces::forces_on;
use super::loads::{LONGEST_ARROW, sample};
use super::panels::{Drawn, LONGEST_FORCE, LONGEST_HELD, MOST, Panel, Shown};
use super::paragraph::{LINE, beside, paragraph};
use super::scene::{Anchor, Bounds, Class, Point, Scene, Shape, Text};
use super::svg::{Colours, Frame};
use super::units::in_units_of;
use super::{NAME_SIZE, VALUE_SIZE, View, dimensions, quantity};
use crate::changes::changes_beside_state;
use crate::typeface::width;
use slideway::configuration::Configuration;
use slideway::fault::Faults;
use slideway::mechanism::Mechanism;
use slideway::model::Settings;
use slideway::report::{CoordinateState, Report, SolveReport};
use slideway::standstill::{AtRest, HoldReport};
use slideway::units::{Unit, Units};

/// Width and height for the mechanism itself in each panel, if it has no more contacts than this: with more it is
/// larger in proportion, up to twice that, as each contact has its forces with their values.
const PANEL: [f64; 2] = [440.0, 320.0];
const CONTACTS: f64 = 4.0;
/// Least width of a panel, for its caption.
const LEAST_WIDTH: f64 = 290.0;
/// Width that a row of panels of this size does not exceed if it has several.
const ROW: f64 = 1300.0;
/// So many panels may stand in one column, however wide they are.
const IN_A_COLUMN: usize = 3;
/// Space between panels, and around the sheet.
const SPACE: f64 = 30.0;
const MARGIN: f64 = 24.0;
/// By multiples of this a place grows that is held.
const STEP: f64 = SPACE;
/// The smallest part of its usual room that a mechanism has where drawings are narrow.
const LEAST_ROOM: f64 = 0.4;
/// By so much of it the room shrinks at least, until a drawing is narrow enough.
const LEAST_STEP: f64 = 0.05;

/// A sheet of drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Everything on it.
    pub scene: Scene,
    /// Its edges.
    pub bounds: Bounds,
    /// The title.
    pub title: String,
    /// A description in words of what is on it.
    pub description: String,
    /// The scale and the place that make another drawing comparable with this one; `None` for a key and for
    /// several drawings.
    pub held: Option<Held>,
    /// How many of the elements belong to the heading, and where that ends.
    heading: (usize, f64),
}

/// The scale of forces and the place of a drawing, which [`pieces`] keeps for another state of the same mechanism: so
/// arrows grow with forces, and what does not move stays where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// The force (N) whose arrow is as long as the longest of a drawing by itself; none where no force is to scale.
    pub longest_force: Option<f64>,
    /// The place that the drawing has. It grows where another needs more, and never shrinks.
    pub place: Bounds,
    /// The part of its usual width and height that the mechanism itself has in the drawing, so that this is narrow enough.
    pub room: f64,
}

impl Held {
    /// The place for a drawing that needs this one. It grows in steps: while an arrow grows little by little most drawings
    /// stay where they are.
    fn place_of(&self, wanted: Bounds) -> Bounds {
        let outwards = |excess: f64| STEP * (excess / STEP).ceil().max(0.0);
        let Bounds { least, greatest } = self.place;
        Bounds {
            least: least - (least - wanted.least).map(outwards),
            greatest: greatest + (wanted.greatest - greatest).map(outwards),
        }
    }
}

impl Sheet {
    /// How [`svg::write`](super::svg::write) shows the whole of it, with this width in pixels (by default one for each
    /// drawing unit) and these colours.
    pub fn frame(&self, width: Option<f64>, colours: Colours) -> Frame<'_> {
        Frame { bounds: self.bounds, title: &self.title, description: &self.description, width, colours }
    }

    /// The same, with what settings changed in its model, other than its state, below the title.
    #[must_use]
    pub fn changed_by(self, settings: &Settings) -> Self {
        let changes = changes_beside_state(settings);
        if changes.is_empty() { self } else { self.headed(&with_minus_signs(&format!("{changes}."))) }
    }

    /// Writes below the title the faults that keep it from showing a contact mode.
    #[must_use]
    pub fn unsolved(self, faults: &Faults) -> Self {
        let reasons: Vec<String> = faults.sorted().iter().map(|fault| fault.kind.to_string()).collect();
        self.headed(&with_minus_signs(&format!("Forces at contacts are not drawn: {}.", reasons.join("; "))))
    }

    /// The same, with a further paragraph at the end of the heading.
    fn headed(mut self, text: &str) -> Self {
        let (count, foot) = self.heading;
        let drawings = Scene { elements: self.scene.elements.split_off(count), ..Scene::default() };
        let width = self.bounds.size().x - 2.0 * MARGIN;
        let below = paragraph(&mut self.scene, text, VALUE_SIZE, Point::new(0.0, foot), width);
        self.heading = (self.scene.elements.len(), below);
        let by = Point::new(0.0, below - foot);
        self.scene.elements.extend(drawings.shifted(by).elements);
        self.bounds.greatest += by;
        self.description = format!("{text} {}", self.description);
        self
    }
}

/// Drawings of a mechanism and, if they were found, of its solutions or of the forces that hold it, side by side; none if
/// there is no solution of the wanted number.
///
/// ```
/// use slideway::{configuration::Configuration, mechanism::Mechanism, model::Model};
/// use slideway_pictures::drawing::{Forces, Shown, sheet};
///
/// let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
/// let model = Model::parse(text)?;
/// let mechanism = Mechanism::new(&model)?;
/// let configuration = Configuration::new(&mechanism)?;
/// let report = slideway::solve::solve(&model)?;
/// let forces = Some(Forces::InMotion(&report));
/// let sheet = sheet(&mechanism, &configuration, forces, Shown::All).expect("solutions are there");
/// assert!(sheet.description.contains("Solution 1 of 3"));
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn sheet(
    mechanism: &Mechanism,
    configuration: &Configuration,
    forces: Option<Forces<'_>>,
    shown: Shown,
) -> Option<Sheet> {
    let (report, rest) = answers(forces);
    let mechanism = &in_units_of(report, mechanism, configuration);
    let view = view(mechanism, configuration, 1.0);
    let drawn = Drawn { report, rest, ..Drawn::by_itself(mechanism, configuration, &view) };
    let mut panels = drawn.panels(shown)?;
    panels.extend(drawn.sections(shown));
    let lines = match forces {
        Some(Forces::InMotion(report)) => {
            vec![state_line(&report.state, &mechanism.units), with_minus_signs(&answer(report))]
        }
        Some(Forces::AtRest(report)) => vec![with_minus_signs(&format!("At rest: {}", report.answer()))],
        None => Vec::new(),
    };
    let description = described(&lines, &panels);
    let (title, forces_on) = (title(mechanism), forces_on(mechanism));
    Some(Layout { view: &view, mechanism, panels, title, lines, forces_on }.sheet(description))
}

/// Of which answer the forces are drawn.
#[derive(Debug, Clone, Copy)]
pub enum Forces<'r> {
    /// Those of each solution.
    InMotion(&'r SolveReport),
    /// Those that hold it at rest.
    AtRest(&'r HoldReport),
}

impl<'r> Forces<'r> {
    /// Those of the states that were found. Where there is no answer in motion, or it holds in a state that leaves its forces open,
    /// those that hold it.
    pub fn of(solved: Option<&'r SolveReport>, rest: Option<&'r HoldReport>) -> Option<Self> {
        let has_more = |rest: &&HoldReport| rest.at_rest.is_some() || solved.is_none();
        let rest = rest.filter(has_more).filter(|_| asks_for_rest(solved));
        rest.map(Self::AtRest).or_else(|| solved.map(Self::InMotion))
    }
}

/// Whether the forces to be drawn are those at rest: there is no answer in motion, or it is that it holds.
pub fn asks_for_rest(solved: Option<&SolveReport>) -> bool {
    solved.is_none_or(SolveReport::rests)
}

fn answers(forces: Option<Forces<'_>>) -> (Option<&SolveReport>, Option<&AtRest>) {
    match forces {
        Some(Forces::InMotion(report)) => (Some(report), None),
        Some(Forces::AtRest(report)) => (None, report.at_rest.as_ref()),
        None => (None, None),
    }
}

/// Draws each panel of a sheet by itself, with its caption, and at the end the key to the colours, for a page
/// that has the title and the state itself. Where something is held, solutions are drawn to its scale and in
/// its place; else no drawing is wider than `most` drawing units, as far as the mechanism can then be seen.
///
/// ```
/// use slideway::model::{Model, Settings};
/// use slideway::{configuration::Configuration, mechanism::Mechanism, solve::solve};
/// use slideway_pictures::drawing::{Forces, Held, Sheet, pieces};
///
/// let file = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
/// let drawn = |mu: &str, held: Option<&Held>| -> Result<Vec<Sheet>, slideway::fault::Faults> {
///     let model = file.with(&Settings::default().parameter("mu", mu))?;
///     let mechanism = Mechanism::new(&model)?;
///     let configuration = Configuration::new(&mechanism)?;
///     Ok(pieces(&mechanism, &configuration, Some(Forces::InMotion(&solve(&model)?)), held, f64::INFINITY))
/// };
/// // The mechanism itself, its solution, and the key.
/// let held = drawn("0.3", None)?[1].held;
/// let longest = |held: Option<Held>| held.and_then(|held| held.longest_force);
/// assert_eq!(longest(drawn("0.5", held.as_ref())?[1].held), longest(held));
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn pieces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    forces: Option<Forces<'_>>,
    held: Option<&Held>,
    most: f64,
) -> Vec<Sheet> {
    let (report, rest) = answers(forces);
    let mechanism = &in_units_of(report, mechanism, configuration);
    // Arrows grow little where it is narrow, and each way by steps.
    let (longest_held, growth) =
        if most.is_finite() { (LONGEST_ARROW, 2.0 * STEP) } else { (LONGEST_HELD, 0.0) };
    let within = |room: f64| {
        let view = view(mechanism, configuration, room);
        let longest_force = held.and_then(|held| held.longest_force);
        let by_itself = Drawn::by_itself(mechanism, configuration, &view);
        let drawn = Drawn { report, rest, longest_force, longest_held, ..by_itself };
        let panels = drawn.panels(Shown::All).unwrap_or_default();
        let (title, lines, forces_on) = (title(mechanism), Vec::new(), forces_on(mechanism));
        Layout { view: &view, mechanism, panels, title, lines, forces_on }.pieces(held, room)
    };
    let mut room = held.map_or(1.0, |held| held.room);
    let mut narrowest = (f64::INFINITY, Vec::new());
    loop {
        let pieces = within(room);
        let widest = pieces.iter().map(|sheet| sheet.bounds.size().x).fold(0.0, f64::max);
        // Where it is crowded labels stand farther outside: what is smaller is not always narrower.
        if narrowest.1.is_empty() || widest < narrowest.0 {
            narrowest = (widest, pieces);
        }
        let excess = (widest + growth - most) / usual_room(mechanism)[0];
        if held.is_some() || excess <= 0.0 || room <= LEAST_ROOM {
            return narrowest.1;
        }
        // One that is as high as its room is narrower than that: each step is one that can be seen.
        room = (room - excess.clamp(LEAST_STEP, 2.0 * LEAST_STEP)).max(LEAST_ROOM);
    }
}

/// Room for what each contact needs.
fn usual_room(mechanism: &Mechanism) -> [f64; 2] {
    let part = (mechanism.contacts.len() as f64 / CONTACTS).clamp(1.0, 2.0);
    PANEL.map(|side| part * side)
}

/// A view with a part of the usual room.
fn view(mechanism: &Mechanism, configuration: &Configuration, room: f64) -> View {
    View::fitting(mechanism, &[configuration], usual_room(mechanism).map(|side| room * side))
}

/// The title of a mechanism, or what stands for it.
pub fn title(mechanism: &Mechanism) -> String {
    mechanism.title.clone().unwrap_or_else(|| "A mechanism".to_owned())
}

/// The text with true minus signs before its numbers.
fn with_minus_signs(text: &str) -> String {
    let follows = text.chars().skip(1).map(Some).chain([None]);
    let sign = |(letter, next): (char, Option<char>)| match (letter, next) {
        ('-', Some(digit)) if digit.is_ascii_digit() => '\u{2212}',
        (letter, _) => letter,
    };
    text.chars().zip(follows).map(sign).collect()
}

/// "q = 0 m, rate 1 m/s"
fn state_line(state: &[CoordinateState], units: &Units) -> String {
    let coordinates = state.iter().map(|coordinate| {
        format!(
            "{} = {}, rate {}",
            coordinate.name,
            quantity(coordinate.value, &units.of(coordinate.unit)),
            quantity(coordinate.rate, &units.of_rate(coordinate.unit))
        )
    });
    coordinates.collect::<Vec<_>>().join("; ")
}

/// Says how many solutions there are, and how many of them are drawn.
pub(crate) fn answer(report: &SolveReport) -> String {
    let drawn = report.solutions.len() + report.preload_gap_states.len();
    let partial = if report.partial { " The search ended early: there may be more." } else { "" };
    let first = if drawn > MOST { format!(" The first {MOST} are drawn.") } else { String::new() };
    format!("{}{partial}{first}", report.verdict_in_words())
}

fn described(lines: &[String], panels: &[Panel]) -> String {
    let captions = panels.iter().map(|panel| panel.caption.in_words());
    lines.iter().cloned().chain(captions).collect::<Vec<_>>().join(" ")
}

struct Layout<'a> {
    view: &'a View,
    mechanism: &'a Mechanism,
    panels: Vec<Panel>,
    title: String,
    lines: Vec<String>,
    forces_on: &'static str,
}

impl Layout<'_> {
    fn sheet(self, description: String) -> Sheet {
        let picture = self.picture();
        let panel_width = picture.size().x.max(LEAST_WIDTH);
        let columns = columns(self.panels.len(), panel_width, self.row());
        let row_width = columns as f64 * (panel_width + SPACE) - SPACE;
        let mut scene = Scene::default();
        let mut y = paragraph(&mut scene, &self.title, 20.0, Point::new(0.0, 0.0), row_width);
        for line in &self.lines {
            y = paragraph(&mut scene, line, VALUE_SIZE, Point::new(0.0, y), row_width);
        }
        let heading = (scene.elements.len(), y);
        for row in self.panels.chunks(columns) {
            let picture = bounds_of(row).map_or(picture, |bounds| picture.with_heights_of(&bounds));
            let mut below: f64 = 0.0;
            for (column, panel) in row.iter().enumerate() {
                let corner = Point::new(column as f64 * (panel_width + SPACE), y + 14.0);
                below = below.max(self.panel(&mut scene, panel, &picture, corner));
            }
            y = below + 8.0;
        }
        y = key(&mut scene, y, row_width, self.forces_on);
        let bounds = Bounds { least: Point::zeros(), greatest: Point::new(row_width, y) }.widened(MARGIN);
        Sheet { scene, bounds, title: self.title, description, held: None, heading }
    }

    /// Each panel by itself, and the key.
    fn pieces(self, held: Option<&Held>, room: f64) -> Vec<Sheet> {
        let wanted = self.picture();
        let picture = held.map_or(wanted, |held| held.place_of(wanted));
        let width = picture.size().x.max(LEAST_WIDTH);
        let mut all = Scene::default();
        let sheet = |scene: Scene, foot: f64, (title, description): (&str, String), held: Option<Held>| {
            let frame =
                Bounds { least: Point::zeros(), greatest: Point::new(width, foot) }.widened(0.5 * SPACE);
            // Nothing that is drawn is cut off.
            let (bounds, title) = (scene.bounds().map_or(frame, |drawn| frame.with(drawn)), title.to_owned());
            Sheet { scene, bounds, title, description, held, heading: (0, 0.0) }
        };
        let piece = |panel: &Panel| {
            // What is wanted grows once: else one answer would ask for more place than it shows.
            let own = bounds_of(std::slice::from_ref(panel));
            let own = own.map_or(wanted, |bounds| wanted.with_heights_of(&bounds));
            let picture = held.map_or(own, |held| held.place_of(own));
            let mut scene = Scene::default();
            let foot = self.panel(&mut scene, panel, &picture, Point::zeros());
            all.elements.extend(scene.elements.iter().cloned());
            let longest_force = panel.force_scale.map(|scale| LONGEST_FORCE / scale);
            let longest_force = held.and_then(|held| held.longest_force).or(longest_force);
            let held = Held { longest_force, place: picture, room };
            let words = (&*panel.caption.heading, panel.caption.in_words());
            sheet(scene, foot, words, Some(held))
        };
        let mut pieces: Vec<Sheet> = self.panels.iter().map(piece).collect();
        let drawn = all.elements.len();
        let foot = key(&mut all, 0.0, width, self.forces_on);
        let key = Scene { elements: all.elements.split_off(drawn), ..Scene::default() };
        if !key.elements.is_empty() {
            pieces.push(sheet(key, foot, ("Key", "What the colours of arrows mean".to_owned()), None));
        }
        pieces
    }

    /// Width that a row does not exceed if it has several panels. Where panels are so many that one column of them is taller
    /// than a screen it grows as they do; fewer stay as large as they can be on a page.
    fn row(&self) -> f64 {
        if self.panels.len() > IN_A_COLUMN { ROW * usual_room(self.mechanism)[0] / PANEL[0] } else { ROW }
    }

    /// The place that every picture has.
    fn picture(&self) -> Bounds {
        bounds_of(&self.panels)
            .unwrap_or(Bounds { least: Point::zeros(), greatest: Point::new(LEAST_WIDTH, LEAST_WIDTH) })
    }

    /// Adds a drawing with what stands below it; the y below that.
    fn panel(&self, scene: &mut Scene, panel: &Panel, picture: &Bounds, corner: Point) -> f64 {
        let width = picture.size().x.max(LEAST_WIDTH);
        let scale = panel.scale.unwrap_or(self.view.scale);
        let length = nice(0.45 * picture.size().x.min(PANEL[0]) / scale, &self.mechanism.units.of("m"));
        let free = 0.5 * (width - picture.size().x);
        let by = corner + Point::new(free, 0.0) - picture.least;
        scene.elements.extend(panel.scene.clone().shifted(by).elements);
        let mut foot = corner.y + picture.size().y + 26.0;
        self.legend(scene, panel, (length, length * scale), Point::new(corner.x, foot));
        foot += 16.0;
        let heading = &panel.caption.heading;
        foot = paragraph(scene, heading, NAME_SIZE + 1.0, Point::new(corner.x, foot), width);
        for line in &panel.caption.lines {
            foot = paragraph(scene, line, VALUE_SIZE, Point::new(corner.x, foot), width);
        }
        table(scene, &panel.caption.table, Point::new(corner.x, foot))
    }

    /// Bars of a length (m), which is so long in the drawing, and of a force.
    fn legend(&self, scene: &mut Scene, panel: &Panel, (length, drawn): (f64, f64), corner: Point) {
        let from = corner + Point::new(1.0, 0.0);
        let mut right = from.x + drawn;
        for line in dimensions::scale_bar(from, drawn) {
            scene.add(Class::Edge, Shape::Line(line));
        }
        right = beside(scene, Point::new(right, corner.y), quantity(length, &self.mechanism.units.of("m")));
        if let Some(scale) = panel.force_scale {
            let unit = self.mechanism.units.of("N");
            let force = nice(0.7 * LONGEST_FORCE / scale, &unit);
            let from = Point::new(right + 26.0, corner.y);
            let to = from + Point::new(force * scale, 0.0);
            let shows = |class: &Class| panel.scene.elements.iter().any(|element| element.class == *class);
            let class = [Class::Reaction, Class::PinForce].into_iter().find(shows).unwrap_or(Class::Load);
            scene.add(class, Shape::Arrow { from, to });
            beside(scene, to, quantity(force, &unit));
        }
    }
}

/// Writes a table below a place, each column as wide as its widest entry; the y below it.
fn table(scene: &mut Scene, rows: &[[String; 4]], corner: Point) -> f64 {
    let widest = |column: usize| rows.iter().map(|row| width(&row[column], VALUE_SIZE)).fold(0.0, f64::max);
    let mut at = corner;
    for column in 0..4 {
        at.y = corner.y;
        for row in rows {
            at.y += LINE * VALUE_SIZE;
            let text = row[column].clone();
            scene.write(Class::Words, Text { text, at, anchor: Anchor::Start, size: VALUE_SIZE });
        }
        at.x += widest(column) + 18.0;
    }
    at.y
}

/// The bounds of all pictures.
fn bounds_of(panels: &[Panel]) -> Option<Bounds> {
    panels.iter().filter_map(|panel| panel.scene.bounds()).reduce(Bounds::with)
}

/// So many columns that rows are not too long, and about equally filled.
fn columns(count: usize, width: f64, row: f64) -> usize {
    let mut columns = 1;
    while columns < count && (columns + 1) as f64 * (width + SPACE) - SPACE <= row {
        columns += 1;
    }
    let rows = count.div_ceil(columns).max(1);
    count.div_ceil(rows).max(1)
}

/// Draws the key to the colours, and returns the y below it.
fn key(scene: &mut Scene, y: f64, most: f64, forces_on: &str) -> f64 {
    let words = [
        (Class::Reaction, format!("normal reaction on {forces_on}")),
        (Class::Friction, format!("friction on {forces_on}")),
        (Class::ContactForce, format!("force on {forces_on}, within its friction cone")),
        (Class::JammedCorner, "contact that presses".to_owned()),
        (Class::Cone, "friction cone of a contact at rest".to_owned()),
        (Class::PinForce, "force of a pin, tangent to its friction circle".to_owned()),
        (Class::Load, "load, weight or drive".to_owned()),
        (Class::Drive, "drive, its size unknown".to_owned()),
        (Class::PointsOut, "force out of the drawing".to_owned()),
        (Class::PointsIn, "force into the drawing".to_owned()),
        (Class::Velocity, "sliding velocity".to_owned()),
        (Class::Opening, "contact that lifts off, acceleration of its gap".to_owned()),
        (Class::Break, "not to scale".to_owned()),
    ];
    let occurs = |class: &Class| scene.elements.iter().any(|element| element.class == *class);
    let mut used: Vec<_> = words.into_iter().filter(|(class, _)| occurs(class)).collect();
    // Where friction locks, the force says what its cone is.
    if occurs(&Class::ContactForce) {
        used.retain(|(class, _)| *class != Class::Cone);
    }
    // They have one colour, and so one entry.
    if [Class::Reaction, Class::PinForce].iter().all(occurs) {
        used.retain(|(class, _)| *class != Class::PinForce);
        used[0].1.push_str("; force of a pin");
    }
    let mut corner = Point::new(0.0, y + 18.0);
    for (class, text) in &used {
        let total = 40.0 + width(text, VALUE_SIZE);
        if corner.x > 0.0 && corner.x + total > most {
            corner = Point::new(0.0, corner.y + LINE * VALUE_SIZE);
        }
        sample(*class, corner, 28.0).into_iter().for_each(|shape| scene.add(*class, shape));
        let end = beside(scene, corner + Point::new(26.0, 0.0), text.clone());
        corner.x = end + 26.0;
    }
    if used.is_empty() { y } else { corner.y + 8.0 }
}

/// The greatest of 1, 2, 5 times a power of ten of a unit that is not above a positive value.
pub(crate) fn nice(value: f64, unit: &Unit) -> f64 {
    let value = unit.number_of(value);
    if !(value.is_finite() && value > 0.0) {
        return unit.scale();
    }
    let power = 10.0_f64.powf(value.log10().floor());
    [5.0, 2.0, 1.0]
        .into_iter()
        .map(|part| part * power)
        .find(|nice| *nice <= value * (1.0 + 1e-9))
        .unwrap_or(power)
        * unit.scale()
}
