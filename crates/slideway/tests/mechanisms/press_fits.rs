//! Press fits: closed forms, random carriages against eq. (R3) by every pattern of faces, what other questions answer,
//! and what is refused.
//!
//! The slide of the book has its contacts a distance L apart, is pulled at y = a with the force P at constant speed, and
//! carries the loads Q against its motion and W across it at y = 0. Each contact grips with `N_0 = 2 k |delta|`, and has
//! friction `mu max(|N|, N_0)`. With h = 0 and N the magnitude of both normal forces where W = 0,
//!
//! ```text
//! N L = a P,    P = Q + 2 mu max(N, N_0)
//! ```
//!
//! With h the friction of a contact has the moment `mu h N / 2` about its middle, N with its sign: that of the faces,
//! `mu N^+` at h/2 on one side and `mu N^-` on the other, and the same where one face carries all.

use crate::answers::{
    assert_close, contact, only, parameters, report, report_on, report_with, try_report_on,
};
use crate::random_mechanisms::cases;
use crate::redundant::{Carriage, Pad};
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use proptest::prelude::*;
use rstest::rstest;
use slideway::check::check;
use slideway::drive::{DriveOptions, drive};
use slideway::fault::{FaultKind, Faults};
use slideway::limits::{LimitsOptions, Quantity, limits, limits_with_curves};
use slideway::map::{ClassMeaning, MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::motion::{SimulateOptions, simulate};
use slideway::report::{Fate, Proof, Solution, SolveReport, Verdict};
use slideway::size::{Against, SizeOptions, size};
use slideway::sweep::{Rows, Sweep, SweepOptions};
use std::ops::ControlFlow;

const SLIDE: &str = include_str!("../../../../docs/src/examples/press-fitted-slide.toml");
const L: f64 = 0.2;
const Q: f64 = 50.0;
/// 1 MN/m times 0.02 mm.
const GRIP: f64 = 20.0;

fn slide(list: &[(&str, &str)]) -> Model {
    Model::parse(SLIDE).unwrap().with(&parameters(list)).unwrap_or_else(|faults| panic!("{faults}"))
}

fn solved(list: &[(&str, &str)]) -> SolveReport {
    report_with(&slide(list), &Settings::default())
}

fn effort(solution: &Solution) -> f64 {
    solution.drives[0].effort
}

/// Normal forces at the positive and the negative face of a place.
fn faces(solution: &Solution, place: &str) -> [f64; 2] {
    ["plus", "minus"].map(|face| contact(solution, &format!("{place}.{face}")).normal_force)
}

#[rstest]
#[case("0 mm", 0.0)]
#[case("40 mm", 0.04)]
#[case("70 mm", 0.07)]
fn both_faces_rub_with_the_grip(#[case] a: &str, #[case] lever: f64) {
    let (report, mu) = (solved(&[("a", a)]), 0.1);
    assert_eq!(report.complete, Proof::Proven);
    let solution = only(&report);
    let pull = Q + 2.0 * mu * GRIP;
    let normal = lever * pull / L;
    assert!(normal < GRIP);
    assert_close(effort(solution), pull, Q, 1e-12);
    assert_eq!(solution.pattern, "++--");
    for (place, sign) in [("guide.front", 1.0), ("guide.rear", -1.0)] {
        let [plus, minus] = faces(solution, place);
        assert_close(plus + minus, sign * normal, GRIP, 1e-12);
        assert_close(plus - minus, GRIP, GRIP, 1e-12);
        // d = -N / (2 k)
        for face in ["plus", "minus"] {
            let deflection = contact(solution, &format!("{place}.{face}")).deflection.unwrap();
            assert_close(deflection, -sign * normal / 2e6, 1e-5, 1e-12);
        }
    }
    assert_eq!(solution.attainability.verdict, Verdict::Attainable);
    assert_close(solution.oriented_determinant, 1.0, 1.0, 1e-12);
    assert!(solution.residual < 1e-14);
    // L / (2 a), whatever the load, the grip and the compliance.
    let uniqueness = report.margins.as_ref().and_then(|margins| margins.uniqueness);
    match uniqueness {
        Some(factor) => assert_close(mu * factor, L / (2.0 * lever), 1.0, 1e-12),
        None => assert_eq!(lever, 0.0),
    }
    let sharing = report.sharing.as_ref().unwrap();
    assert_eq!((sharing.self_stresses, sharing.groups.len()), (0, 0));
    assert_eq!(sharing.press_fits.len(), 2);
    for fit in &sharing.press_fits {
        assert_close(fit.grip, GRIP, GRIP, 1e-12);
    }
}

/// `P = Q / (1 - 2 mu a / L)`, as without a press fit: the grip is exceeded.
#[test]
fn one_face_carries_what_exceeds_the_grip() {
    let (report, mu, a) = (solved(&[("a", "100 mm")]), 0.1, 0.1);
    let solution = only(&report);
    let pull = Q / (1.0 - 2.0 * mu * a / L);
    let normal = a * pull / L;
    assert!(normal > GRIP);
    assert_close(effort(solution), pull, Q, 1e-12);
    assert_eq!(solution.pattern, "+-+-");
    let [front, rear] = ["guide.front", "guide.rear"].map(|place| faces(solution, place));
    assert_eq!([front[1], rear[0]], [0.0, 0.0]);
    assert_close(front[0], normal, GRIP, 1e-12);
    assert_close(rear[1], -normal, GRIP, 1e-12);
    let with_play = solved(&[("a", "100 mm"), ("play", "0.02 mm")]);
    assert_close(effort(only(&with_play)), pull, Q, 1e-12);
    // p = det(I - eta mu s sigma) of the determinate slide: P = Q / p.
    assert_close(solution.oriented_determinant, Q / pull, 1.0, 1e-12);
    // d = |delta| - f N
    for face in ["guide.front.plus", "guide.front.minus"] {
        assert_close(contact(solution, face).deflection.unwrap(), 1e-5 - normal * 1e-6, 1e-5, 1e-12);
    }
}

/// `N_f + N_r = W`, `(N_f - N_r) L/2 = mu h/2 (N_f + N_r)`; friction does not depend on W while both faces touch.
#[rstest]
#[case("10 N", 10.0, 2.0 * GRIP)]
#[case("36 N", 36.0, 2.0 * GRIP)]
#[case("100 N", 100.0, 100.0)]
fn friction_at_the_faces_tilts_the_slide(#[case] load: &str, #[case] w: f64, #[case] pressed: f64) {
    let (h, mu) = (0.03, 0.1);
    let report = solved(&[("a", "0 m"), ("h", "30 mm"), ("W", load)]);
    let solution = only(&report);
    assert_close(effort(solution), Q + mu * pressed, Q, 1e-12);
    for (place, sign) in [("guide.front", 1.0), ("guide.rear", -1.0)] {
        let force: f64 = faces(solution, place).iter().sum();
        // The pull acts at y = 0, too.
        assert_close(force, w * 0.5 * (1.0 + sign * mu * h / L), w, 1e-12);
    }
}

/// The grip moves no locking limit: `mu = L / (2 a)` as with play.
#[test]
fn a_press_fit_locks_where_play_does() {
    for play in ["-0.02 mm", "-0.002 mm", "0 mm", "0.02 mm"] {
        let report =
            limits(&slide(&[("play", play)]), &LimitsOptions::new("mu=0..4".parse().unwrap())).unwrap();
        let [running, locked] = &report.counts[..] else { panic!("{:?}", report.counts) };
        assert_eq!([running.solutions, locked.solutions], [1, 0]);
        assert_close(running.to, L / (2.0 * 0.04), 1.0, 1e-12);
    }
}

/// `a (Q + 2 mu N_0) = N_0 L`: there one face lifts off.
#[test]
fn limits_tell_where_a_face_lifts_off() {
    let report = limits(&slide(&[]), &LimitsOptions::new("a=0..150 mm".parse().unwrap())).unwrap();
    let both = report.modes.iter().find(|mode| mode.pattern == "++--").unwrap();
    assert_close(both.to.unwrap(), GRIP * L / (Q + 2.0 * 0.1 * GRIP), 1.0, 1e-12);
    let at = |name: &str| both.reactions.iter().find(|reaction| reaction.contact == name).unwrap();
    let forces = ["plus", "minus"].map(|face| at(&format!("guide.front.{face}")).to.unwrap().abs());
    assert_close(forces[0] + forces[1], GRIP, GRIP, 1e-12);
    assert_close(forces[0].max(forces[1]), GRIP, GRIP, 1e-12);
    assert!(!both.to_at.is_empty());
    assert_eq!(both.joints[0].mode, "on both faces");
}

/// The play may tend to zero from below, and be it.
#[test]
fn a_press_fit_without_interference_is_a_fit_without_play() {
    let forces = |model: &Model| -> Vec<f64> {
        let report = report_with(model, &Settings::default());
        let solution = only(&report);
        let of_place = |place: &str| {
            let own = solution.contacts.iter().filter(|contact| contact.name.starts_with(place));
            own.map(|contact| contact.normal_force).sum::<f64>()
        };
        vec![of_place("guide.front"), of_place("guide.rear"), effort(solution)]
    };
    let of = |play: &str| forces(&slide(&[("play", play), ("a", "80 mm"), ("h", "10 mm"), ("W", "7 N")]));
    let [none, little, less] = ["0 mm", "-1e-5 mm", "-1e-6 mm"].map(of);
    for ((none, little), less) in none.iter().zip(&little).zip(&less) {
        assert_close(*little, *none, Q, 1e-12);
        assert_close(*less, *none, Q, 1e-12);
    }
    // Two rails, of which nothing but the play of one changes.
    let rails = |play: f64| {
        let pad = |k: usize| Pad {
            x: [0.2, -0.2][k % 2],
            mu: 0.3,
            preload: 1.0,
            clearance: if k < 2 { play } else { 1e-4 },
            compliance: 2e-5,
            misalignment: [0.0, 5e-5, 0.0, 0.0][k],
        };
        let carriage = Carriage {
            load: [-3.0, 8.0],
            at: [0.1, 0.25],
            mass: 3.0,
            moment: 0.2,
            rails: vec![(0.3, 0.01), (-0.3, 0.02)],
            contacts: (0..4).map(pad).collect(),
        };
        by_faces(&report_on(&carriage.text()), &carriage)
    };
    let [none, little] = [0.0, -1e-12].map(rails);
    assert_eq!((none.len(), little.len()), (1, 1));
    for ([plus, minus], [other_plus, other_minus]) in none[0].iter().zip(&little[0]) {
        assert_close(plus - minus, other_plus - other_minus, 10.0, 1e-6);
    }
}

/// What is varied may reach zero, but not pass it.
#[test]
fn play_that_changes_its_sign_is_no_range() {
    let options = LimitsOptions::new("play=-0.02 mm..0.02 mm".parse().unwrap());
    let report = limits(&slide(&[]), &options).unwrap();
    let without = report.without_mode_problem;
    assert_eq!(without.len(), 1);
    assert_close(without[0].from, 0.0, 1e-5, 1e-6);
    assert!(report.counts.iter().all(|count| count.solutions == 1));
    let (_, all) = sweep(&slide(&[]), "play=-0.02 mm..0.02 mm:5");
    let mut refused = 0;
    for (rows, row) in all.iter().flat_map(|rows| (0..rows.len()).map(move |row| (rows, row))) {
        let is_press_fit = rows.numbers(row)[0] <= 0.0;
        assert_eq!(rows.heads[row].solutions, u32::from(is_press_fit));
        refused += usize::from(!is_press_fit);
    }
    assert_eq!(refused, 2);
}

fn sweep(model: &Model, axis: &str) -> (Sweep, Vec<Rows>) {
    let sweep = Sweep::new(model, &SweepOptions::grid([axis.parse().unwrap()])).unwrap();
    let mut all = Vec::new();
    let mut state = sweep.start();
    sweep.run(&mut state, &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    (sweep, all)
}

/// Sweeps, curves of limits, efforts and sizes have the forces that `solve` has.
#[rstest]
#[case("mu", "0..0.6:7")]
#[case("a", "0..160 mm:9")]
#[case("play", "-0.04 mm..-0.01 mm:4")]
#[case("k", "0.1 MN/m..3 MN/m:4")]
#[case("friction", "0.5..2:4")]
fn other_questions_have_the_forces_of_solve(#[case] name: &str, #[case] range: &str) {
    let model = slide(&[("h", "10 mm"), ("W", "5 N")]);
    let (sweep, all) = sweep(&model, &format!("{name}={range}"));
    let mut compared = 0;
    for rows in &all {
        for row in 0..rows.len() {
            let numbers = rows.numbers(row);
            let (number, factor) =
                if name == "friction" { (0.1 * numbers[0], "mu") } else { (numbers[0], name) };
            let report = report_with(&model, &Settings::default().parameter(factor, number));
            let solution = only(&report);
            let column = |column: &str| {
                numbers[sweep.columns().iter().position(|other| other.name == column).unwrap()]
            };
            for contact in &solution.contacts {
                let [normal, friction] =
                    ["normal", "friction"].map(|kind| column(&format!("{kind}_force.{}", contact.name)));
                assert_close(normal, contact.normal_force, GRIP, 1e-9);
                assert_close(friction, contact.friction_force, GRIP, 1e-9);
            }
            compared += 1;
        }
    }
    assert!(compared >= 4);
}

#[test]
fn curves_sizes_and_efforts_have_the_forces_of_solve() {
    let model = slide(&[]);
    let vary = "a=0..100 mm";
    let (report, curves) = limits_with_curves(
        &model,
        &LimitsOptions::new(vary.parse().unwrap()).effort(0),
        Quantity::NormalForce,
    )
    .unwrap();
    assert_eq!(report.modes.len(), 2);
    for point in curves.forwards.iter().flat_map(|curve| &curve.points) {
        let pull = (Q + 4.0).max(Q / (1.0 - 2.0 * 0.1 * point.at / L));
        let normal = point.at * pull / L;
        for (series, found) in curves.series.iter().zip(&point.values) {
            let own = if series.name.contains("front") { normal } else { -normal };
            let sign = if series.name.ends_with("plus") { 1.0 } else { -1.0 };
            let share = 0.5 * (GRIP + sign * own);
            let expected = if normal > GRIP { (sign * own).max(0.0) } else { share };
            assert_close(*found, sign * expected, GRIP, 1e-9);
        }
    }
    // 24 N at a face: beyond the grip, a Q / (L (1 - 2 mu a / L)) = 24 N.
    let contact = Some("guide.front.plus".to_owned());
    let options = SizeOptions::new(vary.parse().unwrap(), 24.0).against(Against::NormalForce { contact });
    let sized = size(&model, &options).unwrap();
    let expected = 24.0 * L / (Q + 2.0 * 0.1 * 24.0);
    assert_eq!(sized.met.len(), 1);
    assert_close(sized.met[0].to, expected, L, 1e-9);
    assert_close(sized.present.margin.unwrap(), 0.5 * (GRIP + 10.8), GRIP, 1e-12);
    let driven = drive(&model, &DriveOptions::default()).unwrap();
    assert_close(driven.directions[0].solutions[0].efforts[0], Q + 4.0, Q, 1e-12);
    assert_close(driven.directions[1].solutions[0].efforts[0], Q - 4.0, Q, 1e-12);
}

/// Beyond `mu = L / (2 a)` nothing moves: every pixel has the class of its formula.
#[test]
fn a_map_of_friction_and_lever() {
    let options =
        MapOptions::new("mu=0.1..4".parse().unwrap(), "a=10 mm..200 mm".parse().unwrap()).size(9, 9);
    let mapped = map(&slide(&[]), &options).unwrap();
    let count = |class: usize| match &mapped.classes[class].meaning {
        ClassMeaning::Solutions { solutions, .. } => *solutions,
        ClassMeaning::Locked => 0,
        other => panic!("{other:?}"),
    };
    for (row, runs) in mapped.rows.iter().enumerate() {
        let classes: Vec<usize> = runs.iter().flat_map(|[class, length]| vec![*class; *length]).collect();
        for (column, class) in classes.iter().enumerate() {
            let at =
                |range: [f64; 2], pixel: usize| range[0] + (range[1] - range[0]) * (pixel as f64 + 0.5) / 9.0;
            let (mu, a) = (at([0.1, 4.0], column), at([0.01, 0.2], row));
            assert_eq!(count(*class), usize::from(2.0 * mu * a < L), "{mu} {a}");
        }
    }
}

/// The play lies within bounds: the pull does, too.
#[test]
fn a_grip_within_bounds() {
    let report = solved(&[("play", "-0.021 mm..-0.019 mm")]);
    let uncertainty = report.uncertainty.as_ref().unwrap();
    assert_eq!((uncertainty.least_solutions, uncertainty.most_solutions), (1, Some(1)));
    let bounds = uncertainty.modes[0].normal_force_bounds.as_ref().unwrap();
    for grip in [19.0, 21.0] {
        let normal = 0.04 * (Q + 0.2 * grip) / L;
        // Front and rear at the positive faces, front and rear at the negative ones.
        let forces = [grip + normal, grip - normal, -grip + normal, -grip - normal].map(|force| force / 2.0);
        for (force, [lower, upper]) in forces.iter().zip(bounds) {
            assert!(lower <= force && force <= upper, "{forces:?} {bounds:?}");
        }
    }
    let mixed = solved(&[("play", "-0.01 mm..0.005 mm")]);
    assert_eq!(mixed.uncertainty.unwrap().most_solutions, None);
}

/// What is pressed at each place in each solution: `N^+` and `-N^-`.
fn by_faces(report: &SolveReport, carriage: &Carriage) -> Vec<Vec<[f64; 2]>> {
    let place = |solution: &Solution, k: usize| {
        let end = match k % carriage.per_rail() {
            0 => "front",
            1 => "rear",
            _ => "pad2",
        };
        let name = format!("rail{}.{end}", k / carriage.per_rail());
        if carriage.contacts[k].clearance < 0.0 {
            faces(solution, &name)
        } else {
            let force = contact(solution, &name).normal_force;
            [force.max(0.0), force.min(0.0)]
        }
    };
    let of = |solution| (0..carriage.contacts.len()).map(|k| place(solution, k)).collect();
    sorted(report.solutions.iter().map(of).collect())
}

fn sorted(mut solutions: Vec<Vec<[f64; 2]>>) -> Vec<Vec<[f64; 2]>> {
    let sizes = |solution: &Vec<[f64; 2]>| -> Vec<f64> { solution.iter().flatten().copied().collect() };
    solutions.sort_by(|one, other| sizes(one).partial_cmp(&sizes(other)).unwrap());
    solutions
}

impl Carriage {
    /// All solutions of eq. (R3): each face of each contact is pressed or not, whatever the play. Unknown are the
    /// acceleration, `N^+` and `N^-` of each contact, and the small displacement and rotation of the body.
    fn solutions_by_faces(&self) -> Vec<(Vec<[f64; 2]>, f64)> {
        let count = self.contacts.len();
        (0..1_usize << (2 * count)).filter_map(|pattern| self.solution_by_faces(pattern)).collect()
    }

    /// The forces and `p` of the pattern whose bits are the pressed faces, if it has a solution.
    fn solution_by_faces(&self, pattern: usize) -> Option<(Vec<[f64; 2]>, f64)> {
        let count = self.contacts.len();
        let is_pressed = |face: usize| pattern >> face & 1 == 1;
        let size = 2 * count + 3;
        let (translation, rotation) = (size - 2, size - 1);
        let mut matrix = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        matrix[(0, 0)] = self.mass;
        right[0] = self.load[0];
        right[1] = self.load[1];
        right[2] = self.at[0] * self.load[1] - self.at[1] * self.load[0];
        let mut stiffness = [Matrix2::zeros(); 2];
        for face in 0..2 * count {
            let (pad, sign) = (&self.contacts[face / 2], if face % 2 == 0 { 1.0 } else { -1.0 });
            let (y, half) = self.rails[face / 2 / self.per_rail()];
            // N pushes the body along sign y at x; friction mu N along -x at y - sign h/2, the preload's at y.
            let arm = sign * pad.x + (y - sign * half) * pad.mu;
            matrix[(0, 1 + face)] = pad.mu;
            matrix[(1, 1 + face)] = -sign;
            matrix[(2, 1 + face)] = -arm;
            if face % 2 == 0 {
                right[0] -= pad.preload;
                right[2] += y * pad.preload;
            }
            let row = 3 + face;
            if is_pressed(face) {
                // sign d = -(delta + f N)
                matrix[(row, translation)] = sign;
                matrix[(row, rotation)] = sign * pad.x;
                matrix[(row, 1 + face)] = pad.compliance;
                right[row] = sign * pad.misalignment - pad.clearance;
                let gap = Vector2::new(sign, sign * pad.x).transpose() / pad.compliance;
                stiffness[0] += Vector2::new(sign, arm) * gap;
                stiffness[1] += Vector2::new(sign, sign * pad.x) * gap;
            } else {
                matrix[(row, 1 + face)] = 1.0;
            }
        }
        let solution = matrix.lu().solve(&right)?;
        let fits = (0..2 * count).all(|face| {
            let (pad, sign) = (&self.contacts[face / 2], if face % 2 == 0 { 1.0 } else { -1.0 });
            let deflection = solution[translation] + pad.x * solution[rotation] - pad.misalignment;
            if is_pressed(face) {
                solution[1 + face] >= 0.0
            } else {
                pad.clearance + sign * deflection >= 0.0
            }
        });
        let [with, without] = stiffness.map(|stiffness| stiffness.determinant());
        let force = |face: usize| if is_pressed(face) { solution[1 + face] } else { 0.0 };
        fits.then(|| ((0..count).map(|k| [force(2 * k), -force(2 * k + 1)]).collect(), with / without))
    }
}

/// One rail with two or three pads, or two rails with two each; clearances of either sign.
fn carriages() -> impl Strategy<Value = Carriage> {
    let pad = (0.0..1.5_f64, 0.0..3.0_f64, -3e-4..3e-4_f64, 5e-6..5e-5_f64, -3e-4..3e-4_f64);
    (
        proptest::collection::vec((-0.4..0.4_f64, 0.0..0.05_f64), 2),
        proptest::collection::vec(pad, 4),
        [-20.0..20.0_f64, -20.0..20.0],
        [-0.4..0.4_f64, -0.4..0.4],
        0..3_usize,
    )
        .prop_map(|(mut rails, pads, load, at, kind)| {
            let (used, per_rail) = [(1, 2), (1, 3), (2, 2)][kind];
            rails.truncate(used);
            let contact = |k: usize| {
                let (mu, preload, clearance, compliance, misalignment) = pads[k];
                // In a determinate carriage misalignment and play change nothing.
                let x = [0.2, -0.2, 0.05][k % per_rail] + 0.02 * (k / per_rail) as f64;
                let clearance = if kind == 0 { -clearance.abs() } else { clearance };
                Pad { x, mu, preload, clearance, compliance, misalignment }
            };
            let contacts = (0..used * per_rail).map(contact).collect();
            Carriage { load, at, mass: 3.0, moment: 0.2, rails, contacts }
        })
}

proptest! {
    #![proptest_config(cases(80))]

    /// The same lists as two pairs for every contact, the same `p`, and verdicts that agree with its sign.
    #[test]
    fn random_carriages_have_the_solutions_of_both_faces(carriage in carriages()) {
        let report = report_on(&carriage.text());
        prop_assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
        let expected = carriage.solutions_by_faces();
        let found = by_faces(&report, &carriage);
        let forces = sorted(expected.iter().map(|(forces, _)| forces.clone()).collect());
        prop_assert_eq!(found.len(), forces.len(), "{:?}\n{:?}", &found, &forces);
        for (found, expected) in found.iter().zip(&forces) {
            let scale = expected.iter().flatten().map(|force| force.abs()).fold(0.0, f64::max);
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                prop_assert!((found - expected).abs() <= 1e-8 * scale, "{} {}", found, expected);
            }
        }
        let ordered = |mut determinants: Vec<f64>| {
            determinants.sort_by(f64::total_cmp);
            determinants
        };
        let found = ordered(report.solutions.iter().map(|solution| solution.oriented_determinant).collect());
        let expected = ordered(expected.iter().map(|(_, determinant)| *determinant).collect());
        for (found, expected) in found.iter().zip(&expected) {
            prop_assert!((found - expected).abs() <= 1e-7 * (1.0 + expected.abs()), "{} {}", found, expected);
        }
        for solution in &report.solutions {
            let verdict = solution.attainability.verdict;
            let known = matches!(verdict, Verdict::Attainable | Verdict::Unattainable | Verdict::Flutter);
            prop_assert!(known, "{:?}", solution.attainability);
            prop_assert!(solution.oriented_determinant > 0.0 || verdict == Verdict::Unattainable);
        }
    }
}

fn kinds(faults: &Faults) -> Vec<FaultKind> {
    faults.sorted().iter().map(|fault| fault.kind.clone()).collect()
}

#[test]
fn press_fits_without_a_law_are_refused() {
    let refused = |from: &str, to: &str| {
        assert!(SLIDE.contains(from));
        let text = SLIDE.replace(from, to);
        assert!(!check(&Model::parse(&text).unwrap()).unwrap().sound);
        kinds(&try_report_on(&text).unwrap_err())
    };
    let places = |contacts: &[String]| contacts == ["guide.front", "guide.rear"];
    let without = refused("stiffness = \"k\"\n", "");
    assert!(matches!(&without[..], [FaultKind::PressFitWithoutStiffness { contacts }] if places(contacts)));
    let one = refused("stiffness = \"k\"\n", "front = { stiffness = \"k\" }\n");
    assert!(
        matches!(&one[..], [FaultKind::PressFitWithoutStiffness { contacts }] if contacts == &["guide.rear"])
    );
    let guided = refused("block_slider", "guided_slider");
    assert!(matches!(&guided[..], [FaultKind::GuidedPressFit { contacts }] if contacts == &["guide"]));
    let preload = refused("stiffness = \"k\"\n", "stiffness = \"k\"\npreload = { plus = 3, minus = 4 }\n");
    assert!(matches!(&preload[..], [FaultKind::PreloadOfPressFit { contacts }] if places(contacts)));
}

#[test]
fn questions_about_motions_and_bounds_are_refused() {
    let model = slide(&[]);
    let refusals = [
        simulate(&model, &SimulateOptions::new(1.0)).unwrap_err(),
        limits(&model, &LimitsOptions::new("mu=0..1".parse().unwrap()).max_reaction(10.0)).unwrap_err(),
    ];
    for faults in &refusals {
        assert!(matches!(&kinds(faults)[..], [FaultKind::PressFit { .. }]), "{faults}");
    }
}

/// Half of the preload rubs at each face, that is all of it in the middle.
#[test]
fn a_preload_adds_to_the_grip() {
    let text = SLIDE.replace("stiffness = \"k\"\n", "stiffness = \"k\"\npreload = \"3 N\"\n");
    for (a, lever) in [("40 mm", 0.04), ("100 mm", 0.1)] {
        let model = Model::parse(&text).unwrap();
        let report = report_with(&model, &parameters(&[("a", a), ("h", "10 mm")]));
        let solution = only(&report);
        // N L = a P: the friction of the pressure has the moments mu h N / 2 and -mu h N / 2.
        let friction = 6.0 + 0.2 * GRIP.max(contact(solution, "guide.front.plus").normal_force);
        let pull = Q + friction;
        let normal: f64 = faces(solution, "guide.front").iter().sum();
        assert_close(effort(solution), if normal < GRIP { Q + 6.0 + 4.0 } else { pull }, Q, 1e-12);
        assert_close(normal, lever * effort(solution) / L, GRIP, 1e-12);
        assert!(report.preload_gap_states.is_empty());
    }
}

/// The drawer of the gallery with a press fit of 0.01 mm on its left rail and 0.6 mm of play on its right one, at
/// `mu = 1`: the wedged state is a threshold, as with play. With `S = N_L + N_R` and `D = N_L - N_R = k (delta_R -
/// delta_L)`,
///
/// ```text
/// S L = a (Q + 2 mu S) - 2 mu (B/2) D
/// ```
#[test]
fn a_drawer_wedges_beside_a_press_fit() {
    let report =
        report("drawer-on-two-rails", &[("mu", "1"), ("play_left", "-0.01 mm"), ("play_right", "0.6 mm")]);
    assert_eq!(report.complete, Proof::Proven);
    assert_eq!(report.solutions.len(), 2);
    let wedged = report.solutions.iter().position(|solution| !solution.pattern.contains('0')).unwrap();
    let sliding = 1 - wedged;
    let difference = 50e3 * (0.3e-3 + 0.005e-3);
    let sum = (0.25 * 10.0 - 0.6 * difference) / (0.4 - 0.5);
    let [left, right] = [f64::midpoint(sum, difference), f64::midpoint(sum, -difference)];
    let solution = &report.solutions[wedged];
    for (name, force) in [
        ("left.front.plus", left),
        ("left.rear.minus", -left),
        ("left.front.minus", 0.0),
        ("left.rear.plus", 0.0),
        ("right.front", right),
        ("right.rear", -right),
    ] {
        assert_close(contact(solution, name).normal_force, force, left, 1e-12);
    }
    let mut fates = solution.attainability.separates.unwrap();
    fates.sort_by_key(|fate| *fate == Fate::Jamming);
    assert_eq!(fates, [Fate::Solution(sliding + 1), Fate::Jamming]);
    assert_eq!(report.solutions[sliding].attainability.verdict, Verdict::Attainable);
}
