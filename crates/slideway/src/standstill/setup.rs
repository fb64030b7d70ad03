//! A mechanism at rest, as the analysis of standstill sees it: its equations at zero velocity, the load that
//! is varied apart from all others, and units in which forces, lengths and accelerations are of order one.

use super::HoldOptions;
use crate::configuration::{Configuration, free_motions, null_space};
use crate::fault::{Fault, FaultKind, Faults, nearest};
use crate::ids::{ContactId, DriveId, JointId};
use crate::kinetics::{Assembled, Reaction};
use crate::mechanism::{Effort, Mechanism, Quantity, Slider};
use crate::model::{Model, SliderKind};
use crate::modes::SharedLoad;
use crate::pattern::{GuidedCouple, Law};
use crate::progress::Work;
use crate::sharing::check_assembly;
use crate::sharing::{is_rigid, shared_load, stress_force};
use nalgebra::{DMatrix, DVector, DVectorView, RowDVector};

/// Units of the linear programs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    /// N
    pub(crate) force: f64,
    /// m
    pub(crate) length: f64,
    /// m/s^2
    pub(crate) acceleration: f64,
}

/// A sliding joint.
#[derive(Debug, Clone)]
pub(crate) struct SlidingJoint {
    /// Which joint it is.
    pub(super) joint: JointId,
    /// Its contacts.
    pub(super) contacts: Vec<usize>,
    /// The couple of a guided slider.
    pub(crate) couple: Option<GuidedCouple>,
}

/// The load that is varied.
#[derive(Debug, Clone)]
pub(crate) struct VariedLoad {
    /// Its name.
    pub(super) name: String,
    /// What it puts into the equations of motion at a factor of one.
    pub(super) forces: DVector<f64>,
    /// The factor at which the mechanism is released: 1 for a load, 0 for the effort of a drive.
    pub(super) nominal: f64,
    /// Unit of the factor: "" for a load, "N" or "N m" for the effort of a drive.
    pub(super) unit: &'static str,
}

impl VariedLoad {
    /// Its resultant at a factor of one (N) on so many bodies; none of a drive, and where its forces balance.
    pub(super) fn resultant(&self, bodies: usize) -> Option<f64> {
        // Forces in the plane, and along z at the first place of each three behind them.
        let sum = |from: usize, to: usize| self.forces.as_slice()[from..to].iter().step_by(3).sum::<f64>();
        let (in_plane, all) = (3 * bodies, self.forces.len());
        let force = sum(0, in_plane).hypot(sum(1, in_plane)).hypot(sum(in_plane, all));
        (self.unit.is_empty() && force != 0.0).then_some(force)
    }
}

/// A mechanism at rest.
#[derive(Debug, Clone)]
pub(crate) struct Setup {
    /// The mechanism, its rates zero, with the drives that hold.
    pub(crate) mechanism: Mechanism,
    /// Its positions.
    pub(super) configuration: Configuration,
    /// Its equations.
    pub(super) assembled: Assembled<f64>,
    /// What weights and loads put into the equations of motion, without the load that is varied.
    pub(super) given: DVector<f64>,
    /// The load that is varied.
    pub(super) load: Option<VariedLoad>,
    /// The sliding joints.
    pub(crate) sliders: Vec<SlidingJoint>,
    /// Units.
    pub(crate) units: Units,
    /// How redundant guides share their load; none if nothing is in excess.
    pub(super) shared: Option<SharedLoad>,
}

impl Setup {
    /// The mechanism of a model at rest.
    ///
    /// # Errors
    /// The end of the work; what makes no sense in the model or its position, an unknown load, a load that is zero.
    pub(super) fn new(model: &Model, options: &HoldOptions, work: Work<'_>) -> Result<Self, Faults> {
        let original = at_rest(Mechanism::new(model)?);
        // What tips out of the drawing slides otherwise at each of its contacts.
        original.check_planar("rest on contacts that may lift off", original.one_sided())?;
        original.check_size()?;
        let configuration = Configuration::with_progress(&original, &mut |told| work.tell(told))?;
        let mut mechanism = original.clone();
        mechanism.let_slip();
        configuration.put_misalignments(&mut mechanism)?;
        if !options.hold_drives {
            mechanism.drives.clear();
        }
        let mut load = None;
        if let Some(name) = &options.load {
            load = Some(varied(&original, &configuration, name)?);
            match named(&original, name)? {
                Named::Load => mechanism.loads.retain(|load| *load.name != **name),
                Named::Drive => mechanism.drives.retain(|drive| *drive.name != **name),
                Named::Gravity => mechanism.put_out_gravity(),
            }
        }
        let assembled = Assembled::at_rest(&mechanism, &configuration)?;
        let given = forces(&mechanism, &assembled);
        let sliders = sliders(&mechanism, &assembled);
        let shared = shared(&mechanism, &assembled)?;
        let mut units = units(&mechanism, &given, load.as_ref());
        units.force = shared.as_ref().map_or(units.force, |shared| units.force.max(misfit(shared)));
        Ok(Self { mechanism, configuration, assembled, given, load, sliders, units, shared })
    }

    /// A mechanism with these forces in the equations of motion alone, and without any other load and preload: what remains of
    /// it where the forces, or those between its guides, are great enough. Beside the deflections of guides that yield, play and
    /// misalignment are nothing then; rigid ones keep them.
    pub(super) fn alone(&self, forces: DVector<f64>) -> Self {
        let mut alone = Self { load: None, ..self.clone() };
        let force = greatest_force(&alone.mechanism, &forces);
        alone.units.force = if force > 0.0 { force } else { 1.0 };
        alone.given = forces;
        for contact in &mut alone.mechanism.contacts {
            contact.preload = [0.0; 2];
        }
        if let Some(shared) = alone.shared.as_mut().filter(|shared| !is_rigid(shared)) {
            shared.clearance.fill(0.0);
            shared.misalignment.fill(0.0);
        }
        alone
    }

    /// It with a mass for every body without one, at the mean of the places of its joints: loads stay as they are, so that
    /// this decides whether it can slide, not how fast.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn with_inertia(&self) -> Result<Self, Faults> {
        let mut heavy = self.clone();
        let size = heavy.mechanism.size;
        for body in heavy.mechanism.bodies.iter_mut().filter(|body| body.mass == 0.0) {
            (body.mass, body.moment_of_inertia) = (1.0, size * size);
        }
        heavy.assembled = Assembled::at_rest(&heavy.mechanism, &heavy.configuration)?;
        Ok(heavy)
    }

    /// Whether a contact takes part in a self-stress.
    pub(super) fn shares(&self, k: usize) -> bool {
        self.shared.as_ref().is_some_and(|shared| shared.shares(k))
    }

    /// Coulomb's law of a contact in the units of the programs; its static coefficients may be varied. What rubs at a round end
    /// is in its friction circle.
    pub(super) fn law(&self, k: usize) -> Law {
        let contact = &self.mechanism.contacts[k];
        Law::new(
            &self.mechanism,
            (k, contact),
            (self.units.force, true),
            [!self.mechanism.is_part_of_end(k); 2],
        )
    }

    /// What weights and loads put into the equations of motion, the varied load with its nominal factor.
    pub(super) fn loads(&self) -> DVector<f64> {
        let varied = self.load.as_ref().map(|load| &load.forces * load.nominal);
        varied.map_or_else(|| self.given.clone(), |varied| &self.given + varied)
    }

    /// The unit of length of what a friction circle has: couples and radii of hinges; 1 for the forces and coefficients of
    /// round ends.
    pub(super) fn lever(&self, circle: usize) -> f64 {
        if self.mechanism.friction_circles[circle].end.is_some() { 1.0 } else { self.units.length }
    }

    /// The place of a component of the force of a friction circle in the layout of the kinetic equations.
    pub(super) fn force_of(&self, circle: usize, component: usize) -> usize {
        let force = self.mechanism.friction_circles[circle].reactions()[component];
        self.assembled.layout.reaction(force).expect("every circle has a force")
    }

    /// The acceleration of a sliding joint or hinge with friction, by its number among these, as a row of those of the
    /// bodies: of a joint at the face where what may lift off rubs, else in the middle between both faces, `-(W^+ + W^-)/2`.
    pub(crate) fn row(&self, joint: usize) -> RowDVector<f64> {
        let mut row = RowDVector::zeros(self.equations_of_motion());
        match joint.checked_sub(self.sliders.len()) {
            None => {
                if let Some(&k) = self.sliders[joint].contacts.first() {
                    let [positive, negative] = &self.assembled.friction[k];
                    let other = if self.mechanism.contacts[k].opens { positive } else { negative };
                    for (column, value) in row.iter_mut().enumerate() {
                        *value = -f64::midpoint(positive[column], other[column]);
                    }
                }
            }
            // What a unit of friction does on its way is the rate at which the joint rubs.
            Some(circle) => {
                row.tr_copy_from(&self.assembled.couples[circle].rows(0, self.equations_of_motion()));
            }
        }
        row
    }

    /// The motions that the joints leave with these contacts open, one in each column: (x, y, angle) of every body in m and
    /// rad.
    pub(super) fn free_motions(&self, open: &[usize]) -> DMatrix<f64> {
        let (all, size) = (self.equations_of_motion(), self.mechanism.size);
        if open.is_empty() {
            // Out of the plane nothing moves while all is closed.
            let motions = free_motions(&self.mechanism, &self.configuration);
            return motions.resize_vertically(all, 0.0);
        }
        let is_rotation = |column: usize| self.mechanism.is_rotation(column);
        let scale = DVector::from_fn(all, |column, _| if is_rotation(column) { 1.0 } else { size });
        let row = |(index, reaction): (usize, &Reaction)| match reaction {
            Reaction::Normal(contact) if open.contains(&contact.index()) => None,
            Reaction::Normal(contact) => Some(self.gap_row(contact.index())),
            _ => Some(self.assembled.matrix.row(all + index).columns(0, all).into_owned()),
        };
        let rows = self.assembled.layout.reactions().iter().enumerate().filter_map(row).map(|row| {
            let row = row.component_mul(&scale.transpose());
            &row / row.amax()
        });
        let rows: Vec<RowDVector<f64>> = rows.collect();
        if rows.is_empty() {
            return DMatrix::from_diagonal(&scale);
        }
        DMatrix::from_diagonal(&scale) * null_space(&DMatrix::from_rows(&rows))
    }

    /// The contacts that may lift off.
    pub(super) fn one_sided(&self) -> Vec<usize> {
        self.mechanism.one_sided().map(ContactId::index).collect()
    }

    /// The acceleration of the gap of a contact, as a row of those of the bodies.
    pub(super) fn gap_row(&self, k: usize) -> RowDVector<f64> {
        let (row, _) = self.assembled.gap(ContactId(k)).expect("every contact has a normal force");
        row.columns(0, self.equations_of_motion()).into_owned()
    }

    /// Number of equations of motion: three for each body, six in space.
    pub(super) fn equations_of_motion(&self) -> usize {
        self.mechanism.accelerations()
    }
}

/// How redundant guides share their load; none if nothing is in excess, or only what may lift off: such contacts carry
/// whatever is in equilibrium, as nothing keeps them pressed but loads and friction.
///
/// # Errors
/// Nothing says how; rigid guides that are out of line by more than their play; guides that share a load with contacts that
/// may lift off.
fn shared(mechanism: &Mechanism, assembled: &Assembled<f64>) -> Result<Option<SharedLoad>, Faults> {
    if mechanism.excess.is_empty() {
        return Ok(None);
    }
    let self_stress = assembled.self_stresses(mechanism)?.map(stress_force);
    let mut sharing = mechanism.contacts.iter().zip(self_stress.row_iter());
    if sharing.all(|(contact, forces)| contact.opens || forces.iter().all(|force| *force == 0.0)) {
        return Ok(None);
    }
    mechanism.check_one_sided_in_excess()?;
    let shared = shared_load(mechanism, self_stress)?;
    if let Some(shared) = &shared {
        check_assembly(mechanism, shared)?;
    }
    Ok(shared)
}

/// The greatest normal force (N) at a cut contact by which misalignments beyond the play press the guides against
/// each other, as far as one self-stress `z` alone tells: `(|z^T e| - sum_k delta_k |z_k|)^+ / sum_k f_k z_k^2`. None of rigid
/// ones, which cannot be put together then.
fn misfit(shared: &SharedLoad) -> f64 {
    if is_rigid(shared) {
        return 0.0;
    }
    let of = |stress: DVectorView<'_, f64>| {
        let beyond = stress.dot(&shared.misalignment).abs() - stress.abs().dot(&shared.clearance);
        beyond.max(0.0) / stress.component_mul(&stress).dot(&shared.compliance)
    };
    shared.self_stress.column_iter().map(of).fold(0.0, f64::max)
}

/// The mechanism without velocities: the rates of the model count as zero, and drives that hold do not
/// accelerate.
fn at_rest(mut mechanism: Mechanism) -> Mechanism {
    for coordinate in &mut mechanism.coordinates {
        coordinate.rate = 0.0;
    }
    for drive in &mut mechanism.drives {
        drive.acceleration = Quantity::Constant(0.0);
    }
    mechanism
}

fn forces(mechanism: &Mechanism, assembled: &Assembled<f64>) -> DVector<f64> {
    assembled.load.rows(0, mechanism.accelerations()).into_owned()
}

/// The name by which all weights together are a load.
pub(super) const GRAVITY: &str = "gravity";

/// What a name of a load stands for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Named {
    Load,
    Drive,
    Gravity,
}

/// What a name stands for: a load, else the effort of a drive, else all weights.
///
/// # Errors
/// A name of nothing.
fn named(mechanism: &Mechanism, name: &str) -> Result<Named, Faults> {
    if mechanism.loads.iter().any(|load| *load.name == *name) {
        Ok(Named::Load)
    } else if mechanism.drives.iter().any(|drive| *drive.name == *name) {
        Ok(Named::Drive)
    } else if name == GRAVITY {
        Ok(Named::Gravity)
    } else {
        Err(unknown(mechanism, name))
    }
}

/// A load, the effort of a drive, or the weights, by its name.
fn varied(mechanism: &Mechanism, configuration: &Configuration, name: &str) -> Result<VariedLoad, Faults> {
    let what = named(mechanism, name)?;
    let mut alone = mechanism.clone();
    if what != Named::Gravity {
        alone.put_out_gravity();
    }
    alone.loads.retain(|load| *load.name == *name);
    alone.drives.retain(|drive| *drive.name == *name);
    let assembled = Assembled::at_rest(&alone, configuration)?;
    let drive = alone.drives.first().filter(|_| what == Named::Drive);
    let (forces, nominal, unit) = if let Some(drive) = drive {
        let column = assembled.layout.effort(DriveId(0));
        let forces = -assembled.matrix.view((0, column), (alone.accelerations(), 1)).column(0).into_owned();
        let unit = if matches!(drive.effort, Effort::Force { .. }) { "N" } else { "N m" };
        (forces, 0.0, unit)
    } else {
        (forces(&alone, &assembled), 1.0, "")
    };
    if forces.iter().all(|force| *force == 0.0) {
        return Err(Fault::general(FaultKind::NoLoadAtRest { load: name.to_owned() }).into());
    }
    Ok(VariedLoad { name: name.to_owned(), forces, nominal, unit })
}

fn unknown(mechanism: &Mechanism, name: &str) -> Faults {
    let loads = mechanism.loads.iter().map(|load| &*load.name);
    let drives = mechanism.drives.iter().map(|drive| &*drive.name);
    let has_weight = mechanism.free_fall() > 0.0;
    let known = loads.chain(drives).chain(has_weight.then_some(GRAVITY));
    let kind = FaultKind::UnknownName {
        what: "load",
        name: name.to_owned(),
        nearest: nearest(name, known.clone()),
        known: known.map(str::to_owned).collect(),
    };
    Fault::general(kind).into()
}

fn sliders(mechanism: &Mechanism, assembled: &Assembled<f64>) -> Vec<SlidingJoint> {
    let one = |(joint, slider): (JointId, &Slider)| {
        let couple = assembled.layout.reaction(Reaction::Couple(joint));
        let couple = couple.filter(|_| slider.kind == SliderKind::Guided);
        SlidingJoint {
            joint,
            contacts: slider.contacts.iter().map(|contact: &ContactId| contact.index()).collect(),
            couple: couple.map(|unknown| GuidedCouple { unknown, half_length: slider.greatest_couple(1.0) }),
        }
    };
    mechanism.sliders().map(one).collect()
}

/// Greatest force of the state, size of the mechanism, and the force divided by the greatest mass.
fn units(mechanism: &Mechanism, given: &DVector<f64>, load: Option<&VariedLoad>) -> Units {
    let length = mechanism.size;
    let mut force = greatest_force(mechanism, given);
    if let Some(load) = load {
        let whole = greatest_force(mechanism, &load.forces);
        // Of a drive only the direction is known.
        if load.nominal != 0.0 || force == 0.0 {
            force = force.max(whole);
        }
    }
    let preloads = mechanism.contacts.iter().flat_map(|contact| contact.preload);
    let force = preloads.fold(force, f64::max);
    let force = if force > 0.0 { force } else { 1.0 };
    let masses = mechanism.bodies.iter().map(|body| body.mass.max(body.moment_of_inertia / length.powi(2)));
    let mass = masses.fold(0.0, f64::max);
    Units { force, length, acceleration: if mass > 0.0 { force / mass } else { 1.0 } }
}

/// Greatest force among the forces, and the moments divided by the size of the mechanism, of every body.
pub(super) fn greatest_force(mechanism: &Mechanism, forces: &DVector<f64>) -> f64 {
    let in_newtons = |(index, value): (usize, &f64)| {
        if mechanism.is_rotation(index) { value / mechanism.size } else { *value }
    };
    forces.iter().enumerate().map(in_newtons).map(f64::abs).fold(0.0, f64::max)
}
