//! Sweeps against `solve` point by point, and what must not depend on how they are computed.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use rstest::rstest;
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::report::{SolveReport, Status, Verdict};
use slideway::solve::solve;
use slideway::sweep::{Breakpoint, PointStatus, RowKind, Rows, Sampling, Spread, Sweep, SweepOptions};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

fn model(name: &str) -> Model {
    Model::parse(gallery::find(name).unwrap().text).unwrap()
}

fn with(name: &str, parameters: &[(&str, &str)]) -> Model {
    let settings =
        parameters.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    model(name).with(&settings).unwrap()
}

fn grid(axes: &[&str]) -> SweepOptions {
    SweepOptions::grid(axes.iter().map(|axis| axis.parse().unwrap()))
}

fn samples(sampling: Sampling, axes: &[&str]) -> SweepOptions {
    SweepOptions::samples(sampling, axes.iter().map(|axis| axis.parse().unwrap()))
}

/// All rows of a sweep.
fn rows(sweep: &Sweep) -> Vec<Rows> {
    let mut all = Vec::new();
    let mut state = sweep.start();
    sweep.run(&mut state, &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    assert_eq!(state.done, sweep.points());
    all
}

/// A number of a row by the name of its column.
fn number(sweep: &Sweep, rows: &Rows, row: usize, name: &str) -> f64 {
    let column = sweep.columns().iter().position(|column| column.name == name);
    rows.numbers(row)[column.unwrap_or_else(|| panic!("no column {name}"))]
}

fn close(one: f64, other: f64, scale: f64) -> bool {
    (one - other).abs() <= 1e-9 * scale.max(1e-12)
}

/// Settings of a point from the names and values of a row.
fn settings_of(sweep: &Sweep, varied: usize, values: &[f64], model: &Model) -> Settings {
    let names = sweep.columns()[..varied].iter().zip(values);
    names.fold(Settings::default(), |settings, (column, value)| {
        let text = format!("{value:e}");
        if let Some(coordinate) = column.name.strip_suffix(".rate") {
            settings.rate(coordinate, &text)
        } else if model.coordinates.iter().any(|coordinate| *coordinate.name == *column.name) {
            settings.position(&column.name, &text)
        } else {
            settings.parameter(&column.name, &text)
        }
    })
}

/// Where the search decides less than each mode by itself, rows tell of corners of continua and of what is
/// undecided: behind the states, with what `solve` says of them.
fn check_without_state(rows: &Rows, found: &[usize], report: &SolveReport) {
    let corners = report.continua.iter().flat_map(|continuum| {
        let corners: Vec<Option<&[f64]>> = match &continuum.vertices[..] {
            [] => vec![None],
            corners => corners.iter().map(|corner| Some(&corner[..])).collect(),
        };
        let kind = if continuum.rests { RowKind::RestRange } else { RowKind::Continuum };
        corners.into_iter().map(move |corner| (kind, continuum.pattern.as_bytes(), corner))
    });
    let undecided = report.undecided_modes.iter();
    let undecided = undecided.map(|mode| (RowKind::Undecided, mode.pattern.as_bytes(), None));
    let expected: Vec<_> = corners.chain(undecided).collect();
    assert_eq!(found.len(), expected.len());
    for (&row, (kind, pattern, corner)) in found.iter().zip(expected) {
        assert_eq!((rows.heads[row].kind, rows.pattern(row)), (kind, pattern));
        let numbers = &rows.numbers(row)[rows.varied..];
        let known = corner.map_or(0, <[f64]>::len);
        assert_eq!(&numbers[..known], corner.unwrap_or_default());
        assert!(numbers[known..].iter().all(|number| number.is_nan()));
    }
}

fn check_point(sweep: &Sweep, rows: &Rows, range: std::ops::Range<usize>, report: &SolveReport) {
    let head = &rows.heads[range.start];
    let status = match report.status {
        Status::None => PointStatus::None,
        Status::One => PointStatus::One,
        Status::Several => PointStatus::Several,
        Status::Continuum => PointStatus::Continuum,
        Status::PreloadGap => PointStatus::PreloadGap,
        Status::Unknown => PointStatus::Unknown,
    };
    assert_eq!(head.status, status);
    assert_eq!(head.solutions.to_string(), report.count);
    assert_eq!(head.gap_states.to_string(), report.gap_state_count);
    assert_eq!(head.rejected as usize, report.rejected.len());
    let states: Vec<_> = report.solutions.iter().chain(&report.preload_gap_states).collect();
    let of = |kinds: &[RowKind]| {
        range.clone().filter(|&row| kinds.contains(&rows.heads[row].kind)).collect::<Vec<usize>>()
    };
    let found = of(&[RowKind::Solution, RowKind::Boundary, RowKind::PreloadGap, RowKind::Rest]);
    assert_eq!(found.len(), states.len());
    check_without_state(rows, &of(&[RowKind::Continuum, RowKind::RestRange, RowKind::Undecided]), report);
    for (row, state) in found.into_iter().zip(states) {
        assert_eq!(rows.pattern(row), state.pattern.as_bytes());
        let forces = state.contacts.iter().map(|contact| contact.normal_force.abs());
        let scale = forces.fold(0.0, f64::max);
        for contact in &state.contacts {
            let named = |what: &str| number(sweep, rows, row, &format!("{what}.{}", contact.name));
            assert!(close(named("normal_force"), contact.normal_force, scale), "{}", contact.name);
            assert!(close(named("friction_force"), contact.friction_force, scale), "{}", contact.name);
            if let Some(share) = contact.preload_share {
                assert!(close(named("preload_share"), share, 1.0));
            }
        }
        let accelerations = state.bodies.iter().flat_map(|body| body.acceleration).map(f64::abs);
        let angular = state.bodies.iter().map(|body| body.angular_acceleration.abs());
        let scale = accelerations.chain(angular).fold(0.0, f64::max);
        for coordinate in &state.coordinates {
            let found = number(sweep, rows, row, &format!("acceleration.{}", coordinate.name));
            assert!(close(found, coordinate.acceleration, scale), "{}", coordinate.name);
        }
        for body in &state.bodies {
            let found = number(sweep, rows, row, &format!("angular_acceleration.{}", body.name));
            assert!(close(found, body.angular_acceleration, scale), "{}", body.name);
        }
        for drive in &state.drives {
            let found = number(sweep, rows, row, &format!("effort.{}", drive.name));
            assert!(close(found, drive.effort, drive.effort.abs()), "{}", drive.name);
        }
        for hinge in &state.hinges {
            let scale = hinge.force[0].hypot(hinge.force[1]);
            let found = number(sweep, rows, row, &format!("hinge_force_y.{}", hinge.name));
            assert!(close(found, hinge.force[1], scale), "{}", hinge.name);
            if let Some(friction) = hinge.friction {
                let found = number(sweep, rows, row, &format!("friction_couple.{}", hinge.name));
                assert!(close(found, friction.couple, scale * friction.radius), "{}", hinge.name);
            }
        }
    }
}

/// Friction alone, positions and rates, and geometry, at random points: each is what `solve` says there.
#[rstest]
#[case("klepp-2002", &["mu_1=0..1", "mu_2=0..0.3", "F_20=-0 N..20 N"])]
#[case("klepp-2002", &["F_30=0 N..9 N", "F_10=0 N..9 N", "mu_1=0..0.6"])]
#[case("klepp-2002", &["q=-0.3..0.3", "alpha=50 deg..85 deg", "mu_1=0..1"])]
#[case("cam-follower", &["mu=0..1", "phi=0 deg..60 deg"])]
#[case("drawer", &["mu=0..0.9"])]
#[case("drawer", &["x=-0.05..0.05", "L=0.2..0.5", "x.rate=0.01..1"])]
#[case("elliptic-trammel", &["theta=1.9..2.6", "mu=0..1"])]
#[case("gate-on-two-posts", &["mu=0..0.6"])]
#[case("gate-on-two-posts", &["z=0..1", "mu=0..0.3"])]
#[case("gate-on-two-posts", &["a=0.05..0.5", "mu=0..0.6"])]
#[case("painleve-klein", &["mu=0..5", "P_1=-10 N..10 N"])]
#[case("scotch-yoke", &["phi=-3..3", "mu_yoke=0..0.8", "phi.rate=-30..30"])]
#[case("sleeve-on-arm", &["phi=-0.5..0.5", "s=0.2..0.5", "mu=0..0.6"])]
#[case("slider-crank", &["phi=-1.4..1.4", "phi.rate=-150..150"])]
#[case("slider-crank", &["mu=0..2", "r=40 mm..60 mm"])]
#[case("slider-crank-with-pins", &["phi=-3..3", "mu_pin=0..0.4", "phi.rate=-150..150"])]
#[case("slider-crank-with-pins", &["mu_pin=0..2", "pin=10 mm..40 mm", "mu=0..0.6"])]
#[case("telescopic-boom", &["mu=0..0.6", "s_1=-0.1..0.3"])]
#[case("toggle-press", &["alpha=0.01..1.2", "alpha.rate=-1..1", "mu_pin=0..0.5"])]
fn rows_are_what_solve_says(#[case] name: &str, #[case] vary: &[&str]) {
    let model = model(name);
    let sampling = Sampling { count: 120, spread: Spread::Random, seed: 11 };
    let sweep = Sweep::new(&model, &samples(sampling, vary).all_columns(true)).unwrap();
    let mut solved = 0;
    for rows in rows(&sweep) {
        let mut first = 0;
        while first < rows.len() {
            let point = rows.heads[first].point;
            let count = rows.heads[first..].iter().take_while(|head| head.point == point).count();
            let settings = settings_of(&sweep, vary.len(), &rows.numbers(first)[..vary.len()], &model);
            match model.with(&settings).and_then(|model| solve(&model)) {
                Ok(report) => {
                    check_point(&sweep, &rows, first..first + count, &report);
                    solved += 1;
                }
                Err(_) => assert!(!rows.heads[first].status.is_solved(), "{point}"),
            }
            first += count;
        }
    }
    assert!(solved > 60, "{solved}");
}

/// A grid goes from point to point; each position is what the way from the drawing gives. A rod shorter than
/// the crank cannot pass 90 degrees on that way, though it can come there from a longer one.
#[rstest]
#[case("slider-crank", &["phi=-80 deg..80 deg:161"])]
#[case("scotch-yoke", &["phi=-170 deg..170 deg:171"])]
#[case("elliptic-trammel", &["theta=100 deg..170 deg:71"])]
#[case("sleeve-on-arm", &["phi=-60 deg..60 deg:61"])]
#[case("klepp-2002", &["alpha=40 deg..85 deg:91"])]
#[case("slider-crank", &["phi=20 deg..170 deg:16", "l=90 mm,80 mm,70 mm,60 mm,55 mm,52 mm,49 mm,47 mm,45 mm"])]
fn a_grid_is_what_solve_says(#[case] name: &str, #[case] vary: &[&str]) {
    let model = model(name);
    let sweep = Sweep::new(&model, &grid(vary).all_columns(true)).unwrap();
    for rows in rows(&sweep) {
        let mut first = 0;
        while first < rows.len() {
            let point = rows.heads[first].point;
            let count = rows.heads[first..].iter().take_while(|head| head.point == point).count();
            if rows.heads[first].breakpoint == Breakpoint::No {
                let settings = settings_of(&sweep, vary.len(), &rows.numbers(first)[..vary.len()], &model);
                match solve(&model.with(&settings).unwrap()) {
                    Ok(report) => check_point(&sweep, &rows, first..first + count, &report),
                    // At a dead centre sliding stops; a rod that is too short has no position.
                    Err(_) => assert!(!rows.heads[first].status.is_solved(), "{point}"),
                }
            }
            first += count;
        }
    }
}

fn rows_with_threads(sweep: &Sweep, threads: usize) -> Vec<Rows> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| rows(sweep))
}

/// Not even the last bit depends on the number of threads. Texts compare what is not a number, too.
#[rstest]
#[case("klepp-2002", &["mu_1=0..0.8:9001"])]
#[case("slider-crank", &["phi=-80 deg..80 deg:5001"])]
#[case("klepp-2002", &["mu_1=0..0.8:81", "mu_2=0..0.4:61"])]
fn rows_do_not_depend_on_the_number_of_threads(#[case] name: &str, #[case] vary: &[&str]) {
    let sweep = Sweep::new(&model(name), &grid(vary)).unwrap();
    let one = format!("{:?}", rows_with_threads(&sweep, 1));
    for threads in [2, 3] {
        assert!(format!("{:?}", rows_with_threads(&sweep, threads)) == one, "{threads} threads");
    }
}

#[test]
fn a_sweep_can_be_continued_anywhere() {
    let sweep = Sweep::new(&model("klepp-2002"), &grid(&["mu_1=0..0.8:40001"])).unwrap();
    let all = format!("{:?}", rows_with_threads(&sweep, 1));
    for stop in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let (mut parts, mut state, mut takes) = (Vec::new(), sweep.start(), 0);
        pool.install(|| {
            let mut kept = None;
            sweep.run(&mut state, &Rows::clone, &mut |rows, state| {
                parts.extend(rows);
                takes += 1;
                kept = Some(state.clone());
                if takes == stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            // What is kept in a file is the state as text.
            let text = serde_json::to_string(&kept.unwrap()).unwrap();
            let mut state = serde_json::from_str(&text).unwrap();
            sweep.run(&mut state, &Rows::clone, &mut |rows, _| {
                parts.extend(rows);
                ControlFlow::Continue(())
            });
            assert_eq!(state.tally, sweep.tally());
        });
        assert!(format!("{parts:?}") == all, "after {stop}");
    }
}

/// Klepp (2002), section 7, moving to the right without preload: one solution up to 0.45265396, two
/// beyond, one of which begins there with infinite forces. As the other one stays nothing locks. Each of them is one branch throughout.
#[test]
fn the_branches_of_the_paper() {
    let sweep = Sweep::new(&with("klepp-2002", &[("F_20", "0")]), &grid(&["mu_1=0..0.8:801"])).unwrap();
    let all = rows(&sweep);
    let mut ranges = std::collections::BTreeMap::new();
    let mut breakpoints = Vec::new();
    for rows in &all {
        for row in 0..rows.len() {
            let head = &rows.heads[row];
            let mu = rows.numbers(row)[0];
            if head.inserted && breakpoints.last() != Some(&(mu, head.breakpoint)) {
                breakpoints.push((mu, head.breakpoint));
            }
            if head.branch > 0 {
                let range = ranges.entry(head.branch).or_insert((mu, mu, 0));
                range.1 = mu;
                range.2 += u32::from(!head.inserted);
            }
        }
    }
    assert_eq!(ranges.keys().copied().collect::<Vec<_>>(), [1, 2]);
    assert_eq!((ranges[&1].0, ranges[&1].1, ranges[&1].2), (0.0, 0.8, 801));
    assert!((ranges[&2].0 - 0.453).abs() < 1e-12);
    assert_eq!((ranges[&2].1, ranges[&2].2), (0.8, 348));
    // Theory, section 9.
    assert!(
        breakpoints
            .iter()
            .any(|(mu, kind)| { (mu - 0.452_653_96).abs() < 1e-8 && *kind == Breakpoint::WithoutBound }),
        "{breakpoints:?}"
    );
}

/// With the preload F_20 = m g the first branch passes from (+,-,+) to (+,-,-) at mu_1 = 0.45252578 (theory,
/// section 9, with the side of contact 3 counted the other way round), and is still the same branch.
#[test]
fn a_branch_goes_on_where_a_contact_changes_side() {
    let sweep = Sweep::new(&model("klepp-2002"), &grid(&["mu_1=0.45..0.455:51"])).unwrap();
    let all = rows(&sweep);
    let rows = &all[0];
    let first: Vec<usize> = (0..rows.len()).filter(|&row| rows.heads[row].branch == 1).collect();
    let patterns: std::collections::BTreeSet<&[u8]> = first
        .iter()
        .filter(|&&row| rows.heads[row].kind == RowKind::Solution)
        .map(|&row| rows.pattern(row))
        .collect();
    assert_eq!(patterns.len(), 2, "{patterns:?}");
    let change = (0..rows.len())
        .find(|&row| rows.heads[row].inserted && (rows.numbers(row)[0] - 0.452_525_78).abs() < 1e-8);
    assert_eq!(rows.heads[change.unwrap()].breakpoint, Breakpoint::SideChange);
    let points = rows.heads.iter().filter(|head| head.branch == 1 && !head.inserted).count();
    assert_eq!(points, 51);
}

/// The drawer jams from mu = L / (2 a) = 2/3 on (book, chapter Limits). With normal mu that has the
/// probability 1 - Phi((2/3 - 0.6) / 0.05) = 1 - Phi(4/3) = 0.0912112197 (from tables: Phi(1.33) = 0.90824,
/// Phi(1.34) = 0.90988).
#[test]
fn the_probability_that_a_drawer_jams() {
    let exact = 0.091_211_219_725_868;
    for (spread, error) in [(Spread::Random, 0.003), (Spread::Halton, 0.0002)] {
        let sampling = Sampling { count: 40_000, spread, seed: 3 };
        let options = samples(sampling, &["mu=normal(0.6, 0.05)"]);
        let sweep = Sweep::new(&model("drawer"), &options).unwrap();
        let probability = sweep.tally().probability_of_jamming().unwrap();
        assert!((probability.share - exact).abs() < error, "{spread:?}: {probability:?}");
        assert!(probability.interval[0] < exact && exact < probability.interval[1], "{probability:?}");
    }
}

/// The piston of a slider-crank with a rod shorter than its crank cannot follow everywhere: |sin phi| <= l /
/// r.
#[test]
fn points_without_a_position_are_marked() {
    let model = with("slider-crank", &[("r", "90 mm"), ("l", "60 mm"), ("phi_drawn", "20 deg")]);
    let sweep = Sweep::new(&model, &grid(&["phi=-60 deg..60 deg:121"])).unwrap();
    let limit = (60.0_f64 / 90.0).asin();
    let mut marked = 0;
    for rows in rows(&sweep) {
        for row in 0..rows.len() {
            let phi = rows.numbers(row)[0];
            let head = &rows.heads[row];
            if phi.abs() > limit + 1e-6 {
                assert_eq!(head.status, PointStatus::NoPosition, "{phi}");
                assert!(rows.numbers(row)[1..].iter().all(|value| value.is_nan()));
                marked += 1;
            } else if phi.abs() < limit - 1e-2 && phi != 0.0 && head.breakpoint == Breakpoint::No {
                assert!(head.status.is_solved(), "{phi}");
            }
        }
    }
    assert!(marked >= 36, "{marked}");
    assert!(sweep.tally().refusals.contains_key(&PointStatus::NoPosition));
}

/// Theory, section 7: with mu_1 = 0.6 the solution with N_1 = 0.2625 m g is attainable, that with -1.8754 m g
/// is not.
#[test]
fn attainability_is_that_of_the_theory() {
    let model = with("klepp-2002", &[("F_20", "0")]);
    let sweep = Sweep::new(&model, &grid(&["mu_1=0.6"]).attainability(true)).unwrap();
    let all = rows(&sweep);
    let rows = &all[0];
    let weight = 9.81;
    for row in 0..2 {
        let force = number(&sweep, rows, row, "normal_force.upper") / weight;
        let expected = if force > 0.0 { Verdict::Attainable } else { Verdict::Unattainable };
        let known = if force > 0.0 { 0.2625 } else { -1.8754 };
        assert!((force - known).abs() < 5e-5, "{force}");
        assert_eq!(rows.heads[row].verdict, expected);
    }
}

/// Friction in hinges beside contacts that may lift off is answered at each point, also behind one at which there is none.
#[test]
fn what_solve_answers_a_sweep_does_too() {
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        P = [0, 0]
        C = ["-0.3 m", "0.4 m"]
        Q = ["-0.6 m", "0.8 m"]
        E = ["-0.6 m", "1 m"]
        [bodies.rod]
        points = ["P", "C", "Q"]
        mass = "1 kg"
        centre_of_mass = "C"
        moment_of_inertia = "1 kg m^2"
        [bodies.bob]
        points = ["Q", "E"]
        mass = "1 kg"
        centre_of_mass = "E"
        moment_of_inertia = "0.1 kg m^2"
        [joints.pin]
        type = "hinge"
        between = ["rod.Q", "bob.Q"]
        mu = 0.1
        radius = "10 mm"
        [joints.tip]
        type = "corner_on_face"
        block = "rod"
        at = "P"
        along = "0 deg"
        mu = 0.3
        [coordinates.x]
        slide = "tip"
        rate = "1 m/s"
        [coordinates.turn]
        rotation = "rod"
        rate = "1 rad/s"
        [coordinates.bob]
        rotation = "bob"
        rate = "2 rad/s"
    "#;
    let model = Model::parse(text).unwrap();
    assert_eq!(solve(&model).unwrap().count, "1");
    let tally = Sweep::new(&model, &grid(&["friction=0..1:3"])).unwrap().tally();
    assert_eq!(tally.with_status(PointStatus::One), 3);
}

/// Values from which a negative coefficient is computed refuse their points, not the sweep; all others are
/// computed.
#[test]
fn negative_friction_is_refused_point_by_point() {
    let text =
        slideway::gallery::find("drawer").unwrap().text.replace("\nmu = 0.3", "\nk = 3\nmu = \"0.1*k\"");
    let sweep = Sweep::new(&Model::parse(&text).unwrap(), &grid(&["k=-2,2"])).unwrap();
    let tally = sweep.tally();
    assert_eq!((tally.with_status(PointStatus::Refused), tally.with_status(PointStatus::One)), (1, 1));
    assert!(tally.refusals[&PointStatus::Refused].1.contains("at least zero"), "{tally:?}");
}

/// Whoever begins with the greater end means the same range.
#[test]
fn both_orders_of_an_axis_have_one_table() {
    let table = |sweep: &Sweep| format!("{:?}", rows(sweep));
    for [one, other] in [["mu=0.8..0.2:4", "mu=0.2..0.8:4"], ["mu=0.8..0.2:4:log", "mu=0.2..0.8:4:log"]] {
        let of = |axis: &str| table(&Sweep::new(&model("drawer"), &grid(&[axis])).unwrap());
        assert_eq!(of(one), of(other));
    }
    let sampling = Sampling { count: 5, spread: Spread::Random, seed: 1 };
    for [one, other] in [["mu=0.8..0.2", "mu=0.2..0.8"], ["mu=uniform(0.8, 0.2)", "mu=uniform(0.2, 0.8)"]] {
        let of = |axis: &str| table(&Sweep::new(&model("drawer"), &samples(sampling, &[axis])).unwrap());
        assert_eq!(of(one), of(other));
    }
}

#[rstest]
#[case("mu", "not of the form NAME=VALUES")]
#[case("mu=0..0.8", "does not say how many values")]
#[case("mu=0..0.8:1", "is not a number of values (2 or more)")]
#[case("mu=0..0.8:x", "is not a number of values (2 or more)")]
#[case("mu=0.8..0.8:11", "empty")]
#[case("mu=0..0.8:11:log", "above zero")]
#[case("mu=0..0.8:11:cubic", "is not a spacing")]
#[case("mu=0..abc:11", "unknown name `abc`")]
#[case("mu=0..1 m:11", "a length where")]
#[case("mu=normal(0.3, 0.1)", "no samples")]
#[case("nu=0..1:11", "named `nu`")]
#[case("friction=-1..1:11", "cannot be negative")]
#[case("mu=-1..1:5", "from -1 to 0 they are")]
#[case("mu=-1..-0.5:5", "from -1 to -0.5 they are")]
#[case("mu=-0.2,0.2", "cannot be negative, but -0.2 is")]
#[case("mu=0..1:99999999999999", "more than")]
fn faults_of_axes(#[case] axis: &str, #[case] part: &str) {
    let sweep = axis.parse().and_then(|axis| Sweep::new(&model("drawer"), &SweepOptions::grid([axis])));
    let faults = sweep.unwrap_err();
    assert!(faults.to_string().contains(part), "{faults}");
}

#[rstest]
#[case("mu=0..0.8:11", "distribution or from a plain range")]
#[case("mu=-1..1", "from -1 to 0 they are")]
#[case("mu=normal(0.3)", "its mean and its standard deviation")]
#[case("mu=normal(0.3, 0)", "standard deviation must be positive")]
#[case("mu=lognormal(-0.3, 0.1)", "median must be positive")]
#[case("mu=uniform(-0.3, -0.1)", "lies below zero")]
fn faults_of_distributions(#[case] axis: &str, #[case] part: &str) {
    let sampling = Sampling { count: 10, spread: Spread::Random, seed: 0 };
    let sweep =
        axis.parse().and_then(|axis| Sweep::new(&model("drawer"), &SweepOptions::samples(sampling, [axis])));
    let faults = sweep.unwrap_err();
    assert!(faults.to_string().contains(part), "{faults}");
}

/// Logarithmic spacing: mu_1 = 0.01, 0.1, 1 exactly at its ends, the middle within rounding.
#[test]
fn logarithmic_axes() {
    let without_breakpoints = grid(&["mu_1=0.01..1:3:log"]).breakpoints(false);
    let sweep = Sweep::new(&model("klepp-2002"), &without_breakpoints).unwrap();
    let all = rows(&sweep);
    let mut values: Vec<f64> = (0..all[0].len()).map(|row| all[0].numbers(row)[0]).collect();
    values.dedup();
    assert_eq!((values[0], values[2], values.len()), (0.01, 1.0, 3));
    assert!((values[1] - 0.1).abs() < 1e-15);
}

/// Ten contacts are left to the search of `solve`, which is asked, too, whether it goes on: a point within
/// which it does not is left out, whatever the search has found of it by then.
#[test]
fn what_is_ended_within_a_point_keeps_the_points_before_it() {
    let boom = Model::parse(&gallery::telescopic_boom(5).unwrap()).unwrap();
    let sweep = Sweep::new(&boom, &grid(&["overlap=0.3 m..0.9 m:6"]).breakpoints(false)).unwrap();
    let whole = rows(&sweep);
    let numbers = |rows: &Rows| (0..rows.len()).map(|row| bits(rows.numbers(row))).collect::<Vec<_>>();
    // What comes if the sweep is to end at the so-manieth time of asking, and how many times it was asked.
    let ended_at = |last: usize| {
        let (asked, mut state, mut kept) = (AtomicUsize::new(0), sweep.start(), Vec::new());
        let goes_on = || asked.fetch_add(1, Ordering::Relaxed) < last;
        sweep.run_while(&goes_on, &mut state, &Rows::clone, &mut |rows, _| {
            kept.extend(rows);
            ControlFlow::Continue(())
        });
        assert_eq!(state.done, kept.iter().map(|rows| rows.points).sum::<u64>());
        for (kept, whole) in kept.iter().zip(&whole) {
            assert_eq!((&kept.heads, numbers(kept)), (&whole.heads, numbers(whole)), "ended at {last}");
        }
        (state.done, asked.into_inner())
    };
    let (done, asked) = ended_at(usize::MAX);
    assert_eq!(done, sweep.points());
    assert!(asked as u64 > 2 * sweep.points(), "asked before each point and within it: {asked}");
    let counts: Vec<u64> = (0..8).map(|part| ended_at(part * asked / 8).0).collect();
    assert!(counts.iter().all(|done| *done < sweep.points()), "{counts:?}");
    assert!(counts.iter().any(|done| *done > 0), "{counts:?}");
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}
