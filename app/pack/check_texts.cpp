#include "app/pack/check_pack.h"
#include "app/pack/limits.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace frustumscreen::pack_format {

namespace {

/// UTF-8 without control characters; line feeds only where a text has lines.
bool is_clean(std::string_view text, bool with_lines) {
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        const std::string_view character = text.substr(0, bytes);
        if (bytes == 0 || (is_control(character) && !(with_lines && character == "\n"))) {
            return false;
        }
        text.remove_prefix(bytes);
    }
    return true;
}

Result<void> check_text(const std::string& what, std::string_view text, std::size_t most_bytes,
                        bool with_lines) {
    if (text.size() > most_bytes) {
        return bad_input(fmt::format("{} has {} bytes, allowed are {}", what, text.size(), most_bytes));
    }
    if (!is_clean(text, with_lines)) {
        return bad_input(fmt::format("{} is '{}'; allowed is UTF-8 text without control characters", what,
                                     printable(text, 40)));
    }
    return {};
}

Result<void> check_line(const std::string& what, std::string_view text) {
    return check_text(what, text, most_line_bytes, false);
}

bool is_language(std::string_view text) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    };
    return text.size() >= 2 && text.size() <= most_language_bytes &&
           std::all_of(text.begin(), text.end(), allowed);
}

Result<void> check_language(const std::string& what, std::string_view text) {
    if (!is_language(text)) {
        return bad_input(fmt::format("{} is '{}'; allowed are BCP 47 tags such as en or pt-BR", what,
                                     printable(text, 40)));
    }
    return {};
}

Result<void> check_captions(const Pack& pack) {
    if (pack.languages.size() > most_languages || pack.captions.size() > most_languages) {
        return bad_input(fmt::format("the pack has {} languages and {} captions, allowed are {} of each",
                                     pack.languages.size(), pack.captions.size(), most_languages));
    }
    for (std::size_t k = 0; k < pack.languages.size(); ++k) {
        if (auto good = check_language(fmt::format("language {}", k), pack.languages[k]); !good) {
            return good;
        }
    }
    for (std::size_t k = 0; k < pack.captions.size(); ++k) {
        const PackCaption& caption = pack.captions[k];
        const std::string place = fmt::format("caption {}'s ", k);
        if (auto good = check_language(place + "language", caption.language); !good) {
            return good;
        }
        if (auto good = check_line(place + "title", caption.title); !good) {
            return good;
        }
        if (auto good = check_text(place + "text", caption.text, most_text_bytes, true); !good) {
            return good;
        }
    }
    return {};
}

Result<void> check_provenance(const PackProvenance& provenance) {
    if (auto good = check_line("the source's name", provenance.source_name); !good) {
        return good;
    }
    if (provenance.source_name.find('/') != std::string::npos) {
        return bad_input(fmt::format("the source's name is '{}'; allowed is a file name without folders",
                                     printable(provenance.source_name)));
    }
    const std::string& hash = provenance.source_sha256;
    const bool digits = hash.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!digits || (!hash.empty() && hash.size() != 64)) {
        return bad_input(fmt::format(
            "the source's sha256 is '{}'; allowed are 64 lower-case hexadecimal digits", printable(hash)));
    }
    return check_line("the licence", provenance.licence);
}

} // namespace

Result<void> check_texts(const Pack& pack) {
    if (auto good = check_line("the title", pack.title); !good) {
        return good;
    }
    if (auto good = check_captions(pack); !good) {
        return good;
    }
    if (pack.prop_kind != "frustum" && pack.prop_kind != "cube") {
        return bad_input(
            fmt::format("prop_kind is '{}'; allowed are frustum and cube", printable(pack.prop_kind, 40)));
    }
    if (pack.samples != 1 && pack.samples != 2 && pack.samples != 4 && pack.samples != 8) {
        return bad_input(fmt::format("samples is {}; allowed are 1, 2, 4 and 8", pack.samples));
    }
    if (pack.relief_size < 0 || pack.relief_size > most_side_texels) {
        return bad_input(
            fmt::format("relief_size is {}; allowed are 0 to {} texels", pack.relief_size, most_side_texels));
    }
    return check_provenance(pack.provenance);
}

} // namespace frustumscreen::pack_format
