//! Infinite sets of solutions, part by part.

use nalgebra::DVector;

use super::correspondence::Correspondence;
use super::report::{ContinuumPart, RawContinuum, Unknowns};
use crate::search::{CombinedState, GroupState};

/// A combination with at least one part that is a continuum, with at most `most` vertices and directions of
/// each part.
pub(super) fn told(
    state: &CombinedState<'_>,
    correspondence: &Correspondence,
    size: usize,
    most: usize,
) -> RawContinuum {
    RawContinuum {
        pattern: correspondence.pattern(&state.pattern(size)),
        parts: match correspondence.players() {
            Some(players) => players.map(|player| strategies(state, correspondence, &player, most)).into(),
            None => parts(state, correspondence, most),
        },
    }
}

/// The groups of unknowns that vary together and, last, all those that are fixed.
fn parts(state: &CombinedState<'_>, correspondence: &Correspondence, most: usize) -> Vec<ContinuumPart> {
    let mut fixed: Vec<(usize, f64)> = Vec::new();
    let mut parts = Vec::new();
    for (contacts, part) in &state.parts {
        match (part, part.normal_force()) {
            (_, Some(values)) => fixed.extend(contacts.iter().copied().zip(values.iter().copied())),
            (GroupState::Singular(mode), None) => {
                let (vertices, directions) = (mode.set.vertices(), mode.set.directions());
                parts.extend(corners(correspondence, contacts, (&vertices, &directions), most));
            }
            (_, None) => {}
        }
    }
    parts.sort_by(|one, other| one.indices.cmp(&other.indices));
    fixed.sort_by_key(|(contact, _)| *contact);
    let (contacts, values): (Vec<usize>, Vec<f64>) = fixed.into_iter().unzip();
    parts.extend(corners(correspondence, &contacts, (&[&DVector::from_vec(values)], &[]), most));
    parts
}

/// The strategies of one player in a set of equilibria. Those of the two players do not depend on each other:
/// which responses are best for one is determined by the strategy of the other, and so is the payoff.
fn strategies(
    state: &CombinedState<'_>,
    correspondence: &Correspondence,
    contacts: &[usize],
    most: usize,
) -> ContinuumPart {
    // All unknowns of a game depend on one another, so that they are one group.
    let points = state.parts.iter().flat_map(|(_, part)| match part {
        GroupState::Singular(mode) => mode.set.vertices(),
        other => other.normal_force().into_iter().collect(),
    });
    let mut vertices: Vec<Unknowns> = Vec::new();
    for point in points {
        let values: Vec<f64> = contacts.iter().map(|&contact| point[contact]).collect();
        let vertex = correspondence.point(contacts, &values);
        if !vertices.contains(&vertex) {
            vertices.push(vertex);
        }
    }
    let vertex_count = vertices.len();
    vertices.truncate(most);
    let indices = correspondence.indices(contacts);
    ContinuumPart { indices, vertices, directions: Vec::new(), vertex_count, direction_count: 0 }
}

/// The set with these vertices and directions; `None` if the problem has no such unknowns.
fn corners(
    correspondence: &Correspondence,
    contacts: &[usize],
    (vertices, directions): (&[&DVector<f64>], &[&DVector<f64>]),
    most: usize,
) -> Option<ContinuumPart> {
    let indices = correspondence.indices(contacts);
    let point = |one: &&DVector<f64>| correspondence.point(contacts, one.as_slice());
    let direction = |one: &&DVector<f64>| correspondence.direction(contacts, one.as_slice());
    (!indices.is_empty()).then(|| ContinuumPart {
        indices,
        vertices: vertices.iter().take(most).map(point).collect(),
        directions: directions.iter().take(most).map(direction).collect(),
        vertex_count: vertices.len(),
        direction_count: directions.len(),
    })
}
