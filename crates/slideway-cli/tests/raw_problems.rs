//! `slideway modes`: good and bad problems, and every form of the answer. The files are in `raw/`.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway, slideway_reading, top};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/raw").join(name)
}

/// The answer to a file of a folder, for a golden test.
fn transcript(directory: &Path, name: &str) -> (i32, String) {
    let output = command(&["modes", name]).current_dir(directory).output().unwrap();
    let code = output.status.code().unwrap();
    let (stdout, stderr) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(stdout.is_empty() || stderr.is_empty(), "{name}: both streams");
    (code, format!("exit code {code}\n{stdout}{stderr}"))
}

fn names(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn golden(name: &str, text: &str) {
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!(name.replace('.', "_"), text);
    });
}

#[test]
fn good_problems_are_answered() {
    let directory = folder("good");
    let names = names(&directory);
    assert!(names.len() > 8, "the files are gone");
    for name in names {
        let (code, text) = transcript(&directory, &name);
        assert_eq!(code, i32::from(name == "none.json"), "{name}");
        golden(&format!("good__{name}"), &text);
    }
}

/// P-matrices by their principal minors: [[2, 1], [1, 2]] has 2, 2, 3; [[1, 2], [2, 1]] has 1, 1, -3;
/// [[1, -1], [-1, 1]] has 1, 1, 0. The equation 2 x + |x| = b has the coefficients 3 and 1, both positive.
#[test]
fn uniqueness_for_every_right_hand_side_is_decided() {
    let cases = [
        (
            r#"{"M": [[2, 1], [1, 2]], "q": [-1, 1]}"#,
            "one",
            "Proven: for every q there is exactly one solution (M is a P-matrix).",
        ),
        (
            r#"{"M": [[1, 2], [2, 1]], "q": [1, 1]}"#,
            "not_one",
            "For some q there are several solutions or none (M is not a P-matrix)",
        ),
        (
            r#"{"M": [[1, -1], [-1, 1]], "q": [-1, 1]}"#,
            "singular",
            "For some q there is no solution or infinitely many (M is not a P-matrix)",
        ),
        (
            r#"{"A": [[2]], "B": [[1]], "b": [1]}"#,
            "one",
            "Proven: for every b there is exactly one solution.",
        ),
        (
            r#"{"columns_positive": [[1]], "columns_negative": [[-1]], "right_hand_side": [1],
                "jumps_positive": [[1]], "jumps_negative": [[0]]}"#,
            "jumps",
            "Not decided: whether there is exactly one solution",
        ),
    ];
    for (problem, answer, words) in cases {
        let text = slideway_reading(&["modes", "-", "--uniqueness"], problem.as_bytes());
        let told = text.stdout;
        assert!(told.contains(words), "{told}");
        let json = slideway_reading(&["modes", "-", "--uniqueness", "--format", "json"], problem.as_bytes());
        let json: Value = serde_json::from_str(&json.stdout).unwrap();
        assert_eq!(json["every_right_hand_side"]["answer"], answer);
        let plain = slideway_reading(&["modes", "-", "--format", "json"], problem.as_bytes());
        assert!(!plain.stdout.contains("every_right_hand_side"));
    }
}

#[test]
fn bad_problems_are_refused() {
    for folder in [folder("bad"), folder("npz")] {
        let mut names = names(&folder);
        names.retain(|name| folder.ends_with("bad") || name.starts_with("bad"));
        assert!(names.len() > 6, "the files are gone");
        for name in names {
            let (code, text) = transcript(&folder, &name);
            assert_eq!(code, 2, "{name}");
            golden(&format!("bad__{name}"), &text);
        }
    }
}

/// Archives written by NumPy with entries of every kind hold the same problem.
#[test]
fn archives_of_numpy_are_read() {
    let directory = folder("npz");
    let mut answers = Vec::new();
    for name in names(&directory).iter().filter(|name| !name.starts_with("bad")) {
        let (code, text) = transcript(&directory, name);
        assert_eq!(code, 0, "{name}");
        answers.push(text);
    }
    assert_eq!(answers.len(), 7);
    assert!(answers.iter().all(|answer| *answer == answers[0]));
    // z = (1, 0, 2): w = M z + q = (0, 2, 0).
    for line in ["  1   1   0\n", "  2   0   2\n", "  3   2   0\n"] {
        assert!(answers[0].contains(line), "{}", answers[0]);
    }
}

const RAY: &str = "crates/slideway-cli/tests/raw/good/ray.json";
const EIGHT: &str = "crates/slideway-cli/tests/raw/good/eight.json";

fn json(arguments: &[&str]) -> (i32, Value) {
    let run = slideway(arguments);
    (run.code, serde_json::from_str(&run.stdout).unwrap())
}

#[test]
fn json_has_the_fields_that_are_promised() {
    let (code, report) = json(&["modes", RAY, "--format", "json"]);
    assert_eq!(
        (code, &report["schema"], &report["status"]),
        (0, &"slideway/modes/3".into(), &"continuum".into())
    );
    assert_eq!((&report["complete"], &report["count"]), (&"proven".into(), &"0".into()));
    assert_eq!((&report["continuum_count"], &report["solutions"]), (&"1".into(), &serde_json::json!([])));
    let part = &report["continua"][0]["parts"][0];
    assert_eq!(part["directions"][0]["z"], serde_json::json!([1.0, 1.0]));
    assert_eq!((&part["indices"], &part["vertex_count"]), (&serde_json::json!([0, 1]), &1.into()));
}

/// Twenty species, each of which hinders the others twice as much as itself: any of them can live together without the
/// others, `z = 1 / (2 k - 1)` for `k` of them, so there are 2^20 - 1 equilibria, which takes much longer than a second.
fn species(folder: &Path) -> String {
    let rows: Vec<Vec<f64>> =
        (0..20).map(|row| (0..20).map(|column| if row == column { 1.0 } else { 2.0 }).collect()).collect();
    let path = folder.join("species.json");
    std::fs::write(&path, serde_json::json!({"M": rows, "q": vec![-1.0; 20]}).to_string()).unwrap();
    path.to_str().unwrap().to_owned()
}

#[cfg(unix)]
#[test]
fn an_interruption_keeps_what_was_found() {
    let folder = tempfile::tempdir().unwrap();
    let problem = species(folder.path());
    for signal in ["-INT", "-TERM"] {
        let child = command(&["modes", &problem, "--format", "json"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        sleep(Duration::from_secs(2));
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{signal}");
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((&report["status"], &report["partial"]), (&"several".into(), &true.into()));
        assert!(report["count"].as_str().unwrap().parse::<u32>().unwrap() > 1, "{report}");
        assert!(report["open"][0].as_str().unwrap().contains("on request"), "{report}");
    }
}

#[test]
fn a_time_limit_holds() {
    let folder = tempfile::tempdir().unwrap();
    let problem = species(folder.path());
    let begun = Instant::now();
    let (code, report) = json(&["modes", &problem, "--format", "json", "--time-limit", "1s"]);
    assert_eq!((code, &report["partial"]), (0, &true.into()));
    // One second more, and as much again for a busy machine.
    assert!(begun.elapsed() < Duration::from_secs(3), "{:?}", begun.elapsed());
}

#[test]
fn a_limit_of_solutions_ends_the_search() {
    let (code, report) = json(&["modes", EIGHT, "--format", "json", "--max-found", "2"]);
    assert_eq!((code, &report["count"], &report["partial"]), (0, &"2".into(), &true.into()));
    assert!(report["open"][0].as_str().unwrap().contains("--max-found"), "{report}");
}

#[test]
fn fewer_solutions_are_listed_than_counted() {
    let (code, report) = json(&["modes", EIGHT, "--format", "json", "--max-solutions", "3"]);
    assert_eq!((code, &report["count"]), (0, &"8".into()));
    assert_eq!(report["solutions"].as_array().unwrap().len(), 3);
    let run = slideway(&["modes", EIGHT, "--max-solutions", "1"]);
    assert!(run.stdout.contains("Listed: the first 1 of 8"), "{}", run.stdout);
}

#[test]
fn an_early_end_is_told() {
    for limit in [["--max-nodes", "0"], ["--time-limit", "0s"]] {
        let run = slideway(&["modes", EIGHT, limit[0], limit[1]]);
        assert_eq!(run.code, 3, "{}", run.stdout);
        golden(&format!("early_end{}", limit[0]), &run.stdout);
    }
}

#[test]
fn the_ending_of_the_output_file_tells_its_form() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str| {
        let path = directory.path().join(name);
        let run = slideway(&["modes", RAY, "--output", path.to_str().unwrap()]);
        assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
        std::fs::read(path).unwrap()
    };
    assert!(write("ray.npz").starts_with(b"PK"));
    assert!(write("ray.json").starts_with(b"{"));
    assert!(write("ray.txt").starts_with(b"Linear"));
    let again = slideway(&["modes", RAY, "--output", directory.path().join("ray.npz").to_str().unwrap()]);
    assert_eq!(again.code, 2);
}

#[test]
fn problems_come_from_standard_input() {
    let text = std::fs::read(top().join(RAY)).unwrap();
    assert_eq!(slideway_reading(&["modes", "-"], &text).stdout, slideway(&["modes", RAY]).stdout);
    let archive = std::fs::read(folder("npz").join("plain.npz")).unwrap();
    assert_eq!(slideway_reading(&["modes", "-"], &archive).code, 0);
}

#[test]
fn faulty_arguments_are_refused() {
    for (name, arguments) in [
        ("absent", vec!["modes", "nowhere.json"]),
        ("time", vec!["modes", RAY, "--time-limit", "3 days"]),
        ("directory", vec!["modes", "models"]),
    ] {
        let run = slideway(&arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""));
        golden(&format!("arguments__{name}"), &run.stderr);
    }
    golden("help", &slideway(&["modes", "--help"]).stdout);
}

/// Lines are answered in order; one that is no problem does not end the batch.
#[test]
fn a_batch_answers_every_line_in_order() {
    let lines: String = (0..600)
        .map(|line| match line {
            4 => "{\"M\": [[1, 2]], \"q\": [0, 1]}\n".to_owned(),
            5 => "\n".to_owned(),
            // w = z - line: z = line.
            _ => format!("{{\"M\": [[1]], \"q\": [-{line}]}}\n"),
        })
        .collect();
    let run = slideway_reading(&["modes", "-", "--json-lines"], lines.as_bytes());
    assert_eq!((run.code, run.stderr.as_str()), (2, ""));
    let answers: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(answers.len(), 600);
    for (line, answer) in answers.iter().enumerate().filter(|(line, _)| ![4, 5].contains(line)) {
        assert_eq!(answer["solutions"][0]["z"], serde_json::json!([line as f64]));
    }
    assert_eq!((&answers[4]["line"], &answers[5]["line"]), (&5.into(), &6.into()));
    assert!(answers[4]["faults"][0].as_str().unwrap().contains("`M` is a 1 x 2 matrix"), "{}", answers[4]);
    assert!(answers[5]["faults"][0].as_str().unwrap().contains("the problem is empty"), "{}", answers[5]);
    // Without faults, and without a line end behind the last one; standard input need not be named.
    let run = slideway_reading(&["modes", "--json-lines"], br#"{"M": [[0]], "q": [-1]}"#);
    assert_eq!((run.code, run.stdout.lines().count()), (0, 1));
    assert_eq!(slideway_reading(&["modes"], b"").code, 2);
    assert!(slideway_reading(&["modes", "-", "--json-lines"], b"").stdout.is_empty());
}

/// Another program may wait for an answer before it asks the next question.
#[test]
fn a_batch_answers_a_line_before_the_next_one() {
    use std::io::{BufRead, BufReader, Write};
    let mut child = command(&["modes", "-", "--json-lines"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let (mut questions, mut answers) =
        (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
    for value in 1..=3 {
        writeln!(questions, "{{\"M\": [[1]], \"q\": [-{value}]}}").unwrap();
        let mut answer = String::new();
        answers.read_line(&mut answer).unwrap();
        let answer: Value = serde_json::from_str(&answer).unwrap();
        assert_eq!(answer["solutions"][0]["z"], serde_json::json!([f64::from(value)]));
    }
    drop(questions);
    assert!(child.wait().unwrap().success());
}

/// Each solution in a line of its own, and then what is known: the counts of the list.
#[test]
fn a_stream_writes_each_solution_and_then_a_conclusion() {
    let run = slideway(&["modes", EIGHT, "--stream"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let mut lines: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let last = lines.pop().unwrap();
    let (_, report) = json(&["modes", EIGHT, "--format", "json"]);
    let solutions: Vec<Value> = lines.iter().map(|line| line["solution"].clone()).collect();
    let listed = report["solutions"].as_array().unwrap();
    assert!(solutions.len() == listed.len() && listed.iter().all(|one| solutions.contains(one)), "{lines:?}");
    let conclusion = &last["conclusion"];
    for field in ["schema", "type", "status", "complete", "count", "nodes"] {
        assert_eq!(conclusion[field], report[field], "{field}");
    }
    assert_eq!(conclusion["lines"], lines.len());
    assert_eq!(
        (&conclusion["all_written"], &conclusion["part_of_others"]),
        (&true.into(), &serde_json::json!([]))
    );
    assert!(conclusion["seconds"].as_f64().unwrap() > 0.0);
}

/// 2^100 combinations: the first comes without the others, and time ends the rest.
#[test]
fn a_stream_ends_in_time_and_with_its_reader() {
    use std::io::{BufRead, BufReader, Write};
    let m: Vec<Vec<f64>> =
        (0..100).map(|row| (0..100).map(|k| if k == row { -1.0 } else { 0.0 }).collect()).collect();
    let problem = serde_json::json!({"M": m, "q": vec![1.0; 100]}).to_string();
    let run = slideway_reading(&["modes", "-", "--stream", "--time-limit", "500ms"], problem.as_bytes());
    let last: Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
    assert_eq!((run.code, &last["conclusion"]["all_written"]), (0, &false.into()));
    assert_eq!(last["conclusion"]["lines"], run.stdout.lines().count() - 1);
    let mut child =
        command(&["modes", "-", "--stream"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(problem.as_bytes()).unwrap();
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    assert!(first.starts_with("{\"solution\""), "{first}");
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_count_needs_no_list() {
    let (code, report) = json(&["modes", EIGHT, "--format", "json", "--count-only"]);
    assert_eq!((code, &report["count"], &report["complete"]), (0, &"8".into(), &"proven".into()));
    assert_eq!(report["solutions"], serde_json::json!([]));
    let run = slideway(&["modes", EIGHT, "--count-only"]);
    assert!(run.stdout.contains("8 solutions.") && !run.stdout.contains("Solution 1"), "{}", run.stdout);
}

/// w = -z + 1 for each of 100 unknowns that do not depend on each other: one solution of each is enough.
#[test]
fn one_solution_is_enough() {
    let m: Vec<Vec<f64>> =
        (0..100).map(|row| (0..100).map(|k| if k == row { -1.0 } else { 0.0 }).collect()).collect();
    let problem = serde_json::json!({"M": m, "q": vec![1.0; 100]}).to_string();
    let arguments = ["modes", "-", "--any", "--format", "json"];
    let run = slideway_reading(&arguments, problem.as_bytes());
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((run.code, &report["count"], &report["partial"]), (0, &"1".into(), &true.into()));
    assert_eq!(report["solutions"][0]["residual"], 0.0);
    assert!(report["open"][0].as_str().unwrap().contains("--any"), "{report}");
    // w_1 = 1 - z_1, w_2 = 2 z_1 - 1, eight times: z_1 = 0 has no w_2, z_1 = 1 has. What others depend on is not cut
    // off at the first of its solutions.
    let m: Vec<Vec<f64>> = (0..16)
        .map(|row| (0..16).map(|k| if k == row / 2 * 2 { [-1.0, 2.0][row % 2] } else { 0.0 }).collect())
        .collect();
    let q: Vec<f64> = (0..16).map(|row| [1.0, -1.0][row % 2]).collect();
    let run = slideway_reading(&arguments, serde_json::json!({"M": m, "q": q}).to_string().as_bytes());
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(report["count"], "1", "{report}");
}

/// The unknowns of every type of problem are arrays under their names, whose lengths may differ.
#[test]
fn archives_of_answers_have_the_names_of_the_problem() {
    let cases: [(&str, &[&str]); 3] = [
        ("game.json", &["x", "y", "payoff_1", "payoff_2", "vertex_x", "vertex_payoff_1"]),
        ("mixed.json", &["u", "z", "w"]),
        ("bounds.json", &["z", "w", "signs"]),
    ];
    for (file, names) in cases {
        let path = folder("good").join(file);
        let output = command(&["modes", path.to_str().unwrap(), "--format", "npz"]).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        for name in names {
            assert!(text.contains(&format!("{name}.npy")), "{file}: {name}");
        }
    }
}

/// The checker of proofs shares nothing with slideway.
#[test]
fn proofs_are_accepted_by_the_checker() {
    let checker = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference/check_proof.py");
    let folder_of_proofs = Path::new(env!("CARGO_TARGET_TMPDIR")).join("proofs");
    std::fs::create_dir_all(&folder_of_proofs).unwrap();
    let good = folder("good");
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/klepp-2002.toml");
    let problems =
        ["ray.json", "none.json", "game.json", "bounds.json"].map(|name| ("modes", good.join(name)));
    for (command_name, problem) in problems.into_iter().chain([("solve", model)]) {
        let name = problem.file_stem().unwrap().to_str().unwrap();
        let proof = folder_of_proofs.join(format!("{name}.txt"));
        let arguments =
            [command_name, problem.to_str().unwrap(), "--force", "--proof", proof.to_str().unwrap()];
        let output = command(&arguments).output().unwrap();
        let note = String::from_utf8(output.stderr).unwrap();
        assert!(note.contains("the proof has "), "{name}: {note}");
        // The note names the problem that the checker reads.
        let own = folder_of_proofs.join(format!("{name}.txt.json"));
        let read = if note.contains(".txt.json") { &own } else { &problem };
        let checked = Command::new("python3").args([&checker, read, &proof]).output().unwrap();
        let said = String::from_utf8([checked.stdout, checked.stderr].concat()).unwrap();
        assert!(checked.status.success() && said.starts_with("verified"), "{name}: {said}");
    }
}
