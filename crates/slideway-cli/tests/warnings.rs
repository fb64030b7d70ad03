//! Warnings of the command line: each with its place on standard error beside the answer, or instead of it with
//! `--strict`; and faults of arguments, which have their place as well.

#![allow(clippy::unwrap_used)]

mod command;

use command::slideway;

const DRAWER: &str = "crates/slideway-cli/tests/doubtful/drawer.toml";
const KITCHEN: &str = "crates/slideway-cli/tests/doubtful/kitchen-drawer.toml";
const ENGINE: &str = "crates/slideway-cli/tests/doubtful/engine-with-a-gap.toml";
const LENGTHS: &str = "crates/slideway-cli/tests/doubtful/lengths.toml";
const LONG: &str = "crates/slideway-cli/tests/doubtful/long-rails.toml";
const ANGLE: &str = "crates/slideway-cli/tests/doubtful/bare-angle.toml";

const MAP: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/warnings.svg");

macro_rules! told {
    ($($name:ident: $code:literal [$($argument:expr),* $(,)?];)*) => {$(
        #[test]
        fn $name() {
            let run = slideway(&[$($argument),*]);
            assert_eq!(run.code, $code);
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(run.stderr);
            });
        }
    )*};
}

told! {
    bare_angle: 0 ["solve", ANGLE];
    bare_number: 0 ["solve", DRAWER, "--set", "depth=450"];
    bare_number_beside_its_fault: 2 ["solve", "models/slider-crank.toml", "--set", "r=50"];
    bare_number_of_the_file: 1 ["drive", KITCHEN];
    bare_number_in_place_of_one_of_the_file: 1 ["drive", KITCHEN, "--set", "width=480"];
    length_towers: 0 ["drive", KITCHEN, "--set", "width=500 mm", "--set", "L=300 m", "--set", "mu=0.7"];
    bare_coordinate: 0 ["solve", DRAWER, "--at", "out=0.1"];
    bare_range: 0 ["limits", DRAWER, "--vary", "depth=200 mm..0.45"];
    bare_axis: 0 ["map", DRAWER, "--x", "mu=0..1", "--y", "a=0.1..0.2", "--size", "20x20", "--output", MAP, "--force"];
    bare_values_of_a_sweep: 0 ["sweep", DRAWER, "--vary", "depth=450 mm,0.5", "--vary", "a=0.1..0.2:2"];
    bare_samples: 0 ["sweep", DRAWER, "--vary", "a=normal(200 mm, 0.01)", "--samples", "2"];
    lengths_far_apart: 0 ["solve", LENGTHS];
    gap_closed: 0 ["solve", ENGINE];
    far_from_drawing: 0 ["solve", LONG, "--at", "out=100 m"];
    great_friction: 1 ["solve", DRAWER, "--set", "mu=30"];
    nothing_presses: 0 ["size", "models/drawer.toml", "--set", "Q=0 N", "--vary", "L=200 mm..400 mm", "--margin", "2"];
    range_at_middle: 0 ["limits", DRAWER, "--set", "mu=0.14..0.26", "--vary", "a=100 mm..200 mm"];
    varied_value: 0 ["sweep", "models/frictional-oscillator.toml", "--set", "mu=0.275", "--vary", "mu_static=0.3..0.5:3"];
    strict: 2 ["solve", DRAWER, "--set", "depth=450", "--strict"];
    strict_range: 2 ["limits", DRAWER, "--vary", "depth=200 mm..0.45", "--strict"];
    strict_without_warnings: 0 ["solve", DRAWER, "--strict"];
    strict_check: 2 ["check", ENGINE, "--strict"];
    three_dots: 2 ["limits", DRAWER, "--vary", "mu=0...1"];
    one_character_of_three_dots: 2 ["limits", DRAWER, "--vary", "mu=0\u{2026}1"];
    one_character_of_three_dots_in_a_sweep: 2 ["sweep", DRAWER, "--vary", "mu=0\u{2026}1:5"];
    one_character_of_three_dots_in_a_setting: 2 ["solve", DRAWER, "--set", "mu=0.1\u{2026}0.2"];
    great_friction_through_parameters: 1 ["solve", "models/wedge.toml", "--set", "mu=30"];
    three_dots_in_a_sweep: 2 ["sweep", DRAWER, "--vary", "mu=0...1:5"];
    three_dots_in_a_setting: 2 ["solve", DRAWER, "--set", "mu=0.1...0.2"];
    unknown_quantity: 2 ["limits", DRAWER, "--vary", "nu=0..1"];
    unknown_unit_of_an_end: 2 ["limits", DRAWER, "--vary", "depth=0 mm..1 furlong"];
    range_needed: 2 ["limits", DRAWER, "--vary", "out"];
    both_axes: 2 ["map", DRAWER, "--x", "mu=1", "--y", "a=0...1", "--output", "unwritten.svg"];
    malformed_settings: 2 ["solve", DRAWER, "--set", "mu", "--at", "out=", "--rate", "=1"];
}

/// `check` tells of warnings in its report, and of nothing on standard error.
#[test]
fn check_tells_of_them_in_its_report() {
    let run = slideway(&["check", ENGINE]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(run.stdout) });
}

/// The option wins over the key of the file, and no table or JSON depends on it.
#[test]
fn units_of_the_option() {
    let of = |units: &str, command: &[&str]| slideway(&[command, &["--units", units]].concat()).stdout;
    let [typed, si, mm] = ["as-typed", "SI", "mm"].map(|units| of(units, &["solve", DRAWER]));
    assert!(typed.contains("sliding in mm/s") && mm.contains("sliding in mm/s"), "{typed}{mm}");
    assert!(si.contains("sliding in m/s"), "{si}");
    for format in ["json", "csv"] {
        let command = ["solve", DRAWER, "--format", format];
        assert_eq!(of("mm", &command), of("SI", &command));
    }
}
