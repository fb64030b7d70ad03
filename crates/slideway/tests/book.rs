//! The complete model files of the book parse and can be solved.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::model::Model;
use slideway::solve::solve;
use std::fs;
use std::path::Path;

/// The code blocks in TOML that begin with the line `# complete`.
fn complete_examples() -> Vec<(String, String)> {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src");
    let mut examples = Vec::new();
    for page in fs::read_dir(pages).unwrap().map(|entry| entry.unwrap().path()) {
        if page.extension().is_some_and(|ending| ending == "md") {
            let text = fs::read_to_string(&page).unwrap();
            for block in text.split("```toml\n").skip(1) {
                let block = block.split("```").next().unwrap();
                if block.starts_with("# complete") {
                    examples.push((page.display().to_string(), block.to_owned()));
                }
            }
        }
    }
    examples
}

#[test]
fn complete_examples_can_be_solved() {
    let examples = complete_examples();
    assert!(examples.len() >= 3, "the reference of the model file has complete examples");
    for (page, text) in examples {
        let report = Model::parse(&text).and_then(|model| solve(&model));
        let report = report.unwrap_or_else(|faults| panic!("{page}:\n{text}\n{faults}"));
        assert!(report.complete == "proven", "{page}:\n{text}");
    }
}
