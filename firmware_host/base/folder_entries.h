/// The entries of a folder in the order of their paths.
///
/// Errors   `failed`: the folder cannot be read, or not to its end; the entries read before remain. No exceptions.
/// Threads  any.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace frustumscreen {

struct FolderEntries {
    std::vector<std::filesystem::directory_entry> entries;
    std::error_code failed;

    [[nodiscard]] auto begin() const { return entries.begin(); }
    [[nodiscard]] auto end() const { return entries.end(); }
};

[[nodiscard]] FolderEntries entries_of(const std::filesystem::path& folder);

} // namespace frustumscreen
