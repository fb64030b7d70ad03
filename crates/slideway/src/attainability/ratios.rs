//! Ratios of unknown quantities that are tried: 1/10, 1 and 10 of each.

/// The most samples, and the work that they may take for matrices of many rows: samples x rows^3.
const MOST: usize = 72;
const WORK: usize = 40_000;

/// Ratios of `count` quantities: all combinations of 1/10, 1 and 10 that differ by more than a common factor if these
/// are few, else a deterministic sample of them.
pub(super) fn ratios(count: usize) -> Vec<Vec<f64>> {
    let most = MOST.min(WORK / count.max(1).pow(3)).max(2);
    if count < 2 {
        return Vec::new();
    }
    match u32::try_from(count).ok().and_then(|count| 3_usize.checked_pow(count)) {
        Some(all) if all <= 3 * most => {
            let digits = |number: usize| (0..count).map(move |k| number / 3_usize.pow(k as u32) % 3);
            let distinct =
                |number: &usize| digits(*number).any(|digit| digit == 0) && digits(*number).any(|d| d > 0);
            (0..all).filter(distinct).take(most).map(|number| digits(number).map(ratio).collect()).collect()
        }
        _ => sample(count, most),
    }
}

fn ratio(digit: usize) -> f64 {
    [0.1, 1.0, 10.0][digit % 3]
}

/// Digits from the upper bits of a linear congruential generator (Knuth, The Art of Computer Programming, 3.3.4).
fn sample(count: usize, samples: usize) -> Vec<Vec<f64>> {
    let mut state: u64 = 2002;
    let mut digit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % 3
    };
    (0..samples).map(|_| (0..count).map(|_| ratio(digit())).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::ratios;

    #[test]
    fn few_quantities_are_tried_in_all_ratios() {
        assert!(ratios(0).is_empty() && ratios(1).is_empty());
        // 3^n combinations, less those that are others times 10 or all equal.
        assert_eq!(ratios(2).len(), 4);
        assert_eq!(ratios(3).len(), 18);
        assert_eq!(ratios(4).len(), 64);
        assert_eq!(ratios(5).len(), 72);
        assert!(ratios(24).len() >= 2);
        assert!(ratios(500).len() == 2);
    }
}
