//! No impact adds energy, whatever its restitution and friction.

use super::impacts::{close, impact_of, trammel};
use super::mechanism_of;
use crate::configuration::Configuration;
use crate::fault::FaultKind;
use crate::ids::JointId;
use crate::motion::decision::impact;
use crate::motion::moving::energy::kinetic;

/// A cart with a block on an inclined guide runs into a stop (an independent review's model): Newton's coefficient would
/// give it 0.3508 J. That the stop returns no more work than it has taken was computed there by a program of its own.
#[test]
fn a_cart_with_a_block_is_given_no_energy_by_its_stop() {
    let found = impact_of(KANE, &[("rail", 0.986)]);
    close(&found.after.rates, &[-0.594_863_848_5, 0.184_293_736], 1e-9);
    assert!((found.blows[0].energy_lost - (0.953_015_988_1 - 0.448_626_873_3)).abs() < 1e-9);
}

const KANE: &str = r#"
[points]
C = [0, 0]
B = [0, 0.5]
[bodies.cart]
mass = 0.932
moment_of_inertia = 1
centre_of_mass = "C"
points = ["C"]
[bodies.block]
mass = 2.663
moment_of_inertia = 1
centre_of_mass = "B"
points = ["B"]
[joints.rail]
type = "guided_slider"
block = "cart"
at = "C"
along = 0
length = "100 m"
mu = 0
travel = ["-10 m", "0 m"]
stop = { greatest = { restitution = 0.986 } }
[joints.incline]
type = "guided_slider"
block = "block"
guide = "cart"
at = "B"
along = "37.16 deg"
length = "100 m"
mu = 1.03
[coordinates.x]
slide = "rail"
rate = 1
[coordinates.s]
slide = "incline"
rate = -0.767
"#;

/// A linear congruential generator (Knuth, The Art of Computer Programming, 3.3.4).
struct Random(u64);

impl Random {
    fn between(&mut self, [least, greatest]: [f64; 2]) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        least + (greatest - least) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// A cart at its stop, with a block or a body on a rough pin.
fn cart(random: &mut Random) -> String {
    let upper = if random.between([0.0, 1.0]) < 0.7 {
        format!(
            "[joints.upper]\ntype = \"guided_slider\"\nblock = \"upper\"\nguide = \"cart\"\nat = \"C\"\n\
             along = \"{} deg\"\nlength = 100\nmu = {}\n[coordinates.s]\nslide = \"upper\"\n",
            random.between([-80.0, 80.0]),
            random.between([0.0, 1.5])
        )
    } else {
        format!(
            "[joints.upper]\ntype = \"hinge\"\nbetween = [\"upper.C\", \"cart.C\"]\nfriction_radius = {}\n\
             [coordinates.s]\nrotation = \"upper\"\n",
            random.between([0.0, 0.05])
        )
    };
    let [x, y] = [0, 1].map(|_| random.between([-0.2, 0.2]));
    format!(
        "[points]\nC = [0, 0]\n[bodies.cart]\npoints = [\"C\"]\nmass = {}\nmoment_of_inertia = 1\ncentre_of_mass = \"C\"\n\
         [bodies.upper]\npoints = [\"C\"]\nmass = {}\nmoment_of_inertia = 0.05\ncentre_of_mass = [{x}, {y}]\n\
         [joints.rail]\ntype = \"guided_slider\"\nblock = \"cart\"\nat = \"C\"\nalong = 0\nlength = 100\nmu = {}\n\
         travel = [-1, 0]\nstop = {{ restitution = 0.5 }}\n[coordinates.x]\nslide = \"rail\"\nrate = {}\n{upper}rate = {}\n",
        random.between([0.3, 3.0]),
        random.between([0.3, 3.0]),
        random.between([0.0, 1.0]),
        random.between([0.1, 2.0]),
        random.between([-5.0, 5.0])
    )
}

/// Kinetic energy before and after; the fault where the impact is refused.
fn energies(text: &str, restitution: f64) -> Result<[f64; 2], FaultKind> {
    let mechanism = mechanism_of(text);
    let configuration = Configuration::new(&mechanism).unwrap();
    match impact(&mechanism, &configuration, &[(JointId(0), restitution)]) {
        Ok(found) => Ok([&configuration, &found.after].map(|state| kinetic(&mechanism, state))),
        Err(faults) => Err(faults.sorted()[0].kind.clone()),
    }
}

/// A cart whose block has its centre of mass on the centre line of the rail: since nothing turns, forces and motions are the
/// same, but for the couple of the rail.
fn without_couple(text: &str) -> String {
    let line = |line: &str| {
        if line.starts_with("centre_of_mass = [") { "centre_of_mass = \"C\"\n" } else { line }.to_owned()
    };
    text.split_inclusive('\n').map(line).collect()
}

/// No impact is refused but those in which the rail, a guided slider, would tip: where the block or pin sticks, both bodies
/// move along the rail, nothing presses them against it, and no length of it bears the couple of what it brakes.
#[test]
fn energy_never_grows_in_random_impacts() {
    let mut random = Random(35);
    let (mut tipping, mut bounded) = (0, 0);
    for number in 0..2000 {
        let mut text =
            if number % 5 == 0 { trammel(random.between([0.0, 1.5]), "") } else { cart(&mut random) };
        // rail comes before upper, level before upright.
        let restitution = [random.between([0.0, 1.0]), 1.0][usize::from(number % 3 == 0)];
        let mut found = energies(&text, restitution);
        if let Err(FaultKind::ImpactTips { tipping: sliders, .. }) = &found {
            assert_eq!(*sliders, ["rail"], "{number}: e = {restitution}\n{text}");
            tipping += 1;
            if text.contains("hinge") {
                continue;
            }
            text = without_couple(&text);
            found = energies(&text, restitution);
        }
        let [before, after] =
            found.unwrap_or_else(|fault| panic!("{number}: {fault} e = {restitution}\n{text}"));
        assert!(after <= before * (1.0 + 1e-9), "{number}: {before} {after} e = {restitution}\n{text}");
        bounded += usize::from(restitution == 1.0 && after < before * (1.0 - 1e-6));
    }
    assert!(tipping > 0 && bounded > 100, "{tipping} {bounded}");
}
