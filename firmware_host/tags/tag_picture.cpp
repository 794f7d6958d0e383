#include "firmware_host/tags/tag_picture.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <memory>

namespace frustumscreen::tags {

TagModules tag_modules_of(int id) {
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                  tag36h11_destroy);
    constexpr std::size_t margin = (tag_modules - black_modules) / 2;
    TagModules modules{};
    modules.front().fill(true);
    modules.back().fill(true);
    for (auto& row : modules) {
        row.front() = row.back() = true;
    }
    // The code's first bit is its most significant one.
    for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
        const std::size_t row = margin + family->bit_y[bit];
        const std::size_t column = margin + family->bit_x[bit];
        modules[row][column] = (family->codes[id] >> (family->nbits - 1 - bit) & 1U) != 0;
    }
    return modules;
}

} // namespace frustumscreen::tags
