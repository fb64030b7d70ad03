//! Stick-slip in time: what happens, and the positions in steps of 0.1 s. `cargo run --example simulate`
#![allow(clippy::print_stdout)]

use slideway::{Faults, Model, SimulateOptions, gallery, simulate};

fn main() -> Result<(), Faults> {
    let model = Model::parse(gallery::find("stick-slip").expect("in the gallery").text)?;
    let history = simulate(&model, &SimulateOptions::new(2.0))?;
    for event in &history.events {
        println!("{:8.4} s  {}", event.time, event.words);
    }
    let series = history.series(&history.times_in_steps(0.1));
    for column in series.columns.iter().take(3) {
        let values: Vec<String> = column
            .values
            .iter()
            .map(|value| value.map_or(String::new(), |value| format!("{value:.3}")))
            .collect();
        println!("{} ({}): {}", column.name, column.unit, values.join(" "));
    }
    Ok(())
}
