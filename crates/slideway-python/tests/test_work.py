"""Long work: it ends in time, on Ctrl-C, and when a callback raises; threads do not disturb each other."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from conftest import MODELS

import slideway
from slideway import Model

# Each pair has two solutions for itself, and weak coupling leaves them all: 2^40 solutions, work for years.
LONG = """
import numpy as np, slideway
random = np.random.default_rng(1)
M = -np.eye(40) + 1e-3 * random.normal(size=(40, 40))
q = np.ones(40)
options = {"max_found": 10**12, "max_nodes": 10**15}
"""


def long_work(**options: Any) -> slideway.reports.RawReport:
    names: dict[str, Any] = {}
    exec(LONG, names)
    return slideway.modes.lcp(names["M"], names["q"], **names["options"], **options)


def test_a_time_limit_gives_a_partial_answer() -> None:
    begun = time.monotonic()
    answer = long_work(time_limit=0.3)
    assert time.monotonic() - begun < 30
    assert answer.complete != "proven"


def test_a_time_limit_without_a_partial_answer() -> None:
    with pytest.raises(TimeoutError, match="time_limit"):
        Model.gallery("klepp-2002").map(mu_1=(0, 1), alpha=("70 deg", "85 deg"), size=(900, 900), time_limit=0.2)


@pytest.mark.parametrize("question", [Model.solve, lambda model, **limit: model.simulate("2 s", **limit)])
def test_a_time_limit_before_there_is_any_answer(question: Any) -> None:
    # The position itself takes thousands of steps, after which it is refused (crates/slideway/tests/extremes.rs).
    far = Model.gallery("slider-crank").with_(phi="1e5 rad")
    with pytest.raises(TimeoutError, match="not done within time_limit"):
        question(far, time_limit=1e-9)
    with pytest.raises(slideway.ModelError, match="too far from the drawing"):
        question(far)


def test_a_callback_that_raises() -> None:
    class Enough(Exception):
        pass

    calls = []

    def progress(fraction: float | None, done: int, counted: str) -> None:
        calls.append((fraction, done, counted))
        raise Enough

    with pytest.raises(Enough):
        long_work(time_limit=60, progress=progress)
    assert len(calls) == 1
    fraction, done, counted = calls[0]
    assert (fraction is None or 0 <= fraction <= 1) and done >= 0 and counted


def test_a_callback_that_asks_again() -> None:
    inner = []

    def progress(*_: object) -> None:
        inner.append(Model.gallery("drawer").solve().status)

    long_work(time_limit=0.5, progress=progress)
    assert inner and set(inner) == {"one"}


def test_a_callback_that_cannot_be_called() -> None:
    with pytest.raises(TypeError, match="callable"):
        long_work(time_limit=60, progress=3)


def test_ctrl_c() -> None:
    # Where tests run in the background, SIGINT is ignored unless a program asks for it.
    heeded = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    program = heeded + LONG + "print('begun', flush=True)\nslideway.modes.lcp(M, q, **options)\n"
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdout is not None and process.stdout.readline() == b"begun\n"
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    try:
        _, complaints = process.communicate(timeout=60)
    finally:
        process.kill()
    assert b"KeyboardInterrupt" in complaints and b"panic" not in complaints
    assert process.returncode != 0


def answers(name: str) -> list[str]:
    model = Model.gallery(name)
    found = []
    for question in (Model.solve, Model.hold, Model.drive):
        try:
            found.append(question(model).to_json())
        except slideway.ModelError as error:
            found.append(str(error))
    return found


def test_threads_give_the_same_answers() -> None:
    alone = {name: answers(name) for name in MODELS}
    with ThreadPoolExecutor(8) as threads:
        for _ in range(2):
            together = dict(zip(MODELS, threads.map(answers, MODELS)))
            assert together == alone


def test_threads_share_one_model() -> None:
    model = Model.gallery("klepp-2002")
    wanted = model.solve().to_json()
    with ThreadPoolExecutor(8) as threads:
        assert set(threads.map(lambda _: model.solve().to_json(), range(24))) == {wanted}


def test_threads_share_one_mechanism() -> None:
    mechanism = slideway.Mechanism()
    with ThreadPoolExecutor(8) as threads:
        list(threads.map(lambda number: mechanism.body(f"body_{number}", mass=1), range(200)))
    assert mechanism.to_toml().count("[bodies.body_") == 200


def test_the_interpreter_is_free_during_work() -> None:
    counted, done = [0], threading.Event()

    def count() -> None:
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    long_work(time_limit=0.5)
    done.set()
    thread.join()
    assert counted[0] > 20
