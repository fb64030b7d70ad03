//! Where labels stand: beside what they name, clear of each other.

use super::obstacles::{Obstacle, Obstacles};
use super::outline::{nearest_on_line, unit};
use super::scene::{ASCENT, Anchor, Bounds, Class, DESCENT, Point, Scene, Shape, Text};
use std::cell::RefCell;
use std::f64::consts::TAU;

/// A label that waits for its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Label {
    pub(super) class: Class,
    pub(super) text: String,
    pub(super) size: f64,
    /// The middle of what it names.
    pub(super) anchor: Point,
    /// From there to the end of it where it is long, such as an arrow; zero for a place.
    pub(super) reach: Point,
    /// Unit direction from there in which it would best stand.
    pub(super) towards: Point,
}

/// Directions that are tried.
const DIRECTIONS: usize = 16;
/// Shifts sideways that are tried, in half widths of the label.
const SHIFTS: [f64; 3] = [0.0, -0.7, 0.7];
/// Distances from the anchor that are tried.
const DISTANCES: [f64; 14] =
    [5.0, 11.0, 18.0, 26.0, 36.0, 48.0, 62.0, 80.0, 100.0, 125.0, 155.0, 190.0, 235.0, 290.0];
/// Beyond this distance a line leads to the anchor; so it does where something else that has a label is nearer.
const LEADER: f64 = 30.0;
/// Cost of a line to the anchor, which has to show what the label names.
const TOLD: f64 = 10.0;
/// Cost of a wall or an edge between a label and what it names.
const BETWEEN: f64 = 2.0;
/// Cost of another label on the line to what is named, and of each place of another arrow or dimension on its
/// way.
const CROSSED: f64 = 12.0;
const MET: f64 = 3.0;
/// Cost of each unit by which a label makes the drawing wider or higher.
const OUTSIDE: f64 = 0.15;
/// Cost of covering a place of an arrow; of a dimension it is more, of a wall or the edge of a body less.
const IMPORTANT: f64 = 10.0;
const EDGE: f64 = 2.0;
/// Free space around a label.
const MARGIN: f64 = 2.0;
/// Distance of the places of a line that labels keep clear of.
const STEP: f64 = 3.0;

/// A scene with its labels, and what it was made of.
struct Labelled {
    bare: Scene,
    labels: Vec<Label>,
    within: Option<Bounds>,
    scene: Scene,
}

/// So many scenes are known.
const KNOWN: usize = 8;

thread_local! {
    /// The scenes that were labelled last, the latest at the end: while friction changes, the mechanism itself looks the same.
    static LAST: RefCell<Vec<Labelled>> = const { RefCell::new(Vec::new()) };
}

/// Returns the scene in which every label has its place, in their order; with bounds those that find no place within them
/// are left out. Places are searched once for the same scene.
pub(super) fn labelled(bare: Scene, labels: Vec<Label>, within: Option<Bounds>) -> Scene {
    LAST.with_borrow_mut(|last| {
        let is_same = |one: &Labelled| one.within == within && one.labels == labels && one.bare == bare;
        let known = if let Some(at) = last.iter().position(is_same) {
            last.remove(at)
        } else {
            let mut scene = bare.clone();
            place(&mut scene, labels.clone(), within);
            last.drain(..last.len().saturating_sub(KNOWN - 1));
            Labelled { bare, labels, within, scene }
        };
        let scene = known.scene.clone();
        last.push(known);
        scene
    })
}

fn place(scene: &mut Scene, labels: Vec<Label>, within: Option<Bounds>) {
    let mut all = obstacles(scene);
    all.extend(outlines(scene));
    let obstacles = Obstacles::new(all);
    let texts = scene.texts().map(|(_, text)| text.bounds().widened(MARGIN)).collect();
    let named = labels.iter().map(Label::named).collect();
    let mut room = Room { obstacles, named, taken: texts, drawn: scene.bounds(), within };
    for label in labels {
        let Some(bounds) = room.best(&label) else { continue };
        if let Some(leader) = room.leader(&label, &bounds) {
            let mut places = Vec::new();
            along(&leader, 1.0, &mut places);
            room.obstacles.extend(places);
            scene.add(Class::Leader, Shape::Line(leader.to_vec()));
        }
        let at = Point::new(bounds.middle().x, bounds.greatest.y - DESCENT * label.size);
        scene.write(label.class, Text { text: label.text, at, anchor: Anchor::Middle, size: label.size });
        room.taken.push(bounds.widened(MARGIN));
        room.drawn = room.drawn.map(|drawn| drawn.with(bounds));
    }
}

/// The space for labels, and all that they have to keep clear of.
struct Room {
    /// Places along lines, each with what it costs to cover it.
    obstacles: Obstacles,
    /// The things that all labels name, each from one end to the other.
    named: Vec<[Point; 2]>,
    /// Other labels.
    taken: Vec<Bounds>,
    /// The bounds of the drawing so far.
    drawn: Option<Bounds>,
    /// The bounds that labels do not leave.
    within: Option<Bounds>,
}

impl Room {
    /// The cheapest free place.
    fn best(&self, label: &Label) -> Option<Bounds> {
        let half = half_size(label);
        let directions: [Point; DIRECTIONS] = std::array::from_fn(|index| direction(label.towards, index));
        let mut best: Option<(f64, Bounds)> = None;
        for distance in DISTANCES {
            for direction in directions {
                let turn = 1.0 - direction.dot(&label.towards);
                for shift in SHIFTS {
                    let far = 0.35 * distance + 3.0 * turn + 2.0 * shift.abs();
                    if best.is_some_and(|(least, _)| far >= least) {
                        continue;
                    }
                    let aside = Point::new(shift * half.x, 0.0);
                    let bounds = beside(label.anchor, direction, distance, half).shifted(aside);
                    if !self.is_free(&bounds) {
                        continue;
                    }
                    let least = best.map_or(f64::INFINITY, |(least, _)| least);
                    best = self.cost_below(least, far, label, &bounds).map(|cost| (cost, bounds)).or(best);
                }
            }
            if best.is_some_and(|(least, _)| least < 0.35 * distance) {
                break;
            }
        }
        best.map(|(_, bounds)| bounds)
    }

    fn is_free(&self, bounds: &Bounds) -> bool {
        self.taken.iter().all(|other| !other.overlaps(bounds))
            && self.within.is_none_or(|within| holds(&within, bounds))
    }

    /// Returns the cost of a place, of which the distance costs `far`, or `None` if it is not less than
    /// `least`. Nothing is looked at further once it costs too much.
    fn cost_below(&self, least: f64, far: f64, label: &Label, bounds: &Bounds) -> Option<f64> {
        let outside = self.drawn.map_or(0.0, |drawn| (drawn.with(*bounds).size() - drawn.size()).sum());
        let mut crossed = 0.0;
        for (_, weight) in self.obstacles.within(&bounds.widened(MARGIN)) {
            crossed += weight;
            if far + (OUTSIDE * outside + crossed) >= least {
                return None;
            }
        }
        let covered = OUTSIDE * outside + crossed;
        if far + covered >= least {
            return None;
        }
        let led = match self.leader(label, bounds) {
            Some(leader) => {
                TOLD + CROSSED * texts_on(&leader, &self.taken) + MET * self.met(&leader, IMPORTANT)
            }
            None => BETWEEN * self.met(&link(label, bounds), EDGE),
        };
        let cost = far + (covered + led);
        (cost < least).then_some(cost)
    }

    /// The line that tells what a label names: where that is far, or something else that has a label is nearer.
    fn leader(&self, label: &Label, bounds: &Bounds) -> Option<[Point; 2]> {
        let own = label.named();
        let distance = distance(bounds, own);
        let is_nearer = |other: &[Point; 2]| {
            *other != own
                && least_distance(bounds, *other) < distance
                && self::distance(bounds, *other) < distance
        };
        let link = link(label, bounds);
        ((link[1] - link[0]).norm() > LEADER || self.named.iter().any(is_nearer)).then_some(link)
    }

    /// The number of places of at least this weight through which a line runs before it ends.
    fn met(&self, [from, to]: &[Point; 2], weight: f64) -> f64 {
        let along = unit(to - from, Point::x());
        let end = to - along * (2.0 * STEP);
        let around = Bounds { least: from.inf(&end), greatest: from.sup(&end) }.widened(STEP);
        let is_met = |(place, of_place): &&Obstacle| {
            *of_place >= weight && nearest_on_line(*place, [*from, end]).0 < 0.5 * STEP
        };
        self.obstacles.within(&around).filter(is_met).count() as f64
    }
}

/// Half the width and height of a label.
fn half_size(label: &Label) -> Point {
    0.5 * Point::new(crate::typeface::width(&label.text, label.size), (ASCENT + DESCENT) * label.size)
}

/// Adds the place where a label would stand with nothing in its way.
pub(super) fn reserve(label: &Label, obstacles: &mut Vec<Obstacle>) {
    let half = half_size(label);
    let middle = beside(label.anchor, label.towards, DISTANCES[0], half).middle();
    let aside = Point::new(half.x, 0.0);
    along(&[middle - aside, middle + aside], IMPORTANT, obstacles);
}

impl Label {
    /// Returns the two ends of the thing that it names.
    fn named(&self) -> [Point; 2] {
        [self.anchor - self.reach, self.anchor + self.reach]
    }
}

/// The line from a label to the middle of what it names, or the nearest place of it.
fn link(label: &Label, bounds: &Bounds) -> [Point; 2] {
    let (_, foot) = nearest_on_line(bounds.middle(), label.named());
    [foot.sup(&bounds.least).inf(&bounds.greatest), foot]
}

/// The distance of a label from a line that does not cross it.
fn distance(bounds: &Bounds, line: [Point; 2]) -> f64 {
    let Bounds { least, greatest } = *bounds;
    let corners = [least, Point::new(least.x, greatest.y), greatest, Point::new(greatest.x, least.y)];
    let from_corners = corners.into_iter().map(|corner| nearest_on_line(corner, line).0);
    let from_ends = line.into_iter().map(|end| (end - end.sup(&least).inf(&greatest)).norm());
    from_corners.chain(from_ends).fold(f64::INFINITY, f64::min)
}

/// A lower bound of that distance, rounding included, at little cost: the distance of the boxes around both.
fn least_distance(bounds: &Bounds, [from, to]: [Point; 2]) -> f64 {
    let around = Bounds { least: from.inf(&to), greatest: from.sup(&to) };
    let apart = (around.least - bounds.greatest).sup(&(bounds.least - around.greatest));
    (1.0 - 1e-9) * apart.sup(&Point::zeros()).norm()
}

/// The number of labels through which a line runs.
fn texts_on(line: &[Point; 2], taken: &[Bounds]) -> f64 {
    let mut places = Vec::new();
    along(line, 1.0, &mut places);
    let is_crossed = |text: &&Bounds| places.iter().any(|(place, _)| text.contains(place));
    taken.iter().filter(is_crossed).count() as f64
}

fn direction(towards: Point, index: usize) -> Point {
    let angle = TAU * index as f64 / DIRECTIONS as f64;
    let (sin, cos) = angle.sin_cos();
    Point::new(cos * towards.x - sin * towards.y, sin * towards.x + cos * towards.y)
}

/// A box of half size `half` whose edge is at a distance from the anchor in a direction.
fn beside(anchor: Point, direction: Point, distance: f64, half: Point) -> Bounds {
    let reach = |part: f64, half: f64| if part.abs() > 1e-9 { half / part.abs() } else { f64::INFINITY };
    let inside = reach(direction.x, half.x).min(reach(direction.y, half.y));
    let middle = anchor + direction * (distance + inside);
    Bounds { least: middle - half, greatest: middle + half }
}

fn holds(outer: &Bounds, inner: &Bounds) -> bool {
    outer.contains(&inner.least) && outer.contains(&inner.greatest)
}

/// Places along all lines but the outlines of bodies, each with what it costs to cover it.
pub(super) fn obstacles(scene: &Scene) -> Vec<Obstacle> {
    places_along(scene, |class| class != Class::Body)
}

/// Places along the outlines of bodies.
fn outlines(scene: &Scene) -> Vec<Obstacle> {
    places_along(scene, |class| class == Class::Body)
}

fn places_along(scene: &Scene, counts: impl Fn(Class) -> bool) -> Vec<Obstacle> {
    let mut places = Vec::new();
    for element in scene.elements.iter().filter(|element| counts(element.class)) {
        let weight = match element.class {
            Class::Reaction
            | Class::Friction
            | Class::PinForce
            | Class::ContactForce
            | Class::Load
            | Class::Drive
            | Class::Velocity
            | Class::PointsOut
            | Class::PointsIn
            | Class::Opening => IMPORTANT,
            Class::Dimension => 2.0 * IMPORTANT,
            Class::Hatch => 3.0,
            Class::Slot | Class::Cone | Class::Overlap => 0.4,
            Class::Leader => 1.0,
            _ => EDGE,
        };
        match &element.shape {
            Shape::Line(corners) => along(corners, weight, &mut places),
            Shape::Area(corners) => {
                let closed: Vec<Point> = corners.iter().chain(corners.first()).copied().collect();
                along(&closed, weight, &mut places);
            }
            Shape::Circle(centre, radius) => {
                along(&super::outline::disc(*centre, *radius), weight, &mut places);
            }
            Shape::Arrow { from, to } => along(&[*from, *to], weight, &mut places),
            Shape::Head(tip, _) => places.push((*tip, weight)),
            Shape::Text(_) => {}
        }
    }
    places
}

fn along(corners: &[Point], weight: f64, places: &mut Vec<Obstacle>) {
    for pair in corners.windows(2) {
        let between = pair[1] - pair[0];
        let steps = (between.norm() / STEP).ceil().clamp(1.0, 1000.0);
        let mut step = 0.0;
        while step <= steps {
            places.push((pair[0] + between * (step / steps), weight));
            step += 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As if places were searched each time, of more scenes than are known.
    #[test]
    fn a_known_scene_is_labelled_as_a_new_one() {
        for index in (0..2 * KNOWN).chain([0, 1, 0, KNOWN, 2 * KNOWN - 1]) {
            let end = Point::new(10.0 * (index / 3) as f64, 0.0);
            let mut bare = Scene::default();
            bare.add(Class::Body, Shape::Line(vec![Point::zeros(), end]));
            let label = Label {
                class: Class::Words,
                text: "word ".repeat(index % 3 + 1),
                size: 14.0,
                anchor: Point::zeros(),
                reach: Point::zeros(),
                towards: Point::x(),
            };
            let mut expected = bare.clone();
            place(&mut expected, vec![label.clone()], None);
            assert_eq!(labelled(bare, vec![label], None), expected);
        }
    }
}
