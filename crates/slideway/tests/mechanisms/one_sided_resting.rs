//! Contacts that may lift off and do not slide at the start: the states that `solve` finds, against
//! `reference/one-sided-rest.toml` and against every native state of random systems in descriptor form.
//!
//! Unknowns are accelerations, hinge forces, the normal force and the friction of every contact along its u, and efforts. A
//! corner sticks (`g'' = 0`, `v_t' = 0`), slips (`g'' = 0`, `T = -mu N s`) or is open (`N = T = 0`).

use crate::answers::{contact, report_on};
use crate::one_sided_systems::{Contact, System, many, random};
use crate::random_mechanisms::cases;
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::collection::vec;
use proptest::prelude::*;
use rstest::rstest;
use serde::Deserialize;
use slideway::fault::FaultKind;
use slideway::model::{Model, Settings};
use slideway::modes::{ModeSolution, SearchOptions, search};
use slideway::report::{Proof, Report, Solution, SolveReport, Status, Verdict};
use slideway::solve::{exact_mode_problem, solve};
use slideway::{HoldOptions, hold};
use std::ops::ControlFlow;

const REFERENCE: &str = include_str!("../../../../reference/one-sided-rest.toml");
const BOX: &str = include_str!("../../models/box-on-incline.toml");
const LADDER: &str = include_str!("../../models/ladder.toml");

#[derive(Deserialize)]
struct Reference {
    rest: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    #[serde(flatten)]
    system: System,
    states: Vec<Native>,
}

/// What belongs to each contact: normal force, friction along u, accelerations of gap and sliding.
#[derive(Debug, Clone, Deserialize)]
struct Native {
    #[serde(rename = "N")]
    normal: Vec<f64>,
    #[serde(rename = "T")]
    friction: Vec<f64>,
    gap: Vec<f64>,
    a: Vec<f64>,
    /// The condition number of its equations, where they were set up.
    #[serde(skip)]
    condition: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Does {
    Sticks,
    Rubs(f64),
    Opens,
}

/// The states of a contact: what it does, and the side that presses.
fn options(system: &System, k: usize) -> Vec<(Does, f64)> {
    let contact = &system.contacts[k];
    let sign = system.sliding_velocity(contact).signum();
    match contact.kind.as_str() {
        "resting" => {
            vec![(Does::Sticks, 1.0), (Does::Rubs(1.0), 1.0), (Does::Rubs(-1.0), 1.0), (Does::Opens, 1.0)]
        }
        "sliding" => vec![(Does::Rubs(sign), 1.0), (Does::Opens, 1.0)],
        "holding" => {
            let does = [Does::Sticks, Does::Rubs(1.0), Does::Rubs(-1.0)];
            does.into_iter().flat_map(|does| [(does, 1.0), (does, -1.0)]).collect()
        }
        _ => vec![(Does::Rubs(sign), 1.0), (Does::Rubs(sign), -1.0)],
    }
}

/// The equations of a pattern.
fn equations(system: &System, pattern: &[(Does, f64)]) -> (DMatrix<f64>, DVector<f64>) {
    let (bodies, hinges, contacts) = (3 * system.bodies.len(), 2 * system.hinges.len(), pattern.len());
    let size = bodies + hinges + 2 * contacts + system.drives.len();
    let (mut matrix, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    for (index, body) in system.bodies.iter().enumerate() {
        for (part, inertia) in [body.m, body.m, body.moment].into_iter().enumerate() {
            matrix[(3 * index + part, 3 * index + part)] = inertia;
        }
        (0..2).for_each(|axis| right[3 * index + axis] = body.m * system.gravity[axis]);
    }
    for force in &system.forces {
        let mut wrench = system.place(&force.body, force.at, Vector2::from(force.components));
        if let Some(body) = system.body(&force.body) {
            wrench[3 * body + 2] += force.couple;
        }
        right.iter_mut().zip(&wrench).for_each(|(own, part)| *own += part);
    }
    let mut constrain = |at: usize, row: &DVector<f64>, value: f64| {
        matrix.view_mut((at, 0), (1, bodies)).copy_from(&row.transpose());
        right[at] = value;
    };
    let mut forces: Vec<(usize, DVector<f64>)> = Vec::new();
    let mut frictions: Vec<(usize, usize, f64)> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for (index, hinge) in system.hinges.iter().enumerate() {
        for (part, axis) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
            let [a, b] = hinge.between.each_ref();
            let row = system.place(a, hinge.at, axis) - system.place(b, hinge.at, axis);
            let at = bodies + 2 * index + part;
            constrain(
                at,
                &row,
                system.centripetal(b, hinge.at, axis) - system.centripetal(a, hinge.at, axis),
            );
            forces.push((at, row));
        }
    }
    for (k, (contact, (does, side))) in system.contacts.iter().zip(pattern).enumerate() {
        let (at, tangential) = (bodies + hinges + 2 * k, bodies + hinges + 2 * k + 1);
        let [normal, tangent] = [contact.normal(), contact.tangent()];
        forces.push((at, system.relative(contact, normal)));
        forces.push((tangential, system.relative(contact, tangent)));
        if *does == Does::Opens {
            open.extend([at, tangential]);
            continue;
        }
        constrain(at, &system.relative(contact, normal), -system.gap_of_velocities(contact));
        if let Does::Rubs(sign) = does {
            frictions.push((tangential, at, contact.mu * sign * side));
        } else {
            let own = |body: &str| system.centripetal(body, contact.at, tangent);
            let row = system.relative(contact, tangent);
            constrain(tangential, &row, own(&contact.guide) - own(&contact.body));
        }
    }
    for (index, drive) in system.drives.iter().enumerate() {
        let at = bodies + hinges + 2 * contacts + index;
        let [direction, along] =
            [drive.direction, drive.force_along].map(|axis| Vector2::from(axis).normalize());
        forces.push((at, system.place(&drive.body, drive.force_at, along)));
        let row = system.place(&drive.body, drive.at, direction);
        constrain(at, &row, drive.acceleration - system.centripetal(&drive.body, drive.at, direction));
    }
    for (at, force) in forces {
        matrix.view_mut((0, at), (bodies, 1)).copy_from(&-force);
    }
    for (row, normal, factor) in frictions {
        (matrix[(row, row)], matrix[(row, normal)]) = (1.0, factor);
    }
    open.into_iter().for_each(|at| matrix[(at, at)] = 1.0);
    (matrix, right)
}

/// All states that are isolated, and whether some pattern leaves forces open; nothing where rounding may decide about a state.
fn native_states(system: &System) -> Option<(Vec<Native>, bool)> {
    let (bodies, hinges) = (3 * system.bodies.len(), 2 * system.hinges.len());
    let contacts = &system.contacts;
    let mut patterns: Vec<Vec<(Does, f64)>> = vec![Vec::new()];
    for k in 0..contacts.len() {
        let options = options(system, k);
        patterns = patterns
            .into_iter()
            .flat_map(|pattern| options.iter().map(move |one| [pattern.clone(), vec![*one]].concat()))
            .collect();
    }
    let (mut states, mut leaves_open) = (Vec::new(), false);
    for pattern in patterns {
        let (matrix, right) = equations(system, &pattern);
        let singular = matrix.clone().singular_values();
        if singular.min() < 1e-11 * singular.max() {
            leaves_open = true;
            continue;
        }
        if singular.min() < 1e-4 * singular.max() {
            return None;
        }
        let condition = singular.max() / singular.min();
        let unknowns = matrix.lu().solve(&right)?;
        let of = |k: usize, part: usize| unknowns[bodies + hinges + 2 * k + part];
        let normal: Vec<f64> = (0..contacts.len()).map(|k| of(k, 0)).collect();
        let friction: Vec<f64> = (0..contacts.len()).map(|k| of(k, 1)).collect();
        let moves =
            |k: usize, axis: Vector2<f64>| system.relative(&contacts[k], axis).dot(&unknowns.rows(0, bodies));
        let gap = |k: usize| moves(k, contacts[k].normal()) + system.gap_of_velocities(&contacts[k]);
        let slip = |k: usize| {
            let axis = contacts[k].tangent();
            let own = |body: &str| system.centripetal(body, contacts[k].at, axis);
            moves(k, axis) + own(&contacts[k].body) - own(&contacts[k].guide)
        };
        let sizes = [1.0, 1.0].map(|one: f64| normal.iter().fold(one, |size, force| size.max(force.abs())));
        let mut slacks = Vec::new();
        for (k, (does, side)) in pattern.iter().enumerate() {
            match does {
                Does::Opens => slacks.push(gap(k)),
                Does::Sticks => {
                    let limit = contacts[k].mu_static.unwrap_or(contacts[k].mu) * normal[k].abs();
                    slacks
                        .extend([side * normal[k], limit - friction[k].abs()].map(|slack| slack / sizes[0]));
                }
                Does::Rubs(sign) => {
                    slacks.push(side * normal[k] / sizes[1]);
                    if contacts[k].rests() || contacts[k].kind == "holding" {
                        slacks.push(sign * slip(k));
                    }
                }
            }
        }
        let least = slacks.iter().copied().fold(f64::INFINITY, f64::min);
        if least.abs() < 1e-6 || least.is_nan() {
            return None;
        }
        if least > 0.0 {
            let open = |k: usize| pattern[k].0 == Does::Opens;
            states.push(Native {
                gap: (0..contacts.len()).map(|k| if open(k) { gap(k) } else { 0.0 }).collect(),
                a: unknowns.rows(0, bodies).iter().copied().collect(),
                normal,
                friction,
                condition,
            });
        }
    }
    Some((states, leaves_open))
}

fn is(solution: &Solution, system: &System, state: &Native, tolerance: f64) -> bool {
    let near = |found: Vec<f64>, expected: &[f64]| {
        let size = expected.iter().map(|value| value.abs()).fold(1.0, f64::max);
        found.iter().zip(expected).all(|(found, value)| (found - value).abs() <= tolerance * size)
    };
    let contacts = || system.contacts.iter().map(|one| contact(solution, &one.name));
    let accelerations = solution
        .bodies
        .iter()
        .flat_map(|body| [body.acceleration[0], body.acceleration[1], body.angular_acceleration]);
    near(contacts().map(|contact| contact.normal_force).collect(), &state.normal)
        && near(contacts().map(|contact| -contact.friction_force).collect(), &state.friction)
        && near(contacts().map(|contact| contact.gap_acceleration.unwrap_or(0.0)).collect(), &state.gap)
        && near(accelerations.collect(), &state.a)
}

fn assert_states(report: &SolveReport, system: &System, states: &[Native], tolerance: f64, name: &str) {
    let text = || format!("{name}: {states:#?}\n{:#?}\n{}", report.solutions, system.text());
    assert_eq!(report.solutions.len(), states.len(), "{}", text());
    for state in states {
        let found = report.solutions.iter().filter(|solution| is(solution, system, state, tolerance));
        assert_eq!(found.count(), 1, "{}", text());
    }
}

#[test]
fn the_reference_starts_in_these_states() {
    for Case { name, system, states } in reference().rest {
        let report = report_on(&system.text());
        assert_states(&report, &system, &states, 1e-8, &name);
        assert!(report.solutions.iter().all(|solution| solution.residual < 1e-11), "{name}");
    }
}

fn reference() -> Reference {
    toml::from_str(REFERENCE).unwrap()
}

/// Eigenvalues of `M x'' = -sum (n - mu s t) k n.x - sum t k t.x` over the closed contacts and those that stick, with unit stiffness:
/// as many as there are springs, ascending. Nothing where a joint or drive is rigid besides, or two are too near to each other.
fn spring_eigenvalues(system: &System, solution: &Solution) -> Option<Vec<f64>> {
    let size = 3 * system.bodies.len();
    if !system.hinges.is_empty() || !system.drives.is_empty() {
        return None;
    }
    let mut stiffness = DMatrix::<f64>::zeros(size, size);
    let mut springs = 0;
    for one in &system.contacts {
        let found = contact(solution, &one.name);
        if found.gap_acceleration.is_some() {
            continue;
        }
        let [normal, tangent] = [one.normal(), one.tangent()].map(|axis| system.relative(one, axis));
        let slip = found.friction_force / (one.mu * found.normal_force.abs());
        let words = &solution.joints.iter().find(|joint| joint.name == one.name).unwrap().mode;
        springs += 1;
        if words.ends_with("sticks") || words.ends_with("does not slip") {
            springs += 1;
            stiffness += &normal * normal.transpose() + &tangent * tangent.transpose();
        } else {
            let friction =
                if one.mu == 0.0 { 0.0 } else { one.mu * slip.signum() * found.normal_force.signum() };
            stiffness += (&normal - tangent * friction) * normal.transpose();
        }
    }
    let inertia = system.bodies.iter().flat_map(|body| [body.m, body.m, body.moment]);
    let inertia = DVector::from_iterator(size, inertia);
    let matrix = DMatrix::from_fn(size, size, |row, column| stiffness[(row, column)] / inertia[row]);
    let mut values: Vec<f64> = matrix.complex_eigenvalues().iter().map(|value| value.re).collect();
    values.sort_by(|one, other| other.abs().total_cmp(&one.abs()));
    values.truncate(springs);
    values.sort_by(f64::total_cmp);
    let is_near = |pair: &[f64]| pair[1] - pair[0] < 1e-3 * pair[1].abs();
    (!values.windows(2).any(is_near)).then_some(values)
}

/// Holds each solution that is examined to have these eigenvalues.
fn assert_springs(report: &SolveReport, system: &System) -> usize {
    let mut compared = 0;
    for solution in &report.solutions {
        let found = &solution.attainability;
        let Some(expected) = spring_eigenvalues(system, solution) else { continue };
        if found.eigenvalues.len() != expected.len() {
            assert!(found.eigenvalues.is_empty(), "{expected:?} {found:?}\n{}", system.text());
            continue;
        }
        compared += 1;
        for ([value, _], expected) in found.eigenvalues.iter().zip(&expected) {
            assert!(
                (value - expected).abs() < 1e-6 * expected.abs(),
                "{expected:?} {found:?}\n{}",
                system.text()
            );
        }
        let stable = expected.iter().all(|value| *value > 0.0);
        assert_eq!(found.verdict == Verdict::Unattainable, !stable, "{found:?}\n{}", system.text());
    }
    compared
}

/// Holds the states to be those of the mode problem of which a proof is written, each once; it has none with a second law of
/// friction, or where forces may be left open.
fn assert_as_mode_problem(report: &SolveReport, system: &System, leaves_open: bool) {
    let problem = exact_mode_problem(&Model::parse(&system.text()).unwrap());
    if leaves_open || system.contacts.iter().any(|contact| contact.mu_static.is_some()) {
        assert!(problem.is_err(), "{}", system.text());
        assert_eq!(report.complete, Proof::NotProven, "{}", system.text());
        return;
    }
    let found = search(&problem.unwrap(), &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
    let found = found.lists(100, 16).solutions;
    let text = || format!("{found:#?}\n{:#?}\n{}", report.solutions, system.text());
    assert_eq!(found.len(), report.solutions.len(), "{}", text());
    assert_eq!(report.complete, Proof::Proven, "{}", text());
    for solution in &report.solutions {
        let size = solution.contacts.iter().map(|one| one.normal_force.abs()).fold(1.0, f64::max);
        let is_same = |other: &&ModeSolution| {
            solution.contacts.iter().zip(&other.normal_force).all(|(one, force)| {
                let force = if one.gap_acceleration.is_some() { force.max(0.0) } else { *force };
                (one.normal_force - force).abs() < 1e-7 * size
            })
        };
        assert!(found.iter().any(|other| is_same(&other)), "{}", text());
    }
}

/// An odd number of states where all contacts are at rest and no drive acts (theory, section 12).
fn is_at_rest(system: &System) -> bool {
    let rests = |contact: &Contact| contact.rests() || contact.kind == "holding" || contact.mu == 0.0;
    system.drives.is_empty() && system.contacts.iter().all(rests)
}

proptest! {
    #![proptest_config(many(400))]

    /// One or two bodies whose corners are at rest, slide or are pins in slots, which slide, are at rest or smooth.
    #[test]
    fn random_systems_start_in_their_native_states(
        numbers in vec(-1.0_f64..1.0, 60),
        two in any::<bool>(),
        hinged in any::<bool>(),
        driven in any::<bool>(),
        slides in any::<bool>(),
        rough in any::<bool>(),
        more in 0..2_usize,
    ) {
        let (bodies, contacts) = if two { (2, 2 + more) } else { (1, 1 + more) };
        let Some(mut system) = random(&numbers, bodies, contacts, [hinged, driven && slides]) else { return Ok(()) };
        for (k, contact) in system.contacts.iter_mut().enumerate() {
            if contact.kind == "bilateral" && !slides && rough {
                contact.kind = "holding".to_owned();
            } else if contact.kind == "bilateral" && !slides {
                contact.mu = 0.0;
            } else if contact.kind == "sliding" && (k == 0 || !slides) {
                contact.kind = "resting".to_owned();
                contact.mu_static = Some(contact.mu * (1.0 + 0.2 * (1.0 + numbers[k]))).filter(|_| more == 0);
            }
        }
        let rates = if slides { numbers.clone() } else { vec![0.0; 6] };
        let Some(system) = system.with_rates(rates.into_iter()) else { return Ok(()) };
        prop_assume!(system.contacts.iter().any(Contact::rests));
        // Of random velocities that nearly all is taken from, rounding is a part that counts as sliding.
        let fastest = system.bodies.iter().flat_map(|body| body.velocity).fold(0.0_f64, |most, v| most.max(v.abs()));
        prop_assume!(fastest == 0.0 || fastest > 1e-3);
        let rows = system.rows_with_drives();
        let values = DMatrix::from_columns(&rows).singular_values();
        prop_assume!(system.joint_rows().len() < 3 * bodies && rows.len() <= 3 * bodies);
        prop_assume!(values.min() > 0.05 * values.max());
        let slides = |one: &Contact| {
            one.rests() || one.kind == "holding" || one.mu == 0.0 || system.sliding_velocity(one).abs() > 1e-3
        };
        prop_assume!(system.contacts.iter().all(slides));
        let Some((states, leaves_open)) = native_states(&system) else { return Err(TestCaseError::reject("rounding")) };
        let report = report_on(&system.text());
        prop_assert!(!report.at_rest.is_empty(), "{}", system.text());
        prop_assert!(leaves_open || report.continua.is_empty(), "{}", system.text());
        assert_states(&report, &system, &states, 1e-7, "random");
        let worst = states.iter().map(|state| state.condition).fold(1.0, f64::max);
        for solution in &report.solutions {
            prop_assert!(solution.residual < system.rounding(worst), "{} {worst}\n{}", solution.residual, system.text());
        }
        assert_springs(&report, &system);
        assert_as_mode_problem(&report, &system, leaves_open);
        if report.every_load_has_one_state == Some(true) {
            prop_assert_eq!((states.len(), leaves_open), (1, false), "{}", system.text());
        }
        if !leaves_open && is_at_rest(&system) && system.contacts.iter().all(|one| one.mu_static.is_none()) {
            prop_assert_eq!(states.len() % 2, 1, "{}", system.text());
        }
    }
}

proptest! {
    #![proptest_config(cases(200))]

    /// A block whose centre of mass, load and friction are arbitrary: an odd number of states; one, where it is said that every
    /// load has one.
    #[test]
    fn a_block_at_rest_has_an_odd_number_of_states(
        place in [-0.3_f64..0.3, 0.02_f64..0.5],
        load in [-20.0_f64..20.0, -20.0_f64..20.0, -4.0_f64..4.0],
        mu in 0.05_f64..4.0,
    ) {
        let text = BOX.replace("rate = \"-1 m/s\"", "").replace(
            "C = [\"-h/2*sin(slope)\", \"h/2*cos(slope)\"]",
            &format!("C = {place:?}"),
        );
        let push = format!(
            "[loads.push]\ntype = \"force\"\nat = \"box.C\"\ncomponents = [{:?}, {:?}]\n[loads.turn]\ntype = \"torque\"\nbody = \"box\"\nmoment = {:?}\n",
            load[0], load[1], load[2]
        );
        let report = at_rest(&(text + &push), &[("slope", "0 deg"), ("mu", &mu.to_string())]);
        prop_assume!(report.solutions.iter().all(|solution| !solution.on_boundary));
        prop_assert_eq!(report.solutions.len() % 2, 1, "{:#?}", report.solutions);
        if report.every_load_has_one_state == Some(true) {
            prop_assert_eq!(report.solutions.len(), 1);
        }
    }
}

fn at_rest(text: &str, list: &[(&str, &str)]) -> SolveReport {
    let settings = list.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    solve(&Model::parse(text).unwrap().with(&settings).unwrap()).unwrap()
}

/// A box on an incline tips, tips while it slides, or stays: the numbers of the reference.
#[test]
fn a_box_starts_as_the_reference_says() {
    let text = BOX.replace("rate = \"-1 m/s\"", "");
    let tips = at_rest(&text, &[("b", "100 mm"), ("slope", "25 deg"), ("mu", "0.8")]);
    assert_eq!(
        tips.answer(),
        "It tips: base on its left corner, sticks. Whatever the loads, only one thing can happen."
    );
    let rear = contact(&tips.solutions[0], "base.rear");
    assert!(
        (rear.normal_force - 9.230_261_503).abs() < 1e-8
            && (rear.friction_force + 2.788_356_701).abs() < 1e-8
    );
    let front = contact(&tips.solutions[0], "base.front");
    assert!((front.gap_acceleration.unwrap() - 0.678_764_223_5).abs() < 1e-8);
    let both = at_rest(&text, &[("b", "100 mm"), ("slope", "40 deg"), ("mu", "0.3")]);
    assert_eq!(both.status, Status::One);
    assert!((contact(&both.solutions[0], "base.rear").normal_force - 7.789_831_206).abs() < 1e-8);
    assert!(
        (contact(&both.solutions[0], "base.front").gap_acceleration.unwrap() - 0.549_870_438_1).abs() < 1e-8
    );
    let stays = at_rest(&text, &[]);
    assert_eq!(stays.answer(), "It holds. Whatever the loads, only one thing can happen.");
    assert!(stays.solutions[0].coordinates[0].acceleration.abs() < 1e-12);
    assert_eq!(stays.solutions[0].oriented_determinant.signum(), 1.0);
}

/// Painlevé's rod of the reference at rest: one state for every load up to the critical friction 4/3.
#[test]
fn a_rod_at_rest_has_one_state_for_every_load_up_to_the_critical_friction() {
    let mut system = reference().rest.remove(0).system;
    for (mu, unique) in [(1.333, true), (1.334, false)] {
        system.contacts[0].mu = mu;
        let report = report_on(&system.text());
        assert_eq!(report.every_load_has_one_state, Some(unique), "{mu}");
        assert!(!unique || report.solutions.len() == 1);
    }
}

/// A box on a cart that is braked while it runs: it tips over its front edge.
#[test]
fn a_box_on_a_braked_cart_tips() {
    let report = at_rest(CART, &[]);
    let [solution] = report.solutions.as_slice() else { panic!("{report:?}") };
    let found = |name: &str| contact(solution, name).normal_force;
    assert!(
        (found("rail.rear") - 23.972_297_3).abs() < 1e-7
            && (found("rail.front") - 36.295_270_27).abs() < 1e-7
    );
    assert!((found("base.front") - 21.027_567_57).abs() < 1e-7 && found("base.rear") == 0.0);
    assert!((contact(solution, "base.rear").gap_acceleration.unwrap() - 1.407_567_568).abs() < 1e-8);
    assert!((solution.coordinates[0].acceleration + 6.440_608_108).abs() < 1e-8);
}

const CART: &str = r#"
gravity = "9.81 m/s^2"
[points]
C = [0, -0.05]
B = [0, 0.2]
brake = [0, -0.08]
[bodies.cart]
points = ["C", "brake"]
mass = 4
moment_of_inertia = 0.1
centre_of_mass = "C"
[bodies.box]
points = ["B"]
mass = 2
moment_of_inertia = 0.02833333333333334
centre_of_mass = "B"
[joints.rail]
type = "block_slider"
block = "cart"
at = [0, -0.1]
along = "0 deg"
length = 0.4
mu = 0.05
[joints.base]
type = "block_on_face"
block = "box"
guide = "cart"
at = [0, 0]
along = "0 deg"
length = 0.1
mu = 0.6
[loads.brake]
type = "force"
at = "cart.brake"
components = [-30, 0]
[coordinates.x]
slide = "rail"
rate = 1
[coordinates.y]
slide = "base"
rate = 0
"#;

/// Both ends of the ladder stick: three equations for four forces, whose ends are those of `hold`.
#[test]
fn the_forces_of_a_ladder_are_a_continuum() {
    let report = at_rest(LADDER, &[]);
    assert_eq!((report.status, report.solutions.len(), report.continua.len()), (Status::Continuum, 0, 1));
    let vertices: Vec<f64> = report.continua[0].vertices.iter().map(|forces| forces[0]).collect();
    let least = vertices.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = vertices.iter().copied().fold(0.0, f64::max);
    assert!((least - 817.726_924_8).abs() < 1e-6 && (greatest - 975.379_260_7).abs() < 1e-6, "{vertices:?}");
}

/// The same cart at rest, pulled by F: it stays up to `mu (M + m) g`, and beyond takes the box with it, which neither slides
/// (`x'' < mu_box g`) nor tips (`x'' < (b/2)/c g`).
#[rstest]
#[case(2.0, "rail: flat on the lower guide, sticks", 0.0)]
#[case(10.0, "rail: flat on the lower guide, cart slides along (1, 0)", (10.0 - 0.05 * 6.0 * GRAVITY) / 6.0)]
fn a_cart_at_rest_starts_with_its_box(#[case] force: f64, #[case] words: &str, #[case] expected: f64) {
    let text = CART.replace("rate = 1", "rate = 0").replace("[-30, 0]", &format!("[{force}, 0]"));
    let report = report_on(&text);
    let [solution] = report.solutions.as_slice() else { panic!("{report:?}") };
    let rail = solution.joints.iter().find(|joint| joint.name == "rail").unwrap();
    assert_eq!(format!("rail: {}", rail.mode), words);
    assert!((solution.coordinates[0].acceleration - expected).abs() < 1e-9);
    // Six states of a contact with two faces meet where it presses neither: nothing is said about every load.
    assert_eq!(report.every_load_has_one_state, None);
}

/// What the guide of a block with a height carries at both of its faces is a range if it sticks; guided sliders at rest are refused,
/// and so are three corners on a line.
#[test]
fn what_else_rests_is_a_range_or_refused() {
    let cart = CART.replace("rate = 1", "rate = 0");
    let high = cart.replace("length = 0.4", "length = 0.4\nheight = 0.02");
    // A torque that presses the front of the rail down and its rear up: friction at each face is free within its own limit.
    let torque = "[loads.turn]\ntype = \"torque\"\nbody = \"cart\"\nmoment = -60\n[loads.brake]";
    let high = high.replace("[loads.brake]", torque).replace("[-30, 0]", "[-1, 0]");
    let report = report_on(&high);
    assert_eq!((report.status, report.continua.len()), (Status::Continuum, 1), "{report:?}");
    let held: Vec<&str> = report.continua[0].held.iter().map(|held| held.name.as_str()).collect();
    assert_eq!(held, ["rail.front", "rail.rear", "base.front", "base.rear"]);
    for rail in &report.continua[0].held[..2] {
        let [least, greatest] = [f64::min, f64::max].map(|of| rail.at.iter().copied().fold(rail.at[0], of));
        assert!(greatest - least > 1.0, "{rail:?}");
    }
    // A drive holds the cart against 30 N: friction of the rail is free within mu (M + m) g, and so is the effort.
    let drive = "[drives.keeper]\ncoordinate = \"x\"\nforce = { at = \"cart.C\", direction = \"0 deg\" }\n";
    let report = report_on(&(cart.clone() + drive));
    assert_eq!((report.status, report.continua.len()), (Status::Continuum, 1), "{report:?}");
    let efforts: Vec<f64> = report.continua[0].motion.iter().map(|motion| motion.efforts[0]).collect();
    let [least, greatest] = [f64::min, f64::max].map(|of| efforts.iter().copied().fold(efforts[0], of));
    let free = 0.05 * 6.0 * GRAVITY;
    assert!((least - (30.0 - free)).abs() < 1e-8 && (greatest - (30.0 + free)).abs() < 1e-8, "{efforts:?}");
    let guided = cart.replace("type = \"block_slider\"", "type = \"guided_slider\"");
    let faults = solve(&Model::parse(&guided).unwrap()).unwrap_err();
    let kinds: Vec<&FaultKind> = faults.sorted().iter().map(|fault| &fault.kind).collect();
    assert!(matches!(kinds.as_slice(), [FaultKind::ZeroSlidingVelocity { .. }]), "{faults}");
    let third = "[joints.third]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = \"M\"\nalong = \"slope\"\nmu = 0.1\n[coordinates.x]";
    let faults = solve(
        &Model::parse(&BOX.replace("rate = \"-1 m/s\"", "").replace("[coordinates.x]", third)).unwrap(),
    );
    let faults = faults.unwrap_err();
    let kinds: Vec<&FaultKind> = faults.sorted().iter().map(|fault| &fault.kind).collect();
    assert!(matches!(kinds.as_slice(), [FaultKind::OneSidedInExcess { .. }]), "{faults}");
}

/// A disc on an incline: `x'' = g sin/(1 + k)` with `J = k m R^2` where it rolls, which needs `mu_static >= tan k/(1 + k)`;
/// else `x'' = g (sin - mu cos)`. Without static friction, `solve` and `hold` say the same.
#[rstest]
#[case(0.5)]
#[case(1.0)]
fn a_disc_rolls_or_slips_down_an_incline(#[case] k: f64) {
    let slope = 0.6_f64.atan();
    let (sin, cos) = slope.sin_cos();
    let least = 0.6 * k / (1.0 + k);
    for (mu, rolls) in [(least * (1.0 - 1e-6), false), (least * (1.0 + 1e-6), true)] {
        let text = disc(slope, k, mu);
        let report = report_on(&text);
        let [only] = report.solutions.as_slice() else { panic!("{report:?}") };
        let [along, turn] = [0, 1].map(|index| only.coordinates[index].acceleration);
        let expected = if rolls { sin / (1.0 + k) } else { sin - mu * cos };
        assert!((along + GRAVITY * expected).abs() < 1e-9, "{along}");
        assert!(!rolls || (turn * 0.1 + along).abs() < 1e-9, "{turn}");
        let starts = if rolls { "foot does not slip" } else { "foot slides backwards" };
        assert!(report.answer().contains(starts), "{}", report.answer());
        assert_eq!(report.every_load_has_one_state, Some(true));
        let held = hold(&Model::parse(&text).unwrap(), &HoldOptions::default()).unwrap();
        let [release] = held.releases.as_slice() else { panic!("{:?}", held.releases) };
        assert_eq!(release.joints[0].slip != 0, !rolls);
        let found = release.coordinates[0].acceleration;
        let middle = f64::midpoint(found.least.unwrap(), found.greatest.unwrap());
        assert!((middle - along).abs() < 1e-7, "{found:?}");
        let moves = if rolls {
            "It does not hold: it starts to move"
        } else {
            "It does not hold: it starts to slide"
        };
        assert!(held.answer().starts_with(moves), "{}", held.answer());
    }
}

/// A disc of 1 kg and radius 0.1 m with `J = k m R^2` on a plane that rises to the right.
fn disc(slope: f64, k: f64, mu: f64) -> String {
    let [x, y] = [-0.1 * slope.sin(), 0.1 * slope.cos()];
    format!(
        "gravity = {GRAVITY}\n[points]\nC = [{x}, {y}]\n[bodies.disc]\npoints = [\"C\"]\nmass = 1\nmoment_of_inertia = {}\n\
         centre_of_mass = \"C\"\n[joints.foot]\ntype = \"disc_on_face\"\nblock = \"disc\"\ncentre = \"C\"\nradius = 0.1\n\
         along = {slope}\nmu = {mu}\n[coordinates.along]\nslide = \"foot\"\nrate = 0\n[coordinates.turn]\nrotation = \"disc\"\nrate = 0\n",
        0.01 * k
    )
}

const GRAVITY: f64 = 9.81;

/// The torque that a disc in a V of half-angle alpha takes before it turns: `mu m g R/((1 + mu^2) sin(alpha))`; of the reference.
#[test]
fn a_disc_in_a_v_block_takes_the_torque_of_the_closed_form() {
    let face = |name: &str, along: &str| {
        format!(
            "[joints.{name}]\ntype = \"disc_on_face\"\nblock = \"disc\"\ncentre = \"C\"\nradius = 0.05\nalong = \"{along}\"\nmu = 0.25\n"
        )
    };
    let text = format!(
        "gravity = {GRAVITY}\n[points]\nC = [0, 0]\n[bodies.disc]\npoints = [\"C\"]\nmass = 4\nmoment_of_inertia = 0.005\n\
         centre_of_mass = \"C\"\n{}{}[loads.turn]\ntype = \"torque\"\nbody = \"disc\"\nmoment = 1\n\
         [coordinates.spin]\nrotation = \"disc\"\n",
        face("left", "-45 deg"),
        face("right", "45 deg")
    );
    let report = hold(&Model::parse(&text).unwrap(), &HoldOptions::default().load("turn")).unwrap();
    let held = report.load.unwrap().held;
    let [range] = held.as_slice() else { panic!("{held:?}") };
    let torque = 0.25 * 4.0 * GRAVITY * 0.05 / (1.0 + 0.25 * 0.25) / 45_f64.to_radians().sin();
    assert!((torque - 0.652_867_531_6).abs() < 1e-9);
    assert!((range.greatest.unwrap() - torque).abs() < 1e-9 && (range.least.unwrap() + torque).abs() < 1e-9);
}
