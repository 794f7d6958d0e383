#include "assets_baked/artifacts/amphora_figures.h"

#include "assets_baked/artifacts/amphora_ornaments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;

constexpr float turn = 6.28318531F;
constexpr float figure_raised_mm = 0.6F;

void silhouette(Ink& ink, Pigment pigment, float distance, float edge) {
    ink.paint(pigment, cover(distance, edge));
    ink.raise(figure_raised_mm,
              cover(distance + 1.5F * edge, 5.0F * edge)); // a rounded shoulder inside the outline
}

void incise(Ink& ink, float distance_to_line, float edge) {
    ink.paint(Pigment::Ground, 0.9F * cover(std::abs(distance_to_line) - 0.0022F, edge));
}

float star(vec2 p, int points, float inner, float outer) {
    const float sector = turn / static_cast<float>(points);
    const float angle = std::atan2(p.y, p.x);
    const float within = std::abs(angle - sector * std::round(angle / sector)) / (0.5F * sector);
    return glm::length(p) - glm::mix(outer, inner, within);
}

void paint_emblem(Ink& ink, vec2 p, int emblem, float edge) {
    switch (emblem % shield_emblems) {
    case 0: // a star
        ink.paint(Pigment::White, cover(star(p, 8, 0.03F, 0.115F), edge));
        ink.paint(Pigment::Red, cover(disc(p, {0, 0}, 0.022F), edge));
        break;
    case 1: { // three running legs become three curved blades
        for (int i = 0; i < 3; ++i) {
            const float a = turn * static_cast<float>(i) / 3.0F + 0.5F;
            const vec2 along = {std::cos(a), std::sin(a)};
            const vec2 bend = {-along.y, along.x};
            const vec2 knee = 0.075F * along;
            ink.paint(Pigment::White, cover(limb(p, {0, 0}, knee, 0.026F, 0.017F), edge));
            ink.paint(Pigment::White, cover(limb(p, knee, knee + 0.05F * bend, 0.017F, 0.009F), edge));
            ink.paint(Pigment::White, cover(limb(p, knee + 0.05F * bend, knee + 0.05F * bend + 0.025F * along,
                                                 0.009F, 0.005F),
                                            edge));
        }
        break;
    }
    case 2: // rings and balls
        ink.paint(Pigment::Red, cover(disc(p, {0, 0}, 0.045F), edge));
        for (int i = 0; i < 8; ++i) {
            const float a = turn * static_cast<float>(i) / 8.0F;
            ink.paint(Pigment::White, cover(disc(p, 0.088F * vec2(std::cos(a), std::sin(a)), 0.019F), edge));
        }
        break;
    default: // a rosette
        for (int i = 0; i < 8; ++i) {
            const float a = turn * static_cast<float>(i) / 8.0F;
            const vec2 along = {std::cos(a), std::sin(a)};
            ink.paint(i % 2 == 0 ? Pigment::White : Pigment::Red,
                      cover(leaf(p, 0.02F * along, 0.115F * along, 0.024F), edge));
        }
        ink.paint(Pigment::White, cover(disc(p, {0, 0}, 0.017F), edge));
        break;
    }
}

void paint_legs(Ink& ink, vec2 p, float edge) {
    const float back = std::min({limb(p, {-0.01F, 0.44F}, {-0.105F, 0.27F}, 0.068F, 0.040F),
                                 limb(p, {-0.115F, 0.275F}, {-0.17F, 0.17F}, 0.040F, 0.037F),
                                 limb(p, {-0.17F, 0.17F}, {-0.235F, 0.055F}, 0.036F, 0.017F),
                                 limb(p, {-0.235F, 0.05F}, {-0.165F, 0.012F}, 0.017F, 0.009F)});
    const float front = std::min({limb(p, {0.02F, 0.43F}, {0.13F, 0.29F}, 0.068F, 0.042F),
                                  limb(p, {0.13F, 0.28F}, {0.125F, 0.18F}, 0.039F, 0.037F),
                                  limb(p, {0.125F, 0.18F}, {0.14F, 0.035F}, 0.036F, 0.018F),
                                  limb(p, {0.135F, 0.022F}, {0.225F, 0.012F}, 0.018F, 0.009F)});
    silhouette(ink, Pigment::Slip, back, edge);
    silhouette(ink, Pigment::Slip, front, edge);
    // Greaves: their upper edges and a calf line.
    incise(ink, std::max(std::abs(p.y - 0.268F - 0.3F * (p.x - 0.13F)) - 0.001F, front), edge);
    incise(ink, std::max(std::abs(p.y - 0.258F + 0.45F * (p.x + 0.12F)) - 0.001F, back), edge);
    incise(ink, arc(p, {0.055F, 0.16F}, 0.085F, 0.002F, -0.7F, 0.6F), edge);
    incise(ink, arc(p, {-0.275F, 0.16F}, 0.095F, 0.002F, -0.4F, 0.5F), edge);
}

void paint_body(Ink& ink, vec2 p, float edge) {
    const std::array<vec2, 6> tunic = {{{-0.085F, 0.50F},
                                        {0.09F, 0.50F},
                                        {0.125F, 0.385F},
                                        {0.05F, 0.375F},
                                        {-0.03F, 0.365F},
                                        {-0.115F, 0.375F}}};
    const float skirt = polygon(p, tunic);
    const float chest = limb(p, {0.0F, 0.52F}, {0.0F, 0.68F}, 0.075F, 0.10F);
    silhouette(ink, Pigment::Slip, std::min(skirt, chest), edge);
    ink.paint(Pigment::Red, cover(std::max(skirt + 0.006F, 0.43F - p.y), edge));
    const float pleat = p.x * 40.0F;
    incise(ink, std::max(std::abs(pleat - std::round(pleat)) / 40.0F - 0.001F, std::max(skirt, p.y - 0.43F)),
           edge);
}

void paint_helmet(Ink& ink, vec2 p, float edge) {
    const vec2 head = {0.035F, 0.825F};
    const float neck = limb(p, {0.01F, 0.70F}, {0.025F, 0.80F}, 0.045F, 0.038F);
    const float skull = std::min(
        disc(p, head, 0.062F), limb(p, head + vec2(0.03F, 0.0F), head + vec2(0.05F, -0.065F), 0.03F, 0.014F));
    const float neck_guard =
        limb(p, head + vec2(-0.045F, -0.02F), head + vec2(-0.075F, -0.075F), 0.024F, 0.010F);
    silhouette(ink, Pigment::Slip, std::min({neck, skull, neck_guard}), edge);
    // The crest: a stilted arc from the brow to a tail down the back.
    const float crest =
        std::min(arc(p, head + vec2(-0.012F, -0.005F), 0.112F, 0.052F, 0.75F, 2.75F),
                 limb(p, head + vec2(-0.115F, 0.03F), head + vec2(-0.165F, -0.15F), 0.026F, 0.010F));
    silhouette(ink, Pigment::Slip, crest, edge);
    ink.paint(Pigment::Red, cover(crest + 0.012F, edge));
    const float teeth = std::atan2(p.y - head.y, p.x - head.x) * 12.0F;
    incise(ink, std::max(std::abs(teeth - std::round(teeth)) / 110.0F - 0.0005F, crest + 0.001F), edge);
    incise(ink, arc(p, head + vec2(-0.012F, -0.005F), 0.080F, 0.003F, 0.75F, 2.75F), edge);
    // Eye opening, nasal and cheek piece.
    ink.paint(Pigment::Ground,
              cover(leaf(p, head + vec2(0.008F, 0.003F), head + vec2(0.052F, 0.001F), 0.011F), edge));
    ink.paint(Pigment::Slip, cover(disc(p, head + vec2(0.031F, 0.002F), 0.006F), edge));
    incise(ink, arc(p, head + vec2(0.055F, -0.045F), 0.05F, 0.002F, 1.9F, 3.6F), edge);
}

void paint_shield(Ink& ink, vec2 p, int emblem, float edge) {
    const vec2 centre = {0.075F, 0.575F};
    const float rim = disc(p, centre, 0.175F);
    ink.paint(Pigment::Ground, cover(rim - 0.006F, edge)); // a halo separates the shield from the rest
    silhouette(ink, Pigment::Slip, rim, edge);
    ink.raise(0.9F, cover(rim + 0.012F, 0.03F));
    incise(ink, disc(p, centre, 0.150F), edge);
    incise(ink, disc(p, centre, 0.142F), edge);
    for (int i = 0; i < 28; ++i) {
        const float a = turn * static_cast<float>(i) / 28.0F;
        ink.paint(Pigment::White,
                  cover(disc(p, centre + 0.162F * vec2(std::cos(a), std::sin(a)), 0.0055F), edge));
    }
    paint_emblem(ink, p - centre, emblem, edge);
}

void paint_spear(Ink& ink, vec2 p, float edge) {
    const float arm = std::min(limb(p, {-0.05F, 0.68F}, {-0.165F, 0.735F}, 0.042F, 0.028F),
                               limb(p, {-0.165F, 0.735F}, {-0.115F, 0.855F}, 0.027F, 0.018F));
    silhouette(ink, Pigment::Slip, std::min(arm, disc(p, {-0.11F, 0.868F}, 0.023F)), edge);
    incise(ink, arc(p, {-0.16F, 0.745F}, 0.034F, 0.002F, -0.4F, 1.2F), edge);
    const vec2 butt = {-0.44F, 0.80F};
    const vec2 tip = {0.40F, 0.955F};
    const vec2 along = glm::normalize(tip - butt);
    silhouette(ink, Pigment::Slip, limb(p, butt, tip, 0.0065F, 0.0065F), edge);
    silhouette(ink, Pigment::Slip, leaf(p, tip - 0.03F * along, tip + 0.075F * along, 0.017F), edge);
}

} // namespace

void paint_hoplite(Ink& ink, glm::vec2 p, int emblem, float edge) {
    if (std::abs(p.x) > 0.55F || p.y < -0.05F || p.y > 1.1F) {
        return;
    }
    paint_spear(ink, p, edge);
    paint_legs(ink, p, edge);
    paint_body(ink, p, edge);
    paint_helmet(ink, p, edge);
    paint_shield(ink, p, emblem, edge);
}

void paint_deer(Ink& ink, glm::vec2 p, bool grazing, float edge) {
    if (std::abs(p.x) > 0.9F || p.y < -0.05F || p.y > 1.15F) {
        return;
    }
    const float trunk = std::min({limb(p, {-0.34F, 0.60F}, {0.05F, 0.58F}, 0.135F, 0.115F),
                                  limb(p, {0.05F, 0.58F}, {0.30F, 0.62F}, 0.115F, 0.145F)});
    const float hind = std::min({limb(p, {-0.37F, 0.58F}, {-0.37F, 0.40F}, 0.11F, 0.045F),
                                 limb(p, {-0.37F, 0.40F}, {-0.44F, 0.26F}, 0.042F, 0.024F),
                                 limb(p, {-0.44F, 0.26F}, {-0.40F, 0.04F}, 0.024F, 0.018F),
                                 limb(p, {-0.31F, 0.50F}, {-0.24F, 0.30F}, 0.07F, 0.026F),
                                 limb(p, {-0.24F, 0.30F}, {-0.27F, 0.04F}, 0.024F, 0.018F)});
    const float fore = std::min({limb(p, {0.32F, 0.56F}, {0.36F, 0.30F}, 0.085F, 0.028F),
                                 limb(p, {0.36F, 0.30F}, {0.33F, 0.04F}, 0.026F, 0.018F),
                                 limb(p, {0.27F, 0.54F}, {0.20F, 0.30F}, 0.075F, 0.026F),
                                 limb(p, {0.20F, 0.30F}, {0.22F, 0.04F}, 0.024F, 0.018F)});
    const float hooves = std::min({limb(p, {-0.41F, 0.03F}, {-0.37F, 0.018F}, 0.022F, 0.012F),
                                   limb(p, {-0.28F, 0.03F}, {-0.24F, 0.018F}, 0.022F, 0.012F),
                                   limb(p, {0.33F, 0.03F}, {0.37F, 0.018F}, 0.022F, 0.012F),
                                   limb(p, {0.22F, 0.03F}, {0.26F, 0.018F}, 0.022F, 0.012F)});
    const vec2 poll = grazing ? vec2(0.60F, 0.26F) : vec2(0.50F, 0.93F); // top of the head
    const vec2 muzzle = grazing ? vec2(0.64F, 0.09F) : vec2(0.66F, 0.86F);
    const float head =
        std::min({limb(p, {0.34F, 0.66F}, poll, 0.12F, 0.05F), limb(p, poll, muzzle, 0.055F, 0.028F),
                  leaf(p, poll, poll + vec2(-0.10F, grazing ? 0.07F : 0.03F), 0.022F)});
    const float tail = leaf(p, {-0.46F, 0.66F}, {-0.54F, 0.52F}, 0.026F);
    silhouette(ink, Pigment::Slip, std::min({trunk, hind, fore, hooves, head, tail}), edge);
    // Antlers sweep back.
    const vec2 back = grazing ? vec2(0.20F, 0.16F) : vec2(-0.16F, 0.18F);
    float antlers = limb(p, poll, poll + back, 0.016F, 0.012F);
    for (int i = 1; i <= 3; ++i) {
        const vec2 root = poll + back * (static_cast<float>(i) / 3.0F);
        antlers = std::min(antlers, limb(p, root, root + (grazing ? vec2(0.03F, 0.09F) : vec2(0.045F, 0.09F)),
                                         0.012F, 0.008F));
    }
    silhouette(ink, Pigment::Slip, antlers, edge);
    // Red neck, white belly line, shoulder and haunch.
    ink.paint(Pigment::Red, cover(std::max(limb(p, {0.36F, 0.66F}, glm::mix(vec2(0.34F, 0.66F), poll, 0.62F),
                                                0.085F, 0.05F),
                                           head),
                                  edge));
    for (int i = 0; i < 6; ++i) {
        ink.paint(Pigment::White, cover(disc(p,
                                             {-0.27F + 0.085F * static_cast<float>(i),
                                              0.515F + 0.01F * std::abs(static_cast<float>(i) - 2.0F)},
                                             0.013F),
                                        edge));
    }
    incise(ink, std::max(arc(p, {0.20F, 0.60F}, 0.13F, 0.002F, -1.2F, 1.0F), trunk), edge);
    incise(ink, std::max(arc(p, {-0.44F, 0.58F}, 0.16F, 0.002F, -1.0F, 0.9F), trunk), edge);
    ink.paint(Pigment::Ground,
              cover(disc(p, poll + (grazing ? vec2(0.012F, -0.03F) : vec2(0.025F, 0.0F)), 0.013F), edge));
}

void paint_handle_ornament(Ink& ink, glm::vec2 p, float edge) {
    if (std::abs(p.x) > 0.5F || p.y < -0.05F || p.y > 1.1F) {
        return;
    }
    const vec2 half = {std::abs(p.x), p.y};
    paint_palmette(ink, p - vec2(0.0F, 0.50F), 0.46F, edge);
    paint_palmette(ink, vec2(p.x, 0.42F - p.y), 0.40F, edge);
    // Two spirals a side, joined by a stem.
    const float upper = spiral({half.x - 0.255F, half.y - 0.56F}, 0.115F, 2.25F);
    const float lower = spiral({half.x - 0.25F, 0.36F - half.y}, 0.105F, 2.25F);
    const float stem = limb(half, {0.0F, 0.46F}, {0.17F, 0.46F}, 0.010F, 0.012F);
    const float lines = std::min({upper, lower, stem}) - 0.011F;
    silhouette(ink, Pigment::Slip, lines, edge);
    silhouette(ink, Pigment::Slip, leaf(half, {0.26F, 0.45F}, {0.40F, 0.47F}, 0.03F), edge);
    silhouette(ink, Pigment::Slip, leaf(half, {0.31F, 0.70F}, {0.35F, 0.96F}, 0.045F), edge);
    silhouette(ink, Pigment::Slip, leaf(half, {0.28F, 0.24F}, {0.33F, 0.01F}, 0.040F), edge);
}

} // namespace frustumscreen::artifacts
