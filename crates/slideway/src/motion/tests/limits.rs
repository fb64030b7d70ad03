//! Where a simulation ends before its time, and what is refused.

use super::models::block;
use super::{mechanism_of, run};
use crate::configuration::Configuration;
use crate::expression::{Names, parse};
use crate::fault::{FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::modes::Side;
use crate::motion::{
    ContactPhase, Continuation, Continuations, Crossing, Decisions, End, EventFunction, EventInstant,
    HaltingImpulse, History, JointPhase, Phase, SimulateOptions, Thorough, UserEvent, report, simulate,
    simulate_all, simulate_with,
};
use crate::progress::Progress;
use crate::report::Verdict;
use std::ops::ControlFlow;

fn model(text: &str) -> Model {
    Model::parse(text).unwrap()
}

#[test]
fn durations_must_be_positive_and_of_a_size_that_can_be_computed_with() {
    let positive = "the duration must be greater than zero";
    let sized = "the duration must be from 1e-60 to 1e60";
    for (duration, wanted) in [
        (0.0, positive),
        (-1.0, positive),
        (f64::NAN, positive),
        (f64::INFINITY, sized),
        // Steps of such a duration vanish.
        (1e-320, sized),
        (1e300, sized),
    ] {
        let faults =
            simulate(&model(&block("0.25", "rate = 2", "")), &SimulateOptions::new(duration)).unwrap_err();
        let told = faults.to_string();
        assert!(told.starts_with(wanted), "{told}");
    }
}

/// A force without a value from t = 1.3 s on: what was computed is kept.
#[test]
fn a_force_that_ceases_to_have_a_value_ends_the_history() {
    let force = "
[loads.force]
type = \"force\"
at = \"block.C\"
components = [\"1 N * sqrt(1.3 - t/second)\", 0]
[parameters]
second = \"1 s\"
";
    let history = run(&block("0", "rate = 2", force), &SimulateOptions::new(2.0));
    let End::NoValue(faults) = &history.end else { panic!("{:?}", history.end) };
    assert!(faults.to_string().contains("sqrt"), "{faults}");
    assert!((history.stop() - 1.3).abs() < 1e-6, "{}", history.stop());
    // x = 2 t + (1/2) int int sqrt(1.3 - t) = 2 t + 1.3^(3/2) t / 3 - (2/15) (1.3^(5/2) - (1.3 - t)^(5/2))
    let expected = 2.6 + 1.3_f64.powf(2.5) / 3.0 - 2.0 / 15.0 * 1.3_f64.powf(2.5);
    let place = history.reader().at(history.stop()).unwrap().configuration.coordinates[0];
    assert!((place - expected).abs() < 1e-5, "{place} {expected}");
}

/// 2 t - 1.25 t^2 = 0.5 at t = (2 - sqrt(1.5)) / 2.5.
#[test]
fn travel_ends_it() {
    let text = block("0.25", "rate = 2", "").replace("mu = 0.25", "mu = 0.25\ntravel = [-1, 0.5]");
    let history = run(&text, &SimulateOptions::new(2.0));
    assert!(matches!(history.end, End::TravelLimit(_)));
    assert!((history.stop() - (2.0 - 1.5_f64.sqrt()) / 2.5).abs() < 1e-11, "{}", history.stop());
    assert!(history.events[1].words.ends_with("block reaches the greatest displacement of its travel"));
}

/// A block of 20 N that sticks is pressed down with (10 N/s) t more: each of its ends has half of it, 15 N
/// after 1 s. The same where it slides, and at once where the limit is less than 10 N.
#[test]
fn a_limit_of_normal_forces_counts_while_joints_stick() {
    let press = "
[loads.press]
type = \"force\"
at = \"block.C\"
components = [0, \"-10 N/s * t\"]
";
    for (start, limit, stop) in [("", 15.0, 1.0), ("rate = 30", 15.0, 1.0), ("", 9.5, 0.0)] {
        let options = SimulateOptions { reaction_limit: Some(limit), ..SimulateOptions::new(2.0) };
        let history = simulate(&model(&block("0.25", start, press)), &options).unwrap();
        assert!(matches!(history.end, End::ReactionLimit(_)), "{start} {:?}", history.end);
        assert!((history.stop() - stop).abs() < 1e-8, "{start} {}", history.stop());
        assert!(report(&history, &options).hints.is_empty());
    }
    let options = SimulateOptions { reaction_limit: Some(25.0), ..SimulateOptions::new(2.0) };
    assert_eq!(simulate(&model(&block("0.25", "", press)), &options).unwrap().end, End::Finished);
}

/// Klepp's bar after its jam: three contacts that stick in a mechanism with one degree of freedom leave the
/// normal forces open.
#[test]
fn what_a_limit_of_normal_forces_cannot_see_is_told() {
    let settings = [("F_20", "0"), ("mu_1", "0.46"), ("direction", "-1")];
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = super::model_of("klepp-2002").with(&settings).unwrap();
    let options = SimulateOptions { reaction_limit: Some(1e6), ..SimulateOptions::new(0.1) };
    let history = simulate(&model, &options).unwrap();
    assert_eq!(history.end, End::Finished);
    let hints = report(&history, &options).hints;
    assert!(
        hints.len() == 1 && hints[0].contains("statics does not determine the normal forces of"),
        "{hints:?}"
    );
}

/// A drawer whose supported length of 0.4 m is that from its rear end to the mouth: pulled out at 0.1 m/s it
/// leaves its guide after 4 s, with and without friction. (Normal forces and the determinant of the equations
/// have no bounds there.)
#[test]
fn a_block_that_leaves_its_guide_ends_it() {
    for mu in ["0", "0.3"] {
        let settings = Settings::default().parameter("v", "-0.1 m/s").parameter("mu", mu);
        let drawer = super::model_of("drawer").with(&settings).unwrap();
        for longest_step in [6e-3, 0.5] {
            let options = SimulateOptions { longest_step: Some(longest_step), ..SimulateOptions::new(6.0) };
            let history = simulate(&drawer, &options).unwrap();
            assert!(matches!(history.end, End::OverlapVanished(_)), "{mu}: {:?}", history.end);
            // A millionth of the length is the end.
            assert!((history.stop() - 4.0 * (1.0 - 1e-6)).abs() < 1e-9, "{mu}: {}", history.stop());
            assert_eq!(history.events.len(), 2, "{mu}");
        }
    }
}

/// Without friction the cylinder of the third stage pushes it out of the boom: F = 400 N on 20 kg and W = 300
/// N with its component along the boom, against the stage before.
#[test]
fn a_boom_without_friction_comes_apart() {
    let boom = super::model_of("telescopic-boom").with(&Settings::default().parameter("mu", "0")).unwrap();
    let history = simulate(&boom, &SimulateOptions::new(1.0)).unwrap();
    assert!(matches!(history.end, End::OverlapVanished(_)), "{:?}", history.end);
    let third = history.reader().configuration(history.stop()).unwrap().coordinates[2];
    assert!((third - 0.6 * (1.0 - 1e-6)).abs() < 1e-8, "{third}");
    assert!(history.energy_error < 1e-8 * history.energy_scale, "{:e}", history.energy_error);
}

#[test]
fn functions_of_the_user_are_events() {
    let mut names = Names::new();
    names.coordinate("x");
    let event = |text: &str, crossing: Crossing, ends: bool| UserEvent {
        name: text.to_owned(),
        function: EventFunction::Expression(parse(text, &names).unwrap()),
        crossing,
        ends,
    };
    let mut options = SimulateOptions::new(2.0);
    options.events = vec![
        event("x - 0.3", Crossing::Any, false),
        event("x - 0.4", Crossing::Falling, false),
        event("x - 0.5", Crossing::Rising, true),
    ];
    let history = run(&block("0.25", "rate = 2", ""), &options);
    assert_eq!(history.end, End::UserEvent(2));
    let times: Vec<f64> = history.events.iter().map(|event| event.time).collect();
    assert_eq!(times.len(), 3);
    // 2 t - 1.25 t^2 = x
    for (time, x) in times[1..].iter().zip([0.3_f64, 0.5]) {
        assert!((time - (2.0 - (4.0 - 5.0 * x).sqrt()) / 2.5).abs() < 1e-11, "{time}");
    }
}

#[test]
fn limits_of_steps_and_events() {
    let mut options = SimulateOptions::new(2.0);
    options.most_steps = 5;
    let history = run(&block("0.25", "rate = 2", ""), &options);
    assert_eq!((history.end.clone(), history.statistics.steps), (End::StepLimit, 5));
    assert!(history.reader().at(history.stop()).unwrap().configuration.rates[0] > 0.0);
    options = SimulateOptions::new(2.0);
    options.most_events = 2;
    assert_eq!(run(&block("0.25", "rate = 2", ""), &options).end, End::EventLimit);
}

#[test]
fn a_contradictory_phase_is_refused() {
    let mut options = SimulateOptions::new(1.0);
    options.initial = Some("--".to_owned());
    let faults = simulate(&model(&block("0.25", "rate = 2", "")), &options).unwrap_err();
    let (wanted, possible) = ("- -".to_owned(), vec!["+ +".to_owned()]);
    assert_eq!(faults.sorted()[0].kind, FaultKind::ContradictoryPhase { wanted, possible });
    options.initial = Some("++".to_owned());
    assert!(simulate(&model(&block("0.25", "rate = 2", "")), &options).is_ok());
}

/// Says that a block at rest slides, though friction would push it back.
struct Wrong;

impl Decisions for Wrong {
    fn successors(&mut self, _: &EventInstant<'_>) -> Result<Continuations, Faults> {
        let contacts = vec![ContactPhase::Pressed(Side::Positive); 2];
        let phase = Phase { joints: vec![JointPhase::Sliding(1.0)], contacts, hinges: Vec::new() };
        let list =
            vec![Continuation { phase, verdict: Verdict::NotComputed, continues: false, impulse: None }];
        Ok(Continuations { list, left_out: false })
    }

    fn jam(&mut self, _: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
        Ok(None)
    }

    fn sticking_margin(&mut self, _: &Mechanism, _: &Configuration, _: &Phase) -> Result<f64, Faults> {
        Ok(1.0)
    }
}

#[test]
fn phases_that_take_no_time_are_an_accumulation() {
    let mechanism = mechanism_of(&block("0.25", "", ""));
    let configuration = Configuration::new(&mechanism).unwrap();
    let options = SimulateOptions::new(1.0);
    let progress = &mut |_: &Progress| ControlFlow::Continue(());
    let history = simulate_with(&mechanism, &configuration, &options, &mut Wrong, progress).unwrap();
    assert_eq!(history.end, End::Accumulation);
    assert_eq!(history.stop(), 0.0);
}

#[test]
fn progress_can_end_it() {
    let mechanism = mechanism_of(&block("0.25", "rate = 2", ""));
    let configuration = Configuration::new(&mechanism).unwrap();
    let options = SimulateOptions::new(1.0);
    let is_over = |progress: &Progress| progress.fraction.is_some_and(|fraction| fraction > 0.1);
    let progress = &mut |progress: &Progress| {
        if is_over(progress) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let history = simulate_with(&mechanism, &configuration, &options, &mut Wrong, progress).unwrap();
    assert_eq!(history.end, End::Interrupted);
    assert!(history.stop() > 0.1 && history.stop() < 0.2);
}

/// A callback that breaks when it is called for the n-th time.
fn breaking_at(n: usize, calls: &mut usize) -> impl FnMut(&Progress) -> ControlFlow<()> + Send {
    move |_: &Progress| {
        *calls += 1;
        if *calls >= n { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Within a decision, too, where that searches for states of hinges that turn.
#[test]
fn what_was_found_before_an_interruption_is_kept() {
    let mechanism = Mechanism::new(&super::model_of("slider-crank-with-pins")).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let options = SimulateOptions::new(0.02);
    let mut calls = 0;
    let follow = |n: usize, calls: &mut usize| {
        let progress = &mut breaking_at(n, calls);
        simulate_with(&mechanism, &configuration, &options, &mut Thorough, progress).unwrap()
    };
    let whole = follow(usize::MAX, &mut calls);
    assert_eq!(whole.end, End::Finished);
    let all = calls;
    for n in [1, 2, all / 3, all / 2, all - 1] {
        let history = follow(n, &mut 0);
        assert_eq!(history.end, End::Interrupted, "{n} of {all}");
        assert!(!history.events.is_empty() && history.events.len() <= whole.events.len());
        let words = |history: &History| history.events[0].words.clone();
        assert!(n <= 2 || words(&history) == words(&whole), "{}", words(&history));
        assert!(history.steps.is_empty() == (n <= 2), "{n}: {}", history.steps.len());
        assert_eq!(report(&history, &options).stop, history.stop());
    }
}

#[test]
fn motions_that_were_found_before_an_interruption_are_kept() {
    let settings = Settings::default().parameter("mu_1", "0.6");
    let mechanism = Mechanism::new(&super::model_of("klepp-2002-spring").with(&settings).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let options = SimulateOptions::new(0.02);
    let follow = |n: usize, calls: &mut usize| {
        let progress = &mut breaking_at(n, calls);
        simulate_all(&mechanism, &configuration, &options, (&mut Thorough, 9), progress).unwrap()
    };
    let mut all = 0;
    let whole = follow(usize::MAX, &mut all);
    assert!(whole.complete && whole.histories.len() == 2);
    for (n, found) in [(1, 1), (all / 4, 1), (3 * all / 4, 2), (all - 1, 2)] {
        let tree = follow(n, &mut 0);
        assert!(!tree.complete);
        let ends: Vec<&End> = tree.histories.iter().map(|branching| &branching.history.end).collect();
        let expected =
            [&[&End::Finished, &End::Interrupted][..], &[&End::Interrupted]][usize::from(found == 1)];
        assert_eq!(ends, expected, "{n} of {all}");
    }
}
