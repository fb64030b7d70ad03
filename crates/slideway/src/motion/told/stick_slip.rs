//! Stick-slip in words: that one joint sticks and slips in turn, always in one direction, and how often.

use crate::ids::JointId;
use crate::motion::record::event::moving;
use crate::motion::record::history::{History, PhaseInterval};
use crate::pattern::phase::{JointPhase, sliding_joints};
use crate::units::number::brief;

/// "Stick-slip: table slips 5 times, every 0.7812 s." Nothing where no joint slips more than once after it has stuck. Of joints
/// that slip equally often the first is named.
pub(super) fn stick_slip(history: &History) -> Option<String> {
    let joints = sliding_joints(&history.mechanism);
    let slips = joints.iter().enumerate().map(|(index, joint)| (*joint, slips(history, (index, *joint))));
    let most = slips.rev().max_by_key(|(_, times)| times.len());
    let (joint, times) = most.filter(|(_, times)| times.len() > 1)?;
    Some(told(history, joint, &times))
}

fn told(history: &History, joint: JointId, times: &[f64]) -> String {
    let periods: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let every = match periods.as_slice() {
        // The first slips may still follow from the start.
        [.., before, last] if brief(*before) == brief(*last) => {
            format!(", every {}", history.mechanism.units.of("s").brief(*last))
        }
        _ => String::new(),
    };
    format!("Stick-slip: {} slips {} times{every}.", moving(&history.mechanism, joint), times.len())
}

/// When a joint began to slip after it had stuck for a while; nothing if it ever slid the other way then, or lifted off.
fn slips(history: &History, (joint, id): (usize, JointId)) -> Vec<f64> {
    let state = |interval: &PhaseInterval| interval.phase.joints[joint];
    let lasting: Vec<&PhaseInterval> =
        history.phases.iter().filter(|interval| interval.to > interval.from).collect();
    let contacts = history.mechanism.slider(id).map_or(&[][..], |slider| &slider.contacts);
    let is_open = |interval: &&PhaseInterval| {
        contacts.iter().any(|contact| interval.phase.is_open(&history.mechanism, contact.index()))
    };
    if lasting.iter().any(is_open) {
        return Vec::new();
    }
    let sliding = lasting.iter().map(|interval| state(interval));
    let mut signs = sliding.skip_while(|state| *state != JointPhase::Sticking).map(JointPhase::sign);
    let directions = signs.clone().filter(|sign| *sign != 0.0);
    let is_one_way = directions.clone().zip(directions.skip(1)).all(|(one, next)| one == next);
    if !is_one_way || signs.all(|sign| sign == 0.0) {
        return Vec::new();
    }
    let slips = lasting
        .windows(2)
        .filter(|pair| state(pair[0]) == JointPhase::Sticking && state(pair[1]) != JointPhase::Sticking);
    slips.map(|pair| pair[1].from).collect()
}
