//! Why a joint does not slide, so that friction in motion has no direction there.

/// The most contacts that stand still while the rest moves, and the most contacts beside them, for which `solve` gives the
/// range of the forces.
pub(crate) const MOST_STANDING: usize = 3;
pub(crate) const MOST_CONTACTS: usize = 12;

use super::Face;

/// Why a joint does not slide in a state.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoSliding {
    /// All of the model's coordinates, these, have the rate zero.
    AtRest(Vec<String>),
    /// It slides with these coordinates alone, whose rates are zero.
    WithoutRate(Vec<String>),
    /// Sliding stops or reverses: in this position, or because motions of several coordinates cancel.
    Here,
    /// No coordinate moves it, here or nearby.
    Never,
    /// The drives keep it at rest while the rest moves.
    Stands,
    /// It is at rest and may stick or begin to slide, or it or another contact lift off.
    Starts,
}

impl NoSliding {
    /// Returns the hint for a hinge that does not turn.
    pub(super) fn hint_of_hinge(&self, face: &dyn Face) -> String {
        let without = "without its friction (`mu = 0` or `friction_radius = 0` there) the answer exists";
        match self {
            Self::AtRest(coordinates) | Self::WithoutRate(coordinates) => {
                format!("{}; {without}", hint_at_rest(coordinates, face))
            }
            Self::Here => format!(
                "whether it sticks or slips is decided by the forces, which is not computed: change the rates a little; {without}"
            ),
            Self::Never | Self::Stands | Self::Starts => format!(
                "no motion of the mechanism makes it turn: its couple may be anything up to r |R|, so that the answer is a range, which only `{}`, `drive`, `sweep` and `map` compute, for one such hinge alone beside at most 12 contacts; {without}",
                face.question("solve")
            ),
        }
    }

    /// Returns the hint for a joint that does not slide.
    pub(super) fn hint(&self, face: &dyn Face) -> String {
        match self {
            Self::AtRest(coordinates) => hint_at_rest(coordinates, face),
            Self::WithoutRate(coordinates) => format!(
                "it slides with {} alone, which has no rate: give one, for instance with `{}`; {}",
                super::listed(coordinates),
                face.rates(coordinates),
                hold(face)
            ),
            Self::Here => format!(
                "sliding just begins, stops or reverses in this position: move the mechanism a little with {}, or change its rates",
                face.option("at")
            ),
            Self::Never => format!(
                "no motion of the mechanism makes it slide, so friction there only holds: {}; to leave that friction out write `mu = 0` there",
                hold(face)
            ),
            Self::Starts => format!(
                "it may stick or begin to slide, or lift off: `{}`, `drive`, `limits`, `sweep` and `map` list all states, unless a hinge has friction, or a guided slider or a preload beside a `height` is at rest, too; {}",
                face.question("solve"),
                hold(face)
            ),
            Self::Stands => format!(
                "it stands still while the rest moves, so that its friction may be anything within its limits: the answer is a range, which `{}`, `drive`, `limits`, `sweep` and `map` tell for up to {MOST_STANDING} such contacts among at most {MOST_CONTACTS}, without friction in hinges and guides that share a load; to leave that friction out write `mu = 0` there",
                face.question("solve")
            ),
        }
    }
}

/// Returns the hint for a joint at rest.
fn hint_at_rest(coordinates: &[String], face: &dyn Face) -> String {
    let rates = face.rates(coordinates);
    format!("{}; for friction in motion give it a velocity, for instance with `{rates}`", hold(face))
}

/// The question to ask of a joint at rest.
fn hold(face: &dyn Face) -> String {
    let [hold, size] = ["hold", "size"].map(|name| face.question(name));
    let against = face.option_with("against", "hold");
    format!("`{hold}` says whether it can stay at rest, and `{size}` with `{against}` with which dimensions")
}
