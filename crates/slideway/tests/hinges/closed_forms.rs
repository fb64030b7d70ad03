//! Closed forms: pulleys of a textbook, dead centres of a slider-crank.

use crate::cases::reference;
use crate::dead_centre::{DeadCentre, dead_centres};
use serde::Deserialize;
use slideway::{Model, Settings, solve};

#[derive(Deserialize)]
struct File {
    pulley: Pulley,
}

#[derive(Deserialize)]
struct Pulley {
    total_reaction: Forces,
    mu_rho: Forces,
}

/// In pounds: of a load of 500 lb on a pulley of 4 in with a shaft of 2 in and mu = 0.2.
#[derive(Deserialize)]
struct Forces {
    r: f64,
    raise_vertical: f64,
    hold_vertical: f64,
    raise_horizontal: f64,
}

/// The pull at the right or the top of the pulley that moves the load at its left.
fn pull(law: &str, at: [f64; 2], direction: &str, rate: f64) -> (f64, f64) {
    let text = format!(
        "[points]\nO = [0, 0]\nL = [-2, 0]\nP = {at:?}\n\
         [bodies.pulley]\npoints = [\"O\", \"L\", \"P\"]\nmassless = true\n\
         [joints.shaft]\ntype = \"hinge\"\nbetween = [\"pulley.O\", \"ground.O\"]\nmu = 0.2\nradius = 1\nlaw = {law:?}\n\
         [loads.weight]\ntype = \"force\"\nat = \"pulley.L\"\ncomponents = [0, -500]\n\
         [coordinates.phi]\nrotation = \"pulley\"\nrate = {rate}\n\
         [drives.pull]\ncoordinate = \"phi\"\nforce = {{ at = \"pulley.P\", direction = {direction:?} }}\n"
    );
    let report = solve(&Model::parse(&text).unwrap()).unwrap();
    let [solution] = report.solutions.as_slice() else { panic!("{} solutions", report.solutions.len()) };
    let force = solution.hinges[0].force;
    let friction = solution.hinges[0].friction.unwrap();
    assert!((friction.couple.abs() - friction.radius * force[0].hypot(force[1])).abs() < 1e-9);
    (solution.drives[0].effort, friction.radius)
}

/// Beer and Johnston's pulley: raising turns it clockwise. The horizontal pull leaves at the top.
#[test]
fn a_pulley_needs_what_the_friction_circle_says() {
    let Pulley { total_reaction, mu_rho } = reference::<File>().pulley;
    for (law, expected) in [("total_reaction", total_reaction), ("mu_rho", mu_rho)] {
        for ((at, direction, rate), force) in [
            (([2.0, 0.0], "-90 deg", -1.0), expected.raise_vertical),
            (([2.0, 0.0], "-90 deg", 1.0), expected.hold_vertical),
            (([0.0, 2.0], "0 deg", -1.0), expected.raise_horizontal),
        ] {
            let (effort, radius) = pull(law, at, direction, rate);
            assert!((effort / force - 1.0).abs() < 1e-10, "{law}, {at:?}: {effort} instead of {force}");
            assert!((radius - expected.r).abs() < 1e-11);
        }
    }
}

/// The crank angle counted from the direction of the piston.
fn crank(case: &DeadCentre, angle: f64, inner: bool) -> f64 {
    let drawn = if inner { 180.0 } else { 0.0 };
    let further = format!(
        "[loads.gas]\ntype = \"force\"\nat = \"piston.B\"\ncomponents = [{}, 0]\n\
         [coordinates.phi]\nrotation = \"crank\"\ndrawn_at = \"{drawn} deg\"\nrate = 1\n\
         [drives.shaft]\ncoordinate = \"phi\"\ntorque = {{ body = \"crank\" }}\n",
        if inner { 1000.0 } else { -1000.0 },
    );
    let model = case.at_dead_centre(inner, &further);
    let state = Settings::default().position("phi", format!("{} deg", drawn + angle));
    let report = solve(&model.with(&state).unwrap()).unwrap();
    let [solution] = report.solutions.as_slice() else {
        panic!("{} solutions: {:?}", report.solutions.len(), report.open)
    };
    solution.drives[0].effort
}

/// Within the angle of the dead centre the piston cannot turn the crank: the drive has to help. Outside it brakes. The
/// angles do not depend on the friction of the piston.
#[test]
fn a_slider_crank_locks_around_its_dead_centres() {
    for case in dead_centres() {
        for (inner, angle) in [(false, case.outer_deg), (true, case.inner_deg)] {
            let [within, beyond] = [-1e-7, 1e-7].map(|step| crank(&case, angle + step, inner));
            assert!(within > 0.0 && beyond < 0.0, "{angle} deg: {within} and {beyond} N m");
        }
    }
}
