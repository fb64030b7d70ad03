//! The extreme rays of a cone, by the double description method.

use dashu_int::IBig;

use super::dictionary::primitive;

/// Comparisons of rays for each ray that may be held: degenerate cones of high dimension need far more than
/// others, and would take minutes.
const COMPARISONS: usize = 1 << 16;

/// A ray of the cone `{x >= 0}` of some linear space: its coordinates, without a common divisor, and those of
/// the inequalities so far for which they vanish.
#[derive(Clone)]
struct Ray {
    coordinates: Vec<IBig>,
    zeros: BitSet,
}

/// A set of inequalities.
#[derive(Clone, PartialEq, Eq)]
struct BitSet(Vec<u64>);

impl BitSet {
    fn none_of(count: usize) -> Self {
        Self(vec![0; count.div_ceil(64)])
    }

    fn insert(&mut self, at: usize) {
        self.0[at / 64] |= 1 << (at % 64);
    }

    fn intersection(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(one, other)| one & other).collect())
    }

    fn len(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    fn is_within(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(one, other)| one & !other == 0)
    }
}

/// The extreme rays of `{x >= 0}` in the linear space spanned by `start`, as integers without a common
/// divisor; `None` if more than `most` have to be held at a time, if that takes more than [`COMPARISONS`] for
/// each of these, or once `proceed` is `false`.
///
/// The vectors in `start` are independent, and vector `k` is the only one with a nonzero coordinate
/// `simplex[k]`, which is positive: they are the rays of the cone with these inequalities only. The others
/// are added one by one: a ray on the wrong side goes, and where the edge to an adjacent ray on the right
/// side meets the new face, there is a new ray (Motzkin et al. (1953); Fukuda and Prodon, Double description
/// method revisited (1996), with the combinatorial test of adjacency). The next inequality is the one with the
/// fewest pairs of rays on opposite sides.
pub(super) fn extreme_rays(
    start: Vec<Vec<IBig>>,
    simplex: &[usize],
    most: usize,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<Vec<IBig>>> {
    let dimension = start.len();
    let coordinates = start.first().map_or(0, Vec::len);
    let first = |coordinates: Vec<IBig>, own: usize| {
        let mut zeros = BitSet::none_of(coordinates.len());
        simplex.iter().filter(|&&at| at != own).for_each(|&at| zeros.insert(at));
        Ray { coordinates: primitive(coordinates), zeros }
    };
    let mut rays: Vec<Ray> =
        start.into_iter().zip(simplex).map(|(vector, &own)| first(vector, own)).collect();
    let mut left: Vec<usize> = (0..coordinates).filter(|at| !simplex.contains(at)).collect();
    let mut comparisons = COMPARISONS.saturating_mul(most);
    let mut afford = |cost: usize| {
        let rest = comparisons.checked_sub(cost);
        comparisons = rest.unwrap_or(0);
        rest.is_some() && proceed()
    };
    while !left.is_empty() {
        let at = (0..left.len()).min_by_key(|&at| pairs(&rays, left[at]))?;
        rays = cut(rays, left.swap_remove(at), (dimension, most), &mut afford)?;
    }
    (rays.len() <= most).then(|| rays.into_iter().map(|ray| ray.coordinates).collect())
}

/// How many pairs of rays are on opposite sides of an inequality.
fn pairs(rays: &[Ray], inequality: usize) -> usize {
    let positive = rays.iter().filter(|ray| ray.coordinates[inequality] > IBig::ZERO).count();
    let negative = rays.iter().filter(|ray| ray.coordinates[inequality] < IBig::ZERO).count();
    positive * negative
}

/// The rays of the cone with one more inequality; `None` if there are more than `most`, or once `afford` is
/// `false` for some more comparisons.
fn cut(
    rays: Vec<Ray>,
    inequality: usize,
    (dimension, most): (usize, usize),
    afford: &mut dyn FnMut(usize) -> bool,
) -> Option<Vec<Ray>> {
    let side = |ray: &&Ray, positive: bool| {
        let value = &ray.coordinates[inequality];
        !value.is_zero() && (*value > IBig::ZERO) == positive
    };
    let inside: Vec<&Ray> = rays.iter().filter(|ray| side(ray, true)).collect();
    let outside: Vec<&Ray> = rays.iter().filter(|ray| side(ray, false)).collect();
    let mut new = Vec::new();
    for one in &inside {
        for other in &outside {
            let common = one.zeros.intersection(&other.zeros);
            // A face of dimension 2 lies in at least dimension - 2 independent inequalities.
            let may_be_adjacent = common.len() + 2 >= dimension;
            let cost = if may_be_adjacent { rays.len() } else { 1 };
            if !afford(cost) || rays.len() - outside.len() + new.len() > most {
                return None;
            }
            if may_be_adjacent && are_adjacent(&rays, (one, other), &common) {
                new.push(between(one, other, inequality, common));
            }
        }
    }
    let mut kept: Vec<Ray> =
        rays.into_iter().filter(|ray| ray.coordinates[inequality] >= IBig::ZERO).collect();
    for ray in kept.iter_mut().filter(|ray| ray.coordinates[inequality].is_zero()) {
        ray.zeros.insert(inequality);
    }
    kept.extend(new);
    (kept.len() <= most).then_some(kept)
}

/// Whether two rays span a face of dimension 2: no other ray has all the zeros that they have in common.
fn are_adjacent(rays: &[Ray], (one, other): (&Ray, &Ray), common: &BitSet) -> bool {
    let is_other = |ray: &Ray| !std::ptr::eq(ray, one) && !std::ptr::eq(ray, other);
    !rays.iter().any(|ray| is_other(ray) && common.is_within(&ray.zeros))
}

/// The point of the edge between a ray inside and one outside at which the inequality is zero.
fn between(inside: &Ray, outside: &Ray, inequality: usize, mut zeros: BitSet) -> Ray {
    let (ahead, behind) = (&inside.coordinates[inequality], -&outside.coordinates[inequality]);
    let entries = inside.coordinates.iter().zip(&outside.coordinates);
    let coordinates = primitive(entries.map(|(one, other)| one * &behind + other * ahead).collect());
    zeros.insert(inequality);
    Ray { coordinates, zeros }
}
