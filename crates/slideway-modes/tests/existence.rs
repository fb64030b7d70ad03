//! Where modes exist along a line of parameters: the paper's intervals, closed forms, and dense scanning.

use std::error::Error;

use crate::klepp_example::{example, reference};
use crate::search_support::Random;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::certificate::{IntervalMatrix, IntervalModeProblem, proven_determinant_sign};
use slideway_modes::existence::{
    CountInterval, EndCause, Existence, ExistenceOptions, Limit, ModeInterval, ModeProblemLine, OutputBound,
    counts, is_same_end, nothing_is_left,
};
use slideway_modes::{BySide, ContactState, Limits, ModeProblem, Side, enumerate};

const ALL: u64 = 1 << 20;

fn options(from: f64, to: f64) -> ExistenceOptions {
    ExistenceOptions { range: [from, to], greatest_normal_force: None, patterns: ALL }
}

fn signs(mode: &ModeInterval) -> String {
    let sign = |state: &ContactState| match state {
        ContactState::Positive => '+',
        ContactState::Negative => '-',
        ContactState::Gap => '0',
    };
    mode.pattern.iter().map(sign).collect()
}

fn paper(preload: [f64; 3], velocity: f64) -> Result<ModeProblemLine, Box<dyn Error>> {
    let parameters = reference()?.parameters;
    let at = |mu_1| example(&parameters, mu_1, preload, velocity);
    Ok(ModeProblemLine::between(&at(0.0), &at(1.0)))
}

/// Modes without gap, longer than rounding.
fn pressed(existence: &Existence) -> Vec<&ModeInterval> {
    existence.modes.iter().filter(|mode| !mode.pattern.contains(&ContactState::Gap)).collect()
}

#[test]
fn the_papers_intervals_without_scanning() -> Result<(), Box<dyn Error>> {
    for expected in reference()?.intervals {
        let existence = paper(expected.preload, expected.velocity)?.existence(&options(0.0, 0.8))?;
        let mut found: Vec<_> = pressed(&existence);
        found.sort_by(|one, other| {
            one.from.at.total_cmp(&other.from.at).then(one.to.at.total_cmp(&other.to.at))
        });
        let mut wanted: Vec<_> = expected.modes.iter().collect();
        wanted.sort_by(|one, other| one.from.total_cmp(&other.from).then(one.to.total_cmp(&other.to)));
        assert_eq!(found.len(), wanted.len(), "{found:#?}");
        for (found, wanted) in found.iter().zip(wanted) {
            assert_eq!(signs(found), wanted.signs);
            assert!((found.from.at - wanted.from).abs() < 1e-8 && (found.to.at - wanted.to).abs() < 1e-8);
        }
    }
    Ok(())
}

#[test]
fn the_papers_closed_forms_to_machine_precision() -> Result<(), Box<dyn Error>> {
    // Without preload: locking at 2 cot(alpha) + 0.1, both ends of the block change side at cot(alpha).
    let cotangent = reference()?.parameters.alpha_deg.to_radians().tan().recip();
    let line = paper([0.0; 3], -1.0)?;
    let existence = line.existence(&options(0.0, 0.8))?;
    let [first, second] = pressed(&existence)[..] else { panic!("two modes") };
    assert!((first.to.at - cotangent).abs() < 1e-15);
    assert_eq!(first.to.cause, EndCause::SideChange(vec![1, 2]));
    let locking = 2.0 * cotangent + 0.1;
    assert!((second.to.at - locking).abs() < 1e-14, "{:e}", second.to.at - locking);
    assert_eq!(second.to.cause, EndCause::Singular);
    let limits = second.to.normal_force.as_deref().ok_or("limits")?;
    assert_eq!(limits, [Limit::Infinite(1.0), Limit::Infinite(-1.0), Limit::Infinite(1.0)]);
    assert_eq!(
        counts(&line, &existence, [0.0, 0.8])
            .iter()
            .map(|interval| (interval.solutions, interval.gap_states))
            .collect::<Vec<_>>(),
        [(1, 0), (0, 0)]
    );
    Ok(())
}

#[test]
fn one_two_three_solutions_in_the_last_example() -> Result<(), Box<dyn Error>> {
    // Theory, section 9: the erratum's 0.47647077, and one gap state from there on.
    let line = paper([0.0, 1.0, 0.0], 1.0)?;
    let existence = line.existence(&options(0.0, 0.8))?;
    let counts: Vec<CountInterval> = counts(&line, &existence, [0.0, 0.8]);
    let solutions: Vec<usize> = counts.iter().map(|interval| interval.solutions).collect();
    assert_eq!(solutions, [1, 2, 3]);
    assert!((counts[0].to - 0.452_653_96).abs() < 1e-8);
    assert!((counts[1].to - 0.476_470_77).abs() < 1e-8);
    Ok(())
}

#[test]
fn reactions_beyond_a_limit_end_a_mode_early() -> Result<(), Box<dyn Error>> {
    let line = paper([0.0; 3], -1.0)?;
    let limited = ExistenceOptions { greatest_normal_force: Some(20.0), ..options(0.0, 0.8) };
    let existence = line.existence(&limited)?;
    let last = pressed(&existence).into_iter().next_back().ok_or("a mode")?;
    let EndCause::GreatestNormalForce(contacts) = &last.to.cause else { panic!("{:?}", last.to.cause) };
    let force = line.normal_force(&last.pattern, last.to.at).ok_or("regular")?;
    assert!((force[contacts[0]].abs() - 20.0).abs() < 1e-9);
    assert!(force.amax() < 20.0 + 1e-9);
    Ok(())
}

#[test]
fn up_to_infinity() -> Result<(), Box<dyn Error>> {
    // The mode (+,+,-) of the paper's example never ends; its reactions have finite limits.
    let line = paper([0.0; 3], 1.0)?;
    let existence = line.existence(&options(0.1, f64::INFINITY))?;
    let [first, second] = pressed(&existence)[..] else { panic!("{existence:#?}") };
    assert_eq!((signs(first).as_str(), signs(second).as_str()), ("++-", "-+-"));
    assert_eq!(first.to.at, f64::INFINITY);
    assert_eq!(first.to.cause, EndCause::Range);
    let finite = |limit: &Limit| matches!(limit, Limit::Finite(_));
    assert!(first.to.normal_force.as_deref().ok_or("limits")?.iter().all(finite));
    assert!((second.from.at - 0.452_653_96).abs() < 1e-8);
    assert_eq!(second.from.cause, EndCause::Singular);
    let counts: Vec<(f64, usize)> = counts(&line, &existence, [0.1, f64::INFINITY])
        .iter()
        .map(|interval| (interval.to, interval.solutions))
        .collect();
    assert_eq!(counts.iter().map(|count| count.1).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(counts[1].0, f64::INFINITY);
    Ok(())
}

#[test]
fn nothing_is_left_up_to_infinity_beyond_locking() -> Result<(), Box<dyn Error>> {
    let line = paper([0.0; 3], -1.0)?;
    let existence = line.existence(&options(0.3, f64::INFINITY))?;
    let counts = counts(&line, &existence, [0.3, f64::INFINITY]);
    assert_eq!(counts.iter().map(|count| count.solutions).collect::<Vec<_>>(), [1, 0]);
    // Uniqueness for every load is lost at 2 cot(alpha) - 0.1 already.
    let parameters = reference()?.parameters;
    let sign_at = |mu_1: f64, pattern: &[ContactState]| {
        proven_determinant_sign(&example(&parameters, mu_1, [0.0; 3], -1.0), pattern)
    };
    let lost = line.first_locking(ALL, &sign_at)?.ok_or("a determinant changes its sign")?.0;
    let cotangent = reference()?.parameters.alpha_deg.to_radians().tan().recip();
    assert!((lost - (2.0 * cotangent - 0.1)).abs() < 1e-12);
    Ok(())
}

/// `c_1 = (1 - a t, t)` and `c_2 = (-p t, 1 + a t)` have `det = 1 + (p - a^2) t^2`: 1 for every `t` if
/// `p = a^2`. With `p = a^2 (1 - e^2)` they have a zero far out, at `1 / (a e)`, which numbers that are known
/// to within `2 e^2` of themselves need not have; `p = a^2 / 2` has one at `sqrt(2) / a`.
#[test]
fn a_zero_that_rounding_makes_locks_nothing() -> Result<(), Box<dyn Error>> {
    let a: f64 = 0.5;
    let little = 2.0_f64.powi(-20);
    let rounded = a * a * (1.0 - little * little);
    let first = |p: f64, spread: f64| -> Result<Option<f64>, Box<dyn Error>> {
        let columns = |t: f64| dmatrix![1.0 - a * t, -p * t; t, 1.0 + a * t];
        let within = |t: f64, sign: f64| {
            let radius = columns(t).map(|entry| entry.abs() * spread);
            IntervalMatrix::around(columns(t) * sign, radius).expect("finite")
        };
        let none = || IntervalMatrix::exact(DMatrix::zeros(2, 2));
        let load = IntervalMatrix::exact(dmatrix![1.0; 1.0]);
        let at = |t: f64| {
            let both = BySide { positive: within(t, 1.0), negative: within(t, -1.0) };
            IntervalModeProblem::new(&both, &BySide { positive: none(), negative: none() }, &load)
        };
        let line = ModeProblemLine::between(at(0.0)?.centre(), at(1.0)?.centre());
        let sign_at =
            |t: f64, pattern: &[ContactState]| proven_determinant_sign(&at(t).expect("shapes fit"), pattern);
        Ok(line.first_locking(ALL, &sign_at)?.map(|(first, _)| first))
    };
    let exact = first(rounded, 0.0)?.ok_or("a zero of these very numbers")?;
    assert!((exact * a * little - 1.0).abs() < 1e-3, "{exact}");
    assert_eq!(first(rounded, 2.0 * little * little)?, None);
    let real = first(0.5 * a * a, f64::EPSILON)?.ok_or("it locks")?;
    assert!((real - 2.0_f64.sqrt() / a).abs() < 1e-14 * real);
    Ok(())
}

/// What a scan over the problems of a line finds at a place, by patterns.
fn scanned(line: &[ModeProblem; 2], at: f64) -> Vec<Vec<ContactState>> {
    let solutions = enumerate(&on_line(line, at), &Limits::default()).expect("small");
    let pressed = solutions.solutions.iter().map(|s| s.pattern.iter().map(|&side| side.into()).collect());
    pressed.chain(solutions.gaps.iter().map(|gap| gap.pattern.clone())).collect()
}

fn on_line([start, end]: &[ModeProblem; 2], at: f64) -> ModeProblem {
    let mix = |part: fn(&ModeProblem, Side) -> &DMatrix<f64>, side| {
        part(start, side) * (1.0 - at) + part(end, side) * at
    };
    ModeProblem::new(
        mix(ModeProblem::columns, Side::Positive),
        mix(ModeProblem::columns, Side::Negative),
        mix(ModeProblem::jumps, Side::Positive),
        mix(ModeProblem::jumps, Side::Negative),
        start.right_hand_side() * (1.0 - at) + end.right_hand_side() * at,
    )
    .expect("shapes fit")
}

/// A random line with this many varying columns, with preload at some contacts.
fn random_line(random: &mut Random, size: usize, varying: usize, jumps: bool) -> [ModeProblem; 2] {
    let columns =
        [1.0, -1.0].map(|sign| DMatrix::identity(size, size) * sign + random.matrix(size, size) * 0.4);
    let jump =
        |random: &mut Random| if jumps { random.some_columns(size) } else { DMatrix::zeros(size, size) };
    let (plus, minus, load) = (jump(random), jump(random), random.vector(size));
    let mut changed = columns.clone();
    for matrix in &mut changed {
        for column in 0..varying {
            let slope = random.vector(size) * 3.0;
            let mut target = matrix.column_mut(column);
            target += slope;
        }
    }
    [columns, changed].map(|[positive, negative]| {
        ModeProblem::new(positive, negative, plus.clone(), minus.clone(), load.clone()).expect("shapes fit")
    })
}

#[test]
fn intervals_agree_with_dense_scanning() {
    let mut random = Random::new(20);
    for case in 0..120 {
        let size = 1 + case % 4;
        let ends = random_line(&mut random, size, 1 + case % size, case % 3 == 0);
        let line = ModeProblemLine::between(&ends[0], &ends[1]);
        let existence = line.existence(&options(0.0, 1.0)).expect("small");
        assert!(existence.not_computed.is_empty());
        for step in 0..60 {
            let at = (f64::from(step) + 0.37) / 60.0;
            let near_end =
                |mode: &ModeInterval| (mode.from.at - at).abs() < 1e-6 || (mode.to.at - at).abs() < 1e-6;
            if existence.modes.iter().any(near_end) {
                continue;
            }
            let inside = existence.modes.iter().filter(|mode| mode.from.at < at && at < mode.to.at);
            let mut found: Vec<_> = inside.map(|mode| mode.pattern.clone()).collect();
            let mut expected = scanned(&ends, at);
            found.sort();
            expected.sort();
            assert_eq!(found, expected, "case {case}, t = {at}");
        }
    }
}

#[test]
fn every_end_is_a_zero_of_what_it_names() {
    let mut random = Random::new(21);
    let mut ends_seen = 0;
    for case in 0..60 {
        let size = 2 + case % 3;
        let ends = random_line(&mut random, size, size, false);
        let line = ModeProblemLine::between(&ends[0], &ends[1]);
        for mode in line.existence(&options(0.0, 1.0)).expect("small").modes {
            for end in [&mode.from, &mode.to] {
                ends_seen += 1;
                match &end.cause {
                    EndCause::Range => assert!(end.at == 0.0 || end.at == 1.0),
                    EndCause::Singular => {
                        let problem = on_line(&ends, end.at);
                        let columns: Vec<DVector<f64>> = mode
                            .pattern
                            .iter()
                            .enumerate()
                            .map(|(k, state)| {
                                problem.columns(state.side().expect("pressed")).column(k).into()
                            })
                            .collect();
                        let matrix = DMatrix::from_columns(&columns);
                        assert!(
                            matrix.determinant().abs() < 1e-11 * matrix.amax().max(1.0).powf(size as f64)
                        );
                    }
                    EndCause::SideChange(contacts) => {
                        // The end is exact to rounding: close on both sides the sign differs.
                        let near =
                            |factor: f64| line.normal_force(&mode.pattern, end.at * factor).expect("regular");
                        let (before, after) = (near(1.0 - 1e-11), near(1.0 + 1e-11));
                        assert!(contacts.iter().all(|&k| before[k] * after[k] <= 0.0), "{contacts:?}");
                    }
                    other => panic!("{other:?} without gaps or bounds"),
                }
            }
        }
    }
    assert!(ends_seen > 200);
}

#[test]
fn an_output_bound_ends_a_mode() -> Result<(), Box<dyn Error>> {
    // y (1 - t/2) = 4 and the output C = t y with |C| <= 0.5 y: tips at t = 0.5.
    let side = |sign: f64| [dmatrix![sign; 0.0], dmatrix![-0.5; -1.0]];
    let ([p0, p1], [n0, n1]) = (side(1.0), side(-1.0));
    let both = |positive, negative| slideway_modes::BySide { positive, negative };
    let zero = slideway_modes::BySide::same(DMatrix::zeros(2, 1));
    let line = ModeProblemLine {
        columns: [both(p0, n0), both(p1, n1)],
        jumps: [zero.clone(), zero],
        right_hand_side: [dvector![4.0, 0.0], dvector![0.0, 0.0]],
        bounds: vec![OutputBound { output: 0, contact: 0, factor: 0.5 }],
        has_jump: vec![false],
        sides_differ: vec![false],
        open: slideway_modes::OpenContacts::default(),
    };
    let existence = line.existence(&options(0.0, 5.0))?;
    let [mode] = &existence.modes[..] else { panic!("{existence:#?}") };
    assert!((mode.to.at - 0.5).abs() < 1e-15);
    assert_eq!(mode.to.cause, EndCause::OutputBound(vec![0]));
    Ok(())
}

#[test]
fn a_load_that_vanishes_or_a_pattern_that_is_always_singular() -> Result<(), Box<dyn Error>> {
    // Load t - 1: the side changes at t = 1. The second contact's negative column repeats the first's
    // positive one.
    let none = DMatrix::zeros(2, 2);
    let at = |t: f64| {
        ModeProblem::new(
            dmatrix![1.0, 0.0; 0.0, 1.0],
            dmatrix![-1.0, 1.0; 0.0, 0.0],
            none.clone(),
            none.clone(),
            dvector![t - 1.0, 1.0],
        )
    };
    let line = ModeProblemLine::between(&at(0.0)?, &at(1.0)?);
    let existence = line.existence(&options(0.0, 3.0))?;
    let found: Vec<(String, f64, f64)> =
        existence.modes.iter().map(|mode| (signs(mode), mode.from.at, mode.to.at)).collect();
    assert_eq!(found, [("++".into(), 1.0, 3.0), ("-+".into(), 0.0, 1.0)]);
    assert_eq!(existence.singular_throughout.len(), 2);
    Ok(())
}

#[test]
fn without_contacts_there_is_one_mode_throughout() -> Result<(), Box<dyn Error>> {
    let none = DMatrix::zeros(0, 0);
    let empty = ModeProblem::new(none.clone(), none.clone(), none.clone(), none, DVector::zeros(0))?;
    let line = ModeProblemLine::between(&empty, &empty);
    let existence = line.existence(&options(0.0, 1.0))?;
    assert_eq!((existence.modes.len(), existence.modes[0].to.at), (1, 1.0));
    let sign_at = |_: f64, pattern: &[ContactState]| proven_determinant_sign(&empty, pattern);
    assert_eq!(line.first_locking(ALL, &sign_at)?, None);
    Ok(())
}

#[test]
fn too_many_patterns_are_refused() -> Result<(), Box<dyn Error>> {
    let line = paper([0.0, 1.0, 0.0], 1.0)?;
    let error =
        line.existence(&ExistenceOptions { patterns: 11, ..options(0.0, 1.0) }).expect_err("12 patterns");
    assert_eq!((error.contacts, error.with_jump, error.limit), (3, 1, 11));
    assert!(line.existence(&ExistenceOptions { patterns: 12, ..options(0.0, 1.0) }).is_ok());
    Ok(())
}

/// One solution up to 1, none up to 2, two up to 3: modes that end at 1 or begin at 2 leave nothing behind, however
/// their ends are rounded; those that begin or end elsewhere do.
#[test]
fn whether_anything_is_left_is_read_from_the_counts() {
    let interval =
        |from, to, solutions| CountInterval { from, to, solutions, gap_states: 0, continuum: false };
    let counts = [interval(0.0, 1.0, 1), interval(1.0, 2.0, 0), interval(2.0, 3.0, 2)];
    for (end, begins, expected) in [
        (1.0, false, true),
        (1.0 + 1e-12, false, true),
        (2.0, true, true),
        (2.0 + 1e-11, true, true),
        (1.0, true, false),
        (2.0, false, false),
        (2.5, true, false),
        (2.5, false, false),
        (0.0, true, false),
        (3.0, false, false),
    ] {
        assert_eq!(nothing_is_left(&counts, end, begins, is_same_end), expected, "{end} {begins}");
    }
    // A state in a preload gap is something to move in.
    let gap = [interval(0.0, 1.0, 1), CountInterval { gap_states: 1, ..interval(1.0, 2.0, 0) }];
    assert!(!nothing_is_left(&gap, 1.0, false, is_same_end));
}

/// A force that vanishes for every parameter has no zeros to cut at: with N_2 = 0 throughout, both of its sides have the
/// solution N_1 = 1 / (1 - t/10) in the whole range, which counts once.
#[test]
fn a_force_that_vanishes_throughout_ends_no_mode() -> Result<(), Box<dyn Error>> {
    let at = |t: f64| {
        let columns = |side: f64| dmatrix![side - 0.1 * t, 0.2 * t; 0.0, side + 0.3 * t];
        let none = || DMatrix::zeros(2, 2);
        ModeProblem::new(columns(1.0), columns(-1.0), none(), none(), dvector![1.0, 0.0])
    };
    let line = ModeProblemLine::between(&at(0.0)?, &at(1.0)?);
    let existence = line.existence(&options(0.0, 2.0))?;
    assert!(existence.not_computed.is_empty(), "{:?}", existence.not_computed);
    let found: Vec<_> = existence.modes.iter().map(|mode| (signs(mode), mode.from.at, mode.to.at)).collect();
    assert_eq!(found, [("++".to_owned(), 0.0, 2.0), ("+-".to_owned(), 0.0, 2.0)]);
    let counts = counts(&line, &existence, [0.0, 2.0]);
    assert_eq!(counts.iter().map(|count| count.solutions).collect::<Vec<_>>(), [1]);
    Ok(())
}

/// Two side guides that carry nothing, whatever the friction: their forces are zero but for the rounding of equations
/// that mix all contacts. Which of their faces is taken changes no interval of the others, and no force of theirs is
/// named where a mode ends. The equations `x = b + t H abs(x)` of three more contacts are turned by a random rotation.
#[test]
fn what_carries_nothing_but_rounding_ends_no_mode() -> Result<(), Box<dyn Error>> {
    let mut random = Random::new(20);
    let mut found = 0;
    for round in 0..100 {
        let size = 5;
        let couplings =
            DMatrix::from_fn(
                size,
                size,
                |row, column| {
                    if row < 2 || column < 2 { 0.0 } else { random.number() }
                },
            );
        let load = DVector::from_fn(size, |row, _| if row < 2 { 0.0 } else { 100.0 * random.number() });
        let turned = random.matrix(size, size).qr().q();
        let at = |t: f64| {
            let columns = |side: f64| &turned * (DMatrix::identity(size, size) * side - t * &couplings);
            let none = || DMatrix::zeros(size, size);
            ModeProblem::new(columns(1.0), columns(-1.0), none(), none(), &turned * &load)
        };
        let line = ModeProblemLine::between(&at(0.0)?, &at(1.0)?);
        for range in [[0.0, 2.0], [1.0, f64::INFINITY]] {
            let existence = line.existence(&options(range[0], range[1]))?;
            assert!(existence.not_computed.is_empty(), "round {round}: {:?}", existence.not_computed);
            let of_faces = |faces: &str| -> Vec<(String, [f64; 2])> {
                let modes = existence.modes.iter().filter(|mode| signs(mode).starts_with(faces));
                modes.map(|mode| (signs(mode)[2..].to_owned(), [mode.from.at, mode.to.at])).collect()
            };
            let expected = of_faces("++");
            found += expected.len();
            for faces in ["+-", "-+", "--"] {
                let other = of_faces(faces);
                assert_eq!(other.len(), expected.len(), "round {round}, {faces}: {other:?}, {expected:?}");
                for ((one, [from, to]), (same, ends)) in other.iter().zip(&expected) {
                    let is_near =
                        |one: f64, other: f64| one == other || (one - other).abs() <= 1e-7 * other.abs();
                    assert!(
                        one == same && is_near(*from, ends[0]) && is_near(*to, ends[1]),
                        "round {round}, {range:?}, {faces}: {other:?}, {expected:?}"
                    );
                }
            }
            let named = existence.modes.iter().flat_map(|mode| [&mode.from.cause, &mode.to.cause]).any(|cause| {
                matches!(cause, EndCause::SideChange(contacts) if contacts.iter().all(|contact| *contact < 2))
            });
            assert!(!named, "round {round}: {:#?}", existence.modes);
        }
    }
    assert!(found > 200, "{found}");
    Ok(())
}
