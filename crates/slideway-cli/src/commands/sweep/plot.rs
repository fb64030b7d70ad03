//! The plot beside the table of a sweep.

use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::Picture;
use crate::watch::Watch;
use slideway::model::Settings;
use slideway::progress::Progress;
use slideway::sweep::{Rows, Sweep, SweepState};
use slideway_pictures::plot::{Extract, Extractor, SamplesPart, SamplesPlot, SweepPlot, to_svg};
use slideway_pictures::theme::Theme;
use slideway_tables::RowSource;
use std::ops::ControlFlow;

/// A plot beside the table.
pub(super) struct Plotting {
    pub(super) plot: Plotted,
    pub(super) taker: Taker,
    title: Option<String>,
    settings: Settings,
    theme: &'static Theme,
    picture: Picture,
    file: Output,
}

/// The plot of a sweep, to which its rows are added.
pub(super) enum Plotted {
    /// Curves over one quantity.
    Line(Box<SweepPlot>),
    /// Histograms of samples.
    Samples(SamplesPlot),
}

/// Takes of rows what is plotted; to be used in parallel.
#[derive(Clone)]
pub(super) enum Taker {
    Line(Extractor),
    Samples(SamplesPlot),
}

/// The extract of some rows that a plot needs.
pub(super) enum Taken {
    Line(Extract),
    Samples(SamplesPart),
}

impl Taker {
    pub(super) fn rows(&self, rows: &Rows) -> Taken {
        match self {
            Self::Line(extractor) => Taken::Line(extractor.rows(rows)),
            Self::Samples(plot) => Taken::Samples(plot.rows(rows)),
        }
    }
}

impl Plotted {
    pub(super) fn add(&mut self, taken: Taken) {
        match (self, taken) {
            (Self::Line(plot), Taken::Line(extract)) => plot.add(extract),
            (Self::Samples(plot), Taken::Samples(part)) => plot.add(&part),
            _ => unreachable!("what is taken is of the kind of the plot"),
        }
    }
}

impl Plotting {
    pub(super) fn new(
        sweep: &Sweep,
        arguments: &SweepArguments,
        (picture, file): (Picture, Output),
        (title, settings): (Option<&str>, &Settings),
    ) -> Result<Self, Failure> {
        if sweep.line().is_none() && sweep.has_branches() {
            return Err(Failure::NoLine);
        }
        let quantity = arguments.quantity;
        let (plot, taker) = if sweep.has_branches() {
            let plot = SweepPlot::new(sweep, quantity).ok_or(Failure::NothingToPlot)?;
            let taker = Taker::Line(plot.extractor());
            (Plotted::Line(Box::new(plot)), taker)
        } else {
            let plot = SamplesPlot::new(sweep, quantity).ok_or(Failure::NothingToPlot)?;
            (Plotted::Samples(plot.clone()), Taker::Samples(plot))
        };
        let theme = arguments.plot.theme.colours();
        let (title, settings) = (title.map(str::to_owned), settings.clone());
        Ok(Self { plot, taker, title, settings, theme, picture, file })
    }

    /// Computes again what an interrupted run has done: the table does not hold all that a plot needs. Where
    /// the time is up before, it is up for the table, too.
    ///
    /// # Errors
    /// If a shard cannot be read.
    pub(super) fn repeat(
        &mut self,
        source: RowSource<'_>,
        done: u64,
        watch: &mut Watch,
    ) -> Result<(), Failure> {
        if done == 0 {
            return Ok(());
        }
        let Self { plot, taker, .. } = self;
        let sweep = source.sweep();
        let mut state = sweep.start();
        let alarm = watch.alarm();
        source.run_while(
            &|| !alarm.rings(),
            &mut state,
            &|rows| (rows.heads.first().map(|head| head.point), taker.rows(rows)),
            &mut |parts, state| {
                let wanted = parts.into_iter().filter(|(first, _)| first.is_some_and(|first| first < done));
                wanted.for_each(|(_, part)| plot.add(part));
                let flow = watch.look(&Progress::of("points", state.done, sweep.points()));
                if state.done < done { flow } else { ControlFlow::Break(()) }
            },
        )?;
        Ok(())
    }

    pub(super) fn write(mut self, state: &SweepState) -> Result<(), Failure> {
        let title = self.title.as_deref();
        let figure = match &mut self.plot {
            Plotted::Line(plot) => {
                plot.set_branches(state.branches());
                plot.figure(title)
            }
            Plotted::Samples(plot) => plot.figure(title, state),
        };
        let figure = figure.changed_by(&self.settings);
        self.picture.write(to_svg(&figure, self.theme), &self.file)
    }
}
