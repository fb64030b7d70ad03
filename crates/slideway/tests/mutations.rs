//! Mutated model files: parsing, checking and solving never panic, and never answer with NaN.

#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use slideway::Report;
use slideway::gallery::MODELS;
use slideway::model::Model;
use slideway::modes::SearchOptions;
use slideway::solve::SolveOptions;
use slideway::{check, report, solve};
use std::ops::ControlFlow;

/// A change of a file.
#[derive(Debug, Clone)]
enum Mutation {
    DeleteBytes(usize, usize),
    InsertBytes(usize, Vec<u8>),
    ReplaceByte(usize, u8),
    DeleteLine(usize),
    DoubleLine(usize, usize),
    SwapWords(usize, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let place = 0..20_000_usize;
    // Characters that mean something in a model file, beside any bytes.
    let meaningful = prop::sample::select(b"0123456789.eE+-*/^()[]{}=\"',#_ \n\tabgmklxnif".to_vec());
    prop_oneof![
        (place.clone(), 1..12_usize).prop_map(|(at, length)| Mutation::DeleteBytes(at, length)),
        (place.clone(), prop::collection::vec(meaningful.clone(), 1..4))
            .prop_map(|(at, bytes)| Mutation::InsertBytes(at, bytes)),
        (place.clone(), prop_oneof![4 => meaningful, 1 => any::<u8>()])
            .prop_map(|(at, byte)| Mutation::ReplaceByte(at, byte)),
        place.clone().prop_map(Mutation::DeleteLine),
        (place.clone(), place.clone()).prop_map(|(line, at)| Mutation::DoubleLine(line, at)),
        (place.clone(), place).prop_map(|(first, second)| Mutation::SwapWords(first, second)),
    ]
}

impl Mutation {
    fn apply(&self, mut bytes: Vec<u8>) -> Vec<u8> {
        if bytes.is_empty() {
            return bytes;
        }
        let length = bytes.len();
        match self {
            Self::DeleteBytes(at, count) => {
                let at = at % length;
                bytes.drain(at..(at + count).min(length));
                bytes
            }
            Self::InsertBytes(at, inserted) => {
                let at = at % length;
                bytes.splice(at..at, inserted.iter().copied());
                bytes
            }
            Self::ReplaceByte(at, byte) => {
                bytes[at % length] = *byte;
                bytes
            }
            Self::DeleteLine(line) => {
                let mut lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
                lines.remove(line % lines.len());
                lines.join(&b'\n')
            }
            Self::DoubleLine(line, at) => {
                let mut lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
                let doubled = lines[line % lines.len()];
                lines.insert(at % lines.len(), doubled);
                lines.join(&b'\n')
            }
            Self::SwapWords(first, second) => {
                let mut words: Vec<&[u8]> = bytes.split(|byte| *byte == b'"').collect();
                let count = words.len();
                words.swap(first % count, second % count);
                words.join(&b'"')
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_files_give_faults_or_finite_answers(
        index in 0..MODELS.len(),
        mutations in prop::collection::vec(mutation(), 1..4),
    ) {
        let text = MODELS[index].text.as_bytes().to_vec();
        let bytes = mutations.iter().fold(text, |bytes, mutation| mutation.apply(bytes));
        match Model::parse_bytes(&bytes) {
            Err(faults) => {
                prop_assert!(!faults.is_empty());
                for fault in faults.sorted() {
                    prop_assert!(!fault.kind.to_string().is_empty());
                    let told = format!("{} {}", fault.kind, fault.kind.hint().unwrap_or_default());
                    let shows_stand_in = told.contains('\u{1}') && !bytes.contains(&1);
                    prop_assert!(!shows_stand_in, "{told}");
                    if let Some(place) = &fault.place {
                        prop_assert!(place.span.start <= place.span.end && place.span.end <= bytes.len());
                    }
                }
            }
            Ok(model) => {
                let search = SearchOptions { nodes: 1000, ..SearchOptions::default() };
                let options = SolveOptions::default().search(search);
                let report = solve::solve_with(&model, &options, &mut |_| ControlFlow::Continue(()));
                if let Ok(report) = report {
                    let text = report.text(report::Style::PLAIN);
                    prop_assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
                    // JSON knows no NaN: it would be null.
                    let json = report.json();
                    let without_title = json.replace("\"title\": null", "");
                    prop_assert!(!without_title.contains("null"), "{json}");
                }
                if let Ok(found) = check::check(&model) {
                    prop_assert!(!found.text(report::Style::PLAIN).contains("NaN"));
                }
            }
        }
    }
}
