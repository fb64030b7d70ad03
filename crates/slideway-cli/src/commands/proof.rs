//! `--proof FILE`: why the listed solutions are all, for a checker that shares nothing with slideway.

use crate::failure::Failure;
use crate::files::Files;
use crate::output::{Output, complain};
use crate::watch::Watch;
use slideway::modes::{ModeProblem, SearchOptions, prove};
use slideway::raw_problem::exact_json;
use slideway_tables::{beside, quoted};
use std::path::{Path, PathBuf};

/// The files of a proof.
pub(super) struct ProofFiles {
    proof: Output,
    path: PathBuf,
    /// A problem that the checker does not read as it is given goes to a file of its own.
    problem: Option<(Output, PathBuf)>,
}

impl ProofFiles {
    /// Where the arguments want them; a problem that the checker does not read as it is given goes to a file of
    /// its own.
    ///
    /// # Errors
    /// As [`Files::beside`].
    pub(super) fn new(path: &Path, checker_reads: bool, files: &mut Files<'_>) -> Result<Self, Failure> {
        let proof = files.beside(path)?;
        let problem = if checker_reads {
            None
        } else {
            let path = beside(path, ".json");
            Some((files.beside(&path)?, path))
        };
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
            "note: the proof has {} {} and finds {} with a solution; in the folder of the source code this checks it: python3 reference/check_proof.py {} {}",
            proof.nodes,
            if proof.nodes == 1 { "node" } else { "nodes" },
            if proof.cells == [1] { "1 cell".to_owned() } else { format!("{} cells", cells.join(" x ")) },
            quoted(problem.as_os_str()),
            quoted(self.path.as_os_str())
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
