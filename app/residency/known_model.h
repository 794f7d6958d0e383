/// A pack of the room behind the screen as its manifest describes it, and how one of its quality levels is read.
///
/// Units    box (pack.h), as LevelError; bytes of main and GPU memory together.
/// Threads  pure, apart from reading files; any.
/// Errors   as load_pack and load_relief: messages begin with the file's name.
#pragma once

#include "app/pack/pack_outline.h"
#include "app/pack/pack_relief.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/level_data.h"
#include "app/scene/room_culling.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::residency {

/// A quality level of the pack: a mesh level, or a relief that is rasterized on the processor.
struct KnownQualityLevel {
    std::string name;         ///< "level0", "relief96"
    std::uint32_t number = 0; ///< of the level, or of the relief among the reliefs
    bool relief = false;
    scene::SeenLevel seen;
    double mean_box = 0.0; ///< for the eye that sees the most of its error
    double judged_box =
        0.0; ///< what a tolerance counts (scene::judged_error): the mean alone hides the edges of a wall
    double work = 0.0;       ///< triangles or blocks
    std::uint64_t bytes = 0; ///< expected, until it has been read
};

struct KnownModel {
    std::filesystem::path file;
    glm::dvec3 box_size{1.0};
    std::vector<pack::ReliefOutline> reliefs;
    std::vector<KnownQualityLevel> quality_levels; ///< levels, finest last, then reliefs, finest last
};
/// Reads the manifest alone.
[[nodiscard]] Result<KnownModel> know_model(const std::filesystem::path& file);

/// A quality level as read, ready to be uploaded.
struct ReadQualityLevel {
    scene::LevelData data;
    std::shared_ptr<const scene::LevelTriangles> triangles; ///< of a level
    std::uint64_t bytes = 0;
};
[[nodiscard]] Result<ReadQualityLevel> read_quality_level(const KnownModel& model, std::size_t quality_level);
/// The box inside the model's solid (inner_box.h), of its finest level; nothing if it is not closed, has cut-out texels or more
/// than `max_solid_triangles`. In box units.
inline constexpr std::uint64_t max_solid_triangles = 500'000;
[[nodiscard]] Result<std::optional<scene::BoxCorners>> read_solid(const KnownModel& model);

} // namespace frustumscreen::residency
