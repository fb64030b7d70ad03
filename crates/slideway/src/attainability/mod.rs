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
//!
//! A hinge with friction gives way in both directions, `R = -K gap`. With `x = (N, R)` and the directions `D_j = x_j^T /
//! |x_j|` of the hinges, and `sigma_k` of the contacts, `I - H D` stands in the place of `C S`.

mod fate;
mod inertia;
mod ratios;
mod shared;
mod spectrum;

use crate::kinetics::{KineticEquations, Reaction};
use crate::mechanism::{Contact, Effort, Mechanism};
use crate::modes::{ContactState, ModeProblem};
use crate::report::{Attainability, EigenvalueUnit, Fate, FlutterDamping, Verdict};
use fate::{End, FastMotion, Rest};
use inertia::Inertia;
use nalgebra::{DMatrix, DVector};
pub(crate) use ratios::ratios;
use shared::SharedGaps;
use spectrum::{Pencil, Spectrum, Stability};

/// The most contacts for which eigenvalues are computed, and for which the fate beside a solution is.
const MOST_CONTACTS: usize = 24;
const MOST_CONTACTS_OF_FATES: usize = 10;
/// The most contacts that nothing presses of which both sides are compared.
const MOST_UNPRESSED: usize = 6;
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

/// A mechanism in its state whose guides and hinges with friction are slightly elastic.
#[derive(Debug, Clone)]
pub(crate) struct ElasticJoints {
    /// The inertia of their gaps, or what is said without it.
    inertia: Result<Inertia, (Verdict, String)>,
    /// Of every contact (N/m), 1 if the model does not give all of them; with friction in hinges in units of the mean, then
    /// of both components of these hinges.
    stiffness: Vec<f64>,
    given: bool,
    has_hinges: bool,
    /// Of redundant guides: how their gaps hang together.
    shared: Option<SharedGaps>,
}

impl ElasticJoints {
    /// Those of a mechanism with these equations, and with friction by these forces of hinges. Stiffnesses are those of the model
    /// if it gives them for every contact, else 1 N/m; of redundant guides they count where all that share a load have
    /// one, the others having the mean of these. With friction in hinges all joints are equally stiff, but for redundant
    /// guides.
    pub(crate) fn new(mechanism: &Mechanism, equations: &KineticEquations, hinges: &[Reaction]) -> Self {
        let contacts = &mechanism.contacts;
        let size = contacts.len() + hinges.len();
        let shared = SharedGaps::of(mechanism, equations, hinges);
        let known: Vec<f64> = contacts.iter().filter_map(|contact| contact.stiffness).collect();
        let has_hinges = !hinges.is_empty();
        let given = !has_hinges && known.len() == contacts.len() && !contacts.is_empty();
        let instead = if shared.is_some() && !known.is_empty() { mean(&known) } else { 1.0 };
        let unit = if has_hinges { instead } else { 1.0 };
        let of_contact = |contact: &Contact| {
            let own = contact.stiffness.filter(|_| given || shared.is_some());
            own.unwrap_or(instead) / unit
        };
        let mut stiffness: Vec<f64> = contacts.iter().map(of_contact).collect();
        stiffness.resize(size, 1.0);
        let inertia = if size > MOST_CONTACTS {
            let what = if has_hinges { "components of normal and hinge forces" } else { "contacts" };
            Err((Verdict::NotComputed, format!("more than {MOST_CONTACTS} {what}")))
        } else if let Some(body) = mechanism.unknown_tilt() {
            let shape = "give its `shape = { box = [..] }`";
            Err((
                Verdict::NotComputed,
                format!("the inertia of {body} out of the drawing is not known: {shape}"),
            ))
        } else {
            let frictionless = match &shared {
                Some(shared) => shared.gaps.transpose(),
                None => DMatrix::identity(size, size),
            };
            let is_stable = |inertia: &Inertia| {
                let spectrum = Pencil::new(inertia, frictionless, shared.as_ref())
                    .and_then(|pencil| pencil.spectrum(&stiffness, &equal_masses(inertia)));
                spectrum.is_some_and(|spectrum| spectrum.stability == Stability::Attainable)
            };
            let inertia = Inertia::new(equations, hinges, mechanism.size).filter(is_stable);
            inertia.ok_or_else(|| (Verdict::Undecided, reversed(mechanism)))
        };
        Self { inertia, stiffness, given, has_hinges, shared }
    }

    /// Those of a mechanism in which joints stick, with these matrices of the gaps and slips: what accelerations need, and the forces
    /// without the friction of what slides. All are equally stiff.
    pub(crate) fn with_sticking(
        mechanism: &Mechanism,
        equations: &KineticEquations,
        matrix: DMatrix<f64>,
        frictionless: DMatrix<f64>,
    ) -> Self {
        let stiffness = vec![1.0; matrix.nrows()];
        let is_stable = |inertia: &Inertia| {
            let spectrum = Pencil::new(inertia, frictionless, None)
                .and_then(|pencil| pencil.spectrum(&stiffness, &equal_masses(inertia)));
            spectrum.is_some_and(|spectrum| spectrum.stability == Stability::Attainable)
        };
        let inertia = if stiffness.len() > MOST_CONTACTS {
            Err((
                Verdict::NotComputed,
                format!("more than {MOST_CONTACTS} normal forces and frictions that hold"),
            ))
        } else if !equations.massless_accelerations().is_empty() {
            Err((Verdict::NotComputed, "bodies without mass move beside contacts that stick".to_owned()))
        } else {
            let inertia = Some(Inertia::of_matrix(matrix)).filter(is_stable);
            inertia.ok_or_else(|| (Verdict::Undecided, reversed(mechanism)))
        };
        Self { inertia, stiffness, given: false, has_hinges: false, shared: None }
    }

    /// The attainability of a solution with this matrix `C S`, or `I - H D`, and these states of the contacts, without what
    /// an unattainable one separates.
    pub(crate) fn of(&self, mode: DMatrix<f64>, states: &[ContactState]) -> Attainability {
        let (pencil, spectrum, mut attainability) = match self.examined(mode, states) {
            Ok(examined) => examined,
            Err(none) => return none,
        };
        let (inertia, is_odd) = (pencil.inertia(), spectrum.negative % 2 == 1);
        attainability.massless_motions = inertia.massless_gaps();
        if attainability.verdict == Verdict::Undecided {
            return attainability;
        }
        let varies =
            |other: Option<Spectrum>| other.is_some_and(|other| !other.stability.agrees(&spectrum.stability));
        let mut stiffnesses = other_stiffnesses(&self.stiffness, self.shared.as_ref());
        // An odd number of negative eigenvalues stays odd, but for redundant guides.
        attainability.depends_on_stiffness = Some(
            (!is_odd || self.shared.is_some())
                && stiffnesses.any(|k| varies(pencil.spectrum(&k, &equal_masses(inertia)))),
        );
        if !self.has_hinges {
            let vary = !is_odd && inertia.massless_gaps() >= 2;
            let masses = if vary { ratios(inertia.vanishing_masses()) } else { Vec::new() };
            attainability.depends_on_mass_ratios =
                Some(masses.iter().any(|masses| varies(pencil.spectrum(&self.stiffness, masses))));
        }
        attainability
    }

    /// The fast motion of a mode, its eigenvalues, and the verdict by them alone.
    ///
    /// # Errors
    /// The verdict if they are not computed.
    fn examined(
        &self,
        mode: DMatrix<f64>,
        states: &[ContactState],
    ) -> Result<(Pencil<'_>, Spectrum, Attainability), Attainability> {
        let none = |verdict: Verdict, reason: &str| Attainability::without_eigenvalues(verdict, reason);
        // Contacts of determinate guides that are between their faces have no elastic law.
        if self.shared.is_none() && states.contains(&ContactState::Gap) {
            return Err(none(Verdict::NotComputed, "the preload acts between the faces"));
        }
        let inertia = self.inertia.as_ref().map_err(|(verdict, reason)| none(*verdict, reason))?;
        let states = self.closed(states);
        let mode = self.kept(mode, &states);
        let oriented = self.oriented(&mode, &states);
        let computed = Pencil::new(inertia, mode, self.shared.as_ref()).and_then(|pencil| {
            let spectrum = pencil.spectrum(&self.stiffness, &equal_masses(inertia))?;
            Some((pencil, spectrum))
        });
        let (pencil, spectrum) =
            computed.ok_or_else(|| none(Verdict::NotComputed, "its eigenvalues could not be computed"))?;
        let is_odd = spectrum.negative % 2 == 1;
        let consistent = oriented != 0.0 && is_odd == (oriented < 0.0);
        let verdict = self.verdict(&spectrum, consistent);
        Ok((pencil, spectrum, verdict))
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

    /// The states of contacts that a pattern of the mode problem stands for.
    fn closed(&self, pattern: &[ContactState]) -> Vec<ContactState> {
        self.shared.as_ref().map_or_else(|| pattern.to_vec(), |shared| shared.closed(pattern))
    }

    /// `C S`, of redundant guides without the columns of open contacts and the rows of those that are cut.
    fn kept(&self, mut mode: DMatrix<f64>, states: &[ContactState]) -> DMatrix<f64> {
        let Some(shared) = &self.shared else { return mode };
        for (contact, _) in states.iter().enumerate().filter(|(_, state)| state.side().is_none()) {
            mode.column_mut(contact).fill(0.0);
        }
        mode.select_rows(&shared.kept)
    }

    /// The oriented determinant p, 1 without friction, from what is kept of `C S`.
    fn oriented(&self, kept: &DMatrix<f64>, states: &[ContactState]) -> f64 {
        match &self.shared {
            Some(shared) => shared.oriented(kept, states, &self.stiffness),
            None => kept.determinant(),
        }
    }
}

/// The elastic joints of a mechanism without friction in hinges, with its mode problem.
#[derive(Debug, Clone)]
pub struct ElasticGuides<'p> {
    problem: &'p ModeProblem,
    joints: ElasticJoints,
}

impl<'p> ElasticGuides<'p> {
    /// The elastic guides of a mechanism with these equations and this mode problem.
    pub fn new(mechanism: &Mechanism, equations: &KineticEquations, problem: &'p ModeProblem) -> Self {
        Self { problem, joints: ElasticJoints::new(mechanism, equations, &[]) }
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
        self.joints.shared.is_some().then(|| self.oriented_determinant(states))
    }

    /// The oriented determinant p of a mode, 1 without friction.
    pub(crate) fn oriented_determinant(&self, states: &[ContactState]) -> f64 {
        let states = self.joints.closed(states);
        self.joints.oriented(&self.joints.kept(mode_matrix(self.problem, &states), &states), &states)
    }

    /// The verdict on the mode with these sides alone: neither how it depends on stiffnesses nor what the
    /// solution separates is examined.
    pub fn verdict_on(&self, states: &[ContactState]) -> Verdict {
        let states = self.joints.closed(states);
        let examined = self.joints.examined(mode_matrix(self.problem, &states), &states);
        examined.map_or_else(|none| none.verdict, |(.., attainability)| attainability.verdict)
    }

    /// The attainability of the mode with these sides, without what an unattainable solution separates.
    pub(crate) fn of(&self, states: &[ContactState]) -> Attainability {
        let states = self.joints.closed(states);
        self.joints.of(mode_matrix(self.problem, &states), &states)
    }

    /// The attainability of a solution in which nothing presses some contacts, if the sides on which these are make no difference:
    /// none if they do.
    ///
    /// Their friction follows the magnitude of their forces, so that the fast motion is linear on each side alone. If all sides
    /// have the same eigenvalues, all principal minors of the response of these forces to that friction vanish: it never acts back on
    /// them. They then move as without it, and the rest is a linear motion that they disturb from outside.
    pub(crate) fn of_unpressed(&self, states: &[ContactState], unpressed: &[usize]) -> Option<Attainability> {
        if let Err((verdict, reason)) = &self.joints.inertia {
            return Some(Attainability::without_eigenvalues(*verdict, reason));
        }
        if unpressed.len() > MOST_UNPRESSED {
            return None;
        }
        let on = |sides: usize| {
            let mut states = states.to_vec();
            for (index, &contact) in unpressed.iter().enumerate() {
                let is_other = sides >> index & 1 == 1;
                states[contact] = if is_other { ContactState::Negative } else { ContactState::Positive };
            }
            let states = self.joints.closed(&states);
            let (_, spectrum, attainability) =
                self.joints.examined(mode_matrix(self.problem, &states), &states).ok()?;
            Some((spectrum, attainability.verdict))
        };
        let (first, verdict) = on(0)?;
        let same = |sides| on(sides).is_some_and(|(other, told)| told == verdict && other.is_like(&first));
        (1..1 << unpressed.len()).all(same).then(|| self.of(states))
    }

    /// What each unattainable solution separates.
    fn fates(&self, candidates: &[Candidate], all: &mut [Attainability]) {
        let ElasticJoints { inertia, stiffness, shared, .. } = &self.joints;
        let few = stiffness.len() <= MOST_CONTACTS_OF_FATES && candidates.len() <= MOST_SOLUTIONS;
        let is_rigid = shared.as_ref().is_some_and(|shared| shared.rigid);
        let none = all.iter().all(|one| one.verdict != Verdict::Unattainable);
        let (Ok(inertia), true) = (inertia, few && !none && !is_rigid) else { return };
        let Some(mobility) = inertia.inverse(VANISHING_SHARE) else { return };
        let stays = |one: &Attainability| matches!(one.verdict, Verdict::Attainable | Verdict::Flutter);
        let numbers: Vec<usize> = (0..all.len()).filter(|&index| stays(&all[index])).collect();
        let closed: Vec<_> =
            candidates.iter().map(|candidate| self.joints.closed(&candidate.states)).collect();
        let rest = |index: usize| {
            let Candidate { normal_force, deflections, .. } = &candidates[index];
            let states = &closed[index];
            // The law of a face of a press fit begins where it touches.
            let interference = |k: usize| shared.as_ref().map_or(0.0, |shared| shared.interference[k]);
            let deflection = |k: usize| match deflections.get(k).copied().flatten() {
                Some(deflection) => deflection - interference(k),
                None => -normal_force[k] / stiffness[k],
            };
            let kept = |shared: &SharedGaps| shared.kept.iter().map(|&k| deflection(k)).collect::<Vec<_>>();
            let gap = shared.as_ref().map_or_else(|| (0..states.len()).map(deflection).collect(), kept);
            Rest { states, normal_force, gap: DVector::from_vec(gap) }
        };
        let targets: Vec<Rest<'_>> = numbers.iter().map(|&index| rest(index)).collect();
        let motion = FastMotion::new(self.problem, mobility, stiffness, shared.as_ref());
        let Some(mut motion) = motion else { return };
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
        "{coordinate} is measured in another place or direction than {0} acts. Held exactly there, {unstable}. Measure \
         {coordinate} where {0} acts: `{measure}` in [coordinates.{coordinate}]",
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
