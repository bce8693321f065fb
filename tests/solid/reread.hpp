// An STL file read again, and what a closed solid keeps to.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace formotion {

struct Facet {
  Eigen::Vector3f normal;
  std::array<Eigen::Vector3f, 3> corners;
};

// None where the size is not what the count says.
inline std::vector<Facet> reread(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < 84) return {};
  std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() != 84 + 50 * static_cast<std::size_t>(count)) return {};
  std::vector<Facet> facets(count);
  for (std::size_t i = 0; i < count; ++i) {
    float numbers[12];
    std::memcpy(numbers, bytes.data() + 84 + 50 * i, sizeof numbers);
    const auto at = [&](int k) { return Eigen::Vector3f(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]); };
    facets[i] = {at(0), {at(1), at(2), at(3)}};
  }
  return facets;
}

inline double volume(const std::vector<Facet>& facets) {
  double sum = 0;
  for (const Facet& f : facets) {
    const Eigen::Vector3d a = f.corners[0].cast<double>(), b = f.corners[1].cast<double>();
    sum += a.dot(b.cross(f.corners[2].cast<double>())) / 6;
  }
  return sum;
}

// Edges that are not once there and once back.
inline int open_edges(const std::vector<Facet>& facets) {
  using Place = std::tuple<float, float, float>;
  std::map<std::pair<Place, Place>, int> there;
  const auto place = [](const Eigen::Vector3f& p) { return Place(p.x(), p.y(), p.z()); };
  for (const Facet& f : facets) {
    for (std::size_t i = 0; i < 3; ++i) ++there[{place(f.corners[i]), place(f.corners[(i + 1) % 3])}];
  }
  int bad = 0;
  for (const auto& [edge, count] : there) {
    const auto back = there.find({edge.second, edge.first});
    if (count != 1 || back == there.end() || back->second != 1) ++bad;
  }
  return bad;
}

// Facets without area, or with another normal than their corners say.
inline int bad_facets(const std::vector<Facet>& facets) {
  int bad = 0;
  for (const Facet& f : facets) {
    const Eigen::Vector3d a = f.corners[0].cast<double>();
    const Eigen::Vector3d n = (f.corners[1].cast<double>() - a).cross(f.corners[2].cast<double>() - a);
    if (!(n.norm() > 0) || !((n.normalized() - f.normal.cast<double>()).norm() < 1e-5)) ++bad;
  }
  return bad;
}

}  // namespace formotion
