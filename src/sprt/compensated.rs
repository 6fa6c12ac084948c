//! Sums that keep what each addition loses.

/// Sum of doubles whose error does not grow with the number of terms.
///
/// # Accuracy
/// For terms of one sign the relative error is at most `2⁻⁵³ + n²·2⁻¹⁰⁵`, n terms. Proven by Neumaier.
///
/// # Source
/// Neumaier (1974), Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
