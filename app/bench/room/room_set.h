/// The room's packs on a display of their own, each in every way that a peer of `frustumscreen-bench room` draws: the pack's
/// levels and reliefs, and meshoptimizer's levels of the source mesh.
///
/// Vertices  of all three are the pack's: 16 bits a coordinate, cut into the same clusters, so that they are culled and drawn
///           by the exhibit's own plan and renderer.
/// Light     none: a texture's codes pass unchanged.
/// Frames    table T, metres; box (pack.h).
/// Threads   the one that opened the set: the display's context is current there.
/// Errors    no display; a pack that cannot be read; a driver without memory.
#pragma once

#include "app/bench/room/room_scene.h"
#include "app/pack/pack_file.h"
#include "app/render/hit_points.h"
#include "app/render/renderer.h"
#include "app/scene/flat_screen.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/display/surfaceless_display.h"

#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::bench {

struct RoomWay {
    scene::PlacedLevel placed; ///< its box's longest edge is one metre
    double error_box = 0.0;    ///< mean distance from the source
    std::size_t polygons = 0;  ///< 0 for a relief
    double texel_box = 0.0;    ///< of a relief
};
/// Each list from coarse to fine.
struct RoomWays {
    glm::dvec3 box_size{1.0};
    std::size_t source_triangles = 0;
    bool is_shell = false; ///< a floor or a wall
    std::vector<RoomWay> meshes, reliefs, lods;
};

struct RoomSetOptions {
    int samples = 2; ///< a pixel
    std::size_t min_lod_triangles = 150;
    /// Triangles of one of meshoptimizer's levels, about; for the paper's own experiment.
    std::size_t polygons_each = 10'000;
};

class RoomSet {
public:
    /// `settings.screen`: size and corners. `sources`: one for each of the room's packs.
    [[nodiscard]] static Result<std::unique_ptr<RoomSet>> open(const settings::Settings& settings,
                                                               room::Room room,
                                                               std::vector<RoomSource> sources,
                                                               const RoomSetOptions& options);
    RoomSet(const RoomSet&) = delete;
    RoomSet& operator=(const RoomSet&) = delete;

    [[nodiscard]] const settings::Settings& settings() const { return settings_; }
    [[nodiscard]] const room::Room& room() const { return room_; }
    [[nodiscard]] const std::vector<RoomSource>& sources() const { return sources_; }
    [[nodiscard]] const std::vector<RoomWays>& ways() const { return ways_; }
    [[nodiscard]] const RoomWays& ways_of(const room::Object& object) const { return ways_[object.pack]; }
    [[nodiscard]] const std::vector<glm::dmat4>& box_from_file() const { return box_from_file_; }
    [[nodiscard]] const scene::FlatScreen& screen() const { return screen_; }
    [[nodiscard]] int samples() const { return samples_; }
    /// The sum over all objects.
    [[nodiscard]] std::size_t source_triangles() const;

    [[nodiscard]] render::Renderer& renderer() { return *renderer_; }
    [[nodiscard]] render::RenderTarget target() const { return {display_->framebuffer(), 0}; }

private:
    RoomSet(const settings::Settings& settings, room::Room room, std::vector<RoomSource> sources,
            int samples);
    [[nodiscard]] Result<void> add_ways(const RoomSource& source, const RoomSetOptions& options);
    [[nodiscard]] Result<void> add_lods(const pack::Pack& pack, const RoomSource& source,
                                        const RoomSetOptions& options, RoomWays& ways);

    settings::Settings settings_;
    room::Room room_;
    std::vector<RoomSource> sources_;
    scene::FlatScreen screen_;
    int samples_;
    std::unique_ptr<display::SurfacelessDisplay> display_; ///< first of all that lives in its context
    std::optional<render::Renderer> renderer_;
    std::vector<RoomWays> ways_;
    std::vector<glm::dmat4> box_from_file_;
};

} // namespace frustumscreen::bench
