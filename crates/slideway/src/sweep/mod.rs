//! Sweeps: all solutions at every point of a grid, or of random samples, of parameters, coordinates and
//! rates.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::sweep::{GridAxis, Sweep, SweepOptions};
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let model = Model::parse(text)?.with(&Settings::default().parameter("F_20", "0"))?;
//! let sweep = Sweep::new(&model, &SweepOptions::grid([GridAxis::linear("mu_1", 0.0, 0.8, 801)]))?;
//! let tally = sweep.tally();
//! // Klepp (2002), section 7: two solutions from mu_1 = 0.4526 on, so at 0.453 and the 347 points behind it.
//! assert_eq!((tally.solutions[&1], tally.solutions[&2]), (453, 348));
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Method
//! Each point goes through the stages of [`mod@crate::solve`] without the proof. What the varied quantities
//! leave as it is, is not computed anew: where only coefficients of friction and preloads change, the
//! influence coefficients stay; a position is reached from those of the last points
//! ([`crate::configuration::Follower`]). Up to 8 contacts all patterns are tried by elimination. Where that
//! leaves a pattern in doubt, because it is close to a boundary between modes or to locking, and for more
//! contacts, the point is left to [`mod@crate::solve`] itself (with a common factor of friction to its
//! search, with bounds of rounding that are assumed, not proven). Contacts of one block that both have a
//! preload at the pressed face have dependent gap states, so that each of their points is one of these.
//!
//! With friction in hinges, what the norms of the blocks show to be the only solution is sought from that of the point
//! before ([`crate::modes::blocks::only_solution`]), within bounds; where they show nothing, all solutions are searched
//! for. Near a boundary, and where attainability is asked for, the point is left to [`mod@crate::solve`].
//!
//! # Order
//! Points are numbered with the last quantity varying fastest. They are computed in chunks whose size hangs
//! on the model and on what is varied alone, so that nothing depends on the number of threads.
//!
//! # Files
//! `sweep` evaluates points one after another: `options.rs` is what is asked for, `axis.rs`, `quantity.rs`
//! and `distribution.rs` what is varied, `friction.rs` the formulas that only change friction, `stages.rs`
//! all else about a point, `evaluator.rs` solves it, `writer.rs` has the rows of what was found, `told.rs` those from a report of `solve`,
//! `branches.rs` numbers what continues what, `breakpoints.rs` asks `limits`, `line.rs` is what plots need to
//! know of an axis, `shard.rs` divides the points. `modes::screen` is its enumeration, `configuration::Follower` and `kinetics::influences`
//! are the stages for neighbouring states. Files are made by the crate `slideway-tables`.

mod axis;
mod branches;
mod breakpoints;
mod columns;
mod distribution;
mod doubts;
mod evaluator;
mod friction;
mod line;
mod options;
mod plan;
mod quantity;
mod rows;
mod shard;
mod stages;
mod summary;
mod text;
mod told;
mod writer;

pub use branches::Branches;
pub use breakpoints::Breakpoints;
pub use columns::Column;
pub use distribution::{Sampling, Spread};
pub use line::Line;
pub use options::{GridAxis, GridValues, SampledAxis, SampledValues, SweepOptions, SweepPoints};
pub use rows::{Breakpoint, PointStatus, Refusal, RowHead, RowKind, Rows};
pub use shard::{Shard, ShardFault};
pub use summary::{Probability, Tally};

use crate::fault::{AxisProblem, Fault, FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::Callback;
use crate::units::Units;
use axis::{Axis, Values};
use columns::Columns;
use evaluator::Evaluator;
use friction::FrictionFormulas;
use options::fault;
use plan::{Plan, Point};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::{ControlFlow, Range};

/// Points that are computed one after another: the unit of parallel work, and of what is lost where a sweep
/// is ended. So that this is little, there are fewer where a point takes longer: points that are solved
/// by elimination, by a search.
const CHUNKS: [u64; 2] = [128, 1];
/// Chunks of which each thread may hold the rows at a time.
const CHUNKS_PER_THREAD: usize = 4;
/// Truncated probability mass below this is not reported.
const NEGLIGIBLE: f64 = 1e-9;
/// The most points of a sweep.
const MOST_POINTS: u64 = 1_000_000_000_000;

/// A sweep that is ready to be computed.
#[derive(Debug, Clone)]
pub struct Sweep {
    plan: Plan,
    axes: Vec<Axis>,
    samples: Option<Sampling>,
    breakpoints: Breakpoints,
    /// The points that are computed.
    range: Range<u64>,
    shard: Option<Shard>,
}

/// How far a sweep has come: all that is needed to go on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepState {
    /// Points that are done.
    pub done: u64,
    branches: Branches,
    /// Tally of these points.
    pub tally: Tally,
}

impl SweepState {
    /// How many branches there are so far.
    pub fn branches(&self) -> u32 {
        self.branches.count()
    }
}

impl Sweep {
    /// Prepares a sweep: evaluates the axes, finds the exact ends of modes between their points.
    ///
    /// # Errors
    /// Every axis that makes no sense; values of the model that are not allowed.
    pub fn new(model: &Model, options: &SweepOptions) -> Result<Self, Faults> {
        Self::new_with(model, options, &mut |_| ControlFlow::Continue(()))?.ok_or_else(ended)
    }

    /// [`Sweep::new`] with a callback that is called now and then; nothing if it breaks.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn new_with(
        model: &Model,
        options: &SweepOptions,
        callback: &mut Callback<'_>,
    ) -> Result<Option<Self>, Faults> {
        Self::prepare(model, options, |axis| breakpoints::between(model, axis, callback))
    }

    /// [`Sweep::new`] with exact ends of modes that were found before, for the same model and options.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn with_breakpoints(
        model: &Model,
        options: &SweepOptions,
        breakpoints: Breakpoints,
    ) -> Result<Self, Faults> {
        Self::prepare(model, options, |_| Some(breakpoints))?.ok_or_else(ended)
    }

    /// A sweep; nothing if `find` finds no answer to what ends of modes are on an axis.
    fn prepare(
        model: &Model,
        options: &SweepOptions,
        find: impl FnOnce(&Axis) -> Option<Breakpoints>,
    ) -> Result<Option<Self>, Faults> {
        let mechanism = Mechanism::new(model)?;
        mechanism.check_size()?;
        let axes = axes(model, &options.points)?;
        let varied: Vec<_> = axes.iter().map(|axis| axis.quantity.kind).collect();
        let friction = FrictionFormulas::new(model, &varied)?;
        let columns = Columns::new(model, &mechanism, &axes, options.all_columns);
        let attainability = options.attainability;
        let mut plan =
            Plan { model: model.clone(), mechanism, varied, columns, friction, attainability, stages: None };
        plan.prepare();
        let samples = match &options.points {
            SweepPoints::Grid(_) => None,
            SweepPoints::Samples(sampling, _) => Some(*sampling),
        };
        let own = samples
            .map_or_else(|| axes.iter().map(|axis| axis.values.len()).product(), |samples| samples.count);
        let breakpoints = match &axes[..] {
            [axis] if options.breakpoints && samples.is_none() => {
                let Some(found) = find(axis) else { return Ok(None) };
                found
            }
            _ => Breakpoints::default(),
        };
        let range = 0..own + breakpoints.own();
        Ok(Some(Self { plan, axes, samples, breakpoints, range, shard: None }))
    }

    /// The part of the sweep that is a shard. Its points keep their numbers and their rows are those of the
    /// whole sweep, but for the branches, which are not numbered: what they continue may lie before the
    /// shard. [`Sweep::append`] of the whole sweep numbers them.
    ///
    /// Shards consist of whole chunks (see [Order](self#order)), and differ in size by one at most.
    #[must_use]
    pub fn shard(&self, shard: Shard) -> Self {
        let (size, all) = (self.plan.chunk(), self.range.end);
        let chunks = shard.range(all.div_ceil(size));
        let range = (chunks.start * size).min(all)..(chunks.end * size).min(all);
        Self { range, shard: Some(shard), ..self.clone() }
    }

    /// Which shard of a sweep it is; none if it is a whole one.
    pub fn of_shard(&self) -> Option<Shard> {
        self.shard
    }

    /// The numbers of its points.
    pub fn range(&self) -> Range<u64> {
        self.range.clone()
    }

    /// Number of points, inserted ones included.
    pub fn points(&self) -> u64 {
        self.range.end - self.range.start
    }

    /// The exact ends of modes that are inserted, for [`Sweep::with_breakpoints`].
    pub fn breakpoints(&self) -> &Breakpoints {
        &self.breakpoints
    }

    /// Whether the point of this number was inserted, because it is none of the sweep's own.
    pub fn is_inserted(&self, number: u64) -> bool {
        self.breakpoints.at(number).0.is_some_and(|breakpoint| breakpoint.own)
    }

    /// The numbers of each row, in their order: the varied quantities first.
    pub fn columns(&self) -> &[Column] {
        &self.plan.columns.list
    }

    /// The contacts, in the order of the patterns.
    pub fn contacts(&self) -> impl Iterator<Item = &str> {
        self.plan.mechanism.contacts.iter().map(|contact| &*contact.name)
    }

    /// The units in which pictures show its numbers.
    pub fn units(&self) -> &Units {
        &self.plan.model.units
    }

    /// Whether there are branches: samples have no neighbours.
    pub fn has_branches(&self) -> bool {
        self.samples.is_none()
    }

    /// Whether its branches are numbered: those of a shard are not.
    pub fn numbers_branches(&self) -> bool {
        self.has_branches() && self.shard.is_none()
    }

    /// Why no exact ends of modes were inserted though they were asked for.
    pub fn without_breakpoints(&self) -> Option<&str> {
        self.breakpoints.without()
    }

    /// Distributions that were cut off at zero because friction is never negative: name, and the part that
    /// was left out.
    pub fn cut_off(&self) -> impl Iterator<Item = (&str, f64)> {
        self.axes.iter().filter_map(|axis| match axis.values {
            Values::Drawn(distribution) if distribution.left_out() > NEGLIGIBLE => {
                Some((axis.quantity.name.as_str(), distribution.left_out()))
            }
            _ => None,
        })
    }

    /// Where a sweep begins.
    pub fn start(&self) -> SweepState {
        SweepState {
            done: 0,
            branches: Branches::new(self.axes.len(), self.plan.columns.hinge_forces()),
            tally: Tally::default(),
        }
    }

    /// Computes the tally of the whole sweep.
    pub fn tally(&self) -> Tally {
        let mut state = self.start();
        self.run(&mut state, &|_| (), &mut |_, _| ControlFlow::Continue(()));
        state.tally
    }

    /// Computes the points that are not done yet, in parallel. `encode` makes of neighbouring rows what is
    /// wanted, in parallel, too. `take` gets that in the order of the points, with the state behind it, and
    /// ends the sweep when it breaks; from that state it can be continued.
    pub fn run<E: Send>(
        &self,
        state: &mut SweepState,
        encode: &(dyn Fn(&Rows) -> E + Sync),
        take: &mut (dyn FnMut(Vec<E>, &SweepState) -> ControlFlow<()> + Send),
    ) {
        self.run_while(&|| true, state, encode, take);
    }

    /// [`Sweep::run`] that also ends once `goes_on`, which is asked by any thread before points that take
    /// long and within them, says so: with the chunks of points that are done by then.
    pub fn run_while<E: Send>(
        &self,
        goes_on: &(dyn Fn() -> bool + Sync),
        state: &mut SweepState,
        encode: &(dyn Fn(&Rows) -> E + Sync),
        take: &mut (dyn FnMut(Vec<E>, &SweepState) -> ControlFlow<()> + Send),
    ) {
        let mut ready = self.compute(state.done, goes_on);
        while !ready.is_empty() {
            for rows in &mut ready {
                self.append(rows, state);
            }
            let encoded: Vec<E> = ready.par_iter().map(encode).collect();
            let next = state.done;
            // The next rows are computed while these are taken.
            let (computed, flow) = rayon::join(|| self.compute(next, goes_on), || take(encoded, state));
            if flow.is_break() {
                return;
            }
            ready = computed;
        }
    }

    /// Appends rows to what is done: numbers their branches, counts them. They are those of whole points, and
    /// follow the rows that were appended before.
    pub fn append(&self, rows: &mut Rows, state: &mut SweepState) {
        self.number(rows, &mut state.branches);
        state.tally.add(rows);
        state.done += rows.points;
    }

    /// The rows of some chunks of points behind those that are done; fewer, or none, where they were not all to be
    /// computed.
    fn compute(&self, done: u64, goes_on: &(dyn Fn() -> bool + Sync)) -> Vec<Rows> {
        let chunks = rayon::current_num_threads() * CHUNKS_PER_THREAD;
        let size = self.plan.chunk();
        let first = (self.range.start + done).div_ceil(size);
        let starts: Vec<u64> = (first..first + chunks as u64)
            .map(|chunk| chunk * size)
            .filter(|start| *start < self.range.end)
            .collect();
        let chunks: Vec<Option<Rows>> =
            starts.into_par_iter().map(|start| self.chunk(start, goes_on)).collect();
        chunks.into_iter().map_while(|rows| rows).collect()
    }

    fn chunk(&self, start: u64, goes_on: &(dyn Fn() -> bool + Sync)) -> Option<Rows> {
        let columns = &self.plan.columns;
        let mut rows = Rows::new(columns.contacts, columns.varied, columns.width());
        let numbers = start..(start + self.plan.chunk()).min(self.range.end);
        let mut values = vec![0.0; self.axes.len()];
        rows.reserve(numbers.clone().count());
        let mut evaluator = Evaluator::new(&self.plan);
        for number in numbers {
            let (breakpoint, inserted) = self.values(number, &mut values);
            let point = Point { number, breakpoint, inserted, values: &values };
            if !goes_on() || evaluator.evaluate(point, &mut rows, goes_on).is_break() {
                return None;
            }
            rows.points += 1;
        }
        Some(rows)
    }

    /// The values of a point, and what is exact about it.
    fn values(&self, number: u64, values: &mut [f64]) -> (Breakpoint, bool) {
        let dimensions = self.axes.len();
        if let Some(sampling) = self.samples {
            for (dimension, (axis, value)) in self.axes.iter().zip(values).enumerate() {
                if let Values::Drawn(distribution) = axis.values {
                    *value = distribution.quantile(sampling.at(number, dimension, dimensions));
                }
            }
            return (Breakpoint::No, false);
        }
        if let [axis] = &self.axes[..] {
            let (exact, own) = self.breakpoints.at(number);
            if let Some(exact) = exact {
                values[0] = exact.at;
                return (exact.breakpoint, exact.own);
            }
            values[0] = axis.values.at(number - own);
            return (Breakpoint::No, false);
        }
        let mut rest = number;
        for (axis, value) in self.axes.iter().zip(values).rev() {
            *value = axis.values.at(rest % axis.values.len());
            rest /= axis.values.len();
        }
        (Breakpoint::No, false)
    }

    /// Numbers the branches of neighbouring rows.
    fn number(&self, rows: &mut Rows, branches: &mut Branches) {
        if !self.numbers_branches() {
            return;
        }
        if self.axes.len() == 1 {
            branches.number_line(rows);
            return;
        }
        let mut place = vec![0; self.axes.len()];
        let mut first = 0;
        while first < rows.len() {
            let states = rows.states_from(first);
            self.place(rows.heads[first].point, &mut place);
            branches.number(rows, first..first + states, &place);
            first += states;
        }
    }

    /// The place of a point on each axis.
    fn place(&self, number: u64, place: &mut [u64]) {
        let mut rest = number;
        for (axis, place) in self.axes.iter().zip(place).rev() {
            *place = rest % axis.values.len();
            rest /= axis.values.len();
        }
    }
}

/// The fault of a sweep whose preparation was ended.
fn ended() -> Faults {
    Fault::general(FaultKind::WorkEnded).into()
}

/// The axes, with every fault of each.
fn axes(model: &Model, points: &SweepPoints) -> Result<Vec<Axis>, Faults> {
    // As texts, which may list many values, only where something is wrong.
    let read: Vec<(&dyn ToString, Result<Axis, Faults>)> = match points {
        SweepPoints::Grid(axes) => {
            axes.iter().map(|axis| (axis as &dyn ToString, Axis::of_grid(model, axis))).collect()
        }
        SweepPoints::Samples(_, axes) => {
            axes.iter().map(|axis| (axis as &dyn ToString, Axis::of_samples(model, axis))).collect()
        }
    };
    let mut faults = Faults::default();
    let mut axes: Vec<Axis> = Vec::new();
    let mut points = Some(1_u64);
    if read.is_empty() {
        faults.append(fault("", AxisProblem::Malformed));
    }
    for (text, axis) in read {
        let axis = match axis {
            Ok(axis) => axis,
            Err(list) => {
                faults.append(list);
                continue;
            }
        };
        if axes.iter().any(|other| other.quantity.kind == axis.quantity.kind) {
            faults.append(fault(&text.to_string(), AxisProblem::Twice { name: axis.quantity.name.clone() }));
        }
        let more = points.and_then(|points| points.checked_mul(axis.values.len()));
        points = more.filter(|points| *points <= MOST_POINTS);
        if points.is_none() {
            faults.append(fault(&text.to_string(), AxisProblem::TooMany { limit: MOST_POINTS }));
            points = Some(1);
        }
        axes.push(axis);
    }
    faults.or(axes)
}
