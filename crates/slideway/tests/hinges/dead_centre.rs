//! Slider-cranks about their dead centres, whose locked angles are known in closed form.

use crate::cases::reference;
use serde::Deserialize;
use slideway::Model;

#[derive(Deserialize)]
struct File {
    dead_centre: Vec<DeadCentre>,
}

/// Massless links a = 50, l = 150 mm with these friction radii and this friction of the piston.
#[derive(Deserialize)]
pub(crate) struct DeadCentre {
    #[serde(rename = "rA")]
    crank_pin: f64,
    #[serde(rename = "rB")]
    piston_pin: f64,
    #[serde(rename = "rO")]
    crank_shaft: f64,
    mu_piston: f64,
    pub(crate) outer_deg: f64,
    pub(crate) inner_deg: f64,
}

/// Those of the reference.
pub(crate) fn dead_centres() -> Vec<DeadCentre> {
    reference::<File>().dead_centre
}

impl DeadCentre {
    /// With the crank pin and the piston drawn at these places, a cylinder of this type and length, and further sections:
    /// loads, a coordinate and a drive.
    pub(crate) fn model(
        &self,
        [crank_pin, piston]: [&str; 2],
        cylinder: (&str, f64),
        further: &str,
    ) -> Model {
        let Self { crank_pin: at_crank_pin, piston_pin, crank_shaft, mu_piston, .. } = self;
        let (kind, length) = cylinder;
        let text = format!(
            "[points]\nO = [0, 0]\nA = {crank_pin}\nB = {piston}\n\
             [bodies.crank]\npoints = [\"O\", \"A\"]\nmassless = true\n\
             [bodies.rod]\npoints = [\"A\", \"B\"]\nmassless = true\n\
             [bodies.piston]\npoints = [\"B\"]\nmassless = true\n\
             [joints.O]\ntype = \"hinge\"\nbetween = [\"crank.O\", \"ground.O\"]\nfriction_radius = {crank_shaft}\n\
             [joints.A]\ntype = \"hinge\"\nbetween = [\"rod.A\", \"crank.A\"]\nfriction_radius = {at_crank_pin}\n\
             [joints.B]\ntype = \"hinge\"\nbetween = [\"rod.B\", \"piston.B\"]\nfriction_radius = {piston_pin}\n\
             [joints.cylinder]\ntype = {kind:?}\nblock = \"piston\"\nat = \"B\"\nalong = 0\nlength = {length}\n\
             mu = {mu_piston}\n{further}"
        );
        Model::parse(&text).unwrap()
    }

    /// A piston drives a crank against a torque, in this sense, from where the crank is drawn at a right angle.
    pub(crate) fn driven_by_piston(&self, sense: f64) -> Model {
        let further = format!(
            "[loads.resistance]\ntype = \"torque\"\nbody = \"crank\"\nmoment = {}\n\
             [coordinates.phi]\nrotation = \"crank\"\ndrawn_at = \"90 deg\"\nrate = {sense}\n\
             [drives.gas]\ncoordinate = \"phi\"\nforce = {{ at = \"piston.B\", direction = 0 }}\n",
            -5.0 * sense
        );
        self.model(["[0, 0.05]", "[\"sqrt(0.15^2 - 0.05^2)\", 0]"], ("block_slider", 0.08), &further)
    }

    /// The same drawn at the inner or the outer dead centre.
    pub(crate) fn at_dead_centre(&self, inner: bool, further: &str) -> Model {
        let places = if inner { ["[-0.05, 0]", "[0.1, 0]"] } else { ["[0.05, 0]", "[0.2, 0]"] };
        self.model(places, ("guided_slider", 10.0), further)
    }
}
