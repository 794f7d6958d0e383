/// Pieces of the lines of status_lines.h.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/status/status_lines.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::status {

inline constexpr std::size_t max_told = 3; ///< faults, and packs left out

/// Collects the lines; a line without a text is left out.
class Lines {
public:
    void add(const char* name, std::string_view text, bool for_staff = true);
    [[nodiscard]] std::vector<StatusLine> take() { return std::move(lines_); }

private:
    std::vector<StatusLine> lines_;
};

/// Shortens a text that may be longer than a line. A text that was already cut keeps its "...".
[[nodiscard]] std::string brief(std::string_view text);
/// "1 visit", "2 visits".
[[nodiscard]] std::string counted(std::uint64_t count, const char* one, const char* many);
[[nodiscard]] std::string or_else(std::string_view text, std::string_view otherwise);

} // namespace frustumscreen::status
