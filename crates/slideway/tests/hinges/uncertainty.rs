//! Parameters known within bounds, with friction in hinges: which solutions exist for all their values.

use slideway::report::{Persistence, SolveReport, Uncertainty};
use slideway::{Model, Settings, gallery, solve};

fn report(name: &str, list: &[(&str, String)]) -> SolveReport {
    let settings = list.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = Model::parse(gallery::find(name).unwrap().text).unwrap();
    solve(&model.with(&settings).unwrap()).unwrap()
}

fn uncertainty(name: &str, list: &[(&str, &str)]) -> Uncertainty {
    let list: Vec<(&str, String)> = list.iter().map(|(name, range)| (*name, (*range).to_owned())).collect();
    report(name, &list).uncertainty.unwrap()
}

const SLIDER_CRANK: &str = "slider-crank-with-pins";

/// With rough pins and a rough cylinder known within 50 % there is one solution, in the same mode throughout.
#[test]
fn one_solution_persists() {
    let found = uncertainty(SLIDER_CRANK, &[("mu", "0.05..0.15"), ("mu_pin", "0.05..0.15")]);
    assert_eq!((found.least_solutions, found.most_solutions, &found.open[..]), (1, Some(1), &[][..]));
    let [mode] = &found.modes[..] else { panic!("{:?}", found.modes) };
    assert_eq!((mode.pattern.as_str(), mode.persistence), ("++", Persistence::AllValues));
}

/// Every solution at values within the ranges is in the list, with its forces in the bounds: where the gas pushes either
/// way the piston changes sides.
#[test]
fn no_solution_at_any_value_is_missing() {
    let found = uncertainty(SLIDER_CRANK, &[("gas", "-1 kN..1 kN"), ("mu_pin", "0.05..0.15")]);
    assert!(found.modes.len() > 1 && found.open.is_empty(), "{found:?}");
    for step in 0..40 {
        let at = |factor: f64| (f64::from(step) * factor).fract();
        let gas = format!("{} N", 2000.0 * at(0.754_877_666) - 1000.0);
        let values = [("gas", gas), ("mu_pin", format!("{}", 0.05 + 0.1 * at(0.569_840_291)))];
        let report = report(SLIDER_CRANK, &values);
        assert!(report.solutions.len() >= found.least_solutions);
        assert!(found.most_solutions.is_none_or(|most| report.solutions.len() <= most));
        for solution in &report.solutions {
            let mode = found.modes.iter().find(|mode| mode.pattern == solution.pattern).unwrap();
            let bounds = mode.normal_force_bounds.as_ref().unwrap();
            for (contact, [least, greatest]) in solution.contacts.iter().zip(bounds) {
                assert!(*least <= contact.normal_force && contact.normal_force <= *greatest, "{mode:?}");
            }
        }
    }
}

/// Beyond the centre of percussion, at a radius of a third of a metre, a second solution shares the only mode of a bar
/// without contacts (theory of hinges, section 2). It comes from infinity: across that no force has bounds.
#[test]
fn several_solutions_in_one_mode_are_counted() {
    let bar = |radius: &str| {
        let text = format!(
            "gravity = 9.81\n[parameters]\nr = \"{radius}\"\n[points]\nO = [0, 0]\nC = [0.3, 0]\n\
             [bodies.bar]\npoints = [\"O\", \"C\"]\nmass = 2\ncentre_of_mass = \"C\"\nmoment_of_inertia = 0.02\n\
             [joints.O]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\nfriction_radius = \"r\"\n\
             [coordinates.phi]\nrotation = \"bar\"\nrate = 1\n"
        );
        solve(&Model::parse(&text).unwrap()).unwrap().uncertainty.unwrap()
    };
    let below = bar("0.1 m..0.33 m");
    assert_eq!((below.least_solutions, below.most_solutions), (1, Some(1)));
    let across = bar("0.3 m..0.34 m");
    assert_eq!((across.most_solutions, across.open.is_empty()), (None, false), "{across:?}");
    assert!(across.modes.iter().all(|mode| mode.normal_force_bounds.is_none()), "{across:?}");
    let beyond = bar("0.35 m..0.36 m");
    assert_eq!((beyond.least_solutions, beyond.most_solutions), (2, Some(2)), "{beyond:?}");
}
