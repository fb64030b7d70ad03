"""What tests share: the workspace, the program `slideway`, and the questions that are asked of every model."""

from __future__ import annotations

import os
import subprocess
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import slideway

WORKSPACE = Path(__file__).resolve().parents[3]
MODELS = sorted(slideway.gallery_models())

# A dimension of each model and a range for it, beside friction: the second axis of its map.
DIMENSIONS = {
    "bell-crank": ("a", "60 mm", "100 mm"),
    "box-on-incline": ("b", "150 mm", "250 mm"),
    "boom-in-wind": ("overlap", "0.5 m", "0.7 m"),
    "bracket-on-pole": ("x", "250 mm", "350 mm"),
    "cam-and-spring": ("e", "8 mm", "12 mm"),
    "cam-follower": ("A", "40 mm", "60 mm"),
    "carriage-on-two-rods": ("L", "50 mm", "70 mm"),
    "drawer": ("L", "300 mm", "500 mm"),
    "drawer-on-runners": ("L", "300 mm", "500 mm"),
    "drawer-on-two-rails": ("L", "300 mm", "500 mm"),
    "elliptic-trammel": ("m", "1 kg", "3 kg"),
    "four-bar": ("T", "1 N m", "3 N m"),
    "frictional-oscillator": ("k", "200 N/m", "300 N/m"),
    "gate-on-two-posts": ("L", "0.9 m", "1.1 m"),
    "klepp-2002": ("alpha", "70 deg", "85 deg"),
    "klepp-2002-spring": ("alpha", "70 deg", "85 deg"),
    "ladder": ("L", "3 m", "5 m"),
    "latch-with-pawl": ("ramp", "45 deg", "55 deg"),
    "nip-of-rolls": ("half", "101 mm", "103 mm"),
    "over-centre-clamp": ("F", "1 kN", "3 kN"),
    "painleve-klein": ("phi", "20 deg", "40 deg"),
    "peg-in-hole": ("off", "20 mm", "30 mm"),
    "quick-return": ("Q", "500 N", "700 N"),
    "rattling-drawer": ("L", "350 mm", "500 mm"),
    "rod-on-floor": ("l", "0.4 m", "0.6 m"),
    "scotch-yoke": ("L", "100 mm", "140 mm"),
    "screw": ("d_mean", "20 mm", "23 mm"),
    "shaft-in-v-block": ("m", "2 kg", "4 kg"),
    "sleeve-on-arm": ("L", "60 mm", "100 mm"),
    "slider-crank": ("l", "150 mm", "200 mm"),
    "slider-crank-with-pins": ("l", "150 mm", "200 mm"),
    "soft-closing-drawer": ("k", "150 N/m", "250 N/m"),
    "stick-slip": ("k", "80 N/m", "120 N/m"),
    "stribeck-belt": ("m", "0.8 kg", "1.2 kg"),
    "telescopic-boom": ("L", "0.9 m", "1.1 m"),
    "three-pad-telescope": ("L", "0.7 m", "0.9 m"),
    "thrown-drawer": ("m", "4 kg", "6 kg"),
    "toggle-press": ("Q", "5 kN", "15 kN"),
    "wedge": ("alpha", "10 deg", "20 deg"),
    "woodpecker": ("l", "14 mm", "16 mm"),
}


@dataclass(frozen=True)
class Question:
    """The same question for the command line and for Python."""

    command: Callable[[str], list[str]]
    """The subcommand and its options, for a model of this name."""
    ask: Callable[[slideway.Model, str], Any]


def _load(name: str) -> str:
    """A load or drive of the model."""
    sections = tomllib.loads(slideway.Model.gallery(name).text)
    return next(iter(sections.get("loads", {}) | sections.get("drives", {})), "gravity")


QUESTIONS: dict[str, Question] = {
    "check": Question(lambda _: ["check"], lambda model, _: model.check()),
    "solve": Question(lambda _: ["solve"], lambda model, _: model.solve()),
    "solve, few": Question(
        lambda _: ["solve", "--max-solutions", "1", "--max-nodes", "2"],
        lambda model, _: model.solve(max_solutions=1, max_nodes=2),
    ),
    "limits": Question(
        lambda _: ["limits", "--vary", "friction=0..2"], lambda model, _: model.limits("friction", 0, 2)
    ),
    "limits of a dimension": Question(
        lambda name: ["limits", "--vary", "{0}={1}..{2}".format(*DIMENSIONS[name]), "--effort", "100"],
        lambda model, name: model.limits(*DIMENSIONS[name], effort=100),
    ),
    "limits in both directions": Question(
        lambda _: ["limits", "--vary", "friction=0..2", "--both-directions", "--max-reaction", "200"],
        lambda model, _: model.limits("friction", 0, 2, both_directions=True, max_reaction=200),
    ),
    "hold": Question(lambda _: ["hold"], lambda model, _: model.hold()),
    "hold with its drives": Question(
        lambda _: ["hold", "--drives", "hold"], lambda model, _: model.hold(drives="hold")
    ),
    "hold a load": Question(
        lambda name: ["hold", "--load", _load(name)], lambda model, name: model.hold(_load(name))
    ),
    "hold, friction": Question(
        lambda _: ["hold", "--vary", "friction=0..2"], lambda model, _: model.rest_limits("friction", 0, 2)
    ),
    "drive": Question(lambda _: ["drive"], lambda model, _: model.drive()),
    "drive over a dimension": Question(
        lambda name: ["drive", "--rows", "3", "--vary", "{0}={1}..{2}".format(*DIMENSIONS[name])],
        lambda model, name: model.drive(DIMENSIONS[name][0], DIMENSIONS[name][1:], rows=3),
    ),
    "size for a margin": Question(
        lambda _: ["size", "--vary", "friction=0.1..2", "--margin", "2"],
        lambda model, _: model.size("friction", 0.1, 2, margin=2),
    ),
    "size for an effort": Question(
        lambda _: ["size", "--vary", "friction=0.1..2", "--max-effort", "50"],
        lambda model, _: model.size("friction", 0.1, 2, max_effort=50),
    ),
    "size for a normal force": Question(
        lambda _: ["size", "--vary", "friction=0.1..2", "--max-normal-force", "50"],
        lambda model, _: model.size("friction", 0.1, 2, max_normal_force=50),
    ),
    "map": Question(
        lambda name: ["map", "--x", "friction=0..2", "--y", "{0}={1}..{2}".format(*DIMENSIONS[name])]
        + ["--size", "6x5"],
        lambda model, name: model.map(
            **{"friction": (0, 2), DIMENSIONS[name][0]: DIMENSIONS[name][1:]}, size=(6, 5)
        ),
    ),
    "simulate": Question(
        lambda _: ["simulate", "--until", "0.05"], lambda model, _: model.simulate(0.05)
    ),
    "all motions": Question(
        lambda _: ["simulate", "--until", "0.05", "--all-branches", "--max-motions", "3"],
        lambda model, _: model.simulate(0.05, all_branches=3),
    ),
}


@dataclass(frozen=True)
class Program:
    """The program `slideway`, and a folder in which it works."""

    path: Path
    folder: Path

    def run(self, command: list[str], text: str, name: str = "model.toml") -> tuple[str, str]:
        """What it says of a file with this text, and its complaints."""
        (self.folder / name).write_text(text)
        subcommand, *options = command
        return self.run_in_folder([subcommand, name, *options])

    def run_in_folder(self, command: list[str]) -> tuple[str, str]:
        """What it says to a command, and its complaints."""
        # In words as wide as those of Python, which knows no terminal: some terminals and test runners say theirs.
        environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
        done = subprocess.run(
            [self.path, *command], cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )
        return done.stdout, done.stderr

    def json(self, command: list[str], text: str, name: str = "model.toml") -> tuple[str, str]:
        """The same as JSON, which maps write to a file."""
        if command[0] != "map":
            return self.run([*command, "--format", "json"], text, name)
        output = self.folder / "map.json"
        _, complaints = self.run([*command, "--output", output.name], text, name)
        return (output.read_text() if output.exists() else ""), complaints


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """The program: the one that SLIDEWAY names, else that of a debug build."""
    path = Path(os.environ.get("SLIDEWAY", WORKSPACE / "target" / "debug" / "slideway"))
    if not path.is_file():
        pytest.fail(f"there is no program {path}: build it with `cargo build -p slideway-cli`, or say SLIDEWAY=PATH")
    return Program(path, tmp_path)
