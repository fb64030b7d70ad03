//! Newton's method on the joint equations, led from the drawing to the wanted coordinates in small steps.

use super::joint_equations::JointEquations;
use super::mobility::{
    Mobility, RANK_TOLERANCE, advance, least_squares, null_space_within, rank, regularity,
};
use super::{Configuration, Pose, Velocity, drawing_poses, unit};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{Frame, JointId};
use crate::mechanism::{JointKind, Mechanism};
use nalgebra::{DVector, Vector2};

/// Residuals (in sizes of the mechanism, or rad) that count as closed.
pub(super) const CLOSED: f64 = 1e-12;
/// Where two solutions meet Newton's method finds the place only to the root of its tolerance. A state counts as
/// singular if its joint equations, coordinates included, have a singular value below this multiple of the
/// greatest...
const SINGULAR_STATE: f64 = 5e-6;
/// ... and if that multiple is below this part of what it is in the drawing. (It is small everywhere where a short
/// body turns in a large mechanism.)
const SINGULAR_LOSS: f64 = 1e-3;
/// Newton steps after which a stage of the way counts as failed; quadratic convergence needs far fewer.
const NEWTON_STEPS: usize = 25;
/// Largest change of a coordinate in one stage, in sizes of the mechanism or rad.
pub(super) const STAGE: f64 = 0.15;
/// Longest way that is followed from the drawing, in sizes of the mechanism or rad.
const LONGEST_WAY: f64 = 300.0;
/// Least fraction of the whole way that is tried before the state counts as out of reach.
const LEAST_STAGE: f64 = 1e-4;

/// The configuration at the mechanism's coordinate values and rates.
pub(super) fn assemble(mechanism: &Mechanism) -> Result<Configuration, Faults> {
    let drawing = Configuration::drawing(mechanism);
    let mobility = Mobility::of(mechanism, &drawing);
    let moves = mechanism.coordinates.iter().any(|coordinate| coordinate.value != coordinate.drawn_at);
    if let Some(kind) = mobility.fault(mechanism)
        && !(moves && matches!(kind, FaultKind::SingularPosition { .. }))
    {
        return Err(redundancy_fault(mechanism, &mobility, kind).into());
    }
    check_coordinate_count(mechanism, &mobility, &drawing)?;
    let values: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.value).collect();
    let poses = reach(mechanism, &values)?;
    let configuration = Configuration {
        velocities: velocities(mechanism, &poses)?,
        poses,
        coordinates: values,
        rates: mechanism.coordinates.iter().map(|coordinate| coordinate.rate).collect(),
        time: mechanism.time,
        pieces: None,
    };
    check_position(mechanism, &configuration)?;
    Ok(configuration)
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
    let degrees_of_freedom = mobility.body_coordinates - mobility.constraints.min(mobility.body_coordinates);
    if degrees_of_freedom == 0 {
        return Err(Fault::general(FaultKind::NoFreedom).into());
    }
    let chosen = mechanism.coordinates.len();
    if chosen == degrees_of_freedom {
        return Ok(());
    }
    let values: Vec<f64> = drawing.coordinates.clone();
    let equations = JointEquations::with_coordinates(mechanism, &drawing.poses, &values);
    let undetermined = moving_bodies(mechanism, &equations);
    let kind = FaultKind::CoordinateCount { degrees_of_freedom, chosen, undetermined };
    Err(match mechanism.coordinates.last() {
        Some(last) if chosen > degrees_of_freedom => Fault::new(kind, last.place.clone()).into(),
        _ => Fault::general(kind).into(),
    })
}

/// The bodies that move while all rows of the equations stay satisfied.
fn moving_bodies(mechanism: &Mechanism, equations: &JointEquations) -> Vec<String> {
    let motions = null_space_within(&equations.jacobian, SINGULAR_STATE);
    let moves = |body: usize| motions.ncols() > 0 && motions.rows(3 * body, 3).amax() > 1e-6;
    let bodies = mechanism.bodies.iter().enumerate();
    bodies.filter(|(index, _)| moves(*index)).map(|(_, body)| body.name.to_string()).collect()
}

/// The poses at the wanted coordinate values, on the assembly branch of the drawing.
fn reach(mechanism: &Mechanism, values: &[f64]) -> Result<Vec<Pose>, Faults> {
    let drawn: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.drawn_at).collect();
    let at = |fraction: f64| -> Vec<f64> {
        drawn.iter().zip(values).map(|(from, to)| from + fraction * (to - from)).collect()
    };
    let mut poses = newton(mechanism, drawing_poses(mechanism), &drawn)
        .map_err(|poses| not_assembled(mechanism, &poses, &drawn, None))?;
    let mut done = 0.0;
    let way = longest_way(mechanism, values);
    if way > LONGEST_WAY {
        return Err(Fault::general(FaultKind::TooFar {
            state: state(mechanism, values),
            limit: LONGEST_WAY,
        })
        .into());
    }
    let mut stage = (STAGE / way).min(1.0);
    while done < 1.0 {
        let next = if done + 1.01 * stage >= 1.0 { 1.0 } else { done + stage };
        let wanted = if next == 1.0 { values.to_vec() } else { at(next) };
        match newton(mechanism, poses.clone(), &wanted) {
            Ok(reached) => {
                poses = reached;
                done = next;
            }
            Err(_) if stage > LEAST_STAGE => stage /= 2.0,
            Err(_) => return Err(not_assembled(mechanism, &poses, values, Some(&at(done))).into()),
        }
    }
    Ok(poses)
}

/// The greatest change of a coordinate, in sizes of the mechanism or rad.
fn longest_way(mechanism: &Mechanism, values: &[f64]) -> f64 {
    let way = |(coordinate, value): (&crate::mechanism::Coordinate, &f64)| {
        let scale = if coordinate.kind.is_angle() { 1.0 } else { mechanism.size };
        (value - coordinate.drawn_at).abs() / scale
    };
    mechanism.coordinates.iter().zip(values).map(way).fold(1e-9, f64::max)
}

/// Poses that satisfy the joints and the coordinate values, from nearby ones; the last ones tried if there are
/// none near enough.
fn newton(mechanism: &Mechanism, mut poses: Vec<Pose>, values: &[f64]) -> Result<Vec<Pose>, Vec<Pose>> {
    let mut polished = false;
    for _ in 0..NEWTON_STEPS {
        let equations = JointEquations::with_coordinates(mechanism, &poses, values);
        let residual = equations.residual.amax();
        if residual == 0.0 || (residual < CLOSED && polished) {
            return Ok(poses);
        }
        // One step beyond the tolerance brings the residual to rounding.
        polished = residual < CLOSED;
        let Some(step) = equations.jacobian.lu().solve(&-equations.residual) else { return Err(poses) };
        // A long step would leave the branch of the drawing.
        if !step.iter().all(|s| s.abs() < 1.0) {
            return Err(poses);
        }
        advance(mechanism, &mut poses, &step);
    }
    Err(poses)
}

/// Says which joint stays most open where the joints come closest to closing.
fn not_assembled(mechanism: &Mechanism, poses: &[Pose], values: &[f64], reached: Option<&[f64]>) -> Fault {
    let mut poses = poses.to_vec();
    for _ in 0..100 {
        let equations = JointEquations::with_coordinates(mechanism, &poses, values);
        let step = least_squares(&equations.jacobian, &-equations.residual);
        let damping = (0.2 / step.amax().max(1e-300)).min(1.0);
        advance(mechanism, &mut poses, &(step * damping));
    }
    let equations = JointEquations::with_coordinates(mechanism, &poses, values);
    let open = (0..equations.joints.len())
        .filter_map(|row| equations.joints[row].map(|joint| (joint, row)))
        .max_by(|a, b| equations.residual[a.1].abs().total_cmp(&equations.residual[b.1].abs()));
    let Some((joint, row)) = open else { return Fault::general(FaultKind::NoFreedom) };
    let is_angle = row > 0 && equations.joints[row - 1] == Some(joint) && is_slider(mechanism, joint);
    let residual = equations.residual[row].abs();
    let gap = if is_angle { in_units(residual, "rad") } else { in_units(residual * mechanism.size, "m") };
    let kind = FaultKind::NotAssembled {
        joint: mechanism.joints[joint.index()].name.to_string(),
        loop_joints: loop_of(mechanism, joint),
        gap,
        reached: reached.map(|values| state(mechanism, values)),
    };
    Fault::new(kind, mechanism.joints[joint.index()].place.clone())
}

fn in_units(value: f64, unit: &str) -> String {
    if value < 1e-3 { format!("{value:.2e} {unit}") } else { format!("{value:.4} {unit}") }
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

fn is_slider(mechanism: &Mechanism, joint: JointId) -> bool {
    matches!(mechanism.joints[joint.index()].kind, JointKind::Slider(_))
}

/// Coordinate values in words.
fn state(mechanism: &Mechanism, values: &[f64]) -> String {
    let one = |(coordinate, value): (&crate::mechanism::Coordinate, &f64)| {
        let degrees = if coordinate.kind.is_angle() {
            format!(" ({:.2} deg)", value.to_degrees())
        } else {
            String::new()
        };
        format!("{} = {value:.5} {}{degrees}", coordinate.name, unit(&coordinate.kind))
    };
    let list: Vec<String> = mechanism.coordinates.iter().zip(values).map(one).collect();
    list.join(", ")
}

/// Velocities of all bodies: G v = 0 and the rates of the coordinates.
fn velocities(mechanism: &Mechanism, poses: &[Pose]) -> Result<Vec<Velocity>, Faults> {
    let values: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.value).collect();
    let equations = JointEquations::with_coordinates(mechanism, poses, &values);
    let rows = equations.joints.len();
    let joint_rows = rows - mechanism.coordinates.len();
    let singular = rank(&equations.jacobian, SINGULAR_STATE) < rows && {
        let drawn: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.drawn_at).collect();
        let drawing = JointEquations::with_coordinates(mechanism, &drawing_poses(mechanism), &drawn);
        let (here, there) = (regularity(&equations.jacobian), regularity(&drawing.jacobian));
        here <= RANK_TOLERANCE || here < SINGULAR_LOSS * there
    };
    if singular {
        return Err(singular_coordinates(mechanism, poses, &equations).into());
    }
    let mut rates = DVector::zeros(rows);
    for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
        let scale = if coordinate.kind.is_angle() { 1.0 } else { mechanism.size };
        rates[joint_rows + index] = coordinate.rate / scale;
    }
    let Some(solution) = equations.jacobian.clone().lu().solve(&rates) else {
        return Err(singular_coordinates(mechanism, poses, &equations).into());
    };
    Ok((0..mechanism.bodies.len())
        .map(|body| Velocity {
            linear: Vector2::new(solution[3 * body], solution[3 * body + 1]) * mechanism.size,
            angular: solution[3 * body + 2],
        })
        .collect())
}

/// Either the joints themselves have lost rank here, or only the chosen coordinates are at a dead centre.
fn singular_coordinates(mechanism: &Mechanism, poses: &[Pose], equations: &JointEquations) -> Fault {
    let mut here = Configuration::drawing(mechanism);
    here.poses = poses.to_vec();
    let mobility = Mobility::within(mechanism, &here, SINGULAR_STATE);
    if let Some(kind) = mobility.fault(mechanism) {
        return redundancy_fault(mechanism, &mobility, kind);
    }
    let bodies = moving_bodies(mechanism, equations);
    // The first coordinate that says nothing new.
    let joint_rows = equations.joints.len() - mechanism.coordinates.len();
    let dependent = (0..mechanism.coordinates.len()).find(|index| {
        let rows = joint_rows + index + 1;
        rank(&equations.jacobian.rows(0, rows).into_owned(), SINGULAR_STATE) < rows
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
    for joint in &mechanism.joints {
        let JointKind::Slider(slider) = &joint.kind else { continue };
        let displacement = configuration.slide(mechanism, slider).displacement;
        if let Some(overlap) = configuration.overlap(mechanism, slider)
            && overlap <= 1e-9 * slider.length
        {
            let kind = FaultKind::OverlapVanished { joint: joint.name.to_string(), overlap, displacement };
            faults.push(Fault::new(kind, joint.place.clone()));
        }
        if let Some([least, greatest]) = slider.travel
            && !(least..=greatest).contains(&displacement)
        {
            let kind =
                FaultKind::TravelExceeded { joint: joint.name.to_string(), displacement, least, greatest };
            faults.push(Fault::new(kind, joint.place.clone()));
        }
    }
    faults.or(())
}
