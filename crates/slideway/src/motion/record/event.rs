//! What happens between the phases of a motion, and in words.

use crate::configuration::Configuration;
use crate::ids::{BodyId, ContactId, Frame, JointId};
use crate::mechanism::{LOOSE_FACES, Mechanism, Slider, rot90};
use crate::model::SliderKind;
use crate::modes::Side;
use crate::motion::decision::rules::Continuation;
use crate::motion::moving::cause::Cause;
use crate::pattern::phase::{ContactPhase, JointPhase, Phase, sliding_joints};
use crate::report::JointMode;
use crate::report::number::against;
use crate::solve::joint_mode;
use nalgebra::Vector2;

/// The words of an event that changes nothing.
const NOTHING: &str = "it continues as before";

/// Something that happened at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// When (s).
    pub time: f64,
    /// Everything that came together.
    pub causes: Vec<Cause>,
    /// The phase that follows; nothing where the motion ends.
    pub phase: Option<Phase>,
    /// All phases that were possible, in their order.
    pub successors: Vec<Continuation>,
    /// Whether some in which fewer joints stick may be missing: there are too many states to try all.
    pub left_out: bool,
    /// Which of them was taken.
    pub taken: Option<usize>,
    /// What happened, in words.
    pub words: String,
}

/// Where every sliding joint touches its guide in a phase, or that it sticks, and which hinges with friction stick: "floor
/// flat on the lower guide; sole sticks". Without sliding joints also how hinges turn. Sides are those of the
/// configuration.
pub fn modes_in_words(mechanism: &Mechanism, configuration: &Configuration, phase: &Phase) -> String {
    let sliders = sliding_joints(mechanism);
    let words = Words { mechanism, configuration, sliders: &sliders };
    let one = |(index, joint): (usize, &JointId)| match phase.joints[index] {
        JointPhase::Sticking => Some(format!("{} sticks", words.name(*joint))),
        JointPhase::Sliding(_) if words.needs_no_words(*joint) => None,
        JointPhase::Sliding(_) => Some(words.mode(words.name(*joint), *joint, phase)),
    };
    let hinges = words.hinges(phase).filter_map(|(joint, state)| match state {
        JointPhase::Sticking => Some(format!("{} sticks", words.name(joint))),
        JointPhase::Sliding(sign) if sliders.is_empty() => Some(words.turns(joint, sign)),
        JointPhase::Sliding(_) => None,
    });
    sliders.iter().enumerate().filter_map(one).chain(hinges).collect::<Vec<String>>().join("; ")
}

/// The same with the direction in which each joint slides: "floor is flat on the lower guide, sliding to the
/// right; sole sticks".
pub fn phase_in_words(mechanism: &Mechanism, configuration: &Configuration, phase: &Phase) -> String {
    let sliders = sliding_joints(mechanism);
    let words = Words { mechanism, configuration, sliders: &sliders };
    words.event(&[], None, Some(phase))
}

impl Event {
    /// Returns whether anything happens: a normal force may touch zero once more within rounding.
    pub(in crate::motion) fn is_reported(&self) -> bool {
        self.words != NOTHING
    }
}

/// Tells events of a mechanism.
pub(in crate::motion) struct Words<'a> {
    pub(in crate::motion) mechanism: &'a Mechanism,
    pub(in crate::motion) configuration: &'a Configuration,
    pub(in crate::motion) sliders: &'a [JointId],
}

impl Words<'_> {
    /// What happens at an event between two phases.
    pub(in crate::motion) fn event(
        &self,
        causes: &[Cause],
        before: Option<&Phase>,
        after: Option<&Phase>,
    ) -> String {
        let mut parts: Vec<String> = causes.iter().filter_map(|cause| self.cause(cause, after)).collect();
        if let Some(after) = after {
            if let Some(before) = before {
                parts.extend(self.changes(causes, before, after));
                parts.extend(self.changes_of_turning(causes, before, after));
            } else {
                let told = self.sliders.iter().enumerate().filter(|(_, joint)| !self.needs_no_words(**joint));
                parts.extend(told.filter_map(|(index, joint)| match self.other_face(*joint) {
                    Some(other) if other < *joint => None,
                    Some(other) => {
                        Some(format!("{} {}", self.name(*joint), self.between_faces([*joint, other], after)))
                    }
                    None => Some(format!("{} {}", self.name(*joint), self.state("is", index, *joint, after))),
                }));
                parts.extend(self.hinges(after).map(|(joint, state)| match state {
                    JointPhase::Sticking => format!("{} sticks", self.name(joint)),
                    JointPhase::Sliding(sign) => self.turns(joint, sign),
                }));
            }
        }
        if parts.is_empty() { NOTHING.to_owned() } else { parts.join("; ") }
    }

    fn energy(&self, energy: f64) -> String {
        self.mechanism.units.of("J").show(energy)
    }

    fn cause(&self, cause: &Cause, after: Option<&Phase>) -> Option<String> {
        let told = match cause {
            Cause::Start | Cause::PreloadGapEnds(..) => return None,
            // The change of side is told instead.
            Cause::NormalForceZero(contact) => match after {
                Some(_) => return None,
                None => format!("the normal force of {} vanishes", self.contact(*contact)),
            },
            Cause::Touches(contact) => format!("{} reaches its face", self.contact(*contact)),
            Cause::BareCorner { corner, joint, .. } => {
                format!("{corner} reaches the face of {}", self.mechanism.joints[joint.index()].name)
            }
            Cause::Lands { contact, speed, energy_lost } => {
                let speed = self.mechanism.units.of("m/s").brief(*speed);
                let hits = format!("{} with {speed}", self.hits(*contact));
                match energy_lost {
                    Some(energy) => format!("{hits} ({} lost)", self.mechanism.units.of("J").brief(*energy)),
                    None => hits,
                }
            }
            Cause::Stops(joint) => match after {
                Some(_) => return None,
                None => format!("{} stops", self.name(*joint)),
            },
            Cause::Slips => match after {
                Some(_) => return None,
                None => "the sticking joints can no longer stick".to_owned(),
            },
            Cause::StopsTurning(joint) => match after {
                Some(_) => return None,
                None => format!("{} stops turning", self.name(*joint)),
            },
            Cause::Locks => "friction locks this state of contact".to_owned(),
            Cause::Folds => "this state of contact ends where it meets another one (a fold)".to_owned(),
            Cause::ReactionLimit(contact) => {
                format!("the normal force of {} reaches its limit", self.contact(*contact))
            }
            Cause::Tips(joint) => format!("{} begins to tip in its guide", self.name(*joint)),
            Cause::OverlapVanishes(joint) => format!("{} leaves its guide", self.name(*joint)),
            Cause::TravelLimit { joint, .. } if self.mechanism.leaves_its_face(*joint) => {
                format!("{} reaches the end of its face", self.name(*joint))
            }
            Cause::TravelLimit { joint, greatest } => {
                format!("{} reaches the {} displacement of its travel", self.name(*joint), end(*greatest))
            }
            Cause::Hits { joint, greatest, speeds, energy_lost } => {
                let hits =
                    format!("{} hits the stop at its {} displacement", self.name(*joint), end(*greatest));
                let [before, after] = speeds.map(|speed| self.mechanism.units.of("m/s").brief(speed));
                let bounces = if against(speeds[1], speeds[0]) == "0" {
                    "without bouncing".to_owned()
                } else {
                    format!("and bounces back with {after}")
                };
                match energy_lost {
                    Some(energy) => {
                        let lost = self.mechanism.units.of("J").brief(*energy);
                        format!("{hits} with {before} {bounces} ({lost} lost)")
                    }
                    None => format!("{hits} in the same impact, with {before}, {bounces}"),
                }
            }
            Cause::MeetsPad { joint, greatest } => {
                format!("{} meets the pad at its {} displacement", self.name(*joint), end(*greatest))
            }
            Cause::LeavesPad { joint, greatest } => {
                format!("{} leaves the pad at its {} displacement", self.name(*joint), end(*greatest))
            }
            Cause::LoadJumps(name) => format!("{name} jumps"),
            Cause::User(_, name) => format!("{name} passes zero"),
            Cause::Jams { energy_lost } => {
                format!("it jams: an impulse stops it and dissipates {}", self.energy(*energy_lost))
            }
        };
        Some(told)
    }

    /// "parcel hits at wall": a contact may be called after either side of it.
    fn hits(&self, contact: ContactId) -> String {
        let slider = self.mechanism.slider(self.mechanism.contacts[contact.index()].joint);
        let body = slider.and_then(|slider| slider.block.body().or(slider.guide.body()));
        let body = body.map_or("it", |body| &self.mechanism.bodies[body.index()].name);
        let (joint, name) = (self.mechanism.contacts[contact.index()].joint, self.contact(contact));
        if self.other_face(joint).is_some() {
            return format!("{body} hits the {} face at {}", self.face(joint), loose_place(name));
        }
        format!("{body} hits at {name}")
    }

    /// What differs between two phases, joint by joint.
    fn changes(&self, causes: &[Cause], before: &Phase, after: &Phase) -> Vec<String> {
        let one = |(index, joint): (usize, &JointId)| {
            let name = self.name(*joint);
            let stops = causes.contains(&Cause::Stops(*joint));
            if self.needs_no_words(*joint) {
                return None;
            }
            if let Some(other) = self.other_face(*joint) {
                let both = [*joint, other];
                let [old, new] = [before, after].map(|phase| self.between_faces(both, phase));
                return (*joint < other && old != new).then(|| format!("{name} now {new}"));
            }
            if let Some(lifts) = self.lifting(causes, index, *joint, [before, after]) {
                return Some(lifts);
            }
            let told = match (before.joints[index], after.joints[index]) {
                (JointPhase::Sliding(_), JointPhase::Sticking) => {
                    format!("{} stops and sticks", self.touching(*joint, after).unwrap_or(name))
                }
                (JointPhase::Sticking, JointPhase::Sliding(_)) => {
                    format!("{name} starts to slide: it {}", self.state("is now", index, *joint, after))
                }
                (JointPhase::Sliding(old), JointPhase::Sliding(new)) if old != new => {
                    // That it bounces back says so already.
                    let bounces =
                        |cause: &Cause| matches!(cause, Cause::Hits { joint: hit, .. } if hit == joint);
                    if before.contacts == after.contacts && causes.iter().any(bounces) {
                        return None;
                    }
                    // Nothing happens where a joint without friction turns round: the next event tells.
                    let now = stops
                        || causes.iter().any(|cause| {
                            matches!(cause, Cause::Hits { .. } | Cause::Lands { .. } | Cause::Jams { .. })
                        });
                    let reverses = if now { "reverses" } else { "has reversed since the last event" };
                    format!("{name} {reverses}: it {}", self.state("is now", index, *joint, after))
                }
                (JointPhase::Sliding(_), JointPhase::Sliding(_)) => {
                    let slider = self.mechanism.slider(*joint)?;
                    let changed = slider
                        .contacts
                        .iter()
                        .any(|k| before.contacts[k.index()] != after.contacts[k.index()]);
                    if changed {
                        format!("{name} changes side: it {}", self.mode("is now", *joint, after))
                    } else if stops {
                        format!("{name} stops for an instant and slides on")
                    } else {
                        return None;
                    }
                }
                (JointPhase::Sticking, JointPhase::Sticking) => return None,
            };
            Some(told)
        };
        self.sliders.iter().enumerate().filter_map(one).collect()
    }

    /// The other face of a loose guide.
    fn other_face(&self, joint: JointId) -> Option<JointId> {
        other_face(self.mechanism, joint)
    }

    /// What a block does between both faces of its loose guide: "is wedged between both faces (rails.front on the lower one,
    /// rails.rear on the upper one), which hold it", "touches the lower face (rails.front), sliding to the right".
    fn between_faces(&self, faces: [JointId; 2], phase: &Phase) -> String {
        let closed = |joint: JointId| -> Vec<ContactId> {
            let contacts = self.mechanism.slider(joint).map_or(&[][..], |slider| &slider.contacts);
            contacts.iter().copied().filter(|k| !phase.is_open(self.mechanism, k.index())).collect()
        };
        let touching = faces.into_iter().filter(|joint| !closed(*joint).is_empty());
        let touching: Vec<JointId> = touching.collect();
        let place = |joint: JointId| self.sliders.iter().position(|one| *one == joint);
        let state = |joint: JointId| Some((phase.joints[place(joint)?], self.mechanism.slider(joint)?));
        let how =
            touching.first().and_then(|joint| state(*joint)).map_or(String::new(), |state| match state {
                (JointPhase::Sticking, _) => "sticks".to_owned(),
                (JointPhase::Sliding(sign), slider) => self.sliding(slider, sign),
            });
        let names = |joint: JointId| {
            let names =
                closed(joint).into_iter().map(|k| loose_place(&self.mechanism.contacts[k.index()].name));
            names.collect::<Vec<_>>().join(" and ")
        };
        match touching.as_slice() {
            [] => "touches neither face".to_owned(),
            [one] => format!("touches the {} face ({}), {how}", self.face(*one), names(*one)),
            both => {
                let wedged = if how == "sticks" { "sticks, wedged" } else { "is askew" };
                let at = |joint: &JointId| format!("{} on the {} one", names(*joint), self.face(*joint));
                let at = both.iter().map(at).collect::<Vec<_>>().join(", ");
                let how = if how == "sticks" { String::new() } else { format!(", {how}") };
                format!("{wedged} between both faces ({at}){how}")
            }
        }
    }

    /// Where a face of a loose guide is, as one looks at the drawing: "lower".
    fn face(&self, joint: JointId) -> &'static str {
        let Some(slider) = self.mechanism.slider(joint) else { return "other" };
        match direction_in_words(-rot90(self.configuration.slide(self.mechanism, slider).tangent)) {
            "up" => "upper",
            "down" => "lower",
            "to the right" => "right",
            _ => "left",
        }
    }

    /// The corner on which a block has tipped: when that stops, the block goes on turning about it.
    fn touching(&self, joint: JointId, phase: &Phase) -> Option<&str> {
        let contacts = &self.mechanism.slider(joint)?.contacts;
        let mut closed = contacts.iter().filter(|contact| !phase.is_open(self.mechanism, contact.index()));
        let (corner, None) = (closed.next()?, closed.next()) else { return None };
        (contacts.len() > 1).then(|| self.contact(*corner))
    }

    /// That contacts of a joint lift off or come to touch, if they do.
    fn lifting(
        &self,
        causes: &[Cause],
        index: usize,
        joint: JointId,
        [before, after]: [&Phase; 2],
    ) -> Option<String> {
        let slider = self.mechanism.slider(joint)?;
        let open = |phase: &Phase| -> Vec<bool> {
            slider.contacts.iter().map(|contact| phase.is_open(self.mechanism, contact.index())).collect()
        };
        let (before, now) = (open(before), open(after));
        let opens = before.iter().zip(&now).any(|(before, now)| !before && *now);
        let name = self.name(joint);
        let mut closed = slider.contacts.iter().zip(&now).filter(|(_, open)| !**open);
        match closed.next() {
            _ if before == now => None,
            None => Some(format!("{name} lifts off")),
            Some(_) if opens && self.mechanism.space.is_some() => {
                Some(format!("{name} tips: it {}", self.state("is now", index, joint, after)))
            }
            Some((corner, _)) if opens => {
                let how = match after.joints[index] {
                    JointPhase::Sticking => "which sticks".to_owned(),
                    JointPhase::Sliding(sign) => self.sliding(slider, sign),
                };
                Some(format!("{name} tips over {}, {how}", self.contact(*corner)))
            }
            Some(_) => {
                // That it lands has been said.
                let lands = |cause: &Cause| matches!(cause, Cause::Lands { contact, .. } if slider.contacts.contains(contact));
                let touches =
                    if causes.iter().any(lands) { String::new() } else { format!("{name} touches: ") };
                Some(format!("{touches}it {}", self.state("is now", index, joint, after)))
            }
        }
    }

    /// The hinges with friction and what they do.
    fn hinges<'p>(&self, phase: &'p Phase) -> impl Iterator<Item = (JointId, JointPhase)> + use<'_, 'p> {
        self.mechanism
            .friction_circles
            .iter()
            .zip(&phase.hinges)
            .map(|(circle, hinge)| (circle.joint, hinge.state))
    }

    /// What differs between two phases, hinge by hinge.
    fn changes_of_turning(&self, causes: &[Cause], before: &Phase, after: &Phase) -> Vec<String> {
        let one = |((joint, before), (_, after)): ((JointId, JointPhase), (JointId, JointPhase))| {
            let name = self.name(joint);
            Some(match (before, after) {
                (JointPhase::Sliding(_), JointPhase::Sticking) => format!("{name} stops turning and sticks"),
                (JointPhase::Sticking, JointPhase::Sliding(sign)) => {
                    format!("{name} starts to turn: {}", self.turning("now turns", joint, sign))
                }
                (JointPhase::Sliding(old), JointPhase::Sliding(new)) if old != new => {
                    format!("{name} turns back: {}", self.turning("now turns", joint, new))
                }
                (JointPhase::Sliding(_), JointPhase::Sliding(_))
                    if causes.contains(&Cause::StopsTurning(joint)) =>
                {
                    format!("{name} stops for an instant and turns on")
                }
                _ => return None,
            })
        };
        self.hinges(before).zip(self.hinges(after)).filter_map(one).collect()
    }

    /// "A: rod turns clockwise against crank"
    fn turns(&self, joint: JointId, sign: f64) -> String {
        format!("{}: {}", self.name(joint), self.turning("turns", joint, sign))
    }

    /// "rod turns clockwise against crank"
    fn turning(&self, verb: &str, joint: JointId, sign: f64) -> String {
        let Some([first, second]) = self.mechanism.hinge(joint) else { return String::new() };
        let name = |frame: Frame| {
            frame.body().map_or("the ground", |body| &self.mechanism.bodies[body.index()].name)
        };
        let sense = if sign < 0.0 { "clockwise" } else { "counter-clockwise" };
        format!("{} {verb} {sense} against {}", name(first.frame), name(second.frame))
    }

    /// Whether a joint has neither friction nor contacts that lift off: which of its faces presses, and where it slides, changes
    /// nothing.
    fn needs_no_words(&self, joint: JointId) -> bool {
        self.mechanism.slider(joint).is_some_and(|slider| {
            let may_hold = |contact: &ContactId| self.mechanism.contacts[contact.index()].may_hold();
            !slider.contacts.iter().any(may_hold) && !self.mechanism.may_lift_off(slider)
        })
    }

    /// Whether a joint without friction stands still: the direction of its phase means nothing then.
    fn stands_freely(&self, slider: &Slider) -> bool {
        slider.contacts.iter().all(|&contact| {
            self.mechanism.contacts[contact.index()].is_frictionless()
                && self.configuration.contact(self.mechanism, contact).sliding_velocity == 0.0
        })
    }

    /// Returns whether no contact of a joint touches.
    fn is_apart(&self, slider: &Slider, phase: &Phase) -> bool {
        slider.contacts.iter().all(|contact| phase.is_open(self.mechanism, contact.index()))
    }

    /// What a sliding joint does: "is now on the upper side of the slot, sliding to the right".
    fn state(&self, verb: &str, index: usize, joint: JointId, phase: &Phase) -> String {
        match (phase.joints[index], self.mechanism.slider(joint)) {
            (JointPhase::Sliding(_), Some(slider)) if self.stands_freely(slider) => {
                self.mode(verb, joint, phase)
            }
            (JointPhase::Sliding(_), Some(slider)) if self.is_apart(slider, phase) => "is apart".to_owned(),
            (JointPhase::Sliding(sign), Some(slider)) => {
                let (mode, sliding) = (self.mode(verb, joint, phase), self.sliding(slider, sign));
                // All of it touches, as it does wherever it slides.
                match sliding.strip_prefix("sliding ") {
                    Some(way) if mode == format!("{verb} closed") => format!("slides {way}"),
                    _ => format!("{mode}, {sliding}"),
                }
            }
            (JointPhase::Sticking, Some(slider)) => self.sticks(slider, phase),
            _ => "sticks".to_owned(),
        }
    }

    /// "sliding to the right"; of a block that stands on the ground what moves is its guide: "stem sliding up".
    fn sliding(&self, slider: &Slider, sign: f64) -> String {
        let tangent = self.configuration.slide(self.mechanism, slider).tangent * sign;
        match (slider.block.body(), slider.guide.body()) {
            (None, Some(guide)) => {
                let name = &self.mechanism.bodies[guide.index()].name;
                format!("{name} sliding {}", direction_in_words(-tangent))
            }
            _ => format!("sliding {}", direction_in_words(tangent)),
        }
    }

    /// That a sliding joint sticks; where, if some of its contacts are open.
    fn sticks(&self, slider: &Slider, phase: &Phase) -> String {
        let is_closed = |contact: &&ContactId| !phase.is_open(self.mechanism, contact.index());
        match slider.contacts.iter().find(is_closed) {
            Some(corner) if !slider.contacts.iter().all(|contact| is_closed(&contact)) => {
                format!("sticks at {}", self.contact(*corner))
            }
            _ => "sticks".to_owned(),
        }
    }

    /// Where a sliding joint touches its guide: "is now on the upper side of the slot".
    fn mode(&self, verb: &str, joint: JointId, phase: &Phase) -> String {
        let Some(slider) = self.mechanism.slider(joint) else { return String::new() };
        if self.is_apart(slider, phase) {
            return format!("{verb} apart");
        }
        let tangent = self.configuration.slide(self.mechanism, slider).tangent;
        let is_open = |contact: &ContactId| phase.is_open(self.mechanism, contact.index());
        let sign = |contact: &ContactId| match phase.contacts[contact.index()] {
            _ if is_open(contact) => -1,
            ContactPhase::Pressed(Side::Positive) => 1,
            ContactPhase::Pressed(Side::Negative) => -1,
            ContactPhase::PreloadGap => 0,
        };
        let signs: Vec<i8> = slider.contacts.iter().map(sign).collect();
        let in_gap = |k: &&ContactId| phase.contacts[k.index()] == ContactPhase::PreloadGap && !is_open(k);
        let gaps: Vec<&str> = slider.contacts.iter().filter(in_gap).map(|k| self.contact(*k)).collect();
        let mode = joint_mode(self.mechanism, slider, tangent, &signs);
        let mode = format!("{verb} {}", JointMode::new(String::new(), mode).place());
        if gaps.is_empty() {
            mode
        } else {
            format!("{mode}, with the preload of {} between both faces", gaps.join(" and "))
        }
    }

    /// What moves at a joint: the body that slides, where this is the only joint in which it does; else the joint. The pin
    /// of a slot is named after its joint, too.
    fn name(&self, joint: JointId) -> &str {
        moving(self.mechanism, joint)
    }

    fn contact(&self, contact: ContactId) -> &str {
        &self.mechanism.contacts[contact.index()].name
    }
}

/// The name of the body that slides in a joint, where this is the only joint in which it does, and of the joint elsewhere: of
/// hinges, of pins in slots, where the ground is the block.
pub(in crate::motion) fn moving(mechanism: &Mechanism, joint: JointId) -> &str {
    let block = |joint: JointId| {
        let slider = mechanism.slider(joint).filter(|slider| slider.kind != SliderKind::Pin)?;
        slider.block.body()
    };
    let other = other_face(mechanism, joint);
    let is_only = |body: BodyId| {
        let mut others =
            sliding_joints(mechanism).into_iter().filter(|one| *one != joint && Some(*one) != other);
        !others.any(|one| block(one) == Some(body))
    };
    match block(joint).filter(|body| is_only(*body)) {
        Some(body) => &mechanism.bodies[body.index()].name,
        None => &mechanism.joints[joint.index()].name,
    }
}

/// The other of both joints that a loose guide becomes.
fn other_face(mechanism: &Mechanism, joint: JointId) -> Option<JointId> {
    let is_loose = |joint: &JointId| mechanism.slider(*joint).is_some_and(|slider| slider.loose);
    let name = |joint: JointId| loose_place(&mechanism.joints[joint.index()].name);
    let mut others = sliding_joints(mechanism).into_iter().filter(|one| *one != joint && is_loose(one));
    others.find(|one| is_loose(&joint) && name(*one) == name(joint))
}

/// Whether a block is held between both faces of a loose guide.
pub(in crate::motion) fn is_wedged(mechanism: &Mechanism, phase: &Phase) -> bool {
    let touches = |joint: JointId| {
        let slider = mechanism.slider(joint);
        slider.is_some_and(|slider| slider.contacts.iter().any(|k| !phase.is_open(mechanism, k.index())))
    };
    sliding_joints(mechanism)
        .into_iter()
        .any(|joint| touches(joint) && other_face(mechanism, joint).is_some_and(touches))
}

/// The name of a joint or contact of a loose guide without that of its face.
fn loose_place(name: &str) -> &str {
    let face = LOOSE_FACES.iter().find_map(|face| name.strip_suffix(face)?.strip_suffix('.'));
    face.unwrap_or(name)
}

/// Which end of a travel.
fn end(greatest: bool) -> &'static str {
    if greatest { "greatest" } else { "least" }
}

/// Where something moves, as one looks at the drawing.
fn direction_in_words(direction: Vector2<f64>) -> &'static str {
    if direction.y.abs() > direction.x.abs() * (1.0 + 1e-9) {
        if direction.y > 0.0 { "up" } else { "down" }
    } else if direction.x > 0.0 {
        "to the right"
    } else {
        "to the left"
    }
}
