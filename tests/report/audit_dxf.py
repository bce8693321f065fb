#!/usr/bin/python3
"""Reads a DXF drawing with ezdxf and says what it finds, or fails: audit_dxf.py FILE.

One line for the header (version, $INSUNITS), then one for each closed contour: layer, corners, area. Only the wall's
face (layer FACE) is an open line.
"""

import sys

import ezdxf

doc = ezdxf.readfile(sys.argv[1])
auditor = doc.audit()
if auditor.errors or auditor.fixes:
    sys.exit("; ".join(f"{e.code} {e.message}" for e in [*auditor.errors, *auditor.fixes]))
print(doc.dxfversion, doc.header["$INSUNITS"])
for entity in doc.modelspace():
    if entity.dxftype() != "POLYLINE":
        continue
    if not entity.is_closed:
        if entity.dxf.layer != "FACE":
            sys.exit("an open polyline on layer " + entity.dxf.layer)
        continue
    points = [p.vec2 for p in entity.points()]
    area = abs(sum(a.x * b.y - b.x * a.y for a, b in zip(points, points[1:] + points[:1]))) / 2
    print(entity.dxf.layer, len(points), f"{area:.9f}")
