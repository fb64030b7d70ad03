//! Numbers of solutions where contacts stand still while the rest moves: their friction is a range, and no mode ends at a
//! zero of a determinant. The answers at evenly spaced values are compared, and what changes between them is bisected.

use super::found::{Elsewhere, Gap, Knowledge, Method, ModesFound, SameEnds, SingleValues};
use super::scan::bisect;
use super::varied::Varied;
use crate::fault::Faults;
use crate::modes::existence::{CountInterval, Existence};
use crate::progress::Work;
use crate::report::Status;
use std::ops::ControlFlow;

/// Steps of the evenly spaced values.
const STEPS: usize = 100;

/// The numbers of solutions in a range; none if nothing stands in it, as far as a few values show.
pub(super) fn found(varied: &Varied, [from, to]: [f64; 2], work: Work<'_>) -> Option<ModesFound> {
    let stands = |value: f64| varied.stands(value).unwrap_or(false);
    if ![from, f64::midpoint(from, to), to].into_iter().any(stands) {
        return None;
    }
    let counting = Counting { varied, work };
    let even = (0..=STEPS).map(|step| from + (to - from) * step as f64 / STEPS as f64);
    let mut places: Vec<(f64, Result<CountInterval, Faults>)> = Vec::new();
    for (index, at) in even.enumerate() {
        let ControlFlow::Continue(_) = work.piece("values", index, STEPS + 1) else { break };
        places.push((at, counting.at(at)));
    }
    let same_ends = SameEnds::bisected([from, to]);
    let (mut counts, mut gaps) = (Vec::new(), Vec::new());
    let mut begin = from;
    for stretch in places.chunk_by(|one, next| is_like(&one.1, &next.1)) {
        let (Some(first), Some(last)) = (stretch.first(), stretch.last()) else { continue };
        let next = places.iter().find(|place| place.0 > last.0);
        let end =
            next.map_or(last.0, |next| bisect(last.0, next.0, |at| is_like(&counting.at(at), &last.1)).0);
        match &first.1 {
            Ok(numbers) if same_ends.are_two(begin, end) => {
                counts.push(CountInterval { from: begin, to: end, ..*numbers });
            }
            Ok(_) => {}
            Err(faults) => gaps.push(Gap { from: begin, to: end, faults: faults.clone() }),
        }
        begin = end;
    }
    let known = Knowledge::unproven(Elsewhere::Sampled((to - from) / STEPS as f64));
    Some(ModesFound {
        existence: Existence::default(),
        known: vec![known; counts.len()],
        counts,
        gaps,
        method: Method::Bracketing,
        tried: places.iter().map(|place| place.0).collect(),
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
