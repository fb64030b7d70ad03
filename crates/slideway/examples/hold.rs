//! How far out may a bracket be loaded so that it clamps itself on its pole? `cargo run --example hold`
#![allow(clippy::print_stdout)]

use slideway::{Faults, HoldOptions, Model, Settings, gallery, hold};

fn main() -> Result<(), Faults> {
    let bracket = Model::parse(gallery::find("bracket-on-pole").expect("in the gallery").text)?;
    let options = HoldOptions::default().load("W");
    for distance in ["200 mm", "300 mm", "310 mm", "400 mm"] {
        let at = bracket.with(&Settings::default().parameter("x", distance))?;
        let load = hold(&at, &options)?.load.expect("it is varied");
        println!("at {distance}: {}", if load.self_locking { "clamps itself" } else { "slips" });
    }
    Ok(())
}
