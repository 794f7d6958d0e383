/// Numbers for the cells of a grid that hold something, in the order in which they are met; less memory than a map.
///
/// Threads  one writer; any number of readers without a writer.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen {

class CellNumbers {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFFU;

    CellNumbers();
    /// The key's number; a new key takes the next one, from 0 on. No key has all bits set.
    [[nodiscard]] std::uint32_t number_of(std::uint64_t key);
    /// `none` for a key without a number.
    [[nodiscard]] std::uint32_t find(std::uint64_t key) const { return numbers_[slot_of(key)]; }
    [[nodiscard]] std::size_t size() const { return count_; }

private:
    [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
    void grow();

    std::vector<std::uint64_t> keys_; ///< open addressing; the size is a power of two
    std::vector<std::uint32_t> numbers_;
    std::size_t count_ = 0;
};

/// The most cells along an axis of a grid whose cells have keys.
inline constexpr std::int64_t max_cells_along = std::int64_t{1} << 21U;
/// `cell` within 0..max_cells_along - 1 along each axis.
[[nodiscard]] inline std::uint64_t key_of(const glm::i64vec3& cell) {
    const glm::u64vec3 c(cell);
    return c.x << 42U | c.y << 21U | c.z;
}

} // namespace frustumscreen
