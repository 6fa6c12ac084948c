//! The scripts of docs/proofs, written by running the kernels of the solid angle on numbers that record their operations.

#[allow(dead_code, reason = "the proofs take the arithmetic that they are about")]
#[path = "../../src/solid_angle/double.rs"]
mod double;
#[allow(dead_code, reason = "the proofs take the arithmetic that they are about")]
#[path = "../../src/solid_angle/kernel.rs"]
mod kernel;
mod symbolic;

use double::{Double, dot};
use kernel::Complex;
use symbolic::{Script, Symbolic};

/// Name and text of every script; what a name with `refused` in it claims is too tight to be true.
pub fn scripts() -> Vec<(String, String)> {
    let mut scripts = vec![
        ("norm.g".into(), norm()),
        ("denominator.g".into(), denominator(41, 92, kernel::DENOMINATOR_BOUND)),
        ("denominator_normalised.g".into(), denominator(51, 102, kernel::NORMALISED_DENOMINATOR_BOUND)),
        ("product.g".into(), product(kernel::PRODUCT_BOUND)),
        ("product_refused.g".into(), product(kernel::PRODUCT_BOUND / 4.0)),
    ];
    for scale in [0, 20] {
        let bound = kernel::NUMERATOR_BOUND * 2_f64.powi(-2 * scale);
        scripts.push((format!("numerator_{scale}.g"), numerator(scale, bound)));
    }
    scripts
}

/// The three coordinates of a vertex of the name `v`, at most 1.
fn vertex(script: &mut Script, v: &str) -> [Symbolic; 3] {
    ["x", "y", "z"].map(|axis| script.float(&format!("{v}{axis}"), "1"))
}

/// `Double`s as they leave an operation: the low half within 2⁻⁵² of a high half of at most 1.
fn double(script: &mut Script, name: &str) -> Double<Symbolic> {
    Double { hi: script.float(&format!("{name}h"), "1"), lo: script.float(&format!("{name}l"), "1b-52") }
}

fn numerator(scale: i32, bound: f64) -> String {
    let mut script = Script::new("apex·(p×q), differences of at most 2^-scale");
    let [a, b, c] = ["a", "b", "c"].map(|v| vertex(&mut script, v));
    let (p, q) = (kernel::offset(a, b), kernel::offset(a, c));
    for difference in p.iter().chain(&q) {
        script.assume_before_rounding(difference.hi, &format!("1b-{scale}"));
    }
    let result = kernel::numerator(a, &p, &q);
    script.claim(result, None, bound)
}

fn norm() -> String {
    let mut script = Script::new("|v|² − 1");
    let v = vertex(&mut script, "v");
    let result = kernel::norm_error(v);
    script.assume_exact(result, &format!("1b-{}", 40));
    script.expand_sums(result);
    let lo = script.zero();
    script.claim(Double { hi: result, lo }, None, kernel::NORM_BOUND)
}

/// `deviation`, `error`: | |v| − 1 | and the error of its double, as negative powers of two.
fn denominator(deviation: u32, error: u32, bound: f64) -> String {
    let mut script = Script::new("|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|");
    let [a, b, c] = ["a", "b", "c"].map(|v| vertex(&mut script, v));
    let excesses = ["ea", "eb", "ec"].map(|e| {
        let exact = format!("{e}_exact");
        script.assume(&exact, &format!("1b-{deviation}"));
        script.float_near(e, &exact, &format!("1b-{error}"))
    });
    let cosines = [dot(a, b), dot(b, c), dot(c, a)];
    let result = kernel::denominator(cosines, excesses);
    let [ab, bc, ca] = cosines.map(|cosine| script.exact(cosine.hi));
    let [ea, eb, ec] = ["ea", "eb", "ec"];
    let whole = format!(
        "(1 + {ea}_exact)*(1 + {eb}_exact)*(1 + {ec}_exact) + {ab}*(1 + {ec}_exact) + {bc}*(1 + {ea}_exact) + {ca}*(1 + {eb}_exact)"
    );
    // What is computed against the whole, in terms that are small one by one.
    let linear = |e: &str| format!("({e} - {e}_exact)");
    let step = format!(
        "{da} + {db} + {dc} + {bc}*{da} + {ca}*{db} + {ab}*{dc} + {da}*{eb} + {ea}_exact*{db} + {db}*{ec} + {eb}_exact*{dc} + {dc}*{ea} + {ec}_exact*{da} - {ea}_exact*{eb}_exact*{ec}_exact",
        da = linear(ea),
        db = linear(eb),
        dc = linear(ec),
    );
    script.claim(result, Some((whole, step)), bound)
}

fn product(bound: f64) -> String {
    let mut script = Script::new("the imaginary part of (y)(z); the real part is the same sum of two products");
    let [yr, yi, zr, zi] = ["yr", "yi", "zr", "zi"].map(|name| double(&mut script, name));
    let result = kernel::times(Complex { re: yr, im: yi }, Complex { re: zr, im: zi }).im;
    let whole = "(yrh + yrl)*(zih + zil) + (yih + yil)*(zrh + zrl)".to_owned();
    script.claim(result, Some((whole, "-(yrl*zil) - yil*zrl".to_owned())), bound)
}
