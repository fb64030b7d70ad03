//! The tests of the Python package: its wheel is built and installed in an environment of its own, then pytest runs.
//!
//! Everything that is needed comes from `tests/requirements.txt`; Python 3.11 or newer has to be there, as `python3`
//! or as what `PYTHON` names.

use std::collections::BTreeSet;
use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the package is built with here: shards, and what its dependencies have in the workspace.
const FEATURES: &str = "parquet,as-in-workspace";

/// Runs a command, and fails with what it printed if it fails; what it printed to its standard output.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} cannot be run: {error}"));
    assert!(
        output.status.success(),
        "{command:?} failed:\n{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Packages with their features, as Cargo builds them for these arguments.
#[cfg(target_os = "linux")]
fn built(arguments: &[&str]) -> BTreeSet<String> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let tree = ["tree", "--locked", "--prefix", "none", "--format", "{p} with {f}", "--no-dedupe"];
    let lines = run(Command::new(cargo).args(tree).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")));
    lines.lines().map(str::to_owned).collect()
}

/// As dependencies come and go: else half of the workspace is built twice. What `as-in-workspace` names is asked of
/// one platform, since dependencies of others differ.
#[test]
#[cfg(target_os = "linux")]
fn the_wheel_shares_what_is_built_for_the_workspace() {
    let workspace = built(&["--workspace", "--edges", "normal,build,dev"]);
    let package = built(&["-p", "slideway-python", "--features", FEATURES, "--edges", "normal,build"]);
    let of_parquet = ["slideway-python", "slideway-tables", "parquet", "seq-macro", "snap", "twox-hash"]
        .map(|name| format!("{name} v"));
    let again: Vec<_> = package
        .difference(&workspace)
        .filter(|line| !of_parquet.iter().any(|name| line.starts_with(name)))
        .collect();
    assert!(again.is_empty(), "with other features than in the workspace: {again:#?}");
}

/// The environment: made anew where what it needs has changed.
fn environment(target: &Path, requirements: &Path) -> PathBuf {
    let environment = target.join("python-tests");
    let kept = environment.join("requirements.txt");
    let wanted = fs::read_to_string(requirements).expect("tests/requirements.txt");
    let python = environment.join("bin").join("python");
    if fs::read_to_string(&kept).ok().as_ref() != Some(&wanted) {
        let host = env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
        run(Command::new(host).args(["-m", "venv", "--clear"]).arg(&environment));
        let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"];
        run(Command::new(&python).args(install).arg(requirements));
        fs::write(kept, wanted).expect("the environment can be written to");
    }
    python
}

/// What PATH is with this folder before all others.
fn path_with(folder: &Path) -> std::ffi::OsString {
    let others = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder.to_owned()).chain(env::split_paths(&others));
    env::join_paths(folders).expect("folders without separators")
}

#[test]
fn the_package_passes_its_tests() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = env::current_exe().expect("a program");
    // target/debug/deps/python-...
    let target = target.ancestors().nth(3).expect("a folder of targets");
    let python = environment(target, &package.join("tests/requirements.txt"));
    let wheels = target.join("python-wheels");
    let _ = fs::remove_dir_all(&wheels);
    // As Cargo has built the workspace.
    let build = [
        "-m",
        "maturin",
        "build",
        "--quiet",
        "--locked",
        "--profile",
        "dev",
        "--features",
        FEATURES,
        "--out",
    ];
    run(Command::new(&python).args(build).arg(&wheels).current_dir(package).env("CARGO_TARGET_DIR", target));
    let is_wheel = |path: &PathBuf| path.extension() == Some(OsStr::new("whl"));
    let wheel = fs::read_dir(&wheels).expect("wheels").map(|entry| entry.expect("an entry").path());
    let wheel = wheel.into_iter().find(is_wheel).expect("a wheel");
    let install =
        ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--force-reinstall", "--no-deps"];
    run(Command::new(&python).args(install).arg(wheel));
    let program = target.join("debug").join("slideway");
    let tests = "-m pytest -q -n auto --dist worksteal tests";
    run(Command::new(&python)
        .args(tests.split(' '))
        .current_dir(package)
        .env("CARGO_TARGET_DIR", target)
        .env("SLIDEWAY", program)
        .env("PATH", path_with(python.parent().expect("a folder of programs"))));
}
