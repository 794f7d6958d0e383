// Which artifacts, texts and pages are to be in memory, most urgent first.
#include "app/exhibit/languages.h"
#include "app/residency/artifact_cache.h"

#include <algorithm>
#include <span>

namespace frustumscreen::residency {

std::size_t ArtifactCache::text_item(std::size_t artifact, TextPart part, std::size_t language) const {
    return first_items_[artifact] + 1 + text_parts * language + static_cast<std::size_t>(part);
}

void ArtifactCache::add_text(Queue& queue, std::size_t artifact, TextPart part,
                             std::string_view language) const {
    const std::vector<std::string>& languages = known(artifact).texts.entry.languages;
    if (languages.empty()) {
        return;
    }
    const std::size_t item = text_item(artifact, part, exhibit::caption_for(language, languages));
    if (records_[item].bytes > 0) {
        queue.add(item);
    }
}

void ArtifactCache::add_pages(Queue& queue, std::size_t artifact) const {
    const RunCells* const cells = find_cells(artifact);
    const std::size_t end = artifact + 1 < size() ? first_items_[artifact + 1] : items_.size();
    const auto pages = std::span(items_).first(end).subspan(first_pages_[artifact]);
    for (const std::size_t place :
         cells != nullptr ? cells->wanted_pages() : std::span<const std::size_t>()) {
        const auto found =
            std::lower_bound(pages.begin(), pages.end(), place,
                             [](const Item& item, std::size_t wanted) { return item.page->place < wanted; });
        queue.add(first_pages_[artifact] + static_cast<std::size_t>(found - pages.begin()));
    }
}

/// The artifacts shown and waited for. Captions come first, because they are small and are shown before their
/// artifact.
ArtifactCache::Queue ArtifactCache::needed(const CacheRequest& request) const {
    Queue needed;
    needed.add(levels_item(request.shown));
    add_text(needed, request.shown, TextPart::Caption, request.shown_language);
    if (!request.wanted.empty()) {
        add_text(needed, request.wanted.front(), TextPart::Caption, request.language);
        needed.add(levels_item(request.wanted.front()));
    }
    add_text(needed, request.shown, TextPart::Narration, request.shown_language);
    if (!request.wanted.empty()) {
        add_text(needed, request.wanted.front(), TextPart::Narration, request.language);
    }
    return needed;
}

/// The chosen artifact's captions in the other languages come last; they let the language button respond at
/// once.
ArtifactCache::Queue ArtifactCache::wanted(const CacheRequest& request) const {
    Queue wanted;
    add_pages(wanted, request.shown);
    for (std::size_t k = 1; k < request.wanted.size(); ++k) {
        wanted.add(levels_item(request.wanted[k]));
        add_text(wanted, request.wanted[k], TextPart::Caption, request.language);
    }
    if (!request.wanted.empty()) {
        for (const std::string& language : known(request.wanted.front()).texts.entry.languages) {
            add_text(wanted, request.wanted.front(), TextPart::Caption, language);
        }
    }
    return wanted;
}

void ArtifactCache::note_shown(const CacheRequest& request) {
    if (shown_ != request.shown) {
        shown_ = request.shown;
        ++shows_;
    }
    Queue shown;
    shown.add(levels_item(request.shown));
    add_text(shown, request.shown, TextPart::Caption, request.shown_language);
    add_text(shown, request.shown, TextPart::Narration, request.shown_language);
    add_pages(shown, request.shown);
    for (const std::size_t item : shown.items()) {
        records_[item].last_shown = shows_;
    }
}

} // namespace frustumscreen::residency
