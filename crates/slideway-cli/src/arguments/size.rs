//! `slideway size`

use super::values::{Limit, choice, efficiency, effort, force, positive, pressure};
use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::Args;
use slideway::choice::Choice;
use slideway::fault::Faults;
use slideway::model::Model;
use slideway::size::{Against, FrictionMargin};
use slideway::units::Unit;

pub(super) const HELP: &str = "\
Examples:
  slideway size drawer.toml --vary L               how long the guide must be
  slideway size drawer.toml --vary L --margin 2    with a safety factor of 2
  slideway size drawer.toml --vary a --margin 1.5 --both-directions
  slideway size drawer.toml --vary L --margin 2 --plot margin.svg
  slideway size drawer.toml --vary L --max-effort 30N
  slideway size drawer.toml --vary L --min-efficiency 70%
  slideway size drawer.toml --vary L --max-normal-force 25N
  slideway size ladder.toml --vary climbed --margin 1.2 --against hold
  slideway size bracket-on-pole.toml --vary x --margin 1.5 --load W \\
    --against hold
  slideway size cam-follower.toml --vary phi --margin 2 --load cam \\
    --against self-locking

The margin is a factor on friction. Its meaning depends on --against:
  locking       for what must move: kinetic friction may grow by it before no
                motion is possible
  self-locking  for what must come loose: static friction may grow by it before
                the load is held however great it is
  hold          for what must hold, as a clamp or a ladder: static friction may
                be divided by it while all loads are held as they are, or with
                --load while this one is held however great it is
The load of a margin at rest can be the effort of a drive. --max-pressure needs
a `pad`, the area in contact, at the sliding joints of the model.

Without a range, a coefficient of friction goes from 0 to 1 or to twice its
value, `friction` from 0 to 10, and both beyond where it is known to jam. An
angle with a unit goes over its quarter turn (45 deg: 0 to 90 deg; 90 deg: 0 to
180 deg), any other parameter from a fifth of its value to five times its value.

Exit codes:
  0    the margin is met somewhere in the range
  1    it is met nowhere in the range
  2    invalid input: the model, the settings, the name, the range or the
       arguments; or nothing is varied
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// The margin of what just does not lock.
const JUST: f64 = 1.0;

/// Arguments of `slideway size`.
#[derive(Debug, Args)]
pub(crate) struct SizeArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// What to size: a parameter, a coordinate, or `friction` for a factor on all coefficients of friction. Without it,
    /// the quantities of the model are listed.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Option<String>,

    #[command(flatten)]
    limit: Wanted,

    /// What the margin guards against.
    #[arg(long, default_value = FrictionMargin::default().word(), value_parser = choice::<FrictionMargin>())]
    against: FrictionMargin,

    /// What a margin or limit concerns: the load of a margin at rest (of self-locking by default the only one), the drive of
    /// --max-effort, or the contact of --max-normal-force or --max-pressure (by default all of them).
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

/// What is wanted.
#[derive(Debug, Args)]
#[group(multiple = false)]
struct Wanted {
    /// The wanted margin, a factor on friction. With 1, the default, it just does not lock.
    #[arg(long, value_name = "FACTOR", value_parser = positive, allow_hyphen_values = true)]
    margin: Option<f64>,

    /// Instead of a margin: no drive may need more than this, such as "30 N" or "2 N m".
    #[arg(long, value_name = "EFFORT", value_parser = effort, conflicts_with = "against")]
    max_effort: Option<Limit>,

    /// Instead of a margin: no normal force may be greater than this, such as "2 kN".
    #[arg(long, value_name = "FORCE", value_parser = force, conflicts_with = "against")]
    max_normal_force: Option<Limit>,

    /// Instead of a margin: no bearing pressure may be greater than this, such as "2 MPa" or "2 N/mm^2". It is the
    /// normal force over length times width of the contact's `pad` in the model.
    #[arg(long, value_name = "PRESSURE", value_parser = pressure, conflicts_with = "against")]
    max_pressure: Option<Limit>,

    /// Instead of a margin: the efficiency may not be lower than this, such as 0.7 or "70 %".
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
    /// The wanted margin, or the limit that is to be kept; by default the margin at which it just does not lock.
    pub(crate) fn wanted(&self) -> f64 {
        let limit = self.limit.of_answers().map(|limit| limit.value);
        self.limit.margin.or(limit).unwrap_or(JUST)
    }

    /// The unit in which the limit was typed, if it has one.
    pub(crate) fn typed_in(&self) -> Option<Unit> {
        self.limit.of_answers().and_then(|limit| limit.unit.clone())
    }

    /// Against what, with the load, drive or contact that it concerns.
    ///
    /// # Errors
    /// A margin at rest without a load where the model has several, one of motion with a load.
    pub(crate) fn against(&self, model: &Model) -> Result<Against, Faults> {
        let load = self.load.clone();
        if self.limit.max_effort.is_some() {
            return Ok(Against::Effort { drive: load });
        }
        if self.limit.max_normal_force.is_some() {
            return Ok(Against::NormalForce { contact: load });
        }
        if self.limit.max_pressure.is_some() {
            return Ok(Against::Pressure { contact: load });
        }
        if self.limit.min_efficiency.is_some() {
            return Against::efficiency(load);
        }
        Against::margin(self.against, load, model)
    }
}
