/// Numbers for different keys, in the order in which they are met; less memory than a map.
///
/// Threads  one writer; any number of readers without a writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

/// A key of `words` words of 32 bits.
template <std::size_t words> class KeyNumbers {
public:
    using Key = std::array<std::uint32_t, words>;
    struct Found {
        std::uint32_t number = 0;
        bool is_new = false;
    };
    static constexpr std::uint32_t none = 0xFFFFFFFFU;

    /// The key's number; a new key takes the next one, from 0 on.
    Found number_of(const Key& key) {
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
    /// `none` for a key without a number.
    [[nodiscard]] std::uint32_t find(const Key& key) const { return slots_[slot_of(key)]; }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

private:
    [[nodiscard]] std::size_t slot_of(const Key& key) const {
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
    void grow() {
        slots_.assign(2 * slots_.size(), none);
        for (std::uint32_t number = 0; number < keys_.size(); ++number) {
            slots_[slot_of(keys_[number])] = number;
        }
    }

    static constexpr std::size_t min_slots = 1024;
    std::vector<Key> keys_; ///< by number
    std::vector<std::uint32_t> slots_ =
        std::vector<std::uint32_t>(min_slots, none); ///< numbers; open addressing, the size is a power of two
};

} // namespace frustumscreen::bake
