//! Which solutions exist for all values of parameters that are known within bounds only.
//!
//! The box of the parameters is searched as a whole, with bounds of the mode problem for all its values.
//! Where that leaves a mode open the box is halved, and so on: a parameter counts as independent in each
//! number that uses it, and smaller boxes lose less by that.

use super::SolveOptions;
use super::answer::Answer;
use super::state::{pattern, pressed, signs};
use crate::enclosure::{EnclosedModeProblem, Tipping, UncertainParameters, enclosed_while, enclosure_within};
use crate::interval::{Interval, Real};
use crate::model::{Model, ParameterRange};
use crate::modes::{Certificate, Completeness, ContactState, SearchResult, StateLists, search};
use crate::progress::Callback;
use crate::report::{self, Persistence};
use std::collections::BTreeMap;

/// The most boxes that are searched.
const BOXES: usize = 255;

/// What is known of one mode in one box.
pub(super) struct Presence {
    /// How many solutions it has for all values, ...
    pub(super) certain: usize,
    /// ... and at most for some.
    pub(super) possible: usize,
    /// Bounds of `y_k`, or of the share of a contact in its gap, perhaps with further unknowns behind them.
    pub(super) unknowns: Option<Vec<Interval>>,
}

impl Presence {
    /// One solution, for all values or perhaps for some.
    pub(super) fn one(certain: bool, unknowns: Option<Vec<Interval>>) -> Self {
        Self { certain: usize::from(certain), possible: 1, unknowns }
    }

    /// Both of a mode with several solutions.
    pub(super) fn and(self, other: Self) -> Self {
        let both = self.unknowns.zip(other.unknowns);
        Self {
            certain: self.certain + other.certain,
            possible: self.possible + other.possible,
            unknowns: both.map(|(one, other)| one.iter().zip(&other).map(|(a, b)| a.hull(*b)).collect()),
        }
    }
}

/// What is known of a box: its modes, or why it could not be searched.
pub(super) type Searched = Result<BTreeMap<Vec<ContactState>, Presence>, String>;

/// What is known of one mode over all boxes.
struct Record {
    certain: usize,
    bounds: Option<Vec<[f64; 2]>>,
}

impl Answer<'_> {
    /// Which modes exist for all values within the ranges, for some, or perhaps.
    pub(super) fn uncertainty(
        &self,
        model: &Model,
        ranges: &[ParameterRange],
        options: &SolveOptions,
        progress: &mut Callback<'_>,
    ) -> Option<report::Uncertainty> {
        self.uncertainty_over(ranges, &mut |uncertain: &UncertainParameters| {
            let state = (self.mechanism, self.configuration);
            let enclosed = enclosed_while(progress, |work| enclosure_within(model, uncertain, state, work))
                .map_err(|reason| reason.to_string())?;
            let result = search(&enclosed.problem, &options.search, progress);
            self.presences(&enclosed, &result, options)
        })
    }

    /// The same with that search of a box; none without ranges.
    pub(super) fn uncertainty_over(
        &self,
        ranges: &[ParameterRange],
        search_box: &mut dyn FnMut(&UncertainParameters) -> Searched,
    ) -> Option<report::Uncertainty> {
        if ranges.is_empty() {
            return None;
        }
        let mut search_box =
            |values: &[Interval]| -> Searched {
                let named = ranges.iter().zip(values);
                search_box(&named.fold(UncertainParameters::default(), |all, (range, &value)| {
                    all.with(&range.name, value)
                }))
            };
        let searched = subdivide(ranges, &mut search_box);
        Some(self.summary(ranges, &searched))
    }

    /// The modes of a box.
    fn presences(
        &self,
        enclosed: &EnclosedModeProblem,
        result: &SearchResult,
        options: &SolveOptions,
    ) -> Searched {
        let lists: StateLists = result.lists(options.most, 1);
        let unfinished = matches!(result.completeness, Completeness::Partial(_) | Completeness::Unexamined);
        if unfinished || !lists.all_listed {
            return Err("the search was not completed".to_owned());
        }
        let mut modes = BTreeMap::new();
        let mut add = |mode: Vec<ContactState>, certificate: &Certificate| {
            let unknowns = certificate.unknowns().map(<[Interval]>::to_vec);
            let tipping = match &unknowns {
                Some(unknowns) => enclosed.outputs.tipping(&mode, unknowns),
                None => Tipping::Open,
            };
            let proven = matches!(certificate, Certificate::Proven { .. });
            if tipping != Tipping::Always {
                modes.insert(mode, Presence::one(proven && tipping == Tipping::Never, unknowns));
            } else if let Some((mode, bounds)) =
                unknowns.and_then(|bounds| self.in_gap(enclosed, mode, bounds))
            {
                modes.insert(mode, Presence::one(false, Some(bounds)));
            }
        };
        for solution in &lists.solutions {
            add(pressed(&solution.pattern), &solution.certificate);
        }
        for gap in &lists.gaps {
            add(gap.pattern.clone(), &gap.certificate);
        }
        for mode in &lists.singular {
            add(mode.pattern.clone(), &mode.certificate);
        }
        for undecided in lists.undecided {
            modes.entry(undecided.pattern).or_insert(Presence::one(false, undecided.unknowns));
        }
        Ok(modes)
    }

    /// A mode in which guided sliders tip, with those in their preload gap that may be without normal force
    /// (see [`super::faces`]); none if some slider tips all the same.
    fn in_gap(
        &self,
        enclosed: &EnclosedModeProblem,
        mut mode: Vec<ContactState>,
        mut bounds: Vec<Interval>,
    ) -> Option<(Vec<ContactState>, Vec<Interval>)> {
        for k in enclosed.outputs.couples.iter().map(|couple| couple.contact) {
            if mode[k] != ContactState::Gap && bounds[k].contains(0.0) && self.free_face(k).is_some() {
                mode[k] = ContactState::Gap;
                bounds[k] = Interval::ZERO.hull(Interval::ONE);
            }
        }
        (enclosed.outputs.tipping(&mode, &bounds) != Tipping::Always).then_some((mode, bounds))
    }

    fn summary(&self, ranges: &[ParameterRange], searched: &[Searched]) -> report::Uncertainty {
        let mut records: BTreeMap<&[ContactState], Record> = BTreeMap::new();
        for modes in searched.iter().flatten() {
            for (mode, presence) in modes {
                let found = presence
                    .unknowns
                    .as_deref()
                    .map(|unknowns| self.mechanism.bounds_at_faces(mode, forces(mode, unknowns)));
                let record =
                    records.entry(mode).or_insert_with(|| Record { certain: 0, bounds: found.clone() });
                record.certain += usize::from(presence.certain > 0);
                record.bounds = record.bounds.take().zip(found).map(|(one, other)| hull(&one, &other));
            }
        }
        let mut open: Vec<String> =
            searched.iter().filter_map(|modes| modes.as_ref().err().cloned()).collect();
        open.sort_unstable();
        open.dedup();
        let persistence = |record: &Record| match record.certain {
            certain if certain == searched.len() => Persistence::AllValues,
            0 => Persistence::Undecided,
            _ => Persistence::SomeValues,
        };
        let mode = |(mode, record): (&&[ContactState], &Record)| report::UncertainMode {
            pattern: pattern(mode),
            joints: self.joint_modes(&signs(mode)),
            persistence: persistence(record),
            // In parts that could not be decided the forces may be any.
            normal_force_bounds: record.bounds.clone().filter(|_| open.is_empty()),
        };
        let count = |certain: bool| {
            let pressed = |mode: &[ContactState]| !mode.contains(&ContactState::Gap);
            searched.iter().map(move |modes| match modes {
                Ok(modes) => {
                    let counted = modes.iter().filter(|(mode, _)| pressed(mode));
                    counted.map(|(_, found)| if certain { found.certain } else { found.possible }).sum()
                }
                Err(_) => 0_usize,
            })
        };
        report::Uncertainty {
            parameters: ranges.iter().map(parameter).collect(),
            least_solutions: count(true).min().unwrap_or(0),
            most_solutions: open.is_empty().then(|| count(false).max().unwrap_or(0)),
            modes: records.iter().map(mode).collect(),
            parts: searched.len(),
            open,
        }
    }
}

/// Searches the whole box, and halves what leaves something open, as far as the number of boxes allows.
fn subdivide(
    ranges: &[ParameterRange],
    search_box: &mut dyn FnMut(&[Interval]) -> Searched,
) -> Vec<Searched> {
    let whole: Vec<Interval> = ranges.iter().map(ParameterRange::interval).collect();
    let mut done = Vec::new();
    let mut waiting = std::collections::VecDeque::from([whole.clone()]);
    let mut searched = 0;
    while let Some(part) = waiting.pop_front() {
        let modes = search_box(&part);
        searched += 1;
        let is_open =
            modes.as_ref().map_or(true, |modes| modes.values().any(|mode| mode.certain < mode.possible));
        match halves(&part, &whole).filter(|_| is_open && searched + waiting.len() + 2 <= BOXES) {
            Some(halves) => waiting.extend(halves),
            None => done.push(modes),
        }
    }
    done
}

/// The halves of a box, cut across its longest side relative to the whole; none if it has no extent.
fn halves(part: &[Interval], whole: &[Interval]) -> Option<[Vec<Interval>; 2]> {
    let extent = |k: &usize| part[*k].width() / whole[*k].width();
    let longest = (0..part.len())
        .filter(|&k| part[k].width() > 0.0)
        .max_by(|one, other| extent(one).total_cmp(&extent(other)))?;
    let middle = part[longest].middle();
    let half = |from: f64, to: f64| {
        let mut half = part.to_vec();
        half[longest] = Interval::new(from, to)?;
        Some(half)
    };
    Some([half(part[longest].lower(), middle)?, half(middle, part[longest].upper())?])
}

/// The numbers of solutions and of preload-gap states, where they are proven to be the same for all values
/// within the bounds; states in which a normal force exceeds `greatest` do not count.
pub(crate) fn certain_counts(
    enclosed: &EnclosedModeProblem,
    result: &SearchResult,
    options: &SolveOptions,
    greatest: Option<f64>,
) -> Option<[usize; 2]> {
    let lists: StateLists = result.lists(options.most, 1);
    let is_open = !lists.singular.is_empty() || !lists.undecided.is_empty() || !lists.all_listed;
    if result.completeness != Completeness::Proven || is_open {
        return None;
    }
    let solutions = lists.solutions.iter().map(|found| (pressed(&found.pattern), &found.certificate));
    let gaps = lists.gaps.iter().map(|found| (found.pattern.clone(), &found.certificate));
    let mut counts = [0; 2];
    for (mode, certificate) in solutions.chain(gaps) {
        let Certificate::Proven { unknowns } = certificate else { return None };
        match enclosed.outputs.tipping(&mode, unknowns) {
            Tipping::Never => {}
            Tipping::Open => return None,
            // Without normal force it may rest in its preload gap instead.
            Tipping::Always
                if enclosed.outputs.couples.iter().any(|couple| unknowns[couple.contact].contains(0.0)) =>
            {
                return None;
            }
            Tipping::Always => continue,
        }
        let greatest = greatest.unwrap_or(f64::INFINITY);
        let forces = mode.iter().zip(unknowns).filter(|(state, _)| **state != ContactState::Gap);
        let forces: Vec<&Interval> = forces.map(|(_, force)| force).collect();
        if forces.iter().all(|force| force.upper() <= greatest) {
            counts[usize::from(!enclosed.open.is_solution(&mode))] += 1;
        } else if forces.iter().all(|force| force.lower() <= greatest) {
            return None;
        }
    }
    Some(counts)
}

/// Bounds of the signed normal forces; a `y_k` is not negative.
fn forces(mode: &[ContactState], unknowns: &[Interval]) -> Vec<Interval> {
    let one = |(state, y): (&ContactState, &Interval)| match state {
        ContactState::Positive => Real::max(*y, Interval::ZERO),
        ContactState::Negative => -Real::max(*y, Interval::ZERO),
        ContactState::Gap => Interval::ZERO,
    };
    mode.iter().zip(unknowns).map(one).collect()
}

fn hull(one: &[[f64; 2]], other: &[[f64; 2]]) -> Vec<[f64; 2]> {
    one.iter().zip(other).map(|(a, b)| [a[0].min(b[0]), a[1].max(b[1])]).collect()
}

fn parameter(range: &ParameterRange) -> report::UncertainParameter {
    report::UncertainParameter {
        shown_in: range.shown_in.clone(),
        name: range.name.clone(),
        from: range.from,
        to: range.to,
        value: range.middle,
    }
}
