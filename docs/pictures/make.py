"""Draws the pictures of docs/: python3 docs/pictures/make.py (standard library only).

Lengths in mm, y upwards, as in the problem format. The support hulls and margins are computed here, apart from the
program: the part is clipped by the half-planes around a rectangular void.
"""
import math
import os

L_PART = [(0, 0), (0, -30.491329), (-10.4514, -30.491329), (-10.4514, -9.52185), (-40.62175, -9.52185), (-40.62175, 0)]
EL = [(0, 0), (30, 0), (30, 10), (10, 10), (10, 20), (0, 20)]

STYLES = {
    "metal": 'fill="#dce1e7" stroke="#6b7683" stroke-width="1.2" fill-rule="evenodd"',
    "wall": 'fill="#59636f"',
    "part": 'fill="#2f7ed8" fill-opacity="0.33" stroke="#1d5a9e" stroke-width="1.4"',
    "ghost": 'fill="none" stroke="#1d5a9e" stroke-width="1.1" stroke-dasharray="5 4"',
    "hull": 'fill="#e07b1a" fill-opacity="0.13" stroke="#c45f00" stroke-width="1.4" stroke-dasharray="6 3"',
    "cut": 'fill="none" stroke="#b3261e" stroke-width="1.3"',
    "room": 'fill="#b3261e" fill-opacity="0.18" stroke="#b3261e" stroke-width="1.1"',
    "thin": 'fill="none" stroke="#8a949f" stroke-width="0.8"',
    "dashed": 'fill="none" stroke="#8a949f" stroke-width="0.9" stroke-dasharray="4 3"',
    "dim": 'fill="none" stroke="#222" stroke-width="0.8"',
    "curve": 'fill="none" stroke="#1d5a9e" stroke-width="1.8"',
    "bold": 'fill="none" stroke="#b3261e" stroke-width="2.2"',
    "blade": 'fill="#8d6e3f" stroke="#5f4a29" stroke-width="1"',
    "basin": 'fill="#2f7ed8" fill-opacity="0.10"',
    "other_basin": 'fill="#e07b1a" fill-opacity="0.10"',
    "lost": 'fill="#b3261e" fill-opacity="0.10"',
    "paper": 'fill="#fff"',
}


class Picture:
    """A window of the plane, x0..x1 by y0..y1 mm, at px per mm; texts are in px."""

    def __init__(self, x0, y0, x1, y1, scale):
        self.x0, self.y0, self.x1, self.y1, self.scale = x0, y0, x1, y1, scale
        self.body = []

    def at(self, p):
        return (p[0] - self.x0) * self.scale, (self.y1 - p[1]) * self.scale

    def path(self, loops, style, closed=True):
        if loops and isinstance(loops[0][0], (int, float)):
            loops = [loops]
        d = ""
        for loop in loops:
            d += "M" + "L".join("%.1f %.1f" % self.at(p) for p in loop) + ("Z" if closed else "")
        self.body.append('<path d="%s" %s/>' % (d, STYLES[style]))

    def line(self, a, b, style="dim"):
        self.path([a, b], style, closed=False)

    def box(self, x0, y0, x1, y1, style):
        self.path(rectangle(x0, y0, x1, y1), style)

    def text(self, p, text, anchor="middle", size=12, dx=0, dy=0, colour="#222", weight="normal"):
        x, y = self.at(p)
        self.body.append('<text x="%.1f" y="%.1f" font-size="%g" text-anchor="%s" fill="%s" font-weight="%s">%s</text>'
                         % (x + dx, y + dy, size, anchor, colour, weight, text))

    def arrow(self, a, b, style="dim", head=6):
        self.line(a, b, style)
        (x0, y0), (x1, y1) = self.at(a), self.at(b)
        angle = math.atan2(y1 - y0, x1 - x0)
        for side in (2.75, -2.75):
            self.body.append('<path d="M%.1f %.1fL%.1f %.1f" %s/>' % (
                x1, y1, x1 + head * math.cos(angle + side), y1 + head * math.sin(angle + side), STYLES[style]))

    def across(self, x0, x1, y, text, below=False):
        self.arrow((0.5 * (x0 + x1), y), (x0, y))
        self.arrow((0.5 * (x0 + x1), y), (x1, y))
        self.text((0.5 * (x0 + x1), y), text, dy=14 if below else -5)

    def up(self, x, y0, y1, text, right=True):
        self.arrow((x, 0.5 * (y0 + y1)), (x, y0))
        self.arrow((x, 0.5 * (y0 + y1)), (x, y1))
        self.text((x, 0.5 * (y0 + y1)), text, "start" if right else "end", dx=6 if right else -6, dy=4)

    def dot(self, p, radius=3.2, fill="#1d5a9e", stroke="#fff"):
        x, y = self.at(p)
        self.body.append('<circle cx="%.1f" cy="%.1f" r="%g" fill="%s" stroke="%s"/>' % (x, y, radius, fill, stroke))

    def square(self, p, fill="#1d5a9e"):
        x, y = self.at(p)
        self.body.append('<rect x="%.1f" y="%.1f" width="8" height="8" fill="%s" stroke="#fff"/>'
                         % (x - 4, y - 4, fill))

    def diamond(self, p, fill="#c45f00"):
        x, y = self.at(p)
        self.body.append('<path d="M%.1f %.1fl5 5l-5 5l-5 -5Z" fill="%s" stroke="#fff"/>' % (x, y - 5, fill))

    def com(self, p):
        x, y = self.at(p)
        self.body.append('<circle cx="%.1f" cy="%.1f" r="5.5" fill="#fff" stroke="#111"/>' % (x, y))
        for turn in (1, -1):  # two opposite quarters
            self.body.append('<path d="M%.1f %.1fh%.1fa5.5 5.5 0 0 0 %.1f %.1fZ" fill="#111"/>'
                             % (x, y, 5.5 * turn, -5.5 * turn, -5.5 * turn))

    def save(self, name):
        width, height = (self.x1 - self.x0) * self.scale, (self.y1 - self.y0) * self.scale
        folder = os.path.dirname(os.path.abspath(__file__))
        with open(os.path.join(folder, name + ".svg"), "w", encoding="utf-8") as file:
            file.write('<svg xmlns="http://www.w3.org/2000/svg" width="%.0f" height="%.0f" viewBox="0 0 %.0f %.0f" '
                       'font-family="Helvetica, Arial, sans-serif">\n' % (width, height, width, height))
            file.write('<rect width="100%" height="100%" fill="#fff"/>\n' + "\n".join(self.body) + "\n</svg>\n")


# Geometry

def rectangle(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def centroid(loop):
    area = x = y = 0
    for p, q in zip(loop, loop[1:] + loop[:1]):
        k = cross(p, q)
        area, x, y = area + k, x + (p[0] + q[0]) * k, y + (p[1] + q[1]) * k
    return x / (3 * area), y / (3 * area)


def posed(loop, deg):
    """The part turned and on the wall, its centre of mass at x = 0; and the centre's height over the wall."""
    cx, cy = centroid(loop)
    c, s = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    turned = [((x - cx) * c - (y - cy) * s, (x - cx) * s + (y - cy) * c) for x, y in loop]
    low = min(y for _, y in turned)
    return [(x, y - low) for x, y in turned], -low


def moved(loop, dx, dy=0):
    return [(x + dx, y + dy) for x, y in loop]


def clipped(loop, normal, limit):
    kept = []
    for p, q in zip(loop, loop[1:] + loop[:1]):
        u, v = (normal[0] * r[0] + normal[1] * r[1] - limit for r in (p, q))
        if u <= 1e-9:
            kept.append(p)
        if min(u, v) < -1e-9 and max(u, v) > 1e-9:
            kept.append((p[0] + u / (u - v) * (q[0] - p[0]), p[1] + u / (u - v) * (q[1] - p[1])))
    return kept


def hull(points):
    points = sorted(set(points))

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and cross((chain[-1][0] - chain[-2][0], chain[-1][1] - chain[-2][1]),
                                           (p[0] - chain[-2][0], p[1] - chain[-2][1])) <= 1e-12:
                chain.pop()
            chain.append(p)
        return chain
    return half(points)[:-1] + half(points[::-1])[:-1]


def on_metal(loop, void):
    """Points whose hull is that of the part's metal outside of a rectangular void."""
    x0, y0, x1, y1 = void
    return (clipped(loop, (1, 0), x0) + clipped(loop, (-1, 0), -x1) +
            clipped(loop, (0, 1), y0) + clipped(loop, (0, -1), -y1))


def margin(points, origin):
    """Signed distance to the hull's boundary, the nearest place of it, and the edge that this is on."""
    corners = hull(points)
    nearest, inside = (math.inf, None, None), len(corners) > 2
    for a, b in zip(corners, corners[1:] + corners[:1]):
        d, o = (b[0] - a[0], b[1] - a[1]), (origin[0] - a[0], origin[1] - a[1])
        inside = inside and cross(d, o) >= 0
        t = max(0, min(1, (d[0] * o[0] + d[1] * o[1]) / (d[0] ** 2 + d[1] ** 2)))
        place = (a[0] + t * d[0], a[1] + t * d[1])
        nearest = min(nearest, (math.dist(place, origin), place, (a, b)))
    return (nearest[0] if inside else -nearest[0]), nearest[1], nearest[2]


def arc(cx, cy, r, from_deg, to_deg, steps=24):
    angles = [math.radians(from_deg + (to_deg - from_deg) * i / steps) for i in range(steps + 1)]
    return [(cx + r * math.cos(a), cy + r * math.sin(a)) for a in angles]


def track(picture, loops, wall=True):
    picture.path(loops, "metal")
    if wall:
        picture.box(picture.x0, -5, picture.x1, 0, "wall")


# What a feature is, for problem-format.md

FAR = 400


def feature_pictures():
    def window():
        return Picture(-22, -5, 88, 49, 3.2)

    def opened(edge):  # the strip with edge for its upper side, from right to left
        return [(-FAR, 0), (FAR, 0), (FAR, 40)] + edge + [(-FAR, 40)]

    def begin(picture, loops):
        track(picture, loops)
        picture.line((0, -5), (0, 46), "dashed")

    p = window()
    begin(p, opened([(60, 40), (60, 15), (0, 15), (0, 40)]))
    p.up(70, 0, 15, "width_mm", False)
    p.across(0, 60, 30, "length_mm")
    p.save("feature_balcony")

    p = window()
    begin(p, [rectangle(-FAR, 0, 0, 40), rectangle(26, 0, FAR, 40)])
    p.across(0, 26, 20, "length_mm")
    p.save("feature_gap")

    for name, end, note in (("canyon", 58, "longer than the part"), ("slot", 34, None)):
        p = window()
        begin(p, [rectangle(-FAR, 0, FAR, 40), rectangle(0, 12, end, 27)])
        p.up(end + 5, 0, 12, "from_mm")
        p.up(-4, 0, 27, "to_mm", False)
        p.across(0, end, 21, "length_mm")
        if note:
            p.text((29, 14), note, size=11, colour="#6b7683")
        p.save("feature_" + name)

    p = window()
    begin(p, [rectangle(-FAR, 0, FAR, 40), [(0, 8), (42, 14), (30, 34), (12, 27)]])
    p.dot((0, 8))
    p.text((0, 8), "[0, 8]", "end", dx=-6)
    p.text((42, 14), "[42, 14]", "start", dx=5)
    p.text((30, 34), "[30, 34]", "start", dx=5)
    p.text((12, 27), "[12, 27]", "end", dx=-5)
    p.save("feature_cutout")

    p = window()
    half, depth = 26, 16
    radius = (half ** 2 + depth ** 2) / (2 * depth)
    span = math.degrees(math.asin(half / radius))
    begin(p, opened(arc(half, 40 - depth + radius, radius, -90 + span, -90 - span)))
    p.across(0, 2 * half, 43, "length_mm")
    p.up(half, 40 - depth, 40, "depth_mm")
    p.save("feature_dish_out")

    p = window()
    begin(p, opened([(44, 40), (22, 14), (0, 40)]))
    p.line((22, 14), (22, 44), "dashed")
    p.path(arc(22, 14, 28, 90, 90 - math.degrees(math.atan(22 / 26))), "dim", closed=False)
    p.text((22, 44), "half_angle_deg", "start", dx=4, dy=2)
    p.up(52, 14, 40, "depth_mm")
    p.save("feature_scallop")

    p = window()
    el = [(40, 10), (70, 10), (70, 20), (52, 20), (52, 32), (40, 32)]
    begin(p, [rectangle(-FAR, 0, FAR, 40), arc(20, 20, 9, 0, 360, 48), el])
    p.text((20, 20), "VOID", size=11, dy=4)
    p.text((46, 14), "VOID", size=11)
    p.save("feature_drawing")

    for name in ("wiper", "hold_down"):
        p = Picture(-22, -9, 88, 32, 3.2)
        p.box(-FAR, -4, FAR, 0, "metal")
        rail = name == "hold_down"
        p.box(0, 11, 55 if rail else 4, 16 if rail else 28, "blade")
        p.box(-15, 0, -3, 8, "part")
        if rail:
            p.box(10, 0, 40, 8, "part")
            p.across(0, 55, 19, "length_mm")
        p.up(60 if rail else 9, 0, 11, "height_mm")
        p.text((88, -7), "seen from the side", "end", size=11, dx=-6, colour="#6b7683")
        p.save("feature_" + name)


# What the model is, for feeder.md

def frame():
    p = Picture(-52, -5, 128, 66, 4.2)
    track(p, [(-FAR, 0), (FAR, 0), (FAR, 60), (80, 60), (80, 12), (0, 12), (0, 60), (-FAR, 60)])
    part, height = posed(L_PART, 180)
    p.path(moved(part, -32), "part")
    p.com((-32, height))
    p.path(moved(part, 98), "ghost")
    p.text((-34, 34), "before the first feature", "start", dx=-40)
    p.text((104, 34), "wholly behind the last", dx=-8)
    p.arrow((-20, 20), (-6, 20), "curve")
    p.text((-13, 22), "feed", colour="#1d5a9e")
    p.arrow((0, 0), (14, 0), "bold")
    p.arrow((0, 0), (0, 9), "bold")
    p.text((15, 1.5), "x", "start", colour="#b3261e", weight="bold")
    p.text((1.5, 8), "y", "start", colour="#b3261e", weight="bold")
    p.text((40, -3.6), "wall: y = 0 and below", colour="#fff")
    p.text((-42, 62), "free edge: y = track_width_mm", "start", colour="#6b7683")
    p.text((40, 36), "a balcony: air", colour="#6b7683")
    p.up(60, 0, 12, "width_mm")
    p.across(0, 80, 52, "length_mm")
    p.up(125, 0, 60, "")
    p.text((125, 48), "track_width_mm", "end", dx=-6)
    p.save("frame")


def radius_function():
    cx, cy = centroid(L_PART)

    def over_wall(deg):  # of the centre of mass, the part turned by deg
        phi = math.radians(270 - deg)
        return max((x - cx) * math.cos(phi) + (y - cy) * math.sin(phi) for x, y in L_PART)

    values = [(i / 10, over_wall(i / 10)) for i in range(3601)]
    least = [v for u, v, w in zip(values[-2:] + values, values[-1:] + values, values) if v[1] < u[1] and v[1] < w[1]]
    most = [v[0] for u, v, w in zip(values[-2:] + values, values[-1:] + values, values) if v[1] > u[1] and v[1] > w[1]]
    p = Picture(-30, -26, 372, 100, 1.9)
    p_scale = 4  # units of the picture per mm of height

    def point(v):
        return v[0], p_scale * (v[1] - 8)

    bounds = [most[-1] - 360] + most
    for i, (a, b) in enumerate(zip(bounds, bounds[1:] + [360])):
        p.box(max(a, 0), 0, min(b, 360), 88, "basin" if i % 3 == 0 else "other_basin" if i % 3 == 1 else "lost")
    p.path([point(v) for v in values], "curve", closed=False)
    p.line((0, 0), (360, 0))
    p.line((0, 0), (0, 88))
    for deg in range(0, 361, 60):
        p.text((deg, 0), "%d°" % deg, dy=14, size=11)
    for height in (10, 20, 30):
        p.text(point((0, height)), str(height), "end", dx=-4, dy=4, size=11)
    p.text((180, 0), "orientation_deg", dy=31, size=11)
    p.text((0, 92), "mm from the wall to the centre of mass", "start", dx=4, size=11)
    for deg in most:
        p.line((deg, 0), point((deg, over_wall(deg))), "dashed")
    for deg, value in least:
        p.dot(point((deg, value)), 4)
        p.text(point((deg, value)), "%.3f" % value, dy=15, size=11)
    p.save("radius_function")

    p = Picture(-32, -6, 122, 50, 4)
    p.box(-FAR, -5, FAR, 0, "wall")
    for deg, label, x in ((34.800690835, "34.80°, prior 0.411", 0), (180, "180°, prior 0.343", 48),
                          (270, "270°, prior 0.245", 98)):
        part, height = posed(L_PART, deg)
        p.path(moved(part, x), "part")
        p.com((x, height))
        p.line((x, 0), (x, height), "dashed")
        p.text((x + (5 if deg == 180 else 0), 45), label)
    p.save("poses")


def tilt():
    p = Picture(-8, -13, 66, 22, 9)
    p.box(-FAR, -3, FAR, 0, "metal")
    p.box(-8, 0, 0, 22, "wall")
    p.box(0, 0, 40, 14, "part")
    shift = 7 * math.tan(math.radians(20))
    p.line((20, -8), (20, 7), "dashed")
    p.line((20 - shift, -8), (20 - shift, 0), "dashed")
    p.arrow((20, 7), (20 - 1.55 * shift, -3.85), "bold")
    p.com((20, 7))
    p.dot((20 - shift, 0), 4, "#b3261e")
    p.text((20 - 1.55 * shift, -3.85), "gravity", "end", dx=-5, dy=6, colour="#b3261e")
    p.path(arc(20, 7, 5, 270, 250), "dim", closed=False)
    p.text((20, 2.2), "tilt_deg", "start", dx=5)
    p.across(20 - shift, 20, -7, "com_height_mm · tan(tilt_deg)", below=True)
    p.up(30, 0, 7, "com_height_mm")
    p.line((20, 7), (31, 7), "thin")
    p.text((20 - shift, 0), "supported point", "end", dx=-8, dy=-5, colour="#b3261e")
    p.text((43, 12), "seen along the feed,", "start")
    p.text((43, 10.2), "in the track's frame", "start")
    p.text((-4, 10), "wall", colour="#fff")
    p.text((55, -2), "track")
    p.save("tilt")


def generators():
    # An L of two rectangles: what is metal lies beside, below or above both, or in the notch.
    rim, x = [(0, 3), (44, 3), (44, 17), (25, 17), (25, 36), (0, 36)], 29
    part, height = posed(L_PART, 34.800690835)
    part = moved(part, x)
    p = Picture(-14, -5, 118, 45, 5.6)
    track(p, [rectangle(-FAR, 0, FAR, 60), rim])
    points = on_metal(part, (0, 3, 44, 36)) + clipped(clipped(part, (-1, 0), -25), (0, -1), -17)
    corners = hull(points)
    p.path(corners, "hull")
    p.path(part, "part")
    value, place, _ = margin(points, (x, height))
    p.line((x, height), place, "bold")
    for q in points:
        if any(math.dist(q, corner) < 1e-6 for corner in part):
            p.square(q)
        elif any(math.dist(q, corner) < 1e-6 for corner in rim):
            p.dot(q, 5, "#222")
        else:
            p.diamond(q)
    p.com((x, height))
    for i, (draw, text) in enumerate(((p.square, "a corner of the part, on metal: at rest"),
                                      (lambda q: p.dot(q, 5, "#222"),
                                       "a corner of the metal, under the part: moves backwards"),
                                      (p.diamond, "edges that cross: moves along the part's edge"))):
        draw((57, 40 - 3 * i))
        p.text((58.5, 40 - 3 * i), text, "start", size=11, dy=4)
    p.text((56.4, 30.6), "margin %.2f mm at x = %d mm" % (value, x), "start", colour="#b3261e")
    p.save("generators")


def travel():
    part, height = posed(L_PART, 270)
    void = (0, -1, 12, 99)
    p = Picture(-17, -9.5, 30, 14, 16)
    xs = [-14 + i / 50 for i in range(2051)]
    values = [(x, margin(on_metal(moved(part, x), void), (x, height))[0]) for x in xs]
    lost = [x for x, v in values if v < 0]

    def change(low, high):  # where the margin changes its sign, by halving
        negative = low in lost
        for _ in range(40):
            middle = 0.5 * (low + high)
            if (margin(on_metal(moved(part, middle), void), (middle, height))[0] < 0) == negative:
                low = middle
            else:
                high = middle
        return high

    lost = [change(lost[0] - 0.02, lost[0]), change(lost[-1], lost[-1] + 0.02)]
    p.box(lost[0], -6.5, lost[-1], 12, "lost")
    for y in (-5, 0, 5, 10):
        p.line((-14, y), (27, y), "thin" if y else "dim")
        p.text((-14, y), str(y), "end", dx=-4, dy=4, size=11)
    for x in range(-10, 30, 5):
        p.text((x, -7), str(x), dy=6, size=11)
        p.line((x, -6.5), (x, -6.3))
    run = [values[0]]
    for before, now in zip(values, values[1:]):
        if abs(now[1] - before[1]) > 0.5:
            p.path(run, "curve", closed=False)
            p.line(before, now, "dashed")
            run = []
        run.append(now)
    p.path(run, "curve", closed=False)
    p.text((-14, 12.6), "margin, mm", "start", size=11)
    p.text((27, -8.6), "x of the centre of mass, mm", "end", size=11)
    p.text((lost[0], -2), "x = %.3f: the upright" % lost[0], "end", dx=-6, size=11)
    p.text((lost[0], -3), "leaves the metal", "end", dx=-6, size=11)
    p.text((lost[-1], 7), "x = %.3f: the nose is" % lost[-1], "start", dx=6, size=11)
    p.text((lost[-1], 6), "on the far edge", "start", dx=6, size=11)
    p.save("travel")


def knife_edge():
    part, height = posed(L_PART, 270)
    p = Picture(-9, -5, 161, 45, 4.6)
    for x, ledge in ((0, 0.1), (86, 3.4)):
        slot = (x, ledge, x + 67, 36)
        if x == 0:
            track(p, [rectangle(-FAR, 0, FAR, 60), rectangle(*slot), rectangle(86, 3.4, 153, 36)])
        at = x + 45
        points = on_metal(moved(part, at), slot)
        p.path(hull(points), "hull")
        p.path(moved(part, at), "part")
        p.com((at, height))
        p.text((x + 3, 31), "from_mm = %g" % ledge, "start")
    p.text((3, 27.5), "margin 10.17 mm", "start")
    p.text((3, 24), "tolerance 0.1 mm", "start", colour="#b3261e", weight="bold")
    p.text((89, 27.5), "margin 6.87 mm", "start")
    p.text((89, 24), "tolerance 3.4 mm", "start", weight="bold")
    p.arrow((15, 7), (28, 0.6), "bold")
    p.text((12, 12), "rides on a ledge", colour="#b3261e")
    p.text((12, 8.8), "of 0.1 mm", colour="#b3261e")
    p.save("knife_edge")


def grown_and_shrunk():
    e = 3
    p = Picture(-14, -5, 70, 44, 5)
    void = [(0, 40), (0, 12), (46, 12), (46, 26), (24, 26), (24, 40)]
    track(p, [(-FAR, 0), (FAR, 0), (FAR, 40), (24, 40), (24, 26), (46, 26), (46, 12), (0, 12), (0, 40), (-FAR, 40)])
    grown = ([(-e, 40)] + arc(0, 12, e, 180, 270) + arc(46, 12, e, 270, 360) + arc(46, 26, e, 0, 90) +
             [(24 + e, 26 + e), (24 + e, 40)])
    shrunk = [(e, 40), (e, 12 + e), (46 - e, 12 + e), (46 - e, 26 - e)] + arc(24, 26, e, -90, -180) + [(24 - e, 40)]
    p.path(grown, "cut", closed=False)
    p.path(shrunk, "ghost", closed=False)
    p.text((12, 33), "void", colour="#6b7683")
    p.text((31, 35), "grown by e: for the poses", "start", size=11, colour="#b3261e")
    p.text((31, 32.4), "that are to be delivered", "start", size=11, colour="#b3261e")
    p.text((23, 18), "shrunk by e: for the others", size=11, colour="#1d5a9e")
    p.save("grown_and_shrunk")


def void_rule():
    part, height = posed(L_PART, 180)
    p = Picture(-12, -5, 206, 49, 4.1)
    voids = ((0, 3, 30, 36), (70, 3, 115, 36), (146, 7, 196, 99))
    edge = [(FAR, 40), (196, 40), (196, 7), (146, 7), (146, 40)]
    track(p, [[(-FAR, 0), (FAR, 0)] + edge + [(-FAR, 40)], rectangle(*voids[0]), rectangle(*voids[1])])
    for void in voids:
        loss = void[0] + 14.855  # the foot behind has just left the metal
        lost = moved(part, loss)
        p.path(lost, "part")
        p.com((loss, height))
        _, _, (a, b) = margin(on_metal(lost, void), (loss, height))
        along = ((b[0] - a[0]) / math.dist(a, b), (b[1] - a[1]) / math.dist(a, b))
        if along[0] < 0:
            along = (-along[0], -along[1])
        p.line((a[0] - 50 * along[0], a[1] - 50 * along[1]), (a[0] + 6 * along[0], a[1] + 6 * along[1]), "dashed")
        if void[3] > 40:
            continue
        reach = [q[0] * along[0] + q[1] * along[1] for q in lost]
        extent = max(reach) - min(reach)
        start = (void[0] + (0.4 if extent > void[2] - void[0] else 2), 17)
        corners = [(start[0] + u * along[0] - v * along[1], start[1] + u * along[1] + v * along[0])
                   for u, v in ((0, 0), (extent, 0), (extent, 3), (0, 3))]
        p.path(corners, "room")
    p.text((17, 44), "jammed: no room for e by thickness")
    p.text((94, 44), "rejected: there is room")
    p.line((146, 40), (196, 40), "bold")
    p.text((171, 44), "rejected: open at the free edge")
    p.text((200, 7), "tipping line", "end", dy=13, size=11, colour="#6b7683")
    p.save("void_rule")


def tipping():
    p = Picture(-42, -22, 62, 20, 7)
    p.box(-FAR, -3, 0, 0, "metal")
    p.box(48, -3, FAR, 0, "metal")
    angle = math.radians(-12)
    c, s = math.cos(angle), math.sin(angle)

    def turned(loop):
        return [(x * c - y * s, x * s + y * c) for x, y in loop]

    p.path(rectangle(-26, 0, 38, 4), "ghost")
    p.path(turned(rectangle(-26, 0, 38, 4)), "part")
    p.com((6, 2))
    p.dot((0, 0), 4, "#b3261e")
    p.text((0, -3), "tipping edge", dy=14, colour="#b3261e")
    p.line((6, 2), (6, 10), "thin")
    p.line((0, 0), (0, 16), "thin")
    p.line((38, 0), (38, 16), "thin")
    p.across(0, 6, 9, "d")
    p.across(0, 38, 14, "r")
    nose = turned([(38, 0)])[0]
    p.up(41, nose[1], 0, "h")
    p.arrow((38, -12), (48, -12))
    p.arrow((48, -12), (38, -12))
    p.line((48, -3), (48, -13), "thin")
    p.line((38, -8), (38, -13), "thin")
    p.text((43, -12), "reach", dy=15)
    p.text((49, 1), "far edge", "start")
    p.text((-38, 12), "feed", "start", colour="#1d5a9e")
    p.arrow((-38, 10), (-26, 10), "curve")
    p.text((-40, -20), "seen from the side", "start", size=11, colour="#6b7683")
    p.save("tipping")


def mirror():
    p = Picture(-62, -5, 62, 48, 5.6)
    track(p, [(-FAR, 0), (FAR, 0), (FAR, 40), (26, 40), (0, 7), (-26, 40), (-FAR, 40)])
    part, height = posed(EL, 0)
    other = [(-x, y) for x, y in part]
    p.path(moved(part, -8), "part")
    p.com((-8, height))
    p.path(moved(other, 8), "ghost")
    p.com((8, height))
    p.line((0, -5), (0, 47), "cut")
    p.text((0, 45), "x → −x", "start", dx=6, colour="#b3261e")
    p.across(-8, 0, 26, "s")
    p.across(0, 8, 26, "s")
    p.line((-8, height), (-8, 27), "thin")
    p.line((8, height), (8, 27), "thin")
    p.text((-30, 20), "pose P at −s", dx=-30)
    p.text((30, 20), "its mirror image at +s", dx=34)
    p.save("mirror")


def cutter():
    r = 5
    p = Picture(-14, -5, 96, 44, 5)
    edge = [(40, 40), (40, 10)] + [(0, 10), (0, 40)]
    track(p, [[(-FAR, 0), (FAR, 0), (FAR, 40)] + edge + [(-FAR, 40)], rectangle(48, 12, 84, 30)])
    open_void = [(0, 40), (0, 10 + r)] + arc(r, 10 + r, r, 180, 270) + arc(40 - r, 10 + r, r, 270, 360) + [(40, 40)]
    closed_void = (arc(48 + r, 12 + r, r, 180, 270) + arc(84 - r, 12 + r, r, 270, 360) +
                   arc(84 - r, 30 - r, r, 0, 90) + arc(48 + r, 30 - r, r, 90, 180) + [(48, 12 + r)])
    for corners in (open_void, closed_void):
        p.path(corners, "cut", closed=False)
    p.path(arc(r, 10 + r, r, 0, 360, 60), "dashed", closed=False)
    p.path(arc(48 + r, 30 - r, r, 0, 360, 60), "dashed", closed=False)
    p.text((20, 30), "cutter_radius_mm")
    p.arrow((12, 28.8), (6, 18.5))
    p.arrow((44, 21), (40, 21))
    p.arrow((44, 21), (48, 21))
    p.text((44, 35), "web: at least min_web_mm", "start", dx=-4)
    p.line((44, 34), (44, 22), "thin")
    p.save("cutter")


if __name__ == "__main__":
    feature_pictures()
    for draw in (frame, radius_function, tilt, generators, travel, knife_edge, grown_and_shrunk, void_rule, tipping,
                 mirror, cutter):
        draw()
