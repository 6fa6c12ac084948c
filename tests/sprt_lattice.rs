//! Law: at every point (n, s) of the lattice the test decides as exact rational arithmetic on the decimal inputs does.
//!
//! The logarithm of the ratio, in doubles, settles every point whose margin is far beyond its rounding; the others are
//! settled by integers: p and 1 − p, α and 1 − α are multiples of 10⁻⁴.

mod bounds;

use bounds::sprt::LATTICE_MARGIN;
use num_bigint::BigUint;
use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};

const LAST: u64 = 4000;
/// Inputs are multiples of 1/`SCALE`.
const SCALE: u32 = 10_000;

/// p0, p1, α, β in units of 1/`SCALE`.
struct Design([u32; 4]);

impl Design {
    fn test(&self) -> Sprt<Bernoulli> {
        let [p0, p1, alpha, beta] = self.0.map(|x| f64::from(x) / f64::from(SCALE));
        Sprt::new(Bernoulli::new(p0, p1).expect("hypotheses"), Bounds::from_risks(alpha, beta).expect("risks"))
    }

    /// The decision at (n, s) by integers: p1ˢ q1ⁿ⁻ˢ against A p0ˢ q0ⁿ⁻ˢ with A = (1−β)/α, and likewise B = β/(1−α).
    fn exactly(&self, n: u64, s: u64) -> Option<Decision> {
        let [p0, p1, alpha, beta] = self.0;
        let power = |p: u32, k: u64| BigUint::from(p).pow(u32::try_from(k).expect("n is small"));
        let likelihood = |p: u32| power(p, s) * power(SCALE - p, n - s);
        let (h0, h1) = (likelihood(p0), likelihood(p1));
        if &h1 * alpha >= &h0 * (SCALE - beta) {
            Some(Decision::RejectH0)
        } else if &h1 * (SCALE - alpha) <= &h0 * beta {
            Some(Decision::AcceptH0)
        } else {
            None
        }
    }
}

#[test]
fn every_point_of_the_lattice_is_decided_as_exact_arithmetic_decides_it() {
    let mut settled_by_integers = 0;
    for design in [
        Design([1000, 3000, 500, 1000]),
        Design([3000, 1000, 500, 1000]),
        // Ties: powers of p1/p0 meet the boundaries.
        Design([2500, 7500, 1000, 1000]),
        Design([2000, 6000, 3000, 1000]),
        Design([500, 1500, 3000, 1000]),
        Design([4000, 6000, 4400, 5500]),
        Design([4500, 5500, 4400, 5500]),
        Design([10, 100, 500, 500]),
        Design([5000, 5200, 500, 500]),
    ] {
        let test = design.test();
        let (upper, lower) = (test.bounds().ln_upper(), test.bounds().ln_lower());
        let (success, failure) = (test.family().success_increment(), test.family().failure_increment());
        for n in 1..=LAST {
            let look = test.looks(Looks::from(u32::try_from(n).expect("n is small")));
            for s in 0..=n {
                let got = match look.start().push_counts(s, n).expect("s is at most n") {
                    Step::Stop(decision) => Some(decision),
                    Step::Continue | Step::Exhausted => None,
                };
                let ratio = s as f64 * success + (n - s) as f64 * failure;
                let size = s as f64 * success.abs() + (n - s) as f64 * failure.abs();
                let margin = (ratio - upper).abs().min((ratio - lower).abs());
                let want = if margin > LATTICE_MARGIN * size {
                    match () {
                        () if ratio > upper => Some(Decision::RejectH0),
                        () if ratio < lower => Some(Decision::AcceptH0),
                        () => None,
                    }
                } else {
                    settled_by_integers += 1;
                    design.exactly(n, s)
                };
                assert_eq!(got, want, "{:?} at {n} with {s} successes, margin {margin:e}", design.0);
            }
        }
    }
    assert!(settled_by_integers > 1000, "only {settled_by_integers} points were near a boundary");
}
