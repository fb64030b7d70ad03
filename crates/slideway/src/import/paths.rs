//! Polygons of lines and arcs, and the bodies and points that a drawing shows.

use super::entities::{Drawing, Layer, Path, Words};
use super::shown;
use crate::expression::{is_reserved, is_valid_name};
use nalgebra::Vector2;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Places nearer to each other than this part of the size of the drawing are one.
const JOINED: f64 = 1e-6;
/// Greatest angle (rad) of a straight piece of an arc: it keeps within 0.4 % of its radius.
const PIECE: f64 = TAU / 36.0;
/// How far a text may be from the point that it names, in heights of its letters.
const BESIDE: f64 = 4.0;

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
    pub(super) outline: Vec<Vector2<f64>>,
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

/// The places on a part of a circle, its ends included, from one angle to another counter-clockwise.
pub(super) fn arc(centre: Vector2<f64>, radius: f64, [from, to]: [f64; 2]) -> Vec<Vector2<f64>> {
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn == 0.0 { TAU } else { turn };
    let count = (turn / PIECE).ceil();
    steps(count)
        .map(|step| {
            let (sin, cos) = (from + turn * step / count).sin_cos();
            centre + Vector2::new(cos, sin) * radius
        })
        .collect()
}

/// The places between the ends of an arc that has a bulge: the tangent of a quarter of its angle, positive
/// counter-clockwise.
pub(super) fn bulge([from, to]: [Vector2<f64>; 2], bulge: f64) -> Vec<Vector2<f64>> {
    let angle = 4.0 * bulge.atan();
    let half = 0.5 * (to - from);
    let across = Vector2::new(-half.y, half.x);
    let centre = from + half + across * ((1.0 - bulge * bulge) / (2.0 * bulge));
    let count = (angle.abs() / PIECE).ceil();
    let turned = |step: f64| {
        let (sin, cos) = (angle * step / count).sin_cos();
        let arm = from - centre;
        centre + Vector2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y)
    };
    steps(count).map(turned).skip(1).take_while(|place| (place - to).norm() > JOINED * half.norm()).collect()
}

/// 0, 1 and so on up to a whole number.
fn steps(count: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(0.0), |step| Some(step + 1.0)).take_while(move |step| *step <= count)
}

/// Twice the area of a polygon, positive counter-clockwise.
fn doubled_area(corners: &[Vector2<f64>]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| from.perp(to)).sum()
}

impl Body {
    /// The centroid of the outline as a homogeneous plate, and the square of its radius of gyration about
    /// that: x_S = 1/(6 A) sum (x_i + x_k) a_i and r^2 + |S|^2 = 1/(12 A) sum (x_i^2 + x_i x_k + x_k^2 + the
    /// same of y) a_i with a_i = x_i y_k - x_k y_i, corner k after i, A = 1/2 sum a_i.
    pub(super) fn plate(&self) -> Option<(Vector2<f64>, f64)> {
        let origin = *self.outline.first()?;
        let places: Vec<Vector2<f64>> = self.outline.iter().map(|corner| corner - origin).collect();
        let area = doubled_area(&places);
        let next = places.iter().cycle().skip(1);
        let (mut centre, mut square) = (Vector2::zeros(), 0.0);
        for (from, to) in places.iter().zip(next) {
            let part = from.perp(to);
            centre += (from + to) * (part / (3.0 * area));
            square += (from.norm_squared() + from.dot(to) + to.norm_squared()) * (part / (6.0 * area));
        }
        Some((origin + centre, square - centre.norm_squared())).filter(|(centre, square)| {
            centre.iter().all(|part| part.is_finite()) && *square > 0.0 && square.is_finite()
        })
    }
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
        let corners = self.layers.iter().flat_map(|body| &body.outline);
        let mut places = corners.chain(self.spots.iter().map(|spot| &spot.at));
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
        let corners = layer.paths.iter().flat_map(|path| path.corners.clone());
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
fn outline(layer: &Layer, near: f64) -> (Vec<Vector2<f64>>, usize) {
    let (closed, open): (Vec<Path>, Vec<Path>) = layer.paths.iter().cloned().partition(|path| path.is_closed);
    let (joined, left_open) = chained(open, near);
    let mut loops: Vec<Vec<Vector2<f64>>> = closed
        .into_iter()
        .map(|path| path.corners)
        .chain(joined)
        .map(|corners| without_repetition(corners, near))
        .filter(|corners| corners.len() >= 3 && doubled_area(corners) != 0.0)
        .collect();
    loops.sort_by(|a, b| doubled_area(b).abs().total_cmp(&doubled_area(a).abs()));
    if loops.is_empty() {
        let greatest =
            layer.circles.iter().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, radius)| *radius > near);
        let circle = greatest.map(|(centre, radius)| arc(*centre, *radius, [0.0, TAU]));
        return (circle.map_or_else(Vec::new, |circle| without_repetition(circle, near)), left_open);
    }
    let others = loops.len() - 1 + left_open;
    (loops.swap_remove(0), others)
}

fn without_repetition(mut corners: Vec<Vector2<f64>>, near: f64) -> Vec<Vector2<f64>> {
    corners.dedup_by(|a, b| (*a - *b).norm() <= near);
    while corners.len() > 1 && (corners[0] - corners[corners.len() - 1]).norm() <= near {
        corners.pop();
    }
    corners
}

/// Closed lines that lines make which join end to end, and the number of those that make none.
fn chained(paths: Vec<Path>, near: f64) -> (Vec<Vec<Vector2<f64>>>, usize) {
    let ends = Ends::of(&paths, near);
    let mut paths: Vec<Option<Path>> = paths.into_iter().map(Some).collect();
    let (mut closed, mut open) = (Vec::new(), 0);
    for index in 0..paths.len() {
        let Some(Path { mut corners, .. }) = paths[index].take() else { continue };
        let mut count = 1;
        while let [first, .., last] = corners[..]
            && (first - last).norm() > near
            && let Some(next) = ends.at(last, &paths)
            && let Some(Path { corners: mut more, .. }) = paths[next].take()
        {
            if more.first().is_none_or(|start| (start - last).norm() > near) {
                more.reverse();
            }
            corners.extend(more.into_iter().skip(1));
            count += 1;
        }
        match corners[..] {
            [first, _, .., last] if corners.len() > 3 && (first - last).norm() <= near => {
                closed.push(corners);
            }
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
        let place = |corner: Option<&Vector2<f64>>| corner.copied().unwrap_or_default();
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
