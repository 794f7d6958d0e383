/// A world in which a torch throws a content, held against rays and the content's own definition: from a pixel's place through the prop
/// to the surface, from there into the torch's frame, and there the content by conventions.md (x to its right, y down). Nothing of
/// app/torch is used but the data.
///
/// Frames   prop P, metres; content: torch_thrown.h.
/// Threads  values; any.
#pragma once

#include "app/image/light_mips.h"
#include "tests/render/torch_thrown.h"
#include "tests/render/torch_truth.h"
#include "tests/render/torch_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::synthetic {

struct Throw {
    std::string name;
    torch::Stage stage;
    std::vector<torch::Stage> more = {}; ///< laid over it
    torch::Blend blend = torch::Blend::Over;
    double seconds = 0.0;
    double height_per_width = 1.0;
    Way way = Way::Mesh;
    geometry::PropShape prop = geometry::make_frustum({});
    double max_off = 0.02; ///< of the light of all pixels together
    bool layer_is_painted = false;

    [[nodiscard]] std::vector<torch::Stage> stages() const {
        std::vector<torch::Stage> all{stage};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] bool has(torch::Source source) const {
        return std::ranges::count(stages(), source, &torch::Stage::source) > 0;
    }
};

/// The paint at each corner of a relief's blocks, in the order of its colours; test packs have the texture's (u, v) = (x, z) of their
/// box.
inline std::vector<glm::u8vec4> paint_of(const relief::BlockRelief& relief, const glm::dvec3& box_size) {
    std::vector<glm::u8vec4> colours(relief.colours.size(), glm::u8vec4(0, 0, 0, 255));
    for (std::size_t direction = 0; direction < relief.grids.size(); ++direction) {
        for (std::size_t block = relief.first_block[direction]; block < relief.first_block[direction + 1];
             ++block) {
            for (std::size_t k = 0; k < 256; ++k) {
                const std::size_t cell = k / 4;
                const std::size_t corner = k % 4;
                if ((relief.blocks[block].mask >> cell & 1U) == 0) {
                    continue;
                }
                const glm::dvec3 place = relief::corner_in_box(relief, relief.grids[direction], block, cell,
                                                               static_cast<unsigned>(corner));
                const glm::dvec3 light = painted_layer({place.x / box_size.x + 0.5, place.z / box_size.z});
                const std::size_t at = (cell / 8 + corner / 2) * 9 + cell % 8 + corner % 2;
                colours[81 * block + at] =
                    glm::u8vec4(std::lround(code_of_light(light.x)), std::lround(code_of_light(light.y)),
                                std::lround(code_of_light(light.z)), 255);
            }
        }
    }
    return colours;
}

/// A plate with a box and a wedge on it: few triangles.
inline std::vector<WorldObject> plate_and_boxes() {
    return {{box({1.6, 1.2, 0.1}), put({0.0, 0.0, 0.05})},
            {box({0.5, 0.4, 0.5}), put({-0.35, 0.1, 0.3}, 25.0)},
            {box({0.3, 0.5, 0.4}), put({0.4, -0.1, 0.2}, 30.0, {0.2, 1.0, 0.1})}};
}

class ThrownWorld {
public:
    explicit ThrownWorld(const Throw& thrown)
        : thrown_(thrown), table_(table_of({})), world_(thrown.prop, plate_and_boxes(), 1, {}, 256, true) {
        world_.choose(std::vector<Way>(3, thrown.way));
        for (scene::Part& part : world_.parts) {
            part.level.light = glm::vec3(base_light);
            if (thrown.has(torch::Source::Layer)) {
                add_layer(part.level);
            }
        }
        EXPECT_TRUE(world_.renderer->prepare(
            scene::with_torches(scene::with_cells(needs_with_reliefs(1, table_.projector)))));
        table_.prop = thrown.prop;
        const int height = static_cast<int>(std::lround(256 * thrown.height_per_width));
        const std::vector<image::Image8> mips = image::light_mips(picture_of_paint(256, height));
        picture_ = world_.renderer->store().upload_picture(mips).value();
    }
    void check(int poses) {
        std::mt19937 random(48);
        for (int pose = 0; pose < poses; ++pose) {
            (table_.*(thrown_.prop.faces.size() == 6 ? &TestTable::hold : &TestTable::shuffle))(random);
            count_pose(random);
        }
        std::printf("%s: %zu compared, %zu of them change; %zu at edges; %zu wrong, by up to %.1f codes; "
                    "light %.4f of "
                    "the truth's\n",
                    thrown_.name.c_str(), compared_, changed_, edges_, wrong_, worst_, drawn_ / expected_);
        EXPECT_GT(compared_, 200U * static_cast<std::size_t>(poses)) << thrown_.name;
        EXPECT_GT(changed_, compared_ / 100) << thrown_.name;
        EXPECT_LT(edges_, compared_) << thrown_.name;
        EXPECT_LE(wrong_, compared_ / 1000) << thrown_.name << " by up to " << worst_;
        EXPECT_NEAR(drawn_ / expected_, 1.0, thrown_.max_off) << thrown_.name;
    }

private:
    void add_layer(scene::PlacedLevel& level) {
        render::GpuStore& store = world_.renderer->store();
        if (level.relief) {
            store.add_layer(
                level.drawable, 0,
                std::make_shared<const std::vector<glm::u8vec4>>(paint_of(*level.relief, level.box_size)));
            return;
        }
        const image::Image8 white(4, 4, glm::u8vec4(255));
        EXPECT_TRUE(store.add_layer(
            level.drawable, 0, thrown_.layer_is_painted ? picture_of_paint(256, 256, painted_layer) : white));
    }
    void count_pose(std::mt19937& random) {
        scene::PlacedTorch torch = seeded_torch(table_, random, 4 * pose_ + 3); // no attenuation
        ++pose_;
        torch::Content content{.name = "thrown",
                               .blend = thrown_.blend,
                               .stages = thrown_.stages(),
                               .height_per_width = thrown_.height_per_width};
        torch.beam.shape = torch::Shape::Rectangle;
        torch = scene::placed(content, torch.beam, torch.table_from_torch, thrown_.seconds);
        torch.picture = picture_;
        scene::PlanView view = table_.view();
        const image::Image8 without = world_.picture(view);
        view.torches = {&torch, 1};
        const image::Image8 with = world_.picture(view);
        const TorchTruth truth(world_, torch, table_);
        const geometry::RigidTransform prop_from_torch =
            table_.table_from_prop.inverse() * torch.table_from_torch;
        const double half = std::tan(0.5 * torch.beam.opening_rad);
        const glm::dvec2 extent(half, half * thrown_.height_per_width);
        const auto seen = [&](const glm::dvec2& share) {
            const glm::dvec3 ray = prop_from_torch.direction(glm::dvec3((2.0 * share - 1.0) * extent, 1.0));
            const SeenPart met = world_.first_on(prop_from_torch.translation, ray);
            glm::dvec3 colour(0.0);
            if (met.part >= 0) {
                colour[met.part % 3] = 1.0;
            }
            return colour;
        };
        const auto layer = [&](const glm::dvec2& uv) {
            return thrown_.layer_is_painted ? painted_layer(uv) : glm::dvec3(1.0);
        };
        std::vector<Evaluated> stages;
        for (const torch::Stage& stage : thrown_.stages()) {
            stages.emplace_back(stage, thrown_.height_per_width, thrown_.seconds, seen, layer);
        }
        const EvaluatedStages evaluated(std::move(stages));
        for (int y = 0; y < with.height; ++y) {
            for (int x = 0; x < with.width; ++x) {
                count_pixel({x + 0.5, y + 0.5}, without.at(x, y), with.at(x, y), truth, prop_from_torch,
                            extent, evaluated);
            }
        }
    }
    [[nodiscard]] At at_of(const SeenPart& place, const geometry::RigidTransform& prop_from_torch,
                           const glm::dvec2& extent) const {
        const glm::dvec3 q = prop_from_torch.inverse().point(place.point);
        At at{.share = 0.5 + 0.5 * glm::dvec2(q) / (q.z * extent), .width_mm = 2000.0 * q.z * extent.x};
        if (place.part >= 0) {
            const scene::PlacedLevel& level = world_.parts[static_cast<std::size_t>(place.part)].level;
            const geometry::Box box = level.placed_box();
            const glm::dvec3 placed(glm::affineInverse(level.prop_from_placed) *
                                    glm::dvec4(place.point, 1.0));
            const glm::dvec3 unit = (placed - box.low) / (box.high - box.low);
            at.uv = {unit.x, unit.z};
        }
        return at;
    }
    void count_pixel(const glm::dvec2& pixel, const glm::u8vec4& before, const glm::u8vec4& after,
                     const TorchTruth& truth, const geometry::RigidTransform& prop_from_torch,
                     const glm::dvec2& extent, const EvaluatedStages& evaluated) {
        const glm::dvec3 eye = table_.table_from_prop.inverse().point(table_.eye_m);
        const SeenPart own = world_.seen(table_, pixel);
        if (own.part < 0 || !truth.lights(own, eye)) {
            return; // torch_test.cpp
        }
        const double reach = thrown_.way == Way::Mesh ? 1.0 : 2.0;
        constexpr int steps = 7;
        std::array<SeenPart, steps * steps> around{};
        for (int k = 0; k < steps * steps; ++k) {
            const glm::dvec2 aside = reach * (2.0 * glm::dvec2(k % steps, k / steps) / (steps - 1.0) - 1.0);
            around.at(static_cast<std::size_t>(k)) = world_.seen(table_, pixel + aside);
        }
        const auto is_other = [&](const SeenPart& each) {
            return each.part != own.part || glm::distance(each.point, own.point) > 0.01 ||
                   std::fabs(glm::dot(glm::normalize(each.normal), glm::normalize(own.normal))) < 0.9;
        };
        const bool corner = is_other(around.front()) || is_other(around.back()) ||
                            is_other(around[steps - 1]) || is_other(around[steps * (steps - 1)]);
        if (corner || !truth.lights(around.front(), eye) || !truth.lights(around.back(), eye) ||
            truth.around(own, thrown_.way == Way::Mesh ? 1.42 : 4.0, 1e-4) != TorchTruth::Around::Lit) {
            ++edges_;
            return;
        }
        const double pixel_mm = 500.0 / reach * (0.5 / std::numbers::sqrt2) *
                                (glm::distance(around.front().point, around.back().point) +
                                 glm::distance(around[steps - 1].point, around[steps * (steps - 1)].point));
        compare(around, pixel_mm, before, after, prop_from_torch, extent, evaluated);
    }
    /// First `at`, then what the drawing may take for it: lines are softened over a pixel's larger side; a lens mixes the four
    /// nearest texels of the torch's picture; how wide a pixel is across the beam, which chooses a ruler's marks, is known to within
    /// its slant.
    void find_alike(const At& at) {
        alike_.assign(1, at);
        double aside = 0.0;
        for (const torch::Stage& stage : thrown_.stages()) {
            if (stage.source != torch::Source::Picture && stage.source != torch::Source::Film) {
                aside = std::fmax(aside,
                                  0.5 * at.pixel_mm / at.width_mm + (stage.source == torch::Source::Lens
                                                                         ? 2.0 / 512.0 * stage.magnification
                                                                         : 0.0));
            }
        }
        if (aside > 0.0) {
            for (const glm::dvec2& corner :
                 {glm::dvec2(-1, -1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(1, 1)}) {
                alike_.push_back(at);
                alike_.back().share += aside * corner;
            }
        }
        for (std::size_t k = 0; thrown_.has(torch::Source::Ruler) && k < 5; ++k) {
            for (const double slant : {0.6, 1.6}) {
                alike_.push_back(alike_[k]);
                alike_.back().pixel_mm *= slant;
            }
        }
    }
    void compare(std::span<const SeenPart> around, double pixel_mm, const glm::u8vec4& before,
                 const glm::u8vec4& after, const geometry::RigidTransform& prop_from_torch,
                 const glm::dvec2& extent, const EvaluatedStages& evaluated) {
        glm::dvec3 low(255.0);
        glm::dvec3 high(0.0);
        glm::dvec3 mean(0.0);
        for (const SeenPart& place : around) {
            At at = at_of(place, prop_from_torch, extent);
            at.pixel_mm = pixel_mm;
            find_alike(at);
            for (const At& each : alike_) {
                const Thrown thrown = evaluated(each);
                for (int channel = 0; channel < 3; ++channel) {
                    const double light = light_of_code(before[channel]);
                    const double shown =
                        thrown_.blend == torch::Blend::Light
                            ? light + light * thrown.alpha * thrown.colour[channel]
                            : light + (double{base_light} * thrown.colour[channel] - light) * thrown.alpha;
                    low[channel] = std::fmin(low[channel], code_of_light(shown));
                    high[channel] = std::fmax(high[channel], code_of_light(shown));
                    mean[channel] +=
                        &each == &alike_.front() ? shown / static_cast<double>(around.size()) : 0.0;
                }
            }
        }
        constexpr double codes = 1.5; // the picture's code, and the conversions of two blended ones
        double off = 0.0;
        for (int channel = 0; channel < 3; ++channel) {
            off = std::fmax(off,
                            std::fmax(low[channel] - after[channel], after[channel] - high[channel]) - codes);
            expected_ += std::fabs(mean[channel] - light_of_code(before[channel]));
            drawn_ += std::fabs(light_of_code(after[channel]) - light_of_code(before[channel]));
        }
        ++compared_;
        changed_ += before != after ? 1U : 0U;
        wrong_ += off > 0.0 ? 1U : 0U;
        worst_ = std::fmax(worst_, off);
    }

    Throw thrown_;
    TestTable table_;
    Interlocked world_;
    scene::TextureId picture_ = scene::TextureId::None;
    std::vector<At> alike_;
    int pose_ = 0;
    std::size_t compared_ = 0, changed_ = 0, edges_ = 0, wrong_ = 0;
    double worst_ = 0.0, drawn_ = 0.0, expected_ = 0.0;
};

} // namespace frustumscreen::synthetic
