//! A motion as a table: one row for each time.

use crate::configuration::unit;
use crate::ids::{BodyId, ContactId};
use crate::kinetics::ConstraintRow;
use crate::mechanism::Mechanism;
use crate::motion::decision::{DeterminedForces, determined_forces};
use crate::motion::record::history::{HingeSample, History, Sample};
use crate::pattern::{HingePhase, Phase};
use crate::units::number::beside;
use nalgebra::DVector;
use serde::Serialize;
use std::fmt::Write;

/// Names that tables use themselves: a coordinate with such a name gets the prefix `coordinate.` there.
const RESERVED: [&str; 5] = ["mode", "units", "model", "command", "program"];
/// Times closer to the end than this fraction of the step count as the end.
const AT_END: f64 = 1e-9;

/// A motion as a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// The numbers; the first column is the time.
    pub columns: Vec<Column>,
    /// The contact mode of each row, as the [pattern](crate::motion::Phase::pattern) of its phase.
    pub modes: Vec<String>,
}

/// A column of numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Name of the quantity, such as `phi.rate` or `upper.normal_force`.
    pub name: String,
    /// Its unit; empty for pure numbers.
    pub unit: &'static str,
    /// One for each row; `None` where the quantity is undefined: friction forces of sticking joints, and
    /// normal forces that statics leaves open there, because they depend on how the contacts share the
    /// friction.
    pub values: Vec<Option<f64>>,
}

impl Series {
    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// As comma-separated values: a line of names with units, then a line for each time; what is not defined is left
    /// empty. The mode is the last column.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        for column in &self.columns {
            let _ = write!(text, "{} ({}),", column.name, column.unit);
        }
        text.push_str("mode\n");
        for (row, mode) in self.modes.iter().enumerate() {
            for column in &self.columns {
                if let Some(value) = column.values[row] {
                    let _ = write!(text, "{value:?}");
                }
                text.push(',');
            }
            text.push_str(mode);
            text.push('\n');
        }
        text
    }
}

impl History {
    /// Times from the start in steps of this length (s), and the end.
    pub fn times_in_steps(&self, step: f64) -> Vec<f64> {
        let (start, stop) = (self.start(), self.stop());
        let multiples = (0_u32..).map(|index| start + f64::from(index) * step);
        let mut times: Vec<f64> = multiples.take_while(|time| *time < stop - AT_END * step).collect();
        times.push(stop);
        times
    }

    /// The motion at these times; times outside of it are omitted. At an event, the row shows what follows.
    ///
    /// Columns are `t`, then for each coordinate its value (`coordinate.NAME` where the name alone is taken:
    /// `mode`, `units`, `model`, `command`, `program`), rate and acceleration, for each contact its normal
    /// force, friction force and sliding velocity, for each hinge with friction the magnitude of its force, its friction
    /// couple and its angular velocity, for each drive its effort, and the energies: kinetic,
    /// potential, dissipated by the friction of all contacts and hinges, work of loads and of drives, lost in impulses.
    ///
    /// ```
    /// use slideway::model::Model;
    /// use slideway::motion::{SimulateOptions, simulate};
    ///
    /// let text = slideway::gallery::find("frictional-oscillator").expect("in the gallery").text;
    /// let history = simulate(&Model::parse(text)?, &SimulateOptions::new(1.0))?;
    /// let series = history.series(&history.times_in_steps(0.1));
    /// assert_eq!(series.modes.len(), 11);
    /// // The spring alone would bring it to x = v_0 sqrt(m/k) = 0.126 m at most.
    /// let x = series.column("x").expect("a coordinate");
    /// assert!(x.values.iter().flatten().all(|x| x.abs() < 0.127));
    /// # Ok::<(), slideway::fault::Faults>(())
    /// ```
    pub fn series(&self, times: &[f64]) -> Series {
        let mechanism = &self.mechanism;
        let mut columns = columns(mechanism);
        let mut modes = Vec::with_capacity(times.len());
        let patterns: Vec<String> =
            self.phases.iter().map(|interval| interval.phase.pattern(mechanism)).collect();
        let mut reader = self.reader();
        let mut row = Vec::with_capacity(columns.len());
        for sample in times.iter().filter_map(|time| reader.at(*time)) {
            row.clear();
            let phase = self.phases.get(sample.phase).map(|interval| &interval.phase);
            values((mechanism, phase), &sample, &self.determined_forces(&sample), &mut row);
            columns.iter_mut().zip(&row).for_each(|(column, value)| column.values.push(*value));
            modes.push(patterns.get(sample.phase).cloned().unwrap_or_default());
        }
        Series { columns, modes }
    }

    /// The normal force and the friction of each contact at a sample (N); nothing where joints stick and statics leaves it
    /// open. Friction is positive against positive sliding.
    pub fn forces(&self, sample: &Sample) -> Vec<[Option<f64>; 2]> {
        self.determined_forces(sample).contacts
    }

    /// The forces at a sample; nothing where statics leaves them open.
    fn determined_forces(&self, sample: &Sample) -> DeterminedForces {
        let phase = self.phases.get(sample.phase).map(|interval| &interval.phase);
        let Some(phase) = phase.filter(|phase| phase.sticks()) else {
            let contacts = sample.contacts.iter();
            let hinge = |hinge: &HingeSample| [Some(hinge.force[0]), Some(hinge.force[1]), hinge.couple];
            return DeterminedForces {
                contacts: contacts
                    .map(|contact| [Some(contact.normal_force), contact.friction_force])
                    .collect(),
                hinges: sample.hinges.iter().map(hinge).collect(),
            };
        };
        let hinges = phase.hinges.iter().zip(&sample.hinges);
        let hinges = hinges.map(|(hinge, now)| HingePhase { force: now.force, ..*hinge }).collect();
        let phase = Phase { hinges, ..phase.clone() };
        let found = determined_forces(&self.mechanism, &sample.configuration, &phase);
        found.unwrap_or_else(|_| DeterminedForces {
            contacts: vec![[None; 2]; sample.contacts.len()],
            hinges: vec![[None; 3]; sample.hinges.len()],
        })
    }
}

fn columns(mechanism: &Mechanism) -> Vec<Column> {
    let mut columns = Vec::new();
    let mut add = |name: String, unit| columns.push(Column { name, unit, values: Vec::new() });
    add("t".to_owned(), "s");
    for coordinate in &mechanism.coordinates {
        let name = &coordinate.name;
        let units = if coordinate.kind.is_angle() { ["rad/s", "rad/s^2"] } else { ["m/s", "m/s^2"] };
        let is_reserved = RESERVED.contains(&&**name);
        add(
            if is_reserved { format!("coordinate.{name}") } else { name.to_string() },
            unit(&coordinate.kind),
        );
        add(format!("{name}.rate"), units[0]);
        add(format!("{name}.acceleration"), units[1]);
    }
    for contact in &mechanism.contacts {
        add(format!("{}.normal_force", contact.name), "N");
        add(format!("{}.friction_force", contact.name), "N");
        add(format!("{}.sliding_velocity", contact.name), "m/s");
        if contact.opens {
            add(format!("{}.gap", contact.name), "m");
        }
    }
    for name in (0..mechanism.friction_circles.len()).map(|circle| mechanism.circle_name(circle)) {
        add(format!("{name}.force"), "N");
        add(format!("{name}.couple"), "N m");
        add(format!("{name}.angular_velocity"), "rad/s");
    }
    for drive in &mechanism.drives {
        let is_force = matches!(drive.effort, crate::mechanism::Effort::Force { .. });
        add(format!("{}.effort", drive.name), if is_force { "N" } else { "N m" });
    }
    for name in ["kinetic", "potential", "friction", "loads", "drives", "impulses"] {
        add(format!("energy.{name}"), "J");
    }
    columns
}

/// The numbers of a row, in the order of the columns: 0 where they are rounding errors beside those of the bodies, and the gap of what
/// touches in the phase.
fn values(
    (mechanism, phase): (&Mechanism, Option<&Phase>),
    sample: &Sample,
    forces: &DeterminedForces,
    row: &mut Vec<Option<f64>>,
) {
    let configuration = &sample.configuration;
    // Nothing moves out of the plane.
    let of_bodies = |mut in_plane: Vec<f64>| {
        in_plane.resize(mechanism.accelerations(), 0.0);
        DVector::from_vec(in_plane)
    };
    let accelerations = of_bodies(sample.accelerations.as_flattened().to_vec());
    let velocities = configuration.velocities.iter();
    let velocities =
        of_bodies(velocities.flat_map(|one| [one.linear.x, one.linear.y, one.angular]).collect());
    row.push(Some(configuration.time));
    let mut equation = ConstraintRow::empty();
    let states = mechanism.coordinates.iter().zip(configuration.coordinates.iter().zip(&configuration.rates));
    for (coordinate, (value, rate)) in states {
        equation.set_coordinate(mechanism, configuration, coordinate.kind);
        let rate = if equation.acceleration(&velocities, true) == 0.0 { 0.0 } else { *rate };
        row.extend([Some(*value), Some(rate), Some(equation.acceleration(&accelerations, false))]);
    }
    for (k, (contact, [normal_force, friction])) in sample.contacts.iter().zip(&forces.contacts).enumerate() {
        let slider = mechanism.slider(mechanism.contacts[k].joint);
        let bodies =
            slider.into_iter().flat_map(|slider| [slider.block.body(), slider.guide.body()]).flatten();
        let speed = |body: BodyId| configuration.velocities[body.index()].linear.norm();
        let sliding = beside(contact.sliding_velocity, bodies.map(speed).fold(0.0, f64::max));
        row.extend([*normal_force, *friction, Some(sliding)]);
        if mechanism.contacts[k].opens {
            let touches = phase.is_some_and(|phase| !phase.is_open(mechanism, k));
            let gap = || configuration.gap(mechanism, ContactId(k))[0];
            row.push(Some(if touches { 0.0 } else { gap() }));
        }
    }
    let hinges = sample.hinges.iter().zip(&forces.hinges).zip(&mechanism.friction_circles);
    for ((hinge, [x, y, couple]), circle) in hinges {
        row.extend([x.zip(*y).map(|(x, y)| circle.magnitude([x, y])), *couple, Some(hinge.spin)]);
    }
    row.extend(sample.efforts.iter().map(|effort| Some(*effort)));
    let energy = &sample.energy;
    let sum = |list: &[f64]| Some(list.iter().sum());
    let friction = energy.friction.iter().chain(&energy.hinges).sum();
    row.extend([Some(energy.kinetic), Some(energy.potential), Some(friction)]);
    row.extend([sum(&energy.loads), sum(&energy.drives), Some(energy.impulses)]);
}
