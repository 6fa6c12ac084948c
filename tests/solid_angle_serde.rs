//! Law: a bounded solid angle is the same after a round trip through text.
#![cfg(all(feature = "sphere", feature = "serde"))]

use steradian::glam::DVec3;
use steradian::solid_angle::{Bounded, polygon_bounded};

#[test]
fn bounded_solid_angles_keep_their_bits() {
    let octant = polygon_bounded(&[DVec3::X, DVec3::Y, DVec3::Z]).unwrap();
    for bounded in [octant, Bounded::default(), Bounded { value: 4.9e-324, error: 1.0 / 3.0 }] {
        let text = serde_json::to_string(&bounded).unwrap();
        let back: Bounded = serde_json::from_str(&text).unwrap();
        assert_eq!(
            [back.value, back.error].map(f64::to_bits),
            [bounded.value, bounded.error].map(f64::to_bits),
            "{text}"
        );
    }
    assert!(serde_json::from_str::<Bounded>(r#"{"value":1.0}"#).is_err());
}
