#!/usr/bin/python3
"""Writes the drawings of this folder with ezdxf (Debian python3-ezdxf 0.18). The parts and tracks are made up.

bracket.dxf       a stamped steel bracket, 32 x 20 mm, corners of 3 mm, one corner cut off, two holes of which the
                  slot tells the faces apart. For "part": {"file": "drawings/bracket.dxf"}.
todays_track.dxf  a track of 40 mm as it stands in the shop: a slot with round ends, and a notch in the free edge. For
                  a feature {"type": "drawing", "file": "drawings/todays_track.dxf"}: x = 0 is the feature's start,
                  y = 0 the wall.
"""

import math
import pathlib

import ezdxf

HERE = pathlib.Path(__file__).parent
QUARTER = math.tan(math.pi / 8)  # bulge of a quarter of a circle
MM = 4

ezdxf.options.write_fixed_meta_data_for_testing = True


def drawing(*layers):
    doc = ezdxf.new("R2000")
    doc.header["$INSUNITS"] = MM
    for name, colour in layers:
        doc.layers.add(name, color=colour)
    return doc, doc.modelspace()


def bracket():
    doc, space = drawing(("OUTLINE", 7), ("HOLES", 1), ("DIMENSIONS", 3))
    outline = [(3, 0), (29, 0, QUARTER), (32, 3), (32, 12), (24, 20), (3, 20, QUARTER), (0, 17), (0, 3, QUARTER)]
    space.add_lwpolyline(outline_with_zeros(outline), format="xyb", close=True, dxfattribs={"layer": "OUTLINE"})
    space.add_circle((26, 6), 1.6, dxfattribs={"layer": "HOLES"})
    # A slot of 3.2 x 8 mm, drawn in pieces as CAD programs export it.
    for y, a, b in ((11.4, 6, 10.8), (8.2, 10.8, 6)):
        space.add_line((a, y), (b, y), dxfattribs={"layer": "HOLES"})
    space.add_arc((6, 9.8), 1.6, 90, 270, dxfattribs={"layer": "HOLES"})
    space.add_arc((10.8, 9.8), 1.6, 270, 90, dxfattribs={"layer": "HOLES"})
    space.add_linear_dim((0, -6), (0, 0), (32, 0), dxfattribs={"layer": "DIMENSIONS"}).render()
    space.add_linear_dim((-6, 0), (0, 0), (0, 20), angle=90, dxfattribs={"layer": "DIMENSIONS"}).render()
    space.add_text("BRACKET, STEEL 1.5 MM", dxfattribs={"layer": "DIMENSIONS", "height": 2}).set_pos((0, -12))
    doc.saveas(HERE / "bracket.dxf")


def todays_track():
    doc, space = drawing(("TRACK", 7), ("VOID", 1), ("NOTE", 3))
    space.add_line((-40, 0), (160, 0), dxfattribs={"layer": "TRACK"})
    space.add_line((-40, 40), (160, 40), dxfattribs={"layer": "TRACK"})
    slot = [(4, 9), (41, 9, 1), (41, 17), (4, 17, 1)]
    space.add_lwpolyline(outline_with_zeros(slot), format="xyb", close=True, dxfattribs={"layer": "VOID"})
    # The notch is drawn beyond the free edge, so that nothing is left of it.
    notch = [(78, 42), (78, 24), (80, 22), (112, 14), (118, 42)]
    for a, b in zip(notch, notch[1:] + notch[:1]):
        space.add_line(a, b, dxfattribs={"layer": "VOID"})
    space.add_text("TRACK AS BUILT, WALL AT Y = 0", dxfattribs={"layer": "NOTE", "height": 3}).set_pos((-40, -8))
    doc.saveas(HERE / "todays_track.dxf")


def outline_with_zeros(points):
    return [(*p, 0)[:3] for p in points]


bracket()
todays_track()
