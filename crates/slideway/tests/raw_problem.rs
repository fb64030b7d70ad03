//! Raw problems: the solutions solve them, all are found, and the readers survive anything.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway::Report;
use slideway::modes::{Limits, SearchOptions};
use slideway::raw_problem::{
    RawContinuum, RawProblem, RawReport, RawShares, RawUnknown, Unknowns, WithinRoundingAnswer, solve, to_npz,
};
use slideway::report::{Proof, Status, Style};
use std::ops::ControlFlow;

fn solved(problem: &RawProblem) -> RawReport {
    solve(problem, &SearchOptions::default(), 1000, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn lcp(m: DMatrix<f64>, q: &[f64]) -> RawProblem {
    RawProblem::LinearComplementarity { m, q: DVector::from_column_slice(q) }
}

/// `z - w` of the vertices and directions of a continuum that has one part.
fn generators(continuum: &RawContinuum) -> Vec<Vec<f64>> {
    let [part] = continuum.parts.as_slice() else { panic!("one part") };
    part.vertices.iter().chain(&part.directions).map(signed).collect()
}

fn signed(unknowns: &Unknowns) -> Vec<f64> {
    let Unknowns::Complementary { z, w } = unknowns else { panic!("z and w") };
    z.iter().zip(w).map(|(z, w)| z - w).collect()
}

/// Whether solutions are all that a pattern admits, or part of it: none has the other sign anywhere.
fn fits(values: &[f64], pattern: &str) -> bool {
    let fits = |(value, side): (&f64, char)| if side == '+' { *value >= 0.0 } else { *value <= 0.0 };
    values.iter().zip(pattern.chars()).all(fits)
}

/// A size with numbers for two matrices and a vector. Random ones, so that no pattern is degenerate.
fn numbers() -> impl Strategy<Value = (DMatrix<f64>, DMatrix<f64>, DVector<f64>)> {
    let entries = |count| prop::collection::vec(-1.0..1.0_f64, count);
    (1_usize..6).prop_flat_map(move |n| {
        (entries(n * n), entries(n * n), entries(n)).prop_map(move |(a, b, q)| {
            (DMatrix::from_vec(n, n, a), DMatrix::from_vec(n, n, b), DVector::from_vec(q))
        })
    })
}

/// The number of solutions of `A w - B z = q` by one factorization for each pattern.
fn brute_force(a: &DMatrix<f64>, b: &DMatrix<f64>, q: &DVector<f64>) -> usize {
    let n = q.len();
    let admits = |pattern: &usize| {
        let column = |k: usize| if pattern >> k & 1 == 1 { -b.column(k) } else { a.column(k).into_owned() };
        let matrix = DMatrix::from_columns(&(0..n).map(column).collect::<Vec<_>>());
        matrix.full_piv_lu().solve(q).is_some_and(|y| y.iter().all(|&y| y >= 0.0))
    };
    (0..1_usize << n).filter(admits).count()
}

/// `z - w` of the solutions of `w - M z = q` that are the only one with their positive unknowns: one system of
/// equations for each choice of these. For small whole numbers: then the determinant is one, too, and what is not zero
/// is not small.
fn basic_solutions(m: &DMatrix<f64>, q: &DVector<f64>) -> Vec<DVector<f64>> {
    let n = q.len();
    let places = u32::try_from(n).expect("few");
    let solution = |choice: u32| {
        let signs: Vec<f64> = (0..places).map(|k| f64::from(choice / 3_u32.pow(k) % 3) - 1.0).collect();
        let chosen: Vec<usize> = (0..n).filter(|&k| signs[k] != 0.0).collect();
        let matrix = DMatrix::from_fn(n, chosen.len(), |row, at| match chosen[at] {
            k if signs[k] > 0.0 => -m[(row, k)],
            k => f64::from(u8::from(row == k)),
        });
        let gram = matrix.transpose() * &matrix;
        let inverse = (gram.determinant() > 0.5).then(|| gram.try_inverse()).flatten()?;
        let sizes = inverse * matrix.transpose() * q;
        let solves = (&matrix * &sizes - q).amax() <= 1e-9 && sizes.iter().all(|&size| size > 1e-9);
        let mut signed = DVector::zeros(n);
        chosen.iter().zip(&sizes).for_each(|(&k, size)| signed[k] = signs[k] * size);
        solves.then_some(signed)
    };
    (0..3_u32.pow(places)).filter_map(solution).collect()
}

fn text(matrix: &DMatrix<f64>) -> String {
    let row = |row: usize| format!("{:?}", matrix.row(row).iter().collect::<Vec<_>>());
    format!("[{}]", (0..matrix.nrows()).map(row).collect::<Vec<_>>().join(", "))
}

fn vector(vector: &DVector<f64>) -> String {
    format!("{:?}", vector.as_slice())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn solutions_of_an_lcp_are_all_of_them((m, _, q) in numbers()) {
        let json = format!(r#"{{"type": "lcp", "M": {}, "q": {}}}"#, text(&m), vector(&q));
        let problem = RawProblem::from_json(json.as_bytes()).unwrap();
        // Every digit of the numbers arrives.
        prop_assert_eq!(&problem, &RawProblem::LinearComplementarity { m: m.clone(), q: q.clone() });
        let report = solved(&problem);
        let identity = DMatrix::identity(q.len(), q.len());
        prop_assert_eq!(report.count.parse::<usize>().unwrap(), brute_force(&identity, &m, &q));
        prop_assert_eq!(report.complete, Proof::Proven);
        for solution in &report.solutions {
            let Unknowns::Complementary { z, w } = &solution.unknowns else { panic!("z and w") };
            let largest = z.iter().chain(w).fold(1.0_f64, |largest, value| largest.max(*value));
            let left = &m * DVector::from_column_slice(z) + &q - DVector::from_column_slice(w);
            prop_assert!(left.amax() <= 1e-12 * largest);
            prop_assert!(solution.residual.unwrap() <= 1e-13);
            prop_assert!(solution.enclosure_radius.is_some_and(|radius| radius <= 1e-8 * largest));
            for (z, w) in z.iter().zip(w) {
                prop_assert!(*z >= 0.0 && *w >= 0.0 && z * w == 0.0);
            }
        }
    }

    #[test]
    fn solutions_of_an_absolute_value_equation_are_all_of_them((a, b, q) in numbers()) {
        let json = format!(r#"{{"A": {}, "B": {}, "b": {}}}"#, text(&a), text(&b), vector(&q));
        let report = solved(&RawProblem::from_json(json.as_bytes()).unwrap());
        // x = z - w, |x| = z + w: (B - A) w - (-A - B) z = b
        prop_assert_eq!(report.count.parse::<usize>().unwrap(), brute_force(&(&b - &a), &(-&a - &b), &q));
        prop_assert_eq!(report.complete, Proof::Proven);
        for solution in &report.solutions {
            let Unknowns::AbsoluteValue { x } = &solution.unknowns else { panic!("x") };
            let x = DVector::from_column_slice(x);
            prop_assert!((&a * &x + &b * x.abs() - &q).amax() <= 1e-12 * x.amax().max(1.0));
        }
    }

    #[test]
    fn solutions_of_a_horizontal_lcp_are_all_of_them((a, b, q) in numbers()) {
        let json = format!(r#"{{"A": {}, "B": {}, "q": {}}}"#, text(&a), text(&b), vector(&q));
        let report = solved(&RawProblem::from_json(json.as_bytes()).unwrap());
        prop_assert_eq!(report.count.parse::<usize>().unwrap(), brute_force(&a, &b, &q));
        for solution in &report.solutions {
            let Unknowns::Complementary { z, w } = &solution.unknowns else { panic!("z and w") };
            let (z, w) = (DVector::from_column_slice(z), DVector::from_column_slice(w));
            prop_assert!((&a * &w - &b * &z - &q).amax() <= 1e-12 * z.amax().max(w.amax()).max(1.0));
        }
    }

    #[test]
    fn degenerate_problems_are_told_in_every_form(entries in prop::collection::vec(-1..=1_i8, 12)) {
        let number = |at: usize| f64::from(entries[at]);
        let m = DMatrix::from_fn(3, 3, |row, column| number(3 * row + column));
        let q = DVector::from_fn(3, |row, _| number(9 + row));
        let report = solved(&RawProblem::LinearComplementarity { m: m.clone(), q: q.clone() });
        prop_assert!(!report.partial);
        for solution in &report.solutions {
            prop_assert!(solution.residual.unwrap() <= 1e-14);
        }
        for continuum in &report.continua {
            let [part] = continuum.parts.as_slice() else { panic!("one part") };
            prop_assert!(!part.vertices.is_empty());
            for direction in &part.directions {
                let Unknowns::Complementary { z, w } = direction else { panic!("z and w") };
                prop_assert!((&m * DVector::from_column_slice(z) - DVector::from_column_slice(w)).amax() <= 1e-12);
            }
        }
        // No listed set is part of another one: told from the signs that patterns allow.
        let sets: Vec<(&str, Vec<Vec<f64>>)> =
            report.continua.iter().map(|one| (one.pattern.as_str(), generators(one))).collect();
        for (at, (_, own)) in sets.iter().enumerate() {
            let within = |(other, (pattern, _)): (usize, &(&str, _))| other != at && own.iter().all(|point| fits(point, pattern));
            prop_assert!(!sets.iter().enumerate().any(within));
        }
        let points: Vec<Vec<f64>> = report.solutions.iter().map(|one| signed(&one.unknowns)).collect();
        prop_assert!(!points.iter().any(|point| sets.iter().any(|(pattern, _)| fits(point, pattern))));
        // What is left out is part of what is listed.
        for corner in basic_solutions(&m, &q) {
            let is_it = |point: &Vec<f64>| (DVector::from_column_slice(point) - &corner).amax() <= 1e-9;
            let is_listed = points.iter().any(is_it) || sets.iter().any(|(pattern, _)| fits(corner.as_slice(), pattern));
            prop_assert!(is_listed, "{corner} is part of nothing that is listed");
        }
        prop_assert_eq!(report.solutions.len(), report.count.parse::<usize>().unwrap());
        prop_assert!(report.groups.iter().all(|group| (sum(&group.patterns) - 1.0).abs() <= 1e-12));
        prop_assert!(report.json().contains("slideway/modes/3"));
        prop_assert!(report.text(Style::PLAIN).contains("roven"));
        prop_assert!(to_npz(&report).starts_with(b"PK"));
    }

    #[test]
    fn random_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = RawProblem::from_json(&bytes);
        let _ = RawProblem::from_npz(&bytes);
        let _ = RawProblem::from_bytes(&bytes);
    }

    #[test]
    fn problems_with_changed_bytes_are_read_or_refused(
        archive in any::<bool>(), changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)
    ) {
        let npz = include_bytes!("../../slideway-cli/tests/raw/npz/plain.npz").as_slice();
        let json = br#"{"type": "lcp", "M": [[1, -1], [-1, 1e0]], "q": [-1, 1]}"#.as_slice();
        let mut bytes = if archive { npz } else { json }.to_vec();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let solved = RawProblem::from_bytes(&bytes)
            .ok()
            .and_then(|problem| solve(&problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(())).ok());
        prop_assert!(solved.is_none_or(|report| report.text(Style::PLAIN).contains("roven")));
    }
}

#[test]
fn independent_unknowns_multiply() {
    let n = 100;
    let problem =
        RawProblem::LinearComplementarity { m: -DMatrix::identity(n, n), q: DVector::from_element(n, 1.0) };
    let report = solved(&problem);
    assert_eq!(report.count, "1267650600228229401496703205376");
    assert_eq!((report.solutions.len(), report.status), (1000, Status::Several));
}

#[test]
fn continua_among_very_many_solutions_are_listed() {
    // One unknown with w = 0 for all z >= 0 beside 70 with two solutions each.
    let n = 71;
    let mut m = -DMatrix::identity(n, n);
    m[(n / 2, n / 2)] = 0.0;
    let mut q = DVector::from_element(n, 1.0);
    q[n / 2] = 0.0;
    let report = solved(&RawProblem::LinearComplementarity { m, q });
    assert_eq!(report.status, Status::Continuum);
    // The single solutions are the ends of the rays.
    assert_eq!((report.count.as_str(), report.solutions.len()), ("0", 0));
    assert_eq!(report.continuum_count, (1_u128 << 70).to_string());
    assert_eq!(report.continua.len(), 1000);
}

/// The fractions of a group's patterns together, each of which the JSON output has.
fn sum(shares: &RawShares) -> f64 {
    let shares = serde_json::to_value(shares).unwrap();
    shares.as_object().unwrap().values().map(|share| share.as_f64().unwrap()).sum()
}

fn solution_of(json: &str) -> RawReport {
    solved(&RawProblem::from_json(json.as_bytes()).unwrap())
}

/// With both unknowns in their gaps 5 = 4 lambda_1 + 2 lambda_2 in both equations: from lambda = (3/4, 1) to
/// (1, 1/2). The ends belong to patterns with one unknown in its gap, and are no states besides.
#[test]
fn shares_that_may_be_exchanged_are_one_gap_state() {
    let report = solution_of(
        r#"{"type": "modes", "columns_positive": [[1, -2], [-1, 1]], "columns_negative": [[-1, -1], [1, 2]],
            "jumps_positive": [[-2, -1], [-2, -1]], "jumps_negative": [[2, 1], [2, 1]], "right_hand_side": [2, 2]}"#,
    );
    assert_eq!(
        (report.complete, report.count.as_str(), report.gap_state_count.as_str()),
        (Proof::Proven, "2", "1")
    );
    let [state] = report.gap_states.as_slice() else { panic!("one state") };
    let shares: Vec<(usize, f64)> = state.gaps.iter().map(|gap| (gap.index, gap.lambda)).collect();
    assert_eq!(shares, [(0, 0.875), (1, 0.75)]);
    assert!(state.shares_vary && state.residual == Some(0.0) && !state.on_boundary);
    let told = report.text(Style::PLAIN.verbose(true).width(1000));
    assert!(told.contains("These shares are an example: others have the same values"), "{told}");
    assert!(report.json().contains("\"shares_vary\": true"));
}

/// A pattern whose determinant is 1e-12 of its terms. Elimination in fractions (Python's) gives, for these
/// very numbers, `N_1 = -573611896603267211751828659652045 / 1151026745007804056679198866014208`,
/// `N_2 = -6755399441061368 / 1022317115413610417` and the share `2024368032505066551 / 8178536923308883336`.
#[test]
fn values_of_nearly_singular_patterns_are_as_accurate_as_others() {
    let report = solution_of(
        r#"{"type": "modes", "columns_positive": [[-1, -1, -1], [2, 0, -2], [-1, -1, 0]],
            "columns_negative": [[2, -1, 0], [2, 2.0000000000002, 1.9999999999999982], [-2, -1.9999999999999996, 0]],
            "right_hand_side": [0, 2.0000000000000004, -2],
            "jumps_positive": [[-2, 1, 2.000000000002], [-1, -1, -1.9999999999999982], [-2, 0, 2]],
            "jumps_negative": [[1.0000000000000009, 1, -2.000000000002], [-1, -1, 1.9999999999999982],
                               [2.0000000000000018, 0, -2]]}"#,
    );
    let [state] = report.gap_states.as_slice() else { panic!("one state") };
    let Unknowns::Modes { normal_forces, .. } = &state.unknowns else { panic!("normal forces") };
    let told = [normal_forces[0], normal_forces[1], state.gaps[0].lambda];
    for (told, exact) in
        told.into_iter().zip([-0.498_348_017_620_892_1, -0.006_607_929_515_420_721, 0.247_522_026_431_843_15])
    {
        assert!((told - exact).abs() <= 2.0 * f64::EPSILON * exact.abs(), "{told} instead of {exact}");
    }
}

/// z_1 = 1e10 / 1e-300 and z_2 = 1, which is told as every other number.
#[test]
fn values_beyond_floating_point_numbers_are_told_as_text() {
    let report = solution_of(r#"{"type": "lcp", "M": [[1e-300, 0], [0, 1]], "q": [-1e10, -1]}"#);
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
    let [solution] = report.solutions.as_slice() else { panic!("one solution") };
    assert_eq!(solution.signs, [1, 1]);
    // The numbers are exact, and so is what is left over.
    assert_eq!(solution.residual, Some(0.0));
    let [value] = solution.beyond_range.as_slice() else { panic!("one value") };
    assert_eq!((value.name, value.index, value.value.as_str()), (RawUnknown::Z, 0, "9.9999999999999997e309"));
    let json = report.json();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["solutions"][0]["z"], serde_json::json!([null, 1.0]));
    assert_eq!(json["solutions"][0]["w"], serde_json::json!([0.0, 0.0]));
    assert!(report.text(Style::PLAIN).contains("9.9999999999999997e309"));
    assert!(!to_npz(&report).is_empty());
}

/// z = 1e-20 / 1e308, and x_1 = 1e-320 beside x_2 = -1e310.
#[test]
fn values_too_small_for_floating_point_numbers_are_not_zero() {
    let report = solution_of(r#"{"type": "lcp", "M": [[1e308]], "q": [-1e-20]}"#);
    assert_eq!((report.status, report.solutions[0].signs.as_slice()), (Status::One, &[1_i8][..]));
    assert_eq!(report.solutions[0].beyond_range[0].value, "9.9999999999999993e-329");
    let report = solution_of(
        r#"{"type": "ave", "A": [[1e300, 0], [0, 1e-300]], "B": [[0, 0], [0, 0]], "b": [1e-20, -1e10]}"#,
    );
    let values: Vec<&str> = report.solutions[0].beyond_range.iter().map(|one| one.value.as_str()).collect();
    assert_eq!(values, ["9.9999999999999989e-321", "-9.9999999999999997e309"]);
}

/// Column 2 is a best response to both rows of the second player's payoffs, and column 3 is another one where the first
/// player mixes its rows as (1 - p, p) with -3e-308 (1 - p) + 1e308 p = -3e-308 p. There p = 3e-616, and the second player
/// gets -3e-308 p = -9e-924: too small for a number, but not zero.
#[test]
fn a_payoff_too_small_for_floating_point_numbers_is_not_zero() {
    let raw = RawProblem::from_json(
        br#"{"type": "game", "A": [[0, 0, -3], [0, 0, 1]], "B": [[-3, 0, -3e-308], [1e-323, -3e-308, 1e308]]}"#,
    )
    .unwrap();
    let mut options = SearchOptions::default();
    options.limits.solutions = 1;
    let report = solve(&raw, &options, 10, &mut |_| ControlFlow::Continue(())).unwrap();
    let [solution] = report.solutions.as_slice() else { panic!("one solution") };
    let told: Vec<(RawUnknown, &str)> =
        solution.beyond_range.iter().map(|one| (one.name, one.value.as_str())).collect();
    assert_eq!(
        told,
        [(RawUnknown::X, "3.0000000000000002e-616"), (RawUnknown::Payoff2, "-9.0000000000000012e-924")]
    );
}

/// The end of the ray is (1e310, 0), its direction (1, 1).
#[test]
fn an_end_of_a_continuum_beyond_floating_point_numbers_has_no_value() {
    let report =
        solution_of(r#"{"type": "lcp", "M": [[1e-300, -1e-300], [-1e-300, 1e-300]], "q": [-1e10, 1e10]}"#);
    assert_eq!((report.status, report.complete), (Status::Continuum, Proof::Proven));
    let Unknowns::Complementary { z, .. } = &report.continua[0].parts[0].vertices[0] else {
        panic!("z and w")
    };
    assert!(z[0].is_nan() && z[1] == 0.0, "{z:?}");
    assert!(report.text(Style::PLAIN).contains("beyond the range of numbers"));
}

/// A + B = 1e16 + 1 is no floating-point number; x = (1, 1) and (-1, -1).
#[test]
fn sums_of_an_absolute_value_equation_are_not_rounded() {
    let json = r#"{"type": "ave", "A": [[1e16, -1e16], [1, -1]], "B": [[1, 0], [0, 0]], "b": [1, 0]}"#;
    let report = solution_of(json);
    assert_eq!((report.count.as_str(), report.complete), ("2", Proof::Proven));
    let told: Vec<&Unknowns> = report.solutions.iter().map(|solution| &solution.unknowns).collect();
    assert_eq!(told, [1.0, -1.0].map(|x| Unknowns::AbsoluteValue { x: vec![x, x] }).each_ref());
}

/// The jumps differ by 1e-13, and N = 0 lies in the middle.
#[test]
fn jumps_differ_if_they_differ_at_all() {
    let json = r#"{"type": "modes", "columns_positive": [[1]], "columns_negative": [[-1]],
        "right_hand_side": [-1.00000000000005], "jumps_positive": [[1]], "jumps_negative": [[1.0000000000001]]}"#;
    let report = solution_of(json);
    assert_eq!((report.status, report.complete), (Status::PreloadGap, Proof::Proven));
    assert!((report.gap_states[0].gaps[0].lambda - 0.5).abs() < 2e-3);
}

#[test]
fn a_search_that_ends_early_never_says_none() {
    let m = DMatrix::from_fn(12, 12, |row, column| ((7 * row + 5 * column + row * column) % 11) as f64 - 5.0);
    let problem = RawProblem::LinearComplementarity { m, q: DVector::from_element(12, -1.0) };
    let options = SearchOptions { nodes: 1, ..SearchOptions::default() };
    let report = solve(&problem, &options, 10, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((report.status, report.complete, report.partial), (Status::Unknown, Proof::NotProven, true));
    assert_eq!(report.open.len(), 1);
    let report = solve(&problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Break(())).unwrap();
    assert_eq!(report.status, Status::Unknown);
}

#[test]
fn without_proofs_nothing_is_proven() {
    let problem = RawProblem::from_json(br#"{"M": [[2]], "q": [-4]}"#).unwrap();
    let options = SearchOptions { certify: false, ..SearchOptions::default() };
    let report = solve(&problem, &options, 10, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((report.count.as_str(), report.complete), ("1", Proof::NotProven));
}

/// `w = 0` for every `z >= 0`: one orthant, whose 7 faces are what the other patterns admit.
#[test]
fn an_orthant_is_one_continuum() {
    let report = solved(&lcp(DMatrix::zeros(3, 3), &[0.0; 3]));
    assert_eq!((report.status, report.complete), (Status::Continuum, Proof::Proven));
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("0", "1"));
    assert!(report.solutions.is_empty());
    let [orthant] = report.continua.as_slice() else { panic!("one") };
    assert_eq!((orthant.parts[0].vertex_count, orthant.parts[0].direction_count), (1, 3));
}

/// Each unknown by itself is a ray; the product of 400 rays is told as such.
#[test]
fn an_orthant_of_many_unknowns_is_told_in_few_words() {
    let report = solved(&lcp(DMatrix::zeros(400, 400), &[0.0; 400]));
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("0", "1"));
    assert_eq!(report.continua[0].parts.len(), 400);
    assert!(report.json().len() < 500_000 && report.text(Style::PLAIN).len() < 5000);
}

/// Nobody's payoff depends on anything, so that every pair of strategies is an equilibrium: the product of two
/// simplices. Most patterns are settled without being solved, as their solutions are those of the largest one.
#[test]
fn patterns_settled_by_a_face_are_told() {
    let ones = DMatrix::from_element(5, 5, 1.0);
    let report = solved(&RawProblem::Game { a: ones.clone(), b: ones });
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("0", "1"));
    assert_eq!(report.continua[0].parts.iter().map(|part| part.vertex_count).collect::<Vec<_>>(), [5, 5]);
    let [group] = report.groups.as_slice() else { panic!("one group") };
    assert!(group.patterns.faces > 0.0, "{:?}", group.patterns);
    assert!((sum(&group.patterns) - 1.0).abs() <= 1e-12, "{:?}", group.patterns);
    let told = report.text(Style::PLAIN.verbose(true).width(1000));
    assert!(told.contains(" % all of whose solutions are those of another pattern, "), "{told}");
}

/// What is listed of each part is bounded, too.
#[test]
fn a_cube_of_many_corners_lists_those_that_were_asked_for() {
    // z_1 + ... + z_9 = 1: a simplex with 9 ends.
    let problem = lcp(DMatrix::from_element(9, 9, 1.0), &[-1.0; 9]);
    let report = solve(&problem, &SearchOptions::default(), 4, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("0", "1"));
    let part = &report.continua[0].parts[0];
    assert_eq!((part.vertices.len(), part.vertex_count), (4, 9));
    assert!(report.text(Style::PLAIN).contains("There are 5 ends and directions more"));
}

/// `N_1 = -1e-10, N_2 = 1, N_3 = -1e-10` is close to the end of the ray `N_1 >= 0, N_2 = 1, N_3 = 1e-10`, and
/// no part of it.
#[test]
fn a_solution_close_to_a_continuum_is_no_part_of_it() {
    let json = br#"{"type": "modes", "columns_positive": [[0, 0, 2], [0, 1, 0], [0, 0, 1]],
        "columns_negative": [[1, 0, 1], [0, -1, 0], [0, 0, 1]], "right_hand_side": [2e-10, 1, 1e-10]}"#;
    let report = solved(&RawProblem::from_json(json).unwrap());
    assert_eq!((report.count.as_str(), report.continuum_count.as_str()), ("1", "1"));
    assert_eq!(report.solutions[0].signs, [-1, 1, -1]);
}

/// `z_k` is 0 or 1, and the last two rows ask for `sum a_k z_k = b`: with even `a_k` and odd `b` there is no
/// solution, and a group of the last unknowns finds that out for each of 2^40 combinations. A search that is
/// ended does not go through all of them.
#[test]
fn a_search_among_very_many_combinations_ends_when_it_is_told_to() {
    let n = 40;
    let m = DMatrix::from_fn(n + 2, n + 2, |row, column| match (row, column) {
        (row, column) if column < n && row == n => 2.0 * (column * column + 1) as f64,
        (row, column) if column < n && row == n + 1 => -2.0 * (column * column + 1) as f64,
        (row, column) if row == column && row < n => -1.0,
        _ => 0.0,
    });
    let q = DVector::from_fn(n + 2, |row, _| if row < n { 1.0 } else { [-20_001.0, 20_001.0][row - n] });
    let options = SearchOptions { nodes: 500, ..SearchOptions::default() };
    let problem = RawProblem::LinearComplementarity { m, q };
    let report = solve(&problem, &options, 10, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((report.status, report.partial), (Status::Unknown, true));
    assert!(report.open[0].starts_with("the limit of 500 nodes was reached"), "{:?}", report.open);
}

#[test]
fn a_limit_of_solutions_is_told() {
    let limits = Limits { solutions: 2, ..Limits::default() };
    let options = SearchOptions { limits, ..SearchOptions::default() };
    // z = 0 and w = 1, or z = 1 and w = 0, for each of three unknowns.
    let problem = lcp(-DMatrix::identity(3, 3), &[1.0; 3]);
    let report = solve(&problem, &options, 10, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((report.count.as_str(), report.complete, report.partial), ("2", Proof::NotProven, true));
    assert!(report.open[0].starts_with("the limit of 2 solutions of a group"), "{:?}", report.open);
}

/// A pile without friction: `M = J J^T` of rank 2 for four contacts, and `q = -M z` for `z = (2, 3, 3, 0)`,
/// so that this `z` with `w = 0` is a solution. Rounding of `M` and `q` takes all solutions away.
#[test]
fn a_pile_without_friction_has_a_solution_within_rounding() {
    let j = [[-0.8, 0.2], [0.9, -0.9], [-0.2, 0.7], [0.1, 0.6]];
    let m = DMatrix::from_fn(4, 4, |row, column| j[row][0] * j[column][0] + j[row][1] * j[column][1]);
    let q = DVector::from_fn(4, |row, _| {
        [2.0, 3.0, 3.0, 0.0].iter().enumerate().fold(0.0, |sum, (at, z)| sum - m[(row, at)] * z)
    });
    let report = solved(&lcp(m.clone(), q.as_slice()));
    assert_eq!((report.status, report.complete), (Status::None, Proof::Proven));
    let within = report.within_rounding.as_ref().unwrap();
    assert_eq!(within.answer, WithinRoundingAnswer::Solution);
    let Some(Unknowns::Complementary { z, w }) = &within.unknowns else { panic!("z and w") };
    let z = DVector::from_column_slice(z);
    assert!(z.amax() < 10.0 && z.min() >= 0.0);
    // The problem is monotone, so that w is the same for all solutions: zero.
    assert!(w.iter().all(|&w| w == 0.0));
    let (left, size) = (&m * &z + &q, &m.abs() * &z + q.abs());
    assert!(left.iter().zip(&size).all(|(left, size)| left.abs() <= 2e-15 * size));
    // The same in exact numbers: J^T z is that of the z above, (0.5, -0.2).
    let forces = [0, 1].map(|at| (0..4).map(|row| j[row][at] * z[row]).sum::<f64>());
    assert!((forces[0] - 0.5).abs() < 1e-14 && (forces[1] + 0.2).abs() < 1e-14, "{forces:?}");
    assert!(
        report
            .text(Style::PLAIN)
            .contains("Hint: for numbers that differ by rounding alone (relative 1e-15) there is one")
    );
}

#[test]
fn what_rounding_does_not_change_gets_no_hint() {
    let answer =
        |json: &[u8]| solved(&RawProblem::from_json(json).unwrap()).within_rounding.map(|it| it.answer);
    // w = z - 1 with z = 0: zeros are exact.
    assert_eq!(answer(br#"{"M": [[0]], "q": [-1]}"#), Some(WithinRoundingAnswer::None));
    // With 0.1 + 1e-16 on the diagonal z_1 = z_2 = 1e16 would do: rounding would carry the load.
    assert_eq!(
        answer(br#"{"M": [[0.1, -0.1], [-0.1, 0.1]], "q": [-1, -1]}"#),
        Some(WithinRoundingAnswer::Unknown)
    );
    assert_eq!(answer(br#"{"M": [[2]], "q": [-1]}"#), None);
}

/// What names an archive has is told, but not every one of thousands.
#[test]
fn long_lists_of_names_are_cut() {
    let names = |count: usize| (0..count).map(|at| format!("\"a{at}\": 0")).collect::<Vec<_>>().join(", ");
    let told = |count: usize| {
        RawProblem::from_json(format!("{{{}}}", names(count)).as_bytes()).unwrap_err().to_string()
    };
    assert!(told(20).contains("`a18` and `a19`"), "{}", told(20));
    assert!(told(7000).contains("and 6980 more") && told(7000).len() < 1000, "{}", told(7000));
}
