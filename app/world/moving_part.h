/// One part of one cell that curves move: its translation, rotation, scale or light.
///
/// It follows a curve, or returns to rest. A change begins where the part is and takes `return_s`; a part at rest has
/// the value of a curve that begins at once, as the curve's author sees it.
///
/// Values   as curve.h.
/// Time     `now` is a parameter; every answer is a closed form of the time since the last change.
/// Threads  values; one caller. Nothing allocates.
#pragma once

#include "app/world/behaviour.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>

namespace frustumscreen::world {

/// How long a part takes from where it is to rest, or to another curve.
inline constexpr double return_s = 0.6;

/// The motion that a part follows. The caller owns both; they outlive the part.
struct Driver {
    const Behaviour* behaviour = nullptr;
    const Channel* channel = nullptr;
    MonotonicTime began; ///< when the behaviour's run began
};

class MovingPart {
public:
    MovingPart(std::size_t cell, Path path, const glm::dvec4& rest)
        : cell_(cell), path_(path), rest_(rest), from_(rest) {}

    /// Follows another driver from `now` on; none: returns to rest.
    void follow(const std::optional<Driver>& driver, MonotonicTime now);
    [[nodiscard]] bool follows(const Behaviour& behaviour) const {
        return driver_ && driver_->behaviour == &behaviour;
    }

    [[nodiscard]] glm::dvec4 at(MonotonicTime now) const;
    [[nodiscard]] bool at_rest(MonotonicTime now) const;
    [[nodiscard]] std::size_t cell() const { return cell_; }
    [[nodiscard]] Path path() const { return path_; }

private:
    [[nodiscard]] glm::dvec4 target(MonotonicTime now) const;

    std::size_t cell_;
    Path path_;
    glm::dvec4 rest_;
    std::optional<Driver> driver_;
    glm::dvec4 from_; ///< where the part was at the last change
    MonotonicTime changed_;
    bool blends_ = false; ///< the last change takes `return_s`
};

} // namespace frustumscreen::world
