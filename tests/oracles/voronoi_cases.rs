//! Reads the cases of voronoi.json.
#![allow(dead_code, reason = "each user takes a part of it")]

use serde::Deserialize;
use steradian::glam::DVec3;

#[derive(Deserialize)]
pub struct Oracle {
    pub cases: Vec<Case>,
    pub invalid: Vec<Invalid>,
}

#[derive(Deserialize)]
pub struct Case {
    pub name: String,
    pub sites: Vec<[String; 3]>,
    pub rep: Vec<String>,
    pub area: Vec<String>,
    pub area_hemi: Vec<String>,
    pub edges: Vec<[String; 2]>,
}

#[derive(Deserialize)]
pub struct Invalid {
    pub name: String,
    pub sites: Vec<[String; 3]>,
}

/// The oracle with every number as a string, for its doubles must be read correctly rounded.
pub fn oracle() -> Oracle {
    let mut json = String::new();
    let (mut in_string, mut in_number, mut escaped) = (false, false, false);
    for c in include_str!("voronoi.json").chars() {
        let numeric = !in_string && (c.is_ascii_digit() || c == '-' || in_number && "+.eE".contains(c));
        if numeric != in_number {
            json.push('"');
            in_number = numeric;
        }
        in_string ^= c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        json.push(c);
    }
    serde_json::from_str(&json).expect("tests/oracles/voronoi.json has the fields of `Oracle`")
}

pub fn parse<T: std::str::FromStr>(text: &str) -> T {
    text.parse().unwrap_or_else(|_| panic!("a number was expected in the oracle, got {text:?}"))
}

pub fn vectors(sites: &[[String; 3]]) -> Vec<DVec3> {
    sites.iter().map(|[x, y, z]| DVec3::new(parse(x), parse(y), parse(z))).collect()
}

/// The cases alone.
pub fn cases() -> Vec<Case> {
    oracle().cases
}
