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

/// `level`: of the pack, whose brightest places say how bright the artifact is shown.
Light light_of(const Stage& stage, const PictureOptions& options, const Pack& pack, std::size_t level) {
    if (!options.lit) {
        return {};
    }
    const PackLevel& shown = pack.levels[level];
    return {
        light_compensation(stage.settings),
        exposure_of(shown, pack.box_size, pack.textures[shown.texture], stage.settings.render.highlight_code),
        options.feathered};
}

class PackLevelTechnique final : public Technique {
public:
    PackLevelTechnique(const Stage& stage, const PlacedLevel& placed_level, std::optional<SeenLevel> seen,
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
        if (!seen_) {
            return std::nullopt;
        }
        plan(pose);
        return estimate_error(*seen_, stage_.prop, placed_, view_of(pose), plan_);
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
    std::optional<SeenLevel> seen_;
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
    RenderNeeds needs{std::max(samples, default_samples), {shader, {ShaderKey::Pass::EdgeFeather}}};
    needs.bent_by = if_it_bends(stage.settings.projector.pinhole);
    Result<Renderer> renderer = Renderer::create(stage.width(), stage.height(), needs);
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
    const Light light = light_of(stage, options, pack, level);
    return std::make_unique<PackLevelTechnique>(stage, shown, (*seen)[level], light, std::move(name),
                                                Parts{std::move(*renderer), std::move(*hit_points)});
}

Result<std::unique_ptr<Technique>> make_pack_relief(const Stage& stage, const Pack& pack,
                                                    std::shared_ptr<const BlockRelief> relief,
                                                    std::optional<SeenLevel> seen,
                                                    const PictureOptions& options, std::string name) {
    ShaderKey shader;
    shader.pass = ShaderKey::Pass::Cast;
    shader.even_light = options.lit;
    RenderNeeds needs;
    needs.draws = {shader, {ShaderKey::Pass::EdgeFeather}};
    needs.casts = 1;
    Result<Renderer> renderer = Renderer::create(stage.width(), stage.height(), needs);
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    Result<HitPointRenderer> hit_points = HitPointRenderer::create(*renderer);
    if (!hit_points) {
        return tl::unexpected<Error>(hit_points.error());
    }
    const Light light = light_of(stage, options, pack, pack.default_level); // as the exhibit
    const Drawable drawable = renderer->store().keep(relief);
    PlacedLevel shown = placed(pack, std::move(relief), place(pack, stage.prop).metres_per_box, drawable);
    shown.samples = options.samples > 0 ? options.samples : pack.samples;
    return std::make_unique<PackLevelTechnique>(stage, shown, std::move(seen), light, std::move(name),
                                                Parts{std::move(*renderer), std::move(*hit_points)});
}

} // namespace frustumscreen
