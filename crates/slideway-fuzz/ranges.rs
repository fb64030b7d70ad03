//! Every question over a range, of any ends, in a model of the gallery: no panic, and no number that is not finite.

use slideway::drive::drive_with;
use slideway::limits::{FRICTION, limits_with, rest_limits_with};
use slideway::map::map_with;
use slideway::report::Style;
use slideway::size::{Against, size_with};
use slideway::sweep::GridAxis;
use slideway::{
    DriveOptions, Faults, HoldOptions, LimitsOptions, MapOptions, Model, Report, SizeOptions, Sweep,
    SweepOptions, Vary, gallery,
};
use std::ops::ControlFlow;

/// The callback ends what takes long.
const PIECES: usize = 600;

/// Checks a question over a range: numbers of the model, of the question and of what is varied; the ends.
pub fn ranges((model, question, numbers, [from, to]): (u8, u8, [u8; 2], [f64; 2])) {
    let models = gallery::MODELS;
    let model = Model::parse(models[usize::from(model) % models.len()].text).expect("the gallery is sound");
    let parameters = model.parameters.iter().map(|parameter| parameter.name.to_string());
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.name.to_string());
    let names: Vec<String> = parameters.chain(coordinates).chain([FRICTION.to_owned()]).collect();
    let [name, other] = numbers.map(|number| names[usize::from(number) % names.len()].as_str());
    let (vary, along) = (Vary::between(name, from, to), Vary::between(other, 0.0, 1.0));
    let mut pieces = 0;
    let mut callback = |_: &_| {
        pieces += 1;
        if pieces < PIECES { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    match question % 7 {
        0 => told(limits_with(&model, &LimitsOptions::new(vary).both_directions(true), &mut callback)),
        1 => told(drive_with(&model, &DriveOptions::default().vary(vary), &mut callback)),
        2 => told(rest_limits_with(&model, &vary, &HoldOptions::default(), &mut callback)),
        3 => told(size_with(&model, &SizeOptions::new(vary, 2.0), &mut callback)),
        4 => {
            told(size_with(&model, &SizeOptions::new(vary, 0.5).against(Against::Efficiency), &mut callback));
        }
        5 => told(map_with(&model, &MapOptions::new(vary, along).size(8, 8), &mut callback)),
        _ => {
            let options = SweepOptions::grid([GridAxis::linear(name, from, to, 5)]);
            if let Err(faults) = Sweep::new_with(&model, &options, &mut callback) {
                assert!(!faults.to_string().is_empty());
            }
        }
    }
}

fn told<R: Report>(answer: Result<Option<R>, Faults>) {
    match answer {
        Ok(Some(report)) => {
            let text = report.text(Style::default());
            assert!(!crate::has_no_number(&text), "{text}");
            assert!(!report.json().is_empty());
        }
        Ok(None) => {}
        Err(faults) => assert!(!faults.to_string().is_empty()),
    }
}
