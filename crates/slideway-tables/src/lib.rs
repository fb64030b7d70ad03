//! Tables of slideway's sweeps as files.
//!
//! [`slideway::sweep::Sweep`] gives rows; this crate writes them: as comma-separated values, NumPy archives,
//! and, with the feature `parquet`, Parquet files. It knows no arguments and prints nothing, so that every
//! interface writes the same bytes.
//!
//! A table is written bit by bit to `FILE.partial` and gets its name when it is whole ([`PartialFile`]); an
//! interrupted one can be continued. What else is made of numbers and texts takes [`npz`] and [`parquet`].
//!
//! # Features
//! - `parquet`: Parquet files. Its library takes long to build.
//! - `arrow`: tables as Apache Arrow, for data frames in the same process.

#[cfg(feature = "arrow")]
pub mod arrow;
mod csv;
mod encoder;
mod error;
mod format;
mod layout;
mod metadata;
pub mod npz;
#[cfg(feature = "parquet")]
pub mod parquet;
mod partial;
mod record;

pub use encoder::Encoder;
pub use error::{Reason, TableError};
pub use format::TableFormat;
pub use layout::Layout;
pub use metadata::Metadata;
pub use partial::{Continued, PARTIAL, PartialFile, beside, unfinished};
