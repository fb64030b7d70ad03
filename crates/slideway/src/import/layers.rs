//! The layers of a drawing and what they hold.

use crate::model::OutlineCorner;
use nalgebra::Vector2;
use std::collections::BTreeMap;

/// A drawing, layer by layer in the order in which they occur.
#[derive(Debug, Clone, Default)]
pub(super) struct Drawing {
    pub(super) layers: Vec<Layer>,
    /// Which layer has a name.
    named: BTreeMap<String, usize>,
}

/// Contents of a layer, in units of the drawing.
#[derive(Debug, Clone, Default)]
pub(super) struct Layer {
    pub(super) name: String,
    pub(super) paths: Vec<Path>,
    pub(super) circles: Vec<(Vector2<f64>, f64)>,
    pub(super) points: Vec<Vector2<f64>>,
    pub(super) words: Vec<Words>,
    /// How many entities of each kind are left out.
    pub(super) left_out: BTreeMap<String, usize>,
}

/// A line of straight pieces and arcs.
#[derive(Debug, Clone)]
pub(super) struct Path {
    pub(super) corners: Vec<Corner>,
    pub(super) is_closed: bool,
}

/// A line of text.
#[derive(Debug, Clone)]
pub(super) struct Words {
    pub(super) text: String,
    pub(super) at: Vector2<f64>,
    pub(super) height: f64,
}

impl Drawing {
    pub(super) fn layer(&mut self, name: &str) -> &mut Layer {
        let found = self.named.get(name).copied();
        let index = found.unwrap_or_else(|| {
            self.layers.push(Layer { name: name.to_owned(), ..Layer::default() });
            self.named.insert(name.to_owned(), self.layers.len() - 1);
            self.layers.len() - 1
        });
        &mut self.layers[index]
    }
}

/// A corner of a line, and the arc that begins there.
pub(super) type Corner = OutlineCorner<Vector2<f64>>;
