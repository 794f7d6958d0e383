/// Compares two pictures, without and with torches, with what rays say of each pixel.
///
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "tests/render/torch_truth.h"
#include "tests/render/torch_world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::synthetic {

struct Counts {
    std::size_t lit = 0, dark = 0, shadow = 0; ///< dark: of the object; shadow: those in a beam
    std::size_t outline = 0, edge = 0, wrong = 0;
    double worst = 0.0; ///< codes, of lit pixels that no outline or edge excuses
};

/// The error of a drawing.
struct Tolerance {
    double eye_px = 1.0 / 32.0; ///< of the projector: outlines of what is seen
    double torch_px = 1.12;     ///< of the torch's picture: the three depths next to a place lie within it
    double place_m = 1e-5;
    double margin_m = 1e-4;
};
inline constexpr Tolerance of_mesh{};
/// The four depths around a place count of a torch's picture that the GPU draws.
inline constexpr Tolerance of_cut_outs{.torch_px = 1.42};
/// A relief of so few texels lies up to one texel off its outline.
inline constexpr Tolerance of_relief{.eye_px = 1.5, .torch_px = 4.0, .place_m = 1e-3, .margin_m = 6e-4};

class Compared {
public:
    Compared(Interlocked& world, const TestTable& table, std::span<const scene::PlacedTorch> torches,
             const Tolerance& tolerance)
        : Compared(world, table, torches, tolerance, table.table_from_prop.inverse().point(table.eye_m),
                   [&](const glm::dvec2& pixel) { return world.seen(table, pixel); }) {}
    /// `table`: in which the torches light the prop. `eye`: prop frame. `seen`: of the world, by pixels of the two pictures.
    /// `cut`: as TorchTruth.
    Compared(const Interlocked& world, const TestTable& table, std::span<const scene::PlacedTorch> torches,
             const Tolerance& tolerance, const glm::dvec3& eye,
             std::function<SeenPart(const glm::dvec2&)> seen, const std::optional<geometry::Plane>& cut = {})
        : torches_(torches), tolerance_(tolerance), eye_(eye), seen_(std::move(seen)) {
        for (const scene::PlacedTorch& torch : torches) {
            truths_.emplace_back(world, torch, table, cut);
        }
    }
    void count(const image::Image8& without, const image::Image8& with, Counts& counts) const {
        for (int y = 0; y < without.height; ++y) {
            for (int x = 0; x < without.width; ++x) {
                count_pixel({x + 0.5, y + 0.5}, without.at(x, y), with.at(x, y), counts);
            }
        }
    }

private:
    void count_pixel(const glm::dvec2& pixel, const glm::u8vec4& before, const glm::u8vec4& after,
                     Counts& counts) const {
        const SeenPart place = seen_(pixel);
        std::vector<bool> lit;
        bool in_beam = false;
        for (const TorchTruth& truth : truths_) {
            lit.push_back(place.part >= 0 && truth.lights(place, eye_));
            in_beam = in_beam || (place.part >= 0 && truth.in_beam(place.point));
        }
        const bool any = std::ranges::count(lit, true) > 0;
        const double off = any ? codes_off(place, lit, before, after) : before == after ? 0.0 : 255.0;
        counts.lit += any ? 1U : 0U;
        counts.dark += any || place.part < 0 ? 0U : 1U;
        counts.shadow += !any && in_beam ? 1U : 0U;
        if (off <= 0.0) {
            return;
        }
        if (is_outline(pixel, place)) {
            ++counts.outline;
        } else if (is_edge(pixel, place)) {
            ++counts.edge;
        } else {
            ++counts.wrong;
            counts.worst = std::fmax(counts.worst, off);
        }
    }

    /// Codes beyond the bound: each torch reads 8-bit codes and rounds to them.
    [[nodiscard]] double codes_off(const SeenPart& place, const std::vector<bool>& lit,
                                   const glm::u8vec4& before, const glm::u8vec4& after) const {
        constexpr double half =
            0.6 + 0.1; // of a code: a driver's conversion to sRGB (Direct3D 11.3, 3.2.3.7), and from it
        double off = 0.0;
        for (int channel = 0; channel < 3; ++channel) {
            double low = before[channel];
            double high = before[channel];
            for (std::size_t k = 0; k < lit.size(); ++k) {
                if (lit[k]) {
                    const double distance_m = truths_[k].distance_to(place.point);
                    const double least = truths_[k].fallen(distance_m + tolerance_.place_m);
                    const double greatest = truths_[k].fallen(distance_m - tolerance_.place_m);
                    low = std::fmin(shone(torches_[k], channel, low, least),
                                    shone(torches_[k], channel, low, greatest));
                    high = std::fmax(shone(torches_[k], channel, high, least),
                                     shone(torches_[k], channel, high, greatest));
                    low = std::fmax(0.0, low - half);
                    high = std::fmin(255.0, high + half);
                }
            }
            off = std::fmax(off, std::fmax(low - after[channel], after[channel] - high));
        }
        return off;
    }
    /// The code after a torch of this intensity. A content that covers has the surface's own light.
    static double shone(const scene::PlacedTorch& torch, int channel, double code, double intensity) {
        const double light = light_of_code(code);
        const double colour = double{torch.stages.front().colour[channel]};
        return code_of_light(torch.blend == torch::Blend::Light
                                 ? light + light * intensity * colour
                                 : light + (base_light * colour - light) * intensity);
    }

    template <typename Differs>
    [[nodiscard]] bool any_beside(const glm::dvec2& pixel, Differs differs) const {
        for (int k = 0; k < 16; ++k) {
            const double angle = k * std::numbers::pi / 8.0;
            for (const double share : {0.5, 1.0}) {
                const double r = share * tolerance_.eye_px;
                if (differs(seen_(pixel + r * glm::dvec2(std::cos(angle), std::sin(angle))))) {
                    return true;
                }
            }
        }
        return false;
    }
    /// Rays close by see another part, nothing, or a place far behind or before it.
    [[nodiscard]] bool is_outline(const glm::dvec2& pixel, const SeenPart& own) const {
        return any_beside(pixel, [&](const SeenPart& beside) {
            return beside.part != own.part || (own.part >= 0 && glm::distance(beside.point, own.point) >
                                                                    2e-3 * std::fmax(1.0, tolerance_.eye_px));
        });
    }
    /// Where a beam ends, or the torch's ray grazes something on its way.
    [[nodiscard]] bool is_edge(const glm::dvec2& pixel, const SeenPart& own) const {
        for (const TorchTruth& truth : truths_) {
            if (any_beside(pixel, [&](const SeenPart& beside) {
                    return truth.lights(beside, eye_) != truth.lights(own, eye_);
                })) {
                return true;
            }
            if (truth.in_beam(own.point) &&
                truth.around(own, tolerance_.torch_px, tolerance_.margin_m) == TorchTruth::Around::Edge) {
                return true;
            }
        }
        return false;
    }

    std::span<const scene::PlacedTorch> torches_;
    Tolerance tolerance_;
    glm::dvec3 eye_;
    std::function<SeenPart(const glm::dvec2&)> seen_;
    std::vector<TorchTruth> truths_;
};

} // namespace frustumscreen::synthetic
