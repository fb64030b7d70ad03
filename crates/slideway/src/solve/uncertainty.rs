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
use crate::modes::certificate::{has_one_solution, is_exchange};
use crate::modes::{Certificate, Completeness, ContactState, OpenContacts, SearchResult, StateLists, search};
use crate::progress::Callback;
use crate::report::{self, Persistence};
use std::collections::{BTreeMap, BTreeSet};

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

/// What is known of a box, or why it could not be searched.
pub(super) type Searched = Result<Found, String>;

/// What is known of a box.
pub(super) struct Found {
    /// Its modes, those in preload gaps among them.
    pub(super) modes: BTreeMap<Vec<ContactState>, Presence>,
    /// Every value in it has at least so many solutions, ...
    pub(super) least: usize,
    /// ... and at most so many.
    pub(super) most: usize,
}

impl Found {
    /// These modes, each of which may be a solution independently of the others.
    fn of(modes: BTreeMap<Vec<ContactState>, Presence>, open: &OpenContacts) -> Self {
        let solutions = || modes.iter().filter(|(mode, _)| open.is_solution(mode)).map(|(_, found)| found);
        let least = solutions().map(|found| found.certain).sum();
        let most = solutions().map(|found| found.possible).sum();
        Self { modes, least, most }
    }

    fn is_open(&self) -> bool {
        self.modes.values().any(|mode| mode.certain < mode.possible)
    }
}

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
        // Those that may be or not, with bounds of their unknowns, as long as none of them may tip.
        let mut doubtful = Some(Vec::new());
        let mut add = |mode: Vec<ContactState>, unknowns: Option<&[Interval]>, proven: bool| {
            let tipping = unknowns.map_or(Tipping::Open, |bounds| enclosed.outputs.tipping(&mode, bounds));
            let unknowns = unknowns.map(<[Interval]>::to_vec);
            match (tipping, &unknowns) {
                (Tipping::Never, Some(_)) if proven => {}
                (Tipping::Never, Some(bounds)) => {
                    doubtful.iter_mut().for_each(|all| all.push((mode.clone(), bounds.clone())));
                }
                _ => doubtful = None,
            }
            if tipping != Tipping::Always {
                let presence = Presence::one(proven && tipping == Tipping::Never, unknowns);
                modes.entry(mode).or_insert(presence);
            } else if let Some((mode, bounds)) =
                unknowns.and_then(|bounds| self.in_gap(enclosed, mode, bounds))
            {
                modes.insert(mode, Presence::one(false, Some(bounds)));
            }
        };
        let is_proven = |certificate: &Certificate| matches!(certificate, Certificate::Proven { .. });
        for solution in &lists.solutions {
            let certificate = &solution.certificate;
            add(pressed(&solution.pattern), certificate.unknowns(), is_proven(certificate));
        }
        for gap in &lists.gaps {
            add(gap.pattern.clone(), gap.certificate.unknowns(), is_proven(&gap.certificate));
        }
        for mode in &lists.singular {
            add(mode.pattern.clone(), mode.certificate.unknowns(), is_proven(&mode.certificate));
        }
        for undecided in &lists.undecided {
            add(undecided.pattern.clone(), undecided.unknowns.as_deref(), false);
        }
        let mut found = Found::of(modes, &enclosed.open);
        if let Some(doubtful) = doubtful.filter(|doubtful| !doubtful.is_empty()) {
            if has_one_solution(&enclosed.problem) {
                (found.least, found.most) = (1, 1);
            } else if is_exchange(&enclosed.problem, &doubtful) {
                (found.least, found.most) = (found.least + 1, found.least + 1);
            }
        }
        Ok(found)
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

    fn summary(
        &self,
        ranges: &[ParameterRange],
        searched: &[(Vec<Interval>, Searched)],
    ) -> report::Uncertainty {
        let mut records: BTreeMap<&[ContactState], Record> = BTreeMap::new();
        let found = || searched.iter().map(|(_, found)| found);
        for found in found().flatten() {
            for (mode, presence) in &found.modes {
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
        let mut open: Vec<String> = found().filter_map(|found| found.as_ref().err().cloned()).collect();
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
        let counts = found().map(|found| found.as_ref().map_or((0, 0), |found| (found.least, found.most)));
        let proven = found().flatten().filter(|found| found.least == found.most).map(|found| found.least);
        report::Uncertainty {
            parameters: ranges.iter().map(parameter).collect(),
            least_solutions: counts.clone().map(|(least, _)| least).min().unwrap_or(0),
            most_solutions: open.is_empty().then(|| counts.map(|(_, most)| most).max().unwrap_or(0)),
            proven_counts: proven.collect::<BTreeSet<_>>().into_iter().collect(),
            stretches: if ranges.len() == 1 { stretches(searched) } else { Vec::new() },
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
) -> Vec<(Vec<Interval>, Searched)> {
    let whole: Vec<Interval> = ranges.iter().map(ParameterRange::interval).collect();
    let mut done = Vec::new();
    let mut waiting = std::collections::VecDeque::from([whole.clone()]);
    let mut searched = 0;
    while let Some(part) = waiting.pop_front() {
        let found = search_box(&part);
        searched += 1;
        let is_open = found.as_ref().map_or(true, Found::is_open);
        match halves(&part, &whole).filter(|_| is_open && searched + waiting.len() + 2 <= BOXES) {
            Some(halves) => waiting.extend(halves),
            None => done.push((part, found)),
        }
    }
    done
}

/// The numbers of solutions along a parameter, from its least value to its greatest: adjoining boxes with the same
/// bounds of the number are one stretch.
fn stretches(searched: &[(Vec<Interval>, Searched)]) -> Vec<report::CountStretch> {
    let mut boxes: Vec<report::CountStretch> = searched
        .iter()
        .map(|(part, found)| {
            let (least, most) = found.as_ref().map_or((0, None), |found| (found.least, Some(found.most)));
            let [from, to] = [part[0].lower(), part[0].upper()];
            report::CountStretch { from, to, least_solutions: least, most_solutions: most }
        })
        .collect();
    boxes.sort_by(|one, other| one.from.total_cmp(&other.from));
    boxes.dedup_by(|next, last| {
        let same = (next.least_solutions, next.most_solutions) == (last.least_solutions, last.most_solutions);
        if same {
            last.to = next.to;
        }
        same
    });
    boxes
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
    let forces = |(mode, certificate): (Vec<ContactState>, &Certificate)| {
        let Certificate::Proven { unknowns } = certificate else { return Some(None) };
        match enclosed.outputs.tipping(&mode, unknowns) {
            Tipping::Never => Some(Some((mode, unknowns.clone()))),
            Tipping::Open => Some(None),
            // Without normal force it may rest in its preload gap instead.
            Tipping::Always => {
                let mut couples = enclosed.outputs.couples.iter();
                couples.any(|couple| unknowns[couple.contact].contains(0.0)).then_some(None)
            }
        }
    };
    counted(&enclosed.open, greatest, solutions.chain(gaps).filter_map(forces))
}

/// The numbers of solutions and of preload-gap states with normal forces up to `greatest`, from bounds of `|N_k|` of each.
/// Returns `None` if one is not certain, or may exceed that, or may not.
pub(crate) fn counted(
    open: &OpenContacts,
    greatest: Option<f64>,
    states: impl Iterator<Item = Option<(Vec<ContactState>, Vec<Interval>)>>,
) -> Option<[usize; 2]> {
    let greatest = greatest.unwrap_or(f64::INFINITY);
    let mut counts = [0; 2];
    for state in states {
        let (mode, forces) = state?;
        let pressed = mode.iter().zip(&forces).filter(|(state, _)| **state != ContactState::Gap);
        let forces: Vec<&Interval> = pressed.map(|(_, force)| force).collect();
        if forces.iter().all(|force| force.upper() <= greatest) {
            counts[usize::from(!open.is_solution(&mode))] += 1;
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
