//! Tables of slideway's sweeps as files.
//!
//! [`slideway::sweep::Sweep`] gives rows; this crate writes them: as comma-separated values, NumPy archives,
//! and, with the feature `parquet`, Parquet files. It knows no arguments and prints nothing, so that every
//! interface writes the same bytes.
//!
//! [`write_table`] computes a sweep and writes its table. A table is written bit by bit to `FILE.partial` and
//! gets its name when it is whole ([`PartialFile`]); an interrupted one can be continued. What else is made of
//! numbers and texts takes [`npz`] and `parquet`.
//!
//! # Shards
//! A sweep may be computed in shards, each by a process or machine of its own: `write_shard` writes one into
//! a folder, `written_shard` says whether it is there, `Shards::find` finds all of them, and
//! [`write_table`] merges them from `RowSource::Shards`. The merged table is that of the whole sweep, byte for
//! byte, if it tells the same command of itself.
//!
//! # Files
//! `writing.rs` leads rows into a table, `partial.rs` is that table until it is whole; `encoder.rs` makes bytes
//! of rows, with `csv.rs` or `record.rs`, from whose records `npz.rs` and `parquet/` make files. `shard.rs` is
//! what a shard tells of itself, `shards.rs` the folder of all; `parquet/reader.rs` reads their rows,
//! `parquet/seal.rs` tells whether they are what was written. `identity.rs` tells files apart. `command.rs` is the command line of a sweep, `arrow.rs`
//! its rows as columns in memory.
//!
//! # Features
//! - `parquet`: Parquet files, and shards. Its library takes long to build.
//! - `arrow`: tables as Apache Arrow, for data frames in the same process.

#![forbid(unsafe_code)]

#[cfg(feature = "arrow")]
pub mod arrow;
mod command;
mod csv;
mod encoder;
mod error;
mod format;
mod identity;
mod layout;
mod metadata;
pub mod npz;
#[cfg(feature = "parquet")]
pub mod parquet;
mod partial;
mod record;
mod shard;
#[cfg(feature = "parquet")]
mod shards;
mod writing;

pub use command::quoted;
pub use encoder::Encoder;
pub use error::{Difference, Reason, TableError};
pub use format::TableFormat;
pub use identity::FileIdentity;
pub use layout::Layout;
pub use metadata::Metadata;
pub use partial::{Continued, PARTIAL, PartialFile, Resume, beside, unfinished};
pub use shard::{Manifest, Part, ShardedSweep, shard_path};
#[cfg(feature = "parquet")]
pub use shards::{Shards, write_shard, written_shard};
pub use writing::{Control, RowSource, Take, Written, write_table};
