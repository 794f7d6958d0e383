#include "assets_baked/artifacts/amphora_paint.h"

#include "assets_baked/artifacts/amphora_figures.h"
#include "assets_baked/artifacts/amphora_ornaments.h"
#include "assets_baked/artifacts/ink.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float turn = 6.28318531F;
/// sRGB. The slip is lighter than real slip, because a projector cannot show black.
constexpr vec3 clay_colour{0.79F, 0.46F, 0.26F};
constexpr vec3 slip_colour{0.150F, 0.125F, 0.120F};
constexpr vec3 thin_slip_colour{0.36F, 0.17F, 0.10F};
constexpr vec3 red_colour{0.47F, 0.13F, 0.12F};
constexpr vec3 white_colour{0.90F, 0.84F, 0.72F};

/// A part of the body between two heights; its y is the length along the profile.
struct Band {
    float bottom = 0.0F; ///< length along the profile, mm
    float height = 0.0F;
    float around = 0.0F; ///< mean circumference, mm
};

class BodyPainter {
public:
    explicit BodyPainter(const Profile& body)
        : rays_(band(body, 22, 62)), buds_(band(body, 67, 82)), animals_(band(body, 86, 119)),
          meander_(band(body, 123, 136)), figures_(band(body, 140, 211)), tongues_(band(body, 214, 241)),
          neck_(band(body, 252, 301)), foot_edge_(length_at(body, 2)), fillet_(band(body, 16, 21)),
          collar_(band(body, 242, 247)), lip_(length_at(body, 304)), lip_groove_(length_at(body, 326)) {}

    [[nodiscard]] Ink at(float u, float length, float edge) const {
        Ink ink;
        paint_lower(ink, u, length, edge);
        paint_friezes(ink, u, length, edge);
        paint_upper(ink, u, length, edge);
        return ink;
    }

private:
    static float length_at(const Profile& body, double height) {
        return static_cast<float>(body.length_at_height(height));
    }
    static Band band(const Profile& body, double low, double high) {
        const double a = body.length_at_height(low);
        const double b = body.length_at_height(high);
        const double radius = body.at_length(0.5 * (a + b)).position.x;
        return {static_cast<float>(a), static_cast<float>(b - a), turn * static_cast<float>(radius)};
    }
    static void fill(Ink& ink, float length, float low, float high, Pigment pigment, float edge) {
        paint_line(ink, length, 0.5F * (low + high), high - low, pigment, edge);
    }
    static bool inside(const Band& band, float length) {
        return length > band.bottom - 1.0F && length < band.bottom + band.height + 1.0F;
    }

    void paint_lower(Ink& ink, float u, float length, float edge) const {
        fill(ink, length, -1.0F, fillet_.bottom, Pigment::Slip, edge);
        fill(ink, length, foot_edge_, foot_edge_ + 1.4F, Pigment::Ground, edge);
        fill(ink, length, fillet_.bottom, fillet_.bottom + fillet_.height, Pigment::Red, edge);
        if (inside(rays_, length)) {
            paint_rays(ink, {u * rays_.around, length - rays_.bottom}, rays_.around / 24.0F, rays_.height,
                       edge);
        }
        const float top = rays_.bottom + rays_.height;
        fill(ink, length, top + 1.2F, top + 3.8F, Pigment::Slip, edge);
        paint_line(ink, length, top + 2.5F, 1.0F, Pigment::Red, edge);
        if (inside(buds_, length)) {
            paint_bud_chain(ink, {u * buds_.around, length - buds_.bottom}, buds_.around / 60.0F,
                            buds_.height, edge);
        }
    }

    void paint_friezes(Ink& ink, float u, float length, float edge) const {
        for (const Band* band : {&buds_, &animals_, &meander_, &figures_}) {
            const float top = band->bottom + band->height;
            paint_line(ink, length, top + 1.3F, 0.9F, Pigment::Slip, edge);
            paint_line(ink, length, top + 3.1F, 0.9F, Pigment::Slip, edge);
        }
        if (inside(animals_, length)) {
            paint_animals(ink, u, length - animals_.bottom, edge);
        }
        if (inside(meander_, length)) {
            paint_meander(ink, {u * meander_.around, length - meander_.bottom}, meander_.around / 36.0F,
                          meander_.height, edge);
        }
        if (inside(figures_, length)) {
            paint_scene(ink, u, length - figures_.bottom, edge);
        }
    }

    void paint_animals(Ink& ink, float u, float y, float edge) const {
        constexpr int deer = 10;
        const float size = animals_.height * 0.93F;
        const float cell = std::floor(u * deer);
        const float x = (u * deer - cell - 0.5F) * animals_.around / deer;
        paint_deer(ink, vec2(x / size + 0.02F, y / size), static_cast<int>(cell) % 2 == 0, edge / size);
        // Rosettes of dots fill the gaps.
        for (const vec2 at : {vec2(-0.5F, 0.80F), vec2(0.5F, 0.80F), vec2(-0.05F, 0.93F)}) {
            const vec2 p = vec2(x, y) - vec2(at.x * animals_.around / deer, at.y * animals_.height);
            const float angle = std::atan2(p.y, p.x);
            const float nearest = std::round(angle / turn * 6.0F) * turn / 6.0F;
            ink.paint(Pigment::Slip,
                      cover(disc(p, 2.3F * vec2(std::cos(nearest), std::sin(nearest)), 0.8F), edge));
            ink.paint(Pigment::Red, cover(disc(p, {0, 0}, 0.9F), edge));
        }
    }

    void paint_scene(Ink& ink, float u, float y, float edge) const {
        constexpr int places = 10; // places around the body: warriors, except for the handles at 0 and 5
        const float size = figures_.height * 0.985F;
        const int nearest = static_cast<int>(std::floor(u * places + 0.5F));
        for (int cell = nearest - 1; cell <= nearest + 1; ++cell) { // spears reach into the neighbouring
                                                                    // place
            const vec2 p = vec2((u * places - static_cast<float>(cell)) * figures_.around / places, y) / size;
            const int place = (cell + places) % places;
            if (place % 5 == 0) {
                paint_handle_ornament(ink, p, edge / size);
            } else {
                paint_hoplite(ink, {0.9F * p.x + 0.02F, p.y}, place % 5 + place / 5, edge / size);
            }
        }
    }

    void paint_upper(Ink& ink, float u, float length, float edge) const {
        if (inside(tongues_, length)) {
            paint_tongues(ink, {u * tongues_.around, length - tongues_.bottom}, tongues_.around / 56.0F,
                          tongues_.height, edge);
        }
        fill(ink, length, collar_.bottom, collar_.bottom + collar_.height, Pigment::Red, edge);
        paint_line(ink, length, neck_.bottom - 2.2F, 0.9F, Pigment::Slip, edge);
        paint_line(ink, length, neck_.bottom - 0.4F, 0.9F, Pigment::Slip, edge);
        if (inside(neck_, length)) {
            paint_lotus_chain(ink, {u * neck_.around, length - neck_.bottom - 1.0F}, neck_.around / 16.0F,
                              neck_.height - 2.0F, edge);
        }
        fill(ink, length, lip_, 1e4F, Pigment::Slip, edge);
        fill(ink, length, lip_groove_, lip_groove_ + 1.6F, Pigment::Red, edge);
    }

    Band rays_, buds_, animals_, meander_, figures_, tongues_, neck_;
    float foot_edge_;
    Band fillet_, collar_;
    float lip_, lip_groove_;
};

struct Wear {
    vec3 tint{1.0F};
    float thin = 0.0F;  ///< slip fired brown
    float chip = 0.0F;  ///< missing paint
    float crack = 0.0F; ///< mended break
    float grain_mm = 0.0F;
};

/// Wear at a point: `u` around 0..1, `y` mm.
Wear wear_at(float u, float y) {
    Wear wear;
    const float cells = u * 40.0F;
    const float broad = noise({u * 6.0F, y / 90.0F}, 6, 4, 11);
    const float fine = noise({cells * 8.0F, y / 1.9F}, 320, 3, 12);
    wear.tint = vec3(1.0F + 0.10F * broad + 0.05F * fine) +
                vec3(0.02F, 0.0F, -0.03F) * noise({u * 9.0F, y / 60.0F}, 9, 3, 13);
    wear.thin = glm::smoothstep(0.12F, 0.55F, noise({u * 5.0F, y / 130.0F}, 5, 4, 14) + 0.15F * fine);
    wear.chip = glm::smoothstep(0.40F, 0.47F,
                                noise({cells * 2.0F, y / 7.0F}, 80, 4, 15) +
                                    0.20F * noise({u * 7.0F, y / 70.0F}, 7, 2, 16));
    const float kept = glm::smoothstep(-0.10F, 0.05F, noise({u * 4.0F, y / 150.0F}, 4, 3, 20));
    if (kept > 0.0F) {
        const vec2 warp = {noise({u * 24.0F, y / 25.0F}, 24, 4, 17),
                           noise({u * 24.0F, y / 25.0F}, 24, 4, 18)};
        constexpr float shard_mm = 95.0F;
        const float border_mm = shard_mm * cell_border(vec2(u * 6.0F, y / shard_mm) + 0.25F * warp, 6, 19);
        wear.crack = kept * cover(border_mm - 0.15F, 0.7F);
    }
    wear.grain_mm = 0.05F * fine + 0.02F * std::sin(y * 2.1F + 3.0F * noise({u * 5.0F, y / 20.0F}, 5, 2,
                                                                            21)); // the wheel's marks
    return wear;
}

vec3 colour_of(const Ink& ink, const Wear& wear) {
    const vec3 clay = clay_colour * wear.tint;
    const vec3 slip = glm::mix(slip_colour, thin_slip_colour, 0.75F * wear.thin) * wear.tint;
    glm::vec4 share = glm::mix(ink.share, glm::vec4(1, 0, 0, 0), wear.chip);
    share = glm::mix(share, glm::vec4(share.x, share.y + share.w, share.z, 0.0F),
                     0.35F * wear.thin); // white rubs off
    const vec3 colour = clay * share.x + slip * share.y + red_colour * wear.tint * share.z +
                        white_colour * wear.tint * share.w;
    return glm::mix(colour, 0.45F * clay, 0.8F * wear.crack);
}

void paint_body(const Profile& body, AmphoraSkin& skin) {
    const BodyPainter painter(body);
    const auto length_mm = static_cast<float>(body.length_mm());
    const auto& strip = amphora_atlas::body;
    const float edge = 1.15F * length_mm / static_cast<float>(strip.rows);
    parallel_for(static_cast<std::size_t>(strip.rows), 1, [&](std::size_t begin, std::size_t) {
        const int row = static_cast<int>(begin);
        const float length =
            length_mm * (1.0F - static_cast<float>(row) / static_cast<float>(strip.rows - 1));
        for (int x = 0; x < amphora_atlas::size; ++x) {
            const float u = (static_cast<float>(x) + 0.5F) / amphora_atlas::size;
            const Ink ink = painter.at(u, length, edge);
            const Wear wear = wear_at(u, length);
            skin.texture.at(x, strip.first_row + row) = texel_of(colour_of(ink, wear));
            skin.body_relief_mm.at(x, row) =
                ink.raised_mm * (1.0F - 0.6F * wear.chip) - 0.35F * wear.crack + wear.grain_mm;
        }
    });
}

/// Fired clay and pigments before any wear.
Wear unworn() {
    Wear wear;
    wear.tint = vec3(1.14F, 1.04F, 0.94F);
    return wear;
}

void paint_new_body(const Profile& body, image::Image8& texture) {
    const BodyPainter painter(body);
    const auto length_mm = static_cast<float>(body.length_mm());
    const auto& strip = amphora_atlas::body;
    const float edge = 1.15F * length_mm / static_cast<float>(strip.rows);
    paint_strip(strip, texture, [&](float u, float v) {
        return colour_of(painter.at(u, length_mm * (1.0F - v), edge), unworn());
    });
}

void paint_new_plain(const AtlasStrip& strip, image::Image8& texture, float (*slip_at)(float fraction)) {
    paint_strip(strip, texture, [&](float /*u*/, float v) {
        Ink ink;
        ink.paint(Pigment::Slip, slip_at(v));
        return colour_of(ink, unworn());
    });
}

float slip_in_mouth(float fraction) {
    return 1.0F - glm::smoothstep(0.30F, 0.36F, fraction);
}
float slip_below(float fraction) {
    return glm::smoothstep(0.86F, 0.9F, fraction);
}
float slip_on_handle(float /*fraction*/) {
    return 1.0F;
}

/// The parts without figures: slip inside the mouth thinning into bare clay, clay below, slip on the handles.
/// `height_mm` is the strip's height, at a scale where its circumference equals the body's.
void paint_plain(const AtlasStrip& strip, float height_mm, image::Image8& texture,
                 float (*slip_at)(float fraction)) {
    paint_strip(strip, texture, [&](float u, float v) {
        const float y = 1000.0F + static_cast<float>(strip.first_row) + v * height_mm; // independent of the
                                                                                       // body's wear
        Ink ink;
        ink.paint(Pigment::Slip, slip_at(v + 0.03F * noise({u * 12.0F, y / 9.0F}, 12, 3, 31)));
        return colour_of(ink, wear_at(u, y));
    });
}

} // namespace

double ReliefMap::sample(double u, double v) const {
    const double x = u * width_ - 0.5;
    const double y = std::clamp(v, 0.0, 1.0) * (height_ - 1);
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const auto weights = [](double f) {
        const double g = 1.0 - f;
        return std::array<double, 4>{g * g * g / 6.0, (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0,
                                     (4.0 - 6.0 * g * g + 3.0 * g * g * g) / 6.0, f * f * f / 6.0};
    };
    const std::array<double, 4> wx = weights(x - x0);
    const std::array<double, 4> wy = weights(y - y0);
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
        const int row = std::clamp(y0 + j - 1, 0, height_ - 1);
        for (int i = 0; i < 4; ++i) {
            const int column = (x0 + i - 1 + width_) % width_;
            sum += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
                   static_cast<double>(texels_[index(column, row)]);
        }
    }
    return sum;
}

AmphoraSkin paint_amphora(const Profile& body) {
    namespace atlas = amphora_atlas;
    AmphoraSkin skin{image::Image8(atlas::size, atlas::size, texel_of(clay_colour)),
                     ReliefMap(atlas::size, atlas::body.rows)};
    paint_body(body, skin);
    paint_plain(atlas::mouth, 800.0F, skin.texture, slip_in_mouth);
    paint_plain(atlas::underside, 100.0F, skin.texture, slip_below);
    paint_plain(atlas::handle, 250.0F, skin.texture, slip_on_handle);
    return skin;
}

image::Image8 paint_new_amphora(const Profile& body) {
    namespace atlas = amphora_atlas;
    image::Image8 texture(atlas::size, atlas::size, texel_of(clay_colour));
    paint_new_body(body, texture);
    paint_new_plain(atlas::mouth, texture, slip_in_mouth);
    paint_new_plain(atlas::underside, texture, slip_below);
    paint_new_plain(atlas::handle, texture, slip_on_handle);
    return texture;
}

} // namespace frustumscreen::artifacts
