// The texts in C++ source: string literals, those side by side joined as the compiler joins them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Without those of #include and #error, and without raw ones, which hold shaders and patterns.
[[nodiscard]] std::vector<std::string> string_literals(std::string_view source);
