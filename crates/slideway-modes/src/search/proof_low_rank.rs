//! Proofs for coupling through few quantities `z`: half-spaces that bound all unknowns, and trees within them.
//!
//! # Why a tree alone does not suffice
//! With `z` as coordinates, the patterns of a tree are cells of a hyperplane arrangement ([`low_rank`](super::low_rank)),
//! of which there are few. But a vector that excludes a cell has the product zero with the columns of all contacts that are
//! still open only up to the remainder `E`, some `10^-16`, and nothing bounds their unknowns. So let
//!
//! ```text
//! T = sum_k w_k (y_k^+ + y_k^-),   w_k <= |delta_k| / d
//! ```
//!
//! Where `T <= Gamma`, a small multiple of this half-space makes the products of all columns negative.
//! Where `T >= Gamma`, and `T <= M |z_j|` for some `j`, the same is done with a multiple less of `T >= Gamma`: far away
//! loads hardly matter, so that a vector can be found that depends on it.
//!
//! # What is left
//! `T >= Gamma` and `T >= M |z_j|` for all `j`. Some contact has at least the mean share, `2 n w_k y_k >= T`, and
//!
//! ```text
//! d T / 2n <= |delta_k| y_k <= |b_k| + sum_j |u_kj| |z_j| + ... <= |b_k| + max_i sum_j |u_ij| T / M
//! ```
//!
//! which is wrong on both of its sides if `M = 8 n max_i sum_j |u_ij| / d` and `Gamma` is as many times the load. Contact
//! after contact, the half-space of its share is split off, with one vector for each of its sides. That all shares
//! are too small contradicts their sum.
//!
//! Forms are rounded to integers: nothing depends on how well they represent `z`.

use dashu_int::IBig;
use nalgebra::DVector;

use super::group::CELLS_FROM;
use super::leaf::Leaves;
use super::load::{Load, LoadedProblem};
use super::low_rank::LowRank;
use super::monitor::Monitor;
use super::proof_log::ProofLog;
use super::relaxation::load_error;
use super::report::SearchOptions;
use super::states::{StateSet, all_states};
use super::tree::{Tree, TreeReport};
use crate::problem::{
    ContactState, ModeProblem, ProblemView, ScaledProblem, exponent_of, power_of_two_above,
};

/// `Gamma` is so many times as far as the half-spaces of shares ask for: there, loads hardly matter. Numbers grow by as
/// much; with 64, far trees meet the near hyperplanes, and with 10^6, vectors have too many digits.
const FAR: f64 = 4096.0;
/// Powers of two beyond this belong to problems of such different sizes that no short numbers help.
const LARGEST: f64 = (1_u64 << 40) as f64;

/// A half-space `sum_j a_j y_j <= limit`, as the combination of forms that the file states.
#[derive(Clone)]
struct HalfSpace {
    form: DVector<f64>,
    limit: f64,
    weights: Vec<f64>,
}

/// The forms and half-spaces of a problem.
pub(super) struct HalfSpaces {
    /// `T`, then `z` times twice `M`, rounded, and the terms of `T` that belong to each contact.
    forms: Vec<DVector<f64>>,
    /// `T <= Gamma`.
    near: HalfSpace,
    /// `T <= M z_j` and `T <= -M z_j`.
    along: Vec<HalfSpace>,
    /// `T <= 2 n w_k (y_k^+ + y_k^-)`.
    shares: Vec<HalfSpace>,
    /// The largest coefficients of all of them are just below 2 to this power.
    pub(super) exponent: i32,
}

impl HalfSpaces {
    /// Those for a problem with so many contacts, and coupling of so low a rank, that they help; `None` if not, or if
    /// numbers are too different in size.
    pub(super) fn of(scaled: &ScaledProblem, load_radius: &DVector<f64>) -> Option<Self> {
        if scaled.contacts() < CELLS_FROM {
            return None;
        }
        let low_rank = LowRank::of(scaled, &load_error(scaled, load_radius))?;
        let Scales { weights, steep, far } = Scales::of(&low_rank, scaled)?;
        let (contacts, rank) = (scaled.contacts(), low_rank.rank());
        let form = |entry: &dyn Fn(usize, usize) -> f64| {
            DVector::from_fn(2 * contacts, |column, _| entry(column / contacts, column % contacts))
        };
        let mut forms = vec![form(&|_, k| weights[k])];
        forms
            .extend((0..rank).map(|j| form(&|side, k| (2.0 * steep * low_rank.right[side][(j, k)]).round())));
        forms.extend((0..contacts).map(|own| form(&|_, k| if k == own { weights[k] } else { 0.0 })));
        let along = |j: usize| [-1.0, 1.0].map(|sign| HalfSpace::new(&forms, &[(0, 2.0), (j, sign)], 0.0));
        let least = -2.0 * contacts as f64;
        let share = |k: usize| HalfSpace::new(&forms, &[(0, 1.0), (1 + rank + k, least)], 0.0);
        let mut found = Self {
            near: HalfSpace::new(&forms, &[(0, 1.0)], far),
            along: (1..=rank).flat_map(along).collect(),
            shares: (0..contacts).map(share).collect(),
            forms,
            exponent: 0,
        };
        found.equalize();
        Some(found)
    }

    /// Multiplies all half-spaces by powers of two, so that limits are integers and the rows have the same size.
    fn equalize(&mut self) {
        let size = |half_space: &HalfSpace| power_of_two_above(half_space.form.amax());
        let largest = self.all().map(|half_space| size(half_space)).fold(1.0, f64::max);
        let whole = largest * (size(&self.near) / (largest * self.near.limit)).max(1.0);
        for half_space in self.all() {
            let factor = whole / size(half_space);
            half_space.form *= factor;
            half_space.limit *= factor;
            half_space.weights.iter_mut().for_each(|weight| *weight *= factor);
        }
        self.exponent = exponent_of(whole);
    }

    fn all(&mut self) -> impl Iterator<Item = &mut HalfSpace> {
        std::iter::once(&mut self.near).chain(&mut self.along).chain(&mut self.shares)
    }
}

/// The sizes that the half-spaces of a problem need.
struct Scales {
    /// `w`.
    weights: DVector<f64>,
    /// `M`.
    steep: f64,
    /// `Gamma`.
    far: f64,
}

impl Scales {
    /// Powers of two; `None` if they are too different.
    fn of(low_rank: &LowRank, scaled: &ScaledProblem) -> Option<Self> {
        let least = low_rank.diagonal[0].abs().inf(&low_rank.diagonal[1].abs());
        let sizes = least.map(|size| 0.5 * power_of_two_above(size));
        let (unit, load_unit) = (sizes.min(), scaled.load_unit);
        let shares = 8.0 * scaled.contacts() as f64 / unit;
        let steep = power_of_two_above(shares * low_rank.left.abs().column_sum().amax());
        let far = power_of_two_above(FAR * shares * low_rank.load.amax());
        let weights = sizes / unit;
        let all = [steep, weights.max(), far, load_unit, load_unit.recip()];
        let fits = all.iter().all(|&size| size <= LARGEST);
        fits.then_some(Self { weights, steep, far: far * load_unit })
    }
}

impl HalfSpace {
    /// `sum weight_i form_i <= limit`.
    fn new(forms: &[DVector<f64>], terms: &[(usize, f64)], limit: f64) -> Self {
        let last = terms.iter().map(|(at, _)| *at).max().unwrap_or(0);
        let (mut form, mut weights) = (DVector::zeros(forms[0].len()), vec![0.0; last + 1]);
        for &(at, weight) in terms {
            form += weight * &forms[at];
            weights[at] = weight;
        }
        Self { form, limit, weights }
    }

    /// The other side of the split.
    fn opposite(&self) -> Self {
        Self { form: -&self.form, limit: -self.limit, weights: self.weights.clone() }
    }

    fn split(&self, log: &mut ProofLog) {
        let weights: Vec<IBig> = self.weights.iter().map(|&weight| integer(weight)).collect();
        log.split(&integer(self.limit), &weights);
    }
}

/// A proof by half-spaces while it is written.
pub(super) struct Parts<'p, 'l, 'm, 'c> {
    pub(super) problem: &'p ModeProblem,
    pub(super) options: &'p SearchOptions,
    pub(super) leaves: &'m mut Leaves<'l>,
    pub(super) monitor: &'m mut Monitor<'c>,
    pub(super) report: TreeReport,
    /// The half-spaces of the present node.
    path: Vec<HalfSpace>,
}

impl<'p, 'l, 'm, 'c> Parts<'p, 'l, 'm, 'c> {
    pub(super) fn new(
        (problem, options): (&'p ModeProblem, &'p SearchOptions),
        leaves: &'m mut Leaves<'l>,
        monitor: &'m mut Monitor<'c>,
    ) -> Self {
        Self { problem, options, leaves, monitor, report: TreeReport::default(), path: Vec::new() }
    }

    /// Writes the whole proof; `None` if the monitor stopped it.
    pub(super) fn prove(&mut self, spaces: &HalfSpaces, mut log: ProofLog) -> Option<ProofLog> {
        for form in &spaces.forms {
            log.form(&form.iter().map(|&entry| integer(entry)).collect::<Vec<_>>());
        }
        log = self.split(&spaces.near, log, |parts, log| parts.tree(&[0], None, log))?;
        for half_space in &spaces.along {
            log = self.split(half_space, log, |parts, log| {
                let last = parts.path.len() - 1;
                parts.tree(&[0, last], None, log)
            })?;
        }
        let mut used: Vec<usize> = (0..self.path.len()).collect();
        for (contact, half_space) in spaces.shares.iter().enumerate() {
            log = self.split(half_space, log, |parts, mut log| {
                used.push(parts.path.len() - 1);
                log.branch(contact, &ContactState::PRESSED);
                for state in ContactState::PRESSED {
                    log = parts.tree(&used, Some((contact, state)), log)?;
                }
                used.pop();
                Some(log)
            })?;
        }
        log.exclude_within(&self.sum_of_shares());
        Some(log)
    }

    /// Divides the node; `first` proves the part within the half-space, and the node becomes the other part.
    fn split(
        &mut self,
        half_space: &HalfSpace,
        mut log: ProofLog,
        first: impl FnOnce(&mut Self, ProofLog) -> Option<ProofLog>,
    ) -> Option<ProofLog> {
        half_space.split(&mut log);
        self.report.nodes += 1;
        self.path.push(half_space.clone());
        let log = first(self, log)?;
        self.path.pop();
        self.path.push(half_space.opposite());
        Some(log)
    }

    /// A tree within some of the half-spaces of the node, perhaps with one contact decided.
    fn tree(
        &mut self,
        used: &[usize],
        decided: Option<(usize, ContactState)>,
        mut log: ProofLog,
    ) -> Option<ProofLog> {
        let half_spaces: Vec<(DVector<f64>, f64)> =
            used.iter().map(|&at| (self.path[at].form.clone(), self.path[at].limit)).collect();
        let problem = self.problem.within_half_spaces(&half_spaces);
        let (view, contacts) = (ProblemView::from(&problem), (0..problem.contacts()).collect::<Vec<_>>());
        let load = Load::of(view);
        let loaded = LoadedProblem::restricted(view, &contacts, &load);
        let scaled = ScaledProblem::within(loaded.view());
        let radius = scaled.scaled_load_radius(&loaded.right_hand_side_radius());
        let mut states = all_states(&scaled);
        states[self.problem.contacts()..].fill(StateSet::only(ContactState::Positive));
        if let Some((contact, state)) = decided {
            states[contact] = StateSet::only(state);
        }
        log.enter(used.to_vec());
        let tree = Tree::within_half_spaces((&loaded, &scaled), used.len(), &radius, self.options);
        let (report, log) = tree.logged(log).run_from(states, (self.leaves, self.monitor));
        self.report.add(report);
        log.filter(|_| self.monitor.stopped().is_none())
    }

    /// The vector which excludes that `T >= Gamma` and no contact has the mean share: minus the sum of all of these.
    fn sum_of_shares(&self) -> Vec<IBig> {
        let contacts = self.problem.contacts();
        let most = self.path.iter().map(|half_space| half_space.weights[0].abs()).fold(0.0, f64::max);
        let entry = |(at, half_space): (usize, &HalfSpace)| match at.checked_sub(self.path.len() - contacts) {
            Some(_) => -most / half_space.weights[0],
            None if at == 0 => -(contacts as f64) * most / half_space.weights[0],
            None => 0.0,
        };
        let entries = self.path.iter().enumerate().map(entry);
        std::iter::repeat_n(0.0, contacts).chain(entries).map(integer).collect()
    }
}

fn integer(value: f64) -> IBig {
    IBig::try_from(value).unwrap_or_default()
}
