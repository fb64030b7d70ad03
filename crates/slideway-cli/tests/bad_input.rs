//! Every kind of bad input and its message. Files with one kind of fault each are in `bad/`.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway, slideway_reading, top};
use std::path::Path;

/// One golden file for each model in `bad/`; each is refused with exit code 2 and nothing on standard output.
#[test]
fn every_file_is_refused_with_its_message() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let mut names: Vec<String> = std::fs::read_dir(&directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.len() > 40, "the files are gone");
    for name in names {
        let output = command(&["solve", &name]).current_dir(&directory).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(output.stdout.is_empty(), "{name}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(!message.contains("NaN") || name == "not-finite.toml", "{name}: {message}");
        insta::with_settings!({ description => name.clone(), omit_expression => true }, {
            insta::assert_snapshot!(format!("bad__{}", name.trim_end_matches(".toml")), message);
        });
    }
}

/// No value of these ranges is valid: the fault is shown in the argument, where it lies in one.
#[test]
fn a_range_without_a_valid_value_is_refused() {
    let never = std::env::temp_dir().join("slideway-never-written.html");
    let never = never.to_str().unwrap();
    let negative = ["--vary", "m=-2..-1"];
    let questions: [(&str, &[&str]); 3] = [
        ("hold", &[]),
        ("size", &["--margin", "2"]),
        // The place is none in the setting that was given.
        ("report", &["--set", "a=0.2 m", "--output", never]),
    ];
    for (command, more) in questions {
        let run = slideway(&[&[command, DRAWER][..], &negative, more].concat());
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{command}: {}", run.stderr);
        assert!(run.stderr.contains("--vary m=-2..-1"), "{command}: {}", run.stderr);
    }
    let run = slideway(&["limits", "models/bracket-on-pole.toml", "--vary", "mu=1..2"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(run.stderr.contains("--vary mu=1..2"), "{}", run.stderr);
    // The rod is shorter than the crank throughout.
    let run = slideway(&["limits", "models/slider-crank.toml", "--vary", "l=10mm..20mm"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
}

#[test]
fn pounds_are_no_forces() {
    let run = slideway(&["solve", DRAWER, "--set", "Q=20 lb"]);
    assert_eq!(run.code, 2);
    let told = run.stderr.contains("a mass where a force is expected") && run.stderr.contains("`lbf`");
    assert!(told, "{}", run.stderr);
}

macro_rules! refused {
    ($($name:ident: [$($argument:expr),* $(,)?];)*) => {$(
        #[test]
        fn $name() {
            let run = slideway(&[$($argument),*]);
            assert_eq!(run.code, 2);
            assert_eq!(run.stdout, "");
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(run.stderr);
            });
        }
    )*};
}

const DRAWER: &str = "models/drawer.toml";
const KLEPP: &str = "models/klepp-2002.toml";
const RAILS: &str = "models/drawer-on-two-rails.toml";

refused! {
    absent_file: ["solve", "nowhere/drawing.toml"];
    new_without_a_name: ["new"];
    new_unknown_template: ["new", "drower"];
    new_unknown_parameter: ["new", "drawer", "--LL", "400mm"];
    new_wrong_units: ["new", "drawer", "--L", "400 kg", "--mu", "-0.3", "--Q", "20 N +"];
    new_without_units: ["new", "drawer", "--L", "400", "--mu", "0.3"];
    new_that_cannot_be_assembled: ["new", "slider-crank", "--l", "10mm"];
    name_of_a_gallery_model: ["solve", "drawer"];
    directory: ["solve", "models"];
    massless_bracket: ["solve", "models/bracket-on-pole.toml"];
    overlap_vanished: ["solve", DRAWER, "--at", "x=-0.5 m"];
    overlap_of_the_boom_vanished: ["solve", "models/telescopic-boom.toml", "--at", "s_2=70 cm"];
    rails_in_time: ["simulate", RAILS, "--until", "1 s"];
    at_rest: ["solve", KLEPP, "--rate", "q=0"];
    dead_centre: ["solve", "models/slider-crank.toml", "--at", "phi=0"];
    rod_too_short: ["solve", "models/slider-crank.toml", "--set", "l=45 mm", "--at", "phi=90 deg"];
    hold_unknown_load: ["hold", DRAWER, "--load", "pusch"];
    hold_load_of_nothing: ["hold", KLEPP, "--load", "damper"];
    hold_vary_without_load: ["hold", KLEPP, "--vary", "mu_1"];
    map_without_answer: ["map", "models/bracket-on-pole.toml", "--x", "x=0.1 m..0.5 m", "--y", "B=0.1 m..0.2 m", "--output", "map.svg", "--size", "8x8"];
    hold_vary_geometry: ["hold", DRAWER, "--load", "push", "--vary", "a"];
    size_unknown_parameter: ["size", DRAWER, "--vary", "l", "--margin", "2"];
    limits_of_nothing: ["limits", DRAWER];
    size_of_nothing: ["size", DRAWER, "--margin", "2"];
    map_of_nothing: ["map", DRAWER];
    sweep_of_nothing: ["sweep", DRAWER, "--set", "L=350 mm"];
    new_unknown_dimension: ["new", "drawer", "--length", "450mm"];
    empty_range_of_an_angle: ["drive", "models/toggle-press.toml", "--vary", "alpha=30 deg..30 deg"];
    open_standard_output: ["draw", DRAWER, "--open", "--output", "-"];
    size_empty_range: ["size", DRAWER, "--vary", "L=1 m..1 m", "--margin", "2"];
    size_coordinate_without_range: ["size", DRAWER, "--vary", "x", "--margin", "2"];
    size_without_load: ["size", KLEPP, "--vary", "mu_1", "--margin", "2", "--against", "self-locking"];
    size_with_idle_load: ["size", DRAWER, "--vary", "L", "--margin", "2", "--load", "push"];
    size_unknown_load: [
        "size", DRAWER, "--vary", "L", "--margin", "2", "--against", "self-locking", "--load", "pusch"
    ];
    size_at_rest_in_both_directions: [
        "size", DRAWER, "--vary", "L", "--margin", "2", "--against", "hold", "--load", "push", "--both-directions"
    ];
    size_pressure_without_a_pad: ["size", DRAWER, "--vary", "L", "--max-pressure", "2 MPa"];
    size_pressure_without_a_unit: ["size", DRAWER, "--vary", "L", "--max-pressure", "2"];
    size_margin_zero: ["size", DRAWER, "--vary", "L", "--margin", "0"];
    drive_without_drives: ["drive", "models/slider-crank.toml"];
    drive_unknown_parameter: ["drive", DRAWER, "--vary", "nu=0..1"];
    drive_rows_without_vary: ["drive", DRAWER, "--rows", "5"];
    drive_one_row: ["drive", DRAWER, "--vary", "mu", "--rows", "1"];
    limits_unknown_parameter: ["limits", DRAWER, "--vary", "lenght=0..1"];
    malformed_settings: ["solve", DRAWER, "--set", "mu", "--set", "=1", "--at", "x="];
    unknown_setting: ["solve", KLEPP, "--set", "mu1=0.2"];
    several_settings: [
        "solve", DRAWER, "--set", "nu=3", "--set", "m=3 m", "--set", "a=a+", "--at", "y=1", "--rate", "x=1 kg"
    ];
    negative_by_setting: ["solve", DRAWER, "--set", "mu=-0.1"];
    settings_in_a_circle: ["solve", DRAWER, "--set", "L=a", "--set", "a=2*L"];
    infinite_setting: ["solve", DRAWER, "--set", "mu=1e400"];
    setting_without_value: ["solve", DRAWER, "--set"];
    unknown_model_of_the_gallery: ["models", "telescpic-boom"];
    no_stages: ["models", "telescopic-boom", "--stages", "0"];
    too_many_stages: ["models", "telescopic-boom", "--stages", "1001"];
    stages_of_a_drawer: ["models", "drawer", "--stages", "2"];
    output_exists: ["models", "drawer", "--output", "Cargo.toml"];
    output_nowhere: ["models", "drawer", "--output", "nowhere/drawer.toml"];
    unknown_command: ["sovle", DRAWER];
}

#[test]
fn limits_of_what_makes_no_sense() {
    let vary = |vary: &str| {
        let run = slideway(&["limits", "models/klepp-2002.toml", "--vary", vary]);
        assert_eq!(run.code, 2, "{vary}");
        run.stderr
    };
    let all: Vec<String> = ["mu_4", "mu_1=0.3..0.3", "q", "mu_1=0.3"].map(vary).into();
    insta::assert_snapshot!(all.join("\n"));
}

#[test]
fn settings_and_model_together() {
    let run = slideway(&["solve", "crates/slideway-cli/tests/bad/zero-mass.toml", "--set", "mu"]);
    assert_eq!(run.code, 2);
    insta::assert_snapshot!(run.stderr);
}

#[test]
fn too_many_contacts_are_refused_at_once() {
    let boom = slideway(&["models", "telescopic-boom", "--stages", "300"]);
    let run = slideway_reading(&["solve", "-"], boom.stdout.as_bytes());
    assert_eq!(run.code, 2);
    insta::assert_snapshot!(run.stderr);
}

#[test]
fn too_many_bodies_are_refused_at_once() {
    use std::fmt::Write;
    let mut model = "[points]\nA = [0, 0]\n".to_owned();
    for body in 0..1001 {
        write!(
            model,
            "[bodies.b{body}]\npoints = [\"A\"]\nmassless = true\n\
             [joints.j{body}]\ntype = \"hinge\"\nbetween = [\"b{body}.A\", \"ground.A\"]\n"
        )
        .unwrap();
    }
    let run = slideway_reading(&["solve", "-"], model.as_bytes());
    assert_eq!(run.code, 2);
    insta::assert_snapshot!(run.stderr);
}

#[test]
fn a_huge_file_is_not_read_whole() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("huge.toml");
    // 8 GiB that take no space on the disk.
    std::fs::File::create(&path).unwrap().set_len(8 << 30).unwrap();
    let output = command(&["solve", "huge.toml"]).current_dir(directory.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!(String::from_utf8(output.stderr).unwrap());

    let run = slideway_reading(&["check", "-"], &vec![b' '; 5 << 20]);
    assert_eq!(run.code, 2);
    insta::assert_snapshot!(run.stderr);
}

#[test]
fn an_endless_file_is_not_read_whole() {
    if Path::new("/dev/zero").exists() {
        let run = slideway(&["solve", "/dev/zero"]);
        assert_eq!(run.code, 2);
        assert!(run.stderr.contains("larger than 4 MiB"), "{}", run.stderr);
    }
}

#[test]
fn colours_are_for_terminals_unless_forced() {
    let bad = "crates/slideway-cli/tests/bad/zero-mass.toml";
    let escape = '\u{1b}';
    assert!(!slideway(&["solve", bad]).stderr.contains(escape));
    assert!(slideway(&["solve", bad, "--color", "always"]).stderr.contains(escape));
    let forced = |arguments: &[&str]| {
        let output = command(arguments).env("CLICOLOR_FORCE", "1").output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    assert!(forced(&["solve", bad]).contains(escape));
    assert!(!forced(&["solve", bad, "--color", "never"]).contains(escape));
}

/// Bytes of the gallery's files deleted, inserted and replaced: never a panic, never NaN.
#[test]
fn mutated_files_never_panic() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let original = std::fs::read(top().join(DRAWER)).unwrap();
    for _ in 0..25 {
        let mut bytes = original.clone();
        for _ in 0..=random.below(4) {
            let at = random.below(bytes.len());
            match random.below(3) {
                0 => drop(bytes.remove(at)),
                1 => bytes.insert(at, random.byte()),
                _ => bytes[at] = random.byte(),
            }
        }
        let run = slideway_reading(&["solve", "-"], &bytes);
        assert!(run.code <= 3, "{}", run.stderr);
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        assert!(!run.stdout.contains("NaN"), "{}", run.stdout);
    }
}

/// Xorshift: a few pseudo-random numbers that are the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.next() % limit as u64).unwrap()
    }

    fn byte(&mut self) -> u8 {
        self.next().to_le_bytes()[0]
    }
}
