//! Friction that depends on the sliding speed, in states: the drawer of the gallery with mu = 0.3 + c v.
//!
//! Its push is V = Q/(1 - 2 mu a/L) with L = 0.4 m, a = 0.3 m, Q = 20 N (reference/README.md), and it locks
//! at mu = 2/3.

use crate::answers::{assert_close, contact, parameters, report_on, try_report_on};
use slideway::drive::{DriveOptions, drive};
use slideway::fault::FaultKind;
use slideway::gallery;
use slideway::limits::{LimitsMethod, LimitsOptions, Vary, limits};
use slideway::model::{Model, Settings};
use slideway::report::{Proof, Status};
use slideway::size::{SizeOptions, size};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, hold};
use slideway::sweep::{Rows, Sweep, SweepOptions};
use std::ops::ControlFlow;

const LAW: &str = "mu = \"mu + c*sliding_speed\"";

fn text(law: &str) -> String {
    let drawer = gallery::find("drawer").unwrap().text;
    assert!(drawer.contains("\nmu = \"mu\"\n"));
    drawer
        .replace("\nmu = \"mu\"\n", &format!("\n{law}\n"))
        .replace("[parameters]", "[parameters]\nc = \"0.5 s/m\"")
}

fn drawer() -> Model {
    Model::parse(&text(LAW)).unwrap()
}

fn push(mu: f64) -> f64 {
    20.0 / (1.0 - 2.0 * mu * 0.3 / 0.4)
}

/// The first kind of fault of a text.
fn fault(text: &str) -> FaultKind {
    try_report_on(text).unwrap_err().sorted()[0].kind.clone()
}

#[test]
fn solve_takes_friction_at_the_speed_of_the_state_in_both_directions() {
    for (rate, v) in [("0.1", 0.1), ("-0.1", 0.1), ("0.4", 0.4), ("2.5e-9", 2.5e-9)] {
        let model = drawer().with(&Settings::default().rate("x", rate)).unwrap();
        let report = solve(&model).unwrap();
        assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
        let mu = 0.3 + 0.5 * v;
        let solution = &report.solutions[0];
        let front = contact(solution, "guide.front");
        assert_close(front.friction_force.abs(), mu * front.normal_force.abs(), 0.0, 1e-14);
        assert_close(
            solution.drives[0].effort,
            push(if rate.starts_with('-') { -mu } else { mu }),
            0.0,
            1e-12,
        );
    }
    // At 0.8 m/s mu = 0.7: nothing moves.
    let fast = drawer().with(&Settings::default().rate("x", "0.8 m/s")).unwrap();
    assert_eq!(solve(&fast).unwrap().status, Status::None);
}

/// It locks where 0.3 + c v = 2/3: over c in closed form, over the velocity by bracketing, over the factor of
/// friction.
#[test]
fn limits_follow_friction_over_whatever_changes_it() {
    let locks = |vary: &str| {
        let report = limits(&drawer(), &LimitsOptions::new(vary.parse().expect("a range"))).unwrap();
        let end = report.counts.iter().find(|count| count.solutions == 0).expect("it locks").from;
        (end, report.method)
    };
    let (c, method) = locks("c=0..10");
    assert_eq!(method, LimitsMethod::ClosedForm);
    assert_close(c, (2.0 / 3.0 - 0.3) / 0.1, 0.0, 1e-12);
    let (v, method) = locks("v=0.01 m/s..2 m/s");
    assert_eq!(method, LimitsMethod::Bracketing);
    assert_close(v, (2.0 / 3.0 - 0.3) / 0.5, 0.0, 1e-9);
    let (factor, _) = locks("friction=0..4");
    assert_close(factor, 2.0 / 3.0 / 0.35, 0.0, 1e-12);
    let report = size(&drawer(), &SizeOptions::new(Vary::between("c", 0.0, 10.0), 1.5)).unwrap();
    assert_close(report.met[0].to, (2.0 / 3.0 / 1.5 - 0.3) / 0.1, 0.0, 1e-9);
    let efforts = drive(&drawer(), &DriveOptions::default()).unwrap();
    assert_close(efforts.directions[0].solutions[0].efforts[0], push(0.35), 0.0, 1e-12);
}

/// Each point of a sweep has the friction of its own speed; so has a common factor.
#[test]
fn sweeps_take_friction_at_the_speed_of_each_point() {
    for vary in ["x.rate=0.05..0.7:14", "v=0.05..0.7:14", "c=0.1..3:7", "friction=0.5..1.5:5"] {
        let sweep = vary
            .parse()
            .and_then(|axis| Sweep::new(&drawer(), &SweepOptions::grid([axis]).breakpoints(false)));
        let sweep = sweep.unwrap();
        let effort = sweep.columns().iter().position(|column| column.name == "effort.push").unwrap();
        let mut points = 0;
        sweep.run(&mut sweep.start(), &Rows::clone, &mut |all, _| {
            for rows in &all {
                for row in 0..rows.len() {
                    let value = rows.numbers(row)[0];
                    let mu = match &vary[..1] {
                        "f" => 0.35 * value,
                        "c" => 0.3 + value * 0.1,
                        _ => 0.3 + 0.5 * value,
                    };
                    assert_close(rows.numbers(row)[effort], push(mu), 0.0, 1e-9);
                    points += 1;
                }
            }
            ControlFlow::<()>::Continue(())
        });
        assert!(points >= 5, "{vary} {points}");
    }
}

/// At rest the law counts at the speed zero: static friction is 0.3 without a value of its own.
#[test]
fn static_friction_is_the_limit_at_speed_zero() {
    let options = HoldOptions::default().load("push");
    let held = hold(&drawer(), &options).unwrap().load.unwrap().held;
    assert_close(held[0].greatest.unwrap(), push(0.3), 0.0, 1e-9);
    assert_close(held[0].least.unwrap(), push(-0.3), 0.0, 1e-9);
    // The kinetic coefficient may grow beyond a static one that is not below mu at rest.
    let report = report_on(&text(&format!("{LAW}\nmu_static = 0.31")));
    assert_eq!(report.status, Status::One);
}

/// What holds for a range of a parameter holds for the friction that it makes.
#[test]
fn uncertain_laws_and_speeds_are_enclosed() {
    let text = text(LAW).replace("v = \"0.1 m/s\"", "v = \"0.05 m/s .. 0.15 m/s\"");
    let certain = report_on(&text).uncertainty.unwrap();
    assert_eq!((certain.least_solutions, certain.most_solutions), (1, Some(1)));
    let bounds = certain.modes[0].normal_force_bounds.as_ref().unwrap()[0];
    // |N| = a V/L.
    let [least, greatest] = [0.05, 0.15].map(|v| 0.75 * push(0.3 + 0.5 * v));
    let [low, high] = if bounds[0] < 0.0 { [-bounds[1], -bounds[0]] } else { bounds };
    assert!(low <= least && greatest <= high && high - low < 2.0 * (greatest - least), "{bounds:?}");
    // Up to 1 m/s it locks somewhere.
    let text = text.replace("0.15 m/s", "1 m/s");
    assert_ne!(report_on(&text).uncertainty.unwrap().least_solutions, 1);
}

#[test]
fn laws_without_sense_are_refused() {
    let law = |law: &str| fault(&text(law));
    // A bare number takes the dimension of the other term.
    assert!(matches!(law("mu = \"0.3 + sliding_speed\""), FaultKind::WrongDimension { .. }));
    assert!(matches!(law("mu = \"c*sliding_speed*(1 m)\""), FaultKind::WrongDimension { .. }));
    assert!(
        matches!(law(&format!("{LAW}\nmu_static = 0.2")), FaultKind::StaticBelowKinetic { mu, .. } if mu == 0.3)
    );
    assert!(matches!(
        law("mu = \"0.3*t/second\""),
        FaultKind::DependsOnMotion { .. } | FaultKind::Expression(_)
    ));
    for (law, speed) in
        [("mu = \"0.01 m/s/sliding_speed\"", 0.0), ("mu = \"0.01 - 0.5*sliding_speed/(1 m/s)\"", 0.1)]
    {
        let kind = fault(&text(law));
        assert!(
            matches!(kind, FaultKind::AtSlidingSpeed { speed: at, .. } if (at - speed).abs() < 1e-15),
            "{kind}"
        );
    }
    for elsewhere in [
        format!("{LAW}\nmu_static = \"0.4 + c*sliding_speed\""),
        format!("{LAW}\npreload = \"(1 N*s/m)*sliding_speed\""),
    ] {
        assert!(matches!(fault(&text(&elsewhere)), FaultKind::DependsOnSlidingSpeed { .. }), "{elsewhere}");
    }
    let parameter = text(LAW).replace("mu = 0.3 ", "mu = \"0.3 + 0*sliding_speed/(1 m/s)\" ");
    assert!(matches!(fault(&parameter), FaultKind::DependsOnSlidingSpeed { .. }));
    let load = text(LAW).replace("[\"-Q\", 0]", "[\"-Q*sliding_speed/(1 m/s)\", 0]");
    assert!(matches!(fault(&load), FaultKind::DependsOnSlidingSpeed { .. }));
    let named = text(LAW).replace("c = \"0.5 s/m\"", "c = \"0.5 s/m\"\nsliding_speed = 1");
    assert!(matches!(fault(&named), FaultKind::InvalidName { .. }));
    assert!(drawer().with(&parameters(&[("c", "-5 s/m")])).is_ok_and(|model| solve(&model).is_err()));
}

/// Of a static coefficient that is varied the value of the file does not matter beside a greater kinetic one: the least allowed
/// stands for it, and a sweep has the rows of a file in which it is allowed.
#[test]
fn what_is_varied_has_no_value_of_its_own() {
    let oscillator = gallery::find("frictional-oscillator").unwrap();
    let model = Model::parse(oscillator.text).unwrap();
    let more = Settings::default().parameter("mu", 0.275);
    assert!(model.with(&more).is_err());
    let varied = model.with_varied(&more, &["mu_static".to_owned()]).unwrap();
    let other = model.with(&more.parameter("mu_static", 0.275)).unwrap();
    assert_eq!(varied.constants().unwrap(), other.constants().unwrap());
    // What is allowed keeps its value, and what is no coefficient is no help.
    let same = model.with_varied(&Settings::default(), &["mu_static".to_owned()]).unwrap();
    assert_eq!(same.constants().unwrap(), model.constants().unwrap());
    assert!(model.with_varied(&Settings::default().parameter("mu", 0.275), &["k".to_owned()]).is_err());
}
