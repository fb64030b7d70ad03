//! Which guided sliders tip where there is no solution for that reason.

use super::effort::least_friction;
use super::{SolveReport, Status, TippingLimit};
use serde::Serialize;

/// The guided sliders that tip where there is no solution: a guided slider has no state in which it is tipped.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Tipping {
    /// The guided sliders that would tip in a solution of the equations: as block sliders they show whether it moves.
    pub joints: Vec<String>,
    /// True if there is such a solution wherever that was asked: then friction does not lock it.
    pub throughout: bool,
}

impl Tipping {
    /// From what tips in each of some states without a solution; none if nothing does.
    pub(crate) fn of(states: impl Iterator<Item = Vec<String>>) -> Option<Self> {
        let mut tipping = Self { joints: Vec::new(), throughout: true };
        for joints in states {
            tipping.throughout &= !joints.is_empty();
            tipping.joints.extend(joints);
        }
        tipping.joints.sort_unstable();
        tipping.joints.dedup();
        (!tipping.joints.is_empty()).then_some(tipping)
    }

    /// "it tips (bed), which only a block slider can show", where some states lock after "it jams, or".
    pub(crate) fn in_words(&self) -> String {
        let tips = format!("{}, {SHOWN_BY}", it_tips(&self.joints));
        if self.throughout { tips } else { format!("it jams, or {tips}") }
    }
}

/// What shows how a guided slider goes on that tips.
pub(crate) const SHOWN_BY: &str = "which only a block slider can show";

/// "it tips (bed and die)": a name may be plural, so no verb follows one.
pub(crate) fn it_tips(joints: &[String]) -> String {
    format!("it tips ({})", joints.join(" and "))
}

/// "tipping (bed and die)"
pub(crate) fn tipping(joints: &[String]) -> String {
    format!("tipping ({})", joints.join(" and "))
}

/// "it would tip (shoes) from mu = 0.45 (1.5 times this friction)"
pub(crate) fn it_would_tip(joints: &[String], from: &str) -> String {
    format!("it would tip ({}) from {from}", joints.join(" and "))
}

/// "with less friction it tips (shoes): below mu = 0.05"
pub(crate) fn with_less(limit: &TippingLimit, mu: Option<f64>) -> String {
    let what = if limit.joints.is_empty() { "it jams".to_owned() } else { it_tips(&limit.joints) };
    let below = least_friction(limit.factor, mu.map(|mu| limit.factor * mu));
    format!("with less friction {what}: below {below}")
}

/// The meaning of no solution: "it jams", or what tips.
pub(crate) fn without_solution(tipping: Option<&Tipping>) -> String {
    tipping.map_or_else(|| "it jams".to_owned(), Tipping::in_words)
}

impl SolveReport {
    /// The guided sliders that tip, if there is no solution for that reason.
    pub fn tipping(&self) -> Option<Tipping> {
        let joints = self.rejected.iter().map(|rejection| rejection.joint.clone()).collect();
        if self.status == Status::None { Tipping::of(std::iter::once(joints)) } else { None }
    }

    /// The guided sliders that tip, or would just beyond the friction up to which there is a solution.
    pub(crate) fn tipping_in_the_end(&self) -> Vec<String> {
        match (self.tipping(), &self.margins) {
            (Some(tipping), _) => tipping.joints,
            (None, Some(margins)) if self.status != Status::None => margins.tips.clone(),
            _ => Vec::new(),
        }
    }
}
