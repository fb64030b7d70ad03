//! Tables of sweeps: what is in them, and what becomes of them when something goes wrong.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway};
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const KLEPP: [&str; 4] = ["sweep", "models/klepp-2002.toml", "--set", "F_20=0"];
/// The endings of tables.
const ENDINGS: &[&str] = if cfg!(feature = "parquet") { &["csv", "npz", "parquet"] } else { &["csv", "npz"] };
const DRAWER: &str = "models/drawer.toml";

fn path(folder: &tempfile::TempDir, name: &str) -> (PathBuf, String) {
    let path = folder.path().join(name);
    let text = path.to_str().unwrap().to_owned();
    (path, text)
}

fn sweep(arguments: &[&str]) -> command::Run {
    slideway(&[&KLEPP, arguments].concat())
}

/// The lines of a table without comments.
fn lines(table: &str) -> Vec<&str> {
    table.lines().filter(|line| !line.starts_with('#')).collect()
}

/// In sizes of the mechanism the way to them is longer than any number.
#[test]
fn places_beyond_all_numbers_are_no_positions_at_once() {
    let run =
        slideway(&["sweep", "models/wedge.toml", "--vary", "x=-1.7e308 m..3 m:7", "--time-limit", "10s"]);
    assert!(run.stderr.contains("6   85.714 %  no position"), "{}", run.stderr);
}

/// Four hinges at rest are four faults, told on one line.
#[test]
fn several_faults_of_a_point_are_told_on_one_line() {
    let run = slideway(&["sweep", "models/four-bar.toml", "--rate", "phi=0", "--vary", "mu_pin=0.1..0.3:3"]);
    // Lines are wrapped; each of both statements has four faults.
    let told: Vec<&str> = run.stderr.lines().map(str::trim).collect();
    let told = told.join(" ");
    // The faults of the only reason stand behind.
    let told = told.split("error: ").next().unwrap();
    for line in
        ["No exact ends of states were inserted: O does not turn", "Point 0, and 2 more: O does not turn"]
    {
        assert!(told.contains(line), "{told}");
    }
    assert_eq!(told.matches("; ").count(), 6, "{told}");
    assert!(!run.stderr.contains(r"\n"), "{}", run.stderr);
}

#[test]
fn a_table_tells_of_itself() {
    let folder = tempfile::tempdir().unwrap();
    let (path, name) = path(&folder, "klepp.csv");
    let run = sweep(&["--vary", "mu_1=0..0.8:801", "--output", &name]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!("summary", run.stdout);
    });
    let table = fs::read_to_string(&path).unwrap();
    assert!(table.contains("# slideway sweep models/klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8:801"));
    for line in fs::read_to_string(command::top().join("models/klepp-2002.toml")).unwrap().lines() {
        assert!(line.is_empty() || table.contains(&format!("#   {line}\n")), "{line}");
    }
    let lines = lines(&table);
    let names: Vec<&str> = lines[0].split(',').collect();
    assert_eq!(&names[..3], ["point", "mu_1", "breakpoint"]);
    assert!(lines[1..].iter().all(|line| line.split(',').count() == names.len()));
    let points: Vec<f64> =
        lines[1..].iter().map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(
        points.is_sorted() && points.iter().any(|mu| (mu - 0.453).abs() < 1e-12) && points.contains(&0.8)
    );
    assert!(!folder.path().join("klepp.csv.partial").exists());
}

/// The archive by a reader that checks sizes and checksums; its numbers are those of the CSV table.
#[test]
fn both_forms_hold_the_same_rows() {
    let folder = tempfile::tempdir().unwrap();
    let (csv, csv_name) = path(&folder, "klepp.csv");
    let (npz, npz_name) = path(&folder, "klepp.npz");
    for name in [&csv_name, &npz_name] {
        assert_eq!(sweep(&["--vary", "mu_1=0..0.8:81", "--output", name]).code, 0);
    }
    let mut archive = zip::ZipArchive::new(fs::File::open(&npz).unwrap()).unwrap();
    let mut rows = Vec::new();
    archive.by_name("rows.npy").unwrap().read_to_end(&mut rows).unwrap();
    for name in ["names.npy", "units.npy", "model.npy", "command.npy", "program.npy"] {
        let mut content = Vec::new();
        archive.by_name(name).unwrap().read_to_end(&mut content).unwrap();
        assert!(content.starts_with(b"\x93NUMPY"), "{name}");
    }
    let length = u32::from_le_bytes(rows[8..12].try_into().unwrap()) as usize;
    let header = String::from_utf8(rows[12..12 + length].to_vec()).unwrap();
    let table = fs::read_to_string(&csv).unwrap();
    let lines = lines(&table);
    assert!(header.contains(&format!("'shape': ({},)", lines.len() - 1)), "{header}");
    let records = &rows[12 + length..];
    let size = records.len() / (lines.len() - 1);
    assert_eq!(size * (lines.len() - 1), records.len());
    for (record, line) in records.chunks_exact(size).zip(&lines[1..]) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(u64::from_le_bytes(record[..8].try_into().unwrap()).to_string(), fields[0]);
        let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().unwrap());
        assert_eq!(number(&record[8..16]), fields[1].parse::<f64>().unwrap());
        let last = number(&record[size - 8..]);
        match fields.last().unwrap().parse::<f64>() {
            Ok(value) => assert_eq!(last, value),
            Err(_) => assert!(last.is_nan()),
        }
    }
}

/// Says so where NumPy is not installed.
#[allow(clippy::print_stderr, reason = "a test that is skipped is told")]
fn without_numpy(output: &Output) -> bool {
    let without = String::from_utf8_lossy(&output.stderr).contains("No module named 'numpy'");
    if without {
        eprintln!("SKIPPED: NumPy is not installed on this machine");
    }
    without
}

/// NumPy, where it is installed.
#[test]
fn numpy_reads_the_archive() {
    let folder = tempfile::tempdir().unwrap();
    let (_, name) = path(&folder, "klepp.npz");
    assert_eq!(sweep(&["--vary", "mu_1=0..0.8:81", "--output", &name]).code, 0);
    let script = "import sys, numpy; z = numpy.load(sys.argv[1]); r = z['rows']; \
        print(len(numpy.unique(r['point'])), r['pattern'][0].decode(), str(z['command'])[:14], \
        '[bodies.bar]' in str(z['model']))";
    let output = Command::new("python3").args(["-c", script, &name]).output();
    let Some(output) = output.ok().filter(|output| !without_numpy(output)) else { return };
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(text.ends_with("slideway sweep True\n"), "{text}{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn endings_may_be_capital_letters() {
    let folder = tempfile::tempdir().unwrap();
    let (path, name) = path(&folder, "KLEPP.NPZ");
    let run = sweep(&["--vary", "mu_1=0..0.8:11", "--output", &name]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(fs::read(path).unwrap().starts_with(b"PK"), "an archive");
}

/// A run that is interrupted while it works, and goes on.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on_with_the_same_bytes() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let (whole, whole_name) = path(&folder, &format!("whole.{ending}"));
        let (target, name) = path(&folder, &format!("table.{ending}"));
        let partial = folder.path().join(format!("table.{ending}.partial"));
        // Geometry takes much longer than friction alone, so that there is something to interrupt.
        let vary = "alpha=1.1..1.4:30001";
        let arguments = |name: &str| [&KLEPP[..], &["--vary", vary, "--output", name]].concat().join(" ");
        let start = |name: &str, more: &[&str]| {
            let mut all: Vec<String> = arguments(name).split(' ').map(str::to_owned).collect();
            all.extend(more.iter().map(|word| (*word).to_owned()));
            let words: Vec<&str> = all.iter().map(String::as_str).collect();
            command(&words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        };
        assert!(start(&whole_name, &[]).wait().unwrap().success());
        let mut child = start(&name, &[]);
        let begun = Instant::now();
        while fs::metadata(&partial).map_or(0, |file| file.len()) < 200_000
            && begun.elapsed() < Duration::from_mins(1)
        {
            sleep(Duration::from_millis(2));
        }
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let code = child.wait().unwrap().code();
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(code, Some(130), "{said}");
        assert!(said.contains("--resume continues"), "{said}");
        assert!(partial.exists() && !target.exists());

        // Another command, and the same one without --resume, are refused.
        let other = sweep(&["--vary", "alpha=1.1..1.3:30001", "--output", &name, "--resume"]);
        assert_eq!(other.code, 2);
        assert!(other.stderr.contains("belongs to another sweep"), "{}", other.stderr);
        let again = sweep(&["--vary", vary, "--output", &name]);
        assert!(again.code == 2 && again.stderr.contains("unfinished sweep"), "{}", again.stderr);

        assert!(start(&name, &["--resume"]).wait().unwrap().success());
        let same = |one: &Path, other: &Path| fs::read(one).unwrap() == fs::read(other).unwrap();
        if *ending == "csv" {
            // The commands differ in the name of the file.
            let [one, other] = [&whole, &target].map(|path| fs::read_to_string(path).unwrap());
            assert!(lines(&one) == lines(&other));
        }
        let mut renamed = folder.path().join("again");
        fs::create_dir(&renamed).unwrap();
        renamed.push(format!("first.{ending}"));
        fs::rename(&target, &renamed).unwrap();
        assert!(start(&name, &[]).wait().unwrap().success());
        assert!(same(&renamed, &target), "{ending}");
        assert!(!partial.exists());
    }
}

#[test]
fn what_exists_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let (path, name) = path(&folder, "drawer.csv");
    fs::write(&path, "mine").unwrap();
    let arguments = ["sweep", DRAWER, "--vary", "mu=0.1,0.2", "--output", &name];
    let run = slideway(&arguments);
    assert!(run.code == 2 && run.stderr.contains("already exists"), "{}", run.stderr);
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(slideway(&[&arguments[..], &["--force"]].concat()).code, 0);
    assert!(fs::read_to_string(&path).unwrap().contains("normal_force.guide.front"));
    let nothing = slideway(&[&arguments[..], &["--force", "--resume"]].concat());
    assert!(nothing.code == 2 && nothing.stderr.contains("no sweep to resume"), "{}", nothing.stderr);
}

/// A sweep that has written so many bytes, and takes long enough to be stopped.
#[cfg(unix)]
fn underway(
    folder: &tempfile::TempDir,
    (name, bytes): (&str, u64),
    arguments: &[&str],
) -> std::process::Child {
    let child = command(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let partial = folder.path().join(format!("{name}.partial"));
    let begun = Instant::now();
    while fs::metadata(&partial).map_or(0, |file| file.len()) < bytes
        && begun.elapsed() < Duration::from_mins(1)
    {
        sleep(Duration::from_millis(2));
    }
    child
}

#[cfg(unix)]
fn signal(child: &std::process::Child, signal: &str) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

/// A second writer is refused while the first one works, with and without --force; the first one's table is
/// whole.
#[cfg(unix)]
#[test]
fn two_writers_of_one_table_do_not_meet() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let table = format!("table.{ending}");
        let (target, name) = path(&folder, &table);
        // The same table by another name.
        let (link, link_name) = path(&folder, &format!("link.{ending}"));
        std::os::unix::fs::symlink(&table, &link).unwrap();
        let arguments =
            |name| ["sweep", DRAWER, "--vary", "h=0..0.1:3001", "--no-breakpoints", "--output", name];
        let mut first = underway(&folder, (&table, 1), &arguments(&name));
        signal(&first, "-STOP");
        for (name, more) in
            [(&name, "--force"), (&name, "--resume"), (&link_name, "--force"), (&name, "--attainability")]
        {
            let second = slideway(&[&arguments(name)[..], &[more]].concat());
            assert_eq!(second.code, 2, "{ending} {more}");
            assert!(second.stderr.contains("another sweep is writing"), "{more}: {}", second.stderr);
        }
        signal(&first, "-CONT");
        assert!(first.wait().unwrap().success());
        let whole = fs::read(&target).unwrap();
        assert_eq!(names(&folder), [format!("link.{ending}"), table]);
        assert_eq!(slideway(&[&arguments(&name)[..], &["--force"]].concat()).code, 0);
        assert!(fs::read(&target).unwrap() == whole, "{ending}");
    }
}

#[cfg(unix)]
type Alteration = fn(&mut Vec<u8>);

/// Bytes that were altered in the rows or in the state are noticed, and nothing gets the final name.
#[cfg(unix)]
#[test]
fn an_unfinished_table_that_was_changed_is_not_continued() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let table = format!("table.{ending}");
        let (target, name) = path(&folder, &table);
        let arguments = ["sweep", DRAWER, "--vary", "h=0..0.1:100001", "--no-breakpoints", "--output", &name];
        let mut first = underway(&folder, (&table, 50_000), &arguments);
        signal(&first, "-INT");
        assert_eq!(first.wait().unwrap().code(), Some(130));
        let rows = folder.path().join(format!("{table}.partial"));
        let state = folder.path().join(format!("{table}.partial.state"));
        let alterations: [(&Path, Alteration); 4] = [
            (&rows, |bytes| *bytes.last_mut().unwrap() ^= 1),
            (&rows, |bytes| bytes.truncate(bytes.len() - 1)),
            (&state, |bytes| *bytes.iter_mut().rfind(|byte| byte.is_ascii_digit()).unwrap() ^= 1),
            (&state, |bytes| bytes.truncate(20)),
        ];
        for (file, alter) in alterations {
            let good = fs::read(file).unwrap();
            let mut bad = good.clone();
            alter(&mut bad);
            fs::write(file, &bad).unwrap();
            let run = slideway(&[&arguments[..], &["--resume"]].concat());
            assert!(run.code == 2 && run.stderr.contains("was changed"), "{ending}: {}", run.stderr);
            assert!(!target.exists());
            fs::write(file, &good).unwrap();
        }
    }
}

/// A file whose name has an end of line does not break the comments of a table.
#[cfg(unix)]
#[test]
fn a_name_with_an_end_of_line_stays_within_its_comment() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(command::top().join(DRAWER), folder.path().join("a\n1,2,3.toml")).unwrap();
    let words = ["sweep", "a\n1,2,3.toml", "--vary", "mu=0.1,0.2", "--output", "table.csv"];
    assert!(command(&words).current_dir(folder.path()).status().unwrap().success());
    let table = fs::read_to_string(folder.path().join("table.csv")).unwrap();
    assert!(
        table.contains(r"# slideway sweep $'a\n1,2,3.toml' --vary mu=0.1,0.2 --output table.csv"),
        "{table}"
    );
    assert_eq!(lines(&table).len(), 3, "{table}");
}

/// A run in a shell that lets no file grow beyond so many bytes: the system refuses to write more, as on a
/// full disk.
#[cfg(unix)]
fn limited(bytes: u64, arguments: &[&str]) -> Output {
    // POSIX: the unit of the limit is 512 bytes; without the trap the signal would end the program.
    let script = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", bytes / 512);
    let mut shell = Command::new("sh");
    shell.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_slideway")]).args(arguments);
    shell.current_dir(command::top()).output().unwrap()
}

#[cfg(unix)]
fn names(folder: &tempfile::TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The file fails at its last byte, long before the first two seconds are over: CSV tables while rows are
/// written, NumPy archives and Parquet files while they are completed. The model and the command are most of
/// so small a table, so that records alone fit.
#[cfg(unix)]
#[test]
fn a_table_that_does_not_fit_is_kept_and_goes_on() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let (target, name) = path(&folder, &format!("table.{ending}"));
        let arguments = [&KLEPP[..], &["--vary", "mu_1=0..0.8:21", "--output", &name]].concat();
        assert_eq!(slideway(&arguments).code, 0);
        let whole = fs::read(&target).unwrap();
        fs::remove_file(&target).unwrap();

        let run = limited(whole.len() as u64 - 1, &arguments);
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{ending}: {said}");
        assert!(said.contains(".partial` cannot be written: file too large"), "{ending}: {said}");
        assert!(said.contains("repeat the command with --resume"), "{ending}: {said}");
        assert_eq!(
            names(&folder),
            [format!("table.{ending}.partial"), format!("table.{ending}.partial.state")]
        );

        let resumed = slideway(&[&arguments[..], &["--resume"]].concat());
        assert_eq!(resumed.code, 0, "{ending}: {}", resumed.stderr);
        assert!(fs::read(&target).unwrap() == whole, "{ending}");
        assert_eq!(names(&folder), [format!("table.{ending}")]);
    }
}

/// Without room for the first state there is nothing to go on with, and nothing stays.
#[cfg(unix)]
#[test]
fn a_table_that_cannot_begin_leaves_nothing() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let (_, name) = path(&folder, &format!("table.{ending}"));
        let run = limited(512, &[&KLEPP[..], &["--vary", "mu_1=0..0.8:301", "--output", &name]].concat());
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{ending}: {said}");
        assert!(said.contains("cannot be written: file too large") && !said.contains("--resume"), "{said}");
        assert_eq!(names(&folder), [""; 0], "{ending}");
    }
}

/// A table that exists stays as it is until the new one is whole.
#[cfg(unix)]
#[test]
fn a_full_disk_spares_the_table_that_would_be_overwritten() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let (target, name) = path(&folder, &format!("table.{ending}"));
        fs::write(&target, "mine").unwrap();
        let arguments = [&KLEPP[..], &["--vary", "mu_1=0..0.8:3001", "--force", "--output", &name]].concat();
        assert_eq!(limited(60_000, &arguments).status.code(), Some(2), "{ending}");
        assert_eq!(fs::read_to_string(&target).unwrap(), "mine");
    }
}

/// Without the feature it is told how to get it.
#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_files_need_their_feature() {
    let folder = tempfile::tempdir().unwrap();
    let (_, name) = path(&folder, "table.parquet");
    let simulate = ["simulate", "models/stick-slip.toml", "--until", "1s", "--output", &name];
    let sweep = [&KLEPP[..], &["--vary", "mu_1=0..0.8:3", "--output", &name]].concat();
    for arguments in [&simulate[..], &sweep] {
        let run = slideway(arguments);
        assert_eq!(run.code, 2);
        assert!(run.stderr.contains("built without support for Parquet"), "{}", run.stderr);
        assert!(run.stderr.contains("cargo build --release --features parquet"), "{}", run.stderr);
    }
    for more in [&["--shard", "1/2", "--output", &name], &["--merge", &name][..]] {
        let run = if more[0] == "--merge" {
            slideway(&[&["sweep"], more].concat())
        } else {
            slideway(&[&KLEPP[..], &["--vary", "mu_1=0..0.8:3"], more].concat())
        };
        assert_eq!(run.code, 2);
        assert!(run.stderr.contains("Parquet files, which shards are"), "{}", run.stderr);
    }
    assert_eq!(names(&folder), [""; 0]);
}

#[test]
fn standard_output_gets_a_table() {
    let run = slideway(&["sweep", DRAWER, "--vary", "mu=0.1,0.2,0.7"]);
    assert_eq!(run.code, 0);
    let lines = lines(&run.stdout);
    assert_eq!(lines.len(), 4);
    assert!(lines[3].starts_with("2,0.7,,none,0,0,0,,,,"), "{}", lines[3]);
    assert!(run.stderr.contains("3 points"), "{}", run.stderr);
}

/// The elements of a class, from the name of the element to its `>`.
fn of_class<'s>(svg: &'s str, class: &str) -> Vec<&'s str> {
    let wanted = format!("class=\"{class}\"");
    svg.split('<').filter(|element| element.contains(&wanted)).collect()
}

fn attribute(element: &str, name: &str) -> f64 {
    let start = element.find(&format!(" {name}=\"")).unwrap() + name.len() + 3;
    element[start..].split('"').next().unwrap().parse().unwrap()
}

/// Klepp (2002), section 7: one solution up to the locking value mu_1 = 0.45265396 (theory, section 9), two
/// beyond it, of which the second is not attainable (theory, section 7) and thus dashed.
#[test]
fn a_plot_shows_branches_and_locking_values() {
    let folder = tempfile::tempdir().unwrap();
    let ((path, plot), (_, table)) = (path(&folder, "klepp.svg"), path(&folder, "klepp.csv"));
    let run = sweep(&["--vary", "mu_1=0..0.8:801", "--output", &table, "--plot", &plot]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let svg = fs::read_to_string(&path).unwrap();
    let frame = of_class(&svg, "frame")[0];
    let asymptotes = of_class(&svg, "asymptote");
    assert_eq!(asymptotes.len(), 1);
    let place = attribute(frame, "x") + attribute(frame, "width") * 0.452_653_96 / 0.8;
    assert!((attribute(asymptotes[0], "x1") - place).abs() < 0.01, "{} {place}", asymptotes[0]);
    let curves = of_class(&svg, "curve");
    // Three contacts on each of two branches.
    assert_eq!(curves.len(), 6);
    assert_eq!(curves.iter().filter(|curve| curve.contains("stroke-dasharray")).count(), 3);
    assert!(svg.contains("branch 2:") && svg.contains("(unstable)"));
    assert!(of_class(&svg, "zone").is_empty());
}

/// Samples have histograms, one for each contact; the text of the picture has the numbers of the summary.
#[test]
fn samples_are_plotted_as_histograms() {
    let (folder, samples) = (tempfile::tempdir().unwrap(), ["--samples", "400", "--vary", "mu=0.5..0.8"]);
    let ((path, plot), (_, table)) = (path(&folder, "samples.svg"), path(&folder, "samples.csv"));
    let arguments = [&["sweep", DRAWER, "--output", &table, "--plot", &plot][..], &samples].concat();
    let run = slideway(&arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let svg = std::fs::read_to_string(path).unwrap();
    assert_eq!(svg.matches("class=\"frame\"").count(), 2);
    assert!(svg.matches("class=\"bar\"").count() > 20);
    assert!(svg.contains("400 samples; no solution in "), "{svg}");
    assert!(svg.contains("normal force of guide.rear in N"));
}

/// The drawer jams from mu = L / (2 a) = 2/3 on (book, chapter Limits): there the plot is hatched, up to its
/// edge.
#[test]
fn a_plot_hatches_where_it_jams() {
    let folder = tempfile::tempdir().unwrap();
    let (path, plot) = path(&folder, "drawer.svg");
    let run = slideway(&["sweep", DRAWER, "--vary", "mu=0..1:12", "--plot", &plot]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let svg = fs::read_to_string(&path).unwrap();
    let (frame, zones) = (of_class(&svg, "frame")[0], of_class(&svg, "zone"));
    let [left, width] = ["x", "width"].map(|name| attribute(frame, name));
    let edges = |zone: &str| [attribute(zone, "x"), attribute(zone, "x") + attribute(zone, "width")];
    assert!(!zones.is_empty());
    for zone in zones {
        let [from, to] = edges(zone).map(|edge| (edge - left) / width);
        assert!((from - 2.0 / 3.0).abs() < 1e-4 && (to - 1.0).abs() < 1e-4, "{from} {to}");
    }
}

#[test]
fn bad_arguments_are_told() {
    let cases: [(&[&str], &str); 9] = [
        (&["--vary", "mu=0..0.8"], "how many values"),
        (&["--vary", "mu=0..abc:3"], "unknown name `abc`"),
        (&["--vary", "mu=0..1:3", "--vary", "mu=0,1"], "varied twice"),
        (&["--vary", "mu=0..1:3", "--output", "table.xlsx"], "does not determine the form"),
        (&["--vary", "mu=0..1:3", "--format", "npz"], "only be written to a file"),
        (&["--vary", "mu=normal(0.3, 0.1)"], "no samples"),
        (&["--vary", "mu=0.5..0.5:11"], "empty"),
        (&["--vary", "mu=0..1:3", "--vary", "a=0,0.1", "--plot", "plot.svg"], "one varied quantity"),
        (&["--vary", "mu=0..1:3", "--plot", "plot.gif"], "is not a known format"),
    ];
    for (arguments, part) in cases {
        let run = slideway(&[&["sweep", DRAWER], arguments].concat());
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    }
    // The same text was a panic of `limits`.
    let run = slideway(&["limits", DRAWER, "--vary", "mu=0..abc"]);
    assert!(run.code == 2 && run.stderr.contains("unknown name `abc`"), "{}", run.stderr);
}

/// A table without a single answer is no success: the reason is that of the model, with advice.
#[test]
fn a_sweep_that_is_refused_everywhere_says_why() {
    let run = slideway(&["sweep", "models/bracket-on-pole.toml", "--vary", "x=0.1..0.4:5"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert_eq!(lines(&run.stdout).len(), 1 + 5, "{}", run.stdout);
    for told in ["None of 5 points could be solved.", "the moving parts have no mass", "`slideway hold`"] {
        assert!(run.stderr.contains(told), "{told}: {}", run.stderr);
    }
}
