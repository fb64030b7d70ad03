//! For which values of a parameter contact modes exist, through the whole pipeline.

use crate::answers::{model, parameters};
use crate::random_mechanisms::mechanisms;
use proptest::prelude::*;
use serde::Deserialize;
use slideway::drive::{DriveOptions, drive};
use slideway::fault::{AxisProblem, FaultKind, Faults, Place, Source};
use slideway::gallery;
use slideway::limits::{LimitsMethod, LimitsOptions, LimitsReport, ModeLimits, Vary, limits, rest_limits};
use slideway::model::{Model, Settings};
use slideway::report::ModeEndCause;
use slideway::size::{SizeOptions, size};
use slideway::solve::solve;
use slideway::standstill::HoldOptions;

#[derive(Deserialize)]
struct Reference {
    intervals: Vec<Intervals>,
}

#[derive(Deserialize)]
struct Intervals {
    #[serde(rename = "F0")]
    preload: [f64; 3],
    velocity: f64,
    modes: Vec<Interval>,
}

#[derive(Deserialize)]
struct Interval {
    signs: String,
    from: f64,
    to: f64,
    #[serde(default)]
    from_is: Option<String>,
    #[serde(default)]
    to_is: Option<String>,
}

fn of(name: &str, list: &[(&str, &str)], vary: &str) -> LimitsReport {
    let model = model(name).with(&parameters(list)).expect("sound settings");
    limits(&model, &LimitsOptions::new(vary.parse().expect("a range")).effort(0))
        .unwrap_or_else(|faults| panic!("{faults}"))
}

fn pressed(report: &LimitsReport) -> Vec<&ModeLimits> {
    report.modes.iter().filter(|mode| !mode.preload_gap).collect()
}

fn only_end(report: &LimitsReport) -> f64 {
    let [first, second] = &report.counts[..] else { panic!("{:?}", report.counts) };
    assert_eq!(first.to, second.from);
    first.to
}

#[test]
fn the_paper_s_intervals_to_1e_8() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/klepp-2002.toml");
    let reference: Reference = toml::from_str(&std::fs::read_to_string(path).expect("there")).expect("TOML");
    for case in reference.intervals {
        let preloads: Vec<String> = case.preload.iter().map(|force| format!("{force}*m*g")).collect();
        let direction = case.velocity.to_string();
        let settings = [
            ("F_10", &*preloads[0]),
            ("F_20", &*preloads[1]),
            ("F_30", &*preloads[2]),
            ("direction", &*direction),
        ];
        let report = of("klepp-2002", &settings, "mu_1=0..0.8");
        assert_eq!(report.method, LimitsMethod::ClosedForm);
        let found = pressed(&report);
        assert_eq!(found.len(), case.modes.len());
        let word = |cause: ModeEndCause| serde_json::to_value(cause).expect("a word");
        for wanted in &case.modes {
            // The paper counts N_3 positive downwards.
            let mut signs = wanted.signs.clone().into_bytes();
            signs[2] = if signs[2] == b'+' { b'-' } else { b'+' };
            let mode = found.iter().find(|mode| mode.pattern.as_bytes() == signs).expect("the mode");
            assert!((mode.from.expect("finite") - wanted.from).abs() < 1e-8);
            assert!((mode.to.expect("finite") - wanted.to).abs() < 1e-8);
            assert!(wanted.from_is.as_deref().is_none_or(|is| word(mode.from_is) == is));
            assert!(wanted.to_is.as_deref().is_none_or(|is| word(mode.to_is) == is));
        }
    }
}

/// Pushed in its middle line (`a = 0`) the drawer presses on no contact; pushed beside it, it tips to that side.
/// Rounding misses that place by 1e-15 m, where every pattern of contacts is there for the width of it.
#[test]
fn an_end_that_rounding_misses_is_told_where_it_is() {
    let report = of("drawer", &[], "a=-0.6..0.6");
    let modes: Vec<(&str, Option<f64>, Option<f64>)> =
        report.modes.iter().map(|mode| (&*mode.pattern, mode.from, mode.to)).collect();
    assert_eq!(modes.len(), 2, "{modes:?}");
    assert!(modes.iter().any(|(pattern, from, _)| *pattern == "+-" && *from == Some(0.0)), "{modes:?}");
    assert!(modes.iter().any(|(pattern, _, to)| *pattern == "-+" && *to == Some(0.0)), "{modes:?}");
    let ends: Vec<f64> = report.counts.iter().flat_map(|count| [count.from, count.to]).collect();
    assert!(ends.iter().all(|end| *end == 0.0 || end.abs() > 0.1), "{ends:?}");
}

/// A mass has to be greater than zero, a sliding velocity different from it: from there on there are answers,
/// although halving the way to zero never gets there.
#[test]
fn where_no_answer_is_at_zero_alone_zero_is_told() {
    for (range, without) in
        [("m=0..10", [0.0, 0.0]), ("m=-10..10", [-10.0, 0.0]), ("v=-0.2..0.2", [0.0, 0.0])]
    {
        let report = of("drawer", &[], range);
        let [gap] = &report.without_mode_problem[..] else { panic!("{:?}", report.without_mode_problem) };
        assert_eq!([gap.from, gap.to], without, "{range}");
        let touching = report.modes.iter().filter(|mode| mode.from == Some(0.0) || mode.to == Some(0.0));
        assert_eq!(touching.count(), report.modes.len(), "{:?}", report.modes);
    }
}

/// Every coefficient of the wedge is a parameter that is nothing but `mu`.
#[test]
fn negative_friction_is_refused_through_other_parameters() {
    let wedge = model("wedge");
    let vary = || Vary::between("mu", -0.1, 0.5);
    let refused = |faults: Faults| {
        let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
        matches!(&fault.kind, FaultKind::Axis { problem: AxisProblem::NegativeCoefficients { .. }, .. })
    };
    assert!(refused(limits(&wedge, &LimitsOptions::new(vary())).unwrap_err()));
    assert!(refused(rest_limits(&wedge, &vary(), &HoldOptions::default()).unwrap_err()));
    assert!(refused(size(&wedge, &SizeOptions::new(vary(), 2.0)).unwrap_err()));
}

#[test]
fn one_two_and_three_solutions_with_the_erratum_s_value() {
    let report = of("klepp-2002", &[], "mu_1=0..0.8");
    let counts: Vec<(usize, usize)> =
        report.counts.iter().map(|count| (count.solutions, count.preload_gap_states)).collect();
    assert_eq!(counts, [(1, 0), (2, 0), (3, 1)]);
    assert!((report.counts[1].from - 0.452_653_96).abs() < 1e-8);
    assert!((report.counts[2].from - 0.476_470_77).abs() < 1e-8);
}

#[test]
fn the_paper_s_conclusion_for_both_directions() {
    let model = model("klepp-2002").with(&parameters(&[("F_20", "0")])).expect("sound");
    let options = LimitsOptions::new(Vary::between("mu_1", 0.0, 0.8)).both_directions(true).effort(0);
    let report = limits(&model, &options).expect("sound");
    let [both, one] = &report.conclusion[..] else { panic!("{:?}", report.conclusion) };
    assert!(both.contains("0 to 0.452654") && both.contains("it can move in both directions"), "{both}");
    assert!(one.contains("0.452654 to 0.8") && one.contains("in the opposite direction it jams"), "{one}");
}

/// Klepp (2002), section 7: mu_1b and mu_1a, where a reaction reaches a limit on this side and beyond mu_1*.
#[test]
fn greatest_reactions_bound_modes_on_both_sides_of_locking() {
    let options = LimitsOptions::new(Vary::between("mu_1", 0.0, 0.8)).max_reaction(200.0).effort(0);
    let settings = |direction| parameters(&[("F_20", "0"), ("direction", direction)]);
    let of = |direction| limits(&model("klepp-2002").with(&settings(direction)).unwrap(), &options).unwrap();
    let (forwards, backwards) = (of("1"), of("-1"));
    let above = forwards.modes.iter().find(|mode| mode.pattern == "-++").expect("the second mode");
    let below = backwards.modes.iter().find(|mode| mode.pattern == "+--").expect("the second mode");
    assert_eq!(
        (above.from_is, below.to_is),
        (ModeEndCause::GreatestReaction, ModeEndCause::GreatestReaction)
    );
    let (mu_1a, mu_1b) = (above.from.expect("finite"), below.to.expect("finite"));
    assert!(mu_1b < 0.452_653_96 && 0.452_653_96 < mu_1a && mu_1a - mu_1b < 0.1);
    for (direction, mu_1) in [("1", mu_1a), ("-1", mu_1b)] {
        let at = settings(direction).parameter("mu_1", mu_1.to_string());
        let report = solve(&model("klepp-2002").with(&at).unwrap()).unwrap();
        let greatest = |solution: &slideway::report::Solution| {
            solution.contacts.iter().map(|contact| contact.normal_force.abs()).fold(0.0, f64::max)
        };
        assert!(report.solutions.iter().any(|solution| (greatest(solution) - 200.0).abs() < 1e-6));
    }
}

/// `reference/textbook.toml`: mu = L / (2 a), whatever the height.
#[test]
fn a_drawer_locks_at_the_textbook_s_friction_and_length() {
    for h in ["0 m", "0.1 m"] {
        let report = of("drawer", &[("h", h)], "mu");
        assert!((only_end(&report) - 2.0 / 3.0).abs() < 1e-14);
        let factor = of("drawer", &[("h", h)], "friction");
        assert!((only_end(&factor) - 2.0 / 0.9).abs() < 1e-13);
    }
    let length = of("drawer", &[("mu", "0.6")], "L=0.2 m..0.6 m");
    assert_eq!(length.method, LimitsMethod::Bracketing);
    assert!((only_end(&length) - 0.36).abs() < 1e-12);
    let offset = of("drawer", &[], "a=100 mm..1 m");
    assert!((only_end(&offset) - 0.4 / 0.6).abs() < 1e-12);
}

/// `reference/textbook.toml`: tan(phi) = B / (mu (2 A + B - mu d)).
#[test]
fn a_cam_follower_jams_at_the_textbook_s_friction() {
    for (phi, d, mu) in [
        ("20 deg", "0 m", 1.221_101_075_3),
        ("30 deg", "0 m", 0.769_800_358_9),
        ("30 deg", "0.012 m", 0.813_97),
        ("40 deg", "0 m", 0.529_668_263_4),
    ] {
        let report = of("cam-follower", &[("phi", phi), ("d", d)], "mu=0..1.5");
        assert!((report.counts[0].to - mu).abs() < 5e-6, "{:?}", report.counts);
    }
}

#[test]
fn what_is_not_linear_is_bracketed_to_the_same_ends() {
    let text = gallery::find("klepp-2002").expect("in the gallery").text;
    let squared = text.replace("\nmu_1 = 0.5 ", "\nx = 0.7\nmu_1 = \"x^2\" ");
    let model = Model::parse(&squared).expect("sound");
    let report = limits(&model, &LimitsOptions::new(Vary::between("x", 0.0, 0.9)).effort(0)).expect("sound");
    assert_eq!(report.method, LimitsMethod::Bracketing);
    let straight = of("klepp-2002", &[], "mu_1=0..0.81");
    assert_eq!(report.modes.len(), straight.modes.len());
    for mode in &straight.modes {
        let same = report.modes.iter().find(|other| other.pattern == mode.pattern).expect("the mode");
        assert!((same.from.expect("finite").powi(2) - mode.from.expect("finite")).abs() < 1e-12);
        assert!((same.to.expect("finite").powi(2) - mode.to.expect("finite")).abs() < 1e-12);
        assert_eq!((same.from_is, same.to_is), (mode.from_is, mode.to_is), "{}", mode.pattern);
    }
}

#[test]
fn positions_that_cannot_be_assembled_are_no_locking() {
    let report = of("slider-crank", &[], "r=20 mm..400 mm");
    assert!(!report.without_mode_problem.is_empty(), "{report:#?}");
    let covered: f64 = report.counts.iter().map(|count| count.to - count.from).sum();
    let gaps: f64 = report.without_mode_problem.iter().map(|gap| gap.to - gap.from).sum();
    assert!((covered + gaps - 0.38).abs() < 1e-6);
}

fn faults(vary: &str) -> Faults {
    let found =
        vary.parse().and_then(|vary| limits(&model("klepp-2002"), &LimitsOptions::new(vary).effort(0)));
    found.expect_err("a fault")
}

fn fault(vary: &str) -> FaultKind {
    faults(vary).sorted()[0].kind.clone()
}

#[test]
fn names_and_ranges_that_make_no_sense_are_told() {
    assert!(
        matches!(fault("mu_4"), FaultKind::UnknownName { nearest: Some(name), .. } if name.starts_with("mu_"))
    );
    assert!(matches!(fault("mu_1=0.3..0.3"), FaultKind::EmptyRange { .. }));
    assert!(matches!(fault("mu_1=0.3"), FaultKind::MalformedRange { .. }));
    assert!(matches!(fault("friction=0..x"), FaultKind::MalformedRange { .. }));
    assert!(matches!(fault("q"), FaultKind::RangeNeeded { .. }));
    // Each with its place in the argument.
    let told = |vary: &str, words: &str, part: &str| {
        let faults = faults(vary);
        let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
        let Some(Place { source: Source::Argument(argument), span }) = fault.place.clone() else {
            panic!("{fault:?} lies in no argument")
        };
        assert_eq!((fault.kind.to_string().as_str(), &argument[span]), (words, part));
    };
    told("l=1 m..2 kg", "a mass where a length is expected", "2 kg");
    told("mu_1=0..abc", "unknown name `abc`", "abc");
}

#[test]
fn a_parameter_on_which_nothing_depends_has_the_same_limits_everywhere() {
    let text = gallery::find("drawer")
        .expect("in the gallery")
        .text
        .replace("[parameters]", "[parameters]\nidle = 1");
    let model = Model::parse(&text).expect("sound");
    let report =
        limits(&model, &LimitsOptions::new(Vary::between("idle", 0.0, 1.0)).effort(0)).expect("sound");
    assert_eq!(report.method, LimitsMethod::Independent);
    assert_eq!(report.counts.len(), 1);
    assert!(report.conclusion[0].contains("the same in the whole range: it moves"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Between the ends `solve` finds as many solutions and gap states as the limits say.
    #[test]
    fn counts_agree_with_solutions_in_between(drawing in mechanisms()) {
        let model = Model::parse(&drawing.text()).expect("sound");
        let Ok(report) = limits(&model, &LimitsOptions::new(Vary::between("friction", 0.0, 3.0)).effort(0)) else {
            return Err(TestCaseError::reject("cannot be solved, or no friction"));
        };
        prop_assume!(solve(&model).is_ok_and(|solved| solved.rejected.is_empty()));
        let present = report.counts.iter().find(|count| count.from < 1.0 && 1.0 < count.to);
        let near_end = |mode: &ModeLimits| {
            [mode.from, mode.to].into_iter().flatten().any(|end| (end - 1.0).abs() < 1e-6)
        };
        prop_assume!(!report.modes.iter().any(near_end));
        if let Some(present) = present {
            let solved = solve(&model.with(&Settings::default()).expect("sound")).expect("solved before");
            prop_assert_eq!(present.solutions, solved.solutions.len());
            prop_assert_eq!(present.preload_gap_states, solved.preload_gap_states.len());
        }
    }
}

/// Where every load scales with what is varied all normal forces vanish at zero, and the drawer goes over
/// from one corner to the other: both modes are told with their ends, and efforts of drives on both sides are
/// those of `solve`.
#[test]
fn modes_on_both_sides_of_a_load_that_vanishes() {
    let report = of("drawer", &[], "Q=-50 N..50 N");
    let told: Vec<(&str, f64, f64)> = report
        .modes
        .iter()
        .map(|mode| (mode.pattern.as_str(), mode.from.unwrap(), mode.to.unwrap()))
        .collect();
    assert_eq!(told, [("+-", 0.0, 50.0), ("-+", -50.0, 0.0)]);
    assert_eq!(report.counts.len(), 1);
    let options = DriveOptions::default().vary(Vary::between("Q", "-50 N", "50 N")).rows(4);
    let courses = drive(&model("drawer"), &options).expect("sound").course.expect("it is varied");
    for row in &courses.directions[0].rows {
        let settings = parameters(&[("Q", &format!("{:e}", row.at))]);
        let solved = solve(&model("drawer").with(&settings).expect("sound")).expect("solvable");
        let efforts = row.efforts.as_ref().unwrap_or_else(|| panic!("no solution at {}", row.at));
        assert!((efforts[0] - solved.solutions[0].drives[0].effort).abs() < 1e-9, "{row:?}");
    }
}

/// "200..800 mm" means millimetres at both ends; what `sweep` is told by a count needs none here.
#[test]
fn the_unit_of_a_range_is_that_of_both_ends() {
    for (text, told) in [
        ("L=200..800mm", "L=200 mm..800mm"),
        ("L=200 ..8e2 mm", "L=200 mm..8e2 mm"),
        ("phi=-5..90 deg", "phi=-5 deg..90 deg"),
        ("mu=0..1", "mu=0..1"),
        ("L=200mm..800", "L=200mm..800"),
    ] {
        assert_eq!(text.parse::<Vary>().expect("a range").to_string(), told);
    }
    let counted = "mu=0..1:11".parse::<Vary>().expect_err("a count");
    assert!(counted.sorted()[0].kind.hint().is_some_and(|hint| hint.starts_with("no number of values")));
}
