/// Hands the latest value from one thread to another. A newer value replaces one that was not taken.
///
/// Threads  the time-critical side uses only `try_...`, which never waits; the other side waits no longer
///          than a copy takes.
#pragma once

#include <mutex>
#include <utility>

namespace frustumscreen {

template <typename T> class Latest {
public:
    void put(T value) {
        const std::lock_guard lock(mutex_);
        std::swap(value_, value); // the old value is destroyed after the lock
        fresh_ = true;
    }
    /// False: the other side holds the lock; try again later.
    [[nodiscard]] bool try_put(const T& value) {
        T copy = value;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock()) {
            return false;
        }
        std::swap(value_, copy);
        fresh_ = true;
        return true;
    }
    /// False: no value was put since the last call, and `value` is unchanged.
    [[nodiscard]] bool take(T& value) {
        const std::lock_guard lock(mutex_);
        return take_fresh(value);
    }
    /// As `take`; false also while the other side holds the lock.
    [[nodiscard]] bool try_take(T& value) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        return lock.owns_lock() && take_fresh(value);
    }

private:
    [[nodiscard]] bool take_fresh(T& value) {
        if (fresh_) {
            value = value_;
        }
        return std::exchange(fresh_, false);
    }

    std::mutex mutex_;
    T value_{};
    bool fresh_ = false;
};

} // namespace frustumscreen
