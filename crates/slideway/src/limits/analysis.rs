//! Analysis of limits: the varied quantity, its range, and what is found there.

use super::answer::{self, Along, Naming};
use super::find::find;
use super::found::ModesFound;
use super::options::LimitsOptions;
use super::report::LimitsReport;
use super::speeds::speeds;
use super::varied::Varied;
use super::vary::range_around;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::modes::existence::CountInterval;
use crate::progress::Work;
use crate::report::Tipping;
use crate::solve::{Stages, guided};

/// What is varied, over which range, and the modes of both directions.
pub(super) struct Analysis {
    pub(super) varied: Varied,
    pub(super) range: [f64; 2],
    pub(super) found: ModesFound,
    pub(super) reversed: Option<(Varied, ModesFound)>,
    /// Speeds and tipping along the modes.
    along: Along,
    /// Speeds and tipping along the modes of the opposite direction.
    opposite: Option<Along>,
}

impl Analysis {
    pub(super) fn new(model: &Model, options: &LimitsOptions, work: Work<'_>) -> Result<Self, Faults> {
        if options.max_reaction.is_some() {
            let mechanism = Mechanism::new(model)?;
            mechanism.check_no_press_fit("a greatest reaction")?;
            mechanism.check_no_one_sided("a greatest reaction")?;
        }
        let vary = &options.vary;
        let varied = vary.of(model)?;
        let range = vary.ends(&varied, || range_around(model, &varied))?;
        if options.max_reaction.is_some() {
            varied.check_none_stands(f64::midpoint(range[0], range[1]), "a greatest reaction")?;
        }
        let directions = 1 + usize::from(options.both_directions);
        let (modes, along) = (work.part(0, 2), work.part(1, 2));
        let find = |varied: &Varied, part: usize| {
            let work = modes.part(part, directions);
            find(varied, range, options.max_reaction, options.effort, work)
        };
        let found = find(&varied, 0)?;
        if found.counts.is_empty() {
            // Nowhere an answer: the faults in the middle say why.
            let middle = f64::midpoint(range[0], range[1]);
            match &*varied.rough_circles(range) {
                [] => drop(varied.at(middle, Stages::parts)?),
                circles => drop(varied.block_instance(middle, circles)?),
            }
        }
        let reversed = if options.both_directions {
            let varied = vary.of(&model.reversed())?;
            let found = find(&varied, 1)?;
            Some((varied, found))
        } else {
            None
        };
        let asked = |varied: &Varied, found: &ModesFound, part: usize| {
            let work = along.part(part, directions);
            Along { speeds: speeds(varied, found, work), tipping: tipping(varied, found, work) }
        };
        let along = asked(&varied, &found, 0);
        let opposite = reversed.as_ref().map(|(varied, found)| asked(varied, found, 1));
        Ok(Self { varied, range, found, reversed, along, opposite })
    }

    pub(super) fn report(&self, naming: &Naming) -> LimitsReport {
        let reversed = self.reversed.as_ref().map(|(_, found)| found).zip(self.opposite.as_ref());
        answer::report(naming, &self.varied, self.range, (&self.found, &self.along), reversed)
    }
}

/// Of each range without a solution what tips at three values within it, and where modes end beside it.
fn tipping(varied: &Varied, found: &ModesFound, work: Work<'_>) -> Vec<Option<Tipping>> {
    let at = |value: f64| -> Vec<String> {
        let report = varied.solved(value, work);
        report.ok().and_then(|report| report.tipping()).map_or_else(Vec::new, |tipping| tipping.joints)
    };
    let beside = |count: &CountInterval| -> Vec<Vec<String>> {
        let Ok(mechanism) = varied.mechanism(count.from) else { return Vec::new() };
        let same = |end: f64, other: f64| found.same_ends.are_one(other, end);
        guided(&found.existence, &mechanism, [count.from, count.to], same)
    };
    let within = |count: &CountInterval| {
        if !count.is_empty() || !varied.model().has_guided_sliders() {
            return None;
        }
        let places = [0.125, 0.5, 0.875].map(|share| count.from + share * (count.to - count.from));
        let within = places.into_iter().filter(|_| !work.is_over()).map(at);
        Tipping::of(within.chain(beside(count)))
    };
    found.counts.iter().map(within).collect()
}
