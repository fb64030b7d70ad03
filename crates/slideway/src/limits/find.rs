//! Where modes exist in a range, how many solutions there are in between, and how that is known.

use super::between_faces;
use super::branches;
use super::closed_form::closed_form;
use super::degenerate;
use super::examine::Examiner;
use super::found::{Method, ModesFound, PATTERNS};
use super::scan::Scanner;
use super::standing;
use super::varied::Varied;
use crate::expression::Degree;
use crate::fault::{Fault, FaultKind, Faults};
use crate::modes::existence::{ExistenceOptions, TooManyModes};
use crate::progress::Work;

/// How often values at which the certified search contradicts the ends are scanned around.
const ROUNDS: usize = 3;

/// Where modes exist in a range; those with a normal force above `greatest` (N) do not count. So many
/// certified searches may be made.
///
/// # Errors
/// Too many modes.
pub(crate) fn find(
    varied: &Varied,
    range: [f64; 2],
    greatest: Option<f64>,
    effort: u64,
    work: Work<'_>,
) -> Result<ModesFound, Faults> {
    let options = ExistenceOptions { range, greatest_normal_force: greatest, patterns: PATTERNS };
    let found = found(varied, &options, effort, work);
    found.map_err(|TooManyModes { contacts, limit, .. }| {
        Fault::general(FaultKind::TooManyModes { contacts, limit }).into()
    })
}

fn found(
    varied: &Varied,
    options: &ExistenceOptions,
    effort: u64,
    work: Work<'_>,
) -> Result<ModesFound, TooManyModes> {
    if options.greatest_normal_force.is_none()
        && let Some(found) = standing::found(varied, options.range, work)
    {
        return Ok(found);
    }
    let circles = varied.rough_circles(options.range);
    let scanner = Scanner { varied, options: *options, work: work.part(0, 2) };
    let scan = |places: &[f64]| {
        if circles.is_empty() {
            scanner.scan(places)
        } else {
            Ok(branches::scan(varied, &circles, options, places, work.part(0, 2)))
        }
    };
    let closed_form = if circles.is_empty() {
        closed_form(varied, options, work.part(0, 2))?
    } else {
        branches::closed_form(varied, &circles, options)
    };
    let mut found = match closed_form {
        Some(found) => found,
        None => scan(&[])?,
    };
    let mut places = Vec::new();
    for round in 0..=ROUNDS {
        if circles.is_empty() {
            degenerate::recount(varied, options.greatest_normal_force, &mut found, work.part(1, 2));
        }
        let contradicted =
            Examiner::new((varied, &circles), options, effort, work.part(1, 2)).examine(&mut found);
        if contradicted.is_empty() || round == ROUNDS {
            break;
        }
        places.extend(contradicted);
        found = scan(&places)?;
    }
    if circles.is_empty() {
        between_faces::add(varied, options.greatest_normal_force, &mut found, work.part(1, 2));
    }
    if varied.dependence().problem == Degree::Constant && found.method == Method::Bracketing {
        found.method = Method::Same { at_rest: varied.dependence().at_rest };
    }
    Ok(found)
}
