//! Random determinate mechanisms of several families, in random states and under random loads.

use crate::drawing::{
    Body, Contact, Coordinate, Drawing, Drive, Effort, GROUND, Joint, Kind, Load, Measured, Slider,
    SliderKind, Vector,
};
use proptest::collection::vec;
use proptest::prelude::*;

/// The configuration of proptest: so many cases, from a fixed seed.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        max_global_rejects: 4 * cases,
        rng_seed: proptest::test_runner::RngSeed::Fixed(2002),
        ..ProptestConfig::default()
    }
}

/// Any of the families.
pub(crate) fn mechanisms() -> impl Strategy<Value = Drawing> {
    prop_oneof![chain(false), chain(true), hinged_sliders(), slider_crank(), scotch_yoke(), sleeve_on_arm(),]
}

/// Numbers of one mechanism, drawn from plain ranges; they shrink towards zero.
fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    vec(-1.0..1.0_f64, count)
}

/// Takes numbers one after the other.
struct Source {
    numbers: std::vec::IntoIter<f64>,
}

impl Source {
    fn new(numbers: Vec<f64>) -> Self {
        Self { numbers: numbers.into_iter() }
    }

    /// A number from -size to size.
    fn any(&mut self, size: f64) -> f64 {
        size * self.numbers.next().expect("enough numbers")
    }

    fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * (self.any(0.5) + 0.5)
    }

    /// A number of at least 0.3 in size, with a random sign.
    fn rate(&mut self) -> f64 {
        let number = self.any(1.5);
        if number < 0.0 { number - 0.3 } else { number + 0.3 }
    }

    fn yes(&mut self) -> bool {
        self.any(1.0) > 0.0
    }

    fn vector(&mut self, size: f64) -> Vector {
        [self.any(size), self.any(size)]
    }

    fn body(&mut self, name: &str, centre: Vector) -> Body {
        let inertia = [self.between(0.5, 3.0), self.between(0.02, 0.5)];
        Body { name: name.to_owned(), inertia: Some(inertia), centre }
    }

    fn contact(&mut self, kind: SliderKind) -> Contact {
        let mu = self.between(0.0, 0.6);
        let one_sided = self.any(1.0) > 0.6;
        let other = self.between(0.0, 0.6);
        let preload = self.any(20.0).max(0.0);
        let other_preload = self.any(20.0).max(0.0);
        Contact {
            mu: [mu, if one_sided { other } else { mu }],
            preload: [preload, if one_sided { other_preload } else { preload }],
            centred_preload: self.yes() && kind != SliderKind::Pin,
            carried_by_guide: self.any(1.0) > 0.4 && kind == SliderKind::Block,
        }
    }

    fn slider(&mut self, kind: SliderKind, block: Option<usize>, guide: Option<usize>, at: Vector) -> Slider {
        let contacts = if kind == SliderKind::Block { 2 } else { 1 };
        Slider {
            kind,
            block,
            guide,
            at,
            along: self.any(3.1),
            length: self.between(0.3, 0.9),
            height: if kind == SliderKind::Pin { 0.0 } else { self.any(0.3).max(0.0) },
            around: self.yes() && kind != SliderKind::Pin,
            contacts: (0..contacts).map(|_| self.contact(kind)).collect(),
        }
    }

    fn block_or_guided(&mut self) -> SliderKind {
        if self.any(1.0) > -0.2 { SliderKind::Block } else { SliderKind::Guided }
    }

    /// A force on every body with mass, and some of every other kind of load.
    fn loads(&mut self, bodies: &[Body]) -> Vec<Load> {
        let mut loads = Vec::new();
        for (body, properties) in bodies.iter().enumerate() {
            let reaction = (body > 0 && self.any(1.0) > 0.5).then(|| body - 1);
            let (at, turns) = (self.vector(1.0), self.yes());
            loads.push(Load::Force { body, at, force: self.vector(30.0), turns, reaction });
            let near = |[x, y]: Vector| [[x + 0.7, y - 0.2], [x, y + 0.1]];
            let choice = self.any(3.0);
            let size = self.between(0.5, 20.0);
            let at = near(properties.centre);
            loads.push(match choice {
                choice if choice < -2.0 => Load::Torque { body, moment: size },
                choice if choice < -1.0 => Load::Spring {
                    between: [GROUND, Some(body)],
                    at,
                    stiffness: 3.0 * size,
                    free_length: 0.4,
                },
                choice if choice < 0.0 => Load::Damper { between: [GROUND, Some(body)], at, damping: size },
                choice if choice < 1.0 => Load::TorsionalSpring { body, stiffness: size },
                choice if choice < 2.0 => Load::TorsionalDamper { body, damping: 0.3 * size },
                _ => Load::Spring { between: [Some(body), GROUND], at, stiffness: size, free_length: 0.0 },
            });
        }
        loads
    }

    /// Drives the last coordinate of some of the mechanisms.
    fn driven(&mut self, mut drawing: Drawing) -> Drawing {
        let acceleration = self.any(5.0);
        let (lean, turns, at) = (self.any(0.5), self.yes(), self.vector(1.0));
        if self.any(1.0) < 0.3 {
            return drawing;
        }
        let last = drawing.coordinates.len() - 1;
        let drive =
            |body: usize, reaction, effort| Drive { coordinate: last, acceleration, body, reaction, effort };
        drawing.drives.push(match drawing.coordinates[last].what {
            Measured::Rotation(body) => drive(body, GROUND, Effort::Torque),
            Measured::Slide(joint) => {
                let Kind::Slider(slider) = &drawing.joints[joint].kind else {
                    panic!("a slide has a slider")
                };
                let effort = Effort::Force { at, direction: slider.along + lean, turns };
                match (slider.block, slider.guide) {
                    (Some(block), guide) => drive(block, guide, effort),
                    (None, guide) => drive(guide.expect("block or guide moves"), GROUND, effort),
                }
            }
        });
        drawing
    }

    fn gravity(&mut self) -> Vector {
        self.vector(9.81)
    }
}

fn slider(name: &str, slider: Slider) -> Joint {
    Joint { name: name.to_owned(), kind: Kind::Slider(slider) }
}

fn hinge(name: &str, between: [Option<usize>; 2], at: Vector) -> Joint {
    Joint { name: name.to_owned(), kind: Kind::Hinge { between, at } }
}

fn coordinate(name: &str, what: Measured, value: f64, rate: f64) -> Coordinate {
    Coordinate { name: name.to_owned(), what, value, rate }
}

/// Sliders on sliders, one to three; the last may be a pin.
fn chain(with_pin: bool) -> impl Strategy<Value = Drawing> {
    (1..=3_usize, numbers(160)).prop_map(move |(stages, numbers)| {
        let mut source = Source::new(numbers);
        let mut drawing = Drawing {
            gravity: source.gravity(),
            bodies: Vec::new(),
            joints: Vec::new(),
            loads: Vec::new(),
            coordinates: Vec::new(),
            drives: Vec::new(),
        };
        for stage in 0..stages {
            let centre = source.vector(1.0);
            drawing.bodies.push(source.body(&format!("stage_{stage}"), centre));
            let pin = with_pin && stage + 1 == stages;
            let kind = if pin { SliderKind::Pin } else { source.block_or_guided() };
            let (mut block, mut guide) = (Some(stage), stage.checked_sub(1));
            if source.any(1.0) > 0.3 {
                std::mem::swap(&mut block, &mut guide);
            }
            let at = source.vector(1.0);
            drawing.joints.push(slider(&format!("slide_{stage}"), source.slider(kind, block, guide, at)));
            let (value, rate) = (source.any(0.1), source.rate());
            drawing.coordinates.push(coordinate(&format!("s_{stage}"), Measured::Slide(stage), value, rate));
            if pin {
                let (value, rate) = (source.any(0.3), source.rate());
                drawing.coordinates.push(coordinate("phi", Measured::Rotation(stage), value, rate));
            }
        }
        drawing.loads = source.loads(&drawing.bodies);
        source.driven(drawing)
    })
}

/// As in Klepp's example: a bar hinged to a block at one end, its other end a pin in a slot or hinged to a
/// second block.
fn hinged_sliders() -> impl Strategy<Value = Drawing> {
    (any::<bool>(), any::<bool>(), numbers(160)).prop_map(|(second_block, massless, numbers)| {
        let mut source = Source::new(numbers);
        let slope = source.between(0.3, 1.3);
        let ends = [[0.0, 0.0], [slope.cos(), slope.sin()]];
        let mut bodies = vec![source.body("bar", [0.5 * slope.cos(), 0.5 * slope.sin()])];
        bodies.push(source.body("lower", ends[0]));
        let lower_kind = source.block_or_guided();
        let mut lower = source.slider(lower_kind, Some(1), GROUND, ends[0]);
        lower.along *= 0.1;
        let mut joints = vec![slider("lower", lower), hinge("A", [Some(0), Some(1)], ends[0])];
        if second_block {
            bodies.push(source.body("upper", ends[1]));
            let upper_kind = source.block_or_guided();
            let mut upper = source.slider(upper_kind, Some(2), GROUND, ends[1]);
            upper.along *= 0.1;
            joints.push(slider("upper", upper));
            joints.push(hinge("B", [Some(2), Some(0)], ends[1]));
        } else {
            let mut upper = source.slider(SliderKind::Pin, Some(0), GROUND, ends[1]);
            upper.along *= 0.1;
            joints.push(slider("upper", upper));
        }
        if massless {
            bodies.iter_mut().skip(1).for_each(|body| body.inertia = None);
        }
        let coordinates = vec![coordinate("q", Measured::Slide(0), source.any(0.05), source.rate())];
        let gravity = source.gravity();
        let loads = source.loads(&bodies);
        source.driven(Drawing { gravity, bodies, joints, loads, coordinates, drives: Vec::new() })
    })
}

/// Crank, rod and piston; ground may be the block and the piston its guide.
fn slider_crank() -> impl Strategy<Value = Drawing> {
    numbers(160).prop_map(|numbers| {
        let mut source = Source::new(numbers);
        let angle = source.any(3.0);
        let crank_pin = [0.3 * angle.cos(), 0.3 * angle.sin()];
        let wrist = [source.between(0.7, 1.2), source.any(0.2)];
        let middle = [0.5 * (crank_pin[0] + wrist[0]), 0.5 * (crank_pin[1] + wrist[1])];
        let offset = source.vector(0.1);
        let bodies = vec![
            source.body("crank", offset),
            source.body("rod", middle),
            source.body("piston", [wrist[0] + 0.1, wrist[1]]),
        ];
        let (mut block, mut guide) = (Some(2), GROUND);
        if source.yes() {
            std::mem::swap(&mut block, &mut guide);
        }
        let at = [wrist[0] + source.any(0.2), wrist[1] + source.any(0.2)];
        let kind = source.block_or_guided();
        let mut cylinder = source.slider(kind, block, guide, at);
        cylinder.along *= 0.1;
        let joints = vec![
            hinge("O", [Some(0), GROUND], [0.0, 0.0]),
            hinge("A", [Some(1), Some(0)], crank_pin),
            slider("cylinder", cylinder),
            hinge("B", [Some(2), Some(1)], wrist),
        ];
        let coordinates = vec![coordinate("phi", Measured::Rotation(0), source.any(0.4), source.rate())];
        let gravity = source.gravity();
        let loads = source.loads(&bodies);
        source.driven(Drawing { gravity, bodies, joints, loads, coordinates, drives: Vec::new() })
    })
}

/// A crank whose pin slides in a slot of a yoke, which slides on ground.
fn scotch_yoke() -> impl Strategy<Value = Drawing> {
    numbers(160).prop_map(|numbers| {
        let mut source = Source::new(numbers);
        let angle = source.any(3.0);
        let pin = [0.3 * angle.cos(), 0.3 * angle.sin()];
        let bodies = vec![source.body("crank", [0.0, 0.0]), source.body("yoke", [0.5, 0.1])];
        let mut slot = source.slider(SliderKind::Pin, Some(0), Some(1), pin);
        slot.along = std::f64::consts::FRAC_PI_2 + source.any(0.4);
        let kind = source.block_or_guided();
        let mut guide = source.slider(kind, Some(1), GROUND, [0.8, 0.1]);
        guide.along *= 0.1;
        let joints =
            vec![slider("guide", guide), slider("pin", slot), hinge("O", [GROUND, Some(0)], [0.0, 0.0])];
        let coordinates = vec![coordinate("phi", Measured::Rotation(0), source.any(0.4), source.rate())];
        let gravity = source.gravity();
        let loads = source.loads(&bodies);
        source.driven(Drawing { gravity, bodies, joints, loads, coordinates, drives: Vec::new() })
    })
}

/// A sleeve on an arm that swings: a moving guide, centripetal and Coriolis terms.
fn sleeve_on_arm() -> impl Strategy<Value = Drawing> {
    numbers(160).prop_map(|numbers| {
        let mut source = Source::new(numbers);
        let centre = source.vector(0.8);
        let bodies = vec![source.body("arm", [0.4, 0.1]), source.body("sleeve", centre)];
        let kind = source.block_or_guided();
        let at = source.vector(0.8);
        let (mut block, mut guide) = (Some(1), Some(0));
        if source.yes() {
            std::mem::swap(&mut block, &mut guide);
        }
        let joints = vec![
            hinge("O", [Some(0), GROUND], [0.0, 0.0]),
            slider("sleeve", source.slider(kind, block, guide, at)),
        ];
        let coordinates = vec![
            coordinate("phi", Measured::Rotation(0), source.any(1.0), 2.0 * source.rate()),
            coordinate("s", Measured::Slide(1), source.any(0.1), source.rate()),
        ];
        let gravity = source.gravity();
        let loads = source.loads(&bodies);
        source.driven(Drawing { gravity, bodies, joints, loads, coordinates, drives: Vec::new() })
    })
}
