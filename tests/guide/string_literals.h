// The string literals of a C++ source; adjacent ones are joined, as by the compiler.
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Leaves out those of #include and #error, and raw ones, which contain shaders and patterns.
[[nodiscard]] std::vector<std::string> string_literals(std::string_view source);
