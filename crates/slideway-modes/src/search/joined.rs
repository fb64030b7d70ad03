//! States of all contacts, combined from those of their groups.

use nalgebra::DVector;

use super::product::{CombinedState, GroupState};
use crate::interval::Interval;
use crate::problem::{ContactState, SetPart, Side, SolutionSet};
use crate::solutions::{Certificate, GapState, ModeSolution, ModeState, SingularMode, UndecidedPattern};

/// The maximum number of vertices and directions of a set that is a product of several.
pub(crate) const CORNERS: usize = 4096;

impl CombinedState<'_> {
    /// The combination as one state of this number of contacts, with at most `listed` patterns.
    ///
    /// `D` is the product of those of the groups, as for the whole matrix. Sets of singular patterns are
    /// multiplied; with more than 4096 vertices or directions, they are listed by parts.
    pub fn joined(&self, contacts: usize, listed: usize) -> GroupState {
        let joint = Joint { state: self, contacts, listed };
        match self.parts.iter().map(|(_, state)| state.kind()).max() {
            None | Some(super::StateKind::Solution) => GroupState::Solution(joint.solution()),
            Some(super::StateKind::Gap) => GroupState::Gap(joint.gap_state()),
            Some(super::StateKind::Singular) => GroupState::Singular(joint.singular_mode()),
            Some(super::StateKind::Undecided) => GroupState::Undecided(joint.undecided()),
        }
    }

    /// Returns the statement that is proven about the combination.
    pub fn certificate(&self, contacts: usize) -> Certificate {
        Joint { state: self, contacts, listed: 1 }.certificate()
    }
}

struct Joint<'a> {
    state: &'a CombinedState<'a>,
    contacts: usize,
    listed: usize,
}

impl Joint<'_> {
    fn solution(&self) -> ModeSolution {
        self.state(sides)
    }

    fn gap_state(&self) -> GapState {
        self.state(<[ContactState]>::to_vec)
    }

    fn state<S>(&self, states: fn(&[ContactState]) -> Vec<S>) -> ModeState<S> {
        let normal_force = self.normal_force();
        let (patterns, pattern_count) = self.patterns();
        ModeState {
            pattern: states(&self.state.pattern(self.contacts)),
            shares: self.state.shares(),
            signs: self.signs(),
            y: normal_force.abs(),
            normal_force,
            determinant: self.determinant(),
            on_boundary: self.on_boundary(),
            patterns: patterns.iter().map(|pattern| states(pattern)).collect(),
            pattern_count,
            tolerance: self.tolerance(),
            maximal: self.state.is_maximal(),
            support: self.state.support(self.contacts),
            certificate: self.certificate(),
        }
    }

    fn singular_mode(&self) -> SingularMode {
        let (patterns, pattern_count) = self.patterns();
        let set = self.set();
        let is_point = matches!(set, SolutionSet::Point(_));
        SingularMode {
            pattern: self.state.pattern(self.contacts),
            patterns,
            pattern_count,
            set,
            shares: if is_point { self.state.shares() } else { Vec::new() },
            shares_vary: is_point && self.state.shares_vary(),
            contains: Vec::new(),
            maximal: self.state.is_maximal(),
            support: self.state.support(self.contacts),
            certificate: self.certificate(),
        }
    }

    fn undecided(&self) -> UndecidedPattern {
        let mut in_doubt: Vec<usize> = Vec::new();
        for (members, state) in &self.state.parts {
            in_doubt.extend(contacts_in_doubt(state).iter().map(|&contact| members[contact]));
        }
        in_doubt.sort_unstable();
        let (patterns, _) = self.patterns();
        let unknowns = self.unknowns();
        UndecidedPattern { pattern: self.state.pattern(self.contacts), patterns, unknowns, in_doubt }
    }

    /// Values for all contacts from those of each part.
    fn gathered<T: Clone>(&self, fill: T, of: impl Fn(&GroupState) -> Option<Vec<T>>) -> Option<Vec<T>> {
        let mut all = vec![fill; self.contacts];
        for (members, state) in &self.state.parts {
            for (&contact, value) in members.iter().zip(of(state)?) {
                all[contact] = value;
            }
        }
        Some(all)
    }

    fn unknowns(&self) -> Option<Vec<Interval>> {
        self.gathered(Interval::ZERO, |state| state.unknowns().map(<[Interval]>::to_vec))
    }

    fn signs(&self) -> Vec<i8> {
        let signs = |state: &GroupState| match state {
            GroupState::Solution(solution) => Some(solution.signs.clone()),
            GroupState::Gap(gap) => Some(gap.signs.clone()),
            GroupState::Singular(_) | GroupState::Undecided(_) => None,
        };
        self.gathered(0, signs).unwrap_or_default()
    }

    fn normal_force(&self) -> DVector<f64> {
        self.state.normal_force(self.contacts).unwrap_or_else(|| DVector::zeros(self.contacts))
    }

    /// `D` of a block-triangular matrix.
    fn determinant(&self) -> f64 {
        let own = |(_, state): &(&[usize], &GroupState)| match state {
            GroupState::Solution(solution) => solution.determinant,
            GroupState::Gap(gap) => gap.determinant,
            GroupState::Singular(_) | GroupState::Undecided(_) => 0.0,
        };
        self.state.parts.iter().map(own).product()
    }

    fn tolerance(&self) -> f64 {
        let own = |(_, state): &(&[usize], &GroupState)| match state {
            GroupState::Solution(solution) => solution.tolerance,
            GroupState::Gap(gap) => gap.tolerance,
            GroupState::Singular(_) | GroupState::Undecided(_) => 0.0,
        };
        self.state.parts.iter().map(own).fold(0.0, f64::max)
    }

    fn on_boundary(&self) -> Vec<usize> {
        let mut all: Vec<usize> = Vec::new();
        for (members, state) in &self.state.parts {
            let own = match state {
                GroupState::Solution(solution) => solution.on_boundary.as_slice(),
                GroupState::Gap(gap) => gap.on_boundary.as_slice(),
                GroupState::Singular(_) | GroupState::Undecided(_) => &[],
            };
            all.extend(own.iter().map(|&contact| members[contact]));
        }
        all.sort_unstable();
        all
    }

    /// Some of the patterns that give the state, in the order of enumeration within each group, and the
    /// number of all such patterns.
    fn patterns(&self) -> (Vec<Vec<ContactState>>, u64) {
        let mut patterns = vec![self.state.pattern(self.contacts)];
        let mut count: u64 = 1;
        for (members, state) in &self.state.parts {
            let (own, own_count) = patterns_of(state);
            count = count.saturating_mul(own_count);
            patterns = patterns
                .iter()
                .flat_map(|base| own.iter().map(move |part| replaced(base, members, part)))
                .take(self.listed.max(1))
                .collect();
        }
        (patterns, count)
    }

    fn certificate(&self) -> Certificate {
        let certificates = || self.state.parts.iter().map(|(_, state)| state.certificate());
        if certificates().any(|one| one.is_none_or(|one| *one == Certificate::NotProven)) {
            return Certificate::NotProven;
        }
        let mut in_doubt = Vec::new();
        let (mut zero, mut full_share) = (Vec::new(), Vec::new());
        let mut within_bounds = false;
        for (members, state) in &self.state.parts {
            let renumbered =
                |contacts: &[usize]| contacts.iter().map(|&contact| members[contact]).collect::<Vec<_>>();
            match state.certificate() {
                Some(Certificate::OnBoundaryWithinBounds { in_doubt: own, .. }) => {
                    within_bounds = true;
                    in_doubt.extend(renumbered(own));
                }
                Some(Certificate::Boundary { zero: own, full_share: full, .. }) => {
                    zero.extend(renumbered(own));
                    full_share.extend(renumbered(full));
                }
                _ => {}
            }
        }
        for contacts in [&mut in_doubt, &mut zero, &mut full_share] {
            contacts.sort_unstable();
        }
        match self.unknowns() {
            unknowns if within_bounds => Certificate::OnBoundaryWithinBounds { unknowns, in_doubt },
            None => Certificate::Singular,
            Some(unknowns) if zero.is_empty() && full_share.is_empty() => Certificate::Proven { unknowns },
            Some(unknowns) => Certificate::Boundary { unknowns, zero, full_share },
        }
    }

    /// The product of the sets of all parts; by parts, if it has too many corners.
    fn set(&self) -> SolutionSet {
        let mut vertices = vec![DVector::zeros(self.contacts)];
        let mut directions: Vec<DVector<f64>> = Vec::new();
        for (members, state) in &self.state.parts {
            let (own, own_directions) = match state {
                GroupState::Singular(SingularMode { set: SolutionSet::NotComputed, .. }) => {
                    return SolutionSet::NotComputed;
                }
                GroupState::Singular(SingularMode { set: SolutionSet::Product(_), .. }) => {
                    return self.product();
                }
                GroupState::Singular(mode) => (mode.set.vertices(), mode.set.directions()),
                state => (state.normal_force().into_iter().collect(), Vec::new()),
            };
            if vertices.len().saturating_mul(own.len()).max(directions.len() + own_directions.len()) > CORNERS
            {
                return self.product();
            }
            vertices = vertices
                .iter()
                .flat_map(|base| own.iter().map(move |part| placed(base, members, part)))
                .collect();
            let zero = DVector::zeros(self.contacts);
            directions.extend(own_directions.into_iter().map(|part| placed(&zero, members, part)));
        }
        SolutionSet::from_corners(vertices, directions)
    }

    /// The sets of all parts, one after the other.
    fn product(&self) -> SolutionSet {
        let mut parts: Vec<SetPart<DVector<f64>>> = Vec::new();
        for (members, state) in &self.state.parts {
            match state {
                GroupState::Singular(SingularMode { set: SolutionSet::Product(own), .. }) => {
                    parts.extend(own.iter().map(|part| part.clone().renumbered(|contact| members[contact])));
                }
                GroupState::Singular(mode) => parts.push(listed_part(members, mode.set.clone())),
                state => {
                    let point = state.normal_force().map(|point| SolutionSet::Point(point.clone()));
                    parts.extend(point.map(|point| listed_part(members, point)));
                }
            }
        }
        SolutionSet::Product(parts)
    }
}

/// A set of some contacts whose corners are listed.
fn listed_part(members: &[usize], set: SolutionSet) -> SetPart<DVector<f64>> {
    let dimension = match &set {
        SolutionSet::Point(_) => Some(0),
        SolutionSet::Segment { .. } | SolutionSet::Ray { .. } => Some(1),
        _ => None,
    };
    let vertices = set.vertices();
    let share = 1.0 / vertices.len().max(1) as f64;
    let zero = DVector::zeros(members.len());
    let mean = vertices.iter().fold(zero, |sum, vertex| sum + *vertex * share);
    let inside = set.directions().into_iter().fold(mean, |sum, direction| sum + direction);
    SetPart { contacts: members.to_vec(), inside, dimension, set }
}

fn contacts_in_doubt(state: &GroupState) -> &[usize] {
    match state {
        GroupState::Undecided(undecided) => &undecided.in_doubt,
        state => match state.certificate() {
            Some(Certificate::OnBoundaryWithinBounds { in_doubt, .. }) => in_doubt,
            _ => &[],
        },
    }
}

fn patterns_of(state: &GroupState) -> (Vec<Vec<ContactState>>, u64) {
    let pressed = |pattern: &Vec<Side>| pattern.iter().map(|&side| side.into()).collect();
    match state {
        GroupState::Solution(solution) => {
            (solution.patterns.iter().map(pressed).collect(), solution.pattern_count)
        }
        GroupState::Gap(gap) => (gap.patterns.clone(), gap.pattern_count),
        GroupState::Singular(mode) => (mode.patterns.clone(), mode.pattern_count),
        GroupState::Undecided(undecided) => (undecided.patterns.clone(), undecided.patterns.len() as u64),
    }
}

fn replaced(base: &[ContactState], members: &[usize], part: &[ContactState]) -> Vec<ContactState> {
    let mut pattern = base.to_vec();
    members.iter().zip(part).for_each(|(&contact, &state)| pattern[contact] = state);
    pattern
}

fn placed(base: &DVector<f64>, members: &[usize], part: &DVector<f64>) -> DVector<f64> {
    let mut all = base.clone();
    members.iter().zip(part).for_each(|(&contact, &value)| all[contact] = value);
    all
}

fn sides(pattern: &[ContactState]) -> Vec<Side> {
    pattern.iter().filter_map(|state| state.side()).collect()
}
