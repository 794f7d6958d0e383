/// Makes the patches of a multi-LDI as block reliefs, a little at a time: first the one that is looked at.
///
/// Frames   window (triangle_world.h). Units: metres.
/// Time     none: a step is a count of triangles. 20,000 take some 5 ms on one core of the kiosk; a row of blocks, the
///          least piece of work, about as long.
/// Threads  one at a time: a worker of the caller's. Its results may be read by any.
/// Memory   the patches; one patch that is being made (`PatchLimits::max_bytes`); a number a pixel for each of 29 cameras.
/// Errors   none.
#pragma once

#include "app/ldi/patch_order.h"
#include "app/ldi/patch_relief.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace frustumscreen::ldi {

class PatchMaker {
public:
    PatchMaker(std::shared_ptr<const TriangleWorld> world, const Hemisphere& hemisphere,
               const PatchLimits& limits);
    PatchMaker(const PatchMaker&) = delete;
    PatchMaker& operator=(const PatchMaker&) = delete;

    /// Puts the patch of this eye first, then the others by their angle from it. If the eye's patch is not made yet, another one
    /// that is being made is given up; its cameras' pictures stay.
    void look_from(const glm::dvec3& eye);
    /// Does a piece of work: about `triangles` triangles. False once all patches are made.
    bool step(std::size_t triangles = 20'000);

    /// Null before it is made.
    [[nodiscard]] std::shared_ptr<const PatchRelief> patch(std::size_t number) const {
        return patches_[number];
    }
    [[nodiscard]] std::size_t made_count() const;
    [[nodiscard]] const Hemisphere& hemisphere() const { return order_.hemisphere(); }
    /// Memory of all that it holds, with patches that are still in use elsewhere and without the world.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    [[nodiscard]] std::optional<std::size_t> next_patch() const;

    std::shared_ptr<const TriangleWorld> world_;
    PatchOrder order_;
    PatchLimits limits_;
    CameraViews views_;
    std::array<std::shared_ptr<const PatchRelief>, patch_count> patches_;
    std::optional<PatchBuild> build_;
    std::size_t building_ = 0;
};

} // namespace frustumscreen::ldi
