//! Pictures and pages as files: what is refused, with its message, and what is written.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway, top};

const DRAWER: &str = "models/drawer.toml";
const KLEPP: &str = "models/klepp-2002.toml";

macro_rules! refused {
    ($($name:ident: [$($argument:expr),* $(,)?];)*) => {$(
        #[test]
        fn $name() {
            let run = slideway(&[$($argument),*]);
            assert_eq!(run.code, 2);
            assert_eq!(run.stdout, "");
            assert!(["svg", "html"].iter().all(|ending| !top().join("never").with_extension(ending).exists()));
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(run.stderr);
            });
        }
    )*};
}

refused! {
    map_of_unknown_and_empty: ["map", KLEPP, "--x", "mu_9=0..0.8", "--y", "mu_2=1..1", "-o", "never.svg"];
    map_of_empty_and_no_range: ["map", KLEPP, "--x", "mu_1=0.5..0.5", "--y", "mu_2", "-o", "never.svg"];
    map_of_the_same_twice: ["map", KLEPP, "--x", "mu_1=0..0.8", "--y", "mu_1=0..1", "-o", "never.svg"];
    map_of_wrong_unit: ["map", KLEPP, "--x", "mu_1=0..0.8", "--y", "F_20=0 m..15 m", "-o", "never.svg"];
    map_without_size: [
        "map", KLEPP, "--x", "mu_1=0..0.8", "--y", "mu_2=0..1", "--size", "0x5", "-o", "never.svg"
    ];
    map_of_unknown_ending: ["map", KLEPP, "--x", "mu_1=0..0.8", "--y", "mu_2=0..1", "-o", "never.gif"];
    map_of_unknown_colours: [
        "map", KLEPP, "--x", "mu_1=0..0.8", "--y", "mu_2=0..1", "--colour-by", "mode", "-o", "never.svg"
    ];
    plot_of_unknown_ending: ["limits", KLEPP, "--vary", "mu_1=0..0.8", "--plot", "never.jpg"];
    plot_of_unknown_name: ["limits", KLEPP, "--vary", "mu1=0..0.8", "--plot", "never.svg"];
    plot_of_effort_without_drive: [
        "limits", KLEPP, "--vary", "mu_1=0..0.8", "--quantity", "effort", "--plot", "never.svg"
    ];
    quantity_without_plot: ["limits", DRAWER, "--vary", "mu=0..1", "--quantity", "effort"];
    drawing_of_unknown_ending: ["draw", KLEPP, "-o", "never.pdf"];
    drawing_of_a_solution_too_many: ["draw", KLEPP, "--solution", "9", "-o", "never.svg"];
    drawing_of_no_number: ["draw", KLEPP, "--solution", "two", "-o", "never.svg"];
    drawing_of_unknown_parameter: ["draw", KLEPP, "--set", "mu1=3", "-o", "never.svg"];
    drawing_over_its_model: ["draw", KLEPP, "-o", KLEPP, "--force"];
    page_of_unknown_ending: ["report", KLEPP, "-o", "never.pdf"];
    page_of_unknown_name: ["report", KLEPP, "--vary", "mu1=0..1", "-o", "never.html"];
}

/// A file that exists stays as it is unless it is to be overwritten, and no temporary file is left.
#[test]
fn files_are_not_overwritten() {
    let directory = tempfile::tempdir().unwrap();
    let model = directory.path().join("drawer.toml");
    std::fs::write(&model, slideway::gallery::find("drawer").unwrap().text).unwrap();
    let runs: [(&str, &[&str]); 4] = [
        ("map.svg", &["map", "drawer.toml", "--x", "mu=0..1", "--y", "L=0.2..0.5", "--size", "20x20", "-o"]),
        ("limits.svg", &["limits", "drawer.toml", "--vary", "mu=0..1", "--plot"]),
        ("drawing.svg", &["draw", "drawer.toml", "-o"]),
        ("page.html", &["report", "drawer.toml", "-o"]),
    ];
    for (file, arguments) in runs {
        let path = directory.path().join(file);
        std::fs::write(&path, "mine").unwrap();
        let run = |more: &[&str]| {
            command(&[arguments, &[file], more].concat()).current_dir(directory.path()).output().unwrap()
        };
        let refused = run(&[]);
        assert_eq!(refused.status.code(), Some(2), "{file}");
        let message = String::from_utf8(refused.stderr).unwrap();
        assert!(
            message.contains(&format!("`{file}` already exists")) && message.contains("--force"),
            "{message}"
        );
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
        assert_eq!(run(&["--force"]).status.code(), Some(0), "{file}");
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.trim_end().ends_with("</svg>") || text.trim_end().ends_with("</html>"), "{file}");
        assert!(!text.contains("NaN"), "{file}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 5, "no temporary file is left");
}

/// The ending says the format: eight bytes begin every PNG file (PNG specification, 5.2).
#[test]
fn endings_choose_the_format() {
    let directory = tempfile::tempdir().unwrap();
    let model = top().join(DRAWER);
    let model = model.to_str().unwrap();
    let write = |arguments: &[&str], file: &str| {
        let output = command(&[arguments, &[file]].concat()).current_dir(directory.path()).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read(directory.path().join(file)).unwrap()
    };
    let map = ["map", model, "--x", "mu=0..1", "--y", "L=0.2..0.5", "--size", "20x20", "-o"];
    assert!(write(&map, "map.png").starts_with(b"\x89PNG\r\n\x1a\n"));
    let json: serde_json::Value = serde_json::from_slice(&write(&map, "map.json")).unwrap();
    assert!(json["schema"].as_str().unwrap().starts_with("slideway/map/"));
    assert!(
        write(&["limits", model, "--vary", "mu=0..1", "--plot"], "a.PNG").starts_with(b"\x89PNG\r\n\x1a\n")
    );
    assert!(write(&["draw", model, "-o"], "a.svg").starts_with(b"<svg "));
}

/// A drawing without forces in motion says what there is to say at rest.
#[test]
fn a_drawing_about_rest_is_headed_by_whether_it_holds() {
    let run = slideway(&["draw", "models/bracket-on-pole.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("At rest: ") && run.stdout.contains("mu_static = 0.25"), "{}", run.stdout);
}
