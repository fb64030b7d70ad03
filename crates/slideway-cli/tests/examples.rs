//! The examples of the help do what they show.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

mod command;

use command::{slideway, top};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};

/// Commands whose examples need nothing but the models: those of `modes` read problems of the user's, those
/// of `completions` write to the home directory.
const COMMANDS: [&str; 13] = [
    "check", "draw", "drive", "hold", "limits", "map", "models", "new", "report", "simulate", "size",
    "solve", "sweep",
];

/// The examples of a help: lines behind the title, with what is broken off joined and without the words
/// behind them.
fn examples(help: &str) -> Vec<String> {
    let mut examples: Vec<String> = Vec::new();
    for line in
        help.lines().skip_while(|line| *line != "Examples:").skip(1).take_while(|line| !line.is_empty())
    {
        let text = line.trim();
        let text = text.split_once("  ").map_or(text, |(example, _)| example);
        match examples.last_mut() {
            Some(last) if !text.starts_with("slideway ") => {
                // As a shell joins lines.
                let joined = format!("{} {text}", last.trim_end_matches(['\\', ' ']));
                *last = joined;
            }
            _ => examples.push(text.to_owned()),
        }
    }
    examples
}

fn run(example: &str, folder: &Path) -> (Option<i32>, String) {
    let binary = Path::new(env!("CARGO_BIN_EXE_slideway")).parent().unwrap();
    // Nothing is to open on the screen of whoever runs the tests.
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    fs::write(folder.join(opener), "#!/bin/sh\n").unwrap();
    fs::set_permissions(folder.join(opener), fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}:{}", folder.display(), binary.display(), std::env::var("PATH").unwrap());
    let output = Command::new("sh")
        .args(["-c", example])
        .current_dir(folder)
        .env("PATH", path)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn examples_of_the_help_run() {
    let mut count = 0;
    for name in COMMANDS {
        let found = examples(&slideway(&[name, "--help"]).stdout);
        assert!(!found.is_empty(), "{name}");
        for example in found {
            let folder = tempfile::tempdir().unwrap();
            // Nobody can be asked here.
            if example == "slideway new" {
                continue;
            }
            // Models of the gallery bear the same names.
            let example = example.replace("slideway new drawer", "slideway new drawer --force");
            for model in fs::read_dir(top().join("models")).unwrap() {
                let model = model.unwrap();
                fs::copy(model.path(), folder.path().join(model.file_name())).unwrap();
            }
            // An example that overwrites its page has one.
            if example.contains("--force") {
                fs::write(folder.path().join("drawer.html"), "").unwrap();
            }
            let (code, said) = run(&example, folder.path());
            // What can be varied is listed where nothing is.
            let lists = code == Some(2) && said.contains("what is to be varied?");
            assert!(lists || matches!(code, Some(0 | 1)), "{example}: {code:?}\n{said}");
            count += 1;
        }
    }
    assert!(count > 40, "{count}");
}
