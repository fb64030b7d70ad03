//! Where solutions exist over a quantity, with friction in hinges.

use crate::cases::{Case, View, moving, reference};
use crate::dead_centre::dead_centres;
use serde::Deserialize;
use slideway::fault::FaultKind;
use slideway::limits::{LimitsMethod, LimitsReport, ModeLimits};
use slideway::report::{ModeEndCause, Proof};
use slideway::{LimitsOptions, Model, Settings, SizeOptions, Vary, gallery, limits, size, solve};

#[derive(Deserialize)]
struct File {
    pendulum_limits: Pendulum,
    intervals_bar_block_2: Intervals,
    intervals_bar_block_3: Intervals,
}

#[derive(Deserialize)]
struct Pendulum {
    r_infinity: f64,
    r_fold: f64,
    #[serde(rename = "M_fold")]
    couple_at_fold: f64,
}

#[derive(Deserialize)]
struct Intervals {
    list: Vec<Interval>,
}

#[derive(Deserialize)]
struct Interval {
    sides: Vec<i8>,
    from: String,
    r_from: f64,
    to: String,
    r_to: f64,
}

fn case(name: &str) -> Case {
    moving().into_iter().find(|case| case.name == name).unwrap()
}

const STRAIGHT: View = View { turn: 0.0, mirror: false };

fn over(model: &Model, vary: &str, effort: u64) -> LimitsReport {
    limits(model, &LimitsOptions::new(vary.parse::<Vary>().unwrap()).effort(effort)).unwrap()
}

fn near(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found - expected).abs() <= 1e-10 * expected.abs().max(1e-3))
}

fn counts(report: &LimitsReport) -> Vec<usize> {
    report.counts.iter().map(|count| count.solutions).collect()
}

/// The second solution comes from infinity at the distance of the centre of percussion, and both merge in the fold.
#[test]
fn the_pendulum_jams_at_its_fold() {
    let Pendulum { r_infinity, r_fold, couple_at_fold } = reference::<File>().pendulum_limits;
    let report = over(&case("pendulum_1").over_radius(&STRAIGHT), "r=0..3", 800);
    assert_eq!(report.method, LimitsMethod::ClosedForm);
    let [first, second] = &report.modes[..] else { panic!("{:?}", report.modes) };
    assert_eq!([first.orientation, second.orientation], [Some(1), Some(-1)]);
    assert_eq!([first.from_is, first.to_is], [ModeEndCause::Range, ModeEndCause::Fold]);
    assert_eq!([second.from_is, second.to_is], [ModeEndCause::WithoutBound, ModeEndCause::Fold]);
    assert!(near(first.to, r_fold) && near(second.to, r_fold) && near(second.from, r_infinity));
    let forces = &second.hinge_forces[0];
    assert!(forces.from_grows && forces.from.is_none() && !forces.to_grows);
    assert!(near(forces.to.map(|force| force * r_fold), couple_at_fold));
    assert_eq!(counts(&report), [1, 2, 0]);
    // Where it is unique and beyond the fold it is proven for whole intervals.
    let is_proven = |count: usize| !report.counts[count].proven.is_empty();
    assert!(is_proven(0) && is_proven(2), "{:?}", report.counts);
    let is_told = |words: &str| report.conclusion.iter().any(|line| line.contains(words));
    assert!(is_told("it speeds up (one solution)") && is_told("it jams"), "{:?}", report.conclusion);
    // The other way round it locks.
    let report = over(&case("pendulum_0_no_fold").over_radius(&STRAIGHT), "r=0..3", 0);
    let [only] = &report.modes[..] else { panic!("{:?}", report.modes) };
    assert_eq!(only.to_is, ModeEndCause::Locking);
    assert!(near(only.to, r_infinity));
}

/// An end of an interval of the reference: its cause, and the contact that changes side.
fn is_end(mode: &ModeLimits, begins: bool, told: &str, at: f64) -> bool {
    let (value, is, names) =
        if begins { (mode.from, mode.from_is, &mode.from_at) } else { (mode.to, mode.to_is, &mode.to_at) };
    let contact = |number: &str| {
        let number: usize = number.parse().unwrap();
        mode.reactions[number].contact.clone()
    };
    near(value, at)
        && match told.split_once(' ') {
            Some(("side", number)) => is == ModeEndCause::SideChange && *names == [contact(number)],
            _ if told == "fold" => is == ModeEndCause::Fold,
            _ if told == "infinity" => matches!(is, ModeEndCause::Locking | ModeEndCause::WithoutBound),
            _ => is == ModeEndCause::Range,
        }
}

/// A bar on a block: branches change sides, come from infinity and merge; turned and in the mirror image, too.
#[test]
fn branches_over_the_radius_are_those_of_the_reference() {
    let File { intervals_bar_block_2, intervals_bar_block_3, .. } = reference();
    for (name, Intervals { list }) in
        [("bar_block_2", intervals_bar_block_2), ("bar_block_3", intervals_bar_block_3)]
    {
        for view in [STRAIGHT, View { turn: 0.7, mirror: false }, View { turn: 0.0, mirror: true }] {
            let report = over(&case(name).over_radius(&view), "r=0..1", 0);
            assert_eq!(report.modes.len(), list.len(), "{name}: {:?}", report.modes);
            for Interval { sides, from, r_from, to, r_to } in &list {
                let (begin, end) =
                    if r_from <= r_to { ((from, r_from), (to, r_to)) } else { ((to, r_to), (from, r_from)) };
                let is_it = |mode: &&ModeLimits| {
                    mode.signs == *sides
                        || view.mirror && mode.signs.iter().zip(sides).all(|(one, other)| *one == -other)
                };
                let mut same = report.modes.iter().filter(is_it);
                assert!(
                    same.any(
                        |mode| is_end(mode, true, begin.0, *begin.1) && is_end(mode, false, end.0, *end.1)
                    ),
                    "{name}, {sides:?}: {:?}",
                    report.modes
                );
            }
        }
    }
}

/// About its dead centre a treadle is locked: proven on both sides of the dead centre itself, where the problem is singular.
#[test]
fn where_a_treadle_is_locked_is_proven_but_for_its_dead_centre() {
    let treadle = Model::parse(gallery::find("four-bar").unwrap().text).unwrap();
    let report = limits(&treadle, &LimitsOptions::new("phi=155 deg..180 deg".parse().unwrap())).unwrap();
    let locked: Vec<_> = report.counts.iter().filter(|count| count.solutions == 0).collect();
    let [locked] = locked[..] else { panic!("{:?}", report.counts) };
    let proven: f64 = locked.proven.iter().map(|[from, to]| to - from).sum();
    assert!(locked.proven.len() > 1 && proven > 0.5 * (locked.to - locked.from), "{locked:?}");
    // About dead centres the loads grow without bound: where it locks does not depend on how much of them is in the range.
    let wide = limits(&treadle, &LimitsOptions::new("phi=60 deg..250 deg".parse().unwrap())).unwrap();
    let begins = |mode: &&ModeLimits| mode.from_is == ModeEndCause::Locking;
    let ends = |mode: &&ModeLimits| mode.to_is == ModeEndCause::Locking;
    let [from, to] = [
        wide.modes.iter().find(ends).unwrap().to.unwrap(),
        wide.modes.iter().find(begins).unwrap().from.unwrap(),
    ];
    assert!((from - locked.from).abs() < 1e-9 && (to - locked.to).abs() < 1e-9, "{from}, {to}: {locked:?}");
}

/// A parameter on which more depends is sampled: the ends are the same to machine precision.
#[test]
fn sampled_branches_end_where_the_closed_form_says() {
    let Intervals { list } = reference::<File>().intervals_bar_block_3;
    let case = case("bar_block_3");
    // The load does not change, but the formulas do not say so.
    let exact = over(&case.over_radius(&STRAIGHT), "r=0..1", 0);
    let sampled = over(&case.over_radius_and_load(), "r=0..1", 0);
    assert_eq!(sampled.method, LimitsMethod::Bracketing);
    assert_eq!(sampled.modes.len(), list.len(), "{:#?}", sampled.modes);
    for (one, other) in exact.modes.iter().zip(&sampled.modes) {
        assert_eq!((&one.signs, one.orientation), (&other.signs, other.orientation));
        assert_eq!((one.from_is, one.to_is), (other.from_is, other.to_is));
        assert!(near(one.from, other.from.unwrap()) && near(one.to, other.to.unwrap()), "{one:?} {other:?}");
    }
    assert_eq!(counts(&exact), counts(&sampled));
}

/// With a drive at the piston against a torque on the crank: the effort grows without bound
/// towards the angle at which the crank locks.
#[test]
fn the_driven_piston_locks_around_its_dead_centres() {
    for case in dead_centres() {
        for (inner, expected) in [(false, case.outer_deg), (true, case.inner_deg)] {
            let (drawn, direction) = if inner { (180.0, 0.0) } else { (0.0, 180.0) };
            let further = format!(
                "[loads.resistance]\ntype = \"torque\"\nbody = \"crank\"\nmoment = -1\n\
                 [coordinates.phi]\nrotation = \"crank\"\ndrawn_at = \"{drawn} deg\"\nrate = 1\n\
                 [drives.gas]\ncoordinate = \"phi\"\nforce = {{ at = \"piston.B\", direction = \"{direction} deg\" }}\n",
            );
            let range = format!("phi={} deg..{} deg", drawn + 2.0, drawn + 20.0);
            let report = over(&case.at_dead_centre(inner, &further), &range, 0);
            let locked = report.counts.iter().find(|count| count.solutions == 0).unwrap();
            assert!(report.counts.iter().filter(|count| count.solutions == 0).count() == 1);
            let angle = locked.to.to_degrees() - drawn;
            assert!((angle - expected).abs() < 1e-8, "{angle} instead of {expected}: {:?}", report.modes);
            let first = report.modes.iter().find(|mode| mode.from == Some(locked.to)).unwrap();
            assert_eq!(first.from_is, ModeEndCause::Locking);
        }
    }
}

/// At random values `solve` finds as many solutions as the limits say, proven.
#[test]
fn the_counts_are_those_of_solve() {
    let crank = Model::parse(gallery::find("slider-crank-with-pins").unwrap().text).unwrap();
    let far = Settings::default().parameter("mu", 0.5);
    for (model, vary, name, range) in [
        (case("bar_block_3").over_radius_and_load(), "r=0..0.5", "r", [0.0, 0.5]),
        (crank.clone(), "mu_pin=0..3", "mu_pin", [0.0, 3.0]),
        (crank.with(&far).unwrap(), "gas=-3 kN..3 kN", "gas", [-3e3, 3e3]),
        (crank, "friction=0..20", "", [0.0, 20.0]),
    ] {
        let report = over(&model, vary, 0);
        let mut seed = 1_u64;
        for _ in 0..12 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = range[0] + (range[1] - range[0]) * (seed >> 11) as f64 / (1_u64 << 53) as f64;
            let count = report.counts.iter().find(|count| count.from <= value && value <= count.to).unwrap();
            let set = match name {
                "" => Settings::default().parameter("mu", 0.1 * value).parameter("mu_pin", 0.1 * value),
                _ => Settings::default().parameter(name, value),
            };
            let solved = solve(&model.with(&set).unwrap()).unwrap();
            assert_eq!(solved.complete, Proof::Proven, "{vary} at {value}: {:?}", solved.open);
            assert_eq!(solved.solutions.len(), count.solutions, "{vary} at {value}: {:#?}", report.modes);
        }
    }
}

/// A bar about a rough pin under a force `F`, in units of mass and length of these sizes.
fn bar(mass: f64, length: f64) -> Model {
    let (inertia, force) = (mass * length * length, mass * length);
    let text = format!(
        "[parameters]\nr = {:?}\nF = {:?}\n\
         [points]\nO = [0, 0]\nC = [{:?}, 0]\n\
         [bodies.bar]\npoints = [\"O\", \"C\"]\nmass = {mass:?}\nmoment_of_inertia = {inertia:?}\n\
         centre_of_mass = \"C\"\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\nfriction_radius = \"r\"\n\
         [loads.pull]\ntype = \"force\"\nat = \"bar.C\"\ncomponents = [{:?}, \"F\"]\n\
         [coordinates.phi]\nrotation = \"bar\"\nrate = 1\n",
        4.0 * length,
        force,
        0.5 * length,
        -4.0 * force
    );
    Model::parse(&text).unwrap()
}

/// In other units of mass and length the same numbers of solutions, and ends that are multiplied; proven in parts.
/// Beside each end `solve` finds the numbers of both sides.
#[test]
fn limits_do_not_depend_on_units() {
    let plain = bar(1.0, 1.0);
    let force = 1e6 * 1e-3;
    let [one, other] = [
        over(&plain, "F=-20..20", 800),
        over(&bar(1e6, 1e-3), &format!("F={}..{}", -20.0 * force, 20.0 * force), 800),
    ];
    assert_eq!(counts(&one), counts(&other));
    assert!(counts(&one).len() >= 2, "{:?}", counts(&one));
    for (one, other) in one.counts.iter().zip(&other.counts) {
        assert!(near(Some(other.from / force), one.from) && near(Some(other.to / force), one.to));
        assert_eq!(one.proven.is_empty(), other.proven.is_empty());
    }
    for (below, above) in one.counts.iter().zip(&one.counts[1..]) {
        for (side, count) in [(-1e-7, below), (1e-7, above)] {
            let beside = plain.with(&Settings::default().parameter("F", below.to + side)).unwrap();
            assert_eq!(solve(&beside).unwrap().solutions.len(), count.solutions, "{} {side}", below.to);
        }
    }
}

/// For pins of ordinary friction every position has one solution; the pin of the piston turns back where
/// the crank is at a right angle to it.
#[test]
fn a_slider_crank_has_one_solution_all_around() {
    let crank = Model::parse(gallery::find("slider-crank-with-pins").unwrap().text).unwrap();
    let report = over(&crank, "phi=20 deg..85 deg", 0);
    assert_eq!(counts(&report), [1]);
    let report = over(&crank, "phi=20 deg..120 deg", 0);
    let at_right_angle =
        |at: Option<f64>| at.is_some_and(|at| (at - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert!(
        report.modes.iter().any(|mode| at_right_angle(mode.to) && mode.to_is == ModeEndCause::Reversal),
        "{:#?}",
        report.modes
    );
    assert!(
        report.modes.iter().any(|mode| at_right_angle(mode.from) && mode.from_is == ModeEndCause::Reversal)
    );
}

/// The friction of the pendulum may grow up to its fold, or up to where it locks.
#[test]
fn margins_are_those_of_the_limits() {
    let Pendulum { r_infinity, r_fold, .. } = reference::<File>().pendulum_limits;
    for (name, end, cause) in [
        ("pendulum_1", r_fold, ModeEndCause::Fold),
        ("pendulum_0_no_fold", r_infinity, ModeEndCause::Locking),
    ] {
        let model = case(name).over_radius(&STRAIGHT).with(&Settings::default().parameter("r", 0.2)).unwrap();
        let report = solve(&model).unwrap();
        let margin = report.solutions[0].margin.as_ref().unwrap();
        assert_eq!(margin.ends_with, cause);
        assert!(near(margin.factor, end / 0.2), "{margin:?}");
        let sized = size(&model, &SizeOptions::new(Vary::between("r", 0.01, 2.0), 2.0)).unwrap();
        let [met] = &sized.met[..] else { panic!("{:?}", sized.met) };
        assert!((met.to / (end / 2.0) - 1.0).abs() < 1e-9, "{} instead of {}", met.to, end / 2.0);
    }
}

/// A hinge that never turns leaves ranges, over which nothing is followed.
#[test]
fn a_hinge_that_never_turns_is_named() {
    let text = gallery::find("klepp-2002").unwrap().text;
    let rough = text.replacen("type = \"hinge\"", "type = \"hinge\"\nfriction_radius = 0.01", 1);
    let options = LimitsOptions::new(Vary::between("mu_1", 0.1, 0.5));
    let faults = limits(&Model::parse(&rough).unwrap(), &options).unwrap_err();
    assert!(matches!(faults.sorted()[0].kind, FaultKind::HingeDoesNotTurn { .. }), "{faults:?}");
}
