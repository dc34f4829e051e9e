import numpy as np

from hlr.tables.line_classes import by_number
from hlr.writers.strokes import strokes
from support.drawings import drawing, line, sample


def layers_in(found):
    return tuple(inked.layer for inked in found.inked)


def only(layers):
    (layer,) = layers
    return layer


def points(layer):
    return layer.rows()["points"].tolist()


def edges(layer):
    return layer.ties[:, 1].tolist()


def test_hidden_layers_come_first_and_wide_ones_last():
    rows = by_number()
    layers = [(layer.visible, rows[layer.kind].place) for layer in layers_in(strokes(sample()))]
    assert layers == sorted(layers)
    assert {visible for visible, _ in layers} == {False, True}


def test_pieces_of_an_edge_that_touch_become_one_stroke():
    layer = only(layers_in(strokes(drawing([line([[0, 0], [1, 0]], edge=3), line([[1, 0], [1, 1]], edge=3)]))))
    assert points(layer) == [[0, 0], [1000, 0], [1000, 1000]]
    assert layer.starts.tolist() == [0, 3]
    assert edges(layer) == [3]


def test_pieces_of_different_edges_or_parts_stay_apart():
    for other in ({"edge": 4}, {"edge": 3, "part": 1}, {"edge": 3, "visible": False}, {"edge": 3, "kind": "seam"}):
        lines = [line([[0, 0], [1, 0]], edge=3), line([[1, 0], [1, 1]], **other)]
        assert sum(len(layer.closed) for layer in layers_in(strokes(drawing(lines)))) == 2, other


def test_pieces_that_do_not_touch_stay_apart():
    layer = only(layers_in(strokes(drawing([line([[0, 0], [1, 0]], edge=3), line([[1.001, 0], [2, 1]], edge=3)]))))
    assert layer.starts.tolist() == [0, 2, 4]


def test_a_loop_in_one_line_or_in_two_is_closed():
    square = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]
    for lines in ([line(square)], [line(square[:3]), line(square[2:])]):
        layer = only(layers_in(strokes(drawing(lines))))
        assert layer.closed.tolist() == [True]
        assert len(points(layer)) == 4


def test_a_loop_stays_closed_where_another_line_goes_on_from_it():
    square = line([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]])
    tail = line([[0, 0], [-1, -1]])
    assert only(layers_in(strokes(drawing([square, tail])))).closed.tolist() == [True, False]
    head = line([[-1, -1], [0, 0]])
    assert only(layers_in(strokes(drawing([head, square])))).closed.tolist() == [False, True]


def test_there_and_back_is_not_a_loop():
    layer = only(layers_in(strokes(drawing([line([[0, 0], [1, 0], [0, 0]])]))))
    assert layer.closed.tolist() == [False]
    assert len(points(layer)) == 3


def test_points_below_the_grid_are_left_out():
    lines = [line([[0, 0], [0.0001, 0], [5, 0]]), line([[3, 3], [3.0001, 3]]), line([[7, 7], [8, 8]], edge=1)]
    layer = only(layers_in(strokes(drawing(lines))))
    assert points(layer) == [[0, 0], [5000, 0], [7000, 7000], [8000, 8000]]
    assert edges(layer) == [-1, 1]


def test_a_layer_with_nothing_left_is_no_layer():
    assert layers_in(strokes(drawing([line([[3, 3], [3.0001, 3]])]))) == ()


def test_the_page_is_the_drawing_and_a_margin():
    page = strokes(drawing([line([[-10, 20], [30, 50]])]))
    assert np.array([page.left, page.bottom, page.width, page.height]).tolist() == [-15.5, 14.5, 51.0, 41.0]


def test_an_empty_drawing_is_an_empty_page():
    page = strokes(drawing([]))
    assert (page.inked, page.width, page.height) == ((), 11.0, 11.0)
