// Solids as STL files.
#pragma once

#include <string>

#include "solid/solid.hpp"

namespace formotion {

// Binary STL; lengths in mm, which the header says beside the title (what is not ASCII becomes '?').
std::string stl(const Solid& solid, const std::string& title);

}  // namespace formotion
