#include "app/status/system_image.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace frustumscreen::status {

namespace {

constexpr std::uintmax_t max_bytes = 1U << 16U;
constexpr std::size_t max_notes = 8;
constexpr std::size_t max_word_bytes = 40;
constexpr std::size_t max_note_bytes = 300;
constexpr std::string_view slot_prefix = "frustumscreen-"; ///< the partition's name
constexpr std::string_view own_prefix = "system: ";        ///< the prefix of notes on the system

std::vector<std::string> lines_of(const std::filesystem::path& file, std::size_t max_line_bytes) {
    std::vector<std::string> lines;
    const Result<Bytes> bytes = read_file(file, max_bytes);
    if (!bytes) {
        return lines;
    }
    std::string_view text = as_text(*bytes);
    while (!text.empty() && lines.size() < max_notes) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (line.starts_with(own_prefix)) {
            line.remove_prefix(own_prefix.size());
        }
        if (!line.empty()) {
            lines.push_back(printable(line, max_line_bytes));
        }
    }
    return lines;
}

std::string word_of(const std::filesystem::path& file) {
    std::vector<std::string> lines = lines_of(file, max_word_bytes);
    return lines.empty() ? std::string() : std::move(lines.front());
}

} // namespace

SystemImage read_system_image(const std::filesystem::path& folder) {
    SystemImage image{word_of(folder / "version"), word_of(folder / "slot"),
                      lines_of(folder / "notes", max_note_bytes)};
    if (image.slot.starts_with(slot_prefix)) {
        image.slot.erase(0, slot_prefix.size());
    }
    return image;
}

} // namespace frustumscreen::status
