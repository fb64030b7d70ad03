//! States of rest: statics with friction, one linear program for each pattern of contact sides.

use super::TOLERANCE;
use super::reactions::{ranges, reactions};
use super::report::{AtRest, Range, Reactions, union};
use super::setup::Setup;
use super::state::{Pattern, State, StateQuestion, StaticFriction, sides};
use crate::pattern::{ContactPhase, JointPhase, Region, Unsolved};
use crate::progress::Work;

/// Something found over all patterns, and how many of them could not be decided.
pub(super) struct Over<T> {
    /// What was found.
    pub(super) found: T,
    /// Patterns of which a linear program was not solved.
    pub(super) undecided: usize,
}

/// Every joint sticks, with these sides.
pub(super) fn resting(setup: &Setup, sides: Vec<ContactPhase>) -> Pattern {
    Pattern {
        joints: vec![JointPhase::Sticking; setup.sliders.len()],
        hinges: vec![JointPhase::Sticking; setup.mechanism.friction_circles.len()],
        contacts: sides,
    }
}

/// The static friction of contacts and hinges.
pub(super) fn static_friction(setup: &Setup) -> StaticFriction {
    StaticFriction {
        mu: setup.mechanism.contacts.iter().map(|contact| contact.mu_static).collect(),
        radii: setup.mechanism.friction_circles.iter().map(|circle| circle.static_radius).collect(),
    }
}

/// The region of a state if it is not empty, relaxed by as little as rounding asks for.
pub(super) fn possible(region: Region<'_>) -> Result<Option<Region<'_>>, Unsolved> {
    region.possible(TOLERANCE)
}

/// One sign for each contact. One that shares a load and has no normal force is open, or just touches.
pub(super) fn symbols(setup: &Setup, pattern: &Pattern, reactions: &Reactions) -> String {
    let nothing = TOLERANCE * setup.units.force;
    let has_none = |end: Option<f64>| end.is_some_and(|force| force.abs() <= nothing);
    let one = |(k, contact): (usize, &ContactPhase)| {
        let Range { least, greatest } = reactions.contacts[k].normal_force;
        let touches = setup.shares(k) && has_none(least) && has_none(greatest);
        if touches { ContactPhase::PreloadGap.symbol() } else { contact.symbol() }
    };
    pattern.contacts.iter().enumerate().map(one).collect()
}

/// States one after another, each with its piece of the work, until it is to end.
pub(super) fn until_over<T>(states: Vec<T>, work: Work<'_>) -> impl Iterator<Item = (T, Work<'_>)> {
    let all = states.len();
    let piece = move |(index, state): (usize, T)| {
        let piece = work.piece("states", index, all);
        piece.continue_value().map(|piece| (state, piece))
    };
    states.into_iter().enumerate().map_while(piece)
}

/// All states of rest with a factor of the varied load, and whether there is one: its reactions may not be decided.
pub(super) fn at_rest(setup: &Setup, factor: f64, work: Work<'_>) -> (Over<Option<AtRest>>, bool) {
    let mut over = Over { found: None::<AtRest>, undecided: 0 };
    let mut is_possible = false;
    for (sides, piece) in until_over(sides(setup, &[]), work.part(0, 2)) {
        let pattern = resting(setup, sides);
        let question = StateQuestion::rest(Some(factor));
        let Some(state) = State::new(setup, &pattern, question) else { continue };
        let region = possible(state.region(&static_friction(setup)).watched(piece));
        is_possible |= matches!(region, Ok(Some(_)));
        match region.and_then(|region| region.map(|r| reactions(setup, &state, &r)).transpose()) {
            Ok(None) => {}
            Ok(Some(reactions)) => {
                let rest = over.found.get_or_insert_with(|| AtRest {
                    patterns: Vec::new(),
                    reactions: reactions.clone(),
                    wedging: Vec::new(),
                    without_preloads: None,
                });
                let symbols = symbols(setup, &pattern, &reactions);
                if !rest.patterns.contains(&symbols) {
                    rest.patterns.push(symbols);
                }
                rest.reactions = rest.reactions.clone().hull(&reactions);
            }
            Err(Unsolved) => over.undecided += 1,
        }
    }
    if let Some(rest) = &mut over.found {
        rest.wedging = rest.reactions.unbounded();
        rest.without_preloads = without_preloads(setup, factor, work.part(1, 2));
    }
    (over, is_possible)
}

/// Whether some state of rest is possible without the preloads; none if there are none, or where that is not
/// decided.
fn without_preloads(setup: &Setup, factor: f64, work: Work<'_>) -> Option<bool> {
    let mut slack = setup.clone();
    let mut is_preloaded = false;
    for contact in &mut slack.mechanism.contacts {
        is_preloaded |= contact.preload != [0.0; 2];
        contact.preload = [0.0; 2];
    }
    if is_preloaded { is_possible(&slack, factor, work) } else { None }
}

/// Whether some state of rest is possible with a factor of the varied load; none where a linear program that
/// could have shown one was not solved.
pub(super) fn is_possible(setup: &Setup, factor: f64, work: Work<'_>) -> Option<bool> {
    let mut undecided = false;
    for (sides, _) in until_over(sides(setup, &[]), work) {
        let question = StateQuestion::rest(Some(factor));
        let pattern = resting(setup, sides);
        let Some(state) = State::new(setup, &pattern, question) else { continue };
        match possible(state.region(&static_friction(setup)).watched(work)) {
            Ok(Some(_)) => return Some(true),
            Ok(None) => {}
            Err(Unsolved) => undecided = true,
        }
    }
    (!undecided && !work.is_over()).then_some(false)
}

/// The factors of the varied load that can be held: the union over all patterns.
pub(super) fn held_factors(setup: &Setup, work: Work<'_>) -> Over<Vec<Range>> {
    let mut over = Over { found: Vec::new(), undecided: 0 };
    for (sides, _) in until_over(sides(setup, &[]), work) {
        let pattern = resting(setup, sides);
        let question = StateQuestion::rest(None);
        let Some(state) = State::new(setup, &pattern, question) else { continue };
        let region = state.region(&static_friction(setup)).watched(work);
        let extents = |region: Region<'_>| ranges(&state, &region, &state.factor(), state.factor_unit());
        match possible(region).and_then(|region| region.map(extents).transpose()) {
            Ok(found) => over.found.extend(found.into_iter().flatten()),
            Err(Unsolved) => over.undecided += 1,
        }
    }
    over.found = union(over.found);
    over
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_that_touch_are_one() {
        let range = |least, greatest| Range { least, greatest };
        let found = union(vec![
            range(Some(2.0), Some(3.0)),
            range(None, Some(-1.0)),
            range(Some(-1.0), Some(0.0)),
            range(Some(2.5), None),
        ]);
        assert_eq!(found, [range(None, Some(0.0)), range(Some(2.0), None)]);
    }
}
