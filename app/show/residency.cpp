#include "app/show/residency.h"

#include <algorithm>

namespace frustumscreen {

namespace {

class Decision {
public:
    Decision(std::span<const ResidentArtifact> artifacts, std::size_t shown,
             std::span<const std::size_t> wanted, std::uint64_t budget)
        : artifacts_(artifacts), shown_(shown), wanted_(wanted), budget_(budget) {}

    [[nodiscard]] ResidencyStep step() const {
        const std::optional<std::size_t> load = missing();
        std::uint64_t bytes = load ? artifacts_[*load].bytes : 0;
        for (const ResidentArtifact& artifact : artifacts_) {
            bytes += artifact.loaded ? artifact.bytes : 0;
        }
        if (bytes > budget_) {
            if (const std::optional<std::size_t> release = least_recent()) {
                return {release, std::nullopt};
            }
        }
        return {std::nullopt, load};
    }

private:
    /// Whether the artifact `asked` is to be there. Calls `place` with each that is, in order of urgency.
    template <typename Place> void choose(const Place& place) const {
        std::uint64_t bytes = 0;
        const auto take = [&](std::size_t artifact, bool always) {
            if (!artifacts_[artifact].left_out && (always || bytes + artifacts_[artifact].bytes <= budget_)) {
                bytes += artifacts_[artifact].bytes;
                place(artifact);
            }
        };
        take(shown_, true);
        for (std::size_t k = 0; k < wanted_.size(); ++k) {
            const std::span<const std::size_t> before = wanted_.first(k);
            if (wanted_[k] != shown_ && std::find(before.begin(), before.end(), wanted_[k]) == before.end()) {
                take(wanted_[k], k == 0);
            }
        }
    }
    [[nodiscard]] std::optional<std::size_t> missing() const {
        std::optional<std::size_t> first;
        choose([&](std::size_t artifact) {
            if (!first && !artifacts_[artifact].loaded) {
                first = artifact;
            }
        });
        return first;
    }
    [[nodiscard]] bool is_to_be_there(std::size_t asked) const {
        bool there = asked == shown_;
        choose([&](std::size_t artifact) { there = there || artifact == asked; });
        return there;
    }
    [[nodiscard]] std::optional<std::size_t> least_recent() const {
        std::optional<std::size_t> least;
        for (std::size_t k = 0; k < artifacts_.size(); ++k) {
            if (artifacts_[k].loaded && !is_to_be_there(k) &&
                (!least || artifacts_[k].last_shown < artifacts_[*least].last_shown)) {
                least = k;
            }
        }
        return least;
    }

    std::span<const ResidentArtifact> artifacts_;
    std::size_t shown_;
    std::span<const std::size_t> wanted_;
    std::uint64_t budget_;
};

} // namespace

ResidencyStep next_step(std::span<const ResidentArtifact> artifacts, std::size_t shown,
                        std::span<const std::size_t> wanted, std::uint64_t budget) {
    return Decision(artifacts, shown, wanted, budget).step();
}

} // namespace frustumscreen
