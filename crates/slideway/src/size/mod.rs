//! Design: the value of a parameter at which a wanted margin against locking is just met.
//!
//! The margin against locking is the factor by which all kinetic coefficients of friction may grow before
//! there is no solution (`margins.no_solution` of [`mod@crate::solve`]), or something tips (`margins.tipping`). Where one of
//! both is so already, it is the factor to which they have to fall, below 1. Where less friction does that (`margins.below`)
//! there is none. At one value it is known in closed form
//! ([`crate::modes::existence`]); over a parameter it is bracketed. The margin against self-locking is the
//! factor by which all static coefficients may grow before a load is held however great it is; the margin of
//! holding is the inverse of that, or of the factor from which on all loads are held as they are: by how much friction may be
//! smaller.
//!
//! ```
//! use slideway::model::Model;
//! use slideway::limits::Vary;
//! use slideway::size::{SizeOptions, size};
//!
//! // A drawer jams at mu = L / (2 a): for a margin x it needs L = 2 a mu x.
//! let drawer = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
//! let report = size(&drawer, &SizeOptions::new(Vary::usual("L"), 2.0))?;
//! assert!((report.met[0].from - 2.0 * 0.3 * 0.3 * 2.0).abs() < 1e-14);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `size` asks for the margin at one value (`margin.rs`: `modes::existence` in motion, the threshold of
//! `standstill` at rest; `level.rs`: efforts, normal forces, bearing pressures and efficiency, whose margin
//! is how many times they keep their limit) and brackets it over what `limits::Varied` varies (`search.rs`).

mod answer;
mod level;
mod margin;
mod report;
mod search;
mod text;
mod words;

pub use report::{
    MarginKind, MetEnd, MetInterval, RangeWithoutPosition, SCHEMA, Sample, SampleKind, SizeReport,
};

use crate::choice::Choice;
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::{Vary, held_state, range_around};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use crate::solve::common_coefficient;
use crate::standstill::{HoldOptions, hold_within, only_load};
use crate::units::Unit;
use margin::{Margin, MarginQuestion};
use search::MarginSearch;

/// Steps of the evenly spaced values against locking.
const STEPS: usize = 500;
/// Steps of the evenly spaced values at rest, where each value takes linear programs.
const STEPS_AT_REST: usize = 100;

/// Against what there is to be a margin.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Against {
    /// Locking in motion: there is no solution, or something tips.
    Locking,
    /// Self-locking at rest: this load, or effort of a drive, is held however great it is.
    SelfLocking {
        /// Name of the load or drive.
        load: String,
    },
    /// The opposite wish: it is to be held under its loads.
    Hold {
        /// Name of the load or drive that is to be held however great it is; without one, all loads as they are.
        load: Option<String>,
    },
    /// The greatest effort of this drive, or of all, in any solution; without a solution it is exceeded.
    Effort {
        /// Name of the drive.
        drive: Option<String>,
    },
    /// The greatest normal force of this contact, or of all, in any solution; without a solution it is
    /// exceeded.
    NormalForce {
        /// Name of the contact.
        contact: Option<String>,
    },
    /// The greatest bearing pressure of this contact, or of all that have a pad, in any solution; without a
    /// solution it is exceeded.
    Pressure {
        /// Name of the contact.
        contact: Option<String>,
    },
    /// The least efficiency of the drives in any solution; without a solution it is not reached.
    Efficiency,
}

/// A factor on friction that can be wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum FrictionMargin {
    /// [`Against::Locking`].
    #[default]
    Locking,
    /// [`Against::SelfLocking`].
    SelfLocking,
    /// [`Against::Hold`].
    Hold,
}

impl Choice for FrictionMargin {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Locking, "locking", "Locking in motion"),
        (Self::SelfLocking, "self-locking", "Self-locking at rest under the load"),
        (
            Self::Hold,
            "hold",
            "Slipping at rest: the loads must be held, or with --load one however great it is",
        ),
    ];
}

impl Against {
    /// This margin, at rest under a load: that of self-locking by default the only one, that of holding all of them as they are.
    ///
    /// # Errors
    /// A margin at rest without a load where the model has several, one of motion with a load.
    pub fn margin(margin: FrictionMargin, load: Option<String>, model: &Model) -> Result<Self, Faults> {
        match (margin, load) {
            (FrictionMargin::Locking, None) => Ok(Self::Locking),
            (FrictionMargin::Locking, Some(load)) => {
                Err(Fault::general(FaultKind::LoadUnused { load }).into())
            }
            (FrictionMargin::SelfLocking, Some(load)) => Ok(Self::SelfLocking { load }),
            (FrictionMargin::SelfLocking, None) => Ok(Self::SelfLocking { load: only_load(model)? }),
            (FrictionMargin::Hold, load) => Ok(Self::Hold { load }),
        }
    }

    /// The efficiency, which concerns no load.
    ///
    /// # Errors
    /// If one is given.
    pub fn efficiency(load: Option<String>) -> Result<Self, Faults> {
        match load {
            None => Ok(Self::Efficiency),
            Some(load) => Err(Fault::general(FaultKind::LoadUnused { load }).into()),
        }
    }

    /// Whether it is a limit of a force or of the efficiency rather than a factor of friction.
    pub(crate) fn is_limit(&self) -> bool {
        matches!(
            self,
            Self::Effort { .. } | Self::NormalForce { .. } | Self::Pressure { .. } | Self::Efficiency
        )
    }

    /// Whether it concerns rest.
    fn is_at_rest(&self) -> bool {
        matches!(self, Self::SelfLocking { .. } | Self::Hold { .. })
    }
}

/// Options of a design: the quantity to be sized, and the wanted margin.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SizeOptions {
    /// Quantity that is varied. Usual ranges: the factor of friction from 0 to 10, a coefficient of friction
    /// from 0 to twice its value, but at least to 1, and both to twice the friction at which the number of
    /// solutions is known to change if that lies beyond; a parameter that was typed as an angle the quarter
    /// turn in which it stands, any other parameter that is not zero from a fifth of its value to five times
    /// it.
    pub vary: Vary,
    /// The wanted margin, positive: a factor of friction. Against an effort, normal force or bearing pressure
    /// the greatest that is allowed (N, N m or Pa), against the efficiency the least.
    pub margin: f64,
    /// Against what.
    pub against: Against,
    /// Whether motion in the opposite direction counts, too: the smaller margin of both.
    pub both_directions: bool,
    /// The unit in which the limit was typed, which texts show it in; without, that of the model.
    pub typed_in: Option<Unit>,
}

impl SizeOptions {
    /// A margin against locking in the direction of the model.
    pub fn new(vary: Vary, margin: f64) -> Self {
        Self { vary, margin, against: Against::Locking, both_directions: false, typed_in: None }
    }

    /// A margin against something else.
    #[must_use]
    pub fn against(mut self, against: Against) -> Self {
        self.against = against;
        self
    }

    /// Whether it is the smaller margin of both directions of motion.
    #[must_use]
    pub fn both_directions(mut self, both: bool) -> Self {
        self.both_directions = both;
        self
    }

    /// The unit in which the limit was typed.
    #[must_use]
    pub fn typed_in(mut self, unit: Option<Unit>) -> Self {
        self.typed_in = unit;
        self
    }
}

/// The values of a parameter at which a wanted margin is just met, and the intervals in which it is met.
///
/// Evenly spaced values are tried, and what changes between them is bisected to neighbouring floating-point
/// numbers; dips and humps between them are followed to their extremum. The report says what such a search
/// can miss.
///
/// # Errors
/// An unknown name, a range that is empty, reversed, or needed and absent; a load that is unknown or zero;
/// a drive, contact or pad that the limit needs and the model does not have; too many contact modes or states
/// at rest. Values at which the mechanism cannot be assembled or solved are no error but part of the report.
pub fn size(model: &Model, options: &SizeOptions) -> Result<SizeReport, Faults> {
    undisturbed(|work| size_of(model, options, work))
}

/// [`size`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`size`].
pub fn size_with(
    model: &Model,
    options: &SizeOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<SizeReport>, Faults> {
    watched(callback, |work| size_of(model, options, work))
}

fn size_of(model: &Model, options: &SizeOptions, work: Work<'_>) -> Result<SizeReport, Faults> {
    let at_rest = options.against.is_at_rest();
    if at_rest && options.both_directions {
        return Err(Fault::general(FaultKind::NoDirectionAtRest).into());
    }
    let varied = options.vary.of(model)?;
    let range = options.vary.ends(&varied, || range_around(model, &varied))?;
    let opposite = if options.both_directions { Some(options.vary.of(&model.reversed())?) } else { None };
    if matches!(options.against, Against::Effort { .. } | Against::Efficiency) {
        model.has_drives()?;
    }
    if let Against::Pressure { contact } = &options.against {
        pad_of(model, contact.as_deref())?;
    }
    let unit = answer::unit(model, &options.against);
    if let Some(typed) = options.typed_in.as_ref().filter(|typed| typed.si() != unit) {
        let typed = typed.name().to_owned();
        return Err(Fault::general(FaultKind::LimitUnit { typed, wanted: unit }).into());
    }
    let question = MarginQuestion {
        varied: &varied,
        reversed: opposite.as_ref(),
        against: &options.against,
        limit: options.margin,
    };
    let value = varied.present()?;
    if options.against == Against::Locking {
        varied.check_none_stands(value, "a safety factor against jamming")?;
    }
    let present = present(&question, value, work.part(0, 2))?;
    let steps = if at_rest { STEPS_AT_REST } else { STEPS };
    let wanted = if options.against.is_limit() { 1.0 } else { options.margin };
    let tipping = question.tipping(value, work);
    let tips = question.tips(value, work);
    let wedged = present.and_then(|by_itself| question.wedged(value, by_itself, work));
    let gently = wedged.is_some() && options.against == Against::Hold { load: None } && {
        hold_within(model, &HoldOptions::default(), work)?.falls_freely()
    };
    let found = MarginSearch { question: &question, wanted, range, steps, work }.run();
    if found.places.iter().all(|place| place.margin.is_none()) {
        // Nowhere an answer: the faults in the middle say why.
        question.margin(f64::midpoint(range[0], range[1]), work)?;
    }
    let mechanism = Mechanism::new(model)?;
    let (state, may_tip) = (held_state(&mechanism, &varied, range), mechanism.may_tip());
    let sought = answer::Sought {
        question,
        range,
        steps,
        value,
        present,
        tipping,
        tips,
        mu: common_coefficient(&mechanism),
        may_tip,
        wedged,
        gently,
        found,
    };
    finite(answer::report(model, state, options, &sought))
}

/// # Errors
/// No contact has a pad, or the named one has none; an unknown name is a fault of the level.
fn pad_of(model: &Model, named: Option<&str>) -> Result<(), Faults> {
    let mut contacts =
        model.contacts().filter(|contact| named.is_none_or(|name| *contact.name == *name)).peekable();
    let Some(first) = contacts.peek().map(|contact| contact.name.to_string()) else {
        let without = FaultKind::NoPad { contact: None, joint: None };
        return if named.is_some() { Ok(()) } else { Err(Fault::general(without).into()) };
    };
    if contacts.any(|contact| contact.pad.is_some()) {
        return Ok(());
    }
    let joint = first.split('.').next().map(str::to_owned);
    Err(Fault::general(FaultKind::NoPad { contact: named.map(str::to_owned), joint }).into())
}

/// The margin in the model; nothing where it has no position, which other values may have.
fn present(question: &MarginQuestion<'_>, value: f64, work: Work<'_>) -> Result<Option<Margin>, Faults> {
    let everywhere = |fault: &&Fault| {
        matches!(
            fault.kind,
            FaultKind::UnknownName { .. }
                | FaultKind::NoLoadAtRest { .. }
                | FaultKind::TooManyStates { .. }
                | FaultKind::TooManyModes { .. }
                | FaultKind::TooManyContacts { .. }
        )
    };
    match question.margin(value, work) {
        Ok(margin) => Ok(Some(margin)),
        Err(faults) if faults.sorted().iter().any(everywhere) => Err(faults),
        Err(_) => Ok(None),
    }
}
