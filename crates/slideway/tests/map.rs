//! Maps: against dense grids, against certified solutions, and against boundaries in closed form.

use slideway::fault::{FaultKind, Faults};
use slideway::gallery;
use slideway::limits::Vary;
use slideway::map::{ClassMeaning, ColourBy, MapOptions, MapReport, map, map_with};
use slideway::model::{Model, Settings};
use slideway::report::SpeedChange;
use slideway::solve::solve;
use std::ops::ControlFlow;

fn model(name: &str, settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(gallery::find(name).expect("in the gallery").text)
        .and_then(|model| model.with(&settings))
        .expect("a sound model")
}

fn options(x: &str, y: &str, [width, height]: [usize; 2], colour_by: ColourBy) -> MapOptions {
    MapOptions::new(x.parse().expect("a range"), y.parse().expect("a range"))
        .colour_by(colour_by)
        .size(width, height)
}

fn mapped(model: &Model, options: &MapOptions) -> MapReport {
    map(model, options).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The value in the middle of a pixel.
fn middle(range: [f64; 2], pixel: usize, pixels: usize) -> f64 {
    range[0] + (pixel as f64 + 0.5) / pixels as f64 * (range[1] - range[0])
}

/// With the preload, margins over mu_1 and mu_2 have a sliver narrower than a pixel, of whose pixels some
/// touch at corners only.
#[test]
fn refined_maps_are_those_of_dense_grids() {
    let klepp = model("klepp-2002", &[]);
    let crank = model("slider-crank", &[]);
    let planes = [
        (&klepp, "mu_1=0..0.8", "mu_2=0..0.4", [96, 80]),
        (&klepp, "mu_1=0..0.8", "F_20=0..15", [64, 52]),
        (&klepp, "mu_1=0..0.8", "alpha=60 deg..88 deg", [64, 52]),
        (&crank, "phi=-175 deg..175 deg", "mu=0..1.5", [64, 52]),
    ];
    for (model, x, y, size) in planes {
        for colour_by in [ColourBy::Solutions, ColourBy::Modes, ColourBy::Margin, ColourBy::Jam] {
            let refined = mapped(model, &options(x, y, size, colour_by));
            let dense = mapped(model, &options(x, y, size, colour_by).probe(1));
            assert_eq!(dense.points, size[0] * size[1]);
            assert!(refined.points < dense.points, "{x} {y} {colour_by:?}: {} points", refined.points);
            assert_eq!(refined.classes, dense.classes, "{x} {y} {colour_by:?}");
            assert_eq!(refined.rows, dense.rows, "{x} {y} {colour_by:?}");
        }
    }
}

#[test]
fn classes_are_the_numbers_of_certified_solutions() {
    let klepp = model("klepp-2002", &[]);
    let (size, ranges) = ([13, 11], [[0.0, 0.8], [0.0, 15.0]]);
    let options = options("mu_1=0..0.8", "F_20=0 N..15 N", size, ColourBy::Solutions);
    let report = mapped(&klepp, &options.probe(1));
    for j in 0..size[1] {
        for i in 0..size[0] {
            let [x, y] = [middle(ranges[0], i, size[0]), middle(ranges[1], j, size[1])];
            let settings =
                Settings::default().parameter("mu_1", x.to_string()).parameter("F_20", y.to_string());
            let answer = solve(&klepp.with(&settings).expect("sound")).expect("solvable");
            let meaning = &report.classes[report.class_at(i, j)].meaning;
            let expected = ClassMeaning::Solutions {
                solutions: answer.solutions.len(),
                preload_gap_states: answer.preload_gap_states.len(),
                tipping: 0,
            };
            assert_eq!(*meaning, expected, "mu_1 = {x}, F_20 = {y}");
        }
    }
}

/// Thirty contacts: 2^30 patterns, which nobody tries one by one.
#[test]
fn maps_of_many_contacts_have_the_numbers_of_certified_solutions() {
    let boom = Model::parse(&gallery::telescopic_boom(15).expect("a number of stages")).expect("sound");
    let size = [3, 3];
    let options = options("mu=0.05..1.5", "overlap=0.3 m..0.9 m", size, ColourBy::Solutions);
    let report = mapped(&boom, &options.probe(1));
    for (i, j) in (0..size[0]).flat_map(|i| (0..size[1]).map(move |j| (i, j))) {
        let [x, y] = [middle([0.05, 1.5], i, size[0]), middle([0.3, 0.9], j, size[1])];
        let settings = Settings::default().parameter("mu", x.to_string()).parameter("overlap", y.to_string());
        let answer = solve(&boom.with(&settings).expect("sound")).expect("solvable");
        let expected = match answer.solutions.len() {
            0 => ClassMeaning::Locked,
            solutions => ClassMeaning::Solutions { solutions, preload_gap_states: 0, tipping: 0 },
        };
        assert_eq!(report.classes[report.class_at(i, j)].meaning, expected, "mu = {x}, overlap = {y}");
    }
}

/// Klepp (2002), section 7: without preload and moving to the right there are two solutions beyond mu_1 =
/// 0.45265396, numerically 2 cot(alpha) + 0.1, for mu_2 = mu_3 = 0.1.
#[test]
fn the_boundary_is_the_locking_value_to_the_pixel() {
    let klepp = model("klepp-2002", &[("F_20", "0")]);
    let pixels = 400;
    // The middle of row 50 is mu_2 = 0.1.
    let report =
        mapped(&klepp, &options("mu_1=0..0.8", "mu_2=0.05..0.15", [pixels, 101], ColourBy::Solutions));
    let locking = 2.0 / 80.0_f64.to_radians().tan() + 0.1;
    assert!((locking - 0.452_653_96).abs() < 5e-9);
    for column in 0..pixels {
        let solutions = if middle([0.0, 0.8], column, pixels) < locking { 1 } else { 2 };
        let expected = ClassMeaning::Solutions { solutions, preload_gap_states: 0, tipping: 0 };
        assert_eq!(report.classes[report.class_at(column, 50)].meaning, expected, "column {column}");
    }
}

/// docs/src/limits.md: N (L - 2 mu a) = Q a, so that the drawer locks at mu = L / (2 a). If all friction
/// grows by a factor it does so at L / (2 a mu).
#[test]
fn a_drawer_locks_where_its_guide_is_too_short() {
    let drawer = model("drawer", &[]);
    let (size, ranges) = ([83, 67], [[0.0, 1.0], [0.2, 0.5]]);
    let locked = |report: &MapReport, i, j| report.classes[report.class_at(i, j)].meaning.clone();
    let (x, y) = ("mu=0..1", "L=200 mm..500 mm");
    let number = mapped(&drawer, &options(x, y, size, ColourBy::Solutions));
    let margin = mapped(&drawer, &options(x, y, size, ColourBy::Margin));
    assert_eq!((&*number.y.unit, number.y.scale), ("mm", 1e-3));
    for j in 0..size[1] {
        for i in 0..size[0] {
            let [mu, length] = [middle(ranges[0], i, size[0]), middle(ranges[1], j, size[1])];
            let factor = length / (2.0 * 0.3 * mu);
            let one = ClassMeaning::Solutions { solutions: 1, preload_gap_states: 0, tipping: 0 };
            assert_eq!(locked(&number, i, j), if factor > 1.0 { one } else { ClassMeaning::Locked });
            match locked(&margin, i, j) {
                ClassMeaning::Locked => assert!(factor <= 1.0, "mu = {mu}, L = {length}"),
                ClassMeaning::Margin { from, to } => {
                    assert!(
                        from <= factor && factor < to.unwrap_or(f64::INFINITY),
                        "mu = {mu}, L = {length}"
                    );
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

/// The rod of the slider-crank (crank 50 mm) reaches the line of the piston where r sin(phi) < l. Up to 90
/// degrees the way from the drawing at 60 degrees, along which the mechanism is led, is then open, too.
#[test]
fn points_that_cannot_be_assembled_have_a_class() {
    let crank = model("slider-crank", &[]);
    let options = options("phi=20 deg..90 deg", "l=45 mm..90 mm", [60, 60], ColourBy::Solutions);
    let report = mapped(&crank, &options);
    let words: Vec<&str> = report.classes.iter().map(|class| &*class.words).collect();
    assert!(words.contains(&"cannot be assembled"), "{words:?}");
    for j in 0..60 {
        for i in 0..60 {
            let phi = middle([20.0, 90.0], i, 60).to_radians();
            let (length, reach) = (middle([0.045, 0.09], j, 60), 0.05 * phi.sin());
            let is_refused = words[report.class_at(i, j)] == "cannot be assembled";
            assert_eq!(is_refused, length < reach, "phi = {phi}, l = {length}");
        }
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let klepp = model("klepp-2002", &[]);
    let options = options("mu_1=0..0.8", "alpha=60 deg..88 deg", [101, 67], ColourBy::Modes);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| mapped(&klepp, &options))
    };
    let one = with(1);
    assert!(one.classes.len() > 3);
    assert_eq!(one, with(3));
}

#[test]
fn nonsense_is_refused() {
    let klepp = model("klepp-2002", &[]);
    let faults = |x: &str, y: &str| -> Faults {
        let options = x.parse().and_then(|x| Ok(MapOptions::new(x, y.parse()?)));
        options.and_then(|options| map(&klepp, &options)).expect_err("refused")
    };
    let kind = |x: &str, y: &str| faults(x, y).sorted()[0].kind.clone();
    assert!(matches!(kind("mu_1=0..0.8", "mu_1=0..1"), FaultKind::SameAxes { .. }));
    assert!(matches!(kind("mu_1=0.5..0.5", "mu_2=0..1"), FaultKind::EmptyRange { .. }));
    assert!(matches!(kind("mu_1", "mu_2=0..1"), FaultKind::RangeNeeded { .. }));
    let text = gallery::find("klepp-2002")
        .expect("in the gallery")
        .text
        .replace("[parameters]", "[parameters]\nidle = 1");
    let idle = map(
        &Model::parse(&text).expect("sound"),
        &MapOptions::new(Vary::between("mu_1", 0.0, 1.0), Vary::between("idle", 0.0, 1.0)),
    );
    let refused = idle.expect_err("refused").sorted()[0].kind.clone();
    assert!(matches!(refused, FaultKind::NothingVaries { .. }), "{refused:?}");
    let unknown = kind("mu_9=0..1", "mu_2=0..1");
    assert!(matches!(unknown, FaultKind::UnknownName { nearest: Some(_), .. }), "{unknown:?}");
    // Both axes are judged at once.
    assert_eq!(faults("mu_9=0..1", "mu_2=1..1").sorted().len(), 2);
}

/// A column of pixels of one class: once all are solved, rows are looked through for boundaries and then
/// told, and before each of them the callback is asked.
#[test]
fn rows_that_are_told_can_be_the_last() {
    let drawer = model("drawer", &[]);
    let height = 2000;
    let options = options("mu=0.1..0.2", "Q=1 N..2 N", [1, height], ColourBy::Solutions);
    let mut asked = Vec::new();
    let report = map_with(&drawer, &options, &mut |progress| {
        asked.push(progress.done);
        ControlFlow::Continue(())
    });
    let report = report.expect("a sound model").expect("nothing breaks");
    assert_eq!((report.classes.len(), report.rows.len()), (1, height));
    let after = asked.iter().rev().take_while(|done| **done == report.points as u64).count();
    assert!(after >= 2 * height, "{after} times");
    let mut left = asked.len() - height / 2;
    let ended = map_with(&drawer, &options, &mut |_| {
        left -= 1;
        if left > 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert!(matches!(ended, Ok(None)), "{ended:?}");
}

/// Nothing presses this guided slider, so that N = 0. Its preload rubs on both faces, and C = M + F h/2 (2
/// lambda - 1) = 0 has a share from 0 to 1 where |M| < F h/2: there it is between its faces, whichever way it
/// moves, and elsewhere it tips.
#[test]
fn a_guided_slider_is_between_its_faces_where_its_preload_balances_the_moment() {
    let guided = Model::parse(include_str!("findings/guided_gap.toml")).expect("sound");
    let moves = |moves: bool, tips: bool| ClassMeaning::Moves {
        as_in_model: moves,
        opposite: moves,
        tips_as_in_model: tips,
        tips_opposite: tips,
    };
    let number = ClassMeaning::Solutions { solutions: 0, preload_gap_states: 1, tipping: 0 };
    let classes = [
        (ColourBy::Solutions, number.clone(), ClassMeaning::Tips),
        (ColourBy::Modes, ClassMeaning::Modes { patterns: vec!["0".to_owned()] }, ClassMeaning::Tips),
        (ColourBy::Margin, number, ClassMeaning::Tips),
        (ColourBy::Jam, moves(true, false), moves(false, true)),
    ];
    let size = [9, 7];
    // The mode problem is bilinear in moment and preload, but not in the height.
    for (y, range, is_interpolated) in [("F", [0.0, 12.0], true), ("h", [0.02, 0.3], false)] {
        for (colour_by, between, tipping) in &classes {
            let y_axis = format!("{y}={}..{}", range[0], range[1]);
            let report = mapped(&guided, &options("M=-1..1", &y_axis, size, *colour_by).probe(1));
            assert_eq!(report.guarantee.contains("interpolated"), is_interpolated);
            let mut pixels = [0, 0];
            for (i, j) in (0..size[0]).flat_map(|i| (0..size[1]).map(move |j| (i, j))) {
                let [moment, other] = [middle([-1.0, 1.0], i, size[0]), middle(range, j, size[1])];
                let greatest = if y == "F" { other * 0.2 / 2.0 } else { 6.0 * other / 2.0 };
                let is_between = moment.abs() < greatest;
                let expected = if is_between { between } else { tipping };
                assert_eq!(
                    report.classes[report.class_at(i, j)].meaning,
                    *expected,
                    "M = {moment}, {y_axis}"
                );
                pixels[usize::from(is_between)] += 1;
            }
            let told: Vec<usize> = [tipping, between]
                .iter()
                .map(|meaning| report.classes.iter().find(|class| class.meaning == **meaning))
                .map(|class| class.expect("both occur").pixels)
                .collect();
            assert_eq!(told, pixels);
        }
    }
}

/// Two blocks in guided sliders along x, one on the other, with packings; `V` presses the lower one down, `M`
/// turns the upper one, which only `W` presses: `N_2 = W`.
const PACKED: &str = r#"
    [parameters]
    V = "40 N"
    W = 0
    M = "0.3 N m"
    F = "6 N"
    mu = 0
    [bodies.lower]
    mass = 2
    centre_of_mass = [0, 0]
    moment_of_inertia = 0.1
    points = ["S"]
    [bodies.upper]
    points = ["T"]
    mass = 1
    centre_of_mass = [0, 0]
    moment_of_inertia = 0.1
    [points]
    S = [0, 0]
    T = [0, 0]
    [joints.one]
    type = "guided_slider"
    block = "lower"
    at = [0, 0]
    along = 0
    length = 0.05
    height = 0.1
    mu = "mu"
    [joints.two]
    type = "guided_slider"
    block = "upper"
    guide = "lower"
    at = [0, 0]
    along = 0
    length = 0.3
    height = 0.2
    mu = 0.3
    preload = "F"
    [loads.V]
    type = "force"
    at = "lower.S"
    components = [5, "-V"]
    [loads.W]
    type = "force"
    at = "upper.T"
    components = [0, "-W"]
    [loads.M]
    type = "torque"
    body = "upper"
    moment = "M"
    [coordinates]
    x = { slide = "one", rate = 1 }
    y = { slide = "two", rate = 1 }
"#;

/// The lower slider has N_1 = V and, as no couple comes from the upper one but M, C_1 = M plus the moment of
/// its own friction; it stands where |C_1| <= V L/2. Without friction of its own the upper one is between its
/// faces where |M| < F 0.2 m/2 besides.
#[test]
fn states_between_faces_beside_pressed_sliders_are_those_of_solve() {
    let packed = Model::parse(PACKED).expect("sound");
    let mut between = 0;
    for (x, [from, to]) in
        [("M", [-1.0, 1.0]), ("mu", [0.0, 0.8]), ("friction", [0.0, 2.0]), ("W", [-40.0, 40.0])]
    {
        let (size, pressing) = ([7, 6], [-60.0, 50.0]);
        let axes = [format!("{x}={from}..{to}"), format!("V={}..{}", pressing[0], pressing[1])];
        let options = options(&axes[0], &axes[1], size, ColourBy::Modes);
        let report = mapped(&packed, &options.probe(1));
        for (i, j) in (0..size[0]).flat_map(|i| (0..size[1]).map(move |j| (i, j))) {
            let [value, force] = [middle([from, to], i, size[0]), middle(pressing, j, size[1])];
            let mut settings = Settings::default().parameter("V", format!("{force:e}"));
            // The lower one has no friction, and nothing presses the upper one: a factor changes nothing.
            if x != "friction" {
                settings = settings.parameter(x, format!("{value:e}"));
            }
            let answer = solve(&packed.with(&settings).expect("sound")).expect("solvable");
            let states = answer.solutions.iter().chain(&answer.preload_gap_states);
            let patterns: Vec<String> = states.map(|state| state.pattern.clone()).collect();
            let told = &report.classes[report.class_at(i, j)].meaning;
            if patterns.is_empty() {
                let tips = answer.tipping().is_some();
                let expected = if tips { ClassMeaning::Tips } else { ClassMeaning::Locked };
                assert_eq!(*told, expected, "{x} = {value}, V = {force}");
            } else {
                assert_eq!(*told, ClassMeaning::Modes { patterns }, "{x} = {value}, V = {force}");
            }
            if x == "W" {
                // The middle of the fourth pixel of seven.
                let is_between = patterns_told(told).iter().any(|pattern| pattern.ends_with('0'));
                assert!(!is_between || value == 0.0, "W = {value}, V = {force}");
                between += usize::from(is_between);
            }
            if x == "M" {
                // N_1 is positive where it carries the load.
                let stands = value.abs() < (force.abs() * 0.05 / 2.0).min(6.0 * 0.2 / 2.0);
                let has_none = [ClassMeaning::Locked, ClassMeaning::Tips].contains(told);
                assert_eq!(!has_none, stands, "M = {value}, V = {force}");
            }
        }
    }
    assert!(between > 1, "{between} points with W = 0");
}

fn patterns_told(meaning: &ClassMeaning) -> &[String] {
    if let ClassMeaning::Modes { patterns } = meaning { patterns } else { &[] }
}

/// The bracket holds where x >= B / (2 mu_static) with B = 152.4 mm.
#[test]
fn a_map_of_rest_is_that_of_its_closed_form() {
    let bracket = model("bracket-on-pole", &[]);
    let size = [40, 30];
    let report = mapped(&bracket, &options("mu_static=0.2..0.6", "x=0.1..0.5", size, ColourBy::Hold));
    for (row, column) in (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column))) {
        let mu = middle([0.2, 0.6], column, size[0]);
        let x = middle([0.1, 0.5], row, size[1]);
        let class = &report.classes[report.class_at(column, row)];
        assert_eq!(
            class.meaning,
            ClassMeaning::Rest { holds: Some(x >= 0.1524 / (2.0 * mu)), may_slip: false },
            "{mu} {x}"
        );
    }
}

/// The bracket has no inertia: as long as it slides nothing can be said, which is said once, with the reason.
#[test]
fn a_map_without_any_answer_is_refused_with_the_reason() {
    let bracket = model("bracket-on-pole", &[]);
    let faults = map(&bracket, &options("B=0.1..0.2", "x=0.1..0.5", [8, 8], ColourBy::Solutions));
    let faults = faults.expect_err("nothing can be solved");
    let FaultKind::NoAnswerOnMap { reason } = &faults.sorted()[0].kind else { panic!("{faults}") };
    assert!(!reason.is_empty());
}

/// A block of 1 kg pushed by P along a floor: m a = P - mu m g, and with a tolerance of a pixel nothing else.
#[test]
fn a_map_of_motion_has_the_classes_of_the_acceleration() {
    let text = r#"
        gravity = 10
        [parameters]
        P = 4
        mu = 0.3
        [points]
        M = [0, 0]
        [bodies.block]
        points = ["M"]
        mass = 1
        centre_of_mass = "M"
        moment_of_inertia = 0.1
        [joints.floor]
        type = "block_slider"
        block = "block"
        at = "M"
        along = 0
        length = 0.4
        mu = "mu"
        [loads.push]
        type = "force"
        at = "block.M"
        components = ["P", 0]
        [coordinates.s]
        slide = "floor"
        rate = 1
    "#;
    let block = Model::parse(text).expect("sound");
    let report = mapped(&block, &options("mu=0..1", "P=0..10", [16, 12], ColourBy::Motion));
    for (row, column) in (0..12).flat_map(|row| (0..16).map(move |column| (row, column))) {
        let (mu, push) = (middle([0.0, 1.0], column, 16), middle([0.0, 10.0], row, 12));
        let change = if push > 10.0 * mu { SpeedChange::SpeedsUp } else { SpeedChange::SlowsDown };
        let expected = ClassMeaning::Motion { solutions: vec![vec![change]], tipping: 0 };
        assert_eq!(report.classes[report.class_at(column, row)].meaning, expected, "{mu} {push}");
    }
    let words: Vec<&str> = report.classes.iter().map(|class| &*class.words).collect();
    assert_eq!(words, ["one solution: speeds up", "one solution: slows down"]);
}

/// The push of the drawer is P = Q/(1 - 2 mu a/L), in closed form; it jams where that is negative.
#[test]
fn a_map_of_efforts_has_the_classes_of_the_closed_form() {
    let drawer = model("drawer", &[]);
    let size = [60, 40];
    let report = mapped(&drawer, &options("mu=0..1", "Q=1 N..30 N", size, ColourBy::Effort));
    for (row, column) in (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column))) {
        let (mu, load) = (middle([0.0, 1.0], column, size[0]), middle([1.0, 30.0], row, size[1]));
        let push = load / (1.0 - 2.0 * mu * 0.3 / 0.4);
        match &report.classes[report.class_at(column, row)].meaning {
            ClassMeaning::Effort { from, to } => {
                // What is on a bound within rounding is above it.
                let is_within =
                    from.is_none_or(|from| from * (1.0 - 1e-9) <= push) && to.is_none_or(|to| push < to);
                assert!(push > 0.0 && is_within, "{mu} {load}: {push} from {from:?} to {to:?}");
            }
            other => assert!(push < 0.0 && *other == ClassMeaning::Locked, "{mu} {load}: {push} {other:?}"),
        }
    }
    let pixels = report.classes.iter().filter(|class| class.meaning != ClassMeaning::Locked);
    let shares: Vec<f64> = pixels.map(|class| class.pixels as f64 / (size[0] * size[1]) as f64).collect();
    assert_eq!(shares.len(), 7, "{:?}", report.classes);
    // A seventh of two thirds, as far as round bounds allow.
    assert!(shares.iter().all(|share| (0.03..0.2).contains(share)), "{shares:?}");
    assert!(
        report.classes.iter().any(|class| class.words == "push needs 25 to 40 N"),
        "{:?}",
        report.classes
    );
}

#[test]
fn efforts_of_a_model_without_drives_are_refused() {
    let klepp = model("klepp-2002", &[]);
    let faults = map(&klepp, &options("mu_1=0..1", "mu_2=0..1", [8, 8], ColourBy::Effort));
    let faults = faults.expect_err("nothing drives it");
    assert!(matches!(faults.sorted()[0].kind, FaultKind::NoDrives { .. }), "{faults}");
}

/// At mu = L/(2 a) = 2/3 the determinant is zero but for rounding, whatever the resistance and the speed; `limits`
/// says "not decided" there, and so does the map.
#[test]
fn a_verge_is_undecided_and_not_locked() {
    let drawer = model("drawer", &[("mu", "2/3")]);
    for colour_by in [ColourBy::Solutions, ColourBy::Modes, ColourBy::Margin, ColourBy::Effort] {
        let report = mapped(&drawer, &options("Q=1 N..30 N", "m=1 kg..2 kg", [8, 8], colour_by));
        let meanings: Vec<&ClassMeaning> = report.classes.iter().map(|class| &class.meaning).collect();
        assert_eq!(meanings, [&ClassMeaning::Undecided], "{colour_by:?}");
    }
}
