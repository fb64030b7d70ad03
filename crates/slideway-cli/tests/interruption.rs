//! Commands that take long end in time and when they are interrupted, and say so.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod command;

use command::{command, slideway};
use std::fmt::Write as _;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A boom with so many stages, 4^n contact modes.
fn boom(folder: &Path, stages: u8) -> String {
    let path = folder.join(format!("boom{stages}.toml"));
    let run = slideway(&["models", "telescopic-boom", "--stages", &stages.to_string()]);
    fs::write(&path, run.stdout).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Every command that can take long, on something that does: minutes, with this build.
fn long_commands(folder: &Path) -> Vec<(Vec<String>, Option<String>)> {
    let (four, seven) = (boom(folder, 4), boom(folder, 7));
    let file = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let [map, page, plot] = ["map.svg", "page.html", "plot.svg"].map(file);
    let range = "overlap=0.3 m..0.9 m";
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    vec![
        (words(&["limits", &seven, "--vary", "friction"]), None),
        (words(&["limits", &seven, "--vary", range, "--plot", &plot]), Some(plot.clone())),
        (words(&["sweep", &seven, "--vary", "overlap=0.3 m..0.9 m:101"]), None),
        (words(&["size", &four, "--vary", range, "--margin", "2", "--against", "hold", "--load", "W"]), None),
        (words(&["size", &four, "--vary", "overlap=0.3..0.9", "--margin", "2"]), None),
        (words(&["map", &four, "--x", "mu=0..1", "--y", range, "--probe", "1", "--output", &map]), Some(map)),
        (words(&["report", &seven, "--vary", range, "--output", &page]), Some(page)),
    ]
}

#[test]
fn a_time_limit_ends_every_long_command_in_time_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (mut words, file) in long_commands(folder.path()) {
        words.extend(["--time-limit".to_owned(), "300ms".to_owned()]);
        let begun = Instant::now();
        let run = slideway(&words.iter().map(String::as_str).collect::<Vec<_>>());
        let took = begun.elapsed();
        assert_eq!(run.code, 3, "{words:?}: {}", run.stderr);
        let told = "error: ended by the time limit of 300 ms before there was an answer; nothing is written";
        assert!(run.stderr.starts_with(told), "{words:?}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{words:?}: {}", run.stdout);
        assert!(took < Duration::from_secs(20), "{words:?} took {took:?}");
        assert!(file.is_none_or(|file| !Path::new(&file).exists()), "{words:?}");
    }
}

/// A cart with so many bars, one hanging from the other: some steps of every question on hundreds of bodies take seconds.
fn bars(folder: &Path, number: usize) -> String {
    let mut points = String::from("[parameters]\nmu = 0.2\n[points]\np0 = [0, 0]\n");
    let mut rest = String::from(
        "[bodies.b0]\npoints = ['p0']\nmass = 1\nmoment_of_inertia = 0.01\ncentre_of_mass = 'p0'\n[joints.s]\ntype = 'block_slider'\n\
         block = 'b0'\nat = 'p0'\nalong = 0\nlength = 0.1\nmu = 'mu'\n[coordinates.x]\nslide = 's'\nrate = 1\n",
    );
    for bar in 1..=number {
        let above = bar - 1;
        writeln!(points, "p{bar} = [{}, 0]", 0.1 * bar as f64).unwrap();
        write!(
            rest,
            "[bodies.b{bar}]\npoints = ['p{above}', 'p{bar}']\nmass = 1\nmoment_of_inertia = 0.01\ncentre_of_mass = 'p{bar}'\n\
             [joints.h{bar}]\ntype = 'hinge'\nbetween = ['b{bar}.p{above}', 'b{above}.p{above}']\n\
             [coordinates.q{bar}]\nrotation = 'b{bar}'\nrate = 0.1\n"
        ).unwrap();
    }
    let path = folder.join("bars.toml");
    fs::write(&path, points + &rest).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Within a step that does not look at the time the program ends a second past the limit.
#[test]
fn a_time_limit_ends_questions_on_hundreds_of_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let bars = bars(folder.path(), 400);
    for words in [&["limits", &bars, "--vary", "mu"][..], &["hold", &bars]] {
        let begun = Instant::now();
        let run = slideway(&[words, &["--time-limit", "100ms"]].concat());
        let took = begun.elapsed();
        let told = "error: ended by the time limit of 100 ms before there was an answer; nothing is written";
        assert!(run.code == 3 && run.stderr.contains(told), "{words:?}: {} {}", run.code, run.stderr);
        assert!(took < Duration::from_secs(5), "{words:?} took {took:?}");
    }
}

/// `hold` refuses what would take minutes: its 20,736 states take half a second with this build.
#[test]
fn a_time_limit_ends_hold_between_states() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&["hold", &boom(folder.path(), 4), "--load", "W", "--time-limit", "50ms"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let told = "error: ended by the time limit of 50 ms before there was an answer; nothing is written";
    assert!(run.stderr.starts_with(told) && run.stdout.is_empty(), "{}", run.stderr);
}

/// Starts a command, waits until it works, sends it a signal, and says how it ended.
fn signalled(words: &[String], signal: &str) -> (Option<i32>, String, Duration) {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let mut child = command(&words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    sleep(Duration::from_millis(700));
    let begun = Instant::now();
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    let code = child.wait().unwrap().code();
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    (code, said, begun.elapsed())
}

#[test]
fn an_interruption_ends_every_long_command_soon() {
    let folder = tempfile::tempdir().unwrap();
    for ((words, file), signal) in
        long_commands(folder.path()).into_iter().zip(["-INT", "-TERM"].into_iter().cycle())
    {
        let (code, said, took) = signalled(&words, signal);
        assert_eq!(code, Some(130), "{words:?}: {said}");
        let told = "error: interrupted before there was an answer; nothing is written";
        assert!(said.starts_with(told), "{words:?}: {said}");
        assert!(took < Duration::from_secs(20), "{words:?} took {took:?}");
        assert!(file.is_none_or(|file| !Path::new(&file).exists()), "{words:?}");
    }
}

/// 400 frames of a millisecond: the motion takes no time, its picture half a minute with this build.
#[test]
fn a_gif_ends_between_frames_and_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motion.gif").to_str().unwrap().to_owned();
    let words =
        ["simulate", "models/klepp-2002-spring.toml", "--until", "1ms", "--slow-motion", "1e5", "--animate"];
    let words: Vec<String> = words.into_iter().map(str::to_owned).chain([path.clone()]).collect();
    for signal in ["-INT", "-TERM"] {
        let (code, said, took) = signalled(&words, signal);
        assert_eq!(code, Some(130), "{said}");
        assert!(said.starts_with(&format!("error: interrupted before `{path}` was done")), "{said}");
        assert!(took < Duration::from_secs(20), "{took:?}");
    }
    let limited: Vec<&str> = words.iter().map(String::as_str).chain(["--time-limit", "1s"]).collect();
    let run = slideway(&limited);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let told = format!("error: ended by the time limit of 1 s before `{path}` was done; it is not written");
    assert!(run.stderr.starts_with(&told), "{}", run.stderr);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Forty unknowns that are nearly independent of each other: w_k = 1 - z_k + little, so that there are 2^40
/// solutions.
fn hard_problem() -> String {
    let n = 40;
    let entry = |row: usize, column: usize| match (row, column) {
        _ if row == column => -1.0,
        _ => 1e-4 * ((7 * row + 3 * column) % 11) as f64,
    };
    let rows: Vec<Vec<f64>> = (0..n).map(|row| (0..n).map(|column| entry(row, column)).collect()).collect();
    format!("{{\"type\": \"lcp\", \"M\": {rows:?}, \"q\": {:?}}}", vec![1.0; n])
}

#[test]
fn an_interrupted_search_tells_what_it_has_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("problem.json");
    fs::write(&path, hard_problem()).unwrap();
    let mut child = command(&["modes", path.to_str().unwrap()])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    sleep(Duration::from_secs(1));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let mut told = String::new();
    child.stdout.take().unwrap().read_to_string(&mut told).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(told.contains("stopped by a time limit or on request"), "{told}");
}

#[test]
fn an_interrupted_stream_of_rows_says_how_far_it_came() {
    let words =
        ["sweep", "models/klepp-2002.toml", "--vary", "alpha=1.1 rad..1.4 rad:3000001", "--no-breakpoints"];
    let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
    let (code, said, _) = signalled(&words, "-TERM");
    assert_eq!(code, Some(130), "{said}");
    assert!(said.starts_with("error: interrupted after ") && said.contains(" of 3000001 points"), "{said}");
}

/// Starts or goes on with a sweep of 24 contacts, a tenth of a second for each point, for two seconds; how
/// many points are kept, and the lines of the table so far.
fn swept_for_two_seconds(model: &str, output: &Path, more: &str) -> (u64, Vec<String>) {
    let words =
        ["sweep", model, "--vary", "friction=0.5..0.9:100001", "--no-breakpoints", "--time-limit", "2s"];
    let begun = Instant::now();
    let run = slideway(&[&words[..], &["--output", output.to_str().unwrap(), more]].concat());
    assert!(begun.elapsed() < Duration::from_secs(20), "took {:?}", begun.elapsed());
    assert_eq!(run.code, 3, "{}", run.stderr);
    let told = run.stderr.strip_prefix("error: ended by the time limit of 2 s after ");
    let points = told.and_then(|told| told.split_once(" of 100001 points; they are kept in"));
    let done = points.unwrap_or_else(|| panic!("{}", run.stderr)).0.parse().unwrap();
    let table = fs::read_to_string(output.with_extension("csv.partial")).unwrap();
    (done, table.lines().map(str::to_owned).collect())
}

#[test]
fn slow_points_that_are_done_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let (model, table) = (boom(folder.path(), 6), folder.path().join("table.csv"));
    let (first, lines) = swept_for_two_seconds(&model, &table, "--force");
    assert!(first > 0, "two seconds are enough for a point");
    let (then, more) = swept_for_two_seconds(&model, &table, "--resume");
    assert!(then > first && more.len() > lines.len(), "{then} points after {first}");
    assert_eq!(more[..lines.len()], lines);
}

#[test]
fn a_tolerance_below_the_accuracy_of_numbers_is_refused() {
    let run = slideway(&["simulate", "models/drawer.toml", "--until", "10ms", "--tolerance", "1e-30"]);
    assert_eq!(run.code, 2);
    let told = "the tolerance 1e-30 is finer than floating point resolves";
    assert!(run.stderr.contains(told) && run.stdout.is_empty(), "{}{}", run.stdout, run.stderr);
    // Twice the machine epsilon, 2^-52: positions of the drawer are no greater than its size.
    let run = slideway(&["simulate", "models/drawer.toml", "--until", "10ms", "--tolerance", "4.5e-16"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn an_absurd_number_of_threads_is_reduced_and_told() {
    let begun = Instant::now();
    let arguments = ["sweep", "models/drawer.toml", "--vary", "mu=0..0.5:11", "--format", "csv"];
    let run = command(&arguments).env("RAYON_NUM_THREADS", "100000").output().unwrap();
    assert_eq!(run.status.code(), Some(0));
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(said.starts_with("note: RAYON_NUM_THREADS asks for 100000 threads; "), "{said}");
    assert!(begun.elapsed() < Duration::from_secs(10));
}

#[test]
fn residuals_of_the_smallest_forces_are_finite() {
    let arguments = ["models/painleve-klein.toml", "--set", "P_2=0 N", "--set", "l=10 m"];
    let text = slideway(&[&["solve"], &arguments[..]].concat());
    assert!(!text.stdout.contains("inf "), "{}", text.stdout);
    let json = slideway(&[&["solve"], &arguments[..], &["--format", "json"]].concat());
    assert!(!json.stdout.contains("\"residual\": null"), "{}", json.stdout);
}
