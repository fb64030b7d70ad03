//! The conclusion of limits, in words.

use super::found::Method;
use super::report::{CountLimits, Direction, Known, ModeLimits, SpeedLimits};
use super::varied::Varied;
use crate::ids::ContactId;
use crate::modes::existence::{cells, is_same_end};
use crate::report::{HOLDS, ModeEndCause, OnFace};
use crate::units::number::counted;

/// Verdict that a mechanism with drives has one solution.
const MOVES: &str = "it moves";
/// Verdict that it has one solution, in which a block tips over one of its corners.
const TIPS: &str = "it tips";
/// The same beyond a stretch in which it jams.
const TIPS_INSTEAD: &str = "it tips, which is no better";
/// Verdict that there is no solution, and no guided slider tips.
const JAMS: &str = "it jams";

/// The conclusion of limits.
pub(super) struct Conclusion {
    /// The limit in one sentence, if there is one only: "It jams from mu = 0.6667 on (the model has 0.3)."
    pub(super) summary: Option<String>,
    /// Whether the sentences say nothing more.
    pub(super) says_all: bool,
    /// A sentence for each stretch.
    pub(super) sentences: Vec<String>,
}

/// Sentences on where the mechanism moves, and in which direction (Klepp (2002), section 7).
pub(super) fn conclusion(
    (varied, method): (&Varied, Method),
    forwards: &Direction,
    reversed: Option<&Direction>,
) -> Conclusion {
    let driven = !varied.model().drives.is_empty();
    let shared = shared(varied, forwards);
    let pieces = match reversed {
        None => one_direction(forwards, driven, &shared),
        Some(reversed) => both_directions([forwards, reversed]),
    };
    let mut joined: Vec<Piece> = Vec::new();
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if last.is_like(&piece) && last.to == piece.from => last.to = piece.to,
            _ => joined.push(piece),
        }
    }
    // What was sampled and is narrower than its digits show is where two states meet.
    let is_seen = |piece: &Piece| {
        let [from, to] = [piece.from, piece.to].map(|end| varied.shown_in.precise_number(end));
        piece.known != Known::Sampled || piece.from == piece.to || from != to
    };
    if joined.iter().any(is_seen) {
        joined.retain(is_seen);
    }
    let gaps = forwards.without_mode_problem.iter().map(|gap| [gap.from, gap.to]).collect::<Vec<_>>();
    let tips = joined.iter().any(|piece| piece.verdict == TIPS);
    let lifting = if tips { String::new() } else { lifting(&forwards.modes, varied) };
    let summary = summary(&joined, &gaps, varied).map(|summary| summary + &lifting);
    let is_plain = joined.iter().all(|piece| [MOVES, TIPS, JAMS].contains(&&*piece.verdict));
    // Nobody takes what tips beyond a jam, and beside nothing else, for something better.
    let is_beyond = |index: &usize| {
        let before = index.checked_sub(1).and_then(|before| joined.get(before));
        let mut beside = before.into_iter().chain(joined.get(index + 1)).peekable();
        joined[*index].verdict == TIPS && beside.peek().is_some() && beside.all(|piece| piece.verdict == JAMS)
    };
    let beyond: Vec<usize> = (0..joined.len()).filter(is_beyond).collect();
    beyond.into_iter().for_each(|index| TIPS_INSTEAD.clone_into(&mut joined[index].verdict));
    let pieces = joined.into_iter().map(|piece| piece.sentence(varied, method));
    let single = |direction: &Direction, way: &str| -> Vec<String> {
        let sentence = |at: &f64| {
            format!(
                "At {} = {} there is{way} a state in a preload gap.",
                varied.name,
                varied.shown_in.precise(*at)
            )
        };
        direction.between_faces_at.iter().map(sentence).collect()
    };
    let other = reversed.map_or(Vec::new(), |reversed| {
        single(reversed, ", moving in the opposite direction with the same loads,")
    });
    let mut sentences: Vec<String> = pieces.chain(single(forwards, "")).chain(other).collect();
    let depends = sentences.iter().any(|sentence| sentence.contains(&undetermined(&shared)));
    sentences.extend((depends && !shared.is_empty()).then(|| ONE_SHARE.to_owned()));
    // Where a single value has a state of its own there is more to say.
    let summary = summary.filter(|_| forwards.between_faces_at.is_empty());
    // Of more stretches the summary tells what happens first.
    let says_all = is_plain && summary.is_some() && sentences.len() < 3;
    Conclusion { summary, says_all, sentences }
}

/// Where contacts lift off: " foot lifts off from speed = 43.88 rad/s on." Empty where none does.
fn lifting(modes: &[ModeLimits], varied: &Varied) -> String {
    let mut sentences: Vec<String> = Vec::new();
    let ends = modes.iter().flat_map(|mode| {
        [(mode.from, mode.from_is, &mode.from_at, "below"), (mode.to, mode.to_is, &mode.to_at, "from")]
    });
    for (at, _, contacts, way) in ends.filter(|(_, is, ..)| *is == ModeEndCause::LiftsOff) {
        let Some(at) = at else { continue };
        let (names, lift) = (contacts.join(", "), ModeEndCause::LiftsOff.of_contacts(contacts.len() > 1));
        let on = if way == "from" { " on" } else { "" };
        sentences.push(format!(" {names} {lift} {way} {}{on}.", value_in_words(varied, at)));
    }
    sentences.dedup();
    sentences.concat()
}

/// A value of what is varied: "speed = 43.88 rad/s", "2.222 times this friction".
fn value_in_words(varied: &Varied, at: f64) -> String {
    match varied.shown_in.brief(at) {
        factor if varied.is_friction_factor() => format!("{factor} times this friction"),
        value => format!("{} = {value}", varied.name),
    }
}

/// The limit in one sentence, if the mechanism moves on one side of it and jams on the other, up to an end of the range or
/// to a gap without an answer.
fn summary(pieces: &[Piece], gaps: &[[f64; 2]], varied: &Varied) -> Option<String> {
    let is_factor = varied.is_friction_factor();
    let now = varied.present().ok().filter(|_| !is_factor);
    let now = now.map_or_else(String::new, |now| format!(" (the model has {})", varied.shown_in.brief(now)));
    let all = |piece: &Piece| {
        let (from, to) = (varied.shown_in.brief_number(piece.from), varied.shown_in.brief(piece.to));
        if is_factor {
            format!("with {from} to {to} times this friction")
        } else {
            format!("for {} from {from} to {to}", varied.name)
        }
    };
    let at = |piece: &Piece| value_in_words(varied, piece.from);
    let is_certain = |piece: &Piece| piece.known != Known::Undecided;
    match pieces {
        pieces if !pieces.iter().all(is_certain) => None,
        [only] if only.verdict == MOVES => Some(format!("It moves {}.", all(only))),
        [only] if only.verdict == TIPS => Some(format!("It tips {}{now}.", all(only))),
        [one, other] if one.is_motion && other.verdict == TIPS && one.to == other.from => {
            Some(format!("It tips from {} on{now}.", at(other)))
        }
        [only] if only.verdict == JAMS => Some(format!("It jams {}{now}.", all(only))),
        [one, other] if one.to != other.from => None,
        [one, other] if one.is_motion && other.verdict == JAMS => {
            let ends = gaps.iter().any(|[from, _]| *from >= other.to);
            Some(if ends {
                format!("It jams {}{now}.", all(other))
            } else {
                format!("It jams from {} on{now}.", at(other))
            })
        }
        [one, other] if one.verdict == JAMS && other.is_motion => {
            let begins = gaps.iter().any(|[_, to]| *to <= one.from);
            Some(if begins {
                format!("It jams {}{now}.", all(one))
            } else {
                format!("It jams below {}{now}.", at(other))
            })
        }
        pieces => Some(around(pieces, at)? + &now + "."),
    }
}

/// What ends the only stretch in which it moves, below and above: what happens first counts. "It tips below mu = 0.05 and from
/// mu = 0.35 on".
fn around(pieces: &[Piece], at: impl Fn(&Piece) -> String) -> Option<String> {
    let (only, moves) = pieces.iter().enumerate().find(|(_, piece)| piece.is_motion)?;
    if pieces.iter().filter(|piece| piece.is_motion).count() > 1 {
        return None;
    }
    let verb = |piece: &Piece| match &*piece.verdict {
        TIPS => Some("tips"),
        JAMS => Some("jams"),
        _ => None,
    };
    let before = only.checked_sub(1).map(|before| &pieces[before]);
    let after = pieces.get(only + 1);
    if before.is_some_and(|piece| piece.to != moves.from) || after.is_some_and(|piece| piece.from != moves.to)
    {
        return None;
    }
    // A neighbour that does something else leaves no short sentence.
    let before = if let Some(piece) = before { Some((verb(piece)?, at(moves))) } else { None };
    let after = if let Some(piece) = after { Some((verb(piece)?, at(piece))) } else { None };
    match (before, after) {
        (Some((one, below)), Some((other, from))) if one == other => {
            Some(format!("It {one} below {below} and from {from} on"))
        }
        (Some((one, below)), Some((other, from))) => {
            Some(format!("It {one} below {below} and {other} from {from} on"))
        }
        (None, Some((verb, from))) => Some(format!("It {verb} from {from} on")),
        (Some((verb, below)), None) => Some(format!("It {verb} below {below}")),
        (None, None) => None,
    }
}

/// Verdict that a mechanism without drives has one solution.
const ONE_SOLUTION: &str = "one solution";

/// A stretch with the same verdict.
struct Piece {
    from: f64,
    to: f64,
    verdict: String,
    /// True if it moves in a single way.
    is_motion: bool,
    /// The least that is known of it.
    known: Known,
}

impl Piece {
    fn is_like(&self, other: &Self) -> bool {
        let is_certain = |known: Known| matches!(known, Known::Proven | Known::ClosedForm);
        self.verdict == other.verdict
            && (self.known == other.known || is_certain(self.known) && is_certain(other.known))
    }

    fn sentence(&self, varied: &Varied, method: Method) -> String {
        let Self { from, to, ref verdict, known, .. } = *self;
        let verdict = if known == Known::Undecided { "not decided" } else { verdict };
        let verdict = match verdict.strip_suffix(')') {
            _ if known != Known::Sampled => verdict.to_owned(),
            Some(verdict) => format!("{verdict}, sampled)"),
            None => format!("{verdict} (sampled)"),
        };
        let same = if matches!(method, Method::Same { .. }) { ", the same in the whole range" } else { "" };
        format!("{}{same}: {verdict}.", varied.shown_in.range(&varied.name, [from, to]))
    }
}

/// The advice where the share of guides in a load is open.
const ONE_SHARE: &str = "Give `stiffness` for one answer.";

/// The joints that share a load, if there are infinitely many solutions anywhere.
fn shared(varied: &Varied, direction: &Direction) -> Vec<String> {
    let continuum = direction.counts.iter().find(|count| count.continuum);
    let Some(mechanism) = continuum.and_then(|count| varied.mechanism(count.from).ok()) else {
        return Vec::new();
    };
    let shares = |k: &usize| mechanism.excess.shares(ContactId(*k));
    let name = |k: usize| mechanism.joints[mechanism.contacts[k].joint.index()].name.to_string();
    let mut names: Vec<String> = (0..mechanism.contacts.len()).filter(shares).map(name).collect();
    names.dedup();
    names
}

/// "how left, right share the load is undetermined"
fn undetermined(shared: &[String]) -> String {
    format!("how {} share the load", shared.join(", "))
}

/// A stretch in which the share of guides in a load is open, cut where forces grow without limit for one share: beyond,
/// it depends on the share whether it jams.
fn by_share(whole: &Piece, modes: &[ModeLimits], shared: &[String]) -> Vec<Piece> {
    let grows = |is: ModeEndCause| matches!(is, ModeEndCause::Locking | ModeEndCause::WithoutBound);
    let end = |at: Option<f64>, is: ModeEndCause| at.filter(|_| grows(is));
    let ends = modes.iter().map(|mode| [end(mode.from, mode.from_is), end(mode.to, mode.to_is)]);
    let ends: Vec<[Option<f64>; 2]> = ends.collect();
    let inside = ends.iter().flatten().flatten().copied().filter(|at| whole.from < *at && *at < whole.to);
    let piece = |[from, to]: [f64; 2]| {
        let jammed = |[begins, ends]: &[Option<f64>; 2]| {
            ends.is_some_and(|at| at <= from) || begins.is_some_and(|at| at >= to)
        };
        let share = undetermined(shared);
        let verdict = if ends.iter().any(jammed) {
            format!("it may jam: that depends on {share}, which is undetermined")
        } else {
            format!("it moves, but {share} is undetermined")
        };
        Piece { from, to, verdict, is_motion: false, known: whole.known }
    };
    cells(inside.chain([whole.from, whole.to]), is_same_end).into_iter().map(piece).collect()
}

fn one_direction(direction: &Direction, driven: bool, shared: &[String]) -> Vec<Piece> {
    let pieces = |count: &CountLimits| {
        let without = count.without_solution();
        let is_told = |starts: &&[String]| !count.continuum || **starts == [HOLDS];
        let starts = count.starts.as_deref().filter(is_told).map(starts_in_words);
        let verdict = match (count.solutions, count.preload_gap_states) {
            _ if let Some(starts) = &starts => starts,
            _ if count.continuum => "infinitely many solutions",
            (0, 0) => &without,
            (0, _) => "it moves in a preload gap",
            (1, _) if driven => MOVES,
            (1, _) => ONE_SOLUTION,
            (solutions, _) => &format!("{} solutions", counted(solutions)),
        };
        let is_motion = count.solutions == 1 && !count.continuum;
        let verdict = verdict.to_owned();
        let whole = Piece { from: count.from, to: count.to, verdict, is_motion, known: count.known };
        if count.continuum && driven && starts.is_none() && !shared.is_empty() {
            return by_share(&whole, &direction.modes, shared);
        }
        let pieces = if is_motion { by_tipping(whole, &direction.modes) } else { vec![whole] };
        let by_speed = |piece: Piece| {
            if piece.is_motion { by_speed(piece, &direction.modes) } else { vec![piece] }
        };
        pieces.into_iter().flat_map(by_speed).collect::<Vec<_>>()
    };
    direction.counts.iter().flat_map(pieces).collect()
}

/// "it starts to move: base slides forwards", "it can go on in 2 ways: it holds, or it starts to move: tip opens"
fn starts_in_words(starts: &[String]) -> String {
    match starts {
        [] => "it can neither rest nor start".to_owned(),
        [only] => only.clone(),
        several => format!("it can go on in {} ways: {}", several.len(), several.join(", or ")),
    }
}

/// A stretch with one solution, cut where a block lifts off one of its corners.
fn by_tipping(whole: Piece, modes: &[ModeLimits]) -> Vec<Piece> {
    let tips = |mode: &ModeLimits| mode.joints.iter().any(|joint| joint.face == Some(OnFace::Tips));
    if !modes.iter().any(tips) {
        return vec![whole];
    }
    let ends = |mode: &ModeLimits| [mode.from.unwrap_or(f64::NEG_INFINITY), mode.to.unwrap_or(f64::INFINITY)];
    let mut cuts: Vec<f64> =
        modes.iter().flat_map(ends).filter(|at| whole.from < *at && *at < whole.to).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.retain(|at| !is_same_end(*at, whole.from) && !is_same_end(whole.to, *at));
    cuts.dedup_by(|next, kept| is_same_end(*next, *kept));
    cuts.insert(0, whole.from);
    cuts.push(whole.to);
    let piece = |pair: &[f64]| {
        let middle = f64::midpoint(pair[0], pair[1]);
        let here = |mode: &&ModeLimits| {
            let [from, to] = ends(mode);
            !mode.preload_gap && from <= middle && middle <= to
        };
        let tips = modes.iter().find(here).is_some_and(tips);
        let (verdict, is_motion) =
            if tips { (TIPS.to_owned(), false) } else { (whole.verdict.clone(), true) };
        Piece { from: pair[0], to: pair[1], verdict, is_motion, known: whole.known }
    };
    cuts.windows(2).map(piece).collect()
}

/// A stretch with one solution, cut where its only coordinate goes over from speeding up to slowing down.
fn by_speed(whole: Piece, modes: &[ModeLimits]) -> Vec<Piece> {
    let pressed = modes.iter().filter(|mode| !mode.preload_gap);
    let mut speeds: Vec<&SpeedLimits> = pressed.flat_map(|mode| &mode.speeds).collect();
    let is_only = speeds.windows(2).all(|pair| pair[0].coordinate == pair[1].coordinate);
    speeds.retain(|speed| speed.to > whole.from && speed.from < whole.to);
    if speeds.is_empty() || !is_only {
        return vec![whole];
    }
    speeds.sort_by(|one, other| one.from.total_cmp(&other.from));
    // Where one mode gives way to another both may have been found to end a little apart.
    let begins = std::iter::once(whole.from).chain(speeds.iter().skip(1).map(|speed| speed.from));
    let begins: Vec<f64> = begins.collect();
    let ends = begins.iter().skip(1).copied().chain([whole.to]);
    let piece = |((from, to), speed): ((&f64, f64), &SpeedLimits)| Piece {
        from: *from,
        to,
        verdict: match speed.speed.in_words() {
            words if whole.verdict == MOVES => format!("{MOVES}, and {} {words}", speed.coordinate),
            words => format!("it {words} ({ONE_SOLUTION})"),
        },
        is_motion: true,
        known: whole.known,
    };
    begins.iter().zip(ends).zip(speeds).map(piece).collect()
}

fn both_directions(directions: [&Direction; 2]) -> Vec<Piece> {
    let pieces = |direction: &Direction| {
        let piece = |count: &CountLimits| {
            let is_motion = !count.is_empty();
            let verdict = if is_motion { MOVES.to_owned() } else { count.without_solution() };
            let whole = Piece { from: count.from, to: count.to, verdict, is_motion, known: count.known };
            if count.solutions == 1 { by_tipping(whole, &direction.modes) } else { vec![whole] }
        };
        direction.counts.iter().flat_map(piece).collect::<Vec<_>>()
    };
    let [forwards, reversed] = directions.map(pieces);
    let mut ends: Vec<f64> = forwards.iter().chain(&reversed).flat_map(|one| [one.from, one.to]).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let piece = |pair: &[f64]| {
        let middle = f64::midpoint(pair[0], pair[1]);
        let at = |pieces: &[Piece]| {
            let here = pieces.iter().find(|one| one.from < middle && middle < one.to)?;
            Some(((!here.is_motion).then(|| here.verdict.clone()), here.known))
        };
        let ((one, known), (other, known_of_other)) = (at(&forwards)?, at(&reversed)?);
        let verdict = match (one, other) {
            (None, None) => "it can move in both directions".to_owned(),
            (None, Some(without)) => {
                format!("it moves as in the model; in the opposite direction {without}")
            }
            (Some(without), None) => {
                format!("as in the model {without}; in the opposite direction it moves")
            }
            (Some(one), Some(other)) if one == other => format!("in both directions {one}"),
            (Some(one), Some(other)) => format!("{one}; in the opposite direction {other}"),
        };
        Some(Piece {
            from: pair[0],
            to: pair[1],
            verdict,
            is_motion: false,
            known: known.max(known_of_other),
        })
    };
    ends.windows(2).filter_map(piece).collect()
}
