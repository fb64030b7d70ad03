//! The figure of a design: the margin over what is varied.

use super::figure::{Axis, Band, Branch, Curve, End, Figure, MarkedPoint, MarkedValue, Panel, PointKind};
use super::figure::{Hatching, Stroke, Zone, headline};
use super::limits::in_words;
use super::scale::{extent, range_that_shows};
use slideway::report::precise;
use slideway::size::{MarginKind, MetEnd, Sample, SampleKind, SizeReport};

/// Margins are shown up to so many times the wanted one, or that of the model.
const SHOWN: f64 = 2.0;

/// The figure of a [`SizeReport`]: the margin at all values that were tried, the wanted one, where it is met,
/// and the model.
pub fn size_figure(report: &SizeReport) -> Figure {
    let shown_in = &report.vary.shown_in;
    let scale = shown_in.scale();
    let limit = &report.limit_shown_in;
    let told = Told::of(report.against);
    let wanted = format!("{}: {}", told.wanted, limit.precise(report.margin));
    let branches = vec![
        Branch { name: told.branch.to_owned(), colour: 0, stroke: Stroke::Solid },
        Branch { name: wanted, colour: 1, stroke: Stroke::Dashed },
    ];
    let range = [report.vary.from / scale, report.vary.to / scale];
    let mut curves = margins(report, scale);
    let wanted = range.map(|at| [at, report.margin / limit.scale()]).to_vec();
    curves.push(Curve { branch: 1, quantity: 0, points: wanted, ends: [End::Plain; 2] });
    let model = report.present.margin.map(|margin| MarkedPoint {
        at: [report.present.at / scale, margin / limit.scale()],
        kind: PointKind::Model,
        part: None,
    });
    let met = report.met.iter().map(|met| Band {
        from: met.from / scale,
        to: met.to / scale,
        colour: 2,
        meaning: told.met.to_owned(),
    });
    let without = report.without_position.iter().map(|range| Zone {
        from: range.from / scale,
        to: range.to / scale,
        hatching: Hatching::Falling,
        meaning: "excluded: cannot be assembled or solved".to_owned(),
    });
    let panel = Panel {
        x: Axis {
            name: report.vary.name.clone(),
            unit: shown_in.name().to_owned(),
            range: Some(range),
            logarithmic: false,
        },
        y: Axis {
            name: told.axis.to_owned(),
            unit: limit.name().to_owned(),
            range: range_of(report, &curves),
            ..Axis::default()
        },
        zones: without.chain(unsolved(report, scale)).collect(),
        marked: marked(report, scale),
        bands: met.collect(),
        points: model.into_iter().collect(),
        curves,
        ..Panel::default()
    };
    Figure {
        title: headline(
            report.title.as_deref(),
            &format!("{} over {}", told.what, in_words(&report.vary.name)),
        ),
        subtitle: match &report.load {
            Some(name) => format!("{}: {name}", told.of),
            None if report.both_directions => "The smaller of both directions of motion".to_owned(),
            None => String::new(),
        },
        panels: vec![panel],
        branches,
        quantities: vec![String::new()],
        one_legend: false,
    }
}

/// The words of a figure for the margin or limit that is sized.
struct Told {
    what: &'static str,
    branch: &'static str,
    axis: &'static str,
    wanted: &'static str,
    met: &'static str,
    /// The kind of thing whose name is in the report, such as a load.
    of: &'static str,
}

impl Told {
    fn of(against: MarginKind) -> Self {
        let margin = |what, of| Self {
            what,
            branch: "safety factor",
            axis: "safety factor",
            wanted: "wanted",
            met: "the wanted safety factor is reached",
            of,
        };
        let limit =
            |what, wanted, of| Self { what, branch: what, axis: what, wanted, met: "the limit is kept", of };
        match against {
            MarginKind::Locking => margin("safety factor against jamming", "Load"),
            MarginKind::SelfLocking => margin("safety factor against self-locking", "Load"),
            MarginKind::Hold => margin("safety factor of holding", "Load"),
            MarginKind::Effort => limit("greatest effort", "at most", "Drive"),
            MarginKind::NormalForce => limit("greatest normal force", "at most", "Contact"),
            MarginKind::Pressure => limit("greatest bearing pressure", "at most", "Contact"),
            MarginKind::Efficiency => limit("least efficiency", "at least", "Drive"),
        }
    }
}

/// The margin at values that follow one another, cut where it is infinite, has no value, or jumps.
fn margins(report: &SizeReport, scale: f64) -> Vec<Curve> {
    let jumps: Vec<f64> = (report.met.iter())
        .flat_map(|met| [(met.from, met.from_is), (met.to, met.to_is)])
        .filter(|(_, end)| *end == MetEnd::Jump)
        .map(|(at, _)| at)
        .collect();
    let together = |one: f64, other: f64| !jumps.iter().any(|jump| one <= *jump && *jump <= other);
    let runs = report.tried.chunk_by(|one, other| {
        one.is == SampleKind::Finite && other.is == SampleKind::Finite && together(one.at, other.at)
    });
    let curve = |points: Vec<[f64; 2]>| Curve { branch: 0, quantity: 0, points, ends: [End::Plain; 2] };
    let points = runs.map(|run| {
        let limit = report.limit_shown_in.scale();
        let finite = run.iter().filter_map(|sample| Some([sample.at / scale, sample.margin? / limit]));
        finite.collect::<Vec<[f64; 2]>>()
    });
    points.filter(|points| points.len() > 1).map(curve).collect()
}

/// Where values that were tried have no solution, or need friction.
fn unsolved(report: &SizeReport, scale: f64) -> Vec<Zone> {
    let meaning = |sample: &Sample| match sample.is {
        SampleKind::NoSolution => Some("excluded: no solution"),
        SampleKind::NeedsFriction => Some("excluded: it tips or jams with less friction"),
        _ => None,
    };
    let runs = report.tried.chunk_by(|one, other| meaning(one) == meaning(other));
    let zone = |run: &[Sample]| {
        let [first, .., last] = run else { return None };
        meaning(first).map(|meaning| Zone {
            from: first.at / scale,
            to: last.at / scale,
            hatching: Hatching::Rising,
            meaning: meaning.to_owned(),
        })
    };
    runs.filter_map(zone).collect()
}

/// Margins far beyond the wanted one are not shown.
fn range_of(report: &SizeReport, curves: &[Curve]) -> Option<[f64; 2]> {
    let all = extent(curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]))?;
    let greatest = SHOWN * report.margin.max(report.present.margin.unwrap_or_default());
    let greatest = greatest / report.limit_shown_in.scale();
    (all[1] > greatest).then(|| range_that_shows([0.0, greatest], all))
}

/// Where the wanted margin is just met, or jumps to.
fn marked(report: &SizeReport, scale: f64) -> Vec<MarkedValue> {
    let ends = report.met.iter().flat_map(|met| [(met.from, met.from_is), (met.to, met.to_is)]);
    let words = |end| match end {
        MetEnd::Margin => Some("just met"),
        MetEnd::Jump => Some("it jumps"),
        _ => None,
    };
    ends.filter_map(|(at, end)| {
        let number = precise(at / scale).replace('-', "\u{2212}");
        Some(MarkedValue { at: at / scale, label: format!("{number}: {}", words(end)?), asymptote: false })
    })
    .collect()
}
