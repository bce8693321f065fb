#include "report/joint_outline.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

constexpr double kSame_mm = 1e-6;

struct Crossing {
  double middle = 0;        // where the face crosses the middle of the band
  double from = 0, to = 0;  // and its beginning and end
  bool parallel() const { return std::abs(to - from) <= kSame_mm; }
};

std::vector<Crossing> crossings(const std::vector<Loop>& loops, double y_from, double y_to) {
  std::vector<Crossing> found;
  const double middle = (y_from + y_to) / 2;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y() < middle) == (b.y() < middle)) continue;
      const auto at = [&](double y) { return a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()); };
      found.push_back({at(middle), at(y_from), at(y_to)});
    }
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.middle < b.middle; });
  return found;
}

std::vector<double> levels(const std::vector<Loop>& loops) {
  std::vector<double> all;
  for (const Loop& loop : loops) {
    for (const Point& p : loop) all.push_back(p.y());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a <= kSame_mm; }), all.end());
  return all;
}

}  // namespace

ApproachFrame::ApproachFrame(double approach_rad) {
  const auto clean = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
  along = {clean(std::cos(approach_rad)), clean(std::sin(approach_rad))};
  across = {-along.y(), along.x()};
}

Loop ApproachFrame::seen(const Loop& loop) const {
  Loop result;
  for (const Point& p : loop) result.push_back(seen(p));
  return result;
}

std::vector<Polygon> fixed_pieces(const std::vector<Loop>& fixed_mm) {
  std::vector<Polygon> written;
  std::vector<Loop> loops;
  for (const Loop& loop : fixed_mm) {
    written.push_back(normalised({loop, {}}));
    loops.push_back(written.back().outer);
  }
  std::vector<Polygon> pieces = united(loops);
  const bool apart = pieces.size() == written.size() &&
                     std::all_of(pieces.begin(), pieces.end(), [](const Polygon& p) { return p.holes.empty(); });
  return apart ? written : pieces;
}

Polygon at_goal(const JointDrawing& drawing) {
  return placed(drawing.part, 0, drawing.depth_mm * ApproachFrame(drawing.approach_rad).along);
}

std::vector<Width> widths(const std::vector<Loop>& loops, Between between) {
  std::vector<Width> found;
  const std::vector<double> y = levels(loops);
  for (std::size_t band = 0; band + 1 < y.size(); ++band) {
    const std::vector<Crossing> faces = crossings(loops, y[band], y[band + 1]);
    for (std::size_t i = between == Between::Opening ? 1 : 0; i + 1 < faces.size(); i += 2) {
      const Crossing &a = faces[i], &b = faces[i + 1];
      if (a.parallel() && b.parallel()) {
        const auto above = std::find_if(found.begin(), found.end(), [&](const Width& w) {
          return w.constant && w.y_to == y[band] && std::abs(w.from - a.from) <= kSame_mm &&
                 std::abs(w.to - b.from) <= kSame_mm;
        });
        if (above != found.end()) {
          above->y_to = y[band + 1];
        } else {
          found.push_back({a.from, b.from, y[band], y[band + 1], true});
        }
      } else if (band == 0 && between == Between::Opening) {
        found.push_back({a.from, b.from, y[band], y[band + 1], false});
      }
    }
  }
  return found;
}

std::vector<SlantedFace> slanted_faces(const std::vector<Loop>& loops) {
  std::vector<SlantedFace> found;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const Loop& loop = loops[k];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()], size = (b - a).cwiseAbs();
      if (size.minCoeff() <= kSame_mm) continue;
      found.push_back({k, i, a, b, size.x(), size.y(), std::atan2(size.x(), size.y())});
    }
  }
  return found;
}

}  // namespace formotion
