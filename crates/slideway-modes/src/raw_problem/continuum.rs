//! Infinite sets of solutions, part by part.

use nalgebra::DVector;

use super::correspondence::Correspondence;
use super::report::{ContinuumPart, RawContinuum, Unknowns};
use crate::problem::{SetPart, SolutionSet};
use crate::search::{CORNERS, CombinedState, GroupState};
use crate::solutions::SingularMode;

/// A combination with at least one part that is a continuum, with at most `most` vertices and directions of
/// each part.
pub(super) fn told(
    state: &CombinedState<'_>,
    correspondence: &Correspondence,
    size: usize,
    most: usize,
) -> RawContinuum {
    RawContinuum {
        pattern: correspondence.pattern_of_set(&state.pattern(size), &state.positive_unknowns(size)),
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
            (GroupState::Singular(SingularMode { set: SolutionSet::Product(own), .. }), None) => {
                for part in own.iter().map(|part| part.clone().renumbered(|contact| contacts[contact])) {
                    if let SolutionSet::Point(point) = &part.set {
                        fixed.extend(part.contacts.into_iter().zip(point.iter().copied()));
                    } else {
                        parts.extend(part_of_product(correspondence, &part, most));
                    }
                }
            }
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

/// A part of a set with many corners; without them if its own are too many.
fn part_of_product(
    correspondence: &Correspondence,
    part: &SetPart<DVector<f64>>,
    most: usize,
) -> Option<ContinuumPart> {
    let (vertices, directions) = (part.set.vertices(), part.set.directions());
    let told = corners(correspondence, &part.contacts, (&vertices, &directions), most)?;
    let unlisted = part.set == SolutionSet::NotComputed;
    Some(if unlisted { without_corners(correspondence, part) } else { told })
}

/// A part whose corners are not listed.
fn without_corners(correspondence: &Correspondence, part: &SetPart<DVector<f64>>) -> ContinuumPart {
    ContinuumPart {
        indices: correspondence.indices(&part.contacts),
        vertices: Vec::new(),
        directions: Vec::new(),
        vertex_count: 0,
        direction_count: 0,
        dimension: part.dimension,
        inside: Some(correspondence.point(&part.contacts, part.inside.as_slice())),
    }
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
    let mut points: Vec<DVector<f64>> = Vec::new();
    for (_, part) in &state.parts {
        match part {
            GroupState::Singular(SingularMode { set: SolutionSet::Product(parts), .. }) => {
                let own = StrategyParts::of(parts, contacts);
                match own.vertices() {
                    Some(all) => points.extend(all),
                    None => return without_corners(correspondence, &own.inside(contacts)),
                }
            }
            GroupState::Singular(mode) => points.extend(mode.set.vertices().into_iter().cloned()),
            other => points.extend(other.normal_force().cloned()),
        }
    }
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
    ContinuumPart {
        indices,
        vertices,
        directions: Vec::new(),
        vertex_count,
        direction_count: 0,
        dimension: None,
        inside: None,
    }
}

/// The parts of a set of equilibria in which one player's strategy varies.
struct StrategyParts<'a> {
    varying: Vec<&'a SetPart<DVector<f64>>>,
    /// A point inside the whole set.
    inside: DVector<f64>,
}

impl<'a> StrategyParts<'a> {
    /// Of the player with these unknowns. Negative ones are what a strategy that is not played falls short by, which
    /// depends on the other player's strategy.
    fn of(parts: &'a [SetPart<DVector<f64>>], contacts: &[usize]) -> Self {
        let mut inside = DVector::zeros(parts.iter().map(|part| part.contacts.len()).sum());
        for part in parts {
            part.contacts.iter().zip(&part.inside).for_each(|(&contact, &value)| inside[contact] = value);
        }
        let is_own = |part: &&SetPart<DVector<f64>>| {
            part.dimension != Some(0)
                && part.contacts.iter().any(|at| inside[*at] > 0.0 && contacts.contains(at))
        };
        Self { varying: parts.iter().filter(is_own).collect(), inside }
    }

    /// All combinations of vertices; `None` if they are too many.
    fn vertices(&self) -> Option<Vec<DVector<f64>>> {
        let mut all = vec![self.inside.clone()];
        for part in &self.varying {
            let own = part.set.vertices();
            if own.is_empty() || all.len().saturating_mul(own.len()) > CORNERS {
                return None;
            }
            let with = |base: &DVector<f64>, own: &DVector<f64>| {
                let mut point = base.clone();
                part.contacts.iter().zip(own).for_each(|(&contact, &value)| point[contact] = value);
                point
            };
            all = all.iter().flat_map(|base| own.iter().map(|&own| with(base, own))).collect();
        }
        Some(all)
    }

    /// The player's strategies without their vertices.
    fn inside(&self, contacts: &[usize]) -> SetPart<DVector<f64>> {
        SetPart {
            contacts: contacts.to_vec(),
            inside: DVector::from_iterator(contacts.len(), contacts.iter().map(|&at| self.inside[at])),
            dimension: self.varying.iter().map(|part| part.dimension).sum(),
            set: SolutionSet::NotComputed,
        }
    }
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
        dimension: None,
        inside: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_problem::RawProblem;
    use nalgebra::{DMatrix, dvector};

    /// Player 1 mixes all of two rows, `x_1 + x_2 = 1`; player 2 plays the first column, the second falls short by 2.
    /// The strategies of a player have a part, with vertices or without.
    #[test]
    fn strategies_by_parts_are_those_of_one_player() {
        let ones = DMatrix::repeat(2, 2, 1.0);
        let game = RawProblem::Game { a: ones.clone(), b: ones };
        let correspondence = Correspondence::of(&game);
        let mix = |set| SetPart { contacts: vec![0, 1], inside: dvector![0.5, 0.5], dimension: Some(1), set };
        let point = dvector![1.0, -2.0, 1.0, 1.0];
        let rest = SetPart {
            contacts: vec![2, 3, 4, 5],
            inside: point.clone(),
            dimension: Some(0),
            set: SolutionSet::Point(point),
        };
        let ends = SolutionSet::Segment { from: dvector![1.0, 0.0], to: dvector![0.0, 1.0] };
        let [rows, columns] = correspondence.players().expect("a game");
        let listed = [mix(ends), rest.clone()];
        let vertices = StrategyParts::of(&listed, &rows).vertices().expect("few");
        assert_eq!(vertices.iter().map(|vertex| vertex[0]).collect::<Vec<_>>(), [1.0, 0.0]);
        assert_eq!(StrategyParts::of(&listed, &columns).vertices().map(|all| all.len()), Some(1));
        let unlisted = [mix(SolutionSet::NotComputed), rest];
        assert_eq!(StrategyParts::of(&unlisted, &rows).vertices(), None);
        let part = without_corners(&correspondence, &StrategyParts::of(&unlisted, &rows).inside(&rows));
        let Some(Unknowns::Strategies { x, .. }) = part.inside else { panic!("a point inside") };
        assert_eq!((part.dimension, x), (Some(1), vec![0.5, 0.5]));
    }
}
