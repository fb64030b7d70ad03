"""All solutions at many points."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _display, plotting
from ._needs import needs

if TYPE_CHECKING:
    import pandas
    import polars

    from . import _slideway, reports
    from ._values import QuantityName


class Sweep:
    """All solutions at the points of a sweep, one row for each: a table that NumPy, polars, pyarrow, DuckDB and pandas
    take without a copy through text.

    >>> import numpy as np, slideway
    >>> sweep = slideway.Model.gallery("drawer").sweep(mu=np.linspace(0.0, 1.0, 11))
    >>> sweep.tally.solutions
    {0: 4, 1: 7}
    >>> sweep["normal_force.guide.front"][:3].round(2)
    array([15.  , 17.65, 21.43])

    A point without a solution has one row, whose numbers are NaN (null in data frames). A sweep that was pickled has all of
    this but plots.
    """

    def __init__(self, table: _slideway.Table) -> None:
        self._table: Any = table

    @property
    def columns(self) -> list[str]:
        """The names of the columns."""
        return list(self._table.columns)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column of numbers; empty for pure numbers."""
        return dict(self._table.units)

    @property
    def contacts(self) -> tuple[str, ...]:
        """The names of the contacts, in the order of the signs in `pattern`."""
        return tuple(self._table.contacts)

    @property
    def tally(self) -> reports.Tally:
        """How many points came to what."""
        tally: reports.Tally = self._table.tally()
        return tally

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column as an array: numbers share the memory of `to_numpy` and cannot be written to, words are copied."""
        if column not in self.columns:
            near = difflib.get_close_matches(column, self.columns, n=1)
            meant = f"; did you mean {near[0]!r}?" if near else ""
            raise KeyError(f"there is no column {column!r}{meant}")
        values: NDArray[Any] = self.to_numpy()[column]
        return values.astype(str) if values.dtype.kind == "S" else values

    def __len__(self) -> int:
        return int(self._table.rows)

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def keys(self) -> list[str]:
        """The names of the columns: `dict(sweep)` has the columns by their names.

        Returns
        -------
        list of str

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").sweep(mu=[0.1, 0.2]).keys()[:2]
        ['point', 'mu']
        """
        return self.columns

    def to_numpy(self) -> NDArray[np.void]:
        """The table as an array of records.

        Returns
        -------
        array
            What `numpy.load` gives of the `rows` in a file of `slideway sweep --output FILE.npz`. It is made once, and
            cannot be written to.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").sweep(mu=[0.1, 0.2]).to_numpy()["mu"]
        array([0.1, 0.2])
        """
        return np.asarray(self)

    def to_polars(self) -> polars.DataFrame:
        """The table as a data frame of polars.

        Returns
        -------
        polars.DataFrame

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").sweep(mu=[0.1, 0.2]).to_polars().height
        2
        """
        with needs("to_polars() needs polars", "polars"):
            import polars

        return polars.DataFrame(self)

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame of pandas, by way of pyarrow: as pandas reads it from a Parquet file.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> import slideway
        >>> len(slideway.Model.gallery("drawer").sweep(mu=[0.1, 0.2]).to_pandas())
        2
        """
        with needs("to_pandas() needs pandas and pyarrow", "pandas", "pyarrow"):
            import pandas
            import pyarrow

        return pyarrow.table(self).to_pandas()

    @property
    def __array_interface__(self) -> dict[str, Any]:
        interface: dict[str, Any] = self._table.__array_interface__
        return interface

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        stream: object = self._table.__arrow_c_stream__(requested_schema)
        return stream

    def __getstate__(self) -> dict[str, Any]:
        return {"_table": Kept(self._table, self.to_numpy())}

    def plot(
        self,
        ax: Any = None,
        *,
        quantity: QuantityName = "normal-force",
        legend: plotting.LegendPlace | None = None,
        theme: plotting.ThemeName = "light",
        time_limit: float | None = None,
    ) -> Any:
        """Draws a quantity along every branch over the one that is varied, or its distribution over samples, with
        matplotlib. All points are computed again.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; an array of them if there are several panels. Default: the Axes of a new figure.
        quantity : {"normal-force", "friction", "acceleration", "effort"}
        legend : bool or "outside", optional
            Whether there is a legend within the Axes, or below them. Default: below the Axes of a new figure, within
            given ones.
        theme : {"light", "dark"}
        time_limit : float, optional
            The longest that it may take (s).

        Returns
        -------
        Axes or array of Axes

        Raises
        ------
        ValueError
            Two quantities are varied, of which `Model.map` makes a map, or the table is one shard.
        TimeoutError
            The time was up.

        Examples
        --------
        >>> import slideway
        >>> ax = slideway.Model.gallery("drawer").sweep(mu="0..0.6:61").plot()   # doctest: +SKIP
        """
        plot = self._table.plot(quantity, time_limit)
        return plotting.plot_figure(plot.figure(), plot.drawn, ax, legend=legend, theme=theme)

    def _repr_html_(self) -> str:
        return _display.words_html(self.text())

    def text(self, *, color: bool = False) -> str:
        """What the sweep comes to, as the command line says it.

        Parameters
        ----------
        color : bool, default False
            With colours for a terminal.

        Returns
        -------
        str

        Examples
        --------
        >>> import slideway
        >>> print(slideway.Model.gallery("drawer").sweep(mu=[0.1, 0.2]).text().splitlines()[0])
        It jams at none of 2 points.
        """
        text: str = self._table.text(color)
        return text

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"<slideway.Sweep: {self._table.points} points, {len(self)} rows, {len(self.columns)} columns>"


class Kept:
    """What is kept of a sweep that was pickled: its records, and its columns if pyarrow is there."""

    def __init__(self, table: Any, records: NDArray[np.void]) -> None:
        self.columns, self.units, self.contacts = table.columns, table.units, table.contacts
        self.rows, self.points = table.rows, table.points
        self._tally: reports.Tally = table.tally()
        self._text: str = table.text(False)
        self._records = records
        self._arrow = _arrow(table)

    def tally(self) -> reports.Tally:
        return self._tally

    def text(self, color: bool) -> str:
        return self._text

    @property
    def __array_interface__(self) -> dict[str, Any]:
        self._records.setflags(write=False)
        return self._records.__array_interface__

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        if self._arrow is None:
            raise TypeError("a sweep that was pickled without pyarrow has records only, which to_numpy() gives")
        return self._arrow.__arrow_c_stream__(requested_schema)

    def plot(self, *_: object) -> Any:
        raise TypeError("a sweep that was pickled has no plot: ask the model again")


def _arrow(table: Any) -> Any:
    """The table of pyarrow."""
    try:
        import pyarrow
    except ImportError:
        return None
    return table._arrow if isinstance(table, Kept) else pyarrow.table(table)
