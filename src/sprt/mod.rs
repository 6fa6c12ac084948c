//! Sequential probability ratio tests: they choose between two simple hypotheses with as few observations as can be.
//!
//! # Model
//! After each observation, or at the looks of a schedule, the ratio Λ of the likelihoods under H1 and under H0 is
//! compared with two boundaries B < 1 < A: H0 is rejected when Λ ≥ A, accepted when Λ ≤ B, and observation goes on
//! between. Wald's boundaries for the nominal risks α and β are A = (1 − β)/α and B = β/(1 − α).
//!
//! # Guarantees
//! 1. A Bernoulli run decides from its counts, and a ratio that lies exactly on a boundary, every number being read
//!    as the decimal it was written as, has reached it: tests/sprt_oracle.rs
//! 2. One by one, by counts and by packed bits, the same outcomes lead to the same decision at the same sample:
//!    tests/sprt_laws.rs
//! 3. The operating characteristic is exact, with a proven bound of its error, and a test that would take too long to
//!    analyse is a typed error: tests/sprt_oracle.rs, tests/sprt_simulation.rs
//! 4. α' ≤ P₁(reject)/A and β' ≤ B·P₀(accept) for the exact risks α' and β', whatever the looks and the limit:
//!    tests/sprt_laws.rs
//! 5. Calibrated boundaries keep the exact risks, and no others that do take fewer samples: tests/sprt_calibration.rs
//! 6. After stopping, p-values, confidence intervals and median-unbiased estimates are exact under the looks and the
//!    limit of the test: tests/sprt_inference.rs
//! 7. The characteristics of [`Poisson`], [`Normal`] and [`Exponential`] tests are those of their laws too, with looks
//!    and limits: tests/sprt_families.rs, tests/sprt_families_laws.rs
//!
//! # Nominal risks bound nothing
//! The exact α' can exceed α. Two hypotheses of 0.1 and 0.3, with α = 0.44 and β = 0.55, have a band so narrow,
//! A = 1.0227 and B = 0.9821, that every test of them ends at its first look, whatever the outcomes:
//! ```
//! use steradian::sprt::{Bernoulli, Bounds, Looks, Sprt};
//!
//! let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.44, 0.55)?).looks(Looks::from(10).every(2));
//! let exact = test.characteristic(0.1)?;
//! assert_eq!((exact.law().len(), exact.law()[0].samples), (1, 10)); // it rejects from two successes in ten
//! assert!((exact.reject() - 0.2639010709).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Not here
//! The random generator that simulates a test is the caller's. How to choose a limit, how to read the curves, what
//! everything costs, and what other libraries do: docs/sprt.md, whose numbers tests/sprt_page.rs holds.
//!
//! # Source
//! Wald (1945), Sequential Tests of Statistical Hypotheses, Annals of Mathematical Statistics 16; Wald (1947),
//! Sequential Analysis.

mod approximation;
mod band;
mod bernoulli;
mod bounds;
mod calibration;
mod characteristic;
mod compensated;
mod confidence_interval;
mod counts;
mod e_value;
mod exponential;
mod exponential_law;
mod family;
mod family_approximations;
mod fixed_sample;
mod forward;
mod inference;
mod legendre;
mod looks;
mod normal;
mod normal_law;
mod normal_tail;
mod panels;
mod plan;
mod poisson;
mod poisson_law;
mod poisson_terms;
mod rates;
mod recursion;
mod run;
mod run_state;
mod sequential;
mod tails;

pub use approximation::Approximation;
pub use band::Band;
pub use bernoulli::{Bernoulli, BernoulliError};
pub use bounds::{Bounds, BoundsError};
pub use calibration::{CALIBRATION_ROUNDING, CALIBRATION_WORK, Calibration, CalibrationError};
pub use characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError, LawPoint};
pub use compensated::Sum as CompensatedSum;
pub use confidence_interval::ConfidenceInterval;
pub use counts::CountsError;
pub use exponential::Exponential;
pub use family::Family;
pub use fixed_sample::{FixedSample, FixedSampleError};
pub use inference::{Inference, InferenceError};
pub use looks::Looks;
pub use normal::{Normal, NormalError};
pub use plan::SamplePlan;
pub use poisson::Poisson;
pub use rates::RateError;
pub use run::{Decision, Run, Step};
pub use run_state::{ResumeError, RunState};
pub use sequential::{MAX_SAMPLES, Sprt};
