/// Starts a curator's folder: the scan with its files, and an `artifact.toml` with every key, explained.
///
/// Errors   one line: an artifact.toml that is there already, a file in the way, a scan whose files lie elsewhere.
///          No file is replaced.
/// Threads  any.
#pragma once

#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

/// What is known of a scan that was read.
struct ScanFacts {
    std::filesystem::path file;
    std::vector<std::filesystem::path> side_files; ///< those that the scan names; some may be missing
    glm::dvec3 low{0.0}, high{0.0};                ///< its bounding box, in its own coordinates
    char default_up = 'y';
    std::string title, author, licence, source; ///< as the file says them; empty: it does not
};

/// The text of a new `artifact.toml`. Only what has no good value of itself is set; the rest stands in comments.
[[nodiscard]] std::string new_artifact_text(const ScanFacts& scan, const std::string& title,
                                            const std::string& id);

/// Makes the folder where it is missing, copies the scan and its files into it unless they lie there, and writes
/// `artifact.toml`, whose path is returned.
[[nodiscard]] Result<std::filesystem::path> start_folder(const std::filesystem::path& folder,
                                                         const ScanFacts& scan);

} // namespace frustumscreen
