/// The picture of the screen behind the table: the room's objects, each drawn by the quickest quality level that is good enough
/// for the eye's place.
///
/// Culled   objects outside the eye's frustum through the screen, or hidden by solids, are neither planned nor drawn
///          (room_view.h).
/// Choice   scene/room_choice.h, within the microseconds that the projector's picture leaves (set_budget). All objects are drawn
///          as rasterized reliefs, or all as polygons, whichever is quicker at the start: a mixed picture costs almost as much as
///          two. A pack that lacks that kind is drawn as the other.
/// Fades    an object in view changes its quality level, or appears, by a dithered fade. Out of view it changes at once. If time is
///          short, a quicker one is taken at once.
/// Loading  live, packs are read as the eye nears (residency/room_models.h), and an object that is not loaded yet is missing;
///          otherwise each picture waits for all that it needs. They take `room_share` of `exhibit.memory_mb`.
///
/// Frames   table T; metres. The plans' prop frame is the table frame.
/// Threads  the render thread, with the display's context current, including destruction. `draw` allocates nothing once everything is
///          loaded and as much was drawn before.
/// Errors   as read_room and know_model; a driver without memory. Live, a pack that cannot be opened or read is missing, with
///          one sentence (`faults`), and the rest is shown.
#pragma once

#include "app/render/renderer.h"
#include "app/residency/room_models.h"
#include "app/room/room.h"
#include "app/room/taking.h"
#include "app/scene/flat_screen.h"
#include "app/scene/frame_plan.h"
#include "app/scene/frame_time_model.h"
#include "app/scene/room_choice.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "app/show/room_view.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::show {

struct RoomShowOptions {
    int samples = 2;        ///< a pixel
    bool both_eyes = false; ///< in the screen's layout; otherwise one eye's picture, in the full size
    bool live = false;      ///< reads packs while it draws, and measures what pictures cost on this machine
    bool culls = true;      ///< false: every object is drawn, for comparison
};

class RoomShow {
public:
    /// A share of `exhibit.memory_mb`. The artifacts in the prop have the rest.
    static constexpr double room_share = 0.5;
    static constexpr std::size_t max_fades = 16; ///< at a time

    /// Counts of the latest picture.
    struct Counts {
        std::size_t in_view = 0; ///< objects in the eye's frustum
        std::size_t seen = 0;    ///< of these, that are not certainly hidden
        std::size_t drawn = 0;   ///< of these, that are loaded
        std::size_t fading = 0;
        bool is_short = false; ///< for lack of time, some objects are coarser than the tolerance
    };

    /// The settings must have a screen.
    [[nodiscard]] static Result<std::unique_ptr<RoomShow>> create(const settings::Settings& settings,
                                                                  const RoomShowOptions& options);

    /// For the next pictures, microseconds; infinite at first.
    void set_budget(double budget_us) { budget_us_ = budget_us; }
    /// The objects that are not in their places in the next picture (room/taking.h); valid until it is drawn.
    void set_taken(std::span<const room::TakenPose> taken) { taken_ = taken; }
    /// `seconds`: since the objects began to move. `eyes_m`: one for each eye of the layout.
    [[nodiscard]] render::DrawResult draw(double seconds, std::span<const glm::dvec3> eyes_m,
                                          const render::RenderTarget& target, render::Redraw redraw);
    /// The latest `draw` took `ms` until its picture was complete; later choices assume this speed.
    void record_time(double ms);

    /// Factor of all light, 0..1, from the next `draw` on.
    void set_light(double light) { light_ = light; }
    /// Pixels of the whole picture, both eyes' included.
    [[nodiscard]] PixelSize size() const { return layout_.display; }
    [[nodiscard]] const scene::FlatScreen& screen() const { return screen_; }
    [[nodiscard]] const render::Renderer& renderer() const { return renderer_; }
    /// The plan of each eye's latest picture.
    [[nodiscard]] std::span<const scene::FramePlan> plans() const { return plans_; }
    /// The error of the latest picture: the mean over the objects by their pixels.
    [[nodiscard]] double error_mm() const { return error_mm_; }
    [[nodiscard]] const Counts& counts() const { return counts_; }
    [[nodiscard]] const residency::RoomModels& models() const { return *models_; }
    /// One sentence for each pack that is missing.
    [[nodiscard]] std::span<const std::string> faults() const { return faults_; }

private:
    static constexpr std::uint32_t none = scene::RoomChoice::none;
    /// The quality level of an object, and the one that it fades to.
    struct Shown {
        std::uint32_t quality_level = none, coming = none;
        double fade_start_s = 0.0;
        bool was_seen = false; ///< in the previous picture
    };
    /// The manifests and what is missing.
    struct Opened {
        std::vector<std::optional<residency::KnownModel>> models;
        std::vector<std::string> faults;
    };
    [[nodiscard]] static Result<Opened> open(const room::Room& room, bool live);
    RoomShow(const settings::Settings& settings, const RoomShowOptions& options, room::Room room,
             render::Renderer renderer, Opened opened);
    void reserve(std::span<const std::optional<residency::KnownModel>> models);
    [[nodiscard]] Result<void> measure();

    /// True if a picture of this kind (reliefs or polygons) may draw the object by this quality level.
    [[nodiscard]] bool allows(const residency::KnownModel& model,
                              const residency::KnownQualityLevel& quality_level) const;
    [[nodiscard]] double error_px(const residency::KnownQualityLevel& quality_level,
                                  std::uint32_t object) const;
    [[nodiscard]] double cost_us(const residency::KnownQualityLevel& quality_level,
                                 std::uint32_t object) const;
    [[nodiscard]] double pixels_of(std::uint32_t object) const;
    [[nodiscard]] std::uint32_t quickest_enough(std::uint32_t object) const;
    void look(double seconds, std::span<const glm::dvec3> eyes_m);
    void choose_kind();
    void load();
    void choose(double seconds);
    void change(std::uint32_t object, double seconds);
    void add_parts(double seconds);
    void add_part(std::uint32_t object, std::uint32_t quality_level,
                  const std::optional<scene::Dither>& dither);

    RoomShowOptions options_;
    room::Room room_;
    scene::FlatScreen screen_;
    scene::StereoLayout layout_;
    double tolerance_px_;
    render::Renderer renderer_;
    std::unique_ptr<residency::RoomModels> models_; ///< one for each pack
    std::vector<std::string> faults_;
    std::size_t faults_known_ = 0; ///< of the models'
    RoomView view_;
    std::vector<Shown> shown_; ///< by object
    scene::RoomChoice choice_;
    std::vector<scene::RoomSeen> seen_;
    std::vector<scene::RoomOption> options_of_seen_;
    std::vector<scene::Part> parts_;
    std::size_t max_indices_ = 0;         ///< of all parts of a picture
    std::size_t indices_ = 0;             ///< of this picture's
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    scene::FrameCost cost_;
    std::optional<bool> rasterizes_; ///< the picture's kind; unknown before something was seen
    double px_rad_ = 1.0;            ///< angle of a pixel in the middle of the picture
    double budget_us_ = std::numeric_limits<double>::infinity();
    double log_load_ = 0.0;
    double expected_ms_ = 0.0;
    std::span<const room::TakenPose> taken_;
    double error_mm_ = 0.0;
    Counts counts_;
    double light_ = 1.0;
};

} // namespace frustumscreen::show
