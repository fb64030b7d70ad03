"""Packages that are not installed: it is said which to install."""

from __future__ import annotations

import subprocess
import sys

import pytest

DASK = "slideway.dask needs Dask: pip install 'dask[dataframe]' distributed pandas pyarrow"
PANDAS = "to_pandas() needs pandas and pyarrow: pip install pandas pyarrow"


@pytest.mark.parametrize(
    ("missing", "statement", "message"),
    [
        ("matplotlib", "model.limits('mu', 0, 1).plot()", "plots need matplotlib: pip install matplotlib"),
        ("dask", "import slideway.dask", DASK),
        ("pandas", "import slideway.dask", DASK),
        ("polars", "model.sweep(mu=[0.1]).to_polars()", "to_polars() needs polars: pip install polars"),
        ("pandas", "model.sweep(mu=[0.1]).to_pandas()", PANDAS),
        ("pyarrow", "model.sweep(mu=[0.1]).to_pandas()", PANDAS),
    ],
)
def test_what_is_missing_is_said_with_what_to_install(missing: str, statement: str, message: str) -> None:
    program = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "import slideway\n"
        "model = slideway.Model.gallery('drawer')\n"
        f"try:\n    {statement}\nexcept ImportError as error:\n    print(error)\n"
    )
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert said.stdout == message + "\n"
