//! Friction in hinges over many points: `sweep`, `map`, and the table of `drive`.

use crate::dead_centre::dead_centres;
use rstest::rstest;
use slideway::limits::Vary;
use slideway::map::{ClassMeaning, ColourBy, MapAxis, MapOptions, MapReport, map};
use slideway::report::{ModeEndCause, Proof, Style};
use slideway::sweep::{Breakpoint, PointStatus, RowKind, Rows, Sweep, SweepOptions};
use slideway::{DriveOptions, LimitsOptions, Model, Report, Settings, drive, gallery, limits, solve};
use std::ops::ControlFlow;

/// A bar with mass and radius of gyration 1, its mass centre at the distance c from a hinge with the friction radius r;
/// it turns with the rate 1 under a load at its mass centre.
fn bar(r: f64, load: [f64; 2]) -> Model {
    let text = format!(
        "[parameters]\nr = {r:?}\nF = {:?}\n\
         [points]\nO = [0, 0]\nC = [0.5, 0]\n\
         [bodies.bar]\npoints = [\"O\", \"C\"]\nmass = 1\nmoment_of_inertia = 1\ncentre_of_mass = \"C\"\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\nfriction_radius = \"r\"\n\
         [loads.pull]\ntype = \"force\"\nat = \"bar.C\"\ncomponents = [{:?}, \"F\"]\n\
         [coordinates.phi]\nrotation = \"bar\"\nrate = 1\n",
        load[1], load[0]
    );
    Model::parse(&text).unwrap()
}

fn rows(sweep: &Sweep) -> Vec<Rows> {
    let mut all = Vec::new();
    sweep.run(&mut sweep.start(), &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    all
}

fn column(sweep: &Sweep, name: &str) -> usize {
    let place = sweep.columns().iter().position(|column| column.name == name);
    place.unwrap_or_else(|| panic!("no column {name}"))
}

/// With the angular acceleration `a = (M_load - r w) / J_O` of the bar and the force `F` at its mass centre, the hinge has
/// `R_x = -m c - F_x` and `R_y = m c a - F_y`, `w^2 = R_x^2 + R_y^2`: a quadratic equation for `w`.
fn magnitudes(r: f64, [fx, fy]: [f64; 2]) -> Vec<f64> {
    let (c, about_hinge) = (0.5, 1.25);
    let x = -c - fx;
    // R_y = p - q w
    let (p, q) = (c * c * fy / about_hinge - fy, c * r / about_hinge);
    // (1 - q^2) w^2 + 2 p q w - (x^2 + p^2) = 0
    let (a, b, constant) = (1.0 - q * q, p * q, -(x * x + p * p));
    let disc = b * b - a * constant;
    if disc < 0.0 {
        return Vec::new();
    }
    let mut roots: Vec<f64> = [-1.0, 1.0].into_iter().map(|sign| (-b + sign * disc.sqrt()) / a).collect();
    roots.retain(|root| *root > 0.0);
    roots.sort_by(f64::total_cmp);
    roots
}

/// The quadratic equation has a double root where `q^2 = (x^2 + p^2) / x^2`: there both branches have a point, and end.
#[test]
fn a_sweep_has_the_point_at_which_two_solutions_merge() {
    let load = [1.5, -4.0];
    let (c, about_hinge) = (0.5, 1.25);
    let (x, p): (f64, f64) = (-c - load[0], c * c * load[1] / about_hinge - load[1]);
    let fold = x.hypot(p) / x.abs() * about_hinge / c;
    let options = SweepOptions::grid(["r=0.05..6:24".parse().unwrap()]);
    let sweep = Sweep::new(&bar(0.1, load), &options).unwrap();
    assert_eq!(sweep.without_breakpoints(), None);
    let force = column(&sweep, "hinge_force_x.pin");
    let mut found = 0;
    let mut last: Vec<u32> = Vec::new();
    for rows in rows(&sweep) {
        let folds = (0..rows.len()).filter(|&row| rows.heads[row].breakpoint == Breakpoint::Fold);
        let folds: Vec<usize> = folds.collect();
        if let [one, other] = folds[..] {
            found += 1;
            let [near, far] = [one, other].map(|row| (rows.numbers(row)[0], rows.numbers(row)[force]));
            assert!((near.0 - fold).abs() <= 1e-9 * fold, "{} instead of {fold}", near.0);
            assert!((near.1 - far.1).abs() <= 1e-3 * near.1.abs(), "{near:?} {far:?}");
            assert_ne!(rows.heads[one].negative_determinant, rows.heads[other].negative_determinant);
            last = [one, other].map(|row| rows.heads[row].branch).to_vec();
        }
        for head in rows.heads.iter().filter(|head| head.solutions == 0) {
            assert!(!last.contains(&head.branch));
        }
    }
    assert_eq!(found, 1);
}

/// Over the radius: one solution, two in one mode beyond the centre of percussion, none beyond the fold. The branches of
/// both have opposite determinants, and the table numbers them.
#[test]
fn a_bar_has_the_solutions_of_its_quadratic_equation() {
    let load = [1.5, -4.0];
    // Without the values at which solutions end: two are one there, and rounding decides how many are seen.
    let options = SweepOptions::grid(["r=0.05..6:240".parse().unwrap()]).breakpoints(false);
    let sweep = Sweep::new(&bar(0.1, load), &options).unwrap();
    let (force, number) = (column(&sweep, "hinge_force_x.pin"), column(&sweep, "number_in_mode"));
    let couple = column(&sweep, "friction_couple.pin");
    let (mut met, mut branches) = ([0; 3], [0; 3]);
    for rows in rows(&sweep) {
        let mut first = 0;
        while first < rows.len() {
            let count =
                rows.heads[first..].iter().take_while(|head| head.point == rows.heads[first].point).count();
            let r = rows.numbers(first)[0];
            let expected = magnitudes(r, load);
            assert_eq!(rows.heads[first].solutions as usize, expected.len(), "r = {r}");
            met[expected.len()] += 1;
            let mut found: Vec<f64> = Vec::new();
            for row in (first..first + count).filter(|&row| rows.heads[row].kind == RowKind::Solution) {
                let numbers = rows.numbers(row);
                let w = numbers[force].hypot(numbers[force + 1]);
                assert!((numbers[couple] + r * w).abs() < 1e-9 * w);
                assert_eq!(numbers[number], (found.len() + 1) as f64);
                let greater = expected.len() == 2 && (w - expected[1]).abs() < (w - expected[0]).abs();
                assert_eq!(rows.heads[row].negative_determinant, Some(greater), "r = {r}");
                branches[rows.heads[row].branch as usize] += 1;
                found.push(w);
            }
            found.sort_by(f64::total_cmp);
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found / expected - 1.0).abs() < 1e-9, "r = {r}: {found} instead of {expected}");
            }
            first += count;
        }
    }
    assert!(met.iter().all(|points| *points > 10), "{met:?}");
    assert_eq!(branches, [0, met[1] + met[2], met[2]]);
}

/// The same bar as a map over radius and load.
#[test]
fn a_map_has_the_numbers_of_solutions_of_the_quadratic_equation() {
    let options = MapOptions::new("r=0.05..6".parse().unwrap(), "F=-8..8".parse().unwrap()).size(40, 30);
    let report = map(&bar(0.1, [1.5, -4.0]), &options.probe(1)).unwrap();
    let mut seen = [0; 3];
    for row in 0..30 {
        for pixel in 0..40 {
            let at =
                |[from, to]: [f64; 2], pixel: f64, pixels: f64| from + (pixel + 0.5) / pixels * (to - from);
            let (r, load) = (at([0.05, 6.0], pixel as f64, 40.0), at([-8.0, 8.0], row as f64, 30.0));
            let expected = magnitudes(r, [1.5, load]).len();
            seen[expected] += 1;
            let found = match &report.classes[report.class_at(pixel, row)].meaning {
                ClassMeaning::Locked => 0,
                ClassMeaning::Solutions { solutions, preload_gap_states: 0, .. } => *solutions,
                other => panic!("{other:?}"),
            };
            assert_eq!(found, expected, "r = {r}, F = {load}");
        }
    }
    assert!(seen.iter().all(|pixels| *pixels > 20), "{seen:?}");
}

/// Every colour has an answer.
#[rstest]
#[case(ColourBy::Modes)]
#[case(ColourBy::Jam)]
#[case(ColourBy::Motion)]
#[case(ColourBy::Hold)]
#[case(ColourBy::Margin)]
fn maps_answer(#[case] colour_by: ColourBy) {
    let model = Model::parse(gallery::find("slider-crank-with-pins").unwrap().text).unwrap();
    let options = MapOptions::new("phi=-170 deg..150 deg".parse().unwrap(), "mu_pin=0..0.5".parse().unwrap());
    let report = map(&model, &options.size(9, 5).colour_by(colour_by)).unwrap();
    let answered = |meaning: &ClassMeaning| !matches!(meaning, ClassMeaning::NotSolved { .. });
    assert!(report.classes.iter().all(|class| answered(&class.meaning)), "{:?}", report.classes);
}

/// The finite bounds of the margins of a class; beyond 5 they are one class.
fn margin(meaning: &ClassMeaning) -> [f64; 2] {
    let ClassMeaning::Margin { from, to } = *meaning else { panic!("no margin: {meaning:?}") };
    [from, to.unwrap_or(f64::INFINITY)]
}

/// Up to the distance of the centre of percussion, `2.5 = 1.25 / 0.5`, there is one solution whatever the load, then there are two or none.
#[test]
fn a_bar_has_the_margin_of_its_centre_of_percussion() {
    let options = MapOptions::new("r=0.2..2.6".parse().unwrap(), "F=-8..8".parse().unwrap());
    let map = map(&bar(0.1, [1.5, -4.0]), &options.size(24, 6).probe(1).colour_by(ColourBy::Margin)).unwrap();
    for (row, pixel) in (0..6).flat_map(|row| (0..24).map(move |pixel| (row, pixel))) {
        let factor = 2.5 / (0.25 + 0.1 * pixel as f64);
        let meaning = &map.classes[map.class_at(pixel, row)].meaning;
        if factor < 1.0 {
            assert!(!matches!(meaning, ClassMeaning::Margin { .. }), "{factor}: {meaning:?}");
            continue;
        }
        let [from, to] = margin(meaning);
        assert!(from <= factor + 1e-9 && factor <= to + 1e-9, "{factor}: {meaning:?}");
    }
    assert!(map.classes.len() >= 7, "{:?}", map.classes);
}

/// The numbers of solutions with multiplied friction are those of a table over the factor; the margins that `solve` gives are of an only solution
/// that locks. The factors of the table are 0.01 apart.
#[rstest]
#[case("slider-crank-with-pins", "phi=10 deg..170 deg", "mu_pin=0.05..0.5", false)]
#[case("toggle-press", "alpha=1 deg..25 deg", "mu=0.05..0.5", true)]
#[case("four-bar", "phi=120 deg..180 deg", "mu_pin=0.05..0.5", true)]
fn maps_by_margin_have_the_numbers_of_solutions_of_tables(
    #[case] name: &str,
    #[case] x: &str,
    #[case] y: &str,
    #[case] locks: bool,
) {
    let model = Model::parse(gallery::find(name).unwrap().text).unwrap();
    let (x, y): (Vary, Vary) = (x.parse().unwrap(), y.parse().unwrap());
    let options = MapOptions::new(x.clone(), y.clone()).size(5, 4).probe(1).colour_by(ColourBy::Margin);
    let map = map(&model, &options).unwrap();
    let value = |axis: &MapAxis, pixel: usize, pixels: f64| {
        axis.from + (axis.to - axis.from) * (pixel as f64 + 0.5) / pixels
    };
    let (mut compared, mut locking) = (0, 0);
    for (row, pixel) in (0..4).flat_map(|row| (0..5).map(move |pixel| (row, pixel))) {
        let meaning = &map.classes[map.class_at(pixel, row)].meaning;
        let settings = Settings::default().position(&x.name, value(&map.x, pixel, 5.0));
        let settings = settings.parameter(&y.name, value(&map.y, row, 4.0));
        let there = model.with(&settings).unwrap();
        let table = SweepOptions::grid(["friction=1..5:401".parse().unwrap()]).breakpoints(false);
        let sweep = Sweep::new(&there, &table).unwrap();
        let rows = rows(&sweep);
        let counts = rows
            .iter()
            .flat_map(|rows| (0..rows.len()).map(|row| (rows.numbers(row)[0], rows.heads[row].solutions)));
        let other = counts.filter(|(_, solutions)| *solutions != 1).map(|(factor, _)| factor);
        let factor = other.reduce(f64::min).unwrap_or(f64::INFINITY);
        if factor == 1.0 {
            assert!(!matches!(meaning, ClassMeaning::Margin { .. }), "{settings:?}: {meaning:?}");
            continue;
        }
        let [from, to] = margin(meaning);
        assert!(from <= factor && factor <= to + 0.01, "{settings:?}: {factor}, {meaning:?}");
        compared += 1;
        let solved = solve(&there).unwrap();
        let of_solution = solved.solutions[0].margin.as_ref().expect("a margin");
        if let (ModeEndCause::Locking, Some(end)) = (of_solution.ends_with, of_solution.factor) {
            assert!(from <= end, "{settings:?}: {end}, {meaning:?}");
            locking += usize::from(end < 5.0);
        }
    }
    assert!(compared > 8 && (locking > 0) == locks, "{compared} compared, {locking} lock");
}

/// The factor of all friction multiplies the radius of a friction circle that is given; with none there is one solution.
#[test]
fn over_the_factor_of_friction_a_bar_has_the_solutions_of_the_multiplied_radius() {
    let load = [1.5, -4.0];
    let options = SweepOptions::grid(["friction=0..59:121".parse().unwrap()]).breakpoints(false);
    let sweep = Sweep::new(&bar(0.1, load), &options).unwrap();
    let mut met = [0; 3];
    for rows in rows(&sweep) {
        for row in 0..rows.len() {
            let expected = magnitudes(0.1 * rows.numbers(row)[0], load).len();
            assert_eq!(rows.heads[row].solutions as usize, expected, "{:?}", rows.numbers(row));
            met[expected] += 1;
        }
    }
    assert!(met.iter().all(|rows| *rows > 5), "{met:?}");
    let options =
        MapOptions::new("friction=0.5..60".parse().unwrap(), "F=-8..8".parse().unwrap()).size(20, 15);
    let of_radius = MapOptions::new("r=0.05..6".parse().unwrap(), "F=-8..8".parse().unwrap()).size(20, 15);
    let [of_factor, of_radius] = [options, of_radius].map(|options| map(&bar(0.1, load), &options).unwrap());
    for (row, pixel) in (0..15).flat_map(|row| (0..20).map(move |pixel| (row, pixel))) {
        let meaning = |map: &MapReport| map.classes[map.class_at(pixel, row)].meaning.clone();
        assert_eq!(meaning(&of_factor), meaning(&of_radius), "{pixel}, {row}");
    }
}

/// A table of drive over the factor of friction has the efforts of a model with all coefficients multiplied.
#[test]
fn over_the_factor_of_friction_a_press_needs_the_efforts_of_multiplied_coefficients() {
    let model = Model::parse(gallery::find("toggle-press").unwrap().text).unwrap();
    let options = DriveOptions::default().vary("friction=0..3".parse::<slideway::Vary>().unwrap());
    let report = drive(&model, &options.rows(4)).unwrap();
    let rows = &report.course.as_ref().unwrap().directions[0].rows;
    assert_eq!(rows.len(), 4);
    for row in rows {
        // The coefficients of the model are 0.1 and 0.12.
        let settings = Settings::default().parameter("mu", 0.1 * row.at).parameter("mu_pin", 0.12 * row.at);
        let expected = solve(&model.with(&settings).unwrap()).unwrap().solutions[0].drives[0].effort;
        let effort = row.efforts.as_ref().unwrap()[0];
        assert!((effort / expected - 1.0).abs() < 1e-12, "{effort} instead of {expected}");
    }
}

/// About both dead centres no force on the piston turns the crank; the ranges end where the closed form says.
#[test]
fn a_table_of_drive_has_the_locked_ranges_of_the_dead_centres() {
    let case = &dead_centres()[0];
    let options = DriveOptions::default().vary("phi=-20 deg..200 deg".parse::<slideway::Vary>().unwrap());
    let report = drive(&case.driven_by_piston(1.0), &options.rows(23)).unwrap();
    let turning = &report.course.as_ref().unwrap().directions[0];
    let expected = [[-case.outer_deg, case.outer_deg], [180.0 - case.inner_deg, 180.0 + case.inner_deg]];
    assert_eq!(turning.locked.len(), 2, "{:?}", turning.locked);
    for (locked, expected) in turning.locked.iter().zip(expected) {
        let found = [locked.from, locked.to].map(f64::to_degrees);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found} instead of {expected}");
        }
    }
    assert_eq!(turning.blow_ups.len(), 4, "{:?}", turning.blow_ups);
    assert!(report.text(Style::default()).contains(" it jams from "));
}

/// About a dead centre the relaxation meets the conditions of all hinges, and each contact jams: the search divides the
/// contacts, where dividing directions first would take tens of thousands of nodes.
#[test]
fn about_a_dead_centre_contacts_are_divided_before_directions() {
    let model = dead_centres()[0].driven_by_piston(1.0);
    for angle in [-5.0, -1.0, 0.5, 4.0, 175.0, 183.0] {
        let settings = Settings::default().position("phi", f64::to_radians(angle));
        let report = solve(&model.with(&settings).unwrap()).unwrap();
        assert!(report.solutions.is_empty() && report.complete == Proof::Proven);
        assert!(report.nodes < 50, "{} nodes at {angle:?}", report.nodes);
    }
}

/// The rows between are what `solve` says.
#[test]
fn rows_of_a_table_are_the_efforts_of_solve() {
    let model = Model::parse(gallery::find("toggle-press").unwrap().text).unwrap();
    let options = DriveOptions::default().vary("alpha=1 deg..20 deg".parse::<slideway::Vary>().unwrap());
    let report = drive(&model, &options.rows(5)).unwrap();
    let rows = &report.course.as_ref().unwrap().directions[0].rows;
    assert_eq!(rows.len(), 5);
    for row in rows {
        let expected = solve(&model.with(&Settings::default().position("alpha", row.at)).unwrap()).unwrap();
        assert_eq!(row.efforts.as_ref().unwrap()[0], expected.solutions[0].drives[0].effort);
        assert!(row.efficiency.unwrap().value.unwrap() < 1.0);
    }
}

/// A position without a motion that turns a hinge is refused point by point.
#[test]
fn a_point_at_rest_is_refused_alone() {
    let sweep =
        Sweep::new(&bar(0.1, [0.0, -4.0]), &SweepOptions::grid(["phi.rate=-1..1:3".parse().unwrap()]))
            .unwrap();
    let statuses: Vec<PointStatus> =
        rows(&sweep).iter().flat_map(|rows| rows.heads.iter().map(|head| head.status)).collect();
    assert_eq!(statuses, [PointStatus::One, PointStatus::Refused, PointStatus::One]);
}

/// A press with a wide eccentric that its ram drives, past an offset.
const PRESS: &str = r#"
gravity = 9.81
[parameters]
e = "20 mm"
l = "150 mm"
off = "10 mm"
phi0 = "60 deg"
mu = 0.12
[points]
O = [0, 0]
A = ["e*cos(phi0)", "e*sin(phi0)"]
B = ["off", "e*sin(phi0)-sqrt(l^2-(e*cos(phi0)-off)^2)"]
G = ["off", "e*sin(phi0)-sqrt(l^2-(e*cos(phi0)-off)^2)-40 mm"]
[bodies]
shaft = { points = ["O", "A"], mass = 15, centre_of_mass = "O", shape = { disc = 0.08 } }
rod = { points = ["A", "B"], mass = 3, shape = { bar = ["A", "B"] } }
ram = { points = ["B", "G"], mass = 10, centre_of_mass = "G", shape = { rectangle = [0.08, 0.16] } }
[joints]
O = { type = "hinge", between = ["ground.O", "shaft.O"], mu = "mu", radius = 0.025 }
A = { type = "hinge", between = ["rod.A", "shaft.A"], mu = "mu", radius = 0.045 }
B = { type = "hinge", between = ["rod.B", "ram.B"], mu = "mu", radius = 0.012 }
guide = { type = "block_slider", block = "ram", at = "G", along = "90 deg", length = 0.12, height = 0.08, mu = 0.1 }
[loads]
work = { type = "force", at = "ram.G", components = [500, 5000] }
[coordinates]
phi = { rotation = "shaft", drawn_at = "phi0", rate = "10 rad/s" }
[drives]
motor = { coordinate = "phi", force = { at = "ram.G", direction = "90 deg" } }
"#;

/// A second solution comes from infinity while the first one stays: its effort grows without bound at the zero of the
/// determinant that `limits` finds, which follows the curve of solutions instead of counting them; both end in a fold.
#[test]
fn efforts_grow_without_bound_beside_another_solution() {
    let press = Model::parse(PRESS).unwrap();
    let options = DriveOptions::default().vary("phi=60 deg..80 deg".parse::<Vary>().unwrap());
    let course = drive(&press, &options).unwrap().course.unwrap();
    let found = limits(&press, &LimitsOptions::new("phi=60 deg..80 deg".parse().unwrap())).unwrap();
    let direction = &course.directions[0];
    let from_infinity = found.modes.iter().find(|mode| mode.from_is == ModeEndCause::WithoutBound).unwrap();
    let [blow_up] = &direction.blow_ups[..] else { panic!("{:?}", direction.blow_ups) };
    assert!((blow_up.at - from_infinity.from.unwrap()).abs() < 1e-9, "{blow_up:?} {from_infinity:?}");
    assert_eq!(blow_up.efforts, [1]);
    let [locked] = &direction.locked[..] else { panic!("{:?}", direction.locked) };
    assert!((locked.from - from_infinity.to.unwrap()).abs() < 1e-9, "{locked:?} {from_infinity:?}");
}
