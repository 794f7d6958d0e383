/// Centre of a white artifact's light in a picture; and a plan without culling.
#pragma once

#include "app/image/image.h"
#include "tests/render/reference_cast.h"

namespace frustumscreen::synthetic {

struct Mass {
    double light = 0.0;
    glm::dvec2 moment{0.0};
    void add(const glm::dvec2& at, double weight) {
        light += weight;
        moment += weight * at;
    }
    [[nodiscard]] glm::dvec2 centre() const { return moment / light; }
};

/// 16 rays per pixel, 4 x 4; each hit is weighted by `weight` of its position.
template <typename Weight> Mass cast_mass(const ReferenceCast& cast, const TestTable& table, Weight weight) {
    Mass mass;
    for (int y = 0; y < table.projector.height; ++y) {
        for (int x = 0; x < table.projector.width; ++x) {
            for (int k = 0; k < 16; ++k) {
                const glm::dvec2 at = glm::dvec2(x, y) + (glm::dvec2(k & 3, k >> 2) + 0.5) / 4.0;
                mass.add(at, cast.through_pixel(table, at).found ? weight(at) / 16.0 : 0.0);
            }
        }
    }
    return mass;
}

inline Mass cast_mass(const ReferenceCast& cast, const TestTable& table) {
    return cast_mass(cast, table, [](const glm::dvec2&) { return 1.0; });
}

inline Mass shown_mass(const image::Image8& picture) {
    Mass mass;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            mass.add({x + 0.5, y + 0.5}, image::linear_from_srgb(picture.at(x, y).g / 255.0));
        }
    }
    return mass;
}

/// Makes every face draw the whole level, over the whole picture.
inline void draw_everything(scene::FramePlan& plan, const std::vector<std::uint32_t>& all) {
    const PixelRectangle picture{0, 0, plan.projector.width, plan.projector.height};
    plan.indices = all;
    plan.lit.begin(picture.width, picture.height);
    plan.lit.light(picture);
    plan.lit.finish();
    for (scene::FacePlan& face : plan.faces) {
        face.bounds = picture;
    }
    for (scene::Draw& draw : plan.draws) {
        draw.range = {0, static_cast<std::uint32_t>(all.size())};
        draw.bounds = picture;
    }
}

} // namespace frustumscreen::synthetic
