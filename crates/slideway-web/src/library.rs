//! Models to begin with: the gallery, and the templates of `slideway new`.

use serde::Serialize;
use slideway::gallery::MODELS;
use slideway::model::Settings;
use slideway::template::TEMPLATES;

/// A model to begin with.
#[derive(Debug, Serialize)]
pub(crate) struct Entry {
    /// Its name, unique among those of its kind.
    name: &'static str,
    /// "gallery" or "template".
    kind: &'static str,
    /// The first line of its description.
    summary: &'static str,
    /// The behaviour that it shows, or the rule that it must meet.
    shows: String,
    /// The model file.
    text: String,
}

/// All models to begin with.
pub(crate) fn entries() -> Vec<Entry> {
    let gallery = MODELS.iter().map(|model| Entry {
        name: model.name,
        kind: "gallery",
        summary: model.summary(),
        shows: model.shows(),
        text: model.text.to_owned(),
    });
    let templates = TEMPLATES.iter().map(|template| Entry {
        name: template.name,
        kind: "template",
        summary: template.summary(),
        shows: template.rule(),
        text: template
            .model(&Settings::default(), &format!("{}.toml", template.name))
            .expect("its own sizes make sense"),
    });
    gallery.chain(templates).collect()
}
