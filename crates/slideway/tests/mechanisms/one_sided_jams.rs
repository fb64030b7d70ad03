//! What a jam of contacts that may lift off leads to, and how forces grow towards the singular point of Painlevé's rod.

use crate::answers::{assert_close, contact, report_on};
use crate::one_sided::{GRAVITY, REFERENCE, Reference, gap, painleve};
use rstest::rstest;
use slideway::report::{Report, Solution, SolveReport, Status};

/// Painlevé's rod that jams: of one contact the impulse is `A^-1 (0, -v_t)`; (0.3, 0.4) N s of the reference, which takes 0.2 J.
#[test]
fn an_impulse_without_collision_ends_the_jam_of_the_rod() {
    let Reference { case } = toml::from_str(REFERENCE).unwrap();
    let case = case.into_iter().find(|case| case.name == "painleve_rod_inconsistent").unwrap();
    let report = report_on(&case.system.text());
    assert_eq!(report.status, Status::None);
    let impulses = report.jam_impulses.as_deref().unwrap();
    let [only] = impulses else { panic!("{impulses:?}") };
    assert_close(only.contacts[0].normal_impulse, 0.3, 1.0, 1e-12);
    assert_close(only.contacts[0].friction_impulse, 0.4, 1.0, 1e-12);
    assert_close(only.energy_lost, 0.2, 1.0, 1e-12);
    let jumps = "Velocities jump without a collision. Afterwards P: closed, sticks (0.2 J of kinetic energy is lost).";
    assert!(report.answer().ends_with(jumps), "{}", report.answer());
    // Rolls that are driven let nothing stop: the disc would have to go through their gap.
    let rolls = include_str!("../../models/nip-of-rolls.toml").replace("mu = 0.3", "mu = 0.45");
    let report = report_on(&rolls);
    assert_eq!(report.jam_impulses.as_deref(), Some(&[][..]));
    assert!(report.answer().ends_with("The drives stall."), "{}", report.answer());
}

/// Where `D` and the acceleration `b` of the gap vanish together, `N ~ D^(lambda_b/lambda_a - 1)` with the rates of both in the time
/// `dt/D`: `lambda_a = D' theta'` and `lambda_b = -db/domega domega'/dN`. Both are equal at `mu = 8/(3 sqrt 3)`, where motions begin to
/// reach the point (Genot and Brogliato 1999); the other exponents are those of the reference.
#[rstest]
#[case(8.0 / 27_f64.sqrt(), 0.0)]
#[case(1.6, -0.190_875)]
#[case(5.0 / 3.0, -1.0 / 3.0)]
#[case(2.0, -0.658_359)]
fn forces_grow_at_the_singular_point_of_the_rod_with_this_exponent(#[case] mu: f64, #[case] exponent: f64) {
    let tan = (3.0 * mu - (9.0 * mu * mu - 16.0).sqrt()) / 2.0;
    let (theta, step) = (tan.atan(), 1e-4);
    let at = |lean: f64, turning: f64| {
        painleve(&[("mu", &mu.to_string()), ("lean", &lean.to_string()), ("turning", &turning.to_string())])
    };
    let state = |report: &SolveReport, pattern: &str| {
        report.solutions.iter().find(|solution| solution.pattern == pattern).cloned().expect("its state")
    };
    let turn = |solution: &Solution| solution.coordinates[1].acceleration;
    // Closed: N = -b/D, which is positive for b < 0 before the point and for b > 0 beyond it.
    let beside = |lean: f64, turning: f64| {
        let closed = state(&at(lean, turning), "+");
        let smooth = 1.0 + 3.0 * lean.cos().powi(2);
        // A rod in the air turns evenly.
        (closed.oriented_determinant * smooth, turn(&closed) / contact(&closed, "tip").normal_force)
    };
    let [before, beyond] = [beside(theta - step, 0.0), beside(theta + step, 30.0)];
    let omega = (GRAVITY / (0.5 * theta.sin())).sqrt();
    let [slow, fast] = [1.5, 2.0].map(|factor| gap(&state(&at(theta - step, factor * omega), "-"), "tip"));
    let of_omega = 2.0 * omega * (fast - slow) / ((2.0 * omega).powi(2) - (1.5 * omega).powi(2));
    // The lean falls while the rod turns counter-clockwise.
    let lambda_a = -(beyond.0 - before.0) / (2.0 * step) * omega;
    let lambda_b = -of_omega * f64::midpoint(before.1, beyond.1);
    assert_close(lambda_b / lambda_a - 1.0, exponent, 1.0, 2e-4);
}
