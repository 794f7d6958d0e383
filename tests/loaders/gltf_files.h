/// Small exact glTF files with nodes and animations.
#pragma once

#include "tests/loaders/loaders_testing.h"

#include <string>
#include <vector>

namespace frustumscreen::testing {

/// An accessor's numbers.
struct Numbers {
    std::string bytes;
    std::size_t count = 0;
    std::string form; ///< type and componentType of the accessor
};
Numbers times(const std::vector<float>& values);
Numbers vectors(const std::vector<float>& values);
Numbers rotations(const std::vector<float>& values);

/// A file with one mesh: a triangle with corners at 0, x, y. Accessor 0 has its positions, 1, 2, ... are `numbers`.
std::string file_with(const std::string& nodes, const std::string& more = "",
                      const std::vector<Numbers>& numbers = {});
/// One animation with one sampler, of accessors 1 and 2, and one channel.
std::string animation(int node, const char* path, const char* interpolation = "LINEAR",
                      const char* name = "turn");
/// A member of the file, after a comma.
std::string animations(const std::string& list);

} // namespace frustumscreen::testing
