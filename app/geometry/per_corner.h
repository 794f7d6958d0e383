/// A value for each corner of a face, or for each of its edges: edge `k` runs from corner k to the next one.
///
/// Threads  values; any. Allocates nothing, because each frame plans its faces with it.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace frustumscreen::geometry {

inline constexpr std::size_t max_faces = 16; ///< of a prop
/// An edge with each other face.
inline constexpr std::size_t max_face_corners = max_faces - 1;
/// Euler's formula: three faces or more meet at each corner.
inline constexpr std::size_t max_corners = 2 * max_faces - 4;

template <typename Value> class PerCorner {
public:
    PerCorner() = default;
    PerCorner(std::initializer_list<Value> values) {
        assert(values.size() <= max_face_corners);
        std::copy(values.begin(), values.end(), values_.begin());
        count_ = values.size();
    }

    void push_back(const Value& value) {
        assert(count_ < max_face_corners);
        values_[count_++] = value;
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    /// The corner, or the edge, after `k`: the first one after the last.
    [[nodiscard]] std::size_t next(std::size_t k) const { return k + 1 < count_ ? k + 1 : 0; }
    [[nodiscard]] Value& operator[](std::size_t k) {
        assert(k < count_);
        return values_[k];
    }
    [[nodiscard]] const Value& operator[](std::size_t k) const {
        assert(k < count_);
        return values_[k];
    }
    [[nodiscard]] Value* data() { return values_.data(); }
    [[nodiscard]] const Value* data() const { return values_.data(); }
    [[nodiscard]] Value* begin() { return data(); }
    [[nodiscard]] const Value* begin() const { return data(); }
    [[nodiscard]] Value* end() { return data() + count_; }
    [[nodiscard]] const Value* end() const { return data() + count_; }

private:
    std::array<Value, max_face_corners> values_{};
    std::size_t count_ = 0;
};

} // namespace frustumscreen::geometry
