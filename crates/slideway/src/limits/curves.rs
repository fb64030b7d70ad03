//! Forces and accelerations of every mode over what is varied: what a plot shows.

use super::analysis::Analysis;
use super::answer::Naming;
use super::found::ModesFound;
use super::options::LimitsOptions;
use super::report::LimitsReport;
use super::varied::Varied;
use crate::choice::Choice;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::influence::ContactFriction;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Effort, Mechanism};
use crate::model::Model;
use crate::modes::ContactState;
use crate::modes::branches::Branch;
use crate::modes::existence::{EndCause, ModeInterval};
use crate::problem::TurningHinge;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::{Verdict, finite};
use crate::solve::{Closed, Parts, ProblemData, Stages, attainability_with_hinges, friction, unknowns_of};
use crate::units::{Unit, Units};
use nalgebra::DVector;

/// Even steps in the interval of a mode.
const STEPS: usize = 240;
/// Steps towards an end at which reactions grow without bound: they reach `10^-DECADES` of the interval.
const STEPS_TO_LOCKING: usize = 120;
const DECADES: f64 = 6.0;

/// Quantity that a plot shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Quantity {
    /// The normal force of every contact.
    #[default]
    NormalForce,
    /// The friction force of every contact.
    Friction,
    /// The acceleration of every coordinate.
    Acceleration,
    /// The effort of every drive.
    Effort,
}

impl Choice for Quantity {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (Self::NormalForce, "normal-force", "The normal force of every contact"),
        (Self::Friction, "friction", "The friction force of every contact"),
        (Self::Acceleration, "acceleration", "The acceleration of every coordinate"),
        (Self::Effort, "effort", "The effort of every drive"),
    ];
}

/// One of the quantities that are computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The contact, coordinate or drive.
    pub name: String,
    /// The unit of its values.
    pub unit: &'static str,
}

/// A value of what is varied, and what belongs to it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvePoint {
    /// The value of what is varied (SI units).
    pub at: f64,
    /// One value for each of [`Curves::series`].
    pub values: Vec<f64>,
    /// Whether a mechanism with slightly elastic guides settles there.
    pub verdict: Verdict,
}

/// A mode over its interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Points of increasing `at`, close together; ends at which reactions grow without bound are left out.
    pub points: Vec<CurvePoint>,
}

impl Curve {
    /// The point nearest to a value; none if it has no points.
    fn nearest(&self, at: f64) -> Option<&CurvePoint> {
        let way = |point: &&CurvePoint| (point.at - at).abs();
        self.points.iter().min_by(|one, other| way(one).total_cmp(&way(other)))
    }
}

/// The quantities of every mode over what is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Quantity that was computed.
    pub quantity: Quantity,
    /// In which unit values of what is varied are to be shown.
    pub shown_in: Unit,
    /// In which units the values of its series are to be shown: those that suit them nearest to the model.
    pub units: Units,
    /// Names and units of the values of every point.
    pub series: Vec<Series>,
    /// One curve for each of [`LimitsReport::modes`].
    pub forwards: Vec<Curve>,
    /// One for each mode of the opposite direction, if it was asked for.
    pub reversed: Option<Vec<Curve>>,
}

/// [`limits`](super::limits), and a quantity along every mode, sampled densely over the mode's exact interval
/// and ever closer towards ends at which it grows without bound.
///
/// # Errors
/// As [`limits`](super::limits); a model without drives has no efforts.
///
/// ```
/// use slideway::limits::{LimitsOptions, Quantity, Vary, limits_with_curves};
/// use slideway::model::Model;
///
/// let model = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
/// let options = LimitsOptions::new(Vary::usual("mu"));
/// let (report, curves) = limits_with_curves(&model, &options, Quantity::NormalForce)?;
/// assert_eq!(curves.forwards.len(), report.modes.len());
/// assert_eq!(curves.series[0].name, "guide.front");
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn limits_with_curves(
    model: &Model,
    options: &LimitsOptions,
    quantity: Quantity,
) -> Result<(LimitsReport, Curves), Faults> {
    undisturbed(|work| curves_of(model, options, quantity, work))
}

/// [`limits_with_curves`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`limits_with_curves`].
pub fn curves_with(
    model: &Model,
    options: &LimitsOptions,
    quantity: Quantity,
    callback: &mut Callback<'_>,
) -> Result<Option<(LimitsReport, Curves)>, Faults> {
    watched(callback, |work| curves_of(model, options, quantity, work))
}

fn curves_of(
    model: &Model,
    options: &LimitsOptions,
    quantity: Quantity,
    work: Work<'_>,
) -> Result<(LimitsReport, Curves), Faults> {
    let analysis = Analysis::new(model, options, work.part(0, 2))?;
    let naming = Naming::new(model)?;
    let series = series(&naming.mechanism, quantity)?;
    let curves = |varied: &Varied, found: &ModesFound| -> Vec<Curve> {
        let modes = &found.existence.modes;
        let one = |(index, mode)| {
            let along = found.branches.get(index).map(|branch| (branch, found.circles.as_slice()));
            curve((varied, mode, along), quantity, work.part(1, 2).part(index, modes.len()))
        };
        modes.iter().enumerate().map(one).collect()
    };
    let forwards = curves(&analysis.varied, &analysis.found);
    let reversed = analysis.reversed.as_ref().map(|(varied, found)| curves(varied, found));
    let report = finite(analysis.report(&naming))?;
    let present = analysis.varied.present().unwrap_or_default();
    let near = forwards.iter().chain(reversed.iter().flatten()).filter_map(|curve| curve.nearest(present));
    let units = near.flat_map(|point| series.iter().map(|one| one.unit).zip(point.values.iter().copied()));
    let units = model.units.clone().suited_to(units);
    let shown_in = analysis.varied.shown_in;
    Ok((report, Curves { quantity, shown_in, units, series, forwards, reversed }))
}

fn series(mechanism: &Mechanism, quantity: Quantity) -> Result<Vec<Series>, Faults> {
    let contacts =
        mechanism.contacts.iter().map(|contact| Series { name: contact.name.to_string(), unit: "N" });
    Ok(match quantity {
        Quantity::NormalForce | Quantity::Friction => contacts.collect(),
        Quantity::Acceleration => mechanism
            .coordinates
            .iter()
            .map(|coordinate| Series {
                name: coordinate.name.to_string(),
                unit: if coordinate.kind.is_angle() { "rad/s^2" } else { "m/s^2" },
            })
            .collect(),
        Quantity::Effort if mechanism.drives.is_empty() => {
            let coordinate = mechanism.coordinates.first().map(|coordinate| coordinate.name.to_string());
            return Err(Fault::general(FaultKind::NoDrives { coordinate }).into());
        }
        Quantity::Effort => mechanism
            .drives
            .iter()
            .map(|drive| Series {
                name: drive.name.to_string(),
                unit: if matches!(drive.effort, Effort::Force { .. }) { "N" } else { "N m" },
            })
            .collect(),
    })
}

/// Its points; with friction in hinges those of the branch, with the circles of these.
fn curve(
    (varied, mode, along): (&Varied, &ModeInterval, Option<(&Branch, &[usize])>),
    quantity: Quantity,
    work: Work<'_>,
) -> Curve {
    let places = places(mode);
    let point = |(index, at): (usize, f64)| {
        if work.piece("points", index, places.len()).is_break() {
            return None;
        }
        let (values, verdict) = if let Some((branch, circles)) = along {
            of_branch(varied, at, (branch, circles), quantity)?
        } else {
            let state = StateAt::new(varied, at).ok()?;
            (state.values(&mode.pattern, quantity)?, state.verdict(&mode.pattern))
        };
        let finite = values.iter().all(|value| value.is_finite());
        finite.then_some(CurvePoint { at, values, verdict })
    };
    Curve { points: places.iter().copied().enumerate().filter_map(point).collect() }
}

/// The values of a quantity on a branch, and whether a mechanism with slightly elastic joints settles there.
fn of_branch(
    varied: &Varied,
    at: f64,
    (branch, circles): (&Branch, &[usize]),
    quantity: Quantity,
) -> Option<(Vec<f64>, Verdict)> {
    let forces = varied.branch_forces(at, circles, branch)?;
    let values = |stages: &Stages, hinges: &[TurningHinge]| {
        let unknowns = unknowns_of(stages, hinges, (&branch.states, &forces));
        let normal_force = DVector::from_column_slice(&forces.normal);
        let mut shares = vec![None; branch.states.len()];
        forces.gaps.iter().for_each(|share| shares[share.contact] = Some(share.lambda));
        let of_state = OfState { pattern: &branch.states, normal_force: &normal_force, shares: &shares };
        let equations = KineticEquations::new(&stages.mechanism, &stages.configuration)?;
        let values = of_state.values(stages.data(), &equations, quantity, || unknowns.clone());
        let state = (&stages.configuration, &equations);
        let forces = (branch.states.as_slice(), forces.hinges.as_slice());
        Ok((values, attainability_with_hinges(stages.data(), state, hinges, forces).verdict))
    };
    varied.with_hinges(at, circles, values).ok()
}

/// Data of a state from which quantities are computed.
struct OfState<'s> {
    pattern: &'s [ContactState],
    normal_force: &'s DVector<f64>,
    shares: &'s [Option<f64>],
}

impl OfState<'_> {
    /// The values of a quantity, some of which follow from all unknowns.
    fn values(
        &self,
        data: ProblemData<'_>,
        equations: &KineticEquations,
        quantity: Quantity,
        all: impl Fn() -> DVector<f64>,
    ) -> Vec<f64> {
        let ProblemData { mechanism, influence, velocity_signs } = data;
        let Self { pattern, normal_force, shares } = *self;
        match quantity {
            Quantity::NormalForce => mechanism.forces_at_faces(pattern, normal_force.as_slice().to_vec()),
            Quantity::Friction => {
                let friction = friction(mechanism, velocity_signs, pattern, normal_force, shares);
                let friction = friction.iter().map(|friction: &ContactFriction| friction.total());
                mechanism.forces_at_faces(pattern, friction.collect())
            }
            Quantity::Acceleration => equations.coordinate_accelerations(&all()),
            Quantity::Effort => influence.efforts(&all()),
        }
    }
}

/// Where a mode is sampled.
fn places(mode: &ModeInterval) -> Vec<f64> {
    let (from, to) = (mode.from.at, mode.to.at);
    let locks = [&mode.from, &mode.to].map(|end| end.cause == EndCause::Singular);
    let even = (0..=STEPS).map(|step| step as f64 / STEPS as f64);
    let closer =
        (1..=STEPS_TO_LOCKING).map(|step| 10_f64.powf(-DECADES * step as f64 / STEPS_TO_LOCKING as f64));
    let mut shares: Vec<f64> = even.collect();
    if locks[0] {
        shares.extend(closer.clone());
    }
    if locks[1] {
        shares.extend(closer.map(|share| 1.0 - share));
    }
    shares.retain(|&share| !(locks[0] && share == 0.0 || locks[1] && share == 1.0));
    shares.sort_by(f64::total_cmp);
    // Both ends of the interval stay exact.
    let place = |share: f64| if share == 1.0 { to } else { from + share * (to - from) };
    let mut places: Vec<f64> = shares.into_iter().map(place).collect();
    places.dedup();
    places
}

/// The stages at one value of what is varied.
pub(crate) struct StateAt {
    stages: Stages,
    equations: KineticEquations,
    parts: Parts,
}

impl StateAt {
    /// # Errors
    /// Whatever `solve` refuses there.
    pub(crate) fn new(varied: &Varied, at: f64) -> Result<Self, Faults> {
        let mechanism = Mechanism::new(&varied.model_at(at)?)?;
        let configuration = Configuration::new(&mechanism)?;
        let (stages, equations) = Stages::with_equations(mechanism, configuration)?;
        let parts = stages.parts()?;
        Ok(Self { stages, equations, parts })
    }

    /// The values of a quantity in a mode; none where its equations are singular.
    fn values(&self, pattern: &[ContactState], quantity: Quantity) -> Option<Vec<f64>> {
        let unknowns = self.parts.line_to(&self.parts).unknowns(pattern, 0.0)?;
        let states = || pattern.iter().zip(unknowns.iter());
        let normal_force = DVector::from_iterator(pattern.len(), states().map(|(state, y)| state.sign() * y));
        let shares: Vec<Option<f64>> =
            states().map(|(state, share)| (*state == ContactState::Gap).then_some(*share)).collect();
        let data = self.stages.data();
        let all = || {
            let friction = friction(data.mechanism, data.velocity_signs, pattern, &normal_force, &shares);
            data.influence.unknowns(&friction, &normal_force)
        };
        let of_state = OfState { pattern, normal_force: &normal_force, shares: &shares };
        Some(of_state.values(data, &self.equations, quantity, all))
    }

    /// Whether a mechanism with slightly elastic guides settles on a mode.
    pub(crate) fn verdict(&self, pattern: &[ContactState]) -> Verdict {
        let open: Vec<usize> = self.stages.mechanism.opening(pattern).collect();
        let closed = Closed::new(self.stages.data(), (&self.stages.configuration, &self.equations), &open);
        closed.map_or(Verdict::NotComputed, |closed| closed.verdict_on(pattern))
    }
}
