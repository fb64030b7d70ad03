//! Decisions by trying every combination, for mechanisms whose blocks have no height.

use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::kinetics::ConstraintRow;
use crate::mechanism::{CoordinateKind, Mechanism};
use crate::modes::Side;
use crate::motion::moving::equations::{Equations, sliding_joints};
use crate::motion::{
    ContactPhase, Continuation, Continuations, Decisions, EventInstant, HaltingImpulse, JointPhase, Phase,
};
use crate::report::Verdict;
use nalgebra::Vector2;

pub(super) struct TryAll;

const TOLERANCE: f64 = 1e-9;

impl TryAll {
    fn admits(equations: &mut Equations<'_>, instant: &EventInstant<'_>, phase: &Phase) -> bool {
        let state = equations.state_of(instant.configuration);
        if equations.enter(phase, instant.configuration.time, &state).is_err() {
            return false;
        }
        let scale = equations.greatest_force();
        let joints = equations.sliders.clone();
        joints.iter().enumerate().all(|(index, joint)| {
            let slider = instant.mechanism.slider(*joint).unwrap();
            match phase.joints[index] {
                JointPhase::Sticking => Self::margin(equations, phase) >= -TOLERANCE * scale,
                JointPhase::Sliding(sign) => {
                    let sides = slider.contacts.iter().all(|contact| {
                        let k = contact.index();
                        match phase.contacts[k] {
                            ContactPhase::Pressed(side) => {
                                side.sign() * equations.normal_force(k) >= -TOLERANCE * scale
                            }
                            ContactPhase::PreloadGap => {
                                equations.share(k).is_some_and(|share| (0.0..=1.0).contains(&share))
                            }
                        }
                    });
                    sides
                        && (instant.signs[index] != 0.0
                            || sign * sliding_acceleration(equations, index) > -1e-12)
                }
            }
        })
    }

    fn margin(equations: &Equations<'_>, phase: &Phase) -> f64 {
        let mut stuck = 0;
        let mut margin = f64::INFINITY;
        for (index, joint) in equations.sliders.iter().enumerate() {
            if phase.joints[index] == JointPhase::Sticking {
                let slider = equations.mechanism.slider(*joint).unwrap();
                let limit: f64 = slider
                    .contacts
                    .iter()
                    .map(|contact| {
                        let law = &equations.mechanism.contacts[contact.index()];
                        law.mu_static[0] * equations.normal_force(contact.index()).abs() + law.preload[0]
                    })
                    .sum();
                margin = margin.min(limit - equations.tangential_force(stuck).abs());
                stuck += 1;
            }
        }
        margin
    }
}

fn sliding_acceleration(equations: &Equations<'_>, index: usize) -> f64 {
    let mut row = ConstraintRow::empty();
    let kind = CoordinateKind::Slide(equations.sliders[index]);
    row.set_coordinate(equations.mechanism, &equations.configuration, kind);
    let accelerations = equations.accelerations();
    row.entries.iter().map(|&(column, value)| value * accelerations[column]).sum::<f64>()
        - row.right_hand_side
}

impl Decisions for TryAll {
    fn successors(&mut self, instant: &EventInstant<'_>) -> Result<Continuations, Faults> {
        let mut equations = Equations::new(instant.mechanism, instant.configuration);
        let joints = sliding_joints(instant.mechanism);
        let choices: Vec<Vec<JointPhase>> = (0..joints.len())
            .map(|index| {
                if instant.signs[index] == 0.0 {
                    vec![JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)]
                } else {
                    vec![JointPhase::Sliding(instant.signs[index])]
                }
            })
            .collect();
        let contacts = vec![
            vec![ContactPhase::Pressed(Side::Positive), ContactPhase::Pressed(Side::Negative)];
            instant.mechanism.contacts.len()
        ];
        let mut list = Vec::new();
        for joints in product(&choices) {
            let sticks = |k: usize| {
                let joint = instant.mechanism.contacts[k].joint;
                let index =
                    sliding_joints(instant.mechanism).iter().position(|other| *other == joint).unwrap();
                joints[index] == JointPhase::Sticking
            };
            for contacts in product(&contacts) {
                let redundant = (0..contacts.len())
                    .any(|k| sticks(k) && contacts[k] == ContactPhase::Pressed(Side::Negative));
                let phase = Phase { joints: joints.clone(), contacts, hinges: Vec::new() };
                if !redundant && Self::admits(&mut equations, instant, &phase) {
                    let continues = Some(&phase) == instant.previous;
                    list.push(Continuation {
                        phase,
                        verdict: Verdict::NotComputed,
                        continues,
                        impulse: None,
                    });
                }
            }
        }
        Ok(Continuations { list, left_out: false })
    }

    /// Brings everything to rest.
    fn jam(&mut self, instant: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
        let rest = Velocity { linear: Vector2::zeros(), angular: 0.0 };
        Ok(Some(HaltingImpulse {
            velocities: vec![rest; instant.mechanism.bodies.len()],
            energy_lost: crate::motion::moving::energy::kinetic(instant.mechanism, instant.configuration),
        }))
    }

    fn sticking_margin(
        &mut self,
        mechanism: &Mechanism,
        configuration: &Configuration,
        phase: &Phase,
    ) -> Result<f64, Faults> {
        let mut equations = Equations::new(mechanism, configuration);
        let state = equations.state_of(configuration);
        equations.enter(phase, configuration.time, &state).unwrap();
        Ok(Self::margin(&equations, phase))
    }
}

fn product<T: Clone>(choices: &[Vec<T>]) -> Vec<Vec<T>> {
    choices.iter().fold(vec![Vec::new()], |all, choices| {
        all.iter()
            .flat_map(|start| {
                choices.iter().map(move |next| [start.as_slice(), std::slice::from_ref(next)].concat())
            })
            .collect()
    })
}
