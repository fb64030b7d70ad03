"""What notebooks show."""

import html
import pickle
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

import slideway
from slideway import Model

HOSTILE = '<script>alert(1)</script>" onload="x &amp; \\u202e'


@pytest.fixture(scope="module")
def drawer():
    return Model.gallery("drawer")


@pytest.fixture(scope="module")
def hostile(drawer):
    return Model.parse(drawer.text.replace("A drawer pushed off-centre", HOSTILE.replace('"', '\\"'), 2))


class Tags(HTMLParser):
    """The tags of a text, each closed by its own."""

    VOID = ("img", "br", "hr", "meta", "input")

    def __init__(self, text):
        super().__init__()
        self.open, self.seen, self.attributes = [], [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.seen.append(tag)
        self.attributes += attributes
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def shown(model):
    """What a notebook shows of a model and its answers."""
    yield model
    yield model.solve()
    yield model.with_(mu=1.2).solve()
    yield model.limits("mu", 0, 1)
    yield model.size("L", "200 mm", "900 mm", margin=2)
    yield model.drive()
    yield model.drive("mu", (0, 1))
    yield model.hold()
    yield model.map(mu=(0, 1), L=("200 mm", "500 mm"), size=(20, 10))
    yield model.draw(1)


def html_of(each):
    return each._repr_svg_() if isinstance(each, slideway.Drawing) else each._repr_html_()


def test_titles_are_escaped(hostile):
    for each in shown(hostile):
        text = html_of(each)
        assert "alert(1)" in text or "base64" in text
        tags = Tags(text)
        assert "script" not in tags.seen
        assert not any(name.startswith("on") for name, _ in tags.attributes)
        assert "\u202e" not in text


def test_nothing_has_an_id_that_another_output_has(drawer):
    seen = set()
    for each in shown(drawer):
        found = re.findall(r'\sid="([^"]*)"', html_of(each))
        assert len(found) == len(set(found)) and not seen & set(found)
        seen |= set(found)


def test_a_model_shows_parameters_with_units_coordinates_and_changes(drawer):
    text = drawer.with_(L="450 mm", units="mm")._repr_html_()
    assert "<tr><td>L</td><td>450 mm</td></tr>" in text
    assert "<tr><td>x</td><td>0 mm</td><td>100 mm/s</td></tr>" in text
    assert "With L=450 mm" in text


def test_a_model_shows_its_warnings(drawer):
    doubtful = drawer.with_(mu=30)
    warnings = doubtful.check().warnings
    assert warnings
    text = doubtful._repr_html_()
    assert "Warnings" in text and all(warning.message.split("`")[0] in text for warning in warnings)


def test_a_model_without_a_position_is_shown_with_what_is_wrong():
    apart = Model.gallery("telescopic-boom").with_(at={"s_1": "1 km"})
    with pytest.raises(slideway.ModelError):
        apart.solve()
    text = apart._repr_html_()
    assert "Cannot be solved" in text and "an overlap of -999.4 m at a displacement of 1000 m" in text
    Tags(text)


def test_solutions_have_a_drawing_beside_each_of_their_forces():
    answer = Model.gallery("klepp-2002").solve()
    text = answer._repr_html_()
    states = len(answer.solutions) + len(answer.preload_gap_states)
    assert states == 4
    assert text.count('class="state"') == text.count("<img") == states
    assert text.index("It can go on in 2 ways") < text.index("<img")
    for solution in answer:
        assert all(f"{abs(force):.4g}" in text for force in solution.normal_forces)


def test_drawings_are_saved_as_svg_and_png(drawer, tmp_path):
    drawing = drawer.draw(1)
    drawing.save(tmp_path / "drawer.svg")
    assert (tmp_path / "drawer.svg").read_text() == drawing.svg
    ElementTree.fromstring(drawing.svg)
    ElementTree.fromstring(drawing._repr_svg_())
    drawing.save(tmp_path / "drawer.png", scale=1.0)
    drawing.save(tmp_path / "larger.png", scale=2.0)
    small, large = ((tmp_path / name).read_bytes() for name in ("drawer.png", "larger.png"))
    assert small[:8] == large[:8] == b"\x89PNG\r\n\x1a\n"
    sizes = [int.from_bytes(picture[16:20]) for picture in (small, large)]
    width = float(ElementTree.fromstring(drawing.svg).get("width"))
    assert sizes == [round(width), round(2 * width)]
    with pytest.raises(ValueError, match="must end in .svg or .png"):
        drawing.save(tmp_path / "drawer.pdf")
    with pytest.raises(ValueError, match="16384"):
        drawing.save(tmp_path / "drawer.png", scale=1e6)


def test_a_drawing_is_of_the_mechanism_or_of_a_solution(drawer):
    assert "Solution 1 of 1" in drawer.draw(1).svg
    assert "Solution 1" not in drawer.draw().svg
    assert drawer.solve().draw(1).svg == drawer.solve(margins=False).draw(1).svg
    with pytest.raises(ValueError, match="no solution of this number"):
        drawer.draw(2)
    assert drawer.draw(theme="dark").svg != drawer.draw().svg


def test_an_animation_plays_in_a_frame_of_its_own(tmp_path):
    motion = Model.gallery("frictional-oscillator").simulate(0.2)
    for each in (motion, motion.animate(slow_motion=5)):
        tags = Tags(each._repr_html_())
        assert tags.seen.count("iframe") == 1 and "script" not in tags.seen
        attributes = dict(tags.attributes)
        assert attributes["sandbox"] == "allow-scripts"
        assert attributes["srcdoc"].startswith("<!doctype html>")
    animation = motion.animate()
    animation.save(tmp_path / "motion.html")
    assert (tmp_path / "motion.html").read_text() == animation.html
    with pytest.raises(ValueError, match="must end in .html"):
        animation.save(tmp_path / "motion.gif")


def test_an_answer_that_was_pickled_is_shown_in_words(drawer):
    for answer in (drawer.solve(), drawer.limits("mu", 0, 1), drawer.hold()):
        again = pickle.loads(pickle.dumps(answer))
        assert "<pre " in again._repr_html_() and "<img" not in again._repr_html_()


def test_a_raw_problem_is_shown_in_words():
    assert "<pre " in slideway.modes.lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0])._repr_html_()


def test_every_answer_shows_itself(drawer):
    for answer in (
        drawer.check(), drawer.rest_limits(friction=(0, 2)), drawer.simulate(0.05, all_branches=3), drawer.hold()
    ):
        text = answer._repr_html_()
        Tags(text)
        assert "<pre " in text and "<img" in text


def test_tables_in_words_keep_their_columns_and_lines_wherever_they_are_shown(drawer):
    """Pages that are made of notebooks have rules of their own for `pre`, or leave those of the answer out."""
    answer = drawer.hold()
    text = answer._repr_html_()
    (style,) = [value for name, value in Tags(text).attributes if name == "style" and "font-family" in value]
    assert "monospace" in style and "white-space: pre;" in style and "max-height: none" in style
    shown = html.unescape(re.search("<pre [^>]*>(.*?)</pre>", text, re.DOTALL)[1])
    assert shown == answer.text().strip("\n").rstrip()
