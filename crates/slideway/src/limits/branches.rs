//! Where the solutions of mechanisms with friction in hinges exist: branches of a block problem.
//!
//! A contact mode may have several solutions then, which meet in folds. All solutions are found at evenly spaced
//! values and between those where their numbers differ, and every end is located to machine precision
//! ([`crate::modes::branches`]). Over the radius of the only friction circle all ends are in closed form.

use super::found::{Elsewhere, Gap, Method, ModesFound, SameEnds, cells_between};
use super::varied::Varied;
use crate::fault::{FaultKind, Faults};
use crate::mechanism::Mechanism;
use crate::modes::SearchOptions;
use crate::modes::branches::{Branch, BranchOptions, Branches, NoInstance, branches, over_radius};
use crate::modes::existence::{Existence, ExistenceOptions, ModeInterval, counts_in};
use crate::progress::Work;
use crate::scan::evenly;

/// Evenly spaced values at which all solutions are found.
const VALUES: usize = 100;
/// Steps towards a radius.
const STEPS: usize = 100;
/// The most nodes of the search at one value.
const NODES: u64 = 20_000;

/// The branches of a range, with friction in the hinges of these circles.
pub(super) fn scan(
    varied: &Varied,
    circles: &[usize],
    options: &ExistenceOptions,
    further: &[f64],
    work: Work<'_>,
) -> ModesFound {
    let family = |at: f64| varied.block_instance(at, circles).map_err(|faults| no_instance(&faults));
    let options = BranchOptions {
        range: options.range,
        values: VALUES,
        further: further.to_vec(),
        greatest_normal_force: options.greatest_normal_force,
        search: SearchOptions { nodes: NODES, ..SearchOptions::default() },
    };
    let found = branches(&family, &options, work);
    modes_found(varied, circles, &options, found, (Method::Bracketing, SameEnds::bisected(options.range)))
}

/// Finds the modes in closed form, if only the radius of the only friction circle is varied.
pub(super) fn closed_form(
    varied: &Varied,
    circles: &[usize],
    options: &ExistenceOptions,
) -> Option<ModesFound> {
    let &[circle] = circles else { return None };
    if !varied.varies_friction_circles() {
        return None;
    }
    let [from, to] = options.range;
    let [Some(least), Some(greatest)] = options.range.map(|at| varied.friction_radius(at, circle)) else {
        return None;
    };
    if least >= greatest {
        return None;
    }
    let instance = varied.block_instance(to, circles).ok()?;
    let found = over_radius(&instance, greatest, [least, greatest], options.greatest_normal_force)?;
    let at = |radius: f64| {
        if radius <= least {
            from
        } else if radius >= greatest {
            to
        } else {
            value_of(radius, [(from, least), (to, greatest)], &|at| varied.friction_radius(at, circle))
        }
    };
    let mut found = found.of(at);
    found.tried = evenly(options.range, VALUES).collect();
    let options = BranchOptions {
        range: options.range,
        values: VALUES,
        further: Vec::new(),
        greatest_normal_force: options.greatest_normal_force,
        search: SearchOptions::default(),
    };
    let same_ends = SameEnds::zeros(options.range, options.range);
    Some(modes_found(varied, circles, &options, found, (Method::Hinge, same_ends)))
}

/// The value with this radius between two values, of which radii are known: of affine radii at once, else by regula falsi
/// with bisection.
fn value_of(
    wanted: f64,
    [mut below, mut above]: [(f64, f64); 2],
    radius: &dyn Fn(f64) -> Option<f64>,
) -> f64 {
    for step in 0..STEPS {
        let share = (wanted - below.1) / (above.1 - below.1);
        let falsi = below.0 + share * (above.0 - below.0);
        let at = if step % 3 == 2 { f64::midpoint(below.0, above.0) } else { falsi };
        if at <= below.0 || at >= above.0 {
            return at;
        }
        let Some(found) = radius(at) else { return at };
        if (found - wanted).abs() <= f64::EPSILON * wanted {
            return at;
        }
        if found < wanted { below = (at, found) } else { above = (at, found) }
    }
    f64::midpoint(below.0, above.0)
}

/// Converts branches into modes.
fn modes_found(
    varied: &Varied,
    circles: &[usize],
    options: &BranchOptions,
    Branches { branches, tried, gaps }: Branches,
    (method, same_ends): (Method, SameEnds),
) -> ModesFound {
    let is_long = |at: [f64; 2]| same_ends.are_two(at[0], at[1]);
    let branches: Vec<Branch> =
        branches.into_iter().filter(|branch| is_long([branch.from.end.at, branch.to.end.at])).collect();
    let mode = |branch: &Branch| ModeInterval {
        pattern: branch.states.clone(),
        from: branch.from.end.clone(),
        to: branch.to.end.clone(),
    };
    let open = Mechanism::new(varied.model()).map(|mechanism| mechanism.excess.open).unwrap_or_default();
    let existence = Existence { modes: branches.iter().map(mode).collect(), open, ..Existence::default() };
    let faults = |at: f64| varied.block_instance(at, circles).err().unwrap_or_default();
    let gaps: Vec<Gap> =
        gaps.iter().map(|gap| Gap { from: gap.from, to: gap.to, faults: faults(gap.inside) }).collect();
    let is_same = |next: f64, kept: f64| same_ends.are_one(kept, next);
    let mut cells = cells_between(&existence.modes, &gaps, options.range, is_same);
    cells.retain(|cell| Gap::none_covers(&gaps, *cell));
    let counts = counts_in(&existence, &cells, &|modes, _| modes.len());
    let elsewhere = if method == Method::Hinge { Elsewhere::ClosedForm } else { Elsewhere::Sampled(0.0) };
    let found = ModesFound::new((existence, counts), elsewhere, same_ends);
    ModesFound { gaps, method, tried, branches, circles: circles.to_vec(), ..found }
}

/// Whether what moves with friction has no sense, or what else is at fault.
fn no_instance(faults: &Faults) -> NoInstance {
    let has_no_sense = |kind: &FaultKind| {
        matches!(kind, FaultKind::ZeroSlidingVelocity { .. } | FaultKind::HingeDoesNotTurn { .. })
    };
    if faults.sorted().iter().all(|fault| has_no_sense(&fault.kind)) {
        NoInstance::NoSense
    } else {
        NoInstance::Other
    }
}
