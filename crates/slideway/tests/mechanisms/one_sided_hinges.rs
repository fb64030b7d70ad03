//! Friction in hinges beside contacts that may lift off: random systems against every pattern of states in descriptor form, and
//! what each question answers.
//!
//! In a pattern all unknowns are affine in the lengths `w_j` of the forces of the hinges, whose couples are `-r_j sgn(omega_j) w_j`.
//! What is left are the quadrics `|R_j(w)|^2 = w_j^2`: one quadratic equation for one hinge, for two the resultant, a polynomial
//! of degree four. Each root is kept if it satisfies every equation and every inequality.

use crate::answers::{report_on, report_with};
use crate::one_sided::{assert_states, fault};
use crate::one_sided_systems::{Contact, Hinge, State, System, amax, condition, many, random};
use nalgebra::{DMatrix, DVector, Matrix2, Matrix4, Vector2};
use proptest::collection::vec;
use proptest::prelude::*;
use slideway::drive::{DriveOptions, drive};
use slideway::fault::FaultKind;
use slideway::limits::{LimitsOptions, limits};
use slideway::map::{MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::motion::{End, SimulateOptions, simulate};
use slideway::report::{Proof, Status, Verdict};
use slideway::sweep::{Rows, Sweep, SweepOptions};
use std::ops::ControlFlow;

/// `w -> |R(w)|^2 - w_own^2` in up to two lengths: its value, and what it is made of.
struct Quadric {
    own: usize,
    constant: Vector2<f64>,
    slopes: Vec<Vector2<f64>>,
}

impl Quadric {
    fn force(&self, w: &[f64]) -> Vector2<f64> {
        self.slopes.iter().zip(w).fold(self.constant, |force, (slope, w)| force + slope * *w)
    }

    fn value(&self, w: &[f64]) -> f64 {
        self.force(w).norm_squared() - w[self.own].powi(2)
    }

    fn derivative(&self, w: &[f64], by: usize) -> f64 {
        2.0 * self.force(w).dot(&self.slopes[by]) - if by == self.own { 2.0 * w[by] } else { 0.0 }
    }

    /// Its coefficients as a polynomial in the last of two lengths: polynomials in the first, constants first.
    fn in_last(&self) -> [Vec<f64>; 3] {
        let (c, [a, b]) = (self.constant, [self.slopes[0], self.slopes[1]]);
        let own = |index: usize| if self.own == index { 1.0 } else { 0.0 };
        [
            vec![c.dot(&c), 2.0 * c.dot(&a), a.dot(&a) - own(0)],
            vec![2.0 * c.dot(&b), 2.0 * a.dot(&b)],
            vec![b.dot(&b) - own(1)],
        ]
    }
}

fn times(one: &[f64], other: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; one.len() + other.len() - 1];
    for (i, a) in one.iter().enumerate() {
        other.iter().enumerate().for_each(|(j, b)| product[i + j] += a * b);
    }
    product
}

fn minus(one: &[f64], other: &[f64]) -> Vec<f64> {
    let at = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    (0..one.len().max(other.len())).map(|index| at(one, index) - at(other, index)).collect()
}

/// The lengths that may satisfy all quadrics; nothing where the polynomial has no certain degree.
fn roots(quadrics: &[Quadric]) -> Option<Vec<Vec<f64>>> {
    match quadrics {
        [one] => {
            let (r, c) = (one.slopes[0], one.constant);
            let (a, b, c) = (r.dot(&r) - 1.0, c.dot(&r), c.dot(&c));
            let root = b * b - a * c;
            if a.abs() < 1e-6 {
                return None;
            }
            Some(if root < 0.0 {
                Vec::new()
            } else {
                vec![vec![(-b + root.sqrt()) / a], vec![(-b - root.sqrt()) / a]]
            })
        }
        [one, other] => {
            let ([c1, b1, a1], [c2, b2, a2]) = (one.in_last(), other.in_last());
            let mixed = minus(&times(&a1, &c2), &times(&a2, &c1));
            let linear = minus(&times(&a1, &b2), &times(&a2, &b1));
            let resultant =
                minus(&times(&mixed, &mixed), &times(&linear, &minus(&times(&b1, &c2), &times(&b2, &c1))));
            let leading = resultant[4];
            if leading.abs() < 1e-9 * a1[0].abs().max(1.0) {
                return None;
            }
            let companion = Matrix4::from_fn(|row, column| {
                let last = if column == 3 { -resultant[row] / leading } else { 0.0 };
                last + if row == column + 1 { 1.0 } else { 0.0 }
            });
            let values = companion.complex_eigenvalues();
            let size = values.iter().map(|value| value.norm()).fold(0.0, f64::max);
            let real = values.iter().filter(|value| value.im.abs() <= 1e-5 * size).map(|value| value.re);
            let at = |list: &[f64], w: f64| list.iter().rev().fold(0.0, |sum, part| sum * w + part);
            let second = |w: f64| {
                let denominator = at(&linear, w);
                [-at(&mixed, w) / denominator]
            };
            Some(real.flat_map(|w| second(w).map(|last| polished(quadrics, [w, last]).to_vec())).collect())
        }
        _ => Some(vec![Vec::new()]),
    }
}

/// Newton's method from a root of the resultant.
fn polished(quadrics: &[Quadric], mut w: [f64; 2]) -> [f64; 2] {
    for _ in 0..20 {
        let slopes = Matrix2::from_fn(|row, column| quadrics[row].derivative(&w, column));
        let values = Vector2::new(quadrics[0].value(&w), quadrics[1].value(&w));
        let Some(step) = slopes.lu().solve(&values) else { return w };
        w = [w[0] - step.x, w[1] - step.y];
    }
    w
}

impl System {
    /// How the first body of a hinge turns against the second.
    fn spin_of(&self, hinge: &Hinge) -> f64 {
        let [a, b] = hinge.between.each_ref();
        self.spin(a) - self.spin(b)
    }

    fn rough(&self) -> Vec<usize> {
        (0..self.hinges.len()).filter(|&hinge| self.hinges[hinge].radius > 0.0).collect()
    }

    /// A unit length of the force of each rough hinge, as its couple: on the right-hand side of the equations.
    fn couples(&self, size: usize) -> Vec<DVector<f64>> {
        let couple = |&hinge: &usize| {
            let hinge = &self.hinges[hinge];
            let mut right = DVector::zeros(size);
            for (body, sign) in hinge.between.iter().zip([-1.0, 1.0]) {
                if let Some(body) = self.body(body) {
                    right[3 * body + 2] = sign * hinge.radius * self.spin_of(hinge).signum();
                }
            }
            right
        };
        self.rough().iter().map(couple).collect()
    }

    /// All states with friction in hinges, by every pattern; nothing where rounding may decide about one.
    pub(crate) fn states_with_hinges(&self) -> Option<Vec<State>> {
        let (bodies, contacts) = (3 * self.bodies.len(), self.contacts.len());
        let mut states = Vec::new();
        for number in 0..1_usize << contacts {
            let is_other = |k: usize| number >> k & 1 == 1;
            let open: Vec<bool> = (0..contacts).map(|k| is_other(k) && self.contacts[k].opens()).collect();
            let sides: Vec<f64> =
                (0..contacts).map(|k| if is_other(k) && !open[k] { -1.0 } else { 1.0 }).collect();
            let (matrix, right) = self.equations(&open, true, &sides);
            let smooth = self.equations(&open, false, &sides).0.determinant();
            let of_contacts = matrix.determinant() / smooth;
            if of_contacts.abs() < 1e-4 {
                return None;
            }
            let factors = matrix.clone().lu();
            let constant = factors.solve(&right)?;
            let couples = self.couples(right.len());
            let slopes: Vec<DVector<f64>> =
                couples.iter().map(|couple| factors.solve(couple)).collect::<Option<_>>()?;
            let force = |unknowns: &DVector<f64>, hinge: usize| {
                Vector2::new(unknowns[bodies + 2 * hinge], unknowns[bodies + 2 * hinge + 1])
            };
            let quadrics: Vec<Quadric> = self
                .rough()
                .iter()
                .enumerate()
                .map(|(own, &hinge)| Quadric {
                    own,
                    constant: force(&constant, hinge),
                    slopes: slopes.iter().map(|slope| force(slope, hinge)).collect(),
                })
                .collect();
            let mut found: Vec<Vec<f64>> = Vec::new();
            for w in roots(&quadrics)? {
                let size = amax(&w).max(constant.rows(bodies, constant.len() - bodies).amax());
                let is_root = quadrics.iter().all(|quadric| quadric.value(&w).abs() <= 1e-9 * size * size);
                let is_new = |other: &Vec<f64>| {
                    amax(&w.iter().zip(other).map(|(a, b)| a - b).collect::<Vec<_>>()) > 1e-7 * size
                };
                if !is_root || !found.iter().all(is_new) {
                    continue;
                }
                let least = w.iter().copied().fold(f64::INFINITY, f64::min);
                if least.abs() < 1e-6 * size {
                    return None;
                }
                if least < 0.0 {
                    continue;
                }
                let unknowns =
                    slopes.iter().zip(&w).fold(constant.clone(), |sum, (slope, w)| sum + slope * *w);
                let of_hinges = DMatrix::from_fn(w.len(), w.len(), |row, column| {
                    let unit = if row == column { 1.0 } else { 0.0 };
                    unit - quadrics[row].force(&w).dot(&quadrics[row].slopes[column]) / w[row]
                });
                let of_hinges = of_hinges.determinant();
                if of_hinges.abs() < 1e-4 {
                    return None;
                }
                // The equations with the couples as they depend on the forces at this root.
                let mut along = matrix.clone();
                for ((&hinge, couple), (quadric, length)) in
                    self.rough().iter().zip(&couples).zip(quadrics.iter().zip(&w))
                {
                    let direction = quadric.force(&w) / *length;
                    let mut columns = along.columns_mut(bodies + 2 * hinge, 2);
                    columns.ger(-1.0, couple, &direction, 1.0);
                }
                found.push(w);
                let ratios = [of_contacts * of_hinges, condition(&along)];
                let (state, slack) = self.state(&unknowns, (&open, &sides), ratios)?;
                if slack > 0.0 {
                    states.push(state);
                }
            }
        }
        Some(states)
    }
}

/// A random system of two bodies, which hang on each other, on ground, or both, in hinges with friction.
fn rough(numbers: &[f64], [hinged, grounded, driven]: [bool; 3], contacts: usize) -> Option<System> {
    let mut system = random(&numbers[20..], 2, contacts, [false, driven])?;
    let hinge = |first: &str, second: &str, at: usize| Hinge {
        between: [first.to_owned(), second.to_owned()],
        at: [numbers[at], numbers[at + 1]],
        radius: 0.02 + 0.4 * numbers[at + 2].abs().powi(2),
    };
    if hinged {
        system.hinges.push(hinge("body_0", "body_1", 0));
    }
    if grounded || !hinged {
        system.hinges.push(hinge("ground", "body_1", 3));
    }
    system.with_rates(numbers[6..].iter().map(|number| 2.0 * number))
}

proptest! {
    #![proptest_config(many(200))]
    /// Two bodies with one or two hinges with friction and one to three contacts: none, one and several states.
    #[test]
    fn random_systems_have_the_states_of_the_descriptor_form(
        numbers in vec(-1.0..1.0_f64, 119),
        hinged in any::<bool>(),
        grounded in any::<bool>(),
        driven in any::<bool>(),
        more in 0..2_usize,
    ) {
        let contacts = if hinged && grounded { 1 } else { 1 + more + usize::from(!driven) };
        let Some(system) = rough(&numbers, [hinged, grounded, driven], contacts) else { return Ok(()) };
        let rows = system.rows_with_drives();
        let values = DMatrix::from_columns(&rows).singular_values();
        prop_assume!(system.joint_rows().len() < 3 * system.bodies.len() && rows.len() <= 3 * system.bodies.len());
        prop_assume!(values.min() > 0.05 * values.max());
        prop_assume!(system.contacts.iter().any(Contact::opens));
        prop_assume!(system.contacts.iter().all(|contact| system.sliding_velocity(contact).abs() > 1e-3));
        prop_assume!(system.hinges.iter().all(|hinge| system.spin_of(hinge).abs() > 1e-3));
        let states = system.states_with_hinges();
        prop_assume!(states.is_some());
        let states = states.unwrap_or_default();
        let report = report_on(&system.text());
        // Where two states nearly meet, or nearly exist, rounding decides about both: the answer says so.
        let is_fold = |open: &String| open.starts_with("a region is not decided: fold");
        prop_assume!(report.complete == Proof::Proven || !report.open.iter().all(is_fold));
        assert_states(&report, &system, &states, 1e-8, "random");
    }
}

const LATCH: &str = include_str!("../../models/latch-with-pawl.toml");

/// The latch of the gallery with a rough pivot.
fn latch() -> Model {
    let pivot = "between = [\"pawl.pivot\", \"ground.pivot\"]";
    let text = LATCH.replace(pivot, &format!("{pivot}\nfriction_radius = \"r\""));
    Model::parse(&text.replace("mu = 0.3 ", "r = \"5 mm\"\nmu = 0.3 ")).unwrap()
}

/// The nose locks where the line of its force is a tangent of the friction circle of the pivot:
/// `P x n - mu P x u = r sqrt(1 + mu^2)`, with the nose P and the normal n and direction u of the ramp.
fn locks_at(r: f64) -> f64 {
    let (sin, cos) = 50_f64.to_radians().sin_cos();
    let (normal, along) = (0.1 * cos - 0.02 * sin, 0.1 * sin + 0.02 * cos);
    // (along^2 - r^2) mu^2 - 2 normal along mu + normal^2 - r^2 = 0, the lesser root.
    let (a, b, c) = (along * along - r * r, normal * along, normal * normal - r * r);
    (b - (b * b - a * c).sqrt()) / a
}

#[test]
fn a_latch_locks_where_the_force_on_its_nose_touches_the_friction_circle() {
    let model = latch();
    let report = limits(&model, &LimitsOptions::new("mu=0..1".parse().unwrap())).unwrap();
    assert_eq!(report.counts[0].solutions, 1);
    assert!((report.counts[0].to - locks_at(0.005)).abs() < 1e-8, "{:?}", report.counts);
    let report = limits(&model, &LimitsOptions::new("r=1mm..30mm".parse().unwrap())).unwrap();
    assert!((locks_at(report.counts[0].to) - 0.3).abs() < 1e-8, "{:?}", report.counts);
}

#[test]
fn all_questions_agree_on_a_latch_with_a_rough_pivot() {
    let model = latch();
    let of = |mu: &str| report_with(&model, &Settings::default().parameter("mu", mu));
    let report = of("0.3");
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven));
    let solution = &report.solutions[0];
    assert!(solution.residual < 1e-12, "{}", solution.residual);
    assert_eq!(solution.attainability.verdict, Verdict::Attainable);
    let margin = solution.margin.as_ref().unwrap().factor.unwrap();
    assert!(margin > 1.0);
    assert_eq!(of("0.6").status, Status::None);

    let driven = drive(&model, &DriveOptions::default()).unwrap();
    let json = serde_json::to_string(&driven).unwrap();
    assert!(json.contains(&format!("{:?}", solution.drives[0].effort)[..8]), "{json}");

    let axes = ["mu=0..1:21".parse().unwrap(), "r=0..10mm:3".parse().unwrap()];
    let sweep = Sweep::new(&model, &SweepOptions::grid(axes)).unwrap();
    let mut all: Vec<Rows> = Vec::new();
    sweep.run(&mut sweep.start(), &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    let column = |name: &str| sweep.columns().iter().position(|column| column.name == name).unwrap();
    let (normal, effort) = (column("normal_force.nose"), column("effort.push"));
    let (mut solved, mut jammed) = (0, 0);
    for (rows, row) in all.iter().flat_map(|rows| (0..rows.len()).map(move |row| (rows, row))) {
        let numbers = rows.numbers(row);
        let settings = Settings::default().parameter("mu", numbers[0]).parameter("r", numbers[1]);
        let report = report_with(&model, &settings);
        assert_eq!(rows.heads[row].solutions as usize, report.solutions.len(), "{numbers:?}");
        assert_eq!(report.solutions.is_empty(), numbers[0] > locks_at(numbers[1]), "{numbers:?}");
        let Some(solution) = report.solutions.first() else {
            jammed += 1;
            continue;
        };
        solved += 1;
        let nose = solution.contacts.iter().find(|contact| contact.name == "nose").unwrap();
        assert!((numbers[normal] / nose.normal_force - 1.0).abs() < 1e-9, "{numbers:?}");
        assert!((numbers[effort] / solution.drives[0].effort - 1.0).abs() < 1e-9, "{numbers:?}");
    }
    assert!(solved > 20 && jammed > 20, "{solved} {jammed}");

    let [mu, r] = ["mu=0..1", "r=0..10mm"].map(|axis| axis.parse().unwrap());
    let map = map(&model, &MapOptions::new(mu, r).size(12, 8)).unwrap();
    assert_eq!(map.classes.len(), 2, "{:?}", map.classes);

    let history = simulate(&model, &SimulateOptions::new(1e-3)).unwrap();
    assert_eq!(history.end, End::Finished);
    let begins = history.reader().at(0.0).unwrap().efforts[0];
    assert!((begins / solution.drives[0].effort - 1.0).abs() < 1e-9, "{begins}");
    assert!(history.energy_error < 1e-9, "{}", history.energy_error);
}

/// A hinge that the closed contact alone keeps from turning: when it lifts off, nothing says beforehand in which sense it turns.
#[test]
fn a_hinge_that_turns_only_when_a_contact_lifts_off_is_refused() {
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        O = [0, 0]
        A = ["1 m", 0]
        S = ["0.5 m", "0.1 m"]
        [bodies.cart]
        points = ["O"]
        mass = "5 kg"
        moment_of_inertia = 1
        centre_of_mass = "O"
        [bodies.bar]
        points = ["O", "A", "S"]
        mass = "1 kg"
        moment_of_inertia = 0.1
        centre_of_mass = "S"
        [joints.rail]
        type = "block_slider"
        block = "cart"
        at = "O"
        along = 0
        length = "0.2 m"
        mu = 0.1
        [joints.pin]
        type = "hinge"
        between = ["bar.O", "cart.O"]
        friction_radius = "1 cm"
        [joints.tip]
        type = "corner_on_face"
        block = "bar"
        at = "A"
        along = 0
        mu = 0.2
        [coordinates.x]
        slide = "rail"
        rate = "1 m/s"
    "#;
    let kind = fault(text);
    assert!(matches!(kind, FaultKind::OneSided { .. }), "{kind}");
}
