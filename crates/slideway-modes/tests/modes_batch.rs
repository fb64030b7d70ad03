//! Batches against the enumerator, against exact integer arithmetic, and the example of Klepp (2002).

use std::error::Error;

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;
use serde::Deserialize;
use slideway_modes::batch::{BatchError, BatchSolutions, FrictionBatch, MOST_CONTACTS, sides};
use slideway_modes::{BySide, InfluenceCoefficients, Limits, ModeProblem, Side, enumerate};

/// The patterns that the enumerator finds, as numbers, and their `y`.
fn enumerated(problem: &ModeProblem) -> Vec<(usize, DVector<f64>)> {
    let found = enumerate(problem, &Limits::default()).expect("a small problem");
    let mut patterns: Vec<(usize, DVector<f64>)> = found
        .solutions
        .iter()
        .flat_map(|solution| solution.patterns.iter().map(|pattern| (number(pattern), solution.y.clone())))
        .collect();
    patterns.sort_unstable_by_key(|(pattern, _)| *pattern);
    patterns
}

fn number(pattern: &[Side]) -> usize {
    pattern.iter().enumerate().map(|(k, side)| usize::from(*side == Side::Negative) << k).sum()
}

fn assert_same(
    solutions: &BatchSolutions,
    told: &[(usize, usize, Vec<f64>)],
    problems: impl IntoIterator<Item = ModeProblem>,
) {
    for (point, problem) in problems.into_iter().enumerate() {
        if solutions.is_in_doubt(point) {
            assert_eq!(solutions.patterns(point).count(), 0);
            assert_eq!(solutions.count(point), None);
            continue;
        }
        let expected = enumerated(&problem);
        let patterns: Vec<usize> = solutions.patterns(point).collect();
        assert_eq!(patterns, expected.iter().map(|(pattern, _)| *pattern).collect::<Vec<_>>(), "{problem:?}");
        let told = told.iter().filter(|(at, ..)| *at == point);
        for ((_, pattern, y), (expected_pattern, expected_y)) in told.clone().zip(&expected) {
            assert_eq!(pattern, expected_pattern);
            let error = (DVector::from_column_slice(y) - expected_y).amax();
            assert!(error <= 1e-6 * expected_y.amax(), "{y:?} is not {expected_y}");
        }
        assert_eq!(told.count(), expected.len());
    }
}

fn structure(contacts: usize) -> impl Strategy<Value = InfluenceCoefficients> {
    let numbers = move |count: usize| prop::collection::vec(-1.0..1.0, count);
    let preload = prop::collection::vec(prop_oneof![Just(0.0), 0.0..0.5], contacts);
    let signs = prop::collection::vec(prop_oneof![Just(-1.0), Just(1.0)], contacts);
    let square = contacts * contacts;
    (numbers(2 * square), numbers(contacts), preload, signs, any::<bool>(), -30..30_i32, numbers(contacts))
        .prop_map(move |(eta, load, preload, signs, one_version, unit, mu)| {
            let unit = f64::from(unit).exp();
            let eta_of =
                |at: usize| DMatrix::from_column_slice(contacts, contacts, &eta[at * square..][..square]);
            let eta = BySide { positive: eta_of(0), negative: eta_of(usize::from(!one_version)) };
            InfluenceCoefficients {
                eta_preload: eta.clone(),
                eta,
                mu: BySide::same(DVector::from_vec(mu)),
                preload: BySide::same(DVector::from_vec(preload) * unit),
                velocity_signs: DVector::from_vec(signs),
                frictionless: DVector::from_vec(load) * unit,
            }
        })
}

/// A structure, the contacts that vary, and points (one list for each of them).
fn friction_case() -> impl Strategy<Value = (InfluenceCoefficients, Vec<usize>, Vec<Vec<f64>>)> {
    (1..=5_usize).prop_flat_map(|contacts| {
        let order = Just((0..contacts).collect::<Vec<usize>>()).prop_shuffle();
        (structure(contacts), order, 1..=contacts, 1..40_usize).prop_flat_map(
            |(influence, order, varied, points)| {
                let friction = prop::collection::vec(prop::collection::vec(-2.0..2.0, points), varied);
                (Just(influence), Just(order[..varied].to_vec()), friction)
            },
        )
    })
}

fn slices(lists: &[Vec<f64>]) -> Vec<&[f64]> {
    lists.iter().map(Vec::as_slice).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn friction_batches_agree_with_the_enumerator((influence, varied, friction) in friction_case()) {
        let batch = FrictionBatch::new(&influence, &varied)?;
        let (mut solutions, mut baseline, mut told) =
            (BatchSolutions::default(), BatchSolutions::default(), Vec::new());
        let friction = slices(&friction);
        batch.solve_each(&friction, &mut solutions, |point, pattern, y| told.push((point, pattern, y.to_vec())))?;
        batch.solve_baseline(&friction, &mut baseline)?;
        let problems: Vec<ModeProblem> = (0..solutions.len())
            .map(|point| batch.problem_at(&friction.iter().map(|mu| mu[point]).collect::<Vec<_>>()))
            .collect::<Result<_, _>>()?;
        for point in 0..solutions.len() {
            let sure = !solutions.is_in_doubt(point) && !baseline.is_in_doubt(point);
            prop_assert!(!sure || solutions.patterns(point).eq(baseline.patterns(point)));
        }
        // No more than few points are in doubt by chance.
        prop_assert!(solutions.doubtful_points().count() <= 1);
        assert_same(&solutions, &told, problems);
    }

    #[test]
    fn integers_are_never_wrong(
        contacts in 1..=4_usize,
        numbers in prop::collection::vec(-3..=3_i64, 2 * 16 + 4),
        friction in prop::collection::vec(prop::collection::vec(0..=3_i64, 4), 4),
    ) {
        let (eta, load) = (&numbers[..32], &numbers[32..32 + contacts]);
        let float = |entry: i64| entry as f64;
        let matrix = |side: usize| {
            DMatrix::from_fn(contacts, contacts, |row, column| float(eta[16 * side + 4 * column + row]))
        };
        let eta_of_sides = BySide { positive: matrix(0), negative: matrix(1) };
        let batch = FrictionBatch::new(&InfluenceCoefficients {
            eta_preload: eta_of_sides.clone(),
            eta: eta_of_sides,
            mu: BySide::same(DVector::zeros(contacts)),
            preload: BySide::same(DVector::zeros(contacts)),
            velocity_signs: DVector::repeat(contacts, 1.0),
            frictionless: DVector::from_fn(contacts, |row, _| float(load[row])),
        }, &(0..contacts).collect::<Vec<_>>())?;
        let values: Vec<Vec<f64>> =
            friction[..contacts].iter().map(|values| values.iter().map(|&mu| float(mu)).collect()).collect();
        let mut solutions = BatchSolutions::default();
        batch.solve(&slices(&values), &mut solutions)?;
        let at = |point: usize| friction.iter().map(|values| values[point]).collect::<Vec<i64>>();
        for (point, mu) in (0..4).map(at).enumerate() {
            // c_k^sigma = sigma e_k - mu_k eta_k^sigma
            let columns = [1, -1].map(|sign| -> Vec<i64> {
                let entry = |at: usize| {
                    let (column, row) = (at / contacts, at % contacts);
                    let unit = if row == column { sign } else { 0 };
                    unit - mu[column] * eta[if sign == 1 { 0 } else { 16 } + 4 * column + row]
                };
                (0..contacts * contacts).map(entry).collect()
            });
            match exact(contacts, &columns[0], &columns[1], load) {
                Some(patterns) => {
                    // Determinants of integers are at least 1, far above rounding.
                    prop_assert!(!solutions.is_in_doubt(point));
                    prop_assert!(solutions.patterns(point).eq(patterns));
                }
                None => prop_assert!(solutions.is_in_doubt(point)),
            }
        }
    }
}

/// The patterns with a solution, or none if a pattern is singular, or a solution on the boundary.
fn exact(contacts: usize, positive: &[i64], negative: &[i64], load: &[i64]) -> Option<Vec<usize>> {
    let mut found = Vec::new();
    for pattern in 0..1_usize << contacts {
        let column = |k: usize| {
            let side = if pattern >> k & 1 == 0 { positive } else { negative };
            side[k * contacts..][..contacts].to_vec()
        };
        let columns: Vec<Vec<i64>> = (0..contacts).map(column).collect();
        let sign = integer_determinant(&columns).signum();
        if sign == 0 {
            return None;
        }
        let signs: Vec<i64> = (0..contacts)
            .map(|k| {
                let mut columns = columns.clone();
                columns[k] = load.to_vec();
                sign * integer_determinant(&columns).signum()
            })
            .collect();
        if signs.contains(&-1) {
            continue;
        }
        if signs.contains(&0) {
            return None;
        }
        found.push(pattern);
    }
    Some(found)
}

/// Expansion along the first row.
fn integer_determinant(columns: &[Vec<i64>]) -> i64 {
    let size = columns.len();
    if size == 0 {
        return 1;
    }
    (0..size)
        .map(|k| {
            let mut minor: Vec<Vec<i64>> = columns.iter().map(|column| column[1..].to_vec()).collect();
            minor.remove(k);
            let sign = if k % 2 == 0 { 1 } else { -1 };
            sign * columns[k][0] * integer_determinant(&minor)
        })
        .sum()
}

#[derive(Deserialize)]
struct Reference {
    parameters: Parameters,
    intervals: Vec<Intervals>,
}

#[derive(Deserialize)]
struct Parameters {
    alpha_deg: f64,
    b_over_l: f64,
    h_over_l: f64,
    mu_2: f64,
    mu_3: f64,
}

#[derive(Deserialize)]
struct Intervals {
    #[serde(rename = "F0")]
    preload: [f64; 3],
    velocity: f64,
    modes: Vec<Interval>,
}

#[derive(Deserialize)]
struct Interval {
    signs: String,
    from: f64,
    to: f64,
}

fn reference() -> Result<Reference, Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reference/klepp-2002.toml");
    Ok(toml::from_str(&std::fs::read_to_string(path)?)?)
}

/// The closed forms of the paper's section 6, `N_3` positive downwards.
fn example(parameters: &Parameters, preload: [f64; 3], velocity: f64) -> InfluenceCoefficients {
    let tangent = parameters.alpha_deg.to_radians().tan();
    let arm = parameters.h_over_l / (2.0 * parameters.b_over_l);
    let eta = |side: Side| {
        let (two, three) = (arm * side.sign(), -arm * side.sign());
        dmatrix![
            -tangent / 2.0, tangent / 2.0, tangent / 2.0;
            tangent / 4.0, two - tangent / 4.0, three - tangent / 4.0;
            -tangent / 4.0, two + tangent / 4.0, three + tangent / 4.0
        ]
    };
    let eta = BySide { positive: eta(Side::Positive), negative: eta(Side::Negative) };
    InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![0.0, parameters.mu_2, parameters.mu_3]),
        preload: BySide::same(DVector::from_row_slice(&preload)),
        velocity_signs: DVector::repeat(3, velocity),
        frictionless: dvector![0.5, 0.25, -0.25],
    }
}

#[test]
fn the_papers_example_has_its_known_modes() -> Result<(), Box<dyn Error>> {
    let reference = reference()?;
    for intervals in &reference.intervals {
        let influence = example(&reference.parameters, intervals.preload, intervals.velocity);
        let batch = FrictionBatch::new(&influence, &[0])?;
        // A sweep, and just inside and outside of every end.
        let ends = intervals.modes.iter().flat_map(|mode| [mode.from, mode.to]);
        let near = ends.flat_map(|end| [end - 2e-8, end + 2e-8]);
        let sweep = (0..8000).map(|at| (f64::from(at) + 0.5) * 1e-4);
        let friction: Vec<f64> = near.filter(|mu| (0.0..0.8).contains(mu)).chain(sweep).collect();
        let mut solutions = BatchSolutions::default();
        batch.solve(&[&friction], &mut solutions)?;
        assert_eq!(solutions.doubtful_points().count(), 0);
        for (point, mu) in friction.iter().enumerate() {
            let existing = intervals.modes.iter().filter(|mode| mode.from < *mu && *mu < mode.to);
            let mut expected: Vec<usize> = existing
                .map(|mode| {
                    mode.signs.chars().enumerate().map(|(k, sign)| usize::from(sign == '-') << k).sum()
                })
                .collect();
            expected.sort_unstable();
            assert_eq!(solutions.patterns(point).collect::<Vec<_>>(), expected, "mu_1 = {mu}");
        }
    }
    Ok(())
}

#[test]
fn the_double_boundary_is_in_doubt() -> Result<(), Box<dyn Error>> {
    let reference = reference()?;
    let influence = example(&reference.parameters, [0.0; 3], -1.0);
    let change = reference.parameters.alpha_deg.to_radians().tan().recip();
    let mut solutions = BatchSolutions::default();
    FrictionBatch::new(&influence, &[0])?.solve(&[&[change]], &mut solutions)?;
    assert!(solutions.is_in_doubt(0));
    Ok(())
}

fn single_slider(load: f64) -> InfluenceCoefficients {
    InfluenceCoefficients {
        eta: BySide::same(dmatrix![0.5]),
        eta_preload: BySide::same(dmatrix![0.5]),
        mu: BySide::same(dvector![0.0]),
        preload: BySide::same(dvector![0.0]),
        velocity_signs: dvector![1.0],
        frictionless: dvector![load],
    }
}

#[test]
fn next_to_locking_a_mask_is_right_or_in_doubt() -> Result<(), Box<dyn Error>> {
    let batch = FrictionBatch::new(&single_slider(4.0), &[0])?;
    let mut friction = vec![2.0_f64];
    for _ in 0..100 {
        let (below, above) = (friction[0].next_down(), friction[friction.len() - 1].next_up());
        friction.insert(0, below);
        friction.push(above);
    }
    let mut solutions = BatchSolutions::default();
    batch.solve(&[&friction], &mut solutions)?;
    assert!(solutions.is_in_doubt(100));
    for (point, &mu) in friction.iter().enumerate() {
        let expected = u32::from(mu < 2.0);
        assert!(solutions.count(point).is_none_or(|count| count == expected));
    }
    // Not everything is in doubt.
    assert_eq!(solutions.count(0), Some(1));
    assert_eq!(solutions.count(200), Some(0));
    Ok(())
}

#[test]
fn numbers_that_mean_nothing_are_in_doubt() -> Result<(), Box<dyn Error>> {
    let mut solutions = BatchSolutions::default();
    let batch = FrictionBatch::new(&single_slider(4.0), &[0])?;
    let friction = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 0.5];
    batch.solve(&[&friction], &mut solutions)?;
    assert_eq!(solutions.doubtful_points().collect::<Vec<_>>(), [0, 1, 2, 3]);
    FrictionBatch::new(&single_slider(0.0), &[0])?.solve(&[&[0.1, 0.2]], &mut solutions)?;
    assert_eq!(solutions.doubtful_points().count(), 2);
    Ok(())
}

#[test]
fn the_largest_batches_agree_with_the_enumerator() -> Result<(), Box<dyn Error>> {
    for contacts in [6, 7, MOST_CONTACTS] {
        for preload in [0.0, 0.1] {
            let entry = |at: usize| ((at * at + 3 * at) % 101) as f64 / 50.0 - 1.0;
            let eta = |shift: usize| {
                DMatrix::from_fn(contacts, contacts, |row, column| entry(shift + 13 * row + 7 * column + 1))
            };
            let eta = BySide { positive: eta(0), negative: eta(500) };
            let influence = InfluenceCoefficients {
                eta_preload: eta.clone(),
                eta,
                mu: BySide::same(DVector::repeat(contacts, 0.3)),
                preload: BySide::same(DVector::from_fn(contacts, |k, _| if k == 2 { preload } else { 0.0 })),
                velocity_signs: DVector::repeat(contacts, 1.0),
                frictionless: DVector::from_fn(contacts, |k, _| entry(40 + 11 * k)),
            };
            let varied = [1, contacts - 1, 0];
            let batch = FrictionBatch::new(&influence, &varied)?;
            let friction: Vec<Vec<f64>> =
                (0..3).map(|k| (0..7).map(|point| entry(70 * k + 9 * point + 1).abs()).collect()).collect();
            let (mut solutions, mut told) = (BatchSolutions::default(), Vec::new());
            batch.solve_each(&slices(&friction), &mut solutions, |point, pattern, y| {
                told.push((point, pattern, y.to_vec()));
            })?;
            let problems: Vec<ModeProblem> = (0..7)
                .map(|point| batch.problem_at(&[0, 1, 2].map(|k: usize| friction[k][point])))
                .collect::<Result<_, _>>()?;
            assert_eq!(solutions.doubtful_points().count(), 0);
            assert!(!told.is_empty());
            assert_same(&solutions, &told, problems);
        }
    }
    Ok(())
}

#[test]
fn every_number_of_points_gives_the_same_answers() -> Result<(), Box<dyn Error>> {
    let reference = reference()?;
    let batch = FrictionBatch::new(&example(&reference.parameters, [0.0, 1.0, 0.0], 1.0), &[0])?;
    let friction: Vec<f64> = (0..100).map(|at| f64::from(at) * 0.00801).collect();
    let (mut all, mut some) = (BatchSolutions::default(), BatchSolutions::default());
    batch.solve(&[&friction], &mut all)?;
    for count in [0, 1, 2, 31, 32, 33, 64, 99, 100] {
        batch.solve(&[&friction[..count]], &mut some)?;
        assert_eq!((some.len(), some.is_empty()), (count, count == 0));
        assert_eq!(some.masks(), &all.masks()[..count]);
    }
    Ok(())
}

#[test]
fn input_that_does_not_fit_is_told() {
    let influence = single_slider(1.0);
    let mut solutions = BatchSolutions::default();
    assert_eq!(FrictionBatch::new(&influence, &[1]).err(), Some(BatchError::Varied { contact: 1 }));
    assert_eq!(FrictionBatch::new(&influence, &[0, 0]).err(), Some(BatchError::Varied { contact: 0 }));
    let mut wrong = influence.clone();
    wrong.velocity_signs[0] = 0.5;
    assert!(matches!(FrictionBatch::new(&wrong, &[0]), Err(BatchError::Problem(_))));
    let batch = FrictionBatch::new(&influence, &[0]).expect("one contact");
    assert_eq!(batch.solve(&[], &mut solutions), Err(BatchError::Length { expected: 1, found: 0 }));
    assert_eq!(batch.problem_at(&[0.1, 0.2]), Err(BatchError::Length { expected: 1, found: 2 }));
    assert_eq!(sides(0b101, 3), [Side::Negative, Side::Positive, Side::Negative]);
}
