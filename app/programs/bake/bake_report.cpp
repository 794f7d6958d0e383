#include "app/programs/bake/bake_report.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_texts.h"
#include "assets_baked/bake/box_frame.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/version.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mm_per_m = 1000.0;

double metres_per_box(const BakeResult& result) {
    return pack::place(result.pack, result.prop.shape).metres_per_box;
}

/// Size of the artifact itself, without the empty space below a raised one.
glm::dvec3 size_m(const BakeResult& result) {
    double lowest = result.pack.box_size.z;
    for (const glm::dvec3& extreme : result.pack.extremes) {
        if (extreme != glm::dvec3(0.0)) {
            lowest = std::min(lowest, extreme.z);
        }
    }
    return (result.pack.box_size - glm::dvec3(0.0, 0.0, lowest)) * metres_per_box(result);
}

/// The file's axis that points at the visitor when no turn is applied.
std::string front_of(const std::string& up) {
    const glm::dvec3 axis =
        glm::transpose(bake::up_rotation(up).value_or(glm::dmat3(1.0))) * glm::dvec3(0, -1, 0);
    for (int k = 0; k < 3; ++k) {
        if (std::abs(axis[k]) > 0.5) {
            return fmt::format("{}{}", axis[k] > 0.0 ? '+' : '-', "xyz"[k]);
        }
    }
    return "+y";
}

std::string signed_axis(const std::string& up) {
    return up.starts_with('-') || up.starts_with('+') ? up : "+" + up;
}

/// Stored bytes that a reader of this level alone reads from the file.
std::uint64_t bytes_of(const BakeResult& result, std::size_t level) {
    const pack::PackLevel& of = result.pack.levels[level];
    std::uint64_t bytes = 0;
    for (const pack::PackPart& part : result.parts) {
        if (part.name == fmt::format("levels/{}.bin", level) ||
            part.name.starts_with(fmt::format("textures/{}.", of.texture))) {
            bytes += part.stored_bytes;
        }
    }
    return bytes;
}

std::string in_units(std::uint64_t bytes) {
    return bytes < 1'000'000 ? fmt::format("{:.0f} kB", std::ceil(static_cast<double>(bytes) / 1e3))
                             : fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string standing_text(const BakeResult& result) {
    std::string text = fmt::format("up is the file's {}{}; ", signed_axis(result.up),
                                   result.up_given ? "" : ", as its format has it (--up for another)");
    if (result.turn_deg == 0.0) {
        return text + fmt::format("its {} looks at the visitor{}", front_of(result.up),
                                  result.turn_given ? "" : ", where it shows most (--turn to change)");
    }
    return text + fmt::format("its {} is turned {:g} {} from the visitor, {}wise seen from above{}",
                              front_of(result.up), std::abs(result.turn_deg),
                              std::abs(result.turn_deg) == 1.0 ? "degree" : "degrees",
                              result.turn_deg > 0.0 ? "counter-clock" : "clock",
                              result.turn_given ? "" : ", where it shows most (--turn 0 leaves it)");
}

std::string levels_text(const BakeResult& result) {
    std::string text =
        fmt::format("  {:<8}{:>10}{:>10}{:>10}{:>9}\n", "level", "triangles", "size", "mean mm", "95 % mm");
    const double mm = metres_per_box(result) * mm_per_m;
    for (std::size_t k = 0; k < result.pack.levels.size(); ++k) {
        const pack::PackLevel& level = result.pack.levels[k];
        text +=
            fmt::format("  {:<8}{:>10}{:>10}{:>10.3f}{:>9.3f}{}\n", k, level.indices.size() / 3,
                        in_units(bytes_of(result, k)), level.error.mean_box * mm, level.error.p95_box * mm,
                        k == result.pack.default_level ? "  shown unless the machine needs another" : "");
    }
    return text;
}

std::string notes_text(const BakeResult& result, bake::SourceNote::Kind kind, const char* name) {
    std::string text;
    for (const bake::SourceNote& note : result.notes) {
        if (note.kind == kind) {
            text += fmt::format("  {:<8}{}\n", name, note.text);
        }
    }
    return text;
}

/// The languages that have sounds.
std::vector<std::string> spoken_in(const pack::Pack& pack) {
    std::vector<std::string> languages;
    for (const pack::SpokenText& spoken : pack::list_sounds(pack).value_or(std::vector<pack::SpokenText>())) {
        if (std::find(languages.begin(), languages.end(), spoken.language) == languages.end()) {
            languages.push_back(spoken.language);
        }
    }
    return languages;
}

/// Lines about the speech; empty if there are none.
std::string speech_text(const BakeResult& result) {
    const std::vector<std::string> languages = spoken_in(result.pack);
    std::string text;
    if (!languages.empty()) {
        text += fmt::format("  {:<8}the description in {}\n", "spoken", fmt::join(languages, ", "));
    }
    for (const std::string& sentence : result.silent) {
        text += fmt::format("  {:<8}{}\n", "silent", sentence);
    }
    return text;
}

std::vector<std::string> texts_of(const BakeResult& result, bake::SourceNote::Kind kind) {
    std::vector<std::string> texts;
    for (const bake::SourceNote& note : result.notes) {
        if (note.kind == kind) {
            texts.push_back(note.text);
        }
    }
    return texts;
}

std::string missing_text(const BakeResult& result) {
    std::string text;
    for (const std::string& sentence : result.missing) {
        text += fmt::format("  {:<8}{}\n", "missing", sentence);
    }
    return text;
}

std::string_view trigger_name(const world::Behaviour& behaviour) {
    return world::trigger_names.at(static_cast<std::size_t>(behaviour.trigger));
}

std::string_view taken_cells(const BakeResult& result) {
    return result.cells.nodes ? "nodes" : result.world.cells.empty() ? "none" : "found";
}

/// Whether it has cells and why, and what moves them.
std::string cells_text(const BakeResult& result) {
    std::string text = result.cells.found ? fmt::format("  {:<8}auto: {}\n", "cells", result.cells.why)
                                          : fmt::format("  {:<8}{}, since {}\n", "cells", taken_cells(result),
                                                        result.cells.why);
    if (!result.site.empty()) {
        text.clear(); // its cells are its regions
    }
    for (const std::string& each : result.site) {
        text += fmt::format("  {:<8}{}\n", "site", each);
    }
    for (const std::string& each : result.torches) {
        text += fmt::format("  {:<8}{}\n", "torch", each);
    }
    for (const std::string& each : result.states) {
        text += fmt::format("  {:<8}{}\n", "state", each);
    }
    for (const pack::PackBehaviour& each : result.world.behaviours) {
        text += fmt::format("  {:<8}'{}', {:.2g} s, by {}\n", "moves", each.behaviour.name,
                            each.behaviour.seconds, trigger_name(each.behaviour));
    }
    return text;
}

Json cells_json(const BakeResult& result) {
    Json cells = Json::array();
    for (const pack::PackCell& each : result.world.cells) {
        cells.push_back({{"name", each.cell.name}, {"triangles", each.triangles}});
    }
    Json behaviours = Json::array();
    for (const pack::PackBehaviour& each : result.world.behaviours) {
        behaviours.push_back({{"name", each.behaviour.name},
                              {"seconds", each.behaviour.seconds},
                              {"trigger", trigger_name(each.behaviour)}});
    }
    return {{"taken", taken_cells(result)},
            {"why", result.cells.why},
            {"cells", std::move(cells)},
            {"behaviours", std::move(behaviours)}};
}

std::string page_text(const BakeResult& result) {
    return result.page.empty()
               ? std::string()
               : fmt::format("  {:<8}{}, {}\n", "page", result.page.string(), in_units(result.page_bytes));
}

} // namespace

PreviewFacts preview_facts(const BakeResult& result) {
    PreviewFacts facts;
    facts.pack_name = result.file.filename().string();
    facts.pack_bytes = result.file_bytes;
    facts.seconds = result.seconds;
    facts.size_m = size_m(result);
    facts.stands = standing_text(result);
    facts.program = name_and_version("frustumscreen-bake");
    const double mm = metres_per_box(result) * mm_per_m;
    for (std::size_t k = 0; k < result.pack.levels.size(); ++k) {
        const pack::PackLevel& level = result.pack.levels[k];
        facts.levels.push_back({.triangles = level.indices.size() / 3,
                                .bytes = bytes_of(result, k),
                                .mean_mm = level.error.mean_box * mm,
                                .p95_mm = level.error.p95_box * mm,
                                .largest_mm = level.error.max_box * mm,
                                .colour_rmse = static_cast<double>(level.error.colour_rmse)});
    }
    facts.lost = texts_of(result, bake::SourceNote::Kind::Lost);
    facts.silent = result.silent;
    facts.guessed = texts_of(result, bake::SourceNote::Kind::Guessed);
    facts.taken = texts_of(result, bake::SourceNote::Kind::Taken);
    facts.rights = result.rights;
    facts.missing = result.missing;
    return facts;
}

std::string report_text(const BakeResult& result) {
    const glm::dvec3 size = size_m(result) * mm_per_m;
    const std::string lost = notes_text(result, bake::SourceNote::Kind::Lost, "lost");
    return fmt::format("{}: \"{}\" ({}), {}, from {} triangles in {}\n", result.file.string(),
                       result.pack.title, fmt::join(result.pack.languages, ", "), in_units(result.file_bytes),
                       result.pack.provenance.source_triangles, words_of_time(result.seconds)) +
           fmt::format("  {:<8}{:.0f} mm wide, {:.0f} deep, {:.0f} high in the usual {}{}\n", "size", size.x,
                       size.y, size.z, result.pack.prop_kind,
                       result.pack.scale > 1.0 ? ", which cuts off what is outside (--scale)" : "") +
           fmt::format("  {:<8}{}\n", "stands", standing_text(result)) + levels_text(result) +
           cells_text(result) + speech_text(result) +
           (lost.empty() ? fmt::format("  {:<8}nothing\n", "lost") : lost) +
           notes_text(result, bake::SourceNote::Kind::Guessed, "guessed") +
           notes_text(result, bake::SourceNote::Kind::Taken, "taken") + missing_text(result) +
           page_text(result);
}

Json report_json(const BakeResult& result) {
    const glm::dvec3 size = size_m(result);
    const double mm = metres_per_box(result) * mm_per_m;
    Json levels = Json::array();
    for (std::size_t k = 0; k < result.pack.levels.size(); ++k) {
        const pack::PackLevel& level = result.pack.levels[k];
        levels.push_back({{"technique", "mesh"},
                          {"triangles", level.indices.size() / 3},
                          {"bytes", bytes_of(result, k)},
                          {"mean_mm", level.error.mean_box * mm},
                          {"p95_mm", level.error.p95_box * mm},
                          {"max_mm", level.error.max_box * mm},
                          {"colour_rmse", level.error.colour_rmse}});
    }
    Json report = {{"file", result.file.string()},
                   {"bytes", result.file_bytes},
                   {"title", result.pack.title},
                   {"seconds", result.seconds},
                   {"processor_seconds", result.used.processor_s},
                   {"memory_bytes", result.used.memory_bytes},
                   {"prop", result.pack.prop_kind},
                   {"size_m", {size.x, size.y, size.z}},
                   {"up", signed_axis(result.up)},
                   {"front", front_of(result.up)},
                   {"turn_deg", result.turn_deg},
                   {"scale", result.pack.scale},
                   {"levels", levels},
                   {"default_level", result.pack.default_level},
                   {"spoken", spoken_in(result.pack)},
                   {"silent", result.silent},
                   {"lost", texts_of(result, bake::SourceNote::Kind::Lost)},
                   {"guessed", texts_of(result, bake::SourceNote::Kind::Guessed)},
                   {"taken", texts_of(result, bake::SourceNote::Kind::Taken)},
                   {"missing", result.missing},
                   {"torches", result.torches},
                   {"states", result.states},
                   {"site", result.site},
                   {"cells", cells_json(result)},
                   {"scan", json_of(result.scan)},
                   {"id", result.pack.id},
                   {"licence", result.rights.licence},
                   {"author", result.rights.author},
                   {"source", result.rights.source}};
    if (!result.page.empty()) {
        report["page"] = result.page.string();
    }
    return report;
}

} // namespace frustumscreen::programs
