//! How far friction may grow, against closed forms and against solving with more friction.

use crate::answers::{model, parameters, report};
use slideway::Report;
use slideway::model::Settings;
use slideway::report::{Margins, ModeEndCause, SolveReport, Style};
use slideway::solve::solve;

fn margins(report: &SolveReport) -> &Margins {
    report.margins.as_ref().expect("few modes")
}

/// `reference/textbook.toml`: mu = L / (2 a) = 2/3, and mu = 0.3 in the model.
#[test]
fn a_drawer_has_the_textbook_s_margin() {
    let report = report("drawer", &[]);
    let wanted = 2.0 / 0.9;
    assert!((margins(&report).no_solution.expect("it locks") - wanted).abs() < 1e-12);
    assert!((margins(&report).uniqueness.expect("lost") - wanted).abs() < 1e-12);
    let mode = report.solutions[0].margin.as_ref().expect("a margin");
    assert_eq!(mode.ends_with, ModeEndCause::Locking);
    assert!((mode.factor.expect("finite") - wanted).abs() < 1e-12);
}

/// The friction of a tube acts on the faces that press, `h / 2` to either side: its moment about the middle is
/// `mu (h / 2) (N_front + N_rear)`, and the forces across the tube give that sum without friction. What friction
/// changes in one tube therefore never comes back to it, in the tubes before it neither: all determinants are
/// 1, however great friction is. Rounding makes zeros of them at factors of about 10^9.
#[test]
fn a_boom_never_locks_so_every_load_has_one_solution() {
    let report = report("telescopic-boom", &[]);
    assert_eq!(margins(&report).uniqueness, None);
    let told = report.text(Style::PLAIN);
    assert!(!told.contains("any load") && !told.contains("every load"), "{told}");
    for factor in [1.0, 1e3, 1e5] {
        let mu = (0.1 * factor).to_string();
        let rough = crate::answers::report("telescopic-boom", &[("mu", &mu)]);
        assert!(rough.solutions.len() == 1 && (rough.solutions[0].determinant.abs() - 1.0).abs() < 1e-6);
    }
}

/// Klepp's bar with all these coefficients multiplied.
fn with_friction(coefficients: [f64; 3], factor: f64, list: &[(&str, &str)]) -> SolveReport {
    let scaled = ["mu_1", "mu_2", "mu_3"].into_iter().zip(coefficients);
    let settings = scaled
        .fold(parameters(list), |settings, (name, mu)| settings.parameter(name, (mu * factor).to_string()));
    solve(&model("klepp-2002").with(&settings).expect("sound")).expect("sound")
}

/// Between the two factors nothing moves, beyond the second one it does again: the words must not say "none
/// beyond".
#[test]
fn where_solutions_come_back_the_margin_says_just_beyond() {
    let to_the_left = [("F_20", "0"), ("direction", "-1")];
    let with = |factor: f64, list: &[(&str, &str)]| with_friction([0.25, 0.05, 0.05], factor, list);
    let now = with(1.0, &to_the_left);
    let jams = margins(&now).no_solution.expect("it jams");
    let again = margins(&now).solutions_again.expect("solutions come back");
    let moves = |factor: f64| {
        let report = with(factor, &to_the_left);
        !(report.solutions.is_empty() && report.preload_gap_states.is_empty())
    };
    let little = 1e-6;
    let around =
        [1.0, jams * (1.0 - little), jams * (1.0 + little), again * (1.0 - little), again * (1.0 + little)];
    assert_eq!(around.map(moves), [true, true, false, false, true]);
    assert!((1..40).map(|step| jams + (again - jams) * f64::from(step) / 40.0).all(|factor| !moves(factor)));
    let told = now.answer();
    assert!(told.contains("It would jam from ") && told.contains("; it moves again from "), "{told}");
    // The drawer never moves again: B / (2 x) = 2/3 is exceeded for good.
    let for_good = crate::answers::report("drawer", &[]).answer();
    assert!(for_good.contains("It would jam from ") && !for_good.contains("again"), "{for_good}");
}

#[test]
fn the_number_of_solutions_changes_at_the_margin_and_not_before() {
    let with = |factor: f64, list: &[(&str, &str)]| with_friction([0.3, 0.1, 0.1], factor, list);
    for list in [&[("F_20", "0")][..], &[("F_20", "0"), ("direction", "-1")], &[]] {
        let now = with(1.0, list);
        let factor = margins(&now).another_count.expect("it changes");
        let (before, after) = (with(factor * (1.0 - 1e-6), list), with(factor * (1.0 + 1e-6), list));
        let count = |report: &SolveReport| (report.solutions.len(), report.preload_gap_states.len());
        assert_eq!(count(&before), count(&now));
        assert_ne!(count(&after), count(&now));
    }
}

#[test]
fn the_critical_contact_is_the_one_whose_friction_matters_most() {
    let settings = [("F_20", "0"), ("direction", "-1"), ("mu_1", "0.3")];
    let report = report("klepp-2002", &settings);
    let critical = margins(&report).critical_contact.clone().expect("one matters");
    let parameter = match critical.contact.as_str() {
        "upper" => "mu_1",
        "lower.front" => "mu_2",
        _ => "mu_3",
    };
    let present = if parameter == "mu_1" { 0.3 } else { 0.1 };
    let solutions = |factor: f64| {
        let settings: Settings =
            parameters(&settings).parameter(parameter, (present * critical.factor * factor).to_string());
        solve(&model("klepp-2002").with(&settings).expect("sound")).expect("sound").solutions.len()
    };
    assert_ne!(solutions(1.0 - 1e-6), solutions(1.0 + 1e-6));
}

/// The drawer locks at mu = 2/3: at 0.9 it would have to fall to 2/2.7 of that.
#[test]
fn a_jammed_mechanism_is_told_what_would_free_it() {
    let report = report("drawer", &[("mu", "0.9")]);
    let below = margins(&report).moves_below.expect("it locks");
    assert!((below.factor - 2.0 / 2.7).abs() < 1e-12);
    assert!((below.mu.expect("the same everywhere") - 2.0 / 3.0).abs() < 1e-12);
    let told = "It jams: no force of push moves it. It moves below mu = 0.6667.";
    assert_eq!(report.answer(), told);
    assert_eq!(margins(&crate::answers::report("drawer", &[])).moves_below, None);
}
