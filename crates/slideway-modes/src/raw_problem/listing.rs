//! Selects which combinations of the groups' states are listed, and counts those of each sort: those that are not
//! part of a larger continuum.

use crate::problem::ContactState;
use crate::search::{BigCount, CombinedState, GroupState, SolutionProduct};

/// The sort of a combination of the groups' states.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sort {
    #[default]
    Point,
    Gap,
    Continuum,
}

impl Sort {
    fn of_part(state: &GroupState) -> Self {
        match state {
            GroupState::Singular(mode) if mode.set.is_continuum() => Self::Continuum,
            // Raw problems are exact, so every pattern is decided.
            GroupState::Undecided(_) => Self::Continuum,
            GroupState::Gap(_) => Self::Gap,
            GroupState::Singular(mode) if mode.pattern.contains(&ContactState::Gap) => Self::Gap,
            GroupState::Solution(_) | GroupState::Singular(_) => Self::Point,
        }
    }

    /// The sort of a combination: the greatest sort of its parts.
    pub(super) fn of(state: &CombinedState<'_>) -> Self {
        state.parts.iter().map(|(_, part)| Self::of_part(part)).max().unwrap_or(Self::Point)
    }
}

/// Numbers of combinations.
pub(super) struct Counts {
    pub(super) points: BigCount,
    pub(super) gaps: BigCount,
    pub(super) continua: BigCount,
}

impl Counts {
    /// Counts for a product.
    pub(super) fn of(product: &SolutionProduct) -> Self {
        let [points, with_gaps, all] = cumulated(product);
        Self { gaps: with_gaps.minus(&points), continua: all.minus(&with_gaps), points }
    }

    /// How many combinations of a sort to list.
    fn wanted(&self, sort: Sort, most: usize) -> usize {
        let count = match sort {
            Sort::Point => &self.points,
            Sort::Gap => &self.gaps,
            Sort::Continuum => &self.continua,
        };
        count.to_u64().and_then(|count| usize::try_from(count).ok()).map_or(most, |count| count.min(most))
    }
}

/// Cumulative numbers of combinations: points; with gap states; with continua.
fn cumulated(product: &SolutionProduct) -> [BigCount; 3] {
    let mut total = [1, 1, 1].map(BigCount::from);
    for factor in &product.factors {
        let mut sums = <[BigCount; 3]>::default();
        for alternative in factor.alternatives.iter().filter(|one| one.state.is_maximal()) {
            let dependents = cumulated(&alternative.dependents);
            for sort in Sort::of_part(&alternative.state) as usize..3 {
                sums[sort] = sums[sort].plus(&dependents[sort]);
            }
        }
        total = [0, 1, 2].map(|sort| total[sort].times(&sums[sort]));
    }
    total
}

/// Calls `take` with each combination of a sort, `most` at most, given how many there are.
pub(super) fn list(
    product: &SolutionProduct,
    (counts, sort): (&Counts, Sort),
    most: usize,
    take: &mut dyn FnMut(&CombinedState<'_>),
) {
    let wanted = counts.wanted(sort, most);
    if wanted > 0 {
        // Those of this sort come first, so that none has to be found among many others.
        let mut product = product.clone();
        product.restrict(sort, &|state| state.is_maximal().then(|| Sort::of_part(state)));
        let states = product.states().filter(|state| Sort::of(state) == sort);
        states.take(wanted).for_each(|state| take(&state));
    }
}
