//! Inputs at the edge: nothing presses, nothing acts, numbers far too large or small. Each gets an answer
//! that names the case; none a wrong status, a panic or a long wait.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use proptest::prelude::*;
use slideway::check::{check, check_with};
use slideway::configuration::Configuration;
use slideway::drive::{drive, drive_with};
use slideway::fault::{Fault, FaultKind, Faults, Source};
use slideway::gallery::{MODELS, find, telescopic_boom};
use slideway::limits::{FRICTION, limits_with, rest_limits_with};
use slideway::map::map_with;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};

use slideway::motion::{SimulateOptions, Thorough, simulate_with};
use slideway::report::{Proof, SolveReport, Status, Style};
use slideway::size::{Against, size_with};
use slideway::solve::{SolveOptions, solve, solve_with};
use slideway::standstill::hold_with;
use slideway::{DriveOptions, HoldOptions, LimitsOptions, MapOptions, Report, SizeOptions, Vary};
use std::fmt::Write as _;
use std::ops::ControlFlow;

/// A weightless block pulled along its guide through its centre: nothing presses on the guide.
fn pulled_along(kind: &str, angle: f64) -> SolveReport {
    let text = format!(
        r#"
        [parameters]
        beta = "{angle} deg"
        [points]
        C = [0.3, -0.2]
        [bodies.block]
        points = ["C"]
        mass = 2
        centre_of_mass = "C"
        moment_of_inertia = 0.1
        [joints.guide]
        type = "{kind}"
        block = "block"
        at = "C"
        along = "beta"
        length = 0.2
        mu = 0.3
        [loads.pull]
        type = "force"
        at = "block.C"
        magnitude = 10
        direction = "beta"
        [coordinates.x]
        slide = "guide"
        rate = 1
        "#
    );
    solve(&Model::parse(&text).unwrap()).unwrap()
}

#[test]
fn without_side_load_there_is_one_solution_without_contact_force_at_any_angle() {
    for kind in ["guided_slider", "block_slider"] {
        for angle in 0..90 {
            let report = pulled_along(kind, f64::from(angle));
            assert_eq!(report.status, Status::One, "{kind} at {angle} degrees");
            let solution = &report.solutions[0];
            assert!(solution.on_boundary, "{kind} at {angle} degrees");
            assert!(solution.contacts.iter().all(|contact| contact.normal_force == 0.0 && contact.side == 0));
            assert!((solution.coordinates[0].acceleration - 5.0).abs() < 1e-14);
        }
    }
}

#[test]
fn an_unloaded_mechanism_has_one_solution_however_many_contacts_it_has() {
    let unloaded = Settings::default().parameter("g", "0").parameter("W", "0").parameter("F", "0");
    let model = Model::parse(&telescopic_boom(7).unwrap()).unwrap().with(&unloaded).unwrap();
    let report = solve(&model).unwrap();
    assert_eq!((report.status, report.solutions.len()), (Status::One, 1));
    assert_eq!(report.complete, Proof::Proven);
    assert!(report.solutions[0].contacts.iter().all(|contact| contact.normal_force == 0.0));
}

fn faults(name: &str, settings: &Settings) -> Faults {
    let model = Model::parse(find(name).unwrap().text).unwrap();
    model.with(settings).and_then(|model| solve(&model)).unwrap_err()
}

fn only(faults: &Faults) -> FaultKind {
    let sorted = faults.sorted();
    assert_eq!(sorted.len(), 1, "{faults}");
    sorted[0].kind.clone()
}

#[test]
fn states_far_from_the_drawing_are_refused_after_so_many_steps() {
    let turned = faults("slider-crank", &Settings::default().position("phi", "1e5 rad"));
    assert!(matches!(only(&turned), FaultKind::TooFar { steps: 5000, .. }), "{turned}");
}

/// Where rounding is as great as the mechanism itself nothing is sought: the thread of 5 mm stays in the drawing.
#[test]
fn states_beyond_all_digits_are_refused_at_once() {
    let away = faults("screw", &Settings::default().position("s", "1e30 m"));
    assert!(matches!(only(&away), FaultKind::TooFar { steps: 0, .. }), "{away}");
}

/// A straight chain of rough pins has one solution for every load. Its proof takes seconds with hundreds of pins: once the
/// callback ends the work, no further proof is begun.
#[test]
fn the_proof_of_one_solution_of_many_pins_ends_where_the_callback_says_so() {
    let report = solve_with(&hanging_chain(12), &SolveOptions::default(), &mut |progress| {
        if progress.counted == "nodes" { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let report = report.unwrap();
    assert_eq!((report.status, report.partial, report.solutions.len()), (Status::Unknown, true, 0));
    assert_eq!(solve(&hanging_chain(12)).unwrap().status, Status::One);
}

/// Bars of 0.1 m and 0.1 kg that hang straight down and turn to and fro.
fn hanging_chain(bars: usize) -> Model {
    let point = |at: usize| {
        let (x, middle) = (0.1 * at as f64, 0.1 * at as f64 + 0.05);
        format!("p{at} = [0, {}]\nc{at} = [0, {}]\n", -x, -middle)
    };
    let mut text = format!("gravity = 9.81\n[points]\n{}", (0..=bars).map(point).collect::<String>());
    for bar in 0..bars {
        let (next, before) = (bar + 1, if bar == 0 { "ground".to_owned() } else { format!("b{}", bar - 1) });
        let rate = if bar % 2 == 0 { 0.1 } else { -0.1 };
        let _ = write!(
            text,
            r#"
            [bodies.b{bar}]
            points = ["p{bar}", "p{next}", "c{bar}"]
            mass = 0.1
            moment_of_inertia = 8e-5
            centre_of_mass = "c{bar}"
            [joints.j{bar}]
            type = "hinge"
            between = ["b{bar}.p{bar}", "{before}.p{bar}"]
            friction_radius = 0.0005
            [coordinates.q{bar}]
            rotation = "b{bar}"
            rate = {rate}
            "#
        );
    }
    Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn the_way_from_the_drawing_ends_where_the_callback_says_so() {
    let model = Model::parse(find("slider-crank").unwrap().text).unwrap();
    let far = model.with(&Settings::default().position("phi", "1e5 rad")).unwrap();
    let mut calls = 0;
    let ended = solve_with(&far, &SolveOptions::default(), &mut |_| {
        calls += 1;
        if calls < 10 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert_eq!((only(&ended.unwrap_err()), calls), (FaultKind::WorkEnded, 10));
    let held = hold_with(&far, &HoldOptions::default(), &mut |_| ControlFlow::Break(()));
    assert!(held.unwrap().is_none());
}

/// Bars, one hanging on the other, and a block in a guide at the end.
fn chain(bars: usize) -> Model {
    Model::parse(&chain_text(bars)).unwrap()
}

fn chain_text(bars: usize) -> String {
    let point = |at: usize| format!("P{at} = [{}, {}]\n", 0.05 * at as f64, 0.01 * (at % 3) as f64);
    let bar = |at: usize| {
        let next = at + 1;
        let before = at.checked_sub(1).map_or("ground".to_owned(), |before| format!("b{before}"));
        format!(
            "[bodies.b{at}]\npoints = ['P{at}', 'P{next}']\nmass = '0.1 kg'\nshape = {{ bar = ['P{at}', 'P{next}'] }}\n\
             [joints.h{at}]\ntype = 'hinge'\nbetween = ['b{at}.P{at}', '{before}.P{at}']\n"
        )
    };
    let last = bars - 1;
    let block = format!(
        "[bodies.block]\npoints = ['P{bars}']\nmass = '1 kg'\ncentre_of_mass = 'P{bars}'\n\
         shape = {{ rectangle = ['60 mm', '40 mm'] }}\n\
         [joints.end]\ntype = 'hinge'\nbetween = ['block.P{bars}', 'b{last}.P{bars}']\n\
         [joints.guide]\ntype = 'block_slider'\nblock = 'block'\nguide = 'ground'\nat = 'P{bars}'\nalong = '0 deg'\n\
         length = '60 mm'\nheight = '40 mm'\nmu = 0.1\n"
    );
    let rate = |at: usize| format!("[coordinates.q{at}]\nrotation = 'b{at}'\nrate = '0.1 rad/s'\n");
    let [points, bars, rates]: [String; 3] =
        [(0..=bars).map(point).collect(), (0..bars).map(bar).collect(), (0..last).map(rate).collect()];
    format!("[points]\n{points}{bars}{block}{rates}")
}

/// A chain of bars on rough pins.
fn rough_chain(bars: usize, rate: &str) -> Model {
    let text = chain_text(bars).replace("'0.1 rad/s'", rate);
    Model::parse(&text.replace("type = 'hinge'\n", "type = 'hinge'\nfriction_radius = '1 mm'\n")).unwrap()
}

/// Which of 66 joints at rest begin to move is more than the bits of a number say.
#[test]
fn very_many_joints_at_rest_are_decided() {
    let mechanism = Mechanism::new(&rough_chain(64, "0")).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let mut calls = 0;
    let mut look = |_: &_| {
        calls += 1;
        if calls < 50 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let options = SimulateOptions::new(1e-3);
    let history = simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut look);
    assert!(history.is_ok(), "{}", history.unwrap_err());
    assert!(calls >= 50);
}

/// Bars that turn alike do not turn the pins between them, at any value of the range: each value takes long beside many pins,
/// so that each is told.
#[test]
fn values_without_an_answer_are_told_one_by_one() {
    let options = LimitsOptions::new(Vary::between("friction", 0.5, 2.0));
    let calls_until = |most: usize| {
        let mut calls = 0;
        let report = limits_with(&rough_chain(4, "'0.1 rad/s'"), &options, &mut |_| {
            calls += 1;
            if calls < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        (report.is_ok_and(|report| report.is_none()), calls)
    };
    let (_, calls) = calls_until(usize::MAX);
    assert!(calls > 100, "{calls}");
    for most in [calls / 4, calls / 2] {
        assert_eq!(calls_until(most), (true, most));
    }
}

/// A step of the assembly, and the equations, take long with hundreds of bodies: both end while they are eliminated.
#[test]
fn an_elimination_ends_where_the_callback_says_so() {
    let model = chain(40);
    for ends_in in ["steps of the assembly", "equations"] {
        let ended = solve_with(&model, &SolveOptions::default(), &mut |progress| {
            if progress.counted == ends_in { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(only(&ended.unwrap_err()), FaultKind::WorkEnded, "{ends_in}");
    }
}

/// Checking hundreds of bodies takes seconds: it ends in each of its stages.
#[test]
fn a_check_ends_where_the_callback_says_so() {
    let model = chain(40);
    let calls_until = |most: usize| {
        let mut calls = 0;
        let report = check_with(&model, &mut |_| {
            calls += 1;
            if calls < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        (report.unwrap(), calls)
    };
    let (whole, calls) = calls_until(usize::MAX);
    assert_eq!(whole, Some(check(&model).unwrap()));
    for most in [1, calls / 2, calls] {
        assert_eq!(calls_until(most), (None, most));
    }
}

/// Where nothing turns the way is straight, and as far as that one step suffices.
#[test]
fn a_long_straight_way_is_one_step() {
    let model = Model::parse(find("drawer").unwrap().text).unwrap();
    let report = solve(&model.with(&Settings::default().position("x", "1e6 m")).unwrap()).unwrap();
    assert_eq!(report.steps_from_drawing, Some(1));
}

#[test]
fn numbers_that_would_overflow_are_named() {
    for (name, settings) in [
        ("elliptic-trammel", Settings::default().parameter("l", "1e160 m")),
        ("elliptic-trammel", Settings::default().parameter("l", "1e-160 m")),
        ("elliptic-trammel", Settings::default().parameter("m", "1e-300 kg")),
        ("elliptic-trammel", Settings::default().rate("theta", "1e200")),
        ("drawer", Settings::default().parameter("mu", "1e300")),
    ] {
        let faults = faults(name, &settings);
        let sorted = faults.sorted();
        assert!(
            sorted.iter().all(|fault| matches!(fault.kind, FaultKind::Overflow { .. })),
            "{name}: {faults}"
        );
    }
}

#[test]
fn points_that_all_but_coincide_give_no_direction() {
    let text =
        find("sleeve-on-arm").unwrap().text.replace("along = [\"O\", \"tip\"]", "along = [\"O\", \"near\"]");
    for near in ["[0, 0]", "[0, 1e-170]"] {
        let text = text.replace("[points]", &format!("[points]\nnear = {near}"));
        let faults = Model::parse(&text).and_then(|model| solve(&model)).unwrap_err();
        assert!(matches!(only(&faults), FaultKind::CoincidentPoints { .. }), "{near}: {faults}");
    }
}

#[test]
fn what_is_too_large_to_be_solved_is_refused_before_it_is_analysed() {
    let model = Model::parse(&telescopic_boom(300).unwrap()).unwrap();
    for faults in [solve(&model).unwrap_err(), check(&model).unwrap_err()] {
        assert!(matches!(only(&faults), FaultKind::TooManyContacts { contacts: 600, .. }), "{faults}");
    }
}

#[test]
fn enormous_friction_is_decided_by_proof() {
    // No more friction than this is the limit: F_1 = mu_1 N_1 stays finite, and N_1 vanishes.
    let model = Model::parse(find("klepp-2002").unwrap().text).unwrap();
    let strong = solve(&model.with(&Settings::default().parameter("mu_1", "1e8")).unwrap()).unwrap();
    assert_eq!((strong.status, strong.complete), (Status::Several, Proof::Proven));
    assert!(strong.solutions[0].contacts[0].normal_force < 1e-6);
    assert!((strong.solutions[0].contacts[0].friction_force - 12.5).abs() < 0.1);
    let load = faults("drawer", &Settings::default().parameter("Q", "1e308 N"));
    assert!(matches!(only(&load), FaultKind::Overflow { .. }), "{load}");
}

/// The Painleve-Klein apparatus at its critical friction without loads: a ray of solutions N = t (-1, 1),
/// t >= 0. With the hinge of the upper slider at the distance `offset` from its middle, the couple is C =
/// offset N, and the slider can take up N L/2 with L = 60 mm.
fn unloaded_at_critical_friction(offset: &str) -> SolveReport {
    let text = find("painleve-klein").unwrap().text.replace(
        "[joints.upper]\ntype = \"guided_slider\"\nblock = \"upper_slider\"\nat = \"B\"",
        &format!(
            "[joints.upper]\ntype = \"guided_slider\"\nblock = \"upper_slider\"\n\
             at = [\"l*cos(phi) + {offset}\", \"l*sin(phi)\"]"
        ),
    );
    let settings = Settings::default().parameter("mu", "2/tan(phi)").parameter("P_2", "0 N");
    solve(&Model::parse(&text).unwrap().with(&settings).unwrap()).unwrap()
}

#[test]
fn a_continuum_is_cut_to_where_no_guided_slider_tips() {
    let slack = unloaded_at_critical_friction("10 mm");
    assert_eq!((slack.status, slack.continua.len()), (Status::Continuum, 1));
    let tips = unloaded_at_critical_friction("50 mm");
    assert_eq!((tips.status, tips.solutions.len(), tips.continua.len()), (Status::One, 1, 0));
    assert!(tips.solutions[0].contacts.iter().all(|contact| contact.normal_force == 0.0));
}

#[test]
fn forces_that_may_be_zero_are_told_as_zero() {
    // Nothing loads it, and its rod does not turn; that the rod does not is known to 1e-307 rad/s, in bounds
    // that hold zero.
    let settings = Settings::default().parameter("P_2", "0 N").parameter("l", "10 m");
    let model = Model::parse(find("painleve-klein").unwrap().text).unwrap().with(&settings).unwrap();
    let report = solve(&model).unwrap();
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
    assert!(report.undecided_modes.is_empty(), "{:?}", report.undecided_modes);
    let solution = &report.solutions[0];
    assert!(solution.on_boundary);
    assert!(solution.contacts.iter().all(|contact| (contact.side, contact.normal_force) == (0, 0.0)));
    assert!(solution.contacts.iter().all(|contact| contact.friction_force == 0.0));
    assert_eq!(solution.coordinates[0].acceleration, 0.0);
}

/// A report without numbers that are not finite, faults, or nothing if it was ended.
fn told<R: Report>(answer: Result<Option<R>, Faults>) {
    match answer {
        Ok(Some(report)) => {
            let text = report.text(Style::PLAIN);
            assert!(!text.contains("NaN") && !text.contains(" inf"), "{text}");
        }
        Ok(None) => {}
        Err(faults) => {
            let sorted = faults.sorted();
            assert!(!sorted.is_empty());
            // No setting was given in which a fault could lie.
            let of_setting = |fault: &&Fault| {
                fault.place.as_ref().is_some_and(|place| matches!(place.source, Source::Setting(_)))
            };
            assert!(!sorted.iter().any(of_setting), "{faults:?}");
        }
    }
}

/// What a question over a range answers, in every question that has one: a report without numbers that are not finite, or
/// faults.
fn asked_over(model: &Model, vary: &Vary, question: usize) {
    let mut pieces = 0;
    let mut callback = |_: &_| {
        pieces += 1;
        if pieces < 300 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let vary = vary.clone();
    match question {
        0 => told(limits_with(model, &LimitsOptions::new(vary).both_directions(true), &mut callback)),
        1 => told(drive_with(model, &DriveOptions::default().vary(vary), &mut callback)),
        2 => told(rest_limits_with(model, &vary, &HoldOptions::default(), &mut callback)),
        3 => told(size_with(model, &SizeOptions::new(vary, 2.0), &mut callback)),
        4 => told(size_with(model, &SizeOptions::new(vary, 0.5).against(Against::Efficiency), &mut callback)),
        _ => {
            let other = Vary::between(FRICTION, 0.5, 1.5);
            told(map_with(model, &MapOptions::new(vary, other).size(4, 4), &mut callback));
        }
    }
}

/// Everything that may be varied in a model.
fn quantities(model: &Model) -> Vec<String> {
    let parameters = model.parameters.iter().map(|parameter| parameter.name.to_string());
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.name.to_string());
    parameters.chain(coordinates).chain([FRICTION.to_owned()]).collect()
}

/// Ends of a range: of any magnitude, ordinary, or equal.
fn ends() -> impl Strategy<Value = [f64; 2]> {
    let any = || prop_oneof![-1.7e308..1.7e308, -1e3..1e3, -2.0..2.0, Just(0.0), Just(1e-310), Just(1e-9)];
    [any(), any()].prop_map(|[one, other]| if one <= other { [one, other] } else { [other, one] })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Ranges without a valid value, empty ones and those of enormous numbers are among them.
    #[test]
    fn no_question_over_a_range_panics(
        number in 0..MODELS.len(),
        name in any::<prop::sample::Index>(),
        ends in ends(),
        question in 0..6_usize,
    ) {
        let model = Model::parse(MODELS[number].text).unwrap();
        let names = quantities(&model);
        asked_over(&model, &Vary::between(&names[name.index(names.len())], ends[0], ends[1]), question);
    }
}

/// Without friction no hinge has any: there is nothing to solve for.
#[test]
fn efforts_over_all_friction_begin_without_unknowns() {
    for name in ["four-bar", "bell-crank"] {
        let model = Model::parse(find(name).unwrap().text).unwrap();
        let report = drive(&model, &DriveOptions::default().vary(Vary::between(FRICTION, 0.0, 2.0))).unwrap();
        let course = report.course.unwrap();
        for direction in &course.directions {
            let first = &direction.rows[0];
            assert_eq!((first.at, &first.efforts), (0.0, &first.frictionless), "{name}");
        }
    }
}
