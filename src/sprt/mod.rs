//! Sequential probability ratio tests.

mod approximation;
mod bernoulli;
mod bounds;
mod calibration;
mod characteristic;
mod compensated;
mod counts;
mod family;
mod fixed_sample;
mod inference;
mod looks;
mod plan;
mod recursion;
mod run;
mod sequential;
mod tails;

pub use approximation::Approximation;
pub use bernoulli::{Bernoulli, BernoulliError, Counts};
pub use bounds::{Bounds, BoundsError};
pub use calibration::{CALIBRATION_ROUNDING, CALIBRATION_WORK, Calibration, CalibrationError};
pub use characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError, LawPoint};
pub use counts::CountsError;
pub use family::Family;
pub use fixed_sample::{FixedSample, FixedSampleError};
pub use inference::{ConfidenceInterval, Inference, InferenceError};
pub use looks::Looks;
pub use plan::SamplePlan;
pub use run::{Decision, Run, Step};
pub use sequential::{MAX_SAMPLES, Sprt};
