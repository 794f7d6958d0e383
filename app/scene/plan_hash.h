/// A number for a plan's picture.
///
/// Threads  pure; any. Allocates nothing.
/// Method   FNV-1a over 64-bit words.
#pragma once

#include "app/scene/frame_plan.h"

#include <cstdint>

namespace frustumscreen {

/// The number is equal for equal pictures of one renderer; it is FramePlan::hash.
[[nodiscard]] std::uint64_t hash_of(const FramePlan& plan);
/// The same for what stands in the prop; it is FramePlan::prop_hash.
[[nodiscard]] std::uint64_t hash_of_prop(const FramePlan& plan);
/// The same for one draw.
[[nodiscard]] std::uint64_t hash_of(const Draw& draw);

} // namespace frustumscreen
