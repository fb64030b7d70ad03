//! What a solution has to keep along a branch.

use nalgebra::DVector;

use super::family::Instance;
use super::place::{Equations, Place};
use crate::existence::{EndCause, Meaning, cause_of};
use crate::problem::{BlockNumbers, ContactState, Side};

/// Conditions missed by less than this share of the largest unknown are met.
const SLIGHT: f64 = 1e-12;
/// What is below this share at an end vanishes there.
const VANISHES: f64 = 1e-9;

/// A condition at a place, met where its value is not negative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Condition {
    pub(super) meaning: Meaning,
    pub(super) value: f64,
}

/// A condition as a linear function of the homogeneous unknowns and of the lengths of hinge forces.
#[derive(Debug, Clone)]
pub(super) struct Rule {
    pub(super) meaning: Meaning,
    pub(super) weights: DVector<f64>,
    pub(super) lengths: DVector<f64>,
}

/// All conditions at a place; normal forces count up to `greatest`.
pub(super) fn conditions(
    equations: &Equations,
    instance: &Instance,
    place: &Place,
    greatest: Option<f64>,
) -> Vec<Condition> {
    let contacts = equations.states.len();
    let value = |rule: Rule| {
        let lengths =
            (0..rule.lengths.len()).map(|hinge| rule.lengths[hinge] * place.length(contacts, hinge));
        Condition { meaning: rule.meaning, value: rule.weights.dot(&place.z) + lengths.sum::<f64>() }
    };
    rules(equations, instance, greatest).into_iter().map(value).collect()
}

/// All conditions on solutions with these states of the contacts.
pub(super) fn rules(equations: &Equations, instance: &Instance, greatest: Option<f64>) -> Vec<Rule> {
    let hinges = instance.problem.hinges();
    let load = equations.states.len() + 2 * hinges;
    let rule = |meaning: Meaning, entries: &[(usize, f64)]| {
        let mut weights = DVector::zeros(load + 1);
        entries.iter().for_each(|&(row, weight)| weights[row] += weight);
        Rule { meaning, weights, lengths: DVector::zeros(hinges) }
    };
    let mut all = vec![rule(Meaning::Finite, &[(load, 1.0)])];
    for (contact, state) in equations.states.iter().enumerate() {
        match state {
            Some(ContactState::Gap) => {
                all.push(rule(Meaning::Gap(contact), &[(contact, 1.0)]));
                all.push(rule(Meaning::Gap(contact), &[(load, 1.0), (contact, -1.0)]));
            }
            Some(state) => {
                all.push(rule(Meaning::Side(contact), &[(contact, state.sign())]));
                all.extend(greatest.map(|greatest| {
                    let entries = [(load, greatest / equations.unit), (contact, -state.sign())];
                    rule(Meaning::Greatest(contact), &entries)
                }));
            }
            None => {}
        }
    }
    for (index, bound) in instance.bounds.iter().enumerate() {
        let output = output(&instance.outputs, equations, bound.output, (load, hinges));
        for sign in [1.0, -1.0] {
            let mut rule = rule(Meaning::Bound(index), &[]);
            rule.weights.axpy(sign, &output.weights, 1.0);
            rule.lengths.axpy(sign, &output.lengths, 1.0);
            if let Some(state) = equations.states[bound.contact] {
                rule.weights[bound.contact] += bound.factor * state.sign();
            }
            all.push(rule);
        }
    }
    all
}

/// Whether all conditions are met, but for rounding.
pub(super) fn are_met(conditions: &[Condition]) -> bool {
    conditions.iter().all(|condition| condition.value >= -SLIGHT)
}

/// By how much a condition may be missed along a branch that begins with this: what vanishes there may be rounding
/// throughout.
pub(super) fn slack(condition: &Condition) -> f64 {
    if condition.value > SLIGHT { 0.0 } else { SLIGHT }
}

/// Why a branch ends at a place beyond which some of these conditions are not met; none if all are met.
pub(super) fn cause(here: &[Condition], beyond: &[Condition]) -> Option<EndCause> {
    let is_left = |wanted: &Condition| wanted.value < 0.0;
    let vanishes = |(here, beyond): &(&Condition, &Condition)| {
        beyond.value < 0.0 || here.value.abs().min(beyond.value.abs()) <= VANISHES
    };
    let vanishing: Vec<Meaning> =
        here.iter().zip(beyond).filter(vanishes).map(|(condition, _)| condition.meaning).collect();
    let left: Vec<Meaning> =
        beyond.iter().filter(|one| is_left(one)).map(|condition| condition.meaning).collect();
    cause_of(&left, &vanishing)
}

/// An output as a linear function, in the unit of forces.
fn output(outputs: &BlockNumbers, equations: &Equations, row: usize, (load, hinges): (usize, usize)) -> Rule {
    let (unit, contacts) = (equations.unit, equations.states.len());
    let mut weights = DVector::zeros(load + 1);
    weights[load] = outputs.load[row] / unit;
    for (contact, state) in equations.states.iter().enumerate() {
        let jump = |side: Side| outputs.jumps.get(side)[(row, contact)] / unit;
        match state.map(|state| (state, state.side())) {
            Some((state, Some(side))) => {
                weights[contact] += outputs.response.get(side)[(row, contact)] * state.sign();
                weights[load] += jump(side);
            }
            Some((_, None)) => {
                weights[contact] += jump(Side::Positive) - jump(Side::Negative);
                weights[load] += jump(Side::Negative);
            }
            None => weights[load] += jump(Side::Positive),
        }
    }
    let lengths = DVector::from_fn(hinges, |hinge, _| outputs.response.positive[(row, contacts + hinge)]);
    Rule { meaning: Meaning::Finite, weights, lengths }
}
