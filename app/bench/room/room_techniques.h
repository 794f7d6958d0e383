/// The ways to draw the room that `frustumscreen-bench room` compares. All of them cull by the volume that the eye sees through
/// the screen, and draw with the exhibit's plan and renderer at the same samples a pixel.
///
/// ours      the exhibit's own RoomShow, as `render --output screen` has it.
/// polygons  each object at one level of its pack: the coarsest whose mean error is within a limit in millimetres.
/// relief    each object at one relief of its pack, by the same rule; floor and walls as relief too, or as polygons.
/// lod       for each object, by its distance, the coarsest of meshoptimizer's levels whose error is within a limit
///           in pixels.
/// paper     Kim 2008 (paper_choice.h) with Eq. (1) over the objects: the most important are polygons while those of the
///           frame suffice, the others are relief with texels of about a pixel, chosen anew in each frame.
///
/// Threads  that of the set, which must outlive the technique.
#pragma once

#include "app/bench/mixed/paper_choice.h"
#include "app/bench/room/room_set.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// An object that the eye can see in a frame.
struct SeenObject {
    std::size_t object = 0; ///< index into Room::objects
    geometry::RigidTransform table_from_object;
    glm::dvec3 middle_m{0.0};
    double radius_m = 0.0;
    double away_m = 0.0; ///< from the eye to the nearest point that its ball may have
};
/// The objects whose ball reaches into the volume that the eye sees through the screen.
void find_seen(const RoomSet& set, const RoomFrame& frame, std::vector<SeenObject>& seen);
/// The angle of a pixel for this eye, where the screen is nearest to it, radians.
[[nodiscard]] double pixel_angle(const RoomSet& set, const glm::dvec3& eye_m);

class RoomTechnique {
public:
    virtual ~RoomTechnique() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// The peer's setting, for the table; empty: it has none.
    [[nodiscard]] virtual std::string setting() const { return {}; }
    /// Chooses, culls, plans and draws the whole picture; the caller waits until it is drawn.
    virtual void draw(const RoomFrame& frame) = 0;
    /// The plan of the latest picture.
    [[nodiscard]] virtual const scene::FramePlan& plan() const = 0;
    /// The renderer that draws the plan.
    [[nodiscard]] virtual const render::Renderer& renderer() const = 0;
};

/// `settings.screen.room` must name the room's file; the display of the set is current.
[[nodiscard]] Result<std::unique_ptr<RoomTechnique>> make_room_ours(RoomSet& set);
[[nodiscard]] std::unique_ptr<RoomTechnique> make_room_polygons(RoomSet& set, double error_mm);
[[nodiscard]] std::unique_ptr<RoomTechnique> make_room_relief(RoomSet& set, double error_mm,
                                                              bool shell_as_polygons);
[[nodiscard]] std::unique_ptr<RoomTechnique> make_room_lod(RoomSet& set, double error_px);

/// The polygons of the paper's way.
struct PaperPolygons {
    double error_mm = 0.0; ///< the pack's level, as `polygons`
    std::size_t each = 0;  ///< or, above 0: triangles; meshoptimizer's level with the nearest number is taken
};
[[nodiscard]] std::unique_ptr<RoomTechnique> make_room_paper(RoomSet& set, const PaperWeights& weights,
                                                             const PaperPolygons& polygons,
                                                             double polygons_a_frame);
/// The weights of least error on these frames, by the packs' own errors.
[[nodiscard]] PaperWeights room_weights(const RoomSet& set, const PaperPolygons& polygons,
                                        std::span<const RoomFrame> frames);
/// The number of polygons of all objects, drawn as `polygons` says.
[[nodiscard]] double all_room_polygons(const RoomSet& set, const PaperPolygons& polygons);

} // namespace frustumscreen::bench
