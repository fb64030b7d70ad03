"""Faults as exceptions, with every fault as an object."""

from __future__ import annotations

import pickle

import pytest

from slideway import Fault, Model, ModelError


def faults(*arguments: object, **changes: object) -> tuple[Fault, ...]:
    with pytest.raises(ModelError) as caught:
        Model.gallery("drawer").with_(*arguments, **changes)  # type: ignore[arg-type]
    return caught.value.faults


def test_all_faults_of_a_text_with_their_places() -> None:
    text = Model.gallery("drawer").text.replace('"5 kg"', '"5 s"').replace('mu = "mu"', 'mu = "mew"')
    with pytest.raises(ModelError) as caught:
        Model.parse(text)
    found = caught.value.faults
    assert len(found) == 2
    lines = text.splitlines()
    for fault in found:
        assert fault.line is not None and fault.column is not None and fault.text
        assert lines[fault.line - 1][fault.column - 1 :].startswith(fault.text)
        assert fault.argument is None and not fault.is_warning
    assert str(caught.value).splitlines()[0].startswith(f"line {found[0].line}, column {found[0].column}: ")


def test_columns_are_counted_in_characters() -> None:
    with pytest.raises(ModelError) as caught:
        Model.parse('"ÄÖÜ😀" = 1')
    assert caught.value.faults[0].line == 1


def test_a_misspelt_name_has_a_suggestion() -> None:
    (fault,) = faults(my=0.5)
    assert "my" in fault.message and "mu" in (fault.hint or "")
    assert fault.argument == "my"


def test_the_argument_of_a_fault() -> None:
    assert faults(mu="5 kg")[0].argument == "mu"
    assert faults(at={"y": 0})[0].argument == 'at["y"]'
    assert faults(rate={"x": "3 kg"})[0].argument == 'rate["x"]'
    assert faults(time="3 kg")[0].argument == "time"


def test_several_arguments_are_refused_at_once() -> None:
    assert {fault.argument for fault in faults(my=0.5, L="3 s", rate={"z": 1})} == {"my", "L", 'rate["z"]'}


def test_an_exception_can_be_pickled() -> None:
    with pytest.raises(ModelError) as caught:
        Model.parse("title = 1")
    kept = pickle.loads(pickle.dumps(caught.value))
    assert kept.faults == caught.value.faults and str(kept) == str(caught.value)
    assert isinstance(kept, ValueError)


def test_terminals_are_safe_from_names() -> None:
    with pytest.raises(ModelError) as caught:
        Model.parse('"\x1b[31m" = 1'.replace("\x1b", "\\u001b"))
    assert "\x1b" not in str(caught.value)


def test_hints_name_what_python_has() -> None:
    """Hints of the library name options of the command line, which are arguments here."""
    drawer = Model.gallery("drawer")
    refused = {
        "at rest": lambda: drawer.with_(rate={"x": 0}).solve(),
        "unused load": lambda: drawer.size("mu", margin=2, load="resistance"),
        "load needed": lambda: Model.gallery("klepp-2002").size("mu_1", margin=2, against="self-locking"),
        "no samples": lambda: drawer.sweep(mu="normal(0.3, 0.05)"),
        "a number of values": lambda: drawer.sweep(samples=10, mu="0..1:11"),
        "no time": lambda: drawer.simulate(0),
        "empty": lambda: Model.parse(""),
    }
    hints = {}
    for name, ask in refused.items():
        with pytest.raises(ModelError) as caught:
            ask()
        hints[name] = " ".join(fault.hint or "" for fault in caught.value.faults)
        assert "--" not in str(caught.value) and "`slideway " not in str(caught.value)
    assert '`rate={"x": 1}`' in hints["at rest"] and "`model.hold()`" in hints["at rest"]
    assert '`against="self-locking"`' in hints["unused load"]
    assert hints["load needed"].startswith("name it with load;")
    assert "`samples=10000`" in hints["no samples"]
    assert "without samples" in hints["a number of values"]
    assert "until" in hints["no time"]
    assert "`slideway.gallery_models()`" in hints["empty"]
