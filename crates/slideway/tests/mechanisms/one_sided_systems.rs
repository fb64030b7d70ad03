//! Systems of bodies with contacts that slide, some of which may lift off: as text of a model file, and solved by every pattern
//! of states in descriptor form.
//!
//! With `M a = f + sum N_k (n_k - mu_k s_k t_k) + hinges + drives`, each pattern is one linear system: of a contact that is
//! closed `g_k'' = 0`, of one that is open `N_k = 0`. It is a state if `N_k >= 0` where a contact is closed that may lift
//! off, if `g_k'' >= 0` where it is open, and if N has the sign of its side at any other contact.

use crate::random_mechanisms::cases;
use nalgebra::{DMatrix, DVector, Vector2};
use proptest::prelude::ProptestConfig;
use serde::Deserialize;
use std::f64::consts::PI;
use std::fmt::Write as _;

type Vector = Vector2<f64>;

/// [`cases`], so many in the suite, or as many as the variable `SLIDEWAY_RANDOM` says.
pub(crate) fn many(suite: u32) -> ProptestConfig {
    let given = std::env::var("SLIDEWAY_RANDOM").ok().and_then(|text| text.parse().ok());
    cases(given.unwrap_or(suite))
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct System {
    pub(crate) gravity: [f64; 2],
    pub(crate) bodies: Vec<Body>,
    #[serde(default)]
    pub(crate) hinges: Vec<Hinge>,
    pub(crate) contacts: Vec<Contact>,
    #[serde(default)]
    pub(crate) forces: Vec<Force>,
    #[serde(default)]
    pub(crate) drives: Vec<Drive>,
    /// Frames whose rotation is prescribed.
    #[serde(default)]
    pub(crate) frames: Vec<Moving>,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Moving {
    pub(crate) name: String,
    pub(crate) pose: [f64; 3],
    pub(crate) velocity: [f64; 3],
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) m: f64,
    #[serde(rename = "J")]
    pub(crate) moment: f64,
    /// Of its centre of mass; the angle is zero.
    pub(crate) pose: [f64; 3],
    pub(crate) velocity: [f64; 3],
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Hinge {
    pub(crate) between: [String; 2],
    pub(crate) at: [f64; 2],
    /// Of the friction circle.
    #[serde(default)]
    pub(crate) radius: f64,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Contact {
    pub(crate) name: String,
    pub(crate) kind: String,
    pub(crate) body: String,
    pub(crate) guide: String,
    /// The corner, or the centre of a disc.
    #[serde(rename = "C")]
    pub(crate) at: [f64; 2],
    /// Radius of the disc.
    #[serde(rename = "R", default)]
    pub(crate) radius: f64,
    /// Centre of a round face.
    #[serde(rename = "C_A")]
    pub(crate) centre: Option<[f64; 2]>,
    /// Its radius, negative for a hole.
    #[serde(rename = "R_A", default)]
    pub(crate) guide_radius: f64,
    /// Direction of a straight face.
    #[serde(default)]
    pub(crate) angle: f64,
    pub(crate) mu: f64,
    #[serde(default)]
    pub(crate) mu_static: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Force {
    pub(crate) body: String,
    #[serde(default)]
    pub(crate) at: [f64; 2],
    #[serde(rename = "force", default)]
    pub(crate) components: [f64; 2],
    #[serde(default)]
    pub(crate) couple: f64,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Drive {
    pub(crate) body: String,
    pub(crate) at: [f64; 2],
    pub(crate) direction: [f64; 2],
    pub(crate) acceleration: f64,
    pub(crate) force_at: [f64; 2],
    pub(crate) force_along: [f64; 2],
}

/// A state: what belongs to each contact, body and drive.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) normal: Vec<f64>,
    /// Accelerations of the gaps, zero where closed.
    pub(crate) gap: Vec<f64>,
    /// x, y and angle of each body.
    pub(crate) accelerations: Vec<f64>,
    pub(crate) efforts: Vec<f64>,
    /// The determinant of the pattern over that without friction.
    pub(crate) oriented: f64,
    /// The condition number of its equations.
    pub(crate) condition: f64,
}

impl Contact {
    pub(crate) fn opens(&self) -> bool {
        self.kind == "sliding" || self.rests()
    }

    /// Whether it may lift off and does not slide at the start.
    pub(crate) fn rests(&self) -> bool {
        self.kind == "resting"
    }

    pub(crate) fn tangent(&self) -> Vector {
        let normal = self.normal();
        Vector::new(normal.y, -normal.x)
    }

    pub(crate) fn normal(&self) -> Vector {
        match self.centre {
            Some(centre) => {
                let sense = if self.guide_radius < 0.0 { -1.0 } else { 1.0 };
                (Vector::from(self.at) - Vector::from(centre)).normalize() * sense
            }
            None => Vector::new(-self.angle.sin(), self.angle.cos()),
        }
    }

    /// Where it touches its face.
    fn touching(&self) -> [f64; 2] {
        (Vector::from(self.at) - self.normal() * self.radius).into()
    }
}

impl System {
    pub(crate) fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    fn arm(&self, body: usize, at: [f64; 2]) -> Vector {
        Vector::from(at) - Vector::new(self.bodies[body].pose[0], self.bodies[body].pose[1])
    }

    /// The row by which the velocities of all bodies give that of a place of one of them along an axis.
    pub(crate) fn place(&self, body: &str, at: [f64; 2], axis: Vector) -> DVector<f64> {
        let mut row = DVector::zeros(3 * self.bodies.len());
        if let Some(body) = self.body(body) {
            let arm = self.arm(body, at);
            row[3 * body] = axis.x;
            row[3 * body + 1] = axis.y;
            row[3 * body + 2] = arm.perp(&axis);
        }
        row
    }

    /// What the velocities add to its acceleration: -omega^2 r along the axis.
    pub(crate) fn centripetal(&self, body: &str, at: [f64; 2], axis: Vector) -> f64 {
        self.body(body)
            .map_or(0.0, |body| -self.bodies[body].velocity[2].powi(2) * self.arm(body, at).dot(&axis))
    }

    pub(crate) fn spin(&self, body: &str) -> f64 {
        self.body(body).map_or(0.0, |body| self.bodies[body].velocity[2])
    }

    fn velocities(&self) -> DVector<f64> {
        DVector::from_iterator(3 * self.bodies.len(), self.bodies.iter().flat_map(|body| body.velocity))
    }

    /// The row of a relative velocity of block and guide at a contact.
    pub(crate) fn relative(&self, contact: &Contact, axis: Vector) -> DVector<f64> {
        let at = contact.touching();
        self.place(&contact.body, at, axis) - self.place(&contact.guide, at, axis)
    }

    pub(crate) fn sliding_velocity(&self, contact: &Contact) -> f64 {
        self.relative(contact, contact.tangent()).dot(&self.velocities())
    }

    /// What the velocities add to the acceleration of the gap: the centripetal parts, and Coriolis' with a straight guide; of
    /// discs that of both centres and what comes from the turning of the line between them.
    pub(crate) fn gap_of_velocities(&self, contact: &Contact) -> f64 {
        let (normal, opposite) = (contact.normal(), contact.centre.unwrap_or(contact.at));
        let velocity = self.place(&contact.body, contact.at, contact.tangent())
            - self.place(&contact.guide, opposite, contact.tangent());
        let velocity = velocity.dot(&self.velocities());
        let turning = match contact.centre {
            Some(centre) => {
                let distance = (Vector::from(contact.at) - Vector::from(centre)).norm();
                velocity.powi(2) / distance * if contact.guide_radius < 0.0 { -1.0 } else { 1.0 }
            }
            None => -2.0 * self.spin(&contact.guide) * velocity,
        };
        self.centripetal(&contact.body, contact.at, normal)
            - self.centripetal(&contact.guide, opposite, normal)
            + turning
    }

    /// With the moving frames as bodies that are hinged to ground and driven by a force one metre beside the hinge.
    pub(crate) fn with_frames(mut self) -> Self {
        for Moving { name, pose, velocity } in std::mem::take(&mut self.frames) {
            let at = [pose[0] + 1.0, pose[1]];
            let between = [name.clone(), "ground".to_owned()];
            self.hinges.push(Hinge { between, at: [pose[0], pose[1]], radius: 0.0 });
            self.drives.push(Drive {
                body: name.clone(),
                at,
                direction: [0.0, 1.0],
                acceleration: 0.0,
                force_at: at,
                force_along: [0.0, 1.0],
            });
            self.bodies.push(Body { name, m: 1.0, moment: 1.0, pose, velocity });
        }
        self
    }

    /// The rows of hinges and closed contacts.
    pub(crate) fn joint_rows(&self) -> Vec<DVector<f64>> {
        let axes = [Vector::x(), Vector::y()];
        let hinge = |hinge: &Hinge| {
            axes.map(|axis| {
                self.place(&hinge.between[0], hinge.at, axis) - self.place(&hinge.between[1], hinge.at, axis)
            })
        };
        let contacts = self.contacts.iter().map(|contact| self.relative(contact, contact.normal()));
        self.hinges.iter().flat_map(hinge).chain(contacts).collect()
    }

    /// The rows of hinges, closed contacts and drives.
    pub(crate) fn rows_with_drives(&self) -> Vec<DVector<f64>> {
        let drives =
            self.drives.iter().map(|drive| self.place(&drive.body, drive.at, drive.direction.into()));
        self.joint_rows().into_iter().chain(drives).collect()
    }

    /// Coordinates that determine the motion, with their rates: those of the drives first, then components of the motion of
    /// bodies.
    fn coordinates(&self) -> Vec<(String, f64)> {
        let mut rows = self.joint_rows();
        let mut chosen = Vec::new();
        let drives = self.drives.iter().enumerate().map(|(index, drive)| {
            let axis = if drive.direction[0].abs() > 0.5 { "x" } else { "y" };
            let row = self.place(&drive.body, drive.at, if axis == "x" { Vector::x() } else { Vector::y() });
            (row, format!("{axis} = \"{}.drive_{index}\"", drive.body))
        });
        let of_bodies = self.bodies.iter().enumerate().flat_map(|(index, body)| {
            let centre = [body.pose[0], body.pose[1]];
            let x = self.place(&body.name, centre, Vector::x());
            let y = self.place(&body.name, centre, Vector::y());
            let mut turn = DVector::zeros(x.len());
            turn[3 * index + 2] = 1.0;
            let name = &body.name;
            [
                (x, format!("x = \"{name}.{name}_centre\"")),
                (turn, format!("rotation = \"{name}\"")),
                (y, format!("y = \"{name}.{name}_centre\"")),
            ]
        });
        for (row, what) in drives {
            chosen.push((what, row.dot(&self.velocities())));
            rows.push(row);
        }
        let candidates: Vec<(DVector<f64>, String)> = of_bodies.collect();
        while rows.len() < 3 * self.bodies.len() {
            let least = |row: &DVector<f64>| {
                let with: Vec<DVector<f64>> = rows.iter().chain([row]).cloned().collect();
                DMatrix::from_columns(&with).singular_values().min()
            };
            let best = candidates.iter().max_by(|(one, _), (other, _)| least(one).total_cmp(&least(other)));
            let (row, what) = best.expect("a body").clone();
            chosen.push((what, row.dot(&self.velocities())));
            rows.push(row);
        }
        chosen
    }

    /// As a model file.
    pub(crate) fn text(&self) -> String {
        let mut text = format!("gravity = {:?}\n[points]\n", self.gravity);
        let mut points: Vec<(String, String, [f64; 2])> = Vec::new();
        for body in &self.bodies {
            points.push((body.name.clone(), format!("{}_centre", body.name), [body.pose[0], body.pose[1]]));
        }
        for (index, force) in self.forces.iter().enumerate() {
            points.push((force.body.clone(), format!("force_{index}"), force.at));
        }
        for (index, drive) in self.drives.iter().enumerate() {
            points.push((drive.body.clone(), format!("drive_{index}"), drive.at));
            points.push((drive.body.clone(), format!("effort_{index}"), drive.force_at));
        }
        for (index, hinge) in self.hinges.iter().enumerate() {
            hinge
                .between
                .iter()
                .for_each(|body| points.push((body.clone(), format!("hinge_{index}"), hinge.at)));
        }
        for contact in self.contacts.iter().filter(|contact| contact.centre.is_some()) {
            let name = &contact.name;
            points.push((contact.body.clone(), format!("{name}_disc"), contact.at));
            points.push((contact.guide.clone(), format!("{name}_round"), contact.centre.unwrap_or_default()));
        }
        let mut written: Vec<&str> = Vec::new();
        for (_, name, at) in &points {
            if !written.contains(&name.as_str()) {
                writeln!(text, "{name} = {at:?}").unwrap();
                written.push(name);
            }
        }
        for Body { name, m, moment, .. } in &self.bodies {
            let own: Vec<&str> =
                points.iter().filter(|(body, ..)| body == name).map(|(_, point, _)| point.as_str()).collect();
            writeln!(
                text,
                "[bodies.{name}]\npoints = {own:?}\nmass = {m:?}\nmoment_of_inertia = {moment:?}\ncentre_of_mass = \"{name}_centre\""
            )
            .unwrap();
        }
        for (index, Hinge { between: [a, b], radius, .. }) in self.hinges.iter().enumerate() {
            let between = [format!("{a}.hinge_{index}"), format!("{b}.hinge_{index}")];
            let friction =
                if *radius > 0.0 { format!("friction_radius = {radius:?}\n") } else { String::new() };
            writeln!(text, "[joints.hinge_{index}]\ntype = \"hinge\"\nbetween = {between:?}\n{friction}")
                .unwrap();
        }
        for contact in &self.contacts {
            let Contact { name, body, guide, at, angle, mu, radius, guide_radius, .. } = contact;
            let mu_static = contact.mu_static.unwrap_or(*mu);
            writeln!(text, "[joints.{name}]\nmu = {mu:?}\nmu_static = {mu_static:?}").unwrap();
            if contact.centre.is_some() {
                let radii = [*radius, guide_radius.abs()];
                writeln!(
                    text,
                    "type = \"disc_on_disc\"\ncentres = [\"{body}.{name}_disc\", \"{guide}.{name}_round\"]\nradii = {radii:?}\ninside = {}",
                    *guide_radius < 0.0
                )
                .unwrap();
                continue;
            }
            let kind = match (contact.opens(), *radius > 0.0) {
                (true, true) => format!("\"disc_on_face\"\ncentre = {at:?}\nradius = {radius:?}"),
                (true, false) => format!("\"corner_on_face\"\nat = {at:?}"),
                (false, _) => format!("\"pin_in_slot\"\nat = {at:?}"),
            };
            writeln!(text, "type = {kind}\nblock = \"{body}\"\nguide = \"{guide}\"\nalong = {angle:?}")
                .unwrap();
        }
        for (index, Force { body, components, couple, .. }) in self.forces.iter().enumerate() {
            writeln!(
                text,
                "[loads.force_{index}]\ntype = \"force\"\nat = \"{body}.force_{index}\"\ncomponents = {components:?}\n\
                 [loads.couple_{index}]\ntype = \"torque\"\nbody = \"{body}\"\nmoment = {couple:?}"
            )
            .unwrap();
        }
        for (index, (what, rate)) in self.coordinates().into_iter().enumerate() {
            writeln!(text, "[coordinates.q_{index}]\n{what}\nrate = {rate:?}").unwrap();
        }
        for (index, drive) in self.drives.iter().enumerate() {
            let [x, y] = drive.force_along;
            let sign = if drive.direction[0] + drive.direction[1] > 0.0 { 1.0 } else { -1.0 };
            writeln!(
                text,
                "[drives.drive_{index}]\ncoordinate = \"q_{index}\"\nacceleration = {:?}\nforce = {{ at = \"{}.effort_{index}\", \
                 direction = {:?} }}",
                sign * drive.acceleration,
                drive.body,
                y.atan2(x)
            )
            .unwrap();
        }
        text
    }

    /// With joint rows that the velocities satisfy, where the coordinates have these rates.
    pub(crate) fn with_rates(mut self, rates: impl Iterator<Item = f64>) -> Option<Self> {
        let still = self.contacts.iter().filter(|contact| contact.rests());
        let still = still.map(|contact| self.relative(contact, contact.tangent()));
        let rows: Vec<DVector<f64>> = self.joint_rows().into_iter().chain(still).collect();
        let rates = DVector::from_iterator(3 * self.bodies.len(), rates.take(3 * self.bodies.len()));
        let matrix = DMatrix::from_columns(&rows).transpose();
        // What is left of random velocities in the null space of the rows.
        let svd = matrix.svd(true, true);
        let v_t = svd.v_t?;
        let span = v_t.transpose() * &v_t;
        let velocities = &rates - span * &rates;
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.velocity = [velocities[3 * index], velocities[3 * index + 1], velocities[3 * index + 2]];
        }
        Some(self)
    }

    /// The matrix and the right-hand side of a pattern: unknowns are accelerations, hinge forces, normal forces, efforts.
    pub(crate) fn equations(
        &self,
        open: &[bool],
        rough: bool,
        sides: &[f64],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let (bodies, hinges) = (3 * self.bodies.len(), 2 * self.hinges.len());
        let contacts = self.contacts.len();
        let size = bodies + hinges + contacts + self.drives.len();
        let (mut matrix, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (index, body) in self.bodies.iter().enumerate() {
            for (part, inertia) in [body.m, body.m, body.moment].into_iter().enumerate() {
                matrix[(3 * index + part, 3 * index + part)] = inertia;
            }
            (0..2).for_each(|axis| right[3 * index + axis] = body.m * self.gravity[axis]);
        }
        for force in &self.forces {
            let mut wrench = self.place(&force.body, force.at, Vector::from(force.components));
            if let Some(body) = self.body(&force.body) {
                wrench[3 * body + 2] += force.couple;
            }
            right.iter_mut().zip(&wrench).for_each(|(own, part)| *own += part);
        }
        for (index, hinge) in self.hinges.iter().enumerate() {
            for (part, axis) in [Vector::x(), Vector::y()].into_iter().enumerate() {
                let [a, b] = hinge.between.each_ref();
                let row = self.place(a, hinge.at, axis) - self.place(b, hinge.at, axis);
                let at = bodies + 2 * index + part;
                matrix.view_mut((0, at), (bodies, 1)).copy_from(&-&row);
                matrix.view_mut((at, 0), (1, bodies)).copy_from(&row.transpose());
                right[at] = self.centripetal(b, hinge.at, axis) - self.centripetal(a, hinge.at, axis);
            }
        }
        for (k, contact) in self.contacts.iter().enumerate() {
            let at = bodies + hinges + k;
            let (normal, sign) =
                (self.relative(contact, contact.normal()), self.sliding_velocity(contact).signum());
            let friction = self.relative(contact, contact.tangent());
            let mu = if rough { contact.mu } else { 0.0 };
            let force = &normal - friction * (mu * sign * sides[k]);
            matrix.view_mut((0, at), (bodies, 1)).copy_from(&-force);
            if open[k] {
                matrix[(at, at)] = 1.0;
            } else {
                matrix.view_mut((at, 0), (1, bodies)).copy_from(&normal.transpose());
                right[at] = -self.gap_of_velocities(contact);
            }
        }
        for (index, drive) in self.drives.iter().enumerate() {
            let at = bodies + hinges + contacts + index;
            let [direction, along] =
                [drive.direction, drive.force_along].map(|axis| Vector::from(axis).normalize());
            let effort = self.place(&drive.body, drive.force_at, along);
            matrix.view_mut((0, at), (bodies, 1)).copy_from(&-effort);
            let row = self.place(&drive.body, drive.at, direction);
            matrix.view_mut((at, 0), (1, bodies)).copy_from(&row.transpose());
            right[at] = drive.acceleration - self.centripetal(&drive.body, drive.at, direction);
        }
        (matrix, right)
    }

    /// All states, by every pattern; nothing where rounding may decide about one.
    pub(crate) fn states(&self) -> Option<Vec<State>> {
        let contacts = self.contacts.len();
        let mut states = Vec::new();
        for number in 0..1_usize << contacts {
            let is_other = |k: usize| number >> k & 1 == 1;
            let open: Vec<bool> = (0..contacts).map(|k| is_other(k) && self.contacts[k].opens()).collect();
            let sides: Vec<f64> =
                (0..contacts).map(|k| if is_other(k) && !open[k] { -1.0 } else { 1.0 }).collect();
            let (matrix, right) = self.equations(&open, true, &sides);
            let determinant = matrix.determinant();
            let smooth = self.equations(&open, false, &sides).0.determinant();
            if determinant.abs() < 1e-4 * smooth.abs() {
                return None;
            }
            let ratios = [determinant / smooth, condition(&matrix)];
            let unknowns = matrix.lu().solve(&right)?;
            let (state, slack) = self.state(&unknowns, (&open, &sides), ratios)?;
            if slack > 0.0 {
                states.push(state);
            }
        }
        Some(states)
    }

    /// The state of a pattern with these unknowns, and the least slack of its inequalities; nothing where rounding may decide.
    pub(crate) fn state(
        &self,
        unknowns: &DVector<f64>,
        (open, sides): (&[bool], &[f64]),
        [oriented, condition]: [f64; 2],
    ) -> Option<(State, f64)> {
        let (bodies, hinges, contacts) = (3 * self.bodies.len(), 2 * self.hinges.len(), self.contacts.len());
        let normal: Vec<f64> = (0..contacts).map(|k| unknowns[bodies + hinges + k]).collect();
        let gap: Vec<f64> = (0..contacts)
            .map(|k| {
                let contact = &self.contacts[k];
                let row = self.relative(contact, contact.normal());
                row.dot(&unknowns.rows(0, bodies)) + self.gap_of_velocities(contact)
            })
            .collect();
        let sizes = [amax(&normal), amax(&gap)];
        let slack = |k: usize| if open[k] { gap[k] / sizes[1] } else { sides[k] * normal[k] / sizes[0] };
        let least = (0..contacts).map(slack).fold(f64::INFINITY, f64::min);
        let state = State {
            normal: (0..contacts).map(|k| if open[k] { 0.0 } else { normal[k] }).collect(),
            gap: (0..contacts).map(|k| if open[k] { gap[k] } else { 0.0 }).collect(),
            accelerations: unknowns.rows(0, bodies).iter().copied().collect(),
            efforts: (bodies + hinges + contacts..unknowns.len()).map(|at| unknowns[at]).collect(),
            oriented,
            condition,
        };
        (least.abs() >= 1e-6).then_some((state, least))
    }
}

/// The greatest singular value of a matrix over its least.
pub(crate) fn condition(matrix: &DMatrix<f64>) -> f64 {
    let values = matrix.singular_values();
    values.max() / values.min()
}

impl System {
    /// The greatest residual that rounding leaves of forces that are built on those without friction of closed contacts: the loss
    /// of both equations, by their condition numbers, of sums of so many terms as there are unknowns.
    pub(crate) fn rounding(&self, of_pattern: f64) -> f64 {
        let contacts = self.contacts.len();
        let unknowns = 3 * self.bodies.len() + 2 * self.hinges.len() + 2 * contacts + self.drives.len();
        let base = self.equations(&vec![false; contacts], false, &vec![1.0; contacts]).0;
        (f64::EPSILON * unknowns as f64 * of_pattern * condition(&base)).max(1e-12)
    }
}

pub(crate) fn amax(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

/// A random system from plain numbers between -1 and 1: one or two bodies, with so many contacts, and perhaps a hinge or
/// a drive that acts elsewhere than it moves.
pub(crate) fn random(
    numbers: &[f64],
    bodies: usize,
    contacts: usize,
    [hinged, driven]: [bool; 2],
) -> Option<System> {
    let mut numbers = numbers.iter().copied().cycle();
    let mut any = |size: f64| size * numbers.next().unwrap_or_default();
    let names: Vec<String> = (0..bodies).map(|body| format!("body_{body}")).collect();
    let bodies: Vec<Body> = names
        .iter()
        .map(|name| Body {
            name: name.clone(),
            m: 1.75 + any(1.25),
            moment: 0.3 + any(0.25),
            pose: [any(1.0), any(1.0), 0.0],
            velocity: [0.0; 3],
        })
        .collect();
    let contact = |k: usize, any: &mut dyn FnMut(f64) -> f64| {
        let body = k % names.len();
        let guide = names.get(body + 1).filter(|_| any(1.0) > 0.2).cloned();
        let (mut block, mut guide) = (names[body].clone(), guide.unwrap_or_else(|| "ground".to_owned()));
        if any(1.0) > 0.3 {
            std::mem::swap(&mut block, &mut guide);
        }
        let (at, angle, size) = ([any(1.5), any(1.5)], any(PI), any(1.0));
        let mut contact = Contact {
            name: format!("k_{k}"),
            kind: if any(1.0) > -0.5 { "sliding" } else { "bilateral" }.to_owned(),
            body: block,
            guide,
            at,
            radius: 0.0,
            centre: None,
            guide_radius: 0.0,
            angle,
            mu: 0.8 + any(0.8),
            mu_static: None,
        };
        if contact.opens() && size.abs() > 0.4 {
            contact.radius = size.abs() - 0.3;
            // A round face beside the disc, or a hole around it.
            let face = any(1.5);
            if face.abs() > 0.75 {
                let distance = face.abs() + contact.radius * if face > 0.0 { 1.0 } else { -1.0 };
                if distance > 0.1 {
                    let away = Vector::new(-angle.sin(), angle.cos()) * (distance * face.signum());
                    contact.centre = Some((Vector::from(at) - away).into());
                    contact.guide_radius = face;
                }
            }
        }
        contact
    };
    let contacts: Vec<Contact> = (0..contacts).map(|k| contact(k, &mut any)).collect();
    let hinges = if hinged && names.len() > 1 {
        let between = [names[0].clone(), names[1].clone()];
        vec![Hinge { between, at: [any(1.0), any(1.0)], radius: 0.0 }]
    } else {
        Vec::new()
    };
    let forces = names.iter().map(|body| Force {
        body: body.clone(),
        at: [any(1.0), any(1.0)],
        components: [any(20.0), any(20.0)],
        couple: any(5.0),
    });
    let forces = forces.collect();
    let gravity = [0.0, -9.81];
    let drive = Drive {
        body: names[0].clone(),
        at: [any(1.0), any(1.0)],
        direction: if any(1.0) > 0.0 { [1.0, 0.0] } else { [0.0, -1.0] },
        acceleration: any(3.0),
        force_at: [any(1.0), any(1.0)],
        force_along: [1.2 + any(1.0), any(1.0)],
    };
    let drives = if driven { vec![drive] } else { Vec::new() };
    let system = System { gravity, bodies, hinges, contacts, forces, drives, frames: Vec::new() };
    let rates: Vec<f64> = (0..3 * names.len()).map(|_| any(1.5)).collect();
    system.with_rates(rates.into_iter())
}
