"""Uses of everything public, for type checkers: `mypy tests/typed_examples.py` finds nothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import slideway
from slideway import GROUND, Fault, Mechanism, Model, ModelError, Motion, Sweep, gallery_models, modes, reports

names: dict[str, str] = gallery_models() | slideway.templates()
model: Model = Model.gallery("drawer")
model = Model.parse(model.text)
model = model.with_(mu=0.5, L="450 mm", at={"x": 0}, rate={"x": "1 m/s"}, time=0, units="mm")
try:
    drawing: str = slideway.import_dxf("none.dxf", unit="mm")
    Model.load("none.toml")
except ModelError as error:
    faults: tuple[Fault, ...] = error.faults
except OSError:
    pass


def progress(fraction: float | None, done: int, counted: str) -> None:
    print(fraction, done, counted)


answer: reports.SolveReport = model.solve(margins=False, max_solutions=3, time_limit=1.0, progress=progress)
status: reports.Status = answer.status
for solution in answer:
    forces: NDArray[np.float64] = solution.normal_forces
    first: float = solution.contacts[0].normal_force
bushing: Model = Model.template("drawer", L="500 mm", mu=0.2)
page: slideway.Page = model.report(mu=(0, 1), time_limit=60.0)
html: str = page.html
limits: reports.LimitsReport = model.limits("mu", 0, "1", quantity="friction")
limits = model.limits(mu=(0, np.float32(1)), max_reaction=np.float32(2), effort=10)
first_solution: reports.Solution = answer[0]
rest_of_them: tuple[reports.Solution, ...] = answer[1:]
said: str = answer.answer
value: float = model.values["mu"]
unit: str = model.values["mu"].unit
model = model.with_(mu=np.float32(0.5))
check: reports.CheckReport = model.check()
hold: reports.HoldReport = model.hold("resistance", drives="hold")
rest: reports.RestLimitsReport = model.rest_limits(friction=(0, 1))
size: reports.SizeReport = model.size("mu", 0.1, 1, margin=2)
drive: reports.DriveReport = model.drive("mu", (0, 1), rows=3)
plane: reports.MapReport = model.map(mu=(0, 1), L=("0.3 m", "0.5 m"), size=(4, 4))
motion: Motion = model.simulate("10 ms", branches=[1])
tree: reports.TreeReport = model.simulate(0.01, all_branches=3)
state: NDArray[np.float64] = motion.sol([0.0, 0.01])
sweep: Sweep = model.sweep(mu=np.linspace(0, 1, 5), L=["300 mm", "400 mm"])
column: NDArray[np.float64] = sweep["mu"]
raw: reports.RawReport = modes.lcp([[1.0]], np.array([1.0]), uniqueness=True)

mechanism = Mechanism("Drawer", gravity=9.81)
mu: str = mechanism.parameter("mu", 0.3)
drawer: str = mechanism.body("drawer", mass=2, centre=(0, 0.1), inertia=0.05, outline=[(0, 0), (1, 0), (1, 1)])
rail: str = mechanism.block_slider(
    "rail", drawer, GROUND, at=(0, 0), length=0.4, mu={"plus": 0.1, "minus": mu}, front={"mu": 0.2}
)
mechanism.spring("spring", (drawer, (0, 0)), (GROUND, (1, 0)), stiffness="10 N/m")
mechanism.slide("x", rail, rate=1)
built: Model = mechanism.build()
text: str = mechanism.to_toml() + slideway.__version__
