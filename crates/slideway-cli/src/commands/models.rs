//! `slideway models`

use crate::arguments::ModelsArguments;
use crate::columns::{self, wrapped};
use crate::failure::Failure;
use crate::files::Files;
use crate::outcome::Outcome;
use crate::output::Output;
use slideway::fault::nearest;
use slideway::gallery::{self, GREATEST_STAGES, MODELS};

/// Stands for words that have no room.
const MORE: &str = " ...";
/// Hint below the list: the command that writes one of its models to a file.
const START: &str = "`slideway models NAME > NAME.toml` writes one to start from.\n";

/// Lists the gallery, or writes one of its models.
pub(crate) fn models(arguments: &ModelsArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = Files::new(output, &arguments.destination, None).answer()?;
    output.write(&match &arguments.name {
        None if output.look().verbose => {
            list(MODELS.iter().map(|model| (model.name, model.summary(), model.shows()))) + START
        }
        None => {
            let models = MODELS.iter().map(|model| (model.name, model.summary()));
            format!(
                "{}\n{START}With -v, this list says what each of them shows.\n",
                brief(models, output.style().width)
            )
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

/// Names, each with what it is on the same line, as far as it fits in so many columns.
pub(super) fn brief<'a>(entries: impl Iterator<Item = (&'a str, &'a str)> + Clone, columns: usize) -> String {
    let width = entries.clone().map(|(name, _)| name.len()).max().unwrap_or(0);
    let one = |(name, summary): (&str, &str)| {
        format!("{name:width$}  {}\n", shortened(summary, columns.saturating_sub(width + 2)))
    };
    entries.map(one).collect()
}

/// The beginning of a text that fits: the first sentence, or as many words as there is room for.
fn shortened(text: &str, width: usize) -> String {
    let fits = |part: &&str| part.chars().count() <= width;
    // No initial of a name ends a sentence.
    let ends = text.match_indices(". ").find(|(at, _)| text[..*at].ends_with(char::is_lowercase));
    let sentence = ends.map_or(text, |(at, _)| &text[..at]);
    match [text, sentence].into_iter().find(fits) {
        Some(part) => part.trim_end_matches('.').to_owned(),
        None => wrapped(text, width.saturating_sub(MORE.len())).into_iter().next().unwrap_or_default() + MORE,
    }
}

/// Lists names, a summary of each, and below that more words about it.
pub(super) fn list<'a>(entries: impl Iterator<Item = (&'a str, &'a str, String)>) -> String {
    let entries: Vec<(String, String)> = entries
        .flat_map(|(name, summary, more)| {
            [(name.to_owned(), summary.to_owned()), (String::new(), more), (String::new(), String::new())]
        })
        .collect();
    columns::list(&entries, 0)
}
