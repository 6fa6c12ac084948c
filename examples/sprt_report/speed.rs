//! Times every form in turns, round after round, so that a busy machine slows all of them alike.

use std::{error::Error, hint::black_box, io::Write, time::Instant};

use super::forms::{
    OUTCOMES, baseline, brief, design, long, outcomes, packed, peer, peer_pushed, pushed, scheduled, words,
};

/// Something to time: its name, the place of its baseline among the jobs, how many times a measurement repeats it, and
/// how many units of work one call is.
struct Job<'a> {
    name: &'a str,
    reference: usize,
    repeat: u32,
    units: f64,
    call: Box<dyn Fn() + 'a>,
}

impl Job<'_> {
    /// Nanoseconds a unit.
    fn time(&self) -> f64 {
        let start = Instant::now();
        for _ in 0..self.repeat {
            (self.call)();
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(self.repeat) / self.units
    }
}

/// Least and median.
fn summary(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    (sorted[0], sorted[sorted.len() / 2])
}

pub fn print(out: &mut impl Write, rounds: u16) -> Result<(), Box<dyn Error>> {
    let outcomes = outcomes();
    let words = words(&outcomes);
    let (brief, scheduled, long) = (brief(), scheduled(), long());
    let (brief_peer, long_peer) = (peer(&brief, 0.05, 0.1), peer(&long, 1e-9, 1e-9));
    let rejected = baseline(&brief, &outcomes);
    assert_eq!((pushed(&brief, &outcomes), peer_pushed(&brief_peer, &outcomes)), (rejected, rejected));
    assert_eq!([baseline(&long, &outcomes), pushed(&long, &outcomes), packed(&long, &words)], [0; 3]);

    let units = OUTCOMES as f64;
    let job = |name, reference, call| Job { name, reference, repeat: 8, units, call };
    let (b, s, l, o, w) = (&brief, &scheduled, &long, &outcomes[..], &words[..]);
    let (bp, lp) = (&brief_peer, &long_peer);
    let stream: [Job; 8] = [
        job("restarting: f64 sum and two comparisons", 0, Box::new(|| _ = black_box(baseline(black_box(b), o)))),
        job("restarting: `push`", 0, Box::new(|| _ = black_box(pushed(black_box(b), o)))),
        job("restarting: `push`, looks 10, 12, 14 …", 0, Box::new(|| _ = black_box(pushed(black_box(s), o)))),
        job("restarting: nexus-stats-detection", 0, Box::new(|| _ = black_box(peer_pushed(black_box(bp), o)))),
        job("long: f64 sum and two comparisons", 4, Box::new(|| _ = black_box(baseline(black_box(l), o)))),
        job("long: `push`", 4, Box::new(|| _ = black_box(pushed(black_box(l), o)))),
        job("long: nexus-stats-detection", 4, Box::new(|| _ = black_box(peer_pushed(black_box(lp), o)))),
        job("long: `push_bits`, 64 to a word", 4, Box::new(|| _ = black_box(packed(black_box(l), w)))),
    ];
    let times: Vec<Vec<f64>> = (0..rounds).map(|_| stream.iter().map(Job::time).collect()).collect();
    writeln!(out, "| one sample | ns, least | ns, median | ratio to the f64 sum, median |\n|---|---|---|---|")?;
    for (place, job) in stream.iter().enumerate() {
        let (least, median) = summary(times.iter().map(|round| round[place]));
        let (_, ratio) = summary(times.iter().map(|round| round[place] / round[job.reference]));
        writeln!(out, "| {} | {least:.2} | {median:.2} | {ratio:.2} |", job.name)?;
    }

    let designs = [
        ("exact: 0.1, 0.3, 0.05, 0.1 at p = 0.1", brief, 0.1),
        ("exact: the same at p = 0.2", brief, 0.2),
        ("exact: 0.5, 0.6, 0.05, 0.05 at p = 0.5", design(0.5, 0.6, 0.05, 0.05), 0.5),
        ("exact: 0.1, 0.3, 1e-12, 1e-12 at p = 0.1", design(0.1, 0.3, 1e-12, 1e-12), 0.1),
    ];
    let call = |repeat, name, call| Job { name, reference: 0, repeat, units: 1000.0, call };
    let mut whole: Vec<Job> = Vec::new();
    for (name, test, p) in designs {
        let _ = test.characteristic(p)?;
        whole.push(call(50, name, Box::new(move || _ = black_box(black_box(&test).characteristic(p)))));
    }
    whole.push(call(1000, "Wald at p = 0.2", Box::new(|| _ = black_box(black_box(b).wald_approximation(0.2)))));
    let corrected = Box::new(|| _ = black_box(black_box(b).corrected_approximation(0.2)));
    whole.push(call(1000, "corrected at p = 0.2", corrected));
    let times: Vec<Vec<f64>> = (0..rounds).map(|_| whole.iter().map(Job::time).collect()).collect();
    writeln!(out, "\n| one characteristic | µs, least | µs, median |\n|---|---|---|")?;
    for (place, job) in whole.iter().enumerate() {
        let (least, median) = summary(times.iter().map(|round| round[place]));
        writeln!(out, "| {} | {least:.2} | {median:.2} |", job.name)?;
    }
    Ok(())
}
