//! `slideway drive`

use crate::arguments::{CheckFormat, DriveArguments};
use crate::columns::{WIDTH, wrapped};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture;
use crate::watch::Watch;
use slideway::drive::{self, DriveOptions};
use slideway::limits::{Variable, variables};
use slideway::printable;
use slideway_pictures::plot::{drive_figure, to_svg};

/// Rows of the table that a plot is made of, at least: two for each pixel of a screen.
const PLOTTED_ROWS: usize = 801;

/// Says which efforts the drives need.
pub(crate) fn drive(arguments: &DriveArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let plot = picture::beside(&arguments.plot, &mut files)?;
    if plot.is_some() && arguments.vary.is_none() {
        return Err(Failure::NoLine);
    }
    let output = files.answer()?;
    let input = Input::read(&arguments.model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    let vary = arguments.vary.as_deref().map(|vary| input.vary(&model, vary)).transpose()?;
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let mut of_rows = |rows: usize| {
        let options = DriveOptions::default().vary(vary.clone()).rows(rows);
        let report = drive::drive_with(&model, &options, &mut |progress| watch.look(progress));
        report.map_err(|faults| input.refused(faults))
    };
    // A plot takes more rows than a table.
    let plotted =
        plot.map(|file| Ok::<_, Failure>((of_rows(arguments.rows.max(PLOTTED_ROWS))?, file))).transpose()?;
    let report = of_rows(arguments.rows)?;
    let report = watch.whole(report)?;
    if let Some((Some(rows), (picture, file))) = plotted {
        let figure = drive_figure(&rows).unwrap_or_default().changed_by(&input.settings);
        picture.write(to_svg(&figure, arguments.plot.theme.colours()), &file)?;
    }
    output.tell(&report, arguments.format)?;
    if arguments.vary.is_none() && arguments.format == CheckFormat::Text && output.is_terminal() {
        output.write(&over_what(&variables(&model).map_err(|faults| input.refused(faults))?))?;
    }
    Ok(report.directions.first().map_or(Outcome::Done, |direction| Outcome::from(direction.status)))
}

/// Over which quantities the efforts can be tabulated, with their present values.
fn over_what(variables: &[Variable]) -> String {
    let one = |one: &Variable| format!("{} = {}", one.name, one.value);
    let all: Vec<String> = variables.iter().map(one).collect();
    let text = format!("To see it over one of these, add `--vary NAME`: {}.", all.join(", "));
    format!("\n{}\n", printable::lines(&wrapped(&text, WIDTH).join("\n")))
}
