//! The complete model files of the book parse and can be solved, and what comments cite of it exists.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::model::Model;
use slideway::report::Proof;
use slideway::solve::solve;
use std::fs;
use std::path::{Path, PathBuf};

/// The code blocks in TOML that begin with the line `# complete`.
fn complete_examples() -> Vec<(String, String)> {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/src");
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
        assert!(report.complete == Proof::Proven, "{page}:\n{text}");
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    if folder.is_file() {
        return vec![folder.to_owned()];
    }
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_source = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "rs");
    entries
        .flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] })
        .filter(is_source)
        .collect()
}

/// The number of a section at the beginning of a text, and the letter behind it in parentheses.
fn citation(text: &str) -> (String, Option<char>) {
    let number: String = text.chars().take_while(char::is_ascii_digit).collect();
    let rest: Vec<char> = text[number.len()..].chars().take(4).collect();
    match rest[..] {
        [' ', '(', letter @ 'a'..='z', ')'] => (number, Some(letter)),
        _ => (number, None),
    }
}

#[test]
fn sections_of_the_theory_that_comments_cite_exist() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let theory = fs::read_to_string(top.join("docs/src/theory.md")).unwrap();
    let sections: Vec<&str> = theory.split("\n## ").skip(1).collect();
    let mut cited = 0;
    for path in sources(&top.join("crates")) {
        // Citations may be broken between lines.
        let lines = fs::read_to_string(&path).unwrap();
        let words = lines.lines().map(|line| line.trim().trim_start_matches(['/', '!', ' ']));
        let text = words.collect::<Vec<_>>().join(" ");
        for (_, cites) in
            text.match_indices("heory, section ").map(|(at, found)| (at, &text[at + found.len()..]))
        {
            let (number, letter) = citation(cites);
            // As in this very test.
            if number.is_empty() {
                continue;
            }
            let section = sections.iter().find(|section| section.starts_with(&format!("{number}. ")));
            let section = section.unwrap_or_else(|| panic!("{}: no section {number}", path.display()));
            let has = letter.is_none_or(|letter| section.contains(&format!("**({letter}) ")));
            assert!(has, "{}: section {number} has no ({letter:?})", path.display());
            cited += 1;
        }
    }
    assert!(cited > 50, "the sources cite the theory");
}

/// The constants of a page's tables: the section's module, the name and the value of each.
fn constants(page: &str) -> Vec<[&str; 3]> {
    let mut found = Vec::new();
    for section in page.split("\n## `").skip(1) {
        let module = section.split('`').next().unwrap();
        for row in section.lines().filter(|line| line.starts_with("| `")) {
            let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
            found.push([module, cells[1], cells[2]]);
        }
    }
    found
}

#[test]
fn tolerances_of_the_book_are_those_of_the_sources() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let pages = ["docs/src/tolerances.md", "docs/decisions/effort-of-the-search.md"];
    let page = pages.map(|page| fs::read_to_string(top.join(page)).unwrap()).concat();
    let constants = constants(&page);
    assert!(constants.len() > 50, "the page has tables");
    for [module, name, value] in constants {
        let folder = match module {
            "slideway-modes" => "crates/slideway-modes/src".to_owned(),
            _ => format!("crates/slideway/src/{module}"),
        };
        let paths = sources(&top.join(&folder));
        let defines = |path: &PathBuf| {
            let text = fs::read_to_string(path).unwrap();
            text.lines().any(|line| {
                line.contains(&format!("const {name}: ")) && line.ends_with(&format!(" = {value};"))
            })
        };
        assert!(paths.iter().any(defines), "{folder} has no constant {name} of value {value}");
    }
}

#[test]
fn the_book_promises_nothing() {
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/src");
    for page in fs::read_dir(pages).unwrap().map(|entry| entry.unwrap().path()) {
        if page.extension().is_some_and(|ending| ending == "md") {
            let text = fs::read_to_string(&page).unwrap().to_lowercase();
            assert!(
                !text.contains("not yet"),
                "{}: what is not there yet is left to the issues",
                page.display()
            );
        }
    }
}
