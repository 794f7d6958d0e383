/// The caption of the artifact on show: its place on the table, its light, and the portion of a description in it.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: a caption without space is not shown.
#pragma once

#include "app/exhibit/catalogue.h"
#include "app/exhibit/narrator.h"
#include "app/exhibit/presentation.h"
#include "app/typography/captions.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

class ArtifactCaption {
public:
    explicit ArtifactCaption(std::span<const glm::dvec2> picture_m) : placer_(picture_m) {}

    struct Input {
        const CatalogueEntry& entry; ///< kept by the caller until another caption is shown
        std::size_t language = 0;    ///< of the entry
        CaptionText text;
        double light = 1.0;              ///< of artifact and language: 0..1, a factor on linear light
        SentenceEnvironment environment; ///< `around`: the prop's shadow
    };
    [[nodiscard]] std::optional<PresentedCaption> step(MonotonicTime now, const Input& input);
    /// Sets the other rectangles on the table.
    void set_obstacles(std::span<const typography::TableRectangle> obstacles) {
        placer_.set_obstacles(obstacles);
    }
    /// 0: the caption has no place. 0..1
    [[nodiscard]] double opacity(MonotonicTime now) const { return placer_.at(now).opacity; }

    /// Its place, also while it is still dark; without size: none.
    [[nodiscard]] typography::TableRectangle place(MonotonicTime now) const {
        return placer_.at(now).rectangle;
    }

private:
    typography::CaptionPlacer placer_;
    const std::vector<glm::dvec2>* placed_ = nullptr; ///< the sizes that `placer_` has been given
};

} // namespace frustumscreen::exhibit
