//! The look of a state on the page: the quantities that can be changed in it, its drawings, and its solutions
//! in words.

use crate::kept::Kept;
use crate::quantity::{MOST, Quantity, quantities};
use crate::question::{Asked, Drawn};
use crate::state::{State, first_held};
use crate::told_fault::{ToldFault, told};
use serde::Serialize;
use slideway::check::coordinates_of;
use slideway::fault::Faults;
use slideway::model::Model;
use slideway::printable::line;
use slideway::progress::Callback;
use slideway::report::{Report, SolveReport, Status};
use slideway::standstill::HoldReport;
use slideway::warning::{ranges_at_middle, warnings};
use slideway_pictures::drawing::svg::{Colours, write};
use slideway_pictures::drawing::{Held, Sheet, title};
use slideway_pictures::page::{reasons, rest_part, solve_parts};

/// The look of a state on the page: its quantities, drawings and answer.
#[derive(Debug, Serialize)]
pub(crate) struct Look {
    title: String,
    warnings: Vec<ToldFault>,
    quantities: Vec<Quantity>,
    /// How many parameters are none of them, because there are so many.
    left_out: usize,
    /// Names of loads that can be multiplied, and of drives.
    loads: Vec<String>,
    drives: Vec<String>,
    /// The mechanism, each of its solutions, and the key to the colours.
    drawings: Vec<Drawing>,
    /// The scale and the place that the drawings of the next state of the same model keep of these.
    held: Option<Kept>,
    /// How many solutions there are; whether it holds at rest where the question of motion has no answer; absent where
    /// neither has one.
    answer: Option<Verdict>,
    /// Whether the answer is about rest.
    is_at_rest: bool,
    /// Why the question of motion has no answer.
    reasons: Vec<String>,
}

/// A picture with its words.
#[derive(Debug, Serialize)]
struct Drawing {
    title: String,
    words: String,
    svg: String,
}

/// How many solutions there are.
#[derive(Debug, Serialize)]
struct Verdict {
    status: Status,
    /// Whether the search ended early.
    partial: bool,
    /// How it is known.
    known: String,
    count: String,
    words: String,
    /// The pattern of each solution.
    patterns: Vec<String>,
    /// Sections of HTML, in which all text of the model is escaped: the state with its answer, then each solution.
    sections: Vec<String>,
}

impl Verdict {
    fn of(report: &SolveReport) -> Self {
        Self {
            status: report.status,
            partial: report.partial,
            known: report.known_in_words(),
            count: report.count.clone(),
            // What a glance takes in beside the drawing.
            words: [report.verdict_in_words()]
                .into_iter()
                .chain(report.safety_in_words().into_iter().take(1))
                .collect::<Vec<_>>()
                .join(" "),
            patterns: report.solutions.iter().map(|solution| solution.pattern.clone()).collect(),
            sections: solve_parts(report),
        }
    }

    fn of_rest(report: &HoldReport) -> Self {
        Self {
            status: if report.holds { Status::One } else { Status::None },
            partial: false,
            known: "Computed at rest; its motion has no answer.".to_owned(),
            count: String::new(),
            // Names stand in the headline as they are.
            words: report.answer().replace('`', ""),
            patterns: Vec::new(),
            sections: vec![rest_part(report)],
        }
    }
}

/// The state of a model.
///
/// # Errors
/// Faults of the model. That the question has no answer, or that the state cannot be assembled, is none: then there
/// are reasons, and a drawing without forces or none at all.
pub(crate) fn look(
    asked: &Asked,
    drawn: Drawn,
    margins: bool,
    callback: &mut Callback<'_>,
) -> Result<Look, Faults> {
    let file = asked.file()?;
    let model = asked.set(&file)?;
    let state = State::of(&model, margins, callback)?;
    let most = drawn.most.unwrap_or(f64::INFINITY);
    let held = drawn.held.map(Held::from).or_else(|| first_held(asked, &file, &state, most, callback));
    let (sheets, held) = state.drawn(held, most);
    let State { mechanism, configuration, solved, rest } = &state;
    let coordinates = coordinates_of(&model, mechanism, configuration)?;
    Ok(Look {
        title: line(&title(mechanism)).into_owned(),
        warnings: told(&all_warnings(&model), asked),
        left_out: model.parameters.len().saturating_sub(MOST),
        quantities: quantities(&file, &model, (&asked.text, state.is_at_rest()), mechanism, &coordinates)?,
        loads: mechanism.loads.iter().map(|load| load.name.to_string()).collect(),
        drives: mechanism.drives.iter().map(|drive| drive.name.to_string()).collect(),
        drawings: sheets.iter().filter_map(Drawing::of).collect(),
        held: held.map(Kept::from),
        answer: solved.as_ref().ok().map(Verdict::of).or_else(|| rest.as_ref().map(Verdict::of_rest)),
        is_at_rest: state.is_at_rest(),
        reasons: solved.as_ref().err().map(|faults| why(faults, state.is_at_rest())).unwrap_or_default(),
    })
}

/// Why motion has no answer; what to do instead only if rest has none either.
fn why(faults: &Faults, is_at_rest: bool) -> Vec<String> {
    if is_at_rest {
        faults.sorted().iter().map(|fault| line(&fault.kind.to_string()).into_owned()).collect()
    } else {
        reasons(faults)
    }
}

fn all_warnings(model: &Model) -> Faults {
    let mut all = warnings(model);
    all.append(ranges_at_middle(model));
    all
}

impl Drawing {
    /// Nothing where a coordinate is too great to be drawn.
    fn of(sheet: &Sheet) -> Option<Self> {
        let svg = write(&sheet.scene, &sheet.frame(None, Colours::Page)).ok()?;
        Some(Self { title: sheet.title.clone(), words: sheet.description.clone(), svg })
    }
}
