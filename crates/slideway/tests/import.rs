//! Models from DXF drawings. The drawing `import/plate.dxf` is made by hand after the DXF Reference of
//! Autodesk; what it holds is repeated where it is expected.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use nalgebra::Vector2;
use proptest::prelude::*;
use slideway::Model;
use slideway::fault::CommandLine;
use slideway::import::{ImportFault, ImportOptions, Unit, dxf, dxf_with};
use slideway::mechanism::Mechanism;
use slideway::model::outline::polygon;
use slideway::printable;
use slideway::progress::Progress;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Coordinates have the decimals of the greatest one, which has nine digits: with some 200 mm they are right to
/// 5e-10 m, and distances to this.
const ROUNDED: f64 = 1e-9;

const PLATE: &str = include_str!("import/plate.dxf");

fn imported(drawing: &str) -> String {
    dxf(drawing, &ImportOptions::default()).unwrap()
}

/// The mechanism of an imported model, each body on a guide of its own.
fn mechanism(text: &str) -> Mechanism {
    let mut model = text.to_owned();
    for head in text.lines().filter_map(|line| line.strip_prefix("[bodies.")) {
        let body = head.split(']').next().unwrap();
        let _ = writeln!(model, "\n[joints.guide_{body}]\ntype = \"guided_slider\"\nblock = \"{body}\"");
        model += "at = [0, 0]\nalong = 0\nlength = 1\nmu = 0\n";
    }
    Mechanism::new(&Model::parse(&model).unwrap()).unwrap()
}

fn outline(mechanism: &Mechanism, body: &str) -> Vec<Vector2<f64>> {
    polygon(&mechanism.bodies.iter().find(|other| &*other.name == body).unwrap().outline)
}

/// Whether an outline has these corners (m), wherever it begins and whichever way it goes.
fn has_corners(outline: &[Vector2<f64>], corners: &[[f64; 2]]) -> bool {
    let is_there =
        |[x, y]: &[f64; 2]| outline.iter().any(|corner| (corner - Vector2::new(*x, *y)).norm() < 1e-12);
    outline.len() == corners.len() && corners.iter().all(is_there)
}

fn area(outline: &[Vector2<f64>]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    0.5 * outline.iter().zip(next).map(|(from, to)| from.perp(to)).sum::<f64>().abs()
}

/// Lines in any order and direction make the rectangle of 40 mm by 60 mm, whose radius of gyration is
/// (40^2 + 60^2)/12 mm^2.
#[test]
fn lines_that_join_are_an_outline() {
    let text = imported(PLATE);
    let plate = outline(&mechanism(&text), "plate_2");
    assert!(has_corners(&plate, &[[-0.02, -0.03], [0.02, -0.03], [0.02, 0.03], [-0.02, 0.03]]), "{plate:?}");
    assert!(text.contains("# moment_of_inertia = \"(1 kg)*(433.333333 mm^2)\""), "{text}");
    assert!(text.contains("# centre_of_mass = [\"0 mm\", \"0 mm\"]"), "{text}");
}

/// A bar of 100 mm by 20 mm with round ends, of bulge 1, a half circle: on one with radius 10 mm all corners
/// lie, and pieces of 10 degrees leave out r^2/2 (10 deg - sin 10 deg) each of its area.
#[test]
fn bulges_are_arcs() {
    let arm = outline(&mechanism(&imported(PLATE)), "arm");
    assert_eq!(arm.len(), 2 + 2 * 18);
    for corner in &arm {
        let nearest = Vector2::new(corner.x.clamp(0.0, 0.1), 0.0);
        assert!(((corner - nearest).norm() - 0.01).abs() < ROUNDED, "{corner}");
    }
    let piece = TAU / 36.0;
    let wanted = 0.1 * 0.02 + 36.0 * 0.5 * 1e-4 * piece.sin();
    assert!((area(&arm) - wanted).abs() < ROUNDED, "{} {wanted}", area(&arm));
}

/// A polyline of vertices, from (200, 5) down to (200, -5), and an arc from 270 to 90 degrees make half a
/// disc.
#[test]
fn arcs_and_polylines_join() {
    let half = outline(&mechanism(&imported(PLATE)), "half");
    assert_eq!(half.len(), 19);
    assert!(half.iter().all(|corner| ((corner - Vector2::new(0.2, 0.0)).norm() - 0.005).abs() < ROUNDED));
    assert!(half.iter().all(|corner| corner.x >= 0.2 - 1e-12));
}

/// With the extrusion direction (0, 0, -1) the x axis of the entity is -x (arbitrary axis algorithm of the
/// reference). A layer of one circle is a disc.
#[test]
fn planes_seen_from_behind_and_discs() {
    let mechanism = mechanism(&imported(PLATE));
    let behind = outline(&mechanism, "seen_from_behind");
    assert!(has_corners(&behind, &[[-0.01, 0.0], [-0.02, 0.0], [-0.02, 0.007]]), "{behind:?}");
    let disc = outline(&mechanism, "disc");
    assert_eq!(disc.len(), 36);
    assert!(disc.iter().all(|corner| ((corner - Vector2::new(-0.1, 0.05)).norm() - 0.03).abs() < ROUNDED));
}

/// Circles of two layers in one place are one point of both, which suggests a hinge; texts beside them are
/// names, the second by its place of alignment; the rest is named after its body.
#[test]
fn points_have_names_and_owners() {
    let text = imported(PLATE);
    for line in [
        "main_pivot = [\"0 mm\", \"0 mm\"]   # arm, plate_2",
        "tip = [\"100 mm\", \"0 mm\"]   # arm",
        "ground_1 = [\"0 mm\", \"-30 mm\"]   # ground",
        "disc_1 = [\"-100 mm\", \"50 mm\"]   # disc",
        "points = [\"main_pivot\", \"tip\"]",
        "# between = [\"arm.main_pivot\", \"plate_2.main_pivot\"]",
    ] {
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
}

#[test]
fn what_is_left_out_is_said() {
    let text = imported(PLATE);
    for line in [
        "# - 1 SPLINE without control points that fit its knots of the layer arm",
        "# - 1 LINE on a sheet (paper space) of the layer plate 2",
        "# - 1 further lines of the layer plate 2: open, or smaller than its outline",
    ] {
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
}

/// A drawing of these blocks and entities, in mm.
fn with_blocks(blocks: &str, entities: &str) -> String {
    let pairs = format!(
        "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC \
         0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF "
    );
    pairs.replace(' ', "\n")
}

/// The rectangle from (1, 0) to (4, 1) of a block with the base point (1, 0), and a circle about (2, 1) of radius 0.5.
const BLOCK: &str = "0 BLOCK 2 part 10 1 20 0 0 LWPOLYLINE 8 0 70 1 10 1 20 0 10 4 20 0 10 4 20 1 10 1 20 1 \
                     0 CIRCLE 8 0 10 2 20 1 40 0.5 0 ENDBLK";

/// A block of a quarter of an ellipse and a quarter of a circle as a spline, and what inserts it within stretched rows.
const CURVES: &str = "0 BLOCK 2 curves 10 0 20 0 0 ELLIPSE 8 0 10 0 20 0 11 2 21 0 40 0.5 41 0 42 1.570796326794897 \
                      0 SPLINE 8 0 70 8 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.7071067811865476 41 1 \
                      10 2 20 0 10 2 20 -1 10 0 20 -1 0 INSERT 2 part 8 0 10 1 20 1 42 3 0 ENDBLK";
const INSERTED: &str = "0 INSERT 2 curves 8 cam 10 10 20 20 41 2 42 1 50 30 70 2 71 2 44 5 45 7 0 INSERT 2 part 8 ground \
                        10 3 20 4 41 -1";

/// Scaled by 2 and turned by 90 degrees, (x, y) becomes (10, 20) + 2 (-y, x - 1); mirrored by the extrusion direction
/// (0, 0, -1), x changes its sign. A block within a block is scaled and turned twice.
#[test]
fn blocks_are_inserted() {
    let turned = "0 INSERT 2 PART 8 lever 10 10 20 20 41 2 42 2 50 90";
    let lever = mechanism(&imported(&with_blocks(BLOCK, turned)));
    let corners = [[0.010, 0.020], [0.010, 0.026], [0.008, 0.026], [0.008, 0.020]];
    assert!(has_corners(&outline(&lever, "lever"), &corners), "{:?}", outline(&lever, "lever"));
    assert!(
        (lever.bodies[0].points[0].1 - Vector2::new(0.008, 0.022)).norm() < 1e-12,
        "the centre of the circle"
    );

    let mirrored = mechanism(&imported(&with_blocks(BLOCK, &format!("{turned} 210 0 220 0 230 -1"))));
    let seen_from_behind = corners.map(|[x, y]| [-x, y]);
    assert!(has_corners(&outline(&mirrored, "lever"), &seen_from_behind));

    let nested = format!("{BLOCK} 0 BLOCK 2 outer 10 0 20 0 {turned} 0 ENDBLK");
    let nested = mechanism(&imported(&with_blocks(&nested, "0 INSERT 2 outer 8 0 10 0 20 0 50 -90")));
    let back = corners.map(|[x, y]| [y, -x]);
    assert!(has_corners(&outline(&nested, "lever"), &back), "{:?}", outline(&nested, "lever"));
}

/// A circle of radius 2 mm scaled by 3 and 1 is an ellipse; the square of its radius of gyration is
/// (a^2 + b^2)/4 = 10 mm^2; rows and columns are inserted each.
#[test]
fn blocks_are_stretched_and_repeated() {
    let disc = "0 BLOCK 2 disc 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 2 0 ENDBLK";
    let text = imported(&with_blocks(disc, "0 INSERT 2 disc 8 oval 10 5 20 0 41 3 42 1"));
    let oval = outline(&mechanism(&text), "oval");
    // Its outline keeps within 1e-4 of its size, 12.6 mm, 6.3e-4 of its smaller half axis; second moments go with its
    // third power and once with the other.
    let radius = text.split("(1 kg)*(").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    assert!((radius.parse::<f64>().unwrap() / 10.0 - 1.0).abs() < 4.0 * 6.3e-4, "{radius}");
    for corner in &oval {
        let at = corner * 1e3 - Vector2::new(5.0, 0.0);
        assert!(((at.x / 6.0).powi(2) + (at.y / 2.0).powi(2) - 1.0).abs() < 2e-3, "{at}");
    }
    let text = imported(&with_blocks(BLOCK, "0 INSERT 2 part 8 row 10 0 20 0 70 3 71 2 44 10 45 -5"));
    let points: Vec<&str> = text.lines().filter(|line| line.starts_with("row_")).collect();
    assert_eq!(points.len(), 6, "{text}");
    for point in ["[\"1 mm\", \"1 mm\"]", "[\"21 mm\", \"-4 mm\"]"] {
        assert!(points.iter().any(|line| line.contains(point)), "{point} {points:?}");
    }
}

/// A block that inserts itself, or one that is not there, is left out and named; so many that nothing would be left of
/// the memory are an error.
#[test]
fn blocks_without_end_are_refused() {
    let circular = format!(
        "{BLOCK} 0 BLOCK 2 ring 10 0 20 0 0 INSERT 2 ring 8 0 10 0 20 0 0 POINT 8 0 10 1 20 0 0 ENDBLK"
    );
    let text =
        imported(&with_blocks(&circular, "0 INSERT 2 ring 8 a 10 0 20 0 0 INSERT 2 other 8 a 10 0 20 0"));
    for block in ["ring", "other"] {
        let line = format!(
            "# - 1 INSERT of {block}, which is no block of the drawing, or within itself of the layer a"
        );
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
    let doubled = |index: usize| {
        let insert = format!("0 INSERT 2 b{} 8 0 10 1 20 0", index + 1);
        format!(" 0 BLOCK 2 b{index} 10 0 20 0 {insert} {insert} 0 ENDBLK")
    };
    let bomb: String = (0..40).map(doubled).collect();
    let bomb = format!("0 BLOCK 2 b40 10 0 20 0 0 POINT 8 0 10 0 20 0 0 ENDBLK{bomb}");
    let fault =
        dxf(&with_blocks(&bomb, "0 INSERT 2 b0 8 a 10 0 20 0"), &ImportOptions::default()).unwrap_err();
    assert!(matches!(fault, ImportFault::TooManyEntities { .. }), "{fault}");
}

/// The unit is the one of the drawing unless another one is said; one that is not said is not guessed.
#[test]
fn units_are_those_of_the_drawing() {
    let inches = PLATE.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n1\n");
    assert_ne!(inches, PLATE);
    let plate = outline(&mechanism(&imported(&inches)), "plate_2");
    assert!(has_corners(&plate, &[[-0.508, -0.762], [0.508, -0.762], [0.508, 0.762], [-0.508, 0.762]]));
    let unitless = PLATE.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n0\n");
    assert_eq!(dxf(&unitless, &ImportOptions::default()), Err(ImportFault::NoUnit));
    let hint = ImportFault::NoUnit.hint_for(&CommandLine);
    assert_eq!(hint.as_deref(), Some("say it, for instance with `--unit mm`"));
    let metres = ImportOptions { unit: Some(Unit::Metre), ..ImportOptions::default() };
    assert_eq!(dxf(&unitless, &metres), dxf(PLATE, &metres));
    let yards = PLATE.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n10\n");
    assert_eq!(dxf(&yards, &ImportOptions::default()), Err(ImportFault::UnknownUnit { code: 10 }));
}

#[test]
fn faults_say_what_is_wrong_and_where() {
    let told = |text: &str| dxf(text, &ImportOptions::default()).unwrap_err().to_string();
    assert!(told("AutoCAD Binary DXF\r\n").contains("text (ASCII) DXF"));
    assert!(told("title = \"a model\"\n").starts_with("line 1 should be a group code"));
    assert!(told(&PLATE.replace("EOF\n", "")).contains("not complete"));
    assert!(told("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n").contains("no section ENTITIES"));
    // The radius of the first circle, and its place.
    let radius = PLATE.replacen(" 40\n4\n", " 40\n1e999\n", 1);
    let line = PLATE[..PLATE.find(" 40\n4\n").unwrap()].lines().count() + 2;
    assert_eq!(
        told(&radius),
        format!("line {line}: group 40 of CIRCLE should be a finite number, not `1e999`")
    );
    let without = PLATE.replacen(" 40\n4\n", "", 1);
    assert!(told(&without).contains("CIRCLE has no group 40"));
    let empty = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nHATCH\n8\nx\n0\nENDSEC\n0\nEOF\n";
    assert!(told(empty).contains("1 HATCH of the layer x"));
}

/// Names of layers and texts are text from outside.
#[test]
fn names_are_made_valid_and_stay_apart() {
    let odd = PLATE.replace("plate 2", "arm\u{1b}]0;").replace("tip", "pi").replace("disc", "ground!");
    let text = imported(&odd);
    mechanism(&text);
    assert!(!text.contains('\u{1b}'));
    for name in ["[bodies.arm]", "[bodies.arm__0_]", "[bodies.ground_]"] {
        assert!(text.lines().any(|line| line.starts_with(name)), "{name}\n{text}");
    }
    assert!(text.contains("\npoint_pi = "), "{text}");
}

/// Keys of TOML are bare only if they are ASCII (TOML 1.0, Keys). Fillers of Hangul are letters that nobody sees.
#[test]
fn names_of_any_letters_are_read() {
    let foreign =
        PLATE.replace("plate 2", "Träger").replace("tip", "точка").replace("disc", "e\u{3164}\u{115f}x");
    let text = imported(&foreign);
    for line in
        ["[bodies.\"Träger\"]   # layer Träger", "\"точка\" = ", "[bodies.e__x]   # layer e\\u3164\\u115fx"]
    {
        assert!(text.lines().any(|other| other.starts_with(line)), "{line}\n{text}");
    }
    only_joints_are_missing(&text);
}

fn only_joints_are_missing(text: &str) {
    let faults = Model::parse(text).unwrap_err().to_string();
    assert!(faults.contains("`joints` is missing") && faults.lines().count() < 4, "{faults}\n{text}");
}

/// A block with a point and a text in 30,000 rows, and 8,000 circles of one layer: this took minutes where each was
/// compared with every other. A callback may end it.
#[test]
fn many_points_take_time_in_proportion() {
    let begun = Instant::now();
    let marked = "0 BLOCK 2 mark 10 0 20 0 0 POINT 8 0 10 0 20 0 0 TEXT 8 0 1 p 10 0 20 0 40 0.1 0 ENDBLK";
    let rows = with_blocks(marked, "0 INSERT 2 mark 8 rack 10 0 20 0 71 30000 45 1");
    let text = imported(&rows);
    assert_eq!(text.matches("# rack\n").count(), 30_000);
    assert!(text.contains("p_30000 = [\"0 mm\", \""));
    let circle = |index: i32| format!(" 0 CIRCLE 8 plate 10 {} 20 {} 40 0.1", index % 90, index / 90);
    let circles: String = (0..8000).map(circle).collect();
    assert_eq!(imported(&with_blocks(BLOCK, circles.trim())).matches("   # plate\n").count(), 8000);
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());

    let mut calls = 0;
    let mut end = |_: &Progress| {
        calls += 1;
        if calls < 20 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    assert_eq!(dxf_with(&rows, &ImportOptions::default(), &mut end), Ok(None));
}

/// The example of the book is what the program makes of its drawing, completed.
#[test]
fn the_example_of_the_book_is_the_drawing_completed() {
    let drawn = imported(include_str!("../../../docs/src/examples/bracket.dxf"));
    let completed = include_str!("../../../docs/src/examples/bracket.toml");
    let completed = Mechanism::new(&Model::parse(completed).unwrap()).unwrap();
    let drawn = outline(&mechanism(&drawn), "bracket");
    assert_eq!(outline(&completed, "bracket"), drawn);
    // The plate of the sleeve, 50 mm by 152.4 mm, the taper from 50 mm to 24 mm over 279.8 mm, and the round
    // end of 18 pieces.
    let end = 18.0 * 0.5 * 0.012 * 0.012 * (TAU / 36.0).sin();
    let wanted = 0.05 * 0.1524 + 0.2798 * 0.5 * (0.05 + 0.024) + end;
    assert!((area(&drawn) - wanted).abs() < ROUNDED, "{} {wanted}", area(&drawn));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// A damaged drawing is refused, or is a model whose numbers are all finite: only joints are missing.
    #[test]
    fn damaged_drawings_are_refused_or_read(
        has_blocks in any::<bool>(),
        damages in prop::collection::vec((0..400_usize, prop::option::of(prop::sample::select(vec![
            "", "0", "-1", "1", "8", "10", "20", "42", "70", "1e300", "-1e-300", "1e999", "nan", "x", "LINE", "ARC",
            "CIRCLE", "VERTEX", "SEQEND", "ENDSEC", "EOF", "\u{1b}[31m", "pi", "ground",
        ]))), 1..4),
    ) {
        let inserted = with_blocks(&format!("{BLOCK} {CURVES}"), INSERTED);
        let drawing = if has_blocks { &inserted } else { PLATE };
        let mut lines: Vec<&str> = drawing.lines().collect();
        for (line, value) in damages {
            let line = line % lines.len();
            match value {
                Some(value) => lines[line] = value,
                None => drop(lines.remove(line)),
            }
        }
        let escape = '\u{1b}';
        match dxf(&lines.join("\n"), &ImportOptions { unit: Some(Unit::Millimetre), ..ImportOptions::default() }) {
            Err(fault) => prop_assert!(!fault.to_string().contains(escape)),
            Ok(text) => {
                prop_assert!(!text.contains(escape) && !text.contains("NaN") && !text.contains("inf"), "{text}");
                only_joints_are_missing(&text);
            }
        }
    }

    /// Whatever layers and texts are called, the model is read, and shows no character that nobody sees.
    #[test]
    fn any_names_are_read(layer in any::<String>(), text in any::<String>()) {
        let kept = |text: &str| text.replace(['\n', '\r'], " ");
        let drawing = PLATE.replace("plate 2", &kept(&layer)).replace("tip", &kept(&text));
        let model = imported(&drawing);
        only_joints_are_missing(&model);
        prop_assert!(printable::lines(&model) == model, "{model}");
    }
}
