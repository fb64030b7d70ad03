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

/// A block slider: a joint with two contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BlockSlider {
    joint: JointId,
    front: ContactId,
}

impl BlockSlider {
    /// The contact at the end in the direction of `along`.
    pub fn front(self) -> ContactId {
        self.front
    }

    /// The contact at the other end.
    pub fn rear(self) -> ContactId {
        ContactId(self.front.index() + 1)
    }
}

/// A guided slider, or a pin in a slot: a joint with one contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingleSlider<const GUIDED: bool> {
    joint: JointId,
    contact: ContactId,
}

impl<const GUIDED: bool> SingleSlider<GUIDED> {
    /// Its contact.
    pub fn contact(self) -> ContactId {
        self.contact
    }
}

/// A block on a face, which both of its corners may leave: a joint with two contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BlockOnFace(BlockSlider);

impl BlockOnFace {
    /// The corner at the end in the direction of `along`.
    pub fn front(self) -> ContactId {
        self.0.front()
    }

    /// The corner at the other end.
    pub fn rear(self) -> ContactId {
        self.0.rear()
    }
}

/// A corner on a face, which it may leave: a joint with one contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CornerOnFace(SingleSlider<false>);

impl CornerOnFace {
    /// Its contact.
    pub fn contact(self) -> ContactId {
        self.0.contact()
    }
}

/// A disc on a face, which it may leave: a joint with one contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DiscOnFace(SingleSlider<false>);

impl DiscOnFace {
    /// Its contact.
    pub fn contact(self) -> ContactId {
        self.0.contact()
    }
}

impl From<DiscOnFace> for JointId {
    fn from(disc: DiscOnFace) -> Self {
        disc.0.into()
    }
}

impl From<BlockOnFace> for JointId {
    fn from(block: BlockOnFace) -> Self {
        block.0.into()
    }
}

impl From<CornerOnFace> for JointId {
    fn from(corner: CornerOnFace) -> Self {
        corner.0.into()
    }
}

impl From<BlockSlider> for JointId {
    fn from(slider: BlockSlider) -> Self {
        slider.joint
    }
}

impl<const GUIDED: bool> From<SingleSlider<GUIDED>> for JointId {
    fn from(slider: SingleSlider<GUIDED>) -> Self {
        slider.joint
    }
}

/// The handle of a sliding joint.
pub trait SliderHandle: Copy + sealed::Sealed {
    #[doc(hidden)]
    const TYPE: &'static str;
    #[doc(hidden)]
    const CONTACTS: usize;
    #[doc(hidden)]
    const PLACE: &'static str = "at";
    #[doc(hidden)]
    fn of(joint: JointId, first: ContactId) -> Self;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::BlockSlider {}
    impl<const GUIDED: bool> Sealed for super::SingleSlider<GUIDED> {}
    impl Sealed for super::BlockOnFace {}
    impl Sealed for super::CornerOnFace {}
    impl Sealed for super::DiscOnFace {}
}

impl SliderHandle for BlockSlider {
    const TYPE: &'static str = "block_slider";
    const CONTACTS: usize = 2;
    fn of(joint: JointId, front: ContactId) -> Self {
        Self { joint, front }
    }
}

impl<const GUIDED: bool> SliderHandle for SingleSlider<GUIDED> {
    const TYPE: &'static str = if GUIDED { "guided_slider" } else { "pin_in_slot" };
    const CONTACTS: usize = 1;
    fn of(joint: JointId, contact: ContactId) -> Self {
        Self { joint, contact }
    }
}

impl SliderHandle for BlockOnFace {
    const TYPE: &'static str = "block_on_face";
    const CONTACTS: usize = 2;
    fn of(joint: JointId, front: ContactId) -> Self {
        Self(BlockSlider::of(joint, front))
    }
}

impl SliderHandle for DiscOnFace {
    const TYPE: &'static str = "disc_on_face";
    const CONTACTS: usize = 1;
    const PLACE: &'static str = "centre";
    fn of(joint: JointId, contact: ContactId) -> Self {
        Self(SingleSlider::of(joint, contact))
    }
}

impl SliderHandle for CornerOnFace {
    const TYPE: &'static str = "corner_on_face";
    const CONTACTS: usize = 1;
    fn of(joint: JointId, contact: ContactId) -> Self {
        Self(SingleSlider::of(joint, contact))
    }
}

/// A sliding joint of a [`Drawing`]. What belongs to one kind of joint only is in that kind's methods.
#[derive(Debug)]
pub struct SliderBuilder<'d, S> {
    drawing: &'d mut Drawing,
    id: JointId,
    first: ContactId,
    handle: PhantomData<S>,
}

impl<'d, S: SliderHandle> SliderBuilder<'d, S> {
    pub(super) fn new(drawing: &'d mut Drawing, name: &str, [block, guide]: [Frame; 2]) -> Self {
        let id = JointId(drawing.joints.add(name));
        let first = ContactId(drawing.contacts);
        drawing.contacts += S::CONTACTS;
        let (block, guide) = (drawing.frame(block), drawing.frame(guide));
        let table = drawing.joints.table(id.index());
        table.set("type", quantity::text(S::TYPE));
        table.set("block", block);
        table.set("guide", guide);
        table.set("along", 0.0.into());
        Self { drawing, id, first, handle: PhantomData }
    }

    fn table(&mut self) -> &mut Table {
        self.drawing.joints.table(self.id.index())
    }

    fn set(mut self, key: &str, value: Quantity) -> Self {
        self.table().set(key, value);
        self
    }

    /// Middle of the block, the pin, or the centre of the disc, in the drawing (m).
    pub fn at(self, place: [impl Into<Quantity>; 2]) -> Self {
        self.set(S::PLACE, quantity::pair(place))
    }

    /// Direction of positive sliding: the angle from the x axis (rad). Default: 0.
    pub fn along(self, angle: impl Into<Quantity>) -> Self {
        self.set("along", angle.into())
    }

    /// Limits of the displacement (m).
    pub fn travel(self, limits: [impl Into<Quantity>; 2]) -> Self {
        self.set("travel", quantity::pair(limits))
    }

    /// Stops at both ends of the travel, with a coefficient of restitution from 0 to 1.
    pub fn restitution(mut self, restitution: impl Into<Quantity>) -> Self {
        self.table().inner("stop").set("restitution", restitution.into());
        self
    }

    /// The handle.
    pub fn id(self) -> S {
        S::of(self.id, self.first)
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

impl<S: SliderHandle> SliderBuilder<'_, S> {
    contact_properties!(self: Self);
}

impl ContactBuilder<'_> {
    contact_properties!(self: &mut Self);
}

/// Defines the setters that a block and a guided slider have and a pin has not.
macro_rules! lengths {
    ($($slider:ty),*) => {$(
        impl SliderBuilder<'_, $slider> {
            /// Distance of the two contacts of a block; length of the pressed face of a guided slider (m).
            pub fn length(self, length: impl Into<Quantity>) -> Self {
                self.set("length", length.into())
            }

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
    )*};
}

lengths!(BlockSlider, SingleSlider<true>);

impl SliderBuilder<'_, DiscOnFace> {
    /// Radius of the disc (m).
    pub fn radius(self, radius: impl Into<Quantity>) -> Self {
        self.set("radius", radius.into())
    }
}

impl SliderBuilder<'_, BlockOnFace> {
    /// Distance of both corners (m).
    pub fn length(self, length: impl Into<Quantity>) -> Self {
        self.set("length", length.into())
    }
}

impl SliderBuilder<'_, BlockSlider> {
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
