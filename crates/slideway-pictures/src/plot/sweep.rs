//! The figure of a sweep over one quantity: a quantity along every branch, thinned while the rows come.

use super::figure::{Axis, Branch, Curve, End, Figure, Hatching, MarkedValue, Panel, Stroke, Zone, headline};
use super::limits;
use slideway::limits::Quantity;
use slideway::report::Verdict;
use slideway::report::precise;
use slideway::sweep::{Breakpoint, Line, PointStatus, RowKind, Rows, Sweep};

/// About as many points of a branch are kept: several for each pixel.
const POINTS: u64 = 3000;
/// The most branches that are drawn: nobody could tell more apart.
const MOST_BRANCHES: u32 = 24;
/// Intervals narrower than this share of the range are not hatched, and values as close to each other share a
/// label.
const NARROW: f64 = 1e-6;
/// The most hatched intervals; more of them are the noise of a sweep along a boundary.
const MOST_ZONES: usize = 1000;

/// A sweep over one quantity on its way into a figure.
///
/// Rows are added in their order. What is kept does not grow with the number of points.
///
/// ```
/// use slideway::limits::Quantity;
/// use slideway::model::Model;
/// use slideway::sweep::{GridAxis, Sweep, SweepOptions};
/// use slideway_pictures::plot::SweepPlot;
/// use std::ops::ControlFlow;
///
/// let model = Model::parse(slideway::gallery::find("drawer").expect("in the gallery").text)?;
/// let sweep = Sweep::new(&model, &SweepOptions::grid([GridAxis::linear("mu", 0.0, 0.8, 81)]))?;
/// let mut plot = SweepPlot::new(&sweep, Quantity::NormalForce).expect("one axis");
/// let extract = plot.extractor();
/// sweep.run(&mut sweep.start(), &|rows| extract.rows(rows), &mut |parts, _| {
///     parts.into_iter().for_each(|part| plot.add(part));
///     ControlFlow::Continue(())
/// });
/// // The drawer jams from mu = L / (2 a) = 2/3 on.
/// let figure = plot.figure(Some("Drawer"));
/// assert!((figure.panels[0].zones[0].from - 2.0 / 3.0).abs() < 1e-9);
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
#[derive(Debug, Clone)]
pub struct SweepPlot {
    line: Line,
    quantity: Quantity,
    series: Vec<Series>,
    contacts: Vec<String>,
    every: u64,
    branches: Vec<Drawn>,
    left_out: u32,
    runs: Vec<Run>,
    marks: Vec<Mark>,
}

/// A plotted column.
#[derive(Debug, Clone)]
pub(super) struct Series {
    pub(super) column: usize,
    pub(super) name: String,
    pub(super) unit: &'static str,
}

impl Series {
    /// The columns of a quantity in the rows of a sweep.
    pub(super) fn of(sweep: &Sweep, quantity: Quantity) -> Vec<Self> {
        let prefix = limits::column_prefix(quantity);
        let columns = sweep.columns().iter().enumerate();
        let series = columns.filter_map(|(column, of)| {
            let name = of.name.strip_prefix(prefix)?.to_owned();
            Some(Self { column, name, unit: of.unit })
        });
        series.collect()
    }
}

/// Takes of rows what a plot needs; to be used in parallel.
#[derive(Debug, Clone)]
pub struct Extractor {
    every: u64,
    columns: Vec<usize>,
}

/// The extract of neighbouring rows that a plot needs.
#[derive(Debug, Clone, Default)]
pub struct Extract {
    kept: Vec<Kept>,
    runs: Vec<Run>,
    marks: Vec<Mark>,
}

#[derive(Debug, Clone)]
struct Kept {
    branch: u32,
    point: u64,
    at: f64,
    /// None where the state is on a boundary: that of its neighbours.
    stroke: Option<Stroke>,
    pattern: Vec<u8>,
    values: Vec<f64>,
    /// Whether it may be dropped when the branch goes on.
    is_last: bool,
}

/// Neighbouring points without a state.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Run {
    first: u64,
    last: u64,
    from: f64,
    to: f64,
    hatching: Hatching,
}

/// An exact end of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mark {
    point: u64,
    at: f64,
    breakpoint: Breakpoint,
}

#[derive(Debug, Clone)]
struct Drawn {
    number: u32,
    patterns: Vec<Vec<u8>>,
    points: Vec<Kept>,
}

impl Extractor {
    /// The points of branches that are kept, the runs of points without a state, and the exact ends of modes.
    pub fn rows(&self, rows: &Rows) -> Extract {
        let mut extract = Extract::default();
        let mut last_of: Vec<Kept> = Vec::new();
        for (row, head) in rows.heads.iter().enumerate() {
            let at = rows.numbers(row)[0];
            extract.note(head.point, at, head.breakpoint, head.status);
            if head.branch == 0 || head.branch > MOST_BRANCHES {
                continue;
            }
            let kept = |is_last| Kept {
                branch: head.branch,
                point: head.point,
                at,
                stroke: stroke(head.kind, head.verdict),
                pattern: rows.pattern(row).to_vec(),
                values: self.columns.iter().map(|&column| rows.numbers(row)[column]).collect(),
                is_last,
            };
            let changed = last_of.iter_mut().find(|last| last.branch == head.branch);
            let same = changed.as_ref().is_some_and(|last| {
                last.pattern == rows.pattern(row) && last.stroke == stroke(head.kind, head.verdict)
            });
            if !same || head.point % self.every == 0 || head.breakpoint != Breakpoint::No {
                extract.kept.push(kept(false));
            }
            match changed {
                Some(last) if same => {
                    (last.point, last.at) = (head.point, at);
                    let values = self.columns.iter().map(|&column| rows.numbers(row)[column]);
                    last.values.iter_mut().zip(values).for_each(|(old, new)| *old = new);
                }
                Some(last) => {
                    // The old stretch ends with its last point.
                    let old = std::mem::replace(last, kept(true));
                    extract.kept.push(Kept { is_last: false, ..old });
                }
                None => last_of.push(kept(true)),
            }
        }
        extract.kept.extend(last_of);
        extract.kept.sort_by_key(|kept| (kept.point, kept.is_last));
        extract
    }
}

impl Extract {
    /// Notes what became of a point; its rows follow one another.
    fn note(&mut self, point: u64, at: f64, breakpoint: Breakpoint, status: PointStatus) {
        if breakpoint != Breakpoint::No && self.marks.last().is_none_or(|mark| mark.point != point) {
            self.marks.push(Mark { point, at, breakpoint });
        }
        let hatching = match status {
            PointStatus::None => Hatching::Rising,
            PointStatus::NoPosition | PointStatus::Refused => Hatching::Falling,
            _ => return,
        };
        join(&mut self.runs, Run { first: point, last: point, from: at, to: at, hatching });
    }
}

/// Adds a run, or lengthens the last one by it.
fn join(runs: &mut Vec<Run>, next: Run) {
    let room = runs.len() < MOST_ZONES;
    match runs.last_mut() {
        Some(run) if run.hatching == next.hatching && next.first <= run.last + 1 => {
            (run.last, run.to) = (next.last, next.to);
        }
        _ if room => runs.push(next),
        _ => {}
    }
}

fn stroke(kind: RowKind, verdict: Verdict) -> Option<Stroke> {
    Some(match (kind, verdict) {
        (RowKind::PreloadGap, _) => Stroke::Dotted,
        (RowKind::Boundary, _) => return None,
        (_, Verdict::Attainable) => Stroke::Solid,
        (_, Verdict::Unattainable) => Stroke::Dashed,
        _ => Stroke::DashDotted,
    })
}

/// The stroke of every point: where it has none that of the point before, or of the first one that has one.
fn strokes(points: &[Kept]) -> Vec<Stroke> {
    let mut now = points.iter().find_map(|kept| kept.stroke).unwrap_or(Stroke::DashDotted);
    let known = points.iter().map(|kept| {
        now = kept.stroke.unwrap_or(now);
        now
    });
    known.collect()
}

impl SweepPlot {
    /// None if there is no line to draw over, see [`Sweep::line`], or the model has nothing of this quantity.
    /// Strokes tell of attainability, so the sweep has to examine it.
    pub fn new(sweep: &Sweep, quantity: Quantity) -> Option<Self> {
        let line = sweep.line()?;
        let mut series = Series::of(sweep, quantity);
        // The first column is what the line is drawn over.
        series.retain(|series| series.column > 0);
        (!series.is_empty()).then(|| Self {
            line,
            quantity,
            series,
            contacts: sweep.contacts().map(str::to_owned).collect(),
            every: sweep.points().div_ceil(POINTS).max(1),
            branches: Vec::new(),
            left_out: 0,
            runs: Vec::new(),
            marks: Vec::new(),
        })
    }

    /// Returns the extractor that takes of rows what this plot needs.
    pub fn extractor(&self) -> Extractor {
        Extractor { every: self.every, columns: self.series.iter().map(|series| series.column).collect() }
    }

    /// Adds what follows on what was added before.
    pub fn add(&mut self, extract: Extract) {
        self.marks.extend(extract.marks);
        extract.runs.into_iter().for_each(|run| join(&mut self.runs, run));
        for kept in extract.kept {
            let place = self.branches.iter_mut().find(|drawn| drawn.number == kept.branch);
            let drawn = match place {
                Some(drawn) => drawn,
                None => self.branches.push_mut(Drawn {
                    number: kept.branch,
                    patterns: Vec::new(),
                    points: Vec::new(),
                }),
            };
            // On a boundary another pattern would do as well.
            if kept.stroke.is_some() && !drawn.patterns.contains(&kept.pattern) {
                drawn.patterns.push(kept.pattern.clone());
            }
            match drawn.points.last() {
                Some(last) if last.point == kept.point => {}
                Some(last) if last.is_last => {
                    // The branch goes on beyond what was its last point.
                    drawn.points.pop();
                    drawn.points.push(kept);
                }
                _ => drawn.points.push(kept),
            }
        }
    }

    /// Notes how many branches the sweep has, so that the figure mentions those that are not drawn.
    pub fn set_branches(&mut self, count: u32) {
        self.left_out = count.saturating_sub(MOST_BRANCHES);
    }

    /// The figure: a panel for each unit; each branch has a colour, and a stroke that says whether a
    /// mechanism with slightly elastic guides settles on it; exact ends of modes are marked, intervals
    /// without a solution hatched.
    pub fn figure(&self, title: Option<&str>) -> Figure {
        let mut legend = Vec::new();
        let mut units: Vec<&str> = self.series.iter().map(|series| series.unit).collect();
        units.dedup();
        let mut panels: Vec<Panel> = units.iter().map(|unit| self.panel(unit, &mut legend)).collect();
        limits::without_empty_ends(&mut panels);
        let mut subtitle = vec![format!("Signs of the normal forces: {}", self.contacts.join(", "))];
        if self.left_out > 0 {
            subtitle.push(format!("{} more branches are not drawn", self.left_out));
        }
        if self.runs.len() >= MOST_ZONES {
            subtitle.push("Not all intervals without a solution are hatched".to_owned());
        }
        Figure {
            title: headline(
                title,
                &format!("{} over {}", limits::name(self.quantity), limits::in_words(&self.line.name)),
            ),
            subtitle: subtitle.join(". "),
            panels,
            branches: legend,
            quantities: self.series.iter().map(|series| series.name.clone()).collect(),
            one_legend: false,
        }
    }

    fn panel(&self, unit: &str, legend: &mut Vec<Branch>) -> Panel {
        let name = limits::name(self.quantity);
        let name = match &self.series[..] {
            [only] => format!("{name} of {}", only.name),
            _ => name.to_owned(),
        };
        let scale = self.line.shown_in.scale();
        let drawn = self.branches.iter().enumerate();
        Panel {
            x: Axis {
                name: self.line.name.clone(),
                unit: self.line.shown_in.name().to_owned(),
                range: Some(self.line.range.map(|end| end / scale)),
                logarithmic: self.line.logarithmic,
            },
            y: Axis { name, unit: self.line.units.of(unit).name().to_owned(), ..Axis::default() },
            zones: self.runs.iter().filter_map(|run| self.zone(run)).collect(),
            marked: self.marked(),
            curves: drawn.flat_map(|(colour, branch)| self.curves(colour, branch, unit, legend)).collect(),
            ..Panel::default()
        }
    }

    /// The curves of a branch, cut where its verdict changes.
    fn curves(&self, colour: usize, branch: &Drawn, unit: &str, legend: &mut Vec<Branch>) -> Vec<Curve> {
        let mut curves = Vec::new();
        let scale = self.line.shown_in.scale();
        let shown_in = self.line.units.of(unit);
        let points = &branch.points;
        let strokes = strokes(points);
        let mut start = 0;
        while start < points.len() {
            let stroke = strokes[start];
            let length = strokes[start..].iter().take_while(|other| **other == stroke).count();
            let end = start + length;
            let name = name(branch, stroke);
            let place = legend.iter().position(|entry| entry.name == name).unwrap_or_else(|| {
                legend.push(Branch { name, colour, stroke });
                legend.len() - 1
            });
            let ends = [
                if start == 0 { self.end(points[0].point, false) } else { End::Plain },
                if end == points.len() { self.end(points[end - 1].point, true) } else { End::Plain },
            ];
            // The next stretch begins where this one ends.
            let stretch = &points[start.saturating_sub(1)..end];
            for (quantity, _) in self.series.iter().enumerate().filter(|(_, series)| series.unit == unit) {
                let value = |kept: &Kept| [kept.at / scale, shown_in.number_of(kept.values[quantity])];
                let points = stretch.iter().map(value).collect();
                curves.push(Curve { branch: place, quantity, points, ends });
            }
            start = end;
        }
        curves
    }

    /// Returns the kind of the end of a branch at a point.
    fn end(&self, point: u64, is_last: bool) -> End {
        let beyond = if is_last { point.checked_add(1) } else { point.checked_sub(1) };
        let mark = |point: Option<u64>| self.marks.iter().find(|mark| Some(mark.point) == point);
        match (mark(beyond), mark(Some(point))) {
            (Some(mark), _) if grows(mark.breakpoint) => End::Diverges,
            (_, Some(_)) => End::Marked,
            _ => End::Plain,
        }
    }

    /// The interval of a run, up to the exact ends of modes that are its neighbours.
    fn zone(&self, run: &Run) -> Option<Zone> {
        let mark = |point: Option<u64>| self.marks.iter().find(|mark| Some(mark.point) == point);
        let from = mark(run.first.checked_sub(1)).map_or(run.from, |mark| mark.at);
        let to = mark(run.last.checked_add(1)).map_or(run.to, |mark| mark.at);
        let scale = self.line.shown_in.scale();
        let meaning = match run.hatching {
            Hatching::Rising => "excluded: no solution",
            Hatching::Falling | Hatching::Dotted => "excluded: cannot be assembled or solved",
        };
        let wide = to - from > NARROW * (self.line.range[1] - self.line.range[0]);
        wide.then(|| Zone {
            from: from / scale,
            to: to / scale,
            hatching: run.hatching,
            meaning: meaning.to_owned(),
        })
    }

    /// The exact ends of modes; those that cannot be told apart in a plot share a label.
    fn marked(&self) -> Vec<MarkedValue> {
        let near = NARROW * (self.line.range[1] - self.line.range[0]);
        let together = self.marks.chunk_by(|one, other| other.at - one.at <= near);
        let ends = together.map(|marks| self.label(marks, near));
        // Single points that cannot be solved leave gaps in the curves.
        let is_mark = |at: f64| self.marks.iter().any(|mark| (mark.at - at).abs() <= near);
        let is_gap =
            |run: &&Run| run.hatching == Hatching::Falling && run.to - run.from <= near && !is_mark(run.from);
        let gap = |run: &Run| {
            let mark = Mark { point: run.first, at: run.from, breakpoint: Breakpoint::NotSolved };
            self.label(&[mark], near)
        };
        let gaps = self.runs.iter().filter(is_gap).map(gap);
        let Line { value, range, shown_in, .. } = &self.line;
        ends.chain(gaps).chain(value.and_then(|value| limits::the_model(value, *range, shown_in))).collect()
    }

    fn label(&self, marks: &[Mark], near: f64) -> MarkedValue {
        let mut words: Vec<&str> = marks.iter().map(|mark| in_words(mark.breakpoint)).collect();
        words.dedup();
        let first = marks.first().map_or(0.0, |mark| mark.at);
        let at = if first.abs() <= near { 0.0 } else { first / self.line.shown_in.scale() };
        let number = precise(at).replace('-', "\u{2212}");
        let asymptote = marks.iter().any(|mark| grows(mark.breakpoint));
        MarkedValue { at, label: format!("{number}: {}", words.join("; ")), asymptote }
    }
}

/// Whether normal forces grow without bound there.
fn grows(breakpoint: Breakpoint) -> bool {
    matches!(breakpoint, Breakpoint::Locking | Breakpoint::WithoutBound)
}

fn in_words(breakpoint: Breakpoint) -> &'static str {
    match breakpoint {
        Breakpoint::No => "",
        Breakpoint::Locking => "it jams",
        Breakpoint::WithoutBound => "grows without bound",
        Breakpoint::SideChange => "side change",
        Breakpoint::GapCloses => "gap closes",
        Breakpoint::Tipping => "it tips",
        Breakpoint::Fold => "fold",
        Breakpoint::HingeUnloaded => "no force in a hinge",
        Breakpoint::NotSolved => "cannot be solved",
    }
}

/// Number and signs of a branch, and what the stroke means.
fn name(branch: &Drawn, stroke: Stroke) -> String {
    let signs = |pattern: &Vec<u8>| {
        let signs = pattern.iter().map(|&sign| match sign {
            b'-' => "\u{2212}".to_owned(),
            sign => char::from(sign).to_string(),
        });
        signs.collect::<Vec<String>>().join(" ")
    };
    let patterns: Vec<String> = branch.patterns.iter().map(signs).collect();
    let meaning = match stroke {
        Stroke::Solid => "",
        Stroke::Dashed => " (unstable)",
        Stroke::Dotted => " (preload gap)",
        Stroke::DashDotted => " (may vibrate unless damped, or stability not decided)",
    };
    format!("branch {}:\u{a0}{}{meaning}", branch.number, patterns.join(", then "))
}
