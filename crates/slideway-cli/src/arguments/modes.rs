//! `slideway modes`

use super::{Destination, SearchArguments};
use clap::builder::ArgPredicate;
use clap::{Args, ValueEnum};
use slideway::modes::SearchOptions;
use std::path::PathBuf;
use std::time::Duration;

pub(super) const HELP: &str = "\
Types of problems and their arrays:
  lcp    M, q       w = M z + q, w >= 0, z >= 0, w_k z_k = 0
  ave    A, B, b    A x + B |x| = b
  block_ave  B, b, blocks, perhaps A
                    A x + B |x| = b, |x| the lengths of blocks of one or two
                    components, whose sizes are in blocks; without A, A = I
  hlcp   A, B, q    A w - B z = q, w >= 0, z >= 0, w_k z_k = 0
  mlcp   A, B, C, D, a, b
                    A u + C z + a = 0, w = D u + B z + b, w >= 0, z >= 0,
                    w_k z_k = 0; u is free
  mcp    M, q, l, u w = M z + q, l <= z <= u, w_k >= 0 where z_k < u_k,
                    w_k <= 0 where z_k > l_k; null in l or u: no bound
  game   A, perhaps B
                    all Nash equilibria: x maximises x^T A y, y maximises
                    x^T B y; without B, B = -A. The type must be given.
  modes  columns_positive, columns_negative, right_hand_side,
         optionally jumps_positive, jumps_negative

As JSON, with matrices as lists of rows:
  {\"type\": \"lcp\", \"M\": [[2, 1], [1, 2]], \"q\": [-1, 1]}
or as a NumPy archive, written by numpy.savez(\"problem.npz\", M=M, q=q).
At most 2000 unknowns, of which mcp counts those with two bounds twice, and 64 MB.
Matrices are dense: zeros are stored, and take time.

Examples:
  slideway modes problem.json
  slideway modes problem.npz --output result.npz
  slideway modes problem.json --time-limit 30s --format json
  slideway modes problem.json --uniqueness
  slideway modes problem.json --count-only
  slideway modes problem.json --proof proof.txt
  slideway modes problem.json --stream | head -n 1
  slideway modes - < problem.json
  slideway modes --json-lines < problems.jsonl > answers.jsonl

Exit codes:
  0    solutions were found: one, several, infinitely many, or a state in a
       preload gap
  1    no solution, and the search was complete
  2    invalid input: the problem (with --json-lines: of some line), the files
       or the arguments
  3    unknown: nothing was found, but the search was not complete
  130  interrupted (Ctrl-C): the solutions found so far are printed";

/// Arguments of `slideway modes`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "switches of the command line")]
pub(crate) struct ModesArguments {
    /// The problem (JSON or .npz), or `-` for standard input. --json-lines reads standard input if it is omitted.
    #[arg(
        value_name = "PROBLEM",
        required = false,
        required_unless_present = "json_lines",
        default_value_if("json_lines", ArgPredicate::IsPresent, "-")
    )]
    pub(crate) file: PathBuf,

    /// Form of the answer; by default that of the output file's extension (.json, .npz), else text.
    #[arg(long, value_enum)]
    format: Option<ModesFormat>,

    /// Also decide whether there is exactly one solution for every right-hand side (of an LCP: whether M is a
    /// P-matrix).
    #[arg(long)]
    pub(crate) uniqueness: bool,

    /// Count the solutions without listing them.
    #[arg(long, conflicts_with = "max_solutions")]
    count_only: bool,

    /// One solution is enough: end the search at the first. Whether there are others is then not known.
    #[arg(long, conflicts_with = "max_found")]
    any: bool,

    /// Read a problem as JSON from each line, and write each answer as JSON in one line, in the same order. If a line
    /// is no problem, the answer has its number and what is wrong with it. A time limit is for each problem.
    #[arg(long, conflicts_with_all = ["format", "output"])]
    pub(crate) json_lines: bool,

    /// Write each solution as JSON in one line as soon as it is certain. The last line has the counts and says whether
    /// they are complete. What is written stays true, whatever ends the search. A set of solutions may contain
    /// solutions that were written before it; the last line says which. If the unknowns are searched in several
    /// groups, their combinations are written after the search; once time is up, at most --max-solutions of them.
    #[arg(long, conflicts_with_all = ["format", "output", "json_lines", "count_only", "proof"])]
    pub(crate) stream: bool,

    /// Also write a proof that there are no other solutions. reference/check_proof.py checks it in exact arithmetic. If
    /// that program does not read problems of this type, FILE.json has the equivalent mode problem.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["json_lines", "any"])]
    pub(crate) proof: Option<PathBuf>,

    #[command(flatten)]
    search: SearchArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

impl ModesArguments {
    /// How the search is to be done.
    pub(crate) fn options(&self) -> SearchOptions {
        if self.any { self.search.options_for_one() } else { self.search.options() }
    }

    /// The maximum number of entries in each list; of a stream, of vertices and directions.
    pub(crate) fn most_listed(&self) -> usize {
        if self.count_only { 0 } else { self.search.max_solutions }
    }

    /// The time for one problem.
    pub(crate) fn time_limit(&self) -> Option<Duration> {
        self.search.time.time_limit
    }

    /// The form that is asked for.
    pub(crate) fn format(&self) -> ModesFormat {
        let ending = self.destination.output.as_ref().and_then(|path| path.extension()?.to_str());
        self.format.unwrap_or(match ending.map(str::to_lowercase).as_deref() {
            Some("json") => ModesFormat::Json,
            Some("npz") => ModesFormat::Npz,
            _ => ModesFormat::Text,
        })
    }
}

/// Form of the answer to a problem given by matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ModesFormat {
    /// Words and aligned numbers, for people.
    Text,
    /// The whole report, for programs.
    Json,
    /// A NumPy archive.
    Npz,
}
