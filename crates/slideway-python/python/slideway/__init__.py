"""All solutions of planar mechanisms with dry friction in sliding joints.

In a mechanism with dry friction in its sliding joints the equations of motion can have no solution (it jams), one, or
several. This package finds all of them, with their contact modes.

>>> import slideway
>>> model = slideway.Model.gallery("drawer")
>>> answer = model.solve()
>>> answer.status
'one'
>>> answer.solutions[0].normal_forces
array([ 27.27..., -27.27...])
>>> model.with_(mu=1.2).solve().status
'none'

Numbers are in SI units; a text may have a unit or be an expression of parameters: `model.with_(L="450 mm")`.
Arrays cannot be written to. "No solution" is an answer, never an exception; `ModelError` has all that is wrong with a
model.
"""

from . import modes, plotting, reports
from ._display import Animation, Drawing, Page
from ._errors import Fault, ModelError
from ._motion import Motion
from ._slideway import GROUND, Mechanism, Model, gallery_models, import_dxf, merge, templates
from ._sweep import Sweep

__all__ = [
    "GROUND",
    "Animation",
    "Drawing",
    "Fault",
    "Mechanism",
    "Model",
    "ModelError",
    "Motion",
    "Page",
    "Sweep",
    "gallery_models",
    "import_dxf",
    "merge",
    "modes",
    "plotting",
    "reports",
    "templates",
]
__version__ = "0.1.0"
