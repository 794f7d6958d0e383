#include "tests/simulators/table/simulated_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::simulators {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// Rays per side of a pixel.
constexpr int rays = 2;

struct Hit {
    glm::dvec3 place;
    double albedo;
};

/// The prop's faces with tags on them: each tag black with a white rim and an inner pattern, on white paper;
/// the table is grey.
class Scene {
public:
    Scene(const TagCorners& tags, const glm::dmat4& table_from_prop)
        : tags_(tags), prop_from_table_(glm::inverse(table_from_prop)), table_from_prop_(table_from_prop) {
        for (const glm::dvec3& corner : tags) {
            top_ = std::max(top_, corner.z);
        }
    }
    [[nodiscard]] Hit seen(const glm::dvec3& from, const glm::dvec3& along) const {
        const glm::dvec3 o(prop_from_table_ * glm::dvec4(from, 1.0));
        const glm::dvec3 d(prop_from_table_ * glm::dvec4(along, 0.0));
        for (const double level : {top_, 0.0}) {
            const glm::dvec3 at = o + d * ((level - o.z) / d.z);
            if (on_paper(at)) {
                return {glm::dvec3(table_from_prop_ * glm::dvec4(at, 1.0)), albedo(at)};
            }
        }
        return {from - along * (from.z / along.z), 0.5};
    }

private:
    /// The plate on the prop's top, or the tag sheet under it.
    [[nodiscard]] bool on_paper(const glm::dvec3& p) const {
        return std::abs(p.z - top_) < 1e-9 ? std::abs(p.x) < 0.045 && std::abs(p.y) < 0.045
                                           : std::abs(p.x) < 0.21 && std::abs(p.y) < 0.1485;
    }
    [[nodiscard]] double albedo(const glm::dvec3& p) const {
        for (std::size_t k = 0; k < tags_.size(); k += 4) {
            const glm::dvec3& low = tags_[k];
            const glm::dvec3& high = tags_[k + 2];
            if (std::abs(low.z - p.z) < 1e-6 && p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y) {
                // Eight cells per side, the outer ring black, the inner ones by a hash.
                const int i = static_cast<int>(8.0 * (p.x - low.x) / (high.x - low.x));
                const int j = static_cast<int>(8.0 * (p.y - low.y) / (high.y - low.y));
                const bool ring = i == 0 || j == 0 || i == 7 || j == 7;
                const bool white =
                    !ring && (static_cast<std::size_t>(5 * i + 3 * j + i * j) + k / 4) % 3 != 0;
                return white ? 0.85 : 0.05;
            }
        }
        return 0.85;
    }
    const TagCorners& tags_;
    glm::dmat4 prop_from_table_;
    glm::dmat4 table_from_prop_;
    double top_ = 0.0;
};

/// The result of one ray.
struct Sample {
    glm::dvec2 pixel{nothing}; ///< of the projector
    double albedo = 0.0;
};

Sample sample_of(const SimulatedTable& table, const Scene& scene, const glm::dvec3& eye,
                 const glm::dvec3& along) {
    const Hit hit = scene.seen(eye, along);
    Sample sample;
    sample.albedo = hit.albedo;
    const glm::dvec3 lens = table.truth.table_from_projector.translation;
    // In shadow if the projector sees something else there.
    const Hit lit = scene.seen(lens, hit.place - lens);
    if (glm::distance(lit.place, hit.place) < 1e-6) {
        if (const auto pixel = true_pixel(table.truth, hit.place)) {
            sample.pixel = *pixel;
        }
    }
    return sample;
}

} // namespace

glm::dvec2 SimulatedCamera::pixel(const glm::dvec3& table_point) const {
    const glm::dvec3 q(camera_from_table * glm::dvec4(table_point, 1.0));
    const glm::dvec2 ideal(q.x / q.z, q.y / q.z);
    return focal_px * ideal * (1.0 + k1 * glm::dot(ideal, ideal)) + 0.5 * glm::dvec2(width, height);
}

glm::dvec3 SimulatedCamera::ray(const glm::dvec2& pixel) const {
    const glm::dvec2 real = (pixel - 0.5 * glm::dvec2(width, height)) / focal_px;
    glm::dvec2 ideal = real;
    for (int k = 0; k < 30; ++k) {
        ideal = real / (1.0 + k1 * glm::dot(ideal, ideal));
    }
    return glm::dvec3(glm::inverse(camera_from_table) * glm::dvec4(ideal, 1.0, 0.0));
}

SimulatedCamera some_camera(const SimulatedTable& table) {
    SimulatedCamera camera;
    const glm::dvec3 eye = table.truth.table_from_projector.translation + glm::dvec3(0.12, -0.1, 0.05);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.0, 0.0, 0.05) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    glm::dmat4 table_from_camera(1.0);
    table_from_camera[0] = glm::dvec4(right, 0.0);
    table_from_camera[1] = glm::dvec4(glm::cross(forward, right), 0.0);
    table_from_camera[2] = glm::dvec4(forward, 0.0);
    table_from_camera[3] = glm::dvec4(eye, 1.0);
    camera.camera_from_table = glm::inverse(table_from_camera);
    // The projector's picture fills most of the camera's picture.
    const glm::dvec3 left = true_light(table.truth, {0.0, 0.5 * table.truth.pinhole.height}, 0.0);
    const glm::dvec3 far =
        true_light(table.truth, {1.0 * table.truth.pinhole.width, 0.5 * table.truth.pinhole.height}, 0.0);
    camera.focal_px = 0.8 * camera.width * glm::length(eye) / glm::distance(left, far);
    return camera;
}

namespace {

/// The part of the camera's picture that contains the tags, with a margin; the captures omit the rest.
struct Window {
    glm::ivec2 from;
    glm::ivec2 size;
};

Window window_around(const std::vector<glm::dvec2>& corners, const SimulatedCamera& camera) {
    constexpr double rim = 12.0;
    const glm::dvec2 size(camera.width, camera.height);
    glm::dvec2 low = size;
    glm::dvec2 high(0.0);
    for (const glm::dvec2& corner : corners) {
        low = glm::min(low, glm::clamp(glm::floor(corner) - rim, glm::dvec2(0.0), size));
        high = glm::max(high, glm::clamp(glm::ceil(corner) + rim, glm::dvec2(0.0), size));
    }
    return {glm::ivec2(low), glm::ivec2(glm::max(high - low, glm::dvec2(1.0)))};
}

/// The rays of a window, pixel by pixel, and one through each pixel's centre.
struct Cast {
    std::vector<Sample> samples;
    std::vector<glm::dvec2> true_pixels;
};

Cast cast(const SimulatedTable& table, const Scene& scene, const SimulatedCamera& camera,
          const Window& window) {
    const glm::dvec3 eye = camera.eye();
    Cast out;
    for (int k = 0; k < window.size.x * window.size.y; ++k) {
        const glm::dvec2 corner(window.from + glm::ivec2(k % window.size.x, k / window.size.x));
        for (int j = 0; j < rays * rays; ++j) {
            const glm::ivec2 cell(j % rays, j / rays);
            const glm::dvec2 off = (glm::dvec2(cell) + 0.5) / static_cast<double>(rays);
            out.samples.push_back(sample_of(table, scene, eye, camera.ray(corner + off)));
        }
        out.true_pixels.push_back(sample_of(table, scene, eye, camera.ray(corner + 0.5)).pixel);
    }
    return out;
}

std::vector<std::uint8_t> captured(const std::vector<Sample>& samples, const Window& window,
                                   const calibration::StripeSetup& stripes,
                                   const calibration::Pattern& pattern, const CaptureFaults& faults,
                                   SeededNumbers& numbers) {
    const StripeProfile profile(stripes, pattern, faults);
    std::vector<double> light(samples.size() / (rays * rays), 0.0);
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const double place = pattern.rows ? samples[k].pixel.y : samples[k].pixel.x;
        const double shone = std::isnan(place) ? 0.0 : profile.at(place);
        light[k / (rays * rays)] += samples[k].albedo * (shone + faults.ambient) / (rays * rays);
    }
    blur_picture(light, window.size.x, window.size.y, faults.camera_blur);
    std::vector<std::uint8_t> picture;
    picture.reserve(light.size());
    for (const double value : light) {
        picture.push_back(grey_of(value, faults, numbers.normal()));
    }
    return picture;
}

} // namespace

SimulatedCaptures simulated_captures(const SimulatedTable& table, const SimulatedCamera& camera,
                                     const TagCorners& tags, const glm::dmat4& table_from_prop,
                                     const calibration::StripeSetup& stripes, const CaptureFaults& faults,
                                     SeededNumbers& numbers) {
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& corner : tags) {
        corners.push_back(camera.pixel(glm::dvec3(table_from_prop * glm::dvec4(corner, 1.0))));
    }
    const Window window = window_around(corners, camera);
    Cast rays_cast = cast(table, Scene(tags, table_from_prop), camera, window);
    SimulatedCaptures captures;
    captures.width = window.size.x;
    captures.height = window.size.y;
    captures.true_pixels = std::move(rays_cast.true_pixels);
    for (const calibration::Pattern& pattern : calibration::patterns_of(stripes)) {
        captures.pictures.push_back(captured(rays_cast.samples, window, stripes, pattern, faults, numbers));
    }
    for (const glm::dvec2& corner : corners) {
        const glm::dvec2 found = corner + faults.corner_px * glm::dvec2{numbers.normal(), numbers.normal()};
        const bool inside =
            found.x > 0.0 && found.y > 0.0 && found.x < camera.width && found.y < camera.height;
        captures.corners.push_back(inside ? found - glm::dvec2(window.from) : glm::dvec2(nothing));
    }
    return captures;
}

} // namespace frustumscreen::simulators
