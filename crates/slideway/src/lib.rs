//! All solutions of planar mechanisms with dry friction in sliding joints.
//!
//! The data flows through the modules in this order, each arrow one pure function:
//!
//! ```text
//! model file -> Model -> Mechanism -> Configuration -> KineticEquations -> Influence -> ModeProblem -> Solutions -> Report
//! ```

pub mod configuration;
pub mod expression;
pub mod fault;
pub mod kinetics;
pub mod mechanism;
pub mod ids;
pub mod model;
pub mod modes;
