//! Times every form in turns, round after round, so that a busy machine slows all of them alike.

use std::{error::Error, hint::black_box, io::Write, time::Instant};

use steradian::sprt::{Bernoulli, Sprt};

use super::forms::{
    OUTCOMES, baseline, brief, design, long, outcomes, packed, peer, peer_pushed, pushed, scheduled, words,
};

/// So many outcomes, over and over, are learnt by the branch predictor: no real stream is as easy.
const LEARNT: usize = 4096;

/// The three streams, by the column of the table.
const STREAMS: [&str; 3] = ["restarting", "long", "learnt"];

/// Something to time: its row and column in the table, how often a measurement repeats it, and the units of one call.
struct Job<'a> {
    name: &'a str,
    column: usize,
    repeat: u32,
    units: usize,
    call: Box<dyn Fn() + 'a>,
}

impl Job<'_> {
    /// Nanoseconds a unit.
    fn time(&self) -> f64 {
        let start = Instant::now();
        for _ in 0..self.repeat {
            (self.call)();
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(self.repeat) / self.units as f64
    }
}

/// Times all of them once in each round; the times of each.
fn rounds(jobs: &[Job], rounds: u16) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::new(); jobs.len()];
    for _ in 0..rounds {
        for (job, times) in jobs.iter().zip(&mut times) {
            times.push(job.time());
        }
    }
    times
}

/// Least and median.
fn summary(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    (sorted[0], sorted[sorted.len() / 2])
}

pub fn print(out: &mut impl Write, count: u16) -> Result<(), Box<dyn Error>> {
    observations(out, count)?;
    writeln!(out)?;
    characteristics(out, count)?;
    writeln!(out)?;
    calibrations(out, count)
}

fn observations(out: &mut impl Write, count: u16) -> Result<(), Box<dyn Error>> {
    let outcomes = outcomes();
    let words = words(&outcomes);
    let (brief, scheduled, long) = (brief(), scheduled(), long());
    let (brief_peer, long_peer) = (peer(&brief, 0.05, 0.1), peer(&long, 1e-9, 1e-9));
    let rejected = baseline(&brief, &outcomes);
    assert_eq!((pushed(&brief, &outcomes), peer_pushed(&brief_peer, &outcomes)), (rejected, rejected));
    assert_eq!([baseline(&long, &outcomes), pushed(&long, &outcomes), packed(&long, &words)], [0; 3]);

    const ROWS: [&str; 5] =
        ["f64 sum, two comparisons", "`push`", "`push`, looks 10, 12 …", "nexus-stats-detection", "`push_bits`"];
    // The first row has the references of the columns, which are the first jobs.
    let mut jobs = Vec::new();
    for (column, test, stream) in [(0, &brief, &outcomes[..]), (1, &long, &outcomes), (2, &brief, &outcomes[..LEARNT])]
    {
        let (repeat, units) = ((2 * OUTCOMES / stream.len()) as u32, stream.len());
        let call = Box::new(move || _ = black_box(baseline(black_box(test), stream)));
        jobs.push(Job { name: ROWS[0], column, repeat, units, call });
    }
    for column in 0..STREAMS.len() {
        let (test, peer) = if column == 1 { (&long, &long_peer) } else { (&brief, &brief_peer) };
        let Job { repeat, units, .. } = jobs[column];
        let stream = &outcomes[..units];
        let mut add = |name, call| jobs.push(Job { name, column, repeat, units, call });
        add(ROWS[1], Box::new(move || _ = black_box(pushed(black_box(test), stream))));
        if column != 1 {
            let test = &scheduled;
            add(ROWS[2], Box::new(move || _ = black_box(pushed(black_box(test), stream))));
        }
        add(ROWS[3], Box::new(move || _ = black_box(peer_pushed(black_box(peer), stream))));
        if column == 1 {
            let words = &words;
            add(ROWS[4], Box::new(move || _ = black_box(packed(black_box(test), words))));
        }
    }
    let times = rounds(&jobs, count);
    writeln!(out, "| ns a sample (ratio), least | {} |\n|---|---|---|---|", STREAMS.join(" | "))?;
    for row in ROWS {
        write!(out, "| {row} |")?;
        for (column, reference) in times.iter().take(STREAMS.len()).enumerate() {
            let Some(place) = jobs.iter().position(|job| (job.name, job.column) == (row, column)) else {
                write!(out, " |")?;
                continue;
            };
            let (least, median) = summary(times[place].iter().copied());
            let (_, ratio) = summary(times[place].iter().zip(reference).map(|(time, reference)| time / reference));
            write!(out, " {median:.2} ({ratio:.2}), {least:.2} |")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn calibrations(out: &mut impl Write, count: u16) -> Result<(), Box<dyn Error>> {
    writeln!(out, "| ms for p0, p1, α, β (least) | calibration |\n|---|---|")?;
    for (p0, p1, alpha, beta) in [(0.1, 0.3, 0.05, 0.1), (0.7, 0.9, 0.05, 0.1)] {
        let family = Bernoulli::new(p0, p1)?;
        let test = *Sprt::calibrated(family, alpha, beta)?.test();
        assert!(test.characteristic(p0)?.reject() <= alpha && test.characteristic(p1)?.accept() <= beta);
        let call = Box::new(move || _ = black_box(Sprt::calibrated(black_box(family), alpha, beta)));
        let job = Job { name: "", column: 0, repeat: 1, units: 1_000_000, call };
        let (least, median) = summary(rounds(&[job], count).swap_remove(0).into_iter());
        writeln!(out, "| {p0}, {p1}, {alpha}, {beta} | {median:.2} ({least:.2}) |")?;
    }
    Ok(())
}

fn characteristics(out: &mut impl Write, count: u16) -> Result<(), Box<dyn Error>> {
    let (brief, classic, tiny) = (brief(), design(0.5, 0.6, 0.05, 0.05), design(0.1, 0.3, 1e-12, 1e-12));
    let designs = [
        ("0.1, 0.3, 0.05, 0.1; 0.1", &brief, 0.1),
        ("the same; 0.2", &brief, 0.2),
        ("0.5, 0.6, 0.05, 0.05; 0.5", &classic, 0.5),
        ("0.1, 0.3, 1e-12, 1e-12; 0.1", &tiny, 0.1),
    ];
    writeln!(out, "| µs for p0, p1, α, β; p (least) | exact | Wald | corrected |\n|---|---|---|---|")?;
    for (name, test, p) in designs {
        let exact = test.characteristic(p)?.mean_samples();
        assert!((test.corrected_approximation(p)?.mean_samples() / exact - 1.0).abs() < 0.05);
        let job = |column, repeat, call| Job { name, column, repeat, units: 1000, call };
        let jobs: [Job; 3] = [
            job(0, 50, Box::new(move || _ = black_box(black_box(test).characteristic(p)))),
            job(1, 1000, Box::new(move || _ = black_box(black_box(test).wald_approximation(p)))),
            job(2, 1000, Box::new(move || _ = black_box(black_box(test).corrected_approximation(p)))),
        ];
        write!(out, "| {name} |")?;
        for times in rounds(&jobs, count) {
            let (least, median) = summary(times.into_iter());
            write!(out, " {median:.2} ({least:.2}) |")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
