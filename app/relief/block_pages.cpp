#include "app/relief/block_pages.h"

#include <cmath>

namespace frustumscreen::relief {

void BlockPages::clear() {
    pages_.clear();
    lights_.clear();
    only_ = nullptr;
    changes_light_ = false;
}

std::uint32_t BlockPages::add(const BlockRelief& relief, const glm::vec3& light,
                              const std::vector<glm::u8vec4>* colours) {
    const auto first = static_cast<std::uint32_t>(pages_.size()) * blocks_of_page;
    const auto number = static_cast<std::uint32_t>(lights_.size());
    constexpr std::size_t colours_of_block = std::size_t{block_corners} * block_corners;
    const glm::u8vec4* const of_block = colours != nullptr ? colours->data() : relief.colours.data();
    for (std::size_t block = 0; block < relief.blocks.size(); block += blocks_of_page) {
        pages_.push_back({of_block + block * colours_of_block, number});
    }
    lights_.push_back({light, glm::pow(light, glm::vec3(1.0F / 2.4F))});
    changes_light_ = changes_light_ || light != glm::vec3(1.0F);
    only_ = number == 0 && !changes_light_ && colours == nullptr ? &relief : nullptr;
    return first;
}

} // namespace frustumscreen::relief
