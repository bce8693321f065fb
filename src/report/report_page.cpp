#include "report/report_page.hpp"

#include <stdexcept>

#include "formotion_page.hpp"

namespace formotion {
namespace {

// JSON that is safe inside a script element: no end tag, no comment can occur in it.
std::string embedded(const nlohmann::ordered_json& data) {
  const std::string plain = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string report_page(const nlohmann::ordered_json& data) {
  const std::string_view page = page_template();
  const std::size_t at = page.find(kPageDataMarker);
  if (at == std::string_view::npos || page.find(kPageDataMarker, at + 1) != std::string_view::npos) {
    throw std::logic_error("the page's template has no single place for its data");
  }
  std::string text(page.substr(0, at));
  text += embedded(data);
  text += page.substr(at + kPageDataMarker.size());
  return text;
}

}  // namespace formotion
