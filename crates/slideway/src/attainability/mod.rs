//! Which of several solutions a mechanism takes whose guides are slightly elastic (theory, section 7).
//!
//! Let the normal forces come from small elastic gaps, `N = -K gap`, with a stiffness for every contact.
//! Hinges, the rotation locks of guided sliders and drives stay rigid. What a unit acceleration of the gaps
//! needs in normal forces, Y, and the columns `c_k^sigma = sigma e_k - mu_k s_k eta_k^sigma` of eq. (6) come
//! from the same equations, and the fast motion about a solution with the sides `sigma` is
//!
//! ```text
//! Y gap'' = -C S K gap,     C S = [c_k^sigma_k sigma_k],     lambda Y gap = C S K gap
//! ```
//!
//! These are the eigenvalues other than zero of `M x'' + (G_c^T + W_sigma diag(mu s sigma)) K G_c x = 0` on
//! the motions that hinges, locks and drives allow, one for each contact. A motion without mass makes Y
//! singular: it reacts statically, and its stiffness has to be positive.
//!
//! Since `det(C S)` is the oriented determinant `p`, the number of negative eigenvalues is odd if and only if
//! `p < 0`, whatever the stiffness.

mod fate;
mod hinges;
mod inertia;
mod ratios;
mod shared;
mod spectrum;

use crate::kinetics::KineticEquations;
use crate::mechanism::{Effort, Mechanism};
use crate::modes::{ContactState, ModeProblem};
use crate::report::{Attainability, EigenvalueUnit, Fate, FlutterDamping, Verdict};
use fate::{End, FastMotion, Rest};
pub(crate) use hinges::ElasticHinges;
use inertia::Inertia;
use nalgebra::{DMatrix, DVector};
pub(crate) use ratios::ratios;
use shared::SharedGaps;
use spectrum::{Pencil, Spectrum, Stability};

/// The most contacts for which eigenvalues are computed, and for which the fate beside a solution is.
const MOST_CONTACTS: usize = 24;
const MOST_CONTACTS_OF_FATES: usize = 10;
/// The most solutions among which fates are sought.
const MOST_SOLUTIONS: usize = 32;
/// Inertia of a motion without mass where its fate is sought, as a share of the greatest other.
const VANISHING_SHARE: f64 = 1e-3;

const ROUNDING: &str = "an eigenvalue of the fast motion is zero within rounding";

/// A solution whose attainability is asked for.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The states of the contacts: their sides, or that one of redundant contacts is open.
    pub states: Vec<ContactState>,
    /// The normal forces (N), those of press fits at their faces.
    pub normal_force: DVector<f64>,
    /// The deflections of redundant contacts, where they are known (m).
    pub deflections: Vec<Option<f64>>,
}

/// A mechanism in its state whose guides are slightly elastic.
#[derive(Debug, Clone)]
pub struct ElasticGuides<'p> {
    problem: &'p ModeProblem,
    /// None if drives leave no definite motion.
    inertia: Option<Inertia>,
    /// Of every contact (N/m); 1 if the model does not give all of them.
    stiffness: Vec<f64>,
    given: bool,
    /// Of redundant guides: how their gaps hang together.
    shared: Option<SharedGaps>,
    /// Why the fast motion is not stable, if it is not without friction either, which drives may cause.
    reversed: Option<String>,
}

impl<'p> ElasticGuides<'p> {
    /// The elastic guides of a mechanism with these equations and this mode problem. Stiffnesses are those of
    /// the model if it gives them for every contact, else 1 N/m; of redundant guides they count where all
    /// that share a load have one, the others having the mean of these.
    pub fn new(mechanism: &Mechanism, equations: &KineticEquations, problem: &'p ModeProblem) -> Self {
        let contacts = &mechanism.contacts;
        let shared = SharedGaps::of(mechanism, equations, &[]);
        let known: Vec<f64> = contacts.iter().filter_map(|contact| contact.stiffness).collect();
        let given = known.len() == contacts.len() && !contacts.is_empty();
        let instead = if shared.is_some() && !known.is_empty() { mean(&known) } else { 1.0 };
        let stiffness: Vec<f64> = if given || shared.is_some() {
            contacts.iter().map(|contact| contact.stiffness.unwrap_or(instead)).collect()
        } else {
            vec![1.0; contacts.len()]
        };
        let few = contacts.len() <= MOST_CONTACTS;
        let inertia = if few { Inertia::new(equations, &[], mechanism.size) } else { None };
        let stable = inertia.as_ref().is_some_and(|inertia| {
            let frictionless = match &shared {
                Some(shared) => shared.gaps.transpose(),
                None => DMatrix::identity(contacts.len(), contacts.len()),
            };
            let spectrum = Pencil::new(inertia, frictionless, shared.as_ref())
                .and_then(|pencil| pencil.spectrum(&stiffness, &equal_masses(inertia)));
            spectrum.is_some_and(|spectrum| spectrum.stability == Stability::Attainable)
        });
        let reversed = (!stable).then(|| reversed(mechanism));
        Self { problem, inertia, stiffness, given, shared, reversed }
    }

    /// The attainability of each of these solutions, which are all that the mechanism has and none of them on
    /// the boundary between modes. Where one is unattainable, its two sides are followed to the others.
    pub fn attainability(&self, candidates: &[Candidate]) -> Vec<Attainability> {
        let mut all: Vec<_> = candidates.iter().map(|candidate| self.of(&candidate.states)).collect();
        self.fates(candidates, &mut all);
        all
    }

    /// The oriented determinant p of a mode of redundant guides, 1 without friction; none for others, whose
    /// mode problem has it.
    pub(crate) fn oriented_mean(&self, states: &[ContactState]) -> Option<f64> {
        self.shared.is_some().then(|| self.oriented_determinant(states))
    }

    /// The oriented determinant p of a mode, 1 without friction.
    pub(crate) fn oriented_determinant(&self, states: &[ContactState]) -> f64 {
        let states = self.closed(states);
        self.oriented(&self.mode(&states), &states)
    }

    /// The states of contacts that a pattern of the mode problem stands for.
    fn closed(&self, pattern: &[ContactState]) -> Vec<ContactState> {
        self.shared.as_ref().map_or_else(|| pattern.to_vec(), |shared| shared.closed(pattern))
    }

    /// `C S`: of redundant guides the rows of the contacts that are not cut.
    fn mode(&self, states: &[ContactState]) -> DMatrix<f64> {
        let matrix = mode_matrix(self.problem, states);
        match &self.shared {
            Some(shared) => matrix.select_rows(&shared.kept),
            None => matrix,
        }
    }

    fn oriented(&self, mode: &DMatrix<f64>, states: &[ContactState]) -> f64 {
        match &self.shared {
            Some(shared) => shared.oriented(mode, states, &self.stiffness),
            None => mode.determinant(),
        }
    }

    /// Whether a verdict says something about this state: contacts of determinate guides that are between
    /// their faces have no elastic law.
    fn has_law(&self, states: &[ContactState]) -> bool {
        self.shared.is_some() || !states.contains(&ContactState::Gap)
    }

    /// The verdict on the mode with these sides alone: neither how it depends on stiffnesses nor what the
    /// solution separates is examined.
    pub fn verdict_on(&self, states: &[ContactState]) -> Verdict {
        if states.len() > MOST_CONTACTS || !self.has_law(states) {
            return Verdict::NotComputed;
        }
        let (Some(inertia), None) = (&self.inertia, &self.reversed) else { return Verdict::Undecided };
        let states = self.closed(states);
        let mode = self.mode(&states);
        let oriented = self.oriented(&mode, &states);
        let spectrum = Pencil::new(inertia, mode, self.shared.as_ref())
            .and_then(|pencil| pencil.spectrum(&self.stiffness, &equal_masses(inertia)));
        spectrum.map_or(Verdict::NotComputed, |spectrum| {
            let is_odd = spectrum.negative % 2 == 1;
            let consistent = oriented != 0.0 && is_odd == (oriented < 0.0);
            self.verdict(&spectrum, consistent).verdict
        })
    }

    /// The attainability of the mode with these sides, without what an unattainable solution separates.
    pub(crate) fn of(&self, states: &[ContactState]) -> Attainability {
        if !self.has_law(states) {
            return Attainability::without_eigenvalues(
                Verdict::NotComputed,
                "the preload acts between the faces",
            );
        }
        if states.len() > MOST_CONTACTS {
            let reason = format!("more than {MOST_CONTACTS} contacts");
            return Attainability::without_eigenvalues(Verdict::NotComputed, &reason);
        }
        let (Some(inertia), None) = (&self.inertia, &self.reversed) else {
            let reason = self.reversed.as_deref().unwrap_or_default();
            return Attainability::without_eigenvalues(Verdict::Undecided, reason);
        };
        let states = self.closed(states);
        let mode = self.mode(&states);
        let oriented = self.oriented(&mode, &states);
        let computed = Pencil::new(inertia, mode, self.shared.as_ref()).and_then(|pencil| {
            let spectrum = pencil.spectrum(&self.stiffness, &equal_masses(inertia))?;
            Some((pencil, spectrum))
        });
        let Some((pencil, spectrum)) = computed else {
            let reason = "its eigenvalues could not be computed";
            return Attainability::without_eigenvalues(Verdict::NotComputed, reason);
        };
        let is_odd = spectrum.negative % 2 == 1;
        let consistent = oriented != 0.0 && is_odd == (oriented < 0.0);
        let mut attainability = self.verdict(&spectrum, consistent);
        let varies =
            |other: Option<Spectrum>| other.is_some_and(|other| !other.stability.agrees(&spectrum.stability));
        if consistent && spectrum.stability != Stability::Unclear {
            // An odd number of negative eigenvalues stays odd, but for redundant guides.
            attainability.depends_on_stiffness = Some(
                (!is_odd || self.shared.is_some())
                    && self.stiffness_ratios().any(|k| varies(pencil.spectrum(&k, &equal_masses(inertia)))),
            );
            let masses =
                if is_odd || inertia.massless_gaps() < 2 { Vec::new() } else { mass_ratios(inertia) };
            attainability.depends_on_mass_ratios =
                Some(masses.iter().any(|masses| varies(pencil.spectrum(&self.stiffness, masses))));
        }
        attainability.massless_motions = inertia.massless_gaps();
        attainability
    }

    fn verdict(&self, spectrum: &Spectrum, consistent: bool) -> Attainability {
        let (verdict, damping) = match spectrum.stability {
            _ if !consistent => (Verdict::Undecided, None),
            Stability::Attainable => (Verdict::Attainable, None),
            Stability::Unattainable => (Verdict::Unattainable, None),
            Stability::Unclear => (Verdict::Undecided, None),
            Stability::Flutter(damping) => (
                Verdict::Flutter,
                Some(FlutterDamping { ratio: damping.ratio, time: self.given.then_some(damping.time) }),
            ),
        };
        Attainability {
            reason: (verdict == Verdict::Undecided).then(|| ROUNDING.to_owned()),
            // Adding zero turns -0 into 0.
            eigenvalues: spectrum.finite.iter().map(|lambda| [lambda.re, lambda.im + 0.0]).collect(),
            eigenvalue_unit: if self.given {
                EigenvalueUnit::PerSecondSquared
            } else {
                EigenvalueUnit::PerKilogram
            },
            flutter_damping: damping,
            ..Attainability::without_eigenvalues(verdict, "")
        }
    }

    fn stiffness_ratios(&self) -> impl Iterator<Item = Vec<f64>> {
        other_stiffnesses(&self.stiffness, self.shared.as_ref())
    }

    /// What each unattainable solution separates.
    fn fates(&self, candidates: &[Candidate], all: &mut [Attainability]) {
        let few = self.stiffness.len() <= MOST_CONTACTS_OF_FATES && candidates.len() <= MOST_SOLUTIONS;
        let is_rigid = self.shared.as_ref().is_some_and(|shared| shared.rigid);
        let none = all.iter().all(|one| one.verdict != Verdict::Unattainable);
        let (Some(inertia), true) = (&self.inertia, few && !none && !is_rigid) else { return };
        let Some(mobility) = inertia.inverse(VANISHING_SHARE) else { return };
        let stays = |one: &Attainability| matches!(one.verdict, Verdict::Attainable | Verdict::Flutter);
        let numbers: Vec<usize> = (0..all.len()).filter(|&index| stays(&all[index])).collect();
        let closed: Vec<_> = candidates.iter().map(|candidate| self.closed(&candidate.states)).collect();
        let rest = |index: usize| {
            let Candidate { normal_force, deflections, .. } = &candidates[index];
            let states = &closed[index];
            // The law of a face of a press fit begins where it touches.
            let interference = |k: usize| self.shared.as_ref().map_or(0.0, |shared| shared.interference[k]);
            let deflection = |k: usize| match deflections.get(k).copied().flatten() {
                Some(deflection) => deflection - interference(k),
                None => -normal_force[k] / self.stiffness[k],
            };
            let kept = |shared: &SharedGaps| shared.kept.iter().map(|&k| deflection(k)).collect::<Vec<_>>();
            let gap = self.shared.as_ref().map_or_else(|| (0..states.len()).map(deflection).collect(), kept);
            Rest { states, normal_force, gap: DVector::from_vec(gap) }
        };
        let targets: Vec<Rest<'_>> = numbers.iter().map(|&index| rest(index)).collect();
        let Some(mut motion) = FastMotion::new(self.problem, mobility, &self.stiffness, self.shared.as_ref())
        else {
            return;
        };
        for (index, one) in all.iter_mut().enumerate() {
            if one.verdict == Verdict::Unattainable {
                let ends = motion.ends(&rest(index), &targets);
                one.separates = ends.map(|ends| ends.map(|end| fate(end, &numbers)));
            }
        }
    }
}

/// Why the stability under drives is not decided, and how to measure a coordinate so that it is.
fn reversed(mechanism: &Mechanism) -> String {
    let unstable = "the mechanism would be unstable with elastic guides even without friction";
    let [drive] = mechanism.drives.as_slice() else {
        return format!(
            "coordinates are measured in other places or directions than their drives act. Held exactly there, {unstable}. \
             Measure each where and as its drive acts"
        );
    };
    let coordinate = &mechanism.coordinates[drive.coordinate.index()].name;
    let measure = match drive.effort {
        Effort::Force { at, direction, .. } => {
            let axis = if direction.x.abs() >= direction.y.abs() { "x" } else { "y" };
            let body = at.frame.body().map(|body| &mechanism.bodies[body.index()]);
            let points = body.into_iter().flat_map(|body| &body.points);
            let point =
                points.filter(|(_, position)| *position == at.position).map(|(name, _)| &**name).next();
            format!("{axis} = \"{}.{}\"", mechanism.frame_name(at.frame), point.unwrap_or("POINT"))
        }
        Effort::Torque { body, .. } => format!("rotation = \"{}\"", mechanism.frame_name(body)),
    };
    format!(
        "{coordinate} is measured in another place or direction than {} acts. Held exactly there, {unstable}. Measure \
         {coordinate} where it acts: `{measure}` in [coordinates.{coordinate}]",
        drive.name
    )
}

fn fate(end: End, numbers: &[usize]) -> Fate {
    match end {
        End::Target(target) => Fate::Solution(numbers[target] + 1),
        End::Beyond => Fate::Jamming,
        End::Open => Fate::NotComputed,
    }
}

fn equal_masses(inertia: &Inertia) -> Vec<f64> {
    vec![1.0; inertia.vanishing_masses()]
}

/// Ratios of the vanishing masses that are tried.
fn mass_ratios(inertia: &Inertia) -> Vec<Vec<f64>> {
    ratios(inertia.vanishing_masses())
}

/// C S = [c_k^sigma_k sigma_k]; the column of an open contact is zero.
fn mode_matrix(problem: &ModeProblem, states: &[ContactState]) -> DMatrix<f64> {
    DMatrix::from_fn(states.len(), states.len(), |i, k| {
        states[k].side().map_or(0.0, |side| problem.columns(side)[(i, k)] * side.sign())
    })
}

/// Stiffnesses in other ratios; both faces of a press fit have one.
fn other_stiffnesses(stiffness: &[f64], shared: Option<&SharedGaps>) -> impl Iterator<Item = Vec<f64>> {
    ratios(stiffness.len()).into_iter().map(move |mut ratios| {
        for &[positive, negative] in shared.iter().flat_map(|shared| &shared.press_fits) {
            ratios[negative] = ratios[positive];
        }
        ratios.iter().zip(stiffness).map(|(ratio, stiffness)| ratio * stiffness).collect()
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
