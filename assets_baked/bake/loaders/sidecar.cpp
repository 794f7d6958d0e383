#include "assets_baked/bake/loaders/sidecar.h"

#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/names/file_name.h"
#include "assets_baked/names/find_entry.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <array>

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

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// True if the file's ending is that of a picture.
bool is_picture_name(const std::string& name) {
    static constexpr std::array endings = {".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".bmp", ".tga"};
    const std::string ending = std::filesystem::path(name).extension().string();
    return std::any_of(endings.begin(), endings.end(),
                       [&](const char* each) { return is_same_file_name(ending, each); });
}

int hexadecimal(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The alphabetically first name in the folder that `fits`.
template <typename Fits>
std::optional<std::string> first_in(const std::filesystem::path& folder, const Fits& fits) {
    std::optional<std::string> first;
    std::error_code stop;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, stop);
    for (; !stop && entry != std::filesystem::directory_iterator(); entry.increment(stop)) {
        const std::string name = entry->path().filename().string();
        if (fits(name) && (!first || name < *first)) {
            first = name;
        }
    }
    return first;
}

/// Finds `name` inside `folder`, part by part, allowing for another computer's spelling of each part.
std::optional<std::filesystem::path> find_in_any_spelling(std::filesystem::path folder,
                                                          const std::filesystem::path& name) {
    for (const std::filesystem::path& part : name.lexically_normal()) {
        const auto found = find_entry(folder, part.string());
        if (!found) {
            return std::nullopt;
        }
        folder = *found;
    }
    return is_file(folder) ? std::optional(folder) : std::nullopt;
}

} // namespace

std::string_view last_part(std::string_view name) {
    return name.substr(name.find_last_of("/\\") + 1); // npos + 1 is 0
}

std::optional<std::filesystem::path> Sidecars::find_as_written(std::string_view name) const {
    const std::filesystem::path portable(with_slashes(name));
    if (name.empty() || name.find('\0') != std::string_view::npos || has_scheme(name) ||
        leaves_folder(portable)) {
        return std::nullopt;
    }
    const std::filesystem::path exact = (folder_ / portable).lexically_normal();
    return is_file(exact) ? std::optional(exact) : find_in_any_spelling(folder_, portable);
}

bool Sidecars::exists_as_written(std::string_view name) const {
    return find_as_written(name).has_value();
}

std::filesystem::path Sidecars::folder_of(std::string_view name) const {
    const std::optional<std::filesystem::path> path = find(name);
    return path ? path->lexically_relative(folder_.empty() ? "." : folder_).parent_path()
                : std::filesystem::path();
}

std::optional<std::filesystem::path> Sidecars::find(std::string_view name) const {
    if (name.empty() || name.find('\0') != std::string_view::npos) {
        return std::nullopt;
    }
    if (auto found = find_as_written(name)) {
        return found;
    }
    const std::string_view last = last_part(name);
    return last.empty() || last == "." || last == ".." ? std::nullopt : find_in_any_spelling(folder_, last);
}

std::shared_ptr<const Bytes> Sidecars::read(std::string_view name, std::string_view place) {
    const std::optional<std::filesystem::path> path = find(name);
    if (!path) {
        refuse("mesh.side_file_missing",
               "it names the file \"{}\", but there is no such file beside it; put it there ({})",
               printable(last_part(name)), place);
    }
    if (const auto known = read_.find(*path); known != read_.end()) {
        if (std::shared_ptr<const Bytes> held = known->second.lock()) {
            return held;
        }
    }
    const std::string relative = path->lexically_relative(folder_.empty() ? "." : folder_).string();
    if (std::filesystem::path(with_slashes(name)).lexically_normal() != relative) {
        notes_.guessed("it names the file \"{}\"; {} beside it is used", printable(name), relative);
    }
    Result<Bytes> bytes = read_file(*path);
    if (!bytes) {
        refuse({ErrorKind::BadInput, bytes.error().id, fmt::format("{}: {}", place, bytes.error().message)});
    }
    auto shared = std::make_shared<const Bytes>(std::move(*bytes));
    read_.insert_or_assign(*path, shared);
    return shared;
}

std::optional<std::string> Sidecars::like(std::string_view name) const {
    const std::string stem = std::filesystem::path(last_part(name)).stem().string();
    return first_in(folder_, [&](const std::string& each) {
        return !stem.empty() && is_same_file_name(std::filesystem::path(each).stem().string(), stem) &&
               is_picture_name(each);
    });
}

void Sidecars::mention(std::string_view name) {
    if (const auto path = find(name)) {
        read_.try_emplace(*path);
    }
}

std::vector<std::filesystem::path> Sidecars::files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& [path, bytes] : read_) {
        files.push_back(path);
    }
    return files;
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
        refuse_damage("{}: \"{}\" has a % without two hexadecimal digits", place, uri.substr(0, 80));
    }
    return plain;
}

} // namespace frustumscreen
