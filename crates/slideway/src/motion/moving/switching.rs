//! Time events: where loads, drives and friction jump or have a kink.
//!
//! Within a phase every relation (`sign`, `step`, `abs`, `min`, `max`, tables) of the loads, drives and
//! friction is held on the piece on which it is, so that the motion is smooth; a relation whose arguments
//! depend on the motion is watched like a normal force. Where they depend on time alone the end of the piece
//! is computed in advance: time is passed through in cells on which interval arithmetic proves the margin to
//! be positive, and what is left is a time within rounding. So none is missed, however long the steps are.

use super::cause::Cause;
use super::root::first_fall;
use crate::configuration::Configuration;
use crate::expression::{End, Expression, Piece, Values};
use crate::ids::JointId;
use crate::interval::Interval;
use crate::mechanism::{Mechanism, Pad, Pieces, Relation};
use std::sync::Arc;

/// The first look ahead, in units in the last place of the time.
const NEXT: f64 = 4.0;
/// Each look ahead is this much farther than the one before.
const FARTHER: f64 = 16.0;
/// So often: from neighbouring times to any.
const LOOKS: i32 = 64;
/// The first look from time zero (s).
const NEAREST: f64 = 1e-60;

/// A relation and an end of its piece.
pub(in crate::motion) type Switch = (usize, End);

/// The relations of loads, drives and friction along a motion.
pub(in crate::motion) struct Switching<'m> {
    mechanism: &'m Mechanism,
    relations: Vec<Relation>,
    pieces: Arc<Pieces>,
    parameters: Vec<Interval>,
    /// Until when no relation of time alone leaves its piece, and those that leave it then.
    next: f64,
    due: Vec<Switch>,
    /// The relations that have left their pieces last, at a time (s).
    passed: (f64, Vec<usize>),
}

impl<'m> Switching<'m> {
    /// All relations on the pieces on which they are just after a state.
    pub(in crate::motion) fn new(mechanism: &'m Mechanism, configuration: &Configuration) -> Self {
        let relations = mechanism.relations();
        let pieces = Arc::new(Pieces::free(mechanism, &relations));
        let values = mechanism.values(&[], &[], 0.0);
        let parameters = values.parameters.iter().map(|value| Interval::point(*value)).collect();
        let next = f64::NEG_INFINITY;
        let (due, passed) = (Vec::new(), (next, Vec::new()));
        let mut switching = Self { mechanism, relations, pieces, parameters, next, due, passed };
        for relation in 0..switching.relations.len() {
            let piece = switching.ahead(configuration, relation, switching.speed(configuration, relation));
            switching.set(relation, piece);
        }
        switching
    }

    /// The pieces; nothing without relations.
    pub(in crate::motion) fn pieces(&self) -> Option<Arc<Pieces>> {
        (!self.relations.is_empty()).then(|| Arc::clone(&self.pieces))
    }

    /// The ends that have to be watched: those of relations that depend on the motion.
    pub(in crate::motion) fn watched(&self) -> impl Iterator<Item = Switch> + '_ {
        let held = |relation: &usize| {
            !self.relations[*relation].kind.of_time && self.pieces.piece(*relation) != Piece::Free
        };
        let relations = (0..self.relations.len()).filter(held);
        relations.flat_map(|relation| End::BOTH.map(|end| (relation, end)))
    }

    /// How far a relation is from an end of its piece; infinite where it has none.
    pub(in crate::motion) fn margin(&self, configuration: &Configuration, (relation, end): Switch) -> f64 {
        let Configuration { coordinates, rates, time, .. } = configuration;
        let (expression, pieces, number) = self.of(relation);
        let margin =
            |values: &Values<'_>| expression.margin(values, pieces, (number, end)).unwrap_or(f64::INFINITY);
        if let Some(pad) = &self.relations[relation].pad {
            return margin(&pad.values(&configuration.depth(self.mechanism, pad)));
        }
        let sliding_speed = self.speed(configuration, relation);
        margin(&Values { sliding_speed, ..self.mechanism.values(coordinates, rates, *time) })
    }

    /// The first time after `time`, and at most `until`, at which a relation of time alone leaves its piece;
    /// infinite if none does.
    pub(in crate::motion) fn next(&mut self, time: f64, until: f64) -> f64 {
        if !self.due.is_empty() {
            return self.next;
        }
        if self.next >= until {
            return f64::INFINITY;
        }
        let from = time.max(self.next);
        let mut first = until;
        for relation in (0..self.relations.len()).filter(|relation| self.relations[*relation].kind.of_time) {
            for end in End::BOTH {
                let Some(zero) = self.end_of((relation, end), [from, first]) else { continue };
                if zero < first {
                    self.due.clear();
                }
                first = zero;
                self.due.push((relation, end));
            }
        }
        self.next = first;
        if self.due.is_empty() { f64::INFINITY } else { first }
    }

    /// The relations that leave their pieces at [`Self::next`], which has come.
    pub(in crate::motion) fn due(&mut self) -> Vec<Switch> {
        std::mem::take(&mut self.due)
    }

    /// Puts relations on the pieces beyond these ends; returns the loads and drives that jump there, and the
    /// pads that begin or cease to push.
    pub(in crate::motion) fn switch(&mut self, time: f64, switches: &[Switch]) -> Vec<Cause> {
        self.passed = (time, switches.iter().map(|(relation, _)| *relation).collect());
        let mut causes: Vec<Cause> = Vec::new();
        let pads = self.pushing();
        for &(relation, end) in switches {
            let (expression, _, number) = self.of(relation);
            let Piece::Held(piece) = self.pieces.piece(relation) else { continue };
            let beyond = expression.beyond(number, piece, end);
            self.set(relation, Piece::Held(beyond));
            let Relation { owner, kind, pad, .. } = &self.relations[relation];
            let cause = Cause::LoadJumps(owner.to_string());
            if kind.jumps && pad.is_none() && !causes.contains(&cause) {
                causes.push(cause);
            }
        }
        let changes =
            pads.into_iter().zip(self.pushing()).filter(|((_, before), (_, after))| before != after);
        causes.extend(changes.map(|(_, (pad, meets))| {
            let Pad { joint, greatest, .. } = *pad;
            if meets { Cause::MeetsPad { joint, greatest } } else { Cause::LeavesPad { joint, greatest } }
        }));
        causes
    }

    /// The pads, and whether each pushes.
    fn pushing(&self) -> Vec<(&'m Pad, bool)> {
        let pushes = |pad: &Pad| self.pieces.of(pad.formula).iter().all(|piece| *piece == Piece::Held(1));
        self.mechanism.pads().map(|(_, pad)| (pad, pushes(pad))).collect()
    }

    /// Finds new pieces for relations of the motion that are at the very end of theirs, or on none, and for
    /// those of the friction of joints that stop. What has just left a piece has fallen through its end:
    /// velocities alone do not tell how it goes on.
    pub(in crate::motion) fn settle(
        &mut self,
        configuration: &Configuration,
        stops: &dyn Fn(JointId) -> bool,
    ) {
        for relation in 0..self.relations.len() {
            let contact = self.relations[relation].contact;
            let rubs = contact.is_some_and(|contact| stops(self.mechanism.contacts[contact.index()].joint));
            let has_passed = self.passed.0 == configuration.time && self.passed.1.contains(&relation);
            let at_end = |end: End| !has_passed && self.margin(configuration, (relation, end)) == 0.0;
            let is_free = self.pieces.piece(relation) == Piece::Free;
            if !self.relations[relation].kind.of_time
                && (is_free || rubs || End::BOTH.into_iter().any(at_end))
            {
                let speed = if rubs { 0.0 } else { self.speed(configuration, relation) };
                let piece = self.ahead(configuration, relation, speed);
                self.set(relation, piece);
            }
        }
    }

    /// Finds new pieces for all relations of the motion: velocities have jumped.
    pub(in crate::motion) fn jump(&mut self, configuration: &Configuration) {
        for relation in 0..self.relations.len() {
            if !self.relations[relation].kind.of_time {
                let piece = self.ahead(configuration, relation, self.speed(configuration, relation));
                self.set(relation, piece);
            }
        }
    }

    /// The sliding speed on which a relation depends (m/s).
    fn speed(&self, configuration: &Configuration, relation: usize) -> f64 {
        let contact = self.relations[relation].contact;
        contact.map_or(0.0, |contact| configuration.contact(self.mechanism, contact).sliding_velocity.abs())
    }

    fn of(&self, relation: usize) -> (&'m Expression, &[Piece], usize) {
        let Relation { formula, number, ref pad, .. } = self.relations[relation];
        let expression = match pad {
            Some(pad) => pad.law(),
            None => self.mechanism.expression(formula),
        };
        (expression, self.pieces.of(formula), number)
    }

    fn set(&mut self, relation: usize, piece: Piece) {
        if self.pieces.piece(relation) != piece {
            Arc::make_mut(&mut self.pieces).set(relation, piece);
            if self.relations[relation].kind.of_time {
                // What was searched with the old pieces says nothing any more.
                self.next = f64::NEG_INFINITY;
                self.due.clear();
            }
        }
    }

    /// The piece of a relation just after a state: at the nearest time ahead at which it can be told from
    /// rounding, as the velocities go on; what stops can only become faster. Free if it can be told nowhere:
    /// the argument stays at the threshold.
    fn ahead(&self, configuration: &Configuration, relation: usize, speed: f64) -> Piece {
        let (expression, pieces, number) = self.of(relation);
        let time = &configuration.time;
        let arguments = self.arguments(configuration, relation);
        let [parameters, coordinates, rates] = &arguments;
        let first = if *time == 0.0 { NEAREST } else { NEXT * f64::EPSILON * time.abs() };
        let steps = std::iter::once(0.0).chain((0..LOOKS).map(|look| first * FARTHER.powi(look)));
        let piece = |step: f64| {
            let sliding_speed = Interval::point(if speed == 0.0 { step } else { speed });
            let step = Interval::point(step);
            let moved = coordinates.iter().zip(rates);
            let coordinates: Vec<Interval> = moved.map(|(value, rate)| *value + step * *rate).collect();
            let values = Values {
                parameters,
                coordinates: &coordinates,
                rates,
                time: Interval::point(*time) + step,
                sliding_speed,
            };
            expression.piece(&values, pieces, number)
        };
        steps.into_iter().find_map(piece).map_or(Piece::Free, Piece::Held)
    }

    /// Parameters, coordinates and rates of the formula of a relation.
    fn arguments(&self, configuration: &Configuration, relation: usize) -> [Vec<Interval>; 3] {
        let points = |values: &[f64]| values.iter().map(|value| Interval::point(*value)).collect();
        if let Some(pad) = &self.relations[relation].pad {
            let [depth, rate] = configuration.depth(self.mechanism, pad);
            return [points(&pad.constants), points(&[depth]), points(&[rate])];
        }
        let Configuration { coordinates, rates, .. } = configuration;
        [self.parameters.clone(), points(coordinates), points(rates)]
    }

    /// The first time in a range at which a relation of time alone leaves its piece.
    fn end_of(&self, (relation, end): Switch, [from, until]: [f64; 2]) -> Option<f64> {
        let (expression, pieces, number) = self.of(relation);
        let margin = |time: Interval| {
            let values = Values { time, ..Values::of_parameters(&self.parameters) };
            expression.margin(&values, pieces, (number, end))
        };
        margin(Interval::point(from))?;
        first_fall([from, until], |time| margin(time).unwrap_or(Interval::ZERO))
    }
}
