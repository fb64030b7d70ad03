//! A solution that changes from one pattern to another within the bounds, where a normal force passes zero.

use super::enclosure::proven_determinant_sign;
use crate::interval::{Interval, Sign};
use crate::problem::{ContactState, ProblemView};

/// Returns whether, for every value within the bounds, exactly one of these patterns has a solution. Each pattern
/// comes with bounds of its unknowns `y`; they have to be all that may have a solution. `false` says nothing.
///
/// The contacts in which they differ take every combination of sides, without jumps, and all patterns have the same
/// sign of `p(sigma) = D(sigma) prod_k sigma_k`; the others are on one side with `y > 0`. Then, with these others free,
/// every load has exactly one solution (theory, section 5), which is one of the listed.
pub fn is_exchange<'a>(
    problem: impl Into<ProblemView<'a>>,
    patterns: &[(Vec<ContactState>, Vec<Interval>)],
) -> bool {
    let problem = problem.into();
    let Some(((first, _), others)) = patterns.split_first() else { return false };
    let is_either = |k: usize| others.iter().any(|(pattern, _)| pattern[k] != first[k]);
    let (either, fixed): (Vec<usize>, Vec<usize>) = (0..first.len()).partition(|&k| is_either(k));
    let has_every_combination =
        u32::try_from(either.len()).is_ok_and(|count| 2_usize.checked_pow(count) == Some(patterns.len()));
    let is_pressed = |&k: &usize| patterns.iter().all(|(_, unknowns)| unknowns[k].lower() > 0.0);
    if !has_every_combination
        || patterns.iter().any(|(pattern, _)| pattern.contains(&ContactState::Gap))
        || either.iter().any(|&k| problem.has_jump(k))
        || !fixed.iter().all(is_pressed)
    {
        return false;
    }
    let mut signs = patterns.iter().map(|(pattern, _)| oriented_sign(problem, pattern));
    let one = signs.next().flatten();
    one.is_some_and(|sign| sign != Sign::Zero) && signs.all(|sign| sign == one)
}

/// The most contacts of which all patterns are examined.
const CONTACTS: u32 = 8;

/// Returns whether every load has exactly one solution, for every value within the bounds: up to eight contacts without
/// jumps, and all `p(sigma)` of one sign (theory, section 5). `false` says nothing.
pub fn has_one_solution<'a>(problem: impl Into<ProblemView<'a>>) -> bool {
    let problem = problem.into();
    let contacts = problem.contacts();
    let Some(count) = u32::try_from(contacts).ok().filter(|&count| count <= CONTACTS) else { return false };
    if (0..contacts).any(|k| problem.has_jump(k)) {
        return false;
    }
    let side = |code: u32, k: usize| {
        if code >> k & 1 == 0 { ContactState::Positive } else { ContactState::Negative }
    };
    let pattern = |code: u32| (0..contacts).map(|k| side(code, k)).collect::<Vec<_>>();
    let mut signs = (0..1_u32 << count).map(|code| oriented_sign(problem, &pattern(code)));
    let one = signs.next().flatten();
    one.is_some_and(|sign| sign != Sign::Zero) && signs.all(|sign| sign == one)
}

/// The proven sign of `p`.
fn oriented_sign(problem: ProblemView<'_>, pattern: &[ContactState]) -> Option<Sign> {
    let sign = proven_determinant_sign(problem, pattern)?;
    let negative = pattern.iter().filter(|state| **state == ContactState::Negative).count();
    Some(if negative % 2 == 0 { sign } else { -sign })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{IntervalMatrix, IntervalModeProblem};
    use crate::problem::BySide;
    use nalgebra::{DMatrix, dmatrix};

    /// One slider: `(sigma - mu eta s) y = N(0)`, with `N(0)` from -1 to 1.
    fn slider(friction: f64) -> IntervalModeProblem {
        let range =
            |low, high| IntervalMatrix::from_bounds(&dmatrix![low], &dmatrix![high]).expect("in order");
        let point = |value| range(value, value);
        let columns = BySide { positive: point(1.0 - friction), negative: point(-1.0 - friction) };
        let none = BySide::same(IntervalMatrix::exact(DMatrix::zeros(1, 1)));
        IntervalModeProblem::new(&columns, &none, &range(-1.0, 1.0)).expect("sound")
    }

    fn crossing(friction: f64) -> bool {
        let bounds = || vec![Interval::new(-2.0, 2.0).expect("in order")];
        is_exchange(
            &slider(friction),
            &[(vec![ContactState::Positive], bounds()), (vec![ContactState::Negative], bounds())],
        )
    }

    /// Below `mu eta = 1` each load has one solution; beyond, two or none (theory, section 2).
    #[test]
    fn a_force_that_passes_zero_changes_the_side_while_every_load_has_one_solution() {
        assert!(crossing(0.5));
        assert!(has_one_solution(&slider(0.5)));
        assert!(!has_one_solution(&slider(1.5)));
        assert!(!crossing(1.5));
        assert!(!crossing(1.0));
    }
}
