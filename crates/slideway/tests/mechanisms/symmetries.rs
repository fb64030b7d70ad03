//! The same physics seen otherwise: mirrored, turned, in other units, numbered otherwise, with roles
//! exchanged.

use crate::answers::assert_close;
use crate::brute_force::Solved;
use crate::drawing::{Drawing, Kind, SliderKind, Units, Vector, turned};
use crate::random_mechanisms::{cases, mechanisms};
use proptest::prelude::*;
use slideway::report::{Solution, SolveReport};

/// What a name or a text becomes.
type OfText<T> = Box<dyn Fn(&str) -> T>;

/// How quantities of the image follow from those of the original.
struct Image {
    /// Name of a contact in the image and the factor of the sign of its normal force.
    contact: OfText<(String, i8)>,
    /// Factor of the sign of its friction force.
    friction: OfText<f64>,
    force: f64,
    acceleration: Box<dyn Fn(Vector) -> Vector>,
    angular_acceleration: f64,
    torque: f64,
    /// Force of a hinge on the same body, by the vectors that are accelerations above.
    hinge: Box<dyn Fn(Vector) -> Vector>,
    /// The mode of a joint in words, if it can be said.
    mode: OfText<Option<String>>,
}

impl Image {
    /// Nothing changes.
    fn identity() -> Self {
        Self {
            contact: Box::new(|name| (name.to_owned(), 1)),
            friction: Box::new(|_| 1.0),
            force: 1.0,
            acceleration: Box::new(|vector| vector),
            angular_acceleration: 1.0,
            torque: 1.0,
            hinge: Box::new(|vector| vector),
            mode: Box::new(|mode| Some(mode.to_owned())),
        }
    }

    #[track_caller]
    fn check(&self, original: &Solved, image: &Drawing) -> Result<(), TestCaseError> {
        let Some(image) = Solved::new(image.clone()) else {
            return Err(TestCaseError::fail("the image cannot reach its state"));
        };
        let (one, other) = (&original.report, &image.report);
        prop_assert_eq!(one.status, other.status);
        prop_assert_eq!(one.complete, other.complete);
        prop_assert_eq!(one.patterns, other.patterns);
        prop_assert_eq!(one.rejected.len(), other.rejected.len());
        prop_assert_eq!(one.solutions.len(), other.solutions.len());
        prop_assert_eq!(one.preload_gap_states.len(), other.preload_gap_states.len());
        for solution in &one.solutions {
            self.check_solution(solution, &other.solutions)?;
        }
        for state in &one.preload_gap_states {
            self.check_solution(state, &other.preload_gap_states)?;
        }
        Ok(())
    }

    fn check_solution(&self, one: &Solution, others: &[Solution]) -> Result<(), TestCaseError> {
        let sides = |solution: &Solution, name: &str| {
            solution.contacts.iter().find(|contact| contact.name == name).expect("the contact").side
        };
        let is_image = |other: &&Solution| {
            one.contacts.iter().all(|contact| {
                let (name, factor) = (self.contact)(&contact.name);
                sides(other, &name) == factor * contact.side
            })
        };
        let Some(other) = others.iter().find(is_image) else {
            return Err(TestCaseError::fail(format!("{} has no image", one.pattern)));
        };
        let greatest = |solution: &Solution| {
            solution.contacts.iter().fold(1.0, |n: f64, contact| n.max(contact.normal_force.abs()))
        };
        let scale = self.force * greatest(one);
        for contact in &one.contacts {
            let (name, factor) = (self.contact)(&contact.name);
            let factor = f64::from(factor);
            let seen = other.contacts.iter().find(|other| other.name == name).expect("the contact");
            assert_close(seen.normal_force, factor * self.force * contact.normal_force, scale, 1e-8);
            let friction = (self.friction)(&contact.name) * self.force * contact.friction_force;
            assert_close(seen.friction_force, friction, scale, 1e-8);
            match (contact.preload_share, seen.preload_share) {
                (Some(share), Some(seen)) => {
                    assert_close(seen, if factor > 0.0 { share } else { 1.0 - share }, 1.0, 1e-6);
                }
                (None, None) => {}
                _ => return Err(TestCaseError::fail("a share is missing")),
            }
        }
        for body in &one.bodies {
            let seen = other.bodies.iter().find(|other| other.name == body.name).expect("the body");
            let expected = (self.acceleration)(body.acceleration);
            let [x, y] = (self.acceleration)([1.0, 1.0]);
            let unit = x.abs().max(y.abs());
            for (seen, expected) in seen.acceleration.iter().zip(expected) {
                assert_close(*seen, expected, unit * greatest(one), 1e-8);
            }
            let angular = self.angular_acceleration;
            let expected = angular * body.angular_acceleration;
            assert_close(seen.angular_acceleration, expected, angular.abs() * 10.0 * greatest(one), 1e-8);
        }
        for hinge in &one.hinges {
            let seen = other.hinges.iter().find(|other| other.name == hinge.name).expect("the hinge");
            let mut expected = (self.hinge)(hinge.force);
            if seen.on != hinge.on {
                expected = expected.map(|component| -component);
            }
            for (seen, expected) in seen.force.iter().zip(expected) {
                assert_close(*seen, expected, scale, 1e-7);
            }
        }
        for (drive, seen) in one.drives.iter().zip(&other.drives) {
            let factor = if drive.unit == "N" { self.force } else { self.torque };
            assert_close(seen.effort, factor * drive.effort, factor.abs() * greatest(one), 1e-7);
        }
        for joint in &one.joints {
            let seen = other.joints.iter().find(|other| other.name == joint.name).expect("the joint");
            if let Some(expected) = (self.mode)(&joint.mode) {
                prop_assert_eq!(corners_sorted(&seen.mode), corners_sorted(&expected));
            }
        }
        assert_close(other.oriented_determinant, one.oriented_determinant, 1e-3, 1e-6);
        check_attainability(one, other)
    }
}

/// The same verdict, and the same eigenvalues in other units.
fn check_attainability(one: &Solution, other: &Solution) -> Result<(), TestCaseError> {
    let (one, other) = (&one.attainability, &other.attainability);
    prop_assert_eq!(one.verdict, other.verdict);
    prop_assert_eq!(one.massless_motions, other.massless_motions);
    prop_assert_eq!(one.eigenvalues.len(), other.eigenvalues.len());
    let greatest =
        [one, other].map(|one| one.eigenvalues.iter().fold(0.0, |n: f64, [re, im]| n.max(re.hypot(*im))));
    for ([re, im], [other_re, other_im]) in one.eigenvalues.iter().zip(&other.eigenvalues) {
        assert_close(re / greatest[0], other_re / greatest[1], 1.0, 1e-6);
        assert_close(im / greatest[0], other_im / greatest[1], 1.0, 1e-6);
    }
    Ok(())
}

/// "touching at a and b" is the same as "touching at b and a".
fn corners_sorted(mode: &str) -> String {
    let Some(corners) = mode.strip_prefix("touching at ") else { return mode.to_owned() };
    let mut corners: Vec<&str> = corners.split(" and ").collect();
    corners.sort_unstable();
    format!("touching at {}", corners.join(" and "))
}

fn exchanged(text: &str, one: &str, other: &str) -> String {
    text.replace(one, "\0").replace(other, one).replace('\0', other)
}

fn solved(drawing: Drawing) -> Result<Solved, TestCaseError> {
    let Some(solved) = Solved::new(drawing) else { return Err(TestCaseError::reject("state")) };
    if solved.is_delicate() { Err(TestCaseError::reject("delicate")) } else { Ok(solved) }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn mirror_image(drawing in mechanisms()) {
        let original = solved(drawing)?;
        let flip = |[x, y]: Vector| [-x, y];
        let image = Image {
            contact: Box::new(|name| (name.to_owned(), -1)),
            acceleration: Box::new(flip),
            hinge: Box::new(flip),
            angular_acceleration: -1.0,
            torque: -1.0,
            mode: Box::new(|mode| Some(exchanged(mode, "left", "right"))),
            ..Image::identity()
        };
        image.check(&original, &original.drawing.mirrored())?;
    }

    #[test]
    fn any_rotation_of_the_drawing(
        drawing in mechanisms(),
        angle in -7.0..7.0_f64,
        shift in prop::array::uniform2(-3.0..3.0_f64),
    ) {
        let original = solved(drawing)?;
        let image = Image {
            acceleration: Box::new(move |vector| turned(vector, angle)),
            hinge: Box::new(move |vector| turned(vector, angle)),
            mode: Box::new(|_| None),
            ..Image::identity()
        };
        image.check(&original, &original.drawing.rotated(angle, shift))?;
    }

    #[test]
    fn upside_down(drawing in mechanisms()) {
        let original = solved(drawing)?;
        let turn = |[x, y]: Vector| [-x, -y];
        let words = |mode: &str| Some(exchanged(&exchanged(mode, "left", "right"), "upper", "lower"));
        let image = Image {
            acceleration: Box::new(turn),
            hinge: Box::new(turn),
            mode: Box::new(words),
            ..Image::identity()
        };
        image.check(&original, &original.drawing.rotated(std::f64::consts::PI, [0.0; 2]))?;
    }

    #[test]
    fn other_units(drawing in mechanisms(), powers in prop::array::uniform3(-3.0..3.0_f64)) {
        let original = solved(drawing)?;
        let [length, mass, time] = powers.map(|power| 10_f64.powf(power));
        let units = Units { length, mass, time };
        let (force, acceleration) = (units.force(), units.acceleration());
        let image = Image {
            force,
            acceleration: Box::new(move |vector| vector.map(|component| acceleration * component)),
            hinge: Box::new(move |vector| vector.map(|component| force * component)),
            angular_acceleration: time.powi(-2),
            torque: force * length,
            ..Image::identity()
        };
        image.check(&original, &original.drawing.scaled(units))?;
    }

    #[test]
    fn another_numbering(drawing in mechanisms()) {
        let original = solved(drawing)?;
        Image::identity().check(&original, &original.drawing.reversed())?;
    }

    #[test]
    fn block_and_guide_exchanged(drawing in mechanisms()) {
        let original = solved(drawing)?;
        let blocks: Vec<String> = original
            .drawing
            .sliders()
            .filter(|(_, slider)| slider.kind == SliderKind::Block)
            .map(|(name, _)| name.to_owned())
            .collect();
        let friction = blocks.clone();
        let is_of_block = |blocks: &[String], contact: &str| {
            blocks.iter().any(|block| contact.split('.').next() == Some(block.as_str()))
        };
        let image = Image {
            contact: Box::new(move |name| (name.to_owned(), if is_of_block(&blocks, name) { -1 } else { 1 })),
            friction: Box::new(move |name| if is_of_block(&friction, name) { -1.0 } else { 1.0 }),
            // "flat on the lower guide" becomes "flat on the lower face of the guide": what touches is named
            // by the guide, whose other part it now is.
            mode: Box::new(|_| None),
            ..Image::identity()
        };
        image.check(&original, &original.drawing.with_roles_exchanged())?;
    }

    #[test]
    fn guides_counted_backwards(drawing in mechanisms()) {
        let original = solved(drawing)?;
        let image = Image {
            contact: Box::new(|name| {
                let opposite = match name.rsplit_once('.') {
                    Some((joint, "front")) => format!("{joint}.rear"),
                    Some((joint, _)) => format!("{joint}.front"),
                    None => name.to_owned(),
                };
                (opposite, -1)
            }),
            friction: Box::new(|_| -1.0),
            ..Image::identity()
        };
        image.check(&original, &original.drawing.with_guides_reversed())?;
    }
}

#[test]
fn the_families_reach_every_kind_of_outcome() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::new(cases(1));
    let mut outcomes = std::collections::BTreeMap::new();
    let (mut kinds, mut rejected) = (std::collections::BTreeSet::new(), 0);
    for _ in 0..600 {
        let drawing = mechanisms().new_tree(&mut runner).unwrap().current();
        for joint in &drawing.joints {
            if let Kind::Slider(slider) = &joint.kind {
                kinds.insert((format!("{:?}", slider.kind), slider.around, slider.block.is_none()));
            }
        }
        let report: Option<SolveReport> = Solved::new(drawing).map(|solved| solved.report);
        rejected += usize::from(report.as_ref().is_some_and(|report| !report.rejected.is_empty()));
        *outcomes.entry(format!("{:?}", report.map(|report| report.status))).or_insert(0) += 1;
    }
    for status in ["Some(One)", "Some(Several)", "Some(None)", "Some(PreloadGap)"] {
        assert!(outcomes.contains_key(status), "{status} is missing in {outcomes:?}");
    }
    assert!(outcomes["Some(One)"] > 200 && outcomes.get("None").copied().unwrap_or(0) < 60, "{outcomes:?}");
    assert!(rejected > 10 && kinds.len() >= 8, "{rejected} {kinds:?}");
}
