//! Curves within a frame: cut at its edges, and without points that nobody would see.

/// Distance beyond the frame up to which a curve is not seen to leave it (px).
const SEEN: f64 = 0.5;

/// A rectangle: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Frame {
    /// Whether a place is within, edges included.
    pub(super) fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let slack = 1e-9;
        x >= self.left - slack && x <= self.right + slack && y >= self.top - slack && y <= self.bottom + slack
    }

    /// The part of a segment within the frame (Y.-D. Liang and B. A. Barsky, A new concept and method for
    /// line clipping, 1984).
    fn segment(&self, from: [f64; 2], to: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let delta = [to[0] - from[0], to[1] - from[1]];
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        let edges = [
            (-delta[0], from[0] - self.left),
            (delta[0], self.right - from[0]),
            (-delta[1], from[1] - self.top),
            (delta[1], self.bottom - from[1]),
        ];
        for (towards, room) in edges {
            if towards == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if towards < 0.0 {
                start = start.max(room / towards);
            } else {
                end = end.min(room / towards);
            }
        }
        let at = |share: f64| [from[0] + share * delta[0], from[1] + share * delta[1]];
        (start <= end)
            .then(|| [if start == 0.0 { from } else { at(start) }, if end == 1.0 { to } else { at(end) }])
    }

    /// Through which edge, the lower (0) or the upper one (1), and where a segment leaves the frame that begins
    /// within it; none if it does not.
    pub(super) fn exit(&self, inside: [f64; 2], outside: [f64; 2]) -> Option<(usize, [f64; 2])> {
        let (edge, at) = if outside[1] > self.bottom + SEEN {
            (0, self.bottom)
        } else if outside[1] < self.top - SEEN {
            (1, self.top)
        } else {
            return None;
        };
        // A point may lie on the edge but for rounding.
        let is_inside = self.top - SEEN <= inside[1] && inside[1] <= self.bottom + SEEN;
        let share = ((at - inside[1]) / (outside[1] - inside[1])).clamp(0.0, 1.0);
        let place = [inside[0] + share * (outside[0] - inside[0]), at];
        (is_inside && self.holds(place)).then_some((edge, place))
    }

    /// The parts of a polyline within the frame.
    pub(super) fn parts(&self, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
        let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut open = false;
        for pair in points.windows(2) {
            let Some([from, to]) = self.segment(pair[0], pair[1]) else {
                open = false;
                continue;
            };
            match parts.last_mut() {
                Some(part) if open && from == pair[0] => part.push(to),
                _ => parts.push(vec![from, to]),
            }
            open = to == pair[1];
        }
        parts
    }
}

/// A polyline without the points that lie within `tolerance` of the line between others (D. H. Douglas and T.
/// K. Peucker, Algorithms for the reduction of the number of points required to represent a digitized line or
/// its caricature, 1973).
pub(crate) fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let farthest = (first + 1..last)
            .map(|index| (index, distance(points[index], points[first], points[last])))
            .max_by(|one, other| one.1.total_cmp(&other.1));
        if let Some((index, far)) = farthest
            && far > tolerance
        {
            keep[index] = true;
            open.push((first, index));
            open.push((index, last));
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

/// Distance of a point from a segment.
pub(super) fn distance(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let offset = [point[0] - from[0], point[1] - from[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let share = if length > 0.0 { (offset[0] * along[0] + offset[1] * along[1]) / length } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (offset[0] - share * along[0]).hypot(offset[1] - share * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_curve_that_leaves_and_returns_has_two_parts_that_end_on_the_frame() {
        let parts = FRAME.parts(&[[1.0, 5.0], [2.0, 15.0], [4.0, 15.0], [5.0, 5.0]]);
        assert_eq!(parts, [vec![[1.0, 5.0], [1.5, 10.0]], vec![[4.5, 10.0], [5.0, 5.0]]]);
        assert!(FRAME.parts(&[[-5.0, -5.0], [-1.0, 20.0]]).is_empty());
        // One segment right through.
        assert_eq!(FRAME.parts(&[[-5.0, 5.0], [15.0, 5.0]]), [vec![[0.0, 5.0], [10.0, 5.0]]]);
    }

    #[test]
    fn a_segment_that_leaves_upwards_or_downwards_has_an_exit() {
        let frame = Frame { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };
        assert_eq!(frame.exit([2.0, 5.0], [4.0, -5.0]), Some((1, [3.0, 0.0])));
        assert_eq!(frame.exit([2.0, 5.0], [4.0, 25.0]), Some((0, [2.5, 10.0])));
        // From a point that rounding puts just beyond the edge.
        assert_eq!(frame.exit([2.0, -1e-9], [4.0, -5.0]).map(|(edge, _)| edge), Some(1));
        // Through a side, to a place that is not seen to lie beyond, and beyond all along.
        for (inside, outside) in
            [([2.0, 5.0], [40.0, -1.0]), ([2.0, 5.0], [4.0, -0.2]), ([2.0, -5.0], [4.0, -9.0])]
        {
            assert_eq!(frame.exit(inside, outside), None);
        }
    }

    #[test]
    fn straight_lines_keep_their_ends_alone() {
        let line: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
        assert_eq!(simplified(&line, 0.01), [[0.0, 0.0], [99.0, 198.0]]);
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        assert_eq!(simplified(&corner, 0.01), corner);
        assert!(simplified(&[], 0.1).is_empty());
    }
}
