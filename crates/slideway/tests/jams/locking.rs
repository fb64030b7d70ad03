//! The mode that locks a mechanism without solution, with its forces.
//!
//! A drawer of supported length L that is pushed at the offset a with the force P touches its guide with N at both ends, one on
//! each side. Friction mu N at both gives P = 2 mu N, and moments about the middle N L = a P: it locks at mu = L/(2 a).

use crate::model;
use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::solve::{Locking, locking, solve};

fn locked(model: &Model) -> (Option<Locking>, Option<f64>) {
    let mechanism = Mechanism::new(model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let report = solve(model).unwrap();
    let moves_below = report.margins.as_ref().and_then(|margins| margins.moves_below);
    (locking(&report, &mechanism, &configuration), moves_below.map(|unlocking| unlocking.factor))
}

#[test]
fn the_drawer_locks_with_the_forces_of_its_derivation() {
    for (offset, mu) in [(0.3, 0.7), (0.3, 3.0), (0.5, 0.41)] {
        let drawer = model("drawer", &[("a", &offset.to_string()), ("mu", &mu.to_string())]);
        let (locking, _) = locked(&drawer);
        let locking = locking.unwrap();
        let limit = 0.4 / (2.0 * offset);
        let is_near = |one: f64, other: f64| (one - other).abs() < 1e-9;
        assert_eq!(locking.pattern, "+-");
        assert!(is_near(locking.factor, limit / mu), "{}", locking.factor);
        assert!(is_near(locking.normal_forces[0], 1.0) && is_near(locking.normal_forces[1], -1.0));
        assert!(locking.friction_forces.iter().all(|friction| is_near(*friction, limit)));
        assert!(is_near(locking.efforts[0], 2.0 * limit));
        assert!(locking.is_balance);
    }
}

/// As it moves, nothing locks it.
#[test]
fn what_has_a_solution_is_not_locked() {
    assert_eq!(locked(&model("drawer", &[])).0, None);
}

/// The mode locks at the friction below which there is a solution, as `solve` says. Without drives these forces are no
/// balance: they go with an acceleration.
#[test]
fn it_locks_where_solutions_end() {
    let klein = model("painleve-klein", &[("mu", "4")]);
    let klepp = model("klepp-2002", &[("F_20", "0"), ("direction", "-1")]);
    for (model, is_balance) in
        [(klein, false), (klepp, false), (model("cam-follower", &[("mu", "0.9"), ("d", "0")]), true)]
    {
        let (locking, moves_below) = locked(&model);
        let locking = locking.unwrap();
        assert!((locking.factor - moves_below.unwrap()).abs() < 1e-9, "{locking:?}");
        assert_eq!(locking.is_balance, is_balance);
        assert!(locking.normal_forces.iter().all(|force| force.abs() <= 1.0));
    }
}

/// Friction is not the reason where a guided slider tips.
#[test]
fn what_tips_is_not_locked() {
    let text = include_str!("../../../../docs/src/examples/guided-tips.toml");
    assert_eq!(locked(&Model::parse(text).unwrap()).0, None);
}
