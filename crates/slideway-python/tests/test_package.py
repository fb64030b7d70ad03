"""The package as a whole: its version, and that everything it gives can be sent to another process."""

from __future__ import annotations

import dataclasses
import inspect
import pickle
import tomllib
from typing import Any

import pytest
import slideway
import slideway.dask
from conftest import WORKSPACE
from slideway import Model
from slideway._answer import Record

MODULES = (slideway, slideway.dask, slideway.modes, slideway.plotting, slideway.reports)


def test_the_version_is_that_of_the_workspace() -> None:
    manifest = tomllib.loads((WORKSPACE / "Cargo.toml").read_text())
    assert slideway.__version__ == manifest["workspace"]["package"]["version"]


def public_classes() -> set[type]:
    return {thing for module in MODULES for name in module.__all__ if inspect.isclass(thing := getattr(module, name))}


def examples() -> dict[type, Any]:
    """One of each class."""
    drawer = Model.gallery("drawer")
    mechanism = slideway.Mechanism("A mechanism")
    mechanism.parameter("mu", 0.3)
    motion = drawer.simulate("0.01 s")
    with pytest.raises(slideway.ModelError) as caught:
        drawer.with_(my=0.5)
    made = (
        drawer.with_(mu=0.2),
        mechanism,
        motion,
        drawer.sweep(mu=[0.1, 0.2]),
        drawer.draw(),
        drawer.report(),
        motion.animate(),
        caught.value,
        caught.value.faults[0],
    )
    reports = [cls for cls in public_classes() if cls.__module__ == slideway.reports.__name__]
    parts = (cls(**{field.name: "x" for field in dataclasses.fields(cls)}) for cls in reports)
    return {type(each): each for each in (*made, *parts)}


def test_objects_of_all_public_classes_can_be_pickled() -> None:
    given = examples()
    assert set(given) == public_classes(), "a class without an example here"
    for cls, each in given.items():
        again = pickle.loads(pickle.dumps(each))
        assert type(again) is cls, cls
        assert again == each if isinstance(each, Record) else repr(again) == repr(each), cls
        for text in ("svg", "html"):
            assert getattr(again, text, None) == getattr(each, text, None), cls
