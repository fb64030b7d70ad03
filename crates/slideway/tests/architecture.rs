//! The invariants of ARCHITECTURE.md that a test can hold: what each module may import, and what the library
//! never does.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::fs;
use std::path::{Path, PathBuf};

/// Each module and the ones that it may use: a stage knows only the stages to its left.
const IMPORTS: &[(&str, &[&str])] = &[
    ("interval", &[]),
    ("printable", &[]),
    ("expression", &["interval"]),
    ("ids", &[]),
    ("progress", &[]),
    ("fault", &["expression", "printable"]),
    ("model", &["expression", "fault", "ids", "interval"]),
    ("mechanism", &["expression", "fault", "ids", "interval", "model"]),
    ("configuration", &["fault", "ids", "interval", "mechanism", "model"]),
    ("kinetics", &["configuration", "fault", "ids", "interval", "mechanism", "model"]),
    ("influence", &["ids", "kinetics"]),
    ("modes", &["interval", "progress"]),
    ("enclosure", &["configuration", "fault", "ids", "interval", "kinetics", "mechanism", "model", "modes"]),
    ("report", &["fault", "printable"]),
    ("attainability", &["configuration", "kinetics", "mechanism", "modes", "report"]),
    ("pattern", &["ids", "mechanism", "model", "modes"]),
    ("raw_problem", &["fault", "modes", "printable", "progress", "report"]),
    ("gallery", &[]),
];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    fs::read_dir(path).unwrap().flat_map(|entry| files(&entry.unwrap().path())).collect()
}

/// The files of a module: `name.rs` or the folder `name`.
fn files_of(module: &str) -> Vec<PathBuf> {
    let single = source().join(format!("{module}.rs"));
    if single.is_file() { vec![single] } else { files(&source().join(module)) }
}

/// The lines of a file that are neither comments nor documentation.
fn code(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(str::to_owned).collect()
}

#[test]
fn a_stage_imports_only_stages_to_its_left() {
    for (module, allowed) in IMPORTS {
        for file in files_of(module) {
            for line in code(&file) {
                for (at, _) in line.match_indices("crate::") {
                    let rest = &line[at + "crate::".len()..];
                    let name: String =
                        rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                    let fine = name == *module || allowed.contains(&name.as_str());
                    assert!(fine, "{}: `{}` uses `{name}`", file.display(), line.trim());
                }
            }
        }
    }
}

/// Linear programs are asked in one place alone.
#[test]
fn one_module_knows_the_solver_of_linear_programs() {
    let knows: Vec<PathBuf> =
        files(&source()).into_iter().filter(|file| code(file).join("\n").contains("microlp")).collect();
    assert_eq!(knows, [source().join("pattern").join("program.rs")]);
}

#[test]
fn every_module_is_listed_or_stands_on_top() {
    let library = fs::read_to_string(source().join("lib.rs")).unwrap();
    for module in library.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')) {
        let listed = IMPORTS.iter().any(|(name, _)| *name == module);
        let on_top = ["solve", "limits", "standstill", "check", "drive", "size", "sweep", "map", "motion"]
            .contains(&module);
        assert!(listed || on_top, "{module} is not in the table of imports");
    }
}

#[test]
fn the_library_has_no_files_no_clock_and_no_output() {
    for file in files(&source()) {
        for line in code(&file) {
            for forbidden in ["std::fs", "std::time", "std::env", "std::process", "println!", "eprintln!"] {
                assert!(!line.contains(forbidden), "{}: {}", file.display(), line.trim());
            }
        }
    }
}
