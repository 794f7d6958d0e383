/// The reliefs of one set of samples: their blocks are numbered one relief after the other, each relief from a whole
/// page on.
///
/// Threads  const; any. `add` allocates nothing once as many blocks have been added.
#pragma once

#include "app/relief/block_relief.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace frustumscreen::relief {

/// Factors of a relief's light, for linear light and for codes: to the power of 1 / 2.4.
struct BlockLight {
    glm::vec3 linear{1.0F}, code{1.0F};
};

class BlockPages {
public:
    static constexpr std::uint32_t blocks_of_page = 1024;
    struct Page {
        const glm::u8vec4* colours = nullptr; ///< of the page's first block
        std::uint32_t relief = 0;             ///< index into `lights`
    };

    void clear();
    /// Returns the number of the relief's first block. `light`: 0..1, linear; each channel of the colours is multiplied.
    /// `colours`: others, in the order of the relief's own; null: those.
    std::uint32_t add(const BlockRelief& relief, const glm::vec3& light = glm::vec3(1.0F),
                      const std::vector<glm::u8vec4>* colours = nullptr);

    /// The relief if it is the only one and keeps its colours and light; its blocks have their own numbers. Otherwise null.
    [[nodiscard]] const BlockRelief* only() const { return only_; }
    /// True if some relief's light is not 1.
    [[nodiscard]] bool changes_light() const { return changes_light_; }
    [[nodiscard]] const std::vector<Page>& pages() const { return pages_; }
    [[nodiscard]] const std::vector<BlockLight>& lights() const { return lights_; }

private:
    std::vector<Page> pages_;
    std::vector<BlockLight> lights_; ///< of each relief
    const BlockRelief* only_ = nullptr;
    bool changes_light_ = false;
};

} // namespace frustumscreen::relief
