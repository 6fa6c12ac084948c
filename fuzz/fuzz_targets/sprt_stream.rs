//! Any test on any outcomes: constructors accept exactly what they document, all forms of a stream agree.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use steradian::sprt::{Looks, Sprt};

#[path = "../../tests/invariants/sprt.rs"]
mod invariants;

#[derive(Arbitrary, Debug)]
struct Input {
    hypotheses: (f64, f64),
    bounds: (f64, f64),
    as_risks: bool,
    looks: (u32, u32),
    truncation: Option<u64>,
    batch: (u64, u64),
    words: Vec<(u64, u32)>,
    p: f64,
}

fuzz_target!(|input: Input| {
    let family = invariants::family(input.hypotheses.0, input.hypotheses.1);
    let bounds = invariants::bounds(input.bounds.0, input.bounds.1, input.as_risks);
    let (Ok(family), Ok(bounds)) = (family, bounds) else { return };
    let test = Sprt::new(family, bounds).looks(Looks::from(input.looks.0).every(input.looks.1));
    let test = input.truncation.map_or(test, |samples| test.truncate(samples));
    invariants::forms_agree(&test, &input.words);
    invariants::analysis(&test, input.p, 1 << 20);
    let mut run = test.start();
    let taken = run.push_counts(input.batch.0, input.batch.1);
    assert_eq!(taken.is_ok(), input.batch.0 <= input.batch.1 && input.batch.1 <= steradian::sprt::MAX_SAMPLES);
    invariants::run(&run);
});
