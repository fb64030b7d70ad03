//! Random chains of sliding bodies with preload: all patterns of sides and gaps by Newton's and Euler's
//! equations in rational numbers, with normal forces and shares as unknowns. Nothing but the text of the
//! model goes to the program.
//!
//! Body `b` slides on body `b - 1`, the first one on the ground. No guide turns, so that bodies only shift:
//!
//! ```text
//! m a = sum of forces,      0 = sum of moments about the centre of mass,      a_b = sum of s''_j t_j for j <= b
//! ```
//!
//! Unknowns are `s''_j`, for a block slider `|N|` or the share of both contacts, for a guided slider those of
//! its contact and its couple. A friction force acts at the face that is pressed, the preload perhaps at the
//! centre line.

use dashu_ratio::RBig;
use slideway::model::Model;
use slideway::modes::SearchOptions;
use slideway::report::{Proof, Solution, SolveReport, Status};
use slideway::solve::{SolveOptions, solve_with};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::ops::ControlFlow;

/// How many chains are tried.
const CHAINS: u64 = 800;
/// Directions with rational sines and cosines: x, y, length.
const DIRECTIONS: [[i32; 3]; 8] =
    [[1, 0, 1], [4, 3, 5], [3, 4, 5], [0, 1, 1], [-5, 12, 13], [12, -5, 13], [-1, 0, 1], [15, 8, 17]];

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    fn within(&mut self, least: i32, greatest: i32) -> i32 {
        least + i32::try_from(self.next() % u64::from((greatest - least + 1).unsigned_abs())).unwrap()
    }

    fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[usize::try_from(self.next()).unwrap() % list.len()]
    }
}

/// A body and the slider on which it slides; lengths in mm, coefficients in hundredths, forces in N.
struct Link {
    is_guided: bool,
    at: [i32; 2],
    along: [i32; 3],
    length: i32,
    height: i32,
    mu: [i32; 2],
    preload: [i32; 2],
    centred: bool,
    rate: i32,
    mass: i32,
    centre: [i32; 2],
    place: [i32; 2],
    load: [i32; 2],
}

fn link(random: &mut Random) -> Link {
    let mut both = |list: &[i32]| {
        let one = random.one_of(list);
        [one, if random.within(0, 2) == 0 { random.one_of(list) } else { one }]
    };
    let (mu, preload) = (both(&[0, 10, 30, 70, 150]), both(&[0, 2, 6, 15]));
    let mut place = |most: i32| [random.within(-most, most), random.within(-most, most)];
    let (at, centre, point, load) = (place(400), place(300), place(300), place(30));
    Link {
        is_guided: random.within(0, 2) == 0,
        at,
        along: random.one_of(&DIRECTIONS),
        length: random.one_of(&[100, 250, 400]),
        height: random.one_of(&[0, 40, 200]),
        mu,
        preload,
        centred: random.within(0, 3) == 0,
        rate: random.one_of(&[-1, 1]),
        mass: random.within(1, 8),
        centre,
        place: point,
        load: if random.within(0, 5) == 0 { [load[0], 0] } else { load },
    }
}

/// A chain of one or two bodies.
fn chain(seed: u64) -> Vec<Link> {
    let mut random = Random(seed);
    (0..random.within(1, 2)).map(|_| link(&mut random)).collect()
}

fn text(chain: &[Link]) -> String {
    let mut text = "gravity = \"9.81 m/s^2\"\n[points]\n".to_owned();
    let mm = |[x, y]: [i32; 2]| format!("[\"{x} mm\", \"{y} mm\"]");
    for (b, Link { at, along, place, .. }) in chain.iter().enumerate() {
        let to = [at[0] + 10 * along[0], at[1] + 10 * along[1]];
        let _ = writeln!(text, "A{b} = {}\nB{b} = {}\nP{b} = {}", mm(*at), mm(to), mm(*place));
    }
    for (b, link) in chain.iter().enumerate() {
        let Link { mass, load, length, height, mu, preload, rate, .. } = link;
        let kind = if link.is_guided { "guided_slider" } else { "block_slider" };
        let guide = if b == 0 { "ground".to_owned() } else { format!("b{}", b - 1) };
        let _ = write!(
            text,
            "[bodies.b{b}]\npoints = [\"P{b}\"]\nmass = {mass}\nmoment_of_inertia = 1\ncentre_of_mass = {}\n\
             [joints.s{b}]\ntype = \"{kind}\"\nblock = \"b{b}\"\nguide = \"{guide}\"\nat = \"A{b}\"\n\
             along = [\"A{b}\", \"B{b}\"]\nlength = \"{length} mm\"\nheight = \"{height} mm\"\n\
             mu = {{ plus = {:.2}, minus = {:.2} }}\npreload = {{ plus = {}, minus = {} }}\npreload_line = \"{}\"\n\
             [loads.l{b}]\ntype = \"force\"\nat = \"b{b}.P{b}\"\ncomponents = [\"{} N\", \"{} N\"]\n\
             [coordinates.q{b}]\nslide = \"s{b}\"\nrate = {rate}\n",
            mm(link.centre),
            f64::from(mu[0]) / 100.0,
            f64::from(mu[1]) / 100.0,
            preload[0],
            preload[1],
            if link.centred { "centre" } else { "pressed" },
            load[0],
            load[1],
        );
    }
    text
}

fn ratio(numerator: i32, denominator: i32) -> RBig {
    RBig::from(numerator) / RBig::from(denominator)
}

type Place = [RBig; 2];

/// A place (m) from one in mm and a distance along and across a direction (mm).
fn place(from: [i32; 2], along: [i32; 3], [ahead, across]: [i32; 2]) -> Place {
    let [x, y, length] = along;
    [
        ratio(from[0], 1000) + ratio(ahead * x - across * y, 1000 * length),
        ratio(from[1], 1000) + ratio(ahead * y + across * x, 1000 * length),
    ]
}

/// A contact of a link, `ahead` of its middle (half mm are avoided: lengths and heights are even).
struct Contact {
    body: usize,
    ahead: i32,
}

fn contacts(chain: &[Link]) -> Vec<Contact> {
    let of = |(body, link): (usize, &Link)| {
        let ends = if link.is_guided { vec![0] } else { vec![link.length / 2, -link.length / 2] };
        ends.into_iter().map(move |ahead| Contact { body, ahead }).collect::<Vec<_>>()
    };
    chain.iter().enumerate().flat_map(of).collect()
}

/// The equations of motion, one row of coefficients and a right-hand side for each.
struct Equations<'c> {
    chain: &'c [Link],
    rows: Vec<Vec<RBig>>,
}

impl<'c> Equations<'c> {
    /// Unknowns: accelerations, contacts, couples of guided sliders; the last column is the right-hand side.
    fn new(chain: &'c [Link], unknowns: usize) -> Self {
        let mut equations = Self { chain, rows: vec![vec![RBig::ZERO; unknowns + 1]; 3 * chain.len()] };
        for (b, link) in chain.iter().enumerate() {
            for (j, earlier) in chain[..=b].iter().enumerate() {
                for axis in [0, 1] {
                    equations.rows[3 * b + axis][j] +=
                        ratio(link.mass * earlier.along[axis], earlier.along[2]);
                }
            }
            let at = place(link.place, [1, 0, 1], [0, 0]);
            equations.add(unknowns, Some(b), &at, &link.load.map(RBig::from), &RBig::ONE);
            equations.rows[3 * b + 1][unknowns] -= RBig::from(link.mass) * ratio(981, 100);
        }
        equations
    }

    /// A force on a body: as a known one on the right (the last column), as an unknown one to be brought to
    /// the left.
    fn add(&mut self, column: usize, body: Option<usize>, at: &Place, force: &Place, factor: &RBig) {
        let Some(b) = body else { return };
        let centre = place(self.chain[b].centre, [1, 0, 1], [0, 0]);
        let arm = [&at[0] - &centre[0], &at[1] - &centre[1]];
        let moment = &arm[0] * &force[1] - &arm[1] * &force[0];
        let is_known = column + 1 == self.rows[0].len();
        let factor = if is_known { factor.clone() } else { -factor };
        for (axis, part) in [&force[0], &force[1], &moment].into_iter().enumerate() {
            self.rows[3 * b + axis][column] += part * &factor;
        }
    }

    /// A force on a block and its reaction on the guide.
    fn add_pair(&mut self, column: usize, block: usize, at: &Place, force: &Place, factor: &RBig) {
        self.add(column, Some(block), at, force, factor);
        self.add(column, block.checked_sub(1), at, force, &-factor);
    }

    /// What a contact does in a state: 0 and 1 are its sides, 2 its gap. Friction acts against the velocity.
    fn add_contact(&mut self, column: usize, contact: &Contact, state: usize) {
        let chain = self.chain;
        let (block, link, last) = (contact.body, &chain[contact.body], self.rows[0].len() - 1);
        let [x, y, length] = link.along;
        let normal = [ratio(-y, length), ratio(x, length)];
        let drag = [ratio(-x * link.rate, length), ratio(-y * link.rate, length)];
        let at = |across: i32| place(link.at, link.along, [contact.ahead, across]);
        // N > 0 presses the lower face of the block against the guide.
        let face = |side: usize| at(if side == 0 { -link.height / 2 } else { link.height / 2 });
        let line = |side: usize| if link.centred { at(0) } else { face(side) };
        let preload = link.preload.map(RBig::from);
        if state == 2 {
            self.add_pair(column, block, &line(0), &drag, &preload[0]);
            self.add_pair(column, block, &line(1), &drag, &-&preload[1]);
            self.add_pair(last, block, &line(1), &drag, &preload[1]);
        } else {
            let sign = if state == 0 { RBig::ONE } else { -RBig::ONE };
            self.add_pair(column, block, &at(0), &normal, &sign);
            self.add_pair(column, block, &face(state), &drag, &ratio(link.mu[state], 100));
            self.add_pair(last, block, &line(state), &drag, &preload[state]);
        }
    }

    fn add_couple(&mut self, column: usize, block: usize) {
        self.rows[3 * block + 2][column] -= RBig::ONE;
        if let Some(guide) = block.checked_sub(1) {
            self.rows[3 * guide + 2][column] += RBig::ONE;
        }
    }

    /// Gauss and Jordan; none where the matrix is singular, with whether the equations have a solution all
    /// the same.
    fn solved(mut self) -> Result<Vec<RBig>, bool> {
        let n = self.rows.len();
        let mut pivots = 0;
        for column in 0..n {
            let Some(at) = (pivots..n).find(|&row| !self.rows[row][column].is_zero()) else { continue };
            self.rows.swap(pivots, at);
            let pivot = self.rows[pivots][column].clone();
            self.rows[pivots].iter_mut().for_each(|entry| *entry /= &pivot);
            let row = self.rows[pivots].clone();
            for other in (0..n).filter(|&other| other != pivots) {
                let factor = self.rows[other][column].clone();
                if !factor.is_zero() {
                    self.rows[other].iter_mut().zip(&row).for_each(|(entry, by)| *entry -= &factor * by);
                }
            }
            pivots += 1;
        }
        if pivots == n {
            return Ok(self.rows.into_iter().map(|mut row| row.pop().unwrap()).collect());
        }
        Err(self.rows[pivots..].iter().all(|row| row[n].is_zero()))
    }
}

/// What a pattern admits.
enum Outcome {
    /// One state, inside of all its bounds: accelerations, then `|N|` or share of each contact.
    State(Vec<RBig>),
    Nothing,
    /// A state on a boundary, or infinitely many.
    Open,
}

fn decide(chain: &[Link], contacts: &[Contact], states: &[usize]) -> Outcome {
    let (bodies, n) = (chain.len(), 3 * chain.len());
    let mut equations = Equations::new(chain, n);
    for (k, (contact, &state)) in contacts.iter().zip(states).enumerate() {
        equations.add_contact(bodies + k, contact, state);
    }
    let guided: Vec<usize> = (0..bodies).filter(|&b| chain[b].is_guided).collect();
    for (index, &b) in guided.iter().enumerate() {
        equations.add_couple(bodies + contacts.len() + index, b);
    }
    let unknowns = match equations.solved() {
        Ok(unknowns) => unknowns,
        Err(true) => return Outcome::Open,
        Err(false) => return Outcome::Nothing,
    };
    // How far each is within its bounds.
    let mut slacks = Vec::new();
    for (k, &state) in states.iter().enumerate() {
        let value = &unknowns[bodies + k];
        slacks.push(value.clone());
        if state == 2 {
            slacks.push(RBig::ONE - value);
        }
    }
    for (index, &b) in guided.iter().enumerate() {
        let k = contacts.iter().position(|contact| contact.body == b).unwrap();
        let pressure = if states[k] == 2 { RBig::ZERO } else { unknowns[bodies + k].clone() };
        let couple = &unknowns[bodies + contacts.len() + index];
        let size = if *couple < RBig::ZERO { -couple } else { couple.clone() };
        slacks.push(pressure * ratio(chain[b].length, 2000) - size);
    }
    if slacks.iter().any(|slack| *slack < RBig::ZERO) {
        return Outcome::Nothing;
    }
    let inside = slacks.iter().all(|slack| !slack.is_zero());
    if inside { Outcome::State(unknowns[..bodies + contacts.len()].to_vec()) } else { Outcome::Open }
}

/// The states inside of their patterns, and the patterns of which this says too little.
fn truth(chain: &[Link]) -> (BTreeMap<String, Vec<RBig>>, BTreeSet<String>) {
    let contacts = contacts(chain);
    let count = u32::try_from(contacts.len()).unwrap();
    let (mut found, mut open) = (BTreeMap::new(), BTreeSet::new());
    for number in 0..3_usize.pow(count) {
        let states: Vec<usize> = (0..count).map(|k| number / 3_usize.pow(count - 1 - k) % 3).collect();
        let pattern: String = states.iter().map(|&state| ['+', '-', '0'][state]).collect();
        match decide(chain, &contacts, &states) {
            Outcome::State(values) => drop(found.insert(pattern, values)),
            Outcome::Open => drop(open.insert(pattern)),
            Outcome::Nothing => {}
        }
    }
    (found, open)
}

fn check_values(solution: &Solution, values: &[RBig], context: &str) {
    let bodies = solution.coordinates.len();
    let values: Vec<f64> = values.iter().map(|value| value.to_f64().value()).collect();
    let scale = values.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
    let close =
        |one: f64, other: f64| assert!((one - other).abs() <= 1e-9 * scale, "{one} {other}\n{context}");
    for (coordinate, value) in solution.coordinates.iter().zip(&values) {
        close(coordinate.acceleration, *value);
    }
    for (contact, value) in solution.contacts.iter().zip(&values[bodies..]) {
        match contact.preload_share {
            Some(share) => close(share, *value),
            None => close(contact.normal_force.abs(), *value),
        }
    }
}

fn report(text: &str) -> SolveReport {
    let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    let options = SolveOptions::default().search(SearchOptions::default()).margins(false);
    solve_with(&model, &options, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

#[test]
fn random_chains_have_the_states_that_rational_equations_of_motion_have() {
    let [mut gaps, mut clear, mut several] = [0; 3];
    for seed in 0..CHAINS {
        let chain = chain(seed);
        let text = text(&chain);
        let context = format!("chain {seed}\n{text}");
        let report = report(&text);
        let (expected, open) = truth(&chain);
        let states = || report.solutions.iter().chain(&report.preload_gap_states);
        for (pattern, values) in &expected {
            let state = states().find(|state| state.patterns.contains(pattern));
            check_values(
                state.unwrap_or_else(|| panic!("{pattern} is missing\n{context}")),
                values,
                &context,
            );
        }
        for state in states() {
            let known = |pattern: &String| expected.contains_key(pattern) || open.contains(pattern);
            assert!(state.patterns.iter().any(known), "{} is false\n{context}", state.pattern);
        }
        let is_found = states().next().is_some() || !report.continua.is_empty();
        assert!(report.status != Status::Unknown || !is_found, "{context}");
        if open.is_empty() {
            assert_ne!(report.status, Status::Unknown, "{context}");
            assert!(report.complete == Proof::Proven && report.undecided_modes.is_empty(), "{context}");
            clear += 1;
        }
        gaps += usize::from(expected.keys().any(|pattern| pattern.contains('0')));
        several += usize::from(expected.len() > 1);
    }
    assert!(gaps > 15 && clear > 700 && several > 50, "{gaps} {clear} {several}");
}
