/// A file descriptor that is closed with its owner.
///
/// Threads  one caller.
#pragma once

#include <unistd.h>

#include <utility>

namespace frustumscreen {

class Descriptor {
public:
    /// Below 0: there is none.
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() {
        if (number_ >= 0) {
            ::close(number_);
        }
    }
    [[nodiscard]] int number() const { return number_; }
    /// Whoever takes it closes it.
    [[nodiscard]] int release() { return std::exchange(number_, -1); }

private:
    int number_;
};

} // namespace frustumscreen
