//! Continua in which free unknowns change sign.
//!
//! A free unknown is the difference of a pair of the mode problem. The search therefore finds a continuum in pieces, in
//! each of which no free unknown changes sign. Let `S` be the other unknowns that are positive somewhere in a piece.
//! All solutions in which no others are positive are one polyhedron: complementarity holds throughout. The planes in
//! which free unknowns vanish divide it into pieces of its own dimension, and inside each of these all of `S` are
//! positive. So the pieces with the same `S` are the whole polyhedron.
//!
//! Its faces are where some of `S` vanish. A vertex of a piece is one of the whole exactly if no vertex has fewer
//! positive unknowns of `S`; the same holds for directions. If the polyhedron contains lines, in which only free unknowns
//! vary, it has no vertices: instead there is one point of each of its smallest faces, one direction of each of the next
//! larger ones, and both directions of lines that span all of them. Which unknowns vanish is exact, and nothing else
//! is used.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::DVector;

use super::correspondence::Correspondence;
use crate::problem::SolutionSet;
use crate::search::{Alternative, Completeness, Factor, GroupState, SearchResult, SolutionProduct};
use crate::solutions::{ContactSet, SingularMode, Support};

/// The result of a search with one set for all pieces that differ in the signs of free unknowns; as it is unless all
/// pieces are found.
pub(super) fn with_whole_continua(mut result: SearchResult, correspondence: &Correspondence) -> SearchResult {
    if result.completeness == Completeness::Proven {
        join_pieces(&mut result.product, correspondence);
    }
    result
}

fn join_pieces(product: &mut SolutionProduct, correspondence: &Correspondence) {
    for factor in &mut product.factors {
        for alternative in &mut factor.alternatives {
            join_pieces(&mut alternative.dependents, correspondence);
        }
        let free: Vec<bool> =
            factor.contacts.iter().map(|&contact| correspondence.is_free(contact)).collect();
        if free.contains(&true) {
            join_pieces_of_group(factor, &free);
        }
    }
}

/// Pieces with the same other unknowns become one alternative, in the place of the first of them.
fn join_pieces_of_group(factor: &mut Factor, free: &[bool]) {
    let mut places: HashMap<Vec<[bool; 4]>, usize> = HashMap::new();
    let mut sets: Vec<Vec<Alternative>> = Vec::new();
    for alternative in std::mem::take(&mut factor.alternatives) {
        let place = match &*alternative.state {
            GroupState::Singular(mode) if mode.maximal && mode.set.is_continuum() => {
                let others = (0..free.len()).filter(|&at| !free[at]).map(|at| mode.support.of_contact(at));
                *places.entry(others.collect()).or_insert(sets.len())
            }
            _ => sets.len(),
        };
        match sets.get_mut(place) {
            Some(pieces) => pieces.push(alternative),
            None => sets.push(vec![alternative]),
        }
    }
    factor.alternatives = sets.into_iter().flat_map(|pieces| joined(pieces, free)).collect();
}

/// All pieces of a set as one; as they are if the corners of some are not listed.
fn joined(pieces: Vec<Alternative>, free: &[bool]) -> Vec<Alternative> {
    let modes: Vec<&SingularMode> = pieces
        .iter()
        .filter_map(|piece| match &*piece.state {
            GroupState::Singular(mode) if !mode.set.vertices().is_empty() => Some(mode),
            _ => None,
        })
        .collect();
    if pieces.len() == 1 || modes.len() < pieces.len() {
        return pieces;
    }
    let mut support = Support::none_of(free.len());
    let all: Vec<usize> = (0..free.len()).collect();
    modes.iter().for_each(|mode| support.add_part(&all, &mode.support));
    let whole = SingularMode {
        patterns: modes.iter().flat_map(|mode| mode.patterns.iter().cloned()).collect(),
        pattern_count: modes.iter().map(|mode| mode.pattern_count).sum(),
        set: union(&modes, free),
        support,
        ..modes[0].clone()
    };
    let dependents = pieces[0].dependents.clone();
    vec![Alternative { state: Arc::new(GroupState::Singular(whole)), dependents }]
}

/// The union of all pieces of a polyhedron.
fn union(pieces: &[&SingularMode], free: &[bool]) -> SolutionSet {
    let vertices = pieces.iter().flat_map(|mode| mode.set.vertices());
    let directions = pieces.iter().flat_map(|mode| mode.set.directions());
    let (lines, directions): (Vec<_>, Vec<_>) = directions.partition(|one| others(one, free).is_empty());
    let mut directions = smallest(directions.into_iter(), free);
    directions.extend(spanning(&lines).into_iter().flat_map(|line| [line.clone(), -line]));
    SolutionSet::from_corners(smallest(vertices, free), directions)
}

/// The sides on which contacts other than the free ones are pressed.
fn others(point: &DVector<f64>, free: &[bool]) -> ContactSet {
    let mut sides = ContactSet::none_of(2 * free.len());
    for (contact, &value) in
        point.iter().enumerate().filter(|(contact, value)| !free[*contact] && **value != 0.0)
    {
        sides.insert(2 * contact + usize::from(value < 0.0));
    }
    sides
}

/// One point for each smallest set of its sides that are not free.
fn smallest<'p>(points: impl Iterator<Item = &'p DVector<f64>>, free: &[bool]) -> Vec<DVector<f64>> {
    let mut kept: Vec<(ContactSet, &DVector<f64>)> = Vec::new();
    for point in points {
        let sides = others(point, free);
        if !kept.iter().any(|(known, _)| known.is_within(&sides)) {
            kept.retain(|(known, _)| !sides.is_within(known));
            kept.push((sides, point));
        }
    }
    kept.into_iter().map(|(_, point)| point.clone()).collect()
}

/// Independent directions that span all given ones: all those of a linear space with as many zeros as possible.
///
/// With each, as few entries as possible become nonzero that were zero in all before. These are then all multiples of
/// those of one direction, up to the directions before it: so the dimension grows by one.
fn spanning(lines: &[&DVector<f64>]) -> Vec<DVector<f64>> {
    let new = |line: &DVector<f64>, reached: &[bool]| {
        line.iter().zip(reached).filter(|(value, reached)| **value != 0.0 && !**reached).count()
    };
    let mut reached = vec![false; lines.first().map_or(0, |line| line.len())];
    let mut chosen = Vec::new();
    while let Some(line) =
        lines.iter().filter(|line| new(line, &reached) > 0).min_by_key(|line| new(line, &reached))
    {
        line.iter().zip(&mut reached).for_each(|(value, reached)| *reached |= *value != 0.0);
        chosen.push((*line).clone());
    }
    chosen
}
