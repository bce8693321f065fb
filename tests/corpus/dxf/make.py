#!/usr/bin/python3
"""Writes the drawings of this folder and expected.json, with ezdxf (Debian python3-ezdxf 0.18).

What the reader must find is computed from the lines and arcs that ezdxf makes of the drawn entity or, where a contour
is drawn in pieces, of the same outline as one polyline. PYTHONHASHSEED=0 gives the same bytes again.
"""

import json
import math
import pathlib
import random

import ezdxf

HERE = pathlib.Path(__file__).parent
UNITS_MM = {0: 1, 1: 25.4, 2: 304.8, 4: 1, 5: 10, 6: 1000, 9: 0.0254, 13: 0.001}
FLATTENING_MM = 1e-5

ezdxf.options.write_fixed_meta_data_for_testing = True


def drawing(version="R12", units=4):
    doc = ezdxf.new(version)
    if version != "R12":  # which knows no $INSUNITS
        doc.header["$INSUNITS"] = units
    for name in ("OUTLINE", "VOID", "WALL", "NOTE"):
        doc.layers.add(name)
    return doc


def polyline(space, points, layer="OUTLINE", closed=True, **more):
    """Points are (x, y) or (x, y, bulge). LWPOLYLINE, or POLYLINE in R12, which has no other."""
    points = [(*p, 0)[:3] for p in points]
    attributes = {"layer": layer, **more}
    if space.doc.dxfversion == "AC1009":
        return space.add_polyline2d(points, format="xyb", close=closed, dxfattribs=attributes)
    return space.add_lwpolyline(points, format="xyb", close=closed, dxfattribs=attributes)


def lines(space, points, order, layer="OUTLINE"):
    """The polygon as lines, in the given order, every other one backwards."""
    for turn, i in enumerate(order):
        a, b = points[i], points[(i + 1) % len(points)]
        if turn % 2:
            a, b = b, a
        space.add_line(a, b, dxfattribs={"layer": layer})


def points_of(entity, sagitta):
    """The entity in world coordinates, arcs as chords. Not ezdxf.path: it makes circles of Bezier curves."""
    if entity.dxftype() == "CIRCLE":
        return list(entity.flattening(sagitta))
    points = []
    for piece in entity.virtual_entities():
        chords = [piece.dxf.start, piece.dxf.end] if piece.dxftype() == "LINE" else list(piece.flattening(sagitta))
        if points and math.dist(points[-1], chords[0]) > math.dist(points[-1], chords[-1]):
            chords.reverse()
        if len(points) > 1 and math.dist(points[-1], chords[0]) > 1e-6 * sagitta / FLATTENING_MM:
            points.reverse()  # the first piece was an arc that ends where the outline begins
            if math.dist(points[-1], chords[0]) > math.dist(points[-1], chords[-1]):
                chords.reverse()
        points += chords
    return points


def measured(entity, unit=1.0, layer=None):
    """A contour as the reader must give it: its layer, area and extent."""
    points = [(p.x * unit, p.y * unit) for p in points_of(entity, FLATTENING_MM / unit)]
    pairs = list(zip(points, points[1:] + points[:1]))
    return {
        "layer": layer or entity.dxf.layer,
        "area_mm2": abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs)) / 2,
        "perimeter_mm": sum(math.dist(a, b) for a, b in pairs),
        "box_mm": [f(p[i] for p in points) for f in (min, max) for i in (0, 1)],
    }


def as_one(points, unit=1.0, layer="OUTLINE"):
    return measured(polyline(drawing("R2000").modelspace(), points), unit, layer)


EL = [(0, 0), (30, 0), (30, 10), (10, 10), (10, 20), (0, 20)]
QUARTER = math.tan(math.pi / 8)
ROUNDED = [(3, 0), (37, 0, QUARTER), (40, 3), (40, 22, QUARTER), (37, 25), (3, 25, QUARTER), (0, 22), (0, 3, QUARTER)]


def rounded_in_pieces(space, layer="OUTLINE"):
    """ROUNDED as lines and arcs, shuffled."""
    add = [lambda a=a, b=b: space.add_line(a, b, dxfattribs={"layer": layer})
           for a, b in [((3, 0), (37, 0)), ((40, 22), (40, 3)), ((37, 25), (3, 25)), ((0, 3), (0, 22))]]
    add += [lambda c=c, f=f, t=t: space.add_arc(c, 3, f, t, dxfattribs={"layer": layer})
            for c, f, t in [((37, 3), 270, 0), ((37, 22), 0, 90), ((3, 22), 90, 180), ((3, 3), 180, 270)]]
    random.Random(5).shuffle(add)
    for one in add:
        one()


good = []
bad = []


def keep(name, doc, contours, **more):
    doc.saveas(HERE / "good" / f"{name}.dxf")
    good.append({"name": name, "contours": contours, **more})


def refuse(name, doc, message, **more):
    if isinstance(doc, bytes):
        (HERE / "bad" / f"{name}.dxf").write_bytes(doc)
    else:
        doc.saveas(HERE / "bad" / f"{name}.dxf")
    bad.append({"name": name, "message": message, **more})


def versions():
    for version in ("R12", "R2000", "R2010"):
        doc = drawing(version)
        drawn = polyline(doc.modelspace(), EL)
        keep(f"polyline_{version.lower()}", doc, [measured(drawn)])
        doc = drawing(version)
        lines(doc.modelspace(), EL, range(6))
        keep(f"lines_{version.lower()}", doc, [as_one(EL)])
    for version in ("R12", "R2010"):
        doc = drawing(version)
        rounded_in_pieces(doc.modelspace())
        keep(f"rounded_in_pieces_{version.lower()}", doc, [as_one(ROUNDED)])


def entities():
    doc = drawing()
    drawn = doc.modelspace().add_circle((12, -7), 6.5, dxfattribs={"layer": "OUTLINE"})
    keep("circle", doc, [measured(drawn)])

    doc = drawing("R2000")
    drawn = polyline(doc.modelspace(), ROUNDED)
    keep("bulges", doc, [measured(drawn)])

    inward = [(0, 0), (40, 0), (40, 20, -0.5), (0, 20)]
    doc = drawing("R2000")
    keep("bulge_inward", doc, [measured(polyline(doc.modelspace(), inward))])

    major = [(0, 0), (10, 0, 2.5), (10, 8), (0, 8)]  # an arc of more than half a turn
    doc = drawing("R2000")
    keep("bulge_over_one", doc, [measured(polyline(doc.modelspace(), major))])
    doc = drawing()
    keep("bulge_over_one_r12", doc, [measured(polyline(doc.modelspace(), major))])

    doc = drawing()
    space = doc.modelspace()
    space.add_arc((5, 5), 4, 200, 20, dxfattribs={"layer": "OUTLINE"})
    space.add_arc((5, 5), 4, 20, 200, dxfattribs={"layer": "OUTLINE"})
    circle = drawing().modelspace().add_circle((5, 5), 4, dxfattribs={"layer": "OUTLINE"})
    keep("circle_as_two_arcs", doc, [measured(circle)])
    doc = drawing()
    doc.modelspace().add_arc((5, 5), 4, 90, 450, dxfattribs={"layer": "OUTLINE"})
    keep("circle_as_one_arc", doc, [measured(circle)])
    doc = drawing("R2000")
    polyline(doc.modelspace(), [(1, 5, 1), (9, 5, 1)])
    keep("circle_as_polyline", doc, [measured(circle)])

    doc = drawing()
    space = doc.modelspace()
    space.add_arc((0, 0), 10, 300, 60, dxfattribs={"layer": "OUTLINE"})  # over angle 0
    space.add_line((5, 10 * math.sin(math.pi / 3)), (5, -10 * math.sin(math.pi / 3)), dxfattribs={"layer": "OUTLINE"})
    half = 10 * math.sin(math.pi / 3)
    keep("arc_over_zero", doc, [as_one([(5, -half, math.tan(math.radians(120) / 4)), (5, half)])])

    doc = drawing("R2000")
    doc.modelspace().add_polyline3d([(x, y, 0) for x, y in EL], close=True, dxfattribs={"layer": "OUTLINE"})
    keep("polyline_3d_flat", doc, [as_one(EL)])

    doc = drawing("R2000")
    open_but_shut = polyline(doc.modelspace(), EL + [EL[0]], closed=False)
    keep("polyline_not_flagged_closed", doc, [measured(open_but_shut)])

    doc = drawing("R2000")
    space = doc.modelspace()
    polyline(space, EL[:4], closed=False)
    polyline(space, [EL[0], EL[5], EL[4], EL[3]], closed=False)
    keep("two_open_polylines", doc, [as_one(EL)])

    doc = drawing("R2000")
    drawn = polyline(doc.modelspace(), [(10, 0), (30, 0, 0.3), (30, 12), (10, 9)], extrusion=(0, 0, -1))
    keep("mirrored_extrusion", doc, [measured(drawn)])
    doc = drawing("R2000")
    space = doc.modelspace()
    space.add_arc((-20, 3), 5, 90, 270, dxfattribs={"layer": "OUTLINE", "extrusion": (0, 0, -1)})  # seen from below
    space.add_line((20, 8), (20, -2), dxfattribs={"layer": "OUTLINE"})
    keep("mirrored_arc", doc, [as_one([(20, -2, 1), (20, 8)])])


def units():
    for code, size in UNITS_MM.items():
        doc = drawing("R2000", code)
        scaled = [(x / size, y / size) for x, y in EL]
        drawn = polyline(doc.modelspace(), scaled)
        keep(f"units_{code}", doc, [measured(drawn, size)])
    doc = drawing("R2000", 1)
    drawn = doc.modelspace().add_circle((1, 2), 0.5, dxfattribs={"layer": "OUTLINE"})
    keep("circle_in_inches", doc, [measured(drawn, 25.4)])


def untidy():
    doc = drawing()
    lines(doc.modelspace(), EL, [3, 0, 5, 2, 4, 1])
    keep("lines_shuffled", doc, [as_one(EL)])

    doc = drawing()
    space = doc.modelspace()
    lines(space, EL, range(6))
    lines(space, EL, [5, 2])  # again, one of them backwards
    space.add_line((4, 4), (4, 4), dxfattribs={"layer": "OUTLINE"})
    space.add_line(EL[1], EL[1], dxfattribs={"layer": "OUTLINE"})
    keep("repeated_and_empty_lines", doc, [as_one(EL)])

    doc = drawing("R2000")
    space = doc.modelspace()
    drawn = polyline(space, EL)
    polyline(space, EL[2:] + EL[:2])
    lines(space, EL, range(6))
    circle = space.add_circle((5, 5), 2, dxfattribs={"layer": "OUTLINE"})
    space.add_circle((5, 5), 2, dxfattribs={"layer": "OUTLINE"})
    keep("repeated_contours", doc, [measured(drawn), measured(circle)])

    doc = drawing()
    space = doc.modelspace()
    for i, (a, b) in enumerate(zip(EL, EL[1:] + EL[:1])):  # gaps of up to 0.0008 mm
        d = 0.0004 * (-1) ** i
        space.add_line((a[0] + d, a[1]), (b[0] + d, b[1]), dxfattribs={"layer": "OUTLINE"})
    keep("small_gaps", doc, [as_one(EL)], slack_mm=0.001)

    doc = drawing("R2000")
    space = doc.modelspace()
    drawn = polyline(space, EL)
    space.add_text("NOT CUT", dxfattribs={"layer": "OUTLINE", "height": 2})
    space.add_mtext("nor this", dxfattribs={"layer": "OUTLINE"})
    space.add_point((3, 3), dxfattribs={"layer": "OUTLINE"})
    space.add_xline((0, 0), (1, 1), dxfattribs={"layer": "OUTLINE"})
    space.add_linear_dim((0, -5), (0, 0), (30, 0)).render()
    hatch = space.add_hatch(dxfattribs={"layer": "OUTLINE"})
    hatch.paths.add_polyline_path([(1, 1), (2, 1), (2, 2)])
    doc.layout("Layout1").add_line((0, 0), (9, 9), dxfattribs={"layer": "OUTLINE"})  # paper space
    keep("annotated", doc, [measured(drawn)])

    doc = drawing("R2000")
    space = doc.modelspace()
    drawn = polyline(space, EL)
    for name, hide in (("OFF", "off"), ("FROZEN", "freeze")):
        getattr(doc.layers.add(name), hide)()
        space.add_line((1, 1), (50, 50), dxfattribs={"layer": name})
    block = doc.blocks.new("UNUSED")
    block.add_line((0, 0), (7, 7), dxfattribs={"layer": "OUTLINE"})
    keep("hidden_things", doc, [measured(drawn)])

    doc = drawing("R2000")
    space = doc.modelspace()
    one = polyline(space, [(0, 0), (10, 0), (10, 10), (0, 10)], layer="VOID")
    other = polyline(space, [(5, 5), (15, 5), (15, 15), (5, 15)], layer="Wall")
    space.add_spline([(0, 0), (5, 9), (9, 0)], dxfattribs={"layer": "NOTE"})
    keep("two_layers", doc, [measured(one), measured(other, layer="WALL")], layers=["VOID", "WALL"])


def parts():
    doc = drawing("R2010")
    space = doc.modelspace()
    holes = [space.add_circle((10, 12), 3, dxfattribs={"layer": "HOLES"}),
             space.add_circle((30, 12), 3.2, dxfattribs={"layer": "HOLES"})]
    outline = polyline(space, ROUNDED)
    contours = [measured(holes[0]), measured(holes[1]), measured(outline)]
    keep("part_with_holes", doc, contours,
         part={"area_mm2": contours[2]["area_mm2"] - contours[0]["area_mm2"] - contours[1]["area_mm2"], "holes": 2})


def bad_contours():
    doc = drawing("R2000", 1)
    polyline(doc.modelspace(), EL, closed=False)
    refuse("open_in_inches", doc, "an open contour on layer 'OUTLINE': its ends (0, 0) mm, in the drawing (0, 0) "
                                  "inches and (0, 508) mm, in the drawing (0, 20) inches are 508 mm apart")
    doc = drawing()
    lines(doc.modelspace(), EL, range(5))
    refuse("open_lines", doc, "its ends (0, 0) mm and (0, 20) mm are 20 mm apart")
    doc = drawing()
    space = doc.modelspace()
    for i, (a, b) in enumerate(zip(EL, EL[1:] + EL[:1])):
        space.add_line(a, (b[0], b[1] + (0.01 if i == 2 else 0)), dxfattribs={"layer": "OUTLINE"})
    refuse("gap_too_wide", doc, "are 0.01 mm apart")
    doc = drawing("R2000")
    polyline(doc.modelspace(), [(0, 0), (10, 10), (10, 0), (0, 6)])
    refuse("bow_tie", doc, "crosses or touches itself at (3.75, 3.75) mm")
    doc = drawing("R2000")
    polyline(doc.modelspace(), [(0, 0), (20, 0), (20, 10), (10, 0), (0, 10)])
    refuse("touches_itself", doc, "crosses or touches itself at (10, 0) mm")
    doc = drawing("R2000")
    polyline(doc.modelspace(), [(0, 0), (20, 0), (20, 10), (30, 10), (10, 10), (0, 10)])
    refuse("folds_back", doc, "crosses or touches itself at")
    doc = drawing()
    space = doc.modelspace()
    lines(space, EL, range(6))
    space.add_line(EL[0], EL[3], dxfattribs={"layer": "OUTLINE"})
    refuse("branches", doc, "3 lines that meet at (0, 0) mm on layer 'OUTLINE'")
    doc = drawing()
    space = doc.modelspace()
    space.add_circle((0, 0), 5)
    space.add_circle((6, 0), 5)
    refuse("circles_cross", doc, "two contours on layer '0' that cross or touch at (3, ")
    doc = drawing("R2000")
    polyline(doc.modelspace(), [(0, 0), (10, 0), (20, 0)])
    refuse("no_area", doc, "a contour without area on layer 'OUTLINE'")
    doc = drawing()
    space = doc.modelspace()
    space.add_circle((0, 0), 5)
    space.add_circle((20, 0), 5)
    refuse("two_parts", doc, "one more outermost contour, on layer '0' at (25, 0) mm", part=True)
    doc = drawing()
    space = doc.modelspace()
    for radius in (9, 6, 3):
        space.add_circle((0, 0), radius)
    refuse("island_in_hole", doc, "a contour inside of a hole, on layer '0' at (3, 0) mm", part=True)
    doc = drawing("R2000")
    doc.layers.add("HIDDEN").freeze()
    doc.modelspace().add_circle((0, 0), 5, dxfattribs={"layer": "HIDDEN"})
    refuse("nothing_seen", doc, "a drawing without a contour (1 hidden entities do not count)", part=True)


def bad_entities():
    doc = drawing("R2000")
    space = doc.modelspace()
    for _ in range(2):
        space.add_spline([(0, 0), (5, 9), (9, 0)], dxfattribs={"layer": "OUTLINE"})
    space.add_ellipse((7, 8), (4, 0), 0.5, dxfattribs={"layer": "OUTLINE"})
    doc.blocks.new("SCREW")
    space.add_blockref("SCREW", (2, 3), dxfattribs={"layer": "VOID"})
    refuse("foreign_entities", doc, "2 unsupported SPLINE on layer 'OUTLINE', the first",
           also=["1 unsupported ELLIPSE on layer 'OUTLINE', the first at (7, 8) mm",
                 "1 unsupported INSERT on layer 'VOID', the first at (2, 3) mm", "explode the block references"])
    doc = drawing("R2000")
    doc.modelspace().add_line((0, 0, 0), (5, 5, 3), dxfattribs={"layer": "OUTLINE"})
    refuse("line_in_space", doc, "1 LINE with z other than 0 on layer 'OUTLINE', the first at (0, 0) mm")
    doc = drawing("R2000")
    polyline(doc.modelspace(), EL, elevation=2)
    refuse("raised_polyline", doc, "1 LWPOLYLINE with z other than 0")
    doc = drawing("R2000")
    doc.modelspace().add_circle((0, 0), 5, dxfattribs={"extrusion": (0, 1, 1)})
    refuse("tilted_circle", doc, "1 CIRCLE tilted out of the drawing's plane on layer '0'")
    doc = drawing("R2000")
    doc.modelspace().add_polyface(dxfattribs={"layer": "OUTLINE"})
    refuse("polyface", doc, "1 unsupported POLYLINE meshes on layer 'OUTLINE'")
    doc = drawing("R2000", 3)
    polyline(doc.modelspace(), EL)
    refuse("miles", doc, "the unit $INSUNITS '3', expected 0 (none: mm), 1 (inch)")


def section(*groups):
    return "\n".join(str(g) for g in (0, "SECTION", 2, "ENTITIES", *groups, 0, "ENDSEC", 0, "EOF")).encode() + b"\n"


def bad_files():
    doc = drawing("R2000")
    polyline(doc.modelspace(), EL)
    doc.saveas(HERE / "bad" / "binary.dxf", fmt="bin")
    bad.append({"name": "binary", "message": "a binary DXF drawing, expected one saved as ASCII (text) DXF"})
    whole = (HERE / "good" / "lines_r12.dxf").read_bytes()
    refuse("truncated", whole[: len(whole) - 40], "the end of the text, expected the drawing to go on up to EOF")
    refuse("empty", b"", "an empty file, expected a DXF drawing")
    refuse("dwg", b"AC1015\0\0\0\0\0\0" + bytes(range(64)), "a DWG drawing, expected one saved as ASCII (text) DXF")
    refuse("garbage", b"Lorem ipsum\ndolor sit amet\n", "garbage.dxf:1:1: 'Lorem ipsum', expected a DXF group code")
    refuse("no_entities", b"0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", "a text without an ENTITIES section")
    refuse("words_for_numbers", section(0, "LINE", 8, 0, 10, "abc", 20, "1,5", 11, "0x10", 21, "nan"),
           "words_for_numbers.dxf:10:1: 'abc' for group 10, expected a number",
           also=["'1,5' for group 20", "'0x10' for group 11", "'nan' for group 21"])
    refuse("missing_group", section(0, "LINE", 8, 0, 10, 1, 20, 2, 11, 3), "a LINE without group 21")
    refuse("no_radius", section(0, "CIRCLE", 8, 0, 10, 1, 20, 2, 40, -3), "1 CIRCLE with a radius of -3 on layer '0'")
    refuse("far_away", section(0, "CIRCLE", 8, 0, 10, "1e12", 20, 2, 40, 3), "expected a number of at most 1e9 mm")
    refuse("a_million_chords", section(0, "CIRCLE", 8, 0, 10, 0, 20, 0, 40, "1e9"),
           "a drawing of more than 1000000 points")
    # 90 lies about the number of corners: the corners that are there count.
    corners = [g for x, y in EL for g in (10, x, 20, y)]
    lying = section(0, "LWPOLYLINE", 8, "OUTLINE", 90, 2000000000, 70, 1, *corners)
    (HERE / "good" / "corner_count_lies.dxf").write_bytes(lying)
    good.append({"name": "corner_count_lies", "contours": [as_one(EL)]})


for folder in ("good", "bad"):
    (HERE / folder).mkdir(exist_ok=True)
    for old in (HERE / folder).glob("*.dxf"):
        old.unlink()
for make in (versions, entities, units, untidy, parts, bad_contours, bad_entities, bad_files):
    make()
(HERE / "expected.json").write_text(json.dumps({"good": good, "bad": bad}, indent=1) + "\n")
