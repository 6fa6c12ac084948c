//! Law: the approximations of normal, Poisson and exponential tests are Wald's, at zero drift too, and the corrected ones near.

use steradian::sprt::{
    Approximation, Bounds, Characteristic, CharacteristicError, Exponential, Family, Normal, Poisson, Sprt,
};

mod bounds;
use bounds::sprt_families::bound;

type Failure = Box<dyn std::error::Error>;

/// A family with both approximations.
trait Approximate: Family {
    const NAME: &str;
    /// The parameter without drift, if it is strictly between the hypotheses.
    fn level(&self) -> f64;
    fn ends(&self) -> [f64; 2];
    fn exact(test: &Sprt<Self>, at: f64) -> Result<Characteristic, CharacteristicError>;
    fn wald(test: &Sprt<Self>, at: f64) -> Result<Approximation, CharacteristicError>;
    fn corrected(test: &Sprt<Self>, at: f64) -> Result<Approximation, CharacteristicError>;
}

macro_rules! approximate {
    ($family:ty, $name:literal, $level:expr, $ends:expr) => {
        impl Approximate for $family {
            const NAME: &str = $name;
            fn level(&self) -> f64 {
                $level(self)
            }
            fn ends(&self) -> [f64; 2] {
                $ends(self)
            }
            fn exact(test: &Sprt<Self>, at: f64) -> Result<Characteristic, CharacteristicError> {
                test.characteristic(at)
            }
            fn wald(test: &Sprt<Self>, at: f64) -> Result<Approximation, CharacteristicError> {
                test.wald_approximation(at)
            }
            fn corrected(test: &Sprt<Self>, at: f64) -> Result<Approximation, CharacteristicError> {
                test.corrected_approximation(at)
            }
        }
    };
}

/// The rate at which counts, or times, have no drift.
fn middle(rate0: f64, rate1: f64) -> f64 {
    (rate1 - rate0) / ((rate1 - rate0) / rate0).ln_1p()
}

approximate!(Normal, "normal", |f: &Normal| 0.5 * (f.mean0() + f.mean1()), |f: &Normal| [f.mean0(), f.mean1()]);
approximate!(Poisson, "poisson", |f: &Poisson| middle(f.rate0(), f.rate1()), |f: &Poisson| [f.rate0(), f.rate1()]);
approximate!(Exponential, "exponential", |f: &Exponential| middle(f.rate0(), f.rate1()), |f: &Exponential| [
    f.rate0(),
    f.rate1()
]);

fn check<F: Approximate>(family: F, risks: [f64; 2]) -> Result<(), Failure> {
    let test = Sprt::new(family, Bounds::from_risks(risks[0], risks[1])?);
    let (a, b) = (test.bounds().upper(), test.bounds().lower());
    let ([under0, under1], level) = (family.ends(), family.level());
    for (at, accept) in [(under0, (a - 1.0) / (a - b)), (under1, b * (a - 1.0) / (a - b))] {
        // Here the other root is 1, or −1.
        let (wald, exact, corrected) = (F::wald(&test, at)?, F::exact(&test, at)?, F::corrected(&test, at)?);
        let error = (wald.accept() / accept - 1.0).abs();
        let name = format!("{} {under0} {under1} at {at}", F::NAME);
        assert!(error <= bound(F::NAME, "Wald's formula"), "{name}: {} {accept} {error:e}", wald.accept());
        near(F::NAME, &name, &corrected, &exact);
        assert!(
            (corrected.mean_samples() - exact.mean_samples()).abs()
                < (wald.mean_samples() - exact.mean_samples()).abs(),
            "{name}: the correction makes it worse"
        );
    }
    near(F::NAME, "no drift", &F::corrected(&test, level)?, &F::exact(&test, level)?);
    // Towards zero drift the values join those of a drift that is small, but not lost in rounding: no digits go.
    for of in [F::wald, F::corrected] {
        let middle = of(&test, level)?;
        for step in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
            let (low, high) =
                (of(&test, level - step * (level - under0))?, of(&test, level + step * (level - under0))?);
            for [low, middle, high] in [
                [low.accept(), middle.accept(), high.accept()],
                [low.mean_samples(), middle.mean_samples(), high.mean_samples()],
            ] {
                // Of a smooth function the middle of two neighbours misses the square of the step, here at most 9 of it.
                let error = ((low + high) / 2.0 / middle - 1.0).abs();
                let allowed = 9.0 * step * step + bound(F::NAME, "Wald's formula");
                assert!(error <= allowed, "{} {under0} {under1}: {step} {low} {middle} {high} {error:e}", F::NAME);
            }
        }
    }
    Ok(())
}

fn near(family: &str, name: &str, got: &Approximation, exact: &Characteristic) {
    let accept = (got.accept() - exact.accept()).abs();
    let mean = (got.mean_samples() / exact.mean_samples() - 1.0).abs();
    println!("{family} {name}: {accept:.1e} {mean:.1e}");
    assert!((got.accept() + got.reject() - 1.0).abs() < 4.0 * f64::EPSILON, "{name}: {got:?}");
    assert!(accept <= bound(family, "corrected accept, absolute"), "{family} {name}: {accept:e}");
    assert!(mean <= bound(family, "corrected mean"), "{family} {name}: {mean:e}");
}

#[test]
fn approximations_are_walds_and_corrected_ones_near() -> Result<(), Failure> {
    for risks in [[0.05, 0.05], [0.05, 0.1], [0.01, 0.2]] {
        for shift in [0.3, 0.5, 1.0, -1.0] {
            check(Normal::new(2.0, 2.0 + 3.0 * shift, 3.0)?, risks)?;
        }
        for (one, other) in [(0.01, 0.03), (0.1, 0.2), (1.0, 2.0), (2.0, 1.0), (4.0, 5.0), (20.0, 22.0)] {
            check(Poisson::new(one, other)?, risks)?;
        }
        for (one, other) in [(1.0, 1.3), (1.0, 2.0), (2.0, 1.0), (1.0, 4.0), (30.0, 20.0)] {
            check(Exponential::new(one, other)?, risks)?;
        }
    }
    Ok(())
}

#[test]
fn ends_of_the_range_are_finite_and_refused_beyond() -> Result<(), Failure> {
    let bounds = Bounds::from_risks(0.05, 0.1)?;
    let poisson = [Poisson::new(1.0, 2.0)?, Poisson::new(1e-300, 1e300)?, Poisson::new(2.0, 1.0)?];
    let exponential = [Exponential::new(1.0, 2.0)?, Exponential::new(1e-300, 1e300)?, Exponential::new(2.0, 1.0)?];
    for of in [Sprt::<Poisson>::wald_approximation, Sprt::<Poisson>::corrected_approximation] {
        for family in poisson {
            ends(|rate| of(&Sprt::new(family, bounds), rate));
        }
    }
    for of in [Sprt::<Exponential>::wald_approximation, Sprt::<Exponential>::corrected_approximation] {
        for family in exponential {
            ends(|rate| of(&Sprt::new(family, bounds), rate));
        }
    }
    for family in [Normal::new(0.0, 1.0, 1.0)?, Normal::new(0.0, 1e-300, 1.0)?, Normal::new(1e300, -1e300, 1e-3)?] {
        let test = Sprt::new(family, bounds);
        for mean in [f64::MIN, -1e3, 0.0, 0.5, 1e3, f64::MAX] {
            for got in [test.wald_approximation(mean)?, test.corrected_approximation(mean)?] {
                is_sound(&got, mean);
            }
        }
        assert!(matches!(test.wald_approximation(f64::NAN), Err(CharacteristicError::Mean { .. })));
    }
    Ok(())
}

fn ends(of: impl Fn(f64) -> Result<Approximation, CharacteristicError>) {
    for rate in [f64::from_bits(1), 1e-300, 1e-9, 0.5, 1.0, 2.0, 1e9, 1e300, f64::MAX] {
        is_sound(&of(rate).expect("a rate"), rate);
    }
    for bad in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        assert!(matches!(of(bad), Err(CharacteristicError::Rate { .. })), "{bad}");
    }
}

fn is_sound(got: &Approximation, at: f64) {
    assert!((got.accept() + got.reject() - 1.0).abs() < 4.0 * f64::EPSILON, "{at:e}: {got:?}");
    assert!(got.accept() >= 0.0 && got.reject() >= 0.0 && got.mean_samples() >= 0.0, "{at:e}: {got:?}");
    assert!(got.mean_samples().is_finite(), "{at:e}: {got:?}");
}
