//! Sequential probability ratio tests.

mod approximation;
mod bernoulli;
mod bounds;
mod characteristic;
mod compensated;
mod counts;
mod exponential;
mod exponential_law;
mod family;
mod forward;
mod legendre;
mod looks;
mod normal;
mod normal_law;
mod normal_tail;
mod panels;
mod poisson;
mod poisson_law;
mod poisson_terms;
mod recursion;
mod run;
mod sequential;

pub use approximation::Approximation;
pub use bernoulli::{Bernoulli, BernoulliError};
pub use bounds::{Bounds, BoundsError};
pub use characteristic::{CHARACTERISTIC_WORK, Characteristic, CharacteristicError, LawPoint};
pub use compensated::Sum as CompensatedSum;
pub use counts::CountsError;
pub use exponential::{Exponential, ExponentialError};
pub use family::Family;
pub use looks::Looks;
pub use normal::{Normal, NormalError};
pub use poisson::{Poisson, PoissonError};
pub use run::{Decision, Run, Step};
pub use sequential::{MAX_SAMPLES, Sprt};
