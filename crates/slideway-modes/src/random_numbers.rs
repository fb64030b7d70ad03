//! Numbers for tests.

/// Numbers from -1 to 1 by a linear congruential generator (Knuth's MMIX constants).
pub(crate) fn random_numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
