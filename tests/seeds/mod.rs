//! Seeds and case counts of the whole test suite.
//!
//! Every random test draws from here, so that a run is repeatable: `STERADIAN_SEED` replaces the seed and
//! `STERADIAN_CASES` multiplies the number of cases.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use proptest::test_runner::{Config, RngSeed};
use rand::SeedableRng;
use rand_pcg::Pcg64;

fn variable(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} must be an unsigned integer, got {text:?}")),
        Err(_) => default,
    }
}

/// The seed of this run; printed by a failing test through `Config` or by the caller.
pub fn seed() -> u64 {
    variable("STERADIAN_SEED", 0x2001_5e1d)
}

/// `n` cases, or as many times more as the environment asks for.
pub fn cases(n: u32) -> u32 {
    n.saturating_mul(u32::try_from(variable("STERADIAN_CASES", 1)).unwrap_or(u32::MAX))
}

/// A generator for stream `stream` of this run's seed.
pub fn rng(stream: u64) -> Pcg64 {
    // An odd multiplier keeps the streams apart; `seed_from_u64` scrambles what it is given.
    Pcg64::seed_from_u64(seed() ^ stream.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Configuration of a property test with `n` cases; regressions become named tests, so nothing is persisted.
pub fn config(n: u32) -> Config {
    Config { cases: cases(n), rng_seed: RngSeed::Fixed(seed()), failure_persistence: None, ..Config::default() }
}
