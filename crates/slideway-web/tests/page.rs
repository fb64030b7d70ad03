//! The tests of the page: the engine is built for WebAssembly and the page around it, then Node's test runner compares
//! answers with the command line and goes through the page in Chromium.
//!
//! Needed are Node, npm, Rust's standard library for WebAssembly and Chromium (`.ci/page-tools`). What is missing is said, and
//! the tests are skipped, unless `SLIDEWAY_REQUIRE_BROWSER` is set, as it should be in automatic checks.

#![allow(clippy::print_stderr, reason = "tests")]

use std::env;
use std::path::Path;
use std::process::{Command, Output};

/// The exit code of the build where something is missing on this machine.
const MISSING: i32 = 3;

fn skipped(why: &str) {
    assert!(env::var_os("SLIDEWAY_REQUIRE_BROWSER").is_none(), "SLIDEWAY_REQUIRE_BROWSER is set, but {why}");
    eprintln!("SKIPPED: {why}");
}

/// What both streams of a run say.
fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

#[test]
fn the_page_passes_its_tests() {
    let web = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web");
    let target = env::current_exe().expect("a program");
    // target/debug/deps/page-...
    let target = target.ancestors().nth(3).expect("a folder of targets");
    let node = |arguments: &[&str]| {
        let mut command = Command::new("node");
        command.args(arguments).current_dir(&web).env("CARGO_TARGET_DIR", target);
        command.env("SLIDEWAY", target.join("debug/slideway")).output()
    };
    let Ok(built) = node(&["tools/build.js"]) else {
        return skipped("there is no Node on this machine");
    };
    if built.status.code() == Some(MISSING) {
        return skipped(&said(&built));
    }
    assert!(built.status.success(), "the page cannot be built:\n{}", said(&built));
    let tested = node(&["--test", "--test-concurrency=2", "test/"]).expect("Node");
    assert!(tested.status.success(), "{}", said(&tested));
    if said(&tested).contains("# SKIP") {
        skipped("there is no Chromium on this machine; name one in CHROMIUM to run all tests of the page");
    }
}
