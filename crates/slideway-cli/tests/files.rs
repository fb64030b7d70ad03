//! Files of commands: nothing that is read, or written by another output, is written over, whatever its name; no link
//! is followed where unfinished files are kept; what cannot be written is told. `reference/campaigns/files.py` tries
//! more of each kind.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod command;

use command::{Run, command, slideway, top};
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::Path;

const SWEEP: &str = "sweep m.toml --vary mu=0..1:5";
const PROBLEM: &str = r#"{"type": "mcp", "M": [[2]], "q": [-1], "l": [-3], "u": [3]}"#;

/// A folder with the model of a drawer, a problem that the checker of proofs does not read, and another file.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(top().join("models/drawer.toml"), folder.path().join("m.toml")).unwrap();
    fs::write(folder.path().join("b.json"), PROBLEM).unwrap();
    fs::write(folder.path().join("other"), "of someone else\n").unwrap();
    folder
}

/// Names and contents of all that is in a folder.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut all: Vec<(String, Vec<u8>)> = entries
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap_or_default()))
        .collect();
    all.sort();
    all
}

fn run(folder: &Path, words: &str) -> Run {
    let words: Vec<&str> = words.split(' ').collect();
    Run::of(command(&words).current_dir(folder).output().unwrap())
}

/// Whatever is written, and however its path is spelt: not over what is read, nor where an unfinished table
/// would be over it.
#[test]
fn no_command_writes_over_its_input() {
    let folder = tempfile::tempdir().unwrap();
    let model = fs::read_to_string(top().join("models/drawer.toml")).unwrap();
    let problem = r#"{"M": [[1]], "q": [-1]}"#;
    for (words, content) in [
        ("check in.toml -o ./in.toml", &*model),
        ("solve in.toml -o ./in.toml", &model),
        ("hold in.toml -o ./in.toml", &model),
        ("drive in.toml -o ./in.toml", &model),
        ("size in.toml --vary mu --margin 1.5 -o ./in.toml", &model),
        ("limits in.toml --vary mu=0..1 -o ./in.toml", &model),
        ("limits in.svg --vary mu=0..1 --plot ./in.svg", &model),
        ("map in.svg --x mu=0..1 --y a=0..1m -o ./in.svg", &model),
        ("map in.json --x mu=0..1 --y a=0..1m -o ./in.json", &model),
        ("draw in.svg -o ./in.svg", &model),
        ("draw in.png -o ./in.png", &model),
        ("report in.html -o ./in.html", &model),
        ("simulate in.csv --until 1s -o ./in.csv", &model),
        ("simulate in.svg --until 1s --plot ./in.svg", &model),
        ("simulate in.gif --until 1s --animate ./in.gif", &model),
        ("simulate in.csv.partial --until 1s -o ./in.csv", &model),
        ("sweep in.csv --vary mu=0..1:3 -o ./in.csv", &model),
        ("sweep in.svg --vary mu=0..1:3 -o table.csv --plot ./in.svg", &model),
        ("sweep in.csv.partial --vary mu=0..1:3 -o ./in.csv", &model),
        ("sweep in.csv.partial.state --vary mu=0..1:3 -o ./in.csv", &model),
        ("modes in.json -o ./in.json", problem),
        ("modes in.npz -o ./in.npz", problem),
    ] {
        let words: Vec<&str> = words.split(' ').chain(["--force"]).collect();
        let file = folder.path().join(words[1]);
        fs::write(&file, content).unwrap();
        let output = command(&words).current_dir(folder.path()).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains("would overwrite its input"), "{words:?}: {said}");
        assert_eq!(fs::read_to_string(&file).unwrap(), content, "{words:?}");
    }
}

/// What a ladder that sticks at both ends carries is a range, of which there is no mode problem: the answer says so, and nothing is
/// written. A box at rest has one.
#[test]
fn contacts_at_rest_have_a_proof_file_where_their_forces_are_determined() {
    let folder = folder();
    fs::copy(top().join("models/ladder.toml"), folder.path().join("ladder.toml")).unwrap();
    let before = contents(folder.path());
    let refused = run(folder.path(), "solve ladder.toml --proof p");
    assert_eq!(refused.code, 3, "{}", refused.stderr);
    let words = refused.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("for contacts at rest (foot, head) there is one only if"), "{words}");
    assert_eq!(contents(folder.path()), before);
    let text = fs::read_to_string(top().join("models/box-on-incline.toml")).unwrap();
    let rests = text.replace("rate = \"-1 m/s\"", "rate = 0");
    assert_ne!(text, rests);
    fs::write(folder.path().join("box.toml"), rests).unwrap();
    let proven = run(folder.path(), "solve box.toml --proof p");
    assert_eq!(proven.code, 0, "{}", proven.stderr);
    let checker = top().join("reference/check_proof.py");
    let checked = std::process::Command::new("python3")
        .current_dir(folder.path())
        .arg(checker)
        .args(["p.json", "p"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&checked.stdout);
    assert!(checked.status.success() && said.contains("cells of dimension 0: 1"), "{said}");
}

/// A hard link, a link, and `FILE.json` of a proof are the input, and so is a standard stream that is that file.
#[test]
fn an_input_is_known_by_any_of_its_names() {
    for (words, told) in [
        ("solve m.toml --proof hard", "would overwrite its input `m.toml`"),
        ("solve hard --proof m.toml", "would overwrite its input `hard`"),
        ("hold m.toml -o soft", "would overwrite its input `m.toml`"),
        ("solve m.toml.json --proof m.toml", "would overwrite its input `m.toml.json`"),
        ("modes b.json --proof b", "would overwrite its input `b.json`"),
        ("modes b.json --proof x --output x.json", "two outputs would go to `x.json`"),
        ("solve m.toml --proof x --output ./x", "two outputs would go to `x`"),
        ("limits m.toml --vary mu=0..1 --plot a.svg --output b.svg", "two outputs would go to `b.svg`"),
        (
            "sweep m.toml --vary mu=0..1:3 -o t.csv --plot t.csv.partial.svg",
            "two outputs would go to `t.csv`",
        ),
    ] {
        let folder = folder();
        let path = |name: &str| folder.path().join(name);
        fs::hard_link(path("m.toml"), path("hard")).unwrap();
        fs::hard_link(path("m.toml"), path("m.toml.json")).unwrap();
        symlink("m.toml", path("soft")).unwrap();
        fs::write(path("a.svg"), "a plot").unwrap();
        fs::hard_link(path("a.svg"), path("b.svg")).unwrap();
        let before = contents(folder.path());
        let refused = run(folder.path(), &format!("{words} --force"));
        assert!(refused.code == 2 && refused.stderr.contains(told), "{words}: {}", refused.stderr);
        assert_eq!(contents(folder.path()), before, "{words}");
    }
    let folder = folder();
    let model = folder.path().join("m.toml");
    let before = contents(folder.path());
    let appended = File::options().append(true).open(&model).unwrap();
    let source = File::open(&model).unwrap();
    let mut appending = command(&["solve", "m.toml"]);
    appending.stdout(appended);
    let mut reading = command(&["solve", "-", "--output", "m.toml", "--force"]);
    reading.stdin(source);
    for command in [&mut appending, &mut reading] {
        let refused = Run::of(command.current_dir(folder.path()).output().unwrap());
        assert!(
            refused.code == 2 && refused.stderr.contains("would overwrite its input"),
            "{}",
            refused.stderr
        );
        assert_eq!(contents(folder.path()), before);
    }
}

/// Links where an unfinished table, its state, and the next state are kept: the file to which they lead stays what it is,
/// and the table is the same, or refused.
#[test]
fn no_link_is_followed_where_unfinished_tables_are_kept() {
    let clean = folder();
    assert_eq!(run(clean.path(), &format!("{SWEEP} -o t.csv")).code, 0);
    let table = fs::read(clean.path().join("t.csv")).unwrap();
    for ending in ["", ".state", ".state.new"] {
        for is_hard in [false, true] {
            for option in ["", " --force", " --resume"] {
                let folder = folder();
                let path = |name: &str| folder.path().join(name);
                let link = path(&format!("t.csv.partial{ending}"));
                if is_hard { fs::hard_link(path("other"), link) } else { symlink("other", link) }.unwrap();
                let done = run(folder.path(), &format!("{SWEEP} -o t.csv{option}"));
                let what = format!("t.csv.partial{ending} hard: {is_hard}{option}: {}", done.stderr);
                assert_eq!(fs::read_to_string(path("other")).unwrap(), "of someone else\n", "{what}");
                assert_eq!(fs::read(path("t.csv")).ok(), (done.code == 0).then(|| table.clone()), "{what}");
                if !is_hard && ending.is_empty() {
                    assert!(
                        done.code == 2 && done.stderr.contains("t.csv.partial` is no regular file"),
                        "{what}"
                    );
                }
            }
        }
    }
}

/// Help and version are answers, too.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let full = || File::options().write(true).open("/dev/full").unwrap();
    for words in [
        "--version",
        "--help",
        "help questions",
        "help",
        "solve --help",
        "questions",
        "solve models/drawer.toml",
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        let run = Run::of(command(&words).stdout(full()).output().unwrap());
        assert!(run.code == 2 && run.stderr.contains("no space left on device"), "{words:?}: {}", run.stderr);
    }
    let run = slideway(&[
        "sweep",
        "models/drawer.toml",
        "--vary",
        "mu=0..0.5:2001",
        "--format",
        "csv",
        "--output",
        "/dev/full",
    ]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("cannot be written: no space left on device"), "{}", run.stderr);
}

/// A link to what does not exist yet is followed; two spellings of one file are one file.
#[test]
fn links_are_followed_and_two_outputs_do_not_share_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("link.csv");
    symlink("table.csv", &link).unwrap();
    let name = link.to_str().unwrap();
    assert_eq!(slideway(&["sweep", "models/drawer.toml", "--vary", "mu=0.1,0.2", "--output", name]).code, 0);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(fs::read_to_string(folder.path().join("table.csv")).unwrap().contains("point,mu"));

    let model = command::top().join("models/frictional-oscillator.toml");
    fs::copy(model, folder.path().join("model.toml")).unwrap();
    symlink("same.svg", folder.path().join("link.svg")).unwrap();
    for words in [
        "simulate model.toml --until 1s --plot same.svg --animate ./same.svg",
        "simulate model.toml --until 1s --plot same.svg --animate link.svg",
        "limits model.toml --vary mu --output same.svg --plot ../folder/same.svg",
    ] {
        let folder_name = folder.path().file_name().unwrap().to_str().unwrap();
        let words = words.replace("folder", folder_name);
        let words: Vec<&str> = words.split(' ').collect();
        let output = command(&words).current_dir(folder.path()).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && said.contains("two outputs"), "{words:?}: {said}");
        assert!(!folder.path().join("same.svg").exists());
    }
    let words = ["check", "model.toml", "--force", "--output", "./model.toml"];
    let output = command(&words).current_dir(folder.path()).output().unwrap();
    assert!(String::from_utf8(output.stderr).unwrap().contains("would overwrite its input"));
}
