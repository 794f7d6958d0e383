#include "assets_baked/bake/cell_numbers.h"

#include <bit>
#include <utility>

namespace frustumscreen::bake {

namespace {
constexpr std::uint64_t empty = 0xFFFFFFFFFFFFFFFFU;
constexpr std::size_t min_slots = 1024;
} // namespace

CellNumbers::CellNumbers() : keys_(min_slots, empty), numbers_(min_slots, none) {}

std::size_t CellNumbers::slot_of(std::uint64_t key) const {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15U; // 2^64 / golden ratio
    const auto bits = static_cast<unsigned>(std::countr_zero(keys_.size()));
    auto slot = static_cast<std::size_t>((key * odd) >> (64U - bits));
    while (keys_[slot] != key && keys_[slot] != empty) {
        slot = (slot + 1) & (keys_.size() - 1);
    }
    return slot;
}

std::uint32_t CellNumbers::number_of(std::uint64_t key) {
    std::size_t slot = slot_of(key);
    if (keys_[slot] == empty) {
        if (2 * (count_ + 1) > keys_.size()) {
            grow();
            slot = slot_of(key);
        }
        keys_[slot] = key;
        numbers_[slot] = static_cast<std::uint32_t>(count_++);
    }
    return numbers_[slot];
}

void CellNumbers::grow() {
    const std::vector<std::uint64_t> keys = std::exchange(keys_, std::vector(2 * keys_.size(), empty));
    const std::vector<std::uint32_t> numbers =
        std::exchange(numbers_, std::vector<std::uint32_t>(keys_.size(), none));
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (keys[k] != empty) {
            const std::size_t slot = slot_of(keys[k]);
            keys_[slot] = keys[k];
            numbers_[slot] = numbers[k];
        }
    }
}

} // namespace frustumscreen::bake
