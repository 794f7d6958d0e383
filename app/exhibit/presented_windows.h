/// The windows that lie on the table, as plain values: each keeps what was seen through the prop when it was pinned, or a
/// state of the artifact in the same view.
///
/// Frames   table T, metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/settings.h"
#include "app/typography/captions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

struct PresentedWindow {
    std::uint32_t number = 0; ///< counted from 1 on; no two windows have the same one
    std::size_t artifact = 0; ///< index into the catalogue
    /// How often it came to a new place. At each new place its view is aimed at the eye that pinned it; a push moves it unchanged.
    std::uint32_t comings = 0;
    /// Its place, turned to its visitor's side.
    typography::TableRectangle rectangle;
    glm::dvec3 eye_m{0.0};                    ///< when it was pinned
    geometry::RigidTransform table_from_prop; ///< when it was pinned
    std::optional<std::size_t> state{};       ///< of the artifact; none: as the prop showed it
    bool live = false;                        ///< behaviours go on in it while its artifact is on show
    /// Through the lens: turned about the prop's axis, and a factor of its size. A new one counts as a new place.
    double turn_rad = 0.0, zoom = 1.0;
    bool follows = false; ///< the lens is on it: both change from step to step, and `comings` stays
    /// The state's title, in a language by index into CatalogueEntry::languages; without height there is none.
    typography::TableRectangle title{};
    std::size_t language = 0;
    double brightness = 0.0; ///< 0..1, a factor on linear light; 0: pinned, and not shown yet
};

/// Oldest first.
class PresentedWindows {
public:
    [[nodiscard]] std::span<const PresentedWindow> windows() const {
        return std::span(windows_).first(count_);
    }
    [[nodiscard]] std::span<PresentedWindow> windows() { return std::span(windows_).first(count_); }
    void add(const PresentedWindow& window) { windows_.at(count_++) = window; }
    void dim(double share) {
        for (PresentedWindow& window : std::span(windows_).first(count_)) {
            window.brightness *= share;
        }
    }

private:
    /// One more than the settings allow: a new window waits until the oldest has gone.
    std::array<PresentedWindow, settings::max_windows + 1> windows_{};
    std::size_t count_ = 0;
};

} // namespace frustumscreen::exhibit
