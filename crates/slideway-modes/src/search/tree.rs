//! Branch and bound over the states of contacts.

use std::sync::Arc;

use nalgebra::DVector;

use super::branching::{branching, candidates};
use super::faces::{Faces, Settled};
use super::leaf::Leaves;
use super::load::LoadedProblem;
use super::monitor::Monitor;
use super::proof_log::ProofLog;
use super::propagation::SolvedForm;
use super::reduced::ReducedRelaxation;
use super::relaxation::{Positive, Relaxation, Relaxed, RelaxedContact};
use super::report::{Exclusion, ExclusionArgument, PatternShares, SearchOptions, StopReason};
use super::states::{StateSet, fraction_of_patterns};
use crate::problem::{ContactState, ScaledProblem};
use crate::simplex::Basis;
use crate::solutions::ContactSet;

/// Relaxed solutions that violate complementarity by at most this fraction of the largest unknown (or of 1)
/// are examined as solutions.
const COMPLEMENTARY: f64 = 1e-9;

/// The bases of waiting nodes hold up to so many numbers (16 MB), unless those of a few nodes are larger, ...
const BASES: usize = 1 << 21;
/// ... and up to so many (1 MB) while a subtree waits for its next round.
pub(super) const BASES_OF_WAITING: usize = 1 << 17;

/// A waiting node, with the basis of its parent: `None` if it was dropped to save memory.
pub(super) struct Node {
    pub(super) states: Vec<StateSet>,
    pub(super) basis: Option<Arc<Basis>>,
}

/// The record of a tree search: shares of the patterns by outcome, the work, and exclusions that are kept.
#[derive(Debug, Default, Clone)]
pub(super) struct TreeReport {
    pub(super) shares: PatternShares,
    pub(super) nodes: u64,
    pub(super) pivots: u64,
    pub(super) exclusions: Vec<Exclusion>,
}

impl TreeReport {
    /// Adds what happened in a subtree.
    pub(super) fn add(&mut self, other: Self) {
        self.shares.add(&other.shares);
        self.nodes += other.nodes;
        self.pivots += other.pivots;
        self.exclusions.extend(other.exclusions);
    }
}

#[derive(Clone)]
pub(super) struct Tree<'a> {
    pub(super) problem: &'a ScaledProblem,
    propagation: Option<&'a SolvedForm>,
    relaxation: Arc<Relaxation>,
    /// Only if the numbers are exact: within bounds, no unknown vanishes for all values.
    faces: Option<Faces>,
    keep_exclusions: bool,
    threads: usize,
    /// Only if a proof file is written.
    pub(super) log: Option<ProofLog>,
    pub(super) report: TreeReport,
}

impl<'a> Tree<'a> {
    pub(super) fn new(
        (loaded, problem): (&LoadedProblem<'_>, &'a ScaledProblem),
        propagation: Option<&'a SolvedForm>,
        load_radius: &DVector<f64>,
        options: &SearchOptions,
    ) -> Self {
        let is_exact = options.certify && options.arguments.faces && loaded.view().exact;
        let unbounded = || vec![f64::INFINITY; problem.contacts()];
        let largest = propagation.map_or_else(unbounded, |propagation| propagation.largest.clone());
        Self {
            problem,
            // Without bounds, there is nothing to propagate.
            propagation: propagation.filter(|propagation| propagation.is_contraction()),
            relaxation: Arc::new(Relaxation::new(problem, load_radius, largest)),
            faces: is_exact.then(|| Faces::new(loaded.view())),
            keep_exclusions: options.keep_exclusions,
            threads: options.threads,
            log: None,
            report: TreeReport::default(),
        }
    }

    /// A tree for a problem whose last contacts are slacks of half-spaces (see
    /// [`Relaxation::within_half_spaces`]). Patterns are examined, and cells written, without them.
    pub(super) fn within_half_spaces(
        (loaded, problem): (&LoadedProblem<'_>, &'a ScaledProblem),
        slacks: usize,
        load_radius: &DVector<f64>,
        options: &SearchOptions,
    ) -> Self {
        let unbounded = vec![f64::INFINITY; problem.contacts()];
        let relaxation = Relaxation::new(problem, load_radius, unbounded).within_half_spaces(slacks);
        let tree = Self::new((loaded, problem), None, load_radius, options);
        Self { relaxation: Arc::new(relaxation), ..tree }
    }

    /// Makes the tree write its steps, too.
    pub(super) fn logged(self, log: ProofLog) -> Self {
        Self { log: Some(log), faces: self.faces.map(Faces::with_supports), ..self }
    }

    /// Visits up to `most` nodes, the latest ones first.
    pub(super) fn work(
        &mut self,
        open: &mut Vec<Node>,
        most: u64,
        (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
    ) {
        let end = self.report.nodes.saturating_add(most);
        while self.report.nodes < end
            && let Some(node) = open.pop()
        {
            if !self.visit_next(node, open, (leaves, monitor)) {
                break;
            }
            // No proof comes of it any more.
            if self.log.as_ref().is_some_and(ProofLog::has_gap) {
                open.clear();
            }
        }
    }

    /// Visits a node; `false`, with the node still open, if the monitor stops the search.
    pub(super) fn visit_next(
        &mut self,
        node: Node,
        open: &mut Vec<Node>,
        (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
    ) -> bool {
        if !monitor.visit(self.report.shares.done(), leaves.found()) {
            open.push(node);
            return false;
        }
        self.report.nodes += 1;
        if let Err(reason) = self.visit(node, open, leaves, monitor) {
            monitor.stop(reason);
        }
        self.drop_bases(open, BASES);
        true
    }

    /// Drops the bases of the nodes that wait longest, so that the others hold up to so many numbers. Programs are then
    /// solved from the beginning, which rarely happens: those nodes come last.
    pub(super) fn drop_bases(&self, open: &mut [Node], numbers: usize) {
        let kept = (numbers / self.relaxation.size_of_basis().max(1)).max(1);
        let waiting = open.len().saturating_sub(kept);
        let with_basis = open[..waiting].iter_mut().rev().take_while(|node| node.basis.is_some());
        with_basis.for_each(|node| node.basis = None);
    }

    /// Returns the tree before its first node, with what is known so far.
    pub(super) fn subtree(&self) -> Self {
        Self { report: TreeReport::default(), log: None, ..self.clone() }
    }

    pub(super) fn threads(&self) -> usize {
        self.threads
    }

    pub(super) fn report(&self) -> &TreeReport {
        &self.report
    }

    /// Adds the report of a subtree.
    pub(super) fn add(&mut self, subtree: Self) {
        self.report.add(subtree.report);
    }

    /// Excludes a node, examines its only pattern, or adds its children to `open`.
    fn visit(
        &mut self,
        mut node: Node,
        open: &mut Vec<Node>,
        leaves: &mut Leaves<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        if !self.propagate(&mut node.states, &mut || monitor.goes_on()) {
            return Ok(());
        }
        if let Some(left) = self.force_sides(&mut node.states) {
            open.push(Node { states: node.states, basis: node.basis.clone() });
            open.push(Node { states: left, basis: node.basis });
            return Ok(());
        }
        let reduced = self.reduced(&node.states, monitor);
        let (relaxed, basis) = self.relax((&node.states, reduced.as_deref()), node.basis, monitor);
        let relaxed = match relaxed {
            Relaxed::Excluded(farkas) if self.log_excluded(&node.states, &farkas, &basis, monitor) => {
                self.report.shares.relaxation += fraction_of_patterns(self.problem, &node.states);
                let problem = self.problem;
                self.keep(&node.states, || ExclusionArgument::Farkas(problem.unscaled_rows(&farkas)));
                return Ok(());
            }
            Relaxed::Feasible(relaxed) => Some(relaxed),
            Relaxed::Excluded(_) | Relaxed::Undecided => None,
        };
        if let Some(pattern) = decided(&node.states) {
            return self.examine(&pattern, leaves, monitor);
        }
        let inside = match &relaxed {
            None if self.excludes_exactly(&node.states, monitor) => return Ok(()),
            Some(relaxed)
                if self.faces.is_some()
                    && !self.relaxation.is_far()
                    && is_complementary(&node.states, relaxed) =>
            {
                self.inside((&node.states, reduced.as_deref()), &basis, monitor)
            }
            _ => None,
        };
        let contradicting: Option<Vec<usize>> =
            inside.as_deref().map(|inside| contradictions(&node.states, inside).collect());
        let open_free = self.faces.as_ref().map_or_else(Vec::new, |faces| faces.open_free(&node.states));
        if let (Some(inside), Some(contradicting)) = (&inside, &contradicting)
            && contradicting.iter().all(|contact| open_free.contains(contact))
            && let Some(settled) = self.settle(&node.states, inside, (leaves, monitor))
        {
            return self.close_settled(settled, leaves, monitor);
        }
        let free = self.faces.as_ref().map_or(&[][..], Faces::free);
        let candidates = candidates(&node.states, contradicting.as_deref(), free);
        let (contact, preferred) = branching(&node.states, relaxed.as_deref(), &candidates);
        let basis = Arc::new(basis);
        let mut children: Vec<ContactState> = node.states[contact].iter().collect();
        // The last one is visited first.
        children.sort_by_key(|&state| (state == preferred, std::cmp::Reverse(state)));
        if let Some(log) = &mut self.log {
            let visited: Vec<ContactState> = children.iter().rev().copied().collect();
            log.branch(contact, &visited);
        }
        for state in children {
            let mut states = node.states.clone();
            states[contact] = StateSet::only(state);
            open.push(Node { states, basis: Some(Arc::clone(&basis)) });
        }
        Ok(())
    }

    /// The relaxation without free unknowns, for a node that allows it.
    fn reduced(&self, states: &[StateSet], monitor: &mut Monitor<'_>) -> Option<Arc<ReducedRelaxation>> {
        // The arguments that are kept speak of all equations.
        let faces = self.faces.as_ref().filter(|_| !self.keep_exclusions)?;
        faces.reduced(states, &mut || monitor.goes_on())
    }

    /// Solves the relaxation of a node from the basis of its parent, unless that had another relaxation.
    fn relax(
        &mut self,
        (states, reduced): (&[StateSet], Option<&ReducedRelaxation>),
        parent: Option<Arc<Basis>>,
        monitor: &mut Monitor<'_>,
    ) -> (Relaxed, Basis) {
        let (pivots, proceed) = (&mut self.report.pivots, &mut || monitor.goes_on());
        let relaxation = reduced.map_or(&*self.relaxation, ReducedRelaxation::of_others);
        let parent = parent.filter(|parent| parent.size() == relaxation.load().len());
        let parent = parent.map_or_else(|| relaxation.first_basis(), Arc::unwrap_or_clone);
        match reduced {
            Some(reduced) => reduced.solve(states, parent, pivots, proceed),
            None => relaxation.solve(states, parent, pivots, proceed),
        }
    }

    /// The unknowns that are positive inside the face of all relaxed solutions of a node.
    fn inside(
        &self,
        (states, reduced): (&[StateSet], Option<&ReducedRelaxation>),
        basis: &Basis,
        monitor: &mut Monitor<'_>,
    ) -> Option<Vec<Positive>> {
        let proceed = &mut || monitor.goes_on();
        match reduced {
            Some(reduced) => reduced.inside(states, basis, proceed),
            None => self.relaxation.inside(states, basis, proceed),
        }
    }

    /// Whether a node that the relaxation left undecided has no solution, proven in integers.
    fn excludes_exactly(&mut self, states: &[StateSet], monitor: &mut Monitor<'_>) -> bool {
        let Some(faces) = &self.faces else { return false };
        let Some(vector) = faces.excluding(states, &mut || monitor.goes_on()) else { return false };
        self.report.shares.relaxation += fraction_of_patterns(self.problem, states);
        if let Some(log) = &mut self.log {
            log.exclude_exactly(faces.system(), &vector);
        }
        true
    }

    /// Writes that the relaxation excludes a node, if steps are written; `false` if that is not possible.
    fn log_excluded(
        &mut self,
        states: &[StateSet],
        farkas: &[f64],
        basis: &Basis,
        monitor: &mut Monitor<'_>,
    ) -> bool {
        let (Some(log), Some(faces)) = (&mut self.log, &self.faces) else { return true };
        let allowed = faces.allowed(states);
        if log.exclude_again(&allowed) {
            return true;
        }
        if let Some((short, left)) = self.relaxation.short(farkas, states, &allowed, basis)
            && log.exclude(faces.system(), &short, left, &allowed)
        {
            return true;
        }
        if log.exclude_by_ratios(faces.system(), farkas, &allowed) {
            return true;
        }
        let vector = faces.excluding(states, &mut || monitor.goes_on());
        if let Some(vector) = &vector {
            log.exclude_exactly(faces.system(), vector);
        }
        vector.is_some()
    }

    /// Examines the pattern that has all solutions of a node, and writes why it has them all.
    fn close_settled(
        &mut self,
        settled: Settled,
        leaves: &mut Leaves<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        let Settled { pattern, is_known, vector, left, decision } = settled;
        if let (Some(log), Some(faces)) = (&mut self.log, &self.faces)
            && (vector.is_empty() || log.remove(faces.system(), &vector))
        {
            return self.decide_and_write(&pattern, &left, leaves, monitor);
        }
        match decision {
            _ if is_known => Ok(()),
            Some(decision) => leaves.examine_decided(&pattern, decision, monitor),
            None => leaves.examine(&pattern, monitor),
        }
    }

    /// Examines a pattern unless it has a cell already, and closes a node that allows only some of its columns.
    fn decide_and_write(
        &mut self,
        pattern: &[ContactState],
        allowed: &ContactSet,
        leaves: &mut Leaves<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        let (Some(log), Some(faces)) = (&mut self.log, &self.faces) else { return Ok(()) };
        let (pattern, slacks) = pattern.split_at(pattern.len() - self.relaxation.slacks());
        let mut examined = Ok(());
        if !log.has_cell(pattern) {
            let decision = leaves.decide(pattern, monitor)?;
            let excluding = &mut || {
                let own = pattern.iter().chain(slacks).map(|&state| StateSet::only(state));
                faces.excluding(&own.collect::<Vec<_>>(), &mut || monitor.goes_on())
            };
            let has_cell = log.decided(faces.system(), pattern, &decision, excluding);
            examined = leaves.examine_decided(pattern, decision, monitor);
            if !has_cell {
                return examined;
            }
        }
        let reducing =
            &mut |support: &ContactSet| faces.reducing(allowed, support, &mut || monitor.goes_on());
        log.close(faces.system(), pattern, allowed, reducing);
        examined
    }

    /// Settles a node whose solutions are those of one pattern.
    fn settle(
        &mut self,
        states: &[StateSet],
        inside: &[Positive],
        (leaves, monitor): (&mut Leaves<'_>, &mut Monitor<'_>),
    ) -> Option<Settled> {
        let faces = self.faces.as_mut()?;
        let settled = faces.settle(self.problem, (states, inside), (leaves, monitor))?;
        self.report.shares.faces += fraction_of_patterns(self.problem, states);
        Some(settled)
    }

    /// `false` if propagation excludes the node.
    fn propagate(&mut self, states: &mut [StateSet], proceed: &mut dyn FnMut() -> bool) -> bool {
        let Some(propagation) = self.propagation else { return true };
        let before = states.to_vec();
        let all = fraction_of_patterns(self.problem, states);
        if !propagation.fix_sides(states, proceed) {
            self.report.shares.propagation += all;
            self.keep(&before, || ExclusionArgument::Propagation);
            return false;
        }
        self.report.shares.propagation += all - fraction_of_patterns(self.problem, states);
        true
    }

    /// Decides contacts of which the signs of an equation leave only one side. Where steps are written and both unknowns
    /// of such a contact vanish with the other side, returns what is left there, which the proof has to visit first.
    fn force_sides(&mut self, states: &mut [StateSet]) -> Option<Vec<StateSet>> {
        let faces = self.faces.as_ref()?;
        let before = fraction_of_patterns(self.problem, states);
        let before_states = states.to_vec();
        let mut left = None;
        while left.is_none()
            && let Some(forced) = faces.signs().forced(states, &faces.allowed(states))
        {
            if let Some(log) = &mut self.log {
                let other = usize::from(forced.side == ContactState::Positive);
                log.branch(forced.contact, &[ContactState::PRESSED[other], forced.side]);
                let vector = faces.signs().vector(&forced);
                if log.remove(faces.system(), &vector) {
                    left = Some(faces.signs().left(&forced, states));
                }
            }
            states[forced.contact] = StateSet::only(forced.side);
        }
        if self.log.is_none() {
            // The equations give them their sides anyway, and what is eliminated takes none.
            for contact in faces.open_free(&before_states) {
                states[contact] = before_states[contact];
            }
        }
        self.report.shares.propagation += before - fraction_of_patterns(self.problem, states);
        left
    }

    fn examine(
        &mut self,
        pattern: &[ContactState],
        leaves: &mut Leaves<'_>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), StopReason> {
        let states: Vec<StateSet> = pattern.iter().map(|&state| StateSet::only(state)).collect();
        let examined = match self.faces.as_ref().filter(|_| self.log.is_some()) {
            Some(faces) => {
                let allowed = faces.allowed(&states);
                self.decide_and_write(pattern, &allowed, leaves, monitor)
            }
            None => leaves.examine(pattern, monitor),
        };
        let shares = &mut self.report.shares;
        let share = if examined == Err(StopReason::Cancelled) {
            &mut shares.unexplored
        } else {
            &mut shares.examined
        };
        *share += fraction_of_patterns(self.problem, &states);
        examined
    }

    fn keep(&mut self, states: &[StateSet], argument: impl FnOnce() -> ExclusionArgument) {
        if self.keep_exclusions {
            let argument = argument();
            self.report.exclusions.push(Exclusion { states: states.to_vec(), argument });
        }
    }
}

/// The pattern of a node, if every contact is decided.
fn decided(states: &[StateSet]) -> Option<Vec<ContactState>> {
    states.iter().map(|states| states.decided()).collect()
}

/// Whether a relaxed solution is one of the problem, within tolerances.
fn is_complementary(states: &[StateSet], relaxed: &[RelaxedContact]) -> bool {
    let size =
        relaxed.iter().fold(1.0, |most: f64, contact| most.max(contact.positive).max(contact.negative));
    let violation = |(set, contact): (&StateSet, &RelaxedContact)| contact.violation(*set);
    states.iter().zip(relaxed).map(violation).all(|violation| violation <= COMPLEMENTARY * size)
}

/// The contacts with positive unknowns that belong to no single state.
fn contradictions<'s>(states: &'s [StateSet], inside: &'s [Positive]) -> impl Iterator<Item = usize> + 's {
    (0..states.len())
        .filter(|&contact| !states[contact].iter().any(|state| inside[contact].agrees_with(state)))
}
