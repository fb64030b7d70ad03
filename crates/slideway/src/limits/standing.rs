//! Numbers of solutions where contacts stand still while the rest moves: their friction is a range, and no mode ends at a
//! zero of a determinant. The answers at evenly spaced values are compared, and what changes between them is bisected.

use super::found::{Elsewhere, Gap, Knowledge, Method, ModesFound, SameEnds, SingleValues};
use super::varied::Varied;
use crate::fault::Faults;
use crate::modes::existence::{CountInterval, Existence};
use crate::progress::Work;
use crate::report::Status;
use crate::scan::{Scan, Stretch, evenly, samples};

/// Steps of the evenly spaced values.
const STEPS: usize = 100;

/// The numbers of solutions in a range; none if nothing stands in it, as far as a few values show.
pub(super) fn found(varied: &Varied, [from, to]: [f64; 2], work: Work<'_>) -> Option<ModesFound> {
    let stands = |value: f64| varied.stands(value).unwrap_or(false);
    if ![from, f64::midpoint(from, to), to].into_iter().any(stands) {
        return None;
    }
    let counting = Counting { varied, work };
    let answer = |at: f64| counting.at(at);
    let tried = samples(evenly([from, to], STEPS), work, |at, _| answer(at));
    let same_ends = SameEnds::bisected([from, to]);
    let scan = Scan { answer: &answer, is_like, narrowest: same_ends.within };
    let (mut counts, mut gaps) = (Vec::new(), Vec::new());
    for Stretch { from, to, found, .. } in scan.adjoining(&tried) {
        match found {
            Ok(numbers) if same_ends.are_two(from, to) => counts.push(CountInterval { from, to, ..numbers }),
            Ok(_) => {}
            Err(faults) => gaps.push(Gap { from, to, faults }),
        }
    }
    let known = Knowledge::unproven(Elsewhere::Sampled((to - from) / STEPS as f64));
    Some(ModesFound {
        existence: Existence::default(),
        known: vec![known; counts.len()],
        counts,
        gaps,
        method: Method::Bracketing,
        tried: tried.iter().map(|sample| sample.at).collect(),
        same_ends,
        between_faces: SingleValues::Impossible,
        branches: Vec::new(),
        circles: Vec::new(),
    })
}

struct Counting<'c> {
    varied: &'c Varied,
    work: Work<'c>,
}

impl Counting<'_> {
    fn at(&self, at: f64) -> Result<CountInterval, Faults> {
        let report = self.varied.solved(at, self.work)?;
        Ok(CountInterval {
            from: at,
            to: at,
            solutions: report.solutions.len(),
            gap_states: report.preload_gap_states.len(),
            continuum: report.status == Status::Continuum,
        })
    }
}

fn is_like(one: &Result<CountInterval, Faults>, other: &Result<CountInterval, Faults>) -> bool {
    match (one, other) {
        (Ok(one), Ok(other)) => one.is_like(other),
        (one, other) => one.is_err() && other.is_err(),
    }
}
