//! The private module `_slideway` of the Python package `slideway`: the library's functions and reports, converted.
//!
//! What Python sees is in `python/slideway`: classes of the reports (`reports.py`, written from the sources of the
//! library), plots, and what notebooks show. The documentation of classes and functions here is in `docs`. Nothing is
//! computed here.
//!
//! # Files
//! `model` is the class `Model` with a method for each question, `arguments.rs` what they take, `work.rs` runs
//! them without the interpreter and ends them in time or on Ctrl-C, `answer.rs` holds what they return, `plot.rs` its
//! plots; `gallery.rs` has the models that are there, `mechanism` the builder `Mechanism`, `motion.rs` a motion with
//! its table, `pictures.rs` colours and pixels, `to_python.rs` turns values into objects, `fault.rs` faults into
//! exceptions, `import.rs` drawings into models to complete; `sweep.rs` has tables of many points, `shards.rs` those in
//! parts, `sweep_plot.rs` computes their plots, `modes.rs` problems given by matrices.

#![expect(
    clippy::doc_lazy_continuation,
    clippy::doc_link_with_quotes,
    reason = "the documentation is that of Python, in its form"
)]
#![expect(clippy::needless_pass_by_value, reason = "what Python passes is taken by value")]

mod answer;
mod arguments;
mod fault;
mod gallery;
mod import;
mod mechanism;
mod model;
mod modes;
mod motion;
mod pictures;
mod plot;
#[cfg(feature = "parquet")]
mod shards;
#[cfg(not(feature = "parquet"))]
#[path = "without_shards.rs"]
mod shards;
mod sweep;
mod sweep_plot;
mod to_python;
mod work;

/// The private half of the package; see `slideway`.
#[pyo3::pymodule(gil_used = false)]
mod _slideway {
    /// The fixed frame, where the name of a body is expected.
    #[pymodule_export]
    const GROUND: &str = crate::mechanism::GROUND;
    #[pymodule_export]
    use crate::answer::Answer;
    #[pymodule_export]
    use crate::gallery::{gallery_models, templates};
    #[pymodule_export]
    use crate::import::import_dxf;
    #[pymodule_export]
    use crate::mechanism::Mechanism;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::modes::matrices;
    #[pymodule_export]
    use crate::motion::Motion;
    #[pymodule_export]
    use crate::pictures::{png, printable, theme};
    #[pymodule_export]
    use crate::plot::Plot;
    #[pymodule_export]
    use crate::shards::merge;
    #[pymodule_export]
    use crate::sweep::Table;
    #[pymodule_export]
    use crate::to_python::frozen_array;
}
