//! Tables of a model as functions in its loads, and what a motion is watched for.

use slideway::kinetics::KineticEquations;
use slideway::model::{CrossingDirection, Model, Settings};
use slideway::report::Proof;
use slideway::{configuration::Configuration, mechanism::Mechanism, solve};

/// A sledge of 2 kg without friction, beside tables, loads or events.
fn sledge(rest: &str) -> String {
    format!("{SLEDGE}{rest}")
}

const SLEDGE: &str = r#"
[points]
S = [0, 0]
[tables.push]
argument = ["0 s", "500 ms", "0.5 s", "2 s"]
value = ["0 N", "10 N", "-4 N", "2 N"]
beyond = "repeat"
[bodies.sledge]
points = ["S"]
mass = "2 kg"
centre_of_mass = "S"
moment_of_inertia = 1
[joints.track]
type = "block_slider"
block = "sledge"
at = "S"
along = "0 deg"
length = "20 cm"
mu = 0
[coordinates.x]
slide = "track"
rate = 1
"#;

const PUSH: &str = "[loads.push]\ntype = \"force\"\nat = \"sledge.S\"\ncomponents = [\"2*push(t)\", 0]\n";

#[test]
fn a_load_follows_its_table() {
    let model = Model::parse(&sledge(PUSH)).unwrap();
    // 2 kg; twice the table: 10 N/(0.5 s) up to 0.5 s, then -4 N + 4 N/s (t - 0.5 s), and again after 2 s.
    let expected = [("0.25 s", 5.0), ("0.5 s", -4.0), ("1.5 s", 0.0), ("2.25 s", 5.0), ("-0.5 s", 0.0)];
    for (time, acceleration) in expected {
        let model = model.with(&Settings::default().time(time)).unwrap();
        let mechanism = Mechanism::new(&model).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap();
        let equations = KineticEquations::new(&mechanism, &configuration).unwrap();
        let found = equations.coordinate_accelerations(&equations.frictionless())[0];
        assert!((found - acceleration).abs() < 1e-12, "at {time}: {found}");
    }
    // Bounds of the table hold, so that the list of solutions is proven.
    let report = solve::solve(&model.with(&Settings::default().time("0.3 s")).unwrap()).unwrap();
    assert_eq!(report.complete, Proof::Proven);
}

#[test]
fn faults_of_tables_are_told_with_their_places() {
    let told = |table: &str| {
        let text = sledge(PUSH).replace(
            "argument = [\"0 s\", \"500 ms\", \"0.5 s\", \"2 s\"]\nvalue = [\"0 N\", \"10 N\", \"-4 N\", \"2 N\"]",
            table,
        );
        Model::parse(&text).unwrap_err().to_string()
    };
    let cases = [
        ("argument = [0, 1]\nvalue = [0]", "the table push has 2 arguments and 1 values"),
        ("argument = []\nvalue = []", "the table push has 0 arguments and 0 values"),
        ("argument = [0, 2, 1]\nvalue = [0, 1, 2]", "the arguments of the table push decrease at number 3"),
        ("argument = [\"0 s\", \"1 m\"]\nvalue = [0, 1]", "a length where a time is expected"),
        ("argument = [\"0 m\", \"1 m\"]\nvalue = [0, 1]", "the table `push` expects a length, not a time"),
        ("argument = [\"0 s\", \"t\"]\nvalue = [0, 1]", "a table contains constants only"),
        ("argument = [\"0 s\", \"T\"]\nvalue = [0, 1]", "unknown name `T`"),
        ("argument = [\"0 s\", \"1 s\"]\nvalue = [\"0 kg\", \"1 kg\"]", "a mass where a force is expected"),
    ];
    for (table, expected) in cases {
        let found = told(table);
        assert!(found.contains(expected), "{table}: {found}");
    }
    let misspelt = Model::parse(&sledge(&PUSH.replace("push(t)", "pusch(t)"))).unwrap_err();
    assert_eq!(misspelt.to_string(), "unknown function `pusch`");
    assert_eq!(misspelt.sorted()[0].kind.hint().as_deref(), Some("did you mean `push`?"));
    let bare = Model::parse(&sledge(&PUSH.replace("push(t)", "push"))).unwrap_err();
    assert_eq!(bare.to_string(), "the function `push` needs arguments in parentheses");
    let two = Model::parse(&sledge(&PUSH.replace("push(t)", "push(t, t)"))).unwrap_err();
    assert!(two.to_string().contains("one argument"), "{two}");
    let shared = sledge("[parameters]\npush = 1\n");
    let shared = Model::parse(&shared).unwrap_err();
    assert_eq!(shared.to_string(), "`push` is the name of a table and of a parameter or coordinate");
}

#[test]
fn events_are_formulas_of_the_motion() {
    let events = r#"
[events.halfway]
zero_of = "x - 0.5 m"
direction = "rising"
[events.slow]
zero_of = "rate(x) - 1 mm/s"
stops = true
"#;
    let model = Model::parse(&sledge(events)).unwrap();
    let found: Vec<_> =
        model.events.iter().map(|event| (&*event.name, event.direction, event.stops)).collect();
    let expected = [("halfway", CrossingDirection::Rising, false), ("slow", CrossingDirection::Both, true)];
    assert_eq!(found, expected);
    let mechanism = Mechanism::new(&model).unwrap();
    let value = mechanism.quantity(mechanism.events[0].zero_of, &[0.75], &[0.0], 0.0);
    assert_eq!(value.unwrap(), 0.25);
    let faulty = Model::parse(&sledge("[events.odd]\nzero_of = \"x + rate(x)\"\n")).unwrap_err();
    assert_eq!(faulty.to_string(), "`+` cannot combine a length and a velocity");
    let range = Model::parse(&sledge("[events.odd]\nzero_of = \"1..2\"\n")).unwrap_err();
    assert!(!range.to_string().is_empty());
}
