//! Random mechanisms in random states: every picture is finite, and its labels keep clear of each other.

use crate::Case;
use crate::random_mechanisms::{cases, mechanisms};
use proptest::prelude::*;
use slideway::model::{Model, Settings};
use slideway_pictures::drawing::Shown;
use slideway_pictures::drawing::svg::{self, Colours};
use slideway_pictures::theme::LIGHT;

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn pictures_are_sound(drawing in mechanisms(), size in prop_oneof![Just(1.0), Just(1e-6), Just(1e5)]) {
        let units = crate::drawing::Units { length: size, mass: 1.0, time: 1.0 };
        let text = drawing.scaled(units).text();
        prop_assume!(Model::parse(&text).is_ok_and(|model| {
            slideway::mechanism::Mechanism::new(&model)
                .is_ok_and(|mechanism| slideway::configuration::Configuration::new(&mechanism).is_ok())
        }));
        let case = Case::new(&text, &Settings::default());
        let sheet = case.sheet(Shown::All).unwrap();
        prop_assert!(sheet.bounds.size().iter().all(|side| side.is_finite() && *side < 20_000.0));
        for element in &sheet.scene.elements {
            let bounds = element.shape.bounds().unwrap();
            prop_assert!(sheet.bounds.contains(&bounds.least) && sheet.bounds.contains(&bounds.greatest));
        }
        let texts: Vec<_> = sheet.scene.texts().map(|(_, text)| text.bounds()).collect();
        for (index, text) in texts.iter().enumerate() {
            prop_assert!(texts[..index].iter().all(|other| !text.overlaps(other)));
        }
        prop_assert!(svg::write(&sheet.scene, &sheet.frame(None, Colours::Theme(LIGHT))).is_ok());
    }
}
