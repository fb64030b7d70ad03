//! A sheet: the mechanism, and beside it each of its solutions.

use super::forces::forces_on;
use super::loads::broken;
use super::paragraph::{LINE, beside, paragraph};
use super::scene::{Anchor, Bounds, Class, Point, Scene, Shape, Text};
use super::svg::{Colours, Frame};
use super::units::{in_units_of, known_forces};
use super::{
    ContactStates, NAME_SIZE, SceneOptions, VALUE_SIZE, View, dimensions, number, quantity, scene, signs,
};
use crate::plot::figure::changes;
use crate::typeface::width;
use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::model::Settings;
use slideway::report::{CoordinateState, JointMode, Solution, SolveReport};
use slideway::solve::{Locking, locking};
use slideway::units::{Unit, Units};

/// Width and height for the mechanism itself in each panel, if it has no more contacts than this: with more it is
/// larger in proportion, up to twice that, as each contact has its forces with their values.
const PANEL: [f64; 2] = [440.0, 320.0];
const CONTACTS: f64 = 4.0;
/// Least width of a panel, for its caption.
const LEAST_WIDTH: f64 = 290.0;
/// Width that a row of panels does not exceed if it has several.
const ROW: f64 = 1300.0;
/// The most solutions that are drawn.
const MOST: usize = 24;
/// Length of the longest arrow of a force, and to which it may grow at a scale that is held.
const LONGEST_FORCE: f64 = 76.0;
const LONGEST_HELD: f64 = 3.0 * LONGEST_FORCE;
/// Space between panels, and around the sheet.
const SPACE: f64 = 30.0;
const MARGIN: f64 = 24.0;

/// What is said of a picture whose guides have play that can be seen.
pub(crate) const EXAGGERATED: &str = "The play in the guides is exaggerated.";

/// By how much play and what else is small are magnified in a drawing, in words.
fn scale_of_play(scene: &Scene) -> Option<String> {
    let Some(magnification) = scene.magnification else {
        return scene.is_exaggerated.then(|| EXAGGERATED.to_owned());
    };
    let times = number(magnification);
    let others = if scene.is_exaggerated { "; the play of the other guides is exaggerated" } else { "" };
    Some(format!("Play, misalignment and deflections are drawn {times} times as large as they are{others}."))
}

/// How large friction circles are drawn, in words.
pub(crate) fn scale_of_circles(magnification: f64) -> String {
    if magnification == 1.0 {
        return "Friction circles are to scale.".to_owned();
    }
    format!("Friction circles are drawn {} times as large as they are.", number(magnification))
}

/// A table of the pins with friction, a row for each: its name, its force, its friction couple, and on what both act.
fn pins(solution: &Solution, mechanism: &Mechanism) -> Vec<[String; 4]> {
    let [force, moment] = ["N", "N m"].map(|unit| mechanism.units.of(unit));
    let one = |hinge: &slideway::report::Hinge| {
        let friction = hinge.friction?;
        let size = quantity(hinge.force[0].hypot(hinge.force[1]), &force);
        let couple = quantity(friction.couple.abs(), &moment);
        Some([hinge.name.clone(), size, couple, hinge.on.clone()])
    };
    let pins: Vec<[String; 4]> = solution.hinges.iter().filter_map(one).collect();
    let heading = ["pin", "force", "friction couple", "on"].map(str::to_owned);
    let heading = Some(heading).filter(|_| !pins.is_empty());
    heading.into_iter().chain(pins).collect()
}

/// "guide tipped: lower right, upper left"
fn joint_modes(joints: &[JointMode]) -> impl Iterator<Item = String> {
    joints.iter().map(|joint| format!("{} {}", joint.name, joint.mode))
}

/// Which solutions are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// All, beside the mechanism itself.
    All,
    /// None: the mechanism alone.
    Mechanism,
    /// The solution of this number, counted from 1, alone.
    Solution(usize),
    /// The state of a preload gap of this number, counted from 1, alone.
    GapState(usize),
}

/// What is written below a panel.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Caption {
    /// Its first line.
    pub heading: String,
    /// What follows.
    pub lines: Vec<String>,
    /// A table below: a row for each pin with friction, after one of headings.
    pub table: Vec<[String; 4]>,
}

/// One drawing of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The drawing.
    pub scene: Scene,
    /// What is written below it.
    pub caption: Caption,
    /// Drawing units for a newton, if its forces are to scale.
    pub force_scale: Option<f64>,
}

/// A sheet of drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Everything on it.
    pub scene: Scene,
    /// Its edges.
    pub bounds: Bounds,
    /// What it shows.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What another drawing needs to be comparable with this one; none of a key and of several drawings.
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
}

impl Sheet {
    /// How [`svg::write`](super::svg::write) shows the whole of it, with this width in pixels (by default one for each
    /// drawing unit) and these colours.
    pub fn frame(&self, width: Option<f64>, colours: Colours) -> Frame<'_> {
        Frame { bounds: self.bounds, title: &self.title, description: &self.description, width, colours }
    }

    /// The same, with what settings changed in its model below the title.
    #[must_use]
    pub fn changed_by(self, settings: &Settings) -> Self {
        let changes = changes(settings);
        if changes.is_empty() { self } else { self.headed(&format!("{changes}.")) }
    }

    /// The same, with the reasons below the title why it shows no contact mode.
    #[must_use]
    pub fn unsolved(self, reasons: &[String]) -> Self {
        self.headed(&format!("Without forces of contacts: {}.", reasons.join("; ")))
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

/// Drawings of a mechanism and, if they were found, of its solutions, side by side; none if there is no
/// solution of the wanted number.
///
/// ```
/// use slideway::{configuration::Configuration, mechanism::Mechanism, model::Model};
/// use slideway_pictures::drawing::{Shown, sheet};
///
/// let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
/// let model = Model::parse(text)?;
/// let mechanism = Mechanism::new(&model)?;
/// let configuration = Configuration::new(&mechanism)?;
/// let report = slideway::solve::solve(&model)?;
/// let sheet = sheet(&mechanism, &configuration, Some(&report), Shown::All).expect("solutions are there");
/// assert!(sheet.description.contains("3 solutions"));
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn sheet(
    mechanism: &Mechanism,
    configuration: &Configuration,
    report: Option<&SolveReport>,
    shown: Shown,
) -> Option<Sheet> {
    let mechanism = &in_units_of(report, mechanism, configuration);
    let view = view(mechanism, configuration);
    let drawn = Drawn { mechanism, configuration, report, view: &view, longest_force: None };
    let panels = drawn.panels(shown)?;
    let title = title(mechanism);
    let mut lines: Vec<String> =
        report.map(|report| state_line(&report.state, &mechanism.units)).into_iter().collect();
    lines.extend(report.map(answer));
    let description = described(&lines, &panels);
    let forces_on = forces_on(mechanism);
    Some(Layout { view: &view, units: &mechanism.units, panels, title, lines, forces_on }.sheet(description))
}

/// The same drawings each by itself, with its caption, and at the end the key to their colours, for a page that has
/// the title and the state itself. Where something is held, solutions are drawn to its scale and in its place.
///
/// ```
/// use slideway::model::{Model, Settings};
/// use slideway::{configuration::Configuration, mechanism::Mechanism, solve::solve};
/// use slideway_pictures::drawing::{Held, Sheet, pieces};
///
/// let file = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
/// let drawn = |mu: &str, held: Option<&Held>| -> Result<Vec<Sheet>, slideway::fault::Faults> {
///     let model = file.with(&Settings::default().parameter("mu", mu))?;
///     let mechanism = Mechanism::new(&model)?;
///     let configuration = Configuration::new(&mechanism)?;
///     Ok(pieces(&mechanism, &configuration, Some(&solve(&model)?), held))
/// };
/// // The mechanism itself, its solution, and the key.
/// let held = drawn("0.3", None)?[1].held;
/// assert_eq!(drawn("0.5", held.as_ref())?[1].held, held);
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn pieces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    report: Option<&SolveReport>,
    held: Option<&Held>,
) -> Vec<Sheet> {
    let mechanism = &in_units_of(report, mechanism, configuration);
    let view = view(mechanism, configuration);
    let longest_force = held.and_then(|held| held.longest_force);
    let drawn = Drawn { mechanism, configuration, report, view: &view, longest_force };
    let panels = drawn.panels(Shown::All).unwrap_or_default();
    let title = title(mechanism);
    let (lines, forces_on) = (Vec::new(), forces_on(mechanism));
    Layout { view: &view, units: &mechanism.units, panels, title, lines, forces_on }.pieces(held)
}

/// A view with room for what each contact needs.
fn view(mechanism: &Mechanism, configuration: &Configuration) -> View {
    let part = (mechanism.contacts.len() as f64 / CONTACTS).clamp(1.0, 2.0);
    View::fitting(mechanism, &[configuration], PANEL.map(|side| part * side))
}

/// The title of a mechanism, or what stands for it.
pub fn title(mechanism: &Mechanism) -> String {
    mechanism.title.clone().unwrap_or_else(|| "A mechanism".to_owned())
}

struct Drawn<'a> {
    mechanism: &'a Mechanism,
    configuration: &'a Configuration,
    report: Option<&'a SolveReport>,
    view: &'a View,
    /// The force whose arrow is the longest; without it, the greatest of each drawing.
    longest_force: Option<f64>,
}

impl Drawn<'_> {
    fn panels(&self, shown: Shown) -> Option<Vec<Panel>> {
        let solutions = self.report.map_or(&[][..], |report| &report.solutions);
        let gaps = self.report.map_or(&[][..], |report| &report.preload_gap_states);
        let count = solutions.len();
        match shown {
            Shown::Mechanism => Some(vec![self.overview()]),
            Shown::Solution(number) => {
                let solution = solutions.get(number.checked_sub(1)?)?;
                let heading = format!("Solution {number} of {count}");
                Some(vec![self.solution(solution, heading, true)])
            }
            Shown::GapState(number) => {
                let state = gaps.get(number.checked_sub(1)?)?;
                let heading = format!("Preload gap {number} of {}", gaps.len());
                Some(vec![self.solution(state, heading, true)])
            }
            Shown::All => {
                let mut panels = vec![self.overview()];
                panels.extend(self.jam());
                let numbered = solutions.iter().enumerate().map(|(index, solution)| {
                    self.solution(solution, format!("Solution {} of {count}", index + 1), false)
                });
                let numbered_gaps = gaps.iter().enumerate().map(|(index, state)| {
                    self.solution(state, format!("Preload gap {} of {}", index + 1, gaps.len()), false)
                });
                panels.extend(numbered.chain(numbered_gaps).take(MOST));
                Some(panels)
            }
        }
    }

    fn overview(&self) -> Panel {
        let greatest = self.greatest_load();
        let force_scale = (greatest > 0.0).then_some(LONGEST_FORCE / greatest);
        let options = SceneOptions { force_scale, ..SceneOptions::overview() };
        let states = ContactStates::default();
        let scene = scene(self.mechanism, self.configuration, &states, self.view, &options);
        let caption = Caption { heading: "The mechanism, to scale".to_owned(), ..Caption::default() };
        Panel { scene, caption, force_scale }
    }

    /// Why a mechanism without solution jams, if it is friction that locks it and that is known.
    fn jam(&self) -> Option<Panel> {
        let locking = locking(self.report?, self.mechanism, self.configuration)?;
        let states = ContactStates::locked(&locking);
        let forces = locking.normal_forces.iter().zip(&locking.friction_forces);
        let greatest = forces.map(|(normal, friction)| normal.hypot(*friction)).fold(0.0, f64::max);
        let options = SceneOptions::locking(LONGEST_FORCE / greatest);
        let with_play = |play: bool| {
            let options = SceneOptions { play, ..options };
            scene(self.mechanism, self.configuration, &states, self.view, &options)
        };
        // The play that is drawn moves the push against the cones: it is left out where that hides their overlap.
        let [tipped, to_scale] = [true, false].map(with_play);
        let scene = if to_scale.has_overlap && !tipped.has_overlap { to_scale } else { tipped };
        let mut lines = vec![self.why(&locking, scene.has_overlap)];
        lines.extend(joint_modes(&locking.joints));
        lines.push("The arrows show proportions, not sizes.".to_owned());
        lines.extend(scale_of_play(&scene));
        let heading = format!("Why it jams:  {}", signs(&locking.pattern));
        let caption = Caption { heading, lines, ..Caption::default() };
        Some(Panel { scene, caption, force_scale: None })
    }

    /// Why the forces of a mode lock a mechanism.
    fn why(&self, locking: &Locking, has_overlap: bool) -> String {
        let names: Vec<&str> = self.mechanism.drives.iter().map(|drive| &*drive.name).collect();
        match &names[..] {
            [push] if has_overlap => format!(
                "The line of {push} passes through the overlap of both friction cones: however hard it pushes, friction holds it."
            ),
            [push] if locking.is_balance => {
                format!(
                    "However great {push} is, these contact forces, within their friction cones, balance it."
                )
            }
            _ if locking.is_balance => format!(
                "However great {} are in this proportion, these contact forces, within their friction cones, balance them.",
                names.join(", ")
            ),
            _ => format!(
                "Friction itself presses these contacts together: at {} times this friction it makes all of its own normal force.",
                number(locking.factor)
            ),
        }
    }

    fn solution(&self, solution: &Solution, heading: String, names: bool) -> Panel {
        let greatest = self.greatest_force(solution);
        let longest = self.longest_force.unwrap_or(greatest);
        let force_scale = if longest > 0.0 { LONGEST_FORCE / longest } else { 1.0 };
        let mode = SceneOptions::contact_mode(force_scale);
        let longest_arrow = self.longest_force.map_or(mode.longest_arrow, |_| LONGEST_HELD);
        // Beside the mechanism itself, which shows them, velocities would only be repeated.
        let options = SceneOptions { names, velocities: names, longest_arrow, ..mode };
        let states = ContactStates::of(solution);
        let scene = scene(self.mechanism, self.configuration, &states, self.view, &options);
        let signs = signs(&solution.pattern);
        let mut lines: Vec<String> = joint_modes(&solution.joints).collect();
        lines.push(solution.attainability.in_words());
        lines.extend(scale_of_play(&scene));
        lines.extend(scene.friction_circles.map(scale_of_circles));
        let heading = if signs.is_empty() { heading } else { format!("{heading}:  {signs}") };
        let force_scale = (greatest > 0.0).then_some(force_scale);
        let table = pins(solution, self.mechanism);
        Panel { scene, caption: Caption { heading, lines, table }, force_scale }
    }

    /// The greatest force of a contact or of a hinge with friction (N), or of a load if none has any.
    fn greatest_force(&self, solution: &Solution) -> f64 {
        let contacts =
            solution.contacts.iter().flat_map(|contact| [contact.normal_force, contact.friction_force]);
        let rough = solution.hinges.iter().filter(|hinge| hinge.friction.is_some());
        let pins = rough.map(|hinge| hinge.force[0].hypot(hinge.force[1]));
        let greatest = contacts.map(f64::abs).chain(pins).fold(0.0, f64::max);
        if greatest > 0.0 {
            return greatest;
        }
        self.greatest_load()
    }

    /// The greatest of the known loads and weights (N).
    fn greatest_load(&self) -> f64 {
        known_forces(self.mechanism, self.configuration).into_iter().fold(0.0, f64::max)
    }
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

/// What there is, and how much of it is drawn.
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

impl Caption {
    fn in_words(&self) -> String {
        let Self { heading, lines, table } = self;
        let rows: Vec<String> = table.iter().map(|row| row.join(", ")).collect();
        let sentences =
            std::iter::once(heading).chain(lines).chain(&rows).map(|line| line.trim_end_matches('.'));
        format!("{}.", sentences.collect::<Vec<_>>().join(". "))
    }
}

struct Layout<'a> {
    view: &'a View,
    units: &'a Units,
    panels: Vec<Panel>,
    title: String,
    lines: Vec<String>,
    forces_on: &'static str,
}

impl Layout<'_> {
    fn sheet(self, description: String) -> Sheet {
        let picture = self.picture();
        let panel_width = picture.size().x.max(LEAST_WIDTH);
        let columns = columns(self.panels.len(), panel_width);
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
    fn pieces(self, held: Option<&Held>) -> Vec<Sheet> {
        let wanted = self.picture();
        let picture = held.map_or(wanted, |held| wanted.with(held.place));
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
            let own = bounds_of(std::slice::from_ref(panel));
            let own = own.map_or(picture, |bounds| picture.with_heights_of(&bounds));
            let picture = held.map_or(own, |held| own.with(held.place));
            let mut scene = Scene::default();
            let foot = self.panel(&mut scene, panel, &picture, Point::zeros());
            all.elements.extend(scene.elements.iter().cloned());
            let longest_force = panel.force_scale.map(|scale| LONGEST_FORCE / scale);
            let longest_force = held.and_then(|held| held.longest_force).or(longest_force);
            let held = Held { longest_force, place: picture };
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

    /// The place that every picture has.
    fn picture(&self) -> Bounds {
        bounds_of(&self.panels)
            .unwrap_or(Bounds { least: Point::zeros(), greatest: Point::new(LEAST_WIDTH, LEAST_WIDTH) })
    }

    /// Adds a drawing with what stands below it; the y below that.
    fn panel(&self, scene: &mut Scene, panel: &Panel, picture: &Bounds, corner: Point) -> f64 {
        let width = picture.size().x.max(LEAST_WIDTH);
        let length = nice(0.45 * picture.size().x.min(PANEL[0]) / self.view.scale, &self.units.of("m"));
        let free = 0.5 * (width - picture.size().x);
        let by = corner + Point::new(free, 0.0) - picture.least;
        scene.elements.extend(panel.scene.clone().shifted(by).elements);
        let mut foot = corner.y + picture.size().y + 26.0;
        self.legend(scene, panel, length, Point::new(corner.x, foot));
        foot += 16.0;
        let heading = &panel.caption.heading;
        foot = paragraph(scene, heading, NAME_SIZE + 1.0, Point::new(corner.x, foot), width);
        for line in &panel.caption.lines {
            foot = paragraph(scene, line, VALUE_SIZE, Point::new(corner.x, foot), width);
        }
        table(scene, &panel.caption.table, Point::new(corner.x, foot))
    }

    /// Bars of a length and of a force.
    fn legend(&self, scene: &mut Scene, panel: &Panel, length: f64, corner: Point) {
        let from = corner + Point::new(1.0, 0.0);
        let mut right = from.x + length * self.view.scale;
        for line in dimensions::scale_bar(from, length * self.view.scale) {
            scene.add(Class::Edge, Shape::Line(line));
        }
        right = beside(scene, Point::new(right, corner.y), quantity(length, &self.units.of("m")));
        if let Some(scale) = panel.force_scale {
            let unit = self.units.of("N");
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
fn columns(count: usize, width: f64) -> usize {
    let mut columns = 1;
    while columns < count && (columns + 1) as f64 * (width + SPACE) - SPACE <= ROW {
        columns += 1;
    }
    let rows = count.div_ceil(columns).max(1);
    count.div_ceil(rows).max(1)
}

/// What the colours mean; the y below it.
fn key(scene: &mut Scene, y: f64, most: f64, forces_on: &str) -> f64 {
    let words = [
        (Class::Reaction, format!("normal reaction on {forces_on}")),
        (Class::Friction, format!("friction on {forces_on}")),
        (Class::ContactForce, format!("force on {forces_on}, within its friction cone")),
        (Class::PinForce, "force of a pin, tangent to its friction circle".to_owned()),
        (Class::Load, "load, weight or drive".to_owned()),
        (Class::Drive, "drive, its size unknown".to_owned()),
        (Class::Velocity, "sliding velocity".to_owned()),
        (Class::Break, "not to scale".to_owned()),
    ];
    let used: Vec<_> = words
        .into_iter()
        .filter(|(class, _)| scene.elements.iter().any(|element| element.class == *class))
        .collect();
    let mut corner = Point::new(0.0, y + 18.0);
    for (class, text) in &used {
        let total = 40.0 + width(text, VALUE_SIZE);
        if corner.x > 0.0 && corner.x + total > most {
            corner = Point::new(0.0, corner.y + LINE * VALUE_SIZE);
        }
        let to = corner + Point::new(28.0, 0.0);
        if *class == Class::Break {
            broken(corner.lerp(&to, 0.45), Point::x()).for_each(|line| scene.add(*class, line));
        } else {
            scene.add(*class, Shape::Arrow { from: corner, to });
        }
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
