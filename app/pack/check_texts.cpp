#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/pack_text.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace frustumscreen::pack {

namespace {

Result<void> check_text(const std::string& what, std::string_view text, TextShape shape) {
    if (const std::optional<std::string> fault = fault_of_text(text, shape)) {
        return bad_input("pack.text", "{} {} (it is '{}')", what, *fault, printable(text, 40));
    }
    return {};
}

Result<void> check_line(const std::string& what, std::string_view text) {
    return check_text(what, text, TextShape::Line);
}

Result<void> check_language(const std::string& what, std::string_view text) {
    if (!has_language_form(text)) {
        return bad_input("pack.language_tag", "{} is '{}'; allowed are BCP 47 tags such as en or pt-BR", what,
                         printable(text, 40));
    }
    return {};
}

Result<void> check_caption(const std::string& place, const PackCaption& caption) {
    TRY_VOID(check_language(place + "language", caption.language));
    struct Named {
        const char* name;
        const std::string& text;
        TextShape shape;
    };
    for (const auto& [name, text, shape] :
         {Named{"title", caption.title, TextShape::Line}, Named{"text", caption.text, TextShape::Lines},
          Named{"period", caption.period, TextShape::Line}, Named{"place", caption.place, TextShape::Line},
          Named{"maker", caption.maker, TextShape::Line}, Named{"credit", caption.credit, TextShape::Line},
          Named{"description", caption.description, TextShape::Lines}}) {
        TRY_VOID(check_text(place + name, text, shape));
    }
    return {};
}

Result<void> check_captions(const PackDescription& pack) {
    if (pack.languages.size() > max_languages || pack.captions.size() > max_languages) {
        return bad_input("pack.language_count",
                         "the pack has {} languages and {} captions, allowed are {} of each",
                         pack.languages.size(), pack.captions.size(), max_languages);
    }
    for (std::size_t k = 0; k < pack.languages.size(); ++k) {
        TRY_VOID(check_language(fmt::format("language {}", k), pack.languages[k]));
    }
    for (std::size_t k = 0; k < pack.captions.size(); ++k) {
        TRY_VOID(check_caption(fmt::format("caption {}'s ", k), pack.captions[k]));
    }
    return {};
}

Result<void> check_provenance(const PackProvenance& provenance) {
    TRY_VOID(check_line("the source's name", provenance.source_name));
    if (provenance.source_name.find('/') != std::string::npos) {
        return bad_input("pack.source_name",
                         "the source's name is '{}'; allowed is a file name without folders",
                         printable(provenance.source_name));
    }
    const std::string& hash = provenance.source_sha256;
    const bool digits = hash.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!digits || (!hash.empty() && hash.size() != 64)) {
        return bad_input("pack.source_hash",
                         "the source's sha256 is '{}'; allowed are 64 lower-case hexadecimal digits",
                         printable(hash));
    }
    return check_line("the licence", provenance.licence);
}

} // namespace

Result<void> check_labels(const std::string& place, const std::vector<PackLabel>& labels) {
    if (labels.size() > max_languages) {
        return bad_input("hotspot.label_count", "{} has labels in {} languages, allowed are {}", place,
                         labels.size(), max_languages);
    }
    std::set<std::string_view> languages;
    for (const PackLabel& label : labels) {
        TRY_VOID(check_language(place + "'s language", label.language));
        if (!languages.insert(label.language).second) {
            return bad_input("hotspot.label_twice", "{} has two labels in {}; allowed is one", place,
                             label.language);
        }
        TRY_VOID(check_line(place + "'s label", label.text));
    }
    return {};
}

Result<void> check_texts(const PackDescription& pack) {
    if (!pack.id.empty() && !is_artifact_id(pack.id)) {
        return bad_input("pack.id",
                         "the id is '{}'; allowed are 1 to {} of a-z 0-9 . _ -, a letter or a digit "
                         "first",
                         printable(pack.id, 40), max_id_bytes);
    }
    TRY_VOID(check_line("the title", pack.title));
    TRY_VOID(check_captions(pack));
    if (pack.prop_kind != "frustum" && pack.prop_kind != "cube") {
        return bad_input("pack.prop_kind", "prop_kind is '{}'; allowed are frustum and cube",
                         printable(pack.prop_kind, 40));
    }
    if (pack.samples != 1 && pack.samples != 2 && pack.samples != 4 && pack.samples != 8) {
        return bad_input("pack.samples", "samples is {}; allowed are 1, 2, 4 and 8", pack.samples);
    }
    if (pack.relief_size < 0 || pack.relief_size > max_side_texels) {
        return bad_input("pack.relief_size", "relief_size is {}; allowed are 0 to {} texels",
                         pack.relief_size, max_side_texels);
    }
    return check_provenance(pack.provenance);
}

} // namespace frustumscreen::pack
