//! A stand-in for `shards.rs` where the package is built without Parquet files.

use crate::answer::Asked;
use crate::work::Watch;
use pyo3::exceptions::PyNotImplementedError;
use pyo3::prelude::*;
use slideway::sweep::{Shard, SweepOptions};
use std::path::{Path, PathBuf};

fn refused<T>() -> PyResult<T> {
    Err(PyNotImplementedError::new_err(
        "this slideway was built without the feature parquet, which shards need",
    ))
}

pub(crate) fn write_shard(
    _py: Python<'_>,
    _asked: (&str, &Asked),
    _question: (&SweepOptions, Shard),
    _written: (&Path, &Watch),
) -> PyResult<PathBuf> {
    refused()
}

#[doc = include_str!("../docs/merge.txt")]
#[pyfunction]
#[pyo3(signature = (_folder, *, time_limit = None, progress = None))]
pub(crate) fn merge(
    _folder: PathBuf,
    time_limit: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    Watch::new(time_limit, progress)?;
    refused()
}
