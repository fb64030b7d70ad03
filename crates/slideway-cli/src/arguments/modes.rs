//! `slideway modes`

use super::{Destination, SearchArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

pub(super) const HELP: &str = "\
Types of problems and their arrays:
  lcp    M, q       w = M z + q, w >= 0, z >= 0, w_k z_k = 0
  ave    A, B, b    A x + B |x| = b
  hlcp   A, B, q    A w - B z = q, w >= 0, z >= 0, w_k z_k = 0
  modes  columns_positive, columns_negative, right_hand_side,
         optionally jumps_positive, jumps_negative

As JSON, with matrices as lists of rows:
  {\"type\": \"lcp\", \"M\": [[2, 1], [1, 2]], \"q\": [-1, 1]}
or as a NumPy archive, written by numpy.savez(\"problem.npz\", M=M, q=q).

Examples:
  slideway modes problem.json
  slideway modes problem.npz --output result.npz
  slideway modes problem.json --time-limit 30s --format json
  slideway modes problem.json --uniqueness
  slideway modes - < problem.json

Exit codes:
  0    solutions were found: one, several, infinitely many, or a state in a preload gap
  1    no solution, and the search was complete
  2    invalid input: the problem, the files or the arguments
  3    unknown: nothing was found, but the search was not complete
  130  interrupted (Ctrl-C): the solutions found so far are printed";

/// Arguments of `slideway modes`.
#[derive(Debug, Args)]
pub(crate) struct ModesArguments {
    /// The problem (JSON or .npz), or `-` for standard input.
    #[arg(value_name = "PROBLEM")]
    pub(crate) file: PathBuf,

    /// Form of the answer; by default that of the output file's extension (.json, .npz), else text.
    #[arg(long, value_enum)]
    format: Option<ModesFormat>,

    /// Also list what is part of a larger continuum: its ends and faces.
    #[arg(long)]
    pub(crate) all_faces: bool,

    /// Also decide whether there is exactly one solution for every right-hand side (of an LCP: whether M is a
    /// P-matrix).
    #[arg(long)]
    pub(crate) uniqueness: bool,

    #[command(flatten)]
    pub(crate) search: SearchArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

impl ModesArguments {
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
