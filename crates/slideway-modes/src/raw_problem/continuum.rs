//! Infinite sets of solutions, part by part.

use nalgebra::DVector;

use super::correspondence::Correspondence;
use super::range::ExactUnknowns;
use super::report::{ContinuumPart, RawContinuum, Unknowns};
use super::values::Sums;
use crate::problem::{ContactState, ModeProblem, SetPart, SolutionSet};
use crate::search::{CORNERS, CombinedState, GroupState};
use crate::solutions::SingularMode;

/// A combination with at least one part that is a continuum, with at most `most` vertices and directions of
/// each part.
pub(super) fn told(
    state: &CombinedState<'_>,
    correspondence: &Correspondence,
    problem: &ModeProblem,
    most: usize,
) -> RawContinuum {
    let size = problem.contacts();
    let pattern = state.pattern(size);
    let points = Points { correspondence, problem, rest: some_point(state, size), pattern: &pattern };
    RawContinuum {
        pattern: correspondence.pattern_of_set(&state.positive_unknowns(size)),
        parts: match correspondence.players() {
            Some(players) => players.map(|player| strategies(state, &points, &player, most)).into(),
            None => parts(state, &points, most),
        },
    }
}

/// A point of the combination, but for groups whose corners are not known.
fn some_point(state: &CombinedState<'_>, size: usize) -> Vec<f64> {
    let mut point = vec![0.0; size];
    let mut set = |contacts: &[usize], values: &DVector<f64>| {
        contacts.iter().zip(values).for_each(|(&contact, &value)| point[contact] = value);
    };
    for (contacts, part) in &state.parts {
        match (part, part.normal_force()) {
            (_, Some(values)) => set(contacts, values),
            (GroupState::Singular(SingularMode { set: SolutionSet::Product(own), .. }), None) => {
                for part in own.iter().map(|part| part.clone().renumbered(|contact| contacts[contact])) {
                    set(&part.contacts, &part.inside);
                }
            }
            (GroupState::Singular(mode), None) => {
                mode.set.vertices().first().into_iter().for_each(|vertex| set(contacts, vertex));
            }
            (_, None) => {}
        }
    }
    point
}

/// Tells points of a set from the values of some of its unknowns.
struct Points<'a> {
    correspondence: &'a Correspondence,
    problem: &'a ModeProblem,
    /// The values of the other unknowns, on which these may depend.
    rest: Vec<f64>,
    pattern: &'a [ContactState],
}

impl Points<'_> {
    fn told(&self, contacts: &[usize], values: &[f64]) -> Unknowns {
        let mut signed = self.rest.clone();
        contacts.iter().zip(values).for_each(|(&contact, &value)| signed[contact] = value);
        self.told_of(contacts, &signed)
    }

    /// Returns the unknowns that follow from these contacts, given the values of all unknowns of the mode
    /// problem.
    fn told_of(&self, contacts: &[usize], signed: &[f64]) -> Unknowns {
        let values: Vec<f64> = contacts.iter().map(|&contact| signed[contact]).collect();
        let exact = ExactUnknowns::new(self.problem, self.pattern, signed);
        self.correspondence.point(contacts, &values, &Sums::of_point(self.correspondence, signed, exact))
    }
}

/// The groups of unknowns that vary together and, last, all those that are fixed.
fn parts(state: &CombinedState<'_>, points: &Points<'_>, most: usize) -> Vec<ContinuumPart> {
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
                        parts.extend(part_of_product(points, &part, most));
                    }
                }
            }
            (GroupState::Singular(mode), None) => {
                let (vertices, directions) = (mode.set.vertices(), mode.set.directions());
                parts.extend(corners(points, contacts, (&vertices, &directions), most));
            }
            (_, None) => {}
        }
    }
    parts.sort_by(|one, other| one.indices.cmp(&other.indices));
    fixed.sort_by_key(|(contact, _)| *contact);
    let (contacts, values): (Vec<usize>, Vec<f64>) = fixed.into_iter().unzip();
    parts.extend(corners(points, &contacts, (&[&DVector::from_vec(values)], &[]), most));
    parts
}

/// A part of a set with many corners; without them if its own are too many.
fn part_of_product(points: &Points<'_>, part: &SetPart<DVector<f64>>, most: usize) -> Option<ContinuumPart> {
    let (vertices, directions) = (part.set.vertices(), part.set.directions());
    let told = corners(points, &part.contacts, (&vertices, &directions), most)?;
    let unlisted = part.set == SolutionSet::NotComputed;
    Some(if unlisted { without_corners(points, part) } else { told })
}

/// A part whose corners are not listed.
fn without_corners(points: &Points<'_>, part: &SetPart<DVector<f64>>) -> ContinuumPart {
    ContinuumPart {
        indices: points.correspondence.indices(&part.contacts),
        vertices: Vec::new(),
        directions: Vec::new(),
        vertex_count: 0,
        direction_count: 0,
        dimension: part.dimension,
        inside: Some(points.told(&part.contacts, part.inside.as_slice())),
    }
}

/// The strategies of one player in a set of equilibria. Those of the two players do not depend on each other:
/// which responses are best for one is determined by the strategy of the other, and so is the payoff.
fn strategies(
    state: &CombinedState<'_>,
    points: &Points<'_>,
    contacts: &[usize],
    most: usize,
) -> ContinuumPart {
    // All unknowns of a game depend on one another, so that they are one group.
    let mut corners: Vec<DVector<f64>> = Vec::new();
    for (_, part) in &state.parts {
        match part {
            GroupState::Singular(SingularMode { set: SolutionSet::Product(parts), .. }) => {
                let own = StrategyParts::of(parts, contacts);
                match own.vertices() {
                    Some(all) => corners.extend(all),
                    None => return without_corners(points, &own.inside(contacts)),
                }
            }
            GroupState::Singular(mode) => corners.extend(mode.set.vertices().into_iter().cloned()),
            other => corners.extend(other.normal_force().cloned()),
        }
    }
    // What strategies of the other player that are not played fall short by varies with this player's strategy, so that a
    // corner keeps all its values.
    let mut vertices = distinct(corners.iter().map(|point| points.told_of(contacts, point.as_slice())));
    let vertex_count = vertices.len();
    vertices.truncate(most);
    let indices = points.correspondence.indices(contacts);
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
    points: &Points<'_>,
    contacts: &[usize],
    (vertices, directions): (&[&DVector<f64>], &[&DVector<f64>]),
    most: usize,
) -> Option<ContinuumPart> {
    let indices = points.correspondence.indices(contacts);
    let vertices = distinct(vertices.iter().map(|one| points.told(contacts, one.as_slice())));
    let direction = |one: &&DVector<f64>| points.correspondence.direction(contacts, one.as_slice());
    let directions = distinct(directions.iter().map(direction));
    (!indices.is_empty()).then(|| ContinuumPart {
        indices,
        vertex_count: vertices.len(),
        direction_count: directions.len(),
        vertices: vertices.into_iter().take(most).collect(),
        directions: directions.into_iter().take(most).collect(),
        dimension: None,
        inside: None,
    })
}

/// Drops those that read like one before.
fn distinct(all: impl Iterator<Item = Unknowns>) -> Vec<Unknowns> {
    let mut kept: Vec<Unknowns> = Vec::new();
    for one in all {
        if !kept.contains(&one) {
            kept.push(one);
        }
    }
    kept
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
        let problem = game.mode_problem().expect("finite");
        let pattern = [ContactState::Positive; 6];
        let points = Points {
            correspondence: &correspondence,
            problem: &problem,
            rest: vec![0.0; 6],
            pattern: &pattern,
        };
        let part = without_corners(&points, &StrategyParts::of(&unlisted, &rows).inside(&rows));
        let Some(Unknowns::Strategies { x, .. }) = part.inside else { panic!("a point inside") };
        assert_eq!((part.dimension, x), (Some(1), vec![0.5, 0.5]));
    }
}
