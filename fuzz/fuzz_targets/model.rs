//! Any text as a model file: no panic, and what is accepted is solved within limits or refused with faults.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slideway::model::Model;
use slideway::modes::Limits;
use slideway::report::{self, Style};
use slideway::{check, solve};

/// A mechanism with many contacts is refused instead of taking long.
fn limits() -> Limits {
    Limits { contacts: 8, patterns: 1000, bases: 1000, ..Limits::default() }
}

fuzz_target!(|text: &str| {
    let model = match Model::parse(text) {
        Ok(model) => model,
        Err(faults) => {
            assert!(!faults.to_string().is_empty());
            return;
        }
    };
    let _ = check::check(&model);
    if let Ok(answer) = solve::solve_within(&model, &limits()) {
        let _ = (report::to_text(&answer, Style::default()), report::to_csv(&answer));
        // No number that is printed is infinite or undefined: JSON would have `null`, which only a title may be.
        let json = report::to_json(&answer);
        let null = |line: &&str| line.trim_end_matches(',').ends_with("null") && !line.contains("\"title\"");
        assert_eq!(json.lines().find(null), None, "{json}");
    }
});
