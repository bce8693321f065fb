// The secret that workers must know: Work Queue sends everything in plain text, so at least nobody else may join.
#pragma once

#include <string>

namespace formotion {

// Makes the file with a random password, readable by its owner alone, unless it is there already. Throws EngineError.
void make_password_file(const std::string& path);

}  // namespace formotion
