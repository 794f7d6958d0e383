/// How an artifact comes that may not be there yet. While it is not, its picture stands in for it: it grows from its place
/// on the table into the prop's place, or from nothing where the table shows no pictures, and the artifact fades into it.
///
/// Light    the old artifact fades into the picture, and the picture into the new one; nothing is dark in between. Where
///          a picture fades out itself, the next one comes after it. So however often something else is chosen, one
///          change (selection.h) makes the light of the prop's place go down and up no more than once and a half.
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

namespace frustumscreen {

struct PresentedStandIn {
    std::size_t artifact = 0; ///< whose PackCard::table_picture it is
    TableRectangle rectangle; ///< square
    double brightness = 0.0;  ///< above 0, up to 1; a factor on linear light
};

class Placeholder {
public:
    static constexpr Nanoseconds growing = std::chrono::milliseconds(500);

    struct Input {
        Shown shown;
        std::size_t chosen = 0; ///< what is shown, or will be
        bool shown_ready = true, chosen_ready = true;
        std::optional<TableRectangle> from; ///< where the chosen one's picture lies on the table
        TableRectangle to;                  ///< the prop's place
    };
    struct Output {
        double brightness = 1.0; ///< of the artifact that is shown, 0..1
        std::optional<PresentedStandIn> picture;
        bool waits = false; ///< something is still to come, or fades
    };
    [[nodiscard]] Output step(MonotonicTime now, const Input& input);

private:
    void begin(std::size_t artifact, MonotonicTime now, const Input& input);
    [[nodiscard]] double light(const Input& input, double artifact) const;

    std::optional<std::size_t> shown_; ///< at the latest step
    bool leaving_ = false;             ///< it faded out then
    double arrival_ = 1.0;             ///< of its way into the picture, 0..1
    MonotonicTime last_;
    std::optional<std::size_t> picture_; ///< of this artifact; none: nothing stands in
    bool replaces_ = false; ///< the picture, of the artifact before: it came as that one faded out
    TableRectangle from_;
    MonotonicTime since_; ///< it began to grow
};

} // namespace frustumscreen
