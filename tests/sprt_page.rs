//! Law: the numbers that docs/sprt.md gives without a program beside them are true.

use steradian::sprt::{Bernoulli, Bounds, Looks, Sprt};

type Failure = Box<dyn std::error::Error>;

fn test(p0: f64, p1: f64, alpha: f64, beta: f64) -> Result<Sprt<Bernoulli>, Failure> {
    Ok(Sprt::new(Bernoulli::new(p0, p1)?, Bounds::from_risks(alpha, beta)?))
}

/// Whether the value rounds to what is printed with so many decimals.
fn prints(value: f64, decimals: usize, printed: &str) {
    assert_eq!(format!("{value:.decimals$}"), printed, "{value}");
}

#[test]
fn a_narrow_band_exceeds_a_nominal_risk() -> Result<(), Failure> {
    let narrow = test(0.1, 0.3, 0.44, 0.55)?;
    assert_eq!(narrow.characteristic(0.3)?.law().len(), 1);
    prints(narrow.characteristic(0.3)?.accept(), 12, "0.700000000000");
    let bounds = narrow.bounds();
    prints(bounds.ln_upper() - bounds.ln_lower(), 4, "0.0405");
    let paper = test(0.4, 0.6, 0.44, 0.55)?.looks(Looks::from(10).every(2)).truncate(100);
    prints(paper.family().success_increment(), 4, "0.4055");
    prints(paper.characteristic(0.6)?.accept(), 3, "0.228");
    prints(paper.characteristic(0.4)?.mean_samples(), 2, "10.77");
    prints(paper.wald_approximation(0.4)?.mean_samples(), 4, "0.0025");
    Ok(())
}

#[test]
fn calibration_takes_fewer() -> Result<(), Failure> {
    let best = Sprt::calibrated(Bernoulli::new(0.1, 0.3)?, 0.05, 0.1)?;
    prints(best.under_h0().mean_samples(), 1, "17.6");
    prints(best.under_h1().mean_samples(), 1, "15.9");
    Ok(())
}

/// The least sample of fixed size whose risks are not above those of the usual test.
#[test]
fn the_fixed_test_with_the_same_risks_takes_38() -> Result<(), Failure> {
    use statrs::distribution::{Binomial, DiscreteCDF as _};
    let usual = test(0.1, 0.3, 0.05, 0.1)?;
    let (alpha, beta) = (usual.characteristic(0.1)?.reject(), usual.characteristic(0.3)?.accept());
    let suffices = |samples: u64| -> Result<bool, Failure> {
        let (h0, h1) = (Binomial::new(0.1, samples)?, Binomial::new(0.3, samples)?);
        Ok((0..samples).any(|accept_to| h0.sf(accept_to) <= alpha && h1.cdf(accept_to) <= beta))
    };
    for samples in 1..38 {
        assert!(!suffices(samples)?, "{samples}");
    }
    assert!(suffices(38)?);
    Ok(())
}

#[test]
fn limits_cost_what_the_page_says() -> Result<(), Failure> {
    let open = test(0.1, 0.3, 0.05, 0.1)?;
    let quantiles = [0.99, 0.999].map(|q| open.characteristic(0.2).ok()?.quantile(q));
    assert_eq!(quantiles, [Some(111), Some(160)]);
    for (test, risks, undecided, mean) in [
        (open, ["0.0330", "0.0934"], ["0.0000", "0.0000", "0.0000"], ["18.53", "28.12", "18.38"]),
        (open.truncate(100), ["0.0329", "0.0934"], ["0.0007", "0.0158", "0.0007"], ["18.52", "27.76", "18.37"]),
        (open.truncate(64), ["0.0326", "0.0927"], ["0.0089", "0.0717", "0.0109"], ["18.39", "26.40", "18.23"]),
        (open.truncate(40), ["0.0304", "0.0872"], ["0.0703", "0.2210", "0.0717"], ["17.66", "23.18", "17.45"]),
    ] {
        prints(test.characteristic(0.1)?.reject(), 4, risks[0]);
        prints(test.characteristic(0.3)?.accept(), 4, risks[1]);
        for ((p, undecided), mean) in [0.1, 0.2, 0.3].into_iter().zip(undecided).zip(mean) {
            prints(test.characteristic(p)?.undecided(), 4, undecided);
            prints(test.characteristic(p)?.mean_samples(), 2, mean);
        }
    }
    let at_64 = open.truncate(64).characteristic(0.1)?;
    prints(at_64.reject() + at_64.undecided(), 4, "0.0415");
    Ok(())
}

#[test]
fn a_design_too_long_to_analyse_is_an_error() -> Result<(), Failure> {
    let long = test(0.5, 0.501, 0.05, 0.05)?;
    assert!(long.characteristic(0.5).is_err());
    prints(long.corrected_approximation(0.5)?.mean_samples() / 1e6, 1, "1.3");
    let usual = test(0.1, 0.3, 0.05, 0.1)?.characteristic(0.1)?;
    assert_eq!(format!("{:.1e} {:.1e}", usual.error_bound(), usual.mean_error_bound()), "1.3e-14 3.5e-13");
    Ok(())
}
