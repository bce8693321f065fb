// The report as one self-contained HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace formotion {

// The page (web/, bundled at build time) with report_data's value written into it; it opens offline.
std::string report_page(const nlohmann::ordered_json& data);

}  // namespace formotion
