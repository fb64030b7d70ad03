//! Guided sliders without transverse load: their states between the faces over a range, compared with
//! `solve`.

use crate::answers::parameters;
use slideway::limits::{Known, LimitsOptions, LimitsReport, Vary, limits};
use slideway::model::Model;
use slideway::solve::solve;

fn guided() -> Model {
    Model::parse(include_str!("../findings/guided_gap.toml")).expect("sound")
}

fn of(model: &Model, vary: &str) -> LimitsReport {
    let options = LimitsOptions::new(vary.parse().expect("a range")).effort(20).both_directions(true);
    limits(model, &options).unwrap_or_else(|faults| panic!("{vary}: {faults}"))
}

/// At 20 values the numbers are those of `solve`.
fn agrees_with_solve(name: &str, [from, to]: [f64; 2]) -> LimitsReport {
    let guided = guided();
    let report = of(&guided, &format!("{name}={from}..{to}"));
    for index in 0..20 {
        let value = from + (to - from) * (f64::from(index) + 0.37) / 20.0;
        let there = guided.with(&parameters(&[(name, &value.to_string())])).expect("sound");
        let solved = solve(&there).expect("solvable");
        let count = report.counts.iter().find(|count| count.from < value && value < count.to);
        let told = count.map(|count| (count.solutions, count.preload_gap_states));
        let expected = (solved.solutions.len(), solved.preload_gap_states.len());
        assert_eq!(told, Some(expected), "{name} = {value}");
    }
    report
}

/// Ends of the intervals with a preload-gap state.
fn with_state(report: &LimitsReport) -> Vec<[f64; 2]> {
    let with = report.counts.iter().filter(|count| count.preload_gap_states == 1);
    with.map(|count| [count.from, count.to]).collect()
}

/// N = 0 whatever these are, and C = M + F h/2 (2 lambda - 1) = 0 has a share from 0 to 1, here 1/4 or 3/4.
#[test]
fn a_guided_slider_stays_between_its_faces_whatever_its_friction_and_its_drive() {
    for (name, range) in [("mu", [0.0, 1.0]), ("P", [-20.0, 20.0])] {
        let report = agrees_with_solve(name, range);
        assert_eq!(with_state(&report), [range], "{name}");
        assert_eq!(report.counts[0].known, Known::Sampled);
        assert!(report.conclusion.iter().all(|sentence| !sentence.contains("locks")), "{name}");
    }
    let report = of(&guided(), "friction=0..3");
    assert_eq!(with_state(&report), [[0.0, 3.0]]);
}

/// The share is one from 0 to 1 as long as |M| <= F h/2: 0.6 N m with F = 6 N and h = 0.2 m; F >= 3 N and
/// h >= 0.1 m with M = 0.3 N m. Beyond it the slider tips.
#[test]
fn its_state_between_the_faces_ends_where_the_preload_cannot_balance_the_moment() {
    for (name, range, state) in
        [("M", [-1.0, 1.0], [-0.6, 0.6]), ("F", [0.0, 12.0], [3.0, 12.0]), ("h", [0.02, 0.3], [0.1, 0.3])]
    {
        let report = agrees_with_solve(name, range);
        let [[from, to]] = with_state(&report)[..] else { panic!("{name}: {:?}", report.counts) };
        assert!((from - state[0]).abs() < 1e-8 && (to - state[1]).abs() < 1e-8, "{name}: {from} to {to}");
        let middle = f64::midpoint(from, to);
        let reversed = report.reversed.as_ref().expect("asked for");
        let there = reversed.counts.iter().find(|count| count.from < middle && middle < count.to);
        assert_eq!(there.expect("an interval").preload_gap_states, 1, "{name}");
        let moves = "it can move in both directions";
        assert!(report.conclusion.iter().any(|sentence| sentence.contains(moves)), "{name}");
        let beyond = "in both directions it tips (s), which only a block slider can show";
        assert!(report.conclusion.iter().any(|sentence| sentence.contains(beyond)), "{name}");
    }
}

/// No state counts whose normal forces exceed the greatest one; between the faces there is none.
#[test]
fn a_greatest_reaction_leaves_a_slider_between_its_faces() {
    let options = LimitsOptions::new(Vary::between("mu", 0.0, 1.0)).max_reaction(1.0).effort(0);
    assert_eq!(with_state(&limits(&guided(), &options).expect("there")), [[0.0, 1.0]]);
}
