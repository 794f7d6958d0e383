#include "app/bench/measures/shimmer_sequence.h"

#include "app/bench/measures/measure.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr int rays_per_side = 4;

std::optional<glm::dvec2> projected(const settings::Settings& settings, const BenchPose& pose,
                                    const glm::dvec3& in_prop) {
    const settings::ProjectorSettings& projector = settings.projector;
    return projector.pinhole.pixel(
        projector.table_from_projector.inverse().point(pose.table_from_prop.point(in_prop)));
}

BenchPose pushed(BenchPose pose, const glm::dvec2& by_m) {
    pose.table_from_prop.translation += glm::dvec3(by_m, 0.0);
    return pose;
}

/// Metres on the table per step that move the prop's middle by `step_px`.
glm::dvec2 step_m(const settings::Settings& settings, const geometry::PropShape& prop, const BenchPose& pose,
                  PushDirection direction) {
    constexpr double probe_m = 1e-4;
    const auto middle_px = [&](const glm::dvec2& by_m) {
        return projected(settings, pushed(pose, by_m), prop.middle).value_or(glm::dvec2(0.0));
    };
    const glm::dvec2 along_x = (middle_px({probe_m, 0.0}) - middle_px({-probe_m, 0.0})) / (2.0 * probe_m);
    const glm::dvec2 along_y = (middle_px({0.0, probe_m}) - middle_px({0.0, -probe_m})) / (2.0 * probe_m);
    const glm::dvec2 wanted =
        direction == PushDirection::Row ? glm::dvec2(step_px, 0.0) : glm::dvec2(0.0, step_px);
    return glm::inverse(glm::dmat2(along_x, along_y)) * wanted;
}

/// Averages blocks of `split` x `split` pixels in linear light.
image::Image8 averaged(const image::Image8& fine, int split) {
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    image::Image8 made(fine.width / split, fine.height / split);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            glm::vec3 sum(0.0F);
            for (int k = 0; k < split * split; ++k) {
                const glm::u8vec4& code = fine.at(split * x + k % split, split * y + k / split);
                sum += glm::vec3(linear[code.r], linear[code.g], linear[code.b]);
            }
            sum /= static_cast<float>(split * split);
            made.at(x, y) = {image::srgb8_from_linear(sum.r), image::srgb8_from_linear(sum.g),
                             image::srgb8_from_linear(sum.b), 255};
        }
    }
    return made;
}

/// The maximum within `reach`, along rows and then along columns.
image::Image<float> spread_out(const image::Image<float>& values, int reach) {
    const auto along = [reach](const image::Image<float>& from, const glm::ivec2& step) {
        image::Image<float> made(from.width, from.height);
        for (int y = 0; y < from.height; ++y) {
            for (int x = 0; x < from.width; ++x) {
                float most = from.at(x, y);
                for (int k = -reach; k <= reach; ++k) {
                    const glm::ivec2 at = glm::ivec2(x, y) + k * step;
                    if (at.x >= 0 && at.y >= 0 && at.x < from.width && at.y < from.height) {
                        most = std::max(most, from.at(at.x, at.y));
                    }
                }
                made.at(x, y) = most;
            }
        }
        return made;
    };
    return along(along(values, {1, 0}), {0, 1});
}

double ratio(double drawn, double truth) {
    return truth > 0.0 ? drawn / truth : (drawn > 0.0 ? std::numeric_limits<double>::infinity() : 1.0);
}

} // namespace

void Flicker::add(image::Image8 picture) {
    if (pictures_ == 0) {
        squares_ = image::Image<float>(picture.width, picture.height);
    }
    if (pictures_ >= 2) {
        for (std::size_t k = 0; k < squares_.texels.size(); ++k) {
            const glm::ivec4 second = glm::ivec4(picture.texels[k]) - 2 * glm::ivec4(last_[1].texels[k]) +
                                      glm::ivec4(last_[0].texels[k]);
            squares_.texels[k] +=
                static_cast<float>(second.r * second.r + second.g * second.g + second.b * second.b);
        }
    }
    last_[0] = std::move(last_[1]);
    last_[1] = std::move(picture);
    ++pictures_;
}

image::Image<float> Flicker::per_pixel() const {
    image::Image<float> made = squares_;
    const auto differences = static_cast<float>(3 * std::max(1, pictures_ - 2));
    for (float& value : made.texels) {
        value = std::sqrt(value / differences);
    }
    return made;
}

ShimmerFigure shimmer_of(const image::Image<float>& per_pixel, const image::Image<std::uint8_t>& judged) {
    std::vector<double> values;
    double squares = 0.0;
    for (std::size_t k = 0; k < judged.texels.size(); ++k) {
        if (judged.texels[k] != 0) {
            const double value = per_pixel.texels[k];
            squares += value * value;
            values.push_back(value);
        }
    }
    const auto pixels = static_cast<double>(std::max<std::size_t>(1, values.size()));
    return {std::sqrt(squares / pixels), quantile(std::move(values), 0.999)};
}

image::Image<std::uint8_t> excess(const image::Image<float>& technique, const image::Image<float>& truth,
                                  const image::Image<std::uint8_t>& judged) {
    const image::Image<float> allowed = spread_out(truth, excess_reach_px);
    image::Image<std::uint8_t> made(judged.width, judged.height);
    for (std::size_t k = 0; k < judged.texels.size(); ++k) {
        made.texels[k] =
            judged.texels[k] != 0 && technique.texels[k] > allowed.texels[k] + excess_codes ? 1 : 0;
    }
    return made;
}

double SequenceShimmer::rms_ratio() const {
    return ratio(drawn.rms, one_ray.rms);
}
double SequenceShimmer::q999_ratio() const {
    return ratio(drawn.q999, one_ray.q999);
}
double SequenceShimmer::excess_percent() const {
    return 100.0 * static_cast<double>(excess_pixels) /
           static_cast<double>(std::max<std::int64_t>(1, judged_pixels));
}

image::Image8 side_by_side(const ShimmerMaps& maps) {
    const int width = maps.drawn.width;
    image::Image8 picture(3 * width, maps.drawn.height);
    const auto grey = [](float codes) {
        const auto value = static_cast<std::uint8_t>(std::min(255.0F, codes));
        return glm::u8vec4(value, value, value, 255);
    };
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.at(x, y) = grey(2.0F * maps.drawn.at(x, y));
            picture.at(width + x, y) = grey(2.0F * maps.one_ray.at(x, y));
            picture.at(2 * width + x, y) = maps.beyond.at(x, y) != 0 ? glm::u8vec4(255, 40, 30, 255)
                                                                     : grey(48.0F * maps.judged.at(x, y));
        }
    }
    return picture;
}

ShimmerSequence::ShimmerSequence(const settings::Settings& settings, const geometry::PropShape& prop,
                                 const BenchPose& pose, PushDirection direction, int steps)
    : settings_(settings), prop_(prop) {
    const glm::dvec2 step = step_m(settings, prop, pose, direction);
    for (int k = 0; k <= steps; ++k) {
        poses_.push_back(pushed(pose, static_cast<double>(k) * step));
    }
    part_ = part_around_prop();
    judged_ = image::Image<std::uint8_t>(part_.size.x, part_.size.y);
}

/// The part that contains the prop in every step, with a margin.
ShimmerSequence::Part ShimmerSequence::part_around_prop() const {
    constexpr int rim_px = 4;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const BenchPose* pose : {&poses_.front(), &poses_.back()}) {
        for (const geometry::PropFace& face : prop_.faces) {
            for (const glm::dvec3& corner : face.corners) {
                const std::optional<glm::dvec2> pixel = projected(settings_, *pose, corner);
                low = glm::min(low, pixel.value_or(low));
                high = glm::max(high, pixel.value_or(high));
            }
        }
    }
    const glm::dvec2 all(settings_.projector.pinhole.width, settings_.projector.pinhole.height);
    const glm::dvec2 from = glm::clamp(glm::floor(low) - double{rim_px}, glm::dvec2(0.0), all);
    const glm::dvec2 to = glm::clamp(glm::ceil(high) + double{rim_px}, from, all);
    return {glm::ivec2(from), glm::ivec2(to - from)};
}

image::Image8 ShimmerSequence::cut(const image::Image8& picture) const {
    image::Image8 made(part_.size.x, part_.size.y);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            made.at(x, y) = picture.at(part_.low.x + x, part_.low.y + y);
        }
    }
    return made;
}

/// The truth's view of the part alone, with each pixel split into `split` x `split`.
TruthView ShimmerSequence::view_of_part(const BenchPose& pose, int split) const {
    TruthView view = view_of(settings_, pose);
    view.projector.cx -= part_.low.x;
    view.projector.cy -= part_.low.y;
    view.projector.width = part_.size.x;
    view.projector.height = part_.size.y;
    view.projector = view.projector.scaled_to(split * part_.size.x, split * part_.size.y);
    return view;
}

void ShimmerSequence::cast(const Truth& truth, bool sixteen_rays) {
    Flicker one_ray;
    Flicker many;
    image::Image<float> hits(part_.size.x, part_.size.y);
    for (const BenchPose& pose : poses_) {
        TruthPicture picture = truth.cast(prop_, view_of_part(pose, 1), false);
        for (std::size_t k = 0; k < hits.texels.size(); ++k) {
            hits.texels[k] = std::max(hits.texels[k], static_cast<float>(picture.hit.texels[k]));
        }
        one_ray.add(std::move(picture.colour));
        if (sixteen_rays) {
            many.add(
                averaged(truth.cast(prop_, view_of_part(pose, rays_per_side), false).colour, rays_per_side));
        }
    }
    const image::Image<float> judged = spread_out(hits, 1);
    std::transform(judged.texels.begin(), judged.texels.end(), judged_.texels.begin(),
                   [](float hit) { return static_cast<std::uint8_t>(hit > 0.0F ? 1 : 0); });
    one_ray_ = one_ray.per_pixel();
    truth_.one_ray = shimmer_of(one_ray_, judged_);
    allowed_ = one_ray_;
    if (sixteen_rays) {
        const image::Image<float> smooth = many.per_pixel();
        truth_.sixteen_rays = shimmer_of(smooth, judged_);
        std::transform(smooth.texels.begin(), smooth.texels.end(), one_ray_.texels.begin(),
                       allowed_.texels.begin(), [](float a, float b) { return std::max(a, b); });
    }
    truth_.judged_pixels = std::count(judged_.texels.begin(), judged_.texels.end(), std::uint8_t{1});
}

SequenceShimmer ShimmerSequence::judge(const Draw& draw, ShimmerMaps& maps) const {
    Flicker flicker;
    for (const BenchPose& pose : poses_) {
        flicker.add(cut(draw(pose)));
    }
    maps = {.drawn = flicker.per_pixel(), .one_ray = one_ray_, .judged = judged_, .beyond = {}};
    maps.beyond = excess(maps.drawn, allowed_, judged_);
    SequenceShimmer found = truth_;
    found.drawn = shimmer_of(maps.drawn, judged_);
    found.excess_pixels = std::count(maps.beyond.texels.begin(), maps.beyond.texels.end(), std::uint8_t{1});
    return found;
}

} // namespace frustumscreen::bench
