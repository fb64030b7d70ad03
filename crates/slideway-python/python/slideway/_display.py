"""What notebooks show: drawings, and answers as HTML. Every text is escaped; pictures are `img` elements that hold them,
so that neither their styles nor their ids reach the page."""

from __future__ import annotations

import base64
import hashlib
import html
import re
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from . import _slideway

if TYPE_CHECKING:
    from ._motion import Motion

# Tables and words; all names are those of pages, within one element, which is named twice where notebooks have rules
# of their own.
STYLE = """<style>
.slideway { line-height: 1.45; max-width: 70rem; }
.slideway h3 { font-size: 1.05rem; margin: .9rem 0 .3rem; }
.slideway p { margin: .3rem 0; max-width: 50rem; }
.slideway .answer { font-size: 1.1rem; }
.slideway .quiet { font-size: .9rem; opacity: .8; }
.slideway .beside { display: flex; flex-wrap: wrap; gap: .5rem 2rem; align-items: flex-start; }
.slideway .beside > * { flex: 1 1 24rem; min-width: min(100%, 18rem); }
.slideway .wide { overflow-x: auto; }
.slideway img { max-width: 100%; height: auto; margin: 0; }
.slideway table { border-collapse: collapse; margin: .4rem 0; font-size: .9rem; }
.slideway table th { font-weight: 600; }
.slideway.slideway table th, .slideway.slideway table td { padding: .1rem 1rem .1rem 0; vertical-align: top; text-align: left; }
.slideway.slideway table td.number, .slideway.slideway table th.number { text-align: right; font-variant-numeric: tabular-nums; }
.slideway details > summary { cursor: pointer; }
.slideway iframe { width: 100%; border: 0; aspect-ratio: 4 / 3; min-height: 38rem; }
</style>"""


class Drawing:
    """A picture: it shows itself in a notebook, and can be saved."""

    def __init__(self, svg: str) -> None:
        self.svg = svg
        """The picture as an SVG document."""

    def save(self, path: str | PathLike[str], *, scale: float = 2.0) -> None:
        """Writes a file.

        Parameters
        ----------
        path : str or path
            It ends in .svg or .png.
        scale : float, default 2
            Pixels of a PNG for each unit of the SVG.

        Raises
        ------
        ValueError
            Another ending, or a picture that is too large.

        Examples
        --------
        >>> import pathlib, slideway, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "drawer.png")
        >>> slideway.Model.gallery("drawer").draw().save(path)
        >>> path.read_bytes()[1:4]
        b'PNG'
        """
        path = Path(path)
        match path.suffix.lower():
            case ".svg":
                path.write_text(self.svg, encoding="utf-8")
            case ".png":
                path.write_bytes(_slideway.png(self.svg, scale))
            case other:
                raise ValueError(f"path must end in .svg or .png, not {other!r}")

    def _repr_svg_(self) -> str:
        return _apart(self.svg)

    def __repr__(self) -> str:
        title = re.search("<title>(.*?)</title>", self.svg)
        return f"<slideway.Drawing: {html.unescape(title[1]) if title else ''}>"


class Page:
    """A page that needs no other file: it shows itself in a notebook, and can be saved."""

    def __init__(self, page: str, title: str) -> None:
        self.html = page
        """The page."""
        self._title = title

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the page to a file.

        Parameters
        ----------
        path : str or path
            It ends in .html.

        Raises
        ------
        ValueError
            Another ending.

        Examples
        --------
        >>> import pathlib, slideway, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "drawer.html")
        >>> slideway.Model.gallery("drawer").simulate("0.1 s").animate().save(path)
        >>> path.exists()
        True
        """
        path = Path(path)
        if path.suffix.lower() not in (".html", ".htm"):
            raise ValueError(f"path must end in .html, not {path.suffix!r}")
        path.write_text(self.html, encoding="utf-8")

    def _repr_html_(self) -> str:
        return _block(_frame(self.html, self._title))

    def __repr__(self) -> str:
        return f"<slideway.{type(self).__name__}: {self._title}>"


class Animation(Page):
    """A mechanism that moves: it plays in a notebook, and can be saved as a page."""


def model_html(model: _slideway.Model) -> str:
    """A model: its drawing, parameters, coordinates and warnings."""
    parameters = [[name, *map(_quantity, texts)] for name, *texts in model._parameter_texts()]
    has_ranges = any(row[2] for row in parameters)
    if not has_ranges:
        parameters = [row[:2] for row in parameters]
    tables = _table(["Parameter", "Value", *(["Known between"] if has_ranges else [])], parameters)
    try:
        # What cannot be assembled has no drawing, but is still shown.
        picture = _image(model.draw().svg)
        tables += _table(["Coordinate", "Value", "Rate"], [list(row) for row in model._coordinate_texts()])
        check = model.check()
        doubts = "".join(f"<p>{_text(warning.message)}. {_text(warning.hint)}</p>" for warning in check.warnings)
        faults = "".join(f"<p>{_text(finding.message)}</p>" for finding in check.findings)
    except ValueError as error:
        picture, doubts, faults = "", "", f"<p>{_text(str(error))}</p>"
    changes = f"<p>With {_text(', '.join(model.settings))}</p>" if model.settings else ""
    notes = _section("Cannot be solved", faults) + _section("Warnings", doubts)
    title = f"<h3>{_text(model.title)}</h3>" if model.title else ""
    return _block(f'{title}{changes}<div class="beside"><div>{picture}</div><div>{tables}{notes}</div></div>')


def solve_html(answer: _slideway.Answer, count: int) -> str:
    """So many solutions: words first, then the drawing of each contact mode beside its forces; states of preload gaps
    likewise."""
    if not _has_pictures(answer):
        return text_html(answer)
    head, *states = answer.parts()
    pictures = [answer.drawing("light", number + 1) for number in range(count)]
    pictures += [answer.drawing("light", gap_state=number + 1) for number in range(len(states) - count)]
    shown = "".join(
        f'<div class="beside"><div>{state}</div><div>{_image(picture)}</div></div>'
        for state, picture in zip(states, pictures, strict=True)
    )
    return _block(head + (shown or _image(answer.drawing("light"))))


def limits_html(answer: _slideway.Answer) -> str:
    """Limits: the conclusion with the table of modes, then the plot."""
    if not _has_pictures(answer):
        return text_html(answer)
    return _block("".join(answer.parts()) + _image(answer.plot_svg("light")))


def plot_html(answer: _slideway.Answer, conclusion: Sequence[str]) -> str:
    """An answer: what it comes to, its plot, and all of it in words, folded."""
    if not _has_pictures(answer):
        return text_html(answer)
    words = "".join(f"<p>{_text(line)}</p>" for line in conclusion)
    details = f"<details><summary>All of it in words</summary>{_pre(answer.text(False))}</details>"
    return _block(words + _image(answer.plot_svg("light")) + details)


def drawn_html(answer: _slideway.Answer) -> str:
    """An answer in words, beside the drawing of the mechanism."""
    if not _has_pictures(answer):
        return text_html(answer)
    words, picture = _pre(answer.text(False)), _image(answer.drawing("light"))
    # As wide as lines of words are; the drawing is beside them where there is room, else below.
    return _block(f'<div class="beside"><div style="flex: 2 1 54rem">{words}</div><div>{picture}</div></div>')


def text_html(answer: _slideway.Answer) -> str:
    """An answer in words."""
    return words_html(answer.text(False))


def words_html(text: str) -> str:
    """Words and tables as the command line shows them."""
    return _block(_pre(text))


def motion_html(motion: Motion) -> str:
    """A motion: how it goes, and its animation."""
    return _block(_pre(motion.text()) + _frame(motion._motion.animation("light", None), motion.report._headline()))


def _has_pictures(answer: object) -> bool:
    """Whether an answer has not been pickled."""
    return isinstance(answer, _slideway.Answer)


def _text(text: str) -> str:
    return html.escape(_slideway.printable(text))


def _quantity(text: str) -> str:
    """A number with its unit."""
    return text.replace("^2", "²").replace("^3", "³").replace("^4", "⁴")


# Columns stay below each other wherever a page goes: some leave out styles of pages, or have other ones for `pre`.
PRE = (
    "font-family: ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace; font-size: .85rem; line-height: 1.35; "
    "white-space: pre; overflow-x: auto; overflow-y: visible; max-height: none; padding: 0 0 .8rem; margin: .3rem 0"
)


def _pre(text: str) -> str:
    return f'<pre style="{PRE}">{_text(text.strip(chr(10)).rstrip())}</pre>'


def _block(content: str) -> str:
    return f'{STYLE}\n<div class="slideway">\n{content}\n</div>'


def _section(title: str, content: str) -> str:
    return f"<h3>{title}</h3>{content}" if content else ""


def _table(heads: list[str], rows: list[list[str]]) -> str:
    if not rows:
        return ""
    head = "".join(f"<th>{head}</th>" for head in heads)
    body = "".join(
        "<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>\n" for row in rows
    )
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>'


def _image(svg: str) -> str:
    title = re.search("<title>(.*?)</title>", svg)
    data = base64.b64encode(svg.encode()).decode()
    return f'<img alt="{title[1] if title else ""}" src="data:image/svg+xml;base64,{data}">'


def _frame(page: str, title: str) -> str:
    """A page within the page, which cannot reach it."""
    return f'<iframe sandbox="allow-scripts" title="{_text(title)}" srcdoc="{html.escape(page)}"></iframe>'


def _apart(svg: str) -> str:
    """The picture with ids and rules that no other one in the same page has."""
    name = "s" + hashlib.sha256(svg.encode()).hexdigest()[:12]
    svg = re.sub(r'( id="|url\(#|href="#)', rf"\g<1>{name}-", svg)

    def own(style: re.Match[str]) -> str:
        return re.sub(r"(?m)^\.|(?<=, )\.", f"#{name} .", style[0])

    svg = re.sub(r"<style>.*?</style>", own, svg, count=1, flags=re.DOTALL)
    return svg.replace("<svg ", f'<svg id="{name}" ', 1)
