/// Finds a file or folder by a name that another computer or a person may have spelled differently.
///
/// Method   the name as it is; otherwise the alphabetically first of those that mean the same file (file_name.h).
/// Threads  any; reads the folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace frustumscreen::names {

/// The path of the entry `name` of `folder`, which may be empty for the current one.
[[nodiscard]] std::optional<std::filesystem::path> find_entry(const std::filesystem::path& folder,
                                                              std::string_view name);

} // namespace frustumscreen::names
