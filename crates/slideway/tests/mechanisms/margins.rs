//! How far friction may grow, against closed forms and against solving with more friction.

use crate::answers::{model, parameters, report};
use slideway::model::Settings;
use slideway::report::{Margins, Report};
use slideway::solve::solve;

fn margins(report: &Report) -> &Margins {
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
    assert_eq!(mode.ends_with, "locking");
    assert!((mode.factor.expect("finite") - wanted).abs() < 1e-12);
}

#[test]
fn the_number_of_solutions_changes_at_the_margin_and_not_before() {
    let with = |factor: f64, list: &[(&str, &str)]| {
        let scaled = [("mu_1", 0.3), ("mu_2", 0.1), ("mu_3", 0.1)];
        let settings = scaled.iter().fold(parameters(list), |settings, (name, mu)| {
            settings.parameter(name, &(mu * factor).to_string())
        });
        solve(&model("klepp-2002").with(&settings).expect("sound")).expect("sound")
    };
    for list in [&[("F_20", "0")][..], &[("F_20", "0"), ("direction", "-1")], &[]] {
        let now = with(1.0, list);
        let factor = margins(&now).another_count.expect("it changes");
        let (before, after) = (with(factor * (1.0 - 1e-6), list), with(factor * (1.0 + 1e-6), list));
        let count = |report: &Report| (report.solutions.len(), report.preload_gap_states.len());
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
            parameters(&settings).parameter(parameter, &(present * critical.factor * factor).to_string());
        solve(&model("klepp-2002").with(&settings).expect("sound")).expect("sound").solutions.len()
    };
    assert_ne!(solutions(1.0 - 1e-6), solutions(1.0 + 1e-6));
}
