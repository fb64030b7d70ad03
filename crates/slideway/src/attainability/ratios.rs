//! Ratios of unknown quantities that are tried: 1/10, 1 and 10 of each.

/// The most quantities whose ratios are all tried.
const MOST_QUANTITIES: usize = 4;
/// The most samples of more quantities, and the work that they may take for matrices of many rows: samples x
/// rows^3.
const MOST_SAMPLES: usize = 27;
const WORK: usize = 6_000;

/// Ratios of `count` quantities: all combinations of 1/10, 1 and 10 that differ by more than a common factor
/// if these are few, else a deterministic sample of all combinations.
pub(crate) fn ratios(count: usize) -> Vec<Vec<f64>> {
    match count {
        0 | 1 => Vec::new(),
        2..=MOST_QUANTITIES => {
            combinations(count).into_iter().filter(|digits| is_distinct(digits)).map(ratio).collect()
        }
        _ => sample(count, MOST_SAMPLES.min(WORK / count.pow(3)).max(2)),
    }
}

/// All lists of digits 0, 1, 2.
fn combinations(count: usize) -> Vec<Vec<usize>> {
    (0..count).fold(vec![Vec::new()], |lists, _| {
        lists.iter().flat_map(|list| (0..3).map(|digit| [list.as_slice(), &[digit]].concat())).collect()
    })
}

/// Whether no other combination differs by a common factor only, equal ratios included.
fn is_distinct(digits: &[usize]) -> bool {
    digits.contains(&0) && digits.iter().any(|digit| *digit > 0)
}

fn ratio(digits: Vec<usize>) -> Vec<f64> {
    digits.into_iter().map(|digit| [0.1, 1.0, 10.0][digit % 3]).collect()
}

/// Digits from the upper bits of a linear congruential generator (Knuth, The Art of Computer Programming,
/// 3.3.4).
fn sample(count: usize, samples: usize) -> Vec<Vec<f64>> {
    let mut state: u64 = 2002;
    let mut digit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % 3
    };
    (0..samples).map(|_| ratio((0..count).map(|_| digit()).collect())).collect()
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
        assert_eq!(ratios(5).len(), 27);
        assert!(ratios(24).len() >= 2);
        assert!(ratios(500).len() == 2);
    }
}
