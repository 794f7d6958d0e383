#include "app/torch/content.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::torch {

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
    // A whole number of widths changes nothing that repeats, and keeps the numbers small.
    const glm::dvec2 scrolled = stage.scroll_per_s * seconds;
    const bool repeats =
        stage.source == Source::Grid || stage.source == Source::Picture || stage.source == Source::Film;
    const glm::dvec2 offset =
        middle - linear * middle - (repeats ? scrolled - glm::floor(scrolled) : scrolled);
    const double wave = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * stage.pulse_hz * seconds);
    return {.stage_from_content = glm::mat3x2(glm::dmat3x2(linear[0], linear[1], offset)),
            .opacity = static_cast<float>(stage.opacity * (1.0 - stage.pulse_depth * wave))};
}

} // namespace frustumscreen::torch
