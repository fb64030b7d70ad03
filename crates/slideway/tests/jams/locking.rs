//! The mode that locks a mechanism without solution, with its forces.
//!
//! A drawer of supported length L that is pushed at the offset a with the force P touches its guide with N at both ends, one on
//! each side. Friction mu N at both gives P = 2 mu N, and moments about the middle N L = a P: it locks at mu = L/(2 a).

use crate::model;
use nalgebra::Vector2;
use slideway::configuration::Configuration;
use slideway::ids::ContactId;
use slideway::mechanism::{Effort, Mechanism};
use slideway::model::Model;
use slideway::solve::{Locking, locking, solve};
use slideway::{Drawing, GROUND};

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

/// Pushed at the angle b from its rail, the forces of the ends differ: with N_f + N_r = -P sin b, mu (N_f - N_r) = P cos b and
/// moments about the middle (N_f - N_r) L/2 = P (a cos b - c sin b), c the place of the push along the rail.
#[test]
fn an_oblique_push_locks_with_unequal_forces() {
    const L: f64 = 0.4;
    let (angle, aside, along) = (0.4_f64, 0.3, -0.1);
    let mut d = Drawing::new();
    let drawer = d.body("drawer").mass(3.0).centre([0.02, 0.05]).inertia(0.1).id();
    let rail = d.block_slider("rail", drawer, GROUND).at([0.0, 0.0]).length(L).mu(2.0).id();
    let x = d.slide("x", rail).rate(0.1).id();
    d.drive_by_force("push", x, (drawer, [along, aside], angle));
    d.force("resistance", drawer).at([0.0, 0.0]).components([-10.0, 0.0]);
    let (locking, _) = locked(&d.build().unwrap());
    let locking = locking.unwrap();
    let (sine, cosine) = angle.sin_cos();
    let limit = L * cosine / (2.0 * (aside * cosine - along * sine));
    let is_near = |one: f64, other: f64| (one - other).abs() < 1e-9 * other.abs();
    assert!(is_near(locking.factor, limit / 2.0), "{} {limit}", locking.factor);
    let ends = [0.5 * (cosine / limit - sine), -0.5 * (cosine / limit + sine)];
    let size = 1.0 / ends[1].abs();
    for (end, wanted) in ends.into_iter().enumerate() {
        assert!(is_near(locking.normal_forces[end], size * wanted), "{:?}", locking.normal_forces);
        assert!(is_near(locking.friction_forces[end], size * limit * wanted.abs()), "{locking:?}");
    }
    assert!(is_near(locking.efforts[0].abs(), size), "{locking:?}");
}

/// The forces of the contacts, and the efforts of the drives, are in balance by themselves: their sum and their moment about
/// the origin vanish for a mechanism of one body, whatever its guides share. They lock at L / (2 a), as the models say.
#[test]
fn the_forces_of_redundant_guides_are_a_balance() {
    for (name, plays, limit) in [
        ("drawer", vec![], 2.0 / 3.0),
        ("drawer-on-two-rails", vec![("play_left", "0.6 mm"), ("play_right", "0.2 mm")], 0.8),
        ("carriage-on-two-rods", vec![("play_near", "0.1 mm"), ("play_far", "0.02 mm")], 0.75),
    ] {
        let parameters = [vec![("mu", "0.9")], plays].concat();
        let model = model(name, &parameters);
        let mechanism = Mechanism::new(&model).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap();
        let report = solve(&model).unwrap();
        let locking =
            locking(&report, &mechanism, &configuration).unwrap_or_else(|| panic!("{name}: {report:?}"));
        let [drive] = &mechanism.drives[..] else { panic!("{name}: one drive") };
        let Effort::Force { at, direction, .. } = drive.effort else { panic!("{name}: a force") };
        let mut all = vec![(configuration.position(&mechanism, &at), locking.efforts[0] * direction)];
        for (k, contact) in mechanism.contacts.iter().enumerate() {
            let place = configuration.contact(&mechanism, ContactId(k));
            let [normal, friction] = [locking.normal_forces[k], locking.friction_forces[k]];
            let mu = contact.mu[usize::from(normal < 0.0)];
            assert!(
                (friction.abs() - locking.factor * mu * normal.abs()).abs() < 1e-9,
                "{name}: {locking:?}"
            );
            // Friction acts at the pressed face, half a height towards the normal force's tail.
            let slider = mechanism.slider(contact.joint).unwrap();
            let face = place.point - place.normal * (0.5 * slider.height * normal.signum());
            all.push((place.point, place.normal * normal));
            all.push((face, -place.tangent * friction));
        }
        let sum = all.iter().map(|(_, force)| force).sum::<Vector2<f64>>();
        let moment: f64 = all.iter().map(|(place, force)| place.perp(force)).sum();
        assert!(sum.norm() < 1e-9 && moment.abs() < 1e-9, "{name}: {sum} {moment} {locking:?}");
        assert!((0.9 * locking.factor - limit).abs() < 1e-9, "{name}: {locking:?}");
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
