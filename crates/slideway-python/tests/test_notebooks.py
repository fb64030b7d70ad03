"""The notebooks run, and show what they say they show.

    python tests/test_notebooks.py      runs them and writes what they show
"""

from pathlib import Path

import nbclient
import nbformat
import pytest

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))


def executed(path):
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=900, resources={"metadata": {"path": str(path.parent)}}).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    return notebook


def words(notebook):
    """What each cell prints or returns as text; the sizes of figures are those of a version of matplotlib."""

    def of(output):
        text = output.get("text") or output.get("data", {}).get("text/plain", "")
        return "" if text.startswith("<Figure") else text

    return ["".join(map(of, cell.get("outputs", []))) for cell in notebook.cells]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_what_notebooks_show_is_what_they_compute(path):
    written = words(nbformat.read(path, as_version=4))
    assert any(written)
    assert words(executed(path)) == written


if __name__ == "__main__":
    for path in NOTEBOOKS:
        nbformat.write(executed(path), path)
