#include "assets_baked/folder/unused_files.h"

#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace frustumscreen::folder {

namespace {

namespace fs = std::filesystem;

/// True for hidden files, those of file managers, and what a bake writes.
bool is_ignored(const fs::path& file) {
    static constexpr std::array<std::string_view, 3> names = {artifact_file_name, "Thumbs.db", "desktop.ini"};
    static constexpr std::array<std::string_view, 3> ends = {".fspack", ".minisig", ".html"};
    const std::string name = file.filename().string();
    const std::string end = file.extension().string();
    return name.starts_with('.') || end.starts_with(".part") ||
           std::find(names.begin(), names.end(), name) != names.end() ||
           std::find(ends.begin(), ends.end(), end) != ends.end();
}

} // namespace

std::vector<std::string> unused_files(const fs::path& folder, std::span<const fs::path> used) {
    std::vector<std::string> unused;
    std::error_code failed;
    for (fs::directory_iterator each(folder.empty() ? "." : folder, failed);
         !failed && each != fs::directory_iterator(); each.increment(failed)) {
        const fs::path& file = each->path();
        std::error_code none;
        const bool is_used = std::any_of(used.begin(), used.end(), [&](const fs::path& other) {
            return fs::equivalent(file, other, none);
        });
        if (each->is_regular_file(none) && !is_used && !is_ignored(file)) {
            unused.push_back(file.filename().string());
        }
    }
    std::sort(unused.begin(), unused.end());
    return unused;
}

std::string sentence_on_unused(const std::vector<std::string>& names) {
    constexpr std::size_t most = 5;
    if (names.empty()) {
        return {};
    }
    std::vector<std::string> shown;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
        shown.push_back(printable(names[i], 60));
    }
    const std::string rest = names.size() > most ? fmt::format(" and {} more", names.size() - most) : "";
    return fmt::format("that {}{} beside {} {} not used: neither it nor the scan names {}",
                       fmt::join(shown, ", "), rest, artifact_file_name, names.size() == 1 ? "is" : "are",
                       names.size() == 1 ? "it" : "them");
}

} // namespace frustumscreen::folder
