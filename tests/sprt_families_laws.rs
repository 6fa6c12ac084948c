//! Law: the characteristics of Poisson, normal and exponential tests obey Wald's inequalities, the symmetries of their
//! families, brute enumeration and simulation.
//!
//! Statistical tests, H0: each of the `RUNS` runs of a design is an independent draw from the exact law. Two-sided
//! binomial tests of the decisions; Kolmogorov–Smirnov, and chi-square over cells of at least `CELL` expected runs, for N.
//! Suite-wide alpha 1e-6; this file takes 1e-8 of it, shared equally by its `TESTS` comparisons.

mod bounds;
mod seeds;

use bounds::sprt_families::bound;
use proptest::prelude::*;
use rand::RngExt as _;
use rand_pcg::Pcg64;
use statrs::distribution::{Binomial, ChiSquared, ContinuousCDF, DiscreteCDF};
use steradian::sprt::{
    Bounds, Characteristic, CharacteristicError, Decision, Exponential, Family, Looks, Normal, Poisson, Sprt, Step,
};

const RUNS: u32 = 500_000;
const CELL: f64 = 100.0;
const ALPHA: f64 = 1e-8;
const TESTS: f64 = 6.0 * 4.0;

type Failure = Box<dyn std::error::Error>;

/// What the three families have in common.
trait Exact: Family + PartialEq + core::fmt::Debug {
    const NAME: &'static str;
    /// The parameter that is `part` of the way from H0 to H1.
    fn between(&self, part: f64) -> f64;
    fn swapped(&self) -> Self;
    fn at(test: &Sprt<Self>, parameter: f64) -> Result<Characteristic, CharacteristicError>;
    fn draw(parameter: f64, rng: &mut Pcg64) -> Self::Observation;
}

impl Exact for Poisson {
    const NAME: &'static str = "poisson";
    fn between(&self, part: f64) -> f64 {
        self.rate0() * (1.0 - part) + self.rate1() * part
    }
    fn swapped(&self) -> Self {
        Self::new(self.rate1(), self.rate0()).expect("two rates stay two rates")
    }
    fn at(test: &Sprt<Self>, rate: f64) -> Result<Characteristic, CharacteristicError> {
        test.characteristic(rate)
    }
    fn draw(rate: f64, rng: &mut Pcg64) -> u64 {
        // The number of exponential times before they sum to 1.
        let (mut left, mut count) = (1.0, 0);
        loop {
            left -= Exponential::draw(rate, rng);
            if left < 0.0 {
                return count;
            }
            count += 1;
        }
    }
}

impl Exact for Exponential {
    const NAME: &'static str = "exponential";
    fn between(&self, part: f64) -> f64 {
        self.rate0() * (1.0 - part) + self.rate1() * part
    }
    fn swapped(&self) -> Self {
        Self::new(self.rate1(), self.rate0()).expect("two rates stay two rates")
    }
    fn at(test: &Sprt<Self>, rate: f64) -> Result<Characteristic, CharacteristicError> {
        test.characteristic(rate)
    }
    fn draw(rate: f64, rng: &mut Pcg64) -> f64 {
        -(1.0 - rng.random::<f64>()).ln() / rate
    }
}

impl Exact for Normal {
    const NAME: &'static str = "normal";
    fn between(&self, part: f64) -> f64 {
        self.mean0() * (1.0 - part) + self.mean1() * part
    }
    fn swapped(&self) -> Self {
        Self::new(self.mean1(), self.mean0(), self.deviation()).expect("two means stay two means")
    }
    fn at(test: &Sprt<Self>, mean: f64) -> Result<Characteristic, CharacteristicError> {
        test.characteristic(mean)
    }
    /// Box and Muller, for a deviation of 1.
    fn draw(mean: f64, rng: &mut Pcg64) -> f64 {
        let radius = (2.0 * Exponential::draw(1.0, rng)).sqrt();
        mean + radius * (core::f64::consts::TAU * rng.random::<f64>()).cos()
    }
}

/// A design: boundaries as risks, a schedule and a limit.
type Plan = (f64, f64, u32, u32, Option<u64>);

fn plans() -> impl Strategy<Value = Plan> {
    (0.001..0.45, 0.001..0.45, 1_u32..6, 1_u32..5, proptest::option::of(1_u64..60))
}

fn planned<F: Family>(family: F, (alpha, beta, first, step, limit): Plan) -> Result<Sprt<F>, Failure> {
    let test = Sprt::new(family, Bounds::from_risks(alpha, beta)?).looks(Looks::from(first).every(step));
    Ok(limit.map_or(test, |limit| test.truncate(limit)))
}

fn near(label: &str, got: f64, want: f64, slack: f64) {
    assert!((got - want).abs() <= slack, "{label}: got {got:e}, want {want:e}, slack {slack:e}");
}

/// The laws that hold for each family, each look schedule and each limit.
fn check_laws<F: Exact>(family: F, plan: Plan, part: f64) -> Result<(), Failure> {
    let test = planned(family, plan)?;
    let label = format!("{family:?} {plan:?} {part}");
    let (under0, under1) = (F::at(&test, family.between(0.0))?, F::at(&test, family.between(1.0))?);
    let between = F::at(&test, family.between(part))?;
    for exact in [&under0, &under1, &between] {
        let total = exact.accept() + exact.reject() + exact.undecided();
        near(&format!("{label}: total"), total, 1.0, exact.error_bound());
        assert!(exact.error_bound() < bound(F::NAME, "own bound, absolute"), "{label}: {:e}", exact.error_bound());
        let law = exact.law();
        assert!(law.iter().all(|point| point.accept >= 0.0 && point.reject >= 0.0), "{label}");
        assert!(law.windows(2).all(|pair| pair[0].samples < pair[1].samples), "{label}");
        let sum: f64 = law.iter().map(|point| point.accept).sum();
        near(&format!("{label}: law"), sum, exact.accept(), exact.error_bound());
    }
    // Wald's inequalities, for any looks and limit; the sum of the risks without limit.
    let slack = under0.error_bound() + under1.error_bound();
    let (upper, lower) = (test.bounds().upper(), test.bounds().lower());
    assert!(under0.reject() <= under1.reject() / upper + slack, "{label}: first risk {}", under0.reject());
    assert!(under1.accept() <= under0.accept() * lower + slack, "{label}: second risk {}", under1.accept());
    if test.truncation().is_none() {
        let risks = under0.reject() + under1.accept();
        assert!(risks <= plan.0 + plan.1 + slack, "{label}: the risks sum to {risks}");
    } else {
        // A later limit leaves less undecided, and takes nothing away from either side.
        let later = F::at(&test.truncate(plan.4.unwrap_or(1) + 7), family.between(part))?;
        let open = F::at(&test.truncate(u64::MAX), family.between(part))?;
        let slack = later.error_bound() + between.error_bound() + open.error_bound();
        assert!(later.undecided() <= between.undecided() + slack, "{label}");
        // The last look of the earlier limit need not be one of the later: that look is compared by nothing.
        if plan.3 == 1 && plan.4.is_some_and(|limit| limit >= u64::from(plan.2)) {
            for (early, late, last) in [
                (between.accept(), later.accept(), open.accept()),
                (between.reject(), later.reject(), open.reject()),
                (between.mean_samples(), later.mean_samples(), open.mean_samples()),
            ] {
                let slack = slack + open.mean_error_bound();
                assert!(early <= late + slack && late <= last + slack, "{label}: {early} {late} {last}");
            }
        }
    }
    // Swapping the hypotheses and the risks swaps the decisions.
    let swapped = planned(family.swapped(), (plan.1, plan.0, plan.2, plan.3, plan.4))?;
    let mirror = F::at(&swapped, family.between(part))?;
    let slack = mirror.error_bound() + between.error_bound();
    near(&format!("{label}: swapped"), mirror.accept(), between.reject(), slack);
    near(&format!("{label}: swapped"), mirror.reject(), between.accept(), slack);
    near(
        &format!("{label}: swapped mean"),
        mirror.mean_samples(),
        between.mean_samples(),
        mirror.mean_error_bound() + between.mean_error_bound(),
    );
    Ok(())
}

proptest! {
    #![proptest_config(seeds::config(48))]

    #[test]
    fn poisson_tests_obey_the_laws(rate in 0.05..5.0, ratio in 1.3..4.0, plan in plans(), part in -0.2..1.5) {
        check_laws(Poisson::new(rate, rate * ratio).expect("rates"), plan, part).expect("within the budget");
    }

    #[test]
    fn normal_tests_obey_the_laws(mean in -3.0..3.0, shift in 0.3..4.0, plan in plans(), part in -1.0..2.0) {
        check_laws(Normal::new(mean, mean + shift, 1.5).expect("means"), plan, part).expect("within the budget");
    }

    #[test]
    fn exponential_tests_obey_the_laws(rate in 0.05..5.0, ratio in 1.4..20.0, plan in plans(), part in -0.04..2.0) {
        check_laws(Exponential::new(rate, rate * ratio).expect("rates"), plan, part).expect("within the budget");
    }

    #[test]
    fn a_change_of_scale_by_a_power_of_two_changes_no_bit(plan in plans(), exponent in -30_i32..30, part in 0.0..1.0) {
        let scale = 2.0_f64.powi(exponent);
        let normal = |by: f64| planned(Normal::new(-0.3 * by, 0.9 * by, 1.1 * by).expect("means"), plan);
        let exponential = |by: f64| planned(Exponential::new(0.7 * by, 1.9 * by).expect("rates"), plan);
        let (one, other) = (normal(1.0).expect("a plan"), normal(scale).expect("a plan"));
        let mean = one.family().between(part);
        prop_assert_eq!(one.characteristic(mean), other.characteristic(mean * scale));
        let (one, other) = (exponential(1.0).expect("a plan"), exponential(scale).expect("a plan"));
        let rate = one.family().between(part);
        prop_assert_eq!(one.characteristic(rate), other.characteristic(rate * scale));
    }

    /// The time by which the lower boundary is passed is exponential, whatever went before: for each N, the ratio of
    /// the two probabilities of acceptance is B·λ₀/λ₁, and of rejection A·λ₀/λ₁ where the rate falls.
    #[test]
    fn the_overshoot_of_exponential_tests_is_exponential(ratio in 1.4..20.0, alpha in 0.01..0.4, beta in 0.01..0.4) {
        let tight = bound("exponential", "overshoot");
        let bounds = Bounds::from_risks(alpha, beta).expect("risks");
        for (rate0, rate1) in [(1.0, ratio), (ratio, 1.0)] {
            let test = Sprt::new(Exponential::new(rate0, rate1).expect("rates"), bounds);
            let under0 = test.characteristic(rate0).expect("within the budget");
            let under1 = test.characteristic(rate1).expect("within the budget");
            for (null, other) in under0.law().iter().zip(under1.law()) {
                let (got, from, boundary) = if rate0 < rate1 {
                    (other.accept, null.accept, bounds.lower())
                } else {
                    (other.reject, null.reject, bounds.upper())
                };
                let want = from * boundary * rate0 / rate1;
                prop_assert!((got - want).abs() <= tight * want, "{rate0} {rate1}: {null:?} {other:?}");
            }
        }
    }

    /// Wald's identity bounds the mean overshoot on the other side, which is at most one step.
    #[test]
    fn the_mean_logarithm_is_the_mean_of_one_times_the_mean_number(ratio in 1.4..9.0, part in 0.0..1.0) {
        let (family, bounds) = (Exponential::new(1.0, ratio).expect("rates"), Bounds::from_risks(0.1, 0.2).expect("risks"));
        let rate = family.between(part);
        let exact = Sprt::new(family, bounds).characteristic(rate).expect("within the budget");
        let (step, overshoot) = (ratio.ln(), (ratio - 1.0) / rate);
        let sum = exact.mean_samples() * (step - overshoot) - exact.accept() * (bounds.ln_lower() - overshoot);
        let above = sum / exact.reject() - bounds.ln_upper();
        prop_assert!(above > 0.0 && above < step, "{above} of {step}");
    }
}

/// One count at a time, with every total kept until a look.
fn enumerated(test: &Sprt<Poisson>, rate: f64, limit: u64) -> (f64, f64, f64) {
    let terms: Vec<f64> = (1..200)
        .scan((-rate).exp(), |term, k| {
            let here = *term;
            *term *= rate / f64::from(k);
            Some(here)
        })
        .collect();
    let mut cells = vec![1.0];
    let (mut accept, mut reject) = (0.0, 0.0);
    let looks = test.look_schedule();
    for n in 1..=limit {
        let mut next = vec![0.0; cells.len() + terms.len()];
        for (x, cell) in cells.iter().enumerate() {
            for (k, term) in terms.iter().enumerate() {
                next[x + k] += cell * term;
            }
        }
        cells = next;
        let is_look = n == limit || n >= looks.first() && (n - looks.first()) % looks.step() == 0;
        for (x, cell) in cells.iter_mut().enumerate().filter(|_| is_look) {
            match test.family().decide(n, &(x as u64), test.bounds()) {
                Some(Decision::AcceptH0) => accept += core::mem::take(cell),
                Some(Decision::RejectH0) => reject += core::mem::take(cell),
                None => {}
            }
        }
    }
    (accept, reject, cells.iter().sum())
}

#[test]
fn poisson_tests_with_looks_agree_with_enumeration() -> Result<(), Failure> {
    let tight = bound("poisson", "enumeration");
    for (rate0, rate1, rate, first, step, limit) in
        [(1.0, 2.0, 1.4, 1, 1, 30), (0.3, 0.5, 0.4, 10, 2, 41), (2.0, 1.0, 1.5, 3, 7, 25), (4.0, 5.0, 9.0, 1, 5, 12)]
    {
        let test = planned(Poisson::new(rate0, rate1)?, (0.1, 0.05, first, step, Some(limit)))?;
        let (exact, want) = (test.characteristic(rate)?, enumerated(&test, rate, limit));
        for (got, want) in [(exact.accept(), want.0), (exact.reject(), want.1), (exact.undecided(), want.2)] {
            near(&format!("{rate0} {rate1} {rate}"), got, want, tight * want);
        }
    }
    Ok(())
}

#[test]
fn degenerate_parameters_are_right() -> Result<(), Failure> {
    let bounds = Bounds::from_risks(0.05, 0.05)?;
    let poisson = Sprt::new(Poisson::new(1.0, 2.0)?, bounds);
    let nothing = poisson.characteristic(0.0)?; // 19 < e³
    assert_eq!((nothing.accept(), nothing.mean_samples(), nothing.quantile(1.0)), (1.0, 3.0, Some(3)));
    for huge in [1e3, 1e12, 1e300] {
        assert_eq!(poisson.characteristic(huge)?.reject(), 1.0, "{huge}");
    }
    let normal = Sprt::new(Normal::new(0.0, 1.0, 1.0)?, bounds);
    for huge in [1e3, 1e150, f64::MAX] {
        assert_eq!((normal.characteristic(huge)?.reject(), normal.characteristic(-huge)?.accept()), (1.0, 1.0));
    }
    let exponential = Sprt::new(Exponential::new(1.0, 2.0)?, bounds);
    for huge in [1e4, 1e12, f64::MAX] {
        let exact = exponential.characteristic(huge)?; // 19 is between 2⁴ and 2⁵
        assert_eq!((exact.reject(), exact.mean_samples()), (1.0, 5.0), "{huge}");
    }
    for tiny in [1e-20, f64::MIN_POSITIVE] {
        assert_eq!(exponential.characteristic(tiny)?.accept(), 1.0, "{tiny}");
    }
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(matches!(poisson.characteristic(bad), Err(CharacteristicError::Rate { .. })));
        assert!(matches!(exponential.characteristic(bad), Err(CharacteristicError::Rate { .. })));
    }
    assert!(matches!(exponential.characteristic(0.0), Err(CharacteristicError::Rate { .. })));
    assert!(matches!(normal.characteristic(f64::NAN), Err(CharacteristicError::Mean { .. })));
    Ok(())
}

#[test]
fn no_input_panics_or_gives_a_nan() -> Result<(), Failure> {
    let values = [5e-324, 1e-300, 1e-9, 0.3, 1.0, 1.0 + f64::EPSILON, 1.7, 40.0, 1e9, 1e18, 1e300, f64::MAX];
    let check = |label: &str, result: Result<Characteristic, CharacteristicError>| {
        let Ok(exact) = result else { return };
        for value in [exact.accept(), exact.reject(), exact.undecided()] {
            assert!((0.0..=1.0 + 1e-12).contains(&value), "{label}: {exact:?}");
        }
        assert!(exact.mean_samples() >= 1.0 && exact.mean_samples().is_finite(), "{label}: {exact:?}");
        assert!(exact.error_bound() >= 0.0 && exact.mean_error_bound() >= 0.0, "{label}: {exact:?}");
    };
    for bounds in [
        Bounds::from_risks(0.05, 0.1)?,
        Bounds::from_risks(1e-300, 1e-300)?,
        Bounds::from_ratios(1.0 + f64::EPSILON, 0.5)?,
    ] {
        for (one, other) in values.iter().flat_map(|one| values.map(|other| (*one, other))) {
            for (looks, limit) in
                [(Looks::default(), u64::MAX), (Looks::from(3).every(2), 8), (Looks::from(u32::MAX), 5)]
            {
                for at in [5e-324, 1e-9, 1.0, 1.3, 1e9, f64::MAX] {
                    let label = format!("{one:e} {other:e} at {at:e}, {looks:?} {limit}");
                    if let Ok(family) = Poisson::new(one, other) {
                        let test = Sprt::new(family, bounds).looks(looks).truncate(limit);
                        check(&label, test.characteristic_within(at, 1 << 16));
                    }
                    if let Ok(family) = Exponential::new(one, other) {
                        let test = Sprt::new(family, bounds).looks(looks).truncate(limit);
                        check(&label, test.characteristic_within(at, 1 << 16));
                    }
                    if let Ok(family) = Normal::new(-one, one, other) {
                        let test = Sprt::new(family, bounds).looks(looks).truncate(limit);
                        check(&label, test.characteristic_within(-at, 1 << 16));
                    }
                }
            }
        }
    }
    Ok(())
}

/// Fails if `count` of `runs` is in a tail of probability `alpha/2`.
fn check_count(label: &str, count: u64, probability: f64, runs: u64, alpha: f64) -> Result<(), Failure> {
    let law = Binomial::new(probability.clamp(0.0, 1.0), runs)?;
    let below = law.cdf(count);
    let above = if count == 0 { 1.0 } else { law.sf(count - 1) };
    assert!(
        below.min(above) > alpha / 2.0,
        "{label}: {count} of {runs}, want {}; tails {below:e}, {above:e}, seed {}",
        probability * runs as f64,
        seeds::seed(),
    );
    Ok(())
}

fn simulate<F: Exact>(stream: u64, test: Sprt<F>, parameter: f64) -> Result<(), Failure> {
    let (alpha, runs) = (ALPHA / TESTS, seeds::cases(RUNS));
    let exact = F::at(&test, parameter)?;
    let mut rng = seeds::rng(1000 + stream);
    let (mut accepted, mut rejected) = (0, 0);
    let mut lengths = std::collections::BTreeMap::<u64, u64>::new();
    for _ in 0..runs {
        let mut run = test.start();
        while run.push(F::draw(parameter, &mut rng)) == Step::Continue {}
        match run.decision() {
            Some(Decision::AcceptH0) => accepted += 1,
            Some(Decision::RejectH0) => rejected += 1,
            None => {}
        }
        let samples = run.decision().map_or(u64::MAX, |_| run.samples());
        *lengths.entry(samples).or_default() += 1;
    }
    let label = |what| format!("{} {stream}: {what}", F::NAME);
    check_count(&label("accepted"), accepted, exact.accept(), runs.into(), alpha)?;
    check_count(&label("rejected"), rejected, exact.reject(), runs.into(), alpha)?;

    // Kolmogorov–Smirnov of N; the critical distance of Dvoretzky, Kiefer, Wolfowitz and Massart holds for discrete laws.
    let (mut by_now, mut probability, mut distance, mut from) = (0, 0.0, 0.0_f64, 0);
    for point in exact.law() {
        by_now += lengths.range(from..=point.samples).map(|(_, count)| count).sum::<u64>();
        from = point.samples + 1;
        probability += point.accept + point.reject;
        distance = distance.max((by_now as f64 / f64::from(runs) - probability).abs());
    }
    let largest = ((2.0 / alpha).ln() / (2.0 * f64::from(runs))).sqrt();
    assert!(distance <= largest, "{}: {distance}, critical {largest}, seed {}", label("distance"), seeds::seed());

    // Chi-square of N, over cells merged from the left; the last takes what is left, the undecided included.
    let (mut statistic, mut cells) = (0.0, 0_u32);
    let (mut want, mut expected_left, mut seen_left, mut from) = (0.0, f64::from(runs), u64::from(runs), 0);
    for point in exact.law() {
        want += f64::from(runs) * (point.accept + point.reject);
        if want >= CELL && expected_left - want >= CELL {
            let seen: u64 = lengths.range(from..=point.samples).map(|(_, count)| count).sum();
            statistic += (seen as f64 - want).powi(2) / want;
            (cells, from, expected_left, seen_left) =
                (cells + 1, point.samples + 1, expected_left - want, seen_left - seen);
            want = 0.0;
        }
    }
    statistic += (seen_left as f64 - expected_left).powi(2) / expected_left;
    assert!(cells >= 3, "{}: {cells} cells", label("law"));
    let critical = ChiSquared::new(f64::from(cells))?.inverse_cdf(1.0 - alpha);
    let seed = seeds::seed();
    assert!(
        statistic <= critical,
        "{}: {statistic} over {cells} + 1 cells, critical {critical}, seed {seed}",
        label("law")
    );
    Ok(())
}

#[test]
fn simulated_poisson_tests_follow_the_exact_law() -> Result<(), Failure> {
    simulate(0, planned(Poisson::new(1.0, 2.0)?, (0.05, 0.1, 1, 1, None))?, 1.5)?;
    simulate(1, planned(Poisson::new(0.5, 0.3)?, (0.05, 0.1, 5, 3, Some(30)))?, 0.3)
}

#[test]
fn simulated_normal_tests_follow_the_exact_law() -> Result<(), Failure> {
    simulate(2, planned(Normal::new(0.0, 0.7, 1.0)?, (0.05, 0.1, 1, 1, None))?, 0.2)?;
    simulate(3, planned(Normal::new(0.5, -0.2, 1.0)?, (0.05, 0.1, 5, 3, Some(30)))?, -0.2)
}

#[test]
fn simulated_exponential_tests_follow_the_exact_law() -> Result<(), Failure> {
    simulate(4, planned(Exponential::new(1.0, 2.0)?, (0.05, 0.1, 1, 1, None))?, 1.3)?;
    simulate(5, planned(Exponential::new(2.0, 1.0)?, (0.05, 0.1, 5, 3, Some(30)))?, 1.3)
}
