//! Decisions agree with `solve` where all joints slide, and with `hold` where all are at rest.

use crate::set_up::{State, assert_close, joints, may_lift_off, sides};
use slideway::check;
use slideway::configuration::Configuration;
use slideway::gallery::{GalleryModel, MODELS};
use slideway::ids::JointId;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::{JointKind, Mechanism};
use slideway::model::{Model, Settings};
use slideway::motion::decision::{Standing, successors};
use slideway::motion::{Continuation, Decisions, EventInstant, JointPhase, Thorough};
use slideway::progress::Work;
use slideway::report::{SolveReport, Verdict};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, hold};

/// A linear congruential generator (Knuth, The Art of Computer Programming, 3.3.4): numbers from 0 to 1.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A gallery model with its parameters of friction, masses and loads at random.
fn random_model(text: &str, random: &mut Random) -> Option<Model> {
    let model = Model::parse(text).unwrap();
    let mut settings = Settings::default();
    for parameter in &model.parameters {
        let name = &*parameter.name;
        if name.starts_with("mu") {
            settings = settings.parameter(name, format!("{:.4}", 1.5 * random.next()));
        } else if name == "direction" {
            settings = settings.parameter(name, if random.next() < 0.5 { "-1" } else { "1" });
        } else if name.starts_with("F_") && name.ends_with('0') {
            settings = settings.parameter(name, format!("{:.3} N", (10.0 * random.next() - 5.0).max(0.0)));
        }
    }
    model.with(&settings).ok()
}

fn patterns(report: &SolveReport) -> Vec<(String, Vec<f64>)> {
    let all = report.solutions.iter().chain(&report.preload_gap_states);
    let one = |solution: &slideway::report::Solution| {
        let signs = solution.signs.iter().map(|sign| match sign {
            1 => '+',
            -1 => '-',
            _ => '0',
        });
        (signs.collect(), solution.contacts.iter().map(|contact| contact.normal_force).collect())
    };
    let mut all: Vec<(String, Vec<f64>)> = all.map(one).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

/// With friction in hinges each solution of `solve` can follow, and nothing else, with the same hinge forces.
fn assert_turning(name: &str, state: &State, report: &SolveReport) {
    let State { mechanism, configuration } = state;
    let contacts = KineticEquations::new(mechanism, configuration).unwrap().contacts;
    let sliders = (0..mechanism.joints.len()).filter_map(|joint| mechanism.slider(JointId(joint)));
    let sliding = sliders.map(|slider| contacts[slider.contacts[0].index()].sliding_velocity.signum());
    let turning = mechanism.friction_circles.iter().map(|circle| {
        let JointKind::Hinge([first, second]) = &mechanism.joints[circle.joint.index()].kind else {
            panic!("a hinge")
        };
        let spin = configuration.angular_velocity(first.frame) - configuration.angular_velocity(second.frame);
        spin.signum()
    });
    let instant = EventInstant {
        mechanism,
        configuration,
        signs: &sliding.collect::<Vec<f64>>(),
        spins: &turning.collect::<Vec<f64>>(),
        zero: &[],
        previous: None,
        work: Work::undisturbed(),
        rounding: &[],
    };
    let found = Thorough.successors(&instant).unwrap();
    assert!(!found.left_out);
    assert_eq!(found.list.len(), report.solutions.len(), "{name}");
    for solution in &report.solutions {
        let rough: Vec<[f64; 2]> = solution
            .hinges
            .iter()
            .filter(|hinge| hinge.friction.is_some())
            .map(|hinge| hinge.force)
            .collect();
        let scale = rough.iter().flatten().fold(0.0_f64, |greatest, force| greatest.max(force.abs()));
        let agrees = |one: &&Continuation| {
            let both = one.phase.hinges.iter().map(|hinge| hinge.force).zip(&rough);
            let mut components = both.flat_map(|(found, force)| [0, 1].map(|axis| found[axis] - force[axis]));
            components.all(|difference| difference.abs() <= 1e-7 * scale)
        };
        let same: Vec<&Continuation> = found.list.iter().filter(agrees).collect();
        let [one] = same[..] else { panic!("{name}: {} agree with one solution", same.len()) };
        let found_sides = sides(&one.phase);
        let mut both = found_sides.chars().zip(&solution.signs);
        assert!(both.all(|(side, sign)| (side == '+') == (*sign == 1)), "{name}");
        let never = one.verdict == Verdict::Unattainable;
        assert!(!never || solution.attainability.verdict != Verdict::Attainable, "{name}");
    }
}

/// The models of the gallery whose motion in time is computed, but for contacts that may lift off, of which `successors` has no list.
fn moving() -> impl Iterator<Item = &'static GalleryModel> {
    let is_ready =
        |entry: &&GalleryModel| check(&Model::parse(entry.text).unwrap()).unwrap().is_ready_for("simulate");
    MODELS.iter().filter(is_ready).filter(|entry| !may_lift_off(entry.text))
}

#[test]
fn sliding_mechanisms_have_the_solutions_of_solve() {
    let mut random = Random(2002);
    let (mut compared, mut several, mut none, mut gaps, mut turning) = (0, 0, 0, 0, 0);
    for entry in moving() {
        for _ in 0..60 {
            let Some(model) = random_model(entry.text, &mut random) else { continue };
            let Ok(report) = solve(&model) else { continue };
            let on_boundary = report.solutions.iter().any(|one| one.on_boundary || one.signs.contains(&0));
            if on_boundary || !report.continua.is_empty() {
                continue;
            }
            let state = State::of(&model);
            if !state.mechanism.friction_circles.is_empty() {
                assert_turning(entry.name, &state, &report);
                turning += 1;
                continue;
            }
            let found = state.successors(&vec![false; slider_count(&state)], None);
            assert!(found.unsolved.is_empty());
            let mut found_patterns: Vec<(String, Vec<f64>)> =
                found.list.iter().map(|one| (sides(&one.phase), one.state.normal_forces.clone())).collect();
            found_patterns.sort_by(|a, b| a.0.cmp(&b.0));
            let expected = patterns(&report);
            let names =
                |list: &[(String, Vec<f64>)]| list.iter().map(|one| one.0.clone()).collect::<Vec<_>>();
            assert_eq!(names(&found_patterns), names(&expected), "{} {}", entry.name, found.list.len());
            for ((pattern, found), (_, expected)) in found_patterns.iter().zip(&expected) {
                let scale = expected.iter().map(|n| n.abs()).fold(0.0, f64::max);
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).abs() <= 1e-9 * scale, "{} {pattern}", entry.name);
                }
            }
            for one in &found.list {
                let other = report.solutions.iter().find(|other| {
                    let signs: Vec<i8> = other.signs.clone();
                    signs.iter().zip(sides(&one.phase).chars()).all(|(sign, c)| match c {
                        '+' => *sign == 1,
                        '-' => *sign == -1,
                        _ => *sign == 0,
                    })
                });
                if let Some(other) = other {
                    assert_eq!(one.attainability.verdict, other.attainability.verdict, "{}", entry.name);
                    for (index, coordinate) in other.coordinates.iter().enumerate() {
                        let found = one.state.coordinate_accelerations[index];
                        let scale = coordinate.acceleration.abs().max(1.0);
                        assert!((found - coordinate.acceleration).abs() <= 1e-8 * scale, "{}", entry.name);
                    }
                }
            }
            compared += 1;
            several += usize::from(expected.len() > 1);
            none += usize::from(expected.is_empty());
            gaps += report.preload_gap_states.len();
        }
    }
    assert!(compared > 300 && several > 10 && none > 5 && gaps > 0, "{compared} {several} {none} {gaps}");
    assert!(turning > 100, "{turning}");
}

/// A mechanism at rest; nothing where `solve` cannot treat it, either.
fn at_rest(model: &Model) -> Option<State> {
    let mut mechanism = Mechanism::new(model).ok()?;
    for coordinate in &mut mechanism.coordinates {
        coordinate.rate = 0.0;
    }
    let configuration = Configuration::new(&mechanism).ok()?;
    Some(State { mechanism, configuration })
}

fn has_frictionless_joint(mechanism: &Mechanism) -> bool {
    let is_smooth = |contact: &slideway::mechanism::Contact| {
        contact.mu == [0.0; 2] && contact.mu_static == [0.0; 2] && contact.preload == [0.0; 2]
    };
    mechanism.contacts.iter().any(is_smooth)
}

/// Joints of a release, as `joints` writes them.
fn slips(release: &slideway::standstill::Release) -> String {
    let symbol = |slip: i8| match slip {
        0 => 'o',
        1 => '+',
        _ => '-',
    };
    release.joints.iter().map(|joint| symbol(joint.slip)).collect()
}

#[test]
fn mechanisms_at_rest_do_what_hold_says() {
    let mut random = Random(1781);
    let options = HoldOptions::default().hold_drives(true);
    let (mut compared, mut held, mut released, mut both, mut partly) = (0, 0, 0, 0, 0);
    for entry in moving() {
        for _ in 0..25 {
            let Some(model) = random_model(entry.text, &mut random) else { continue };
            let Some(state) = at_rest(&model) else { continue };
            let count = slider_count(&state);
            let Ok(found) = successors(&state.mechanism, &state.configuration, &vec![true; count], None)
            else {
                continue;
            };
            let report = hold(&model, &options).unwrap_or_else(|faults| panic!("{faults}"));
            assert_eq!(report.undecided + found.unsolved.len(), 0);
            if found.list.iter().any(|one| matches!(one.standing, Standing::Undecided(_))) {
                continue;
            }
            let stands = |one: &slideway::motion::decision::Successor| {
                one.state.coordinate_accelerations.iter().all(|a| a.abs() < 1e-7)
            };
            // A joint without friction cannot stick: at rest it slides with no velocity.
            if has_frictionless_joint(&state.mechanism) {
                assert_eq!(found.list.iter().any(stands), report.holds, "{}", entry.name);
                continue;
            }
            let rests = |one: &slideway::motion::decision::Successor| {
                one.phase.joints.iter().all(|joint| *joint == JointPhase::Sticking) && stands(one)
            };
            assert_eq!(found.list.iter().any(rests), report.holds, "{}", entry.name);
            let mut expected: Vec<String> = report.releases.iter().map(slips).collect();
            let mut names: Vec<String> = joints(&found);
            names.retain(|name| !report.holds || name.contains(['+', '-']));
            partly += names.iter().filter(|name| name.contains('o')).count();
            expected.sort();
            expected.dedup();
            names.sort();
            names.dedup();
            assert_eq!(names, expected, "{}", entry.name);
            for one in &found.list {
                let name: String = joints_of(one);
                let within = |release: &slideway::standstill::Release| {
                    slips(release) == name
                        && release.coordinates.iter().zip(&one.state.coordinate_accelerations).all(
                            |(range, a)| {
                                let tolerance = 1e-6 * (1.0 + a.abs());
                                range.acceleration.least.is_none_or(|least| *a >= least - tolerance)
                                    && range
                                        .acceleration
                                        .greatest
                                        .is_none_or(|greatest| *a <= greatest + tolerance)
                            },
                        )
                };
                assert!(rests(one) || report.releases.iter().any(within), "{} {name}", entry.name);
            }
            compared += 1;
            held += usize::from(report.holds);
            released += usize::from(!report.releases.is_empty());
            both += usize::from(report.holds && !report.releases.is_empty());
        }
    }
    assert!(compared >= 120 && held > 20 && released > 20, "{compared} {held} {released} {both} {partly}");
}

fn joints_of(one: &slideway::motion::decision::Successor) -> String {
    let symbol = |joint: &JointPhase| match joint {
        JointPhase::Sticking => 'o',
        JointPhase::Sliding(sign) if *sign > 0.0 => '+',
        JointPhase::Sliding(_) => '-',
    };
    one.phase.joints.iter().map(symbol).collect()
}

#[test]
fn the_verdict_of_a_mechanism_that_holds_names_its_reactions() {
    // At rest in the paper's example F_1 may be anything from 0.009 to 0.071 m g (theory, section 8).
    let model = Model::parse(slideway::gallery::find("klepp-2002").unwrap().text).unwrap();
    let model = model.with(&Settings::default().parameter("F_20", "0").parameter("P", "0.08*m*g")).unwrap();
    let state = at_rest(&model).unwrap();
    let found = state.successors(&[true, true], None);
    let report = hold(&model, &HoldOptions::default()).unwrap();
    assert!(report.holds);
    let rest = report.at_rest.unwrap();
    let first = &found.list[0];
    for (k, contact) in rest.reactions.contacts.iter().enumerate() {
        let within = |range: slideway::standstill::Range, value: f64| {
            assert!(range.least.is_none_or(|least| value >= least - 1e-8), "{range:?} {value}");
            assert!(range.greatest.is_none_or(|greatest| value <= greatest + 1e-8), "{range:?} {value}");
        };
        within(contact.normal_force, first.state.normal_forces[k]);
        within(contact.friction_force, first.state.frictions[k].total());
    }
    let total: f64 = first.state.frictions.iter().map(|friction| friction.total()).sum();
    assert_close(total, 0.08 * 9.81, 0.0, 1e-10);
}

pub(crate) fn slider_count(state: &State) -> usize {
    let joints = 0..state.mechanism.joints.len();
    joints.filter(|joint| state.mechanism.slider(slideway::ids::JointId(*joint)).is_some()).count()
}
