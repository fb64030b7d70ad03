//! A pendulum on a rough pin that has nothing to do with the rest of a mechanism changes no answer about the rest: those of
//! `solve`, `drive`, `limits` and `hold`.
//!
//! Not compared is what is not computed with friction in hinges: factors of friction from which on drives have no solution, and
//! answers on redundant guides in motion, which are refused then. Margins and limits hold for all friction together; the
//! pendulum's own mode ends beyond 20 times its friction.

use super::random_linkages::Random;
use super::unrelated::{beside_a_pendulum, cart_and_block, is_planar, may_lift_off};
use slideway::report::Solution;
use slideway::standstill::{Range, Reactions};
use slideway::{
    DriveOptions, HoldOptions, LimitsOptions, Model, Vary, check, drive, gallery, hold, limits, solve,
};
use std::fmt::Write;

const TOLERANCE: f64 = 1e-6;
/// A factor of friction with which the pendulum still swings in its mode.
const BEFORE_ITS_END: f64 = 20.0;

/// What is told of all but the pendulum: words that have to be the same, and numbers.
#[derive(Default)]
struct Told {
    words: Vec<String>,
    numbers: Vec<f64>,
}

impl Told {
    fn say(&mut self, words: impl std::fmt::Debug) {
        self.words.push(format!("{words:?}"));
    }

    fn range(&mut self, Range { least, greatest }: Range) {
        self.say([least.is_some(), greatest.is_some()]);
        self.numbers.extend([least, greatest].into_iter().flatten());
    }

    fn reactions(&mut self, reactions: &Reactions) {
        for contact in &reactions.contacts {
            self.range(contact.normal_force);
            self.range(contact.friction_force);
            contact.couple.iter().for_each(|couple| self.range(*couple));
        }
        for hinge in reactions.hinges.iter().filter(|hinge| hinge.name != "unrelated") {
            hinge.force.iter().chain(&hinge.couple).for_each(|range| self.range(*range));
        }
        reactions.drives.iter().for_each(|drive| self.range(drive.effort));
    }

    fn solution(&mut self, solution: &Solution) {
        self.say((&solution.pattern, &solution.signs, solution.on_boundary, solution.attainability.verdict));
        let margin = solution.margin.as_ref().and_then(|margin| margin.factor);
        self.numbers.push(margin.map_or(BEFORE_ITS_END, |margin| margin.min(BEFORE_ITS_END)));
        let contacts = solution.contacts.iter();
        self.numbers.extend(contacts.flat_map(|contact| [contact.normal_force, contact.friction_force]));
        let hinges = solution.hinges.iter().filter(|hinge| hinge.name != "unrelated");
        self.numbers.extend(hinges.flat_map(|hinge| hinge.force));
        let coordinates = solution.coordinates.iter().filter(|one| one.name != "unrelated");
        self.numbers.extend(coordinates.map(|coordinate| coordinate.acceleration));
        self.numbers.extend(solution.drives.iter().map(|drive| drive.effort));
    }
}

fn solved(model: &Model) -> Option<Told> {
    let report = solve(model).ok()?;
    let mut told = Told::default();
    told.say((report.status, &report.count, &report.gap_state_count, report.complete));
    report.solutions.iter().chain(&report.preload_gap_states).for_each(|solution| told.solution(solution));
    Some(told)
}

fn driven(model: &Model) -> Option<Told> {
    let report = drive(model, &DriveOptions::default()).ok()?;
    let mut told = Told::default();
    for direction in &report.directions {
        told.say((direction.direction, direction.status));
        told.numbers.extend(&direction.frictionless.efforts);
        for solution in &direction.solutions {
            told.say((&solution.pattern, solution.attainability, solution.efficiency.is));
            told.numbers.extend(&solution.efforts);
            told.numbers.extend(solution.efficiency.value);
        }
    }
    Some(told)
}

/// Over the factor of friction.
fn limited(model: &Model) -> Option<Told> {
    let report = limits(model, &LimitsOptions::new(Vary::between("friction", 0.0, 3.0))).ok()?;
    let mut told = Told::default();
    for mode in &report.modes {
        told.say((&mode.pattern, mode.from_is, mode.to_is));
        told.numbers.extend([mode.from, mode.to].map(|end| end.unwrap_or(-1.0)));
    }
    for count in &report.counts {
        told.say((count.solutions, count.preload_gap_states, count.continuum));
        told.numbers.extend([count.from, count.to]);
    }
    Some(told)
}

fn held(model: &Model) -> Option<Told> {
    let report = hold(model, &HoldOptions::default()).ok()?;
    let mut told = Told::default();
    told.say((report.verdict, report.undecided, &report.motions_without_inertia));
    if let Some(rest) = &report.at_rest {
        told.say((&rest.patterns, &rest.wedging, rest.without_preloads));
        told.reactions(&rest.reactions);
    }
    for release in &report.releases {
        told.say((release.joints.iter().map(|joint| joint.slip).collect::<Vec<_>>(), &release.patterns));
        let coordinates = release.coordinates.iter().filter(|one| one.name != "unrelated");
        coordinates.for_each(|coordinate| told.range(coordinate.acceleration));
        told.reactions(&release.reactions);
    }
    Some(told)
}

/// Asks a question about a model; nothing where it is refused.
type Ask = fn(&Model) -> Option<Told>;

/// The difference that the pendulum makes to an answer.
fn difference(text: &str, pendulum: ([f64; 2], f64), ask: Ask) -> Option<String> {
    let beside = beside_a_pendulum(text, pendulum.0, pendulum.1);
    let [alone, beside] = [text, &beside].map(|text| ask(&Model::parse(text).unwrap()));
    let (Some(alone), Some(beside)) = (&alone, &beside) else {
        let answered = [&alone, &beside].map(Option::is_some);
        return (answered[0] != answered[1]).then(|| format!("answered {answered:?}"));
    };
    if alone.words != beside.words {
        return Some(format!("{:?}\n    {:?}", alone.words, beside.words));
    }
    let greatest = alone.numbers.iter().fold(1.0_f64, |greatest, number| greatest.max(number.abs()));
    let pairs = alone.numbers.iter().zip(&beside.numbers);
    let same = alone.numbers.len() == beside.numbers.len()
        && pairs.into_iter().all(|(one, other)| (one - other).abs() <= TOLERANCE * greatest);
    (!same).then(|| format!("{:?}\n    {:?}", alone.numbers, beside.numbers))
}

const SWINGS: ([f64; 2], f64) = ([0.02, -0.04], 2.0);
/// Nothing moves it, whatever the direction of gravity.
const BALANCED: ([f64; 2], f64) = ([0.0; 2], 0.0);

/// The differences in all questions, each in a line.
fn differences((name, only_rest): (&str, bool), text: &str, failed: &mut String) {
    let questions: [(&str, _, Ask); 4] = [
        ("hold", BALANCED, held),
        ("solve", SWINGS, solved),
        ("drive", SWINGS, driven),
        ("limits", SWINGS, limited),
    ];
    for (question, pendulum, ask) in &questions[..if only_rest { 1 } else { 4 }] {
        if let Some(difference) = difference(text, *pendulum, *ask) {
            writeln!(failed, "{name}, {question}: {difference}").unwrap();
        }
    }
}

#[test]
fn an_unrelated_pendulum_changes_no_answer_about_the_gallery() {
    let mut failed = String::new();
    let is_taken = |text: &str| !may_lift_off(text) && is_planar(text);
    for model in gallery::MODELS.iter().filter(|model| is_taken(model.text)) {
        let check = check(&Model::parse(model.text).unwrap()).unwrap();
        differences((model.name, !check.is_ready_for("simulate")), model.text, &mut failed);
    }
    assert!(failed.is_empty(), "{failed}");
}

fn random_mechanisms(count: u64) {
    let mut failed = String::new();
    for seed in 1..=count {
        differences((&seed.to_string(), false), &cart_and_block(&mut Random(seed)), &mut failed);
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn an_unrelated_pendulum_changes_no_answer_about_random_mechanisms() {
    random_mechanisms(30);
}

#[test]
#[ignore = "takes minutes"]
fn an_unrelated_pendulum_changes_no_answer_about_a_thousand_mechanisms() {
    random_mechanisms(1000);
}
