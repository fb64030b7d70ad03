//! Blocks: groups of entities that a drawing inserts, scaled and turned, also within each other.

use super::curves::arcs;
use super::entities::sign_of_plane;
use super::groups::{Record, Sections};
use super::layers::{Corner, Drawing, Layer, Path, Words};
use super::{ImportFault, goes_on};
use crate::model::OutlineCorner;
use crate::model::outline::Piece;
use crate::progress::Work;
use nalgebra::{Matrix2, Vector2};

/// Blocks within blocks are inserted down to this depth.
const DEPTH: usize = 64;
/// Entities of a drawing with all that its blocks insert, and the corners of their lines.
pub(super) const ENTITIES: usize = 1_000_000;

/// Reads entities, and those of the blocks that they insert.
pub(super) struct Reader<'s, 't> {
    sections: &'s Sections<'t>,
    work: Work<'s>,
    /// How many entities there are so far.
    count: usize,
    /// The names of the blocks that are being inserted, each within the one before.
    within: Vec<String>,
}

/// Where an inserted block lies.
struct Placement {
    /// The base point of the block.
    base: Vector2<f64>,
    linear: Matrix2<f64>,
    at: Vector2<f64>,
    /// Whether circles stay circles.
    is_similar: bool,
    /// Factor of the height of letters.
    height: f64,
}

impl<'s, 't> Reader<'s, 't> {
    /// For the entities of a drawing with these blocks.
    pub(super) fn new(sections: &'s Sections<'t>, work: Work<'s>) -> Self {
        Self { sections, work, count: 0, within: Vec::new() }
    }

    /// Reads records in their order.
    pub(super) fn read(&mut self, records: &[Record<'_>]) -> Result<Drawing, ImportFault> {
        let mut drawing = Drawing::default();
        let mut records = records.iter().peekable();
        let mut done = 0;
        while let Some(record) = records.next() {
            let mut vertices = Vec::new();
            while let Some(vertex) = records.next_if(|next| next.kind == "VERTEX") {
                vertices.push(vertex);
            }
            records.next_if(|next| next.kind == "SEQEND");
            if !goes_on(self.work, "entities", done) {
                break;
            }
            done += 1;
            self.counted(1)?;
            let name = record.first(8).map_or("0", |group| group.value);
            let inserted = if record.kind == "INSERT" { self.inserted(record)? } else { None };
            if let Some((block, placements)) = inserted {
                for (placement, done) in placements.iter().zip(1..) {
                    if !goes_on(self.work, "insertions", done) {
                        break;
                    }
                    drawing.add(&block, placement, name);
                    self.counted(block.size())?;
                }
                continue;
            }
            let layer = drawing.layer(name);
            let before = layer.paths.len();
            layer.read(record, &vertices)?;
            self.counted(layer.paths[before..].iter().map(|path| path.corners.len()).sum())?;
        }
        Ok(drawing)
    }

    fn counted(&mut self, count: usize) -> Result<(), ImportFault> {
        self.count += count;
        if self.count > ENTITIES { Err(ImportFault::TooManyEntities { limit: ENTITIES }) } else { Ok(()) }
    }

    /// Returns the contents of a block and where it is inserted: several times in rows and columns. Returns
    /// `None` if it is left out.
    fn inserted(&mut self, record: &Record<'_>) -> Result<Option<(Drawing, Vec<Placement>)>, ImportFault> {
        let name = record.first(2).map_or("", |group| group.value).to_ascii_uppercase();
        let is_new = self.within.len() < DEPTH && !self.within.contains(&name);
        let Some(block) = self.sections.blocks.get(&name).filter(|_| is_new) else { return Ok(None) };
        let Some(sign) = sign_of_plane(record)?.filter(|_| !record.is_on_sheet()) else { return Ok(None) };
        self.within.push(name);
        let contents = self.read(&block.entities)?;
        self.within.pop();
        let base = Vector2::new(block.head.number_or(10, 0.0)?, block.head.number_or(20, 0.0)?);
        let at = Vector2::new(record.number(10)?, record.number(20)?);
        let scale = [record.number_or(41, 1.0)?, record.number_or(42, 1.0)?];
        let (sin, cos) = record.number_or(50, 0.0)?.to_radians().sin_cos();
        let turn = Matrix2::new(cos, -sin, sin, cos);
        let seen = Matrix2::new(sign, 0.0, 0.0, 1.0);
        let placement = |shift: Vector2<f64>| Placement {
            base,
            linear: seen * turn * Matrix2::new(scale[0], 0.0, 0.0, scale[1]),
            at: seen * (at + turn * shift),
            is_similar: scale[0].abs() == scale[1].abs(),
            height: scale[1].abs(),
        };
        let [columns, rows] = [record.flags(70)?.max(1) as usize, record.flags(71)?.max(1) as usize];
        let apart = [record.number_or(44, 0.0)?, record.number_or(45, 0.0)?];
        self.counted(columns.saturating_mul(rows) - 1)?;
        let places = (0..columns).flat_map(|column| (0..rows).map(move |row| [column as f64, row as f64]));
        let placements = places.map(|[x, y]| placement(Vector2::new(x * apart[0], y * apart[1])));
        Ok(Some((contents, placements.collect())))
    }
}

impl Drawing {
    /// How much is copied where it is inserted.
    fn size(&self) -> usize {
        let of_layer = |layer: &Layer| {
            layer.paths.iter().map(|path| path.corners.len()).sum::<usize>()
                + layer.circles.len()
                + layer.points.len()
                + layer.words.len()
                + layer.left_out.len()
                + 1
        };
        self.layers.iter().map(of_layer).sum()
    }

    /// Adds what a block holds; its layer 0 is the one on which it is inserted.
    fn add(&mut self, block: &Self, placement: &Placement, name: &str) {
        for from in &block.layers {
            let layer = self.layer(if from.name == "0" { name } else { &from.name });
            layer.paths.extend(from.paths.iter().map(|path| placement.path(path)));
            for (centre, radius) in &from.circles {
                placement.circle(*centre, *radius, layer);
            }
            layer.points.extend(from.points.iter().map(|place| placement.place(place)));
            layer.words.extend(from.words.iter().map(|words| Words {
                text: words.text.clone(),
                at: placement.place(&words.at),
                height: words.height * placement.height,
            }));
            for (kind, count) in &from.left_out {
                *layer.left_out.entry(kind.clone()).or_default() += count;
            }
        }
    }
}

impl Placement {
    fn place(&self, place: &Vector2<f64>) -> Vector2<f64> {
        self.linear * (place - self.base) + self.at
    }

    /// Arcs stay arcs, or become parts of ellipses.
    fn path(&self, path: &Path) -> Path {
        let mapped = |corner: &Corner| corner.map(|place| self.place(place));
        if self.is_similar {
            return Path { corners: path.corners.iter().map(mapped).collect(), ..*path };
        }
        let next = path.corners.iter().cycle().skip(1);
        let corners = path.corners.iter().zip(next).flat_map(|(corner, next)| {
            if corner.arc_through.is_none() {
                return vec![mapped(corner)];
            }
            let piece = Piece::new(corner, next.at);
            let mut corners = arcs(&|share: f64| self.place(&piece.at(share)[0]), &[0.0, 0.5, 1.0]);
            corners.pop();
            corners
        });
        Path { corners: corners.collect(), ..*path }
    }

    /// A circle, or an ellipse with its centre as a point.
    fn circle(&self, centre: Vector2<f64>, radius: f64, layer: &mut Layer) {
        if self.is_similar {
            layer.circles.push((self.place(&centre), radius * self.height));
            return;
        }
        layer.points.push(self.place(&centre));
        let ends = [centre + Vector2::new(radius, 0.0), centre - Vector2::new(radius, 0.0)];
        let tops = [centre + Vector2::new(0.0, radius), centre - Vector2::new(0.0, radius)];
        let corners = [0, 1].map(|side| OutlineCorner { at: ends[side], arc_through: Some(tops[side]) });
        layer.paths.push(self.path(&Path { corners: corners.to_vec(), is_closed: true }));
    }
}
