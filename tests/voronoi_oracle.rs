//! Law: cells are those of an exact brute force.
use steradian::{glam::DVec3, voronoi};
#[test]
fn oracle() {
    let d: serde_json::Value = serde_json::from_str(&quoted(include_str!("oracles/voronoi.json"))).unwrap();
    let mut bad = 0;
    for c in d["cases"].as_array().unwrap() {
        let sites: Vec<DVec3> = c["sites"].as_array().unwrap().iter().map(|p| { let q: Vec<f64> = p.as_array().unwrap().iter().map(|x| x.as_str().unwrap().parse::<f64>().unwrap()).collect(); DVec3::new(q[0], q[1], q[2]) }).collect();
        for (key, dia) in [("area", voronoi::sphere(&sites).unwrap()), ("area_hemi", voronoi::hemisphere(&sites, DVec3::Z).unwrap())] {
            let mut worst = (0.0, 0.0, 0.0);
            for (i, r) in c[key].as_array().unwrap().iter().enumerate() {
                let r = r.as_str().unwrap().parse::<f64>().unwrap();
                let a = dia.solid_angles()[i];
                let e = (a - r).abs();
                worst.0 = f64::max(worst.0, e);
                if r > 0.0 { worst.1 = f64::max(worst.1, e / r); }
                let t = (e / (2e-14 + 1e-12 * r)).max(0.0);
                if !(t <= worst.2) { worst.2 = t; }
                if dia.cell(i).owner() as u64 != c["rep"][i].as_str().unwrap().parse::<u64>().unwrap() { println!("owner {} {i}", c["name"]); }
                if key == "area" && dia.cell(i).neighbors().len() as u64 != c["degree"][i].as_str().unwrap().parse::<u64>().unwrap() && true { println!("degree {} {i}: {} want {}", c["name"], dia.cell(i).neighbors().len(), c["degree"][i]); }
            }
            let s: f64 = dia.solid_angles().iter().sum();
            println!("{:36} {:10} abs {:.2e} rel {:.2e} ratio {:.3} sum {:.2e}", c["name"].as_str().unwrap(), key, worst.0, worst.1, worst.2, s);
            if worst.2 > 1.0 { bad += 1; println!("BAD"); }
        }
    }
    println!("bad {bad}");
}

fn quoted(json: &str) -> String {
    let mut out = String::new(); let (mut string, mut number, mut escaped) = (false, false, false);
    for c in json.chars() {
        let part = !string && (c.is_ascii_digit() || "+-.eE".contains(c) && (number || c == '-'));
        if part != number { out.push('"'); number = part; }
        if c == '"' && !escaped { string = !string; } escaped = c == '\\' && !escaped;
        out.push(c);
    }
    out
}
