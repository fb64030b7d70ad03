//! Scenes as SVG: text stays text, and every shape has a class.

use super::scene::{Anchor, Bounds, Class, Point, Scene, Shape, head};
use crate::coordinate::{NotFinite, coordinate, finished};
use crate::printed;
use crate::theme::Theme;
use crate::typeface::STACK;
use std::fmt::Write;

/// Where the colours of a picture come from.
#[expect(clippy::large_enum_variant, reason = "there is one for each picture")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colours {
    /// From a theme, written into the picture.
    Theme(Theme),
    /// From the page that holds the picture, which has the rules of [`rules`] and the variables that they
    /// name.
    Page,
}

/// The attributes of a picture beside its shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame<'a> {
    /// The part of the scene that is shown.
    pub bounds: Bounds,
    /// Its title, for those who do not see it.
    pub title: &'a str,
    /// A description in words of what it shows.
    pub description: &'a str,
    /// Width in pixels; by default one for each drawing unit.
    pub width: Option<f64>,
    /// Its colours.
    pub colours: Colours,
}

/// A scene as an SVG document.
///
/// # Errors
/// If a place or a size is infinite or undefined.
pub fn write(scene: &Scene, frame: &Frame<'_>) -> Result<String, NotFinite> {
    finished(document(scene, frame))
}

/// The document, of which it is not seen yet whether its coordinates are finite.
pub(crate) fn document(scene: &Scene, frame: &Frame<'_>) -> String {
    let (corner, size) = (frame.bounds.least, frame.bounds.size());
    let [width, height] = [size.x.max(1.0), size.y.max(1.0)];
    let shown = frame.width.unwrap_or(width);
    let mut out = String::new();
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\" role=\"img\" \
         font-family=\"{STACK}\">",
        coordinate(shown),
        coordinate(shown * height / width),
        coordinate(corner.x),
        coordinate(corner.y),
        coordinate(width),
        coordinate(height)
    );
    let _ = writeln!(out, "<title>{}</title>", printed(frame.title));
    let _ = writeln!(out, "<desc>{}</desc>", printed(frame.description));
    if let Colours::Theme(theme) = frame.colours {
        let _ = writeln!(out, "<style>\n{}</style>", rules(&Colour::of_theme(&theme)));
    }
    let _ = writeln!(
        out,
        "<rect class=\"s-paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
        coordinate(corner.x),
        coordinate(corner.y),
        coordinate(width),
        coordinate(height)
    );
    for element in &scene.elements {
        shape(&mut out, class_name(element.class), &element.shape);
    }
    out.push_str("</svg>\n");
    out
}

/// One shape.
pub(crate) fn markup(element: &super::Element) -> String {
    let mut out = String::new();
    shape(&mut out, class_name(element.class), &element.shape);
    out
}

fn shape(out: &mut String, class: &str, shape: &Shape) {
    let _ = match shape {
        Shape::Line(places) => {
            writeln!(out, "<polyline class=\"{class} s-line\" points=\"{}\"/>", points(places))
        }
        Shape::Area(places) => writeln!(out, "<polygon class=\"{class}\" points=\"{}\"/>", points(places)),
        Shape::Circle(centre, radius) => writeln!(
            out,
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
            coordinate(centre.x),
            coordinate(centre.y),
            coordinate(*radius)
        ),
        Shape::Arrow { from, to } => {
            let direction = super::outline::unit(to - from, Point::x());
            let neck = to - direction * (0.8 * super::scene::HEAD).min((to - from).norm());
            let line = points(&[*from, neck]);
            let tip = points(&head(*to, direction));
            writeln!(
                out,
                "<g class=\"{class}\"><polyline class=\"s-line\" points=\"{line}\"/>\
                 <polygon class=\"s-head\" points=\"{tip}\"/></g>"
            )
        }
        Shape::Head(tip, direction) => {
            writeln!(
                out,
                "<polygon class=\"{class} s-head\" points=\"{}\"/>",
                points(&head(*tip, *direction))
            )
        }
        Shape::Text(text) => {
            let anchor = match text.anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
            };
            writeln!(
                out,
                "<text class=\"{class} s-text\" x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\">{}</text>",
                coordinate(text.at.x),
                coordinate(text.at.y),
                coordinate(text.size),
                printed(&text.text)
            )
        }
    };
}

fn points(places: &[Point]) -> String {
    places
        .iter()
        .map(|place| format!("{},{}", coordinate(place.x), coordinate(place.y)))
        .collect::<Vec<_>>()
        .join(" ")
}

/// The class of a shape in a document.
pub fn class_name(class: Class) -> &'static str {
    match class {
        Class::Wall => "s-wall",
        Class::HiddenWall => "s-hidden-wall",
        Class::Hatch => "s-hatch",
        Class::Fixed => "s-fixed",
        Class::Paper => "s-paper",
        Class::BodyEdge => "s-body-edge",
        Class::Body => "s-body",
        Class::Slot => "s-slot",
        Class::Edge => "s-edge",
        Class::Pin => "s-pin",
        Class::Hinge => "s-hinge",
        Class::Spring => "s-spring",
        Class::Damper => "s-damper",
        Class::Pad => "s-pad",
        Class::MassRing => "s-mass-ring",
        Class::Mass => "s-mass",
        Class::Reaction => "s-reaction",
        Class::Friction => "s-friction",
        Class::FrictionCircle => "s-friction-circle",
        Class::PinForce => "s-pin-force",
        Class::ActionLine => "s-action-line",
        Class::Cone => "s-cone",
        Class::Overlap => "s-overlap",
        Class::ContactForce => "s-contact-force",
        Class::JammedCorner => "s-jammed-corner",
        Class::PushLine => "s-push-line",
        Class::Load => "s-load",
        Class::Break => "s-break",
        Class::Drive => "s-drive",
        Class::Velocity => "s-velocity",
        Class::PointsOut => "s-points-out",
        Class::PointsIn => "s-points-in",
        Class::Opening => "s-opening",
        Class::Dimension => "s-dimension",
        Class::Leader => "s-leader",
        Class::Words => "s-words",
    }
}

/// The colours of a drawing as CSS values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Colour {
    /// Behind everything.
    pub(crate) background: String,
    /// Text and outlines.
    pub(crate) ink: String,
    /// Dimensions and hatching.
    pub(crate) muted: String,
    /// Insides of bodies.
    pub(crate) body: String,
    /// Reactions.
    pub(crate) reaction: String,
    /// Friction.
    pub(crate) friction: String,
    /// Loads.
    pub(crate) load: String,
    /// Velocities.
    pub(crate) velocity: String,
    /// Parts that jam, and contacts that open.
    pub(crate) warning: String,
}

impl Colour {
    /// The colours of a theme.
    pub fn of_theme(theme: &Theme) -> Self {
        Self {
            background: theme.background.to_owned(),
            ink: theme.ink.to_owned(),
            muted: theme.muted.to_owned(),
            body: theme.body.to_owned(),
            reaction: theme.reaction.to_owned(),
            friction: theme.friction.to_owned(),
            load: theme.series[3].to_owned(),
            velocity: theme.series[2].to_owned(),
            warning: theme.warning.to_owned(),
        }
    }

    /// CSS variables that a page gives their values: `--background`, `--ink` and so on.
    pub fn variables() -> Self {
        let variable = |name: &str| format!("var(--{name})");
        Self {
            background: variable("background"),
            ink: variable("ink"),
            muted: variable("muted"),
            body: variable("body"),
            reaction: variable("reaction"),
            friction: variable("friction"),
            load: variable("load"),
            velocity: variable("velocity"),
            warning: variable("warning"),
        }
    }
}

/// The rules of all classes with some colours.
pub fn rules(colour: &Colour) -> String {
    let Colour { background, ink, muted, body, reaction, friction, load, velocity, warning } = colour;
    let mut out = String::new();
    let mut rule = |selector: &str, declarations: String| {
        let _ = writeln!(out, "{selector} {{ {declarations} }}");
    };
    let pen = |colour: &str, width: f64| {
        format!("stroke: {colour}; stroke-width: {width}; stroke-linecap: round; stroke-linejoin: round;")
    };
    rule(".s-paper", format!("fill: {background};"));
    rule(".s-wall", format!("fill: none; {}", pen(ink, 1.8)));
    rule(".s-hidden-wall", format!("fill: none; stroke-dasharray: 7 5; {}", pen(ink, 1.2)));
    rule(".s-hatch", format!("fill: none; {}", pen(muted, 1.0)));
    rule(".s-fixed", format!("fill: {background}; {}", pen(ink, 1.6)));
    rule(".s-body-edge", format!("fill: {body}; {}", pen(ink, 3.0)));
    rule(".s-body", format!("fill: {body};"));
    rule(".s-slot, .s-pad", format!("fill: {background}; {}", pen(ink, 1.3)));
    rule(".s-edge", format!("fill: none; {}", pen(ink, 1.5)));
    rule(".s-pin", format!("fill: {muted}; {}", pen(ink, 1.6)));
    rule(".s-hinge", format!("fill: {background}; {}", pen(ink, 1.8)));
    rule(".s-spring, .s-damper", format!("fill: none; {}", pen(ink, 1.5)));
    rule(".s-mass-ring", format!("fill: {background}; {}", pen(ink, 1.3)));
    rule(".s-mass", format!("fill: {ink};"));
    for (class, colour) in [
        (".s-reaction", reaction),
        (".s-friction", friction),
        (".s-pin-force", reaction),
        (".s-contact-force", reaction),
        (".s-load", load),
        (".s-drive", load),
        (".s-velocity", velocity),
    ] {
        rule(class, format!("fill: {colour}; {}", pen(colour, 2.4)));
    }
    rule(".s-friction-circle", format!("fill: none; {}", pen(friction, 1.4)));
    rule(".s-action-line", format!("fill: none; stroke-dasharray: 9 3 2 3; {}", pen(reaction, 1.0)));
    rule(".s-push-line", format!("fill: none; stroke-dasharray: 9 3 2 3; {}", pen(load, 1.4)));
    rule(".s-cone", format!("fill: {friction}; fill-opacity: 0.14; stroke: {friction}; stroke-width: 0.7;"));
    rule(
        ".s-overlap",
        format!("fill: {friction}; fill-opacity: 0.3; stroke: {friction}; stroke-width: 1.2;"),
    );
    rule(".s-jammed-corner", format!("fill: {warning}; {}", pen(background, 1.2)));
    rule(".s-opening", format!("fill: {warning}; {}", pen(warning, 2.0)));
    rule("circle.s-opening", format!("fill: {background};"));
    rule(".s-points-out, .s-points-in", format!("fill: {ink}; {}", pen(ink, 1.6)));
    rule(".s-break", format!("fill: none; {}", pen(ink, 1.6)));
    rule(".s-drive .s-line, .s-drive.s-line", "stroke-dasharray: 5 4;".to_owned());
    rule(".s-dimension", format!("fill: {muted}; {}", pen(muted, 1.0)));
    rule(".s-leader", format!("fill: none; stroke-dasharray: 2 3; {}", pen(muted, 1.0)));
    rule(".s-words", format!("fill: {ink};"));
    rule(".s-line", "fill: none;".to_owned());
    rule(".s-head", "stroke: none;".to_owned());
    rule(
        ".s-text",
        format!("paint-order: stroke; stroke: {background}; stroke-width: 3; stroke-linejoin: round;"),
    );
    out
}
