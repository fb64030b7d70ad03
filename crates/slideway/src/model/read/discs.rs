//! A disc on a disc, or in a hole.

use super::super::file::{ContactTable, DiscOnDiscTable};
use super::super::quantity::Span;
use super::super::{Along, Round, Slider, SliderKind, Touches};
use super::{Reader, Wanted};
use crate::expression::Dimension;

impl Reader<'_> {
    pub(super) fn disc_on_disc(
        &mut self,
        (discs, contact): &(DiscOnDiscTable, ContactTable),
        name: &str,
        span: &Span,
    ) -> Slider {
        let friction = self.friction(contact, false, name, span);
        let mut contacts = vec![self.contact(friction, name.to_owned(), name, span)];
        let touches = if discs.closed == Some(false) { Touches::Nothing } else { Touches::All };
        let apart = self.open(&mut contacts, touches);
        let [block, guide] = discs.centres.each_ref().map(|centre| self.attachment(centre));
        let [radius, guide_radius] = discs.radii.each_ref().map(|radius| {
            let wanted = Wanted::constant(format!("a radius of {name}"), Dimension::LENGTH);
            self.formula(radius, wanted.not_negative())
        });
        let inside = discs.inside == Some(true);
        let (at, centre) = (block.position, guide.position);
        Slider {
            kind: SliderKind::Pin,
            block: block.frame,
            guide: guide.frame,
            at,
            z: None,
            along: Along::Across(if inside { [at, centre] } else { [centre, at] }),
            length: None,
            height: None,
            radius: Some(radius),
            round: Some(Round { centre, radius: guide_radius, inside }),
            touches,
            sticks: self.sticks(discs.sticks, touches, name, span),
            around: false,
            loose: false,
            travel: None,
            has_ends: false,
            stops: [None; 2],
            contacts,
            apart,
            ends: Vec::new(),
        }
    }
}
