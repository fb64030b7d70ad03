//! From all solutions at values to branches.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::rc::Rc;

use super::branch::{Branch, BranchEnd, Branches, Gap};
use super::curve::{Curve, Way};
use super::family::{Family, Instance, NoInstance};
use super::place::Place;
use super::samples::{Found, Sample};
use crate::existence::EndCause;
use crate::progress::{Progress, Work};
use crate::scan::{self, Sample as Value, Scan, evenly};
use crate::search::SearchOptions;

/// Halvings between evenly spaced values where the numbers of solutions differ.
const DEPTH: i32 = 8;
/// Where all solutions are sought near a value that does not tell them, as shares of the way to the next one.
const NEARBY: [f64; 4] = [0.0, 0.137, -0.211, 0.018];
/// How often stretches without a value are sought.
const ROUNDS: usize = 6;
/// Ends nearer to each other than this share of the range are one.
const SAME: f64 = 1e-9;

/// What is sought.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchOptions {
    /// The range of the parameter.
    pub range: [f64; 2],
    /// Evenly spaced values at least.
    pub values: usize,
    /// Further values.
    pub further: Vec<f64>,
    /// Branches count only where no normal force exceeds this.
    pub greatest_normal_force: Option<f64>,
    /// Limits of the search at each value.
    pub search: SearchOptions,
}

/// All branches in a range, as far as the values show them; what was found until the work ended.
pub fn branches(family: &Family<'_>, options: &BranchOptions, work: Work<'_>) -> Branches {
    // Once the work is over there is no problem anywhere, so that whatever seeks one ends.
    let family = &|at: f64| if work.is_over() { Err(NoInstance::Other) } else { family(at) };
    let (stretches, gaps) = stretches(family, options);
    if work.is_over() {
        return Branches::default();
    }
    let mut all = Branches { gaps, ..Branches::default() };
    for (index, stretch) in stretches.iter().enumerate() {
        let within = |at: f64| {
            let is_inside = (stretch.from..=stretch.to).contains(&at);
            let instance = if is_inside { family(at)? } else { return Err(NoInstance::Other) };
            if instance.senses == stretch.senses { Ok(instance) } else { Err(NoInstance::NoSense) }
        };
        let work = work.part(index, stretches.len());
        let mut finder = Finder::new(&within, stretch, options, work);
        finder.sample();
        all.branches.extend(finder.branches());
        all.tried.extend(finder.samples.iter().map(|sample| sample.at));
    }
    all.branches.sort_by(Branch::order);
    all
}

/// A stretch in which the problem does not jump.
struct Stretch {
    from: f64,
    to: f64,
    senses: Vec<i8>,
    /// Why it begins and ends.
    causes: [EndCause; 2],
}

/// The senses at a value, or why there is no problem.
type Senses = Result<Vec<i8>, NoInstance>;

/// The stretches of a range, and those without a problem.
fn stretches(family: &Family<'_>, options: &BranchOptions) -> (Vec<Stretch>, Vec<Gap>) {
    let senses = |at: f64| family(at).map(|instance| instance.senses);
    let mut values: Vec<f64> =
        evenly(options.range, options.values).chain(options.further.iter().copied()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let known: Vec<Value<Senses>> = values.iter().map(|&at| Value { at, found: senses(at) }).collect();
    let [from, to] = options.range;
    let scan = Scan { answer: &senses, is_like: Senses::eq, narrowest: SAME * (to - from) };
    let all = scan.stretches(&known);
    let why = |beside: Option<&scan::Stretch<Senses>>| match beside.map(|stretch| &stretch.found) {
        None => EndCause::Range,
        Some(Err(NoInstance::Other)) => EndCause::NoProblem,
        Some(_) => EndCause::Reversal,
    };
    let (mut stretches, mut gaps) = (Vec::new(), Vec::new());
    for (index, scan::Stretch { from, to, at, found }) in all.iter().enumerate() {
        let (from, to) = (*from, *to);
        match found {
            Ok(senses) => {
                let causes = [index.checked_sub(1).map(|before| &all[before]), all.get(index + 1)].map(why);
                stretches.push(Stretch { from, to, senses: senses.clone(), causes });
            }
            Err(_) => gaps.push(Gap { from, to, inside: *at }),
        }
    }
    (stretches, gaps)
}

/// What happens to the solutions of neighbouring samples between them.
#[derive(Default)]
struct Between {
    /// Which are of one branch.
    joined: Vec<(usize, usize)>,
    /// The ends of branches of the first and of the second sample.
    ends: [Vec<(usize, Place, EndCause)>; 2],
}

/// Samples of a stretch.
struct Finder<'f> {
    family: &'f Family<'f>,
    stretch: &'f Stretch,
    options: &'f BranchOptions,
    unit: f64,
    samples: Vec<Sample>,
    /// What is known of neighbouring samples, by their values.
    known: RefCell<HashMap<[u64; 2], Rc<Between>>>,
    work: Work<'f>,
}

impl<'f> Finder<'f> {
    fn new(family: &'f Family<'f>, stretch: &'f Stretch, options: &'f BranchOptions, work: Work<'f>) -> Self {
        let load = |instance: &Instance| instance.problem.load().centre().amax();
        let loads =
            evenly([stretch.from, stretch.to], 8).filter_map(|at| family(at).ok().map(|one| load(&one)));
        let greatest = loads.fold(0.0, f64::max);
        let unit = if greatest > 0.0 { greatest } else { 1.0 };
        Self { family, stretch, options, unit, samples: Vec::new(), known: RefCell::default(), work }
    }

    /// Finds all solutions at evenly spaced values, between values where their numbers differ, and in between
    /// neighbouring ends of branches.
    fn sample(&mut self) {
        let Stretch { from, to, .. } = *self.stretch;
        let is_inside = |at: &f64| (from..=to).contains(at);
        let values = evenly(self.options.range, self.options.values).filter(is_inside).count().max(4);
        let spacing = (to - from) / values as f64;
        let further = self.options.further.iter().copied().filter(is_inside);
        let wanted: Vec<f64> = evenly([from, to], values).chain(further).collect();
        for (index, &at) in wanted.iter().enumerate() {
            if self.work.tell(&Progress::of("values", index as u64, wanted.len() as u64)).is_break() {
                return;
            }
            self.add(at, spacing);
        }
        self.refine(spacing * 0.5_f64.powi(DEPTH));
        for _ in 0..ROUNDS {
            let missing = self.unexamined();
            if missing.is_empty() || self.work.is_over() {
                break;
            }
            for [from, to] in missing {
                self.add(f64::midpoint(from, to), to - from);
            }
        }
    }

    /// Adds a sample at a value, or near it within a part of the way to the next one.
    fn add(&mut self, at: f64, spacing: f64) -> bool {
        let Stretch { from, to, .. } = *self.stretch;
        let usual = self.samples.last().map_or_else(Vec::new, |sample| sample.without_force.clone());
        let mut doubtful = None;
        for share in NEARBY {
            let inwards =
                if at + share * spacing < from || at + share * spacing > to { -share } else { share };
            let near = (at + inwards * spacing).clamp(from, to);
            let Some(sample) = self.sampled(near) else { continue };
            if sample.without_force == usual {
                return self.insert(sample);
            }
            doubtful = doubtful.or(Some(sample));
        }
        doubtful.is_some_and(|sample| self.insert(sample))
    }

    fn insert(&mut self, sample: Sample) -> bool {
        let place = self.samples.partition_point(|other| other.at < sample.at);
        let is_known = self.samples.get(place).is_some_and(|other| other.at == sample.at);
        if !is_known {
            self.samples.insert(place, sample);
        }
        !is_known
    }

    fn sampled(&self, at: f64) -> Option<Sample> {
        let instance = (self.family)(at).ok()?;
        let work = self.work;
        let mut goes_on = move |_: &Progress| work.flow();
        let forces = (self.unit, self.options.greatest_normal_force);
        Sample::new(at, &instance, forces, &self.options.search, &mut goes_on)
    }

    /// Halves between samples with different numbers of solutions, down to a distance.
    fn refine(&mut self, least: f64) {
        let mut index = 0;
        while index + 1 < self.samples.len() && self.work.flow() == ControlFlow::Continue(()) {
            let [one, other] = [&self.samples[index], &self.samples[index + 1]];
            let distance = other.at - one.at;
            let halve = one.classes() != other.classes() && distance > least;
            if !(halve && self.add(f64::midpoint(one.at, other.at), 0.5 * distance)) {
                index += 1;
            }
        }
    }

    /// Stretches between neighbouring ends of branches in which there is no sample.
    fn unexamined(&self) -> Vec<[f64; 2]> {
        let [first, last] = self.options.range;
        let mut ends: Vec<f64> =
            self.branches().iter().flat_map(|branch| [branch.from.end.at, branch.to.end.at]).collect();
        ends.extend([self.stretch.from, self.stretch.to]);
        ends.sort_by(f64::total_cmp);
        let is_empty = |[from, to]: &[f64; 2]| {
            let is_inside = |sample: &Sample| *from < sample.at && sample.at < *to;
            to - from > SAME * (last - first) && !self.samples.iter().any(is_inside)
        };
        ends.windows(2).map(|pair| [pair[0], pair[1]]).filter(is_empty).collect()
    }

    fn curve(&self, found: &Found) -> Curve<'f> {
        Curve {
            family: self.family,
            equations: found.equations.clone(),
            greatest: self.options.greatest_normal_force,
            orientation: found.orientation,
        }
    }

    fn between(&self, one: &Sample, other: &Sample) -> Rc<Between> {
        let key = [one.at.to_bits(), other.at.to_bits()];
        if let Some(known) = self.known.borrow().get(&key) {
            return Rc::clone(known);
        }
        let between = Rc::new(self.compared(one, other));
        self.known.borrow_mut().insert(key, Rc::clone(&between));
        between
    }

    fn compared(&self, one: &Sample, other: &Sample) -> Between {
        let mut between = Between::default();
        let mut classes = [one.classes(), other.classes()].concat();
        classes.sort();
        classes.dedup();
        for class in classes {
            let of = |sample: &Sample| -> Vec<usize> {
                (0..sample.found.len()).filter(|&index| sample.found[index].class() == class).collect()
            };
            let (mut left, mut right) = (of(one), of(other));
            if left.len() != right.len() {
                self.follow((one, other), (&mut left, &mut right), &mut between);
            }
            between.joined.extend(nearest((one, &left), (other, &right)));
        }
        between
    }

    /// Follows solutions of one class, and keeps in the lists those that are of a branch in the other sample.
    fn follow(
        &self,
        (one, other): (&Sample, &Sample),
        (left, right): (&mut Vec<usize>, &mut Vec<usize>),
        between: &mut Between,
    ) {
        let mut walk = |list: &mut Vec<usize>, side: usize, [from, to]: [&Sample; 2]| {
            list.retain(|&index| {
                let found = &from.found[index];
                match self.curve(found).walk(&found.place, to.at) {
                    Way::Reaches(_) => true,
                    Way::Ends(place, cause) => {
                        between.ends[side].push((index, place, cause));
                        false
                    }
                }
            });
        };
        walk(left, 0, [one, other]);
        walk(right, 1, [other, one]);
    }

    /// The branches that the samples show.
    fn branches(&self) -> Vec<Branch> {
        let mut done = Vec::new();
        let Some(first) = self.samples.first() else { return done };
        let start = |found: &Found| {
            let (place, cause) = self.border(found, 0);
            Open::new(found, place, cause)
        };
        let mut open: Vec<Open> = first.found.iter().map(start).collect();
        for pair in self.samples.windows(2) {
            let between = self.between(&pair[0], &pair[1]);
            let mut next: Vec<Option<Open>> = pair[1].found.iter().map(|_| None).collect();
            for (index, mut branch) in open.into_iter().enumerate() {
                let joined = between.joined.iter().find(|(left, _)| *left == index);
                let end = between.ends[0].iter().find(|(left, ..)| *left == index);
                match (joined, end) {
                    (Some((_, right)), _) => {
                        branch.trail.push(pair[1].found[*right].place.clone());
                        next[*right] = Some(branch);
                    }
                    (None, Some((_, place, cause))) => done.push(self.finished(branch, place, cause)),
                    (None, None) => {
                        let place = pair[0].found[index].place.clone();
                        done.push(self.finished(branch, &place, &EndCause::NotFollowed));
                    }
                }
            }
            open = next
                .into_iter()
                .enumerate()
                .map(|(index, branch)| {
                    let found = &pair[1].found[index];
                    branch.unwrap_or_else(|| {
                        let begin = between.ends[1].iter().find(|(right, ..)| *right == index);
                        let (place, cause) = begin.map_or_else(
                            || (found.place.clone(), EndCause::NotFollowed),
                            |(_, place, cause)| (place.clone(), cause.clone()),
                        );
                        Open::new(found, place, cause)
                    })
                })
                .collect();
        }
        let last = self.samples.last().expect("there is a first one");
        for (branch, found) in open.into_iter().zip(&last.found) {
            let (place, cause) = self.border(found, 1);
            done.push(self.finished(branch, &place, &cause));
        }
        done
    }

    /// Where a solution of the outermost sample ends towards a border of the stretch.
    fn border(&self, found: &Found, side: usize) -> (Place, EndCause) {
        let goal = [self.stretch.from, self.stretch.to][side];
        match self.curve(found).walk(&found.place, goal) {
            Way::Reaches(place) => (Place { at: goal, ..place }, self.stretch.causes[side].clone()),
            Way::Ends(place, cause) => (place, cause),
        }
    }

    fn finished(&self, mut open: Open, place: &Place, cause: &EndCause) -> Branch {
        let curve = self.curve(&open.found);
        let (begin, why) = &open.begin;
        let from = BranchEnd::new(&curve, begin, why.clone(), place.at);
        let to = BranchEnd::new(&curve, place, cause.clone(), begin.at);
        open.trail.insert(0, begin.clone());
        open.trail.push(place.clone());
        Branch {
            states: open.found.states,
            orientation: if open.found.orientation == crate::interval::Sign::Negative { -1 } else { 1 },
            from,
            to,
            trail: open.trail,
            equations: open.found.equations,
        }
    }
}

/// A branch that has begun.
struct Open {
    found: Found,
    begin: (Place, EndCause),
    trail: Vec<Place>,
}

impl Open {
    fn new(found: &Found, place: Place, cause: EndCause) -> Self {
        Self { found: found.clone(), begin: (place, cause), trail: vec![found.place.clone()] }
    }
}

/// Pairs of solutions of one class that are nearest to each other, the nearest first.
fn nearest((one, left): (&Sample, &[usize]), (other, right): (&Sample, &[usize])) -> Vec<(usize, usize)> {
    let distance = |i: usize, j: usize| (&one.found[i].place.z - &other.found[j].place.z).norm();
    let mut pairs: Vec<(f64, usize, usize)> =
        left.iter().flat_map(|&i| right.iter().map(move |&j| (distance(i, j), i, j))).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(usize, usize)> = Vec::new();
    for (_, i, j) in pairs {
        if joined.iter().all(|&(left, right)| left != i && right != j) {
            joined.push((i, j));
        }
    }
    joined
}
