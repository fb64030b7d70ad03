//! Decisions at events: which phases can follow, how long joints can stick, what a jam does (theory, section
//! 8).
//!
//! A phase is a state of every sliding joint, sticking or sliding in one of two directions, of every contact,
//! pressed to one side or in its preload gap, and of every hinge with friction, sticking or turning in one of two
//! directions. Joints without influence on one another are decided separately. In each group of joints, the states are
//! tried in turn, those with most joints sticking first; each is a system of linear equations and inequalities:
//!
//! ```text
//! slides   F_k = (mu_k |N_k| + F_k0) s_k                s_k = sign of the sliding velocity, of the acceleration at rest
//! sticks   |F_k| <= mu_static_k |N_k| + F_k0            sliding acceleration s'' = 0
//! in both  |N_k| >= 0,  |C| <= |N| L/2 of guided sliders, 0 <= share <= 1 in a preload gap
//! turns    K_j = -r_j s_j t_j.R_j of a hinge, with the direction t_j of its force R_j, so that t_j.R_j = |R_j|
//! sticks   |K_j| <= r_static_j |R_j|      angular acceleration of the hinge = 0
//! ```
//!
//! Bodies may move while a joint sticks: its guide may move, and the equations contain the part of the
//! accelerations that comes from velocities. The friction of sticking joints is statically indeterminate. It
//! suffices that *some* distribution is admissible, and the one that leaves the most slack is reported. Since
//! that also decides to which side a sticking contact is pressed, and nothing in the motion changes when it
//! moves to the other side, phases are distinguished only by the sides of the sliding contacts.
//!
//! # At a boundary
//! A normal force whose zero ends a phase is made exactly zero: the remainder that the steps leave is
//! subtracted from the loads, so that a phase and its neighbour, in which the contact presses on the other
//! side, satisfy the same equations.
//!
//! Right after an event, some slack is zero: a normal force at its change of side, the friction of a joint
//! that begins to slip, the acceleration of a joint that has just stopped. Such a phase counts only if the
//! slack grows from zero along the phase's own motion. This is decided by the first and then the second
//! derivative of the slack, from one or two short steps of that motion. (For one `y_k` and no jump this is
//! the rule that `p(sigma)` has the same sign on both sides; for several it solves the local mode problem
//! among them.) If both derivatives vanish, the phase is kept and marked as [`Standing::Undecided`].
//!
//! # Accuracy
//! Slacks are in units of the greatest force (load, preload or inertia) on the bodies that joints connect
//! with one another, or of the acceleration that it gives the greatest of their masses. Where there is no
//! such force, the unit is the force that the loads reach within the time in which they take the mechanism
//! through its own size; within a motion, it is at least what counts as rounding beside its greatest force. A
//! slack below 1e-8 counts as zero, one below -1e-8 as violated; derivatives count as zero below 1e-6 per
//! unit of the time in which the bodies move through the length of the mechanism, second derivatives below 2e-3. Bodies that
//! have nothing to do with one another have each their own units and their own time, so that none changes what is decided of
//! another.
//!
//! # Files
//! `rules.rs` defines what the simulation asks, `thorough.rs` answers. `instant.rs` is a mechanism at one
//! instant: its sliding joints (`joints.rs`), how normal forces, sliding accelerations and couples respond to
//! friction, with the groups of joints that are decided separately (`outputs.rs`), and their units
//! (`units.rs`). `mobility.rs` determines which joints hold one another, and `bounds.rs` the question, with
//! the sides that contacts take whatever friction does. `system.rs` contains the equations of one pattern of
//! sticking and sliding joints of a group, `assessment.rs` the slacks of a phase, and `growth.rs` whether
//! they grow along its motion. `parts.rs` lists what each group can do, in order of preference, and
//! `successors.rs` combines the parts. The other questions are in `sticking.rs`, `determined.rs` (normal
//! forces that statics determines), `jam.rs` and `impact/` (end stops, faces); the last two are based on
//! `impulse.rs`. `vanishing.rs` sets to zero what an event has found to be zero, `scale.rs` provides the
//! units where forces vanish, `sieve.rs` quickly excludes patterns of sliding, and `holding.rs` looks ahead
//! in time for bodies that stand still while loads change, with forces that are affine in the loads
//! (`plan.rs`). `lifting.rs` tries which contacts that may lift off are open, each time with the mechanism as it touches then. Hinges with friction are members of the groups like sliding joints. The magnitudes of their forces enter,
//! so that the equations of a pattern in which some turn are not linear and may have several solutions: `turning.rs` finds
//! them all, as those of a block mode problem, and `system.rs` takes up each by Newton's method.

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
mod lifting;
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
mod turning;
mod units;
mod vanishing;

#[cfg(test)]
pub(super) use assessment::ASSESSED;
pub(super) use determined::{DeterminedForces, determined_forces};
pub(super) use elastic::verdict_on;
#[cfg(test)]
pub(super) use impact::impact_within;
pub use impact::{Blow, Impact, impact};
pub(super) use impact::{FaceBlow, Landing, landing};
pub use jam::{Impulse, Jam, jam};
pub use rules::Outlook;
pub use state::PhaseState;
pub use sticking::{Sticking, phase_state, sticking, sticking_margin};
pub(super) use successors::continuations;
pub use successors::{Successor, Successors, TippingPhase, successors};
pub(super) use units::scale_of_forces;

use crate::ids::{ContactId, JointId};

/// Slacks closer to zero than this are at a boundary.
const BOUNDARY: f64 = 1e-8;
/// If this many states of a group were tried without finding one that can follow, the group is refused.
const MOST_STATES: u64 = 100_000;

/// How a phase stands to its bounds at the instant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Standing {
    /// Nothing is at a boundary.
    Inside,
    /// It starts at a boundary and moves away from it.
    Leaves(Vec<PhaseBound>),
    /// It stays at a boundary to second order, so rounding would decide whether it lasts.
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
    /// The acceleration of a gap of a joint.
    Gap(JointId),
}
