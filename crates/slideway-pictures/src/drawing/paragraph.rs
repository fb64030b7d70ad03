//! Words beside and below drawings.

use super::VALUE_SIZE;
use super::scene::{Anchor, Class, Point, Scene, Text};
use crate::typeface::width;

/// Distance of lines of text, in sizes.
pub(super) const LINE: f64 = 1.4;

/// A value to the right of a place; the x of its end.
pub(super) fn beside(scene: &mut Scene, place: Point, text: String) -> f64 {
    let at = place + Point::new(9.0, 5.0);
    let end = at.x + width(&text, VALUE_SIZE);
    scene.write(Class::Words, Text { text, at, anchor: Anchor::Start, size: VALUE_SIZE });
    end
}

/// Writes a text in lines of at most this width below a place; the y below it.
pub(super) fn paragraph(scene: &mut Scene, text: &str, size: f64, corner: Point, most: f64) -> f64 {
    let mut y = corner.y;
    for line in wrapped(text, size, most) {
        y += LINE * size;
        let at = Point::new(corner.x, y);
        scene.write(Class::Words, Text { text: line, at, anchor: Anchor::Start, size });
    }
    y
}

/// Lines of at most a width, broken between words, or within a word that is longer than a line.
fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split(' ') {
        let Some(line) = lines.last_mut() else { continue };
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if width(&joined, size) <= most {
            *line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(String::new());
        }
        for character in word.chars() {
            let Some(line) = lines.last_mut() else { continue };
            line.push(character);
            if width(line, size) > most && line.chars().count() > 1 {
                line.pop();
                lines.push(character.to_string());
            }
        }
    }
    lines
}
