//! Cost of one observation, in the forms a run takes it, of the exact characteristic and of the approximations.
//!
//! `sprt/push` and its peers are to be read as ratios to `sprt/baseline`: a sum of logarithms and two comparisons,
//! which is what a test costs when ties do not matter. The table of these ratios in `docs/sprt.md`, from measurements in
//! turns, comes first: `cargo bench --bench sprt`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
use std::hint::black_box;

mod forms;
mod ratios;
use forms::{OUTCOMES, baseline, brief, design, long, outcomes, packed, peer, peer_pushed, pushed, scheduled, words};

fn observations(c: &mut Criterion) {
    let outcomes = outcomes();
    let words = words(&outcomes);
    let (brief, scheduled, long) = (brief(), scheduled(), long());
    let (brief_peer, long_peer) = (peer(&brief, 0.05, 0.1), peer(&long, 1e-9, 1e-9));
    assert_eq!(baseline(&brief, &outcomes), pushed(&brief, &outcomes));
    assert_eq!(baseline(&brief, &outcomes), peer_pushed(&brief_peer, &outcomes));
    for rejected in [baseline(&long, &outcomes), pushed(&long, &outcomes), packed(&long, &words)] {
        assert_eq!(rejected, 0);
    }

    let mut group = c.benchmark_group("sprt");
    group.throughput(Throughput::Elements(OUTCOMES as u64));
    group.bench_function("baseline", |b| b.iter(|| baseline(black_box(&brief), black_box(&outcomes))));
    group.bench_function("push", |b| b.iter(|| pushed(black_box(&brief), black_box(&outcomes))));
    group.bench_function("push/looks", |b| b.iter(|| pushed(black_box(&scheduled), black_box(&outcomes))));
    group.bench_function("push/nexus", |b| b.iter(|| peer_pushed(black_box(&brief_peer), black_box(&outcomes))));
    group.bench_function("baseline/long", |b| b.iter(|| baseline(black_box(&long), black_box(&outcomes))));
    group.bench_function("push/long", |b| b.iter(|| pushed(black_box(&long), black_box(&outcomes))));
    group.bench_function("push/long/nexus", |b| b.iter(|| peer_pushed(black_box(&long_peer), black_box(&outcomes))));
    group.bench_function("push_bits/long", |b| b.iter(|| packed(black_box(&long), black_box(&words))));
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
    let test = brief();
    let exact = test.characteristic(0.2).expect("a short design").mean_samples();
    let error = |approximate: f64| (approximate / exact - 1.0).abs();
    assert!(error(test.wald_approximation(0.2).expect("p").mean_samples()) < 0.2);
    assert!(error(test.corrected_approximation(0.2).expect("p").mean_samples()) < 0.05);
    c.bench_function("sprt/wald_approximation", |b| b.iter(|| black_box(&test).wald_approximation(black_box(0.2))));
    c.bench_function("sprt/corrected_approximation", |b| {
        b.iter(|| black_box(&test).corrected_approximation(black_box(0.2)));
    });
}

criterion_group!(benches, observations, characteristic);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Without this argument Criterion only tries everything once, and so does the table.
    let rounds = if std::env::args().any(|argument| argument == "--bench") { 31 } else { 1 };
    ratios::print(&mut std::io::stdout(), rounds)?;
    benches();
    Criterion::default().configure_from_args().final_summary();
    Ok(())
}
