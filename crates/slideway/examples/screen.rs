use nalgebra::{DMatrix, DVector};
use slideway::modes::*;
fn main() {
    let mut s: u64 = 12345;
    let mut rnd = || { s ^= s << 13; s ^= s >> 7; s ^= s << 17; (s >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0 };
    for n in [8usize, 12, 16, 20, 24] {
        let m = DMatrix::from_fn(n, n, |_, _| rnd());
        let q = DVector::from_fn(n, |_, _| rnd());
        let p = ModeProblem::from_linear_complementarity(&m, q).unwrap();
        let t = std::time::Instant::now();
        let r = exhaustive::screen(&p);
        let e = t.elapsed();
        let check = if n <= 16 { let e = enumerate(&p, &Limits::default()).unwrap(); format!("{}", e.solutions.len()) } else { String::new() };
        println!("n={n} {:?} {:.2} ns/pattern, remaining {} ({check})", e, e.as_nanos() as f64 / (1u64 << n) as f64, r.remaining.len());
    }
}
