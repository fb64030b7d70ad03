//! The report as text for people: words first, then aligned numbers.

use super::effort::{is_any_friction, times};
use super::number::number;
use super::page::Page;
use super::speed::FRICTION_EXCEEDS_LOADS;
use super::{
    CertificateKind, ClosestMode, Contact, Continuum, CoordinateAcceleration, JointMode, ModeEndCause,
    ModeMargin, PatternSummary, Persistence, Proof, Report, Solution, SolveReport, SpeedChange, Status,
    Style, UncertainMode, Verdict,
};
use crate::units::{Unit, Units};
use std::fmt::Write;

impl Report for SolveReport {
    fn answer(&self) -> String {
        let answer = [vec![self.verdict_in_words()], self.safety_in_words()].concat().join(" ");
        self.uncertainty.as_ref().map_or_else(|| answer.clone(), |uncertainty| uncertainty.before(&answer))
    }

    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.verdict();
        // The loads at rest are the same for all solutions.
        let at_rest = self.solutions.iter().find_map(|solution| self.rest_in_words(solution));
        if let Some(at_rest) = at_rest.filter(|_| self.solutions.len() + self.preload_gap_states.len() > 1) {
            text.line(&at_rest);
        }
        text.margins();
        text.uncertainty();
        text.sharing();
        for (index, solution) in self.solutions.iter().enumerate() {
            let title = format!("Solution {} of {}", index + 1, self.solutions.len());
            text.solution(&title, solution);
        }
        for (index, state) in self.preload_gap_states.iter().enumerate() {
            let title = format!("Preload gap {} of {}", index + 1, self.preload_gap_states.len());
            text.solution(&title, state);
        }
        text.continua();
        text.undecided();
        text.rejected();
        text.locked_modes();
        text.closest_modes();
        text.text()
    }
}

impl SolveReport {
    /// Returns the remark that friction exceeds the loads, with how to ask whether it jams. Returns `None` if
    /// no state that it takes slows down although the loads push it.
    pub fn remark(&self) -> Option<String> {
        self.taken().any(slows_though_pushed).then(|| FRICTION_EXCEEDS_LOADS.to_owned())
    }

    /// The ranges in which infinitely many solutions lie: a sentence for each kind of quantity.
    pub fn undetermined_in_words(&self) -> Vec<String> {
        self.undetermined.as_ref().map_or_else(Vec::new, |open| open.in_words(&self.model.units))
    }

    /// The speeds in a solution, a sentence for each coordinate that no drive moves: "It slows down at 17.3 m/s^2."
    /// Then what the loads do at rest in this position.
    pub fn speeds_in_words(&self, solution: &Solution) -> Vec<String> {
        self.changes_in_words(solution).into_iter().chain(self.rest_in_words(solution)).collect()
    }

    fn changes_in_words(&self, solution: &Solution) -> Vec<String> {
        let is_only = self.state.len() == 1;
        let mut sentences = Vec::new();
        for coordinate in &solution.coordinates {
            let Some(change) = coordinate.speed else { continue };
            let who = if is_only { "It" } else { &coordinate.name };
            let mut line = format!("{who} {}{}", change.in_words(), self.how_fast(coordinate));
            if self.rates_not_given.contains(&coordinate.name) {
                line.push_str(" (the model gives no rate: it is taken as zero)");
            }
            sentences.push(line + ".");
        }
        sentences
    }

    /// When and where a coordinate would stop with its present acceleration: "With this acceleration x would stop after 0.1 s
    /// and 0.2 m."
    fn stops_in_words<'r>(&'r self, solution: &'r Solution) -> impl Iterator<Item = String> + 'r {
        let units = &self.model.units;
        self.state.iter().zip(&solution.coordinates).filter_map(move |(state, coordinate)| {
            let stop = coordinate.stop.as_ref()?;
            let (time, distance) = (units.of("s").show(stop.time), units.of(state.unit).show(stop.distance));
            Some(format!("With this acceleration {} would stop after {time} and {distance}.", state.name))
        })
    }

    /// "At rest in this position, these loads would not move it."
    fn rest_in_words(&self, solution: &Solution) -> Option<String> {
        let slows = solution.coordinates.iter().any(|one| one.speed == Some(SpeedChange::SlowsDown));
        let from_rest = self.from_rest.filter(|_| slows)?;
        Some(format!("At rest in this position, {}.", from_rest.in_words()))
    }

    /// How far all friction may grow before the answer changes, in words; empty where there is nothing to
    /// say.
    pub fn margins_in_words(&self) -> String {
        self.safety_in_words().join(" ")
    }
}

type Text<'r> = Page<'r, SolveReport>;

impl Text<'_> {
    /// How redundant guides share their load.
    fn sharing(&mut self) {
        let Some(sharing) = &self.report.sharing else { return };
        let units = &self.report.model.units;
        self.gap();
        let lines = if self.is_verbose() { sharing.in_words(units) } else { sharing.in_brief(units) };
        lines.iter().for_each(|line| self.line(line));
    }

    fn heading(&mut self) {
        let model = &self.report.model;
        if let Some(title) = &model.title {
            self.headline(title);
        }
        if self.is_verbose() {
            let mut parts = vec![
                count(model.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
                count(model.bodies, "body", "bodies"),
                count(model.contacts, "contact", "contacts"),
            ];
            if model.drives > 0 {
                parts.push(count(model.drives, "drive", "drives"));
            }
            self.line(&parts.join(", "));
        }
        let mut state: Vec<String> =
            self.report.state.iter().map(|state| state.in_words(&model.units)).collect();
        if self.report.time != 0.0 {
            state.push(format!("t = {}", model.units.of("s").show(self.report.time)));
        }
        self.line(&state.join("; "));
        if let Some(steps) = self.report.steps_from_drawing.filter(|_| self.is_verbose()) {
            self.line(&followed(steps));
        }
        self.line("");
    }

    fn verdict(&mut self) {
        let report = self.report;
        self.status(report.status, &report.answer());
        self.line(&report.known_in_words());
        if let Some(remark) = report.remark() {
            self.line(&remark);
        }
        report.one_face_hints.iter().for_each(|hint| self.line(&hint.words));
        if self.is_verbose() {
            self.search();
        }
        report.undetermined_in_words().iter().for_each(|line| self.line(line));
        let listed = report.solutions.len();
        if report.count != listed.to_string() {
            self.line(&format!("{listed} of them are listed."));
        }
    }

    /// How the solutions were found.
    fn search(&mut self) {
        let report = self.report;
        self.line(&match &report.patterns {
            Some(patterns) => {
                tried(patterns, report.sharing.as_ref().is_some_and(|sharing| sharing.self_stresses > 0))
            }
            None => {
                format!(
                    "How it was found, in {}: {}.",
                    count_u64(report.nodes, "step", "steps"),
                    report.strategy
                )
            }
        });
        for group in &report.jammed_groups {
            self.line(&format!("Contacts without a solution on their own: {}.", group.join(", ")));
        }
    }

    fn solution(&mut self, title: &str, solution: &Solution) {
        self.gap();
        let report = self.report;
        let contacts = &solution.contacts;
        let is_only = report.solutions.len() + report.preload_gap_states.len() == 1;
        if self.is_verbose() && !contacts.is_empty() {
            self.headed(title, &format!("   signs {}", spaced(&solution.pattern)));
        } else if !is_only || self.is_verbose() {
            self.headline(title);
        }
        self.modes(&solution.joints);
        self.boundary(solution);
        // Of the only solution the answer says what becomes of its speeds, unless drives are what matters.
        let is_said = is_only && solution.drives.is_empty() && report.rates_not_given.is_empty();
        let mut speeds =
            if is_said && !self.is_verbose() { Vec::new() } else { report.changes_in_words(solution) };
        if self.is_verbose() {
            speeds.extend(report.stops_in_words(solution));
        }
        if is_only {
            speeds.extend(report.rest_in_words(solution));
        }
        speeds.iter().for_each(|line| self.line(&format!("  {line}")));
        if !is_only || self.is_verbose() || solution.attainability.verdict != Verdict::Attainable {
            self.line(&format!("  {}", solution.attainability.in_words()));
        }
        if let Some(margin) = solution.margin.as_ref().filter(|_| !is_only || self.is_verbose()) {
            self.line(&format!("  {}", margin_in_words(margin, slows_though_pushed(solution))));
        }
        if !contacts.is_empty() {
            let (header, rows) = contact_table(contacts, &report.model.units);
            self.gap();
            self.table(&header, &rows);
        }
        let rows = motion_rows(report, solution, self.is_verbose());
        if !rows.is_empty() {
            self.gap();
            self.table(&["", "", "value", "unit"], &rows);
        }
        if self.is_verbose() {
            self.accuracy(solution);
        }
    }

    /// Remarks on a solution on the boundary of its mode, and on one that is not proven.
    fn boundary(&mut self, solution: &Solution) {
        let contacts = &solution.contacts;
        let pressed = contacts.iter().zip(solution.pattern.bytes()).filter(|(_, state)| *state != b'0');
        let floats = |contact: &&Contact| solution.floating.contains(&contact.name);
        let unpressed = pressed.map(|(contact, _)| contact).filter(|contact| contact.side == 0);
        let about_to_change = are(unpressed.filter(|contact| !floats(contact)));
        if !solution.floating.is_empty() {
            self.line(&format!(
                "  It floats within its play: {} carry nothing, and nothing decides where between its faces the block is.",
                solution.floating.join(", ")
            ));
        }
        let guided_in_gap = are(contacts.iter().filter(|contact| is_guided_in_gap(contact)));
        if solution.on_boundary {
            // Where stability is known both sides of a contact that nothing presses are one.
            let is_one = solution.attainability.verdict != Verdict::NotComputed && !self.is_verbose();
            if let Some(are) = about_to_change.filter(|_| !is_one) {
                self.line(&format!("  At a boundary: {are} not pressed by anything."));
            }
            if let Some(are) = guided_in_gap {
                self.line(&format!("  At a boundary: only while {are} exactly without normal force."));
            }
        } else if solution.certificate == CertificateKind::OnBoundary && solution.floating.is_empty() {
            self.line("  At a boundary within rounding: a normal force or the determinant may be zero.");
        }
        if solution.certificate == CertificateKind::NotProven && self.is_verbose() {
            self.line("  Found within tolerances, not proven.");
        }
    }

    /// The determinant and the residual.
    fn accuracy(&mut self, solution: &Solution) {
        // The determinant of equations with rows of compatibility has no meaning of its own.
        let determinant = match self.report.sharing {
            None => format!("determinant {}", number(solution.determinant)),
            Some(_) => format!("oriented determinant {}", number(solution.oriented_determinant)),
        };
        self.line("");
        self.line(&format!(
            "  {determinant}, equilibrium of every body to within {}",
            power_of_ten_above(solution.residual)
        ));
    }

    fn modes(&mut self, joints: &[JointMode]) {
        let width = joints.iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0);
        for joint in joints {
            let first = format!("{:width$}   ", joint.name);
            self.hung(&format!("  {first}{}", joint.mode), &first);
        }
    }

    /// Details on growing friction.
    fn margins(&mut self) {
        let factor = self.report.unique_at_least.filter(|factor| is_any_friction(*factor));
        if let Some(factor) = factor.filter(|_| self.is_verbose()) {
            self.line(&format!("Friction was looked at up to {}.", times(factor)));
        }
        let Some(margins) = self.report.margins.as_ref().filter(|_| self.is_verbose()) else { return };
        if let Some(critical) = &margins.critical_contact {
            self.line(&format!(
                "The most critical contact is {}: with {} times its friction, and that of the others as it is, the number of solutions changes.",
                critical.contact,
                number(critical.factor)
            ));
        }
        let factors = [
            ("another number of solutions from", margins.another_count),
            ("no solution from", margins.no_solution),
            ("solutions again from", margins.solutions_again),
            ("exactly one solution for any load up to", margins.uniqueness),
            ("solutions below", margins.moves_below.map(|below| below.factor)),
        ];
        let factors = factors.into_iter().filter_map(|(what, factor)| Some((what, factor?)));
        let factors: Vec<String> =
            factors.map(|(what, factor)| format!("{what} {}", number(factor))).collect();
        if !factors.is_empty() {
            self.line(&format!("As a factor on all friction: {}.", factors.join("; ")));
        }
    }

    fn uncertainty(&mut self) {
        let Some(uncertainty) = &self.report.uncertainty else { return };
        self.line("");
        let ranges: Vec<String> = uncertainty
            .parameters
            .iter()
            .map(|range| range.shown_in.range(&range.name, [range.from, range.to]))
            .collect();
        self.headline(&format!("For {}", ranges.join(", ")));
        self.report.for_all_values().iter().for_each(|line| self.line(&format!("  {line}")));
        let rows: Vec<Vec<String>> =
            uncertainty.modes.iter().map(|mode| uncertain_row(self.report, mode)).collect();
        let forces = self.report.model.units.of("N").title("normal forces");
        self.table(&["signs", "exists", &forces], &rows);
        self.line("  Everything else holds for the middle.");
    }

    fn continua(&mut self) {
        for continuum in &self.report.continua {
            if self.is_verbose() {
                self.corners(continuum);
            }
            if !continuum.tipping.is_empty() {
                self.line(&format!("In a part of it {} would tip.", continuum.tipping.join(", ")));
            }
        }
    }

    fn corners(&mut self, continuum: &Continuum) {
        self.line("");
        self.headline(&format!("Continuum   signs {}", spaced(&continuum.pattern)));
        self.line("  Normal forces at the ends and directions of unbounded growth, contact by contact:");
        if continuum.vertices.is_empty() {
            self.line("  More than 4096 corners, which are not listed");
        }
        for vertex in &continuum.vertices {
            self.line(&format!("  from {}", vector(vertex, &self.report.model.units.of("N"))));
        }
        for direction in &continuum.directions {
            self.line(&format!("  along {}", vector(direction, &Unit::default())));
        }
        if let Some(couple) = &continuum.couple {
            let unit = self.report.model.units.of("N m");
            let at: Vec<String> = couple.couples.iter().map(|couple| unit.show(*couple)).collect();
            self.line(&format!("  The couple of {} there: {}.", couple.hinge, at.join(", ")));
        }
    }

    fn undecided(&mut self) {
        // Boundaries of what is proven are no gaps of the answer.
        if self.report.complete == Proof::Proven && !self.is_verbose() {
            return;
        }
        for mode in &self.report.undecided_modes {
            self.line("");
            let what = match mode.contacts.as_slice() {
                [] => "whether it locks in this contact mode".to_owned(),
                contacts => format!("on which side {} is pressed", contacts.join(", ")),
            };
            self.line(&format!("Not decided within rounding: {what}{}", self.signs(&mode.pattern)));
            self.modes(&mode.joints);
        }
    }

    /// ", signs + -" among the details.
    fn signs(&self, pattern: &str) -> String {
        if self.is_verbose() { format!(", signs {}", spaced(pattern)) } else { String::new() }
    }

    fn rejected(&mut self) {
        let couple = self.report.model.units.of("N m");
        for rejection in &self.report.rejected {
            self.line("");
            self.line(&format!(
                "{} would tip: it needs a couple of {}, but its face provides at most {}{}. Model it as a block slider to see how \
                 it goes on.",
                rejection.joint,
                couple.show(rejection.couple.abs()),
                couple.show(rejection.limit),
                self.signs(&rejection.pattern)
            ));
        }
    }

    fn locked_modes(&mut self) {
        if !self.is_verbose() {
            return;
        }
        for mode in self.report.locked_modes.iter().take(8) {
            self.line("");
            self.line(&format!("Locked exactly: signs {} (determinant 0)", spaced(&mode.pattern)));
            self.modes(&mode.joints);
        }
        let more = self.report.locked_modes.len().saturating_sub(8);
        if more > 0 {
            self.line(&format!("... and {more} more"));
        }
    }

    /// Where it locks, or all modes that are close to it.
    fn closest_modes(&mut self) {
        if self.report.status != Status::None || self.report.closest_modes.is_empty() {
            return;
        }
        self.line("");
        if self.is_verbose() {
            self.headline(
                "The modes closest to locking (friction locks a mode where its determinant is zero)",
            );
            let rows: Vec<Vec<String>> = self.report.closest_modes.iter().map(closest_row).collect();
            self.table(&["signs", "contact mode", "determinant", ""], &rows);
            return;
        }
        if let Some(locking) = self.report.margins.as_ref().and_then(|margins| margins.locking.as_ref()) {
            self.line("It jams in this contact mode:");
            self.modes(&locking.joints);
        }
    }
}

/// "All 8 sign patterns were tried: 3 with a solution, 5 without."
fn tried(counts: &PatternSummary, is_shared: bool) -> String {
    let outcomes = [
        (counts.solution, "with a solution"),
        (counts.boundary, "on the boundary of a solution"),
        (counts.no_solution, "without a solution"),
        (counts.singular_without_solution, "singular and locked"),
        (counts.singular_with_point, "singular with one solution"),
        (counts.singular_with_continuum, "singular with a continuum"),
        (counts.undecided, "undecided"),
    ];
    let parts: Vec<String> = outcomes
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, outcome)| format!("{count} {outcome}"))
        .collect();
    let tried = match (counts.total, counts.undecided) {
        (1, 0) => "The only sign pattern was tried".to_owned(),
        (total, 0) => format!("All {total} sign patterns were tried"),
        (total, undecided) => format!("{} of {total} sign patterns were decided", total - undecided),
    };
    // A pattern with open contacts may be the one with a solution.
    if is_shared && counts.gap_patterns > 0 {
        return format!("{tried}, and {} with open contacts.", counts.gap_patterns);
    }
    let mut line = match parts.as_slice() {
        [_] if counts.no_solution == counts.total => format!("{tried}: none has a solution."),
        _ => format!("{tried}: {}.", parts.join(", ")),
    };
    if counts.gap_patterns > 0 {
        let _ = write!(line, " So were {} patterns with preload gaps.", counts.gap_patterns);
    }
    line
}

/// True if it slows down although the loads push it.
fn slows_though_pushed(solution: &Solution) -> bool {
    let slows = |one: &CoordinateAcceleration| one.speed == Some(SpeedChange::SlowsDown);
    solution.friction_exceeds_loads && solution.coordinates.iter().any(slows)
}

/// "This contact mode ends at 1.1 times this friction: it jams."
fn margin_in_words(margin: &ModeMargin, slows_though_pushed: bool) -> String {
    let Some(factor) = margin.factor else {
        let but = if slows_though_pushed { ", but the motion slows down in it" } else { "" };
        return format!("This contact mode remains however much friction grows{but}.");
    };
    let contacts = margin.contacts.join(", ");
    let end = match margin.ends_with {
        ModeEndCause::Locking => "it jams".to_owned(),
        ModeEndCause::WithoutBound => "its forces grow without limit".to_owned(),
        ModeEndCause::SideChange | ModeEndCause::LiftsOff | ModeEndCause::Touches => {
            format!("{contacts} {}", margin.ends_with.of_contacts(margin.contacts.len() > 1))
        }
        ModeEndCause::GapCloses => format!("the gap of {contacts} closes"),
        ModeEndCause::Fold => "it merges with another solution".to_owned(),
        ModeEndCause::HingeUnloaded => "the force of a hinge vanishes".to_owned(),
        _ => "a guided slider tips".to_owned(),
    };
    format!("This contact mode ends at {} times this friction: {end}.", number(factor))
}

fn uncertain_row(report: &SolveReport, mode: &UncertainMode) -> Vec<String> {
    let exists = match mode.persistence {
        Persistence::AllValues => "for all values",
        Persistence::SomeValues => "for some values",
        Persistence::Undecided => "undecided",
    };
    let names = report.solutions.first().map_or(&[][..], |solution| &solution.contacts);
    let force = report.model.units.of("N");
    let bound = |(contact, [from, to]): (usize, &[f64; 2])| {
        let name = names.get(contact).map_or(String::new(), |contact| format!("{} ", contact.name));
        format!("{name}{} to {}", force.number(*from), force.number(*to))
    };
    let bounds = mode.normal_force_bounds.as_ref();
    let bounds: Vec<String> =
        bounds.map_or_else(Vec::new, |bounds| bounds.iter().enumerate().map(bound).collect());
    vec![spaced(&mode.pattern), exists.to_owned(), bounds.join(", ")]
}

fn closest_row(mode: &ClosestMode) -> Vec<String> {
    let verdict =
        if mode.oriented_determinant < 0.0 { "beyond locking" } else { "not locked, contradicts its signs" };
    vec![spaced(&mode.pattern), joints_in_words(&mode.joints), number(mode.determinant), verdict.to_owned()]
}

fn contact_table(contacts: &[Contact], units: &Units) -> (Vec<String>, Vec<Vec<String>>) {
    let units = &of_contacts(contacts, units);
    let [force, speed, couple, pressure] = ["N", "m/s", "N m", "Pa"].map(|si| units.of(si));
    let scale = contacts.iter().map(|contact| contact.normal_force.abs()).fold(0.0, f64::max);
    let has_couple = contacts.iter().any(|contact| contact.couple.is_some());
    let has_pad = contacts.iter().any(|contact| contact.pressure.is_some());
    let has_share = contacts.iter().any(|contact| contact.preload_share.is_some());
    let has_deflection = contacts.iter().any(|contact| contact.deflection.is_some());
    let has_opened = contacts.iter().any(|contact| contact.gap_acceleration.is_some());
    let (length, acceleration) = (units.of("m"), units.of("m/s^2"));
    let deflections = contacts.iter().filter_map(|contact| contact.deflection);
    let greatest_deflection = deflections.fold(0.0_f64, |most, value| most.max(value.abs()));
    let fastest = contacts.iter().map(|contact| contact.sliding_velocity.abs()).fold(0.0, f64::max);
    let greatest_pressure = contacts.iter().filter_map(|contact| contact.pressure).fold(0.0, f64::max);
    let mut header = vec!["contact".to_owned(), force.title("normal force"), force.title("friction")];
    header.push(speed.title("sliding"));
    header.extend(has_couple.then(|| couple.title("couple")));
    header.extend(has_pad.then(|| pressure.title("pressure")));
    header.extend(has_share.then(|| "preload share at +".to_owned()));
    header.extend(has_deflection.then(|| length.title("deflection")));
    header.extend(has_opened.then(|| acceleration.title("gap acceleration")));
    let optional =
        |value: Option<f64>, unit: &Unit| value.map_or(String::new(), |value| unit.against(value, scale));
    let row = |contact: &Contact| {
        let mut row = vec![
            contact.name.clone(),
            force.against(contact.normal_force, scale),
            force.against(contact.friction_force, scale),
            speed.against(contact.sliding_velocity, fastest),
        ];
        row.extend(has_couple.then(|| optional(contact.couple, &couple)));
        row.extend(has_pad.then(|| {
            contact.pressure.map_or(String::new(), |value| pressure.against(value, greatest_pressure))
        }));
        row.extend(has_share.then(|| optional(contact.preload_share, &Unit::default())));
        row.extend(has_deflection.then(|| {
            contact.deflection.map_or(String::new(), |value| length.against(value, greatest_deflection))
        }));
        row.extend(
            has_opened
                .then(|| contact.gap_acceleration.map_or(String::new(), |value| acceleration.number(value))),
        );
        row
    };
    (header, contacts.iter().map(row).collect())
}

/// The units with that of forces in which most of those of these contacts read well.
pub fn of_contacts(contacts: &[Contact], units: &Units) -> Units {
    let forces = contacts.iter().flat_map(|contact| [contact.normal_force, contact.friction_force]);
    let forces: Vec<f64> = forces.filter(|force| *force != 0.0).collect();
    units.clone().suited_to_most("N", &forces)
}

/// Coordinates, drives, hinges and bodies: name, what, value, unit.
fn motion_rows(report: &SolveReport, solution: &Solution, verbose: bool) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    let mut row = |name: &str, what: &str, value: String, unit: &Unit| {
        rows.push(vec![name.to_owned(), what.to_owned(), value, unit.name().to_owned()]);
    };
    let units = &report.model.units;
    // Of a coordinate that a drive moves the acceleration is given.
    let is_told = |coordinate: &CoordinateAcceleration| verbose || coordinate.speed.is_some();
    for coordinate in solution.coordinates.iter().filter(|coordinate| is_told(coordinate)) {
        let unit = units.of(coordinate.unit);
        row(&coordinate.name, "acceleration", unit.number(coordinate.acceleration), &unit);
    }
    for drive in &solution.drives {
        let unit = units.of(drive.unit);
        let what = if drive.unit == "N" { "drive force" } else { "drive torque" };
        row(&drive.name, what, unit.number(drive.effort), &unit);
    }
    let force_scale = solution.contacts.iter().map(|contact| contact.normal_force.abs()).fold(0.0, f64::max);
    for hinge in &solution.hinges {
        let what = format!("hinge force on {}", hinge.on);
        let unit = units.of("N");
        row(&hinge.name, &what, pair(hinge.force, force_scale, &unit), &unit);
        if let Some(friction) = hinge.friction {
            let [moment, length] = ["N m", "m"].map(|si| units.of(si));
            row(
                &hinge.name,
                &format!("friction couple on {}", hinge.on),
                moment.number(friction.couple),
                &moment,
            );
            row(&hinge.name, "radius of its friction circle", length.number(friction.radius), &length);
        }
    }
    for end in &solution.round_ends {
        let (force, degrees) = (units.of("N"), Unit::of_text("deg").unwrap_or_else(|| units.of("rad")));
        row(&end.name, "force of the rod", force.against(end.normal_force, force_scale), &force);
        if end.normal_force > 1e-13 * force_scale {
            row(&end.name, "its direction, from n towards z", degrees.number(end.direction), &degrees);
        }
    }
    let moments = solution.carried.iter().filter(|carried| carried.unit == "N m");
    let moment_scale =
        moments.map(|carried| carried.value.abs()).fold(force_scale * report.model.size, f64::max);
    for carried in &solution.carried {
        let unit = units.of(carried.unit);
        let scale = if carried.unit == "N" { force_scale } else { moment_scale };
        let what = format!("{} {}", carried.quantity.in_words(), carried.on);
        row(&carried.name, &what, unit.against(carried.value, scale.max(carried.value.abs())), &unit);
    }
    for (body, [along_z, about_x, about_y]) in
        solution.bodies.iter().filter_map(|body| Some((body, body.out_of_plane?)))
    {
        let [unit, angular] = ["m/s^2", "rad/s^2"].map(|si| units.of(si));
        row(&body.name, "acceleration along z", unit.number(along_z), &unit);
        row(
            &body.name,
            "angular acceleration about x and y",
            pair([about_x, about_y], 0.0, &angular),
            &angular,
        );
    }
    if !verbose {
        return rows;
    }
    let scale = solution.bodies.iter().flat_map(|body| body.acceleration).map(f64::abs).fold(0.0, f64::max);
    for body in &solution.bodies {
        let [unit, angular] = ["m/s^2", "rad/s^2"].map(|si| units.of(si));
        row(&body.name, "acceleration", pair(body.acceleration, scale, &unit), &unit);
        if body.angular_acceleration.abs() > 1e-13 * scale {
            let value = angular.number(body.angular_acceleration);
            row(&body.name, "angular acceleration", value, &angular);
        }
    }
    rows
}

fn pair(components: [f64; 2], scale: f64, unit: &Unit) -> String {
    let scale = scale.max(components[0].abs()).max(components[1].abs());
    format!("({}, {})", unit.against(components[0], scale), unit.against(components[1], scale))
}

fn vector(components: &[f64], unit: &Unit) -> String {
    let scale = components.iter().map(|component| component.abs()).fold(0.0, f64::max);
    let list: Vec<String> = components.iter().map(|component| unit.against(*component, scale)).collect();
    unit.with(&format!("({})", list.join(", ")))
}

fn is_guided_in_gap(contact: &Contact) -> bool {
    contact.couple.is_some() && contact.preload_share.is_some()
}

/// The contacts with "is" or "are"; nothing if there are none.
fn are<'c>(contacts: impl Iterator<Item = &'c Contact>) -> Option<String> {
    let names: Vec<&str> = contacts.map(|contact| contact.name.as_str()).collect();
    match names.as_slice() {
        [] => None,
        [name] => Some(format!("{name} is")),
        names => Some(format!("{} are", names.join(", "))),
    }
}

/// "25 to 50", "25", "25 or more", "50 or less", "any".
pub(crate) fn ends_in_words(ends: [Option<String>; 2]) -> String {
    match ends {
        [Some(from), Some(to)] if from == to => from,
        [Some(from), Some(to)] => format!("{from} to {to}"),
        [Some(from), None] => format!("{from} or more"),
        [None, Some(to)] => format!("{to} or less"),
        [None, None] => "any".to_owned(),
    }
}

/// "guide touching at lower right and upper left; wall flat on the right guide"
pub(crate) fn joints_in_words(joints: &[JointMode]) -> String {
    let words: Vec<String> = joints.iter().map(|joint| format!("{} {}", joint.name, joint.mode)).collect();
    words.join("; ")
}

/// How positions were reached from the drawing.
pub fn followed(steps: usize) -> String {
    let steps = count(steps, "step", "steps");
    format!("followed from the drawing in {steps}, proven to stay on its assembly branch")
}

pub(crate) fn count(number: usize, one: &str, several: &str) -> String {
    count_u64(number as u64, one, several)
}

fn count_u64(number: u64, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// A power of ten above a residual, with room for the rounding of other machines: "1e-15".
fn power_of_ten_above(residual: f64) -> String {
    let exponent = residual.max(1e-16).log10().ceil();
    format!("1e{}", exponent.max(-15.0))
}

/// Words as the beginning of a sentence.
pub(crate) fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// "+-+" as "+ - +".
pub(crate) fn spaced(pattern: &str) -> String {
    let signs: Vec<String> = pattern.chars().map(|sign| sign.to_string()).collect();
    signs.join(" ")
}
