//! The gallery: documented model files to start from, each with a test that it shows what it says.

/// A model of the gallery. Which questions it answers, [`check`](mod@crate::check) says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GalleryModel {
    /// Its name: that of its file without the ending.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

macro_rules! gallery {
    ($($name:literal),* $(,)?) => {
        &[$(GalleryModel { name: $name, text: include_str!(concat!("../models/", $name, ".toml")) }),*]
    };
}

/// All models of the gallery.
pub const MODELS: &[GalleryModel] = gallery![
    "klepp-2002",
    "klepp-2002-spring",
    "painleve-klein",
    "drawer",
    "cam-follower",
    "bracket-on-pole",
    "screw",
    "wedge",
    "slider-crank",
    "slider-crank-with-pins",
    "toggle-press",
    "bell-crank",
    "four-bar",
    "quick-return",
    "over-centre-clamp",
    "scotch-yoke",
    "elliptic-trammel",
    "sleeve-on-arm",
    "telescopic-boom",
    "frictional-oscillator",
    "stick-slip",
    "stribeck-belt",
    "thrown-drawer",
    "soft-closing-drawer",
    "drawer-on-two-rails",
    "carriage-on-two-rods",
    "gate-on-two-posts",
    "three-pad-telescope",
    "ladder",
    "box-on-incline",
    "rod-on-floor",
    "peg-in-hole",
    "latch-with-pawl",
    "cam-and-spring",
    "nip-of-rolls",
    "shaft-in-v-block",
    "woodpecker",
    "rattling-drawer",
    "boom-in-wind",
    "drawer-on-runners",
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
        let text = paragraph.join(" ");
        let text = text.trim_start_matches("What it shows: ");
        // A sentence that announces the commands below it ends in a colon.
        let whole = match text.strip_suffix(':') {
            Some(announcing) => announcing.rfind(". ").map_or("", |end| &announcing[..=end]),
            None => text,
        };
        let mut characters = whole.chars();
        characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
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

/// Name of the model that [`telescopic_boom`] writes with another number of stages.
pub const TELESCOPIC_BOOM: &str = "telescopic-boom";

/// Greatest number of stages that [`telescopic_boom`] writes.
pub const GREATEST_STAGES: usize = 1000;

/// The telescopic boom of the gallery with another number of stages; nothing unless there are 1 to
/// [`GREATEST_STAGES`] of them.
///
/// ```
/// use slideway::gallery;
///
/// let boom = gallery::telescopic_boom(3).expect("a sensible number of stages");
/// assert_eq!(boom, gallery::find("telescopic-boom").expect("in the gallery").text);
/// assert!(gallery::telescopic_boom(0).is_none());
/// ```
pub fn telescopic_boom(stages: usize) -> Option<String> {
    if !(1..=GREATEST_STAGES).contains(&stages) {
        return None;
    }
    let count = if stages == 1 { "1 stage".to_owned() } else { format!("{stages} stages") };
    let text = find(TELESCOPIC_BOOM)?.text;
    let (opening, _) = text.split_once("[points]\n")?;
    let mut boom = opening.replace("3 stages", &count);
    boom.push_str("[points]\n");
    let all = 1..=stages;
    all.clone().for_each(|stage| boom.push_str(&points(stage)));
    all.clone().for_each(|stage| boom.push_str(&body(stage)));
    all.clone().for_each(|stage| boom.push_str(&slide(stage)));
    all.clone().for_each(|stage| boom.push_str(&cylinder(stage)));
    boom.push_str(&load(stages));
    all.for_each(|stage| boom.push_str(&coordinate(stage)));
    Some(boom)
}

/// Ends and middle of the overlap of a tube, counted along the boom from the mouth of the first tube.
fn points(stage: usize) -> String {
    let before = stage - 1;
    let (tail, middle) = if before == 0 {
        ("-overlap".to_owned(), "-overlap/2".to_owned())
    } else {
        let lengths = times(before, "length");
        (format!("({lengths} - {stage}*overlap)"), format!("({lengths} - {before}.5*overlap)"))
    };
    let tip = format!("({} - {})", times(stage, "length"), times(stage, "overlap"));
    [("tail", tail), ("middle", middle), ("tip", tip)]
        .map(|(name, along)| format!("{name}_{stage} = [\"{along}*cos(beta)\", \"{along}*sin(beta)\"]\n"))
        .concat()
}

fn times(count: usize, name: &str) -> String {
    if count == 1 { name.to_owned() } else { format!("{count}*{name}") }
}

fn body(stage: usize) -> String {
    format!(
        "\n[bodies.stage_{stage}]\npoints = [\"tail_{stage}\", \"tip_{stage}\"]\nmass = \"m\"\n\
         shape = {{ bar = [\"tail_{stage}\", \"tip_{stage}\"] }}\n"
    )
}

fn slide(stage: usize) -> String {
    let guide = if stage == 1 { "ground".to_owned() } else { format!("stage_{}", stage - 1) };
    format!(
        "\n[joints.slide_{stage}]\ntype = \"block_slider\"\nblock = \"stage_{stage}\"\nguide = \"{guide}\"\n\
         at = \"middle_{stage}\"\nalong = \"beta\"\nlength = \"overlap\"\nheight = \"height\"\n\
         front = {{ carried_by = \"guide\" }}\nrear = {{ carried_by = \"block\" }}\nmu = \"mu\"\n"
    )
}

/// The cylinder that pushes a tube out of the one before it.
fn cylinder(stage: usize) -> String {
    let reaction = if stage == 1 { String::new() } else { format!("reaction = \"stage_{}\"\n", stage - 1) };
    format!(
        "\n[loads.cylinder_{stage}]\ntype = \"force\"\nat = \"stage_{stage}.tail_{stage}\"\nmagnitude = \"F\"\n\
         direction = \"beta\"\n{reaction}"
    )
}

fn load(stages: usize) -> String {
    format!("\n[loads.W]\ntype = \"force\"\nat = \"stage_{stages}.tip_{stages}\"\ncomponents = [0, \"-W\"]\n")
}

fn coordinate(stage: usize) -> String {
    format!("\n[coordinates.s_{stage}]\nslide = \"slide_{stage}\"\nrate = \"v\"\n")
}
