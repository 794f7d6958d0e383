/// The light of a content, by its definition: conventions.md (Torch) and docs/curators.md, not app/torch's code.
///
/// Frames   content: (0, 0) top left, (1, 1) bottom right, as the torch is held: x to its right, y down.
/// Units    linear light.
/// Threads  values; any.
#pragma once

#include "app/image/image.h"
#include "app/torch/content.h"
#include "tests/render/torch_truth.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace frustumscreen::synthetic {

/// A content's light at one place: straight alpha, linear.
struct Thrown {
    double alpha = 0.0;
    glm::dvec3 colour{1.0};
};

/// A place in the coordinates of a torch's content.
struct At {
    glm::dvec2 share{0.0}; ///< (0, 0) top left, (1, 1) bottom right
    double width_mm = 0.0; ///< of the whole content at that depth
    double pixel_mm = 0.0; ///< the projector's pixel, across the beam
    glm::dvec2 uv{0.0};    ///< of the surface's texture
};

/// Smooth, and different in each corner.
inline glm::dvec3 painted(const glm::dvec2& share) {
    return {0.1 + 0.8 * share.x, 0.1 + 0.8 * share.y,
            0.5 + 0.4 * std::cos(2.0 * std::numbers::pi * share.x) *
                      std::cos(2.0 * std::numbers::pi * share.y)};
}
/// As above, and even across the borders, where a smaller copy of a texture has the mean of its last texels.
inline glm::dvec3 painted_layer(const glm::dvec2& uv) {
    const glm::dvec2 wave(std::cos(std::numbers::pi * uv.x), std::cos(std::numbers::pi * uv.y));
    return {0.5 - 0.4 * wave.x, 0.5 - 0.4 * wave.y, 0.5 + 0.3 * wave.x * wave.y};
}
inline image::Image8 picture_of_paint(int width, int height,
                                      glm::dvec3 (*paint)(const glm::dvec2&) = painted) {
    image::Image8 picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 light = paint({(x + 0.5) / width, (y + 0.5) / height});
            picture.at(x, y) =
                glm::u8vec4(std::lround(code_of_light(light.x)), std::lround(code_of_light(light.y)),
                            std::lround(code_of_light(light.z)), 255);
        }
    }
    return picture;
}

class Evaluated {
public:
    /// `seen`: the light of the surface that the torch sees at a share of its picture.
    /// `layer`: the light of the layer at a place of its texture.
    Evaluated(const torch::Stage& stage, double height_per_width, double seconds,
              std::function<glm::dvec3(const glm::dvec2&)> seen,
              std::function<glm::dvec3(const glm::dvec2&)> layer)
        : stage_(stage), height_(height_per_width), seconds_(seconds), seen_(std::move(seen)),
          layer_(std::move(layer)) {}
    [[nodiscard]] torch::Mix mix() const { return stage_.mix; }

    [[nodiscard]] Thrown operator()(const At& at) const {
        const glm::dvec2 own = own_place(at.share);
        const glm::dvec2 from_middle = (own - 0.5) * glm::dvec2(1.0, height_);
        Thrown thrown{1.0, glm::dvec3(stage_.colour)};
        const double min_line = at.pixel_mm / at.width_mm;
        const auto is_on = [&](double away, double line) { return away <= 0.5 * std::fmax(line, min_line); };
        switch (stage_.source) {
        case torch::Source::Picture:
        case torch::Source::Film:
            thrown.colour *= painted(own - glm::floor(own));
            break;
        case torch::Source::Ring:
            thrown.alpha =
                is_on(std::fabs(glm::length(from_middle) - 0.5 * stage_.size), stage_.width) ? 1.0 : 0.0;
            break;
        case torch::Source::Grid:
            thrown.alpha = is_on(from_line(from_middle.x, stage_.size), stage_.width) ||
                                   is_on(from_line(from_middle.y, stage_.size), stage_.width)
                               ? 1.0
                               : 0.0;
            break;
        case torch::Source::Ruler:
            thrown.alpha = is_on_ruler(at.width_mm * from_middle, at.pixel_mm) ? 1.0 : 0.0;
            break;
        case torch::Source::Lens: {
            const glm::dvec2 middle = middle_of_stage();
            thrown.alpha = glm::length(from_middle) <= 0.5 * stage_.size ? 1.0 : 0.0;
            thrown.colour *= seen_(middle + (at.share - middle) / stage_.magnification);
            break;
        }
        case torch::Source::Layer:
            thrown.colour *= layer_(at.uv);
            break;
        case torch::Source::Plain:
            break;
        }
        const double pulse = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * stage_.pulse_hz * seconds_));
        thrown.alpha *= stage_.opacity * (1.0 - stage_.pulse_depth * pulse);
        return thrown;
    }

private:
    static double from_line(double at, double every) { return std::fabs(std::remainder(at, every)); }
    /// 0.3 mm wide: marks of 1 mm (4 mm long), 5 mm (7) and 10 mm (10), of which those closer than four pixels are left out.
    static bool is_on_ruler(const glm::dvec2& mm, double pixel_mm) {
        const double half = 0.5 * std::fmax(0.3, pixel_mm);
        const double every = 4.0 * pixel_mm < 1.0 ? 1.0 : 4.0 * pixel_mm < 5.0 ? 5.0 : 10.0;
        const double mark = every * std::round(mm.x / every);
        const double length = std::fabs(std::remainder(mark, 10.0)) < 0.5  ? 10.0
                              : std::fabs(std::remainder(mark, 5.0)) < 0.5 ? 7.0
                                                                           : 4.0;
        return std::fabs(mm.y) <= half || (std::fabs(mm.x - mark) <= half && mm.y <= 0.0 && mm.y >= -length);
    }
    /// The stage turns clockwise about its middle, and scrolls to the right and down.
    [[nodiscard]] glm::dvec2 own_place(const glm::dvec2& share) const {
        const double angle = stage_.turn_rad_per_s * seconds_;
        const glm::dvec2 from = (share - 0.5) * glm::dvec2(1.0, height_);
        const glm::dvec2 back(std::cos(angle) * from.x + std::sin(angle) * from.y,
                              -std::sin(angle) * from.x + std::cos(angle) * from.y);
        return back / glm::dvec2(1.0, height_) + 0.5 - stage_.scroll_per_s * seconds_;
    }
    /// In the content: a stage scrolls along its own axes, which turn.
    [[nodiscard]] glm::dvec2 middle_of_stage() const {
        const double angle = stage_.turn_rad_per_s * seconds_;
        const glm::dvec2 by = stage_.scroll_per_s * seconds_ * glm::dvec2(1.0, height_);
        const glm::dvec2 turned(std::cos(angle) * by.x - std::sin(angle) * by.y,
                                std::sin(angle) * by.x + std::cos(angle) * by.y);
        return 0.5 + turned / glm::dvec2(1.0, height_);
    }

    torch::Stage stage_;
    double height_, seconds_;
    std::function<glm::dvec3(const glm::dvec2&)> seen_, layer_;
};

/// Stages laid over each other: their light, as it arrives, and the share of the surface that they cover.
class EvaluatedStages {
public:
    explicit EvaluatedStages(std::vector<Evaluated> stages) : stages_(std::move(stages)) {}
    [[nodiscard]] Thrown operator()(const At& at) const {
        glm::dvec3 light(0.0);
        double cover = 0.0;
        for (const Evaluated& stage : stages_) {
            const Thrown next = stage(at);
            const bool first = &stage == &stages_.front();
            switch (first ? torch::Mix::Over : stage.mix()) {
            case torch::Mix::Over:
                light = next.alpha * next.colour + (1.0 - next.alpha) * light;
                cover = next.alpha + (1.0 - next.alpha) * cover;
                break;
            case torch::Mix::Multiply: // a filter in the light's way
                light *= 1.0 - next.alpha + next.alpha * next.colour;
                break;
            case torch::Mix::Add:
                light += next.alpha * next.colour;
                cover = std::fmin(1.0, cover + next.alpha);
                break;
            }
        }
        return {cover, cover > 0.0 ? light / cover : glm::dvec3(0.0)};
    }

private:
    std::vector<Evaluated> stages_;
};

} // namespace frustumscreen::synthetic
