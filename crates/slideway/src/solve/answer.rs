//! From the solutions of the mode problem back to the mechanism: every force and acceleration of each
//! solution.

use super::attainability::not_computed;
use super::distinct::distinct;
use super::equilibrium::{Balance, Residual};
use super::found::SearchFound;
use super::friction::friction;
use super::parts::contact_couples;
use super::resting::Resting;
use super::stages::Stages;
use super::state::{State, in_gap, pattern, point, pressed, regular, signs, states_of};
use super::words::joint_mode;
use crate::configuration::{Configuration, unit};
use crate::enclosure::{EnclosedOutputs, Tipping};
use crate::fault::Faults;
use crate::ids::{BodyId, ContactId, Frame, JointId};
use crate::influence::{ContactFriction, HingeState, Influence};
use crate::interval::Interval;
use crate::kinetics::{KineticEquations, Opening, Reaction, gap_acceleration, velocity_of_effort};
use crate::law::tips;
use crate::mechanism::{FrictionCircle, JointKind, Mechanism, Slider};
use crate::model::SliderKind;
use crate::modes::{
    Certificate, ClosestMode, ContactState, GroupReport, PatternOutcomes, SharedLoad, SingularMode,
    SolutionSet, UndecidedPattern,
};
use crate::report::{self, CarriedQuantity, Elasticity, Proof, SolveReport, SpeedChange, Status, Stopping};
use nalgebra::DVector;

/// Solutions of the equations in which a guided slider would tip.
#[derive(Default)]
pub(super) struct Tipped {
    count: u64,
    pub(super) rejected: Vec<report::Rejection>,
    /// Guided sliders of which bounds do not prove that they tip.
    unproven: Vec<String>,
}

impl Tipped {
    /// What is open of it.
    pub(super) fn unproven(&self) -> impl Iterator<Item = String> {
        self.unproven.iter().map(|joint| format!("that {joint} tips is not proven"))
    }
}

/// Solutions, and states of preload gaps.
#[derive(Default)]
struct States {
    solutions: Vec<report::Solution>,
    gaps: Vec<report::Solution>,
}

/// A mechanism in its state, with the stages that lead to its mode problem.
pub(super) struct Answer<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) configuration: &'a Configuration,
    pub(super) equations: &'a KineticEquations,
    pub(super) influence: &'a Influence,
    pub(super) velocity_signs: &'a DVector<f64>,
    /// For each contact, whether the right-hand side of the mode problem jumps with its side.
    pub(super) jumps: Vec<bool>,
    /// How redundant guides share their load, and what is taken for their elasticity.
    pub(super) shared: Option<SharedLoad>,
    pub(super) elasticity: Option<Elasticity>,
    /// Bounds of what follows from the forces in the exact mechanism, if they could be enclosed.
    pub(super) enclosed: Option<&'a EnclosedOutputs>,
}

impl<'a> Answer<'a> {
    /// That of a mechanism whose guides share no load, without bounds of the exact numbers.
    pub(super) fn determinate(stages: &'a Stages, equations: &'a KineticEquations) -> Self {
        let Stages { mechanism, configuration, influence, velocity_signs, .. } = stages;
        Self {
            mechanism,
            configuration,
            equations,
            influence,
            velocity_signs,
            jumps: vec![false; mechanism.contacts.len()],
            elasticity: None,
            shared: None,
            enclosed: None,
        }
    }

    /// That of a mechanism with these bounds of the exact numbers.
    ///
    /// # Errors
    /// Nothing says how redundant guides share their load.
    pub(super) fn of(
        stages: &'a Stages,
        equations: &'a KineticEquations,
        enclosed: Option<&'a EnclosedOutputs>,
    ) -> Result<Self, Faults> {
        let (shared, elasticity) = (stages.shared_load()?, stages.elasticity()?);
        Ok(Self { shared, elasticity, enclosed, ..Self::determinate(stages, equations) })
    }

    /// The report on all solutions.
    pub(super) fn report(&self, found: &SearchFound<'_>) -> Result<SolveReport, Faults> {
        let lists = found.lists();
        let mut tipping = Tipped::default();
        let mut states = States::default();
        let mut keep = |state: &State<'_>| self.keep(state, &mut states, &mut tipping);
        for solution in &lists.solutions {
            let pattern = pressed(&solution.pattern);
            let normal_force = Resting::refined_forces(self, &pattern, &solution.normal_force);
            keep(&State { normal_force: &normal_force, ..regular(solution, &pattern) });
        }
        let singular: Vec<SingularMode> =
            lists.singular.iter().map(|mode| self.without_tipping(mode)).collect();
        singular.iter().filter_map(point).for_each(|state| keep(&state));
        lists.gaps.iter().for_each(|gap| keep(&in_gap(gap)));
        let States { solutions, gaps } = states;
        let mut solutions = distinct(solutions, &[]);
        self.examine(&mut solutions)?;
        let gaps = distinct(gaps, &solutions);
        let continua: Vec<_> = singular.iter().filter_map(|mode| self.continuum(mode)).collect();
        let undetermined = self.undetermined(&continua);
        for (mode, _) in lists.singular.iter().zip(&singular).filter(|(mode, cut)| tips_everywhere(mode, cut))
        {
            tipping.count += mode.pattern_count;
            let first = mode.set.vertices().first().and_then(|vertex| self.tipping_at(mode, vertex));
            tipping.rejected.extend(first);
        }
        let [count, gap_state_count] = found.counts(&lists, [solutions.len(), gaps.len()]);
        let mut open = found.open();
        open.extend(tipping.unproven());
        let undecided = !lists.undecided.is_empty() || found.is_partial();
        let outcomes = found.result.outcomes();
        Ok(SolveReport {
            status: status(undecided, solutions.len(), gaps.len(), continua.len()),
            partial: found.is_partial(),
            count,
            gap_state_count,
            strategy: found.result.strategy(),
            nodes: found.result.nodes(),
            patterns: outcomes.map(|outcomes| pattern_summary(outcomes, tipping.count)),
            solutions,
            preload_gap_states: gaps,
            continua,
            undetermined,
            undecided_modes: lists.undecided.iter().map(|mode| self.undecided_mode(mode)).collect(),
            locked_modes: outcomes.map_or_else(Vec::new, |outcomes| self.locked_modes(&outcomes.locked)),
            rejected: tipping.rejected,
            closest_modes: outcomes.map_or_else(Vec::new, |outcomes| {
                outcomes.closest.iter().map(|mode| self.closest_mode(mode)).collect()
            }),
            jammed_groups: self.jammed_groups(found),
            ..self.report_without_solutions(open)
        })
    }

    /// What a report says of the mechanism, and what is left open; no solution.
    pub(super) fn report_without_solutions(&self, open: Vec<String>) -> SolveReport {
        SolveReport {
            schema: report::SCHEMA,
            status: Status::None,
            complete: if open.is_empty() { Proof::Proven } else { Proof::NotProven },
            partial: false,
            open,
            count: "0".to_owned(),
            gap_state_count: "0".to_owned(),
            strategy: String::new(),
            nodes: 0,
            model: self.model(),
            state: self.state(),
            rates_not_given: Vec::new(),
            at_rest: Vec::new(),
            every_load_has_one_state: None,
            time: self.configuration.time,
            steps_from_drawing: self.configuration.steps_from_drawing(),
            patterns: None,
            solutions: Vec::new(),
            preload_gap_states: Vec::new(),
            continua: Vec::new(),
            undetermined: None,
            undecided_modes: Vec::new(),
            locked_modes: Vec::new(),
            rejected: Vec::new(),
            closest_modes: Vec::new(),
            jammed_groups: Vec::new(),
            jam_impulses: None,
            margins: None,
            margins_missing: None,
            unique_at_least: None,
            from_rest: None,
            one_face_hints: Vec::new(),
            sharing: None,
            uncertainty: None,
            influence: self.influence_summary(),
            condition: self.equations.condition(),
        }
    }

    /// The contacts without normal force where the others do not hold the block: it floats within its play.
    fn floating(&self, signs: &[i8]) -> Vec<usize> {
        let open = &self.mechanism.excess.open;
        if open.holds(&states_of(signs)) {
            return Vec::new();
        }
        (0..signs.len()).filter(|&k| signs[k] == 0 && open.shares(k)).collect()
    }

    /// By how much a contact is displaced against its guide (m): -(delta + f N) where it is pressed towards +n,
    /// delta - f N towards -n, between -delta and delta where it is open; none where it shares no load, or only
    /// ratios of stiffnesses are known, and where the block floats. The open face of a press fit moves with the other
    /// one.
    fn deflection(&self, state: &State<'_>, normal_forces: &[f64], contact: usize) -> Option<f64> {
        let shared = self.shared.as_ref().filter(|_| {
            self.mechanism.excess.shares(ContactId(contact)) && self.elasticity != Some(Elasticity::Equal)
        })?;
        if self.floating(&state.signs).contains(&contact) {
            return None;
        }
        let face = self.mechanism.contacts[contact].face;
        let contact = match face {
            Some(face) if normal_forces[contact] == 0.0 => face.other.index(),
            _ => contact,
        };
        let clearance = self.mechanism.contacts[contact].play / 2.0;
        let yielding = shared.compliance[contact] * normal_forces[contact];
        Some(match state.pattern[contact] {
            ContactState::Positive => -clearance - yielding,
            ContactState::Negative => clearance - yielding,
            ContactState::Gap => clearance * (1.0 - 2.0 * state.shares[contact].unwrap_or(0.5)),
        })
    }

    /// Files the states of the mechanism that a state of the mode problem stands for, unless a guided slider
    /// would tip.
    fn keep(&self, state: &State<'_>, states: &mut States, tipping: &mut Tipped) {
        for faces in self.faces(state) {
            let kept = self.kept(&faces.state(state), tipping);
            let is_solution = self.mechanism.excess.open.is_solution(faces.states());
            let kind = if is_solution { &mut states.solutions } else { &mut states.gaps };
            kind.extend(kept);
        }
    }

    /// A state as a solution, unless a guided slider would tip in it.
    pub(super) fn kept(&self, state: &State<'_>, tipping: &mut Tipped) -> Option<report::Solution> {
        let unknowns = self.unknowns(state);
        match self.tipping(state, &unknowns) {
            None => Some(self.solution(state, &unknowns)),
            Some(rejection) => {
                tipping.count += 1;
                if !self.certainly_tips(state) {
                    tipping.unproven.push(rejection.joint.clone());
                }
                tipping.rejected.push(rejection);
                None
            }
        }
    }

    /// All unknowns of the equations in a state, without their rounding.
    pub(super) fn unknowns(&self, state: &State<'_>) -> DVector<f64> {
        self.equations.without_noise(&self.refined(state))
    }

    /// All unknowns of the equations in a state: where contacts lift off, whose forces while they are closed cancel, refined.
    pub(super) fn refined(&self, state: &State<'_>) -> DVector<f64> {
        let friction = self.friction(state);
        let of_contacts = self.influence.unknowns(&friction, state.normal_force);
        let unknowns = of_contacts + self.influence.of_couples(state.hinges);
        if !self.can_be_refined(state.pattern) {
            return unknowns;
        }
        let faces = friction.iter().map(|friction| [friction.positive_face, friction.negative_face]);
        let openings = self.influence.openings.iter();
        let gaps = openings.map(|Opening { contact, acceleration, .. }| {
            (ContactId(*contact), (-state.normal_force[*contact]).max(0.0) * acceleration)
        });
        let couples = state.hinges.iter().map(|hinge| (hinge.circle, hinge.couple));
        self.equations.refined(&unknowns, faces, couples, gaps)
    }

    /// True if contacts lift off, and what others carry does not depend on how they share it.
    pub(super) fn can_be_refined(&self, pattern: &[ContactState]) -> bool {
        self.mechanism.opening(pattern).next().is_some() && self.mechanism.excess.is_empty()
    }

    /// Whether bounds of the exact numbers prove that a guided slider tips; where there are none it is not
    /// their fault.
    fn certainly_tips(&self, state: &State<'_>) -> bool {
        let always = |(enclosed, unknowns): (&EnclosedOutputs, &[Interval])| {
            enclosed.tipping(state.pattern, unknowns) == Tipping::Always
        };
        self.enclosed_state(state).map_or(self.enclosed.is_none() || state.hinges.is_empty(), always)
    }

    /// What the exact mechanism has of a state: bounds of what follows from forces, and of the forces. With friction in
    /// hinges none where the side of a contact is not certain, of which what follows may be another one.
    fn enclosed_state<'s>(&self, state: &'s State<'_>) -> Option<(&'a EnclosedOutputs, &'s [Interval])> {
        let is_certain = state.hinges.is_empty() || !state.on_boundary;
        self.enclosed.filter(|_| is_certain).zip(state.certificate.unknowns())
    }

    /// The groups of contacts that admit nothing, where several groups were searched one by one.
    fn jammed_groups(&self, found: &SearchFound<'_>) -> Vec<Vec<String>> {
        if found.result.groups.len() < 2 || found.is_partial() {
            return Vec::new();
        }
        let names = |group: &GroupReport| {
            group.contacts.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect()
        };
        found.result.barren_groups().map(names).collect()
    }

    fn undecided_mode(&self, mode: &UndecidedPattern) -> report::UndecidedMode {
        report::UndecidedMode {
            pattern: pattern(&mode.pattern),
            joints: self.joint_modes(&signs(&mode.pattern)),
            contacts: mode.in_doubt.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect(),
        }
    }

    fn model(&self) -> report::ModelSummary {
        report::ModelSummary {
            title: self.mechanism.title.clone(),
            degrees_of_freedom: self.mechanism.coordinates.len(),
            bodies: self.mechanism.bodies.len(),
            contacts: self.mechanism.places().count(),
            drives: self.mechanism.drives.len(),
            size: self.mechanism.size,
            units: self.mechanism.units.clone(),
        }
    }

    fn state(&self) -> Vec<report::CoordinateState> {
        let Configuration { coordinates, rates, .. } = self.configuration;
        let values = coordinates.iter().zip(rates);
        let one = |(coordinate, (value, rate)): (&crate::mechanism::Coordinate, (&f64, &f64))| {
            report::CoordinateState {
                name: coordinate.name.to_string(),
                unit: unit(&coordinate.kind),
                value: *value,
                rate: *rate,
            }
        };
        self.mechanism.coordinates.iter().zip(values).map(one).collect()
    }

    /// Friction forces of a state, split by the face at which they act: eq. (2) with
    /// F_k = (mu_k |N_k| + F_k0) s_k.
    pub(super) fn friction(&self, state: &State<'_>) -> Vec<ContactFriction> {
        let mut all =
            friction(self.mechanism, self.velocity_signs, state.pattern, state.normal_force, &state.shares);
        for held in state.held {
            all[held.contact].positive_face += held.friction.positive_face;
            all[held.contact].negative_face += held.friction.negative_face;
        }
        all
    }

    /// A guided slider whose couple is more than its pressure can give: |C| <= |N| L / 2 (theory, section 1).
    pub(super) fn tipping(&self, state: &State<'_>, unknowns: &DVector<f64>) -> Option<report::Rejection> {
        let greatest = self.equations.applied.iter().map(|load| load.force.norm()).fold(0.0, f64::max);
        let greatest = greatest.max(state.normal_force.amax());
        self.guided_sliders().find_map(|(joint, slider)| {
            let couple = self.couple(joint, unknowns)?;
            let normal_force = state.normal_force[slider.contacts[0].index()].abs();
            let limit = slider.greatest_couple(normal_force);
            tips(couple, limit, greatest * slider.length).then(|| report::Rejection {
                pattern: pattern(state.pattern),
                joint: self.mechanism.joints[joint.index()].name.to_string(),
                couple,
                limit,
                normal_forces: state.normal_force.iter().copied().collect(),
                friction_forces: self.friction(state).iter().map(|friction| friction.total()).collect(),
                couples: contact_couples(self.mechanism, self.influence, unknowns),
                efforts: self.drives(unknowns).iter().map(|drive| drive.effort).collect(),
            })
        })
    }

    pub(super) fn guided_sliders(&self) -> impl Iterator<Item = (JointId, &'a Slider)> {
        self.mechanism.sliders().filter(|(_, slider)| slider.kind == SliderKind::Guided)
    }

    fn couple(&self, joint: JointId, unknowns: &DVector<f64>) -> Option<f64> {
        Some(unknowns[self.influence.layout().reaction(Reaction::Couple(joint))?])
    }

    fn solution(&self, state: &State<'_>, unknowns: &DVector<f64>) -> report::Solution {
        let friction = self.friction(state);
        let residuals = self.residuals(state, unknowns, &friction);
        let orientation: f64 = state.pattern.iter().map(|contact| contact.sign()).product();
        let floating = self.floating(&state.signs);
        let is_about_to_change = |k: &usize| state.signs[*k] == 0 && !floating.contains(k);
        report::Solution {
            pattern: pattern(state.pattern),
            patterns: state.patterns.clone(),
            rests: false,
            signs: state.signs.clone(),
            on_boundary: state.on_boundary
                && (floating.is_empty() || (0..state.signs.len()).any(|k| is_about_to_change(&k))),
            floating: floating.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect(),
            certificate: self.certificate(state),
            margin: None,
            determinant: state.determinant,
            oriented_determinant: state.determinant * orientation,
            attainability: not_computed("the preload acts between the faces"),
            contacts: self.contacts(state, unknowns, &friction),
            joints: self.joint_modes(&state.signs),
            hinges: self.hinges(state, unknowns),
            round_ends: self.round_ends(state),
            carried: self.carried(state, unknowns),
            bodies: self.bodies(unknowns, &residuals),
            coordinates: self.coordinates(state, unknowns),
            friction_exceeds_loads: self.friction_exceeds_loads(state),
            drives: self.drives(unknowns),
            residual: residuals.iter().map(|residual| residual.relative).fold(0.0, f64::max),
        }
    }

    fn certificate(&self, state: &State<'_>) -> report::CertificateKind {
        match state.certificate {
            Certificate::Proven { unknowns } => {
                let tipping = self.enclosed.map(|enclosed| enclosed.tipping(state.pattern, unknowns));
                if tipping.is_none_or(|tipping| tipping == Tipping::Never) {
                    report::CertificateKind::Proven
                } else {
                    report::CertificateKind::OnBoundary
                }
            }
            Certificate::NotProven => report::CertificateKind::NotProven,
            Certificate::Boundary { .. }
            | Certificate::Singular
            | Certificate::OnBoundaryWithinBounds { .. } => report::CertificateKind::OnBoundary,
        }
    }

    fn residuals(
        &self,
        state: &State<'_>,
        unknowns: &DVector<f64>,
        friction: &[ContactFriction],
    ) -> Vec<Residual> {
        let mut normal_force = state.normal_force.clone();
        self.mechanism.put_out_of_open(state.pattern, normal_force.as_mut_slice(), 0.0);
        let balance = Balance {
            mechanism: self.mechanism,
            configuration: self.configuration,
            contacts: &self.equations.contacts,
            applied: &self.equations.applied,
            layout: self.influence.layout(),
            unknowns,
            normal_force: &normal_force,
            friction,
            hinges: state.hinges,
        };
        balance.residuals()
    }

    fn contacts(
        &self,
        state: &State<'_>,
        unknowns: &DVector<f64>,
        friction: &[ContactFriction],
    ) -> Vec<report::Contact> {
        let at_faces = |forces: Vec<f64>| self.mechanism.forces_at_faces(state.pattern, forces);
        let normal_forces = at_faces(state.normal_force.iter().copied().collect());
        let mut friction = at_faces(friction.iter().map(|friction| friction.total()).collect());
        for (contact, force) in self.mechanism.friction_of_ends(state.hinges) {
            friction[contact] += force;
        }
        let bounds = self.bounds(state);
        let acceleration = |k: usize| {
            let state = (ContactId(k), unknowns);
            gap_acceleration(self.mechanism, self.configuration, &self.equations.contacts, state)
        };
        let opens = |k: usize| self.mechanism.contacts[k].opens && state.pattern[k] == ContactState::Negative;
        let one = |k: usize| {
            let contact = &self.mechanism.contacts[k];
            report::Contact {
                name: contact.name.to_string(),
                side: state.signs[k],
                // Adding zero turns -0 into 0.
                normal_force: normal_forces[k] + 0.0,
                normal_force_bounds: bounds.as_ref().map(|bounds| bounds[k]),
                friction_force: friction[k] + 0.0,
                sliding_velocity: self.equations.contacts[k].sliding_velocity,
                couple: self.couple(contact.joint, unknowns),
                pressure: contact.pressure(normal_forces[k]),
                preload_share: state.shares[k].filter(|_| self.mechanism.preload_jumps(ContactId(k))),
                deflection: self.deflection(state, &normal_forces, k),
                gap_acceleration: opens(k).then(|| acceleration(k)),
            }
        };
        (0..state.pattern.len()).map(one).collect()
    }

    /// Proven bounds of the normal forces.
    fn bounds(&self, state: &State<'_>) -> Option<Vec<[f64; 2]>> {
        let signed = |(state, absolute): (&ContactState, &Interval)| match state {
            ContactState::Positive => *absolute,
            ContactState::Negative => -*absolute,
            ContactState::Gap => Interval::ZERO,
        };
        let forces = state.pattern.iter().zip(state.certificate.unknowns()?).map(signed);
        Some(self.mechanism.bounds_at_faces(state.pattern, forces.collect()))
    }

    pub(super) fn joint_modes(&self, signs: &[i8]) -> Vec<report::JointMode> {
        joint_modes(self.mechanism, self.configuration, signs)
    }

    fn hinges(&self, state: &State<'_>, unknowns: &DVector<f64>) -> Vec<report::Hinge> {
        let joints = self.mechanism.joints.iter().enumerate();
        let one = |(index, joint): (usize, &crate::mechanism::Joint)| {
            let JointKind::Hinge(ends) = &joint.kind else { return None };
            let component = |axis| {
                let index = self.influence.layout().reaction(Reaction::Hinge(JointId(index), axis))?;
                Some(unknowns[index])
            };
            // On ground the force is of no interest: count it on the body then.
            let (on, sign) = match ends[0].frame.body() {
                Some(_) => (ends[0].frame, 1.0),
                None => (ends[1].frame, -1.0),
            };
            Some(report::Hinge {
                name: joint.name.to_string(),
                on: self.mechanism.frame_name(on).to_owned(),
                force: [sign * component(0)?, sign * component(1)?],
                friction: self.rubbing(state, JointId(index), false).map(|hinge| report::HingeFriction {
                    couple: sign * hinge.couple + 0.0,
                    radius: self.mechanism.friction_circles[hinge.circle].radius,
                    angular_velocity: sign * self.configuration.spin(self.mechanism, hinge.joint) + 0.0,
                }),
            })
        };
        joints.filter_map(one).collect()
    }

    /// The friction of a hinge, or of its collar.
    fn rubbing<'s>(&self, state: &'s State<'_>, joint: JointId, collar: bool) -> Option<&'s HingeState> {
        let circles = &self.mechanism.friction_circles;
        let mut all = state.hinges.iter();
        all.find(|hinge| hinge.joint == joint && circles[hinge.circle].is_collar() == collar)
    }

    fn round_ends(&self, state: &State<'_>) -> Vec<report::RoundEnd> {
        let one = |(index, circle): (usize, &FrictionCircle)| {
            let end = circle.end?;
            let [along_n, along_z] = end.map(|contact| state.normal_force[contact.index()]);
            let rubs = state.hinges.iter().find(|hinge| hinge.circle == index);
            Some(report::RoundEnd {
                name: self.mechanism.contacts[end[0].index()].name.to_string(),
                normal_force: along_n.hypot(along_z),
                direction: along_z.atan2(along_n),
                // What is counted of a friction circle acts on the block along u. Adding zero turns -0 into 0.
                friction_force: rubs.map_or(0.0, |hinge| -hinge.couple) + 0.0,
            })
        };
        self.mechanism.friction_circles.iter().enumerate().filter_map(one).collect()
    }

    /// The accelerations out of the plane of a body that leaves it.
    fn leaves_plane(&self, body: BodyId, unknowns: &DVector<f64>) -> Option<[f64; 3]> {
        let (first, _) = self.mechanism.out_of_plane(Frame::Body(body))?;
        let accelerations = [0, 1, 2].map(|axis| unknowns[first + axis] + 0.0);
        accelerations.iter().any(|acceleration| *acceleration != 0.0).then_some(accelerations)
    }

    /// What joints carry out of the drawing, on the body of theirs that is not ground, and the friction of collars.
    fn carried(&self, state: &State<'_>, unknowns: &DVector<f64>) -> Vec<report::Carried> {
        let layout = self.influence.layout();
        let one = |(index, reaction): (usize, &Reaction)| {
            let Reaction::Carried(id, component) = *reaction else { return Vec::new() };
            let joint = &self.mechanism.joints[id.index()];
            let [first, second] = joint.joined().frames;
            let (on, sign) = if first.body().is_some() { (first, 1.0) } else { (second, -1.0) };
            let quantity = match (&joint.kind, component) {
                (_, 0) => CarriedQuantity::ForceZ,
                (JointKind::Hinge(_), 1) => CarriedQuantity::MomentX,
                (JointKind::Hinge(_), _) => CarriedQuantity::MomentY,
                (JointKind::Slider(_), 1) => CarriedQuantity::Roll,
                (JointKind::Slider(_), _) => CarriedQuantity::Pitch,
            };
            let told = |quantity, value: f64| report::Carried {
                name: joint.name.to_string(),
                on: self.mechanism.frame_name(on).to_owned(),
                quantity,
                // Adding zero turns -0 into 0.
                value: sign * value + 0.0,
                unit: if quantity == CarriedQuantity::ForceZ { "N" } else { "N m" },
            };
            let collar = self.rubbing(state, id, true).filter(|_| component == 0);
            let collar = collar.map(|hinge| told(CarriedQuantity::Collar, hinge.couple));
            let force = told(quantity, unknowns[layout.accelerations() + index]);
            [force].into_iter().chain(collar).collect()
        };
        layout.reactions().iter().enumerate().flat_map(one).collect()
    }

    fn bodies(&self, unknowns: &DVector<f64>, residuals: &[Residual]) -> Vec<report::Body> {
        let one = |(index, residual): (usize, &Residual)| {
            let first = self.influence.layout().acceleration(BodyId(index));
            report::Body {
                name: self.mechanism.bodies[index].name.to_string(),
                acceleration: [unknowns[first], unknowns[first + 1]],
                angular_acceleration: unknowns[first + 2],
                out_of_plane: self.leaves_plane(BodyId(index), unknowns),
                residual_force: residual.force,
                residual_moment: residual.moment,
            }
        };
        residuals.iter().enumerate().map(one).collect()
    }

    fn coordinates(&self, state: &State<'_>, unknowns: &DVector<f64>) -> Vec<report::CoordinateAcceleration> {
        let accelerations = self.equations.coordinate_accelerations(unknowns);
        let one = |(index, acceleration): (usize, f64)| {
            let coordinate = &self.mechanism.coordinates[index];
            let bounds = self.acceleration_bounds(state, index);
            let speed = self.mechanism.is_free(index).then(|| SpeedChange::of(coordinate.rate, bounds));
            let slows = speed == Some(SpeedChange::SlowsDown);
            report::CoordinateAcceleration {
                name: coordinate.name.to_string(),
                unit: if coordinate.kind.is_angle() { "rad/s^2" } else { "m/s^2" },
                acceleration,
                acceleration_bounds: bounds,
                speed,
                stop: if slows { Stopping::of(coordinate.rate, acceleration) } else { None },
            }
        };
        accelerations.into_iter().enumerate().map(one).collect()
    }

    /// Proven bounds of the acceleration of a coordinate.
    fn acceleration_bounds(&self, state: &State<'_>, coordinate: usize) -> Option<[f64; 2]> {
        let (enclosed, unknowns) = self.enclosed_state(state)?;
        let bounds = enclosed.acceleration(coordinate, state.pattern, unknowns);
        bounds.magnitude().is_finite().then_some([bounds.lower(), bounds.upper()])
    }

    /// Whether bounds prove that the power of the loads is positive and less than that of friction.
    fn friction_exceeds_loads(&self, state: &State<'_>) -> bool {
        let bounds = self.enclosed_state(state);
        let exceeds = |(enclosed, unknowns): (&EnclosedOutputs, &[Interval])| {
            let [loads, left] = enclosed.power(state.pattern, unknowns);
            loads.lower() > 0.0 && left.upper() < 0.0
        };
        self.mechanism.drives.is_empty() && bounds.is_some_and(exceeds)
    }

    pub(super) fn drives(&self, unknowns: &DVector<f64>) -> Vec<report::Drive> {
        let one = |(drive, effort): (&crate::mechanism::Drive, f64)| report::Drive {
            name: drive.name.to_string(),
            unit: drive.effort.unit(),
            effort,
            holds_back: effort * velocity_of_effort(self.mechanism, self.configuration, &drive.effort) < 0.0,
        };
        self.mechanism.drives.iter().zip(self.influence.efforts(unknowns)).map(one).collect()
    }

    fn locked_modes(&self, singular: &[SingularMode]) -> Vec<report::LockedMode> {
        let is_locked = |mode: &&SingularMode| {
            mode.set == SolutionSet::Empty && !mode.pattern.contains(&ContactState::Gap)
        };
        let locked = singular.iter().filter(is_locked);
        locked
            .map(|mode| report::LockedMode {
                pattern: pattern(&mode.pattern),
                joints: self.joint_modes(&signs(&mode.pattern)),
                factor: 1.0,
            })
            .collect()
    }

    fn closest_mode(&self, mode: &ClosestMode) -> report::ClosestMode {
        let pressed = pressed(&mode.pattern);
        report::ClosestMode {
            pattern: pattern(&pressed),
            determinant: mode.determinant,
            oriented_determinant: mode.oriented_determinant,
            joints: self.joint_modes(&signs(&pressed)),
            absolute_normal_forces: mode.y.iter().copied().collect(),
        }
    }

    fn influence_summary(&self) -> report::InfluenceSummary {
        let rows = |side: usize| {
            let eta = self.influence.eta(side);
            eta.row_iter().map(|row| row.iter().copied().collect()).collect()
        };
        let without_friction = self.data().without_friction();
        report::InfluenceSummary {
            coordinate_accelerations: self.equations.coordinate_accelerations(&without_friction),
            normal_forces: self.influence.normal_forces().iter().copied().collect(),
            drives: self.drives(&without_friction),
            eta_positive: rows(0),
            eta_negative: rows(1),
        }
    }
}

/// Whether nothing is left of a continuum because a guided slider would tip.
fn tips_everywhere(mode: &SingularMode, cut: &SingularMode) -> bool {
    mode.set.is_continuum() && cut.set == SolutionSet::Empty
}

pub(super) fn status(undecided: bool, solutions: usize, gaps: usize, continua: usize) -> Status {
    match (solutions, gaps, continua) {
        (_, _, 1..) => Status::Continuum,
        (0, 0, 0) if undecided => Status::Unknown,
        (0, 0, 0) => Status::None,
        (0, _, 0) => Status::PreloadGap,
        (1, _, 0) => Status::One,
        _ => Status::Several,
    }
}

fn pattern_summary(outcomes: &PatternOutcomes, rejected: u64) -> report::PatternSummary {
    let counts = outcomes.counts;
    report::PatternSummary {
        total: counts.total(),
        solution: counts.solution,
        boundary: counts.boundary,
        no_solution: counts.no_solution,
        singular_without_solution: counts.singular_empty,
        singular_with_point: counts.singular_point,
        singular_with_continuum: counts.singular_continuum,
        undecided: counts.not_examined + counts.undecided,
        rejected,
        gap_patterns: outcomes.gap_counts.total(),
    }
}

/// The contact mode of each sliding joint, by the signs of all normal forces.
pub(crate) fn joint_modes(
    mechanism: &Mechanism,
    configuration: &Configuration,
    signs: &[i8],
) -> Vec<report::JointMode> {
    let one = |(joint, slider): (JointId, &Slider)| {
        let tangent = configuration.slide(mechanism, slider).tangent;
        let signs: Vec<i8> = slider.contacts.iter().map(|contact| signs[contact.index()]).collect();
        let name = mechanism.joints[joint.index()].name.to_string();
        report::JointMode::new(name, joint_mode(mechanism, slider, tangent, &signs))
    };
    // What is apart has no mode.
    mechanism.sliders().filter(|(_, slider)| !slider.contacts.is_empty()).map(one).collect()
}
