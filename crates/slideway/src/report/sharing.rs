//! How redundant guides share a load, and how firmly press fits grip.

use super::text::spaced;
use crate::units::Units;
use serde::Serialize;

/// The assumed elasticity of contacts that share a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Elasticity {
    /// The stiffnesses of the model.
    Given,
    /// The faces are rigid: there is play or misalignment, but no stiffness.
    Rigid,
    /// All contacts have the same stiffness: there is neither play nor misalignment, so that only ratios count.
    Equal,
}

/// How redundant guides share a load, and the two faces of press fits.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LoadSharing {
    /// Degree of redundancy: the number of independent self-stresses, without those between the two faces of a
    /// press fit.
    pub self_stresses: usize,
    /// The contacts that share a load, in groups that do not act on one another by self-stresses.
    pub groups: Vec<Vec<String>>,
    /// Their assumed elasticity.
    pub elasticity: Elasticity,
    /// The press fits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub press_fits: Vec<PressFit>,
    /// True if other ratios of stiffnesses would change the contact modes; absent if that was not asked, for rigid
    /// faces, and where there are too many patterns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_ratios: Option<StiffnessRatios>,
}

/// A contact with negative play: both of its faces are pressed unless the load exceeds the grip.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PressFit {
    /// The contact; its faces have this name and ".plus" or ".minus" behind it.
    pub contact: String,
    /// `N_0 = k |play|` (N), with the stiffness `k` of one face: the sum of the forces on both faces as long as both are
    /// pressed.
    pub grip: f64,
}

/// The contact modes for stiffnesses of a tenth to ten times those of the model, contact by contact.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct StiffnessRatios {
    /// How many combinations of 1/10, 1 and 10 were tried, in rounded numbers; beyond four contacts they are a
    /// sample of all.
    pub tried: usize,
    /// True if each has the same contact modes as the model.
    pub same: bool,
    /// The other contact modes that were met: one sign or 0 for each contact.
    pub others: Vec<String>,
}

impl LoadSharing {
    /// In words, one sentence or more in each line.
    pub fn in_words(&self, units: &Units) -> Vec<String> {
        let mut lines = if self.self_stresses > 0 { self.redundancy_in_words() } else { Vec::new() };
        lines.extend(self.press_fits_in_words(units));
        lines
    }

    fn press_fits_in_words(&self, units: &Units) -> Option<String> {
        let grip = |fit: &PressFit| format!("{} {}", fit.contact, units.of("N").show(fit.grip));
        let fits: Vec<String> = self.press_fits.iter().map(grip).collect();
        let told = || {
            format!(
                "Press fits, with the sum of the forces on both faces while both are pressed: {}.",
                fits.join(", ")
            )
        };
        (!fits.is_empty()).then(told)
    }

    /// The causes that share the load, in a line, and a warning if the stiffness ratios matter.
    pub(crate) fn in_brief(&self, units: &Units) -> Vec<String> {
        let mut lines = Vec::new();
        if self.self_stresses > 0 {
            let shared = format!("The guides share their load {}.", self.how());
            let ratios = self.stiffness_ratios.as_ref().filter(|ratios| !ratios.same);
            let ratios = ratios.map_or("", |_| " Other ratios of stiffness give other contact modes.");
            lines.push(shared + ratios);
        }
        lines.extend(self.press_fits_in_words(units));
        lines
    }

    fn how(&self) -> &'static str {
        match self.elasticity {
            Elasticity::Given => "by the stiffness, play and misalignment of each",
            Elasticity::Rigid => "by their play and misalignment, with rigid faces, as no stiffness is given",
            Elasticity::Equal => "in equal stiffness, as none is given",
        }
    }

    fn redundancy_in_words(&self) -> Vec<String> {
        let groups: Vec<String> = self.groups.iter().map(|group| group.join(", ")).collect();
        let how = self.how();
        let degree = match self.self_stresses {
            1 => "1 self-stress".to_owned(),
            several => format!("{several} self-stresses"),
        };
        let groups = groups.join(" share a load, and so do ");
        let share = if self.groups.len() == 1 { " share a load" } else { "" };
        let mut lines = vec![format!("Redundant guides: {groups}{share}, {how} ({degree}).")];
        if let Some(ratios) = &self.stiffness_ratios {
            let tried = ratios.tried;
            lines.push(if ratios.same {
                format!("All ratios of stiffnesses from 0.1 to 10 ({tried} combinations) give these contact modes.")
            } else if ratios.others.is_empty() {
                format!("With some ratios of stiffnesses from 0.1 to 10 ({tried} combinations) not all of these contact modes remain.")
            } else {
                let others: Vec<String> = ratios.others.iter().map(|signs| spaced(signs)).collect();
                format!(
                    "With other ratios of stiffnesses from 0.1 to 10 ({tried} combinations) there are also the signs {}.",
                    others.join(", ")
                )
            });
        }
        lines
    }
}
