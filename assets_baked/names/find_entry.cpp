#include "assets_baked/names/find_entry.h"

#include "assets_baked/names/file_name.h"

#include <string>
#include <system_error>

namespace frustumscreen::names {

std::optional<std::filesystem::path> find_entry(const std::filesystem::path& folder, std::string_view name) {
    std::error_code stop;
    if (std::filesystem::exists(folder / name, stop)) {
        return folder / name;
    }
    const std::string folded = folded_file_name(name);
    std::optional<std::string> first;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, stop);
    for (; !stop && entry != std::filesystem::directory_iterator(); entry.increment(stop)) {
        const std::string each = entry->path().filename().string();
        if (folded_file_name(each) == folded && (!first || each < *first)) {
            first = each;
        }
    }
    return first ? std::optional(folder / *first) : std::nullopt;
}

} // namespace frustumscreen::names
