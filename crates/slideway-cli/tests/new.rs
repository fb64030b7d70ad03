//! Models that are written from templates.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod command;

use command::{Run, command};
use slideway::Model;
use slideway::template::TEMPLATES;
use std::fs;
use tempfile::TempDir;

fn slideway(folder: &TempDir, arguments: &[&str]) -> Run {
    let output = command(arguments).current_dir(folder.path()).output().unwrap();
    Run::of(output)
}

#[test]
fn a_model_is_written_and_its_question_answered() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&folder, &["new", "drawer", "--L", "300mm", "--a", "L/2", "--mu", "0.35"]);
    let written = fs::read_to_string(folder.path().join("drawer.toml")).unwrap();
    insta::assert_snapshot!(format!("{}--- drawer.toml\n{written}", run.transcript()));
    // What it says is what the command says of the file.
    let answer = slideway(&folder, &["drive", "drawer.toml"]);
    assert!(run.stdout.ends_with(&format!("$ slideway drive drawer.toml\n{}", answer.stdout)));
}

#[test]
fn a_file_without_a_template_lists_the_templates() {
    let folder = tempfile::tempdir().unwrap();
    for option in [&["--output", "x.toml"][..], &["-o", "x.toml"], &["--output=x.toml"], &["--force"]] {
        let run = slideway(&folder, &[&["new"], option].concat());
        assert_eq!(run.code, 2);
        assert!(run.stderr.starts_with("error: which template? None is named\n"), "{}", run.stderr);
        assert!(TEMPLATES.iter().all(|template| run.stderr.contains(template.name)), "{}", run.stderr);
    }
    let run = slideway(&folder, &["new", "--what"]);
    assert!(run.stderr.starts_with("error: `slideway new` has no option `--what`"), "{}", run.stderr);
}

#[test]
fn a_motion_without_an_end_is_asked_for_one() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&folder, &["simulate", "drawer.toml"]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("until when?") && run.stderr.contains("`--until 1s`"), "{}", run.stderr);
}

#[test]
fn every_template_is_written_and_answers() {
    let folder = tempfile::tempdir().unwrap();
    for template in TEMPLATES {
        let run = slideway(&folder, &["new", template.name]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", template.name);
        let file = format!("{}.toml", template.name);
        let written = fs::read_to_string(folder.path().join(&file)).unwrap();
        Model::parse(&written).unwrap();
        assert!(run.stdout.starts_with(&format!("Wrote {file}. Kept from the template: ")), "{}", run.stdout);
        // So do its other commands.
        for command in template.commands() {
            let command = command.replace("FILE", &file).replace('"', "");
            let words: Vec<&str> = command.split(' ').skip(1).collect();
            // A range is one word.
            let run = slideway(&folder, &ranges(&words).iter().map(String::as_str).collect::<Vec<_>>());
            assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{command}");
        }
    }
}

/// Words of a command whose ranges were broken at the blanks within.
fn ranges(words: &[&str]) -> Vec<String> {
    let mut whole: Vec<String> = Vec::new();
    for word in words {
        match whole.last_mut() {
            Some(last) if last.contains('=') && !word.starts_with("--") => last.extend([" ", word]),
            _ => whole.push((*word).to_owned()),
        }
    }
    whole
}

#[test]
fn a_jam_is_an_answer() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&folder, &["new", "peg", "--l", "3mm"]);
    assert_eq!(run.code, 0);
    assert!(run.stdout.contains("It jams: no force moves it."), "{}", run.stdout);
}

#[test]
fn a_file_is_overwritten_only_if_asked_to() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("my wedge.toml");
    fs::write(&file, "mine").unwrap();
    let refused = slideway(&folder, &["new", "wedge", "--output", "my wedge.toml"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (2, ""));
    assert!(refused.stderr.contains("already exists"), "{}", refused.stderr);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    // Nor if the values make no sense.
    let refused = slideway(&folder, &["new", "wedge", "--output", "my wedge.toml", "--force", "--mu", "-1"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (2, ""));
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    let run = slideway(&folder, &["new", "wedge", "--output", "my wedge.toml", "--force"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("\n$ slideway drive 'my wedge.toml'\n"), "{}", run.stdout);
    assert!(fs::read_to_string(&file).unwrap().contains("#   slideway drive 'my wedge.toml'\n"));
}

#[test]
fn a_name_may_look_like_an_option() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&folder, &["new", "wedge", "--output=-x.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(folder.path().join("-x.toml").is_file());
    assert!(run.stdout.contains("$ slideway drive ./-x.toml\n"), "{}", run.stdout);
}

#[test]
fn standard_output_gets_the_model_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let run = slideway(&folder, &["new", "peg", "--e", "2 mm", "--output", "-"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    Model::parse(&run.stdout).unwrap();
    assert!(run.stdout.contains("\ne = \"2 mm\" ") && run.stdout.contains("slideway drive peg.toml"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
