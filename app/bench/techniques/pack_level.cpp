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
struct Lights {
    Light shown, timed;
};

/// `level`: of the pack, whose brightest places say how bright the artifact is shown.
Lights lights_of(const Stage& stage, const PictureOptions& options, const Pack& pack, std::size_t level) {
    if (!options.lit && !options.timed_lit) {
        return {};
    }
    const PackLevel& shown = pack.levels[level];
    const Light light{
        light_compensation(stage.settings),
        exposure_of(shown, pack.box_size, pack.textures[shown.texture], stage.settings.render.highlight_code),
        options.feathered};
    return {options.lit ? light : Light{}, light};
}

int samples_of(const PictureOptions& options, const Pack& pack) {
    return options.samples > 0 ? options.samples : pack.samples;
}

/// Of what the GPU draws, in any light that is asked for.
RenderNeeds needs_of(const Stage& stage, const PictureOptions& options, int samples, ShaderKey shader) {
    RenderNeeds needs{std::max(samples, default_samples), {{ShaderKey::Pass::EdgeFeather}}};
    for (const bool lit : {options.lit, options.lit || options.timed_lit}) {
        shader.even_light = lit;
        needs.draws.insert(shader);
    }
    needs.bent_by = if_it_bends(stage.settings.projector.pinhole);
    return needs;
}

class PackLevelTechnique final : public Technique {
public:
    PackLevelTechnique(const Stage& stage, const PlacedLevel& placed_level, std::optional<SeenLevel> seen,
                       const Lights& lights, std::string name, Parts parts)
        : stage_(stage), placed_(placed_level), seen_(std::move(seen)), lights_(lights),
          name_(std::move(name)), parts_(std::move(parts)), plan_(make_plan(stage.prop, placed_)) {}

    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override { draw(pose, lights_.shown); }
    void draw_timed(const BenchPose& pose) override { draw(pose, lights_.timed); }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        plan(pose, lights_.shown);
        return parts_.hit_points.draw(plan_, parts_.renderer.store());
    }

    [[nodiscard]] std::optional<ErrorEstimate> estimate(const BenchPose& pose) override {
        if (!seen_) {
            return std::nullopt;
        }
        plan(pose, lights_.shown);
        return estimate_error(*seen_, stage_.prop, placed_, view_of(pose, lights_.shown), plan_);
    }

private:
    [[nodiscard]] PlanView view_of(const BenchPose& pose, const Light& light) const {
        const ProjectorSettings& projector = stage_.settings.projector;
        return {projector.pinhole,    projector.table_from_projector,
                pose.table_from_prop, {&pose.eye_m, 1},
                light.compensation,   light.exposure};
    }
    void plan(const BenchPose& pose, const Light& light) {
        plan_frame(stage_.prop, placed_, view_of(pose, light), plan_);
        if (!light.feathered) {
            plan_.feathers.clear();
        }
    }
    void draw(const BenchPose& pose, const Light& light) {
        plan(pose, light);
        parts_.renderer.draw(plan_, {stage_.framebuffer, 0}, Redraw::Everything);
    }

    const Stage& stage_;
    PlacedLevel placed_;
    std::optional<SeenLevel> seen_;
    Lights lights_;
    std::string name_;
    Parts parts_;
    FramePlan plan_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_pack_level(const Stage& stage, const Pack& pack, std::uint32_t level,
                                                   const PictureOptions& options, std::string name) {
    const Result<SeenByEyes> seen = seen_by_eyes(outline_of(pack));
    if (!seen) {
        return tl::unexpected<Error>(seen.error());
    }
    const SceneLevel whole = whole_level(pack, level);
    ShaderKey shader;
    shader.cut_out = whole.cut_out;
    Result<Renderer> renderer = Renderer::create(stage.width(), stage.height(),
                                                 needs_of(stage, options, samples_of(options, pack), shader));
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
    shown.samples = samples_of(options, pack);
    return std::make_unique<PackLevelTechnique>(stage, shown, seen->levels[level],
                                                lights_of(stage, options, pack, level), std::move(name),
                                                Parts{std::move(*renderer), std::move(*hit_points)});
}

Result<std::unique_ptr<Technique>> make_pack_relief(const Stage& stage, const Pack& pack,
                                                    std::shared_ptr<const BlockRelief> relief,
                                                    std::optional<SeenLevel> seen,
                                                    const PictureOptions& options, std::string name,
                                                    bool on_gpu) {
    RenderNeeds needs;
    if (on_gpu) {
        ShaderKey shader;
        shader.blocks = true;
        needs = needs_of(stage, options, samples_of(options, pack), shader);
    } else {
        needs.draws = {cast_shader(false)};
        needs.casts = 1;
    }
    Result<Renderer> renderer = Renderer::create(stage.width(), stage.height(), needs);
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    Result<HitPointRenderer> hit_points = HitPointRenderer::create(*renderer);
    if (!hit_points) {
        return tl::unexpected<Error>(hit_points.error());
    }
    const Lights lights = lights_of(stage, options, pack, pack.default_level); // as the exhibit
    const Result<Drawable> drawable =
        on_gpu ? renderer->store().upload(relief) : renderer->store().keep(relief);
    if (!drawable) {
        return tl::unexpected<Error>(drawable.error());
    }
    PlacedLevel shown = placed(pack, std::move(relief), place(pack, stage.prop).metres_per_box, *drawable);
    shown.samples = samples_of(options, pack);
    shown.on_gpu = on_gpu;
    return std::make_unique<PackLevelTechnique>(stage, shown, std::move(seen), lights, std::move(name),
                                                Parts{std::move(*renderer), std::move(*hit_points)});
}

} // namespace frustumscreen
