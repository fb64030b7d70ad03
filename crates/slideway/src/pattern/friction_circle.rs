//! Couples of hinges within their friction circles, `|M| <= r |R|`, beside linear inequalities.
//!
//! The set is not convex where `R` varies, and what it holds of a load may be disconnected. But
//!
//! ```text
//! |M| <= r t.R for some |t| <= 1   =>   |M| <= r |R|   =>   |M| <= r c.R for some of the c below
//! ```
//!
//! with directions `e` in the middle of sectors of half-angle `d` that cover the plane, and `c = e / cos d`: `c.R >= |R|`
//! where `R` lies in the sector, and outside it the inequality is the stricter one. So the set is the union of convex
//! regions over directions, known from inside and from outside, and sectors are halved until the two agree (theory of
//! friction in hinges, section 7). The difference is of second order in `d`.

use super::program::{End, NOTHING, Region};
use super::{Affine, Extent, Unsolved};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::FRAC_PI_4;

/// Half-angle below which `1 / cos d - 1` is less than the accuracy of the programs, 1e-12.
const FINEST: f64 = 1.4e-6;
/// Ends of extents that are known from inside and outside agree to this, relative to the greater of 1 and the end.
const AGREEMENT: f64 = 1e-11;
/// The greatest least slack of an empty region is known to this part of it.
const SLACK_AGREEMENT: f64 = 1e-6;
/// Smaller forces at a hinge are rounding errors of linear programs.
const UNLOADED: f64 = 1e-9;
/// More sectors are not tried.
const MOST_SECTORS: usize = 100_000;
/// Half-angle of sectors in which Newton's method is begun.
const NARROW: f64 = 1e-3;
/// More steps of Newton's method are not taken.
const MOST_STEPS: usize = 50;
/// Directions that differ by less are the same.
const SAME_DIRECTION: f64 = 1e-9;

/// A hinge whose couple stays within the friction circle.
#[derive(Debug, Clone)]
pub(crate) struct Pin {
    /// The force at the hinge.
    pub(crate) reaction: [Affine; 2],
    /// The couple of friction.
    pub(crate) couple: Affine,
    /// Radius of the friction circle.
    pub(crate) radius: f64,
    /// Which way the hinge turns, if it does: then the couple is `-r |R|` times that sign.
    pub(crate) turning: Option<f64>,
    /// By how much the couple may be greater.
    pub(crate) allowance: f64,
}

impl Pin {
    /// Whether its force or its couple is no constant.
    pub(crate) fn varies(&self) -> bool {
        self.couple.varies() || self.reaction.iter().any(Affine::varies)
    }

    /// `r |R| - |M|` where both are constants.
    pub(crate) fn slack_of_constants(&self) -> f64 {
        let [x, y] = &self.reaction;
        self.radius * x.constant.hypot(y.constant) - self.couple.constant.abs() + self.allowance
    }

    /// `|M| <= r c.R`.
    fn within(&self, direction: [f64; 2]) -> Vec<Affine> {
        [-1.0, 1.0].map(|sign| self.slack(1.0, direction, sign)).to_vec()
    }

    /// What holds of all reactions within a sector: of a hinge that sticks `|M| <= r c.R`, of one that turns besides
    /// `-s M >= r e.R` for directions `e` of the sector, since `|R| >= e.R` for every `e`.
    fn around(&self, sector: Option<Sector>) -> Vec<Affine> {
        let at_rest = match sector {
            Some(sector) => self.within(sector.outer()),
            None if self.radius == 0.0 => self.within([0.0; 2]),
            None => Vec::new(),
        };
        let Some(sign) = self.turning else { return at_rest };
        let parts = Sector::divided(None);
        let edges = sector.map_or_else(
            || parts.iter().map(|part| part.direction(0.0)).collect(),
            |sector| [-1.0, 0.0, 1.0].map(|side| sector.direction(side)).to_vec(),
        );
        at_rest.into_iter().chain(edges.into_iter().map(|edge| self.slack(-1.0, edge, -sign))).collect()
    }

    /// `-s M = r t.R` of a hinge that turns.
    pub(super) fn along(&self, direction: [f64; 2]) -> [Affine; 2] {
        let sign = self.turning.unwrap_or_default();
        [self.slack(1.0, direction, sign), self.slack(-1.0, direction, -sign)]
    }

    /// `side r c.R + sign M`.
    fn slack(&self, side: f64, direction: [f64; 2], sign: f64) -> Affine {
        let [x, y] = &self.reaction;
        let along = |x: f64, y: f64| side * self.radius * (direction[0] * x + direction[1] * y);
        let coefficients = x.coefficients.iter().zip(&y.coefficients).zip(&self.couple.coefficients);
        Affine {
            coefficients: coefficients.map(|((x, y), couple)| along(*x, *y) + sign * couple).collect(),
            constant: along(x.constant, y.constant) + sign * self.couple.constant + self.allowance,
        }
    }

    fn reaction_at(&self, end: &End) -> [f64; 2] {
        self.reaction.each_ref().map(|component| end.value_of(component))
    }

    /// By how much the couple exceeds the friction circle, or is off it where the hinge turns.
    fn excess(&self, end: &End) -> f64 {
        let [x, y] = self.reaction_at(end);
        let excess = end.value_of(&self.couple).abs() - self.radius * x.hypot(y);
        if self.turning.is_some() { excess.abs() } else { excess.max(0.0) }
    }
}

/// Directions of a reaction within an angle of one in the middle; nothing where every direction is meant.
#[derive(Debug, Clone, Copy)]
struct Sector {
    middle: f64,
    half: f64,
}

impl Sector {
    /// `c`, with `c.R >= |R|` in the sector.
    fn outer(self) -> [f64; 2] {
        self.direction(0.0).map(|component| component / self.half.cos())
    }

    /// The direction so many half-angles from the middle.
    fn direction(self, side: f64) -> [f64; 2] {
        let angle = self.middle + side * self.half;
        [angle.cos(), angle.sin()]
    }

    fn divided(sector: Option<Self>) -> Vec<Self> {
        match sector {
            None => {
                (0..4_u8).map(|k| Self { middle: 2.0 * f64::from(k) * FRAC_PI_4, half: FRAC_PI_4 }).collect()
            }
            Some(Self { middle, half }) => {
                [-0.5, 0.5].map(|side| Self { middle: middle + side * half, half: 0.5 * half }).to_vec()
            }
        }
    }
}

/// One sector for each pin.
type Sectors = Vec<Option<Sector>>;
/// One direction for each pin.
type Directions = Vec<[f64; 2]>;

/// Sectors, with a bound on the greatest least slack in them and where it is attained.
struct Node {
    upper: f64,
    at: End,
    sectors: Sectors,
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

/// A convex region and the pins that bound it further.
pub(super) struct Pinned<'a, 'w> {
    pub(super) convex: &'a Region<'w>,
    pub(super) pins: &'a [Pin],
}

impl<'w> Pinned<'_, 'w> {
    /// The steps of a search until it is given up, or the work is to end.
    fn steps(&self) -> impl Iterator<Item = usize> {
        let work = self.convex.work;
        (0..MOST_SECTORS).take_while(move |_| !work.is_over())
    }

    /// The point at which the least slack is greatest, those of the friction circles among them, and that slack; once one
    /// is positive, greater ones are not sought, and of those below `least` times the greatest term only that
    /// they are below.
    ///
    /// # Errors
    /// If a linear program was not solved, too many sectors would be needed, or the work is to end.
    pub(super) fn highest_from(&self, least: f64) -> Result<(f64, Vec<f64>), Unsolved> {
        let mut best = (f64::NEG_INFINITY, Vec::new());
        let mut open = BinaryHeap::from([self.node(vec![None; self.pins.len()])?]);
        for _ in self.steps() {
            let Some(Node { upper, at, sectors }) = open.pop() else { return Ok(best) };
            if upper < least * self.convex.greatest_term(&at.at) {
                return Ok((upper, at.at));
            }
            let agree = NOTHING.max(SLACK_AGREEMENT * upper.abs());
            if upper <= best.0 + agree {
                return Ok(best);
            }
            let (inner, point) = self.inside(&at).highest()?;
            if inner > best.0 {
                best = (inner, point);
            }
            if best.0 > NOTHING {
                return Ok(best);
            }
            if upper <= best.0 + agree {
                continue;
            }
            match self.divided((&sectors, FINEST), &at) {
                Some(parts) => {
                    for part in parts {
                        open.push(self.node(part)?);
                    }
                }
                None => best = (upper, at.at),
            }
        }
        Err(Unsolved)
    }

    fn node(&self, sectors: Sectors) -> Result<Node, Unsolved> {
        let (upper, at) = self.around(&sectors).highest()?;
        Ok(Node { upper, at: End { value: Some(upper), at, is_ray: false }, sectors })
    }

    /// Least and greatest values of a function in the parts of the set, which may overlap.
    ///
    /// # Errors
    /// If a linear program was not solved, or too many sectors would be needed.
    pub(super) fn extents(&self, function: &Affine) -> Result<Vec<Extent>, Unsolved> {
        self.searched(function, Vec::push)
    }

    /// Least and greatest value of a function in the whole set, whatever lies between; nothing if it is empty.
    ///
    /// # Errors
    /// As [`Pinned::extents`].
    pub(super) fn extent(&self, function: &Affine) -> Result<Option<Extent>, Unsolved> {
        let found = self.searched(function, |found, extent| match found.first_mut() {
            Some(whole) => *whole = hull(*whole, extent),
            None => found.push(extent),
        })?;
        Ok(found.first().copied())
    }

    fn searched(
        &self,
        function: &Affine,
        note: impl Fn(&mut Vec<Extent>, Extent),
    ) -> Result<Vec<Extent>, Unsolved> {
        let mut found: Vec<Extent> = Vec::new();
        let mut open = vec![vec![None; self.pins.len()]];
        for _ in self.steps() {
            let Some(sectors) = open.pop() else { return Ok(found) };
            let outer = self.around(&sectors);
            let Some(outer) = outer.possible(NOTHING)? else { continue };
            let Ok(ends) = outer.ends(function) else {
                let (_, at) = outer.highest()?;
                let end = End { value: None, at, is_ray: false };
                open.extend(self.divided((&sectors, FINEST), &end).ok_or(Unsolved)?);
                continue;
            };
            let extent = ends.each_ref().map(|end| end.value);
            let is_known = |found: &[Extent], side: usize| covers(found, [bounds(extent)[side]; 2]);
            for (side, end) in ends.iter().enumerate() {
                if !is_known(&found, side)
                    && let Ok(Some(inner)) = self.climbed(function, (end, side))
                {
                    note(&mut found, inner);
                }
            }
            if covers(&found, bounds(extent)) {
                continue;
            }
            let missed = usize::from(is_known(&found, 0) && !is_known(&found, 1));
            match self.divided((&sectors, FINEST), &ends[missed]) {
                Some(parts) => open.extend(parts),
                None => note(&mut found, extent),
            }
        }
        Err(Unsolved)
    }

    /// The values of a function in regions from inside, whose directions are those that the reactions have somewhere, then
    /// at the least or greatest value so far: each has the end of the one before. Nothing if the first is empty.
    fn climbed(&self, function: &Affine, (end, side): (&End, usize)) -> Result<Option<Extent>, Unsolved> {
        let Some(inner) = self.inside(end).possible(NOTHING)? else { return Ok(None) };
        let mut ends = inner.ends(function)?;
        let mut extent = ends.each_ref().map(|end| end.value);
        for _ in 0..MOST_STEPS {
            let Some(before) = ends[side].value else { break };
            let Some(inner) = self.inside(&ends[side]).possible(NOTHING)? else { break };
            ends = inner.ends(function)?;
            extent = hull(extent, ends.each_ref().map(|end| end.value));
            let stays = |value: f64| (value - before).abs() <= AGREEMENT * before.abs().max(1.0);
            if ends[side].value.is_some_and(stays) {
                break;
            }
        }
        Ok(Some(extent))
    }

    /// Regions in which turning hinges have their couples with fixed directions of their reactions: one for each of the
    /// isolated choices of these, found from sectors of [`NARROW`] width by Newton's method, in which `|R|` is replaced by
    /// `t.R`. Solutions that lie closer together may be found once.
    ///
    /// # Errors
    /// If a linear program was not solved, too many sectors would be needed, or Newton's method does not end.
    pub(super) fn parts(&self) -> Result<Vec<Region<'w>>, Unsolved> {
        let mut found: Vec<(Directions, Region<'w>)> = Vec::new();
        let mut open = vec![vec![None; self.pins.len()]];
        for _ in self.steps() {
            let Some(sectors) = open.pop() else {
                return Ok(found.into_iter().map(|(_, region)| region).collect());
            };
            let region = self.around(&sectors);
            let (slack, at) = region.highest()?;
            if slack < -NOTHING {
                continue;
            }
            let end = End { value: Some(slack), at, is_ray: false };
            let is_loaded = !self.is_unloaded(&region).unwrap_or(false);
            if let Some(parts) = self.divided((&sectors, NARROW), &end).filter(|_| is_loaded) {
                open.extend(parts);
                continue;
            }
            let new = self.tangent(end)?;
            let is_new = |new: &(Directions, Region<'w>)| {
                found.iter().all(|(directions, _)| change(directions, &new.0) > SAME_DIRECTION)
            };
            found.extend(new.filter(is_new));
        }
        Err(Unsolved)
    }

    /// The region in which couples are `-s r t.R`, with the directions `t` of its own reactions; nothing if it is empty.
    fn tangent(&self, mut end: End) -> Result<Option<(Directions, Region<'w>)>, Unsolved> {
        let mut directions = self.directions(&end);
        for _ in 0..MOST_STEPS {
            let both = |(pin, t): (&Pin, &[f64; 2])| pin.along(*t);
            let region = self.convex.within(self.pins.iter().zip(&directions).flat_map(both));
            let (slack, at) = region.highest()?;
            if slack < -UNLOADED {
                return Ok(None);
            }
            end.at = at;
            let next = self.directions(&end);
            if change(&directions, &next) <= SAME_DIRECTION {
                return Ok(Some((next, region)));
            }
            directions = next;
        }
        Err(Unsolved)
    }

    /// The directions that the reactions have somewhere; of none, nothing.
    fn directions(&self, end: &End) -> Directions {
        self.pins.iter().map(|pin| direction(pin.reaction_at(end))).collect()
    }

    /// Whether no pin is loaded anywhere in a region that is not empty: then directions make no difference.
    fn is_unloaded(&self, region: &Region<'_>) -> Result<bool, Unsolved> {
        let region = region.clone().relaxed(NOTHING);
        for component in self.pins.iter().flat_map(|pin| &pin.reaction) {
            let ends = region.convex_extent(component)?;
            if !ends.iter().all(|end| end.is_some_and(|end| end.abs() <= UNLOADED)) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The region from outside.
    fn around(&self, sectors: &Sectors) -> Region<'w> {
        self.convex.within(self.pins.iter().zip(sectors).flat_map(|(pin, sector)| pin.around(*sector)))
    }

    /// The region from inside, with the directions that the reactions have somewhere.
    fn inside(&self, end: &End) -> Region<'w> {
        let directions = self.directions(end);
        self.convex
            .within(self.pins.iter().zip(directions).flat_map(|(pin, direction)| pin.within(direction)))
    }

    /// The parts of the sector of the pin whose couple is too great by most, or of the widest one where none is; nothing
    /// if every sector is of the finest.
    fn divided(&self, (sectors, finest): (&Sectors, f64), end: &End) -> Option<Vec<Sectors>> {
        let width = |k: usize| sectors[k].map_or(f64::INFINITY, |sector| sector.half);
        let wide = (0..sectors.len()).filter(|&k| self.pins[k].radius > 0.0 && width(k) > finest);
        let rank = |k: usize| (self.pins[k].excess(end), width(k));
        let chosen = wide.max_by(|&a, &b| {
            let (a, b) = (rank(a), rank(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        })?;
        let part = |sector: Sector| {
            let mut part = sectors.clone();
            part[chosen] = Some(sector);
            part
        };
        Some(Sector::divided(sectors[chosen]).into_iter().map(part).collect())
    }
}

/// The direction of a force; zero where there is none.
pub(crate) fn direction(force: [f64; 2]) -> [f64; 2] {
    let size = force[0].hypot(force[1]);
    if size > 0.0 { force.map(|component| component / size) } else { force }
}

/// The greatest difference of two choices of directions.
fn change(one: &Directions, other: &Directions) -> f64 {
    let differences = one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// The least extent that has both.
fn hull(one: Extent, other: Extent) -> Extent {
    let end = |side: usize, pick: fn(f64, f64) -> f64| Some(pick(one[side]?, other[side]?));
    [end(0, f64::min), end(1, f64::max)]
}

/// The ends of an extent as numbers.
fn bounds([least, greatest]: Extent) -> [f64; 2] {
    [least.unwrap_or(f64::NEG_INFINITY), greatest.unwrap_or(f64::INFINITY)]
}

/// Whether all from one number to another lies within the union of extents.
fn covers(found: &[Extent], [mut from, to]: [f64; 2]) -> bool {
    let mut sorted: Vec<[f64; 2]> = found.iter().copied().map(bounds).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let reaches = |end: f64, other: f64| end >= other || end + AGREEMENT * end.abs().max(1.0) >= other;
    let mut is_inside = false;
    for [least, greatest] in sorted {
        if reaches(from, least) && reaches(greatest, from) {
            is_inside = true;
            from = from.max(greatest);
        }
    }
    is_inside && reaches(from, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn affine(coefficients: &[f64], constant: f64) -> Affine {
        Affine { coefficients: coefficients.to_vec(), constant }
    }

    /// One body hinged at the origin, without weight: a force `f_a` at `p_a`, and a load factor times `f_b` at `p_b`; in
    /// units of 100 N and 100 mm, so that all is of order one.
    fn lever(radius: f64, [p_a, f_a, p_b, f_b]: [[f64; 2]; 4]) -> Region<'static> {
        let moment = |p: [f64; 2], f: [f64; 2]| p[0] * f[1] - p[1] * f[0];
        let reaction = [0, 1].map(|axis| affine(&[-f_b[axis]], -f_a[axis]));
        let couple = affine(&[-moment(p_b, f_b)], -moment(p_a, f_a));
        Region::new(1, Vec::new()).with_pins(vec![Pin {
            reaction,
            couple,
            radius,
            turning: None,
            allowance: 0.0,
        }])
    }

    /// In each part; sorted, and joined where they overlap.
    fn held(region: &Region<'_>) -> Vec<[f64; 2]> {
        let mut parts: Vec<[f64; 2]> = region
            .extents(&affine(&[1.0], 0.0))
            .expect("it is solved")
            .into_iter()
            .map(|[least, greatest]| [least.unwrap_or(f64::NEG_INFINITY), greatest.unwrap_or(f64::INFINITY)])
            .collect();
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut joined: Vec<[f64; 2]> = Vec::new();
        for part in parts {
            match joined.last_mut().filter(|last| part[0] <= last[1]) {
                Some(last) => last[1] = last[1].max(part[1]),
                None => joined.push(part),
            }
        }
        joined
    }

    fn near(found: f64, expected: f64) -> bool {
        found == expected || (found - expected).abs() <= 1e-9 * expected.abs()
    }

    /// `M^2 = r^2 |R|^2` is a quadratic in the factor: held between its roots (reference/hinges.toml, bell_crank_hold).
    #[test]
    fn a_bell_crank_is_held_between_two_factors() {
        let found = held(&lever(0.04, [[1.0, 0.0], [0.0, -1.0], [0.0, 0.6], [-1.0, 0.0]]));
        assert!(
            matches!(found[..], [[a, b]] if near(a, 1.544_028_551_03) && near(b, 1.804_185_734_68)),
            "{found:?}"
        );
    }

    /// Where the load acts within the friction circle, it is held outside the roots: by hand -16 and 24/7
    /// (reference/hinges.toml, `eccentric_hold_disconnected`).
    #[test]
    fn what_is_held_may_be_disconnected() {
        let found = held(&lever(0.2, [[1.0, 0.0], [0.0, -1.0], [0.15, 0.0], [0.0, 1.0]]));
        assert!(
            matches!(found[..], [[from, a], [b, to]]
                if from == f64::NEG_INFINITY && near(a, -16.0) && near(b, 24.0 / 7.0) && to == f64::INFINITY),
            "{found:?}"
        );
    }
}
