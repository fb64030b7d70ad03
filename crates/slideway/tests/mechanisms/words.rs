//! Contact modes in words: which face really touches, for guides of every direction.

use crate::answers::report_on;
use nalgebra::Vector2;
use rstest::rstest;
use slideway::mechanism::Slider;
use slideway::model::SliderKind;
use slideway::solve::mode_in_words;

fn words(kind: SliderKind, height: f64, angle: f64, signs: &[i8]) -> String {
    let (sin, cos) = angle.to_radians().sin_cos();
    let slider = Slider {
        round: None,
        apart: Vec::new(),
        sticks: false,
        kind,
        block: slideway::ids::Frame::Body(slideway::ids::BodyId(0)),
        guide: slideway::ids::Frame::Ground,
        z: 0.0,
        at: Vector2::zeros(),
        tangent: Vector2::x(),
        length: 1.0,
        height,
        around: height < 0.0,
        loose: false,
        travel: None,
        stops: [None; 2],
        contacts: Vec::new(),
    };
    mode_in_words(&slider, Vector2::new(cos, sin), signs)
}

#[rstest]
// Inside a horizontal guide, u to the right: N > 0 pushes the block up, so the lower guide touches.
#[case(0.0, &[1, 1], "flat on the lower guide")]
#[case(0.0, &[-1, -1], "flat on the upper guide")]
#[case(0.0, &[1, -1], "touching at lower right and upper left")]
#[case(0.0, &[-1, 1], "touching at upper right and lower left")]
#[case(0.0, &[1, 0], "on the lower right corner only")]
#[case(0.0, &[0, -1], "on the upper left corner only")]
#[case(0.0, &[0, 0], "no contact force")]
// u to the left: n points down, the front is on the left.
#[case(180.0, &[1, 1], "flat on the upper guide")]
#[case(180.0, &[-1, -1], "flat on the lower guide")]
#[case(180.0, &[1, -1], "touching at upper left and lower right")]
#[case(180.0, &[0, 1], "on the upper right corner only")]
// u upwards: n points to the left, N > 0 pushes the block to the left, so the right guide touches.
#[case(90.0, &[1, 1], "flat on the right guide")]
#[case(90.0, &[-1, -1], "flat on the left guide")]
#[case(90.0, &[1, -1], "touching at upper right and lower left")]
#[case(90.0, &[-1, 0], "on the upper left corner only")]
// u downwards: n points to the right.
#[case(-90.0, &[1, 1], "flat on the left guide")]
#[case(-90.0, &[1, -1], "touching at lower left and upper right")]
// Inclined guides are called by what they are nearer to.
#[case(30.0, &[1, 1], "flat on the lower guide")]
#[case(-30.0, &[1, -1], "touching at lower right and upper left")]
#[case(60.0, &[1, 1], "flat on the right guide")]
#[case(120.0, &[1, 1], "flat on the right guide")]
#[case(120.0, &[1, -1], "touching at upper right and lower left")]
#[case(150.0, &[1, 1], "flat on the upper guide")]
#[case(45.0, &[1, 1], "flat on the lower guide")]
#[case(-45.0, &[-1, -1], "flat on the upper guide")]
#[case(135.0, &[-1, -1], "flat on the lower guide")]
fn block_inside_its_guide(#[case] angle: f64, #[case] signs: &[i8], #[case] expected: &str) {
    for height in [0.0, 0.2] {
        assert_eq!(words(SliderKind::Block, height, angle, signs), expected);
    }
}

#[rstest]
// A sleeve pushed up by its rod sits on the rod's upper face.
#[case(0.0, &[1, 1], "flat on the upper face of the guide")]
#[case(0.0, &[-1, -1], "flat on the lower face of the guide")]
#[case(0.0, &[1, -1], "touching at upper right and lower left")]
#[case(180.0, &[1, 1], "flat on the lower face of the guide")]
#[case(90.0, &[1, 1], "flat on the left face of the guide")]
#[case(90.0, &[1, -1], "touching at upper left and lower right")]
#[case(-90.0, &[1, 1], "flat on the right face of the guide")]
#[case(90.0, &[0, 1], "on the lower left corner only")]
fn block_around_its_guide(#[case] angle: f64, #[case] signs: &[i8], #[case] expected: &str) {
    assert_eq!(words(SliderKind::Block, -0.2, angle, signs), expected);
}

#[rstest]
#[case(SliderKind::Guided, 0.0, 1, "flat on the lower guide")]
#[case(SliderKind::Guided, 90.0, -1, "flat on the left guide")]
#[case(SliderKind::Guided, 0.0, 0, "no contact force")]
#[case(SliderKind::Pin, 0.0, 1, "on the lower side of the slot")]
#[case(SliderKind::Pin, 180.0, 1, "on the upper side of the slot")]
#[case(SliderKind::Pin, 90.0, 1, "on the right side of the slot")]
#[case(SliderKind::Pin, 90.0, -1, "on the left side of the slot")]
#[case(SliderKind::Pin, 0.0, 0, "no contact force")]
fn sliders_with_one_contact(
    #[case] kind: SliderKind,
    #[case] angle: f64,
    #[case] sign: i8,
    #[case] expected: &str,
) {
    assert_eq!(words(kind, 0.0, angle, &[sign]), expected);
}

/// The place where a corner of a block touches: P - sign(N) (h/2) n at the end P of the block.
fn touching_place(angle: f64, height: f64, sign: i8, end: f64) -> Vector2<f64> {
    let (sin, cos) = angle.to_radians().sin_cos();
    let (tangent, normal) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
    0.5 * end * tangent - f64::from(sign) * height / 2.0 * normal
}

#[test]
fn corners_are_named_by_where_they_lie() {
    // Theory, section 1: friction acts at P - sign(N) (h/2) n. Each corner lies on the side that its words
    // say, seen along the guide for its end and across it for its face.
    for height in [0.1, -0.1] {
        for angle in (-180..180).step_by(5).filter(|angle| angle % 45 != 0 || angle % 90 == 0) {
            let angle = f64::from(angle);
            let vertical = angle.to_radians().sin().abs() > angle.to_radians().cos().abs();
            for (front, rear) in [(1, -1), (-1, 1)] {
                let text = words(SliderKind::Block, height, angle, &[front, rear]);
                let corners: Vec<&str> = text.strip_prefix("touching at ").unwrap().split(" and ").collect();
                for (corner, (sign, end)) in corners.iter().zip([(front, 1.0), (rear, -1.0)]) {
                    let place = touching_place(angle, height, sign, end);
                    let middle = touching_place(angle, 0.0, sign, end);
                    let across = place - middle;
                    // Along the guide one coordinate tells the end, across it the other tells the face.
                    let (end_place, face_place) =
                        if vertical { (middle.y, across.x) } else { (middle.x, across.y) };
                    let (low, high) = if vertical { ("lower", "upper") } else { ("left", "right") };
                    assert!(corner.contains(if end_place > 0.0 { high } else { low }), "{angle}: {text}");
                    let (low, high) = if vertical { ("left", "right") } else { ("lower", "upper") };
                    assert!(corner.contains(if face_place > 0.0 { high } else { low }), "{angle}: {text}");
                }
            }
        }
    }
}

#[rstest]
#[case("-9.81", "0", "0 deg", "flat on the lower guide")]
#[case("9.81", "0", "0 deg", "flat on the upper guide")]
#[case("-9.81", "0", "180 deg", "flat on the lower guide")]
#[case("0", "5", "90 deg", "flat on the right guide")]
#[case("0", "5", "-90 deg", "flat on the right guide")]
#[case("-9.81", "0", "40 deg", "flat on the lower guide")]
#[case("-9.81", "0", "200 deg", "flat on the lower guide")]
fn a_block_lies_on_the_side_to_which_it_is_pulled(
    #[case] down: &str,
    #[case] right: &str,
    #[case] along: &str,
    #[case] expected: &str,
) {
    for kind in ["block_slider", "guided_slider"] {
        let report = report_on(&format!(
            r#"
            gravity = [{right}, {down}]
            [bodies.sledge]
            mass = 1
            moment_of_inertia = 1
            centre_of_mass = [0, 0]
            [joints.track]
            type = "{kind}"
            block = "sledge"
            at = [0, 0]
            along = "{along}"
            length = 1
            height = 0.1
            mu = 0.2
            [coordinates.s]
            slide = "track"
            rate = 1
            "#
        ));
        assert_eq!(report.solutions[0].joints[0].mode, expected);
    }
}
