//! Sums that keep what each addition loses.

/// Sum of doubles whose error does not grow with the number of terms.
///
/// # Accuracy
/// For terms of one sign the relative error is at most `2⁻⁵³ + n²·2⁻¹⁰⁵`, n terms. Proven by Neumaier.
///
/// # Source
/// Neumaier (1974), Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen.
///
/// Two that are NaN are equal if they are so to the bit.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "[u64; 2]", into = "[u64; 2]")
)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// Adds one term.
    #[inline]
    pub(super) fn add(&mut self, term: f64) {
        let next = self.total + term;
        // Knuth's error-free sum: no comparison of the magnitudes.
        let added = next - self.total;
        self.lost += (self.total - (next - added)) + (term - added);
        self.total = next;
    }

    /// The sum so far.
    #[inline]
    #[must_use]
    pub fn value(self) -> f64 {
        self.total + self.lost
    }
}

impl PartialEq for Sum {
    fn eq(&self, other: &Self) -> bool {
        let bits = |x: f64| (x + 0.0).to_bits();
        bits(self.total) == bits(other.total) && bits(self.lost) == bits(other.lost)
    }
}

/// As it is stored: the bits, since a NaN has no decimals and some readers of decimals are off by a bit.
#[cfg(feature = "serde")]
impl From<Sum> for [u64; 2] {
    fn from(sum: Sum) -> Self {
        [sum.total.to_bits(), sum.lost.to_bits()]
    }
}

#[cfg(feature = "serde")]
impl From<[u64; 2]> for Sum {
    fn from([total, lost]: [u64; 2]) -> Self {
        Self { total: f64::from_bits(total), lost: f64::from_bits(lost) }
    }
}

impl FromIterator<f64> for Sum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::default();
        for term in terms {
            sum.add(term);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_survive_a_large_one() {
        let terms = core::iter::once(1.0).chain(core::iter::repeat_n(f64::EPSILON / 4.0, 1 << 12));
        assert_eq!(terms.collect::<Sum>().value(), 1.0 + 1024.0 * f64::EPSILON);
    }
}
