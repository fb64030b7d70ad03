//! The plain answer of `solve`, as one would say it to a colleague.

use super::effort::{self, least_friction, times, times_friction};
use super::{
    CertificateKind, Contact, Drive, JamImpulse, JointMode, Margins, MarginsMissing, ModeEndCause, OnFace,
    Solution, SolveReport, SpeedChange, Status, TippingRange, Verdict, capital, it_would_tip, with_less,
};
use crate::units::brief;

/// What is left open where ranges of parameters are not followed.
pub(crate) const AT_THE_MIDDLE: &str =
    "parameters known within bounds are taken at the middle of their ranges";
/// Of a state that stays at rest.
pub(crate) const HOLDS: &str = "it holds";
/// The remedy where a search ended early.
const MORE_TIME: &str = "Allow it more time.";
/// The remedy at a boundary.
const NEARBY: &str = "Ask again with slightly more or less friction or load.";

impl SolveReport {
    /// The verdict in a sentence: "It moves: push needs 36.36 N (20 N without friction)."
    pub fn verdict_in_words(&self) -> String {
        let verdict = self.verdict();
        if !self.open.iter().any(|open| open == AT_THE_MIDDLE) {
            return verdict;
        }
        let verdict =
            verdict.strip_prefix("It ").map_or_else(|| verdict.clone(), |rest| format!("it {rest}"));
        format!("For the middle of the ranges of parameters: {verdict}")
    }

    fn verdict(&self) -> String {
        if self.partial && matches!(self.status, Status::One | Status::Several | Status::PreloadGap) {
            let states = if self.count == "0" { &self.gap_state_count } else { &self.count };
            let found = if states == "1" { "one solution" } else { &format!("{states} solutions") };
            return format!("Not decided: the search is not finished; so far it found {found}. {MORE_TIME}");
        }
        if let Some(start) = self.start_in_words() {
            return start;
        }
        match self.status {
            Status::None => match self.tipping() {
                Some(tipping) => format!("No answer: {}.", tipping.in_words()),
                None => format!("It jams: {}.", self.nothing_moves_it()),
            },
            Status::One => self.solutions.first().map_or_else(String::new, |only| self.moves_in_words(only)) + self.unsettled(),
            Status::Several => self.ways_in_words(),
            Status::Continuum => self.open_in_words(),
            Status::PreloadGap => self.gap_in_words(),
            Status::Unknown if self.partial => {
                format!("Not decided: the search is not finished; so far it found no solution. {MORE_TIME}")
            }
            Status::Unknown => {
                "Not decided: it is on the verge of jamming, and rounding hides on which side. Take it as jammed, or ask \
                     again with slightly more or less friction or load."
                    .to_owned()
            }
        }
    }

    /// Returns whether it holds: some of infinitely many states is one of rest.
    pub fn rests(&self) -> bool {
        self.continua.iter().any(|continuum| continuum.rests)
    }

    /// A clause for each solution on the joints that are at rest and may lift off: "it starts to move: base slides forwards",
    /// "it tips: base on its left corner, slides forwards", of what moves already "it moves on: lower sticks". None if no such
    /// joint is at rest. Without numbers, so that the same start has the same words in another state.
    pub(crate) fn starts(&self) -> Option<Vec<String>> {
        let moves = self.state.iter().any(|coordinate| coordinate.rate != 0.0);
        let start = |solution: &Solution| {
            let at_rest = |joint: &&JointMode| self.at_rest.contains(&joint.name);
            let joints: Vec<&JointMode> = solution.joints.iter().filter(at_rest).collect();
            let what = match moves {
                _ if solution.rests => return HOLDS.to_owned(),
                _ if joints.iter().any(|joint| joint.face == Some(OnFace::Tips)) => "it tips",
                true => "it moves on",
                false => "it starts to move",
            };
            let one = |joint: &&JointMode| format!("{} {}", joint.name, joint.start());
            format!("{what}: {}", joints.iter().map(one).collect::<Vec<_>>().join("; "))
        };
        (!self.at_rest.is_empty()).then(|| self.solutions.iter().map(start).collect())
    }

    /// How it goes on where contacts that may lift off are at rest: "It starts to move: base slides forwards.", or that it
    /// holds.
    fn start_in_words(&self) -> Option<String> {
        let starts = self.starts()?;
        let unique = if self.every_load_has_one_state == Some(true) {
            " Whatever the loads, only one thing can happen."
        } else {
            ""
        };
        Some(match (self.status, starts.as_slice()) {
            (Status::None, _) => "Nothing satisfies the equations: it can neither rest nor start.".to_owned(),
            (Status::One, [only]) => {
                format!("It {}.{unique}", only.strip_prefix("it ").unwrap_or(only))
            }
            (Status::Several, several) => {
                format!("It can go on in {} ways: {}.", several.len(), several.join(", or "))
            }
            _ => {
                let also = match self.solutions.len() {
                    0 => String::new(),
                    more => format!(" {more} more states are determined."),
                };
                let holds = if self.rests() { "It holds. " } else { "" };
                format!("{holds}The forces at rest are not determined: `hold` shows their ranges.{also}")
            }
        })
    }

    /// Words for the impulse that acts in a jam: "An impulse without collision stops it: afterwards tip is closed, sticks."
    fn impulse_in_words(&self) -> Option<String> {
        let after = |impulse: &JamImpulse| {
            let joints = impulse.joints.iter().map(|joint| format!("{}: {}", joint.name, joint.mode));
            let energy = self.model.units.of("J").show(impulse.energy_lost.abs());
            let what = if impulse.energy_lost < 0.0 { "gained" } else { "lost" };
            format!("{} ({energy} of kinetic energy is {what})", joints.collect::<Vec<_>>().join("; "))
        };
        Some(match self.jam_impulses.as_deref()? {
            [] if self.model.drives > 0 => "The drives stall.".to_owned(),
            [] => return None,
            [only] => format!("Velocities jump without a collision. Afterwards {}.", after(only)),
            several => {
                let ways: Vec<String> = several.iter().map(after).collect();
                format!(
                    "Velocities jump without a collision, in one of {} ways. Afterwards {}.",
                    ways.len(),
                    ways.join(". Or ")
                )
            }
        })
    }

    /// How far it is from a jam, or what would end one: "It would jam from mu = 0.6667 (2.222 times this
    /// friction)." Empty where nothing is known, or nothing changes, and where it is not decided whether it moves: there
    /// a factor would be read as a promise.
    pub fn safety_in_words(&self) -> Vec<String> {
        if self.partial || self.status == Status::Unknown || !self.open.is_empty() {
            return Vec::new();
        }
        let Some(margins) = &self.margins else { return self.without_margins() };
        if self.status == Status::None {
            let below = margins.moves_below.map(|below| least_friction(below.factor, below.mu));
            let below = below.map(|below| format!("It {} below {below}.", self.what_ends()));
            return below.into_iter().chain(self.impulse_in_words()).collect();
        }
        let at = |factor: f64| times_friction(factor, margins.mu.map(|mu| factor * mu));
        let below = margins.below.as_ref().map(|limit| with_less(limit, margins.mu));
        let tips = margins.tipping.iter();
        let mut sentences: Vec<String> =
            tips.map(|tips| sentence(&it_would_tip(&tips.joints, &at(tips.factor)))).collect();
        // What tips before it jams is told to tip: the first thing that happens is what counts.
        let jams = margins.no_solution.filter(|_| margins.tipping.is_none());
        if let Some(changes) = margins.another_count.filter(|changes| Some(*changes) != margins.no_solution) {
            sentences.push(if self.status == Status::One {
                format!("From {} it has several ways to go on.", at(changes))
            } else {
                format!("The number of solutions changes from {}.", at(changes))
            });
        }
        let any_load = self.any_load_in_words(margins);
        match jams {
            Some(jams) if any_load.is_some() && self.is_safe_until(margins, jams) => {
                let safe = "With less friction no load jams it while it moves.".to_owned();
                sentences.extend([self.end_in_words(margins, &at(jams)), safe]);
                sentences.extend(below.map(|below| sentence(&below)));
                return sentences;
            }
            Some(jams) => sentences.push(self.end_in_words(margins, &at(jams))),
            None if margins.another_count.is_none()
                && margins.no_solution.is_none()
                && self.has_friction() =>
            {
                let with = if margins.uniqueness.is_some() { " under this load" } else { "" };
                sentences.push(if self.status == Status::Several {
                    "However much all friction grows, it has a solution.".to_owned()
                } else {
                    format!("While it moves, more friction would not jam it{with}.")
                });
            }
            None => {}
        }
        sentences.extend(any_load);
        sentences.extend(below.map(|below| sentence(&below)));
        sentences
    }

    /// Whether every load has one solution as long as the present one has: then one sentence says both.
    fn is_safe_until(&self, margins: &Margins, jams: f64) -> bool {
        let is_only_end = margins.another_count.is_none_or(|changes| changes == jams);
        let is_plain = margins.tips.is_empty() && margins.solutions_again.is_none() && self.sharing.is_none();
        is_only_end && is_plain && margins.uniqueness.is_some_and(|factor| brief(factor) == brief(jams))
    }

    /// How the answer is known, and which states there are beside solutions: "Proven: it is the only solution."
    pub fn known_in_words(&self) -> String {
        let gaps = match self.gap_state_count.as_str() {
            states if states == "0" || self.solutions.is_empty() => String::new(),
            "1" => " One more state is in a preload gap.".to_owned(),
            several => format!(" {several} more states are in a preload gap."),
        };
        if !self.open.is_empty() {
            return format!("Not proven: {}.{gaps}", self.open.join("; "));
        }
        let all = match self.status {
            Status::None => "there is no solution",
            Status::Unknown => "no other contact mode has a solution",
            Status::One | Status::PreloadGap if self.solutions.len() + self.preload_gap_states.len() == 1 => {
                if self.solutions.iter().any(|one| one.certificate == CertificateKind::NotProven) {
                    return format!("Proven: no other solution is possible. This one is computed.{gaps}");
                }
                "it is the only solution"
            }
            _ => "there are no other solutions",
        };
        format!("Proven: {all}.{gaps}")
    }

    /// "no force of push moves it"
    fn nothing_moves_it(&self) -> String {
        match self.influence.drives.as_slice() {
            [] => "friction locks it".to_owned(),
            [drive] => {
                format!("no {} of {} moves it", effort::kind(drive.unit).unwrap_or("effort"), drive.name)
            }
            _ => "no drive moves it".to_owned(),
        }
    }

    /// The end of the jam or the tipping at less friction: "moves".
    fn what_ends(&self) -> &'static str {
        if self.tipping().is_none() { "moves" } else { "does not tip" }
    }

    /// "It moves: push needs 36.36 N (20 N without friction)."
    fn moves_in_words(&self, solution: &Solution) -> String {
        if tips(solution) {
            return self.tips_in_words(solution);
        }
        let lifts = lifting(solution).map_or_else(|| ".".to_owned(), |lifts| format!(". {lifts}."));
        let moves = self.does_in_words(solution);
        match self.changes(solution).as_slice() {
            _ if moves.starts_with("it ") => capital(&moves) + &lifts,
            [] if moves.is_empty() => format!("It has one solution{lifts}"),
            _ => format!("It moves: {moves}{lifts}"),
        }
    }

    /// What its drives need, or else what becomes of its speeds: "push needs 36.36 N (20 N without friction)", "it slows down at
    /// 17.3 m/s^2". Empty where there is nothing to say.
    fn does_in_words(&self, solution: &Solution) -> String {
        if !solution.drives.is_empty() {
            return self.needs(solution).join(", ");
        }
        match self.changes(solution).as_slice() {
            [change] => format!("it {change}"),
            changes => changes.join(", "),
        }
    }

    /// "It tips: shoes.front lifts off (from mu = 0.45 on). push needs 206.6 N (0 N without friction)."
    fn tips_in_words(&self, solution: &Solution) -> String {
        let what = lifting(solution).map_or_else(String::new, |lifts| format!(": {lifts}"));
        let factors = self.margins.as_ref().and_then(|margins| Some((margins.tips_between?, margins.mu)));
        let at = |factor: f64, mu: Option<f64>| least_friction(factor, mu.map(|mu| factor * mu));
        let range = factors.map_or_else(String::new, |(TippingRange { from, to }, mu)| match (from, to) {
            (Some(from), None) => format!(" (from {} on)", at(from, mu)),
            (None, Some(to)) => format!(" (below {})", at(to, mu)),
            (Some(from), Some(to)) => format!(" (from {} to {})", at(from, mu), at(to, mu)),
            (None, None) => String::new(),
        });
        let rest = match self.does_in_words(solution) {
            rest if rest.is_empty() => rest,
            rest if rest.starts_with("it ") => format!(" {}", sentence(&rest)),
            rest => format!(" {rest}."),
        };
        format!("It tips{what}{range}.{rest}")
    }

    /// A remark on the only solution if a mechanism does not settle on it.
    fn unsettled(&self) -> &'static str {
        match self.solutions.as_slice() {
            [only] => effort::unsettled(only.attainability.verdict),
            _ => "",
        }
    }

    /// "push needs 36.36 N (20 N without friction)", for each drive.
    fn needs(&self, solution: &Solution) -> Vec<String> {
        let lifts_off = lifting(solution).is_some();
        let one = |(drive, without): (&Drive, &Drive)| {
            let unit = self.model.units.of(drive.unit);
            // Where the loads push nobody wonders.
            if lifts_off && drive.holds_back && drive.effort * without.effort <= 0.0 {
                return effort::held_back(&drive.name, &unit.brief(drive.effort.abs()));
            }
            let without = unit.brief(without.effort);
            effort::needs(&drive.name, &unit.brief(drive.effort), &without, lifts_off)
        };
        solution.drives.iter().zip(&self.influence.drives).map(one).collect()
    }

    /// The speeds: "slows down at 17.3 m/s^2", with names if there are several.
    fn changes(&self, solution: &Solution) -> Vec<String> {
        let is_only = self.state.len() == 1;
        let one = |coordinate: &super::CoordinateAcceleration| {
            let change = coordinate.speed?;
            let name = &coordinate.name;
            let words = match change {
                SpeedChange::StartsForwards if is_only => format!("starts to move, {name} growing"),
                SpeedChange::StartsBackwards if is_only => format!("starts to move, {name} falling"),
                SpeedChange::Undecided if is_only => {
                    "has one solution; whether it speeds up or slows down is not decided".to_owned()
                }
                SpeedChange::MayStart if is_only => {
                    "has one solution; whether it starts to move is not decided".to_owned()
                }
                change if is_only => change.in_words().to_owned() + &self.how_fast(coordinate),
                change => format!("{name} {}{}", change.in_words(), self.how_fast(coordinate)),
            };
            Some(words)
        };
        solution.coordinates.iter().filter_map(one).collect()
    }

    /// How much a speed changes, behind the words for its change: " at 17.3 m/s^2". Empty of what does not change.
    pub(super) fn how_fast(&self, coordinate: &super::CoordinateAcceleration) -> String {
        match coordinate.speed {
            Some(SpeedChange::SpeedsUp | SpeedChange::SlowsDown) => {
                let unit = self.model.units.of(coordinate.unit);
                format!(" at {}", unit.brief(coordinate.acceleration.abs()))
            }
            _ => String::new(),
        }
    }

    /// The solutions that it can take: those that are not unstable, or all if none is left.
    pub(crate) fn taken(&self) -> impl Iterator<Item = &Solution> {
        let is_stable = |solution: &Solution| solution.attainability.verdict != Verdict::Unattainable;
        let any = self.solutions.iter().any(is_stable);
        self.solutions.iter().filter(move |solution| !any || is_stable(solution))
    }

    /// "It can go on in 2 ways, and what went before decides which: push needs 36.36 or 52 N. In solution 2 it tips.", "It moves:
    /// push needs 36.36 N. Another solution is unstable: a real mechanism leaves it."
    fn ways_in_words(&self) -> String {
        let is_stable = |solution: &&Solution| solution.attainability.verdict != Verdict::Unattainable;
        let stable: Vec<&Solution> = self.solutions.iter().filter(is_stable).collect();
        let unstable = match self.solutions.len() - stable.len() {
            0 => String::new(),
            1 => " Another solution is unstable: a real mechanism leaves it.".to_owned(),
            several => format!(" {several} other solutions are unstable: a real mechanism leaves them."),
        };
        match stable.as_slice() {
            [] => format!(
                "It has {} solutions, and all are unstable: a real mechanism leaves them.",
                self.count
            ),
            [only] if self.is_listed() => self.moves_in_words(only) + &unstable,
            several => {
                let ways = if self.is_listed() { several.len().to_string() } else { self.count.clone() };
                let (efforts, tips) = (self.efforts_of(several), self.tipping_of(several));
                let which = effort::which_way(several.iter().map(|one| one.attainability.verdict));
                let measure = several.iter().find_map(|one| one.attainability.measure());
                let measure =
                    measure.map_or_else(String::new, |measure| format!(" To decide it, {measure}."));
                format!("It can go on in {ways} ways, and {which}{efforts}.{tips}{unstable}{measure}")
            }
        }
    }

    /// Whether the list has all solutions.
    fn is_listed(&self) -> bool {
        self.solutions.len().to_string() == self.count
    }

    /// ": push needs 36.36 or 52 N", of one drive and a few solutions.
    fn efforts_of(&self, solutions: &[&Solution]) -> String {
        let [drive] = self.influence.drives.as_slice() else { return String::new() };
        let unit = self.model.units.of(drive.unit);
        let of = |solution: &&Solution| solution.drives.first().map(|drive| unit.brief_number(drive.effort));
        let efforts: Vec<String> = solutions.iter().filter_map(of).collect();
        match efforts.as_slice() {
            [first @ .., last] if solutions.len() <= 4 && self.is_listed() && !first.is_empty() => {
                format!(": {} needs {}", drive.name, unit.with(&format!("{} or {last}", first.join(", "))))
            }
            _ => String::new(),
        }
    }

    /// " In solution 2 it tips.", where it does not in all.
    fn tipping_of(&self, solutions: &[&Solution]) -> String {
        let numbers = self.solutions.iter().enumerate().filter(|(_, solution)| tips(solution));
        let numbers: Vec<String> = numbers.map(|(index, _)| (index + 1).to_string()).collect();
        match numbers.as_slice() {
            [] => String::new(),
            all if all.len() == solutions.len() => " It tips in each.".to_owned(),
            [only] => format!(" In solution {only} it tips."),
            several => format!(" In solutions {} it tips.", several.join(", ")),
        }
    }

    /// "How left, right share the load is undetermined: belt 25 to 50 N. Give `stiffness` for one value."
    fn open_in_words(&self) -> String {
        let Some(open) = &self.undetermined else {
            return "Infinitely many solutions: the forces are undetermined.".to_owned();
        };
        let units = &self.model.units;
        let all = open.friction.iter().chain(&open.efforts).chain(&open.accelerations);
        let ranges = all.filter(|range| !range.is_one_value());
        let ranges: Vec<String> =
            ranges.take(3).map(|range| format!("{} {}", range.name, range.in_brief(units))).collect();
        let ranges = if ranges.is_empty() { String::new() } else { format!(": {}", ranges.join(", ")) };
        let advice = open.advice().map_or_else(String::new, |advice| format!(" {advice}"));
        let cause = capital(&open.cause());
        format!("{cause}{ranges}.{advice}")
    }

    /// "It moves in a preload gap, pin pressed by its preload alone: push needs 3 N (2 N without friction)."
    fn gap_in_words(&self) -> String {
        if self.partial || !self.undecided_modes.is_empty() {
            return format!("Not decided whether its state in a preload gap is the only solution. {NEARBY}");
        }
        let [state] = self.preload_gap_states.as_slice() else {
            return format!("{} states, each in a preload gap.", self.gap_state_count);
        };
        let loose = state.contacts.iter().filter(|contact| contact.preload_share.is_some());
        let loose: Vec<&str> = loose.map(|contact: &Contact| contact.name.as_str()).collect();
        let loose = loose.join(" and ");
        let moves = match (self.needs(state), self.changes(state)) {
            (needs, _) if !needs.is_empty() => format!(": {}", needs.join(", ")),
            (_, changes) if !changes.is_empty() => format!(": it {}", changes.join(", ")),
            _ => String::new(),
        };
        format!("It moves in a preload gap, {loose} pressed by its preload alone{moves}.")
    }

    /// "Up to 2.222 times this friction it moves in one way only, under any load."
    fn any_load_in_words(&self, margins: &Margins) -> Option<String> {
        let factor = margins.uniqueness?;
        let times = times(factor);
        let [any, other] = if self.sharing.is_some() {
            ["any load, play, misalignment and stiffness", "Other loads, play, misalignment or stiffness"]
        } else {
            ["any load", "Other loads"]
        };
        Some(if factor == 0.0 {
            format!("{other} can leave it several ways to move, even without friction.")
        } else if factor < 1.0 {
            format!("{other} can jam it or leave it several ways to move, already from {times} on.")
        } else {
            safe_up_to(any, &times)
        })
    }

    /// Of a mechanism whose other contact modes are not known with more friction: where its only one ends in a jam, and what is
    /// proven.
    fn without_margins(&self) -> Vec<String> {
        let margin = match self.solutions.as_slice() {
            [only] => only.margin.as_ref().filter(|margin| margin.ends_with == ModeEndCause::Locking),
            _ => None,
        };
        let jams = margin.and_then(|margin| margin.factor);
        let jams = jams.map(|factor| format!("In this contact mode it would jam from {}.", times(factor)));
        let least = self.unique_at_least.map(|factor| {
            if effort::is_any_friction(factor) {
                "Whatever the friction, it moves in one way only, under any load.".to_owned()
            } else {
                safe_up_to("any load", &format!("at least {}", times(factor)))
            }
        });
        let missing = self.margins_missing.filter(|reason| *reason != MarginsMissing::Undetermined);
        let missing = missing.map(|reason| format!("Safety factor not computed: {}.", reason.in_words()));
        let known: Vec<String> = jams.into_iter().chain(least).collect();
        if known.is_empty() { missing.into_iter().collect() } else { known }
    }

    /// "It would jam from mu = 0.6667 (2.222 times this friction)."
    fn end_in_words(&self, margins: &Margins, at: &str) -> String {
        let again = margins.solutions_again;
        let again =
            again.map_or_else(String::new, |again| format!("; it moves again from {} times", brief(again)));
        // What only lies on its face is stopped by its own motion.
        let lies =
            self.solutions.iter().any(|solution| solution.joints.iter().any(|joint| joint.face.is_some()));
        match margins.tips.as_slice() {
            [] if lies && self.model.drives == 0 => {
                format!("It would catch and stop at once (jam) from {at}{again}.")
            }
            [] => format!("It would jam from {at}{again}."),
            joints => sentence(&(it_would_tip(joints, at) + &again)),
        }
    }

    /// True if friction acts anywhere: more of none is none.
    fn has_friction(&self) -> bool {
        let mut states = self.solutions.iter().chain(&self.preload_gap_states);
        states.any(|state| {
            state.contacts.iter().any(|contact| contact.friction_force != 0.0)
                || state.hinges.iter().any(|hinge| hinge.friction.is_some())
        })
    }
}

/// "Up to 2.222 times this friction it moves in one way only, under any load."
fn safe_up_to(any: &str, times: &str) -> String {
    format!("Up to {times} it moves in one way only, under {any}.")
}

/// A clause as a sentence.
fn sentence(clause: &str) -> String {
    capital(clause) + "."
}

/// Whether a block tips in a solution.
fn tips(solution: &Solution) -> bool {
    solution.joints.iter().any(|joint| joint.face == Some(OnFace::Tips))
}

/// The contacts that lift off in a solution: "tip lifts off"; none where none does.
fn lifting(solution: &Solution) -> Option<String> {
    let opens = solution.contacts.iter().filter(|contact| contact.gap_acceleration.is_some());
    let names: Vec<&str> = opens.map(|contact| &*contact.name).collect();
    match names.as_slice() {
        [] => None,
        [only] => Some(format!("{only} lifts off")),
        several => Some(format!("{} lift off", several.join(" and "))),
    }
}
