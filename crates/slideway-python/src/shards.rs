//! Shards of a sweep in a folder, as the command line writes them, and their merging.

use crate::answer::Asked;
use crate::fault::Texts;
use crate::sweep::{Table, os_error, unfinished};
use crate::sweep_plot::prepared;
use crate::work::Watch;
use pyo3::prelude::*;
use slideway::Model;
use slideway::progress::Progress;
use slideway::sweep::{Shard, SweepOptions};
use slideway_tables::{Control, RowSource, ShardedSweep, Shards, Written, shard_path};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Computes a shard of a sweep and writes it into a folder, unless it is there; its path.
pub(crate) fn write_shard(
    py: Python<'_>,
    (file, asked): (&str, &Asked),
    (options, shard): (&SweepOptions, Shard),
    (folder, watch): (&Path, &Watch),
) -> PyResult<PathBuf> {
    let otherwise = "slideway for Python: Model.write_shard";
    let sharded = ShardedSweep::typed((file, &asked.text), (&asked.settings, options), otherwise);
    let is_there =
        slideway_tables::written_shard(&sharded, shard, folder).map_err(|error| os_error(&error))?;
    if is_there.is_none() {
        let whole = prepared(py, asked, &sharded.options, watch)?;
        let written = watch.run_beside(py, |callback| {
            let mut callback = |progress: &Progress| callback(progress);
            let mut control = Control { goes_on: &|| true, callback: &mut callback };
            slideway_tables::write_shard(&sharded, (&whole, shard), (folder, false), &mut control)
        })?;
        if let Written::Early { state, .. } = written.so_far().map_err(|error| os_error(&error))? {
            return Err(unfinished(&state, whole.shard(shard).points()));
        }
    }
    Ok(shard_path(folder, shard))
}

#[doc = include_str!("../docs/merge.txt")]
#[pyfunction]
#[pyo3(signature = (folder, *, time_limit = None, progress: "Progress | None" = None) -> "_sweep.Sweep")]
pub(crate) fn merge(
    py: Python<'_>,
    folder: PathBuf,
    time_limit: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'_, PyAny>> {
    let watch = Watch::new(time_limit, progress)?;
    let found = watch.run_beside(py, |callback| Shards::find(&folder, callback).transpose())?;
    let shards = found.whole()?.map_err(|error| os_error(&error))?;
    let ShardedSweep { metadata, settings, options } = shards.sharded();
    let model = Model::parse(&metadata.model).and_then(|model| model.with(settings));
    let refused = |faults| Texts { model: &metadata.model, settings }.error(py, &faults);
    let (text, settings) = (Arc::from(&*metadata.model), settings.clone());
    let asked = Asked { model: Arc::new(model.map_err(refused)?), text, settings };
    Table::of(py, (RowSource::Shards(&shards), asked, options.clone()), &watch)?.object(py)
}
