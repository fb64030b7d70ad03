//! The gallery: documented model files to start from, each with a test that it shows what it says.

/// A model of the gallery.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GalleryModel {
    /// Its name: that of its file without the ending.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

macro_rules! gallery {
    ($($name:literal),* $(,)?) => {
        &[$(GalleryModel {
            name: $name,
            text: include_str!(concat!("../../../models/", $name, ".toml")),
        }),*]
    };
}

/// All models of the gallery.
pub const MODELS: &[GalleryModel] = gallery![
    "klepp-2002",
    "painleve-klein",
    "drawer",
    "cam-follower",
    "bracket-on-pole",
    "slider-crank",
    "scotch-yoke",
    "elliptic-trammel",
    "sleeve-on-arm",
    "telescopic-boom",
];

impl GalleryModel {
    /// The first line of its opening comment: what it is.
    pub fn summary(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches(['#', ' '])
    }

    /// The paragraph of its opening comment that says what it shows.
    pub fn shows(&self) -> String {
        let lines = self.text.lines().map(|line| line.trim_start_matches(['#', ' ']));
        let paragraph: Vec<&str> = lines
            .skip_while(|line| !line.starts_with("What it shows:"))
            .take_while(|line| !line.is_empty() && !line.starts_with("slideway "))
            .collect();
        paragraph.join(" ").trim_start_matches("What it shows: ").to_owned()
    }
}

/// The model with this name.
///
/// ```
/// assert!(slideway::gallery::find("drawer").is_some());
/// assert!(slideway::gallery::find("windmill").is_none());
/// ```
pub fn find(name: &str) -> Option<&'static GalleryModel> {
    MODELS.iter().find(|model| model.name == name)
}
