//! Products in strands and one after another, checked and unchecked, on every copy: the same fan.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::super::kernel::excess;
#[cfg(target_arch = "x86_64")]
use super::super::{
    dispatch::{Fused, Kernel, has_registers},
    double::{Number, Real},
    triangle::Triangle,
};
use super::{Fan, fan, one_after_another, strands};
#[cfg(target_arch = "x86_64")]
use super::{Loop, unchecked};

/// The sum over the fan, not reduced.
fn total(fan: &Fan) -> f64 {
    fan.signed() + 2.0 * TAU * fan.turns as f64
}

#[test]
fn excess_of_a_norm_is_exact_to_second_order() {
    let beyond = 2_f64.powi(-42);
    assert_eq!(excess([0.0, 1.0 + beyond, 0.0]), beyond);
    assert_eq!(excess([0.0, 0.0, beyond - 1.0]), -beyond);
}

#[test]
fn turns_count_how_often_the_fan_winds() {
    let octant = [DVec3::X, DVec3::Y, DVec3::Z];
    for times in 1..20 {
        let mut wound = octant.repeat(times);
        let forth = fan(&wound);
        assert_eq!(forth.factors, 3 * times - 2);
        assert!((total(&forth) - times as f64 * FRAC_PI_2).abs() < 1e-14, "{times}: {forth:?}");
        wound.reverse();
        assert!((total(&fan(&wound)) + times as f64 * FRAC_PI_2).abs() < 1e-14, "{times}");
    }
    // Twice around 60 degrees from the pole, seen from a vertex: 2 · 2π (1 − cos 60°) less what the chords cut off.
    let ring: Vec<_> = (0..2000)
        .map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 1000.0).sin_cos();
            DVec3::new(0.75_f64.sqrt() * cos, 0.75_f64.sqrt() * sin, 0.5).normalize()
        })
        .collect();
    let got = fan(&ring);
    assert!((total(&got) - TAU).abs() < 1e-4, "{got:?}");
    // The same as hemispheres that end exactly on the half turn.
    let equator = [DVec3::X, DVec3::new(-0.6, 0.8, 0.0), DVec3::new(-0.6, -0.8, 0.0)];
    let twice = fan(&equator.repeat(2));
    assert_eq!((twice.half.value(), twice.turns), (0.0, 1), "{twice:?}");
    assert_eq!(fan(&equator).half.value(), PI);
}

#[test]
fn what_a_check_would_find_is_never_taken_unchecked() {
    let v = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
    let (a, b, c, d) = (v(1.0, 0.2, 0.1), v(0.3, 1.0, -0.2), v(-0.4, 0.9, 0.5), v(0.2, 0.1, 1.0));
    // The same direction, not the same bits.
    let longer = DVec3::new(0.0, 1.0 + 2.0 * f64::EPSILON, 0.0);
    let offences = [
        vec![a, b, c, d, c],             // walked back
        vec![a, DVec3::Y, c, longer, d], // likewise
        vec![a, b, b, c, d],             // repeated
        vec![a, b, -b, c, d],            // no edge
        vec![a, b, c * (1.0 + 1e-11), d],
        vec![a, b, c, DVec3::NAN],
    ];
    assert!(unchecked(&[a, b, c, d]).is_some());
    for mut vertices in offences {
        for _ in 0..vertices.len() {
            vertices.rotate_left(1);
            assert!(unchecked(&vertices).is_none(), "{vertices:?}");
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn checked(vertices: &[DVec3]) -> Loop<'_> {
    Loop { vertices, strands: true, singly: true }
}

/// Loops of every kind that the kernel tells apart, from a linear congruence.
#[cfg(target_arch = "x86_64")]
fn loops() -> impl Iterator<Item = Vec<DVec3>> {
    let mut state = 1_u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut direction = move || loop {
        let v = DVec3::new(next(), next(), next()) * 2.0 - 1.0;
        if (1e-3..1.0).contains(&v.length_squared()) {
            break v.normalize();
        }
    };
    (0..20_000).map(move |i: i32| {
        let (a, b) = (direction(), direction());
        let size = 10_f64.powi(-(i / 8 % 15));
        let near = |v: DVec3, d: DVec3| (v + size * d).normalize();
        match i % 8 {
            0 => vec![a, b, direction()],
            1 => (0..8).map(|_| near(a, direction())).collect(),
            2 => vec![a, b, near(a.lerp(b, 0.4), direction())],
            3 => vec![a, near(-a, direction()), b],
            4 => vec![a, b, -a, direction(), near(-a, direction())],
            5 => (0..40).map(|_| direction()).collect(),
            6 => vec![a, b, -(a + b).normalize(), near(a, direction())],
            _ => {
                // Products below 2⁻⁹⁶⁹, which lose low bits, and below 2⁻¹⁰⁷⁴, which vanish.
                let flat = DVec3::new(1.0, 10_f64.powi(-(i / 8 % 320)), 1.0);
                (0..3 + i / 8 % 2 * 3).map(|_| near(DVec3::Z, size * direction() * flat)).collect()
            }
        }
    })
}

#[cfg(target_arch = "x86_64")]
#[test]
fn both_copies_multiply_alike_down_to_the_smallest_doubles() {
    // The first two halves' products may round up to a number where the product itself does not.
    let vanishing = (5.700_151_044_183_039e-151, 4.333_794_301_287_642e-174);
    let small = (0..4000_u32).map(|i| {
        let (a, b) = (1.0 / f64::from(2 * i + 3), 0.7 / f64::from(i + 1));
        (a, b * 2_f64.powi(-960) * 2_f64.powi(-(i as i32 % 120)))
    });
    for (a, b) in small.chain([vanishing]) {
        let (split, fused) = (<f64 as Number>::product(a, b), Fused::product(Fused::constant(a), Fused::constant(b)));
        assert_eq!((split.hi, split.lo), (fused.hi.get(), fused.lo.get()), "{a:e} · {b:e}");
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn both_copies_give_the_same_bits() {
    if !has_registers() {
        return;
    }
    for vertices in loops() {
        let (split, fused) = (checked(&vertices).run::<f64>(), checked(&vertices).run::<Fused>());
        assert_eq!(format!("{split:?}"), format!("{fused:?}"), "{vertices:?}");
        assert_eq!(format!("{split:?}"), format!("{:?}", Some(fan(&vertices))), "{vertices:?}");
        // Who gives up gives nothing, and who does not gives the same.
        assert!(unchecked(&vertices).is_none_or(|quick| format!("{:?}", Some(quick)) == format!("{split:?}")));
        let [a, b, c] = &vertices[..] else { continue };
        let (split, fused) = (Triangle(a, b, c).run::<f64>(), Triangle(a, b, c).run::<Fused>());
        assert_eq!(format!("{split:?}"), format!("{fused:?}"), "{vertices:?}");
        let whole = fan(&vertices).angle().value();
        assert!(split.is_none_or(|quick| quick.value() == whole), "{vertices:?}: {split:?} against {whole:e}");
    }
}

#[test]
fn an_edge_that_is_a_half_turn_but_for_the_smallest_doubles_is_measured() {
    let almost = DVec3::new(-1.000_000_000_000_017, -3.8e-322, -3.8e-322);
    let loops = [[DVec3::X, almost, DVec3::Y], [DVec3::X, almost, DVec3::new(0.6, -0.8, 0.0)]];
    for [a, b, c] in loops {
        let angle = super::super::signed_polygon(&[a, b, c]).unwrap();
        assert!(angle.is_finite() && angle.abs() <= 2.0 * PI, "{angle}");
        assert_eq!(super::super::triangle(a, b, c), Ok(angle));
    }
}

#[test]
fn strands_are_the_product_of_one_after_another() {
    let (mut ordinary, mut same) = (0, 0);
    for vertices in loops() {
        let Some(strands) = strands::fan::<f64>(&vertices) else { continue };
        let one = one_after_another::<f64>(&vertices);
        assert_eq!((strands.turns, strands.factors), (one.turns, one.factors), "{vertices:?}");
        // Both are off by a few u² of what they sum up, parts that cancel included.
        let error = (strands.half - one.half).value().abs();
        assert!(error <= 1e-30 * one.swept, "{vertices:?}: {strands:?} {one:?}");
        ordinary += 1;
        same += i32::from(strands.signed() == one.signed());
    }
    assert!(ordinary > 8000 && 1000 * same > 999 * ordinary, "{same} of {ordinary}");
}
