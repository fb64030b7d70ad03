//! Curves that run so close to each other that the later one would hide the earlier.

/// Distance of the places of a curve that are looked at (px).
const STEP: f64 = 6.0;

/// Whether at least half of the length of `beneath` lies within a distance of `above`, both given by their
/// visible parts.
pub(super) fn runs_along(beneath: &[Vec<[f64; 2]>], above: &[Vec<[f64; 2]>], distance: f64) -> bool {
    if !are_near(beneath, above, distance) {
        return false;
    }
    let places: Vec<[f64; 2]> = beneath.iter().flat_map(|part| spaced(part)).collect();
    let hidden = places.iter().filter(|&&place| above.iter().any(|part| is_near(place, part, distance)));
    !places.is_empty() && 2 * hidden.count() >= places.len()
}

/// Whether the rectangles around both come within the distance.
fn are_near(one: &[Vec<[f64; 2]>], other: &[Vec<[f64; 2]>], distance: f64) -> bool {
    let range = |parts: &[Vec<[f64; 2]>], axis: usize| {
        let values = parts.iter().flatten().map(|place| place[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| {
            [f64::min(least, value), f64::max(greatest, value)]
        })
    };
    [0, 1].into_iter().all(|axis| {
        let ([from, to], [begin, end]) = (range(one, axis), range(other, axis));
        from - distance <= end && begin - distance <= to
    })
}

/// Middles of pieces of equal length along a line.
fn spaced(part: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let segments = part.windows(2).flat_map(|pair| {
        let [from, to] = [pair[0], pair[1]];
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP).ceil().clamp(1.0, 1000.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 1000")]
        let count = steps as usize;
        (0..count).map(move |step| {
            let share = (step as f64 + 0.5) / steps;
            [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
        })
    });
    segments.collect()
}

fn is_near(place: [f64; 2], part: &[[f64; 2]], distance: f64) -> bool {
    part.windows(2).any(|pair| {
        let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let to = [place[0] - pair[0][0], place[1] - pair[0][1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let product = along[0] * to[0] + along[1] * to[1];
        let share = if square > 0.0 { (product / square).clamp(0.0, 1.0) } else { 0.0 };
        (to[0] - share * along[0]).hypot(to[1] - share * along[1]) <= distance
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_length_counts() {
        let beneath = [vec![[0.0, 10.0], [100.0, 10.0]]];
        let above = |y: f64, right: f64| [vec![[0.0, y], [right, y]]];
        assert!(runs_along(&beneath, &above(11.0, 100.0), 2.0));
        assert!(!runs_along(&beneath, &above(13.0, 100.0), 2.0));
        assert!(runs_along(&beneath, &above(10.0, 55.0), 2.0));
        assert!(!runs_along(&beneath, &above(10.0, 40.0), 2.0));
        assert!(!runs_along(&[], &above(10.0, 100.0), 2.0));
        let crossing = [vec![[50.0, -40.0], [50.0, 60.0]]];
        assert!(!runs_along(&beneath, &crossing, 2.0));
    }
}
