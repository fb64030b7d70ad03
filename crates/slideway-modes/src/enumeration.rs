//! Every pattern, solved by itself: what tests compare with.

use crate::findings::{Findings, TooManySolutions};
use crate::problem::{ContactState, ModeProblem, ScaledProblem, advance};
use crate::solutions::{Limits, Solutions};

/// A problem too large for the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EnumerationError {
    /// More contacts than the limit.
    #[error("{contacts} contacts, but the limit for trying all patterns is {limit}")]
    TooManyContacts {
        /// Contacts of the problem.
        contacts: usize,
        /// [`Limits::contacts`], or 63 if that is less.
        limit: usize,
    },
    /// More patterns than the limit, because of contacts with a jump.
    #[error(
        "{patterns} patterns of {contacts} contacts, {with_jump} of them with preload gaps, but the limit is {limit}"
    )]
    TooManyPatterns {
        /// Contacts of the problem.
        contacts: usize,
        /// Contacts at which the right-hand side jumps.
        with_jump: usize,
        /// `2^(r-j) 3^j`.
        patterns: u64,
        /// [`Limits::patterns`].
        limit: u64,
    },
    /// More solutions than the limit.
    #[error("more than {limit} patterns give a solution")]
    TooManySolutions {
        /// [`Limits::solutions`].
        limit: usize,
    },
}

impl From<TooManySolutions> for EnumerationError {
    fn from(TooManySolutions { limit }: TooManySolutions) -> Self {
        Self::TooManySolutions { limit }
    }
}

/// All solutions of a mode problem, and the outcome of every pattern.
///
/// Tries every `sigma` of `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0` (Klepp
/// (2002), eqs. (6) and (8)) and, for contacts at which the right-hand side jumps, the states
/// between their faces. Each is solved by a factorization of its own: [`search`](crate::search) takes less time. Forces in the result have the unit of `N(0)`. The module's documentation
/// states tolerances.
///
/// # Errors
/// [`EnumerationError`] if the problem is larger than `limits`.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::{enumerate, Limits, ModeProblem};
/// // w = M z + q with the solutions z = (0, 0), (1, 0), (0, 1) and (1, 1).
/// let m = dmatrix![-1.0, 0.0; 0.0, -1.0];
/// let problem = ModeProblem::from_linear_complementarity(&m, dvector![1.0, 1.0])?;
/// let solutions = enumerate(&problem, &Limits::default())?;
/// assert_eq!(solutions.counts.total(), 4);
/// assert_eq!(solutions.solutions.len(), 4);
/// assert_eq!(solutions.solutions[1].normal_force, dvector![1.0, -1.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn enumerate(problem: &ModeProblem, limits: &Limits) -> Result<Solutions, EnumerationError> {
    let contacts = problem.contacts();
    // Patterns are held in the bits of a u64.
    let limit = limits.contacts.min(63);
    if contacts > limit {
        return Err(EnumerationError::TooManyContacts { contacts, limit });
    }
    let scaled = ScaledProblem::new(problem);
    let (_, patterns) = scaled.patterns_from(0);
    if patterns > limits.patterns {
        let with_jump = scaled.has_jump.iter().filter(|&&jump| jump).count();
        let limit = limits.patterns;
        return Err(EnumerationError::TooManyPatterns { contacts, with_jump, patterns, limit });
    }
    let mut findings = Findings::new(&scaled, limits);
    let mut pattern = vec![ContactState::Positive; contacts];
    loop {
        findings.examine_leaf(&pattern, &mut || true)?;
        if !advance(&mut pattern, |contact| scaled.states(contact)) {
            break;
        }
    }
    // Only where there is none, the patterns closest to locking are reported.
    let mut more = !findings.has_solutions();
    while more {
        findings.offer_if_regular(&pattern);
        more = advance(&mut pattern, |_| &ContactState::PRESSED);
    }
    Ok(findings.into_solutions())
}
