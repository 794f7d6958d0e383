#include "app/bench/shimmer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

constexpr int rays_per_side = 4;
constexpr glm::u8vec4 black(0, 0, 0, 255);

/// A part of the projector's picture.
struct Part {
    glm::ivec2 low{0};
    glm::ivec2 size{0};
};

/// How the prop is pushed: table frame, metres a step.
struct Push {
    glm::dvec2 step_m{0.0};
};

glm::dvec2 middle_px(const Stage& stage, const BenchPose& pose) {
    const glm::dvec3 middle(0.0, 0.0, stage.prop.size.height_m / 2.0);
    const ProjectorSettings& projector = stage.settings.projector;
    return projector.pinhole
        .pixel(projector.table_from_projector.inverse().point(pose.table_from_prop.point(middle)))
        .value_or(glm::dvec2(0.0));
}

BenchPose pushed(BenchPose pose, const glm::dvec2& by_m) {
    pose.table_from_prop.translation += glm::dvec3(by_m, 0.0);
    return pose;
}

/// The push that moves the prop's middle by `step_px` along a row (0) or a column (1) of the picture.
Push push_of(const Stage& stage, const BenchPose& pose, int direction) {
    constexpr double probe_m = 1e-4;
    const glm::dvec2 at = middle_px(stage, pose);
    const glm::dvec2 along_x = (middle_px(stage, pushed(pose, {probe_m, 0.0})) - at) / probe_m;
    const glm::dvec2 along_y = (middle_px(stage, pushed(pose, {0.0, probe_m})) - at) / probe_m;
    glm::dvec2 wanted(0.0);
    wanted[direction] = step_px;
    return {glm::inverse(glm::dmat2(along_x, along_y)) * wanted};
}

/// Holds the prop in every step, with a rim.
Part part_of(const Stage& stage, std::span<const BenchPose> sequence) {
    constexpr int rim_px = 4;
    const ProjectorSettings& projector = stage.settings.projector;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const BenchPose* pose : {&sequence.front(), &sequence.back()}) {
        for (const PropFace& face : stage.prop.faces) {
            for (const glm::dvec3& corner : face.corners) {
                const auto pixel = projector.pinhole.pixel(
                    projector.table_from_projector.inverse().point(pose->table_from_prop.point(corner)));
                low = glm::min(low, pixel.value_or(low));
                high = glm::max(high, pixel.value_or(high));
            }
        }
    }
    const glm::ivec2 all(stage.width(), stage.height());
    const glm::ivec2 from = glm::clamp(glm::ivec2(glm::floor(low)) - rim_px, glm::ivec2(0), all);
    const glm::ivec2 to = glm::clamp(glm::ivec2(glm::ceil(high)) + rim_px, from, all);
    return {from, to - from};
}

Image8 cut(const Image8& picture, const Part& part) {
    Image8 made(part.size.x, part.size.y);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            made.at(x, y) = picture.at(part.low.x + x, part.low.y + y);
        }
    }
    return made;
}

/// The truth's view of a part alone, each side of a pixel split into `split`.
TruthView view_of_part(const Settings& settings, const BenchPose& pose, const Part& part, int split) {
    TruthView view = view_of(settings, pose);
    view.projector.cx -= part.low.x;
    view.projector.cy -= part.low.y;
    view.projector.width = part.size.x;
    view.projector.height = part.size.y;
    view.projector = view.projector.scaled_to(split * part.size.x, split * part.size.y);
    return view;
}

/// Averages squares of `split` pixels in linear light.
Image8 averaged(const Image8& fine, int split) {
    const std::array<float, 256>& linear = linear_from_srgb8();
    Image8 made(fine.width / split, fine.height / split);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            glm::vec3 sum(0.0F);
            for (int k = 0; k < split * split; ++k) {
                const glm::u8vec4& code = fine.at(split * x + k % split, split * y + k / split);
                sum += glm::vec3(linear[code.r], linear[code.g], linear[code.b]);
            }
            sum /= static_cast<float>(split * split);
            made.at(x, y) = {srgb8_from_linear(sum.r), srgb8_from_linear(sum.g), srgb8_from_linear(sum.b),
                             255};
        }
    }
    return made;
}

/// Marks the hits and their eight neighbours.
void mark(const Image<std::uint8_t>& hit, Image<std::uint8_t>& judged) {
    for (int y = 0; y < hit.height; ++y) {
        for (int x = 0; x < hit.width; ++x) {
            if (hit.at(x, y) == 0) {
                continue;
            }
            for (int v = std::max(0, y - 1); v <= std::min(hit.height - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(hit.width - 1, x + 1); ++u) {
                    judged.at(u, v) = 1;
                }
            }
        }
    }
}

/// The largest value within `reach`, along rows and then along columns.
Image<float> spread_out(const Image<float>& values, int reach) {
    const auto along = [reach](const Image<float>& from, const glm::ivec2& step) {
        Image<float> made(from.width, from.height);
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

/// Shimmer of drawn and truth as grey, excess as red, side by side.
Image8 maps_of(const Image<float>& drawn, const Image<float>& truth, const Image<std::uint8_t>& beyond,
               const Image<std::uint8_t>& judged) {
    Image8 picture(3 * drawn.width, drawn.height, black);
    const auto grey = [](float codes) {
        const auto value = static_cast<std::uint8_t>(std::min(255.0F, 2.0F * codes));
        return glm::u8vec4(value, value, value, 255);
    };
    for (int y = 0; y < drawn.height; ++y) {
        for (int x = 0; x < drawn.width; ++x) {
            picture.at(x, y) = grey(drawn.at(x, y));
            picture.at(drawn.width + x, y) = grey(truth.at(x, y));
            picture.at(2 * drawn.width + x, y) = beyond.at(x, y) != 0   ? glm::u8vec4(255, 40, 30, 255)
                                                 : judged.at(x, y) != 0 ? glm::u8vec4(48, 48, 48, 255)
                                                                        : black;
        }
    }
    return picture;
}

/// One pose pushed in one direction: what the truth shows, and then what each level makes of it.
class Sequence {
public:
    Sequence(const Stage& stage, const BenchPose& pose, int direction, int steps) : settings_(stage.settings) {
        const Push push = push_of(stage, pose, direction);
        for (int k = 0; k <= steps; ++k) {
            poses_.push_back(pushed(pose, static_cast<double>(k) * push.step_m));
        }
        part_ = part_of(stage, poses_);
        judged_ = Image<std::uint8_t>(part_.size.x, part_.size.y);
    }

    void cast(const Truth& truth, const PropShape& prop, bool sixteen_rays) {
        Flicker one_ray;
        Flicker many;
        for (const BenchPose& pose : poses_) {
            TruthPicture picture = truth.cast(prop, view_of_part(settings_, pose, part_, 1), false);
            mark(picture.hit, judged_);
            one_ray.add(std::move(picture.colour));
            if (sixteen_rays) {
                many.add(averaged(
                    truth.cast(prop, view_of_part(settings_, pose, part_, rays_per_side), false).colour,
                    rays_per_side));
            }
        }
        one_ray_ = one_ray.per_pixel();
        truth_.one_ray = shimmer_of(one_ray_, judged_);
        if (sixteen_rays) {
            truth_.sixteen_rays = shimmer_of(many.per_pixel(), judged_);
        }
        truth_.judged_pixels = std::count(judged_.texels.begin(), judged_.texels.end(), std::uint8_t{1});
    }

    /// Its row, and the maps into `maps`.
    [[nodiscard]] ShimmerRow judge(TechniqueSet& set, std::size_t technique, Image8& maps) const {
        Flicker flicker;
        for (const BenchPose& pose : poses_) {
            flicker.add(cut(set.picture(technique, pose), part_));
        }
        const Image<float> drawn = flicker.per_pixel();
        const Image<std::uint8_t> beyond = excess(drawn, one_ray_, judged_);
        ShimmerRow row = truth_;
        row.technique = set.results()[technique].name;
        row.level = set.results()[technique].level;
        row.drawn = shimmer_of(drawn, judged_);
        row.excess_pixels = std::count(beyond.texels.begin(), beyond.texels.end(), std::uint8_t{1});
        maps = maps_of(drawn, one_ray_, beyond, judged_);
        return row;
    }

private:
    const Settings& settings_;
    std::vector<BenchPose> poses_;
    Part part_;
    Image<std::uint8_t> judged_;
    Image<float> one_ray_;
    ShimmerRow truth_; ///< what all rows share
};

/// The default and finest level over every pose and direction.
void measure(TechniqueSet& set, const Truth& truth, const ShimmerOptions& options, const Progress& progress,
             ShimmerResult& result) {
    double worst_percent = -1.0;
    const int sequences = 2 * static_cast<int>(result.poses.size());
    for (int k = 0; k < sequences; ++k) {
        Sequence sequence(set.stage(), result.poses[static_cast<std::size_t>(k / 2)], k % 2, options.steps);
        sequence.cast(truth, set.stage().prop, options.sixteen_rays);
        for (std::size_t technique = 0; technique < set.results().size(); ++technique) {
            if (set.results()[technique].kind != TechniqueKind::PackLevel) {
                continue;
            }
            Image8 maps;
            ShimmerRow row = sequence.judge(set, technique, maps);
            row.pose = k / 2;
            row.direction = k % 2;
            if (row.excess_percent() > worst_percent) {
                worst_percent = row.excess_percent();
                result.worst = std::move(maps);
            }
            result.rows.push_back(std::move(row));
        }
        progress(static_cast<double>(k + 1) / sequences);
    }
}

double ratio(double drawn, double truth) {
    return truth > 0.0 ? drawn / truth : (drawn > 0.0 ? std::numeric_limits<double>::infinity() : 1.0);
}

Result<ShimmerResult> compare(const SetUp& set_up, const Pack& pack,
                              const std::shared_ptr<const SourceMesh>& mesh, const ShimmerOptions& options,
                              const StepProgress& progress) {
    Result<std::unique_ptr<TechniqueSet>> set = open_default_and_finest(set_up, pack, options.picture);
    if (!set) {
        return tl::unexpected<Error>(set.error());
    }
    const PropShape& prop = (*set)->stage().prop;
    Result<std::vector<BenchPose>> poses = draw_poses(set_up.settings, prop, options.poses, options.seed);
    if (!poses) {
        return tl::unexpected<Error>(poses.error());
    }
    const Result<Truth> truth = Truth::build(mesh, place(pack, prop).prop_from_artifact);
    if (!truth) {
        return tl::unexpected<Error>(truth.error());
    }
    ShimmerResult result{set_up.name, std::move(*poses), {}, {}};
    measure(**set, *truth, options, [&](double done) { progress(set_up.name + ": shimmer", done); }, result);
    return result;
}

} // namespace

void Flicker::add(Image8 picture) {
    if (pictures_ == 0) {
        squares_ = Image<float>(picture.width, picture.height);
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

Image<float> Flicker::per_pixel() const {
    Image<float> made = squares_;
    const auto differences = static_cast<float>(3 * std::max(1, pictures_ - 2));
    for (float& value : made.texels) {
        value = std::sqrt(value / differences);
    }
    return made;
}

ShimmerFigure shimmer_of(const Image<float>& per_pixel, const Image<std::uint8_t>& judged) {
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

Image<std::uint8_t> excess(const Image<float>& technique, const Image<float>& truth,
                           const Image<std::uint8_t>& judged) {
    const Image<float> allowed = spread_out(truth, excess_reach_px);
    Image<std::uint8_t> made(judged.width, judged.height);
    for (std::size_t k = 0; k < judged.texels.size(); ++k) {
        made.texels[k] =
            judged.texels[k] != 0 && technique.texels[k] > allowed.texels[k] + excess_codes ? 1 : 0;
    }
    return made;
}

double ShimmerRow::rms_ratio() const {
    return ratio(drawn.rms, one_ray.rms);
}
double ShimmerRow::q999_ratio() const {
    return ratio(drawn.q999, one_ray.q999);
}
double ShimmerRow::excess_percent() const {
    return 100.0 * static_cast<double>(excess_pixels) /
           static_cast<double>(std::max<std::int64_t>(1, judged_pixels));
}

Result<ShimmerResult> shimmer(const SetUp& set_up, const Pack& pack,
                              const std::shared_ptr<const SourceMesh>& mesh, const ShimmerOptions& options,
                              const StepProgress& progress) {
    Result<ShimmerResult> result = compare(set_up, pack, mesh, options, progress);
    return result ? std::move(result) : at(set_up.name, result.error());
}

} // namespace frustumscreen
