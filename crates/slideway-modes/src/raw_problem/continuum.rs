//! Infinite sets of solutions, part by part.

use nalgebra::DVector;

use super::RawKind;
use super::report::{ContinuumPart, RawContinuum, Unknowns};
use crate::problem::ContactState;
use crate::search::{CombinedState, GroupState};

/// A combination with at least one part that is a continuum, with at most `most` vertices and directions of
/// each part.
pub(super) fn told(state: &CombinedState<'_>, kind: RawKind, size: usize, most: usize) -> RawContinuum {
    let mut fixed: Vec<(usize, f64)> = Vec::new();
    let mut parts = Vec::new();
    for (indices, part) in &state.parts {
        match (part, part.normal_force()) {
            (_, Some(values)) => fixed.extend(indices.iter().copied().zip(values.iter().copied())),
            (GroupState::Singular(mode), None) => {
                let (vertices, directions) = (mode.set.vertices(), mode.set.directions());
                parts.push(ContinuumPart {
                    indices: indices.to_vec(),
                    vertex_count: vertices.len(),
                    direction_count: directions.len(),
                    vertices: unknowns(kind, &vertices, most),
                    directions: unknowns(kind, &directions, most),
                });
            }
            (_, None) => {}
        }
    }
    parts.sort_by(|one, other| one.indices.cmp(&other.indices));
    if !fixed.is_empty() {
        fixed.sort_by_key(|(index, _)| *index);
        let (indices, values): (Vec<usize>, Vec<f64>) = fixed.into_iter().unzip();
        parts.push(ContinuumPart {
            indices,
            vertices: vec![Unknowns::new(kind, &values)],
            directions: Vec::new(),
            vertex_count: 1,
            direction_count: 0,
        });
    }
    RawContinuum {
        pattern: state.pattern(size).into_iter().map(character).collect(),
        maximal: state.is_maximal(),
        parts,
    }
}

fn unknowns(kind: RawKind, points: &[&DVector<f64>], most: usize) -> Vec<Unknowns> {
    points.iter().take(most).map(|point| Unknowns::new(kind, point.as_slice())).collect()
}

fn character(state: ContactState) -> char {
    match state {
        ContactState::Positive => '+',
        ContactState::Negative => '-',
        ContactState::Gap => '0',
    }
}
