//! Choices of some indices.

/// All increasing lists of `chosen` indices below `count`.
pub(crate) fn combinations(count: usize, chosen: usize) -> impl Iterator<Item = Vec<usize>> {
    let first: Option<Vec<usize>> = (chosen <= count).then(|| (0..chosen).collect());
    std::iter::successors(first, move |last| {
        let at = (0..chosen).rev().find(|&at| last[at] < count - chosen + at)?;
        let mut next = last.clone();
        for (offset, index) in next[at..].iter_mut().enumerate() {
            *index = last[at] + 1 + offset;
        }
        Some(next)
    })
}

/// How many of these lists there are, or the largest number if that is less.
pub(crate) fn binomial(count: usize, chosen: usize) -> u64 {
    if chosen > count {
        return 0;
    }
    (0..chosen as u64).fold(1_u64, |product, at| product.saturating_mul(count as u64 - at) / (at + 1))
}
