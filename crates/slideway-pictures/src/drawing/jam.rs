//! Why a mechanism jams: the friction cones of the contacts that lock it, and the forces within them.
//!
//! A single body that touches its guide in two places and is pushed along a line is drawn as textbooks do: the
//! reactions meet the push in one place, which lies in the overlap of both cones, and so any push finds reactions that
//! balance it. Of any other mechanism each force is drawn within its own cone.

use super::Painter;
use super::forces::AT_REST;
use super::loads::{CORNER, LEAST_ARROW};
use super::outline::{clipped, turned, unit};
use super::scene::{Bounds, Class, Point, Shape};
use super::slide::Slide;
use slideway::ids::{ContactId, Frame};
use slideway::mechanism::Effort;
use slideway::model::SliderKind;

/// How long a cone is drawn by itself, and how far beyond the place where the forces meet.
const CONE: f64 = 95.0;
const BEYOND: f64 = 45.0;
/// The greatest distance of that place from a contact with which it is drawn.
const FARTHEST: f64 = 700.0;

/// A contact that presses.
struct Cone {
    /// Where the force acts on the pressed face.
    apex: Point,
    /// The unit direction of the normal force on what it acts on, and the one along the face.
    normal: Point,
    along: Point,
    /// The coefficient of friction.
    mu: f64,
    /// The force (N).
    force: Point,
    /// Whether it presses from outside what it acts on.
    is_outside: bool,
}

impl Cone {
    /// A place by its distances from the apex along the normal and along the face.
    fn coordinates(&self, place: Point) -> [f64; 2] {
        let from = place - self.apex;
        [from.dot(&self.normal), from.dot(&self.along)]
    }

    /// Whether a line through the apex and this place lies within the cone, with its opposite.
    fn holds(&self, place: Point) -> bool {
        let [height, aside] = self.coordinates(place);
        aside.abs() <= self.mu * height.abs()
    }

    /// The part of the cone up to this height; the opposite part for a negative one.
    fn part(&self, height: f64) -> Vec<Point> {
        let end = |side: f64| self.apex + self.normal * height + self.along * (side * self.mu * height);
        vec![self.apex, end(-1.0), end(1.0)]
    }

    /// Where a line enters or leaves the cone and its opposite, as multiples of its direction.
    fn crossings(&self, [place, direction]: [Point; 2]) -> impl Iterator<Item = f64> {
        let [height, aside] = self.coordinates(place);
        let [rise, way] = [direction.dot(&self.normal), direction.dot(&self.along)];
        let crossing = move |side: f64| (side * self.mu * height - aside) / (way - side * self.mu * rise);
        [-1.0, 1.0].into_iter().map(crossing).filter(|at| at.is_finite())
    }

    /// The unit direction of a force through this place, so that it presses.
    fn towards(&self, place: Point) -> Point {
        let direction = unit(place - self.apex, self.normal);
        direction * direction.dot(&self.normal).signum()
    }
}

impl Painter<'_> {
    /// The cones of all contacts that press, and their forces; with the line of the push and the overlap where there is one.
    pub(super) fn jam(&mut self) {
        let Some(scale) = self.options.force_scale else { return };
        let cones: Vec<Cone> = self
            .mechanism
            .contacts
            .iter()
            .enumerate()
            .filter_map(|(index, contact)| self.cone(ContactId(index), contact.mu))
            .collect();
        if let ([one, other], Some(push)) = (&cones[..], self.only_push())
            && let Some((meeting, sizes)) = meeting([one, other], push)
        {
            self.overlap([one, other], push, meeting);
            let effort = self.states.efforts[0].abs();
            for (cone, size) in [one, other].into_iter().zip(sizes) {
                self.force_in_cone(cone, cone.towards(meeting), size * effort * scale);
            }
            return;
        }
        for cone in cones.iter().filter(|cone| cone.mu > 0.0) {
            let sense = if cone.is_outside { -1.0 } else { 1.0 };
            self.area(Class::Cone, cone.part(sense * CONE / cone.mu.hypot(1.0)));
        }
        for cone in &cones {
            self.force_in_cone(cone, unit(cone.force, cone.normal), cone.force.norm() * scale);
        }
    }

    /// The friction cone of a contact at rest that presses, as high as its normal force is long: the arrow of its friction ends
    /// within it.
    pub(super) fn cone_at_rest(&mut self, contact: ContactId, scale: f64) {
        let of = &self.mechanism.contacts[contact.index()];
        let sliding = self.actual.contact(self.mechanism, contact).sliding_velocity.abs();
        if sliding > AT_REST * self.mechanism.size || !of.opens {
            return;
        }
        let Some(cone) = self.cone(contact, of.mu_static).filter(|cone| cone.mu > 0.0) else { return };
        let height = (cone.force.dot(&cone.normal) * scale).clamp(LEAST_ARROW, self.options.longest_arrow);
        let sense = if cone.is_outside { -1.0 } else { 1.0 };
        self.area(Class::Cone, cone.part(sense * height));
    }

    /// The cone of a contact that presses, with these coefficients of friction of its sides.
    fn cone(&self, contact: ContactId, mu: [f64; 2]) -> Option<Cone> {
        let index = contact.index();
        let forces = self.states.contacts.get(index)?.forces.filter(|forces| forces.normal != 0.0)?;
        let slide = self.slide(self.mechanism.contacts[index].joint)?;
        let Slide { guide, .. } = &slide;
        let force = (guide.across * forces.normal - guide.along * forces.friction) * slide.action();
        Some(Cone {
            apex: self.pressed(&slide, contact, forces),
            normal: guide.across * (forces.normal.signum() * slide.action()),
            along: guide.along,
            mu: mu[usize::from(forces.normal < 0.0)],
            force,
            is_outside: slide.around == (slide.block_frame == Frame::Ground),
        })
    }

    /// The line of action of the push and its direction, if nothing but one force and contacts that take no couple act on
    /// a single body.
    fn only_push(&self) -> Option<[Point; 2]> {
        let takes_no_couple =
            |slide: &Option<Slide>| slide.as_ref().is_some_and(|slide| slide.kind != SliderKind::Guided);
        let ([_], [drive]) = (&self.mechanism.bodies[..], &self.mechanism.drives[..]) else { return None };
        let Effort::Force { at, direction, turns, .. } = drive.effort else { return None };
        let effort = self.states.efforts.first().filter(|effort| **effort != 0.0)?;
        // Another free motion would go with an acceleration: then these forces are no balance.
        let is_free = self.mechanism.coordinates.len() > 1;
        if is_free || at.frame == Frame::Ground || !self.sliders.iter().all(takes_no_couple) {
            return None;
        }
        let direction = if turns { self.configuration.direction(at.frame, direction) } else { direction };
        Some([self.attached(&at), unit(self.view.direction(direction * effort.signum()), Point::x())])
    }

    /// The cones as far as they overlap about the place where the forces meet, and the lines of the forces. Cones go on
    /// beyond the picture: how wide they are does not make it wider.
    fn overlap(&mut self, cones: [&Cone; 2], [place, direction]: [Point; 2], meeting: Point) {
        let around = Bounds { least: meeting, greatest: meeting }.widened(BEYOND);
        let picture = self.scene.bounds().map_or(around, |drawn| drawn.with(around)).corners();
        let parts = cones.map(|cone| {
            let height = cone.coordinates(meeting)[0];
            clipped(&cone.part(height + BEYOND * height.signum()), &picture)
        });
        parts.iter().for_each(|part| self.area(Class::Cone, part.clone()));
        let overlap = clipped(&parts[0], &parts[1]);
        let middle = overlap.iter().sum::<Point>() / (overlap.len().max(1) as f64);
        self.area(Class::Overlap, overlap);
        let past = meeting + direction * (BEYOND * (meeting - place).dot(&direction).signum());
        self.line(Class::PushLine, vec![place, past]);
        for cone in cones {
            self.line(Class::ActionLine, vec![cone.apex, meeting]);
        }
        self.circle(Class::Hinge, meeting, 3.0);
        let away = unit(middle - meeting, turned(direction));
        self.value(Class::Words, "both cones".to_owned(), middle, away);
        self.scene.has_overlap = true;
    }

    fn force_in_cone(&mut self, cone: &Cone, direction: Point, length: f64) {
        let length = length.max(LEAST_ARROW);
        let from = if cone.is_outside { cone.apex - direction * length } else { cone.apex };
        self.scene.add(Class::ContactForce, Shape::Arrow { from, to: from + direction * length });
        self.circle(Class::JammedCorner, cone.apex, CORNER);
    }
}

/// A place on the line of a push that lies in both cones, in the middle of where it does, and the reactions that balance a
/// push of 1 there; none if there is no such place, or none nearby.
fn meeting(cones: [&Cone; 2], push: [Point; 2]) -> Option<(Point, [f64; 2])> {
    let [place, direction] = push;
    let mut ends: Vec<f64> = cones.iter().flat_map(|cone| cone.crossings(push)).collect();
    ends.sort_by(f64::total_cmp);
    let beyond = [ends.first()? - BEYOND, ends.last()? + BEYOND];
    let between = ends.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let middles = between.chain(beyond).map(|at| place + direction * at);
    middles
        .filter(|middle| {
            cones.iter().all(|cone| cone.holds(*middle) && (middle - cone.apex).norm() < FARTHEST)
        })
        .find_map(|middle| Some((middle, balancing(cones.map(|cone| cone.towards(middle)), direction)?)))
}

/// The positive multiples of two directions that add up to nothing with a third; none if there are none.
fn balancing([one, other]: [Point; 2], push: Point) -> Option<[f64; 2]> {
    let area = one.perp(&other);
    let sizes = [-push.perp(&other) / area, push.perp(&one) / area];
    sizes.iter().all(|size| *size > 0.0 && size.is_finite()).then_some(sizes)
}
