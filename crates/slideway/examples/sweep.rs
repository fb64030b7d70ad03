//! Normal forces over friction as vectors, for a plot of one's own. `cargo run --example sweep`
#![allow(clippy::print_stdout)]

use slideway::sweep::{GridAxis, Sweep, SweepOptions};
use slideway::{Faults, Model, Settings, gallery};
use std::ops::ControlFlow;

fn main() -> Result<(), Faults> {
    let model = Model::parse(gallery::find("klepp-2002").expect("in the gallery").text)?;
    let sweep = Sweep::new(
        &model.with(&Settings::default().parameter("F_20", "0 N"))?,
        &SweepOptions::grid([GridAxis::linear("mu_1", 0.0, 0.8, 81)]),
    )?;
    let column =
        1 + sweep.columns().iter().position(|column| column.name == "normal_force.upper").expect("a contact");

    // One curve for each branch: mu_1 and the normal force.
    let mut curves: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    sweep.run(&mut sweep.start(), &Clone::clone, &mut |chunks, _| {
        for rows in chunks {
            for (row, head) in rows.heads.iter().enumerate().filter(|(_, head)| head.branch > 0) {
                curves.resize_with(curves.len().max(head.branch as usize), Default::default);
                let (mu, force) = &mut curves[head.branch as usize - 1];
                mu.push(rows.numbers(row)[0]);
                force.push(rows.numbers(row)[column]);
            }
        }
        ControlFlow::Continue(())
    });
    for (mu, force) in &curves {
        let last = mu.len() - 1;
        println!(
            "{} points from mu_1 = {:.4} (N = {:.3} N) to {:.4} (N = {:.3} N)",
            mu.len(),
            mu[0],
            force[0],
            mu[last],
            force[last]
        );
    }
    Ok(())
}
