//! The report of a raw problem as text for people.

use super::{
    BeyondRange, ContinuumPart, EveryAnswer, EveryRightHandSide, NamedRange, RawKind, RawReport, RawShares,
    RawSolution, Unknowns, WithinRounding, WithinRoundingAnswer,
};
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Proof, Report, Status, Style, count};

/// Greatest number of groups that are listed one by one.
const GROUPS: usize = 8;
/// Greatest number of parts of a continuum that are listed one by one.
const PARTS: usize = 8;
/// Greatest number of signs that are listed in one line.
const SIGNS: usize = 64;

impl Report for RawReport {
    fn answer(&self) -> String {
        let found = match self.open.is_empty() {
            _ if self.partial => " found so far",
            true => "",
            false => " found",
        };
        let (one, more) = words(self.kind);
        let single = match self.count.as_str() {
            "0" => format!("No single {one}"),
            "1" => format!("One {one}"),
            count => format!("{count} {more}"),
        };
        let single = format!("{single}{found}");
        match self.status {
            Status::None => format!("No {one}."),
            Status::Unknown if self.partial => {
                "Not decided: no solution was found before the search ended.".to_owned()
            }
            Status::Unknown => "Not decided: no solution was found, but none is excluded.".to_owned(),
            Status::Continuum => {
                let continua = match self.continuum_count.as_str() {
                    "1" => "one continuum".to_owned(),
                    count => format!("{count} continua"),
                };
                let as_well = if self.count == "0" { String::new() } else { format!(" {single} as well.") };
                format!("Infinitely many {more}: {continua}{found}.{as_well}")
            }
            Status::PreloadGap => {
                let none = if self.open.is_empty() { "No solution" } else { "No solution found" };
                format!("{none}, but there is a state with an unknown in its preload gap.")
            }
            Status::One | Status::Several => format!("{single}."),
        }
    }

    /// The verdict first, then the solutions, then how they were found.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.verdict();
        text.within_rounding();
        text.every_right_hand_side();
        let title = if self.kind == RawKind::Game { "Equilibrium" } else { "Solution" };
        text.solutions(title, &self.count, &self.solutions);
        text.solutions("Preload gap", &self.gap_state_count, &self.gap_states);
        text.continua();
        if text.is_verbose() {
            text.strategy();
        }
        text.text()
    }
}

type Text<'r> = Page<'r, RawReport>;

impl Text<'_> {
    fn heading(&mut self) {
        let kind = self.report.kind;
        self.headline(kind.title());
        let (first, others) = (self.report.first, self.report.size - self.report.first);
        let size = match kind {
            RawKind::Mlcp => format!("{first} free, {others} complementary"),
            RawKind::Game => format!("{first} x {others}"),
            _ => format!("n = {others}"),
        };
        self.line(&format!("{},  {size}", kind.equation()));
        self.line("");
    }

    fn verdict(&mut self) {
        let report = self.report;
        self.status(report.status, &report.answer());
        let proof = match report.complete {
            // What holds within rounding is proven, too.
            Proof::Proven
                if report
                    .within_rounding
                    .as_ref()
                    .is_some_and(|near| near.answer == WithinRoundingAnswer::None) =>
            {
                ""
            }
            Proof::Proven if report.status == Status::None => "Proven.",
            Proof::Proven => "Proven: there are no others.",
            // That was said.
            Proof::NotProven if report.status == Status::Unknown => "",
            Proof::NotProven => "Not proven: there may be others.",
        };
        if !proof.is_empty() {
            self.line(proof);
        }
        for open in &report.open {
            self.line(&format!("  Open: {open}"));
        }
    }

    /// The solutions for numbers that differ by rounding alone.
    fn within_rounding(&mut self) {
        let Some(WithinRounding { relative, answer, unknowns, .. }) = &self.report.within_rounding else {
            return;
        };
        let rounding = format!("rounding alone (relative {relative:e})");
        let Some(unknowns) = unknowns else {
            self.line(&if *answer == WithinRoundingAnswer::None {
                format!("Proven: there is none, nor any for numbers that differ by {rounding}.")
            } else {
                format!("Not decided: whether there is one for numbers that differ by {rounding}.")
            });
            return;
        };
        self.line(&format!("Hint: for numbers that differ by {rounding} there is one:"));
        self.line("");
        self.unknowns(unknowns, &[]);
    }

    /// Results for all right-hand sides.
    fn every_right_hand_side(&mut self) {
        let Some(EveryRightHandSide { answer, patterns, reason, .. }) = &self.report.every_right_hand_side
        else {
            return;
        };
        let kind = self.report.kind;
        let vector = match kind.size_vectors() {
            [] => "right-hand side".to_owned(),
            [only, "blocks"] => (*only).to_owned(),
            vectors => vectors.join(" and "),
        };
        let shown = patterns.join(" and ");
        let (is, is_not) = match kind {
            RawKind::Lcp => (" (M is a P-matrix)", " (M is not a P-matrix)"),
            _ => ("", ""),
        };
        self.line(&match answer {
            EveryAnswer::One => format!("Proven: for every {vector} there is exactly one solution{is}."),
            EveryAnswer::NotOne => format!(
                "For some {vector} there are several solutions or none{is_not}: the oriented determinants of the \
                 patterns {shown} have opposite signs."
            ),
            EveryAnswer::Singular => format!(
                "For some {vector} there is no solution or infinitely many{is_not}: the matrix of the pattern \
                 {shown} is singular."
            ),
            EveryAnswer::InDoubt | EveryAnswer::NotComputed | EveryAnswer::Jumps => {
                format!("Not decided: whether there is exactly one solution for every {vector}; {reason}.")
            }
        });
    }

    fn solutions(&mut self, title: &str, all: &str, solutions: &[RawSolution]) {
        for (at, solution) in solutions.iter().enumerate() {
            self.line("");
            // Of a game the strategies say all.
            let is_game = self.report.kind == RawKind::Game;
            let told = self.is_verbose() && !is_game && solution.signs.len() <= SIGNS;
            let signs = if told { signs(solution) } else { String::new() };
            self.headed(&format!("{title} {} of {all}", at + 1), format!("   {signs}").trim_end());
            self.boundary(solution);
            self.unknowns(&solution.unknowns, &solution.beyond_range);
            for gap in &solution.gaps {
                let share = value(gap.lambda, ("lambda", gap.index), &solution.beyond_range);
                self.line(&format!("  N_{} is in its gap, share {share}", gap.index + 1));
            }
            if solution.shares_vary {
                self.line("  These shares are an example: others have the same values");
            }
            if !solution.beyond_range.is_empty() {
                self.line("  Values that have an exponent beyond -308 or 308 have no floating-point number: 17 digits are shown");
            }
            if let Some(radius) = solution.enclosure_radius {
                let bound = power_of_ten_above(radius);
                self.line(&match radius {
                    0.0 if solution.beyond_range.is_empty() => "  exact".to_owned(),
                    0.0 => "  all others: exact".to_owned(),
                    _ => format!("  proven to within {bound}"),
                });
            }
        }
        if !solutions.is_empty() && solutions.len().to_string() != all {
            self.line("");
            self.line(&format!(
                "Listed: the first {} of {all}; --max-solutions lists more.",
                solutions.len()
            ));
        }
    }

    fn boundary(&mut self, solution: &RawSolution) {
        if !solution.on_boundary {
            return;
        }
        if self.report.kind == RawKind::BlockAve {
            return self.line("  A block is zero, or may be: it has no certain direction");
        }
        let in_gap = |at: usize| solution.gaps.iter().any(|gap| gap.index == at);
        let vanishes = |at: &usize| match (self.report.kind, &solution.unknowns) {
            (RawKind::Mcp, Unknowns::Complementary { w, .. }) => solution.signs[*at] != 0 && w[*at] == 0.0,
            (RawKind::Mlcp, _) if *at < self.report.first => false,
            _ => solution.signs[*at] == 0 && !in_gap(*at),
        };
        let all: Vec<usize> = (0..solution.signs.len()).filter(vanishes).collect();
        if self.report.kind == RawKind::Game {
            return self.other_best_responses(&all);
        }
        let first = if self.report.kind == RawKind::Mlcp { self.report.first } else { 0 };
        let zero: Vec<String> = all.iter().map(|at| (at + 1 - first).to_string()).collect();
        let what = match self.report.kind {
            RawKind::Lcp | RawKind::Hlcp | RawKind::Mlcp => "z_k = w_k = 0",
            RawKind::Mcp => "w_k = 0 at a bound",
            RawKind::Ave | RawKind::BlockAve => "x_k = 0",
            RawKind::Modes | RawKind::Game => "N_k = 0",
        };
        self.line(&format!("  On the boundary between patterns: {what} for k = {}", zero.join(", ")));
    }

    /// Pure strategies that are not played although none is better.
    fn other_best_responses(&mut self, all: &[usize]) {
        let first = self.report.first;
        let (rows, columns): (Vec<usize>, Vec<usize>) = all.iter().partition(|at| **at < first);
        let columns: Vec<usize> = columns.iter().map(|at| at - first).collect();
        let told = [("rows", rows), ("columns", columns)];
        let words: Vec<String> = told
            .iter()
            .filter(|(_, all)| !all.is_empty())
            .map(|(name, all)| format!("{name} {}", ranges(all)))
            .collect();
        self.line(&format!("  Best responses that are not played: {}", words.join(", ")));
    }

    fn continua(&mut self) {
        let report = self.report;
        let all = &report.continuum_count;
        for (at, continuum) in report.continua.iter().enumerate() {
            self.line("");
            let title = format!("Continuum {} of {all}", at + 1);
            if let [only] = continuum.parts.as_slice() {
                self.headed(&title, &format!("   {}", shape(only)));
                self.part(only);
                continue;
            }
            let parts = count(continuum.parts.len(), "part", "parts");
            self.headed(&title, &format!("   {parts} that do not depend on each other"));
            for part in continuum.parts.iter().take(PARTS) {
                self.line(&format!("  {}: {}", self.whose(part), shape(part)));
                self.part(part);
            }
            if continuum.parts.len() > PARTS {
                let more = continuum.parts.len() - PARTS;
                self.line(&format!("  ... and {more} more parts, which --format json lists"));
            }
        }
        if !report.continua.is_empty() && report.continua.len().to_string() != *all {
            self.line("");
            let listed = report.continua.len();
            self.line(&format!("Listed: the first {listed} of {all} continua; --max-solutions lists more."));
        }
    }

    /// Which unknowns belong to a part of a continuum.
    fn whose(&self, part: &ContinuumPart) -> String {
        match part.indices.first() {
            Some(first) if self.report.kind == RawKind::Game => {
                let name = if *first < self.report.first { "x" } else { "y" };
                format!("Strategies {name}")
            }
            _ => format!("Of unknowns {}", ranges(&part.indices)),
        }
    }

    /// The unknowns of one solution.
    fn unknowns(&mut self, unknowns: &Unknowns, beyond_range: &[BeyondRange]) {
        let indices: Vec<usize> = (0..self.report.size).collect();
        self.tables((&indices, &[unknowns]), &[String::new()], beyond_range);
    }

    /// Unknowns of several columns: a table for each range of indices, and payoffs.
    fn tables(
        &mut self,
        (indices, columns): (&[usize], &[&Unknowns]),
        labels: &[String],
        beyond_range: &[BeyondRange],
    ) {
        let names = shown(self.report);
        for same in names.chunk_by(|(_, one), (_, other)| one.indices == other.indices) {
            let Some(range) = &same[0].1.indices else {
                self.payoffs(columns, labels);
                continue;
            };
            let own: Vec<usize> =
                indices.iter().filter(|at| range.contains(at)).map(|at| at - range.start).collect();
            if !own.is_empty() {
                let names: Vec<(usize, &str)> = same.iter().map(|(at, named)| (*at, named.name)).collect();
                let (header, rows) = rows(&names, (&own, columns), labels, beyond_range);
                self.table(&header, &rows);
            }
        }
    }

    /// The payoffs of a game in one line, or in one for each column.
    fn payoffs(&mut self, columns: &[&Unknowns], labels: &[String]) {
        for (column, label) in columns.iter().zip(labels) {
            let Unknowns::Strategies { payoff_1, payoff_2, .. } = column else { continue };
            let told = [("player 1", payoff_1), ("player 2", payoff_2)];
            let told =
                told.iter().filter_map(|(name, payoff)| Some(format!("{} to {name}", number((**payoff)?))));
            let of = if label.is_empty() { String::new() } else { format!(" of {label}") };
            self.line(&format!("  Payoffs{of}: {}", told.collect::<Vec<_>>().join(", ")));
        }
    }

    /// The vertices and directions of a part of a continuum.
    fn part(&mut self, part: &ContinuumPart) {
        let points = part.vertices.len();
        let is_fixed = (part.vertex_count, part.direction_count) == (1, 0);
        if let Some(inside) = &part.inside {
            self.tables((&part.indices, &[inside]), &["inside".to_owned()], &[]);
        }
        let columns: Vec<&Unknowns> = part.vertices.iter().chain(&part.directions).collect();
        for (at, chunk) in columns.chunks(4).enumerate() {
            let label = |offset: usize| match at * 4 + offset {
                _ if is_fixed => String::new(),
                number if number < points => format!("end {}", number + 1),
                number => format!("direction {}", number - points + 1),
            };
            let labels: Vec<String> = (0..chunk.len()).map(label).collect();
            self.tables((&part.indices, chunk), &labels, &[]);
        }
        let more = part.vertex_count - points + part.direction_count - part.directions.len();
        if more > 0 {
            let more = count(more, "end or direction", "ends and directions");
            self.line(&format!("  There are {more} more; --max-solutions lists more."));
        }
    }

    fn strategy(&mut self) {
        let report = self.report;
        self.line("");
        let nodes = format!("{} {}", report.nodes, if report.nodes == 1 { "node" } else { "nodes" });
        self.line(&format!("How: {}; {nodes}.", report.strategy));
        for group in report.groups.iter().take(GROUPS) {
            let whose = if report.groups.len() == 1 {
                format!("Of the patterns of {}", count(group.indices.len(), "unknown", "unknowns"))
            } else {
                format!("Of the patterns of unknowns {}", ranges(&group.indices))
            };
            self.line(&format!("  {whose}: {}.", shares(&group.patterns)));
        }
        if report.groups.len() > GROUPS {
            self.line(&format!("  ... and {} more groups", report.groups.len() - GROUPS));
        }
    }
}

/// "signs + - 0"
fn signs(solution: &RawSolution) -> String {
    let signs = solution.signs.iter().map(|sign| match sign {
        1 => " +",
        -1 => " -",
        _ => " 0",
    });
    format!("signs{}", signs.collect::<String>())
}

/// The shape of a part of a continuum.
fn shape(part: &ContinuumPart) -> String {
    match (part.vertex_count, part.direction_count) {
        (0, 0) => {
            let dimension = part.dimension.map(|dimension| format!(" of dimension {dimension}"));
            format!(
                "a set{} with more than 4096 corners, which are not listed",
                dimension.unwrap_or_default()
            )
        }
        (1, 0) => "fixed".to_owned(),
        (2, 0) => "a segment between two ends".to_owned(),
        (1, 1) => "a ray: its end, and its direction".to_owned(),
        (points, rays) => format!(
            "{} and {}: all mixtures of the ends, plus any positive multiples of the directions",
            count(points, "end", "ends"),
            count(rays, "direction", "directions")
        ),
    }
}

/// Returns a value as text, or that of `beyond_range` if the unknown of this name and index is there.
fn value(value: f64, (name, index): (&str, usize), beyond_range: &[BeyondRange]) -> String {
    let is_it = |one: &&BeyondRange| one.name.as_str() == name && one.index == index;
    match beyond_range.iter().find(is_it) {
        Some(one) => one.value.clone(),
        None if value.is_nan() => "beyond the range of numbers".to_owned(),
        None => number(value),
    }
}

/// One row for each index, with some of the unknowns of each column, given by place and name.
fn rows(
    names: &[(usize, &str)],
    (indices, columns): (&[usize], &[&Unknowns]),
    labels: &[String],
    beyond_range: &[BeyondRange],
) -> (Vec<String>, Vec<Vec<String>>) {
    let mut header = vec!["k".to_owned()];
    for label in labels {
        let titles =
            names.iter().map(|(_, name)| format!("{} {label}", shown_as(name)).trim_end().to_owned());
        header.extend(titles);
    }
    let row = |(at, index): (usize, &usize)| {
        let mut row = vec![(index + 1).to_string()];
        for column in columns {
            let named = column.named();
            row.extend(
                names.iter().map(|&(place, name)| value(named[place].1[at], (name, *index), beyond_range)),
            );
        }
        row
    };
    let rows = indices.iter().enumerate().map(row).collect();
    (header, rows)
}

/// The numbers to show, each with its place: of a mode problem the normal forces alone, whose sizes are the
/// `y`.
fn shown(report: &RawReport) -> Vec<(usize, NamedRange)> {
    let most = if report.kind == RawKind::Modes { 1 } else { usize::MAX };
    report.names().into_iter().enumerate().take(most).collect()
}

/// One solution and several, in the words of the problem.
fn words(kind: RawKind) -> (&'static str, &'static str) {
    if kind == RawKind::Game { ("equilibrium", "equilibria") } else { ("solution", "solutions") }
}

fn shown_as(name: &str) -> &str {
    if name == "normal_forces" { "N" } else { name }
}

/// "75 % excluded by interval propagation, 25 % solved one by one"
fn shares(shares: &RawShares) -> String {
    let parts = [
        (shares.uniqueness, "excluded by a proof that there is one solution"),
        (shares.cells, "excluded as no cell of an arrangement"),
        (shares.propagation, "excluded by interval propagation"),
        (shares.relaxation, "excluded by linear relaxation"),
        (shares.faces, "all of whose solutions are those of another pattern"),
        (shares.examined, "solved one by one"),
        (shares.unexplored, "not dealt with"),
    ];
    let parts: Vec<String> = parts
        .iter()
        .filter(|(share, _)| *share > 0.0)
        .map(|(share, what)| format!("{} % {what}", number(100.0 * share)))
        .collect();
    parts.join(", ")
}

/// "1-4, 7", counted from 1
fn ranges(indices: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for &index in indices {
        match parts.last_mut() {
            Some((_, last)) if *last + 1 == index => *last = index,
            _ => parts.push((index, index)),
        }
    }
    let words = parts.iter().map(|&(first, last)| match last - first {
        0 => (first + 1).to_string(),
        _ => format!("{}-{}", first + 1, last + 1),
    });
    words.collect::<Vec<_>>().join(", ")
}

/// A power of ten above a bound, with room for the rounding of other machines: "1e-15".
fn power_of_ten_above(bound: f64) -> String {
    format!("1e{}", bound.log10().ceil().max(-15.0))
}
