//! Driven motion: the effort that each drive needs against friction, and where it grows without bound.
//!
//! The efforts `u` of the drives are affine in the friction forces, as are the normal forces (theory, section
//! 2). So they have one value in each solution, and grow without bound where the determinant of its mode
//! vanishes (section 6). With the velocity `w_i` at which an effort works, the power of all drives is
//! `P = sum_i u_i w_i`; `P_0` is that of the same motion without friction. The efficiency is
//!
//! ```text
//! P_0 / P      P_0 > 0, P > 0: the drives push; the share of their power that is not lost to friction
//! P / P_0      P_0 < 0, P < 0: the load pushes and the drives brake; the share of its power that reaches them
//! ```
//!
//! and has no value where friction holds what would otherwise push (`P_0 < 0`, `P >= 0`), or where nothing is
//! gained (`P_0 = 0`). Where some motions are not prescribed, they accelerate otherwise with friction than
//! without; the comparison is that of the same instant.
//!
//! ```
//! use slideway::drive::{DriveOptions, drive};
//! use slideway::model::Model;
//!
//! let drawer = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
//! let report = drive(&drawer, &DriveOptions::default())?;
//! // P = Q / (1 - 2 mu a / L)
//! let solution = &report.directions[0].solutions[0];
//! assert!((solution.efforts[0] - 20.0 / 0.55).abs() < 1e-9);
//! assert!((solution.efficiency.value.unwrap_or_default() - 0.55).abs() < 1e-12);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `drive` adds the efforts of drives to the mode problem as outputs (`solve::Parts`), so that each branch,
//! and its growth without bound, comes from the modes that `limits` finds. With friction in hinges each row is solved
//! by itself (`sampled.rs`). `peak.rs` finds where over a range an effort is greatest.

mod continuum;
mod course;
mod efforts;
mod peak;
mod report;
mod sampled;
mod state;
mod text;
mod words;

pub(crate) use efforts::Efforts;
pub use report::{
    Approach, BlowUp, Course, CourseDirection, CourseMode, CourseRow, DriveDirection, DriveName, DriveReport,
    DriveSolution, Efficiency, EfficiencyKind, EffortRange, Frictionless, HeldEffort, LockedRange,
    PeakEffort, SCHEMA, Sense, TipsOver,
};

use crate::fault::Faults;
use crate::limits::{VariedQuantity, Vary, range_around};
use crate::model::{Effort, Model};
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::{Report, finite};
use crate::solve::Stages;
use crate::standstill::{HoldOptions, hold_within};

/// The most rows of a table that are computed.
pub const GREATEST_ROWS: usize = 10_001;

/// Options of [`drive`]: over what the efforts are tabulated, if over anything.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DriveOptions {
    /// Over what the efforts are tabulated; the usual ranges are those of
    /// [`size`](crate::size::SizeOptions::vary).
    pub vary: Option<Vary>,
    /// Evenly spaced rows of the table, at least two.
    pub rows: usize,
}

impl Default for DriveOptions {
    /// No table; 11 rows if there is one.
    fn default() -> Self {
        Self { vary: None, rows: 11 }
    }
}

impl DriveOptions {
    /// With a table of the efforts over this.
    #[must_use]
    pub fn vary(mut self, vary: impl Into<Option<Vary>>) -> Self {
        self.vary = vary.into();
        self
    }

    /// With so many rows in the table.
    #[must_use]
    pub fn rows(mut self, rows: usize) -> Self {
        self.rows = rows;
        self
    }
}

/// The efforts of all drives in both directions of motion: with friction in every solution, and without.
///
/// # Errors
/// A model without drives; whatever `solve` refuses; of the table whatever [`crate::limits::limits`] refuses.
pub fn drive(model: &Model, options: &DriveOptions) -> Result<DriveReport, Faults> {
    undisturbed(|work| drive_of(model, options, work))
}

/// [`drive`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`drive`].
pub fn drive_with(
    model: &Model,
    options: &DriveOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<DriveReport>, Faults> {
    watched(callback, |work| drive_of(model, options, work))
}

fn drive_of(model: &Model, options: &DriveOptions, work: Work<'_>) -> Result<DriveReport, Faults> {
    model.has_drives()?;
    let reversed = model.reversed();
    let course = match &options.vary {
        Some(vary) => Some(course([model, &reversed], vary, options.rows, work.part(1, 2))?),
        None => None,
    };
    let drives = model.drives.iter().map(|drive| DriveName {
        name: drive.name.to_string(),
        unit: if matches!(drive.effort, Effort::Force { .. }) { "N" } else { "N m" },
    });
    let state = state::direction(model, Sense::Model, work.part(0, 4))?;
    let (mut directions, mut held) = (vec![state.direction], Vec::new());
    if state.is_at_rest {
        // Both directions are one; the efforts are known even where it is not which of them hold.
        held = with_which_it_holds(model, work.part(1, 4)).unwrap_or_default();
    } else {
        directions.push(state::direction(&reversed, Sense::Reversed, work.part(1, 4))?.direction);
    }
    let mut report = DriveReport {
        schema: SCHEMA,
        title: model.title.clone(),
        units: model.units.clone(),
        state: state.coordinates,
        drives: drives.collect(),
        directions,
        held,
        course,
        conclusion: Vec::new(),
    };
    report.suit_units();
    report.conclusion = words::conclusion(&report);
    finite(report)
}

/// With which efforts of each drive it stays at rest.
///
/// # Errors
/// Whatever [`hold`](crate::standstill::hold) refuses.
fn with_which_it_holds(model: &Model, work: Work<'_>) -> Result<Vec<HeldEffort>, Faults> {
    let of_drive = |drive: &crate::model::Drive| {
        let found = hold_within(model, &HoldOptions::default().load(&drive.name), work)?;
        let words = found.answer();
        let held = found.load.map_or_else(Vec::new, |load| load.held);
        Ok(HeldEffort { drive: drive.name.to_string(), held, words })
    };
    model.drives.iter().map(of_drive).collect()
}

fn course(
    [model, reversed]: [&Model; 2],
    vary: &Vary,
    rows: usize,
    work: Work<'_>,
) -> Result<Course, Faults> {
    // What stands still has no mode problem, either.
    let stands = Stages::of_any_model(model).is_ok_and(|stages| !stages.standing.is_empty());
    let one_by_one = stands || model.hinge_friction().next().is_some();
    let varied_in = |model: &Model| if one_by_one { vary.at_rest(model) } else { vary.of(model) };
    let direction = if one_by_one { sampled::direction } else { course::direction };
    let varied = varied_in(model)?;
    let range = vary.ends(&varied, || range_around(model, &varied))?;
    let opposite = varied_in(reversed)?;
    let steps = rows.clamp(2, GREATEST_ROWS) - 1;
    let (guarantee, forwards) = direction(&varied, (range, steps), Sense::Model, work.part(0, 2))?;
    let (_, backwards) = direction(&opposite, (range, steps), Sense::Reversed, work.part(1, 2))?;
    Ok(Course {
        vary: VariedQuantity::new(&varied, range, varied.present()?),
        directions: vec![forwards, backwards],
        sampled: guarantee.sampled,
        guarantee: guarantee.words,
        can_tip: model.has_guided_sliders(),
    })
}
