//! Cost of one observation, in the forms a run takes it, and of the exact characteristic.
//!
//! `sprt/push` and its peers are to be read as ratios to `sprt/reference`: a sum of logarithms and two comparisons,
//! which is what a test costs when ties do not matter. Each takes the same 4096 outcomes, restarting as it stops.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use steradian::sprt::{Bernoulli, Bounds, Decision, Looks, Sprt, Step};

const WORDS: usize = 64;

/// Outcomes of a fixed linear congruence, a success in five.
fn outcomes() -> Vec<bool> {
    let mut state = 1_u64;
    let next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % 5 == 0
    };
    std::iter::repeat_with(next).take(64 * WORDS).collect()
}

fn design(p0: f64, p1: f64, alpha: f64, beta: f64) -> Sprt<Bernoulli> {
    let family = Bernoulli::new(p0, p1).expect("hypotheses");
    Sprt::new(family, Bounds::from_risks(alpha, beta).expect("risks"))
}

/// Sum of logarithms, two comparisons; the number of rejections.
fn reference(test: &Sprt<Bernoulli>, outcomes: &[bool]) -> u32 {
    let (success, failure) = (test.family().success_increment(), test.family().failure_increment());
    let (upper, lower) = (test.bounds().ln_upper(), test.bounds().ln_lower());
    let (mut ratio, mut rejected) = (0.0, 0);
    for &outcome in outcomes {
        ratio += if outcome { success } else { failure };
        if ratio >= upper {
            rejected += 1;
            ratio = 0.0;
        } else if ratio <= lower {
            ratio = 0.0;
        }
    }
    rejected
}

fn pushed(test: &Sprt<Bernoulli>, outcomes: &[bool]) -> u32 {
    let (mut run, mut rejected) = (test.start(), 0);
    for &outcome in outcomes {
        match run.push(outcome) {
            Step::Continue => {}
            step => {
                rejected += u32::from(step == Step::Stop(Decision::RejectH0));
                run = test.start();
            }
        }
    }
    rejected
}

fn packed(test: &Sprt<Bernoulli>, words: &[u64]) -> u64 {
    let mut run = test.start();
    for &word in words {
        if run.push_bits(word, 64) != Step::Continue {
            break;
        }
    }
    run.samples()
}

fn observations(c: &mut Criterion) {
    let outcomes = outcomes();
    let pack = |word: &[bool]| word.iter().rev().fold(0, |bits, &outcome| bits << 1 | u64::from(outcome));
    let words: Vec<u64> = outcomes.chunks(64).map(pack).collect();
    let (brief, wide) = (design(0.1, 0.3, 0.05, 0.1), design(0.19, 0.21, 1e-9, 1e-9));
    assert_eq!(reference(&brief, &outcomes), pushed(&brief, &outcomes));
    assert_eq!(packed(&wide, &words), outcomes.len() as u64);

    let mut group = c.benchmark_group("sprt");
    group.throughput(Throughput::Elements(outcomes.len() as u64));
    group.bench_function("reference", |b| b.iter(|| reference(black_box(&brief), black_box(&outcomes))));
    group.bench_function("push", |b| b.iter(|| pushed(black_box(&brief), black_box(&outcomes))));
    let scheduled = brief.looks(Looks::from(10).every(2));
    group.bench_function("push/looks", |b| b.iter(|| pushed(black_box(&scheduled), black_box(&outcomes))));
    group.bench_function("reference/long", |b| b.iter(|| reference(black_box(&wide), black_box(&outcomes))));
    group.bench_function("push/long", |b| b.iter(|| pushed(black_box(&wide), black_box(&outcomes))));
    group.bench_function("push_bits/long", |b| b.iter(|| packed(black_box(&wide), black_box(&words))));
    group.finish();
}

fn characteristic(c: &mut Criterion) {
    let mut group = c.benchmark_group("sprt/characteristic");
    for (p0, p1, alpha, beta, p, mean) in [
        (0.1, 0.3, 0.05, 0.1, 0.1, 18.526_871_930_843),
        (0.1, 0.3, 0.05, 0.1, 0.2, 28.1),
        (0.5, 0.6, 0.05, 0.05, 0.5, 135.149_376_201_459),
        (0.1, 0.3, 1e-12, 1e-12, 0.1, 238.630_555_009_375),
        (0.5, 0.52, 0.05, 0.05, 0.51, 5_483.393_388_711),
    ] {
        let test = design(p0, p1, alpha, beta);
        let got = test.characteristic(p).expect("a short design").mean_samples();
        assert!((got - mean).abs() < 0.05, "{got} {mean}");
        let name = format!("{p0}-{p1}-{alpha}-{beta}");
        group.bench_with_input(BenchmarkId::new(name, p), &p, |b, &p| {
            b.iter(|| black_box(&test).characteristic(black_box(p)));
        });
    }
    group.finish();
    let test = design(0.1, 0.3, 0.05, 0.1);
    c.bench_function("sprt/wald_approximation", |b| b.iter(|| black_box(&test).wald_approximation(black_box(0.2))));
}

criterion_group!(benches, observations, characteristic);
criterion_main!(benches);
