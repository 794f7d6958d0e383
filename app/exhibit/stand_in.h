/// The picture of an artifact that is not there yet: it grows from its place on the table into the prop's place, and
/// stays until the artifact fades in. Where the table shows no pictures it grows from nothing.
///
/// One picture stands in at a time: when another is wanted, the first fades out before that one begins.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/exhibit/captions.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>

namespace frustumscreen {

struct PresentedStandIn {
    std::size_t artifact = 0; ///< whose PackCard::table_picture it is
    TableRectangle rectangle; ///< square
    double brightness = 0.0;  ///< above 0, up to 1; a factor on linear light
};

class StandIn {
public:
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(250); ///< of its fade
    static constexpr Nanoseconds growing = std::chrono::milliseconds(500);

    struct Input {
        std::optional<std::size_t> artifact; ///< whose picture is wanted
        std::optional<TableRectangle> from;  ///< where that lies on the table
        TableRectangle to;                   ///< the prop's place
    };
    /// Nothing while it is dark.
    [[nodiscard]] std::optional<PresentedStandIn> step(MonotonicTime now, const Input& input);
    /// That it stands in for, or fades out of.
    [[nodiscard]] std::optional<std::size_t> artifact() const { return artifact_; }

private:
    std::optional<std::size_t> artifact_;
    TableRectangle from_;
    MonotonicTime since_; ///< it began to grow
    MonotonicTime last_;
    double presence_ = 0.0; ///< 0 = dark
};

} // namespace frustumscreen
