//! The words for efforts, and for how much friction there may be.

use super::Verdict;
use crate::units::brief;

/// The effort of a drive, with friction and without: "push needs 36.36 N (20 N without friction)", "push needs 16 N, all
/// of it against friction". Where something lifts off, it also accelerates that.
pub(crate) fn needs(drive: &str, effort: &str, without_friction: &str, lifts_off: bool) -> String {
    if effort == without_friction {
        format!("{drive} needs {effort}, as without friction")
    } else if without_friction.starts_with("0 ") && !lifts_off {
        format!("{drive} needs {effort}, all of it against friction")
    } else {
        format!("{drive} needs {effort} ({without_friction} without friction)")
    }
}

/// Of a drive that would have to act against the motion where something lifts off: "it moves as prescribed only if pull holds it
/// back, with 14.01 N against the motion".
pub(crate) fn held_back(drive: &str, effort: &str) -> String {
    format!("it moves as prescribed only if {drive} holds it back, with {effort} against the motion")
}

/// What several ways to go on leave open; where stability is not known of some, also which of them are ways at all.
pub(crate) fn which_way(mut ways: impl Iterator<Item = Verdict>) -> &'static str {
    if ways.any(|verdict| matches!(verdict, Verdict::Undecided | Verdict::NotComputed)) {
        "which of them a real mechanism takes is not decided"
    } else {
        "what went before decides which"
    }
}

/// A factor on all friction, after the coefficient that it comes to if there is one: "mu = 0.6667 (2.222
/// times this friction)".
pub(crate) fn times_friction(factor: f64, mu: Option<f64>) -> String {
    let times = times(factor);
    mu.map_or(times.clone(), |mu| format!("mu = {} ({times})", brief(mu)))
}

/// Below which friction it moves: the coefficient if there is one, else the factor: "mu = 0.6667".
pub(crate) fn least_friction(factor: f64, mu: Option<f64>) -> String {
    mu.map_or_else(|| times(factor), |mu| format!("mu = {}", brief(mu)))
}

/// A factor on all friction: "2.222 times this friction".
pub(crate) fn times(factor: f64) -> String {
    format!("{} times this friction", brief(factor))
}

/// Whether a factor is as far as friction is looked at, a million: as good as without end.
pub(crate) fn is_any_friction(factor: f64) -> bool {
    factor >= 1e6
}

/// The kind of an effort in this SI unit: "force", "torque"; none of other quantities.
pub(crate) fn kind(unit: &str) -> Option<&'static str> {
    match unit {
        "N" => Some("force"),
        "N m" => Some("torque"),
        _ => None,
    }
}

/// A remark on the only state if a mechanism does not settle on it.
pub(crate) fn unsettled(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Unattainable => " This state is unstable: a real mechanism leaves it.",
        Verdict::Flutter => " It may vibrate by itself (flutter) unless its contacts are damped.",
        _ => "",
    }
}
