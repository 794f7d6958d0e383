#include "app/bench/techniques/pack_level.h"

#include "app/pack/pack_hull.h"
#include "app/render/hit_points.h"
#include "app/scene/error_estimate.h"
#include "app/scene/exposure.h"
#include "app/scene/frame_plan.h"
#include "app/scene/light.h"
#include "app/scene/scene_level.h"
#include "app/scene/stereo.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

struct Parts {
    render::Renderer renderer;
    render::HitPointRenderer hit_points;
};

struct Light {
    std::optional<scene::LightCompensation> compensation;
    double exposure = 1.0;
    bool feathered = true;
};
struct Lights {
    Light measured, timed, shown;
};

Result<Lights> lights_of(const Kiosk& kiosk, const PictureOptions& options, const pack::Pack& pack) {
    TRY(const PictureLight light, shown_light(kiosk, pack));
    const Light shown{light.compensation, light.exposure, options.feathered};
    return Lights{.measured = options.lit ? shown : Light{},
                  .timed = options.lit || options.timed_lit ? shown : Light{},
                  .shown = shown};
}

int samples_of(const PictureOptions& options, const pack::Pack& pack) {
    return options.samples > 0 ? options.samples : pack.samples;
}

settings::Stereo stereo_of(const Kiosk& kiosk, const PictureOptions& options) {
    return options.both_eyes ? settings::stereo_of(kiosk.settings) : settings::Stereo::Off;
}
/// Measures move the principal point between pictures, so a layout holds for one picture alone.
scene::StereoLayout layout_of(const Kiosk& kiosk, settings::Stereo stereo) {
    return scene::stereo_layout(kiosk.settings.projector.pinhole, stereo);
}

/// The left and the right eye of a head that looks at the prop.
std::array<glm::dvec3, 2> eyes_of(const BenchPose& pose, double interocular_m) {
    const glm::dvec3 right =
        glm::cross(pose.table_from_prop.translation - pose.eye_m, glm::dvec3(0.0, 0.0, 1.0));
    const double length = glm::length(right);
    const glm::dvec3 half = 0.5 * interocular_m * (length > 0.0 ? right / length : glm::dvec3(1.0, 0.0, 0.0));
    return {pose.eye_m - half, pose.eye_m + half};
}

/// Needs with light and without: shown pictures are lit regardless of the options.
scene::RenderNeeds needs_of(const geometry::Pinhole& pinhole, int samples, scene::ShaderKey shader) {
    scene::RenderNeeds needs{std::max(samples, render::default_samples),
                             {{scene::ShaderKey::Pass::EdgeFeather}}};
    for (const bool lit : {false, true}) {
        shader.even_light = lit;
        needs.draws.insert(shader);
    }
    needs.bent_by = scene::if_it_bends(pinhole);
    return needs;
}

/// Keeps the alpha mask of a texture; without one, the picture is as small as its mip levels allow.
image::Image8 white(const image::Image8& texture, bool cut_out) {
    if (!cut_out) {
        constexpr int side = 1 << scene::coarsest_mip_level;
        return {side, side, glm::u8vec4(255)};
    }
    image::Image8 all = texture;
    for (glm::u8vec4& texel : all.texels) {
        texel = glm::u8vec4(255, 255, 255, texel.a);
    }
    return all;
}

/// The drawn surface, in its colours and in white.
struct Placed {
    scene::PlacedLevel coloured, white;
};

class PackLevelTechnique final : public Technique, public ShownPicture {
public:
    PackLevelTechnique(const Kiosk& kiosk, const PictureOptions& options, const Placed& placed,
                       std::optional<scene::SeenLevel> seen, const Lights& lights, std::string name,
                       Parts parts)
        : kiosk_(kiosk), stereo_(stereo_of(kiosk, options)), only_changes_(options.only_changes),
          placed_(placed), seen_(std::move(seen)), lights_(lights), name_(std::move(name)),
          parts_(std::move(parts)) {
        const std::size_t eyes = layout_of(kiosk, stereo_).count;
        plans_.reserve(eyes);
        for (std::size_t eye = 0; eye < eyes; ++eye) {
            plans_.push_back(scene::make_plan(kiosk.prop, placed.coloured));
        }
    }

    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override { draw(placed_.coloured, pose, lights_.measured); }
    void draw_timed(const BenchPose& pose) override { draw(placed_.coloured, pose, lights_.timed); }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose& pose) override {
        plan(placed_.coloured, pose, lights_.measured);
        return parts_.hit_points.draw(plans_.front(), parts_.renderer.store());
    }

    [[nodiscard]] std::optional<scene::ErrorEstimate> estimate(const BenchPose& pose) override {
        if (!seen_) {
            return std::nullopt;
        }
        plan(placed_.coloured, pose, lights_.measured);
        return scene::estimate_error(*seen_, kiosk_.prop, placed_.coloured, view_of(pose, lights_.measured),
                                     plans_.front());
    }

    [[nodiscard]] ShownPicture* as_shown() override { return this; }
    void draw_shown(const BenchPose& pose) override { draw(placed_.coloured, pose, lights_.shown); }
    [[nodiscard]] int draw_white(const BenchPose& pose) override {
        draw(placed_.white, pose, {});
        const scene::FramePlan& plan = plans_.front();
        return plan.relief_draw_count > 0 ? plan.relief_draws.front().samples : plan.samples;
    }
    [[nodiscard]] LightAim light(const BenchPose& pose) const override {
        const TruthView view = frustumscreen::bench::view_of(kiosk_.settings, pose);
        std::vector<scene::SeenFace> faces;
        for (const geometry::PropFace& face : kiosk_.prop.faces) {
            faces.push_back({&face, view.eye_m});
        }
        const glm::dvec3& projector = view.prop_from_projector.translation;
        const glm::dmat4 projector_from_prop = view.prop_from_projector.inverse().matrix();
        LightAim light{.reference =
                           scene::reference_light(faces, projector, lights_.shown.compensation.value()),
                       .exposure = lights_.shown.exposure,
                       .most = {},
                       .soft_edges = lights_.shown.feathered};
        for (const geometry::PropFace& face : kiosk_.prop.faces) {
            const bool lit = face.plane.distance(projector) > 0.0;
            light.most.push_back(
                lit ? static_cast<double>(scene::face_light(face, projector_from_prop, light.reference).most)
                    : 0.0);
        }
        return light;
    }

private:
    [[nodiscard]] scene::PlanView view_of(const BenchPose& pose, const Light& light) const {
        const settings::ProjectorSettings& projector = kiosk_.settings.projector;
        return {.projector = projector.pinhole,
                .table_from_projector = projector.table_from_projector,
                .table_from_prop = pose.table_from_prop,
                .eyes_m = {&pose.eye_m, 1},
                .light = light.compensation,
                .brightness = light.exposure};
    }
    void plan(const scene::PlacedLevel& placed, const BenchPose& pose, const Light& light) {
        const scene::StereoLayout layout = layout_of(kiosk_, stereo_);
        const std::array<glm::dvec3, 2> both_m = eyes_of(pose, 1e-3 * kiosk_.settings.eye.interocular_mm);
        const std::array<scene::PlanView, 2> views =
            scene::views_of(layout, view_of(pose, light), scene::drawn_eyes(layout, pose.eye_m, both_m));
        for (std::size_t eye = 0; eye < layout.count; ++eye) {
            scene::plan_frame(kiosk_.prop, placed, views[eye], plans_[eye]);
            if (!light.feathered) {
                plans_[eye].feathers.clear();
            }
        }
    }
    void draw(const scene::PlacedLevel& placed, const BenchPose& pose, const Light& light) {
        plan(placed, pose, light);
        if (only_changes_) {
            parts_.renderer.draw(plans_, {kiosk_.framebuffer, 1}, render::Redraw::Again);
        } else {
            parts_.renderer.draw(plans_, {kiosk_.framebuffer, 0}, render::Redraw::Everything);
        }
    }

    const Kiosk& kiosk_;
    settings::Stereo stereo_;
    bool only_changes_;
    Placed placed_;
    std::optional<scene::SeenLevel> seen_;
    Lights lights_;
    std::string name_;
    Parts parts_;
    std::vector<scene::FramePlan> plans_; ///< one for each eye
};

} // namespace

/// Uses the pack's default level for every technique, so one truth serves all. (The exhibit uses the first
/// quality level of its scene plan.) As in the exhibit, the picture dims by what is seen of the artifact.
Result<PictureLight> shown_light(const Kiosk& kiosk, const pack::Pack& pack) {
    const pack::PackLevel& level = pack.levels[pack.default_level];
    scene::LightCompensation compensation = scene::light_compensation(kiosk.settings);
    TRY(std::vector<glm::dvec3> hull, pack::hull_in(pack, kiosk.prop, scene::max_corners_in_frame));
    compensation.hull = std::make_shared<const std::vector<glm::dvec3>>(std::move(hull));
    return PictureLight{std::move(compensation),
                        scene::exposure_of(level, pack.box_size, pack.textures[level.texture],
                                           kiosk.settings.render.highlight_code)};
}

Result<std::unique_ptr<Technique>> make_pack_level(const Kiosk& kiosk, const pack::Pack& pack,
                                                   std::uint32_t level, const PictureOptions& options,
                                                   std::string name) {
    TRY(const scene::SeenByEyes seen, scene::seen_by_eyes(pack::outline_of(pack)));
    TRY(const Lights lights, lights_of(kiosk, options, pack));
    const scene::SceneLevel whole = scene::whole_level(pack, level);
    scene::ShaderKey shader;
    shader.cut_out = whole.cut_out;
    const scene::StereoLayout layout = layout_of(kiosk, stereo_of(kiosk, options));
    TRY(render::Renderer renderer,
        render::Renderer::create(layout.display.width, layout.display.height,
                                 needs_of(layout.pinhole, samples_of(options, pack), shader)));
    const image::Image8& texture = pack.textures[whole.mesh.texture];
    std::array<Result<scene::Drawable>, 2> drawables{
        renderer.store().upload(whole, texture),
        renderer.store().upload(whole, white(texture, whole.cut_out))};
    for (const Result<scene::Drawable>& drawable : drawables) {
        TRY_VOID(drawable);
    }
    TRY(render::HitPointRenderer hit_points, render::HitPointRenderer::create(renderer));
    Placed both;
    both.coloured = scene::placed(pack, level, pack::place(pack, kiosk.prop).metres_per_box, *drawables[0]);
    both.coloured.samples = samples_of(options, pack);
    both.white = both.coloured;
    both.white.drawable = *drawables[1];
    return std::make_unique<PackLevelTechnique>(kiosk, options, both, seen.levels[level], lights,
                                                std::move(name),
                                                Parts{std::move(renderer), std::move(hit_points)});
}

Result<std::unique_ptr<Technique>> make_pack_relief(const Kiosk& kiosk, const pack::Pack& pack,
                                                    std::shared_ptr<const relief::BlockRelief> relief,
                                                    std::optional<scene::SeenLevel> seen,
                                                    const PictureOptions& options, std::string name,
                                                    bool on_gpu) {
    TRY(const Lights lights, lights_of(kiosk, options, pack));
    const scene::StereoLayout layout = layout_of(kiosk, stereo_of(kiosk, options));
    scene::RenderNeeds needs;
    if (on_gpu) {
        scene::ShaderKey shader;
        shader.blocks = true;
        needs = needs_of(layout.pinhole, samples_of(options, pack), shader);
    } else {
        needs.draws = {scene::raster_shader()};
        needs.rasterizes = true;
    }
    TRY(render::Renderer renderer,
        render::Renderer::create(layout.display.width, layout.display.height, needs));
    TRY(render::HitPointRenderer hit_points, render::HitPointRenderer::create(renderer));
    auto white = std::make_shared<relief::BlockRelief>(*relief);
    std::fill(white->colours.begin(), white->colours.end(), glm::u8vec4(255));
    Placed both;
    for (const auto& [placed_as, shows] :
         {std::pair(&both.coloured, std::move(relief)),
          std::pair(&both.white, std::shared_ptr<const relief::BlockRelief>(std::move(white)))}) {
        TRY(const scene::Drawable drawable,
            on_gpu ? renderer.store().upload(shows) : renderer.store().keep(shows));
        *placed_as = scene::placed(pack, shows, pack::place(pack, kiosk.prop).metres_per_box, drawable);
        placed_as->samples = samples_of(options, pack);
        placed_as->on_gpu = on_gpu;
    }
    return std::make_unique<PackLevelTechnique>(kiosk, options, both, std::move(seen), lights,
                                                std::move(name),
                                                Parts{std::move(renderer), std::move(hit_points)});
}

} // namespace frustumscreen::bench
