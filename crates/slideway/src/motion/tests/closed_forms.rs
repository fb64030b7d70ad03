use super::models::block;
use super::run;
use crate::motion::{Cause, End, Event, History, SimulateOptions, simulate};

/// v = v0 - mu g t: it stops at t = v0 / (mu g) = 2 / 2.5 = 0.8 s, at x = v0^2 / (2 mu g) = 0.8 m, and stays.
#[test]
fn a_block_slides_to_rest() {
    let history = run(&block("0.25", "rate = 2", ""), &SimulateOptions::new(2.0));
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.events.len(), 2);
    let stop = &history.events[1];
    assert!(matches!(stop.causes[..], [Cause::Stops(_)]));
    assert!((stop.time - 0.8).abs() < 1e-12, "{}", stop.time);
    assert_eq!(stop.words, "block stops and sticks");
    let mut reader = history.reader();
    for (time, place, velocity) in [(0.3, 0.6 - 0.1125, 1.25), (0.8, 0.8, 0.0), (2.0, 0.8, 0.0)] {
        let sample = reader.at(time).unwrap();
        assert!((sample.configuration.coordinates[0] - place).abs() < 1e-12);
        assert!((sample.configuration.rates[0] - velocity).abs() < 1e-12);
    }
    // It dissipates m v0^2 / 2 = 4 J, each end of the block half of it.
    let energy = reader.at(2.0).unwrap().energy;
    assert!(energy.friction.iter().all(|part| (part - 2.0).abs() < 1e-11), "{energy:?}");
    assert!(history.energy_error < 1e-11 && history.drift.position < 1e-13);
}

/// Spring k = 50 N/m, mu m g = 0.05 * 20 = 1 N, static friction the same: released at x = 0.33 m the turning
/// points are 2 mu m g / k = 0.04 m nearer each half cycle of pi sqrt(m/k), until |x| <= mu m g / k = 0.02 m:
/// 0.33, -0.29, 0.25, -0.21, 0.17, -0.13, 0.09, -0.05, 0.01: there it stays.
#[test]
fn a_frictional_oscillator_loses_a_fixed_part_each_half_cycle() {
    let spring = r#"
[loads.spring]
type = "spring"
between = ["block.C", "ground.W"]
stiffness = "50 N/m"
"#;
    let history = run(&block("0.05", "value = 0.33", spring), &SimulateOptions::new(8.0));
    let half = std::f64::consts::PI * 0.2;
    let stops: Vec<_> = history.events.iter().filter(|e| matches!(e.causes[..], [Cause::Stops(_)])).collect();
    assert_eq!(stops.len(), 8, "{:#?}", history.events.iter().map(|e| &e.words).collect::<Vec<_>>());
    let mut reader = history.reader();
    for (index, stop) in stops.iter().enumerate() {
        let count = (index + 1) as f64;
        assert!((stop.time - count * half).abs() < 2e-8, "{} {}", stop.time, count * half);
        let turning = (0.33 - 0.04 * count) * if index % 2 == 0 { -1.0 } else { 1.0 };
        let place = reader.at(stop.time).unwrap().configuration.coordinates[0];
        assert!((place - turning).abs() < 1e-8, "{place} {turning}");
    }
    let last = reader.at(8.0).unwrap();
    assert!((last.configuration.coordinates[0] - 0.01).abs() < 1e-8);
    assert!(last.configuration.rates[0].abs() < 1e-14);
}

/// A force of 8 N/s t moves a block at rest when it exceeds mu m g = 5 N, at t = 0.625 s; then
/// m v' = 8 t - 5, so x = (8/6 (t^3 - t0^3) - 5/2 (t^2 - t0^2) - (4 t0^2 - 5 t0)(t - t0)) / 2.
#[test]
fn a_growing_force_starts_a_block() {
    let force = "
[loads.force]
type = \"force\"
at = \"block.C\"
components = [\"8 N/s * t\", 0]
";
    let history = run(&block("0.25", "", force), &SimulateOptions::new(1.0));
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.events.len(), 2);
    // Decisions take slacks below 1e-8 of the greatest force, the weight of 20 N, as zero: 8 N/s pass them in
    // 2.5e-8 s.
    assert!((history.events[1].time - 0.625).abs() < 2.5e-8, "{}", history.events[1].time);
    let t0: f64 = 0.625;
    let x =
        (8.0 / 6.0 * (1.0 - t0.powi(3)) - 2.5 * (1.0 - t0 * t0) - (4.0 * t0 * t0 - 5.0 * t0) * (1.0 - t0))
            / 2.0;
    let found = history.reader().at(1.0).unwrap().configuration.coordinates[0];
    assert!((found - x).abs() < 1e-12, "{found} {x}");
}

/// The slope of log(error) over log(length), by least squares.
fn order(lengths: &[f64], errors: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let logarithms = |values: &[f64]| values.iter().map(|value| value.ln()).collect::<Vec<_>>();
    let (x, y) = (logarithms(lengths), logarithms(errors));
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let products: f64 = x.iter().zip(&y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    products / x.iter().map(|x| (x - x_mean).powi(2)).sum::<f64>()
}

/// Errors of an event's time with steps of fixed length, three octaves in halves, and their order.
fn order_of_event(
    text: &str,
    [duration, expected]: [f64; 2],
    is: impl Fn(&History) -> f64,
) -> (f64, Vec<f64>) {
    let lengths: Vec<f64> = (0..7).map(|index| 0.16 * f64::exp2(-0.5 * f64::from(index))).collect();
    let error = |length: &f64| {
        let mut options = SimulateOptions::new(duration);
        options.tolerance = 1e3;
        options.longest_step = Some(*length);
        let model = crate::model::Model::parse(text).unwrap();
        (is(&simulate(&model, &options).unwrap()) - expected).abs()
    };
    let errors: Vec<f64> = lengths.iter().map(error).collect();
    (order(&lengths, &errors), errors)
}

/// The method has order 5, and the solution within a step, on which an event is found, errs by a length to
/// the power 5 too. In a linear oscillation the phase errs by one power more (the stability function agrees
/// with exp(z) to z^5, and an error of i^6 z^6 is one of the amplitude), so that the order lies between 5
/// and 6.
#[test]
fn the_order_of_event_times_in_an_oscillation() {
    let spring = r#"
[loads.spring]
type = "spring"
between = ["block.C", "ground.W"]
stiffness = "50 N/m"
"#;
    for count in [1, 2, 3] {
        let stop = |history: &History| {
            let is_stop = |event: &&Event| matches!(event.causes[..], [Cause::Stops(_)]);
            history.events.iter().filter(is_stop).nth(count - 1).unwrap().time
        };
        let expected = count as f64 * std::f64::consts::PI * 0.2;
        let (order, errors) = order_of_event(&block("0.05", "value = 0.33", spring), [2.0, expected], stop);
        assert!((4.7..6.3).contains(&order), "{order} {errors:?}");
        assert!(errors[6] < 1e-8, "{errors:?}");
    }
}

/// m v' = 10 N sin(3 t/s) - mu m g with mu m g = 2 N: v = 2 + 5/3 (1 - cos 3 t) - t and x = 11/3 t - 5/9 sin
/// 3 t - t^2/2, which passes 1 m once before it stops.
#[test]
fn the_order_of_event_times_under_a_force_that_swings() {
    let force = r#"
[loads.force]
type = "force"
at = "block.C"
components = ["10 N * sin(3*t/(1 s))", 0]
[events.place]
zero_of = "x - 1 m"
"#;
    let place = |t: f64| 11.0 / 3.0 * t - 5.0 / 9.0 * (3.0 * t).sin() - t * t / 2.0;
    let (mut low, mut high) = (0.0, 1.0);
    while high - low > 1e-15 {
        let middle = f64::midpoint(low, high);
        if place(middle) < 1.0 { low = middle } else { high = middle }
    }
    let passes = |history: &History| {
        let is_passing = |event: &&Event| matches!(event.causes[..], [Cause::User(0, _)]);
        history.events.iter().find(is_passing).unwrap().time
    };
    let (order, errors) = order_of_event(&block("0.1", "rate = 2", force), [0.6, low], passes);
    assert!((4.3..6.3).contains(&order), "{order} {errors:?}");
    assert!(errors[6] < 1e-10, "{errors:?}");
}

/// Tables have columns of these names already.
#[test]
fn coordinates_with_taken_names_bear_a_prefix() {
    let text = crate::gallery::find("frictional-oscillator")
        .unwrap()
        .text
        .replace("[coordinates.x]", "[coordinates.mode]");
    let history = super::run(&text, &SimulateOptions::new(0.05));
    let series = history.series(&history.times_in_steps(0.01));
    let names: Vec<&str> = series.columns.iter().map(|column| column.name.as_str()).collect();
    assert_eq!(names[..4], ["t", "coordinate.mode", "mode.rate", "mode.acceleration"]);
}
