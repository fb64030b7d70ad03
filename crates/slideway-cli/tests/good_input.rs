//! What the commands answer when nothing is wrong.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway, slideway_reading, top};
use serde_json::Value;
use slideway::gallery::MODELS;
use slideway::template::TEMPLATES;
use std::process::Stdio;

const KLEPP: &str = "models/klepp-2002.toml";
const DRAWER: &str = "models/drawer.toml";
const BRACKET: &str = "models/bracket-on-pole.toml";
const ENGINE: &str = "docs/src/examples/engine.toml";

macro_rules! golden {
    ($($name:ident: $code:literal [$($argument:expr),* $(,)?];)*) => {$(
        #[test]
        fn $name() {
            let run = slideway(&[$($argument),*]);
            assert_eq!((run.code, run.stderr.as_str()), ($code, ""));
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(run.stdout);
            });
        }
    )*};
}

golden! {
    klepp: 0 ["solve", KLEPP];
    no_solution: 1 ["solve", KLEPP, "--set", "F_20=0", "--set", "direction=-1"];
    preload_gap: 0 ["solve", KLEPP, "--set", "mu_1=0.24", "--set", "F_30=0.5*m*g", "--set", "F_20=0"];
    peg_pushed_by_a_load: 0 ["solve", "docs/src/examples/peg-pushed-by-load.toml"];
    limits_of_a_peg: 0 ["limits", "docs/src/examples/peg-pushed-by-load.toml", "--vary", "mu=0..0.5"];
    hold_over_a_range: 0 ["hold", BRACKET, "--vary", "x=0.1 m..0.5 m"];
    size_by_effort: 0 ["size", DRAWER, "--vary", "L", "--max-effort", "30"];
    help_questions: 0 ["help", "questions"];
    driven_drawer: 0 ["solve", "models/drawer.toml"];
    csv: 0 ["solve", "models/drawer.toml", "--format", "csv"];
    range_of_friction: 0 ["solve", KLEPP, "--set", "F_20=0", "--set", "mu_1=0.4..0.6"];
    limits_klepp: 0 ["limits", KLEPP, "--vary", "mu_1=0..0.8", "--set", "F_20=0", "--both-directions"];
    limits_length: 0 ["limits", "models/drawer.toml", "--vary", "L=0.2 m..0.5 m", "--set", "mu=0.6"];
    help_of_limits: 0 ["limits", "-h"];
    check_drawer: 0 ["check", "models/drawer.toml"];
    check_bracket: 0 ["check", "models/bracket-on-pole.toml"];
    check_bracket_json: 0 ["check", "models/bracket-on-pole.toml", "--format", "json"];
    import_bracket: 0 ["import", "docs/src/examples/bracket.dxf"];
    check_redundant: 2 ["check", "crates/slideway-cli/tests/bad/redundant.toml"];
    check_not_assembled: 2 ["check", "crates/slideway-cli/tests/bad/short-rod.toml"];
    check_at_rest: 0 ["check", KLEPP, "--rate", "q=0"];
    hold_bracket: 0 ["hold", "models/bracket-on-pole.toml", "--load", "W", "--vary", "mu_static"];
    hold_bracket_too_near: 1 ["hold", "models/bracket-on-pole.toml", "--load", "W", "--set", "x=200 mm"];
    hold_klepp: 0 ["hold", KLEPP, "--set", "F_20=0", "--set", "mu_1=0.3", "--set", "P=0.05*m*g"];
    hold_boom: 1 ["hold", "models/telescopic-boom.toml"];
    hold_cam: 1 ["hold", "models/cam-follower.toml", "--load", "cam"];
    hold_drawer_json: 0 ["hold", "models/drawer.toml", "--drives", "hold", "--format", "json"];
    limits_not_assembled: 0 ["limits", "models/slider-crank.toml", "--vary", "r=20 mm..400 mm"];
    size_drawer: 0 ["size", DRAWER, "--vary", "L", "--margin", "2"];
    size_bracket: 0 ["size", BRACKET, "--vary", "x", "--margin", "1.5", "--against", "hold"];
    size_both_directions: 0 [
        "size", "models/wedge.toml", "--vary", "alpha=5 deg..80 deg", "--margin", "2", "--both-directions"
    ];
    size_nowhere: 1 ["size", DRAWER, "--vary", "L=0.1 m..0.3 m", "--margin", "2"];
    size_not_assembled: 0 ["size", ENGINE, "--vary", "l=20 mm..200 mm", "--margin", "2"];
    drive_drawer: 0 ["drive", DRAWER, "--vary", "mu"];
    drive_locked: 1 ["drive", DRAWER, "--set", "mu=0.8"];
    drive_screw: 0 ["drive", "models/screw.toml"];
    drive_not_assembled: 0 ["drive", ENGINE, "--vary", "l=20 mm..200 mm", "--rows", "5"];
    help_of_size: 0 ["size", "-h"];
    help_of_drive: 0 ["drive", "-h"];
    help_of_sweep: 0 ["sweep", "--help"];
    help_of_hold: 0 ["hold", "--help"];
    list_of_models: 0 ["models"];
    list_of_templates: 0 ["new", "--list"];
    help_of_new: 0 ["new", "--help"];
    help_of_a_template: 0 ["new", "peg", "-h"];
    help: 0 ["--help"];
    help_of_solve: 0 ["solve", "--help"];
    help_of_check: 0 ["check", "-h"];
    help_of_models: 0 ["models", "-h"];
}

fn json(arguments: &[&str]) -> (i32, Value) {
    let run = slideway(arguments);
    (run.code, serde_json::from_str(&run.stdout).unwrap())
}

#[test]
fn json_of_limits_has_the_fields_that_are_promised() {
    let (code, report) = json(&["limits", KLEPP, "--vary", "mu_1=0..0.8", "--format", "json"]);
    assert_eq!((code, &report["schema"]), (0, &Value::from("slideway/limits/2")));
    let modes = report["modes"].as_array().unwrap();
    assert!(
        modes.iter().all(|mode| mode["signs"].is_array() && mode["from"].is_f64() && mode["to"].is_f64())
    );
    let counts = report["counts"].as_array().unwrap();
    let solutions: Vec<u64> = counts.iter().map(|count| count["solutions"].as_u64().unwrap()).collect();
    assert_eq!(solutions, [1, 2, 3]);
}

#[test]
fn json_of_size_has_the_fields_that_are_promised() {
    let (code, report) =
        json(&["size", DRAWER, "--vary", "L=0.1 m..1 m", "--margin", "2", "--format", "json"]);
    assert_eq!((code, &report["schema"]), (0, &Value::from("slideway/size/1")));
    let met = &report["met"][0];
    assert!((met["from"].as_f64().unwrap() - 0.36).abs() < 1e-12);
    assert_eq!((met["from_is"].as_str(), met["to_is"].as_str()), (Some("margin"), Some("range")));
    assert_eq!((report["vary"]["unit"].as_str(), report["against"].as_str()), (Some("m"), Some("locking")));
    assert!(report["samples"].as_array().unwrap().iter().all(|sample| sample["margin"].is_f64()));
}

#[test]
fn json_of_drive_has_the_fields_that_are_promised() {
    let (code, report) = json(&["drive", DRAWER, "--vary", "mu", "--rows", "5", "--format", "json"]);
    assert_eq!((code, &report["schema"]), (0, &Value::from("slideway/drive/2")));
    let solution = &report["directions"][0]["solutions"][0];
    // P = Q / (1 - 2 mu a / L), and what is lost to friction.
    assert!((solution["efforts"][0].as_f64().unwrap() - 20.0 / 0.55).abs() < 1e-9);
    assert!((solution["efficiency"]["value"].as_f64().unwrap() - 0.55).abs() < 1e-12);
    assert_eq!(solution["efficiency"]["is"], "driving");
    let blow_ups = report["course"]["directions"][0]["blow_ups"].as_array().unwrap();
    assert!((blow_ups[0]["at"].as_f64().unwrap() - 2.0 / 3.0).abs() < 1e-12);
    assert_eq!(report["course"]["directions"][0]["rows"].as_array().unwrap().len(), 6);
}

/// A load comes before a drive of the same name.
#[test]
fn a_drive_and_a_load_of_the_same_name() {
    let text =
        std::fs::read_to_string(top().join(DRAWER)).unwrap().replace("[loads.resistance]", "[loads.push]");
    for (arguments, field) in [
        (&["hold", "-", "--load", "push", "--format", "json"][..], "load"),
        (
            &[
                "size",
                "-",
                "--vary",
                "L",
                "--margin",
                "2",
                "--against",
                "hold",
                "--load",
                "push",
                "--format",
                "json",
            ],
            "load",
        ),
        (&["drive", "-", "--format", "json"], "drives"),
    ] {
        let run = slideway_reading(arguments, text.as_bytes());
        assert_eq!(run.stderr, "");
        let report: Value = serde_json::from_str(&run.stdout).unwrap();
        match arguments[0] {
            // The factor of a load has no unit, the effort of a drive is in N.
            "hold" => assert_eq!(
                (&report["load"]["unit"], &report["load"]["factor"]),
                (&Value::from(""), &Value::from(1.0))
            ),
            // Without the drive nothing but the resistance acts at rest, through the middle: no friction
            // holds it.
            "size" => assert_eq!((run.code, report["met"].as_array().unwrap().len()), (1, 0)),
            _ => assert_eq!(report[field][0]["name"], "push"),
        }
    }
}

#[test]
fn json_has_the_fields_that_are_promised() {
    let (code, report) = json(&["solve", KLEPP, "--format", "json"]);
    assert_eq!(code, 0);
    assert_eq!(report["schema"], "slideway/solve/2");
    assert_eq!(report["status"], "several");
    let solutions = report["solutions"].as_array().unwrap();
    assert_eq!(solutions.len(), 3);
    for solution in solutions {
        let contacts = solution["contacts"].as_array().unwrap();
        let names: Vec<&str> = contacts.iter().map(|contact| contact["name"].as_str().unwrap()).collect();
        assert_eq!(names, ["upper", "lower.front", "lower.rear"]);
        for contact in contacts {
            let normal = contact["normal_force"].as_f64().unwrap();
            assert_eq!(contact["side"].as_i64().unwrap() as f64, normal.signum());
            assert!(contact["friction_force"].as_f64().unwrap() > 0.0);
        }
    }
}

#[test]
fn every_status_has_its_exit_code() {
    let no_solution = ["solve", KLEPP, "--format", "json", "--set", "F_20=0", "--set", "direction=-1"];
    let (code, report) = json(&no_solution);
    assert_eq!((code, report["status"].as_str().unwrap()), (1, "none"));
    let gap = [
        "solve",
        KLEPP,
        "--format",
        "json",
        "--set",
        "mu_1=0.24",
        "--set",
        "F_30=0.5*m*g",
        "--set",
        "F_20=0",
    ];
    let (code, report) = json(&gap);
    assert_eq!((code, report["status"].as_str().unwrap()), (0, "preload_gap"));
    let (code, report) = json(&["solve", "models/drawer.toml", "--format", "json"]);
    assert_eq!((code, report["status"].as_str().unwrap()), (0, "one"));
}

#[test]
fn settings_may_be_negative_and_have_blanks_and_units() {
    let (code, report) = json(&[
        "solve",
        "models/slider-crank.toml",
        "--at",
        "phi=-75 deg",
        "--rate",
        "phi = -1e2 rad/s",
        "--set",
        "mu = 0.1*2",
        "--format=json",
    ]);
    assert_eq!(code, 0);
    let state = &report["state"][0];
    assert!((state["value"].as_f64().unwrap() + 75_f64.to_radians()).abs() < 1e-12);
    assert_eq!(state["rate"], -100.0);
}

#[test]
fn every_model_of_the_gallery_passes_through_standard_input() {
    for model in slideway::gallery::MODELS {
        let text = slideway(&["models", model.name]);
        assert_eq!(text.stdout, model.text);
        let check = slideway_reading(&["check", "-", "--format", "json"], text.stdout.as_bytes());
        let report: Value = serde_json::from_str(&check.stdout).unwrap();
        assert_eq!(report["schema"], "slideway/check/1");
        let sound = model.name != "bracket-on-pole";
        assert_eq!((check.code, report["sound"].as_bool().unwrap()), (0, sound));
    }
}

#[test]
fn the_generated_boom_is_the_one_of_the_gallery() {
    let boom = slideway(&["models", "telescopic-boom", "--stages", "3"]).stdout;
    assert_eq!(boom, std::fs::read_to_string(top().join("models/telescopic-boom.toml")).unwrap());
    for stages in ["1", "5"] {
        let boom = slideway(&["models", "telescopic-boom", "--stages", stages]).stdout;
        assert_eq!(slideway_reading(&["solve", "-"], boom.as_bytes()).code, 0);
    }
}

#[test]
fn output_files_are_written_whole_and_not_overwritten() {
    let directory = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let output = command(arguments).current_dir(directory.path()).output().unwrap();
        output.status.code().unwrap()
    };
    assert_eq!(run(&["models", "drawer", "--output", "mine.toml"]), 0);
    let path = directory.path().join("mine.toml");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), slideway::gallery::find("drawer").unwrap().text);
    assert_eq!(run(&["models", "klepp-2002", "--output", "mine.toml"]), 2);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), slideway::gallery::find("drawer").unwrap().text);
    assert_eq!(run(&["models", "klepp-2002", "--output", "mine.toml", "--force"]), 0);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), slideway::gallery::find("klepp-2002").unwrap().text);
    // The answer goes to the file, its exit code stays.
    let arguments = ["solve", "mine.toml", "--set", "F_20=0", "--set", "direction=-1", "-o", "answer.txt"];
    assert_eq!(run(&arguments), 1);
    assert!(std::fs::read_to_string(directory.path().join("answer.txt")).unwrap().contains("It jams"));
    // Nothing takes the place of the model that it was made from, and `-` is no file.
    assert_eq!(run(&["solve", "mine.toml", "-o", "mine.toml", "--force"]), 2);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), slideway::gallery::find("klepp-2002").unwrap().text);
    assert_eq!(run(&["check", "mine.toml", "-o", "-"]), 0);
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 2, "no temporary file is left");
}

#[test]
fn a_closed_pipe_is_no_fault() {
    let mut child = command(&["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn colours_are_for_terminals_unless_forced() {
    let escape = '\u{1b}';
    assert!(!slideway(&["solve", KLEPP]).stdout.contains(escape));
    assert!(slideway(&["solve", KLEPP, "--color", "always"]).stdout.contains(escape));
    let forced = command(&["solve", KLEPP]).env("CLICOLOR_FORCE", "1").output().unwrap();
    assert!(String::from_utf8(forced.stdout).unwrap().contains(escape));
    let refused =
        command(&["solve", KLEPP]).env("CLICOLOR_FORCE", "1").env("NO_COLOR", "1").output().unwrap();
    assert!(!String::from_utf8(refused.stdout).unwrap().contains(escape));
}

/// A rod of 1 mm in a mechanism of 1 km is no singular position; nor is a state close to one.
#[test]
fn short_bodies_and_near_positions_are_not_singular() {
    let short =
        ["check", "models/slider-crank.toml", "--format", "json", "--set", "l=1 km", "--set", "r=1 mm"];
    let (code, report) = json(&short);
    assert_eq!((code, &report["findings"]), (0, &Value::Array(vec![])));
    let near = ["solve", "models/elliptic-trammel.toml", "--at", "theta=90.001 deg", "--format", "json"];
    assert_eq!(json(&near).0, 0);
}

#[test]
fn schema_completions_and_manual_pages_are_written() {
    let schema: Value = serde_json::from_str(&slideway(&["schema"]).stdout).unwrap();
    assert_eq!(schema["title"], "Slideway model");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = slideway(&["completions", shell]);
        assert_eq!(run.code, 0);
        assert!(run.stdout.contains("slideway"));
    }
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man");
    let pages = pages.to_str().unwrap();
    let run = slideway(&["man", pages]);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    for (page, tells) in [
        ("slideway.1", "slideway\\-solve(1)"),
        ("slideway-solve.1", "\\-\\-set"),
        ("slideway-new-peg.1", "depth to which it is inserted"),
    ] {
        let text = std::fs::read_to_string(folder.path().join("man").join(page)).unwrap();
        assert!(text.contains(tells), "{page}: {text}");
    }
    // A folder that is there is left alone.
    let again = slideway(&["man", pages]);
    assert_eq!(again.code, 2);
    assert!(again.stderr.contains("already exists"), "{}", again.stderr);
    assert!(slideway(&["--version"]).stdout.starts_with("slideway "));
}

/// All that an imported model lacks is its joints, and a file that is no drawing is refused.
#[test]
fn an_imported_model_is_to_be_completed() {
    let imported = slideway(&["import", "docs/src/examples/bracket.dxf"]);
    let check = slideway_reading(&["check", "-"], imported.stdout.as_bytes());
    assert_eq!(check.code, 2);
    assert!(
        check.stderr.contains("`joints` is missing") && check.stderr.contains("1 fault"),
        "{}",
        check.stderr
    );
    let model = slideway(&["import", DRAWER]);
    assert_eq!((model.code, model.stdout.as_str()), (2, ""));
    assert!(model.stderr.contains("line 1 should be a group code"), "{}", model.stderr);
    assert_eq!(slideway(&["check", "docs/src/examples/bracket.toml"]).code, 0);
}

/// At 80 columns no line of any help is longer, and its examples and remarks are laid out for that.
#[test]
fn helps_fit_eighty_columns() {
    let help = |words: &[&str], columns: &str| {
        let output = command(words).env("COLUMNS", columns).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let top = help(&["--help"], "80");
    let commands = top.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = commands.take_while(|line| !line.is_empty()).filter(|line| !line.starts_with("    "));
    let mut all: Vec<Vec<&str>> = vec![vec![]];
    all.extend(names.filter_map(|line| line.split_whitespace().next()).map(|name| vec![name]));
    all.extend(TEMPLATES.iter().map(|template| vec!["new", template.name]));
    assert!(all.len() > 25, "{all:?}");
    for words in all {
        let of = |option: &'static str, columns| match words.as_slice() {
            ["help" | "questions"] => help(&["help", "questions"], columns),
            words => help(&[words, &[option]].concat(), columns),
        };
        for text in [of("--help", "80"), of("-h", "80")] {
            let longest = text.lines().max_by_key(|line| line.chars().count()).unwrap_or_default();
            assert!(longest.chars().count() <= 80, "{words:?}: {longest}");
            assert!(!text.is_empty(), "{words:?}");
        }
        let remarks = |text: &str| text.find("\nExamples:").map(|at| text[at..].to_owned());
        assert_eq!(remarks(&of("--help", "80")), remarks(&of("--help", "100")), "{words:?}");
    }
}

/// What others call the same is understood.
#[test]
fn other_words_for_a_command_are_understood() {
    for (one, other) in [("hold", "rest"), ("hold", "standstill"), ("drive", "effort"), ("modes", "matrices")]
    {
        let help = |name: &str| slideway(&[name, "-h"]).stdout;
        assert_eq!(help(one), help(other));
        assert!(!help(one).is_empty());
    }
}

/// One line for each model of the gallery, each with its own name; with `--verbose` what each shows, too.
#[test]
fn the_gallery_is_a_line_a_model() {
    let output = command(&["models"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = text.lines().take_while(|line| !line.is_empty()).collect();
    assert_eq!(lines.len(), MODELS.len());
    for (line, model) in lines.iter().zip(MODELS) {
        assert!(line.starts_with(&format!("{} ", model.name)) && line.chars().count() <= 100, "{line}");
        let begins = line[model.name.len()..].trim().trim_end_matches(" ...");
        assert!(model.summary().starts_with(begins) && begins.split(' ').count() > 1, "{line}");
    }
    let long = slideway(&["models", "--verbose"]).stdout;
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(MODELS.iter().all(|model| one_line(&long).contains(&one_line(&model.shows()))));
}
