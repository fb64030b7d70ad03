//! The drawings of a sheet, each with its caption.

use super::loads::LONGEST_ARROW;
use super::scene::Scene;
use super::section::{joints_in_space, section};
use super::units::known_forces;
use super::{ContactStates, SceneOptions, View, between, number, one_way, quantity, scene, signs};
use slideway::configuration::Configuration;
use slideway::mechanism::{Contact, Mechanism};
use slideway::report::{JointMode, MarginsMissing, Rejection, Solution, SolveReport, Status};
use slideway::solve::{Locking, locking};
use slideway::standstill::{AtRest, ContactRange, Range};

/// The most solutions that are drawn.
pub(super) const MOST: usize = 24;
/// Length of the longest arrow of a force, and to which it may grow at a scale that is held where there is space for it.
pub(super) const LONGEST_FORCE: f64 = 76.0;
pub(super) const LONGEST_HELD: f64 = 3.0 * LONGEST_FORCE;

/// Half widths of ranges below this have no length in a drawing (drawing units).
const NOTHING: f64 = 1e-6;
/// Remark on forces of which only ranges are known.
const RANGES: &str =
    "Arrows are in the middle of their ranges: which forces it has depends on how it came to rest.";

/// Below the cross-section of a guide.
const SECTION: &str =
    "Seen against the direction of sliding. Friction acts along the guide, and is not shown.";

/// Remark on a picture whose guides are drawn with a play that can be seen instead of their own.
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
        let couple = quantity(friction.couple, &moment);
        Some([hinge.name.clone(), size, couple, hinge.on.clone()])
    };
    let pins: Vec<[String; 4]> = solution.hinges.iter().filter_map(one).collect();
    let heading = ["pin", "force", "friction couple", "on"].map(str::to_owned);
    let heading = Some(heading).filter(|_| !pins.is_empty());
    heading.into_iter().chain(pins).collect()
}

/// "guide: touching at lower right and upper left"
fn joint_modes(joints: &[JointMode]) -> impl Iterator<Item = String> {
    joints.iter().map(|joint| format!("{}: {}", joint.name, joint.mode))
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

/// The words below a panel.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Caption {
    /// Its first line.
    pub(crate) heading: String,
    /// The lines that follow.
    pub(crate) lines: Vec<String>,
    /// A table below: a row for each pin with friction, after one of headings.
    pub(crate) table: Vec<[String; 4]>,
}

/// One drawing of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The drawing.
    pub(crate) scene: Scene,
    /// The words below it.
    pub(crate) caption: Caption,
    /// Drawing units for a newton, if its forces are to scale.
    pub(crate) force_scale: Option<f64>,
    /// Drawing units for a metre, if they are not those of the view.
    pub(crate) scale: Option<f64>,
}

/// The subject of drawings: a mechanism in a configuration, with its solutions.
pub(super) struct Drawn<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) configuration: &'a Configuration,
    pub(super) report: Option<&'a SolveReport>,
    /// What holds it, if that is drawn instead of solutions.
    pub(super) rest: Option<&'a AtRest>,
    pub(super) view: &'a View,
    /// The force whose arrow is the longest; without it, the greatest of each drawing.
    pub(super) longest_force: Option<f64>,
    /// To which length arrows may grow at a scale that is held.
    pub(super) longest_held: f64,
}

impl<'a> Drawn<'a> {
    /// The mechanism alone, its forces to the scale of each drawing.
    pub(super) fn by_itself(
        mechanism: &'a Mechanism,
        configuration: &'a Configuration,
        view: &'a View,
    ) -> Self {
        let (longest_force, longest_held) = (None, LONGEST_HELD);
        Self { mechanism, configuration, report: None, rest: None, view, longest_force, longest_held }
    }
}

impl Drawn<'_> {
    pub(super) fn panels(&self, shown: Shown) -> Option<Vec<Panel>> {
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
                let rejected = self.report.map_or(&[][..], |report| &report.rejected);
                let jam = self.jam();
                if jam.is_none() {
                    panels[0].caption.lines.extend(self.why_no_jam());
                }
                panels.extend(jam);
                panels.extend(self.rest.map(|rest| self.at_rest(rest)));
                panels.extend(rejected.iter().map(|rejection| self.tipping(rejection)).take(MOST));
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
        let heading = "The mechanism, to scale".to_owned();
        let caption = Caption { heading, lines: self.preloads(), ..Caption::default() };
        Panel { scene, caption, force_scale, scale: None }
    }

    /// The friction of preloads, a line for each contact that has some: "Preload of lower.front: 9.81 N of friction."
    fn preloads(&self) -> Vec<String> {
        let Mechanism { contacts, units, .. } = self.mechanism;
        let shown = |force: f64| {
            let unit = units.clone().suited_to_most("N", &[force]).of("N");
            quantity(force, &unit)
        };
        let line = |contact: &Contact| {
            let friction = match contact.preload {
                [0.0, 0.0] => return None,
                [one, other] if one == other => shown(one),
                [one, other] => format!("{} (at +) and {} (at \u{2212})", shown(one), shown(other)),
            };
            Some(format!("Preload of {}: {friction} of friction.", contact.name))
        };
        contacts.iter().filter_map(line).collect()
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
        let caption = Caption { heading: "Why it jams".to_owned(), lines, ..Caption::default() };
        Some(Panel { scene, caption, force_scale: None, scale: None })
    }

    /// Why there is no drawing of a jam, if there is no solution and friction is the reason.
    fn why_no_jam(&self) -> Option<String> {
        let report =
            self.report.filter(|report| report.status == Status::None && report.rejected.is_empty())?;
        let mut rough =
            self.mechanism.friction_circles.iter().filter(|circle| circle.radius > 0.0).peekable();
        let why = if rough.peek().is_some_and(|circle| circle.end.is_some()) {
            "with friction on round rods they are not computed"
        } else if rough.peek().is_some() {
            "with friction in hinges they are not computed"
        } else if report.margins_missing == Some(MarginsMissing::TooManyModes) {
            "it has too many contacts"
        } else {
            "none grows without limit as friction grows to that of the model"
        };
        Some(format!("The forces that lock it are not drawn: {why}."))
    }

    /// A solution of the equations in which a guided slider would tip: its reaction acts beyond its ends.
    fn tipping(&self, rejection: &Rejection) -> Panel {
        let forces = rejection.normal_forces.iter().chain(&rejection.friction_forces);
        let (scale, force_scale, longest_arrow) =
            self.scale(forces.map(|force| force.abs()).fold(0.0, f64::max));
        let options = SceneOptions { velocities: false, longest_arrow, ..SceneOptions::contact_mode(scale) };
        let states = ContactStates::tipping(rejection);
        let scene = scene(self.mechanism, self.configuration, &states, self.view, &options);
        let joint = self.mechanism.joints.iter().position(|joint| *joint.name == *rejection.joint);
        let contact = self.mechanism.contacts.iter().position(|one| Some(one.joint.index()) == joint);
        let pressure = contact.map_or(0.0, |contact| rejection.normal_forces[contact].abs());
        let [place, end] = [rejection.couple, rejection.limit]
            .map(|couple| quantity(couple.abs() / pressure, &self.mechanism.units.of("m")));
        let name = &rejection.joint;
        let why = if pressure > 0.0 {
            format!("The reaction on {name} would have to act {place} from its middle; it ends at {end}.")
        } else {
            format!("{name} would need a couple, and nothing presses it.")
        };
        let lines = std::iter::once(why).chain(scale_of_play(&scene)).collect();
        let caption = Caption { heading: "Why it tips".to_owned(), lines, ..Caption::default() };
        Panel { scene, caption, force_scale, scale: None }
    }

    /// Returns the drawing units for a newton where this is the greatest force, those that can be stated, and
    /// the longest arrow.
    fn scale(&self, greatest: f64) -> (f64, Option<f64>, f64) {
        let longest = self.longest_force.unwrap_or(greatest);
        let scale = if longest > 0.0 { LONGEST_FORCE / longest } else { 1.0 };
        let longest_arrow = self.longest_force.map_or(LONGEST_ARROW, |_| self.longest_held);
        (scale, (greatest > 0.0).then_some(scale), longest_arrow)
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
        let (scale, force_scale, longest_arrow) = self.scale(greatest);
        // Beside the mechanism itself, which shows them, velocities would only be repeated.
        let mode = SceneOptions::contact_mode(scale);
        let options = SceneOptions { names, velocities: names, longest_arrow, ..mode };
        let states = ContactStates::of(solution);
        let scene = scene(self.mechanism, self.configuration, &states, self.view, &options);
        // The signs tell several solutions apart.
        let is_only = self.report.is_some_and(|report| report.solutions.len() == 1);
        let signs = if is_only { String::new() } else { signs(&solution.pattern) };
        let mut lines: Vec<String> = joint_modes(&solution.joints).collect();
        lines.push(solution.attainability.in_words());
        lines.extend(scale_of_play(&scene));
        lines.extend(scene.friction_circles.map(scale_of_circles));
        let heading = if signs.is_empty() { heading } else { format!("{heading}:  {signs}") };
        let table = pins(solution, self.mechanism);
        Panel { scene, caption: Caption { heading, lines, table }, force_scale, scale: None }
    }

    /// The cross-section of each sliding joint whose contacts do not all lie in the drawing, in each solution that is shown.
    pub(super) fn sections(&self, shown: Shown) -> Vec<Panel> {
        let solutions = self.report.map_or(&[][..], |report| &report.solutions);
        let is_shown = |index: usize| match shown {
            Shown::All => index < MOST,
            Shown::Solution(number) => index + 1 == number,
            Shown::Mechanism | Shown::GapState(_) => false,
        };
        let numbered = solutions.iter().enumerate().filter(|(index, _)| is_shown(*index));
        let of_solution = |(index, solution): (usize, &Solution)| {
            let (scale, force_scale, longest_arrow) = self.scale(self.greatest_force(solution));
            let options = SceneOptions { longest_arrow, ..SceneOptions::contact_mode(scale) };
            let states = ContactStates::of(solution);
            let joints = joints_in_space(self.mechanism).map(move |joint| {
                let (scene, scale) =
                    section(self.mechanism, self.configuration, &states, (self.view, &options), joint);
                let name = &self.mechanism.joints[joint.index()].name;
                let number =
                    if solutions.len() == 1 { String::new() } else { format!("Solution {}, ", index + 1) };
                let heading = if number.is_empty() { "Section of" } else { "section of" };
                let lines = vec![SECTION.to_owned()];
                let caption =
                    Caption { heading: format!("{number}{heading} {name}"), lines, ..Caption::default() };
                Panel { scene, caption, force_scale, scale: Some(scale) }
            });
            joints.collect::<Vec<_>>()
        };
        numbered.flat_map(of_solution).collect()
    }

    /// The forces that hold it.
    fn at_rest(&self, rest: &AtRest) -> Panel {
        let states = ContactStates::at_rest(self.mechanism, rest);
        let forces = states.contacts.iter().filter_map(|contact| contact.forces);
        let sizes = forces.clone().flat_map(|one| [one.normal, one.friction]).map(f64::abs);
        let (scale, force_scale, longest_arrow) = self.scale(sizes.fold(0.0, f64::max));
        let options = SceneOptions { velocities: false, longest_arrow, ..SceneOptions::contact_mode(scale) };
        let scene = scene(self.mechanism, self.configuration, &states, self.view, &options);
        let contacts = rest.reactions.contacts.iter();
        let mut lines: Vec<String> = contacts.flat_map(|contact| self.without_arrow(contact)).collect();
        if forces.flat_map(|one| one.spread).any(|spread| spread * scale > NOTHING) {
            lines.push(RANGES.to_owned());
        }
        lines.extend(scale_of_play(&scene));
        let caption = Caption { heading: "Forces at rest".to_owned(), lines, ..Caption::default() };
        Panel { scene, caption, force_scale, scale: None }
    }

    /// The forces of a contact that have no arrow: "Friction of floor: -65.17 to 92.48 N."
    fn without_arrow(&self, contact: &ContactRange) -> impl Iterator<Item = String> {
        let told = |(what, range): (&str, Range)| {
            if one_way(range).is_some() {
                return None;
            }
            let ends: Vec<f64> = [range.least, range.greatest].into_iter().flatten().collect();
            let unit = self.mechanism.units.clone().suited_to_most("N", &ends).of("N");
            let words = match (range.least, range.greatest) {
                (Some(least), Some(greatest)) => between([least, greatest], &unit),
                (Some(least), None) => format!("{} or more", quantity(least, &unit)),
                (None, Some(greatest)) => format!("{} or less", quantity(greatest, &unit)),
                (None, None) => "any".to_owned(),
            };
            Some(format!("{what} of {}: {words}.", contact.name))
        };
        let both = [("Normal force", contact.normal_force), ("Friction", contact.friction_force)];
        both.map(told).into_iter().flatten()
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

impl Caption {
    pub(super) fn in_words(&self) -> String {
        let Self { heading, lines, table } = self;
        let rows: Vec<String> = table.iter().map(|row| row.join(", ")).collect();
        let sentences =
            std::iter::once(heading).chain(lines).chain(&rows).map(|line| line.trim_end_matches('.'));
        format!("{}.", sentences.collect::<Vec<_>>().join(". "))
    }
}
