"""A sentence above a picture and names at its lines: nothing leaves the picture, nothing lies on anything else."""

from itertools import combinations

import numpy as np
from matplotlib.colors import to_rgb

from twintube.report.common.framed import WIDTH, framed, name_lines, worn, wrapped
from twintube.report.common.style import canvas, png


def test_a_long_sentence_and_its_key_stay_within_the_picture_and_above_the_panels() -> None:
    figure, ((ax,),) = canvas(1, 1, (WIDTH, 3.0))
    ax.plot([0, 1], [0, 1], label="of $x")
    before = figure.get_size_inches()[1]
    framed(figure, "WITH 40 % OIL AND LESS, " * 6, "Under these conditions. " * 20, "Assumed: all of it. " * 20, ax)
    assert figure.get_size_inches()[1] > before
    png(figure)
    boxes = [text.get_window_extent() for text in figure.texts] + [figure.legends[0].get_window_extent()]
    assert all(box.x0 >= 0 and box.x1 <= figure.bbox.x1 and box.y0 >= 0 and box.y1 <= figure.bbox.y1 for box in boxes)
    panel = ax.get_tightbbox()
    assert not any(box.overlaps(panel) for box in boxes)
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))


def test_names_at_lines_do_not_overlap_and_keep_their_order() -> None:
    figure, ((ax,),) = canvas(1, 1, (WIDTH, 3.0))
    ax.set_ylim(0, 1)
    name_lines(ax, [(0.5, "b", "k"), (0.49, "a", "k"), (0.51, "c", "k"), (0.9, "d", "k")])
    png(figure)
    boxes = [text.get_window_extent() for text in ax.texts]
    assert [text.get_text() for text in ax.texts] == ["a", "b", "c", "d"]
    assert all(upper.y0 >= lower.y1 for lower, upper in zip(boxes, boxes[1:], strict=False))


def test_less_oil_is_darker_which_every_eye_sees() -> None:
    light = [np.dot(to_rgb(worn(level)), (0.2126, 0.7152, 0.0722)) for level in (1.0, 0.9, 0.8, 0.6, 0.4, 0.3)]
    assert light == sorted(light, reverse=True)
    assert worn(0.1) == worn(0.3)


def test_a_number_stays_with_its_unit() -> None:
    assert all(not line.endswith("10") for line in wrapped("of 10 s " * 60, 9.0, WIDTH))
