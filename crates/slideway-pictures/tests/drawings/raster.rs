//! Pictures of pixels.

use slideway_pictures::raster::{RasterFault, png};

fn svg(body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"30\" font-size=\"20\">{body}</svg>"
    )
}

/// Text needs no typeface of the machine: its pixels differ from an empty picture, and from those of other
/// text.
#[test]
fn text_is_drawn_with_the_typeface_that_is_built_in() {
    let empty = png(&svg(""), 1.0).unwrap();
    let text =
        png(&svg("<text x=\"30\" y=\"20\" text-anchor=\"middle\">\u{3bc} \u{2212} 1</text>"), 1.0).unwrap();
    let parts = png(
        &svg("<text x=\"30\" y=\"20\" text-anchor=\"middle\"><tspan>\u{3bc} \u{2212} 2</tspan></text>"),
        1.0,
    )
    .unwrap();
    assert!(text.len() > empty.len() && text != parts);
}

#[test]
fn sizes_that_make_no_sense_are_refused() {
    for scale in [0.0, 1e-9, 1e9, f64::NAN] {
        assert!(matches!(png(&svg(""), scale), Err(RasterFault::Size { .. })), "{scale}");
    }
    assert!(matches!(png("no picture", 1.0), Err(RasterFault::NotSvg(_))));
}

/// The first 24 bytes of a PNG hold its width and height.
#[test]
fn scale_is_pixels_for_each_unit() {
    let picture = png(&svg(""), 2.5).unwrap();
    let side = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
    assert_eq!((side(16), side(20)), (150, 75));
}
