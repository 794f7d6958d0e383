/// Pictures of a pack without a screen, with the same plan and renderer as the live exhibit.
///
/// Frames   as tracked_state.h: table T, metres.
/// Threads  the thread that created it, which holds its GL context.
/// Errors   no EGL or OpenGL ES, an unknown technique, a pack that the driver cannot hold.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack_file.h"
#include "app/render/hit_points.h"
#include "app/render/renderer.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/scene_level.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "firmware_host/display/surfaceless_display.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::show {

struct OfflineOptions {
    std::string technique = "auto";
    int width = 0; ///< of the picture; 0 = the configured projector's. The intrinsics scale with it.
    int height = 0;
    bool light = true;
    bool hit_points = false; ///< of one eye's picture
    bool both_eyes = false;  ///< in the configured layout; otherwise one eye's picture, in the full size
    int samples = 0;         ///< a pixel; 0 = finest_samples for "finest", otherwise the pack's
    unsigned cull_kinds = scene::AllCullKinds;
    /// All poses that will be drawn, one entry for each eye; empty: any pose may be drawn.
    std::vector<scene::KnownView> views;
};

struct OfflineSetup {
    settings::CheckedSettings settings;
    OfflineOptions options;
};
/// A pack's file, of which only what its pictures need was read.
struct OfflineScene {
    OfflineSetup setup;
    scene::ScenePlan plan;
    pack::VerifiedPack pack;
    std::shared_ptr<const relief::BlockRelief> relief; ///< in place of a level
};
/// `setup_of` returns the set-up for a pack's outline.
[[nodiscard]] Result<OfflineScene>
load_offline(const std::filesystem::path& file,
             const std::function<Result<OfflineSetup>(const pack::PackOutline&)>& setup_of);

struct OfflinePicture {
    image::Image8 colour;
    std::optional<image::ImageFloat> hit_points; ///< prop frame, metres; NaN = no hit
    std::optional<scene::ErrorEstimate> error;   ///< nothing: no part of the artifact is visible
    double ms = 0.0; ///< of plan and full redraw until the GPU is done, without read-back
};

class OfflineRenderer {
public:
    /// `scene` need not outlive the call.
    [[nodiscard]] static Result<std::unique_ptr<OfflineRenderer>> create(const OfflineScene& scene);

    /// `eyes_m`: one, or with OfflineOptions::both_eyes one for each eye of the layout (scene/stereo.h).
    [[nodiscard]] OfflinePicture draw(const geometry::RigidTransform& table_from_prop,
                                      std::span<const glm::dvec3> eyes_m);
    [[nodiscard]] OfflinePicture draw(const geometry::RigidTransform& table_from_prop,
                                      const glm::dvec3& eye_m) {
        return draw(table_from_prop, std::span(&eye_m, 1));
    }

    [[nodiscard]] const geometry::Pinhole& projector() const { return projector_; }
    [[nodiscard]] const geometry::PropShape& prop() const { return prop_; }
    /// "level0", "relief96", ...: the choice of "auto", "finest" or "relief".
    [[nodiscard]] const std::string& technique() const { return technique_; }

private:
    OfflineRenderer(const scene::StereoLayout& layout, const scene::ScenePlan& plan);
    /// Takes the level or relief to draw, and creates a renderer for it.
    [[nodiscard]] Result<void> take_level(const OfflineScene& scene);
    [[nodiscard]] Result<void> take_relief(const OfflineScene& scene);
    void draw_once(std::span<const scene::PlanView> views);
    [[nodiscard]] std::optional<scene::ErrorEstimate> error_of(std::span<const scene::PlanView> views) const;

    scene::StereoLayout layout_;
    geometry::Pinhole projector_; ///< of one eye's picture
    geometry::RigidTransform table_from_projector_;
    geometry::PropShape prop_;
    std::optional<scene::LightCompensation> light_;
    double exposure_ = 1.0;
    std::string technique_;
    scene::SeenLevel seen_;
    scene::PlacedLevel placed_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    std::unique_ptr<display::SurfacelessDisplay>
        display_; ///< declared before everything that lives in its context
    std::optional<render::Renderer> renderer_;
    std::optional<render::HitPointRenderer> hit_points_;
    bool warm_ = false;
};

} // namespace frustumscreen::show
