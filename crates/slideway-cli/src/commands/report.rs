//! `slideway report`

use crate::arguments::ReportArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::own_file::Document;
use crate::watch::Watch;
use slideway_pictures::page::{Findings, Origin};
use std::ffi::OsStr;
use std::path::Path;

const ENDINGS: [&str; 2] = [".html", ".htm"];

/// Writes a page with the model, its drawing, its solutions and limits.
pub(crate) fn report(arguments: &ReportArguments, output: &Output) -> Result<Outcome, Failure> {
    if let Some(path) = &arguments.destination.output {
        be_a_page(path)?;
    }
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let named_after = (arguments.model.file.as_path(), ENDINGS[0]);
    let document = Document::new(&mut files, &arguments.destination, named_after, arguments.open.open)?;
    let input = Input::read(&arguments.model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let wanted = arguments.vary.iter().map(|vary| input.vary(&model, vary)).collect::<Result<Vec<_>, _>>()?;
    let found = Findings::of(&model, wanted, &mut |progress| watch.look(progress));
    let found = watch.whole(found.map_err(|faults| input.refused(faults))?)?;
    let html = found.to_html(&Origin {
        command: &command(arguments, &input),
        name: &input.name,
        text: &input.text(),
        settings: &input.settings,
    })?;
    document.output.write(&html)?;
    document.finish(output)?;
    Ok(Outcome::Done)
}

/// Refuses the ending of another format, such as one that a browser can print; a file may have no ending.
fn be_a_page(path: &Path) -> Result<(), Failure> {
    let is_known = |ending: &OsStr| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(&known[1..]));
    if path.extension().is_none_or(is_known) {
        return Ok(());
    }
    Err(Failure::FileFormat { path: path.to_owned(), known: &ENDINGS })
}

/// The command that makes the page, as far as it matters for what is on it.
fn command(arguments: &ReportArguments, input: &Input) -> String {
    let mut words = vec!["slideway report".to_owned(), input.name.clone()];
    for setting in input.settings.entries() {
        let option = match setting.kind {
            slideway::model::SettingKind::Parameter => "--set",
            slideway::model::SettingKind::Position => "--at",
            slideway::model::SettingKind::Rate => "--rate",
            _ => "--time",
        };
        let value = if option == "--time" { setting.value.to_string() } else { setting.text() };
        words.push(format!("{option} \"{value}\""));
    }
    words.extend(arguments.model.units_option());
    words.extend(arguments.vary.iter().map(|vary| format!("--vary \"{vary}\"")));
    words.join(" ")
}
