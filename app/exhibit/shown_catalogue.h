/// The catalogue on show, and which of its artifacts can be shown now.
///
/// Frames   prop frame, metres, for hulls and triangles.
/// Threads  values; one caller. Only `exchange` and the constructor allocate.
/// Errors   none: an index out of range names nothing.
#pragma once

#include "app/exhibit/artifact_state.h"
#include "app/exhibit/catalogue.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen::exhibit {

class ShownCatalogue {
public:
    /// All artifacts are ready.
    explicit ShownCatalogue(Catalogue catalogue);
    /// Replaces the catalogue and returns the previous one. All artifacts of the new one are ready.
    [[nodiscard]] Catalogue exchange(Catalogue catalogue);

    /// Sets the state of each artifact. An empty list changes nothing.
    void note(std::span<const ArtifactState> states);
    /// Sets the triangles that hide the artifact's hotspots; those of other artifacts are dropped.
    void note_triangles(std::size_t artifact, ArtifactTriangles triangles);
    /// Returns the next artifact whose availability has changed since it was last reported; none: there are no more.
    struct Offer {
        std::size_t artifact = 0;
        bool offered = true;
    };
    [[nodiscard]] std::optional<Offer> next_offer();

    [[nodiscard]] const Catalogue& all() const { return entries_; }
    [[nodiscard]] bool ready(std::size_t artifact) const;
    /// True if some artifact is offered.
    [[nodiscard]] bool offers_something() const;
    /// Null: it has no captions.
    [[nodiscard]] const CatalogueEntry* captioned(std::size_t artifact) const;
    /// Valid as long as the catalogue.
    [[nodiscard]] std::span<const glm::dvec3> hull(std::size_t artifact) const;
    /// Also of an artifact without captions; valid as long as the catalogue.
    [[nodiscard]] std::span<const TriggeredBehaviour> behaviours(std::size_t artifact) const;
    /// Null: it is no site. Valid as long as the catalogue.
    [[nodiscard]] const SiteGround* site(std::size_t artifact) const {
        return artifact < entries_.size() && !entries_[artifact].site.regions.empty()
                   ? &entries_[artifact].site
                   : nullptr;
    }
    /// How many contents a torch can throw onto it.
    [[nodiscard]] std::size_t contents(std::size_t artifact) const {
        return artifact < entries_.size() ? entries_[artifact].content_title_sizes_m.size() : 0;
    }
    /// `other`: the zone of an artifact without its own.
    [[nodiscard]] const ZoneFrame& zone(std::size_t artifact, const ZoneFrame& other) const;
    /// The language of the artifact's caption; without captions, `chosen`.
    [[nodiscard]] std::string_view language(std::size_t artifact, std::string_view chosen) const;
    [[nodiscard]] DescriptionIndex description(std::size_t artifact, std::string_view language) const;
    /// Null: there is nothing to tell.
    [[nodiscard]] const Tellable* tellable(const DescriptionIndex& description) const;

private:
    Catalogue entries_;
    std::vector<ArtifactState> states_;
    std::vector<bool> offered_;    ///< by artifact: offered by selection and table
    std::size_t triangles_of_ = 0; ///< the artifact whose triangles are noted
};

} // namespace frustumscreen::exhibit
