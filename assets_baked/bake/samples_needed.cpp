#include "assets_baked/bake/level.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr std::array<glm::ivec2, 4> grids{glm::ivec2(1, 1), glm::ivec2(1, 2), glm::ivec2(2, 2),
                                          glm::ivec2(2, 4)};
constexpr glm::ivec2 reference_grid{4, 4};

/// A picture of the source from far away, with the projector's pixel shape on the prop: steep faces stretch
/// the pixels vertically.
struct FarView {
    glm::vec3 towards, right, up, centre;
    glm::vec2 pixel_box;

    [[nodiscard]] glm::vec3 colour(const SourceScene& source, const glm::vec2& at, bool& hit) const {
        constexpr float far = 8.0F;
        const glm::vec3 origin =
            centre + right * (at.x * pixel_box.x) + up * (at.y * pixel_box.y) + towards * far;
        const SurfaceHit found = source.trace(origin, -towards);
        hit = found.hit;
        return found.hit ? glm::clamp(glm::vec3(source.colour(found)), glm::vec3(0.0F), glm::vec3(1.0F))
                         : glm::vec3(0.0F);
    }
    [[nodiscard]] glm::vec3 average(const SourceScene& source, const glm::ivec2& pixel,
                                    const glm::ivec2& grid) const {
        glm::vec3 sum(0.0F);
        bool hit = false;
        for (int y = 0; y < grid.y; ++y) {
            for (int x = 0; x < grid.x; ++x) {
                const glm::vec2 within = (glm::vec2(x, y) + 0.5F) / glm::vec2(grid);
                sum += colour(source, glm::vec2(pixel) + within, hit);
            }
        }
        return sum / static_cast<float>(grid.x * grid.y);
    }
};

double squared_codes(const glm::vec3& a, const glm::vec3& b) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double difference =
            static_cast<double>(image::srgb8_from_linear(a[k])) - image::srgb8_from_linear(b[k]);
        sum += difference * difference;
    }
    return sum / 3.0;
}

/// RMSE of each grid over the pixels whose centre hits; only every `every`th row is used.
std::array<double, grids.size()> errors_of(const FarView& view, const SourceScene& source,
                                           const glm::ivec2& half, int every, double& pixels) {
    using Sums = std::array<double, grids.size() + 1>;
    std::vector<Sums> rows(static_cast<std::size_t>(2 * half.y / every), Sums{});
    parallel_for(rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            for (int x = -half.x; x < half.x; ++x) {
                const glm::ivec2 pixel(x, static_cast<int>(row) * every - half.y);
                bool hit = false;
                static_cast<void>(view.colour(source, glm::vec2(pixel) + 0.5F, hit));
                if (!hit) {
                    continue;
                }
                const glm::vec3 truth = view.average(source, pixel, reference_grid);
                for (std::size_t g = 0; g < grids.size(); ++g) {
                    rows[row][g] += squared_codes(view.average(source, pixel, grids[g]), truth);
                }
                rows[row].back() += 1.0;
            }
        }
    });
    Sums total{};
    for (const Sums& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            total[k] += row[k];
        }
    }
    pixels = std::max(pixels, total.back() * every);
    std::array<double, grids.size()> result{};
    for (std::size_t g = 0; g < grids.size(); ++g) {
        result[g] = total.back() > 0.0 ? std::sqrt(total[g] / total.back()) : 0.0;
    }
    return result;
}

} // namespace

int samples_needed(const SourceScene& source, const glm::dvec3& box_size, double mm_per_box,
                   const ViewingZone& zone, double share) {
    constexpr double good_rmse = 8.0;
    constexpr double max_samples =
        45e3; // for the artifact's pixels on a usual table: the number that a slow GPU shades in time
    constexpr int views = 4;
    const double lowest_deg = zone.lowest_elevation_deg + 17.0;
    constexpr double highest_deg = 65.0;
    constexpr double golden_angle = 2.399963229728653;
    const glm::vec2 pixel_box = glm::vec2(0.63F, 1.6F) / static_cast<float>(mm_per_box);
    const auto radius = static_cast<float>(glm::length(box_size) / 2.0);
    const glm::ivec2 half(glm::ceil(radius / pixel_box));
    const auto every = static_cast<int>(1.0 / share);
    std::array<double, grids.size()> worst{};
    double pixels = 0.0;
    for (int k = 0; k < views; ++k) {
        const double elevation =
            (lowest_deg + (highest_deg - lowest_deg) * k / (views - 1)) * std::numbers::pi / 180.0;
        const glm::vec3 towards(glm::dvec3(std::cos(elevation) * std::cos(k * golden_angle + 1.0),
                                           std::cos(elevation) * std::sin(k * golden_angle + 1.0),
                                           std::sin(elevation)));
        const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 0, 1), towards));
        const FarView view{.towards = towards,
                           .right = right,
                           .up = glm::cross(towards, right),
                           .centre = glm::vec3(0.0F, 0.0F, static_cast<float>(box_size.z) / 2.0F),
                           .pixel_box = pixel_box};
        const auto errors = errors_of(view, source, half, every, pixels);
        for (std::size_t g = 0; g < grids.size(); ++g) {
            worst[g] = std::max(worst[g], errors[g]);
        }
    }
    std::size_t chosen = 1; // with one sample, outlines show steps and shimmer
    while (chosen + 1 < grids.size() && worst[chosen] > good_rmse &&
           pixels * grids[chosen + 1].x * grids[chosen + 1].y <= max_samples) {
        ++chosen;
    }
    return grids[chosen].x * grids[chosen].y;
}

} // namespace frustumscreen::bake
