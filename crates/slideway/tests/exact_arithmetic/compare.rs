//! A report against the truth.

use std::ops::ControlFlow;

use dashu_int::IBig;
use dashu_ratio::RBig;
use slideway::Report;
use slideway::modes::{Arguments, SearchOptions};
use slideway::raw_problem::{RawProblem, RawReport, RawSolution, Unknowns, solve};
use slideway::report::{Proof, Status, Style};

use super::oracle::{State, Truth, exact, truth};

/// What a campaign met.
#[derive(Debug, Default)]
#[allow(dead_code, reason = "told by the campaigns")]
pub(crate) struct Tally {
    pub(crate) compared: u64,
    /// Instances beyond the oracle.
    pub(crate) skipped: u64,
    pub(crate) none: u64,
    pub(crate) solutions: usize,
    pub(crate) boundary: usize,
    pub(crate) gap_states: usize,
    pub(crate) continua: u64,
    /// Unknowns without a floating-point number.
    pub(crate) beyond_range: usize,
}

/// Solves a problem with and without the shortcut for few patterns, and compares all that is told.
pub(crate) fn compare(raw: &RawProblem, name: &str, tally: &mut Tally) {
    let Some(truth) = truth(raw) else {
        tally.skipped += 1;
        return;
    };
    tally.compared += 1;
    let all = SearchOptions::default().arguments;
    for every_pattern in [true, false] {
        let arguments = Arguments { every_pattern, ..all };
        let options = SearchOptions { arguments, ..SearchOptions::default() };
        let report = solve(raw, &options, 10_000, &mut |_| ControlFlow::Continue(())).unwrap();
        let context = format!("{name}, every pattern: {every_pattern}\n{raw:?}\n{report:#?}\n{truth:?}");
        check(&report, &truth, &context);
        if every_pattern {
            count(&report, tally);
        }
    }
}

fn count(report: &RawReport, tally: &mut Tally) {
    let told = || report.solutions.iter().chain(&report.gap_states);
    tally.none += u64::from(report.status == Status::None);
    tally.solutions += report.solutions.len();
    tally.boundary += told().filter(|solution| solution.on_boundary).count();
    tally.gap_states += report.gap_states.len();
    tally.continua += u64::from(report.status == Status::Continuum);
    tally.beyond_range += told().map(|solution| solution.beyond_range.len()).sum::<usize>();
}

fn check(report: &RawReport, truth: &Truth, context: &str) {
    assert_eq!(report.complete, Proof::Proven, "{context}");
    assert_eq!(report.continuum_count != "0", truth.continuum, "{context}");
    let (gaps, points): (Vec<&State>, Vec<&State>) =
        truth.states.iter().partition(|state| state.is_gap_state());
    assert!(!report.text(Style::PLAIN).contains("NaN"), "{context}");
    assert!(!report.json().contains("inf"), "{context}");
    if !truth.continuum {
        let status = match (points.len(), gaps.len()) {
            (0, 0) => Status::None,
            (0, _) => Status::PreloadGap,
            (1, _) => Status::One,
            _ => Status::Several,
        };
        assert_eq!(report.status, status, "{context}");
        assert_eq!(report.count, points.len().to_string(), "{context}");
        assert_eq!(report.gap_state_count, gaps.len().to_string(), "{context}");
        check_list(&report.gap_states, &gaps, context);
        check_list(&report.solutions, &points, context);
    } else if report.continuum_count == "0" {
        panic!("{context}");
    }
}

/// Each state is told exactly once.
fn check_list(told: &[RawSolution], states: &[&State], context: &str) {
    for state in states {
        let fits = told.iter().filter(|solution| is_told_by(state, solution)).count();
        assert!(fits >= 1, "{state:?} is not told\n{context}");
    }
    for solution in told {
        assert!(states.iter().any(|state| is_told_by(state, solution)), "{solution:?}\n{context}");
        if let Some(residual) = solution.residual {
            // Of numbers rounded to the nearest; wider enclosures may have more.
            let rounded = solution.enclosure_radius == Some(0.0) || solution.on_boundary;
            assert!(residual.is_finite() && (!rounded || residual < 1e-13), "{solution:?}\n{context}");
        }
    }
}

/// Whether a solution has the signs of a state, and values near it.
fn is_told_by(state: &State, solution: &RawSolution) -> bool {
    let sign = |value: &RBig| i8::from(*value > RBig::ZERO) - i8::from(*value < RBig::ZERO);
    let signs: Vec<i8> = state.signed.iter().map(sign).collect();
    if signs != solution.signs {
        return false;
    }
    let positive = |at: usize| if signs[at] > 0 { state.signed[at].clone() } else { RBig::ZERO };
    let size = |at: usize| if signs[at] < 0 { -&state.signed[at] } else { state.signed[at].clone() };
    let all = |of: &dyn Fn(usize) -> RBig| (0..signs.len()).map(of).collect::<Vec<RBig>>();
    let named = match solution.unknowns {
        Unknowns::Complementary { .. } => {
            vec![all(&positive), all(&|at| if signs[at] < 0 { size(at) } else { RBig::ZERO })]
        }
        Unknowns::AbsoluteValue { .. } => vec![state.signed.clone()],
        Unknowns::Modes { .. } => vec![state.signed.clone(), all(&size)],
        Unknowns::Mixed { .. } | Unknowns::Strategies { .. } => unreachable!("no family has them"),
    };
    let unknowns_fit = solution.unknowns.named().into_iter().zip(&named).all(|((name, told), exact)| {
        told.iter().zip(exact).enumerate().all(|(at, (&told, exact))| fits(solution, (name, at), told, exact))
    });
    let in_gap: Vec<usize> = (0..signs.len()).filter(|&at| state.in_gap(at)).collect();
    let shares_fit = solution
        .gaps
        .iter()
        .filter(|gap| state.in_gap(gap.index))
        .all(|gap| fits(solution, ("lambda", gap.index), gap.lambda, &state.shares[gap.index]));
    let told_in_gap = |at: &usize| solution.gaps.iter().any(|gap| gap.index == *at);
    unknowns_fit && shares_fit && in_gap.iter().all(told_in_gap)
}

fn fits(solution: &RawSolution, (name, at): (&str, usize), told: f64, value: &RBig) -> bool {
    let size = |value: &RBig| if *value < RBig::ZERO { -value } else { value.clone() };
    let (least, most) = (exact(f64::MIN_POSITIVE), exact(f64::MAX));
    if told.is_nan() {
        let Some(one) = solution.beyond_range.iter().find(|one| one.name.as_str() == name && one.index == at)
        else {
            return false;
        };
        let off = size(&(decimal(&one.value) - value));
        let beyond = !value.is_zero() && (size(value) < least || size(value) >= most);
        return beyond && off <= size(value) * exact(1e-16);
    }
    if value.is_zero() {
        return told == 0.0;
    }
    // Without an enclosure the number is the nearest, or nearly so.
    let nearly = size(value) * exact(1e-9);
    let radius = solution.enclosure_radius.map_or(nearly, exact);
    told.is_normal() && (told > 0.0) == (*value > RBig::ZERO) && size(&(exact(told) - value)) <= radius
}

/// A decimal text such as "-1.25e310", exactly.
fn decimal(text: &str) -> RBig {
    let (mantissa, exponent) = text.split_once('e').unwrap_or_else(|| panic!("{text}"));
    let (whole, rest) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: IBig = format!("{whole}{rest}").parse().unwrap();
    let power = exponent.parse::<i64>().unwrap() - i64::try_from(rest.len()).unwrap();
    let factor = RBig::from(IBig::from(10).pow(usize::try_from(power.unsigned_abs()).unwrap()));
    if power < 0 { RBig::from(digits) / factor } else { RBig::from(digits) * factor }
}
