#include "app/torch/content.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::torch {

namespace {

/// After which a stage repeats itself, shares of the content's width and height; 0: never. `size`: the content's, in widths.
glm::dvec2 period_of(const Stage& stage, const glm::dvec2& size) {
    switch (stage.source) {
    case Source::Picture:
    case Source::Film:
        return glm::dvec2(1.0);
    case Source::Grid:
        return stage.size / size;
    case Source::Plain:
    case Source::Layer:
    case Source::Ring:
    case Source::Ruler:
    case Source::Lens:
        break;
    }
    return glm::dvec2(0.0);
}

} // namespace

std::uint8_t parts_of(std::span<const Stage> stages, Blend blend) {
    constexpr std::array<std::uint8_t, source_names.size()> of_source{
        0, PicturePart, PicturePart, LayerPart, EffectPart, EffectPart, EffectPart, LensPart};
    unsigned parts = stages.size() > 1 ? unsigned{SeveralPart} : 0U;
    parts |= blend == Blend::Over ? unsigned{OverPart} : 0U;
    for (const Stage& stage : stages) {
        parts |= of_source[static_cast<std::size_t>(stage.source)];
    }
    return static_cast<std::uint8_t>(parts);
}

Content white() {
    return {.name = std::string(white_name), .blend = Blend::Light, .stages = {Stage{}}};
}

StageAt stage_at(const Stage& stage, double height_per_width, double seconds) {
    // In units of the width, so that a turn keeps right angles.
    const glm::dvec2 size(1.0, height_per_width);
    const double turn = -stage.turn_rad_per_s * seconds;
    const glm::dmat2 turned(std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn)); // columns
    const glm::dmat2 linear(turned[0] * size.x / size, turned[1] * size.y / size);
    const glm::dvec2 middle(0.5);
    // A whole number of periods changes nothing that repeats, and keeps the numbers small.
    const glm::dvec2 scrolled = stage.scroll_per_s * seconds;
    const glm::dvec2 period = period_of(stage, size);
    const bool repeats = period.x > 0.0 && period.y > 0.0;
    const glm::dvec2 offset =
        middle - linear * middle - (repeats ? scrolled - period * glm::floor(scrolled / period) : scrolled);
    const double wave = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * stage.pulse_hz * seconds);
    return {.stage_from_content = glm::mat3x2(glm::dmat3x2(linear[0], linear[1], offset)),
            .opacity = static_cast<float>(stage.opacity * (1.0 - stage.pulse_depth * wave))};
}

} // namespace frustumscreen::torch
