//! `--proof FILE`: why the listed solutions are all, for a checker that shares nothing with slideway.

use crate::arguments::Destination;
use crate::failure::Failure;
use crate::output::{Output, complain};
use crate::watch::Watch;
use slideway::modes::{ModeProblem, SearchOptions, prove};
use slideway::raw_problem::exact_json;
use std::path::{Path, PathBuf};

/// The files of a proof.
pub(super) struct ProofFiles {
    proof: Output,
    path: PathBuf,
    /// A problem that the checker does not read as it is given goes to a file of its own.
    problem: Option<(Output, PathBuf)>,
}

impl ProofFiles {
    /// Where the arguments want them; `given` is the problem's file if the checker reads it.
    ///
    /// # Errors
    /// If a file exists and must not be overwritten: better said before the work than after it.
    pub(super) fn new(
        path: &Path,
        given: Option<&Path>,
        (destination, output): (&Destination, &Output),
    ) -> Result<Self, Failure> {
        let proof = output.to(&destination.beside(path), given)?;
        let mut problem = None;
        if given.is_none() {
            let mut name = path.as_os_str().to_owned();
            name.push(".json");
            let path = PathBuf::from(name);
            problem = Some((output.to(&destination.beside(&path), None)?, path));
        }
        Ok(Self { proof, path: path.to_owned(), problem })
    }

    /// Searches the solutions of a problem once more, and writes every step.
    ///
    /// # Errors
    /// If the search ended early, or a step cannot be written.
    pub(super) fn write(
        &self,
        problem: &ModeProblem,
        given: &Path,
        options: &SearchOptions,
        watch: &mut Watch,
    ) -> Result<(), Failure> {
        let no_proof = |reason: String| Failure::NoProof { reason };
        if let Some((file, _)) = &self.problem {
            file.write(&text_of(problem)?)?;
        }
        let proof = prove(problem, options, &mut |progress| watch.look(progress))
            .map_err(|fault| no_proof(fault.to_string()))?;
        self.proof.write(&proof.text)?;
        let problem = self.problem.as_ref().map_or(given, |(_, path)| path.as_path());
        let cells: Vec<String> = proof.cells.iter().map(ToString::to_string).collect();
        let note = format!(
            "note: proof of {} in {} {}; to check it: python3 reference/check_proof.py {} {}",
            if proof.cells == [1] { "1 cell".to_owned() } else { format!("{} cells", cells.join(" x ")) },
            proof.nodes,
            if proof.nodes == 1 { "node" } else { "nodes" },
            problem.display(),
            self.path.display()
        );
        complain(&note, self.proof.color());
        Ok(())
    }
}

/// The problem as a file.
///
/// # Errors
/// If no file holds its numbers.
pub(super) fn text_of(problem: &ModeProblem) -> Result<String, Failure> {
    let reason = || "some numbers are sums that no file holds exactly".to_owned();
    exact_json(problem).ok_or_else(|| Failure::NoProof { reason: reason() })
}
