//! How redundant guides share a load: play, elasticity and misalignment of the contacts in excess.
//!
//! [`Mechanism`] and its self-stresses in, [`SharedLoad`] out, which closes the cuts of the kinetic equations.
//! `2 delta` is the total play of a contact, `f = 1/k` the compliance of one of its faces, `e` the displacement
//! of the guide's line there. Where the model gives no stiffness, faces are rigid (`f = 0`) as soon as it gives
//! a play or a misalignment; without either only ratios of stiffnesses count, and they are taken to be equal.
//! The faces of a press fit share their load, too: the line of the guide is displaced for each by half of what
//! they overlap.

use crate::fault::{Fault, FaultKind, Faults};
use crate::interval::Real;
use crate::mechanism::{Contact, Mechanism, Slider};
use crate::modes::SharedLoad;
use crate::report::{Elasticity, LoadSharing, PressFit};
use nalgebra::{DMatrix, DVector};

/// Normal forces of a self-stress below this are rounding.
pub(crate) const NO_STRESS: f64 = 1e-13;

/// Returns a force of a self-stress, or zero where it is only rounding.
pub(crate) fn stress_force(force: f64) -> f64 {
    if force.abs() <= NO_STRESS { 0.0 } else { force }
}

/// How contacts share their load, given their self-stresses (a row for each contact, a column for each cut
/// one); none if nothing is in excess.
///
/// # Errors
/// Stiffnesses that are given for some of the contacts in excess only; rigid faces without play; press fits without
/// stiffness, of guided sliders, or with another preload at each face.
pub fn shared_load<T: Real>(
    mechanism: &Mechanism<T>,
    self_stress: DMatrix<T>,
) -> Result<Option<SharedLoad<T>>, Faults> {
    if mechanism.excess.is_empty() {
        return Ok(None);
    }
    let contacts = &mechanism.contacts;
    let vector =
        |value: &dyn Fn(&Contact<T>) -> T| DVector::from_iterator(contacts.len(), contacts.iter().map(value));
    let elasticity = elasticity(mechanism, &self_stress)?;
    let compliance = |contact: &Contact<T>| match (elasticity, contact.stiffness) {
        (Elasticity::Given, Some(stiffness)) => T::one() / stiffness,
        (Elasticity::Equal, _) => T::one(),
        _ => T::zero(),
    };
    let clearance = |contact: &Contact<T>| match contact.face {
        Some(_) => T::zero(),
        None => contact.play / T::exactly(2.0),
    };
    Ok(Some(SharedLoad {
        press_fits: mechanism.press_fits(),
        cut: mechanism.excess.contacts.iter().map(|contact| contact.index()).collect(),
        compliance: vector(&compliance),
        clearance: vector(&clearance),
        misalignment: vector(&|contact| contact.misalignment + contact.interference()),
        self_stress,
    }))
}

/// Returns whether the faces that share a load do not yield.
pub(crate) fn is_rigid(shared: &SharedLoad) -> bool {
    shared.compliance.iter().all(|compliance| *compliance == 0.0)
}

/// Refuses rigid guides that are out of line by more than their play.
///
/// # Errors
/// A fault that names the contacts that share a load.
pub(crate) fn check_assembly(mechanism: &Mechanism, shared: &SharedLoad) -> Result<(), Faults> {
    let Some(out) = is_rigid(shared).then(|| shared.out_of_line()).flatten() else { return Ok(()) };
    let contacts = || out.iter().map(|&k| &mechanism.contacts[k]);
    let kind =
        FaultKind::OutOfLine { contacts: contacts().map(|contact| contact.name.to_string()).collect() };
    let joint = mechanism.contacts[shared.cut[0]].joint;
    Err(Fault::new(kind, mechanism.joints[joint.index()].place.clone()).into())
}

/// How redundant guides share their load, in names, given their self-stresses; none if nothing is in excess.
///
/// # Errors
/// As [`shared_load`].
pub fn load_sharing(
    mechanism: &Mechanism,
    self_stress: &DMatrix<f64>,
) -> Result<Option<LoadSharing>, Faults> {
    let Some(shared) = shared_load(mechanism, self_stress.clone())? else { return Ok(None) };
    let places = |group: &Vec<usize>| -> Vec<String> {
        let contacts = group.iter().map(|&k| &mechanism.contacts[k]);
        // Both faces of a press fit have both parts in a group.
        let places = contacts.filter(|contact| !contact.is_second_face());
        places.map(|contact| contact.place().to_owned()).collect()
    };
    let fit = |&[face, _]: &[usize; 2]| {
        let contact = &mechanism.contacts[face];
        let grip = contact.stiffness.unwrap_or_default() * -contact.play;
        PressFit { contact: contact.place().to_owned(), grip }
    };
    Ok(Some(LoadSharing {
        self_stresses: shared.cut.len() - shared.press_fits.len(),
        groups: groups(&shared).iter().map(places).filter(|group| group.len() > 1).collect(),
        elasticity: elasticity(mechanism, self_stress)?,
        press_fits: shared.press_fits.iter().map(fit).collect(),
        stiffness_ratios: None,
    }))
}

/// Returns the elasticity that is assumed for the contacts in excess.
///
/// # Errors
/// As [`shared_load`].
pub fn elasticity<T: Real>(mechanism: &Mechanism<T>, self_stress: &DMatrix<T>) -> Result<Elasticity, Faults> {
    check_press_fits(mechanism)?;
    let takes_part = |k: &usize| self_stress.row(*k).iter().any(|force| !force.is_zero());
    let sharing: Vec<&Contact<T>> =
        (0..mechanism.contacts.len()).filter(takes_part).map(|k| &mechanism.contacts[k]).collect();
    let named = |those: &dyn Fn(&&&Contact<T>) -> bool| -> Vec<String> {
        sharing.iter().filter(those).map(|contact| contact.name.to_string()).collect()
    };
    let mut faults = Faults::default();
    let mut refuse = |kind: FaultKind| {
        let joint = sharing.first().map(|contact| contact.joint);
        faults.push(match joint {
            Some(joint) => Fault::new(kind, mechanism.joints[joint.index()].place.clone()),
            None => Fault::general(kind),
        });
    };
    let without = named(&|contact| contact.stiffness.is_none());
    let has_length = |contact: &&Contact<T>| !contact.play.is_zero() || !contact.misalignment.is_zero();
    let elasticity = if without.is_empty() {
        Elasticity::Given
    } else if without.len() < sharing.len() {
        refuse(FaultKind::StiffnessOfSome { contacts: without });
        Elasticity::Given
    } else if !sharing.iter().any(has_length) {
        Elasticity::Equal
    } else {
        let tight = named(&|contact| contact.play.is_zero());
        if !tight.is_empty() {
            refuse(FaultKind::RigidWithoutPlay { contacts: tight });
        }
        Elasticity::Rigid
    };
    faults.or(elasticity)
}

/// Refuses press fits of which nothing says how they grip, or that are of no kind with a law.
fn check_press_fits<T: Real>(mechanism: &Mechanism<T>) -> Result<(), Faults> {
    let mut faults = Faults::default();
    let mut refuse = |is_wrong: &dyn Fn(&Contact<T>) -> bool, kind: &dyn Fn(Vec<String>) -> FaultKind| {
        let fits = mechanism.contacts.iter().filter(|contact| contact.is_second_face() && is_wrong(contact));
        let fits: Vec<&Contact<T>> = fits.collect();
        let Some(first) = fits.first() else { return };
        let places = fits.iter().map(|contact| contact.place().to_owned()).collect();
        faults.push(Fault::new(kind(places), mechanism.joints[first.joint.index()].place.clone()));
    };
    let is_guided = |contact: &Contact<T>| mechanism.slider(contact.joint).is_some_and(Slider::is_guided);
    refuse(&is_guided, &|contacts| FaultKind::GuidedPressFit { contacts });
    let has_two_preloads = |contact: &Contact<T>| contact.preload[0] != contact.preload[1];
    refuse(&has_two_preloads, &|contacts| FaultKind::PreloadOfPressFit { contacts });
    let has_no_stiffness = |contact: &Contact<T>| contact.stiffness.is_none();
    refuse(&has_no_stiffness, &|contacts| FaultKind::PressFitWithoutStiffness { contacts });
    faults.or(())
}

/// The contacts that share a load, in groups that no self-stress connects.
fn groups(shared: &SharedLoad) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for stress in shared.self_stress.column_iter() {
        let mut group: Vec<usize> = (0..stress.len()).filter(|&k| stress[k] != 0.0).collect();
        groups.retain(|other| {
            let apart = !other.iter().any(|k| group.contains(k));
            if !apart {
                group.extend(other);
            }
            apart
        });
        group.sort_unstable();
        group.dedup();
        groups.push(group);
    }
    groups
}
