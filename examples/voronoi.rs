use steradian::{glam::DVec3, voronoi::Builder};
fn main() {
    let mode = std::env::args().nth(1).unwrap(); let n: usize = std::env::args().nth(2).unwrap().parse().unwrap();
    let reps: usize = std::env::args().nth(3).unwrap().parse().unwrap();
    let mut s = 88172645463325252u64;
    let mut r = || { s ^= s << 13; s ^= s >> 7; s ^= s << 17; (s >> 11) as f64 / 9007199254740992.0 };
    let rows = (n as f64 / 2.0).sqrt().round() as usize; let columns = n / rows;
    let sites: Vec<DVec3> = (0..n).map(|k| { let (u, v) = match mode.as_str() { "random" => (r(), r()), "strat" => (((k % columns) as f64 + r()) / columns as f64, ((k / columns) as f64 + r()) / rows as f64), _ => (((k % columns) as f64 + 0.5) / columns as f64, ((k / columns) as f64 + 0.5) / rows as f64) };
        let q = (1.0 - v * v).max(0.0).sqrt(); let t = std::f64::consts::TAU * u; DVec3::new(q * t.cos(), q * t.sin(), v) }).collect();
    let mut b = Builder::new();
    let mut best = f64::MAX;
    for _ in 0..reps { let t = cpu_time::ThreadTime::now(); b.hemisphere(&sites, DVec3::Z).unwrap(); best = best.min(t.elapsed().as_secs_f64()); }
    println!("{mode} {n}: {:.1} us", best * 1e6);
}
