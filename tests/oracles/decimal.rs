//! Reads the numbers of the oracles: hexadecimal doubles, and decimals longer than a double.

/// The double written as `[-]0x1.8p-3`, exactly.
pub fn hexadecimal(text: &str) -> f64 {
    let (sign, digits) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (mantissa, exponent) = digits.strip_prefix("0x").and_then(|d| d.split_once('p')).expect("0x…p…");
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let bits = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hexadecimal digits");
    let exponent =
        exponent.parse::<i32>().expect("a binary exponent") - 4 * i32::try_from(fraction.len()).expect("short");
    // Two steps, so that neither power leaves the range.
    let half = exponent / 2;
    sign * (bits as f64 * 2_f64.powi(half)) * 2_f64.powi(exponent - half)
}

/// Significant digits that are compared.
const DIGITS: usize = 36;

/// Sign, `DIGITS` digits as an integer, and the power of ten of the first digit.
fn decimal(text: &str) -> (i128, i32) {
    let (sign, rest) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    let (mantissa, exponent) = rest.split_once(['e', 'E']).unwrap_or((rest, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let mut exponent =
        exponent.parse::<i32>().expect("a decimal exponent") + i32::try_from(whole.len()).expect("short") - 1;
    let all = format!("{whole}{fraction}");
    let digits = all.trim_start_matches('0');
    exponent -= i32::try_from(all.len() - digits.len()).expect("short");
    let digits: String = digits.chars().chain(std::iter::repeat('0')).take(DIGITS).collect();
    (sign * digits.parse::<i128>().expect("decimal digits"), exponent)
}

/// |got − want| in units of the last place of the double nearest to `want`, a decimal of any length.
pub fn ulps(got: f64, want: &str) -> f64 {
    let nearest: f64 = want.parse().expect("a decimal");
    if got == nearest && nearest == 0.0 {
        return 0.0;
    }
    difference(got, want) / (f64::from_bits(nearest.abs().to_bits() + 1) - nearest.abs())
}

/// |got − want|, without the rounding of either.
pub fn difference(got: f64, want: &str) -> f64 {
    // Every double has a finite decimal expansion, and the formatter prints as much of it as is asked for.
    let ((mut p, e), (mut q, f)) = (decimal(&format!("{got:.40e}")), decimal(want));
    match e - f {
        0 => {}
        1 => p *= 10,
        -1 => q *= 10,
        _ => return (got - want.parse::<f64>().expect("a decimal")).abs(),
    }
    let last = e.min(f) - i32::try_from(DIGITS).expect("short") + 1;
    format!("{}e{last}", (p - q).abs()).parse().expect("a decimal")
}
