//! Writing SVG: elements with attributes, numbers of two decimals, printed text.

pub(crate) use crate::coordinate::coordinate;
use crate::coordinate::{NotFinite, attribute, finished};
use crate::printed;
use crate::typeface::STACK;
pub(crate) use crate::typeface::width;
use std::fmt::Write;

/// An SVG document that grows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Svg {
    body: String,
    indent: usize,
}

impl Svg {
    /// Adds an element without content.
    pub(crate) fn element(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.start(name, attributes);
        self.body.push_str("/>\n");
    }

    /// Adds an element around a text.
    pub(crate) fn text(&mut self, name: &str, attributes: &[(&str, &str)], content: &str) {
        self.start(name, attributes);
        let _ = writeln!(self.body, ">{}</{name}>", printed(content));
    }

    /// Begins an element; [`Svg::close`] ends it.
    pub(crate) fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.start(name, attributes);
        self.body.push_str(">\n");
        self.indent += 1;
    }

    /// Ends an element.
    pub(crate) fn close(&mut self, name: &str) {
        self.indent = self.indent.saturating_sub(1);
        let _ = writeln!(self.body, "{}</{name}>", "  ".repeat(self.indent));
    }

    /// A straight line.
    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], attributes: &[(&str, &str)]) {
        let [x1, y1, x2, y2] = [from[0], from[1], to[0], to[1]].map(coordinate);
        let places = [("x1", x1.as_str()), ("y1", &y1), ("x2", &x2), ("y2", &y2)];
        self.element("line", &[&places, attributes].concat());
    }

    /// A rectangle.
    pub(crate) fn rectangle(&mut self, [x, y, width, height]: [f64; 4], attributes: &[(&str, &str)]) {
        let [x, y, width, height] = [x, y, width, height].map(coordinate);
        let places = [("x", x.as_str()), ("y", &y), ("width", &width), ("height", &height)];
        self.element("rect", &[&places, attributes].concat());
    }

    /// Text that begins, is centred or ends at a place, by its attributes.
    pub(crate) fn label(&mut self, [x, y]: [f64; 2], attributes: &[(&str, &str)], content: &str) {
        let [x, y] = [x, y].map(coordinate);
        self.text("text", &[&[("x", x.as_str()), ("y", &y)], attributes].concat(), content);
    }

    /// The document with its size in pixels and a title for those who cannot see it.
    ///
    /// # Errors
    /// If a coordinate is infinite or undefined.
    pub(crate) fn document(
        &self,
        [width, height]: [f64; 2],
        title: &str,
        background: &str,
    ) -> Result<String, NotFinite> {
        let [width, height] = [width, height].map(coordinate);
        finished(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{STACK}\" role=\"img\">\n<title>{}</title>\n\
             <rect class=\"background\" width=\"{width}\" height=\"{height}\" fill=\"{background}\"/>\n{}</svg>\n",
            printed(title),
            self.body
        ))
    }

    fn start(&mut self, name: &str, attributes: &[(&str, &str)]) {
        let _ = write!(self.body, "{}<{name}", "  ".repeat(self.indent));
        for (key, value) in attributes {
            let _ = write!(self.body, " {key}=\"{}\"", attribute(value));
        }
    }
}

/// The words of a text in lines no wider than `space`; a longer word has a line of its own.
pub(crate) fn wrapped(text: &str, size: f64, space: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= space => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::escaped;

    #[test]
    fn text() {
        assert_eq!(escaped("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
    }

    #[test]
    fn lines_keep_within_their_space() {
        let text = "upper on the lower side of the slot; lower flat on the lower guide";
        let lines = wrapped(text, 12.0, 200.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 12.0) <= 200.0), "{lines:?}");
        assert_eq!(lines.join(" "), text);
    }
}
