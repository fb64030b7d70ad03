//! The varied quantities of a sweep, and its points.

use super::CHUNKS;
use super::columns::Columns;
use super::friction::FrictionFormulas;
use super::quantity::{Kind, TIME};
use super::rows::Breakpoint;
use super::stages::Stages;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::model::{Model, Setting, SettingKind};
use crate::modes::screen::MOST_CONTACTS;
use crate::solve::Trail;
use std::sync::Arc;

/// The varied quantities, and what has to be computed anew at every point.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    pub(super) model: Model,
    pub(super) mechanism: Mechanism,
    pub(super) varied: Vec<Kind>,
    pub(super) columns: Columns,
    /// If parameters change nothing but friction: how.
    pub(super) friction: Option<FrictionFormulas>,
    pub(super) attainability: bool,
    /// The stages of all points, if they are the same.
    pub(super) stages: Option<Stages>,
}

impl Plan {
    /// True if position, velocities and loads are the same at all points.
    pub(super) fn same_state(&self) -> bool {
        let keeps = |kind: &Kind| matches!(kind, Kind::Parameter(_) | Kind::Friction);
        self.friction.is_some() && self.varied.iter().all(keeps)
    }

    /// Computes what is the same at all points; whatever is refused there is left to each of them.
    pub(super) fn prepare(&mut self) {
        if !self.same_state() {
            return;
        }
        self.stages = Stages::along(&mut Trail::default(), &self.mechanism, &self.columns).ok();
        if let Some(stages) = &self.stages
            && stages.configuration.put_misalignments(&mut self.mechanism).is_err()
        {
            self.stages = None;
        }
    }

    /// How many points are computed one after another.
    pub(super) fn chunk(&self) -> u64 {
        let [by_elimination, by_search] = CHUNKS;
        if self.mechanism.contacts.len() <= MOST_CONTACTS { by_elimination } else { by_search }
    }

    /// The factor of all friction of a point.
    pub(super) fn factor(&self, values: &[f64]) -> f64 {
        let place = self.varied.iter().position(|kind| *kind == Kind::Friction);
        place.map_or(1.0, |place| values[place])
    }

    /// The model of a point.
    ///
    /// # Errors
    /// Values that the model does not allow.
    pub(super) fn model_at(&self, values: &[f64]) -> Result<Model, Faults> {
        let (parameters, coordinates) = (&self.model.parameters, &self.model.coordinates);
        let mut settings = Vec::with_capacity(values.len());
        let mut friction = 1.0;
        for (kind, value) in self.varied.iter().zip(values) {
            let (kind, name) = match *kind {
                Kind::Friction => {
                    friction = *value;
                    continue;
                }
                Kind::Parameter(index) => (SettingKind::Parameter, &*parameters[index].name),
                Kind::Coordinate(index) => (SettingKind::Position, &*coordinates[index].name),
                Kind::Rate(index) => (SettingKind::Rate, &*coordinates[index].name),
                Kind::Time => (SettingKind::Time, TIME),
            };
            settings.push((Setting::new(kind, name, *value), Arc::from(name)));
        }
        Ok(self.model.varied_with(&settings)?.with_friction(friction))
    }
}

/// A point that is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point<'v> {
    pub(super) number: u64,
    pub(super) breakpoint: Breakpoint,
    pub(super) inserted: bool,
    pub(super) values: &'v [f64],
}
