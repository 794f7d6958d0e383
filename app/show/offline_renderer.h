/// Pictures of a pack without a screen, with the same plan and renderer as the live exhibit.
///
/// Frames   as tracked_state.h: table T, metres.
/// Threads  the thread that created it. Its GL context is current after `create` and after `draw`.
/// Errors   no EGL or OpenGL ES, an unknown technique, a pack that the driver cannot hold.
#pragma once

#include "app/image/image.h"
#include "app/render/hit_points.h"
#include "app/render/renderer.h"
#include "app/scene/error_estimate.h"
#include "app/scene/frame_plan.h"
#include "app/scene/pinned_view.h"
#include "app/scene/stereo.h"
#include "app/show/offline_scene.h"
#include "app/show/patch_job.h"
#include "firmware_host/display/surfaceless_display.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::show {

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
    ~OfflineRenderer();
    OfflineRenderer(const OfflineRenderer&) = delete;
    OfflineRenderer& operator=(const OfflineRenderer&) = delete;

    /// `eyes_m`: one, or with OfflineOptions::both_eyes one for each eye of the layout (scene/stereo.h). `seconds`: since
    /// the behaviour began.
    /// `torches`: none without OfflineOptions::torch.
    [[nodiscard]] OfflinePicture draw(const geometry::RigidTransform& table_from_prop,
                                      std::span<const glm::dvec3> eyes_m, double seconds = 0.0,
                                      std::span<const scene::PlacedTorch> torches = {});
    /// Pins what the eye sees through the prop at this pose as a window; `draw` draws it from then on. The artifact
    /// in it stays as it is at that time, in the light of `torches`, table frame. At most OfflineOptions::windows.
    /// False: the eye is not above the table.
    [[nodiscard]] bool pin(const scene::WindowPlace& place, const geometry::RigidTransform& table_from_prop,
                           const glm::dvec3& eye_m, double seconds = 0.0,
                           std::span<const scene::PlacedTorch> torches = {});
    /// The torch of the settings with the content of the options, `seconds` after it began. Needs OfflineOptions::torch.
    [[nodiscard]] scene::PlacedTorch torch_at(const geometry::RigidTransform& table_from_torch,
                                              double seconds);
    [[nodiscard]] OfflinePicture draw(const geometry::RigidTransform& table_from_prop,
                                      const glm::dvec3& eye_m) {
        return draw(table_from_prop, std::span(&eye_m, 1));
    }

    [[nodiscard]] const geometry::Pinhole& projector() const { return projector_; }
    [[nodiscard]] const geometry::PropShape& prop() const { return prop_; }
    /// "level0", "relief96", ...: the choice of "auto", "finest" or "relief"; of cells that differ, "level0+relief96".
    [[nodiscard]] const std::string& technique() const { return technique_; }

private:
    /// The whole artifact, or one of its cells.
    struct Shown {
        scene::SeenLevel seen;
        std::optional<std::size_t> cell;
    };

    struct Window {
        scene::PinnedView view;
        std::vector<scene::Part> parts;
        std::unique_ptr<PatchJob> patches;         ///< none: not asked for
        std::vector<scene::PlacedTorch> torches{}; ///< table frame
    };
    /// A level's triangles and texture, for the windows' patches.
    struct Kept {
        scene::SceneLevel level;
        image::Image8 texture;
    };

    OfflineRenderer(const scene::StereoLayout& layout, const scene::ScenePlan& plan);
    /// Creates a renderer for all of the scene, and takes what it draws.
    [[nodiscard]] Result<void> take(const OfflineScene& scene);
    [[nodiscard]] Result<void> take_torch(const OfflineScene& scene);
    /// Makes all patches of a window.
    [[nodiscard]] std::unique_ptr<PatchJob> patches_of(const Window& window, const glm::dvec3& eye_m) const;
    /// Shows the film's frame at this time since its content began.
    void show_film(double seconds);
    void pose_cells(double seconds);
    void draw_once(std::span<const scene::PlanView> views);
    [[nodiscard]] std::optional<scene::ErrorEstimate> error_in(const scene::PlanView& view,
                                                               const scene::FramePlan& plan) const;
    [[nodiscard]] std::optional<scene::ErrorEstimate> error_of(std::span<const scene::PlanView> views) const;

    scene::StereoLayout layout_;
    geometry::Pinhole projector_; ///< of one eye's picture
    geometry::RigidTransform table_from_projector_;
    geometry::PropShape prop_;
    std::optional<scene::LightCompensation> light_;
    double exposure_ = 1.0;
    std::string technique_;
    double metres_per_box_ = 1.0; ///< of the whole artifact
    std::vector<Shown> shown_;
    std::vector<scene::Part> parts_; ///< one for each of `shown_`
    std::vector<world::Cell> cells_;
    world::Behaviour behaviour_;
    std::optional<double> held_s_; ///< as OfflineWorld
    std::optional<world::SiteView> site_;
    std::optional<OfflineTorch> torch_;
    torch::Beam beam_;
    scene::TextureId torch_picture_ = scene::TextureId::None;
    std::size_t film_frame_ = 0;
    std::vector<Kept>
        kept_; ///< one for each of `parts_`; empty: no patches are made, as for a relief in a state's layer
    std::vector<std::unique_ptr<const Window>> windows_;
    std::vector<scene::PlacedWindow> placed_windows_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
    std::unique_ptr<display::SurfacelessDisplay>
        display_; ///< declared before everything that lives in its context
    std::optional<render::Renderer> renderer_;
    std::optional<render::HitPointRenderer> hit_points_;
    bool warm_ = false;
};

} // namespace frustumscreen::show
