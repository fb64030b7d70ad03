//! `slideway size`

use super::values::{Limit, efficiency, effort, force, positive, pressure};
use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::{Args, ValueEnum};
use slideway::fault::{Fault, FaultKind, Faults};
use slideway::model::Model;
use slideway::size;
use slideway::standstill::only_load;
use slideway::units::Unit;

pub(super) const HELP: &str = "\
Examples:
  slideway size drawer.toml --vary L --margin 2                how long the guide must be
  slideway size drawer.toml --vary a --margin 1.5 --both-directions
  slideway size drawer.toml --vary L --margin 2 --plot margin.svg
  slideway size cam-follower.toml --vary A=\"0 m..0.2 m\" --margin 2
  slideway size bracket-on-pole.toml --vary x --margin 1.5 --against hold
  slideway size cam-follower.toml --vary phi --margin 2 --against self-locking --load cam
  slideway size drawer.toml --vary L --max-effort 30N          how long for a push of 30 N
  slideway size drawer.toml --vary L --min-efficiency 70%
  slideway size drawer.toml --vary L --max-normal-force 25N

The margin against locking is the factor by which all kinetic friction may grow before there is no
solution. At rest it concerns a load, or the effort of a drive. Against self-locking it is the
factor by which static friction may grow before the load is held however great it is. With
`--against hold` the load must be held, and it is the factor by which static friction may be
divided. Without a range, a coefficient of friction goes from 0 to 1 or twice its value, `friction`
from 0 to 10, an angle that has a unit over its quarter turn (45 deg: 0 to 90 deg; 90 deg: 0 to
180 deg), any other parameter from a fifth of its value to five times its value. For
`--max-pressure 2MPa` the sliding joints of the model need a `pad`, their area in contact.

Exit codes:
  0    the margin is met somewhere in the range
  1    it is met nowhere in the range
  2    invalid input: the model, the settings, the name or the range, the arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway size`.
#[derive(Debug, Args)]
pub(crate) struct SizeArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// What to size: a parameter, a coordinate, or `friction` for a factor on all coefficients of friction.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: String,

    #[command(flatten)]
    limit: Wanted,

    /// Against what.
    #[arg(long, value_enum, default_value_t)]
    against: Against,

    /// The load, or the drive whose effort is the load, for a margin at rest, by default the only load; the drive of --max-effort, or the
    /// contact of --max-normal-force or --max-pressure, by default all of them.
    #[arg(long, value_name = "NAME")]
    load: Option<String>,

    /// Use the smaller margin of both directions of motion.
    #[arg(long)]
    pub(crate) both_directions: bool,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) plot: PlotArguments,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// Against what there is to be a margin.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Against {
    /// Locking in motion.
    #[default]
    Locking,
    /// Self-locking at rest under the load.
    SelfLocking,
    /// Slipping at rest: the load must be held however great it is.
    Hold,
}

/// What is wanted.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Wanted {
    /// The wanted margin: a factor on friction.
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    margin: Option<f64>,

    /// Instead of a margin: no solution may need more effort of a drive than this, such as "30 N".
    #[arg(long, value_name = "EFFORT", value_parser = effort, conflicts_with = "against")]
    max_effort: Option<Limit>,

    /// Instead of a margin: no solution may have a greater normal force than this, such as "2 kN".
    #[arg(long, value_name = "FORCE", value_parser = force, conflicts_with = "against")]
    max_normal_force: Option<Limit>,

    /// Instead of a margin: no solution may have a greater bearing pressure than this, such as "2 MPa" or
    /// "2 N/mm^2": normal force over length times width of the contact's `pad` in the model.
    #[arg(long, value_name = "PRESSURE", value_parser = pressure, conflicts_with = "against")]
    max_pressure: Option<Limit>,

    /// Instead of a margin: no solution may have a lower efficiency than this, such as 0.7 or "70 %".
    #[arg(long, value_name = "RATIO", value_parser = efficiency, conflicts_with = "against")]
    min_efficiency: Option<Limit>,
}

impl Wanted {
    /// The limit in place of a margin.
    fn of_answers(&self) -> Option<&Limit> {
        let Self { max_effort, max_normal_force, max_pressure, min_efficiency, .. } = self;
        [max_effort, max_normal_force, max_pressure, min_efficiency].into_iter().find_map(Option::as_ref)
    }
}

impl SizeArguments {
    /// The wanted margin, or the limit that is to be kept.
    pub(crate) fn wanted(&self) -> f64 {
        let limit = self.limit.of_answers().map(|limit| limit.value);
        self.limit.margin.or(limit).unwrap_or_default()
    }

    /// The unit in which the limit was typed, if it has one.
    pub(crate) fn typed_in(&self) -> Option<Unit> {
        self.limit.of_answers().and_then(|limit| limit.unit.clone())
    }

    /// Against what, with the load, drive or contact that it concerns.
    ///
    /// # Errors
    /// A margin at rest without a load where the model has several, one of motion with a load.
    pub(crate) fn against(&self, model: &Model) -> Result<size::Against, Faults> {
        if self.limit.max_effort.is_some() {
            return Ok(size::Against::Effort { drive: self.load.clone() });
        }
        if self.limit.max_normal_force.is_some() {
            return Ok(size::Against::NormalForce { contact: self.load.clone() });
        }
        if self.limit.max_pressure.is_some() {
            return Ok(size::Against::Pressure { contact: self.load.clone() });
        }
        if self.limit.min_efficiency.is_some() {
            return match &self.load {
                None => Ok(size::Against::Efficiency),
                Some(load) => Err(Fault::general(FaultKind::LoadUnused { load: load.clone() }).into()),
            };
        }
        let load = || self.load.clone().map_or_else(|| only_load(model), Ok);
        match (self.against, self.load.clone()) {
            (Against::Locking, None) => Ok(size::Against::Locking),
            (Against::Locking, Some(load)) => Err(Fault::general(FaultKind::LoadUnused { load }).into()),
            (Against::SelfLocking, _) => Ok(size::Against::SelfLocking { load: load()? }),
            (Against::Hold, _) => Ok(size::Against::Hold { load: load()? }),
        }
    }
}
