#include "app/bench/ldi/plan_windows.h"

#include "app/bench/measures/timing.h"
#include "app/bench/techniques/level_of_detail.h"
#include "app/ldi/patch_maker.h"
#include "assets_baked/bake/block_relief.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

namespace {

class Planned final : public WindowTechnique {
public:
    Planned(WindowSet& set, std::string name, scene::PlacedLevel level, std::uint64_t bytes, double make_ms)
        : set_(set), name_(std::move(name)), part_{std::move(level), std::nullopt}, bytes_(bytes),
          make_ms_(make_ms), plan_(scene::make_plan(set.screen().surface, part_.level)) {}
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const glm::dvec3& eye_m) override { set_.draw({&part_, 1}, eye_m, plan_); }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        draw(eye_m);
        return set_.hit_points(plan_);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    WindowSet& set_;
    std::string name_;
    scene::Part part_;
    std::uint64_t bytes_;
    double make_ms_;
    scene::FramePlan plan_;
};

/// The coarsest level that errs by at most `error_m`; each level has half the triangles of the one before. nullopt: only the
/// source errs by so little.
std::optional<LevelOfDetail> coarsest_within(const bake::SourceMesh& mesh, double error_m) {
    constexpr std::size_t fewest = 1000;
    std::vector<std::size_t> targets;
    for (std::size_t target = mesh.triangles.size() / 2; target >= fewest; target /= 2) {
        targets.push_back(target);
    }
    for (LevelOfDetail& level : levels_of_detail(mesh, targets)) {
        if (level.error <= error_m) {
            return std::move(level);
        }
    }
    return std::nullopt;
}

/// One plan and one part for each patch of the hemisphere.
class PatchReliefs final : public WindowTechnique {
public:
    PatchReliefs(WindowSet& set, int pixels_per_texel)
        : set_(set),
          name_(pixels_per_texel == 1 ? "patch_relief" : fmt::format("patch_relief_{}px", pixels_per_texel)) {
        const double begun_ms = cpu_now_ms();
        ldi::PatchMaker maker(
            set.scene().world, ldi::Hemisphere(frozen_from_m),
            {.half_extent_m = glm::dvec2(0.5 * window_side_m), .texel_m = pixels_per_texel * set.pixel_m()});
        while (maker.step()) {
        }
        hemisphere_ = maker.hemisphere();
        for (std::size_t number = 0; number < ldi::patch_count; ++number) {
            const std::shared_ptr<const ldi::PatchRelief> patch = maker.patch(number);
            const std::shared_ptr<const relief::BlockRelief> relief(patch, &patch->relief);
            bytes_ += relief::bytes_of(*relief);
            Patch& made = patches_.emplace_back();
            made.part.level = {.triangles = nullptr,
                               .box_size = patch->box_size,
                               .metres_per_box = 1.0,
                               .drawable = set.renderer().store().keep(relief),
                               .samples = 1,
                               .relief = relief,
                               .prop_from_placed = patch->window_from_box};
            made.plan = scene::make_plan(set.screen().surface, made.part.level);
        }
        make_ms_ = cpu_now_ms() - begun_ms;
    }
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const glm::dvec3& eye_m) override {
        Patch& patch = patch_for(eye_m);
        set_.draw({&patch.part, 1}, eye_m, patch.plan);
    }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        draw(eye_m);
        return set_.hit_points(patch_for(eye_m).plan);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    struct Patch {
        scene::Part part;
        scene::FramePlan plan;
    };
    Patch& patch_for(const glm::dvec3& eye_m) { return patches_[nearest_patch(hemisphere_, eye_m)]; }

    WindowSet& set_;
    std::string name_;
    ldi::Hemisphere hemisphere_{frozen_from_m};
    std::vector<Patch> patches_;
    std::uint64_t bytes_ = 0;
    double make_ms_ = 0.0;
};

} // namespace

std::unique_ptr<WindowTechnique> make_window_geometry(WindowSet& set) {
    return std::make_unique<Planned>(set, "geometry", set.geometry(), 0, 0.0);
}

Result<std::unique_ptr<WindowTechnique>> make_window_lod(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const std::optional<LevelOfDetail> level = coarsest_within(*set.scene().mesh, 0.5 * set.pixel_m());
    if (!level) {
        return std::make_unique<Planned>(set, "geometry_lod", set.geometry(), 0, cpu_now_ms() - begun_ms);
    }
    TRY(const WindowSet::Uploaded uploaded, set.upload(set.renderer(), level->mesh));
    return std::make_unique<Planned>(set, "geometry_lod", uploaded.placed, uploaded.bytes,
                                     cpu_now_ms() - begun_ms);
}

std::unique_ptr<WindowTechnique> make_window_relief(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const WindowScene& of = set.scene();
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& position : of.mesh->positions) {
        points.push_back(position / of.size_m);
    }
    const bake::SourceScene surface(*of.mesh, points, bake::Sides::Front);
    using Direction = pack::ReliefDirection;
    const auto relief = std::make_shared<const relief::BlockRelief>(
        bake::bake_blocks({.surface = surface,
                           .box_size = of.box_size,
                           .directions = {Direction::PlusX, Direction::MinusX, Direction::PlusY,
                                          Direction::MinusY, Direction::PlusZ},
                           .texels = static_cast<int>(std::round(of.size_m / set.pixel_m()))}));
    const scene::PlacedLevel placed{.triangles = nullptr,
                                    .box_size = of.box_size,
                                    .metres_per_box = of.size_m,
                                    .drawable = set.renderer().store().keep(relief),
                                    .samples = 1,
                                    .relief = relief,
                                    .prop_from_placed = of.window_from_site};
    return std::make_unique<Planned>(set, "relief_pack", placed, bytes_of(*relief), cpu_now_ms() - begun_ms);
}

std::unique_ptr<WindowTechnique> make_window_patches(WindowSet& set, int pixels_per_texel) {
    return std::make_unique<PatchReliefs>(set, pixels_per_texel);
}

} // namespace frustumscreen::bench
