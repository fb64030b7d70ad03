//! What every sliding joint and contact does, as linear equations and inequalities: the description that
//! standstill and the decisions of motions share.
//!
//! ```text
//! slides   F_k = (mu_k |N_k| + F_k0) s_k
//! sticks   |F_k| <= mu_static_k |N_k| + F_k0
//! in both  |N_k| >= 0,  |C| <= |N| L/2 of guided sliders, 0 <= share <= 1 in a preload gap
//! ```
//!
//! [`Friction`] has the friction of one contact as expressions of unknowns, and what bounds it; whoever asks
//! adds the equations, of statics or of motion. [`AffineSet`] solves these, [`Region`] asks the linear
//! programs of what they leave open.
//!
//! # Files
//! `pattern` is what `standstill` and `motion` share: what joints and contacts do (`phase.rs`), as linear
//! equations and inequalities. `friction.rs` is Coulomb's law of a contact, with preloads, and when a guided
//! slider tips, `friction_circle.rs` the same of a hinge; `affine.rs` solves the equations, of statics or of motion, that are added; `program.rs` asks
//! the linear programs of what they leave open, the only place that knows their solver (`simplex.rs`); `words.rs` names the
//! senses of sliding.

mod affine;
mod friction;
mod friction_circle;
pub(crate) mod phase;
mod program;
mod simplex;
mod words;

pub(crate) use affine::{Affine, AffineExpression, AffineSet};
pub(crate) use friction::{Bound, Friction, GuidedCouple, Law, face, without_tipping};
pub(crate) use friction_circle::{Pin, direction};
pub(crate) use phase::{ContactPhase, HingePhase, JointPhase, Phase};
pub(crate) use program::{NOTHING, Region};
pub(crate) use words::{sliding_in_words, sticking_in_words};

/// The solver gave up, its answer contradicts what is known, or the work is to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unsolved;

/// Least and greatest value; nothing where there is none.
pub(crate) type Extent = [Option<f64>; 2];
