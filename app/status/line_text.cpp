#include "app/status/line_text.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

namespace frustumscreen::status {

namespace {

constexpr std::size_t longest_text = 300; ///< bytes of a title or a reason

} // namespace

void Lines::add(const char* name, std::string_view text, bool for_staff) {
    if (!text.empty()) {
        lines_.push_back({name, printable(text, text.size()), for_staff});
    }
}

std::string brief(std::string_view text) {
    constexpr std::string_view cut = "...";
    return printable(text, longest_text + (text.ends_with(cut) ? cut.size() : 0));
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string or_else(std::string_view text, std::string_view otherwise) {
    return brief(text.empty() ? otherwise : text);
}

} // namespace frustumscreen::status
