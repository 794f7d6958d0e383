#include "tests/simulators/tags/tag_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace frustumscreen::simulators {

namespace {

constexpr int side = 4; // rays through a pixel, along rows and along columns
constexpr std::size_t rays = side * side;

/// Times within the exposure, permuted so that neighbouring rays are far apart in time.
double share_of_exposure(std::size_t ray) {
    constexpr std::size_t coprime = 7;
    return (static_cast<double>(ray * coprime % rays) + 0.5) / static_cast<double>(rays);
}

} // namespace

TagScene::TagScene(geometry::PropShape prop, std::vector<tags::PropTag> tags, const SceneCamera& camera,
                   const SceneLight& light)
    : surfaces_(std::move(prop), std::move(tags), light), camera_(camera) {
    const geometry::Pinhole& pinhole = camera_.pinhole;
    const geometry::RigidTransform& eye = camera_.table_from_camera;
    for (int row = 0; row <= pinhole.height; ++row) {
        for (int column = 0; column <= pinhole.width; ++column) {
            rays_.push_back(eye.direction(pinhole.ray({column, row})));
            if (row < pinhole.height && column < pinhole.width) {
                table_.push_back(surfaces_.table_brightness(eye.translation, rays_.back()));
            }
        }
    }
}

std::size_t TagScene::pixel_at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.pinhole.width) +
           static_cast<std::size_t>(column);
}

double TagScene::moment_s(const PropMotion& motion) const {
    const geometry::RigidTransform camera_from_table = camera_.table_from_camera.inverse();
    const auto middle = camera_.pinhole.pixel(camera_from_table.point(motion(0.0).translation));
    const double row = middle ? middle->y / camera_.pinhole.height : 0.5;
    return 1e-3 * (row * camera_.rolling_ms + 0.5 * camera_.exposure_ms);
}

std::vector<double> TagScene::light_seen(const PropMotion& motion) const {
    const geometry::Pinhole& pinhole = camera_.pinhole;
    const geometry::RigidTransform& eye = camera_.table_from_camera;
    const auto row_of_rays = static_cast<std::size_t>(pinhole.width) + 1;
    const glm::dvec3 middle = eye.inverse().point(motion(moment_s(motion)).translation);
    const double reach = 1.15 * pinhole.fx * surfaces_.radius_m() / std::fmax(middle.z, 1e-3);
    const glm::dvec2 at = pinhole.pixel(middle).value_or(glm::dvec2(-1e6));
    const auto ends = [&](double centre, int size) {
        return std::pair(static_cast<int>(std::clamp(centre - reach, 0.0, static_cast<double>(size))),
                         static_cast<int>(std::clamp(centre + reach, 0.0, static_cast<double>(size))));
    };
    const auto [left, right] = ends(at.x, pinhole.width);
    const auto [top, bottom] = ends(at.y, pinhole.height);
    std::vector<double> light = table_;
    for (int row = top; row < bottom; ++row) {
        std::array<geometry::RigidTransform, rays> table_from_prop;
        std::array<geometry::RigidTransform, rays> prop_from_table;
        for (std::size_t k = 0; k < rays; ++k) {
            const double share = static_cast<double>(row) / pinhole.height;
            table_from_prop[k] =
                motion(1e-3 * (share * camera_.rolling_ms + share_of_exposure(k) * camera_.exposure_ms));
            prop_from_table[k] = table_from_prop[k].inverse();
        }
        for (int column = left; column < right; ++column) {
            const glm::dvec3* above =
                &rays_[static_cast<std::size_t>(row) * row_of_rays + static_cast<std::size_t>(column)];
            const glm::dvec3* below = above + row_of_rays;
            double sum = 0.0;
            for (std::size_t k = 0; k < rays; ++k) {
                const double x = (static_cast<double>(k % side) + 0.5) / side;
                const double y = (static_cast<double>(k / side) + 0.5) / side;
                const glm::dvec3 ray =
                    glm::mix(glm::mix(above[0], above[1], x), glm::mix(below[0], below[1], x), y);
                sum += surfaces_.brightness(eye.translation, ray, prop_from_table[k], table_from_prop[k]);
            }
            light[pixel_at(row, column)] = sum / static_cast<double>(rays);
        }
    }
    return light;
}

void TagScene::defocus(std::vector<double>& light) const {
    if (camera_.defocus_px <= 0.0) {
        return;
    }
    const int reach = static_cast<int>(std::ceil(3.0 * camera_.defocus_px));
    std::vector<double> weights;
    double total = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        weights.push_back(std::exp(-0.5 * k * k / (camera_.defocus_px * camera_.defocus_px)));
        total += weights.back();
    }
    const int width = camera_.pinhole.width;
    const int height = camera_.pinhole.height;
    std::vector<double> blurred(light.size());
    for (const bool along_rows : {true, false}) {
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                double sum = 0.0;
                for (int k = -reach; k <= reach; ++k) {
                    const int x = std::clamp(column + (along_rows ? k : 0), 0, width - 1);
                    const int y = std::clamp(row + (along_rows ? 0 : k), 0, height - 1);
                    sum += weights[static_cast<std::size_t>(k + reach)] * light[pixel_at(y, x)];
                }
                blurred[pixel_at(row, column)] = sum / total;
            }
        }
        light.swap(blurred);
    }
}

std::vector<std::uint8_t> TagScene::picture(const PropMotion& motion, std::uint64_t seed) const {
    std::vector<double> light = light_seen(motion);
    defocus(light);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::uint8_t> codes;
    codes.reserve(light.size());
    for (const double seen : light) {
        const double linear = 255.0 * std::clamp(seen, 0.0, 1.0);
        const double sd = std::sqrt(camera_.read_noise * camera_.read_noise + camera_.shot_noise * linear);
        const double noisy = std::clamp((linear + sd * normal(random)) / 255.0, 0.0, 1.0);
        codes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::pow(noisy, 1.0 / camera_.gamma))));
    }
    return codes;
}

} // namespace frustumscreen::simulators
