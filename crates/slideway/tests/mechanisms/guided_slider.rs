//! A guided slider whose couple is more than its pressure can give, beside the same slider as a block slider.

use crate::answers::{acceleration, assert_close, only, report_on};
use proptest::prelude::*;
use slideway::map::{ColourBy, MapOptions, map};
use slideway::report::{SolveReport, Status, Style};
use slideway::size::{Against, SizeOptions, size};
use slideway::{DriveOptions, LimitsOptions, Model, Report, Settings, Vary, drive, limits, solve};

/// One body on one slider, with a force and a torque.
#[derive(Debug, Clone)]
struct Sledge {
    slope: f64,
    length: f64,
    height: f64,
    around: bool,
    mu: f64,
    rate: f64,
    centre: [f64; 2],
    force: [f64; 2],
    moment: f64,
}

impl Sledge {
    fn report(&self, kind: &str) -> SolveReport {
        let Self { slope, length, height, around, mu, rate, centre, force, moment } = self;
        let fit = if *around { "around" } else { "inside" };
        report_on(&format!(
            r#"
            gravity = 9.81
            [points]
            S = [{}, {}]
            [bodies.sledge]
            points = ["S"]
            mass = 2
            centre_of_mass = "S"
            moment_of_inertia = 0.05
            [joints.base]
            type = "{kind}"
            block = "sledge"
            at = [0, 0]
            along = "{slope} deg"
            length = {length}
            height = {height}
            fit = "{fit}"
            mu = {mu}
            [loads.P]
            type = "force"
            at = "sledge.S"
            components = [{}, {}]
            [loads.T]
            type = "torque"
            body = "sledge"
            moment = {moment}
            [coordinates.s]
            slide = "base"
            rate = {rate}
            "#,
            centre[0], centre[1], force[0], force[1]
        ))
    }
}

impl Sledge {
    /// The normal forces of all solutions of the block slider, from its balance by hand: with the centre of
    /// mass at (d, c) from the middle, along and across the guide, h' the height, negative around the guide,
    ///     N_f + N_r = -P_n,
    ///     N_f (L/2 - d) - N_r (L/2 + d) - F_f (sigma_f h'/2 + c) - F_r (sigma_r h'/2 + c) + T = 0,  F = mu |N| s.
    fn by_hand(&self) -> Vec<[f64; 2]> {
        let (sin, cos) = self.slope.to_radians().sin_cos();
        let d = self.centre[0] * cos + self.centre[1] * sin;
        let c = -self.centre[0] * sin + self.centre[1] * cos;
        let across = -self.force[0] * sin + (self.force[1] - 2.0 * 9.81) * cos;
        let half_height = if self.around { -self.height } else { self.height } / 2.0;
        let friction = |sign: f64| self.mu * self.rate * (half_height + sign * c);
        let mut solutions = Vec::new();
        for [front, rear] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            // |N| = sign N
            let of_front = self.length / 2.0 - d - friction(front);
            let of_rear = -self.length / 2.0 - d - friction(rear);
            // N_f + N_r = -P_n and of_front N_f + of_rear N_r = -T
            let determinant = of_rear - of_front;
            let normal_front = (-across * of_rear + self.moment) / determinant;
            let normal = [normal_front, -across - normal_front];
            if normal[0] * front > 0.0 && normal[1] * rear > 0.0 {
                solutions.push(normal);
            }
        }
        solutions
    }

    /// Whether friction alone cannot hold a tipped block: its lever about the centre of mass is short.
    fn has_short_levers(&self) -> bool {
        let lever = self.centre[0].hypot(self.centre[1]) + self.height / 2.0;
        self.mu * lever < self.length / 2.0
    }
}

#[test]
fn a_couple_beyond_the_pressure_is_rejected_and_tips_the_block() {
    let sledge = Sledge {
        slope: 0.0,
        length: 0.4,
        height: 0.0,
        around: false,
        mu: 0.3,
        rate: 1.0,
        centre: [0.0, 0.0],
        force: [0.0, 0.0],
        moment: 10.0,
    };
    // N = m g = 19.62 N gives a couple of at most 19.62 * 0.2 = 3.924 N m; 10 N m are needed.
    let guided = sledge.report("guided_slider");
    assert_eq!(guided.status, Status::None);
    assert_eq!(guided.patterns.unwrap().rejected, 1);
    let [rejection] = &guided.rejected[..] else { panic!("one rejection") };
    assert_eq!((rejection.pattern.as_str(), rejection.joint.as_str()), ("+", "base"));
    assert_close(rejection.couple, -10.0, 0.0, 1e-12);
    assert_close(rejection.limit, 3.924, 0.0, 1e-12);
    assert_close(rejection.normal_forces[0], 19.62, 0.0, 1e-12);
    let text = guided.text(slideway::report::Style::PLAIN);
    assert!(text.contains("base") && text.contains("tip"), "{text}");

    // N_f + N_r = m g and (N_f - N_r) L/2 = -10 N m.
    let block = sledge.report("block_slider");
    let solution = only(&block);
    assert_eq!(solution.signs, [-1, 1]);
    assert_close(solution.contacts[0].normal_force, 9.81 - 25.0, 0.0, 1e-12);
    assert_close(solution.contacts[1].normal_force, 9.81 + 25.0, 0.0, 1e-12);
    assert_eq!(solution.joints[0].mode, "touching at upper right and lower left");
    // Its friction is that of the sum of both normal forces, more than the guided slider could know of.
    assert_close(acceleration(solution, "sledge")[0], -0.3 * 50.0 / 2.0, 0.0, 1e-12);
}

#[test]
fn a_couple_at_the_limit_is_the_slider_about_to_tip() {
    let sledge = |moment: f64| Sledge {
        slope: 0.0,
        length: 0.4,
        height: 0.1,
        around: false,
        mu: 0.3,
        rate: -1.0,
        centre: [0.0, 0.05],
        force: [0.0, 0.0],
        moment,
    };
    // About the middle of the pressed face, h/2 below the centre line, friction mu m g acts along +x at the
    // height c = 0.05 + h/2 below the centre of mass: C = -mu m g c - T there is the couple of the pressure.
    let limit = 9.81 * 2.0 * (0.2 - 0.3 * 0.1);
    assert_eq!(sledge(-limit - 9.81 * 2.0 * 0.06 + 1e-6).report("guided_slider").solutions.len(), 1);
    for (moment, solutions) in [(-limit + 1e-6, 1), (-limit - 0.06 * 19.62 - 1e-6, 0)] {
        assert_eq!(sledge(moment).report("guided_slider").solutions.len(), solutions, "{moment}");
    }
}

fn sledges() -> impl Strategy<Value = Sledge> {
    let geometry = (-80.0..80.0_f64, 0.1..1.0_f64, 0.0..0.5_f64, any::<bool>());
    let motion = (0.0..1.5_f64, prop_oneof![Just(1.0), Just(-1.0)]);
    let load = (prop::array::uniform2(-0.5..0.5_f64), prop::array::uniform2(-60.0..60.0_f64), -8.0..8.0_f64);
    (geometry, motion, load).prop_map(|(geometry, motion, load)| {
        let ((slope, length, height, around), (mu, rate)) = (geometry, motion);
        let (centre, force, moment) = load;
        Sledge { slope, length, height, around, mu, rate, centre, force, moment }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_the_guided_slider_rejects_tips_as_a_block(sledge in sledges()) {
        let guided = sledge.report("guided_slider");
        let block = sledge.report("block_slider");
        // The normal force of a single guided slider does not depend on friction.
        prop_assert_eq!(guided.solutions.len() + guided.rejected.len(), 1);
        let flat = |report: &SolveReport| report.solutions.iter().filter(|s| s.signs[0] == s.signs[1]).count();
        let tipped = |report: &SolveReport| report.solutions.iter().filter(|s| s.signs[0] != s.signs[1]).count();
        let by_hand = sledge.by_hand();
        prop_assert_eq!(block.solutions.len(), by_hand.len());
        for (solution, by_hand) in block.solutions.iter().zip(&by_hand) {
            for (contact, by_hand) in solution.contacts.iter().zip(by_hand) {
                assert_close(contact.normal_force, *by_hand, by_hand.abs().max(1.0), 1e-9);
            }
        }
        if let [rejection] = &guided.rejected[..] {
                prop_assert!(rejection.couple.abs() > rejection.limit);
                prop_assert_eq!(guided.status, Status::None);
                prop_assert_eq!(flat(&block), 0);
                // It tips, unless its own friction drives the tipping: then it may jam (textbook.rs, a sledge
                // too high for its friction).
                if sledge.has_short_levers() {
                    prop_assert!(tipped(&block) > 0, "{:?}", block.status);
                }
        } else {
                // Flat as a block as well, with the same resultant and motion.
                let solution = only(&guided);
                prop_assert_eq!(flat(&block), 1);
                let same = block.solutions.iter().find(|s| s.signs[0] == s.signs[1]).unwrap();
                let sum: f64 = same.contacts.iter().map(|contact| contact.normal_force).sum();
                assert_close(sum, solution.contacts[0].normal_force, 0.0, 1e-10);
                let couple = solution.contacts[0].couple.unwrap();
                let difference = same.contacts[0].normal_force - same.contacts[1].normal_force;
                assert_close(difference * sledge.length / 2.0, couple, sum * sledge.length, 1e-10);
                for (one, other) in acceleration(solution, "sledge").iter().zip(acceleration(same, "sledge")) {
                    assert_close(*one, other, 9.81, 1e-10);
                }
        }
    }
}

#[test]
fn the_line_of_the_preload_shows_in_the_couple() {
    // Preload friction of 6 N on a level sledge whose centre of mass is on the centre line: at the pressed
    // face, h/2 below, it needs the couple 6 N h/2; on the centre line it needs none.
    for (line, couple) in [("pressed", 0.6), ("centre", 0.0)] {
        let report = report_on(&format!(
            r#"
            gravity = 9.81
            [bodies.sledge]
            mass = 2
            centre_of_mass = [0, 0]
            moment_of_inertia = 0.05
            [joints.base]
            type = "guided_slider"
            block = "sledge"
            at = [0, 0]
            along = "0 deg"
            length = 0.4
            height = 0.2
            mu = 0
            preload = 6
            preload_line = "{line}"
            [coordinates.s]
            slide = "base"
            rate = 1
            "#
        ));
        let solution = only(&report);
        assert_close(solution.contacts[0].couple.unwrap(), couple, 1.0, 1e-12);
        assert_close(acceleration(solution, "sledge")[0], -3.0, 0.0, 1e-12);
    }
}

/// A press and a wedge from an independent review: where their guided sliders tip, block sliders move.
const PRESS: &str = include_str!("../findings/tipping_press.toml");
const WEDGE: &str = include_str!("../findings/tipping_wedge.toml");

fn with_mu(text: &str, mu: f64) -> Model {
    let model = Model::parse(text).expect("sound");
    model.with(&Settings::default().parameter("mu", mu)).expect("a coefficient of friction")
}

fn is_no_lock(text: &str) {
    assert!(
        !text.contains("jams") && !text.contains("friction locks") && !text.contains("no effort"),
        "{text}"
    );
}

/// The bed is 0.1 m long, and friction acts 0.04 m from its middle: `0.04 m mu N <= 0.05 m N` up to mu = 1.25.
#[test]
fn a_slider_that_tips_is_not_told_as_locked() {
    let model = with_mu(PRESS, 1.3);
    let solved = solve(&model).expect("an answer").text(Style::PLAIN.width(200));
    let below = "It does not tip below mu = 1.25.";
    assert!(solved.contains(below), "{solved}");
    is_no_lock(&solved);
    let driven = drive(&model, &DriveOptions::default()).expect("an answer");
    assert!(driven.directions.iter().all(|direction| direction.tips == ["bed"]));
    assert_eq!(
        driven.conclusion[..2],
        ["It tips (bed), which only a block slider can show.", "It does not tip below mu = 1.25."]
    );
    is_no_lock(&driven.text(Style::PLAIN));
    let limits = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 2.0))).expect("an answer");
    let [moves, tips] = limits.counts.as_slice() else { panic!("{:?}", limits.counts) };
    assert_eq!((moves.solutions, tips.solutions), (1, 0));
    assert!((tips.from - 1.25).abs() < 1e-9, "{}", tips.from);
    let tipping = tips.tipping.as_ref().expect("it tips");
    assert_eq!((tipping.joints.as_slice(), tipping.throughout), (["bed".to_owned()].as_slice(), true));
    is_no_lock(&limits.conclusion.join(" "));
    // Where friction would have to fall to, and that no effort is known.
    let tips = "it tips (bed), which only a block slider can show";
    for (against, margin, told) in [
        (Against::Locking, 1.0, format!("{tips}; friction would have to fall to 0.9615 of its value.")),
        (Against::Effort { drive: None }, 1e5, format!("{tips}, so the limit is not kept.")),
    ] {
        let options = SizeOptions::new(Vary::between("mu", 0.1, 2.0), margin).against(against);
        let sized = size(&model, &options).expect("an answer");
        assert_eq!(sized.conclusion[1], format!("The model has mu = 1.3: {told}"));
    }
    let plane = MapOptions::new(Vary::between("mu", 1.3, 2.0), Vary::between("Q", 1.0, 2.0)).size(4, 4);
    let mapped = map(&model, &plane).expect("an answer");
    let words: Vec<&str> = mapped.classes.iter().map(|class| class.words.as_str()).collect();
    assert_eq!(words, ["no solution: a guided slider tips (model it as a block slider)"]);
    let plane = plane.colour_by(ColourBy::Jam);
    assert_eq!(
        map(&model, &plane).expect("an answer").classes[0].words,
        "a guided slider tips in both directions"
    );
    assert_eq!(
        solve(&with_mu(&PRESS.replace("guided", "block"), 1.3)).expect("an answer").status,
        Status::One
    );
}

/// As an independent review found, the floor tips beyond 11.39 times the friction of 0.3; block sliders move at 3.5.
#[test]
fn a_margin_that_tipping_ends_says_so() {
    let model = Model::parse(WEDGE).expect("sound");
    let margins = solve(&model).expect("an answer").margins.expect("few modes");
    assert_eq!(margins.tips, ["floor"]);
    assert!((margins.no_solution.expect("it tips") - 11.39).abs() < 0.005);
    let driven = drive(&model, &DriveOptions::default()).expect("an answer");
    assert_eq!(driven.directions[0].tips, ["floor"]);
    let beyond = "It would tip (floor) from mu = 3.418 (11.39 times this friction), which only a block slider can show.";
    assert!(driven.conclusion.iter().any(|sentence| sentence == beyond), "{:?}", driven.conclusion);
    is_no_lock(&driven.conclusion.join(" "));
    assert_eq!(
        solve(&with_mu(&WEDGE.replace("guided", "block"), 3.5)).expect("an answer").status,
        Status::One
    );
}
