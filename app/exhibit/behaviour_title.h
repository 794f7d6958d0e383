/// The line that says what the button does now: the title of the behaviour that the next press triggers, beside the
/// prop, in the visitor's language. While a torch is held, it is the title of the torch's content. A title fades in at the
/// best place, and fades out before the next one.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: a title without space is not shown.
#pragma once

#include "app/exhibit/sentences.h"
#include "app/typography/captions.h"

#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// A title of one artifact in one language.
struct TitleIndex {
    std::size_t artifact = 0;  ///< index into the catalogue
    std::size_t behaviour = 0; ///< index into CatalogueEntry::behaviours, and beyond them into the contents
    std::size_t language = 0;  ///< index into CatalogueEntry::languages
    [[nodiscard]] bool operator==(const TitleIndex&) const = default;
};
struct PresentedTitle {
    TitleIndex title;
    typography::TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
};

class BehaviourTitle {
public:
    explicit BehaviourTitle(std::span<const glm::dvec2> picture_m) : placer_(picture_m) {}

    struct Input {
        std::optional<TitleIndex> title; ///< none: none is to be shown
        glm::dvec2 size_m{0.0};          ///< of `title`
        double light = 1.0;              ///< of the artifact and its texts: 0..1, a factor on linear light
        SentenceEnvironment environment;
        std::span<const typography::TableRectangle> obstacles; ///< everything else on the table
    };
    [[nodiscard]] std::optional<PresentedTitle> step(MonotonicTime now, const Input& input);
    /// True if a title is or will be shown: `step` uses its surroundings.
    [[nodiscard]] bool has_title() const { return placed_.has_value(); }
    /// True while its brightness changes by itself.
    [[nodiscard]] bool changing() const { return changing_; }

private:
    typography::CaptionPlacer placer_;
    std::optional<TitleIndex> placed_; ///< the title that has a place in `placer_`
    double share_ = 0.0;               ///< of its light; falls while another title is wanted
    MonotonicTime last_;
    bool changing_ = false;
};

} // namespace frustumscreen::exhibit
