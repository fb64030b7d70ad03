//! Against the reference cases, which two independent prototypes have computed.

use super::cases::{self, Case, View, moving, read};
use serde::Deserialize;
use slideway::modes::Side;
use slideway::report::{Proof, Solution, SolveReport, Status, Verdict};
use slideway::solve::exact_block_problem;
use slideway::{DriveOptions, drive, solve};

/// x = b + H w with the reactions of the reference.
#[test]
fn the_reference_solves_the_block_problem() {
    for case in moving() {
        let problem = exact_block_problem(&case.model(1.0)).unwrap();
        assert_eq!(
            (problem.contacts(), problem.hinges()),
            (case.contacts(), case.hinges.len()),
            "{}",
            case.name
        );
        for solution in &case.solution {
            let contacts = problem.contacts();
            let unknowns: Vec<f64> =
                solution.normal.iter().copied().chain(solution.hinge.iter().flatten().copied()).collect();
            let lengths = solution.hinge.iter().map(|[x, y]| x.hypot(*y));
            let magnitudes: Vec<f64> = solution.normal.iter().map(|n| n.abs()).chain(lengths).collect();
            let greatest = magnitudes.iter().copied().fold(0.0, f64::max);
            for (row, unknown) in unknowns.iter().enumerate() {
                let of = |(column, magnitude): (usize, &f64)| {
                    let negative = column < contacts && solution.sides[column] < 0;
                    let side = if negative { Side::Negative } else { Side::Positive };
                    problem.response(side).centre()[(row, column)] * magnitude
                };
                let sum: f64 = magnitudes.iter().enumerate().map(of).sum();
                let residual = unknown - problem.load().centre()[(row, 0)] - sum;
                assert!(
                    residual.abs() < 1e-9 * greatest,
                    "{} row {row}: {residual} of {greatest}",
                    case.name
                );
            }
        }
    }
}

fn assert_close(what: &str, value: f64, expected: f64, scale: f64) {
    assert!(
        (value - expected).abs() <= 1e-9 * scale,
        "{what}: {value} instead of {expected}, in units of {scale}"
    );
}

/// Every solution with its forces, accelerations and efforts, and no other, proven for the exact mechanism.
#[test]
fn all_solutions_of_the_reference_are_found() {
    for case in moving() {
        let report = solve(&case.model(1.0)).unwrap();
        let name = &case.name;
        assert_eq!(Some(report.solutions.len()), case.count, "{name}: {:?}", report.open);
        assert_eq!(report.complete, Proof::Proven, "{name}: {:?}", report.open);
        let expected = [Status::None, Status::One, Status::Several][report.solutions.len().min(2)];
        assert_eq!(report.status, expected, "{name}");
        for reference in &case.solution {
            compare(&case, nearest(&report, reference), reference);
        }
    }
}

/// The solution with the hinge forces of one of the reference.
fn nearest<'r>(report: &'r SolveReport, reference: &cases::Solution) -> &'r Solution {
    let distance = |solution: &Solution| {
        let parts = solution.hinges.iter().zip(&reference.hinge);
        parts.map(|(hinge, [x, y])| (hinge.force[0] - x).hypot(hinge.force[1] - y)).sum::<f64>()
    };
    report.solutions.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
}

/// A mechanism whose hinges and guides are stiff springs settles on attainable solutions, and leaves the others
/// (`elastic_hinges.py`, begun a hundredth below and above each).
#[test]
fn stiff_springs_settle_on_the_attainable_solutions() {
    #[derive(Deserialize)]
    struct File {
        case: Vec<Simulated>,
    }
    #[derive(Deserialize)]
    struct Simulated {
        name: String,
        settles_on: Vec<[String; 2]>,
    }

    let cases = moving();
    for Simulated { name, settles_on } in read::<File>("elastic-hinges.toml").case {
        let case = cases.iter().find(|case| case.name == name).unwrap();
        let report = solve(&case.model(1.0)).unwrap();
        assert_eq!(settles_on.len(), case.solution.len(), "{name}");
        for (number, (reference, ends)) in (1..).zip(case.solution.iter().zip(&settles_on)) {
            let attainability = &nearest(&report, reference).attainability;
            let expected = if ends.iter().all(|end| *end == number.to_string()) {
                Verdict::Attainable
            } else {
                Verdict::Unattainable
            };
            assert_eq!(attainability.verdict, expected, "{name}, solution {number}: {attainability:?}");
        }
    }
}

fn compare(case: &Case, solution: &Solution, reference: &cases::Solution) {
    let name = &case.name;
    let lengths = reference.hinge.iter().map(|[x, y]| x.hypot(*y));
    let force = reference.normal.iter().map(|n| n.abs()).chain(lengths).fold(0.0, f64::max);
    for (contact, (normal, side)) in
        solution.contacts.iter().zip(reference.normal.iter().zip(&reference.sides))
    {
        assert_close(name, contact.normal_force, *normal, force);
        assert_eq!(i32::from(contact.side), *side, "{name}");
    }
    for ((hinge, expected), circle) in solution.hinges.iter().zip(&reference.hinge).zip(&case.hinges) {
        assert_close(name, hinge.force[0], expected[0], force);
        assert_close(name, hinge.force[1], expected[1], force);
        let friction = hinge.friction.unwrap();
        let couple = -friction.angular_velocity.signum() * circle.r * expected[0].hypot(expected[1]);
        assert_close(name, friction.couple, couple, couple.abs());
        assert_eq!(friction.radius, circle.r);
    }
    let accelerations = solution
        .bodies
        .iter()
        .flat_map(|body| [body.acceleration[0], body.acceleration[1], body.angular_acceleration]);
    let greatest = reference.acceleration.iter().map(|a| a.abs()).fold(0.0, f64::max);
    for (acceleration, expected) in accelerations.zip(&reference.acceleration) {
        assert_close(name, acceleration, *expected, greatest);
    }
    if let Some(torque) = reference.drive_torque {
        assert_close(name, solution.drives[0].effort, torque, torque.abs());
    }
    assert_close(name, solution.oriented_determinant, reference.determinant, reference.determinant.abs());
    let unattainable = solution.attainability.verdict == Verdict::Unattainable;
    assert!(unattainable || reference.determinant > 0.0, "{name}: {:?}", solution.attainability);
    assert!(solution.residual < 1e-12, "{name}: {}", solution.residual);
}

/// Without friction in the hinges the answer is the one that is found without blocks, and near it with very little.
#[test]
fn small_friction_circles_change_little() {
    for case in moving() {
        let [without, with] = [0.0, 1e-9].map(|factor| solve(&case.model(factor)).unwrap());
        assert!(
            without.solutions.iter().flat_map(|one| &one.hinges).all(|hinge| { hinge.friction.is_none() })
        );
        assert_eq!(without.solutions.len(), with.solutions.len(), "{}", case.name);
        for (one, other) in without.solutions.iter().zip(&with.solutions) {
            assert_eq!(one.pattern, other.pattern);
            for (one, other) in one.hinges.iter().zip(&other.hinges) {
                let scale = one.force[0].hypot(one.force[1]);
                for axis in 0..2 {
                    assert!((one.force[axis] - other.force[axis]).abs() < 1e-6 * scale, "{}", case.name);
                }
            }
        }
    }
}

/// Turned, and in the mirror image, the same solutions are there. Normals change sides in the mirror image, as the
/// contacts' tangents stay where they slide to.
#[test]
fn directions_in_space_do_not_matter() {
    for case in moving() {
        let mut lengths = [(0.0, false), (0.7, false), (-2.0, true)].map(|(turn, mirror)| {
            let report = solve(&case.seen(1.0, &View { turn, mirror })).unwrap();
            assert_eq!(report.complete, Proof::Proven, "{}: {:?}", case.name, report.open);
            let of = |solution: &Solution| -> Vec<f64> {
                let hinges = solution.hinges.iter().map(|hinge| hinge.force[0].hypot(hinge.force[1]));
                hinges.chain(solution.contacts.iter().map(|contact| contact.normal_force.abs())).collect()
            };
            report.solutions.iter().map(of).collect::<Vec<_>>()
        });
        lengths.iter_mut().for_each(|all| all.sort_by(|one, other| one[0].total_cmp(&other[0])));
        let [straight, others @ ..] = &lengths;
        for other in others {
            assert_eq!(straight.len(), other.len(), "{}", case.name);
            for (one, other) in straight.iter().flatten().zip(other.iter().flatten()) {
                assert_close(&case.name, *other, *one, straight[0].iter().copied().fold(0.0, f64::max));
            }
        }
    }
}

/// `drive` has the torque of the reference, and the one without friction.
#[test]
fn drive_takes_friction_in_hinges_into_account() {
    let case = moving().into_iter().find(|case| case.name == "slider_crank_driven").unwrap();
    let report = drive(&case.model(1.0), &DriveOptions::default()).unwrap();
    let torque = case.solution[0].drive_torque.unwrap();
    assert_close("torque", report.directions[0].solutions[0].efforts[0], torque, torque.abs());
    let frictionless = solve(&case.model(0.0)).unwrap();
    assert!(frictionless.solutions[0].drives[0].effort < torque, "the gas pushes, friction takes some of it");
    assert!(report.directions[0].blow_ups.is_none());
}
