//! Proof files: why the solutions that are listed are all.

use std::fmt::Write as _;

use super::groups::Groups;
use super::leaf::Leaves;
use super::load::{Load, LoadedProblem};
use super::monitor::Monitor;
use super::monotone::pattern_of_all_solutions;
use super::proof_digest::digest;
use super::proof_log::ProofLog;
use super::proof_low_rank::{HalfSpaces, Parts};
use super::report::{Arguments, SearchOptions, StopReason};
use super::states::all_states;
use super::tree::Tree;
use crate::certificate::LiftedSystem;
use crate::findings::Findings;
use crate::problem::{ModeProblem, ProblemView, ScaledProblem};
use crate::progress::Callback;

/// A proof that can be checked without slideway.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProofFile {
    /// The lines of the file, in the format of the book, "Proof files".
    pub text: String,
    /// The number of cells of each independent group of contacts: all solutions are their products.
    pub cells: Vec<usize>,
    /// The nodes of the trees.
    pub nodes: u64,
}

/// Why there is no proof file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoProof {
    /// The search ended early.
    #[error("no proof: {0}")]
    Stopped(StopReason),
    /// A set of solutions has too many corners to be described.
    #[error("no proof: a set of solutions has too many corners to be described")]
    Open,
}

/// Searches all solutions of an exact problem by the rule for monotone problems and by trees, within half-spaces if
/// the coupling has low rank, and writes down every step.
///
/// `options` limit the search; `progress` is called at every node and during long steps, and ends the search
/// by breaking. Parts that do not depend on each other are proven one by one.
///
/// # Errors
/// [`NoProof`], if the search ended early or a step could not be written.
///
/// ```
/// use std::ops::ControlFlow;
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::{ModeProblem, SearchOptions, prove};
/// let problem =
///     ModeProblem::from_linear_complementarity(&dmatrix![1.0, 2.0; 2.0, 1.0], dvector![-1.0, -1.0])?;
/// let proof = prove(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!(proof.cells, [3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove(
    problem: &ModeProblem,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> Result<ProofFile, NoProof> {
    let view = ProblemView::from(problem);
    let only_trees = Arguments {
        propagation: false,
        uniqueness: false,
        low_rank: false,
        every_pattern: false,
        faces: true,
        ..options.arguments
    };
    let options = SearchOptions { arguments: only_trees, certify: true, ..*options };
    let mut monitor = Monitor::new(options.nodes, progress);
    let groups = Groups::new(view);
    let all: Vec<usize> = (0..groups.members.len()).collect();
    // The groups of a part come in the order in which they act.
    let contacts = |part: Vec<usize>| part.iter().flat_map(|&group| groups.members[group].clone()).collect();
    let parts: Vec<Vec<usize>> = groups.independent_parts(&all).into_iter().map(contacts).collect();
    let mut proof = ProofFile { text: String::new(), cells: Vec::new(), nodes: 0 };
    let mut exponents = Exponents::new(view);
    for part in &parts {
        let load = Load::of(view);
        prove_part(
            &LoadedProblem::restricted(view, part, &load),
            part,
            &options,
            (&mut proof, &mut exponents),
            &mut monitor,
        )?;
    }
    proof.text = exponents.header(&parts, digest(view)) + &proof.text;
    Ok(proof)
}

/// Adds the proof of one part.
fn prove_part(
    loaded: &LoadedProblem<'_>,
    contacts: &[usize],
    options: &SearchOptions,
    (proof, exponents): (&mut ProofFile, &mut Exponents),
    monitor: &mut Monitor<'_>,
) -> Result<(), NoProof> {
    let scaled = ScaledProblem::within(loaded.view());
    let radius = scaled.scaled_load_radius(&loaded.right_hand_side_radius());
    let half_spaces = HalfSpaces::of(&scaled, &radius);
    let rows = exponents.add(&scaled, contacts, half_spaces.as_ref().map_or(0, |spaces| spaces.exponent));
    let mut leaves = Leaves::new(loaded, Findings::new(&scaled, &options.limits), true);
    let mut log = ProofLog::new(LiftedSystem::new(loaded.view()), rows);
    let all_solutions = pattern_of_all_solutions((loaded, &scaled), &mut leaves, monitor);
    let left = all_solutions.and_then(|pattern| {
        let decision = leaves.decide(&pattern, monitor).ok()?;
        log.monotone(&pattern, &decision)
    });
    let (report, log) = match (left, half_spaces) {
        (None, Some(spaces)) => {
            let mut parts = Parts::new((loaded.view().centre, options), &mut leaves, monitor);
            let log = parts.prove(&spaces, log);
            (parts.report, log)
        }
        (left, _) => {
            let root = left.unwrap_or_else(|| all_states(&scaled));
            let tree = Tree::new((loaded, &scaled), None, &radius, options).logged(log);
            tree.run_from(root, (&mut leaves, monitor))
        }
    };
    if let Some(reason) = monitor.stopped() {
        return Err(NoProof::Stopped(reason));
    }
    let (text, cells) = log.and_then(ProofLog::into_text).ok_or(NoProof::Open)?;
    proof.text.push_str(&text);
    proof.cells.push(cells);
    proof.nodes += report.nodes;
    Ok(())
}

/// The powers of two by which the file multiplies the rows.
struct Exponents {
    of_contact: Vec<i32>,
    /// The contacts with a jump, with the exponents of their own rows.
    of_jump: Vec<(usize, i32)>,
}

impl Exponents {
    fn new(view: ProblemView<'_>) -> Self {
        let jumping = (0..view.contacts()).filter(|&contact| view.has_jump(contact));
        Self { of_contact: vec![0; view.contacts()], of_jump: jumping.map(|contact| (contact, 0)).collect() }
    }

    /// Takes those of a part, all of them greater by `more`, and returns them in its own order.
    fn add(&mut self, scaled: &ScaledProblem, contacts: &[usize], more: i32) -> Vec<i32> {
        let mut rows: Vec<i32> = scaled.row_exponents().iter().map(|exponent| exponent + more).collect();
        for (&contact, &exponent) in contacts.iter().zip(&rows) {
            self.of_contact[contact] = exponent;
        }
        for (_, exponent) in self.of_jump.iter_mut().filter(|(contact, _)| contacts.contains(contact)) {
            *exponent = scaled.load_exponent();
        }
        rows.extend(scaled.has_jump.iter().filter(|jump| **jump).map(|_| scaled.load_exponent()));
        rows
    }

    /// The first lines of the file.
    fn header(&self, parts: &[Vec<usize>], digest: u64) -> String {
        let mut text = "slideway proof 1\n".to_owned();
        let _ = writeln!(text, "problem {} {}", self.of_contact.len(), self.of_jump.len());
        let _ = writeln!(text, "digest {digest}");
        let exponents = self.of_contact.iter().chain(self.of_jump.iter().map(|(_, exponent)| exponent));
        if exponents.clone().any(|&exponent| exponent != 0) {
            let exponents: Vec<String> = exponents.map(ToString::to_string).collect();
            let _ = writeln!(text, "rows {}", exponents.join(" "));
        }
        if parts.len() > 1 || parts.iter().any(|part| !part.is_sorted()) {
            let group =
                |part: &Vec<usize>| part.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
            let _ = writeln!(text, "p {}", parts.iter().map(group).collect::<Vec<_>>().join(" / "));
        }
        text
    }
}
