/// A curator's folder: the scan, and `artifact.toml` with all inputs of the bake.
///
/// Frames   hotspots in the scan's own coordinates.
/// Errors   only the first, as one line: file, line, key, the value found, the values allowed; for an unknown key
///          the nearest known one.
/// Threads  pure apart from reading the file; any.
#pragma once

#include "app/pack/pack.h"
#include "assets_baked/folder/artifact_behaviours.h"
#include "assets_baked/folder/artifact_states.h"
#include "assets_baked/folder/artifact_torches.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::folder {

inline constexpr std::string_view artifact_file_name = "artifact.toml";
/// Folder of recordings that the file does not name, relative to the artifact's folder: LANGUAGE/description.wav and
/// others.
inline constexpr std::string_view recordings_folder_name = "recordings";

struct ArtifactHotspot {
    std::string place; ///< file, line and key, for messages
    glm::dvec3 point_file{0.0};
    std::vector<pack::PackLabel> labels;
};

/// Terrain and buildings, of which a region can be shown large.
struct ArtifactSite {
    int max_triangles = 150'000; ///< of a region
};
inline constexpr int min_region_triangles = 1'000, max_region_triangles = 500'000;

/// The file's values; missing ones have the bake's defaults.
struct ArtifactFile {
    std::filesystem::path scan;    ///< path including the folder
    std::filesystem::path texture; ///< path including the folder; empty: the scan's own
    std::string id;
    std::string licence; ///< this and the next two describe the scan; empty: as in the scan's own file
    std::string author;
    std::string source;
    int size = 512; ///< texels
    bool unlit = false;
    std::string prop = "frustum";
    std::string up;                 ///< empty: the format's own
    std::optional<double> turn_deg; ///< nothing: the best turn
    double scale = 1.0;
    double lift = 0.0;
    std::vector<pack::PackCaption> texts; ///< in the file's order; a missing title is the first text's
    std::map<std::string, std::filesystem::path> recordings; ///< by language; paths including the folder
    std::vector<ArtifactHotspot> hotspots;
    std::vector<ArtifactBehaviour> behaviours;
    std::vector<ArtifactTorch> torches;
    std::vector<ArtifactState> states;
    std::optional<ArtifactSite> site; ///< nothing: the artifact is none
};

/// `file` is the name in messages; paths in the text are relative to its folder.
[[nodiscard]] Result<ArtifactFile> parse_artifact_file(std::string_view text,
                                                       const std::filesystem::path& file);
/// Reads the `artifact.toml` of a folder.
[[nodiscard]] Result<ArtifactFile> read_artifact_file(const std::filesystem::path& folder);

} // namespace frustumscreen::folder
