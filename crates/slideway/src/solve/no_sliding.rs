//! Why a contact with friction does not slide, or a hinge with friction does not turn.

use crate::configuration::{Configuration, Follower, PROBE};
use crate::fault::NoSliding;
use crate::mechanism::Mechanism;

/// Which of the things that are asked about slide or turn in a state.
pub(super) type Moves<'m> = &'m dyn Fn(&Mechanism, &Configuration) -> Vec<bool>;

/// Why each of the things that `moves` tells of does not move in a configuration: the mechanism rests, or it moves without
/// it, as it always does or in this position alone.
///
/// Each coordinate is given a rate of its own, here and a probe's length on either side of here. Every such state is
/// computed once, whatever the number of things.
pub(super) fn why(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (count, moves): (usize, Moves<'_>),
) -> Vec<NoSliding> {
    let names = |indices: &[usize]| -> Vec<String> {
        indices.iter().map(|&index| mechanism.coordinates[index].name.to_string()).collect()
    };
    let all: Vec<usize> = (0..mechanism.coordinates.len()).collect();
    if configuration.rates.iter().all(|rate| *rate == 0.0) {
        return vec![NoSliding::AtRest(names(&all)); count];
    }
    let mut probe = Probe { mechanism: mechanism.clone(), follower: Follower::default(), moves };
    let mut slides_with = vec![Vec::new(); count];
    for &coordinate in &all {
        let moving = slides_with.iter_mut().zip(probe.moving(coordinate));
        moving.filter(|(_, moves)| *moves).for_each(|(with, _)| with.push(coordinate));
    }
    let reason = |with: &Vec<usize>| match &with[..] {
        [] => NoSliding::Never,
        with if with.iter().any(|&coordinate| configuration.rates[coordinate] != 0.0) => NoSliding::Here,
        with => NoSliding::WithoutRate(names(with)),
    };
    let mut reasons: Vec<NoSliding> = slides_with.iter().map(reason).collect();
    for &moved in &all {
        for step in [PROBE, -PROBE] {
            probe.nearby(moved, step, &mut reasons);
        }
    }
    reasons
}

/// A mechanism that is moved to see what slides.
struct Probe<'m> {
    mechanism: Mechanism,
    follower: Follower,
    moves: Moves<'m>,
}

impl Probe<'_> {
    /// What slides or turns if this coordinate alone has a rate; nothing where there is no such state.
    fn moving(&mut self, coordinate: usize) -> Vec<bool> {
        for (index, other) in self.mechanism.coordinates.iter_mut().enumerate() {
            other.rate = if index == coordinate { 1.0 } else { 0.0 };
        }
        let state = self.follower.configuration(&self.mechanism);
        state.map_or_else(|_| Vec::new(), |state| (self.moves)(&self.mechanism, &state))
    }

    /// Notes what seems never to move, but does where this coordinate is a little further.
    fn nearby(&mut self, moved: usize, step: f64, reasons: &mut [NoSliding]) {
        let here = self.mechanism.coordinates[moved].value;
        let length =
            if self.mechanism.coordinates[moved].kind.is_angle() { 1.0 } else { self.mechanism.size };
        self.mechanism.coordinates[moved].value = here + step * length;
        for coordinate in 0..self.mechanism.coordinates.len() {
            if !reasons.contains(&NoSliding::Never) {
                break;
            }
            let moving = reasons.iter_mut().zip(self.moving(coordinate));
            moving
                .filter(|(reason, moves)| *moves && **reason == NoSliding::Never)
                .for_each(|(reason, _)| *reason = NoSliding::Here);
        }
        self.mechanism.coordinates[moved].value = here;
    }
}
