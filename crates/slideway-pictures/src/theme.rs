//! Colours and line styles that all pictures share.

use serde::Serialize;

/// Colours of a picture, as CSS colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Theme {
    /// Behind everything.
    pub background: &'static str,
    /// Text, axes, outlines.
    pub ink: &'static str,
    /// Grid lines, dimensions, what matters less.
    pub(crate) muted: &'static str,
    /// The insides of bodies.
    pub(crate) body: &'static str,
    /// Reactions.
    pub(crate) reaction: &'static str,
    /// Friction.
    pub(crate) friction: &'static str,
    /// Warnings: locking, jams.
    pub(crate) warning: &'static str,
    /// Branches, modes and areas, in the order in which they are given out.
    pub series: [&'static str; 8],
}

/// Dash patterns of SVG lines, one for each branch; the first is a solid line.
pub const DASHES: [&str; 4] = ["", "7 3", "2 3", "9 3 2 3"];

/// On white. The series are colours of Okabe and Ito, which colour-blind people can tell apart (K. Ichihara,
/// M. Okabe, K. Iga, Y. Tanaka, K. Musha and K. Ito, Color universal design, 2008); its second blue comes
/// late, as it resembles the first, and its yellow last, as it is faint on white.
pub const LIGHT: Theme = Theme {
    background: "#ffffff",
    ink: "#1b1f24",
    muted: "#626b76",
    body: "#e6edf5",
    reaction: "#0072b2",
    friction: "#d55e00",
    warning: "#c01818",
    series: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#4d4d4d", "#b8a900"],
};

/// On a dark background.
pub const DARK: Theme = Theme {
    background: "#0d1117",
    ink: "#e6edf3",
    muted: "#949da8",
    body: "#243447",
    reaction: "#56b4e9",
    friction: "#ff9a4d",
    warning: "#ff5a52",
    series: ["#56b4e9", "#ff9a4d", "#2fc79a", "#e79fc6", "#e69f00", "#3a8fd0", "#b0b0b0", "#f0e442"],
};

#[cfg(test)]
mod tests {
    use super::{DARK, LIGHT};

    /// Relative luminance of a colour (WCAG 2.2).
    fn luminance(colour: &str) -> f64 {
        let channel = |from: usize| {
            let part = u8::from_str_radix(&colour[from..from + 2], 16).expect("two digits");
            let part = f64::from(part) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    /// WCAG 2.2, success criterion 1.4.3: at least 4.5 for text; dimensions are muted, and stand over bodies, too.
    #[test]
    fn text_can_be_read() {
        for theme in [LIGHT, DARK] {
            for (text, behind) in [theme.ink, theme.muted]
                .into_iter()
                .flat_map(|text| [(text, theme.background), (text, theme.body)])
            {
                let [one, other] = [text, behind].map(luminance);
                let contrast = (one.max(other) + 0.05) / (one.min(other) + 0.05);
                assert!(contrast >= 4.5, "{text} on {behind}: {contrast}");
            }
        }
    }
}
