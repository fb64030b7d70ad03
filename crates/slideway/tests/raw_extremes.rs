//! Raw problems with numbers of every size that a file can hold: what is told is true, and no form of the answer fails.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde_json::{Value, json};
use slideway::Report;
use slideway::modes::{Limits, SearchOptions};
use slideway::raw_problem::{RawKind, RawProblem, RawReport, solve, to_npz};
use slideway::report::Style;

fn answer(problem: &Value) -> RawReport {
    let problem = RawProblem::from_json(problem.to_string().as_bytes())
        .unwrap_or_else(|faults| panic!("{faults}: {problem}"));
    solve(&problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(())).expect("finite")
}

/// The only solution, as JSON.
fn only_solution(problem: &Value) -> Value {
    let report: Value = serde_json::from_str(&answer(problem).json()).expect("JSON");
    assert_eq!((&report["status"], &report["complete"]), (&json!("one"), &json!("proven")), "{report}");
    report["solutions"][0].clone()
}

/// w = 2 z - 1 vanishes at z = 1/2, however far the bounds are.
#[test]
fn far_bounds_cost_no_digit() {
    for far in [10.0, 1e9, 1e16, 1e20, 1e300, 1.7e308] {
        for (lower, upper) in [(Some(-far), Some(far)), (Some(-far), None), (None, Some(far))] {
            let problem = json!({"type": "mcp", "M": [[2]], "q": [-1], "l": [lower], "u": [upper]});
            let solution = only_solution(&problem);
            assert_eq!((&solution["z"], &solution["w"]), (&json!([0.5]), &json!([0.0])), "{problem}");
            assert_eq!(solution["enclosure_radius"], json!(0.0), "{problem}");
        }
    }
    // z = 1/3 has no number; the nearest one is 5.6e-17 / 3 away.
    let third = only_solution(&json!({"type": "mcp", "M": [[3]], "q": [-1], "l": [-1e20], "u": [1e20]}));
    assert_eq!(third["z"], json!([1.0 / 3.0]));
    assert!(third["enclosure_radius"].as_f64().expect("a radius") <= 2.0_f64.powi(-55));
}

/// The same with many unknowns, which are solved within bounds: a tridiagonal matrix with the solution (1, ..., 1) / 3.
#[test]
fn far_bounds_cost_no_digit_of_many_unknowns() {
    let size = 60;
    let entry = |row: usize, column: usize| match row.abs_diff(column) {
        0 => 9.0,
        1 => -3.0,
        _ => 0.0,
    };
    let m: Vec<Vec<f64>> =
        (0..size).map(|row| (0..size).map(|column| entry(row, column)).collect()).collect();
    let q: Vec<f64> = m.iter().map(|row| -row.iter().sum::<f64>() / 3.0).collect();
    let far = |sign: f64| vec![sign * 1e300; size];
    let problem = json!({"type": "mcp", "M": m, "q": q, "l": far(-1.0), "u": far(1.0)});
    let solution = only_solution(&problem);
    let values = solution["z"].as_array().expect("a list");
    assert!(values.iter().all(|z| (z.as_f64().expect("a number") - 1.0 / 3.0).abs() < 1e-14), "{solution}");
}

/// With bounds of 1e20, z_1 + z_2 = 1/2 and z_1 - z_2 = 0 are met by the continuum of z_3 between its bounds 1/4 and 1.
#[test]
fn ends_of_continua_keep_their_digits() {
    let problem = json!({"type": "mcp", "M": [[1, 1, 0], [1, -1, 0], [0, 0, 0]], "q": [-0.5, 0, 0],
        "l": [-1e20, -1e20, 0.25], "u": [1e20, 1e20, 1]});
    let report: Value = serde_json::from_str(&answer(&problem).json()).expect("JSON");
    let parts = report["continua"][0]["parts"].as_array().expect("parts");
    let told: Vec<&Value> =
        parts.iter().flat_map(|part| part["vertices"].as_array().expect("a list")).collect();
    assert_eq!(told.len(), 3, "{report}");
    assert!(told.iter().any(|vertex| vertex["z"] == json!([0.25, 0.25])), "{report}");
    assert!([0.25, 1.0].iter().all(|end| told.iter().any(|vertex| vertex["z"] == json!([end]))), "{report}");
}

/// The payoff of the only best response to the only row, found by exact arithmetic.
#[test]
fn payoffs_are_those_of_what_is_played() {
    for worse in [-1e16, -1e100, -1e308] {
        let game = json!({"type": "game", "A": [[0, 0]], "B": [[1, worse]]});
        let solution = only_solution(&game);
        assert_eq!((&solution["payoff_1"], &solution["payoff_2"]), (&json!(0.0), &json!(1.0)), "{game}");
        assert_eq!((&solution["y"], &solution["enclosure_radius"]), (&json!([1.0, 0.0]), &json!(0.0)));
    }
    // From an independent review.
    let game = json!({"type": "game", "A": [[1, -1, -3]],
        "B": [[3.458_764_513_820_541e18, 1.152_921_504_606_847e18, -1e308]]});
    let solution = only_solution(&game);
    assert_eq!(
        (&solution["payoff_1"], &solution["payoff_2"]),
        (&json!(1.0), &json!(3.458_764_513_820_541e18))
    );
}

/// x_1 + |x| < 0 and x_2 = 0 has no solution: x_1 >= -|x|. Neither has x_3 = 1, x_2 = -2, x_1 = |(x_1, x_2)| + 1e300 - 1:
/// x_1 <= |(x_1, x_2)|. Numbers that are all 1e307 times as large have solutions that are.
#[test]
fn blocks_of_very_different_sizes_are_answered() {
    let none = answer(&json!({"type": "block_ave", "blocks": [2], "B": [[1], [0]], "b": [-1.7e308, 0]}));
    assert!(none.solutions.is_empty());
    let far =
        json!({"type": "block_ave", "blocks": [2, 1], "B": [[-1, -1e300], [0, 2], [0, 1]], "b": [-1, 0, 2]});
    let report = answer(&far);
    assert!(report.nodes < 10_000 && report.json().len() > 100);
    let scaled =
        only_solution(&json!({"type": "block_ave", "blocks": [2], "B": [[0.1], [0]], "b": [3e307, 4e307]}));
    let plain = only_solution(&json!({"type": "block_ave", "blocks": [2], "B": [[0.1], [0]], "b": [3, 4]}));
    let at = |solution: &Value, index: usize| solution["x"][index].as_f64().expect("a number");
    assert!([0, 1].iter().all(|&index| (at(&scaled, index) / 1e307 / at(&plain, index) - 1.0).abs() < 1e-14));
}

/// From an independent review: the second component of one solution of each is so near zero that its sign is not certain.
/// With 80 digits, the quadratic equation for |x| gives 1.36e-17, -4.16e-16 and -1.93e-17.
#[test]
fn signs_of_blocks_are_certain() {
    let cases = [
        (
            json!({"blocks": [2], "B": [[0.5], [-1.0]], "b": [1.5, -1.0], "A": [[1.45, -0.15], [-0.3, 1.15]]}),
            1,
        ),
        (
            json!({"blocks": [2], "B": [[-1.5], [-0.5]], "b": [-1.5, -1.5],
            "A": [[0.7, 0.449_999_999_999_999_96], [-0.3, 0.7]]}),
            -1,
        ),
        (
            json!({"blocks": [2], "B": [[-1.0], [0.0]], "b": [-1.5, 0.5],
            "A": [[0.55, 0.449_999_999_999_999_96], [0.15, 1.45]]}),
            -1,
        ),
    ];
    for (problem, sign) in cases {
        let report = answer(&problem);
        let near = report.solutions.iter().find(|solution| solution.unknowns.named()[0].1[1].abs() < 1e-14);
        let near = near.unwrap_or_else(|| panic!("{problem}"));
        assert!([0, sign].contains(&near.signs[1]) && near.signs[0] == 1, "{problem}: {near:?}");
    }
}

/// w_1 = z_1 = 0, z_2 >= 0 is arbitrary, and w_3 = z_3 + 1 >= 1: the first pair has no sign.
#[test]
fn patterns_of_sets_tell_what_is_zero_throughout() {
    let problem = json!({"type": "lcp", "M": [[1, 0, 0], [0, 0, 0], [0, 0, 1]], "q": [0, 0, 1]});
    assert_eq!(answer(&problem).continua[0].pattern, "0+-");
}

/// z_1 + z_2 = 1/3 has two ends, each rounded once.
#[test]
fn points_of_singular_patterns_have_a_radius() {
    let problem = json!({"type": "lcp", "M": [[3, 3], [3, 3]], "q": [-1, -1]});
    let report = answer(&problem);
    let ends: Vec<f64> = report
        .continua
        .iter()
        .flat_map(|set| &set.parts)
        .flat_map(|part| &part.vertices)
        .flat_map(|vertex| vertex.named()[0].1.to_vec())
        .collect();
    assert_eq!(ends.iter().filter(|end| **end == 1.0 / 3.0).count(), 2, "{ends:?}");
    // w_1 + w_2 = -z_1 - z_2, so that all four are zero, and z_3 = 1/3. The row of w_3 is zero: every pattern with z_3 > 0
    // is singular. The nearest number to 1/3 is at most half of 2^-54 away.
    let problem = json!({"type": "lcp", "M": [[-1, 0, 3], [0, -1, -3], [0, 0, 0]], "q": [-1, 1, 0]});
    let point = only_solution(&problem);
    assert_eq!(point["z"], json!([0.0, 0.0, 1.0 / 3.0]));
    assert!(point["enclosure_radius"].as_f64().is_some_and(|radius| radius <= 2.0_f64.powi(-55)), "{point}");
}

/// A fraction is rounded once, also one of integers that no number holds.
#[test]
fn fractions_are_texts_of_two_integers() {
    let solution = only_solution(&json!({"type": "lcp", "M": [["2/3"]], "q": ["-2/3"]}));
    assert_eq!(solution["z"], json!([1.0]));
    let long = format!("1{}/3{}", "0".repeat(400), "0".repeat(400));
    assert_eq!(
        only_solution(&json!({"type": "lcp", "M": [[1]], "q": [format!("-{long}")]}))["z"],
        json!([1.0 / 3.0])
    );
    for wrong in ["2/0", "1.5/2", "/2", "2/", "2", "1/-2", "a/b"] {
        let problem = json!({"type": "lcp", "M": [[wrong]], "q": [1]}).to_string();
        let faults = RawProblem::from_json(problem.as_bytes()).expect_err(wrong);
        assert_eq!(
            faults.to_string(),
            "`M`: the entry in row 0, column 0 (counted from 0) is a text, not a number"
        );
    }
}

const SIZES: [f64; 16] = [
    5e-324,
    1e-310,
    f64::MIN_POSITIVE,
    1e-300,
    1e-160,
    1e-16,
    1e-9,
    0.1,
    1e9,
    1e16,
    1e20,
    1e150,
    1e154,
    1e300,
    1.7e308,
    f64::MAX,
];

/// Random numbers; the next one is that of a linear congruential generator.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % limit
    }

    fn entry(&mut self) -> f64 {
        let sign = if self.below(2) == 0 { -1.0 } else { 1.0 };
        match self.below(3) {
            0 => 0.0,
            1 => sign * [1.0, 2.0, 3.0][self.below(3)],
            _ => sign * SIZES[self.below(SIZES.len())],
        }
    }

    fn array(&mut self, sizes: &[usize]) -> Value {
        match sizes {
            [] => json!(self.entry()),
            [size, rest @ ..] => (0..*size).map(|_| self.array(rest)).collect(),
        }
    }

    fn problem(&mut self) -> Value {
        let kind = RawKind::ALL[self.below(RawKind::ALL.len())];
        let (n, m) = (1 + self.below(3), 1 + self.below(3));
        let mut problem = json!({"type": kind.word()});
        let blocks: Vec<usize> = (0..n).map(|_| 1 + self.below(2)).collect();
        let components: usize = blocks.iter().sum();
        let with_optional = self.below(2) == 0;
        let names = if with_optional { kind.names() } else { kind.required().to_vec() };
        for name in names {
            problem[name] = match (kind, name) {
                (_, "blocks") => json!(blocks),
                (RawKind::BlockAve, "b") => self.array(&[components]),
                (RawKind::BlockAve, "B") => self.array(&[components, n]),
                (RawKind::BlockAve, _) => self.array(&[components, components]),
                (RawKind::Game, _) | (RawKind::Mlcp, "C") => self.array(&[n, m]),
                (RawKind::Mlcp, "B") => self.array(&[m, m]),
                (RawKind::Mlcp, "D") => self.array(&[m, n]),
                (RawKind::Mlcp, "b") => self.array(&[m]),
                (RawKind::Mcp, "l" | "u") => {
                    (0..n).map(|_| (self.below(3) > 0).then(|| self.entry())).collect()
                }
                (_, "a" | "b" | "q" | "right_hand_side") => self.array(&[n]),
                _ => self.array(&[n, n]),
            };
        }
        problem
    }
}

/// Every problem is refused with a reason or answered in all forms, whatever its numbers. `SLIDEWAY_EXTREMES` sets how many
/// problems are tried.
#[test]
fn numbers_of_every_size_are_answered_or_refused() {
    let count = std::env::var("SLIDEWAY_EXTREMES").ok().and_then(|text| text.parse().ok()).unwrap_or(400);
    let limits = Limits { solutions: 100, singular: 20, bases: 1000, ..Limits::default() };
    let options = SearchOptions { nodes: 200, limits, ..SearchOptions::default() };
    let mut answered = 0;
    for seed in 0..count {
        let problem = Random(seed).problem();
        let answer = || {
            let raw = RawProblem::from_json(problem.to_string().as_bytes()).ok()?;
            let report = solve(&raw, &options, 10, &mut |_| ControlFlow::Continue(())).ok()?;
            // JSON refuses numbers that are not finite.
            Some((report.json(), report.text(Style::default()), to_npz(&report)))
        };
        // A panic tells no seed by itself.
        let outcome = catch_unwind(AssertUnwindSafe(answer));
        let answer = outcome.unwrap_or_else(|_| panic!("seed {seed}: {problem}"));
        answered += u64::from(answer.is_some());
    }
    assert!(2 * answered > count, "{answered} of {count}");
}
