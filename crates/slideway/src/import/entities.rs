//! Entities of a drawing: lines, circles, points and words of each layer.

use super::curves::{ellipse, spline};
use super::groups::Record;
use super::layers::{Corner, Layer, Path, Words};
use super::paths::{arc, bulge};
use super::{ImportFault, shown};
use crate::model::OutlineCorner;
use nalgebra::Vector2;

impl Layer {
    pub(super) fn read(&mut self, record: &Record<'_>, vertices: &[&Record<'_>]) -> Result<(), ImportFault> {
        if record.is_on_sheet() {
            self.leave_out(format!("{} on a sheet (paper space)", shown(record.kind)));
            return Ok(());
        }
        let Some(sign) = sign_of_plane(record)? else {
            self.leave_out(format!("{} outside of the plane of the drawing", shown(record.kind)));
            return Ok(());
        };
        match record.kind {
            "LINE" => {
                let ends = [place(record, 10, 1.0)?, place(record, 11, 1.0)?];
                let corners = ends.map(|at| OutlineCorner { at, arc_through: None }).to_vec();
                self.paths.push(Path { corners, is_closed: false });
            }
            "POINT" => self.points.push(place(record, 10, 1.0)?),
            "CIRCLE" => self.circles.push((place(record, 10, sign)?, record.number(40)?.abs())),
            "ARC" => {
                let centre = place(record, 10, 1.0)?;
                let angles = [record.number(50)?, record.number(51)?].map(f64::to_radians);
                let corners = arc(centre, record.number(40)?, angles);
                self.paths.push(Path { corners: mirrored(&corners, sign), is_closed: false });
            }
            "LWPOLYLINE" => {
                let path = polyline(&light_vertices(record)?, record.flags(70)?);
                self.paths.push(Path { corners: mirrored(&path.corners, sign), ..path });
            }
            "POLYLINE" if record.flags(70)? & MESH == 0 => {
                let path = polyline(&heavy_vertices(vertices)?, record.flags(70)?);
                self.paths.push(Path { corners: mirrored(&path.corners, sign), ..path });
            }
            "ELLIPSE" => self.paths.push(ellipse(record, sign)?),
            "SPLINE" => match spline(record)? {
                Some(path) => self.paths.push(path),
                None => self.leave_out("SPLINE without control points that fit its knots".to_owned()),
            },
            "INSERT" => self.leave_out(left_out(record)),
            "TEXT" | "MTEXT" => self.read_words(record, sign)?,
            kind => self.leave_out(shown(kind)),
        }
        Ok(())
    }

    fn read_words(&mut self, record: &Record<'_>, sign: f64) -> Result<(), ImportFault> {
        let text = record.first(1).map_or("", |group| group.value);
        if text.contains(['\\', '{', '%']) {
            self.leave_out(format!("{} with formatting", record.kind));
            return Ok(());
        }
        // A text that is not adjusted to the left stands at its second place.
        let is_adjusted = record.kind == "TEXT" && (record.flags(72)? != 0 || record.flags(73)? != 0);
        let code = if is_adjusted && record.first(11).is_some() { 11 } else { 10 };
        let height = record.number_or(40, 0.0)?.abs();
        self.words.push(Words { text: text.to_owned(), at: place(record, code, sign)?, height });
        Ok(())
    }

    fn leave_out(&mut self, what: String) {
        *self.left_out.entry(what).or_default() += 1;
    }
}

/// Flags of a `POLYLINE` that is a mesh: polygon mesh and polyface mesh.
const MESH: u32 = 16 | 64;
/// Flag of a vertex that is a control point of a spline.
const CONTROL: u32 = 16;

/// The sense of the x axis of an entity: 1, or -1 if its plane is seen from behind (extrusion direction along
/// -z: the x axis of its own coordinates is then -x). None for other planes.
pub(super) fn sign_of_plane(record: &Record<'_>) -> Result<Option<f64>, ImportFault> {
    let normal = [record.number_or(210, 0.0)?, record.number_or(220, 0.0)?, record.number_or(230, 1.0)?];
    let is_plane = normal[0] == 0.0 && normal[1] == 0.0 && normal[2] != 0.0;
    Ok(is_plane.then(|| normal[2].signum()))
}

/// The place whose x has this code, and its y the one that is greater by 10.
fn place(record: &Record<'_>, code: i32, sign: f64) -> Result<Vector2<f64>, ImportFault> {
    Ok(Vector2::new(sign * record.number(code)?, record.number(code + 10)?))
}

fn mirrored(corners: &[Corner], sign: f64) -> Vec<Corner> {
    corners.iter().map(|corner| corner.map(|place| Vector2::new(sign * place.x, place.y))).collect()
}

/// The vertices of a light polyline with their bulges.
fn light_vertices(record: &Record<'_>) -> Result<Vec<(Vector2<f64>, f64)>, ImportFault> {
    let mut vertices: Vec<(Vector2<f64>, f64)> = Vec::new();
    for group in &record.groups {
        match (group.code, vertices.last_mut()) {
            (10, _) => vertices.push((Vector2::new(record.number_of(*group)?, 0.0), 0.0)),
            (20, Some((place, _))) => place.y = record.number_of(*group)?,
            (42, Some((_, bulge))) => *bulge = record.number_of(*group)?,
            _ => {}
        }
    }
    Ok(vertices)
}

/// Reads the vertices, with their bulges, of a polyline whose vertices are entities.
fn heavy_vertices(records: &[&Record<'_>]) -> Result<Vec<(Vector2<f64>, f64)>, ImportFault> {
    let mut vertices = Vec::new();
    for record in records {
        if record.flags(70)? & CONTROL == 0 {
            vertices.push((place(record, 10, 1.0)?, record.number_or(42, 0.0)?));
        }
    }
    Ok(vertices)
}

/// A polyline with its arcs.
fn polyline(vertices: &[(Vector2<f64>, f64)], flags: u32) -> Path {
    let is_closed = flags & 1 == 1;
    let corner = |(index, (at, bulged)): (usize, &(Vector2<f64>, f64))| {
        let next = vertices.get(index + 1).or(vertices.first().filter(|_| is_closed));
        let arc_through = next.filter(|_| *bulged != 0.0).map(|(next, _)| bulge([*at, *next], *bulged));
        OutlineCorner { at: *at, arc_through }
    };
    Path { corners: vertices.iter().enumerate().map(corner).collect(), is_closed }
}

/// Why an `INSERT` is left out whose plane and sheet are not the reason.
pub(super) fn left_out(record: &Record<'_>) -> String {
    let name = record.first(2).map_or("", |group| group.value);
    format!("INSERT of {}, which is no block of the drawing, or within itself", shown(name))
}
