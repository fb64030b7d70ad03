//! Which questions a model can answer in its state.

use super::{Finding, Question};
use crate::configuration::Configuration;
use crate::fault::{FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::motion::{SimulateOptions, Thorough, simulate_with};
use crate::progress::{Progress, Work};
use crate::standstill::can_hold;
use std::ops::ControlFlow;

impl Question {
    /// The commands that ask it.
    pub(super) fn names(&self) -> &'static [&'static str] {
        match self.name {
            "solve" => &["solve", "limits", "size", "sweep", "map"],
            "drive" => &["drive"],
            "hold" => &["hold"],
            _ => &["simulate"],
        }
    }

    fn new(name: &'static str, faults: &Faults) -> Self {
        let kinds: Vec<&FaultKind> = faults.sorted().into_iter().map(|fault| &fault.kind).collect();
        // What is not simple leaves the rest untold.
        let needs: Option<Vec<&'static str>> = kinds.iter().map(|kind| need(kind)).collect();
        Self {
            name,
            ready: kinds.is_empty(),
            findings: kinds.iter().map(|kind| Finding::of(kind)).collect(),
            needs: needs.unwrap_or_default(),
        }
    }
}

/// Something that a model lacks, if that is easily given.
fn need(kind: &FaultKind) -> Option<&'static str> {
    match kind {
        FaultKind::ZeroSlidingVelocity { .. } => Some("a rate"),
        FaultKind::MotionWithoutInertia { .. } => Some("a mass (or a drive)"),
        FaultKind::NoDrives { .. } => Some("a drive"),
        _ => None,
    }
}

/// All questions, with what stands in the way of `solve`.
pub(super) fn questions(
    (model, mechanism): (&Model, &Mechanism),
    configuration: Option<&Configuration>,
    of_solve: &Faults,
    work: Work<'_>,
) -> Vec<Question> {
    let drive = model.has_drives().err().unwrap_or_else(|| of_solve.clone());
    // Without a state there is nothing to ask of it.
    let within = |answer: &dyn Fn(&Configuration) -> Result<(), Faults>| match configuration {
        Some(configuration) => answer(configuration).err().unwrap_or_default(),
        None => of_solve.clone(),
    };
    // Whether the motion can begin, and no further.
    let begins = |configuration: &Configuration| {
        let options = SimulateOptions::new(1.0);
        // After the first step: how it begins has been decided.
        let mut stop = |progress: &Progress| {
            if progress.done > 0 { ControlFlow::Break(()) } else { work.flow() }
        };
        simulate_with(mechanism, configuration, &options, &mut Thorough, &mut stop).map(|_| ())
    };
    vec![
        Question::new("solve", of_solve),
        Question::new("drive", &drive),
        Question::new("hold", &within(&|_| can_hold(model, work))),
        Question::new("simulate", &within(&begins)),
    ]
}
