/// Names the files of a curator's folder that nothing uses, so that a forgotten picture, recording or text is noticed.
///
/// Left out  hidden files, those of the computer's own file manager, what a bake writes (packs, their signatures,
///           preview pages, parts of an unfinished one), and everything in subfolders.
/// Errors    a folder that cannot be read has none.
/// Threads   any; reads the folder.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::folder {

/// Sorted names of the files beside artifact.toml that are not in `used`, paths in any form; some may be missing.
[[nodiscard]] std::vector<std::string> unused_files(const std::filesystem::path& folder,
                                                    std::span<const std::filesystem::path> used);
/// One sentence that names the first few; empty for none.
[[nodiscard]] std::string sentence_on_unused(const std::vector<std::string>& names);

} // namespace frustumscreen::folder
