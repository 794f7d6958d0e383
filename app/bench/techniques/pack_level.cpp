#include "app/bench/techniques/pack_level.h"

#include "app/render/hit_points.h"
#include "app/scene/error_estimate.h"
#include "app/scene/exposure.h"
#include "app/scene/frame_plan.h"

#include <algorithm>

namespace frustumscreen {

namespace {

struct Parts {
    Renderer renderer;
    HitPointRenderer hit_points;
};

/// What the exhibit does to the colours.
struct Light {
    std::optional<LightCompensation> compensation;
    double exposure = 1.0;
    bool feathered = true;
};

Light light_of(const Stage& stage, const Pack& pack, const SceneLevel& level, const PictureOptions& options) {
    if (!options.lit) {
        return {};
    }
    return {light_compensation(stage.settings),
            exposure_of(level.mesh, pack.box_size, pack.textures[level.mesh.texture],
                        stage.settings.render.highlight_code),
            options.feathered};
}

class PackLevelTechnique final : public Technique {
public:
    PackLevelTechnique(const Stage& stage, const PlacedLevel& placed_level, SeenLevel seen,
                       const Light& light, std::string name, Parts parts)
        : stage_(stage), placed_(placed_level), seen_(std::move(seen)), light_(light), name_(std::move(name)),
          parts_(std::move(parts)), plan_(make_plan(stage.prop, placed_)) {}

    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override {
        plan(pose);
        parts_.renderer.draw(plan_, {stage_.framebuffer, 0}, Redraw::Everything);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        plan(pose);
        return parts_.hit_points.draw(plan_, parts_.renderer.store());
    }

    [[nodiscard]] std::optional<ErrorEstimate> estimate(const BenchPose& pose) override {
        plan(pose);
        return estimate_error(seen_, stage_.prop, placed_, view_of(pose), plan_);
    }

private:
    [[nodiscard]] PlanView view_of(const BenchPose& pose) const {
        const ProjectorSettings& projector = stage_.settings.projector;
        return {projector.pinhole,    projector.table_from_projector,
                pose.table_from_prop, {&pose.eye_m, 1},
                light_.compensation,  light_.exposure};
    }
    void plan(const BenchPose& pose) {
        plan_frame(stage_.prop, placed_, view_of(pose), plan_);
        if (!light_.feathered) {
            plan_.feathers.clear();
        }
    }

    const Stage& stage_;
    PlacedLevel placed_;
    SeenLevel seen_;
    Light light_;
    std::string name_;
    Parts parts_;
    FramePlan plan_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_pack_level(const Stage& stage, const Pack& pack, std::uint32_t level,
                                                   const PictureOptions& options, std::string name) {
    const Result<std::vector<SeenLevel>> seen = seen_levels(outline_of(pack));
    if (!seen) {
        return tl::unexpected<Error>(seen.error());
    }
    const SceneLevel whole = whole_level(pack, level);
    ShaderKey shader;
    shader.cut_out = whole.cut_out;
    shader.even_light = options.lit;
    const int samples = options.samples > 0 ? options.samples : pack.samples;
    Result<Renderer> renderer =
        Renderer::create(stage.width(), stage.height(),
                         {std::max(samples, default_samples), {shader, {ShaderKey::Pass::EdgeFeather}}});
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    const Result<Drawable> drawable = renderer->store().upload(whole, pack.textures[whole.mesh.texture]);
    if (!drawable) {
        return tl::unexpected<Error>(drawable.error());
    }
    Result<HitPointRenderer> hit_points = HitPointRenderer::create(*renderer);
    if (!hit_points) {
        return tl::unexpected<Error>(hit_points.error());
    }
    PlacedLevel shown = placed(pack, level, place(pack, stage.prop).metres_per_box, *drawable);
    shown.samples = samples;
    return std::make_unique<PackLevelTechnique>(stage, shown, (*seen)[level],
                                                light_of(stage, pack, whole, options), std::move(name),
                                                Parts{std::move(*renderer), std::move(*hit_points)});
}

} // namespace frustumscreen
