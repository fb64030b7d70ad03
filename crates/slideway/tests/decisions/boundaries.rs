//! Phases that begin at a boundary: a normal force or a share of the preload that is zero.

use crate::agreement::slider_count;
use crate::set_up::{State, sides};
use slideway::configuration::{Configuration, Pose, Velocity};
use slideway::model::{Model, Settings};
use slideway::modes::Side;
use slideway::motion::decision::{PhaseState, Standing, phase_state, successors};
use slideway::motion::{ContactPhase, JointPhase, Phase};
use slideway::report::Verdict;

/// A gallery model with a force F(t) that goes through a whole range within a short time, and the moment at
/// which it begins.
fn swept(name: &str, load: &str, parameters: &[(&str, &str)]) -> Model {
    let text = slideway::gallery::find(name).expect("in the gallery").text;
    let text = format!("{text}\n{load}\n");
    let set = |settings: Settings, (name, value): &(&str, &str)| settings.parameter(name, value);
    Model::parse(&text)
        .unwrap_or_else(|faults| panic!("{faults}"))
        .with(&parameters.iter().fold(Settings::default(), set))
        .unwrap()
}

/// Every phase in which all joints slide on.
fn sliding_phases(state: &State) -> Vec<Phase> {
    let mut joints = Vec::new();
    for joint in 0..state.mechanism.joints.len() {
        if let Some(slider) = state.mechanism.slider(slideway::ids::JointId(joint)) {
            let contact = state.configuration.contact(&state.mechanism, slider.contacts[0]);
            joints.push(JointPhase::Sliding(contact.sliding_velocity.signum()));
        }
    }
    let options = [
        ContactPhase::Pressed(Side::Positive),
        ContactPhase::Pressed(Side::Negative),
        ContactPhase::PreloadGap,
    ];
    let count = state.mechanism.contacts.len();
    let one = |mut number: usize| {
        let digit = |_| {
            let option = options[number % 3];
            number /= 3;
            option
        };
        Phase { joints: joints.clone(), contacts: (0..count).map(digit).collect(), hinges: Vec::new() }
    };
    (0..3_usize.pow(u32::try_from(count).unwrap())).map(one).collect()
}

/// The least of |N_k| and of the shares and their complements, from the numbers of the state.
fn room(phase: &Phase, state: &PhaseState) -> f64 {
    let contact = |k: usize| match phase.contacts[k] {
        ContactPhase::Pressed(side) => side.sign() * state.normal_forces[k],
        ContactPhase::PreloadGap => {
            let share = state.shares[k].unwrap_or(f64::NAN);
            share.min(1.0 - share)
        }
    };
    (0..phase.contacts.len()).map(contact).fold(f64::INFINITY, f64::min)
}

/// A crude step along the motion of a phase: Taylor series to the acceleration.
fn stepped(configuration: &Configuration, state: &PhaseState, step: f64) -> Configuration {
    let mut next = configuration.clone();
    for body in 0..next.poses.len() {
        let [x, y, turn] = [0, 1, 2].map(|axis| state.unknowns[3 * body + axis]);
        let velocity = configuration.velocities[body];
        next.poses[body].position.x += step * (velocity.linear.x + step * x / 2.0);
        next.poses[body].position.y += step * (velocity.linear.y + step * y / 2.0);
        let turned = step * (velocity.angular + step * turn / 2.0);
        next.poses[body] = Pose::new(next.poses[body].position, next.poses[body].angle() + turned);
        let linear = velocity.linear + nalgebra::Vector2::new(x, y) * step;
        next.velocities[body] = Velocity { linear, angular: velocity.angular + step * turn };
    }
    for (index, acceleration) in state.coordinate_accelerations.iter().enumerate() {
        next.coordinates[index] += step * (configuration.rates[index] + step * acceleration / 2.0);
        next.rates[index] += step * acceleration;
    }
    next.time += step;
    next
}

/// The phases that are admissible a short time later along their own motions, by trying all of them.
fn by_brute_force(state: &State, step: f64) -> Vec<String> {
    let mut found = Vec::new();
    for phase in sliding_phases(state) {
        let at =
            |configuration: &Configuration| phase_state(&state.mechanism, configuration, &phase).unwrap();
        let Some(now) = at(&state.configuration) else { continue };
        let Some(later) = at(&stepped(&state.configuration, &now, step)) else { continue };
        if room(&phase, &later) > 0.0 && room(&phase, &now) > -1e-6 {
            let jumps = phase.contacts.iter().enumerate().all(|(k, contact)| {
                *contact != ContactPhase::PreloadGap
                    || state.mechanism.contacts[k].preload.iter().any(|preload| *preload > 0.0)
            });
            if jumps {
                found.push(sides(&phase));
            }
        }
    }
    found.sort();
    found
}

/// Times from 0 to 1 s at which a normal force or a share of some admissible phase vanishes while everything
/// else stands still, with that phase.
fn crossings(model: &Model) -> Vec<(State, Phase)> {
    let mut found = Vec::new();
    let base = State::of(model);
    let at = |time: f64| {
        let mut configuration = base.configuration.clone();
        configuration.time = time;
        State { mechanism: base.mechanism.clone(), configuration }
    };
    for phase in sliding_phases(&base) {
        let room_at = |time: f64| {
            let state = at(time);
            phase_state(&state.mechanism, &state.configuration, &phase)
                .unwrap()
                .map(|state| room(&phase, &state))
        };
        let Some(rooms) = (0..=64).map(|step| room_at(f64::from(step) / 64.0)).collect::<Option<Vec<_>>>()
        else {
            continue;
        };
        if rooms.iter().any(|room| !room.is_finite()) {
            continue;
        }
        for (step, pair) in rooms.windows(2).enumerate() {
            if !(pair[0] > 0.0 && pair[1] < 0.0) {
                continue;
            }
            let (mut inside, mut outside) = (step as f64 / 64.0, (step + 1) as f64 / 64.0);
            while outside - inside > 1e-15 {
                let middle = f64::midpoint(inside, outside);
                if middle <= inside || middle >= outside {
                    break;
                }
                if room_at(middle).unwrap() > 0.0 { inside = middle } else { outside = middle }
            }
            found.push((at(inside), phase.clone()));
        }
    }
    found
}

fn check(model: &Model, seen: &mut [usize; 5]) {
    for (state, before) in crossings(model) {
        let stopped = vec![false; slider_count(&state)];
        let found = successors(&state.mechanism, &state.configuration, &stopped, Some(&before)).unwrap();
        assert!(found.unsolved.is_empty());
        if found.list.iter().any(|one| matches!(one.standing, Standing::Undecided(_))) {
            continue;
        }
        let mut names: Vec<String> = found.list.iter().map(|one| sides(&one.phase)).collect();
        names.sort();
        let expected = by_brute_force(&state, 1e-6);
        assert_eq!(names, expected, "at {} s after {}", state.configuration.time, sides(&before));
        assert!(found.list.iter().all(|one| !one.is_present), "it has ended");
        let continues = found.list.iter().filter(|one| one.continues).count();
        assert!(continues <= 1);
        // The neighbour that continues comes first, unless it alone is unattainable.
        if continues == 1 && !found.list[0].continues {
            let other = found.list.iter().find(|one| one.continues).unwrap();
            assert_eq!(other.attainability.verdict, Verdict::Unattainable);
            assert_ne!(found.list[0].attainability.verdict, Verdict::Unattainable);
            seen[4] += 1;
        }
        seen[0] += 1;
        seen[1] += continues;
        seen[2] += usize::from(found.list.is_empty());
        seen[3] +=
            found.list.iter().filter(|one| one.phase.contacts.contains(&ContactPhase::PreloadGap)).count();
    }
}

#[test]
fn what_follows_at_the_end_of_a_mode_is_what_brute_force_finds_a_little_later() {
    // Crossings, of which so many continue, so many end the motion, and so many lead to a preload gap.
    let mut seen = [0; 5];
    let vertical =
        "[loads.sweep]\ntype = \"force\"\nat = \"bar.B\"\ncomponents = [0, \"(60*t - 30)*1 N/(1 s)\"]\n";
    for mu in ["0.1", "0.3", "0.6", "1.2"] {
        for direction in ["1", "-1"] {
            for preload in [["0", "0"], ["0.5*m*g", "0"], ["0", "0.5*m*g"], ["m*g", "0.3*m*g"]] {
                let settings =
                    [("mu_1", mu), ("direction", direction), ("F_20", preload[0]), ("F_30", preload[1])];
                check(&swept("klepp-2002", vertical, &settings), &mut seen);
            }
        }
    }
    assert!(seen[0] > 50 && seen[1] > 20 && seen[2] > 3 && seen[3] > 3, "{seen:?}");
}
