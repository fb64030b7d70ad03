//! Joints of a drawing.

use super::entry::Table;
use super::quantity::{self, Quantity};
use super::{Drawing, Frame};
use crate::ids::{ContactId, JointId};
use crate::model::PinLaw;
use std::marker::PhantomData;

/// A hinge of a [`Drawing`].
#[derive(Debug)]
pub struct HingeBuilder<'d> {
    drawing: &'d mut Drawing,
    id: JointId,
    name: String,
    between: [Frame; 2],
}

impl<'d> HingeBuilder<'d> {
    pub(super) fn new(drawing: &'d mut Drawing, name: &str, between: [Frame; 2]) -> Self {
        let id = JointId(drawing.joints.add(name));
        drawing.joints.table(id.index()).set("type", quantity::text("hinge"));
        Self { drawing, id, name: name.to_owned(), between }
    }

    /// Its place in the drawing (m): that of the hinged point of both bodies.
    pub fn at(self, place: [impl Into<Quantity>; 2]) -> Self {
        let place = quantity::pair(place);
        let ends = self.between.map(|frame| self.drawing.point(frame, &self.name, place.clone()));
        let between = quantity::list(ends.map(|end| quantity::text(&end)));
        self.set("between", between)
    }

    fn set(self, key: &str, value: Quantity) -> Self {
        self.drawing.joints.table(self.id.index()).set(key, value);
        self
    }

    /// Kinetic friction coefficient of its pin, which needs a [`Self::radius`]. Default: no friction.
    pub fn mu(self, mu: impl Into<Quantity>) -> Self {
        self.set("mu", mu.into())
    }

    /// Static friction coefficient of its pin, not below the kinetic one, which it is by default.
    pub fn mu_static(self, mu: impl Into<Quantity>) -> Self {
        self.set("mu_static", mu.into())
    }

    /// Radius of its pin (m).
    pub fn radius(self, radius: impl Into<Quantity>) -> Self {
        self.set("radius", radius.into())
    }

    /// How the radius of the friction circle follows from the pin. Default: that of the total reaction.
    pub fn law(self, law: PinLaw) -> Self {
        let word = match law {
            PinLaw::TotalReaction => "total_reaction",
            PinLaw::MuRho => "mu_rho",
        };
        self.set("law", quantity::text(word))
    }

    /// Radius of its friction circle (m), in place of pin and coefficient.
    pub fn friction_radius(self, radius: impl Into<Quantity>) -> Self {
        self.set("friction_radius", radius.into())
    }

    /// Radius of its friction circle at rest (m), not below that while it turns, which it is by default.
    pub fn static_friction_radius(self, radius: impl Into<Quantity>) -> Self {
        self.set("static_friction_radius", radius.into())
    }

    /// The handle.
    pub fn id(self) -> JointId {
        self.id
    }
}

/// The handle of a sliding joint of some kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slider<K> {
    joint: JointId,
    first: ContactId,
    kind: PhantomData<K>,
}

impl<K> From<Slider<K>> for JointId {
    fn from(slider: Slider<K>) -> Self {
        slider.joint
    }
}

impl<K: TwoContacts> Slider<K> {
    /// The contact at the end in the direction of `along`.
    pub fn front(self) -> ContactId {
        self.first
    }

    /// The contact at the other end.
    pub fn rear(self) -> ContactId {
        ContactId(self.first.index() + 1)
    }
}

impl<K: OneContact> Slider<K> {
    /// Its contact.
    pub fn contact(self) -> ContactId {
        self.first
    }
}

/// A kind of sliding joint.
pub trait SliderKind: Copy + sealed::Sealed {
    #[doc(hidden)]
    const TYPE: &'static str;
    #[doc(hidden)]
    const CONTACTS: usize;
    #[doc(hidden)]
    const IMPACTS: Option<&'static str>;
}

/// The kinds with a contact at the front and one at the rear.
pub trait TwoContacts: SliderKind {}
/// The kinds with one contact.
pub trait OneContact: SliderKind {}
/// The kinds that have a length along a straight guide.
pub trait HasLength: SliderKind {}
/// The kinds whose block is held between two faces some distance apart.
pub trait BetweenFaces: SliderKind {}
/// The kinds with a place and a direction of their own: on a straight guide or face.
pub trait OnLine: SliderKind {
    #[doc(hidden)]
    const PLACE: &'static str = "at";
}
/// The kinds that press two faces.
pub trait TwoFaces: SliderKind {}
/// The kinds that may lift off.
pub trait MayLiftOff: SliderKind {}

mod sealed {
    pub trait Sealed {}
}

/// Defines the kinds: the name of the handle, that of the kind, the type in the model file, the number of contacts, the table of
/// stops if its impacts are at these, and what it shares with other kinds.
macro_rules! kinds {
    ($($(#[$doc:meta])* $handle:ident = $kind:ident, $type:literal, $contacts:literal, $impacts:expr; $($trait:ident),*;)*) => {
        /// The kinds of sliding joints.
        pub mod kind {
            $($(#[$doc])*
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            pub enum $kind {})*
        }

        $(impl sealed::Sealed for kind::$kind {}
        impl SliderKind for kind::$kind {
            const TYPE: &'static str = $type;
            const CONTACTS: usize = $contacts;
            const IMPACTS: Option<&'static str> = $impacts;
        }
        $(impl $trait for kind::$kind {})*
        $(#[$doc])*
        pub type $handle = Slider<kind::$kind>;)*
    };
}

kinds! {
    /// A block in a guide: a joint with two contacts.
    BlockSlider = Block, "block_slider", 2, Some("stop"); TwoContacts, HasLength, BetweenFaces, OnLine, TwoFaces;
    /// A slider pressed on one side along its whole length: a joint with one contact.
    GuidedSlider = Guided, "guided_slider", 1, Some("stop"); OneContact, HasLength, BetweenFaces, OnLine, TwoFaces;
    /// A pin in a slot: a joint with one contact.
    PinInSlot = Pin, "pin_in_slot", 1, Some("stop"); OneContact, OnLine, TwoFaces;
    /// A block on a face, which both of its corners may leave: a joint with two contacts.
    BlockOnFace = OnFace, "block_on_face", 2, None; TwoContacts, HasLength, OnLine, MayLiftOff;
    /// A corner on a face, which it may leave: a joint with one contact.
    CornerOnFace = Corner, "corner_on_face", 1, None; OneContact, OnLine, MayLiftOff;
    /// A disc on a face, which it may leave: a joint with one contact.
    DiscOnFace = Disc, "disc_on_face", 1, None; OneContact, MayLiftOff;
    /// A disc on a disc or in a hole, which it may leave: a joint with one contact.
    DiscOnDisc = Discs, "disc_on_disc", 1, None; OneContact, MayLiftOff;
}

impl OnLine for kind::Disc {
    const PLACE: &'static str = "centre";
}

/// A sliding joint of a [`Drawing`]. What belongs to some kinds of joints only is in the methods of these.
#[derive(Debug)]
pub struct SliderBuilder<'d, K> {
    drawing: &'d mut Drawing,
    name: String,
    between: [Frame; 2],
    handle: Slider<K>,
}

impl<'d, K: SliderKind> SliderBuilder<'d, K> {
    fn of_kind(drawing: &'d mut Drawing, name: &str, between: [Frame; 2]) -> Self {
        let joint = JointId(drawing.joints.add(name));
        let first = ContactId(drawing.contacts);
        drawing.contacts += K::CONTACTS;
        drawing.joints.table(joint.index()).set("type", quantity::text(K::TYPE));
        Self { drawing, name: name.to_owned(), between, handle: Slider { joint, first, kind: PhantomData } }
    }

    fn table(&mut self) -> &mut Table {
        self.drawing.joints.table(self.handle.joint.index())
    }

    fn set(mut self, key: &str, value: Quantity) -> Self {
        self.table().set(key, value);
        self
    }

    /// Coefficient of restitution, from 0 to 1: of impacts on the faces of what may lift off (default: 0), else of stops at both
    /// ends of the travel.
    pub fn restitution(mut self, restitution: impl Into<Quantity>) -> Self {
        let table = self.table();
        let of_impacts = match K::IMPACTS {
            Some(stop) => table.inner(stop),
            None => table,
        };
        of_impacts.set("restitution", restitution.into());
        self
    }

    /// The handle.
    pub fn id(self) -> Slider<K> {
        self.handle
    }
}

impl<'d, K: OnLine> SliderBuilder<'d, K> {
    pub(super) fn new(drawing: &'d mut Drawing, name: &str, between: [Frame; 2]) -> Self {
        let [block, guide] = between.map(|frame| drawing.frame(frame));
        let slider = Self::of_kind(drawing, name, between);
        slider.set("block", block).set("guide", guide).set("along", 0.0.into())
    }

    /// Middle of the block, the pin, the corner, or the centre of the disc, in the drawing (m).
    pub fn at(self, place: [impl Into<Quantity>; 2]) -> Self {
        self.set(K::PLACE, quantity::pair(place))
    }

    /// Direction of positive sliding: the angle from the x axis (rad). Default: 0. What lies on a face is to its left.
    pub fn along(self, angle: impl Into<Quantity>) -> Self {
        self.set("along", angle.into())
    }

    /// Limits of the displacement (m).
    pub fn travel(self, limits: [impl Into<Quantity>; 2]) -> Self {
        self.set("travel", quantity::pair(limits))
    }
}

impl<'d> SliderBuilder<'d, kind::Discs> {
    pub(super) fn of_discs(drawing: &'d mut Drawing, name: &str, between: [Frame; 2]) -> Self {
        Self::of_kind(drawing, name, between)
    }

    /// Both centres in the drawing (m), the disc's first.
    pub fn centres(self, places: [[impl Into<Quantity>; 2]; 2]) -> Self {
        let [disc, other] = self.between;
        let [first, second] = places.map(quantity::pair);
        let ends = [(disc, first), (other, second)];
        let ends = ends.map(|(frame, place)| quantity::text(&self.drawing.point(frame, &self.name, place)));
        self.set("centres", quantity::list(ends))
    }

    /// Both radii (m), the disc's first.
    pub fn radii(self, radii: [impl Into<Quantity>; 2]) -> Self {
        self.set("radii", quantity::pair(radii))
    }

    /// The second body has a hole, and the disc is in it. Default: it is beside a disc.
    pub fn inside(self) -> Self {
        self.set("inside", Quantity::truth(true))
    }
}

impl<K: MayLiftOff + OnLine> SliderBuilder<'_, K> {
    /// A straight face with both of its ends in the drawing (m), in place of [`along`](Self::along): what lies on it is to the left
    /// of the way from one to the other.
    pub fn face<P: Into<Quantity>>(mut self, ends: [[P; 2]; 2]) -> Self {
        let (guide, name) = (self.between[1], self.name.clone());
        let ends = self.drawing.ends(&name, ends.map(|place| (guide, place)));
        self.table().remove("along");
        self.set("face", ends)
    }
}

impl<K: MayLiftOff> SliderBuilder<'_, K> {
    /// It does not touch in the state to be solved. Default: it does.
    pub fn apart(self) -> Self {
        self.set("closed", Quantity::truth(false))
    }

    /// It does not slip in the state to be solved: it rolls or stands, which takes a coordinate less. Default: it slides.
    pub fn sticks(self) -> Self {
        self.set("sticks", Quantity::truth(true))
    }
}

/// Defines the setters of contact properties: of a sliding joint for all of its contacts, of a block for one.
macro_rules! contact_properties {
    ($self:ident: $receiver:ty) => {
        /// Coefficient of kinetic friction. Required for every contact.
        pub fn mu($self: $receiver, mu: impl Into<Quantity>) -> $receiver {
            $self.set("mu", mu.into())
        }

        /// Sets the coefficients of kinetic friction for positive and for negative normal force.
        pub fn mu_by_side(
            $self: $receiver,
            plus: impl Into<Quantity>,
            minus: impl Into<Quantity>,
        ) -> $receiver {
            $self.set("mu", by_side(plus, minus))
        }

        /// Coefficient of static friction. Default: that of kinetic friction.
        pub fn mu_static($self: $receiver, mu: impl Into<Quantity>) -> $receiver {
            $self.set("mu_static", mu.into())
        }

        /// Friction at zero normal force (N). Default: 0.
        pub fn preload($self: $receiver, force: impl Into<Quantity>) -> $receiver {
            $self.set("preload", force.into())
        }

        /// Sets the friction at zero normal force (N) at the faces of positive and of negative normal force.
        pub fn preload_by_side(
            $self: $receiver,
            plus: impl Into<Quantity>,
            minus: impl Into<Quantity>,
        ) -> $receiver {
            $self.set("preload", by_side(plus, minus))
        }

        /// Stiffness of the guide at a contact (N/m), for attainability, and for how redundant contacts share a load.
        pub fn stiffness($self: $receiver, stiffness: impl Into<Quantity>) -> $receiver {
            $self.set("stiffness", stiffness.into())
        }

        /// Total play between the two faces (m), which counts where redundant contacts share a load; negative for a
        /// press fit. Default: 0.
        pub fn play($self: $receiver, play: impl Into<Quantity>) -> $receiver {
            $self.set("play", play.into())
        }

        /// How far the guide's line is displaced at a contact, towards +n (m), which counts where redundant contacts
        /// share a load; may depend on coordinates. Default: 0.
        pub fn misalignment($self: $receiver, displacement: impl Into<Quantity>) -> $receiver {
            $self.set("misalignment", displacement.into())
        }

        /// Length and width of the area in contact at a contact (m), for the bearing pressure.
        pub fn pad($self: $receiver, [length, width]: [impl Into<Quantity>; 2]) -> $receiver {
            let sizes = [("length", &length.into()), ("width", &width.into())];
            $self.set("pad", Quantity::table(sizes.into_iter()))
        }
    };
}

impl<K: SliderKind> SliderBuilder<'_, K> {
    contact_properties!(self: Self);
}

impl ContactBuilder<'_> {
    contact_properties!(self: &mut Self);
}

impl<K: HasLength> SliderBuilder<'_, K> {
    /// Distance of the two contacts of a block; length of the pressed face of a guided slider (m).
    pub fn length(self, length: impl Into<Quantity>) -> Self {
        self.set("length", length.into())
    }
}

impl<K: BetweenFaces> SliderBuilder<'_, K> {
    /// Distance of the two rubbing faces (m). Default: 0.
    pub fn height(self, height: impl Into<Quantity>) -> Self {
        self.set("height", height.into())
    }

    /// The block surrounds the guide, as a sleeve its rod. Default: it is inside.
    pub fn around(self) -> Self {
        self.set("fit", quantity::text("around"))
    }

    /// The preload's friction acts on the centre line. Default: at the pressed face.
    pub fn centred_preload(self) -> Self {
        self.set("preload_line", quantity::text("centre"))
    }
}

impl<K: TwoFaces> SliderBuilder<'_, K> {
    /// In a motion each face is taken by itself, with this coefficient of restitution, and the block rattles within its
    /// [`play`](Self::play). Default: it follows the centre line.
    pub fn loose(self, restitution: impl Into<Quantity>) -> Self {
        self.set("loose", Quantity::truth(true)).set("restitution", restitution.into())
    }
}

impl SliderBuilder<'_, kind::Disc> {
    /// Radius of the disc (m).
    pub fn radius(self, radius: impl Into<Quantity>) -> Self {
        self.set("radius", radius.into())
    }
}

impl<K: TwoContacts> SliderBuilder<'_, K> {
    /// Sets the properties in which the front contact differs.
    pub fn front(mut self, of: impl FnOnce(&mut ContactBuilder<'_>)) -> Self {
        of(&mut ContactBuilder(self.table().inner("front")));
        self
    }

    /// Sets the properties in which the rear contact differs.
    pub fn rear(mut self, of: impl FnOnce(&mut ContactBuilder<'_>)) -> Self {
        of(&mut ContactBuilder(self.table().inner("rear")));
        self
    }
}

impl SliderBuilder<'_, kind::Block> {
    /// A further contact, so far from the middle of the block in the direction of `along` (m): with it the block is
    /// redundantly guided. A name that was given before is that of the same contact.
    pub fn support(
        mut self,
        name: &str,
        at: impl Into<Quantity>,
        of: impl FnOnce(&mut ContactBuilder<'_>),
    ) -> Self {
        let support = self.table().inner("supports").inner(name);
        let is_new = support.is_empty();
        support.set("at", at.into());
        of(&mut ContactBuilder(support));
        self.drawing.contacts += usize::from(is_new);
        self
    }
}

/// One contact of a block.
#[derive(Debug)]
pub struct ContactBuilder<'t>(&'t mut Table);

impl ContactBuilder<'_> {
    fn set(&mut self, key: &str, value: Quantity) -> &mut Self {
        self.0.set(key, value);
        self
    }

    /// The contact stays at a place of the guide, such as the mouth of a carcass. Default: it travels with
    /// the block.
    pub fn carried_by_guide(&mut self) -> &mut Self {
        self.set("carried_by", quantity::text("guide"))
    }

    /// The preload's friction acts on the centre line. Default: at the pressed face.
    pub fn centred_preload(&mut self) -> &mut Self {
        self.set("preload_line", quantity::text("centre"))
    }
}

fn by_side(plus: impl Into<Quantity>, minus: impl Into<Quantity>) -> Quantity {
    Quantity::table([("plus", &plus.into()), ("minus", &minus.into())].into_iter())
}
