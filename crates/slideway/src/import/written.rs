//! The model file that a drawing becomes.

use super::layers::Corner;
use super::paths::{Bodies, Body, Spot};
use super::{Unit, shown};
use crate::drawing::{quoted, written_key};
use nalgebra::Vector2;
use std::fmt::Write;

/// Places in a line of an outline.
const IN_A_LINE: usize = 4;

/// The text of the model.
pub(super) fn model(bodies: &Bodies, unit: Unit, title: Option<&str>) -> String {
    let corners = bodies.layers.iter().flat_map(Body::places);
    let places = corners.chain(bodies.spots.iter().map(|spot| spot.at));
    let size = places.map(|place| place.amax()).fold(0.0, f64::max);
    let mut points = vec![Vec::new(); bodies.layers.len()];
    for spot in &bodies.spots {
        spot.bodies.iter().for_each(|body| points[*body].push(spot.name.as_str()));
    }
    let writer = Writer { bodies, points, unit, decimals: decimals(size) };
    let mut text = writer.head();
    if let Some(title) = title {
        let _ = writeln!(text, "title = {}", quoted(title));
    }
    if !bodies.spots.is_empty() {
        text.push_str("\n[points]\n");
        bodies.spots.iter().for_each(|spot| text.push_str(&writer.spot(spot)));
    }
    bodies.layers.iter().enumerate().for_each(|(index, body)| text.push_str(&writer.body(index, body)));
    text.push_str(&writer.joints());
    text
}

struct Writer<'b> {
    bodies: &'b Bodies,
    /// Of each body.
    points: Vec<Vec<&'b str>>,
    unit: Unit,
    /// Of coordinates.
    decimals: usize,
}

impl Writer<'_> {
    fn head(&self) -> String {
        let mut head = format!(
            "# Outlines and points of a DXF drawing, in {}; each layer is a body. To be completed: the masses, the joints\n\
             # (below are those that points in one place suggest), loads, and coordinates. `slideway check` on this file says\n\
             # what is still missing.\n",
            self.unit
        );
        if !self.bodies.left_out.is_empty() {
            head.push_str("# Left out:\n");
            self.bodies.left_out.iter().for_each(|what| {
                let _ = writeln!(head, "# - {what}");
            });
        }
        head
    }

    fn spot(&self, spot: &Spot) -> String {
        let owners: Vec<&str> = self.owners(spot).collect();
        format!("{} = {}   # {}\n", written_key(&spot.name), self.place(spot.at), owners.join(", "))
    }

    fn owners<'s>(&'s self, spot: &'s Spot) -> impl Iterator<Item = &'s str> {
        let bodies = spot.bodies.iter().map(|body| self.bodies.layers[*body].name.as_str());
        bodies.chain(spot.is_of_ground.then_some("ground"))
    }

    fn body(&self, index: usize, body: &Body) -> String {
        let key = written_key(&body.name);
        let mut text = format!("\n[bodies.{key}]   # layer {}\n", shown(&body.layer));
        let points: Vec<String> = self.points[index].iter().map(|name| quoted(name)).collect();
        let _ = writeln!(text, "points = [{}]", points.join(", "));
        text.push_str("massless = true\n");
        if let Some((centre, square)) = body.plate() {
            let _ = writeln!(
                text,
                "# With a mass, a homogeneous plate of this outline has, in place of `massless`:\n\
                 # mass = \"1 kg\"\n# centre_of_mass = {}\n# moment_of_inertia = \"(1 kg)*({} {}^2)\"",
                self.place(centre),
                rounded(square, decimals(square)),
                self.unit
            );
        }
        if !body.outline.is_empty() {
            text.push_str("outline = [\n");
            let places: Vec<String> = body.outline.iter().flat_map(|corner| self.corner(corner)).collect();
            for places in places.chunks(IN_A_LINE) {
                let _ = writeln!(text, "    {},", places.join(", "));
            }
            text.push_str("]\n");
        }
        text
    }

    /// Hinges that points in one place suggest, and a sliding joint to be copied, as comments.
    fn joints(&self) -> String {
        let mut text = String::new();
        for spot in &self.bodies.spots {
            let owners: Vec<&str> = self.owners(spot).collect();
            for pair in owners.windows(2) {
                let ends = [0, 1].map(|end| quoted(&format!("{}.{}", pair[end], spot.name)));
                let _ = write!(
                    text,
                    "\n# [joints.{}]\n# type = \"hinge\"\n# between = [{}, {}]\n",
                    written_key(&format!("{}_{}_{}", spot.name, pair[0], pair[1])),
                    ends[0],
                    ends[1]
                );
            }
        }
        if let Some(body) = self.bodies.layers.first() {
            let _ = write!(
                text,
                "\n# [joints.guide]\n# type = \"block_slider\"\n# block = {}\n# at = [0, 0]\n# along = \"0 deg\"\n\
                 # length = \"100 {}\"\n# mu = 0.2\n\n# [coordinates.x]\n# slide = \"guide\"\n# rate = \"10 mm/s\"\n",
                quoted(&body.name),
                self.unit
            );
        }
        text
    }

    /// A corner, and the arc to the next one.
    fn corner(&self, corner: &Corner) -> impl Iterator<Item = String> {
        let arc = corner.arc_through.map(|through| format!("{{ through = {} }}", self.place(through)));
        [self.place(corner.at)].into_iter().chain(arc)
    }

    fn place(&self, place: Vector2<f64>) -> String {
        let [x, y] = [place.x, place.y].map(|part| rounded(part, self.decimals));
        format!("[\"{x} {unit}\", \"{y} {unit}\"]", unit = self.unit)
    }
}

/// So many decimals that a value has nine digits: what arcs add is not known more exactly.
fn decimals(value: f64) -> usize {
    const DIGITS: f64 = 9.0;
    const MOST: f64 = 300.0;
    let before = if value > 0.0 { value.log10().floor() + 1.0 } else { 0.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let decimals = (DIGITS - before).clamp(0.0, MOST) as usize;
    decimals
}

/// A number with at most so many decimals.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
