#include "report/svg_corners.hpp"

#include <cmath>

namespace formotion {

Point outwards_on_paper(const std::vector<Corner>& corners, std::size_t k) {
  const std::size_t n = corners.size();
  const Point in = (corners[k].at - corners[(k + n - 1) % n].at).normalized();
  const Point out = (corners[(k + 1) % n].at - corners[k].at).normalized();
  const Point normal = Point(in.y() + out.y(), -in.x() - out.x());  // to the right of a counter-clockwise loop
  return normal.norm() > 1e-9 ? Point(normal.x(), -normal.y()).normalized() : Point(in.x(), -in.y());
}

void number_corner(SvgCanvas& canvas, const std::string& label, const Point& p, const Point& outwards) {
  constexpr double kSize = 2.5;
  const double w = text_width(label, kSize) + 0.6, h = kSize + 0.4, base = std::atan2(outwards.y(), outwards.x());
  Point place = p + Point(2, -2);
  bool found = false;
  for (const double away : {2.6, 4.0, 6.0, 9.0, 12.0}) {
    for (const double turn : {0.0, 0.6, -0.6, 1.2, -1.2, 2.0, -2.0, 3.14}) {
      if (found) break;
      const Point u(std::cos(base + turn), std::sin(base + turn));
      const Point candidate = p + Point(u.x() * (away + w / 2 - 1), u.y() * (away + h / 2 - 1));
      if (!canvas.is_free(box_around(candidate, w, h))) continue;
      place = candidate;
      found = true;
    }
  }
  canvas.take(box_around(place, w, h));
  if ((place - p).norm() > 6) canvas.line(p, place, "leader");
  canvas.circle(p, 0.55, "mark");
  canvas.text({place.x(), place.y() + 0.36 * kSize}, label, {kSize, Anchor::Middle, false, false, true});
}

}  // namespace formotion
