#include "app/residency/residency.h"

namespace frustumscreen::residency {

namespace {

class Decision {
public:
    Decision(std::span<const ResidentItem> items, std::span<const std::size_t> needed,
             std::span<const std::size_t> wanted, std::uint64_t budget)
        : items_(items), needed_(needed), wanted_(wanted), budget_(budget) {}

    [[nodiscard]] ResidencyStep step() const {
        const std::optional<std::size_t> load = missing();
        std::uint64_t bytes = load ? items_[*load].bytes : 0;
        for (const ResidentItem& item : items_) {
            bytes += item.loaded ? item.bytes : 0;
        }
        if (bytes > budget_) {
            if (const std::optional<std::size_t> release = min_recent()) {
                return {release, std::nullopt};
            }
        }
        return {std::nullopt, load};
    }

private:
    /// Calls `place` with each item that should be in memory, in order of urgency.
    template <typename Place> void choose(const Place& place) const {
        std::uint64_t bytes = 0;
        for (std::size_t k = 0; k < needed_.size() + wanted_.size(); ++k) {
            const std::size_t item = at(k);
            const bool always = k < needed_.size();
            if (!items_[item].left_out && !is_before(k) &&
                (always || bytes + items_[item].bytes <= budget_)) {
                bytes += items_[item].bytes;
                place(item);
            }
        }
    }
    [[nodiscard]] std::size_t at(std::size_t k) const {
        return k < needed_.size() ? needed_[k] : wanted_[k - needed_.size()];
    }
    /// True if the item was named before position `k`.
    [[nodiscard]] bool is_before(std::size_t k) const {
        for (std::size_t before = 0; before < k; ++before) {
            if (at(before) == at(k)) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::optional<std::size_t> missing() const {
        std::optional<std::size_t> first;
        choose([&](std::size_t item) {
            if (!first && !items_[item].loaded) {
                first = item;
            }
        });
        return first;
    }
    [[nodiscard]] bool is_to_be_there(std::size_t asked) const {
        bool there = false;
        choose([&](std::size_t item) { there = there || item == asked; });
        return there;
    }
    [[nodiscard]] std::optional<std::size_t> min_recent() const {
        std::optional<std::size_t> least;
        for (std::size_t k = 0; k < items_.size(); ++k) {
            if (items_[k].loaded && !is_to_be_there(k) &&
                (!least || items_[k].last_shown < items_[*least].last_shown)) {
                least = k;
            }
        }
        return least;
    }

    std::span<const ResidentItem> items_;
    std::span<const std::size_t> needed_;
    std::span<const std::size_t> wanted_;
    std::uint64_t budget_;
};

} // namespace

ResidencyStep next_step(std::span<const ResidentItem> items, std::span<const std::size_t> needed,
                        std::span<const std::size_t> wanted, std::uint64_t budget) {
    return Decision(items, needed, wanted, budget).step();
}

} // namespace frustumscreen::residency
