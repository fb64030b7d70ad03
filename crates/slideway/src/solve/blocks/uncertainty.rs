//! Which solutions with friction in hinges exist for all values of parameters that are known within bounds only.

use super::super::SolveOptions;
use super::super::uncertainty::{Found, Presence, Searched};
use super::found::BlockAnswer;
use crate::enclosure::{
    EnclosedBlockProblem, Tipping, UncertainParameters, enclosed_block_problem, enclosed_while,
};
use crate::interval::{Interval, Real};
use crate::model::{Model, ParameterRange};
use crate::modes::blocks::{
    BlockProblem, BlockSolution, OnlySolution, only_solution, search_all_or_nothing, unique_for_every_load,
};
use crate::modes::{ContactState, Proof, SearchOptions};
use crate::progress::Callback;
use crate::report::Uncertainty;
use std::collections::BTreeMap;

/// Of a solution with more contacts than this that may be on either side its modes are not told.
const ON_BOUNDARY: usize = 6;

impl BlockAnswer<'_> {
    /// Which modes exist for all values within the ranges, for some, or perhaps.
    pub(super) fn uncertainty(
        &self,
        model: &Model,
        ranges: &[ParameterRange],
        options: &SolveOptions,
        progress: &mut Callback<'_>,
    ) -> Option<Uncertainty> {
        let state = (self.answer.mechanism, self.answer.configuration);
        self.answer.uncertainty_over(ranges, &mut |uncertain: &UncertainParameters| {
            let enclosed = enclosed_while(progress, |work| {
                enclosed_block_problem(model, uncertain, state, self.hinges, work)
            })
            .map_err(|reason| reason.to_string())?;
            presences(&enclosed, &located(&enclosed.problem, &options.search, progress)?)
        })
    }
}

/// Where a solution lies for all values of a box.
struct Located {
    states: Vec<ContactState>,
    /// Contacts that may be on either side.
    on_boundary: Vec<usize>,
    /// Bounds of the unknowns, row by row.
    enclosure: Vec<Interval>,
}

impl Located {
    fn of(solution: &BlockSolution) -> Self {
        let BlockSolution { states, on_boundary, enclosure, .. } = solution.clone();
        Self { states, on_boundary, enclosure }
    }

    fn only(problem: &BlockProblem, only: &OnlySolution) -> Self {
        let contacts = problem.contacts();
        let block = |row: usize| row.checked_sub(contacts).map_or(row, |row| contacts + row / 2);
        let rows = only.point.iter().enumerate();
        let enclosure: Vec<Interval> =
            rows.map(|(row, &at)| Interval::around(at, only.errors[block(row)])).collect();
        let state = |at: &f64| if *at < 0.0 { ContactState::Negative } else { ContactState::Positive };
        Self {
            states: only.point[..contacts].iter().map(state).collect(),
            on_boundary: (0..contacts).filter(|&k| enclosure[k].contains(0.0)).collect(),
            enclosure,
        }
    }
}

/// All solutions of a box. Where the norms prove that there is one, its distance from that in the middle is bounded even
/// if the bounds of the box are too wide for a search.
fn located(
    problem: &BlockProblem,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> Result<Vec<Located>, String> {
    let unique = unique_for_every_load(problem);
    if unique.is_some() {
        let at_once = SearchOptions { nodes: 1, ..*options };
        let result = search_all_or_nothing(problem, unique, &at_once, progress);
        if result.complete == Proof::Proven {
            return Ok(result.solutions.iter().map(Located::of).collect());
        }
        if let Some(only) = only_solution(problem, None) {
            return Ok(vec![Located::only(problem, &only)]);
        }
    }
    let result = search_all_or_nothing(problem, unique, options, progress);
    if result.stopped.is_some() {
        return Err("the search was not completed".to_owned());
    }
    if result.complete != Proof::Proven {
        return Err("not every solution could be told from its neighbours".to_owned());
    }
    Ok(result.solutions.iter().map(Located::of).collect())
}

/// The modes of a box, and how many solutions it has: one near a boundary is one, whichever of its modes it is in.
fn presences(enclosed: &EnclosedBlockProblem, solutions: &[Located]) -> Searched {
    let mut found = Found { modes: BTreeMap::new(), least: 0, most: 0 };
    for solution in solutions {
        if solution.on_boundary.len() > ON_BOUNDARY {
            return Err("too many contacts may be on either side".to_owned());
        }
        let (mut never_tips, mut may_stay) = (true, false);
        for mode in modes_of(solution) {
            let unknowns = unknowns(solution, &mode);
            let tipping = enclosed.outputs.tipping(&mode, &unknowns);
            never_tips &= tipping == Tipping::Never;
            if tipping == Tipping::Always {
                continue;
            }
            may_stay |= enclosed.open.is_solution(&mode);
            let certain = solution.on_boundary.is_empty() && tipping == Tipping::Never;
            let presence = Presence::one(certain, Some(unknowns));
            let all = match found.modes.remove(&mode) {
                Some(others) => presence.and(others),
                None => presence,
            };
            found.modes.insert(mode, all);
        }
        found.most += usize::from(may_stay);
        found.least += usize::from(may_stay && never_tips);
    }
    Ok(found)
}

/// The contact modes in which a solution may be.
fn modes_of(solution: &Located) -> Vec<Vec<ContactState>> {
    let mut modes = vec![solution.states.clone()];
    for &contact in &solution.on_boundary {
        let other = match solution.states[contact] {
            ContactState::Positive => ContactState::Negative,
            ContactState::Negative => ContactState::Positive,
            ContactState::Gap => continue,
        };
        let mut others = modes.clone();
        others.iter_mut().for_each(|mode| mode[contact] = other);
        modes.extend(others);
    }
    modes
}

/// Bounds of `|N_k|` in a mode, or of the shares of contacts in their gaps, then of `|R_j|`.
fn unknowns(solution: &Located, mode: &[ContactState]) -> Vec<Interval> {
    let (contacts, hinges) = solution.enclosure.split_at(mode.len());
    let of_contact = |(state, bounds): (&ContactState, &Interval)| match state {
        ContactState::Positive => Real::max(*bounds, Interval::ZERO),
        ContactState::Negative => Real::max(-*bounds, Interval::ZERO),
        ContactState::Gap => *bounds,
    };
    let (forces, _) = hinges.as_chunks();
    let lengths = forces.iter().map(|[x, y]| x.hypot(*y));
    mode.iter().zip(contacts).map(of_contact).chain(lengths).collect()
}
