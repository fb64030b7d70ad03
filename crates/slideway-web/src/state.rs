//! A state of a model with its answer, and what its drawings share with those of other states of the same model.
//!
//! While a slider is dragged the force scale stays, so that arrows grow as forces do, and so does the place of the
//! picture. The scale is that of the model as it is in the file, whatever is set: the same link shows the same picture.

use crate::kept::Kept;
use crate::question::Asked;
use slideway::configuration::Configuration;
use slideway::fault::Faults;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::progress::Callback;
use slideway::report::SolveReport;
use slideway::solve::{SolveOptions, solve_with};
use slideway::standstill::HoldReport;
use slideway_pictures::drawing::{Forces, Held, Sheet, asks_for_rest, pieces};
use slideway_pictures::page::at_rest;

/// A state of a model.
pub(crate) struct State {
    pub(crate) mechanism: Mechanism,
    /// As it is drawn in the file where it cannot be assembled.
    pub(crate) configuration: Configuration,
    /// Its solutions, or why the question has no answer.
    pub(crate) solved: Result<SolveReport, Faults>,
    /// Whether it holds where that question has no answer, or this one; nothing where this one has none either.
    pub(crate) rest: Option<HoldReport>,
}

impl State {
    /// The present state of a model.
    ///
    /// # Errors
    /// Faults of the model.
    pub(crate) fn of(model: &Model, margins: bool, callback: &mut Callback<'_>) -> Result<Self, Faults> {
        let mechanism = Mechanism::new(model)?;
        let options = SolveOptions::default().margins(margins);
        let (configuration, solved) = match Configuration::new(&mechanism) {
            Ok(configuration) => (configuration, solve_with(model, &options, callback)),
            Err(faults) => (Configuration::drawing(&mechanism), Err(faults)),
        };
        let known = solved.as_ref().ok();
        let rest = if asks_for_rest(known) { at_rest(model, known, callback).ok() } else { None };
        Ok(Self { mechanism, configuration, solved, rest })
    }

    /// Whether rest is the question: motion has no answer.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.solved.is_err() && self.rest.is_some()
    }

    /// Its drawings, and what those of the next state keep of them; `held` is what they keep of those before. The first
    /// are not wider than `most` drawing units.
    pub(crate) fn drawn(&self, held: Option<Held>, most: f64) -> (Vec<Sheet>, Option<Held>) {
        let forces = Forces::of(self.solved.as_ref().ok(), self.rest.as_ref());
        let sheets = pieces(&self.mechanism, &self.configuration, forces, held.as_ref(), most);
        let has_solutions = match forces {
            Some(Forces::InMotion(report)) => {
                !report.solutions.is_empty() || !report.preload_gap_states.is_empty()
            }
            Some(Forces::AtRest(report)) => report.at_rest.is_some(),
            None => false,
        };
        // What shows why it jams has no scale of forces, and its friction cones need a place that no other drawing does.
        if held.is_some() && !has_solutions {
            return (sheets, held);
        }
        // The first sheet is the mechanism itself.
        let solutions = sheets.iter().skip(1).filter_map(|sheet| sheet.held).filter(|_| has_solutions);
        let longest_force = solutions.clone().filter_map(|held| held.longest_force).reduce(f64::max);
        let longest_force = held.and_then(|held| held.longest_force).or(longest_force);
        let places = sheets.first().and_then(|sheet| sheet.held).into_iter().chain(solutions);
        let place = places.reduce(|all, one| Held { place: all.place.with(one.place), ..all });
        let kept = place.map(|held| Held { longest_force, ..held });
        (sheets, kept.filter(|held| is_finite(*held)))
    }
}

/// A place beyond floating-point numbers is none that JSON could hold.
fn is_finite(held: Held) -> bool {
    let Kept { longest_force, place, room } = Kept::from(held);
    place.into_iter().chain(longest_force).chain([room]).all(f64::is_finite)
}

/// Returns the scale and the place that the drawings of the first state that is asked for keep of the state
/// in the file. Returns those of the state itself if nothing is changed, or if the file's has no scale of
/// forces.
pub(crate) fn first_held(
    asked: &Asked,
    file: &Model,
    state: &State,
    most: f64,
    callback: &mut Callback<'_>,
) -> Option<Held> {
    if asked.settings.entries().is_empty() {
        return state.drawn(None, most).1;
    }
    // The file may be at fault where settings mend it.
    let in_file = State::of(file, false, callback).ok().and_then(|in_file| in_file.drawn(None, most).1);
    match in_file {
        Some(Held { longest_force: Some(_), .. }) => in_file,
        _ => state.drawn(None, most).1,
    }
}
