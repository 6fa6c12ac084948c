//! Invariants of any Bernoulli test, shared by the property tests and the fuzz target.
#![allow(dead_code, reason = "each user checks a part of it")]

use steradian::sprt::{
    Bernoulli, BernoulliError, Bounds, BoundsError, Characteristic, CharacteristicError, MAX_SAMPLES, Run, Sprt, Step,
};

/// Whether `p0` and `p1` are what [`Bernoulli::new`] documents that it accepts.
pub fn are_hypotheses(p0: f64, p1: f64) -> bool {
    p0 > 0.0 && p0 < 1.0 && p1 > 0.0 && p1 < 1.0 && p0 != p1
}

/// Whether the risks are what [`Bounds::from_risks`] documents that it accepts.
///
/// The sum is judged exactly: of two doubles in (0, 1), `large − 1/2` and `1/2 − small` are comparable without
/// rounding if `large ≥ 1/2`, and else the sum is below 1.
pub fn are_risks(alpha: f64, beta: f64) -> bool {
    let in_range = |risk: f64| (f64::MIN_POSITIVE..1.0).contains(&risk);
    let (large, small) = (alpha.max(beta), alpha.min(beta));
    in_range(alpha) && in_range(beta) && (large < 0.5 || small < 1.0 - large)
}

/// Whether the ratios are what [`Bounds::from_ratios`] documents that it accepts.
pub fn are_ratios(upper: f64, lower: f64) -> bool {
    upper > 1.0 && upper < f64::INFINITY && lower > 0.0 && lower < 1.0
}

/// A constructor accepts exactly what its documentation accepts.
pub fn family(p0: f64, p1: f64) -> Result<Bernoulli, BernoulliError> {
    let family = Bernoulli::new(p0, p1);
    assert_eq!(family.is_ok(), are_hypotheses(p0, p1), "Bernoulli::new({p0:e}, {p1:e}) = {family:?}");
    if let Ok(family) = family {
        let (success, failure) = (family.success_increment(), family.failure_increment());
        assert!(success.is_finite() && failure.is_finite() && success * failure <= 0.0, "{family:?}");
        assert_eq!(success > 0.0, p1 > p0, "{family:?}");
    }
    family
}

/// As for [`family`]; the logarithms are finite and on either side of 0.
pub fn bounds(first: f64, second: f64, as_risks: bool) -> Result<Bounds, BoundsError> {
    let (bounds, allowed) = if as_risks {
        (Bounds::from_risks(first, second), are_risks(first, second))
    } else {
        (Bounds::from_ratios(first, second), are_ratios(first, second))
    };
    assert_eq!(bounds.is_ok(), allowed, "{first:e} {second:e} as risks: {as_risks}: {bounds:?}");
    if let Ok(bounds) = bounds {
        assert!(bounds.ln_lower() < 0.0 && bounds.ln_upper() > 0.0, "{bounds:?}");
        assert!(bounds.ln_lower().is_finite() && bounds.ln_upper().is_finite(), "{bounds:?}");
    }
    bounds
}

/// What holds of a run at any time.
pub fn run(run: &Run<'_, Bernoulli>) {
    assert!(run.successes() <= run.samples() && run.samples() <= MAX_SAMPLES, "{run:?}");
    assert!(!run.log_likelihood_ratio().is_nan(), "{run:?}");
    let limit = run.test().truncation().unwrap_or(MAX_SAMPLES);
    match run.step() {
        Step::Continue => assert!(run.samples() < limit, "{run:?}"),
        Step::Exhausted => assert!(run.samples() >= limit, "{run:?}"),
        Step::Stop(decision) => assert_eq!(run.decision(), Some(decision)),
    }
}

/// Streaming, packed bits and, between looks, counts agree on the same outcomes.
pub fn forms_agree(test: &Sprt<Bernoulli>, words: &[(u64, u32)]) {
    let (mut one_by_one, mut packed, mut counted) = (test.start(), test.start(), test.start());
    for &(bits, len) in words {
        for place in 0..len.min(64) {
            let success = bits >> place & 1 == 1;
            let step = one_by_one.push(success);
            assert_eq!(counted.push_counts(u64::from(success), 1), Ok(step));
        }
        assert_eq!(packed.push_bits(bits, len), one_by_one.step());
        assert_eq!(packed, one_by_one, "packed bits");
        assert_eq!(counted, one_by_one, "counts");
        run(&one_by_one);
    }
}

/// What holds of any exact characteristic.
pub fn characteristic(exact: &Characteristic) {
    let (accept, reject, undecided) = (exact.accept(), exact.reject(), exact.undecided());
    for probability in [accept, reject, undecided] {
        assert!((0.0..=1.0 + f64::EPSILON).contains(&probability), "{probability:e}");
    }
    assert!((accept + reject + undecided - 1.0).abs() <= 3.0 * exact.error_bound(), "{accept} {reject} {undecided}");
    assert!(exact.mean_samples() >= 1.0 - f64::EPSILON && exact.mean_samples().is_finite());
    assert!(exact.variance_samples() >= 0.0 && exact.variance_samples().is_finite());
    assert!(exact.error_bound() >= 0.0 && exact.mean_error_bound().is_finite());
    assert!(exact.law().windows(2).all(|pair| pair[0].samples < pair[1].samples));
    let quantiles = [0.1, 0.5, 0.9].map(|q| exact.quantile(q));
    assert!(quantiles.is_sorted(), "{quantiles:?}");
}

/// Asks for everything that can be computed for `p`; refuses exactly what is not a probability, or too much work.
pub fn analysis(test: &Sprt<Bernoulli>, p: f64, work: u64) {
    let allowed = (0.0..=1.0).contains(&p);
    match test.characteristic_within(p, work) {
        Ok(exact) => characteristic(&exact),
        Err(CharacteristicError::Work { .. }) => assert!(allowed && p > 0.0 && p < 1.0),
        Err(error) => assert!(!allowed, "{error}"),
    }
    for approximation in [test.wald_approximation(p), test.corrected_approximation(p)] {
        assert_eq!(approximation.is_ok(), allowed, "{p:e}");
        if let Ok(approximation) = approximation {
            for probability in [approximation.accept(), approximation.reject()] {
                assert!((0.0..=1.0 + 4.0 * f64::EPSILON).contains(&probability), "{p:e}: {approximation:?}");
            }
            assert!(
                approximation.mean_samples() >= 0.0 && approximation.mean_samples().is_finite(),
                "{p:e}: {approximation:?}"
            );
        }
    }
}
