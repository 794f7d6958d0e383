#include "app/programs/bake/scan_about.h"

#include "app/pack/container/limits.h"
#include "app/pack/container/sha256.h"
#include "app/pack/pack_text.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

/// Fills fields that the request leaves empty from the scan's file; notes each field that the two give differently.
class Completion {
public:
    explicit Completion(std::vector<bake::SourceNote>& notes) : notes_(notes) {}

    void fill(const char* what, std::string& value, const std::string& from_file) {
        if (from_file.empty()) {
            return;
        }
        if (const auto fault = pack::fault_of_text(from_file, pack::TextShape::Line)) {
            notes_.push_back({bake::SourceNote::Kind::Lost,
                              fmt::format("the {} that the file names: it {}", what, *fault)});
        } else if (value.empty()) {
            value = from_file;
            taken_.push_back(fmt::format("{} \"{}\"", what, printable(from_file, 200)));
        } else if (value != from_file) {
            notes_.push_back({bake::SourceNote::Kind::Guessed,
                              fmt::format("the {} is \"{}\", as given; the file says \"{}\"", what,
                                          printable(value, 100), printable(from_file, 100))});
        }
    }
    void tell() {
        if (!taken_.empty()) {
            notes_.push_back(
                {bake::SourceNote::Kind::Taken, fmt::format("from the file: {}", fmt::join(taken_, ", "))});
        }
    }

private:
    std::vector<bake::SourceNote>& notes_;
    std::vector<std::string> taken_;
};

void complete_titles(BakeRequest& request, const bake::SourceAbout& about, Completion& completion) {
    const auto has_none = [](const pack::PackCaption& caption) { return caption.title.empty(); };
    if (std::none_of(request.captions.begin(), request.captions.end(), has_none)) {
        return; // a title that differs from the scan's is usual
    }
    std::string title;
    completion.fill("title", title, about.title);
    for (pack::PackCaption& caption : request.captions) {
        if (caption.title.empty()) {
            caption.title = title.empty() ? request.usual_title : title;
        }
    }
}

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
}

} // namespace

std::string default_id(const std::filesystem::path& pack_file) {
    constexpr std::size_t hash_digits = 8;
    constexpr std::size_t max_kept = pack::max_id_bytes - hash_digits - 1;
    const std::string name = pack_file.stem().string();
    std::string id;
    bool is_exact = true; // false: two names could give one id
    for (const char c : name) {
        const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool begins = !id.empty() || (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
        is_exact = is_exact && is_plain(small) && begins;
        if (begins) {
            id += is_plain(small) ? small : '-';
        }
    }
    if (is_exact && pack::is_artifact_id(id)) {
        return id;
    }
    id = id.substr(0, max_kept);
    return (id.empty() ? "pack" : id) + "-" + pack::sha256_hex(as_bytes(name)).substr(0, hash_digits);
}

CompletedRequest completed(BakeRequest request, const bake::SourceAbout& about) {
    CompletedRequest made{std::move(request), {}};
    Completion completion(made.notes);
    complete_titles(made.request, about, completion);
    completion.fill("author", made.request.rights.author, about.author);
    completion.fill("licence", made.request.rights.licence, about.licence);
    completion.fill("source", made.request.rights.source, about.source);
    completion.tell();
    if (made.request.id.empty()) {
        made.request.id = default_id(made.request.output);
        if (!made.request.watched) { // a watched pack is not for a kiosk
            made.notes.push_back(
                {bake::SourceNote::Kind::Taken,
                 fmt::format(
                     "the id \"{}\" from the pack's name: a pack with the same id replaces this one; keep "
                     "the name, or write id = \"...\" in the artifact.toml of a folder",
                     made.request.id)});
        }
    }
    return made;
}

} // namespace frustumscreen::programs
