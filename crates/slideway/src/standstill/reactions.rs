//! Ranges of the reactions in a state, each end from a linear program.

use super::report::{ContactRange, DriveRange, HingeRange, Range, Reactions};
use super::setup::Setup;
use super::state::State;
use crate::ids::{DriveId, JointId};
use crate::kinetics::Reaction;
use crate::mechanism::{Effort, FrictionCircle, Mechanism};
use crate::pattern::{AffineExpression, GuidedCouple, Region, Unsolved};

/// The range of an expression in a region of a state, in this unit.
pub(super) fn range(
    state: &State<'_>,
    region: &Region<'_>,
    expression: &AffineExpression,
    unit: f64,
) -> Result<Range, Unsolved> {
    let ends = region.extent(&state.function(expression))?;
    Ok(told(ends, unit))
}

/// The ranges of an expression in a region that friction circles may divide, in this unit.
pub(super) fn ranges(
    state: &State<'_>,
    region: &Region<'_>,
    expression: &AffineExpression,
    unit: f64,
) -> Result<Vec<Range>, Unsolved> {
    let extents = region.extents(&state.function(expression))?;
    Ok(extents.into_iter().map(|ends| told(ends, unit)).collect())
}

/// A range in a unit: many reactions vanish but for rounding.
fn told(ends: [Option<f64>; 2], unit: f64) -> Range {
    let [least, greatest] = ends.map(|end| end.map(State::without_rounding));
    Range { least, greatest }.times(unit)
}

/// The ranges of all reactions in a region of a state; unsolved if its work is to end.
pub(super) fn reactions(
    setup: &Setup,
    state: &State<'_>,
    region: &Region<'_>,
) -> Result<Reactions, Unsolved> {
    let Mechanism { contacts, joints, drives, .. } = &setup.mechanism;
    let all = contacts.len() + joints.len() + drives.len();
    let mut begun = 0;
    let mut begin = || {
        begun += 1;
        region.work().piece("reactions", begun - 1, all).continue_value().map(drop).ok_or(Unsolved)
    };
    let mut reactions = Reactions { contacts: Vec::new(), hinges: Vec::new(), drives: Vec::new() };
    for k in 0..contacts.len() {
        begin()?;
        reactions.contacts.push(contact(setup, state, region, k)?);
    }
    for joint in (0..joints.len()).map(JointId) {
        begin()?;
        reactions.hinges.extend(hinge(setup, joint, state, region).transpose()?);
    }
    for drive_id in (0..drives.len()).map(DriveId) {
        begin()?;
        reactions.drives.push(drive(setup, drive_id, state, region)?);
    }
    Ok(reactions)
}

fn contact(
    setup: &Setup,
    state: &State<'_>,
    region: &Region<'_>,
    k: usize,
) -> Result<ContactRange, Unsolved> {
    let unit = setup.units.force;
    let slider = setup.sliders.iter().find(|slider| slider.contacts.contains(&k));
    let couple = match slider.and_then(|slider| slider.couple) {
        Some(GuidedCouple { unknown, .. }) => {
            Some(range(state, region, &state.reaction(unknown), state.force_unit(unknown))?)
        }
        None => None,
    };
    Ok(ContactRange {
        name: setup.mechanism.contacts[k].name.to_string(),
        normal_force: range(state, region, &state.normal_force(k), unit)?,
        normal_force_parts: Vec::new(),
        friction_force: range(state, region, &friction_force(setup, state, k), unit)?,
        couple,
    })
}

/// The friction of a contact; of a round end that of both of its contacts, at the one along n. What is counted of a friction
/// circle acts on the block along u.
fn friction_force(setup: &Setup, state: &State<'_>, k: usize) -> AffineExpression {
    let circles = &setup.mechanism.friction_circles;
    let of_end = |circle: &FrictionCircle| circle.end.is_some_and(|[along_n, _]| along_n.index() == k);
    match circles.iter().position(of_end) {
        Some(circle) => state.friction_couple(circle).times(-1.0),
        None => state.friction_force(k),
    }
}

/// On ground the force is of no interest: it is counted on the body then.
fn hinge(
    setup: &Setup,
    id: JointId,
    state: &State<'_>,
    region: &Region<'_>,
) -> Option<Result<HingeRange, Unsolved>> {
    let ends = setup.mechanism.hinge(id)?;
    let on_first = ends[0].frame.body().is_some();
    let component = |axis| {
        let place = setup.assembled.layout.reaction(Reaction::Hinge(id, axis));
        let place = place.expect("every hinge has its reactions");
        let range = range(state, region, &state.reaction(place), setup.units.force)?;
        Ok(if on_first { range } else { range.negated() })
    };
    let on = if on_first { ends[0].frame } else { ends[1].frame };
    let both = component(0).and_then(|x| Ok([x, component(1)?]));
    let couple = friction_couple(setup, id, state, region);
    Some(both.and_then(|force| {
        Ok(HingeRange {
            name: setup.mechanism.joints[id.index()].name.to_string(),
            on: setup.mechanism.frame_name(on).to_owned(),
            force,
            couple: couple?.map(|range| if on_first { range } else { range.negated() }),
        })
    }))
}

/// The couple of friction of a hinge that has some, and of its collar, on its first body.
fn friction_couple(
    setup: &Setup,
    hinge: JointId,
    state: &State<'_>,
    region: &Region<'_>,
) -> Result<Option<Range>, Unsolved> {
    let circles = setup.mechanism.friction_circles.iter().enumerate();
    let own =
        circles.filter(|(_, circle)| circle.joint == hinge).map(|(circle, _)| state.friction_couple(circle));
    let unit = setup.units.force * setup.units.length;
    let whole = own.reduce(|sum, couple| sum.plus(1.0, &couple));
    whole.map(|couple| range(state, region, &couple, unit)).transpose()
}

fn drive(setup: &Setup, id: DriveId, state: &State<'_>, region: &Region<'_>) -> Result<DriveRange, Unsolved> {
    let drive = &setup.mechanism.drives[id.index()];
    let unit = state.force_unit(setup.assembled.layout.effort(id));
    Ok(DriveRange {
        name: drive.name.to_string(),
        unit: if matches!(drive.effort, Effort::Force { .. }) { "N" } else { "N m" },
        effort: range(state, region, &state.effort(id), unit)?,
    })
}
