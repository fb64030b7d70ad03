//! Polygons of lines and arcs, and the bodies and points that a drawing shows.

use super::entities::{Drawing, Layer, Path, Words};
use super::shown;
use crate::expression::{is_reserved, is_valid_name};
use crate::model::OutlineCorner;
use crate::model::outline::moments;
use nalgebra::Vector2;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

/// Places nearer to each other than this part of the size of the drawing are one.
const JOINED: f64 = 1e-6;
/// How far a text may be from the point that it names, in heights of its letters.
const BESIDE: f64 = 4.0;

/// A corner of a line, and the arc that begins there.
pub(super) type Corner = OutlineCorner<Vector2<f64>>;

/// The bodies and points of a drawing, in its units.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    pub(super) layers: Vec<Body>,
    pub(super) spots: Vec<Spot>,
    /// What is in the drawing and not in these.
    pub(super) left_out: Vec<String>,
}

/// A layer that is a body.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) name: String,
    /// The name of the layer.
    pub(super) layer: String,
    /// Corners; empty if there is no closed line.
    pub(super) outline: Vec<Corner>,
}

impl Body {
    /// The corners of the outline, and what its arcs go through.
    pub(super) fn places(&self) -> impl Iterator<Item = Vector2<f64>> {
        self.outline.iter().flat_map(|corner| [Some(corner.at), corner.arc_through]).flatten()
    }
}

/// A point of bodies or ground.
#[derive(Debug, Clone)]
pub(super) struct Spot {
    pub(super) name: String,
    pub(super) at: Vector2<f64>,
    /// The bodies that have it.
    pub(super) bodies: Vec<usize>,
    pub(super) is_of_ground: bool,
    /// Radius of the greatest circle about it.
    radius: f64,
}

/// A part of a circle from one angle to another counter-clockwise, in arcs of at most half of it; all of it where
/// both are the same.
pub(super) fn arc(centre: Vector2<f64>, radius: f64, [from, to]: [f64; 2]) -> Vec<Corner> {
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn == 0.0 { TAU } else { turn };
    let place = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        centre + Vector2::new(cos, sin) * radius
    };
    let arcs = if turn > PI { 2 } else { 1 };
    let half = turn / f64::from(2 * arcs);
    let corner = |number: i32| {
        let angle = from + 2.0 * half * f64::from(number);
        let arc_through = (number < arcs).then(|| place(angle + half));
        OutlineCorner { at: place(angle), arc_through }
    };
    (0..=arcs).map(corner).collect()
}

/// The middle of an arc that has a bulge: the tangent of a quarter of its angle, positive counter-clockwise.
pub(super) fn bulge([from, to]: [Vector2<f64>; 2], bulge: f64) -> Vector2<f64> {
    let half = 0.5 * (to - from);
    from + half + Vector2::new(half.y, -half.x) * bulge
}

impl Body {
    /// The centroid of the outline as a homogeneous plate, and the square of its radius of gyration about that.
    pub(super) fn plate(&self) -> Option<(Vector2<f64>, f64)> {
        let origin = self.outline.first()?.at;
        let shifted: Vec<Corner> =
            self.outline.iter().map(|corner| corner.map(|place| place - origin)).collect();
        let (area, first, polar) = moments(&shifted);
        let (centre, square) = (first / area, polar / area);
        Some((origin + centre, square - centre.norm_squared())).filter(|(centre, square)| {
            centre.iter().all(|part| part.is_finite()) && *square > 0.0 && square.is_finite()
        })
    }
}

/// The area within an outline, whichever way it goes.
fn area(corners: &[Corner]) -> f64 {
    let origin = corners.first().map_or_else(Vector2::zeros, |corner| corner.at);
    let shifted: Vec<Corner> = corners.iter().map(|corner| corner.map(|place| place - origin)).collect();
    moments(&shifted).0.abs()
}

/// The same line from its other end.
fn reversed(corners: &[Corner]) -> Vec<Corner> {
    let before = corners.iter().rev().skip(1).map(|corner| corner.arc_through).chain([None]);
    corners
        .iter()
        .rev()
        .zip(before)
        .map(|(corner, arc_through)| OutlineCorner { arc_through, ..*corner })
        .collect()
}

impl Bodies {
    /// What a drawing shows.
    pub(super) fn of(drawing: &Drawing) -> Self {
        let near = JOINED * size(drawing);
        let mut bodies = Self { layers: Vec::new(), spots: Vec::new(), left_out: Vec::new() };
        let mut names = Names::default();
        for layer in &drawing.layers {
            let is_ground = layer.name.eq_ignore_ascii_case("ground");
            let (outline, left_over) = outline(layer, near);
            bodies.note(layer, left_over);
            if is_ground && !outline.is_empty() {
                bodies.left_out.push("the outline of the layer ground: ground has none".to_owned());
            }
            let has_spots = !(layer.points.is_empty() && layer.circles.is_empty());
            let owner = (!is_ground && (has_spots || !outline.is_empty())).then_some(bodies.layers.len());
            if owner.is_some() {
                let name = names.fresh(&layer.name, "layer");
                bodies.layers.push(Body { name, layer: layer.name.clone(), outline });
            }
            bodies.add_spots(layer, owner, near);
        }
        bodies.name_spots(drawing);
        bodies
    }

    /// Whether every corner and every point has a place.
    pub(super) fn are_finite(&self) -> bool {
        let corners = self.layers.iter().flat_map(Body::places);
        let mut places = corners.chain(self.spots.iter().map(|spot| spot.at));
        places.all(|place| place.iter().all(|part| part.is_finite()))
    }

    fn note(&mut self, layer: &Layer, left_over: usize) {
        let name = shown(&layer.name);
        if left_over > 0 {
            self.left_out.push(format!(
                "{left_over} further lines of the layer {name}: open, or smaller than its outline"
            ));
        }
        for (kind, count) in &layer.left_out {
            self.left_out.push(format!("{count} {kind} of the layer {name}"));
        }
    }

    /// The points and centres of circles of a layer; near others they are the same.
    fn add_spots(&mut self, layer: &Layer, owner: Option<usize>, near: f64) {
        let centres = layer.circles.iter().copied();
        let points = layer.points.iter().map(|point| (*point, 0.0));
        for (at, radius) in centres.chain(points) {
            let found = self.spots.iter().position(|spot| (spot.at - at).norm() <= near);
            let index = found.unwrap_or_else(|| {
                let (name, bodies) = (String::new(), Vec::new());
                self.spots.push(Spot { name, at, bodies, is_of_ground: false, radius });
                self.spots.len() - 1
            });
            let spot = &mut self.spots[index];
            spot.radius = spot.radius.max(radius);
            match owner {
                Some(body) if !spot.bodies.contains(&body) => spot.bodies.push(body),
                Some(_) => {}
                None => spot.is_of_ground = true,
            }
        }
    }

    /// A text names the nearest point if that is near, and of several texts the nearest names it; what has
    /// none is named after its body.
    fn name_spots(&mut self, drawing: &Drawing) {
        let mut nearest: BTreeMap<usize, (f64, &Words)> = BTreeMap::new();
        for words in drawing.layers.iter().flat_map(|layer| &layer.words) {
            let distances = self.spots.iter().map(|spot| (spot.at - words.at).norm() - spot.radius);
            let Some((index, distance)) = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)) else {
                continue;
            };
            let is_nearer = nearest.get(&index).is_none_or(|(other, _)| distance < *other);
            if distance <= BESIDE * words.height && is_nearer {
                nearest.insert(index, (distance, words));
            }
        }
        let mut names = Names::default();
        for (index, (_, words)) in &nearest {
            self.spots[*index].name = names.fresh(&words.text, "point");
        }
        for spot in self.spots.iter_mut().filter(|spot| spot.name.is_empty()) {
            let body = spot.bodies.first().map_or("ground", |body| self.layers[*body].name.as_str());
            spot.name = names.fresh(&format!("{body}_1"), "point");
        }
    }
}

/// Names that are taken.
#[derive(Default)]
struct Names(BTreeSet<String>);

impl Names {
    /// A valid name that is like a text, and not taken.
    fn fresh(&mut self, text: &str, prefix: &str) -> String {
        let kept = |character: char| if character.is_alphanumeric() { character } else { '_' };
        let mut name: String = text.trim().chars().map(kept).collect();
        if !is_valid_name(&name) || is_reserved(&name) || name == "ground" {
            name = format!("{prefix}_{name}");
        }
        if !is_valid_name(&name) {
            prefix.clone_into(&mut name);
        }
        let base = name.strip_suffix("_1").unwrap_or(&name).to_owned();
        let mut number = 1;
        while self.0.contains(&name) {
            number += 1;
            name = format!("{base}_{number}");
        }
        self.0.insert(name.clone());
        name
    }
}

/// The diagonal of the rectangle around everything.
fn size(drawing: &Drawing) -> f64 {
    let of_layer = |layer: &Layer| {
        let corners = layer.paths.iter().flat_map(|path| &path.corners).map(|corner| corner.at);
        let circles = layer.circles.iter().flat_map(|(centre, radius)| {
            let across = Vector2::new(*radius, *radius);
            [centre - across, centre + across]
        });
        corners.chain(circles).chain(layer.points.iter().copied()).collect::<Vec<_>>()
    };
    let places: Vec<Vector2<f64>> = drawing.layers.iter().flat_map(of_layer).collect();
    let least = places.iter().copied().reduce(|a, b| a.inf(&b));
    let greatest = places.iter().copied().reduce(|a, b| a.sup(&b));
    least.zip(greatest).map_or(0.0, |(least, greatest)| (greatest - least).norm())
}

/// The greatest closed line of a layer, or its greatest circle, and how many other lines it has.
fn outline(layer: &Layer, near: f64) -> (Vec<Corner>, usize) {
    let (closed, open): (Vec<Path>, Vec<Path>) = layer.paths.iter().cloned().partition(|path| path.is_closed);
    let (joined, left_open) = chained(open, near);
    let (mut loops, flat): (Vec<Vec<Corner>>, Vec<Vec<Corner>>) = closed
        .into_iter()
        .map(|path| path.corners)
        .chain(joined)
        .map(|corners| without_repetition(corners, near))
        .partition(|corners| area(corners) != 0.0);
    let left_open = left_open + flat.len();
    loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
    if loops.is_empty() {
        let greatest =
            layer.circles.iter().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, radius)| *radius > near);
        let circle = greatest.map(|(centre, radius)| arc(*centre, *radius, [0.0, TAU]));
        return (circle.map_or_else(Vec::new, |circle| without_repetition(circle, near)), left_open);
    }
    let others = loops.len() - 1 + left_open;
    (loops.swap_remove(0), others)
}

/// Without the straight pieces, and the arcs, that are shorter than what counts as one place.
fn without_repetition(corners: Vec<Corner>, near: f64) -> Vec<Corner> {
    let mut kept: Vec<Corner> = Vec::new();
    let is_short = |corner: &Corner, next: Vector2<f64>| {
        let places = [Some(next), corner.arc_through];
        places.into_iter().flatten().all(|place| (place - corner.at).norm() <= near)
    };
    for corner in corners {
        match kept.last_mut() {
            Some(last) if is_short(last, corner.at) => last.arc_through = corner.arc_through,
            _ => kept.push(corner),
        }
    }
    while let [first, .., last] = kept[..]
        && is_short(&last, first.at)
    {
        kept.pop();
    }
    kept
}

/// Closed lines that lines make which join end to end, and the number of those that make none.
fn chained(paths: Vec<Path>, near: f64) -> (Vec<Vec<Corner>>, usize) {
    let ends = Ends::of(&paths, near);
    let mut paths: Vec<Option<Path>> = paths.into_iter().map(Some).collect();
    let (mut closed, mut open) = (Vec::new(), 0);
    for index in 0..paths.len() {
        let Some(Path { mut corners, .. }) = paths[index].take() else { continue };
        let mut count = 1;
        while let [first, .., last] = corners[..]
            && (first.at - last.at).norm() > near
            && let Some(next) = ends.at(last.at, &paths)
            && let Some(Path { corners: mut more, .. }) = paths[next].take()
        {
            if more.first().is_none_or(|start| (start.at - last.at).norm() > near) {
                more = reversed(&more);
            }
            if let (Some(joint), Some(start)) = (corners.last_mut(), more.first()) {
                joint.arc_through = start.arc_through;
            }
            corners.extend(more.into_iter().skip(1));
            count += 1;
        }
        match corners[..] {
            [first, _, .., last] if (first.at - last.at).norm() <= near => closed.push(corners),
            _ => open += count,
        }
    }
    (closed, open)
}

/// Where lines end: cells of a grid as wide as what counts as one place, with the lines that end there.
struct Ends {
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    near: f64,
    places: Vec<[Vector2<f64>; 2]>,
}

impl Ends {
    fn of(paths: &[Path], near: f64) -> Self {
        let place = |corner: Option<&Corner>| corner.map(|corner| corner.at).unwrap_or_default();
        let places: Vec<[Vector2<f64>; 2]> =
            paths.iter().map(|path| [place(path.corners.first()), place(path.corners.last())]).collect();
        let mut ends = Self { cells: BTreeMap::new(), near, places };
        for index in 0..paths.len() {
            for end in ends.places[index] {
                ends.cells.entry(ends.cell(end)).or_default().push(index);
            }
        }
        ends
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most some 1e6 cells along the drawing, or saturated"
    )]
    fn cell(&self, place: Vector2<f64>) -> [i64; 2] {
        [place.x, place.y].map(|part| (part / self.near.max(f64::MIN_POSITIVE)).floor() as i64)
    }

    /// A line that ends at a place and is still there.
    fn at(&self, place: Vector2<f64>, paths: &[Option<Path>]) -> Option<usize> {
        let [x, y] = self.cell(place);
        let around = (-1..=1).flat_map(|across| (-1..=1).map(move |up| [x + across, y + up]));
        let lines = around.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let ends_there = |index: &usize| {
            paths[*index].is_some() && self.places[*index].iter().any(|end| (end - place).norm() <= self.near)
        };
        lines.filter(ends_there).min()
    }
}
