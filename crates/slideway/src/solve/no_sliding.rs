//! Why a contact with friction does not slide, or a hinge with friction does not turn.

use crate::configuration::{Configuration, Follower, PROBE};
use crate::fault::NoSliding;
use crate::mechanism::Mechanism;

/// Which of the things that are asked about slide or turn in a state.
pub(super) type Moves<'m> = &'m dyn Fn(&Configuration) -> Vec<bool>;

/// Why something does not move.
#[derive(Clone)]
pub(super) struct Why {
    pub(super) reason: NoSliding,
    /// The coordinates with which alone it moves.
    pub(super) moves_with: Vec<usize>,
}

/// Why each of the things that `moves` tells of does not move in a configuration: the mechanism rests, or it moves without
/// it, as it always does or in this position alone.
///
/// Each coordinate is given a rate of its own, here and a probe's length on either side of here. Every such state is
/// computed once, whatever the number of things.
pub(super) fn why(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (count, moves): (usize, Moves<'_>),
) -> Vec<Why> {
    if configuration.rates.iter().all(|rate| *rate == 0.0) {
        let names = mechanism.coordinates.iter().map(|coordinate| coordinate.name.to_string()).collect();
        return vec![Why { reason: NoSliding::AtRest(names), moves_with: Vec::new() }; count];
    }
    let mut moves_with = vec![Vec::new(); count];
    for (coordinate, state) in configuration.with_each_rate(mechanism).iter().enumerate() {
        let moving = moves_with.iter_mut().zip(moves(state));
        moving.filter(|(_, moves)| *moves).for_each(|(with, _)| with.push(coordinate));
    }
    let reason =
        |moves_with: Vec<usize>| Why { reason: reason(mechanism, configuration, &moves_with), moves_with };
    let mut all: Vec<Why> = moves_with.into_iter().map(reason).collect();
    if all.iter().any(|why| why.reason == NoSliding::Never) {
        look_nearby(mechanism, &mut all, moves);
    }
    all
}

/// Why something does not move in a configuration with rates that moves with these coordinates alone.
fn reason(mechanism: &Mechanism, configuration: &Configuration, moves_with: &[usize]) -> NoSliding {
    match moves_with {
        [] => NoSliding::Never,
        with if with.iter().any(|&coordinate| configuration.rates[coordinate] != 0.0) => NoSliding::Here,
        with => {
            let name = |&coordinate: &usize| mechanism.coordinates[coordinate].name.to_string();
            NoSliding::WithoutRate(with.iter().map(name).collect())
        }
    }
}

/// Notes of what seems never to move that it does where a coordinate is a little further.
fn look_nearby(mechanism: &Mechanism, all: &mut [Why], moves: Moves<'_>) {
    let (mut moved, mut follower) = (mechanism.clone(), Follower::default());
    for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
        let length = if coordinate.kind.is_angle() { 1.0 } else { mechanism.size };
        for step in [PROBE, -PROBE] {
            moved.coordinates[index].value = coordinate.value + step * length;
            let Ok(nearby) = follower.configuration(&moved) else { continue };
            for state in nearby.with_each_rate(mechanism) {
                let still = all
                    .iter_mut()
                    .zip(moves(&state))
                    .filter(|(why, moves)| *moves && why.reason == NoSliding::Never);
                still.for_each(|(why, _)| why.reason = NoSliding::Here);
            }
            if all.iter().all(|why| why.reason != NoSliding::Never) {
                return;
            }
        }
        moved.coordinates[index].value = coordinate.value;
    }
}
