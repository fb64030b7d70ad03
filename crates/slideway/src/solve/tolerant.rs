//! All states of a mode problem in floating point: nothing is proven, and much less time is needed.

use crate::kinetics::Accuracy;
use crate::modes::screen::{MOST_CONTACTS, Screen, SmallProblem, SmallState};
use crate::modes::{
    Completeness, ContactState, ModeProblem, OpenContacts, SearchOptions, StateLists, search,
};
use crate::progress::Callback;
use nalgebra::DVector;

/// All states of a mode problem within the tolerances of [`modes`](crate::modes).
pub(crate) struct StatesWithinTolerances {
    /// Solutions, and states with preloaded contacts between their faces.
    pub(crate) states: Vec<StateWithinTolerances>,
    /// Whether there are infinitely many besides.
    pub(crate) continuum: bool,
    /// True if rounding may hide a state: a pattern is too near to a boundary for elimination, or there are too many contacts
    /// for it, so that no distance from boundaries is known.
    pub(crate) in_doubt: bool,
}

/// One of these states.
pub(crate) struct StateWithinTolerances {
    pub(crate) sides: Vec<ContactState>,
    /// The normal forces.
    pub(crate) force: DVector<f64>,
    /// Contacts on the boundary of their pattern.
    pub(crate) zero: Vec<usize>,
    /// The shares of the contacts between their faces.
    pub(crate) shares: Vec<Option<f64>>,
}

impl StatesWithinTolerances {
    /// By elimination; where that leaves a pattern in doubt, and for many contacts, by a search. Returns `None` if the
    /// search did not come to its end.
    pub(crate) fn of(
        problem: &ModeProblem,
        open: &OpenContacts,
        callback: &mut Callback<'_>,
    ) -> Option<Self> {
        let contacts = problem.contacts();
        let by_elimination = screened(problem, open, Accuracy { part: 0.0, of_load: 0.0 }, |states| {
            states.iter().map(|state| StateWithinTolerances::of_small(state, contacts)).collect()
        });
        if let Some(states) = by_elimination {
            return Some(Self { states, continuum: false, in_doubt: false });
        }
        let options = SearchOptions { certify: false, ..SearchOptions::default() };
        let result = search(problem, &options, callback);
        let limits = options.limits;
        let lists = result.lists(limits.solutions, limits.listed);
        let is_whole = lists.all_listed && !matches!(result.completeness, Completeness::Partial(_));
        is_whole.then(|| Self::of_lists(&lists, contacts))
    }

    fn of_lists(lists: &StateLists, contacts: usize) -> Self {
        let pressed = lists.solutions.iter().map(|solution| StateWithinTolerances {
            sides: solution.pattern.iter().map(|&side| side.into()).collect(),
            force: solution.normal_force.clone(),
            zero: solution.on_boundary.clone(),
            shares: vec![None; contacts],
        });
        let between = lists.gaps.iter().map(|gap| {
            let mut shares = vec![None; contacts];
            gap.shares.iter().for_each(|share| shares[share.contact] = Some(share.lambda));
            StateWithinTolerances {
                sides: gap.pattern.clone(),
                force: gap.normal_force.clone(),
                zero: gap.on_boundary.clone(),
                shares,
            }
        });
        let states = pressed.chain(between).collect();
        let continuum = lists.singular.iter().any(|mode| mode.set.is_continuum());
        Self { states, continuum, in_doubt: true }
    }
}

impl StateWithinTolerances {
    fn of_small(state: &SmallState, contacts: usize) -> Self {
        let sides = state.pattern[..contacts].to_vec();
        let share = |k: usize| (sides[k] == ContactState::Gap).then_some(state.unknowns[k]);
        let shares = (0..contacts).map(share).collect();
        let force = DVector::from_fn(contacts, |k, _| state.normal_force(k));
        Self { sides, force, zero: Vec::new(), shares }
    }
}

/// What `take` makes of the states that elimination finds. Returns `None` if it leaves a pattern in doubt, or if there
/// are too many contacts.
pub(super) fn screened<T>(
    problem: &ModeProblem,
    open: &OpenContacts,
    accuracy: Accuracy,
    take: impl FnOnce(&[SmallState]) -> T,
) -> Option<T> {
    let contacts = problem.contacts();
    if contacts > MOST_CONTACTS {
        return None;
    }
    let mut small = SmallProblem::new(contacts);
    small.copy(problem);
    small.load = accuracy.of_load;
    Screen::new(contacts).with_open(open.clone()).states(&small, accuracy.part).ok().map(take)
}
