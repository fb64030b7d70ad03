//! What lies behind, in front of or on something else: hidden edges, shared ground, arrows on one line.

use crate::Case;
use slideway::mechanism::JointKind;
use slideway::model::Settings;
use slideway::{Drawing, GROUND};
use slideway_pictures::drawing::{
    Class, ContactStates, Point, Scene, SceneOptions, Shape, Shown, View, scene,
};

fn overview(case: &Case) -> (View, Scene) {
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let states = ContactStates::default();
    let scene = scene(&case.mechanism, &case.configuration, &states, &view, &SceneOptions::overview());
    (view, scene)
}

fn of_class(scene: &Scene, class: Class) -> Vec<&Shape> {
    scene.elements.iter().filter(|element| element.class == class).map(|element| &element.shape).collect()
}

/// The places of all lines of a class.
fn lines(scene: &Scene, class: Class) -> Vec<&Vec<Point>> {
    let lines = of_class(scene, class).into_iter().filter_map(|shape| match shape {
        Shape::Line(places) => Some(places),
        _ => None,
    });
    lines.collect()
}

/// The crank of the quick-return mechanism lies behind its slotted arm: its edges, half of a bar of 10 units beside the line
/// from the shaft O to the crank pin A, are dashed. Where bars only meet at a hinge, nothing is.
#[test]
fn what_lies_behind_a_body_is_dashed() {
    let case = Case::gallery("quick-return");
    let (view, scene) = overview(&case);
    let hinges: Vec<Point> = case
        .mechanism
        .joints
        .iter()
        .filter_map(|joint| match &joint.kind {
            JointKind::Hinge([end, _]) if matches!(&*joint.name, "O" | "A") => {
                Some(view.place(case.configuration.position(&case.mechanism, end)))
            }
            _ => None,
        })
        .collect();
    let along = (hinges[1] - hinges[0]).normalize();
    let edges = lines(&scene, Class::HiddenWall);
    assert!(!edges.is_empty());
    for place in edges.into_iter().flatten() {
        let aside = (place - hinges[0]).perp(&along).abs();
        assert!(aside < 5.0 + 1e-6, "{place} is {aside} beside the crank");
    }
    for name in ["four-bar", "toggle-press"] {
        let case = Case::gallery(name);
        assert!(lines(&overview(&case).1, Class::HiddenWall).is_empty(), "{name}");
    }
}

/// Two blocks on one rail: where their guides overlap, ground is hatched once, 7 units apart.
#[test]
fn ground_that_two_guides_share_is_hatched_once() {
    let mut d = Drawing::new();
    for (index, at) in [0.0, 0.13].into_iter().enumerate() {
        let block = d.body(&format!("block_{index}")).mass(1.0).centre([at, 0.0]).inertia(0.01).id();
        let rail = d.block_slider(&format!("rail_{index}"), block, GROUND);
        let rail = rail.at([at, 0.0]).length(0.1).height(0.04).mu(0.1).id();
        d.slide(&format!("x_{index}"), rail).rate(0.1);
    }
    let case = Case::new(&d.to_toml(), &Settings::default());
    let (_, scene) = overview(&case);
    let mut feet: Vec<[f64; 2]> =
        lines(&scene, Class::Hatch).iter().map(|line| [line[0].y, line[0].x]).collect();
    feet.sort_by(|one, other| one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1])));
    let all = feet.len();
    feet.dedup_by(|one, other| (one[0] - other[0]).abs() < 1e-6 && (one[1] - other[1]).abs() < 1e-6);
    assert!(feet.len() < all, "they overlap");
    for pair in feet.windows(2).filter(|pair| (pair[0][0] - pair[1][0]).abs() < 1e-6) {
        assert!(pair[1][1] - pair[0][1] > 7.0 - 1e-6, "{pair:?}");
    }
}

/// The push on the wedge and the reaction of the wall on the stem meet in one place from the same side: the push is drawn on
/// the other side, on its line.
#[test]
fn no_load_lies_on_a_reaction() {
    let case = Case::gallery("wedge");
    let sheet = case.sheet(Shown::Solution(1)).unwrap();
    let arrows = |class: Class| -> Vec<[Point; 2]> {
        let arrows = of_class(&sheet.scene, class).into_iter().filter_map(|shape| match shape {
            Shape::Arrow { from, to } => Some([*from, *to]),
            _ => None,
        });
        arrows.collect()
    };
    for [from, to] in arrows(Class::Load) {
        for other in arrows(Class::Reaction) {
            let along = (to - from).normalize();
            let beside = other.iter().any(|end| (end - from).perp(&along).abs() > 5.0);
            let [one, last] = other.map(|end| (end - from).dot(&along));
            let shared = one.max(last).min((to - from).norm()) - one.min(last).max(0.0);
            assert!(beside || shared < 1.0, "{from} {to} {other:?}");
        }
    }
}
