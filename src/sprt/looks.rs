//! At which sample sizes a test looks at its ratio.

/// Schedule of looks: after `first` observations, then after every `step` more.
///
/// Between looks nothing is decided, even if the ratio leaves the boundaries and comes back.
///
/// # Shapes
/// `Looks::from(n)` starts at `n` and looks after every observation from there; `every(k)` spaces the looks. A zero
/// reads as 1 in both, so a schedule always exists.
///
/// # Examples
/// ```
/// use steradian::sprt::Looks;
///
/// let looks = Looks::from(10).every(2); // 10, 12, 14, …
/// assert_eq!((looks.first(), looks.step()), (10, 2));
/// assert_eq!(Looks::from(0).every(0), Looks::default()); // 1, 2, 3, …
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(from = "Stored", into = "Stored"))]
#[must_use]
pub struct Looks {
    first: u32,
    step: u32,
}

impl Looks {
    /// The same first look, then one after every `step` observations; zero reads as 1.
    pub const fn every(self, step: u32) -> Self {
        Self { first: self.first, step: if step == 0 { 1 } else { step } }
    }

    /// Number of observations at the first look, at least 1.
    #[must_use]
    pub const fn first(&self) -> u64 {
        self.first as u64
    }

    /// Number of observations between looks, at least 1.
    #[must_use]
    pub const fn step(&self) -> u64 {
        self.step as u64
    }

    /// The first look after more than `samples` observations.
    pub(super) const fn after(&self, samples: u64) -> u64 {
        if samples < self.first() {
            self.first()
        } else if self.step == 1 {
            samples.saturating_add(1)
        } else {
            samples.saturating_add(self.step() - (samples - self.first()) % self.step())
        }
    }
}

impl From<u32> for Looks {
    /// A look after every observation from number `first`; zero reads as 1.
    fn from(first: u32) -> Self {
        Self { first: first.max(1), step: 1 }
    }
}

impl Default for Looks {
    /// A look after every observation.
    fn default() -> Self {
        Self { first: 1, step: 1 }
    }
}

/// A schedule as it is stored: any two numbers, read with the same rule for zero.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    first: u32,
    step: u32,
}

#[cfg(feature = "serde")]
impl From<Stored> for Looks {
    fn from(stored: Stored) -> Self {
        Self::from(stored.first).every(stored.step)
    }
}

#[cfg(feature = "serde")]
impl From<Looks> for Stored {
    fn from(looks: Looks) -> Self {
        Self { first: looks.first, step: looks.step }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_follow_the_schedule() {
        let looks = Looks::from(10).every(2);
        assert_eq!(looks.after(0), 10);
        assert_eq!(looks.after(9), 10);
        assert_eq!(looks.after(10), 12);
        assert_eq!(looks.after(11), 12);
        assert_eq!(Looks::default().after(7), 8);
    }

    #[test]
    fn the_last_count_has_no_look_behind_it() {
        assert_eq!(Looks::from(u32::MAX).every(u32::MAX).after(u64::MAX), u64::MAX);
    }
}
