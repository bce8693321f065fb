#include "solid/stl.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>

namespace formotion {
namespace {

constexpr std::size_t kHeader = 80, kFacet = 50;

void write(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((value >> shift) & 0xFF);
}

void write(std::string& out, const Eigen::Vector3f& v) {
  for (int i = 0; i < 3; ++i) write(out, std::bit_cast<std::uint32_t>(v[i] == 0 ? 0.0F : v[i]));  // no negative zero
}

}  // namespace

std::string stl(const Solid& solid, const std::string& title) {
  // Readers take a file that begins with "solid" for text.
  std::string out = "Formotion, binary STL in mm: ";
  for (const char c : title) out += c >= ' ' && c <= '~' ? c : '?';
  out.resize(kHeader, ' ');
  out.reserve(kHeader + 4 + kFacet * solid.triangles.size());
  write(out, static_cast<std::uint32_t>(solid.triangles.size()));
  for (const auto& triangle : solid.triangles) {
    const auto corner = [&](std::size_t i) -> const Eigen::Vector3f& {
      return solid.points[static_cast<std::size_t>(triangle[i])];
    };
    const Eigen::Vector3d a = corner(0).cast<double>(), b = corner(1).cast<double>(), c = corner(2).cast<double>();
    write(out, Eigen::Vector3f((b - a).cross(c - a).normalized().cast<float>()));
    for (std::size_t i = 0; i < 3; ++i) write(out, corner(i));
    out.append(2, '\0');
  }
  return out;
}

}  // namespace formotion
