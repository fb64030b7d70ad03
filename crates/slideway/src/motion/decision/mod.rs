//! Decisions at events: which phases can follow, how long joints can stick, what a jam does (theory, section
//! 8).
//!
//! A phase is a state of every sliding joint, sticking or sliding one way or the other, and of every contact,
//! pressed to one side or in its preload gap. Joints without influence on one another are decided separately.
//! In each group of joints the states are tried, those in which most joints stick first; each is a system of
//! linear equations and inequalities:
//!
//! ```text
//! slides   F_k = (mu_k |N_k| + F_k0) s_k                s_k = sign of the sliding velocity, of the acceleration at rest
//! sticks   |F_k| <= mu_static_k |N_k| + F_k0            sliding acceleration s'' = 0
//! in both  |N_k| >= 0,  |C| <= |N| L/2 of guided sliders, 0 <= share <= 1 in a preload gap
//! ```
//!
//! Bodies may move while a joint sticks: its guide may move, and the equations hold the velocities' part of
//! the accelerations. Friction of joints that stick is statically indeterminate; it is enough that *some*
//! distribution is admissible, and the one that leaves most slack is told. Since that also decides on which
//! side a sticking contact is pressed, and nothing changes in the motion when it goes over to the other,
//! phases are told apart by the sides of the contacts that slide alone.
//!
//! # At a boundary
//! A normal force whose zero ends a phase is exactly zero: what the steps have left of it is taken off the
//! loads, so that a phase and its neighbour, in which the contact presses on the other side, satisfy the same
//! equations.
//!
//! Right after an event some slack is zero: a normal force at its change of side, the friction of a joint
//! that begins to slip, the acceleration of a joint that has just stopped. Such a phase counts only if the
//! slack grows from zero along the phase's own motion. This is decided by the first and then the second
//! derivative of the slack, from one short step of that motion, or two. (For one `y_k` and no jump it is the
//! rule that `p(sigma)` has the same sign on both sides; for several it solves the local mode problem among
//! them.)
//! Where both derivatives vanish the phase is kept and says so, [`Standing::Undecided`].
//!
//! # Accuracy
//! Slacks are in units of the greatest force (load, preload or inertia) on the bodies that joints connect
//! with one another (where there is none, of what the loads come to within the time in which they take them
//! through the size of the mechanism; within a motion of at least what counts as rounding beside its greatest
//! force), or of the acceleration that it gives the greatest of their masses. A slack below 1e-8 counts as
//! zero, one below -1e-8 as violated; derivatives count as zero below 1e-6 per unit of the time in which the
//! mechanism moves through its own length, second derivatives below 2e-3.
//!
//! # Files
//! `rules.rs` is what the simulation asks, `thorough.rs` who answers. `instant.rs` is a mechanism at one
//! instant, made of its sliding joints (`joints.rs`), how normal forces, sliding accelerations and couples
//! answer to friction with the groups of joints that are decided separately (`outputs.rs`), and their units
//! (`units.rs`); `mobility.rs` says which joints hold one another; `bounds.rs` is what is asked, with the
//! sides that contacts take whatever friction does; `system.rs` the equations of one pattern of sticking and
//! sliding joints of a group, `assessment.rs` the slacks of a phase, `growth.rs` whether they grow along its
//! motion. `parts.rs` has what each group can do, in order of preference, and `successors.rs` puts the parts
//! together; `sticking.rs`, `determined.rs` (normal forces that statics determines), `jam.rs` and `impact.rs`
//! (end stops), both on `impulse.rs`, are the other questions; `vanishing.rs` makes zero what an event has
//! found to be zero, `scale.rs` has the units where forces vanish, `sieve.rs` excludes patterns of sliding
//! fast, `holding.rs` looks ahead in time for what stands still while loads change, with forces that go
//! affinely with the loads (`plan.rs`).

mod assessment;
mod bounds;
mod determined;
mod elastic;
mod growth;
pub(super) mod holding;
mod impact;
mod impulse;
mod instant;
mod jam;
mod joints;
mod mobility;
mod outputs;
mod parts;
mod plan;
pub(super) mod rules;
mod scale;
mod sieve;
mod state;
mod sticking;
mod successors;
mod system;
pub(super) mod thorough;
mod units;
mod vanishing;

#[cfg(test)]
pub(super) use assessment::ASSESSED;
pub(super) use determined::determined_normal_forces;
pub use impact::{Blow, Impact, impact};
pub use jam::{Impulse, Jam, jam};
pub(super) use joints::TOUCHES;
pub use rules::Outlook;
pub use state::PhaseState;
pub use sticking::{Sticking, phase_state, sticking, sticking_margin};
pub(super) use successors::continuations;
pub use successors::{Successor, Successors, TippingPhase, successors};
pub(super) use units::scale_of_forces;

use crate::ids::{ContactId, JointId};

/// Slacks closer to zero than this are at the boundary.
const BOUNDARY: f64 = 1e-8;
/// Where so many states of a group were tried without finding one that can follow, it is refused.
const MOST_STATES: u64 = 100_000;

/// How a phase stands to what bounds it at the instant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Standing {
    /// Nothing is at a boundary.
    Inside,
    /// It starts at a boundary and moves away from it.
    Leaves(Vec<PhaseBound>),
    /// It stays at a boundary to second order, so that rounding would decide whether it lasts.
    Undecided(Vec<PhaseBound>),
}

/// What bounds a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PhaseBound {
    /// A normal force that is zero.
    NormalForce(ContactId),
    /// A share of the preload that is 0 or 1.
    PreloadShare(ContactId),
    /// The couple of a guided slider, given by its contact, beyond which it tips.
    Couple(ContactId),
    /// The friction of joints that stick.
    Sticking,
    /// The acceleration of a joint that begins to slip.
    Slip(JointId),
}
