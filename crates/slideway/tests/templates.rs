//! Every template meets the rule in its opening comment, evaluated here by hand, at its own values and at others.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::report::{ModeEndCause, Proof, Status, Style};
use slideway::standstill::HoldOptions;
use slideway::template::{FILE, TEMPLATES, find};
use slideway::{DriveOptions, Model, Report, Settings, check, drive, hold, solve};

/// A template with other values, as it would be written to a file.
fn model(name: &str, values: &[(&str, f64)]) -> Model {
    let set = |settings: Settings, (name, value): &(&str, f64)| settings.parameter(name, *value);
    let settings = values.iter().fold(Settings::default(), set);
    let text = find(name).unwrap().model(&settings, "mine.toml").unwrap_or_else(|faults| panic!("{faults}"));
    Model::parse(&text).unwrap_or_else(|faults| panic!("{text}\n{faults}"))
}

/// The only effort that the drive of a template needs, moving as in the model.
fn effort(name: &str, values: &[(&str, f64)]) -> f64 {
    effort_moving(0, name, values)
}

/// The same the other way, with the same loads.
fn effort_back(name: &str, values: &[(&str, f64)]) -> f64 {
    effort_moving(1, name, values)
}

fn effort_moving(direction: usize, name: &str, values: &[(&str, f64)]) -> f64 {
    let report = drive(&model(name, values), &DriveOptions::default()).unwrap();
    let [solution] = &report.directions[direction].solutions[..] else {
        panic!("{name}: {:?}", report.directions[direction])
    };
    solution.efforts[0]
}

/// Over the stroke the torque T = F r sin(phi + psi)/(cos(psi) -+ mu sin(psi)), with sin(psi) = (r/l) sin(phi), has one hump.
/// A million values of the formula: with r = 60 mm, l = 240 mm, F = 20 kN and mu = 0.12 it is greatest at 77.0902 deg, with
/// 1275.4856 N m, and holding the piston back at 76.3555 deg, with 1200.9369 N m.
#[test]
fn the_greatest_torque_of_a_press_is_told_with_its_place() {
    let sizes =
        [("r", 0.06), ("l", 0.24), ("F", 2e4), ("mu", 0.12), ("skirt", 0.08), ("bore", 0.06), ("phi", 0.7)];
    let options = DriveOptions::default().vary(Vary::between("phi", "5 deg", "175 deg"));
    let report = drive(&model("slider-crank", &sizes), &options).unwrap();
    let course = report.course.as_ref().unwrap();
    for (direction, (place, torque)) in
        course.directions.iter().zip([(77.0902, 1275.4856), (76.3555, 1200.9369)])
    {
        let [peak] = direction.peaks[..] else { panic!("{:?}", direction.peaks) };
        assert!((peak.at.to_degrees() - place).abs() < 1e-3, "{}", peak.at.to_degrees());
        assert!((peak.effort - torque).abs() < 1e-4, "{}", peak.effort);
    }
    let told = "Over phi from 5 to 175 deg, motor is greatest at 77.09 deg: 1275 N m. Backwards, over phi from 5 to 175 deg, \
                motor is greatest at 76.36 deg: 1201 N m.";
    assert!(report.answer().ends_with(told), "{}", report.answer());
    // Towards its jam, at mu = 1.125, the push of a drawer has no greatest value.
    let options = DriveOptions::default().vary(Vary::between("mu", 0.0, 2.0));
    let drawer = drive(&model("drawer", &[]), &options).unwrap().course.unwrap();
    assert!(drawer.directions.iter().all(|direction| direction.peaks.is_empty()), "{drawer:?}");
}

/// Whether a template that moves the other way, against a load turned round, too, has exactly one solution with
/// this friction, or none at all; both proven.
fn moves_back(name: &str, values: &[(&str, f64)], turned: &[(&str, f64)]) -> bool {
    let set = |settings: Settings, (name, value): &(&str, f64)| settings.parameter(name, *value);
    let back = model(name, values).with(&turned.iter().fold(Settings::default(), set)).unwrap();
    let report = solve(&back).unwrap();
    assert_eq!(report.complete, Proof::Proven, "{name} {values:?}");
    match report.status {
        Status::One => true,
        Status::None => false,
        status => panic!("{name} {values:?}: {status:?}"),
    }
}

/// Sees to it that it locks the other way at the same friction.
fn assert_locks_back_at(name: &str, mu: f64, values: &[(&str, f64)], turned: &[(&str, f64)]) {
    let with = |factor: f64| [values, &[("mu", factor * mu)]].concat();
    assert!(moves_back(name, &with(1.0 - 1e-6), turned), "{name} {values:?}: below {mu}");
    assert!(!moves_back(name, &with(1.0 + 1e-6), turned), "{name} {values:?}: above {mu}");
}

fn assert_close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{what}: {found} is not {expected}");
}

/// Whether the template has exactly one solution with this friction, or none at all; both proven.
fn moves(name: &str, values: &[(&str, f64)]) -> bool {
    let report = solve(&model(name, values)).unwrap();
    assert_eq!(report.complete, Proof::Proven, "{name} {values:?}");
    match report.status {
        Status::One => true,
        Status::None => false,
        status => panic!("{name} {values:?}: {status:?}"),
    }
}

/// Sees to it that the template moves below this friction and locks above it.
fn assert_locks_at(name: &str, mu: f64, values: &[(&str, f64)]) {
    let with = |factor: f64| [values, &[("mu", factor * mu)]].concat();
    assert!(moves(name, &with(1.0 - 1e-6)), "{name} {values:?}: below {mu}");
    assert!(!moves(name, &with(1.0 + 1e-6)), "{name} {values:?}: above {mu}");
}

#[test]
fn opening_comments_and_parameters_are_read() {
    for template in TEMPLATES {
        let model = Model::parse(template.text).unwrap();
        let found: Vec<&str> = template.parameters().map(|parameter| parameter.name).collect();
        let expected: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.name).collect();
        assert_eq!(found, expected, "{}", template.name);
        assert!(template.parameters().all(|parameter| !parameter.meaning.is_empty()), "{}", template.name);
        assert!(
            template.rule().ends_with('.') && template.text.contains("\n# Source: "),
            "{}",
            template.name
        );
        let way_back = template.way_back();
        assert!(way_back.ends_with('.') && !template.rule().contains(&way_back), "{}", template.name);
        assert!(template.commands().count() >= 2, "{}", template.name);
        assert!(
            template.commands().all(|command| command.split(' ').nth(2) == Some(FILE)),
            "{}",
            template.name
        );
    }
}

#[test]
fn values_stand_in_the_file_as_they_were_given() {
    let drawer = find("drawer").unwrap();
    let settings = Settings::default().parameter("L", "400mm").parameter("mu", "0.35").parameter("a", "L/ 3");
    let text = drawer.model(&settings, "my drawer.toml").unwrap();
    for line in [
        "L = \"400mm\"                # length over which it is guided",
        "mu = 0.35                  # friction coefficient of the guide",
        "a = \"L/ 3\"                 # distance of the push from the middle",
        "#   slideway drive my drawer.toml",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    assert!(!text.contains(FILE));
    assert_eq!(text.lines().count(), drawer.text.lines().count());
}

#[test]
fn wrong_units_unknown_names_and_what_cannot_be_assembled_are_faults() {
    for (name, parameter, value, says) in [
        ("drawer", "L", "400 kg", "a mass where a length is expected"),
        ("drawer", "L", "400", "without a unit"),
        ("drawer", "length", "400 mm", "length"),
        ("wedge", "mu", "-0.1", "must be at least zero"),
        // The crank pin is 40 mm * sin(60 deg) = 34.6 mm beside the axis of the cylinder.
        ("slider-crank", "l", "10 mm", "the parts do not meet with l = 10 mm (length of the connecting rod)"),
        ("peg", "l", "0 mm", "greater than zero"),
        ("peg", "l", "100 mm", "l <= h is needed: no more of the peg is in the hole than there is of it"),
        ("peg", "h", "1 cm", "l <= h is needed"),
        ("peg", "e", "-1 mm", "e >= 0 mm is needed"),
        ("drawer", "Q", "-15 N", "Q >= 0 N is needed: the resistance is against the push"),
        ("drawer", "v", "0 mm/s", "v > 0 mm/s is needed"),
        ("sash", "a", "0.6 m", "a <= b/2 is needed: the pull is at the sash"),
        ("carriage", "v", "-100 mm/s", "v > 0 mm/s is needed"),
        ("bushing", "phi", "90 deg", "phi < 90 deg is needed"),
        ("telescope", "x", "-0.1 m", "x >= 0 mm is needed"),
        ("cylinder", "S", "-500 N", "S >= 0 N is needed"),
        ("bracket", "x", "-300 mm", "x >= 0 mm is needed"),
        ("wedge", "alpha", "-10 deg", "alpha >= 0 deg is needed"),
        ("slider-crank", "phi", "-60 deg", "phi > 0 deg is needed"),
    ] {
        let settings = Settings::default().parameter(parameter, value);
        let faults = find(name).unwrap().model(&settings, "x.toml").unwrap_err();
        assert!(faults.to_string().contains(says), "{name} {parameter}={value}: {faults}");
    }
}

#[test]
fn drawer() {
    for (length, offset, mu, width) in [(0.4, 0.15, 0.3, 0.0), (0.3, 0.2, 0.5, 0.6), (0.5, 0.4, 0.1, 0.45)] {
        let values = [("L", length), ("a", offset), ("width", width)];
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        let lever = 2.0 * mu * offset / length;
        assert_close(effort("drawer", &with_friction), 20.0 / (1.0 - lever), "P");
        assert_close(effort_back("drawer", &with_friction), 20.0 / (1.0 + lever), "P, braking");
        assert_locks_at("drawer", length / (2.0 * offset), &values);
        let turned = [("v", -0.1), ("Q", -20.0)];
        assert_locks_back_at("drawer", length / (2.0 * offset), &values, &turned);
    }
    // The rectangle of 450 mm x 500 mm that the independent review measured: 8 kg / 12 (0.45^2 + 0.5^2) m^2.
    let desk = model("drawer", &[("L", 0.45), ("a", 0.2), ("width", 0.5), ("m", 8.0)]);
    assert_close(check(&desk).unwrap().bodies[0].moment_of_inertia, 8.0 / 12.0 * 0.4525, "inertia");
    // At rest it can be wedged from mu = L/width on.
    for (mu, wedges) in [(0.499, false), (0.501, true)] {
        let model = model("drawer", &[("L", 0.4), ("width", 0.8), ("mu", mu)]);
        let rest = hold(&model, &HoldOptions::default()).unwrap().at_rest;
        assert_eq!(rest.is_some_and(|rest| rest.wedging.len() == 2), wedges, "{mu}");
    }
}

#[test]
fn sash() {
    for (width, height, offset, mu, mass) in
        [(0.9, 0.6, 0.45, 0.3, 8.0), (1.2, 0.5, 0.2, 0.6, 5.0), (0.6, 1.0, 0.3, 1.2, 12.0)]
    {
        let values = [("b", width), ("H", height), ("a", offset), ("m", mass)];
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        let lever = 2.0 * mu * offset / height;
        assert_close(effort("sash", &with_friction), mass * 9.81 / (1.0 - lever), "P");
        assert_locks_at("sash", height / (2.0 * offset), &values);
        assert_close(effort_back("sash", &with_friction), mass * 9.81 / (1.0 + lever), "P, lowered");
    }
    // From mu = H/b on it can stay up without any pull.
    for (mu, wedges) in [(0.666, false), (0.667, true)] {
        let report = hold(&model("sash", &[("mu", mu)]), &HoldOptions::default()).unwrap();
        assert_eq!(report.at_rest.is_some_and(|rest| rest.wedging.len() == 2), wedges, "{mu}");
    }
}

#[test]
fn carriage() {
    for (length, offset, mu, mass) in [(0.06, 0.1, 0.15, 1.5), (0.1, -0.2, 0.2, 3.0), (0.05, 0.03, 0.7, 1.0)]
    {
        let values = [("L", length), ("a", offset), ("m", mass)];
        assert_close(effort("carriage", &[&values[..], &[("mu", mu)]].concat()), mu * mass * 9.81, "P");
        let limit = length / (2.0 * f64::abs(offset));
        assert_locks_at("carriage", limit, &values);
        assert_locks_back_at("carriage", limit, &values, &[("v", -0.1)]);
    }
    // The rule of 2 : 1.
    // Its effort stays finite, so that drive says it in words: 0.25 / 0.2 = 1.25 times.
    let model = model("carriage", &[("L", 0.06), ("a", 0.12), ("mu", 0.2)]);
    let report = drive(&model, &DriveOptions::default()).unwrap();
    let told = "It would jam from mu = 0.25 (1.25 times this friction), suddenly: up to there the force stays finite.";
    assert!(report.conclusion.iter().any(|sentence| sentence == told), "{:?}", report.conclusion);
    assert_locks_at("carriage", 0.25, &[("L", 0.06), ("a", 0.12)]);
}

/// `P = Q + mu (2 P a/L + max(W, 2 P h/L))`, whatever side of the rail pull and weight are on, and the rule of 2 : 1 for both
/// distances together.
#[test]
fn axis() {
    for (length, a, h, mu, y) in [
        (0.1, 0.06, 0.04, 0.2, 0.05),
        (0.1, -0.08, 0.11, 0.2, -0.3),
        (0.2, 0.05, -0.3, 0.1, 0.0),
        (0.15, 0.12, 0.0, 0.25, 0.1),
    ] {
        let values = [("L", length), ("a", a), ("h", h), ("y", y)];
        let (weight, resistance) = (4.0 * 9.81, 30.0);
        let part = |distance: f64| 2.0 * mu * f64::abs(distance) / length;
        let lies = (resistance + mu * weight) / (1.0 - part(a));
        let pitched = resistance / (1.0 - part(a) - part(h));
        let expected = if part(h) * lies <= mu * weight { lies } else { pitched };
        assert_close(effort("axis", &[&values[..], &[("mu", mu)]].concat()), expected, "P");
        let limit = length / (2.0 * (f64::abs(a) + f64::abs(h)));
        assert_locks_at("axis", limit, &values);
        assert_locks_back_at("axis", limit, &values, &[("v", -0.1), ("Q", -resistance)]);
    }
    assert_locks_at("axis", 0.25, &[("L", 0.1), ("a", 0.12), ("h", -0.08)]);
}

/// `P/W = [1 - k^2 p.q +- k sqrt(|p - q|^2 - k^2 (p x q)^2)]/(1 - k^2 p^2)`, `k = 2 mu/L`, lifted and lowered, and the rule of
/// 2 : 1 for the distance of the screw from the column.
#[test]
fn column() {
    for (length, p, q, mu) in [
        (0.1, [0.06, 0.04], [-0.08, 0.03], 0.15),
        (0.12, [0.0, 0.0], [0.08, 0.03], 0.15),
        (0.05, [-0.04, 0.07], [0.1, -0.2], 0.25),
        (0.1, [0.0, -0.15], [0.0, 0.05], 0.3),
    ] {
        let [[a, b], [y, z]] = [p, q];
        let values = [("L", length), ("a", a), ("b", b), ("y", y), ("z", z)];
        let (k, r) = (2.0 * mu / length, f64::hypot(a, b));
        let root = ((a - y).powi(2) + (b - z).powi(2) - (k * (a * z - b * y)).powi(2)).sqrt();
        let with =
            |sign: f64| 50.0 * (1.0 - k * k * (a * y + b * z) + sign * k * root) / (1.0 - k * k * r * r);
        let sized = [&values[..], &[("mu", mu)]].concat();
        assert_close(effort("column", &sized), with(1.0), "P lifted");
        assert_close(effort_back("column", &sized), with(-1.0), "P lowered");
        if r > 0.0 {
            assert_locks_at("column", length / (2.0 * r), &values);
        }
    }
    // In the axis of the column nothing jams, and a load holds itself from L/(2 q) on.
    let beside = [("a", 0.0), ("b", 0.0), ("y", 0.3), ("z", 0.4)];
    for (mu, holds) in [(0.099, false), (0.101, true)] {
        let sized = [&beside[..], &[("mu", mu)]].concat();
        assert!(moves("column", &sized));
        assert_eq!(effort_back("column", &sized) <= 0.0, holds);
    }
    assert_locks_at("column", 0.25, &[("L", 0.1), ("a", 0.12), ("b", -0.16)]);
}

#[test]
fn bushing() {
    for (degrees, bushing, overhang, diameter, mu) in
        [(30.0, 0.08, 0.05, 0.012, 0.15), (20.0, 0.05, 0.06, 0.0, 0.3), (45.0, 0.1, 0.02, 0.02, 0.2)]
    {
        let values = [("phi", f64::to_radians(degrees)), ("B", bushing), ("A", overhang), ("d", diameter)];
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let arm = |mu: f64| 2.0 * overhang + bushing - mu * diameter;
        let expected = 200.0 / (cos - mu / bushing * sin * arm(mu));
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        assert_close(effort("bushing", &with_friction), expected, "V");
        let held = 200.0 / (cos + mu / bushing * sin * arm(-mu));
        assert_close(effort_back("bushing", &with_friction), held, "V, moving back");
        // tan(phi) = B/(mu (2 A + B - mu d)), a quadratic equation of mu: its lesser root.
        let half = f64::midpoint(2.0 * overhang, bushing);
        let limit = bushing * cos / sin / (half + (half * half - diameter * bushing * cos / sin).sqrt());
        assert_close(sin / cos, bushing / (limit * arm(limit)), "tan(phi)");
        assert_locks_at("bushing", limit, &values);
    }
}

#[test]
fn telescope() {
    for (overlap, overhang, height, offset, mu) in
        [(0.2, 0.5, 0.06, 0.04, 0.2), (0.3, 0.4, 0.0, 0.1, 0.4), (0.15, 0.6, 0.1, 0.02, 0.3)]
    {
        let values = [("e", overlap), ("x", overhang), ("h", height), ("a", offset)];
        let expected = mu * 10.0 * 9.81 * (1.0 + (2.0 * overhang + mu * height) / overlap)
            / (1.0 - 2.0 * mu * offset / overlap);
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        assert_close(effort("telescope", &with_friction), expected, "P");
        let pulled = -mu * 10.0 * 9.81 * (1.0 + (2.0 * overhang - mu * height) / overlap)
            / (1.0 + 2.0 * mu * offset / overlap);
        assert_close(effort_back("telescope", &with_friction), pulled, "P, pulled in");
        assert_locks_at("telescope", overlap / (2.0 * offset), &values);
    }
}

#[test]
fn cylinder() {
    for (distance, overhang, side, gland, piston, seal) in [
        (0.15, 0.3, 500.0, 0.1, 0.15, 80.0),
        (0.05, 0.6, 200.0, 0.2, 0.1, 0.0),
        (0.3, 0.1, 1e3, 0.05, 0.3, 200.0),
    ] {
        let values = [
            ("e", distance),
            ("x", overhang),
            ("S", side),
            ("mu_gland", gland),
            ("mu_piston", piston),
            ("F_seal", seal),
        ];
        let expected = 5000.0 + seal + side * (gland * (distance + overhang) + piston * overhang) / distance;
        assert_close(effort("cylinder", &values), expected, "P");
        assert_close(effort_back("cylinder", &values), 2.0 * 5000.0 - expected, "P, pushed in");
        // However great the friction is.
        assert!(moves("cylinder", &[&values[..], &[("mu_gland", 20.0), ("mu_piston", 30.0)]].concat()));
    }
}

#[test]
fn bracket() {
    let held = |distance: f64, bearing: f64, mu: f64| {
        let model = model("bracket", &[("x", distance), ("B", bearing), ("mu_static", mu)]);
        let report = hold(&model, &HoldOptions::default().load("W").vary("mu_static")).unwrap();
        let load = report.load.unwrap();
        (load.self_locking, load.threshold.value.unwrap())
    };
    for (bearing, mu) in [(0.12, 0.25), (0.05, 0.15), (0.2, 0.4)] {
        let least = bearing / (2.0 * mu);
        assert!(held(1.001 * least, bearing, mu).0);
        assert!(!held(0.999 * least, bearing, mu).0);
        assert_close(held(0.8 * least, bearing, mu).1, mu / 0.8, "mu_static");
    }
}

#[test]
fn wedge() {
    for (degrees, mu, load) in [(10.0, 0.15, 1000.0), (5.0, 0.3, 50.0), (30.0, 0.1, 2e4)] {
        let alpha = f64::to_radians(degrees);
        let values = [("alpha", alpha), ("mu", mu), ("Q", load)];
        assert_close(effort("wedge", &values), load * (alpha + 2.0 * f64::atan(mu)).tan(), "P");
        let limit = ((f64::to_radians(90.0) - alpha) / 2.0).tan();
        assert_locks_at("wedge", limit, &[("alpha", alpha)]);
        if f64::atan(mu) < alpha {
            let back = load * (alpha - 2.0 * f64::atan(mu)).tan();
            assert_close(effort_back("wedge", &values), back, "P, pulled out");
        }
        // The load does not drive it out from alpha = 2 rho on.
        let model = model("wedge", &values);
        let report = hold(&model, &HoldOptions::default().load("Q").vary("mu")).unwrap();
        let threshold = report.load.unwrap().threshold.value.unwrap();
        assert_close(threshold, (alpha / 2.0).tan(), "mu");
    }
}

#[test]
fn slider_crank() {
    for (radius, rod, degrees, mu) in
        [(0.04, 0.14, 60.0, 0.1), (0.1, 0.15, 90.0, 0.3), (0.05, 0.2, 20.0, 0.0)]
    {
        let phi = f64::to_radians(degrees);
        let psi = f64::asin(radius / rod * phi.sin());
        let values = [("r", radius), ("l", rod), ("phi", phi)];
        let expected = 2000.0 * radius * (phi + psi).sin() / (psi.cos() - mu * psi.sin());
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        assert_close(effort("slider-crank", &with_friction), expected, "T");
        let back = 2000.0 * radius * (phi + psi).sin() / (psi.cos() + mu * psi.sin());
        assert_close(effort_back("slider-crank", &with_friction), back, "T, turning back");
        // A piston without width does not tip: it locks where tan(psi) = 1/mu.
        assert_locks_at("slider-crank", 1.0 / psi.tan(), &[&values[..], &[("bore", 0.0)]].concat());
    }
    // It lies flat up to mu = skirt/bore, and tips beyond it.
    for (mu, flat) in [(0.624, true), (0.626, false)] {
        let report = solve(&model("slider-crank", &[("mu", mu)])).unwrap();
        let [solution] = &report.solutions[..] else { panic!("{mu}: {:?}", report.status) };
        let [front, rear] = [0, 1].map(|contact| solution.contacts[contact].normal_force);
        assert_eq!(front * rear > 0.0, flat, "{mu}: {front}, {rear}");
    }
}

#[test]
fn peg() {
    for (depth, offset, diameter, mu) in
        [(0.015, 0.006, 0.02, 0.3), (0.04, 0.01, 0.03, 0.5), (0.01, 0.02, 0.0, 0.1)]
    {
        let values = [("l", depth), ("e", offset), ("D", diameter)];
        let with_friction = [&values[..], &[("mu", mu)]].concat();
        let lever = 2.0 * mu * offset / depth;
        assert_close(effort("peg", &with_friction), 5.0 / (1.0 - lever), "P");
        assert_close(effort_back("peg", &with_friction), 5.0 / (1.0 + lever), "P, braking");
        assert_locks_at("peg", depth / (2.0 * offset), &values);
        let turned = [("v", -1e-3), ("R", -5.0)];
        assert_locks_back_at("peg", depth / (2.0 * offset), &values, &turned);
    }
}

/// The width of the drawer is that of its shape, too: one fault about L is enough, the strictest.
#[test]
fn faults_name_the_template_s_parameters() {
    let drawer = find("drawer").expect("a template");
    let settings = Settings::default().parameter("L", "-100 mm").parameter("mu", "-0.1");
    let faults = drawer.model(&settings, "drawer.toml").expect_err("nothing can be that long");
    let told: Vec<String> = faults.sorted().iter().map(|fault| fault.kind.to_string()).collect();
    assert_eq!(
        told,
        [
            "L (length over which it is guided) must be greater than zero, but is -100 mm",
            "mu (friction coefficient of the guide) must be at least zero, but is -0.1"
        ]
    );
}

/// A carriage that lies flat on its rail jams from mu = L/(2 a) on, where a contact changes side: nothing is beyond.
#[test]
fn a_mode_that_ends_without_another_says_that_it_jams() {
    let options = LimitsOptions::new("mu=0..1".parse::<Vary>().unwrap());
    let report = limits(&model("carriage", &[]), &options).unwrap();
    let end = report.modes.iter().find_map(|mode| mode.to.filter(|_| mode.to_is == ModeEndCause::SideChange));
    assert_close(end.unwrap(), 60.0 / (2.0 * 100.0), "the end");
    let text = report.text(Style::PLAIN);
    assert!(text.contains("it jams: ") && text.contains("changes side"), "{text}");
}
