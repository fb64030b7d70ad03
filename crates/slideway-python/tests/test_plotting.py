"""Plots with matplotlib: what they return, and that they show what the library says."""

import subprocess
import sys

import matplotlib

matplotlib.use("agg")

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb

import slideway
from slideway import Model, plotting


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def klepp():
    return Model.gallery("klepp-2002").with_(F_20=0)


@pytest.fixture(scope="module")
def figure_4(klepp):
    return klepp.limits("mu_1", 0, 0.8)


def legend_texts(ax):
    legends = {child for child in ax.get_children() if type(child).__name__ == "Legend"}
    return [text.get_text().replace("\n", " ") for legend in legends for text in legend.get_texts()]


def test_limits_are_drawn_on_one_axes_with_their_labels(figure_4):
    ax = figure_4.plot()
    assert isinstance(ax, Axes)
    assert ax.get_xlabel() == "mu_1"
    assert ax.get_ylabel() == "normal force in N"
    assert ax.get_xlim() == (0.0, 0.8)
    texts = legend_texts(ax)
    assert {"upper", "lower.front", "lower.rear"} <= set(texts)
    assert any("(unstable)" in text for text in texts)
    # Klepp (2002): mu_1* = 2 cot(80 deg) + 0.1.
    unbounded = 2.0 / np.tan(np.radians(80.0)) + 0.1
    assert any(text.get_text() == f"{unbounded:.6g}: grows without bound" for text in ax.texts)
    ax.figure.canvas.draw()


def test_lines_have_the_values_of_the_curves(klepp, figure_4):
    ax = figure_4.plot()
    solution = klepp.with_(mu_1=0.3).solve(margins=False).solutions[0]
    curves = [line for line in ax.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 2]
    at = sorted(np.interp(0.3, line.get_xdata(), line.get_ydata()) for line in curves)
    # Curves keep within a twentieth of a pixel of the points: 40 N on 380 pixels.
    assert at == pytest.approx(sorted(solution.normal_forces), abs=0.05 * 40 / 380 + 1e-9)


def test_what_goes_beyond_the_frame_is_cut_at_round_values(figure_4):
    ax = figure_4.plot()
    low, high = ax.get_ylim()
    assert any(text == f"cut at −{-low:g} N and {high:g} N: grows without bound" for text in legend_texts(ax))


def test_given_axes_are_used_and_returned(figure_4):
    _, given = plt.subplots()
    assert figure_4.plot(given) is given
    assert figure_4.plot(ax=given) is given


@pytest.mark.parametrize("layout", [None, "constrained", "tight"])
@pytest.mark.parametrize("legend", [None, True, False, "outside"])
def test_the_figure_of_given_axes_is_left_alone(figure_4, layout, legend):
    figure, (given, other) = plt.subplots(1, 2, figsize=(12, 8), layout=layout)
    engine = figure.get_layout_engine()
    figure_4.plot(given, legend=legend)
    plane = Model.gallery("drawer").map(mu=(0, 1), L=("200 mm", "500 mm"), size=(8, 6))
    plane.plot(other, legend=legend)
    figure.canvas.draw()
    assert figure.get_size_inches().tolist() == [12.0, 8.0]
    assert figure.get_layout_engine() is engine
    for ax in (given, other):
        handles, labels = ax.get_legend_handles_labels()
        assert len(handles) == len(labels) == len(set(labels)) > 2
        box = ax.get_legend()
        assert (box is None) == (legend is False)
        if box is not None:
            # Curves that lie on each other are listed behind all else.
            assert sorted(text.get_text() for text in box.get_texts()) == sorted(labels)
            at = box.get_window_extent()
            frame = ax.get_window_extent()
            if legend == "outside":
                assert not at.overlaps(frame)
            else:
                assert frame.padded(1.0).count_contains(at.corners()) == 4
            if layout:
                assert figure.bbox.padded(1.0).count_contains(at.corners()) == 4


def test_a_legend_of_ones_own_has_the_same_entries(figure_4):
    _, given = plt.subplots(figsize=(12, 8))
    figure_4.plot(given, legend=False)
    own = given.legend(loc="lower right")
    given.figure.canvas.draw()
    _, other = plt.subplots(figsize=(12, 8))
    figure_4.plot(other)
    assert sorted(text.get_text() for text in own.get_texts()) == sorted(
        text.get_text() for text in other.get_legend().get_texts()
    )


def test_nothing_of_a_figure_of_its_own_lies_on_a_legend(klepp):
    axes = klepp.limits("mu_1", 0, 0.8, both_directions=True).plot()
    figure = axes[0].figure
    figure.canvas.draw()
    frames = [ax.get_window_extent() for ax in axes]
    boxes = [ax.get_legend().get_window_extent() for ax in axes]
    titles = [ax._left_title.get_window_extent() for ax in axes]
    names = [ax.xaxis.label.get_window_extent() for ax in axes]
    flags = [text.get_window_extent() for ax in axes for text in ax.texts]
    for box in boxes:
        assert not any(box.overlaps(other) for other in [*frames, *titles, *names, *flags])
        assert figure.bbox.padded(1.0).count_contains(box.corners()) == 4
    assert not boxes[0].overlaps(boxes[1])


def test_several_panels_are_several_axes(klepp):
    both = klepp.limits("mu_1", 0, 0.8, both_directions=True)
    axes = both.plot()
    assert isinstance(axes, np.ndarray) and axes.shape == (2,)
    assert axes[0].get_title(loc="left") == "Moving as in the model"
    _, given = plt.subplots(1, 2)
    assert list(both.plot(given)) == list(given)
    _, one = plt.subplots()
    with pytest.raises(ValueError, match="ax must be 2 Axes for this plot, not 1"):
        both.plot(one)


def test_a_design_shows_its_band_and_the_model():
    ax = Model.gallery("drawer").size("L", "200 mm", "900 mm", margin=2).plot()
    assert ax.get_xlabel() == "L in mm"
    assert {"safety factor", "wanted: 2", "the model", "the wanted safety factor is reached"} <= set(legend_texts(ax))
    # 4 mu a = 360 mm.
    (band,) = [each for each in ax.get_children() if each.get_gid() == "band"]
    assert list(band.get_xdata()) == pytest.approx([360.0, 900.0])


def test_efforts_are_drawn_over_a_range_only():
    drawer = Model.gallery("drawer")
    axes = drawer.drive("mu", (0, 1)).plot()
    assert [ax.get_ylabel() for ax in axes] == ["effort of push in N", "efficiency in %"]
    with pytest.raises(ValueError, match="ask with a range"):
        drawer.drive().plot()


def test_a_map_has_its_pixels_and_words(klepp):
    report = klepp.map(mu_1=(0, 0.8), alpha=("60 deg", "88 deg"), colour_by="jam", size=(40, 30))
    pixels = report.pixels()
    assert pixels.shape == (30, 40)
    assert [np.sum(pixels == index) for index in range(len(report.classes))] == [
        each.pixels for each in report.classes
    ]
    ax = report.plot()
    assert ax.get_xlabel() == "mu_1" and ax.get_ylabel() == "alpha in deg"
    (image,) = ax.images
    assert image.get_extent() == pytest.approx([0.0, 0.8, 60.0, 88.0])
    fills = [each.fill for each in report._answer.drawn_map("light").classes]
    assert np.array_equal(np.asarray(image.get_array()), np.array([to_rgb(fill) for fill in fills])[pixels])
    texts = legend_texts(ax)
    assert all(any(each.words in text for text in texts) for each in report.classes)
    _, given = plt.subplots()
    assert report.plot(given) is given


def test_locked_parts_of_a_map_are_hatched():
    ax = Model.gallery("drawer").map(mu=(0, 1), L=("200 mm", "500 mm"), colour_by="margin", size=(20, 10)).plot()
    assert any(patch.get_hatch() for patch in ax.patches)
    ax.figure.canvas.draw()


def test_a_motion_has_panels_over_time_and_a_phase_portrait():
    motion = Model.gallery("frictional-oscillator").simulate(1.0)
    axes = motion.plot()
    assert [ax.get_xlabel() for ax in axes] == ["t in s"] * 3
    assert [ax.get_ylabel() for ax in axes] == ["x in m", "normal force in N", "energy in J"]
    # The energy lost by friction ends where the report says.
    portrait = motion.plot(phase_portrait=True)
    assert isinstance(portrait, Axes)
    assert {"start"} <= set(legend_texts(portrait))
    portrait.figure.canvas.draw()


def test_a_sweep_is_drawn_over_what_is_varied(klepp):
    sweep = klepp.sweep(mu_1="0..0.8:81")
    ax = sweep.plot()
    assert ax.get_xlabel() == "mu_1" and ax.get_ylabel() == "normal force in N"
    assert {"upper", "lower.front", "lower.rear"} <= set(legend_texts(ax))
    rows = sweep.to_numpy()
    lowest = min(line.get_ydata().min() for line in ax.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 2)
    first = rows[rows["branch"] == 1]
    forces = [first[f"normal_force.{contact}"].min() for contact in sweep.contacts]
    assert lowest == pytest.approx(min(forces), abs=0.1)
    with pytest.raises(ValueError, match="the model has no such quantity"):
        sweep.plot(quantity="effort")
    with pytest.raises(ValueError, match="quantity must be 'normal-force'"):
        sweep.plot(quantity="force")
    with pytest.raises(ValueError, match="one varied quantity"):
        klepp.sweep(mu_1=[0.1, 0.2], mu_2=[0.1, 0.2]).plot()


def test_samples_are_drawn_as_histograms():
    sweep = Model.gallery("drawer").sweep(samples=2000, mu="normal(0.6, 0.05)", seed=3)
    ax = sweep.plot(quantity="effort")
    assert ax.get_xlabel() == "effort of push in N" and ax.get_ylabel() == "share of samples in %"
    shares = sum(patch.get_height() for patch in ax.patches)
    solved = sweep.tally.points - sweep.tally.solutions.get(0, 0)
    # At most 2.5 % of the values are left out at either end.
    assert 0.95 * solved / 20 - 0.1 <= shares <= solved / 20


def test_themes_have_the_colours_of_the_library(figure_4):
    for name in ("light", "dark"):
        theme = slideway._slideway.theme(name)
        ax = figure_4.plot(theme=name)
        assert to_hex(ax.get_facecolor()) == theme.background
        assert to_hex(ax.xaxis.label.get_color()) == theme.ink
    with pytest.raises(ValueError, match="theme must be 'light' or 'dark'"):
        figure_4.plot(theme="blue")


def test_dollars_in_a_title_are_no_formula():
    text = slideway.Model.gallery("drawer").text.replace('title = "A drawer pushed off-centre"', 'title = "1 $ and 2 $"')
    ax = Model.parse(text).limits("mu", 0, 1).plot()
    ax.figure.canvas.draw()
    assert any("1 \\$ and 2 \\$" in each.get_text() for each in ax.texts)


def test_what_panels_show_does_not_depend_on_matplotlib(figure_4):
    wide, narrow = (figure_4._answer.plot().drawn(width, 380.0)[0] for width in (700.0, 300.0))
    assert wide.x == narrow.x and wide.y == narrow.y
    assert plotting.plot_figure(figure_4._answer.plot().figure(), lambda *_: [wide]).get_xlim() == wide.x
