//! Mechanisms through the whole pipeline, from the model file to the report.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod answers;
mod brute_force;
mod drawing;
mod random_mechanisms;
mod stiff_guides;

mod attainability;
mod between_faces;
mod configuration;
mod continua;
mod design;
mod enclosure;
mod exact_chains;
mod free_pins;
mod friction_laws;
mod gallery;
mod gallery_frictionless;
mod gap_states;
mod guided_slider;
mod held_by_itself;
mod klepp_2002;
mod limits;
mod limits_between_faces;
mod limits_known;
mod limits_properties;
mod loads;
mod margins;
mod no_sliding;
mod one_face;
mod one_sided;
mod one_sided_hinges;
mod one_sided_jams;
mod one_sided_rest;
mod one_sided_resting;
mod one_sided_rolling;
mod one_sided_shapes;
mod one_sided_systems;
mod one_sided_words;
mod positions;
mod preload_gap;
mod press_fits;
mod properties;
mod redundant;
mod redundant_closed_forms;
mod redundant_rest;
mod rest;
mod speeds;
mod standing;
mod standstill;
mod symmetries;
mod tables_and_events;
mod textbook;
mod uncertainty;
mod words;
