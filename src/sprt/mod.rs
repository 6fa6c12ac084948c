//! Sequential probability ratio tests.

mod approximation;
mod bernoulli;
mod bounds;
mod characteristic;
mod compensated;
mod counts;
mod family;
mod inference;
mod looks;
mod recursion;
mod run;
mod sequential;
mod tails;

pub use approximation::Approximation;
pub use bernoulli::{Bernoulli, BernoulliError, Counts};
pub use bounds::{Bounds, BoundsError};
pub use characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError, LawPoint};
pub use counts::CountsError;
pub use family::Family;
pub use inference::{ConfidenceInterval, Inference, InferenceError};
pub use looks::Looks;
pub use run::{Decision, Run, Step};
pub use sequential::{MAX_SAMPLES, Sprt};
