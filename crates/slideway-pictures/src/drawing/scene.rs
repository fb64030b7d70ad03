//! The shapes of a drawing in drawing units (x to the right, y down), each with a class that says what it
//! shows.

use nalgebra::Vector2;

/// A place or direction in drawing units.
pub type Point = Vector2<f64>;

/// The meaning of a shape; [`super::svg`] gives each class its colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// A wall of a guide that belongs to ground.
    Wall,
    /// A wall or a bar behind a body.
    HiddenWall,
    /// Hatching of ground.
    Hatch,
    /// A part of ground with an outline.
    Fixed,
    /// A part of ground without an outline.
    Paper,
    /// The outline of a body, drawn before its inside.
    BodyEdge,
    /// The inside of a body.
    Body,
    /// The free space of a slot in a body.
    Slot,
    /// A line of a body.
    Edge,
    /// A pin.
    Pin,
    /// A hinge.
    Hinge,
    /// A spring.
    Spring,
    /// A damper.
    Damper,
    /// A pad at an end of a travel, or of a block that has more than two.
    Pad,
    /// Outline of the symbol of a centre of mass.
    MassRing,
    /// Dark quarters of the symbol of a centre of mass.
    Mass,
    /// A normal reaction.
    Reaction,
    /// A friction force.
    Friction,
    /// A friction circle of a hinge.
    FrictionCircle,
    /// The force of a hinge with friction.
    PinForce,
    /// The line along which that acts.
    ActionLine,
    /// The friction cone of a contact.
    Cone,
    /// The area that two friction cones have in common.
    Overlap,
    /// The whole force of a contact, normal force and friction together.
    ContactForce,
    /// A corner that presses where a mechanism jams.
    JammedCorner,
    /// The line of a push.
    PushLine,
    /// A load, a weight, or the effort of a drive.
    Load,
    /// A sign that an arrow is shorter than its scale says.
    Break,
    /// The effort of a drive before it is known.
    Drive,
    /// A sliding velocity.
    Velocity,
    /// The sign of a force that points out of the drawing, towards the reader.
    PointsOut,
    /// The sign of a force that points into the drawing.
    PointsIn,
    /// The acceleration of the gap of a contact that lifts off.
    Opening,
    /// A dimension.
    Dimension,
    /// A line from a label to what it names.
    Leader,
    /// Text of its own: headings and words.
    Words,
}

/// A shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through places.
    Line(Vec<Point>),
    /// A closed area.
    Area(Vec<Point>),
    /// A circle: its centre and radius.
    Circle(Point, f64),
    /// A straight arrow.
    Arrow {
        /// Where it begins.
        from: Point,
        /// Where its head ends.
        to: Point,
    },
    /// The head of an arrow alone: where it ends, and its unit direction.
    Head(Point, Point),
    /// One line of text.
    Text(Text),
}

/// One line of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The words of the line.
    pub text: String,
    /// The left end or the middle of its base line.
    pub at: Point,
    /// Where `at` lies in it.
    pub(crate) anchor: Anchor,
    /// Size of the letters.
    pub(crate) size: f64,
}

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
}

/// A shape and what it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// The meaning of the shape.
    pub class: Class,
    /// The shape.
    pub shape: Shape,
}

/// A rectangle with sides parallel to the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least x and y.
    pub least: Point,
    /// Greatest x and y.
    pub greatest: Point,
}

/// Shapes in the order in which they are drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// The shapes.
    pub elements: Vec<Element>,
    /// Whether guides are drawn with a play that can be seen instead of their own.
    pub is_exaggerated: bool,
    /// By how much the play, the misalignment and the deflections of guides that share a load are magnified; none
    /// without such guides.
    pub magnification: Option<f64>,
    /// By how much friction circles of hinges are magnified; none without them.
    pub(crate) friction_circles: Option<f64>,
    /// Whether the overlap of two friction cones is drawn, with the line of a push through it.
    pub(crate) has_overlap: bool,
}

impl Bounds {
    /// The bounds of places; none without places.
    pub fn around(places: impl IntoIterator<Item = Point>) -> Option<Self> {
        places.into_iter().map(|place| Self { least: place, greatest: place }).reduce(Self::with)
    }

    /// The bounds of both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self { least: self.least.inf(&other.least), greatest: self.greatest.sup(&other.greatest) }
    }

    /// Returns the bounds with a margin on all sides.
    #[must_use]
    pub fn widened(self, margin: f64) -> Self {
        let margin = Point::new(margin, margin);
        Self { least: self.least - margin, greatest: self.greatest + margin }
    }

    /// As wide as this at least, about the same middle.
    #[must_use]
    pub(crate) fn at_least_as_wide_as(self, width: f64) -> Self {
        let margin = Point::new(0.5 * (width - self.size().x).max(0.0), 0.0);
        Self { least: self.least - margin, greatest: self.greatest + margin }
    }

    /// Returns bounds of the same size elsewhere.
    #[must_use]
    pub(super) fn shifted(self, by: Point) -> Self {
        Self { least: self.least + by, greatest: self.greatest + by }
    }

    /// Returns bounds of the same width, with the heights of other bounds.
    #[must_use]
    pub(super) fn with_heights_of(self, other: &Self) -> Self {
        Self {
            least: Point::new(self.least.x, other.least.y),
            greatest: Point::new(self.greatest.x, other.greatest.y),
        }
    }

    /// Width and height.
    pub fn size(&self) -> Point {
        self.greatest - self.least
    }

    /// The four corners, one after the other around it.
    pub(super) fn corners(&self) -> [Point; 4] {
        let Self { least, greatest } = *self;
        [least, Point::new(greatest.x, least.y), greatest, Point::new(least.x, greatest.y)]
    }

    /// The middle.
    pub fn middle(&self) -> Point {
        0.5 * (self.least + self.greatest)
    }

    /// Whether a place lies inside or on the edge.
    pub fn contains(&self, place: &Point) -> bool {
        self.least.x <= place.x
            && place.x <= self.greatest.x
            && self.least.y <= place.y
            && place.y <= self.greatest.y
    }

    /// Whether both have an area in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.least.x < other.greatest.x
            && other.least.x < self.greatest.x
            && self.least.y < other.greatest.y
            && other.least.y < self.greatest.y
    }
}

impl Text {
    /// The rectangle that the text takes.
    pub fn bounds(&self) -> Bounds {
        let width = crate::typeface::width(&self.text, self.size);
        let left = match self.anchor {
            Anchor::Start => self.at.x,
            Anchor::Middle => self.at.x - 0.5 * width,
        };
        Bounds {
            least: Point::new(left, self.at.y - ASCENT * self.size),
            greatest: Point::new(left + width, self.at.y + DESCENT * self.size),
        }
    }
}

/// Height of letters above the base line, in sizes.
pub(super) const ASCENT: f64 = 0.78;
/// Depth of letters below the base line, in sizes.
pub(super) const DESCENT: f64 = 0.24;
/// Length of the head of an arrow.
pub(super) const HEAD: f64 = 9.0;
/// Width of the head of an arrow.
pub(super) const HEAD_WIDTH: f64 = 7.0;

impl Shape {
    /// The rectangle that the shape takes, without the width of its lines; none of a line without places.
    pub fn bounds(&self) -> Option<Bounds> {
        match self {
            Self::Line(places) | Self::Area(places) => Bounds::around(places.iter().copied()),
            Self::Circle(centre, radius) => Bounds::around([*centre]).map(|bounds| bounds.widened(*radius)),
            Self::Arrow { from, to } => Bounds::around([*from, *to]),
            Self::Head(tip, direction) => Bounds::around(head(*tip, *direction)),
            Self::Text(text) => Some(text.bounds()),
        }
    }

    fn shift(&mut self, by: Point) {
        match self {
            Self::Line(places) | Self::Area(places) => places.iter_mut().for_each(|place| *place += by),
            Self::Circle(place, _) | Self::Head(place, _) => *place += by,
            Self::Arrow { from, to } => {
                *from += by;
                *to += by;
            }
            Self::Text(text) => text.at += by,
        }
    }
}

/// The corners of the head of an arrow.
pub(super) fn head(tip: Point, direction: Point) -> [Point; 3] {
    let back = tip - direction * HEAD;
    let side = Point::new(-direction.y, direction.x) * (0.5 * HEAD_WIDTH);
    [tip, back + side, back - side]
}

impl Scene {
    /// Adds a shape.
    pub fn add(&mut self, class: Class, shape: Shape) {
        self.elements.push(Element { class, shape });
    }

    /// Adds a line of text.
    pub fn write(&mut self, class: Class, text: Text) {
        self.add(class, Shape::Text(text));
    }

    /// The bounds of all shapes; none of an empty scene.
    pub fn bounds(&self) -> Option<Bounds> {
        self.elements.iter().filter_map(|element| element.shape.bounds()).reduce(Bounds::with)
    }

    /// Moves everything.
    #[must_use]
    pub fn shifted(mut self, by: Point) -> Self {
        self.elements.iter_mut().for_each(|element| element.shape.shift(by));
        self
    }

    /// The texts with their classes.
    pub fn texts(&self) -> impl Iterator<Item = (Class, &Text)> {
        self.elements.iter().filter_map(|element| match &element.shape {
            Shape::Text(text) => Some((element.class, text)),
            _ => None,
        })
    }
}
