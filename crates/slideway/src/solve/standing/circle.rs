//! The friction circle of a hinge that stands still.

/// The ranges of `t` in which `|t| <= |start + slope t|`, both already times the radius.
pub(super) fn within_circle(start: [f64; 2], slope: [f64; 2]) -> Vec<[f64; 2]> {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // a t^2 + 2 b t + c >= 0, c >= 0
    let (a, b, c) = (dot(slope, slope) - 1.0, dot(start, slope), dot(start, start));
    let discriminant = b * b - a * c;
    let all = [f64::NEG_INFINITY, f64::INFINITY];
    if discriminant < 0.0 {
        return vec![all];
    }
    // Without cancellation: the roots are q/a and c/q.
    let q = -(b + discriminant.sqrt().copysign(b));
    let mut roots = [q / a, c / q].map(|root| if root.is_nan() { 0.0 } else { root });
    roots.sort_by(f64::total_cmp);
    if a < 0.0 {
        vec![roots]
    } else if a > 0.0 {
        vec![[all[0], roots[0]], [roots[1], all[1]]]
    } else {
        let at = -c / (2.0 * b);
        vec![if b > 0.0 {
            [at, all[1]]
        } else if b < 0.0 {
            [all[0], at]
        } else {
            all
        }]
    }
}
