//! Branches of block problems over a parameter.

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use slideway_modes::blocks::{BlockProblem, search};
use slideway_modes::branches::{BranchOptions, Branches, Instance, NoInstance, branches, end_of};
use slideway_modes::existence::EndCause;
use slideway_modes::progress::undisturbed;
use slideway_modes::{BlockNumbers, BySide, Proof, SearchOptions};
use std::ops::ControlFlow;

use crate::support::{Numbers, Plain};

fn instance(response: BySide<DMatrix<f64>>, load: DVector<f64>) -> Instance {
    let contacts = 2 * response.positive.ncols() - load.len();
    let jumps = BySide::same(DMatrix::zeros(load.len(), contacts));
    let outputs = BlockNumbers::none(contacts, response.positive.ncols());
    let problem = BlockProblem::new(response, jumps, load).unwrap();
    Instance { problem, outputs, bounds: Vec::new(), senses: Vec::new() }
}

fn found(family: &dyn Fn(f64) -> Result<Instance, NoInstance>, range: [f64; 2]) -> Branches {
    let options = BranchOptions {
        range,
        values: 40,
        further: Vec::new(),
        greatest_normal_force: None,
        search: SearchOptions::default(),
    };
    undisturbed(|work| branches(family, &options, work))
}

/// One hinge, `R = b + r e |R|`: a second solution comes from infinity at `r = 1/|e|`, and both merge at
/// `r = |b| / |b x e|` (theory of hinges, section 2).
#[test]
fn one_hinge_has_a_fold_and_a_branch_from_infinity() {
    let (b, e) = ([-3.0, 1.0], [2.0, 0.5]);
    let family = |r: f64| Ok(instance(BySide::same(dmatrix![r * e[0]; r * e[1]]), dvector![b[0], b[1]]));
    let Branches { branches, gaps, .. } = found(&family, [0.0, 5.0]);
    let (norm, length) = (f64::hypot(e[0], e[1]), f64::hypot(b[0], b[1]));
    let fold = length / f64::abs(b[0] * e[1] - b[1] * e[0]);
    assert!(gaps.is_empty());
    assert_eq!(branches.len(), 2, "{branches:?}");
    let [lower, upper] = &branches[..] else { unreachable!() };
    assert_eq!((lower.orientation, upper.orientation), (1, -1));
    assert_eq!((&lower.from.end.cause, &lower.to.end.cause), (&EndCause::Range, &EndCause::Fold));
    assert_eq!((&upper.from.end.cause, &upper.to.end.cause), (&EndCause::Singular, &EndCause::Fold));
    for (found, expected) in [
        (lower.from.end.at, 0.0),
        (lower.to.end.at, fold),
        (upper.from.end.at, 1.0 / norm),
        (upper.to.end.at, fold),
    ] {
        assert!((found - expected).abs() <= 1e-14 * fold, "{found} instead of {expected}");
    }
    let z = -length * length / (b[0] * e[0] + b[1] * e[1]);
    let force = z / fold;
    let found = lower.to.hinge_force.as_ref().unwrap()[0];
    assert!(
        matches!(found, slideway_modes::existence::Limit::Finite(value) if (value / force - 1.0).abs() < 1e-6)
    );
}

/// Between its ends every branch is a solution, and there are no others: at random values `search` finds as many.
#[test]
fn the_number_of_branches_is_the_number_of_solutions() {
    let mut several = 0;
    let mut causes = [0; 3];
    let sizes = [(0, 2), (1, 1), (2, 1), (1, 2), (2, 2)];
    for (seed, (contacts, hinges)) in (0..40).zip(sizes.into_iter().cycle()) {
        let mut random = Numbers(seed);
        let rows = contacts + 2 * hinges;
        let mut side = || [0, 1].map(|_| random.matrix(rows, contacts + hinges));
        let ([p0, p1], [mut n0, mut n1]) = (side(), side());
        for hinge in contacts..contacts + hinges {
            n0.set_column(hinge, &p0.column(hinge));
            n1.set_column(hinge, &p1.column(hinge));
        }
        let loads = [0, 1].map(|_| random.vector(rows));
        let problem = |t: f64| {
            let along = |start: &DMatrix<f64>, slope: &DMatrix<f64>| (start + slope * t) * (0.3 + t);
            let response = BySide { positive: along(&p0, &p1), negative: along(&n0, &n1) };
            instance(response, &loads[0] + &loads[1] * (2.0 * t).sin())
        };
        let branches = found(&|t| Ok(problem(t)), [0.0, 1.0]).branches;
        for end in branches.iter().flat_map(|branch| [&branch.from.end, &branch.to.end]) {
            match end.cause {
                EndCause::Fold => causes[0] += 1,
                EndCause::Singular => causes[1] += 1,
                EndCause::SideChange(_) => causes[2] += 1,
                EndCause::Range => {}
                ref other => panic!("seed {seed}: {other:?} at {}", end.at),
            }
        }
        for _ in 0..30 {
            let t = 0.5 + 0.5 * random.next();
            let result =
                search(&problem(t).problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
            let here: Vec<_> =
                branches.iter().filter(|one| one.from.end.at <= t && t <= one.to.end.at).collect();
            assert_eq!(result.complete, Proof::Proven);
            assert_eq!(here.len(), result.solutions.len(), "seed {seed} at {t}");
            several = several.max(here.len());
            for branch in here {
                let forces = branch.solution(t, &|t| Ok(problem(t))).unwrap();
                let distance = |solution: &slideway_modes::blocks::BlockSolution| {
                    let of = |one: &[f64], other: &[[f64; 2]]| [one, other.as_flattened()].concat();
                    let (one, other) =
                        (of(&forces.normal, &forces.hinges), of(&solution.forces, &solution.reactions));
                    (DVector::from_vec(one) - DVector::from_vec(other.clone())).amax()
                        / DVector::from_vec(other).amax()
                };
                let nearest = result.solutions.iter().map(distance).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-9, "seed {seed} at {t}: {nearest}");
            }
        }
    }
    assert!(several >= 3 && causes.iter().all(|count| *count >= 10), "{several}, {causes:?}");
}

/// The hinge above with a load that grows by a factor of `1e20` over the range: where branches end does not depend on it.
#[test]
fn great_loads_elsewhere_move_no_end() {
    let (b, e) = ([-3.0, 1.0], [2.0, 0.5]);
    let family = |r: f64| {
        let load = dvector![b[0], b[1]] * 10.0_f64.powf(4.0 * r);
        Ok(instance(BySide::same(dmatrix![r * e[0]; r * e[1]]), load))
    };
    let Branches { branches, gaps, .. } = found(&family, [0.0, 5.0]);
    let fold = f64::hypot(b[0], b[1]) / f64::abs(b[0] * e[1] - b[1] * e[0]);
    let [lower, upper] = &branches[..] else { panic!("{branches:?}") };
    assert!(gaps.is_empty());
    for (end, cause, expected) in [
        (&lower.to.end, EndCause::Fold, fold),
        (&upper.from.end, EndCause::Singular, 1.0 / f64::hypot(e[0], e[1])),
        (&upper.to.end, EndCause::Fold, fold),
    ] {
        assert_eq!(end.cause, cause);
        assert!((end.at - expected).abs() <= 1e-14 * fold, "{} instead of {expected}", end.at);
    }
}

/// All friction grows, that of hinges towards a limit. The oracle follows each solution in steps that are at most
/// a twentieth as long.
#[test]
fn a_solution_ends_where_it_ends_in_short_steps() {
    let mut numbers = Numbers(77);
    let (mu, until) = (0.1, 1e6_f64.ln());
    for case in 0..850 {
        let (contacts, hinges) = (case % 4, 1 + case / 4 % 4);
        let size = 0.02 * 60.0_f64.powf(0.5 + 0.5 * numbers.next());
        let plain = Plain::random(&mut numbers, contacts, hinges, size);
        let response = BySide { positive: plain.positive.clone(), negative: plain.negative.clone() };
        let now = instance(response, plain.load.clone());
        let family = |logarithm: f64| {
            let factor = logarithm.exp();
            let of_hinge = factor * f64::hypot(1.0, mu) / f64::hypot(1.0, factor * mu);
            let factors = [vec![factor; contacts], vec![of_hinge; hinges]].concat();
            now.with_response_times(&factors).map_err(|_| NoInstance::Other)
        };
        let result = search(&now.problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
        for solution in &result.solutions {
            let [long, short] =
                [2.0, 0.1].map(|part| end_of(&family, (solution, 0.0), until, part).unwrap().end);
            assert_eq!(long.cause, short.cause, "{case}: {long:?} {short:?}");
            assert!((long.at - short.at).abs() <= 1e-12, "{case}: {long:?} {short:?}");
        }
    }
}
