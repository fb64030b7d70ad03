//! The invariants of ARCHITECTURE.md that a test can hold: what each module may import, and what the library
//! never does.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::fs;
use std::path::{Path, PathBuf};

/// Each module and the ones that it may use: a stage knows only the stages to its left.
const IMPORTS: &[(&str, &[&str])] = &[
    ("choice", &[]),
    ("expression", &["interval", "printable"]),
    ("ids", &[]),
    ("fault", &["expression", "printable", "units"]),
    ("units", &["choice", "expression"]),
    ("model", &["expression", "fault", "ids", "interval", "units"]),
    ("drawing", &["fault", "ids", "model", "printable"]),
    ("mechanism", &["dense", "expression", "fault", "ids", "interval", "model", "modes", "units"]),
    ("configuration", &["dense", "fault", "ids", "interval", "mechanism", "model", "progress"]),
    ("kinetics", &["configuration", "dense", "fault", "ids", "interval", "mechanism", "model", "units"]),
    ("influence", &["ids", "kinetics", "mechanism", "units"]),
    ("law", &["interval", "mechanism", "model", "modes"]),
    ("report", &["choice", "fault", "ids", "printable", "units"]),
    ("problem", &["ids", "interval", "mechanism", "model", "modes"]),
    ("sharing", &["fault", "interval", "mechanism", "modes", "report"]),
    (
        "enclosure",
        &[
            "configuration",
            "fault",
            "ids",
            "interval",
            "kinetics",
            "mechanism",
            "model",
            "modes",
            "problem",
            "progress",
            "sharing",
        ],
    ),
    ("attainability", &["configuration", "ids", "kinetics", "mechanism", "modes", "report", "sharing"]),
    ("pattern", &["configuration", "ids", "mechanism", "model", "modes", "progress", "units"]),
    ("one_face", &["configuration", "ids", "influence", "kinetics", "mechanism", "model", "report"]),
    ("import", &["drawing", "expression", "fault", "model", "printable", "progress"]),
    ("raw_problem", &["report"]),
    ("gallery", &[]),
    ("template", &["configuration", "fault", "mechanism", "model", "printable"]),
];

/// Modules of `slideway-modes`, floor by floor: a module knows only those of lower floors.
const FLOORS_OF_MODES: &[&[&str]] = &[
    &["combinations", "error_free", "names", "printable", "progress", "random_numbers", "status"],
    &["dense", "scan"],
    &["interval", "simplex"],
    &["interval_matrix"],
    &["problem"],
    &["certificate"],
    &["solutions"],
    &["findings"],
    &["enumeration"],
    &["existence", "screen", "uniqueness"],
    &["search"],
    &["blocks"],
    &["branches"],
    &["raw_problem"],
];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../src")
}

fn source_of_modes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../slideway-modes/src")
}

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    fs::read_dir(path).unwrap().flat_map(|entry| files(&entry.unwrap().path())).collect()
}

/// The files of a module: `name.rs` or the folder `name`.
fn files_of(source: &Path, module: &str) -> Vec<PathBuf> {
    let single = source.join(format!("{module}.rs"));
    if single.is_file() { vec![single] } else { files(&source.join(module)) }
}

/// The modules of its crate that a file names, with the lines.
fn imports(file: &Path) -> Vec<(String, String)> {
    let named = |line: &str| -> Vec<String> {
        let name = |at: usize| {
            let rest = line[at + "crate::".len()..].chars();
            rest.take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        };
        line.match_indices("crate::").map(|(at, _)| name(at)).collect()
    };
    let lines = code(file).into_iter();
    lines.flat_map(|line| named(&line).into_iter().map(move |name| (name, line.trim().to_owned()))).collect()
}

/// The lines of a file that are neither comments nor documentation.
fn code(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(str::to_owned).collect()
}

#[test]
fn a_stage_imports_only_stages_to_its_left() {
    for (module, allowed) in IMPORTS {
        for file in files_of(&source(), module) {
            for (name, line) in imports(&file) {
                let fine = name == *module || allowed.contains(&name.as_str());
                assert!(fine, "{}: `{line}` uses `{name}`", file.display());
            }
        }
    }
}

/// The floors of `motion`: what moves, what decides, what is remembered, what follows the motion, what is
/// told.
const FLOORS_OF_MOTION: &[&str] = &["options", "moving", "decision", "record", "following", "told"];

#[test]
fn a_floor_of_motion_imports_only_floors_below() {
    for (floor, name) in FLOORS_OF_MOTION.iter().enumerate() {
        for file in files_of(&source().join("motion"), name) {
            let own = |path: &str| {
                let first = path.split([':', ';', '{', ',']).next().unwrap_or_default();
                FLOORS_OF_MOTION[..=floor].contains(&first)
            };
            for line in code(&file) {
                let used = line.match_indices("crate::motion::").map(|(at, found)| &line[at + found.len()..]);
                let restricted = line.contains("pub(in crate::motion)");
                assert!(restricted || used.into_iter().all(own), "{}: `{}`", file.display(), line.trim());
            }
        }
    }
}

/// Options and questions have other names in Python: only `Face` knows those of the command line.
#[test]
fn faults_do_not_speak_the_words_of_one_interface() {
    let mut all = files(&source().join("fault"));
    all.retain(|file| !file.ends_with("face.rs"));
    all.extend([source().join("fault.rs"), source().join("import/mod.rs")]);
    for file in all {
        for line in code(&file) {
            let option =
                line.split("--").skip(1).any(|after| after.starts_with(|c: char| c.is_ascii_lowercase()));
            assert!(!option && !line.contains("`slideway "), "{}: `{}`", file.display(), line.trim());
        }
    }
}

/// nalgebra's iterations go on for ever with some numbers: those with a most number of steps are used.
#[test]
fn every_iteration_of_linear_algebra_ends() {
    let endless =
        ["SVD::new", ".svd(", ".singular_values()", "_eigen()", "Eigen::new", "Schur::new", ".schur()"];
    for source in [source(), source_of_modes()] {
        for file in files(&source) {
            let own = file.strip_prefix(&source).unwrap();
            if own.iter().any(|part| part == "tests" || part == "tests.rs") {
                continue;
            }
            for line in code(&file) {
                let found = endless.iter().any(|call| line.contains(call));
                assert!(!found, "{}: `{}`", file.display(), line.trim());
            }
        }
    }
}

/// Linear programs are asked in one place alone.
#[test]
fn one_module_knows_the_solver_of_linear_programs() {
    let knows: Vec<PathBuf> =
        files(&source()).into_iter().filter(|file| code(file).join("\n").contains("simplex::")).collect();
    assert_eq!(knows, [source().join("pattern").join("program.rs")]);
}

#[test]
fn modules_of_the_mode_problem_know_only_lower_floors() {
    let floor_of = |module: &str| FLOORS_OF_MODES.iter().position(|floor| floor.contains(&module));
    for file in files(&source_of_modes()) {
        let inside = file.strip_prefix(source_of_modes()).unwrap().components().next().unwrap();
        let module = inside.as_os_str().to_str().unwrap().trim_end_matches(".rs");
        if module == "lib" {
            continue;
        }
        let floor = floor_of(module);
        assert!(floor.is_some(), "{module} is on no floor");
        for (name, line) in imports(&file) {
            assert!(name == module || floor_of(&name) < floor, "{}: `{line}`", file.display());
            assert!(name == module || floor_of(&name).is_some(), "{}: `{line}`", file.display());
        }
    }
}

#[test]
fn every_module_is_listed_or_stands_on_top() {
    let library = fs::read_to_string(source().join("lib.rs")).unwrap();
    for module in library.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')) {
        let listed = IMPORTS.iter().any(|(name, _)| *name == module);
        let on_top =
            ["solve", "limits", "standstill", "check", "drive", "size", "sweep", "map", "motion", "warning"]
                .contains(&module);
        assert!(listed || on_top, "{module} is not in the table of imports");
    }
}

#[test]
fn the_library_has_no_files_no_clock_and_no_output() {
    for file in [source(), source_of_modes()].iter().flat_map(|source| files(source)) {
        for line in code(&file) {
            for forbidden in ["std::fs", "std::time", "std::env", "std::process", "println!", "eprintln!"] {
                assert!(!line.contains(forbidden), "{}: {}", file.display(), line.trim());
            }
        }
    }
}

/// Tests are named one by one (`autotests = false`), so that most of them share a program.
#[test]
fn no_file_of_tests_is_forgotten() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for package in ["slideway", "slideway-modes"].map(|name| crates.join(name)) {
        let manifest = fs::read_to_string(package.join("tests/Cargo.toml")).unwrap();
        let together = fs::read_to_string(package.join("tests/all.rs")).unwrap();
        for entry in fs::read_dir(package.join("tests")).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            let run = if path.join("main.rs").is_file() {
                manifest.contains(&format!("path = \"{name}/main.rs\""))
            } else {
                path.extension().is_none_or(|ending| ending != "rs")
                    || name == "lib"
                    || together.contains(&format!("mod {name};"))
            };
            assert!(run || name == "all", "{} is not run", path.display());
        }
    }
}
