#include "io/expression.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "io/suggestion.hpp"

namespace formotion {
namespace {

constexpr std::size_t kLongest = 1000;
constexpr int kDeepest = 50;

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Affine scaled(Affine a, double factor) {
  a.constant *= factor;
  for (auto& term : a.terms) term.second *= factor;
  return a;
}

Affine divided(Affine a, double divisor) {
  a.constant /= divisor;
  for (auto& term : a.terms) term.second /= divisor;
  return a;
}

Affine sum(const Affine& a, const Affine& b) {
  Affine result = a;
  result.constant += b.constant;
  for (const auto& [index, coefficient] : b.terms) {
    const auto at = std::lower_bound(result.terms.begin(), result.terms.end(), index,
                                     [](const auto& t, int i) { return t.first < i; });
    if (at != result.terms.end() && at->first == index) {
      at->second += coefficient;
    } else {
      result.terms.insert(at, {index, coefficient});
    }
  }
  return result;
}

// Recursive descent: sum = product {(+|-) product}; product = factor {(*|/) factor}; factor = [+|-]
// (number|name|(sum)).
class Parser {
 public:
  Parser(const std::string& text, const std::vector<std::string>& names) : text_(text), names_(names) {}

  Affine run() {
    if (text_.size() > kLongest)
      throw Refused("an expression of more than " + std::to_string(kLongest) + " characters");
    Affine result = parse_sum();
    if (peek() != '\0') throw Refused("'" + text_.substr(at_, 20) + "' after the end of the expression");
    bool finite = std::isfinite(result.constant);
    for (const auto& term : result.terms) finite = finite && std::isfinite(term.second);
    if (!finite) throw Refused("an expression that overflows");
    std::erase_if(result.terms, [](const auto& term) { return term.second == 0; });
    return result;
  }

 private:
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  Affine parse_sum() {
    if (++depth_ > kDeepest) throw Refused("an expression nested too deeply");
    Affine result = parse_product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      result = sum(result, scaled(parse_product(), c == '+' ? 1 : -1));
    }
    --depth_;
    return result;
  }

  Affine parse_product() {
    Affine result = parse_factor();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      const Affine factor = parse_factor();
      if (c == '/') {
        if (!factor.is_literal()) throw Refused("a division by a variable");
        if (factor.constant == 0) throw Refused("a division by zero");
        result = divided(result, factor.constant);
      } else if (factor.is_literal()) {
        result = scaled(result, factor.constant);
      } else if (result.is_literal()) {
        result = scaled(factor, result.constant);
      } else {
        throw Refused("a product of two variables");
      }
    }
    return result;
  }

  Affine parse_factor() {
    double sign = 1;
    char c = peek();
    for (; c == '+' || c == '-'; c = peek()) {
      if (c == '-') sign = -sign;
      ++at_;
    }
    if (c == '(') {
      ++at_;
      const Affine inner = parse_sum();
      if (peek() != ')') throw Refused("a missing ')'");
      ++at_;
      return scaled(inner, sign);
    }
    if ((c >= '0' && c <= '9') || c == '.') {
      double value = 0;
      const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
      if (error != std::errc()) throw Refused("'" + text_.substr(at_, 20) + "', which is no number");
      at_ = static_cast<std::size_t>(end - text_.data());
      return scaled({value, {}}, sign);
    }
    std::size_t end = at_;
    const auto in_name = [](char x) {
      return (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9') || x == '_' || x == '.';
    };
    while (end < text_.size() && in_name(text_[end])) ++end;
    if (end == at_) throw Refused(c == '\0' ? "an expression that ends early" : "'" + text_.substr(at_, 20) + "'");
    const std::string name = text_.substr(at_, end - at_);
    at_ = end;
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw Refused("the unknown variable '" + name + "'" + did_you_mean(name, names_));
    return scaled({0, {{static_cast<int>(found - names_.begin()), 1.0}}}, sign);
  }

  const std::string& text_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::variant<Affine, std::string> parse_expression(const std::string& text, const std::vector<std::string>& names) {
  try {
    return Parser(text, names).run();
  } catch (const Refused& refused) { return std::string(refused.what()); }
}

}  // namespace formotion
