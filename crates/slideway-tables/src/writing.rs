//! Rows into tables: computed, or from shards.

#[cfg(feature = "parquet")]
use crate::Shards;
use crate::{Continued, Encoder, PartialFile, Resume, TableError};
use slideway::progress::{Callback, Progress};
use slideway::sweep::{Rows, Sweep, SweepState};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Where the rows of a table come from.
#[derive(Debug, Clone, Copy)]
pub enum RowSource<'s> {
    /// They are computed.
    Sweep(&'s Sweep),
    /// They are read from the shards of a sweep.
    #[cfg(feature = "parquet")]
    Shards(&'s Shards),
}

/// Takes what was made of rows, with the state behind them, and says whether to go on.
pub type Take<'t, E> = dyn FnMut(Vec<E>, &SweepState) -> ControlFlow<()> + Send + 't;

impl<'s> RowSource<'s> {
    /// The sweep whose rows they are.
    pub fn sweep(self) -> &'s Sweep {
        match self {
            Self::Sweep(sweep) => sweep,
            #[cfg(feature = "parquet")]
            Self::Shards(shards) => shards.sweep(),
        }
    }

    /// Gives the rows behind a state, as [`Sweep::run_while`] does.
    ///
    /// # Errors
    /// If a shard cannot be read.
    pub fn run_while<E: Send>(
        self,
        goes_on: &(dyn Fn() -> bool + Sync),
        state: &mut SweepState,
        encode: &(dyn Fn(&Rows) -> E + Sync),
        take: &mut Take<'_, E>,
    ) -> Result<(), TableError> {
        match self {
            Self::Sweep(sweep) => {
                sweep.run_while(goes_on, state, encode, take);
                Ok(())
            }
            #[cfg(feature = "parquet")]
            Self::Shards(shards) => shards.run_while(goes_on, state, encode, take),
        }
    }
}

/// How a table came out.
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// It is whole, and comes to this.
    Whole(SweepState),
    /// It was ended early. What is done is kept, to be continued.
    Early {
        /// The part that is done.
        state: SweepState,
        /// Where it is kept.
        path: PathBuf,
    },
}

/// The means to end the writing of a table, and to hear of its progress.
pub struct Control<'w> {
    /// Asked by any thread: whether the work goes on.
    pub goes_on: &'w (dyn Fn() -> bool + Sync),
    /// Told of the progress; breaks to end the work.
    pub callback: &'w mut Callback<'w>,
}

/// Writes the table of a whole sweep, to a file: beside it until
/// it is whole. The bytes depend on the sweep and on what the encoder tells of it alone.
///
/// # Errors
/// If files cannot be read or written; if something is in the way and must not be overwritten.
pub fn write_table(
    source: RowSource<'_>,
    encoder: Encoder,
    (path, resume, overwrite): (&Path, Resume, bool),
    control: &mut Control<'_>,
) -> Result<Written, TableError> {
    let start = source.sweep().start();
    let continued = PartialFile::open(path, encoder, (resume, overwrite), start)?;
    continued.fill(source, control, &|_| (), &mut |()| ())
}

impl Continued {
    /// Writes the rows that are not there yet, and completes the table. `also` makes something else of rows,
    /// in parallel, and `take` gets that in their order.
    ///
    /// # Errors
    /// If files cannot be read or written; if a file with the name of the table has appeared meanwhile.
    pub fn fill<E: Send>(
        self,
        source: RowSource<'_>,
        control: &mut Control<'_>,
        also: &(dyn Fn(&Rows) -> E + Sync),
        take: &mut (dyn FnMut(E) + Send),
    ) -> Result<Written, TableError> {
        let Self { mut file, mut state } = self;
        let points = source.sweep().points();
        let encoder = file.encoder().clone();
        let encode = |rows: &Rows| (encoder.rows(rows), also(rows));
        let mut failure = None;
        source.run_while(control.goes_on, &mut state, &encode, &mut |parts, state| {
            let (rows, parts): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
            parts.into_iter().for_each(&mut *take);
            if let Err(error) = file.add(&rows, state) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
            (control.callback)(&Progress::of("points", state.done, points))
        })?;
        if let Some(failure) = failure {
            return Err(failure);
        }
        let mut follow = |part: f64| {
            (control.callback)(&Progress { fraction: Some(part), ..Progress::of("points", points, points) })
        };
        if state.done < points || file.complete(&state, &mut follow)?.is_break() {
            file.keep(&state)?;
            return Ok(Written::Early { path: file.path(), state });
        }
        Ok(Written::Whole(state))
    }
}
