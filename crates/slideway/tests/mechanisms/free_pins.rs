//! A pin without normal force whose preload differs by side: either face is a solution, which `solve`, sweeps,
//! limits and maps count alike.

use crate::answers::{assert_close, parameters};
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::map::{ClassMeaning, ColourBy, MapOptions, map};
use slideway::model::Model;
use slideway::report::{MarginsMissing, SolveReport};
use slideway::solve::solve;
use slideway::sweep::{Rows, Sweep, SweepOptions};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// A body of 1 kg on two pins of one slot, pushed by P along it: there is no normal force whatever friction
/// does, and m x'' = P - F with F the preload at the face of the first pin, 2 N or 5 N.
fn pins() -> Model {
    Model::parse(include_str!("../findings/pins_without_load.toml")).expect("sound")
}

fn with(name: &str, value: f64) -> SolveReport {
    solve(&pins().with(&parameters(&[(name, &value.to_string())])).expect("sound")).expect("solvable")
}

#[test]
fn either_face_is_a_solution() {
    let report = with("P", 10.0);
    let accelerations: Vec<f64> =
        report.solutions.iter().map(|solution| solution.coordinates[0].acceleration).collect();
    let [at_plus, at_minus] = accelerations[..] else { panic!("{accelerations:?}") };
    assert_close(at_plus, 10.0 - 2.0, 10.0, 1e-14);
    assert_close(at_minus, 10.0 - 5.0, 10.0, 1e-14);
    // What changes the number of solutions is no mode that could be followed.
    assert_eq!((report.margins, report.margins_missing), (None, Some(MarginsMissing::NothingPresses)));
}

/// At equal preloads there is one solution, else there are two, at every value of every range.
#[test]
fn limits_and_sweeps_count_what_solve_lists() {
    for (name, range) in [("mu", [0.0, 1.0]), ("P", [-5.0, 20.0]), ("F_minus", [2.0, 8.0])] {
        let report = limits(&pins(), &LimitsOptions::new(Vary::between(name, range[0], range[1])).effort(5));
        let report = report.unwrap_or_else(|faults| panic!("{name}: {faults}"));
        let counts: Vec<_> =
            report.counts.iter().map(|count| (count.from, count.to, count.solutions)).collect();
        assert_eq!(counts, [(range[0], range[1], 2)], "{name}");
        let axis = format!("{name}={}..{}:9", range[0], range[1]).parse().expect("an axis");
        let sweep = Sweep::new(&pins(), &SweepOptions::grid([axis])).expect("sound");
        let mut points = BTreeMap::new();
        sweep.run(&mut sweep.start(), &Rows::clone, &mut |rows: Vec<Rows>, _| {
            for head in rows.iter().flat_map(|rows| &rows.heads) {
                points.insert(head.point, head.solutions as usize);
            }
            ControlFlow::Continue(())
        });
        for index in 0..9_u32 {
            let value = range[0] + (range[1] - range[0]) * f64::from(index) / 8.0;
            let solved = with(name, value).solutions.len();
            assert_eq!(points.get(&index.into()), Some(&solved), "{name} = {value}");
        }
    }
}

#[test]
fn maps_count_and_name_what_solve_lists() {
    let plane = || {
        let (x, y) = ("mu=0..1".parse().expect("a range"), "F_minus=2..8".parse().expect("a range"));
        MapOptions::new(x, y).size(8, 8)
    };
    let number = map(&pins(), &plane()).expect("mapped");
    let two = ClassMeaning::Solutions { solutions: 2, preload_gap_states: 0, tipping: 0 };
    assert!(
        number.pixels().iter().all(|&class| number.classes[class].meaning == two),
        "{:?}",
        number.classes
    );
    let modes = map(&pins(), &plane().colour_by(ColourBy::Modes)).expect("mapped");
    let [class] = &modes.classes[..] else { panic!("{:?}", modes.classes) };
    let listed = with("mu", 0.3).solutions.into_iter().map(|solution| solution.pattern).collect();
    assert_eq!(class.meaning, ClassMeaning::Modes { patterns: listed });
}
