// The report page's template, bundled from this folder when the program is built.
#pragma once

#include <string_view>

namespace formotion {

// What stands once in the template, for the data.
inline constexpr std::string_view kPageDataMarker = "@formotion-report-data@";

std::string_view page_template();

}  // namespace formotion
