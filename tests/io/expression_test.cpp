#include "io/expression.hpp"

#include <catch2/catch.hpp>

using namespace formotion;

namespace {

const std::vector<std::string> kNames{"w", "x0", "f0.width_mm"};

double value(const std::string& text) {
  const auto parsed = parse_expression(text, kNames);
  REQUIRE(std::holds_alternative<Affine>(parsed));
  return std::get<Affine>(parsed)(std::vector<double>{3, 5, 7});
}

bool refused(const std::string& text) { return std::holds_alternative<std::string>(parse_expression(text, kNames)); }

}  // namespace

TEST_CASE("expressions are what they look like") {
  CHECK(value("2*w + 1.5") == 7.5);
  CHECK(value("w-x0-1") == -3);
  CHECK(value("-(w - 2*(x0 + 1))/3") == Approx(3));
  CHECK(value("(w + x0)*2/4") == 4);
  CHECK(value("f0.width_mm * 1e1") == 70);
  CHECK(value(" - - 4") == 4);
  CHECK(value("2*3*w*0.5") == 9);
  CHECK(value("w - w + 1") == 1);
}

TEST_CASE("what is not affine, not finite or not an expression is refused") {
  for (const char* text : {"",     " ",     "w*x0",          "w*w",  "1/w", "w/0", "w +", "(w",   "w)", "y",  "2w",
                           "w x0", "1e999", "w*1e308*1e308", "0x10", "nan", "inf", "w^2", "1..2", "\"", "w;1"}) {
    CAPTURE(text);
    CHECK(refused(text));
  }
  CHECK(refused(std::string(2000, '1')));
  CHECK(refused(std::string(200, '(') + "1" + std::string(200, ')')));
  CHECK(refused(std::string(999, '-')));
}

TEST_CASE("terms that cancel are gone: the expression is literal") {
  const auto parsed = parse_expression("w - w + 2", kNames);
  CHECK(std::get<Affine>(parsed).is_literal());
}
