//! The figure of limits: a quantity along every mode over what is varied.

use super::colours::ModeColours;
use super::figure::{
    Axis, Band, Branch, Curve, End, Figure, Hatching, MarkedValue, Panel, Stroke, Zone, headline,
};
use super::scale::extent;
use slideway::limits::{
    self, CountLimits, Curves, Known, LimitsReport, ModeLimits, Quantity, RangeWithoutProblem, VariedQuantity,
};
use slideway::report::{ModeEndCause, Verdict, precise};
use slideway::units::Unit;

/// Values closer than this share of the range are one value in a plot.
const TOGETHER: f64 = 1e-6;
/// Excluded values at an end of the range have no more than this share of the width.
const MUCH: f64 = 0.4;
/// Curves end so close to a locking value, as a share of what is excluded beyond it.
const NEAR: f64 = 1e-3;

/// The figure of [`slideway::limits::limits_with_curves`]: a panel for each direction and unit.
///
/// Each mode is a branch: a colour, and a stroke that says whether a mechanism with slightly elastic guides
/// settles on it. Values at which forces grow without bound are asymptotes, values where contacts change side are marked, intervals
/// without a solution are hatched. Dots cover what was found at single values and is not proven between them.
pub fn limits_figure(report: &LimitsReport, curves: &Curves) -> Figure {
    let mut units: Vec<&str> = curves.series.iter().map(|series| series.unit).collect();
    units.dedup();
    let mut builder = Builder { curves, branches: Vec::new(), colours: ModeColours::default() };
    let mut panels = Vec::new();
    let opposite = report.reversed.as_ref().zip(curves.reversed.as_ref());
    for unit in &units {
        let both = opposite.is_some();
        let title = if both { "Moving as in the model" } else { "" };
        let direction = (&*report.modes, &*curves.forwards, &*report.counts, &*report.without_mode_problem);
        panels.push(builder.panel(report, title, unit, direction));
        if let Some((reversed, found)) = opposite {
            let direction = (&*reversed.modes, &**found, &*reversed.counts, &*reversed.without_mode_problem);
            panels.push(builder.panel(
                report,
                "Moving in the opposite direction with the same loads",
                unit,
                direction,
            ));
        }
    }
    if panels.iter().all(|panel| panel.curves.is_empty()) {
        let scale = report.vary.shown_in.scale();
        let directions =
            std::iter::once(&report.counts).chain(report.reversed.iter().map(|other| &other.counts));
        panels.iter_mut().zip(directions).for_each(|(panel, counts)| {
            (panel.y, panel.zones) = (Axis::default(), Vec::new());
            panel.bands = bands(counts, scale);
            panel.marked.extend(changes(counts, scale));
        });
    }
    without_empty_ends(&mut panels);
    let is_drawn = panels.iter().any(|panel| !panel.curves.is_empty());
    let quantity = if is_drawn { name(curves.quantity) } else { "what it does" };
    let shown = format!("{quantity} over {}", in_words(&report.vary.name));
    Figure {
        title: headline(report.title.as_deref(), &shown),
        subtitle: String::new(),
        panels,
        branches: builder.branches,
        quantities: curves.series.iter().map(|series| series.name.clone()).collect(),
        one_legend: false,
    }
}

/// Modes, their curves, numbers of solutions, and ranges without a mode problem, of one direction.
type Direction<'r> = (&'r [ModeLimits], &'r [limits::Curve], &'r [CountLimits], &'r [RangeWithoutProblem]);

struct Builder<'c> {
    curves: &'c Curves,
    branches: Vec<Branch>,
    colours: ModeColours,
}

impl Builder<'_> {
    fn panel(&mut self, report: &LimitsReport, title: &str, unit: &str, direction: Direction<'_>) -> Panel {
        let (modes, found, counts, without) = direction;
        let scale = self.curves.shown_in.scale();
        let drawn = modes.iter().zip(found).flat_map(|(mode, curve)| self.mode(mode, curve, unit)).collect();
        let name = name(self.curves.quantity);
        // A single one has no marker in the legend.
        let name = match &self.curves.series[..] {
            [only] => format!("{name} of {}", only.name),
            _ => name.to_owned(),
        };
        Panel {
            title: title.to_owned(),
            x: Axis {
                name: report.vary.name.clone(),
                unit: self.curves.shown_in.name().to_owned(),
                range: Some([report.vary.from / scale, report.vary.to / scale]),
                logarithmic: false,
            },
            y: Axis { name, unit: self.curves.units.of(unit).name().to_owned(), ..Axis::default() },
            zones: zones(counts, without, [report.vary.from, report.vary.to], scale),
            marked: marked(modes, [report.vary.from, report.vary.to], scale)
                .into_iter()
                .chain(present(&report.vary))
                .collect(),
            curves: drawn,
            ..Panel::default()
        }
    }

    /// The curves of a mode, cut where its verdict changes.
    fn mode(&mut self, mode: &ModeLimits, curve: &limits::Curve, unit: &str) -> Vec<Curve> {
        let stroke = |verdict: Verdict| if mode.preload_gap { Stroke::Dotted } else { stroke_of(verdict) };
        let all = curve.points.iter().map(|point| point.verdict);
        let with = |wanted: Stroke| all.clone().filter(move |verdict| stroke(*verdict) == wanted);
        let mut drawn = Vec::new();
        let mut start = 0;
        while start < curve.points.len() {
            let now = stroke(curve.points[start].verdict);
            let length =
                curve.points[start..].iter().take_while(|point| stroke(point.verdict) == now).count();
            let end = start + length;
            let branch = self.branch(mode, now, with(now));
            // The next stretch begins where this one ends.
            let points = &curve.points[start.saturating_sub(1)..end];
            let ends = [
                if start == 0 { end_of(mode.from_is) } else { End::Plain },
                if end == curve.points.len() { end_of(mode.to_is) } else { End::Plain },
            ];
            let scale = self.curves.shown_in.scale();
            let shown_in = self.curves.units.of(unit);
            let series = self.curves.series.iter().enumerate().filter(|(_, series)| series.unit == unit);
            drawn.extend(series.map(|(quantity, _)| {
                Curve {
                    branch,
                    quantity,
                    points: points
                        .iter()
                        .map(|point| [point.at / scale, shown_in.number_of(point.values[quantity])])
                        .collect(),
                    ends,
                }
            }));
            start = end;
        }
        drawn
    }

    /// The branch of a mode with a stroke; every mode has one colour.
    fn branch(
        &mut self,
        mode: &ModeLimits,
        stroke: Stroke,
        verdicts: impl Iterator<Item = Verdict>,
    ) -> usize {
        let colour = self.colours.of(&mode.pattern);
        let name = mode_name(mode, verdicts);
        let same = self.branches.iter().position(|branch| branch.name == name);
        same.unwrap_or_else(|| {
            self.branches.push(Branch { name, colour, stroke });
            self.branches.len() - 1
        })
    }
}

/// Where one interval gives way to the next.
fn changes(counts: &[CountLimits], scale: f64) -> impl Iterator<Item = MarkedValue> {
    let label = |at: f64| precise(at).replace('-', "\u{2212}");
    let inner = counts.iter().skip(1).map(move |count| count.from / scale);
    inner.map(move |at| MarkedValue { at, label: label(at), asymptote: false })
}

/// What happens in each interval, where no mode has a curve.
fn bands(counts: &[CountLimits], scale: f64) -> Vec<Band> {
    let mut meanings: Vec<String> = Vec::new();
    let band = |count: &CountLimits| {
        let meaning = match (count.starts.as_deref(), count.solutions) {
            (Some(starts), _) if !starts.is_empty() => starts.join(", or "),
            _ if count.continuum => "infinitely many solutions".to_owned(),
            (_, 0) => "no solution".to_owned(),
            (_, 1) => "one solution".to_owned(),
            (_, several) => format!("{several} solutions"),
        };
        let known = meanings.iter().position(|known| *known == meaning);
        let colour = known.unwrap_or_else(|| {
            meanings.push(meaning.clone());
            meanings.len() - 1
        });
        let sampled = if count.known == Known::Sampled { " (sampled)" } else { "" };
        Band { from: count.from / scale, to: count.to / scale, colour, meaning: meaning + sampled }
    };
    counts.iter().map(band).collect()
}

/// The value that the model has, where it is in the range.
pub(super) fn present(vary: &VariedQuantity) -> Option<MarkedValue> {
    the_model(vary.value, [vary.from, vary.to], &vary.shown_in)
}

pub(super) fn the_model(value: f64, [from, to]: [f64; 2], shown_in: &Unit) -> Option<MarkedValue> {
    let at = shown_in.number_of(value);
    let label = format!("{}: the model", precise(at).replace('-', "\u{2212}"));
    (from..=to).contains(&value).then_some(MarkedValue { at, label, asymptote: false })
}

/// Returns the plotted quantity in words.
pub(super) fn name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::NormalForce => "normal force",
        Quantity::Friction => "friction force",
        Quantity::Acceleration => "acceleration",
        Quantity::Effort => "effort",
    }
}

/// With what the names of its columns in a sweep begin.
pub(super) fn column_prefix(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::NormalForce => "normal_force.",
        Quantity::Friction => "friction_force.",
        Quantity::Acceleration => "acceleration.",
        Quantity::Effort => "effort.",
    }
}

/// Returns the varied quantity in words.
pub(super) fn in_words(varied: &str) -> &str {
    if varied == limits::FRICTION { "the factor of all friction" } else { varied }
}

/// Shortens the axes of x where no panel shows anything but excluded values at an end, if that takes much of
/// the width; a third of the rest is left, and the legend tells how far the excluded values go.
pub(super) fn without_empty_ends(panels: &mut [Panel]) {
    let used =
        extent(panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.points).map(|p| p[0]));
    let range = panels.first().and_then(|panel| panel.x.range);
    let (Some([first, last]), Some([from, to])) = (used, range) else { return };
    let is_excluded = |[begin, end]: [f64; 2]| {
        let covers = |zone: &Zone| {
            zone.hatching != Hatching::Dotted && zone.from <= begin + (end - begin) * NEAR && zone.to >= end
        };
        panels.iter().all(|panel| panel.zones.iter().any(covers))
    };
    if panels.iter().any(|panel| panel.x.logarithmic) || first >= last {
        return;
    }
    let third = (last - first) / 3.0;
    let much = MUCH * (to - from);
    let before = first - from > much && is_excluded([from, first]);
    let beyond = to - last > much && is_excluded([last, to]);
    let shown = [if before { first - third } else { from }, if beyond { last + third } else { to }];
    for panel in panels {
        panel.x.range = Some(shown);
        for zone in &mut panel.zones {
            for (is_cut, end, way) in [(before, zone.from, "down"), (beyond, zone.to, "up")] {
                let is_outside = end < shown[0] || end > shown[1];
                if is_cut && is_outside && (end == from || end == to) {
                    zone.meaning =
                        format!("{}, {way} to {} (the axis ends before)", zone.meaning, precise(end));
                }
            }
        }
    }
}

/// Signs, contact modes in words, and what a mechanism with slightly elastic guides does in them, where it does not settle
/// on them.
fn mode_name(mode: &ModeLimits, verdicts: impl Iterator<Item = Verdict>) -> String {
    let signs: Vec<String> =
        mode.pattern.chars().map(|sign| sign.to_string().replace('-', "\u{2212}")).collect();
    let words: Vec<String> =
        mode.joints.iter().map(|joint| format!("{} {}", joint.name, joint.mode)).collect();
    let meaning = if mode.preload_gap { " (preload gap)".to_owned() } else { in_parentheses(verdicts) };
    format!("{}:\u{a0}{}{meaning}", signs.join(" "), words.join("; "))
}

/// Returns the behaviour in a mode of a mechanism with slightly elastic guides: " (unstable)", empty where it
/// settles on it.
pub(super) fn in_parentheses(verdicts: impl Iterator<Item = Verdict>) -> String {
    let mut meanings: Vec<&str> = Vec::new();
    for verdict in verdicts {
        let meaning = match verdict {
            Verdict::Attainable => continue,
            Verdict::Unattainable => "unstable",
            Verdict::Flutter => "may vibrate unless damped",
            Verdict::Undecided => "stability not decided",
            Verdict::NotComputed => "stability not computed",
        };
        if !meanings.contains(&meaning) {
            meanings.push(meaning);
        }
    }
    if meanings.is_empty() { String::new() } else { format!(" ({})", meanings.join(", or ")) }
}

pub(super) fn stroke_of(verdict: Verdict) -> Stroke {
    match verdict {
        Verdict::Attainable => Stroke::Solid,
        Verdict::Unattainable => Stroke::Dashed,
        Verdict::Flutter | Verdict::Undecided | Verdict::NotComputed => Stroke::DashDotted,
    }
}

fn end_of(cause: ModeEndCause) -> End {
    match cause {
        ModeEndCause::Range => End::Plain,
        cause if grows(cause) => End::Diverges,
        _ => End::Marked,
    }
}

/// Whether normal forces grow without bound there.
fn grows(cause: ModeEndCause) -> bool {
    matches!(cause, ModeEndCause::Locking | ModeEndCause::WithoutBound)
}

/// The values at which modes end; those that cannot be told apart in a plot share a label.
fn marked(modes: &[ModeLimits], [from, to]: [f64; 2], scale: f64) -> Vec<MarkedValue> {
    let ends = modes
        .iter()
        .flat_map(|mode| [(mode.from, mode.from_is, &mode.from_at), (mode.to, mode.to_is, &mode.to_at)]);
    let mut found: Vec<(f64, String, bool)> = ends
        .filter_map(|(at, cause, contacts)| Some((at?, cause_in_words(cause, contacts)?, grows(cause))))
        .collect();
    found.extend(modes.iter().flat_map(turns));
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut marked: Vec<(MarkedValue, Vec<String>)> = Vec::new();
    for (at, what, locks) in found {
        match marked.last_mut() {
            Some((value, words)) if at - value.at <= TOGETHER * (to - from) => {
                value.asymptote |= locks;
                if !words.contains(&what) {
                    words.push(what);
                }
            }
            _ => marked.push((MarkedValue { at, label: String::new(), asymptote: locks }, vec![what])),
        }
    }
    let labelled = |(value, words): (MarkedValue, Vec<String>)| {
        let at = if value.at.abs() <= TOGETHER * (to - from) { 0.0 } else { value.at / scale };
        let number = precise(at).replace('-', "\u{2212}");
        MarkedValue { at, label: format!("{number}: {}", words.join("; ")), asymptote: value.asymptote }
    };
    marked.into_iter().map(labelled).collect()
}

/// Where motion begins to slow down or to speed up within a mode.
fn turns(mode: &ModeLimits) -> Vec<(f64, String, bool)> {
    let pairs = mode.speeds.windows(2).filter(|pair| pair[0].coordinate == pair[1].coordinate);
    let told = pairs
        .map(|pair| (pair[1].from, format!("{} {}", pair[1].coordinate, pair[1].speed.in_words()), false));
    told.collect()
}

fn cause_in_words(cause: ModeEndCause, contacts: &[String]) -> Option<String> {
    let at = contacts.join(", ");
    let plural = contacts.len() > 1;
    Some(match cause {
        ModeEndCause::Locking | ModeEndCause::WithoutBound => cause.in_words().to_owned(),
        ModeEndCause::SideChange | ModeEndCause::LiftsOff | ModeEndCause::Touches => {
            format!("{at} {}", cause.of_contacts(plural))
        }
        ModeEndCause::Fold => "fold".to_owned(),
        ModeEndCause::HingeUnloaded => format!("no force in {at}"),
        ModeEndCause::GapCloses => format!("gap of {at} closes"),
        ModeEndCause::Tipping => format!("it tips ({at})"),
        ModeEndCause::GreatestReaction => format!("{at} at the greatest reaction"),
        ModeEndCause::Reversal => "sliding reverses".to_owned(),
        ModeEndCause::NoModeProblem => "cannot be solved".to_owned(),
        _ => return None,
    })
}

/// Intervals without a solution, without a mode problem, and those that are not proven.
fn zones(
    counts: &[CountLimits],
    without: &[RangeWithoutProblem],
    [first, last]: [f64; 2],
    scale: f64,
) -> Vec<Zone> {
    let locked = counts.iter().filter(|count| count.is_empty() && count.known != Known::Undecided);
    let zone = |[from, to]: [f64; 2], hatching: Hatching, meaning: &str| Zone {
        from: from / scale,
        to: to / scale,
        hatching,
        meaning: meaning.to_owned(),
    };
    let locked = locked.map(|count| zone([count.from, count.to], Hatching::Rising, "excluded: no solution"));
    let without = without.iter().map(|range| {
        zone([range.from, range.to], Hatching::Falling, "excluded: cannot be assembled or solved")
    });
    let open = counts.iter().flat_map(|count| {
        unproven(count).into_iter().map(|range| match count.known {
            Known::Undecided => zone(range, Hatching::Dotted, "number of solutions not decided"),
            _ => zone(range, Hatching::Dotted, "number of solutions sampled, not proven"),
        })
    });
    // Single values are marked, not hatched.
    let wide = |zone: &Zone| (zone.to - zone.from) * scale > TOGETHER * (last - first);
    locked.chain(without).chain(open).filter(wide).collect()
}

/// Returns the parts of an interval that were only sampled, or are not decided.
fn unproven(count: &CountLimits) -> Vec<[f64; 2]> {
    if matches!(count.known, Known::Proven | Known::ClosedForm) {
        return Vec::new();
    }
    let ends = count.proven.iter().flatten().copied();
    let ends: Vec<f64> = std::iter::once(count.from).chain(ends).chain([count.to]).collect();
    ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}
