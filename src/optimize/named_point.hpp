// Places that a run passes on its way to disk. Tests end the process at each of them; nobody else looks.
#pragma once

#include <functional>

namespace formotion {

using NamedPoint = std::function<void(const char* name)>;

inline void reached(const NamedPoint& at_point, const char* name) {
  if (at_point) at_point(name);
}

}  // namespace formotion
