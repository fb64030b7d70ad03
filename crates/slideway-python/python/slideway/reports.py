"""Answers as plain data: frozen classes whose attributes are those of the JSON output, in SI units unless said otherwise.

Written from the sources of the Rust crates by `tools/generate_reports.py`; not to be edited.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from . import _mixins
from ._answer import Record, Report

__all__ = [
    "Approach",
    "AtRest",
    "Attainability",
    "Axis",
    "Band",
    "Bar",
    "BeyondHeld",
    "BeyondRange",
    "BlowUp",
    "Body",
    "BodySummary",
    "Branch",
    "BranchReport",
    "BranchingReport",
    "Carried",
    "CarriedQuantity",
    "CauseKind",
    "CauseReport",
    "CertificateKind",
    "CheckReport",
    "ClosestMode",
    "Coefficients",
    "ColourBy",
    "Column",
    "Contact",
    "ContactFit",
    "ContactImpulse",
    "ContactRange",
    "ContactSummary",
    "Continuum",
    "ContinuumPart",
    "CoordinateAcceleration",
    "CoordinateForm",
    "CoordinateRange",
    "CoordinateState",
    "CoordinateSummary",
    "CoordinateValue",
    "CountLimits",
    "CountStretch",
    "CoupleRange",
    "Course",
    "CourseDirection",
    "CourseMode",
    "CourseRow",
    "CriticalContact",
    "Curve",
    "Direction",
    "DrawnArrow",
    "DrawnClass",
    "DrawnExit",
    "DrawnFlag",
    "DrawnLine",
    "DrawnMap",
    "DrawnPanel",
    "Drive",
    "DriveDirection",
    "DriveName",
    "DriveRange",
    "DriveReport",
    "DriveSolution",
    "DriveSummary",
    "DrivenMotion",
    "Efficiency",
    "EfficiencyKind",
    "EffortRange",
    "EigenvalueUnit",
    "Elasticity",
    "End",
    "EndHingeForce",
    "EndKind",
    "EndReaction",
    "EndReport",
    "EnergyReport",
    "EventReport",
    "EveryAnswer",
    "EveryRightHandSide",
    "Figure",
    "Finding",
    "FlutterDamping",
    "FrictionNeeded",
    "Frictionless",
    "FromRest",
    "GapRange",
    "GapShare",
    "Hatching",
    "HeldEffort",
    "HeldFriction",
    "Hinge",
    "HingeFriction",
    "HingeRange",
    "HoldReport",
    "HoldVerdict",
    "InertiaSummary",
    "InfluenceSummary",
    "JamImpulse",
    "JointForm",
    "JointMode",
    "JointRelease",
    "JointSummary",
    "Known",
    "LegendEntry",
    "LimitsMethod",
    "LimitsReport",
    "LoadReport",
    "LoadSharing",
    "LockedMode",
    "LockedRange",
    "MapAxis",
    "MapClass",
    "MapReport",
    "MarginKind",
    "Margins",
    "MarginsMissing",
    "MarkedPoint",
    "MarkedValue",
    "MetEnd",
    "MetInterval",
    "MobilitySummary",
    "ModeEndCause",
    "ModeLimits",
    "ModeMargin",
    "ModelSummary",
    "Named",
    "OnFace",
    "OneFaceHint",
    "OneFaceReason",
    "OpenRange",
    "Panel",
    "PatternSummary",
    "PeakEffort",
    "Persistence",
    "PhaseReport",
    "PointKind",
    "PointStatus",
    "PressFit",
    "Proof",
    "Question",
    "Range",
    "RangeWithoutPosition",
    "RangeWithoutProblem",
    "RawContinuum",
    "RawGroup",
    "RawKind",
    "RawReport",
    "RawShares",
    "RawSolution",
    "RawUnknown",
    "Reactions",
    "Rejection",
    "Release",
    "RestLimitsReport",
    "RoundEnd",
    "Sample",
    "SampleKind",
    "SampledReport",
    "Sense",
    "Series",
    "SimulateReport",
    "SizeReport",
    "Solution",
    "SolveReport",
    "SpanOfRest",
    "SpeedChange",
    "SpeedLimits",
    "StatisticsReport",
    "Status",
    "StiffnessRatios",
    "Stopping",
    "Stroke",
    "Tally",
    "Theme",
    "Threshold",
    "Tipping",
    "TippingLimit",
    "TippingRange",
    "TipsOver",
    "TreeReport",
    "UncertainMode",
    "UncertainParameter",
    "Uncertainty",
    "UndecidedMode",
    "Undetermined",
    "Unlocking",
    "VariedQuantity",
    "Verdict",
    "WarningPlace",
    "WarningReport",
    "Wedging",
    "WithinRounding",
    "WithinRoundingAnswer",
    "Zone",
]

Approach = Literal["below", "above"]
"""From which side a value is approached.

- `"below"`: From below.
- `"above"`: From above."""

CarriedQuantity = Literal["force_z", "collar", "moment_x", "moment_y", "roll", "pitch"]
"""What a joint carries out of the drawing.

- `"force_z"`: A force along z, out of the drawing.
- `"collar"`: The couple of friction of the collar that carries this force.
- `"moment_x"`: A moment about the x axis, of a hinge.
- `"moment_y"`: A moment about the y axis, of a hinge.
- `"roll"`: A moment about the direction of sliding.
- `"pitch"`: A moment about the normal of a guide in the drawing."""

CauseKind = Literal[
    "start",
    "normal_force_zero",
    "preload_gap_ends",
    "touches",
    "lands",
    "bare_corner",
    "stops",
    "slips",
    "stops_turning",
    "locks",
    "folds",
    "reaction_limit",
    "tips",
    "overlap_vanishes",
    "travel_limit",
    "hits",
    "meets_pad",
    "leaves_pad",
    "load_jumps",
    "user",
    "jams",
]
"""The name of the cause of an event in reports.

- `"start"`: The motion begins.
- `"normal_force_zero"`: A normal force vanishes.
- `"preload_gap_ends"`: A preload gap closes.
- `"touches"`: A contact that was open reaches its face.
- `"lands"`: A contact lands on its face.
- `"bare_corner"`: A corner without contact reaches a face.
- `"stops"`: A joint stops sliding.
- `"slips"`: Sticking joints begin to slip.
- `"stops_turning"`: A hinge with friction stops turning.
- `"locks"`: The mode locks.
- `"folds"`: The solution of the mode ends at a fold.
- `"reaction_limit"`: A normal force reaches its limit.
- `"tips"`: A guided slider tips.
- `"overlap_vanishes"`: A block leaves its guide.
- `"travel_limit"`: A joint reaches a limit of its travel.
- `"hits"`: A joint hits its stop.
- `"meets_pad"`: A joint meets the pad of its stop.
- `"leaves_pad"`: A joint leaves the pad of its stop.
- `"load_jumps"`: A load or drive jumps.
- `"user"`: A function that is watched vanishes.
- `"jams"`: It jams, and an impulse acts."""

CertificateKind = Literal["proven", "on_boundary", "not_proven"]
"""The kind of proof of a solution.

- `"proven"`: It exists for the exact mechanism, inside of its mode.
- `"on_boundary"`: Some normal force or determinant is zero within the rounding of the mechanism's numbers.
- `"not_proven"`: It was found within tolerances only."""

ColourBy = Literal["solutions", "modes", "margin", "jam", "motion", "effort", "hold"]
"""Property that the colours of a map show.

- `"solutions"`: The number of solutions, and of states with the preload between the faces.
- `"modes"`: The set of contact modes that have a solution.
- `"margin"`: The factor by which all friction may grow before there are no or several solutions.
- `"jam"`: Whether it moves as in the model, and the other way.
- `"motion"`: The change of the speed of each coordinate that no drive moves, in each solution.
- `"effort"`: The effort of the first drive, the least of several solutions.
- `"hold"`: Whether it can stay at rest, drives absent."""

CoordinateForm = Literal["slide", "rotation", "displacement"]
"""The kind of a coordinate.

- `"slide"`: The displacement of a sliding joint.
- `"rotation"`: The angle between two bodies.
- `"displacement"`: The displacement of a point along a line."""

EfficiencyKind = Literal["driving", "braking", "held_by_friction", "no_power", "undefined"]
"""Which way power flows.

- `"driving"`: The drives push, with and without friction: power without friction over power with it.
- `"braking"`: The load pushes and the drives brake, with and without friction: power with friction over power
without it.
- `"held_by_friction"`: Without friction the load would push; friction holds it, and the drives have to push.
- `"no_power"`: Without friction the motion takes no power.
- `"undefined"`: Without friction the drives would push, with it they brake; possible where some motions are
not prescribed."""

EigenvalueUnit = Literal["1/s^2", "1/kg"]
"""The unit of the eigenvalues of the fast motion.

- `"1/s^2"`: The model gives the stiffness of every contact.
- `"1/kg"`: For a stiffness of 1 N/m at every contact."""

Elasticity = Literal["given", "rigid", "equal"]
"""The assumed elasticity of contacts that share a load.

- `"given"`: The stiffnesses of the model.
- `"rigid"`: The faces are rigid: there is play or misalignment, but no stiffness.
- `"equal"`: All contacts have the same stiffness: there is neither play nor misalignment, so that only ratios
count."""

End = Literal["plain", "marked", "diverges"]
"""The end of a curve.

- `"plain"`: Nothing to mark: the range ends, or another curve goes on.
- `"marked"`: Here the branch ends or goes over into another: a dot.
- `"diverges"`: It grows without bound."""

EndKind = Literal[
    "finished",
    "travel_limit",
    "overlap_vanished",
    "beside_face",
    "out_of_plane",
    "bare_corner",
    "reaction_limit",
    "user_event",
    "no_such_branch",
    "tips",
    "no_continuation",
    "jammed",
    "accumulation",
    "step_limit",
    "event_limit",
    "no_value",
    "undecided",
    "interrupted",
]
"""Why a motion ends.

- `"finished"`: The requested time has been reached.
- `"travel_limit"`: A joint reaches a limit of its travel.
- `"overlap_vanished"`: A block leaves its guide.
- `"beside_face"`: A contact that was open reaches the line of its face beyond the ends of the face.
- `"out_of_plane"`: A contact lifts off in space, and its body leaves the plane of its motion.
- `"bare_corner"`: A corner reaches a face where the model has no contact.
- `"reaction_limit"`: A normal force reaches its limit.
- `"user_event"`: An event of the model that stops the motion.
- `"no_such_branch"`: The requested branch does not exist.
- `"tips"`: A guided slider tips.
- `"no_continuation"`: At rest, neither sticking nor sliding is possible.
- `"jammed"`: It jams, and no impulse leads to a state from which it can continue.
- `"accumulation"`: Events come closer and closer together.
- `"step_limit"`: The permitted number of steps is reached.
- `"event_limit"`: The permitted number of events is reached.
- `"no_value"`: A load or drive has no value.
- `"undecided"`: What follows cannot be decided.
- `"interrupted"`: It was interrupted."""

EveryAnswer = Literal["one", "not_one", "singular", "in_doubt", "not_computed", "jumps"]
"""See `EveryRightHandSide`.

- `"one"`: Exactly one solution for every right-hand side: proven.
- `"not_one"`: Several solutions or none for some right-hand sides: proven.
- `"singular"`: No solution or infinitely many for some right-hand sides: proven.
- `"in_doubt"`: Undecided because determinants are too close to zero.
- `"not_computed"`: Not decided within the limits.
- `"jumps"`: Not decided: preloads jump with the sign."""

FromRest = Literal[
    "rests",
    "rests_or_moves",
    "moves_on",
    "moves_back",
    "moves",
    "neither",
    "undecided",
    "not_examined",
]
"""The effect of the loads on a mechanism that has stopped, by the analysis of standstill in the same position.

- `"rests"`: It stays at rest.
- `"rests_or_moves"`: It may stay at rest, and may begin to move.
- `"moves_on"`: It begins to move in the direction of its rate.
- `"moves_back"`: It begins to move against its rate.
- `"moves"`: It begins to move; in which direction is not one answer.
- `"neither"`: It can neither stay at rest nor begin to move with finite accelerations.
- `"undecided"`: Rounding leaves some states of rest open.
- `"not_examined"`: It has more states of joints and contacts than modes for which margins are computed."""

Hatching = Literal["rising", "falling", "dotted"]
"""How an interval is hatched.

- `"rising"`: Lines that rise to the right: no solution.
- `"falling"`: Lines that fall to the right: no mechanism, no value.
- `"dotted"`: Dots: what is shown was found at single values and is not proven between them."""

HoldVerdict = Literal[
    "holds",
    "holds_until_pushed",
    "holds_or_slips",
    "moves",
    "neither",
    "may_hold",
    "does_not_hold",
]
"""Whether a mechanism stays at rest, begins to move, may do both, or neither.

- `"holds"`: It stays at rest; no state of sliding is possible.
- `"holds_until_pushed"`: It stays at rest, but once pushed it goes on sliding, as kinetic friction is below
static friction.
- `"holds_or_slips"`: Friction may hold it, and yet it may begin to slide even against static friction
(Painleve's paradox at rest).
- `"moves"`: It cannot stay at rest, and begins to move.
- `"neither"`: It can neither stay at rest nor begin to move with finite accelerations.
- `"may_hold"`: It stays at rest; whether it also keeps sliding once pushed is not known, since motions are
without inertia.
- `"does_not_hold"`: It cannot stay at rest; motions without inertia keep its accelerations from being known."""

JointForm = Literal[
    "hinge",
    "block slider",
    "guided slider",
    "pin in slot",
    "corner on face",
    "block on face",
    "disc on face",
    "disc on disc",
]
"""The kind of a joint.

- `"hinge"`: A hinge.
- `"block slider"`: A block of some length in a guide, with contacts at both ends.
- `"guided slider"`: A block that its guide holds straight, with one contact and a couple.
- `"pin in slot"`: A pin in a slot.
- `"corner on face"`: A corner on a face, which it may leave.
- `"block on face"`: A block on a face, which both of its corners may leave.
- `"disc on face"`: A disc on a face, which it may leave.
- `"disc on disc"`: A disc on a disc or in a hole, which it may leave."""

Known = Literal["proven", "closed_form", "sampled", "undecided"]
"""How the numbers of solutions in an interval are known.

- `"proven"`: By the certified search for all values but those next to ends of modes: for all of
`CountLimits::proven`.
- `"closed_form"`: Outside `CountLimits::proven` by zeros of determinants, which were computed in rounded
numbers.
- `"sampled"`: Outside `CountLimits::proven` at values that were tried.
- `"undecided"`: Not at all: at some value there is another number."""

LimitsMethod = Literal["closed form", "bracketing", "independent"]
"""How the ends of modes were found.

- `"closed form"`: As zeros of determinants; of one hinge with friction over its radius as zeros of linear
functions of its couple.
- `"bracketing"`: Between values that were tried.
- `"independent"`: Nothing depends on what is varied."""

MarginKind = Literal["locking", "self_locking", "hold", "effort", "normal_force", "pressure", "efficiency"]
"""Which margin is meant.

- `"locking"`: The factor by which kinetic friction may grow before there is no solution, or something tips;
none where less friction does that.
- `"self_locking"`: The factor by which static friction may grow before a load is held however great it is.
- `"hold"`: The factor by which static friction may be smaller while all loads are held as they are, or one
however great it is.
- `"effort"`: Not a factor but the greatest effort of a drive, or of all (N or N m).
- `"normal_force"`: Not a factor but the greatest normal force of a contact, or of all (N).
- `"pressure"`: Not a factor but the greatest bearing pressure of a contact, or of all that have a pad (Pa).
- `"efficiency"`: Not a factor but the least efficiency."""

MarginsMissing = Literal[
    "too_many_modes",
    "between_faces",
    "nothing_presses",
    "floats",
    "undetermined",
    "friction_in_hinges",
    "friction_on_rods",
]
"""Why margins of friction were not computed.

- `"too_many_modes"`: There are too many modes.
- `"between_faces"`: A guided slider is between its faces, which is no mode that could be followed.
- `"nothing_presses"`: Nothing presses a contact, so that its preload may rub at either face.
- `"floats"`: The block floats within the play of redundant guides.
- `"undetermined"`: There are infinitely many solutions.
- `"friction_in_hinges"`: Solutions with friction in hinges are not followed all together.
- `"friction_on_rods"`: Nor are those with friction on round rods."""

MetEnd = Literal["range", "margin", "jump", "no_position"]
"""Why an interval ends in which the wanted margin is met.

- `"range"`: The range ends.
- `"margin"`: The margin is just met.
- `"jump"`: The margin jumps.
- `"no_position"`: The mechanism cannot be assembled or solved beyond, or the model does not allow the values
there: `SizeReport::without_position` says why."""

ModeEndCause = Literal[
    "nothing",
    "range",
    "locking",
    "without_bound",
    "side_change",
    "lifts_off",
    "touches",
    "gap_closes",
    "tipping",
    "greatest_reaction",
    "fold",
    "hinge_unloaded",
    "not_followed",
    "reversal",
    "no_mode_problem",
]
"""The cause of the end of a mode where something is varied.

- `"nothing"`: Nothing: it lasts however much friction grows.
- `"range"`: The range that was looked at.
- `"locking"`: Its determinant vanishes, so its normal forces grow without bound, and beyond there is no
solution: friction locks the mechanism.
- `"without_bound"`: Its determinant vanishes, so its normal forces grow without bound, but beyond there is
another solution.
- `"side_change"`: A normal force vanishes: a contact changes side.
- `"lifts_off"`: A normal force vanishes: a contact that was closed lifts off.
- `"touches"`: The acceleration of a gap vanishes: a contact that opened stays closed.
- `"gap_closes"`: A preload gap closes.
- `"tipping"`: A guided slider tips.
- `"greatest_reaction"`: A normal force reaches the greatest one that is allowed.
- `"fold"`: Two solutions merge.
- `"hinge_unloaded"`: The force of a hinge with friction vanishes.
- `"not_followed"`: It was not followed any further.
- `"reversal"`: Sliding or turning reverses.
- `"no_mode_problem"`: Beyond there is no mode problem: the mechanism cannot be assembled or solved, or the
model is not allowed."""

OnFace = Literal["closed", "tips", "opens"]
"""What a corner or a block does on a face that it may leave.

- `"closed"`: It stays there.
- `"tips"`: One corner of a block stays, the other one leaves it.
- `"opens"`: It leaves."""

OneFaceReason = Literal["pulls", "changes_side", "jams"]
"""Reasons why a joint needs its second face.

- `"pulls"`: The block is drawn on one side of the face, and the face pulls it.
- `"changes_side"`: Under the weights alone the block lies on one face, and it presses the other one.
- `"jams"`: The block is drawn on one side of the face or lies on it, and it jams."""

Persistence = Literal["all_values", "some_values", "undecided"]
"""For which values of the uncertain parameters a mode has a solution.

- `"all_values"`: For all, proven.
- `"some_values"`: For some, proven; not for all, or that could not be proven.
- `"undecided"`: Whether it has one for any value could not be decided."""

PointKind = Literal["start", "stop", "jam", "end", "model", "impact"]
"""The meaning of a marked point.

- `"start"`: A motion begins: a circle.
- `"stop"`: It comes to rest: a square.
- `"jam"`: It jams: a cross.
- `"end"`: It ends in motion: a triangle.
- `"model"`: The values of the model itself: a diagonal cross.
- `"impact"`: An impact: a ring whose area is the energy that it takes."""

PointStatus = Literal[
    "none",
    "one",
    "several",
    "continuum",
    "preload_gap",
    "unknown",
    "no_position",
    "refused",
]
"""What became of a point.

- `"none"`: No solution: friction locks the mechanism.
- `"one"`: Exactly one.
- `"several"`: Several, each in its own contact mode.
- `"continuum"`: Infinitely many.
- `"preload_gap"`: No solution, but a state in a preload gap.
- `"unknown"`: Nothing was found, but not every pattern could be decided.
- `"no_position"`: The mechanism cannot be assembled there, or lies outside of its travel.
- `"refused"`: `solve` refuses the point for another reason."""

Proof = Literal["proven", "not proven"]
"""Whether a list of solutions is proven complete.

- `"proven"`: It is proven complete.
- `"not proven"`: It is not proven complete."""

RawKind = Literal["lcp", "ave", "block_ave", "hlcp", "mlcp", "mcp", "game", "modes"]
"""The type of a raw problem.

- `"lcp"`: Linear complementarity problem.
- `"ave"`: Absolute value equation.
- `"block_ave"`: Absolute value equation of blocks of one or two components.
- `"hlcp"`: Horizontal linear complementarity problem.
- `"mlcp"`: Mixed linear complementarity problem: some unknowns are free.
- `"mcp"`: Mixed complementarity problem with a linear function: every unknown between two bounds.
- `"game"`: Bimatrix game.
- `"modes"`: Mode problem."""

RawUnknown = Literal["z", "w", "u", "x", "normal_forces", "y", "payoff_1", "payoff_2", "lambda"]
"""The names of unknowns.

- `"z"`: `z` of a complementarity problem.
- `"w"`: `w` of a complementarity problem.
- `"u"`: `u` of a mixed linear complementarity problem.
- `"x"`: `x` of an absolute value equation, or of a game.
- `"normal_forces"`: The signed normal forces of a mode problem.
- `"y"`: `y`, the sizes of the normal forces, or of a game.
- `"payoff_1"`: The first player's payoff.
- `"payoff_2"`: The second player's payoff.
- `"lambda"`: The share lambda of an unknown in its gap."""

SampleKind = Literal["finite", "infinite", "no_solution", "without_bound", "needs_friction", "no_position"]
"""Kind of sample: whether its margin is a number, and if not, why.

- `"finite"`: The margin is a number.
- `"infinite"`: No friction reaches the limit.
- `"no_solution"`: There is no solution with an effort, normal force, bearing pressure or efficiency, or none
has any efficiency: friction takes all that the load would give.
- `"without_bound"`: There are infinitely many solutions, in which an effort, normal force or bearing pressure
is without bound, or an efficiency as small as can be.
- `"needs_friction"`: With less friction than this it tips or jams: `Sample::least_friction`. No factor makes
that safe.
- `"no_position"`: The mechanism cannot be assembled or solved there, or a guided slider is between its faces."""

Sense = Literal["model", "reversed"]
"""A direction of motion.

- `"model"`: The direction of the model's rates.
- `"reversed"`: The other one."""

SpeedChange = Literal[
    "speeds_up",
    "keeps_its_speed",
    "slows_down",
    "starts_forwards",
    "starts_backwards",
    "stays_at_rest",
    "undecided",
    "may_start",
]
"""The change of the speed of a coordinate, from the signs of its rate and of proven bounds of its acceleration.

- `"speeds_up"`: Its acceleration has the direction of its rate.
- `"keeps_its_speed"`: Its acceleration is zero within rounding.
- `"slows_down"`: Its acceleration is opposite to its rate.
- `"starts_forwards"`: Its rate is zero, its acceleration positive.
- `"starts_backwards"`: Its rate is zero, its acceleration negative.
- `"stays_at_rest"`: Its rate is zero, and its acceleration is zero within rounding.
- `"undecided"`: Its acceleration has no proven bounds.
- `"may_start"`: Its rate is zero, and its acceleration has no proven bounds."""

Status = Literal["none", "one", "several", "continuum", "preload_gap", "unknown"]
"""How many solutions there are.

- `"none"`: No solution: for a mechanism, friction locks it.
- `"one"`: Exactly one.
- `"several"`: Several, each in its own contact mode.
- `"continuum"`: Infinitely many: a mode with a vanishing determinant admits a continuum.
- `"preload_gap"`: No solution in a sign pattern was found, but there is a state with the preload between the
faces; `partial` and `undecided_modes` show what else may be open.
- `"unknown"`: Nothing was found, but not every pattern could be decided."""

Stroke = Literal["solid", "dashed", "dotted", "dash_dotted"]
"""How a curve is drawn.

- `"solid"`: A branch on which a mechanism can settle: a solid line.
- `"dashed"`: A threshold, which is not attainable: dashes.
- `"dotted"`: Between the faces of a contact with preload: dots.
- `"dash_dotted"`: A branch of which attainability says nothing definite: dashes and dots."""

Verdict = Literal["attainable", "unattainable", "flutter", "undecided", "not_computed"]
"""The fate of a solution when the guides are slightly elastic (theory, section 7).

- `"attainable"`: All fast motions are stable: the mechanism settles on the solution.
- `"unattainable"`: Some fast motion leaves the solution whatever the damping of the contacts.
- `"flutter"`: A fast oscillation grows unless the contacts are damped enough.
- `"undecided"`: The question has no definite answer; see the reason.
- `"not_computed"`: Not asked for, or not computed; see the reason."""

WithinRoundingAnswer = Literal["solution", "none", "unknown"]
"""Whether numbers that differ from the given ones only by rounding have a solution.

- `"solution"`: Some such numbers have the reported solution.
- `"none"`: No such numbers have a solution, which is proven.
- `"unknown"`: Neither was established."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AtRest(Record):
    """All states of rest together."""

    patterns: tuple[str, ...]
    """The sign patterns of the normal forces that are possible; 0 for a contact in its gap, or open."""
    reactions: Reactions
    """Reactions, over all these patterns."""
    wedging: tuple[str, ...]
    """The contacts whose normal forces have no bound: pressed against each other they are in equilibrium without
    any load, so that it can be wedged."""
    without_preloads: bool | None = None
    """Whether it could stay at rest without the preloads of its contacts; absent if there are none, or where
    that was not decided."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Attainability(Record):
    """Attainability of a solution."""

    verdict: Verdict
    """The verdict."""
    reason: str | None = None
    """Why it is undecided or not computed."""
    eigenvalues: NDArray[np.float64]
    """Finite nonzero eigenvalues lambda of the fast motion `x'' = -lambda x`: real and imaginary parts,
    ascending. Those of `n` rigid motions (`n - d` with drives), which are zero, and of motions without mass
    are left out."""
    eigenvalue_unit: EigenvalueUnit
    """Their unit."""
    massless_motions: int
    """Number of motions without mass that elastic guides allow; their masses tend to zero from above."""
    depends_on_stiffness: bool | None = None
    """True if the verdict changes when the stiffness of contacts varies by a factor of 10 up or down; absent if
    not tried."""
    depends_on_mass_ratios: bool | None = None
    """True if the verdict depends on the ratios of the vanishing masses."""
    flutter_damping: FlutterDamping | None = None
    """For flutter: the damping of the contacts that suppresses it."""
    separates: tuple[Mapping[str, Any] | str, Mapping[str, Any] | str] | None = None
    """For an unattainable solution: what becomes of the mechanism on either side of it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Axis(Record):
    """An axis."""

    name: str
    """The quantity that it measures."""
    unit: str
    """The unit; empty for pure numbers."""
    range: tuple[float, float] | None
    """From where to where; where absent, what the curves ask for but near values at which they grow without
    bound."""
    logarithmic: bool
    """Whether equal distances are equal ratios; the range is positive then."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Band(Record):
    """A coloured stretch along the x axis."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    colour: int
    """Index into the series of the theme, modulo their number."""
    meaning: str
    """Its meaning, for the legend."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Bar(Record):
    """A bar of a histogram."""

    sides: tuple[float, float]
    """Its left and its right side."""
    ends: tuple[float, float]
    """Where it stands, and its upper end."""
    colour: int
    """Index into the series of the theme, modulo their number."""
    meaning: str
    """Its meaning, for the legend."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BeyondHeld(Record):
    """What begins beyond an end of what is held."""

    at: float
    """The end, as a factor of the load, or the effort of the drive (N or N m)."""
    above: bool
    """Whether it is the upper end of a range."""
    words: str
    """In words: "it tips over shoes.front"."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BeyondRange(Record):
    """A nonzero unknown beyond the range of floating-point numbers of full precision: larger than 1.8e308, or
    smaller than 2.2e-308, in size."""

    name: RawUnknown
    """The name of the unknown."""
    index: int
    """The index of the unknown, from 0."""
    value: str
    """The exact value rounded to 17 digits ("1.5e310"), or words if it was not computed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BlowUp(Record):
    """A value at which efforts grow without bound."""

    at: float
    """The value."""
    pattern: str
    """The mode in which they do."""
    side: Approach
    """On which side of the value the mode exists."""
    efforts: tuple[int, ...]
    """1 or -1 for each drive whose effort grows without bound, with this sign, else 0."""
    contacts: tuple[str, ...]
    """The contacts whose normal forces grow without bound, too."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Body(Record):
    """Acceleration of a body, and what is left over in its balance."""

    name: str
    """Its name."""
    acceleration: tuple[float, float]
    """Acceleration of the centre of mass (m/s^2)."""
    angular_acceleration: float
    """Angular acceleration (rad/s^2)."""
    out_of_plane: tuple[float, float, float] | None = None
    """Of a body that lifts off or tips out of the drawing: its acceleration along z (m/s^2), and its angular
    accelerations about x and y (rad/s^2); absent of others."""
    residual_force: float
    """Left-over force of the recomputed balance (N)."""
    residual_moment: float
    """Left-over moment of the recomputed balance (N m)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BodySummary(Record):
    """A body."""

    name: str
    """Its name."""
    mass: float
    """Mass (kg); 0 for a massless body."""
    moment_of_inertia: float
    """Moment of inertia about the centre of mass (kg m^2)."""
    moved_by: float
    """How far its centre of mass is from its place in the drawing (m)."""
    turned_by: float
    """By which angle it is turned against the drawing (rad), counter-clockwise."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Branch(Record):
    """A branch of solutions, a mode, a motion: what has one colour and stroke."""

    name: str
    """In the legend."""
    colour: int
    """Index into the series of the theme, modulo their number."""
    stroke: Stroke
    """How it is drawn."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BranchReport(Record):
    """A mode in which the motion could continue."""

    number: int
    """Its number, counted from 1."""
    mode: str
    """The mode."""
    words: str
    """Where each sliding joint touches its guide in it, or that it sticks."""
    taken: bool
    """Whether it was taken."""
    continues: bool
    """Whether it continues the motion without a jump in the forces."""
    attainable: Verdict
    """Whether a real mechanism can follow it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BranchingReport(Record):
    """The report of one motion."""

    branches: tuple[int, ...]
    """The number of the phase taken at each event with several possible phases, counted from 1."""
    motion: SimulateReport
    """The motion."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Carried(Record):
    """A force or moment that a joint carries out of the drawing without friction."""

    name: str
    """The joint."""
    on: str
    """The body on which it is counted."""
    quantity: CarriedQuantity
    """Which one it is."""
    value: float
    """Its value."""
    unit: str
    """"N" or "N m"."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CauseReport(Record):
    """Why a phase ended, or what is to be reported."""

    kind: CauseKind
    """The kind of cause."""
    of: str | None
    """The joint, contact or function."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class CheckReport(_mixins.CheckReport, Report):
    """The parts of a model, and the hindrances to solving it."""

    _absent = {"sharing": None, "steps_from_drawing": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The model's title."""
    sound: bool
    """True if nothing stands in the way of `solve` in this state: there are no findings. (What only the
    enumeration of the modes can tell, such as too many preload gaps, is not tried.)"""
    findings: tuple[Finding, ...]
    """Everything for which that would be refused."""
    questions: tuple[Question, ...]
    """The questions, and which of them the model can answer in this state."""
    warnings: tuple[WarningReport, ...]
    """Warnings of what is perhaps not meant, though it does not stand in the way."""
    mobility: MobilitySummary
    """Degrees of freedom and determinacy."""
    sharing: LoadSharing | None
    """How redundant guides share their load; absent if no constraint is redundant, or it is not known."""
    inertia: InertiaSummary
    """Inertia of the motions that the joints leave."""
    condition: float | None
    """Ratio of the greatest to the least pivot of the kinetic equations, if they can be solved."""
    assembled: bool
    """True if the state could be assembled; if not, what depends on it is that of the drawing."""
    steps_from_drawing: int | None
    """In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    branch; absent where they are those of the drawing."""
    bodies: tuple[BodySummary, ...]
    """The bodies."""
    joints: tuple[JointSummary, ...]
    """The joints."""
    contacts: tuple[ContactSummary, ...]
    """The contacts of the sliding joints."""
    loads: tuple[str, ...]
    """Names of the loads."""
    drives: tuple[DriveSummary, ...]
    """The drives."""
    coordinates: tuple[CoordinateSummary, ...]
    """The chosen coordinates."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ClosestMode(Record):
    """A mode without a solution, close to locking."""

    pattern: str
    """Its pattern."""
    determinant: float
    """Determinant D."""
    oriented_determinant: float
    """D times the product of the signs; not positive beyond locking."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""
    absolute_normal_forces: NDArray[np.float64]
    """The value of |N| in the equations of the mode, of each contact (N); a negative value contradicts the mode."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Coefficients(Record):
    """Static coefficients of a contact."""

    contact: str
    """Its name."""
    mu_static: tuple[float, float]
    """Where the normal force is positive, and where it is negative."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Column(Record):
    """A column of numbers."""

    name: str
    """Name of the quantity, such as `phi.rate` or `upper.normal_force`."""
    unit: str
    """Its unit; empty for pure numbers."""
    values: NDArray[np.float64]
    """One for each row; None where the quantity is undefined: friction forces of sticking joints, and normal
    forces that statics leaves open there, because they depend on how the contacts share the friction."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Contact(Record):
    """A contact in a solution. Signs as in theory, section 1."""

    name: str
    """"joint", "joint.front" or "joint.rear"."""
    side: int
    """1 where the normal force is positive, -1 where it is negative, 0 where it vanishes."""
    normal_force: float
    """Normal force on the block along n (N)."""
    normal_force_bounds: tuple[float, float] | None = None
    """Proven bounds of the normal force (N); absent where there are none."""
    friction_force: float
    """Friction force, positive against positive sliding (N)."""
    sliding_velocity: float
    """Sliding velocity of the block against the guide along u (m/s)."""
    couple: float | None = None
    """Couple of a guided slider about the middle of the pressed face (N m)."""
    pressure: float | None = None
    """Mean bearing pressure, the normal force over length and width of the pad (Pa); absent without a pad."""
    preload_share: float | None = None
    """In a preload gap: the share of the preload friction at the face of positive normal force."""
    deflection: float | None = None
    """Of a contact that shares its load with others: by how much the block is displaced against its guide there,
    towards +n (m); within its play where the contact is open."""
    gap_acceleration: float | None = None
    """Of a contact that lifts off, whose `side` is -1: the acceleration of its gap (m/s^2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactFit(Record):
    """How a contact fits that shares its load with others."""

    play: float
    """Total play between its faces (m)."""
    misalignment: float
    """How far the guide's line is displaced there, towards +n (m)."""
    stiffness: float | None = None
    """Stiffness of a face (N/m), if the model gives it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactImpulse(Record):
    """The impulse of a contact."""

    name: str
    """The contact."""
    normal_impulse: float
    """Impulse of its normal force (N s)."""
    friction_impulse: float
    """Impulse of its friction, positive against the direction of positive sliding on the block (N s)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactRange(Record):
    """Reactions of a contact."""

    name: str
    """Its name."""
    normal_force: Range
    """Normal force on the block, along n (N)."""
    normal_force_parts: tuple[Range, ...] = ()
    """The parts of that range in which it can lie; absent where no value between is impossible."""
    friction_force: Range
    """Friction force on the block, against u (N); of a round end that of both of its contacts, at the one along
    n."""
    couple: Range | None
    """Couple of a guided slider (N m)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContactSummary(Record):
    """A contact."""

    name: str
    """"joint", "joint.front" or "joint.rear"."""
    mu: tuple[float, float]
    """Kinetic friction coefficient where the normal force is positive, and where it is negative."""
    mu_depends_on_speed: bool = False
    """True if it depends on the sliding speed; it is given at that of the state."""
    mu_static: tuple[float, float]
    """Static friction coefficient, likewise."""
    preload: tuple[float, float]
    """Preload (N), likewise."""
    sliding_velocity: float | None
    """Sliding velocity (m/s), if the state could be assembled."""
    fit: ContactFit | None = None
    """Of a contact that shares its load with others: how it fits."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Continuum(Record):
    """Infinitely many solutions of one mode: all convex combinations of the vertices plus all non-negative
    multiples of the directions."""

    pattern: str
    """Its pattern."""
    rests: bool = False
    """Whether it stays at rest in all of it, as in `Solution::rests`."""
    vertices: tuple[NDArray[np.float64], ...]
    """Normal forces of the contacts at each vertex (N); none if there are more than 4096 vertices and
    directions."""
    directions: tuple[NDArray[np.float64], ...]
    """Directions in which the normal forces may grow without bound."""
    motion: tuple[DrivenMotion, ...] = ()
    """Efforts and accelerations at each vertex; none where a preload may rub at either face."""
    motion_along: tuple[DrivenMotion, ...] = ()
    """The contributions of a unit of each direction to them."""
    tipping: tuple[str, ...]
    """The guided sliders that would tip in a part of it."""
    couple: CoupleRange | None = None
    """The friction couple of a hinge that never turns, if it is what is free; absent otherwise."""
    held: tuple[HeldFriction, ...] = ()
    """The friction of contacts and hinges that stand still while the rest moves, if it is what is free; empty
    otherwise."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ContinuumPart(Record):
    """Unknowns that vary together: all convex combinations of the vertices plus all nonnegative multiples of the
    directions. A set that contains lines, which takes free unknowns, has no vertices: these are points of its
    smallest faces then, and the directions contain both ones of lines that span all of its lines."""

    indices: tuple[int, ...]
    """The unknowns, from 0, as `signs` counts them; vertices and directions have one entry for each."""
    vertices: tuple[Mapping[str, Any], ...]
    """The vertices, up to the requested number: the ends of a segment, or the end of a ray."""
    directions: tuple[Mapping[str, Any], ...]
    """Directions in which the set is unbounded, up to the requested number."""
    vertex_count: int
    """Total number of vertices."""
    direction_count: int
    """Total number of directions."""
    dimension: int | None = None
    """If there are more than 4096 vertices and directions, counting those that have to be held on the way to
    them, none are listed or counted; this is the dimension of the part then, ..."""
    inside: Mapping[str, Any] | None = None
    """... and this is a point inside it: what is zero here is zero in the whole part."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoordinateAcceleration(Record):
    """Acceleration of a chosen coordinate."""

    name: str
    """The coordinate."""
    unit: str
    """"m/s^2" or "rad/s^2"."""
    acceleration: float
    """Its acceleration."""
    acceleration_bounds: tuple[float, float] | None = None
    """Proven bounds of its acceleration; absent where there are none."""
    speed: SpeedChange | None = None
    """The change of its speed; absent if a drive prescribes its motion."""
    stop: Stopping | None = None
    """If it slows down: when and where it stops if its acceleration stays as it is."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoordinateRange(Record):
    """Acceleration of a coordinate."""

    name: str
    """Its name."""
    unit: str
    """"m/s^2" or "rad/s^2"."""
    acceleration: Range
    """Its acceleration."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoordinateState(Record):
    """A chosen coordinate in the state."""

    name: str
    """Its name."""
    unit: str
    """"m" or "rad"."""
    value: float
    """Its value."""
    rate: float
    """Its rate."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoordinateSummary(Record):
    """A chosen coordinate."""

    name: str
    """Its name."""
    kind: CoordinateForm
    """Its kind."""
    positive: str
    """Its positive direction, in words."""
    unit: str
    """"m" or "rad"."""
    value: float
    """Its value in the state."""
    rate: float
    """Its rate."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoordinateValue(Record):
    """A coordinate."""

    name: str
    """Its name."""
    unit: str
    """Its unit."""
    value: float
    """Its value."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CountLimits(Record):
    """An interval with the same number of solutions throughout."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    solutions: int
    """Number of solutions."""
    preload_gap_states: int
    """Number of preload-gap states, which are counted apart."""
    continuum: bool
    """Whether there are infinitely many solutions, besides these."""
    known: Known
    """How these numbers are known."""
    tipping: Tipping | None = None
    """Guided sliders that tip where there is no solution; absent where none does."""
    proven: NDArray[np.float64]
    """The stretches for all values of which they are proven, both ends included. If `known` is `proven` nothing
    of the interval lies between them but what is next to ends of modes: `CountLimits::left_out`."""
    spacing: float | None
    """Where they were sampled: the greatest distance between neighbouring values; else null."""
    starts: tuple[str, ...] | None = None
    """How each state starts, in words, where contacts that may lift off are at rest; absent elsewhere."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CountStretch(Record):
    """A part of the range of an uncertain parameter."""

    from_: float
    """Its least value (SI units)."""
    to: float
    """Its greatest value."""
    least_solutions: int
    """For every value in it there are at least so many solutions."""
    most_solutions: int | None = None
    """For every value in it there are at most so many solutions; absent if that could not be proven."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CoupleRange(Record):
    """The friction couple of a hinge that never turns, over a range."""

    hinge: str
    """The hinge."""
    couples: NDArray[np.float64]
    """The couple on its first body at each vertex (N m)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Course(Record):
    """The efforts over what is varied."""

    vary: VariedQuantity
    """Varied quantity, with its range."""
    directions: tuple[CourseDirection, ...]
    """Motion as in the model, and with all rates reversed."""
    sampled: bool
    """Whether the values at which something changes were sought between sampled ones, so that some may be
    missed."""
    guarantee: str
    """Account, in words, of what can be missed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CourseDirection(Record):
    """The efforts over what is varied in one direction of motion."""

    direction: Sense
    """Which direction it is."""
    rows: tuple[CourseRow, ...]
    """One row for each value and each solution there; a value without a solution has one row without a pattern."""
    modes: tuple[CourseMode, ...]
    """The modes of the rows, each once."""
    blow_ups: tuple[BlowUp, ...]
    """Values at which efforts grow without bound, in ascending order."""
    peaks: tuple[PeakEffort, ...] = ()
    """Where the effort of each drive is greatest, by its magnitude; absent where one grows without bound, where
    there are several states, and with friction in hinges."""
    tips: tuple[TipsOver, ...] = ()
    """Ranges in which joints tip in every state, in ascending order; absent where none does, and with friction
    in hinges."""
    locked: tuple[LockedRange, ...] = ()
    """Ranges without a solution: it jams."""
    without_mode_problem: tuple[RangeWithoutProblem, ...]
    """Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CourseMode(Record):
    """A mode that occurs."""

    pattern: str
    """One sign for each contact."""
    words: str
    """The contact modes of all sliding joints, in words."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CourseRow(Record):
    """The efforts in one solution at one value."""

    at: float
    """The value."""
    pattern: str | None
    """The mode; null where there is no solution or no position."""
    attainability: Verdict | None
    """Whether a mechanism with slightly elastic guides settles on it; null where there is no solution, and where
    efforts grow without bound."""
    efforts: NDArray[np.float64] | None
    """Of each drive (N or N m); null where they grow without bound, or without a solution."""
    grows: tuple[int, ...]
    """1 or -1 for each drive whose effort grows without bound there, else 0."""
    frictionless: NDArray[np.float64] | None
    """Without friction; null where there is no position, and where it is not known whether there is a solution."""
    power: float | None
    """Of all drives together (W)."""
    efficiency: Efficiency | None
    """Against the same motion without friction."""
    range: EffortRange | None = None
    """Where there are infinitely many solutions: between which values their efforts lie; absent elsewhere."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CriticalContact(Record):
    """The contact whose coefficient of friction matters most."""

    contact: str
    """Its name."""
    factor: float
    """The factor by which its friction alone may grow before there is another number of solutions."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Curve(Record):
    """A quantity along a branch."""

    branch: int
    """Index into `Figure::branches`."""
    quantity: int
    """Index into `Figure::quantities`."""
    points: NDArray[np.float64]
    """Points in the units of the axes, joined by lines; points that are not finite are left out."""
    ends: tuple[End, End]
    """The kinds of its beginning and its end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Direction(Record):
    """The modes of the opposite direction of motion."""

    _absent = {"between_faces_at": _mixins.EMPTY}

    modes: tuple[ModeLimits, ...]
    """The modes."""
    counts: tuple[CountLimits, ...]
    """Numbers of solutions."""
    without_mode_problem: tuple[RangeWithoutProblem, ...]
    """Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed."""
    between_faces_at: NDArray[np.float64] = field(default_factory=lambda: _mixins.EMPTY)
    """Single values at which a guided slider is between its faces; absent if none was found."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnArrow(Record):
    """An arrowhead."""

    at: tuple[float, float]
    """Its tip, in the units of the axes."""
    angle: float
    """Its direction in the picture, from the right counterclockwise (deg)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnClass(Record):
    """A class of points."""

    fill: str
    """Its colour, as a CSS colour."""
    hatching: Hatching | None
    """How it is hatched, if it is."""
    text: str
    """Its meaning and its share of the map, for the legend."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnExit(Record):
    """Where a curve leaves the frame."""

    at: tuple[float, float]
    """Where, in the units of the axes."""
    branch: int
    """The branch of the curve."""
    upwards: bool
    """Whether it goes on above the frame, not below it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnFlag(Record):
    """The label of a marked value."""

    at: float
    """The value."""
    label: str
    """Its label."""
    asymptote: bool
    """Whether curves grow without bound there."""
    left: float
    """Where the label begins, from the left edge of the frame (px)."""
    row: int
    """The row above the frame in which it stands, from 0."""
    beside: bool
    """Whether it stands beside its line, not above it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnLine(Record):
    """A line for one curve or for several."""

    points: NDArray[np.float64]
    """Points in the units of the axes, within the frame."""
    branches: tuple[int, ...]
    """The branches that it stands for."""
    quantity: int
    """Index into the quantities of the figure."""
    markers: NDArray[np.float64]
    """Places of the markers of its quantity, if there are several quantities."""
    arrows: tuple[DrawnArrow, ...]
    """Arrowheads that show the order of its points, if the panel has them."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnMap(Record):
    """A map in words and colours; its pixels are those of the report."""

    title: str
    """Headline."""
    subtitle: str
    """A line below it that tells what was changed in the model; may be empty."""
    x: Axis
    """The horizontal axis, with its range."""
    y: Axis
    """The vertical axis, with its range."""
    classes: tuple[DrawnClass, ...]
    """The classes, in the order of the report."""
    modes: tuple[str, ...]
    """The meanings of signs of modes that no class states, for the end of the legend."""
    model: tuple[float, float] | None
    """The values of the model, in the units of the axes; absent if they are not on the map."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnPanel(Record):
    """The contents of a panel as they are drawn; all else is in the panel itself."""

    x: tuple[float, float]
    """From where to where the horizontal axis goes."""
    y: tuple[float, float]
    """From where to where the vertical axis goes."""
    lines: tuple[DrawnLine, ...]
    """The curves; those that cannot be told apart are one line."""
    flags: tuple[DrawnFlag, ...]
    """The labels of marked values."""
    exits: tuple[DrawnExit, ...]
    """Where curves go on above or below the frame."""
    legend: tuple[LegendEntry, ...]
    """The legend."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Drive(Record):
    """The effort of a drive."""

    name: str
    """The drive."""
    unit: str
    """"N" or "N m"."""
    effort: float
    """The force or torque that produces the prescribed motion."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveDirection(Record):
    """The efforts in one direction of motion."""

    direction: Sense
    """Which direction it is."""
    status: Status
    """How many solutions there are."""
    complete: Proof
    """Whether these are certainly all solutions."""
    frictionless: Frictionless
    """Without friction."""
    solutions: tuple[DriveSolution, ...]
    """Every solution, preload-gap states after the others."""
    range: EffortRange | None = None
    """Where there are infinitely many solutions: between which values their efforts lie; absent if there are
    not, and if it is not known."""
    no_solution: float | None = None
    """Just beyond this factor of friction there is no solution; absent if there always is one, or it was not
    computed."""
    never_jams: bool
    """Whether there is a solution however great the friction; false also where that was not computed."""
    another_count: float | None = None
    """Up to this factor there is the same number of solutions; absent if that never changes, but to none at
    `no_solution`."""
    unique_at_least: float | None = None
    """With friction in hinges: up to at least this factor there is exactly one solution; absent without it, and
    where that is not proven."""
    moves_below: Unlocking | None = None
    """Where there is no solution: to what all friction would have to fall for one; absent where there is one,
    and where none comes."""
    mu: float | None = None
    """The coefficient of friction of all contacts that have friction; absent if it is not the same for all of
    them, or depends on the sliding speed."""
    tips: tuple[str, ...] = ()
    """The guided sliders that tip where there is no solution, or from that factor on: as block sliders they show
    whether it moves."""
    tipping: TippingLimit | None = None
    """From where on a block that may lift off tips over one of its corners, while there is a solution; absent if
    none does."""
    below: TippingLimit | None = None
    """With less friction: below which it tips or jams; absent if nothing happens down to none, and where it tips
    or jams as it is."""
    blow_ups: tuple[BlowUp, ...] | None = None
    """Factors of friction at which efforts grow without bound, in ascending order; absent if there are too many
    modes, or friction in hinges."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveName(Record):
    """A drive."""

    name: str
    """Its name."""
    unit: str
    """Unit of its effort: "N" or "N m"."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveRange(Record):
    """Effort of a drive that holds."""

    name: str
    """Its name."""
    unit: str
    """"N" or "N m"."""
    effort: Range
    """Its effort."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class DriveReport(_mixins.DriveReport, Report):
    """The efforts of all drives."""

    _absent = {"held": (), "course": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The title of the model."""
    state: tuple[CoordinateState, ...]
    """The coordinates, with the rates of the model."""
    drives: tuple[DriveName, ...]
    """The drives; all lists of efforts have their order."""
    directions: tuple[DriveDirection, ...]
    """Motion as in the model, and with all rates reversed; at rest on contacts that may lift off only the first."""
    held: tuple[HeldEffort, ...]
    """At rest on contacts that may lift off: the efforts of each drive, the others absent, with which it stays
    at rest; any other may set it in motion. Absent elsewhere, and where `hold` does not know."""
    course: Course | None
    """The efforts over what is varied, if anything is."""
    conclusion: tuple[str, ...]
    """Sentences that sum up the answer."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveSolution(Record):
    """The efforts in a solution."""

    pattern: str
    """Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap."""
    preload_gap: bool
    """Whether a contact rests in its preload gap."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""
    attainability: Verdict
    """Whether a mechanism with slightly elastic guides settles on it."""
    efforts: NDArray[np.float64]
    """Of each drive (N or N m)."""
    power: float
    """Of all drives together (W)."""
    efficiency: Efficiency
    """Against the same motion without friction."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveSummary(Record):
    """A drive."""

    name: str
    """Its name."""
    coordinate: str
    """The coordinate whose motion it prescribes."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrivenMotion(Record):
    """The efforts of the drives, and the accelerations of the coordinates."""

    efforts: NDArray[np.float64]
    """Of each drive (N or N m)."""
    accelerations: NDArray[np.float64]
    """Of each coordinate (m/s^2 or rad/s^2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Efficiency(Record):
    """The share of power that is not lost to friction."""

    is_: EfficiencyKind
    """Which way power flows."""
    value: float | None
    """The share; null where it has no meaning."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EffortRange(Record):
    """The efforts of infinitely many solutions."""

    undetermined: Undetermined
    """The least and the greatest effort of each drive, and what leaves them open."""
    power: tuple[float | None, float | None]
    """The least and the greatest power of all drives together (W); null where it is unbounded."""
    efficiency: tuple[float, float] | None = None
    """The least and the greatest efficiency; absent where not all of them have one of the same kind."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EndHingeForce(Record):
    """Limits of the force of a hinge with friction towards both ends of an interval, or its growth without
    bound."""

    hinge: str
    """The hinge."""
    from_: float | None
    """The limit of its magnitude towards the beginning (N); null where it grows without bound or was not
    computed."""
    to: float | None
    """Its limit towards the end, likewise."""
    from_grows: bool
    """Whether it grows without bound towards the beginning."""
    to_grows: bool
    """Whether it grows without bound towards the end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EndReaction(Record):
    """Limits of a normal force towards both ends of an interval, or its growth without bound."""

    contact: str
    """The contact."""
    from_: float | None
    """Its limit towards the beginning (N); null where it grows without bound or was not computed."""
    to: float | None
    """Its limit towards the end, likewise."""
    from_grows: int
    """1 or -1 where it grows without bound towards the beginning with this sign, else 0."""
    to_grows: int
    """1 or -1 where it grows without bound towards the end with this sign, else 0."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EndReport(Record):
    """How a motion ends."""

    kind: EndKind
    """Why it ends."""
    words: str
    """In words."""
    locked: bool
    """Whether friction locks the mechanism, so that it cannot continue to move."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EnergyReport(Record):
    """Where the energy went (J)."""

    kinetic: tuple[float, float]
    """Kinetic energy at the start and at the end."""
    potential: tuple[float, float]
    """Potential energy at the start and at the end."""
    friction: tuple[Named, ...]
    """Dissipated by the friction of each contact."""
    hinges: tuple[Named, ...] = ()
    """Dissipated by the friction of each hinge that has some."""
    loads: tuple[Named, ...]
    """Work of each load other than constant springs; of a pad what its damper takes, as a negative number."""
    pads: tuple[Named, ...] = ()
    """The part of the potential energy that the spring of each pad stores at the end."""
    drives: tuple[Named, ...]
    """Work of each drive."""
    impulses: float
    """Lost in impulses."""
    error: float
    """The greatest error of the energy balance at any step."""
    relative_error: float | None
    """That error relative to the greatest kinetic energy, work or dissipation; null if these are no greater than
    the error, because they are only rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EventReport(Record):
    """Something that happened at an instant."""

    time: float
    """When (s)."""
    causes: tuple[CauseReport, ...]
    """All simultaneous causes."""
    words: str
    """What happened, in words."""
    mode: str | None
    """The mode that follows; absent if the motion ends."""
    attainable: Verdict | None = None
    """Whether a real mechanism can follow that mode; absent if the motion ends, and where it was not computed."""
    branches: tuple[BranchReport, ...]
    """All possible modes, in order of preference, if there were several."""
    branches_left_out: bool = False
    """Whether further modes, in which fewer joints stick, may be possible: there are too many states to try all."""
    energy_lost: float
    """Energy lost in impulses (J)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EveryRightHandSide(Record):
    """Whether there is exactly one solution for every right-hand side (`q`, `b`, `right_hand_side`), with the
    matrices as given: theory, section 5."""

    answer: EveryAnswer
    """The answer."""
    patterns: tuple[str, ...] = ()
    """Sign patterns that show it: for `not_one`, two whose oriented determinants have opposite signs; for
    `singular`, one whose determinant is zero; for `in_doubt`, one whose sign was not decided; otherwise none."""
    reason: str = ""
    """Why it was not decided, in words; empty if it was."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Figure(Record):
    """A figure: panels one below the other, each with its legend."""

    title: str
    """Headline."""
    subtitle: str
    """A line below it; may be empty."""
    panels: tuple[Panel, ...]
    """The panels, from top to bottom."""
    branches: tuple[Branch, ...]
    """The meanings of the colours and strokes of curves, in the order of the legend."""
    quantities: tuple[str, ...]
    """Names of what several curves of one branch show; told apart by markers if there are several."""
    one_legend: bool
    """Whether one legend below all panels stands for those of each."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Finding(Record):
    """Something for which the model would be refused."""

    message: str
    """The fault in words."""
    hint: str | None
    """The remedy."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FlutterDamping(Record):
    """The least damping of the contacts, `N = -kappa (gap + delta gap')`, that suppresses flutter."""

    ratio: float
    """Damping ratio `zeta = delta sqrt|lambda| / 2` of the fluttering motion."""
    time: float | None = None
    """The time `delta` (s); absent if the model does not give the stiffness of every contact."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FrictionNeeded(Record):
    """The static friction that the loads need as they are."""

    threshold: Threshold
    """From which static friction on they can be held: at least where something has wedged the guides before."""
    certain_from: float | None
    """From which value of the same on they are held for certain, since there it cannot slide; nothing if they
    never are."""
    safety_factor: float | None
    """By how much all static friction may be divided until it may slide, below 1 where it may already: the
    inverse of `certain_from`. Nothing where that is nothing, or 0: no friction is needed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Frictionless(Record):
    """The efforts without friction."""

    efforts: NDArray[np.float64]
    """Of each drive (N or N m)."""
    power: float
    """Of all drives together (W)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class GapRange(Record):
    """How a contact lifts off."""

    contact: str
    """Its name."""
    acceleration: Range
    """Acceleration of its gap (m/s^2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class GapShare(Record):
    """An unknown in its preload gap."""

    index: int
    """The index of the unknown, from 0."""
    lambda_: float
    """The share lambda of `jumps_positive`, from 0 to 1; NaN (`null`) if it is beyond the range."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HeldEffort(Record):
    """The efforts of a drive with which a mechanism stays at rest."""

    drive: str
    """The drive."""
    held: tuple[Range, ...]
    """The ranges of its effort (N or N m), disjoint and in ascending order."""
    words: str
    """In words: "It holds with `push` from -1.254 to 7.963 N." """


@dataclass(frozen=True, eq=False, kw_only=True)
class HeldFriction(Record):
    """The friction of a contact or hinge that stands still while the rest moves, over a range."""

    name: str
    """The contact, or the hinge."""
    unit: str
    """"N", or "N m" of a hinge."""
    at: NDArray[np.float64]
    """At each vertex: the friction force, positive against positive sliding, or the couple on the hinge's first
    body."""
    along: NDArray[np.float64]
    """The contributions of a unit of each direction to it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Hinge(Record):
    """A hinge force."""

    name: str
    """The hinge."""
    on: str
    """The body on which the force is counted."""
    force: tuple[float, float]
    """Its components (N)."""
    friction: HingeFriction | None = None
    """Its friction; absent of a hinge without friction."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HingeFriction(Record):
    """Friction in a hinge that turns."""

    couple: float
    """Friction couple on the body on which the force is counted (N m): radius times hinge force, against the
    rotation."""
    radius: float
    """Radius of the friction circle, to which the hinge force is tangent (m)."""
    angular_velocity: float
    """Angular velocity of that body against the other one (rad/s)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HingeRange(Record):
    """Force of a hinge."""

    name: str
    """Its name."""
    on: str
    """The body on which it is counted."""
    force: tuple[Range, Range]
    """Its components along x and y (N)."""
    couple: Range | None
    """The couple of its friction, with that of its collar, on the same body (N m); nothing if it has none."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class HoldReport(_mixins.HoldReport, Report):
    """Whether a mechanism stays at rest, under which loads, and how it begins to move."""

    _absent = {"steps_from_drawing": None, "sharing": None, "wedging": None, "friction": None, "one_face_hints": ()}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The model's title."""
    verdict: HoldVerdict
    """The answer."""
    holds: bool
    """Whether it can stay at rest: of the verdict."""
    state: tuple[CoordinateValue, ...]
    """Values of the chosen coordinates."""
    steps_from_drawing: int | None
    """In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    branch; absent where they are those of the drawing."""
    rates_ignored: bool
    """Whether the model gives rates that were taken as zero."""
    released_drives: tuple[str, ...]
    """Drives that are taken as absent."""
    holding_drives: tuple[str, ...]
    """Drives that hold their coordinate."""
    sharing: LoadSharing | None
    """How redundant guides share their load; absent if no constraint is redundant."""
    wedging: Wedging | None
    """Whether redundant guides can be wedged; absent if no constraint is redundant."""
    load: LoadReport | None
    """The load that is varied, if one is."""
    friction: FrictionNeeded | None
    """How much static friction the loads need as they are; absent with a varied load, and without friction."""
    at_rest: AtRest | None
    """The states of rest, if there is one of which the reactions were decided."""
    releases: tuple[Release, ...]
    """Every state in which it begins to move; empty also where motions without inertia kept them from being
    sought."""
    one_face_hints: tuple[OneFaceHint, ...]
    """The joints of two faces of which rest, or the start of the motion, needs the one that the thing itself may
    not have. Absent if there are none."""
    motions_without_inertia: tuple[str, ...]
    """Motions of the joints without inertia; if there are any, `releases` was not sought."""
    rest_patterns: int
    """Patterns of contact sides that were tried for rest."""
    release_patterns: int
    """States of joints and contact sides that were tried for release."""
    undecided: int
    """Patterns of both kinds, and of those of the load, of friction and of wedging, of which a linear program
    could not be solved."""


@dataclass(frozen=True, eq=False, kw_only=True)
class InertiaSummary(Record):
    """Inertia of the motions that the joints leave."""

    regular: bool
    """True if the mass matrix is regular on them: every motion has kinetic energy."""
    motions_without: tuple[str, ...]
    """The motions that have none."""


@dataclass(frozen=True, eq=False, kw_only=True)
class InfluenceSummary(Record):
    """The frictionless answer and the influence coefficients."""

    coordinate_accelerations: NDArray[np.float64]
    """Accelerations of the coordinates without friction."""
    normal_forces: NDArray[np.float64]
    """Normal forces without friction, N(0) (N)."""
    drives: tuple[Drive, ...]
    """The drives with their efforts without friction."""
    eta_positive: tuple[NDArray[np.float64], ...]
    """eta_jk for friction at the faces of positive normal force; row j is the contact that answers."""
    eta_negative: tuple[NDArray[np.float64], ...]
    """As above, at the faces of negative normal force."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JamImpulse(Record):
    """An impulse at a jam: velocities jump without a collision, until what wedges has stopped."""

    joints: tuple[JointMode, ...]
    """State of each sliding joint afterwards."""
    contacts: tuple[ContactImpulse, ...]
    """The impulses of all contacts."""
    coordinates: tuple[CoordinateState, ...]
    """The chosen coordinates, with their rates afterwards."""
    energy_lost: float
    """The kinetic energy that it takes (J)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointMode(Record):
    """The contact mode of a sliding joint."""

    name: str
    """Its name."""
    mode: str
    """The mode in words: "touching at lower right and upper left"."""
    face: OnFace | None = None
    """What it does on a face that it may leave; absent on a guide that holds it."""
    slip: int | None = None
    """How it starts from rest: 1 if it slides along its guide, -1 if against it, 0 if it sticks; absent of what
    is not at rest."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointRelease(Record):
    """What a sliding joint does on release."""

    name: str
    """Its name."""
    slip: int
    """0 if it sticks, 1 if the block begins to slide along u, -1 if against it."""
    words: str
    """The same in words."""
    acceleration: Range
    """Acceleration of the block against the guide along u (m/s^2)."""
    open: tuple[str, ...] = ()
    """Its contacts that lift off; absent if none does."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointSummary(Record):
    """A joint."""

    _absent = {"gaps": _mixins.EMPTY}

    name: str
    """Its name."""
    kind: JointForm
    """Its kind."""
    joins: tuple[str, str]
    """The bodies it joins; of a sliding joint first the block, then the guide."""
    constraints: int
    """Scalar constraints."""
    direction: tuple[float, float] | None
    """Direction `u` of a sliding joint in this state: that of `along`, turned with the guide."""
    positive: str | None
    """Its positive direction of sliding, in words."""
    displacement: float | None
    """Displacement of a sliding joint (m)."""
    overlap: float | None
    """Supported length of a block slider (m)."""
    stops: tuple[Mapping[str, Any] | None, Mapping[str, Any] | None] | None = None
    """The stops at the least and at the greatest displacement, if there are any."""
    friction_radii: tuple[float, float] | None = None
    """Radii of the friction circle of a hinge with friction (m): while it turns, and at rest."""
    collar_radii: tuple[float, float] | None = None
    """The friction couples of the collar of a hinge by its force along z, turning and at rest (m); absent
    without."""
    gaps: NDArray[np.float64] = field(default_factory=lambda: _mixins.EMPTY)
    """The gaps of what is apart from its face (m); of a block those of the front and of the rear corner, if both
    are."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LegendEntry(Record):
    """An entry of a legend."""

    sample: Mapping[str, Any]
    """The sample beside the text."""
    text: str
    """The text."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class LimitsReport(_mixins.LimitsReport, Report):
    """For which values each mode exists."""

    _absent = {"steps_from_drawing": None, "between_faces_at": _mixins.EMPTY, "reversed": None, "not_examined": ()}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The title of the model."""
    vary: VariedQuantity
    """Varied quantity, with its range."""
    state: tuple[CoordinateState, ...]
    """The coordinates for which it holds, but for one that is varied."""
    steps_from_drawing: int | None
    """In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    branch; absent where they are those of the drawing, and where a coordinate is varied: then `guarantee`
    tells of it."""
    method: LimitsMethod
    """How the ends of modes were found."""
    guarantee: str
    """Account, in words, of what the method can miss."""
    modes: tuple[ModeLimits, ...]
    """The modes in the direction of the model's rates."""
    counts: tuple[CountLimits, ...]
    """Numbers of solutions in that direction."""
    without_mode_problem: tuple[RangeWithoutProblem, ...]
    """Ranges in which the mechanism cannot be assembled or solved, or the model is not allowed, in that
    direction."""
    between_faces_at: NDArray[np.float64]
    """Single values at which a guided slider is between its faces, in that direction; absent if none was found."""
    reversed: Direction | None
    """The opposite direction, if it was asked for."""
    conclusion: tuple[str, ...]
    """Conclusion in words: a sentence for each stretch."""
    not_examined: tuple[str, ...]
    """Sentences on what was left out; absent if nothing was."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LoadReport(Record):
    """What is known of a load that is multiplied by a factor."""

    name: str
    """Its name."""
    unit: str
    """Unit of the factor: empty for a load, "N" or "N m" for the effort of a drive."""
    factor: float
    """The factor at which everything else in the report is told: 1 for a load, 0 for a drive."""
    force: float | None = None
    """The resultant of the load as it is (N); absent of a drive, and where its forces balance."""
    held: tuple[Range, ...]
    """The factors with which it can stay at rest, in ascending order."""
    beyond: tuple[BeyondHeld, ...] = ()
    """What it begins to do just beyond each end of these ranges, where contacts may lift off; absent without."""
    undecided: int
    """Patterns of contact sides in which that was not decided: they may hold it with others."""
    self_locking: bool
    """Whether it can stay at rest with every factor that is great enough."""
    threshold: Threshold
    """From which static friction on it is held alone, however great: at least where the guides are wedged."""
    certain_from: float | None
    """From which value of the same on it holds by itself, since there it cannot slide, not even where nothing
    wedged it before; nothing if it never does, or where that was not sought."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LoadSharing(Record):
    """How redundant guides share a load, and the two faces of press fits."""

    self_stresses: int
    """Degree of redundancy: the number of independent self-stresses, without those between the two faces of a
    press fit."""
    groups: tuple[tuple[str, ...], ...]
    """The contacts that share a load, in groups that do not act on one another by self-stresses."""
    elasticity: Elasticity
    """Their assumed elasticity."""
    press_fits: tuple[PressFit, ...] = ()
    """The press fits."""
    stiffness_ratios: StiffnessRatios | None = None
    """True if other ratios of stiffnesses would change the contact modes; absent if that was not asked, for
    rigid faces, and where there are too many patterns."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LockedMode(Record):
    """A mode with a vanishing determinant and no solution."""

    pattern: str
    """Its pattern."""
    factor: float
    """The part of the friction of the model at which its determinant vanishes, at most 1."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LockedRange(Record):
    """A range in which no effort moves the mechanism."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MapAxis(Record):
    """An axis of a map."""

    name: str
    """Its name."""
    from_: float
    """Where it begins (SI units)."""
    to: float
    """Where it ends."""
    value: float
    """Its value in the model."""
    pixels: int
    """Number of pixels."""
    unit: str
    """The unit in which it is to be shown; empty for pure numbers."""
    scale: float
    """Size of that unit in SI units."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MapClass(Record):
    """A class of points."""

    meaning: Mapping[str, Any]
    """Property that its points have in common."""
    words: str
    """Words for that property."""
    modes: tuple[str, ...]
    """For modes: each of them in words."""
    pixels: int
    """Number of its pixels."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class MapReport(_mixins.MapReport, Report):
    """A map of pixels and what their classes mean."""

    _absent = {"remark": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The title of the model."""
    colour_by: ColourBy
    """Property that the colours show."""
    x: MapAxis
    """From left to right."""
    y: MapAxis
    """From bottom to top."""
    classes: tuple[MapClass, ...]
    """The classes that occur."""
    points: int
    """Number of points that were solved."""
    guarantee: str
    """Account, in words, of what can have been missed."""
    remark: str | None
    """Remark on what its colours do not show; absent if there is nothing."""
    rows: tuple[tuple[tuple[int, int], ...], ...]
    """Rows of pixels from bottom to top: each as pairs of a class, counted from 0, and the number of pixels it
    has on end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Margins(Record):
    """By which factors all coefficients of friction together may grow before the answer changes."""

    another_count: float | None = None
    """Up to this factor there is the same number of solutions (and of gap states); absent if it never changes."""
    mu: float | None = None
    """The coefficient of friction of all contacts, to which the factors apply; absent where contacts differ in
    theirs, and where none has friction."""
    no_solution: float | None = None
    """Just beyond this factor there is no solution, so that nothing moves; absent if there always is one."""
    tips: tuple[str, ...] = ()
    """The guided sliders that tip there, so that friction need not lock it: as block sliders they show whether
    it moves on."""
    tipping: TippingLimit | None = None
    """From where on a block that may lift off tips over one of its corners, while there is a solution; absent if
    none does."""
    below: TippingLimit | None = None
    """With less friction: below which it tips or jams; absent if nothing happens down to none, and where it tips
    or jams as it is."""
    tips_between: TippingRange | None = None
    """Of what tips as it is: between which factors of friction it does; absent elsewhere."""
    solutions_again: float | None = None
    """From this greater factor on there are solutions again; absent if there are none."""
    uniqueness: float | None = None
    """Up to this factor every load has exactly one solution (below 1: some other load has none or several
    already): there a determinant is proven to change its sign. Of redundant guides, for every play,
    misalignment and stiffness, too (theory, eq. (R4)). Absent if no determinant changes its sign, or if that
    was not asked because preloads jump with the side of contact."""
    moves_below: Unlocking | None = None
    """Where there is no solution: to what all friction would have to fall for one; absent where there is one,
    and where none comes."""
    locking: LockedMode | None = None
    """Where there is no solution: the mode that locks last as all friction grows to the present one; absent
    where none does."""
    critical_contact: CriticalContact | None = None
    """The contact whose friction alone changes the number of solutions first; absent if none does."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MarkedPoint(Record):
    """A point that is marked."""

    at: tuple[float, float]
    """Where, in the units of the axes."""
    kind: PointKind
    """The meaning of the point."""
    part: float | None = None
    """Of an impact the energy that it takes, as a part of the greatest of the motion."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MarkedValue(Record):
    """A vertical line at a value of x."""

    at: float
    """Where."""
    label: str
    """Above the frame."""
    asymptote: bool
    """Whether curves grow without bound there; a heavier line then."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MetInterval(Record):
    """An interval in which the wanted margin is met."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    from_is: MetEnd
    """Why it begins there."""
    to_is: MetEnd
    """Why it ends there."""
    from_jumps_to: float | None
    """The margin outside of the beginning where it jumps; null where it is infinite, or does not jump."""
    to_jumps_to: float | None
    """The margin outside of the end where it jumps, likewise."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MobilitySummary(Record):
    """Degrees of freedom and determinacy."""

    body_coordinates: int
    """Coordinates of all bodies: 3 b."""
    constraints: int
    """Scalar constraints of the joints."""
    independent: int
    """How many of them are independent."""
    degrees_of_freedom: int
    """Motions that the joints leave."""
    determinate: bool
    """True if all constraints are independent, so that the reactions are determinate."""
    singular_position: bool
    """True if dependent constraints are so in this position only."""
    joints_in_excess: tuple[str, ...]
    """The joints among which the excess lies."""
    suggestion: str | None
    """Changes that would make the structure determinate."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ModeLimits(Record):
    """An interval in which a mode has a solution."""

    pattern: str
    """Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap."""
    signs: tuple[int, ...]
    """The pattern as numbers: 1 and -1 for the signs, 0 in a preload gap."""
    preload_gap: bool
    """Whether a contact rests in its preload gap."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint, as the mechanism lies in the model's state."""
    from_: float | None
    """Where it begins."""
    to: float | None
    """Where it ends."""
    from_is: ModeEndCause
    """Why it begins there."""
    to_is: ModeEndCause
    """Why it ends there."""
    from_at: tuple[str, ...]
    """The contacts or guided sliders that begin it."""
    to_at: tuple[str, ...]
    """The contacts or guided sliders that end it."""
    reactions: tuple[EndReaction, ...]
    """Limits of the normal force of each contact towards both ends."""
    orientation: int | None = None
    """With friction in hinges the sign of `det(I - H D)`, 1 or -1: solutions of one mode that merge in a fold
    have opposite ones, and the mechanism never settles where it is negative. Absent without."""
    hinge_forces: tuple[EndHingeForce, ...] = ()
    """Limits of the force of each hinge with friction towards both ends; absent without any."""
    speeds: tuple[SpeedLimits, ...]
    """Change of the speed of each coordinate that no drive moves, from value to value."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ModeMargin(Record):
    """By which factor all friction may grow before a mode ends."""

    factor: float | None = None
    """The factor; absent if the mode never ends."""
    ends_with: ModeEndCause
    """The cause of its end."""
    contacts: tuple[str, ...]
    """The contacts that end it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ModelSummary(Record):
    """A summary of a model."""

    title: str | None
    """Its title."""
    degrees_of_freedom: int
    """Degrees of freedom."""
    bodies: int
    """Number of bodies."""
    contacts: int
    """Number of contacts."""
    drives: int
    """Number of drives."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Named(Record):
    """A number with its name."""

    name: str
    """Its name."""
    value: float
    """J"""


@dataclass(frozen=True, eq=False, kw_only=True)
class OneFaceHint(Record):
    """A joint of two faces whose answer needs the face that the thing itself may not have."""

    joint: str
    """The joint."""
    contacts: tuple[str, ...]
    """Its contacts that need the other face; all of them where it jams."""
    reason: OneFaceReason
    """The reason why a second face is needed."""
    instead: str
    """The type of joint that may lift off."""
    words: str
    """In words."""


@dataclass(frozen=True, eq=False, kw_only=True)
class OpenRange(Record):
    """The least and the greatest value of a quantity over infinitely many solutions, each of which some solution
    has."""

    name: str
    """The contact, drive or coordinate."""
    unit: str
    """The unit of both values."""
    from_: float | None
    """The least value; null if it is unbounded."""
    to: float | None
    """The greatest value; null if it is unbounded."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Panel(Record):
    """A pair of axes and all that is drawn in them."""

    title: str
    """Above the panel; may be empty."""
    x: Axis
    """The horizontal axis."""
    y: Axis
    """The vertical axis."""
    zones: tuple[Zone, ...]
    """Hatched intervals of x, behind everything."""
    marked: tuple[MarkedValue, ...]
    """Vertical lines with labels above the frame."""
    bands: tuple[Band, ...]
    """Coloured stretches along the x axis, such as contact modes over time."""
    bars: tuple[Bar, ...]
    """Bars that stand side by side or on one another."""
    curves: tuple[Curve, ...]
    """Curves."""
    directed: bool
    """Whether arrowheads on the curves show the order of their points."""
    points: tuple[MarkedPoint, ...]
    """Points that are marked, above the curves."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PatternSummary(Record):
    """How many patterns had which outcome; all but `rejected` and the gap states add up to `total`."""

    total: int
    """2^r sign patterns."""
    solution: int
    """Patterns with a solution inside: every normal force differs from zero."""
    boundary: int
    """Patterns with a solution on their boundary: some normal force is zero."""
    no_solution: int
    """Patterns without a solution."""
    singular_without_solution: int
    """Patterns with a vanishing determinant and no solution."""
    singular_with_point: int
    """Patterns with a vanishing determinant and a single solution."""
    singular_with_continuum: int
    """Patterns with a vanishing determinant and a continuum of solutions."""
    undecided: int
    """Patterns that could not be decided within the limits of work."""
    rejected: int
    """Solutions and gap states that a guided slider rejects because it would tip."""
    gap_patterns: int
    """Patterns with gap states that were tried besides."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PeakEffort(Record):
    """Where an effort is greatest."""

    drive: int
    """The number of the drive."""
    at: float
    """The value of what is varied."""
    effort: float
    """The effort there (N or N m)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PhaseReport(Record):
    """A phase and its time span."""

    from_: float
    """Its start (s)."""
    to: float
    """Its end (s)."""
    mode: str
    """The mode: for each contact `+` or `-`, `0` in a preload gap, `=` where its joint sticks; then for each
    hinge with friction `+` or `-` for the sense in which its first body turns against the second, `=` where
    it sticks."""
    sliding: tuple[int, ...]
    """For each sliding joint the sign of its velocity, 0 where it sticks."""
    turning: tuple[int, ...] = ()
    """For each hinge with friction the sign of its angular velocity, 0 where it sticks."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PressFit(Record):
    """A contact with negative play: both of its faces are pressed unless the load exceeds the grip."""

    contact: str
    """The contact; its faces have this name and ".plus" or ".minus" behind it."""
    grip: float
    """`N_0 = k |play|` (N), with the stiffness `k` of one face: the sum of the forces on both faces as long as
    both are pressed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Question(Record):
    """A question, and whether the model can answer it."""

    name: str
    """The command that asks it: "solve" (and with it "limits", "size", "sweep", "map"), "drive", "hold",
    "simulate"."""
    ready: bool
    """True if nothing stands in its way."""
    findings: tuple[Finding, ...]
    """Everything for which it would be refused."""
    needs: tuple[str, ...]
    """Its needs in a few words, if that is little: "a rate"."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Range(Record):
    """All values from `least` to `greatest`; nothing where there is no bound."""

    least: float | None
    """The least value."""
    greatest: float | None
    """The greatest value."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RangeWithoutPosition(Record):
    """A range without an answer: the mechanism cannot be assembled or solved, or a guided slider is between its
    faces."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    reason: str
    """Why, at its first value that was tried."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RangeWithoutProblem(Record):
    """A range in which there is no mode problem."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    reason: str
    """Why: what is at fault in its middle."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RawContinuum(Record):
    """Infinitely many solutions: the unknowns of each part are in its set, independently of the other parts. NaN
    (`null` in JSON) is a nonzero value beyond the range of floating-point numbers, like that of a
    `BeyondRange`; its sign is that of the pattern."""

    pattern: str
    """"+", "-" or "0" for every unknown, as the `signs` of a solution inside the set: "0" is zero throughout, or
    in its gap, and "*" a free unknown that has both signs."""
    parts: tuple[ContinuumPart, ...]
    """Its parts: unknowns that vary together and, last, those that are fixed, if any."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RawGroup(Record):
    """A group of unknowns that was searched separately."""

    indices: tuple[int, ...]
    """Its unknowns, from 0."""
    method: str
    """The method, in words."""
    nodes: int
    """Nodes visited."""
    patterns: RawShares
    """The fractions of its patterns that were settled by each argument; they add up to 1."""
    proven: bool
    """Whether every exclusion and every outcome is proven."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class RawReport(_mixins.RawReport, Report):
    """All solutions of a raw problem."""

    _absent = {"within_rounding": None, "every_right_hand_side": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    type: RawKind
    """Type of the problem."""
    size: int
    """Number n of unknowns (of components in an equation of blocks; of pairs of them in a complementarity
    problem; of the pure strategies of both players in a game)."""
    status: Status
    """How many solutions there are; if the search ended early, how many were found."""
    complete: Proof
    """Whether the list of solutions is proven complete."""
    partial: bool
    """Whether the search ended before all possibilities were examined."""
    open: tuple[str, ...]
    """The questions that remain open, in words; empty if `complete` is `Proof::Proven`."""
    count: str
    """Number of solutions found that are not part of a continuum, as decimal text, because it may exceed any
    integer type. Gap states are not included."""
    gap_state_count: str
    """Number of states with an unknown in its preload gap that are not part of a continuum, nor of gap states
    whose shares vary, as decimal text."""
    continuum_count: str
    """Number of continua that are not part of larger ones, as decimal text."""
    within_rounding: WithinRounding | None
    """Whether there is a solution within rounding of the numbers; present only if there is none for the numbers
    themselves."""
    every_right_hand_side: EveryRightHandSide | None
    """Whether every right-hand side has exactly one solution, if requested: `RawProblem::every_right_hand_side`."""
    solutions: tuple[RawSolution, ...]
    """The solutions that are not part of a continuum, up to the requested number."""
    gap_states: tuple[RawSolution, ...]
    """States with an unknown in its preload gap, up to the requested number (theory, section 3)."""
    continua: tuple[RawContinuum, ...]
    """Infinite sets of solutions that are not part of larger ones, up to the requested number."""
    strategy: str
    """How they were found: groups of unknowns and methods, in words."""
    nodes: int
    """Number of nodes visited by the search."""
    groups: tuple[RawGroup, ...]
    """The groups of unknowns that were searched separately."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RawShares(Record):
    """Fractions of the patterns of a group; they add up to 1."""

    uniqueness: float
    """Excluded by a proof that there is exactly one solution."""
    cells: float
    """Excluded because they are not cells of a hyperplane arrangement."""
    propagation: float
    """Excluded by interval propagation."""
    relaxation: float
    """Excluded by a linear relaxation."""
    faces: float
    """Not solved one by one, because all their solutions are those of another pattern."""
    examined: float
    """Solved one by one."""
    unexplored: float
    """Not settled."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RawSolution(Record):
    """One solution, or one state with an unknown in its gap."""

    signs: tuple[int, ...]
    """Sign of every `z_k - w_k`, `x_k` (of blocks, too: component by component, and 0 where the sign is not
    certain) or `N_k`; 0 where it vanishes. With two bounds: -1 where `z_k = l_k`, 1 where `z_k = u_k`, 0
    between, and for free and fixed `z_k`. Of a mixed problem, the signs of `u` come first. Of a game: for the
    pure strategies of both players, 1 if it is played, 0 if it is another best response, -1 if not."""
    on_boundary: bool
    """Whether the solution is on the boundary between patterns: both unknowns of a pair vanish, or an unknown
    whose coefficients depend on its sign, outside a gap. A free unknown that is zero is on no boundary. Of
    blocks: whether some block may be zero."""
    enclosure_radius: float | None = None
    """Maximum distance of the unknowns that have a number from the exact solution for the given numbers; absent
    if it was not determined."""
    residual: float | None = None
    """The residual of the problem's equations, relative to the largest sum of sizes of terms in an equation;
    absent if an unknown has no value at all."""
    beyond_range: tuple[BeyondRange, ...] = ()
    """Unknowns that exist but have no floating-point number; their value is `null`."""
    gaps: tuple[GapShare, ...] = ()
    """Unknowns in their gap."""
    shares_vary: bool = False
    """Whether the shares in `gaps` are those of one of many states whose values are otherwise equal."""
    z: NDArray[np.float64] | None = None
    """`z`."""
    w: NDArray[np.float64] | None = None
    """`w`."""
    u: NDArray[np.float64] | None = None
    """`u`, the free unknowns."""
    x: NDArray[np.float64] | None = None
    """`x`; of a game, the probabilities of the rows, the first player's strategies."""
    y: NDArray[np.float64] | None = None
    """`y_k = |N_k|`; of a game, the probabilities of the columns, the second player's strategies."""
    payoff_1: float | None = None
    """The first player's payoff, which depends on `y`."""
    payoff_2: float | None = None
    """The second player's payoff, which depends on `x`."""
    normal_forces: NDArray[np.float64] | None = None
    """Signed normal forces `N_k = sigma_k y_k`."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Reactions(Record):
    """Ranges of reactions."""

    contacts: tuple[ContactRange, ...]
    """Of the contacts."""
    hinges: tuple[HingeRange, ...]
    """Of the hinges."""
    drives: tuple[DriveRange, ...]
    """Of the drives that hold."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Rejection(Record):
    """A solution of the equations that is none of the mechanism."""

    pattern: str
    """Its pattern."""
    joint: str
    """The guided slider that would tip."""
    couple: float
    """The couple it would need (N m)."""
    limit: float
    """The greatest couple that its pressure gives: |N| L / 2 (N m)."""
    normal_forces: NDArray[np.float64]
    """Normal forces of all contacts (N)."""
    friction_forces: NDArray[np.float64]
    """Friction forces of all contacts, positive against positive sliding (N)."""
    couples: NDArray[np.float64]
    """Couples of all contacts about the middle of the pressed face, 0 of those that have none (N m)."""
    efforts: NDArray[np.float64]
    """Efforts of all drives (N or N m)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Release(Record):
    """A state in which the mechanism begins to move."""

    joints: tuple[JointRelease, ...]
    """What each sliding joint does."""
    patterns: tuple[str, ...]
    """The sign patterns of the normal forces with which it is possible; 0 for a contact in its gap, or open."""
    gaps: tuple[GapRange, ...] = ()
    """The contacts that lift off; absent if none does."""
    coordinates: tuple[CoordinateRange, ...]
    """Accelerations of the chosen coordinates."""
    reactions: Reactions
    """Reactions."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class RestLimitsReport(_mixins.RestLimitsReport, Report):
    """For which values a mechanism can stay at rest."""

    _absent = {"load": None}

    schema: str
    """Version of this layout: `REST_SCHEMA`."""
    title: str | None
    """The title of the model."""
    vary: VariedQuantity
    """Varied quantity, with its range."""
    state: tuple[CoordinateValue, ...]
    """The coordinates for which it holds, but for one that is varied."""
    load: str | None
    """The load that was named, if one was: with its present magnitude, the effort of a drive with none."""
    spans: tuple[SpanOfRest, ...]
    """The stretches, one after another."""
    guarantee: str
    """Account, in words, of what may have been missed."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RoundEnd(Record):
    """An end of a block on a round rod. Among the contacts it has two parts, along n and along z."""

    name: str
    """"joint.front" or "joint.rear", or with the name of a support."""
    normal_force: float
    """The force of the rod on the block across it (N)."""
    direction: float
    """Where that pushes the block: an angle from n towards z (rad)."""
    friction_force: float
    """Friction force, positive against positive sliding (N)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sample(Record):
    """The margin at a value."""

    at: float
    """The value."""
    is_: SampleKind
    """Whether the margin is a number there, and if not, why."""
    margin: float | None
    """The margin; null unless it is a number."""
    least_friction: float | None = None
    """Where it needs friction: as a factor of its own, the friction below which it tips or jams; absent
    elsewhere."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SampledReport(Record):
    """Rest that was not proven, but checked at four times in each step."""

    time: float
    """Total duration (s)."""
    longest_step: float
    """The longest step (s)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Series(Record):
    """A motion as a table."""

    columns: tuple[Column, ...]
    """The numbers; the first column is the time."""
    modes: tuple[str, ...]
    """The contact mode of each row, as the pattern of its phase."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SimulateReport(Report):
    """A motion in time."""

    _absent = {"hinges": (), "steps_from_drawing": None, "samples": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    model: ModelSummary
    """Summary of the model."""
    contacts: tuple[str, ...]
    """The names of the contacts, in the order of their signs in modes."""
    hinges: tuple[str, ...]
    """The names of the hinges with friction, whose signs follow those of the contacts in modes."""
    tolerance: float
    """Relative error permitted for each step."""
    start: float
    """When it begins (s)."""
    until: float
    """When it was requested to end (s)."""
    stop: float
    """When it actually ends (s)."""
    initial: tuple[CoordinateState, ...]
    """Coordinates and rates at the start."""
    steps_from_drawing: int | None
    """Number of steps in which the initial positions were followed from the drawing, each step proven to stay on
    its assembly branch; absent if the positions are those of the drawing."""
    last: tuple[CoordinateState, ...]
    """Coordinates and rates at the end."""
    events: tuple[EventReport, ...]
    """What happened, in chronological order."""
    phases: tuple[PhaseReport, ...]
    """The phases, in chronological order."""
    end: EndReport
    """How it ends."""
    hints: tuple[str, ...]
    """Suggestions for a better model, in words."""
    energy: EnergyReport
    """Where the energy went."""
    position_drift: float
    """The greatest violation of the joints before each projection: of positions, in sizes of the mechanism or
    rad."""
    velocity_drift: float
    """The same for velocities, per second."""
    statistics: StatisticsReport
    """Computational cost."""
    samples: Series | None
    """The motion as a table, if requested."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SizeReport(_mixins.SizeReport, Report):
    """For which values a wanted margin is met."""

    _absent = {"load": None, "tipping": None, "tips": (), "wedged": None, "gently": False}

    schema: str
    """Version of this layout: `SCHEMA`."""
    title: str | None
    """The title of the model."""
    vary: VariedQuantity
    """Varied quantity, with its range."""
    state: tuple[CoordinateState, ...]
    """The coordinates for which it holds, but for one that is varied; at rest their rates are taken as zero."""
    against: MarginKind
    """Which margin is meant."""
    load: str | None
    """The load, drive or contact that it concerns; absent against locking, and where it concerns all of them."""
    margin: float
    """The wanted margin; against an effort, normal force, bearing pressure or efficiency the limit that it has
    to keep."""
    unit: str
    """SI unit of the limit, empty for a pure number."""
    both_directions: bool
    """Whether the smaller margin of both directions of motion counts."""
    present: Sample
    """The margin in the model."""
    tipping: Tipping | None
    """Guided sliders that tip in the model, if there is no solution for that reason; absent otherwise."""
    tips: tuple[str, ...]
    """Against locking: what tips in the model at its margin, or as it is, or with less friction; absent if
    nothing does."""
    wedged: float | None
    """The margin of holding in the model while something has wedged it, if that is greater than the one by
    itself, which is wanted; absent otherwise."""
    gently: bool
    """Whether to be let down gently is all that takes: nothing presses the guides only while it slides."""
    met: tuple[MetInterval, ...]
    """The intervals in which the wanted margin is met, in ascending order."""
    without_position: tuple[RangeWithoutPosition, ...]
    """Ranges in which the mechanism cannot be assembled or solved, the model does not allow the values, or a
    guided slider is between its faces, which is no locking."""
    samples: tuple[Sample, ...]
    """The margin at evenly spaced values, and where the wanted one is just met."""
    guarantee: str
    """Account, in words, of what the search can miss."""
    narrowest: float
    """Two steps of what was tried: narrower ranges could be missed (unit of what is varied)."""
    conclusion: tuple[str, ...]
    """Sentences that sum up the answer."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class Solution(_mixins.Solution, Record):
    """One solution, or one state of a preload gap."""

    pattern: str
    """Its pattern: "+" and "-" for the signs of the normal forces, "0" in a preload gap."""
    patterns: tuple[str, ...]
    """The patterns that were examined and give this same solution: on a boundary more than one, all of them if
    every pattern was tried (`patterns` of the report)."""
    rests: bool = False
    """Whether it stays at rest, as `hold` says of it: every contact sticks, and no coordinate moves or begins to
    move."""
    signs: tuple[int, ...]
    """Sign of each normal force, 0 where it vanishes."""
    on_boundary: bool
    """True if some contact is about to change side: its normal force is zero within rounding."""
    floating: tuple[str, ...] = ()
    """Contacts of redundant guides without normal force that do not settle where the block is within its play:
    it floats."""
    certificate: CertificateKind
    """The kind of its proof."""
    margin: ModeMargin | None = None
    """By which factor all friction may grow before the mode ends; absent if not computed, or if it ends at once."""
    determinant: float
    """Determinant D of the mode's equations, eq. (6)."""
    oriented_determinant: float
    """D times the product of the signs; positive without friction (theory, section 5). Of redundant guides the
    mean of those of their determinate parts, 1 without friction (theory, eq. (R4))."""
    attainability: Attainability
    """The verdict on whether a mechanism with slightly elastic guides settles on it."""
    contacts: tuple[Contact, ...]
    """The contacts, in the order of the model."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""
    hinges: tuple[Hinge, ...]
    """The hinge forces."""
    round_ends: tuple[RoundEnd, ...] = ()
    """The ends of blocks on round rods; absent without."""
    carried: tuple[Carried, ...] = ()
    """What joints carry out of the drawing, and the friction of their collars; absent of a planar model."""
    bodies: tuple[Body, ...]
    """The accelerations of the bodies."""
    coordinates: tuple[CoordinateAcceleration, ...]
    """The accelerations of the chosen coordinates."""
    friction_exceeds_loads: bool
    """True if it is proven that the loads and weights push the motion and friction takes more power than they
    give; never with drives."""
    drives: tuple[Drive, ...]
    """The efforts of the drives."""
    residual: float
    """Greatest relative residual of a body's force and moment balance, recomputed independently."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SolveReport(_mixins.SolveReport, Report):
    """All solutions of the kinetic problem of a mechanism in one state."""

    _absent = {"at_rest": (), "every_load_has_one_state": None, "steps_from_drawing": None, "patterns": None, "undetermined": None, "jam_impulses": None, "margins": None, "margins_missing": None, "unique_at_least": None, "from_rest": None, "one_face_hints": (), "sharing": None, "uncertainty": None}

    schema: str
    """Version of this layout: `SCHEMA`."""
    status: Status
    """How many solutions there are; of those that were found if the search ended early."""
    complete: Proof
    """Proof that these are all solutions of the mechanism, rounding included."""
    partial: bool
    """True if the search ended before every possibility was dealt with."""
    open: tuple[str, ...]
    """The open questions, in words; empty if `complete` is `Proof::Proven`."""
    count: str
    """Number of solutions, as decimal text: it may be beyond any integer type, and more than are listed."""
    gap_state_count: str
    """Number of preload-gap states, likewise."""
    strategy: str
    """How the solutions were found: groups of contacts and methods, in words."""
    nodes: int
    """Nodes of the search that were visited."""
    model: ModelSummary
    """A summary of the model."""
    state: tuple[CoordinateState, ...]
    """The state: chosen coordinates and their rates."""
    rates_not_given: tuple[str, ...]
    """The coordinates whose rates the model does not give: they are taken as zero."""
    at_rest: tuple[str, ...]
    """The joints that may lift off and do not slide in the state: each solution says how they start. Absent if
    there are none."""
    every_load_has_one_state: bool | None
    """Whether every load has exactly one state, where contacts that may lift off rest and nothing slides. Absent
    elsewhere."""
    time: float
    """Time of the state (s)."""
    steps_from_drawing: int | None
    """In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    branch; absent if they are those of the drawing."""
    patterns: PatternSummary | None
    """The outcome of all sign patterns; absent if there are so many that not each was tried by itself."""
    solutions: tuple[Solution, ...]
    """The solutions, in the order of their patterns."""
    preload_gap_states: tuple[Solution, ...]
    """States with a contact between its faces, in which the preload friction acts (theory, section 3)."""
    continua: tuple[Continuum, ...]
    """Modes with a vanishing determinant that admit infinitely many solutions."""
    undetermined: Undetermined | None
    """Between which values the forces and the motion of these lie; absent if there are none, and where it is not
    known."""
    undecided_modes: tuple[UndecidedMode, ...]
    """Modes on the boundary within rounding: whether they have a solution cannot be decided."""
    locked_modes: tuple[LockedMode, ...]
    """Modes with a vanishing determinant that admit none: these modes are locked. Only where every pattern was
    tried."""
    rejected: tuple[Rejection, ...]
    """Solutions of the equations that a guided slider rejects, because it would tip."""
    closest_modes: tuple[ClosestMode, ...]
    """Where there is no solution: the modes with the smallest determinants. Only where every pattern was tried."""
    jammed_groups: tuple[tuple[str, ...], ...]
    """Where there is no solution: groups of contacts that admit none, whatever the others do."""
    jam_impulses: tuple[JamImpulse, ...] | None
    """Where there is no solution while contacts that may lift off slide: the impulses without collision that can
    act instead, of which none may be possible where drives prescribe the motion. Absent elsewhere, where they
    are not known, and where margins are not asked for."""
    margins: Margins | None
    """By which factors all friction may grow; absent if that was not computed."""
    margins_missing: MarginsMissing | None
    """Why there are no margins; absent where there are, and where they were not asked for."""
    unique_at_least: float | None
    """With friction in hinges: all friction may grow at least by this factor while every load is proven to have
    exactly one solution. A lower bound: beyond it nothing is known. Absent without friction in hinges, where
    it is not proven, and where margins were not asked for."""
    from_rest: FromRest | None
    """Where some coordinate slows down: what the same loads do from rest in the same position; absent where it
    was not asked (margins are not, drives prescribe the motion)."""
    one_face_hints: tuple[OneFaceHint, ...]
    """The joints of two faces of which a solution, or the jam, needs the one that the thing itself may not have.
    Absent if there are none."""
    sharing: LoadSharing | None
    """How redundant guides share their load; absent if no constraint is redundant."""
    uncertainty: Uncertainty | None
    """The results that hold for all values of parameters known within bounds; absent if there are none.
    Everything else in the report holds for the middle of their ranges."""
    influence: InfluenceSummary
    """Accelerations and normal forces without friction, and the influence coefficients."""
    condition: float
    """Greatest factor by which rounding in the kinetic equations may be amplified."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SpanOfRest(Record):
    """A stretch with one answer."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    holds: bool | None
    """Whether it can stay at rest; null where that was not decided, and where there is no answer."""
    may_slip: bool = False
    """Whether it can also begin to slide: it rests only where something wedged it before. Absent if not."""
    reason: str | None = None
    """Why there is no answer, if there is none."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SpeedLimits(Record):
    """An interval of a mode in which the speed of a coordinate changes one way."""

    coordinate: str
    """The coordinate."""
    from_: float
    """Where it begins."""
    to: float
    """Where it ends: where the acceleration vanishes, or the mode ends."""
    speed: SpeedChange
    """Change of its speed in the interval."""
    friction_exceeds_loads: bool
    """Whether it is proven somewhere in the interval that the loads push the motion and friction takes more
    power than they give; never with drives."""


@dataclass(frozen=True, eq=False, kw_only=True)
class StatisticsReport(Record):
    """Cost of a simulation."""

    steps: int
    """Steps that were accepted."""
    repeated: int
    """Steps that were repeated with a shorter length."""
    evaluations: int
    """Evaluations of the equations."""
    events: int
    """Events."""
    sampled: SampledReport | None = None
    """Unproven rest under loads that vary with time, if there is any."""


@dataclass(frozen=True, eq=False, kw_only=True)
class StiffnessRatios(Record):
    """The contact modes for stiffnesses of a tenth to ten times those of the model, contact by contact."""

    tried: int
    """How many combinations of 1/10, 1 and 10 were tried, in rounded numbers; beyond four contacts they are a
    sample of all."""
    same: bool
    """True if each has the same contact modes as the model."""
    others: tuple[str, ...]
    """The other contact modes that were met: one sign or 0 for each contact."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Stopping(Record):
    """When and where a coordinate stops if its acceleration stays as it is."""

    time: float
    """The time until then: t = |v|/|a| (s)."""
    distance: float
    """The way until then: v^2 / (2 |a|) (m or rad)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tally(Record):
    """Numbers of points, rows and kinds of outcome, so far."""

    points: int
    """Points, inserted ones included."""
    breakpoints: int
    """Inserted points."""
    rows: int
    """Rows."""
    statuses: Mapping[PointStatus, int]
    """Points by what became of them; inserted ones are left out."""
    solutions: Mapping[int, int]
    """Points by their number of solutions; inserted ones are left out, and those of `rests`."""
    rests: Mapping[PointStatus, int]
    """Points at which it stays at rest in every state, by what became of them; inserted ones are left out."""
    tipping: int
    """Points without a solution because a guided slider tips; inserted ones are left out."""
    tips: int
    """Points at which a block tips in every state; inserted ones are left out."""
    boundary_rows: int
    """Rows on the boundary between modes."""
    refusals: Mapping[PointStatus, tuple[int, str]]
    """The first point of each kind that was not solved, and why."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Theme(Record):
    """Colours of a picture, as CSS colours."""

    background: str
    """Behind everything."""
    ink: str
    """Text, axes, outlines."""
    muted: str
    """Grid lines, dimensions, what matters less."""
    body: str
    """The insides of bodies."""
    reaction: str
    """Reactions."""
    friction: str
    """Friction."""
    warning: str
    """Warnings: locking, jams."""
    series: tuple[str, ...]
    """Branches, modes and areas, in the order in which they are given out."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Threshold(Record):
    """The static friction from which on the load alone, however great, is held, or all loads as they are, or
    guides wedge."""

    varied: str
    """What is varied: "static friction" for a factor on every static coefficient, or the name of a parameter."""
    present: float
    """Its value in the model: 1 for the factor."""
    value: float | None
    """Where the threshold lies: self-locking, or wedged, from this value on, free below it; 0 if friction is not
    needed, nothing if no friction suffices."""
    undecided: int
    """Patterns of contact sides in which that was not decided: with them it may lie lower, or there may be one."""
    coefficients: tuple[Coefficients, ...]
    """Static coefficients of every contact at the threshold."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tipping(Record):
    """The guided sliders that tip where there is no solution: a guided slider has no state in which it is
    tipped."""

    joints: tuple[str, ...]
    """The guided sliders that would tip in a solution of the equations: as block sliders they show whether it
    moves."""
    throughout: bool
    """True if there is such a solution wherever that was asked: then friction does not lock it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TippingLimit(Record):
    """The friction from which on something tips, or below which."""

    factor: float
    """As a factor of that of the model."""
    joints: tuple[str, ...]
    """The joints that tip; none where it jams."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TippingRange(Record):
    """The factors of friction between which something tips."""

    from_: float | None = None
    """Absent if it tips down to no friction."""
    to: float | None = None
    """Absent if it tips however great the friction is."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TipsOver(Record):
    """A range in which joints tip in every state."""

    from_: float
    """Its lower end, a value of what is varied."""
    to: float
    """Its upper end."""
    joints: tuple[str, ...]
    """The joints."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class TreeReport(_mixins.TreeReport, Report):
    """The report of all motions."""

    schema: str
    """Version of this layout."""
    complete: bool
    """Whether these are all motions."""
    histories: tuple[BranchingReport, ...]
    """The motions."""


@dataclass(frozen=True, eq=False, kw_only=True)
class UncertainMode(Record):
    """A mode that exists for some values of the uncertain parameters, or perhaps does."""

    pattern: str
    """Its pattern."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""
    persistence: Persistence
    """For which values it has a solution."""
    normal_force_bounds: NDArray[np.float64] | None = None
    """Proven bounds of the normal force of each contact, where the mode exists (N); absent where there are none,
    or some values could not be decided."""


@dataclass(frozen=True, eq=False, kw_only=True)
class UncertainParameter(Record):
    """A parameter that is known within bounds."""

    name: str
    """Its name."""
    from_: float
    """Its lower bound (SI units)."""
    to: float
    """Its upper bound."""
    value: float
    """The value for which the rest of the report holds: the middle."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Uncertainty(Record):
    """Results for all values of parameters that are known within bounds only."""

    parameters: tuple[UncertainParameter, ...]
    """The parameters and their bounds."""
    least_solutions: int
    """For every value there are at least so many solutions."""
    most_solutions: int | None = None
    """For every value there are at most so many solutions; absent if that could not be proven."""
    proven_counts: tuple[int, ...]
    """The numbers of solutions that are proven for some values each, in ascending order."""
    stretches: tuple[CountStretch, ...]
    """The number of solutions along the parameter, in ascending order of its values; empty with several
    parameters."""
    modes: tuple[UncertainMode, ...]
    """The modes that exist for some value, and those of which that could not be ruled out."""
    parts: int
    """The parts into which the ranges were divided."""
    open: tuple[str, ...]
    """Why parts of the ranges could not be searched; empty if all were."""


@dataclass(frozen=True, eq=False, kw_only=True)
class UndecidedMode(Record):
    """A mode whose outcome is not decided within the bounds of the mechanism's numbers."""

    pattern: str
    """Its pattern."""
    joints: tuple[JointMode, ...]
    """The contact mode of each sliding joint."""
    contacts: tuple[str, ...]
    """The contacts whose normal force may be zero; none if the determinant may."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Undetermined(Record):
    """The quantities that infinitely many solutions leave open, and their ranges."""

    sharing: tuple[str, ...]
    """The joints whose share of a load is open."""
    friction: tuple[OpenRange, ...] = ()
    """The friction of contacts and hinges that stand still while the rest moves."""
    efforts: tuple[OpenRange, ...]
    """The efforts of the drives."""
    accelerations: tuple[OpenRange, ...]
    """The accelerations of the coordinates."""
    normal_forces: tuple[OpenRange, ...]
    """The normal forces of the contacts."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Unlocking(Record):
    """The friction below which a mechanism that is locked would move."""

    factor: float
    """As a factor of that of the model, below 1."""
    mu: float | None = None
    """The coefficient itself; absent where contacts with friction differ in theirs."""


@dataclass(frozen=True, eq=False, kw_only=True)
class VariedQuantity(Record):
    """Varied quantity, in SI units."""

    name: str
    """Its name."""
    unit: str
    """Its unit; empty where there is none, or none is known."""
    from_: float
    """Where the range begins."""
    to: float
    """Where it ends."""
    value: float
    """Its value in the model."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WarningPlace(Record):
    """Where a warning lies."""

    source: str
    """"model" for the model file, "setting" for a setting such as `--set`."""
    from_: int
    """Its first byte in that text."""
    to: int
    """The byte behind it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WarningReport(Record):
    """A warning as a report tells it."""

    kind: str
    """Its kind: "bare_angle", "bare_number", "lengths_far_apart", "length_towers", "gap_closed",
    "far_from_drawing", "great_friction", "great_gravity", "wide_friction_circle", "bare_corner",
    "behind_face", "no_loads" or "nothing_presses"."""
    place: WarningPlace | None
    """Where it lies; null where it concerns the input as a whole."""
    message: str
    """Message: what is perhaps not meant."""
    hint: str
    """Hint on what to do about it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Wedging(Record):
    """Whether redundant guides can be wedged: pressed against each other without any load, however hard."""

    possible: bool
    """Whether they can with the friction of the model: then nothing bounds the loads that it can hold."""
    threshold: Threshold
    """From which static friction on they can."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WithinRounding(Record):
    """Solutions for numbers that differ from the given ones only by rounding."""

    relative: float
    """Every number may differ by this fraction of its size."""
    answer: WithinRoundingAnswer
    """Whether such numbers have a solution."""
    z: NDArray[np.float64] | None = None
    """`z`."""
    w: NDArray[np.float64] | None = None
    """`w`."""
    u: NDArray[np.float64] | None = None
    """`u`, the free unknowns."""
    x: NDArray[np.float64] | None = None
    """`x`; of a game, the probabilities of the rows, the first player's strategies."""
    y: NDArray[np.float64] | None = None
    """`y_k = |N_k|`; of a game, the probabilities of the columns, the second player's strategies."""
    payoff_1: float | None = None
    """The first player's payoff, which depends on `y`."""
    payoff_2: float | None = None
    """The second player's payoff, which depends on `x`."""
    normal_forces: NDArray[np.float64] | None = None
    """Signed normal forces `N_k = sigma_k y_k`."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Zone(Record):
    """A hatched interval of x."""

    from_: float
    """Where it begins."""
    to: float
    """Where it ends."""
    hatching: Hatching
    """How it is hatched."""
    meaning: str
    """Its meaning, for the legend."""


HINTS: Final[Mapping[str, Mapping[str, str]]] = {
    "Attainability": {"eigenvalues": "pairs"},
    "ClosestMode": {"absolute_normal_forces": "array"},
    "Column": {"values": "array"},
    "Continuum": {"vertices": "arrays", "directions": "arrays"},
    "CountLimits": {"proven": "pairs"},
    "CoupleRange": {"couples": "array"},
    "CourseRow": {"efforts": "array", "frictionless": "array"},
    "Curve": {"points": "pairs"},
    "Direction": {"between_faces_at": "array"},
    "DrawnLine": {"points": "pairs", "markers": "pairs"},
    "DriveSolution": {"efforts": "array"},
    "DrivenMotion": {"efforts": "array", "accelerations": "array"},
    "Frictionless": {"efforts": "array"},
    "HeldFriction": {"at": "array", "along": "array"},
    "InfluenceSummary": {"coordinate_accelerations": "array", "normal_forces": "array", "eta_positive": "arrays", "eta_negative": "arrays"},
    "JointSummary": {"gaps": "array"},
    "LimitsReport": {"between_faces_at": "array"},
    "RawReport": {"within_rounding": "WithinRounding", "solutions": "RawSolution", "gap_states": "RawSolution"},
    "RawSolution": {"z": "array", "w": "array", "u": "array", "x": "array", "y": "array", "normal_forces": "array"},
    "Rejection": {"normal_forces": "array", "friction_forces": "array", "couples": "array", "efforts": "array"},
    "UncertainMode": {"normal_force_bounds": "pairs"},
    "WithinRounding": {"z": "array", "w": "array", "u": "array", "x": "array", "y": "array", "normal_forces": "array"},
}
"""Lists of numbers that are arrays, and classes whose name serialization does not tell, by class and field."""
