#include "app/exhibit/catalogue.h"

#include "app/exhibit/languages.h"

namespace frustumscreen::exhibit {

std::vector<std::string> languages_of(const Catalogue& catalogue) {
    std::vector<std::string> languages;
    for (const CatalogueEntry& entry : catalogue) {
        for (const std::string& language : entry.languages) {
            add_language(languages, language);
        }
    }
    return languages;
}

namespace {

/// The sizes of one text for `shapes` shapes: its own sizes, repeated.
std::vector<glm::dvec2> repeated(const std::vector<glm::dvec2>& sizes_m, std::size_t shapes) {
    std::vector<glm::dvec2> all;
    for (std::size_t k = 0; k < shapes && !sizes_m.empty(); ++k) {
        all.push_back(sizes_m[k % sizes_m.size()]);
    }
    return all;
}

/// For each shape of a caption, the size that holds all captions. Texts without an attribution, and descriptions,
/// have fewer shapes, for the same widths.
std::vector<glm::dvec2> sizes_of_all_captions(const Catalogue& catalogue) {
    std::vector<std::vector<glm::dvec2>> all;
    for (const CatalogueEntry& entry : catalogue) {
        all.insert(all.end(), entry.caption_sizes_m.begin(), entry.caption_sizes_m.end());
        for (const DescriptionShape& description : entry.descriptions) {
            all.push_back(description.largest_m);
        }
    }
    const std::size_t shapes = largest_sizes(all).size();
    for (std::vector<glm::dvec2>& sizes_m : all) {
        sizes_m = repeated(sizes_m, shapes);
    }
    return largest_sizes(all);
}

} // namespace

std::optional<TableBrowser> lay_out_catalogue(const Catalogue& catalogue, const ExhibitPlace& place) {
    if (!place.table_pictures) {
        return std::nullopt;
    }
    return TableBrowser({.artifacts = catalogue.size(),
                         .picture_m = place.picture_m,
                         .prop = place.prop,
                         .lens_m = place.lens_m,
                         .home_m = place.attract_place_m,
                         .captions_m = sizes_of_all_captions(catalogue)});
}

} // namespace frustumscreen::exhibit
