//! The README shows what the program really prints.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::path::Path;
use std::process::Command;

/// The blocks of console output: a line `$ command`, then all that the command prints.
///
/// `UPDATE_README=1 cargo test -p slideway-cli --test readme` writes the present output into the file.
#[test]
fn console_blocks_are_what_the_program_prints() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("README.md");
    let readme = std::fs::read_to_string(&path).unwrap();
    let mut present = String::new();
    let mut blocks = 0;
    for (index, part) in readme.split("```console\n").enumerate() {
        if index == 0 {
            present.push_str(part);
            continue;
        }
        let (block, rest) = part.split_once("```").unwrap();
        let command = block.lines().next().unwrap();
        let arguments = command
            .strip_prefix("$ cargo run --release -- ")
            .or(command.strip_prefix("$ slideway "))
            .expect("a console block begins with a command of slideway");
        let output = Command::new(env!("CARGO_BIN_EXE_slideway"))
            .args(arguments.split_whitespace())
            .current_dir(&root)
            .output()
            .unwrap();
        let printed = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        present += &["```console\n", command, "\n", printed.trim_end(), "\n```", rest].concat();
        blocks += 1;
    }
    assert!(blocks >= 2, "the README shows a jam and what helps against it");
    if std::env::var_os("UPDATE_README").is_some() {
        std::fs::write(&path, &present).unwrap();
    }
    let current = std::fs::read_to_string(&path).unwrap();
    assert_eq!(current, present, "run `UPDATE_README=1 cargo test -p slideway-cli --test readme`");
}
