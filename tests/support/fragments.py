"""Views as another program writes them: groups of paths, the visible lines and then thinner ones, which are hidden."""

from hlr.drawing.chords import chords


def fragment(
    drawing, *, shift=(0.0, 0.0), scale=1.0, keep=lambda line: True, seen=lambda line: line.visible, chord_mm=0.002
):
    """The SVG fragment of a drawing, y down, moved and scaled.

    keep: which lines; seen: which are drawn as visible; chord_mm: how far straight pieces lie off their curves
    """
    out = []
    for visible, width in ((True, 0.7), (False, 0.35)):
        lines = [line for line in drawing.lines if keep(line) and seen(line) == visible]
        paths = "".join(f'<path d="{_path(line, shift, scale, chord_mm)}"/>\n' for line in lines)
        out.append(f'<g fill="none" stroke="rgb(0, 0, 0)" stroke-width="{width}">\n{paths}</g>\n')
    return "".join(out)


def _path(line, shift, scale, chord_mm):
    points = line.points if line.curve is None else chords(line.curve, chord_mm)
    places = [f"{scale * x + shift[0]:.6g} {-scale * y - shift[1]:.6g}" for x, y in points.tolist()]
    return f"M{places[0]} L{' '.join(places[1:])}"
