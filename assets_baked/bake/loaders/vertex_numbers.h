/// Numbers for different vertices, in the order in which they are met; less memory than a map.
///
/// Threads  one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

class VertexNumbers {
public:
    /// The key of a vertex: the file's numbers of its position, texture coordinate and normal, or bits of its position.
    using Key = std::array<std::uint32_t, 3>;

    VertexNumbers();
    struct Found {
        std::uint32_t number = 0;
        bool is_new = false;
    };
    /// The key's number; a new key takes the next one, from 0 on.
    [[nodiscard]] Found number_of(const Key& key);

private:
    [[nodiscard]] std::size_t slot_of(const Key& key) const;
    void grow();

    std::vector<Key> keys_;            ///< by number
    std::vector<std::uint32_t> slots_; ///< numbers; open addressing, the size is a power of two
};

} // namespace frustumscreen::bake
