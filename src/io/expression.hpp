// Numbers of a design as text: expressions affine in the variables, "2*w + 1.5".
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "problem/affine.hpp"

namespace formotion {

// The expression, or why it is none ("an unknown variable 'v'", ...). Operators + - * / and parentheses; at most one
// factor of a product may hold variables, and divisors none. names[i] is the name of variable i.
std::variant<Affine, std::string> parse_expression(const std::string& text, const std::vector<std::string>& names);

}  // namespace formotion
