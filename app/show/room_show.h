/// The picture of the screen behind the table: the room's objects, each drawn in the quickest way that is good enough from
/// where the eye is.
///
/// Frames   table T; metres. The plans' prop frame is the table frame.
/// Threads  the render thread, with the display's context current, including destruction. `draw` allocates nothing after the
///          first picture.
/// Errors   as read_room and read_model; a driver without memory.
#pragma once

#include "app/render/renderer.h"
#include "app/residency/room_model.h"
#include "app/room/room.h"
#include "app/room/taking.h"
#include "app/scene/flat_screen.h"
#include "app/scene/frame_plan.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::show {

struct RoomShowOptions {
    int samples = 2;        ///< a pixel
    bool both_eyes = false; ///< in the screen's layout; otherwise one eye's picture, in the full size
};

class RoomShow {
public:
    /// The settings must have a screen.
    [[nodiscard]] static Result<std::unique_ptr<RoomShow>> create(const settings::Settings& settings,
                                                                  const RoomShowOptions& options);

    /// The objects that are not in their places in the next picture (room/taking.h); valid until it is drawn.
    void set_taken(std::span<const room::TakenPose> taken) { taken_ = taken; }
    /// `seconds`: since the objects began to move. `eyes_m`: one for each eye of the layout.
    [[nodiscard]] render::DrawResult draw(double seconds, std::span<const glm::dvec3> eyes_m,
                                          const render::RenderTarget& target, render::Redraw redraw);

    /// Of the whole picture, both eyes' included.
    [[nodiscard]] PixelSize size() const { return layout_.display; }
    [[nodiscard]] const scene::FlatScreen& screen() const { return screen_; }
    [[nodiscard]] const render::Renderer& renderer() const { return renderer_; }
    /// Of each eye's latest picture.
    [[nodiscard]] std::span<const scene::FramePlan> plans() const { return plans_; }
    /// Of the latest picture: the mean over the objects by their pixels.
    [[nodiscard]] double error_mm() const { return error_mm_; }

private:
    RoomShow(const settings::Settings& settings, const RoomShowOptions& options, room::Room room,
             render::Renderer renderer);
    /// The way to draw an object of this size whose nearest point is `away_m` from the eye.
    [[nodiscard]] const residency::ModelWay& choose(const residency::RoomModel& model, double size_m,
                                                    double away_m, double tolerance_rad) const;
    void place_objects(double seconds, const glm::dvec3& eye_m);

    RoomShowOptions options_;
    room::Room room_;
    scene::FlatScreen screen_;
    scene::StereoLayout layout_;
    double tolerance_px_;
    render::Renderer renderer_;
    std::vector<residency::RoomModel> models_; ///< one for each pack
    std::vector<scene::Part> parts_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    std::span<const room::TakenPose> taken_;
    double error_mm_ = 0.0;
};

} // namespace frustumscreen::show
