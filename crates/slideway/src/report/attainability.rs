//! Verdicts on whether a mechanism with slightly elastic guides settles on a solution, as plain data.

use crate::choice::worded;
use serde::Serialize;

worded! {
    /// The fate of a solution when the guides are slightly elastic (theory, section 7).
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Verdict {
        /// All fast motions are stable: the mechanism settles on the solution.
        Attainable = "attainable",
        /// Some fast motion leaves the solution whatever the damping of the contacts.
        Unattainable = "unattainable",
        /// A fast oscillation grows unless the contacts are damped enough.
        Flutter = "flutter",
        /// The question has no definite answer; see the reason.
        Undecided = "undecided",
        /// Not asked for, or not computed; see the reason.
        #[default]
        NotComputed = "",
    }
}

/// The unit of the eigenvalues of the fast motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum EigenvalueUnit {
    /// The model gives the stiffness of every contact.
    #[serde(rename = "1/s^2")]
    PerSecondSquared,
    /// For a stiffness of 1 N/m at every contact.
    #[serde(rename = "1/kg")]
    PerKilogram,
}

/// Attainability of a solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Attainability {
    /// The verdict.
    pub verdict: Verdict,
    /// Why it is undecided or not computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Finite nonzero eigenvalues lambda of the fast motion `x'' = -lambda x`: real and imaginary parts,
    /// ascending. Those of `n` rigid motions (`n - d` with drives), which are zero, and of motions without
    /// mass are left out.
    pub eigenvalues: Vec<[f64; 2]>,
    /// Their unit.
    pub eigenvalue_unit: EigenvalueUnit,
    /// Number of motions without mass that elastic guides allow; their masses tend to zero from above.
    pub massless_motions: usize,
    /// True if the verdict changes when the stiffness of contacts varies by a factor of 10 up or down; absent
    /// if not tried.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depends_on_stiffness: Option<bool>,
    /// True if the verdict depends on the ratios of the vanishing masses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depends_on_mass_ratios: Option<bool>,
    /// For flutter: the damping of the contacts that suppresses it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flutter_damping: Option<FlutterDamping>,
    /// For an unattainable solution: what becomes of the mechanism on either side of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub separates: Option<[Fate; 2]>,
}

/// The least damping of the contacts, `N = -kappa (gap + delta gap')`, that suppresses flutter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FlutterDamping {
    /// Damping ratio `zeta = delta sqrt|lambda| / 2` of the fluttering motion.
    pub ratio: f64,
    /// The time `delta` (s); absent if the model does not give the stiffness of every contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
}

/// The fate of a mechanism that starts beside an unattainable solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It settles on the solution of this number, counted from 1.
    Solution(usize),
    /// The reactions grow beyond all bounds: it jams.
    Jamming,
    /// Not computed within the limit of work.
    NotComputed,
}

impl Attainability {
    /// Nothing but a verdict and its reason.
    pub(crate) fn without_eigenvalues(verdict: Verdict, reason: &str) -> Self {
        Self {
            verdict,
            reason: Some(reason.to_owned()),
            eigenvalues: Vec::new(),
            eigenvalue_unit: EigenvalueUnit::PerKilogram,
            massless_motions: 0,
            depends_on_stiffness: None,
            depends_on_mass_ratios: None,
            flutter_damping: None,
            separates: None,
        }
    }

    /// The verdict as a sentence.
    pub fn in_words(&self) -> String {
        let reason = self.reason.as_deref().unwrap_or("no reason given");
        let mut words = match self.verdict {
            Verdict::Attainable => {
                "Attainable: a mechanism with slightly elastic guides settles on it".to_owned()
            }
            Verdict::Unattainable => format!("Not attainable: {}", self.separates_in_words()),
            Verdict::Flutter => self.flutter_damping.map_or_else(
                || "Flutter".to_owned(),
                |damping| {
                    format!("Flutter unless the damping of the contacts exceeds zeta = {:.2}", damping.ratio)
                },
            ),
            Verdict::Undecided => format!("Stability not decided: {reason}"),
            Verdict::NotComputed => format!("Stability not computed: {reason}"),
        };
        if self.depends_on_stiffness == Some(true) {
            words += "; another stiffness of the guides may change this";
        }
        if self.depends_on_mass_ratios == Some(true) {
            words += "; other ratios of the vanishing masses may change this";
        }
        words + "."
    }

    /// How to measure a coordinate so that it is decided, "measure x where it acts: ...", where that is the reason.
    pub(crate) fn measure(&self) -> Option<String> {
        let reason = self.reason.as_deref().filter(|_| self.verdict == Verdict::Undecided)?;
        reason.split_once(". Measure ").map(|(_, how)| format!("measure {how}"))
    }

    /// Whereto a disturbance leads from an unattainable solution.
    fn separates_in_words(&self) -> String {
        let to = |fate: &Fate| match fate {
            Fate::Solution(number) => Some(format!("goes over to solution {number}")),
            Fate::Jamming => Some("locks up, its forces growing without limit".to_owned()),
            Fate::NotComputed => None,
        };
        match self.separates.as_ref().map(|fates| fates.each_ref().map(to)) {
            Some([Some(one), Some(other)]) if one == other => format!("disturbed, it {one}"),
            Some([Some(one), Some(other)]) => {
                format!("disturbed to one side, it {one}; to the other, it {other}")
            }
            _ => "a mechanism with slightly elastic guides leaves it".to_owned(),
        }
    }
}
