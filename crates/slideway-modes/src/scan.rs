//! Scans of a range: answers at values, and bisection of what differs between neighbours.
//!
//! A change between two values at which answers are alike is missed: whatever begins and ends between two
//! neighbours. Between neighbours with different answers every change is found if there is one; if there are
//! more, [`Scan::stretches`] finds one and then further ones behind it, at most [`BETWEEN`].

use crate::progress::Work;
use std::convert::Infallible;
use std::ops::ControlFlow;

/// The most halvings between two values: enough to reach neighbouring numbers.
pub const HALVINGS: i32 = 100;
/// The most stretches of other answers that are sought between two neighbouring values.
pub const BETWEEN: usize = 3;

/// The ends of a range and evenly spaced values between them, as far as there are so many numbers. Both ends are exact, and what
/// is only the rounding of their sum is zero.
pub fn evenly([from, to]: [f64; 2], steps: usize) -> impl Iterator<Item = f64> + Clone {
    let at = move |step: usize| {
        let (way, share) = ((to - from) * step as f64 / steps as f64, step as f64 / steps as f64);
        match step {
            _ if step == steps => to,
            // Each of three operations rounds by at most half of EPSILON.
            _ if (from + way).abs() <= 1.5 * f64::EPSILON * from.abs() => 0.0,
            _ if way.is_finite() => from + way,
            // The range is wider than the greatest number.
            _ => from * (1.0 - share) + to * share,
        }
    };
    (0..=steps).filter(move |&step| step == 0 || at(step) != at(step - 1)).map(at)
}

/// (sqrt(5) - 1) / 2, by which each step of a golden section search shrinks its bracket.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The places within a bracket at which a golden section search looks: one of them is also one within the next bracket.
pub fn golden_section([low, high]: [f64; 2]) -> [f64; 2] {
    [high - GOLDEN * (high - low), low + GOLDEN * (high - low)]
}

/// Neighbouring numbers between two values, of which only the first is inside.
///
/// ```
/// use slideway_modes::scan::bisect;
///
/// let [inside, outside] = bisect(1.0, 2.0, |at| at * at < 2.0);
/// assert!(inside * inside < 2.0 && outside * outside >= 2.0);
/// assert_eq!(outside, inside.next_up());
/// ```
pub fn bisect(inside: f64, outside: f64, mut is_inside: impl FnMut(f64) -> bool) -> [f64; 2] {
    let found = bisect_until(inside, outside, |at| ControlFlow::<Infallible, _>::Continue(is_inside(at)));
    match found {
        ControlFlow::Continue(pair) => pair,
        ControlFlow::Break(never) => match never {},
    }
}

/// As [`bisect`], but ends where `is_inside` breaks, with what it breaks with.
pub fn bisect_until<B>(
    mut inside: f64,
    mut outside: f64,
    mut is_inside: impl FnMut(f64) -> ControlFlow<B, bool>,
) -> ControlFlow<B, [f64; 2]> {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(inside, outside);
        if middle == inside || middle == outside {
            break;
        }
        if is_inside(middle)? { inside = middle } else { outside = middle }
    }
    ControlFlow::Continue([inside, outside])
}

/// An answer at a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<T> {
    /// The value.
    pub at: f64,
    /// The answer there.
    pub found: T,
}

/// The answers at values, in their order, until the work is to end.
pub fn samples<'w, T>(
    values: impl Iterator<Item = f64> + Clone,
    work: Work<'w>,
    mut answer: impl FnMut(f64, Work<'w>) -> T,
) -> Vec<Sample<T>> {
    let all = values.clone().count();
    let piece = |(index, at)| Some((at, work.piece("values", index, all).continue_value()?));
    values.enumerate().map_while(piece).map(|(at, work)| Sample { at, found: answer(at, work) }).collect()
}

/// The longest run of neighbours that are alike, and those beside it.
#[derive(Debug, Clone, Copy)]
pub struct Run<'s, S> {
    /// The neighbour before it.
    pub before: Option<&'s S>,
    /// At least one.
    pub(crate) alike: &'s [S],
    /// The neighbour behind it.
    pub after: Option<&'s S>,
}

impl<'s, S> Run<'s, S> {
    /// The first one.
    pub fn first(&self) -> &'s S {
        &self.alike[0]
    }

    /// The one in the middle, which stands for all.
    pub fn middle(&self) -> &'s S {
        &self.alike[self.alike.len() / 2]
    }

    /// The last one.
    pub fn last(&self) -> &'s S {
        &self.alike[self.alike.len() - 1]
    }
}

/// Cuts a list between neighbours that are not alike.
pub fn runs<'s, S>(
    all: &'s [S],
    is_like: impl Fn(&S, &S) -> bool + 's,
) -> impl Iterator<Item = Run<'s, S>> + 's {
    let mut end = 0;
    all.chunk_by(is_like).map(move |alike| {
        let start = end;
        end += alike.len();
        Run { before: start.checked_sub(1).map(|before| &all[before]), alike, after: all.get(end) }
    })
}

/// A part of a range with one answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch<T> {
    /// The first value with this answer.
    pub from: f64,
    /// The last one.
    pub to: f64,
    /// A value for which the answer stands.
    pub(crate) at: f64,
    /// The answer there.
    pub found: T,
}

/// How answers are found and compared.
pub struct Scan<'a, T> {
    /// The answer at a value.
    pub answer: &'a dyn Fn(f64) -> T,
    /// True for two answers of one stretch.
    pub is_like: fn(&T, &T) -> bool,
    /// Stretches between neighbouring samples that are no longer than this are left out.
    pub narrowest: f64,
}

impl<T: Clone> Scan<'_, T> {
    /// Cuts a range where the answer changes between neighbouring samples.
    pub fn stretches(&self, samples: &[Sample<T>]) -> Vec<Stretch<T>> {
        let mut stretches = Vec::new();
        let Some(mut from) = samples.first().map(|first| first.at) else { return stretches };
        for run in runs(samples, |one, next| (self.is_like)(&one.found, &next.found)) {
            let Sample { at, found } = run.middle().clone();
            let last = run.last().at;
            let Some(next) = run.after else {
                stretches.push(Stretch { from, to: last, at, found });
                break;
            };
            let [mut to, mut beyond] = self.end(last, next.at, &found);
            stretches.push(Stretch { from, to, at, found });
            for _ in 0..BETWEEN {
                let other = (self.answer)(beyond);
                if (self.is_like)(&other, &next.found) {
                    break;
                }
                let (begin, start) = (to, beyond);
                [to, beyond] = self.end(start, next.at, &other);
                if to - begin > self.narrowest {
                    stretches.push(Stretch { from: start, to, at: start, found: other });
                }
            }
            from = beyond;
        }
        stretches
    }

    /// [`Self::stretches`], each of which begins where the one before ends.
    pub fn adjoining(&self, samples: &[Sample<T>]) -> Vec<Stretch<T>> {
        let mut end = None;
        let begun = |stretch: Stretch<T>| {
            let from = end.replace(stretch.to).unwrap_or(stretch.from);
            Stretch { from, ..stretch }
        };
        self.stretches(samples).into_iter().map(begun).collect()
    }

    /// Where an answer ends between a value that has it and one that has another.
    fn end(&self, inside: f64, outside: f64, found: &T) -> [f64; 2] {
        bisect(inside, outside, |at| (self.is_like)(&(self.answer)(at), found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scanned(answer: &dyn Fn(f64) -> u8, narrowest: f64) -> Vec<(f64, f64, u8)> {
        let samples = samples(evenly([0.0, 1.0], 2), Work::undisturbed(), |at, _| answer(at));
        let stretches = Scan { answer, is_like: u8::eq, narrowest }.stretches(&samples);
        stretches.iter().map(|stretch| (stretch.from, stretch.to, stretch.found)).collect()
    }

    #[test]
    fn stretches_meet_in_neighbouring_numbers() {
        let steps = |at: f64| u8::from(at > 0.1) + u8::from(at >= 0.75);
        let [first, second, third] = scanned(&steps, 0.0)[..] else { panic!("three stretches") };
        assert_eq!((first, second.2), ((0.0, 0.1, 0), 1));
        assert_eq!((second.0, second.1.next_up()), (0.1_f64.next_up(), 0.75));
        assert_eq!(third, (0.75, 1.0, 2));
        let samples = samples(evenly([0.0, 1.0], 2), Work::undisturbed(), |at, _| steps(at));
        let adjoining = Scan { answer: &steps, is_like: u8::eq, narrowest: 0.0 }.adjoining(&samples);
        assert_eq!(adjoining.iter().map(|one| one.from).collect::<Vec<_>>(), [0.0, first.1, second.1]);
    }

    #[test]
    fn several_changes_between_two_values_are_found_and_what_begins_and_ends_there_is_missed() {
        let within = |at: f64, [from, to]: [f64; 2]| from < at && at < to;
        let ladder = |at: f64| [0.3, 0.3125, 0.4].iter().map(|&step| u8::from(at > step)).sum();
        let found: Vec<u8> = scanned(&ladder, 0.0).iter().map(|stretch| stretch.2).collect();
        assert_eq!(found, [0, 1, 2, 3]);
        // Narrower than asked for.
        let found: Vec<u8> = scanned(&ladder, 0.05).iter().map(|stretch| stretch.2).collect();
        assert_eq!(found, [0, 2, 3]);
        let hill = |at: f64| u8::from(within(at, [0.2, 0.3]));
        assert_eq!(scanned(&hill, 0.0), [(0.0, 1.0, 0)]);
    }

    #[test]
    fn ends_of_a_range_are_exact_and_runs_know_their_neighbours() {
        let values: Vec<f64> = evenly([0.1, 0.7], 3).collect();
        assert_eq!((values.len(), values[0], values[3]), (4, 0.1, 0.7));
        assert_eq!(evenly([0.0, 1e-323], 500).collect::<Vec<_>>(), [0.0, 5e-324, 1e-323]);
        let widest: Vec<f64> = evenly([-f64::MAX, f64::MAX], 4).collect();
        assert_eq!((widest.len(), widest[0], widest[2], widest[4]), (5, -f64::MAX, 0.0, f64::MAX));
        assert!(widest.iter().all(|value| value.is_finite()), "{widest:?}");
        let all = [1, 1, 2, 3, 3];
        let runs: Vec<_> = runs(&all, i32::eq).map(|run| (run.before, run.alike, run.after)).collect();
        assert_eq!(
            runs,
            [(None, &all[..2], Some(&2)), (Some(&1), &all[2..3], Some(&3)), (Some(&2), &all[3..], None)]
        );
    }

    #[test]
    fn a_break_ends_bisection_and_ended_work_has_no_further_samples() {
        let found = bisect_until(0.0, 1.0, |at| {
            if at < 0.3 { ControlFlow::Break(at) } else { ControlFlow::Continue(false) }
        });
        assert_eq!(found, ControlFlow::Break(0.25));
        let mut pieces = 0;
        let mut callback = |_: &crate::progress::Progress| {
            pieces += 1;
            if pieces <= 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let (found, has_ended) = crate::progress::as_far_as_wanted(&mut callback, |work| {
            samples(evenly([0.0, 4.0], 4), work, |at, _| at)
        });
        assert!(has_ended);
        assert_eq!(found.iter().map(|sample| sample.found).collect::<Vec<_>>(), [0.0, 1.0]);
    }
}
