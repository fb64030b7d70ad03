//! How limits are known: dependence that is decided from formulas, intervals that are examined inside, wide
//! ranges, and words that are true.

use crate::answers::{model, parameters};
use slideway::fault::{AxisProblem, FaultKind, Source};
use slideway::gallery;
use slideway::limits::{CountLimits, Known, LimitsMethod, LimitsOptions, LimitsReport, Vary, limits};
use slideway::model::{Model, Settings};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, hold};

/// Few searches: what they prove is the same for more.
const EFFORT: u64 = 60;

fn file(name: &str) -> Model {
    let path = format!("{}/findings/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::parse(&std::fs::read_to_string(path).expect("there")).expect("sound")
}

fn with_effort(model: &Model, vary: &str, effort: u64) -> LimitsReport {
    let options = LimitsOptions::new(vary.parse().expect("a range")).effort(effort);
    limits(model, &options).unwrap_or_else(|faults| panic!("{faults}"))
}

fn of(model: &Model, vary: &str) -> LimitsReport {
    with_effort(model, vary, 0)
}

fn at(report: &LimitsReport, value: f64) -> &CountLimits {
    report.counts.iter().find(|count| count.from < value && value < count.to).expect("an interval")
}

/// Three values at which `mu + 30 max(0, 0.05 - |mu - 0.42|)` equals `mu` do not make it affine. Without it
/// the sledge has one solution throughout; with it the coefficient is 1.92 at mu = 0.42, and nothing moves.
#[test]
fn three_values_do_not_make_a_formula_affine() {
    let sledge = file("friction_with_a_bump");
    let report = with_effort(&sledge, "mu=0..1", EFFORT);
    assert_eq!(report.method, LimitsMethod::Bracketing);
    assert_eq!(at(&report, 0.42).solutions, 0);
    assert_eq!(at(&report, 0.2).solutions, 1);
    assert_eq!(at(&report, 0.9).solutions, 1);
    let jammed = sledge.with(&parameters(&[("mu", "0.42")])).expect("sound");
    assert!(solve(&jammed).expect("solvable").solutions.is_empty());
}

/// There the method decides; the places are those of the table in `model/dependence.rs`.
///
/// The force of the damper presses on no guide, like P: it acts at S along the line from the wall to S, which
/// is horizontal (both are at the height l/2 sin(alpha), and the bar, whose ends slide in horizontal slots,
/// only translates along them). Let H be a horizontal force at S. Vertical balance of the bar and the block,
/// `N_1 + N_2 + N_3 = m g`, and the couple of the massless block about A,
/// `(N_2 - N_3) b/2 + (friction at its faces) h/2 = 0`, do not contain H; the balance of moments about S does
/// not because H acts there, and the horizontal acceleration that it causes is that of S, whose inertia force
/// has no moment about S either. So neither N(0) nor the columns, which are answers to unit friction forces,
/// depend on H: "independent". The same normal forces at both ends confirm it.
#[test]
fn the_place_of_a_parameter_and_its_formula_decide_about_the_method() {
    let drawer = gallery::find("drawer").expect("in the gallery").text;
    let method = |text: &str, vary: &str| {
        let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"));
        of(&model, vary).method
    };
    assert_eq!(method(drawer, "mu=0..0.5"), LimitsMethod::ClosedForm);
    assert_eq!(method(drawer, "friction=0..2"), LimitsMethod::ClosedForm);
    assert_eq!(method(drawer, "L=0.3 m..0.5 m"), LimitsMethod::Bracketing);
    let klepp = gallery::find("klepp-2002").expect("in the gallery").text;
    for (vary, expected) in [
        ("F_20=0 N..20 N", LimitsMethod::ClosedForm),
        ("P=-5 N..5 N", LimitsMethod::Independent),
        ("c=0 N s/m..10 N s/m", LimitsMethod::Independent),
        ("g=1 m/s^2..20 m/s^2", LimitsMethod::ClosedForm),
        ("m=1 kg..2 kg", LimitsMethod::Bracketing),
        ("alpha=70 deg..80 deg", LimitsMethod::Bracketing),
    ] {
        // The preload `m*g` follows from both.
        assert_eq!(method(klepp, vary), expected, "{vary}");
    }
    let klepp_model = Model::parse(klepp).expect("sound");
    let forces = |damping: &str| {
        let report =
            solve(&klepp_model.with(&parameters(&[("c", damping)])).expect("sound")).expect("solvable");
        let of = |solution: &slideway::report::Solution| {
            solution.contacts.iter().map(|contact| contact.normal_force).collect::<Vec<_>>()
        };
        report.solutions.iter().map(of).collect::<Vec<_>>()
    };
    for (one, other) in forces("0").iter().flatten().zip(forces("10 N s/m").iter().flatten()) {
        assert!((one - other).abs() <= 1e-12 * 9.81, "{one} {other}");
    }
    let formulas = [
        ("2*x/4 + 0.1", LimitsMethod::ClosedForm),
        ("max(x, 0.3)", LimitsMethod::Bracketing),
        ("x*x/x", LimitsMethod::Bracketing),
    ];
    for (formula, expected) in formulas {
        let text = klepp.replace("\nmu_1 = 0.5 ", &format!("\nx = 0.5\nmu_1 = \"{formula}\" "));
        assert_eq!(method(&text, "x=0.1..0.8"), expected, "{formula}");
    }
    // The coefficient and an angle at once.
    let both = klepp.replace("alpha = \"80 deg\"", "alpha = \"80 deg + mu_1*1 deg\"");
    assert_eq!(method(&both, "mu_1=0..0.8"), LimitsMethod::Bracketing);
}

/// Between the last value that was tried and the dead centre at 1 m contacts change side; there is a solution
/// everywhere.
#[test]
fn intervals_beside_a_dead_centre_are_examined_inside() {
    let trammel = of(&file("trammel_near_dead_centre"), "x=0.01..1.2");
    assert_eq!(trammel.counts.len(), 1, "{:?}", trammel.counts);
    assert_eq!(trammel.counts[0].solutions, 1);
    assert!((trammel.counts[0].to - 1.0).abs() < 1e-6);
    let last = trammel.without_mode_problem.last().expect("beyond the dead centre");
    assert!(last.reason.contains("cannot be assembled") && last.to == 1.2, "{last:?}");
    let crank = of(&file("crank_near_dead_centre"), "x=0.2..0.28");
    assert_eq!(crank.counts.len(), 1, "{:?}", crank.counts);
    assert_eq!(at(&crank, 0.259_997).solutions, 1);
    for (name, coordinate, value) in
        [("trammel_near_dead_centre", "x", "0.99996"), ("crank_near_dead_centre", "x", "0.259997")]
    {
        let there = Settings::default().position(coordinate, value);
        let report = solve(&file(name).with(&there).expect("sound")).expect("solvable");
        assert_eq!(report.solutions.len(), 1, "{name}");
    }
}

/// Between two ends that are nearer to each other than the values that were tried first, a preload-gap state
/// goes on.
#[test]
fn intervals_between_ends_are_examined_inside() {
    let model = file("whitworth").with(&parameters(&[("mu_b", "1")])).expect("sound");
    let report = of(&model, "phi=-1..0");
    assert!(report.counts.iter().all(|count| count.solutions + count.preload_gap_states == 1), "{report:#?}");
    assert_eq!(at(&report, -0.772).preload_gap_states, 1);
    assert!(!report.conclusion.iter().any(|sentence| sentence.contains("locks")), "{:?}", report.conclusion);
}

#[test]
fn what_is_proven_is_told_apart_from_what_was_sampled() {
    let drawer = model("drawer");
    let sampled = of(&drawer, "L=0.2 m..0.5 m");
    assert!(sampled.counts.iter().all(|count| count.known == Known::Sampled && count.proven.is_empty()));
    assert!(
        sampled.counts.iter().all(|count| count.spacing.is_some_and(|spacing| spacing <= 0.0006 + 1e-12))
    );
    assert!(sampled.conclusion[0].ends_with("(sampled)."), "{:?}", sampled.conclusion);
    let proven = with_effort(&drawer, "mu=0..1", 400);
    assert!(proven.counts.iter().all(|count| count.known == Known::Proven), "{:?}", proven.counts);
    let [moves, locked] = &proven.counts[..] else { panic!("{:?}", proven.counts) };
    // mu = L / (2 a), and no nearer to it than a ten-thousandth of both intervals.
    let locking: f64 = 2.0 / 3.0;
    let [stretch, beyond] = [moves, locked].map(|count| {
        let [stretch] = count.proven[..] else { panic!("{count:?}") };
        stretch
    });
    assert!(stretch[0] == 0.0 && beyond[1] == 1.0);
    assert!(
        stretch[1] < locking
            && locking - stretch[1] < 1e-4
            && beyond[0] > locking
            && beyond[0] - locking < 1e-4
    );
    // What is told of the part that is left out is true.
    assert_eq!(moves.left_out(), moves.to - stretch[1]);
    assert!(
        proven.guarantee.contains("are proven, except within 6.7e-5 of the limits"),
        "{}",
        proven.guarantee
    );
    assert_eq!(of(&drawer, "mu=0..1").counts[0].known, Known::ClosedForm);
}

/// The solutions at 1e9 differ by the sign of N_1 alone, which is small beside the others. The screw locks
/// where mu tan(lead angle) = 1: mu = pi d / lead.
#[test]
fn wide_ranges_have_the_ends_of_narrow_ones() {
    let klepp = model("klepp-2002").with(&parameters(&[("k", "0.001 N/m")])).expect("sound");
    let [narrow, wide] = ["mu_1=0..3", "mu_1=0..1e9"].map(|vary| of(&klepp, vary));
    assert_eq!(narrow.counts.len(), wide.counts.len(), "{:?}", wide.counts);
    for (one, other) in narrow.counts.iter().zip(&wide.counts) {
        assert!((one.from - other.from).abs() <= 1e-9 * one.from.abs(), "{one:?} {other:?}");
        assert_eq!((one.solutions, one.preload_gap_states), (other.solutions, other.preload_gap_states));
    }
    assert_eq!(at(&wide, 989_884_816.0).solutions, 2);
    let there = klepp.with(&parameters(&[("mu_1", "989884816")])).expect("sound");
    assert_eq!(solve(&there).expect("solvable").solutions.len(), 2);
    let screw = model("screw").with(&parameters(&[("d_mean", "2.15e-5 mm")])).expect("sound");
    let report = of(&screw, "mu=0..1e9");
    let [moves, locked] = &report.counts[..] else { panic!("{:?}", report.counts) };
    assert_eq!((moves.solutions, locked.solutions), (1, 0));
    let locking = std::f64::consts::PI * 2.15e-8 / 5e-3;
    assert!((moves.to - locking).abs() < 1e-9 * locking, "{} {locking}", moves.to);
}

/// A rate that depends on what is varied does so the other way, too.
#[test]
fn rates_are_varied_in_both_directions() {
    let sleeve = model("sleeve-on-arm");
    let options = LimitsOptions::new(Vary::between("omega", 1.0, 12.0)).both_directions(true).effort(0);
    let reversed = limits(&sleeve, &options).expect("sound").reversed.expect("asked for");
    for (value, expected) in [("2", 2.0), ("9", 9.0)] {
        let there = sleeve.with(&parameters(&[("omega", value)])).expect("sound").reversed();
        let solved = solve(&there).expect("solvable");
        let count = reversed.counts.iter().find(|count| count.from < expected && expected < count.to);
        assert_eq!(count.expect("an interval").solutions, solved.solutions.len());
    }
}

/// Pushed to one side of its middle line or the other the drawer has one solution. Searches leave open what is
/// next to the line, to 1e-15 m and less, which is told as the line itself.
#[test]
fn what_is_told_as_one_value_is_no_gap() {
    for (range, ends) in [("a=-0.6..0.6", [-0.6, 0.6]), ("a=0..0.6", [0.0, 0.6])] {
        let report = with_effort(&model("drawer"), range, 800);
        let [count] = &report.counts[..] else { panic!("{:?}", report.counts) };
        assert_eq!((count.solutions, count.known), (1, Known::Proven));
        assert_eq!((&count.proven[..], count.left_out()), (&[ends][..], 0.0));
    }
}

/// Kinetic friction beyond the static one of the file is a fault of the setting that made it so.
#[test]
fn a_fault_that_a_setting_makes_is_placed_there() {
    let settings = Settings::default().parameter("mu_s", "0.7").parameter("mu", "30");
    let faults = file("sash").with(&settings).expect_err("static friction is at least kinetic friction");
    let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
    assert_eq!(fault.place.as_ref().expect("a place").source, Source::Setting(1));
}

#[test]
fn reasons_are_the_true_ones() {
    let report = of(&file("sash"), "mu=0..1");
    assert_eq!(report.method, LimitsMethod::ClosedForm);
    let [gap] = &report.without_mode_problem[..] else { panic!("{:?}", report.without_mode_problem) };
    assert_eq!([gap.from, gap.to], [0.3, 1.0]);
    assert!(gap.reason.contains("static friction"), "{}", gap.reason);
    let report = of(&file("sash"), "mu_s=0.25..1");
    assert_eq!(report.method, LimitsMethod::Independent);
    assert!(report.guarantee.contains("hold"), "{}", report.guarantee);
    assert!(
        report.conclusion[0].contains("the same in the whole range: it speeds up (one solution)"),
        "{:?}",
        report.conclusion
    );
}

#[test]
fn ranges_that_make_no_sense_are_refused() {
    let drawer = model("drawer");
    let fault = |vary: &str| {
        let found = vary.parse().and_then(|vary| limits(&drawer, &LimitsOptions::new(vary)));
        found.expect_err(vary).sorted()[0].kind.clone()
    };
    for vary in ["friction=nan..1", "friction=0..inf", "friction=0..1e400"] {
        assert!(matches!(fault(vary), FaultKind::Axis { problem: AxisProblem::Value { .. }, .. }), "{vary}");
    }
    let negative = fault("friction=-1..1");
    assert!(matches!(negative, FaultKind::Axis { problem: AxisProblem::NegativeFriction { .. }, .. }));
    assert!(matches!(fault("h=-1e308..1e308"), FaultKind::Overflow { .. }));
    // The part that makes no sense is named; a coefficient that is computed from what is varied is refused
    // where it is negative.
    let negative = AxisProblem::NegativeCoefficients { from: -1.0, to: 0.0 };
    for (vary, text) in [("mu=-1..1", "mu=-1..1"), ("mu = -1 .. 0", "mu=-1..0")] {
        assert_eq!(fault(vary), FaultKind::Axis { text: text.to_owned(), problem: negative.clone() });
    }
    let text = gallery::find("drawer").expect("in the gallery").text;
    let computed = Model::parse(&text.replace("\nmu = 0.3", "\nk = 3\nmu = \"0.1*k\"")).expect("sound");
    let report = of(&computed, "k=-10..10");
    let [gap] = &report.without_mode_problem[..] else { panic!("{report:#?}") };
    assert!((gap.from, gap.to) == (-10.0, 0.0) && gap.reason.contains("at least zero"), "{gap:?}");
    assert_eq!(report.counts[0].from, 0.0);
}

/// From a static coefficient of B / (2 x) on the bracket holds any load: here 0.25, the coefficient being p
/// or 2 p + 0.05.
#[test]
fn a_threshold_follows_the_formula_of_static_friction() {
    let text = gallery::find("bracket-on-pole").expect("in the gallery").text;
    let of = |formula: &str| {
        let text = text.replace("\nmu = 0.2 ", "\np = 0.3\nmu = 0.05 ");
        let text = text.replace("mu_static = \"mu_static\"", &format!("mu_static = \"{formula}\""));
        let options = HoldOptions::default().load("W").vary("p");
        hold(&Model::parse(&text).expect("sound"), &options)
    };
    for (formula, expected) in [("p", 0.25), ("2*p + 0.05", 0.1)] {
        let threshold = of(formula).expect("sound").load.expect("it is varied").threshold;
        assert!((threshold.value.expect("reached") - expected).abs() < 1e-10, "{formula}");
        assert_eq!(threshold.present, 0.3);
    }
    for formula in ["max(p, 0.3)", "p^2", "0.5 - p/10"] {
        let faults = of(formula).expect_err("no such law");
        assert!(matches!(faults.sorted()[0].kind, FaultKind::NotOnlyFriction { .. }), "{formula}");
    }
}
