//! How the unknowns of a problem follow from those of its mode problem, and how they are reported.

use std::collections::{BTreeMap, BTreeSet};

use super::range::in_range;
use super::report::{RawUnknown, Unknowns};
use super::values::Sums;
use super::{RawKind, RawProblem, game, mixed};
use crate::error_free::sum_remainder;

/// The role of an unknown `N` of the mode problem, given `y+ = max(N, 0)` and `y- = max(-N, 0)`. Unknowns of
/// the problem have an index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Role {
    /// `x = N`, with coefficients that depend on its sign.
    Switched(usize),
    /// `z = N` of either sign, `w = 0`.
    Free(usize),
    /// `z = bound + y+`, `w = y-`.
    Above(usize, f64),
    /// `z = bound - y+`, `w = -y-`.
    Below(usize, f64),
    /// The second pair of an unknown with two bounds: `y+ = bound - z`, and `w` is smaller by `y-`.
    Ceiling(usize, f64),
    /// `z = bound`, `w = N`.
    Fixed(usize, f64),
    /// `N` is this number.
    Constant(f64),
    /// The payoff `constant + y+` of a player, 0 or 1.
    Payoff(usize, f64),
}

/// The unknowns of a problem and those of its mode problem.
pub(super) struct Correspondence {
    kind: RawKind,
    roles: Vec<Role>,
    /// The number of unknowns of the problem that have an index.
    size: usize,
    /// Of the two sorts of unknowns of a mixed problem or a game, the first are so many; of others, none.
    first: usize,
}

/// The values of some unknowns of the problem, before they get the names of its type.
#[derive(Default)]
struct Told {
    /// `z` and `w` by index.
    values: BTreeMap<usize, (f64, f64)>,
    payoffs: [Option<f64>; 2],
}

/// An unknown of a problem that follows from one of the mode problem: `shift + sign y`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quantity {
    pub(super) name: RawUnknown,
    pub(super) index: usize,
    pub(super) sign: f64,
    pub(super) shift: f64,
}

impl Correspondence {
    pub(super) fn of(raw: &RawProblem) -> Self {
        let above = |size: usize| (0..size).map(|at| Role::Above(at, 0.0)).collect::<Vec<_>>();
        let switched = |size: usize| (0..size).map(Role::Switched).collect::<Vec<_>>();
        let (roles, size, first) = match raw {
            RawProblem::LinearComplementarity { q, .. } | RawProblem::HorizontalComplementarity { q, .. } => {
                (above(q.len()), q.len(), 0)
            }
            RawProblem::AbsoluteValue { right_hand_side, .. } => {
                (switched(right_hand_side.len()), right_hand_side.len(), 0)
            }
            RawProblem::BlockAbsoluteValue(equation) => (switched(equation.size()), equation.size(), 0),
            RawProblem::MixedLinearComplementarity { m, q, free } => {
                (mixed::Bounds::of_free(*free, q.len()).roles(m, q), q.len(), *free)
            }
            RawProblem::MixedComplementarity { m, q, lower, upper } => {
                (mixed::Bounds::new(lower, upper).roles(m, q), q.len(), 0)
            }
            RawProblem::Game { a, b } => (game::roles(a, b), a.nrows() + a.ncols(), a.nrows()),
            RawProblem::Modes(problem) => (switched(problem.contacts()), problem.contacts(), 0),
        };
        Self { kind: raw.kind(), roles, size, first }
    }

    /// The number of unknowns, or pairs of them, that have an index.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// The number of free unknowns of a mixed linear complementarity problem, or of the first player's
    /// strategies; zero for others.
    pub(super) fn first(&self) -> usize {
        self.first
    }

    /// The unknowns of the whole problem.
    pub(super) fn unknowns(&self, signed: &[f64], sums: &Sums) -> Unknowns {
        self.named(&self.told(signed.iter().copied().enumerate(), sums, false))
    }

    /// The indices of the unknowns that follow from some of the mode problem.
    pub(super) fn indices(&self, contacts: &[usize]) -> Vec<usize> {
        let indices = contacts.iter().filter_map(|&contact| match self.roles[contact] {
            Role::Switched(index)
            | Role::Free(index)
            | Role::Above(index, _)
            | Role::Below(index, _)
            | Role::Ceiling(index, _)
            | Role::Fixed(index, _) => Some(index),
            Role::Constant(_) | Role::Payoff(..) => None,
        });
        indices.collect::<BTreeSet<usize>>().into_iter().collect()
    }

    /// The unknowns of a point with these indices, from some of the mode problem.
    pub(super) fn point(&self, contacts: &[usize], signed: &[f64], sums: &Sums) -> Unknowns {
        self.named(&self.told(contacts.iter().copied().zip(signed.iter().copied()), sums, false))
    }

    /// Returns the unknowns of a direction, from some of the mode problem; a direction has no constants.
    pub(super) fn direction(&self, contacts: &[usize], signed: &[f64]) -> Unknowns {
        let signed = contacts.iter().copied().zip(signed.iter().copied());
        self.named(&self.told(signed, &Sums::default(), true))
    }

    /// Of a game, the unknowns of the mode problem that are each player's strategy and the payoff that this
    /// gives the other player.
    pub(super) fn players(&self) -> Option<[Vec<usize>; 2]> {
        let (first, size) = (self.first, self.size);
        let strategies = [(0..first).chain([size + 1]).collect(), (first..=size).collect()];
        (self.kind == RawKind::Game).then_some(strategies)
    }

    /// A value without a floating-point number near becomes NaN.
    fn told(&self, signed: impl Iterator<Item = (usize, f64)>, sums: &Sums, direction: bool) -> Told {
        let mut told = Told::default();
        let from = |bound: f64| if direction { 0.0 } else { bound };
        let number = |value: f64| if in_range(value) { value } else { f64::NAN };
        for (contact, value) in signed {
            let (above, below) = (value.max(0.0), number((-value).max(0.0)));
            // A bound is exact, however small.
            let sum = |bound: f64, value: f64| match sums.value(contact) {
                Some(sum) => number(sum),
                None if value == 0.0 => from(bound),
                None => number(from(bound) + value),
            };
            let mut set = |index: usize, z: Option<f64>, w: f64| {
                let entry = told.values.entry(index).or_insert((0.0, 0.0));
                entry.0 = z.unwrap_or(entry.0);
                // Of two pairs one at most has a second part.
                entry.1 = if w == 0.0 { entry.1 } else { w };
            };
            match self.roles[contact] {
                Role::Switched(index) | Role::Free(index) => set(index, Some(number(value)), 0.0),
                Role::Above(index, bound) => set(index, Some(sum(bound, above)), below),
                Role::Below(index, bound) => set(index, Some(sum(bound, -above)), -below),
                Role::Ceiling(index, bound) => {
                    set(index, (value <= 0.0 && !direction).then_some(bound), -below);
                }
                Role::Fixed(index, bound) => set(index, Some(from(bound)), number(value)),
                Role::Constant(_) => {}
                Role::Payoff(player, least) => told.payoffs[player] = Some(sum(least, above)),
            }
        }
        told
    }

    fn named(&self, told: &Told) -> Unknowns {
        // Removes the sign of a zero.
        let number = |value: f64| value + 0.0;
        let all = |of: fn(&(f64, f64)) -> f64| told.values.values().map(|pair| number(of(pair))).collect();
        let some = |first: bool, of: fn(&(f64, f64)) -> f64| {
            let here = told.values.iter().filter(|(index, _)| (**index < self.first) == first);
            here.map(|(_, pair)| number(of(pair))).collect()
        };
        match self.kind {
            RawKind::Lcp | RawKind::Hlcp | RawKind::Mcp => {
                Unknowns::Complementary { z: all(|pair| pair.0), w: all(|pair| pair.1) }
            }
            RawKind::Mlcp => Unknowns::Mixed {
                u: some(true, |pair| pair.0),
                z: some(false, |pair| pair.0),
                w: some(false, |pair| pair.1),
            },
            RawKind::Game => Unknowns::Strategies {
                x: some(true, |pair| pair.0),
                y: some(false, |pair| pair.0),
                payoff_1: told.payoffs[0].map(number),
                payoff_2: told.payoffs[1].map(number),
            },
            RawKind::Ave | RawKind::BlockAve => Unknowns::AbsoluteValue { x: all(|pair| pair.0) },
            RawKind::Modes => {
                Unknowns::Modes { normal_forces: all(|pair| pair.0), y: all(|pair| pair.0.abs()) }
            }
        }
    }

    /// The bound that is added to a positive value of the mode problem, and the sign of the value in the sum.
    pub(super) fn shift(&self, contact: usize) -> Option<(f64, f64)> {
        match self.roles[contact] {
            Role::Above(_, bound) | Role::Payoff(_, bound) => Some((bound, 1.0)),
            Role::Below(_, bound) => Some((bound, -1.0)),
            _ => None,
        }
    }

    /// The bounds of all contacts and the signs of their unknowns in the sums; zero and one where there is no bound. The
    /// distance from an upper bound makes the same sum as that from the lower one, and a known number makes zero.
    pub(super) fn shifts(&self) -> Vec<(f64, f64)> {
        let shift = |contact: usize| match self.roles[contact] {
            Role::Ceiling(_, number) | Role::Constant(number) => (number, -1.0),
            _ => self.shift(contact).unwrap_or((0.0, 1.0)),
        };
        (0..self.roles.len()).map(shift).collect()
    }

    /// Whether the sum of a bound and this value may be off by more than its own rounding: it is smaller than the value,
    /// which is rounded, or the value has no number.
    pub(super) fn loses_digits(&self, contact: usize, signed: f64) -> bool {
        let is_lost = |(bound, sign): (f64, f64)| {
            bound != 0.0 && signed > 0.0 && (!in_range(signed) || (bound + sign * signed).abs() < signed)
        };
        self.shift(contact).is_some_and(is_lost)
    }

    /// An upper bound of the rounding errors of what [`Self::unknowns`] adds up.
    pub(super) fn rounding(&self, signed: &[f64], sums: &Sums) -> f64 {
        let error = |(contact, &value): (usize, &f64)| match self.shift(contact) {
            Some((bound, sign)) if value > 0.0 && sums.value(contact).is_none() => {
                sum_remainder(bound, sign * value, bound + sign * value).abs()
            }
            _ => 0.0,
        };
        signed.iter().enumerate().map(error).filter(|error| error.is_finite()).fold(0.0, f64::max)
    }

    /// The unknowns that are not zero, or not at their bound, because this one is not zero.
    pub(super) fn quantities(&self, contact: usize, signed: f64) -> Vec<Quantity> {
        let sign = signed.signum();
        let one = |name, index, sign, shift| vec![Quantity { name, index, sign, shift }];
        match (self.roles[contact], self.kind) {
            (Role::Switched(index), RawKind::Modes) => {
                [one(RawUnknown::NormalForces, index, sign, 0.0), one(RawUnknown::Y, index, 1.0, 0.0)]
                    .concat()
            }
            (Role::Switched(index), _) => one(RawUnknown::X, index, sign, 0.0),
            (Role::Free(index), RawKind::Mlcp) => one(RawUnknown::U, index, sign, 0.0),
            (Role::Free(index), _) => one(RawUnknown::Z, index, sign, 0.0),
            (Role::Above(index, _), RawKind::Game) if signed > 0.0 && index < self.first => {
                one(RawUnknown::X, index, 1.0, 0.0)
            }
            (Role::Above(index, _), RawKind::Game) if signed > 0.0 => {
                one(RawUnknown::Y, index - self.first, 1.0, 0.0)
            }
            (Role::Above(index, bound), _) if signed > 0.0 => {
                one(RawUnknown::Z, index - self.first, 1.0, bound)
            }
            (Role::Below(index, bound), _) if signed > 0.0 => one(RawUnknown::Z, index, -1.0, bound),
            (Role::Above(_, _), RawKind::Game) | (Role::Constant(_), _) => Vec::new(),
            (Role::Above(index, _), _) => one(RawUnknown::W, index - self.first, 1.0, 0.0),
            (Role::Ceiling(..), _) if signed > 0.0 => Vec::new(),
            (Role::Below(index, _) | Role::Ceiling(index, _), _) => one(RawUnknown::W, index, -1.0, 0.0),
            (Role::Fixed(index, _), _) => one(RawUnknown::W, index, sign, 0.0),
            (Role::Payoff(player, least), _) => {
                one([RawUnknown::Payoff1, RawUnknown::Payoff2][player], 0, 1.0, least)
            }
        }
    }

    /// Whether an unknown of the problem follows from this value.
    pub(super) fn tells(&self, contact: usize, signed: f64) -> bool {
        !self.quantities(contact, signed).is_empty()
    }

    /// The sign of every unknown with an index: of `z - w`, `x`, `N` or `u`; with two bounds, -1 at the lower
    /// bound, 1 at the upper one and 0 between.
    pub(super) fn signs(&self, signed: &[f64]) -> Vec<i8> {
        self.places(signed.iter().map(|&value| i8::from(value > 0.0) - i8::from(value < 0.0)))
    }

    /// For every unknown with an index, "+" or "-" as its sign somewhere in a set, "0" if it is zero throughout or in its
    /// gap, and "*" for a free unknown of both signs; given which unknowns of the mode problem are positive in it.
    pub(super) fn pattern_of_set(&self, positive: &[[bool; 4]]) -> String {
        // Free unknowns have the same index in the mode problem.
        let both = |index: usize| {
            positive[index][..2] == [true; 2] && self.kind == RawKind::Mlcp && self.is_free(index)
        };
        let places = self.places(positive.iter().map(|sides| i8::from(sides[0]) - i8::from(sides[1])));
        let character = |(index, place)| match place {
            _ if both(index) => '*',
            1 => '+',
            -1 => '-',
            _ => '0',
        };
        places.into_iter().enumerate().map(character).collect()
    }

    /// Whether an unknown of the mode problem may have either sign without a change of anything else.
    pub(super) fn is_free(&self, contact: usize) -> bool {
        matches!(self.roles[contact], Role::Free(_) | Role::Fixed(..))
    }

    fn places(&self, signs: impl Iterator<Item = i8>) -> Vec<i8> {
        let mut places = vec![0; self.size];
        let between_bounds = self.kind == RawKind::Mcp;
        for (role, sign) in self.roles.iter().zip(signs) {
            match *role {
                Role::Above(index, _) if between_bounds && sign <= 0 => places[index] = -1,
                Role::Below(index, _) | Role::Ceiling(index, _) if sign <= 0 => places[index] = 1,
                Role::Switched(index) | Role::Free(index) | Role::Above(index, _) if !between_bounds => {
                    places[index] = sign;
                }
                _ => {}
            }
        }
        places
    }

    /// Whether a vanishing unknown is on the boundary between patterns.
    pub(super) fn has_boundary(&self, contact: usize) -> bool {
        matches!(
            self.roles[contact],
            Role::Switched(_) | Role::Above(..) | Role::Below(..) | Role::Ceiling(..)
        )
    }
}
