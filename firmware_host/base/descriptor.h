/// A file descriptor that its owner closes.
///
/// Threads  one caller.
#pragma once

#include <unistd.h>

#include <utility>

namespace frustumscreen {

class Descriptor {
public:
    /// A negative number stands for no descriptor.
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
    /// Transfers the descriptor to the caller, who must close it.
    [[nodiscard]] int release() { return std::exchange(number_, -1); }

private:
    int number_;
};

} // namespace frustumscreen
