"""Models: where they come from, how they are changed, kept and compared."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import MODELS

import slideway
from slideway import Model, ModelError


@pytest.mark.parametrize("name", MODELS)
def test_a_file_is_its_text(tmp_path: Path, name: str) -> None:
    model = Model.gallery(name)
    path = tmp_path / "model.toml"
    path.write_text(model.text)
    assert Model.load(path) == Model.load(str(path)) == Model.parse(model.text) == model


def test_what_a_model_has() -> None:
    model = Model.gallery("drawer").with_(mu=0.5, x="0.1 m", rate={"x": 1}, time=2)
    assert "mu" in model.parameters
    assert model.coordinates == ["x"]
    assert model.title
    assert model.settings == ["mu=0.5", "at x=0.1 m", "rate x=1", "time=2"]
    assert repr(model) == f"<slideway.Model: {model.title}, with mu=0.5, at x=0.1 m, rate x=1, time=2>"


def test_changes_add_up_and_leave_the_model() -> None:
    model = Model.gallery("drawer")
    changed = model.with_(mu=0.5).with_(L="450 mm")
    assert model.settings == []
    assert changed == model.with_(mu=0.5, L="450 mm")
    assert changed.with_(mu=0.7) != changed


def test_numbers_of_numpy() -> None:
    model = Model.gallery("drawer")
    for number in (np.float64(0.5), np.float32(0.5), np.array(0.5)):
        assert model.with_(mu=number) == model.with_(mu=0.5)
    assert model.with_(mu=np.int64(1)).solve() == model.with_(mu=1).solve()


def test_equality_and_hash() -> None:
    model = Model.gallery("drawer")
    same, other = Model.gallery("drawer"), Model.gallery("wedge")
    assert model == same and hash(model) == hash(same) and model != other
    assert model != "drawer" and model != None  # noqa: E711
    assert model.with_(mu=0.5) != model.with_(mu=0.6)
    assert model.with_(units="SI") != model
    assert len({model, same, other, model.with_(mu=0.5), same.with_(mu=0.5)}) == 3


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickle_and_copy(name: str, protocol: int) -> None:
    model = Model.gallery(name).with_(time="1 ms", units="mm")
    kept = pickle.loads(pickle.dumps(model, protocol))
    for other in (kept, copy.copy(model), copy.deepcopy(model)):
        assert other == model and hash(other) == hash(model)
        assert other.settings == model.settings
        assert other.check().to_json() == model.check().to_json()


def test_a_pickled_model_keeps_its_numbers_to_the_last_bit() -> None:
    model = Model.gallery("drawer").with_(mu=1 / 3, at={"x": 0.1 + 0.2}, rate={"x": 1e-17})
    assert pickle.loads(pickle.dumps(model)) == model


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        Model.load(tmp_path / "none.toml")
    with pytest.raises(OSError):
        Model.load(tmp_path)


def test_a_file_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    path.write_bytes(b"title = \"\xff\"\n")
    with pytest.raises(ModelError):
        Model.load(path)


def test_models_of_the_gallery_have_descriptions() -> None:
    assert all(slideway.gallery_models().values())
    with pytest.raises(KeyError, match="did you mean \\\\?\"drawer"):
        Model.gallery("drawr")


def test_no_solution_is_an_answer() -> None:
    answer = Model.gallery("drawer").with_(mu=1.2).solve()
    assert answer.status == "none" and len(answer) == 0 and list(answer) == [] and answer
