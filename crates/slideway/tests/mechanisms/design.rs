//! The derivations of the book's page "Design", evaluated here on their own, against what the programs say.

use crate::answers::{assert_close, model, parameters};
use slideway::drive::{Approach, DriveOptions, DriveReport, EfficiencyKind, drive};
use slideway::fault::FaultKind;
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::model::{Model, Settings};
use slideway::report::{Report, Style, Verdict};
use slideway::size::{Against, MarginKind, MetEnd, SampleKind, SizeOptions, SizeReport, size};
use slideway::standstill::{HoldOptions, LoadReport, hold};

const MARGINS: [f64; 3] = [1.0, 1.5, 2.0];

fn with(name: &str, list: &[(&str, &str)]) -> Model {
    model(name).with(&parameters(list)).expect("sound settings")
}

fn example(name: &str) -> Model {
    let path = format!("{}/../../../docs/src/examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::parse(&std::fs::read_to_string(path).expect("there")).expect("sound")
}

fn sized(model: &Model, vary: &str, margin: f64, against: Against) -> SizeReport {
    let options = SizeOptions::new(vary.parse().expect("a range"), margin).against(against);
    size(model, &options).unwrap_or_else(|faults| panic!("{faults}"))
}

fn against_locking(model: &Model, vary: &str, margin: f64) -> SizeReport {
    sized(model, vary, margin, Against::Locking)
}

fn to_hold(load: &str) -> Against {
    Against::Hold { load: Some(load.to_owned()) }
}

/// The only end at which the margin is just met, and whether it is met above it.
#[track_caller]
fn only_end(report: &SizeReport) -> (f64, bool) {
    let [met] = &report.met[..] else { panic!("{:#?}", report.met) };
    match (met.from_is, met.to_is) {
        (MetEnd::Margin, MetEnd::Range) => (met.from, true),
        (MetEnd::Range, MetEnd::Margin) => (met.to, false),
        _ => panic!("{met:?}"),
    }
}

fn held(model: &Model, load: &str) -> LoadReport {
    let options = HoldOptions::default().load(load);
    hold(model, &options).expect("sound").load.expect("varied")
}

fn driven(model: &Model, vary: Option<&str>) -> DriveReport {
    let options = DriveOptions::default().vary(vary.map(|vary| vary.parse().expect("a range")));
    drive(model, &options).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Effort and efficiency of the only solution as in the model, and the other way.
#[track_caller]
fn efforts(report: &DriveReport) -> [(f64, EfficiencyKind, Option<f64>); 2] {
    [0, 1].map(|direction| {
        let solutions = &report.directions[direction].solutions;
        assert_eq!(solutions.len(), 1, "{solutions:#?}");
        (solutions[0].efforts[0], solutions[0].efficiency.is, solutions[0].efficiency.value)
    })
}

/// The rails wedge from mu = L/B = 2/3 on, by themselves never.
#[test]
fn what_holds_only_while_wedged_is_told_apart() {
    for (mu, told) in [
        ("0.3", "even wedged by a knock it needs 2.222 times its static friction"),
        ("0.7", "wedged by a knock it holds with a safety factor of 1.05"),
    ] {
        let drawer = with("drawer-on-two-rails", &[("mu", mu)]);
        let report = sized(&drawer, "mu=0.1..0.9", 1.2, to_hold("resistance"));
        assert_eq!(report.present.margin, Some(0.0));
        assert_close(
            report.wedged.expect("it can be wedged"),
            mu.parse::<f64>().unwrap_or_default() * 1.5,
            0.0,
            1e-10,
        );
        assert!(report.text(Style::PLAIN).replace('\n', " ").contains(told), "{}", report.text(Style::PLAIN));
    }
}

// The drawer: N L = a P and P = Q + 2 mu N, so P = Q / (1 - 2 mu a / L).

#[test]
fn drawer_limit_margin_and_guide_length() {
    let (length, a, mu) = (0.4, 0.3, 0.3);
    for margin in MARGINS {
        let (found, above) = only_end(&against_locking(&model("drawer"), "L", margin));
        assert!(above, "longer is better");
        assert_close(found, 2.0 * a * mu * margin, 0.0, 1e-13);
        let (found, above) = only_end(&against_locking(&model("drawer"), "a", margin));
        assert!(!above, "a smaller offset is better");
        assert_close(found, length / (2.0 * mu * margin), 0.0, 1e-13);
        let (found, above) = only_end(&against_locking(&model("drawer"), "mu", margin));
        assert!(!above);
        assert_close(found, length / (2.0 * a * margin), 0.0, 1e-13);
    }
    let report = against_locking(&model("drawer"), "L", 2.0);
    assert_close(report.present.margin.expect("finite"), length / (2.0 * a * mu), 0.0, 1e-13);
    assert_eq!(
        report.conclusion[0],
        "For a safety factor of 2 against jamming: L at least 0.36 m (examined up to 2 m)."
    );
}

#[test]
fn drawer_push_and_efficiency() {
    let (length, a, mu, resistance) = (0.4, 0.3, 0.3, 20.0);
    let share = 2.0 * mu * a / length;
    let report = driven(&model("drawer"), None);
    let [(push, is, efficiency), (back, back_is, back_efficiency)] = efforts(&report);
    assert_close(push, resistance / (1.0 - share), 0.0, 1e-13);
    assert_eq!(is, EfficiencyKind::Driving);
    assert_close(efficiency.expect("a number"), 1.0 - share, 0.0, 1e-13);
    // The other way friction helps to hold the resistance.
    assert_close(back, resistance / (1.0 + share), 0.0, 1e-13);
    assert_eq!(back_is, EfficiencyKind::Braking);
    assert_close(back_efficiency.expect("a number"), 1.0 / (1.0 + share), 0.0, 1e-13);
    assert_eq!(report.directions[0].solutions[0].attainability, Verdict::Attainable);
    let blow_ups = report.directions[0].blow_ups.as_ref().expect("few modes");
    assert_eq!(blow_ups.len(), 1);
    assert_close(blow_ups[0].at, 1.0 / share, 0.0, 1e-14);
    assert_eq!((&*blow_ups[0].pattern, &blow_ups[0].efforts[..]), ("+-", &[1_i8][..]));
    assert_eq!(blow_ups[0].contacts, ["guide.front", "guide.rear"]);
}

#[test]
fn drawer_at_rest_holds_between_both_pushes() {
    let (length, a, mu, resistance) = (0.4, 0.3, 0.3, 20.0);
    let share = 2.0 * mu * a / length;
    let load = held(&model("drawer"), "push");
    let [range] = &load.held[..] else { panic!("{:?}", load.held) };
    assert_close(range.least.expect("finite"), resistance / (1.0 + share), 0.0, 1e-9);
    assert_close(range.greatest.expect("finite"), resistance / (1.0 - share), 0.0, 1e-9);
    // Beyond mu_static = L / (2 a) no push starts it.
    assert_close(load.threshold.value.expect("a factor"), 1.0 / share, 0.0, 1e-11);
    let against = Against::SelfLocking { load: "push".to_owned() };
    for margin in MARGINS {
        let (found, above) = only_end(&sized(&model("drawer"), "L", margin, against.clone()));
        assert!(above);
        assert_close(found, 2.0 * a * mu * margin, 0.0, 1e-11);
    }
}

// The follower: V [cos(phi) - (mu/B) sin(phi) (2 A + B - mu d)] = Q.

#[test]
fn cam_follower_force_margin_and_sizes() {
    let (phi, b, a, d, mu, load) = (30_f64.to_radians(), 0.08, 0.05, 0.012, 0.15, 200.0);
    let bracket = |mu: f64| phi.cos() - mu / b * phi.sin() * (2.0 * a + b - mu * d);
    let report = driven(&model("cam-follower"), None);
    let [(up, _, efficiency), (down, is, _)] = efforts(&report);
    assert_close(up, load / bracket(mu), 0.0, 1e-12);
    // Without friction V = Q / cos(phi).
    assert_close(efficiency.expect("a number"), bracket(mu) / phi.cos(), 0.0, 1e-12);
    assert_close(down, load / bracket(-mu), 0.0, 1e-12);
    assert_eq!(is, EfficiencyKind::Braking);
    let range = held(&model("cam-follower"), "cam").held[0];
    assert_close(range.least.expect("finite"), load / bracket(-mu), 0.0, 1e-9);
    assert_close(range.greatest.expect("finite"), load / bracket(mu), 0.0, 1e-9);

    for margin in MARGINS {
        let k = margin * mu * phi.tan();
        let (found, above) = only_end(&against_locking(&model("cam-follower"), "B=5 mm..0.4 m", margin));
        assert!(above, "a longer bushing is better");
        assert_close(found, k * (2.0 * a - margin * mu * d) / (1.0 - k), 0.0, 1e-12);
        let (found, above) = only_end(&against_locking(&model("cam-follower"), "A=10 mm..0.5 m", margin));
        assert!(!above, "less overhang is better");
        assert_close(found, 0.5 * (b / k - b + margin * mu * d), 0.0, 1e-12);
        let report = against_locking(&model("cam-follower"), "phi=10 deg..80 deg", margin);
        let (found, above) = only_end(&report);
        assert!(!above, "a smaller pressure angle is better");
        let x = margin * mu;
        assert_close(found, (b / (x * (2.0 * a + b - x * d))).atan(), 0.0, 1e-12);
    }
}

// The bracket: N B = W x at e = 0, and W / 2 <= mu_static N, so x >= B / (2 mu_static).

#[test]
fn bracket_holds_from_a_distance_on() {
    let (b, mu) = (0.1524, 0.25);
    for margin in MARGINS {
        let (found, above) = only_end(&sized(&model("bracket-on-pole"), "x", margin, to_hold("W")));
        assert!(above, "farther out it holds better");
        assert_close(found, b * margin / (2.0 * mu), 0.0, 1e-10);
        let slips = Against::SelfLocking { load: "W".to_owned() };
        let (found, above) = only_end(&sized(&model("bracket-on-pole"), "x", margin, slips));
        assert!(!above, "nearer in it slides more freely");
        assert_close(found, b / (2.0 * mu * margin), 0.0, 1e-10);
    }
}

// The wedge: P = Q (tan(alpha + rho_wedge) + mu_floor) / (1 - mu_wall tan(alpha + rho_wedge)).

#[test]
fn wedge_push_limit_and_angle() {
    let (alpha, mu, load) = (10_f64.to_radians(), 0.15_f64, 1000.0);
    let rho = mu.atan();
    let report = driven(&model("wedge"), None);
    let [(push, is, efficiency), (back, back_is, none)] = efforts(&report);
    assert_close(push, load * (alpha + 2.0 * rho).tan(), 0.0, 1e-12);
    assert_eq!(is, EfficiencyKind::Driving);
    assert_close(efficiency.expect("a number"), alpha.tan() / (alpha + 2.0 * rho).tan(), 0.0, 1e-12);
    assert_close(back, load * (alpha - 2.0 * rho).tan(), 0.0, 1e-12);
    assert_eq!((back_is, none), (EfficiencyKind::HeldByFriction, None), "2 rho > alpha");
    let lock = (45_f64.to_radians() - alpha / 2.0).tan();
    let factor = limits(&model("wedge"), &LimitsOptions::new(Vary::usual("friction")).effort(0))
        .expect("sound")
        .counts[0]
        .to;
    assert_close(factor, lock / mu, 0.0, 1e-12);
    assert_close(report.directions[0].blow_ups.as_ref().expect("few modes")[0].at, lock / mu, 0.0, 1e-12);

    let different = [("mu_floor", "0.05"), ("mu_wedge", "0.2"), ("mu_wall", "0.3")];
    let tangent = (alpha + 0.2_f64.atan()).tan();
    let [(push, ..), _] = efforts(&driven(&with("wedge", &different), None));
    assert_close(push, load * (tangent + 0.05) / (1.0 - 0.3 * tangent), 0.0, 1e-12);

    for margin in MARGINS {
        let report = against_locking(&model("wedge"), "alpha=5 deg..80 deg", margin);
        let (found, above) = only_end(&report);
        assert!(!above, "a flatter wedge is better");
        assert_close(found, 90_f64.to_radians() - 2.0 * (margin * mu).atan(), 0.0, 1e-12);
    }
    // At 22.928 deg the iteration for eigenvalues fails at first.
    let report = against_locking(&model("wedge"), "alpha=2 deg..50 deg", 2.0);
    assert_eq!(
        (report.met.len(), report.met[0].from_is, report.met[0].to_is),
        (1, MetEnd::Range, MetEnd::Range)
    );
}

/// The load drives the wedge out if alpha > 2 rho.
#[test]
fn wedge_is_self_locking_below_twice_the_angle_of_friction() {
    let threshold = held(&model("wedge"), "Q").threshold.value.expect("a factor");
    assert_close(threshold * 0.15, 5_f64.to_radians().tan(), 0.0, 1e-10);
}

// The screw: P = Q tan(lambda + rho).

#[test]
fn screw_efficiency_and_self_locking() {
    let lambda = (5.0 / (std::f64::consts::PI * 21.5)).atan();
    for mu in [0.02, 0.1, 0.3] {
        let rho = f64::atan(mu);
        let report = driven(&with("screw", &[("mu", &mu.to_string())]), None);
        let [(up, is, efficiency), (down, back, value)] = efforts(&report);
        assert_close(up, 1e4 * (lambda + rho).tan(), 0.0, 1e-12);
        assert_eq!(is, EfficiencyKind::Driving);
        assert_close(efficiency.expect("a number"), lambda.tan() / (lambda + rho).tan(), 0.0, 1e-12);
        assert_close(down, 1e4 * (lambda - rho).tan(), 1e4, 1e-13);
        if rho < lambda {
            assert_eq!(back, EfficiencyKind::Braking);
            assert_close(value.expect("a number"), (lambda - rho).tan() / lambda.tan(), 0.0, 1e-12);
        } else {
            assert_eq!((back, value), (EfficiencyKind::HeldByFriction, None));
        }
        let blow_up = &report.directions[0].blow_ups.as_ref().expect("few modes")[0];
        assert_close(blow_up.at * mu, 1.0 / lambda.tan(), 0.0, 1e-12);
    }
    let threshold = held(&model("screw"), "Q").threshold.value.expect("a factor");
    assert_close(threshold * 0.1, lambda.tan(), 0.0, 1e-11);
    // Self-locking with a margin x: x tan(lambda) = mu.
    for margin in [1.0, 1.2] {
        let (found, above) = only_end(&sized(&model("screw"), "pitch", margin, to_hold("Q")));
        assert!(!above, "a smaller pitch holds better");
        assert_close(found, std::f64::consts::PI * 0.0215 * 0.1 / margin, 0.0, 1e-10);
    }
}

// The press: S (cos(beta) - mu sin(beta)) = Q and T = r S sin(phi + beta), sin(beta) = (r/l) sin(phi).

#[test]
fn a_press_locks_where_its_rod_is_too_steep() {
    let (r, l, mu, load) = (0.09, 0.1, 0.6_f64, 100.0);
    let phi = 30_f64.to_radians();
    let beta = f64::asin(r / l * phi.sin());
    let report = driven(&example("press"), Some("angle=5 deg..89 deg"));
    let [(torque, ..), _] = efforts(&report);
    let rod = load / (beta.cos() - mu * beta.sin());
    assert_close(torque, -r * rod * (phi + beta).sin(), 0.0, 1e-12);
    let locked = f64::asin(l / r / mu.hypot(1.0));
    let course = &report.course.as_ref().expect("asked for").directions[0];
    let [blow_up] = &course.blow_ups[..] else { panic!("{:#?}", course.blow_ups) };
    assert_close(blow_up.at, locked, 0.0, 1e-12);
    assert_eq!((blow_up.side, &blow_up.efforts[..]), (Approach::Below, &[-1_i8][..]));
    assert!(course.rows.iter().all(|row| (row.at <= blow_up.at) == row.pattern.is_some()));
    let (angle, above) = only_end(&against_locking(&example("press"), "angle=5 deg..89 deg", 1.5));
    assert!(!above);
    assert_close(angle, f64::asin(l / r / f64::hypot(1.5 * mu, 1.0)), 0.0, 1e-12);
}

// The engine: P = M (cos(beta) + mu sin(beta)) / (r sin(phi + beta)).

#[test]
fn an_engine_needs_ever_more_force_towards_its_dead_centres() {
    let (r, l, mu, moment) = (0.05, 0.15, 0.2, 10.0);
    let force = |phi: f64| {
        let beta = f64::asin(r / l * phi.sin());
        moment * (beta.cos() + mu * beta.sin()) / (r * (phi + beta).sin())
    };
    let report = driven(&example("engine"), Some("angle=-40 deg..100 deg"));
    let course = &report.course.as_ref().expect("asked for").directions[0];
    for row in course.rows.iter().filter(|row| row.at > 0.01) {
        assert_close(row.efforts.as_ref().expect("one")[0], force(row.at), 0.0, 1e-10);
    }
    assert!(!course.blow_ups.is_empty());
    assert!(course.blow_ups.iter().all(|blow_up| blow_up.at.abs() < 1e-9), "{:#?}", course.blow_ups);
    let sides: Vec<(Approach, i8)> = course.blow_ups.iter().map(|one| (one.side, one.efforts[0])).collect();
    assert!(
        sides.contains(&(Approach::Above, 1)) && sides.iter().any(|(side, _)| *side == Approach::Below),
        "{sides:?}"
    );
}

// What the answers have to say where there is no number.

#[test]
fn infinite_margins_and_positions_that_do_not_exist_are_told() {
    let straight = against_locking(&example("engine"), "l=60 mm..200 mm", 2.0);
    assert_eq!(straight.present.is, SampleKind::Infinite);
    assert_eq!(
        (straight.met.len(), straight.met[0].from_is, straight.met[0].to_is),
        (1, MetEnd::Range, MetEnd::Range)
    );
    // Its piston is a guided slider.
    let never = "more friction would neither jam nor tip it";
    assert!(straight.conclusion.iter().any(|sentence| sentence.contains(never)));

    // The rod spans the offset of the piston only while l >= r sin(phi).
    let options = SizeOptions::new(Vary::between("l", "20 mm", "200 mm"), 2.0);
    let rod = size(&example("engine"), &options).expect("a report");
    let [gap] = &rod.without_position[..] else { panic!("{:#?}", rod.without_position) };
    assert_eq!(gap.from, 0.02);
    assert_close(gap.to, 0.05 * 60_f64.to_radians().sin(), 0.0, 1e-9);
    assert!(!gap.reason.is_empty());
    assert!(rod.samples.iter().any(|sample| sample.is == SampleKind::NoPosition));
    assert!(rod.met.iter().all(|met| met.from > gap.to - 1e-9));
}

#[test]
fn the_smaller_margin_of_both_directions_counts() {
    // Pulled out, the drawer never jams: the other direction changes nothing.
    let both = |list: &[(&str, &str)]| {
        let options = SizeOptions::new(Vary::usual("L"), 2.0).both_directions(true);
        size(&with("drawer", list), &options).expect("sound")
    };
    assert_close(only_end(&both(&[])).0, 0.36, 0.0, 1e-14);
    // With the velocity reversed in the model, only the other direction jams.
    assert_close(only_end(&both(&[("v", "-0.1 m/s")])).0, 0.36, 0.0, 1e-14);
    let one = against_locking(&with("drawer", &[("v", "-0.1 m/s")]), "L", 2.0);
    assert_eq!((one.met[0].from_is, one.met[0].to_is), (MetEnd::Range, MetEnd::Range));
}

/// Against margins computed one by one.
#[test]
fn sizes_agree_with_scanning() {
    use slideway::solve::solve;
    let report = against_locking(&model("cam-follower"), "phi", 2.0);
    let margin = |phi: f64| {
        let at = Settings::default().parameter("phi", format!("{phi:e}"));
        let report = solve(&model("cam-follower").with(&at).expect("sound")).expect("sound");
        let moves = !report.solutions.is_empty();
        moves && report.margins.expect("few modes").no_solution.is_none_or(|margin| margin >= 2.0)
    };
    for step in 1..200 {
        let phi = report.vary.from + (report.vary.to - report.vary.from) * f64::from(step) / 200.0;
        let met = report.met.iter().any(|met| met.from <= phi && phi <= met.to);
        assert_eq!(met, margin(phi), "phi = {phi}");
    }
}

/// P = Q / (1 - 2 mu a / L) and N = P a / L with Q = 20 N, mu = 0.3, a = 0.3 m: for L up to 0.18 m no push
/// moves the drawer.
#[test]
fn a_drawer_is_sized_by_effort_normal_force_and_efficiency() {
    let drawer = model("drawer");
    let effort = |drive: Option<&str>| Against::Effort { drive: drive.map(str::to_owned) };
    let normal = |contact: Option<&str>| Against::NormalForce { contact: contact.map(str::to_owned) };
    let table = [
        // 1 - 0.18 / L = 2/3
        (effort(None), 30.0, 0.54),
        (effort(Some("push")), 30.0, 0.54),
        // 6 / (L - 0.18) = 25
        (normal(None), 25.0, 0.42),
        (normal(Some("guide.rear")), 25.0, 0.42),
        // 1 - 0.18 / L = 0.7
        (Against::Efficiency, 0.7, 0.6),
    ];
    for (against, limit, expected) in table {
        let report = sized(&drawer, "L", limit, against.clone());
        let (found, above) = only_end(&report);
        assert_close(found, expected, 0.0, 1e-12);
        assert!(above, "{against:?}");
        // In the model L = 0.4 m: P = 36.364 N, N = 27.273 N, efficiency 0.55.
        let present = match against {
            Against::Effort { .. } => 20.0 / 0.55,
            Against::NormalForce { .. } => 6.0 / 0.22,
            _ => 0.55,
        };
        assert_close(report.present.margin.unwrap(), present, 0.0, 1e-12);
        // The usual range begins at 0.08 m, where friction locks it.
        assert_eq!((report.samples[0].is, report.samples[0].margin), (SampleKind::NoSolution, None));
    }
    // Pulled back friction helps: the push of the model's direction decides.
    let options = SizeOptions::new(Vary::usual("L"), 30.0).against(effort(None)).both_directions(true);
    let (found, _) = only_end(&size(&drawer, &options).unwrap());
    assert_close(found, 0.54, 0.0, 1e-12);
}

/// The drawer with a parameter w, the width of its pads: 20 mm long at the inner end, 10 mm at the mouth.
fn drawer_with_pads() -> Model {
    let text = slideway::gallery::find("drawer").expect("in the gallery").text;
    let pads = [
        (r#"m = "5 kg""#, "w = \"15 mm\"\nm = \"5 kg\""),
        (r#"mu = "mu""#, "mu = \"mu\"\npad = { length = \"20 mm\", width = \"w\" }"),
        (r#"carried_by = "guide""#, r#"carried_by = "guide", pad = { length = "10 mm", width = "w" }"#),
    ];
    let text = pads.iter().fold(text.to_owned(), |text, (old, new)| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    });
    Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// p = N / (l w) with N = 6 N m / (L - 0.18 m) at both ends, as above; the shorter pad decides.
#[test]
fn a_drawer_is_sized_by_bearing_pressure() {
    let drawer = drawer_with_pads();
    let pressure = |contact: Option<&str>| Against::Pressure { contact: contact.map(str::to_owned) };
    let force = 6.0 / 0.22;
    let table = [
        // At 0.2 MPa a pad of 10 mm by 15 mm carries 30 N, the other one 60 N.
        ("L", None, 0.18 + 6.0 / 30.0),
        ("L", Some("guide.rear"), 0.18 + 6.0 / 30.0),
        ("L", Some("guide.front"), 0.18 + 6.0 / 60.0),
        ("w", None, force / (0.01 * 2e5)),
        ("w", Some("guide.front"), force / (0.02 * 2e5)),
    ];
    for (vary, contact, expected) in table {
        let report = sized(&drawer, vary, 2e5, pressure(contact));
        let (found, above) = only_end(&report);
        assert_close(found, expected, 0.0, 1e-12);
        assert!(above, "a longer guide and a wider pad are better");
        let length = if contact == Some("guide.front") { 0.02 } else { 0.01 };
        assert_close(report.present.margin.unwrap(), force / (length * 0.015), 0.0, 1e-12);
        assert_eq!((report.against, report.unit), (MarginKind::Pressure, "Pa"));
    }
    let limits =
        limits(&drawer, &LimitsOptions::new("w=5 mm..30 mm".parse().expect("a range"))).expect("sound");
    assert_eq!(limits.counts.len(), 1, "forces do not depend on pads: {:#?}", limits.counts);
}

#[test]
fn limits_of_pressures_are_told_in_the_unit_in_which_they_were_typed() {
    use slideway::report::{Report, Style};
    use slideway::units::Unit;
    let options = SizeOptions::new(Vary::usual("L"), 2e5)
        .against(Against::Pressure { contact: None })
        .typed_in(Unit::of_text("N/mm^2"));
    let text = size(&drawer_with_pads(), &options).expect("sound").text(Style::PLAIN.verbose(true));
    for sentence in [
        "To keep the greatest bearing pressure at 0.2 N/mm^2 or less: L at least 0.38 m (examined up to 2 m).",
        "The model has L = 0.4 m: the greatest bearing pressure is 0.18182 N/mm^2; the limit is kept.",
        "Where the greatest bearing pressure is at most 0.2 N/mm^2",
    ] {
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
}

/// Whoever asks for the pressure of a contact without a pad is told where to add one.
#[test]
fn a_pressure_needs_a_pad() {
    let asked = |model: &Model, contact: Option<&str>| {
        let against = Against::Pressure { contact: contact.map(str::to_owned) };
        let options = SizeOptions::new(Vary::usual("L"), 1e6).against(against);
        size(model, &options).unwrap_err().sorted()[0].kind.clone()
    };
    let (none, one) = (asked(&model("drawer"), None), asked(&model("drawer"), Some("guide.rear")));
    assert_eq!(none.to_string(), "no contact has a `pad`, so there is no bearing pressure");
    assert_eq!(one.to_string(), "the contact guide.rear has no `pad`, so there is no bearing pressure");
    assert!(none.hint().expect("a hint").contains("[joints.guide]"), "{none:?}");
    let unknown = asked(&drawer_with_pads(), Some("guide.middle"));
    assert!(matches!(unknown, FaultKind::UnknownName { .. }), "{unknown}");
}

#[test]
fn limits_of_forces_are_told_as_forces() {
    use slideway::report::{Report, Style};
    let effort = Against::Effort { drive: Some("push".to_owned()) };
    let text = sized(&model("drawer"), "L", 30.0, effort).text(Style::PLAIN.verbose(true));
    for sentence in [
        "To keep the greatest effort of push at 30 N or less: L at least 0.54 m (examined up to 2 m).",
        "The model has L = 0.4 m: the greatest effort of push is 36.364 N; the limit is not kept.",
        "Where the greatest effort of push is at most 30 N",
        "no solution",
    ] {
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
    assert!(!text.contains("safety factor"), "{text}");
}

#[test]
fn limits_of_what_is_not_there_are_refused() {
    let unknown = Against::NormalForce { contact: Some("guide.middle".to_owned()) };
    let faults =
        size(&model("drawer"), &SizeOptions::new(Vary::usual("L"), 1.0).against(unknown)).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::UnknownName { .. }), "{faults}");
    let efficiency = SizeOptions::new(Vary::usual("x"), 0.5).against(Against::Efficiency);
    let faults = size(&model("bracket-on-pole"), &efficiency).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::NoDrives { .. }), "{faults}");
}

/// Kinetic friction must not exceed static friction: the answers end there, which is no question of the margin.
#[test]
fn where_the_answers_end_before_the_range_the_sentence_says_so() {
    let text = slideway::gallery::find("drawer").unwrap().text;
    let text = text.replace("mu = \"mu\"", "mu = \"mu\"\nmu_static = 0.4");
    let drawer = Model::parse(&text).unwrap();
    let report = against_locking(&drawer, "mu=0..1", 1.5);
    // The margin L / (2 a mu) is 1.5 at mu = 4/9, and static friction ends the answers at 0.4 before.
    let [met] = &report.met[..] else { panic!("{:?}", report.met) };
    assert_eq!((met.from_is, met.to_is), (MetEnd::Range, MetEnd::NoPosition));
    assert!((met.to - 0.4).abs() < 1e-14);
    let told = &report.conclusion[0];
    assert!(told.contains("mu at most 0.4, above which there is no answer (examined down to 0)"), "{told}");
    let gap = &report.without_position[0];
    assert!(gap.reason.contains("static friction coefficient 0.4 of guide.front is below"), "{}", gap.reason);
    // Where the margin ends it first, nothing is said of it.
    let told = &against_locking(&drawer, "mu=0..0.4", 2.0).conclusion[0];
    assert!(!told.contains("no answer"), "{told}");
}

/// A factor of 5 around 45 deg would be 9 to 225 deg; in its quarter turn sine and cosine keep their signs.
#[test]
fn an_angle_is_sized_in_its_quarter_turn() {
    let range = |angle: &str| {
        let report = against_locking(&with("cam-follower", &[("phi", angle)]), "phi", 2.0);
        [report.vary.from, report.vary.to].map(|end| (end.to_degrees() * 1e9).round() / 1e9)
    };
    assert_eq!(range("30 deg"), [0.0, 90.0]);
    assert_eq!(range("-30 deg"), [-90.0, 0.0]);
    // Between two quarters both count.
    assert_eq!(range("0 deg"), [-90.0, 90.0]);
    assert_eq!(range("90 deg"), [0.0, 180.0]);
    // A flat wedge lifts nothing, so its wall does not slide: the answers begin at 0, and that is told.
    let wedge = against_locking(&model("wedge"), "alpha", 2.0);
    assert_eq!((wedge.met[0].from, wedge.met[0].from_is), (0.0, MetEnd::NoPosition));
    assert_eq!([wedge.without_position[0].from, wedge.without_position[0].to], [0.0, 0.0]);
    assert!(wedge.conclusion[0].contains("alpha from 0 deg, where there is no answer, to 56.6"));
    // A length keeps the factor.
    let report = against_locking(&model("cam-follower"), "d", 2.0);
    assert!((report.vary.to / report.vary.from - 25.0).abs() < 1e-12);
}

#[test]
fn a_design_says_for_which_position_it_holds() {
    let text = |report: &SizeReport| report.text(Style::PLAIN);
    let moved = model("drawer").with(&Settings::default().position("x", "50 mm")).expect("within its guide");
    let report = against_locking(&moved, "a=0.1 m..0.5 m", 1.0);
    assert_eq!((report.state.len(), &*report.state[0].name), (1, "x"));
    assert!((report.state[0].value - 0.05).abs() < 1e-15);
    assert!(text(&report).contains("\nx = 0.05 m, rate "), "{}", text(&report));
    // Not of the coordinate that is varied.
    let report = against_locking(&model("drawer"), "x=0 m..0.1 m", 1.0);
    assert!(report.state.is_empty());
    let held = sized(&model("bracket-on-pole"), "x=0.1 m..0.5 m", 1.0, to_hold("W"));
    assert!(text(&held).contains("\nAt rest at z = 0 mm\n"), "{}", text(&held));
    let options = LimitsOptions::new("mu=0..1".parse().expect("a range"));
    let limits = limits(&moved, &options).expect("sound").text(Style::PLAIN);
    assert!(limits.contains("\nx = 0.05 m, rate "), "{limits}");
}
