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

/// Lines of at most a width, about equally long, so that no word stands alone: as few as there can be.
fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let lines = broken_at(text, size, most);
    // The narrowest width that takes no further line, and breaks no word.
    let longest = text.split(' ').map(|word| width(word, size)).fold(0.0, f64::max);
    let (mut too_narrow, mut wide_enough) = (longest.max(0.5 * most).min(most), most);
    while wide_enough - too_narrow > 1.0 {
        let tried = 0.5 * (too_narrow + wide_enough);
        if broken_at(text, size, tried).len() > lines.len() {
            too_narrow = tried;
        } else {
            wide_enough = tried;
        }
    }
    if lines.len() > 1 { broken_at(text, size, wide_enough) } else { lines }
}

/// Lines of at most a width, broken between words, or within a word that is longer than a line.
fn broken_at(text: &str, size: f64, most: f64) -> Vec<String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// No further line, the same words, and the last line is no single word where the others have room for more.
    #[test]
    fn lines_are_about_equally_long() {
        let text = "Attainable: a mechanism with slightly elastic guides settles on it.";
        for most in [150.0, 300.0, 440.0, 455.0] {
            let (lines, greedy) = (wrapped(text, VALUE_SIZE, most), broken_at(text, VALUE_SIZE, most));
            assert_eq!((lines.len(), lines.join(" ")), (greedy.len(), text.to_owned()));
            assert!(lines.iter().all(|line| width(line, VALUE_SIZE) <= most), "{lines:?}");
            assert!(lines.len() == 1 || lines[lines.len() - 1].contains(' '), "{lines:?}");
        }
    }
}
