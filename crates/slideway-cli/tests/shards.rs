//! Sweeps in shards: what a user says and is told. `crates/slideway-tables/tests/shards.rs` compares more tables
//! and damages every byte.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod command;

use command::{Run, command, slideway};
use slideway::model::Settings;
use slideway::progress::Progress;
use slideway::sweep::{Breakpoints, GridAxis, SampledAxis, Sampling, Shard, Spread, SweepOptions};
use slideway_tables::{Control, ShardedSweep, shard_path, write_shard};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const KLEPP: [&str; 4] = ["sweep", "models/klepp-2002.toml", "--set", "F_20=0"];
const DRAWER: [&str; 2] = ["sweep", "models/drawer.toml"];

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Computes a shard into a folder.
fn shard(sweep: &[&str], shard: &str, folder: &Path) -> Run {
    slideway(&[sweep, &["--shard", shard, "--output", text(folder)]].concat())
}

fn merge(folder: &Path, more: &[&str]) -> Run {
    slideway(&[&["sweep", "--merge", text(folder)], more].concat())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The same bytes, the same words: with an inserted end of a mode and 1000 points for each chunk; over two
/// quantities; of samples.
#[test]
fn merged_shards_are_one_run() {
    for axes in [
        &["--vary", "mu_1=0..0.8:3001"][..],
        &["--vary", "mu_1=0..0.8:51", "--vary", "alpha=1.1 rad..1.4 rad:21", "--attainability"],
        &["--vary", "mu_1=normal(0.4, 0.1)", "--samples", "2500", "--seed", "3"],
    ] {
        let folder = TempDir::new().unwrap();
        let results = folder.path().join("results");
        let sweep = [&KLEPP, axes].concat();
        // In any order.
        for number in [3, 1, 4, 2] {
            let run = shard(&sweep, &format!("{number}/4"), &results);
            assert_eq!((run.code, run.stderr.as_str()), (0, ""));
            assert!(run.stdout.starts_with(&format!("Shard {number}/4, ")), "{}", run.stdout);
        }
        assert_eq!(
            names(&results),
            ["1", "2", "3", "4"].map(|number| format!("shard-{number}-of-4.parquet"))
        );
        for ending in ["parquet", "npz", "csv"] {
            let path = folder.path().join(format!("table.{ending}"));
            let output = ["--output", text(&path)];
            let merged = merge(&results, &output);
            assert_eq!((merged.code, merged.stderr.as_str()), (0, ""));
            let bytes = fs::read(&path).unwrap();
            fs::remove_file(&path).unwrap();
            let whole = slideway(&[&sweep[..], &output].concat());
            assert!(fs::read(&path).unwrap() == bytes, "{axes:?} {ending}");
            assert_eq!(merged.stdout, whole.stdout);
        }
        let (merged, whole) = (merge(&results, &[]), slideway(&sweep));
        assert_eq!((merged.stdout, merged.stderr), (whole.stdout, whole.stderr));
    }
}

/// A program that has numbers and no command line, such as the Python package, writes the same bytes.
#[test]
fn numbers_make_the_same_shards_as_texts() {
    let folder = TempDir::new().unwrap();
    let (typed, made) = (folder.path().join("typed"), folder.path().join("made"));
    let model = fs::read_to_string(command::top().join("models/drawer.toml")).unwrap();
    let settings = Settings::default().position("x", "10 mm").parameter("a", 0.25);
    let list = GridAxis::listed("mu", [0.1, 0.25, 1.0 / 3.0]);
    let line = SweepOptions::grid([list.clone()]).breakpoints(false);
    let sampling = Sampling { count: 9, spread: Spread::Random, seed: 3 };
    let samples = SweepOptions::samples(sampling, [SampledAxis::normal("mu", 0.3, 0.05)]).breakpoints(false);
    let list = ["--vary", "mu=0.1,0.25,0.3333333333333333"];
    let sampled = ["--vary", "mu=normal(0.3, 0.05)", "--samples", "9", "--seed", "3"];
    for (options, words) in [(line, [&list[..], &["--no-breakpoints"]].concat()), (samples, sampled.to_vec())]
    {
        let command = [&DRAWER[..], &["--set", "a=0.25", "--at", "x=10 mm"], &words].concat();
        assert_eq!(shard(&command, "1/1", &typed).code, 0);
        let sharded =
            ShardedSweep::typed(("models/drawer.toml", &model), (&settings, &options), "no such command");
        let sweep = sharded.sweep(Breakpoints::default()).unwrap();
        let mut callback = |_: &Progress| ControlFlow::Continue(());
        let mut control = Control { goes_on: &|| true, callback: &mut callback };
        let one = Shard::new(1, 1).unwrap();
        write_shard(&sharded, (&sweep, one), (&made, false), &mut control).unwrap();
        let [typed, made] = [&typed, &made].map(|folder| shard_path(folder, one));
        assert!(fs::read(&typed).unwrap() == fs::read(&made).unwrap(), "{words:?}");
        for path in [typed, made] {
            fs::remove_file(path).unwrap();
        }
    }
}

/// Threads do not change the bytes of a shard.
#[test]
fn threads_do_not_change_a_shard() {
    let folder = TempDir::new().unwrap();
    let shards = ["1", "3"].map(|threads| {
        let results = folder.path().join(threads);
        let arguments = [&KLEPP[..], &["--vary", "mu_1=0..0.8:30001", "--shard", "2/3", "--output"]].concat();
        let run = command(&arguments).arg(&results).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(run.status.success());
        fs::read(results.join("shard-2-of-3.parquet")).unwrap()
    });
    assert!(shards[0] == shards[1]);
}

#[test]
fn a_shard_that_is_there_is_not_computed_again() {
    let folder = TempDir::new().unwrap();
    let sweep = [&DRAWER[..], &["--vary", "mu=0..0.5:301"]].concat();
    let path = folder.path().join("shard-1-of-1.parquet");
    assert_eq!(shard(&sweep, "1/1", folder.path()).code, 0);
    let written = fs::metadata(&path).unwrap().modified().unwrap();
    let again = shard(&sweep, "1/1", folder.path());
    assert_eq!((again.code, again.stderr.as_str()), (0, ""));
    let told = format!("Shard 1/1 is there: `{}`, points: 301, rows: 301\n", path.display());
    assert_eq!(again.stdout, told);
    assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), written);

    let other = [&DRAWER[..], &["--vary", "mu=0..0.5:302"]].concat();
    let refused = shard(&other, "1/1", folder.path());
    assert_eq!(refused.code, 2);
    let told = "belongs to another sweep (other points or columns): `slideway sweep models/drawer.toml --vary \
        mu=0..0.5:301`";
    assert!(refused.stderr.contains(told), "{}", refused.stderr);
    assert!(refused.stderr.contains("overwrite the shard with --force"), "{}", refused.stderr);
    assert_eq!(shard(&[&other[..], &["--force"]].concat(), "1/1", folder.path()).code, 0);
    assert_eq!(shard(&other, "1/1", folder.path()).code, 0);

    let mut bytes = fs::read(&path).unwrap();
    bytes[1000] ^= 1;
    fs::write(&path, bytes).unwrap();
    for refused in [shard(&other, "1/1", folder.path()), merge(folder.path(), &[])] {
        assert_eq!(refused.code, 2);
        assert!(refused.stderr.contains("is damaged, or no shard"), "{}", refused.stderr);
        assert!(refused.stderr.contains("--shard K/N --force"), "{}", refused.stderr);
    }
}

/// The arguments of a sweep of so many points, some hundredths of a second for each: 24 contacts.
fn slow_sweep(folder: &Path, points: u64) -> Vec<String> {
    let path = folder.join("boom.toml");
    fs::write(&path, slideway(&["models", "telescopic-boom", "--stages", "6"]).stdout).unwrap();
    let axis = format!("friction=0.5..0.9:{points}");
    ["sweep", text(&path), "--vary", &axis, "--no-breakpoints"].map(str::to_owned).to_vec()
}

/// A time limit, a signal to end and one that kills: nothing stands under the name of the shard.
#[test]
fn an_ended_shard_has_no_name() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    let sweep = slow_sweep(folder.path(), 100_001);
    let sweep: Vec<&str> = sweep.iter().map(String::as_str).collect();
    let path = results.join("shard-2-of-2.parquet");
    let partial = results.join("shard-2-of-2.parquet.partial");
    let ended = |code: Option<i32>, expected: Option<i32>| {
        assert_eq!(code, expected);
        assert!(!path.exists() && partial.exists());
    };
    let limited = shard(&[&sweep[..], &["--time-limit", "1s"]].concat(), "2/2", &results);
    assert!(limited.stderr.contains(" of 50001 points; they are kept in"), "{}", limited.stderr);
    assert!(limited.stderr.contains("the same command continues from there"), "{}", limited.stderr);
    ended(Some(limited.code), Some(3));
    let arguments = [&sweep[..], &["--shard", "2/2", "--output", text(&results)]].concat();
    for (signal, code) in [("-INT", Some(130)), ("-KILL", None)] {
        let written = fs::metadata(&partial).unwrap().len();
        let mut child = command(&arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let begun = Instant::now();
        while fs::metadata(&partial).unwrap().len() <= written && begun.elapsed() < Duration::from_mins(1) {
            sleep(Duration::from_millis(2));
        }
        // While one process computes a shard no other one does.
        let second = slideway(&arguments);
        assert!(second.stderr.contains("another sweep is writing"), "{} {}", second.code, second.stderr);
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        ended(child.wait().unwrap().code(), code);
    }
    let missing = merge(&results, &[]);
    assert!(missing.stderr.contains("there are no shards"), "{}", missing.stderr);
}

/// The same command goes on with it, whatever its time limit was.
#[test]
fn an_ended_shard_goes_on_with_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let [ended, whole] = ["ended", "whole"].map(|name| folder.path().join(name));
    let sweep = slow_sweep(folder.path(), 61);
    let sweep: Vec<&str> = sweep.iter().map(String::as_str).collect();
    for limit in ["1ms", "100ms"] {
        let limited = shard(&[&sweep[..], &["--time-limit", limit]].concat(), "2/2", &ended);
        assert!(limited.code == 3 || limit != "1ms", "{} {}", limited.code, limited.stderr);
    }
    for folder in [&ended, &whole] {
        assert_eq!(shard(&sweep, "2/2", folder).code, 0);
        assert_eq!(names(folder), ["shard-2-of-2.parquet"]);
    }
    let [ended, whole] = [ended, whole].map(|folder| fs::read(folder.join("shard-2-of-2.parquet")).unwrap());
    assert!(ended == whole);
}

#[test]
fn what_cannot_be_merged_is_told() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    fs::create_dir(&results).unwrap();
    let empty = merge(&results, &["--output", "table.csv"]);
    assert_eq!(empty.code, 2);
    assert!(empty.stderr.contains("there are no shards of a sweep in"), "{}", empty.stderr);

    // More shards than points: some are empty.
    let sweep = [&DRAWER[..], &["--vary", "mu=0.1,0.2,0.7"]].concat();
    for number in [1, 3, 7] {
        assert_eq!(shard(&sweep, &format!("{number}/7"), &results).code, 0);
    }
    let missing = merge(&results, &[]);
    assert_eq!(missing.code, 2);
    assert!(missing.stderr.contains("are missing: 2,4-6"), "{}", missing.stderr);
    let other = [&DRAWER[..], &["--set", "Q=5 N", "--vary", "mu=0.1,0.2,0.7"]].concat();
    for number in [2, 4, 5, 6] {
        assert_eq!(shard(&other, &format!("{number}/7"), &results).code, 0);
    }
    let foreign = merge(&results, &[]);
    assert_eq!(foreign.code, 2);
    let told = "shard-2-of-7.parquet` belong to different sweeps (other settings of the model)";
    assert!(foreign.stderr.contains(told), "{}", foreign.stderr);
    for number in [2, 4, 5, 6] {
        fs::remove_file(results.join(format!("shard-{number}-of-7.parquet"))).unwrap();
        assert_eq!(shard(&sweep, &format!("{number}/7"), &results).code, 0);
    }
    assert_eq!(merge(&results, &[]).stdout, slideway(&sweep).stdout);

    let over = text(&results.join("shard-1-of-7.parquet")).to_owned();
    let refused = merge(&results, &["--force", "--output", &over]);
    assert!(refused.code == 2 && refused.stderr.contains("would overwrite its input"), "{}", refused.stderr);
}

/// The own value of what is varied is not allowed beside a greater kinetic coefficient, in one run and in shards.
#[test]
fn what_is_varied_has_no_value_of_its_own_in_shards() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    let sweep = [
        "sweep",
        "models/frictional-oscillator.toml",
        "--set",
        "mu=0.275",
        "--vary",
        "mu_static=0.3..0.4:11",
    ];
    for number in ["1/2", "2/2", "2/2"] {
        assert_eq!(shard(&sweep, number, &results).code, 0);
    }
    let [merged, whole] = [merge(&results, &[]), slideway(&sweep)];
    assert_eq!((merged.code, merged.stdout), (whole.code, whole.stdout));
}

#[test]
fn a_plot_of_merged_shards_is_that_of_one_run() {
    let folder = TempDir::new().unwrap();
    let [bare, results] = ["bare", "results"].map(|name| folder.path().join(name));
    let sweep = [&KLEPP[..], &["--vary", "mu_1=0..0.8:301"]].concat();
    for number in ["1/2", "2/2"] {
        assert_eq!(shard(&sweep, number, &bare).code, 0);
        assert_eq!(shard(&[&sweep[..], &["--attainability"]].concat(), number, &results).code, 0);
    }
    let [merged, whole, table] =
        ["merged.svg", "whole.svg", "table.csv"].map(|name| folder.path().join(name));
    let output = ["--force", "--output", text(&table), "--plot"];
    let refused = merge(&bare, &[&output[..], &[text(&merged)]].concat());
    assert!(refused.code == 2 && refused.stderr.contains("--attainability"), "{}", refused.stderr);
    assert_eq!(merge(&results, &[&output[..], &[text(&merged)]].concat()).code, 0);
    assert_eq!(slideway(&[&sweep[..], &output, &[text(&whole)]].concat()).code, 0);
    assert_eq!(fs::read_to_string(merged).unwrap(), fs::read_to_string(whole).unwrap());
}

#[test]
fn bad_arguments_are_told() {
    let sweep = [&DRAWER[..], &["--vary", "mu=0..1:3"]].concat();
    let cases: [(&[&str], &str); 8] = [
        (&["--shard", "0/4", "--output", "results"], "there is no shard 0 of 4"),
        (&["--shard", "5/4", "--output", "results"], "there is no shard 5 of 4"),
        (&["--shard", "half", "--output", "results"], "expected its number and how many there are"),
        (&["--shard", "1/4"], "--output"),
        (&["--shard", "1/4", "--output", "-"], "only be written into a folder"),
        (&["--shard", "1/4", "--output", "results", "--plot", "plot.svg"], "cannot be used with '--plot"),
        (&["--shard", "1/4", "--output", "results", "--format", "csv"], "cannot be used with '--format"),
        (&["--shard", "1/4", "--output", "models/drawer.toml"], "not a directory"),
    ];
    for (arguments, part) in cases {
        let run = slideway(&[&sweep, arguments].concat());
        assert!(run.code == 2 && run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    }
    let run = slideway(&[&sweep[..], &["--merge", "results"]].concat());
    assert!(run.code == 2 && run.stderr.contains("cannot be used with '--merge"), "{}", run.stderr);
    let run = merge(Path::new("nowhere"), &[]);
    assert!(run.code == 2 && run.stderr.contains("`nowhere` cannot be read"), "{}", run.stderr);
}

/// A script of the book for fewer points and 6 shards, in a folder with its model.
fn script(folder: &Path, name: &str) -> String {
    let examples = command::top().join("docs/src/examples");
    let script = fs::read_to_string(examples.join(name)).unwrap();
    fs::copy(command::top().join("models/drawer.toml"), folder.join("drawer.toml")).unwrap();
    let smaller = [("8001", "41"), ("401", "31"), ("64", "6")];
    smaller.iter().fold(script, |script, (from, to)| {
        assert!(script.contains(from), "{script}");
        script.replace(from, to)
    })
}

/// A program in a folder, with `slideway` where it looks for programs.
fn run(program: &str, arguments: &[&str], folder: &Path) -> std::io::Result<std::process::Output> {
    let binaries = Path::new(env!("CARGO_BIN_EXE_slideway")).parent().unwrap();
    let path = format!("{}:{}", text(binaries), std::env::var("PATH").unwrap());
    let mut command = Command::new(program);
    command.args(arguments).env("PATH", path).env("SLURM_CPUS_PER_TASK", "1").current_dir(folder).output()
}

/// The table of the whole sweep that those scripts compute.
fn whole_table(folder: &Path) -> Vec<u8> {
    let words = "sweep drawer.toml --vary mu=0..0.8:41 --vary a=0..0.4:31 --output drawer.parquet";
    let words: Vec<&str> = words.split(' ').collect();
    assert!(command(&words).current_dir(folder).output().unwrap().status.success());
    fs::read(folder.join("drawer.parquet")).unwrap()
}

/// The tasks of a job array, each in a shell that knows its number, some of them twice.
#[test]
fn the_job_array_of_the_book_computes_all_shards() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("sweep.slurm"), script(folder.path(), "sweep.slurm")).unwrap();
    for task in [4, 2, 6, 2, 1, 5, 3, 4] {
        let job = format!("SLURM_ARRAY_TASK_ID={task} sh sweep.slurm");
        let output = run("sh", &["-c", &job], folder.path()).unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let output =
        run("slideway", &["sweep", "--merge", "results", "--output", "drawer.parquet"], folder.path());
    assert!(output.unwrap().status.success());
    let merged = fs::read(folder.path().join("drawer.parquet")).unwrap();
    fs::remove_file(folder.path().join("drawer.parquet")).unwrap();
    assert!(merged == whole_table(folder.path()));
}

/// A shard that is lost is computed again, and all are if the model has changed.
#[test]
#[allow(clippy::print_stderr, reason = "a test that is skipped is told")]
fn the_makefile_of_the_book_computes_what_is_missing() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("sweep.mk"), script(folder.path(), "sweep.mk")).unwrap();
    let make = || run("make", &["-j", "2", "-f", "sweep.mk"], folder.path());
    let Ok(output) = make() else {
        eprintln!("SKIPPED: make is not installed on this machine");
        return;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = folder.path().join("drawer.parquet");
    let first = fs::read(&table).unwrap();
    fs::remove_file(folder.path().join("results/shard-3-of-6.parquet")).unwrap();
    let output = make().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && told.matches("--shard ").count() == 1, "{told}");
    assert!(fs::read(&table).unwrap() == first);

    let model = folder.path().join("drawer.toml");
    let changed = fs::read_to_string(&model).unwrap().replace("20 N", "21 N");
    fs::write(&model, changed).unwrap();
    let output = make().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let merged = fs::read(&table).unwrap();
    fs::remove_file(&table).unwrap();
    assert!(merged != first && merged == whole_table(folder.path()));
}
