/// A torch's content as data: stages that are laid over each other, each a picture, a film, a layer of the artifact or
/// an effect, which scrolls, turns and pulses. A pack holds no program.
///
/// Frames   content: torch.h. A stage's own frame is the content's, scrolled and turned about its middle.
/// Units    seconds since the torch began to throw the content; colours in linear light.
/// Threads  values; any. `stage_at` allocates nothing.
/// Source   Francken 2007, 3: the stages of the shading language, here as parameters.
#pragma once

#include "app/torch/torch.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::torch {

inline constexpr std::size_t max_stages = 3; ///< of a content

enum class Source : std::uint8_t {
    Plain,   ///< light of one colour
    Picture, ///< a picture of the pack; outside it there is no light
    Film,    ///< as a picture, frame by frame
    Layer,   ///< the artifact's own surface with another texture
    Ring,    ///< a circle: `size` is its diameter, `width` that of its line, shares of the content's width
    Grid,    ///< lines every `size`, `width` wide, shares of the content's width
    Ruler, ///< a scale across the beam: marks of 1, 5 and 10 mm where a pixel can show them, at its true size on the surface
    Lens,  ///< the surface as the torch sees it, `magnification` times as large, in a disc of diameter `size`
};
inline constexpr std::array<std::string_view, 8> source_names{"plain", "picture", "film",  "layer",
                                                              "ring",  "grid",    "ruler", "lens"};
/// How a stage joins those before it. Over: covers them by its opacity. Multiply, Add: of their light.
enum class Mix : std::uint8_t { Over, Multiply, Add };
inline constexpr std::array<std::string_view, 3> mix_names{"over", "multiply", "add"};
/// How the content joins the surface. Light: it is added as light on the surface's own colours. Over: it replaces the
/// surface's colour by its opacity, as a layer does.
enum class Blend : std::uint8_t { Light, Over };
inline constexpr std::array<std::string_view, 2> blend_names{"light", "over"};

struct Stage {
    Source source = Source::Plain;
    Mix mix = Mix::Over;
    std::uint32_t item = 0; ///< of the pack's pictures, films or layers
    glm::vec3 colour{1.0F}; ///< of plain light and effects; a factor of the others
    double opacity = 1.0;   ///< 0..1
    double size = 0.5, width = 0.02;
    double magnification = 2.0;
    glm::dvec2 scroll_per_s{0.0}; ///< shares of the content's width and height
    double turn_rad_per_s = 0.0;  ///< clockwise as the content is seen
    double pulse_hz = 0.0;        ///< of the opacity
    double pulse_depth = 0.0;     ///< 0..1: share by which the opacity drops

    [[nodiscard]] bool operator==(const Stage&) const = default;
};

struct Content {
    std::string name; ///< unique in its pack
    Blend blend = Blend::Light;
    std::vector<Stage> stages; ///< 1 to max_stages
    /// The shape of the beam; nullopt: the torch's own. The height follows a picture's shape.
    std::optional<Shape> shape = std::nullopt;
    double height_per_width = 1.0;

    [[nodiscard]] bool operator==(const Content&) const = default;
};

/// Bits: the parts needed to draw a content; a shader leaves the others out.
enum ContentPart : std::uint8_t {
    PicturePart = 1,
    LayerPart = 2,
    EffectPart = 4,
    LensPart = 8,
    SeveralPart = 16, ///< more stages than one
    OverPart = 32,    ///< Blend::Over
    BarePart = 64,    ///< no shadows: only to measure their cost
};
/// All parts but the blending: any content is drawn with it, or with it and OverPart.
inline constexpr std::uint8_t all_parts = 31;
[[nodiscard]] std::uint8_t parts_of(std::span<const Stage> stages, Blend blend);

/// `--torch white`: plain light, which every artifact has.
[[nodiscard]] Content white();
inline constexpr std::string_view white_name = "white";

/// A stage at one time.
struct StageAt {
    glm::mat3x2 stage_from_content{1.0F}; ///< takes (x, y, 1)
    float opacity = 1.0F;
};
[[nodiscard]] StageAt stage_at(const Stage& stage, double height_per_width, double seconds);

} // namespace frustumscreen::torch
