#include "app/exhibit/shown_catalogue.h"

#include "app/exhibit/languages.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

ShownCatalogue::ShownCatalogue(Catalogue catalogue)
    : entries_(std::move(catalogue)), states_(entries_.size(), ArtifactState::Ready),
      offered_(entries_.size(), true) {}

Catalogue ShownCatalogue::exchange(Catalogue catalogue) {
    Catalogue before = std::exchange(entries_, std::move(catalogue));
    states_.assign(entries_.size(), ArtifactState::Ready);
    offered_.assign(entries_.size(), true);
    triangles_of_ = 0;
    return before;
}

void ShownCatalogue::note(std::span<const ArtifactState> states) {
    std::copy_n(states.begin(), std::min(states.size(), states_.size()), states_.begin());
}

void ShownCatalogue::note_triangles(std::size_t artifact, ArtifactTriangles triangles) {
    if (artifact >= entries_.size()) {
        return;
    }
    if (artifact != triangles_of_) {
        entries_[triangles_of_].hotspots.triangles = {};
    }
    triangles_of_ = artifact;
    entries_[artifact].hotspots.triangles = std::move(triangles);
}

std::optional<ShownCatalogue::Offer> ShownCatalogue::next_offer() {
    for (std::size_t artifact = 0; artifact < states_.size(); ++artifact) {
        const bool offered = states_[artifact] != ArtifactState::Unusable;
        if (offered != offered_[artifact]) {
            offered_[artifact] = offered;
            return Offer{artifact, offered};
        }
    }
    return std::nullopt;
}

bool ShownCatalogue::ready(std::size_t artifact) const {
    return artifact < states_.size() && states_[artifact] == ArtifactState::Ready;
}

bool ShownCatalogue::offers_something() const {
    return std::find(offered_.begin(), offered_.end(), true) != offered_.end();
}

const CatalogueEntry* ShownCatalogue::captioned(std::size_t artifact) const {
    return artifact < entries_.size() && !entries_[artifact].languages.empty() ? &entries_[artifact]
                                                                               : nullptr;
}

std::span<const TriggeredBehaviour> ShownCatalogue::behaviours(std::size_t artifact) const {
    return artifact < entries_.size() ? std::span<const TriggeredBehaviour>(entries_[artifact].behaviours)
                                      : std::span<const TriggeredBehaviour>();
}

std::span<const glm::dvec3> ShownCatalogue::hull(std::size_t artifact) const {
    return artifact < entries_.size() ? std::span<const glm::dvec3>(entries_[artifact].hull)
                                      : std::span<const glm::dvec3>();
}

const ZoneFrame& ShownCatalogue::zone(std::size_t artifact, const ZoneFrame& other) const {
    const bool has_own = artifact < entries_.size() && entries_[artifact].zone;
    return has_own ? *entries_[artifact].zone : other;
}

std::string_view ShownCatalogue::language(std::size_t artifact, std::string_view chosen) const {
    const CatalogueEntry* const entry = captioned(artifact);
    return entry != nullptr ? std::string_view(entry->languages[caption_for(chosen, entry->languages)])
                            : chosen;
}

DescriptionIndex ShownCatalogue::description(std::size_t artifact, std::string_view language) const {
    const CatalogueEntry* const entry = captioned(artifact);
    return {artifact, entry != nullptr ? caption_for(language, entry->languages) : 0};
}

const Tellable* ShownCatalogue::tellable(const DescriptionIndex& description) const {
    if (description.artifact >= entries_.size()) {
        return nullptr;
    }
    const std::vector<Tellable>& tellables = entries_[description.artifact].tellables;
    return description.language < tellables.size() && tellables[description.language].count() > 0
               ? &tellables[description.language]
               : nullptr;
}

} // namespace frustumscreen::exhibit
