#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "fuzz/input_law.hpp"
#include "fuzz/mutation.hpp"

using fuzz::Reader;

namespace {

const std::string kSource = FORMOTION_SOURCE_DIR;

std::vector<std::string> problems() {
  std::vector<std::string> texts = fuzz::corpus(kSource + "/problems", ".json");
  if (std::filesystem::is_directory(kSource + "/tests/corpus/problems")) {
    const auto more = fuzz::corpus(kSource + "/tests/corpus/problems", ".json");
    texts.insert(texts.end(), more.begin(), more.end());
  }
  return texts;
}

// Mutates until `count` texts were read; some must be accepted and some refused, or the mutations are no test.
template <class Mutate>
void check_law(Reader reader, int count, const Mutate& mutate) {
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = mutate();
    bool good = false;
    const std::string breach = fuzz::breach(reader, text, &good);
    accepted += good;
    if (!breach.empty()) {
      CAPTURE(i, text.substr(0, 4000));
      FAIL(breach);
    }
  }
  CHECK(accepted > count / 200);
  CHECK(accepted < count);
}

}  // namespace

TEST_CASE("the DXF reader gives contours or an InputError for 20,000 mutated drawings") {
  std::mt19937 random(20260401);
  std::vector<std::string> texts = fuzz::corpus(kSource + "/tests/corpus/dxf", ".dxf");
  // Tables and objects are the larger part of a drawing and hold nothing that is read: leave most of them out.
  for (const std::string& text : std::vector<std::string>(texts)) {
    const std::size_t from = text.find("SECTION\r\n  2\r\nENTITIES"), plain = text.find("SECTION\n  2\nENTITIES");
    const std::size_t at = from != std::string::npos ? from : plain;
    if (at == std::string::npos) continue;
    const std::size_t end = text.find("ENDSEC", at);
    for (int k = 0; k < 4; ++k) texts.push_back("0\n" + text.substr(at, end - at) + "ENDSEC\n0\nEOF\n");
  }
  REQUIRE(texts.size() > 100);
  check_law(Reader::Dxf, 20000, [&] {
    const std::string& text = texts[random() % texts.size()];
    return fuzz::mutated(text, texts[random() % texts.size()], random);
  });
}

TEST_CASE("every drawing of the corpus obeys the reader's law, and what fuzzing found stays found") {
  for (const std::string& text : fuzz::corpus(kSource + "/tests/corpus", ".dxf"))
    CHECK(fuzz::breach(Reader::Dxf, text).empty());
}

TEST_CASE("the problem reader gives a problem or an InputError for 10,000 problems with mutated structure") {
  std::mt19937 random(20260402);
  std::vector<std::string> texts;
  for (const std::string& text : problems()) {
    if (nlohmann::json::accept(text)) texts.push_back(text);
  }
  REQUIRE_FALSE(texts.empty());
  check_law(Reader::Problem, 10000, [&] { return fuzz::mutated_json(texts[random() % texts.size()], random); });
}

TEST_CASE("the problem reader gives a problem or an InputError for 10,000 mutated texts") {
  std::mt19937 random(20260403);
  const std::vector<std::string> texts = problems();
  check_law(Reader::Problem, 10000, [&] {
    const std::string& text = texts[random() % texts.size()];
    return fuzz::mutated(text, texts[random() % texts.size()], random);
  });
}
