/// Carries the latest items from a device's thread to the exhibit's. When the mailbox is full, new items
/// overwrite the oldest.
///
/// Item     has a `time`; items are put in ascending time.
/// Threads  one puts, one takes. Taking never waits; it takes nothing while the other side is putting.
/// Memory   fixed.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace frustumscreen {

template <typename Item, std::size_t capacity> class Mailbox {
public:
    void put(std::span<const Item> items) {
        const std::lock_guard lock(mutex_);
        for (const Item& item : items) {
            items_[put_ % capacity] = item;
            ++put_;
        }
        taken_ = put_ > capacity ? std::max(taken_, put_ - capacity) : taken_;
    }
    /// Appends the items with time <= now that were not taken yet.
    void take(MonotonicTime now, std::vector<Item>& items) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        while (lock.owns_lock() && taken_ < put_ && items_[taken_ % capacity].time <= now) {
            items.push_back(items_[taken_ % capacity]);
            ++taken_;
        }
    }

private:
    std::mutex mutex_;
    std::array<Item, capacity> items_;
    std::uint64_t put_ = 0;   ///< items put so far
    std::uint64_t taken_ = 0; ///< items taken or overwritten so far
};

} // namespace frustumscreen
