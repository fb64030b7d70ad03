//! Drawings of guides that share a load: each with its own play, misalignment and deflections, magnified alike.

use crate::Case;
use slideway::model::Settings;
use slideway::report::Solution;
use slideway_pictures::drawing::{
    Class, ContactStates, Point, Scene, SceneOptions, Shape, Shown, View, scene,
};

/// A plate on two rails, one above the other, pulled at its upper edge.
const RAILS: &str = r#"
[parameters]
upper_play = "0.2 mm"
lower_play = "0.6 mm"
toe = "0 mm"
k = "5e4 N/m"
[points]
handle = ["-0.2 m", "0.25 m"]
middle = [0, 0]
[bodies.plate]
mass = 8
centre_of_mass = "middle"
points = ["handle", "middle"]
moment_of_inertia = "1 kg m^2"
[joints.upper]
type = "block_slider"
block = "plate"
at = [0, "0.3 m"]
along = 0
length = "400 mm"
height = "40 mm"
mu = 0.3
play = "upper_play"
stiffness = "k"
rear = { misalignment = "toe" }
[joints.lower]
type = "block_slider"
block = "plate"
at = [0, "-0.3 m"]
along = 0
length = "400 mm"
height = "40 mm"
mu = 0.3
play = "lower_play"
stiffness = "k"
rear = { misalignment = "-toe" }
[loads.resistance]
type = "force"
components = ["-10 N", 0]
at = "plate.middle"
[coordinates.s]
slide = "upper"
rate = 0.3
[drives.pull]
coordinate = "s"
force = { at = "plate.handle", direction = 0 }
"#;

/// A drawing of the only solution, with what it was made of.
struct Drawn {
    view: View,
    scene: Scene,
    solution: Solution,
}

impl Drawn {
    fn new(text: &str, settings: &[(&str, &str)]) -> Self {
        let settings =
            settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, *value));
        let case = Case::new(text, &settings);
        let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
        let [solution] = &case.report.as_ref().unwrap().solutions[..] else { panic!("one solution") };
        let states = ContactStates::of(solution);
        let options = SceneOptions::contact_mode(1.0);
        let scene = scene(&case.mechanism, &case.configuration, &states, &view, &options);
        Self { view, scene, solution: solution.clone() }
    }

    /// Drawing units for a metre of play, misalignment or deflection.
    fn magnified(&self) -> f64 {
        self.view.scale * self.scene.magnification.unwrap()
    }

    /// The walls of ground, from above to below: the four faces of two rails.
    fn walls(&self) -> Vec<Vec<Point>> {
        let mut walls: Vec<Vec<Point>> = of_class(&self.scene, Class::Wall)
            .filter_map(|shape| if let Shape::Line(places) = shape { Some(places.clone()) } else { None })
            .collect();
        for wall in &mut walls {
            wall.sort_by(|one, other| one.x.total_cmp(&other.x));
        }
        walls.sort_by(|one, other| one[0].y.total_cmp(&other[0].y));
        walls
    }

    /// The corners of the blocks, each from its lower left one on, with the highest block first.
    fn blocks(&self) -> Vec<Vec<Point>> {
        let mut blocks: Vec<Vec<Point>> = of_class(&self.scene, Class::Body)
            .filter_map(|shape| if let Shape::Area(corners) = shape { Some(corners.clone()) } else { None })
            .filter(|corners| corners.len() == 4)
            .collect();
        let height = |block: &Vec<Point>| block.iter().map(|corner| corner.y).sum::<f64>();
        blocks.sort_by(|one, other| height(one).total_cmp(&height(other)));
        blocks
    }

    fn words(&self, wanted: &str) -> usize {
        self.scene.texts().filter(|(_, text)| text.text == wanted).count()
    }
}

fn of_class(scene: &Scene, class: Class) -> impl Iterator<Item = &Shape> {
    scene.elements.iter().filter(move |element| element.class == class).map(|element| &element.shape)
}

/// Where a wall is at an abscissa.
fn height_at(wall: &[Point], x: f64) -> f64 {
    let piece = wall.windows(2).find(|piece| x <= piece[1].x).unwrap_or(&wall[wall.len() - 2..]);
    piece[0].y + (piece[1].y - piece[0].y) * (x - piece[0].x) / (piece[1].x - piece[0].x)
}

/// The distance of the walls of a rail is the height of its block and its play, magnified, where nothing presses.
#[test]
fn a_looser_rail_is_drawn_looser() {
    let drawn = Drawn::new(RAILS, &[]);
    let walls = drawn.walls();
    assert_eq!(walls.len(), 4);
    let height = 0.04 * drawn.view.scale;
    for (rail, play) in walls.chunks(2).zip([0.2e-3, 0.6e-3]) {
        let distance = rail[1][0].y - rail[0][0].y;
        assert!((distance - height - play * drawn.magnified()).abs() < 1e-9, "{distance} {play}");
    }
    assert!(!drawn.scene.is_exaggerated);
}

/// The upper rail has less play and carries; the lower one is open. Corners that press lie on walls, which give
/// way there, and the others lie off both, by what the deflections leave of the play.
#[test]
fn pressed_corners_touch_walls_and_open_ones_do_not() {
    let drawn = Drawn::new(RAILS, &[]);
    assert_eq!(drawn.solution.pattern, "+-00");
    assert_eq!(drawn.words("open"), 2);
    let (walls, blocks) = (drawn.walls(), drawn.blocks());
    assert_eq!(blocks.len(), 2);
    let plays = [0.2e-3, 0.2e-3, 0.6e-3, 0.6e-3];
    for (index, contact) in drawn.solution.contacts.iter().enumerate() {
        let (block, rail) = (&blocks[index / 2], &walls[2 * (index / 2)..]);
        let is_front = index % 2 == 0;
        let middle = block.iter().map(|corner| corner.x).sum::<f64>() / 4.0;
        let mut end: Vec<&Point> = block.iter().filter(|corner| (corner.x > middle) == is_front).collect();
        end.sort_by(|one, other| one.y.total_cmp(&other.y));
        let above = end[0].y - height_at(&rail[0], end[0].x);
        let below = height_at(&rail[1], end[1].x) - end[1].y;
        let deflection = contact.deflection.unwrap() * drawn.magnified();
        let half = 0.5 * plays[index] * drawn.magnified();
        // What is left of the play above and below the corner; a face that is pressed beyond it gives way.
        let expected = [half - deflection, half + deflection].map(|left| left.max(0.0));
        for (found, expected) in [above, below].into_iter().zip(expected) {
            // The rotation that is drawn is not small: its square counts.
            assert!((found - expected).abs() < 0.5, "{}: {found} {expected}", contact.name);
        }
        let is_open = contact.normal_force == 0.0;
        assert_eq!(above.min(below) > 1.0, is_open, "{}: {above} {below}", contact.name);
    }
}

/// Rails that come nearer to each other towards the rear by `toe` each do so in the drawing.
#[test]
fn converging_rails_converge() {
    let drawn = Drawn::new(RAILS, &[("toe", "-0.5 mm")]);
    let walls = drawn.walls();
    // The outermost faces at their ends, beyond what the blocks press.
    let apart = |x: f64| height_at(&walls[3], x) - height_at(&walls[0], x);
    let (rear, front) = (walls[0][0].x, walls[0].last().unwrap().x);
    let slope = (apart(front) - apart(rear)) / (front - rear);
    let expected = 2.0 * 0.5e-3 * drawn.magnified() / (0.4 * drawn.view.scale);
    // The contacts come nearer to each other by the square of the rotation that is drawn.
    assert!((slope - expected).abs() < 1e-3 * expected, "{slope} {expected}");
}

/// With neither play nor misalignment only ratios of stiffnesses count: there are no deflections to be drawn.
#[test]
fn without_play_the_drawing_exaggerates_one() {
    let drawn = Drawn::new(RAILS, &[("upper_play", "0 mm"), ("lower_play", "0 mm"), ("k", "1 N/m")]);
    assert!(drawn.scene.magnification.is_some(), "stiffnesses are given");
    let text = RAILS.replace("stiffness = \"k\"\n", "").replace("k = \"5e4 N/m\"\n", "");
    let drawn = Drawn::new(&text, &[("upper_play", "0 mm"), ("lower_play", "0 mm")]);
    assert!(drawn.scene.magnification.is_none() && drawn.scene.is_exaggerated);
    assert_eq!(drawn.words("open"), 0);
}

/// A block with a further support has pads at all three contacts, on either face; its length is that between its
/// ends.
#[test]
fn all_pads_of_a_block_are_drawn() {
    let upper = RAILS.split("[joints.lower]").next().unwrap();
    let rest = &RAILS[RAILS.find("[loads.resistance]").unwrap()..];
    let text = format!("{upper}supports = {{ between = {{ at = \"50 mm\", play = \"0.1 mm\" }} }}\n{rest}")
        .replace("stiffness = \"k\"\n", "");
    let case = Case::new(&text, &Settings::default());
    let sheet = |shown| case.sheet(shown).unwrap();
    for shown in [Shown::Mechanism, Shown::Solution(1)] {
        assert_eq!(of_class(&sheet(shown).scene, Class::Pad).count(), 6);
    }
    let overview = sheet(Shown::Mechanism);
    let lines: Vec<&Vec<Point>> = of_class(&overview.scene, Class::Dimension)
        .filter_map(|shape| if let Shape::Line(places) = shape { Some(places) } else { None })
        .collect();
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let is_length = |line: &&&Vec<Point>| {
        ((line[1] - line[0]).norm() - 0.4 * view.scale).abs() < 1e-9 && (line[1].y - line[0].y).abs() < 1e-9
    };
    let length = lines.iter().find(is_length).expect("the dimension of 400 mm");
    let pads: Vec<Point> = of_class(&overview.scene, Class::Pad)
        .filter_map(|shape| if let Shape::Area(corners) = shape { Some(corners.clone()) } else { None })
        .flatten()
        .collect();
    for end in *length {
        assert!(pads.iter().any(|corner| (corner.x - end.x).abs() < 1e-9), "a pad at either end");
    }
    let solved = sheet(Shown::Solution(1));
    assert!(solved.description.contains("times as large as they are"), "{}", solved.description);
}

/// What a page says of shared loads: how they are shared, that a contact is open, and how far each is displaced, in
/// the unit of the model.
#[test]
fn pages_tell_how_a_load_is_shared() {
    let model = slideway::model::Model::parse(RAILS).unwrap();
    let report = slideway::solve::solve(&model).unwrap();
    let parts = slideway_pictures::page::solve_parts(&report);
    assert!(
        parts[0].contains("Redundant guides: upper.front, lower.front share a load, and so do"),
        "{}",
        parts[0]
    );
    assert!(parts[0].contains("by the stiffness, play and misalignment of each"), "{}", parts[0]);
    let [_, solution] = &parts[..] else { panic!("one solution") };
    assert!(solution.contains("Deflection in mm") && solution.contains("lower: open"), "{solution}");
    let deflection = report.solutions[0].contacts[0].deflection.unwrap();
    // At constant speed the pull overcomes the load and the friction at both ends of the upper rail.
    let pull = report.solutions[0].drives[0].effort;
    assert!((pull - 10.0 - 2.0 * 0.3 * report.solutions[0].contacts[0].normal_force).abs() < 1e-9);
    // Half the play, and what the face gives.
    let expected = -(0.1e-3 + report.solutions[0].contacts[0].normal_force / 5e4);
    assert!((deflection - expected).abs() < 1e-12, "{deflection} {expected}");
    let shown = format!("\u{2212}{:.4}", -1e3 * expected);
    assert!(solution.contains(&shown), "{shown}: {solution}");
    let single = slideway::gallery::find("drawer").unwrap().text;
    let report = slideway::solve::solve(&slideway::model::Model::parse(single).unwrap()).unwrap();
    let parts = slideway_pictures::page::solve_parts(&report);
    assert!(parts.iter().all(|part| !part.contains("Deflection") && !part.contains("Redundant")));
}
