#include "assets_baked/bake/loaders/vertex_numbers.h"

namespace frustumscreen::bake {

namespace {
constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr std::size_t min_slots = 1024;
} // namespace

VertexNumbers::VertexNumbers() : slots_(min_slots, none) {}

VertexNumbers::Found VertexNumbers::number_of(const Key& key) {
    const std::size_t slot = slot_of(key);
    if (slots_[slot] != none) {
        return {slots_[slot], false};
    }
    const auto number = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    slots_[slot] = number;
    if (2 * keys_.size() > slots_.size()) {
        grow();
    }
    return {number, true};
}

std::size_t VertexNumbers::slot_of(const Key& key) const {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15U; // 2^64 / golden ratio
    std::uint64_t hash = 0;
    for (const std::uint32_t part : key) {
        hash = (hash ^ part) * odd;
        hash ^= hash >> 29U;
    }
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != none && keys_[slots_[slot]] != key) {
        slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
}

void VertexNumbers::grow() {
    slots_.assign(2 * slots_.size(), none);
    for (std::uint32_t number = 0; number < keys_.size(); ++number) {
        slots_[slot_of(keys_[number])] = number;
    }
}

} // namespace frustumscreen::bake
