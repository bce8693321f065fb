// The law of the readers: any text gives a value or an InputError that says something, one line for each issue.
#pragma once

#include <string>

namespace fuzz {

enum class Reader { Dxf, Problem };

// What breaks the law; empty where it holds. accepted (if given): whether the text gave a value.
std::string breach(Reader reader, const std::string& text, bool* accepted = nullptr);

}  // namespace fuzz
