/// Placeholder of an artifact that is not ready. Its picture grows from its place on the table into the prop's place,
/// or from nothing if the table shows no pictures, and the artifact fades into it.
///
/// Light    the old artifact fades into the picture, and the picture into the new one; nothing is dark in between. If
///          a picture fades out itself, the next one comes after it. However often another artifact is chosen, one
///          change (selection.h) makes the light of the prop's place fall and rise at most one and a half times.
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/exhibit/selection.h"
#include "app/typography/captions.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>

namespace frustumscreen::exhibit {

struct PresentedPlaceholder {
    std::size_t artifact = 0;             ///< whose PackCard::table_picture it is
    typography::TableRectangle rectangle; ///< square
    double brightness = 0.0;              ///< above 0, up to 1; a factor on linear light
};

class Placeholder {
public:
    static constexpr Nanoseconds growing = std::chrono::milliseconds(500);

    struct Input {
        Shown shown;
        std::size_t chosen = 0; ///< shown, or to be shown
        bool shown_ready = true, chosen_ready = true;
        std::optional<typography::TableRectangle> from; ///< place of the chosen one's picture on the table
        typography::TableRectangle to;                  ///< the prop's place
    };
    struct Output {
        double brightness = 1.0; ///< of the artifact that is shown, 0..1
        std::optional<PresentedPlaceholder> picture;
    };
    [[nodiscard]] Output step(MonotonicTime now, const Input& input);
    /// True if, as of the latest `step`, an artifact is not ready, or fades.
    [[nodiscard]] bool waits() const { return picture_.has_value() || arrival_ < 1.0; }

private:
    void begin(std::size_t artifact, MonotonicTime now, const Input& input);
    [[nodiscard]] double light(const Input& input, double artifact) const;

    std::optional<std::size_t> shown_; ///< at the latest step
    bool leaving_ = false;             ///< in that step it faded out
    double arrival_ = 1.0;             ///< progress of its fade into the picture, 0..1
    MonotonicTime last_;
    std::optional<std::size_t> picture_; ///< the artifact whose picture stands in; none: no picture does
    bool replaces_ = false; ///< the picture came as the artifact before faded out, and replaces that
    typography::TableRectangle from_;
    MonotonicTime since_; ///< when it began to grow
};

} // namespace frustumscreen::exhibit
