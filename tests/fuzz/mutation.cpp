#include "fuzz/mutation.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace fuzz {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kOddValues{"0",   "-1",    "1e308",       "-1e308", "1e-308", "nan",
                                          "inf", "1e9",   "2147483648",  "0x1",    "1,5",    "",
                                          "abc", "1e999", "99999999999", "-0.0",   "70",     "1e-7"};

std::size_t below(std::size_t n, std::mt19937& random) { return n == 0 ? 0 : random() % n; }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void change_bytes(std::string& text, std::mt19937& random) {
  if (text.empty()) return;
  const std::size_t at = below(text.size(), random);
  switch (random() % 4) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, 1 + below(8, random));
      break;
    case 2:
      text.insert(at, 1, static_cast<char>(random()));
      break;
    default:
      text[at] = static_cast<char>(text[at] ^ (1 << (random() % 8)));
  }
}

void change_lines(std::string& text, const std::string& other, std::mt19937& random) {
  std::vector<std::string> lines = lines_of(text);
  const std::vector<std::string> others = lines_of(other);
  if (lines.empty() || others.empty()) return;
  const auto at = [&] { return lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size(), random)); };
  switch (random() % 5) {
    case 0:
      *at() = kOddValues[below(kOddValues.size(), random)];
      break;
    case 1:
      lines.erase(at());
      break;
    case 2:
      std::iter_swap(at(), at());
      break;
    case 3: {  // some lines again
      const std::size_t from = below(lines.size(), random);
      const std::size_t count = std::min(lines.size() - from, 1 + below(20, random));
      const std::vector<std::string> some(lines.begin() + static_cast<std::ptrdiff_t>(from),
                                          lines.begin() + static_cast<std::ptrdiff_t>(from + count));
      lines.insert(at(), some.begin(), some.end());
      break;
    }
    default:
      *at() = others[below(others.size(), random)];
  }
  text = joined(lines);
}

// All the places in a document, the document itself among them.
void places(Json& value, std::vector<Json*>& found) {
  found.push_back(&value);
  if (value.is_structured()) {
    for (Json& child : value) places(child, found);
  }
}

Json odd_value(std::mt19937& random) {
  switch (random() % 14) {
    case 0:
      return nullptr;
    case 1:
      return true;
    case 2:
      return "";
    case 3:
      return "w";
    case 4:
      return "2*w + 1.5";
    case 5:
      return "1/0*(w";
    case 6:
      return Json::array();
    case 7:
      return Json::object();
    case 8:
      return -1;
    case 9:
      return 0;
    case 10:
      return 1e308;
    case 11:
      return 1e-300;
    case 12:
      return 1e6;
    default:
      return static_cast<double>(random()) / 1e8;
  }
}

}  // namespace

std::string mutated(const std::string& text, const std::string& other, std::mt19937& random) {
  std::string result = text;
  for (std::size_t i = 1 + below(4, random); i > 0; --i) {
    switch (random() % 8) {
      case 0:
        result.resize(below(result.size() + 1, random));
        break;
      case 1:
        change_bytes(result, random);
        break;
      case 2:
        result = result.substr(0, below(result.size() + 1, random)) + other.substr(below(other.size() + 1, random));
        break;
      default:
        change_lines(result, other, random);
    }
  }
  return result;
}

std::string mutated_json(const std::string& text, std::mt19937& random) {
  Json document = Json::parse(text);
  for (std::size_t i = 1 + below(3, random); i > 0; --i) {
    std::vector<Json*> all;
    places(document, all);
    Json& value = *all[below(all.size(), random)];
    if (value.is_object() && !value.empty() && random() % 2 == 0) {
      auto member = value.begin();
      std::advance(member, static_cast<std::ptrdiff_t>(below(value.size(), random)));
      const std::string key = member.key();
      const Json moved = member.value();
      value.erase(key);
      if (random() % 2 == 0) value[random() % 2 == 0 ? key + "x" : key.substr(0, key.size() / 2)] = moved;
    } else if (value.is_array() && !value.empty() && random() % 2 == 0) {
      const std::size_t at = below(value.size(), random);
      if (random() % 2 == 0) {
        value.erase(value.begin() + static_cast<std::ptrdiff_t>(at));
      } else {
        value.push_back(Json(value[at]));
      }
    } else if (random() % 3 == 0) {
      value = Json(*all[below(all.size(), random)]);  // from elsewhere
    } else if (value.is_number() && random() % 2 == 0) {
      value = value.get<double>() * (static_cast<double>(random() % 2001) / 1000 - 1);
    } else {
      value = odd_value(random);
    }
  }
  return document.dump();
}

std::vector<std::string> corpus(const std::string& folder, const std::string& ending) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ending) paths.push_back(entry.path());
  }
  if (paths.empty()) throw std::runtime_error("no " + ending + " in " + folder);
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

}  // namespace fuzz
