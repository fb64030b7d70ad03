//! States of one mechanism after another, each on the branch of the drawing.

use super::assembly::{check_position, closed_drawing, singular_state, way_fault};
use super::following::{Arrival, Halt, Settled, follow, settle};
use super::joint_equations::JointEquations;
use super::leg::{Leg, drawn, scale};
use super::{Configuration, Pose, Velocity};
use crate::fault::Faults;
use crate::ids::Frame;
use crate::mechanism::{Attachment, CoordinateKind, JointKind, Mechanism};
use crate::model::SliderKind;
use nalgebra::{DVector, Vector2};

/// States that are extrapolated.
const REMEMBERED: usize = 3;
/// Steps of a coordinate that differ by less than this multiple count as even.
const EVEN: f64 = 1e-6;
/// Where several coordinates have left the drawing, the neighbourhood of a state for which its way is shown,
/// too, is so many times as wide as the way from the state before ...
const NEIGHBOURS: f64 = 8.0;
/// ... but at most this (sizes of the mechanism, or rad).
const WIDEST: f64 = 0.02;

/// Finds the configurations of one mechanism after another, in fewer steps where they are near those before.
///
/// Every configuration is the one to which the straight way of the coordinates leads from the drawing, as
/// [`Configuration::new`] finds it: what was shown for neighbouring values is used only where it shows this,
/// too. For a single coordinate that has left the drawing these are all values between which steps were
/// followed; for several ones the ways from the drawing to all values in a neighbourhood are shown together.
/// If a dimension changes everything is forgotten.
///
/// ```
/// use slideway::configuration::{Configuration, Follower};
/// use slideway::mechanism::Mechanism;
/// use slideway::model::{Model, Settings};
/// let text = slideway::gallery::find("slider-crank").expect("in the gallery").text;
/// let model = Model::parse(text)?;
/// let mut follower = Follower::default();
/// for phi in ["61 deg", "61.1 deg", "61.2 deg"] {
///     let moved = Mechanism::new(&model.with(&Settings::default().position("phi", phi))?)?;
///     let (near, direct) = (follower.configuration(&moved)?, Configuration::new(&moved)?);
///     assert!((near.poses[1].angle() - direct.poses[1].angle()).abs() < 1e-14);
/// }
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Follower {
    /// Numbers on which the joint equations depend; empty at first.
    linkage: Vec<f64>,
    /// The closed drawing.
    drawing: Vec<Pose>,
    line: Option<Line>,
    /// The last configurations, the last one first.
    reached: Vec<Configuration>,
    /// Where ways along one coordinate have ended, with that coordinate.
    ended: Vec<(usize, Halt)>,
}

/// A leg with its last step.
#[derive(Debug, Clone)]
struct Line {
    leg: Leg,
    /// The coordinate that leaves the drawing, if it is the only one.
    coordinate: Option<usize>,
    last: Arrival,
    /// Its end, and the values there.
    end: f64,
    values: Vec<f64>,
    /// Steps from the drawing.
    steps: usize,
}

impl Follower {
    /// The configuration at the coordinate values and rates of a mechanism.
    ///
    /// # Errors
    /// As [`Configuration::new`].
    pub fn configuration(&mut self, mechanism: &Mechanism) -> Result<Configuration, Faults> {
        self.configuration_while(mechanism, &mut || true)
    }

    /// [`Follower::configuration`]; a fault once `proceed`, which is asked before every further step, is `false`.
    ///
    /// # Errors
    /// As [`Configuration::new`], or [`FaultKind::WorkEnded`](crate::fault::FaultKind::WorkEnded).
    pub(super) fn configuration_while(
        &mut self,
        mechanism: &Mechanism,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Configuration, Faults> {
        let linkage = linkage(mechanism);
        if self.linkage != linkage {
            *self = Self::default();
            self.drawing = closed_drawing(mechanism, proceed)?;
            self.linkage = linkage;
        }
        let coordinates: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.value).collect();
        let rates: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.rate).collect();
        let is_same = |last: &&Configuration| last.coordinates == coordinates && last.rates == rates;
        if let Some(last) = self.reached.first().filter(is_same) {
            let configuration = Configuration { time: mechanism.time, ..last.clone() };
            check_position(mechanism, &configuration)?;
            return Ok(configuration);
        }
        let (settled, steps) = self.reach(mechanism, &coordinates, proceed)?;
        let Some(velocities) = velocities(mechanism, &settled, &coordinates) else {
            return Err(singular_state(mechanism, &settled.poses).into());
        };
        let configuration = Configuration {
            velocities,
            poses: settled.poses,
            coordinates,
            rates,
            time: mechanism.time,
            steps,
            pieces: None,
        };
        self.reached.insert(0, configuration.clone());
        self.reached.truncate(REMEMBERED);
        check_position(mechanism, &configuration)?;
        Ok(configuration)
    }

    /// The positions at these values, and the steps to them.
    fn reach(
        &mut self,
        mechanism: &Mechanism,
        values: &[f64],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<(Settled, usize), Faults> {
        if let Some(found) =
            self.line.as_ref().and_then(|line| line.settled(mechanism, values, &self.reached))
        {
            return Ok(found);
        }
        let drawn = drawn(mechanism);
        let moved: Vec<usize> = (0..values.len()).filter(|&index| values[index] != drawn[index]).collect();
        let line = match moved[..] {
            [] => {
                let leg = Leg::along(mechanism, 0);
                let settled = settle(mechanism, &leg, (0.0, values), self.drawing.clone());
                return match settled {
                    Some(settled) => Ok((settled, 0)),
                    None => Err(singular_state(mechanism, &self.drawing).into()),
                };
            }
            [coordinate] => self.along(mechanism, coordinate, values, proceed)?,
            _ => self.straight(mechanism, values, proceed)?,
        };
        let found = (line.last.settled.clone(), line.steps);
        self.line = Some(line);
        Ok(found)
    }

    /// Follows the only coordinate that leaves the drawing, from the nearest state.
    fn along(
        &mut self,
        mechanism: &Mechanism,
        coordinate: usize,
        values: &[f64],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Line, Faults> {
        let leg = Leg::along(mechanism, coordinate);
        let Some(end) = leg.place(mechanism, coordinate, values) else { return Err(Faults::default()) };
        // Whatever is beyond such a place is not reached either.
        let is_beyond = |(other, halt): &&(usize, Halt)| {
            *other == coordinate && end.abs() >= halt.place.abs() && end.signum() == halt.end.signum()
        };
        if let Some((_, halt)) = self.ended.iter().find(is_beyond) {
            let halt = Halt { end, ..halt.clone() };
            return Err(way_fault(mechanism, &leg, &halt, values).into());
        }
        let mut start = (0.0, &self.drawing, 0);
        for state in &self.reached {
            let place = leg.place(mechanism, coordinate, &state.coordinates);
            if let Some(place) = place.filter(|place| (place - end).abs() < (start.0 - end).abs()) {
                start = (place, &state.poses, state.steps);
            }
        }
        let (place, poses, mut before) = start;
        let mut way = |place: f64, poses: &[Pose]| {
            follow((mechanism, &leg), (place, poses.to_vec()), (end, values), proceed)
        };
        let mut found = way(place, poses);
        // How near a fold is approached depends on the steps: the way from the drawing decides, for all
        // values alike.
        if place != 0.0 && found.as_ref().is_err_and(|halt| !halt.is_effort()) {
            (found, before) = (way(0.0, &self.drawing), 0);
        }
        match found {
            Ok(last) => Ok(Line {
                steps: before + last.steps,
                values: values.to_vec(),
                coordinate: Some(coordinate),
                leg,
                end,
                last,
            }),
            Err(halt) => {
                let fault = way_fault(mechanism, &leg, &halt, values);
                if !halt.is_effort() {
                    self.ended.push((coordinate, halt));
                }
                Err(fault.into())
            }
        }
    }

    /// Follows the straight way from the drawing, with a neighbourhood if that can be shown.
    fn straight(
        &self,
        mechanism: &Mechanism,
        values: &[f64],
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Line, Faults> {
        let coordinates = 0..values.len();
        let alone = vec![0.0; values.len()];
        let neighbourhood = self.reached.first().map(|last| {
            let far =
                |index: usize| (values[index] - last.coordinates[index]).abs() / scale(mechanism, index);
            coordinates.map(|index| (NEIGHBOURS * far(index)).min(WIDEST)).collect()
        });
        let mut fault = None;
        for spread in neighbourhood.into_iter().chain([alone]) {
            let (leg, end) = Leg::to(mechanism, values, spread);
            match follow((mechanism, &leg), (0.0, self.drawing.clone()), (end, values), proceed) {
                Ok(last) => {
                    let (steps, values) = (last.steps, values.to_vec());
                    return Ok(Line { leg, coordinate: None, last, end, values, steps });
                }
                Err(halt) => fault = Some((leg, halt)),
            }
        }
        Err(fault
            .map_or_else(Faults::default, |(leg, halt)| way_fault(mechanism, &leg, &halt, values).into()))
    }
}

impl Line {
    /// The place of values for which the last step is shown.
    fn place(&self, mechanism: &Mechanism, values: &[f64]) -> Option<f64> {
        match self.coordinate {
            Some(coordinate) => self.leg.place(mechanism, coordinate, values),
            None => self.leg.is_beside(mechanism, &self.values, values).then_some(self.end),
        }
    }

    /// The positions at values for which the last step is shown, and the steps to them.
    fn settled(
        &self,
        mechanism: &Mechanism,
        values: &[f64],
        reached: &[Configuration],
    ) -> Option<(Settled, usize)> {
        let place = self.place(mechanism, values)?;
        let predicted = self.last.predicted(mechanism, place)?;
        let starts = [extrapolated(values, reached), Some(predicted)];
        let settled = |start: Vec<Pose>| settle(mechanism, &self.leg, (place, values), start);
        let is_it = |settled: &Settled| self.last.holds(place, &settled.poses);
        let found = starts.into_iter().flatten().find_map(|start| settled(start).filter(is_it))?;
        Some((found, self.steps))
    }
}

/// The parabola through three evenly spaced states.
fn extrapolated(coordinates: &[f64], earlier: &[Configuration]) -> Option<Vec<Pose>> {
    let [first, second, third, ..] = earlier else { return None };
    let even = (0..coordinates.len()).all(|index| {
        let steps = [
            coordinates[index] - first.coordinates[index],
            first.coordinates[index] - second.coordinates[index],
            second.coordinates[index] - third.coordinates[index],
        ];
        let tolerance = EVEN * steps[0].abs();
        (steps[0] - steps[1]).abs() <= tolerance && (steps[1] - steps[2]).abs() <= tolerance
    });
    if !even {
        return None;
    }
    let extrapolated = |one: f64, two: f64, three: f64| 3.0 * (one - two) + three;
    let poses = first.poses.iter().zip(&second.poses).zip(&third.poses);
    let pose = |((one, two), three): ((&Pose, &Pose), &Pose)| {
        Pose::new(
            one.position.zip_zip_map(&two.position, &three.position, extrapolated),
            extrapolated(one.angle, two.angle, three.angle),
        )
    };
    Some(poses.map(pose).collect())
}

/// Velocities of all bodies: J v = 0 in the rows of the joints, and the rates in those of the coordinates.
///
/// The factors may be those before a last Newton step of `|J^-1| 1e-12`, which near a dead centre is felt in
/// velocities. One step of refinement with J at the positions themselves squares that error,
/// `(|J^-1|^2 1e-12)^2`: less than what rounded positions do (`|J^-1|^2 1e-16`) wherever such factors are
/// taken.
fn velocities(mechanism: &Mechanism, settled: &Settled, values: &[f64]) -> Option<Vec<Velocity>> {
    let rows = 3 * mechanism.bodies.len();
    let first = rows - mechanism.coordinates.len();
    let mut wanted = DVector::zeros(rows);
    for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
        wanted[first + index] = coordinate.rate / scale(mechanism, index);
    }
    let jacobian = JointEquations::with_coordinates(mechanism, &settled.poses, values).jacobian;
    let mut rates = settled.factors.solution(&wanted)?;
    rates += settled.factors.solution(&(&wanted - jacobian * &rates))?;
    let of = |body: usize| Velocity {
        linear: Vector2::new(rates[3 * body], rates[3 * body + 1]) * mechanism.size,
        angular: rates[3 * body + 2],
    };
    Some((0..mechanism.bodies.len()).map(of).collect())
}

/// All numbers on which the joint equations depend.
fn linkage(mechanism: &Mechanism) -> Vec<f64> {
    let joints = mechanism.joints.len() + mechanism.coordinates.len();
    let mut numbers = Vec::with_capacity(1 + 2 * mechanism.bodies.len() + 7 * joints);
    numbers.push(mechanism.size);
    let frame = |frame: Frame| frame.body().map_or(-1.0, |body| body.index() as f64);
    let attachment = |point: &Attachment| [frame(point.frame), point.position.x, point.position.y];
    for body in &mechanism.bodies {
        numbers.extend([body.centre_of_mass.x, body.centre_of_mass.y]);
    }
    for joint in &mechanism.joints {
        match &joint.kind {
            JointKind::Hinge([first, second]) => {
                numbers.push(-1.0);
                numbers.extend(attachment(first));
                numbers.extend(attachment(second));
            }
            JointKind::Slider(slider) => {
                let is = |so: bool| f64::from(u8::from(so));
                numbers.extend([is(slider.kind == SliderKind::Pin), is(slider.sticks)]);
                numbers.extend([frame(slider.block), frame(slider.guide)]);
                numbers.extend([slider.at.x, slider.at.y, slider.tangent.x, slider.tangent.y]);
                numbers.push(slider.contacts.len() as f64);
                numbers.extend(slider.round.iter().flat_map(|round| round.centre));
                if slider.sticks {
                    numbers.push(slider.height);
                    numbers.extend(slider.round.iter().map(|round| round.radius));
                }
            }
        }
    }
    for coordinate in &mechanism.coordinates {
        numbers.push(coordinate.drawn_at);
        match &coordinate.kind {
            CoordinateKind::Slide(joint) => numbers.extend([-1.0, joint.index() as f64]),
            CoordinateKind::Rotation(body, against) => {
                numbers.extend([-2.0, body.index() as f64, frame(*against)]);
            }
            CoordinateKind::Displacement(point, axis) => {
                numbers.push(-3.0);
                numbers.extend(attachment(point));
                numbers.extend([axis.x, axis.y]);
            }
        }
    }
    numbers
}
