//! `slideway models`

use crate::arguments::ModelsArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::outcome::Outcome;
use crate::output::Output;
use slideway::fault::nearest;
use slideway::gallery::{self, GREATEST_STAGES, MODELS};
use std::fmt::Write;

/// Columns of the list.
const WIDTH: usize = 80;

/// Lists the gallery, or writes one of its models.
pub(crate) fn models(arguments: &ModelsArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = Files::new(output, &arguments.destination, None).answer()?;
    output.write(&match &arguments.name {
        None => {
            let models = MODELS.iter().map(|model| (model.name, model.summary(), model.shows()));
            list(models) + "`slideway models NAME > NAME.toml` writes one to start from.\n"
        }
        Some(name) => model(name, arguments.stages)?,
    })?;
    Ok(Outcome::Done)
}

fn model(name: &str, stages: Option<usize>) -> Result<String, Failure> {
    let bare = name.strip_suffix(".toml").unwrap_or(name);
    let Some(model) = gallery::find(bare) else {
        let nearest = nearest(bare, MODELS.iter().map(|model| model.name));
        return Err(Failure::UnknownModel { name: name.to_owned(), nearest });
    };
    match stages {
        None => Ok(model.text.to_owned()),
        Some(_) if model.name != gallery::TELESCOPIC_BOOM => Err(Failure::NoStages { name: name.to_owned() }),
        Some(stages) => {
            gallery::telescopic_boom(stages).ok_or(Failure::StageCount { stages, most: GREATEST_STAGES })
        }
    }
}

/// Names, what each of them is, and below that what else is told of it.
pub(super) fn list<'a>(entries: impl Iterator<Item = (&'a str, &'a str, String)> + Clone) -> String {
    let width = entries.clone().map(|(name, ..)| name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (entry, summary, shows) in entries {
        let summary = wrapped(summary, WIDTH - width - 2);
        let shows = wrapped(&shows, WIDTH - width - 4).into_iter().map(|line| format!("  {line}"));
        for (index, line) in summary.into_iter().chain(shows).enumerate() {
            let name = if index == 0 { entry } else { "" };
            let _ = writeln!(text, "{name:width$}  {line}");
        }
        text.push('\n');
    }
    text
}

/// Lines of at most `width` characters, broken between words.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
