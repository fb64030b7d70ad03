//! Properties of the answer for random mechanisms, states and loads.

use crate::answers::{assert_close, normal_forces};
use crate::brute_force::{Pattern, Solved, velocity_signs};
use crate::drawing::{Drawing, Load, SliderKind};
use crate::random_mechanisms::{cases, mechanisms};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway::configuration::Configuration;
use slideway::influence::Influence;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::modes::{Limits, ModeProblem, Side, enumerate};
use slideway::report::Proof;
use slideway::solve::mode_problem;

proptest! {
    #![proptest_config(cases(250))]

    /// Force and moment balance of every body in every state that is reported.
    #[test]
    fn every_body_is_in_balance(drawing in mechanisms()) {
        let Some(Solved { report, .. }) = Solved::new(drawing) else { return Err(TestCaseError::reject("state")) };
        for state in report.solutions.iter().chain(&report.preload_gap_states) {
            prop_assert!(state.residual < 1e-9, "{}", state.residual);
        }
        let mut residuals: Vec<f64> = report.solutions.iter().map(|solution| solution.residual).collect();
        residuals.sort_by(f64::total_cmp);
        if let Some(least) = residuals.first() {
            prop_assert!(*least < 1e-12, "{least}");
        }
    }

    /// The accelerations of the bodies are the second derivatives of their positions as the coordinates move
    /// with theirs; those of driven coordinates are as prescribed.
    #[test]
    fn accelerations_are_second_derivatives_of_positions(drawing in mechanisms()) {
        let Some(Solved { drawing, report, .. }) = Solved::new(drawing) else {
            return Err(TestCaseError::reject("state"))
        };
        let Some(solution) = report.solutions.first() else { return Err(TestCaseError::reject("no solution")) };
        let accelerations: Vec<f64> = solution.coordinates.iter().map(|c| c.acceleration).collect();
        for (index, drive) in drawing.drives.iter().enumerate() {
            assert_close(accelerations[drive.coordinate], drive.acceleration, 1.0, 1e-9);
            prop_assert_eq!(&solution.drives[index].name, &format!("drive_{index}"));
        }
        let greatest = accelerations.iter().fold(1.0, |a: f64, other| a.max(other.abs()));
        let step = 4e-3 / greatest.sqrt();
        let coarse = second_differences(&drawing, &accelerations, step);
        let fine = second_differences(&drawing, &accelerations, step / 2.0);
        let (Some(coarse), Some(fine)) = (coarse, fine) else { return Err(TestCaseError::reject("a limit is near")) };
        for (body, (coarse, fine)) in solution.bodies.iter().zip(coarse.iter().zip(&fine)) {
            let found = [body.acceleration[0], body.acceleration[1], body.angular_acceleration];
            for axis in 0..3 {
                // Richardson's extrapolation of the differences.
                let expected = (4.0 * fine[axis] - coarse[axis]) / 3.0;
                assert_close(found[axis], expected, 10.0 * greatest, 1e-5);
            }
        }
    }

    /// The laws of the contacts: eq. (2), the sides, the limit of a guided slider's couple.
    #[test]
    fn every_contact_obeys_its_law(drawing in mechanisms()) {
        let Some(Solved { drawing, report, .. }) = Solved::new(drawing) else {
            return Err(TestCaseError::reject("state"))
        };
        let contacts = drawing.contacts();
        for solution in &report.solutions {
            let greatest = normal_forces(solution).iter().fold(0.0, |n: f64, other| n.max(other.abs()));
            for ((name, slider, law), contact) in contacts.iter().zip(&solution.contacts) {
                prop_assert_eq!(name, &contact.name);
                let normal_force = contact.normal_force;
                let side = usize::from(contact.side < 0);
                if contact.side != 0 {
                    prop_assert_eq!(normal_force.signum(), f64::from(contact.side));
                    let friction = law.mu[side] * normal_force.abs() + law.preload[side];
                    assert_close(contact.friction_force, friction * contact.sliding_velocity.signum(), 0.0, 1e-12);
                }
                prop_assert_eq!(contact.couple.is_some(), slider.kind == SliderKind::Guided);
                if let Some(couple) = contact.couple {
                    let limit = normal_force.abs() * slider.length / 2.0;
                    prop_assert!(couple.abs() <= limit + 1e-8 * greatest * slider.length);
                }
            }
        }
        for state in &report.preload_gap_states {
            for (law, contact) in contacts.iter().map(|(_, _, law)| law).zip(&state.contacts) {
                if let Some(share) = contact.preload_share {
                    prop_assert!((0.0..=1.0).contains(&share) && contact.normal_force == 0.0);
                    let friction = share * law.preload[0] + (1.0 - share) * law.preload[1];
                    assert_close(contact.friction_force.abs(), friction, 0.0, 1e-12);
                }
            }
        }
        for rejection in &report.rejected {
            prop_assert!(rejection.couple.abs() > rejection.limit);
        }
    }

    /// The same solutions as an LU factorization for every pattern, from the influence coefficients.
    #[test]
    fn the_list_is_that_of_brute_force(drawing in mechanisms()) {
        let Some(solved) = Solved::new(drawing) else { return Err(TestCaseError::reject("state")) };
        prop_assume!(!solved.is_delicate());
        let Solved { report, patterns, .. } = &solved;
        prop_assert_eq!(report.complete, Proof::Proven);
        prop_assert!(report.patterns.is_none_or(|counts| counts.total == patterns.len() as u64));
        let mut expected: Vec<String> = patterns.iter().filter(|p| p.is_solution()).map(Pattern::name).collect();
        let rejected = report.rejected.iter().map(|rejection| rejection.pattern.clone());
        let mut found: Vec<String> = report
            .solutions
            .iter()
            .map(|solution| solution.pattern.clone())
            .chain(rejected.filter(|pattern| !pattern.contains('0')))
            .collect();
        expected.sort_unstable();
        found.sort_unstable();
        prop_assert_eq!(found, expected);
        for pattern in patterns.iter().filter(|pattern| pattern.is_solution()) {
            let Some(solution) = solved.solution(&pattern.name()) else { continue };
            let expected = pattern.normal_forces();
            let greatest = expected.iter().fold(0.0, |n: f64, other| n.max(other.abs()));
            for (found, expected) in normal_forces(solution).iter().zip(&expected) {
                assert_close(*found, *expected, greatest, 1e-9);
            }
            assert_close(solution.determinant, pattern.determinant, 0.0, 1e-7);
            let orientation: f64 = pattern.signs.iter().product();
            assert_close(solution.oriented_determinant, pattern.determinant * orientation, 0.0, 1e-7);
        }
    }

    /// A right-hand side made for given normal forces has them among its solutions.
    #[test]
    fn planted_normal_forces_are_found(
        drawing in mechanisms(),
        planted in prop::collection::vec((any::<bool>(), 0.5..20.0_f64), 6),
    ) {
        let Some(solved) = Solved::new(drawing) else { return Err(TestCaseError::reject("state")) };
        let stages = Stages::of(&solved.drawing);
        let problem = stages.problem(&solved.drawing);
        let (sides, y, right_hand_side) = plant(&problem, &planted);
        prop_assume!(!ill_conditioned(&solved, &sides));
        let columns = Side::BOTH.map(|side| problem.columns(side).clone());
        let jumps = Side::BOTH.map(|side| problem.jumps(side).clone());
        let [[c_plus, c_minus], [d_plus, d_minus]] = [columns, jumps];
        let planted = ModeProblem::new(c_plus, c_minus, d_plus, d_minus, right_hand_side).unwrap();
        let found = enumerate(&planted, &Limits::default()).unwrap();
        let solution = found.solutions.iter().find(|solution| solution.pattern == sides);
        let Some(solution) = solution else { return Err(TestCaseError::fail("the planted solution is missing")) };
        prop_assert!((&solution.y - &y).amax() < 1e-8 * y.amax());
    }

}

proptest! {
    #![proptest_config(cases(100))]

    /// Forces and torques added to the bodies so that given normal forces result: the whole way from the
    /// file.
    #[test]
    fn planted_loads_are_answered(
        drawing in mechanisms(),
        planted in prop::collection::vec((any::<bool>(), 0.5..20.0_f64), 6),
    ) {
        let Some(solved) = Solved::new(drawing) else { return Err(TestCaseError::reject("state")) };
        let drawing = &solved.drawing;
        let stages = Stages::of(drawing);
        let (sides, y, wanted) = plant(&stages.problem(drawing), &planted);
        prop_assume!(!ill_conditioned(&solved, &sides));
        let present = stages.influence.normal_forces();
        // What a unit of each added load does to the normal forces.
        let units: Vec<Vec<Load>> = (0..3 * drawing.bodies.len()).map(|index| added(drawing, index, 1.0)).collect();
        let answers: Vec<DVector<f64>> = units
            .iter()
            .map(|loads| Stages::of(&with_loads(drawing, loads)).influence.normal_forces() - &present)
            .collect();
        let response = DMatrix::from_columns(&answers);
        let values = response.singular_values();
        prop_assume!(response.ncols() >= response.nrows() && values.min() > 1e-4 * values.max());
        let amounts = response.svd(true, true).solve(&(wanted - &present), 0.0).unwrap();
        let loads: Vec<Load> =
            amounts.iter().enumerate().flat_map(|(index, amount)| added(drawing, index, *amount)).collect();
        let Some(solved) = Solved::new(with_loads(drawing, &loads)) else {
            return Err(TestCaseError::reject("state"))
        };
        let name: String = sides.iter().map(|side| if *side == Side::Positive { '+' } else { '-' }).collect();
        let rejected = solved.report.rejected.iter().find(|rejection| rejection.pattern == name);
        let found = match (solved.solution(&name), rejected) {
            (Some(solution), _) => normal_forces(solution),
            (None, Some(rejection)) => rejection.normal_forces.clone(),
            (None, None) => return Err(TestCaseError::fail("the planted solution is missing")),
        };
        for k in 0..found.len() {
            assert_close(found[k], sides[k].sign() * y[k], y.amax(), 1e-8);
        }
    }
}

/// Second differences of the poses of all bodies while every coordinate moves evenly accelerated.
fn second_differences(drawing: &Drawing, accelerations: &[f64], step: f64) -> Option<Vec<[f64; 3]>> {
    let poses_at = |time: f64| -> Option<Vec<[f64; 3]>> {
        let mut drawing = drawing.clone();
        for (coordinate, acceleration) in drawing.coordinates.iter_mut().zip(accelerations) {
            coordinate.value += coordinate.rate * time + acceleration * time * time / 2.0;
        }
        let mechanism = Mechanism::new(&Model::parse(&drawing.text()).unwrap()).unwrap();
        let poses = Configuration::new(&mechanism).ok()?.poses;
        Some(poses.iter().map(|pose| [pose.position.x, pose.position.y, pose.angle()]).collect())
    };
    let [before, now, after] = [poses_at(-step)?, poses_at(0.0)?, poses_at(step)?];
    let difference = |body: usize| {
        [0, 1, 2].map(|axis| (after[body][axis] - 2.0 * now[body][axis] + before[body][axis]) / (step * step))
    };
    Some((0..now.len()).map(difference).collect())
}

/// The stages up to the influence coefficients.
struct Stages {
    mechanism: Mechanism,
    influence: Influence,
}

impl Stages {
    fn of(drawing: &Drawing) -> Self {
        let mechanism = Mechanism::new(&Model::parse(&drawing.text()).unwrap()).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap();
        let influence = Influence::new(&KineticEquations::new(&mechanism, &configuration).unwrap());
        Self { mechanism, influence }
    }

    fn problem(&self, drawing: &Drawing) -> ModeProblem {
        let signs = DVector::from_vec(velocity_signs(drawing));
        mode_problem(&self.mechanism, &self.influence, &signs).unwrap()
    }
}

/// Sides, |N| and the right-hand side that they need: N(0) = sum c_k y_k - sum d_k.
fn plant(problem: &ModeProblem, planted: &[(bool, f64)]) -> (Vec<Side>, DVector<f64>, DVector<f64>) {
    let planted = &planted[..problem.contacts()];
    let sides: Vec<Side> = planted.iter().map(|(side, _)| Side::BOTH[usize::from(*side)]).collect();
    let y = DVector::from_iterator(planted.len(), planted.iter().map(|(_, y)| *y));
    let mut right_hand_side = DVector::zeros(planted.len());
    for (k, side) in sides.iter().enumerate() {
        right_hand_side += y[k] * problem.columns(*side).column(k) - problem.jumps(*side).column(k);
    }
    (sides, y, right_hand_side)
}

fn ill_conditioned(solved: &Solved, sides: &[Side]) -> bool {
    let signs: Vec<f64> = sides.iter().map(|side| side.sign()).collect();
    let pattern = solved.patterns.iter().find(|pattern| pattern.signs == signs);
    pattern.is_none_or(|pattern| pattern.delicate)
}

fn with_loads(drawing: &Drawing, loads: &[Load]) -> Drawing {
    let mut drawing = drawing.clone();
    drawing.loads.extend_from_slice(loads);
    drawing
}

/// A force along x or y at the centre of a body, or a torque on it.
fn added(drawing: &Drawing, index: usize, amount: f64) -> Vec<Load> {
    let (body, component) = (index / 3, index % 3);
    if component == 2 {
        return vec![Load::Torque { body, moment: amount }];
    }
    let mut force = [0.0; 2];
    force[component] = amount;
    vec![Load::Force { body, at: drawing.bodies[body].centre, force, turns: false, reaction: None }]
}
