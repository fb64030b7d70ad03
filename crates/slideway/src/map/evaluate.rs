//! The mode problem at a point of the plane: interpolated where it depends bilinearly on both quantities,
//! else made anew.

use super::class::{Answer, ClassKey, ClassMeaning, Point, class, reason};
use super::{Axis, ColourBy, effort, solved};
use crate::expression::Degree;
use crate::fault::{Fault, FaultKind, Faults};
use crate::kinetics::Accuracy;
use crate::limits::mechanism_with;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::{Progress, Work};
use crate::solve::{LastSolution, Parts, SolveOptions, Stages, Trail, states_between_faces};
use crate::standstill::{HoldOptions, Rests, rests};

/// Points along each side at which efforts are taken to choose their classes.
const SAMPLES: usize = 17;

/// The mode problems at the corners of the plane, (0, 0), (1, 0), (0, 1), (1, 1), and how well the least
/// accurate of them is known.
struct Corners {
    parts: Box<[Parts; 4]>,
    accuracy: Accuracy,
    /// The coordinates that no drive moves, with rates of the signs that they have at each corner.
    free: Vec<(usize, f64)>,
}

/// Evaluator that finds the class of a point.
pub(super) struct Evaluator<'a> {
    axes: &'a [Axis; 2],
    colour_by: ColourBy,
    /// The bounds of the classes of efforts.
    bounds: effort::Bounds,
    model: &'a Model,
    /// If its own values are allowed.
    mechanism: Option<Mechanism>,
    /// Where mode problems come from; none where statics is asked.
    forwards: Option<Source>,
    /// Motion the other way, for `Jam`.
    opposite: Option<Source>,
}

/// Where mode problems come from.
struct Source {
    model: Model,
    /// Between these mode problems are interpolated; if there are none, they are made from the model at every
    /// point, from the states of the points before it.
    corners: Option<Corners>,
    colour_by: ColourBy,
}

impl<'a> Evaluator<'a> {
    /// # Errors
    /// A quantity on which nothing depends; a model that cannot be turned round; efforts without drives.
    pub(super) fn new(
        model: &'a Model,
        axes: &'a [Axis; 2],
        colour_by: ColourBy,
        work: Work<'_>,
    ) -> Result<Self, Faults> {
        if colour_by == ColourBy::Effort {
            model.has_drives()?;
        }
        let source = |model: Model| Source::new(model, axes, colour_by).map(Some);
        let forwards = if colour_by == ColourBy::Hold { None } else { source(model.clone())? };
        let opposite = if colour_by == ColourBy::Jam { source(model.reversed())? } else { None };
        let mechanism = Mechanism::new(model).ok();
        let mut evaluator =
            Self { axes, colour_by, bounds: effort::Bounds::default(), model, mechanism, forwards, opposite };
        if colour_by == ColourBy::Effort {
            evaluator.bounds = evaluator.bounds_of_efforts(work);
        }
        Ok(evaluator)
    }

    /// Returns bounds of classes of efforts, from those at evenly spaced points.
    fn bounds_of_efforts(&self, work: Work<'_>) -> effort::Bounds {
        let Some(source) = &self.forwards else { return effort::Bounds::default() };
        let share = |place: usize| (place as f64 + 0.5) / SAMPLES as f64;
        let mut before = Before::default();
        let places = (0..SAMPLES).flat_map(|j| (0..SAMPLES).map(move |i| [share(i), share(j)]));
        let effort = |[u, v]: [f64; 2]| {
            let values = [along(&self.axes[0], u), along(&self.axes[1], v)];
            source.point(self.axes, values, &mut before, work).ok()?.least_effort()
        };
        let efforts = places.take_while(|_| !work.is_over()).filter_map(effort).collect();
        effort::bounds(efforts, &effort::unit(self.model))
    }

    /// Whether mode problems are interpolated.
    pub(super) fn is_bilinear(&self) -> bool {
        self.forwards.as_ref().is_some_and(|source| source.corners.is_some())
    }

    /// The classes of points with these values, one after another, until the work is to end.
    pub(super) fn classes(&self, points: impl Iterator<Item = [f64; 2]>, work: Work<'_>) -> Vec<ClassKey> {
        let mut trails = [Before::default(), Before::default()];
        let points = points.take_while(|_| !work.is_over());
        points.map(|values| self.class(values, &mut trails, work)).collect()
    }

    /// Why there is no answer in the middle of the plane, where there is none at any point that was tried, for these reasons.
    pub(super) fn no_answer<'c>(
        &self,
        mut tried: impl Iterator<Item = &'c ClassKey>,
        work: Work<'_>,
    ) -> Faults {
        let middle = self.axes.each_ref().map(|axis| f64::midpoint(axis.range[0], axis.range[1]));
        let faults = match &self.forwards {
            None => self.rests(middle, work).err(),
            Some(source) => source.point(self.axes, middle, &mut Before::default(), work).err(),
        };
        let in_middle = faults.as_ref().and_then(|faults| Some(faults.sorted().first()?.kind.with_hint()));
        let elsewhere = || {
            tried.find_map(|class| match &class.0 {
                ClassMeaning::NotSolved { reason } => Some((*reason).to_owned()),
                _ => None,
            })
        };
        let reason = in_middle.or_else(elsewhere).unwrap_or_default();
        Fault::general(FaultKind::NoAnswerOnMap { reason }).into()
    }

    /// Whether it can stay at rest at a point.
    fn rests(&self, values: [f64; 2], work: Work<'_>) -> Result<Rests, Faults> {
        rests(&model_at(self.model, self.axes, values)?, &HoldOptions::default(), work)
    }

    fn class(&self, values: [f64; 2], [there, back]: &mut [Before; 2], work: Work<'_>) -> ClassKey {
        let Some(source) = &self.forwards else {
            return ClassKey(match self.rests(values, work) {
                Ok(Rests { holds, may_slip }) => ClassMeaning::Rest { holds, may_slip },
                Err(faults) => ClassMeaning::NotSolved { reason: reason(&faults) },
            });
        };
        let at = |source: &Source, before: &mut Before| {
            source.point(self.axes, values, before, work).map_err(|faults| reason(&faults))
        };
        let forwards = at(source, there);
        let opposite = self.opposite.as_ref().map(|opposite| at(opposite, back));
        ClassKey(class(
            (self.colour_by, &self.bounds, self.mechanism.as_ref()),
            forwards.as_ref().map_err(|reason| *reason),
            opposite.as_ref().map(|other| other.as_ref().map_err(|reason| *reason)),
        ))
    }
}

impl Source {
    fn new(model: Model, axes: &[Axis; 2], colour_by: ColourBy) -> Result<Self, Faults> {
        let at = |[u, v]: [f64; 2]| {
            let stages = Stages::new(&model_at(&model, axes, [along(&axes[0], u), along(&axes[1], v)])?)?;
            let parts = parts(&stages, colour_by)?;
            Ok::<_, Faults>((parts, stages.accuracy, free(&stages)))
        };
        let [x, y] = axes.each_ref().map(|axis| axis.varied.dependence().problem);
        nothing_varies(axes, [x, y])?;
        // What is affine in each of both while the other stays as it is, is bilinear in both.
        let corners = if x.max(y) <= Degree::Affine
            && model.hinge_friction().next().is_none()
            && let [Ok(a), Ok(b), Ok(c), Ok(d)] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(at)
            && [&b.2, &c.2, &d.2].into_iter().all(|other| have_same_signs(&a.2, other))
        {
            let greatest =
                |number: fn(&Accuracy) -> f64| [a.1, b.1, c.1, d.1].iter().map(number).fold(0.0, f64::max);
            let accuracy = Accuracy { part: greatest(|one| one.part), of_load: greatest(|one| one.of_load) };
            Some(Corners { parts: Box::new([a.0, b.0, c.0, d.0]), accuracy, free: a.2 })
        } else {
            None
        };
        Ok(Self { model, corners, colour_by })
    }

    fn point(
        &self,
        axes: &[Axis; 2],
        values: [f64; 2],
        before: &mut Before,
        work: Work<'_>,
    ) -> Result<Answer, Faults> {
        let interpolated = |corners| Some((Corners::parts_at(corners, axes, values)?, corners));
        let (parts, accuracy, free, stages) = if let Some((parts, corners)) =
            self.corners.as_ref().and_then(interpolated)
        {
            (parts, corners.accuracy, corners.free.clone(), None)
        } else {
            let [x, y] = [0, 1].map(|index| (&axes[index].varied, values[index]));
            let stages = Stages::along(&mut before.trail, mechanism_with(&self.model, &[x, y])?)?;
            let model = || model_at(&self.model, axes, values);
            let stands = !stages.standing.is_empty();
            if stands || stages.mechanism.rough_hinges().next().is_some() {
                // Margins of what stands still are not computed.
                let is_margin = stands && self.colour_by == ColourBy::Margin;
                let colour_by = if is_margin { ColourBy::Modes } else { self.colour_by };
                let of_motion = matches!(colour_by, ColourBy::Motion | ColourBy::Effort);
                let careful = stands || of_motion || self.model.has_guided_sliders();
                let found = solved::states(&stages, &model, (colour_by, careful), &mut before.last, work)?;
                return Ok(Answer::States(found));
            }
            let parts = parts(&stages, self.colour_by)?;
            (parts, stages.accuracy, free(&stages), Some(stages))
        };
        let is_told = parts.with_free_faces().is_empty() || parts.is_off_boundaries(accuracy);
        let problem = |between_faces| Point::new(parts, free, between_faces, work);
        if is_told {
            let point = problem(Vec::new());
            if !point.is_undecided() {
                return Ok(Answer::Problem(Box::new(point)));
            }
            let stages = stages.map_or_else(|| Stages::new(&model_at(&self.model, axes, values)?), Ok)?;
            let model = || model_at(&self.model, axes, values);
            let found = solved::states(&stages, &model, (self.colour_by, true), &mut before.last, work)?;
            return Ok(Answer::States(found));
        }
        let model = model_at(&self.model, axes, values)?;
        let stages = stages.map_or_else(|| Stages::new(&model), Ok)?;
        let mut goes_on = |_: &Progress| work.flow();
        let states = states_between_faces(&model, &stages, None, &SolveOptions::default(), &mut goes_on)?;
        let between_faces = states.into_iter().map(|state| state.pattern).collect();
        Ok(Answer::Problem(Box::new(problem(between_faces))))
    }
}

/// Stages and last solution of the points before.
#[derive(Default)]
struct Before {
    trail: Trail,
    last: LastSolution,
}

/// The mode problem of stages, with the accelerations of the coordinates or the efforts as outputs if these are asked.
fn parts(stages: &Stages, colour_by: ColourBy) -> Result<Parts, Faults> {
    match colour_by {
        ColourBy::Motion => stages.parts_with_accelerations(),
        ColourBy::Effort => stages.parts_with_efforts(),
        _ => stages.parts(),
    }
}

/// The coordinates that no drive moves, with their rates.
fn free(stages: &Stages) -> Vec<(usize, f64)> {
    let rates = stages.mechanism.coordinates.iter().map(|coordinate| coordinate.rate).enumerate();
    rates.filter(|(index, _)| stages.mechanism.is_free(*index)).collect()
}

fn have_same_signs(one: &[(usize, f64)], other: &[(usize, f64)]) -> bool {
    let sign = |rate: f64| if rate == 0.0 { 0.0 } else { rate.signum() };
    one.iter().zip(other).all(|(one, other)| sign(one.1) == sign(other.1))
}

impl Corners {
    /// The mode problem at a point; none if a number of contacts differs.
    fn parts_at(&self, axes: &[Axis; 2], values: [f64; 2]) -> Option<Parts> {
        let share = |axis: &Axis, value: f64| (value - axis.range[0]) / (axis.range[1] - axis.range[0]);
        let place = [share(&axes[0], values[0]), share(&axes[1], values[1])];
        Parts::mixture(&weighted(&self.parts, place))
    }
}

/// The corners with their weights at a place of the unit square.
fn weighted(corners: &[Parts; 4], [u, v]: [f64; 2]) -> [(f64, &Parts); 4] {
    let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
    [0, 1, 2, 3].map(|corner| (weights[corner], &corners[corner]))
}

fn along(axis: &Axis, share: f64) -> f64 {
    if share == 1.0 { axis.range[1] } else { axis.range[0] + share * (axis.range[1] - axis.range[0]) }
}

/// The model at a point.
///
/// # Errors
/// Values that the model does not allow.
fn model_at(model: &Model, axes: &[Axis; 2], values: [f64; 2]) -> Result<Model, Faults> {
    let axes = axes.iter().zip(values);
    let factors = axes.clone().filter(|(axis, _)| axis.varied.is_friction_factor());
    let friction = factors.map(|(_, value)| value).product();
    let settings: Vec<_> = axes.filter_map(|(axis, value)| axis.varied.setting(value)).collect();
    Ok(model.varied_with(&settings)?.with_friction(friction))
}

/// Refuses a quantity on which nothing depends.
fn nothing_varies(axes: &[Axis; 2], degrees: [Degree; 2]) -> Result<(), Faults> {
    let mut faults = Faults::default();
    for (axis, _) in axes.iter().zip(degrees).filter(|(_, degree)| *degree == Degree::Constant) {
        let [from, to] = axis.range.map(|end| axis.varied.shown_in.show(end));
        faults.push(Fault::general(FaultKind::NothingVaries { what: axis.varied.in_words(), from, to }));
    }
    faults.or(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery;
    use crate::progress::undisturbed;

    /// The oracle assembles the model of every point from the drawing and factors with full pivoting. Between
    /// neighbouring points lie up to 11 degrees; a rod shorter than the crank cannot pass 90 degrees, which
    /// its neighbours can. The other run of points jumps to and fro.
    #[test]
    fn points_along_a_trail_are_those_assembled_anew() {
        let planes = [
            ("slider-crank", "phi=-175 deg..175 deg", "mu=0..1.5"),
            ("slider-crank", "phi=20 deg..170 deg", "l=45 mm..90 mm"),
            ("klepp-2002", "mu_1=0..0.8", "alpha=60 deg..88 deg"),
            ("scotch-yoke", "phi=2 deg..358 deg", "friction=0.5..3"),
        ];
        let jumping = |step: usize| [0.618_034, 0.754_878].map(|share| (step as f64 * share).fract());
        let walking = |step: usize| [(step as f64 + 0.5) / 32.0, 0.1 + 0.02 * step as f64];
        for (name, x, y) in planes {
            let model = Model::parse(gallery::find(name).expect("in the gallery").text).expect("sound");
            let axes =
                [x, y].map(|axis| Axis::new(&model, &axis.parse().expect("a range")).expect("an axis"));
            for colour_by in [ColourBy::Modes, ColourBy::Margin, ColourBy::Jam] {
                let evaluator = undisturbed(|work| Evaluator::new(&model, &axes, colour_by, work))
                    .expect("something varies");
                assert!(!evaluator.is_bilinear(), "{name}");
                let backwards = model.reversed();
                for points in [(0..32).map(walking).collect::<Vec<_>>(), (0..32).map(jumping).collect()] {
                    let values = points.iter().map(|[u, v]| [along(&axes[0], *u), along(&axes[1], *v)]);
                    let found = undisturbed(|work| evaluator.classes(values.clone(), work));
                    for (values, found) in values.zip(found) {
                        let anew = |model: &Model| {
                            let parts = Stages::new(&model_at(model, &axes, values)?)?.parts()?;
                            assert!(parts.with_free_faces().is_empty(), "{name}");
                            let point = undisturbed(|work| Point::new(parts, Vec::new(), Vec::new(), work));
                            Ok(Answer::Problem(Box::new(point)))
                        };
                        let at = |model: &Model| anew(model).map_err(|faults| reason(&faults));
                        let (forwards, opposite) = (at(&model), at(&backwards));
                        let [forwards, opposite] =
                            [&forwards, &opposite].map(|answer| answer.as_ref().map_err(|reason| *reason));
                        let expected =
                            class((colour_by, &effort::Bounds::default(), None), forwards, Some(opposite));
                        assert_eq!(found, ClassKey(expected), "{name} {colour_by:?} at {values:?}");
                    }
                }
            }
        }
    }
}
