//! `slideway simulate`: what is refused, what ends a motion early, files.

#![allow(clippy::unwrap_used)]

mod command;

use command::{Run, command, slideway, slideway_reading};

const OSCILLATOR: &str = "models/frictional-oscillator.toml";
const KLEPP: &str = "models/klepp-2002-spring.toml";

/// A block of 1 kg on a rough floor, pushed along it.
fn pushed(force: &str) -> String {
    format!(
        r#"
gravity = "10 m/s^2"
[points]
C = [0, 0]
[bodies.block]
points = ["C"]
mass = "1 kg"
centre_of_mass = "C"
shape = {{ rectangle = ["0.2 m", "0.1 m"] }}
[joints.floor]
type = "guided_slider"
block = "block"
at = "C"
along = "0 deg"
length = "0.2 m"
mu = 0.1
[loads.push]
type = "force"
at = "block.C"
components = ["{force}", 0]
[coordinates.x]
slide = "floor"
rate = "5 m/s"
"#
    )
}

fn refused(arguments: &[&str]) -> String {
    let run = slideway(arguments);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert_eq!(run.stdout, "");
    run.stderr
}

#[track_caller]
fn assert_tells(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing in\n{text}");
    }
}

#[test]
fn times_that_make_no_sense_are_refused() {
    for until in ["0s", "-1s"] {
        let message = refused(&["simulate", OSCILLATOR, "--until", until]);
        assert_tells(&message, &["is not after its start", "--until"]);
    }
    let message = refused(&["simulate", OSCILLATOR, "--until", "2 s", "--time", "3 s"]);
    assert_tells(&message, &["the end of the simulation, 2 s, is not after its start, 3 s"]);
    let message = refused(&["simulate", OSCILLATOR, "--until", "3 kg"]);
    assert_tells(&message, &["--until=3 kg", "command line"]);
    let message = refused(&["simulate", OSCILLATOR, "--until", "3s", "--step", "0 ms"]);
    assert_tells(&message, &["--step", "greater than zero"]);
    let message = refused(&["simulate", OSCILLATOR, "--until", "3s", "--step", "1e-9 s"]);
    assert_tells(&message, &["rows", "choose a longer --step"]);
    refused(&["simulate", OSCILLATOR, "--until", "3s", "--tolerance", "0"]);
    refused(&["simulate", OSCILLATOR, "--until", "1/0"]);
}

#[test]
fn a_contradictory_mode_is_refused_with_those_that_exist() {
    let message = refused(&["simulate", KLEPP, "--until", "1s", "--mode", "- - -"]);
    assert_tells(&message, &["cannot begin in the contact mode `- - -`", "possible at the start: `"]);
    let message = refused(&["simulate", KLEPP, "--until", "1s", "--mode", "+ +"]);
    assert_tells(&message, &["upper, lower.front, lower.rear", "= is a contact whose joint sticks"]);
}

#[test]
fn a_state_that_cannot_be_assembled_is_refused() {
    let crank = "models/slider-crank.toml";
    let message = refused(&["simulate", crank, "--until", "1s", "--set", "l=45 mm", "--at", "phi=90 deg"]);
    assert_tells(&message, &["assembled"]);
}

#[test]
fn files_without_a_known_ending_are_refused() {
    let message = refused(&["simulate", OSCILLATOR, "--until", "1s", "--output", "motion.xls"]);
    assert_tells(&message, &["`motion.xls` is not the name of a time series", ".csv"]);
    let message = refused(&["simulate", OSCILLATOR, "--until", "1s", "--animate", "motion.mp4"]);
    assert_tells(&message, &[".html, .svg, .gif"]);
    let message =
        refused(&["simulate", OSCILLATOR, "--until", "1s", "--all-branches", "--output", "motion.csv"]);
    assert_tells(&message, &["--branch"]);
}

/// 1 N s / sqrt(1.3 s - t) grows without bound towards 1.3 s and has no value behind it.
/// Files that are made as a whole: table, plot and moving picture are written whole or not at all.
#[cfg(unix)]
#[test]
fn files_that_do_not_fit_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    for (options, name) in [
        (&["--output"][..], "motion.csv"),
        (&["--output"], "motion.npz"),
        (&["--plot"], "plot.svg"),
        (&["--animate"], "moving.svg"),
        (&["--slow-motion", "0.2", "--animate"], "moving.gif"),
    ] {
        let path = folder.path().join(name);
        // The system refuses to write more than 1024 bytes, as on a full disk; without the trap its signal
        // would end the program.
        let run = std::process::Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 2; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_slideway")])
            .args(["simulate", OSCILLATOR, "--until", "1s"])
            .args(options)
            .arg(&path)
            .current_dir(command::top())
            .output()
            .unwrap();
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{name}: {said}");
        assert_tells(&said, &[name, "cannot be written: file too large"]);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{name}");
    }
}

/// 0.2 s shown in 0.2 s: 5 steps of 0.04 s and the end.
#[test]
fn a_gif_moves_and_does_not_depend_on_the_threads() {
    let folder = tempfile::tempdir().unwrap();
    let made = |name: &str, threads: &str| {
        let path = folder.path().join(name);
        let arguments = ["simulate", KLEPP, "--until", "0.2s", "--slow-motion", "1", "--theme", "dark"];
        let mut run = command(&arguments);
        let run = run.arg("--animate").arg(&path).env("RAYON_NUM_THREADS", threads).output().unwrap();
        (run, std::fs::read(&path).unwrap())
    };
    let (run, bytes) = made("motion.gif", "1");
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let background = decoder.global_palette().unwrap()[..3].to_vec();
    assert_eq!(background, [0x0d, 0x11, 0x17], "that of the dark theme");
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        frames.push((frame.delay, frame.width, frame.height));
    }
    assert_eq!(frames.iter().map(|frame| frame.0).collect::<Vec<_>>(), [4; 6]);
    assert!(frames.iter().all(|frame| frame.1 > 100 && frame.2 > 100), "all move: {frames:?}");
    assert_eq!(made("again.gif", "2").1, bytes);

    let (refused, kept) = made("motion.gif", "1");
    assert_eq!(refused.status.code(), Some(2));
    assert_tells(&String::from_utf8(refused.stderr).unwrap(), &["motion.gif` already exists", "--force"]);
    assert_eq!(kept, bytes);
}

#[test]
fn a_gif_whose_frames_would_stand_too_long_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motion.gif");
    let slow = ["simulate", OSCILLATOR, "--until", "1s", "--slow-motion", "1e6", "--animate"];
    let message = refused(&[&slow[..], &[path.to_str().unwrap()]].concat());
    // 400 steps of 2500 s
    assert_tells(&message, &["2500 s", "655 s"]);
    assert!(!path.exists());
}

#[test]
fn a_load_without_a_value_ends_the_motion_and_keeps_what_was_computed() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("motion.csv");
    let model = pushed("1 N * sqrt(1.3 - t/(1 s))");
    let arguments = ["simulate", "-", "--until", "2s", "--output", file.to_str().unwrap()];
    let Run { code, stdout, .. } = slideway_reading(&arguments, model.as_bytes());
    assert_eq!(code, 2);
    assert_tells(&stdout, &["It ends at 1.3 s", "At the end: x = "]);
    let rows = std::fs::read_to_string(&file).unwrap();
    let last: f64 = rows.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
    assert!((last - 1.3).abs() < 1e-6, "{last}");
    assert!(!rows.contains("NaN") && !rows.contains("inf"));
}

#[test]
fn the_step_limit_is_told_with_the_state() {
    let run = slideway(&["simulate", OSCILLATOR, "--until", "3s", "--max-steps", "20"]);
    assert_eq!(run.code, 3);
    assert_tells(&run.stdout, &["in 20 steps, the most allowed", "At the end: x = "]);
}

#[test]
fn the_time_limit_is_told_with_the_state_and_keeps_what_was_computed() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("motion.csv");
    let path = file.to_str().unwrap();
    let run = slideway(&["simulate", KLEPP, "--until", "1e6 s", "--time-limit", "300ms", "--output", path]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert_tells(&run.stdout, &["Not finished: it was followed to ", "At the end: q = "]);
    assert!(std::fs::read_to_string(&file).unwrap().lines().count() > 1);
}

/// An interruption leaves nothing under the names of files that it would have written, and keeps the table
/// beside.
#[cfg(unix)]
#[test]
fn an_interrupted_motion_keeps_its_table_beside() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["simulate", KLEPP, "--until", "1e7 s", "--output"];
    let file = folder.path().join("motion.csv");
    let plot = folder.path().join("motion.svg");
    let mut command = command::command(&words);
    command.arg(&file).arg("--plot").arg(&plot);
    command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let child = command.spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert_tells(
        &String::from_utf8(output.stdout).unwrap(),
        &["Not finished: it was followed to ", "At the end: q = "],
    );
    assert_tells(&said, &["the table of the motion so far is in", "motion.csv.partial"]);
    assert!(!file.exists() && !plot.exists());
    let partial = folder.path().join("motion.csv.partial");
    assert!(std::fs::read_to_string(partial).unwrap().lines().count() > 1);
}

#[test]
fn a_normal_force_beyond_its_limit_ends_the_motion() {
    let run = slideway(&["simulate", KLEPP, "--until", "1s", "--max-reaction", "10"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert_tells(&run.stdout, &["the normal force of upper reaches its limit", "At the end: q = "]);
}

/// What is refused, in full: exit code, message, place and help.
#[test]
fn refusals_in_words() {
    let refusals: [&[&str]; 5] = [
        &["simulate", OSCILLATOR, "--until", "0s"],
        &["simulate", OSCILLATOR, "--until=-1s"],
        &["simulate", KLEPP, "--until", "1s", "--mode", "- - -"],
        &["simulate", KLEPP, "--until", "1s", "--mode", "+ +"],
        &["simulate", "models/slider-crank.toml", "--until", "1s", "--set", "l=45 mm", "--at", "phi=90 deg"],
    ];
    let told =
        refusals.map(|arguments| format!("$ slideway {}\n{}", arguments.join(" "), refused(arguments)));
    insta::assert_snapshot!(told.join("\n"));
}

/// What ends early, up to the balance of energy, whose errors are rounding.
#[test]
fn early_ends_in_words() {
    let model = pushed("1 N * sqrt(1.3 - t/(1 s))");
    let no_value = slideway_reading(&["simulate", "-", "--until", "2s"], model.as_bytes());
    let steps = slideway(&["simulate", OSCILLATOR, "--until", "3s", "--max-steps", "20"]);
    let told = [no_value, steps].map(|run| {
        let (story, _) = run.stdout.split_once("\nEnergy").unwrap();
        format!("exit code {}\n{story}{}", run.code, run.stderr)
    });
    insta::assert_snapshot!(told.join("\n"));
}

#[test]
fn a_branch_that_does_not_exist_is_told() {
    let run = slideway(&["simulate", OSCILLATOR, "--until", "3s", "--branch", "7"]);
    assert_eq!(run.code, 2);
    assert_tells(&run.stdout, &["there is no branch with the number asked for"]);
}

#[test]
fn json_has_its_schema_and_the_table_its_step() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("motion.json");
    let path = file.to_str().unwrap();
    let arguments =
        ["simulate", OSCILLATOR, "--until", "0.5 s", "--step", "0.1 s", "--output", path, "--format", "json"];
    let run = slideway(&arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let told: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(told["schema"], "slideway/simulate/1");
    assert!(told.get("samples").is_none());
    let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let times: Vec<f64> = written["samples"]["columns"][0]["values"]
        .as_array()
        .unwrap()
        .iter()
        .map(|time| time.as_f64().unwrap())
        .collect();
    assert_eq!(times.len(), 6);
    assert!(times.iter().enumerate().all(|(index, time)| (time - 0.1 * index as f64).abs() < 1e-15));
}

/// Twice, and with any number of threads: one motion, and all branches in their order.
#[test]
fn the_same_command_gives_the_same_bytes() {
    let single = ["simulate", KLEPP, "--until", "0.5s", "--format", "json"];
    let branches = [
        "simulate",
        KLEPP,
        "--until",
        "0.4s",
        "--set",
        "mu_1=0.35",
        "--all-branches",
        "--max-motions",
        "6",
        "--format",
        "json",
    ];
    for arguments in [&single[..], &branches] {
        let first = slideway(arguments).stdout;
        assert!(first.len() > 1000);
        for threads in ["1", "2", "7"] {
            let output = command(arguments).env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert!(first.as_bytes() == output.stdout, "{threads}");
        }
    }
    let told: serde_json::Value = serde_json::from_str(&slideway(&branches).stdout).unwrap();
    let histories = told["histories"].as_array().unwrap();
    let taken: Vec<Vec<u64>> = histories
        .iter()
        .map(|one| {
            one["branches"].as_array().unwrap().iter().map(|branch| branch.as_u64().unwrap()).collect()
        })
        .collect();
    // At each of three stops the bar wedges itself for good or slides back.
    let expected: [&[u64]; 4] = [&[1], &[2, 1], &[2, 2, 1], &[2, 2, 2]];
    assert_eq!(taken, expected);
}
