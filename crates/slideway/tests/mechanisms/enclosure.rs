//! The enclosure of the influence coefficients: against the rounded ones, closed forms, and perturbed models.

use crate::answers::{model, parameters, report};
use crate::random_mechanisms::{cases, mechanisms};
use dashu_int::IBig;
use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use slideway::configuration::Configuration;
use slideway::enclosure::{EnclosedModeProblem, NotEnclosed, UncertainParameters, enclosure};
use slideway::fault::Faults;
use slideway::gallery::{GalleryModel, MODELS};
use slideway::influence::Influence;
use slideway::interval::Interval;
use slideway::kinetics::KineticEquations;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::modes::ContactState::{self, Negative, Positive};
use slideway::modes::certificate::{Decision, decide};
use slideway::solve::{SolveOptions, solve, solve_with};
use std::cell::Cell;
use std::fmt::Write;
use std::ops::ControlFlow;

/// Widths relative to the greatest entry of a column that count as narrow.
const WIDTH: f64 = 3e-12;

/// The enclosure of a model, with bounds of some parameters.
fn enclosed_within(
    model: &Model,
    uncertain: &[(&str, f64, f64)],
) -> Result<EnclosedModeProblem, NotEnclosed> {
    let add = |all: UncertainParameters, &(name, lower, upper): &(&str, f64, f64)| {
        all.with(name, Interval::new(lower, upper).unwrap())
    };
    let uncertain = uncertain.iter().fold(UncertainParameters::default(), add);
    let mechanism = Mechanism::new(model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    enclosure(model, &uncertain, &mechanism, &configuration)
}

fn enclosed(model: &Model) -> EnclosedModeProblem {
    enclosed_within(model, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The rounded influence of a model.
fn influence(model: &Model) -> Result<Influence, Faults> {
    let mechanism = Mechanism::new(model)?;
    let configuration = Configuration::new(&mechanism)?;
    Ok(Influence::new(&KineticEquations::new(&mechanism, &configuration)?))
}

/// How far the numbers are outside of the bounds, relative to the greatest of their column.
fn outside(bounds: &DMatrix<Interval>, numbers: &DMatrix<f64>) -> f64 {
    let mut most: f64 = 0.0;
    for column in 0..numbers.ncols() {
        let scale = numbers.column(column).amax().max(1e-300);
        for row in 0..numbers.nrows() {
            let (bounds, number) = (bounds[(row, column)], numbers[(row, column)]);
            most = most.max((bounds.lower() - number).max(number - bounds.upper()) / scale);
        }
    }
    most
}

/// The greatest width of an entry, relative to the greatest of its column.
fn relative_width(bounds: &DMatrix<Interval>) -> f64 {
    let width = |column: usize| {
        let greatest = bounds.column(column).map(Interval::middle).amax();
        if greatest == 0.0 { 0.0 } else { bounds.column(column).map(Interval::width).amax() / greatest }
    };
    (0..bounds.ncols()).map(width).fold(0.0, f64::max)
}

/// A vector as a matrix of one column.
fn column<T: nalgebra::Scalar>(vector: &DVector<T>) -> DMatrix<T> {
    DMatrix::from_column_slice(vector.len(), 1, vector.as_slice())
}

/// How far the rounded influence is outside of its enclosure.
fn influence_outside(enclosed: &EnclosedModeProblem, rounded: &Influence) -> f64 {
    let found = &enclosed.outputs.influence;
    // What may lift off has no second face.
    let (mut bounds, mut negative) = (found.eta.negative.clone(), rounded.eta(1));
    for (contact, _) in &found.one_sided {
        bounds.column_mut(*contact).fill(Interval::ZERO);
        negative.column_mut(*contact).fill(0.0);
    }
    outside(&found.eta.positive, &rounded.eta(0))
        .max(outside(&bounds, &negative))
        .max(outside(&column(&found.frictionless), &column(&rounded.normal_forces())))
}

/// A rational number from decimal digits, the last `places` of them behind the point.
fn decimal(digits: &str, places: usize) -> RBig {
    let ten: IBig = IBig::from(10).pow(places);
    RBig::from(digits.parse::<IBig>().unwrap()) / RBig::from(ten)
}

fn holds(bounds: Interval, value: &RBig) -> bool {
    RBig::try_from(bounds.lower()).unwrap() <= *value && *value <= RBig::try_from(bounds.upper()).unwrap()
}

/// The models of the gallery whose friction has a direction.
fn sliding() -> impl Iterator<Item = &'static GalleryModel> {
    let slides = |entry: &&GalleryModel| {
        solve(&Model::parse(entry.text).unwrap()).is_ok_and(|report| report.at_rest.is_empty())
    };
    MODELS.iter().filter(slides)
}

#[test]
fn the_gallery_is_enclosed_to_many_digits() {
    for entry in sliding() {
        let model = Model::parse(entry.text).unwrap();
        let (found, rounded) = (enclosed(&model), influence(&model).unwrap());
        assert!(influence_outside(&found, &rounded) <= 1e-13, "{}", entry.name);
        // The tubes of the boom overlap by little beside their length, so that reactions are large
        // differences; the place of the peg is one, 0.5 mm of 20 mm, divided by the sine of 0.5 degrees.
        let is_wide = ["telescopic-boom", "peg-in-hole"].contains(&entry.name);
        let narrow = if is_wide { 1e-10 } else { WIDTH };
        let influence = &found.outputs.influence;
        let loads = column(&influence.frictionless);
        for bounds in [&influence.eta.positive, &influence.eta.negative, &loads] {
            assert!(relative_width(bounds) < narrow, "{}: {:e}", entry.name, relative_width(bounds));
        }
    }
}

/// Klepp's example in closed form, from the balance of the bar and of the block with `t = tan(alpha)`:
///
/// ```text
/// N_1 = mg/2 + t/2 (F_2 + F_3 - F_1),    N_2 + N_3 = mg - N_1,    N_2 - N_3 = h/b (sigma_2 F_2 + sigma_3 F_3)
/// ```
#[test]
fn the_example_of_the_paper_is_enclosed_exactly() {
    let found = enclosed(&model("klepp-2002")).outputs.influence;
    let tangent = decimal("5671281819617709530994418439863964421625378260689750", 51);
    let part = |numerator: i32, denominator: i32| {
        RBig::from(IBig::from(numerator)) / RBig::from(IBig::from(denominator))
    };
    for (contact, weight) in [(0, part(981, 200)), (1, part(981, 400)), (2, part(981, 400))] {
        assert!(holds(found.frictionless[contact], &weight));
    }
    for (sign, eta) in [(1, &found.eta.positive), (-1, &found.eta.negative)] {
        for column in 0..3 {
            let push = if column == 0 { -part(1, 2) } else { part(1, 2) };
            let first = &push * &tangent;
            let couple = if column == 0 { RBig::ZERO } else { part(sign, 4) };
            assert!(holds(eta[(0, column)], &first));
            assert!(holds(eta[(1, column)], &(&couple - &first * part(1, 2))));
            assert!(holds(eta[(2, column)], &(-&couple - &first * part(1, 2))));
        }
    }
    // What is written as a decimal is that decimal, and what is exactly a number is that alone.
    assert!(holds(found.mu.positive[(1, 0)], &part(1, 10)) && found.mu.positive[1].width() > 0.0);
    assert_eq!(found.mu.positive[(0, 0)], Interval::point(0.5));
}

/// At mu_1 = cot(alpha), moving to the left, N_2 and N_3 vanish together.
#[test]
fn a_double_boundary_is_left_undecided() {
    let settings = parameters(&[("mu_1", "1/tan(alpha)"), ("F_20", "0 N"), ("direction", "-1")]);
    let problem = enclosed(&model("klepp-2002").with(&settings).unwrap()).problem;
    for front in [Positive, Negative] {
        for rear in [Positive, Negative] {
            let Decision::Undecided { unknowns: Some(unknowns), in_doubt } =
                decide(&problem, &[Positive, front, rear]).decision
            else {
                panic!("{front:?}, {rear:?} is on the boundary");
            };
            assert_eq!(in_doubt, [1, 2]);
            assert!(unknowns[1].contains(0.0) && unknowns[2].contains(0.0));
        }
    }
    // A little beside it the same patterns are decided.
    let settings = settings.parameter("mu_1", "1/tan(alpha) - 1e-9");
    let problem = enclosed(&model("klepp-2002").with(&settings).unwrap()).problem;
    let found = |pattern: [ContactState; 3]| decide(&problem, &pattern).decision;
    assert!(!matches!(found([Positive, Positive, Positive]), Decision::Undecided { .. }));
    assert!(!matches!(found([Positive, Negative, Negative]), Decision::Undecided { .. }));
}

#[test]
fn solutions_of_the_pipeline_are_proven_for_the_mechanism() {
    let cases: [(&str, &[(&str, &str)]); 7] = [
        ("klepp-2002", &[]),
        ("klepp-2002", &[("F_10", "2 N"), ("F_30", "m*g/2")]),
        ("slider-crank", &[]),
        ("telescopic-boom", &[]),
        ("scotch-yoke", &[]),
        ("sleeve-on-arm", &[]),
        ("cam-follower", &[]),
    ];
    for (name, settings) in cases {
        let problem = enclosed(&model(name).with(&parameters(settings)).unwrap()).problem;
        for solution in report(name, settings).solutions {
            let forces: Vec<f64> = solution.contacts.iter().map(|contact| contact.normal_force).collect();
            let side = |force: &f64| if *force > 0.0 { Positive } else { Negative };
            let pattern: Vec<ContactState> = forces.iter().map(side).collect();
            let Decision::Solution { unknowns, .. } = decide(&problem, &pattern).decision else {
                panic!("{name}: {pattern:?}");
            };
            let scale = forces.iter().map(|force| force.abs()).fold(0.0, f64::max);
            for (bounds, force) in unknowns.iter().zip(&forces) {
                let slack = Interval::around(0.0, 1e-12 * scale);
                assert!((*bounds + slack).contains(force.abs()), "{name}: {bounds:?} {force}");
            }
        }
    }
}

#[test]
fn versions_are_equal_where_theory_says_so() {
    let settings = parameters(&[("F_10", "2 N"), ("F_20", "0 N")]);
    let model = model("klepp-2002").with(&settings).unwrap();
    let found = enclosed_within(&model, &[("F_10", 1.0, 2.0)]).unwrap();
    // The pin has no height; friction at the block changes no other contact than those of the block.
    let eta = &found.outputs.influence.eta;
    assert!((0..3).all(|row| eta.positive[(row, 0)] == eta.negative[(row, 0)]));
    assert!((0..3).all(|column| eta.positive[(0, column)] == eta.negative[(0, column)]));
    assert!(!found.problem.centre().has_jump(0), "its preload acts on both sides alike");
    let flat = model.with(&parameters(&[("h", "0 m"), ("F_20", "m*g")])).unwrap();
    let found = enclosed(&flat);
    assert_eq!(found.outputs.influence.eta.positive, found.outputs.influence.eta.negative);
    assert!((0..3).all(|contact| !found.problem.centre().has_jump(contact)));
}

#[test]
fn what_cannot_be_enclosed_is_told() {
    let klepp = model("klepp-2002");
    let error =
        |name: &str, lower: f64, upper: f64| enclosed_within(&klepp, &[(name, lower, upper)]).unwrap_err();
    let unknown = error("mu1", 0.1, 0.2);
    assert_eq!(unknown.to_string(), "there is no parameter `mu1`; did you mean `mu_1`?");
    assert_eq!(error("m", 1.0, f64::INFINITY).to_string(), "the bounds of m are not finite");
    assert!(matches!(error("m", -1.0, 1.0), NotEnclosed::Values(_)));
    assert!(matches!(error("direction", -1.0, 2.0), NotEnclosed::SlidingDirection { .. }));
    assert!(matches!(error("b", 1e-9, 1.0), NotEnclosed::Equations));
    let crank = model("slider-crank");
    let error = enclosed_within(&crank, &[("phi_drawn", 0.5, 1.5)]).unwrap_err();
    assert_eq!(error, NotEnclosed::Positions);
}

/// Every parameter of every model varies a little; the rounded influence of the changed model lies within the
/// bounds.
#[test]
fn changed_models_of_the_gallery_lie_within_the_bounds() {
    for entry in sliding() {
        let model = Model::parse(entry.text).unwrap();
        let values = model.parameter_values(&model.constants().unwrap());
        for (parameter, value) in model.parameters.iter().zip(values) {
            let spread = 1e-5 * value.abs();
            // The second range does not hold the value of the computed positions.
            for (least, greatest, shares) in [(-1.0, 1.0, [-1.0, 0.3, 1.0]), (2.0, 3.0, [2.0, 2.6, 3.0])] {
                let bounds = (&*parameter.name, value + least * spread, value + greatest * spread);
                let found = enclosed_within(&model, &[bounds])
                    .unwrap_or_else(|error| panic!("{}, {}: {error}", entry.name, parameter.name));
                for share in shares {
                    let settings = parameters(&[(&parameter.name, &(value + share * spread).to_string())]);
                    let Ok(rounded) = influence(&model.with(&settings).unwrap()) else { continue };
                    let outside = influence_outside(&found, &rounded);
                    assert!(outside < 1e-11, "{}, {}: {outside:e}", entry.name, parameter.name);
                }
            }
        }
    }
}

/// Lines of a model file whose numbers are made to depend on a parameter of their own.
const VARIED: [&str; 8] =
    ["mass", "moment_of_inertia", "along", "length", "height", "stiffness", "value", "rate"];

/// A model file in which the numbers of `VARIED` are `number*(1 + e_name)`.
fn varied(text: &str) -> String {
    let line = |line: &str| match line.split_once(" = ") {
        Some((name, number)) if VARIED.contains(&name) => format!("{name} = \"{number}*(1 + e_{name})\"\n"),
        _ => format!("{line}\n"),
    };
    let (head, tables) = text.split_once("[points]").unwrap();
    let declared = VARIED.map(|name| format!("e_{name} = 0\n")).concat();
    format!("{head}[parameters]\n{declared}[points]{}", tables.lines().map(line).collect::<Vec<_>>().concat())
}

#[test]
fn random_mechanisms_lie_within_the_bounds() {
    let (tried, enclosed) = (Cell::new(0), Cell::new(0));
    let shares = proptest::collection::vec(-1.0..=1.0_f64, VARIED.len());
    let outcome = TestRunner::new(cases(150)).run(&(mechanisms(), shares), |(drawing, shares)| {
        let model = Model::parse(&varied(&drawing.text())).unwrap();
        let Ok(rounded) = influence(&model) else { return Ok(()) };
        tried.set(tried.get() + 1);
        let names: Vec<String> = VARIED.iter().map(|name| format!("e_{name}")).collect();
        let spread = 1e-7;
        let bounds: Vec<_> = names.iter().map(|name| (name.as_str(), -spread, spread)).collect();
        let (Ok(exact), Ok(found)) = (enclosed_within(&model, &[]), enclosed_within(&model, &bounds)) else {
            return Ok(());
        };
        enclosed.set(enclosed.get() + 1);
        prop_assert!(influence_outside(&exact, &rounded) < 1e-11);
        let values: Vec<String> = shares.iter().map(|share| (share * spread).to_string()).collect();
        let list: Vec<(&str, &str)> =
            names.iter().zip(&values).map(|(name, value)| (name.as_str(), value.as_str())).collect();
        let changed = model.with(&parameters(&list)).unwrap();
        let Ok(rounded) = influence(&changed) else { return Ok(()) };
        prop_assert!(influence_outside(&found, &rounded) < 1e-11);
        Ok(())
    });
    outcome.unwrap();
    assert!(
        10 * enclosed.get() >= 9 * tried.get() && tried.get() > 100,
        "{} of {}",
        enclosed.get(),
        tried.get()
    );
}

/// A cart on a rail with so many bars on it, one hanging from the other.
fn chain(bars: usize) -> String {
    let mut points = String::from("gravity = 9.81\n[points]\np0 = [0, 0]\n");
    let mut rest = String::from(
        "[bodies.b0]\npoints = [\"p0\"]\nmass = 1\nmoment_of_inertia = 0.01\ncentre_of_mass = \"p0\"\n\
         [joints.s]\ntype = \"block_slider\"\nblock = \"b0\"\nat = \"p0\"\nalong = 0\nlength = 0.1\nmu = 0.2\n\
         [coordinates.x]\nslide = \"s\"\nrate = 1\n",
    );
    for bar in 1..=bars {
        let above = bar - 1;
        writeln!(points, "p{bar} = [{}, 0]", 0.1 * bar as f64).unwrap();
        write!(
            rest,
            "[bodies.b{bar}]\npoints = [\"p{above}\", \"p{bar}\"]\nmass = 1\nmoment_of_inertia = 0.01\n\
             centre_of_mass = \"p{bar}\"\n[joints.h{bar}]\ntype = \"hinge\"\n\
             between = [\"b{bar}.p{above}\", \"b{above}.p{above}\"]\n[coordinates.q{bar}]\nrotation = \"b{bar}\"\n\
             rate = 0.1\n",
        )
        .unwrap();
    }
    points + &rest
}

/// Bounds of the equations of 50 bodies take some 10^8 multiplications before the search begins: a callback that breaks then
/// ends them, and is called no more than once by each stage.
#[test]
fn bounds_of_many_bodies_are_given_up_when_the_work_is_to_end() {
    let model = Model::parse(&chain(50)).unwrap();
    let mut calls = 0;
    let report = solve_with(&model, &SolveOptions::default(), &mut |progress| {
        if progress.counted != "nodes" {
            return ControlFlow::Continue(());
        }
        calls += 1;
        ControlFlow::Break(())
    })
    .unwrap();
    assert!(report.partial && calls <= 4, "{calls} calls");
    assert!(
        report.open.iter().any(|reason| reason.contains("the work was ended before")),
        "{:?}",
        report.open
    );
}
