/// A curator's folder: `artifact.toml`, which says all that the bake needs to know, beside the scan.
///
/// Frames   hotspots in the scan's own coordinates.
/// Errors   the first one, as one line: file, line, key, what was found, what is allowed; the nearest right key for
///          one that is not known.
/// Threads  pure apart from reading the file; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

inline constexpr std::string_view artifact_file_name = "artifact.toml";
/// Recordings that the file does not name: LANGUAGE/description.wav and the like in this folder of the folder.
inline constexpr std::string_view recordings_folder_name = "recordings";

struct ArtifactHotspot {
    std::string place; ///< file, line and key, for messages
    glm::dvec3 point_file{0.0};
    std::vector<PackLabel> labels;
};

/// What is left out has the value that the bake has without the file.
struct ArtifactFile {
    std::filesystem::path scan;    ///< with the folder in front
    std::filesystem::path texture; ///< the same; empty: the scan's own
    std::string id;
    std::string licence; ///< this and the next two: of the scan; empty: what its file says of itself
    std::string author;
    std::string source;
    int size = 512; ///< texels
    bool unlit = false;
    std::string prop = "frustum";
    std::string up;                 ///< empty: the format's own
    std::optional<double> turn_deg; ///< nothing: the best
    double scale = 1.0;
    double lift = 0.0;
    std::vector<PackCaption> texts; ///< in the file's order; a title that is left out is the first one's
    std::map<std::string, std::filesystem::path>
        recordings; ///< of descriptions, by language; with the folder in front
    std::vector<ArtifactHotspot> hotspots;
};

/// `file` is the name for messages; paths in the text are relative to its folder.
[[nodiscard]] Result<ArtifactFile> parse_artifact_file(std::string_view text,
                                                       const std::filesystem::path& file);
/// Reads `artifact.toml` of the folder.
[[nodiscard]] Result<ArtifactFile> read_artifact_file(const std::filesystem::path& folder);

} // namespace frustumscreen
