//! A drawer in code: does it jam? `cargo run --example solve`
#![allow(clippy::print_stdout)]

use slideway::{Drawing, Faults, GROUND, Settings, solve};

fn main() -> Result<(), Faults> {
    let mut d = Drawing::new();
    d.parameter("mu", 0.3);
    let drawer = d.body("drawer").mass(5.0).centre([0.0, 0.0]).rectangle([0.45, 0.7]).id();
    let rail = d.block_slider("rail", drawer, GROUND).at([0.0, 0.0]).length(0.4).mu("mu").id();
    let x = d.slide("x", rail).rate(0.1).id();
    d.force("resistance", drawer).at([0.0, 0.0]).components([-20.0, 0.0]);
    // Pushed at constant velocity by the handle, 0.3 m beside the middle.
    let push = d.drive_by_force("push", x, (drawer, [-0.2, 0.3], 0.0)).id();
    let model = d.build()?;

    for mu in [0.1, 0.3, 0.6, 0.7] {
        let answer = solve(&model.with(&Settings::default().parameter("mu", mu))?)?;
        match answer.solutions.as_slice() {
            [] => println!("mu = {mu}: no force moves it ({})", answer.complete),
            solutions => {
                for solution in solutions {
                    let force = solution.drive(push).effort;
                    let front = solution.contact(rail.front()).normal_force;
                    println!("mu = {mu}: push with {force:.2} N; the front presses with {front:.2} N");
                }
            }
        }
    }
    Ok(())
}
