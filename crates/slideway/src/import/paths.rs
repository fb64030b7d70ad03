//! Polygons of lines and arcs, and the bodies and points that a drawing shows.

use super::goes_on;
use super::grid::Grid;
use super::layers::{Corner, Drawing, Layer, Path, Words};
use super::shown;
use crate::expression::{is_reserved, is_valid_name};
use crate::model::OutlineCorner;
use crate::model::outline::moments;
use crate::printable::is_hidden;
use crate::progress::Work;
use nalgebra::Vector2;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

/// Places nearer to each other than this part of the size of the drawing are one.
const JOINED: f64 = 1e-6;
/// How far a text may be from the point that it names, in heights of its letters.
const BESIDE: f64 = 4.0;

/// The bodies and points of a drawing, in its units.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    pub(super) layers: Vec<Body>,
    pub(super) spots: Vec<Spot>,
    /// Parts of the drawing that are in none of these, in words.
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

/// Returns the line from its other end.
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
    /// Finds the bodies and points that a drawing shows.
    pub(super) fn of(drawing: &Drawing, work: Work<'_>) -> Self {
        let (corner, size) = extent(drawing);
        let grid = Grid::new(corner, JOINED * size);
        let mut of_spots = grid.clone();
        let mut bodies = Self { layers: Vec::new(), spots: Vec::new(), left_out: Vec::new() };
        let mut names = Names::default();
        for layer in &drawing.layers {
            let is_ground = layer.name.eq_ignore_ascii_case("ground");
            let (outline, left_over) = outline(layer, &grid, work);
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
            bodies.add_spots((layer, owner), &mut of_spots, work);
        }
        bodies.name_spots(drawing, work);
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
    fn add_spots(&mut self, (layer, owner): (&Layer, Option<usize>), grid: &mut Grid, work: Work<'_>) {
        let centres = layer.circles.iter().copied();
        let points = layer.points.iter().map(|point| (*point, 0.0));
        for ((at, radius), done) in centres.chain(points).zip(1..) {
            if !goes_on(work, "points", done) {
                return;
            }
            let index = grid.first_near(at, |spot| self.spots[spot].at).unwrap_or_else(|| {
                let (name, bodies) = (String::new(), Vec::new());
                self.spots.push(Spot { name, at, bodies, is_of_ground: false, radius });
                grid.add(at, self.spots.len() - 1);
                self.spots.len() - 1
            });
            let spot = &mut self.spots[index];
            spot.radius = spot.radius.max(radius);
            match owner {
                // Bodies come one after the other.
                Some(body) if spot.bodies.last() != Some(&body) => spot.bodies.push(body),
                Some(_) => {}
                None => spot.is_of_ground = true,
            }
        }
    }

    /// A text names the nearest point if that is near, and of several texts the nearest names it; what has
    /// none is named after its body.
    fn name_spots(&mut self, drawing: &Drawing, work: Work<'_>) {
        let order = Order::of(&self.spots);
        let mut nearest: BTreeMap<usize, (f64, &Words)> = BTreeMap::new();
        for words in drawing.layers.iter().flat_map(|layer| &layer.words) {
            let Some((distance, index)) = order.nearest(words, work) else { continue };
            if nearest.get(&index).is_none_or(|(other, _)| distance < *other) {
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

/// Points in the order of one of their coordinates, the one in which they are farther apart.
struct Order<'s> {
    spots: &'s [Spot],
    axis: usize,
    numbers: Vec<usize>,
    /// The greatest radius of a circle about one of them.
    radius: f64,
}

impl<'s> Order<'s> {
    fn of(spots: &'s [Spot]) -> Self {
        let places = || spots.iter().map(|spot| spot.at);
        let least = places().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let greatest = places().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let axis = (greatest - least).imax();
        let mut numbers: Vec<usize> = (0..spots.len()).collect();
        numbers.sort_by(|a, b| spots[*a].at[axis].total_cmp(&spots[*b].at[axis]));
        Self { spots, axis, numbers, radius: spots.iter().map(|spot| spot.radius).fold(0.0, f64::max) }
    }

    /// How far words are from the nearest point or circle, and which one that is, if it is beside them. Looks at
    /// points ever farther away, as long as they may be nearer than what is found.
    fn nearest(&self, words: &Words, work: Work<'_>) -> Option<(f64, usize)> {
        let Self { spots, axis, numbers, radius } = self;
        let along = |spot: usize| spots[spot].at[*axis] - words.at[*axis];
        let from = numbers.partition_point(|spot| along(*spot) < 0.0);
        let (after, before) = (numbers[from..].iter(), numbers[..from].iter().rev());
        let mut best = None;
        let mut look = |looked: usize, spot: usize| {
            let bound = best.map_or(BESIDE * words.height, |(distance, _)| distance);
            let distance = (spots[spot].at - words.at).norm() - spots[spot].radius;
            if distance <= bound && best.is_none_or(|best| (distance, spot) < best) {
                best = Some((distance, spot));
            }
            along(spot).abs() - radius <= bound && goes_on(work, "names", looked)
        };
        let _ = after.enumerate().all(|(looked, spot)| look(looked, *spot));
        let _ = before.enumerate().all(|(looked, spot)| look(looked, *spot));
        best
    }
}

/// Names that are taken.
#[derive(Default)]
struct Names {
    taken: BTreeSet<String>,
    /// The last number behind each name.
    last: BTreeMap<String, usize>,
}

impl Names {
    /// A valid name that is like a text, and not taken.
    fn fresh(&mut self, text: &str, prefix: &str) -> String {
        let is_seen = |character: char| character.is_alphanumeric() && !is_hidden(character);
        let kept = |character: char| if is_seen(character) { character } else { '_' };
        let mut name: String = text.trim().chars().map(kept).collect();
        if !is_valid_name(&name) || is_reserved(&name) || name == "ground" {
            name = format!("{prefix}_{name}");
        }
        if !is_valid_name(&name) {
            prefix.clone_into(&mut name);
        }
        let base = name.strip_suffix("_1").unwrap_or(&name).to_owned();
        let mut number = self.last.get(&base).copied().unwrap_or(1);
        while self.taken.contains(&name) {
            number += 1;
            name = format!("{base}_{number}");
        }
        self.last.insert(base, number);
        self.taken.insert(name.clone());
        name
    }
}

/// The least corner of the rectangle around everything, and its diagonal.
fn extent(drawing: &Drawing) -> (Vector2<f64>, f64) {
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
    least.zip(greatest).map_or_else(Default::default, |(least, greatest)| (least, (greatest - least).norm()))
}

/// The greatest closed line of a layer, or its greatest circle, and how many other lines it has.
fn outline(layer: &Layer, grid: &Grid, work: Work<'_>) -> (Vec<Corner>, usize) {
    let near = grid.near();
    let (closed, open): (Vec<Path>, Vec<Path>) = layer.paths.iter().cloned().partition(|path| path.is_closed);
    let (joined, left_open) = chained(open, grid.clone(), work);
    let lines = closed.into_iter().map(|path| path.corners).chain(joined);
    let areas =
        lines.map(|corners| without_repetition(corners, near)).map(|corners| (area(&corners), corners));
    let (loops, flat): (Vec<_>, Vec<_>) = areas.partition(|(area, _)| *area != 0.0);
    let others = (loops.len() + flat.len() + left_open).saturating_sub(1);
    // The first of the greatest.
    let Some((_, outline)) = loops.into_iter().rev().max_by(|a, b| a.0.total_cmp(&b.0)) else {
        let greatest =
            layer.circles.iter().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, radius)| *radius > near);
        let circle = greatest.map(|(centre, radius)| arc(*centre, *radius, [0.0, TAU]));
        let circle = circle.map_or_else(Vec::new, |circle| without_repetition(circle, near));
        return (circle, flat.len() + left_open);
    };
    (outline, others)
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
fn chained(paths: Vec<Path>, mut grid: Grid, work: Work<'_>) -> (Vec<Vec<Corner>>, usize) {
    let near = grid.near();
    // The ends of the line i are 2 i and 2 i + 1.
    let ends = paths.iter().flat_map(|path| [path.corners.first(), path.corners.last()]);
    let ends: Vec<Vector2<f64>> = ends.map(|end| end.map(|corner| corner.at).unwrap_or_default()).collect();
    ends.iter().enumerate().for_each(|(end, at)| grid.add(*at, end));
    let mut paths: Vec<Option<Path>> = paths.into_iter().map(Some).collect();
    let mut taken = |index: usize, grid: &mut Grid| {
        [2 * index, 2 * index + 1].into_iter().for_each(|end| grid.remove(ends[end], end));
        paths[index].take()
    };
    let (mut closed, mut open) = (Vec::new(), 0);
    for index in 0..ends.len() / 2 {
        if !goes_on(work, "lines", index) {
            break;
        }
        let Some(Path { mut corners, .. }) = taken(index, &mut grid) else { continue };
        let mut count = 1;
        while let [first, .., last] = corners[..]
            && (first.at - last.at).norm() > near
            && let Some(next) = grid.first_near(last.at, |end| ends[end])
            && let Some(Path { corners: mut more, .. }) = taken(next / 2, &mut grid)
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
