//! Margins of friction, efforts and efficiency, and what happens at rest, in sentences.

use super::{Page, all, text};

/// The section; nothing where none of these is known.
pub(super) fn summary(page: &Page<'_>) -> String {
    let margins = page.report.map(|report| vec![report.margins_in_words()]).unwrap_or_default();
    let rest = page.rest.map_or_else(<[String]>::to_vec, |report| vec![report.verdict_in_words()]);
    let parts = [
        ("Margins of friction", &*margins),
        ("Efforts and efficiency", page.efficiency),
        ("At rest", &*rest),
    ];
    let parts = all(parts, |(title, sentences)| part(title, sentences));
    if parts.is_empty() {
        return parts;
    }
    format!(
        "<section id=\"margins\">\n<h2>Margins, efforts, rest</h2>\n<div class=\"columns\">\n{parts}</div>\n</section>\n"
    )
}

/// Sentences under a title; nothing without sentences.
pub(super) fn part(title: &str, sentences: &[String]) -> String {
    let lines = sentences.iter().flat_map(|sentence| sentence.lines()).filter(|line| !line.trim().is_empty());
    let lines = all(lines, |line| format!("<p>{}</p>\n", text(line.trim())));
    if lines.is_empty() {
        lines
    } else {
        format!("<section class=\"part\">\n<h3>{title}</h3>\n{lines}</section>\n")
    }
}
