#include "app/report/shared_text.h"

#include "firmware_host/base/trimmed.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <vector>

namespace frustumscreen::report {

namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// The kernel's line of a serial number, and the service manager's lines of device units: their names and descriptions
/// have serial numbers and labels.
bool names_a_device(std::string_view line) {
    constexpr std::array<std::string_view, 4> marks{"SerialNumber: ", "dev-disk-by", ".device - ",
                                                    ".device: "};
    return std::any_of(marks.begin(), marks.end(),
                       [&](std::string_view mark) { return line.find(mark) != std::string_view::npos; });
}

std::uint64_t number_of(std::string_view line) {
    std::uint64_t number = 0;
    std::from_chars(line.data(), line.data() + line.size(), number);
    return number;
}

} // namespace

std::string shared_journal(std::string_view journal, std::size_t max_bytes) {
    std::vector<std::string_view> lines = lines_of(journal);
    std::erase_if(lines, names_a_device);
    std::size_t bytes = 0;
    auto first = lines.rbegin();
    while (first != lines.rend() && bytes + first->size() + 1 <= max_bytes) {
        bytes += first->size() + 1;
        ++first;
    }
    std::string kept;
    kept.reserve(bytes);
    for (auto line = first.base(); line != lines.end(); ++line) {
        kept.append(*line).push_back('\n');
    }
    return kept;
}

std::string faults_in_order(std::string_view ring) {
    std::vector<std::string_view> lines = lines_of(ring);
    std::erase_if(lines, [](std::string_view line) { return trimmed(line).empty(); });
    std::stable_sort(lines.begin(), lines.end(),
                     [](std::string_view a, std::string_view b) { return number_of(a) < number_of(b); });
    std::string text;
    for (const std::string_view line : lines) {
        text.append(trimmed(line)).push_back('\n');
    }
    return text;
}

} // namespace frustumscreen::report
