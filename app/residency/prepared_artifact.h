/// An artifact read from its pack, verified, culled and ready in main memory, before any upload to the GPU.
///
/// Memory   a pack is read level by level, so that at most one level is in memory twice.
/// Threads  pure except for reading the file; any.
/// Errors   as load_pack; a pack that has changed since its plan was made. Messages begin with the file's
///          name.
#pragma once

#include "app/exhibit/hotspot_labels.h"
#include "app/pack/pack_outline.h"
#include "app/pack/pack_states.h"
#include "app/residency/artifact_texts.h"
#include "app/residency/known_world.h"
#include "app/residency/run_cells.h"
#include "app/residency/run_levels.h"
#include "app/scene/frame_time_model.h"
#include "app/scene/level_data.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::residency {

/// Data of an artifact that stay in memory while the exhibit runs.
struct KnownArtifact {
    std::filesystem::path file;
    pack::PackOutline outline;
    scene::ScenePlan plan;
    ArtifactTexts texts{};
    std::shared_ptr<const KnownWorld> world{}; ///< null: no cell of it is drawn
    std::vector<pack::PackState> states{};     ///< that windows may show; none without windows
};

struct PreparedArtifact {
    RunLevels levels;
    std::vector<scene::LevelData> data;   ///< of the levels, then of the cells, to upload
    double exposure = 1.0;                ///< factor of linear light
    exhibit::ArtifactTriangles triangles; ///< none without hotspots
    std::unique_ptr<RunCells> cells{};    ///< null: nothing of the artifact moves
};

/// `given_up`: asked between two levels; true cancels the preparation.
[[nodiscard]] Result<PreparedArtifact> prepare_artifact(const KnownArtifact& known,
                                                        const std::string& technique, double deadline_ms,
                                                        const std::function<bool()>& given_up);

/// Prepares some of the texts; as draw_texts.
[[nodiscard]] Result<TextPictures> prepare_texts(const KnownArtifact& known, TextPart part,
                                                 std::size_t language, const TextStyle& style,
                                                 const std::function<bool()>& given_up);

/// Estimated bytes of a page of the artifact's site.
[[nodiscard]] std::uint64_t expected_page_bytes(const KnownWorld& world, const PageName& page,
                                                std::uint64_t texture_bytes);

/// Estimated bytes of the artifact's levels, without pages, and of the triangles that hide its hotspots; `texture_bytes`: of
/// one level's texture, estimated from other artifacts.
[[nodiscard]] std::uint64_t expected_bytes(const KnownArtifact& known, std::uint64_t texture_bytes);

} // namespace frustumscreen::residency
