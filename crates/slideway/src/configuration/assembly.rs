//! The closed drawing, and why a drawing or a state beyond it cannot be had.

use super::anchor::Anchor;
use super::following::{Halt, follow};
use super::joint_equations::JointEquations;
use super::leg::{Leg, drawn};
use super::mobility::{
    Mobility, RANK_TOLERANCE, advance, least_squares, null_space_within, rank, regularity,
};
use super::{Configuration, Pose, drawing_poses, unit};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{Frame, JointId};
use crate::mechanism::{Joint, JointKind, Mechanism, Slider};

/// Residuals (in sizes of the mechanism, or rad) that count as closed.
const CLOSED: f64 = 1e-12;
/// Motions count as free at a singular position if their singular values are below this multiple of the least
/// one ...
const FREE: f64 = 10.0;
/// ... and this multiple of the greatest one, where everything else is.
const LEAST: f64 = 1e-12;
/// A displacement is at an end of its travel up to this part of the mechanism's size, since positions are closed
/// only up to rounding; an overlap has vanished below this part of the slider's length.
const AT_END: f64 = 1e-9;

/// The poses of the drawing with its joints closed: residuals are led to zero along a straight way. A fault once `proceed`
/// is `false`.
pub(super) fn closed_drawing(
    mechanism: &Mechanism,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Vec<Pose>, Faults> {
    let (poses, values) = (drawing_poses(mechanism), drawn(mechanism));
    let equations = JointEquations::with_coordinates(mechanism, &poses, &values);
    if !equations.jacobian.is_square() || values.is_empty() {
        return Err(drawing_fault(mechanism, &poses));
    }
    let leg = Leg::closing(mechanism, equations.residual);
    match follow((mechanism, &leg), (0.0, poses), (1.0, &values), proceed) {
        Ok(arrival) => {
            check_excess(mechanism, &arrival.settled.poses)?;
            Ok(arrival.settled.poses)
        }
        Err(halt) if halt.is_ended => Err(Fault::general(FaultKind::WorkEnded).into()),
        Err(halt) => Err(drawing_fault(mechanism, &halt.poses)),
    }
}

/// Whether the joint equations that were left out follow from the others, here and in a neighbouring position,
/// and whether something gives way to what they say.
fn check_excess(mechanism: &Mechanism, poses: &[Pose]) -> Result<(), Faults> {
    if mechanism.excess.is_empty() {
        return mechanism.check_carried_once();
    }
    let mut drawing = Configuration::drawing(mechanism);
    drawing.poses = poses.to_vec();
    let mobility = Mobility::of(mechanism, &drawing);
    let equations = JointEquations::of_joints(mechanism, poses);
    if mechanism.excess.of_hinges > 0 || mobility.redundancy.as_ref().is_some_and(|excess| excess.only_here) {
        let kind = mobility.fault_without_sharing(mechanism);
        return match kind {
            Some(kind) => Err(redundancy_fault(mechanism, &mobility, kind).into()),
            None => mechanism.check_carried_once(),
        };
    }
    match widest_gap(&equations).filter(|gap| gap.relative > AT_END) {
        None => Ok(()),
        Some(gap) => {
            let joint = &mechanism.joints[gap.joint.index()];
            let kind =
                FaultKind::GuidesDoNotFit { joint: joint.name.to_string(), gap: gap.in_words(mechanism) };
            Err(Fault::new(kind, joint.place.clone()).into())
        }
    }
}

/// Why the joints of the drawing determine no regular state.
fn drawing_fault(mechanism: &Mechanism, poses: &[Pose]) -> Faults {
    let drawing = Configuration::drawing(mechanism);
    let mobility = Mobility::of(mechanism, &drawing);
    if let Some(kind) = mobility.fault(mechanism) {
        return redundancy_fault(mechanism, &mobility, kind).into();
    }
    if let Err(faults) = check_coordinate_count(mechanism, &mobility, &drawing) {
        return faults;
    }
    let closest = closest(mechanism, poses, &drawing.coordinates);
    match open_joint(mechanism, &closest, &drawing.coordinates, None) {
        Some(fault) => fault.into(),
        None => singular_state(mechanism, &closest).into(),
    }
}

/// Why these values are not reached from where a way has ended.
pub(super) fn way_fault(mechanism: &Mechanism, leg: &Leg, halt: &Halt, values: &[f64]) -> Fault {
    if halt.is_ended {
        return Fault::general(FaultKind::WorkEnded);
    }
    let reached = leg.values(halt.place);
    let [wanted, reached_in_words] = [values, &reached].map(|values| state(mechanism, values));
    if halt.is_effort() {
        let (state, reached) = (wanted, reached_in_words);
        return Fault::general(FaultKind::TooFar { state, reached, steps: halt.steps });
    }
    let closest = closest(mechanism, &halt.poses, values);
    if let Some(fault) = open_joint(mechanism, &closest, values, Some(&reached)) {
        return fault;
    }
    let anchor = Anchor::new((mechanism, leg), halt.end, closest.clone(), &mut || true);
    if anchor.and_then(|anchor| anchor.tube(0.0)).is_none() {
        return singular_state(mechanism, &closest);
    }
    Fault::general(FaultKind::NotFollowed { state: wanted, reached: reached_in_words, steps: halt.steps })
}

fn redundancy_fault(mechanism: &Mechanism, mobility: &Mobility, kind: FaultKind) -> Fault {
    let first = mobility.redundancy.as_ref().and_then(|redundancy| redundancy.joints.first());
    match first {
        Some(joint) => Fault::new(kind, mechanism.joints[joint.index()].place.clone()),
        None => Fault::general(kind),
    }
}

fn check_coordinate_count(
    mechanism: &Mechanism,
    mobility: &Mobility,
    drawing: &Configuration,
) -> Result<(), Faults> {
    let determined = mobility.constraints - mechanism.excess.rows.len();
    let degrees_of_freedom = mobility.body_coordinates - determined.min(mobility.body_coordinates);
    if degrees_of_freedom == 0 {
        return Err(Fault::general(FaultKind::NoFreedom { may_open: mechanism.has_one_sided() }).into());
    }
    let chosen = mechanism.coordinates.len();
    if chosen == degrees_of_freedom {
        return Ok(());
    }
    let values: Vec<f64> = drawing.coordinates.clone();
    let equations = JointEquations::with_coordinates(mechanism, &drawing.poses, &values);
    let undetermined = moving_bodies(mechanism, &equations, RANK_TOLERANCE);
    let kind = FaultKind::CoordinateCount { degrees_of_freedom, chosen, undetermined };
    Err(match mechanism.coordinates.last() {
        Some(last) if chosen > degrees_of_freedom => Fault::new(kind, last.place.clone()).into(),
        _ => Fault::general(kind).into(),
    })
}

/// The bodies that move while all rows of the equations stay satisfied.
fn moving_bodies(mechanism: &Mechanism, equations: &JointEquations, tolerance: f64) -> Vec<String> {
    let motions = null_space_within(&equations.jacobian, tolerance);
    let moves = |body: usize| motions.ncols() > 0 && motions.rows(3 * body, 3).amax() > 1e-6;
    let bodies = mechanism.bodies.iter().enumerate();
    bodies.filter(|(index, _)| moves(*index)).map(|(_, body)| body.name.to_string()).collect()
}

/// Where the joints come closest to closing at these values of the coordinates.
fn closest(mechanism: &Mechanism, poses: &[Pose], values: &[f64]) -> Vec<Pose> {
    let mut poses = poses.to_vec();
    for _ in 0..100 {
        let equations = JointEquations::with_coordinates(mechanism, &poses, values);
        let step = least_squares(&equations.jacobian, &-equations.residual);
        if !step.iter().all(|part| part.is_finite()) {
            break;
        }
        let damping = (0.2 / step.amax().max(1e-300)).min(1.0);
        advance(mechanism, &mut poses, &(step * damping));
    }
    poses
}

/// Says which joint stays most open, if one does.
fn open_joint(
    mechanism: &Mechanism,
    poses: &[Pose],
    values: &[f64],
    reached: Option<&[f64]>,
) -> Option<Fault> {
    let equations = JointEquations::with_coordinates(mechanism, poses, values);
    if equations.residual.amax() <= CLOSED {
        return None;
    }
    let gap = widest_gap(&equations)?;
    let joint = &mechanism.joints[gap.joint.index()];
    let kind = FaultKind::NotAssembled {
        joint: joint.name.to_string(),
        loop_joints: loop_of(mechanism, gap.joint),
        gap: gap.in_words(mechanism),
        reached: reached.map(|values| state(mechanism, values)),
    };
    Some(Fault::new(kind, joint.place.clone()))
}

/// How far a joint is open.
pub(crate) struct Gap {
    pub(crate) joint: JointId,
    /// In sizes of the mechanism, or rad.
    pub(crate) relative: f64,
    is_angle: bool,
}

impl Gap {
    /// With its unit: "12.5 mm".
    pub(crate) fn in_words(&self, mechanism: &Mechanism) -> String {
        let (value, si) =
            if self.is_angle { (self.relative, "rad") } else { (self.relative * mechanism.size, "m") };
        mechanism.units.of(si).show(value)
    }
}

/// The joint that is most open where the drawing has the bodies.
pub(crate) fn widest_gap_of_drawing(mechanism: &Mechanism) -> Option<Gap> {
    let (poses, values) = (drawing_poses(mechanism), drawn(mechanism));
    widest_gap(&JointEquations::with_coordinates(mechanism, &poses, &values))
}

fn widest_gap(equations: &JointEquations) -> Option<Gap> {
    let of_row = |row: usize| Some((equations.joints[row]?, equations.are_angles[row]));
    let rows = 0..equations.joints.len();
    // Both components of the distance between the points of a hinge make one gap.
    let gap = |row: usize| {
        let (joint, is_angle) = of_row(row)?;
        let same = rows.clone().filter(|&other| of_row(other) == Some((joint, is_angle)));
        let relative = same.map(|row| equations.residual[row]).fold(0.0, f64::hypot);
        Some(Gap { joint, relative, is_angle })
    };
    rows.clone().filter_map(gap).max_by(|one, other| one.relative.total_cmp(&other.relative))
}

/// The joints of a shortest loop through `joint`, that one first; none if it closes no loop.
fn loop_of(mechanism: &Mechanism, joint: JointId) -> Vec<String> {
    let joined = |index: usize| match &mechanism.joints[index].kind {
        JointKind::Hinge([first, second]) => [first.frame, second.frame],
        JointKind::Slider(slider) => [slider.block, slider.guide],
    };
    let [start, end] = joined(joint.index());
    let mut ways: Vec<(Frame, Vec<usize>)> = vec![(start, vec![joint.index()])];
    let mut next = 0;
    while let Some((frame, way)) = ways.get(next).cloned() {
        if frame == end {
            return way.iter().map(|&index| mechanism.joints[index].name.to_string()).collect();
        }
        for index in (0..mechanism.joints.len()).filter(|index| !way.contains(index)) {
            let [first, second] = joined(index);
            for (from, to) in [(first, second), (second, first)] {
                if from == frame && ways.iter().all(|(reached, _)| *reached != to) {
                    ways.push((to, [way.as_slice(), &[index]].concat()));
                }
            }
        }
        next += 1;
    }
    Vec::new()
}

/// Coordinate values in words.
fn state(mechanism: &Mechanism, values: &[f64]) -> String {
    let one = |(coordinate, value): (&crate::mechanism::Coordinate, &f64)| {
        format!("{} = {}", coordinate.name, mechanism.units.of(unit(&coordinate.kind)).precise(*value))
    };
    let list: Vec<String> = mechanism.coordinates.iter().zip(values).map(one).collect();
    list.join(", ")
}

/// Either the joints themselves have lost rank here, or only the chosen coordinates are at a dead centre.
pub(super) fn singular_state(mechanism: &Mechanism, poses: &[Pose]) -> Fault {
    let mut here = Configuration::drawing(mechanism);
    here.poses = poses.to_vec();
    let equations = JointEquations::with_coordinates(mechanism, poses, &here.coordinates);
    let free = FREE * regularity(&equations.jacobian).max(LEAST);
    let mobility = Mobility::within(mechanism, &here, free);
    if let Some(kind) = mobility.fault(mechanism) {
        return redundancy_fault(mechanism, &mobility, kind);
    }
    let bodies = moving_bodies(mechanism, &equations, free);
    // The first coordinate that says nothing new.
    let joint_rows = equations.joints.len() - mechanism.coordinates.len();
    let dependent = (0..mechanism.coordinates.len()).find(|index| {
        let rows = joint_rows + index + 1;
        rank(&equations.jacobian.rows(0, rows).into_owned(), free) < rows
    });
    let kind = FaultKind::DependentCoordinates { bodies };
    match dependent {
        Some(index) => Fault::new(kind, mechanism.coordinates[index].place.clone()),
        None => Fault::general(kind),
    }
}

/// Travel limits and overlaps of the sliding joints.
pub(super) fn check_position(mechanism: &Mechanism, configuration: &Configuration) -> Result<(), Faults> {
    let mut faults = Faults::default();
    let length = || mechanism.units.of("m");
    for joint in &mechanism.joints {
        let JointKind::Slider(slider) = &joint.kind else { continue };
        let place = &joint.place;
        let displacement = configuration.slide(mechanism, slider).displacement;
        if let Some(overlap) = configuration.overlap(mechanism, slider)
            && overlap <= AT_END * slider.length
        {
            let (joint, unit) = (joint.name.to_string(), length());
            let kind = FaultKind::OverlapVanished { joint, overlap, displacement, unit };
            faults.push(Fault::new(kind, place.clone()));
        }
        faults.extend(penetration(mechanism, configuration, (joint, slider)));
        if let Some([least, greatest]) = slider.travel
            && !configuration.is_within_travel(mechanism, slider)
        {
            let (joint, unit) = (joint.name.to_string(), length());
            let kind = FaultKind::TravelExceeded { joint, displacement, least, greatest, unit };
            faults.push(Fault::new(kind, place.clone()));
        }
    }
    faults.or(())
}

/// What is said to be apart from its face must not be in it, nor on it without leaving it, but beside it.
fn penetration(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (joint, slider): (&Joint, &Slider),
) -> Option<Fault> {
    let at_face = AT_END * mechanism.size;
    let apart = slider.apart.iter();
    let apart = apart.filter(|contact| !configuration.is_beside_face(mechanism, slider, contact));
    let gaps = apart.map(|contact| configuration.gap_at(mechanism, slider, contact));
    let [gap, rate] = gaps.min_by(|one, other| one[0].total_cmp(&other[0]))?;
    if gap > at_face || (gap >= -at_face && rate > 0.0) {
        return None;
    }
    let joint_name = joint.name.to_string();
    let kind = if gap < -at_face {
        let depth = mechanism.units.of("m").show(-gap);
        FaultKind::Penetration { joint: joint_name, depth }
    } else {
        FaultKind::TouchesThoughApart { joint: joint_name }
    };
    Some(Fault::new(kind, joint.place.clone()))
}
