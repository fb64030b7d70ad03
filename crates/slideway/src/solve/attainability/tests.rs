//! Eigenvalues against the pencil of all bodies, which is assembled from the rows of the kinetic equations.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use crate::attainability::{Candidate, ElasticGuides};
use crate::configuration::{Configuration, null_space};
use crate::ids::ContactId;
use crate::influence::Influence;
use crate::kinetics::{Assembled, KineticEquations, Reaction};
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::modes::{ContactState, ModeProblem, Side};
use crate::report::Attainability;
use crate::solve::{mode_problem, velocity_signs};
use nalgebra::{Complex, DMatrix, DVector, LU};

/// Masses in place of none.
const SMALL: f64 = 1e-8;

struct Case {
    mechanism: Mechanism,
    assembled: Assembled<f64>,
    equations: KineticEquations,
    problem: ModeProblem,
    velocity_signs: DVector<f64>,
}

impl Case {
    fn new(name: &str, parameters: &[(&str, &str)]) -> Self {
        let model = Model::parse(crate::gallery::find(name).unwrap().text).unwrap();
        let settings =
            parameters.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
        let mechanism = Mechanism::new(&model.with(&settings).unwrap()).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap();
        let equations = KineticEquations::new(&mechanism, &configuration).unwrap();
        let velocity_signs = velocity_signs(&mechanism, &configuration).unwrap();
        let problem = mode_problem(&mechanism, &Influence::new(&equations), &velocity_signs).unwrap();
        let assembled = Assembled::new(&mechanism, &configuration).unwrap();
        Self { mechanism, assembled, equations, problem, velocity_signs }
    }

    /// Eigenvalues of `lambda M x = (G_c^T + W diag(mu s sigma)) G_c x` on the motions `[G_r; C] x = 0` with
    /// the test motions `[G_r; B^T] x = 0`, ascending by size.
    fn of_all_bodies(&self, sides: &[Side]) -> Vec<Complex<f64>> {
        let Assembled { layout, matrix, friction, .. } = &self.assembled;
        let accelerations = 3 * self.mechanism.bodies.len();
        let normal: Vec<usize> =
            (0..sides.len()).map(|k| layout.reaction(Reaction::Normal(ContactId(k))).unwrap()).collect();
        let rigid: Vec<usize> = (accelerations..layout.len()).filter(|row| !normal.contains(row)).collect();
        let rows = |rows: &[usize]| DMatrix::from_fn(rows.len(), accelerations, |i, j| matrix[(rows[i], j)]);
        let columns = DMatrix::from_fn(rigid.len(), accelerations, |i, j| matrix[(j, rigid[i])]);
        let free = |rows: &DMatrix<f64>| {
            if rows.is_empty() { DMatrix::identity(accelerations, accelerations) } else { null_space(rows) }
        };
        let (motions, tests) = (free(&rows(&rigid)), free(&columns));
        let mut mass = DMatrix::zeros(accelerations, accelerations);
        for index in 0..accelerations {
            mass[(index, index)] = matrix[(index, index)].max(SMALL);
        }
        let gaps = rows(&normal);
        let mut forces = gaps.transpose();
        for (k, side) in sides.iter().enumerate() {
            let index = usize::from(*side == Side::Negative);
            let factor = self.mechanism.contacts[k].mu[index] * self.velocity_signs[k] * side.sign();
            forces.column_mut(k).axpy(factor, &friction[k][index].rows(0, accelerations), 1.0);
        }
        let stiffness = tests.transpose() * forces * gaps * &motions;
        let inertia = tests.transpose() * mass * &motions;
        let pencil = LU::new(inertia).solve(&stiffness).unwrap();
        let mut values: Vec<_> = pencil.complex_eigenvalues().iter().copied().collect();
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        values
    }

    fn oriented_determinant(&self, sides: &[Side]) -> f64 {
        let columns: Vec<_> = sides
            .iter()
            .enumerate()
            .map(|(k, side)| self.problem.columns(*side).column(k) * side.sign())
            .collect();
        DMatrix::from_columns(&columns).determinant()
    }

    fn freedom(&self) -> usize {
        self.mechanism.coordinates.len() - self.mechanism.drives.len()
    }

    fn patterns(&self) -> impl Iterator<Item = Vec<Side>> {
        let contacts = self.problem.contacts();
        (0..1_usize << contacts)
            .map(move |number| (0..contacts).map(|k| Side::BOTH[number >> k & 1]).collect())
    }
}

fn attainability(guides: &ElasticGuides<'_>, sides: &[Side]) -> Attainability {
    let states = sides.iter().map(|side| ContactState::from(*side)).collect();
    let normal_force = DVector::from_iterator(sides.len(), sides.iter().map(|side| side.sign()));
    guides.attainability(&[Candidate { states, normal_force, deflections: Vec::new() }]).swap_remove(0)
}

#[test]
fn eigenvalues_are_those_of_all_bodies_in_every_mode() {
    let cases: [(&str, &[(&str, &str)]); 8] = [
        ("klepp-2002", &[("F_20", "0"), ("mu_1", "0.6")]),
        ("klepp-2002", &[("mu_1", "0.3"), ("direction", "-1")]),
        ("painleve-klein", &[("mu", "4")]),
        ("drawer", &[]),
        ("slider-crank", &[]),
        ("scotch-yoke", &[]),
        ("sleeve-on-arm", &[]),
        ("elliptic-trammel", &[]),
    ];
    for (name, parameters) in cases {
        let case = Case::new(name, parameters);
        let guides = ElasticGuides::new(&case.mechanism, &case.equations, &case.problem);
        for sides in case.patterns() {
            let found = attainability(&guides, &sides);
            let expected = case.of_all_bodies(&sides);
            let (zero, rest) = expected.split_at(case.freedom());
            let (finite, massless) = rest.split_at(rest.len() - found.massless_motions);
            assert_eq!(found.eigenvalues.len(), finite.len(), "{name}");
            let size = finite.iter().map(|value| value.norm()).fold(0.0, f64::max);
            assert!(zero.iter().all(|value| value.norm() < 1e-9 * size), "{name}: {expected:?}");
            assert!(massless.iter().all(|value| value.norm() > 1e3 * size), "{name}: {expected:?}");
            for value in finite {
                let is_it = |[re, im]: &[f64; 2]| (value - Complex::new(*re, *im)).norm() < 1e-5 * size;
                assert!(
                    found.eigenvalues.iter().any(is_it),
                    "{name}: {value} not in {:?}",
                    found.eigenvalues
                );
            }
            let negative = rest.iter().filter(|value| value.im.abs() < 1e-6 * value.norm() && value.re < 0.0);
            let is_odd = negative.count() % 2 == 1;
            assert_eq!(is_odd, case.oriented_determinant(&sides) < 0.0, "{name}: {expected:?}");
        }
    }
}
