//! Gauss–Legendre quadrature.

use alloc::vec::Vec;

/// The nodes of the rule of `count` nodes on (−1, 1), in increasing order, with their weights.
///
/// # Accuracy
/// The nodes are within 8·2⁻⁵³, the weights within a relative (16 + 3·count)·2⁻⁵³, searched; worst seen 6·2⁻⁵³, and 8.5e-14
/// for a weight of 400 nodes.
pub(super) fn rule(count: usize) -> Vec<(f64, f64)> {
    let mut rule = alloc::vec![(0.0, 2.0); count];
    let n = count as f64;
    let inverses: Vec<f64> = (0..=count).map(|j| 1.0 / (j.max(1) as f64)).collect();
    for place in 0..count.div_ceil(2) {
        // All in u = 1 − x, which keeps its digits near the end, where the weights are proportional to it. Tricomi's
        // start, with the first terms of the cosine, and Newton from there; the middle of an odd rule is 1.
        let angle = core::f64::consts::PI * (place as f64 + 0.75) / (n + 0.5);
        let square = angle * angle;
        let fall = square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)));
        let shrink = (1.0 - 1.0 / n) / (8.0 * n * n);
        let is_middle = 2 * place + 1 == count;
        let mut u = if is_middle { 1.0 } else { shrink + (1.0 - shrink) * fall };
        let mut slope = 0.0;
        for _ in 0..8 {
            // Pⱼ and Pⱼ − Pⱼ₋₁.
            let (mut here, mut gain) = (1.0, 0.0);
            for (j, inverse) in inverses.iter().enumerate().skip(1) {
                let j = j as f64;
                gain = ((j - 1.0) * gain - (2.0 * j - 1.0) * u * here) * inverse;
                here += gain;
            }
            let ends = u * (2.0 - u);
            slope = n * (u * here - gain) / ends;
            if is_middle {
                break;
            }
            let step = here / slope;
            // Legendre's equation gives the second derivative, hence the slope where the step leads.
            slope -= step * (2.0 * (1.0 - u) * slope - n * (n + 1.0) * here) / ends;
            u += step;
            // Newton doubles the digits: what is left after this step is below a rounding.
            if step.abs() < 1e-9 * u {
                break;
            }
        }
        let weight = 2.0 / (u * (2.0 - u) * slope * slope);
        rule[place] = (u - 1.0, weight);
        rule[count - 1 - place] = (1.0 - u, weight);
    }
    rule
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_and_weights_have_their_digits() {
        // (count, place from the end at 1, 1 − node, weight), from 40 digits.
        for (count, place, distance, weight) in [
            (12, 0, 0.018_439_365_753_280_75, 0.047_175_336_386_511_83),
            (12, 3, 0.412_682_045_713_382_5, 0.203_167_426_723_065_92),
            (31, 0, 0.002_912_518_180_522_926, 0.007_470_831_579_248_776),
            (31, 1, 0.015_314_090_334_847_516, 0.017_318_620_790_310_58),
            (31, 7, 0.284_223_215_413_146_7, 0.069_628_583_235_410_37),
            (31, 14, 0.900_444_687_847_658_5, 0.099_225_011_226_672_31),
            (120, 0, 0.000_199_134_341_041_079_43, 0.000_511_026_063_694_612_1),
            (120, 30, 0.304_514_565_935_377_4, 0.018_732_970_649_636_977),
            (400, 1, 0.000_094_983_530_668_720_43, 0.000_107_690_381_021_836_46),
            (400, 199, 0.996_077_924_905_161_9, 0.007_844_109_968_033_427),
        ] {
            let rule = rule(count);
            let (x, w) = rule[count - 1 - place];
            let error = (w / weight - 1.0).abs();
            assert!(error <= (16 + 3 * count) as f64 * f64::EPSILON / 2.0, "{count} {place}: {error:e}");
            let moved = ((1.0 - x) - distance).abs();
            assert!(moved <= 8.0 * f64::EPSILON / 2.0, "{count} {place}: {moved:e}");
        }
    }

    #[test]
    fn polynomials_of_twice_the_degree_are_exact() {
        for count in [1_usize, 2, 3, 12, 29, 64, 300] {
            for degree in [0, count - count % 2, 2 * count - 2] {
                let sum: f64 = rule(count).iter().map(|(x, weight)| weight * x.powi(degree as i32)).sum();
                assert!((sum * (degree as f64 + 1.0) / 2.0 - 1.0).abs() < 4e-12, "{count} {degree} {sum}");
            }
        }
        assert_eq!(rule(0), []);
    }
}
