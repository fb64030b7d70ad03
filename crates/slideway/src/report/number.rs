//! Numbers for people: five significant digits.

/// Values below this multiple of the greatest beside them are rounding errors, and shown as 0.
const NOISE: f64 = 1e-13;

/// A number with five significant digits; scientific where it is very large or small.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&magnitude) {
        return format!("{value:.4e}");
    }
    // At least five digits, all of an integer part.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is from 0 to 9")]
    let decimals = (4.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// [`number`], with rounding errors against `scale` shown as 0.
pub(crate) fn against(value: f64, scale: f64) -> String {
    if value.abs() <= NOISE * scale { "0".to_owned() } else { number(value) }
}
