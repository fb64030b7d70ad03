//! Colours of the classes of a map.

use crate::plot::Hatching;
use crate::theme::{DARK, Theme};
use slideway::map::{ClassMeaning, MapClass};
use slideway::report::SpeedChange;

/// How a region is filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Paint {
    pub(super) fill: &'static str,
    pub(super) hatching: Option<Hatching>,
}

/// Numbers of solutions, from one on: blues that differ in lightness alone, the first closest to the
/// background.
const NUMBERS: [&str; 6] = ["#d6e6f4", "#86bbdd", "#3a87c0", "#17548f", "#0b2f5b", "#061a36"];
const NUMBERS_ON_DARK: [&str; 6] = ["#12365f", "#24649f", "#4a95cc", "#8cc4e6", "#c0e0f4", "#eef7fd"];
/// Margins and efforts, small to large: the sequence YlGnBu of C. Brewer (ColorBrewer 2.0, Apache licence 2.0).
const MARGINS: [&str; 7] = ["#ffffcc", "#c7e9b4", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8", "#0c2c84"];
/// Sets of modes: lighter forms of the colours of Okabe and Ito, then the colours themselves, and two violets;
/// no red, which warns.
const SETS: [&str; 14] = [
    "#8cc4e6", "#f2cf80", "#7fcfb4", "#e6bcd3", "#a6a6a6", "#b9a3e3", "#0072b2", "#e69f00", "#009e73",
    "#cc79a7", "#4d4d4d", "#6a51a3", "#56b4e9", "#f0e442",
];
/// Neither direction is possible; that of the model is not; the opposite one is not.
const LOCKED: &str = "#d8382c";
const LOCKED_AS_IN_MODEL: &str = "#f0937a";
const LOCKED_IN_OPPOSITE: &str = "#f7d488";
const BOTH: &str = "#8cc4e6";
/// It slows down, or does not stay at rest.
const SLIPS: &str = "#e69f00";
/// It stays at rest: beside any number of solutions.
const HOLDS: &str = "#9ec79a";
const SEVERAL: &str = "#d9a5c3";
/// It is not decided.
const OPEN: &str = "#8a63b8";

/// How the points of a class are filled; sets of modes take their colours in the order of the classes.
pub(super) fn paint(classes: &[MapClass], class: &MapClass, theme: &Theme) -> Paint {
    let plain = |fill: &'static str| Paint { fill, hatching: None };
    let numbers = if *theme == DARK { NUMBERS_ON_DARK } else { NUMBERS };
    match &class.meaning {
        ClassMeaning::Tips => Paint { fill: LOCKED, hatching: Some(Hatching::Falling) },
        ClassMeaning::Locked | ClassMeaning::Moves { as_in_model: false, opposite: false, .. } => {
            Paint { fill: LOCKED, hatching: Some(Hatching::Rising) }
        }
        ClassMeaning::Solutions { .. } if is_of_margins(classes) => plain(SEVERAL),
        ClassMeaning::Solutions { solutions, preload_gap_states, tipping } => {
            let fill =
                if *solutions == 0 { "#f2e2b6" } else { numbers[(solutions - 1).min(numbers.len() - 1)] };
            let hatching = match preload_gap_states {
                0 => (*tipping > 0).then_some(Hatching::Rising),
                1 => Some(Hatching::Falling),
                _ => Some(Hatching::Rising),
            };
            Paint { fill, hatching }
        }
        ClassMeaning::Modes { .. } | ClassMeaning::Starts { .. } => {
            let is_set = |meaning: &ClassMeaning| {
                matches!(meaning, ClassMeaning::Modes { .. } | ClassMeaning::Starts { .. })
            };
            let place = place(classes, class, is_set);
            // After a round of colours they are hatched.
            let hatching = (place >= SETS.len()).then_some(Hatching::Falling);
            Paint { fill: SETS[place % SETS.len()], hatching }
        }
        ClassMeaning::Margin { from, .. } => {
            let all = [1.0, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0];
            let step = all.iter().rposition(|bound| bound <= from).unwrap_or(0);
            plain(MARGINS[step])
        }
        ClassMeaning::Effort { .. } => {
            let place = place(classes, class, |meaning| matches!(meaning, ClassMeaning::Effort { .. }));
            plain(MARGINS[place.min(MARGINS.len() - 1)])
        }
        ClassMeaning::Moves { as_in_model: true, opposite: true, .. } => plain(BOTH),
        ClassMeaning::Moves { as_in_model: true, .. }
        | ClassMeaning::Rest { holds: Some(true), may_slip: true } => plain(LOCKED_IN_OPPOSITE),
        ClassMeaning::Moves { .. } => plain(LOCKED_AS_IN_MODEL),
        ClassMeaning::Motion { solutions, tipping } => {
            let without_speeds = || numbers[(solutions.len().max(1) - 1).min(numbers.len() - 1)];
            let has_speeds = solutions.iter().any(|changes| !changes.is_empty());
            let fill = if has_speeds { of_motion(solutions) } else { without_speeds() };
            Paint { fill, hatching: (*tipping > 0).then_some(Hatching::Rising) }
        }
        ClassMeaning::Rest { holds: Some(true), .. } => plain(HOLDS),
        ClassMeaning::Rest { holds: Some(false), .. } => plain(SLIPS),
        ClassMeaning::Continuum => plain(theme.ink),
        ClassMeaning::Undecided | ClassMeaning::TooLarge | ClassMeaning::Rest { holds: None, .. } => {
            Paint { fill: OPEN, hatching: Some(Hatching::Falling) }
        }
        ClassMeaning::NotSolved { .. } => {
            let fill = if *theme == DARK { "#30363d" } else { "#e1e4e8" };
            Paint { fill, hatching: Some(Hatching::Falling) }
        }
    }
}

/// Returns how many classes of this kind come before one.
fn place(classes: &[MapClass], class: &MapClass, is_of_kind: fn(&ClassMeaning) -> bool) -> usize {
    let of_kind = classes.iter().filter(|other| is_of_kind(&other.meaning));
    of_kind.take_while(|other| *other != class).count()
}

/// Returns the colour of the motion in which all solutions agree: green where it speeds up or starts, yellow
/// where it keeps its speed, orange where it slows down. Returns the colour for several if they do not agree.
fn of_motion(solutions: &[Vec<SpeedChange>]) -> &'static str {
    let mut changes = solutions.iter().flatten();
    let first = changes.next();
    match first {
        Some(first) if changes.all(|other| other == first) => match first {
            SpeedChange::SpeedsUp | SpeedChange::StartsForwards | SpeedChange::StartsBackwards => "#7fcfb4",
            SpeedChange::SlowsDown => SLIPS,
            _ => "#f2cf80",
        },
        _ => SEVERAL,
    }
}

fn is_of_margins(classes: &[MapClass]) -> bool {
    classes.iter().any(|class| matches!(class.meaning, ClassMeaning::Margin { .. }))
}
