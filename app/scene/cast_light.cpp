#include "app/scene/cast_light.h"

#include "app/relief/lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

/// Codes are multiplied by what light is multiplied by to this power: sRGB's own, away from black.
constexpr float code_power = 1.0F / 2.4F;
constexpr std::size_t most_faces = 16; // more than any prop has
constexpr float code_offset = 0.055F * 255.0F;

/// Pixels [first, end) of a row.
struct Run {
    int first = 0, end = 0;
    [[nodiscard]] bool empty() const { return first >= end; }
};

/// Those of row `y` whose middle lies where (x, y, 1) times each line is positive, or on its left end: of two faces that share an edge,
/// one has it.
template <std::size_t Lines> Run run_inside(const std::array<glm::dvec3, Lines>& lines, int y, Run run) {
    for (const glm::dvec3& line : lines) {
        const double at_left = line.y * (y + 0.5) + line.z + 0.5 * line.x;
        if (line.x == 0.0) {
            run.end = at_left > 0.0 ? run.end : run.first;
            continue;
        }
        const double edge = std::ceil(-at_left / line.x);
        if (line.x > 0.0) {
            run.first = static_cast<int>(std::clamp(edge, double(run.first), double(run.end)));
        } else {
            run.end = static_cast<int>(std::clamp(edge, double(run.first), double(run.end)));
        }
    }
    return run;
}

FRUSTUMSCREEN_INLINE Floats root_of(Floats values) {
    Floats roots;
    for (int lane = 0; lane < lanes; ++lane) {
        roots[lane] = std::sqrt(values[lane]);
    }
    return roots;
}

/// Eight pixels of row `y`, from `x` on; a texel each, red in the lowest byte.
FRUSTUMSCREEN_INLINE Ints lit(const CastLight::Gain& gain, float x, float y, Ints texels) {
    constexpr Floats columns = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
    const Floats ray_x = (x + columns) * gain.ray_per_pixel.x + gain.first_ray.x;
    const float ray_y = y * gain.ray_per_pixel.y + gain.first_ray.y;
    const Floats distance =
        root_of(ray_x * ray_x + (ray_y * ray_y + 1.0F)) /
        (ray_x * gain.inverse_depth.x + (ray_y * gain.inverse_depth.y + gain.inverse_depth.z));
    // 3 / 2.4 is 1 + 1 / 4.
    const Floats linear =
        gain.brightness * least(all(gain.most), gain.per_cubic_metre * distance * distance * distance);
    const Floats power =
        gain.brightness_code *
        least(all(gain.most_code), gain.per_cubic_metre_code * distance * root_of(root_of(distance)));
    const auto channel = [&](int shift) FRUSTUMSCREEN_INLINED {
        const Floats code = __builtin_convertvector(texels >> shift & 255, Floats);
        const Floats shown = most(linear * code, (code + code_offset) * power - code_offset);
        return __builtin_convertvector(least(shown, all(255.0F)) + 0.5F, Ints) << shift;
    };
    constexpr auto alpha = static_cast<std::int32_t>(0xFF000000U);
    const Ints seen = texels & alpha;
    return seen != 0 ? channel(0) | channel(8) | channel(16) | seen : Ints{};
}

FRUSTUMSCREEN_INLINE void light_run(const CastLight::Gain& gain, int y, int first,
                                    std::span<glm::u8vec4> codes) {
    for (std::size_t k = 0; k < codes.size(); k += lanes) {
        const std::size_t bytes = sizeof(glm::u8vec4) * std::min<std::size_t>(lanes, codes.size() - k);
        Ints texels{};
        std::memcpy(&texels, &codes[k], bytes);
        texels = lit(gain, static_cast<float>(first + static_cast<int>(k)), static_cast<float>(y), texels);
        std::memcpy(static_cast<void*>(&codes[k]), &texels, bytes);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void light_with_avx2(const CastLight::Gain& gain, int y, int first,
                                             std::span<glm::u8vec4> codes) {
    light_run(gain, y, first, codes);
}
#endif

void light_codes(const CastLight::Gain& gain, int y, int first, std::span<glm::u8vec4> codes) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        light_with_avx2(gain, y, first, codes);
        return;
    }
#endif
    light_run(gain, y, first, codes);
}

CastLight::Gain gain_of(const FacePlan& face, const Pinhole& pinhole, bool even_light, float brightness) {
    CastLight::Gain gain;
    const glm::dvec2 per_pixel = 1.0 / glm::dvec2(pinhole.fx, pinhole.fy);
    gain.ray_per_pixel = glm::vec2(per_pixel);
    gain.first_ray = glm::vec2((0.5 - glm::dvec2(pinhole.cx, pinhole.cy)) * per_pixel);
    gain.brightness = brightness;
    gain.brightness_code = std::pow(brightness, code_power);
    gain.per_cubic_metre = gain.per_cubic_metre_code = std::numeric_limits<float>::infinity();
    if (even_light) {
        gain.inverse_depth = face.light.inverse_depth;
        gain.per_cubic_metre = face.light.per_cubic_metre;
        gain.per_cubic_metre_code = std::pow(face.light.per_cubic_metre, code_power);
        gain.most = face.light.most;
        gain.most_code = std::pow(face.light.most, code_power);
    }
    return gain;
}

/// From the first point, where it is 0, to the second, where it is 1.
glm::dvec3 linear_between(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 slope = (to - from) / glm::dot(to - from, to - from);
    return {slope, -glm::dot(slope, from)};
}

} // namespace

void CastLight::begin(const FramePlan& plan, std::size_t cast) {
    faces_.clear();
    feathers_.clear();
    faces_.reserve(plan.faces.capacity());
    feathers_.reserve(plan.feathers.capacity());
    const CastPlan& planned = plan.casts[cast];
    changes_codes_ = planned.even_light;
    for (const Draw& draw : plan.draws) {
        if (draw.shader.pass != ShaderKey::Pass::Cast || draw.cast != cast) {
            continue;
        }
        changes_codes_ = changes_codes_ || draw.brightness != 1.0F;
        const FacePlan& face = plan.faces[static_cast<std::size_t>(draw.face)];
        for (const CastFace& seen : planned.view.faces) {
            if (seen.face == face.face) {
                faces_.push_back({draw.face, seen.edges,
                                  gain_of(face, plan.projector, planned.even_light, draw.brightness)});
            }
        }
    }
    const auto pixel = [&](const glm::vec4& clip) {
        return (0.5 * glm::dvec2(clip) + 0.5) * glm::dvec2(plan.projector.width, plan.projector.height);
    };
    for (const EdgeFeather& feather : plan.feathers) {
        const glm::dvec2 start = pixel(feather.corners_clip[0]);
        feathers_.push_back({feather.face, linear_between(start, pixel(feather.corners_clip[1])),
                             linear_between(start, pixel(feather.corners_clip[3])), feather.share});
    }
}

void CastLight::light(int y, int first, std::span<glm::u8vec4> codes) const {
    const Run all_of{first, first + static_cast<int>(codes.size())};
    const auto part = [&](const Run& run) {
        return codes.subspan(static_cast<std::size_t>(run.first - first),
                             static_cast<std::size_t>(run.end - run.first));
    };
    std::array<Run, most_faces> lit_runs{};
    std::size_t runs = 0;
    for (const Face& face : faces_) {
        const Run run = run_inside(face.edges, y, all_of);
        if (run.empty() || runs == lit_runs.size()) {
            continue;
        }
        lit_runs[runs++] = run;
        if (changes_codes_) {
            light_codes(face.gain, y, run.first, part(run));
        }
        for (const Feather& feather : feathers_) {
            if (feather.face == face.face) {
                soften(feather, y, run.first, part(run));
            }
        }
    }
    std::sort(lit_runs.begin(), lit_runs.begin() + static_cast<std::ptrdiff_t>(runs),
              [](const Run& a, const Run& b) { return a.first < b.first; });
    int dark = first; // what no face has lies before, between and behind them
    for (std::size_t k = 0; k < runs; ++k) {
        std::ranges::fill(part({dark, std::max(dark, lit_runs[k].first)}), glm::u8vec4(0));
        dark = lit_runs[k].end;
    }
    std::ranges::fill(part({dark, all_of.end}), glm::u8vec4(0));
}

void CastLight::soften(const Feather& feather, int y, int first, std::span<glm::u8vec4> codes) const {
    const glm::dvec3 one(0.0, 0.0, 1.0);
    const std::array<glm::dvec3, 4> sides{feather.along, one - feather.along, feather.inward,
                                          one - feather.inward};
    const Run run = run_inside(sides, y, {first, first + static_cast<int>(codes.size())});
    for (int x = run.first; x < run.end; ++x) {
        const glm::dvec3 pixel(x + 0.5, y + 0.5, 1.0);
        const auto along = static_cast<float>(glm::dot(feather.along, pixel));
        const auto inward = static_cast<float>(glm::dot(feather.inward, pixel));
        const float share = glm::mix(glm::mix(feather.share.x, feather.share.y, along), 1.0F, inward);
        const float factor = std::pow(std::max(share, 0.0F), code_power);
        glm::u8vec4& code = codes[static_cast<std::size_t>(x - first)];
        code = glm::u8vec4(glm::u8vec3(factor * glm::vec3(code) + 0.5F), code.a);
    }
}

} // namespace frustumscreen
