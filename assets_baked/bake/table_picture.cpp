#include "assets_baked/bake/table_picture.h"

#include "assets_baked/bake/level.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr double azimuth_deg = 35.0; ///< from the front to one side
constexpr double elevation_deg = 22.0;
constexpr float eye_distance_box = 5.0F; ///< half a metre from an artifact of 0.1 m
constexpr int samples_a_side = 4;        ///< a texel

/// A pinhole that frames some points as closely as possible.
class Camera {
public:
    Camera(double azimuth_rad, const glm::vec3& centre, const TriangleMesh& surface) {
        const double elevation_rad = elevation_deg * std::numbers::pi / 180.0;
        const glm::dvec3 away(std::sin(azimuth_rad) * std::cos(elevation_rad),
                              -std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad));
        eye_ = centre + glm::vec3(away) * eye_distance_box;
        forward_ = glm::normalize(centre - eye_);
        right_ = glm::normalize(glm::cross(forward_, glm::vec3(0, 0, 1)));
        up_ = glm::cross(right_, forward_);
        for (const std::uint32_t index : surface.indices) {
            const glm::vec3 at = surface.positions[index] - eye_;
            const glm::vec2 seen =
                glm::vec2(glm::dot(at, right_), glm::dot(at, up_)) / glm::dot(at, forward_);
            low_ = glm::min(low_, seen);
            high_ = glm::max(high_, seen);
        }
    }

    [[nodiscard]] const glm::vec3& eye() const { return eye_; }
    [[nodiscard]] glm::vec2 extent() const { return glm::max(high_ - low_, glm::vec2(1e-6F)); }
    /// Ray through a position in the framed rectangle, from (0, 0) at the top left to `extent()`.
    [[nodiscard]] glm::vec3 direction(const glm::vec2& place) const {
        return glm::normalize(forward_ + right_ * (low_.x + place.x) + up_ * (high_.y - place.y));
    }

private:
    glm::vec3 eye_{0.0F}, forward_{0.0F}, right_{0.0F}, up_{0.0F};
    glm::vec2 low_{1e30F}, high_{-1e30F};
};

/// The samples of one texel, in linear light.
struct Gathered {
    glm::vec3 colour{0.0F}; ///< mean of the hits
    float covered = 0.0F;   ///< 0..1
};

Gathered gather(const SourceScene& scene, const Camera& camera, const glm::vec2& corner, float texel) {
    Gathered sum;
    for (int k = 0; k < samples_a_side * samples_a_side; ++k) {
        const glm::ivec2 cell(k % samples_a_side, k / samples_a_side);
        const glm::vec2 within = glm::vec2(cell) + 0.5F;
        const glm::vec2 place = corner + within * (texel / static_cast<float>(samples_a_side));
        const SurfaceHit hit = scene.trace(camera.eye(), camera.direction(place));
        if (hit.hit) {
            sum.colour += glm::vec3(scene.colour(hit));
            sum.covered += 1.0F;
        }
    }
    if (sum.covered > 0.0F) {
        sum.colour /= sum.covered;
    }
    sum.covered /= samples_a_side * samples_a_side;
    return sum;
}

/// `longer_px` includes the empty texel on either side.
image::Image<Gathered> draw(const SourceScene& scene, const Camera& camera, int longer_px) {
    const glm::vec2 extent = camera.extent();
    const float texel = std::max(extent.x, extent.y) / static_cast<float>(longer_px - 2);
    const auto texels = [&](float along) {
        return std::clamp(static_cast<int>(std::ceil(along / texel - 1e-3F)), 1, longer_px - 2) + 2;
    };
    image::Image<Gathered> picture(texels(extent.x), texels(extent.y));
    parallel_for(static_cast<std::size_t>(picture.height), 8, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const glm::vec2 corner = glm::vec2(x - 1, y - 1) * texel;
                picture.at(x, y) = gather(scene, camera, corner, texel);
            }
        }
    });
    return picture;
}

double covered_area(const image::Image<Gathered>& picture, const Camera& camera) {
    double sum = 0.0;
    for (const Gathered& texel : picture.texels) {
        sum += static_cast<double>(texel.covered);
    }
    const auto longer = static_cast<double>(std::max(picture.width, picture.height) - 2);
    const glm::vec2 extent = camera.extent();
    const double texel = static_cast<double>(std::max(extent.x, extent.y)) / longer;
    return sum * texel * texel;
}

/// From the side that shows more of the artifact; from the right if both show equally much.
Camera best_camera(const SourceScene& scene, const glm::vec3& centre, const TriangleMesh& surface) {
    constexpr int rough_px = 50;
    constexpr double clearly = 1.02;
    const double azimuth_rad = azimuth_deg * std::numbers::pi / 180.0;
    Camera right(azimuth_rad, centre, surface);
    Camera left(-azimuth_rad, centre, surface);
    const double from_right = covered_area(draw(scene, right, rough_px), right);
    const double from_left = covered_area(draw(scene, left, rough_px), left);
    return from_left > clearly * from_right ? left : right;
}

/// Scales the colours so that the brightest places have the light that the exhibit gives them.
void expose(image::Image<Gathered>& picture) {
    constexpr double share_below = 0.98;
    constexpr float highlight = 0.8308F; // linear light of the sRGB code 235
    constexpr float max_exposure = 8.0F;
    std::vector<float> brightest;
    for (const Gathered& texel : picture.texels) {
        if (texel.covered > 0.5F) {
            brightest.push_back(std::max({texel.colour.r, texel.colour.g, texel.colour.b}));
        }
    }
    if (brightest.empty()) {
        return;
    }
    const auto place = brightest.begin() +
                       static_cast<std::ptrdiff_t>(share_below * static_cast<double>(brightest.size() - 1));
    std::nth_element(brightest.begin(), place, brightest.end());
    const float exposure = std::min(max_exposure, highlight / std::max(*place, 1e-6F));
    for (Gathered& texel : picture.texels) {
        texel.colour *= exposure;
    }
}

/// Gives empty texels next to the outline the mean of their neighbours' colours, several rows deep; those
/// beyond get the mean of the whole artifact, which compresses well.
void continue_colours(image::Image<Gathered>& picture) {
    constexpr int rows = 8; // three mip levels
    image::Image<std::uint8_t> known(picture.width, picture.height);
    glm::vec3 sum(0.0F);
    float count = 0.0F;
    for (std::size_t k = 0; k < picture.texels.size(); ++k) {
        known.texels[k] = picture.texels[k].covered > 0.0F ? 1 : 0;
        sum += picture.texels[k].colour * picture.texels[k].covered;
        count += picture.texels[k].covered;
    }
    const glm::vec3 mean = count > 0.0F ? sum / count : glm::vec3(0.0F);
    for (int row = 0; row < rows; ++row) {
        const image::Image<std::uint8_t> before = known;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (before.at(x, y) != 0) {
                    continue;
                }
                glm::vec3 around(0.0F);
                float neighbours = 0.0F;
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture.height - 1); ++j) {
                    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, picture.width - 1); ++i) {
                        around += before.at(i, j) != 0 ? picture.at(i, j).colour : glm::vec3(0.0F);
                        neighbours += before.at(i, j) != 0 ? 1.0F : 0.0F;
                    }
                }
                if (neighbours > 0.0F) {
                    picture.at(x, y).colour = around / neighbours;
                    known.at(x, y) = 1;
                }
            }
        }
    }
    for (std::size_t k = 0; k < picture.texels.size(); ++k) {
        if (known.texels[k] == 0) {
            picture.texels[k].colour = mean;
        }
    }
}

image::Image8 as_codes(const image::Image<Gathered>& picture) {
    image::Image8 codes(picture.width, picture.height);
    for (std::size_t k = 0; k < codes.texels.size(); ++k) {
        const Gathered& from = picture.texels[k];
        codes.texels[k] = {image::srgb8_from_linear(static_cast<double>(from.colour.r)),
                           image::srgb8_from_linear(static_cast<double>(from.colour.g)),
                           image::srgb8_from_linear(static_cast<double>(from.colour.b)),
                           static_cast<std::uint8_t>(std::lround(from.covered * 255.0F))};
    }
    return codes;
}

} // namespace

image::Image8 make_table_picture(const pack::Pack& pack) {
    const pack::PackLevel& level = pack.levels[pack.default_level];
    const TriangleMesh surface = surface_of(level, pack.box_size);
    if (surface.indices.empty()) {
        return {};
    }
    const SourceMesh textured = textured_source(level, pack.textures[level.texture], pack.box_size);
    const SourceScene scene(textured, textured.positions, Sides::Front);
    const glm::vec3 centre(0.0F, 0.0F, static_cast<float>(pack.box_size.z) / 2.0F);
    image::Image<Gathered> picture = draw(scene, best_camera(scene, centre, surface), table_picture_px);
    expose(picture);
    continue_colours(picture);
    return as_codes(picture);
}

} // namespace frustumscreen::bake
