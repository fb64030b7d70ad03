//! From which friction on is a drawer locked, and how well is that known? `cargo run --example limits`
#![allow(clippy::print_stdout)]

use slideway::{Faults, LimitsOptions, Model, Vary, gallery, limits};

fn main() -> Result<(), Faults> {
    let model = Model::parse(gallery::find("drawer").expect("in the gallery").text)?;
    let report = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 1.0)))?;
    for interval in &report.counts {
        let (from, to) = (interval.from, interval.to);
        println!("mu from {from:.6} to {to:.6}: {} solutions, {:?}", interval.solutions, interval.known);
    }
    Ok(())
}
