"""Axes of pictures: ticks of logarithmic ones, short and long."""

import dataclasses
import itertools

import pytest
from matplotlib.figure import Figure

from microslip.figures.names import called
from microslip.figures.result import result_figure
from microslip.figures.style import framed, headline, plain_logarithmic
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (0.09, 2.1, ["0.1", "0.2", "0.5", "1", "2"]),
        (3.0, 30.0, ["5", "10", "20"]),
        (0.67, 1.14, ["0.7", "0.8", "0.9", "1", "1.1"]),
        (2.69785, 2.69815, ["2.69785", "2.698", "2.69815"]),
        (1e-6, 2.0, ["$\\mathdefault{10^{-6}}$", "$\\mathdefault{10^{0}}$"]),
    ],
)
def test_logarithmic_axes_have_a_few_readable_ticks(
    low: float, high: float, labels: list[str]
) -> None:
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(low, high))

    plain_logarithmic(axes.xaxis)

    ticks = zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
    shown = [label.get_text() for place, label in ticks if low <= place <= high]
    assert len(shown) <= 8
    assert not axes.get_xticks(minor=True).size
    assert [label for label in shown if label in labels] == labels


def test_a_narrow_range_is_written_without_an_offset() -> None:
    figure = Figure(figsize=(5.0, 3.5), layout="constrained")
    axes = figure.subplots()
    axes.plot([5.0, 5.0001], [0.0, 1.0])

    framed(axes, x="frequency [Hz]", y="amplitude [mm]", title="")

    figure.draw_without_rendering()
    assert not axes.xaxis.get_offset_text().get_text()
    labels = [label.get_window_extent() for label in axes.get_xticklabels()]
    assert 3 <= len(labels) <= 5
    for left, right in itertools.pairwise(labels):
        assert left.x1 < right.x0


def test_a_long_title_stays_within_the_picture() -> None:
    figure = Figure(figsize=(6.0, 4.0), layout="constrained")
    figure.subplots()

    headline(
        figure, "two-blades, " + ", ".join(f"a.value_{n}=1e-{n}" for n in range(20))
    )

    figure.draw_without_rendering()
    title = figure.texts[0].get_window_extent()
    assert title.x0 >= 0.0
    assert title.x1 <= figure.bbox.x1


@pytest.mark.parametrize(
    ("face", "contacts", "title"),
    [
        ("B", ["B1", "B2"], "face B"),
        ("B", ["B"], "face B"),
        ("cubic", ["cubic"], "element cubic"),
        ("spring", ["spring2"], "element spring2"),
        ("shoe", ["shoe-1", "shoe-2"], "element shoe"),
        ("element", ["element-1"], "element-1"),
    ],
)
def test_titles_tell_faces_from_elements(
    face: str, contacts: list[str], title: str
) -> None:
    assert called(face, contacts) == title


@pytest.mark.parametrize("first", ["_x", "a$^$", "$"])
def test_names_of_any_letters_are_drawn_as_they_are(
    small_curve: ResponseCurve, small_history: TimeHistory, first: str
) -> None:
    # legends leave out what begins with "_", and dollars make formulas
    probes = (first, *small_curve.probes[1:])
    contacts = tuple(f"{first}{place}" for place, _ in enumerate(small_curve.contacts))
    curve = dataclasses.replace(small_curve, probes=probes, contacts=contacts)
    march = dataclasses.replace(small_history, probes=probes, contacts=contacts)

    for result in (curve, march):
        figure = result_figure(result, "")
        figure.draw_without_rendering()
        shown = [
            text.get_text()
            for axes in figure.axes
            for text in getattr(axes.get_legend(), "get_texts", list)()
        ]
        assert any(first.replace("$", r"\$") in text for text in shown)
