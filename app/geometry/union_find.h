/// Sets of numbers that are joined pair by pair, with path halving.
///
/// Threads  one caller: `root` changes it too.
/// Source   Tarjan, van Leeuwen, Worst-case analysis of set union algorithms, 1984.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace frustumscreen::geometry {

class UnionFind {
public:
    /// Each number below `count` in a set of its own.
    explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    /// The number that stands for the set of `k`.
    [[nodiscard]] std::uint32_t root(std::uint32_t k) {
        while (parent_[k] != k) {
            parent_[k] = parent_[parent_[k]];
            k = parent_[k];
        }
        return k;
    }
    /// The root of `a` stands for both sets. False if they were one already.
    bool join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t to = root(a);
        const std::uint32_t from = root(b);
        parent_[from] = to;
        return from != to;
    }
    /// The root of each number, indexed by number.
    [[nodiscard]] std::vector<std::uint32_t> roots() {
        for (std::uint32_t& each : parent_) {
            each = root(each);
        }
        return parent_;
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace frustumscreen::geometry
