//! Friction of one contact: Coulomb's law at rest and while sliding, with preloads (theory, sections 1, 3 and
//! 8).

use super::{AffineExpression, ContactPhase, JointPhase};
use crate::ids::ContactId;
use crate::mechanism::{Contact, Mechanism};
use crate::model::PreloadLine;
use crate::modes::Side;

/// What Coulomb's law says of a contact, in units in which forces are of order one; two numbers are those of
/// both sides.
#[derive(Debug, Clone)]
pub(crate) struct Law {
    /// Kinetic friction coefficients.
    mu: [f64; 2],
    /// Preloads.
    preload: [f64; 2],
    line: PreloadLine,
    /// Whether the friction of the preload acts at another face when the side changes.
    changes_face: bool,
    /// Whether static friction that grows with the normal force is an unknown.
    holds: [bool; 2],
}

/// Friction of a contact in a state, as expressions of unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Friction {
    law: Law,
    contact: ContactPhase,
    /// At the faces of positive and of negative normal force.
    pub(crate) faces: [AffineExpression; 2],
    /// |N|; zero in a preload gap.
    pub(crate) pressure: AffineExpression,
    /// Unknown frictions of a contact that sticks: at the faces, and in the middle between them.
    held: [Option<usize>; 3],
    /// Share of the positive face in a preload gap that slips.
    pub(crate) share: Option<usize>,
}

/// What an inequality says of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bound {
    /// |N| >= 0
    Pressure,
    /// 0 <= share <= 1
    Share,
    /// |F| <= mu_static |N| + F_0
    Friction,
}

impl Law {
    /// The law of a contact, which may have other coefficients than in the mechanism, with this unit of
    /// force; without preload for impulses.
    pub(crate) fn new(
        mechanism: &Mechanism,
        (k, contact): (usize, &Contact),
        (unit, has_preload): (f64, bool),
        holds: [bool; 2],
    ) -> Self {
        Self {
            mu: contact.mu,
            preload: if has_preload { contact.preload.map(|preload| preload / unit) } else { [0.0; 2] },
            line: contact.preload_line,
            changes_face: mechanism.preload_changes_face(ContactId(k)),
            holds,
        }
    }

    /// `F = (mu |N| + F_0) s` of a contact that slides with the sign `s` against a side, eq. (2): at both
    /// faces the factor of |N| and the constant.
    pub(crate) fn kinetic(&self, side: Side, sign: f64) -> [[f64; 2]; 2] {
        let mut faces = [[0.0; 2]; 2];
        faces[face(side)][0] = self.mu[face(side)] * sign;
        let preload = self.of_preload(face(side), sign);
        [0, 1].map(|at| [faces[at][0], preload[at]])
    }

    /// The friction of the preload of a side, at both faces.
    fn of_preload(&self, side: usize, sign: f64) -> [f64; 2] {
        let mut faces = [0.0; 2];
        faces[side] = self.preload[side] * sign;
        self.line.of_faces(faces)
    }

    /// `(share F_0^+ W^+ + (1 - share) F_0^- W^-) s` in a preload gap: at both faces the factor of the share
    /// and the constant.
    pub(crate) fn in_gap(&self, sign: f64) -> [[f64; 2]; 2] {
        let [plus, minus] = [0, 1].map(|side| self.of_preload(side, sign));
        [0, 1].map(|at| [plus[at] - minus[at], minus[at]])
    }
}

impl Friction {
    /// The friction of a contact whose joint and which itself does this, with this |N|; unknowns are made
    /// where they are needed.
    pub(crate) fn new(
        law: Law,
        (joint, contact): (JointPhase, ContactPhase),
        pressure: AffineExpression,
        mut unknown: impl FnMut() -> usize,
    ) -> Self {
        let mut friction =
            Self { law, contact, faces: Default::default(), pressure, held: [None; 3], share: None };
        match (joint, contact) {
            (JointPhase::Sliding(sign), ContactPhase::Pressed(side)) => {
                let pressure = &friction.pressure;
                let faces = friction.law.kinetic(side, sign);
                friction.faces = faces.map(|[factor, constant]| affine(factor, pressure).shifted(constant));
            }
            (JointPhase::Sliding(sign), ContactPhase::PreloadGap) => {
                let share = unknown();
                friction.share = Some(share);
                let share = AffineExpression::unknown(share, 1.0);
                let faces = friction.law.in_gap(sign);
                friction.faces = faces.map(|[factor, constant]| affine(factor, &share).shifted(constant));
            }
            (JointPhase::Sticking, ContactPhase::Pressed(side)) => {
                let Law { preload, line, holds, .. } = friction.law;
                let has_preload = preload[face(side)] > 0.0;
                let centred = line == PreloadLine::Centre;
                if holds[face(side)] || (has_preload && !centred) {
                    friction.hold(face(side), &mut unknown);
                }
                if has_preload && centred {
                    friction.hold(2, &mut unknown);
                }
            }
            (JointPhase::Sticking, ContactPhase::PreloadGap) if friction.law.changes_face => {
                for side in [0, 1] {
                    if friction.law.preload[side] > 0.0 {
                        friction.hold(side, &mut unknown);
                    }
                }
            }
            // The friction of the preload is the same at both faces.
            (JointPhase::Sticking, ContactPhase::PreloadGap) if friction.law.preload != [0.0; 2] => {
                friction.hold(2, &mut unknown);
            }
            (JointPhase::Sticking, ContactPhase::PreloadGap) => {}
        }
        friction
    }

    /// Adds an unknown friction at a face, or in the middle between both.
    fn hold(&mut self, place: usize, unknown: &mut impl FnMut() -> usize) {
        let found = unknown();
        self.held[place] = Some(found);
        match place {
            2 => self.faces.iter_mut().for_each(|face| face.terms.push((found, 0.5))),
            place => self.faces[place].terms.push((found, 1.0)),
        }
    }

    /// N, with its sign.
    pub(crate) fn normal_force(&self) -> AffineExpression {
        match self.contact {
            ContactPhase::Pressed(side) => self.pressure.times(side.sign()),
            ContactPhase::PreloadGap => AffineExpression::default(),
        }
    }

    /// Every inequality `slack >= 0` of the contact, with these static friction coefficients. The friction of
    /// a joint that is to stick only at the end of an impulse opposes this sign of the sliding velocity.
    pub(crate) fn bounds(&self, mu_static: [f64; 2], opposes: Option<f64>) -> Vec<(Bound, AffineExpression)> {
        let mut all = Vec::new();
        if self.contact != ContactPhase::PreloadGap {
            all.push((Bound::Pressure, self.pressure.clone()));
        }
        if let Some(share) = self.share {
            all.push((Bound::Share, AffineExpression::unknown(share, 1.0)));
            all.push((Bound::Share, AffineExpression::unknown(share, -1.0).shifted(1.0)));
        }
        all.extend(self.cone(mu_static, opposes).into_iter().map(|slack| (Bound::Friction, slack)));
        all
    }

    /// |F| <= mu_static |N| + F_0 of a contact that sticks.
    fn cone(&self, mu_static: [f64; 2], opposes: Option<f64>) -> Vec<AffineExpression> {
        let preload = self.law.preload;
        let limits = match (self.contact, self.held) {
            (ContactPhase::PreloadGap, [Some(plus), Some(minus), _]) => {
                return between_faces([plus, minus], preload);
            }
            // In the middle between the faces share F_0^+ + (1 - share) F_0^- is at most the greater of both.
            (ContactPhase::PreloadGap, _) => {
                [preload[0], preload[1], preload[0].max(preload[1])].map(AffineExpression::constant)
            }
            (ContactPhase::Pressed(side), _) => {
                let limits = self.law.line.limits_at_rest(mu_static[face(side)], preload[face(side)]);
                let [at_face, between] =
                    limits.map(|[mu, constant]| affine(mu, &self.pressure).shifted(constant));
                [at_face.clone(), at_face, between]
            }
        };
        let held = self.held.into_iter().zip(limits).filter_map(|(unknown, limit)| Some((unknown?, limit)));
        held.flat_map(|(unknown, limit)| {
            let friction = |sign: f64| AffineExpression::unknown(unknown, sign);
            match opposes {
                None => [1.0, -1.0].map(|sign| limit.clone().plus(1.0, &friction(sign))),
                Some(sign) => [friction(sign), limit.plus(1.0, &friction(-sign))],
            }
        })
        .collect()
    }
}

/// F^+/F_0^+ + F^-/F_0^- <= 1 for all signs, in units of the lesser preload.
fn between_faces([plus, minus]: [usize; 2], preload: [f64; 2]) -> Vec<AffineExpression> {
    let least = preload[0].min(preload[1]);
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let corner = |(first, second): (f64, f64)| {
        AffineExpression::unknown(plus, first * least / preload[0])
            .plus(second * least / preload[1], &AffineExpression::unknown(minus, 1.0))
            .shifted(least)
    };
    signs.into_iter().map(corner).collect()
}

/// The couple of a guided slider.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GuidedCouple {
    /// Its place among the unknowns.
    pub(crate) unknown: usize,
    /// Half the length of the pressed face (m).
    pub(crate) half_length: f64,
}

/// |C| <= |N| L/2 of a guided slider: the slacks of both signs of the couple.
pub(crate) fn without_tipping(
    pressure: &AffineExpression,
    couple: &AffineExpression,
    half_length: f64,
) -> [AffineExpression; 2] {
    [1.0, -1.0].map(|sign| pressure.times(half_length).plus(sign, couple))
}

/// So many times an expression, without terms that are zero.
fn affine(factor: f64, expression: &AffineExpression) -> AffineExpression {
    if factor == 0.0 { AffineExpression::default() } else { expression.times(factor) }
}

/// Which of two versions belongs to a side.
pub(crate) fn face(side: Side) -> usize {
    usize::from(side == Side::Negative)
}
