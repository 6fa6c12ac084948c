//! Law: the solid angle of every polygon of the oracle is the exact value within the bound of its class.

mod bounds;
#[path = "oracles/decimal.rs"]
mod decimal;

use std::collections::BTreeMap;

use bounds::solid_angle::bound;
use decimal::{hexadecimal, ulps};
use glam::DVec3;
use serde::Deserialize;
use steradian::glam;
use steradian::solid_angle::{self, SolidAngleError};

#[derive(Deserialize)]
struct Oracle {
    count: usize,
    polygons: Vec<Polygon>,
}

#[derive(Deserialize)]
struct Polygon {
    id: String,
    cls: String,
    vertices: Vec<[String; 3]>,
    expect: String,
    edge: Option<usize>,
    omega: Option<String>,
    omega_signed: Option<String>,
}

impl Polygon {
    fn vertices(&self) -> Vec<DVec3> {
        self.vertices.iter().map(|v| DVec3::from_array([0, 1, 2].map(|i| hexadecimal(&v[i])))).collect()
    }
}

fn oracle() -> Vec<Polygon> {
    let oracle: Oracle = serde_json::from_str(include_str!("oracles/solid_angle.json")).expect("the oracle is JSON");
    assert_eq!(oracle.polygons.len(), oracle.count);
    oracle.polygons
}

#[test]
fn every_value_is_within_its_bound() {
    let mut worst: BTreeMap<String, (f64, String)> = BTreeMap::new();
    let mut failures = Vec::new();
    for polygon in oracle().iter().filter(|polygon| polygon.expect == "value" && polygon.cls != "non_unit") {
        let vertices = polygon.vertices();
        for (function, got, want) in [
            ("signed_polygon", solid_angle::signed_polygon(&vertices), &polygon.omega_signed),
            ("polygon", solid_angle::polygon(&vertices), &polygon.omega),
        ] {
            let want = want.as_deref().expect("a value");
            let (got, bound) = (got.expect(&polygon.id), bound(function, &polygon.cls));
            let error = ulps(got, want);
            if error.is_nan() || error > bound {
                failures.push(format!("{function} {}: got {got:e}, want {want}, {error} ulp > {bound}", polygon.id));
            }
            let entry = worst.entry(format!("{function} {}", polygon.cls)).or_default();
            if error >= entry.0 {
                *entry = (error, polygon.id.clone());
            }
        }
    }
    for (class, (error, id)) in worst {
        println!("{class:45} {error:6.3} ulp at {id}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn what_encloses_nothing_is_exactly_zero() {
    let zeros: Vec<_> = oracle().into_iter().filter(|polygon| polygon.omega.as_deref() == Some("0")).collect();
    assert_eq!(zeros.len(), 5);
    for polygon in zeros {
        let vertices = polygon.vertices();
        let (signed, unsigned) = (solid_angle::signed_polygon(&vertices), solid_angle::polygon(&vertices));
        let bits = |value: Result<f64, SolidAngleError>| value.map(f64::to_bits);
        assert_eq!((bits(signed), bits(unsigned)), (Ok(0), Ok(0)), "{}: {signed:?} {unsigned:?}", polygon.id);
    }
}

#[test]
fn antipodal_edges_are_refused_with_their_index() {
    let refused: Vec<_> = oracle().into_iter().filter(|polygon| polygon.expect == "error:antipodal_edge").collect();
    assert_eq!(refused.len(), 4);
    for polygon in refused {
        let index = polygon.edge.expect("the index of the edge");
        let got = solid_angle::polygon(&polygon.vertices());
        assert_eq!(got, Err(SolidAngleError::AntipodalEdge { index }), "{}", polygon.id);
    }
}

#[test]
fn vectors_off_the_sphere_are_refused_and_their_directions_are_not() {
    let off: Vec<_> = oracle().into_iter().filter(|polygon| polygon.cls == "non_unit").collect();
    assert_eq!(off.len(), 3);
    for polygon in off {
        let got = solid_angle::polygon(&polygon.vertices());
        assert!(matches!(got, Err(SolidAngleError::NotUnit { .. })), "{}: {got:?}", polygon.id);
    }
}
