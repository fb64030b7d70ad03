//! Time of the exact intervals in which modes exist, in one coefficient and on a ray of all. Divan's items
//! are patterns.

use divan::Bencher;
use divan::counter::ItemsCount;
use nalgebra::{DMatrix, DVector};
use slideway_modes::ModeProblem;
use slideway_modes::existence::{ExistenceOptions, ModeProblemLine};

fn main() {
    divan::main();
}

/// Numbers from -1 to 1 by a linear congruential generator (Knuth's MMIX constants).
fn random_numbers() -> impl FnMut() -> f64 {
    let mut state: u64 = 2002;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// `c_k = sigma e_k - mu_k eta_k` where the first `varying` coefficients are `t` and the others 0.1.
fn line(contacts: usize, varying: usize) -> ModeProblemLine {
    let mut random = random_numbers();
    let eta = DMatrix::from_fn(contacts, contacts, |_, _| 2.0 * random() / (contacts as f64).sqrt());
    let load = DVector::from_fn(contacts, |_, _| random());
    let none = DMatrix::zeros(contacts, contacts);
    let at = |t: f64| {
        let mu = DVector::from_fn(contacts, |k, _| if k < varying { t } else { 0.1 });
        let [positive, negative] = [1.0, -1.0]
            .map(|sign| DMatrix::identity(contacts, contacts) * sign - &eta * DMatrix::from_diagonal(&mu));
        ModeProblem::new(positive, negative, none.clone(), none.clone(), load.clone())
            .expect("finite numbers")
    };
    ModeProblemLine::between(&at(0.0), &at(1.0))
}

fn intervals(bencher: Bencher<'_, '_>, contacts: usize, varying: usize) {
    let line = line(contacts, varying);
    let options = ExistenceOptions { range: [0.0, 1.0], greatest_normal_force: None, patterns: 1 << 20 };
    bencher
        .counter(ItemsCount::new(1_usize << contacts))
        .bench_local(|| line.existence(&options).expect("within the limit"));
}

#[divan::bench(args = [3, 6, 12], sample_count = 10)]
fn one_coefficient(bencher: Bencher<'_, '_>, contacts: usize) {
    intervals(bencher, contacts, 1);
}

#[divan::bench(args = [3, 6, 12], sample_count = 10)]
fn ray_of_all_coefficients(bencher: Bencher<'_, '_>, contacts: usize) {
    intervals(bencher, contacts, contacts);
}
