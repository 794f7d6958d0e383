#include "assets_baked/folder/new_folder.h"

#include "app/pack/pack_text.h"
#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <system_error>

namespace frustumscreen::folder {

namespace {

namespace fs = std::filesystem;

/// The text as a quoted TOML string.
std::string toml_string(std::string_view text) {
    std::string inside;
    for (const char c : text) {
        inside += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return '"' + inside + '"';
}

/// A word of the title and a random number: unique among all artifacts, and recognisable by a person.
std::string new_id(std::string_view title) {
    std::string word;
    for (const char c : title.substr(0, 24)) {
        const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool plain = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
        word += plain ? small : '-';
    }
    std::random_device random;
    word += fmt::format("-{:08x}", random());
    return pack::is_artifact_id(word) ? word : "artifact" + word;
}

bool is_same_folder(const fs::path& a, const fs::path& b) {
    std::error_code none;
    return fs::equivalent(a.empty() ? fs::path(".") : a, b.empty() ? fs::path(".") : b, none);
}

/// The scan's files and their destinations, relative to the folder.
using Copies = std::vector<std::pair<fs::path, fs::path>>;

Result<Copies> copies_of(const ScanFacts& scan) {
    Copies copies{{scan.file, scan.file.filename()}};
    for (const fs::path& side : scan.side_files) {
        std::error_code none;
        if (!fs::is_regular_file(side, none)) {
            continue; // the bake reports missing files
        }
        const fs::path relative = side.lexically_relative(scan.file.parent_path());
        if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") {
            return bad_input("folder.side_file_outside",
                             "{}: it names {}, which lies outside its folder; put that file beside "
                             "it and change the name, then try again",
                             scan.file.string(), printable(side.string(), 200));
        }
        copies.emplace_back(side, relative);
    }
    return copies;
}

/// Removes a partial copy, because the next try would take a truncated file for a scan.
void take_away(const fs::path& folder, const Copies& copies) {
    for (const auto& [from, to] : copies) {
        std::error_code none;
        fs::remove(folder / to, none);
    }
}

Result<void> not_copied(const fs::path& from, const fs::path& to, const std::error_code& why) {
    std::error_code none;
    const fs::space_info space = fs::space(to.parent_path(), none);
    const std::uintmax_t bytes = fs::file_size(from, none);
    if (why == std::errc::no_space_on_device || (!none && space.available < bytes)) {
        return bad_input(
            "folder.no_space",
            "{}: no space is left for it in {}: it needs {:.1f} MB and {:.1f} MB are free; make room, or "
            "choose a folder on another disk",
            from.string(), to.parent_path().string(), static_cast<double>(bytes) / 1e6,
            static_cast<double>(space.available) / 1e6);
    }
    return bad_input("folder.not_copied", "{}: cannot be copied to {}: {}", from.string(), to.string(),
                     why.message());
}

Result<void> copy_into(const fs::path& folder, const Copies& copies) {
    for (const auto& [from, to] : copies) {
        if (std::error_code none; fs::exists(folder / to, none)) {
            return bad_input("folder.there_already",
                             "{}: this file is there already and is not replaced; choose an empty "
                             "folder, or name the scan that lies in it",
                             (folder / to).string());
        }
    }
    for (const auto& [from, to] : copies) {
        std::error_code failed;
        fs::create_directories((folder / to).parent_path(), failed);
        fs::copy_file(from, folder / to, failed);
        if (failed) {
            take_away(folder, copies); // none of them existed before
            return not_copied(from, folder / to, failed);
        }
    }
    return {};
}

constexpr std::string_view head = R"(# What frustumscreen-bake makes of this folder:
#
#     frustumscreen-bake THIS_FOLDER -o NAME.fspack
#
# A line that begins with # says nothing to the program. Take its # away to set what it shows.

# The scan, beside this file.
scan = {scan}
# A picture of the colours, where the scan names one that is missing, or none.
#texture = "skin.png"

# This artifact's own name, which visitors never see. A pack with the same id replaces an older one: keep it.
id = {id}
# The scan's licence, who made the scan, and where it was published. Licence and author are shown to visitors, since most licences
# ask for it; without them here the bake takes what the scan's file says.
{licence}
{author}
{source}

# The colours have their light in them, as in photogrammetry. Without this the artifact is lit as in a museum.
#unlit = true
# Texels along the longest edge of a face of the prop, 16 to 4096.
#size = 512
# "cube" if the exhibit's prop is a cube that visitors hold in the hand.
#prop = "frustum"

[placement]
# The scan's axis that goes up: "x", "y", "z", "-x", "-y" or "-z"; without this {up}.
#up = "{up}"
# Degrees about the vertical, counter-clockwise seen from above. Without this the broadest side looks at the visitor.
#turn_deg = 0
# A factor on the largest size that fits into the prop; above 1 the prop cuts the artifact off.
#scale = 1.0
# Raised above the prop's bottom, in heights of the artifact.
#lift = 0.0

# One [[texts]] for each language; the first one is shown where a visitor's language is not among them.
[[texts]]
language = "en"
title = {title}
# These four are shown below the caption in small type where there is room, and at the end of what is told.
#maker = "unknown potter"
#place = "Athens"
#period = "about 540 BC"
#credit = "Gift of ..."
#text = "One or two sentences for the caption beside the prop."
# What there is to see, for visitors who do not see it.
#description = """
#First sentence.
#Second sentence."""
# The same, spoken: WAV, FLAC, Opus or Vorbis. Without it, recordings/LANGUAGE/description.wav is looked for (.flac, .opus, .ogg),
# and then a voice speaks.
#recording = "description.wav"

#[[texts]]
#language = "de"
#title = "..."

# Up to three places of the artifact with a word on each. A point is given in the scan's own coordinates, as every
# viewer of scans shows them, on the surface or close to it.
# This scan reaches from {low} to {high}.
# Its middle stands below; write a point of the surface in its place.
#[[hotspots]]
#point = {middle}
#labels = {{ en = "The handle", de = "Der Henkel" }}

# What moves, and what starts it: an animation of the model, or a spring, a pendulum or light of one of its parts.
#[[behaviours]]
#name = "open"
#animation = "Lid"
#trigger = "button"
#titles = {{ en = "Turn the lid", de = "Den Deckel drehen" }}

# The same artifact before, after, reconstructed, for windows on the table: without parts of the model, at the end of a behaviour, or in
# other colours of the same surface.
#[[states]]
#name = "found"
#hide = ["handle"]
#behaviour = "open"
#layer = "found.png"
#titles = {{ en = "As found", de = "Fundzustand" }}
)";

/// The line with the file's value; without one, a commented line with an example.
std::string told_or_example(std::string_view key, const std::string& told, std::string_view example) {
    return told.empty() ? fmt::format("#{} = {}", key, toml_string(example))
                        : fmt::format("{} = {}", key, toml_string(told));
}

std::string words_of(glm::dvec3 v, double longest) {
    for (int axis = 0; axis < 3; ++axis) {
        v[axis] = std::abs(v[axis]) < 1e-5 * longest ? 0.0 : v[axis]; // 4e-09 is meaningless to a person
    }
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

} // namespace

std::string new_artifact_text(const ScanFacts& scan, const std::string& title, const std::string& id) {
    const glm::dvec3 size = scan.high - scan.low;
    const double longest = std::max({size.x, size.y, size.z});
    return fmt::format(
        head, fmt::arg("scan", toml_string(scan.file.filename().string())), fmt::arg("id", toml_string(id)),
        fmt::arg("licence", told_or_example("licence", scan.licence, "CC-BY-4.0")),
        fmt::arg("author", told_or_example("author", scan.author, "Jane Doe")),
        fmt::arg("source", told_or_example("source", scan.source, "https://...")),
        fmt::arg("up", scan.default_up), fmt::arg("title", toml_string(title)),
        fmt::arg("low", words_of(scan.low, longest)), fmt::arg("high", words_of(scan.high, longest)),
        fmt::arg("middle", words_of(0.5 * (scan.low + scan.high), longest)));
}

Result<fs::path> start_folder(const fs::path& folder, const ScanFacts& scan) {
    const fs::path file = folder / artifact_file_name;
    const std::string name = scan.file.filename().string();
    if (const auto fault = pack::fault_of_text(name, pack::TextShape::Line)) {
        return bad_input("folder.scan_name", "{}: the file's name {}", printable(scan.file.string(), 200),
                         *fault);
    }
    std::error_code failed;
    if (fs::exists(file, failed)) {
        return bad_input("folder.artifact_file_there",
                         "{}: this file is there already; edit it, or choose another folder", file.string());
    }
    Copies copies;
    if (!is_same_folder(folder, scan.file.parent_path())) {
        TRY(copies, copies_of(scan));
        fs::create_directories(folder, failed);
        if (failed) {
            return bad_input("folder.not_made", "{}: this folder cannot be made: {}", folder.string(),
                             failed.message());
        }
        TRY_VOID(copy_into(folder, copies));
    }
    const std::string title = scan.title.empty() ? scan.file.stem().string() : scan.title;
    if (const Result<void> written =
            write_file(file, as_bytes(new_artifact_text(scan, title, new_id(title))));
        !written) {
        take_away(folder, copies);
        return tl::unexpected<Error>(written.error());
    }
    return file;
}

} // namespace frustumscreen::folder
