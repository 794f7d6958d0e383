#include "assets_baked/bake/loaders/sidecar.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>

namespace frustumscreen {

namespace {

bool has_scheme(std::string_view name) {
    const std::size_t colon = name.find(':');
    return colon != std::string_view::npos && name.substr(0, colon).find('/') == std::string_view::npos;
}

std::string with_slashes(std::string_view name) {
    std::string portable(name);
    std::replace(portable.begin(), portable.end(), '\\', '/');
    return portable;
}

bool leaves_folder(const std::filesystem::path& name) {
    int depth = 0;
    for (const std::filesystem::path& part : name) {
        depth += part == ".." ? -1 : (part == "." || part.empty() ? 0 : 1);
        if (depth < 0) {
            return true;
        }
    }
    return name.is_absolute();
}

int hexadecimal(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

} // namespace

std::filesystem::path Sidecars::path_of(std::string_view name, std::string_view place) const {
    if (name.empty() || name.find('\0') != std::string_view::npos) {
        refuse("{}: the file name is empty or holds a null character", place);
    }
    if (has_scheme(name)) {
        refuse("{}: \"{}\" is not a plain file name; only files beside the model are read", place,
               name.substr(0, 80));
    }
    const std::string portable = with_slashes(name);
    if (leaves_folder(portable)) {
        refuse("{}: \"{}\" lies outside the model's folder; put the file beside the model", place,
               name.substr(0, 80));
    }
    return (folder_ / portable).lexically_normal();
}

std::shared_ptr<const Bytes> Sidecars::read(std::string_view name, std::string_view place) {
    const std::filesystem::path path = path_of(name, place);
    if (const auto known = read_.find(path); known != read_.end() && known->second) {
        return known->second;
    }
    Result<Bytes> bytes = read_file(path);
    if (!bytes) {
        refuse("{}: {}", place, bytes.error().message);
    }
    auto shared = std::make_shared<const Bytes>(std::move(*bytes));
    read_.insert_or_assign(path, shared);
    return shared;
}

void Sidecars::mention(std::string_view name) {
    const std::string portable = with_slashes(name);
    if (!name.empty() && name.find('\0') == std::string_view::npos && !has_scheme(name) &&
        !leaves_folder(portable)) {
        read_.try_emplace((folder_ / portable).lexically_normal());
    }
}

std::vector<std::filesystem::path> Sidecars::files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& [path, bytes] : read_) {
        files.push_back(path);
    }
    return files;
}

bool Sidecars::exists(std::string_view name, std::string_view place) const {
    std::error_code ignored;
    return std::filesystem::exists(path_of(name, place), ignored);
}

std::string percent_decoded_if_valid(std::string_view uri) {
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            plain += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hexadecimal(uri[i + 2]) : -1;
        if (high < 0 || low < 0) {
            return {};
        }
        plain += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return plain;
}

std::string percent_decoded(std::string_view uri, std::string_view place) {
    std::string plain = percent_decoded_if_valid(uri);
    if (plain.empty() && !uri.empty()) {
        refuse("{}: \"{}\" has a % without two hexadecimal digits", place, uri.substr(0, 80));
    }
    return plain;
}

} // namespace frustumscreen
