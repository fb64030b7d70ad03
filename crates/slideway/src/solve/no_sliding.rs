//! Why a contact with friction does not slide, or a hinge with friction does not turn.

use crate::configuration::{Configuration, Follower, PROBE};
use crate::fault::NoSliding;
use crate::mechanism::Mechanism;

/// Whether something slides or turns in a state.
pub(super) type Moves<'m> = &'m dyn Fn(&Mechanism, &Configuration) -> bool;

/// Why what `moves` tells of does not move in a configuration: the mechanism rests, or it moves without it, as it
/// always does or in this position alone.
///
/// Each coordinate is given a rate of its own, here and a probe's length on either side of here.
pub(super) fn why(mechanism: &Mechanism, configuration: &Configuration, moves: Moves<'_>) -> NoSliding {
    let names = |indices: &[usize]| -> Vec<String> {
        indices.iter().map(|&index| mechanism.coordinates[index].name.to_string()).collect()
    };
    let all: Vec<usize> = (0..mechanism.coordinates.len()).collect();
    if configuration.rates.iter().all(|rate| *rate == 0.0) {
        return NoSliding::AtRest(names(&all));
    }
    let mut probe = Probe { mechanism: mechanism.clone(), follower: Follower::default(), moves };
    let slides_with: Vec<usize> =
        all.iter().copied().filter(|&coordinate| probe.slides(coordinate)).collect();
    if slides_with.iter().any(|&coordinate| configuration.rates[coordinate] != 0.0) {
        return NoSliding::Here;
    }
    if !slides_with.is_empty() {
        return NoSliding::WithoutRate(names(&slides_with));
    }
    let slides_nearby = all.iter().any(|&moved| {
        let length = if mechanism.coordinates[moved].kind.is_angle() { 1.0 } else { mechanism.size };
        [PROBE, -PROBE].into_iter().any(|step| {
            probe.mechanism.coordinates[moved].value = mechanism.coordinates[moved].value + step * length;
            let slides = all.iter().any(|&coordinate| probe.slides(coordinate));
            probe.mechanism.coordinates[moved].value = mechanism.coordinates[moved].value;
            slides
        })
    });
    if slides_nearby { NoSliding::Here } else { NoSliding::Never }
}

/// A mechanism that is moved to see what slides.
struct Probe<'m> {
    mechanism: Mechanism,
    follower: Follower,
    moves: Moves<'m>,
}

impl Probe<'_> {
    /// Whether it slides or turns if this coordinate alone has a rate; not where there is no such state.
    fn slides(&mut self, coordinate: usize) -> bool {
        for (index, other) in self.mechanism.coordinates.iter_mut().enumerate() {
            other.rate = if index == coordinate { 1.0 } else { 0.0 };
        }
        let state = self.follower.configuration(&self.mechanism);
        state.is_ok_and(|state| (self.moves)(&self.mechanism, &state))
    }
}
