//! Arctangents and arcs of small numbers, by their series.

use crate::float::atan2;

/// atan(t) / t of t² = `s`, by so many terms of the series 1 − s/3 + s²/5 − ….
#[inline(always)]
pub(super) fn arctangent_over<const TERMS: usize>(s: f64) -> f64 {
    (0..TERMS - 1).rev().fold(ODD[TERMS - 1], |sum, k| ODD[k] - s * sum)
}

/// The arctangent by so many terms.
#[inline(always)]
pub(super) fn arctangent<const TERMS: usize>(tangent: f64) -> f64 {
    tangent * arctangent_over::<TERMS>(tangent * tangent)
}

/// 1, 1/3, 1/5, ….
const ODD: [f64; 26] = {
    let mut odd = [1.0; 26];
    let mut k = 1;
    while k < 26 {
        odd[k] = 1.0 / (2 * k + 1) as f64;
        k += 1;
    }
    odd
};

/// θ / sin θ − 1 of the arc with sin²(θ/2) = `s`, for `s` < 3/4 (θ < 2π/3).
///
/// The power series of asin(√s) / √(s(1 − s)), coefficients 2/3, 2/3·4/5, 2/3·4/5·6/7, …: up to 1/16 14 of them leave less
/// than 2⁻⁵⁶ of the first, up to 1/128 8 do, and 4 up to 2⁻¹⁴. Beyond, the arc itself.
#[inline(always)]
pub(super) fn arc_over_sine_less_one(s: f64) -> f64 {
    if s <= 1.0 / 16384.0 {
        power_series(s, &COEFFICIENTS[..4])
    } else if s <= 1.0 / 128.0 {
        power_series(s, &COEFFICIENTS[..8])
    } else {
        of_long_arc(s)
    }
}

#[inline(never)]
fn of_long_arc(s: f64) -> f64 {
    if s <= 1.0 / 16.0 {
        power_series(s, &COEFFICIENTS)
    } else {
        let half_sine = (s * (1.0 - s)).sqrt();
        atan2(half_sine, 0.5 - s) / (2.0 * half_sine) - 1.0
    }
}

#[inline(always)]
fn power_series(s: f64, coefficients: &[f64]) -> f64 {
    s * coefficients.iter().rev().fold(0.0, |series, coefficient| coefficient + s * series)
}

/// 2/3, 2/3·4/5, …
const COEFFICIENTS: [f64; 14] = {
    let mut coefficients = [2.0 / 3.0; 14];
    let mut k = 1;
    while k < 14 {
        coefficients[k] = coefficients[k - 1] * ((2 * k + 2) as f64 / (2 * k + 3) as f64);
        k += 1;
    }
    coefficients
};

#[cfg(test)]
mod tests {
    use super::super::horizon;
    use super::*;

    #[test]
    fn series_agree_with_the_library_on_both_sides_of_each_limit() {
        for k in 0..4000 {
            let t = (f64::from(k) * 0.01 - 32.0).exp2();
            let near =
                |got: f64, want: f64| assert!((got - want).abs() <= 4.0 * f64::EPSILON * want, "{t}: {got}, {want}");
            if t <= 0.5 {
                near(arctangent::<{ horizon::ARC }>(t), t.atan());
                assert_eq!(arctangent::<{ horizon::ARC }>(-t), -arctangent::<{ horizon::ARC }>(t));
            }
            if t < 0.74 {
                let half = t.sqrt().asin();
                near(1.0 + arc_over_sine_less_one(t), 2.0 * half / (2.0 * half).sin());
            }
        }
    }

    #[test]
    fn few_terms_leave_less_than_half_a_unit() {
        fn check<const ARC: usize, const AREA: usize>(reach: f64) {
            let widest = reach / (1.0 + (1.0 - reach).sqrt()).powi(2);
            let left_out = |terms: usize, s: f64| s.powi(terms as i32) / (2 * terms + 1) as f64;
            let most = f64::EPSILON / 16.0;
            assert!(left_out(ARC, widest) <= most && left_out(AREA, widest * widest) <= most, "{reach}");
            let full = |s: f64| s.sqrt().atan() / s.sqrt();
            for (got, s) in
                [(arctangent_over::<ARC>(widest), widest), (arctangent_over::<AREA>(widest * widest), widest * widest)]
            {
                assert!((got - full(s)).abs() <= 3.0 * f64::EPSILON, "{reach}: {got}");
            }
        }
        check::<4, 2>(1.0 / 4096.0);
        check::<7, 4>(1.0 / 64.0);
        check::<11, 6>(1.0 / 8.0);
        check::<17, 9>(0.36);
        check::<{ horizon::ARC }, { horizon::AREA }>(horizon::WIDE * horizon::WIDE);
    }
}
