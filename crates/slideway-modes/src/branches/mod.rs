//! Branches of block problems: the intervals of a parameter in which each solution with friction in hinges exists.
//!
//! A contact mode may have several solutions with friction in hinges, and two of them may merge. So the unit is the
//! [`Branch`]: a solution followed over a parameter `t` ([`Family`]) with the same sides of the contacts and the same
//! sign of `det(I - H D)`, its orientation. It ends where a normal force or a hinge force vanishes, where a bound is
//! reached, where the forces grow without bound, or in a fold, where it meets a branch of the other orientation
//! (theory of hinges, section 4).
//!
//! # Method
//! Solutions are followed as `z = (y, lambda)`, `x = y / lambda`, `|z| = 1`, of the homogeneous equations
//! `(I - H D) y = lambda b`: forces without bound are the regular point `lambda = 0`. At values of the parameter
//! [`blocks::search`](crate::blocks::search) finds all solutions, proven. Where neighbouring lists differ in the
//! numbers of solutions of some mode and orientation they are halved, and what differs is followed along the
//! arc of the curve `(z, t)`, on which folds are regular points, too. An end is a change of sign along the arc, bisected to
//! machine precision. Between the values a branch may appear and disappear unnoticed.
//!
//! The branches of one hinge over the radius of its friction circle have a closed form: [`over_radius`].
//!
//! # Files
//! `family.rs`: problems of a parameter. `place.rs`: a solution at a value. `conditions.rs`: what a branch has to keep.
//! `curve.rs`: the curve of a branch, and its ends. `samples.rs`: all solutions at values. `find.rs`: from
//! samples to branches. `follow.rs`: one solution. `branch.rs`: what is returned. `radius.rs`: the closed form of one hinge.

mod branch;
mod conditions;
mod curve;
mod family;
mod find;
mod follow;
mod place;
mod radius;
mod samples;

pub use branch::{Branch, BranchEnd, BranchForces, Branches, Gap};
pub use family::{Family, Instance, NoInstance};
pub use find::{BranchOptions, branches};
pub use follow::{end_of, keeps_bounds};
pub use radius::over_radius;
