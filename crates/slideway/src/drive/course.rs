//! The efforts over a parameter, a coordinate or friction.

use super::efforts::Efforts;
use super::report::{BlowUp, CourseDirection, CourseRow};
use super::state::growing_ends;
use crate::fault::Faults;
use crate::limits::{Found, LimitsOptions, Varied, find, guarantee};
use crate::solve::{Stages, pattern};

/// Rows nearer to a blow-up than this share of the range give way to it.
const SAME_ROW: f64 = 1e-9;

/// The efforts in one direction of motion, and what can be missed.
///
/// # Errors
/// Too many modes; a fault if nothing varies.
pub(super) fn direction(
    varied: &Varied,
    range: [f64; 2],
    steps: usize,
    direction: &'static str,
) -> Result<(String, CourseDirection), Faults> {
    let found = find(varied, range, &LimitsOptions::of(&varied.name))?;
    let stages = Stages::new(varied.model())?;
    let blow_ups = growing_ends(&found.existence, &stages, |value| Efforts::at(varied, value).ok());
    let course = Tabulated { varied, range, found: &found, blow_ups: &blow_ups };
    let rows = course.rows(steps);
    let gaps = found.gaps.clone();
    let guarantee = guarantee(&found, range);
    Ok((guarantee, CourseDirection { direction, rows, blow_ups, without_mode_problem: gaps }))
}

/// What the rows are made of.
struct Tabulated<'c> {
    varied: &'c Varied,
    range: [f64; 2],
    found: &'c Found,
    blow_ups: &'c [BlowUp],
}

impl Tabulated<'_> {
    /// Evenly spaced values, and those of blow-ups.
    fn rows(&self, steps: usize) -> Vec<CourseRow> {
        let [from, to] = self.range;
        let room = SAME_ROW * (to - from);
        let even = (0..=steps)
            .map(|step| if step == steps { to } else { from + (to - from) * step as f64 / steps as f64 });
        let is_free = |value: &f64| self.blow_ups.iter().all(|blow_up| (blow_up.at - value).abs() > room);
        let mut rows: Vec<CourseRow> = even.filter(is_free).flat_map(|value| self.rows_at(value)).collect();
        rows.extend(self.blow_ups.iter().map(|blow_up| CourseRow {
            at: blow_up.at,
            pattern: Some(blow_up.pattern.clone()),
            grows: blow_up.efforts.clone(),
            ..nothing(blow_up.at)
        }));
        rows.sort_by(|one, other| one.at.total_cmp(&other.at));
        rows
    }

    fn rows_at(&self, value: f64) -> Vec<CourseRow> {
        let Ok(efforts) = Efforts::at(self.varied, value) else { return vec![nothing(value)] };
        let [from, to] = self.range;
        let is_end = value == from || value == to;
        let present = self.found.existence.modes.iter().filter(|mode| {
            let within = mode.from.at < value && value < mode.to.at;
            within || is_end && (mode.from.at == value || mode.to.at == value)
        });
        let row = |pressed: &crate::modes::existence::ModeInterval| {
            let of = efforts.of(&pressed.pattern)?;
            let (power, efficiency) = efforts.power(&of);
            Some(CourseRow {
                at: value,
                pattern: Some(pattern(&pressed.pattern)),
                grows: vec![0; of.len()],
                efforts: Some(of),
                frictionless: Some(efforts.frictionless.clone()),
                power: Some(power),
                efficiency: Some(efficiency),
            })
        };
        let rows: Vec<CourseRow> = present.filter_map(row).collect();
        if rows.is_empty() {
            return vec![CourseRow { frictionless: Some(efforts.frictionless), ..nothing(value) }];
        }
        rows
    }
}

fn nothing(value: f64) -> CourseRow {
    CourseRow {
        at: value,
        pattern: None,
        efforts: None,
        grows: Vec::new(),
        frictionless: None,
        power: None,
        efficiency: None,
    }
}
