//! Texts that say what a search for limits can miss.

use super::found::{Elsewhere, Method, ModesFound, SingleValues, left_out};
use super::text::at_most;
use crate::report::capital;
use crate::units::Unit;

/// How the ends were found, and how the numbers of solutions between them are known.
pub(crate) fn guarantee(found: &ModesFound, shown_in: &Unit) -> String {
    let mut sentences = vec![match found.method {
        Method::ClosedForm => {
            "The equations are linear in it, so that every limit is computed in closed form.".to_owned()
        }
        Method::Hinge => {
            "All forces are linear in the friction couple of the only hinge with friction, so that every limit is computed in closed form."
                .to_owned()
        }
        Method::Same { at_rest: false } => "The equations do not depend on it.".to_owned(),
        Method::Same { at_rest: true } => {
            "The equations do not depend on it: static friction counts at rest (`slideway hold`)."
                .to_owned()
        }
        Method::Bracketing => format!(
            "{} values were tried. Where two neighbours differ, the limit between them was found by bisection, down to rounding. Limits closer than {} to each other, to an end of the range or to zero count as one.",
            found.tried.len(),
            shown_in.with(&format!("{:.1e}", shown_in.number_of(found.same_ends.within)))
        ),
    }];
    sentences.extend(knowledge(found, shown_in));
    if found.counts.iter().any(|count| count.continuum) && !found.existence.modes.is_empty() {
        sentences.push(
            "At one value between two limits the certified search finds infinitely many solutions."
                .to_owned(),
        );
    }
    let single = "A guided slider can be between its faces at a single value, where its normal force passes through zero. Such states are";
    match found.between_faces {
        SingleValues::Impossible => {}
        SingleValues::At(_) => {
            sentences.push(format!(
                "{single} reported where `solve` finds them, in rounded numbers; beside other preload-gap states they are omitted."
            ));
        }
        SingleValues::LeftOut => sentences.push(format!("{single} omitted.")),
    }
    sentences.extend(not_examined(found));
    sentences.join(" ")
}

/// Returns a sentence on each kind of mode that was left out.
pub(super) fn not_examined(found: &ModesFound) -> Vec<String> {
    let existence = &found.existence;
    let (rigid, singular): (Vec<_>, Vec<_>) =
        existence.singular_throughout.iter().partition(|pattern| existence.open.excess(pattern) > 0);
    let mut sentences = Vec::new();
    if !rigid.is_empty() {
        sentences.push(format!(
            "Not examined: {} states in which more contacts press than statics determines; with rigid faces they exist only \
             where all of these fit exactly.",
            rigid.len()
        ));
    }
    match singular.len() + existence.not_computed.len() {
        0 => {}
        1 => sentences.push(
            "Not examined: 1 contact mode that is locked throughout, or too badly conditioned to be computed."
                .to_owned(),
        ),
        left_out => sentences.push(format!(
            "Not examined: {left_out} contact modes that are locked throughout, or too badly conditioned to be computed."
        )),
    }
    sentences
}

/// Whether every mode was examined that statics determines: else one of the others may have a solution where none was found.
pub(super) fn is_examined(found: &ModesFound) -> bool {
    let existence = &found.existence;
    let mut singular = existence.singular_throughout.iter();
    existence.not_computed.is_empty() && singular.all(|pattern| existence.open.excess(pattern) > 0)
}

/// How the numbers of solutions are known.
fn knowledge(found: &ModesFound, shown_in: &Unit) -> Option<String> {
    let known = found.known.iter().map(|known| known.elsewhere);
    let sampled =
        known.clone().filter_map(|one| if let Elsewhere::Sampled(by) = one { Some(by) } else { None });
    let spacing = sampled.fold(0.0, f64::max);
    let is_any = |wanted: Elsewhere| found.known.iter().any(|known| known.elsewhere == wanted);
    let is_proven = found.known.iter().any(|known| !known.proven.is_empty());
    if found.known.is_empty() {
        return None;
    }
    if found.known.iter().all(|known| known.elsewhere == Elsewhere::Nothing) {
        let intervals = found.counts.iter().zip(&found.known);
        let widths = intervals.map(|(interval, known)| left_out([interval.from, interval.to], &known.proven));
        let left_out = widths.fold(0.0, f64::max);
        let rounded =
            if found.method == Method::Bracketing { ", which come from rounded numbers" } else { "" };
        return Some(if left_out > 0.0 {
            format!(
                "The numbers of solutions are proven, except within {} of the limits{rounded}.",
                at_most(left_out, shown_in)
            )
        } else {
            "The numbers of solutions are proven for all values.".to_owned()
        });
    }
    let mut parts = Vec::new();
    if is_proven {
        parts.push("the numbers of solutions are proven where the table says so".to_owned());
    }
    let they = if is_proven { "elsewhere they" } else { "the numbers of solutions" };
    if is_any(Elsewhere::ClosedForm) {
        parts.push(format!("{they} follow from the limits, which are computed in rounded numbers"));
    }
    if spacing > 0.0 {
        parts.push(format!(
            "{they} were found at values up to {} apart: a mode that appears and disappears between two of them may be missed",
            shown_in.precise(spacing)
        ));
    }
    if is_any(Elsewhere::Contradicted) {
        parts.push(
            "intervals that are not decided contain a value with another number of solutions".to_owned(),
        );
    }
    Some(capital(&parts.join("; ")) + ".")
}
