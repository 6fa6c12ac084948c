//! Law: the solid angle and the vector moment of every polygon of the oracles are the exact values within the bound of the class.
#![cfg(feature = "sphere")]

mod bounds;
#[path = "oracles/decimal.rs"]
mod decimal;

use std::collections::BTreeMap;

use bounds::solid_angle::bound;
use decimal::{difference, hexadecimal, ulps};
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
        vertices(&self.vertices)
    }
}

fn oracle() -> Vec<Polygon> {
    let oracle: Oracle = serde_json::from_str(include_str!("oracles/solid_angle.json")).expect("the oracle is JSON");
    assert_eq!(oracle.polygons.len(), oracle.count);
    oracle.polygons
}

#[derive(Deserialize)]
struct More {
    moments: BTreeMap<String, [String; 3]>,
    polygons: Vec<Measured>,
}

#[derive(Deserialize)]
struct Measured {
    id: String,
    cls: String,
    vertices: Vec<[String; 3]>,
    omega_signed: String,
    moment: [String; 3],
}

fn more() -> More {
    serde_json::from_str(include_str!("oracles/solid_angle_more.json")).expect("the oracle is JSON")
}

fn vertices(texts: &[[String; 3]]) -> Vec<DVec3> {
    texts.iter().map(|v| DVec3::from_array([0, 1, 2].map(|i| hexadecimal(&v[i])))).collect()
}

/// Worst error of every function and class, and every error above its bound.
#[derive(Default)]
struct Tally {
    worst: BTreeMap<String, (f64, String)>,
    failures: Vec<String>,
}

impl Tally {
    fn note(&mut self, function: &str, class: &str, id: &str, error: f64, detail: String) {
        let bound = bound(function, class);
        if error.is_nan() || error > bound {
            self.failures.push(format!("{function} {id}: {detail}, error {error} > {bound}"));
        }
        let entry = self.worst.entry(format!("{function} {class}")).or_default();
        if error >= entry.0 {
            *entry = (error, id.to_owned());
        }
    }

    fn settle(self) {
        for (class, (error, id)) in self.worst {
            println!("{class:45} {error:8.3} at {id}");
        }
        assert!(self.failures.is_empty(), "{}", self.failures.join("\n"));
    }
}

/// Largest component of the error of a moment, in units of 2⁻⁵³ of the moment's largest component and of the floor that
/// belongs to `MOMENT_BOUND` of them.
fn moment_error(vertices: &[DVec3], got: DVec3, want: &[String; 3]) -> f64 {
    let nearest = DVec3::from_array([0, 1, 2].map(|i| want[i].parse().expect("a decimal")));
    let error = DVec3::from_array([0, 1, 2].map(|i| difference(got[i], &want[i])));
    let square = vertices.iter().map(|v| v.distance_squared(vertices[0])).fold(0.0, f64::max);
    let floor = solid_angle::MOMENT_FLOOR / solid_angle::MOMENT_BOUND * square;
    let unit = 0.5 * f64::EPSILON * nearest.abs().max_element() + floor;
    // Nothing at all, of three vertices at one place.
    if error == DVec3::ZERO { 0.0 } else { error.abs().max_element() / unit }
}

#[test]
fn documented_bounds_are_the_tested_ones() {
    assert_eq!(bound("polygon", "*"), solid_angle::ANGLE_BOUND);
    assert_eq!(bound("signed_polygon", "*"), solid_angle::ANGLE_BOUND);
    assert_eq!(bound("vector_moment", "*"), solid_angle::MOMENT_BOUND);
}

#[test]
fn every_moment_is_within_its_bound() {
    let mut tally = Tally::default();
    let mut moments = more().moments;
    for polygon in oracle() {
        if let Some(want) = moments.remove(&polygon.id) {
            let vertices = polygon.vertices();
            let got = solid_angle::vector_moment(&vertices).expect(&polygon.id);
            let detail = format!("got {got:?}, want {want:?}");
            tally.note("vector_moment", &polygon.cls, &polygon.id, moment_error(&vertices, got, &want), detail);
        }
    }
    assert!(moments.is_empty(), "moments of unknown polygons: {:?}", moments.keys());
    tally.settle();
}

#[test]
fn more_polygons_are_within_their_bounds() {
    let mut tally = Tally::default();
    for polygon in more().polygons {
        let vertices = vertices(&polygon.vertices);
        let (id, want) = (&polygon.id, &polygon.omega_signed);
        let got = solid_angle::signed_polygon(&vertices).expect(id);
        tally.note("signed_polygon", &polygon.cls, id, ulps(got, want), format!("got {got:e}, want {want}"));
        let (got, want) = (solid_angle::vector_moment(&vertices).expect(id), &polygon.moment);
        let detail = format!("got {got:?}, want {want:?}");
        tally.note("vector_moment", &polygon.cls, id, moment_error(&vertices, got, want), detail);
    }
    tally.settle();
}

#[test]
fn every_value_is_within_its_bound() {
    let mut tally = Tally::default();
    for polygon in oracle().iter().filter(|polygon| polygon.expect == "value" && polygon.cls != "non_unit") {
        let vertices = polygon.vertices();
        for (function, got, want) in [
            ("signed_polygon", solid_angle::signed_polygon(&vertices), &polygon.omega_signed),
            ("polygon", solid_angle::polygon(&vertices), &polygon.omega),
        ] {
            let want = want.as_deref().expect("a value");
            let got = got.expect(&polygon.id);
            tally.note(function, &polygon.cls, &polygon.id, ulps(got, want), format!("got {got:e}, want {want}"));
        }
    }
    tally.settle();
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
