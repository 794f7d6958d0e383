/// A pack of the room behind the screen: every way to draw it, read and uploaded once for all of its instances.
///
/// Units    box (pack.h), as LevelError.
/// Threads  `read_model` any; `upload` the render thread, with the display's context current.
/// Errors   as load_pack; a driver without memory. Messages begin with the file's name.
#pragma once

#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"
#include "app/render/gpu_store.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/scene_level.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::residency {

/// A pack as read.
struct ReadModel {
    pack::VerifiedPack pack;
    scene::SeenByEyes seen;
    std::vector<std::shared_ptr<const relief::BlockRelief>> reliefs;
};
[[nodiscard]] Result<ReadModel> read_model(const std::filesystem::path& file);

/// A mesh level, or a relief that is rasterized on the processor.
struct ModelWay {
    std::string name;          ///< "level0", "relief96"
    scene::PlacedLevel placed; ///< its box's longest edge is one metre: `metres_per_box` is 1
    scene::SeenLevel seen;
    double mean_box = 0.0; ///< for the eye that sees the most of its error
    double work = 0.0;     ///< triangles or blocks
};

struct RoomModel {
    glm::dvec3 box_size{1.0};
    std::vector<ModelWay> ways; ///< levels, finest last, then reliefs, finest last

    [[nodiscard]] std::size_t max_indices() const;
};
[[nodiscard]] Result<RoomModel> upload(const ReadModel& read, render::GpuStore& store);

/// What a renderer needs for any model.
[[nodiscard]] scene::RenderNeeds needs_of_room(int samples);

} // namespace frustumscreen::residency
