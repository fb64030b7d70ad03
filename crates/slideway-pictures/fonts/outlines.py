"""Writes advances.txt and outlines.txt, the glyphs of DejaVuSans-subset.ttf. Needs fontTools (pip install fonttools).

One line for each character, in their order: its number, and its advance or its outline as the data of an SVG path, in units
of the typeface (2048 for the size), y upwards.
"""

from pathlib import Path

from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont


class Outline(BasePen):
    """Outlines as lines and quadratic curves."""

    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.data = []

    def command(self, letter, *points):
        self.data.append(letter + " ".join(f"{x:g} {y:g}" for x, y in points))

    def _moveTo(self, point):
        self.command("M", point)

    def _lineTo(self, point):
        self.command("L", point)

    def _qCurveToOne(self, control, point):
        self.command("Q", control, point)

    def _closePath(self):
        self.data.append("Z")


folder = Path(__file__).parent
font = TTFont(folder / "DejaVuSans-subset.ttf")
assert font["head"].unitsPerEm == 2048
glyphs = font.getGlyphSet()
advances, outlines = [], []
for number, name in sorted(font.getBestCmap().items()):
    pen = Outline(glyphs)
    glyphs[name].draw(pen)
    advances.append(f"{number:04x} {font['hmtx'][name][0]}\n")
    outlines.append(f"{number:04x} {''.join(pen.data)}\n")
(folder / "advances.txt").write_text("".join(advances))
(folder / "outlines.txt").write_text("".join(outlines))
