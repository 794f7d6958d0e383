/// Hands the latest value from one thread to another. Values that were not taken in time are lost, the latest
/// never is.
///
/// Threads  one side is in a hurry and uses `try_...` alone, which never waits; the other side waits for no
///          longer than a copy takes.
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
    /// False: the other side is at it; put it again later.
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
    /// False: nothing was put since the last time, and `value` stays as it is.
    [[nodiscard]] bool take(T& value) {
        const std::lock_guard lock(mutex_);
        return take_fresh(value);
    }
    /// False also when the other side is at it.
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
