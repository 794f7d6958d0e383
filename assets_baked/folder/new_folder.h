/// Makes a curator's folder: the scan with its files, and an `artifact.toml` with every key, explained.
///
/// Errors   one line: an existing artifact.toml, a file in the way, a scan whose files are in other folders.
///          No file is replaced.
/// Threads  any.
#pragma once

#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::folder {

/// Properties of a scan that was read.
struct ScanFacts {
    std::filesystem::path file;
    std::vector<std::filesystem::path> side_files; ///< files that the scan names; some may be missing
    glm::dvec3 low{0.0}, high{0.0};                ///< its bounding box, in its own coordinates
    char default_up = 'y';
    std::string title, author, licence, source; ///< as in the scan's file; empty: not given
};

/// The text of a new `artifact.toml`. Only keys without a good default are set; the others are in comments.
[[nodiscard]] std::string new_artifact_text(const ScanFacts& scan, const std::string& title,
                                            const std::string& id);

/// Makes the folder if it is missing, copies the scan and its files into it unless they are there, and writes
/// `artifact.toml`. Returns the path of `artifact.toml`.
[[nodiscard]] Result<std::filesystem::path> start_folder(const std::filesystem::path& folder,
                                                         const ScanFacts& scan);

} // namespace frustumscreen::folder
