//! What the fuzz targets check holds of the gallery, of the book's raw problems and of some random inputs.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::fs;

use proptest::prelude::*;
use slideway::gallery;
use slideway_fuzz::{expression, limits, model, ranges, raw_extremes, raw_json, raw_npz, search, terminal};

#[test]
fn files_of_the_project_pass() {
    for found in gallery::MODELS {
        model(found.text);
        terminal(found.text.lines().next().unwrap());
    }
    for entry in fs::read_dir("../../docs/src/examples").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "json") {
            raw_json(&fs::read(path).unwrap());
        }
    }
}

/// All questions over ranges with few numbers in them, with numbers whose squares underflow, and wider than the greatest number.
#[test]
fn questions_over_ranges_that_nobody_would_write_end() {
    let crank = gallery::MODELS.iter().position(|model| model.name == "bell-crank").unwrap();
    let hostile = [
        [1.657_809_2e-316, 5.776_622_002_767_455e-275],
        [5e-324, 1e-323],
        [-5e-324, 5e-324],
        [1e-200, 1e-160],
        [1e16, 1e16 + 2.0],
        [-f64::MAX, f64::MAX],
    ];
    for (ends, question) in hostile.into_iter().flat_map(|ends| (0..7).map(move |question| (ends, question)))
    {
        ranges((u8::try_from(crank).unwrap(), question, [0, 1], ends));
    }
    // The distance of neighbours in a range of the least numbers has no two digits.
    let oscillator = gallery::MODELS.iter().position(|model| model.name == "frictional-oscillator").unwrap();
    ranges((u8::try_from(oscillator).unwrap(), 0, [0, 0], [0.0, 2.42e-322]));
}

/// Ends of ranges as a user may write them: ordinary ones, very great and small ones, and none at all.
fn end() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, any::<f64>(), Just(0.0), Just(f64::MAX), Just(-f64::MAX), Just(f64::NAN)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn ranges_pass(asked in any::<(u8, u8, [u8; 2])>(), ends in [end(), end()]) {
        let (model, question, numbers) = asked;
        ranges((model, question, numbers, ends));
        limits((model, question % 2 == 0, &format!("friction={}..{}", ends[0], ends[1])));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn bytes_pass(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        raw_extremes(&bytes);
        search(&bytes);
        raw_npz(&bytes);
        raw_json(&bytes);
    }

    #[test]
    fn texts_pass(text in any::<String>(), formula in "[-+*/^()., 0-9a-z]{1,12}") {
        model(&text);
        expression(&text);
        expression(&formula);
    }
}
