/// An artifact read from its pack, verified, culled and made ready in main memory: nothing of it is in the GPU's memory
/// yet.
///
/// Memory   a pack is read level by level, so that no more than one level lies there twice.
/// Threads  pure but for the file; any.
/// Errors   as load_pack; a pack that is no longer the one that the plan was made for. Messages begin with the file's
///          name.
#pragma once

#include "app/exhibit/hotspot_labels.h"
#include "app/pack/pack_outline.h"
#include "app/residency/artifact_texts.h"
#include "app/residency/run_levels.h"
#include "app/scene/frame_time_model.h"
#include "app/scene/level_data.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

/// What is known of an artifact as long as the exhibit runs.
struct KnownArtifact {
    std::filesystem::path file;
    PackOutline outline;
    ScenePlan plan;
    ArtifactTexts texts{};
};

struct PreparedArtifact {
    RunLevels levels;
    std::vector<LevelData> data; ///< of its levels, to upload
    double exposure = 1.0;       ///< factor of linear light
    ArtifactTriangles triangles; ///< none where it has no hotspots
};

/// `given_up`: asked between two levels; where it says yes, the artifact is not prepared.
[[nodiscard]] Result<PreparedArtifact> prepare_artifact(const KnownArtifact& known,
                                                        const std::string& technique, double deadline_ms,
                                                        const std::function<bool()>& given_up);

/// Of some of its texts, as draw_texts.
[[nodiscard]] Result<TextPictures> prepare_texts(const KnownArtifact& known, TextPart part,
                                                 std::size_t language, const TextStyle& style,
                                                 const std::function<bool()>& given_up);

/// About so many bytes will be taken by its levels and what hides its hotspots; `texture_bytes`: of a level's texture, as other artifacts have them.
[[nodiscard]] std::uint64_t expected_bytes(const KnownArtifact& known, std::uint64_t texture_bytes);

} // namespace frustumscreen
